// SPDX-License-Identifier: Apache-2.0
// Parameter groups: 1010h and 1011h, loading and storing. [301:7.5.2.13, 7.5.2.14]
#pragma once

#include "base/part.hpp"
#include "co_assert.h"
#include "co_core.h"
#include "storage/store.hpp"

namespace co::para {

// Loads the groups of a reset: stored values, otherwise defaults. Must be called before the values are read. member:
// number of bytes to load: Size (all) or ComSize (the objects of the communication profile). In Initialisation, starts
// the timer that stores autonomous groups. Returns the last error, which is also the node's error.
CO_ERR load(CO_NODE& node, CO_NMT_RESET type, uint32_t CO_PARA::*member);

// Loads the groups of a reset, as its type requires.
void load_groups(CO_NODE& node, CO_NMT_RESET type);

// Stores the autonomous groups that have changed, within the budget. Timer action: called each CO_PARA_PERIOD, and
// before a reset loads the groups.
void save_changes(void* node_pointer);

void on_mode(CO_NODE& node);

// Marks the configuration as not verified (1020h) when the network has written an object of a group.
void on_write(CO_NODE* node, const CO_OBJ* obj);

// Stores data of a group; null: the request to use the defaults.
[[nodiscard]] CO_ERR save(CO_NODE& node, const CO_PARA& group, const uint8_t* data,
                          store::Cause cause = store::Cause::command);

inline constexpr Part part = Part().load(load_groups).mode(on_mode).reset([](CO_NODE& node) { save_changes(&node); });

// Parameter groups of 1010h and 1011h.

constexpr uint16_t store_index = 0x1010;
constexpr uint16_t restore_index = 0x1011;
constexpr unsigned version_bit = 8;  // lowest bit of the version in CO_PARA.Value
constexpr uint16_t verify_index = 0x1020;

inline uint8_t* memory_of(const CO_PARA& group) { return group.Start; }
constexpr bool is_saved_on_command(const CO_PARA& group) { return (group.Value & CO_PARA___E) != 0; }
constexpr bool is_saved_autonomously(const CO_PARA& group) { return (group.Value & CO_PARA__A_) != 0; }

// The groups of 1010h or 1011h: sub-index 1 selects all that follow it, if any do. [301:7.5.2.13]
class Groups {
 public:
  Groups(CO_NODE& node, uint16_t index);

  // Returns the next group; null: there is none.
  [[nodiscard]] const CO_PARA* next();

  // Returns whether sub-index 1 selects other groups.
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
