// SPDX-License-Identifier: Apache-2.0
/// \file pdo.hpp
/// The PDOs of a device as it has them now. [301:7.5.2.35 ff.]
#pragma once

#include "describe/configuration.hpp"
#include "program/session.hpp"

namespace lexican::program {

struct PdoOptions {
  Common common;
  std::string command;
  std::vector<std::string> words;  ///< node, PDO, objects
  // map
  std::string cob_id;
  std::optional<std::string> type;
  std::optional<std::string> inhibit_time;
  std::optional<std::string> event_timer;
  bool is_off = false;
  // watch
  bool has_plot = false;
  std::string csv;
  std::string svg;
  std::uint32_t duration = 0;  ///< s; 0: until Ctrl-C
  // send
  std::uint32_t period = 0;  ///< ms; 0: once
  bool sends_sync = false;
  bool is_forced = false;
};

/// Which PDO of a device.
struct PdoName {
  bool is_transmit = false;
  std::uint16_t number = 1;

  bool operator==(const PdoName& other) const { return is_transmit == other.is_transmit && number == other.number; }
  /// Returns "TPDO1".
  std::string text() const;
  std::uint16_t communication() const {
    return static_cast<std::uint16_t>((is_transmit ? 0x1800U : 0x1400U) + number - 1U);
  }
  std::uint16_t mapping() const { return static_cast<std::uint16_t>(communication() + 0x0200U); }
};

/// Parses tpdo1 to tpdo512 and rpdo1 to rpdo512.
std::optional<PdoName> pdo_of(std::string_view word);

/// An object in a mapping.
struct MappedEntry {
  describe::EntryKey key;
  unsigned bits = 0;

  bool is_dummy() const { return key.first < 0x20; }
};

struct DevicePdo {
  PdoName name;
  std::uint32_t cob_id = 0;  ///< with the bits of CiA 301
  std::optional<std::uint32_t> type;
  std::optional<std::uint32_t> inhibit_time;  ///< multiples of 100 us
  std::optional<std::uint32_t> event_timer;   ///< ms
  std::vector<MappedEntry> mapped;            ///< those in force
  bool is_multiplexed = false;

  bool is_valid() const { return (cob_id & 0x80000000U) == 0; }
  /// Returns "185h", or "00001200h" for an extended identifier.
  std::string identifier() const;
  CO_IF_FRM frame() const;
  unsigned bits() const;
};

/// Reads the PDOs of a device. The description of a node is that of \a network.
class PdoReader {
 public:
  PdoReader(Session& session, std::uint8_t node, const describe::Network& network, std::uint32_t timeout)
      : session_(session), node_(node), network_(network), timeout_(timeout) {}

  /// Reads a PDO.
  /// \retval ok       \a pdo is it, or nothing if the device does not have it
  /// \retval another  status of the program; the reason is printed
  int read(const PdoName& name, std::optional<DevicePdo>& pdo);
  /// Reads the PDOs that the description has. Without a description: RPDO1, RPDO2, and so on, until four are missing,
  /// and the TPDOs in the same way. \retval status  as read()
  int read_all(std::vector<DevicePdo>& pdos);

  const describe::Description& description() const { return network_.of(node_); }
  std::uint8_t node() const { return node_; }
  Session& session() { return session_; }
  std::uint32_t timeout() const { return timeout_; }
  /// Prints why a transfer has failed.
  /// \retval status of the program
  int report(const describe::EntryKey& key, const Transfer& transfer);

 private:
  enum class Entry { read, absent, failed };
  Entry read_entry(std::uint16_t index, std::uint8_t sub_index, std::uint32_t& value);
  int read_mapping(DevicePdo& pdo);

  Session& session_;
  std::uint8_t node_;
  const describe::Network& network_;
  std::uint32_t timeout_;
  int status_ = ok;  ///< of read_entry()
};

/// Returns name and parameters of a PDO, and the objects it maps, each in a line.
std::string text_of(const DevicePdo& pdo, const describe::Description& description);
/// Prints it as one JSON object.
void print_json(const DevicePdo& pdo, std::uint8_t node, const describe::Description& description);

int run_map(const PdoOptions& options, PdoReader& reader, const std::vector<std::string>& words);
int run_send(const PdoOptions& options, PdoReader& reader, const std::vector<std::string>& words);
/// Opens the bus, which can be a log.
int run_watch(const PdoOptions& options, std::uint8_t node, describe::Network& network,
              const std::vector<std::string>& words);

}  // namespace lexican::program
