// SPDX-License-Identifier: Apache-2.0
#include "mcp2515.hpp"

#include <algorithm>

namespace test {
namespace {

// Registers; those of a buffer are 10h apart
constexpr std::uint8_t bfpctrl = 0x0C;
constexpr std::uint8_t txrtsctrl = 0x0D;
constexpr std::uint8_t canstat = 0x0E;
constexpr std::uint8_t canctrl = 0x0F;
constexpr std::uint8_t tec_register = 0x1C;
constexpr std::uint8_t rec_register = 0x1D;
constexpr std::uint8_t rxm0 = 0x20;
constexpr std::uint8_t cnf3 = 0x28;
constexpr std::uint8_t cnf2 = 0x29;
constexpr std::uint8_t cnf1 = 0x2A;
constexpr std::uint8_t caninte = 0x2B;
constexpr std::uint8_t canintf = 0x2C;
constexpr std::uint8_t eflg = 0x2D;
constexpr std::uint8_t txb0ctrl = 0x30;
constexpr std::uint8_t rxb0ctrl = 0x60;
constexpr std::uint8_t rxb1ctrl = 0x70;

// CANCTRL
constexpr std::uint8_t abat = 1U << 4;
constexpr std::uint8_t osm = 1U << 3;
constexpr std::uint8_t canctrl_at_reset = 0x87;

// CANINTF; RXnIF and TXnIF follow the first
constexpr std::uint8_t merrf = 1U << 7;
constexpr std::uint8_t wakif = 1U << 6;
constexpr std::uint8_t errif = 1U << 5;
constexpr std::uint8_t tx0if = 1U << 2;
constexpr std::uint8_t rx0if = 1U << 0;

// EFLG
constexpr std::uint8_t rx0ovr = 1U << 6;
constexpr std::uint8_t overflows = 3U << 6;
constexpr std::uint8_t txbo = 1U << 5;
constexpr std::uint8_t txep = 1U << 4;
constexpr std::uint8_t rxep = 1U << 3;
constexpr std::uint8_t txwar = 1U << 2;
constexpr std::uint8_t rxwar = 1U << 1;
constexpr std::uint8_t ewarn = 1U << 0;

// TXBnCTRL
constexpr std::uint8_t abtf = 1U << 6;
constexpr std::uint8_t mloa = 1U << 5;
constexpr std::uint8_t txerr = 1U << 4;
constexpr std::uint8_t txreq = 1U << 3;
constexpr std::uint8_t txp = 3;

// RXBnCTRL
constexpr std::uint8_t rxm = 3U << 5;
constexpr std::uint8_t rxrtr = 1U << 3;
constexpr std::uint8_t bukt = 1U << 2;

// SIDL and DLC of buffers
constexpr std::uint8_t srr = 1U << 4;
constexpr std::uint8_t exide = 1U << 3;
constexpr std::uint8_t rtr = 1U << 6;

// Instructions [Table 12-1]
constexpr std::uint8_t instruction_reset = 0xC0;
constexpr std::uint8_t instruction_read = 0x03;
constexpr std::uint8_t instruction_write = 0x02;
constexpr std::uint8_t instruction_bit_modify = 0x05;
constexpr std::uint8_t instruction_read_status = 0xA0;
constexpr std::uint8_t instruction_rx_status = 0xB0;
constexpr bool is_read_rx_buffer(std::uint8_t byte) { return (byte & 0xF9) == 0x90; }
constexpr bool is_load_tx_buffer(std::uint8_t byte) { return (byte & 0xF8) == 0x40 && (byte & 7) < 6; }
constexpr bool is_rts(std::uint8_t byte) { return (byte & 0xF8) == 0x80; }

constexpr std::uint8_t undefined = 0xA5;  // content of filters, masks and buffers after power-up
constexpr unsigned buffers = 3;

std::uint8_t byte(unsigned value) { return static_cast<std::uint8_t>(value); }
// Returns the value without the bits.
std::uint8_t without(unsigned value, unsigned bits) { return byte(value & (0xFFU ^ bits)); }
std::uint8_t bit_of(std::uint8_t first, unsigned index) { return byte(unsigned{first} << index); }
unsigned transmit_base(unsigned buffer) { return txb0ctrl + 16 * buffer; }

// Registers that BIT MODIFY changes by bits. [Table 11-1]
bool is_bit_modifiable(std::uint8_t address) {
  const unsigned low = address & 15;
  return low == 15 || address == bfpctrl || address == txrtsctrl || (address >= cnf3 && address <= eflg) ||
         (address >= txb0ctrl && low == 0);
}

bool is_configuration(std::uint8_t address) {
  return (address < tec_register && address != bfpctrl) || (address >= rxm0 && address <= cnf1);
}

// Returns the identifier in four registers: SIDH, SIDL, EID8, EID0.
std::uint32_t standard_id(const std::uint8_t* words) { return std::uint32_t{words[0]} << 3 | words[1] >> 5; }
std::uint32_t low_id(const std::uint8_t* words) { return std::uint32_t{words[2]} << 8 | words[3]; }
std::uint32_t full_id(const std::uint8_t* words) {
  return standard_id(words) << 18 | (words[1] & 3U) << 16 | low_id(words);
}

}  // namespace

Mcp2515::Mcp2515(CanWire& wire) : Mcp2515(wire, Options{}) {}

Mcp2515::Mcp2515(CanWire& wire, const Options& options)
    : SpiModel(wire), options_(options), node_(wire, *this, options.name) {
  registers_.fill(undefined);
  reset();
}

// Filters, masks and message bytes keep their content. [9.0, 11.0]
void Mcp2515::reset() {
  node_.reset();
  mode_ = Mode::configuration;
  wanted_.reset();
  for (const std::uint8_t address :
       {bfpctrl, txrtsctrl, cnf1, cnf2, cnf3, caninte, canintf, eflg, rxb0ctrl, rxb1ctrl}) {
    at(address) = 0;
  }
  for (unsigned i = 0; i < buffers; ++i) {
    at(transmit_base(i)) = 0;
  }
  at(canctrl) = canctrl_at_reset;
  transmitting_.reset();
  is_aborting_ = {};
}

bool Mcp2515::interrupt() const { return (at(canintf) & at(caninte)) != 0; }

// ---- Instructions

std::uint8_t Mcp2515::shift(std::uint8_t out) {
  if (sent().empty()) {
    return first_byte(out);
  }
  const std::uint8_t instruction = sent()[0];
  if (instruction == instruction_read_status) {
    return read_status();
  }
  if (instruction == instruction_rx_status) {
    return rx_status();
  }
  if (instruction == instruction_bit_modify) {
    return modify_bits(out);
  }
  const bool has_address = instruction == instruction_read || instruction == instruction_write;
  if (has_address && sent().size() == 1) {
    pointer_ = out;
    if (pointer_ >= registers_.size()) {
      fault("register address above 7Fh");
      pointer_ &= 0x7F;
    }
    return not_driven;
  }
  const std::uint8_t address = pointer_;
  pointer_ = byte((pointer_ + 1U) & 0x7F);
  if (instruction == instruction_read || is_read_rx_buffer(instruction)) {
    return read_register(address);
  }
  if (instruction == instruction_write || is_load_tx_buffer(instruction)) {
    write_register(address, out);
    return not_driven;
  }
  fault("a byte after an instruction of one byte, or after an unknown instruction");
  return not_driven;
}

std::uint8_t Mcp2515::first_byte(std::uint8_t out) {
  const bool is_known = out == instruction_read || out == instruction_write || out == instruction_bit_modify ||
                        out == instruction_read_status || out == instruction_rx_status;
  if (out == instruction_reset) {
    reset();
  } else if (is_read_rx_buffer(out)) {
    pointer_ = byte(rxb0ctrl + 16U * (out >> 2 & 1U) + ((out & 2) != 0 ? 6U : 1U));
  } else if (is_load_tx_buffer(out)) {
    pointer_ = byte(transmit_base(out >> 1 & 3U) + ((out & 1) != 0 ? 6U : 1U));
  } else if (is_rts(out)) {
    for (unsigned i = 0; i < buffers; ++i) {
      if ((out >> i & 1) != 0) {
        write_transmit_control(i, at(transmit_base(i)) | txreq);
      }
    }
  } else if (!is_known) {
    fault("unknown instruction");
  }
  return not_driven;
}

// [12.10]
std::uint8_t Mcp2515::modify_bits(std::uint8_t out) {
  switch (sent().size()) {
    case 1: pointer_ = out & 0x7F; break;
    case 2: mask_ = out; break;
    case 3:
      if (!is_bit_modifiable(pointer_) && mask_ != 0xFF) {
        fault("BIT MODIFY of a register that has no bit access: the mask is FFh");
        mask_ = 0xFF;
      }
      write_register(pointer_, byte((read_register(pointer_) & ~mask_) | (out & mask_)));
      break;
    default: fault("a byte after BIT MODIFY"); break;
  }
  return not_driven;
}

void Mcp2515::end_instruction() {
  const std::uint8_t instruction = sent()[0];
  const bool has_address = instruction == instruction_read || instruction == instruction_write;
  const bool has_data = is_read_rx_buffer(instruction) || is_load_tx_buffer(instruction) ||
                        instruction == instruction_read_status || instruction == instruction_rx_status;
  const std::size_t least = instruction == instruction_bit_modify ? 4 : has_address ? 3 : has_data ? 2 : 1;
  if (sent().size() < least) {
    fault("an instruction is not complete");
  }
  if (is_read_rx_buffer(instruction)) {  // the flag is cleared after CS is raised [12.4]
    at(canintf) = without(at(canintf), bit_of(rx0if, instruction >> 2 & 1U));
  }
}

// [Figure 12-8]
std::uint8_t Mcp2515::read_status() const {
  unsigned value = at(canintf) & 3U;
  for (unsigned i = 0; i < buffers; ++i) {
    value |= (at(transmit_base(i)) & txreq) != 0 ? 4U << (2 * i) : 0;
    value |= (at(canintf) & bit_of(tx0if, i)) != 0 ? 8U << (2 * i) : 0;
  }
  return byte(value);
}

// [Figure 12-9]
std::uint8_t Mcp2515::rx_status() const {
  const unsigned messages = at(canintf) & 3U;
  if (messages == 0) {
    return 0;
  }
  const unsigned base = (messages & 1) != 0 ? rxb0ctrl : rxb1ctrl;
  const unsigned filter = (messages & 1) != 0 ? rx_filter_ : rx_filter_1_;
  const unsigned extended = (at(base + 2) & exide) != 0 ? 1U << 4 : 0;
  const unsigned remote = (at(base) & rxrtr) != 0 ? 1U << 3 : 0;
  return byte(messages << 6 | extended | remote | filter);
}

// ---- Registers

std::uint8_t Mcp2515::read_register(std::uint8_t address) const {
  switch (address & 15) {
    case canstat: return read_canstat();
    case canctrl: return at(canctrl);
    default: break;
  }
  switch (address) {
    case tec_register: return byte(std::min(node_.tec(), 255U));
    case rec_register: return byte(std::min(node_.rec(), 255U));
    default: return at(address);
  }
}

// [Register 10-2, Table 7-1]
std::uint8_t Mcp2515::read_canstat() const {
  static constexpr std::array<std::uint8_t, 7> by_priority{errif,      wakif, tx0if,     tx0if << 1,
                                                           tx0if << 2, rx0if, rx0if << 1};
  unsigned code = 0;
  for (unsigned i = 0; i < by_priority.size() && code == 0; ++i) {
    code = (at(canintf) & at(caninte) & by_priority[i]) != 0 ? i + 1 : 0;
  }
  return byte(static_cast<unsigned>(mode_) << 5 | code << 1);
}

void Mcp2515::write_register(std::uint8_t address, std::uint8_t value) {
  const unsigned low = address & 15;
  if (low == canctrl) {
    write_control(value);
  } else if (low == canstat || address == tec_register || address == rec_register) {
    fault("write to a read-only register");
  } else if (address == bfpctrl) {
    at(address) = value & 0x3F;
  } else if (is_configuration(address)) {
    write_configuration(address, value);
  } else if (address == caninte) {
    at(address) = value;
  } else if (address == canintf) {
    write_flags(value);
  } else if (address == eflg) {
    at(eflg) = without(at(eflg), overflows) | (value & overflows);
  } else if (address < rxb0ctrl) {
    write_transmit(address, value);
  } else {
    write_receive(address, value);
  }
}

// [Register 10-1]
void Mcp2515::write_control(std::uint8_t value) {
  const unsigned request = value >> 5;
  if (request > static_cast<unsigned>(Mode::configuration)) {
    fault("CANCTRL.REQOP: invalid mode");
    return;
  }
  at(canctrl) = value;
  wanted_ = static_cast<Mode>(request);
  for (unsigned i = 0; i < buffers && (value & abat) != 0; ++i) {
    if (is_requested(i)) {
      if (transmitting_ == i) {
        is_aborting_[i] = true;
      } else {
        abort(i, true);
      }
    }
  }
}

// An interrupt cannot be cleared while its condition prevails; setting WAKIF wakes the controller. [7.0, 7.7, 10.2]
void Mcp2515::write_flags(std::uint8_t value) {
  at(canintf) = value;
  if (options_.is_error_flag_sticky && at(eflg) != 0) {
    at(canintf) |= errif;
  }
  if (mode_ == Mode::sleep && (value & wakif) != 0 && (at(caninte) & wakif) != 0) {
    enter(Mode::listen_only);
  }
}

// [10.1]
void Mcp2515::write_configuration(std::uint8_t address, std::uint8_t value) {
  if (mode_ != Mode::configuration) {
    fault("write to a filter, a mask, CNF or TXRTSCTRL outside of Configuration mode");
    return;
  }
  if (address == txrtsctrl && (value & 7) != 0) {
    fault("TXnRTS pins are not modelled");
  }
  at(address) = value;
}

void Mcp2515::write_transmit(std::uint8_t address, std::uint8_t value) {
  const unsigned buffer = (address - txb0ctrl) / 16U;
  if (address % 16 == 0) {
    write_transmit_control(buffer, value);
  } else if (is_requested(buffer) || transmitting_ == buffer) {
    fault("write to a transmit buffer while its transmission is pending");
  } else {
    at(address) = value;
  }
}

// Setting TXREQ clears ABTF, MLOA and TXERR; clearing it requests an abort, without ABTF. [3.3, 3.6]
void Mcp2515::write_transmit_control(unsigned buffer, std::uint8_t value) {
  std::uint8_t& control = at(transmit_base(buffer));
  const bool was_requested = (control & txreq) != 0;
  const bool is_set = (value & txreq) != 0;
  control = byte((control & (abtf | mloa | txerr)) | (value & txp) | (control & txreq));
  if (is_set && !was_requested) {
    if (transmitting_ == buffer) {
      fault("TXREQ is set while an aborted message is still transmitted");
    }
    control = byte((control & txp) | txreq);
    if ((at(canctrl) & abat) != 0) {
      abort(buffer, true);
    }
  } else if (!is_set && was_requested) {
    control = without(control, txreq);
  }
}

void Mcp2515::write_receive(std::uint8_t address, std::uint8_t value) {
  if (address % 16 != 0) {
    fault("write to a receive buffer");
    return;
  }
  if ((value & rxm) != 0 && (value & rxm) != rxm) {
    fault("RXBnCTRL.RXM: reserved mode");
  }
  std::uint8_t& control = at(address);
  if (address == rxb1ctrl) {
    control = without(control, rxm) | (value & rxm);
    return;
  }
  const unsigned copies = (value & bukt) != 0 ? 6 : 0;  // BUKT and BUKT1
  control = byte((control & (rxrtr | 1U)) | (value & rxm) | copies);
}

// ---- Modes

void Mcp2515::on_bit(bool level) {
  if (mode_ == Mode::sleep && level == dominant && (at(caninte) & wakif) != 0) {
    wake_up();
  }
  change_mode();
}

// The wake-up sets WAKIF and leads to Listen-Only mode. [10.2]
void Mcp2515::wake_up() {
  at(canintf) |= wakif;
  enter(Mode::listen_only);
}

bool Mcp2515::has_pending() const {
  bool is_pending = transmitting_.has_value();
  for (unsigned i = 0; i < buffers; ++i) {
    is_pending = is_pending || is_requested(i);
  }
  return is_pending;
}

// The mode does not change until all pending transmissions are complete. [10.0]
void Mcp2515::change_mode() {
  if (!wanted_ || *wanted_ == mode_) {
    wanted_.reset();
    return;
  }
  const bool can_transmit = mode_ == Mode::normal || mode_ == Mode::loopback;
  if (node_.is_busy() || (can_transmit && has_pending())) {
    return;
  }
  enter(*wanted_);
}

// Configuration mode clears the error counters. [10.1]
void Mcp2515::enter(Mode mode) {
  const bool was_configuration = mode_ == Mode::configuration;
  mode_ = mode;
  wanted_.reset();
  if (mode == Mode::sleep) {
    node_.stop();
    return;
  }
  if (mode == Mode::configuration || mode == Mode::listen_only) {
    node_.reset();
    on_counters();
  }
  if (mode == Mode::configuration) {
    return;
  }
  if (was_configuration) {
    check_timing();
  }
  if (options_.oscillator != 0 && wire_.bit_rate != 0 && bit_rate() != wire_.bit_rate) {
    fault("bit rate " + std::to_string(bit_rate()) + " differs from that of the bus");
    node_.stop();
    return;
  }
  CanMode node_mode;
  node_mode.is_loopback = mode == Mode::loopback;
  node_mode.is_silent = mode == Mode::loopback;
  node_mode.is_listen_only = mode == Mode::listen_only;
  node_.set_mode(node_mode);
  node_.start();
}

// [5.0]
Mcp2515::Timing Mcp2515::timing() const {
  const unsigned segment_1 = (at(cnf2) >> 3 & 7U) + 1;
  const bool has_segment_2 = (at(cnf2) & 0x80) != 0;  // BTLMODE
  const unsigned segment_2 = has_segment_2 ? (at(cnf3) & 7U) + 1 : std::max(segment_1, 2U);
  return {(at(cnf1) & 0x3FU) + 1, 2 + (at(cnf2) & 7U) + segment_1, segment_2, (at(cnf1) >> 6) + 1U};
}

std::uint32_t Mcp2515::bit_rate() const {
  const Timing one = timing();
  return options_.oscillator / (2 * one.prescaler) / (one.before_sample + one.after_sample);
}

unsigned Mcp2515::sample_point() const {
  const Timing one = timing();
  return 1000 * one.before_sample / (one.before_sample + one.after_sample);
}

// [5.3]
void Mcp2515::check_timing() {
  const Timing one = timing();
  const bool is_short = one.before_sample + one.after_sample < 5 || one.after_sample < 2;
  if (is_short || one.before_sample - 1 < one.after_sample || one.after_sample <= one.jump) {
    fault("CNF1, CNF2, CNF3: bit timing against the requirements of 5.3");
  }
}

// ---- Transmission

bool Mcp2515::is_requested(unsigned buffer) const { return (at(transmit_base(buffer)) & txreq) != 0; }

CanFrame Mcp2515::frame_of(unsigned buffer) const {
  const std::uint8_t* const words = &registers_[transmit_base(buffer) + 1];
  CanFrame frame;
  frame.is_extended = (words[1] & exide) != 0;
  frame.id = frame.is_extended ? full_id(words) : standard_id(words);
  frame.is_remote = (words[4] & rtr) != 0;
  frame.dlc = words[4] & 15;
  std::copy_n(words + 5, 8, frame.data.begin());
  return frame;
}

// The highest TXP is sent first, then the highest buffer number. [3.2]
std::optional<CanFrame> Mcp2515::next_frame() {
  std::optional<unsigned> first;
  for (unsigned i = 0; i < buffers; ++i) {
    const auto priority = [&](unsigned buffer) { return at(transmit_base(buffer)) & txp; };
    if (is_requested(i) && (!first || priority(i) >= priority(*first))) {
      first = i;
    }
  }
  if (!first) {
    return std::nullopt;
  }
  transmitting_ = first;
  return frame_of(*first);
}

void Mcp2515::on_sent() {
  const unsigned buffer = *transmitting_;
  transmitting_.reset();
  is_aborting_[buffer] = false;
  at(transmit_base(buffer)) &= txp;
  at(canintf) |= bit_of(tx0if, buffer);
}

void Mcp2515::on_arbitration_lost() { end_attempt(mloa); }

void Mcp2515::on_transmission_failed(CanError /*error*/) { end_attempt(txerr); }

// In One-Shot mode, and after an abort request, the message is not repeated. [3.4, 3.6]
void Mcp2515::end_attempt(std::uint8_t cause) {
  const unsigned buffer = *transmitting_;
  transmitting_.reset();
  at(transmit_base(buffer)) |= cause;
  if (is_aborting_[buffer] || (at(canctrl) & osm) != 0) {
    abort(buffer, true);
  }
}

void Mcp2515::abort(unsigned buffer, bool is_flagged) {
  std::uint8_t& control = at(transmit_base(buffer));
  control = without(control, txreq) | (is_flagged ? abtf : std::uint8_t{0});
  is_aborting_[buffer] = false;
}

// ---- Reception

// With a standard frame, the extended identifier of the filter is applied to two data bytes. [4.5.1, Register 4-1]
bool Mcp2515::accepts(unsigned filter, unsigned mask, const CanFrame& frame) const {
  const std::uint8_t* const expected = &registers_[4 * filter + (filter >= 3 ? 4 : 0)];
  const std::uint8_t* const bits = &registers_[rxm0 + 4 * mask];
  if (((expected[1] & exide) != 0) != frame.is_extended) {
    return false;
  }
  if (frame.is_extended) {
    return ((full_id(expected) ^ frame.id) & full_id(bits)) == 0;
  }
  const std::uint32_t data = (frame.bytes() > 0 ? frame.data[0] : 0U) << 8 | (frame.bytes() > 1 ? frame.data[1] : 0U);
  return ((standard_id(expected) ^ frame.id) & standard_id(bits)) == 0 &&
         ((low_id(expected) ^ data) & low_id(bits)) == 0;
}

// Returns the first filter of a buffer that accepts the frame.
std::optional<unsigned> Mcp2515::match(unsigned buffer, const CanFrame& frame) const {
  const unsigned first = buffer == 0 ? 0 : 2;
  const unsigned end = buffer == 0 ? 2 : 6;
  if ((at(rxb0ctrl + 16 * buffer) & rxm) == rxm) {
    return first;
  }
  for (unsigned i = first; i < end; ++i) {
    if (accepts(i, buffer, frame)) {
      return i;
    }
  }
  return std::nullopt;
}

// [Figure 4-3]
void Mcp2515::on_received(const CanFrame& frame) {
  const auto is_full = [&](unsigned buffer) { return (at(canintf) & bit_of(rx0if, buffer)) != 0; };
  if (const std::optional<unsigned> filter = match(0, frame)) {
    const bool rolls_over = (at(rxb0ctrl) & bukt) != 0;
    if (!is_full(0)) {
      rx_filter_ = *filter;
      store(0, *filter, frame);
    } else if (!rolls_over) {
      overflow(0);
    } else if (is_full(1)) {
      overflow(1);
    } else {
      rx_filter_1_ = 6 + *filter;
      at(rxb0ctrl) = byte(without(at(rxb0ctrl), 1) | *filter);  // [Register 4-1, note 1]
      store(1, *filter, frame);
    }
  } else if (const std::optional<unsigned> other = match(1, frame)) {
    if (is_full(1)) {
      overflow(1);
    } else {
      rx_filter_1_ = *other;
      store(1, *other, frame);
    }
  }
}

void Mcp2515::store(unsigned buffer, unsigned filter, const CanFrame& frame) {
  const unsigned base = rxb0ctrl + 16 * buffer;
  const std::uint8_t filters = buffer == 0 ? 1 : 7;
  at(base) = byte(without(at(base), filters | rxrtr) | (filter & filters) | (frame.is_remote ? rxrtr : 0U));
  const std::uint32_t standard = frame.is_extended ? frame.id >> 18 : frame.id;
  const bool is_standard_remote = frame.is_remote && !frame.is_extended;
  at(base + 1) = byte(standard >> 3);
  at(base + 2) = byte((standard & 7) << 5 | (is_standard_remote ? srr : 0U) |
                      (frame.is_extended ? exide | (frame.id >> 16 & 3U) : 0U));
  at(base + 3) = frame.is_extended ? byte(frame.id >> 8 & 0xFF) : undefined;
  at(base + 4) = frame.is_extended ? byte(frame.id & 0xFF) : undefined;
  at(base + 5) = byte(frame.dlc | (frame.is_remote && frame.is_extended ? rtr : 0U));
  for (unsigned i = 0; i < 8; ++i) {
    at(base + 6 + i) = i < frame.bytes() ? frame.data[i] : undefined;
  }
  at(canintf) |= bit_of(rx0if, buffer);
}

// [7.6.1]
void Mcp2515::overflow(unsigned buffer) {
  at(eflg) |= bit_of(rx0ovr, buffer);
  at(canintf) |= errif;
}

// ---- Errors

void Mcp2515::on_error(CanError /*error*/) { at(canintf) |= merrf; }

// [6.0, Register 6-3]
void Mcp2515::on_counters() {
  constexpr unsigned warning_limit = 96;
  constexpr unsigned passive_limit = 128;
  unsigned flags = 0;
  flags |= node_.tec() >= warning_limit ? txwar | ewarn : 0U;
  flags |= node_.rec() >= warning_limit ? rxwar | ewarn : 0U;
  flags |= node_.tec() >= passive_limit ? txep : 0U;
  flags |= node_.rec() >= passive_limit ? rxep : 0U;
  flags |= node_.is_bus_off() ? txbo : 0U;
  set_error_flags(byte(flags));
  if (node_.state() == CanNode::State::bus_off && (mode_ == Mode::normal || mode_ == Mode::loopback)) {
    node_.start();  // 128 sequences of 11 recessive bits [Figure 6-1]
  }
}

void Mcp2515::set_error_flags(std::uint8_t flags) {
  const unsigned appeared = flags & ~at(eflg);
  at(eflg) = byte((at(eflg) & overflows) | flags);
  if (appeared != 0) {
    at(canintf) |= errif;
  }
}

}  // namespace test
