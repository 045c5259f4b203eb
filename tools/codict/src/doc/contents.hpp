// SPDX-License-Identifier: Apache-2.0
/// \file contents.hpp
/// Contents of the documentation, independent of the output format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "doc/doc.hpp"
#include "model/cob_id.hpp"
#include "model/pdo.hpp"

namespace lexican::codict::doc {

/// Name and value of a property, or of an allowed value.
struct Fact {
  std::string_view name;
  std::string value;
};

/// Object or sub-object.
struct Item {
  std::string number;  ///< "2000h" or "2000h:1F"
  std::string anchor;  ///< "o-2000" or "o-2000-1F"; must never change, because links refer to it
  std::string name;
  std::string type;
  std::string access;
  std::string mapping;  ///< "TPDO" or "RPDO, TPDO"; empty if it cannot be mapped
  std::string default_value;
  std::string value;  ///< value that a DCF or XDC configures
  std::string range;
  std::string unit;
  std::string group;               ///< storage group
  std::vector<Fact> allowed;       ///< values with their names
  std::vector<std::string> words;  ///< descriptions and remarks
};

struct ObjectItem {
  Item object;  ///< only name, type, group and words if it has sub-objects
  bool has_subs = false;
  std::vector<Item> subs;
};

/// Objects of a group of the description, or of an area of the dictionary.
struct Chapter {
  std::string title;
  std::string anchor;
  std::string words;   ///< description of the group
  unsigned level = 0;  ///< nesting depth of the chapter
  std::vector<ObjectItem> objects;
};

/// Table row for a COB-ID.
struct CobIdRow {
  std::string service;
  std::string identifier;  ///< "181h", "off", "?"
  std::string source;      ///< "1800h:1", "CiA 301"
};

/// Mapped object of a PDO.
struct PdoPart {
  std::string number;  ///< "2000h:1"
  std::string anchor;  ///< anchor of the object; empty if the object is not described
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
