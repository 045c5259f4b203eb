// SPDX-License-Identifier: Apache-2.0
#include "explain/facts.hpp"

#include <fmt/format.h>

#include "frame_bits.hpp"

namespace lexican::explain {

std::optional<std::uint16_t> plain_identifier(const CO_IF_FRM& frame) {
  const bool is_plain = (frame.Identifier & (CO_IF_FRM_EXT | CO_IF_FRM_RTR | CO_IF_FRM_ERROR)) == 0;
  return is_plain ? std::optional(static_cast<std::uint16_t>(frame.Identifier & 0x7FFU)) : std::nullopt;
}

std::string time_text(Micros time) {
  return time >= 999'500 ? fmt::format("{:.3g} s", static_cast<double>(time) / 1e6)
                         : fmt::format("{:.3g} ms", static_cast<double>(time) / 1e3);
}

void Facts::frame(const Entry& entry) {
  learn_rate(entry);
  now_ = std::max(now_, entry.time);
  const std::optional<std::uint16_t> identifier = plain_identifier(entry.frame);
  if (!identifier) {
    return;
  }
  const auto node = static_cast<std::uint8_t>(*identifier & 0x7FU);
  const unsigned function = *identifier >> 7;
  if (*identifier == 0 && entry.frame.DLC == 2) {
    const std::uint8_t addressed = entry.frame.Data[1];
    for (std::uint8_t each = addressed == 0 ? std::uint8_t{1} : addressed; each <= 127; ++each) {
      command(each, entry.frame.Data[0], entry.time);
      if (addressed != 0) {
        break;
      }
    }
  } else if (function == 14 && node != 0 && entry.frame.DLC == 1) {
    hear(node, entry.time);
    nodes_[node].state_heard = entry.frame.Data[0] != nmt::boot_up ? entry.time : nodes_[node].state_heard;
    set_state(node, static_cast<std::uint8_t>(entry.frame.Data[0] & 0x7FU), entry.time);
  } else if (node != 0 && (function == 1 || function == 11)) {
    hear(node, entry.time);
    nodes_[node].is_server = true;
  } else if (function >= 3 && function <= 10) {
    bool is_known = false;
    monitor_.for_each_pdo(entry.frame, [&](const describe::KnownPdo& pdo) {
      is_known = true;
      if (pdo.is_transmit) {
        hear(pdo.node, entry.time);
        nodes_[pdo.node].is_server = true;
      }
    });
    if (!is_known && function % 2 == 1 && node != 0) {
      hear(node, entry.time);  // a TPDO of the pre-defined connection set [301:7.3.3]
    }
  }
}

/// The rate is at least that at which a frame fits between its end and that of the frame before.
void Facts::learn_rate(const Entry& entry) {
  if ((entry.frame.Identifier & CO_IF_FRM_ERROR) != 0) {
    return;
  }
  const unsigned bits = co::frame_bits(entry.frame) + co::intermission_bits;
  if (now_ != 0 && entry.time > now_) {
    const double speed = static_cast<double>(bits) * 1e6 / static_cast<double>(entry.time - now_);
    const bool is_other = entry.frame.Identifier != identifier_;
    for (std::size_t n = 0; n < std::size(bit_rates); ++n) {
      faster_[n] += speed > 1.05 * bit_rates[n] ? 1U : 0U;
      adjacent_[n] += is_other && speed > 0.95 * bit_rates[n] && speed < 1.05 * bit_rates[n] ? 1U : 0U;
    }
  }
  identifier_ = entry.frame.Identifier;
  ++frames_;
  const std::uint32_t known_rate = rate();
  const bool is_next = now_ != 0 && entry.time > now_ && known_rate != 0 &&
                       (entry.time - now_) * known_rate <= std::uint64_t{bits} * 1'100'000;
  full_time_ += is_next ? entry.time - now_ : 0;
}

std::uint32_t Facts::rate() const {
  constexpr std::uint64_t adjacent_needed = 20;
  if (bit_rate_ != 0) {
    return bit_rate_;
  }
  for (std::size_t n = 0; n < std::size(bit_rates); ++n) {
    if (faster_[n] * 100 <= frames_) {
      return adjacent_[n] >= adjacent_needed ? bit_rates[n] : 0;
    }
  }
  return 0;
}

void Facts::forget_states() {
  for (NodeFacts& node : nodes_) {
    node.state.reset();
    node.command = 0;
  }
}

void Facts::hear(std::uint8_t node, Micros time) {
  nodes_[node].is_heard = true;
  nodes_[node].heard = time;
}

/// A message of error control names the state.
void Facts::set_state(std::uint8_t node, std::uint8_t state, Micros time) {
  NodeFacts& facts = nodes_[node];
  const std::uint8_t entered = state == nmt::boot_up ? nmt::pre_operational : state;
  if (facts.state != entered) {
    facts.state = entered;
    facts.state_since = time;
  }
}

/// The node may be absent, and boots up again after a reset.
void Facts::command(std::uint8_t node, std::uint8_t command, Micros time) {
  NodeFacts& facts = nodes_[node];
  facts.command = command;
  facts.commanded = time;
  switch (command) {
    case nmt::start: set_state(node, nmt::operational, time); break;
    case nmt::stop: set_state(node, nmt::stopped, time); break;
    case nmt::enter_pre_operational: set_state(node, nmt::pre_operational, time); break;
    case nmt::reset_node:
    case nmt::reset_communication: facts.state.reset(); break;
    default: break;
  }
}

bool Facts::was_commanded(std::uint8_t node, Micros now, Micros within) const {
  const NodeFacts& facts = nodes_[node];
  return facts.command != 0 && now - facts.commanded <= within;
}

void Facts::transfer(std::uint8_t node, const describe::SdoTransfer& transfer) {
  if (transfer.end != describe::SdoTransfer::End::done || transfer.index < 0x1000 || transfer.index > 0x1FFF ||
      transfer.data.empty() || transfer.data.size() > 4) {
    return;
  }
  const Key key{node, transfer.index, transfer.sub_index};
  if (values_.size() >= most_values && values_.find(key) == values_.end()) {
    return;
  }
  std::uint32_t value = 0;
  for (std::size_t n = transfer.data.size(); n > 0; --n) {
    value = value << 8 | transfer.data[n - 1];
  }
  KnownValue& known = values_[key];
  const auto sync = static_cast<std::uint16_t>(value & 0x7FFU);
  if (transfer.index == 0x1005 && !is_sync(sync) && syncs_.size() < 127) {
    syncs_.push_back(sync);
  }
  known = {value, transfer.time};
}

std::optional<KnownValue> Facts::observed(std::uint8_t node, std::uint16_t index, std::uint8_t sub_index) const {
  const auto found = values_.find({node, index, sub_index});
  return found != values_.end() ? std::optional(found->second) : std::nullopt;
}

std::optional<std::uint32_t> Facts::value(std::uint8_t node, std::uint16_t index, std::uint8_t sub_index) const {
  if (const std::optional<KnownValue> known = observed(node, index, sub_index)) {
    return known->value;
  }
  const codict::Device* const device = network_.of(node).device();
  const codict::Entry* const entry = device != nullptr ? device->find(index, sub_index) : nullptr;
  if (entry == nullptr) {
    return std::nullopt;
  }
  const codict::Value& value = codict::value_in_force(*entry);
  return value.is_integer() ? std::optional(static_cast<std::uint32_t>(value.integer_for(node).bits())) : std::nullopt;
}

}  // namespace lexican::explain
