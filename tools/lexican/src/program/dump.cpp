// SPDX-License-Identifier: Apache-2.0
// lexican dump: reads the configuration of a device into a DCF.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "describe/configuration.hpp"
#include "program/identity.hpp"
#include "program/session.hpp"
#include "text/file.hpp"
#include "trace/decode.hpp"

namespace lexican::program {
namespace {

using describe::EntryKey;
using describe::Part;

struct DumpOptions {
  Common common;
  std::optional<std::string> node;
  std::string output = "-";
  bool is_all = false;
  bool is_forced = false;
};

/// Reads the configuration of a device, and counts what is left out.
class Dump {
 public:
  Dump(const DumpOptions& options, Session& session, std::uint8_t node, const codict::Device& description)
      : options_(options), session_(session), node_(node), device_(description) {}

  /// \retval false  the device does not answer, or the program was interrupted: transfer() is the last one
  bool run() {
    std::vector<EntryKey> keys;
    codict::for_each_variable(device_, [&](std::uint16_t index, std::uint8_t sub_index, const codict::Entry&) {
      keys.emplace_back(index, sub_index);
    });
    describe::forget_values(device_);
    last_ = describe::device_type;
    if (!read_device_type(session_.sdo(), options_.common.timeout, device_, transfer_) || session_.is_interrupted()) {
      return false;
    }
    std::set<EntryKey> mapped;
    bool is_mapping_known = false;
    EntryCount count(keys.size());
    for (const EntryKey& key : keys) {
      constexpr std::uint16_t behind_pdos = 0x1C00;
      if (!is_mapping_known && key.first >= behind_pdos) {
        mapped = describe::mapped_entries(device_);
        is_mapping_known = true;
      }
      count.next();
      const Part part = describe::part_of(device_, key, mapped);
      const bool is_read = part == Part::configuration || (part == Part::read_only && options_.is_all);
      parts_[part] += is_read ? 0U : 1U;
      if (is_read && !read(key)) {
        return false;
      }
    }
    return true;
  }

  const Transfer& transfer() const { return transfer_; }
  const EntryKey& last() const { return last_; }
  const codict::Device& device() const { return device_; }
  std::size_t read_entries() const { return read_; }
  /// The entries that the device has refused, by abort code; 0: a DCF cannot express the value.
  const std::map<std::uint32_t, std::vector<EntryKey>>& refused() const { return refused_; }
  std::size_t number_of(Part part) const {
    const auto found = parts_.find(part);
    return found != parts_.end() ? found->second : 0;
  }

 private:
  bool read(const EntryKey& key) {
    last_ = key;
    constexpr std::uint32_t most = 65536;
    transfer_ = session_.sdo().upload(key.first, key.second, {most, options_.common.timeout, {}});
    if (transfer_.done()) {
      if (describe::store_value(device_, key, node_, transfer_.data)) {
        ++read_;
      } else {
        refused_[0].push_back(key);
      }
      return true;
    }
    const bool is_refusal = transfer_.fault.empty() && !transfer_.is_unanswered();
    if (is_refusal && !session_.is_interrupted()) {
      refused_[transfer_.code].push_back(key);
      return true;
    }
    return false;
  }

  const DumpOptions& options_;
  Session& session_;
  std::uint8_t node_;
  codict::Device device_;
  Transfer transfer_;
  EntryKey last_{};
  std::size_t read_ = 0;
  std::map<std::uint32_t, std::vector<EntryKey>> refused_;
  std::map<Part, std::size_t> parts_;
};

/// Returns what was read and what was left out, in one or several lines.
std::string summary_of(const Dump& dump, Micros duration) {
  struct Row {
    Part part;
    const char* words;
  };
  constexpr Row rows[] = {{Part::read_only, "read-only"},   {Part::process_value, "mapped in PDOs"},
                          {Part::write_only, "write-only"}, {Part::domain, "domains"},
                          {Part::command, "commands"},      {Part::set_point, "set-points"}};
  std::string text = fmt::format("{} values in {:.1f} s", dump.read_entries(), static_cast<double>(duration) / 1e6);
  const char* separator = "; left out: ";
  for (const Row& row : rows) {
    if (dump.number_of(row.part) != 0) {
      text += fmt::format("{}{} {}", separator, row.words, dump.number_of(row.part));
      separator = ", ";
    }
  }
  for (const auto& [code, keys] : dump.refused()) {
    text += code == 0 ? fmt::format("\n{} that a DCF cannot express: {}", keys.size(), describe::keys_text(keys))
                      : fmt::format("\n{} refused with {} {}: {}", keys.size(), trace::abort_code(code),
                                    trace::abort_meaning(code), describe::keys_text(keys));
  }
  return text + '\n';
}

void print_json_summary(const Dump& dump, std::uint8_t node, const std::string& file) {
  nlohmann::json refused = nlohmann::json::array();
  for (const auto& [code, keys] : dump.refused()) {
    for (const auto& [index, sub_index] : keys) {
      refused.push_back({{"index", index}, {"sub", sub_index}, {"abort", code}});
    }
  }
  const nlohmann::json json = {{"node", node}, {"file", file}, {"values", dump.read_entries()}, {"refused", refused}};
  print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

int run_dump(DumpOptions& options) {
  if (!place_node(options.common, {&options.node})) {
    return usage;
  }
  const std::uint8_t node = node_of(options.node.value_or(""));
  Target target;
  target.node = node;
  target.name = "identity (1018h)";
  if (node == 0) {
    print_message("'" + options.node.value_or("") + "' is no node-ID, which is 1 to 127");
    return usage;
  }
  if (options.common.is_json && options.output == "-") {
    print_message("--json needs -o FILE: the DCF is on the standard output");
    return usage;
  }
  int status = ok;
  if (!read_descriptions(options.common, target.network)) {
    return usage;
  }
  std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  const std::uint32_t bit_rate = bus->bit_rate();
  Session session(std::move(bus), node);
  const Micros begin = session.host().now();
  Transfer transfer;
  const auto identity = identify_device(session.sdo(), node, options.common, target.network, transfer);
  if (!identity && (transfer.is_unanswered() || session.is_interrupted())) {
    return report_failure(session, target, transfer);
  }
  const codict::Device* const description = target.network.of(node).device();
  if (description == nullptr) {
    print_message(options.common.eds.empty()
                      ? "a dump needs the description of the device: --eds FILE (EDS, DCF, XDD or XDC)"
                      : fmt::format("no file of --eds is for node {0}: --eds {0}=FILE", node));
    return usage;
  }
  const std::string other = identity ? other_identity(description->identity, *identity) : std::string();
  if (!other.empty() && !options.is_forced) {
    print_message(other + "; --force uses it all the same");
    return refused;
  }
  Dump dump(options, session, node, *description);
  if (!dump.run()) {
    target.name = target.network.of(node).object(dump.last().first, dump.last().second);
    return report_failure(session, target, dump.transfer());
  }
  const std::string name = options.output == "-" ? fmt::format("node{}.dcf", node)
                                                 : std::filesystem::path(options.output).filename().string();
  const std::string dcf = describe::to_dcf(dump.device(), node, bit_rate, name);
  std::string why;
  if (codict::write_file(options.output, dcf, why) == codict::Written::no) {
    print_message(why);
    return usage;
  }
  const std::string summary = summary_of(dump, session.host().now() - begin);
  if (options.common.is_json) {
    print_json_summary(dump, node, options.output);
  } else if (options.output == "-") {
    std::cerr << summary;
  } else {
    print(summary);
  }
  return ok;
}

}  // namespace

Verb add_dump(CommandLine& line) {
  const auto options = std::make_shared<DumpOptions>();
  Arguments arguments = line.add_command("dump", "Read the configuration of a device into a DCF");
  arguments.add_option("node", options->node, "Node-ID of the device, 1 to 127");
  add_node_option(arguments, options->common);
  arguments.add_option("-o,--output", options->output, "File for the DCF; default: the standard output");
  arguments.add_flag("--force", options->is_forced, "Also with the description of another device");
  arguments.add_flag("--all", options->is_all, "Also the values of read-only objects");
  add_bus_options(arguments, options->common);
  add_eds_option(arguments, options->common);
  add_timeout_option(arguments, options->common, 1000);
  arguments.end_help(
      "Examples:\n"
      "  lexican dump 5 -o drive5.dcf -i can0 --eds drive.eds");
  return {arguments, [options] { return finish(options->common, run_dump(*options)); }};
}

}  // namespace lexican::program
