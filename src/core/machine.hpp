// SPDX-License-Identifier: Apache-2.0
// Protocol machines: a row for every event that a state knows. A pair that is no row is the protocol error.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace co {

template <class State, class Event, class Service>
struct Row {
  State in;
  Event on;
  Service run;
};

// The rows as a matrix, so that a step costs one look-up whatever the number of rows.
template <class State, class Event, class Service, size_t states, size_t events>
struct Machine {
  template <size_t rows>
  constexpr Machine(const Row<State, Event, Service> (&table)[rows], Service otherwise) : run{} {
    for (auto& state : run) {
      for (auto& service : state) {
        service = otherwise;
      }
    }
    for (const auto& row : table) {
      run[static_cast<size_t>(row.in)][static_cast<size_t>(row.on)] = row.run;
    }
  }

  constexpr Service operator()(State in, Event on) const {
    return run[static_cast<size_t>(in)][static_cast<size_t>(on)];
  }

  Service run[states][events];
};

}  // namespace co
