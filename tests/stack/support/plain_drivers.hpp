// SPDX-License-Identifier: Apache-2.0
/// \file plain_drivers.hpp
/// A node on classic drivers, whose timer is a periodic interrupt or a compare match. Only one may exist at a time.
#pragma once

#include <cstdint>

#include "co_core.h"

namespace test {

struct PlainTimer {
  bool cyclic;
  std::uint64_t now;
  std::uint64_t left;  ///< ticks until the count-down ends (cyclic) or until the compare match
  bool running;
  bool update_always;  ///< Update always returns 1
  unsigned inits;
};
PlainTimer& plain_timer();

/// A node with 1000 ticks/s, a dictionary of at most one entry, and a pool of 8 timers.
struct PlainNode {
  CO_OBJ dictionary[2];
  CO_TMR_MEM memory[8];
  CO_IF_DRV drivers;
  CO_NODE node;

  explicit PlainNode(bool cyclic, CO_OBJ entry = CO_OBJ CO_OBJ_DICT_ENDMARK);
  PlainNode(const PlainNode&) = delete;
  PlainNode& operator=(const PlainNode&) = delete;

  /// Simulates a tick of the hardware: the timer interrupt, then COTmrProcess() if \a loop is true.
  void tick(bool loop = true);
  void ticks(unsigned number, bool loop = true);
};

}  // namespace test
