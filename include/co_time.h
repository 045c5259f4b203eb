// SPDX-License-Identifier: Apache-2.0
/// \file co_time.h
/// TIME, consumer and producer, and a running clock. [301:7.2.6] Configured by 1012h (co_time_id.h); exists with
/// USE_TIME.
///
/// The clock stands at 0 until it is set, by COTimeSet(), by a TIME message or through an object (co_time_clock.h).
/// From then on it goes by the ticks of the timer driver and does not drift against them, whatever their frequency (1
/// Hz to 429 MHz); a timer of the stack carries it on once a second. It goes on through NMT resets and all NMT states
/// and ends with CONodeStop(). A loop that is late does it no harm for 2^32 ticks, less a second. After 65535 days
/// (2163) it starts again at day 0. There are no leap seconds, time zones and summer times.
///
/// TIME messages are taken and sent in Pre-operational and Operational. One that names no time of the day (24 h and
/// more), or is not 6 bytes long, changes nothing and is counted as malformed; its reserved bits are ignored.
///
/// Context: the loop.
#ifndef CO_TIME_H_
#define CO_TIME_H_

#include "co_err.h"
#include "co_needs.h"
#include "co_time_of_day.h"
#include "co_tmr.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Values for 1012h
/// \a consume, \a produce: 1 = the node takes TIME, sends TIME; \a id: CAN-ID
/// \{
#define CO_TIME_COBID_CONSUME 0x80000000u  ///< bit 31: the node takes TIME
#define CO_TIME_COBID_PRODUCE 0x40000000u  ///< bit 30: the node sends TIME
#define CO_TIME_COBID_EXT 0x20000000u      ///< bit 29: 29-bit CAN-ID
#define CO_TIME_COBID_MASK 0x1FFFFFFFu
#define CO_COBID_TIME_STD(consume, produce, id) \
  ((((uint32_t)(id)) & 0x7FFu) | ((((uint32_t)(produce)) & 1u) << 30) | ((((uint32_t)(consume)) & 1u) << 31))
#define CO_COBID_TIME_EXT(consume, produce, id)                                            \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x20000000u | ((((uint32_t)(produce)) & 1u) << 30) | \
   ((((uint32_t)(consume)) & 1u) << 31))
/// \}

struct CO_NODE_T;

/// The application touches nothing of it.
typedef struct CO_TIME_T {
  CO_TMR_MEM Tmr;       ///< carries the clock on; it runs while the clock does
  CO_TMR_MEM SendTmr;   ///< of the producer
  CO_TIME_OF_DAY Past;  ///< the clock, some full seconds after it was set
  uint32_t Tick;        ///< the ticks of that moment
  uint32_t Identifier;  ///< of TIME messages to be sent; UINT32_MAX: none
  uint32_t Period;      ///< of the producer, ticks; 0: none
} CO_TIME;

/// Sets the clock, which starts it if it stood. Nothing is sent. CO_ERR_BAD_ARG: an argument is null, or Ms is a day or
/// more; CO_ERR_NMT_MODE: the node is in CO_INVALID; CO_ERR_TMR_CREATE: the timer has no frequency.
CO_ERR COTimeSet(struct CO_NODE_T* node, const CO_TIME_OF_DAY* time) CO_NEEDS(USE_TIME);

/// The clock, exact to the millisecond that has begun (or to a tick, if that is longer). CO_ERR_BAD_ARG: an argument is
/// null; CO_ERR_OBJ_NO_DATA: it was not set yet, \a time is 0.
CO_ERR COTimeGet(struct CO_NODE_T* node, CO_TIME_OF_DAY* time) CO_NEEDS(USE_TIME);

/// Sends the clock once. A TIME message that still waits to be sent is replaced. CO_ERR_BAD_ARG: \a node is null;
/// CO_ERR_OBJ_STATE: 1012h does not make the node a producer; CO_ERR_NMT_MODE: it is neither in Pre-operational nor in
/// Operational; CO_ERR_OBJ_NO_DATA: the clock was not set yet; CO_ERR_IF_CAN_SEND: the transmit queue is full.
CO_ERR COTimeSend(struct CO_NODE_T* node) CO_NEEDS(USE_TIME);

/// Lets the clock be sent every \a ms milliseconds, rounded up to ticks; 0: no more. The first time one period from
/// now, and from each moment on at which the node may send TIME again. It holds until CONodeInit(), through NMT resets;
/// what keeps COTimeSend() from sending keeps it from sending. CO_ERR_BAD_ARG: \a node is null, or the timer cannot
/// hold the period.
CO_ERR COTimeProduce(struct CO_NODE_T* node, uint32_t ms) CO_NEEDS(USE_TIME);

/// \name Callback of the application (see co_nmt.h)
/// \{

/// A TIME message has set the clock to \a time.
void COTimeUpdate(struct CO_NODE_T* node, const CO_TIME_OF_DAY* time);
/// \}

#ifdef __cplusplus
}
#endif

#endif
