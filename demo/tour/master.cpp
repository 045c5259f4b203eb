// SPDX-License-Identifier: Apache-2.0
#include "tour/master.hpp"

#include <utility>

namespace lexican::demo {
namespace {

SdoClient::Options sdo_options(const Device& device) {
  SdoClient::Options options;
  options.timeout *= device.traits().timeout_factor;
  return options;
}

// Returns the highest free node-ID, which is usual for a master.
std::uint8_t own_node_id(std::uint8_t device) { return device == 127 ? 126 : 127; }

}  // namespace

Master::Master(Host& host, Device& device, std::uint8_t node_id, Node::Observer observer)
    : node_id_(node_id),
      observer_(std::move(observer)),
      dictionary_(node_id),
      node_({own_node_id(node_id), host.master_can(), host.master_timer(), dictionary_.table(),
             [this](bool received, const CO_IF_FRM& frame) { record_frame(received, frame); }, true}),
      loop_(host, nodes(device, node_)),
      sdo_(node_, loop_, sdo_options(device)) {
  CONodeStart(&node_.stack());
}

std::vector<Node*> Master::nodes(Device& device, Node& own) {
  Node* const other = device.node_in_loop();
  return other == nullptr ? std::vector{&own} : std::vector{other, &own};
}

void Master::record_frame(bool received, const CO_IF_FRM& frame) {
  if (observer_) {
    observer_(received, frame);
  }
  if (received && frame.Identifier == 0x700u + node_id_ && frame.DLC == 1) {
    states_.push_back(static_cast<State>(frame.Data[0]));
  }
  if (received && frame.Identifier < 0x580) {
    frames_.push_back(frame);
  }
}

void Master::discard_received() {
  states_.clear();
  frames_.clear();
}

bool Master::send(CO_IF_FRM frame) {
  discard_received();
  return COIfCanSend(&node_.stack().If, &frame) > 0;
}

bool Master::command(Nmt command) { return send({0x000, {static_cast<std::uint8_t>(command), node_id_}, 2}); }

bool Master::has_received_state(State state) {
  while (!states_.empty()) {
    const State next = states_.front();
    states_.pop_front();
    if (next == state) {
      return true;
    }
  }
  return false;
}

std::optional<CO_IF_FRM> Master::next_frame(std::uint32_t identifier) {
  while (!frames_.empty()) {
    const CO_IF_FRM next = frames_.front();
    frames_.pop_front();
    if (next.Identifier == identifier) {
      return next;
    }
  }
  return std::nullopt;
}

std::optional<CO_IF_FRM> Master::await_frame(std::uint32_t identifier, Micros timeout) {
  std::optional<CO_IF_FRM> frame;
  loop_.run_until([&] { return (frame = next_frame(identifier)).has_value(); }, timeout);
  return frame;
}

bool Master::await_state(State state, Micros timeout) {
  return loop_.run_until([&] { return has_received_state(state); }, timeout);
}

}  // namespace lexican::demo
