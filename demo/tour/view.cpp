// SPDX-License-Identifier: Apache-2.0
#include "tour/view.hpp"

#include <algorithm>

#include "trace/text.hpp"

namespace lexican::demo {
namespace {

constexpr unsigned segments_shown = 4;
constexpr unsigned fewest_folded = 4;  // further segments; if there are more, they are folded

// Select Graphic Rendition of ECMA-48.
constexpr const char* plain = "";
constexpr const char* bold = "\033[1m";
constexpr const char* green = "\033[32m";
constexpr const char* red = "\033[1;31m";
constexpr const char* yellow = "\033[33m";
constexpr const char* cyan = "\033[36m";
constexpr const char* grey = "\033[90m";
constexpr const char* reset_colour = "\033[0m";
constexpr const char* erase_line = "\r\033[K";

std::string identifier(const CO_IF_FRM& frame) {
  const auto id = static_cast<unsigned>(frame.Identifier & (CO_IF_FRM_ID | CO_IF_FRM_ERROR));
  return text((frame.Identifier & (CO_IF_FRM_EXT | CO_IF_FRM_ERROR)) != 0 ? "%08X" : "%03X", id);
}

std::string bytes(const CO_IF_FRM& frame) {
  if ((frame.Identifier & CO_IF_FRM_RTR) != 0) {
    return "remote";
  }
  return hex_bytes(frame.Data, std::min<std::size_t>(frame.DLC, sizeof frame.Data));
}

const char* colour_of(bool received, const std::string& meaning) {
  if (meaning.find("ABORT") != std::string::npos) {
    return yellow;
  }
  return received ? plain : cyan;
}

}  // namespace

void View::print_row(const Row& row) {
  const bool coloured = style_.colours && *row.colour != '\0';
  out_ << (bar_shown_ ? erase_line : "");
  bar_shown_ = false;
  out_ << (coloured ? row.colour : "") << row.text << (coloured ? reset_colour : "") << std::endl;
}

void View::line(const std::string& text) {
  end_fold();
  print_row({plain, text});
}

void View::columns() {
  print_row({grey, text("%9s  %-6s  %-3s  %-23s  %s", "time/s", "from", "ID", "bytes", "meaning")});
}

View::Row View::row(Micros time, bool received, const CO_IF_FRM& frame, const std::string& meaning) const {
  const double seconds = static_cast<double>(time) / static_cast<double>(second);
  return {colour_of(received, meaning), text("%9.3f  %-6s  %s  %-23s  ", seconds, received ? style_.others : "node",
                                             identifier(frame).c_str(), bytes(frame).c_str()) +
                                            meaning};
}

/// Returns true if frames have been left out.
bool View::is_folding() const { return segments_ > segments_shown + fewest_folded; }

void View::frame(Micros time, bool received, const CO_IF_FRM& frame) {
  const trace::Meaning meaning = decoder_.decode(frame);
  if (meaning.place == trace::Place::middle && !style_.every_frame) {
    if (++segments_; !is_folding()) {
      show_or_hold_back(row(time, received, frame, meaning.text));
    }
    return;
  }
  if (meaning.place == trace::Place::edge || !is_folding()) {  // frames of other services may occur in between
    end_fold();
  }
  print_row(row(time, received, frame, meaning.text));
}

void View::show_or_hold_back(const Row& row) {
  if (segments_ <= segments_shown) {
    print_row(row);
  } else {
    held_back_.push_back(row);
  }
}

void View::progress(const std::string& text) {
  if (!is_folding()) {
    end_fold();
  }
  const std::string line = lexican::text("%9s  ", "") + text;
  if (!style_.terminal) {
    print_row({grey, line});
    return;
  }
  out_ << erase_line << line << std::flush;
  bar_shown_ = true;
}

void View::heading(unsigned number, const std::string& title) {
  end_fold();
  print_row({plain, ""});
  print_row({bold, text("%2u. ", number) + title});
}

void View::finding(bool good, const std::string& text) { note(good ? "ok" : "FAILED", text, good ? green : red); }

void View::note(const char* label, const std::string& text, const char* colour) {
  end_fold();
  print_row({colour, lexican::text("%9s  ", label) + text});
}

void View::end_fold() {
  if (is_folding()) {
    print_row({grey, text("%9s  %u more frames of this transfer", "...", segments_ - segments_shown)});
  } else {
    for (const Row& row : held_back_) {
      print_row(row);
    }
  }
  held_back_.clear();
  segments_ = 0;
}

}  // namespace lexican::demo
