// SPDX-License-Identifier: Apache-2.0
#include "program/terminal.hpp"

#include <curses.h>
#include <fmt/format.h>
#include <langinfo.h>
#include <unistd.h>

#include <clocale>
#include <cstdlib>
#include <regex>
#include <string_view>

namespace lexican::program {

struct Terminal::Handle {
  SCREEN* screen;
};

namespace {

constexpr int escape_delay = 50;  // ms in which the rest of a key's sequence has to follow

enum Pair : short { red_pair = 1, green_pair, title_pair };

attr_t attributes_of(const Piece& piece) {
  const bool has_pairs = COLOR_PAIRS > title_pair;
  attr_t result = piece.is_selected ? A_REVERSE : A_NORMAL;
  switch (piece.colour) {
    case Colour::red: result |= has_pairs ? COLOR_PAIR(red_pair) : A_BOLD; break;
    case Colour::green: result |= has_pairs ? COLOR_PAIR(green_pair) : A_NORMAL; break;
    case Colour::title: result |= A_BOLD | (has_pairs ? COLOR_PAIR(title_pair) : A_NORMAL); break;
    case Colour::plain: break;
  }
  return result;
}

void start_colours() {
  if (!has_colors() || std::getenv("NO_COLOR") != nullptr) {
    return;
  }
  start_color();
  const short background = use_default_colors() == OK ? short{-1} : short{COLOR_BLACK};
  init_pair(red_pair, COLOR_RED, background);
  init_pair(green_pair, COLOR_GREEN, background);
  init_pair(title_pair, COLOR_CYAN, background);
}

std::uint32_t special_key(wint_t key) {
  switch (key) {
    case KEY_UP: return up_key;
    case KEY_DOWN: return down_key;
    case KEY_LEFT: return left_key;
    case KEY_RIGHT: return right_key;
    case KEY_PPAGE: return page_up_key;
    case KEY_NPAGE: return page_down_key;
    case KEY_BACKSPACE: return backspace_key;
    case KEY_ENTER: return enter_key;
    case KEY_RESIZE: return resize_key;
    default: return other_key;
  }
}

/// Returns true if the environment names a locale with UTF-8, or none.
bool wants_unicode() {
  for (const char* const variable : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* const value = std::getenv(variable);
    if (value != nullptr && *value != '\0') {
      return std::regex_search(value, std::regex("utf-?8", std::regex::icase));
    }
  }
  return true;
}

}  // namespace

std::string Terminal::fault() {
  const char* const name = std::getenv("TERM");
  const bool has_name = name != nullptr && *name != '\0' && std::string_view(name) != "dumb";
  return isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0 ? "input and output are not a terminal"
         : !has_name                                             ? "TERM names no terminal that can show a screen"
                                                                 : "";
}

std::unique_ptr<Terminal> Terminal::open(std::string& why) {
  std::setlocale(LC_CTYPE, "");
  if (std::string_view(nl_langinfo(CODESET)) != "UTF-8" && wants_unicode()) {
    std::setlocale(LC_CTYPE, "C.UTF-8");  // no locale was chosen, or one that is not installed
  }
  const bool has_unicode = std::string_view(nl_langinfo(CODESET)) == "UTF-8";
  SCREEN* const screen = newterm(nullptr, stdout, stdin);
  if (screen == nullptr) {
    why = fmt::format(
        "terminfo has no entry for '{}' (TERM); a package such as ncurses-base or ncurses-term has the file",
        std::getenv("TERM"));
    return nullptr;
  }
  set_term(screen);
  set_escdelay(escape_delay);
  start_colours();
  cbreak();  // Ctrl-C remains a signal
  noecho();
  nodelay(stdscr, TRUE);
  keypad(stdscr, TRUE);
  curs_set(0);
  return std::unique_ptr<Terminal>(new Terminal(std::make_unique<Handle>(Handle{screen}), has_unicode));
}

Terminal::Terminal(std::unique_ptr<Handle> handle, bool has_unicode)
    : handle_(std::move(handle)), has_unicode_(has_unicode) {}

Terminal::~Terminal() {
  endwin();
  delscreen(handle_->screen);
}

std::uint32_t Terminal::key() {
  wint_t key = 0;
  switch (get_wch(&key)) {
    case KEY_CODE_YES:
      if (key == KEY_RESIZE) {
        shown_.clear();
        erase();
      }
      return special_key(key);
    case OK:
      return key == '\r' ? std::uint32_t{enter_key} : key == 0x7F || key == 0x08 ? std::uint32_t{backspace_key} : key;
    default: return no_key;
  }
}

unsigned Terminal::columns() const { return static_cast<unsigned>(COLS); }
unsigned Terminal::rows() const { return static_cast<unsigned>(LINES); }

void Terminal::show(const Screen& screen) {
  shown_.resize(screen.lines.size());
  for (std::size_t row = 0; row < screen.lines.size(); ++row) {
    if (shown_[row] == screen.lines[row]) {
      continue;
    }
    shown_[row] = screen.lines[row];
    move(static_cast<int>(row), 0);
    std::size_t width = 0;
    for (const Piece& piece : shown_[row]) {
      attrset(static_cast<int>(attributes_of(piece)));
      addstr(piece.text.c_str());
      width += width_of(piece.text);
    }
    attrset(A_NORMAL);
    if (width < columns()) {
      clrtoeol();
    }
  }
  curs_set(screen.cursor ? 1 : 0);
  if (screen.cursor) {
    move(LINES - 1, static_cast<int>(*screen.cursor));
  }
  refresh();
}

}  // namespace lexican::program
