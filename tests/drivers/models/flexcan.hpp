// SPDX-License-Identifier: Apache-2.0
/// \file flexcan.hpp
/// A model of the registers of FlexCAN2 (i.MX 6, i.MX RT, Kinetis K) and of FlexCAN3 without CAN FD (i.MX 8M Plus,
/// S32K, Kinetis KE). Written from the chapters "FlexCAN" of the reference manuals of K20, K60, KE1xF, MWCT101xS,
/// MPC5606S and from the register headers of i.MX RT1020. The sections of these manuals have equal names; comments cite
/// them.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "can_wire.hpp"
#include "register_model.hpp"

namespace test {

/// Offsets of registers.
namespace flexcan {

constexpr std::uint32_t mcr = 0x000;
constexpr std::uint32_t ctrl1 = 0x004;
constexpr std::uint32_t timer = 0x008;
constexpr std::uint32_t rxmgmask = 0x010;
constexpr std::uint32_t rx14mask = 0x014;
constexpr std::uint32_t rx15mask = 0x018;
constexpr std::uint32_t ecr = 0x01C;
constexpr std::uint32_t esr1 = 0x020;
constexpr std::uint32_t imask2 = 0x024;
constexpr std::uint32_t imask1 = 0x028;
constexpr std::uint32_t iflag2 = 0x02C;
constexpr std::uint32_t iflag1 = 0x030;
constexpr std::uint32_t ctrl2 = 0x034;
constexpr std::uint32_t esr2 = 0x038;
constexpr std::uint32_t crcr = 0x044;
constexpr std::uint32_t rxfgmask = 0x048;
constexpr std::uint32_t rxfir = 0x04C;
constexpr std::uint32_t cbt = 0x050;      ///< FlexCAN3
constexpr std::uint32_t mailbox = 0x080;  ///< C/S, ID and two data words; mailboxes at a distance of 10h
constexpr std::uint32_t filters = 0x0E0;  ///< filter table of the Rx FIFO
constexpr std::uint32_t rximr = 0x880;    ///< a mask for each mailbox
constexpr std::uint32_t gfwr = 0x9E0;     ///< FlexCAN2 of i.MX
constexpr std::uint32_t memory_end = 0xAE0;
constexpr std::uint32_t mecr = 0xAE0;  ///< memory with error correction only
constexpr std::uint32_t size = 0x1000;

}  // namespace flexcan

class FlexCan : public RegisterModel, private CanClient {
 public:
  struct Options {
    unsigned version = 2;               ///< 2 or 3
    unsigned mailboxes = 64;            ///< 16, 32 or 64
    bool is_disabled_at_reset = false;  ///< MCR.MDIS is 1 after reset
    bool has_clock_source = false;      ///< CTRL1.CLKSRC exists
    bool has_ecc = false;               ///< the memory has error correction: all of it must be written before its use
    std::uint32_t clock = 0;            ///< protocol engine clock in Hz; 0: the bit rate is not checked
    std::string name = "flexcan";
  };
  static Options imx6();     ///< also i.MX RT10xx: FlexCAN2, 64 mailboxes
  static Options kinetis();  ///< K20…K66: FlexCAN2, 16 mailboxes
  static Options imx8mp();   ///< FlexCAN3, 64 mailboxes, error correction

  FlexCan(CanWire& wire, std::uintptr_t address, const Options& options);

  // Interrupt lines. i.MX has one line, Kinetis has one for each of the others.
  bool mailbox_interrupt() const;
  bool bus_off_interrupt() const;
  bool error_interrupt() const;
  bool transmit_warning_interrupt() const;
  bool receive_warning_interrupt() const;
  bool interrupt() const;  ///< all lines combined

  CanNode& node() { return node_; }
  /// Returns the bit rate of CTRL1 or CBT in bit/s, 0 without a clock.
  std::uint32_t bit_rate() const;
  /// Returns the sample point in permille of the bit time.
  unsigned sample_point() const;
  /// Returns the number of frames that were lost without a trace: while the destination was locked, or excluded from
  /// matching because its C/S word was written during the reception.
  unsigned lost_frames() const { return lost_frames_; }

 protected:
  std::uint32_t read_register(std::uint32_t offset) override;
  void write_register(std::uint32_t offset, std::uint32_t value) override;
  void before_access() override { wire_.count_access(); }

 private:
  static constexpr std::size_t memory_words = (flexcan::memory_end - flexcan::mailbox) / 4;
  static constexpr std::size_t fifo_depth = 6;

  enum class Mode : std::uint8_t { normal, freeze, disabled };

  using Words = std::array<std::uint32_t, 4>;  // C/S, ID, data

  struct FifoMessage {
    Words words{};
    unsigned filter = 0;  // IDHIT
  };

  // A received message in the serial message buffer, until its mailbox is unlocked.
  struct Pending {
    unsigned mailbox = 0;
    Words words{};
  };

  struct Timing {
    unsigned prescaler = 1;
    unsigned before_sample = 1;  // quanta, with the synchronization segment
    unsigned after_sample = 1;
    unsigned jump = 1;
  };

  // CanClient
  std::optional<CanFrame> next_frame() override;
  void on_start_of_frame(bool is_transmitter) override;
  void on_sent() override;
  void on_arbitration_lost() override { end_attempt(); }
  void on_transmission_failed(CanError /*error*/) override { end_attempt(); }
  void on_received(const CanFrame& frame) override;
  void on_error(CanError error) override;
  void on_counters() override;
  void on_recovery_sequence(unsigned sequences) override;
  void on_bit(bool level) override;

  // Modes
  bool has(std::uint32_t mcr_bit) const { return (mcr_ & mcr_bit) != 0; }
  bool is_freeze_requested() const;
  void soft_reset();
  void change_mode();
  void enter_normal();
  void leave_normal(Mode next);
  void begin_recovery();
  void check_configuration();
  void check_memory();
  void check_timing();
  Timing timing() const;
  bool has_right_bit_rate() const;

  // Registers
  bool is_accessible(std::uint32_t offset, bool is_write);
  bool is_reserved(std::uint32_t offset) const;
  std::uint32_t* plain_register(std::uint32_t offset);
  std::uint32_t read_mcr() const;
  std::uint32_t read_ecr() const;
  std::uint32_t read_esr1();
  std::uint32_t read_timer();
  std::uint32_t read_rxfir();
  std::uint32_t guarded(const char* name, std::uint32_t old, std::uint32_t value, std::uint32_t freeze_only);
  void check_reserved(const char* name, std::uint32_t value, std::uint32_t bits);
  void write_mcr(std::uint32_t value);
  void check_mcr(std::uint32_t old);
  void write_ctrl1(std::uint32_t value);
  void write_ctrl2(std::uint32_t value);
  void write_ecr(std::uint32_t value);
  void write_mask(std::uint32_t offset, std::uint32_t value);
  void write_iflag1(std::uint32_t value);
  void write_mecr(std::uint32_t value);

  // Memory: mailboxes, Rx FIFO, individual masks
  static std::size_t word_at(std::uint32_t offset) { return (offset - flexcan::mailbox) / 4; }
  bool is_mailbox_word(std::uint32_t offset) const { return offset < flexcan::mailbox + 16 * options_.mailboxes; }
  bool is_fifo_word(std::uint32_t offset) const;
  bool is_mask_word(std::uint32_t offset) const;
  std::uint32_t read_memory(std::uint32_t offset);
  std::uint32_t read_fifo(std::uint32_t offset);
  std::uint32_t read_mailbox(unsigned index, unsigned word);
  void write_memory(std::uint32_t offset, std::uint32_t value);
  void write_fifo(std::uint32_t offset, std::uint32_t value);
  void write_mailbox(unsigned index, unsigned word, std::uint32_t value);
  void write_control(unsigned index, std::uint32_t value);
  bool may_replace_active(unsigned index, std::uint32_t code);
  void check_control(std::uint32_t value);
  void store_word(std::uint32_t offset, std::uint32_t value);

  std::uint32_t& word(unsigned index, unsigned which) { return memory_[4 * index + which]; }
  std::uint32_t word(unsigned index, unsigned which) const { return memory_[4 * index + which]; }
  std::uint32_t code(unsigned index) const { return word(index, 0) >> 24 & 15; }
  void set_code(unsigned index, std::uint32_t code);
  bool is_flagged(unsigned index) const { return (iflag_ >> index & 1) != 0; }
  void set_flag(unsigned index) { iflag_ |= std::uint64_t{1} << index; }
  unsigned first_mailbox() const;
  unsigned last_mailbox() const;

  // Transmission
  std::uint64_t priority(unsigned index) const;
  CanFrame frame_of(unsigned index) const;
  void end_attempt();
  void abort(unsigned index);

  // Reception
  void receive(const CanFrame& frame);
  bool answer(const CanFrame& frame);
  Words words_of(const CanFrame& frame) const;
  bool matches(unsigned index, const CanFrame& frame) const;
  std::uint32_t mailbox_mask(unsigned index) const;
  bool is_free(unsigned index) const;
  std::optional<unsigned> matching_mailbox(const CanFrame& frame);
  std::optional<unsigned> matching_filter(const CanFrame& frame) const;
  std::uint32_t filter_mask(unsigned element) const;
  void store(unsigned index, const CanFrame& frame);
  void move_in(unsigned index, const Words& words);
  void push(const CanFrame& frame, unsigned filter);
  void pop();
  void show_first_message();
  void unlock();

  CanWire& wire_;
  Options options_;
  CanNode node_;
  Mode mode_ = Mode::freeze;
  bool is_reset_pending_ = false;

  std::uint32_t mcr_ = 0;  // without status bits
  std::uint32_t ctrl1_ = 0;
  std::uint32_t ctrl2_ = 0;
  std::uint32_t cbt_ = 0;
  std::uint32_t gfwr_ = 0;
  std::uint32_t mecr_ = 0;
  std::array<std::uint32_t, 4> masks_{};  // RXMGMASK, RX14MASK, RX15MASK, RXFGMASK
  std::uint64_t imask_ = 0;
  std::uint64_t iflag_ = 0;
  std::uint32_t errors_ = 0;       // ESR1[15:10]
  std::uint32_t error_flags_ = 0;  // interrupt flags of ESR1
  std::uint16_t timer_ = 0;
  std::uint16_t time_of_start_ = 0;

  bool was_bus_off_ = false;
  bool is_recovery_manual_ = false;  // BOFFREC when bus-off was entered, until it is cleared
  unsigned sequences_ = 0;           // 11 recessive bits each, since bus-off was entered
  bool had_tx_warning_ = false;
  bool had_rx_warning_ = false;

  std::array<std::uint32_t, memory_words> memory_{};
  std::bitset<memory_words> written_;
  std::bitset<64> serviced_;  // full mailboxes that were read and unlocked
  std::bitset<64> excluded_;  // from matching of the frame on the bus
  std::optional<unsigned> locked_;
  std::optional<Pending> pending_;
  std::optional<unsigned> transmitting_;
  CanFrame sent_;              // of transmitting_
  bool is_aborting_ = false;   // an abort of transmitting_ was requested
  bool is_abandoned_ = false;  // transmitting_ was inactivated: its end is not reported
  std::deque<FifoMessage> fifo_;
  unsigned lost_frames_ = 0;
};

}  // namespace test
