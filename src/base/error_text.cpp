// SPDX-License-Identifier: Apache-2.0
#include "base/texts.hpp"
#include "co_err.h"

namespace co::error {
namespace {

struct Numbers {
  uint32_t number;
  uint32_t decimal;
};

constexpr Numbers numbers[] = {CO_ERR_LIST(CO_ERR_NUMBERS)};

constexpr bool is_consecutive() {
  uint32_t expected = 0x100;
  for (const Numbers& row : numbers) {
    if (row.number != expected || row.decimal != expected) {
      return false;
    }
    ++expected;
  }
  return true;
}
static_assert(is_consecutive(),
              "CO_ERR_LIST: each number is one more than the number before, and both forms are equal");

constexpr char meanings[] = CO_ERR_LIST(CO_ERR_TEXT_AND_NUL);
constexpr char names[] = CO_ERR_LIST(CO_ERR_NAME_AND_NUL);

}  // namespace
}  // namespace co::error

extern "C" const char* COErrName(CO_ERR err) {
  const auto number = static_cast<uint32_t>(err);
  return err == CO_ERR_NONE ? "CO_ERR_NONE" : co::texts::find(co::error::names, number - CO_ERR_BASE, "unknown error");
}

extern "C" const char* COErrText(CO_ERR err) {
  const auto number = static_cast<uint32_t>(err);
  return err == CO_ERR_NONE ? "no error" : co::texts::find(co::error::meanings, number - CO_ERR_BASE, "unknown error");
}
