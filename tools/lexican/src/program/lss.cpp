// SPDX-License-Identifier: Apache-2.0
// lexican lss: finds devices without node-ID, and gives node-IDs and the bit rate. [305]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "client/lss.hpp"
#include "program/search.hpp"
#include "program/session.hpp"
#include "text/file.hpp"
#include "text/number.hpp"

namespace lexican::program {
namespace {

constexpr std::uint8_t no_node = 255;        // in place of a node-ID
constexpr unsigned serial = 3;               // in an LssAddress
constexpr std::uint32_t usual_delay = 1000;  // ms
constexpr std::array<std::uint32_t, 8> bit_rates = {10'000,  20'000,  50'000,  125'000,
                                                    250'000, 500'000, 800'000, 1'000'000};  // [305]

struct LssOptions {
  Common common;
  std::string command;
  std::vector<std::string> words;
  bool stores = false;
  std::uint32_t delay = 0;  ///< ms; 0: not given
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

std::string text_of(const LssName& name) {
  return name.address ? address_name(*name.address) : fmt::format("{:08X}", name.serial_number.value_or(0));
}

bool is_one(const LssName& a, const LssName& b) { return a.serial_number == b.serial_number && a.address == b.address; }

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

/// Returns whether a line of a plan has names of columns: it begins neither with a number nor with an address.
bool is_heading(std::string_view line) {
  const std::string_view first = line.substr(0, line.find_first_of(",; \t"));
  return first.find_first_not_of("0123456789abcdefABCDEFxX:") != std::string_view::npos;
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
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // of a spreadsheet
  std::string_view rest = source->bytes();
  rest.remove_prefix(rest.substr(0, byte_order_mark.size()) == byte_order_mark ? byte_order_mark.size() : 0);
  for (unsigned number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = codict::trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::optional<Assignment> assignment = assignment_of(line, ',');
    if (assignment) {
      plan.push_back(*assignment);
    } else if (!line.empty() && line.front() != '#' && !(number == 1 && is_heading(line))) {
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
    const auto is_same_device = [&](const Assignment& other) { return is_one(other.device, plan[n].device); };
    if (std::any_of(plan.begin() + static_cast<std::ptrdiff_t>(n) + 1, plan.end(), is_same_device)) {
      print_message(fmt::format("the device {} is given twice", text_of(plan[n].device)));
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
      if (status == ok && std::find(addresses.begin(), addresses.end(), address) != addresses.end()) {
        print_message("the device " + address_name(address) + " is given twice");
        status = usage;
      }
      addresses.push_back(address);
    }
    status = status != ok ? status : check_free(plan);
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
    status = configure_rate(lss, addresses, bit_rate);
    if (status != ok) {
      return status;
    }
    const std::uint32_t delay = options_.delay != 0 ? options_.delay : usual_delay;
    if (!lss.activate(addresses, static_cast<std::uint16_t>(delay))) {
      print_message(fmt::format("the devices have {} kbit/s for the next activation{}; the switch was not completed",
                                bit_rate / 1000, options_.stores ? ", and have stored it" : ""));
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

  /// Gives all devices a bit rate for the activation, then lets all store it. If one refuses it, the others receive the
  /// old rate again.
  int configure_rate(LssSession& lss, const std::vector<LssAddress>& addresses, std::uint32_t bit_rate) {
    const auto fail = [&](std::size_t n, const char* refusal, std::size_t configured, std::size_t stored) {
      if (!Interruption::happened() && bus_.fault().empty()) {
        print_message(fmt::format("{} {}; none was switched", address_name(addresses[n]), refusal));
      }
      const int status = report(lss);
      restore_rate(lss, {addresses.begin(), addresses.begin() + static_cast<std::ptrdiff_t>(configured)}, stored,
                   bit_rate);
      return status;
    };
    for (std::size_t n = 0; n < addresses.size(); ++n) {
      if (!lss.select(addresses[n])) {
        return fail(n, "cannot be selected by LSS", n, 0);
      }
      if (!lss.set_bit_rate(bit_rate)) {
        const bool is_silent = lss.is_silent();  // its answer may have been lost
        return fail(n, is_silent ? "does not answer" : "does not accept the bit rate", is_silent ? n + 1 : n, 0);
      }
    }
    for (std::size_t n = 0; n < addresses.size() && options_.stores; ++n) {
      if (!lss.select(addresses[n])) {
        return fail(n, "cannot be selected by LSS", addresses.size(), n);
      }
      if (!lss.store()) {
        const bool is_silent = lss.is_silent();
        return fail(n, is_silent ? "does not answer the request to store" : "does not store the bit rate",
                    addresses.size(), is_silent ? n + 1 : n);
      }
    }
    return ok;
  }

  /// Gives devices the bit rate of the bus again, and names those that keep the new one. \a stored: the first devices,
  /// which have stored it.
  void restore_rate(LssSession& lss, const std::vector<LssAddress>& configured, std::size_t stored,
                    std::uint32_t bit_rate) {
    const std::uint32_t old = bus_.bit_rate();
    for (std::size_t n = 0; n < configured.size(); ++n) {
      const bool has_stored = n < stored;
      if (old == 0 || !lss.select(configured[n]) || !lss.set_bit_rate(old) || (has_stored && !lss.store())) {
        print_message(fmt::format(has_stored
                                      ? "{} has stored {} kbit/s, and has it after its next reset"
                                      : "{} has {} kbit/s for the next activation; lexican lss rate gives it another",
                                  address_name(configured[n]), bit_rate / 1000));
      }
    }
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

  /// Checks that no device has one of the node-IDs. A device that is stopped does not answer SDO requests, but has a
  /// heartbeat or answers node guarding. That is asked last, because the first request starts the life guarding.
  int check_free(const std::vector<Assignment>& plan) {
    HostLine line(host_);
    const Micros time = options_.common.timeout * millisecond;
    std::vector<CO_IF_FRM> questions;
    std::vector<CO_IF_FRM> guarding;
    for (const Assignment& each : plan) {
      questions.push_back({0x600U + each.node, {0x40, 0x00, 0x10, 0x00}, 8});
      guarding.push_back({(0x700U + each.node) | CO_IF_FRM_RTR, {}, 1});
    }
    std::uint8_t other = 0;
    bool is_sent = ask(line, questions, plan, time, other);
    is_sent = is_sent && (other != 0 || ask(line, guarding, plan, std::max<Micros>(time / 10, millisecond), other));
    if (Interruption::happened()) {
      print_message("interrupted; nothing was changed");
      return interrupted;
    }
    if (!bus_.fault().empty()) {
      print_message(bus_.fault());
      return bus_fault;
    }
    if (other != 0) {
      print_message(fmt::format("node-ID {} is that of another device; choose one that is free", other));
      return refused;
    }
    if (!is_sent) {
      print_message("the bus accepts no frames; nothing was changed");
      return no_answer;
    }
    return ok;
  }

  /// Sends frames, and listens to the nodes of a plan. \a heard: the first one that has sent something; else unchanged.
  /// \retval false  the bus does not accept the frames
  static bool ask(HostLine& line, const std::vector<CO_IF_FRM>& frames, const std::vector<Assignment>& plan,
                  Micros time, std::uint8_t& heard) {
    const Micros begin = line.now();
    std::size_t sent = 0;
    for (Micros now = begin; now - begin < time && heard == 0 && !line.is_ended(); now = line.now()) {
      while (sent < frames.size() && line.send(frames[sent])) {
        ++sent;
      }
      line.wait(sent < frames.size() ? millisecond : begin + time - now);
      while (const std::optional<CO_IF_FRM> frame = line.receive()) {
        const auto is_of = [&](const Assignment& each) {
          return frame->Identifier == 0x580U + each.node || frame->Identifier == 0x700U + each.node;
        };
        const auto found = std::find_if(plan.begin(), plan.end(), is_of);
        heard = heard == 0 && found != plan.end() ? found->node : heard;
      }
    }
    return sent == frames.size();
  }

  /// Gives a device its node-ID, and waits until it answers.
  int assign(const LssAddress& address, std::uint8_t node) {
    {
      LssSession lss(host_, times());
      if (!lss.select(address) || !lss.set_node_id(node)) {
        print_message(fmt::format("{}: node-ID {} was not set", address_name(address), node));
        return report(lss);
      }
      if (options_.stores && !lss.store()) {
        print_message(fmt::format("{} has node-ID {} until its next reset; it did not {} it", address_name(address),
                                  node, lss.is_silent() ? "confirm that it has stored" : "store"));
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

/// Checks that each option and argument is one of the command.
bool has_right_options(const LssOptions& options) {
  const bool changes = options.command == "assign" || options.command == "rate";
  const bool is_info = options.command == "info";
  if ((options.stores && !changes) || (options.delay != 0 && options.command != "rate") ||
      (!options.common.node.empty() && !is_info)) {
    print_message("--delay is for rate, --store for assign and rate, -n for info");
    return false;
  }
  if (is_info && !options.words.empty() && !options.common.node.empty()) {
    print_message("give SERIAL or -n NODE, not both");
    return false;
  }
  if (!changes && options.words.size() > (is_info ? 1U : 0U)) {
    print_message("too many arguments for " + options.command);
    return false;
  }
  return true;
}

int run_lss(const LssOptions& options) {
  if (!has_right_options(options)) {
    return usage;
  }
  std::vector<Assignment> plan;
  std::uint32_t bit_rate = 0;
  if (options.command == "assign" && !read_assignments(options, plan)) {
    return usage;
  }
  if (options.command == "rate") {
    if (options.words.size() != 1) {
      print_message("give one bit rate, such as 250k");
      return usage;
    }
    bit_rate = bit_rate_of(options.words.front());
    if (std::find(bit_rates.begin(), bit_rates.end(), bit_rate) == bit_rates.end()) {
      print_message("'" + options.words.front() +
                    "' is no bit rate of LSS: give 10k, 20k, 50k, 125k, 250k, 500k, 800k or 1M");
      return usage;
    }
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
