// SPDX-License-Identifier: Apache-2.0
/// \file contents.hpp
/// What documentation says, before it has a form.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "doc/doc.hpp"
#include "model/cob_id.hpp"
#include "model/pdo.hpp"

namespace lexican::codict::doc {

struct Fact {
  std::string_view name;
  std::string value;
};

/// An object or a sub-object.
struct Item {
  std::string number;  ///< "2000h", "2000h:1F"
  std::string anchor;  ///< "o-2000", "o-2000-1F": the same for ever
  std::string name;
  std::string type;
  std::string access;
  std::string mapping;  ///< "TPDO", "RPDO, TPDO"; empty if it cannot be mapped
  std::string default_value;
  std::string value;  ///< what a DCF or XDC configures
  std::string range;
  std::string unit;
  std::string group;               ///< storage group
  std::vector<Fact> allowed;       ///< values with their names
  std::vector<std::string> words;  ///< descriptions, and what is special
};

struct ObjectItem {
  Item object;  ///< without columns of its own where it has sub-objects
  bool has_subs = false;
  std::vector<Item> subs;
};

struct Chapter {
  std::string title;
  std::string anchor;
  std::string words;
  unsigned level = 0;  ///< of chapters within chapters
  std::vector<ObjectItem> objects;
};

/// Which COB-ID has which service, and what to say of it.
struct CobIdRow {
  std::string service;
  std::string identifier;  ///< "181h", "off", "?"
  std::string source;      ///< "1800h:1", "CiA 301"
};

struct PdoPart {
  std::string number;  ///< "2000h:1"
  std::string anchor;  ///< of the object; empty if it is not described
  std::string name;
  unsigned first_bit = 0;
  unsigned bits = 0;
};

struct PdoItem {
  std::string title;  ///< "TPDO 1"
  std::string anchor;
  std::string cob_id;
  std::string transmission;
  std::vector<PdoPart> parts;
  unsigned bits = 0;
};

struct Contents {
  std::string title;
  std::vector<Fact> identity;
  std::vector<Fact> features;
  std::vector<CobIdRow> cob_ids;
  std::vector<PdoItem> pdos;
  std::vector<Chapter> chapters;
};

Contents contents_of(const Device& device, const Options& options);

}  // namespace lexican::codict::doc
