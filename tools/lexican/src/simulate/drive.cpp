// SPDX-License-Identifier: Apache-2.0
#include "simulate/drive.hpp"

#include <cmath>

namespace lexican::simulate {
namespace {

// Bits of the controlword. [402-2]
constexpr std::uint64_t enable_voltage = 0x02;
constexpr std::uint64_t no_quick_stop = 0x04;
constexpr std::uint64_t reset_fault = 0x80;

constexpr std::uint64_t voltage_enabled = 0x10;  // bits of the statusword
constexpr std::uint64_t remote = 0x200;

constexpr unsigned event_steps = 10;  // between event-driven TPDOs with the position of a moving axis

}  // namespace

void Drive::reset() {
  state_ = State::disabled;
  axis_.is_held = false;
  axis_.place(static_cast<double>(numbers_.integer(0x6064, 0, std::llround(axis_.actual))));
  word_ = 0;
  next_words_.clear();
  published_.clear();
  mode_ = no_mode;
  has_excess_ = false;
  homing_ = Homing::none;
  is_at_rest_ = true;
  choose_mode();
  begin_mode();
  publish();
}

void Drive::written(std::uint16_t index, std::uint8_t) {
  switch (numbers_.of_profile(index)) {
    case 0x6040: next_words_.push_back(numbers_.natural(0x6040, 0, 0)); break;
    case 0x6060: choose_mode(); break;
    case 0x607A: cycle_rest_ = cycle(); break;
    default: break;
  }
  is_at_rest_ = false;
}

void Drive::update() {
  for (const std::uint64_t word : std::exchange(next_words_, {})) {
    control(word);
  }
}

bool Drive::commanded(std::uint16_t index, std::uint8_t, const Bytes& value) {
  if (numbers_.of_profile(index) == 0x6064) {
    const auto place = static_cast<double>(integer_of(value));
    axis_.is_held = state_ == State::enabled || state_ == State::quick_stop;
    axis_.is_held ? static_cast<void>(axis_.actual = place) : axis_.place(place);
    is_at_rest_ = false;
  }
  return false;
}

void Drive::raised(std::uint16_t code) {
  if (code != 0) {
    fail(code);
  }
}

void Drive::disconnected() {
  if (state_ != State::enabled) {
    return;
  }
  switch (numbers_.integer(0x6007, 0, 0)) {  // abort connection option code
    case 1: fail(0); break;
    case 2: enter(State::disabled); break;
    case 3: stop_quickly(); break;
    default: break;
  }
  publish();
}

void Drive::control(std::uint64_t word) {
  const std::uint64_t risen = word & ~word_;
  word_ = word;
  if (state_ == State::fault) {
    if ((risen & reset_fault) != 0) {
      has_excess_ = false;
      axis_.is_held = false;
      numbers_.device().clear();
      numbers_.put(0x603F, 0, 0);
      enter(State::disabled);
    }
  } else if (state_ != State::fault_reaction && (word & reset_fault) == 0) {
    const bool may_run = state_ == State::enabled || state_ == State::quick_stop;
    if ((word & enable_voltage) == 0) {
      enter(State::disabled);
    } else if ((word & no_quick_stop) == 0) {
      may_run ? stop_quickly() : enter(State::disabled);
    } else if (state_ != State::quick_stop) {
      const std::uint64_t command = word & 0x0F;
      if ((command & 0x07) == 0x06) {
        enter(State::ready);
      } else if (state_ != State::disabled && command == 0x07) {
        enter(State::switched_on);
      } else if (state_ != State::disabled && command == 0x0F) {
        enter(State::enabled);
      }
    } else if ((word & 0x0F) == 0x0F && numbers_.integer(0x605A, 0, 2) >= 5) {
      enter(State::enabled);
    }
  }
  if (state_ == State::enabled) {
    control_mode(word, risen);
  }
  publish();
}

void Drive::enter(State state) {
  const bool is_new = state != state_;
  state_ = state;
  if (is_new && state == State::enabled) {
    begin_mode();
  }
  is_at_rest_ = false;
}

void Drive::stop_quickly() { enter(numbers_.integer(0x605A, 0, 2) == 0 ? State::disabled : State::quick_stop); }

/// \a code: EMCY error code that was sent; 0: none
void Drive::fail(std::uint16_t code) {
  if (code != 0) {
    numbers_.put(0x603F, 0, code);
  }
  if (state_ != State::fault) {
    const bool runs = state_ == State::enabled || state_ == State::quick_stop;
    enter(runs && numbers_.integer(0x605E, 0, 2) != 0 ? State::fault_reaction : State::fault);
  }
  publish();
}

/// Slows the axis down as an option code demands: 1, 5: with the deceleration, 2, 6: with that of the quick stop,
/// others: at once.
/// \retval true  the axis stands still
bool Drive::slow_down(std::int64_t option, double time) {
  const double usual = ramp().deceleration;
  const bool is_quick = option == 2 || option == 6;
  if (option == 1 || option == 5 || is_quick) {
    Ramp ramp{1, is_quick ? rate(0x6085, 0, usual) : usual, std::abs(axis_.speed)};
    axis_.to_speed(0, ramp, time);
  } else {
    axis_.speed = 0;
  }
  return axis_.speed == 0;
}

void Drive::step(Micros elapsed) {
  const double time = static_cast<double>(elapsed) / 1e6;
  const std::int64_t quick_stop = numbers_.integer(0x605A, 0, 2);
  is_limited_ = is_limited_ && state_ == State::enabled;
  bool is_stopped = false;
  switch (state_) {
    case State::enabled: move(elapsed); break;
    case State::quick_stop:
      is_stopped = slow_down(quick_stop, time);
      if (is_stopped && quick_stop < 5) {
        enter(State::disabled);
      }
      break;
    case State::fault_reaction:
      is_stopped = slow_down(numbers_.integer(0x605E, 0, 2), time);
      if (is_stopped) {
        enter(State::fault);
      }
      break;
    default: is_stopped = slow_down(1, time); break;
  }
  if (is_stopped) {
    axis_.demand = axis_.actual;
  }
  axis_.follow(most_speed(), time);
  is_at_rest_ = !axis_.is_moving() && state_ != State::fault_reaction;
  if (state_ == State::enabled) {
    check_following(elapsed);
    check_reached(elapsed);
  } else {
    is_reached_ = is_stopped;
  }
  publish();
}

void Drive::check_following(Micros elapsed) {
  const std::uint64_t window = numbers_.natural(0x6065, 0, UINT32_MAX);
  const bool is_checked = mode_ == position || mode_ == cyclic_position;
  const double excess = std::abs(axis_.demand - axis_.actual) - static_cast<double>(window);
  if (!is_checked || window == UINT32_MAX || excess <= 0) {
    excess_time_ = 0;
    return;
  }
  excess_time_ += elapsed;
  is_at_rest_ = false;
  if (excess_time_ > numbers_.natural(0x6066, 0, 0) * millisecond) {
    constexpr std::uint16_t following_error = 0x8611;
    has_excess_ = true;
    excess_time_ = 0;
    numbers_.device().raise(following_error);
    fail(following_error);
  }
}

std::uint64_t Drive::status() const {
  std::uint64_t bits = voltage_enabled | remote;
  switch (state_) {
    case State::disabled: bits |= 0x40; break;
    case State::ready: bits |= 0x21; break;
    case State::switched_on: bits |= 0x23; break;
    case State::enabled: bits |= 0x27; break;
    case State::quick_stop: bits |= 0x07; break;
    case State::fault_reaction: bits |= 0x0F; break;
    case State::fault: bits |= 0x08; break;
  }
  bits |= has_excess_ ? 0x2000U : 0U;
  bits |= is_limited_ ? 0x0800U : 0U;
  return state_ == State::enabled      ? bits | status_of_mode()
         : state_ == State::quick_stop ? bits | (axis_.speed == 0 ? 0x0400U : 0U)
                                       : bits;
}

/// Sets the objects whose values have changed: those that a command has set stay until then.
void Drive::publish() {
  steps_ = axis_.is_moving() ? steps_ + 1 : 0;
  const bool is_event = steps_ % event_steps == 0;
  const auto put = [&](std::uint16_t index, std::int64_t value, bool may_send) {
    const auto [place, is_new] = published_.emplace(index, Published{value, false});
    Published& last = place->second;
    if (is_new || last.value != value) {
      numbers_.put(index, 0, value, may_send);
      last = {value, !may_send};
    } else if (last.is_unsent && may_send) {
      numbers_.send(index);
      last.is_unsent = false;
    }
  };
  put(0x6062, std::llround(axis_.demand), is_event);
  put(0x606B, std::llround(axis_.speed), is_event);
  put(0x60F4, std::llround(axis_.demand - axis_.actual), is_event);
  put(0x606C, std::llround(axis_.actual_speed), is_event);
  put(0x6064, std::llround(axis_.actual), is_event);
  put(0x6061, mode_, true);
  put(0x6041, static_cast<std::int64_t>(status()), true);
}

}  // namespace lexican::simulate
