// SPDX-License-Identifier: Apache-2.0
// Events that a part passes to the rest of the node. Parts do not call each other: the table of node/parts.hpp
// passes events on.
#pragma once

#include "co_core.h"

namespace co::event {

// Returns whether the NMT state allows the communication. what: CO_…_ALLOWED
[[nodiscard]] inline bool is_allowed(const CO_NODE& node, uint8_t what) { return (node.Nmt.Allowed & what) != 0; }

// Requests an NMT state: run_deferred() enters it. The last request counts; CO_INVALID (CONodeStop()) is final.
void request_mode(CO_NODE& node, CO_MODE requested);
// Enters the requested NMT state: calls the application's callback, sets the permissions, then informs every part.
// The caller keeps the node working.
void enter_requested_mode(CO_NODE& node);

// Bits of CO_NODE.State. CONodeProcess() processes a frame only where running is set and nothing else.
enum State : uint8_t {
  running = 0x01,  // the NMT state is not CO_INVALID
  working = 0x02,  // a frame, a timer of the stack, an access, … is processed: requests are deferred
};
[[nodiscard]] inline bool is_working(const CO_NODE& node) { return (node.State & working) != 0; }

// Scope in which the node works. Scopes may nest.
class Working {
 public:
  [[gnu::always_inline]] explicit Working(CO_NODE& node) : node_(node), before_(node.State) { node.State |= working; }
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;
  [[gnu::always_inline]] ~Working() { node_.State &= static_cast<uint8_t>(before_ | ~working); }

 private:
  CO_NODE& node_;
  uint8_t before_;
};

// Reasons why transmission is disabled (bits of CO_NODE.Transmit.Off).
enum TransmitOff : uint8_t {
  switching = 0x01,  // the LSS slave or master switches the bit rate
  stopping = 0x02,   // CONodeStop() was called
};
inline void end_switching(CO_NODE& node) { node.Transmit.Off = static_cast<uint8_t>(node.Transmit.Off & stopping); }

// Deferred work (bits of CO_NODE.Pending). It runs at the end of the API function that has caused it; if that was
// called while the node works, where the outermost call ends. Order: configuration, EMCY messages, TPDOs, NMT state,
// resets.
enum Pending : uint16_t {
  reset_node = 0x01,
  reset_communication = 0x02,
  commanded = 0x04,  // the reset was commanded by the NMT master
  configure = 0x08,  // parameters of SDO servers, SDO clients or PDOs were changed, or SRDOs were ended by CODictInit()
  write_register = 0x10,  // the error register differs from 1001h; send_emcy is set, too
  mode = 0x20,            // CO_NMT.Next was requested
  send_emcy = 0x40,       // EMCY messages are queued, or write_register is set
  send_tpdos = 0x80,      // event-driven TPDOs are marked; not while OdLock is held
  overrun = 0x100,        // CONodeRealTime() has lost frames
};
// Adds deferred work. what: bits of Pending
inline void defer(CO_NODE& node, unsigned what) { node.Pending = static_cast<uint16_t>(node.Pending | what); }
// Removes deferred work that is about to run.
inline void remove(CO_NODE& node, unsigned what) { node.Pending = static_cast<uint16_t>(node.Pending & ~what); }

// Returns the deferred work that may run now, of that in what: TPDOs are not sent while OdLock is held.
[[nodiscard]] inline unsigned runnable(const CO_NODE& node, unsigned what) {
  const unsigned held = node.OdLocked != 0 ? unsigned{send_tpdos} : 0U;
  return node.Pending & what & ~held;
}

// Resets that are requested while the node is being initialised or started are dropped (forget_resets()): the
// initialisation in progress includes them.
inline constexpr uint8_t resets = reset_node | reset_communication | commanded;
// Work that the thread which has requested it runs, also a real-time thread.
inline constexpr uint8_t messages = write_register | send_emcy | send_tpdos;
// Work that is deferred until CONodeProcess() where there is a real-time thread (CO_NODE_EXT.Mainline).
inline constexpr uint16_t of_mainline = resets | overrun;
inline void forget_resets(CO_NODE& node) { remove(node, resets); }

// Communication faults, each with an EMCY error code (lexican/detail/faults.h).
enum class Fault : uint8_t {
#define CO_NAME(fault, code, led) fault,
  CO_FAULTS(CO_NAME)
#undef CO_NAME
};

// Change of a fault.
enum class Change : uint8_t {
  ended,
  occurred,
  forgotten  // ended without an EMCY message: the service has stopped to monitor the fault
};

// Reports a change of a fault. Faults are counted: each that has occurred must end or be forgotten exactly once.
// detail: third to fifth byte of the manufacturer-specific error field of the EMCY message, a node-ID, the number of a
// PDO, or an index and a byte.
void change_fault(CO_NODE& node, Fault fault, Change change, uint32_t detail);
inline void raise(CO_NODE& node, Fault fault, uint32_t detail) { change_fault(node, fault, Change::occurred, detail); }
inline void resolve(CO_NODE& node, Fault fault, uint32_t detail) { change_fault(node, fault, Change::ended, detail); }
inline void forget(CO_NODE& node, Fault fault) { change_fault(node, fault, Change::forgotten, 0); }

// Reports that the node has lost the network: by bus-off, or because a monitored node or the NMT master is missing.
// Changes the NMT state by 1029h. [301:7.5.2.32]
void lose_communication(CO_NODE& node);

// Returns the NMT state in which the node switches its bit rate: Stopped or Pre-operational by 1029h:1 if it is in
// Operational, otherwise its present state.
[[nodiscard]] CO_MODE mode_for_switch(CO_NODE& node);

// Reports an event of the CAN controller.
void report_can(CO_NODE& node, CO_CAN_EVENT what);

// Reports a SYNC that was received or, by the producer, transmitted. counter: 0 if the SYNC has none. [301:7.2.5]
void sync(CO_NODE& node, uint8_t counter);

// Reports the end of the synchronous window, the time after a SYNC in which synchronous PDOs may be transmitted.
// [301:7.5.2.7]
void end_sync_window(CO_NODE& node);

// Reports that the application or the network has changed an object whose TPDOs are event-driven (flag A): marks the
// TPDOs, which run_deferred() sends.
void change_object(CO_NODE& node, const CO_OBJ& obj);

// Whether a TPDO could transmit the value of an object now.
enum class Outlet : uint8_t {
  none,    // no TPDO maps the object
  closed,  // not in Operational
  queued,  // the last frame of the TPDO is queued: a newer one would replace it
  full,    // the transmit queue is full
  open
};
[[nodiscard]] Outlet find_outlet(CO_NODE& node, const CO_OBJ& obj);

// Sets the node-ID that the application has chosen.
void change_node_id(CO_NODE& node, uint8_t id);

// Sets a new bit rate of the CAN controller, in bit/s; its filters are kept. [305]
void set_bit_rate(CO_NODE& node, uint32_t rate);

// Reports that the state of the LSS slave has changed.
void change_lss(CO_NODE& node);

// Reports that the network has written an object: the configuration may differ from the verified one. [301:7.5.2.23]
inline void write_object([[maybe_unused]] CO_NODE& node, [[maybe_unused]] const CO_OBJ& obj) {
#if USE_PARA
  if (node.Storage.OnWrite != nullptr) {
    node.Storage.OnWrite(&node, &obj);
  }
#endif
}

// Runs deferred work, unless the node is working. Every API function that may cause deferred work ends with
// run_deferred(), and so does each timer action. Where there is a real-time thread, the work of the mainline
// (of_mainline) is left to CONodeProcess(), whichever thread has requested it.
void run_all_deferred(CO_NODE& node);
// Ends a Call. before: CO_NODE.State at its begin
void end_call(CO_NODE& node, uint8_t before);
// Sends the deferred messages, also while the node works: before the NMT state is changed, and in CONodeRealTime()
// after each frame and each timer action.
void send_deferred(CO_NODE& node);
[[gnu::always_inline]] inline void run_deferred(CO_NODE& node) {
  if (node.Pending != 0) {
    run_all_deferred(node);
  }
}

// Scope of an API function that may call functions of the application: the node works, and at the end runs deferred
// work if this is the outermost call.
class Call {
 public:
  [[gnu::always_inline]] explicit Call(CO_NODE& node) : node_(node), before_(node.State) { node.State |= working; }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;
  [[gnu::always_inline]] ~Call() {
    if constexpr (USE_FAST_PATHS != 0) {
      node_.State &= static_cast<uint8_t>(before_ | ~working);
      run_deferred(node_);
    } else {
      end_call(node_, before_);
    }
  }

 private:
  CO_NODE& node_;
  uint8_t before_;
};

}  // namespace co::event
