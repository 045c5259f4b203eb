// SPDX-License-Identifier: Apache-2.0
#include "linux_node/master.hpp"

namespace demo {
namespace {

// The highest node-ID that is free: the usual place of a master.
std::uint8_t own_node_id(std::uint8_t device) { return device == 127 ? 126 : 127; }

}  // namespace

Master::Master(Host& host, Clock& device, std::uint8_t node_id)
    : node_id_(node_id),
      dictionary_(node_id),
      node_({own_node_id(node_id), host.master_can(), host.master_timer(), dictionary_.table(),
             [this](bool received, const CO_IF_FRM& frame) { note(received, frame); }, true}),
      loop_(host, {&device.node(), &node_}),
      sdo_(node_, loop_) {
  CONodeStart(&node_.stack());
}

void Master::note(bool received, const CO_IF_FRM& frame) {
  if (received && frame.Identifier == 0x700u + node_id_ && frame.DLC == 1) {
    heard_.push_back(static_cast<State>(frame.Data[0]));
  }
  if (received && frame.Identifier < 0x580) {
    frames_.push_back(frame);
  }
}

void Master::forget() {
  heard_.clear();
  frames_.clear();
}

bool Master::send(CO_IF_FRM frame) {
  forget();
  return COIfCanSend(&node_.stack().If, &frame) > 0;
}

bool Master::command(Nmt command) { return send({0x000, {static_cast<std::uint8_t>(command), node_id_}, 2}); }

bool Master::has_heard(State state) {
  while (!heard_.empty()) {
    const State next = heard_.front();
    heard_.pop_front();
    if (next == state) {
      return true;
    }
  }
  return false;
}

std::optional<CO_IF_FRM> Master::take_frame(std::uint32_t identifier) {
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
  loop_.run_until([&] { return (frame = take_frame(identifier)).has_value(); }, timeout);
  return frame;
}

bool Master::await_state(State state, Micros timeout) {
  return loop_.run_until([&] { return has_heard(state); }, timeout);
}

}  // namespace demo
