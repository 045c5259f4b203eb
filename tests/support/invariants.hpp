// SPDX-License-Identifier: Apache-2.0
/// \file invariants.hpp
/// What must hold after every frame of every test: forms of frames, NMT states in which they may be sent, and memory of
/// the dictionary that nobody was allowed to change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "co_core.h"

namespace test {

/// Empty if a node with \a node_id may send \a frm in \a mode, else what is wrong with it. \a sdo: the frame is one of
/// an SDO server.
std::string fault_of(const CO_IF_FRM& frm, std::uint8_t node_id, CO_MODE mode, bool sdo);

/// The bytes behind the entries of a dictionary.
class MemoryWatch {
 public:
  void add(CO_OBJ& entry);
  void add(std::uint32_t key, const void* memory, std::size_t size, bool stream);
  void release(std::uint32_t dev);  ///< changes of this entry are of no interest any more
  void remember();
  /// Entries (without flags) whose memory is not as it was remembered.
  std::vector<std::uint32_t> changed() const;
  bool is_stream(std::uint32_t dev) const;
  bool is_read_only(std::uint32_t dev) const;
  /// The same, for an entry that shares the memory of one which was allowed to change.
  bool shares(std::uint32_t dev, const std::set<std::uint32_t>& allowed) const;

 private:
  struct Region {
    std::uint32_t key;
    const std::uint8_t* memory;
    std::size_t size;
    bool stream;
    std::vector<std::uint8_t> copy;
  };
  const Region* find(std::uint32_t dev) const;
  std::vector<Region> regions_;
};

/// Follows the downloads on the bus, and so knows what they may change.
class DownloadObserver {
 public:
  void request(const CO_IF_FRM& frm);
  void answer(const CO_IF_FRM& frm);
  /// Takes the entries whose download was confirmed since the last call.
  std::set<std::uint32_t> take_completed();
  /// Entries with an open download, or with one that ended since the last call of take_completed().
  std::set<std::uint32_t> streaming() const;
  void reset();

 private:
  struct Request {
    std::uint8_t command;
    std::uint32_t dev;
    std::uint32_t id;
  };
  void initiated(const Request& request);
  void segment_taken(const Request& request);
  std::optional<Request> request_;
  std::map<std::uint32_t, std::uint32_t> open_;  ///< entry by CAN-ID of the request
  std::set<std::uint32_t> completed_;
  std::set<std::uint32_t> ended_;
};

}  // namespace test
