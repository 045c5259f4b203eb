// SPDX-License-Identifier: Apache-2.0
#include "bxcan.hpp"

#include <algorithm>
#include <utility>

namespace test {
namespace {

// CAN_MCR
constexpr std::uint32_t inrq = 1U << 0;
constexpr std::uint32_t sleep = 1U << 1;
constexpr std::uint32_t txfp = 1U << 2;
constexpr std::uint32_t rflm = 1U << 3;
constexpr std::uint32_t nart = 1U << 4;
constexpr std::uint32_t awum = 1U << 5;
constexpr std::uint32_t abom = 1U << 6;
constexpr std::uint32_t ttcm = 1U << 7;
constexpr std::uint32_t master_reset = 1U << 15;
constexpr std::uint32_t dbf = 1U << 16;
constexpr std::uint32_t mcr_at_reset = dbf | sleep;

// CAN_MSR
constexpr std::uint32_t inak = 1U << 0;
constexpr std::uint32_t slak = 1U << 1;
constexpr std::uint32_t erri = 1U << 2;
constexpr std::uint32_t wkui = 1U << 3;
constexpr std::uint32_t slaki = 1U << 4;
constexpr std::uint32_t txm = 1U << 8;
constexpr std::uint32_t rxm = 1U << 9;
constexpr std::uint32_t samp_and_rx = 3U << 10;

// CAN_TSR, of mailbox 0; those of mailbox n are 8 n bits higher
constexpr std::uint32_t rqcp = 1U << 0;
constexpr std::uint32_t txok = 1U << 1;
constexpr std::uint32_t alst = 1U << 2;
constexpr std::uint32_t terr = 1U << 3;
constexpr std::uint32_t abrq = 1U << 7;

// CAN_RFxR
constexpr std::uint32_t full = 1U << 3;
constexpr std::uint32_t fovr = 1U << 4;
constexpr std::uint32_t rfom = 1U << 5;

// CAN_IER
constexpr std::uint32_t tmeie = 1U << 0;
constexpr std::uint32_t fmpie = 1U << 1;  // of FIFO 0; those of FIFO 1 are 3 bits higher
constexpr std::uint32_t ffie = 1U << 2;
constexpr std::uint32_t fovie = 1U << 3;
constexpr std::uint32_t ewgie = 1U << 8;  // EPVIE, BOFIE follow in the order of the flags of CAN_ESR
constexpr std::uint32_t lecie = 1U << 11;
constexpr std::uint32_t errie = 1U << 15;
constexpr std::uint32_t wkuie = 1U << 16;
constexpr std::uint32_t slkie = 1U << 17;
constexpr std::uint32_t ier_bits = 0x00038F7F;

// CAN_ESR
constexpr std::uint32_t ewgf = 1U << 0;
constexpr std::uint32_t epvf = 1U << 1;
constexpr std::uint32_t boff = 1U << 2;

// CAN_BTR
constexpr std::uint32_t btr_bits = 0xC37F03FF;
constexpr std::uint32_t lbkm = 1U << 30;
constexpr std::uint32_t silm = 1U << 31;

// Mailboxes
constexpr std::uint32_t txrq = 1U << 0;
constexpr std::uint32_t rtr = 1U << 1;
constexpr std::uint32_t ide = 1U << 2;
constexpr std::uint32_t tgt = 1U << 8;

// CAN_FMR
constexpr std::uint32_t finit = 1U << 0;
constexpr std::uint32_t can2sb = 0x3FU << 8;
constexpr std::uint32_t fmr_at_reset = 0x2A1C0E01;

constexpr std::uint32_t undefined = 0xA5A5A5A5;  // content of mailboxes after reset
constexpr std::size_t fifo_depth = 3;

std::uint32_t identifier_word(const CanFrame& frame) {
  const std::uint32_t remote = frame.is_remote ? rtr : 0;
  return frame.is_extended ? frame.id << 3 | ide | remote : frame.id << 21 | remote;
}

// Returns STID[10:0] RTR IDE EXID[17:15], as the 16-bit filters compare.
std::uint32_t short_identifier(const CanFrame& frame) {
  const std::uint32_t remote = frame.is_remote ? 1U << 4 : 0;
  if (!frame.is_extended) {
    return frame.id << 5 | remote;
  }
  return (frame.id >> 18) << 5 | remote | 1U << 3 | ((frame.id >> 15) & 7);
}

bool is_set(std::uint32_t word, unsigned bit) { return ((word >> bit) & 1) != 0; }

std::uint32_t data_word(const CanFrame& frame, unsigned first) {
  constexpr std::uint8_t unused = 0xEE;  // bytes beyond the DLC are undefined
  std::uint32_t word = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const std::uint32_t byte = first + i < frame.bytes() ? frame.data[first + i] : unused;
    word |= byte << (8 * i);
  }
  return word;
}

}  // namespace

BxCan::BxCan(CanWire& wire, std::uintptr_t address) : BxCan(wire, address, Options{}) {}

BxCan::BxCan(CanWire& wire, std::uintptr_t address, const Options& options)
    : RegisterModel(address, bxcan::size), wire_(wire), options_(options), node_(wire, *this, options.name) {
  reset();
  btr_ = 0x01230000;
  fmr_ = fmr_at_reset;
  for (Mailbox& mailbox : mailboxes_) {
    mailbox.words.fill(undefined);
    mailbox.words[0] &= ~txrq;
  }
}

void BxCan::reset() {
  node_.reset();
  mode_ = Mode::sleep;
  is_synchronizing_ = false;
  mcr_ = mcr_at_reset;
  msr_flags_ = 0;
  ier_ = 0;
  lec_ = 0;
  esr_flags_ = 0;
  transmitting_.reset();
  for (Mailbox& mailbox : mailboxes_) {
    mailbox.is_pending = false;
    mailbox.is_aborting = false;
    mailbox.status = 0;
  }
  fifos_ = {};
  for (Fifo& fifo : fifos_) {
    fifo.last.fill(undefined);
  }
}

// ---- Interrupt lines

bool BxCan::transmit_interrupt() const {
  return (ier_ & tmeie) != 0 &&
         std::any_of(mailboxes_.begin(), mailboxes_.end(), [](const Mailbox& one) { return (one.status & rqcp) != 0; });
}

bool BxCan::receive_interrupt(unsigned fifo) const {
  const Fifo& one = fifos_[fifo];
  const std::uint32_t enabled = ier_ >> (3 * fifo);
  return ((enabled & fmpie) != 0 && !one.messages.empty()) || ((enabled & ffie) != 0 && one.is_full) ||
         ((enabled & fovie) != 0 && one.has_overrun);
}

bool BxCan::status_interrupt() const {
  const auto raised = [&](std::uint32_t flag, std::uint32_t enable) {
    return (msr_flags_ & flag) != 0 && (ier_ & enable) != 0;
  };
  return raised(erri, errie) || raised(wkui, wkuie) || raised(slaki, slkie);
}

bool BxCan::interrupt() const {
  return transmit_interrupt() || receive_interrupt(0) || receive_interrupt(1) || status_interrupt();
}

// ---- Modes

void BxCan::on_bit(bool level) {
  ++timer_;
  if (!has(ttcm)) {
    timer_ = 0;
  }
  change_mode(level);
  if (mode_ == Mode::normal && node_.state() == CanNode::State::bus_off && has(abom)) {
    node_.start();
  }
}

// Acknowledges requests of MCR when the current activity on the bus is complete.
void BxCan::change_mode(bool level) {
  if (is_synchronizing_) {
    if (has(inrq)) {
      enter_initialization();
    } else if (node_.is_on_bus()) {
      end_synchronization();
    }
    return;
  }
  switch (mode_) {
    case Mode::sleep: change_mode_of_sleep(level); break;
    case Mode::initialization:
      if (!has(inrq)) {
        if (has(sleep)) {
          enter_sleep();
        } else {
          begin_synchronization();
        }
      }
      break;
    case Mode::normal:
      if (has(inrq) && !node_.is_busy()) {
        enter_initialization();
      } else if (has(sleep) && !has(inrq) && !node_.is_busy()) {
        enter_sleep();
      }
      break;
  }
}

void BxCan::change_mode_of_sleep(bool level) {
  if (level == dominant && has(sleep)) {
    msr_flags_ |= wkui;
    if (has(awum)) {
      mcr_ &= ~sleep;
    }
  }
  if (has(sleep)) {
    return;
  }
  if (has(inrq)) {
    enter_initialization();
  } else {
    begin_synchronization();
  }
}

void BxCan::enter_initialization() {
  node_.stop();
  is_synchronizing_ = false;
  transmitting_.reset();
  mode_ = Mode::initialization;
  msr_flags_ &= ~slaki;
}

void BxCan::enter_sleep() {
  node_.stop();
  transmitting_.reset();
  mode_ = Mode::sleep;
  if ((ier_ & slkie) != 0) {
    msr_flags_ |= slaki;
  }
}

void BxCan::begin_synchronization() {
  constexpr unsigned recovery = 1 + 128;  // synchronization, and the recovery from bus-off in normal mode
  is_synchronizing_ = true;
  if (!has_right_bit_rate()) {
    fault("bit rate " + std::to_string(bit_rate()) + " differs from that of the bus");
    return;
  }
  CanMode mode;
  mode.is_loopback = (btr_ & lbkm) != 0;
  mode.is_silent = (btr_ & silm) != 0;
  node_.set_mode(mode);
  node_.start(recovery);
}

void BxCan::end_synchronization() {
  is_synchronizing_ = false;
  mode_ = Mode::normal;
  msr_flags_ &= ~slaki;
}

void BxCan::on_recovery_sequence(unsigned sequences) {
  if (sequences == 1 && is_synchronizing_) {
    end_synchronization();
  }
}

std::uint32_t BxCan::bit_rate() const {
  const std::uint32_t quanta = 3 + ((btr_ >> 16) & 15) + ((btr_ >> 20) & 7);
  return options_.clock / ((btr_ & 0x3FF) + 1) / quanta;
}

unsigned BxCan::sample_point() const {
  const unsigned before = 2 + ((btr_ >> 16) & 15);
  return 1000 * before / (before + 1 + ((btr_ >> 20) & 7));
}

bool BxCan::has_right_bit_rate() { return options_.clock == 0 || wire_.bit_rate == 0 || bit_rate() == wire_.bit_rate; }

// ---- Errors

void BxCan::on_error(CanError error) {
  lec_ = static_cast<std::uint32_t>(error);
  if ((ier_ & lecie) != 0) {
    msr_flags_ |= erri;
  }
}

void BxCan::on_counters() { set_errors(); }

// Sets ERRI for each flag that appears while its interrupt is enabled.
void BxCan::set_errors() {
  constexpr unsigned warning_limit = 96;
  std::uint32_t flags = 0;
  if (node_.tec() >= warning_limit || node_.rec() >= warning_limit) {
    flags |= ewgf;
  }
  if (node_.is_error_passive()) {
    flags |= epvf;
  }
  if (node_.is_bus_off()) {
    flags |= boff;
  }
  const std::uint32_t appeared = flags & ~esr_flags_;
  if ((appeared & (ier_ / ewgie)) != 0) {
    msr_flags_ |= erri;
  }
  esr_flags_ = flags;
}

// ---- Registers

void BxCan::before_access() {
  for (Fifo& fifo : fifos_) {
    if (fifo.is_releasing && fifo.release_in-- == 0) {
      release(fifo);
    }
  }
  wire_.count_access();
}

std::uint32_t BxCan::read_register(std::uint32_t offset) {
  switch (offset) {
    case bxcan::mcr: return mcr_;
    case bxcan::msr: return read_msr();
    case bxcan::tsr: return read_tsr();
    case bxcan::rf0r: return read_fifo(fifos_[0]);
    case bxcan::rf1r: return read_fifo(fifos_[1]);
    case bxcan::ier: return ier_;
    case bxcan::esr: return read_esr();
    case bxcan::btr: return btr_;
    default: break;
  }
  if (offset >= bxcan::ti0r && offset < bxcan::ri0r) {
    return mailboxes_[(offset - bxcan::ti0r) / 16].words[offset % 16 / 4];
  }
  if (offset >= bxcan::ri0r && offset < bxcan::ri0r + fifos * 16) {
    return read_received(offset);
  }
  if (std::uint32_t* const filter = filter_register(offset)) {
    return *filter;
  }
  fault("read of a reserved offset");
  return 0;
}

void BxCan::write_register(std::uint32_t offset, std::uint32_t value) {
  switch (offset) {
    case bxcan::mcr: write_mcr(value); return;
    case bxcan::msr: write_msr(value); return;
    case bxcan::tsr: write_tsr(value); return;
    case bxcan::rf0r: write_fifo(fifos_[0], value); return;
    case bxcan::rf1r: write_fifo(fifos_[1], value); return;
    case bxcan::ier: write_ier(value); return;
    case bxcan::esr: lec_ = (value >> 4) & 7; return;
    case bxcan::btr: write_btr(value); return;
    default: break;
  }
  if (offset >= bxcan::ti0r && offset < bxcan::ri0r) {
    write_mailbox(offset, value);
  } else if (offset >= bxcan::ri0r && offset < bxcan::ri0r + fifos * 16) {
    fault("write to a receive mailbox");
  } else if (filter_register(offset) != nullptr) {
    write_filter(offset, value);
  } else {
    fault("write to a reserved offset");
  }
}

std::uint32_t BxCan::read_msr() const {
  std::uint32_t value = msr_flags_;
  if (mode_ == Mode::initialization) {
    value |= inak;
  }
  if (mode_ == Mode::sleep) {
    value |= slak;
  }
  if (node_.is_busy()) {
    value |= node_.is_transmitter() ? txm : rxm;
  }
  return value | (wire_.level() == recessive ? samp_and_rx : 0);
}

std::uint32_t BxCan::read_tsr() const {
  std::uint32_t value = 0;
  unsigned next_free = mailboxes;
  for (unsigned i = mailboxes; i-- != 0;) {
    const Mailbox& mailbox = mailboxes_[i];
    value |= mailbox.status << (8 * i);
    value |= mailbox.is_aborting ? abrq << (8 * i) : 0;
    if (!mailbox.is_pending) {
      value |= 1U << (26 + i);  // TME
      next_free = i;
    }
  }
  const std::optional<unsigned> lowest = last_pending();
  if (pending() > 1) {
    value |= 1U << (29 + *lowest);
  }
  return value | (next_free < mailboxes ? next_free : *lowest) << 24;
}

std::uint32_t BxCan::read_fifo(const Fifo& fifo) const {
  std::uint32_t value = static_cast<std::uint32_t>(fifo.messages.size());
  value |= fifo.is_full ? full : 0;
  value |= fifo.has_overrun ? fovr : 0;
  return value | (fifo.is_releasing ? rfom : 0);
}

std::uint32_t BxCan::read_esr() const {
  return node_.rec() << 24 | (node_.tec() & 0xFF) << 16 | lec_ << 4 | esr_flags_;
}

std::uint32_t BxCan::read_received(std::uint32_t offset) {
  const Fifo& fifo = fifos_[(offset - bxcan::ri0r) / 16];
  return (fifo.messages.empty() ? fifo.last : fifo.messages.front())[offset % 16 / 4];
}

void BxCan::write_mcr(std::uint32_t value) {
  constexpr std::uint32_t bits = 0x000180FF;
  if ((value & ~bits) != 0) {
    fault("reserved bit set in MCR");
  }
  if ((value & master_reset) != 0) {
    reset();
    return;
  }
  mcr_ = value & bits;
}

void BxCan::write_msr(std::uint32_t value) { msr_flags_ &= ~(value & (erri | wkui | slaki)); }

void BxCan::write_tsr(std::uint32_t value) {
  for (unsigned i = 0; i < mailboxes; ++i) {
    const std::uint32_t bits = value >> (8 * i);
    mailboxes_[i].status &= ~(bits & (rqcp | txok | alst | terr));
    if ((bits & rqcp) != 0) {
      mailboxes_[i].status = 0;
    }
    if ((bits & abrq) != 0) {
      request_abort(i);
    }
  }
}

void BxCan::request_abort(unsigned index) {
  Mailbox& mailbox = mailboxes_[index];
  if (!mailbox.is_pending) {
    if (late_abort_clears_flags) {
      mailbox.status &= ~(rqcp | txok);
    }
    return;
  }
  mailbox.is_aborting = true;
  if (transmitting_ != index) {
    abort(mailbox);
  }
}

void BxCan::abort(Mailbox& mailbox) {
  mailbox.is_pending = false;
  mailbox.is_aborting = false;
  mailbox.words[0] &= ~txrq;
  mailbox.status = (mailbox.status & ~txok) | rqcp;
}

void BxCan::write_fifo(Fifo& fifo, std::uint32_t value) {
  if ((value & full) != 0) {
    fifo.is_full = false;
  }
  if ((value & fovr) != 0) {
    fifo.has_overrun = false;
  }
  if ((value & rfom) != 0 && !fifo.messages.empty() && !fifo.is_releasing) {
    fifo.is_releasing = true;
    fifo.release_in = release_accesses;
    if (release_accesses == 0) {
      release(fifo);
    }
  }
}

void BxCan::release(Fifo& fifo) {
  fifo.is_releasing = false;
  fifo.last = fifo.messages.front();
  fifo.messages.pop_front();
}

void BxCan::write_ier(std::uint32_t value) {
  if ((value & ~ier_bits) != 0) {
    fault("reserved bit set in IER");
  }
  ier_ = value & ier_bits;
}

void BxCan::write_btr(std::uint32_t value) {
  if (mode_ != Mode::initialization) {
    fault("write to BTR outside of initialization mode");
    return;
  }
  if ((value & ~btr_bits) != 0) {
    fault("reserved bit set in BTR");
  }
  btr_ = value & btr_bits;
}

void BxCan::write_mailbox(std::uint32_t offset, std::uint32_t value) {
  Mailbox& mailbox = mailboxes_[(offset - bxcan::ti0r) / 16];
  const std::uint32_t word = offset % 16 / 4;
  if (mailbox.is_pending) {
    fault("write to a transmit mailbox that is not empty");
    return;
  }
  mailbox.words[word] = value;
  if (word == 0 && (value & txrq) != 0) {
    mailbox.is_pending = true;
    mailbox.order = ++requests_;
    mailbox.status = 0;
  }
}

// ---- Transmission

// Returns a value that is lower for a mailbox that is transmitted earlier.
std::uint64_t BxCan::priority(const Mailbox& mailbox) const {
  return has(txfp) ? mailbox.order : arbitration_value(frame_of(mailbox));
}

unsigned BxCan::pending() const {
  return static_cast<unsigned>(
      std::count_if(mailboxes_.begin(), mailboxes_.end(), [](const Mailbox& one) { return one.is_pending; }));
}

std::optional<unsigned> BxCan::first_pending() const {
  std::optional<unsigned> first;
  for (unsigned i = 0; i < mailboxes; ++i) {
    if (mailboxes_[i].is_pending && (!first || priority(mailboxes_[i]) < priority(mailboxes_[*first]))) {
      first = i;  // of equal identifiers, the lower mailbox number
    }
  }
  return first;
}

std::optional<unsigned> BxCan::last_pending() const {
  std::optional<unsigned> last;
  for (unsigned i = 0; i < mailboxes; ++i) {
    if (mailboxes_[i].is_pending && (!last || priority(mailboxes_[i]) >= priority(mailboxes_[*last]))) {
      last = i;
    }
  }
  return last;
}

CanFrame BxCan::frame_of(const Mailbox& mailbox) const {
  const std::uint32_t identifier = mailbox.words[0];
  CanFrame frame;
  frame.is_extended = (identifier & ide) != 0;
  frame.is_remote = (identifier & rtr) != 0;
  frame.id = frame.is_extended ? identifier >> 3 : identifier >> 21;
  frame.dlc = mailbox.words[1] & 15;
  for (unsigned i = 0; i < 8; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(mailbox.words[2 + i / 4] >> (8 * (i % 4)));
  }
  if (has(ttcm) && (mailbox.words[1] & tgt) != 0) {
    frame.data[6] = static_cast<std::uint8_t>(timer_ >> 8);
    frame.data[7] = static_cast<std::uint8_t>(timer_);
  }
  return frame;
}

std::optional<CanFrame> BxCan::next_frame() {
  const std::optional<unsigned> first = has(inrq) || has(sleep) ? std::nullopt : first_pending();
  if (!first) {
    return std::nullopt;
  }
  transmitting_ = first;
  return frame_of(mailboxes_[*first]);
}

void BxCan::on_start_of_frame(bool is_transmitter) {
  time_of_start_ = timer_;
  if (is_transmitter && has(ttcm)) {
    std::uint32_t& word = mailboxes_[*transmitting_].words[1];
    word = (word & 0xFFFF) | std::uint32_t{timer_} << 16;
  }
}

void BxCan::on_sent() {
  lec_ = 0;
  Mailbox& mailbox = mailboxes_[*transmitting_];
  transmitting_.reset();
  mailbox.is_pending = false;
  mailbox.is_aborting = false;
  mailbox.words[0] &= ~txrq;
  mailbox.status = rqcp | txok;
}

void BxCan::on_arbitration_lost() { end_attempt(alst); }

void BxCan::on_transmission_failed(CanError /*error*/) { end_attempt(terr); }

void BxCan::end_attempt(std::uint32_t cause) {
  Mailbox& mailbox = mailboxes_[*transmitting_];
  transmitting_.reset();
  mailbox.status = cause;
  if (has(nart) || mailbox.is_aborting) {
    abort(mailbox);
  }
}

// ---- Reception

void BxCan::on_received(const CanFrame& frame) {
  lec_ = 0;
  const BxCan& owner = has_filters() ? *this : *options_.master;
  if ((owner.fmr_ & finit) != 0) {
    return;
  }
  const unsigned split = owner.first_slave_bank();
  const std::optional<Match> found =
      has_filters() ? owner.match(frame, 0, split) : owner.match(frame, split, owner.options_.filter_banks);
  if (found) {
    store(frame, *found);
  }
}

void BxCan::store(const CanFrame& frame, const Match& match) {
  Fifo& fifo = fifos_[match.fifo];
  if (fifo.messages.size() == fifo_depth) {
    fifo.has_overrun = true;
    if (has(rflm)) {
      return;
    }
    fifo.messages.pop_back();
  }
  const std::uint32_t time = has(ttcm) ? std::uint32_t{time_of_start_} << 16 : 0;
  const std::uint32_t dlc = frame.is_remote ? 0U : frame.dlc;
  fifo.messages.push_back(
      {identifier_word(frame), time | match.index << 8 | dlc, data_word(frame, 0), data_word(frame, 4)});
  if (fifo.messages.size() == fifo_depth) {
    fifo.is_full = true;
  }
}

// ---- Filters

unsigned BxCan::first_slave_bank() const {
  if (options_.filter_banks < most_banks) {
    return options_.filter_banks;
  }
  return std::min((fmr_ & can2sb) >> 8, options_.filter_banks);
}

std::uint32_t* BxCan::filter_register(std::uint32_t offset) {
  if (!has_filters()) {
    return nullptr;
  }
  switch (offset) {
    case bxcan::fmr: return &fmr_;
    case bxcan::fm1r: return &fm1r_;
    case bxcan::fs1r: return &fs1r_;
    case bxcan::ffa1r: return &ffa1r_;
    case bxcan::fa1r: return &fa1r_;
    default: break;
  }
  if (offset < bxcan::f0r1 || offset >= bxcan::f0r1 + 8 * options_.filter_banks) {
    return nullptr;
  }
  return &banks_[(offset - bxcan::f0r1) / 8][offset / 4 % 2];
}

void BxCan::write_filter(std::uint32_t offset, std::uint32_t value) {
  const bool is_initializing = (fmr_ & finit) != 0;
  if (offset == bxcan::fmr) {
    write_fmr(value);
    return;
  }
  if (offset >= bxcan::f0r1) {
    const bool is_active = ((fa1r_ >> ((offset - bxcan::f0r1) / 8)) & 1) != 0;
    if (is_active && !is_initializing) {
      fault("write to the filter register of an active bank");
      return;
    }
    *filter_register(offset) = value;
    return;
  }
  if (!is_initializing && offset != bxcan::fa1r) {
    fault("write to FM1R, FS1R or FFA1R without FINIT");
    return;
  }
  if ((value & ~bank_mask()) != 0) {
    fault("bit of a filter bank that does not exist");
  }
  *filter_register(offset) = value & bank_mask();
}

void BxCan::write_fmr(std::uint32_t value) {
  const std::uint32_t bits = options_.filter_banks == most_banks ? finit | can2sb : finit;
  if (((value ^ fmr_at_reset) & ~bits) != 0) {
    fault("reserved bits of FMR do not have their reset value");
  }
  fmr_ = (fmr_at_reset & ~bits) | (value & bits);
}

// Returns the filter with the highest priority that accepts the frame, among banks first…last - 1.
std::optional<BxCan::Match> BxCan::match(const CanFrame& frame, unsigned first, unsigned last) const {
  std::array<unsigned, fifos> number{};  // of the next filter of each FIFO; inactive banks are counted, too
  std::optional<Match> best;
  for (unsigned bank = first; bank < last; ++bank) {
    const unsigned fifo = is_set(ffa1r_, bank) ? 1 : 0;
    const unsigned priority = (is_set(fs1r_, bank) ? 0U : 2U) + (is_set(fm1r_, bank) ? 0U : 1U);
    for (const bool accepts : filters_of(bank, frame)) {
      const unsigned index = number[fifo]++;
      if (accepts && is_set(fa1r_, bank) && (!best || priority < best->priority)) {
        best = Match{fifo, index, priority};
      }
    }
  }
  return best;
}

// Returns for each filter of a bank whether it accepts the frame.
std::vector<bool> BxCan::filters_of(unsigned bank, const CanFrame& frame) const {
  const std::uint32_t long_id = identifier_word(frame);
  const std::uint32_t short_id = short_identifier(frame);
  const auto [one, two] = banks_[bank];
  const auto masked = [](std::uint32_t id, std::uint32_t filter, std::uint32_t mask) {
    return ((id ^ filter) & mask) == 0;
  };
  const bool is_list = is_set(fm1r_, bank);
  if (is_set(fs1r_, bank)) {
    if (is_list) {
      return {long_id == (one & ~1U), long_id == (two & ~1U)};
    }
    return {masked(long_id, one, two & ~1U)};
  }
  if (is_list) {
    return {short_id == (one & 0xFFFF), short_id == one >> 16, short_id == (two & 0xFFFF), short_id == two >> 16};
  }
  return {masked(short_id, one & 0xFFFF, one >> 16), masked(short_id, two & 0xFFFF, two >> 16)};
}

}  // namespace test
