// SPDX-License-Identifier: Apache-2.0
/// \file pelican.hpp
/// A model of the registers of SJA1000 in PeliCAN mode, and of TWAI of ESP32 and ESP32-C3. Each register is a word at
/// four times its CAN address. Written from the data sheet "SJA1000, Stand-alone CAN controller" (2000 Jan 04), the
/// technical reference manual and the errata of ESP32, by the author of the driver.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "can_wire.hpp"
#include "register_model.hpp"

namespace test {

enum class PeliCanKind : std::uint8_t { sja1000, esp32, esp32c3 };

class PeliCan : public RegisterModel, private CanClient {
 public:
  struct Options {
    PeliCanKind kind = PeliCanKind::sja1000;
    std::uint32_t clock = 0;  ///< Hz; 0: the bit rate is not checked
    std::string name = "sja1000";
  };

  PeliCan(CanWire& wire, std::uintptr_t address, const Options& options);

  bool interrupt() const;  ///< level of the interrupt line
  CanNode& node() { return node_; }
  std::uint32_t bit_rate() const;  ///< bit/s, 0 without a clock
  unsigned sample_point() const;   ///< permille
  std::uint8_t acceptance(unsigned byte) const { return acceptance_.at(byte); }

  /// Resets all registers, as the reset of the peripheral does.
  void hardware_reset();
  unsigned hardware_resets() const { return hardware_resets_; }

 protected:
  std::uint32_t read_register(std::uint32_t offset) override;
  void write_register(std::uint32_t offset, std::uint32_t value) override;
  void before_access() override { wire_.count_access(); }

 private:
  /// Received frame in the receive FIFO.
  struct StoredFrame {
    std::vector<std::uint8_t> bytes;
    bool is_complete = true;  ///< false: the FIFO had space for a part only (TWAI)
  };

  // CanClient
  std::optional<CanFrame> next_frame() override;
  void on_start_of_frame(bool is_transmitter) override { is_on_wire_ = is_transmitter; }
  void on_sent() override;
  void on_arbitration_lost() override;
  void on_transmission_failed(CanError error) override;
  void on_received(const CanFrame& frame) override;
  void on_error(CanError error) override;
  void on_counters() override;
  void on_recovery_sequence(unsigned sequences) override { sequences_ = sequences; }

  bool is_twai() const { return options_.kind != PeliCanKind::sja1000; }
  bool is_in_reset() const { return (mode_ & 1) != 0; }
  bool is_pelican() const;
  void raise(std::uint32_t flag);  ///< sets an interrupt flag if it is enabled
  std::uint32_t status() const;    ///< value of the status register
  /// Access addresses 16 to 28, from 0: acceptance filter in reset mode, else receive and transmit buffer.
  std::uint32_t read_window(std::uint32_t address) const;
  void write_mode(std::uint32_t value);
  void write_command(std::uint32_t value);
  void write_window(std::uint32_t address, std::uint32_t value);
  /// Writes a register that is writable in reset mode only.
  void write_in_reset(std::uint32_t address, std::uint32_t value);
  void write_counter(std::uint32_t address, std::uint32_t value);
  void enter_reset();
  void leave_reset();
  void abort();
  void release_transmit_buffer(bool is_complete);
  CanFrame frame_in_buffer() const;
  bool passes(const CanFrame& frame) const;
  void store(const CanFrame& frame);
  std::size_t used_bytes() const;

  CanWire& wire_;
  Options options_;
  CanNode node_;
  std::uint32_t mode_ = 1;            // MOD
  std::uint32_t enabled_ = 0;         // IER
  std::uint32_t flags_ = 0;           // IR, without the receive flag
  std::uint32_t timing0_ = 0;         // BTR0
  std::uint32_t timing1_ = 0;         // BTR1
  std::uint32_t output_ = 0;          // OCR
  std::uint32_t divider_ = 0;         // CDR
  std::uint32_t warning_limit_ = 96;  // EWLR
  std::uint32_t error_code_ = 0;      // ECC
  bool is_error_captured_ = false;    // ECC holds an error until it is read
  bool had_error_status_ = false;     // at the last change of the error counters, as the next two
  bool had_bus_off_ = false;
  bool was_passive_ = false;
  bool has_overrun_ = false;
  bool follows_command_ = false;    // the last access was a command
  bool is_pending_ = false;         // the transmit buffer is locked: a transmission is requested
  bool is_self_reception_ = false;  // the request was self reception
  bool is_aborting_ = false;        // an abort of the transmission is requested
  bool is_on_wire_ = false;         // this node is transmitting
  bool is_complete_ = true;         // status bit: the last requested transmission is complete
  unsigned sequences_ = 0;          // of 11 recessive bits, during the recovery from bus-off
  unsigned hardware_resets_ = 0;
  std::array<std::uint8_t, 8> acceptance_{};
  std::array<std::uint8_t, 13> buffer_{};
  std::deque<StoredFrame> fifo_;
};

}  // namespace test
