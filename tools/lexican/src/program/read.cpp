// SPDX-License-Identifier: Apache-2.0
// lexican read: reads an object of a device.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "program/actions.hpp"
#include "text/file.hpp"

namespace lexican::program {
namespace {

/// Returns the value as a number, a truth value or a text of printable characters; else null: the bytes are in "data".
nlohmann::json json_value(const Target& target, const Bytes& data) {
  using Kind = ValueType::Kind;
  const Shown plain = target.type ? show(*target.type, data) : Shown{{}, "unknown"};
  const Kind kind = plain.fault.empty() ? target.type->kind : Kind::bytes;
  const double real = kind == Kind::real ? std::stod(plain.text) : 0;
  const std::string text = visible_text(data);
  switch (kind) {
    case Kind::unsigned_integer: return std::stoull(plain.text);
    case Kind::integer: return std::stoll(plain.text);
    case Kind::boolean: return plain.text == "1";
    case Kind::text: return text.empty() && !data.empty() ? nlohmann::json() : nlohmann::json(text);
    case Kind::real: return std::isfinite(real) ? nlohmann::json(real) : nlohmann::json(plain.text);
    default: return nullptr;
  }
}

void print_json_value(const Target& target, const Bytes& data) {
  std::string hex;
  for (const std::uint8_t byte : data) {
    hex += fmt::format("{:02X}", byte);
  }
  nlohmann::json json = {{"node", target.node},
                         {"index", target.object.index},
                         {"sub", target.object.sub_index},
                         {"object", target.name},
                         {"value", json_value(target, data)},
                         {"text", shown(target, data)},
                         {"data", hex}};
  if (target.type) {
    json["type"] = type_text(*target.type);
  }
  print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

int write_output(const std::string& path, const Bytes& data) {
  std::string why;
  const std::string_view bytes(reinterpret_cast<const char*>(data.data()), data.size());
  if (codict::write_file(path, bytes, why) == codict::Written::no) {
    print_message(why);
    return usage;
  }
  return ok;
}

int upload_target(Session& session, const ReadOptions& options, const Target& target) {
  ProgressLine progress(std::cerr, shows_progress() ? Progress::Form::bar : Progress::Form::none);
  const auto upload = [&](std::uint32_t most) {
    return session.sdo().upload(target.object.index, target.object.sub_index,
                                {most, options.common.timeout, [&](const Amount& amount) { progress.update(amount); }});
  };
  // A block transfer is for long objects: simple devices know none, and refuse it first.
  Transfer transfer = upload(std::min(options.most, SdoClient::small));
  if (transfer.code == CO_SDO_ERR_MEM && options.most > SdoClient::small) {
    transfer = upload(options.most);
  }
  progress.end();
  if (!transfer.done()) {
    if (transfer.code == CO_SDO_ERR_MEM) {
      print_message(fmt::format("{} has more than {} bytes; allow more by --most", target.name, options.most));
      return refused;
    }
    return report_failure(session, target, transfer);
  }
  if (!options.output.empty()) {
    return write_output(options.output, transfer.data);
  }
  const std::string fault = target.is_type_given ? show(*target.type, transfer.data).fault : std::string();
  if (!fault.empty()) {
    print_message(fmt::format("{}: {}: {}", target.name, fault, guess(transfer.data)));
    return refused;
  }
  if (options.common.is_json) {
    print_json_value(target, transfer.data);
    return ok;
  }
  print(line_of(target, transfer.data));
  return ok;
}

}  // namespace

int read_object(Session& session, const ReadOptions& options, Target& target) {
  const int found = find_in_device(session, options, target);
  return found == ok ? upload_target(session, options, target) : found;
}

namespace {

int run_read(ReadOptions& options) {
  Target target;
  if (!place_node(options.common, {&options.node, &options.object}) || !prepare(options, target)) {
    return usage;
  }
  int status = ok;
  std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  extend_timeout(options.common, *bus);
  Session session(std::move(bus), target.node);
  return read_object(session, options, target);
}

}  // namespace

Verb add_read(CommandLine& line) {
  const auto options = std::make_shared<ReadOptions>();
  Arguments arguments = line.add_command("read", "Read an object of a device");
  add_transfer_options(arguments, *options);
  arguments.add_option("-o,--output", options->output, "Write the bytes to a file, - for standard output");
  arguments.add_option("--most", options->most, "Largest size in bytes; default: 16777216")
      .in_hidden_range(1, 1U << 30);
  arguments.end_help(
      "Examples:\n"
      "  lexican read 5 1008 -i can0\n"
      "  lexican read 5 1018:4 -i can0\n"
      "  lexican read 5 \"velocity actual value\" -i can0 --eds drive.eds\n"
      "  lexican read 5 1021 -o drive.eds -i can0");
  return {arguments, [options] { return finish(options->common, run_read(*options)); }};
}

}  // namespace lexican::program
