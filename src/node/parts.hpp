// SPDX-License-Identifier: Apache-2.0
// Table of the parts of the stack, made from their list, and the functions that pass events to them.
#pragma once

#include <stddef.h>

#include <type_traits>

#include "base/part.hpp"
#include "base/routes.hpp"
#include "extra/recorder/recorder.hpp"
#include "node/mode.hpp"
#include "service/emcy/emcy.hpp"
#include "service/gfc/gfc.hpp"
#include "service/guarding/guarding.hpp"
#include "service/heartbeat/heartbeat.hpp"
#include "service/led/led.hpp"
#include "service/lss/lss.hpp"
#include "service/mpdo/mpdo.hpp"
#include "service/nmt/error_behaviour.hpp"
#include "service/pdo/pdo.hpp"
#include "service/sdo/sdo_client.hpp"
#include "service/sdo/sdo_server.hpp"
#include "service/srdo/configuration.hpp"
#include "service/sync/sync.hpp"
#include "service/time/time.hpp"
#include "storage/para.hpp"

namespace co::parts {

struct Row {
  bool is_present = false;
  uint16_t senders = 0;
  uint8_t allowed = 0;  // CO_..._ALLOWED bit that the NMT state must have for its frames
  Part part;
};

// Read by the compiler only: without optimisation, too, no function of a part that is left out is linked.
inline constexpr Row rows[] = {
#define CO_ROW(name, instances, routes, senders, permission) {(instances) != 0, senders, permission, name::part},
    CO_PARTS(CO_ROW)
#undef CO_ROW
};
inline constexpr auto row_num = static_cast<size_t>(PartId::count);

// Returns whether the part in this row is present and has a function in the column. Types are compared, because gcc
// with its sanitizers does not accept the comparison of a function with null as a constant expression.
template <auto function>
struct Value;
template <auto column, size_t row>
constexpr bool has() {
  if constexpr (rows[row].is_present) {
    constexpr auto function = rows[row].part.*column;
    return !std::is_same_v<Value<function>, Value<static_cast<decltype(function)>(nullptr)>>;
  }
  return false;
}

// Calls the function in a column (&Part::of_...) of all parts that have one.
template <auto column, size_t row = 0, class... Arguments>
[[gnu::always_inline]] inline void run(CO_NODE& node, const Arguments&... arguments) {
  if constexpr (has<column, row>()) {
    constexpr auto function = rows[row].part.*column;
    (void)function(node, arguments...);
  }
  if constexpr (row + 1 < row_num) {
    run<column, row + 1>(node, arguments...);
  }
}

// Returns the result of the first part that has a function in the column; without one, otherwise.
template <auto column, size_t row = 0, class Result, class Node, class... Arguments>
[[gnu::always_inline]] inline Result ask(Result otherwise, Node& node, const Arguments&... arguments) {
  if constexpr (has<column, row>()) {
    constexpr auto function = rows[row].part.*column;
    return function(node, arguments...);
  } else if constexpr (row + 1 < row_num) {
    return ask<column, row + 1>(otherwise, node, arguments...);
  } else {
    return otherwise;
  }
}

// Sends the deferred messages of each part.
template <size_t row = 0>
[[gnu::always_inline]] inline void send_deferred(CO_NODE& node) {
  if constexpr (has<&Part::of_deferred, row>()) {
    constexpr unsigned bit = rows[row].part.pending;
    constexpr auto function = rows[row].part.of_deferred;
    if (event::runnable(node, bit) != 0) {
      function(node);
    }
  }
  if constexpr (row + 1 < row_num) {
    send_deferred<row + 1>(node);
  }
}

// Passes a frame to the parts whose routes begin at this position. Returns false if the NMT state permits none of them.
#if CO_ROUTES_SORTED
[[nodiscard]] bool dispatch(CO_NODE& node, const CO_IF_FRM& frame, unsigned slot);

// Returns the CO_..._ALLOWED bit of the part that owns a route.
[[nodiscard]] uint8_t permission_of(uint16_t owner);
#else
[[nodiscard]] bool dispatch(CO_NODE& node, const CO_IF_FRM& frame);
#endif

// Continues the senders whose frames the controller has refused.
void on_free(CO_NODE& node);

}  // namespace co::parts
