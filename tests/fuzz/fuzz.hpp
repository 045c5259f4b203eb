// SPDX-License-Identifier: Apache-2.0
/// \file fuzz.hpp
/// Functions shared by the fuzz targets: reading the input as a stream, and ending the program when a property is
/// violated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "co_core.h"

namespace fuzz {

/// Stream of input bytes; after the end all bytes are 0, so that random decisions come to an end. While an Aside
/// exists, bytes are read from the end of the input instead: callbacks then do not change the meaning of the bytes that
/// follow, however often the stack calls them.
class Input {
 public:
  Input() = default;
  Input(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  bool is_empty() const { return next_ == end_; }
  std::uint8_t byte() {
    if (is_empty()) {
      return 0;
    }
    return asides_ == 0 ? *next_++ : *--end_;
  }
  std::uint32_t below(std::size_t limit) { return static_cast<std::uint32_t>(byte() % limit); }  ///< limit: 1…256
  bool flag() { return (byte() & 1U) != 0; }
  std::uint16_t word() {
    const std::uint32_t low = byte();
    return static_cast<std::uint16_t>(low | (std::uint32_t{byte()} << 8));
  }
  std::uint32_t number() {
    const std::uint32_t low = word();
    return low | (std::uint32_t{word()} << 16);
  }

 private:
  friend class Aside;
  const std::uint8_t* next_ = nullptr;
  const std::uint8_t* end_ = nullptr;
  unsigned asides_ = 0;
};

class Aside {
 public:
  explicit Aside(Input& input) : input_(input) { ++input_.asides_; }
  ~Aside() { --input_.asides_; }
  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;

 private:
  Input& input_;
};

/// The frame that the target gives to the node, for tests/numbers/frame_bound. alone: nothing else acts on the node
/// meanwhile.
struct Given {
  std::uint32_t identifier = 0;
  std::uint8_t length = 0;
  const std::uint8_t* data = nullptr;
  bool alone = false;
};
inline Given given;

/// Calls CONodeProcess() until a block transfer no longer has a segment due at once.
inline void process(CO_NODE& node) {
  unsigned calls = 127 * (CO_SSDO_N + CO_CSDO_N);
  do {
    CONodeProcess(&node);
  } while (node.Transmit.Paused != 0 && CONodeNextDeadline(&node) == 0 && --calls != 0);
}

/// Ends the program, which the fuzzer reports as a finding, unless \a holds.
inline void require(bool holds, const char* promise) {
  if (!holds) {
    std::fprintf(stderr, "BROKEN: %s\n", promise);
    std::abort();
  }
}
inline void require(bool holds, const std::string& promise) { require(holds, promise.c_str()); }

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
