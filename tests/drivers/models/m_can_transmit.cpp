// SPDX-License-Identifier: Apache-2.0
// Class MCan: transmission from Tx buffers, Tx FIFO and Tx queue, and the Tx event FIFO.
#include <algorithm>

#include "m_can.hpp"

namespace test {
namespace {

using Register = MCanRegister;
using Flag = MCanFlag;

// CCCR
constexpr std::uint32_t cce = 1U << 1;
constexpr std::uint32_t dar = 1U << 6;
constexpr std::uint32_t fdoe = 1U << 8;
constexpr std::uint32_t brse = 1U << 9;

// Tx buffer elements
constexpr std::uint32_t esi = 1U << 31;
constexpr std::uint32_t xtd = 1U << 30;
constexpr std::uint32_t rtr = 1U << 29;
constexpr std::uint32_t efc = 1U << 23;
constexpr std::uint32_t fdf = 1U << 21;
constexpr std::uint32_t brs = 1U << 20;

constexpr std::uint32_t queue_is_full = 1U << 21;
constexpr std::uint32_t events_are_full = 1U << 24;
constexpr std::uint32_t event_is_lost = 1U << 25;
constexpr unsigned most_buffers = 32;
constexpr unsigned fixed_buffers = 3;

}  // namespace

unsigned MCan::dedicated_buffers() const {
  return is_fixed() ? 0 : std::min<unsigned>(field(Register::txbc, 16, 0x3F), most_buffers);
}

unsigned MCan::fifo_size() const {
  if (is_fixed()) {
    return fixed_buffers;
  }
  return std::min<unsigned>(field(Register::txbc, 24, 0x3F), most_buffers - dedicated_buffers());
}

bool MCan::is_queue() const { return field(Register::txbc, is_fixed() ? 24 : 30, 1) != 0; }

std::uint32_t MCan::buffer_mask() const {
  const unsigned buffers = dedicated_buffers() + fifo_size();
  return static_cast<std::uint32_t>((std::uint64_t{1} << buffers) - 1);
}

// ---- Requests

void MCan::request(std::uint32_t buffers) {
  const std::uint32_t cccr = value(Register::cccr);
  if ((cccr & cce) != 0) {
    fault("write to TXBAR while CCCR.CCE is set");
    return;
  }
  if ((buffers & ~buffer_mask()) != 0) {
    fault("transmission requested from a Tx buffer that is not configured");
  }
  buffers &= buffer_mask() & ~value(Register::txbrp);  // further requests of pending buffers are ignored
  if (node_.mode().is_silent && !node_.mode().is_loopback) {
    return;  // bus monitoring mode
  }
  if (!is_queue()) {
    request_from_fifo(buffers);
  }
  value(Register::txbrp) |= buffers;
  value(Register::txbto) &= ~buffers;
  value(Register::txbcf) &= ~buffers;
}

// Moves the put index over the requested buffers; removes those that do not follow it.
void MCan::request_from_fifo(std::uint32_t& buffers) {
  const unsigned first = dedicated_buffers();
  const unsigned size = fifo_size();
  std::uint32_t requested = buffers & ~static_cast<std::uint32_t>((std::uint64_t{1} << first) - 1);
  while (fifo_fill_ < size) {
    const std::uint32_t bit = 1U << (first + (fifo_get_ + fifo_fill_) % size);
    if ((requested & bit) == 0) {
      break;
    }
    requested &= ~bit;
    ++fifo_fill_;
  }
  if (requested != 0) {
    fault("transmission requested from a Tx FIFO element that is not at the put index");
    buffers &= ~requested;
  }
}

void MCan::cancel(std::uint32_t buffers) {
  if ((value(Register::cccr) & cce) != 0) {
    fault("write to TXBCR while CCCR.CCE is set");
    return;
  }
  for (unsigned i = 0; i < most_buffers; ++i) {
    if ((buffers & value(Register::txbrp) & 1U << i) == 0) {
      continue;
    }
    if (transmitting_ == i) {
      cancelling_ |= 1U << i;
    } else {
      end_request(i, false, true);
    }
  }
}

void MCan::end_request(unsigned buffer, bool was_sent, bool was_cancelled) {
  const std::uint32_t bit = 1U << buffer;
  value(Register::txbrp) &= ~bit;
  cancelling_ &= ~bit;
  if (was_sent) {
    value(Register::txbto) |= bit;
    if ((value(Register::txbtie) & bit) != 0) {
      raise(Flag::tc);
    }
  }
  if (was_cancelled) {
    value(Register::txbcf) |= bit;
    if ((value(Register::txbcie) & bit) != 0) {
      raise(Flag::tcf);
    }
  }
  release_fifo();
}

// Moves the get index to the next pending element.
void MCan::release_fifo() {
  const bool was_filled = fifo_fill_ != 0;
  const unsigned first = dedicated_buffers();
  while (fifo_fill_ != 0 && ((value(Register::txbrp) >> (first + fifo_get_)) & 1) == 0) {
    fifo_get_ = (fifo_get_ + 1) % fifo_size();
    --fifo_fill_;
  }
  if (was_filled && fifo_fill_ == 0) {
    raise(Flag::tfe);
  }
}

std::uint32_t MCan::read_txfqs() const {
  const unsigned first = dedicated_buffers();
  const unsigned size = fifo_size();
  if (size == 0) {
    return 0;
  }
  if (!is_queue()) {
    const unsigned put = first + (fifo_get_ + fifo_fill_) % size;
    const std::uint32_t full = fifo_fill_ == size ? queue_is_full : 0;
    return full | put << 16 | (first + fifo_get_) << 8 | (size - fifo_fill_);
  }
  for (unsigned i = first; i < first + size; ++i) {
    if (((value(Register::txbrp) >> i) & 1) == 0) {
      return i << 16;
    }
  }
  return queue_is_full;
}

// ---- Frames

// Returns the pending buffer with the highest priority: dedicated buffers, the oldest of the FIFO or all of the queue.
std::optional<unsigned> MCan::next_buffer() const {
  const unsigned first = dedicated_buffers();
  std::optional<unsigned> best;
  std::uint64_t best_value = 0;
  for (unsigned i = 0; i < first + fifo_size(); ++i) {
    const bool waits_in_fifo = !is_queue() && i >= first && i != first + fifo_get_;
    if (((value(Register::txbrp) >> i) & 1) == 0 || waits_in_fifo) {
      continue;
    }
    const std::uint64_t priority = arbitration_value(tx_frame(i));
    if (!best || priority < best_value) {
      best = i;
      best_value = priority;
    }
  }
  return best;
}

CanFrame MCan::tx_frame(unsigned buffer) const {
  constexpr std::uint8_t padding = 0xCC;  // bytes that the element does not have
  const Section elements = tx_buffers();
  const unsigned start = elements.start + buffer * elements.words;
  const std::uint32_t id = ram_word(start);
  const std::uint32_t control = ram_word(start + 1);
  const std::uint32_t cccr = value(Register::cccr);
  CanFrame frame;
  frame.is_extended = (id & xtd) != 0;
  frame.id = frame.is_extended ? id & 0x1FFFFFFF : id >> 18 & 0x7FF;
  frame.is_fd = (control & fdf) != 0 && (cccr & fdoe) != 0;
  frame.is_remote = (id & rtr) != 0 && !frame.is_fd;
  frame.has_brs = frame.is_fd && (control & brs) != 0 && (cccr & brse) != 0;
  frame.has_esi = frame.is_fd && ((id & esi) != 0 || node_.is_error_passive());
  frame.dlc = control >> 16 & 15;
  for (unsigned i = 0; i < frame.bytes(); ++i) {
    const bool exists = 2 + i / 4 < elements.words;
    frame.data[i] = exists ? static_cast<std::uint8_t>(ram_word(start + 2 + i / 4) >> (8 * (i % 4))) : padding;
  }
  return frame;
}

std::optional<CanFrame> MCan::next_frame() {
  const std::optional<unsigned> buffer = next_buffer();
  if (!buffer) {
    return std::nullopt;
  }
  transmitting_ = buffer;
  return tx_frame(*buffer);
}

void MCan::on_sent() {
  lec_ = 0;
  const unsigned buffer = *transmitting_;
  transmitting_.reset();
  const bool was_cancelled = (cancelling_ & 1U << buffer) != 0;
  add_event(buffer, was_cancelled);
  end_request(buffer, true, was_cancelled);
}

void MCan::on_arbitration_lost() { end_attempt(); }

void MCan::on_transmission_failed(CanError /*error*/) { end_attempt(); }

void MCan::end_attempt() {
  const unsigned buffer = *transmitting_;
  transmitting_.reset();
  const bool is_repeated = (value(Register::cccr) & dar) == 0 && (cancelling_ & 1U << buffer) == 0;
  if (!is_repeated) {
    end_request(buffer, false, true);
  }
}

// ---- Tx event FIFO

void MCan::add_event(unsigned buffer, bool was_cancelled) {
  constexpr std::uint32_t header = ~(efc | 1U << 22 | 0xFFFF);
  const Section buffers = tx_buffers();
  const unsigned start = buffers.start + buffer * buffers.words;
  const std::uint32_t control = ram_word(start + 1);
  if ((control & efc) == 0) {
    return;
  }
  const Section events = tx_events();
  if (events_.fill == events.elements) {
    raise(Flag::tefl);
    return;
  }
  const bool is_in_spite = was_cancelled || (value(Register::cccr) & dar) != 0;
  const std::uint32_t type = is_in_spite ? 2 : 1;
  set_ram_word(events.start + 2 * events_.put, ram_word(start));
  set_ram_word(events.start + 2 * events_.put + 1, (control & header) | type << 22 | time_of_start_);
  events_.put = (events_.put + 1) % events.elements;
  ++events_.fill;
  raise(Flag::tefn);
  if (events_.fill == events.elements) {
    raise(Flag::teff);
  }
  if (!is_fixed() && events_.fill == field(Register::txefc, 24, 0x3F)) {
    raise(Flag::tefw);
  }
}

std::uint32_t MCan::read_txefs() const {
  const unsigned size = tx_events().elements;
  std::uint32_t result = events_.fill | events_.get << 8 | events_.put << 16;
  result |= size != 0 && events_.fill == size ? events_are_full : 0;
  return result | ((flags_ & bit_of(options_.layout, Flag::tefl)) != 0 ? event_is_lost : 0);
}

void MCan::acknowledge_event(std::uint32_t index) {
  const unsigned size = tx_events().elements;
  const unsigned released = size == 0 || index >= size ? 0 : (index + size - events_.get) % size + 1;
  if (released == 0 || released > events_.fill) {
    fault("acknowledged index of the Tx event FIFO without an event");
    return;
  }
  events_.get = (index + 1) % size;
  events_.fill -= released;
}

}  // namespace test
