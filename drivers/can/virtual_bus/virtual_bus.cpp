// SPDX-License-Identifier: Apache-2.0
#include "virtual_bus.hpp"

#include <algorithm>
#include <utility>

namespace co {
namespace {

// Error codes of SocketCAN, defined here because this driver also runs on hosts without Linux.
constexpr std::uint32_t error_controller = 0x004;
constexpr std::uint32_t error_bus_off = 0x040;
constexpr std::uint32_t error_restarted = 0x100;
constexpr std::uint8_t controller_rx_overflow = 0x01;
constexpr std::uint8_t error_dlc = 8;

bool is_error(const CO_IF_FRM& frame) { return (frame.Identifier & CO_IF_FRM_ERROR) != 0; }

// Returns the bits of the arbitration field in the order of transmission; the lower value wins. [ISO 11898-1]
//   11-bit identifier: base ID, RTR, IDE = 0;  29-bit: base ID, SRR = 1, IDE = 1, ID extension, RTR
std::uint32_t arbitration(const CO_IF_FRM& frame) {
  const std::uint32_t rtr = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? 1 : 0;
  const std::uint32_t id = frame.Identifier & CO_IF_FRM_ID;
  if ((frame.Identifier & CO_IF_FRM_EXT) == 0) {
    return ((id & 0x7FF) << 21) | (rtr << 20);
  }
  return ((id >> 18) << 21) | (3u << 19) | ((id & 0x3FFFF) << 1) | rtr;
}

// Returns true for faults that are results of send().
bool is_result_of_send(VirtualBus::Fault fault) {
  return fault == VirtualBus::Fault::refuse || fault == VirtualBus::Fault::error || fault == VirtualBus::Fault::bus_off;
}

}  // namespace

VirtualBus::VirtualBus() : injector_(std::make_unique<Port>(*this, Options{"outside", 0, SIZE_MAX, false})) {
  injector_->enable();
}

VirtualBus::~VirtualBus() = default;

VirtualBus::Port& VirtualBus::attach(Options options) {
  ports_.push_back(std::make_unique<Port>(*this, std::move(options)));
  return *ports_.back();
}

VirtualBus::Port& VirtualBus::attach() { return attach(Options{}); }

void VirtualBus::inject(const CO_IF_FRM& frame) {
  if (!is_error(frame)) {
    injector_->send(frame);
    return;
  }
  for (const auto& port : ports_) {
    port->report(frame);
  }
}

void VirtualBus::set_trace(std::function<void(const Traffic&)> trace) { trace_ = std::move(trace); }

void VirtualBus::set_time(std::function<Time()> source) { source_ = std::move(source); }

VirtualBus::Time VirtualBus::now() const { return source_ ? source_() : Time{0}; }

std::size_t VirtualBus::add_rule(Rule rule) {
  rules_.push_back({std::move(rule)});
  return rules_.size() - 1;
}

std::uint32_t VirtualBus::struck(std::size_t rule) const { return rule < rules_.size() ? rules_[rule].struck : 0; }

void VirtualBus::clear_rules() { rules_.clear(); }

void VirtualBus::pace(std::uint32_t bit_rate) {
  wire_.reset();
  if (bit_rate != 0) {
    wire_.emplace(bit_rate);
  }
}

void VirtualBus::hold() { held_ = true; }

void VirtualBus::release() {
  held_ = false;
  not_before_ = now();
  transmit_due();
}

void VirtualBus::poll() { transmit_due(); }

VirtualBus::Time VirtualBus::next_due() const {
  return std::min(delayed_.empty() ? never : delayed_.front().due, next_arrival());
}

CO_IF_FRM VirtualBus::error_frame(std::uint32_t error_class, std::uint8_t controller) {
  return {CO_IF_FRM_ERROR | (error_class & CO_IF_FRM_ID), {0, controller, 0, 0, 0, 0, 0, 0}, error_dlc};
}

// Counts a frame in all rules of a phase that match it. Returns the rule whose fault affects the frame; null: none.
const VirtualBus::Rule* VirtualBus::apply_rules(const Traffic& traffic, Phase phase) {
  CountedRule* decides = nullptr;
  for (std::size_t i = 0; i < rules_.size(); ++i) {  // by index: a match may add rules
    CountedRule& counted = rules_[i];
    const Rule& rule = counted.rule;
    if (is_result_of_send(rule.fault) != (phase == Phase::send) || (rule.match && !rule.match(traffic))) {
      continue;
    }
    ++counted.seen;
    const bool applies = counted.seen >= rule.first && counted.seen - rule.first < rule.times;
    if (applies && decides == nullptr) {
      decides = &counted;
    }
  }
  if (decides == nullptr) {
    return nullptr;
  }
  ++decides->struck;
  return &decides->rule;
}

// Returns the port whose first frame wins the arbitration; null if no frame is queued.
VirtualBus::Port* VirtualBus::arbitration_winner() const {
  Port* best = injector_->transmit_.empty() ? nullptr : injector_.get();
  for (const auto& port : ports_) {
    if (port->transmit_.empty()) {
      continue;
    }
    if (best == nullptr || arbitration(port->transmit_.front()) < arbitration(best->transmit_.front())) {
      best = port.get();
    }
  }
  return best;
}

// Transmits and delivers everything that is due. Has no effect when it is called by a trace hook or rule, whose frames
// the outer call transmits.
void VirtualBus::transmit_due() {
  if (held_ || running_) {
    return;
  }
  running_ = true;
  deliver_due();
  if (wire_) {
    transmit_paced();
  } else {
    transmit_unpaced();
  }
  running_ = false;
}

void VirtualBus::transmit_unpaced() {
  for (Port* port = arbitration_winner(); port != nullptr && !held_; port = arbitration_winner()) {
    transmit(remove_first(*port), port);
  }
}

void VirtualBus::transmit_paced() {
  while (!held_ && (on_wire_ || start_frame()) && wire_->received() <= now()) {
    const OnWire over = *on_wire_;
    on_wire_.reset();
    transmit(over.frame, over.sender);
  }
}

// Does not start a frame at now(): all frames sent at that time take part in the arbitration.
bool VirtualBus::start_frame() {
  Port* const port = arbitration_winner();
  if (port == nullptr || start_of_frame() >= now()) {
    return false;
  }
  const Time start = start_of_frame();
  on_wire_ = OnWire{remove_first(*port), port};
  wire_->occupy(start, frame_bits(on_wire_->frame));
  return true;
}

CO_IF_FRM VirtualBus::remove_first(Port& port) {
  const CO_IF_FRM frame = port.transmit_.front();
  port.transmit_.pop_front();
  return frame;
}

VirtualBus::Time VirtualBus::start_of_frame() const { return std::max(wire_->free(), not_before_); }

VirtualBus::Time VirtualBus::next_arrival() const {
  if (!wire_ || held_) {
    return never;
  }
  if (on_wire_) {
    return wire_->received();
  }
  const Port* const port = arbitration_winner();
  if (port == nullptr) {
    return never;
  }
  PacedWire then = *wire_;
  then.occupy(start_of_frame(), frame_bits(port->transmit_.front()));
  return then.received();
}

// Called before the queue of a port changes: starts the frames that were due, so that none starts in the past.
void VirtualBus::start_due_frames() {
  if (wire_) {
    transmit_due();
    not_before_ = now();
  }
}

void VirtualBus::transmit(const CO_IF_FRM& frame, const Port* sender) {
  const Rule* const rule = apply_rules({frame, sender_for_traffic(*sender), now()}, Phase::bus);
  const Fault fault = (rule != nullptr) ? rule->fault : Fault::none;
  if (fault == Fault::delay || fault == Fault::reorder) {
    delay_frame(frame, sender, *rule);
    return;
  }
  if (fault == Fault::drop) {
    trace_frame(frame, sender, true);
  } else {
    deliver(frame, sender);
  }
  if (fault == Fault::duplicate) {
    deliver(frame, sender);
  }
  deliver_reordered(sender);
}

void VirtualBus::delay_frame(const CO_IF_FRM& frame, const Port* sender, const Rule& rule) {
  const bool behind_next = rule.fault == Fault::reorder;
  const Time due = (behind_next && rule.delay == Time{0}) ? never : now() + rule.delay;
  const auto after = std::upper_bound(delayed_.begin(), delayed_.end(), due,
                                      [](Time time, const DelayedFrame& delayed) { return time < delayed.due; });
  delayed_.insert(after, {frame, sender, due, behind_next});
}

void VirtualBus::deliver(const CO_IF_FRM& frame, const Port* sender) {
  trace_frame(frame, sender, false);
  for (const auto& port : ports_) {
    if (port.get() != sender && port->receives_from(*sender)) {
      port->receive(frame);
    }
  }
}

void VirtualBus::trace_frame(const CO_IF_FRM& frame, const Port* sender, bool dropped) const {
  if (trace_) {
    trace_({frame, sender_for_traffic(*sender), now(), dropped});
  }
}

void VirtualBus::deliver_due() {
  deliver_if([this](const DelayedFrame& delayed) { return delayed.due != never && delayed.due <= now(); });
}

void VirtualBus::deliver_reordered(const Port* sender) {
  deliver_if([sender](const DelayedFrame& delayed) { return delayed.behind_next && delayed.sender == sender; });
}

// Searches again after every delivery: the trace hook may have added rules or advanced the time.
void VirtualBus::deliver_if(const std::function<bool(const DelayedFrame&)>& ready) {
  for (auto it = std::find_if(delayed_.begin(), delayed_.end(), ready); it != delayed_.end();
       it = std::find_if(delayed_.begin(), delayed_.end(), ready)) {
    const DelayedFrame delayed = *it;
    delayed_.erase(it);
    deliver(delayed.frame, delayed.sender);
  }
}

// Returns a port for Traffic::sender: null for the port of inject().
const VirtualBus::Port* VirtualBus::sender_for_traffic(const Port& port) const {
  return (&port == injector_.get()) ? nullptr : &port;
}

VirtualBus::Port::Port(VirtualBus& bus, Options options) : bus_(bus), options_(std::move(options)) {}

void VirtualBus::Port::enable(std::uint32_t baud) {
  clear_queues();
  baud_ = baud;
  enabled_ = true;
  bus_off_ = false;
}

void VirtualBus::Port::close() {
  clear_queues();
  enabled_ = false;
}

void VirtualBus::Port::reset() {
  clear_queues();
  recover();
}

std::int16_t VirtualBus::Port::send(const CO_IF_FRM& frame) {
  if (!active()) {
    return -1;
  }
  bus_.start_due_frames();
  const Rule* const rule = bus_.apply_rules({frame, bus_.sender_for_traffic(*this), bus_.now()}, Phase::send);
  const Fault fault = (rule != nullptr) ? rule->fault : Fault::none;
  if (fault == Fault::bus_off) {
    bus_off();
  }
  if (fault == Fault::bus_off || fault == Fault::error) {
    return -1;
  }
  if (fault == Fault::refuse || occupied() >= options_.transmit) {
    return 0;
  }
  transmit_.push_back(frame);
  bus_.transmit_due();
  return sizeof(CO_IF_FRM);
}

std::optional<CO_IF_FRM> VirtualBus::Port::read() {
  bus_.transmit_due();
  if (overrun_) {
    overrun_ = false;
    return error_frame(error_controller, controller_rx_overflow);
  }
  if (receive_.empty()) {
    return std::nullopt;
  }
  const CO_IF_FRM frame = receive_.front();
  receive_.pop_front();
  return frame;
}

void VirtualBus::Port::filter(const std::uint32_t* ids, std::uint16_t num) {
  accepted_.assign(ids, ids + num);
  std::sort(accepted_.begin(), accepted_.end());
  filtered_ = true;
}

void VirtualBus::Port::report(const CO_IF_FRM& error) {
  if (enabled_) {
    receive(error);
  }
}

void VirtualBus::Port::bus_off() {
  if (!active()) {
    return;
  }
  bus_.start_due_frames();
  transmit_.clear();
  bus_off_ = true;
  report(error_frame(error_bus_off));
}

void VirtualBus::Port::recover() {
  if (!bus_off_) {
    return;
  }
  bus_off_ = false;
  report(error_frame(error_restarted));
}

std::size_t VirtualBus::Port::occupied() const {
  const bool sending = bus_.on_wire_ && bus_.on_wire_->sender == this;
  return transmit_.size() + (sending ? 1 : 0);
}

bool VirtualBus::Port::receives_from(const Port& sender) const {
  return active() && (baud_ == 0 || sender.baud_ == 0 || baud_ == sender.baud_);
}

bool VirtualBus::Port::accepts(const CO_IF_FRM& frame) const {
  return is_error(frame) || !filtered_ || !options_.filter ||
         std::binary_search(accepted_.begin(), accepted_.end(), frame.Identifier & ~CO_IF_FRM_RTR);
}

void VirtualBus::Port::receive(const CO_IF_FRM& frame) {
  if (!accepts(frame)) {
    return;
  }
  if (receive_.size() >= options_.receive) {
    ++lost_;
    overrun_ = true;
    return;
  }
  receive_.push_back(frame);
}

void VirtualBus::Port::clear_queues() {
  bus_.start_due_frames();
  transmit_.clear();
  receive_.clear();
  overrun_ = false;
}

}  // namespace co
