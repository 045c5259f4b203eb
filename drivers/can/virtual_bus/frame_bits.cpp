// SPDX-License-Identifier: Apache-2.0
#include "frame_bits.hpp"

#include <algorithm>
#include <cstdint>

namespace co {
namespace {

constexpr std::uint32_t crc_polynomial = 0x4599;  // x^15 + x^14 + x^10 + x^8 + x^7 + x^4 + x^3 + 1
constexpr unsigned crc_width = 15;
constexpr unsigned stuff_after = 5;        // equal bits
constexpr unsigned unstuffed = 1 + 2 + 7;  // bits: CRC delimiter, ACK slot and delimiter, EOF
constexpr std::uint8_t bytes_at_most = 8;  // DLC 9…15 stand for 8 bytes

// The stuffed part of a frame, bit by bit in the order of transmission. 0 is dominant.
class StuffedBits {
 public:
  void put(std::uint32_t value, unsigned width) {  // highest bit first
    while (width > 0) {
      --width;
      const std::uint32_t bit = (value >> width) & 1;
      add_to_crc(bit);
      send(bit);
    }
  }

  void put_crc() { put(crc_, crc_width); }

  unsigned count() const { return count_; }

 private:
  void add_to_crc(std::uint32_t bit) {
    const std::uint32_t divide = bit ^ (crc_ >> (crc_width - 1));
    crc_ = ((crc_ << 1) & ((1u << crc_width) - 1)) ^ (divide * crc_polynomial);
  }

  void send(std::uint32_t bit) {
    equal_ = (bit == last_) ? equal_ + 1 : 1;
    last_ = bit;
    ++count_;
    if (equal_ == stuff_after) {
      last_ = bit ^ 1;
      equal_ = 1;
      ++count_;
    }
  }

  std::uint32_t crc_ = 0;
  std::uint32_t last_ = 1;  // the bus is recessive before the frame
  unsigned equal_ = 0;
  unsigned count_ = 0;
};

void put_identifier(StuffedBits& bits, std::uint32_t id, std::uint32_t rtr, bool extended) {
  constexpr std::uint32_t srr_ide = 3;
  constexpr std::uint32_t reserved = 0;
  if (extended) {
    bits.put((id & CO_IF_FRM_ID) >> 18, 11);
    bits.put(srr_ide, 2);
    bits.put(id & 0x3FFFF, 18);
    bits.put(rtr, 1);
    bits.put(reserved, 2);
    return;
  }
  bits.put(id & 0x7FF, 11);
  bits.put(rtr, 1);
  bits.put(reserved, 2);  // IDE, too, is 0
}

}  // namespace

unsigned frame_bits(const CO_IF_FRM& frame) {
  constexpr std::uint32_t start_of_frame = 0;
  const bool remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
  StuffedBits bits;
  bits.put(start_of_frame, 1);
  put_identifier(bits, frame.Identifier, remote ? 1 : 0, (frame.Identifier & CO_IF_FRM_EXT) != 0);
  bits.put(frame.DLC, 4);
  const std::uint8_t bytes = remote ? std::uint8_t{0} : std::min(frame.DLC, bytes_at_most);
  for (std::uint8_t i = 0; i < bytes; ++i) {
    bits.put(frame.Data[i], 8);
  }
  bits.put_crc();
  return bits.count() + unstuffed;
}

}  // namespace co
