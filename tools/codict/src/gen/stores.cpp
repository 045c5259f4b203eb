// SPDX-License-Identifier: Apache-2.0
// Assignment of sub-indexes of 1010h (store) and 1011h (restore) to storage groups.
#include "gen/stores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "gen/rules.hpp"

namespace lexican::codict::gen {

namespace {

// Words of names -----------------------------------------------------------------------------------------------------

using Words = std::set<std::string>;

// Words that do not distinguish storage groups.
const Words common_words = {"all",        "and",    "block",   "config",     "configuration", "configurations",
                            "constant",   "data",   "default", "defaults",   "defined",       "eeprom",
                            "entry",      "flash",  "group",   "in",         "index",         "load",
                            "memory",     "non",    "nvm",     "of",         "param",         "parameter",
                            "parameters", "params", "persist", "persistent", "related",       "restore",
                            "save",       "saved",  "set",     "setting",    "settings",      "specific",
                            "storage",    "store",  "stored",  "sub",        "subindex",      "the",
                            "to",         "value",  "values",  "volatile"};

constexpr const char* communication = "communication";
constexpr const char* application = "application";
constexpr const char* manufacturer = "manufacturer";

const std::map<std::string_view, const char*> abbreviations = {{"com", communication},
                                                               {"comm", communication},
                                                               {"communications", communication},
                                                               {"app", application},
                                                               {"appl", application},
                                                               {"applications", application},
                                                               {"testing", "test"},
                                                               {"mfr", manufacturer},
                                                               {"manufacture", manufacturer},
                                                               {"manufacturers", manufacturer},
                                                               {"vendor", manufacturer}};

bool is_upper(char character) { return character >= 'A' && character <= 'Z'; }
bool is_digit(char character) { return character >= '0' && character <= '9'; }
char lower(char character) { return is_upper(character) ? static_cast<char>(character - 'A' + 'a') : character; }

// Bytes outside ASCII count as letters of other alphabets.
bool is_word_character(char character) {
  const char small = lower(character);
  return is_digit(character) || (small >= 'a' && small <= 'z') || static_cast<unsigned char>(character) >= 0x80;
}

void add_word(Words& words, const std::string& word) {
  const bool is_number = std::all_of(word.begin(), word.end(), is_digit);
  if (is_number || common_words.count(word) != 0) {
    return;
  }
  const auto abbreviation = abbreviations.find(word);
  words.insert(abbreviation == abbreviations.end() ? word : abbreviation->second);
}

// Returns the distinguishing words of a name: "application" for "Save PERSIST_APP parameters" and "persistApp".
Words words_of(std::string_view name) {
  Words words;
  std::string word;
  char previous = ' ';
  for (const char character : name) {
    const bool begins_word = is_upper(character) && previous >= 'a' && previous <= 'z';
    if (begins_word || !is_word_character(character)) {
      add_word(words, word);
      word.clear();
    }
    if (is_word_character(character)) {
      word += lower(character);
    }
    previous = character;
  }
  add_word(words, word);
  return words;
}

// Returns true if a text contains a name as a whole word, in any case.
bool has_whole_name(std::string_view text, std::string_view name) {
  const auto is_same = [](char a, char b) { return lower(a) == lower(b); };
  const auto is_outside = [](char character) { return !is_word_character(character) && character != '_'; };
  auto at = text.begin();
  while (!name.empty()) {
    at = std::search(at, text.end(), name.begin(), name.end(), is_same);
    if (at == text.end()) {
      return false;
    }
    const auto end = at + static_cast<std::ptrdiff_t>(name.size());
    if ((at == text.begin() || is_outside(at[-1])) && (end == text.end() || is_outside(*end))) {
      return true;
    }
    ++at;
  }
  return false;
}

// Sub-indexes and groups ---------------------------------------------------------------------------------------------

constexpr std::uint16_t store_index = 0x1010;
constexpr std::uint16_t restore_index = 0x1011;

// Sub-object of 1010h or 1011h.
struct StoreSub {
  std::uint8_t sub_index = 0;
  std::string name;
  Words words;

  // Returns true if the name has no distinguishing words, or only this purpose.
  bool allows(const char* purpose) const { return words.empty() || words == Words{purpose}; }
};

std::vector<StoreSub> places_of(const Plan& plan, std::uint16_t index) {
  std::vector<StoreSub> places;
  for (const Item& item : plan.items) {
    if (item.index == index && item.storage == Storage::group) {
      places.push_back({item.sub_index, item.own_name(), words_of(item.own_name())});
    }
  }
  return places;
}

bool is_for_communication(const Group& group, const Words& words) {
  return words.count(communication) != 0 || group.is_communication;
}

// Returns the purpose of a group in CiA 301, which defines sub-indexes 2, 3 and 4. [301:7.5.2.13]
const char* purpose_of(const Group& group, const Words& words) {
  return is_for_communication(group, words) ? communication
         : words.count(application) != 0    ? application
                                            : manufacturer;
}

bool is_place_of(const char* purpose, const StoreSub& place) {
  const bool has_number = purpose == communication ? place.sub_index == 2
                          : purpose == application ? place.sub_index == 3
                                                   : place.sub_index >= 4;
  return has_number && place.allows(purpose);
}

// Assigns the sub-indexes of one object to groups.
class Assignment {
 public:
  Assignment(const Plan& plan, std::uint16_t index) : plan_(plan), places_(places_of(plan, index)) {
    const auto all =
        std::find_if(places_.begin(), places_.end(), [](const StoreSub& one) { return one.sub_index == 1; });
    has_all_ = places_.size() > 1 && all != places_.end();
    if (has_all_) {
      places_.erase(all);
    }
    for (const Group& group : plan.groups) {
      words_.push_back(words_of(group.name));
    }
    subs_.resize(plan.groups.size());
    failures_.resize(plan.groups.size());
  }

  bool has_all() const { return has_all_; }  ///< sub-index 1 is assigned to all groups
  bool has_only_all() const { return !has_all_ && places_.size() == 1 && places_.front().sub_index == 1; }
  bool has_any() const { return !places_.empty(); }
  std::uint8_t sub_of(std::size_t group) const { return subs_[group]; }
  const std::string& failure_of(std::size_t group) const { return failures_[group]; }  ///< reason; empty: none

  bool set(std::size_t group, std::uint8_t sub_index) {
    const auto place = place_at(sub_index);
    if (place == places_.end()) {
      return false;
    }
    subs_[group] = sub_index;
    places_.erase(place);
    return true;
  }

  void set_by_name() {
    set_where([this](std::size_t n, const StoreSub& place) {
      return !words_[n].empty() && has_whole_name(place.name, plan_.groups[n].name);
    });
    set_where([this](std::size_t n, const StoreSub& place) { return !words_[n].empty() && words_[n] == place.words; });
  }

  // Assigns by purpose: first the groups whose names contain only words of their purpose, then the others.
  void set_by_purpose() {
    for (const bool has_other_words : {false, true}) {
      set_where([&](std::size_t n, const StoreSub& place) {
        const char* const purpose = purpose_of(plan_.groups[n], words_[n]);
        return (words_[n] == Words{purpose} || has_other_words) && is_place_of(purpose, place);
      });
    }
    // Other groups may use a sub-index for manufacturer-defined parameters.
    set_where([this](std::size_t n, const StoreSub& place) {
      return words_[n].size() > 1 && is_place_of(manufacturer, place);
    });
  }

  // Assigns the sub-indexes of 1010h to 1011h.
  void set_like(const Assignment& other) {
    set_where([&](std::size_t n, const StoreSub& place) {
      const char* const purpose = purpose_of(plan_.groups[n], words_[n]);
      return place.sub_index == other.sub_of(n) && (place.allows(purpose) || place.allows(manufacturer));
    });
  }

  // Returns the sub-indexes without group: "2 "Save communication parameters", 4 "Save drive"".
  std::string free_places() const {
    std::string list;
    for (const StoreSub& place : places_) {
      list += fmt::format("{}{:X} \"{}\"", list.empty() ? "" : ", ", place.sub_index, place.name);
    }
    return list;
  }

 private:
  std::vector<StoreSub>::iterator place_at(std::uint8_t sub_index) {
    return std::find_if(places_.begin(), places_.end(),
                        [&](const StoreSub& one) { return one.sub_index == sub_index; });
  }

  bool is_open(std::size_t group) const { return subs_[group] == 0 && failures_[group].empty(); }

  // Assigns a place to a group if it is the only place that fits the group, and fits no other group.
  template <typename Fits>
  void set_where(Fits fits) {
    std::map<std::size_t, std::vector<std::uint8_t>> places;
    std::map<std::uint8_t, std::vector<std::size_t>> groups;
    for (std::size_t n = 1; n < plan_.groups.size(); ++n) {
      for (const StoreSub& place : places_) {
        if (is_open(n) && fits(n, place)) {
          places[n].push_back(place.sub_index);
          groups[place.sub_index].push_back(n);
        }
      }
    }
    for (const auto& [group, subs] : places) {
      const std::vector<std::size_t>& rivals = groups[subs.front()];
      if (subs.size() == 1 && rivals.size() == 1) {
        set(group, subs.front());
      } else {
        failures_[group] = subs.size() > 1 ? "several sub-indexes fit" : several_groups(rivals, subs.front());
      }
    }
  }

  std::string several_groups(const std::vector<std::size_t>& groups, std::uint8_t sub_index) const {
    std::string names;
    for (const std::size_t group : groups) {
      names += (names.empty() ? "" : " and ") + plan_.groups[group].name;
    }
    return fmt::format("sub-index {:X} fits {}", sub_index, names);
  }

  const Plan& plan_;
  std::vector<StoreSub> places_;    // sub-indexes without group
  std::vector<Words> words_;        // words of each group's name
  std::vector<std::uint8_t> subs_;  // sub-index of each group; 0: none
  std::vector<std::string> failures_;
  bool has_all_ = false;
};

// Options --store -----------------------------------------------------------------------------------------------------

std::size_t find_group(const Plan& plan, const std::string& name) {
  const auto group =
      std::find_if(plan.groups.begin() + 1, plan.groups.end(), [&](const Group& one) { return one.name == name; });
  return group == plan.groups.end() ? 0 : static_cast<std::size_t>(group - plan.groups.begin());
}

std::string group_names(const Plan& plan) {
  std::string names;
  for (std::size_t n = 1; n < plan.groups.size(); ++n) {
    names += (n == 1 ? "" : ", ") + plan.groups[n].name;
  }
  return names.empty() ? "none" : names;
}

void set_by_option(const Plan& plan, const Options& options, Assignment& stores, Findings& findings) {
  for (const auto& [name, sub_index] : options.store) {
    const std::size_t group = find_group(plan, name);
    const std::string free = stores.free_places();
    if (plan.unstored.count(name) != 0) {
      continue;
    }
    if (group == 0) {
      findings.add(rules::store, {},
                   fmt::format("--store {0}: no storage group {0}; storage groups: {1}", name, group_names(plan)));
    } else if (!stores.set(group, sub_index)) {
      findings.add(rules::store, {},
                   fmt::format("--store {}={:X}: sub-index {:X} of 1010h is missing or has another group; free: {}",
                               name, sub_index, sub_index, free.empty() ? "none" : free));
    }
  }
}

// Missing sub-indexes -------------------------------------------------------------------------------------------------

void report_unstored(const Plan& plan, const Assignment& stores, Findings& findings) {
  for (std::size_t n = 1; n < plan.groups.size(); ++n) {
    const Group& group = plan.groups[n];
    if (group.sub_index != 0) {
      continue;
    }
    const std::string& failure = stores.failure_of(n);
    const std::string free = stores.free_places();
    findings.add(
        rules::store, plan.items[group.members.front().item].span,
        fmt::format("storage group {}: {}; {}", group.name,
                    failure.empty() ? "no sub-index of 1010h is named for it" : failure + " (1010h)",
                    free.empty() ? "no sub-index is left" : "1010h has " + free),
        fmt::format("name a sub-index of 1010h \"Save {0}\", or give --store {0}=SUB or {0}=none", group.name));
  }
}

void report_unrestored(const Plan& plan, Findings& findings) {
  for (std::size_t n = 1; n < plan.groups.size(); ++n) {
    const Group& group = plan.groups[n];
    if (group.restore_sub == 0 && group.sub_index != 0) {
      findings.add(rules::restore, plan.items[group.members.front().item].span,
                   fmt::format("storage group {}: no sub-index of 1011h restores it; 1010h sub {:X} stores it",
                               group.name, group.sub_index),
                   fmt::format("name a sub-index of 1011h \"Restore {}\"", group.name));
    }
  }
}

void report_unused(const Plan& plan, Findings& findings) {
  for (const Item& item : plan.items) {
    const bool is_store = item.index == store_index && item.storage == Storage::group;
    const bool is_used = (item.sub_index == 1 && plan.stores_all) ||
                         std::any_of(plan.groups.begin(), plan.groups.end(),
                                     [&](const Group& group) { return group.sub_index == item.sub_index; });
    if (is_store && !is_used) {
      findings.add(rules::store_unused, item.span, "sub-index has no storage group, \"save\" is refused",
                   "assign objects to a storage group, or remove it");
    }
  }
  if (plan.groups.size() > 1 && plan.find(store_index, 1) == nullptr) {
    findings.add(rules::store_unused, {}, "storage groups are neither loaded nor stored: 1010h is missing",
                 "describe 1010h and 1011h");
  }
}

// Assigns the sub-indexes of 1010h: by option, then sub-index 1 if 1010h has no other, then by names and purposes.
void assign_stores(Plan& plan, const Options& options, Assignment& stores, Findings& findings) {
  set_by_option(plan, options, stores, findings);
  if (stores.has_only_all() && plan.groups.size() > 1) {
    stores.set(1, 1);
  }
  stores.set_by_name();
  stores.set_by_purpose();
  for (std::size_t n = 1; n < plan.groups.size(); ++n) {
    plan.groups[n].sub_index = stores.sub_of(n);
  }
}

void assign_restores(Plan& plan, const Options& options, const Assignment& stores, Assignment& restores) {
  for (std::size_t n = 1; n < plan.groups.size(); ++n) {
    if (options.store.count(plan.groups[n].name) != 0) {
      restores.set(n, stores.sub_of(n));
    }
  }
  if (restores.has_only_all() && plan.groups.size() == 2) {
    restores.set(1, 1);
  }
  restores.set_by_name();
  restores.set_like(stores);
  for (std::size_t n = 1; n < plan.groups.size(); ++n) {
    plan.groups[n].restore_sub = restores.sub_of(n);
  }
}

}  // namespace

void join_groups(Plan& plan, Findings& findings) {
  if (!Assignment(plan, store_index).has_only_all()) {
    return;
  }
  std::size_t joined = 1;
  for (Item& item : plan.items) {
    if (item.group > joined) {
      joined = item.group;
      findings.add(rules::store_joined, item.span,
                   fmt::format("storage group {} is joined to {}: 1010h has one sub-index",
                               in_quotes(plan.groups[item.group].name), in_quotes(plan.groups[1].name)),
                   "add sub-indexes to 1010h and 1011h");
    }
    item.group = std::min<std::size_t>(item.group, 1);
  }
  plan.groups.resize(std::min<std::size_t>(plan.groups.size(), 2));
}

void plan_stores(Plan& plan, const Options& options, Findings& findings) {
  Assignment stores(plan, store_index);
  Assignment restores(plan, restore_index);
  plan.stores_all = stores.has_all();
  plan.restores_all = restores.has_all();
  const bool has_stores = stores.has_any();
  const bool has_restores = restores.has_any();
  assign_stores(plan, options, stores, findings);
  assign_restores(plan, options, stores, restores);
  if (has_stores) {
    report_unstored(plan, stores, findings);
  }
  if (has_restores) {
    report_unrestored(plan, findings);
  }
  report_unused(plan, findings);
}

std::vector<StoredGroup> stored_groups(const Plan& plan) {
  const auto name_of = [&](std::uint16_t index, std::uint8_t sub_index) {
    const Item* const item = sub_index == 0 ? nullptr : plan.find(index, sub_index);
    return item == nullptr ? std::string() : item->own_name();
  };
  std::vector<StoredGroup> groups;
  for (std::size_t n = 1; n < plan.groups.size(); ++n) {
    const Group& group = plan.groups[n];
    const auto entries =
        std::count_if(plan.items.begin(), plan.items.end(), [n](const Item& item) { return item.group == n; });
    groups.push_back({group.name, group.sub_index, name_of(store_index, group.sub_index), group.restore_sub,
                      name_of(restore_index, group.restore_sub), static_cast<std::size_t>(entries), group.size});
  }
  return groups;
}

}  // namespace lexican::codict::gen
