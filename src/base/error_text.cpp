// SPDX-License-Identifier: Apache-2.0
#include "base/texts.hpp"
#include "co_err.h"

namespace co::error {
namespace {

constexpr char meanings[] = CO_ERR_LIST(CO_ERR_TEXT_AND_NUL);

}  // namespace
}  // namespace co::error

extern "C" const char* COErrText(CO_ERR err) {
  const auto number = static_cast<uint32_t>(err);
  return err == CO_ERR_NONE ? "no error" : co::texts::find(co::error::meanings, number - CO_ERR_BASE, "unknown error");
}
