// SPDX-License-Identifier: Apache-2.0
// Which variables lie together, in which order, and which sub-index of 1010h stores them.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "gen/names.hpp"
#include "gen/parts.hpp"
#include "gen/rules.hpp"
#include "model/access.hpp"

namespace lexican::codict::gen {

namespace {

constexpr std::uint8_t address_size = 4;

// Strings have a NUL behind them, whatever their length.
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
  member.name = item.member + "_memory";
  return member;
}

Member descriptor_of(const Item& item) {
  Member member;
  member.role = Role::descriptor;
  member.alignment = address_size;
  member.name = item.member;
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
  member.type = item.storage == Storage::consumer ? "uint32_t" : std::string(item.form->variable);
  member.name = item.member;
  member.size = item.form->size;
  member.alignment = item.form->alignment;
  member.has_alias = true;
  return member;
}

// What an entry needs in a group that is stored: no addresses.
std::vector<Member> stored_members(const Item& item) {
  if (item.storage != Storage::string && item.storage != Storage::domain) {
    return {variable_of(item)};
  }
  Member memory = memory_of(item);
  memory.name = item.member;
  memory.has_alias = true;
  if (item.storage == Storage::domain) {
    return {memory};
  }
  Member length;
  length.role = Role::length;
  length.type = "uint32_t";
  length.name = item.member + "_length";
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
      // A constant one has its memory beside the structs.
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

// FNV-1a, folded to the 24 bits that CO_PARA_VERSION() takes.
std::uint32_t hash(const Plan& plan, const Group& group) {
  std::uint32_t state = 0x811C9DC5;
  const auto take = [&state](std::uint32_t number) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
      state = (state ^ (number >> shift & 0xFFU)) * 0x01000193U;
    }
  };
  for (const Member& member : group.members) {
    const Item& item = plan.items[member.item];
    take(item.key() | static_cast<std::uint32_t>(member.role));
    take(item.form->code);
    take(member.size);
  }
  return (state >> 24 ^ state) & 0x00FFFFFFU;
}

bool is_communication(const Item& item) { return item.index >= 0x1000 && item.index <= 0x1FFF; }

constexpr std::uint32_t rounded_up(std::uint32_t size, std::uint32_t unit) { return (size + unit - 1) / unit * unit; }

// Numbers of 64 bits, then addresses, which have 32 or 64 bits, then all others: no padding is between them on any CPU.
unsigned rank_of(const Member& member) {
  return member.role == Role::descriptor ? address_size + 1U : member.alignment;
}

// First what the network only reads, then what reset node sets, last what both resets set: a reset copies all from a
// member on. The middle part ascends in alignment, so that there is little padding between the parts.
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

// Objects of the communication profile first, as reset communication loads these and no others; within both parts the
// larger alignment first. Nothing lies between two members but bytes that have a name.
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

bool has_word(const std::string& id, const char* word) { return id.find(word) != std::string::npos; }

bool is_for_communication(const Group& group) { return has_word(group.id, "comm") || group.is_communication; }

// 2: communication, 3: application, 4…: the manufacturer's. [301:7.5.2.13]
class StoreSubs {
 public:
  explicit StoreSubs(const Plan& plan) {
    for (const Item& item : plan.items) {
      if (item.index == 0x1010 && item.sub_index != 0 && item.place != nullptr) {
        subs_.insert(item.sub_index);
      }
    }
    has_all_ = subs_.size() > 1;
  }

  bool has_all() const { return has_all_; }  ///< sub 1 is none of a group
  bool has_any() const { return !subs_.empty(); }

  std::uint8_t take(const Group& group) {
    if (!has_all()) {
      return take_from(1);
    }
    const std::uint8_t wanted = is_for_communication(group) ? 2 : (has_word(group.id, "app") ? 3 : 4);
    const std::uint8_t taken = take_from(wanted);
    return taken != 0 || wanted == 4 ? taken : take_from(4);
  }

 private:
  // Only the manufacturer's may be any of several.
  std::uint8_t take_from(std::uint8_t first) {
    const auto place = first < 4 ? subs_.find(first) : subs_.lower_bound(first);
    if (place == subs_.end()) {
      return 0;
    }
    const std::uint8_t sub_index = *place;
    subs_.erase(place);
    return sub_index;
  }

  bool has_all_ = false;
  std::set<std::uint8_t> subs_;
};

void assign_subs(Plan& plan, Findings& findings) {
  StoreSubs subs(plan);
  plan.stores_all = subs.has_all();
  if (!subs.has_any()) {
    return;
  }
  for (std::size_t n = 1; n < plan.groups.size(); ++n) {
    Group& group = plan.groups[n];
    group.sub_index = subs.take(group);
    if (group.sub_index == 0) {
      findings.add(rules::store, plan.items[group.members.front().item].span,
                   fmt::format("1010h has no sub-index left for the storage group {}", group.name));
    }
  }
}

// "save" with the one sub-index that there is must save all.
void join_groups(Plan& plan, Findings& findings) {
  const StoreSubs subs(plan);
  if (!subs.has_any() || subs.has_all()) {
    return;
  }
  std::size_t joined = 1;
  for (Item& item : plan.items) {
    if (item.group > joined) {
      joined = item.group;
      findings.add(rules::store_joined, item.span,
                   fmt::format("1010h has one sub-index: the storage group {} is a part of {}",
                               plan.groups[item.group].name, plan.groups[1].name));
    }
    item.group = std::min<std::size_t>(item.group, 1);
  }
  plan.groups.resize(std::min<std::size_t>(plan.groups.size(), 2));
}

void tell_of_unused_subs(const Plan& plan, Findings& findings) {
  for (const Item& item : plan.items) {
    const bool is_store = item.index == 0x1010 && item.storage == Storage::group;
    const bool is_used = (item.sub_index == 1 && plan.stores_all) ||
                         std::any_of(plan.groups.begin(), plan.groups.end(),
                                     [&](const Group& group) { return group.sub_index == item.sub_index; });
    if (is_store && !is_used) {
      findings.add(rules::store_unused, item.span, "there is no storage group for it: \"save\" is refused");
    }
  }
  if (plan.groups.size() > 1 && plan.find(0x1010, 1) == nullptr) {
    findings.add(rules::store_unused, {}, "there are storage groups and no 1010h: nothing loads or stores them");
  }
}

}  // namespace

// The stack writes 1003h: it empties it at reset node.
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

void plan_groups(Plan& plan, Findings& findings) {
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
      findings.add(rules::name, {}, fmt::format("the storage group {} has the name of another one", group.name));
    }
  }
  assign_subs(plan, findings);
  tell_of_unused_subs(plan, findings);
}

}  // namespace lexican::codict::gen
