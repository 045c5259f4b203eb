// SPDX-License-Identifier: Apache-2.0
// lexican write: writes an object of a device.
#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "program/actions.hpp"
#include "text/file.hpp"

namespace lexican::program {
namespace {

/// Converts what has to be written.
/// \retval false  the reason is printed
bool data_of(const WriteOptions& options, const Target& target, Bytes& data) {
  std::string why;
  if (options.value.has_value() != options.file.empty()) {
    print_message("give a value, or --file, and not both");
    return false;
  }
  if (!options.file.empty()) {
    const std::optional<codict::Source> source = codict::read_file(options.file, why);
    if (!source) {
      print_message(why);
      return false;
    }
    const std::string_view bytes = source->bytes();
    data.assign(bytes.begin(), bytes.end());
    return true;
  }
  const std::string& value = *options.value;
  const std::string_view signature = describe::signature_of(target.object.index, target.object.sub_index);
  if (options.verifies && !signature.empty()) {
    print_message(target.name + " does not read back what is written; leave out --verify");
    return false;
  }
  if (target.object.sub_index == 0 && !value.empty() && value == describe::signature_of(target.object.index, 1)) {
    print_message(
        fmt::format("{0:04X}h:00 cannot be written; '{1}' is for {0:X}:1, all parameters", target.object.index, value));
    return false;
  }
  if (!value.empty() && value == signature) {
    data.assign(value.begin(), value.end());
    return true;
  }
  if (!target.type) {
    print_message("the type of " + target.name + " is unknown; give --type (" + value_type_names + ") or --eds");
    return false;
  }
  const Encoded encoded = encode(*target.type, value);
  why = !encoded.fault.empty() ? encoded.fault
        : options.is_forced    ? std::string()
                               : beyond_limits(target.network.of(target.node), target.node,
                                               {target.object.index, target.object.sub_index}, value);
  if (!why.empty()) {
    print_message(target.name + ": " + why);
    return false;
  }
  data = encoded.bytes;
  return true;
}

int verify(Session& session, const Target& target, const WriteOptions& options, const Bytes& data) {
  const Transfer transfer =
      session.sdo().upload(target.object.index, target.object.sub_index,
                           {static_cast<std::uint32_t>(data.size() + 1024), options.common.timeout, {}});
  if (transfer.code == CO_SDO_ERR_MEM) {
    print_message(target.name + " was written, but reads back with more bytes");
    return refused;
  }
  if (!transfer.done()) {
    return report_failure(session, target, transfer);
  }
  if (transfer.data != data) {
    print_message(target.name + " was written, but reads back as " +
                  target.network.of(target.node).show(target.object.index, target.object.sub_index, transfer.data));
    return refused;
  }
  return ok;
}

int download_target(Session& session, const WriteOptions& options, const Target& target, const Bytes& data) {
  ProgressLine progress(std::cerr, shows_progress() ? Progress::Form::bar : Progress::Form::none);
  const Transfer transfer = session.sdo().download(
      target.object.index, target.object.sub_index, data,
      {SdoClient::small, options.common.timeout, [&](const Amount& amount) { progress.update(amount); }});
  progress.end();
  if (!transfer.done()) {
    return report_failure(session, target, transfer);
  }
  const int status = options.verifies ? verify(session, target, options, data) : ok;
  if (status != ok) {
    return status;
  }
  if (options.common.is_json) {
    const nlohmann::json json = {
        {"node", target.node},   {"index", target.object.index}, {"sub", target.object.sub_index},
        {"object", target.name}, {"bytes", data.size()},         {"verified", options.verifies}};
    print(json.dump() + '\n');
  } else if (!options.file.empty()) {
    print(fmt::format("{}, {} byte{}\n", target.name, data.size(), data.size() == 1 ? "" : "s"));
  } else {
    print(line_of(target, data));
  }
  return ok;
}

}  // namespace

int write_object(Session& session, const WriteOptions& options, Target& target, const std::optional<Bytes>& data) {
  if (data) {
    return download_target(session, options, target, *data);
  }
  const int status = find_in_device(session, options, target);
  Bytes converted;
  if (status != ok || !data_of(options, target, converted)) {
    return status != ok ? status : int{usage};
  }
  return download_target(session, options, target, converted);
}

namespace {

int run_write(WriteOptions& options) {
  Target target;
  Bytes data;
  std::vector<std::optional<std::string>*> words = {&options.node, &options.object};
  if (options.file.empty()) {
    words.push_back(&options.value);
  }
  if (!place_node(options.common, words)) {
    return usage;
  }
  if (!prepare(options, target) || (target.is_found && !data_of(options, target, data))) {
    return usage;
  }
  int status = ok;
  std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  if (!options.file.empty()) {
    extend_timeout(options.common, *bus);
  }
  Session session(std::move(bus), target.node);
  return write_object(session, options, target, target.is_found ? std::optional(data) : std::nullopt);
}

}  // namespace

Verb add_write(CommandLine& line) {
  const auto options = std::make_shared<WriteOptions>();
  Arguments arguments = line.add_command("write", "Write an object of a device");
  add_transfer_options(arguments, *options);
  arguments.add_option("value", options->value, "Value: a number, text, or pairs of hex digits, by its type");
  arguments.add_option("--file", options->file, "Write the bytes of a file instead, - for standard input");
  arguments.add_flag("--verify", options->verifies, "Read the object afterwards and compare");
  arguments.add_flag("--force", options->is_forced, "Also beyond the limits of the description");
  arguments.end_help(
      "Examples:\n"
      "  lexican write 5 1017 500 -i can0\n"
      "  lexican write 5 \"profile velocity\" 2000 --verify -i can0 --eds drive.eds\n"
      "  lexican write 5 1010:1 save -i can0\n"
      "  lexican write 5 1F50:1 --file firmware.bin -i can0");
  return {arguments, [options] { return finish(options->common, run_write(*options)); }};
}

}  // namespace lexican::program
