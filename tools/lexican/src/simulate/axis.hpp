// SPDX-License-Identifier: Apache-2.0
/// \file axis.hpp
/// The motion of an axis: a demand that is ramped, and an actual position that follows it.
#pragma once

namespace lexican::simulate {

/// Limits of a motion, in units of position and seconds.
struct Ramp {
  double acceleration;
  double deceleration;
  double speed;  ///< at most
};

/// Times are in seconds. All members may be changed at any time.
struct Axis {
  double demand = 0;        ///< position
  double speed = 0;         ///< of the demand
  double actual = 0;        ///< position
  double actual_speed = 0;  ///< of the actual position
  bool is_held = false;     ///< something holds the actual position

  /// Brings the demand nearer to a speed.
  void to_speed(double target, const Ramp& ramp, double time);
  /// Brings the demand nearer to a position, and stops there.
  void to_position(double target, const Ramp& ramp, double time);
  /// Moves the actual position to the demand, with this speed at most.
  void follow(double most, double time);
  /// Moves the axis to a position at once.
  void place(double position);
  bool is_moving() const { return speed != 0 || actual_speed != 0 || (!is_held && actual != demand); }

 private:
  void change_speed(double target, const Ramp& ramp, double time);
};

}  // namespace lexican::simulate
