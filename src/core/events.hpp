// SPDX-License-Identifier: Apache-2.0
// What services tell the rest of the node. They do not know one another: the table of node/services.cpp passes it on.
#pragma once

#include "co_core.h"

namespace co::event {

// May the node communicate so? what: CO_…_ALLOWED
[[nodiscard]] inline bool is_allowed(const CO_NODE& node, uint8_t what) { return (node.Nmt.Allowed & what) != 0; }

// Changes the NMT state: the application's callback, the permissions, then every service.
void change_mode(CO_NODE& node, CO_MODE mode);

// CO_NODE.State: CONodeProcess() reads a frame where the node runs and does nothing else.
enum State : uint8_t {
  running = 0x01,   // not in CO_INVALID
  serving = 0x02,   // a frame, a reset, …: what callbacks and type functions ask for waits
  changing = 0x04,  // the NMT state; CONmtModeChange() is asked
};
[[nodiscard]] inline bool is_serving(const CO_NODE& node) { return (node.State & serving) != 0; }

class Serving {
 public:
  [[gnu::always_inline]] explicit Serving(CO_NODE& node) : node_(node), before_(node.State) { node.State |= serving; }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;
  [[gnu::always_inline]] ~Serving() { node_.State &= static_cast<uint8_t>(before_ | ~serving); }

 private:
  CO_NODE& node_;
  uint8_t before_;
};

// Things that wait (CO_NODE.Pending) until the function of the API that has led to them is over; where that is called
// while a frame is processed, until that has been answered.
enum Pending : uint8_t {
  reset_node = 0x01,
  reset_communication = 0x02,
  commanded = 0x04,  // the reset was commanded by the NMT master
  configure_sdo = 0x08,
  remap = 0x10,    // CODictInit() has numbered the entries anew
  overrun = 0x20,  // CONodeRealTime() has lost frames
};
inline void defer(CO_NODE& node, uint8_t what) { node.Pending = static_cast<uint8_t>(node.Pending | what); }

// A reset asked for while the node is being initialised or started is part of that.
inline constexpr uint8_t resets = reset_node | reset_communication | commanded;
inline constexpr uint8_t of_mainline = resets | overrun;
inline void forget_resets(CO_NODE& node) { node.Pending &= static_cast<uint8_t>(~resets); }

// What can go wrong on the bus: an EMCY message with its code, and the bits of the error register. [301:7.2.7]
enum class Fault : uint8_t {
  overrun,     // 8110h
  collision,   // 8150h, somebody has our CAN-ID
  passive,     // 8120h
  heartbeat,   // 8130h, a node is missing
  life_guard,  // 8130h, the NMT master is missing
  recovered,   // 8140h, from bus-off
  pdo_short,   // 8210h
  pdo_long,    // 8220h
#if USE_MPDO
  pdo_unknown,  // 8230h, it names no object
#endif
  sync_length,  // 8240h
  pdo_timeout,  // 8250h
  count
};

// A fault has come, or gone. Whoever says that it has come says that it has gone, or forgets it: each counts. detail:
// third of the manufacturer's bytes, a node-ID or the number of a PDO.
void raise(CO_NODE& node, Fault fault, uint8_t detail);
void resolve(CO_NODE& node, Fault fault, uint8_t detail);
// The same as resolve, without a message: the service does not care any more.
void forget(CO_NODE& node, Fault fault);

// The node has lost the network: bus-off, a node that it monitors, or the NMT master. [301:7.5.2.32]
void lose_communication(CO_NODE& node);

// Returns the NMT state in which the node switches its bit rate: Stopped or Pre-operational by 1029h:1 if it is in
// Operational, otherwise its present state.
[[nodiscard]] CO_MODE mode_for_switch(CO_NODE& node);

// What the CAN controller has reported.
void report_can(CO_NODE& node, CO_CAN_EVENT what);

// A SYNC of the network, or of this node, which produces it. counter: 0 if it has none. [301:7.2.5]
void sync(CO_NODE& node, uint8_t counter);

// The time after a SYNC in which synchronous PDOs may be sent is over. [301:7.5.2.7]
void end_sync_window(CO_NODE& node);

// The application or the network has changed an object whose TPDOs are event-driven (flag A).
void change_object(CO_NODE& node, const CO_OBJ& obj);

// The application gives the node another node-ID.
void change_node_id(CO_NODE& node, uint8_t id);

// The LSS slave is in another state.
void change_lss(CO_NODE& node);

// The network has written an object; a configuration that was verified may no longer be the one. [301:7.5.2.23]
void change_configuration(CO_NODE& node, const CO_OBJ& obj);
inline void write_object([[maybe_unused]] CO_NODE& node, [[maybe_unused]] const CO_OBJ& obj) {
#if USE_PARA
  if (node.Verified != 0) {
    change_configuration(node, obj);
  }
#endif
}

// Does what waits, unless a frame is being processed or the mode is being changed. Every function of the API that may
// lead to something that waits ends so, and nothing else does. Where there is a real-time thread, what belongs to the
// mainline is left to CONodeProcess(), whichever thread has asked for it.
void settle_pending(CO_NODE& node);
[[gnu::always_inline]] inline void settle(CO_NODE& node) {
  if (node.Pending != 0) {
    settle_pending(node);
  }
}

}  // namespace co::event
