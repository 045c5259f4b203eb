// SPDX-License-Identifier: Apache-2.0
// Parameter groups of 1010h and 1011h.
#pragma once

#include "co_assert.h"
#include "co_core.h"

namespace co::para {

constexpr uint16_t store_index = 0x1010;
constexpr uint16_t restore_index = 0x1011;
constexpr unsigned version_bit = 8;  // lowest bit of the version in CO_PARA.Value
constexpr uint16_t verify_index = 0x1020;

inline uint8_t* memory_of(const CO_PARA& group) { return group.Start; }
constexpr bool is_saved_on_command(const CO_PARA& group) { return (group.Value & CO_PARA___E) != 0; }
constexpr bool is_saved_autonomously(const CO_PARA& group) { return (group.Value & CO_PARA__A_) != 0; }

// The groups of 1010h or 1011h: sub-index 1 stands for all that follow it, if any do. [301:7.5.2.13]
class Groups {
 public:
  Groups(CO_NODE& node, uint16_t index);

  // Returns the next group; null: there is none.
  [[nodiscard]] const CO_PARA* next();

  // Returns whether sub-index 1 stands for other groups.
  [[nodiscard]] bool are_several() const { return last_ > 1; }

  // Returns the entry whose group next() has returned.
  [[nodiscard]] const CO_OBJ& entry() const {
    CO_ASSERT(entry_ != nullptr);
    return *entry_;
  }

 private:
  CO_NODE& node_;
  const CO_OBJ* entry_;
  uint16_t index_;
  uint8_t sub_;
  uint8_t last_;
};

}  // namespace co::para
