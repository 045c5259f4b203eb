// SPDX-License-Identifier: Apache-2.0
/// \file pins.hpp
/// The lines of I2C and SPI with a modelled memory, which the functions of demo/memory/pins.h access.
#pragma once

#include "eeprom24.hpp"
#include "eeprom25.hpp"

namespace test {

/// The lines of I2C with a memory. Data change while SCL is low; a change of SDA while it is high is a start or stop
/// condition.
class I2cLines {
 public:
  Eeprom24 memory{{"24LC256", 32768, 64, 0x50, 2, 0, 5}};
  bool is_scl_stuck = false;  ///< SCL is held low
  unsigned held = 0;          ///< clocks for which the memory holds SDA low
  unsigned stops = 0;

  [[nodiscard]] bool scl() const { return scl_ && !is_scl_stuck; }
  [[nodiscard]] bool sda() const { return master_ && device_ && held == 0; }

  void set_sda(bool high) {
    const bool before = sda();
    master_ = high;
    if (scl() && before != sda()) {
      sda() ? stop() : start();
    }
  }

  void set_scl(bool high) {
    if (high != scl_) {
      scl_ = high;
      high ? rise() : fall();
    }
  }

 private:
  enum class Phase : std::uint8_t { idle, address, receive, send, ended };

  void start() {
    phase_ = Phase::address;
    bits_ = 0;
    byte_ = 0;
  }

  void stop() {
    memory.stop();
    phase_ = Phase::idle;
    ++stops;
  }

  void rise() {
    held -= held != 0 ? 1 : 0;
    if (phase_ == Phase::idle) {
      return;
    }
    ++bits_;
    if (bits_ <= 8 && phase_ != Phase::send) {
      byte_ = static_cast<std::uint8_t>(byte_ * 2U + (sda() ? 1U : 0U));
    }
    if (bits_ == 9 && phase_ == Phase::send) {
      memory.end_byte(!sda());
      phase_ = sda() ? Phase::ended : Phase::send;
    }
  }

  void fall() {
    device_ = true;
    if (bits_ == 8) {
      acknowledge();
    } else if (bits_ == 9) {
      bits_ = 0;
      if (phase_ == Phase::address) {
        phase_ = (byte_ & 1U) != 0 ? Phase::send : Phase::receive;
      }
    }
    if (phase_ == Phase::send && bits_ < 8) {
      byte_ = bits_ == 0 ? memory.shift_out() : byte_;
      device_ = (byte_ >> (7U - bits_) & 1U) != 0;
    }
  }

  void acknowledge() {
    if (phase_ == Phase::address || phase_ == Phase::receive) {
      const bool is_acknowledged = phase_ == Phase::address ? memory.start(byte_) : memory.put(byte_);
      device_ = !is_acknowledged;
      phase_ = is_acknowledged ? phase_ : Phase::ended;
    }
  }

  Phase phase_ = Phase::idle;
  bool scl_ = true;
  bool master_ = true;  // level of the master
  bool device_ = true;  // level of the memory
  unsigned bits_ = 0;   // rising edges in a byte
  std::uint8_t byte_ = 0;
};

/// The lines of SPI with a memory, mode 0,0: both ends sample at the rising edge.
class SpiLines {
 public:
  Eeprom25 memory{{"25LC256", 32768, 64, 2, 5, false, false}};
  bool mosi = false;

  [[nodiscard]] bool miso() const { return is_high_; }

  void set_cs(bool high) {
    if (high != cs_) {
      cs_ = high;
      memory.select(!high);
      bits_ = 0;
    }
  }

  void set_sck(bool high) {
    if (high) {
      out_ = bits_ == 0 ? memory.shift_out() : out_;
      is_high_ = (out_ >> (7U - bits_) & 1U) != 0;
      in_ = static_cast<std::uint8_t>(in_ * 2U + (mosi ? 1U : 0U));
      ++bits_;
    } else if (bits_ == 8) {
      memory.shift_in(in_);
      bits_ = 0;
    }
  }

 private:
  bool cs_ = true;
  bool is_high_ = true;
  unsigned bits_ = 0;
  std::uint8_t in_ = 0;
  std::uint8_t out_ = 0;
};

extern I2cLines* i2c;  ///< lines of the board, or null
extern SpiLines* spi;  ///< lines of the board, or null

}  // namespace test
