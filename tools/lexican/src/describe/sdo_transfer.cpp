// SPDX-License-Identifier: Apache-2.0
#include "describe/sdo_transfer.hpp"

#include <algorithm>
#include <utility>

namespace lexican::describe {
namespace {

constexpr std::size_t segment_bytes = 7;
constexpr unsigned last_segment = 0x80;  // of a block
constexpr unsigned abort_command = 0x80;
constexpr std::uint8_t most_segments = 127;  // of a sub-block

unsigned command(const std::uint8_t* data) { return data[0] >> 5; }

std::uint32_t number_at(const std::uint8_t* data) {
  return data[0] | static_cast<std::uint32_t>(data[1]) << 8 | static_cast<std::uint32_t>(data[2]) << 16 |
         static_cast<std::uint32_t>(data[3]) << 24;
}

/// Returns the number of bytes of the value in an initiate frame of an expedited transfer.
std::size_t expedited_size(const std::uint8_t* data) { return (data[0] & 1U) != 0 ? 4U - ((data[0] >> 2) & 3U) : 4U; }

bool is_expedited(const std::uint8_t* data) { return (data[0] & 2U) != 0; }

}  // namespace

std::optional<SdoTransfer> SdoFollower::follow(bool is_request, const std::uint8_t* data, Micros time) {
  was_followed_ = true;
  if (data[0] == abort_command) {
    return abort(is_request, data, time);
  }
  // Within a sub-block, bits 0 to 6 of the first byte are a sequence number.
  if (phase_ == (is_request ? Phase::client_segments : Phase::server_segments) && !is_block_sent_) {
    transfer_.time = segment(data) ? time : transfer_.time;
    return std::nullopt;
  }
  std::optional<SdoTransfer> ended;
  const unsigned kind = command(data);
  const bool is_initiate = is_request && (kind == 1 || kind == 2 || (kind == 5 && (data[0] & 3U) == 0) ||
                                          (kind == 6 && (data[0] & 1U) == 0));
  if (is_initiate) {
    transfer_.is_displaced = is_active();
    ended = close();
    begin(data, kind == 1 || kind == 6, time);
  }
  if (!is_active()) {
    was_followed_ = false;
    return std::nullopt;
  }
  std::optional<SdoTransfer> finished = is_request ? request(data) : response(data);
  if (finished) {
    finished->time = time;
    finished->is_answered = true;
    return finished;
  }
  transfer_.is_answered = transfer_.is_answered || (!is_request && was_followed_);
  transfer_.time = was_followed_ ? time : transfer_.time;
  return ended;
}

/// An abort of another object than that of the open transfer belongs to an earlier one, which remains open. Some
/// devices abort without the multiplexer.
std::optional<SdoTransfer> SdoFollower::abort(bool is_request, const std::uint8_t* data, Micros time) {
  const SdoTransfer::End how = is_request ? SdoTransfer::End::cancelled : SdoTransfer::End::refused;
  const bool has_object = data[1] != 0 || data[2] != 0 || data[3] != 0;
  if (is_active() && (is_of_object(data) || !has_object)) {
    transfer_.time = time;
    return end(how, number_at(data + 4));
  }
  if (is_request && expired_ == number_at(data) >> 8) {
    expired_.reset();
    return std::nullopt;
  }
  SdoTransfer other;
  other.index = static_cast<std::uint16_t>(data[1] | data[2] << 8);
  other.sub_index = data[3];
  other.is_aborted_only = true;
  other.end = how;
  other.abort_code = number_at(data + 4);
  other.begin = time;
  other.time = time;
  return other;
}

std::optional<SdoTransfer> SdoFollower::request(const std::uint8_t* data) {
  const bool is_download = transfer_.is_download;
  const bool is_block = phase_ != Phase::open || is_last_;
  switch (command(data)) {
    case 0:
      if (follow_if(is_download && !is_expedited_)) {
        check_toggle(true, data);
        append(data + 1, segment_bytes - ((data[0] >> 1) & 7U));
        is_last_ = (data[0] & 1U) != 0;
      }
      break;
    case 1:
      is_expedited_ = is_expedited(data);
      if (is_expedited_) {
        append_expedited(data);
      }
      break;
    case 3:
      if (follow_if(!is_download)) {
        check_toggle(true, data);
      }
      break;
    case 5:  // block upload
      if ((data[0] & 3U) == 3 && follow_if(!is_download)) {
        phase_ = Phase::server_segments;
        begin_block(blksize_);
      } else if ((data[0] & 3U) == 2 && follow_if(phase_ == Phase::server_segments)) {
        acknowledge(data);
      } else if ((data[0] & 3U) == 1) {
        return done_if(follow_if(!is_download && is_block));
      } else if ((data[0] & 3U) == 0) {
        begin_block(data[4]);
      }
      break;
    case 6:  // end of a block download
      if ((data[0] & 1U) != 0 && follow_if(is_download)) {
        end_block(data);
      }
      break;
    case 2: break;
    default: was_followed_ = false; break;
  }
  return std::nullopt;
}

std::optional<SdoTransfer> SdoFollower::response(const std::uint8_t* data) {
  const bool is_download = transfer_.is_download;
  const bool is_block = phase_ != Phase::open || is_last_;
  switch (command(data)) {
    case 0:
      if (follow_if(!is_download)) {
        check_toggle(false, data);
        append(data + 1, segment_bytes - ((data[0] >> 1) & 7U));
        return done_if((data[0] & 1U) != 0);
      }
      break;
    case 1:
      if (follow_if(is_download && !is_expedited_)) {
        check_toggle(false, data);
        return done_if(is_last_);
      }
      break;
    case 2:
      if (follow_if(!is_download && is_of_object(data)) && is_expedited(data)) {
        append_expedited(data);
        return done_if(true);
      }
      break;
    case 3:
      if (follow_if(is_download && is_of_object(data))) {
        return done_if(is_expedited_);
      }
      break;
    case 5:  // block download
      if (!follow_if(is_download)) {
        break;
      }
      if ((data[0] & 3U) == 0 && follow_if(is_of_object(data))) {
        phase_ = Phase::client_segments;
        begin_block(data[4]);
      } else if ((data[0] & 3U) == 2 && follow_if(phase_ == Phase::client_segments)) {
        acknowledge(data);
      } else if ((data[0] & 3U) == 1) {
        return done_if(follow_if(is_block));
      }
      break;
    case 6:
      if ((data[0] & 1U) == 0) {
        follow_if(!is_download && is_of_object(data));
      } else if (follow_if(!is_download)) {
        end_block(data);
      }
      break;
    default: was_followed_ = false; break;
  }
  return std::nullopt;
}

std::optional<SdoTransfer> SdoFollower::expire(Micros now) {
  if (!is_active() || now <= transfer_.time || now - transfer_.time <= answer_time) {
    return std::nullopt;
  }
  expired_ = transfer_.index | static_cast<std::uint32_t>(transfer_.sub_index) << 16;
  return close();
}

std::optional<SdoTransfer> SdoFollower::close() {
  return is_active() ? std::optional(end(SdoTransfer::End::unanswered)) : std::nullopt;
}

std::optional<SdoTransfer> SdoFollower::done_if(bool is_done) {
  return is_done ? std::optional(end(SdoTransfer::End::done)) : std::nullopt;
}

void SdoFollower::begin(const std::uint8_t* data, bool is_download, Micros time) {
  transfer_ = {};
  expired_.reset();
  transfer_.index = static_cast<std::uint16_t>(data[1] | data[2] << 8);
  transfer_.sub_index = data[3];
  transfer_.is_download = is_download;
  transfer_.begin = time;
  is_expedited_ = false;
  is_last_ = false;
  toggle_ = true;
  is_ended_ = false;
  blksize_ = 0;
  begin_block(0);
  phase_ = Phase::open;
}

bool SdoFollower::is_of_object(const std::uint8_t* data) const {
  return (data[1] | data[2] << 8) == transfer_.index && data[3] == transfer_.sub_index;
}

bool SdoFollower::follow_if(bool is_expected) {
  was_followed_ = was_followed_ && is_expected;
  return was_followed_;
}

void SdoFollower::append(const std::uint8_t* bytes, std::size_t size) {
  const bool has_all = transfer_.data.size() == transfer_.size;
  transfer_.size += size;
  if (has_all) {
    const std::size_t kept = std::min(size, most_data - transfer_.data.size());
    transfer_.data.insert(transfer_.data.end(), bytes, bytes + kept);
  }
}

void SdoFollower::append_expedited(const std::uint8_t* data) {
  transfer_.has_size = (data[0] & 1U) != 0;
  append(data + 4, expedited_size(data));
}

void SdoFollower::begin_block(std::uint8_t blksize) {
  blksize_ = blksize > 0 ? std::min(blksize, most_segments) : most_segments;
  block_.clear();
  in_block_ = 0;
  highest_ = 0;
  is_block_sent_ = false;
}

/// The toggle bit of requests alternates, from 0 on; a response has that of its request. [301:7.2.4.3.4, 7.2.4.3.7]
void SdoFollower::check_toggle(bool is_request, const std::uint8_t* data) {
  constexpr unsigned toggle_bit = 0x10;
  const bool toggle = (data[0] & toggle_bit) != 0;
  transfer_.wrong_toggles += (is_request ? toggle == toggle_ : toggle != toggle_) ? 1U : 0U;
  toggle_ = is_request ? toggle : toggle_;
}

/// Stores a segment of a block until it is acknowledged. A receiver ignores those behind a lost one.
/// \retval false  a sequence number that has been seen, or 0
bool SdoFollower::segment(const std::uint8_t* data) {
  const auto number = static_cast<std::uint8_t>(data[0] & ~last_segment);
  was_followed_ = number > highest_ && number <= blksize_;
  if (!was_followed_) {
    return false;
  }
  highest_ = number;
  is_block_sent_ = number == blksize_ || (data[0] & last_segment) != 0;
  is_last_ = (data[0] & last_segment) != 0;
  if (number == in_block_ + 1U) {
    ++in_block_;
    block_.insert(block_.end(), data + 1, data + 1 + segment_bytes);
  }
  return true;
}

/// Appends the segments that the receiver has. Those of them that are not in the recording are counted only.
void SdoFollower::acknowledge(const std::uint8_t* data) {
  const std::uint8_t received = std::min(data[1], blksize_);
  const std::uint8_t recorded = std::min(received, in_block_);
  const bool is_complete = is_last_ && received == highest_;
  transfer_.lost_segments += highest_ > received ? static_cast<unsigned>(highest_ - received) : 0U;
  append(block_.data(), recorded * segment_bytes);
  transfer_.size += (received - recorded) * segment_bytes;
  is_last_ = is_complete;
  begin_block(data[2]);
  if (is_complete) {
    phase_ = Phase::open;
  }
}

/// Removes the unused bytes of the last segment.
void SdoFollower::end_block(const std::uint8_t* data) {
  if (std::exchange(is_ended_, true)) {
    return;
  }
  const std::uint64_t unused = std::min<std::uint64_t>((data[0] >> 2) & 7U, transfer_.size);
  const bool has_all = transfer_.size == transfer_.data.size();
  transfer_.size -= unused;
  if (has_all || transfer_.data.size() > transfer_.size) {
    transfer_.data.resize(static_cast<std::size_t>(transfer_.size));
  }
}

SdoTransfer SdoFollower::end(SdoTransfer::End how, std::uint32_t code) {
  transfer_.end = how;
  transfer_.abort_code = code;
  phase_ = Phase::idle;
  begin_block(0);
  return std::exchange(transfer_, {});
}

}  // namespace lexican::describe
