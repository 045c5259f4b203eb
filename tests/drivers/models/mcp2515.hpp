// SPDX-License-Identifier: Apache-2.0
/// \file mcp2515.hpp
/// A model of the CAN controller MCP2515 behind its SPI interface. Written from the data sheet DS20001801J; comments
/// cite its sections.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "spi_model.hpp"

namespace test {

class Mcp2515 : public SpiModel, private CanClient {
 public:
  struct Options {
    std::uint32_t oscillator = 0;  ///< in Hz; 0: the bit rate is not checked
    /// CANINTF.ERRIF stays set while a flag of EFLG is set, as 7.7 says. Otherwise it is set by each flag that appears.
    bool is_error_flag_sticky = false;
    std::string name = "mcp2515";
  };

  Mcp2515(CanWire& wire, const Options& options);
  explicit Mcp2515(CanWire& wire);

  bool interrupt() const override;
  CanNode& node() { return node_; }
  std::uint32_t bit_rate() const;  ///< of CNF1…3 in bit/s
  unsigned sample_point() const;   ///< in permille of the bit time
  /// Returns a register without an SPI transaction.
  std::uint8_t peek(std::uint8_t address) const { return read_register(address); }

 private:
  enum class Mode : std::uint8_t { normal, sleep, loopback, listen_only, configuration };  // values of OPMOD

  struct Timing {
    unsigned prescaler = 1;
    unsigned before_sample = 1;  // quanta, with the synchronization segment
    unsigned after_sample = 1;
    unsigned jump = 1;
  };

  // CanClient
  std::optional<CanFrame> next_frame() override;
  void on_sent() override;
  void on_arbitration_lost() override;
  void on_transmission_failed(CanError error) override;
  void on_received(const CanFrame& frame) override;
  void on_error(CanError error) override;
  void on_counters() override;
  void on_bit(bool level) override;

  // Instructions
  std::uint8_t shift(std::uint8_t out) override;
  std::uint8_t first_byte(std::uint8_t out);
  std::uint8_t modify_bits(std::uint8_t out);
  void end_instruction() override;
  std::uint8_t read_status() const;
  std::uint8_t rx_status() const;
  void reset();

  // Registers
  std::uint8_t read_register(std::uint8_t address) const;
  std::uint8_t read_canstat() const;
  std::uint8_t& at(unsigned address) { return registers_[address]; }
  std::uint8_t at(unsigned address) const { return registers_[address]; }
  void write_register(std::uint8_t address, std::uint8_t value);
  void write_control(std::uint8_t value);
  void write_flags(std::uint8_t value);
  void write_configuration(std::uint8_t address, std::uint8_t value);
  void write_transmit(std::uint8_t address, std::uint8_t value);
  void write_transmit_control(unsigned buffer, std::uint8_t value);
  void write_receive(std::uint8_t address, std::uint8_t value);

  // Modes
  void change_mode();
  void enter(Mode mode);
  bool has_pending() const;
  Timing timing() const;
  void check_timing();
  void wake_up();

  // Buffers
  bool is_requested(unsigned buffer) const;
  CanFrame frame_of(unsigned buffer) const;
  void end_attempt(std::uint8_t cause);
  void abort(unsigned buffer, bool is_flagged);
  bool accepts(unsigned filter, unsigned mask, const CanFrame& frame) const;
  std::optional<unsigned> match(unsigned buffer, const CanFrame& frame) const;
  void store(unsigned buffer, unsigned filter, const CanFrame& frame);
  void overflow(unsigned buffer);
  void set_error_flags(std::uint8_t flags);

  Options options_;
  CanNode node_;
  Mode mode_ = Mode::configuration;
  std::optional<Mode> wanted_;
  std::array<std::uint8_t, 128> registers_{};
  std::optional<unsigned> transmitting_;
  std::array<bool, 3> is_aborting_{};  // of a buffer that is being transmitted
  unsigned rx_filter_ = 0;             // of RX STATUS, for the message in RXB0
  unsigned rx_filter_1_ = 0;           // for the message in RXB1

  std::uint8_t pointer_ = 0;
  std::uint8_t mask_ = 0;
};

}  // namespace test
