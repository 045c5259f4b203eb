// SPDX-License-Identifier: Apache-2.0
// lexican scan: finds the devices of a bus, with state, profile, identity and name.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "describe/monitor.hpp"
#include "program/actions.hpp"
#include "program/identity.hpp"

namespace lexican::program {
namespace {

constexpr std::uint32_t upload_timeout = 1000;  // ms, for each answer

struct ScanOptions {
  Common common;
};

std::string profile_text(const Found& found) {
  const std::uint32_t profile = found.device_type & 0xFFFFU;
  if (!found.has_type) {
    return "-";
  }
  switch (profile) {
    case 0: return "no profile";
    case 401: return "401 in/out";
    case 402: return "402 drive";
    case 404: return "404 measuring";
    case 405: return "405 PLC";
    case 406: return "406 encoder";
    case 408: return "408 hydraulic";
    case 410: return "410 inclinometer";
    case 418: return "418 battery";
    case 419: return "419 charger";
    default: return std::to_string(profile);
  }
}

std::string number_text(const std::optional<std::uint32_t>& number) {
  return number ? fmt::format("{:08X}", *number) : "-";
}

struct File {
  std::string path;
  bool is_uploaded;
};

/// Descriptions of devices by node-ID.
using Files = std::map<std::uint8_t, File>;

/// Finds the descriptions in the user's library, and offers to upload those that devices store.
Files find_files(const Devices& found, Host& host, const Common& common) {
  Files files;
  for (const Device& device : found.devices) {
    if (!device.vendor || !device.product || host.interrupted()) {
      continue;
    }
    const describe::Identity identity{*device.vendor, *device.product, device.revision.value_or(0)};
    std::optional<describe::Known> known = describe::find_description(describe::user_library(), identity);
    const bool is_uploaded = !known;
    if (!known) {
      DeviceClient client(host, device.found.node);
      Common patient = common;
      patient.timeout = upload_timeout;
      known = upload_description(client.sdo(), device.found.node, identity, patient);
    }
    if (known) {
      files[device.found.node] = {known->file, is_uploaded};
    }
  }
  return files;
}

void print_table(const Devices& found, const Files& files) {
  const bool has_files = !files.empty();
  std::size_t width = 0;
  for (const Device& device : found.devices) {
    width = std::max(width, has_files ? device.name.size() : 0);
  }
  print(fmt::format("node  state            profile         vendor:product     serial    {:<{}}{}\n", "name", width,
                    has_files ? "  description" : ""));
  for (const Device& device : found.devices) {
    const auto file = files.find(device.found.node);
    const std::string description =
        !has_files ? ""
                   : "  " + (file == files.end() ? "-" : file->second.path) +
                         (file != files.end() && file->second.is_uploaded ? " (uploaded from 1021h)" : "");
    std::string line =
        fmt::format("{:>4}  {:<16} {:<15} {:<17}  {:<8}  {:<{}}{}", device.found.node,
                    device.found.state ? state_text(*device.found.state) : "not seen", profile_text(device.found),
                    number_text(device.vendor) + ':' + number_text(device.product), number_text(device.serial),
                    device.name, width, description);
    line.erase(line.find_last_not_of(' ') + 1);
    print(line + '\n');
  }
  for (const LssAddress& address : found.unconfigured) {
    print(fmt::format("   ?  {:<16} {:<15} {:08X}:{:08X}  {:08X}  lexican lss assign {:08X}=NODE\n", "no node-ID",
                      "LSS", address[0], address[1], address[3], address[3]));
  }
}

void print_json_device(const Device& device, const Files& files) {
  nlohmann::json json = {{"node", device.found.node}};
  const auto add = [&](const char* key, const std::optional<std::uint32_t>& number) {
    if (number) {
      json[key] = *number;
    }
  };
  if (device.found.has_type) {
    json["device_type"] = device.found.device_type;
  }
  if (device.found.state) {
    json["state"] = state_text(*device.found.state);
  }
  add("vendor", device.vendor);
  add("product", device.product);
  add("revision", device.revision);
  add("serial", device.serial);
  if (!device.name.empty()) {
    json["name"] = device.name;
  }
  const auto file = files.find(device.found.node);
  if (file != files.end()) {
    json["description"] = file->second.path;
  }
  print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

void print_json_address(const LssAddress& address) {
  const nlohmann::json json = {{"state", "no node-ID"},
                               {"vendor", address[0]},
                               {"product", address[1]},
                               {"revision", address[2]},
                               {"serial", address[3]}};
  print(json.dump() + '\n');
}

/// Returns ", bus load 1.2 %" during the search; nothing if the bit rate is unknown.
std::string load_text(std::uint64_t bits, std::uint32_t bit_rate, Micros time) {
  describe::Statistics numbers;
  numbers.last = time;
  numbers.bits = bits;
  return bit_rate == 0 ? std::string() : fmt::format(", bus load {:.1f} %", numbers.load(bit_rate));
}

}  // namespace

int report_silence(const host_bus::Bus& bus, const HostLine& line) {
  if (!bus.refusal().empty()) {
    print_message(bus.refusal());
    return bus_fault;
  }
  if (line.error()) {
    const CO_IF_FRM& error = *line.error();
    print_message(
        fmt::format("no node answered; the controller reports errors (TEC {}, REC {})", error.Data[6], error.Data[7]));
    print_message("no node acknowledges: compare the bit rate" +
                  (bus.bit_rate() != 0 ? fmt::format(" ({} kbit/s)", bus.bit_rate() / 1000) : std::string()) +
                  ", check 60 ohm between CAN_H and CAN_L, and power");
  } else if (line.received() == 0) {
    print_message("no node answered, and no frame was received" +
                  std::string(bus.is_physical() ? "; check the bit rate, 60 ohm between CAN_H and CAN_L, and power"
                                                : "; no device runs on this simulated bus"));
  } else {
    print_message("no node answered, but other frames were received: lexican mon shows them");
  }
  return no_answer;
}

std::string summary_of(const Devices& found, const host_bus::Bus& bus, std::uint64_t bits, Micros time) {
  const std::size_t nodes = found.devices.size();
  return fmt::format("{} {}", nodes, nodes == 1 ? "node" : "nodes") +
         (found.unconfigured.empty() ? std::string()
                                     : fmt::format(" and {} without node-ID", found.unconfigured.size())) +
         fmt::format(" in {:.1f} s{}\n", static_cast<double>(time) / 1e6, load_text(bits, bus.bit_rate(), time));
}

void report_conflicts(const Devices& found) {
  if (!found.lss_fault.empty()) {
    print_note("LSS: " + found.lss_fault);
  }
  for (const Device& device : found.devices) {
    if (device.found.answers > 1) {
      print_note(fmt::format("node {} has answered one request {} times: several devices may have this node-ID",
                             device.found.node, device.found.answers));
    }
    constexpr std::uint8_t stopped = 4;
    const bool has_answered = device.found.answers != 0 || device.vendor || device.product || !device.name.empty();
    if (!has_answered && device.found.state && *device.found.state != stopped) {
      print_note(hung_server_text(device.found.node, "heartbeats"));
    }
  }
}

namespace {

int run_scan(const ScanOptions& options) {
  int status = ok;
  const std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  const Interruption interruption;
  BusHost host(*bus, interruption);
  HostLine line(host);
  const Micros begin = host.now();
  const Devices found = find_devices(host, line, options.common.timeout);
  const std::string summary = summary_of(found, *bus, host.bits(), host.now() - begin);
  if (Interruption::happened()) {
    print_message("interrupted");
    return interrupted;
  }
  if (!bus->fault().empty()) {
    print_message(bus->fault());
    return bus_fault;
  }
  report_conflicts(found);
  if (found.devices.empty() && found.unconfigured.empty()) {
    return report_silence(*bus, line);
  }
  const Files files = find_files(found, host, options.common);
  if (Interruption::happened()) {
    print_message("interrupted");
    return interrupted;
  }
  if (options.common.is_json) {
    for (const Device& device : found.devices) {
      print_json_device(device, files);
    }
    std::for_each(found.unconfigured.begin(), found.unconfigured.end(), print_json_address);
    return ok;
  }
  print_table(found, files);
  print(summary);
  return ok;
}

}  // namespace

Verb add_scan(CommandLine& line) {
  const auto options = std::make_shared<ScanOptions>();
  Arguments arguments = line.add_command("scan", "Find the devices of a bus: state, profile, identity and name");
  add_bus_options(arguments, options->common);
  add_timeout_option(arguments, options->common, 80);
  arguments.end_help(
      "Examples:\n"
      "  lexican scan -i can0\n"
      "  lexican scan -i slcan:/dev/ttyACM0@500k\n"
      "  lexican scan -i hub:demo --json");
  return {arguments, [options] { return finish(options->common, run_scan(*options)); }};
}

}  // namespace lexican::program
