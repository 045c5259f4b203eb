// SPDX-License-Identifier: Apache-2.0
#include "pelican.hpp"

#include <algorithm>

namespace test {
namespace {

// CAN addresses
constexpr std::uint32_t mod = 0;
constexpr std::uint32_t cmr = 1;
constexpr std::uint32_t sr = 2;
constexpr std::uint32_t ir = 3;
constexpr std::uint32_t ier = 4;
constexpr std::uint32_t btr0 = 6;
constexpr std::uint32_t btr1 = 7;
constexpr std::uint32_t ocr = 8;
constexpr std::uint32_t ecc = 12;
constexpr std::uint32_t ewlr = 13;
constexpr std::uint32_t rxerr = 14;
constexpr std::uint32_t txerr = 15;
constexpr std::uint32_t window = 16;
constexpr std::uint32_t window_end = 29;
constexpr std::uint32_t rmc = 29;
constexpr std::uint32_t cdr = 31;
constexpr std::uint32_t registers = 32;

// MOD
constexpr std::uint32_t reset_mode = 1U << 0;
constexpr std::uint32_t listen_only = 1U << 1;
constexpr std::uint32_t self_test = 1U << 2;
constexpr std::uint32_t single_filter = 1U << 3;

// IR, IER
constexpr std::uint32_t receive_flag = 1U << 0;
constexpr std::uint32_t transmit_flag = 1U << 1;
constexpr std::uint32_t warning_flag = 1U << 2;
constexpr std::uint32_t overrun_flag = 1U << 3;
constexpr std::uint32_t passive_flag = 1U << 5;
constexpr std::uint32_t bus_error_flag = 1U << 7;

constexpr std::size_t fifo_bytes = 64;
constexpr std::uint32_t recovery_sequences = 128;

std::vector<std::uint8_t> bytes_of(const CanFrame& frame) {
  std::vector<std::uint8_t> bytes;
  bytes.push_back(
      static_cast<std::uint8_t>((frame.is_extended ? 0x80 : 0) | (frame.is_remote ? 0x40 : 0) | (frame.dlc & 15)));
  if (frame.is_extended) {
    bytes.push_back(static_cast<std::uint8_t>(frame.id >> 21));
    bytes.push_back(static_cast<std::uint8_t>(frame.id >> 13));
    bytes.push_back(static_cast<std::uint8_t>(frame.id >> 5));
    bytes.push_back(static_cast<std::uint8_t>((frame.id << 3) | (frame.is_remote ? 4 : 0)));
  } else {
    bytes.push_back(static_cast<std::uint8_t>(frame.id >> 3));
    bytes.push_back(static_cast<std::uint8_t>((frame.id << 5) | (frame.is_remote ? 0x10 : 0)));
  }
  bytes.insert(bytes.end(), frame.data.begin(), frame.data.begin() + frame.bytes());
  return bytes;
}

bool matches(unsigned value, unsigned code, unsigned mask) { return ((value ^ code) & ~mask) == 0; }

}  // namespace

PeliCan::PeliCan(CanWire& wire, std::uintptr_t address, const Options& options)
    : RegisterModel(address, 4 * registers), wire_(wire), options_(options), node_(wire, *this, options.name) {
  acceptance_.fill(0x5A);
  buffer_.fill(0x5A);
}

void PeliCan::hardware_reset() {
  ++hardware_resets_;
  node_.reset();
  enter_reset();
  mode_ = reset_mode;
  enabled_ = 0;
  flags_ = 0;
  timing0_ = 0;
  timing1_ = 0;
  divider_ = 0;
  acceptance_.fill(0x5A);
  had_bus_off_ = false;
  had_error_status_ = false;
  was_passive_ = false;
  is_error_captured_ = false;
}

// After a hardware reset the registers are those of BasicCAN mode, except in ESP32-C3.
bool PeliCan::is_pelican() const { return options_.kind == PeliCanKind::esp32c3 || (divider_ & 0x80) != 0; }

bool PeliCan::interrupt() const {
  return flags_ != 0 || ((enabled_ & receive_flag) != 0 && !fifo_.empty() && !is_in_reset());
}

void PeliCan::raise(std::uint32_t flag) { flags_ |= flag & enabled_; }

std::uint32_t PeliCan::bit_rate() const {
  const std::uint32_t prescaler = (timing0_ & (options_.kind == PeliCanKind::esp32c3 ? 0x1FFF : 0x3F)) + 1;
  return options_.clock / (2 * prescaler * (3 + (timing1_ & 15) + ((timing1_ >> 4) & 7)));
}

unsigned PeliCan::sample_point() const {
  const unsigned before = 2 + (timing1_ & 15);
  return 1000 * before / (before + 1 + ((timing1_ >> 4) & 7));
}

// ---- Registers

std::uint32_t PeliCan::status() const {
  std::uint32_t value = 0;
  const bool has_frame = !fifo_.empty() && !is_in_reset();
  const bool is_front_complete = !has_frame || fifo_.front().is_complete;
  value |= has_frame ? 1U << 0 : 0;
  value |= (options_.kind == PeliCanKind::esp32 ? !is_front_complete : has_overrun_) ? 1U << 1 : 0;
  value |= !is_pending_ ? 1U << 2 : 0;
  value |= is_complete_ ? 1U << 3 : 0;
  using State = CanNode::State;
  const State state = node_.state();
  const bool waits = is_in_reset() || state == State::integrating || state == State::recovering ||
                     state == State::intermission || state == State::bus_off;
  value |= waits || (node_.is_busy() && !node_.is_transmitter()) ? 1U << 4 : 0;
  value |= waits || node_.is_transmitter() ? 1U << 5 : 0;
  value |= had_error_status_ ? 1U << 6 : 0;
  value |= node_.is_bus_off() ? 1U << 7 : 0;
  value |= options_.kind == PeliCanKind::esp32c3 && !is_front_complete ? 1U << 8 : 0;
  return value;
}

std::uint32_t PeliCan::read_register(std::uint32_t offset) {
  follows_command_ = false;
  const std::uint32_t address = offset / 4;
  if (!is_pelican() && address != mod && address != sr && address != cdr) {
    fault("read before PeliCAN mode is selected");
  }
  if (address >= window && address < window_end) {
    return read_window(address - window);
  }
  switch (address) {
    case mod: return mode_;
    case cmr: return 0;
    case sr: return status();
    case ir: {
      const std::uint32_t value = flags_ | (interrupt() && !fifo_.empty() ? enabled_ & receive_flag : 0);
      flags_ = 0;
      return value;
    }
    case ier: return enabled_;
    case btr0: return timing0_;
    case btr1: return timing1_;
    case ocr: return output_;
    case ecc: is_error_captured_ = false; return error_code_;
    case ewlr: return warning_limit_;
    case rxerr: return node_.is_bus_off() ? 0 : std::min(node_.rec(), 255U);
    case txerr:
      return node_.is_bus_off() ? recovery_sequences - 1 - std::min(sequences_, recovery_sequences - 1)
                                : std::min(node_.tec(), 255U);
    case rmc: return static_cast<std::uint32_t>(fifo_.size());
    case cdr: return divider_;
    default: fault("read of an unused address"); return 0;
  }
}

std::uint32_t PeliCan::read_window(std::uint32_t address) const {
  if (is_in_reset()) {
    return address < acceptance_.size() ? acceptance_[address] : 0;
  }
  return !fifo_.empty() && address < fifo_.front().bytes.size() ? fifo_.front().bytes[address] : 0xEE;
}

void PeliCan::write_register(std::uint32_t offset, std::uint32_t value) {
  const std::uint32_t address = offset / 4;
  if (address == cmr && follows_command_) {
    fault("command without a distance to the one before");
  }
  follows_command_ = address == cmr;
  if (!is_pelican() && address != mod && address != cmr && address != cdr) {
    fault("write before PeliCAN mode is selected");
  }
  if (value > 0xFF && !(options_.kind == PeliCanKind::esp32c3 && (address == btr0 || address == cdr))) {
    fault("write of more than 8 bits");
  }
  if (address >= window && address < window_end) {
    write_window(address - window, value);
    return;
  }
  switch (address) {
    case mod: write_mode(value); return;
    case cmr: write_command(value); return;
    case ier:
      if (is_twai() && (value & 0x18) != 0) {
        fault("reserved interrupt enabled");
      }
      enabled_ = value;
      return;
    default: write_in_reset(address, value); return;
  }
}

void PeliCan::write_in_reset(std::uint32_t address, std::uint32_t value) {
  if (!is_in_reset()) {
    fault("write in operating mode to a register that is read-only then");
    return;
  }
  switch (address) {
    case btr0: timing0_ = value; return;
    case btr1: timing1_ = value; return;
    case ewlr: warning_limit_ = value; return;
    case rxerr:
    case txerr: write_counter(address, value); return;
    case cdr: divider_ = value; return;
    case ocr:
      if (is_twai()) {
        fault("TWAI has no output control register");
      }
      output_ = value;
      return;
    default: fault("write to an unused or read-only address"); return;
  }
}

// In bus-off a value below 255 ends it. ESP32 enters bus-off with 255 at once.
void PeliCan::write_counter(std::uint32_t address, std::uint32_t value) {
  if (address == rxerr) {
    if (!node_.is_bus_off()) {
      node_.set_counters(node_.tec(), value);
    }
    return;
  }
  if (node_.is_bus_off() && value < 255) {
    node_.reset();
    on_counters();
  }
  node_.set_counters(value == 255 && is_twai() ? 256 : value, node_.rec());
}

void PeliCan::write_window(std::uint32_t address, std::uint32_t value) {
  if (is_in_reset()) {
    if (address < acceptance_.size()) {
      acceptance_[address] = static_cast<std::uint8_t>(value);
    }
    return;
  }
  if (is_pending_) {
    fault("write to the transmit buffer while it is locked");
    return;
  }
  buffer_[address] = static_cast<std::uint8_t>(value);
}

// ---- Modes

void PeliCan::write_mode(std::uint32_t value) {
  constexpr std::uint32_t modes = listen_only | self_test | single_filter;
  if (!is_in_reset() && ((value ^ mode_) & modes) != 0 && (value & modes) != 0) {
    fault("mode changed outside of reset mode");
  }
  if ((value & single_filter) != 0) {
    fault("a single filter is not modelled");
  }
  const bool was_in_reset = is_in_reset();
  mode_ = was_in_reset ? value : (mode_ & modes) | (value & reset_mode);
  if (!was_in_reset && is_in_reset()) {
    enter_reset();
  } else if (was_in_reset && !is_in_reset()) {
    leave_reset();
  }
}

void PeliCan::enter_reset() {
  mode_ |= reset_mode;
  node_.stop();
  fifo_.clear();
  has_overrun_ = false;
  is_pending_ = false;
  is_aborting_ = false;
  is_on_wire_ = false;
}

void PeliCan::leave_reset() {
  if (options_.clock != 0 && wire_.bit_rate != 0 && bit_rate() != wire_.bit_rate) {
    fault("bit rate " + std::to_string(bit_rate()) + " differs from that of the bus");
    return;
  }
  CanMode mode;
  mode.is_silent = (mode_ & listen_only) != 0;
  mode.needs_no_acknowledgement = (mode_ & self_test) != 0;
  node_.set_mode(mode);
  const unsigned done = std::min(sequences_, recovery_sequences - 1);
  node_.start(node_.is_bus_off() ? recovery_sequences - done : recovery_sequences);
}

// ---- Transmission

void PeliCan::write_command(std::uint32_t value) {
  constexpr std::uint32_t requests = 1U << 0 | 1U << 4;
  if (is_in_reset()) {
    return;  // the controller may have entered bus-off since the driver has read the mode
  }
  if ((value & requests) != 0) {
    if (is_pending_) {
      fault("request while the transmit buffer is locked");
      return;
    }
    is_pending_ = true;
    is_complete_ = false;
    is_self_reception_ = (value & 1U) == 0;
  }
  if ((value & 1U << 1) != 0 && is_pending_) {
    is_aborting_ = true;
    if (!is_on_wire_) {
      release_transmit_buffer(is_twai());
    }
  }
  if ((value & 1U << 2) != 0) {
    if (fifo_.empty()) {
      fault("release of an empty receive buffer");
    } else {
      fifo_.pop_front();
    }
  }
  if ((value & 1U << 3) != 0) {
    has_overrun_ = false;
  }
}

void PeliCan::release_transmit_buffer(bool is_complete) {
  is_pending_ = false;
  is_aborting_ = false;
  is_on_wire_ = false;
  is_complete_ = is_complete;
  raise(transmit_flag);
}

CanFrame PeliCan::frame_in_buffer() const {
  CanFrame frame;
  frame.is_extended = (buffer_[0] & 0x80) != 0;
  frame.is_remote = (buffer_[0] & 0x40) != 0;
  frame.dlc = buffer_[0] & 15;
  frame.id = frame.is_extended
                 ? static_cast<std::uint32_t>(buffer_[1] << 21 | buffer_[2] << 13 | buffer_[3] << 5 | buffer_[4] >> 3)
                 : static_cast<std::uint32_t>(buffer_[1] << 3 | buffer_[2] >> 5);
  const std::size_t first = frame.is_extended ? 5 : 3;
  for (std::size_t n = 0; n < frame.bytes(); ++n) {
    frame.data[n] = buffer_[first + n];
  }
  return frame;
}

std::optional<CanFrame> PeliCan::next_frame() {
  if (!is_pending_) {
    return std::nullopt;
  }
  return frame_in_buffer();
}

void PeliCan::on_sent() {
  const CanFrame frame = frame_in_buffer();
  release_transmit_buffer(true);
  if (is_self_reception_) {
    on_received(frame);
  }
}

void PeliCan::on_arbitration_lost() {
  is_on_wire_ = false;
  if (is_aborting_) {
    release_transmit_buffer(is_twai());
  }
}

void PeliCan::on_transmission_failed(CanError /*error*/) {
  is_on_wire_ = false;
  if (is_aborting_) {
    release_transmit_buffer(is_twai());
  }
}

// ---- Reception

bool PeliCan::passes(const CanFrame& frame) const {
  const unsigned upper = frame.is_extended ? frame.id >> 21 : frame.id >> 3;
  unsigned lower = (frame.id >> 13) & 0xFF;
  unsigned lower_masked = 0;  // bits that are not compared because there is no data
  unsigned nibble = 0;
  if (!frame.is_extended) {
    lower = ((frame.id & 7) << 5) | (frame.is_remote ? 0x10U : 0) | static_cast<unsigned>(frame.data[0] >> 4);
    nibble = frame.data[0] & 15U;
    lower_masked = frame.bytes() == 0 ? 0x0F : 0;
  }
  const auto& code = acceptance_;
  const std::uint8_t* const mask = acceptance_.data() + 4;
  const bool first = matches(upper, code[0], mask[0]) && matches(lower, code[1], mask[1] | lower_masked) &&
                     (frame.is_extended || frame.bytes() == 0 || matches(nibble, code[3] & 15U, mask[3] & 15U));
  const bool second =
      matches(upper, code[2], mask[2]) && matches(lower, code[3], mask[3] | (frame.is_extended ? 0U : 0x0FU));
  return first || second;
}

std::size_t PeliCan::used_bytes() const {
  std::size_t sum = 0;
  for (const StoredFrame& one : fifo_) {
    sum += one.bytes.size();
  }
  return sum;
}

void PeliCan::on_received(const CanFrame& frame) {
  if (passes(frame)) {
    store(frame);
  }
}

// SJA1000 discards a frame without space. TWAI stores a part of it.
void PeliCan::store(const CanFrame& frame) {
  StoredFrame stored{bytes_of(frame), true};
  if (used_bytes() + stored.bytes.size() <= fifo_bytes) {
    fifo_.push_back(stored);
    return;
  }
  if (!has_overrun_) {
    has_overrun_ = true;
    raise(overrun_flag);
  }
  if (is_twai()) {
    stored.bytes.resize(fifo_bytes - used_bytes());
    stored.is_complete = false;
    fifo_.push_back(stored);
  }
}

// ---- Errors

void PeliCan::on_error(CanError error) {
  if ((enabled_ & bus_error_flag) == 0 || is_error_captured_) {
    return;
  }
  constexpr std::uint32_t data_field = 0x0A;
  constexpr std::uint32_t receiving = 1U << 5;
  constexpr std::uint32_t stuff_error = 2U << 6;
  is_error_captured_ = true;
  error_code_ = node_.is_transmitter() ? 0 : receiving;
  error_code_ |= error == CanError::stuff ? stuff_error | data_field : 0;  // of other errors, no position is modelled
  raise(bus_error_flag);
}

void PeliCan::on_counters() {
  const bool is_bus_off = node_.is_bus_off();
  const bool has_error_status = node_.tec() >= warning_limit_ || node_.rec() >= warning_limit_;
  const bool is_passive = node_.is_error_passive() && !is_bus_off;
  const bool is_changed = has_error_status != had_error_status_ || is_bus_off != had_bus_off_;
  if (is_bus_off && !had_bus_off_) {
    sequences_ = 0;
    enter_reset();
  }
  had_error_status_ = has_error_status;
  had_bus_off_ = is_bus_off;
  if (is_changed) {
    raise(warning_flag);
  }
  if (is_passive != was_passive_) {
    raise(passive_flag);
  }
  was_passive_ = is_passive;
}

}  // namespace test
