// SPDX-License-Identifier: Apache-2.0
#include "client/progress.hpp"

#include <algorithm>
#include <utility>

#include "trace/text.hpp"

namespace lexican {
namespace {

constexpr unsigned bar_width = 30;
constexpr Micros between_bars = 100 * millisecond;
constexpr Micros between_lines = second;

unsigned part(const Amount& amount, unsigned whole) {
  return static_cast<unsigned>(std::uint64_t{amount.done} * whole / amount.total);
}

std::string bar(const Amount& amount) {
  const unsigned filled = std::min(part(amount, bar_width), bar_width);
  return '[' + std::string(filled, '#') + std::string(bar_width - filled, '.') + "] " +
         text("%3u %%  ", part(amount, 100));
}

std::string rate(const Amount& amount) {
  const double seconds = static_cast<double>(amount.elapsed) / static_cast<double>(second);
  return amount.elapsed == 0 ? std::string() : text(", %.1f kB/s", amount.done / seconds / 1000);
}

}  // namespace

std::string progress_text(const Amount& amount) {
  if (amount.total == 0) {
    return text("%u bytes", amount.done) + rate(amount);
  }
  return bar(amount) + text("%u of %u bytes", amount.done, amount.total) + rate(amount);
}

Progress::Progress(Form form, std::function<void(const std::string&)> show) : form_(form), show_(std::move(show)) {}

bool Progress::is_due(const Amount& amount) const {
  switch (form_) {
    case Form::none: return false;
    case Form::bar: return amount.done > 0 && amount.elapsed >= shown_at_ + between_bars;
    case Form::lines: break;
  }
  return amount.total == 0 ? amount.elapsed >= shown_at_ + between_lines : part(amount, 4) > quarters_;
}

void Progress::update(const Amount& amount) {
  if (!is_due(amount)) {
    return;
  }
  quarters_ = amount.total == 0 ? 0 : part(amount, 4);
  shown_at_ = amount.elapsed;
  show_(progress_text(amount));
}

}  // namespace lexican
