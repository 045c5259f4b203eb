// SPDX-License-Identifier: Apache-2.0
#include "co_time_of_day.h"

#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "hal/port.hpp"
#include "wire/time.hpp"

namespace {

constexpr uint32_t bytes = co::wire::time_bytes;

uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) { return co::data_of<CO_TIME_OF_DAY>(*obj) == nullptr ? 0 : bytes; }

CO_ERR read(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  const auto* const time = co::data_of<const CO_TIME_OF_DAY>(*obj);
  if (size != bytes || time == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  auto* const to = static_cast<uint8_t*>(buffer);
  co::wire::put_time(to, *time);
  co::wire::swap_host(to, bytes);
  return CO_ERR_NONE;
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  auto* const time = co::data_of<CO_TIME_OF_DAY>(*obj);
  if (size != bytes || time == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (!co::port::is_writable(*node, time, sizeof *time)) {
    return CO_ERR_OBJ_ACC;
  }
  uint8_t from[bytes];
  __builtin_memcpy(from, buffer, bytes);
  co::wire::swap_host(from, bytes);
  *time = co::wire::get_time(from);
  return CO_ERR_NONE;
}

}  // namespace

extern "C" const CO_OBJ_TYPE COTTimeOfDay = {size, co::dict::checked_by<co::rules::variable>, read, write, nullptr};
