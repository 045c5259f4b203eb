// SPDX-License-Identifier: Apache-2.0
/// \file bxcan.hpp
/// A model of the registers of bxCAN of STM32 F0, F1, F2, F3, F4, F7 and L4. Written from the reference manuals RM0008
/// (F1), RM0090 (F4), RM0091 (F0), RM0402 (F412), chapter "Controller area network (bxCAN)".
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

/// Offsets of registers.
namespace bxcan {

constexpr std::uint32_t mcr = 0x000;
constexpr std::uint32_t msr = 0x004;
constexpr std::uint32_t tsr = 0x008;
constexpr std::uint32_t rf0r = 0x00C;
constexpr std::uint32_t rf1r = 0x010;
constexpr std::uint32_t ier = 0x014;
constexpr std::uint32_t esr = 0x018;
constexpr std::uint32_t btr = 0x01C;
constexpr std::uint32_t ti0r = 0x180;  ///< TDT0R, TDL0R, TDH0R follow; mailboxes at a distance of 10h
constexpr std::uint32_t ri0r = 0x1B0;  ///< RDT0R, RDL0R, RDH0R follow; FIFOs at a distance of 10h
constexpr std::uint32_t fmr = 0x200;
constexpr std::uint32_t fm1r = 0x204;
constexpr std::uint32_t fs1r = 0x20C;
constexpr std::uint32_t ffa1r = 0x214;
constexpr std::uint32_t fa1r = 0x21C;
constexpr std::uint32_t f0r1 = 0x240;  ///< F0R2 follows; banks at a distance of 8
constexpr std::uint32_t size = 0x400;

}  // namespace bxcan

class BxCan : public RegisterModel, private CanClient {
 public:
  struct Options {
    unsigned filter_banks = 14;  ///< 28 for a master with a slave
    BxCan* master = nullptr;     ///< of a slave: the controller that has the filter registers
    std::uint32_t clock = 0;     ///< APB clock in Hz; 0: the bit rate is not checked
    std::string name = "bxcan";
  };

  BxCan(CanWire& wire, std::uintptr_t address, const Options& options);
  BxCan(CanWire& wire, std::uintptr_t address);

  // Interrupt lines.
  bool transmit_interrupt() const;
  bool receive_interrupt(unsigned fifo) const;
  bool status_interrupt() const;
  bool interrupt() const;  ///< all lines combined, as CEC_CAN of F0

  CanNode& node() { return node_; }
  /// Returns the bit rate of BTR in bit/s, 0 without a clock.
  std::uint32_t bit_rate() const;
  /// Returns the sample point of BTR in permille of the bit time.
  unsigned sample_point() const;

  /// Register accesses after which a written RFOM bit releases the output mailbox; 0: with the write.
  unsigned release_accesses = 0;
  /// ABRQ of an empty mailbox clears RQCP and TXOK. The manual says that it has no effect; STM32F303 was reported to
  /// clear them, so that a frame which was sent appears to be aborted.
  bool late_abort_clears_flags = false;

 protected:
  std::uint32_t read_register(std::uint32_t offset) override;
  void write_register(std::uint32_t offset, std::uint32_t value) override;
  void before_access() override;

 private:
  static constexpr unsigned mailboxes = 3;
  static constexpr unsigned fifos = 2;
  static constexpr unsigned most_banks = 28;

  struct Mailbox {
    std::array<std::uint32_t, 4> words{};  // TIR, TDTR, TDLR, TDHR
    bool is_pending = false;
    bool is_aborting = false;
    std::uint64_t order = 0;   // of the transmit requests
    std::uint32_t status = 0;  // RQCP, TXOK, ALST, TERR at bits 0…3
  };

  struct Fifo {
    std::deque<std::array<std::uint32_t, 4>> messages;  // RIR, RDTR, RDLR, RDHR
    std::array<std::uint32_t, 4> last{};                // content of the output mailbox while the FIFO is empty
    bool is_full = false;
    bool has_overrun = false;
    bool is_releasing = false;
    unsigned release_in = 0;  // accesses
  };

  struct Match {
    unsigned fifo = 0;
    unsigned index = 0;     // filter match index
    unsigned priority = 0;  // lower values win
  };

  enum class Mode : std::uint8_t { sleep, initialization, normal };

  // CanClient
  std::optional<CanFrame> next_frame() override;
  void on_start_of_frame(bool is_transmitter) override;
  void on_sent() override;
  void on_arbitration_lost() override;
  void on_transmission_failed(CanError error) override;
  void on_received(const CanFrame& frame) override;
  void on_error(CanError error) override;
  void on_counters() override;
  void on_recovery_sequence(unsigned sequences) override;
  void on_bit(bool level) override;

  void reset();
  bool has(std::uint32_t mcr_bit) const { return (mcr_ & mcr_bit) != 0; }
  void set_errors();
  void change_mode(bool level);
  void change_mode_of_sleep(bool level);
  void enter_initialization();
  void enter_sleep();
  void begin_synchronization();
  void end_synchronization();
  bool has_right_bit_rate();

  std::uint32_t read_msr() const;
  std::uint32_t read_tsr() const;
  std::uint32_t read_fifo(const Fifo& fifo) const;
  std::uint32_t read_esr() const;
  std::uint32_t read_received(std::uint32_t offset);
  void write_mcr(std::uint32_t value);
  void write_msr(std::uint32_t value);
  void write_tsr(std::uint32_t value);
  void write_fifo(Fifo& fifo, std::uint32_t value);
  void write_ier(std::uint32_t value);
  void write_btr(std::uint32_t value);
  void write_mailbox(std::uint32_t offset, std::uint32_t value);
  void release(Fifo& fifo);
  void request_abort(unsigned index);
  void abort(Mailbox& mailbox);

  std::uint64_t priority(const Mailbox& mailbox) const;
  std::optional<unsigned> first_pending() const;
  std::optional<unsigned> last_pending() const;
  unsigned pending() const;
  CanFrame frame_of(const Mailbox& mailbox) const;
  void end_attempt(std::uint32_t cause);
  void store(const CanFrame& frame, const Match& match);

  // Filters: registers of the master.
  bool has_filters() const { return options_.master == nullptr; }
  std::uint32_t bank_mask() const { return (1U << options_.filter_banks) - 1; }
  bool is_filter_register(std::uint32_t offset) const;
  std::uint32_t* filter_register(std::uint32_t offset);
  void write_filter(std::uint32_t offset, std::uint32_t value);
  void write_fmr(std::uint32_t value);
  std::optional<Match> match(const CanFrame& frame, unsigned first, unsigned last) const;
  std::vector<bool> filters_of(unsigned bank, const CanFrame& frame) const;
  unsigned first_slave_bank() const;

  CanWire& wire_;
  Options options_;
  CanNode node_;
  Mode mode_ = Mode::sleep;
  bool is_synchronizing_ = false;
  std::uint32_t mcr_ = 0;
  std::uint32_t msr_flags_ = 0;  // ERRI, WKUI, SLAKI
  std::uint32_t ier_ = 0;
  std::uint32_t lec_ = 0;
  std::uint32_t esr_flags_ = 0;  // EWGF, EPVF, BOFF as they were last
  std::uint32_t btr_ = 0;
  std::array<Mailbox, mailboxes> mailboxes_;
  std::array<Fifo, fifos> fifos_;
  std::optional<unsigned> transmitting_;
  std::uint64_t requests_ = 0;
  std::uint16_t timer_ = 0;
  std::uint16_t time_of_start_ = 0;

  std::uint32_t fmr_ = 0;
  std::uint32_t fm1r_ = 0;
  std::uint32_t fs1r_ = 0;
  std::uint32_t ffa1r_ = 0;
  std::uint32_t fa1r_ = 0;
  std::array<std::array<std::uint32_t, 2>, most_banks> banks_{};
};

}  // namespace test
