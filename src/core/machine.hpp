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

// Services that occur in the rows.
template <class Row, size_t rows>
constexpr size_t count_services(const Row (&table)[rows]) {
  size_t different = 0;
  for (size_t n = 0; n < rows; ++n) {
    bool first = true;
    for (size_t before = 0; before < n; ++before) {
      first = first && table[before].run != table[n].run;
    }
    different += first ? 1 : 0;
  }
  return different;
}

// The rows as a matrix of service numbers, so that a step costs two look-ups whatever the number of rows.
template <class State, class Event, class Service, size_t states, size_t events, size_t services>
class Machine {
 public:
  template <size_t rows>
  constexpr Machine(const Row<State, Event, Service> (&table)[rows], Service otherwise) : run_{otherwise}, number_{} {
    uint8_t used = 1;
    for (const auto& row : table) {
      uint8_t n = 1;
      while (n < used && run_[n] != row.run) {
        ++n;
      }
      run_[n] = row.run;
      used = n == used ? static_cast<uint8_t>(used + 1) : used;
      number_[static_cast<size_t>(row.in)][static_cast<size_t>(row.on)] = n;
    }
  }

  constexpr Service operator()(State in, Event on) const {
    return run_[number_[static_cast<size_t>(in)][static_cast<size_t>(on)]];
  }

 private:
  Service run_[services + 1];
  uint8_t number_[states][events];
};

}  // namespace co
