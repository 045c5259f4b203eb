// SPDX-License-Identifier: Apache-2.0
// Class MCan: acceptance filtering and storage of received frames.
#include <algorithm>

#include "m_can.hpp"

namespace test {
namespace {

using Register = MCanRegister;
using Flag = MCanFlag;

// Types of filter elements: SFT, EFT.
constexpr std::uint32_t range = 0;
constexpr std::uint32_t dual = 1;
constexpr std::uint32_t classic = 2;
constexpr std::uint32_t range_without_mask = 3;  // of extended filters; a standard filter is disabled

// Configurations of filter elements: SFEC, EFEC.
constexpr std::uint32_t is_disabled = 0;
constexpr std::uint32_t to_buffer = 7;

// Elements of Rx FIFOs and Rx buffers
constexpr std::uint32_t esi = 1U << 31;
constexpr std::uint32_t xtd = 1U << 30;
constexpr std::uint32_t rtr = 1U << 29;
constexpr std::uint32_t anmf = 1U << 31;
constexpr std::uint32_t fdf = 1U << 21;
constexpr std::uint32_t brs = 1U << 20;

constexpr std::uint32_t is_full = 1U << 24;
constexpr std::uint32_t is_lost = 1U << 25;

bool in_range(std::uint32_t id, std::uint32_t first, std::uint32_t last) { return id >= first && id <= last; }

Flag flag_of(unsigned fifo, Flag of_fifo_0) { return static_cast<Flag>(static_cast<unsigned>(of_fifo_0) + 4 * fifo); }

}  // namespace

// ---- Acceptance filtering

MCan::Decision MCan::filter(const CanFrame& frame) const {
  const bool rejects_remote = field(Register::gfc, frame.is_extended ? 0 : 1, 1) != 0;
  if (frame.is_remote && rejects_remote) {
    return {};
  }
  const Section elements = frame.is_extended ? extended_filters() : standard_filters();
  for (unsigned i = 0; i < elements.elements; ++i) {
    const unsigned word = elements.start + i * elements.words;
    const std::uint32_t first = ram_word(word);
    const std::uint32_t second = frame.is_extended ? ram_word(word + 1) : first;
    const std::uint32_t configuration = frame.is_extended ? first >> 29 : first >> 27 & 7;
    const bool matches =
        frame.is_extended ? extended_matches(first, second, frame.id) : standard_matches(first, frame.id);
    Decision decision;
    if (matches && decide(decision, configuration, i, second)) {
      return decision;
    }
  }
  return without_match(frame);
}

bool MCan::standard_matches(std::uint32_t element, std::uint32_t id) const {
  const std::uint32_t one = element >> 16 & 0x7FF;
  const std::uint32_t two = element & 0x7FF;
  if ((element >> 27 & 7) == to_buffer) {
    return id == one;
  }
  switch (element >> 30) {
    case range: return in_range(id, one, two);
    case dual: return id == one || id == two;
    case classic: return ((id ^ one) & two) == 0;
    default: return false;
  }
}

bool MCan::extended_matches(std::uint32_t first, std::uint32_t second, std::uint32_t id) const {
  const std::uint32_t one = first & 0x1FFFFFFF;
  const std::uint32_t two = second & 0x1FFFFFFF;
  const std::uint32_t masked = id & value(Register::xidam);
  if (first >> 29 == to_buffer) {
    return masked == one;
  }
  switch (second >> 30) {
    case range: return in_range(masked, one, two);
    case dual: return masked == one || masked == two;
    case classic: return ((masked ^ one) & two) == 0;
    case range_without_mask: return in_range(id, one, two);
    default: return false;
  }
}

// Returns false if the search goes on: the element is disabled, or its Rx buffer holds a new message.
bool MCan::decide(Decision& decision, unsigned configuration, unsigned index, std::uint32_t buffer) const {
  if (configuration == is_disabled) {
    return false;
  }
  decision.is_matched = true;
  decision.filter = index;
  if (configuration == to_buffer) {
    const bool is_buffer = !is_fixed() && (buffer >> 9 & 3) == 0;  // no debug message
    decision.buffer = buffer & 63;
    const std::uint32_t new_data = value(decision.buffer < 32 ? Register::ndat1 : Register::ndat2);
    decision.storage = Storage::buffer;
    return is_buffer && (new_data >> decision.buffer % 32 & 1) == 0;
  }
  decision.is_priority = configuration >= 4;
  const unsigned fifo = configuration & 3;
  decision.storage = fifo == 1 ? Storage::fifo0 : fifo == 2 ? Storage::fifo1 : Storage::none;
  return true;
}

MCan::Decision MCan::without_match(const CanFrame& frame) const {
  Decision decision;
  const std::uint32_t action = field(Register::gfc, frame.is_extended ? 2 : 4, 3);
  decision.storage = action == 0 ? Storage::fifo0 : action == 1 ? Storage::fifo1 : Storage::none;
  return decision;
}

// ---- Storage

void MCan::store(const CanFrame& frame, const Decision& decision) {
  const unsigned fifo = decision.storage == Storage::fifo1 ? 1 : 0;
  const unsigned index = fifos_[fifo].put;
  bool is_stored = false;
  switch (decision.storage) {
    case Storage::none: break;
    case Storage::fifo0:
    case Storage::fifo1: is_stored = store_in_fifo(frame, decision, fifo); break;
    case Storage::buffer: store_in_buffer(frame, decision); break;
  }
  if (decision.is_priority) {
    set_high_priority(decision, frame, is_stored, index);
  }
}

bool MCan::overwrites(unsigned fifo) const {
  if (is_fixed()) {
    return field(Register::gfc, fifo == 0 ? 9 : 8, 1) != 0;
  }
  return field(fifo == 0 ? Register::rxf0c : Register::rxf1c, 31, 1) != 0;
}

// Returns false if the message was lost.
bool MCan::store_in_fifo(const CanFrame& frame, const Decision& decision, unsigned fifo) {
  const Section elements = rx_fifo(fifo);
  RxFifo& state = fifos_[fifo];
  const bool was_full = state.fill == elements.elements;
  if (elements.elements == 0 || (was_full && !overwrites(fifo))) {
    raise(flag_of(fifo, Flag::rf0l));
    return false;
  }
  write_rx_element(elements, state.put, frame, decision);
  state.put = (state.put + 1) % elements.elements;
  raise(flag_of(fifo, Flag::rf0n));
  if (was_full) {
    state.get = state.put;
    return true;
  }
  ++state.fill;
  if (state.fill == elements.elements) {
    raise(flag_of(fifo, Flag::rf0f));
  }
  const Register configuration = fifo == 0 ? Register::rxf0c : Register::rxf1c;
  if (!is_fixed() && state.fill == field(configuration, 24, 0x7F)) {
    raise(flag_of(fifo, Flag::rf0w));
  }
  return true;
}

void MCan::store_in_buffer(const CanFrame& frame, const Decision& decision) {
  write_rx_element(rx_buffers(), decision.buffer, frame, decision);
  value(decision.buffer < 32 ? Register::ndat1 : Register::ndat2) |= 1U << decision.buffer % 32;
  raise(Flag::drx);
}

void MCan::write_rx_element(const Section& section, unsigned index, const CanFrame& frame, const Decision& decision) {
  const unsigned start = section.start + index * section.words;
  std::uint32_t id = frame.is_extended ? frame.id | xtd : frame.id << 18;
  id |= (frame.is_remote ? rtr : 0) | (frame.has_esi ? esi : 0);
  std::uint32_t control = decision.is_matched ? std::uint32_t{decision.filter} << 24 : anmf;
  control |= (frame.is_fd ? fdf : 0) | (frame.has_brs ? brs : 0) | std::uint32_t{frame.dlc} << 16;
  set_ram_word(start, id);
  set_ram_word(start + 1, control | time_of_start_);
  const unsigned words = std::min((frame.bytes() + 3) / 4, section.words - 2);
  for (unsigned i = 0; i < words; ++i) {
    std::uint32_t word = 0;
    for (unsigned byte = 0; byte < 4; ++byte) {
      word |= std::uint32_t{frame.data[4 * i + byte]} << (8 * byte);
    }
    set_ram_word(start + 2 + i, word);
  }
}

void MCan::set_high_priority(const Decision& decision, const CanFrame& frame, bool is_stored, unsigned index) {
  std::uint32_t indicator = 0;  // MSI: no FIFO selected
  if (decision.storage != Storage::none) {
    indicator = !is_stored ? 1 : decision.storage == Storage::fifo0 ? 2 : 3;
  }
  const std::uint32_t list = frame.is_extended ? 1U << 15 : 0;
  value(Register::hpms) = list | std::uint32_t{decision.filter} << 8 | indicator << 6 | (is_stored ? index : 0);
  raise(Flag::hpm);
}

// ---- Rx FIFO registers

std::uint32_t MCan::read_rx_status(unsigned fifo) const {
  const RxFifo& state = fifos_[fifo];
  const unsigned size = rx_fifo(fifo).elements;
  std::uint32_t result = state.fill | state.get << 8 | state.put << 16;
  result |= size != 0 && state.fill == size ? is_full : 0;
  // RFnL is a copy of the interrupt flag.
  const bool has_lost = (flags_ & bit_of(options_.layout, flag_of(fifo, Flag::rf0l))) != 0;
  return result | (has_lost ? is_lost : 0);
}

// Releases the elements from the get index up to the written index.
void MCan::acknowledge(unsigned fifo, std::uint32_t index) {
  RxFifo& state = fifos_[fifo];
  const unsigned size = rx_fifo(fifo).elements;
  const unsigned released = size == 0 || index >= size ? 0 : (index + size - state.get) % size + 1;
  if (released == 0 || released > state.fill) {
    fault("acknowledged index of an Rx FIFO without a message");
    return;
  }
  state.get = (index + 1) % size;
  state.fill -= released;
}

}  // namespace test
