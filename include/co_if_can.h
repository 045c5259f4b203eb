// SPDX-License-Identifier: Apache-2.0
/// \file co_if_can.h
/// CAN frames, and the functions that a CAN driver has to provide.
#ifndef CO_IF_CAN_H_
#define CO_IF_CAN_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Events that a CAN controller reports.
typedef enum CO_CAN_EVENT_T {
  CO_CAN_OVERRUN = 0,  ///< a received frame was lost
  CO_CAN_PASSIVE,      ///< error passive
  CO_CAN_BUS_OFF,      ///< bus-off
  CO_CAN_RECOVERED,    ///< error active again
  CO_CAN_EVENT_NUM     ///< number of events
} CO_CAN_EVENT;

/// \name Identifier of a frame: CAN-ID in bits 0…28 and these flags. Drivers that do not support a flag leave it 0.
/// \{
#define CO_IF_FRM_EXT 0x80000000u  ///< 29-bit identifier
#define CO_IF_FRM_RTR 0x40000000u  ///< remote frame
/// Error frame: no frame of the bus, but a state of the controller in the coding of the driver; see
/// CO_IF_CAN_DRV_EX.Report.
#define CO_IF_FRM_ERROR 0x20000000u
#define CO_IF_FRM_ID 0x1FFFFFFFu  ///< the CAN-ID
/// \}

struct CO_NODE_T;

/// A CAN frame.
typedef struct CO_IF_FRM_T {
  uint32_t Identifier;  ///< CAN-ID and flags
  uint8_t Data[8];      ///< data in the order of the bus
  /// Number of valid bytes in Data, 0…8. 9…15 mean 8 bytes [ISO 11898-1]; a frame with a larger value is malformed: the
  /// node counts it (CO_NODE_COUNTERS.Malformed) and discards it.
  uint8_t DLC;
} CO_IF_FRM;

/// \name Members of a frame; \a f is a pointer, \a pos a position in Data (modulo 8), multi-byte values are little
/// endian
/// \{
#define CO_SET_ID(f, id) ((f)->Identifier = (uint32_t)(id))                               ///< sets CAN-ID and flags
#define CO_SET_DLC(f, n) ((f)->DLC = (uint8_t)(n))                                        ///< sets the DLC
#define CO_SET_BYTE(f, value, pos) ((f)->Data[(pos)&7] = (uint8_t)(value))                ///< sets a byte
#define CO_SET_WORD(f, value, pos) COFrmSetWord((f), (uint32_t)(value), (uint32_t)(pos))  ///< sets 2 bytes
#define CO_SET_LONG(f, value, pos) COFrmSetLong((f), (uint32_t)(value), (uint32_t)(pos))  ///< sets 4 bytes
#define CO_GET_ID(f) ((f)->Identifier)                                                    ///< returns CAN-ID and flags
#define CO_GET_DLC(f) ((f)->DLC)                                                          ///< returns the DLC
#define CO_GET_BYTE(f, pos) ((f)->Data[(pos)&7])                                          ///< returns a byte
/// Returns 2 bytes.
#define CO_GET_WORD(f, pos) ((uint16_t)(CO_GET_BYTE(f, (pos)) | ((uint32_t)CO_GET_BYTE(f, (pos) + 1) << 8)))
/// Returns 4 bytes.
#define CO_GET_LONG(f, pos) ((uint32_t)(CO_GET_WORD(f, (pos)) | ((uint32_t)CO_GET_WORD(f, (pos) + 2) << 16)))

/// \cond internal
static inline void COFrmSetWord(CO_IF_FRM* frm, uint32_t value, uint32_t pos) {
  CO_SET_BYTE(frm, value, pos);
  CO_SET_BYTE(frm, value >> 8, pos + 1u);
}
static inline void COFrmSetLong(CO_IF_FRM* frm, uint32_t value, uint32_t pos) {
  COFrmSetWord(frm, value, pos);
  COFrmSetWord(frm, value >> 16, pos + 2u);
}
/// \endcond
/// \}

/// A CAN driver (CO_NODE_EXT.Can), with context argument for several controllers in one program. All functions are
/// called in the loop context and must not block, except Read in a task of an RTOS.
typedef struct CO_IF_CAN_DRV_EX_T {
  void (*Init)(void* ctx);                           ///< prepares the controller, which stays off the bus
  void (*Enable)(void* ctx, uint32_t baud);          ///< sets the bit timing (bit/s) and goes on the bus
  int16_t (*Read)(void* ctx, CO_IF_FRM* frm);        ///< returns sizeof(CO_IF_FRM) for a frame, 0 for none, -1 on error
  int16_t (*Send)(void* ctx, const CO_IF_FRM* frm);  ///< returns sizeof(CO_IF_FRM) if accepted, else 0 or -1: retried
  void (*Reset)(void* ctx);                          ///< clears errors and queues, goes back on the bus
  void (*Close)(void* ctx);                          ///< goes off the bus
  /// Sets the acceptance filter; may be null. \a ids: the identifiers (with CO_IF_FRM_EXT) that the node receives, in
  /// data and in remote frames, ascending; an identifier occurs once for each service that uses it. The array is valid
  /// during the call only. Called before Enable and after every change. A driver may pass further frames.
  void (*Filter)(void* ctx, const uint32_t* ids, uint16_t num);
  /// Reports the events of an error frame (CO_IF_FRM_ERROR) that Read has returned: calls CONodeCanEvent() for each.
  /// Called by CONodeProcess(). CONodeCanReport() does so for the coding of SocketCAN. May be null: error frames are
  /// discarded, and counted in CO_NODE_COUNTERS.Unclaimed.
  void (*Report)(void* ctx, struct CO_NODE_T* node, const CO_IF_FRM* frm);
} CO_IF_CAN_DRV_EX;

/// Reports the events of an error frame in the coding of SocketCAN (linux/can/error.h), for CO_IF_CAN_DRV_EX.Report.
/// Frames without CO_IF_FRM_ERROR have no effect. \a ctx is not used. Context: the loop; with several threads the
/// mainline.
void CONodeCanReport(void* ctx, struct CO_NODE_T* node, const CO_IF_FRM* frm);

/// \name As in CANopen-Stack
/// \{

/// A classic CAN driver (without context): one table, one controller. Otherwise the functions are those of
/// CO_IF_CAN_DRV_EX.
typedef struct CO_IF_CAN_DRV_T {
  void (*Init)(void);             ///< prepares the controller, which stays off the bus
  void (*Enable)(uint32_t baud);  ///< sets the bit timing (bit/s) and goes on the bus
  int16_t (*Read)(CO_IF_FRM*);    ///< returns sizeof(CO_IF_FRM) for a frame, 0 for none, -1 on error
  int16_t (*Send)(CO_IF_FRM*);    ///< returns sizeof(CO_IF_FRM) if accepted; 0 (busy) and -1 (error): retried later
  void (*Reset)(void);            ///< clears errors and queues, goes back on the bus
  void (*Close)(void);            ///< goes off the bus
} CO_IF_CAN_DRV;
/// \}

#ifdef __cplusplus
}
#endif

#endif
