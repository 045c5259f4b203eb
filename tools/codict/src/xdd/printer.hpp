// SPDX-License-Identifier: Apache-2.0
/// \file printer.hpp
/// Output of XML elements, with the namespaces of one edition of CiA 311.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/device.hpp"
#include "xdd/write.hpp"

namespace lexican::codict::xdd {

/// Opaque parts of an element that are not yet written.
class OpaqueParts {
 public:
  OpaqueParts() = default;
  explicit OpaqueParts(const std::vector<OpaquePart>& others);

  /// Removes and returns the first part with a name; null if there is none.
  const OpaquePart* remove_first(std::string_view name);
  /// Like remove_first(), but skips parts that were stored with their text or with this attribute: only the remainder
  /// of an element is returned whose text or attribute the reader has stored in the model.
  const OpaquePart* remove_remainder(std::string_view name, std::string_view attribute);
  const std::vector<const OpaquePart*>& all() const { return all_; }

 private:
  std::vector<const OpaquePart*> all_;
};

/// Returns the opaque parts inside an element; none if the element has no remainder.
OpaqueParts parts_inside(const OpaquePart* remainder);

/// Buffer for an XML text. Elements are indented and closed in the order of open() and close().
class Printer {
 public:
  explicit Printer(Edition edition);

  bool is_qualified() const { return edition_ == Edition::v10; }
  void open(std::string_view name);
  void attribute(std::string_view name, std::string_view text);
  void attribute(std::string_view name, const Text& text);  ///< writes nothing if the text is not given
  void text(std::string_view text);
  void close();

  void element(std::string_view name, std::string_view content);
  void print_opaque(const OpaquePart& part);
  void attributes_of(const OpaqueParts& opaque);
  void elements_of(const OpaqueParts& opaque);

  std::string take_text() { return std::move(text_); }

 private:
  void indent();
  void end_tag();
  std::string full(std::string_view name) const;

  Edition edition_;
  std::string text_;
  std::vector<std::string> open_;
  bool is_tag_open_ = false;
  bool has_text_ = false;
};

}  // namespace lexican::codict::xdd
