// SPDX-License-Identifier: Apache-2.0
// Protocol state machines: one transition for each event, with the states in which the event is valid. Any other pair
// of state and event is a protocol error.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include <type_traits>

namespace co {

// Returns a set of states, a bit for each.
template <class... State>
constexpr uint32_t in(State... states) {
  return ((uint32_t{1} << static_cast<unsigned>(states)) | ...);
}

// Transition: an event, the states in which it is valid, and its handler.
template <class Event, class Handler>
struct Transition {
  uint32_t states;
  Event on;
  Handler run;
};

void two_transitions_have_the_same_event();  // not constexpr: two transitions with the same event do not compile

// State machine with its transitions in an array indexed by event, so that a step costs one lookup.
template <class State, const auto& transitions>
class StateMachine {
  using Event = std::remove_const_t<decltype(transitions[0].on)>;
  using Handler = std::remove_const_t<decltype(transitions[0].run)>;

 public:
  // otherwise: handler of a protocol error
  constexpr explicit StateMachine(Handler otherwise) : entries_{}, otherwise_(otherwise) {
    for (const auto& transition : transitions) {
      Entry& entry = entries_[static_cast<size_t>(transition.on)];
      if (entry.states != 0) {
        two_transitions_have_the_same_event();
      }
      entry = {transition.states, transition.run};
    }
  }

  // Returns the handler of an event in a state.
  constexpr Handler operator()(State in, Event on) const {
    const auto event = static_cast<size_t>(on);
    const bool is_known = event < events && (entries_[event].states >> static_cast<unsigned>(in) & 1U) != 0;
    return is_known ? entries_[event].run : otherwise_;
  }

 private:
  static constexpr size_t count_events() {
    size_t all = 0;
    for (const auto& transition : transitions) {
      all = static_cast<size_t>(transition.on) < all ? all : static_cast<size_t>(transition.on) + 1;
    }
    return all;
  }
  static constexpr size_t events = count_events();

  struct Entry {
    uint32_t states;
    Handler run;
  };
  Entry entries_[events];
  Handler otherwise_;
};

}  // namespace co
