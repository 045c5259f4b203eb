// SPDX-License-Identifier: Apache-2.0
#include "sdo_client_model.hpp"

#include <algorithm>

namespace test {
namespace {

constexpr std::uint32_t wrong_toggle = 0x05030000;
constexpr std::uint32_t unknown_command = 0x05040001;
constexpr std::uint32_t wrong_blksize = 0x05040002;
constexpr std::uint32_t wrong_sequence = 0x05040003;
constexpr std::uint32_t wrong_crc = 0x05040004;
constexpr std::uint32_t out_of_memory = 0x05040005;
constexpr std::uint32_t too_long = 0x06070012;
constexpr std::uint32_t too_short = 0x06070013;
constexpr std::uint32_t general_error = 0x08000000;

constexpr std::size_t segment_bytes = 7;
constexpr std::size_t largest_block = 127;

std::uint8_t byte(std::size_t value) { return static_cast<std::uint8_t>(value); }

std::uint32_t number_in(const SdoBytes& frame) {
  return frame[4] | (std::uint32_t{frame[5]} << 8) | (std::uint32_t{frame[6]} << 16) | (std::uint32_t{frame[7]} << 24);
}

void put_number(SdoBytes& frame, std::size_t number) {
  for (unsigned n = 0; n < 4; ++n) {
    frame[4 + n] = byte(number >> (8 * n));
  }
}

void put_crc(SdoBytes& frame, std::uint16_t crc) {
  frame[1] = byte(crc);
  frame[2] = byte(crc >> 8U);
}

}  // namespace

// Initiate -----------------------------------------------------------------------------------------------------------

SdoBytes SdoClientModel::start_upload(const SdoKey& key, std::size_t size) {
  key_ = key;
  is_upload_ = true;
  size_ = size;
  by_block_ = block_threshold_ != 0 && size_ >= block_threshold_;
  return initiate();
}

SdoBytes SdoClientModel::start_download(const SdoKey& key, const Bytes& data) {
  key_ = key;
  is_upload_ = false;
  size_ = data.size();
  data_ = data;
  by_block_ = block_threshold_ != 0 && size_ >= block_threshold_;
  return initiate();
}

SdoBytes SdoClientModel::initiate() {
  state_ = State::initiated;
  total_.reset();
  done_ = 0;
  toggle_ = 0;
  ackseq_ = 0;
  has_acknowledged_ = false;
  if (is_upload_) {
    data_.clear();
    SdoBytes frame = head(by_block_ ? 0xA4 : 0x40);
    frame[4] = by_block_ ? byte(largest_block) : std::uint8_t{0};
    frame[5] = by_block_ ? byte(block_threshold_ - 1) : std::uint8_t{0};
    return frame;
  }
  if (size_ <= 4) {
    SdoBytes frame = head(0x23U | static_cast<unsigned>((4 - size_) << 2));
    std::copy(data_.begin(), data_.end(), frame.begin() + 4);
    return frame;
  }
  SdoBytes frame = head(by_block_ ? 0xC6 : 0x21);
  put_number(frame, size_);
  return frame;
}

SdoBytes SdoClientModel::head(unsigned command) const {
  return {static_cast<std::uint8_t>(command), key_[0], key_[1], key_[2]};
}

// Ends ---------------------------------------------------------------------------------------------------------------

SdoBytes SdoClientModel::abort(std::uint32_t code) const {
  SdoBytes frame = head(0x80);
  put_number(frame, code);
  return frame;
}

void SdoClientModel::close(std::uint32_t code) {
  state_ = State::idle;
  end_ = code;
}

// Aborts the transfer. Returns the abort frame.
SdoClientModel::Answer SdoClientModel::give_up(std::uint32_t code) {
  close(code);
  return abort(code);
}

// Ends the transfer without an answer.
SdoClientModel::Answer SdoClientModel::finish(std::uint32_t code) {
  close(code);
  return std::nullopt;
}

// Processes an abort of the server. A server without block transfer aborts its initiate: the transfer is then repeated
// as a segmented or expedited one. An abort with code 0 is reported as a general error, not as success.
SdoClientModel::Answer SdoClientModel::abort_received(const SdoBytes& response) {
  const std::uint32_t code = number_in(response);
  if (state_ == State::initiated && by_block_ && (code == unknown_command || code == general_error)) {
    by_block_ = false;
    return initiate();
  }
  return finish(code != 0 ? code : general_error);
}

// Responses of the server ---------------------------------------------------------------------------------------------

namespace {

// Returns whether a frame is an abort of an initiate of any object: servers that do not know a request abort it with
// index 0, or with the object of their last transfer.
bool is_abort_of_any(const SdoBytes& response) {
  const bool has_no_object = response[1] == 0 && response[2] == 0 && response[3] == 0;
  return response[0] == 0x80 && (has_no_object || number_in(response) == unknown_command);
}

}  // namespace

std::optional<SdoBytes> SdoClientModel::answer(const SdoBytes& response) {
  if (state_ == State::idle) {
    return std::nullopt;
  }
  if (state_ == State::initiated && !std::equal(key_.begin(), key_.end(), response.begin() + 1) &&
      !is_abort_of_any(response)) {
    return std::nullopt;
  }
  if (state_ == State::block_upload && response[0] != 0x80) {
    return receive_block_segment(response);
  }
  if (state_ == State::block_upload_end && repeats_last_segment(response) && !is_correct_end(response)) {
    return std::nullopt;
  }
  return response[0] == 0x80 ? abort_received(response) : answer_in_state(response);
}

SdoClientModel::Answer SdoClientModel::answer_in_state(const SdoBytes& response) {
  const std::uint8_t command = response[0];
  switch (state_) {
    case State::initiated: return is_upload_ ? upload_initiated(response) : download_initiated(response);
    case State::upload: return command < 0x20 ? receive_segment(response) : give_up(unknown_command);
    case State::download: return (command & 0xEFU) == 0x20 ? segment_confirmed(response) : give_up(unknown_command);
    case State::block_upload_end:
      return (command & 0xE3U) == 0xC1 ? end_block_upload(response) : give_up(unknown_command);
    case State::block_download:
      if ((command & 0xFBU) == 0xA0) {  // repeated by a server that was waiting for segments
        return std::nullopt;
      }
      return command == 0xA2 ? block_confirmed(response) : give_up(unknown_command);
    case State::block_download_end:
      if (command == 0xA2) {  // repeated by a server that is waiting for the end
        return std::nullopt;
      }
      return command == 0xA1 ? finish(0) : give_up(unknown_command);
    default: return give_up(unknown_command);
  }
}

// Expedited and segmented transfer -----------------------------------------------------------------------------------

SdoClientModel::Answer SdoClientModel::upload_initiated(const SdoBytes& response) {
  const std::uint8_t command = response[0];
  if ((command & 0xF0U) == 0x40) {
    if ((command & 0x02U) != 0) {
      return receive_expedited(response);
    }
    state_ = State::upload;
    return receive_size(response, (command & 0x01U) != 0, 0x60);
  }
  if (by_block_ && (command & 0xF9U) == 0xC0) {
    state_ = State::block_upload;
    has_crc_ = (command & 0x04U) != 0;
    seq_ = 0;
    has_segment_ = false;
    return receive_size(response, (command & 0x02U) != 0, 0xA3);
  }
  return give_up(unknown_command);
}

// Completes an expedited upload. If the server indicates no size, the data have the size of the buffer, at most 4
// bytes.
SdoClientModel::Answer SdoClientModel::receive_expedited(const SdoBytes& response) {
  const bool has_size = (response[0] & 0x01U) != 0;
  const std::size_t n = has_size ? 4U - ((response[0] >> 2) & 3U) : std::min<std::size_t>(size_, 4);
  if (n > size_) {
    return give_up(out_of_memory);
  }
  data_.assign(response.begin() + 4, response.begin() + 4 + static_cast<std::ptrdiff_t>(n));
  return finish(0);
}

// Stores the size that the server indicates, if any. Returns the next request, with the command \a next.
SdoClientModel::Answer SdoClientModel::receive_size(const SdoBytes& response, bool has_size, unsigned next) {
  if (has_size) {
    total_ = number_in(response);
  }
  if (total_.value_or(0) > size_) {
    return give_up(out_of_memory);
  }
  return SdoBytes{static_cast<std::uint8_t>(next)};
}

// Processes a segment of a segmented upload.
SdoClientModel::Answer SdoClientModel::receive_segment(const SdoBytes& response) {
  const std::size_t left = total_.value_or(0) - data_.size();
  // In a last segment, n = 0 may mean that the number of unused bytes is not indicated.
  const bool is_unspecified = (response[0] & 0x0FU) == 0x01 && total_ && left > 0 && left <= segment_bytes;
  const std::size_t n = is_unspecified ? left : segment_bytes - ((response[0] >> 1) & 7U);
  const bool last = (response[0] & 0x01U) != 0;
  if ((response[0] & 0x10U) != toggle_) {
    return give_up(wrong_toggle);
  }
  if (total_ && data_.size() + n > *total_) {
    return give_up(too_long);
  }
  if (data_.size() + n > size_) {
    return give_up(out_of_memory);
  }
  data_.insert(data_.end(), response.begin() + 1, response.begin() + 1 + static_cast<std::ptrdiff_t>(n));
  toggle_ ^= 0x10;
  if (!last) {
    return SdoBytes{static_cast<std::uint8_t>(0x60U | toggle_)};
  }
  return total_ && data_.size() < *total_ ? give_up(too_short) : finish(0);
}

SdoClientModel::Answer SdoClientModel::download_initiated(const SdoBytes& response) {
  if (!by_block_) {
    if (response[0] != 0x60) {
      return give_up(unknown_command);
    }
    state_ = State::download;
    return size_ <= 4 ? finish(0) : next_segment();
  }
  if ((response[0] & 0xFBU) != 0xA0) {
    return give_up(unknown_command);
  }
  blksize_ = response[4];
  if (blksize_ == 0 || blksize_ > largest_block) {
    return give_up(wrong_blksize);
  }
  has_crc_ = (response[0] & 0x04U) != 0;
  seq_ = 0;
  last_sent_ = false;
  state_ = State::block_download;
  return std::nullopt;
}

SdoBytes SdoClientModel::next_segment() const {
  const std::size_t n = std::min(segment_bytes, size_ - done_);
  const bool last = done_ + n == size_;
  SdoBytes frame = {byte(toggle_ | ((segment_bytes - n) << 1) | (last ? 1U : 0U))};
  std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(done_), n, frame.begin() + 1);
  return frame;
}

SdoClientModel::Answer SdoClientModel::segment_confirmed(const SdoBytes& response) {
  if ((response[0] & 0x10U) != toggle_) {
    return give_up(wrong_toggle);
  }
  done_ += std::min(segment_bytes, size_ - done_);
  toggle_ ^= 0x10;
  return done_ == size_ ? finish(0) : next_segment();
}

// Block upload. data_ contains done_ bytes of previous blocks, and the bytes of the current one. ---------------------

// Processes a segment of a block upload. Ignores the repeated last segment of the previous block, which the client
// receives before any segment of this block.
SdoClientModel::Answer SdoClientModel::receive_block_segment(const SdoBytes& response) {
  const std::size_t number = response[0] & 0x7FU;
  const bool last = (response[0] & 0x80U) != 0;
  if (number == 0) {
    return give_up(wrong_sequence);
  }
  const bool ends = last || number == largest_block;
  const bool is_repeated = ends && number > 1 && !has_segment_ && has_acknowledged_;
  const bool in_order = number == seq_ + 1;
  has_segment_ = true;
  if (is_repeated) {
    return std::nullopt;
  }
  if (in_order) {
    const std::uint32_t fault = store_segment(response);
    if (fault != 0) {
      return give_up(fault);
    }
  }
  return ends ? Answer(acknowledge(in_order && last)) : std::nullopt;
}

// Stores a segment. All 7 bytes of the last one are stored, because the end request indicates how many of them are
// data.
std::uint32_t SdoClientModel::store_segment(const SdoBytes& response) {
  if ((response[0] & 0x80U) == 0) {
    if (total_ && data_.size() + segment_bytes > *total_) {
      return too_long;
    }
    if (data_.size() + segment_bytes > size_) {
      return out_of_memory;
    }
  }
  data_.insert(data_.end(), response.begin() + 1, response.end());
  ++seq_;
  return 0;
}

// Acknowledges a block. \a all: it was the last one, and is complete.
SdoBytes SdoClientModel::acknowledge(bool all) {
  ackseq_ = seq_;
  has_acknowledged_ = true;
  seq_ = 0;
  has_segment_ = false;
  state_ = all ? State::block_upload_end : State::block_upload;
  return {0xA2, byte(ackseq_), byte(largest_block)};
}

// Returns true if the frame repeats the last segment. Compares only the bytes that fit into the client's buffer.
bool SdoClientModel::repeats_last_segment(const SdoBytes& response) const {
  const std::size_t first = data_.size() - segment_bytes;
  const std::size_t kept = std::min(segment_bytes, size_ - first);
  return response[0] == (ackseq_ | 0x80U) &&
         std::equal(data_.begin() + static_cast<std::ptrdiff_t>(first),
                    data_.begin() + static_cast<std::ptrdiff_t>(first + kept), response.begin() + 1);
}

// Returns true for a correct end request. A last segment may have the same command byte.
bool SdoClientModel::is_correct_end(const SdoBytes& response) const {
  const Bytes data(data_.begin(), data_.end() - ((response[0] >> 2) & 7));
  const bool is_end = (response[0] & 0xE3U) == 0xC1;
  const bool has_right_size = data.size() <= size_ && (!total_ || data.size() == *total_);
  return is_end && has_right_size && (!has_crc_ || crc_16(data) == (response[1] | (response[2] << 8)));
}

SdoClientModel::Answer SdoClientModel::end_block_upload(const SdoBytes& response) {
  data_.resize(data_.size() - ((response[0] >> 2) & 7U));
  if (total_ && data_.size() != *total_) {
    return give_up(data_.size() > *total_ ? too_long : too_short);
  }
  if (data_.size() > size_) {
    return give_up(out_of_memory);
  }
  if (has_crc_ && crc_16(data_) != (response[1] | (response[2] << 8))) {
    return give_up(wrong_crc);
  }
  close(0);
  return SdoBytes{0xA1};
}

bool SdoClientModel::repeat_acknowledge(const SdoBytes& request) {
  const std::size_t ackseq = has_segment_ ? seq_ : ackseq_;
  const SdoBytes expected = {0xA2, byte(ackseq), byte(largest_block)};
  if (!can_repeat_acknowledge() || request != expected) {
    return false;
  }
  if (has_segment_) {
    acknowledge(false);
  }
  return true;
}

// Block download. The server has acknowledged done_ of the bytes. ----------------------------------------------------

std::optional<SdoBytes> SdoClientModel::segment() {
  if (state_ != State::block_download || seq_ == blksize_ || last_sent_) {
    return std::nullopt;
  }
  const std::size_t position = done_ + segment_bytes * seq_;
  const std::size_t n = std::min(segment_bytes, size_ - position);
  last_sent_ = position + n == size_;
  ++seq_;
  SdoBytes frame = {byte(seq_ | (last_sent_ ? 0x80U : 0U))};
  std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(position), n, frame.begin() + 1);
  return frame;
}

SdoClientModel::Answer SdoClientModel::block_confirmed(const SdoBytes& response) {
  const std::size_t ackseq = response[1];
  if (ackseq > seq_) {  // A server that was waiting for segments repeats the acknowledge of the previous block.
    const bool is_complete = seq_ == blksize_ || last_sent_;
    return done_ != 0 && !is_complete ? std::nullopt : give_up(wrong_sequence);
  }
  if (response[2] == 0 || response[2] > largest_block) {
    return give_up(wrong_blksize);
  }
  if (ackseq == seq_ && last_sent_) {
    state_ = State::block_download_end;
    SdoBytes frame = {byte(0xC1U | ((segment_bytes - 1 - (size_ - 1) % segment_bytes) << 2))};
    put_crc(frame, has_crc_ ? crc_16(data_) : std::uint16_t{0});
    return frame;
  }
  done_ += segment_bytes * ackseq;
  blksize_ = response[2];
  seq_ = 0;
  last_sent_ = false;
  return std::nullopt;
}

}  // namespace test
