// SPDX-License-Identifier: Apache-2.0
#include "station.hpp"

#include <stdexcept>
#include <utility>

namespace speed {
namespace {

constexpr std::size_t receive_buffers = 512;
constexpr std::uint32_t ticks_per_second = 1000000;

}  // namespace

Station::Station(co::VirtualBus& bus, co::VirtualClock& clock, std::size_t transmit, std::uint8_t node_id,
                 std::vector<CO_OBJ> dictionary, std::uint8_t* sdo_memory, void* user)
    : port_(bus.attach({"node", receive_buffers, transmit})),
      timer_(clock, [this] { COTmrService(&node.Tmr); }),
      dictionary_(std::move(dictionary)) {
  ext_.Size = sizeof ext_;
  ext_.Can = &co::VirtualBusDriver;
  ext_.CanCtx = &port_;
  ext_.Timer = &co::VirtualTimerDriver;
  ext_.TimerCtx = &timer_;
  ext_.User = user;
  CO_NODE_SPEC spec{};
  spec.NodeId = node_id;
  spec.Dict = dictionary_.data();
  spec.DictLen = static_cast<std::uint16_t>(dictionary_.size());
  spec.TmrFreq = ticks_per_second;
  spec.SdoBuf = sdo_memory;
  CONodeInitEx(&node, &spec, &ext_);
  if (CONodeGetErr(&node) != CO_ERR_NONE) {
    throw std::logic_error("the node does not start");
  }
  CONodeStart(&node);
}

Station::~Station() { CONodeStop(&node); }

void Station::go_round() {
  CONodeProcess(&node);
  COTmrProcess(&node.Tmr);
}

void Station::work_off() {
  do {
    go_round();
  } while (port_.waiting() > 0);
}

bool Station::is_at_rest() { return port_.waiting() == 0 && CONodeNextDeadline(&node) == UINT32_MAX; }

}  // namespace speed
