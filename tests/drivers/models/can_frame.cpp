// SPDX-License-Identifier: Apache-2.0
#include "can_frame.hpp"

#include <algorithm>

namespace test {
namespace {

constexpr unsigned longest_run = 5;
constexpr unsigned tail_bits = 10;  // CRC delimiter, ACK slot, ACK delimiter, end of frame
constexpr unsigned longest_data_of_crc17 = 16;

CanCrc classic_crc() { return {15, 0x4599, 0}; }
CanCrc short_fd_crc() { return {17, 0x1685B, 1U << 16}; }
CanCrc long_fd_crc() { return {21, 0x102899, 1U << 20}; }

// Returns the number of stuff bits modulo 8 as Gray code with an even parity bit. [ISO 11898-1:2015, Table 5]
std::uint32_t stuff_count_field(unsigned stuff_bits) {
  const unsigned count = stuff_bits % 8;
  const unsigned gray = count ^ (count >> 1);
  const unsigned parity = ((gray >> 2) ^ (gray >> 1) ^ gray) & 1;
  return gray << 1 | parity;
}

class Encoder {
 public:
  explicit Encoder(const CanFrame& frame) : frame_(frame) {}

  std::vector<CanBit> encode() {
    put(0, 1);
    in_arbitration_ = true;
    put_identifier();
    in_arbitration_ = false;
    put_control();
    for (unsigned i = 0; i < frame_.bytes(); ++i) {
      put(frame_.data[i], 8);
    }
    if (frame_.is_fd) {
      put_fd_crc();
    } else {
      put(crc15_.value(), crc15_.width());
      add_pending_stuff_bit();
    }
    return bits_;
  }

 private:
  void put_identifier() {
    const std::uint32_t remote = frame_.is_remote && !frame_.is_fd ? 1 : 0;
    if (frame_.is_extended) {
      put(frame_.id >> 18, 11);
      put(3, 2);  // SRR, IDE
      put(frame_.id & 0x3FFFF, 18);
      put(remote, 1);
    } else {
      put(frame_.id, 11);
      put(remote, 1);
    }
  }

  void put_control() {
    if (!frame_.is_extended) {
      put(0, 1);  // IDE
    }
    if (frame_.is_fd) {
      put(2, 2);  // FDF, res
      put(frame_.has_brs ? 1 : 0, 1);
      put(frame_.has_esi ? 1 : 0, 1);
    } else {
      put(0, frame_.is_extended ? 2 : 1);
    }
    put(frame_.dlc, 4);
  }

  void put(std::uint32_t value, unsigned width) {  // highest bit first
    while (width-- != 0) {
      add_pending_stuff_bit();
      const bool level = ((value >> width) & 1) != 0;
      crc15_.add(level);
      add(level, false);
    }
  }

  void add_pending_stuff_bit() {
    if (run_ == longest_run) {
      ++stuff_bits_;
      add(!bits_.back().level, true);
    }
  }

  void add(bool level, bool is_stuff) {
    run_ = !bits_.empty() && bits_.back().level == level ? run_ + 1 : 1;
    crc17_.add(level);
    crc21_.add(level);
    bits_.push_back({level, is_stuff, in_arbitration_});
  }

  // Adds the stuff bit count and the CRC, with a fixed stuff bit before each four bits.
  void put_fd_crc() {
    CanCrc crc = frame_.bytes() <= longest_data_of_crc17 ? crc17_ : crc21_;
    const std::uint32_t count = stuff_count_field(stuff_bits_);
    for (unsigned bit = 4; bit-- != 0;) {
      crc.add(((count >> bit) & 1) != 0);
    }
    const std::uint64_t field = std::uint64_t{count} << crc.width() | crc.value();
    const unsigned width = crc.width() + 4;
    for (unsigned i = 0; i < width; ++i) {
      if (i % 4 == 0) {
        bits_.push_back({!bits_.back().level, true, false});
      }
      bits_.push_back({((field >> (width - 1 - i)) & 1) != 0, false, false});
    }
  }

  const CanFrame& frame_;
  std::vector<CanBit> bits_;
  CanCrc crc15_ = classic_crc();
  CanCrc crc17_ = short_fd_crc();
  CanCrc crc21_ = long_fd_crc();
  unsigned run_ = 0;
  unsigned stuff_bits_ = 0;
  bool in_arbitration_ = false;
};

CanFrame frame_of(std::uint32_t id, bool is_extended, std::initializer_list<std::uint8_t> data) {
  CanFrame frame;
  frame.id = id;
  frame.is_extended = is_extended;
  frame.dlc = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

}  // namespace

unsigned CanFrame::bytes() const {
  constexpr std::array<std::uint8_t, 16> of_dlc = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  if (is_fd) {
    return of_dlc[dlc & 15];
  }
  return is_remote ? 0 : std::min<unsigned>(dlc, 8);
}

bool operator==(const CanFrame& one, const CanFrame& other) {
  return one.id == other.id && one.is_extended == other.is_extended && one.is_remote == other.is_remote &&
         one.is_fd == other.is_fd && one.has_brs == other.has_brs && one.has_esi == other.has_esi &&
         one.dlc == other.dlc && std::equal(one.data.begin(), one.data.begin() + one.bytes(), other.data.begin());
}

CanFrame standard_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data) {
  return frame_of(id, false, data);
}

CanFrame extended_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data) { return frame_of(id, true, data); }

CanFrame remote_frame(CanFrame frame, std::uint8_t dlc) {
  frame.is_remote = true;
  frame.dlc = dlc;
  frame.data = {};
  return frame;
}

CanFrame fd_frame(std::uint32_t id, std::uint8_t dlc) {
  CanFrame frame;
  frame.id = id;
  frame.is_fd = true;
  frame.dlc = dlc;
  for (unsigned i = 0; i < frame.bytes(); ++i) {
    frame.data[i] = static_cast<std::uint8_t>(i);
  }
  return frame;
}

std::uint64_t arbitration_value(const CanFrame& frame) {
  const std::uint64_t remote = frame.is_remote ? 1 : 0;
  if (!frame.is_extended) {
    return (std::uint64_t{frame.id} << 2 | remote << 1) << 19;
  }
  return (std::uint64_t{frame.id >> 18} << 2 | 3) << 19 | std::uint64_t{frame.id & 0x3FFFF} << 1 | remote;
}

std::vector<CanBit> encode(const CanFrame& frame) { return Encoder(frame).encode(); }

unsigned frame_bits(const CanFrame& frame) { return static_cast<unsigned>(encode(frame).size()) + tail_bits; }

CanCrc::CanCrc(unsigned width, std::uint32_t polynomial, std::uint32_t initial)
    : width_(width), polynomial_(polynomial), value_(initial) {}

void CanCrc::add(bool bit) {
  const bool divides = bit != (((value_ >> (width_ - 1)) & 1) != 0);
  value_ = (value_ << 1) & ((1U << width_) - 1);
  if (divides) {
    value_ ^= polynomial_ & ((1U << width_) - 1);
  }
}

CanDecoder::CanDecoder(FdMode mode)
    : mode_(mode), crc15_(classic_crc()), crc17_(short_fd_crc()), crc21_(long_fd_crc()) {}

CanDecoder::Result CanDecoder::add(bool level) {
  if (in_fd_crc_) {
    return add_fd_crc(level);
  }
  const bool is_stuff = is_stuff_next_;
  if (is_stuff && level == last_) {
    return Result::stuff_error;
  }
  run_ = level == last_ ? run_ + 1 : 1;
  last_ = level;
  is_stuff_next_ = run_ == longest_run;
  crc17_.add(level);
  crc21_.add(level);
  if (is_stuff) {
    ++stuff_bits_;
    return is_at_end_ ? Result::complete : Result::more;
  }
  return add_unstuffed(level);
}

CanDecoder::Result CanDecoder::add_unstuffed(bool level) {
  bits_.push_back(level);
  const auto count = static_cast<unsigned>(bits_.size());
  if (data_end_ == 0) {
    const Result result = add_control(count, level);
    if (result != Result::more || data_end_ == 0) {
      return result;
    }
  }
  if (count <= data_end_) {
    add_data(count);
    if (frame_.is_fd && count == data_end_) {
      in_fd_crc_ = true;
    }
    return Result::more;
  }
  if (count < data_end_ + crc15_.width()) {
    return Result::more;
  }
  check_crc();
  is_at_end_ = true;
  return is_stuff_next_ ? Result::more : Result::complete;
}

// Decodes the bits up to the DLC; count includes this bit.
CanDecoder::Result CanDecoder::add_control(unsigned count, bool level) {
  const unsigned index = count - 1;
  if (index == 13) {
    frame_.is_extended = level;
  }
  if (count < 14) {
    return Result::more;
  }
  if (index == fdf_index() && level == recessive) {
    if (mode_ == FdMode::tolerant) {
      return Result::protocol_exception;
    }
    frame_.is_fd = mode_ == FdMode::enabled;
  }
  if (frame_.is_fd && index == fdf_index() + 1 && level == recessive) {
    return Result::protocol_exception;
  }
  const unsigned classic_end = frame_.is_extended ? fdf_index() + 6 : fdf_index() + 5;
  control_end_ = frame_.is_fd ? fdf_index() + 8 : classic_end;
  if (count == control_end_) {
    begin_data(count);
  }
  return Result::more;
}

void CanDecoder::begin_data(unsigned count) {
  frame_.id = value(1, 11);
  frame_.is_remote = bits_[12];
  if (frame_.is_extended) {
    frame_.id = frame_.id << 18 | value(14, 18);
    frame_.is_remote = bits_[32];
  }
  if (frame_.is_fd) {
    frame_.is_remote = false;
    frame_.has_brs = bits_[fdf_index() + 2];
    frame_.has_esi = bits_[fdf_index() + 3];
  }
  frame_.dlc = static_cast<std::uint8_t>(value(count - 4, 4));
  data_end_ = count + 8 * frame_.bytes();
}

void CanDecoder::add_data(unsigned count) {
  if (count > control_end_ && (count - control_end_) % 8 == 0) {
    frame_.data[(count - control_end_) / 8 - 1] = static_cast<std::uint8_t>(value(count - 8, 8));
  }
}

void CanDecoder::check_crc() {
  for (unsigned i = 0; i < data_end_; ++i) {
    crc15_.add(bits_[i]);
  }
  crc_is_right_ = crc15_.value() == value(data_end_, crc15_.width());
}

CanDecoder::Result CanDecoder::add_fd_crc(bool level) {
  const bool is_stuff = fd_crc_at_++ % 5 == 0;
  if (is_stuff && level == last_) {
    return Result::form_error;
  }
  last_ = level;
  if (is_stuff) {
    return Result::more;
  }
  fd_crc_bits_.push_back(level);
  const CanCrc& crc = frame_.bytes() <= longest_data_of_crc17 ? crc17_ : crc21_;
  if (fd_crc_bits_.size() < crc.width() + 4) {
    return Result::more;
  }
  check_fd_crc();
  return Result::complete;
}

void CanDecoder::check_fd_crc() {
  CanCrc crc = frame_.bytes() <= longest_data_of_crc17 ? crc17_ : crc21_;
  std::uint64_t received = 0;
  for (unsigned i = 0; i < fd_crc_bits_.size(); ++i) {
    received = received << 1 | (fd_crc_bits_[i] ? 1U : 0U);
    if (i < 4) {
      crc.add(fd_crc_bits_[i]);
    }
  }
  const std::uint64_t expected = std::uint64_t{stuff_count_field(stuff_bits_)} << crc.width() | crc.value();
  crc_is_right_ = received == expected;
}

std::uint32_t CanDecoder::value(unsigned first, unsigned width) const {
  std::uint32_t result = 0;
  for (unsigned i = first; i < first + width; ++i) {
    result = result << 1 | (bits_[i] ? 1U : 0U);
  }
  return result;
}

}  // namespace test
