// SPDX-License-Identifier: Apache-2.0
/// \file arguments.hpp
/// Converts the arguments of a master's command line to requests.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/lss_master.hpp"
#include "client/values.hpp"

namespace lexican {

/// The options of read and write as texts of the command line, not yet checked.
struct Arguments {
  bool write = false;
  std::string node;
  std::string own_id;  // empty: 127, or 126 if that is the remote node
  std::string index;   // hexadecimal with or without 0x, decimal with 0d; so is sub
  std::string sub = "0";
  std::string type;                  // empty: read guesses the type, write copies the file unchanged
  std::optional<std::string> value;  // argument of write
  std::string file;                  // instead of the value; empty: none, "-": standard input or output
  std::string timeout = "1000";
  std::string max = "16777216";
};

struct Request {
  bool write;
  std::uint8_t node;
  std::uint8_t own_id;
  std::uint16_t index;
  std::uint8_t sub;
  std::optional<ValueType> type;  // read: type in which the value is printed; none: guess
  Bytes data;                     // write
  std::string file;               // read: file for the bytes; empty: the value is printed
  std::uint32_t timeout;          // ms, for each answer; 0: no time-out
  std::uint32_t capacity;         // read: largest size of the object, bytes
};

struct Prepared {
  Request request;
  std::string fault;  // empty: the arguments are valid
};

/// Converts the arguments. Reads the file that has to be written to the object.
Prepared prepare(const Arguments& arguments);

// --- nmt

/// Command specifiers. [301:7.2.8.2.1]
enum class NmtCommand : std::uint8_t { start = 1, stop = 2, preop = 128, reset_node = 129, reset_comm = 130 };

/// The names of all commands, for --help.
constexpr const char* nmt_command_names = "start, stop, preop, reset-node, reset-comm";

/// The options of nmt as texts of the command line, not yet checked.
struct NmtArguments {
  std::string command;  // one of nmt_command_names
  std::string node;     // or "all"
  std::string own_id;   // empty: 127, or 126 if that is the remote node
};

struct NmtRequest {
  NmtCommand command;
  std::uint8_t node;  // 0: all
  std::uint8_t own_id;
};

struct NmtPrepared {
  NmtRequest request;
  std::string fault;  // empty: the arguments are valid
};

NmtPrepared prepare(const NmtArguments& arguments);

// --- tour

struct TourPrepared {
  std::uint8_t node;
  std::string fault;  // empty: the arguments are valid
};

TourPrepared prepare_tour(const Arguments& arguments);

// --- lss

enum class LssAction { scan, set_id, set_bit_rate, store, inquire };

/// The options of lss; texts of the command line are not yet checked.
struct LssArguments {
  LssAction action = LssAction::scan;
  std::vector<std::string> address;  // empty: a node without node-ID
  std::string value;                 // argument of set-id and set-bitrate
  bool store = false;                // run the service store afterwards
  std::string own_id = "127";
  std::string timeout = "1000";
  std::string listen = "50";
};

struct LssRequest {
  LssAction action;
  std::optional<LssAddress> address;  // none: a node without node-ID
  std::uint32_t value;                // node-ID, or bit/s
  bool store;
  std::uint8_t own_id;
  std::uint32_t timeout;  // ms, for the answer of a node
  std::uint32_t listen;   // ms, for each request that searches for nodes
};

struct LssPrepared {
  LssRequest request;
  std::string fault;  // empty: the arguments are valid
};

LssPrepared prepare(const LssArguments& arguments);

}  // namespace lexican
