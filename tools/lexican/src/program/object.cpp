// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

#include "program/identity.hpp"
#include "program/session.hpp"
#include "text/similar.hpp"
#include "trace/decode.hpp"

namespace lexican::program {
namespace {

constexpr std::size_t most_shown = 8;  // names in a message

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// Converts hex digits, with 0x before or h behind them.
template <typename Number>
bool parse_hex(std::string_view text, Number& number) {
  if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
    text.remove_prefix(2);
  } else if (text.size() > 1 && (text.back() == 'h' || text.back() == 'H')) {
    text.remove_suffix(1);
  }
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, number, 16);
  return !text.empty() && error == std::errc() && next == end;
}

/// The parts of INDEX, INDEX:SUB or INDEXsubSUB.
struct ReferenceText {
  std::string_view index;
  std::optional<std::string_view> sub_index;
};

ReferenceText split_reference(std::string_view word) {
  const std::size_t colon = word.find(':');
  const std::size_t sub = lower(word).find("sub");
  if (colon != std::string_view::npos) {
    return {word.substr(0, colon), word.substr(colon + 1)};
  }
  return sub != std::string::npos ? ReferenceText{word.substr(0, sub), word.substr(sub + 3)}
                                  : ReferenceText{word, std::nullopt};
}

bool parse_reference(std::string_view word, ObjectReference& reference) {
  const ReferenceText parts = split_reference(word);
  reference.sub_index = 0;
  return parse_hex(parts.index, reference.index) &&
         (!parts.sub_index || parse_hex(*parts.sub_index, reference.sub_index));
}

/// Returns the fault of a word that is an index or sub-index, not a name; empty: it is a name, or has no fault.
std::string reference_fault(std::string_view word) {
  const ReferenceText parts = split_reference(word);
  const bool has_colon = word.find(':') != std::string_view::npos;
  const bool begins_with_digit = !parts.index.empty() && std::isdigit(static_cast<unsigned char>(parts.index[0])) != 0;
  std::uint64_t number = 0;
  std::uint8_t sub_index = 0;
  const bool is_hex = parse_hex(parts.index, number);
  const bool has_sub_number = parts.sub_index && parse_hex(*parts.sub_index, number);
  constexpr const char* notations = "(hexadecimal): 1018, 1018:4, 1018h:04, 1018sub4";
  ObjectReference of_index;
  if (is_hex && parse_hex(parts.index, of_index.index)) {
    return (has_colon || has_sub_number) && !parse_hex(*parts.sub_index, sub_index)
               ? fmt::format("'{}' is no sub-index, which is 0 to FF {}", *parts.sub_index, notations)
               : std::string();
  }
  return (is_hex && begins_with_digit) || (has_colon && (is_hex || begins_with_digit || parts.index.empty()))
             ? fmt::format("'{}' is no index, which is 0 to FFFF {}", parts.index, notations)
             : std::string();
}

struct Named {
  ObjectReference object;
  std::string name;
};

std::vector<Named> names_of(const describe::Description& description) {
  std::vector<Named> names;
  if (description.device() != nullptr) {
    codict::for_each_variable(*description.device(), [&](std::uint16_t index, std::uint8_t sub, const codict::Entry&) {
      names.push_back({{index, sub}, description.name_of(index, sub)});
    });
    return names;
  }
  for (unsigned index = 0x1000; index <= 0x1029; ++index) {
    const auto name = describe::standard_name(static_cast<std::uint16_t>(index), 0);
    if (!name.empty()) {
      names.push_back({{static_cast<std::uint16_t>(index), 0}, std::string(name)});
    }
  }
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    names.push_back({{0x1018, sub}, std::string(describe::standard_name(0x1018, sub))});
  }
  return names;
}

std::string listed(const std::vector<Named>& names, const describe::Description& description) {
  std::string text;
  for (std::size_t n = 0; n < std::min(names.size(), most_shown); ++n) {
    text += "\n  " + description.object(names[n].object.index, names[n].object.sub_index);
  }
  return text + (names.size() > most_shown ? fmt::format("\n  and {} more", names.size() - most_shown) : "");
}

const char* remedy_for(std::uint32_t code, bool is_described) {
  switch (code) {
    case CO_SDO_ERR_TIMEOUT: return "the device itself has waited too long; repeat the command";
    case CO_SDO_ERR_OBJ:
    case CO_SDO_ERR_SUB:
      return is_described ? "the description may belong to another version of the device; compare 1018h"
                          : "the manual or the EDS of the device lists its objects";
    case CO_SDO_ERR_LEN_HIGH:
      return is_described ? "the value is longer than the object" : "give the type of the object by --type";
    case CO_SDO_ERR_LEN_SMALL:
      return is_described ? "the value is shorter than the object" : "give the type of the object by --type";
    case CO_SDO_ERR_LEN: return "give the type of the object by --type";
    case CO_SDO_ERR_CMD:
      return "another program may transfer an object of this device at the same time; repeat the command";
    case CO_SDO_ERR_RD: return "the object can only be written";
    case CO_SDO_ERR_WR: return "the object can only be read";
    case CO_SDO_ERR_RANGE:
    case CO_SDO_ERR_RANGE_HIGH:
    case CO_SDO_ERR_RANGE_LOW: return "the limits are in the description or the manual of the device";
    case CO_SDO_ERR_TOS_STATE:
    case CO_SDO_ERR_PARA_INCOMP:
      return "another state may accept it: lexican nmt preop NODE, or switch the device off first";
    case CO_SDO_ERR_OBJ_MAP:
      return "the description (PDOMapping) or the manual says which objects can be mapped, and in which direction";
    case CO_SDO_ERR_TOS_LOCAL: return nullptr;
    default: return nullptr;
  }
}

}  // namespace

bool find_object(const std::string& word, const describe::Description& description, ObjectReference& found,
                 std::string& why) {
  if (parse_reference(word, found)) {
    return true;
  }
  const std::vector<Named> names = names_of(description);
  const std::string wanted = lower(word);
  std::vector<Named> matches;
  for (const Named& candidate : names) {
    const std::string name = lower(candidate.name);
    const std::size_t comma = name.find(", ");
    const std::string last = comma == std::string::npos ? name : name.substr(comma + 2);
    if (name == wanted || last == wanted) {
      found = candidate.object;
      if (name == wanted) {
        return true;
      }
      matches.insert(matches.begin(), candidate);
    } else if (name.find(wanted) != std::string::npos) {
      matches.push_back(candidate);
    }
  }
  if (matches.size() == 1) {
    found = matches.front().object;
    return true;
  }
  if (!matches.empty()) {
    why = fmt::format("'{}' is the name of several objects; give more of it, or the index:", word) +
          listed(matches, description);
    return false;
  }
  why = reference_fault(word);
  if (!why.empty()) {
    return false;
  }
  std::vector<std::string_view> all;
  for (const Named& candidate : names) {
    all.emplace_back(candidate.name);
  }
  const std::vector<std::string_view> near = codict::similar(word, all);
  why = fmt::format("no object is called '{}'", word) +
        (!near.empty() ? fmt::format("; did you mean {}?", fmt::join(near, ", "))
         : description.device() == nullptr
             ? "; names need a description: --eds FILE. An index is hexadecimal: 6081, 1018:4"
             : "; an index is hexadecimal: 6081, 1018:4");
  return false;
}

void add_transfer_options(Arguments& arguments, TransferOptions& options) {
  arguments.add_option("node", options.node, "Node-ID of the device, 1 to 127");
  arguments.add_option("object", options.object, "Index in hex (6081, 1018:4), name, or a part of the name");
  add_bus_options(arguments, options.common);
  add_node_option(arguments, options.common);
  add_eds_option(arguments, options.common);
  add_timeout_option(arguments, options.common, 1000);
  std::vector<std::string> types = {"bool", "string", "bytes", "domain", "r32", "r64"};
  for (unsigned bits = 8; bits <= 64; bits += 8) {
    types.push_back("u" + std::to_string(bits));
    types.push_back("i" + std::to_string(bits));
  }
  arguments
      .add_option(
          "--type", options.type,
          "Type of the value: " + std::string(value_type_names) + "; default: that of the description, or of CiA 301")
      .suggest(std::move(types));
}

std::string exceeded_limits(const codict::Entry& entry, std::uint8_t node, const codict::Integer& value) {
  const codict::Value& low = *entry.low_limit;
  const codict::Value& high = *entry.high_limit;
  const bool is_low = low.is_integer() && value < low.integer_for(node);
  const bool is_high = high.is_integer() && high.integer_for(node) < value;
  return is_low || is_high ? fmt::format("{} to {}", low.is_integer() ? low.written_integer() : "-",
                                         high.is_integer() ? high.written_integer() : "-")
                           : std::string();
}

std::string beyond_limits(const describe::Description& description, std::uint8_t node, const describe::EntryKey& key,
                          const std::string& value) {
  const codict::Device* const device = description.device();
  const codict::Entry* const entry = device != nullptr ? device->find(key.first, key.second) : nullptr;
  const codict::ParsedInteger number = codict::parse_integer(value);
  if (entry == nullptr || !number.is_meant()) {
    return {};
  }
  const std::string limits = exceeded_limits(*entry, node, number.value);
  return limits.empty()
             ? std::string()
             : fmt::format("{} is beyond the limits of the description, {}; --force writes it", value, limits);
}

std::string type_text(const ValueType& type) {
  const std::string bits = std::to_string(8 * type.size);
  switch (type.kind) {
    case ValueType::Kind::unsigned_integer: return "u" + bits;
    case ValueType::Kind::integer: return "i" + bits;
    case ValueType::Kind::real: return "r" + bits;
    case ValueType::Kind::boolean: return "bool";
    case ValueType::Kind::text: return "string";
    default: return "bytes";
  }
}

std::string shown(const Target& target, const Bytes& data) {
  if (!target.is_type_given) {
    return target.network.of(target.node).show(target.object.index, target.object.sub_index, data);
  }
  std::string text = show(*target.type, data).text;
  std::replace(text.begin(), text.end(), '\n', '?');  // a device must not write further lines
  return text;
}

std::string line_of(const Target& target, const Bytes& data) {
  return target.name + " = " + shown(target, data) + (target.type ? " (" + type_text(*target.type) + ")" : "") + '\n';
}

namespace {

/// Looks the object up in the description of the node. Prints the reason if it is not found.
bool find(const TransferOptions& options, Target& target) {
  const describe::Description& description = target.network.of(target.node);
  std::string why;
  if (!find_object(*options.object, description, target.object, why)) {
    print_message(why);
    return false;
  }
  target.name = description.object(target.object.index, target.object.sub_index);
  if (!target.is_type_given) {
    target.type = description.type_of(target.object.index, target.object.sub_index);
  }
  target.is_found = true;
  return true;
}

}  // namespace

bool prepare(const TransferOptions& options, Target& target) {
  if (!options.node || !options.object) {
    print_message("give the node and the object, such as 5 1018:4");
    return false;
  }
  target.node = node_of(*options.node);
  if (target.node == 0) {
    print_message("'" + *options.node + "' is no node-ID, which is 1 to 127");
    return false;
  }
  if (!read_descriptions(options.common, target.network)) {
    return false;
  }
  target.is_type_given = !options.type.empty();
  target.type = target.is_type_given ? value_type(options.type) : std::nullopt;
  if (target.is_type_given && !target.type) {
    print_message("'" + options.type + "' is no type; types are " + value_type_names);
    return false;
  }
  const describe::Description& description = target.network.of(target.node);
  std::error_code ignored;
  const bool has_library = !describe::description_files(describe::user_library(), ignored).empty();
  ObjectReference reference;
  std::string why;
  const bool is_known = find_object(*options.object, description, reference, why);
  const bool is_deferred = description.device() == nullptr && (is_known || reference_fault(*options.object).empty()) &&
                           (has_library || (!is_known && may_upload(options.common)));
  return is_deferred || find(options, target);
}

int find_in_device(Session& session, const TransferOptions& options, Target& target) {
  if (target.is_found) {
    return ok;
  }
  std::string why;
  ObjectReference reference;
  const bool is_known = find_object(*options.object, target.network.of(target.node), reference, why);
  Transfer transfer;
  const std::optional<describe::Identity> identity = read_identity(session.sdo(), options.common.timeout, transfer);
  if (!identity && (transfer.is_unanswered() || session.host().interrupted())) {
    target.name = "identity (1018h)";
    return report_failure(session, target, transfer);
  }
  std::optional<describe::Known> known;
  if (identity) {
    known = describe::find_description(describe::user_library(), *identity);
    if (!known && !is_known) {
      known = upload_description(session.sdo(), target.node, *identity, options.common);
    }
    if (session.is_interrupted()) {
      print_message("interrupted");
      return interrupted;
    }
  }
  if (known) {
    target.network.describe(target.node, std::move(known->description));
  }
  return find(options, target) ? ok : usage;
}

std::string hung_server_text(std::uint8_t node, const char* messages) {
  return fmt::format(
      "node {0} sends {1}, but does not answer SDO requests; lexican why looks for the cause, and lexican nmt reset "
      "{0} restarts it",
      node, messages);
}

int report_failure(Session& session, const Target& target, const Transfer& transfer) {
  const bool is_described = target.network.of(target.node).device() != nullptr;
  const char* const remedy = remedy_for(transfer.code, is_described);
  if (session.is_interrupted()) {
    print_message("interrupted; the transfer was aborted");
    return interrupted;
  }
  if (!session.bus().fault().empty()) {
    print_message(session.bus().fault());
    return bus_fault;
  }
  if (!session.bus().refusal().empty()) {
    print_message(session.bus().refusal());
    return bus_fault;
  }
  if (transfer.is_unanswered()) {
    const char* const messages = session.messages();
    print_message(session.state() == 0x04
                      ? fmt::format("node {0} is stopped and answers no SDO: lexican nmt preop {0}", target.node)
                  : messages != nullptr
                      ? hung_server_text(target.node, messages)
                      : fmt::format("node {} does not answer; is it on this bus, with power, and at this bit rate? "
                                    "lexican scan shows who answers",
                                    target.node));
    return no_answer;
  }
  print_message(fmt::format("node {}, {}: {}", target.node, target.name, transfer.outcome()) +
                (remedy != nullptr ? std::string("; ") + remedy : ""));
  return transfer.fault.empty() ? refused : bus_fault;
}

}  // namespace lexican::program
