// SPDX-License-Identifier: Apache-2.0
#include "can_wire.hpp"

#include <algorithm>
#include <utility>

namespace test {

CanNode::CanNode(CanWire& wire, CanClient& client, std::string name)
    : wire_(wire), client_(client), name_(std::move(name)) {
  wire_.nodes_.push_back(this);
}

CanNode::~CanNode() { wire_.nodes_.erase(std::find(wire_.nodes_.begin(), wire_.nodes_.end(), this)); }

void CanWire::advance(std::uint64_t bits) {
  for (; bits != 0; --bits) {
    step();
  }
}

void CanWire::step() {
  bool level = recessive;
  for (CanNode* node : nodes_) {
    level = node->drive() && level;
  }
  level = held_.value_or(level);
  level_ = disturbed(level, nullptr);
  for (CanNode* node : nodes_) {
    node->sample(disturbed(level_, node));
  }
  ++now_;
  for (CanNode* node : nodes_) {
    node->client_.on_bit(level_);
  }
  const auto is_over = [&](const CanDisturbance& one) { return one.first + one.bits <= now_; };
  disturbances_.erase(std::remove_if(disturbances_.begin(), disturbances_.end(), is_over), disturbances_.end());
}

bool CanWire::disturbed(bool level, const CanNode* node) const {
  for (const CanDisturbance& one : disturbances_) {
    if (one.only == node && one.is_at(now_)) {
      switch (one.kind) {
        case CanDisturbance::Kind::invert: level = !level; break;
        case CanDisturbance::Kind::set_dominant: level = dominant; break;
        case CanDisturbance::Kind::set_recessive: level = recessive; break;
      }
    }
  }
  return level;
}

void CanWire::disturb_frames(unsigned frames, unsigned bit, CanDisturbance::Kind kind, unsigned bits,
                             const CanNode* only) {
  frame_disturbances_.push_back({frames, bit, {kind, 0, bits, only}});
}

// Called by each node that enters a frame; the first one in a bit time begins the frame.
void CanWire::on_start_of_frame() {
  if (last_start_ == now_) {
    return;
  }
  last_start_ = now_;
  for (FrameDisturbance& one : frame_disturbances_) {
    if (one.frames != 0) {
      --one.frames;
      CanDisturbance disturbance = one.disturbance;
      disturbance.first = now_ + one.bit;
      disturb(disturbance);
    }
  }
}

std::vector<CanFrame> CanWire::sent_frames() const {
  std::vector<CanFrame> frames;
  for (const CanRecord& one : records_) {
    if (one.kind == CanRecord::Kind::sent) {
      frames.push_back(one.frame);
    }
  }
  return frames;
}

std::size_t CanWire::sent() const { return sent_frames().size(); }

std::size_t CanWire::errors(CanError error) const {
  return static_cast<std::size_t>(std::count_if(records_.begin(), records_.end(), [&](const CanRecord& one) {
    return one.kind == CanRecord::Kind::error && one.error == error;
  }));
}

void CanWire::count_access() {
  ++all_accesses_;
  if (accesses_per_bit != 0 && ++accesses_ >= accesses_per_bit) {
    accesses_ = 0;
    advance(1);
  }
}

CanPeer::CanPeer(CanWire& wire, FdMode fd, std::string name) : node_(wire, *this, std::move(name)) {
  CanMode mode;
  mode.fd = fd;
  node_.set_mode(mode);
  node_.start();
}

std::optional<CanFrame> CanPeer::next_frame() {
  if (queue_.empty()) {
    return std::nullopt;
  }
  return queue_.front();
}

void CanPeer::end_attempt() {
  if (!retransmits && !queue_.empty()) {
    queue_.pop_front();
  }
}

void CanPeer::on_arbitration_lost() {
  ++arbitrations_lost;
  end_attempt();
}

void CanPeer::on_transmission_failed(CanError /*error*/) {
  ++failures;
  end_attempt();
}

void CanPeer::on_counters() {
  if (node_.state() == CanNode::State::bus_off) {
    node_.start();
  }
}

}  // namespace test
