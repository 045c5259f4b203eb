// SPDX-License-Identifier: Apache-2.0
// SPI, registers, modes and errors of the model of MCP2517FD and MCP2518FD.
#include "mcp251xfd.hpp"

#include <algorithm>

#include "mcp251xfd_bits.hpp"

namespace test {

using namespace mcp251xfd;

Mcp251xfd::Mcp251xfd(CanWire& wire) : Mcp251xfd(wire, Options{}) {}

Mcp251xfd::Mcp251xfd(CanWire& wire, const Options& options)
    : SpiModel(wire), options_(options), node_(wire, *this, options.name) {
  ram_.fill(undefined);
  reset();
}

// The RAM keeps its content.
void Mcp251xfd::reset() {
  node_.reset();
  mode_ = Mode::configuration;
  wanted_.reset();
  is_joining_ = false;
  transmitting_ = nullptr;
  registers_ = {};
  word(con) = con_at_reset;
  word(nbtcfg) = 0x003E0F0F;
  word(dbtcfg) = 0x000E0303;
  word(tdc) = 0x00021000;
  chip_ = {osc_at_reset, iocon_at_reset};
  fifos_ = {};
  for (Fifo& one : fifos_) {
    one.control = fifocon_at_reset;
  }
  fifos_[0].control |= txen;
  events_ = {};
  error_state_ = 0;
  unready_reads_ = options_.start_up_reads;
}

// ---- SPI

// An instruction of four bits and an address of twelve bits precede the data.
std::uint8_t Mcp251xfd::shift(std::uint8_t out) {
  if (sent().empty()) {
    instruction_ = out >> 4;
    pointer_ = (out & 15U) << 8;
    write_mask_ = 0;
    return not_driven;
  }
  if (sent().size() == 1) {
    pointer_ |= out;
    const bool has_address = instruction_ == instruction_read || instruction_ == instruction_write;
    if (!has_address && (instruction_ != instruction_reset || pointer_ != 0)) {
      fault("unknown instruction, or one that is not modelled");
    }
    if (has_address && is_ram(pointer_) && pointer_ % 4 != 0) {
      fault("access to the RAM at an address that is not a multiple of 4");
      pointer_ -= pointer_ % 4;
    }
    return not_driven;
  }
  if (instruction_ == instruction_read) {
    return read_byte();
  }
  if (instruction_ == instruction_write) {
    write_byte(out);
  } else if (instruction_ == instruction_reset) {
    fault("a byte after RESET");
  }
  return not_driven;
}

std::uint8_t Mcp251xfd::read_byte() {
  const unsigned address = pointer_;
  pointer_ = following(pointer_);
  if (!is_ram(address) && !is_chip(address) && address >= registers_end) {
    fault("read of an address without a register");
    return 0;
  }
  if (is_configuring() && address % 4 == 0 && is_fifo(address) && part_of(address) == 8) {
    fault("read of C1FIFOUA, C1TXQUA or C1TEFUA in Configuration mode");
  }
  const std::uint32_t value = read_word(address - address % 4);
  if (address == osc + 1 && unready_reads_ != 0) {
    --unready_reads_;
  }
  return static_cast<std::uint8_t>(value >> address % 4 * 8 & 0xFF);
}

// Registers and RAM are written by words; a transaction may write a part of a register.
void Mcp251xfd::write_byte(std::uint8_t out) {
  const unsigned shift = pointer_ % 4 * 8;
  write_value_ = (write_value_ & ~(0xFFU << shift)) | std::uint32_t{out} << shift;
  write_mask_ |= 0xFFU << shift;
  if (pointer_ % 4 == 3) {
    complete_write();
  }
  pointer_ = following(pointer_);
}

void Mcp251xfd::complete_write() {
  const unsigned address = pointer_ - pointer_ % 4;
  const std::uint32_t mask = write_mask_;
  write_mask_ = 0;
  if (unready_reads_ != 0 && address != con && address != osc) {
    fault("a write before OSC.OSCRDY is set");
  }
  if (!is_ram(address)) {
    write_register(address, write_value_, mask);
  } else if (~mask == 0) {
    write_ram(address, write_value_);
  } else {
    fault("a write to the RAM whose number of bytes is not a multiple of 4");
  }
}

void Mcp251xfd::end_instruction() {
  const std::size_t least = instruction_ == instruction_reset ? instruction_bytes : instruction_bytes + 1;
  if (sent().size() < least) {
    fault("an instruction is not complete");
    return;
  }
  if (instruction_ == instruction_write && write_mask_ != 0) {
    complete_write();
  }
  if (instruction_ == instruction_read && is_ram(pointer_) && (sent().size() - instruction_bytes) % 4 != 0) {
    fault("a read of the RAM whose number of bytes is not a multiple of 4");
  }
  if (instruction_ == instruction_reset) {
    if (!is_configuring()) {
      fault("RESET outside of Configuration mode");
    }
    reset();
  }
}

// ---- Reading of registers

std::uint32_t Mcp251xfd::read_word(unsigned address) const {
  if (is_ram(address)) {
    return ram(address);
  }
  if (is_chip(address)) {
    return address == osc ? read_oscillator() : chip_[(address - chip_begin) / 4];
  }
  if (is_fifo(address)) {
    return read_fifo_register(address);
  }
  switch (address) {
    case con: return word(con) | static_cast<std::uint32_t>(mode_) << 21 | (node_.is_busy() ? busy : 0);
    case vec: return read_vector();
    case interrupts: return read_interrupts();
    case rxif: return receive_interrupts();
    case txif: return transmit_interrupts();
    case rxovif: return flags_with_enable(overflow);
    case txatif: return flags_with_enable(attempts);
    case txreq_register: return requests();
    case trec: return read_errors();
    default: return address < registers_end ? word(address) : 0;
  }
}

// The object with the highest code; 40h: no interrupt. [10]
std::uint32_t Mcp251xfd::read_vector() const {
  constexpr std::uint32_t none = 0x40;
  const auto highest = [](std::uint32_t flags) {
    std::uint32_t code = none;
    for (unsigned i = 0; i < 32; ++i) {
      code = (flags >> i & 1) != 0 ? i : code;
    }
    return code;
  };
  struct Code {
    unsigned flag;
    std::uint32_t code;
  };
  static constexpr Code codes[] = {{13, 0x41}, {14, 0x42}, {11, 0x43}, {12, 0x45}, {2, 0x46},
                                   {3, 0x47},  {15, 0x48}, {4, 0x49},  {10, 0x4A}};
  const std::uint32_t value = read_interrupts();
  const std::uint32_t active = value & value >> 16;
  std::uint32_t code = highest((active & 2) != 0 ? receive_interrupts() : 0);
  const std::uint32_t transmit = highest((active & 1) != 0 ? transmit_interrupts() : 0);
  code = code == none || (transmit != none && transmit > code) ? transmit : code;
  for (const Code& one : codes) {
    code = (active >> one.flag & 1) != 0 ? one.code : code;
  }
  return highest(receive_interrupts()) << 24 | highest(transmit_interrupts()) << 16 | code;
}

std::uint32_t Mcp251xfd::read_interrupts() const {
  std::uint32_t value = word(interrupts);
  value |= transmit_interrupts() != 0 ? bit(0) : 0;
  value |= receive_interrupts() != 0 ? bit(1) : 0;
  value |= (pending_flags(events_) & 15) != 0 && (word(con) & stef) != 0 ? bit(4) : 0;
  value |= flags_with_enable(attempts) != 0 ? bit(10) : 0;
  value |= flags_with_enable(overflow) != 0 ? bit(11) : 0;
  return value;
}

bool Mcp251xfd::interrupt() const {
  const std::uint32_t value = read_interrupts();
  return (value & value >> 16 & 0xFFFF) != 0;
}

std::uint32_t Mcp251xfd::read_errors() const {
  const std::uint32_t counters = std::min(node_.rec(), 255U) | std::min(node_.tec(), 255U) << 8;
  return counters | error_state_ | (is_configuring() ? txbo : 0);
}

std::uint32_t Mcp251xfd::read_oscillator() const {
  const std::uint32_t value = chip_[0];
  return value | (value & pllen) << 8 | (value & sclkdiv) << 8 | (unready_reads_ == 0 ? oscrdy : 0);
}

std::uint32_t Mcp251xfd::requests() const {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < fifos_.size(); ++i) {
    value |= fifos_[i].is_requested ? bit(i) : 0;
  }
  return value;
}

std::uint32_t Mcp251xfd::receive_interrupts() const {
  std::uint32_t value = 0;
  for (unsigned i = 1; i < fifos_.size(); ++i) {
    value |= !fifos_[i].is_transmit() && (pending_flags(fifos_[i]) & (extreme | half | basic)) != 0 ? bit(i) : 0;
  }
  return value;
}

std::uint32_t Mcp251xfd::transmit_interrupts() const {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < fifos_.size(); ++i) {
    value |= fifos_[i].is_transmit() && (pending_flags(fifos_[i]) & (extreme | half | basic)) != 0 ? bit(i) : 0;
  }
  return value;
}

std::uint32_t Mcp251xfd::flags_with_enable(std::uint32_t flag) const {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < fifos_.size(); ++i) {
    value |= (pending_flags(fifos_[i]) & flag) != 0 ? bit(i) : 0;
  }
  return value;
}

// ---- Writing of registers

// Returns the value, in other modes than Configuration mode with the old content of the bits. [2]
std::uint32_t Mcp251xfd::protect(std::uint32_t old, std::uint32_t value, std::uint32_t bits, const char* reason) {
  if (is_configuring() || ((old ^ value) & bits) == 0) {
    return value;
  }
  fault(std::string(reason) + " outside of Configuration mode");
  return (value & ~bits) | (old & bits);
}

void Mcp251xfd::write_register(unsigned address, std::uint32_t value, std::uint32_t mask) {
  if (is_fifo(address)) {
    write_fifo_register(address, value, mask);
    return;
  }
  const std::uint32_t merged = (read_word(address) & ~mask) | (value & mask);
  switch (address) {
    case con: write_control(merged); break;
    case interrupts: word(interrupts) = (word(interrupts) & merged & clearable) | (merged & enables); break;
    case txreq_register: write_requests(value & mask); break;
    case vec:
    case rxif:
    case txif:
    case rxovif:
    case txatif:
    case trec:
    case first_reserved:
    case devid: fault("write to a read-only register"); break;
    default:
      if (address >= fltobj && address < registers_end) {
        write_filter(address, merged);
      } else if (address >= fltcon && address < registers_end) {
        write_filter_control(address, merged);
      } else {
        write_plain(address, merged);
      }
      break;
  }
}

void Mcp251xfd::write_plain(unsigned address, std::uint32_t value) {
  const char* const timing = "write to C1NBTCFG, C1DBTCFG or C1TDC";
  switch (address) {
    case nbtcfg: word(nbtcfg) = protect(word(nbtcfg), value & 0xFFFF7F7F, ~0U, timing); break;
    case dbtcfg: word(dbtcfg) = protect(word(dbtcfg), value & 0xFF1F0F0F, ~0U, timing); break;
    case tdc: word(tdc) = protect(word(tdc), value & 0x03037F3F, ~0U, timing); break;
    case tscon:
      if ((value & bit(16)) != 0) {
        fault("the time base counter is not modelled");
      }
      word(tscon) = value & 0x000703FF;
      break;
    case osc:
      if ((value & oscdis) != 0) {
        fault("Sleep mode is not modelled");
      }
      chip_[0] = protect(chip_[0], value & (options_.is_2517 ? 0x70 | pllen : 0x70 | pllen | lpmen), osc_protected,
                         "change of OSC.PLLEN or OSC.SCLKDIV");
      break;
    case iocon:
      if ((value & pin_modes) != pin_modes) {
        fault("INT0 and INT1 as interrupt outputs are not modelled");
      }
      chip_[1] = value & 0x73000343;
      break;
    case crc: chip_[2] = value & 0x03000000; break;
    case ecccon: chip_[3] = value & 0x7F07; break;
    case 0xE10: break;  // ECCSTAT: flags that are never set
    default:
      if (address >= registers_end) {
        fault("write to an address without a register");
      } else {
        word(address) = value;
      }
      break;
  }
}

void Mcp251xfd::write_control(std::uint32_t value) {
  const Mode request = static_cast<Mode>(value >> 24 & 7);
  if ((value & 31) != 0 && ((word(con) ^ value) & 31) != 0) {
    fault("C1CON.DNCNT: filters for data bytes are not modelled");
  }
  const Mode before = static_cast<Mode>(word(con) >> 24 & 7);
  word(con) = protect(word(con), value & con_writable, con_protected, "change of a protected bit of C1CON");
  if ((value & abat) != 0) {
    for (Fifo& one : fifos_) {
      abort(one);
    }
  }
  const bool has_left = mode_ == Mode::restricted || (mode_ == Mode::listen_only && before != mode_);  // underflow()
  if (request == before && (!has_left || wanted_)) {
    return;
  }
  const bool is_between = !is_configuring() && request != Mode::configuration && request != mode_ && !has_left;
  if (request == Mode::sleep || request == Mode::restricted || is_between) {
    fault(
        "C1CON.REQOP: Sleep mode, Restricted Operation mode, and changes other than to and from Configuration mode "
        "are not modelled");
    return;
  }
  wanted_ = request;
  if (is_joining_) {
    node_.stop();
    is_joining_ = false;
  }
}

// ---- Modes

void Mcp251xfd::on_bit(bool /*level*/) { change_mode(); }

// A transmission or reception is completed; then the mode changes. A mode other than Configuration mode begins with 11
// recessive bits. [2]
void Mcp251xfd::change_mode() {
  if (!wanted_ || *wanted_ == mode_) {
    wanted_.reset();
    return;
  }
  if (*wanted_ == Mode::configuration) {
    if (!node_.is_busy()) {
      enter(Mode::configuration);
    }
  } else if (!is_joining_) {
    begin_joining(*wanted_);
  } else if (node_.is_on_bus()) {
    enter(*wanted_);
  }
}

void Mcp251xfd::begin_joining(Mode mode) {
  if (options_.oscillator != 0 && wire_.bit_rate != 0 && bit_rate() != wire_.bit_rate) {
    fault("bit rate " + std::to_string(bit_rate()) + " differs from that of the bus");
    enter(mode);
    return;
  }
  CanMode node_mode;
  node_mode.is_loopback = mode == Mode::internal_loopback || mode == Mode::external_loopback;
  node_mode.is_silent = mode == Mode::internal_loopback;
  node_mode.is_listen_only = mode == Mode::listen_only;
  node_mode.fd = mode == Mode::normal_classic ? FdMode::tolerant : FdMode::enabled;
  node_mode.exception_is_error = true;
  node_mode.pauses = word(con) >> 28 != 0;  // TXBWS
  node_.stop();
  node_.set_mode(node_mode);
  node_.start();
  is_joining_ = true;
}

// Erratum 1 of MCP2517FD. C1CON.REQOP does not change.
void Mcp251xfd::underflow() {
  is_underflow_next_ = false;
  mode_ = (word(con) & serr2lom) != 0 ? Mode::listen_only : Mode::restricted;
  CanMode mode = node_.mode();
  mode.is_listen_only = mode_ == Mode::listen_only;
  node_.set_mode(mode);
  word(interrupts) |= serrif | modif;
}

// Configuration mode resets all FIFOs; its end resets the error counters.
void Mcp251xfd::enter(Mode mode) {
  mode_ = mode;
  wanted_.reset();
  is_joining_ = false;
  word(interrupts) |= modif;
  if (mode == Mode::configuration) {
    transmitting_ = nullptr;
    node_.reset();
    error_state_ = 0;
    events_.clear();
    for (Fifo& one : fifos_) {
      one.clear();
    }
    return;
  }
  check_timing();
  allocate();
}

std::uint32_t Mcp251xfd::clock() const {
  return options_.oscillator * ((chip_[0] & pllen) != 0 ? 10 : 1) / ((chip_[0] & sclkdiv) != 0 ? 2 : 1);
}

std::uint32_t Mcp251xfd::bit_rate() const {
  const std::uint32_t value = word(nbtcfg);
  return clock() / ((value >> 24) + 1) / (3 + (value >> 16 & 0xFF) + (value >> 8 & 0x7F));
}

unsigned Mcp251xfd::sample_point() const {
  const unsigned before = 2 + (word(nbtcfg) >> 16 & 0xFF);
  return 1000 * before / (before + 1 + (word(nbtcfg) >> 8 & 0x7F));
}

// [3]
void Mcp251xfd::check_timing() {
  constexpr std::uint32_t largest_clock = 40'000'000;
  const unsigned segment_1 = word(nbtcfg) >> 16 & 0xFF;
  const unsigned segment_2 = word(nbtcfg) >> 8 & 0x7F;
  const unsigned jump = word(nbtcfg) & 0x7F;
  if (jump > segment_2 || segment_1 < segment_2 || clock() > largest_clock) {
    fault("C1NBTCFG, OSC: bit timing against the requirements");
  }
}

// ---- Errors

// [10, 11]
void Mcp251xfd::on_error(CanError error) {
  static constexpr std::uint32_t flags[] = {0, bit(20), bit(19), bit(18), bit(17), bit(16), bit(21)};
  word(interrupts) |= ivmif;
  word(bdiag1) |= flags[static_cast<unsigned>(error)];
  const unsigned shift = node_.is_transmitter() ? 8 : 0;
  const std::uint32_t counter = word(bdiag0) >> shift & 0xFF;
  word(bdiag0) += counter != 0xFF ? bit(shift) : 0;
}

// CERRIF is set when a warning, error passive or bus-off begins, and when error passive or bus-off ends. [10]
void Mcp251xfd::on_counters() {
  constexpr unsigned warning_limit = 96;
  constexpr unsigned passive_limit = 128;
  const auto is_warning = [](unsigned counter) { return counter >= warning_limit && counter < passive_limit; };
  std::uint32_t state = 0;
  state |= is_warning(node_.tec()) ? txwarn | ewarn : 0;
  state |= is_warning(node_.rec()) ? rxwarn | ewarn : 0;
  state |= node_.tec() >= passive_limit ? txbp : 0;
  state |= node_.rec() >= passive_limit ? rxbp : 0;
  state |= node_.is_bus_off() ? txbo : 0;
  const std::uint32_t changed = state ^ error_state_;
  const std::uint32_t before = error_state_;
  error_state_ = state;
  if ((changed & (txbp | rxbp | txbo)) != 0 || (changed & state & (txwarn | rxwarn)) != 0) {
    word(interrupts) |= cerrif;
  }
  if ((changed & (options_.flags_begin_of_bus_off ? state : before) & txbo) != 0) {
    word(bdiag1) |= txboerr;
  }
  if ((changed & state & txbo) != 0 && !options_.keeps_messages_in_bus_off) {
    transmitting_ = nullptr;
    for (Fifo& one : fifos_) {
      if (one.is_transmit()) {
        one.clear();
      }
    }
  }
  if (node_.state() == CanNode::State::bus_off) {
    node_.start();  // the recovery begins without a request [11]
  }
}

}  // namespace test
