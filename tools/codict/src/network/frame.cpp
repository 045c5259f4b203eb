// SPDX-License-Identifier: Apache-2.0
#include "network/frame.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace lexican::codict::network {

namespace {

constexpr unsigned crc_bits = 15;
// CRC delimiter, ACK slot and delimiter, 7 bits end of frame, 3 bits interframe space: these are never stuffed.
constexpr unsigned tail_bits = 13;
constexpr unsigned longest_run = 5;

class Bits {
 public:
  void add(std::uint32_t value, unsigned count) {
    for (unsigned bit = count; bit-- != 0;) {
      bits_.push_back(((value >> bit) & 1U) != 0);
    }
  }
  const std::vector<bool>& all() const { return bits_; }

 private:
  std::vector<bool> bits_;
};

// Returns the bits from start of frame to DLC.
Bits header_of(const Frame& frame) {
  Bits bits;
  const std::uint32_t remote = frame.is_remote ? 1 : 0;
  bits.add(0, 1);
  if (frame.is_extended) {
    bits.add(frame.identifier >> 18, 11);
    bits.add(3, 2);  // SRR, IDE
    bits.add(frame.identifier & 0x3FFFFU, 18);
    bits.add(remote, 1);
    bits.add(0, 2);
  } else {
    bits.add(frame.identifier, 11);
    bits.add(remote, 1);
    bits.add(0, 2);  // IDE, r0
  }
  bits.add(frame.bytes, 4);
  return bits;
}

unsigned data_bytes(const Frame& frame) { return frame.is_remote ? 0 : frame.bytes; }

std::uint32_t crc_of(const std::vector<bool>& bits) {
  constexpr std::uint32_t polynomial = 0x4599;
  std::uint32_t crc = 0;
  for (const bool bit : bits) {
    const bool is_high = bit != ((crc & 0x4000U) != 0);
    crc = (crc << 1) & 0x7FFFU;
    crc ^= is_high ? polynomial : 0U;
  }
  return crc;
}

// Last transmitted bit, and the number of equal bits that end with it: 1…5.
struct Run {
  bool bit = true;
  unsigned length = 0;

  // Appends a bit. Returns true if a stuff bit follows, which begins the next run.
  bool append(bool next) {
    length = next == bit ? length + 1 : 1;
    bit = next;
    if (length < longest_run) {
      return false;
    }
    bit = !bit;
    length = 1;
    return true;
  }
};

}  // namespace

unsigned longest_bits(const Frame& frame) {
  const unsigned header = frame.is_extended ? 54 : 34;  // including the CRC
  const unsigned stuffed = header + 8 * data_bytes(frame);
  return stuffed + tail_bits + (stuffed - 1) / 4;
}

unsigned exact_bits(const Frame& frame, std::string_view data) {
  Bits bits = header_of(frame);
  for (const char byte : data) {
    bits.add(static_cast<unsigned char>(byte), 8);
  }
  bits.add(crc_of(bits.all()), crc_bits);
  unsigned length = tail_bits;
  Run run;
  for (const bool bit : bits.all()) {
    length += run.append(bit) ? 2U : 1U;
  }
  return length;
}

double mean_bits(const Frame& frame) {
  Run run;
  double length = tail_bits;
  const Bits header = header_of(frame);
  for (const bool bit : header.all()) {
    length += run.append(bit) ? 2U : 1U;
  }
  // Probability of each run length. For random bits, no other property of the preceding bits matters.
  std::array<double, longest_run> runs{};
  runs[run.length] = 1;
  for (unsigned left = 8 * data_bytes(frame) + crc_bits; left != 0; --left) {
    std::array<double, longest_run> next{};
    double stuffed = 0;
    for (std::size_t n = 1; n < longest_run; ++n) {
      next[1] += runs[n] / 2;
      (n + 1 == longest_run ? stuffed : next[n + 1]) += runs[n] / 2;
    }
    next[1] += stuffed;
    length += 1 + stuffed;
    runs = next;
  }
  return length;
}

}  // namespace lexican::codict::network
