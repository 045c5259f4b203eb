// SPDX-License-Identifier: Apache-2.0
#include "client/arguments.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <system_error>
#include <utility>

#include "client/sdo_client.hpp"
#include "trace/text.hpp"

namespace lexican {
namespace {

using Kind = ValueType::Kind;

constexpr std::uint32_t longest = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint8_t usual_own_id = 127;

/// Converts arguments and stores the first fault.
class Conversion {
 public:
  /// Converts a number. \a name: used in the error message.
  std::uint32_t number(const char* name, const std::string& text, std::uint32_t lowest, std::uint32_t highest) {
    const Encoded encoded = encode({Kind::unsigned_integer, 8}, text);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < encoded.bytes.size(); ++i) {
      value |= static_cast<std::uint64_t>(encoded.bytes[i]) << (8 * i);
    }
    if (!encoded.fault.empty() || value < lowest || value > highest) {
      fail(std::string(name) + ": '" + text + "' is no number in " + std::to_string(lowest) + "..." +
           std::to_string(highest));
      return lowest;
    }
    return static_cast<std::uint32_t>(value);
  }

  /// Converts the number of an object: hexadecimal with or without 0x, decimal with 0d.
  std::uint32_t object_number(const char* name, const std::string& text, std::uint32_t highest) {
    const std::string prefix = text.substr(0, 2);
    const bool is_decimal = prefix == "0d" || prefix == "0D";
    const bool has_prefix = is_decimal || prefix == "0x" || prefix == "0X";
    const std::string digits = text.substr(has_prefix ? 2 : 0);
    std::uint32_t value = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value, is_decimal ? 10 : 16);
    if (error != std::errc() || stop != end || value > highest) {
      fail(std::string(name) + ": '" + text + "' is no hexadecimal number in 0..." + hex(highest) +
           " (0d before decimal digits)");
      return 0;
    }
    return value;
  }

  void fail(const std::string& text) { fault = fault.empty() ? text : fault; }

  std::string fault;

 private:
  static std::string hex(std::uint32_t number) { return text("%X", static_cast<unsigned>(number)); }
};

std::string read_all(std::istream& in, Bytes& bytes) {
  bytes.assign(std::istreambuf_iterator<char>(in), {});
  return in.bad() ? std::strerror(errno) : "";
}

std::string read_file(const std::string& name, Bytes& bytes) {
  if (name == "-") {
    return read_all(std::cin, bytes);
  }
  std::ifstream in(name, std::ios::binary);
  return in ? read_all(in, bytes) : std::strerror(errno);
}

/// Returns true if the value is a string or bytes, whose number is not fixed.
bool is_any_bytes(const std::optional<ValueType>& type) { return !type || type->size == 0; }

Bytes data_to_write(const Arguments& arguments, const std::optional<ValueType>& type, Conversion& conversion) {
  Encoded encoded;
  if (arguments.value.has_value() == !arguments.file.empty()) {
    conversion.fail("write needs a value, or a --file, and not both");
  } else if (!arguments.file.empty()) {
    const std::string fault = read_file(arguments.file, encoded.bytes);
    encoded.fault = fault.empty() ? fault : "cannot read '" + arguments.file + "': " + fault;
  } else if (!type) {
    conversion.fail("write needs the --type of the value");
  } else {
    encoded = encode(*type, *arguments.value);
  }
  if (!encoded.fault.empty()) {
    conversion.fail(encoded.fault);
  } else if (encoded.bytes.empty()) {
    conversion.fail("nothing to write: an SDO transfer carries at least one byte");
  } else if (encoded.bytes.size() > longest) {
    conversion.fail("'" + arguments.file + "' is too long for an SDO transfer");
  }
  return encoded.bytes;
}

std::optional<LssAddress> lss_address(const std::vector<std::string>& typed, Conversion& conversion) {
  LssAddress address{};
  if (typed.empty()) {
    return std::nullopt;
  }
  if (typed.size() != address.size()) {
    conversion.fail("--address: an LSS address has four numbers");
    return std::nullopt;
  }
  for (std::size_t part = 0; part < address.size(); ++part) {
    address[part] = conversion.number("--address", typed[part], 0, longest);
  }
  return address;
}

std::uint32_t bit_rate(const std::string& typed, Conversion& conversion) {
  constexpr std::uint32_t rates[] = {1000000, 800000, 500000, 250000, 125000, 50000, 20000, 10000};
  const std::uint32_t rate = conversion.number("set-bitrate", typed, 0, longest);
  if (std::find(std::begin(rates), std::end(rates), rate) == std::end(rates)) {
    conversion.fail("set-bitrate: '" + typed +
                    "' is none of 1000000, 800000, 500000, 250000, 125000, 50000, 20000, 10000");
  }
  return rate;
}

std::uint32_t lss_value(const LssArguments& arguments, Conversion& conversion) {
  switch (arguments.action) {
    case LssAction::set_id: return conversion.number("set-id", arguments.value, 1, 127);
    case LssAction::set_bit_rate: return bit_rate(arguments.value, conversion);
    default: return 0;
  }
}

NmtCommand nmt_command(const std::string& name, Conversion& conversion) {
  constexpr std::pair<const char*, NmtCommand> commands[] = {{"start", NmtCommand::start},
                                                             {"stop", NmtCommand::stop},
                                                             {"preop", NmtCommand::preop},
                                                             {"reset-node", NmtCommand::reset_node},
                                                             {"reset-comm", NmtCommand::reset_comm}};
  for (const auto& [known, command] : commands) {
    if (name == known) {
      return command;
    }
  }
  conversion.fail("nmt: '" + name + "' is none of " + nmt_command_names);
  return {};
}

/// Returns the node-ID of the master, which must differ from \a node.
std::uint8_t own_id_beside(std::uint8_t node, const std::string& typed, Conversion& conversion) {
  if (typed.empty()) {
    return node == usual_own_id ? usual_own_id - 1 : usual_own_id;
  }
  const auto own_id = static_cast<std::uint8_t>(conversion.number("--own-id", typed, 1, 127));
  if (own_id == node) {
    conversion.fail("--own-id: the remote node has this node-ID");
  }
  return own_id;
}

}  // namespace

Prepared prepare(const Arguments& arguments) {
  Conversion conversion;
  Request request{};
  request.write = arguments.write;
  request.node = static_cast<std::uint8_t>(conversion.number("--node", arguments.node, 1, 127));
  request.own_id = own_id_beside(request.node, arguments.own_id, conversion);
  request.index = static_cast<std::uint16_t>(conversion.object_number("--index", arguments.index, 0xFFFF));
  request.sub = static_cast<std::uint8_t>(conversion.object_number("--sub", arguments.sub, 0xFF));
  request.timeout = conversion.number("--timeout", arguments.timeout, 0, longest);
  request.type = value_type(arguments.type);
  request.file = arguments.file;
  const std::uint32_t max = conversion.number("--max", arguments.max, 1, longest);
  request.capacity = is_any_bytes(request.type) ? max : SdoClient::small;
  if (!request.type && !arguments.type.empty()) {
    conversion.fail("--type: '" + arguments.type + "' is none of " + value_type_names);
  }
  if (!is_any_bytes(request.type) && !arguments.file.empty()) {
    conversion.fail("--type: a file holds bytes, no " + arguments.type);
  }
  if (request.write && conversion.fault.empty()) {
    request.data = data_to_write(arguments, request.type, conversion);
  }
  return {request, conversion.fault};
}

NmtPrepared prepare(const NmtArguments& arguments) {
  Conversion conversion;
  NmtRequest request{};
  request.command = nmt_command(arguments.command, conversion);
  if (arguments.node.empty()) {
    conversion.fail("nmt needs the node to command: --node 1...127, or --node all");
  } else if (arguments.node != "all") {
    request.node = static_cast<std::uint8_t>(conversion.number("--node", arguments.node, 1, 127));
  }
  request.own_id = own_id_beside(request.node, arguments.own_id, conversion);
  return {request, conversion.fault};
}

TourPrepared prepare_tour(const Arguments& arguments) {
  Conversion conversion;
  const std::string node = arguments.node.empty() ? "1" : arguments.node;
  return {static_cast<std::uint8_t>(conversion.number("--node", node, 1, 127)), conversion.fault};
}

LssPrepared prepare(const LssArguments& arguments) {
  Conversion conversion;
  LssRequest request{};
  request.action = arguments.action;
  request.address = lss_address(arguments.address, conversion);
  request.value = lss_value(arguments, conversion);
  request.store = arguments.store || arguments.action == LssAction::store;
  request.own_id = static_cast<std::uint8_t>(conversion.number("--own-id", arguments.own_id, 1, 127));
  request.timeout = conversion.number("--timeout", arguments.timeout, 1, longest);
  request.listen = conversion.number("--listen", arguments.listen, 1, longest);
  if (arguments.store && (request.action == LssAction::scan || request.action == LssAction::inquire)) {
    conversion.fail("--store: scan and inquire change nothing that could be stored");
  }
  if (request.action == LssAction::scan && request.address) {
    conversion.fail("--address: scan looks for all nodes without node-ID");
  }
  return {request, conversion.fault};
}

}  // namespace lexican
