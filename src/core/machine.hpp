// SPDX-License-Identifier: Apache-2.0
// Protocol machines: a row for every event that states know. A pair that is in no row is the protocol error.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace co {

// Some states, for the rows.
template <class... State>
constexpr uint32_t in(State... states) {
  return ((uint32_t{1} << static_cast<unsigned>(states)) | ...);
}

template <class Event, class Service>
struct Row {
  uint32_t states;
  Event on;
  Service run;
};

// The rows as a matrix of their numbers, so that a step costs two look-ups whatever the number of rows.
template <class State, class Event, class Service, size_t states, size_t events, size_t rows>
class Machine {
 public:
  constexpr Machine(const Row<Event, Service> (&table)[rows], Service otherwise) : run_{otherwise}, number_{} {
    for (size_t n = 0; n < rows; ++n) {
      enter(table[n], static_cast<uint8_t>(n + 1));
    }
  }

  constexpr Service operator()(State in, Event on) const {
    return run_[number_[static_cast<size_t>(in)][static_cast<size_t>(on)]];
  }

 private:
  constexpr void enter(const Row<Event, Service>& row, uint8_t number) {
    run_[number] = row.run;
    for (size_t state = 0; state < states; ++state) {
      if ((row.states >> state & 1U) != 0) {
        number_[state][static_cast<size_t>(row.on)] = number;
      }
    }
  }

  Service run_[rows + 1];
  uint8_t number_[states][events];
};

template <class State, size_t states, size_t events, class Event, class Service, size_t rows>
constexpr auto make_machine(const Row<Event, Service> (&table)[rows], Service otherwise) {
  return Machine<State, Event, Service, states, events, rows>(table, otherwise);
}

}  // namespace co
