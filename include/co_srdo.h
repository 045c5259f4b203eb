// SPDX-License-Identifier: Apache-2.0
/// \file co_srdo.h
/// Safety-relevant data objects (SRDO, CO_SRDO_N). [EN 50325-5] An SRDO is a pair of frames: the plain frame (COB-ID 1)
/// contains the data, the inverse frame (COB-ID 2) the same bytes with every bit inverted. The consumer monitors the
/// time between both frames and between pairs.
///
/// The stack is the transport ("grey channel") for the safety functions of a device: redundancy, diagnosis of CPU and
/// memory and the safety case are those of the device. The stack has no safety integrity level.
///
/// Objects, see also docs/srdo.md:
///
/// | index | sub | type | value |
/// |---|---|---|---|
/// | 1301h…1340h | 1 | CO_TSRDO_COM | direction: 0: the SRDO does not exist, 1: transmitted, 2: received |
/// | | 2 | | refresh time of the producer, safeguard cycle time (SCT) of the consumer: 1…65535 ms |
/// | | 3 | | safety-relevant validation time (SRVT): 1…255 ms |
/// | | 4 | | transmission type: 254 |
/// | | 5, 6 | | COB-ID 1: odd, 101h…17Fh; COB-ID 2: COB-ID 1 plus 1 |
/// | 1381h…13C0h | 0 | CO_TSRDO_MAP | number of mapped objects: even, 0…16 |
/// | | 1…16 | | CO_LINK(index, sub, bits): odd sub-indices the data, even ones the inverted data |
/// | 13FEh | 0 | CO_TSRDO_VALID | A5h: the configuration is valid |
/// | 13FFh | 1…64 | CO_TSRDO_SIGNATURE | signature of each SRDO, see COSrdoSignature() |
///
/// All are refused in Operational (0800 0022h). Each write of the others sets 13FEh to 0. Other values than those of
/// the table: 0609 0030h; an odd number of mapped objects, or more than 16: 0604 0042h; a mapping while the direction
/// or the number of mapped objects is not 0: 0601 0000h; an object that does not exist: 0602 0000h; one without flag P,
/// or of another length: 0604 0041h.
///
/// A mapped object needs flag P, and R (producer) or W (consumer). The static data types 0002h…0007h are placeholders:
/// a consumer skips their bytes, a producer transmits 0 in the plain and FFh in the inverse frame.
///
/// When the node enters Operational, each SRDO is checked: 13FEh, the parameters, the signature, the mapping. An SRDO
/// with a fault does not start (CO_SRDO_ERR_CONFIGURATION); EMCY 6300h contains index and sub-index of the fault in the
/// last three bytes, and 13FEh becomes 0. If 13FEh is not A5h, no SRDO starts, and no EMCY is sent.
///
/// Any other fault ends in a CO_SRDO_ERR_… state, which only leaving Operational ends; EMCY 8200h contains the index of
/// the SRDO and the state in the last three bytes.
///
/// Times are rounded up to ticks of the timer driver. A frame is in time if it is processed at most SRVT or SCT ticks
/// after the plain frame that began the time: a frame that waits for CONodeProcess() gets older.
///
/// Context: the loop; with USE_REAL_TIME the real-time thread, if there is one.
#ifndef CO_SRDO_H_
#define CO_SRDO_H_

#include "co_err.h"
#include "co_obj.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

#define CO_SRDO_MAP_N 16                   ///< objects that an SRDO can map: 8 pairs
#define CO_SRDO_CONFIGURATION_VALID 0xA5u  ///< value of 13FEh: the configuration is valid
#define CO_SRDO_NONE 0u                    ///< direction: the SRDO does not exist
#define CO_SRDO_TX 1u                      ///< direction: the node is the producer
#define CO_SRDO_RX 2u                      ///< direction: the node is the consumer
#define CO_SRDO_TYPE 254u                  ///< transmission type
/// \name Default COB-IDs of the first SRDO of a producer with node-ID \a id, 1…64
/// \{
#define CO_SRDO_COBID1(id) (0xFFu + 2u * (uint32_t)(id))   ///< plain frame
#define CO_SRDO_COBID2(id) (0x100u + 2u * (uint32_t)(id))  ///< inverse frame
/// \}

/// State of an SRDO.
typedef enum CO_SRDO_STATE_T {
  CO_SRDO_DELETED = 0,             ///< direction 0, or there is no such SRDO
  CO_SRDO_NOT_OPERATIONAL = 1,     ///< the node is not in Operational
  CO_SRDO_INITIALISING = 2,        ///< no pair was sent or received yet
  CO_SRDO_ESTABLISHED = 3,         ///< a valid pair was sent or received in time
  CO_SRDO_ERR_CONFIGURATION = 4,   ///< the configuration is not valid (13FEh), or the check has found a fault
  CO_SRDO_ERR_RX_NOT_INVERSE = 5,  ///< the received frames are not inverse, or came in another order
  CO_SRDO_ERR_TX_NOT_INVERSE = 6,  ///< the mapped objects of the producer are not inverse; nothing was sent
  CO_SRDO_ERR_SRVT = 7,            ///< the inverse frame did not come in time
  CO_SRDO_ERR_SCT = 8,             ///< the next pair did not come in time
  CO_SRDO_ERR_SHORT = 9,           ///< a received frame is shorter than the mapping
  CO_SRDO_ERR_SEND = 10,           ///< a frame could not be queued, or the last one is still in the queue
  CO_SRDO_ERR_INTERNAL = 11        ///< an object could not be read or written, or the dictionary was replaced
} CO_SRDO_STATE;

/// An SRDO of a node. The application must not access its members.
typedef struct CO_SRDO_T {
  struct CO_NODE_T* Node;         ///< owner
  CO_TMR_MEM Tmr;                 ///< producer: next frame; consumer: SRVT or SCT
  uint32_t Identifier[2];         ///< plain and inverse frame; UINT32_MAX: none
  uint32_t Cycle;                 ///< refresh time or SCT, in ticks
  uint32_t Validation;            ///< SRVT, in ticks
  uint32_t Tick;                  ///< clock of the last plain frame
  uint16_t Entry[CO_SRDO_MAP_N];  ///< mapped entries, alternately plain and inverse; FFFFh: bytes are skipped
  uint8_t Bytes[CO_SRDO_MAP_N];   ///< their lengths
  uint8_t Data[8];                ///< consumer: plain frame that was received; producer: inverse frame to be sent
  uint8_t Num;                    ///< mapped entries
  uint8_t Length;                 ///< bytes of each frame
  uint8_t Direction;              ///< CO_SRDO_NONE, CO_SRDO_TX, CO_SRDO_RX
  uint8_t State;                  ///< CO_SRDO_STATE
  uint8_t Flags;                  ///< see the service
} CO_SRDO;

extern const CO_OBJ_TYPE COTSrdoCom CO_NEEDS(CO_SRDO_N);        ///< functions of CO_TSRDO_COM
extern const CO_OBJ_TYPE COTSrdoMap CO_NEEDS(CO_SRDO_N);        ///< functions of CO_TSRDO_MAP
extern const CO_OBJ_TYPE COTSrdoValid CO_NEEDS(CO_SRDO_N);      ///< functions of CO_TSRDO_VALID
extern const CO_OBJ_TYPE COTSrdoSignature CO_NEEDS(CO_SRDO_N);  ///< functions of CO_TSRDO_SIGNATURE

/// Type of 1301h…1340h, sub 1…6. Data: a uint8_t (sub 1, 3, 4), uint16_t (sub 2) or uint32_t (sub 5, 6), or the value
/// itself (flag D).
#define CO_TSRDO_COM ((const CO_OBJ_TYPE*)&COTSrdoCom)
/// Type of 1381h…13C0h. Data: a uint8_t (sub 0) or uint32_t (sub 1…16), or the value itself (flag D).
#define CO_TSRDO_MAP ((const CO_OBJ_TYPE*)&COTSrdoMap)
/// Type of 13FEh. Data: a uint8_t, which the stack writes.
#define CO_TSRDO_VALID ((const CO_OBJ_TYPE*)&COTSrdoValid)
/// Type of 13FFh, sub 1…64. Data: a uint16_t, or the value itself (flag D).
#define CO_TSRDO_SIGNATURE ((const CO_OBJ_TYPE*)&COTSrdoSignature)

/// Returns the state of SRDO \a number, from 0: the one with the parameters 1301h + \a number.
/// \retval CO_SRDO_DELETED  also if \a node is null, or \a number is not below CO_SRDO_N
CO_SRDO_STATE COSrdoGetState(const struct CO_NODE_T* node, uint8_t number) CO_NEEDS(CO_SRDO_N);

/// Returns whether the node may be in its working state: at least one SRDO exists, and all that exist are established.
/// \retval false  also if \a node is null
bool COSrdoIsEstablished(const struct CO_NODE_T* node) CO_NEEDS(CO_SRDO_N);

/// Sends SRDO \a number at once; the refresh time begins anew. If the inverse frame of the last pair waits for
/// CO_SRDO_GAP, the new pair follows it after the same time.
/// \retval CO_ERR_NONE         the pair is sent, queued, or follows the present one
/// \retval CO_ERR_BAD_ARG      \a node is null, or \a number is not below CO_SRDO_N
/// \retval CO_ERR_NMT_MODE     the node is not in Operational
/// \retval CO_ERR_OBJ_STATE    the SRDO is not transmitted, or is in an error state
/// \retval CO_ERR_OBJ_READ     the pair was not sent: the SRDO has entered an error state
CO_ERR COSrdoRequest(struct CO_NODE_T* node, uint8_t number) CO_NEEDS(CO_SRDO_N);

/// Computes the signature of SRDO \a number from the objects 1301h + \a number and 1381h + \a number: the value of
/// 13FFh that the check requires. lexican/srdo.hpp computes it at compile time from values.
/// \retval CO_ERR_NONE           the signature is in \a signature
/// \retval CO_ERR_BAD_ARG        an argument is null, or \a number is not below CO_SRDO_N
/// \retval CO_ERR_OBJ_NOT_FOUND  the communication parameter is missing
/// \retval CO_ERR_OBJ_MAP_LEN    the number of mapped objects is above 16
CO_ERR COSrdoSignature(struct CO_NODE_T* node, uint8_t number, uint16_t* signature) CO_NEEDS(CO_SRDO_N);

/// \name Callback of the application (see co_nmt.h)
/// \{

/// Called when the state of SRDO \a number has changed. In each state but CO_SRDO_ESTABLISHED of any SRDO the
/// application has to be in its safe state. A consumer has written the objects of the first pair before the call.
void COSrdoChange(struct CO_NODE_T* node, uint8_t number, CO_SRDO_STATE state);
/// \}

#ifdef __cplusplus
}
#endif

#endif
