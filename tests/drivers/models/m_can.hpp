// SPDX-License-Identifier: Apache-2.0
/// \file m_can.hpp
/// A model of the registers and the message RAM of Bosch M_CAN, revision 3.2 (FDCAN of STM32), for Classical CAN.
/// Written from the M_CAN user's manual 3.3 and the reference manuals RM0440 (G4: fixed message RAM layout) and RM0433
/// (H7: configurable layout).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "can_wire.hpp"
#include "register_model.hpp"

namespace test {

class MCan;

/// The registers, which have other offsets in the two layouts. A register of one layout only has its remark.
enum class MCanRegister : std::uint8_t {
  crel,
  endn,
  dbtp,
  test,
  rwd,
  cccr,
  nbtp,
  tscc,
  tscv,
  tocc,
  tocv,
  ecr,
  psr,
  tdcr,
  ir,
  ie,
  ils,
  ile,
  gfc,  ///< RXGFC of the fixed layout
  xidam,
  hpms,
  rxf0s,
  rxf0a,
  rxf1s,
  rxf1a,
  txbc,
  txfqs,
  txbrp,
  txbar,
  txbcr,
  txbto,
  txbcf,
  txbtie,
  txbcie,
  txefs,
  txefa,
  sidfc,  ///< configurable, as the following
  xidfc,
  ndat1,
  ndat2,
  rxf0c,
  rxbc,
  rxf1c,
  rxesc,
  txesc,
  txefc,
  ckdiv,  ///< fixed
  count
};

/// Interrupt flags, with the bit numbers of the configurable layout.
enum class MCanFlag : std::uint8_t {
  rf0n = 0,
  rf0w = 1,
  rf0f = 2,
  rf0l = 3,
  rf1n = 4,
  rf1w = 5,
  rf1f = 6,
  rf1l = 7,
  hpm = 8,
  tc = 9,
  tcf = 10,
  tfe = 11,
  tefn = 12,
  tefw = 13,
  teff = 14,
  tefl = 15,
  tsw = 16,
  too = 18,
  drx = 19,
  elo = 22,
  ep = 23,
  ew = 24,
  bo = 25,
  pea = 27,
  ara = 29
};

enum class MCanLayout : std::uint8_t {
  fixed,        ///< STM32 G0, G4, H5, L5, U5
  configurable  ///< STM32 H7, and M_CAN of other makers
};

/// A message RAM, which several controllers can share. Its content after a reset is a pattern.
class MessageRam : public RegisterModel {
 public:
  MessageRam(std::uintptr_t address, unsigned words);

  std::uint32_t word(unsigned index) const { return words_[index]; }
  void set_word(unsigned index, std::uint32_t value) { words_[index] = value; }
  unsigned size() const { return static_cast<unsigned>(words_.size()); }

 protected:
  std::uint32_t read_register(std::uint32_t offset) override;
  void write_register(std::uint32_t offset, std::uint32_t value) override;
  void before_access() override;

 private:
  friend class MCan;

  void check_owner(unsigned word);

  std::vector<std::uint32_t> words_;
  std::vector<MCan*> controllers_;
};

class MCan : public RegisterModel, private CanClient {
 public:
  using Register = MCanRegister;
  using Flag = MCanFlag;

  static constexpr unsigned fixed_words = 212;          ///< message RAM of a controller with fixed layout: 350h bytes
  static constexpr unsigned configurable_words = 2560;  ///< message RAM of STM32 H7

  struct Options {
    MCanLayout layout = MCanLayout::fixed;
    unsigned ram_offset = 0;  ///< first word of this controller with fixed layout
    std::uint32_t clock = 0;  ///< kernel clock in Hz; 0: the bit rate is not checked
    std::string name = "m_can";
  };

  MCan(CanWire& wire, std::uintptr_t address, MessageRam& ram, const Options& options);
  ~MCan() override;
  MCan(const MCan&) = delete;
  MCan& operator=(const MCan&) = delete;

  /// Interrupt lines 0 and 1.
  bool interrupt(unsigned line) const;

  CanNode& node() { return node_; }
  /// Returns the nominal bit rate of NBTP in bit/s, 0 without a clock.
  std::uint32_t bit_rate() const;
  /// Returns the nominal sample point of NBTP in permille of the bit time.
  unsigned sample_point() const;

  static std::uint32_t offset_of(MCanLayout layout, Register which);
  static std::uint32_t bit_of(MCanLayout layout, Flag flag);

  /// Accesses of the registers after which a written CCCR.INIT is accepted and can be read back.
  unsigned initialization_accesses = 2;

 protected:
  std::uint32_t read_register(std::uint32_t offset) override;
  void write_register(std::uint32_t offset, std::uint32_t value) override;
  void before_access() override;

 private:
  friend class MessageRam;

  // A section of the message RAM.
  struct Section {
    const char* name = "";
    unsigned start = 0;  // word
    unsigned elements = 0;
    unsigned words = 0;  // of an element
    unsigned end() const { return start + elements * words; }
  };

  struct RxFifo {
    unsigned get = 0;
    unsigned put = 0;
    unsigned fill = 0;
  };

  struct TxEvents {
    unsigned get = 0;
    unsigned put = 0;
    unsigned fill = 0;
  };

  enum class Storage : std::uint8_t { none, fifo0, fifo1, buffer };

  struct Decision {
    Storage storage = Storage::none;
    bool is_matched = false;  // by a filter element
    bool is_priority = false;
    unsigned filter = 0;
    unsigned buffer = 0;
  };

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
  void on_protocol_exception() override;
  void on_bit(bool level) override;

  // Registers
  bool is_fixed() const { return options_.layout == MCanLayout::fixed; }
  std::optional<Register> register_at(std::uint32_t offset) const;
  std::uint32_t& value(Register which) { return values_[static_cast<std::size_t>(which)]; }
  std::uint32_t value(Register which) const { return values_[static_cast<std::size_t>(which)]; }
  std::uint32_t field(Register which, unsigned shift, std::uint32_t mask) const { return value(which) >> shift & mask; }
  std::uint32_t writable_bits(Register which) const;
  bool is_protected(Register which) const;
  bool is_initializing() const;
  bool is_configurable() const;
  void set_reset_values();
  std::uint32_t read_status(Register which);
  std::uint32_t read_ecr();
  std::uint32_t read_psr();
  std::uint32_t read_test() const;
  void write_value(Register which, std::uint32_t written);
  void write_cccr(std::uint32_t written);
  std::uint32_t accepted_modes(std::uint32_t written);
  void request_initialization(bool is_requested);
  void accept_initialization();
  void set_initialization(bool is_set);
  void reset_status();
  void write_test(std::uint32_t written);
  void update_mode();
  bool has_right_bit_rate();
  void raise(Flag flag);
  void stop_clock();

  // Message RAM
  Section section(const char* name, Register start, unsigned elements, unsigned words) const;
  Section standard_filters() const;
  Section extended_filters() const;
  Section rx_fifo(unsigned fifo) const;
  Section rx_buffers() const;
  Section tx_events() const;
  Section tx_buffers() const;
  std::vector<Section> sections() const;
  void check_sections();
  bool owns(unsigned word) const;
  bool is_in_pending_buffer(unsigned word) const;
  std::uint32_t ram_word(unsigned word) const;
  void set_ram_word(unsigned word, std::uint32_t value);

  // Reception
  Decision filter(const CanFrame& frame) const;
  bool standard_matches(std::uint32_t element, std::uint32_t id) const;
  bool extended_matches(std::uint32_t first, std::uint32_t second, std::uint32_t id) const;
  bool decide(Decision& decision, unsigned configuration, unsigned index, std::uint32_t buffer) const;
  Decision without_match(const CanFrame& frame) const;
  void store(const CanFrame& frame, const Decision& decision);
  bool store_in_fifo(const CanFrame& frame, const Decision& decision, unsigned fifo);
  void store_in_buffer(const CanFrame& frame, const Decision& decision);
  void write_rx_element(const Section& section, unsigned index, const CanFrame& frame, const Decision& decision);
  void set_high_priority(const Decision& decision, const CanFrame& frame, bool is_stored, unsigned index);
  std::uint32_t read_rx_status(unsigned fifo) const;
  void acknowledge(unsigned fifo, std::uint32_t index);
  bool overwrites(unsigned fifo) const;

  // Transmission
  unsigned dedicated_buffers() const;
  unsigned fifo_size() const;
  bool is_queue() const;
  std::uint32_t buffer_mask() const;
  void request(std::uint32_t buffers);
  void request_from_fifo(std::uint32_t& buffers);
  void cancel(std::uint32_t buffers);
  void end_request(unsigned buffer, bool was_sent, bool was_cancelled);
  void end_attempt();
  void release_fifo();
  std::uint32_t read_txfqs() const;
  std::optional<unsigned> next_buffer() const;
  CanFrame tx_frame(unsigned buffer) const;
  void add_event(unsigned buffer, bool was_cancelled);
  std::uint32_t read_txefs() const;
  void acknowledge_event(std::uint32_t index);

  CanWire& wire_;
  MessageRam& ram_;
  Options options_;
  CanNode node_;
  std::array<std::uint32_t, static_cast<std::size_t>(Register::count)> values_{};

  std::optional<bool> requested_initialization_;
  unsigned accesses_to_acceptance_ = 0;
  std::uint32_t flags_ = 0;  // IR, with the bits of this layout
  std::uint32_t lec_ = 7;
  unsigned error_log_ = 0;         // ECR.CEL
  std::uint32_t psr_at_read_ = 0;  // PXE, RFDF, RBRS, RESI
  bool is_passive_ = false;        // states as they were last
  bool is_warning_ = false;
  bool is_bus_off_ = false;
  unsigned recovery_ = 0;  // sequences of 11 recessive bits
  std::uint64_t bits_ = 0;
  std::uint16_t timestamp_ = 0;
  std::uint16_t time_of_start_ = 0;

  std::array<RxFifo, 2> fifos_;
  TxEvents events_;
  unsigned fifo_get_ = 0;  // buffer, relative to the first of the Tx FIFO
  unsigned fifo_fill_ = 0;
  std::optional<unsigned> transmitting_;
  std::uint32_t cancelling_ = 0;
};

}  // namespace test
