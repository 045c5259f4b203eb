// SPDX-License-Identifier: Apache-2.0
#include "host/node.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "trace/text.hpp"

namespace demo {
namespace {

// Interval of send attempts while the bus is lost, and limit of the lateness of timers then.
constexpr Micros patience = 10 * millisecond;

// Limit of frames per call, so that a busy bus delays neither the timers nor the program.
constexpr unsigned frames_at_once = 32;

std::string object_text(std::uint32_t key) {
  return key != 0 ? text(", object %04Xh:%02X", unsigned{CO_GET_IDX(key)}, unsigned{CO_GET_SUB(key)}) : "";
}

std::uint32_t frames(const CO_NODE_COUNTERS& counters) { return counters.Received + counters.Sent; }

}  // namespace

const CO_IF_CAN_DRV_EX Node::Tap::driver = {
    [](void* tap) { to(tap).driver->Init(to(tap).context); },
    [](void* tap, std::uint32_t baud) { to(tap).driver->Enable(to(tap).context, baud); },
    [](void* tap, CO_IF_FRM* frame) {
      const std::int16_t result = to(tap).driver->Read(to(tap).context, frame);
      if (result > 0) {
        show(tap, true, *frame);
      }
      return result;
    },
    [](void* tap, const CO_IF_FRM* frame) {
      const std::int16_t result = to(tap).driver->Send(to(tap).context, frame);
      static_cast<Tap*>(tap)->failing = result < 0;
      if (result > 0) {
        show(tap, false, *frame);
      }
      return result;
    },
    [](void* tap) { to(tap).driver->Reset(to(tap).context); },
    [](void* tap) { to(tap).driver->Close(to(tap).context); },
    [](void* tap, const std::uint32_t* ids, std::uint16_t num) {
      if (to(tap).driver->Filter != nullptr && !static_cast<Tap*>(tap)->hears_all) {
        to(tap).driver->Filter(to(tap).context, ids, num);
      }
    },
    [](void* tap, CO_NODE* node, const CO_IF_FRM* frame) {
      if (to(tap).driver->Report != nullptr) {
        to(tap).driver->Report(to(tap).context, node, frame);
      }
    },
};

const Can& Node::Tap::to(void* tap) { return static_cast<Tap*>(tap)->can; }

void Node::Tap::show(void* tap, bool received, const CO_IF_FRM& frame) {
  if (const Observer& observer = static_cast<Tap*>(tap)->observer) {
    observer(received, frame);
  }
}

Node* Node::at_work_ = nullptr;

Node::Node(Setup setup) : tap_{setup.can, std::move(setup.observer), setup.hears_all} {
  extension_.Size = sizeof extension_;
  extension_.Can = &Tap::driver;
  extension_.CanCtx = &tap_;
  extension_.Timer = setup.timer.driver;
  extension_.TimerCtx = setup.timer.context;
  extension_.Nvm = setup.memory.driver;
  extension_.NvmCtx = setup.memory.context;
  extension_.EmcyNum = setup.errors.number;

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
  at_work_ = this;
  CONodeInitEx(&node_, &spec, &extension_);
  at_work_ = nullptr;
}

Node::~Node() { CONodeStop(&node_); }

bool Node::process() {
  const std::uint32_t before = frames(counters());
  at_work_ = this;
  for (unsigned n = 0; n < frames_at_once; ++n) {
    const std::uint32_t received = counters().Received;
    CONodeProcess(&node_);  // one frame per call
    COTmrService(&node_.Tmr);
    COTmrProcess(&node_.Tmr);
    if (counters().Received == received) {
      break;
    }
  }
  at_work_ = nullptr;
  return frames(counters()) != before;
}

std::string Node::error_text() {
  const CO_ERR err = error();
  if (err == CO_ERR_NONE) {
    return {};
  }
  std::uint32_t key = 0;
  std::string words = std::string(COErrName(err)) + object_text(CONodeGetErrKey(&node_)) + ": " + COErrText(err);
  if (const CO_DICT_FAULT fault = CODictGetFault(&node_.Dict, &key); fault != CO_DICT_OK) {
    words += std::string("; ") + CODictFaultName(fault) + object_text(key) + ": " + CODictFaultText(fault);
  }
  return words;
}

#if USE_LSS && USE_PARA

CO_ERR Node::load_lss(std::uint32_t* bit_rate, std::uint8_t* node_id) {
  const bool has_memory = at_work_ != nullptr && at_work_->extension_.Nvm != nullptr;
  return has_memory ? COLssNvmLoad(&at_work_->node_, 0, bit_rate, node_id) : CO_ERR_NONE;
}

CO_ERR Node::store_lss(std::uint32_t bit_rate, std::uint8_t node_id) {
  const bool has_memory = at_work_ != nullptr && at_work_->extension_.Nvm != nullptr;
  return has_memory ? COLssNvmStore(&at_work_->node_, 0, bit_rate, node_id) : CO_ERR_NONE;
}

#else

CO_ERR Node::load_lss(std::uint32_t*, std::uint8_t*) { return CO_ERR_NONE; }
CO_ERR Node::store_lss(std::uint32_t, std::uint8_t) { return CO_ERR_NONE; }

#endif

Micros Node::due_in() {
  const Micros due = CONodeNextDeadline(&node_);  // short while frames are queued
  return tap_.failing ? std::max(due, patience) : due;
}

}  // namespace demo
