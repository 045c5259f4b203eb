// SPDX-License-Identifier: Apache-2.0
#include "linux_node/clock.hpp"

#include <algorithm>
#include <utility>

#include "linux_node/dictionary.hpp"

namespace demo {
namespace {

// While the bus is lost, frames are offered to it at this interval, and timers may be late by as much.
constexpr Micros patience = 10 * millisecond;

void tick(void* time) {
  auto& now = *static_cast<TimeOfDay*>(time);
  if (++now.second < 60) {
    return;
  }
  now.second = 0;
  if (++now.minute < 60) {
    return;
  }
  now.minute = 0;
  now.hour = static_cast<std::uint8_t>((now.hour + 1) % 24);
}

}  // namespace

const CO_IF_CAN_DRV_EX Clock::Tap::driver = {
    [](void* tap) { to(tap).driver->Init(to(tap).context); },
    [](void* tap, std::uint32_t baud) { to(tap).driver->Enable(to(tap).context, baud); },
    [](void* tap, CO_IF_FRM* frame) {
      const std::int16_t result = to(tap).driver->Read(to(tap).context, frame);
      if (result > 0) {
        static_cast<Tap*>(tap)->observer(true, *frame);
      }
      return result;
    },
    [](void* tap, const CO_IF_FRM* frame) {
      const std::int16_t result = to(tap).driver->Send(to(tap).context, frame);
      static_cast<Tap*>(tap)->failing = result < 0;
      if (result > 0) {
        static_cast<Tap*>(tap)->observer(false, *frame);
      }
      return result;
    },
    [](void* tap) { to(tap).driver->Reset(to(tap).context); },
    [](void* tap) { to(tap).driver->Close(to(tap).context); },
    [](void* tap, const std::uint32_t* ids, std::uint16_t num) {
      if (to(tap).driver->Filter != nullptr) {
        to(tap).driver->Filter(to(tap).context, ids, num);
      }
    },
};

const Can& Clock::Tap::to(void* tap) { return static_cast<Tap*>(tap)->can; }

Clock::Clock(std::uint8_t node_id, Can can, Timer timer, Observer observer) : tap_{can, std::move(observer), false} {
  extension_.Size = sizeof extension_;
  extension_.Can = &Tap::driver;
  extension_.CanCtx = &tap_;
  extension_.Timer = timer.driver;
  extension_.TimerCtx = timer.context;

  const Table dictionary = clock_dictionary();
  CO_NODE_SPEC spec{};
  spec.NodeId = node_id;
  spec.Baudrate = 0;  // the interface has its own, set by the system
  spec.Dict = dictionary.first;
  spec.DictLen = dictionary.length;
  spec.TmrMem = timer_;
  spec.TmrNum = 1;
  spec.TmrFreq = ticks_per_second;
  CONodeInitEx(&node_, &spec, &extension_);
}

Clock::~Clock() { CONodeStop(&node_); }

bool Clock::start() {
  if (CONmtGetMode(&node_.Nmt) != CO_INIT) {
    return false;
  }
  clock_time = {};
  if (COTmrCreate(&node_.Tmr, ticks_per_second, ticks_per_second, tick, &clock_time) < 0) {
    return false;
  }
  CONodeStart(&node_);
  return true;
}

void Clock::process() {
  std::uint32_t received = 0;
  do {  // one frame a call
    received = counters().Received;
    CONodeProcess(&node_);
  } while (counters().Received != received);
  COTmrService(&node_.Tmr);
  COTmrProcess(&node_.Tmr);
}

Micros Clock::due_in() {
  const Micros due = CONodeNextDeadline(&node_);  // soon, while frames wait to be sent
  return tap_.failing ? std::max(due, patience) : due;
}

TimeOfDay Clock::time() { return clock_time; }

}  // namespace demo
