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
  const bool is_whole = std::abs(value * factor - scaled) < 1e-6;
  if (error != std::errc() || next != end || !is_whole || !(scaled >= 0 && scaled <= most)) {
    print_message(fmt::format("{} '{}' is no number from 0 to {:g}", name, *text, most / factor));
    return false;
  }
  number = static_cast<std::uint32_t>(scaled);
  return true;
}

std::string summary_of_step(const PdoStep& step) { return fmt::format("{:0{}X}h", step.value, 2 * step.bytes); }

/// Changes one PDO, and restores what it has written if the device refuses a part.
class PdoChange {
 public:
  PdoChange(PdoReader& reader, const DevicePdo& before, const DevicePdo& wanted)
      : reader_(reader), before_(before), wanted_(wanted) {}

  int run() {
    for (const PdoStep& step : steps()) {
      const Transfer transfer = write(step);
      const bool is_refusal =
          transfer.fault.empty() && !transfer.is_unanswered() && !reader_.session().is_interrupted();
      if (transfer.done() || !is_refusal) {
        written_.push_back(step);  // without an answer, too: the device may have it
      }
      if (transfer.done()) {
        continue;
      }
      const int status = reader_.report(step.key, transfer);
      if (is_refusal) {
        print_message(fmt::format("the value that it has refused is {}", summary_of_step(step)));
      }
      if (!written_.empty()) {
        const bool is_restored = is_refusal && restore();
        print_message(is_restored ? before_.name.text() + " is as it was before" : remainder());
      }
      return status;
    }
    return ok;
  }

  /// Returns the command that gives the PDO what it had before.
  std::string remainder() const {
    std::string command = fmt::format("lexican pdo map {} {}", reader_.node(), before_.name.text());
    for (const auto& [key, bits] : before_.mapped) {
      command += fmt::format(" {:X}:{:X}/{}", key.first, key.second, bits);
    }
    const auto add = [&](const char* option, const std::optional<std::uint32_t>& old,
                         const std::optional<std::uint32_t>& value, double factor) {
      command += old && value != old ? fmt::format(" {} {:g}", option, *old / factor) : "";
    };
    add("--type", before_.type, wanted_.type, 1);
    add("--inhibit", before_.inhibit_time, wanted_.inhibit_time, 10);
    add("--event", before_.event_timer, wanted_.event_timer, 1);
    command += before_.frame().Identifier != wanted_.frame().Identifier
                   ? fmt::format(" --cob-id {:X}", before_.frame().Identifier & CO_IF_FRM_ID)
                   : "";
    return fmt::format(
        "a part of {0} may have changed, and it may be switched off; lexican pdo show {1} {0} has it. Before: {2}{3}",
        before_.name.text(), reader_.node(), command, before_.is_valid() ? "" : " --off");
  }

 private:
  /// Returns the values to write: the PDO is switched off while they change.
  std::vector<PdoStep> steps() const {
    const std::uint16_t communication = wanted_.name.communication();
    std::vector<PdoStep> steps;
    const auto add = [&](std::uint8_t sub_index, unsigned bytes, const std::optional<std::uint32_t>& value,
                         const std::optional<std::uint32_t>& old) {
      if (value && value != old) {
        steps.push_back({{communication, sub_index}, *value, bytes});
      }
    };
    add(2, 1, wanted_.type, before_.type);
    add(3, 2, wanted_.inhibit_time, before_.inhibit_time);
    add(5, 2, wanted_.event_timer, before_.event_timer);
    if (!is_same_mapping()) {
      const std::vector<PdoStep> mapping = mapping_of(wanted_);
      steps.insert(steps.end(), mapping.begin(), mapping.end());
    }
    const bool is_changed = !steps.empty() || wanted_.cob_id != before_.cob_id;
    if (is_changed && before_.is_valid()) {
      steps.insert(steps.begin(), {{communication, 1}, before_.cob_id | switched_off, 4});
    }
    if (is_changed) {
      steps.push_back({{communication, 1}, wanted_.cob_id, 4});
    }
    return steps;
  }

  static std::vector<PdoStep> mapping_of(const DevicePdo& pdo) {
    const std::uint16_t mapping = pdo.name.mapping();
    std::vector<PdoStep> steps = {{{mapping, 0}, 0, 1}};
    for (std::size_t n = 0; n < pdo.mapped.size(); ++n) {
      const auto [key, bits] = pdo.mapped[n];
      const std::uint32_t value =
          static_cast<std::uint32_t>(key.first) << 16 | static_cast<std::uint32_t>(key.second) << 8 | bits;
      steps.push_back({{mapping, static_cast<std::uint8_t>(n + 1)}, value, 4});
    }
    steps.push_back({{mapping, 0}, static_cast<std::uint32_t>(pdo.mapped.size()), 1});
    return steps;
  }

  bool is_same_mapping() const {
    return std::equal(wanted_.mapped.begin(), wanted_.mapped.end(), before_.mapped.begin(), before_.mapped.end(),
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

  bool was_written(std::uint16_t index) const {
    return std::any_of(written_.begin(), written_.end(), [=](const PdoStep& step) { return step.key.first == index; });
  }

  /// Writes again what the device had, of those objects that were written.
  /// \retval false  the device has refused a part of it
  bool restore() {
    const std::uint16_t communication = before_.name.communication();
    std::vector<PdoStep> steps;
    const std::pair<std::uint8_t, const std::optional<std::uint32_t>&> parameters[] = {
        {std::uint8_t{2}, before_.type},
        {std::uint8_t{3}, before_.inhibit_time},
        {std::uint8_t{5}, before_.event_timer}};
    for (const PdoStep& step : written_) {
      for (const auto& [sub_index, value] : parameters) {
        if (step.key == describe::EntryKey{communication, sub_index} && value) {
          steps.push_back({step.key, *value, step.bytes});
        }
      }
    }
    if (was_written(before_.name.mapping())) {
      const std::vector<PdoStep> mapping = mapping_of(before_);
      steps.insert(steps.end(), mapping.begin(), mapping.end());
    }
    if (was_written(communication) || was_written(before_.name.mapping())) {
      steps.push_back({{communication, 1}, before_.cob_id, 4});
    }
    bool is_good = true;
    for (const PdoStep& step : steps) {
      is_good = write(step).done() && is_good;
    }
    return is_good;
  }

  PdoReader& reader_;
  const DevicePdo& before_;
  const DevicePdo& wanted_;
  std::vector<PdoStep> written_;
};

/// Returns what a CAN identifier is for if CiA 301 does not allow it for PDOs, or if another PDO of the device has it;
/// empty: neither. [301:7.3.5]
std::string other_use(std::uint32_t id, const std::vector<DevicePdo>& others, const DevicePdo& pdo) {
  struct Use {
    std::uint32_t first;
    std::uint32_t last;
    const char* name;
  };
  constexpr Use uses[] = {{0x001, 0x07F, "reserved"}, {0x080, 0x080, "SYNC"},     {0x081, 0x0FF, "EMCY"},
                          {0x100, 0x100, "TIME"},     {0x101, 0x180, "reserved"}, {0x580, 0x5FF, "SDO"},
                          {0x600, 0x67F, "SDO"},      {0x6E0, 0x6FF, "reserved"}, {0x700, 0x77F, "error control"},
                          {0x780, 0x7FF, "reserved"}};
  for (const Use& use : uses) {
    if (id >= use.first && id <= use.last) {
      return fmt::format("{:03X}h is for {}", id, use.name);
    }
  }
  for (const DevicePdo& other : others) {
    if (!(other.name == pdo.name) && other.is_valid() && other.frame().Identifier == pdo.frame().Identifier) {
      return fmt::format("{} has {}", other.name.text(), other.identifier());
    }
  }
  return {};
}

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
  if (!options.cob_id.empty() && !options.is_forced) {
    std::vector<DevicePdo> pdos;
    status = reader.read_all(pdos);
    if (status != ok) {
      return status;
    }
    const std::string use = other_use(wanted.frame().Identifier, pdos, wanted);
    if (!use.empty()) {
      print_message(use + "; --force uses it all the same");
      return usage;
    }
  }
  PdoChange change(reader, *before, wanted);
  status = change.run();
  if (status != ok) {
    return status;
  }
  std::optional<DevicePdo> after;
  status = reader.read(*name, after);
  if (status != ok || !after) {
    print_message("the device has accepted all values, but they could not be read back; " + change.remainder());
    return status != ok ? status : refused;
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
