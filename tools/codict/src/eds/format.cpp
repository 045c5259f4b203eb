// SPDX-License-Identifier: Apache-2.0
#include "eds/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "eds/fields.hpp"
#include "eds/names.hpp"
#include "eds/numbered.hpp"
#include "eds/slots.hpp"
#include "model/access.hpp"
#include "model/device.hpp"
#include "text/number.hpp"
#include "text/suppression.hpp"

namespace lexican::codict::eds {

namespace {

// A section with the lines of comments in front of it.
struct Block {
  const Section* section = nullptr;
  SectionName name;
  std::vector<std::string_view> before;
  std::vector<std::string> lines;
};

// Ranks in the order of the file. [306: 4.3]
enum Rank : unsigned char { header, mandatory = 10, optional = 20, manufacturer = 30, module = 40, last = 50 };

Rank rank_of(ListKind kind) {
  return kind == ListKind::mandatory ? mandatory : kind == ListKind::optional ? optional : manufacturer;
}

unsigned rank_of_header(std::string_view word) {
  static const std::map<std::string_view, unsigned> ranks = {
      {"FileInfo", header},
      {"DeviceInfo", header + 1},
      {"DummyUsage", header + 2},
      {"Comments", header + 3},
      {"DynamicChannels", header + 4},
      {"DeviceComissioning", header + 5},
      {"DeviceCommissioning", header + 5},
      {"MandatoryObjects", mandatory},
      {"OptionalObjects", optional},
      {"ManufacturerObjects", manufacturer},
      {"SupportedModules", module},
      {"ConnectedModules", last},
  };
  return ranks.at(word);
}

// Returns the sort key of a section. Sections with equal keys keep their order.
auto order_of(const SectionName& name) {
  using Order = std::tuple<unsigned, std::uint16_t, SectionKind, std::uint8_t>;
  if (has_index(name)) {
    const ListKind kind = name.index < 0x1000 ? ListKind::optional : list_of(name.index);
    return Order(rank_of(kind) + 1U, name.index, name.kind, name.sub_index);
  }
  switch (name.kind) {
    case SectionKind::header: return Order(rank_of_header(name.word), 0, name.kind, 0);
    case SectionKind::other: return Order(last + 1U, 0, name.kind, 0);
    default: return Order(module + 1U, name.module, SectionKind::module, 0);
  }
}

std::string text_of(const SectionName& name) {
  switch (name.kind) {
    case SectionKind::object: return fmt::format("{:04X}", name.index);
    case SectionKind::sub: return fmt::format("{:04X}sub{:X}", name.index, name.sub_index);
    case SectionKind::names: return fmt::format("{:04X}Name", name.index);
    case SectionKind::values: return fmt::format("{:04X}Value", name.index);
    case SectionKind::denotations: return fmt::format("{:04X}Denotation", name.index);
    case SectionKind::links: return fmt::format("{:04X}ObjectLinks", name.index);
    case SectionKind::header: return std::string(name.word);
    default: return {};
  }
}

bool is_any_of(std::string_view key, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [key](std::string_view word) { return compare_names(key, word) == 0; });
}

template <typename T, std::size_t size>
std::string_view key_in(const std::array<Slot<T>, size>& slots, std::string_view key) {
  const auto slot =
      std::find_if(slots.begin(), slots.end(), [key](const Slot<T>& s) { return compare_names(s.key, key) == 0; });
  return slot != slots.end() ? slot->key : std::string_view();
}

// Returns the spelling of a key in CiA 306; empty if such a section has no key of this name.
std::string_view standard_key(const SectionName& section, std::string_view key) {
  if (section.kind == SectionKind::object || section.kind == SectionKind::sub) {
    const std::string_view of_entry = key_in(entry_slots, key);
    return of_entry.empty() ? key_in(object_slots, key) : of_entry;
  }
  if (section.word == "FileInfo") {
    return key_in(file_slots, key);
  }
  return section.word == "DeviceInfo" ? key_in(device_slots, key) : std::string_view();
}

std::string hexadecimal(std::string_view text, int digits) {
  const ParsedInteger number = parse_integer(text);
  const bool fits = number.is_number() && number.base != Base::octal && fits_unsigned(number.value, 16);
  return fits ? fmt::format("0x{:0{}X}", number.value.magnitude, digits) : std::string(text);
}

// Replaces the prefix 0X of a number by 0x.
std::string with_small_x(std::string text) {
  if (text.substr(0, 2) == "0X" && parse_integer(text).is_number()) {
    text[1] = 'x';
  }
  return text;
}

std::string with_node_id(std::string_view text) {
  const ParsedFormula formula = parse_formula(text);
  if (!formula.has_node_id || formula.is_standard || !formula.number.is_number()) {
    return std::string(text);
  }
  const Integer number = formula.number.value;
  return fmt::format("$NODEID+{}0x{:X}", number.is_negative ? "-" : "", number.magnitude);
}

class Formatter {
 public:
  explicit Formatter(const Document& document) : document_(document) {
    for (const Section& section : document.sections()) {
      const SectionName name = section_name(document, section);
      if (name.kind == SectionKind::sub && name.sub_index != 0xFF) {
        subs_[name.index].insert(name.sub_index);
      }
    }
  }

  std::string run() {
    std::vector<std::string_view> top;
    const std::uint32_t first = document_.sections().empty() ? source().lines() + 1 : document_.sections().front().line;
    for (std::uint32_t line = 1; line < first; ++line) {
      top.push_back(content(line));
    }
    std::vector<Block> blocks;
    std::vector<std::string_view> between;
    for (const Section& section : document_.sections()) {
      blocks.push_back({&section, section_name(document_, section), std::exchange(between, {}), {}});
      read(blocks.back(), between);
    }
    std::stable_sort(blocks.begin(), blocks.end(),
                     [](const Block& a, const Block& b) { return order_of(a.name) < order_of(b.name); });
    // Above the first section, a comment that suppresses rules would apply to the whole file.
    const auto plain =
        std::find_if_not(blocks.begin(), blocks.end(), [this](const Block& block) { return has_suppression(block); });
    if (plain != blocks.end()) {
      std::rotate(blocks.begin(), plain, plain + 1);
      // The next reader cannot distinguish its comments from those of the file.
      std::vector<std::string_view>& comments = blocks.front().before;
      top.insert(top.end(), comments.begin(), comments.end());
      comments.clear();
    }
    text_ = document_.raw({0, static_cast<std::uint32_t>(mark_size(source().bytes()))});
    paragraph(top);
    for (const Block& block : blocks) {
      paragraph(block.before, block.lines);
    }
    paragraph(between);
    return std::move(text_);
  }

 private:
  const Source& source() const { return document_.source(); }
  std::string_view content(std::uint32_t line) const { return document_.raw(document_.content(line)); }

  bool has_suppression(const Block& block) const {
    return std::any_of(block.before.begin(), block.before.end(), [this](std::string_view line) {
      const auto begin = static_cast<std::uint32_t>(line.data() - source().bytes().data());
      const Span content{begin + 1, begin + static_cast<std::uint32_t>(line.size())};
      return line.substr(0, 1) == ";" && !suppressions_in(source(), content).empty();
    });
  }

  // Writes lines without the empty ones, after an empty line that separates them from the preceding text.
  void paragraph(const std::vector<std::string_view>& lines, const std::vector<std::string>& more = {}) {
    bool is_first = true;
    const auto put = [&](std::string_view line) {
      if (line.empty()) {
        return;
      }
      const bool begins_with_mark = text_.empty() && mark_size(line) != 0;  // it would become the mark of the file
      if (begins_with_mark || (is_first && text_.size() > mark_size(text_))) {
        text_ += document_.line_end();
      }
      is_first = false;
      text_ += line;
      text_ += document_.line_end();
    };
    std::for_each(lines.begin(), lines.end(), put);
    std::for_each(more.begin(), more.end(), put);
  }

  // Reads the lines of a section into its block. Lines behind its last key are returned in `behind`, for the next
  // section.
  void read(Block& block, std::vector<std::string_view>& behind) const {
    const Section& section = *block.section;
    const std::uint32_t last = document_.last_line(section);
    block.lines.push_back(header_line(block));
    auto key = section.keys.begin();
    for (std::uint32_t line = section.line + 1; line <= last; ++line) {
      const bool is_key = key != section.keys.end() && key->line == line;
      block.lines.push_back(is_key ? key_line(block, *key++) : std::string(content(line)));
    }
    for (std::uint32_t line = last + 1; line < section.end; ++line) {
      behind.push_back(content(line));
    }
  }

  std::string header_line(const Block& block) const {
    const std::string_view text = content(block.section->line);
    const std::string name = text_of(block.name);
    const bool is_plain = text.find(']') + 1 == text.size();
    return is_plain && !name.empty() ? "[" + name + "]" : std::string(text);
  }

  std::string key_line(const Block& block, const Key& key) const {
    const std::string_view name = document_.raw(key.name);
    const std::string_view standard = standard_key(block.name, name);
    return fmt::format("{}={}", standard.empty() ? name : standard, key.is_duplicate ? raw(key) : value_of(block, key));
  }
  std::string raw(const Key& key) const { return std::string(document_.raw(key.value)); }

  std::string value_of(const Block& block, const Key& key) const {
    const std::string_view name = document_.raw(key.name);
    const ListForm list = list_form(block.name);
    if (!list.count.empty()) {
      std::uint32_t number = 0;
      return compare_names(name, list.count) == 0 ? counted(key, entries_of(document_, *block.section, list))
             : list.has_indexes && number_of(name, "", number) ? hexadecimal(raw(key), 4)
                                                               : raw(key);
    }
    const bool is_object = block.name.kind == SectionKind::object;
    if (!is_object && block.name.kind != SectionKind::sub) {
      return raw(key);
    }
    if (is_object && compare_names(name, "SubNumber") == 0) {
      const auto subs = subs_.find(block.name.index);
      return subs == subs_.end() || is_compact(*block.section) ? raw(key) : counted(key, subs->second.size());
    }
    return value_of_entry(*block.section, name, raw(key));
  }

  std::string value_of_entry(const Section& section, std::string_view name, const std::string& text) const {
    if (compare_names(name, "DataType") == 0) {
      return hexadecimal(text, 4);
    }
    if (compare_names(name, "ObjectType") == 0) {
      return hexadecimal(text, 1);
    }
    if (compare_names(name, "AccessType") == 0) {
      const Access access = access_named(text);
      return access == Access::unknown || access == Access::none ? text : std::string(name_of(access));
    }
    const bool is_value = is_any_of(name, {"DefaultValue", "ParameterValue", "LowLimit", "HighLimit"});
    return is_value && is_of_numbers(section) ? with_node_id(with_small_x(text)) : text;
  }

  // Returns whether values may depend on the node-ID. $NODEID in a string is a part of the string.
  bool is_of_numbers(const Section& section) const {
    const Key* const key = document_.find(section, "DataType");
    const ParsedInteger code = parse_integer(key != nullptr ? document_.raw(key->value) : std::string_view());
    return !code.is_number() || (fits_unsigned(code.value, 16) &&
                                 is_integer(data_type(static_cast<std::uint16_t>(code.value.magnitude)).kind));
  }

  bool is_compact(const Section& section) const {
    const Key* const key = document_.find(section, "CompactSubObj");
    return key != nullptr && !key->value.is_empty();
  }

  // Returns the text of a count: unchanged if it is correct, else the number of entries.
  std::string counted(const Key& key, std::size_t number) const {
    const ParsedInteger given = parse_integer(document_.raw(key.value));
    const bool is_right = given.is_number() && given.value == Integer(number);
    return is_right ? raw(key) : std::to_string(number);
  }

  const Document& document_;
  std::map<std::uint16_t, std::set<std::uint8_t>> subs_;
  std::string text_;
};

}  // namespace

std::string formatted(const Document& document) { return Formatter(document).run(); }

}  // namespace lexican::codict::eds
