// SPDX-License-Identifier: Apache-2.0
#include "simulate/axis.hpp"

#include <algorithm>
#include <cmath>

namespace lexican::simulate {

void Axis::change_speed(double target, const Ramp& ramp, double time) {
  const bool is_faster = std::abs(target) > std::abs(speed) && target * speed >= 0;
  const double most = (is_faster ? ramp.acceleration : ramp.deceleration) * time;
  double next = speed + std::clamp(target - speed, -most, most);
  next = next * speed < 0 ? 0 : next;  // the other direction begins with its own ramp
  speed = next;
}

void Axis::to_speed(double target, const Ramp& ramp, double time) {
  const double before = speed;
  change_speed(std::clamp(target, -ramp.speed, ramp.speed), ramp, time);
  demand += (before + speed) / 2 * time;
}

void Axis::to_position(double target, const Ramp& ramp, double time) {
  const double rest = target - demand;
  const double stop = std::sqrt(2 * ramp.deceleration * std::abs(rest));  // from this speed it can stop at the target
  const double before = speed;
  change_speed(std::copysign(std::min(ramp.speed, stop), rest), ramp, time);
  const double way = (before + speed) / 2 * time;
  const bool is_slow = std::abs(speed) <= 2 * ramp.deceleration * time;
  const bool has_passed = std::abs(rest) <= 0.5 || (way * rest > 0 && std::abs(way) >= std::abs(rest));
  if (has_passed && is_slow) {
    demand = target;
    speed = 0;
  } else {
    demand += way;
  }
}

void Axis::follow(double most, double time) {
  const double before = actual;
  if (!is_held) {
    actual += std::clamp(demand - actual, -most * time, most * time);
  }
  actual_speed = (actual - before) / time;
}

void Axis::place(double position) {
  demand = actual = position;
  speed = actual_speed = 0;
}

}  // namespace lexican::simulate
