// SPDX-License-Identifier: Apache-2.0
#include "convert/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "eds/fields.hpp"
#include "eds/names.hpp"
#include "eds/numbered.hpp"
#include "model/device.hpp"
#include "text/number.hpp"

namespace lexican::codict::convert {

namespace {

using eds::SectionKind;
using eds::SectionName;

bool is_of_object(const SectionName& name) { return name.kind == SectionKind::object || name.kind == SectionKind::sub; }

// Sort order of sections, which groups those of an object: its own section, its sub-objects, its lists.
using Order = std::tuple<bool, std::uint16_t, SectionKind, std::uint8_t>;
Order order_of(const SectionName& name) { return {!eds::has_index(name), name.index, name.kind, name.sub_index}; }

SectionName object_name(std::uint16_t index) {
  SectionName name;
  name.kind = SectionKind::object;
  name.index = index;
  return name;
}

bool is_one_of(std::string_view key, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [key](std::string_view word) { return eds::compare_names(key, word) == 0; });
}

// Returns true if two values of a key are equal, even if they are written differently.
bool have_same_meaning(std::string_view key, std::string_view a, std::string_view b) {
  if (is_one_of(key, {"ObjectType", "DataType", "PDOMapping", "ObjFlags", "CompactSubObj"})) {
    const ParsedInteger left = parse_integer(a);
    const ParsedInteger right = parse_integer(b);
    return a == b || (left.is_number() && right.is_number() && left.value == right.value);
  }
  const ParsedFormula left = parse_formula(a);
  const ParsedFormula right = parse_formula(b);
  const bool are_formulas =
      left.has_node_id && right.has_node_id && left.number.is_number() && right.number.is_number();
  return a == b || (are_formulas && left.number.value == right.number.value) ||
         (is_one_of(key, {"AccessType"}) && equal_ignoring_case(a, b));
}

class Merger {
 public:
  Merger(const eds::Document& base, const eds::Document& overlay, std::vector<ReplacedValue>& replaced)
      : base_(base), overlay_(overlay), replaced_(replaced), end_(base.line_end()) {
    for (const eds::Section& section : base.sections()) {
      const SectionName name = eds::section_name(base, section);
      if (name.kind == SectionKind::other || section.is_duplicate) {
        continue;
      }
      sections_.emplace(key_of(name), &section);
      if (eds::has_index(name)) {
        by_order_.emplace(order_of(name), &section);
      }
    }
  }

  bool run(std::string& bytes) {
    std::vector<std::pair<SectionName, const eds::Section*>> fresh;
    for (const eds::Section& section : overlay_.sections()) {
      const SectionName name = eds::section_name(overlay_, section);
      if (section.is_duplicate || eds::list_form(name).count == "SupportedObjects") {
        continue;
      }
      const eds::Section* const same = find(name, overlay_.raw(section.name));
      if (same == nullptr && (name.kind != SectionKind::header || !section.keys.empty())) {
        fresh.emplace_back(name, &section);
      } else if (same != nullptr) {
        change(*same, section, name);
      }
    }
    std::stable_sort(fresh.begin(), fresh.end(),
                     [](const auto& a, const auto& b) { return order_of(a.first) < order_of(b.first); });
    for (const auto& [name, section] : fresh) {
      note(name);
    }
    // Counts and lists are edited before new sections are inserted, so that additions to a section precede them.
    count_subs();
    list_objects();
    for (const auto& [name, section] : fresh) {
      add(*section, name);
    }
    bytes = edits_.applied_to(base_.source().bytes());
    return is_possible_;
  }

 private:
  // Key of a section: the word identifies headers and module sections, the index all others.
  using SectionKey = std::tuple<SectionKind, std::uint16_t, std::uint8_t, std::uint16_t, std::string_view, bool>;
  static SectionKey key_of(const SectionName& name) {
    const bool is_other_spelling = name.word == "DeviceCommissioning";
    const std::string_view word = is_other_spelling ? "DeviceComissioning" : name.word;
    return {name.kind, name.index, name.sub_index, name.module, word, name.is_sub};
  }

  const eds::Section* find(const SectionName& name, std::string_view text) const {
    if (name.kind == SectionKind::other) {
      return base_.find(text);
    }
    const auto place = sections_.find(key_of(name));
    return place != sections_.end() ? place->second : nullptr;
  }

  void change(const eds::Section& section, const eds::Section& by, const SectionName& name) {
    const eds::ListForm list = eds::list_form(name);
    const std::string_view count_word = is_of_object(name) ? "SubNumber" : list.count;
    std::vector<const eds::Key*> fresh;  // inserted behind the last key, whose value may change
    std::size_t added = 0;
    for (const eds::Key& key : by.keys) {
      const std::string_view word = overlay_.raw(key.name);
      if (key.is_duplicate || eds::compare_names(word, count_word) == 0) {
        continue;
      }
      const eds::Key* const old = base_.find(section, word);
      const bool says_nothing_yet = old == nullptr || (old->value.is_empty() && list.word.empty());
      added += says_nothing_yet ? 1 : 0;
      if (old != nullptr) {
        replace(section, *old, overlay_.text(key.value));
      } else {
        fresh.push_back(&key);
      }
    }
    if (!list.count.empty() && added != 0) {
      count(section, list.count, eds::entries_of(base_, section, list) + added);
    }
    for (const eds::Key* key : fresh) {
      is_possible_ =
          base_.add_key(section, overlay_.text(key->name), overlay_.text(key->value), edits_) && is_possible_;
    }
    if (is_of_object(name)) {
      change_hidden(section, by, eds::storage_key);
      change_hidden(section, by, eds::trigger_key);
    }
  }

  // Merges a key in a comment.
  void change_hidden(const eds::Section& section, const eds::Section& by, std::string_view name) {
    const std::optional<eds::Key> key = eds::comment_key(overlay_, by, name);
    const std::optional<eds::Key> old = eds::comment_key(base_, section, name);
    if (key && old) {
      replace(section, *old, overlay_.text(key->value));
    } else if (key) {
      is_possible_ = eds::add_comment_key(base_, section, name, overlay_.text(key->value), edits_) && is_possible_;
    }
  }

  void replace(const eds::Section& section, const eds::Key& key, const std::string& text) {
    const std::string before = base_.text(key.value);
    if (!have_same_meaning(base_.raw(key.name), before, text)) {
      replaced_.push_back({base_.text(section.name), base_.text(key.name), before, text});
      is_possible_ = base_.set_value(key, text, edits_) && is_possible_;
    }
  }

  void count(const eds::Section& section, std::string_view word, std::size_t number) {
    const eds::Key* const key = base_.find(section, word);
    const std::string text = std::to_string(number);
    is_possible_ =
        (key != nullptr ? base_.set_value(*key, text, edits_) : base_.add_key(section, word, text, edits_)) &&
        is_possible_;
  }

  // Inserts the lines of a section behind its predecessor in the sort order.
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
  }

  // Records a new section for the update of lists and counts.
  void note(const SectionName& name) {
    if (name.kind == SectionKind::object && name.index >= 0x1000) {  // type definitions are in no list
      added_[list_of(name.index)].push_back(name.index);
    } else if (name.kind == SectionKind::sub && name.sub_index != 0xFF &&
               find(object_name(name.index), {}) != nullptr) {
      ++added_subs_[name.index];
    }
  }

  const eds::Section* section_before(const SectionName& name) const {
    const auto behind = by_order_.lower_bound(order_of(name));
    return eds::has_index(name) && behind != by_order_.begin() ? std::prev(behind)->second : nullptr;
  }

  std::uint32_t end_of(const eds::Section& section) const { return base_.source().line(base_.last_line(section)).end; }

  std::uint32_t end_of_text() const {
    const std::string_view bytes = base_.source().bytes();
    const std::size_t last = bytes.find_last_not_of(" \t\r\n");
    return last == std::string_view::npos ? 0 : static_cast<std::uint32_t>(last) + 1;
  }

  void count_subs() {
    for (const auto& [index, added] : added_subs_) {
      // SubNumber does not count sub-index FFh.
      const auto first = sections_.lower_bound({SectionKind::sub, index, 0, 0, {}, false});
      const auto subs = std::distance(first, sections_.lower_bound({SectionKind::sub, index, 0xFF, 0, {}, false}));
      count(*find(object_name(index), {}), "SubNumber", static_cast<std::size_t>(subs) + added);
    }
  }

  void list_objects() {
    for (const auto& [kind, indexes] : added_) {
      if (const eds::Section* const list = base_.find(eds::list_name(kind)); list != nullptr) {
        add_to_list(*list, indexes);
      } else {
        add_list(kind, indexes);
      }
    }
  }

  void add_to_list(const eds::Section& list, const std::vector<std::uint16_t>& indexes) {
    const eds::ListForm form{"SupportedObjects", "", true};
    count(list, form.count, eds::entries_of(base_, list, form) + indexes.size());
    std::uint32_t number = eds::last_number(base_, list, form);
    for (const std::uint16_t index : indexes) {
      is_possible_ =
          base_.add_key(list, std::to_string(++number), fmt::format("0x{:04X}", index), edits_) && is_possible_;
    }
  }

  void add_list(ListKind kind, const std::vector<std::uint16_t>& indexes) {
    std::string text = fmt::format("{0}{0}[{1}]{0}SupportedObjects={2}", end_, eds::list_name(kind), indexes.size());
    std::size_t number = 0;
    for (const std::uint16_t index : indexes) {
      text += fmt::format("{}{}=0x{:04X}", end_, ++number, index);
    }
    edits_.insert(end_of_text(), text);
  }

  const eds::Document& base_;
  const eds::Document& overlay_;
  std::vector<ReplacedValue>& replaced_;
  std::string end_;
  std::map<SectionKey, const eds::Section*> sections_;
  std::map<Order, const eds::Section*> by_order_;
  std::map<ListKind, std::vector<std::uint16_t>> added_;
  std::map<std::uint16_t, std::size_t> added_subs_;
  Edits edits_;
  bool is_possible_ = true;
};

}  // namespace

bool ReplacedValue::is_definition() const {
  return is_one_of(key, {"ObjectType", "DataType", "AccessType", "PDOMapping"});
}

bool merge(const eds::Document& base, const eds::Document& overlay, std::string& bytes,
           std::vector<ReplacedValue>& replaced) {
  return Merger(base, overlay, replaced).run(bytes);
}

}  // namespace lexican::codict::convert
