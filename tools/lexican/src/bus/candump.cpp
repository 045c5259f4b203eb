// SPDX-License-Identifier: Apache-2.0
// The format of candump -l, of can-utils:
//   (1436509052.249713) vcan0 123#DEADBEEF
//   (1436509052.250000) vcan0 12345678#R4 T
//   DROPCOUNT: dropped 3 CAN frames on 'vcan0' socket (total drops 7)
#include <algorithm>

#include "bus/log_formats.hpp"

namespace lexican::host_bus {
namespace {

constexpr std::string_view drop_count = "DROPCOUNT:";

/// \retval false  \a text is not an identifier in 3 or 8 hex digits
bool parse_padded_identifier(std::string_view text, std::uint32_t& identifier) {
  if (!parse_number(text, identifier, 16)) {
    return false;
  }
  if (text.size() == 3) {
    return identifier <= max_base_id;
  }
  if ((identifier & ~max_extended_id) == CO_IF_FRM_ERROR) {
    return true;
  }
  const bool is_valid = text.size() == 8 && identifier <= max_extended_id;
  identifier |= CO_IF_FRM_EXT;
  return is_valid;
}

bool parse_remote(std::string_view text, CO_IF_FRM& frame) {
  frame.Identifier |= CO_IF_FRM_RTR;
  return text.size() <= 1 && (text.empty() || parse_number(text, frame.DLC)) && frame.DLC <= 8;
}

/// Parses pairs of hex digits, with or without points between them.
bool parse_data(std::string_view text, CO_IF_FRM& frame) {
  while (!text.empty()) {
    if (frame.DLC == 8 || text.size() < 2 || !parse_number(text.substr(0, 2), frame.Data[frame.DLC], 16)) {
      return false;
    }
    ++frame.DLC;
    text.remove_prefix(2);
    if (text.size() > 1 && text.front() == '.') {
      text.remove_prefix(1);
    }
  }
  return true;
}

class CandumpReader : public LogReader {
 public:
  explicit CandumpReader(LogInput input) : input_(std::move(input)) {}

  std::optional<Entry> next() override {
    bool is_whole = true;
    while (fault_.empty() && input_.read_line(line_, is_whole)) {
      split(line_, 5, words_);
      if (words_.empty()) {
        continue;
      }
      if (words_.size() > 3 && words_[3].front() == '[') {
        fault_ = "the output of candump for the screen; candump -l or -L writes a log";
        return std::nullopt;
      }
      Entry entry;
      const Parsed parsed = is_whole ? parse(entry) : Parsed::malformed;
      if (parsed == Parsed::frame) {
        return entry;
      }
      if (parsed == Parsed::other_frame) {
        ++other_frames_;
      } else if (words_.front() != drop_count || !note_lost()) {
        ++malformed_;
      }
    }
    if (input_.is_broken()) {
      fault_ = "the file cannot be read to its end";
    }
    return std::nullopt;
  }

 private:
  Parsed parse(Entry& entry) {
    const std::string_view time = words_.front();
    if (words_.size() < 3 || words_.size() > 4 || time.size() < 3 || time.front() != '(' || time.back() != ')' ||
        !parse_seconds(time.substr(1, time.size() - 2), entry.time)) {
      return Parsed::malformed;
    }
    if (words_.size() == 4) {
      if (words_[3] != "R" && words_[3] != "T") {
        return Parsed::malformed;
      }
      entry.direction = words_[3] == "R" ? Direction::received : Direction::sent;
    }
    const Parsed parsed = parse_frame(words_[2], entry.frame);
    if (parsed == Parsed::frame) {
      entry.channel = channel_of(words_[1]);
    }
    return parsed;
  }

  bool note_lost() {
    std::uint32_t number = 0;
    if (words_.size() < 3 || words_[1] != "dropped" || !parse_number(words_[2], number)) {
      return false;
    }
    lost_ += number;
    return true;
  }

  LogInput input_;
  std::string line_;
  std::vector<std::string_view> words_;
};

class CandumpWriter : public LogWriter {
 public:
  CandumpWriter(std::ostream& stream, std::string_view channel) : stream_(stream), channel_(channel_name(channel)) {}

  void write(const Entry& entry) override {
    const char* const direction = entry.direction == Direction::unknown ? ""
                                  : entry.direction == Direction::sent  ? " T"
                                                                        : " R";
    stream_ << '(' << number_text(entry.time / 1'000'000, 10, 10) << '.' << number_text(entry.time % 1'000'000, 6, 10)
            << ") " << channel_ << ' ' << to_text(entry.frame) << direction << '\n';
  }

  void write_lost(Micros /*time*/, std::uint32_t number) override {
    total_ += number;
    stream_ << drop_count << " dropped " << number << " CAN frame" << (number == 1 ? "" : "s") << " on '" << channel_
            << "' socket (total drops " << total_ << ")\n";
  }

 private:
  std::ostream& stream_;
  std::string channel_;
  std::uint64_t total_ = 0;
};

}  // namespace

std::string to_text(const CO_IF_FRM& frame) {
  const bool is_wide = (frame.Identifier & (CO_IF_FRM_EXT | CO_IF_FRM_ERROR)) != 0;
  const std::uint32_t id = frame.Identifier & (CO_IF_FRM_ID | CO_IF_FRM_ERROR);
  std::string text = number_text(id, is_wide ? 8 : 3) + '#';
  if ((frame.Identifier & CO_IF_FRM_RTR) != 0) {
    return text + 'R' + (frame.DLC == 0 ? "" : std::to_string(std::min<unsigned>(frame.DLC, 8)));
  }
  for (unsigned n = 0; n < std::min<unsigned>(frame.DLC, 8); ++n) {
    text += number_text(frame.Data[n], 2);
  }
  return text;
}

Parsed parse_frame(std::string_view text, CO_IF_FRM& frame) {
  frame = {};
  const std::size_t mark = text.find('#');
  if (mark == 5 && text.find(':') != std::string_view::npos) {
    return Parsed::other_frame;  // CAN XL
  }
  if ((mark != 3 && mark != 8) || !parse_padded_identifier(text.substr(0, mark), frame.Identifier)) {
    return Parsed::malformed;
  }
  text.remove_prefix(mark + 1);
  if (!text.empty() && text.front() == '#') {
    return Parsed::other_frame;
  }
  // A code of 9 to F in place of the length 8 has no meaning in CANopen.
  unsigned code = 0;
  const bool has_code = text.size() >= 2 && text[text.size() - 2] == '_';
  if (has_code && (!parse_number(text.substr(text.size() - 1), code, 16) || code < 9)) {
    return Parsed::malformed;
  }
  text.remove_suffix(has_code ? 2 : 0);
  const bool is_remote = !text.empty() && (text.front() == 'R' || text.front() == 'r');
  const bool is_valid = is_remote ? parse_remote(text.substr(1), frame) : parse_data(text, frame);
  return is_valid && (!has_code || frame.DLC == 8) ? Parsed::frame : Parsed::malformed;
}

std::unique_ptr<LogReader> read_candump(LogInput input) { return std::make_unique<CandumpReader>(std::move(input)); }

std::unique_ptr<LogWriter> write_candump(std::ostream& stream, std::string_view channel) {
  return std::make_unique<CandumpWriter>(stream, channel);
}

}  // namespace lexican::host_bus
