// SPDX-License-Identifier: Apache-2.0
/// \file finding.hpp
/// A cause that was found on a bus, with the frames that show it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "bus/log.hpp"
#include "explain/cause.hpp"

namespace lexican::explain {

using host_bus::Entry;
using host_bus::Micros;

struct ShownFrame {
  Micros time = 0;
  std::string text;
};

/// Frames that show a cause. The memory in use is bounded.
class Evidence {
 public:
  static constexpr std::size_t most_frames = 3;
  static constexpr std::size_t most_times = 1000;

  /// \a words: the meaning of the frame
  void add(const Entry& entry, const std::string& words);
  /// \a words: a function that returns it, and is called if it is shown
  template <typename Words, typename = std::enable_if_t<std::is_invocable_v<Words>>>
  void add(const Entry& entry, const Words& words) {
    add(entry, frames_.size() < most_frames ? words() : std::string());
  }
  void add(Micros time, const std::string& words);
  /// Also shows the first frame of other evidence, in place of the last one if there are many.
  void show_also(const Evidence& other);
  void clear() { *this = {}; }
  unsigned count() const { return count_; }
  /// Returns true if a finding with it should be written anew: not for each frame of thousands.
  bool is_news() const { return count_ <= 32 || count_ % 32 == 0; }
  Micros since() const { return since_; }
  Micros until() const { return until_; }
  const std::vector<ShownFrame>& frames() const { return frames_; }
  const std::vector<Micros>& times() const { return times_; }

 private:
  unsigned count_ = 0;
  Micros since_ = 0;
  Micros until_ = 0;
  std::vector<ShownFrame> frames_;  ///< the first ones
  std::vector<Micros> times_;       ///< of the first ones
};

struct Finding {
  CauseId cause{};
  std::uint8_t node = 0;     ///< that has the fault; 0: none, or unknown
  std::uint32_t detail = 0;  ///< distinguishes findings of a cause and a node
  std::string title;         ///< subject and fault, in one line
  std::string text;          ///< how it is known; one or more sentences
  std::string check;         ///< how to verify it
  std::string fix;           ///< how to remedy it; empty: check says enough
  Evidence evidence;
};

/// The findings of the checks, by cause, node and detail. The number is bounded.
class Findings {
 public:
  static constexpr std::size_t most_of_cause = 32;
  using Key = std::tuple<CauseId, std::uint8_t, std::uint32_t>;

  /// Adds a finding, or replaces the one with the same cause, node and detail.
  void put(Finding finding);
  /// Returns false if put() would leave it out.
  bool accepts(CauseId cause, std::uint8_t node, std::uint32_t detail) const;
  /// Removes a finding that later frames refute.
  void remove(CauseId cause, std::uint8_t node, std::uint32_t detail) { all_.erase({cause, node, detail}); }
  bool has(CauseId cause, std::uint8_t node) const;
  const std::map<Key, Finding>& all() const { return all_; }
  /// Returns true if findings of a cause were left out, because there are too many.
  bool is_cut() const { return is_cut_; }

 private:
  std::size_t count(CauseId cause) const;

  std::map<Key, Finding> all_;
  bool is_cut_ = false;
};

}  // namespace lexican::explain
