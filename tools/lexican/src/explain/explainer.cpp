// SPDX-License-Identifier: Apache-2.0
#include "explain/explainer.hpp"

#include <algorithm>
#include <bitset>

namespace lexican::explain {
namespace {

constexpr Micros advance_interval = 10 * one_ms;

/// A cause that explains another one at the same node. A cause that is explained explains no others: the order counts.
struct Consequence {
  CauseId cause;
  CauseId of;
  bool is_anywhere;  ///< the node does not matter
};

constexpr Consequence consequences[] = {
    {CauseId::bus_errors, CauseId::bus_off, true},
    {CauseId::boot_loop, CauseId::same_node_id, false},
    {CauseId::restarted, CauseId::same_node_id, false},
    {CauseId::restarted, CauseId::boot_loop, false},
    {CauseId::error_active, CauseId::emcy_storm, false},
    {CauseId::cob_id_collision, CauseId::same_node_id, false},
    {CauseId::pdo_length, CauseId::same_node_id, false},
    {CauseId::sdo_busy, CauseId::same_node_id, false},
    {CauseId::segments_lost, CauseId::same_node_id, false},
    {CauseId::toggle_wrong, CauseId::same_node_id, false},
    {CauseId::heartbeat_time, CauseId::same_node_id, false},
    {CauseId::heartbeat_missing, CauseId::same_node_id, false},
    {CauseId::heartbeat_missing, CauseId::boot_loop, false},
    {CauseId::emcy_storm, CauseId::heartbeat_time, false},
    {CauseId::emcy_storm, CauseId::pdo_length, false},
    {CauseId::emcy_storm, CauseId::rpdo_missing, false},
    {CauseId::heartbeat_missing, CauseId::bus_off, false},
    {CauseId::sdo_busy, CauseId::heartbeat_missing, false},
    {CauseId::toggle_wrong, CauseId::sdo_busy, false},
    {CauseId::segments_lost, CauseId::heartbeat_missing, false},
    {CauseId::segments_lost, CauseId::boot_loop, false},
    {CauseId::segments_lost, CauseId::toggle_wrong, false},
    {CauseId::sdo_busy, CauseId::segments_lost, false},
    {CauseId::pdo_length, CauseId::cob_id_collision, false},
};

}  // namespace

Explainer::Explainer(const describe::Network& network, std::uint32_t bit_rate, describe::Monitor::Identified identified)
    : monitor_(
          network,
          [this](const describe::Event& event) {
            faults_ += event.is_fault ? 1U : 0U;
            if (event.sdo == nullptr) {
              return;
            }
            facts_.transfer(event.node, *event.sdo);
            for (const std::unique_ptr<Check>& check : checks_) {
              check->transfer(event.node, *event.sdo);
            }
          },
          std::move(identified)),
      facts_(network, monitor_, bit_rate) {
  checks_.push_back(make_bus_check(facts_, findings_));
  checks_.push_back(make_error_control_check(facts_, findings_));
  checks_.push_back(make_emcy_check(facts_, findings_));
  checks_.push_back(make_lss_check(facts_, findings_));
  checks_.push_back(make_pdo_check(facts_, findings_));
  checks_.push_back(make_sync_check(facts_, findings_));
  checks_.push_back(make_sdo_check(facts_, findings_));
}

void Explainer::process(const Entry& received) {
  Entry entry = received;
  entry.frame.DLC = std::min<std::uint8_t>(entry.frame.DLC, 8);
  entry.time = continuous(entry.time);
  for (const std::unique_ptr<Check>& check : checks_) {
    check->frame(entry);
  }
  facts_.frame(entry);
  monitor_.process(entry);
  advance(entry.time);
}

/// Several logs in one, or a clock that was set, let the time jump: that is a pause.
Micros Explainer::continuous(Micros time) {
  constexpr Micros longest_pause = 3600 * one_second;
  constexpr Micros pause = 60 * one_second;
  const Micros last = facts_.now();
  const Micros shifted = time + shift_;  // modulo 2^64
  const bool is_jump = last != 0 && shifted - last > longest_pause && last - shifted > one_second;
  if (is_jump) {
    shift_ = last + pause - time;
    facts_.forget_states();
    return last + pause;
  }
  return std::max(shifted, last);
}

void Explainer::advance(Micros now) {
  if (now < advanced_ + advance_interval) {
    return;
  }
  advanced_ = now;
  monitor_.expire(now);
  for (const std::unique_ptr<Check>& check : checks_) {
    check->advance(now);
  }
}

void Explainer::finish() {
  monitor_.finish();
  for (const std::unique_ptr<Check>& check : checks_) {
    check->advance(std::max(facts_.now(), advanced_));
  }
}

std::vector<Finding> Explainer::findings() const {
  std::map<Findings::Key, Finding> all = findings_.all();
  for (const Consequence& row : consequences) {
    std::bitset<128> nodes;  // with the cause
    for (const auto& item : all) {
      nodes[item.second.node] = nodes[item.second.node] || item.second.cause == row.of;
    }
    for (auto item = all.begin(); item != all.end();) {
      const Finding& finding = item->second;
      const bool is_explained =
          finding.cause == row.cause && (row.is_anywhere ? nodes.any() : nodes.test(finding.node));
      item = is_explained ? all.erase(item) : std::next(item);
    }
  }
  std::vector<Finding> left;
  for (const auto& item : all) {
    left.push_back(item.second);
  }
  return left;
}

}  // namespace lexican::explain
