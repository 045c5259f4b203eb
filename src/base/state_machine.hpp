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

// Transition: an event, the states in which it is valid, and the function that serves it.
template <class Event, class Service>
struct Transition {
  uint32_t states;
  Event on;
  Service run;
};

void two_transitions_have_the_same_event();  // not constexpr: two transitions with the same event do not compile

// State machine with its transitions in an array indexed by event, so that a step costs one lookup.
template <class State, const auto& transitions>
class Machine {
  using Event = std::remove_const_t<decltype(transitions[0].on)>;
  using Service = std::remove_const_t<decltype(transitions[0].run)>;

 public:
  // otherwise: service of a protocol error
  constexpr explicit Machine(Service otherwise) : entries_{}, otherwise_(otherwise) {
    for (const auto& transition : transitions) {
      Entry& entry = entries_[static_cast<size_t>(transition.on)];
      if (entry.states != 0) {
        two_transitions_have_the_same_event();
      }
      entry = {transition.states, transition.run};
    }
  }

  // Returns the service of an event in a state.
  constexpr Service operator()(State in, Event on) const {
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
    Service run;
  };
  Entry entries_[events];
  Service otherwise_;
};

}  // namespace co
