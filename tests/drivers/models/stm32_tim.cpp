// SPDX-License-Identifier: Apache-2.0
#include "stm32_tim.hpp"

#include <algorithm>

namespace test {
namespace {

constexpr std::uint32_t update = 1;
constexpr std::uint32_t channel_1 = 2;

}  // namespace

Stm32Tim::Stm32Tim(std::uintptr_t address, unsigned bits)
    : RegisterModel(address, 0x400), mask_(bits == 16 ? 0xFFFF : 0xFFFFFFFF), last_(mask_) {}

void Stm32Tim::before_access() { run(cycles_per_access); }

void Stm32Tim::count_up() {
  ++counted_;
  counter_ = counter_ == last_ ? 0 : counter_ + 1;
  if (counter_ == 0) {
    status_ |= update;
    prescaler_ = new_prescaler_;
  }
  status_ |= counter_ == compare_ ? channel_1 : 0;
}

void Stm32Tim::run(std::uint64_t cycles) {
  if ((control_ & 1U) == 0 || last_ == 0) {
    return;
  }
  while (cycles != 0) {
    // Advances in one step to the next event: a wrap or a match.
    const std::uint64_t per_count = std::uint64_t{prescaler_} + 1;
    const std::uint64_t counts = (cycles_ + cycles) / per_count;
    const std::uint64_t to_wrap = std::uint64_t{last_} - counter_ + 1;
    const std::uint64_t to_match = compare_ > counter_ ? compare_ - counter_ : UINT64_MAX;
    const std::uint64_t step = std::min({counts, to_wrap, to_match});
    if (step == 0) {
      cycles_ += static_cast<std::uint32_t>(cycles);
      return;
    }
    cycles -= step * per_count - cycles_;
    cycles_ = 0;
    counter_ += static_cast<std::uint32_t>(step - 1);
    counted_ += step - 1;
    count_up();
  }
}

std::uint32_t Stm32Tim::read_register(std::uint32_t offset) {
  switch (offset) {
    case 0x00: return control_;
    case 0x0C: return enabled_;
    case 0x10: return status_;
    case 0x24: return counter_;
    case 0x28: return new_prescaler_;
    case 0x2C: return last_;
    case 0x34: return compare_;
    default: fault("read of a register that is not modelled"); return 0;
  }
}

void Stm32Tim::write_register(std::uint32_t offset, std::uint32_t value) {
  switch (offset) {
    case 0x00: control_ = value; break;
    case 0x0C: enabled_ = value; break;
    case 0x10: status_ &= value; break;
    case 0x14:
      status_ |= value & channel_1;
      if ((value & update) != 0) {
        counter_ = 0;
        cycles_ = 0;
        counted_ = 0;
        prescaler_ = new_prescaler_;
        status_ |= (control_ & 4U) == 0 ? update : 0;
      }
      break;
    case 0x18:
      if (value != 0) {
        fault("channel 1 is not in output compare mode without a pin");
      }
      break;
    case 0x28: new_prescaler_ = value & 0xFFFF; break;
    case 0x2C: last_ = value & mask_; break;
    case 0x34:
      if (value > mask_) {
        fault("compare value");
      }
      compare_ = value & mask_;
      break;
    default: fault("write to a register that is not modelled");
  }
}

}  // namespace test
