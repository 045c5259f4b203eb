// SPDX-License-Identifier: Apache-2.0
/// \file screen.hpp
/// The screen of `lexican top` as lines of text, without a terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/bus_state.hpp"

namespace lexican::program {

enum class Colour : std::uint8_t { plain, red, green, title };

/// Part of a line in one colour.
struct Piece {
  std::string text;  ///< printable, without line ends
  Colour colour = Colour::plain;
  bool is_selected = false;
};
inline bool operator==(const Piece& a, const Piece& b) {
  return a.text == b.text && a.colour == b.colour && a.is_selected == b.is_selected;
}
using ScreenLine = std::vector<Piece>;

struct Screen {
  std::vector<ScreenLine> lines;   ///< as many as the terminal has, each of its columns at most
  std::optional<unsigned> cursor;  ///< column in the last line; nothing: no text is typed
  std::size_t help_line = 0;       ///< of the help, the first one shown
};

/// Contents of the screen besides the state of the bus.
struct View {
  std::string bus;
  std::uint32_t bit_rate = 0;  ///< 0: unknown
  std::uint64_t lost = 0;
  std::string condition;  ///< of the bus, if it is not usable; empty: it is
  std::uint8_t selected = 0;
  std::size_t first_value = 0;  ///< of the selected node
  std::string filter;           ///< of the events
  std::string result;           ///< of the last command, with line ends
  bool is_result_fault = false;
  std::string command;  ///< command line of the last command
  std::string prompt;   ///< empty: no text is typed
  std::string input;    ///< behind the prompt
  bool has_help = false;
  std::size_t help_line = 0;  ///< of the help, the first one to be shown
  bool has_unicode = true;    ///< the terminal shows UTF-8
};

/// Returns the node of the view, or the first one if it was not heard; 0: none was heard.
std::uint8_t selected_node(const std::vector<std::uint8_t>& heard, std::uint8_t selected);

/// Draws the screen. \a columns, \a rows: at least 1; a terminal of 40 x 10 shows each part.
Screen draw(const BusState& state, const View& view, unsigned columns, unsigned rows);

/// Returns the number of columns that a text takes.
std::size_t width_of(std::string_view text);

}  // namespace lexican::program
