// SPDX-License-Identifier: Apache-2.0
/// \file terminal.hpp
/// The terminal as a screen (ncurses).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "program/screen.hpp"

namespace lexican::program {

/// Keys that are not characters; beyond Unicode.
enum Key : std::uint32_t {
  no_key = 0,
  enter_key = 0x0A,
  escape_key = 0x1B,
  first_special_key = 0x200000,
  up_key,
  down_key,
  left_key,
  right_key,
  page_up_key,
  page_down_key,
  backspace_key,
  resize_key,
  other_key,
};

/// Uses the terminal of the program during its lifetime, and restores it afterwards. One instance at a time.
class Terminal {
 public:
  /// Returns why the program has no terminal that can show a screen; empty: it may have one.
  static std::string fault();
  /// \retval nullptr  the program has no terminal that can show a screen; \a why says why
  static std::unique_ptr<Terminal> open(std::string& why);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Returns the next key that was typed, a character of Unicode or a Key; no_key: none.
  std::uint32_t key();
  /// Transmits the lines that differ from the last screen.
  void show(const Screen& screen);
  unsigned columns() const;
  unsigned rows() const;
  bool has_unicode() const { return has_unicode_; }

 private:
  struct Handle;
  Terminal(std::unique_ptr<Handle> handle, bool has_unicode);

  std::unique_ptr<Handle> handle_;
  bool has_unicode_;
  std::vector<ScreenLine> shown_;
};

}  // namespace lexican::program
