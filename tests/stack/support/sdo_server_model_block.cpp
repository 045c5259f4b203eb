// SPDX-License-Identifier: Apache-2.0
// Block transfer of the SDO server model. [301:7.2.4.3.9-16]
#include <algorithm>

#include "sdo_server_model.hpp"

namespace test {
namespace {

constexpr std::uint32_t unknown_command = 0x05040001;
constexpr std::uint32_t wrong_blksize = 0x05040002;
constexpr std::uint32_t wrong_sequence = 0x05040003;
constexpr std::uint32_t wrong_crc = 0x05040004;
constexpr std::uint32_t too_long = 0x06070012;

constexpr std::size_t segment_bytes = 7;

}  // namespace

// Block download. data_ contains all received bytes, of which done_ are written to the object. -----------------------

SdoServerModel::Answer SdoServerModel::initiate_block_download(const SdoBytes& request) {
  if (buffer_ == 0) {
    state_ = State::idle;
    return refuse(request, unknown_command);
  }
  if (const std::uint32_t fault = fault_of_access(request, false); fault != 0) {
    return abort(fault);
  }
  if (const std::uint32_t fault = take_size(request, (request[0] & 0x02U) != 0); fault != 0) {
    return abort(fault);
  }
  has_crc_ = (request[0] & 0x04U) != 0;
  blksize_ = buffer_;
  seq_ = 0;
  highest_ = 0;
  has_acknowledged_ = false;
  is_stuck_ = false;
  state_ = State::block_download;
  reminder_ = head(0xA4);
  reminder_[4] = static_cast<std::uint8_t>(blksize_);
  return reminder_;
}

// Processes a segment. [D21] [D22] [D23] A last segment that is the first frame of a block may be a duplicate from the
// previous block and is not acknowledged. A segment in order restarts the time-out; a segment behind a gap does so only
// if the previous block had a segment in order. [D18]
SdoServerModel::Answer SdoServerModel::take_in_block(const SdoBytes& request) {
  const std::size_t number = request[0] & 0x7FU;
  const bool last = (request[0] & 0x80U) != 0;
  const bool ends = last || number == blksize_;
  if (number == 0 || number > blksize_) {
    return std::nullopt;
  }
  const bool repeated = number > 1 && highest_ == 0 && has_acknowledged_;
  const bool in_order = number == seq_ + 1;
  if ((in_order && fault_ == 0) || (number > highest_ && !is_stuck_)) {
    idle_ = 0;
  }
  highest_ = std::max(highest_, number);
  if (in_order && fault_ == 0) {
    collect(request);
  }
  return ends && !repeated ? end_block(in_order && last) : std::nullopt;
}

void SdoServerModel::collect(const SdoBytes& request) {
  const bool last = (request[0] & 0x80U) != 0;
  if (data_.size() + (last ? 0 : segment_bytes) > size_) {
    fault_ = too_long;
    return;
  }
  data_.insert(data_.end(), request.begin() + 1, request.end());
  last_segment_ = request;
  ++seq_;
}

SdoServerModel::Answer SdoServerModel::end_block(bool all) {
  if (fault_ != 0) {
    return abort(fault_);
  }
  if (all) {
    state_ = State::block_download_end;
  } else if (data_.size() - done_ == buffer_ * segment_bytes) {
    if (object_->is_stream()) {
      object_->set(data_);
    }
    done_ = data_.size();
  }
  const std::size_t room = buffer_ - (data_.size() - done_) / segment_bytes;
  blksize_ = room != 0 ? room : buffer_;
  reminder_ = {0xA2, static_cast<std::uint8_t>(seq_), static_cast<std::uint8_t>(blksize_)};
  is_stuck_ = seq_ == 0;
  seq_ = 0;
  highest_ = 0;
  has_acknowledged_ = true;
  return reminder_;
}

// Returns true for a correct end request. A last segment may have the same command byte.
bool SdoServerModel::is_right_end(const SdoBytes& request) const {
  const Bytes data(data_.begin(), data_.end() - ((request[0] >> 2) & 7));
  const bool is_end = (request[0] & 0xE3U) == 0xC1;
  const bool has_right_size = !sized_ || data.size() == size_;
  return is_end && has_right_size && (!has_crc_ || crc_16(data) == (request[1] | (request[2] << 8)));
}

std::size_t SdoServerModel::unused_at_end() const {
  return data_.size() > size_ ? std::min(data_.size() - size_, segment_bytes) : 0;
}

SdoServerModel::Answer SdoServerModel::end_block_download(const SdoBytes& request) {
  data_.resize(data_.size() - ((request[0] >> 2) & 7U));
  if (const std::uint32_t fault = fault_of_total(data_.size()); fault != 0) {
    return abort(fault);
  }
  if (has_crc_ && crc_16(data_) != (request[1] | (request[2] << 8))) {
    return abort(wrong_crc);
  }
  if (const std::uint32_t fault = fault_of_value(); fault != 0) {
    return abort(fault);
  }
  object_->set(data_);
  state_ = State::idle;
  return SdoBytes{0xA1};
}

// Block upload. The client has acknowledged done_ of the bytes. ------------------------------------------------------

SdoServerModel::Answer SdoServerModel::initiate_block_upload(const SdoBytes& request) {
  if (buffer_ == 0) {
    state_ = State::idle;
    return refuse(request, unknown_command);
  }
  if (const std::uint32_t fault = fault_of_access(request, true); fault != 0) {
    return abort(fault);
  }
  if (!is_blksize(request[4])) {
    return abort(wrong_blksize);
  }
  data_ = object_->shown();
  if (request[5] != 0 && data_.size() <= request[5]) {
    return initiate_upload(request);
  }
  has_crc_ = (request[0] & 0x04U) != 0;
  blksize_ = request[4];
  seq_ = 0;
  last_sent_ = false;
  state_ = State::block_upload_ready;
  return head_with_size(0xC6);
}

SdoServerModel::Answer SdoServerModel::start(const SdoBytes& request) {
  if (state_ != State::block_upload_ready) {
    return refuse(request, unknown_command);
  }
  state_ = State::block_upload;
  return std::nullopt;
}

std::optional<SdoBytes> SdoServerModel::segment() {
  if (state_ != State::block_upload || seq_ == blksize_ || last_sent_) {
    return std::nullopt;
  }
  const std::size_t position = done_ + segment_bytes * seq_;
  const std::size_t length = std::min(segment_bytes, data_.size() - position);
  last_sent_ = position + length == data_.size();
  ++seq_;
  idle_ = 0;
  SdoBytes frame = {static_cast<std::uint8_t>(seq_ | (last_sent_ ? 0x80U : 0U))};
  std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(position), length, frame.begin() + 1);
  return frame;
}

SdoServerModel::Answer SdoServerModel::acknowledged(const SdoBytes& request) {
  const std::uint8_t ackseq = request[1];
  if (state_ != State::block_upload) {
    return refuse(request, unknown_command);
  }
  if (ackseq > seq_) {
    // The client may repeat the acknowledge of the previous block while the controller refuses segments of this one.
    const bool may_repeat = done_ != 0 && seq_ != blksize_ && !last_sent_;
    return may_repeat ? Answer() : abort(wrong_sequence);
  }
  if (!is_blksize(request[2])) {
    return abort(wrong_blksize);
  }
  if (ackseq == seq_ && last_sent_) {
    state_ = State::block_upload_end;
    const std::size_t unused = done_ + segment_bytes * seq_ - data_.size();
    const std::uint16_t crc = has_crc_ ? crc_16(data_) : std::uint16_t{0};
    return SdoBytes{static_cast<std::uint8_t>(0xC1U | (unused << 2)), static_cast<std::uint8_t>(crc),
                    static_cast<std::uint8_t>(crc >> 8)};
  }
  done_ += segment_bytes * ackseq;
  blksize_ = request[2];
  seq_ = 0;
  last_sent_ = false;
  return std::nullopt;
}

SdoServerModel::Answer SdoServerModel::end_block_upload(const SdoBytes& request) {
  if (state_ != State::block_upload_end) {
    return refuse(request, unknown_command);
  }
  state_ = State::idle;
  return std::nullopt;
}

}  // namespace test
