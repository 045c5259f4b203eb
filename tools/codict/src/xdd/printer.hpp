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

/// Kept parts of an element that are not yet written.
class Rest {
 public:
  Rest() = default;
  explicit Rest(const std::vector<Kept>& others);

  /// Removes and returns the first kept part with a name; null if there is none.
  const Kept* take(std::string_view name);
  /// Like take(), but skips parts that were kept with their text or with this attribute: only the rest of an element is
  /// returned whose text or attribute the reader has stored in the model.
  const Kept* take_left(std::string_view name, std::string_view attribute);
  const std::vector<const Kept*>& all() const { return all_; }

 private:
  std::vector<const Kept*> all_;
};

/// Returns the kept parts inside of an element; none if the element has no kept rest.
Rest rest_of(const Kept* left);

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
  void kept(const Kept& kept);
  void attributes_of(const Rest& rest);
  void elements_of(const Rest& rest);

  std::string take() { return std::move(text_); }

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
