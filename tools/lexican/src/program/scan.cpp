// SPDX-License-Identifier: Apache-2.0
// lexican scan: finds the devices of a bus, with state, profile, identity and name.
#include "program/scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program/session.hpp"

namespace lexican::program {
namespace {

struct Options {
  Common common;
};

struct Device {
  Found found;
  std::optional<std::uint32_t> vendor;
  std::optional<std::uint32_t> product;
  std::optional<std::uint32_t> serial;
  std::string name;
};

class BusLine : public Line {
 public:
  BusLine(host_bus::Bus& bus, const Interruption& interruption) : bus_(bus), host_(bus, interruption) {}
  bool send(const CO_IF_FRM& frame) override {
    const bool is_sent = bus_.send(frame);
    sent_ += is_sent ? 1U : 0U;
    return is_sent;
  }
  std::optional<CO_IF_FRM> receive() override {
    const std::optional<host_bus::Entry> entry = bus_.receive();
    if (!entry) {
      return std::nullopt;
    }
    if ((entry->frame.Identifier & CO_IF_FRM_ERROR) != 0) {
      error_ = entry->frame;
      return CO_IF_FRM{};
    }
    ++received_;
    return entry->frame;
  }
  Micros now() override { return host_.now(); }
  void wait(Micros time) override { host_.wait(time); }
  bool is_ended() override { return host_.interrupted(); }

  std::uint64_t received() const { return received_; }
  std::uint64_t sent() const { return sent_; }
  const std::optional<CO_IF_FRM>& error() const { return error_; }

 private:
  host_bus::Bus& bus_;
  BusHost host_;
  std::uint64_t received_ = 0;
  std::uint64_t sent_ = 0;
  std::optional<CO_IF_FRM> error_;  ///< the last error frame
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

std::string state_text(const std::optional<std::uint8_t>& state) {
  if (!state) {
    return "no heartbeat";
  }
  switch (*state) {
    case 0x00: return "boot-up";
    case 0x04: return "stopped";
    case 0x05: return "operational";
    case 0x7F: return "pre-operational";
    default: return fmt::format("{:02X}h", *state);
  }
}

std::string number_text(const std::optional<std::uint32_t>& number) {
  return number ? fmt::format("{:08X}", *number) : "-";
}

std::optional<std::uint32_t> read_number(SdoClient& sdo, std::uint16_t index, std::uint8_t sub, std::uint32_t timeout) {
  const Transfer transfer = sdo.upload(index, sub, {SdoClient::small, timeout, {}});
  if (!transfer.done() || transfer.data.size() != 4) {
    return std::nullopt;
  }
  return transfer.data[0] | static_cast<std::uint32_t>(transfer.data[1]) << 8 |
         static_cast<std::uint32_t>(transfer.data[2]) << 16 | static_cast<std::uint32_t>(transfer.data[3]) << 24;
}

/// Reads identity and name of a device.
Device identify(const Found& found, host_bus::Bus& bus, const Interruption& interruption, std::uint32_t timeout) {
  BusHost host(bus, interruption);
  ClientDictionary dictionary(found.node);
  Node node({found.node == 127 ? std::uint8_t{126} : std::uint8_t{127}, host.master_can(), host.master_timer(),
             dictionary.table()});
  Loop loop(host, {&node});
  SdoClient sdo(node, loop);
  CONodeStart(&node.stack());
  Device device;
  device.found = found;
  device.vendor = read_number(sdo, 0x1018, 1, timeout);
  device.product = read_number(sdo, 0x1018, 2, timeout);
  device.serial = read_number(sdo, 0x1018, 4, timeout);
  const Transfer name = sdo.upload(0x1008, 0, {256, timeout, {}});
  device.name = name.done() ? visible_text(name.data) : std::string();
  loop.flush(100 * millisecond);
  return device;
}

void print_table(const std::vector<Device>& devices) {
  print("node  state            profile         vendor:product     serial    name\n");
  for (const Device& device : devices) {
    print(fmt::format("{:>4}  {:<16} {:<15} {}:{}  {:<8}  {}\n", device.found.node, state_text(device.found.state),
                      profile_text(device.found), number_text(device.vendor), number_text(device.product),
                      number_text(device.serial), device.name));
  }
}

void print_json_device(const Device& device) {
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
    json["state"] = state_text(device.found.state);
  }
  add("vendor", device.vendor);
  add("product", device.product);
  add("serial", device.serial);
  if (!device.name.empty()) {
    json["name"] = device.name;
  }
  print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

/// Prints why no device has answered, by the report of the controller.
int report_silence(const host_bus::Bus& bus, const BusLine& line) {
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

int run(const Options& options) {
  int status = ok;
  const std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  const Interruption interruption;
  BusLine line(*bus, interruption);
  const Micros begin = line.now();
  const std::vector<Found> found = find_devices(line, options.common.timeout * millisecond);
  std::vector<Device> devices;
  for (const Found& each : found) {
    if (!line.is_ended()) {
      devices.push_back(identify(each, *bus, interruption, options.common.timeout * 4));
    }
  }
  if (Interruption::happened()) {
    print_message("interrupted");
    return interrupted;
  }
  if (!bus->fault().empty()) {
    print_message(bus->fault());
    return bus_fault;
  }
  if (devices.empty()) {
    return report_silence(*bus, line);
  }
  if (options.common.is_json) {
    std::for_each(devices.begin(), devices.end(), print_json_device);
    return ok;
  }
  print_table(devices);
  print(fmt::format("{} {} in {:.1f} s\n", devices.size(), devices.size() == 1 ? "node" : "nodes",
                    static_cast<double>(line.now() - begin) / 1e6));
  return ok;
}

}  // namespace

Verb add_scan(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  Arguments arguments = line.add_command("scan", "Find the devices of a bus: state, profile, identity and name");
  add_bus_options(arguments, options->common);
  add_timeout_option(arguments, options->common, 80);
  arguments.end_help(
      "Examples:\n"
      "  lexican scan -i can0\n"
      "  lexican scan -i slcan:/dev/ttyACM0@500k\n"
      "  lexican scan -i hub:demo --json");
  return {arguments, [options] { return run(*options); }};
}

}  // namespace lexican::program
