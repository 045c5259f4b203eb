// SPDX-License-Identifier: Apache-2.0
#include "can_frame.hpp"

#include <doctest/doctest.h>

#include <random>

#include "can/virtual_bus/frame_bits.hpp"

using namespace test;

namespace {

struct Decoded {
  CanDecoder::Result result = CanDecoder::Result::more;
  std::size_t bits = 0;
};

Decoded decode(CanDecoder& decoder, const std::vector<CanBit>& bits) {
  Decoded decoded;
  for (const CanBit& bit : bits) {
    ++decoded.bits;
    decoded.result = decoder.add(bit.level);
    if (decoded.result != CanDecoder::Result::more) {
      break;
    }
  }
  return decoded;
}

CanFrame random_frame(std::mt19937& random) {
  CanFrame frame;
  frame.is_extended = random() % 2 == 0;
  frame.id = static_cast<std::uint32_t>(random()) & (frame.is_extended ? 0x1FFFFFFF : 0x7FF);
  frame.dlc = static_cast<std::uint8_t>(random() % 16);
  frame.is_remote = random() % 4 == 0;
  const bool is_dull = random() % 2 == 0;  // many stuff bits
  for (std::uint8_t& byte : frame.data) {
    byte = static_cast<std::uint8_t>(is_dull ? random() % 2 * 255 : random());
  }
  return frame;
}

unsigned other_length(const CanFrame& frame) {
  CO_IF_FRM other{};
  other.Identifier = frame.id | (frame.is_extended ? CO_IF_FRM_EXT : 0) | (frame.is_remote ? CO_IF_FRM_RTR : 0);
  other.DLC = frame.dlc;
  std::copy(frame.data.begin(), frame.data.begin() + 8, other.Data);
  return co::frame_bits(other);
}

}  // namespace

TEST_CASE("can frame: the CRC of CAN of a known sequence") {
  // ASCII "123456789": CRC-15/CAN is 059Eh, from the public catalogue of CRC algorithms.
  CanCrc crc(15, 0x4599, 0);
  for (const char letter : {'1', '2', '3', '4', '5', '6', '7', '8', '9'}) {
    for (int bit = 7; bit >= 0; --bit) {
      crc.add(((letter >> bit) & 1) != 0);
    }
  }
  CHECK(crc.value() == 0x059E);
}

TEST_CASE("can frame: lengths agree with the virtual bus") {
  std::mt19937 random(1);
  for (unsigned i = 0; i < 2000; ++i) {
    const CanFrame frame = random_frame(random);
    REQUIRE(frame_bits(frame) == other_length(frame));
  }
}

TEST_CASE("can frame: encoded frames are decoded") {
  std::mt19937 random(2);
  for (unsigned i = 0; i < 2000; ++i) {
    CanFrame frame = random_frame(random);
    if (i % 2 == 0) {
      frame.is_fd = true;
      frame.is_remote = false;
      frame.has_esi = i % 4 == 0;
      frame.has_brs = i % 8 == 0;
    }
    CanDecoder decoder(FdMode::enabled);
    const std::vector<CanBit> bits = encode(frame);
    const Decoded decoded = decode(decoder, bits);
    REQUIRE(decoded.result == CanDecoder::Result::complete);
    REQUIRE(decoded.bits == bits.size());
    REQUIRE(decoder.crc_is_right());
    REQUIRE(decoder.frame() == frame);
  }
}

TEST_CASE("can frame: an inverted bit is detected, or changes the frame") {
  std::mt19937 random(3);
  for (unsigned i = 0; i < 300; ++i) {
    const CanFrame frame = random_frame(random);
    std::vector<CanBit> bits = encode(frame);
    const std::size_t at = 1 + random() % (bits.size() - 1);
    bits[at].level = !bits[at].level;
    CanDecoder decoder(FdMode::classic);
    const Decoded decoded = decode(decoder, bits);
    REQUIRE_FALSE((decoded.result == CanDecoder::Result::complete && decoder.crc_is_right() &&
                   decoder.frame() == frame && decoded.bits == bits.size()));
  }
}

TEST_CASE("can frame: the FD format has fixed stuff bits in the CRC field") {
  // 17-bit CRC: 4 bits stuff count, 17 bits CRC, 6 fixed stuff bits. 21-bit CRC: 4, 21 and 7.
  const CanFrame shorter = fd_frame(0x555, 10);  // 16 bytes
  const CanFrame longer = fd_frame(0x555, 11);   // 20 bytes
  const auto fixed = [](const CanFrame& frame) {
    const std::vector<CanBit> bits = encode(frame);
    const std::size_t field = frame.bytes() <= 16 ? 27 : 32;
    std::size_t count = 0;
    for (std::size_t i = bits.size() - field; i < bits.size(); i += 5) {
      REQUIRE(bits[i].is_stuff);
      REQUIRE(bits[i].level != bits[i - 1].level);
      ++count;
    }
    return count;
  };
  CHECK(fixed(shorter) == 6);
  CHECK(fixed(longer) == 7);
}

TEST_CASE("can frame: a wrong fixed stuff bit is a form error") {
  std::vector<CanBit> bits = encode(fd_frame(0x123, 8));
  bits[bits.size() - 27].level = !bits[bits.size() - 27].level;
  CanDecoder decoder(FdMode::enabled);
  CHECK(decode(decoder, bits).result == CanDecoder::Result::form_error);
}

TEST_CASE("can frame: a recessive FDF bit is accepted, an exception or an FD frame") {
  const std::vector<CanBit> bits = encode(fd_frame(0x2AA, 8));
  CanDecoder tolerant(FdMode::tolerant);
  const Decoded exception = decode(tolerant, bits);
  CHECK(exception.result == CanDecoder::Result::protocol_exception);
  CHECK(exception.bits == 15);  // SOF, 11 bits, RRS, IDE, FDF: no stuff bit in this identifier
  CanDecoder enabled(FdMode::enabled);
  CHECK(decode(enabled, bits).result == CanDecoder::Result::complete);
  CanDecoder classic(FdMode::classic);
  const Decoded wrong = decode(classic, bits);
  CHECK((wrong.result == CanDecoder::Result::stuff_error || !classic.crc_is_right()));
}

TEST_CASE("can frame: a recessive bit after FDF is an exception for an FD node") {
  std::vector<CanBit> bits = encode(fd_frame(0x2AA, 8));
  bits[15].level = recessive;
  CanDecoder enabled(FdMode::enabled);
  const Decoded decoded = decode(enabled, bits);
  CHECK(decoded.result == CanDecoder::Result::protocol_exception);
  CHECK(decoded.bits == 16);
}

TEST_CASE("can frame: the order of arbitration") {
  const CanFrame standard = standard_frame(0x123);
  const CanFrame extended = extended_frame(0x123U << 18);
  CHECK(arbitration_value(standard) < arbitration_value(remote_frame(standard)));
  CHECK(arbitration_value(remote_frame(standard)) < arbitration_value(extended));
  CHECK(arbitration_value(extended) < arbitration_value(remote_frame(extended)));
  CHECK(arbitration_value(remote_frame(extended)) < arbitration_value(extended_frame((0x123U << 18) + 1)));
  CHECK(arbitration_value(extended_frame((0x123U << 18) + 1)) < arbitration_value(standard_frame(0x124)));
}
