// SPDX-License-Identifier: Apache-2.0
// 1012h, and the clock as an object.
#include "base/routes.hpp"
#include "dictionary/parameter.hpp"
#include "dictionary/types/cob_id.hpp"
#include "service/time/time.hpp"
#include "wire/time.hpp"

#if USE_TIME

namespace {

using namespace co;

// COB-ID TIME. [301:7.5.2.15]

// Checks a COB-ID. A consumer or producer cannot change its CAN-ID.
CO_ERR may_replace(CO_NODE&, CO_OBJ&, uint32_t value, uint32_t before) {
  constexpr uint32_t exists = CO_TIME_COBID_CONSUME | CO_TIME_COBID_PRODUCE;
  const bool same = ((before ^ value) & ~exists) == 0;
  const bool is_new = (before & exists) == 0 && (value == before || cob_id::is_free(value));
  return is_new || ((before & exists) != 0 && same) ? CO_ERR_NONE : CO_ERR_OBJ_RANGE;
}

void apply(CO_NODE& node, CO_OBJ&, uint32_t, uint32_t) {
  if (node.Nmt.Mode != CO_INVALID) {
    time::init(node);
    routes::publish(node);
  }
}

// The clock has no variable: the bytes that are read and written are those of a TIME message.

uint32_t size(CO_OBJ*, CO_NODE*, uint32_t) { return wire::time_bytes; }

CO_ERR read(CO_OBJ*, CO_NODE* node, void* buffer, uint32_t size) {
  if (size != wire::time_bytes) {
    return CO_ERR_BAD_ARG;
  }
  auto* const to = static_cast<uint8_t*>(buffer);
  wire::put_time(to, time::read_clock(*node));
  wire::swap_host(to, wire::time_bytes);
  return CO_ERR_NONE;
}

CO_ERR write(CO_OBJ*, CO_NODE* node, void* buffer, uint32_t size) {
  if (size != wire::time_bytes) {
    return CO_ERR_BAD_ARG;
  }
  uint8_t from[wire::time_bytes];
  __builtin_memcpy(from, buffer, sizeof from);
  wire::swap_host(from, sizeof from);
  const CO_TIME_OF_DAY time = wire::get_time(from);
  return wire::is_time_of_day(time) ? time::set_clock(*node, time) : CO_ERR_OBJ_RANGE;
}

}  // namespace

extern "C" {

const CO_OBJ_TYPE COTTimeId = parameter<integer::cob_id, rules::time_cob_id, may_replace, apply>;
const CO_OBJ_TYPE COTTimeClock = {size, nullptr, read, write, nullptr};

}  // extern "C"

#endif
