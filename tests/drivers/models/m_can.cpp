// SPDX-License-Identifier: Apache-2.0
// Class MCan: registers, modes, errors and interrupts.
#include "m_can.hpp"

#include <algorithm>

namespace test {
namespace {

using Register = MCanRegister;

// CCCR
constexpr std::uint32_t init = 1U << 0;
constexpr std::uint32_t cce = 1U << 1;
constexpr std::uint32_t restricted = 1U << 2;  // ASM
constexpr std::uint32_t csa = 1U << 3;
constexpr std::uint32_t csr = 1U << 4;
constexpr std::uint32_t mon = 1U << 5;
constexpr std::uint32_t test_enable = 1U << 7;
constexpr std::uint32_t fdoe = 1U << 8;
constexpr std::uint32_t pxhd = 1U << 12;
constexpr std::uint32_t txp = 1U << 14;
constexpr std::uint32_t niso = 1U << 15;
constexpr std::uint32_t cccr_bits = 0x0000F3FF;
constexpr std::uint32_t protected_modes = 0x0000F340;                          // DAR, FDOE, BRSE, PXHD, EFBI, TXP, NISO
constexpr std::uint32_t set_protected_modes = restricted | mon | test_enable;  // can be reset at any time

// TEST
constexpr std::uint32_t lbck = 1U << 4;
constexpr std::uint32_t rx_pin = 1U << 7;

// PSR
constexpr std::uint32_t ep = 1U << 5;
constexpr std::uint32_t ew = 1U << 6;
constexpr std::uint32_t bo = 1U << 7;
constexpr std::uint32_t resi = 1U << 11;
constexpr std::uint32_t rbrs = 1U << 12;
constexpr std::uint32_t rfdf = 1U << 13;
constexpr std::uint32_t pxe = 1U << 14;

constexpr std::uint32_t no_change = 7;  // LEC, DLEC after a read of PSR
constexpr std::uint32_t no_register = ~0U;
constexpr unsigned recovery_sequences = 129;

struct Offsets {
  Register which;
  std::uint32_t fixed;
  std::uint32_t configurable;
};

constexpr std::array<Offsets, static_cast<std::size_t>(Register::count)> offsets = {{
    {Register::crel, 0x00, 0x00},         {Register::endn, 0x04, 0x04},          {Register::dbtp, 0x0C, 0x0C},
    {Register::test, 0x10, 0x10},         {Register::rwd, 0x14, 0x14},           {Register::cccr, 0x18, 0x18},
    {Register::nbtp, 0x1C, 0x1C},         {Register::tscc, 0x20, 0x20},          {Register::tscv, 0x24, 0x24},
    {Register::tocc, 0x28, 0x28},         {Register::tocv, 0x2C, 0x2C},          {Register::ecr, 0x40, 0x40},
    {Register::psr, 0x44, 0x44},          {Register::tdcr, 0x48, 0x48},          {Register::ir, 0x50, 0x50},
    {Register::ie, 0x54, 0x54},           {Register::ils, 0x58, 0x58},           {Register::ile, 0x5C, 0x5C},
    {Register::gfc, 0x80, 0x80},          {Register::xidam, 0x84, 0x90},         {Register::hpms, 0x88, 0x94},
    {Register::rxf0s, 0x90, 0xA4},        {Register::rxf0a, 0x94, 0xA8},         {Register::rxf1s, 0x98, 0xB4},
    {Register::rxf1a, 0x9C, 0xB8},        {Register::txbc, 0xC0, 0xC0},          {Register::txfqs, 0xC4, 0xC4},
    {Register::txbrp, 0xC8, 0xCC},        {Register::txbar, 0xCC, 0xD0},         {Register::txbcr, 0xD0, 0xD4},
    {Register::txbto, 0xD4, 0xD8},        {Register::txbcf, 0xD8, 0xDC},         {Register::txbtie, 0xDC, 0xE0},
    {Register::txbcie, 0xE0, 0xE4},       {Register::txefs, 0xE4, 0xF4},         {Register::txefa, 0xE8, 0xF8},
    {Register::sidfc, no_register, 0x84}, {Register::xidfc, no_register, 0x88},  {Register::ndat1, no_register, 0x98},
    {Register::ndat2, no_register, 0x9C}, {Register::rxf0c, no_register, 0xA0},  {Register::rxbc, no_register, 0xAC},
    {Register::rxf1c, no_register, 0xB0}, {Register::rxesc, no_register, 0xBC},  {Register::txesc, no_register, 0xC8},
    {Register::txefc, no_register, 0xF0}, {Register::ckdiv, 0x100, no_register},
}};

// Returns the bit of a flag in IR of the fixed layout, which has no watermarks, no Rx buffers and no ECC.
unsigned fixed_bit(MCanFlag flag) {
  switch (flag) {
    case MCanFlag::rf0n: return 0;
    case MCanFlag::rf0f: return 1;
    case MCanFlag::rf0l: return 2;
    case MCanFlag::rf1n: return 3;
    case MCanFlag::rf1f: return 4;
    case MCanFlag::rf1l: return 5;
    case MCanFlag::hpm: return 6;
    case MCanFlag::tc: return 7;
    case MCanFlag::tcf: return 8;
    case MCanFlag::tfe: return 9;
    case MCanFlag::tefn: return 10;
    case MCanFlag::teff: return 11;
    case MCanFlag::tefl: return 12;
    case MCanFlag::tsw: return 13;
    case MCanFlag::too: return 15;
    case MCanFlag::elo: return 16;
    case MCanFlag::ep: return 17;
    case MCanFlag::ew: return 18;
    case MCanFlag::bo: return 19;
    case MCanFlag::pea: return 21;
    case MCanFlag::ara: return 23;
    default: return 32;
  }
}

// Returns the flags of IR of the fixed layout that are on interrupt line 1, for a value of ILS.
std::uint32_t fixed_line_1(std::uint32_t ils) {
  // RXFIFO0, RXFIFO1, SMSG, TFERR, MISC, BERR, PERR
  constexpr std::array<std::uint32_t, 7> groups = {0x000007, 0x000038, 0x0001C0, 0x001E00,
                                                   0x00E000, 0x030000, 0xFC0000};
  std::uint32_t flags = 0;
  for (unsigned i = 0; i < groups.size(); ++i) {
    flags |= ((ils >> i) & 1) != 0 ? groups[i] : 0;
  }
  return flags;
}

}  // namespace

MCan::MCan(CanWire& wire, std::uintptr_t address, MessageRam& ram, const Options& options)
    : RegisterModel(address, 0x400), wire_(wire), ram_(ram), options_(options), node_(wire, *this, options.name) {
  ram_.controllers_.push_back(this);
  set_reset_values();
}

MCan::~MCan() { ram_.controllers_.erase(std::find(ram_.controllers_.begin(), ram_.controllers_.end(), this)); }

std::uint32_t MCan::offset_of(MCanLayout layout, Register which) {
  const Offsets& found = offsets[static_cast<std::size_t>(which)];
  return layout == MCanLayout::fixed ? found.fixed : found.configurable;
}

std::uint32_t MCan::bit_of(MCanLayout layout, Flag flag) {
  const unsigned bit = layout == MCanLayout::fixed ? fixed_bit(flag) : static_cast<unsigned>(flag);
  return bit < 32 ? 1U << bit : 0;
}

std::optional<Register> MCan::register_at(std::uint32_t offset) const {
  for (const Offsets& one : offsets) {
    if ((is_fixed() ? one.fixed : one.configurable) == offset) {
      return one.which;
    }
  }
  return std::nullopt;
}

void MCan::set_reset_values() {
  value(Register::crel) = 0x32141218;
  value(Register::endn) = 0x87654321;
  value(Register::dbtp) = 0x00000A33;
  value(Register::cccr) = init;
  value(Register::nbtp) = 0x06000A03;
  value(Register::tocc) = 0xFFFF0000;
  value(Register::tocv) = 0x0000FFFF;
  value(Register::xidam) = 0x1FFFFFFF;
}

// ---- Interrupts

void MCan::raise(Flag flag) { flags_ |= bit_of(options_.layout, flag); }

bool MCan::interrupt(unsigned line) const {
  const std::uint32_t pending = flags_ & value(Register::ie);
  const std::uint32_t on_line_1 = is_fixed() ? fixed_line_1(value(Register::ils)) : value(Register::ils);
  const std::uint32_t on_line = line == 0 ? ~on_line_1 : on_line_1;
  return (pending & on_line) != 0 && ((value(Register::ile) >> line) & 1) != 0;
}

// ---- Access

void MCan::before_access() {
  wire_.count_access();
  if (requested_initialization_ && accesses_to_acceptance_-- == 0) {
    accept_initialization();
  }
}

std::uint32_t MCan::read_register(std::uint32_t offset) {
  const std::optional<Register> which = register_at(offset);
  if (!which) {
    raise(Flag::ara);
    fault("read of a reserved offset");
    return 0;
  }
  return read_status(*which);
}

std::uint32_t MCan::read_status(Register which) {
  switch (which) {
    case Register::test: return read_test();
    case Register::tscv: return timestamp_;
    case Register::ecr: return read_ecr();
    case Register::psr: return read_psr();
    case Register::ir: return flags_;
    case Register::rxf0s: return read_rx_status(0);
    case Register::rxf1s: return read_rx_status(1);
    case Register::txfqs: return read_txfqs();
    case Register::txbcr: return cancelling_;
    case Register::txefs: return read_txefs();
    default: return value(which);
  }
}

bool MCan::is_initializing() const { return (value(Register::cccr) & init) != 0; }

bool MCan::is_configurable() const { return (value(Register::cccr) & (init | cce)) == (init | cce); }

// Returns whether a register is writable only while CCCR.INIT and CCCR.CCE are set.
bool MCan::is_protected(Register which) const {
  switch (which) {
    case Register::dbtp:
    case Register::rwd:
    case Register::nbtp:
    case Register::tscc:
    case Register::tocc:
    case Register::tdcr:
    case Register::gfc:
    case Register::xidam:
    case Register::txbc:
    case Register::sidfc:
    case Register::xidfc:
    case Register::rxf0c:
    case Register::rxbc:
    case Register::rxf1c:
    case Register::rxesc:
    case Register::txesc:
    case Register::txefc:
    case Register::ckdiv: return true;
    default: return false;
  }
}

std::uint32_t MCan::writable_bits(Register which) const {
  switch (which) {
    case Register::dbtp: return 0x009F1FFF;
    case Register::rwd: return 0x000000FF;
    case Register::nbtp: return 0xFFFFFF7F;
    case Register::tscc: return 0x000F0003;
    case Register::tocc: return 0xFFFF0007;
    case Register::tocv: return 0x0000FFFF;
    case Register::tdcr: return 0x00007F7F;
    case Register::ie: return is_fixed() ? 0x00FFFFFF : 0x3FFFFFFF;
    case Register::ils: return is_fixed() ? 0x0000007F : 0x3FFFFFFF;
    case Register::ile: return 0x00000003;
    case Register::gfc: return is_fixed() ? 0x0F1F033F : 0x0000003F;
    case Register::xidam: return 0x1FFFFFFF;
    case Register::txbc: return is_fixed() ? 0x01000000 : 0x7F3FFFFC;
    case Register::txbtie:
    case Register::txbcie: return is_fixed() ? 0x00000007 : 0xFFFFFFFF;
    case Register::sidfc: return 0x00FFFFFC;
    case Register::xidfc: return 0x007FFFFC;
    case Register::rxf0c:
    case Register::rxf1c: return 0xFF7FFFFC;
    case Register::rxbc: return 0x0000FFFC;
    case Register::rxesc: return 0x00000777;
    case Register::txesc: return 0x00000007;
    case Register::txefc: return 0x3F3FFFFC;
    case Register::ckdiv: return 0x0000000F;
    default: return 0;  // read-only
  }
}

void MCan::write_register(std::uint32_t offset, std::uint32_t written) {
  const std::optional<Register> which = register_at(offset);
  if (!which) {
    raise(Flag::ara);
    fault("write to a reserved offset");
    return;
  }
  switch (*which) {
    case Register::cccr: write_cccr(written); return;
    case Register::test: write_test(written); return;
    case Register::tscv: timestamp_ = 0; return;
    case Register::ir: flags_ &= ~written; return;
    case Register::rxf0a: acknowledge(0, written); return;
    case Register::rxf1a: acknowledge(1, written); return;
    case Register::txbar: request(written); return;
    case Register::txbcr: cancel(written); return;
    case Register::txefa: acknowledge_event(written); return;
    case Register::ndat1:
    case Register::ndat2: value(*which) &= ~written; return;
    default: write_value(*which, written); return;
  }
}

void MCan::write_value(Register which, std::uint32_t written) {
  const std::uint32_t bits = writable_bits(which);
  if (bits == 0) {
    fault("write to a read-only register");
    return;
  }
  if (is_protected(which) && !is_configurable()) {
    fault("write to a protected register without CCCR.INIT and CCCR.CCE");
    return;
  }
  if ((written & ~bits) != 0) {
    fault("reserved bit set");
  }
  value(which) = written & bits;
  if (which == Register::tscc && (written & 3) == 2) {
    fault("an external timestamp counter is not modelled");
  }
}

// ---- CCCR

void MCan::write_cccr(std::uint32_t written) {
  if ((written & ~cccr_bits) != 0) {
    fault("reserved bit set in CCCR");
  }
  const std::uint32_t before = value(Register::cccr);
  std::uint32_t after = accepted_modes(written) | (written & csr);
  after |= before & (init | cce | csa);
  if ((written & csr) == 0) {
    after &= ~csa;
  }
  if ((written & cce) != 0 && (before & init) == 0) {
    fault("CCCR.CCE set while CCCR.INIT reads 0");
  } else if ((before & init) != 0) {
    after = (after & ~cce) | (written & cce);
  }
  value(Register::cccr) = after;
  if ((after & cce) != 0 && (before & cce) == 0) {
    reset_status();
  }
  if ((after & test_enable) == 0) {
    value(Register::test) = 0;
  }
  update_mode();
  request_initialization((written & init) != 0);
}

// Returns the mode bits that CCCR has after a write, and records faults for those that are protected.
std::uint32_t MCan::accepted_modes(std::uint32_t written) {
  const std::uint32_t before = value(Register::cccr);
  const std::uint32_t modes = protected_modes | set_protected_modes;
  const bool sets = (written & ~before & set_protected_modes) != 0;
  const bool changes = ((written ^ before) & protected_modes) != 0;
  if ((sets || changes) && !is_configurable()) {
    fault("mode bit of CCCR changed without CCCR.INIT and CCCR.CCE");
    return (before & protected_modes) | (before & written & set_protected_modes);
  }
  if ((written & restricted) != 0) {
    fault("the restricted operation mode is not modelled");
  }
  if ((written & niso) != 0) {
    fault("the non-ISO format of CAN FD is not modelled");
  }
  return written & modes;
}

void MCan::request_initialization(bool is_requested) {
  if (requested_initialization_ && *requested_initialization_ != is_requested) {
    fault("CCCR.INIT written before the previous value was accepted");
  }
  requested_initialization_.reset();
  if (is_requested == is_initializing()) {
    return;
  }
  requested_initialization_ = is_requested;
  accesses_to_acceptance_ = initialization_accesses;
  if (initialization_accesses == 0) {
    accept_initialization();
  }
}

void MCan::accept_initialization() {
  const bool is_set = *requested_initialization_;
  requested_initialization_.reset();
  set_initialization(is_set);
}

// Stops the transfer at once, or begins to wait for 11 recessive bits.
void MCan::set_initialization(bool is_set) {
  if (is_set) {
    value(Register::cccr) |= init;
    node_.stop();
    transmitting_.reset();
    if (cancelling_ != 0) {
      cancel(cancelling_);
    }
    return;
  }
  value(Register::cccr) &= ~(init | cce);
  check_sections();
  if (has_right_bit_rate()) {
    recovery_ = 0;
    update_mode();
    node_.start(recovery_sequences);
  }
}

void MCan::reset_status() {
  value(Register::hpms) = 0;
  value(Register::txbrp) = 0;
  value(Register::txbto) = 0;
  value(Register::txbcf) = 0;
  value(Register::tocv) = field(Register::tocc, 16, 0xFFFF);
  fifos_ = {};
  events_ = {};
  fifo_get_ = 0;
  fifo_fill_ = 0;
  cancelling_ = 0;
}

bool MCan::has_right_bit_rate() {
  if (field(Register::nbtp, 8, 0xFF) == 0 || field(Register::nbtp, 0, 0x7F) == 0) {
    fault("NBTP has a time segment below its minimum");
    return false;
  }
  if (options_.clock != 0 && wire_.bit_rate != 0 && bit_rate() != wire_.bit_rate) {
    fault("bit rate " + std::to_string(bit_rate()) + " differs from that of the bus");
    return false;
  }
  return true;
}

std::uint32_t MCan::bit_rate() const {
  const std::uint32_t divider = value(Register::ckdiv) == 0 ? 1 : 2 * value(Register::ckdiv);
  const std::uint32_t quanta = 3 + field(Register::nbtp, 8, 0xFF) + field(Register::nbtp, 0, 0x7F);
  return options_.clock / divider / (field(Register::nbtp, 16, 0x1FF) + 1) / quanta;
}

unsigned MCan::sample_point() const {
  const unsigned before = 2 + field(Register::nbtp, 8, 0xFF);
  return 1000 * before / (before + 1 + field(Register::nbtp, 0, 0x7F));
}

void MCan::update_mode() {
  const std::uint32_t cccr = value(Register::cccr);
  CanMode mode;
  mode.is_loopback = (value(Register::test) & lbck) != 0;
  mode.is_silent = (cccr & mon) != 0;
  mode.pauses = (cccr & txp) != 0;
  mode.exception_is_error = (cccr & pxhd) != 0;
  mode.fd = (cccr & fdoe) != 0 ? FdMode::enabled : FdMode::classic;
  node_.set_mode(mode);
  if (mode.is_silent && !mode.is_loopback) {
    value(Register::txbrp) = 0;  // bus monitoring mode
    fifo_fill_ = 0;
  }
}

std::uint32_t MCan::read_test() const { return value(Register::test) | (wire_.level() == recessive ? rx_pin : 0); }

void MCan::write_test(std::uint32_t written) {
  if ((value(Register::cccr) & test_enable) == 0) {
    fault("write to TEST without CCCR.TEST");
    return;
  }
  if ((written & ~(lbck | rx_pin)) != 0) {
    fault("reserved bit of TEST, or control of the transmit pin, which is not modelled");
  }
  value(Register::test) = written & lbck;
  update_mode();
}

// Acknowledges a clock stop request when no transmission is pending and the bus is idle.
void MCan::stop_clock() {
  const std::uint32_t cccr = value(Register::cccr);
  if ((cccr & csr) == 0 || (cccr & csa) != 0) {
    return;
  }
  const bool is_idle = is_initializing() || (value(Register::txbrp) == 0 && node_.state() == CanNode::State::idle);
  if (is_idle) {
    set_initialization(true);
    value(Register::cccr) |= csa;
  }
}

// ---- Errors

std::uint32_t MCan::read_ecr() {
  constexpr unsigned rec_limit = 127;
  const std::uint32_t log = error_log_;
  error_log_ = 0;
  const unsigned counted = node_.is_bus_off() ? recovery_ : node_.rec();
  const std::uint32_t rp = counted > rec_limit ? 1U << 15 : 0;
  return log << 16 | rp | std::min(counted, rec_limit) << 8 | std::min(node_.tec(), 255U);
}

std::uint32_t MCan::read_psr() {
  std::uint32_t result = lec_ | no_change << 8 | psr_at_read_;
  result |= node_.is_error_passive() ? ep : 0;
  result |= is_warning_ ? ew : 0;
  result |= node_.is_bus_off() ? bo : 0;
  std::uint32_t activity = 0;  // synchronizing
  if (node_.is_transmitter()) {
    activity = 3;
  } else if (node_.is_busy()) {
    activity = 2;
  } else if (node_.is_on_bus()) {
    activity = 1;
  }
  lec_ = no_change;
  psr_at_read_ = 0;
  return result | activity << 3;
}

void MCan::on_error(CanError error) {
  constexpr unsigned log_limit = 255;
  lec_ = static_cast<std::uint32_t>(error);
  raise(Flag::pea);
  if (error_log_ == log_limit) {
    raise(Flag::elo);
  } else {
    ++error_log_;
  }
}

// Raises a flag for each change of error passive, warning and bus-off. Bus-off sets CCCR.INIT.
void MCan::on_counters() {
  constexpr unsigned warning_limit = 96;
  const bool is_warning = node_.tec() >= warning_limit || node_.rec() >= warning_limit;
  if (node_.is_error_passive() != is_passive_) {
    raise(Flag::ep);
  }
  if (is_warning != is_warning_) {
    raise(Flag::ew);
  }
  is_passive_ = node_.is_error_passive();
  is_warning_ = is_warning;
  if (node_.is_bus_off() == is_bus_off_) {
    return;
  }
  raise(Flag::bo);
  is_bus_off_ = node_.is_bus_off();
  if (is_bus_off_) {
    requested_initialization_.reset();
    set_initialization(true);
  }
}

void MCan::on_recovery_sequence(unsigned sequences) {
  recovery_ = sequences;
  lec_ = static_cast<std::uint32_t>(CanError::bit0);
}

void MCan::on_protocol_exception() { psr_at_read_ |= pxe; }

void MCan::on_bit(bool /*level*/) {
  stop_clock();
  if (requested_initialization_) {
    accept_initialization();
  }
  if ((value(Register::tscc) & 3) != 1 || is_initializing()) {
    return;
  }
  if (++bits_ % (field(Register::tscc, 16, 15) + 1) == 0 && ++timestamp_ == 0) {
    raise(Flag::tsw);
  }
}

void MCan::on_start_of_frame(bool /*is_transmitter*/) { time_of_start_ = timestamp_; }

// ---- Reception of a frame

void MCan::on_received(const CanFrame& frame) {
  lec_ = 0;
  if (frame.is_fd) {
    psr_at_read_ |= rfdf | (frame.has_brs ? rbrs : 0) | (frame.has_esi ? resi : 0);
  }
  store(frame, filter(frame));
}

}  // namespace test
