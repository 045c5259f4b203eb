// SPDX-License-Identifier: Apache-2.0
/// \file virtual_bus.hpp
/// A simulated, deterministic CAN bus inside a program: any number of nodes and test masters, and fault injection.
///
///     co::VirtualBus bus;
///     co::VirtualBus::Port& port = bus.attach({"node 5"});
///     ext.Can = &co::VirtualBusDriver;  ext.CanCtx = &port;       // CO_NODE_EXT
///
///     co::VirtualBus::Port& master = bus.attach({"master"});      // a port without node, such as a test
///     master.enable(); master.send(frame); while (auto answer = master.read()) { ... }
///
/// The model. A port is on the bus between enable() and close(). Sent frames enter its transmit queue; among the first
/// frames of all ports, the bus transmits the one with the highest priority (CAN arbitration) into the receive queue of
/// every other port (never of its sender). Normally that happens within send(); between hold() and release() frames
/// stay queued, and send() returns 0 when the transmit queue is full, like a controller on a busy bus. Frames with
/// equal identifiers are sent in the order of attach(). Ports with different bit rates do not receive each other's
/// frames; 0 matches every rate. Receive filters (CO_IF_CAN_DRV_EX.Filter) work like those of a controller, unless
/// Options::filter is off. A frame that arrives while the receive queue is full is lost: Port::lost() counts it, and an
/// error frame reports it to the node.
///
/// On a paced bus (pace()) a frame takes as long as on a wire of that bit rate, bit by bit. It needs a time source that
/// a simulation advances from next_due() to next_due(). The next frame is chosen when the bus is idle again, among all
/// that were sent up to that moment; on an idle bus a frame starts at once. It arrives when its last bit has ended; at
/// that time it also leaves the transmit queue, as in a controller. Traffic::time is that moment. A frame that has
/// started ends, even if its sender is closed; but nothing arrives and nothing starts between hold() and release().
/// Copies and delays caused by faults take no time on the wire.
///
/// Faults are rules (class Rule): the frames, the first one, how often, and the fault. Delays need a time source
/// (set_time()). Delayed frames arrive at the first use or poll of the bus after their time: next_due() returns it to a
/// simulation.
///
/// Error frames are coded like those of SocketCAN (class in the identifier with CO_IF_FRM_ERROR, controller state in
/// byte 1).
///
/// Context: one thread. The trace hook and rules may send, inject and add rules; a frame sent by them is queued behind
/// the current one. A rule's match must not clear rules. Owner: the bus owns its ports; it must outlive the nodes at
/// them.
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

/// A simulated CAN bus with fault injection. Not copyable: its ports refer to it.
class VirtualBus {
 public:
  class Port;
  using Time = std::chrono::microseconds;     ///< time since any epoch; never decreases
  static constexpr Time never = Time::max();  ///< later than every frame, see next_due()

  /// Properties of a port.
  struct Options {
    std::string name;           ///< for traces
    std::size_t receive = 512;  ///< frames in the receive queue
    std::size_t transmit = 10;  ///< frames in the transmit queue, the one on the wire included
    bool filter = true;         ///< false: a controller without receive filters
  };

  /// A frame with sender and time.
  struct Traffic {
    CO_IF_FRM frame;       ///< the frame
    const Port* sender;    ///< null: inject()
    Time time;             ///< time of the call of send() (rules), of the arrival (trace)
    bool dropped = false;  ///< trace: a rule has discarded it for all receivers
  };

  /// Fault of a Rule. The rules for refuse, error and bus_off count the calls of send(), the others the frames on the
  /// bus.
  enum class Fault {
    none,       ///< no fault
    refuse,     ///< send() returns 0
    error,      ///< send() returns -1
    bus_off,    ///< send() returns -1, the port is in bus-off, see Port::bus_off()
    drop,       ///< no port receives the frame
    duplicate,  ///< arrives twice
    delay,      ///< arrives Rule::delay later; others overtake it
    reorder,    ///< arrives behind the next frame of the same sender, or after Rule::delay (0: not before that frame)
  };

  /// Fault injection: among the frames for which match returns true (empty: all), the fault affects `times` frames,
  /// starting with number `first` (1, 2, …). If several rules apply to a frame, the oldest one decides; every rule
  /// counts the frame.
  struct Rule {
    Fault fault = Fault::none;                       ///< fault of the affected frames
    std::function<bool(const Traffic&)> match = {};  ///< selects the frames that are counted; empty: all
    std::uint32_t first = 1;                         ///< number of the first affected frame, from 1 on
    std::uint32_t times = 1;                         ///< number of affected frames
    Time delay{0};                                   ///< for Fault::delay and Fault::reorder
  };
  static constexpr std::uint32_t always = UINT32_MAX;  ///< for Rule::times

  /// Constructs a bus without ports and rules.
  VirtualBus();
  /// Destroys the bus and its ports. No node may use them any more.
  ~VirtualBus();
  VirtualBus(const VirtualBus&) = delete;
  VirtualBus& operator=(const VirtualBus&) = delete;

  /// Adds a port. Returns it; it is off the bus, and the bus owns it.
  Port& attach(Options options);
  /// Adds a port with default options and no name.
  Port& attach();

  /// Sends a frame from outside to all ports, at every bit rate. Error frames are reported to all ports.
  void inject(const CO_IF_FRM& frame);

  /// Sets the function that is called for every frame, in the order of the bus; empty: none is called.
  void set_trace(std::function<void(const Traffic&)> trace);
  /// Sets the time source, for delays and for a paced bus, for example VirtualClock::time(). It must never decrease.
  void set_time(std::function<Time()> source);
  /// Returns the time of the time source; 0 if there is none.
  Time now() const;
  /// Enables the timing of a wire; needs a time source, and no frame may be queued. \a bit_rate: bit/s, 0: frames take
  /// no time.
  void pace(std::uint32_t bit_rate);

  /// Adds a rule. Returns its number for struck().
  std::size_t add_rule(Rule rule);
  /// Returns the number of frames that a rule has affected; 0 if there is no such rule.
  std::uint32_t struck(std::size_t rule) const;
  /// Removes all rules. Frames that are already delayed still arrive.
  void clear_rules();

  /// Stops the bus: frames stay in the transmit queues of their ports until release().
  void hold();
  /// Ends hold() and transmits the queued frames.
  void release();

  /// Transmits and delivers the frames that are due. send() and Port::read() do so, too.
  void poll();
  /// Returns the time at which the next delayed or paced frame arrives; never if there is none.
  Time next_due() const;

  /// Returns an error frame. \a error_class: CAN_ERR_… of linux/can/error.h; \a controller: its CAN_ERR_CRTL_… .
  static CO_IF_FRM error_frame(std::uint32_t error_class, std::uint8_t controller = 0);

 private:
  struct CountedRule {
    Rule rule;
    std::uint32_t seen = 0;    // frames for which match returned true
    std::uint32_t struck = 0;  // frames that the fault has affected
  };
  // A frame that a rule for Fault::delay or Fault::reorder has postponed.
  struct DelayedFrame {
    CO_IF_FRM frame;
    const Port* sender;
    Time due;
    bool behind_next;  // reorder: arrives after the next frame of the sender
  };
  // The frame on the wire of a paced bus.
  struct OnWire {
    CO_IF_FRM frame;
    const Port* sender;
  };
  enum class Phase { send, bus };  // rules that count calls of send(), or frames on the bus

  const Rule* apply_rules(const Traffic& traffic, Phase phase);
  Port* arbitration_winner() const;
  CO_IF_FRM remove_first(Port& port);
  void transmit_due();
  void transmit_unpaced();
  void transmit_paced();
  bool start_frame();
  Time start_of_frame() const;
  Time next_arrival() const;
  void start_due_frames();
  void transmit(const CO_IF_FRM& frame, const Port* sender);
  void delay_frame(const CO_IF_FRM& frame, const Port* sender, const Rule& rule);
  void deliver(const CO_IF_FRM& frame, const Port* sender);
  void trace_frame(const CO_IF_FRM& frame, const Port* sender, bool dropped) const;
  void deliver_due();
  void deliver_reordered(const Port* sender);
  void deliver_if(const std::function<bool(const DelayedFrame&)>& ready);
  const Port* sender_for_traffic(const Port& port) const;

  std::deque<CountedRule> rules_;
  std::vector<std::unique_ptr<Port>> ports_;
  std::unique_ptr<Port> injector_;     // sender of the frames of inject()
  std::vector<DelayedFrame> delayed_;  // ordered by due time, then by time of sending
  std::function<void(const Traffic&)> trace_;
  std::function<Time()> source_;
  std::optional<PacedWire> wire_;  // set on a paced bus
  std::optional<OnWire> on_wire_;
  Time not_before_{0};  // earliest next start of frame
  bool held_ = false;
  bool running_ = false;
};

/// A controller at the bus: the context of VirtualBusDriver, or used directly by a test.
class VirtualBus::Port {
 public:
  /// Constructs a port off the bus. Use VirtualBus::attach(), which also adds it to the bus.
  Port(VirtualBus& bus, Options options);

  /// Goes on the bus with empty queues. \a baud: bit/s; 0: communicates with ports of every bit rate.
  void enable(std::uint32_t baud = 0);
  /// Goes off the bus and discards both queues.
  void close();
  /// Empties the queues and ends bus-off. Filters stay.
  void reset();
  /// Queues a frame for transmission.
  /// \retval sizeof(CO_IF_FRM)  the frame is queued or sent
  /// \retval 0                  the transmit queue is full, or a rule has refused the frame
  /// \retval -1                 the port is off the bus, in bus-off, or a rule applies
  std::int16_t send(const CO_IF_FRM& frame);
  /// Removes the next frame from the receive queue. Returns it, or nothing if the queue is empty. Lost frames are
  /// reported first, by an error frame.
  std::optional<CO_IF_FRM> read();
  /// Sets the identifiers that the port receives. \a ids: \a num identifiers with CO_IF_FRM_EXT, in any order.
  void filter(const std::uint32_t* ids, std::uint16_t num);

  /// Simulates a report of the controller: puts an error frame into the receive queue.
  void report(const CO_IF_FRM& error);
  /// Simulates bus-off and reports it. The port neither sends nor receives until recover() or reset().
  void bus_off();
  /// Simulates the end of bus-off and reports it.
  void recover();

  /// Returns the name given to attach().
  const std::string& name() const { return options_.name; }
  /// Returns true between enable() and close(), also in bus-off.
  bool enabled() const { return enabled_; }
  /// Returns the bit rate of the last enable() in bit/s; 0: every bit rate.
  std::uint32_t baud() const { return baud_; }
  /// Returns the number of frames lost because the receive queue was full.
  std::uint32_t lost() const { return lost_; }
  /// Returns the number of frames in the receive queue.
  std::size_t waiting() const { return receive_.size(); }
  /// Returns the identifiers set by filter(), ascending; empty before its first call.
  const std::vector<std::uint32_t>& accepted() const { return accepted_; }
  /// Returns whether filter() was called; before, the port receives all frames.
  bool filtered() const { return filtered_; }

 private:
  friend class VirtualBus;
  bool active() const { return enabled_ && !bus_off_; }
  std::size_t occupied() const;
  bool receives_from(const Port& sender) const;
  bool accepts(const CO_IF_FRM& frame) const;
  void receive(const CO_IF_FRM& frame);
  void clear_queues();

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
  bool overrun_ = false;  // a lost frame is not yet reported
};

/// The driver; its context is a VirtualBus::Port.
inline constexpr const CO_IF_CAN_DRV_EX& VirtualBusDriver = COVirtualBusDriver;

}  // namespace co

#endif
