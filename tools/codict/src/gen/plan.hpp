// SPDX-License-Identifier: Apache-2.0
/// \file plan.hpp
/// A dictionary as it is going to be written: every decision has been made, and every name is given.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gen/forms.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::gen {

enum class Language : unsigned char { c, cpp };

struct Options {
  std::string name;    ///< of everything that is written: a C identifier
  std::string source;  ///< file name of the description, for the comment at the top
  Language language = Language::c;
  std::uint8_t node_id = 1;                   ///< of the node that the program of --verify starts
  std::uint32_t string_capacity = 32;         ///< bytes of a string that can be written and whose length nobody says
  bool unique_names = false;                  ///< two entries with one name are an error
  bool trigger_tpdos = false;                 ///< flag A for all that a TPDO may map
  std::map<std::string, std::uint8_t> store;  ///< sub-indexes of 1010h by storage group; 0: the group is not stored
};

/// Where the value of an entry is.
enum class Storage : unsigned char {
  direct,       ///< in the entry
  constant,     ///< in a constant
  variable,     ///< in a struct
  text,         ///< a CO_OBJ_STR and a constant text
  string,       ///< a CO_OBJ_STR_RW and its memory
  domain,       ///< a CO_OBJ_DOM and its memory
  consumer,     ///< a CO_HBCONS
  group,        ///< a CO_PARA
  external,     ///< a variable, CO_OBJ_STR, CO_OBJ_STR_RW or CO_OBJ_DOM of the application
  application,  ///< nothing: its type is the application's, and knows it
};

struct Limits {
  std::string low;             ///< literal; empty: none
  std::string high;            ///< literal; empty: none
  std::uint64_t low_bits = 0;  ///< what has no limit has the lowest and highest of its width
  std::uint64_t high_bits = 0;
  bool holds_default = true;
};

/// An entry of the table.
struct Item {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::string name;      ///< of the description, for comments
  std::string own_name;  ///< the same without the name of the object around it
  Span span;
  Access access = Access::ro;
  PdoMapping pdo = PdoMapping::no;
  const Form* form = nullptr;
  const Place* place = nullptr;
  std::string type;           ///< "CO_TUNSIGNED16"
  bool has_own_type = false;  ///< the application's
  std::uint32_t flags = 0;    ///< of CO_KEY()
  Storage storage = Storage::variable;
  Value value;
  std::uint32_t capacity = 0;  ///< bytes of a string or domain
  std::size_t group = 0;       ///< in Plan::groups
  std::string member;          ///< "od_2100_1"
  std::string alias;           ///< "hour"; empty: none
  Limits limits;
  std::size_t limited = 0;  ///< number of the limited type, from 1; 0: none

  std::uint32_t key() const { return std::uint32_t{index} << 16 | std::uint32_t{sub_index} << 8; }
  bool is_limited() const { return !limits.low.empty() || !limits.high.empty(); }
};

/// What a member of a group is to its entry.
enum class Role : unsigned char {
  value,       ///< the variable
  descriptor,  ///< a CO_OBJ_STR, CO_OBJ_STR_RW, CO_OBJ_DOM or CO_HBCONS
  length,      ///< of a stored string, in bytes
  memory,      ///< of a string or domain
};

struct Member {
  std::size_t item = 0;  ///< in Plan::items
  Role role = Role::value;
  std::string type;                 ///< of C
  std::string name;                 ///< "od_2201_0_length"
  std::uint32_t count = 0;          ///< of an array; 0: it is none
  std::uint32_t size = 0;           ///< bytes, where addresses have 32 bits
  std::uint8_t alignment = 1;       ///< where addresses have 32 bits
  std::uint32_t unused_before = 0;  ///< bytes without use in front of it
  bool has_alias = false;
};

/// Which NMT reset gives a variable its power-on value.
enum class Reset : unsigned char {
  none,           ///< the network cannot write it: it gets its default value once, at power-on
  node,           ///< reset node
  communication,  ///< both resets: an object of the communication profile
};

/// Variables in one struct. The first group is the RAM, which is not stored.
struct Group {
  std::string name;               ///< of the description: "PERSIST_COMM"
  std::string id;                 ///< "persist_comm"
  std::uint8_t sub_index = 0;     ///< of 1010h; 0: none
  std::uint8_t restore_sub = 0;   ///< of 1011h; 0: none
  bool is_communication = false;  ///< all of it is loaded by "reset communication"
  std::uint32_t com_size = 0;     ///< otherwise: bytes at the beginning that are
  std::vector<Member> members;    ///< in the order of their memory
  std::uint32_t layout = 0;       ///< hash over all of them, 24 bits
  std::uint32_t size = 0;         ///< bytes, with padding, where addresses have 32 bits
  std::uint32_t unused = 0;       ///< bytes at the end of a storage group: a multiple of its alignment on every CPU
};

struct PdoSum {
  std::uint16_t index = 0;
  std::vector<unsigned> bits;
};

struct Plan {
  std::vector<Item> items;  ///< ascending
  std::vector<Group> groups;
  std::vector<PdoSum> pdos;
  std::map<std::string, unsigned> labels;  ///< CO_countLabel, and how many objects have it
  std::set<std::string> unstored;          ///< storage groups that the options leave in the RAM
  bool stores_all = false;                 ///< sub 1 of 1010h stands for the others
  bool restores_all = false;               ///< sub 1 of 1011h stands for the others

  const Item* find(std::uint16_t index, std::uint8_t sub_index) const;
};

/// Errors are findings; what they are about is missing in the plan.
Plan make_plan(const Device& device, const Options& options, Findings& findings);

/// The device that a plan makes: without what has no entry, with the values that it has from the beginning.
Device described(const Device& device, const Plan& plan);

/// The reset of an entry that is not stored.
Reset reset_of(const Item& item);

/// The first member of the RAM that a reset sets: all behind it are set, too. Null: there is none.
const Member* first_reset(const Plan& plan, Reset reset);

/// Whether there are variables that resets set and no 1010h loads: the end mark of the table gives all variables that
/// are not stored their default values then. Otherwise the compiler does.
bool has_defaults(const Plan& plan);

/// "2100h sub 1"
std::string place_name(const Item& item);

}  // namespace lexican::codict::gen
