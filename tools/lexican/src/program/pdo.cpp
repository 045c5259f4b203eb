// SPDX-License-Identifier: Apache-2.0
// lexican pdo: shows, changes, watches and sends the PDOs of a device.
#include "program/pdo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "model/pdo.hpp"
#include "program/identity.hpp"

namespace lexican::program {
namespace {

constexpr unsigned most_absent = 4;  // PDOs one after another, behind which there are no more
constexpr std::uint16_t last_pdo = 512;
constexpr std::uint32_t most_mapped = 64;
constexpr std::uint32_t extended_identifier = 0x20000000;  // bit of a COB-ID
constexpr std::uint32_t no_remote = 0x40000000;

/// Returns the transmission type in words. [301:7.5.2.35, 7.5.2.37]
std::string transmission_text(std::uint32_t type, bool is_transmit) {
  using namespace codict::transmission_type;
  if (type == 0) {
    return is_transmit ? "with the SYNC after a change (0)" : "synchronous (0)";
  }
  if (type <= last_synchronous) {
    return !is_transmit ? fmt::format("synchronous ({})", type)
           : type == 1  ? "every SYNC (1)"
                        : fmt::format("every {} SYNCs ({})", type, type);
  }
  switch (type) {
    case remote_synchronous: return "on request, of the last SYNC (252)";
    case remote: return "on request (253)";
    case event_manufacturer: return "event-driven (254)";
    case event_profile: return "event-driven (255)";
    default: return fmt::format("reserved type {}", type);
  }
}

int run_show(const PdoOptions& options, PdoReader& reader, const std::vector<std::string>& words) {
  std::vector<DevicePdo> pdos;
  for (const std::string& word : words) {
    const std::optional<PdoName> name = pdo_of(word);
    std::optional<DevicePdo> pdo;
    if (!name) {
      print_message(fmt::format("'{}' is no PDO; these are rpdo1 to rpdo512, and tpdo1 to tpdo512", word));
      return usage;
    }
    const int status = reader.read(*name, pdo);
    if (status != ok) {
      return status;
    }
    if (!pdo) {
      print_message(fmt::format("node {} has no {}", reader.node(), name->text()));
      return refused;
    }
    pdos.push_back(*pdo);
  }
  const int status = words.empty() ? reader.read_all(pdos) : ok;
  if (status == ok && pdos.empty()) {
    print_message(fmt::format("node {} has no PDOs", reader.node()));
    return refused;
  }
  for (const DevicePdo& pdo : pdos) {
    options.common.is_json ? print_json(pdo, reader.node(), reader.description())
                           : print(text_of(pdo, reader.description()));
  }
  return status;
}

int run_with_device(const PdoOptions& options, std::uint8_t node, describe::Network& network,
                    const std::vector<std::string>& words) {
  int status = ok;
  std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  Session session(std::move(bus), node);
  PdoReader reader(session, node, network, options.common.timeout);
  Transfer transfer;
  const auto identity = identify_device(session.sdo(), node, options.common, network, transfer);
  if (!identity && (transfer.is_unanswered() || session.is_interrupted())) {
    return reader.report({0x1018, 1}, transfer);
  }
  return options.command == "show"  ? run_show(options, reader, words)
         : options.command == "map" ? run_map(options, reader, words)
                                    : run_send(options, reader, words);
}

/// Prints an option that does not belong to the command.
/// \retval false  there is one
bool has_own_options(const PdoOptions& options) {
  struct Given {
    bool is_given;
    const char* option;
    const char* command;
  };
  const Given all[] = {{!options.cob_id.empty(), "--cob-id", "map"},
                       {options.type.has_value(), "--type", "map"},
                       {options.inhibit_time.has_value(), "--inhibit", "map"},
                       {options.event_timer.has_value(), "--event", "map"},
                       {options.is_off, "--off", "map"},
                       {options.has_plot, "--plot", "watch"},
                       {!options.csv.empty(), "--csv", "watch"},
                       {!options.svg.empty(), "--svg", "watch"},
                       {options.duration != 0, "--for", "watch"},
                       {options.period != 0, "--every", "send"},
                       {options.sends_sync, "--sync", "send"}};
  for (const auto& [is_given, option, command] : all) {
    if (is_given && options.command != command) {
      print_message(fmt::format("{} is an option of pdo {}, not of pdo {}", option, command, options.command));
      return false;
    }
  }
  return true;
}

int run_pdo(PdoOptions& options) {
  if (!has_own_options(options)) {
    return usage;
  }
  std::vector<std::string> words = options.words;
  const bool has_node = !options.common.node.empty();
  if (!has_node && words.empty()) {
    print_message("give the node, such as lexican pdo show 5");
    return usage;
  }
  const std::string word = has_node ? options.common.node : words.front();
  if (!has_node) {
    words.erase(words.begin());
  }
  const std::uint8_t node = node_of(word);
  if (node == 0) {
    print_message("'" + word + "' is no node-ID, which is 1 to 127");
    return usage;
  }
  describe::Network network;
  if (!read_descriptions(options.common, network)) {
    return usage;
  }
  return options.command == "watch" ? run_watch(options, node, network, words)
                                    : run_with_device(options, node, network, words);
}

}  // namespace

std::string PdoName::text() const { return fmt::format("{}PDO{}", is_transmit ? 'T' : 'R', number); }

std::optional<PdoName> pdo_of(std::string_view word) {
  std::string name(word);
  std::transform(name.begin(), name.end(), name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  PdoName pdo;
  pdo.is_transmit = name.compare(0, 4, "tpdo") == 0;
  if (!pdo.is_transmit && name.compare(0, 4, "rpdo") != 0) {
    return std::nullopt;
  }
  const char* const end = name.data() + name.size();
  const auto [next, error] = std::from_chars(name.data() + 4, end, pdo.number);
  const bool is_number = error == std::errc() && next == end && pdo.number >= 1 && pdo.number <= last_pdo;
  return is_number ? std::optional(pdo) : std::nullopt;
}

std::string DevicePdo::identifier() const {
  return fmt::format((cob_id & extended_identifier) != 0 ? "{:08X}h" : "{:03X}h", frame().Identifier & CO_IF_FRM_ID);
}

CO_IF_FRM DevicePdo::frame() const {
  const bool is_extended = (cob_id & extended_identifier) != 0;
  CO_IF_FRM frame{};
  frame.Identifier = is_extended ? (cob_id & CO_IF_FRM_ID) | CO_IF_FRM_EXT : cob_id & 0x7FFU;
  frame.DLC = static_cast<std::uint8_t>((bits() + 7) / 8);
  return frame;
}

unsigned DevicePdo::bits() const {
  unsigned sum = 0;
  for (const MappedEntry& entry : mapped) {
    sum += entry.bits;
  }
  return sum;
}

int PdoReader::report(const describe::EntryKey& key, const Transfer& transfer) {
  Target target;
  target.node = node_;
  target.network = network_;
  target.name = description().object(key.first, key.second);
  return report_failure(session_, target, transfer);
}

PdoReader::Entry PdoReader::read_entry(std::uint16_t index, std::uint8_t sub_index, std::uint32_t& value) {
  const Transfer transfer = session_.sdo().upload(index, sub_index, {SdoClient::small, timeout_, {}});
  status_ = ok;
  if (transfer.done() && transfer.data.size() <= 4) {
    value = static_cast<std::uint32_t>(number_of(transfer.data));
    return Entry::read;
  }
  if (transfer.code == CO_SDO_ERR_OBJ || transfer.code == CO_SDO_ERR_SUB) {
    return Entry::absent;
  }
  if (transfer.done()) {
    print_message(fmt::format("{} has {} bytes instead of at most 4", description().object(index, sub_index),
                              transfer.data.size()));
    status_ = refused;
  } else {
    status_ = report({index, sub_index}, transfer);
  }
  return Entry::failed;
}

int PdoReader::read(const PdoName& name, std::optional<DevicePdo>& result) {
  DevicePdo pdo;
  pdo.name = name;
  const Entry entry = read_entry(name.communication(), 1, pdo.cob_id);
  if (entry != Entry::read) {
    result = std::nullopt;
    return status_;
  }
  struct Parameter {
    std::uint8_t sub_index;
    std::optional<std::uint32_t>* value;
  };
  for (const Parameter& parameter :
       {Parameter{2, &pdo.type}, Parameter{3, &pdo.inhibit_time}, Parameter{5, &pdo.event_timer}}) {
    std::uint32_t value = 0;
    const Entry parameter_entry = read_entry(name.communication(), parameter.sub_index, value);
    if (parameter_entry == Entry::failed) {
      return status_;
    }
    if (parameter_entry == Entry::read) {
      *parameter.value = value;
    }
  }
  const int status = read_mapping(pdo);
  result = std::move(pdo);
  return status;
}

int PdoReader::read_mapping(DevicePdo& pdo) {
  std::uint32_t count = 0;
  if (read_entry(pdo.name.mapping(), 0, count) == Entry::failed) {
    return status_;
  }
  pdo.is_multiplexed = count > most_mapped;
  for (std::uint32_t n = 1; n <= count && !pdo.is_multiplexed; ++n) {
    std::uint32_t value = 0;
    const Entry entry = read_entry(pdo.name.mapping(), static_cast<std::uint8_t>(n), value);
    if (entry == Entry::absent) {
      print_message(fmt::format("{:04X}h:00 says {} objects, but there is no {:04X}h:{:02X}", pdo.name.mapping(), count,
                                pdo.name.mapping(), n));
      return refused;
    }
    if (entry == Entry::failed) {
      return status_;
    }
    pdo.mapped.push_back(
        {{static_cast<std::uint16_t>(value >> 16), static_cast<std::uint8_t>(value >> 8)}, value & 0xFFU});
  }
  return ok;
}

int PdoReader::read_all(std::vector<DevicePdo>& pdos) {
  std::vector<PdoName> names;
  const codict::Device* const device = description().device();
  if (device != nullptr) {
    for (const codict::Pdo& pdo : codict::pdos_of(*device)) {
      names.push_back({pdo.is_transmit, pdo.number});
    }
  }
  for (const PdoName& name : names) {
    std::optional<DevicePdo> pdo;
    const int status = read(name, pdo);
    if (status != ok) {
      return status;
    }
    if (pdo) {
      pdos.push_back(*pdo);
    }
  }
  for (const bool is_transmit : {false, true}) {
    unsigned absent = 0;
    for (std::uint16_t number = 1; device == nullptr && number <= last_pdo && absent < most_absent; ++number) {
      std::optional<DevicePdo> pdo;
      const int status = read({is_transmit, number}, pdo);
      if (status != ok) {
        return status;
      }
      absent = pdo ? 0 : absent + 1;
      if (pdo) {
        pdos.push_back(*pdo);
      }
    }
  }
  return ok;
}

std::string text_of(const DevicePdo& pdo, const describe::Description& description) {
  std::string text = fmt::format("{}  {}{}", pdo.name.text(), pdo.identifier(), pdo.is_valid() ? "" : " off");
  if (pdo.type) {
    text += ", " + transmission_text(*pdo.type, pdo.name.is_transmit);
  }
  if (pdo.inhibit_time && *pdo.inhibit_time != 0) {
    text += fmt::format(", inhibit time {:g} ms", *pdo.inhibit_time / 10.0);
  }
  if (pdo.event_timer && *pdo.event_timer != 0) {
    text += fmt::format(", event timer {} ms", *pdo.event_timer);
  }
  text += '\n';
  if (pdo.is_multiplexed) {
    return text + "  multiplexed\n";
  }
  if (pdo.mapped.empty()) {
    return text + "  maps nothing\n";
  }
  for (const MappedEntry& entry : pdo.mapped) {
    text += entry.is_dummy() ? fmt::format("  unused, {} bits\n", entry.bits)
                             : fmt::format("  {}, {} bit{}\n", description.object(entry.key.first, entry.key.second),
                                           entry.bits, entry.bits == 1 ? "" : "s");
  }
  return text + (pdo.bits() > 64 ? fmt::format("  {} bits are more than the 64 of a PDO\n", pdo.bits()) : "");
}

void print_json(const DevicePdo& pdo, std::uint8_t node, const describe::Description& description) {
  nlohmann::json mapped = nlohmann::json::array();
  for (const MappedEntry& entry : pdo.mapped) {
    mapped.push_back({{"index", entry.key.first},
                      {"sub", entry.key.second},
                      {"bits", entry.bits},
                      {"object", description.object(entry.key.first, entry.key.second)}});
  }
  nlohmann::json json = {{"node", node},
                         {"pdo", pdo.name.text()},
                         {"cob_id", pdo.frame().Identifier & CO_IF_FRM_ID},
                         {"extended", (pdo.cob_id & extended_identifier) != 0},
                         {"valid", pdo.is_valid()},
                         {"remote", (pdo.cob_id & no_remote) == 0},
                         {"mapped", mapped}};
  const std::pair<const char*, const std::optional<std::uint32_t>&> parameters[] = {
      {"type", pdo.type}, {"inhibit_time", pdo.inhibit_time}, {"event_timer", pdo.event_timer}};
  for (const auto& [name, value] : parameters) {
    if (value) {
      json[name] = *value;
    }
  }
  print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

Verb add_pdo(CommandLine& line) {
  const auto options = std::make_shared<PdoOptions>();
  Arguments arguments = line.add_command("pdo", "Show, change, watch and send PDOs");
  arguments.add_option("command", options->command, "show, map, watch or send")
      .required()
      .one_of({"show", "map", "watch", "send"});
  arguments.add_option("arguments", options->words,
                       "Node-ID, then: show: PDOs, such as tpdo1; map: the PDO and its objects; watch: PDOs and "
                       "objects; send: OBJECT=VALUE");
  add_node_option(arguments, options->common);
  arguments.add_option("--cob-id", options->cob_id, "map: CAN identifier in hexadecimal digits");
  arguments.add_option("--type", options->type, "map: transmission type, 0 to 255");
  arguments.add_option("--inhibit", options->inhibit_time, "map: inhibit time in ms, such as 2.5");
  arguments.add_option("--event", options->event_timer, "map: event timer in ms");
  arguments.add_flag("--off", options->is_off, "map: leave the PDO switched off");
  arguments.add_flag("--plot", options->has_plot, "watch: draw curves of the values");
  arguments.add_option("--csv", options->csv, "watch: write the values to a file, - for the standard output");
  arguments.add_option("--svg", options->svg, "watch: draw the curves into a file at the end");
  arguments.add_option("--for", options->duration, "watch: time in s; default: until Ctrl-C");
  arguments.add_option("--every", options->period, "send: repeat it with this period in ms until Ctrl-C")
      .in_hidden_range(1, 3'600'000);
  arguments.add_flag("--sync", options->sends_sync, "send: a SYNC behind it");
  arguments.add_flag("--force", options->is_forced,
                     "send: also beyond the limits; map: also a CAN identifier with another use");
  add_bus_options(arguments, options->common);
  add_eds_option(arguments, options->common);
  add_timeout_option(arguments, options->common, 1000);
  arguments.end_help(
      "Examples:\n"
      "  lexican pdo show 5 -i can0 --eds drive.eds\n"
      "  lexican pdo map 5 tpdo2 6064 606C --event 100 -i can0 --eds drive.eds\n"
      "  lexican pdo watch 5 6064 --plot -i can0 --eds drive.eds\n"
      "  lexican pdo send 5 60FF=1000 -i can0 --eds drive.eds");
  return {arguments, [options] { return finish(options->common, run_pdo(*options)); }};
}

}  // namespace lexican::program
