// SPDX-License-Identifier: Apache-2.0
/// \file mcp251xfd.hpp
/// A model of the CAN FD controllers MCP2517FD and MCP2518FD behind their SPI interface. Written from the family
/// reference manual DS20005678 and the data sheet DS20005688; comments cite the chapters of the manual.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "spi_model.hpp"

namespace test {

class Mcp251xfd : public SpiModel, private CanClient {
 public:
  struct Options {
    std::uint32_t oscillator = 0;  ///< in Hz; 0: the bit rate is not checked
    bool is_2517 = false;          ///< MCP2517FD: without OSC.LPMEN and DEVID
    /// Number of reads of OSC that return OSCRDY = 0 after power-up and after each RESET.
    unsigned start_up_reads = 0;
    /// Pending messages stay pending in bus-off. Otherwise bus-off resets all transmit FIFOs, as chapter 11 says.
    bool keeps_messages_in_bus_off = false;
    bool flags_begin_of_bus_off = false;  ///< C1BDIAG1.TXBOERR is set when bus-off begins, not when it ends
    std::string name = "mcp251xfd";
  };

  Mcp251xfd(CanWire& wire, const Options& options);
  explicit Mcp251xfd(CanWire& wire);

  bool interrupt() const override;
  CanNode& node() { return node_; }
  std::uint32_t bit_rate() const;  ///< of C1NBTCFG and OSC in bit/s
  unsigned sample_point() const;   ///< in permille of the bit time
  /// Lets the message buffer underflow at the next transmission: the controller enters Restricted Operation mode, or
  /// Listen Only mode with C1CON.SERR2LOM. The message stays pending.
  void underflow_next() { is_underflow_next_ = true; }
  /// Returns a register or a word of the RAM without an SPI transaction. The address is a multiple of 4.
  std::uint32_t peek(std::uint16_t address) const { return read_word(address); }

 private:
  enum class Mode : std::uint8_t {  // values of OPMOD
    normal_fd,
    sleep,
    internal_loopback,
    listen_only,
    configuration,
    external_loopback,
    normal_classic,
    restricted
  };

  // The transmit queue, a FIFO, or the transmit event FIFO.
  struct Fifo {
    std::uint32_t control = 0;  // without UINC, TXREQ and FRESET
    std::uint32_t flags = 0;    // TXABT, TXLARB, TXERR, TXATIF, RXOVIF
    unsigned base = 0;          // address of the first object
    unsigned object_bytes = 8;
    unsigned length = 1;        // objects
    std::deque<unsigned> used;  // objects with messages, the oldest one first
    unsigned next = 0;          // object at which the search for a free one begins
    bool is_requested = false;  // TXREQ
    bool is_aborting = false;   // TXREQ was cleared while a message is on the bus
    bool is_resetting = false;  // FRESET was set while a message is on the bus
    unsigned failures = 0;      // attempts that failed, of the current message

    bool is_transmit() const;
    unsigned payload() const;
    bool is_full() const { return used.size() >= length; }
    unsigned free_object() const;
    unsigned address_of(unsigned object) const { return base + object * object_bytes; }
    void push();
    void clear();
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

  // SPI
  std::uint8_t shift(std::uint8_t out) override;
  std::uint8_t read_byte();
  void write_byte(std::uint8_t out);
  void complete_write();
  void end_instruction() override;
  void reset();

  // Registers
  std::uint32_t word(unsigned address) const { return registers_[address / 4]; }
  std::uint32_t& word(unsigned address) { return registers_[address / 4]; }
  std::uint32_t read_word(unsigned address) const;
  std::uint32_t read_fifo_register(unsigned address) const;
  std::uint32_t read_vector() const;
  std::uint32_t read_interrupts() const;
  std::uint32_t read_errors() const;
  std::uint32_t read_oscillator() const;
  std::uint32_t requests() const;
  std::uint32_t receive_interrupts() const;
  std::uint32_t transmit_interrupts() const;
  std::uint32_t flags_with_enable(std::uint32_t flag) const;
  void write_register(unsigned address, std::uint32_t value, std::uint32_t mask);
  void write_plain(unsigned address, std::uint32_t value);
  void write_control(std::uint32_t value);
  void write_requests(std::uint32_t value);
  void write_fifo_register(unsigned address, std::uint32_t value, std::uint32_t mask);
  void write_filter_control(unsigned address, std::uint32_t value);
  void write_filter(unsigned address, std::uint32_t value);
  void write_ram(unsigned address, std::uint32_t value);
  std::uint32_t protect(std::uint32_t old, std::uint32_t value, std::uint32_t bits, const char* reason);

  // FIFOs
  const Fifo& fifo_at(unsigned address) const;
  Fifo& fifo_at(unsigned address);
  std::uint32_t fifo_control(const Fifo& fifo) const;
  std::uint32_t fifo_status(const Fifo& fifo) const;
  std::uint32_t pending_flags(const Fifo& fifo) const;
  unsigned next_object(const Fifo& fifo) const;
  void increment(Fifo& fifo);
  void request(Fifo& fifo);
  void abort(Fifo& fifo);
  void end_abort(Fifo& fifo);
  void reset_fifo(Fifo& fifo);
  void allocate();
  void place(Fifo& fifo, unsigned& address, unsigned bytes);
  bool is_receiving(const Fifo& fifo) const;
  void check_ram();

  // Modes
  void change_mode();
  void begin_joining(Mode mode);
  void enter(Mode mode);
  void underflow();
  bool is_configuring() const { return mode_ == Mode::configuration; }
  std::uint32_t clock() const;
  void check_timing();

  // Messages
  std::uint32_t ram(unsigned address) const { return ram_[(address - ram_begin) / 4 % ram_.size()]; }
  std::uint32_t& ram(unsigned address) { return ram_[(address - ram_begin) / 4 % ram_.size()]; }
  CanFrame frame_at(unsigned address, unsigned payload) const;
  void end_attempt(bool is_failure);
  bool accepts(unsigned filter, const CanFrame& frame) const;
  bool is_enabled(unsigned filter) const { return (filter_control(filter) & 0x80) != 0; }
  unsigned filter_control(unsigned filter) const { return word(0x1D0 + filter / 4 * 4) >> (filter % 4 * 8) & 0xFFU; }
  void store(Fifo& fifo, unsigned filter, const CanFrame& frame);
  void count_message();

  static constexpr unsigned ram_begin = 0x400;
  static constexpr unsigned ram_end = 0xC00;

  Options options_;
  CanNode node_;
  Mode mode_ = Mode::configuration;
  std::optional<Mode> wanted_;
  bool is_underflow_next_ = false;
  bool is_joining_ = false;                      // the node waits for 11 recessive bits before the mode changes
  std::array<std::uint32_t, 0xC0> registers_{};  // 000h to 2FFh; those of FIFOs are not used
  std::array<std::uint32_t, 6> chip_{};          // E00h to E17h
  std::array<std::uint32_t, (ram_end - ram_begin) / 4> ram_{};
  std::array<Fifo, 32> fifos_;  // the first one is the transmit queue
  Fifo events_;
  unsigned unready_reads_ = 0;
  std::uint32_t error_state_ = 0;  // flags of C1TREC

  Fifo* transmitting_ = nullptr;
  unsigned object_ = 0;  // that is being transmitted

  unsigned instruction_ = 0;
  unsigned pointer_ = 0;
  std::uint32_t write_value_ = 0;  // bytes of a word that is being written
  std::uint32_t write_mask_ = 0;
};

}  // namespace test
