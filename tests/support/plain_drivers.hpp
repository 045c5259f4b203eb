// SPDX-License-Identifier: Apache-2.0
/// \file plain_drivers.hpp
/// A node on drivers without context, whose timer is a periodic interrupt or a compare match. One at a time.
#pragma once

#include <cstdint>

#include "co_core.h"

namespace test {

struct PlainTimer {
  bool cyclic;
  std::uint64_t now;
  std::uint64_t left;  ///< cyclic: count-down; tickless: ticks until the compare match
  bool running;
  bool update_always;  ///< Update answers 1 whatever happens
  unsigned inits;
};
PlainTimer& plain_timer();

/// 1000 ticks/s, a dictionary of one entry (or none), eight timers of the application.
struct PlainNode {
  CO_OBJ dictionary[2];
  CO_TMR_MEM memory[8];
  CO_IF_DRV drivers;
  CO_NODE node;

  explicit PlainNode(bool cyclic, CO_OBJ entry = CO_OBJ CO_OBJ_DICT_ENDMARK);
  PlainNode(const PlainNode&) = delete;
  PlainNode& operator=(const PlainNode&) = delete;

  /// A tick of the hardware: the interrupt, then the loop if it is in time.
  void tick(bool loop = true);
  void ticks(unsigned number, bool loop = true);
};

}  // namespace test
