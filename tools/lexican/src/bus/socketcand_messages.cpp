// SPDX-License-Identifier: Apache-2.0
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>

#include "bus/log_formats.hpp"
#include "bus/socketcand.hpp"

namespace lexican::host_bus {
namespace {

using Kind = SocketcandMessage::Kind;
using Words = std::vector<std::string_view>;

constexpr std::size_t most_words = 12;  // one more than those of a frame with 8 bytes

bool parse_identifier(std::string_view text, std::uint32_t& identifier) {
  if (text.size() > 8 || !parse_number(text, identifier, 16) || identifier > max_extended_id) {
    return false;
  }
  identifier |= text.size() == 8 || identifier > max_base_id ? CO_IF_FRM_EXT : 0;
  return true;
}

bool parse_byte(std::string_view text, CO_IF_FRM& frame) {
  return frame.DLC < sizeof frame.Data && parse_number(text, frame.Data[frame.DLC++], 16);
}

/// Parses words of one or two digits, or of pairs of digits.
bool parse_data(const Words& words, CO_IF_FRM& frame) {
  bool is_valid = true;
  for (std::size_t n = 3; n < words.size(); ++n) {
    const std::string_view word = words[n];
    is_valid = is_valid && (word.size() <= 2 || word.size() % 2 == 0);
    for (std::size_t at = 0; at < word.size() && is_valid; at += 2) {
      is_valid = parse_byte(word.substr(at, 2), frame);
    }
  }
  return is_valid;
}

/// frame ID TIME DATA...
bool parse_frame(const Words& words, Entry& entry) {
  return words.size() >= 3 && parse_identifier(words[1], entry.frame.Identifier) &&
         parse_seconds(words[2], entry.time) && parse_data(words, entry.frame);
}

/// send ID LENGTH DATA...
bool parse_send(const Words& words, Entry& entry) {
  unsigned length = 0;
  return words.size() >= 3 && parse_identifier(words[1], entry.frame.Identifier) && parse_number(words[2], length) &&
         parse_data(words, entry.frame) && entry.frame.DLC == length;
}

/// rtr ID TIME LENGTH, and sendrtr ID LENGTH
bool parse_remote(const Words& words, Entry& entry) {
  const bool has_time = words.front() == "rtr";
  const bool is_valid = words.size() == (has_time ? 4 : 3) && parse_identifier(words[1], entry.frame.Identifier) &&
                        (!has_time || parse_seconds(words[2], entry.time)) &&
                        parse_number(words.back(), entry.frame.DLC) && entry.frame.DLC <= 8;
  entry.frame.Identifier |= CO_IF_FRM_RTR;
  return is_valid;
}

/// error CLASS [TIME]
bool parse_error_frame(const Words& words, Entry& entry) {
  const bool has_time = words.size() == 3;
  const bool is_valid = (words.size() == 2 || has_time) && parse_number(words[1], entry.frame.Identifier, 16) &&
                        entry.frame.Identifier <= max_extended_id && (!has_time || parse_seconds(words[2], entry.time));
  entry.frame.Identifier |= CO_IF_FRM_ERROR;
  entry.frame.DLC = 8;
  return is_valid;
}

struct FrameForm {
  std::string_view word;
  Kind kind;
  bool (*parse)(const Words& words, Entry& entry);
  Kind otherwise;
};

constexpr std::array<FrameForm, 5> frame_forms = {{
    {"frame", Kind::frame, parse_frame, Kind::malformed},
    {"send", Kind::send, parse_send, Kind::malformed},
    {"rtr", Kind::frame, parse_remote, Kind::malformed},
    {"sendrtr", Kind::send, parse_remote, Kind::malformed},
    {"error", Kind::frame, parse_error_frame, Kind::error},
}};

constexpr std::array<std::pair<std::string_view, Kind>, 5> plain_words = {{
    {"hi", Kind::hi},
    {"ok", Kind::ok},
    {"rawmode", Kind::rawmode},
    {"bcmmode", Kind::bcmmode},
    {"echo", Kind::echo},
}};

std::string identifier_text(std::uint32_t identifier) {
  return (identifier & CO_IF_FRM_EXT) != 0 ? number_text(identifier & CO_IF_FRM_ID, 8)
                                           : number_text(identifier & max_base_id, 3);
}

/// Returns the data bytes in hex, each with \a before in front of it.
std::string data_text(const CO_IF_FRM& frame, const char* before) {
  std::string text;
  for (unsigned n = 0; n < std::min<unsigned>(frame.DLC, 8); ++n) {
    text += before + number_text(frame.Data[n], 2);
  }
  return text;
}

}  // namespace

SocketcandMessage parse_socketcand(std::string_view text) {
  SocketcandMessage message;
  Words words;
  split(text, most_words, words);
  if (words.empty()) {
    return message;
  }
  const std::string_view first = words.front();
  if (first == "open" && words.size() == 2) {
    message.kind = Kind::open;
    message.text = words[1];
  }
  if (first == "error" && words.size() > 1) {
    message.text = text.substr(static_cast<std::size_t>(words[1].data() - text.data()));
  }
  for (const auto& [word, kind] : plain_words) {
    if (first == word && words.size() == 1) {
      message.kind = kind;
    }
  }
  for (const FrameForm& form : frame_forms) {
    if (first == form.word) {
      message.kind = form.parse(words, message.entry) ? form.kind : form.otherwise;
    }
  }
  return message;
}

std::string to_socketcand_frame(const Entry& entry) {
  return " < frame " + identifier_text(entry.frame.Identifier) + ' ' + std::to_string(entry.time / 1'000'000) + '.' +
         number_text(entry.time % 1'000'000, 6, 10) + ' ' + data_text(entry.frame, "") + " >";
}

std::string to_socketcand_send(const CO_IF_FRM& frame) {
  return "< send " + identifier_text(frame.Identifier) + ' ' + std::to_string(std::min<unsigned>(frame.DLC, 8)) +
         data_text(frame, " ") + " >";
}

std::size_t SocketcandInput::append(std::string_view bytes) {
  bytes_.erase(0, used_);
  used_ = 0;
  const std::size_t number = std::min(bytes.size(), max_size - bytes_.size());
  bytes_.append(bytes.substr(0, number));
  return number;
}

ssize_t SocketcandInput::read(int fd) {
  std::array<char, max_size> bytes{};
  const ssize_t size = recv(fd, bytes.data(), max_size - (bytes_.size() - used_), 0);
  append({bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))});
  return size;
}

std::optional<std::string_view> SocketcandInput::next() {
  const std::string_view bytes = bytes_;
  for (std::size_t end = bytes.find('>', used_); end != std::string_view::npos; end = bytes.find('>', used_)) {
    const std::string_view text = bytes.substr(used_, end - used_);
    used_ = end + 1;
    const std::size_t begin = text.rfind('<');
    if (begin != std::string_view::npos) {
      return text.substr(begin + 1);
    }
  }
  return std::nullopt;
}

}  // namespace lexican::host_bus
