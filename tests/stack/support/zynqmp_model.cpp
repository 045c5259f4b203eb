// SPDX-License-Identifier: Apache-2.0
#include "zynqmp_model.hpp"

#include <algorithm>

namespace test {
namespace {

using co::zynqmp::Register;

constexpr std::size_t fifo_frames = 64;

std::vector<ZynqmpModel*>& models() {
  static std::vector<ZynqmpModel*> all;
  return all;
}

std::uintptr_t offset_of(ZynqmpModel& model, std::uintptr_t address) {
  return address - reinterpret_cast<std::uintptr_t>(model.address());
}

ZynqmpModel& model_at(std::uintptr_t address) {
  return **std::find_if(models().begin(), models().end(),
                        [address](ZynqmpModel* m) { return offset_of(*m, address) < 0x100; });
}

Register register_at(ZynqmpModel& model, std::uintptr_t address) {
  return static_cast<Register>(offset_of(model, address));
}

unsigned word_of(Register which, Register group) {
  return (static_cast<unsigned>(which) - static_cast<unsigned>(group)) / 4;
}

}  // namespace

ZynqmpModel::ZynqmpModel() {
  models().push_back(this);
  soft_reset();
}

ZynqmpModel::~ZynqmpModel() { models().erase(std::find(models().begin(), models().end(), this)); }

std::uint32_t ZynqmpModel::read(Register which) {
  if (between) {
    between();
  }
  if (which == Register::interrupt_status) {
    return isr_;
  }
  if (which == Register::interrupt_enable) {
    return ier_;
  }
  if (which == Register::status) {
    const std::uint32_t mode = on_ ? state_ : resetting_ == 0 ? co::zynqmp::is_configuring : 0U;
    const std::uint32_t filters = filtering_ == 0 ? 0U : co::zynqmp::filters_busy;
    resetting_ -= resetting_ == 0 ? 0 : 1;
    filtering_ -= filtering_ == 0 ? 0 : 1;
    return mode | filters | (first_ ? co::zynqmp::first_is_full : 0U);
  }
  if (which >= Register::receive && which <= Register::receive + 3) {
    const std::uint32_t value = received_.empty() ? 0 : received_.front()[word_of(which, Register::receive)];
    if (which == Register::receive + 3 && !received_.empty()) {
      received_.pop_front();
    }
    return value;
  }
  return value(which);
}

void ZynqmpModel::write(Register which, std::uint32_t value) {
  put(which, value);
  if (between) {
    between();
  }
}

void ZynqmpModel::put(Register which, std::uint32_t value) {
  if (resetting_ != 0 || (filtering_ != 0 && which >= Register::filters)) {
    return;
  }
  memory_[static_cast<unsigned>(which) / 4] = value;
  if (which == Register::software_reset) {
    if ((value & co::zynqmp::soft_reset) != 0) {
      soft_reset();
    } else if ((value & co::zynqmp::can_enable) == 0) {
      enter_configuration();
    } else {
      on_ = true;
    }
  } else if (which == Register::filters_used && value == 0) {
    filtering_ = latency;
  } else if (which == Register::interrupt_enable) {
    ier_ = value;
  } else if (which == Register::interrupt_clear) {
    isr_ &= ~value;
    if (level) {
      raise_lasting();
    } else if (!received_.empty()) {
      isr_ |= co::zynqmp::received;
    }
  } else if (which == Register::transmit + 3 && fifo_.size() < fifo_frames) {
    const unsigned at = static_cast<unsigned>(Register::transmit) / 4;
    fifo_.push_back({memory_[at], memory_[at + 1], memory_[at + 2], memory_[at + 3]});
    if (instant) {
      begin();
      win();
    }
  } else if (which == Register::transmit_first + 3 && !first_) {
    const unsigned at = static_cast<unsigned>(Register::transmit_first) / 4;
    first_ = Words{memory_[at], memory_[at + 1], memory_[at + 2], memory_[at + 3]};
  }
}

void ZynqmpModel::begin() {
  if (!on_ || wire_) {
    return;
  }
  if (first_) {
    wire_ = OnWire{*first_, true};
  } else if (!fifo_.empty()) {
    wire_ = OnWire{fifo_.front(), false};
  }
}

void ZynqmpModel::win() {
  if (!wire_) {
    return;
  }
  sent.push_back(wire_->words[0] >> co::zynqmp::standard_shift);
  sent_words.push_back(wire_->words);
  if (wire_->is_first) {
    first_.reset();
  } else {
    fifo_.pop_front();
    isr_ |= fifo_.empty() ? co::zynqmp::all_sent : 0;
  }
  wire_.reset();
  isr_ |= co::zynqmp::sent;
}

void ZynqmpModel::lose() {
  if (wire_) {
    wire_.reset();
    isr_ |= co::zynqmp::arbitration_lost;
  }
}

void ZynqmpModel::receive(const Words& words) {
  if (!on_ || !passes(words[0])) {
    return;
  }
  if (received_.size() == fifo_frames) {
    isr_ |= co::zynqmp::receive_overflow;
    return;
  }
  received_.push_back(words);
  isr_ |= co::zynqmp::received;
}

void ZynqmpModel::receive(std::uint32_t identifier) {
  receive(Words{identifier << co::zynqmp::standard_shift, 0, 0, 0});
}

void ZynqmpModel::go_bus_off() {
  state_ = 2U << 7;
  isr_ |= co::zynqmp::bus_off;
  wire_.reset();
}

void ZynqmpModel::soft_reset() {
  memory_ = {};
  fifo_.clear();
  first_.reset();
  wire_.reset();
  received_.clear();
  ier_ = 0;
  enter_configuration();
  isr_ = co::zynqmp::all_sent;
  resetting_ = latency;
  filtering_ = 0;
}

// Enters configuration mode, as after switching the controller off. Queued frames are kept.
void ZynqmpModel::enter_configuration() {
  on_ = false;
  wire_.reset();
  state_ = co::zynqmp::error_active;
  isr_ &= ~(co::zynqmp::arbitration_lost | co::zynqmp::sent | co::zynqmp::receive_overflow | co::zynqmp::bus_off);
}

bool ZynqmpModel::passes(std::uint32_t word) const {
  const std::uint32_t used = value(Register::filters_used);
  bool pass = used == 0;
  for (unsigned n = 0; n < 4; ++n) {
    const std::uint32_t mask = value(Register::filters + 2 * n);
    pass = pass || ((used >> n & 1) != 0 && (word & mask) == (value(Register::filters + (2 * n + 1)) & mask));
  }
  return pass;
}

void ZynqmpModel::raise_lasting() {
  isr_ |= fifo_.empty() ? co::zynqmp::all_sent : 0;
  isr_ |= received_.empty() ? 0 : co::zynqmp::received;
}

}  // namespace test

extern "C" {

// Register accesses of the driver.
std::uint32_t lexican_model_read(std::uintptr_t address) {
  test::ZynqmpModel& model = test::model_at(address);
  return model.read(test::register_at(model, address));
}

void lexican_model_write(std::uintptr_t address, std::uint32_t value) {
  test::ZynqmpModel& model = test::model_at(address);
  model.write(test::register_at(model, address), value);
}

}  // extern "C"
