// SPDX-License-Identifier: Apache-2.0
/// \file virtual_bus.hpp
/// A CAN bus inside a program: any number of nodes and test masters, faults on demand, the same result in every run.
///
///     co::VirtualBus bus;
///     co::VirtualBus::Port& port = bus.attach({"node 5"});
///     ext.Can = &co::VirtualBusDriver;  ext.CanCtx = &port;       // CO_NODE_EXT
///
///     co::VirtualBus::Port& master = bus.attach({"master"});      // a test, a master, a tap: the same port without
///     node master.enable(); master.send(frame); while (auto answer = master.read()) { ... }
///
/// The model. A port takes part between enable() and close(). What it sends waits in its transmit queue; of the first
/// frames of all ports, the one with the highest priority in the sense of CAN arbitration goes over the bus and into
/// the receive queue of every other port (never of its sender). Normally that happens within send(); between hold() and
/// release() frames pile up, and send() returns 0 when the transmit queue is full, as a controller does on a busy bus.
/// Equal identifiers go in the order of attach(). Ports with different bit rates do not hear each other; 0 fits every
/// rate. Receive filters (CO_IF_CAN_DRV_EX.Filter) are honoured as by hardware, unless Options::filter is off.
/// A full receive queue loses the frame: counted by Port::lost(), and reported to the node by an error frame.
///
/// On a paced bus (pace()) a frame takes as long as on a wire of that bit rate, bit by bit. It needs a time source that
/// a simulation advances from next_due() to next_due(). The next frame is chosen when the bus is free again, among all
/// that were sent up to that moment; one on an idle bus starts at once. It arrives when its last bit is over, and its
/// place in the transmit queue is free then, as in a controller; Traffic::time is that moment. A frame that has started
/// ends, whatever becomes of its sender, but nothing arrives and nothing starts between hold() and release(). What
/// faults add (a second copy, a late arrival) takes no time on the wire.
///
/// Faults are rules (class Rule): which frames, from which one on, how often, and what happens. Delays need a time
/// source (set_time()). Delayed frames arrive when their time has come and the bus is used or polled: next_due() tells
/// a simulation when that is.
///
/// Error frames are coded as in SocketCAN (class in the identifier with CO_IF_FRM_ERROR, controller state in byte 1).
///
/// Context: one thread. The trace hook and rules may send, inject and add rules; a frame sent by them takes its turn
/// after the current one. A rule's match must not clear rules. Owner: the bus owns its ports; it must outlive the nodes
/// at them.
#ifndef CO_DRIVERS_VIRTUAL_BUS_HPP_
#define CO_DRIVERS_VIRTUAL_BUS_HPP_

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "co_can_virtual.h"
#include "paced_wire.hpp"

namespace co {

class VirtualBus {
 public:
  class Port;
  using Time = std::chrono::microseconds;  ///< since any moment; never goes back
  static constexpr Time never = Time::max();

  struct Options {
    std::string name;           ///< for traces
    std::size_t receive = 512;  ///< frames in the receive queue
    std::size_t transmit = 10;  ///< frames in the transmit queue, the one on the wire included
    bool filter = true;         ///< false: a controller without receive filters
  };

  /// A frame with its circumstances.
  struct Traffic {
    CO_IF_FRM frame;
    const Port* sender;    ///< null: inject()
    Time time;             ///< of the attempt to send (rules), on the bus (trace)
    bool dropped = false;  ///< trace: a rule kept it from all receivers
  };

  enum class Fault {
    none,
    // Seen by the sender; counted per call of send().
    refuse,   ///< send() returns 0
    error,    ///< send() returns -1
    bus_off,  ///< send() returns -1, the port is in bus-off, see Port::bus_off()
    // Seen by the receivers; counted per frame on the bus.
    drop,
    duplicate,  ///< arrives twice
    delay,      ///< arrives Rule::delay later; others overtake it
    reorder,    ///< arrives behind the next frame of the same sender, or after Rule::delay (0: not before that frame)
  };

  /// Of the frames for which match is true (empty: all), those from number first (1, 2, …) on suffer the fault, as many
  /// as times says. Where several rules apply to a frame, the oldest decides; every rule counts the frame.
  struct Rule {
    Fault fault = Fault::none;
    std::function<bool(const Traffic&)> match = {};
    std::uint32_t first = 1;
    std::uint32_t times = 1;
    Time delay{0};
  };
  static constexpr std::uint32_t always = UINT32_MAX;  ///< for Rule::times

  VirtualBus();
  ~VirtualBus();
  VirtualBus(const VirtualBus&) = delete;
  VirtualBus& operator=(const VirtualBus&) = delete;

  /// A new port, off the bus.
  Port& attach(Options options);
  Port& attach();

  /// Sends a frame from outside: to all ports, whatever their bit rate. Error frames are reported to all ports.
  void inject(const CO_IF_FRM& frame);

  /// Called for every frame on the bus, in the order of the bus.
  void set_trace(std::function<void(const Traffic&)> trace);
  void set_time(std::function<Time()> source);
  Time now() const;
  /// From now on frames take their time on the wire; no frame may be waiting. \a bit_rate: bit/s, 0: no longer.
  void pace(std::uint32_t bit_rate);

  /// Returns a number for struck().
  std::size_t add_rule(Rule rule);
  /// Frames that have suffered from a rule.
  std::uint32_t struck(std::size_t rule) const;
  /// Forgets all rules. Frames that are already delayed still arrive.
  void clear_rules();

  void hold();
  void release();

  /// Delivers what is due.
  void poll();
  /// When the next delayed or paced frame arrives; never if none is due by time.
  Time next_due() const;

  /// An error frame. \a error_class: CAN_ERR_… of linux/can/error.h; \a controller: its CAN_ERR_CRTL_… .
  static CO_IF_FRM error_frame(std::uint32_t error_class, std::uint8_t controller = 0);

 private:
  struct CountedRule {
    Rule rule;
    std::uint32_t seen = 0;
    std::uint32_t struck = 0;
  };
  struct Late {
    CO_IF_FRM frame;
    const Port* sender;
    Time due;
    bool behind_next;  // reorder: waits for the next frame of the sender
  };
  struct OnWire {
    CO_IF_FRM frame;
    const Port* sender;
  };
  enum class Phase { send, bus };

  const Rule* strike(const Traffic& traffic, Phase phase);
  Port* winner() const;
  CO_IF_FRM take_from(Port& port);
  void run();
  void run_at_once();
  void run_paced();
  bool start_frame();
  Time start_of_frame() const;
  Time next_arrival() const;
  void catch_up();
  void transmit(const CO_IF_FRM& frame, const Port* sender);
  void postpone(const CO_IF_FRM& frame, const Port* sender, const Rule& rule);
  void deliver(const CO_IF_FRM& frame, const Port* sender);
  void trace(const CO_IF_FRM& frame, const Port* sender, bool dropped) const;
  void deliver_due();
  void deliver_reordered(const Port* sender);
  void deliver_first(const std::function<bool(const Late&)>& ready);
  const Port* visible(const Port& port) const;

  std::deque<CountedRule> rules_;
  std::vector<std::unique_ptr<Port>> ports_;
  std::unique_ptr<Port> outside_;
  std::vector<Late> late_;  // by due, equal ones in the order of sending
  std::function<void(const Traffic&)> trace_;
  std::function<Time()> source_;
  std::optional<PacedWire> wire_;  // of a paced bus
  std::optional<OnWire> on_wire_;
  Time not_before_{0};  // the next start of frame
  bool held_ = false;
  bool running_ = false;
};

/// A controller at the bus: the context of VirtualBusDriver, or the hand of a test.
class VirtualBus::Port {
 public:
  Port(VirtualBus& bus, Options options);

  /// Goes on the bus with empty queues. \a baud: bit/s, 0: hears and is heard at every rate.
  void enable(std::uint32_t baud = 0);
  /// Goes off the bus; what waits to be sent or read is lost.
  void close();
  /// Empties the queues and ends bus-off. Filters stay.
  void reset();
  /// sizeof(CO_IF_FRM): taken; 0: transmit queue full, or refused by a rule; -1: off the bus, bus-off, or by a rule.
  std::int16_t send(const CO_IF_FRM& frame);
  std::optional<CO_IF_FRM> read();
  /// The identifiers (with flags) to be received from now on.
  void filter(const std::uint32_t* ids, std::uint16_t num);

  /// The controller reports something: puts an error frame into the receive queue.
  void report(const CO_IF_FRM& error);
  /// The controller goes into bus-off and reports it. It neither sends nor receives until recover() or reset().
  void bus_off();
  /// The controller is restarted and reports it.
  void recover();

  const std::string& name() const { return options_.name; }
  bool enabled() const { return enabled_; }
  std::uint32_t baud() const { return baud_; }
  /// Frames that found the receive queue full.
  std::uint32_t lost() const { return lost_; }
  /// Frames in the receive queue.
  std::size_t waiting() const { return receive_.size(); }
  /// What filter() was told last, ascending; empty and filtered() false before.
  const std::vector<std::uint32_t>& accepted() const { return accepted_; }
  bool filtered() const { return filtered_; }

 private:
  friend class VirtualBus;
  bool active() const { return enabled_ && !bus_off_; }
  std::size_t occupied() const;
  bool hears(const Port& sender) const;
  bool accepts(const CO_IF_FRM& frame) const;
  void receive(const CO_IF_FRM& frame);
  void empty();

  VirtualBus& bus_;
  Options options_;
  std::deque<CO_IF_FRM> transmit_;
  std::deque<CO_IF_FRM> receive_;
  std::vector<std::uint32_t> accepted_;
  std::uint32_t baud_ = 0;
  std::uint32_t lost_ = 0;
  bool enabled_ = false;
  bool bus_off_ = false;
  bool filtered_ = false;
  bool overrun_ = false;  // not yet reported
};

/// The driver; its context is a VirtualBus::Port.
inline constexpr const CO_IF_CAN_DRV_EX& VirtualBusDriver = COVirtualBusDriver;

}  // namespace co

#endif
