// SPDX-License-Identifier: Apache-2.0
/// \file invariants.hpp
/// Invariants that are checked after every frame of every test: the format of frames, the NMT states in which they may
/// be sent, and dictionary memory that must not change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "co_core.h"

namespace test {

/// Returns the fault of a frame; empty if a node with \a node_id may send \a frm in \a mode. \a sdo: the frame is sent
/// by an SDO server; \a sending: within a block upload, after its start.
std::string fault_of(const CO_IF_FRM& frm, std::uint8_t node_id, CO_MODE mode, bool sdo, bool sending = false);

/// Copy of the memory of a dictionary's entries.
class MemoryWatch {
 public:
  void add(CO_OBJ& entry);  ///< domains of more than 100000 bytes are omitted
  void add(std::uint32_t key, const void* memory, std::size_t size, bool stream);
  void release(std::uint32_t dev);  ///< changes of this entry are allowed from this call on
  void remember();
  /// Returns the entries (without flags) whose memory has changed.
  std::vector<std::uint32_t> changed() const;
  bool is_stream(std::uint32_t dev) const;
  bool is_read_only(std::uint32_t dev) const;
  /// Returns true for an entry that shares the memory of an entry which was allowed to change.
  bool shares(std::uint32_t dev, const std::set<std::uint32_t>& allowed) const;

 private:
  struct Region {
    std::uint32_t key;
    const std::uint8_t* memory;
    std::size_t size;
    bool stream;
    std::size_t copy;  // its place in copies_
  };
  // Pointers, since every call of every test walks over the regions and iterators are slow without optimisation.
  Region* begin() { return regions_.data(); }
  const Region* begin() const { return regions_.data(); }
  const Region* end() const { return regions_.data() + regions_.size(); }
  const Region* find(std::uint32_t dev) const;
  std::vector<Region> regions_;
  std::vector<std::uint8_t> copies_;
};

}  // namespace test
