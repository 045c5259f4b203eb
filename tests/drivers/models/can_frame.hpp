// SPDX-License-Identifier: Apache-2.0
/// \file can_frame.hpp
/// Frames of Classical CAN and CAN FD as sequences of bits. [ISO 11898-1:2015, 10.4]
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace test {

constexpr bool dominant = false;
constexpr bool recessive = true;

struct CanFrame {
  std::uint32_t id = 0;
  bool is_extended = false;
  bool is_remote = false;
  bool is_fd = false;
  bool has_brs = false;  ///< bit rate switch; the model transmits both phases at the nominal bit rate
  bool has_esi = false;  ///< error state indicator
  std::uint8_t dlc = 0;  ///< 0…15
  std::array<std::uint8_t, 64> data{};

  /// Returns the number of data bytes: 0 for a remote frame, at most 8 for a classic frame.
  unsigned bytes() const;
};

/// Compares all fields, and the data bytes that are transmitted.
bool operator==(const CanFrame& one, const CanFrame& other);
inline bool operator!=(const CanFrame& one, const CanFrame& other) { return !(one == other); }

CanFrame standard_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data = {});
CanFrame extended_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data = {});
/// Returns a frame with the same identifier, without data, with RTR.
CanFrame remote_frame(CanFrame frame, std::uint8_t dlc = 0);
/// Returns a CAN FD frame with dlc and data of 0, 1, 2, …
CanFrame fd_frame(std::uint32_t id, std::uint8_t dlc);

/// Returns the levels from identifier to IDE as they take part in arbitration: a lower value wins. Equal for a frame
/// and a frame with other data.
std::uint64_t arbitration_value(const CanFrame& frame);

/// A bit of the part of a frame from the start of frame up to the last bit of the CRC field.
struct CanBit {
  bool level = recessive;
  bool is_stuff = false;
  bool in_arbitration = false;  ///< from the first identifier bit up to RTR
};

std::vector<CanBit> encode(const CanFrame& frame);

/// Returns the number of bits from the start of frame up to and including the end of frame.
unsigned frame_bits(const CanFrame& frame);

/// The CRC of CAN: register of width bits.
class CanCrc {
 public:
  CanCrc(unsigned width, std::uint32_t polynomial, std::uint32_t initial);
  void add(bool bit);
  std::uint32_t value() const { return value_; }
  unsigned width() const { return width_; }

 private:
  unsigned width_;
  std::uint32_t polynomial_;
  std::uint32_t value_;
};

/// Reaction to a recessive FDF bit.
enum class FdMode : std::uint8_t {
  classic,   ///< CAN 2.0: a reserved bit is accepted with either level; the frame is decoded as a classic frame
  tolerant,  ///< protocol exception [ISO 11898-1:2015, 10.9.5]
  enabled    ///< the frame is received
};

/// Receives the bits of a frame, from the start of frame up to the last bit of the CRC field.
class CanDecoder {
 public:
  enum class Result : std::uint8_t { more, complete, stuff_error, form_error, protocol_exception };

  explicit CanDecoder(FdMode mode = FdMode::classic);
  Result add(bool level);

  /// Valid after Result::complete.
  bool crc_is_right() const { return crc_is_right_; }
  const CanFrame& frame() const { return frame_; }

 private:
  Result add_unstuffed(bool level);
  Result add_control(unsigned count, bool level);
  Result add_fd_crc(bool level);
  void begin_data(unsigned count);
  void add_data(unsigned count);
  void check_crc();
  void check_fd_crc();
  unsigned fdf_index() const { return frame_.is_extended ? 33 : 14; }
  std::uint32_t value(unsigned first, unsigned width) const;

  FdMode mode_;
  CanFrame frame_;
  std::vector<bool> bits_;         // without stuff bits
  std::vector<bool> fd_crc_bits_;  // stuff bit count and CRC, without fixed stuff bits
  CanCrc crc15_;
  CanCrc crc17_;
  CanCrc crc21_;
  unsigned stuff_bits_ = 0;
  unsigned fd_crc_at_ = 0;  // bits of the CRC field, with fixed stuff bits
  unsigned control_end_ = 0;
  unsigned data_end_ = 0;
  unsigned run_ = 0;  // equal bits that end with last_
  bool last_ = recessive;
  bool is_stuff_next_ = false;
  bool is_at_end_ = false;  // only a stuff bit follows
  bool in_fd_crc_ = false;
  bool crc_is_right_ = false;
};

}  // namespace test
