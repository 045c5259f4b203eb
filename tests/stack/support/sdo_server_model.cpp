// SPDX-License-Identifier: Apache-2.0
#include "sdo_server_model.hpp"

#include <algorithm>

namespace test {
namespace {

constexpr std::uint32_t wrong_toggle = 0x05030000;
constexpr std::uint32_t timed_out = 0x05040000;
constexpr std::uint32_t unknown_command = 0x05040001;
constexpr std::uint32_t wrong_length = 0x06070010;
constexpr std::uint32_t too_long = 0x06070012;
constexpr std::uint32_t too_short = 0x06070013;

constexpr std::size_t segment_bytes = 7;
constexpr unsigned slices = 8;
constexpr unsigned reminder_slices = 2;

// Commands 110x xcs0b (block download) and 101x xc00b (block upload).
constexpr bool initiates_block_download(std::uint8_t command) { return (command & 0xF9U) == 0xC0; }
constexpr bool initiates_block_upload(std::uint8_t command) { return (command & 0xFBU) == 0xA0; }

std::uint32_t number_in(const SdoBytes& frame, std::size_t first) {
  return frame[first] | (std::uint32_t{frame[first + 1]} << 8) | (std::uint32_t{frame[first + 2]} << 16) |
         (std::uint32_t{frame[first + 3]} << 24);
}

}  // namespace

// Returns a text up to its first NUL, and only whole characters after a transfer that was aborted within one.
Bytes SdoObject::shown() const {
  auto end = kind == Kind::text ? std::find(value.begin(), value.end(), 0) : value.end();
  end -= kind == Kind::characters ? static_cast<std::ptrdiff_t>(value.size() % 2) : 0;
  return Bytes(value.begin(), end);
}

void SdoObject::set(const Bytes& bytes) {
  if (kind == Kind::domain) {
    std::copy(bytes.begin(), bytes.end(), value.begin());
  } else {
    value = bytes;
  }
}

// Requests and answers -----------------------------------------------------------------------------------------------

std::optional<SdoBytes> SdoServerModel::answer(const SdoBytes& request) {
  if (state_ == State::block_download && request[0] != 0x80) {
    return take_in_block(request);
  }
  if (state_ == State::block_download_end && request == last_segment_ && !is_right_end(request)) {
    return std::nullopt;
  }
  if (state_ == State::block_upload_end && request[0] == 0xA2) {  // repeated by a client that is waiting for the end
    return std::nullopt;
  }
  idle_ = 0;
  return answer_by_command(request);
}

std::vector<SdoBytes> SdoServerModel::answers(const SdoBytes& request) {
  std::vector<SdoBytes> all;
  if (const Answer first = answer(request); first) {
    all.push_back(*first);
  }
  for (Answer next = segment(); next; next = segment()) {
    all.push_back(*next);
  }
  return all;
}

SdoServerModel::Answer SdoServerModel::answer_by_command(const SdoBytes& request) {
  static constexpr std::uint8_t reserved[8] = {0x00, 0x10, 0x1F, 0x0F};
  const unsigned specifier = request[0] >> 5;
  if ((request[0] & reserved[specifier]) != 0) {
    return refuse(request, unknown_command);
  }
  switch (specifier) {
    case 0: return state_ == State::download ? take(request) : refuse(request, unknown_command);
    case 1: return initiate_download(request);
    case 2: return initiate_upload(request);
    case 3: return state_ == State::upload ? give(request) : refuse(request, unknown_command);
    case 4: state_ = State::idle; return std::nullopt;
    case 5: return answer_to_receiver(request);
    case 6: return answer_to_sender(request);
    default: return refuse(request, unknown_command);
  }
}

SdoServerModel::Answer SdoServerModel::answer_to_receiver(const SdoBytes& request) {
  if (initiates_block_upload(request[0])) {
    return initiate_block_upload(request);
  }
  switch (request[0]) {
    case 0xA1: return end_block_upload(request);
    case 0xA2: return acknowledged(request);
    case 0xA3: return start(request);
    default: return refuse(request, unknown_command);
  }
}

SdoServerModel::Answer SdoServerModel::answer_to_sender(const SdoBytes& request) {
  if (initiates_block_download(request[0])) {
    return initiate_block_download(request);
  }
  const bool ends = (request[0] & 0x03U) == 0x01 && state_ == State::block_download_end;
  return ends ? end_block_download(request) : refuse(request, unknown_command);
}

// Aborts with the multiplexer of the open transfer, or with that of the request if the server is idle. [D25]
SdoBytes SdoServerModel::refuse(const SdoBytes& request, std::uint32_t code) {
  if (state_ == State::idle) {
    std::copy_n(request.begin() + 1, 3, key_.begin());
  }
  return abort(code);
}

SdoBytes SdoServerModel::abort(std::uint32_t code) {
  state_ = State::idle;
  SdoBytes frame = head(0x80);
  for (unsigned n = 0; n < 4; ++n) {
    frame[4 + n] = static_cast<std::uint8_t>(code >> (8 * n));
  }
  return frame;
}

SdoBytes SdoServerModel::head(unsigned command) const {
  return {static_cast<std::uint8_t>(command), key_[0], key_[1], key_[2]};
}

SdoBytes SdoServerModel::head_with_size(unsigned command) const {
  SdoBytes frame = head(command);
  for (unsigned n = 0; n < 4; ++n) {
    frame[4 + n] = static_cast<std::uint8_t>(data_.size() >> (8 * n));
  }
  return frame;
}

std::optional<SdoBytes> SdoServerModel::slice() {
  if (state_ == State::idle) {
    return std::nullopt;
  }
  ++idle_;
  if (idle_ == slices) {
    return abort(timed_out);
  }
  const bool receives = state_ == State::block_download || state_ == State::block_download_end;
  if (!receives || idle_ % reminder_slices != 0) {
    return std::nullopt;
  }
  return highest_ != 0 ? end_block(false) : reminder_;
}

SdoBytes SdoServerModel::continued(bool shorter) const {
  const std::size_t left = data_.size() < size_ ? size_ - data_.size() : 0;
  const bool last = left <= segment_bytes || shorter;
  const auto byte = [](std::size_t value) { return static_cast<std::uint8_t>(value); };
  switch (state_) {
    case State::download: {
      const std::size_t length = std::min(segment_bytes, left > 0 && shorter ? left - 1 : left);
      return {byte(toggle_ | ((segment_bytes - length) << 1) | (last ? 1U : 0U))};
    }
    case State::block_download: return {byte((seq_ + 1) | (last ? 0x80U : 0U))};
    case State::block_download_end: {
      const std::size_t unused = std::min(segment_bytes, unused_at_end() + (shorter ? 1 : 0));
      const std::uint16_t crc = crc_16(Bytes(data_.begin(), data_.end() - static_cast<std::ptrdiff_t>(unused)));
      return {byte(0xC1U | (unused << 2)), byte(crc), byte(crc >> 8)};
    }
    case State::block_upload_ready: return {0xA3};
    case State::block_upload: return {0xA2, byte(shorter && seq_ > 0 ? seq_ - 1 : seq_), 127};
    case State::block_upload_end: return {0xA1};
    default: return {byte(0x60U | toggle_)};
  }
}

// Begin of all transfers ---------------------------------------------------------------------------------------------

SdoObject* SdoServerModel::find(const SdoBytes& request) {
  const auto found = std::find_if(objects_.begin(), objects_.end(), [&](const SdoObject& object) {
    return object.index == (request[1] | (request[2] << 8)) && object.sub == request[3];
  });
  return found == objects_.end() ? nullptr : &*found;
}

bool SdoServerModel::has_index(const SdoBytes& request) const {
  return std::any_of(objects_.begin(), objects_.end(),
                     [&](const SdoObject& object) { return object.index == (request[1] | (request[2] << 8)); });
}

// Ends the open transfer [D8] and looks up the object. Returns the abort code; 0: the object may be accessed.
std::uint32_t SdoServerModel::fault_of_access(const SdoBytes& request, bool upload) {
  state_ = State::idle;
  std::copy_n(request.begin() + 1, 3, key_.begin());
  object_ = find(request);
  if (object_ == nullptr) {
    return has_index(request) ? 0x06090011 : 0x06020000;
  }
  data_.clear();
  done_ = 0;
  toggle_ = 0;
  fault_ = 0;
  if (upload ? object_->readable : object_->writable) {
    return 0;
  }
  const bool none = !object_->readable && !object_->writable;
  return none ? 0x06010000 : upload ? 0x06010001 : 0x06010002;
}

// Returns the abort code of a download of this length; 0: the length is valid.
std::uint32_t SdoServerModel::fault_of_length(std::size_t length) const {
  const bool half_character = object_->kind == SdoObject::Kind::characters && length % 2 != 0;
  if (length > object_->capacity || half_character) {
    return too_long;
  }
  return length < object_->capacity && !object_->is_stream() ? too_short : 0;
}

// Returns the abort code of a complete download of this length; 0: the length is valid.
std::uint32_t SdoServerModel::fault_of_total(std::size_t length) const {
  if (!sized_) {
    return fault_of_length(length);
  }
  return length > size_ ? too_long : length < size_ ? too_short : 0;
}

std::uint32_t SdoServerModel::fault_of_value() const {
  return object_->kind == SdoObject::Kind::boolean && data_[0] > 1 ? 0x06090030 : 0;
}

std::uint32_t SdoServerModel::take_size(const SdoBytes& request, bool announced) {
  sized_ = announced;
  size_ = announced ? number_in(request, 4) : object_->capacity;
  return announced ? fault_of_length(size_) : 0;
}

// Expedited and segmented transfer -----------------------------------------------------------------------------------

SdoServerModel::Answer SdoServerModel::initiate_upload(const SdoBytes& request) {
  if (const std::uint32_t fault = fault_of_access(request, true); fault != 0) {
    return abort(fault);
  }
  data_ = object_->shown();
  if (data_.empty() || data_.size() > 4) {
    state_ = State::upload;
    return head_with_size(0x41);
  }
  SdoBytes frame = head(0x43U | static_cast<unsigned>((4 - data_.size()) << 2));
  std::copy(data_.begin(), data_.end(), frame.begin() + 4);
  return frame;
}

SdoServerModel::Answer SdoServerModel::initiate_download(const SdoBytes& request) {
  if (const std::uint32_t fault = fault_of_access(request, false); fault != 0) {
    return abort(fault);
  }
  if ((request[0] & 0x02U) != 0) {
    return expedited(request);
  }
  if (const std::uint32_t fault = take_size(request, (request[0] & 0x01U) != 0); fault != 0) {
    return abort(fault);
  }
  if (object_->is_stream()) {
    object_->set({});
  }
  state_ = State::download;
  return head(0x60);
}

SdoServerModel::Answer SdoServerModel::expedited(const SdoBytes& request) {
  const bool has_length = (request[0] & 0x01U) != 0;
  const std::uint32_t length = has_length ? 4U - ((request[0] >> 2) & 3U) : object_->capacity;
  if (length > 4) {
    return abort(wrong_length);
  }
  if (const std::uint32_t fault = fault_of_length(length); fault != 0) {
    return abort(fault);
  }
  data_.assign(request.begin() + 4, request.begin() + 4 + length);
  if (const std::uint32_t fault = fault_of_value(); fault != 0) {
    return abort(fault);
  }
  object_->set(data_);
  return head(0x60);
}

SdoServerModel::Answer SdoServerModel::take(const SdoBytes& request) {
  const std::uint8_t toggle = request[0] & 0x10U;
  const std::size_t left = size_ - data_.size();
  const bool is_open = (request[0] & 0x0FU) == 0x01 && sized_ && left > 0 && left <= segment_bytes;
  const std::size_t length = is_open ? left : segment_bytes - ((request[0] >> 1) & 7U);
  if (toggle != toggle_) {
    return abort(wrong_toggle);
  }
  if (data_.size() + length > size_) {
    return abort(too_long);
  }
  data_.insert(data_.end(), request.begin() + 1, request.begin() + 1 + static_cast<std::ptrdiff_t>(length));
  if (object_->is_stream()) {
    object_->set(data_);
  }
  toggle_ ^= 0x10;
  if ((request[0] & 0x01U) != 0) {
    const std::uint32_t length_fault = fault_of_total(data_.size());
    const std::uint32_t fault = length_fault != 0 ? length_fault : fault_of_value();
    if (fault != 0) {
      return abort(fault);
    }
    object_->set(data_);
    state_ = State::idle;
  }
  return SdoBytes{static_cast<std::uint8_t>(0x20U | toggle)};
}

SdoServerModel::Answer SdoServerModel::give(const SdoBytes& request) {
  const std::uint8_t toggle = request[0] & 0x10U;
  if (toggle != toggle_) {
    return abort(wrong_toggle);
  }
  const std::size_t length = std::min(segment_bytes, data_.size() - done_);
  const bool last = done_ + length == data_.size();
  SdoBytes frame = {static_cast<std::uint8_t>(toggle | ((segment_bytes - length) << 1) | (last ? 1U : 0U))};
  std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(done_), length, frame.begin() + 1);
  done_ += length;
  toggle_ ^= 0x10;
  state_ = last ? State::idle : State::upload;
  return frame;
}

}  // namespace test
