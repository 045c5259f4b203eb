// SPDX-License-Identifier: Apache-2.0
/// \file memory_check.hpp
/// Runs the driver check for ports (tests/drivers/driver_check) on a modelled memory.
#pragma once

#include <string>
#include <vector>

#include "co_driver_check.h"

namespace test {

/// Returns the failed checks of a memory and its driver.
template <class Model>
std::vector<std::string> failed_checks(Model& model) {
  std::vector<std::string> failures;
  CO_NODE_EXT ext{};
  ext.Size = sizeof ext;
  ext.Nvm = &model.driver();
  ext.NvmCtx = model.context();
  CO_DRIVER_CHECK check{};
  check.Ext = &ext;
  check.User = &failures;
  check.Print = [](void* user, const char* line) {
    const std::string text = line;
    if (text.rfind("ok", 0) != 0) {
      static_cast<std::vector<std::string>*>(user)->push_back(text);
    }
  };
  CODriverCheckNvm(&check);
  if (check.Passed < 7) {
    failures.push_back(std::to_string(check.Passed) + " checks");
  }
  return failures;
}

}  // namespace test
