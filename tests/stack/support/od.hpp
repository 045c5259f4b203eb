// SPDX-License-Identifier: Apache-2.0
/// \file od.hpp
/// Helpers for tests of the OD access interface (co_od.h).
#pragma once

#include <cstddef>
#include <string>

#include "co_od.h"
#include "fixture.hpp"

#if USE_OD

namespace test {

/// Returns the access to a variable of the fixture's dictionary. \a original: without an extension.
inline OD_IO_t variable(Fixture& node, std::uint16_t index, std::uint8_t sub = 0, bool original = false) {
  OD_IO_t io{};
  REQUIRE(OD_getSub(OD_find(&node.od, index), sub, &io, original) == ODR_OK);
  return io;
}

/// Returns the access to a variable in \a memory.
inline OD_IO_t variable(Bytes& memory) {
  OD_IO_t io{};
  io.stream.dataOrig = memory.data();
  io.stream.dataLength = static_cast<OD_size_t>(memory.size());
  io.read = OD_readOriginal;
  io.write = OD_writeOriginal;
  return io;
}

/// Result of a read, and the bytes that were read.
struct ReadResult {
  ODR_t result;
  Bytes data;

  friend bool operator==(const ReadResult& a, const ReadResult& b) { return a.result == b.result && a.data == b.data; }
};

/// Reads at most \a count bytes. Checks that the buffer behind them does not change.
inline ReadResult read(OD_IO_t& io, OD_size_t count) {
  Bytes buffer(count + 4U, 0xEE);
  OD_size_t given = 0xEEEEEEEE;
  const ODR_t result = io.read(&io.stream, buffer.data(), count, &given);
  if (result != ODR_OK && result != ODR_PARTIAL) {
    given = 0;
  }
  REQUIRE(given <= count);
  CHECK(Bytes(buffer.begin() + static_cast<std::ptrdiff_t>(count), buffer.end()) == Bytes(4, 0xEE));
  buffer.resize(given);
  return {result, buffer};
}

/// Writes \a data. Checks that all bytes are accepted or none, and that the caller's buffer does not change.
inline ODR_t write(OD_IO_t& io, const Bytes& data) {
  Bytes buffer = data;
  buffer.push_back(0xEE);  // The pointer must be valid even if there are no data.
  const Bytes before = buffer;
  OD_size_t taken = 0xEEEEEEEE;
  const ODR_t result = io.write(&io.stream, buffer.data(), static_cast<OD_size_t>(data.size()), &taken);
  CHECK(buffer == before);
  CHECK(taken == (result == ODR_OK || result == ODR_PARTIAL ? data.size() : 0xEEEEEEEE));
  return result;
}

}  // namespace test

template <>
struct doctest::StringMaker<test::ReadResult> {
  static String convert(const test::ReadResult& given) {
    std::string text = "result " + std::to_string(given.result) + ":";
    for (const std::uint8_t byte : given.data) {
      text += " " + std::to_string(byte);
    }
    return text.c_str();
  }
};

#endif
