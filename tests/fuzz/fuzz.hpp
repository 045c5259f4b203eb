// SPDX-License-Identifier: Apache-2.0
/// \file fuzz.hpp
/// What the fuzz targets share: an input that is read like a stream, and the end of the program for a broken promise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "co_core.h"

namespace fuzz {

/// Bytes of chance. Behind the end all are 0, so that everything that depends on them comes to rest.
/// What is asked for beside the course of things, while an Aside lives, comes from the end: the rest means the same,
/// however often that happens.
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

/// For who watches a target: the frame that the node is given, and whether nothing else acts on the node meanwhile.
struct Given {
  std::uint32_t identifier = 0;
  std::uint8_t length = 0;
  const std::uint8_t* data = nullptr;
  bool alone = false;
};
inline Given given;

/// CONodeProcess(), as often as a block transfer wants it at once.
inline void process(CO_NODE& node) {
  unsigned calls = 127 * (CO_SSDO_N + CO_CSDO_N);
  do {
    CONodeProcess(&node);
  } while (node.Paused != 0 && CONodeNextDeadline(&node) == 0 && --calls != 0);
}

/// Ends the program, which is a finding.
inline void require(bool holds, const char* promise) {
  if (!holds) {
    std::fprintf(stderr, "BROKEN: %s\n", promise);
    std::abort();
  }
}
inline void require(bool holds, const std::string& promise) { require(holds, promise.c_str()); }

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
