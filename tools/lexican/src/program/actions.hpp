// SPDX-License-Identifier: Apache-2.0
/// \file actions.hpp
/// The commands of verbs on an open bus, for `lexican top`, too. Each prints its result, or why it has failed, and
/// returns the status of the program.
#pragma once

#include "program/command.hpp"
#include "program/search.hpp"
#include "program/session.hpp"

namespace lexican::program {

struct ReadOptions : TransferOptions {
  std::string output;  ///< -o
  std::uint32_t most = 16 * 1024 * 1024;
};

struct WriteOptions : TransferOptions {
  std::optional<std::string> value;
  std::string file;
  bool verifies = false;
  bool is_forced = false;  ///< also beyond the limits of the description
};

/// \a target: as prepare() has filled it.
int read_object(Session& session, const ReadOptions& options, Target& target);
/// \a data: the bytes to write; nothing: those of the options, by the type of the object.
int write_object(Session& session, const WriteOptions& options, Target& target, const std::optional<Bytes>& data);

struct NmtOptions {
  Common common;
  std::string command;
  std::optional<std::string> node;
};

/// A checked NMT command.
struct StateCommand {
  const char* name;
  CO_NMT_COMMAND specifier;
  std::uint8_t state;     ///< that error control shows afterwards; a reset ends with a boot-up message, 0
  std::uint8_t node = 0;  ///< 0: all

  /// Returns true if a physical bus needs a confirmation.
  bool is_grave() const { return node == 0 || state == 0; }
};

/// Checks node and command. Prints the reason if that fails.
std::optional<StateCommand> state_command(const NmtOptions& options);
/// Asks before a grave command, see agree().
int agree(const host_bus::Bus& bus, const NmtOptions& options, const StateCommand& command);
int change_state(Session& session, const NmtOptions& options, const StateCommand& command);

/// Returns "2 nodes and 1 without node-ID in 1.1 s, bus load 2.7 %" and a line end.
std::string summary_of(const Devices& found, const host_bus::Bus& bus, std::uint64_t bits, Micros time);
/// Prints why no device has answered.
int report_silence(const host_bus::Bus& bus, const HostLine& line);
/// Prints which node-IDs several devices may have, and why LSS has failed.
void report_conflicts(const Devices& found);

}  // namespace lexican::program
