// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diff/diff.hpp"
#include "diff/recorder.hpp"

namespace lexican::codict::diff {

namespace {

Text shown(std::string_view text, Span span) {
  Text result;
  result.text = text;
  result.span = span;
  return result;
}

void remove(std::string_view what, const Entry& entry, const Recorder& recorder) {
  recorder.add(Kind::breaking, what, shown(entry.name.text, entry.span), Text());
}

void add(std::string_view what, const Entry& entry, const Recorder& recorder) {
  recorder.add(Kind::compatible, what, Text(), shown(entry.name.text, entry.span));
}

// Compares two sorted lists: calls gone() or come() for elements of one list only, both() for pairs.
template <typename Element, typename KeyOf, typename Gone, typename Come, typename Both>
void merge(const std::vector<Element>& before, const std::vector<Element>& after, KeyOf key_of, Gone gone, Come come,
           Both both) {
  auto old_one = before.begin();
  auto new_one = after.begin();
  while (old_one != before.end() || new_one != after.end()) {
    if (new_one == after.end() || (old_one != before.end() && key_of(*old_one) < key_of(*new_one))) {
      gone(*old_one++);
    } else if (old_one == before.end() || key_of(*new_one) < key_of(*old_one)) {
      come(*new_one++);
    } else {
      both(*old_one++, *new_one++);
    }
  }
}

Place place_of(std::uint16_t index) {
  Place place;
  place.index = index;
  return place;
}

Place place_of(std::uint16_t index, std::uint8_t sub_index) {
  Place place = place_of(index);
  place.sub_index = sub_index;
  place.has_sub_index = true;
  return place;
}

void compare_subs(const Object& before, const Object& after, const Recorder& recorder) {
  const auto at = [&](const Sub& sub) { return recorder.at(place_of(before.index, sub.sub_index)); };
  merge(
      before.subs, after.subs, [](const Sub& sub) { return sub.sub_index; },
      [&](const Sub& sub) { remove("sub-object", sub, at(sub)); },
      [&](const Sub& sub) { add("sub-object", sub, at(sub)); },
      [&](const Sub& old_sub, const Sub& new_sub) { compare_entries(old_sub, new_sub, at(old_sub)); });
}

void compare_objects(const std::vector<Object>& before, const std::vector<Object>& after, const Recorder& recorder) {
  const auto at = [&](const Object& object) { return recorder.at(place_of(object.index)); };
  merge(
      before, after, [](const Object& object) { return object.index; },
      [&](const Object& object) { remove("object", object, at(object)); },
      [&](const Object& object) { add("object", object, at(object)); },
      [&](const Object& old_object, const Object& new_object) {
        compare_entries(old_object, new_object, at(old_object));
        compare_subs(old_object, new_object, recorder);
      });
}

// Compares the modules of a bus coupler and their objects.
void compare_modules(const Device& before, const Device& after, const Recorder& recorder) {
  const auto at = [&](const Module& module) {
    Recorder of_module = recorder;
    of_module.place.module = std::to_string(module.number);
    return of_module;
  };
  merge(
      before.modules, after.modules, [](const Module& module) { return module.number; },
      [&](const Module& module) { at(module).add(Kind::breaking, "module", module.product_name, Text()); },
      [&](const Module& module) { at(module).add(Kind::compatible, "module", Text(), module.product_name); },
      [&](const Module& old_module, const Module& new_module) {
        at(old_module).text(Kind::text, "product name", old_module.product_name, new_module.product_name);
        at(old_module).text(Kind::text, "order code", old_module.order_code, new_module.order_code);
        compare_objects(old_module.fixed, new_module.fixed, at(old_module));
      });
}

std::uint32_t major_revision(const Device& device) {
  const Entry* const entry = device.find(0x1018, 3);
  const bool has_default = entry != nullptr && entry->default_value.is_integer();
  const std::uint64_t revision =
      has_default ? entry->default_value.integer.bits() : device.identity.revision_number.value;
  return static_cast<std::uint32_t>(revision) >> 16;
}

}  // namespace

std::string_view name_of(Kind kind) {
  constexpr std::array<std::string_view, 5> names = {"breaking", "compatible", "configuration", "text", "file"};
  return names[static_cast<std::size_t>(kind)];
}

std::string to_string(const Place& place) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  if (place.index != 0) {
    for (int shift = 12; shift >= 0; shift -= 4) {
      text += digits[(place.index >> shift) & 0xF];
    }
    text += 'h';
  }
  if (place.has_sub_index) {
    text += ':';
    if (place.sub_index > 0xF) {
      text += digits[place.sub_index >> 4];
    }
    text += digits[place.sub_index & 0xF];
  }
  if (!place.module.empty()) {
    text = "module " + place.module + (text.empty() ? "" : ", ") + text;
  }
  return text;
}

std::vector<Difference> compare(const Device& before, const Device& after) {
  std::vector<Difference> differences;
  const Recorder recorder{differences, before, after, {}};
  compare_headers(recorder);
  compare_objects(before.objects, after.objects, recorder);
  compare_modules(before, after, recorder);
  return differences;
}

std::size_t count(const std::vector<Difference>& differences, Kind kind) {
  return static_cast<std::size_t>(
      std::count_if(differences.begin(), differences.end(),
                    [kind](const Difference& difference) { return difference.kind == kind; }));
}

bool is_announced(const Device& before, const Device& after, const std::vector<Difference>& differences) {
  return count(differences, Kind::breaking) == 0 || major_revision(after) > major_revision(before);
}

}  // namespace lexican::codict::diff
