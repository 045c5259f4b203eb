// SPDX-License-Identifier: Apache-2.0
/// \file can_wire.hpp
/// A CAN bus bit by bit: the protocol controllers of all nodes, arbitration, acknowledgement, error signalling and
/// fault confinement, disturbances, and a log of the frames. Time is measured in bit times. [ISO 11898-1:2015]
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "can_frame.hpp"

namespace test {

class CanWire;
class CanNode;

/// Kinds of errors, with the codes of the field LEC that bxCAN and M_CAN share.
enum class CanError : std::uint8_t {
  none = 0,
  stuff = 1,
  form = 2,
  ack = 3,
  bit1 = 4,  ///< recessive bit sent, dominant level monitored
  bit0 = 5,  ///< dominant bit sent, recessive level monitored
  crc = 6
};

/// The upper layer of a protocol controller: mailboxes, filters, registers.
class CanClient {
 public:
  virtual ~CanClient() = default;
  /// Returns the frame to be sent, if there is one. Called when a transmission can begin; it begins if a frame is
  /// returned.
  virtual std::optional<CanFrame> next_frame() = 0;
  virtual void on_start_of_frame(bool /*is_transmitter*/) {}
  virtual void on_sent() {}
  virtual void on_arbitration_lost() {}
  virtual void on_transmission_failed(CanError /*error*/) {}
  /// Called at the last but one bit of the end of frame. In loopback, called for sent frames after on_sent().
  virtual void on_received(const CanFrame& /*frame*/) {}
  /// Called for each detected error, before the counters change.
  virtual void on_error(CanError /*error*/) {}
  /// Called after a change of the error counters, of error passive or of bus-off.
  virtual void on_counters() {}
  /// Called for each sequence of 11 recessive bits in bus-off recovery; the sequences begin with 1.
  virtual void on_recovery_sequence(unsigned /*sequences*/) {}
  virtual void on_protocol_exception() {}
  /// Called at the end of each bit time with the level of the bus.
  virtual void on_bit(bool /*level*/) {}
};

/// Modes of a protocol controller.
struct CanMode {
  bool is_loopback = false;         ///< receives its own frames, disregards the bus, ignores acknowledgement errors
  bool is_silent = false;           ///< sends recessive bits only
  bool is_listen_only = false;      ///< also error passive with stopped counters; does not see its own bits (FlexCAN)
  bool pauses = false;              ///< waits two further bits after each frame that it sent (transmit pause of M_CAN)
  bool exception_is_error = false;  ///< a protocol exception is signalled as a form error
  bool needs_no_acknowledgement = false;  ///< a frame without acknowledgement is no error
  FdMode fd = FdMode::classic;
};

/// The protocol controller of one node.
class CanNode {
 public:
  enum class State : std::uint8_t {
    off,
    bus_off,     ///< without recovery
    recovering,  ///< counts sequences of 11 recessive bits
    integrating,
    idle,
    frame,
    error_flag,
    overload_flag,
    superposition,  ///< after an own flag, until the flags of all nodes have ended
    delimiter,
    intermission,
    suspended  ///< suspend transmission, transmit pause
  };

  CanNode(CanWire& wire, CanClient& client, std::string name);
  ~CanNode();
  CanNode(const CanNode&) = delete;
  CanNode& operator=(const CanNode&) = delete;

  /// Connects the node: it waits for 11 recessive bits. In bus-off, begins the recovery with the number of sequences.
  void start(unsigned recovery_sequences = 128);
  /// Disconnects the node at once, also within a frame. The error counters do not change.
  void stop();
  /// Clears the error counters and bus-off, as a hardware reset does.
  void reset();
  void set_mode(const CanMode& mode) { mode_ = mode; }
  const CanMode& mode() const { return mode_; }

  State state() const { return state_; }
  /// Returns true from the start of frame until the intermission, also while errors are signalled.
  bool is_busy() const { return state_ >= State::frame && state_ <= State::delimiter; }
  bool is_transmitter() const { return is_busy() && is_transmitter_; }
  bool is_on_bus() const { return state_ >= State::idle; }
  bool is_bus_off() const { return is_bus_off_; }
  bool is_error_passive() const { return mode_.is_listen_only || tec_ > 127 || rec_ > 127; }
  unsigned tec() const { return tec_; }
  unsigned rec() const { return rec_; }
  /// Sets the counters of fault confinement, to shorten a test. Calls on_counters().
  void set_counters(unsigned tec, unsigned rec);
  const std::string& name() const { return name_; }

 private:
  friend class CanWire;

  bool drive();
  void sample(bool bus);

  bool output();
  bool frame_output() const;
  bool begin_transmission();
  void begin_frame();
  void begin_reception();
  void sample_frame(bool level);
  bool check_sent_bit(bool level);
  void end_decoding(CanDecoder::Result result);
  void sample_tail(bool level);
  void sample_ack(bool level);
  void sample_last_bit(bool level);
  void accept_frame();
  void signal_error(CanError error, bool counts = true);
  void begin_flag(State flag);
  void sample_flag(bool level);
  void sample_passive_flag(bool level);
  void sample_superposition(bool level);
  void sample_delimiter(bool level);
  void sample_intermission(bool level);
  void begin_intermission();
  void sample_suspended(bool level);
  void wait_for_idle(bool level);
  void count_error(unsigned points);
  void check_bus_off();

  CanWire& wire_;
  CanClient& client_;
  std::string name_;
  CanMode mode_;
  State state_ = State::off;
  unsigned tec_ = 0;
  unsigned rec_ = 0;
  bool is_bus_off_ = false;

  // A frame, or the flags that follow.
  CanDecoder decoder_;
  std::vector<CanBit> sent_bits_;
  CanFrame sent_frame_;
  std::size_t sent_ = 0;  // bits of sent_bits_ that are on the bus
  int tail_ = -1;         // bit after the CRC field: 0 CRC delimiter, 1 ACK slot, 2 ACK delimiter, 3… end of frame
  bool is_transmitter_ = false;  // of the current frame, until the intermission ends
  bool has_attempt_ = false;     // the result of the client's frame has not been reported to the client
  bool was_sent_ = false;        // the current frame is complete
  std::uint64_t begin_ = 0;      // time of the start of frame
  bool driven_ = recessive;      // level that drive() has determined, before silent modes suppress it

  // Flags and waiting times.
  unsigned count_ = 0;  // bits since the state was entered; while waiting for idle, consecutive recessive bits
  bool is_passive_flag_ = false;
  bool is_overload_ = false;
  bool flag_level_ = recessive;  // of the equal bits during a passive error flag
  bool is_ack_error_uncounted_ =
      false;                // acknowledgement error of an error passive transmitter [12.1.4.2 c, exception 1]
  unsigned wait_ = 0;       // bits of State::suspended
  unsigned sequences_ = 0;  // of 11 recessive bits, during the recovery from bus-off
  unsigned sequences_needed_ = 0;
};

/// A change of the bus level for a number of bits, for all nodes or for one.
struct CanDisturbance {
  enum class Kind : std::uint8_t { invert, set_dominant, set_recessive };
  Kind kind = Kind::invert;
  std::uint64_t first = 0;  ///< time of the first disturbed bit
  std::uint64_t bits = 1;
  const CanNode* only = nullptr;  ///< the node whose receiver is disturbed, or nullptr for all

  bool is_at(std::uint64_t time) const { return time >= first && time - first < bits; }
};

/// A completed transmission, or an error that a transmitter or receiver detected.
struct CanRecord {
  enum class Kind : std::uint8_t { sent, error };
  Kind kind = Kind::sent;
  std::uint64_t begin = 0;  ///< time of the start of frame
  std::uint64_t end = 0;    ///< time after the last bit of the end of frame, or after the bit with the error
  const CanNode* node = nullptr;
  CanFrame frame;  ///< of a transmitter
  CanError error = CanError::none;
  bool is_transmitter = true;
};

class CanWire {
 public:
  CanWire() = default;
  CanWire(const CanWire&) = delete;
  CanWire& operator=(const CanWire&) = delete;

  void advance(std::uint64_t bits);
  /// Advances until the condition is true. Returns false if it is not after the number of bits.
  template <class Condition>
  bool advance_until(Condition condition, std::uint64_t bits = 100'000) {
    for (; !condition(); --bits) {
      if (bits == 0) {
        return false;
      }
      advance(1);
    }
    return true;
  }
  /// Returns the number of bits since the beginning.
  std::uint64_t now() const { return now_; }
  bool level() const { return level_; }

  /// Frames that a transmitter completed, and errors as each node detected them.
  const std::vector<CanRecord>& records() const { return records_; }
  std::vector<CanFrame> sent_frames() const;
  std::size_t sent() const;
  std::size_t errors(CanError error) const;
  void clear_records() { records_.clear(); }

  /// Disturbs bits at absolute times.
  void disturb(const CanDisturbance& disturbance) { disturbances_.push_back(disturbance); }
  /// Disturbs the next frames at a distance from their start of frame: bit 0 is the start of frame.
  void disturb_frames(unsigned frames, unsigned bit, CanDisturbance::Kind kind = CanDisturbance::Kind::invert,
                      unsigned bits = 1, const CanNode* only = nullptr);
  /// Holds the bus at a level until release().
  void hold(bool level) { held_ = level; }
  void release() { held_.reset(); }

  /// Bit rate in bit/s. If not 0, a modelled controller with another bit rate does not take part.
  std::uint32_t bit_rate = 0;
  /// Number of register accesses of all models that take one bit time; 0: accesses take no time.
  unsigned accesses_per_bit = 0;
  /// Called by models before each register access, and before each byte on SPI.
  void count_access();
  /// Returns the number of these since the beginning.
  std::uint64_t accesses() const { return all_accesses_; }

 private:
  friend class CanNode;

  struct FrameDisturbance {
    unsigned frames = 0;
    unsigned bit = 0;
    CanDisturbance disturbance;
  };

  void step();
  bool disturbed(bool level, const CanNode* node) const;
  void on_start_of_frame();

  std::vector<CanNode*> nodes_;
  std::vector<CanClient*> clients_;
  std::vector<CanRecord> records_;
  std::vector<CanDisturbance> disturbances_;
  std::vector<FrameDisturbance> frame_disturbances_;
  std::optional<bool> held_;
  std::uint64_t now_ = 0;
  std::uint64_t last_start_ = ~std::uint64_t{0};
  unsigned accesses_ = 0;  // since the last bit that they have advanced
  std::uint64_t all_accesses_ = 0;
  bool level_ = recessive;
};

/// A node that a test controls: sends frames in order, stores received frames, recovers from bus-off.
class CanPeer : public CanClient {
 public:
  explicit CanPeer(CanWire& wire, FdMode fd = FdMode::classic, std::string name = "peer");

  void send(const CanFrame& frame) { queue_.push_back(frame); }
  void cancel() { queue_.clear(); }
  std::size_t queued() const { return queue_.size(); }
  CanNode& node() { return node_; }

  std::vector<CanFrame> received;
  unsigned arbitrations_lost = 0;
  unsigned failures = 0;
  bool retransmits = true;

  std::optional<CanFrame> next_frame() override;
  void on_sent() override { queue_.pop_front(); }
  void on_arbitration_lost() override;
  void on_transmission_failed(CanError error) override;
  void on_received(const CanFrame& frame) override { received.push_back(frame); }
  void on_counters() override;

 private:
  void end_attempt();

  std::deque<CanFrame> queue_;
  CanNode node_;
};

}  // namespace test
