// SPDX-License-Identifier: Apache-2.0
#include "co_err.h"
#include "core/texts.hpp"

namespace co::error {
namespace {

constexpr char meanings[] = CO_ERR_LIST(CO_ERR_TEXT_AND_NUL);

}  // namespace
}  // namespace co::error

extern "C" const char* COErrText(CO_ERR err) {
  const auto number = static_cast<uint32_t>(err);
  return err == CO_ERR_NONE ? "no error" : co::texts::find(co::error::meanings, number - CO_ERR_BASE, "unknown error");
}
