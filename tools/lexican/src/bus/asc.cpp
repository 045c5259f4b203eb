// SPDX-License-Identifier: Apache-2.0
// ASC, the text format of Vector's tools:
//   date Mon Nov 2 09:00:00.000 am 2026
//   base hex  timestamps absolute
//      0.012345 1  123             Rx   d 8 01 02 03 04 05 06 07 08  Length = 0 BitCount = 64 ID = 291
//      0.020000 1  18FF1234x       Tx   r 8
//      0.030000 1  ErrorFrame
//      0.040000 CANFD 1 Rx ...
// Lines of other events and of measurements are ignored.
#include <algorithm>

#include "bus/log_formats.hpp"

namespace lexican::host_bus {
namespace {

constexpr std::uint32_t bus_error = 0x88;  // CAN_ERR_PROT | CAN_ERR_BUSERROR of SocketCAN
constexpr std::size_t max_words = 96;

// Flags of a frame on a line of CAN FD.
constexpr std::uint32_t fd_remote = 0x10;
constexpr std::uint32_t fd_format = 0x1000;

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Compares with a word in lower case.
bool is_word(std::string_view text, std::string_view word) {
  return std::equal(text.begin(), text.end(), word.begin(), word.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b; });
}

class AscReader : public LogReader {
 public:
  explicit AscReader(LogInput input) : input_(std::move(input)) {}

  std::optional<Entry> next() override {
    bool is_whole = true;
    while (input_.read_line(line_, is_whole)) {
      split(line_, max_words, words_);
      Entry entry;
      if (read_time(entry) && count(is_whole ? parse(entry) : Result::malformed)) {
        return entry;
      }
    }
    fault_ = input_.is_broken() ? "the file cannot be read to its end" : "";
    return std::nullopt;
  }

 private:
  enum class Result : std::uint8_t { frame, other_frame, other_event, malformed };

  bool count(Result result) {
    other_frames_ += result == Result::other_frame ? 1 : 0;
    malformed_ += result == Result::malformed ? 1 : 0;
    return result == Result::frame;
  }

  /// \retval false  a line without time; the base of the numbers is stored
  bool read_time(Entry& entry) {
    if (words_.size() >= 2 && is_word(words_[0], "base")) {
      base_ = is_word(words_[1], "dec") ? 10 : 16;
      is_relative_ = words_.size() >= 4 && is_word(words_[3], "relative");
      return false;
    }
    Micros time = 0;
    if (words_.size() < 2 || !parse_seconds(words_[0], time)) {
      return false;
    }
    time_ = is_relative_ ? std::min(time_, max_time - time) + time : time;
    entry.time = time_;
    return true;
  }

  Result parse(Entry& entry) {
    if (is_word(words_[1], "canfd")) {
      return parse_fd(entry);
    }
    if (words_.size() < 3 || !is_number(words_[1])) {
      return is_word(words_[1], "canxl") ? Result::other_frame : Result::other_event;
    }
    if (is_word(words_[2], "errorframe")) {
      return error_frame(entry, words_[1]);
    }
    // The request to send (TxRq) is followed by the frame when it is on the bus.
    if (words_.size() < 4 || !parse_direction(words_[3], entry)) {
      return Result::other_event;
    }
    const bool is_valid = parse_identifier(words_[2], entry.frame) && parse_content(entry.frame);
    return is_valid ? in_channel(entry, words_[1]) : Result::malformed;
  }

  /// Parses CANFD CHANNEL DIRECTION ID [NAME] BRS ESI DLC LENGTH DATA... DURATION BITS FLAGS ...: channels of CAN FD
  /// have frames of classic CAN, too.
  Result parse_fd(Entry& entry) {
    if (words_.size() < 5 || !parse_direction(words_[3], entry)) {
      return Result::other_event;
    }
    if (is_word(words_[4], "errorframe")) {
      return error_frame(entry, words_[2]);
    }
    const std::size_t first = words_.size() > 5 && !is_number(words_[5]) ? 6 : 5;
    unsigned length = 0;
    if (words_.size() <= first + 3 || !parse_number(words_[first + 3], length) || length > 64) {
      return Result::malformed;
    }
    const std::size_t data = first + 4;
    std::uint32_t flags = fd_format;
    if (words_.size() <= data + length + 2 || !parse_number(words_[data + length + 2], flags, 16) ||
        (flags & fd_format) != 0) {
      return Result::other_frame;
    }
    CO_IF_FRM& frame = entry.frame;
    if (!parse_identifier(words_[4], frame) || length > 8) {
      return Result::malformed;
    }
    if ((flags & fd_remote) != 0) {
      frame.Identifier |= CO_IF_FRM_RTR;
      return in_channel(entry, words_[2]);
    }
    frame.DLC = static_cast<std::uint8_t>(length);
    return parse_data(data, 16, frame) ? in_channel(entry, words_[2]) : Result::malformed;
  }

  Result error_frame(Entry& entry, std::string_view channel) {
    entry.frame.Identifier = CO_IF_FRM_ERROR | bus_error;
    entry.frame.DLC = 8;
    entry.direction = Direction::unknown;
    return in_channel(entry, channel);
  }

  Result in_channel(Entry& entry, std::string_view channel) {
    entry.channel = channel_of(channel);
    return Result::frame;
  }

  static bool parse_direction(std::string_view text, Entry& entry) {
    entry.direction = is_word(text, "rx") ? Direction::received : Direction::sent;
    return is_word(text, "rx") || is_word(text, "tx");
  }

  /// Parses an identifier. In place of a symbolic one, the number behind "ID =" at the end of the line is used, which
  /// is decimal.
  bool parse_identifier(std::string_view id, CO_IF_FRM& frame) {
    if (parse_id(id, base_, frame)) {
      return true;
    }
    const auto equals = std::find(words_.begin() + 4, words_.end(), "ID");
    return !is_number(id.substr(0, 1)) && words_.end() - equals > 2 && equals[1] == "=" &&
           parse_id(equals[2], 10, frame);
  }

  static bool parse_id(std::string_view id, int base, CO_IF_FRM& frame) {
    const bool is_extended = id.back() == 'x' || id.back() == 'X';
    id.remove_suffix(is_extended ? 1 : 0);
    if (!parse_number(id, frame.Identifier, base) || frame.Identifier > (is_extended ? max_extended_id : max_base_id)) {
      return false;
    }
    frame.Identifier |= is_extended ? CO_IF_FRM_EXT : 0;
    return true;
  }

  /// Parses the words behind the direction: d LENGTH DATA..., or r [LENGTH].
  bool parse_content(CO_IF_FRM& frame) {
    unsigned length = 0;
    // Decimal files have decimal lengths of 10 and more.
    const bool has_length = words_.size() > 5 && (parse_number(words_[5], length, 16) && length <= 15
                                                      ? true
                                                      : parse_number(words_[5], length, base_) && length <= 15);
    frame.DLC = static_cast<std::uint8_t>(has_length ? std::min(length, 8U) : 0);
    if (words_.size() > 4 && words_[4] == "r") {
      frame.Identifier |= CO_IF_FRM_RTR;
      return true;
    }
    return has_length && words_[4] == "d" && parse_data(6, base_, frame);
  }

  bool parse_data(std::size_t first, int base, CO_IF_FRM& frame) {
    for (unsigned n = 0; n < frame.DLC; ++n) {
      if (words_.size() <= first + n || !parse_number(words_[first + n], frame.Data[n], base)) {
        return false;
      }
    }
    return true;
  }

  LogInput input_;
  std::string line_;
  std::vector<std::string_view> words_;
  int base_ = 16;
  bool is_relative_ = false;
  Micros time_ = 0;
};

}  // namespace

std::unique_ptr<LogReader> read_asc(LogInput input) { return std::make_unique<AscReader>(std::move(input)); }

}  // namespace lexican::host_bus
