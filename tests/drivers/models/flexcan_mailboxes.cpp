// SPDX-License-Identifier: Apache-2.0
// The memory of the FlexCAN model: mailboxes, Rx FIFO, transmission and reception.
#include <algorithm>

#include "flexcan.hpp"
#include "flexcan_bits.hpp"

namespace test {

using namespace flexcan;

namespace {

constexpr std::uint32_t undefined = 0xA5A5A5A5;  // output of an empty Rx FIFO
constexpr std::uint32_t extended_id = 0x1FFFFFFF;
constexpr std::uint32_t standard_id = 0x1FFC0000;
constexpr std::uint32_t fifo_output_end = flexcan::mailbox + 16;

// Returns the ID word of a frame.
std::uint32_t id_word(const CanFrame& frame) { return frame.is_extended ? frame.id : frame.id << 18; }

std::uint32_t data_word(const CanFrame& frame, unsigned first) {
  constexpr std::uint8_t unused = 0xEE;  // bytes beyond the DLC are undefined
  std::uint32_t word = 0;
  for (unsigned i = first; i < first + 4; ++i) {
    word = word << 8 | (i < frame.bytes() ? frame.data[i] : unused);
  }
  return word;
}

// Returns a frame in the layout of a filter of format A, B or C, and the bits that take part in the comparison.
struct FilterView {
  std::uint32_t value;
  std::uint32_t bits;
};

FilterView format_a(const CanFrame& frame) {
  const std::uint32_t head = (frame.is_remote ? 1U << 31 : 0) | (frame.is_extended ? 1U << 30 : 0);
  return frame.is_extended ? FilterView{head | frame.id << 1, 0xFFFFFFFE}
                           : FilterView{head | frame.id << 19, 0xFFF80000};
}

FilterView format_b(const CanFrame& frame) {
  const std::uint32_t head = (frame.is_remote ? 1U << 15 : 0) | (frame.is_extended ? 1U << 14 : 0);
  return frame.is_extended ? FilterView{head | frame.id >> 15, 0xFFFF} : FilterView{head | frame.id << 3, 0xFFF8};
}

FilterView format_c(const CanFrame& frame) { return {frame.is_extended ? frame.id >> 21 : frame.id >> 3, 0xFF}; }

bool is_valid_code(std::uint32_t code) {
  constexpr std::uint32_t valid = 1U << rx_inactive | 1U << rx_empty | 1U << tx_inactive | 1U << tx_abort |
                                  1U << rx_answer | 1U << tx_data | 1U << tx_answer;
  return (valid >> code & 1) != 0;
}

}  // namespace

// ---- Layout

// Returns the first mailbox behind the Rx FIFO and its filter table, which has 8 (RFFN + 1) elements. [Rx FIFO
// structure]
unsigned FlexCan::first_mailbox() const { return has(rfen) ? 8 + 2 * (ctrl2_ >> 24 & 15) : 0; }

unsigned FlexCan::last_mailbox() const { return std::min<unsigned>(mcr_ & maxmb, options_.mailboxes - 1); }

bool FlexCan::is_fifo_word(std::uint32_t offset) const { return offset < flexcan::mailbox + 16 * first_mailbox(); }

bool FlexCan::is_mask_word(std::uint32_t offset) const {
  return offset >= flexcan::rximr && offset < flexcan::rximr + 4 * options_.mailboxes;
}

void FlexCan::set_code(unsigned index, std::uint32_t code) {
  word(index, 0) = (word(index, 0) & 0xF0FFFFFF) | code << 24;
}

// Checks at the end of Freeze mode that the memory was initialised. It is undefined after power-up.
void FlexCan::check_memory() {
  const auto is_written = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t offset = begin; offset < end; offset += 4) {
      if (!written_[word_at(offset)]) {
        return false;
      }
    }
    return true;
  };
  if (options_.has_ecc && (mecr_ & eccdis) == 0) {
    if (!is_written(flexcan::mailbox, flexcan::mailbox + 16 * options_.mailboxes) ||
        !is_written(flexcan::rximr, flexcan::rximr + 4 * options_.mailboxes) ||
        !is_written(0xA80, flexcan::memory_end)) {
      fault("memory with error correction was not initialised");
    }
    return;
  }
  for (unsigned i = first_mailbox(); i <= last_mailbox(); ++i) {
    if (!written_[4 * i]) {
      fault("mailbox " + std::to_string(i) + " was not initialised");
    } else if (has(irmq) && code(i) == rx_empty && !written_[word_at(flexcan::rximr) + i]) {
      fault("RXIMR" + std::to_string(i) + " was not initialised");
    }
  }
  if (!has(rfen)) {
    return;
  }
  const unsigned elements = 4 * (first_mailbox() - 6);
  if (!is_written(flexcan::filters, flexcan::filters + 4 * elements)) {
    fault("the filter table of the Rx FIFO was not initialised");
  }
  const unsigned masks = std::min(first_mailbox(), options_.mailboxes);
  if (has(irmq) && !is_written(flexcan::rximr, flexcan::rximr + 4 * masks)) {
    fault("RXIMR of the Rx FIFO were not initialised");
  }
}

// ---- Reading

std::uint32_t FlexCan::read_memory(std::uint32_t offset) {
  if (options_.has_ecc && (mecr_ & eccdis) == 0 && !written_[word_at(offset)]) {
    fault("memory with error correction is read before it is written");
    return 0;
  }
  if (is_mask_word(offset) && mode_ != Mode::freeze) {
    fault("read of RXIMR outside of Freeze mode");
    return 0;
  }
  if (is_fifo_word(offset)) {
    return read_fifo(offset);
  }
  if (is_mailbox_word(offset)) {
    return read_mailbox((offset - flexcan::mailbox) / 16, offset / 4 % 4);
  }
  return memory_[word_at(offset)];
}

std::uint32_t FlexCan::read_fifo(std::uint32_t offset) {
  if (offset >= fifo_output_end && offset < flexcan::filters) {
    fault("read of the reserved region of the Rx FIFO");
    return 0;
  }
  if (offset < fifo_output_end && fifo_.empty()) {
    fault("the Rx FIFO is read while no message is available");
  }
  return memory_[word_at(offset)];
}

// Reading the C/S word locks a mailbox that has a message, and unlocks another one. [Mailbox lock mechanism]
std::uint32_t FlexCan::read_mailbox(unsigned index, unsigned which) {
  const bool is_full = is_rx_full(code(index));
  if (which != 0) {
    if (is_full && locked_ != index && mode_ == Mode::normal) {
      fault("data of a mailbox is read before its C/S word, which locks it");
    }
    return word(index, which);
  }
  if (locked_ != index) {
    unlock();
  }
  const std::uint32_t value = word(index, 0);
  if (is_full || (code(index) == rx_empty && !has(irmq))) {
    locked_ = index;
  }
  return value;
}

// Moves a message that waits for the mailbox into it. [Mailbox lock mechanism]
void FlexCan::unlock() {
  if (!locked_) {
    return;
  }
  const unsigned index = *locked_;
  locked_.reset();
  if (is_rx_full(code(index))) {
    serviced_.set(index);
  }
  if (pending_ && pending_->mailbox == index) {
    move_in(index, pending_->words);
    pending_.reset();
  }
}

// ---- Writing

void FlexCan::store_word(std::uint32_t offset, std::uint32_t value) {
  memory_[word_at(offset)] = value;
  written_.set(word_at(offset));
}

void FlexCan::write_memory(std::uint32_t offset, std::uint32_t value) {
  if ((ctrl2_ & wrmfrz) != 0 && mode_ == Mode::freeze) {
    store_word(offset, value);
  } else if (is_fifo_word(offset)) {
    write_fifo(offset, value);
  } else if (is_mailbox_word(offset)) {
    write_mailbox((offset - flexcan::mailbox) / 16, offset / 4 % 4, value);
  } else if (!is_mask_word(offset)) {
    fault("write to reserved memory without CTRL2.WRMFRZ");
  } else if (mode_ != Mode::freeze) {
    fault("write to RXIMR outside of Freeze mode");
  } else {
    store_word(offset, value);
  }
}

void FlexCan::write_fifo(std::uint32_t offset, std::uint32_t value) {
  if (offset < flexcan::filters) {
    fault("write to the region of the Rx FIFO");
  } else if (mode_ != Mode::freeze) {
    fault("write to the filter table outside of Freeze mode");
  } else {
    store_word(offset, value);
  }
}

// With AEN, a transmit mailbox cannot be written until its flag is cleared. [Transmit process]
void FlexCan::write_mailbox(unsigned index, unsigned which, std::uint32_t value) {
  const bool is_transmit = code(index) >= tx_inactive;
  if (mode_ == Mode::normal && has(aen) && is_flagged(index) && is_transmit && written_[4 * index]) {
    const bool is_late_abort = which == 0 && (value >> 24 & 15) == tx_abort;
    if (!is_late_abort) {
      fault("write to a transmit mailbox while its flag in IFLAG is set");
    }
    return;
  }
  if (which == 0) {
    write_control(index, value);
    return;
  }
  if (mode_ == Mode::normal && is_active(code(index))) {
    fault("write to the ID or data of an active mailbox");
    return;
  }
  store_word(flexcan::mailbox + 16 * index + 4 * which, value);
}

void FlexCan::write_control(unsigned index, std::uint32_t value) {
  check_control(value);
  const std::uint32_t next = value >> 24 & 15;
  const std::uint32_t old = code(index);
  if (mode_ == Mode::normal && is_tx_active(old) && !may_replace_active(index, next)) {
    return;
  }
  if (locked_ == index) {  // inactivation takes precedence over locking [Mailbox lock mechanism]
    locked_.reset();
    lost_frames_ += pending_ ? 1U : 0U;
    pending_.reset();
  }
  if (mode_ == Mode::normal && node_.is_busy() && (is_rx_active(old) || is_rx_active(next))) {
    excluded_.set(index);  // [Mailbox inactivation]
  }
  serviced_.reset(index);
  store_word(flexcan::mailbox + 16 * index, value);
}

void FlexCan::check_control(std::uint32_t value) {
  const std::uint32_t next = value >> 24 & 15;
  if ((value & 0xF0800000) != 0) {
    fault("C/S word: a bit is set that is reserved or not modelled");
  }
  if (!is_valid_code(next)) {
    fault("C/S word: CODE " + std::to_string(next) + " is not written by software");
  }
  if (next == tx_abort && !has(aen)) {
    fault("CODE ABORT without MCR.AEN");
  }
  if (is_tx_active(next) && (value & ide) != 0 && (value & srr) == 0) {
    fault("extended frame without SRR");
  }
}

// Returns whether the C/S word of an active transmit mailbox is replaced. [Transmission abort mechanism]
bool FlexCan::may_replace_active(unsigned index, std::uint32_t next) {
  const bool is_loaded = transmitting_ == index && !is_abandoned_;
  if (next == tx_abort && has(aen)) {
    if (is_loaded) {
      is_aborting_ = true;
    } else {
      abort(index);
    }
    return false;
  }
  if ((next != tx_inactive && next != rx_inactive) || has(aen)) {
    fault(has(aen) ? "an active transmit mailbox is written before it is aborted"
                   : "an active transmit mailbox is written before it is inactive");
    return false;
  }
  is_abandoned_ = is_abandoned_ || is_loaded;
  return true;
}

void FlexCan::abort(unsigned index) {
  set_code(index, tx_abort);
  set_flag(index);
}

// ---- Transmission

// Returns a value that is lower for a mailbox that is transmitted earlier. [Arbitration process]
std::uint64_t FlexCan::priority(unsigned index) const {
  if ((ctrl1_ & lbuf) != 0) {
    return index;
  }
  const std::uint64_t local = has(lprioen) ? word(index, 1) >> 29 : 0;
  return local << 40 | arbitration_value(frame_of(index));
}

CanFrame FlexCan::frame_of(unsigned index) const {
  const std::uint32_t control = word(index, 0);
  CanFrame frame;
  frame.is_extended = (control & ide) != 0;
  frame.is_remote = (control & rtr) != 0;
  frame.id = frame.is_extended ? word(index, 1) & extended_id : word(index, 1) >> 18 & 0x7FF;
  frame.dlc = control >> 16 & 15;
  for (unsigned i = 0; i < 8; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(word(index, 2 + i / 4) >> (24 - 8 * (i % 4)));
  }
  return frame;
}

std::optional<CanFrame> FlexCan::next_frame() {
  if (has(mdis) || is_freeze_requested()) {
    return std::nullopt;
  }
  std::optional<unsigned> first;
  for (unsigned i = first_mailbox(); i <= last_mailbox(); ++i) {
    if (is_tx_active(code(i)) && (!first || priority(i) < priority(*first))) {
      first = i;
    }
  }
  if (!first) {
    return std::nullopt;
  }
  transmitting_ = first;
  is_abandoned_ = false;
  sent_ = frame_of(*first);
  return sent_;
}

// The time stamp is that of the second identifier bit. [TIMER]
void FlexCan::on_start_of_frame(bool /*is_transmitter*/) {
  time_of_start_ = static_cast<std::uint16_t>(timer_ + 2);
  excluded_.reset();
}

// A remote frame makes the mailbox an Rx mailbox; an answer waits for the next request. [Message buffer code for Tx
// buffers]
void FlexCan::on_sent() {
  if ((ctrl1_ & lpb) == 0 && !has(srxdis)) {
    receive(sent_);
  }
  const unsigned index = *transmitting_;
  transmitting_.reset();
  is_aborting_ = false;
  if (is_abandoned_) {
    is_abandoned_ = false;
    return;
  }
  word(index, 0) = (word(index, 0) & 0xFFFF0000) | time_of_start_;
  if (code(index) == tx_answer) {
    set_code(index, rx_answer);
  } else {
    set_code(index, sent_.is_remote ? rx_empty : tx_inactive);
  }
  set_flag(index);
}

void FlexCan::end_attempt() {
  if (is_aborting_ && !is_abandoned_) {
    abort(*transmitting_);
  }
  transmitting_.reset();
  is_aborting_ = false;
  is_abandoned_ = false;
}

// ---- Reception

void FlexCan::on_received(const CanFrame& frame) { receive(frame); }

// Chooses between Rx FIFO and mailboxes. [Matching process, table of matching possibilities]
void FlexCan::receive(const CanFrame& frame) {
  const std::optional<unsigned> filter = matching_filter(frame);
  const bool has_room = filter && fifo_.size() < fifo_depth;
  if (has_room && (ctrl2_ & mrp) == 0) {
    push(frame, *filter);
    return;
  }
  std::optional<unsigned> target;
  if (!frame.is_remote || (ctrl2_ & rrs) != 0) {
    target = matching_mailbox(frame);
  } else if (answer(frame)) {
    return;
  }
  if (has_room && (!target || (has(irmq) && !is_free(*target)))) {
    push(frame, *filter);
  } else if (target) {
    store(*target, frame);
  } else if (filter) {
    iflag_ |= fifo_overflow;
  }
}

// Starts the transmission of a mailbox with CODE RANSWER. Masks are not used. [Remote frames]
bool FlexCan::answer(const CanFrame& frame) {
  for (unsigned i = first_mailbox(); i <= last_mailbox(); ++i) {
    const std::uint32_t bits = frame.is_extended ? extended_id : standard_id;
    const bool is_extended = (word(i, 0) & ide) != 0;
    if (code(i) == rx_answer && is_extended == frame.is_extended && ((word(i, 1) ^ id_word(frame)) & bits) == 0) {
      set_code(i, tx_answer);
      return true;
    }
  }
  return false;
}

std::uint32_t FlexCan::mailbox_mask(unsigned index) const {
  if (has(irmq)) {
    return memory_[word_at(flexcan::rximr) + index];
  }
  return index == 14 ? masks_[1] : index == 15 ? masks_[2] : masks_[0];
}

// EACEN extends the comparison by RTR, and lets the mask disable that of IDE. [CTRL2, field EACEN]
bool FlexCan::matches(unsigned index, const CanFrame& frame) const {
  if (!is_rx_active(code(index))) {
    return false;
  }
  const std::uint32_t mask = mailbox_mask(index);
  const bool compares_all = (ctrl2_ & eacen) != 0;
  const bool has_other_format = ((word(index, 0) & ide) != 0) != frame.is_extended;
  const bool has_other_type = ((word(index, 0) & rtr) != 0) != frame.is_remote;
  if (has_other_format && (!compares_all || (mask >> 30 & 1) != 0)) {
    return false;
  }
  if (has_other_type && compares_all && mask >> 31 != 0) {
    return false;
  }
  const std::uint32_t bits = mask & (frame.is_extended ? extended_id : standard_id);
  return ((word(index, 1) ^ id_word(frame)) & bits) == 0;
}

// An Rx mailbox is free if it is empty, or if its message was read and the mailbox unlocked. [Matching process]
bool FlexCan::is_free(unsigned index) const { return code(index) == rx_empty || serviced_[index]; }

// Returns the first matching mailbox; with IRMQ the first free one, or else the last one. [Matching process]
std::optional<unsigned> FlexCan::matching_mailbox(const CanFrame& frame) {
  std::optional<unsigned> found;
  bool is_excluded = false;
  for (unsigned i = first_mailbox(); i <= last_mailbox(); ++i) {
    if (!matches(i, frame)) {
      continue;
    }
    if (excluded_[i]) {
      is_excluded = true;
      continue;
    }
    found = i;
    if (!has(irmq) || is_free(i)) {
      break;
    }
  }
  lost_frames_ += is_excluded && !found ? 1U : 0U;
  return found;
}

// Returns the mask of an element of the filter table. [RXFGMASK; CTRL2, field RFFN]
std::uint32_t FlexCan::filter_mask(unsigned element) const {
  const unsigned individual = std::min(first_mailbox(), options_.mailboxes);
  return has(irmq) && element < individual ? memory_[word_at(flexcan::rximr) + element] : masks_[3];
}

// Returns the number of the first matching filter: an element has one, two or four. [Rx FIFO structure]
std::optional<unsigned> FlexCan::matching_filter(const CanFrame& frame) const {
  const std::uint32_t format = (mcr_ & idam) >> 8;
  if (!has(rfen) || format == 3) {
    return std::nullopt;
  }
  const FilterView view = format == 0 ? format_a(frame) : format == 1 ? format_b(frame) : format_c(frame);
  const unsigned parts = 1U << format;
  const unsigned width = 32 / parts;
  const unsigned elements = 4 * (first_mailbox() - 6);
  for (unsigned element = 0; element < elements; ++element) {
    const std::uint32_t filter = memory_[word_at(flexcan::filters) + element];
    const std::uint32_t mask = filter_mask(element);
    for (unsigned part = 0; part < parts; ++part) {
      const unsigned shift = 32 - width * (part + 1);
      if (((filter >> shift ^ view.value) & mask >> shift & view.bits) == 0) {
        return parts * element + part;
      }
    }
  }
  return std::nullopt;
}

FlexCan::Words FlexCan::words_of(const CanFrame& frame) const {
  std::uint32_t control = time_of_start_ | std::uint32_t{frame.dlc} << 16;
  control |= frame.is_remote ? rtr : 0;
  control |= frame.is_extended ? ide | srr : 0;
  return {control, id_word(frame), data_word(frame, 0), data_word(frame, 4)};
}

// Stores a message, or keeps it until the mailbox is unlocked; a newer message replaces it then.
void FlexCan::store(unsigned index, const CanFrame& frame) {
  if (locked_ != index) {
    move_in(index, words_of(frame));
    return;
  }
  lost_frames_ += pending_ ? 1U : 0U;
  pending_ = Pending{index, words_of(frame)};
}

// [Message buffer code for Rx buffers]
void FlexCan::move_in(unsigned index, const Words& words) {
  const std::uint32_t next = is_free(index) ? rx_full : rx_overrun;
  for (unsigned i = 0; i < words.size(); ++i) {
    word(index, i) = words[i];
  }
  set_code(index, next);
  serviced_.reset(index);
  set_flag(index);
  if ((ctrl1_ & tsyn) != 0 && index == first_mailbox()) {
    timer_ = 0;
  }
}

// ---- Rx FIFO

void FlexCan::push(const CanFrame& frame, unsigned filter) {
  FifoMessage message{words_of(frame), filter};
  message.words[0] |= options_.version == 3 ? filter << 23 : 0;
  fifo_.push_back(message);
  if (fifo_.size() == 1) {
    show_first_message();
  }
  if (fifo_.size() == fifo_depth - 1) {
    iflag_ |= fifo_warning;
  }
}

void FlexCan::pop() {
  fifo_.pop_front();
  show_first_message();
}

// Updates the output of the Rx FIFO and BUF5I.
void FlexCan::show_first_message() {
  const Words nothing{undefined, undefined, undefined, undefined};
  const Words& words = fifo_.empty() ? nothing : fifo_.front().words;
  for (unsigned i = 0; i < words.size(); ++i) {
    word(0, i) = words[i];
  }
  iflag_ = (iflag_ & ~std::uint64_t{fifo_available}) | (fifo_.empty() ? 0 : fifo_available);
}

}  // namespace test
