// SPDX-License-Identifier: Apache-2.0
#include "describe/sdo_transfer.hpp"

#include <algorithm>
#include <utility>

namespace lexican::describe {
namespace {

constexpr std::size_t segment_bytes = 7;
constexpr unsigned last_segment = 0x80;  // of a block
constexpr unsigned abort_command = 0x80;

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
  const unsigned number = data[0] & ~last_segment;
  const bool in_block = phase_ == (is_request ? Phase::client_segments : Phase::server_segments);
  if (in_block && number != 0) {
    segment(data);
    transfer_.time = time;
    return std::nullopt;
  }
  if (data[0] == abort_command) {
    if (phase_ == Phase::idle) {  // the request was not seen
      begin(data, false, time);
    }
    transfer_.time = time;
    return end(is_request ? SdoTransfer::End::cancelled : SdoTransfer::End::refused, number_at(data + 4));
  }
  std::optional<SdoTransfer> ended;
  if (is_request) {
    const unsigned kind = command(data);
    const bool is_initiate =
        kind == 1 || kind == 2 || (kind == 5 && (data[0] & 3U) == 0) || (kind == 6 && (data[0] & 1U) == 0);
    if (is_initiate) {
      ended = close();
      begin(data, kind == 1 || kind == 6, time);
    }
    transfer_.time = time;
    const std::optional<SdoTransfer> finished = request(data);
    return finished ? finished : ended;
  }
  transfer_.time = time;
  return response(data);
}

std::optional<SdoTransfer> SdoFollower::request(const std::uint8_t* data) {
  if (phase_ == Phase::idle) {
    return std::nullopt;
  }
  switch (command(data)) {
    case 0:
      append(data + 1, segment_bytes - ((data[0] >> 1) & 7U));
      is_last_ = (data[0] & 1U) != 0;
      break;
    case 1:
      if (is_expedited(data)) {
        append(data + 4, expedited_size(data));
        is_last_ = true;
      }
      break;
    case 5:  // block upload
      if ((data[0] & 3U) == 3) {
        phase_ = Phase::server_segments;
      } else if ((data[0] & 3U) == 2) {
        acknowledge(data[1]);
      } else if ((data[0] & 3U) == 1) {
        return end(SdoTransfer::End::done);
      }
      break;
    case 6:  // end of a block download
      if ((data[0] & 1U) != 0) {
        end_block(data);
      }
      break;
    default: break;
  }
  return std::nullopt;
}

std::optional<SdoTransfer> SdoFollower::response(const std::uint8_t* data) {
  if (phase_ == Phase::idle) {
    return std::nullopt;
  }
  switch (command(data)) {
    case 0:
      append(data + 1, segment_bytes - ((data[0] >> 1) & 7U));
      return (data[0] & 1U) != 0 ? std::optional(end(SdoTransfer::End::done)) : std::nullopt;
    case 1: return is_last_ ? std::optional(end(SdoTransfer::End::done)) : std::nullopt;
    case 2:
      if (is_expedited(data)) {
        append(data + 4, expedited_size(data));
        return end(SdoTransfer::End::done);
      }
      break;
    case 3: return is_last_ ? std::optional(end(SdoTransfer::End::done)) : std::nullopt;
    case 5:  // block download
      if ((data[0] & 3U) == 0) {
        phase_ = Phase::client_segments;
      } else if ((data[0] & 3U) == 2) {
        acknowledge(data[1]);
      } else if ((data[0] & 3U) == 1) {
        return end(SdoTransfer::End::done);
      }
      break;
    case 6:
      if ((data[0] & 1U) != 0) {
        end_block(data);
      }
      break;
    default: break;
  }
  return std::nullopt;
}

std::optional<SdoTransfer> SdoFollower::expire(Micros now) {
  return is_active() && now > transfer_.time && now - transfer_.time > answer_time ? close() : std::nullopt;
}

std::optional<SdoTransfer> SdoFollower::close() {
  return is_active() ? std::optional(end(SdoTransfer::End::unanswered)) : std::nullopt;
}

void SdoFollower::begin(const std::uint8_t* data, bool is_download, Micros time) {
  transfer_ = {};
  transfer_.index = static_cast<std::uint16_t>(data[1] | data[2] << 8);
  transfer_.sub_index = data[3];
  transfer_.is_download = is_download;
  transfer_.begin = time;
  is_last_ = false;
  in_block_ = 0;
  block_.clear();
  phase_ = Phase::open;
}

void SdoFollower::append(const std::uint8_t* bytes, std::size_t size) {
  transfer_.size += size;
  const std::size_t kept = std::min(size, most_data - transfer_.data.size());
  transfer_.data.insert(transfer_.data.end(), bytes, bytes + kept);
}

/// Keeps a segment of a block until it is acknowledged. A receiver ignores those behind a lost one.
void SdoFollower::segment(const std::uint8_t* data) {
  if ((data[0] & ~last_segment) == in_block_ + 1U) {
    ++in_block_;
    block_.insert(block_.end(), data + 1, data + 1 + segment_bytes);
    is_last_ = (data[0] & last_segment) != 0;
  }
}

void SdoFollower::acknowledge(std::uint8_t last) {
  const std::uint8_t received = std::min(last, in_block_);
  append(block_.data(), received * segment_bytes);
  const bool is_complete = is_last_ && received == in_block_;
  is_last_ = is_complete;
  block_.clear();
  in_block_ = 0;
  if (is_complete) {
    phase_ = Phase::open;
  }
}

/// Removes the unused bytes of the last segment.
void SdoFollower::end_block(const std::uint8_t* data) {
  const std::uint64_t unused = std::min<std::uint64_t>((data[0] >> 2) & 7U, transfer_.size);
  const bool is_kept = transfer_.size == transfer_.data.size();
  transfer_.size -= unused;
  if (is_kept || transfer_.data.size() > transfer_.size) {
    transfer_.data.resize(static_cast<std::size_t>(transfer_.size));
  }
}

SdoTransfer SdoFollower::end(SdoTransfer::End how, std::uint32_t code) {
  transfer_.end = how;
  transfer_.abort_code = code;
  phase_ = Phase::idle;
  is_last_ = false;
  block_.clear();
  in_block_ = 0;
  return std::exchange(transfer_, {});
}

}  // namespace lexican::describe
