// SPDX-License-Identifier: Apache-2.0
/// \file view.hpp
/// What a person sees: a decoded trace of the bus, in which long transfers are folded, and what is said about it.
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "client/progress.hpp"
#include "host/host.hpp"
#include "trace/decode.hpp"

namespace demo {

class View {
 public:
  struct Style {
    bool terminal = false;  // lines can be rewritten
    bool colours = false;
    bool every_frame = false;       // false: long transfers are folded
    const char* others = "master";  // who sends what the node receives
  };

  View(std::ostream& out, const trace::Names& names, Style style, trace::Mappings mappings = {})
      : out_(out), decoder_(names, std::move(mappings)), style_(style) {}

  /// The titles of the columns.
  void columns();
  /// A frame that the node has received or sent \a time after the start.
  void frame(Micros time, bool received, const CO_IF_FRM& frame);

  void heading(unsigned number, const std::string& title);
  void finding(bool good, const std::string& text);
  /// A text with a short label before it. \a colour: an escape sequence, or "".
  void note(const char* label, const std::string& text, const char* colour = "");
  void line(const std::string& text);

  Progress::Form progress_form() const { return style_.terminal ? Progress::Form::bar : Progress::Form::lines; }
  /// How far a long transfer is; on a terminal a line that the next one replaces.
  void progress(const std::string& text);

 private:
  struct Row {
    const char* colour;
    std::string text;
  };

  Row row(Micros time, bool received, const CO_IF_FRM& frame, const std::string& meaning) const;
  bool is_folding() const;
  void show_or_hold_back(const Row& row);
  void end_fold();
  void put(const Row& row);

  std::ostream& out_;
  trace::Decoder decoder_;
  Style style_;
  bool bar_shown_ = false;      // as the last line, without an end
  unsigned segments_ = 0;       // of the present transfer, from its middle
  std::vector<Row> held_back_;  // of these, the first that will be shown if not many more come
};

}  // namespace demo
