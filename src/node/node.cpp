// SPDX-License-Identifier: Apache-2.0
#include "node/node.hpp"
#include "base/callbacks.hpp"
#include "base/count.hpp"
#include "base/error.hpp"
#include "base/events.hpp"
#include "base/receive.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "co_core.h"
#include "dictionary/dict.hpp"
#include "hal/port.hpp"
#include "node/parts.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"
#include "wire/nmt.hpp"

namespace co::node {
namespace {

// Reports mandatory objects that the dictionary lacks as the node's error; the node runs without them. [301:7.5.1]
void check_mandatory_objects(CO_NODE& node) {
  if (USE_DICT_CHECK == 0) {
    return;
  }
  constexpr uint32_t error_register = CO_DEV(0x1001, 0);
  constexpr uint32_t vendor_id = CO_DEV(0x1018, 1);
  if (dict::find(node, error_register) == nullptr) {
    error::report(node, CO_ERR_CFG_1001_0, error_register);
  }
  if (dict::find(node, vendor_id) == nullptr) {
    error::report(node, CO_ERR_CFG_1018, vendor_id);
  }
}

// Runs the part of the initialisation that every NMT reset repeats, in CO_INIT. The caller keeps the node working, so
// that requests of type functions and callbacks are deferred. Returns false if one of them requests another state.
[[nodiscard]] bool initialise(CO_NODE& node, CO_NMT_RESET type) {
  routes::clear(node);
  dict::set_power_on_values(node, type);
  parts::run<&Part::of_load>(node, type);
  const dict::Initialised initialised = dict::init_objects(node.Dict, node);
  if (initialised.err != CO_ERR_NONE) {
    error::report(node, CO_ERR_OBJ_INIT, initialised.key);
  }
  parts::run<&Part::of_init>(node);
  routes::publish(node);
  return node.Nmt.Next == CO_INIT;
}

// Sends the boot-up message and requests Pre-operational; a node without node-ID stays in Initialisation. [305]
void start(CO_NODE& node) {
  if (!parts::ask<&Part::of_awaits_node_id>(false, node)) {
    nmt::boot(node);
  }
}

// Resets the node. commanded: a reset by the NMT master drops the queued frames; a reset by the application still sends
// the SDO responses among them, as it may have been requested by a write, and NMT commands to other nodes.
void reset(CO_NODE& node, CO_NMT_RESET type, bool commanded) {
  const bool was_initialising = node.Nmt.Mode == CO_INIT;
  const bool waits_for_start = was_initialising && !parts::ask<&Part::of_is_waiting>(false, node);
  commanded ? transmit::clear(node) : transmit::keep_responses(node);
  event::request_mode(node, CO_INIT);
  event::enter_requested_mode(node);
  if (node.Nmt.Mode != CO_INIT) {
    return;
  }
  if (!was_initialising) {
    transmit::drop_behind_responses(node);  // messages of the last state
  }
  port::can_reset(node);
  parts::run<&Part::of_reset>(node);
  const bool is_ready = initialise(node, type);
  event::forget_resets(node);
  if (is_ready && !waits_for_start) {
    start(node);
    event::enter_requested_mode(node);
  }
}

// Runs a deferred reset. pending: bits of event::Pending
void run_reset(CO_NODE& node, uint8_t pending) {
  const bool commanded = (pending & event::commanded) != 0;
  const CO_NMT_RESET type = (pending & event::reset_node) != 0 ? CO_RESET_NODE : CO_RESET_COM;
  if (type == CO_RESET_NODE) {
    parts::run<&Part::of_reset_node>(node);
  }
  reset(node, type, commanded);
  if (commanded && node.Nmt.Mode != CO_INVALID) {
    callback::request_reset(node, type);
  }
}

// Runs the deferred work whose bits are set in what, and the work that it causes. A reset configures everything.
void run_pending(CO_NODE& node, unsigned what) {
  while (node.State == event::running) {
    const unsigned pending = event::runnable(node, what);
    if (pending == 0) {
      return;
    }
    const event::Serving serving(node);
    event::remove(node, pending & ~unsigned{event::messages | event::mode});
    if ((pending & event::configure) != 0 && (pending & event::resets) == 0 && node.Nmt.Next != CO_INVALID) {
      parts::run<&Part::of_configure>(node);
      routes::publish(node);
    }
    event::send_deferred(node);
    if ((pending & event::mode) != 0) {
      event::enter_requested_mode(node);
    }
    if ((pending & event::resets) != 0 && node.Nmt.Mode != CO_INVALID) {
      run_reset(node, static_cast<uint8_t>(pending));
    }
  }
  if (node.State == 0) {  // stopped
    node.Pending = 0;
  }
}

// Returns the error because of which no driver may be called, or CO_ERR_NONE.
CO_ERR check_drivers(const CO_NODE& node, const CO_NODE_SPEC& spec) {
  if (node.Ext != nullptr && node.Ext->Size < sizeof(CO_NODE_EXT)) {
    return CO_ERR_NODE_EXT;
  }
  if (node.If.Can == nullptr) {
    return CO_ERR_NODE_CAN;
  }
  if (node.If.Timer == nullptr) {
    return CO_ERR_NODE_TIMER;
  }
  return spec.TmrFreq == 0 ? CO_ERR_NODE_TMR_FREQ : CO_ERR_NONE;
}

// Returns whether the application has given a length of the SDO servers' buffer that is too short.
bool is_sdo_buffer_short(const CO_NODE& node) {
  constexpr uint32_t needed = USE_SDO_BLOCK != 0 ? CO_SSDO_N * CO_SDO_BUF_BYTE : 0;
  const uint32_t length = needed != 0 && node.SdoBuf != nullptr ? node.Ext->SdoBufLen : 0;
  return length != 0 && length < needed;
}

// Returns the error because of which the node cannot run with drivers that may be called, or CO_ERR_NONE.
CO_ERR check_spec(const CO_NODE& node, const CO_NODE_SPEC& spec) {
  const bool is_unconfigured = USE_LSS != 0 && spec.NodeId == wire::no_node_id;
  if (!wire::is_node_id(spec.NodeId) && !is_unconfigured) {
    return CO_ERR_NODE_ID;
  }
  if (spec.Dict == nullptr || spec.DictLen == 0) {
    return CO_ERR_NODE_DICT;
  }
  return is_sdo_buffer_short(node) ? CO_ERR_NODE_SDO_BUF : CO_ERR_NONE;
}

// Copies the drivers that the extension names.
void take_drivers(CO_IF& cif, const CO_NODE_EXT& ext) {
  cif.Can = ext.Can;
  cif.CanCtx = ext.CanCtx;
  cif.Timer = ext.Timer;
  cif.TimerCtx = ext.TimerCtx;
  cif.Nvm = ext.Nvm;
  cif.NvmCtx = ext.NvmCtx;
}

// Initialises the drivers, the timers and the transmit queue. Where no driver may be called, the node has none.
CO_ERR begin(CO_NODE& node, const CO_NODE_SPEC& spec) {
  const CO_ERR err = check_drivers(node, spec);
  if (err == CO_ERR_NONE) {
    node.Tmr.Freq = spec.TmrFreq;
    port::init(node);
    transmit::init(node);
  } else {
    node.Ext = nullptr;
    node.If.Nvm = nullptr;
  }
  COTmrInit(&node.Tmr, &node, spec.TmrMem, spec.TmrNum, spec.TmrFreq);
  return err != CO_ERR_NONE ? err : check_spec(node, spec);
}

// Clears the node and copies its specification.
void take_over(CO_NODE& node, const CO_NODE_SPEC& spec, const CO_NODE_EXT* ext) {
  node = {};
  node.Ext = ext;
  node.NodeId = spec.NodeId;
  node.Baudrate = spec.Baudrate;
  node.SdoBuf = spec.SdoBuf;
  node.If.Node = &node;
  if (ext != nullptr && ext->Size >= sizeof *ext) {
    take_drivers(node.If, *ext);
  }
  node.Nmt.Node = &node;
  parts::run<&Part::of_take_over>(node, spec);
}

[[gnu::noinline]] void report(CO_NODE& node, CO_CAN_EVENT event) {
  count(node.Count.CanEvents[event]);
  event::report_can(node, event);
  callback::change_can(node, event);
}

// Runs all deferred work, for CONodeProcess(): also the work that is left to the mainline.
#if USE_REAL_TIME
void run_deferred_of_mainline(CO_NODE& node) {
  if ((node.Pending & event::overrun) != 0) {
    const event::Serving serving(node);
    event::remove(node, event::overrun);
    report(node, CO_CAN_OVERRUN);
  }
  run_pending(node, ~unsigned{event::overrun});
}
#else
void run_deferred_of_mainline(CO_NODE& node) { event::run_deferred(node); }
#endif

bool waits_to_send(const CO_NODE& node) { return transmit::is_waiting(node) || node.Paused != 0; }

// Offers frames that the driver has refused to the driver again, then continues block transfers and multiplex PDOs.
void resume_sending(CO_NODE& node) {
  transmit::flush(node);
  if ((USE_SDO_BLOCK != 0 || USE_MPDO != 0) && node.Paused != 0) {
    const event::Serving serving(node);
    parts::on_free(node);
  }
}

// Calls resume_sending() for COTmrProcess(), so that a firmware may call CONodeProcess() for received frames only.
// Where there is a real-time thread, resets are left to CONodeProcess().
[[gnu::noinline]] void resume_sending_between_frames(CO_NODE& node) {
  if (node.State != event::running) {
    return;
  }
  node.Burst = 0;
  if (waits_to_send(node)) {
    resume_sending(node);
    event::run_deferred(node);
  }
}

// Returns false, and counts the frame as malformed, if its DLC is above 15.
[[nodiscard]] bool check_length(CO_NODE& node, CO_IF_FRM& frame) {
  const bool is_valid = wire::normalise_length(frame);
  if (!is_valid) {
    count(node.Count.Malformed);
  }
  return is_valid;
}

void report_error_frame(CO_NODE& node, CO_IF_FRM& frame) {
  if (!port::can_report(node, frame)) {
    count(node.Count.Unclaimed);
  }
}

void dispatch(CO_NODE& node, CO_IF_FRM& frame) {
  if (frame.Identifier > wire::base_ids || frame.DLC > sizeof frame.Data) {
    if (!check_length(node, frame)) {
      return;
    }
    if ((frame.Identifier & CO_IF_FRM_ERROR) != 0) {
      report_error_frame(node, frame);
      return;
    }
    frame.Identifier = wire::normalised(frame.Identifier);
  }
#if CO_ROUTES_SORTED
  const unsigned place = routes::find(node, frame.Identifier & ~CO_IF_FRM_RTR);
  const bool is_claimed = place != routes::nowhere && parts::dispatch(node, frame, place);
#else
  const bool is_claimed = parts::dispatch(node, frame);
#endif
  if (is_claimed) {
    return;
  }
  count(node.Count.Unclaimed);
  if (event::is_allowed(node, CO_NMT_ALLOWED)) {
    callback::receive_frame(node, frame);
  }
}

// Reads the next frame for CONodeProcess(): from the driver or, where there is a real-time thread, from the ring that
// it fills. Returns false if there is none.
bool receive(CO_NODE& node, CO_IF_FRM& frame) {
#if USE_REAL_TIME
  if (port::has_mainline(node)) {
    return CORingGet(node.Ext->Mainline, &frame);
  }
#endif
  if (receive::read(node, frame) <= 0) {
    return false;
  }
  count(node.Count.Received);
  return true;
}

// Reads and drops a received frame in CO_INVALID, so that a loop that processes frames until there is none ends. The
// error that has stopped the node is kept: errors of the driver are not reported. A node that was never initialised has
// no drivers.
void drop_received(CO_NODE& node) {
  if (!port::is_initialised(node) || node.State != 0) {
    return;
  }
  CO_IF_FRM frame = wire::empty_frame();
  if (port::can_read(node, frame) > 0) {
    count(node.Count.Received);
    count(node.Count.Unclaimed);
  }
}

#if USE_REAL_TIME
// Processes a frame in the real-time thread. A frame that the NMT state forbids now is dropped: left to
// CONodeProcess(), it would be processed after newer frames.
void serve_at_once(CO_NODE& node, const CO_IF_FRM& frame, unsigned place) {
  if (place == routes::nowhere || !parts::dispatch(node, frame, place)) {
    count(node.Count.Unclaimed);
  }
}

// Leaves a frame to CONodeProcess(); a frame for which the ring has no space is lost and reported as overrun.
void leave(CO_NODE& node, const CO_IF_FRM& frame) {
  if (!CORingPut(node.Ext->Mainline, &frame)) {
    event::defer(node, event::overrun);
  }
}

// Returns whether a frame is left to CONodeProcess(). place: position of its first route
bool is_for_mainline(const CO_NODE& node, unsigned place) {
  return place == routes::nowhere ? node.Ext->Foreign : !parts::is_real_time(node, place);
}

// Processes a received frame, or leaves it to CONodeProcess().
void share_out(CO_NODE& node, CO_IF_FRM frame) {
  if (!check_length(node, frame)) {
    return;
  }
  if ((frame.Identifier & CO_IF_FRM_ERROR) != 0) {
    leave(node, frame);
    return;
  }
  frame.Identifier = wire::normalised(frame.Identifier);
  const unsigned place = routes::find(node, frame.Identifier & ~CO_IF_FRM_RTR);
  is_for_mainline(node, place) ? leave(node, frame) : serve_at_once(node, frame, place);
}
#endif

// Returns whether the real-time thread has left work to CONodeProcess().
bool is_awaited([[maybe_unused]] const CO_NODE& node) {
#if USE_REAL_TIME
  return port::has_mainline(node) && (node.Pending != 0 || CORingCount(node.Ext->Mainline) != 0);
#else
  return false;
#endif
}

}  // namespace
}  // namespace co::node

namespace co {

void event::run_all_deferred(CO_NODE& node) {
  node::run_pending(node, port::has_mainline(node) ? ~unsigned{of_mainline} : ~0U);
}

void event::end_call(CO_NODE& node, uint8_t before) {
  node.State &= static_cast<uint8_t>(before | ~serving);
  run_deferred(node);
}

void event::send_deferred(CO_NODE& node) { parts::send_deferred(node); }

void node::init(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext, AddDrivers add_drivers) {
  ASSERT_PTR_FATAL(node);
  ASSERT_PTR_FATAL(spec);
  take_over(*node, *spec, ext);
  if (add_drivers != nullptr) {
    add_drivers(node->If, spec->Drv);
  }
  node->Error = begin(*node, *spec);
  if (node->Error != CO_ERR_NONE) {
    return;
  }
  parts::run<&Part::of_begin>(*node);
  if (dict::set_table(node->Dict, *node, spec->Dict, spec->DictLen) != CO_ERR_NONE) {
    error::report(*node, CO_ERR_DICT_INIT, dict::fault_key_of(node->Dict));
    return;
  }
  bool is_entered = false;
  bool initialised = false;
  {
    const event::Serving serving(*node);
    node->Nmt.Next = CO_INIT;
    event::defer(*node, event::mode);
    event::enter_requested_mode(*node);
    is_entered = node->Nmt.Mode == CO_INIT;
    initialised = is_entered && initialise(*node, CO_RESET_NODE);
    event::forget_resets(*node);
  }
  if (dict::stops_node(node->Dict)) {
    event::request_mode(*node, CO_INVALID);
  }
  event::run_deferred(*node);
  if (dict::stops_node(node->Dict)) {
    error::report(*node, CO_ERR_DICT_INIT, dict::fault_key_of(node->Dict));
    return;
  }
  if (!is_entered) {  // CONmtModeChange() has stopped the node
    port::can_close(*node);
  }
  if (!initialised) {
    return;
  }
  check_mandatory_objects(*node);
  port::can_enable(*node, node->Baudrate);
}

}  // namespace co

using namespace co;

extern "C" {

void CONodeInitCtx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) {
  node::init(node, spec, ext, nullptr);
}

void CONodeStart(CO_NODE* node) {
  ASSERT_PTR_FATAL(node);
  if (node->Nmt.Mode == CO_INIT && node->Nmt.Next == CO_INIT && !event::is_serving(*node)) {
    node::start(*node);
  }
  event::run_deferred(*node);
}

void CONodeStop(CO_NODE* node) {
  ASSERT_PTR_FATAL(node);
  event::request_mode(*node, CO_INVALID);
  event::run_deferred(*node);
}

void CONodeProcess(CO_NODE* node) {
  ASSERT_PTR_FATAL(node);
  const port::NodeLock turn(*node);
  if constexpr (USE_REAL_TIME != 0) {
    node::run_deferred_of_mainline(*node);
  }
  if (node->State != event::running) {
    node::drop_received(*node);
    return;
  }
  node->Burst = 0;
  if (node::waits_to_send(*node)) {
    node::resume_sending(*node);
    node::run_deferred_of_mainline(*node);
    if (node->State != event::running) {
      return;
    }
  }
  CO_IF_FRM frame = wire::empty_frame();
  if (!node::receive(*node, frame)) {
    return;
  }
  node->State |= event::serving;
  node::dispatch(*node, frame);
  node->State &= static_cast<uint8_t>(~event::serving);
  node::run_deferred_of_mainline(*node);
}

void COTmrProcess(CO_TMR* tmr) {
  ASSERT_PTR_FATAL(tmr);
  ASSERT_PTR_FATAL(tmr->Node);
  if (tmr::run_locked(*tmr, node::resume_sending_between_frames)) {
    return;
  }
  CO_NODE& node = *tmr->Node;
  // Like waits_to_send(), without a branch; resume_sending_between_frames() tests again.
  const bool waits = USE_FAST_PATHS == 0 || (node.TxQueue.Num | node.Paused) != 0;
  if (waits) {
    node::resume_sending_between_frames(node);
  }
  if (!tmr::has_due(*tmr) || event::is_serving(node)) {
    return;
  }
  if (!waits && node.State == event::running) {
    node.Burst = 0;  // the limit of offer() begins anew
  }
  tmr::run_due(*tmr);
}

#if USE_REAL_TIME
// Keeps the node working throughout, so that deferred work is left to the mainline, except messages. A requested NMT
// state ends the loop, and is entered at the end.
void CONodeRealTime(CO_NODE* node) {
  ASSERT_PTR_FATAL(node);
  const port::NodeLock turn(*node);
  if (!port::has_mainline(*node)) {
    return;
  }
  (void)COTmrService(&node->Tmr);
  if ((node->State & event::running) == 0) {
    node::drop_received(*node);
    return;
  }
  const unsigned ends = node->State == event::running ? unsigned{event::mode} : 0U;  // else the mainline enters it
  {
    const event::Serving serving(*node);
    transmit::flush(*node);
    CO_IF_FRM frame = wire::empty_frame();
    while ((node->Pending & ends) == 0 && receive::read(*node, frame) > 0) {
      count(node->Count.Received);
      node::share_out(*node, frame);
      event::send_deferred(*node);
    }
    tmr::run_real_time(node->Tmr);
  }
  node::run_pending(*node, event::mode);
}
#endif

uint32_t CONodeNextDeadline(CO_NODE* node) {
  ASSERT_PTR_FATAL_ERR(node, UINT32_MAX);
  const port::NodeLock turn(*node);
  if (!port::is_initialised(*node)) {
    return UINT32_MAX;
  }
  if (node::is_awaited(*node)) {
    return 0;
  }
  const uint32_t timers = tmr::next_deadline(*node);
  if (!node::waits_to_send(*node)) {
    return timers;
  }
  if (transmit::is_paced(*node)) {
    return 0;
  }
  const uint32_t retry = tmr::ticks(*node, 1, CO_TMR_UNIT_1MS);
  return retry < timers ? retry : timers;
}

void CONodeCanEvent(CO_NODE* node, CO_CAN_EVENT event) {
  ASSERT_PTR_FATAL(node);
  if (event < CO_CAN_EVENT_NUM && port::is_initialised(*node)) {
    const event::Call call(*node);
    node::report(*node, event);
  }
}

CO_NODE_COUNTERS CONodeGetCounters(const CO_NODE* node) { return node == nullptr ? CO_NODE_COUNTERS{} : node->Count; }

void* CONodeGetUser(const CO_NODE* node) { return node == nullptr || node->Ext == nullptr ? nullptr : node->Ext->User; }

// The symbol contains this library's configuration (lexican/detail/configuration.h); programs that declare the function
// without co_core.h link this alias.
#ifdef CO_CONFIGURED_SYMBOL
void node_init_ctx_plain(CO_NODE*, const CO_NODE_SPEC*, const CO_NODE_EXT*) __asm__("CONodeInitCtx")
    __attribute__((alias(CO_CONFIGURED_SYMBOL("CONodeInitCtx"))));
#endif

}  // extern "C"
