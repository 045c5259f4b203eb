// SPDX-License-Identifier: Apache-2.0
#include "eeprom25.hpp"

#include <algorithm>

namespace test {
namespace {

constexpr std::uint8_t write_data = 2;
constexpr std::uint8_t read_data = 3;
constexpr std::uint8_t write_disable = 4;
constexpr std::uint8_t read_status = 5;
constexpr std::uint8_t write_enable = 6;

Eeprom25& model(void* ctx) { return *static_cast<Eeprom25*>(ctx); }

void select(void* ctx, bool selected) { model(ctx).select(selected); }

void transfer(void* ctx, const std::uint8_t* out, std::uint8_t* in, std::uint32_t num) {
  for (std::uint32_t n = 0; n < num; ++n) {
    const std::uint8_t byte = model(ctx).transfer(out == nullptr ? 0xA5 : out[n]);
    if (in != nullptr) {
      in[n] = byte;
    }
  }
}

void wait(void* ctx, std::uint32_t microseconds) { model(ctx).now += microseconds; }

const CO_EEPROM_SPI_BUS bus = {select, transfer, wait};

}  // namespace

void* Eeprom25::context() {
  context_ = {&bus, this, chip_.capacity, chip_.page, chip_.address_bytes, chip_.write_time};
  return &context_;
}

void Eeprom25::select(bool selected) {
  if (selected == is_selected_) {
    faults.emplace_back("chip select is not changed");
  }
  is_selected_ = selected;
  if (!selected) {
    deselect();
    return;
  }
  index_ = 0;
  received_ = 0;
  is_ignored_ = false;
  frame_bytes_ = 0;
  heard_ = UINT32_MAX;
  is_cut_executed_ = false;
  is_deaf_ = false;
  if (bus_fault.begins()) {
    begin_fault();
  }
}

// Begins a faulty access. A lasting fault in the middle of an access is a missing device in the next ones.
void Eeprom25::begin_fault() {
  const bool is_low = bus_fault.kind == BusFault::absent_low || bus_fault.kind == BusFault::executed_low;
  fault_level_ = is_low ? 0x00 : 0xFF;
  switch (bus_fault.kind) {
    case BusFault::executed:
    case BusFault::executed_low: is_deaf_ = true; break;
    case BusFault::half:
    case BusFault::half_reads_ff:
    case BusFault::half_executed:
      heard_ = bus_fault.is_first() ? half : 0;
      is_cut_executed_ = bus_fault.is_first() && bus_fault.kind == BusFault::half_executed;
      break;
    default: heard_ = 0;
  }
}

// Ends a write cycle whose time has elapsed.
void Eeprom25::end_cycle() {
  if (is_in_cycle_ && !is_busy()) {
    is_in_cycle_ = false;
    is_enabled_ = is_enabled_ && chip_.keeps_latch;
  }
}

std::uint8_t Eeprom25::status() const {
  if (is_busy() && chip_.shows_only_busy) {
    return 0xFF;
  }
  return static_cast<std::uint8_t>((is_busy() ? 1U : 0U) | (is_enabled_ ? 2U : 0U) | (is_protected ? 0x0CU : 0U));
}

void Eeprom25::decode(std::uint8_t byte) {
  const bool has_ninth_bit = chip_.address_bytes == 1;
  const bool is_access = (byte & ~8U) == read_data || (byte & ~8U) == write_data;
  instruction_ = has_ninth_bit && is_access ? byte & 7U : byte;
  address_ = has_ninth_bit && is_access ? byte >> 3U & 1U : 0;
  is_ignored_ = is_busy() && instruction_ != read_status;
  if (instruction_ < write_data || instruction_ > write_enable) {
    faults.push_back("instruction " + std::to_string(byte));
  }
  if (is_ignored_) {
    faults.push_back("instruction in a write cycle: " + std::to_string(byte));
  }
}

void Eeprom25::receive(std::uint8_t byte) {
  if (index_ <= chip_.address_bytes) {
    address_ = address_ << 8U | byte;
    if (index_ == chip_.address_bytes) {
      if (address_ >= chip_.capacity) {
        faults.emplace_back("address beyond the end");
        address_ %= chip_.capacity;
      }
      const std::uint32_t size = chip_.page == 0 ? 1 : chip_.page;
      page_start_ = address_ - address_ % size;
      latched_.assign(bytes_.begin() + page_start_, bytes_.begin() + page_start_ + size);
      is_received_.assign(size, false);
    }
    return;
  }
  if (!is_enabled_) {
    return;
  }
  ++received_;
  if (chip_.page == 0) {
    if (!is_protected) {
      std::uint8_t& to = bytes_[address_];
      to = power.begins() || power.partial == Partial::done ? byte : to;
    }
    address_ = (address_ + 1) % chip_.capacity;
    return;
  }
  const std::uint32_t offset = address_ - page_start_;
  if (is_received_[offset]) {
    faults.emplace_back("the page has rolled over");
  }
  is_received_[offset] = true;
  latched_[offset] = byte;
  address_ = page_start_ + (offset + 1) % chip_.page;
}

std::uint8_t Eeprom25::transfer(std::uint8_t byte) {
  const std::uint8_t answer = shift_out();
  shift_in(byte);
  return answer;
}

std::uint8_t Eeprom25::shift_out() {
  ++now;
  ++bus_bytes;
  ++frame_bytes_;
  if (!is_selected_) {
    faults.emplace_back("transfer without chip select");
  }
  if (is_lost()) {
    if (!is_cut_executed_) {
      is_ignored_ = true;
      received_ = 0;
    }
    return frame_bytes_ > heard_ ? fault_level_ : lost_level;
  }
  const std::uint8_t byte = answer();
  return is_deaf_ ? fault_level_ : byte;
}

std::uint8_t Eeprom25::answer() {
  end_cycle();
  if (index_ != 0 && instruction_ == read_status) {
    return status();
  }
  if (index_ > chip_.address_bytes && instruction_ == read_data && !is_ignored_) {
    const std::uint8_t byte = bytes_[address_];
    address_ = (address_ + 1) % chip_.capacity;
    return byte;
  }
  return 0xFF;  // high impedance, pulled up
}

void Eeprom25::shift_in(std::uint8_t byte) {
  if (is_lost()) {
    return;
  }
  const bool has_address = instruction_ == write_data || (instruction_ == read_data && index_ <= chip_.address_bytes);
  if (index_ == 0) {
    decode(byte);
  } else if (has_address && !is_ignored_) {
    receive(byte);
  }
  ++index_;
}

// Executes the instruction at the rising edge of chip select.
void Eeprom25::deselect() {
  if ((is_lost() && !is_cut_executed_) || is_ignored_ || index_ == 0) {
    return;
  }
  if (instruction_ == write_enable || instruction_ == write_disable) {
    if (index_ == 1) {
      is_enabled_ = instruction_ == write_enable;
    }
  } else if (instruction_ == write_data && received_ != 0 && is_enabled_ && !(is_protected && chip_.page != 0)) {
    program();
  }
}

void Eeprom25::program() {
  ++cycles;
  if (chip_.page == 0) {
    is_enabled_ = chip_.keeps_latch;
    return;
  }
  busy_until_ = now + cycle_time();
  is_in_cycle_ = true;
  const auto at = bytes_.begin() + page_start_;
  if (power.begins() || power.partial == Partial::done) {
    std::copy(latched_.begin(), latched_.end(), at);
  } else if (power.partial == Partial::half) {
    std::copy(latched_.begin(), latched_.begin() + chip_.page / 2, at);
  } else if (power.partial != Partial::untouched) {
    const bool is_erased = power.partial == Partial::erased;
    std::transform(latched_.begin(), latched_.end(), at, [&](std::uint8_t byte) {
      return is_erased ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(byte ^ 0x5AU);
    });
  }
}

}  // namespace test
