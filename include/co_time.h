// SPDX-License-Identifier: Apache-2.0
/// \file co_time.h
/// TIME consumer and producer, and a running clock (USE_TIME). [CiA 301, 7.2.6] Configured by 1012h. A clock in µs that
/// SYNC and time stamps synchronise (USE_TIME_HIGH_RES), 1013h.
///
/// The clock is stopped at 0 until it is set by COTimeSet(), by a TIME message or through an object (CO_TTIME_CLOCK).
/// It then counts the ticks of the timer driver and does not drift against them, at any timer frequency (1 Hz to 429
/// MHz); a timer of the stack advances it once a second. It continues through NMT resets and in all NMT states and ends
/// with CONodeStop(). The loop may be late by up to 2^32 ticks less one second. After 65535 days (2163) it starts again
/// at day 0. There are no leap seconds, time zones or summer times.
///
/// TIME messages are received and sent in Pre-operational and Operational. A message with a time of 24 h or more, or
/// with another length than 6 bytes, is ignored and counted as malformed; reserved bits are ignored.
///
/// Context: the loop.
#ifndef CO_TIME_H_
#define CO_TIME_H_

#include "co_err.h"
#include "co_obj.h"
#include "co_time_of_day.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Values for 1012h
/// \a consume, \a produce: 1 = the node consumes TIME, produces TIME; \a id: CAN-ID
/// \{
#define CO_TIME_COBID_CONSUME 0x80000000u  ///< bit 31: the node consumes TIME
#define CO_TIME_COBID_PRODUCE 0x40000000u  ///< bit 30: the node produces TIME
#define CO_TIME_COBID_EXT 0x20000000u      ///< bit 29: 29-bit CAN-ID
#define CO_TIME_COBID_MASK 0x1FFFFFFFu     ///< bits 0…28: CAN-ID
/// Value with an 11-bit CAN-ID.
#define CO_COBID_TIME_STD(consume, produce, id) \
  ((((uint32_t)(id)) & 0x7FFu) | ((((uint32_t)(produce)) & 1u) << 30) | ((((uint32_t)(consume)) & 1u) << 31))
/// Value with a 29-bit CAN-ID.
#define CO_COBID_TIME_EXT(consume, produce, id)                                            \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x20000000u | ((((uint32_t)(produce)) & 1u) << 30) | \
   ((((uint32_t)(consume)) & 1u) << 31))
/// \}

struct CO_NODE_T;

#if USE_TIME_HIGH_RES
/// High-resolution time stamp of a node. The application must not access its members.
typedef struct CO_TIME_HIGH_RES_T {
  CO_TMR_MEM Tmr;          ///< counts seconds; active while the local time is used
  uint32_t Tick;           ///< clock of the timer driver at Seconds
  uint32_t Seconds;        ///< local time in µs, whole seconds
  uint32_t Base;           ///< local time at which the clock was Time
  uint32_t Time;           ///< clock at Base in µs
  int32_t Rate;            ///< rate of the clock against the local time, minus 1, in units of 2^-24
  uint32_t MeasuredLocal;  ///< local time at the begin of a measurement of the rate
  uint32_t MeasuredTime;   ///< time stamp then
  uint32_t Sync;           ///< local time at the last SYNC
  uint32_t Before;         ///< local time at the SYNC before
  uint8_t Syncs;           ///< SYNCs since the last time stamp, at most 2
  uint8_t InSync;          ///< 1 while the PDOs of a SYNC are processed
  uint8_t Rejected;        ///< time stamps in succession that do not fit
  uint8_t Flags;           ///< the clock is set, its rate is measured, time stamps fit
} CO_TIME_HIGH_RES;
#endif

/// TIME of a node. The application must not access its members.
typedef struct CO_TIME_T {
  CO_TMR_MEM Tmr;       ///< advances the clock; active while the clock is running
  CO_TMR_MEM SendTmr;   ///< producer
  CO_TIME_OF_DAY Past;  ///< time at Tick, in full seconds after the clock was set
  uint32_t Tick;        ///< clock of the timer driver at Past
  uint32_t Identifier;  ///< identifier of TIME messages to be sent; UINT32_MAX: none
  uint32_t Period;      ///< period of the producer in ticks; 0: none
#if USE_TIME_HIGH_RES
  CO_TIME_HIGH_RES HighRes;  ///< high-resolution time stamp
#endif
} CO_TIME;

/// Sets the clock and starts it. Nothing is sent.
/// \retval CO_ERR_NONE        the clock is set
/// \retval CO_ERR_BAD_ARG     an argument is null, or Ms is 24 h or more
/// \retval CO_ERR_NMT_MODE    the node is in CO_INVALID
/// \retval CO_ERR_TMR_CREATE  the timer has no frequency
CO_ERR COTimeSet(struct CO_NODE_T* node, const CO_TIME_OF_DAY* time) CO_NEEDS(USE_TIME);

/// Returns the time in \a time, rounded down to a millisecond (or a tick, if that is longer).
/// \retval CO_ERR_NONE         the clock is running
/// \retval CO_ERR_BAD_ARG      an argument is null
/// \retval CO_ERR_OBJ_NO_DATA  the clock was not set yet; \a time is 0
CO_ERR COTimeGet(struct CO_NODE_T* node, CO_TIME_OF_DAY* time) CO_NEEDS(USE_TIME);

/// Sends a TIME message with the time of the clock. Replaces a TIME message that is still in the transmit queue.
/// \retval CO_ERR_NONE         the message is sent or queued
/// \retval CO_ERR_BAD_ARG      \a node is null
/// \retval CO_ERR_OBJ_STATE    the node is no TIME producer (1012h)
/// \retval CO_ERR_NMT_MODE     the node is neither in Pre-operational nor in Operational
/// \retval CO_ERR_OBJ_NO_DATA  the clock was not set yet
/// \retval CO_ERR_IF_CAN_SEND  the transmit queue is full
CO_ERR COTimeSend(struct CO_NODE_T* node) CO_NEEDS(USE_TIME);

/// Sends a TIME message every \a ms milliseconds, rounded up to ticks; 0 stops it. The first message is sent one period
/// after the call, and one period after each moment at which the NMT state allows TIME again. The setting remains valid
/// through NMT resets until CONodeInit(). A message is omitted while COTimeSend() would return an error.
/// \retval CO_ERR_NONE     the period is set
/// \retval CO_ERR_BAD_ARG  \a node is null, or the period is beyond the range of the timer
CO_ERR COTimeProduce(struct CO_NODE_T* node, uint32_t ms) CO_NEEDS(USE_TIME);

/// \name Callback of the application (see co_nmt.h)
/// \{

/// Called after a TIME message has set the clock to \a time.
void COTimeUpdate(struct CO_NODE_T* node, const CO_TIME_OF_DAY* time);
/// \}

/// \name 1012h, COB-ID TIME
/// [CiA 301, 7.5.2.15] Data: a uint32_t, or the value itself (flag D). Bit 31: the node consumes
/// TIME, bit 30: it produces TIME, bit 29: 29-bit CAN-ID. While bit 31 or 30 is set, bits 0 to 29 cannot be changed;
/// restricted CAN-IDs are refused (0609 0030h). A write takes effect at once; with a plain CO_TUNSIGNED32 instead, at
/// the next reset.
/// \{

extern const CO_OBJ_TYPE COTTimeId CO_NEEDS(USE_TIME);  ///< functions of CO_TTIME_ID

#define CO_TTIME_ID ((const CO_OBJ_TYPE*)&COTTimeId)  ///< type of 1012h
/// \}

/// \name The node's clock as an object
/// Its data type is TIME_OF_DAY: reading returns the time, 0 until it was set; writing sets
/// it. A time of 24 h or more is refused (0609 0030h). 6 bytes, which may be mapped into PDOs. Data: 0, not used.
///
///     {CO_KEY(0x2101, 0, CO_OBJ____PRW), CO_TTIME_CLOCK, 0}
/// \{

extern const CO_OBJ_TYPE COTTimeClock CO_NEEDS(USE_TIME);  ///< functions of CO_TTIME_CLOCK

#define CO_TTIME_CLOCK ((const CO_OBJ_TYPE*)&COTTimeClock)  ///< type of the clock; Data: 0
/// \}

/// \name High-resolution time stamp
/// 1013h [CiA 301, 7.5.2.16] is the value of a clock in µs at the last SYNC; it wraps at 2^32 (71.6 min). All nodes
/// receive a SYNC at the same time, so the value of one node synchronises the clocks of the others, within the jitter
/// with which they process a SYNC.
/// - Producer: the application sets the clock once (COTimeHighResSet()) and maps 1013h into a TPDO. A producer of time
///   stamps that receives the SYNC is more exact than the producer of SYNC, whose SYNC may wait for other frames.
/// - Consumer: maps 1013h into an RPDO. An event-driven RPDO must arrive before the next SYNC; a synchronous RPDO,
/// which
///   is written at the next SYNC, belongs to the SYNC before. The first time stamp sets the clock; each further one
///   corrects it by a quarter of the difference, and its rate, which is measured over more than a second, by up to
///   977 ppm. Time stamps should arrive at least once a minute.
///
/// A time stamp counts only after a SYNC, and only the first one that fits. It does not fit if it differs by more than
/// 250 µs, 977 ppm of the time since the last one, and two ticks of the timer: a SYNC was lost, or there is another
/// producer. The fourth such time stamp in succession sets the clock. Without time stamps the clock continues with its
/// rate. The local time of a node has the resolution of its timer, or is CO_NODE_EXT.Microseconds. The loop may be late
/// by up to a minute, and less than 2^32 ticks of the timer.
///
/// Data of 1013h: a uint32_t; the stack writes it at each SYNC, 0 until the clock is set. The clock runs through NMT
/// resets and ends with CONodeStop().
///
///     {CO_KEY(0x1013, 0, CO_OBJ____PRW), CO_TTIME_HIGH_RES, (CO_DATA)(&TimeStamp)}
/// \{

/// Sets the clock to \a us.
/// \retval CO_ERR_NONE        the clock is set
/// \retval CO_ERR_BAD_ARG     \a node is null
/// \retval CO_ERR_NMT_MODE    the node is in CO_INVALID
/// \retval CO_ERR_TMR_CREATE  the timer has no frequency
CO_ERR COTimeHighResSet(struct CO_NODE_T* node, uint32_t us) CO_NEEDS(USE_TIME_HIGH_RES);

/// Returns the clock in \a us, in µs. Time stamps may move it backwards: by up to a quarter of a difference, or to any
/// value when a time stamp sets it.
/// \retval CO_ERR_NONE         the clock is set
/// \retval CO_ERR_BAD_ARG      an argument is null
/// \retval CO_ERR_OBJ_NO_DATA  the clock was not set yet; \a us is 0
CO_ERR COTimeHighResGet(struct CO_NODE_T* node, uint32_t* us) CO_NEEDS(USE_TIME_HIGH_RES);

/// Returns 1 if the last time stamp has fitted the clock, 0 if there was none or it did not fit, -1 if \a node is null.
/// Whether time stamps arrive at all is observed by the deadline of the RPDO (sub-index 5).
int16_t COTimeHighResIsSynchronised(const struct CO_NODE_T* node) CO_NEEDS(USE_TIME_HIGH_RES);

extern const CO_OBJ_TYPE COTTimeHighRes CO_NEEDS(USE_TIME_HIGH_RES);  ///< functions of CO_TTIME_HIGH_RES

#define CO_TTIME_HIGH_RES ((const CO_OBJ_TYPE*)&COTTimeHighRes)  ///< type of 1013h
/// \}

#ifdef __cplusplus
}
#endif

#endif
