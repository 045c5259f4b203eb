// SPDX-License-Identifier: Apache-2.0
/// \file log.hpp
/// Reads and writes files with recorded CAN frames: candump logs (can-utils), pcapng and pcap with the link type
/// SocketCAN (Wireshark, tcpdump), and ASC (Vector); ASC and pcap are only read. Files are read as streams: the memory
/// in use does not depend on their size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "co_if_can.h"

namespace lexican::host_bus {

using Micros = std::uint64_t;                                          ///< microseconds
constexpr Micros max_time = (UINT64_MAX / 1'000'000 - 1) * 1'000'000;  ///< later times in a log are read as this one

enum class Direction : std::uint8_t { unknown, received, sent };

/// Frame of a log.
struct Entry {
  Micros time = 0;    ///< since 1970; ASC: since the beginning of the measurement
  CO_IF_FRM frame{};  ///< also a remote frame, or an error frame in the coding of SocketCAN
  Direction direction = Direction::unknown;
  std::uint16_t channel = 0;  ///< position in LogReader::channels()
};

class LogReader {
 public:
  static constexpr std::size_t max_channels = 64;  ///< frames of further ones have the last one
  static constexpr std::size_t max_line = 4096;
  static constexpr std::size_t max_block = 1U << 20;  ///< bytes

  virtual ~LogReader() = default;
  /// Reads the next frame.
  /// \retval std::nullopt  the log has ended, see fault()
  virtual std::optional<Entry> next() = 0;

  /// Returns the error that ended reading; empty before the end, and after a regular end.
  const std::string& fault() const { return fault_; }
  /// Returns the names of the interfaces in the order of their first frame. They are printable, without spaces.
  const std::vector<std::string>& channels() const { return channels_; }
  /// Returns the number of frames that, according to the log, were lost when it was recorded, before the last entry.
  std::uint64_t lost() const { return lost_; }
  /// Returns the number of CAN FD and CAN XL frames so far. They are not returned: CANopen has classic frames.
  std::uint64_t other_frames() const { return other_frames_; }
  /// Returns the number of lines or packets so far that are not a frame of the format.
  std::uint64_t malformed() const { return malformed_; }

 protected:
  std::uint16_t channel_of(std::string_view recorded);

  std::string fault_;
  std::vector<std::string> channels_;
  std::uint64_t lost_ = 0;
  std::uint64_t other_frames_ = 0;
  std::uint64_t malformed_ = 0;
};

/// Recognises the format by the first bytes. \a stream must outlive the reader.
/// \retval nullptr  the file cannot be read, or its format is unknown; \a why says so, and how to convert it
std::unique_ptr<LogReader> read_log(std::istream& stream, std::string& why);

class LogWriter {
 public:
  virtual ~LogWriter() = default;
  virtual void write(const Entry& entry) = 0;
  /// Records that frames were lost. \a number: since the last call.
  virtual void write_lost(Micros time, std::uint32_t number) = 0;
};

/// Selects the format by the name of the file: pcapng if it ends with ".pcapng", else that of candump. \a channel: name
/// of the interface; Entry::channel is not used. The caller checks the state of \a stream, which must outlive the
/// writer. \retval nullptr  the name ends like that of another format (.pcap, .asc, .blf, .trc, .gz)
std::unique_ptr<LogWriter> write_log(std::ostream& stream, std::string_view name, std::string_view channel);

/// Returns a frame in the notation of candump and cansend: 123#DEADBEEF, 123#R8, 12345678#.
std::string to_text(const CO_IF_FRM& frame);

enum class Parsed : std::uint8_t { frame, other_frame, malformed };

/// Parses a frame in the notation of candump and cansend, also an error frame (20000004#...).
/// \retval Parsed::frame        \a frame holds it
/// \retval Parsed::other_frame  a CAN FD or CAN XL frame
/// \retval Parsed::malformed    it is not a frame
Parsed parse_frame(std::string_view text, CO_IF_FRM& frame);

}  // namespace lexican::host_bus
