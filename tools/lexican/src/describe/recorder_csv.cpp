// SPDX-License-Identifier: Apache-2.0
#include "describe/recorder_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <istream>
#include <string_view>

namespace lexican::describe {
namespace {

/// Converts a complete text to a number.
/// \retval false  it is none, or not from low to high
bool to_number(std::string_view text, int base, std::int64_t low, std::int64_t high, std::int64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc{} && end == text.data() + text.size() && number >= low && number <= high;
}

/// Returns a text of the input for a message: shortened, without characters that a terminal does not show.
std::string quoted_input(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + shown + (text.size() > longest ? "...'" : "'");
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Reads a comment; "# key: value" describes the curve. Returns what is wrong; empty: nothing.
std::string read_comment(std::string_view line, RecorderCurve& curve) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) {
    return {};
  }
  const std::string_view key = trimmed(line.substr(1, colon - 1));
  const std::string_view value = trimmed(line.substr(colon + 1));
  std::int64_t number = 0;
  if (key == "name") {
    curve.name = value;
  } else if (key == "object") {
    curve.object = value;
  } else if (key == "colour") {
    if (value.size() != 6 || !to_number(value, 16, 0, 0xFFFFFF, number)) {
      return "wrong colour " + quoted_input(value) + "; write six hexadecimal digits, RRGGBB";
    }
    curve.colour = value;
  } else if (key == "trigger") {
    if (!to_number(value, 10, 0, UINT32_MAX, number)) {
      return "wrong time of the trigger " + quoted_input(value) + "; write milliseconds, 0 to 4294967295";
    }
    curve.has_trigger = true;
    curve.trigger = static_cast<std::uint64_t>(number);
  }
  return {};
}

/// Reads a point. Returns what is wrong; empty: nothing.
std::string read_point(std::string_view line, RecorderCurve& curve) {
  const std::size_t separator = line.find(';');
  if (separator == std::string_view::npos) {
    return "no ';' in " + quoted_input(line) +
           "; a line is 'time;value': read the plot in format 0 (CSV), not 1 (binary)";
  }
  std::int64_t time = 0;
  std::int64_t value = 0;
  if (!to_number(line.substr(0, separator), 10, 0, UINT32_MAX, time)) {
    return "wrong time " + quoted_input(line.substr(0, separator)) +
           "; write milliseconds, 0 to 4294967295, before the ';'";
  }
  if (!to_number(line.substr(separator + 1), 10, INT32_MIN, UINT32_MAX, value)) {
    return "wrong value " + quoted_input(line.substr(separator + 1)) +
           "; write a number, -2147483648 to 4294967295, behind the ';'";
  }
  auto since_before = static_cast<std::uint32_t>(time);
  std::uint64_t before = 0;
  if (!curve.points.empty()) {
    before = curve.points.back().time;
    since_before -= static_cast<std::uint32_t>(before);  // the time of the recorder wraps
  }
  if (!curve.points.empty() && since_before > INT32_MAX) {
    return fmt::format(
        "time {} is before that of the previous point, {}; sort the lines, and draw each upload separately", time,
        static_cast<std::uint32_t>(before));
  }
  curve.points.push_back({before + since_before, value});
  return {};
}

}  // namespace

bool begins_recorder_csv(char first) { return first == '#' || first == '-' || (first >= '0' && first <= '9'); }

bool read_recorder_csv(std::istream& input, RecorderCurve& curve, std::string& why) {
  std::string text;
  for (unsigned line = 1; std::getline(input, text); ++line) {
    if (!text.empty() && text.back() == '\r') {
      text.pop_back();
    }
    const std::string fault = !text.empty() && text[0] == '#' ? read_comment(text, curve) : read_point(text, curve);
    if (!fault.empty()) {
      why = fmt::format("{}: {}", line, fault);
      return false;
    }
  }
  if (input.bad()) {
    why = " cannot be read";
    return false;
  }
  if (curve.points.empty()) {
    why = " no points; read the plot while the recorder holds points (2401h:1)";
    return false;
  }
  const std::uint64_t first = curve.points.front().time;
  const std::uint32_t since_first = static_cast<std::uint32_t>(curve.trigger) - static_cast<std::uint32_t>(first);
  curve.trigger = first + since_first;
  curve.has_trigger = curve.has_trigger && curve.trigger <= curve.points.back().time;
  return true;
}

}  // namespace lexican::describe
