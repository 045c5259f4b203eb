// SPDX-License-Identifier: Apache-2.0
// Costs of a dictionary in bytes, on a CPU with 32-bit addresses.
#include <algorithm>

#include "gen/write.hpp"

namespace lexican::codict::gen {

namespace {

constexpr unsigned address_bytes = 4;
constexpr unsigned entry_bytes = 3 * address_bytes;
constexpr unsigned type_bytes = 5 * address_bytes;
constexpr unsigned para_bytes = 9 * address_bytes;
// Sizes measured on Cortex-M0+ with -Os.
constexpr unsigned word_limit_functions = 250;
constexpr unsigned wide_limit_functions = 300;
constexpr unsigned stored_functions = 150;
constexpr unsigned power_on_functions = 60;

Cost cost_of(const Group& group) {
  Cost cost;
  cost.part = group.name;
  cost.ram = group.size;
  cost.flash = group.size;  // the default values
  // Counts each entry once: only one member of an entry has an alias.
  for (const Member& member : group.members) {
    cost.items += member.has_alias ? 1U : 0U;
  }
  return cost;
}

// Returns the bytes that a stored string, domain or consumer needs outside the struct of its group, in RAM and in
// flash.
unsigned beside(const Item& item) {
  if (item.group == 0) {
    return 0;
  }
  switch (item.storage) {
    case Storage::string: return 6 * address_bytes;
    case Storage::domain: return 3 * address_bytes;
    case Storage::consumer: return 6 * address_bytes;
    default: return 0;
  }
}

// Returns the bytes of a CO_OBJ_DOM_RO or CO_EMCY_BITS, in RAM and in flash.
unsigned descriptor_bytes(const Item& item) {
  return item.storage == Storage::eds ? 3 * address_bytes : item.storage == Storage::error_bits ? 2 * address_bytes : 0;
}

Cost cost_of_limits(const Plan& plan) {
  Cost cost;
  cost.part = "limits";
  std::size_t highest = 0;
  bool has_words = false;
  bool has_wide = false;
  for (const Item& item : plan.items) {
    const bool is_wide = item.form->size > 4;
    cost.items += item.limited != 0 ? 1U : 0U;
    has_words = has_words || (item.limited != 0 && !is_wide);
    has_wide = has_wide || (item.limited != 0 && is_wide);
    if (item.limited > highest) {
      cost.flash += type_bytes + address_bytes + (is_wide ? 24U : 12U);
      highest = item.limited;
    }
  }
  cost.flash += (has_words ? word_limit_functions : 0U) + (has_wide ? wide_limit_functions : 0U);
  return cost;
}

// Returns the cost of the end mark, its type, and the function that copies default values.
Cost cost_of_power_on_values(const Plan& plan) {
  Cost cost;
  cost.part = "power-on values";
  if (!has_defaults(plan)) {
    return cost;
  }
  for (const Group& group : plan.groups) {
    cost.items += group.sub_index == 0 ? cost_of(group).items : 0U;
  }
  cost.ram = 1;
  cost.flash = entry_bytes + type_bytes + power_on_functions;
  return cost;
}

Cost cost_of_constants(const Plan& plan) {
  Cost cost;
  cost.part = "constants";
  for (const Item& item : plan.items) {
    const bool is_memory =
        item.access == Access::constant && (item.storage == Storage::string || item.storage == Storage::domain);
    const std::size_t bytes = item.storage == Storage::constant ? item.form->size
                              : item.storage == Storage::text   ? item.value.text.size() + 1
                              : item.storage == Storage::eds    ? plan.eds.size()
                              : is_memory                       ? item.capacity
                                                                : 0U;
    cost.items += bytes != 0 ? 1U : 0U;
    cost.flash += bytes;
  }
  return cost;
}

}  // namespace

std::vector<Cost> costs_of(const Plan& plan) {
  std::vector<Cost> costs;
  Cost types;
  types.part = "stored types";
  for (const Group& group : plan.groups) {
    costs.push_back(cost_of(group));
    costs.back().flash += group.sub_index != 0 ? para_bytes : 0U;
  }
  for (const Item& item : plan.items) {
    costs[item.group].ram += beside(item);
    costs[item.group].flash += beside(item);
    costs.front().ram += descriptor_bytes(item);
    costs.front().flash += descriptor_bytes(item);
    costs.front().items += descriptor_bytes(item) != 0 ? 1U : 0U;
    types.items += beside(item) > 3 * address_bytes ? 1U : 0U;
  }
  types.flash = types.items != 0 ? stored_functions : 0;
  costs.push_back({"table", plan.items.size(), 0, entry_bytes * plan.items.size()});
  costs.push_back(cost_of_power_on_values(plan));
  costs.push_back(cost_of_constants(plan));
  costs.push_back(cost_of_limits(plan));
  costs.push_back(types);
  costs.erase(std::remove_if(costs.begin(), costs.end(), [](const Cost& cost) { return cost.items == 0; }),
              costs.end());
  return costs;
}

}  // namespace lexican::codict::gen
