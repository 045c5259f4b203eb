// SPDX-License-Identifier: Apache-2.0
/// \file facts.hpp
/// The states of the nodes of a bus, and the values of their objects, as the frames so far show them.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "describe/monitor.hpp"
#include "explain/finding.hpp"

namespace lexican::explain {

constexpr Micros one_ms = 1'000;
constexpr Micros one_second = 1'000'000;

constexpr std::uint32_t bit_rates[] = {10'000,  20'000,  50'000,  100'000,  125'000,
                                       250'000, 500'000, 800'000, 1'000'000};  ///< [301:6.4]

/// NMT states as messages of error control name them, and NMT commands. [301:7.2.8.3]
namespace nmt {
constexpr std::uint8_t boot_up = 0;
constexpr std::uint8_t stopped = 4;
constexpr std::uint8_t operational = 5;
constexpr std::uint8_t pre_operational = 127;
constexpr std::uint8_t start = 1;
constexpr std::uint8_t stop = 2;
constexpr std::uint8_t enter_pre_operational = 128;
constexpr std::uint8_t reset_node = 129;
constexpr std::uint8_t reset_communication = 130;
}  // namespace nmt

struct NodeFacts {
  bool is_heard = false;
  bool is_server = false;             ///< it has sent more than error control
  Micros heard = 0;                   ///< last frame that the node has sent
  std::optional<std::uint8_t> state;  ///< by its last message, or by a later NMT command
  Micros state_since = 0;             ///< of `state`
  Micros state_heard = 0;             ///< last heartbeat, or answer to node guarding
  std::uint8_t command = 0;           ///< last NMT command to it; 0: none
  Micros commanded = 0;
};

/// Value of an object that was transferred.
struct KnownValue {
  std::uint32_t value = 0;
  Micros time = 0;
};

class Facts {
 public:
  static constexpr std::size_t most_values = 65536;

  /// \a network and \a monitor must outlive it. \a bit_rate: bit/s; 0: it is estimated
  Facts(const describe::Network& network, const describe::Monitor& monitor, std::uint32_t bit_rate)
      : network_(network), monitor_(monitor), bit_rate_(bit_rate) {}

  void frame(const Entry& entry);
  void transfer(std::uint8_t node, const describe::SdoTransfer& transfer);
  /// Forgets the states: the time of the recording has jumped.
  void forget_states();

  const NodeFacts& node(std::uint8_t node) const { return nodes_[node]; }
  /// Returns true if the node was told to enter a state, or to start anew, within a time.
  bool was_commanded(std::uint8_t node, Micros now, Micros within) const;
  bool is_operational(std::uint8_t node) const { return nodes_[node].state == nmt::operational; }
  /// Returns true for the identifier of SYNC: 080h, and those of 1005h that were transferred.
  bool is_sync(std::uint16_t identifier) const {
    return identifier == 0x080 || std::find(syncs_.begin(), syncs_.end(), identifier) != syncs_.end();
  }
  /// Returns the value of an object as it was transferred; nothing: it was not.
  std::optional<KnownValue> observed(std::uint8_t node, std::uint16_t index, std::uint8_t sub_index) const;
  /// Returns the value as it was transferred, else that of the description.
  std::optional<std::uint32_t> value(std::uint8_t node, std::uint16_t index, std::uint8_t sub_index) const;
  std::string object(std::uint8_t node, std::uint16_t index, std::uint8_t sub_index) const {
    return network_.of(node).object(index, sub_index);
  }
  bool is_described(std::uint8_t node) const { return network_.of(node).device() != nullptr; }
  const describe::Monitor& monitor() const { return monitor_; }
  Micros now() const { return now_; }
  bool is_rate_given() const { return bit_rate_ != 0; }
  /// Returns the bit rate in bit/s: that which is given, else the lowest one at which the frames fit, if different
  /// identifiers follow each other as closely as it permits; 0: unknown.
  std::uint32_t rate() const;
  /// Returns the time so far in which each frame came directly after the one before.
  Micros full_time() const { return full_time_; }

 private:
  void learn_rate(const Entry& entry);
  void hear(std::uint8_t node, Micros time);
  void set_state(std::uint8_t node, std::uint8_t state, Micros time);
  void command(std::uint8_t node, std::uint8_t command, Micros time);

  using Key = std::tuple<std::uint8_t, std::uint16_t, std::uint8_t>;

  const describe::Network& network_;
  const describe::Monitor& monitor_;
  std::array<NodeFacts, 128> nodes_{};
  std::map<Key, KnownValue> values_;
  std::vector<std::uint16_t> syncs_;
  std::uint32_t bit_rate_;
  std::uint64_t frames_ = 0;
  Micros full_time_ = 0;
  std::array<std::uint64_t, std::size(bit_rates)> faster_{};    ///< frames that do not fit the rate
  std::array<std::uint64_t, std::size(bit_rates)> adjacent_{};  ///< frames directly behind one of another identifier
  std::uint32_t identifier_ = 0;                                ///< of the last frame
  Micros now_ = 0;
};

/// Identifier of a frame with 11 bits, without remote and error frames; nothing for others.
std::optional<std::uint16_t> plain_identifier(const CO_IF_FRM& frame);

/// Returns "1.5 s" or "20 ms".
std::string time_text(Micros time);

}  // namespace lexican::explain
