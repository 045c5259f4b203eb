// SPDX-License-Identifier: Apache-2.0
/// \file view.hpp
/// What a person sees: a decoded trace of the bus, in which long segmented transfers are folded, and what is said about
/// it.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "linux_node/host.hpp"
#include "trace/decode.hpp"

namespace demo {

class View {
 public:
  struct Style {
    bool colours = false;
    bool every_frame = false;       // false: long transfers are folded
    const char* others = "master";  // who sends what the node receives
  };

  View(std::ostream& out, const trace::Names& names, Style style) : out_(out), names_(names), style_(style) {}

  /// The titles of the columns.
  void columns();
  /// A frame that the node has received or sent \a time after the start.
  void frame(Micros time, bool received, const CO_IF_FRM& frame);

  void heading(unsigned number, const std::string& title);
  void finding(bool good, const std::string& text);
  /// A text with a short label before it. \a colour: an escape sequence, or "".
  void note(const char* label, const std::string& text, const char* colour = "");
  void line(const std::string& text);

 private:
  struct Row {
    const char* colour;
    std::string text;
  };

  Row row(Micros time, bool received, const CO_IF_FRM& frame) const;
  void end_fold();
  void put(const Row& row);

  std::ostream& out_;
  const trace::Names& names_;
  Style style_;
  unsigned segments_ = 0;       // in a row, up to the last frame
  std::vector<Row> held_back_;  // of these, the first that will be shown if not many more come
};

}  // namespace demo
