// SPDX-License-Identifier: Apache-2.0
/// \file configuration.hpp
/// The configuration of a device: the values that a DCF stores, and that are written to a device of the same kind.
#pragma once

#include <set>
#include <utility>

#include "describe/description.hpp"

namespace lexican::describe {

/// Index and sub-index.
using EntryKey = std::pair<std::uint16_t, std::uint8_t>;

constexpr EntryKey device_type{0x1000, 0};

/// Returns "1018h:01, 6060h" for the first entries, and how many there are more.
std::string keys_text(const std::vector<EntryKey>& keys);

/// How an entry belongs to the configuration.
enum class Part : std::uint8_t {
  configuration,
  read_only,      ///< also a constant
  write_only,     ///< its value cannot be read
  process_value,  ///< mapped in a PDO that is valid
  domain,
  command,    ///< what is written has an effect at once: store, restore, program download, the controlword of a drive
  set_point,  ///< where a drive has to go, or an output of an I/O module
};

/// Removes all configured values from a description.
void forget_values(codict::Device& device);

/// Returns the entries that the valid PDOs of a device map.
std::set<EntryKey> mapped_entries(const codict::Device& device);

/// \a mapped: as mapped_entries() has returned it.
Part part_of(const codict::Device& device, const EntryKey& key, const std::set<EntryKey>& mapped);

/// Returns whether two values of an entry are the same: a text may be filled with zeros.
bool is_equal(const codict::Device& device, const EntryKey& key, Bytes one, Bytes other);

/// Stores the device type (1000h), which a description may lack, as its default value.
void store_device_type(codict::Device& device, std::uint32_t value);

/// Stores the value of a device as ParameterValue. The COB-ID of a default that contains the node-ID becomes
/// $NODEID + base, so that it fits another node, too.
/// \retval false  a DCF cannot express it
bool store_value(codict::Device& device, const EntryKey& key, std::uint8_t node, const Bytes& bytes);

/// Returns a description with the configuration of a node as the text of a DCF. \a file_name: that of the DCF.
/// \a bit_rate: bit/s, 0: unknown.
std::string to_dcf(codict::Device device, std::uint8_t node, std::uint32_t bit_rate, const std::string& file_name);

}  // namespace lexican::describe
