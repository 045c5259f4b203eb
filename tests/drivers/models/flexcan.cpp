// SPDX-License-Identifier: Apache-2.0
// Modes, registers and error states of the FlexCAN model; flexcan_mailboxes.cpp has its memory.
#include "flexcan.hpp"

#include <algorithm>

#include "flexcan_bits.hpp"

namespace test {

using namespace flexcan;

namespace {

constexpr std::uint32_t mcr_at_reset = frz | halt | supv | 0xF;
constexpr std::uint32_t mecr_at_reset = ecrwrdis | 0x000C0080;
constexpr std::uint32_t undefined = 0xA5A5A5A5;  // content of the memory after power-up
constexpr unsigned warning_limit = 96;
constexpr unsigned recovery_sequences = 128;
constexpr unsigned never = ~0U;
constexpr std::uint64_t wide_low = 0xFFFFFFFF;  // mailboxes 0…31

}  // namespace

FlexCan::Options FlexCan::imx6() { return {}; }

FlexCan::Options FlexCan::kinetis() {
  Options options;
  options.mailboxes = 16;
  options.is_disabled_at_reset = true;
  options.has_clock_source = true;
  return options;
}

FlexCan::Options FlexCan::imx8mp() {
  Options options;
  options.version = 3;
  options.is_disabled_at_reset = true;
  options.has_ecc = true;
  return options;
}

FlexCan::FlexCan(CanWire& wire, std::uintptr_t address, const Options& options)
    : RegisterModel(address, flexcan::size), wire_(wire), options_(options), node_(wire, *this, options.name) {
  mcr_ = mcr_at_reset | (options.is_disabled_at_reset ? mdis : 0);
  mode_ = options.is_disabled_at_reset ? Mode::disabled : Mode::freeze;
  masks_.fill(~0U);
  mecr_ = mecr_at_reset;
  memory_.fill(undefined);
}

// ---- Interrupt lines

bool FlexCan::mailbox_interrupt() const { return (iflag_ & imask_) != 0; }

bool FlexCan::bus_off_interrupt() const {
  return ((error_flags_ & boffint) != 0 && (ctrl1_ & boffmsk) != 0) ||
         ((error_flags_ & boffdoneint) != 0 && (ctrl2_ & boffdonemsk) != 0);
}

bool FlexCan::error_interrupt() const { return (error_flags_ & errint) != 0 && (ctrl1_ & errmsk) != 0; }

bool FlexCan::transmit_warning_interrupt() const { return (error_flags_ & twrnint) != 0 && (ctrl1_ & twrnmsk) != 0; }

bool FlexCan::receive_warning_interrupt() const { return (error_flags_ & rwrnint) != 0 && (ctrl1_ & rwrnmsk) != 0; }

bool FlexCan::interrupt() const {
  return mailbox_interrupt() || bus_off_interrupt() || error_interrupt() || transmit_warning_interrupt() ||
         receive_warning_interrupt();
}

// ---- Modes

bool FlexCan::is_freeze_requested() const { return has(frz) && has(halt); }

void FlexCan::on_bit(bool /*level*/) {
  if (is_reset_pending_) {
    soft_reset();
    return;
  }
  if (mode_ == Mode::normal) {
    ++timer_;
  }
  change_mode();
}

// Resets MCR, TIMER, ECR, ESR1, IMASK and IFLAG; keeps CTRL1, CTRL2, the masks and the memory.
// [MCR, field SOFTRST]
void FlexCan::soft_reset() {
  is_reset_pending_ = false;
  node_.reset();
  mcr_ = mcr_at_reset;
  mode_ = Mode::freeze;
  timer_ = 0;
  errors_ = 0;
  error_flags_ = 0;
  imask_ = 0;
  iflag_ = 0;
  was_bus_off_ = false;
  is_recovery_manual_ = false;
  had_tx_warning_ = false;
  had_rx_warning_ = false;
  fifo_.clear();
  locked_.reset();
  pending_.reset();
  transmitting_.reset();
  is_aborting_ = false;
}

// Acknowledges the requests of MCR when the activity on the bus is complete. [Freeze mode, Module Disable mode]
void FlexCan::change_mode() {
  const Mode wanted = has(mdis) ? Mode::disabled : is_freeze_requested() ? Mode::freeze : Mode::normal;
  if (wanted == mode_) {
    return;
  }
  if (mode_ == Mode::normal) {
    leave_normal(wanted);
  } else if (wanted == Mode::normal) {
    enter_normal();
  } else {
    mode_ = wanted;
  }
}

void FlexCan::leave_normal(Mode next) {
  if (!node_.is_busy()) {
    node_.stop();
    mode_ = next;
  }
}

void FlexCan::enter_normal() {
  check_configuration();
  mode_ = Mode::normal;
  if (!has_right_bit_rate()) {
    fault("bit rate " + std::to_string(bit_rate()) + " differs from that of the bus");
    return;
  }
  CanMode mode;
  mode.is_loopback = (ctrl1_ & lpb) != 0;
  mode.is_silent = mode.is_loopback;  // the Tx pin is recessive
  mode.is_listen_only = (ctrl1_ & lom) != 0;
  mode.fd = options_.version == 3 && (ctrl2_ & prexcen) != 0 ? FdMode::tolerant : FdMode::classic;
  node_.set_mode(mode);
  begin_recovery();
}

// Joins the bus, after bus-off only when 128 sequences are complete and BOFFREC permits it. [CTRL1, field BOFFREC]
void FlexCan::begin_recovery() {
  if (is_recovery_manual_) {
    node_.start(never);
  } else {
    node_.start(sequences_ < recovery_sequences ? recovery_sequences - sequences_ : 1);
  }
}

void FlexCan::on_recovery_sequence(unsigned /*sequences*/) {
  if (++sequences_ == recovery_sequences && options_.version == 3) {
    error_flags_ |= boffdoneint;
  }
}

// Checks at the end of Freeze mode what the manual requires of the configuration.
void FlexCan::check_configuration() {
  if (has(rfen) && first_mailbox() > (mcr_ & maxmb) + 1) {
    fault("CTRL2.RFFN: the filter table exceeds MCR.MAXMB");
  }
  if ((ctrl1_ & lpb) != 0 && (has(srxdis) || (ctrl1_ & lom) != 0)) {
    fault("CTRL1.LPB together with MCR.SRXDIS or CTRL1.LOM");
  }
  check_timing();
  check_memory();
}

void FlexCan::check_timing() {
  const Timing one = timing();
  const unsigned quanta = one.before_sample + one.after_sample;
  const unsigned most = (cbt_ & btf) != 0 ? 129 : 25;
  if (quanta < 8 || quanta > most || one.after_sample < 2 || one.jump > one.after_sample) {
    fault("bit timing that the CAN protocol does not allow");
  }
}

FlexCan::Timing FlexCan::timing() const {
  if ((cbt_ & btf) != 0) {
    return {(cbt_ >> 21 & 0x3FF) + 1, 3 + (cbt_ >> 10 & 0x3F) + (cbt_ >> 5 & 0x1F), (cbt_ & 0x1F) + 1,
            (cbt_ >> 16 & 0x1F) + 1};
  }
  return {(ctrl1_ >> 24) + 1, 3 + (ctrl1_ & 7) + (ctrl1_ >> 19 & 7), (ctrl1_ >> 16 & 7) + 1, (ctrl1_ >> 22 & 3) + 1};
}

std::uint32_t FlexCan::bit_rate() const {
  const Timing one = timing();
  return options_.clock / one.prescaler / (one.before_sample + one.after_sample);
}

unsigned FlexCan::sample_point() const {
  const Timing one = timing();
  return 1000 * one.before_sample / (one.before_sample + one.after_sample);
}

bool FlexCan::has_right_bit_rate() const {
  return options_.clock == 0 || wire_.bit_rate == 0 || bit_rate() == wire_.bit_rate;
}

// ---- Errors

void FlexCan::on_error(CanError error) {
  std::uint32_t bit = 0;
  switch (error) {
    case CanError::stuff: bit = 1U << 10; break;
    case CanError::form: bit = 1U << 11; break;
    case CanError::crc: bit = 1U << 12; break;
    case CanError::ack: bit = 1U << 13; break;
    case CanError::bit0: bit = 1U << 14; break;
    case CanError::bit1: bit = 1U << 15; break;
    case CanError::none: return;
  }
  if (errors_ != 0 && options_.version == 3) {
    error_flags_ |= errovr;
  }
  errors_ |= bit;
  error_flags_ |= errint;
}

void FlexCan::on_counters() {
  const bool is_bus_off = node_.is_bus_off();
  if (is_bus_off && !was_bus_off_) {
    error_flags_ |= boffint;
    sequences_ = 0;
    is_recovery_manual_ = (ctrl1_ & boffrec) != 0;
    begin_recovery();
  }
  was_bus_off_ = is_bus_off;
  const bool has_tx_warning = node_.tec() >= warning_limit;
  const bool has_rx_warning = node_.rec() >= warning_limit;
  if (has(wrnen)) {
    error_flags_ |= has_tx_warning && !had_tx_warning_ ? twrnint : 0;
    error_flags_ |= has_rx_warning && !had_rx_warning_ ? rwrnint : 0;
  }
  had_tx_warning_ = has_tx_warning;
  had_rx_warning_ = has_rx_warning;
}

// ---- Reading registers

// Returns false, and records a fault, if the manual forbids the access in the present mode.
bool FlexCan::is_accessible(std::uint32_t offset, bool is_write) {
  if (offset == flexcan::mcr) {
    return true;
  }
  if (is_reset_pending_) {
    fault("access before MCR.SOFTRST is cleared");
    return false;
  }
  const bool needs_clock = (offset >= flexcan::rxmgmask && offset <= flexcan::rx15mask) ||
                           offset == flexcan::rxfgmask || offset == flexcan::rxfir ||
                           (offset >= flexcan::mailbox && offset < flexcan::memory_end);
  if (mode_ == Mode::disabled && needs_clock) {
    fault("access to memory or masks in Disable mode");
    return false;
  }
  if (is_write && mode_ == Mode::normal && (has(mdis) || is_freeze_requested())) {
    fault("write before a requested mode is acknowledged by FRZACK or LPMACK");
    return false;
  }
  if (is_reserved(offset)) {
    fault("access to a reserved offset");
    return false;
  }
  return true;
}

bool FlexCan::is_reserved(std::uint32_t offset) const {
  switch (offset) {
    case flexcan::ctrl1:
    case flexcan::timer:
    case flexcan::rxmgmask:
    case flexcan::rx14mask:
    case flexcan::rx15mask:
    case flexcan::ecr:
    case flexcan::esr1:
    case flexcan::imask1:
    case flexcan::iflag1:
    case flexcan::ctrl2:
    case flexcan::esr2:
    case flexcan::crcr:
    case flexcan::rxfgmask:
    case flexcan::rxfir: return false;
    case flexcan::imask2:
    case flexcan::iflag2: return options_.mailboxes <= 32;
    case flexcan::cbt: return options_.version < 3;
    case flexcan::gfwr: return !options_.has_ecc && options_.mailboxes < 64;
    default: break;
  }
  if (offset >= flexcan::mailbox && offset < flexcan::memory_end) {
    return !options_.has_ecc && !is_mailbox_word(offset) && !is_mask_word(offset);
  }
  return !(options_.has_ecc && offset >= flexcan::mecr && offset < flexcan::mecr + 0x20);
}

// Returns the register at the offset if a read of it has no effect.
std::uint32_t* FlexCan::plain_register(std::uint32_t offset) {
  switch (offset) {
    case flexcan::ctrl1: return &ctrl1_;
    case flexcan::ctrl2: return &ctrl2_;
    case flexcan::rxmgmask: return &masks_[0];
    case flexcan::rx14mask: return &masks_[1];
    case flexcan::rx15mask: return &masks_[2];
    case flexcan::rxfgmask: return &masks_[3];
    case flexcan::cbt: return &cbt_;
    case flexcan::mecr: return &mecr_;
    case flexcan::gfwr: return options_.has_ecc ? nullptr : &gfwr_;
    default: return nullptr;
  }
}

std::uint32_t FlexCan::read_register(std::uint32_t offset) {
  if (!is_accessible(offset, false)) {
    return 0;
  }
  if (const std::uint32_t* const plain = plain_register(offset)) {
    return *plain;
  }
  switch (offset) {
    case flexcan::mcr: return read_mcr();
    case flexcan::timer: return read_timer();
    case flexcan::ecr: return read_ecr();
    case flexcan::esr1: return read_esr1();
    case flexcan::imask1: return static_cast<std::uint32_t>(imask_);
    case flexcan::imask2: return static_cast<std::uint32_t>(imask_ >> 32);
    case flexcan::iflag1: return static_cast<std::uint32_t>(iflag_);
    case flexcan::iflag2: return static_cast<std::uint32_t>(iflag_ >> 32);
    case flexcan::rxfir: return read_rxfir();
    case flexcan::esr2:
    case flexcan::crcr: fault("ESR2 and CRCR are not modelled"); return 0;
    default: break;
  }
  return offset < flexcan::memory_end ? read_memory(offset) : 0;
}

std::uint32_t FlexCan::read_mcr() const {
  std::uint32_t value = mcr_ | (is_reset_pending_ ? softrst : 0);
  switch (mode_) {
    case Mode::normal: break;
    case Mode::freeze: value |= notrdy | frzack; break;
    case Mode::disabled: value |= notrdy | lpmack; break;
  }
  return value;
}

// Releases the locked mailbox. [Mailbox lock mechanism]
std::uint32_t FlexCan::read_timer() {
  unlock();
  return timer_;
}

// In bus-off, TXERRCNT counts the sequences of 11 recessive bits. [ECR]
std::uint32_t FlexCan::read_ecr() const {
  const unsigned tec = node_.is_bus_off() ? std::min(sequences_, recovery_sequences) : node_.tec();
  return std::min(tec, 255U) | node_.rec() << 8;
}

// Clears the error bits 15…10. [register ESR1]
std::uint32_t FlexCan::read_esr1() {
  std::uint32_t value = errors_ | error_flags_;
  errors_ = 0;
  value |= node_.tec() >= warning_limit ? txwrn : 0;
  value |= node_.rec() >= warning_limit ? rxwrn : 0;
  if (node_.is_bus_off()) {
    value |= fltconf_bus_off;
  } else if (node_.is_error_passive()) {
    value |= fltconf_passive;
  }
  if (mode_ != Mode::normal) {
    return value;
  }
  value |= node_.is_on_bus() ? synch : 0;
  value |= node_.state() == CanNode::State::idle ? flexcan::idle : 0;
  if (node_.is_busy()) {
    value |= node_.is_transmitter() ? tx : rx;
  }
  return value;
}

std::uint32_t FlexCan::read_rxfir() {
  if (!has(rfen) || fifo_.empty()) {
    fault("RXFIR is read while no message is available in the Rx FIFO");
    return 0x1FF;
  }
  return fifo_.front().filter;
}

// ---- Writing registers

void FlexCan::write_register(std::uint32_t offset, std::uint32_t value) {
  if (!is_accessible(offset, true)) {
    return;
  }
  const std::uint64_t wide = value;
  switch (offset) {
    case flexcan::mcr: write_mcr(value); return;
    case flexcan::ctrl1: write_ctrl1(value); return;
    case flexcan::ctrl2: write_ctrl2(value); return;
    case flexcan::timer: timer_ = static_cast<std::uint16_t>(value); return;
    case flexcan::ecr: write_ecr(value); return;
    case flexcan::esr1: error_flags_ &= ~value; return;
    case flexcan::imask1: imask_ = (imask_ & ~wide_low) | wide; return;
    case flexcan::imask2: imask_ = (imask_ & wide_low) | wide << 32; return;
    case flexcan::iflag1: write_iflag1(value); return;
    case flexcan::iflag2: iflag_ &= ~(wide << 32); return;
    case flexcan::cbt: cbt_ = guarded("CBT", cbt_, value, ~0U); return;
    case flexcan::mecr: write_mecr(value); return;
    case flexcan::esr2:
    case flexcan::crcr:
    case flexcan::rxfir: fault("write to a read-only register"); return;
    default: break;
  }
  if (plain_register(offset) != nullptr) {
    write_mask(offset, value);
  } else if (offset < flexcan::memory_end) {
    write_memory(offset, value);
  }
}

// Returns the new value of a register, in which fields change outside of Freeze mode only if they are not protected.
std::uint32_t FlexCan::guarded(const char* name, std::uint32_t old, std::uint32_t value, std::uint32_t freeze_only) {
  if (mode_ == Mode::freeze || ((old ^ value) & freeze_only) == 0) {
    return value;
  }
  fault(std::string(name) + ": change of a field outside of Freeze mode");
  return (value & ~freeze_only) | (old & freeze_only);
}

void FlexCan::check_reserved(const char* name, std::uint32_t value, std::uint32_t bits) {
  if ((value & ~bits) != 0) {
    fault(std::string(name) + ": a bit is set that is reserved or not modelled");
  }
}

void FlexCan::write_mcr(std::uint32_t value) {
  check_reserved("MCR", value, mcr_bits);
  if ((value & softrst) != 0) {
    if (mode_ == Mode::disabled || has(mdis)) {
      fault("MCR.SOFTRST in a low-power mode");
    } else {
      is_reset_pending_ = true;
    }
    return;
  }
  const std::uint32_t old = mcr_;
  mcr_ = guarded("MCR", old, value & mcr_bits & ~mcr_status, mcr_freeze_only);
  check_mcr(old);
  if (((old ^ mcr_) & rfen) != 0) {
    fifo_.clear();
  }
}

// Checks the fields of MCR that were changed.
void FlexCan::check_mcr(std::uint32_t old) {
  if ((mcr_ & maxmb) >= options_.mailboxes) {
    fault("MCR.MAXMB: the mailbox does not exist");
  }
  if (((old ^ mcr_) & rfen) == 0) {
    return;
  }
  constexpr std::uint64_t fifo_flags = fifo_available | fifo_warning | fifo_overflow;
  const unsigned end = 8 + 2 * (ctrl2_ >> 24 & 15);
  const std::uint64_t region = has(rfen) ? (std::uint64_t{1} << end) - 1 : fifo_flags;
  if ((iflag_ & region) != 0) {
    fault("MCR.RFEN is changed while IFLAG has flags of the region of the Rx FIFO");
  }
}

void FlexCan::write_ctrl1(std::uint32_t value) {
  check_reserved("CTRL1", value, ctrl1_bits | (options_.has_clock_source ? clksrc : 0));
  if (((value ^ ctrl1_) & clksrc) != 0 && mode_ != Mode::disabled) {
    fault("CTRL1.CLKSRC is changed outside of Disable mode");
    value ^= clksrc;
  }
  if ((value & (twrnmsk | rwrnmsk)) != 0 && !has(wrnen)) {
    fault("CTRL1.TWRNMSK or RWRNMSK without MCR.WRNEN");
    value &= ~(twrnmsk | rwrnmsk);
  }
  value = guarded("CTRL1", ctrl1_, value, ctrl1_freeze_only);
  const bool is_released = is_recovery_manual_ && (value & boffrec) == 0;
  ctrl1_ = value & (ctrl1_bits | clksrc);
  if (is_released) {
    is_recovery_manual_ = false;
    if (mode_ == Mode::normal && node_.is_bus_off()) {
      begin_recovery();
    }
  }
}

void FlexCan::write_ctrl2(std::uint32_t value) {
  const std::uint32_t more = ctrl2_freeze_only_3 | boffdonemsk | (options_.has_ecc ? ecrwre : 0);
  const std::uint32_t bits = ctrl2_freeze_only | (options_.version == 3 ? more : 0);
  check_reserved("CTRL2", value, bits);
  if ((value & ~ctrl2_ & wrmfrz) != 0 && !options_.has_ecc) {
    fault("CTRL2.WRMFRZ: all memory is accessible without it");
  }
  ctrl2_ = guarded("CTRL2", ctrl2_, value & bits, ctrl2_freeze_only | ctrl2_freeze_only_3);
}

void FlexCan::write_ecr(std::uint32_t value) {
  if (mode_ != Mode::freeze) {
    fault("write to ECR outside of Freeze mode");
    return;
  }
  check_reserved("ECR", value, 0xFFFF);
  node_.set_counters(value & 0xFF, value >> 8 & 0xFF);
}

// Writes RXMGMASK, RX14MASK, RX15MASK, RXFGMASK or GFWR.
void FlexCan::write_mask(std::uint32_t offset, std::uint32_t value) {
  if (mode_ != Mode::freeze) {
    fault("write to a mask register or GFWR outside of Freeze mode");
    return;
  }
  *plain_register(offset) = value;
}

void FlexCan::write_iflag1(std::uint32_t value) {
  iflag_ &= ~std::uint64_t{value};
  if (!has(rfen)) {
    return;
  }
  if ((value & fifo_clear) != 0) {
    if (mode_ != Mode::freeze) {
      fault("the Rx FIFO is cleared outside of Freeze mode");
      return;
    }
    fifo_.clear();
    show_first_message();
  } else if ((value & fifo_available) != 0 && !fifo_.empty()) {
    pop();
  }
}

void FlexCan::write_mecr(std::uint32_t value) {
  if ((ctrl2_ & ecrwre) == 0) {
    fault("write to MECR without CTRL2.ECRWRE");
    return;
  }
  if ((mecr_ & ecrwrdis) != 0) {
    if (((value ^ mecr_) & ~ecrwrdis) != 0) {
      fault("change of a field of MECR before ECRWRDIS is cleared");
    }
    mecr_ = (mecr_ & ~ecrwrdis) | (value & ecrwrdis);
    return;
  }
  mecr_ = value;
}

}  // namespace test
