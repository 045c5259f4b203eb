// SPDX-License-Identifier: Apache-2.0
#include "simulate/faults.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>

#include "simulate/arguments.hpp"

namespace lexican::simulate {
namespace {

constexpr std::uint8_t client_cob_id = 1;  // sub-indices of 1200h
constexpr std::uint8_t server_cob_id = 2;
constexpr std::uint8_t toggle_bit = 0x10;

std::optional<unsigned> decimal_in(const std::string& text, unsigned most) {
  unsigned number = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && next == end && number <= most ? std::optional(number) : std::nullopt;
}

bool is_off_word(const std::vector<std::string>& words) { return words.size() == 1 && words[0] == "off"; }

/// Parses nothing (for ever), off (0), or a time.
std::optional<Micros> duration_in(const std::vector<std::string>& words) {
  if (words.empty()) {
    return for_ever;
  }
  return is_off_word(words) ? std::optional(Micros{0}) : words.size() == 1 ? time_in(words[0]) : std::nullopt;
}

}  // namespace

struct Faults::Command {
  const char* verb;
  bool (Faults::*execute)(const Words& words);
  const char* usage;
};

const Faults::Command Faults::commands[] = {
    {"wrong-length", &Faults::wrong_length, "nothing, a number of bytes from 0 to 8, or off"},
    {"hang-sdo", &Faults::hang_sdo, "nothing, a time such as 3s, or off"},
    {"wrong-toggle", &Faults::wrong_toggle, "nothing, or off"},
    {"busoff", &Faults::bus_off, "nothing, a time such as 3s, or off"},
    {"flood", &Faults::flood, "a CAN-ID and frames per second up to 10000, such as flood 185 1000, or off"},
};

Faults::Faults(Ground& ground, DisturbedCan& can) : ground_(ground), can_(can) {
  can.on_frame([this](const CO_IF_FRM& frame) { return hears(frame); },
               [this](CO_IF_FRM& frame) { return change(frame); });
}

bool Faults::has(const std::string& verb) {
  return std::any_of(std::begin(commands), std::end(commands), [&](const Command& row) { return verb == row.verb; });
}

std::string Faults::execute(const std::vector<std::string>& words) {
  const Command& command =
      *std::find_if(std::begin(commands), std::end(commands), [&](const Command& row) { return words[0] == row.verb; });
  return (this->*command.execute)({words.begin() + 1, words.end()}) ? "" : words[0] + " needs: " + command.usage;
}

bool Faults::wrong_length(const Words& words) {
  const std::optional<unsigned> length = words.size() == 1 ? decimal_in(words[0], 8) : std::nullopt;
  if (!words.empty() && !is_off_word(words) && !length) {
    return false;
  }
  has_wrong_length_ = !is_off_word(words);
  length_ = length ? std::optional(static_cast<std::uint8_t>(*length)) : std::nullopt;
  return true;
}

bool Faults::hang_sdo(const Words& words) {
  const std::optional<Micros> time = duration_in(words);
  if (time) {
    hang_end_ = *time != for_ever ? ground_.now() + *time : for_ever;
  }
  return time.has_value();
}

bool Faults::wrong_toggle(const Words& words) {
  has_wrong_toggle_ = words.empty();
  return words.empty() || is_off_word(words);
}

bool Faults::bus_off(const Words& words) {
  const std::optional<Micros> time = duration_in(words);
  if (is_off_word(words)) {
    can_.recover();
  } else if (time) {
    constexpr unsigned until_bus_off = 32;  // each wrong frame adds 8 to the error counter, whose limit is 256
    can_.enter_bus_off(*time, ground_.carries_error_frames() ? until_bus_off : 0);
  }
  return time.has_value();
}

bool Faults::flood(const Words& words) {
  if (is_off_word(words)) {
    can_.flood(0, 0);
    return true;
  }
  const std::optional<std::uint32_t> identifier = !words.empty() ? hex_in(words[0]) : std::nullopt;
  const std::optional<unsigned> rate =
      words.size() == 2 ? decimal_in(words[1], DisturbedCan::most_flooding) : DisturbedCan::most_flooding;
  if (words.size() > 2 || !identifier || *identifier > CO_IF_FRM_ID || !rate || *rate == 0) {
    return false;
  }
  constexpr std::uint32_t longest_base = 0x7FF;
  can_.flood(*identifier | (*identifier > longest_base ? CO_IF_FRM_EXT : 0), *rate);
  return true;
}

/// \retval false  the device does not receive the frame
bool Faults::hears(const CO_IF_FRM& frame) {
  if (!device_->has_node() || (hang_end_ == 0 && !has_wrong_toggle_)) {
    return true;
  }
  const std::optional<std::size_t> server = server_of(frame.Identifier, client_cob_id);
  if (!server) {
    return true;
  }
  Requests& requests = requests_[*server];
  requests.last = frame.Data[0];
  const unsigned command = frame.Data[0] >> 5;
  requests.segments = command == 0 || command == 3 ? requests.segments + 1 : 0;
  return hang_end_ <= ground_.now();
}

/// \retval false  the frame is not sent
bool Faults::change(CO_IF_FRM& frame) {
  if (!device_->has_node()) {
    return true;
  }
  if (has_wrong_length_ && is_transmit_pdo(frame.Identifier)) {
    frame.DLC = length_.value_or(frame.DLC > 0 ? static_cast<std::uint8_t>(frame.DLC - 1) : std::uint8_t{1});
  }
  if (hang_end_ == 0 && !has_wrong_toggle_) {
    return true;
  }
  const std::optional<std::size_t> server = server_of(frame.Identifier, server_cob_id);
  if (!server) {
    return true;
  }
  // A segment of a block transfer looks like another response: the request decides.
  const Requests& requests = requests_[*server];
  const unsigned request = requests.last >> 5;
  const unsigned response = frame.Data[0] >> 5;
  const bool is_segment = (request == 3 && response == 0) || (request == 0 && response == 1);
  if (has_wrong_toggle_ && is_segment && requests.segments > 1) {
    frame.Data[0] ^= toggle_bit;
  }
  return hang_end_ <= ground_.now();
}

bool Faults::is_transmit_pdo(std::uint32_t identifier) {
  for (std::uint16_t n = 0; n < CO_TPDO_N; ++n) {
    if (has_identifier(static_cast<std::uint16_t>(0x1800 + n), 1, identifier)) {
      return true;
    }
  }
  return false;
}

/// Returns the number of the SDO server with an identifier. The first one may have no object.
std::optional<std::size_t> Faults::server_of(std::uint32_t identifier, std::uint8_t sub_index) {
  const std::uint32_t base = sub_index == client_cob_id ? 0x600 : 0x580;
  if (identifier == base + device_->node().stack().NodeId) {
    return 0;
  }
  for (std::uint16_t n = 0; n < CO_SSDO_N; ++n) {
    if (has_identifier(static_cast<std::uint16_t>(0x1200 + n), sub_index, identifier)) {
      return n;
    }
  }
  return std::nullopt;
}

bool Faults::has_identifier(std::uint16_t index, std::uint8_t sub_index, std::uint32_t identifier) {
  constexpr std::uint32_t is_disabled = 0x80000000;
  constexpr std::uint32_t is_extended = 0x20000000;
  const std::optional<Bytes> value = device_->get(index, sub_index);
  const std::uint32_t cob_id = value ? static_cast<std::uint32_t>(number_of(*value)) : is_disabled;
  const std::uint32_t flag = (cob_id & is_extended) != 0 ? CO_IF_FRM_EXT : 0;
  return (cob_id & is_disabled) == 0 && ((cob_id & CO_IF_FRM_ID) | flag) == identifier;
}

}  // namespace lexican::simulate
