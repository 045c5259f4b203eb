// SPDX-License-Identifier: Apache-2.0
/// \file callbacks.hpp
/// The stack's callbacks have fixed names; here a test can put a function of its own behind each. All are empty again
/// when a Fixture ends.
#pragma once

#include <functional>

#include "co_core.h"

namespace test {

struct Callbacks {
  std::function<void(CO_NMT*, CO_MODE)> mode_change;
  std::function<void(CO_NMT*, CO_NMT_RESET)> reset_request;
  std::function<void(CO_IF_FRM*)> can_receive;
  std::function<void(CO_NODE*, CO_CAN_EVENT)> can_change;
  std::function<void()> lock;
  std::function<void()> unlock;
  unsigned fatal_errors = 0;  ///< CONodeFatalError() is counted and returns
};

Callbacks& callbacks();

}  // namespace test
