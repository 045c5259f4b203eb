// SPDX-License-Identifier: Apache-2.0
/// \file stm32_tim.hpp
/// Counter and compare channel 1 of a general-purpose timer of STM32 (TIM2 to TIM5), up-counting. Written from RM0390,
/// 17.3 and 17.4, by the author of the driver.
#pragma once

#include "register_model.hpp"

namespace test {

class Stm32Tim : public RegisterModel {
 public:
  Stm32Tim(std::uintptr_t address, unsigned bits);

  /// Advances the input clock by some cycles.
  void run(std::uint64_t cycles);
  /// Returns the level of the interrupt line.
  bool interrupt() const { return (status_ & enabled_ & 3U) != 0; }
  /// Returns the number of counts since the counter was started.
  std::uint64_t counted() const { return counted_; }
  /// Sets the counter, as if it had counted for a long time.
  void set_counter(std::uint32_t value) { counter_ = value; }
  std::uint32_t prescaler() const { return prescaler_; }

  std::uint32_t cycles_per_access = 0;  ///< cycles of the input clock that pass in each access of the driver

 protected:
  std::uint32_t read_register(std::uint32_t offset) override;
  void write_register(std::uint32_t offset, std::uint32_t value) override;
  void before_access() override;

 private:
  void count_up();
  std::uint32_t mask_;
  std::uint32_t control_ = 0;
  std::uint32_t enabled_ = 0;
  std::uint32_t status_ = 0;
  std::uint32_t counter_ = 0;
  std::uint32_t new_prescaler_ = 0;
  std::uint32_t prescaler_ = 0;  // the active one
  std::uint32_t cycles_ = 0;     // since the last count
  std::uint32_t last_;
  std::uint32_t compare_ = 0;
  std::uint64_t counted_ = 0;
};

}  // namespace test
