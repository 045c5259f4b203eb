// SPDX-License-Identifier: Apache-2.0
#include "linux_node/master.hpp"

#include <algorithm>

namespace demo {

Master::Master(Host& host, Clock& device, std::uint8_t node_id)
    : host_(host), device_(device), can_(host.master_can()), node_id_(node_id) {
  can_.driver->Init(can_.context);
  can_.driver->Enable(can_.context, 0);
}

Master::~Master() { can_.driver->Close(can_.context); }

bool Master::send(const CO_IF_FRM& frame) { return can_.driver->Send(can_.context, &frame) > 0; }

std::optional<CO_IF_FRM> Master::next_match(const Match& match) {
  CO_IF_FRM frame{};
  while (can_.driver->Read(can_.context, &frame) > 0) {
    if (match(frame)) {
      return frame;
    }
  }
  return std::nullopt;
}

std::optional<CO_IF_FRM> Master::await(const Match& match, Micros timeout) {
  const Micros deadline = host_.now() + timeout;
  for (;;) {
    device_.process();
    if (auto frame = next_match(match)) {
      return frame;
    }
    const Micros now = host_.now();
    if (now >= deadline || host_.interrupted()) {
      return std::nullopt;
    }
    host_.wait(std::min(deadline - now, device_.due_in()));
  }
}

bool Master::command(Nmt command) { return send({0x000, {static_cast<std::uint8_t>(command), node_id_}, 2}); }

bool Master::await_state(State state, Micros timeout) {
  const auto matches = [&](const CO_IF_FRM& frame) {
    return frame.Identifier == 0x700u + node_id_ && frame.DLC == 1 && frame.Data[0] == static_cast<std::uint8_t>(state);
  };
  return await(matches, timeout).has_value();
}

}  // namespace demo
