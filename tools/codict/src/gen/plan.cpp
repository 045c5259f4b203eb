// SPDX-License-Identifier: Apache-2.0
#include "gen/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "gen/names.hpp"
#include "gen/parts.hpp"
#include "gen/rules.hpp"

namespace lexican::codict::gen {

namespace {

std::string suffix_of(const Item& item) { return fmt::format("{:04X}_{:X}", item.index, item.sub_index); }

bool begins_with(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

// Returns true if an alias could equal a generated name of the dictionary or of a group.
bool could_be_made(const Plan& plan, const std::string& alias) {
  const auto is_of_group = [&](const Group& group) { return begins_with(alias, group.id + "_"); };
  return begins_with(alias, "od_") || begins_with(alias, "para_") || alias == "unused" ||
         std::any_of(plan.groups.begin(), plan.groups.end(), is_of_group);
}

// Returns the first other item with the same alias for each item; null if there is none.
std::vector<const Item*> others_of_aliases(const Plan& plan) {
  std::unordered_map<std::string_view, std::pair<const Item*, const Item*>> uses;  // first and second item
  for (const Item& item : plan.items) {
    auto& [first, second] = uses[item.alias];
    if (first == nullptr) {
      first = &item;
    } else if (second == nullptr) {
      second = &item;
    }
  }
  std::vector<const Item*> others;
  others.reserve(plan.items.size());
  for (const Item& item : plan.items) {
    const auto& [first, second] = uses[item.alias];
    others.push_back(first == &item ? second : first);
  }
  return others;
}

}  // namespace

std::string Item::member() const { return "od_" + suffix_of(*this); }

const Item* Plan::find(std::uint16_t index, std::uint8_t sub_index) const {
  const std::uint32_t key = std::uint32_t{index} << 16 | std::uint32_t{sub_index} << 8;
  const auto place = std::lower_bound(items.begin(), items.end(), key,
                                      [](const Item& item, std::uint32_t wanted) { return item.key() < wanted; });
  return place != items.end() && place->key() == key ? &*place : nullptr;
}

std::string place_name(const Item& item) { return fmt::format("{:04X}h sub {:X}", item.index, item.sub_index); }

void plan_names(const Options& options, Plan& plan, Findings& findings) {
  for (Item& item : plan.items) {
    item.alias = identifier(item.name);
  }
  const std::vector<const Item*> others = others_of_aliases(plan);
  std::unordered_map<std::string_view, const Item*> owners;
  for (Item& item : plan.items) {
    const Item* const other = others[static_cast<std::size_t>(&item - plan.items.data())];
    if (item.alias.empty()) {
      continue;
    }
    if (other != nullptr && options.unique_names) {
      findings.add(rules::name, item.span,
                   fmt::format("name {} is also that of {}", in_quotes(item.alias), place_name(*other)),
                   "rename one of them, or omit --unique-names");
    } else if (other != nullptr) {
      findings.add(rules::name_shared, item.span,
                   fmt::format("name {} is shared; the index is appended", in_quotes(item.alias)),
                   "give the entries different names");
    }
    if (other != nullptr || could_be_made(plan, item.alias)) {
      item.alias += "_" + identifier("x" + suffix_of(item)).substr(1);
    }
    const auto [owner, is_new] = owners.emplace(item.alias, &item);
    if (!is_new) {
      findings.add(rules::name, item.span,
                   fmt::format("name {} is also that of {}", in_quotes(item.alias), place_name(*owner->second)),
                   "rename one of them");
    }
  }
}

void plan_limited_types(Plan& plan) {
  std::unordered_map<std::string, std::size_t> numbers;
  for (Item& item : plan.items) {
    if (item.is_limited()) {
      const std::string what =
          fmt::format("{} {:02X} {} {}", item.type, item.form->code, item.limits->low, item.limits->high);
      item.limited = numbers.emplace(what, numbers.size() + 1).first->second;
    }
  }
}

Plan make_plan(const Device& device, const Options& options, Findings& findings) {
  Plan plan;
  plan.groups.emplace_back();
  plan.groups.front().name = "RAM";
  plan.groups.front().id = "ram";
  plan_items(device, options, plan, findings);
  const bool has_reason = findings.count(Severity::error) != 0;
  if ((plan.entries == 0 && !has_reason) || plan.entries > most_items) {
    findings.add(rules::count, {}, fmt::format("dictionary has {} entries, not 1 to {}", plan.entries, most_items),
                 "describe other objects");
  }
  plan_srdos(plan, findings);
  plan_names(options, plan, findings);
  plan_groups(options, plan, findings);
  plan_limited_types(plan);
  plan_pdos(plan, findings);
  return plan;
}

}  // namespace lexican::codict::gen
