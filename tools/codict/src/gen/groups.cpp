// SPDX-License-Identifier: Apache-2.0
// Members of the structs, and their order in memory.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "gen/names.hpp"
#include "gen/parts.hpp"
#include "gen/rules.hpp"
#include "gen/stores.hpp"
#include "model/access.hpp"

namespace lexican::codict::gen {

namespace {

constexpr std::uint8_t address_size = 4;

// Returns the number of array elements of a string or domain. Byte strings have an additional NUL.
std::uint32_t array_length(const Item& item) {
  const bool is_wide = item.form->alignment == 2;
  return is_wide ? item.capacity / 2 : item.capacity + (item.storage == Storage::string ? 1 : 0);
}

Member memory_of(const Item& item) {
  Member member;
  const bool is_wide = item.form->alignment == 2;
  member.role = Role::memory;
  member.type = is_wide ? "uint16_t" : "uint8_t";
  member.count = array_length(item);
  member.alignment = is_wide ? 2 : 1;
  member.size = member.count * member.alignment;
  member.name = item.member() + "_memory";
  return member;
}

Member descriptor_of(const Item& item) {
  Member member;
  member.role = Role::descriptor;
  member.alignment = address_size;
  member.name = item.member();
  member.has_alias = true;
  switch (item.storage) {
    case Storage::text: member.type = "CO_OBJ_STR", member.size = 8; break;
    case Storage::string: member.type = "CO_OBJ_STR_RW", member.size = 16; break;
    case Storage::domain: member.type = "CO_OBJ_DOM", member.size = 12; break;
    default: member.type = "CO_HBCONS", member.size = 20; break;
  }
  return member;
}

Member variable_of(const Item& item) {
  Member member;
  member.type = item.storage == Storage::consumer ? "uint32_t" : item.form->variable;
  member.name = item.member();
  member.size = item.form->size;
  member.alignment = item.form->alignment;
  member.has_alias = true;
  return member;
}

// Returns the members of an entry in a storage group, which contains no addresses.
std::vector<Member> stored_members(const Item& item) {
  if (item.storage != Storage::string && item.storage != Storage::domain) {
    return {variable_of(item)};
  }
  Member memory = memory_of(item);
  memory.name = item.member();
  memory.has_alias = true;
  if (item.storage == Storage::domain) {
    return {memory};
  }
  Member length;
  length.role = Role::length;
  length.type = "uint32_t";
  length.name = item.member() + "_length";
  length.size = length.alignment = 4;
  return {length, memory};
}

std::vector<Member> plain_members(const Item& item) {
  switch (item.storage) {
    case Storage::variable: return {variable_of(item)};
    case Storage::text:
    case Storage::consumer: return {descriptor_of(item)};
    case Storage::string:
    case Storage::domain:
      // The bytes of a constant string or domain are an array outside the structs.
      if (item.access == Access::constant) {
        return {descriptor_of(item)};
      }
      return {descriptor_of(item), memory_of(item)};
    default: return {};
  }
}

void add(std::vector<Member>& members, std::vector<Member> more, std::size_t item) {
  for (Member& member : more) {
    member.item = item;
    members.push_back(std::move(member));
  }
}

// Returns the FNV-1a hash of a group's layout, folded to the 24 bits of CO_PARA_VERSION().
std::uint32_t hash(const Plan& plan, const Group& group) {
  std::uint32_t state = 0x811C9DC5;
  const auto add_to_hash = [&state](std::uint32_t number) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
      state = (state ^ (number >> shift & 0xFFU)) * 0x01000193U;
    }
  };
  for (const Member& member : group.members) {
    const Item& item = plan.items[member.item];
    add_to_hash(item.key() | static_cast<std::uint32_t>(member.role));
    add_to_hash(item.form->code);
    add_to_hash(member.size);
  }
  return (state >> 24 ^ state) & 0x00FFFFFFU;
}

bool is_communication(const Item& item) { return item.index >= 0x1000 && item.index <= 0x1FFF; }

constexpr std::uint32_t rounded_up(std::uint32_t size, std::uint32_t unit) { return (size + unit - 1) / unit * unit; }

// Returns the sort key of a member: 64-bit numbers, then addresses (32 or 64 bits), then all others by alignment, so
// that no CPU needs padding between them.
unsigned rank_of(const Member& member) {
  return member.role == Role::descriptor ? address_size + 1U : member.alignment;
}

// Orders the RAM by reset: members that the network cannot write, then those of "reset node", then those of both
// resets, so that a reset copies everything from its first member on. The second part ascends in alignment, which
// minimises the padding between the parts.
void lay_out_ram(const Plan& plan, Group& group) {
  std::stable_sort(group.members.begin(), group.members.end(), [&](const Member& a, const Member& b) {
    const Reset first = reset_of(plan.items[a.item]);
    const Reset second = reset_of(plan.items[b.item]);
    if (first != second) {
      return first < second;
    }
    return first == Reset::node ? rank_of(a) < rank_of(b) : rank_of(a) > rank_of(b);
  });
  std::uint32_t alignment = 1;
  for (const Member& member : group.members) {
    group.size = rounded_up(group.size, member.alignment) + member.size;
    alignment = std::max<std::uint32_t>(alignment, member.alignment);
  }
  group.size = rounded_up(group.size, alignment);
}

// Orders a storage group: objects of the communication profile first, because "reset communication" loads only these;
// within both parts by descending alignment. All padding consists of named members.
void lay_out_stored(const Plan& plan, Group& group) {
  const auto is_first = [&](const Member& member) { return is_communication(plan.items[member.item]); };
  std::stable_sort(group.members.begin(), group.members.end(), [&](const Member& a, const Member& b) {
    return is_first(a) != is_first(b) ? is_first(a) : a.alignment > b.alignment;
  });
  std::uint32_t alignment = 1;
  bool is_mixed = false;
  for (Member& member : group.members) {
    is_mixed = is_mixed || (!is_first(member) && is_first(group.members.front()));
    group.com_size = is_mixed && group.com_size == 0 ? group.size : group.com_size;
    member.unused_before = rounded_up(group.size, member.alignment) - group.size;
    group.size += member.unused_before + member.size;
    alignment = std::max<std::uint32_t>(alignment, member.alignment);
  }
  group.is_communication = !is_mixed && is_first(group.members.front());
  group.unused = rounded_up(group.size, alignment) - group.size;
  group.size += group.unused;
  group.layout = hash(plan, group);
}

}  // namespace

// 1003h is excluded because the stack writes it, and clears it at "reset node".
Reset reset_of(const Item& item) {
  if (!is_writable(item.access) || item.index == 0x1003) {
    return Reset::none;
  }
  return is_communication(item) ? Reset::communication : Reset::node;
}

const Member* first_reset(const Plan& plan, Reset reset) {
  const std::vector<Member>& members = plan.groups.front().members;
  const auto first = std::find_if(members.begin(), members.end(),
                                  [&](const Member& member) { return reset_of(plan.items[member.item]) >= reset; });
  return first == members.end() ? nullptr : &*first;
}

bool has_defaults(const Plan& plan) {
  const bool has_unloaded_group =
      std::any_of(plan.groups.begin() + 1, plan.groups.end(), [](const Group& group) { return group.sub_index == 0; });
  return has_unloaded_group || first_reset(plan, Reset::node) != nullptr;
}

void plan_groups(const Options& options, Plan& plan, Findings& findings) {
  join_groups(plan, findings);
  std::set<std::string> ids = {"od", "objects"};
  for (std::size_t n = 0; n < plan.items.size(); ++n) {
    const Item& item = plan.items[n];
    add(plan.groups[item.group].members, item.group == 0 ? plain_members(item) : stored_members(item), n);
  }
  lay_out_ram(plan, plan.groups.front());
  for (Group& group : plan.groups) {
    if (&group != &plan.groups.front()) {
      lay_out_stored(plan, group);
    }
    if (!ids.insert(group.id).second || group.id.empty()) {
      findings.add(rules::name, {},
                   fmt::format("storage group {} has the same name in C as another one", in_quotes(group.name)),
                   "rename one of them");
    }
  }
  plan_stores(plan, options, findings);
}

}  // namespace lexican::codict::gen
