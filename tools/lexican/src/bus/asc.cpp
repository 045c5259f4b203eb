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
constexpr std::size_t most_words = 14;     // of a frame with 8 bytes

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

class AscReader : public LogReader {
 public:
  explicit AscReader(LogInput input) : input_(std::move(input)) {}

  std::optional<Entry> next() override {
    bool is_whole = true;
    while (input_.read_line(line_, is_whole)) {
      split(line_, most_words, words_);
      Entry entry;
      if (!words_.empty() && is_event(entry) && is_frame(entry, is_whole)) {
        return entry;
      }
    }
    return std::nullopt;
  }

 private:
  /// Reads the header lines, and the time of an event.
  bool is_event(Entry& entry) {
    if (words_.size() >= 2 && (words_[0] == "base" || words_[0] == "Base")) {
      base_ = words_[1] == "dec" ? 10 : 16;
      is_relative_ = words_.size() >= 4 && words_[3] == "relative";
      return false;
    }
    Micros time = 0;
    if (words_.size() < 2 || !parse_seconds(words_[0], time)) {
      return false;
    }
    time_ = is_relative_ && time < UINT64_MAX - time_ ? time_ + time : time;
    entry.time = time_;
    return true;
  }

  bool is_frame(Entry& entry, bool is_whole) {
    if (words_[1] == "CANFD" || words_[1] == "CANXL") {
      ++other_frames_;
      return false;
    }
    if (words_.size() < 3 || !is_number(words_[1]) || words_[2] == "Statistic:" || words_[2] == "OverloadFrame") {
      return false;
    }
    if (words_[2] == "ErrorFrame") {
      entry.frame.Identifier = CO_IF_FRM_ERROR | bus_error;
      entry.frame.DLC = 8;
    } else if (words_.size() > 3 && words_[3] == "TxRq") {
      return false;  // the request to send; the frame follows when it is on the bus
    } else if (!is_whole || !parse(entry)) {
      ++malformed_;
      return false;
    }
    entry.channel = channel_of(words_[1]);
    return true;
  }

  bool parse(Entry& entry) {
    if (words_.size() < 5 || (words_[3] != "Rx" && words_[3] != "Tx")) {
      return false;
    }
    entry.direction = words_[3] == "Rx" ? Direction::received : Direction::sent;
    std::string_view id = words_[2];
    const bool is_extended = id.back() == 'x' || id.back() == 'X';
    id.remove_suffix(is_extended ? 1 : 0);
    CO_IF_FRM& frame = entry.frame;
    if (!parse_number(id, frame.Identifier, base_) || frame.Identifier > (is_extended ? longest_id : longest_base_id)) {
      return false;
    }
    frame.Identifier |= is_extended ? CO_IF_FRM_EXT : 0;
    const bool has_length = words_.size() > 5 && parse_number(words_[5], frame.DLC, 16) && frame.DLC <= 15;
    frame.DLC = has_length ? std::min<std::uint8_t>(frame.DLC, 8) : 0;
    if (words_[4] == "r") {
      frame.Identifier |= CO_IF_FRM_RTR;
      return true;
    }
    return words_[4] == "d" && has_length && parse_data(frame);
  }

  bool parse_data(CO_IF_FRM& frame) {
    for (unsigned n = 0; n < frame.DLC; ++n) {
      if (words_.size() <= 6 + n || !parse_number(words_[6 + n], frame.Data[n], base_)) {
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
