// SPDX-License-Identifier: Apache-2.0
/// \file view.hpp
/// Output for users: a decoded trace of the bus, in which long transfers are folded, and results.
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "client/progress.hpp"
#include "host/host.hpp"
#include "trace/decode.hpp"

namespace lexican::demo {

class View {
 public:
  struct Style {
    bool terminal = false;  // lines can be rewritten
    bool colours = false;
    bool every_frame = false;       // false: long transfers are folded
    const char* others = "master";  // label of the sender of received frames
  };

  View(std::ostream& out, const trace::Names& names, Style style, trace::Mappings mappings = {})
      : out_(out), decoder_(names, std::move(mappings)), style_(style) {}

  /// Prints the titles of the columns.
  void columns();
  /// Prints a frame that the node has received or sent \a time after the start.
  void frame(Micros time, bool received, const CO_IF_FRM& frame);

  void heading(unsigned number, const std::string& title);
  void finding(bool good, const std::string& text);
  /// Prints a text after a short label. \a colour: an escape sequence, or "".
  void note(const char* label, const std::string& text, const char* colour = "");
  void line(const std::string& text);

  Progress::Form progress_form() const { return style_.terminal ? Progress::Form::bar : Progress::Form::lines; }
  /// Prints the progress of a long transfer; on a terminal, each line replaces the previous one.
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
  void print_row(const Row& row);

  std::ostream& out_;
  trace::Decoder decoder_;
  Style style_;
  bool bar_shown_ = false;      // the bar is the last line, without a line end
  unsigned segments_ = 0;       // segments of the current transfer
  std::vector<Row> held_back_;  // rows that are printed only if the transfer is too short to be folded
};

}  // namespace lexican::demo
