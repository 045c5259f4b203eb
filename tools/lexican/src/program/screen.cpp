// SPDX-License-Identifier: Apache-2.0
#include "program/screen.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "program/printable.hpp"

namespace lexican::program {
namespace {

using host_bus::Micros;

constexpr std::size_t narrow = 60;  // columns below which less is shown

constexpr const char* short_key_hint = "r w n s /  ? help  q quit";
constexpr std::string_view key_hint = "r read  w write  n NMT  s scan  / filter  ? help  q quit";
constexpr const char* help_text =
    "Up, Down, PgUp, PgDn  select a node\n"
    "Left, Right           values that do not fit\n"
    "r  read an object: 606C, 1018:4 or a name\n"
    "w  write an object: 6081 2000\n"
    "n  NMT: start, stop, preop, reset, reset-comm\n"
    "   of the node; start all: of all nodes\n"
    "s  scan: ask each node-ID who is there\n"
    "/  filter of the events, empty: none\n"
    "Esc  end a prompt, cancel a transfer\n"
    "q  quit\n"
    "--type u16 behind an object: its type";

char32_t code_of(std::string_view character) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(character[n]); };
  char32_t code = character.size() == 1 ? byte(0) : byte(0) & (0x7FU >> character.size());
  for (std::size_t n = 1; n < character.size(); ++n) {
    code = code << 6U | (byte(n) & 0x3FU);
  }
  return code;
}

/// Returns the columns of a character; 0: it changes the one before.
unsigned columns_of(std::string_view character) {
  const char32_t code = code_of(character);
  const auto is_in = [code](char32_t first, char32_t last) { return code >= first && code <= last; };
  const bool is_combining = is_in(0x300, 0x36F) || is_in(0x200B, 0x200F) || is_in(0x2060, 0x2064) ||
                            is_in(0x20D0, 0x20FF) || is_in(0xFE00, 0xFE0F) || is_in(0xFE20, 0xFE2F) || code == 0xFEFF;
  const bool is_wide = is_in(0x1100, 0x115F) || is_in(0x2E80, 0xA4CF) || is_in(0xAC00, 0xD7A3) ||
                       is_in(0xF900, 0xFAFF) || is_in(0xFE30, 0xFE6F) || is_in(0xFF00, 0xFF60) ||
                       is_in(0xFFE0, 0xFFE6) || is_in(0x1F300, 0x1FAFF) || is_in(0x20000, 0x3FFFD);
  return is_combining ? 0 : is_wide ? 2 : 1;
}

/// Calls \a with for each character of a printable text.
template <typename With>
void for_each_character(std::string_view text, With with) {
  while (!text.empty()) {
    const std::string_view character = text.substr(0, std::max<std::size_t>(length_of_character(text), 1));
    with(character);
    text.remove_prefix(character.size());
  }
}

std::string age_text(Micros now, Micros time) {
  const Micros seconds = now > time ? (now - time) / 1'000'000 : 0;
  return seconds == 0      ? "<1 s"
         : seconds < 120   ? fmt::format("{} s", seconds)
         : seconds < 7'200 ? fmt::format("{} min", seconds / 60)
                           : fmt::format("{} h", seconds / 3'600);
}

/// Draws one screen.
class Drawing {
 public:
  Drawing(const BusState& state, const View& view, std::size_t columns, std::size_t rows)
      : state_(state), view_(view), columns_(columns), rows_(rows), heard_(state.heard()) {
    selected_ = selected_node(heard_, view.selected);
  }

  Screen draw() {
    const std::vector<std::string> result = wrapped_result();
    const std::size_t fixed = 2 + result.size();  // with the first and the last line
    const std::size_t body = rows_ > fixed ? rows_ - fixed : 0;
    add_title();
    view_.has_help ? add_help(body) : add_body(body);
    for (const std::string& line : result) {
      add(line, view_.is_result_fault ? Colour::red : Colour::plain);
    }
    screen_.lines.resize(std::max<std::size_t>(rows_, 2) - 1);
    add_command();
    if (rows_ < screen_.lines.size()) {
      screen_.lines.erase(screen_.lines.begin());
    }
    std::for_each(screen_.lines.begin(), screen_.lines.end(), [this](ScreenLine& line) { limit(line); });
    return std::move(screen_);
  }

 private:
  /// Returns a text with at most \a width columns, filled with spaces up to these if \a is_padded.
  std::string fit(std::string_view text, std::size_t width, bool is_padded = true) const {
    std::string result;
    std::string short_result;  // with a column for the sign that the text is longer
    std::size_t used = 0;
    std::size_t short_used = 0;
    bool is_short = true;
    for_each_character(text, [&](std::string_view character) {
      const bool is_known = view_.has_unicode || character.size() == 1;
      const std::string_view shown = is_known && columns_of(character) > 0 ? character : std::string_view("?");
      const std::size_t next = shown == character ? columns_of(shown) : 1;
      is_short = is_short && used + next <= width;
      if (!is_short) {
        return;
      }
      result += shown;
      used += next;
      if (used < width) {
        short_result = result;
        short_used = used;
      }
    });
    if (!is_short && width > 0) {
      result = short_result + (view_.has_unicode ? "…" : "~");
      used = short_used + 1;
    }
    return is_padded && used < width ? result + std::string(width - used, ' ') : result;
  }

  /// Shortens a line of a screen that is too narrow for its columns.
  void limit(ScreenLine& line) const {
    std::size_t used = 0;
    for (Piece& piece : line) {
      piece.text = fit(piece.text, columns_ - used, false);
      used += width_of(piece.text);
    }
  }

  void add(std::string_view text, Colour colour = Colour::plain, bool is_padded = false) {
    screen_.lines.push_back({{fit(text, columns_, is_padded), colour}});
  }

  /// Returns the lines of a text, broken at spaces where possible.
  std::vector<std::string> lines_of(std::string_view text) const {
    std::vector<std::string> lines(1);
    for_each_character(text, [&](std::string_view character) {
      if (character != "\n" && width_of(lines.back()) + columns_of(character) > columns_) {
        const std::size_t space = lines.back().rfind(' ');
        const bool has_space = space != std::string::npos && space + 1 < lines.back().size();
        const std::string rest = has_space ? lines.back().substr(space + 1) : std::string();
        lines.back().resize(has_space ? space : lines.back().size());
        lines.push_back(rest);
      }
      if (character == "\n") {
        lines.emplace_back();
      } else {
        lines.back() += character;
      }
    });
    return lines;
  }

  /// Returns the lines of the last result; the last ones are left out if they take more than a third of the screen.
  std::vector<std::string> wrapped_result() const {
    std::vector<std::string> lines = lines_of(view_.result);
    while (!lines.empty() && (lines.back().empty() || lines.size() > std::max<std::size_t>(rows_ / 3, 1))) {
      lines.pop_back();
    }
    return lines;
  }

  void add_title() {
    const bool is_narrow = columns_ < narrow;
    const std::string condition = !view_.condition.empty() ? view_.condition
                                  : state_.errors() != 0   ? fmt::format("{} error frames", state_.errors())
                                  : state_.frames() == 0   ? "no frame yet"
                                                           : "ok";
    const std::string rate =
        view_.bit_rate == 0 ? std::string() : fmt::format(" {}{}", view_.bit_rate / 1000, is_narrow ? "k" : " kbit/s");
    const std::string load = view_.bit_rate == 0
                                 ? std::string("-")
                                 : fmt::format("{:.1f} %", 100 * state_.bits_per_second() / view_.bit_rate);
    const std::string text = is_narrow ? fmt::format("{}{} {} {:.0f}/s {} lost ", view_.bus, rate, load,
                                                     state_.frames_per_second(), view_.lost)
                                       : fmt::format(" {}{}  load {}  {:.0f} frames/s  {} lost  ", view_.bus, rate,
                                                     load, state_.frames_per_second(), view_.lost);
    const bool is_fault = !view_.condition.empty() || state_.errors() != 0;
    const std::string begin = fit(text, columns_, false);
    screen_.lines.push_back(
        {{begin, Colour::title, true},
         {fit(condition, columns_ - width_of(begin)), is_fault ? Colour::red : Colour::title, true}});
  }

  void add_help(std::size_t rows) {
    const std::vector<std::string> lines = lines_of(help_text);
    has_more_help_ = lines.size() > rows;
    screen_.help_line = has_more_help_ ? std::min(view_.help_line, lines.size() - rows) : 0;
    for (std::size_t n = screen_.help_line; n < lines.size(); ++n) {
      add(lines[n]);
    }
    screen_.lines.resize(1 + rows);
  }

  void add_body(std::size_t rows) {
    const std::size_t part = std::max<std::size_t>(rows / 3, 2) - 1;  // lines without heading
    const std::size_t end = 1 + rows;
    add_nodes(part);
    add_values(part);
    screen_.lines.resize(std::min(screen_.lines.size(), end));
    const std::size_t rest = end - screen_.lines.size();
    if (rest > 0) {
      add(view_.filter.empty() ? std::string("events") : "events with '" + view_.filter + "'", Colour::title, true);
      add_events(rest - 1);
    }
    screen_.lines.resize(end);
  }

  void add_nodes(std::size_t most) {
    const std::size_t shown = std::min(most, heard_.size());
    const auto at = static_cast<std::size_t>(std::find(heard_.begin(), heard_.end(), selected_) - heard_.begin());
    const std::size_t first = std::min(at > shown / 2 ? at - shown / 2 : 0, heard_.size() - shown);
    const std::size_t name = columns_ >= narrow ? (columns_ - 32) / 2 : 0;
    const std::size_t emergency = columns_ > 33 + name ? columns_ - 33 - name : 0;
    const std::string more = shown >= heard_.size() ? std::string()
                             : shown == 1           ? fmt::format(" ({} of {})", first + 1, heard_.size())
                                          : fmt::format(" ({}-{} of {})", first + 1, first + shown, heard_.size());
    // A narrow screen has space for the numbers only where the states are.
    const std::string state = name != 0 || more.empty() ? "state" : more.substr(1);
    add(fmt::format("node {:<19}heard  {}", state, fit(name != 0 ? "last EMCY" : "EMCY", emergency)) +
            (name != 0 ? "  name" + more : ""),
        Colour::title, true);
    if (heard_.empty()) {
      add("no node was heard; s scans");
    }
    for (std::size_t n = first; n < first + shown; ++n) {
      add_node(heard_[n], name, emergency);
    }
  }

  void add_node(std::uint8_t id, std::size_t name_width, std::size_t emergency_width) {
    const WatchedNode& node = state_.node(id);
    const bool is_overdue = node.is_overdue(state_.now());
    const bool is_selected = id == selected_;
    const Colour colour = is_overdue ? Colour::red : node.state == 0x05 ? Colour::green : Colour::plain;
    const std::string age =
        node.state ? age_text(state_.now(), node.state_time) + (is_overdue ? "!" : " ") : std::string("- ");
    const std::string emergency =
        node.emergency.empty() ? std::string("-") : age_text(state_.now(), node.emergency_time) + ": " + node.emergency;
    ScreenLine line = {
        {fmt::format("{:>4} ", id), Colour::plain, is_selected},
        {fit(node.state ? state_text(*node.state) : "not seen", 16) + fmt::format("{:>9}  ", age), colour, is_selected},
        {fit(emergency, emergency_width), node.is_faulty ? Colour::red : Colour::plain, is_selected}};
    if (name_width != 0) {
      line.push_back({fit("  " + node.name, name_width), Colour::plain, is_selected});
    }
    screen_.lines.push_back(std::move(line));
  }

  /// A value takes two lines if all values have enough space, so that its plot is higher.
  void add_values(std::size_t most) {
    if (selected_ == 0) {
      return;
    }
    const WatchedNode& node = state_.node(selected_);
    const std::size_t count = node.values.size();
    const std::size_t shown = std::min(most, count);
    const std::size_t first = std::min(view_.first_value, count - shown);
    std::string heading = fmt::format("PDO values of node {}", selected_);
    heading += shown < count ? fmt::format(" ({}-{} of {})", first + 1, first + shown, count) : "";
    add(heading, Colour::title, true);
    if (count == 0) {
      add(state_.is_described(selected_) ? "none was received" : "they need a description: --eds FILE");
      return;
    }
    const std::size_t height = 2 * count <= most ? 2 : 1;
    const std::size_t plot = columns_ >= narrow && view_.has_unicode ? std::min<std::size_t>(columns_ / 3, 80) : 0;
    auto value = std::next(node.values.begin(), static_cast<std::ptrdiff_t>(first));
    for (std::size_t n = 0; n < shown; ++n, ++value) {
      add_value(value->first, value->second, plot, height);
    }
  }

  void add_value(const WatchedNode::ValueKey& key, const WatchedValue& value, std::size_t plot, std::size_t height) {
    const std::size_t rest = columns_ - (plot == 0 ? 0 : plot + 1);
    const std::string pdo =
        columns_ < narrow ? "" : fmt::format("{}{} ", std::get<0>(key) ? "RPDO" : "TPDO", std::get<1>(key));
    const std::size_t name = rest * 3 / 5;
    std::vector<std::string> curve(height);
    if (plot != 0 && !value.points.empty()) {
      constexpr double step = 0.25;  // s; a later screen is equal if the value is
      const double now = static_cast<double>(state_.now() - state_.first()) / 1e6;
      describe::Range range = describe::range_of(value.points);
      range.to = static_cast<double>(static_cast<std::uint64_t>(now / step) + 1) * step;
      range.from = range.to - BusState::plotted_seconds;
      curve = describe::braille(value.points, range, static_cast<unsigned>(plot), static_cast<unsigned>(height));
    }
    for (std::size_t row = 0; row < height; ++row) {
      const std::string text =
          row == 0 ? fit(pdo + one_line(value.name), name) + " " + fit(one_line(value.text), rest - name - 1)
                   : std::string(rest, ' ');
      screen_.lines.push_back({{text}, {plot == 0 ? "" : " " + curve[row], Colour::green}});
    }
  }

  /// The newest event is the last line.
  void add_events(std::size_t most) {
    std::vector<const LoggedEvent*> shown;
    const auto& events = state_.events();
    for (auto event = events.rbegin(); event != events.rend() && shown.size() < most; ++event) {
      if (view_.filter.empty() || contains_ignoring_case(text_of(*event), view_.filter)) {
        shown.push_back(&*event);
      }
    }
    std::for_each(shown.rbegin(), shown.rend(), [&](const LoggedEvent* event) {
      add(text_of(*event), event->is_fault ? Colour::red : Colour::plain);
    });
  }

  std::string text_of(const LoggedEvent& event) const {
    const Micros time = event.time > state_.first() ? event.time - state_.first() : 0;
    return fmt::format("{:9.3f} {:>3}  {}", static_cast<double>(time) / 1e6,
                       event.node == 0 ? "-" : std::to_string(event.node), event.text);
  }

  void add_command() {
    if (view_.prompt.empty() && view_.has_help) {
      add(has_more_help_ ? "Up, Down scroll; other keys end the help" : "each key ends the help", Colour::title, true);
      return;
    }
    if (view_.prompt.empty()) {
      const std::string hint(key_hint.size() <= columns_ ? key_hint : short_key_hint);
      add(view_.command.empty() ? hint : view_.command, Colour::title, true);
      return;
    }
    // The end of a long text is shown, where it is typed.
    std::string text = view_.prompt + ' ' + view_.input;
    while (width_of(text) + 1 > columns_ && !text.empty()) {
      text.erase(0, std::max<std::size_t>(length_of_character(text), 1));
    }
    add(text);
    screen_.cursor = static_cast<unsigned>(std::min(width_of(text), columns_ - 1));
  }

  const BusState& state_;
  const View& view_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<std::uint8_t> heard_;
  std::uint8_t selected_ = 0;
  bool has_more_help_ = false;
  Screen screen_;
};

}  // namespace

std::uint8_t selected_node(const std::vector<std::uint8_t>& heard, std::uint8_t selected) {
  const bool is_heard = std::find(heard.begin(), heard.end(), selected) != heard.end();
  return is_heard ? selected : heard.empty() ? std::uint8_t{0} : heard.front();
}

std::size_t width_of(std::string_view text) {
  std::size_t width = 0;
  for_each_character(text, [&](std::string_view character) { width += columns_of(character); });
  return width;
}

Screen draw(const BusState& state, const View& view, unsigned columns, unsigned rows) {
  return Drawing(state, view, columns, rows).draw();
}

}  // namespace lexican::program
