// SPDX-License-Identifier: Apache-2.0
// lexican lss: finds devices without node-ID, and gives node-IDs and the bit rate. [305]
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "client/lss.hpp"
#include "program/search.hpp"
#include "program/session.hpp"
#include "text/file.hpp"
#include "text/number.hpp"

namespace lexican::program {
namespace {

constexpr std::uint8_t no_node = 255;  // in place of a node-ID
constexpr unsigned serial = 3;         // in an LssAddress

struct LssOptions {
  Common common;
  std::string command;
  std::vector<std::string> words;
  bool stores = false;
  std::uint32_t delay = 1000;  ///< ms
};

/// The name of a device: its serial number, or its whole address.
struct LssName {
  std::optional<std::uint32_t> serial_number;
  std::optional<LssAddress> address;
};

/// A node-ID for a device.
struct Assignment {
  LssName device;
  std::uint8_t node = 0;
};

bool hexadecimal(std::string_view text, std::uint32_t& number) {
  std::uint64_t value = 0;
  const bool has_prefix = text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
  const std::string_view digits = has_prefix ? text.substr(2) : text;
  const bool is_number = digits.size() <= 8 && codict::parse_hex(digits, value);
  number = static_cast<std::uint32_t>(value);
  return is_number;
}

/// Parses 000001A2, or vendor-ID, product code, revision and serial number with colons between them.
std::optional<LssName> name_of(std::string_view word) {
  LssAddress address{};
  if (hexadecimal(word, address[serial])) {
    return LssName{address[serial], std::nullopt};
  }
  for (std::size_t n = 0; n < address.size(); ++n) {
    const std::size_t colon = word.find(':');
    const bool is_last = n + 1 == address.size();
    if ((colon == std::string_view::npos) != is_last || !hexadecimal(word.substr(0, colon), address[n])) {
      return std::nullopt;
    }
    word = is_last ? std::string_view() : word.substr(colon + 1);
  }
  return LssName{std::nullopt, address};
}

constexpr const char* names_help =
    "a device is named by its serial number, such as 000001A2, or by VENDOR:PRODUCT:REVISION:SERIAL, in hexadecimal";

/// Parses "000001A2=6".
std::optional<Assignment> assignment_of(std::string_view word, char separator) {
  const std::size_t at = word.find(separator);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  const std::optional<LssName> device = name_of(codict::trimmed(word.substr(0, at)));
  std::string_view node = word.substr(at + 1);
  node = codict::trimmed(node.substr(0, node.find(separator)));
  return device && node_of(node) != 0 ? std::optional(Assignment{*device, node_of(node)}) : std::nullopt;
}

/// Reads the lines "SERIAL,NODE" of a plan. Its first line may have names of the columns, and a third column is for
/// people.
bool read_plan(const std::string& path, std::vector<Assignment>& plan) {
  std::string why;
  const std::optional<codict::Source> source = codict::read_file(path, why);
  if (!source) {
    print_message(why);
    return false;
  }
  std::string_view rest = source->bytes();
  for (unsigned number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = codict::trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::optional<Assignment> assignment = assignment_of(line, ',');
    if (assignment) {
      plan.push_back(*assignment);
    } else if (!line.empty() && line.front() != '#' && number != 1) {
      print_message(fmt::format("{}, line {}: '{}' is not SERIAL,NODE, such as 000001A2,6", path, number, line));
      return false;
    }
  }
  return true;
}

/// Collects the assignments of the command line.
bool read_assignments(const LssOptions& options, std::vector<Assignment>& plan) {
  for (const std::string& word : options.words) {
    if (word.find('=') == std::string::npos) {
      if (!read_plan(word, plan)) {
        return false;
      }
      continue;
    }
    const std::optional<Assignment> assignment = assignment_of(word, '=');
    if (!assignment) {
      print_message(fmt::format("'{}' is not SERIAL=NODE, such as 000001A2=6; {}", word, names_help));
      return false;
    }
    plan.push_back(*assignment);
  }
  if (plan.empty()) {
    print_message("which device? Give SERIAL=NODE, such as 000001A2=6, or a file with lines SERIAL,NODE");
    return false;
  }
  for (std::size_t n = 0; n < plan.size(); ++n) {
    const auto is_same = [&](const Assignment& other) { return other.node == plan[n].node; };
    if (std::any_of(plan.begin() + static_cast<std::ptrdiff_t>(n) + 1, plan.end(), is_same)) {
      print_message(fmt::format("node-ID {} is given twice", plan[n].node));
      return false;
    }
  }
  return true;
}

nlohmann::json json_of(const LssAddress& address) {
  return {{"vendor", address[0]}, {"product", address[1]}, {"revision", address[2]}, {"serial", address[serial]}};
}

/// A command on an open bus.
class Lss {
 public:
  Lss(const LssOptions& options, host_bus::Bus& bus) : options_(options), bus_(bus), host_(bus, interruption_) {}

  int scan() {
    std::vector<LssAddress> found;
    const int status = find(found);
    for (const LssAddress& address : found) {
      print_found(address);
    }
    if (status == ok && !options_.common.is_json) {
      print(fmt::format("{} {} without node-ID\n", found.size(), found.size() == 1 ? "device" : "devices"));
    }
    return status == ok && found.empty() ? int{no_answer} : status;
  }

  int info() {
    LssAddress address{};
    int status = device(options_.words.empty() ? std::string() : options_.words.front(), address);
    if (status != ok) {
      return status;
    }
    std::uint8_t node = no_node;
    LssSession lss(host_, times());
    if (!lss.select(address) || !lss.inquire_node_id(node)) {
      return report(lss);
    }
    if (options_.common.is_json) {
      nlohmann::json json = json_of(address);
      json["node"] = node == no_node ? nlohmann::json() : nlohmann::json(node);
      print(json.dump() + '\n');
    } else {
      print(fmt::format(
          "vendor-ID        {:08X}h\nproduct code     {:08X}h\nrevision number  {:08X}h\n"
          "serial number    {:08X}h\nnode-ID          {}\n",
          address[0], address[1], address[2], address[serial], node == no_node ? "none" : std::to_string(node)));
    }
    return ok;
  }

  int assign(const std::vector<Assignment>& plan) {
    const bool needs_search = std::any_of(plan.begin(), plan.end(),
                                          [](const Assignment& each) { return each.device.serial_number.has_value(); });
    std::vector<LssAddress> found;
    int status = needs_search ? find(found) : int{ok};
    std::vector<LssAddress> addresses;
    for (const Assignment& each : plan) {
      LssAddress address{};
      status = status != ok ? status : match(each.device, found, address);
      status = status != ok ? status : check_free(each.node);
      addresses.push_back(address);
    }
    status = status != ok
                 ? status
                 : agree(bus_, options_.common,
                         fmt::format("give {} {} a node-ID", plan.size(), plan.size() == 1 ? "device" : "devices"));
    for (std::size_t n = 0; n < plan.size() && status == ok; ++n) {
      status = assign(addresses[n], plan[n].node);
    }
    return status;
  }

  int rate(std::uint32_t bit_rate) {
    std::vector<LssAddress> addresses;
    int status = find_all(addresses);
    status = status != ok ? status
                          : agree(bus_, options_.common,
                                  fmt::format("switch {} devices to {} kbit/s", addresses.size(), bit_rate / 1000));
    if (status != ok) {
      return status;
    }
    LssSession lss(host_, times());
    for (const LssAddress& address : addresses) {
      if (!lss.select(address) || !lss.set_bit_rate(bit_rate) || (options_.stores && !lss.store())) {
        print_message(address_name(address) + " does not accept the bit rate; none was switched");
        return report(lss);
      }
    }
    if (!lss.activate(addresses, static_cast<std::uint16_t>(options_.delay))) {
      return report(lss);
    }
    if (options_.common.is_json) {
      print(nlohmann::json{{"devices", addresses.size()}, {"rate", bit_rate}}.dump() + '\n');
    } else {
      print(fmt::format("{} devices have {} kbit/s{}; the next command needs this rate\n", addresses.size(),
                        bit_rate / 1000, options_.stores ? " and have stored it" : " until their reset"));
    }
    return ok;
  }

 private:
  LssMaster::Times times() const { return {options_.common.timeout, std::max(options_.common.timeout / 20, 1U)}; }

  int report(const LssSession& lss) {
    if (Interruption::happened()) {
      print_message("interrupted");
      return interrupted;
    }
    if (!bus_.fault().empty()) {
      print_message(bus_.fault());
      return bus_fault;
    }
    print_message("LSS: " + lss.fault());
    return refused;
  }

  /// Finds the devices without node-ID.
  int find(std::vector<LssAddress>& found) {
    LssSession lss(host_, times());
    return lss.find_unconfigured([&](const LssAddress& address) { found.push_back(address); }) ? int{ok} : report(lss);
  }

  /// Finds all devices: those with node-ID by SDO, the others by fastscan.
  int find_all(std::vector<LssAddress>& addresses) {
    HostLine line(host_);
    const Devices found = find_devices(host_, line, std::max(options_.common.timeout / 10, 1U));
    for (const Device& device : found.devices) {
      if (!device.vendor || !device.product || !device.revision || !device.serial) {
        print_message(fmt::format("node {} has no complete identity (1018h), so LSS cannot reach it; none was switched",
                                  device.found.node));
        return refused;
      }
      addresses.push_back({*device.vendor, *device.product, *device.revision, *device.serial});
    }
    addresses.insert(addresses.end(), found.unconfigured.begin(), found.unconfigured.end());
    if (Interruption::happened()) {
      print_message("interrupted");
      return interrupted;
    }
    if (!found.lss_fault.empty() || addresses.empty()) {
      print_message(addresses.empty() ? "no device answers" : "LSS: " + found.lss_fault);
      return addresses.empty() ? no_answer : refused;
    }
    return ok;
  }

  /// Returns the address of the device that a word names, of -n, or of the only device without node-ID.
  int device(const std::string& word, LssAddress& address) {
    const std::optional<LssName> name = word.empty() ? std::optional(LssName{}) : name_of(word);
    if (!name) {
      print_message(fmt::format("'{}' is no device; {}", word, names_help));
      return usage;
    }
    if (word.empty() && !options_.common.node.empty()) {
      return identity_of(options_.common.node, address);
    }
    if (name->address) {
      address = *name->address;
      return ok;
    }
    std::vector<LssAddress> found;
    const int status = find(found);
    if (status == ok && word.empty() && found.size() > 1) {
      print_message(fmt::format("{} devices have no node-ID; name one: {}", found.size(), names_help));
      return usage;
    }
    if (status == ok && word.empty() && !found.empty()) {
      address = found.front();
      return ok;
    }
    return status != ok ? status : match(*name, found, address);
  }

  /// Reads the LSS address of a device that has a node-ID.
  int identity_of(const std::string& word, LssAddress& address) {
    const std::uint8_t node = node_of(word);
    if (node == 0) {
      print_message("'" + word + "' is no node-ID, which is 1 to 127");
      return usage;
    }
    DeviceClient client(host_, node);
    for (std::uint8_t sub = 1; sub <= address.size(); ++sub) {
      const Transfer transfer = client.sdo().upload(0x1018, sub, {SdoClient::small, options_.common.timeout, {}});
      if (!transfer.done() || transfer.data.size() != 4) {
        print_message(fmt::format("node {}, 1018h:{:02X}: {}", node, sub, transfer.outcome()));
        return transfer.is_unanswered() ? no_answer : refused;
      }
      address[sub - 1U] = static_cast<std::uint32_t>(number_of(transfer.data));
    }
    return ok;
  }

  int match(const LssName& name, const std::vector<LssAddress>& found, LssAddress& address) const {
    if (name.address) {
      address = *name.address;
      return ok;
    }
    std::vector<LssAddress> matches;
    std::copy_if(found.begin(), found.end(), std::back_inserter(matches),
                 [&](const LssAddress& each) { return each[serial] == name.serial_number.value_or(0); });
    if (matches.size() == 1) {
      address = matches.front();
      return ok;
    }
    const std::string number = fmt::format("{:08X}", name.serial_number.value_or(0));
    print_message(matches.empty() && !name.serial_number
                      ? "no device without node-ID answers; name one that has a node-ID by -n NODE"
                  : matches.empty()
                      ? "no device without node-ID has the serial number " + number + "; lexican lss scan shows all"
                      : "several devices have the serial number " + number +
                            "; name it by VENDOR:PRODUCT:REVISION:SERIAL");
    return matches.empty() ? no_answer : usage;
  }

  /// Checks that no device has a node-ID.
  int check_free(std::uint8_t node) {
    DeviceClient client(host_, node);
    const Transfer transfer =
        client.sdo().upload(0x1000, 0, {SdoClient::small, std::max(options_.common.timeout / 10, 1U), {}});
    if (!transfer.is_unanswered() && !Interruption::happened()) {
      print_message(fmt::format("node-ID {} is that of another device; choose one that is free", node));
      return refused;
    }
    if (Interruption::happened()) {
      print_message("interrupted; nothing was changed");
      return interrupted;
    }
    return ok;
  }

  /// Gives a device its node-ID, and waits until it answers.
  int assign(const LssAddress& address, std::uint8_t node) {
    {
      LssSession lss(host_, times());
      if (!lss.select(address) || !lss.set_node_id(node) || (options_.stores && !lss.store())) {
        print_message(fmt::format("{}: node-ID {} was not {}", address_name(address), node,
                                  options_.stores ? "set and stored" : "set"));
        return report(lss);
      }
    }
    DeviceClient client(host_, node);
    const Transfer transfer = client.sdo().upload(0x1000, 0, {SdoClient::small, options_.common.timeout, {}});
    if (!transfer.fault.empty() || transfer.is_unanswered()) {
      print_message(fmt::format("{} has received node-ID {}, but does not answer; it may need lexican nmt reset-comm",
                                address_name(address), node));
      return no_answer;
    }
    if (options_.common.is_json) {
      nlohmann::json json = json_of(address);
      json["node"] = node;
      json["stored"] = options_.stores;
      print(json.dump() + '\n');
    } else {
      print(fmt::format("{:08X} is node {}{}\n", address[serial], node, options_.stores ? ", stored" : ""));
    }
    return ok;
  }

  void print_found(const LssAddress& address) const {
    if (options_.common.is_json) {
      nlohmann::json json = json_of(address);
      json["node"] = nullptr;
      print(json.dump() + '\n');
    } else {
      print(fmt::format("{}  lexican lss assign {:08X}=NODE\n", address_name(address), address[serial]));
    }
  }

  const LssOptions& options_;
  host_bus::Bus& bus_;
  Interruption interruption_;
  BusHost host_;
};

int run_lss(const LssOptions& options) {
  std::vector<Assignment> plan;
  std::uint32_t bit_rate = 0;
  if (options.command == "assign" && !read_assignments(options, plan)) {
    return usage;
  }
  if (options.command == "rate") {
    bit_rate = options.words.size() == 1 ? bit_rate_of(options.words.front()) : 0U;
    if (bit_rate == 0) {
      print_message("give one bit rate, such as 250k");
      return usage;
    }
  }
  const bool has_too_many = options.words.size() > (options.command == "info" ? 1U : 0U);
  if ((options.command == "scan" || options.command == "info") && (has_too_many || options.stores)) {
    print_message(fmt::format("{}{}", options.stores ? "--store is for assign and rate" : "too many arguments for ",
                              options.stores ? "" : options.command));
    return usage;
  }
  int status = ok;
  const std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  Lss lss(options, *bus);
  return options.command == "scan"     ? lss.scan()
         : options.command == "info"   ? lss.info()
         : options.command == "assign" ? lss.assign(plan)
                                       : lss.rate(bit_rate);
}

}  // namespace

Verb add_lss(CommandLine& line) {
  const auto options = std::make_shared<LssOptions>();
  Arguments arguments = line.add_command("lss", "Give devices a node-ID or a bit rate by LSS");
  arguments.add_option("command", options->command, "scan, assign, rate or info")
      .required()
      .one_of({"scan", "assign", "rate", "info"});
  arguments.add_option("arguments", options->words,
                       "assign: SERIAL=NODE, or a file with lines SERIAL,NODE; rate: 250k; info: SERIAL");
  add_node_option(arguments, options->common);
  arguments.add_flag("--store", options->stores, "assign, rate: the devices also store it");
  arguments.add_option("--delay", options->delay, "rate: time without frames before and after the switch, ms; 1000")
      .in_hidden_range(1, 65535);
  add_bus_options(arguments, options->common);
  add_timeout_option(arguments, options->common, 1000);
  arguments.end_help(
      "Examples:\n"
      "  lexican lss scan -i can0\n"
      "  lexican lss assign 000001A2=6 --store -i can0\n"
      "  lexican lss info -n 5 -i can0");
  return {arguments, [options] { return finish(options->common, run_lss(*options)); }};
}

}  // namespace lexican::program
