// SPDX-License-Identifier: Apache-2.0
// Computes the frames of SDO transfers with the bytes that CiA 301 specifies, without the stack.
#include "ideal.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "co_cfg.h"
#include "frame_bits.hpp"

namespace speed {
namespace {

constexpr std::size_t segment_bytes = 7;
constexpr std::size_t block_segments = 127;

using Payload = std::array<std::uint8_t, 8>;

class Wire {
 public:
  void request(const Payload& data) { put(0x600u + server_id, data); }
  void response(const Payload& data) { put(0x580u + server_id, data); }
  std::uint64_t bits() const { return bits_; }

 private:
  void put(std::uint32_t id, const Payload& data) {
    CO_IF_FRM frame{id, {}, 8};
    std::copy(data.begin(), data.end(), frame.Data);
    bits_ += co::frame_bits(frame) + co::intermission_bits;
  }

  std::uint64_t bits_ = 0;
};

std::uint8_t byte_of(std::size_t value, unsigned position) {
  return static_cast<std::uint8_t>(value >> (8 * position));
}

// Returns an initiate frame: command, multiplexer, and four bytes (data, a length or a block size).
Payload initiate(std::uint8_t command, std::size_t last = 0) {
  return {command,          byte_of(object_index, 0), byte_of(object_index, 1), object_sub,
          byte_of(last, 0), byte_of(last, 1),         byte_of(last, 2),         byte_of(last, 3)};
}

// Returns a segment: command and up to 7 bytes of \a data from position \a from on.
Payload segment(unsigned command, const Bytes& data, std::size_t from) {
  Payload payload{static_cast<std::uint8_t>(command)};
  std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(from), std::min(segment_bytes, data.size() - from),
              payload.begin() + 1);
  return payload;
}

std::size_t segments_of(const Bytes& data) { return (data.size() + segment_bytes - 1) / segment_bytes; }

// Returns the number of bytes of the last segment that hold no data.
unsigned unused(const Bytes& data) { return static_cast<unsigned>(segments_of(data) * segment_bytes - data.size()); }

std::size_t number_of(const Bytes& data) {
  return data[0] | (std::size_t{data[1]} << 8) | (std::size_t{data[2]} << 16) | (std::size_t{data[3]} << 24);
}

void add_expedited(Wire& wire, bool upload, const Bytes& data) {
  if (upload) {
    wire.request(initiate(0x40));
    wire.response(initiate(0x43, number_of(data)));
  } else {
    wire.request(initiate(0x23, number_of(data)));
    wire.response(initiate(0x60));
  }
}

void add_segmented(Wire& wire, bool upload, const Bytes& data) {
  wire.request(upload ? initiate(0x40) : initiate(0x21, data.size()));
  wire.response(upload ? initiate(0x41, data.size()) : initiate(0x60));
  const std::size_t segments = segments_of(data);
  for (std::size_t n = 0; n < segments; ++n) {
    const unsigned toggle = (n % 2 == 0) ? 0x00 : 0x10;
    const bool last = n + 1 == segments;
    const Payload piece = segment(toggle | (last ? (unused(data) << 1) | 1 : 0), data, n * segment_bytes);
    const Payload other = {static_cast<std::uint8_t>((upload ? 0x60 : 0x20) | toggle)};
    wire.request(upload ? other : piece);
    wire.response(upload ? piece : other);
  }
}

// CRC-16-CCITT, start value 0. [301:7.2.4.3.16]
std::uint16_t crc_of(const Bytes& data) {
  std::uint32_t crc = 0;
  for (const std::uint8_t byte : data) {
    crc ^= std::uint32_t{byte} << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc = ((crc << 1) ^ ((crc & 0x8000) != 0 ? 0x1021u : 0u)) & 0xFFFF;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

void add_block(Wire& wire, bool upload, const Bytes& data) {
  const auto from_source = [&](const Payload& payload) { upload ? wire.response(payload) : wire.request(payload); };
  const auto from_sink = [&](const Payload& payload) { upload ? wire.request(payload) : wire.response(payload); };
  if (upload) {
    // the client may choose any protocol switch threshold; this is Lexican's default
    wire.request(initiate(0xA4, block_segments | std::size_t{28} << 8));
    wire.response(initiate(0xC6, data.size()));
    wire.request({0xA3});
  } else {
    wire.request(initiate(0xC6, data.size()));
    wire.response(initiate(0xA4, block_segments));
  }
  const std::size_t segments = segments_of(data);
  for (std::size_t n = 0; n < segments; ++n) {
    const unsigned number = static_cast<unsigned>(n % block_segments) + 1;
    const bool last = n + 1 == segments;
    from_source(segment(number | (last ? 0x80 : 0), data, n * segment_bytes));
    if (number == block_segments || last) {
      from_sink({0xA2, static_cast<std::uint8_t>(number), block_segments});
    }
  }
  const std::uint16_t crc = crc_of(data);
  from_source({static_cast<std::uint8_t>(0xC1 | (unused(data) << 2)), byte_of(crc, 0), byte_of(crc, 1)});
  from_sink({0xA1});
}

}  // namespace

std::uint64_t ideal_bits(const Transfers& transfers) {
  Wire wire;
  for (const Bytes& data : transfers.data) {
    switch (transfers.way) {
      case Way::expedited: add_expedited(wire, transfers.upload, data); break;
      case Way::segmented: add_segmented(wire, transfers.upload, data); break;
      case Way::block: add_block(wire, transfers.upload, data); break;
    }
  }
  return wire.bits();
}

}  // namespace speed
