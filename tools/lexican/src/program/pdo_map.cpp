// SPDX-License-Identifier: Apache-2.0
// lexican pdo map: changes the mapping and the parameters of a PDO in the order that CiA 301 requires.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "program/pdo.hpp"
#include "text/number.hpp"
#include "trace/decode.hpp"

namespace lexican::program {
namespace {

constexpr std::uint32_t switched_off = 0x80000000;
constexpr unsigned most_bits = 64;
constexpr std::uint32_t largest_identifier = 0x1FFFFFFF;

/// A value that has to be written.
struct PdoStep {
  describe::EntryKey key;
  std::uint32_t value = 0;
  unsigned bytes = 4;
};

/// Returns the length of an object in bits; 0: it is unknown.
unsigned length_of(const describe::Description& description, const describe::EntryKey& key) {
  constexpr unsigned dummies[] = {0, 1, 8, 16, 32, 8, 16, 32};  // data types 0001h to 0007h [301:7.4.7]
  if (key.first < std::size(dummies) && key.second == 0) {
    return dummies[key.first];
  }
  const std::optional<ValueType> type = description.type_of(key.first, key.second);
  return !type ? 0U : type->kind == ValueType::Kind::boolean ? 1U : 8U * type->size;
}

/// Parses OBJECT or OBJECT/BITS.
/// \retval nothing  the reason is printed
std::optional<MappedEntry> mapped_entry_of(const std::string& word, const describe::Description& description) {
  const std::size_t slash = word.rfind('/');
  unsigned bits = 0;
  const char* const end = word.data() + word.size();
  const bool has_bits = slash != std::string::npos && std::from_chars(word.data() + slash + 1, end, bits).ptr == end &&
                        bits >= 1 && bits <= most_bits;
  ObjectReference object;
  std::string why;
  if (!find_object(has_bits ? word.substr(0, slash) : word, description, object, why)) {
    print_message(why);
    return std::nullopt;
  }
  const MappedEntry entry{{object.index, object.sub_index},
                          has_bits ? bits : length_of(description, {object.index, object.sub_index})};
  if (entry.bits == 0) {
    print_message(fmt::format("the length of {} is unknown; give it in bits, such as {}/16, or --eds",
                              description.object(object.index, object.sub_index), word));
    return std::nullopt;
  }
  return entry;
}

/// Converts a number of the command line.
/// \retval false  the reason is printed
bool number_of_option(const std::optional<std::string>& text, const char* name, double factor, std::uint32_t most,
                      std::optional<std::uint32_t>& number) {
  if (!text) {
    return true;
  }
  double value = 0;
  const char* const end = text->data() + text->size();
  const auto [next, error] = std::from_chars(text->data(), end, value);
  const double scaled = std::round(value * factor);
  if (error != std::errc() || next != end || !(scaled >= 0 && scaled <= most)) {
    print_message(fmt::format("{} '{}' is no number from 0 to {:g}", name, *text, most / factor));
    return false;
  }
  number = static_cast<std::uint32_t>(scaled);
  return true;
}

std::string summary_of_step(const PdoStep& step) { return fmt::format("{:0{}X}h", step.value, 2 * step.bytes); }

/// Changes one PDO, and restores it if the device refuses a part.
class PdoChange {
 public:
  PdoChange(PdoReader& reader, const DevicePdo& before, const DevicePdo& wanted)
      : reader_(reader), before_(before), wanted_(wanted) {}

  int run() {
    const std::vector<PdoStep> steps = steps_to(wanted_, before_);
    for (const PdoStep& step : steps) {
      const Transfer transfer = write(step);
      if (transfer.done()) {
        ++done_;
        continue;
      }
      const std::string object = reader_.description().object(step.key.first, step.key.second);
      const bool is_refusal =
          transfer.fault.empty() && transfer.code != CO_SDO_ERR_TIMEOUT && !reader_.session().is_interrupted();
      const int status = reader_.report(step.key, transfer);
      if (is_refusal) {
        print_message(fmt::format("the value that it has refused is {}", summary_of_step(step)));
      }
      if (done_ > 0) {
        print_message(is_refusal && restore() ? before_.name.text() + " is as it was before"
                                              : before_.name.text() + " may be switched off; lexican pdo show has it");
      }
      return status;
    }
    return ok;
  }

 private:
  /// Returns the values that lead from a PDO to another one: it is switched off while they change.
  std::vector<PdoStep> steps_to(const DevicePdo& to, const DevicePdo& from) const {
    const std::uint16_t communication = to.name.communication();
    const std::uint16_t mapping = to.name.mapping();
    std::vector<PdoStep> steps;
    if (from.is_valid()) {
      steps.push_back({{communication, 1}, from.cob_id | switched_off, 4});
    }
    const auto add = [&](std::uint8_t sub_index, unsigned bytes, const std::optional<std::uint32_t>& value,
                         const std::optional<std::uint32_t>& old) {
      if (value && value != old) {
        steps.push_back({{communication, sub_index}, *value, bytes});
      }
    };
    add(2, 1, to.type, from.type);
    add(3, 2, to.inhibit_time, from.inhibit_time);
    add(5, 2, to.event_timer, from.event_timer);
    if (!is_same_mapping(to, from)) {
      steps.push_back({{mapping, 0}, 0, 1});
      for (std::size_t n = 0; n < to.mapped.size(); ++n) {
        const auto [key, bits] = to.mapped[n];
        const std::uint32_t value =
            static_cast<std::uint32_t>(key.first) << 16 | static_cast<std::uint32_t>(key.second) << 8 | bits;
        steps.push_back({{mapping, static_cast<std::uint8_t>(n + 1)}, value, 4});
      }
      steps.push_back({{mapping, 0}, static_cast<std::uint32_t>(to.mapped.size()), 1});
    }
    if (!steps.empty() || to.cob_id != from.cob_id) {
      steps.push_back({{communication, 1}, to.cob_id, 4});
    }
    return steps;
  }

  static bool is_same_mapping(const DevicePdo& one, const DevicePdo& other) {
    return std::equal(one.mapped.begin(), one.mapped.end(), other.mapped.begin(), other.mapped.end(),
                      [](const MappedEntry& a, const MappedEntry& b) { return a.key == b.key && a.bits == b.bits; });
  }

  Transfer write(const PdoStep& step) {
    Bytes bytes(step.bytes);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      bytes[n] = static_cast<std::uint8_t>(step.value >> (8 * n));
    }
    return reader_.session().sdo().download(step.key.first, step.key.second, bytes,
                                            {SdoClient::small, reader_.timeout(), {}});
  }

  /// \retval false  the device has refused a part of it
  bool restore() {
    DevicePdo half = wanted_;  // switched off; all that differs is written again
    half.cob_id = before_.cob_id | switched_off;
    half.mapped.push_back({});
    bool is_good = true;
    for (const PdoStep& step : steps_to(before_, half)) {
      is_good = write(step).done() && is_good;
    }
    return is_good;
  }

  PdoReader& reader_;
  const DevicePdo& before_;
  const DevicePdo& wanted_;
  std::size_t done_ = 0;
};

/// Sets what the command line gives.
/// \retval false  the reason is printed
bool set_wanted(const PdoOptions& options, const std::vector<std::string>& words,
                const describe::Description& description, DevicePdo& pdo) {
  if (!number_of_option(options.type, "--type", 1, 255, pdo.type) ||
      !number_of_option(options.inhibit_time, "--inhibit", 10, 65535, pdo.inhibit_time) ||
      !number_of_option(options.event_timer, "--event", 1, 65535, pdo.event_timer)) {
    return false;
  }
  if (words.size() > 1) {
    pdo.mapped.clear();
  }
  for (std::size_t n = 1; n < words.size(); ++n) {
    const std::optional<MappedEntry> entry = mapped_entry_of(words[n], description);
    if (!entry) {
      return false;
    }
    pdo.mapped.push_back(*entry);
  }
  if (pdo.bits() > most_bits) {
    print_message(fmt::format("the objects have {} bits, and a PDO has 64", pdo.bits()));
    return false;
  }
  std::uint64_t identifier = pdo.frame().Identifier & CO_IF_FRM_ID;
  if (!options.cob_id.empty()) {
    std::string_view digits = options.cob_id;
    digits.remove_prefix(digits.substr(0, 2) == "0x" ? 2 : 0);
    digits.remove_suffix(!digits.empty() && digits.back() == 'h' ? 1 : 0);
    if (!codict::parse_hex(digits, identifier) || identifier == 0 || identifier > largest_identifier) {
      print_message(fmt::format("--cob-id '{}' is no CAN identifier, such as 2A5", options.cob_id));
      return false;
    }
    const std::uint32_t others = pdo.cob_id & 0x40000000U;
    pdo.cob_id = others | static_cast<std::uint32_t>(identifier) | (identifier > 0x7FF ? 0x20000000U : 0U);
  }
  if (identifier == 0 && !options.is_off) {
    print_message(fmt::format("{} has no CAN identifier; give one, such as --cob-id 2A5", pdo.name.text()));
    return false;
  }
  pdo.cob_id = options.is_off ? pdo.cob_id | switched_off : pdo.cob_id & ~switched_off;
  return true;
}

}  // namespace

int run_map(const PdoOptions& options, PdoReader& reader, const std::vector<std::string>& words) {
  const std::optional<PdoName> name = words.empty() ? std::nullopt : pdo_of(words.front());
  if (!name) {
    print_message("which PDO? Give it and its objects, such as lexican pdo map 5 tpdo2 6064 606C");
    return usage;
  }
  std::optional<DevicePdo> before;
  int status = reader.read(*name, before);
  if (status != ok) {
    return status;
  }
  if (!before) {
    print_message(fmt::format("node {} has no {}", reader.node(), name->text()));
    return refused;
  }
  if (before->is_multiplexed && words.size() > 1) {
    print_message(name->text() + " is multiplexed; its objects are fixed");
    return refused;
  }
  DevicePdo wanted = *before;
  if (!set_wanted(options, words, reader.description(), wanted)) {
    return usage;
  }
  status = PdoChange(reader, *before, wanted).run();
  if (status != ok) {
    return status;
  }
  std::optional<DevicePdo> after;
  status = reader.read(*name, after);
  if (status != ok || !after) {
    return status;
  }
  options.common.is_json ? print_json(*after, reader.node(), reader.description())
                         : print(text_of(*after, reader.description()));
  const std::string expected = text_of(wanted, reader.description());
  if (text_of(*after, reader.description()) != expected) {
    print_message("the device has accepted it, but reads back something else than\n" + expected);
    return refused;
  }
  return ok;
}

}  // namespace lexican::program
