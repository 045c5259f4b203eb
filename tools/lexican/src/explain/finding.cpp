// SPDX-License-Identifier: Apache-2.0
#include "explain/finding.hpp"

#include <algorithm>
#include <iterator>

namespace lexican::explain {

void Evidence::add(const Entry& entry, const std::string& words) {
  add(entry.time, frames_.size() < most_frames ? host_bus::to_text(entry.frame) + "  " + words : words);
}

void Evidence::add(Micros time, const std::string& words) {
  since_ = count_ == 0 ? time : std::min(since_, time);
  until_ = std::max(until_, time);
  ++count_;
  if (frames_.size() < most_frames) {
    const auto later =
        std::find_if(frames_.begin(), frames_.end(), [&](const ShownFrame& shown) { return shown.time > time; });
    frames_.insert(later, {time, words});
  }
  if (times_.size() < most_times) {
    times_.push_back(time);
  }
}

void Evidence::show_also(const Evidence& other) {
  if (other.frames_.empty()) {
    return;
  }
  if (frames_.size() == most_frames) {
    frames_.pop_back();
  }
  add(other.frames_.front().time, other.frames_.front().text);
}

void Findings::put(Finding finding) {
  if (accepts(finding.cause, finding.node, finding.detail)) {
    all_[{finding.cause, finding.node, finding.detail}] = std::move(finding);
  } else {
    is_cut_ = true;
  }
}

bool Findings::accepts(CauseId cause, std::uint8_t node, std::uint32_t detail) const {
  return all_.find({cause, node, detail}) != all_.end() || count(cause) < most_of_cause;
}

std::size_t Findings::count(CauseId cause) const {
  const auto begin = all_.lower_bound({cause, 0, 0});
  const auto is_of_cause = [=](const auto& item) { return std::get<0>(item.first) == cause; };
  return static_cast<std::size_t>(std::distance(begin, std::find_if_not(begin, all_.end(), is_of_cause)));
}

bool Findings::has(CauseId cause, std::uint8_t node) const {
  const auto found = all_.lower_bound({cause, node, 0});
  return found != all_.end() && std::get<0>(found->first) == cause && std::get<1>(found->first) == node;
}

}  // namespace lexican::explain
