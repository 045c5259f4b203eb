// SPDX-License-Identifier: Apache-2.0
/// \file progress.hpp
/// How far a long transfer is, for people: a bar that moves, or a few lines.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "host/host.hpp"

namespace demo {

/// A moment of a transfer: bytes, and time since its begin.
struct Amount {
  std::uint32_t done;
  std::uint32_t total;  // 0: not known
  Micros elapsed;
};

/// The state in one line: "[#####.....]  50 %  5000 of 10000 bytes, 25.0 kB/s".
std::string progress_text(const Amount& amount);

/// Decides when there is something new to be said.
class Progress {
 public:
  enum class Form {
    none,
    lines,  // one at each quarter; every second if the total is not known
    bar,    // ten times a second once something was transferred, each in place of the one before
  };

  /// \a show is given the texts.
  Progress(Form form, std::function<void(const std::string&)> show);
  void update(const Amount& amount);

 private:
  bool is_news(const Amount& amount) const;

  Form form_;
  std::function<void(const std::string&)> show_;
  std::uint32_t quarters_ = 0;  // that were said
  Micros said_at_ = 0;
};

}  // namespace demo
