// SPDX-License-Identifier: Apache-2.0
#include "client/values.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <iterator>
#include <limits>
#include <system_error>

#include "trace/text.hpp"

namespace lexican {
namespace {

using Kind = ValueType::Kind;

constexpr unsigned byte_bits = 8;
constexpr std::size_t bytes_per_line = 16;  // of a hex dump

const char* begin_of(std::string_view text) { return text.data(); }
const char* end_of(std::string_view text) { return text.data() + text.size(); }

Encoded fault(const std::string& text) { return {{}, text}; }

Bytes little_endian(std::uint64_t number, unsigned size) {
  Bytes bytes(size);
  for (unsigned i = 0; i < size; ++i) {
    bytes[i] = static_cast<std::uint8_t>(number >> (byte_bits * i));
  }
  return bytes;
}

// --- Integers. They are converted as magnitude and sign, because no integer type has the range of both i64 and u64.

/// Returns the highest number of an integer type.
std::uint64_t largest(ValueType type) {
  const std::uint64_t ones = std::numeric_limits<std::uint64_t>::max() >> (64 - byte_bits * type.size);
  return type.kind == Kind::integer ? ones >> 1 : ones;
}

std::string range(ValueType type) {
  const std::string highest = std::to_string(largest(type));
  return (type.kind == Kind::integer ? '-' + std::to_string(largest(type) + 1) : "0") + "..." + highest;
}

/// Converts digits: decimal, or hexadecimal after 0x. Returns invalid_argument if one is invalid, result_out_of_range
/// for more than 64 bits.
std::errc magnitude(std::string_view digits, std::uint64_t& number) {
  const bool hex = digits.size() > 2 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X');
  digits.remove_prefix(hex ? 2 : 0);
  const auto [end, error] = std::from_chars(begin_of(digits), end_of(digits), number, hex ? 16 : 10);
  return end == end_of(digits) ? error : std::errc::invalid_argument;
}

Encoded encode_integer(ValueType type, std::string_view text) {
  const bool negative = !text.empty() && text[0] == '-';
  std::uint64_t number = 0;
  const std::errc error = magnitude(text.substr(negative ? 1 : 0), number);
  if (error == std::errc::invalid_argument) {
    return fault('\'' + std::string(text) + "' is no integer");
  }
  const std::uint64_t lowest = type.kind == Kind::integer ? largest(type) + 1 : 0;  // absolute value
  if (error != std::errc() || number > (negative ? lowest : largest(type))) {
    return fault(std::string(text) + " is out of range, " + range(type));
  }
  return {little_endian(negative ? 0 - number : number, type.size), {}};
}

std::string show_integer(ValueType type, const Bytes& bytes) {
  const std::uint64_t number = number_of(bytes);
  if (type.kind == Kind::unsigned_integer || number <= largest(type)) {
    return std::to_string(number);
  }
  // Two's complement: the magnitude is 2^bits - number. 2^64 itself does not fit into 64 bits.
  const std::uint64_t modulus_less_one = largest({Kind::unsigned_integer, type.size});
  return '-' + std::to_string(modulus_less_one - number + 1);
}

// --- Reals

template <class Real, class Bits>
Encoded encode_real(std::string_view text) {
  static_assert(sizeof(Real) == sizeof(Bits) && std::numeric_limits<Real>::is_iec559);
  Real real = 0;
  const auto [end, error] = std::from_chars(begin_of(text), end_of(text), real);
  if (error == std::errc::result_out_of_range) {
    return fault(std::string(text) + " is out of range of this type");
  }
  if (error != std::errc() || end != end_of(text)) {
    return fault('\'' + std::string(text) + "' is no number");
  }
  Bits bits = 0;
  std::memcpy(&bits, &real, sizeof bits);
  return {little_endian(bits, sizeof bits), {}};
}

/// Returns the shortest text that converts to the same number.
template <class Real, class Bits>
std::string show_real(const Bytes& bytes) {
  const auto bits = static_cast<Bits>(number_of(bytes));
  Real real = 0;
  std::memcpy(&real, &bits, sizeof real);
  char buffer[64];
  const auto [end, error] = std::to_chars(std::begin(buffer), std::end(buffer), real);
  return error == std::errc() ? std::string(buffer, end) : std::string();
}

// --- Others

Encoded encode_boolean(const std::string& text) {
  if (text == "1" || text == "true") {
    return {{1}, {}};
  }
  return text == "0" || text == "false" ? Encoded{{0}, {}} : fault('\'' + text + "' is none of 0, 1, false and true");
}

Encoded encode_bytes(const std::string& text) {
  std::string digits;
  std::remove_copy(text.begin(), text.end(), std::back_inserter(digits), ' ');
  Bytes bytes(digits.size() / 2);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char* const pair = digits.data() + 2 * i;
    if (std::from_chars(pair, pair + 2, bytes[i], 16).ptr != pair + 2) {
      return fault('\'' + std::string(pair, 2) + "' is no byte, which has two hex digits");
    }
  }
  if (digits.size() % 2 != 0) {
    return fault("the number of hex digits is odd, a byte has two");
  }
  return {bytes, {}};
}

std::string dump_line(const Bytes& bytes, std::size_t first) {
  const std::size_t size = std::min(bytes_per_line, bytes.size() - first);
  const std::uint8_t* const data = bytes.data() + first;
  std::string readable(data, data + size);
  std::replace_if(
      readable.begin(), readable.end(), [](char c) { return c < 0x20 || c >= 0x7F; }, '.');
  constexpr int width = 3 * bytes_per_line - 1;
  return text("%08zX  %-*s  |", first, width, hex_bytes(data, size).c_str()) + readable + '|';
}

}  // namespace

std::optional<ValueType> value_type(std::string_view name) {
  if (name == "bool") {
    return ValueType{Kind::boolean, 1};
  }
  if (name == "string") {
    return ValueType{Kind::text, 0};
  }
  if (name == "bytes" || name == "domain") {
    return ValueType{Kind::bytes, 0};
  }
  if (name == "r32" || name == "r64") {
    return ValueType{Kind::real, name == "r32" ? 4U : 8U};
  }
  for (unsigned size = 1; size <= 8; ++size) {
    const std::string bits = std::to_string(byte_bits * size);
    if (name == 'u' + bits || name == 'i' + bits) {
      return ValueType{name[0] == 'u' ? Kind::unsigned_integer : Kind::integer, size};
    }
  }
  return std::nullopt;
}

Encoded encode(ValueType type, const std::string& text) {
  switch (type.kind) {
    case Kind::unsigned_integer:
    case Kind::integer: return encode_integer(type, text);
    case Kind::real:
      return type.size == 4 ? encode_real<float, std::uint32_t>(text) : encode_real<double, std::uint64_t>(text);
    case Kind::boolean: return encode_boolean(text);
    case Kind::text: return {Bytes(text.begin(), text.end()), {}};
    case Kind::bytes: break;
  }
  return encode_bytes(text);
}

Shown show(ValueType type, const Bytes& bytes) {
  if (type.size != 0 && bytes.size() != type.size) {
    return {{},
            text("the object has %zu byte%s, a value of this type has %u", bytes.size(), bytes.size() == 1 ? "" : "s",
                 type.size)};
  }
  switch (type.kind) {
    case Kind::unsigned_integer:
    case Kind::integer: return {show_integer(type, bytes), {}};
    case Kind::real:
      return {type.size == 4 ? show_real<float, std::uint32_t>(bytes) : show_real<double, std::uint64_t>(bytes), {}};
    case Kind::boolean: return {bytes[0] == 0 ? "0" : "1", {}};
    case Kind::text: return {std::string(bytes.begin(), bytes.end()), {}};
    case Kind::bytes: break;
  }
  return {hex_bytes(bytes.data(), bytes.size()), {}};
}

std::string visible_text(const Bytes& bytes) {
  const auto last = std::find_if(bytes.rbegin(), bytes.rend(), [](std::uint8_t byte) { return byte != 0; });
  const std::string characters(bytes.begin(), last.base());
  return is_readable(bytes.data(), characters.size()) ? characters : std::string();
}

std::string guess(const Bytes& bytes) {
  const std::size_t size = bytes.size();
  if (size == 1 || size == 2 || size == 4 || size == 8) {
    return text("0x%0*llX", static_cast<int>(2 * size), static_cast<unsigned long long>(number_of(bytes)));
  }
  std::string lines;
  for (std::size_t first = 0; first < size; first += bytes_per_line) {
    lines += (first == 0 ? "" : "\n") + dump_line(bytes, first);
  }
  return lines;
}

std::uint64_t number_of(const Bytes& bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    number |= static_cast<std::uint64_t>(bytes[i]) << (byte_bits * i);
  }
  return number;
}

}  // namespace lexican
