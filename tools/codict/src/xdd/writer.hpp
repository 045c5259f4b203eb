// SPDX-License-Identifier: Apache-2.0
/// \file writer.hpp
/// Functions of the writer, grouped by the files that define them.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "xdd/printer.hpp"

namespace lexican::codict::xdd {

void print_labels(Printer& out, const LabelGroup& texts);

// Parameters named remainder: opaque parts of the element that is written; null: none.

// write_network.cpp
void print_transport(Printer& out, const Device& device, const OpaquePart* remainder,
                     const OpaquePart* rates_remainder);
void print_management(Printer& out, const Device& device, const OpaquePart* remainder);
void print_dummies(Printer& out, const Device& device, const OpaquePart* remainder);
void print_channels(Printer& out, const Device& device, const OpaquePart* remainder);

/// Returns at least `digits` hexadecimal digits in capital letters.
std::string hex(std::uint64_t value, std::size_t digits);

/// Writer of parameters, and of the objects that refer to them.
class EntryWriter {
 public:
  EntryWriter(Printer& out, const Device& device);

  bool has_parameters() const;
  void types(const OpaquePart* remainder);
  void templates(const OpaquePart* remainder);
  void parameters(const OpaquePart* remainder);
  void groups(const OpaquePart* remainder);
  void objects(const OpaquePart* remainder);

 private:
  bool has_parameter(const Entry& entry, bool is_variable) const;
  std::string id_of(const Entry& entry, const std::string& made) const;
  void parameter(const Entry& entry, const std::string& id, bool is_variable, std::string_view element);
  void parameter_once(const Entry& entry, const std::string& id, bool is_variable);
  void type(const Entry& entry, bool is_variable);
  void type_use(const TypeUse& use, std::uint16_t code);
  void value(std::string_view name, const Value& value, OpaqueParts& opaque);
  void allowed(const Entry& entry, OpaqueParts& opaque);
  void allowed_values(const Allowed& allowed, OpaqueParts& opaque);
  void ranges(const Allowed& allowed, OpaqueParts& opaque);
  void range(const Range& range, OpaqueParts& opaque);
  void unit(const Unit& unit, OpaqueParts& opaque);
  void denotation(const Entry& entry, OpaqueParts& opaque);
  void properties(const Entry& entry, bool is_variable);
  void property(std::string_view name, std::string_view text);
  void object(const Object& object);
  void entry_attributes(const Entry& entry, const std::string& id, bool is_variable);
  void definition(const TypeDefinition& definition);
  void enumeration(const TypeDefinition& definition);
  void group(const Group& group);
  void label_of_name(const Entry& entry);

  Printer& out_;
  const Device& device_;
  bool has_groups_ = false;  ///< an EDS with storage groups: its XDD looks like one of CANopenNode
  bool is_eds_;
  std::set<std::string> written_;
  std::set<std::string, std::less<>> types_;
};

}  // namespace lexican::codict::xdd
