// SPDX-License-Identifier: Apache-2.0
// FIFOs, filters and messages of the model of MCP2517FD and MCP2518FD.
#include <algorithm>

#include "mcp251xfd.hpp"
#include "mcp251xfd_bits.hpp"

namespace test {

using namespace mcp251xfd;

// ---- Registers of FIFOs and filters

std::uint32_t Mcp251xfd::read_fifo_register(unsigned address) const {
  const Fifo& fifo = fifo_at(address);
  switch (part_of(address)) {
    case 0: return fifo_control(fifo);
    case 4: return fifo_status(fifo);
    default: break;
  }
  if (is_configuring()) {
    return undefined & 0xFFF;
  }
  const bool is_written = fifo.is_transmit();  // by software
  return fifo.address_of(is_written || fifo.used.empty() ? fifo.free_object() : fifo.used.front()) - ram_begin;
}

// Zeros have no effect. [4]
void Mcp251xfd::write_requests(std::uint32_t value) {
  for (unsigned i = 0; i < fifos_.size(); ++i) {
    if ((value >> i & 1) != 0) {
      request(fifos_[i]);
    }
  }
}

void Mcp251xfd::write_fifo_register(unsigned address, std::uint32_t value, std::uint32_t mask) {
  Fifo& fifo = fifo_at(address);
  const bool is_tef = &fifo == &events_;
  const bool is_txq = &fifo == &fifos_[0];
  if (part_of(address) == 4) {
    fifo.flags &= value | ~mask | ~(attempts | overflow);
    return;
  }
  if (part_of(address) == 8) {
    fault("write to a read-only register");
    return;
  }
  const std::uint32_t merged = (fifo_control(fifo) & ~mask) | (value & mask);
  const std::uint32_t writable = is_tef ? tef_writable : is_txq ? txq_writable : fifo_writable;
  fifo.control = protect(fifo.control, (merged & writable) | (is_txq ? txen : 0),
                         is_tef ? tef_protected : fifo_protected, "change of PLSIZE, FSIZE, TXEN or RXTSEN");
  if ((fifo.control & rtren) != 0 && !is_tef) {
    fault("C1FIFOCON.RTREN: automatic answers to remote frames are not modelled");
  }
  if ((mask & freset) == 0) {
    return;
  }
  if (is_configuring()) {
    if ((value & mask & (uinc | txreq)) != 0) {
      fault("UINC or TXREQ in Configuration mode");
    }
    return;
  }
  if ((value & uinc) != 0) {
    increment(fifo);
  }
  if ((value & freset) != 0) {
    reset_fifo(fifo);
  } else if ((value & txreq) != 0) {
    request(fifo);
  } else {
    abort(fifo);
  }
}

// FnBP changes only while the filter is disabled. [6]
void Mcp251xfd::write_filter_control(unsigned address, std::uint32_t value) {
  for (unsigned i = 0; i < 4; ++i) {
    const std::uint32_t old = word(address) >> 8 * i & 0xFF;
    std::uint32_t one = value >> 8 * i & 0x9F;
    if ((old & 0x80) != 0 && ((old ^ one) & 0x1F) != 0 && (one & 0x80) != 0) {
      fault("change of C1FLTCON.FnBP while the filter is enabled");
      one = old;
    }
    if ((one & 0x80) != 0 && (one & 0x1F) == 0) {
      fault("C1FLTCON.FnBP of an enabled filter is 0");
    }
    word(address) = (word(address) & ~(0xFFU << 8 * i)) | one << 8 * i;
  }
  if (!is_configuring()) {
    check_ram();
  }
}

void Mcp251xfd::write_filter(unsigned address, std::uint32_t value) {
  if (is_enabled((address - fltobj) / 8)) {
    fault("write to a filter object or a mask while the filter is enabled");
    return;
  }
  word(address) = value & 0x7FFFFFFF;
}

// Words of the RAM are written while the controller does not use them.
void Mcp251xfd::write_ram(unsigned address, std::uint32_t value) {
  const auto is_within = [&](const Fifo& fifo) {
    return fifo.base <= address && address < fifo.base + fifo.length * fifo.object_bytes;
  };
  for (const Fifo& one : fifos_) {
    if (is_configuring() || !is_within(one) || (!one.is_transmit() && !is_receiving(one))) {
      continue;
    }
    const unsigned object = (address - one.base) / one.object_bytes;
    if (!one.is_transmit() || std::find(one.used.begin(), one.used.end(), object) != one.used.end()) {
      fault("write to a message that is queued, or to a receive FIFO");
    }
  }
  ram(address) = value;
}

// ---- FIFOs

bool Mcp251xfd::Fifo::is_transmit() const { return (control & txen) != 0; }

// Returns the number of data bytes of an object.
unsigned Mcp251xfd::Fifo::payload() const {
  static constexpr unsigned sizes[] = {8, 12, 16, 20, 24, 32, 48, 64};
  return sizes[control >> 29];
}

unsigned Mcp251xfd::Fifo::free_object() const {
  for (unsigned i = 0; i < length; ++i) {
    const unsigned object = (next + i) % length;
    if (std::find(used.begin(), used.end(), object) == used.end()) {
      return object;
    }
  }
  return next;
}

void Mcp251xfd::Fifo::push() {
  const unsigned object = free_object();
  used.push_back(object);
  next = (object + 1) % length;
  next = free_object();
}

void Mcp251xfd::Fifo::clear() {
  used.clear();
  next = 0;
  flags = 0;
  failures = 0;
  is_requested = false;
  is_aborting = false;
  is_resetting = false;
}

const Mcp251xfd::Fifo& Mcp251xfd::fifo_at(unsigned address) const {
  return address < txqcon ? events_ : fifos_[(address - txqcon) / fifo_bytes];
}

Mcp251xfd::Fifo& Mcp251xfd::fifo_at(unsigned address) {
  return address < txqcon ? events_ : fifos_[(address - txqcon) / fifo_bytes];
}

std::uint32_t Mcp251xfd::fifo_control(const Fifo& fifo) const {
  const bool is_reset = is_configuring() || fifo.is_resetting;
  return fifo.control | (is_reset ? freset : 0) | (fifo.is_requested ? txreq : 0);
}

std::uint32_t Mcp251xfd::fifo_status(const Fifo& fifo) const {
  const std::size_t count = fifo.used.size();
  const bool is_txq = &fifo == &fifos_[0];
  const bool is_tef = &fifo == &events_;
  std::uint32_t value = fifo.flags;
  if (fifo.is_transmit()) {
    value |= (count < fifo.length ? basic : 0) | (count == 0 ? extreme : 0);
    value |= 2 * count <= fifo.length && !is_txq ? half : 0;
  } else {
    value |= (count != 0 ? basic : 0) | (count == fifo.length ? extreme : 0) | (2 * count >= fifo.length ? half : 0);
  }
  return value | (is_tef ? 0 : next_object(fifo) << 8);
}

// Returns the flags whose interrupts are enabled.
std::uint32_t Mcp251xfd::pending_flags(const Fifo& fifo) const {
  const std::uint32_t kinds =
      fifo.is_transmit() ? attempts | extreme | half | basic : overflow | extreme | half | basic;
  return fifo_status(fifo) & fifo.control & kinds;
}

// Returns the object that is transmitted next, or in which the next message is stored.
unsigned Mcp251xfd::next_object(const Fifo& fifo) const {
  if (!fifo.is_transmit() || fifo.used.empty()) {
    return fifo.free_object();
  }
  if (&fifo != &fifos_[0]) {
    return fifo.used.front();
  }
  const auto value = [&](unsigned object) {
    return arbitration_value(frame_at(fifo.address_of(object), fifo.payload()));
  };
  return *std::min_element(fifo.used.begin(), fifo.used.end(),
                           [&](unsigned one, unsigned other) { return value(one) < value(other); });
}

// UINC: a message was written to a transmit FIFO, or read from another one.
void Mcp251xfd::increment(Fifo& fifo) {
  if (fifo.is_resetting) {
    fault("UINC before FRESET is complete");
  } else if (fifo.is_transmit() && fifo.is_full()) {
    fault("UINC of a full transmit FIFO");
  } else if (fifo.is_transmit()) {
    const std::uint32_t control = ram(fifo.address_of(fifo.free_object()) + 4);
    if ((control & fdf) != 0) {
      fault("transmission of FD frames is not modelled");
    }
    fifo.push();
  } else if (fifo.used.empty()) {
    fault("UINC of an empty FIFO");
  } else {
    fifo.used.pop_front();
  }
}

void Mcp251xfd::request(Fifo& fifo) {
  if (!fifo.is_transmit() || is_configuring()) {
    fault("TXREQ of a FIFO that does not transmit, or in Configuration mode");
    return;
  }
  if (fifo.used.empty()) {
    return;
  }
  if (!fifo.is_requested) {
    fifo.flags &= ~(txabt | txlarb | txerr);
    fifo.failures = 0;
  }
  fifo.is_requested = true;
  fifo.is_aborting = false;
  if ((word(con) & abat) != 0) {
    abort(fifo);
  }
}

// A message is aborted before its start of frame only; TXREQ stays set until then. [4]
void Mcp251xfd::abort(Fifo& fifo) {
  if (!fifo.is_requested) {
    return;
  }
  fifo.is_aborting = true;
  if (transmitting_ != &fifo) {
    end_abort(fifo);
  }
}

void Mcp251xfd::end_abort(Fifo& fifo) {
  fifo.is_requested = false;
  fifo.is_aborting = false;
  fifo.flags |= txabt;
}

void Mcp251xfd::reset_fifo(Fifo& fifo) {
  if (transmitting_ == &fifo) {
    fifo.is_resetting = true;
    fifo.is_aborting = true;
  } else {
    fifo.clear();
  }
}

// Assigns the RAM: events, transmit queue, FIFO 1 to 31. [3]
void Mcp251xfd::allocate() {
  unsigned address = ram_begin;
  events_.length = 0;
  fifos_[0].length = 0;
  if ((word(con) & stef) != 0) {
    place(events_, address, 8);
  }
  if ((word(con) & txqen) != 0) {
    place(fifos_[0], address, 8 + fifos_[0].payload());
  }
  for (unsigned i = 1; i < fifos_.size(); ++i) {
    place(fifos_[i], address, 8 + fifos_[i].payload());
  }
  check_ram();
}

void Mcp251xfd::place(Fifo& fifo, unsigned& address, unsigned bytes) {
  const bool has_time = !fifo.is_transmit() && (fifo.control & tsen) != 0;
  fifo.base = address;
  fifo.object_bytes = bytes + (has_time ? 4 : 0);
  fifo.length = (fifo.control >> 24 & 31) + 1;
  address += fifo.length * fifo.object_bytes;
}

bool Mcp251xfd::is_receiving(const Fifo& fifo) const {
  for (unsigned i = 0; i < 32; ++i) {
    if (is_enabled(i) && &fifos_[filter_control(i) & 0x1F] == &fifo) {
      return !fifo.is_transmit();
    }
  }
  return false;
}

// FIFOs that are not used may exceed the RAM.
void Mcp251xfd::check_ram() {
  for (const Fifo& one : fifos_) {
    if ((one.is_transmit() || is_receiving(one)) && one.base + one.length * one.object_bytes > ram_end) {
      fault("the FIFOs exceed the RAM of 2 KB");
      return;
    }
  }
}

// ---- Transmission

CanFrame Mcp251xfd::frame_at(unsigned address, unsigned payload) const {
  const std::uint32_t id = ram(address);
  const std::uint32_t control = ram(address + 4);
  CanFrame frame;
  frame.is_extended = (control & ide) != 0;
  frame.id = frame.is_extended ? (id & 0x7FF) << 18 | (id >> 11 & 0x3FFFF) : id & 0x7FF;
  frame.is_remote = (control & rtr) != 0;
  frame.dlc = control & 15;
  for (unsigned i = 0; i < std::min(payload, 8U); ++i) {
    frame.data[i] = static_cast<std::uint8_t>(ram(address + 8 + i) >> i % 4 * 8 & 0xFF);
  }
  return frame;
}

// The highest TXPRI is sent first, then the transmit queue, then the FIFO with the highest number. [4]
std::optional<CanFrame> Mcp251xfd::next_frame() {
  Fifo* first = nullptr;
  const auto priority = [](const Fifo& fifo) { return fifo.control >> 16 & 31; };
  for (Fifo& one : fifos_) {
    const bool is_first = first == nullptr || priority(one) > priority(*first) ||
                          (priority(one) == priority(*first) && first != &fifos_[0]);
    first = one.is_requested && is_first ? &one : first;
  }
  if (first != nullptr && is_underflow_next_) {
    underflow();
  }
  if (first == nullptr || mode_ == Mode::restricted || mode_ == Mode::listen_only) {
    return std::nullopt;
  }
  transmitting_ = first;
  object_ = next_object(*first);
  return frame_at(first->address_of(object_), first->payload());
}

void Mcp251xfd::on_sent() {
  Fifo& fifo = *transmitting_;
  transmitting_ = nullptr;
  count_message();
  if ((word(con) & stef) != 0) {
    if (events_.is_full()) {
      events_.flags |= overflow;
    } else {
      const unsigned address = events_.address_of(events_.free_object());
      ram(address) = ram(fifo.address_of(object_));
      ram(address + 4) = ram(fifo.address_of(object_) + 4);
      events_.push();
    }
  }
  fifo.used.erase(std::find(fifo.used.begin(), fifo.used.end(), object_));
  fifo.failures = 0;
  if (fifo.is_resetting) {
    fifo.clear();
  } else if (fifo.used.empty()) {
    fifo.is_requested = false;
    fifo.is_aborting = false;
  } else if (fifo.is_aborting) {
    end_abort(fifo);
  }
}

void Mcp251xfd::on_arbitration_lost() {
  transmitting_->flags |= txlarb;
  end_attempt(false);
}

void Mcp251xfd::on_transmission_failed(CanError /*error*/) {
  transmitting_->flags |= txerr;
  end_attempt(true);
}

// With C1CON.RTXAT, TXAT limits the attempts: a single one, or three repetitions after errors. [4]
void Mcp251xfd::end_attempt(bool is_failure) {
  constexpr unsigned repetitions = 3;
  Fifo& fifo = *transmitting_;
  transmitting_ = nullptr;
  fifo.failures += is_failure ? 1 : 0;
  const unsigned limit = (word(con) & rtxat) != 0 ? fifo.control >> 21 & 3 : 3;
  if (fifo.is_resetting) {
    fifo.clear();
  } else if (fifo.is_aborting) {
    end_abort(fifo);
  } else if (limit == 0 || (limit == 1 && fifo.failures > repetitions)) {
    fifo.is_requested = false;
    fifo.flags |= attempts;
  }
}

// ---- Reception

// Standard frames have no EID. With MIDE, the type of the frame is compared, too. [6]
bool Mcp251xfd::accepts(unsigned filter, const CanFrame& frame) const {
  const std::uint32_t object = word(fltobj + 8 * filter);
  const std::uint32_t mask = word(fltobj + 8 * filter + 4);
  if ((mask & type_bit) != 0 && ((object & type_bit) != 0) != frame.is_extended) {
    return false;
  }
  const std::uint32_t compared = mask & (frame.is_extended ? 0x1FFFFFFF : 0x7FF);
  return ((object ^ identifier_word(frame)) & compared) == 0;
}

// The first filter whose FIFO is not full stores the message; if all are full, the first one has an overflow. [6]
void Mcp251xfd::on_received(const CanFrame& frame) {
  count_message();
  Fifo* full = nullptr;
  for (unsigned i = 0; i < 32; ++i) {
    if (!is_enabled(i) || !accepts(i, frame)) {
      continue;
    }
    Fifo& fifo = fifos_[filter_control(i) & 0x1F];
    if (fifo.is_transmit()) {
      return;
    }
    if (!fifo.is_full()) {
      store(fifo, i, frame);
      return;
    }
    full = full == nullptr ? &fifo : full;
  }
  if (full != nullptr) {
    full->flags |= overflow;
  }
}

void Mcp251xfd::store(Fifo& fifo, unsigned filter, const CanFrame& frame) {
  const unsigned address = fifo.address_of(fifo.free_object());
  const std::uint32_t eid_of_standard = frame.is_extended ? 0 : undefined & 0x1FFFF800;
  ram(address) = identifier_word(frame) | eid_of_standard;
  ram(address + 4) = frame.dlc | (frame.is_extended ? ide : 0) | (frame.is_remote ? rtr : 0) | (frame.is_fd ? fdf : 0) |
                     (frame.has_brs ? brs : 0) | (frame.has_esi ? esi : 0) | filter << 11;
  const unsigned data = address + fifo.object_bytes - fifo.payload();
  if (data != address + 8) {
    ram(address + 8) = undefined;  // time stamp
  }
  if (frame.bytes() > fifo.payload()) {
    word(bdiag1) |= dlcmm;
    word(interrupts) |= ivmif;
  }
  for (unsigned i = 0; i < fifo.payload(); ++i) {
    const std::uint32_t one = i < frame.bytes() ? frame.data[i] : undefined & 0xFF;
    std::uint32_t& target = ram(data + i);
    target = (target & ~(0xFFU << i % 4 * 8)) | one << i % 4 * 8;
  }
  fifo.push();
}

void Mcp251xfd::count_message() {
  std::uint32_t& value = word(bdiag1);
  value += (value & 0xFFFF) != 0xFFFF ? 1 : 0;
}

}  // namespace test
