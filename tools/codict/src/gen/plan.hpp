// SPDX-License-Identifier: Apache-2.0
/// \file plan.hpp
/// Plan of a dictionary: all decisions and names, before any text is written.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gen/forms.hpp"
#include "model/device.hpp"
#include "model/rare.hpp"
#include "text/finding.hpp"

namespace lexican::codict::gen {

enum class Language : unsigned char { c, cpp };

/// The device's own EDS in the generated source.
enum class EmbeddedEds : unsigned char { none, plain, zlib };

/// Options of the generator.
struct Options {
  std::string name;    ///< prefix of all generated names: a C identifier
  std::string source;  ///< file name of the description, for the comment at the top
  Language language = Language::c;
  std::uint8_t node_id = 1;            ///< node-ID of the node that --verify starts
  std::uint32_t string_capacity = 32;  ///< bytes of a writable string whose length is not described
  bool unique_names = false;           ///< equal names of two entries are an error
  bool trigger_tpdos = false;          ///< set flag A for all objects that a TPDO may map
  EmbeddedEds embedded_eds = EmbeddedEds::none;
  std::set<std::uint32_t> error_bits;         ///< keys of the entries that show error status bits (CO_TEMCY_BITS)
  std::map<std::string, std::uint8_t> store;  ///< sub-indexes of 1010h by storage group; 0: the group is not stored
};

/// Location of an entry's value.
enum class Storage : unsigned char {
  direct,       ///< in the entry (flag D)
  constant,     ///< in a constant variable
  variable,     ///< in a member of a struct
  text,         ///< a CO_OBJ_STR and a constant text
  string,       ///< a CO_OBJ_STR_RW and its memory
  domain,       ///< a CO_OBJ_DOM and its memory
  consumer,     ///< a CO_HBCONS
  group,        ///< a CO_PARA
  eds,          ///< a CO_OBJ_DOM_RO and the constant bytes of the EDS
  error_bits,   ///< a CO_EMCY_BITS
  shared,       ///< in a structure that the application defines for all entries of the object
  external,     ///< in a variable, CO_OBJ_STR, CO_OBJ_STR_RW or CO_OBJ_DOM that the application defines
  application,  ///< known only to the object type, which the application defines
};

/// Range of an entry's value.
struct Limits {
  std::string low;             ///< literal; empty: no limit
  std::string high;            ///< literal; empty: no limit
  std::uint64_t low_bits = 0;  ///< limits as bit patterns; without a limit, the lowest and highest of the width
  std::uint64_t high_bits = 0;
  bool holds_default = true;  ///< the default value is within the limits
};

/// Entry of the table. A large dictionary has 65534 of them.
struct Item {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::string name;                ///< name in the description, for comments
  std::size_t own_name_begin = 0;  ///< offset of the entry's own name in `name`, behind the name of its object
  Span span;                       ///< place in the description, for findings
  Access access = Access::ro;
  PdoMapping pdo = PdoMapping::no;
  const Form* form = nullptr;
  const Place* place = nullptr;
  std::string_view type;      ///< "CO_TUNSIGNED16", a constant
  bool has_own_type = false;  ///< the application defines the type
  std::uint32_t flags = 0;    ///< flags of CO_KEY()
  Storage storage = Storage::variable;
  Value value;
  std::uint32_t capacity = 0;  ///< size of a string or domain in bytes
  std::size_t group = 0;       ///< index in Plan::groups
  std::string alias;           ///< "hour"; empty: no alias
  Rare<Limits> limits;
  std::size_t limited = 0;  ///< number of the limited type, from 1; 0: no limits

  std::uint32_t key() const { return std::uint32_t{index} << 16 | std::uint32_t{sub_index} << 8; }
  bool is_limited() const { return !limits->low.empty() || !limits->high.empty(); }
  std::string own_name() const { return name.substr(own_name_begin); }  ///< name without that of the object
  std::string member() const;                                           ///< "od_2100_1"
};

/// Purpose of a group's member for its entry.
enum class Role : unsigned char {
  value,       ///< variable of the entry
  descriptor,  ///< a CO_OBJ_STR, CO_OBJ_STR_RW, CO_OBJ_DOM or CO_HBCONS
  length,      ///< length of a stored string, in bytes
  memory,      ///< bytes of a string or domain
};

/// Member of a struct of variables.
struct Member {
  std::size_t item = 0;  ///< index in Plan::items
  Role role = Role::value;
  std::string_view type;            ///< C type, a constant
  std::string name;                 ///< "od_2201_0_length"
  std::uint32_t count = 0;          ///< number of array elements; 0: no array
  std::uint32_t size = 0;           ///< size in bytes, on a CPU with 32-bit addresses
  std::uint8_t alignment = 1;       ///< alignment in bytes, on a CPU with 32-bit addresses
  std::uint32_t unused_before = 0;  ///< unused bytes in front of the member
  bool has_alias = false;
};

/// NMT reset that sets a variable to its power-on value.
enum class Reset : unsigned char {
  none,           ///< not writable by the network: set to its default value once, at power-on
  node,           ///< reset node
  communication,  ///< both resets: an object of the communication profile
};

/// Struct of variables. The first group of a plan is the RAM, which is not stored.
struct Group {
  std::string name;               ///< name in the description: "PERSIST_COMM"
  std::string id;                 ///< name as an identifier: "persist_comm"
  std::uint8_t sub_index = 0;     ///< sub-index of 1010h; 0: none
  std::uint8_t restore_sub = 0;   ///< sub-index of 1011h; 0: none
  bool is_communication = false;  ///< "reset communication" loads the whole group
  std::uint32_t com_size = 0;     ///< otherwise: number of bytes at the beginning that "reset communication" loads
  std::vector<Member> members;    ///< members in the order of their addresses
  std::uint32_t layout = 0;       ///< 24-bit hash of the layout of all members
  std::uint32_t size = 0;         ///< size in bytes with padding, on a CPU with 32-bit addresses
  std::uint32_t unused = 0;       ///< padding bytes at the end, so that the size is aligned on every CPU
};

/// Mapping parameter of a PDO, for the compile-time check of its length.
struct PdoSum {
  std::uint16_t index = 0;     ///< index of the mapping parameter
  std::vector<unsigned> bits;  ///< length of each mapped object
};

/// Plan of a dictionary: make_plan() creates it, the writers of C and C++ read it.
struct Plan {
  std::vector<Item> items;  ///< entries in ascending order of their keys; none if they are too many
  std::size_t entries = 0;  ///< number of entries; more than `most_items` are an error
  std::vector<Group> groups;
  std::vector<PdoSum> pdos;
  std::map<std::string, unsigned> labels;  ///< number of objects for each CO_countLabel
  std::string eds;                         ///< bytes of 1021h
  std::set<std::string> unstored;          ///< storage groups that the options keep in RAM
  bool stores_all = false;                 ///< sub-index 1 of 1010h stores all groups
  bool restores_all = false;               ///< sub-index 1 of 1011h restores all groups

  const Item* find(std::uint16_t index, std::uint8_t sub_index) const;
};

/// Limit of the entries: one less than the largest table, for the end mark.
constexpr std::size_t most_items = 0xFFFE;

/// Plans a dictionary. Errors are added to the findings; the objects that they concern are missing in the plan.
Plan make_plan(const Device& device, const Options& options, Findings& findings);

/// Returns the device that a plan implements: without objects that have no entry, with all default values.
Device described(Device device, const Plan& plan);

/// Returns the NMT reset that sets an entry which is not stored to its power-on value.
Reset reset_of(const Item& item);

/// Returns the first RAM member that a reset sets; the reset sets all members behind it, too. Null: there is none.
const Member* first_reset(const Plan& plan, Reset reset);

/// Returns true if there are variables that resets set and that no sub-index of 1010h stores. The end mark of the table
/// then sets all variables that are not stored to their default values; otherwise their initialisers do.
bool has_defaults(const Plan& plan);

/// Returns the object of an entry for messages: "2100h sub 1".
std::string place_name(const Item& item);

}  // namespace lexican::codict::gen
