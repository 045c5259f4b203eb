// SPDX-License-Identifier: Apache-2.0
// What a PDO holds: a mapping of the dictionary, resolved into copies, and these copies.
#pragma once

#include "co_core.h"

namespace co::pdo {

enum class Direction : uint8_t { receive, transmit };

// May the object that a mapping entry names be mapped so? [301:7.4.7, 7.5.2.36]
[[nodiscard]] CO_ERR check(CO_NODE& node, Direction direction, uint32_t mapping);

// Resolves num entries of the mapping at index (1600h…, 1A00h…).
[[nodiscard]] CO_ERR resolve(CO_NODE& node, Direction direction, uint16_t index, uint8_t num, CO_PDO_MAP& map);

// Copies the data of a frame into the objects.
void write(CO_NODE& node, CO_PDO_MAP& map, const CO_IF_FRM& frame);

// Copies the objects into a frame. Returns what the type of one has answered that could not be read.
[[nodiscard]] CO_ERR read(CO_NODE& node, CO_PDO_MAP& map, CO_IF_FRM& frame);

// Place of the object in the mapping, or Num.
[[nodiscard]] uint8_t find(const CO_NODE& node, const CO_PDO_MAP& map, const CO_OBJ& obj);

// Holds CO_NODE_EXT.OdLock while it lives.
class Lock {
 public:
  explicit Lock(CO_NODE& node);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  CO_NODE& node_;
};

// Every object has passed. Asking forgets it.
void pass(CO_PDO_MAP& map);
[[nodiscard]] bool has_passed(CO_PDO_MAP& map, uint8_t place);

}  // namespace co::pdo
