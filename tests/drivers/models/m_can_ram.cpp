// SPDX-License-Identifier: Apache-2.0
// Class MessageRam, and the sections that an MCan has in it.
#include <algorithm>

#include "m_can.hpp"

namespace test {
namespace {

using Register = MCanRegister;

constexpr std::array<unsigned, 8> element_data = {8, 12, 16, 20, 24, 32, 48, 64};  // bytes
constexpr unsigned header_words = 2;
constexpr unsigned event_words = 2;
constexpr unsigned fixed_element_words = header_words + 16;

// Words of the sections of the fixed layout. [RM0440, FDCAN message RAM]
constexpr unsigned fixed_standard_filters = 28;
constexpr unsigned fixed_extended_filters = 8;
constexpr unsigned fixed_elements = 3;
constexpr unsigned fixed_extended_start = fixed_standard_filters;
constexpr unsigned fixed_fifo_start = fixed_extended_start + 2 * fixed_extended_filters;
constexpr unsigned fixed_fifo_words = fixed_elements * fixed_element_words;
constexpr unsigned fixed_events_start = fixed_fifo_start + 2 * fixed_fifo_words;
constexpr unsigned fixed_buffers_start = fixed_events_start + fixed_elements * event_words;

unsigned element_words(std::uint32_t size_code) { return header_words + element_data[size_code & 7] / 4; }

}  // namespace

MessageRam::MessageRam(std::uintptr_t address, unsigned words) : RegisterModel(address, std::size_t{4} * words) {
  constexpr std::uint32_t pattern = 0x5AC396E1;
  words_.assign(words, pattern);
}

void MessageRam::before_access() {
  if (!controllers_.empty()) {
    controllers_.front()->before_access();
  }
}

void MessageRam::check_owner(unsigned word) {
  if (std::none_of(controllers_.begin(), controllers_.end(), [&](const MCan* one) { return one->owns(word); })) {
    fault("access of a message RAM word outside of the sections of the controllers");
  }
}

std::uint32_t MessageRam::read_register(std::uint32_t offset) {
  check_owner(offset / 4);
  return words_[offset / 4];
}

void MessageRam::write_register(std::uint32_t offset, std::uint32_t value) {
  check_owner(offset / 4);
  for (const MCan* controller : controllers_) {
    if (controller->is_in_pending_buffer(offset / 4)) {
      fault("write to a Tx buffer with a pending transmission request");
    }
  }
  words_[offset / 4] = value;
}

// Returns whether the driver may access the word: during initialization all words, to be able to clear them.
bool MCan::owns(unsigned word) const {
  if (is_fixed()) {
    return word >= options_.ram_offset && word < options_.ram_offset + fixed_words;
  }
  const std::vector<Section> all = sections();
  return is_initializing() ||
         std::any_of(all.begin(), all.end(), [&](const Section& one) { return word >= one.start && word < one.end(); });
}

bool MCan::is_in_pending_buffer(unsigned word) const {
  const Section buffers = tx_buffers();
  if (word < buffers.start || word >= buffers.end()) {
    return false;
  }
  return ((value(Register::txbrp) >> ((word - buffers.start) / buffers.words)) & 1) != 0;
}

std::uint32_t MCan::ram_word(unsigned word) const { return word < ram_.size() ? ram_.word(word) : 0; }

void MCan::set_ram_word(unsigned word, std::uint32_t value) {
  if (word < ram_.size()) {
    ram_.set_word(word, value);
  }
}

MCan::Section MCan::section(const char* name, Register start, unsigned elements, unsigned words) const {
  return {name, (value(start) & 0xFFFC) / 4, elements, words};
}

MCan::Section MCan::standard_filters() const {
  if (is_fixed()) {
    return {"standard filters", options_.ram_offset, std::min(field(Register::gfc, 16, 31), fixed_standard_filters), 1};
  }
  return section("standard filters", Register::sidfc, std::min(field(Register::sidfc, 16, 0xFF), 128U), 1);
}

MCan::Section MCan::extended_filters() const {
  if (is_fixed()) {
    const unsigned elements = std::min(field(Register::gfc, 24, 15), fixed_extended_filters);
    return {"extended filters", options_.ram_offset + fixed_extended_start, elements, 2};
  }
  return section("extended filters", Register::xidfc, std::min(field(Register::xidfc, 16, 0x7F), 64U), 2);
}

MCan::Section MCan::rx_fifo(unsigned fifo) const {
  const char* const name = fifo == 0 ? "Rx FIFO 0" : "Rx FIFO 1";
  if (is_fixed()) {
    const unsigned start = options_.ram_offset + fixed_fifo_start + fifo * fixed_fifo_words;
    return {name, start, fixed_elements, fixed_element_words};
  }
  const Register configuration = fifo == 0 ? Register::rxf0c : Register::rxf1c;
  const unsigned words = element_words(field(Register::rxesc, 4 * fifo, 7));
  return section(name, configuration, std::min(field(configuration, 16, 0x7F), 64U), words);
}

// Returns the dedicated Rx buffers. Their number is that of the highest buffer which a filter element selects.
MCan::Section MCan::rx_buffers() const {
  constexpr std::uint32_t store_in_buffer = 7;
  if (is_fixed()) {
    return {"Rx buffers", 0, 0, fixed_element_words};
  }
  unsigned elements = 0;
  const Section standard = standard_filters();
  for (unsigned i = 0; i < standard.elements; ++i) {
    const std::uint32_t element = ram_word(standard.start + i);
    elements = (element >> 27 & 7) == store_in_buffer ? std::max(elements, (element & 63) + 1) : elements;
  }
  const Section extended = extended_filters();
  for (unsigned i = 0; i < extended.elements; ++i) {
    const std::uint32_t second = ram_word(extended.start + 2 * i + 1);
    const bool is_buffer = ram_word(extended.start + 2 * i) >> 29 == store_in_buffer;
    elements = is_buffer ? std::max(elements, (second & 63) + 1) : elements;
  }
  return section("Rx buffers", Register::rxbc, elements, element_words(field(Register::rxesc, 8, 7)));
}

MCan::Section MCan::tx_events() const {
  if (is_fixed()) {
    return {"Tx event FIFO", options_.ram_offset + fixed_events_start, fixed_elements, event_words};
  }
  return section("Tx event FIFO", Register::txefc, std::min(field(Register::txefc, 16, 0x3F), 32U), event_words);
}

MCan::Section MCan::tx_buffers() const {
  if (is_fixed()) {
    return {"Tx buffers", options_.ram_offset + fixed_buffers_start, fixed_elements, fixed_element_words};
  }
  const unsigned elements = dedicated_buffers() + fifo_size();
  return section("Tx buffers", Register::txbc, elements, element_words(value(Register::txesc)));
}

std::vector<MCan::Section> MCan::sections() const {
  return {standard_filters(), extended_filters(), rx_fifo(0), rx_fifo(1), rx_buffers(), tx_events(), tx_buffers()};
}

// Records a fault for each section that exceeds the RAM or overlaps another one, also of another controller.
void MCan::check_sections() {
  if (is_fixed()) {
    return;
  }
  std::vector<Section> placed;
  for (const MCan* other : ram_.controllers_) {
    if (other != this && !other->is_fixed() && !other->is_initializing()) {
      const std::vector<Section> all = other->sections();
      placed.insert(placed.end(), all.begin(), all.end());
    }
  }
  for (const Section& one : sections()) {
    if (one.elements == 0) {
      continue;
    }
    if (one.end() > ram_.size()) {
      fault(std::string(one.name) + ": outside of the message RAM");
    }
    for (const Section& other : placed) {
      if (other.elements != 0 && one.start < other.end() && other.start < one.end()) {
        fault(std::string(one.name) + ": overlaps " + other.name);
      }
    }
    placed.push_back(one);
  }
}

}  // namespace test
