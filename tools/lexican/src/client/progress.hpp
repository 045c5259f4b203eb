// SPDX-License-Identifier: Apache-2.0
/// \file progress.hpp
/// Progress of a long transfer as text: a progress bar, or a few lines.
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>

#include "host/host.hpp"

namespace lexican {

/// State of a transfer: bytes, and time since its start.
struct Amount {
  std::uint32_t done;
  std::uint32_t total;  // 0: unknown
  Micros elapsed;
};

/// Returns the state in one line: "[#####.....]  50 %  5000 of 10000 bytes, 25.0 kB/s".
std::string progress_text(const Amount& amount);

/// Limits how often the progress is shown.
class Progress {
 public:
  enum class Form {
    none,
    lines,  // one at each quarter; every second if the total is not known
    bar,    // ten times a second after the first byte, each replaces the previous one
  };

  /// \a show: called with each text.
  Progress(Form form, std::function<void(const std::string&)> show);
  void update(const Amount& amount);

 private:
  bool is_due(const Amount& amount) const;

  Form form_;
  std::function<void(const std::string&)> show_;
  std::uint32_t quarters_ = 0;  // already shown
  Micros shown_at_ = 0;         // elapsed time when the last text was shown
};

/// Prints the texts of a Progress. A bar overwrites the previous one in the same line, which end() ends.
class ProgressLine {
 public:
  ProgressLine(std::ostream& err, Progress::Form form)
      : err_(err),
        is_bar_(form == Progress::Form::bar),
        progress_(form, [this](const std::string& text) { show(text); }) {}

  void update(const Amount& amount) {
    last_ = amount;
    progress_.update(amount);
  }

  void end() {
    if (begun_) {
      show(progress_text(last_));
      err_ << std::endl;
    }
  }

 private:
  void show(const std::string& text) {
    err_ << (is_bar_ ? "\r" + text + "\033[K" : text + '\n') << std::flush;
    begun_ = is_bar_;
  }

  std::ostream& err_;
  bool is_bar_;
  bool begun_ = false;  // a bar was printed, and its line has not been ended
  Progress progress_;
  Amount last_{};
};

}  // namespace lexican
