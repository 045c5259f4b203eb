// SPDX-License-Identifier: Apache-2.0
#include "host/node.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "trace/text.hpp"

namespace lexican {
namespace {

// Interval of send attempts while the bus is lost, and limit of the lateness of timers then.
constexpr Micros resend_interval = 10 * millisecond;

// Limit of frames per call, so that a busy bus delays neither the timers nor the program.
constexpr unsigned frames_per_call = 32;

std::uint32_t frames(const CO_NODE_COUNTERS& counters) { return counters.Received + counters.Sent; }

}  // namespace

const CO_IF_CAN_DRV_EX Node::Tap::driver = {
    [](void* tap) { can_of(tap).driver->Init(can_of(tap).context); },
    [](void* tap, std::uint32_t baud) { can_of(tap).driver->Enable(can_of(tap).context, baud); },
    [](void* tap, CO_IF_FRM* frame) {
      const std::int16_t result = can_of(tap).driver->Read(can_of(tap).context, frame);
      if (result > 0) {
        report_frame(tap, true, *frame);
      }
      return result;
    },
    [](void* tap, const CO_IF_FRM* frame) {
      const std::int16_t result = can_of(tap).driver->Send(can_of(tap).context, frame);
      static_cast<Tap*>(tap)->failing = result < 0;
      if (result > 0) {
        report_frame(tap, false, *frame);
      }
      return result;
    },
    [](void* tap) { can_of(tap).driver->Reset(can_of(tap).context); },
    [](void* tap) { can_of(tap).driver->Close(can_of(tap).context); },
    [](void* tap, const std::uint32_t* ids, std::uint16_t num) {
      if (can_of(tap).driver->Filter != nullptr && !static_cast<Tap*>(tap)->observes_all) {
        can_of(tap).driver->Filter(can_of(tap).context, ids, num);
      }
    },
    [](void* tap, CO_NODE* node, const CO_IF_FRM* frame) {
      if (can_of(tap).driver->Report != nullptr) {
        can_of(tap).driver->Report(can_of(tap).context, node, frame);
      }
    },
};

const Can& Node::Tap::can_of(void* tap) { return static_cast<Tap*>(tap)->can; }

void Node::Tap::report_frame(void* tap, bool received, const CO_IF_FRM& frame) {
  if (const auto& receiver = static_cast<Tap*>(tap)->receiver; received && receiver) {
    receiver(frame);
  }
  if (const Observer& observer = static_cast<Tap*>(tap)->observer) {
    observer(received, frame);
  }
}

Node* Node::active_node_ = nullptr;

Node::Node(Setup setup) : tap_{setup.can, std::move(setup.observer), setup.observes_all} {
  extension_.Size = sizeof extension_;
  extension_.Can = &Tap::driver;
  extension_.CanCtx = &tap_;
  extension_.Timer = setup.timer.driver;
  extension_.TimerCtx = setup.timer.context;
  extension_.Nvm = setup.memory.driver;
  extension_.NvmCtx = setup.memory.context;
  extension_.EmcyNum = setup.errors.number;
  extension_.Callbacks = setup.callbacks;
  extension_.User = setup.user;

  CO_NODE_SPEC spec{};
  spec.NodeId = setup.node_id;
  spec.Baudrate = 0;  // the system sets the bit rate of the interface
  spec.Dict = setup.dictionary.first;
  spec.DictLen = setup.dictionary.length;
  spec.EmcyCode = setup.errors.first;
  spec.TmrMem = timer_;
  spec.TmrNum = static_cast<std::uint16_t>(std::size(timer_));
  spec.TmrFreq = ticks_per_second;
  spec.SdoBuf = sdo_buffer_;
  active_node_ = this;
  CONodeInitEx(&node_, &spec, &extension_);
  active_node_ = nullptr;
}

Node::~Node() { CONodeStop(&node_); }

bool Node::process() {
  const std::uint32_t before = frames(counters());
  active_node_ = this;
  for (unsigned n = 0; n < frames_per_call; ++n) {
    const std::uint32_t received = counters().Received;
    CONodeProcess(&node_);  // one frame per call
    COTmrService(&node_.Tmr);
    COTmrProcess(&node_.Tmr);
    if (counters().Received == received) {
      break;
    }
  }
  active_node_ = nullptr;
  return frames(counters()) != before;
}

std::string Node::error_text() {
  char text[CO_NODE_ERR_TEXT];
  return CONodeGetErrText(&node_, text, sizeof text) != CO_ERR_NONE ? text : std::string();
}

#if USE_LSS && USE_PARA

CO_ERR Node::load_lss(std::uint32_t* bit_rate, std::uint8_t* node_id) {
  const bool has_memory = active_node_ != nullptr && active_node_->extension_.Nvm != nullptr;
  return has_memory ? COLssNvmLoad(&active_node_->node_, 0, bit_rate, node_id) : CO_ERR_NONE;
}

CO_ERR Node::store_lss(std::uint32_t bit_rate, std::uint8_t node_id) {
  const bool has_memory = active_node_ != nullptr && active_node_->extension_.Nvm != nullptr;
  return has_memory ? COLssNvmStore(&active_node_->node_, 0, bit_rate, node_id) : CO_ERR_NONE;
}

#else

CO_ERR Node::load_lss(std::uint32_t*, std::uint8_t*) { return CO_ERR_NONE; }
CO_ERR Node::store_lss(std::uint32_t, std::uint8_t) { return CO_ERR_NONE; }

#endif

Micros Node::due_in() {
  const Micros due = CONodeNextDeadline(&node_);  // short while frames are queued
  return tap_.failing ? std::max(due, resend_interval) : due;
}

}  // namespace lexican
