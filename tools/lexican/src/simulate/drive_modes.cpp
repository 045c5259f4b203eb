// SPDX-License-Identifier: Apache-2.0
// The modes of operation of a simulated drive.
#include <algorithm>
#include <cmath>

#include "simulate/drive.hpp"

namespace lexican::simulate {
namespace {

// Bits of the controlword. [402-2]
constexpr std::uint64_t start = 0x10;  // new set-point, homing operation start
constexpr std::uint64_t at_once = 0x20;
constexpr std::uint64_t relative = 0x40;
constexpr std::uint64_t halt = 0x100;

constexpr std::uint64_t reached = 0x400;  // bits of the statusword
constexpr std::uint64_t by_mode_12 = 0x1000;
constexpr std::uint64_t by_mode_13 = 0x2000;

constexpr double usual_speed = 10'000;  // of a device that does not describe its own
constexpr double usual_acceleration = 100'000;
constexpr double usual_homing_speed = 1'000;
constexpr double homing_time = 0.2;  // s, of the way to the home position
constexpr double no_limit = 1e12;

}  // namespace

double Drive::rate(std::uint16_t index, std::uint8_t sub_index, double usual) const {
  const std::uint64_t value = numbers_.natural(index, sub_index, 0);
  return value != 0 ? static_cast<double>(value) : usual;
}

double Drive::most_speed() const { return std::min(rate(0x607F, 0, no_limit), rate(0x6080, 0, no_limit)); }

Ramp Drive::ramp() const {
  const double acceleration = rate(0x6083, 0, usual_acceleration);
  return {acceleration, rate(0x6084, 0, acceleration), most_speed()};
}

/// Returns the interpolation time period, 60C2h.
Micros Drive::cycle() const {
  const auto units = static_cast<double>(numbers_.natural(0x60C2, 1, 1));
  const auto power = static_cast<double>(numbers_.integer(0x60C2, 2, -3));
  return static_cast<Micros>(std::clamp(units * std::pow(10, power) * 1e6, 1e3, 1e6));
}

/// Returns a position within the software limits.
double Drive::limited(double target) {
  const auto low = static_cast<double>(numbers_.integer(0x607D, 1, 0));
  const auto high = static_cast<double>(numbers_.integer(0x607D, 2, 0));
  const double within = low < high ? std::clamp(target, low, high) : target;
  is_limited_ = within != target;
  return within;
}

void Drive::choose_mode() {
  const std::int64_t usual = numbers_.has(0x607A) ? position : numbers_.has(0x60FF) ? velocity : no_mode;
  const std::int64_t wanted = numbers_.integer(0x6060, 0, usual);
  constexpr std::uint64_t simulated = 0x1A5;
  const std::uint64_t described = numbers_.natural(0x6502, 0, 0);
  const std::uint64_t supported = described != 0 ? described : simulated;
  const bool is_supported = wanted >= 1 && wanted <= 16 && (supported >> (wanted - 1) & 1) != 0;
  if (wanted != mode_ && (is_supported || wanted == no_mode)) {
    mode_ = wanted;
    begin_mode();
    publish();
  }
}

void Drive::begin_mode() {
  target_ = std::round(axis_.demand);
  has_next_ = false;
  is_acknowledged_ = false;
  is_limited_ = false;
  homing_ = homing_ == Homing::attained ? Homing::attained : Homing::none;
  is_reached_ = mode_ != velocity || numbers_.integer(0x60FF, 0, 0) == 0;
  reached_time_ = 0;
  excess_time_ = 0;
  cycle_rest_ = cycle();
}

void Drive::control_mode(std::uint64_t word, std::uint64_t risen) {
  if (mode_ == position) {
    if ((risen & start) != 0) {
      take_set_point(word);
    }
    is_acknowledged_ = is_acknowledged_ && (word & start) != 0;
  } else if (mode_ == homing) {
    if ((risen & start) != 0) {
      begin_homing();
    } else if ((word & start) == 0 && homing_ == Homing::running) {
      homing_ = Homing::none;
    }
  }
}

void Drive::take_set_point(std::uint64_t word) {
  const auto value = static_cast<double>(numbers_.integer(0x607A, 0, 0));
  const double base = has_next_ ? next_target_ : target_;
  const double target = limited((word & relative) != 0 ? base + value : value);
  const bool is_busy = axis_.demand != target_ || axis_.speed != 0;
  if (is_busy && has_next_ && (word & at_once) == 0) {
    return;  // there is no place for it
  }
  has_next_ = is_busy && (word & at_once) == 0;
  (has_next_ ? next_target_ : target_) = target;
  is_acknowledged_ = true;
  is_reached_ = false;
  reached_time_ = 0;
}

void Drive::move(Micros elapsed) {
  const double time = static_cast<double>(elapsed) / 1e6;
  if ((word_ & halt) != 0) {
    slow_down(numbers_.integer(0x605D, 0, 1), time);
    return;
  }
  switch (mode_) {
    case position: move_to_position(time); break;
    case velocity: move_with_speed(time); break;
    case homing: move_home(time); break;
    case cyclic_position: follow_target(elapsed); break;
    case cyclic_velocity: {
      const double most = most_speed();
      const double before = axis_.speed;
      axis_.speed = std::clamp(static_cast<double>(numbers_.integer(0x60FF, 0, 0)), -most, most);
      axis_.demand += (before + axis_.speed) / 2 * time;
      break;
    }
    default: slow_down(1, time); break;
  }
}

void Drive::move_to_position(double time) {
  Ramp of_profile = ramp();
  const double speed = numbers_.has(0x6081) ? static_cast<double>(numbers_.natural(0x6081, 0, 0)) : usual_speed;
  of_profile.speed = std::min(of_profile.speed, speed);
  axis_.to_position(target_, of_profile, time);
  if (has_next_ && axis_.demand == target_ && axis_.speed == 0) {
    target_ = next_target_;
    has_next_ = false;
  }
}

void Drive::move_with_speed(double time) {
  const auto target = static_cast<double>(numbers_.integer(0x60FF, 0, 0));
  const double next = axis_.demand + target * time;
  const double within = limited(next);
  const bool leaves = within != next && (next - within) * target > 0;
  is_limited_ = leaves || std::abs(target) > most_speed();
  axis_.to_speed(leaves ? 0 : target, ramp(), time);
}

void Drive::begin_homing() {
  const std::int64_t method = numbers_.integer(0x6098, 0, 37);
  const bool is_reserved = method == 15 || method == 16 || method == 31 || method == 32;
  reached_time_ = 0;
  if (method == 35 || method == 37) {
    axis_.place(static_cast<double>(numbers_.integer(0x607C, 0, 0)));
    target_ = axis_.demand;
    homing_ = Homing::attained;
    is_reached_ = true;
  } else if (method >= 1 && method <= 34 && !is_reserved) {
    const double way = homing_time * rate(0x6099, 1, usual_homing_speed);
    target_ = std::round(axis_.demand + (method % 2 == 0 ? way : -way));
    homing_ = Homing::running;
    is_reached_ = false;
  } else {
    homing_ = Homing::failed;
  }
}

void Drive::move_home(double time) {
  if (homing_ != Homing::running) {
    slow_down(1, time);
    return;
  }
  const double acceleration = rate(0x609A, 0, usual_acceleration);
  axis_.to_position(target_, {acceleration, acceleration, rate(0x6099, 1, usual_homing_speed)}, time);
  if (axis_.demand == target_ && axis_.speed == 0) {
    axis_.place(static_cast<double>(numbers_.integer(0x607C, 0, 0)));
    target_ = axis_.demand;
    homing_ = Homing::attained;
  }
}

void Drive::follow_target(Micros elapsed) {
  target_ = limited(static_cast<double>(numbers_.integer(0x607A, 0, std::llround(axis_.demand))));
  const double before = axis_.demand;
  const double part = cycle_rest_ > elapsed ? static_cast<double>(elapsed) / static_cast<double>(cycle_rest_) : 1;
  axis_.demand = part < 1 ? before + (target_ - before) * part : target_;
  axis_.speed = (axis_.demand - before) * 1e6 / static_cast<double>(elapsed);
  cycle_rest_ = cycle_rest_ > elapsed ? cycle_rest_ - elapsed : 0;
}

/// Decides whether the target is reached: within a window, for some time.
void Drive::check_reached(Micros elapsed) {
  const std::uint64_t position_window = numbers_.natural(0x6067, 0, UINT32_MAX);
  double distance = axis_.speed;
  double window = 0;
  Micros time = 0;
  if ((word_ & halt) == 0 && mode_ == position) {
    const bool has_window = position_window != UINT32_MAX;
    distance = has_next_ ? no_limit : has_window ? target_ - axis_.actual : target_ - axis_.demand;
    window = has_window ? static_cast<double>(position_window) : 0;
    time = has_window ? numbers_.natural(0x6068, 0, 0) * millisecond : 0;
  } else if ((word_ & halt) == 0 && mode_ == velocity) {
    distance = static_cast<double>(numbers_.integer(0x60FF, 0, 0)) - axis_.actual_speed;
    window = static_cast<double>(numbers_.natural(0x606D, 0, 0));
    time = numbers_.natural(0x606E, 0, 0) * millisecond;
  }
  if (std::abs(distance) >= window + 0.5) {
    reached_time_ = 0;
    is_reached_ = false;
    return;
  }
  is_reached_ = is_reached_ || reached_time_ >= time;
  reached_time_ += elapsed;
  is_at_rest_ = is_at_rest_ && is_reached_;
}

std::uint64_t Drive::status_of_mode() const {
  const std::uint64_t bits = is_reached_ ? reached : 0;
  switch (mode_) {
    case position: return bits | (is_acknowledged_ || has_next_ ? by_mode_12 : 0);
    case velocity: {
      const auto zero = static_cast<double>(numbers_.natural(0x606F, 0, 0));
      return bits | (std::abs(axis_.actual_speed) < zero + 0.5 ? by_mode_12 : 0);
    }
    case homing:
      return bits | (homing_ == Homing::attained ? by_mode_12 : 0) | (homing_ == Homing::failed ? by_mode_13 : 0);
    case cyclic_position:
    case cyclic_velocity: return (word_ & halt) == 0 ? by_mode_12 : 0;
    default: return 0;
  }
}

}  // namespace lexican::simulate
