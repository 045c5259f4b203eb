// SPDX-License-Identifier: Apache-2.0
#include "sja1000_filters.hpp"

#include "../transmit.hpp"

namespace co::sja1000 {
namespace {

constexpr unsigned bits = 11;
constexpr std::uint32_t all_bits = 0x7FF;

std::uint32_t word_of(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  return transmit::is_extended(identifier) ? id >> 18 : id;
}

// The identifiers of a filter.
struct Part {
  std::uint32_t always_set = all_bits;
  std::uint32_t ever_set = 0;
  bool is_empty = true;

  void add(std::uint32_t word) {
    always_set &= word;
    ever_set |= word;
    is_empty = false;
  }
  std::uint32_t open() const { return is_empty ? 0 : always_set ^ ever_set; }
  Filter filter() const {
    return {static_cast<std::uint16_t>(always_set), static_cast<std::uint16_t>(all_bits & ~open())};
  }
  unsigned width() const {
    unsigned words = is_empty ? 0 : 1;
    for (std::uint32_t rest = open(); rest != 0; rest &= rest - 1) {
      words *= 2;
    }
    return words;
  }
};

struct Parts {
  Part zero;  // the bit is 0
  Part one;
};

Parts split(const std::uint32_t* ids, unsigned num, unsigned bit) {
  Parts parts;
  for (unsigned n = 0; n < num; ++n) {
    const std::uint32_t word = word_of(ids[n]);
    (((word >> bit) & 1) != 0 ? parts.one : parts.zero).add(word);
  }
  return parts;
}

}  // namespace

Filters filters_of(const std::uint32_t* ids, unsigned num) {
  Parts best = split(ids, num, 0);
  for (unsigned bit = 1; bit < bits; ++bit) {
    const Parts parts = split(ids, num, bit);
    best = parts.zero.width() + parts.one.width() < best.zero.width() + best.one.width() ? parts : best;
  }
  return {{(best.zero.is_empty ? best.one : best.zero).filter(), (best.one.is_empty ? best.zero : best.one).filter()}};
}

bool all_pass(const Filters& filters, const std::uint32_t* ids, unsigned num) {
  for (unsigned n = 0; n < num; ++n) {
    const std::uint32_t word = word_of(ids[n]);
    const auto rejects = [word](const Filter& filter) { return ((word ^ filter.word) & filter.mask) != 0; };
    if (rejects(filters.filter[0]) && rejects(filters.filter[1])) {
      return false;
    }
  }
  return true;
}

}  // namespace co::sja1000
