// SPDX-License-Identifier: Apache-2.0
#include "convert/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "eds/fields.hpp"
#include "eds/names.hpp"
#include "model/device.hpp"
#include "text/number.hpp"

namespace lexican::codict::convert {

namespace {

using eds::SectionKind;
using eds::SectionName;

std::string_view list_name(ListKind kind) {
  constexpr std::array<std::string_view, 3> names = {"MandatoryObjects", "OptionalObjects", "ManufacturerObjects"};
  return names[static_cast<std::size_t>(kind)];
}

bool is_object_list(const SectionName& name) {
  return name.kind == SectionKind::header && name.word.size() > 7 &&
         name.word.substr(name.word.size() - 7) == "Objects";
}

bool is_of_object(const SectionName& name) { return name.kind == SectionKind::object || name.kind == SectionKind::sub; }

bool is_numbered(SectionKind kind) {
  return kind == SectionKind::names || kind == SectionKind::values || kind == SectionKind::denotations;
}

bool has_index(const SectionName& name) { return name.kind >= SectionKind::object && name.kind <= SectionKind::links; }

// Sections of one object stand together: its own one, its sub-objects, and lists.
using Order = std::tuple<bool, std::uint16_t, SectionKind, std::uint8_t>;
Order order_of(const SectionName& name) { return {!has_index(name), name.index, name.kind, name.sub_index}; }

SectionName object_name(std::uint16_t index) {
  SectionName name;
  name.kind = SectionKind::object;
  name.index = index;
  return name;
}

bool have_same_meaning(std::string_view a, std::string_view b) {
  const ParsedFormula left = parse_formula(a);
  const ParsedFormula right = parse_formula(b);
  return a == b || (left.number.is_number() && right.number.is_number() && left.number.value == right.number.value &&
                    left.has_node_id == right.has_node_id);
}

class Merger {
 public:
  Merger(const eds::Document& base, const eds::Document& overlay, std::vector<Replaced>& replaced)
      : base_(base), overlay_(overlay), replaced_(replaced), end_(base.line_end()) {
    for (const eds::Section& section : base.sections()) {
      const SectionName name = eds::section_name(base.raw(section.name));
      if (name.kind == SectionKind::other || section.is_duplicate) {
        continue;
      }
      sections_.emplace(key_of(name), &section);
      if (has_index(name)) {
        by_order_.emplace(order_of(name), &section);
      }
    }
  }

  bool run(std::string& bytes) {
    std::vector<std::pair<SectionName, const eds::Section*>> fresh;
    for (const eds::Section& section : overlay_.sections()) {
      const SectionName name = eds::section_name(overlay_.raw(section.name));
      if (section.is_duplicate || is_object_list(name)) {
        continue;
      }
      const eds::Section* const same = find(name, overlay_.raw(section.name));
      if (same == nullptr) {
        fresh.emplace_back(name, &section);
      } else {
        change(*same, section, name);
      }
    }
    std::stable_sort(fresh.begin(), fresh.end(),
                     [](const auto& a, const auto& b) { return order_of(a.first) < order_of(b.first); });
    for (const auto& [name, section] : fresh) {
      add(*section, name);
    }
    count_subs();
    list_objects();
    bytes = edits_.applied_to(base_.source().bytes());
    return is_possible_;
  }

 private:
  // Module sections and headers have their words; all others are of an index.
  using SectionKey = std::tuple<SectionKind, std::uint16_t, std::uint8_t, std::uint16_t, std::string_view, bool>;
  static SectionKey key_of(const SectionName& name) {
    return {name.kind, name.index, name.sub_index, name.module, name.word, name.is_sub};
  }

  const eds::Section* find(const SectionName& name, std::string_view text) const {
    if (name.kind == SectionKind::other) {
      return base_.find(text);
    }
    const auto place = sections_.find(key_of(name));
    return place != sections_.end() ? place->second : nullptr;
  }

  void change(const eds::Section& section, const eds::Section& by, const SectionName& name) {
    std::vector<const eds::Key*> fresh;  // behind the last key, whose value may change
    for (const eds::Key& key : by.keys) {
      const std::string_view word = overlay_.raw(key.name);
      const std::string_view count_word = is_numbered(name.kind) ? "NrOfEntries"
                                          : is_of_object(name)   ? "SubNumber"
                                                                 : "";
      if (key.is_duplicate || eds::compare_names(word, count_word) == 0) {
        continue;
      }
      if (const eds::Key* const old = base_.find(section, word); old != nullptr) {
        replace(section, *old, overlay_.text(key.value));
      } else {
        fresh.push_back(&key);
      }
    }
    if (is_numbered(name.kind) && !fresh.empty()) {
      count(section, "NrOfEntries", entries_of(section) + fresh.size());
    }
    for (const eds::Key* key : fresh) {
      is_possible_ =
          base_.add_key(section, overlay_.text(key->name), overlay_.text(key->value), edits_) && is_possible_;
    }
  }

  void replace(const eds::Section& section, const eds::Key& key, const std::string& text) {
    const std::string before = base_.text(key.value);
    if (!have_same_meaning(before, text)) {
      replaced_.push_back({base_.text(section.name), base_.text(key.name), before, text});
      is_possible_ = base_.set_value(key, text, edits_) && is_possible_;
    }
  }

  // Entries that are numbered.
  std::size_t entries_of(const eds::Section& section) const {
    return static_cast<std::size_t>(
        std::count_if(section.keys.begin(), section.keys.end(), [this](const eds::Key& key) {
          std::uint32_t number = 0;
          return eds::number_of(base_.raw(key.name), "", number) && !key.value.is_empty();
        }));
  }

  void count(const eds::Section& section, std::string_view word, std::size_t number) {
    const eds::Key* const key = base_.find(section, word);
    const std::string text = std::to_string(number);
    is_possible_ =
        (key != nullptr ? base_.set_value(*key, text, edits_) : base_.add_key(section, word, text, edits_)) &&
        is_possible_;
  }

  // The lines of a section, behind the one that it follows.
  void add(const eds::Section& section, const SectionName& name) {
    std::uint32_t last = section.end - 1;
    while (last > section.line && trimmed(overlay_.raw(overlay_.source().line(last))).empty()) {
      --last;
    }
    std::string lines = end_;
    for (std::uint32_t line = section.line; line <= last; ++line) {
      std::string bytes;
      is_possible_ = base_.to_source(trimmed(overlay_.text(overlay_.source().line(line))), bytes) && is_possible_;
      lines += end_ + bytes;
    }
    const eds::Section* const before = section_before(name);
    const std::uint32_t at = before != nullptr ? end_of(*before) : end_of_text();
    edits_.insert(at, lines);
    if (name.kind == SectionKind::object && name.index >= 0x1000) {  // lists do not reach types
      added_[list_of(name.index)].push_back(name.index);
    } else if (name.kind == SectionKind::sub && find(object_name(name.index), {}) != nullptr) {
      ++added_subs_[name.index];
    }
  }

  const eds::Section* section_before(const SectionName& name) const {
    const auto behind = by_order_.lower_bound(order_of(name));
    return has_index(name) && behind != by_order_.begin() ? std::prev(behind)->second : nullptr;
  }

  std::uint32_t end_of(const eds::Section& section) const { return base_.source().line(base_.last_line(section)).end; }

  std::uint32_t end_of_text() const {
    const std::string_view bytes = base_.source().bytes();
    const std::size_t last = bytes.find_last_not_of(" \t\r\n");
    return last == std::string_view::npos ? 0 : static_cast<std::uint32_t>(last) + 1;
  }

  void count_subs() {
    for (const auto& [index, added] : added_subs_) {
      const auto subs = std::count_if(sections_.begin(), sections_.end(), [index = index](const auto& each) {
        return std::get<0>(each.first) == SectionKind::sub && std::get<1>(each.first) == index &&
               std::get<2>(each.first) != 0xFF;
      });
      count(*find(object_name(index), {}), "SubNumber", static_cast<std::size_t>(subs) + added);
    }
  }

  void list_objects() {
    for (const auto& [kind, indexes] : added_) {
      if (const eds::Section* const list = base_.find(list_name(kind)); list != nullptr) {
        add_to_list(*list, indexes);
      } else {
        add_list(kind, indexes);
      }
    }
  }

  void add_to_list(const eds::Section& list, const std::vector<std::uint16_t>& indexes) {
    std::size_t number = entries_of(list);
    count(list, "SupportedObjects", number + indexes.size());
    for (const std::uint16_t index : indexes) {
      is_possible_ =
          base_.add_key(list, std::to_string(++number), fmt::format("0x{:04X}", index), edits_) && is_possible_;
    }
  }

  void add_list(ListKind kind, const std::vector<std::uint16_t>& indexes) {
    std::string text = fmt::format("{0}{0}[{1}]{0}SupportedObjects={2}", end_, list_name(kind), indexes.size());
    std::size_t number = 0;
    for (const std::uint16_t index : indexes) {
      text += fmt::format("{}{}=0x{:04X}", end_, ++number, index);
    }
    edits_.insert(end_of_text(), text);
  }

  const eds::Document& base_;
  const eds::Document& overlay_;
  std::vector<Replaced>& replaced_;
  std::string end_;
  std::map<SectionKey, const eds::Section*> sections_;
  std::map<Order, const eds::Section*> by_order_;
  std::map<ListKind, std::vector<std::uint16_t>> added_;
  std::map<std::uint16_t, std::size_t> added_subs_;
  Edits edits_;
  bool is_possible_ = true;
};

}  // namespace

bool Replaced::is_definition() const {
  constexpr std::array<std::string_view, 4> keys = {"ObjectType", "DataType", "AccessType", "PDOMapping"};
  return std::any_of(keys.begin(), keys.end(),
                     [this](std::string_view word) { return eds::compare_names(key, word) == 0; });
}

bool merge(const eds::Document& base, const eds::Document& overlay, std::string& bytes,
           std::vector<Replaced>& replaced) {
  return Merger(base, overlay, replaced).run(bytes);
}

}  // namespace lexican::codict::convert
