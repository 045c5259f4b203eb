// SPDX-License-Identifier: Apache-2.0
#include "eeprom24.hpp"

#include <algorithm>

namespace test {
namespace {

Eeprom24& model(void* ctx) { return *static_cast<Eeprom24*>(ctx); }

bool put_all(Eeprom24& memory, const std::uint8_t* bytes, std::uint32_t num) {
  std::uint32_t n = 0;
  while (n < num && memory.put(bytes[n])) {
    ++n;
  }
  return n == num;
}

// A transfer that the bus does not complete. Bytes behind the first half do not reach the device.
bool write_faulty(Eeprom24& memory, std::uint8_t device, const std::uint8_t* head, std::uint8_t head_num,
                  const std::uint8_t* bytes, std::uint32_t num) {
  const BusFault kind = memory.bus_fault.kind;
  const bool is_half = kind == BusFault::half || kind == BusFault::half_executed || kind == BusFault::half_reads_ff;
  const bool is_whole = kind == BusFault::executed || kind == BusFault::executed_low;
  memory.now += memory.byte_time;
  if (!is_whole && !(is_half && memory.bus_fault.is_first())) {
    return false;
  }
  const std::uint32_t all = head_num + num;
  const std::uint32_t sent = is_whole ? all : all / 2;
  const std::uint32_t of_head = std::min<std::uint32_t>(sent, head_num);
  if (memory.start(static_cast<std::uint8_t>(device << 1U)) && put_all(memory, head, of_head) &&
      put_all(memory, bytes, sent - of_head) && kind != BusFault::half && kind != BusFault::half_reads_ff) {
    memory.stop();
  } else {
    memory.lose();
  }
  return false;
}

// A faulty read. Returns true if the bus does not detect the fault.
bool read_faulty(Eeprom24& memory, std::uint8_t* to, std::uint32_t num, bool is_read) {
  const BusFault kind = memory.bus_fault.kind;
  if (kind == BusFault::reads_ff || (kind == BusFault::half_reads_ff && memory.bus_fault.is_first() && is_read)) {
    std::fill(kind == BusFault::reads_ff ? to : to + num / 2, to + num, std::uint8_t{0xFF});
    return true;
  }
  if (kind != BusFault::executed && kind != BusFault::executed_low) {
    std::fill(to + num / 2, to + num, std::uint8_t{0x5A});
  }
  return false;
}

bool write(void* ctx, std::uint8_t device, const std::uint8_t* head, std::uint8_t head_num, const std::uint8_t* bytes,
           std::uint32_t num) {
  Eeprom24& memory = model(ctx);
  if (memory.bus_fault.begins()) {
    return write_faulty(memory, device, head, head_num, bytes, num);
  }
  const bool done = memory.start(static_cast<std::uint8_t>(device << 1U)) && put_all(memory, head, head_num) &&
                    put_all(memory, bytes, num);
  memory.stop();
  return done;
}

bool read(void* ctx, std::uint8_t device, const std::uint8_t* head, std::uint8_t head_num, std::uint8_t* to,
          std::uint32_t num) {
  Eeprom24& memory = model(ctx);
  const bool is_faulty = memory.bus_fault.begins();
  const bool done = memory.start(static_cast<std::uint8_t>(device << 1U)) && put_all(memory, head, head_num) &&
                    memory.start(static_cast<std::uint8_t>(device * 2U + 1U));
  for (std::uint32_t n = 0; done && n < num; ++n) {
    to[n] = memory.get(n + 1 < num);
  }
  memory.stop();
  return is_faulty ? read_faulty(memory, to, num, done) : done;
}

void wait(void* ctx, std::uint32_t microseconds) {
  model(ctx).now += microseconds;
  ++model(ctx).waits;
}

const CO_EEPROM_I2C_BUS bus = {write, read, wait};

}  // namespace

void* Eeprom24::context() {
  context_ = {
      &bus, this, chip_.capacity, chip_.page, chip_.device, chip_.address_bytes, chip_.block_shift, chip_.write_time};
  return &context_;
}

// Counts a byte on the bus. Returns whether the device receives or transmits it.
bool Eeprom24::answers() {
  now += byte_time;
  ++bus_bytes;
  return !power.is_off && (lost_after == 0 || bus_bytes <= lost_after);
}

bool Eeprom24::start(std::uint8_t control) {
  const bool is_repeated = is_selected_;
  const bool is_present = answers();
  is_selected_ = false;
  const std::uint32_t blocks = (chip_.capacity + block() - 1) / block();
  const std::uint32_t device = control >> 1U;
  const std::uint32_t block = (device - chip_.device) >> chip_.block_shift;
  const bool is_own = device == (chip_.device | block << chip_.block_shift) && block < blocks;
  if (!is_own) {
    faults.push_back("device address " + std::to_string(device));
  }
  if (!is_present || is_busy() || !is_own) {
    return false;
  }
  is_selected_ = true;
  is_reading_ = (control & 1U) != 0;
  has_ended_ = false;
  if (is_reading_ && (!is_repeated || address_left_ != 0 || block != block_)) {
    faults.emplace_back("read without an address");
  }
  block_ = block;
  received_ = 0;
  if (!is_reading_) {
    address_left_ = chip_.address_bytes;
    address_ = 0;
  }
  return true;
}

void Eeprom24::begin_data() {
  address_ += block_ * block();
  if (address_ >= chip_.capacity) {
    faults.emplace_back("address beyond the end");
    address_ %= chip_.capacity;
  }
  const std::uint32_t size = chip_.page == 0 ? 1 : chip_.page;
  page_start_ = address_ - address_ % size;
  latched_.assign(bytes_.begin() + page_start_, bytes_.begin() + page_start_ + size);
  is_received_.assign(size, false);
}

bool Eeprom24::put(std::uint8_t byte) {
  const bool is_present = answers();
  if (!is_selected_ || is_reading_) {
    faults.emplace_back("byte to a device that is not selected for writing");
    return false;
  }
  if (!is_present) {
    is_selected_ = false;
    received_ = 0;  // no stop condition after an acknowledged byte
    return false;
  }
  if (address_left_ != 0) {
    address_ = address_ << 8U | byte;
    if (--address_left_ == 0) {
      begin_data();
    }
    return true;
  }
  if (refuses_data) {
    received_ = 0;
    return false;
  }
  ++received_;
  if (chip_.page == 0) {
    if (received_ > 1 && address_ % block() == 0) {
      faults.emplace_back("write beyond the end of a block");
    }
    if (!is_protected) {
      std::uint8_t& to = bytes_[address_];
      to = power.begins() || power.partial == Partial::done ? byte : to;
    }
    address_ = (address_ + 1) % chip_.capacity;
    return !power.is_off;
  }
  const std::uint32_t offset = address_ - page_start_;
  if (is_received_[offset]) {
    faults.emplace_back("the page has rolled over");
  }
  is_received_[offset] = true;
  latched_[offset] = byte;
  address_ = page_start_ + (offset + 1) % chip_.page;
  if (address_ == page_start_ && offset + 1 != chip_.page) {
    faults.emplace_back("internal");
  }
  return true;
}

std::uint8_t Eeprom24::get(bool acknowledge) {
  const std::uint8_t byte = shift_out();
  end_byte(acknowledge);
  return byte;
}

std::uint8_t Eeprom24::shift_out() {
  const bool is_present = answers();
  if (!is_selected_ || !is_reading_ || has_ended_) {
    faults.emplace_back("read from a device that is not selected for reading");
    return 0xFF;
  }
  return is_present ? bytes_[address_] : 0xFF;  // the lines are pulled up
}

void Eeprom24::end_byte(bool acknowledge) {
  has_ended_ = !acknowledge;
  const std::uint32_t next = address_ + 1;
  const bool is_last = next % block() == 0 || next == chip_.capacity;
  if (is_last && acknowledge) {
    faults.emplace_back("read beyond the end of a block");
  }
  address_ = is_last ? next - std::min(block(), chip_.capacity) : next;
}

// Begins the write cycle of the latched page. A loss of power affects the whole page.
void Eeprom24::program() {
  ++cycles;
  busy_until_ = now + cycle_time();
  const auto at = bytes_.begin() + page_start_;
  const auto end = latched_.end();
  if (power.begins() || power.partial == Partial::done) {
    std::copy(latched_.begin(), end, at);
  } else if (power.partial == Partial::half) {
    std::copy(latched_.begin(), latched_.begin() + chip_.page / 2, at);
  } else if (power.partial != Partial::untouched) {
    const bool is_erased = power.partial == Partial::erased;
    std::transform(latched_.begin(), end, at, [&](std::uint8_t byte) {
      return is_erased ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(byte ^ 0x5AU);
    });
  }
}

void Eeprom24::lose() {
  is_selected_ = false;
  received_ = 0;
}

void Eeprom24::stop() {
  if (is_selected_ && is_reading_ && !has_ended_) {
    faults.emplace_back("the last byte was acknowledged");
  }
  if (is_selected_ && !is_reading_ && received_ != 0 && chip_.page != 0 && !is_protected && !power.is_off) {
    program();
  }
  is_selected_ = false;
  received_ = 0;
}

}  // namespace test
