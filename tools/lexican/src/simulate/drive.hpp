// SPDX-License-Identifier: Apache-2.0
/// \file drive.hpp
/// A simulated drive of CiA 402: state machine, modes of operation, and a simple axis.
#pragma once

#include <map>

#include "simulate/axis.hpp"
#include "simulate/profile.hpp"

namespace lexican::simulate {

class Drive : public Behaviour {
 public:
  explicit Drive(const Numbers& numbers) : numbers_(numbers) {}

  void written(std::uint16_t index, std::uint8_t sub_index) override;
  void update() override;
  bool commanded(std::uint16_t index, std::uint8_t sub_index, const Bytes& value) override;
  void raised(std::uint16_t code) override;
  void disconnected() override;
  void step(Micros elapsed) override;
  bool is_at_rest() const override { return is_at_rest_; }
  void reset() override;

 private:
  enum class State { disabled, ready, switched_on, enabled, quick_stop, fault_reaction, fault };
  /// Modes of operation, 6060h.
  enum Mode : std::int64_t {
    no_mode = 0,
    position = 1,
    velocity = 3,
    homing = 6,
    cyclic_position = 8,
    cyclic_velocity = 9
  };
  enum class Homing { none, running, attained, failed };

  /// An object that the drive has set.
  struct Published {
    std::int64_t value;
    bool is_unsent;  ///< it has not caused a TPDO yet
  };

  // The state machine.
  void control(std::uint64_t word);
  void enter(State state);
  void stop_quickly();
  void fail(std::uint16_t code);
  bool slow_down(std::int64_t option, double time);
  void check_following(Micros elapsed);
  void publish();
  std::uint64_t status() const;
  std::uint64_t status_of_mode() const;

  // The modes of operation.
  void choose_mode();
  void begin_mode();
  void control_mode(std::uint64_t word, std::uint64_t risen);
  void move(Micros elapsed);
  void take_set_point(std::uint64_t word);
  void move_to_position(double time);
  void move_with_speed(double time);
  void begin_homing();
  void move_home(double time);
  void follow_target(Micros elapsed);
  void check_reached(Micros elapsed);
  double limited(double target);
  Ramp ramp() const;
  double most_speed() const;
  double rate(std::uint16_t index, std::uint8_t sub_index, double usual) const;
  Micros cycle() const;

  Numbers numbers_;
  State state_ = State::disabled;
  Axis axis_;
  std::uint64_t word_ = 0;                 ///< controlword
  std::vector<std::uint64_t> next_words_;  ///< controlwords whose frame may have further objects behind them
  std::int64_t mode_ = no_mode;
  bool is_at_rest_ = true;
  bool has_excess_ = false;  ///< following error
  bool is_limited_ = false;  ///< by a software limit
  bool is_reached_ = true;
  Micros excess_time_ = 0;
  Micros reached_time_ = 0;
  unsigned steps_ = 0;
  std::map<std::uint16_t, Published> published_;  ///< by index

  double target_ = 0;  ///< position
  bool has_next_ = false;
  double next_target_ = 0;
  bool is_acknowledged_ = false;
  Homing homing_ = Homing::none;
  Micros cycle_rest_ = 0;  ///< time until the demand has to be at the target
};

}  // namespace lexican::simulate
