// SPDX-License-Identifier: Apache-2.0
// Class CanNode, the protocol controller of one node: a state machine that runs once for each bit time. CanWire calls
// drive() for all nodes, then sample() with the resulting level of the bus. Clauses are those of ISO 11898-1:2015.
#include <utility>

#include "can_wire.hpp"

namespace test {
namespace {

constexpr unsigned idle_bits = 11;      // recessive bits of bus integration and of bus-off recovery
constexpr unsigned flag_bits = 6;       // error flag, overload flag
constexpr unsigned delimiter_bits = 8;  // error delimiter, overload delimiter
constexpr unsigned intermission_bits = 3;
constexpr unsigned suspend_bits = 8;  // suspend transmission of an error passive transmitter
constexpr unsigned pause_bits = 2;    // CanMode::pauses
constexpr unsigned bus_off_limit = 256;

// Values of tail_: bits after the CRC field. The end of frame is 3 to 9.
constexpr int crc_delimiter = 0;
constexpr int ack_slot = 1;
constexpr int ack_delimiter = 2;
constexpr int last_but_one_bit = 8;  // of the end of frame: a receiver accepts the frame
constexpr int last_bit = 9;          // a transmitter has completed the frame

}  // namespace

void CanNode::start(unsigned recovery_sequences) {
  count_ = 0;
  sequences_ = 0;
  sequences_needed_ = recovery_sequences;
  state_ = is_bus_off_ ? State::recovering : State::integrating;
}

void CanNode::stop() {
  state_ = is_bus_off_ ? State::bus_off : State::off;
  is_transmitter_ = false;
  has_attempt_ = false;
}

void CanNode::reset() {
  is_bus_off_ = false;
  tec_ = 0;
  rec_ = 0;
  stop();
}

void CanNode::set_counters(unsigned tec, unsigned rec) {
  tec_ = tec;
  rec_ = rec;
  check_bus_off();
  client_.on_counters();
}

// Returns the level that the node sends in this bit time.
bool CanNode::drive() {
  driven_ = output();
  return mode_.is_silent || mode_.is_listen_only ? recessive : driven_;
}

// Returns the level that the protocol requires in this state, before silent modes suppress it. Begins a transmission if
// the bus is idle and the client has a frame.
bool CanNode::output() {
  switch (state_) {
    case State::idle:
      if (begin_transmission()) {
        begin_frame();
        return frame_output();
      }
      return recessive;
    case State::frame: return frame_output();
    case State::error_flag: return is_passive_flag_ ? recessive : dominant;
    case State::overload_flag: return dominant;
    default: return recessive;
  }
}

bool CanNode::frame_output() const {
  if (tail_ < 0) {
    return is_transmitter_ ? sent_bits_[sent_].level : recessive;
  }
  const bool acknowledges = tail_ == ack_slot && !is_transmitter_ && decoder_.crc_is_right();
  return acknowledges ? dominant : recessive;
}

// Processes the level of the bus at the sample point.
void CanNode::sample(bool bus) {
  // The receiver sees the bus; in silent mode also the suppressed level of this node; in loopback only that level.
  const bool bus_and_own = mode_.is_silent ? bus && driven_ : bus;
  const bool level = mode_.is_loopback ? driven_ : bus_and_own;
  switch (state_) {
    case State::off:
    case State::bus_off: break;
    case State::recovering:
    case State::integrating: wait_for_idle(level); break;
    case State::idle:
      if (level == dominant) {
        begin_reception();
      }
      break;
    case State::frame: sample_frame(level); break;
    case State::error_flag:
    case State::overload_flag: sample_flag(level); break;
    case State::superposition: sample_superposition(level); break;
    case State::delimiter: sample_delimiter(level); break;
    case State::intermission: sample_intermission(level); break;
    case State::suspended: sample_suspended(level); break;
  }
}

// Gets the next frame of the client. Returns false if there is none, or the mode does not permit transmission. The
// caller puts the first bit on the bus.
bool CanNode::begin_transmission() {
  if (mode_.is_listen_only || (mode_.is_silent && !mode_.is_loopback)) {
    return false;
  }
  const std::optional<CanFrame> frame = client_.next_frame();
  if (!frame) {
    return false;
  }
  sent_frame_ = *frame;
  sent_bits_ = encode(*frame);
  sent_ = 0;
  is_transmitter_ = true;
  has_attempt_ = true;
  return true;
}

// Enters the frame whose start of frame is the bit that is being driven or sampled.
void CanNode::begin_frame() {
  state_ = State::frame;
  tail_ = -1;
  was_sent_ = false;
  begin_ = wire_.now_;
  decoder_ = CanDecoder(is_transmitter_ && sent_frame_.is_fd ? FdMode::enabled : mode_.fd);
  wire_.on_start_of_frame();
  client_.on_start_of_frame(is_transmitter_);
}

void CanNode::begin_reception() {
  is_transmitter_ = false;
  begin_frame();
  sample_frame(dominant);
}

void CanNode::sample_frame(bool level) {
  if (tail_ >= 0) {
    sample_tail(level);
    return;
  }
  if (is_transmitter_ && !check_sent_bit(level)) {
    return;
  }
  ++sent_;
  end_decoding(decoder_.add(level));
}

// Compares the sampled level with the sent one. Returns false if an error was signalled. After a lost arbitration the
// node is a receiver.
bool CanNode::check_sent_bit(bool level) {
  const CanBit sent = sent_bits_[sent_];
  if (sent.level == level) {
    return true;
  }
  if (!sent.in_arbitration || sent.level == dominant) {
    signal_error(sent.level == recessive ? CanError::bit1 : CanError::bit0);
    return false;
  }
  if (sent.is_stuff) {
    signal_error(CanError::stuff, false);  // 12.1.4.2, exception 2: the transmit error counter does not change
    return false;
  }
  is_transmitter_ = false;
  has_attempt_ = false;
  client_.on_arbitration_lost();
  return true;
}

// Continues the state machine after the decoder has processed a bit.
void CanNode::end_decoding(CanDecoder::Result result) {
  using Result = CanDecoder::Result;
  switch (result) {
    case Result::more: break;
    case Result::complete: tail_ = crc_delimiter; break;
    case Result::stuff_error: signal_error(CanError::stuff); break;
    case Result::form_error: signal_error(CanError::form); break;
    case Result::protocol_exception:
      client_.on_protocol_exception();
      if (mode_.exception_is_error) {
        signal_error(CanError::form);
      } else {
        state_ = State::integrating;
        count_ = 0;
      }
      break;
  }
}

void CanNode::sample_tail(bool level) {
  if (tail_ == ack_slot) {
    sample_ack(level);
    return;
  }
  if (tail_ == last_bit) {
    sample_last_bit(level);
    return;
  }
  if (level == dominant) {
    signal_error(CanError::form);
    return;
  }
  if (tail_ == ack_delimiter && !is_transmitter_ && !decoder_.crc_is_right()) {
    signal_error(CanError::crc);
    return;
  }
  if (tail_ == last_but_one_bit && !is_transmitter_) {
    accept_frame();
  }
  ++tail_;
}

void CanNode::sample_ack(bool level) {
  if (is_transmitter_ && level == recessive && !mode_.is_loopback && !mode_.needs_no_acknowledgement) {
    signal_error(CanError::ack);
    return;
  }
  if (!is_transmitter_ && level == recessive && driven_ == dominant) {
    signal_error(CanError::bit0);
    return;
  }
  ++tail_;
}

void CanNode::sample_last_bit(bool level) {
  if (!is_transmitter_) {
    if (level == dominant) {
      begin_flag(State::overload_flag);
    } else {
      begin_intermission();
    }
    return;
  }
  if (level == dominant) {
    signal_error(CanError::form);
    return;
  }
  if (tec_ != 0) {
    --tec_;
  }
  has_attempt_ = false;
  was_sent_ = true;
  wire_.records_.push_back({CanRecord::Kind::sent, begin_, wire_.now_ + 1, this, sent_frame_, CanError::none, true});
  client_.on_sent();
  client_.on_counters();
  if (mode_.is_loopback) {
    client_.on_received(decoder_.frame());
  }
  begin_intermission();
}

// Passes a received frame to the client, and decrements the receive error counter. [12.1.4.2 h]
void CanNode::accept_frame() {
  constexpr unsigned error_passive_limit = 127;
  constexpr unsigned below_limit = 120;  // 119…127 are allowed; bxCAN resets to this value [RM0090, CAN_ESR]
  if (rec_ > error_passive_limit) {
    rec_ = mode_.is_listen_only ? rec_ : below_limit;
  } else if (rec_ != 0 && !mode_.is_listen_only) {
    --rec_;
  }
  client_.on_received(decoder_.frame());
  client_.on_counters();
}

// Reports an error to the client and begins the error flag, which is active if the node was error active before this
// error. counts: the error counter is incremented.
void CanNode::signal_error(CanError error, bool counts) {
  const bool is_passive = is_error_passive();
  wire_.records_.push_back({CanRecord::Kind::error, begin_, wire_.now_ + 1, this,
                            is_transmitter_ ? sent_frame_ : CanFrame{}, error, is_transmitter_});
  client_.on_error(error);
  is_ack_error_uncounted_ = is_transmitter_ && is_passive && error == CanError::ack;
  if (has_attempt_) {
    has_attempt_ = false;
    client_.on_transmission_failed(error);
  }
  is_passive_flag_ = is_passive;
  begin_flag(State::error_flag);
  if (counts && !is_ack_error_uncounted_) {
    count_error(is_transmitter_ ? 8 : 1);
  }
}

void CanNode::begin_flag(State flag) {
  state_ = flag;
  is_overload_ = flag == State::overload_flag;
  count_ = 0;
}

void CanNode::sample_flag(bool level) {
  if (state_ == State::error_flag && is_passive_flag_) {
    sample_passive_flag(level);
  } else if (level == recessive) {
    // 12.1.4.2 d, e: a bit error while an active error flag or an overload flag is sent; a new flag begins.
    client_.on_error(CanError::bit0);
    is_passive_flag_ = is_error_passive();
    begin_flag(State::error_flag);
    count_error(8);
  } else if (++count_ == flag_bits) {
    state_ = State::superposition;
    count_ = 0;
  }
}

// A passive error flag is complete after six equal bits of either level. [10.4.4.3]
void CanNode::sample_passive_flag(bool level) {
  count_ = count_ != 0 && level == flag_level_ ? count_ + 1 : 1;
  flag_level_ = level;
  if (is_ack_error_uncounted_ && level == dominant) {
    is_ack_error_uncounted_ = false;
    count_error(8);  // exception 1 of 12.1.4.2 c does not apply
  }
  if (count_ == flag_bits && state_ == State::error_flag) {
    state_ = State::superposition;
    count_ = 0;
  }
}

void CanNode::sample_superposition(bool level) {
  constexpr unsigned tolerated = 8;
  if (level == recessive) {
    state_ = State::delimiter;
    count_ = 1;
    return;
  }
  ++count_;
  if (count_ == 1 && !is_overload_ && !is_transmitter_) {
    count_error(8);  // 12.1.4.2 b: dominant bit after the error flag of a receiver
  }
  if (count_ % tolerated == 0) {
    count_error(8);  // 12.1.4.2 f
  }
}

void CanNode::sample_delimiter(bool level) {
  if (level == dominant) {
    if (count_ + 1 == delimiter_bits) {
      begin_flag(State::overload_flag);
    } else {
      signal_error(CanError::form);
    }
    return;
  }
  if (++count_ == delimiter_bits) {
    begin_intermission();
  }
}

void CanNode::begin_intermission() {
  state_ = State::intermission;
  count_ = 0;
}

void CanNode::sample_intermission(bool level) {
  ++count_;
  const bool is_suspended = is_transmitter_ && is_error_passive();
  if (level == dominant) {
    if (count_ < intermission_bits) {
      begin_flag(State::overload_flag);
    } else if (!is_suspended && begin_transmission()) {
      begin_frame();  // the dominant bit is the start of frame; the next bit is the first of the identifier
      sample_frame(level);
    } else {
      begin_reception();
    }
    return;
  }
  if (count_ < intermission_bits) {
    return;
  }
  wait_ = is_suspended ? suspend_bits : is_transmitter_ && was_sent_ && mode_.pauses ? pause_bits : 0;
  state_ = wait_ != 0 ? State::suspended : State::idle;
  count_ = 0;
  is_transmitter_ = false;
}

void CanNode::sample_suspended(bool level) {
  if (level == dominant) {
    begin_reception();
  } else if (++count_ == wait_) {
    state_ = State::idle;
  }
}

void CanNode::wait_for_idle(bool level) {
  count_ = level == recessive ? count_ + 1 : 0;
  if (count_ < idle_bits) {
    return;
  }
  count_ = 0;
  is_transmitter_ = false;
  if (state_ == State::integrating) {
    state_ = State::idle;
    return;
  }
  ++sequences_;
  client_.on_recovery_sequence(sequences_);
  if (sequences_ == sequences_needed_) {
    is_bus_off_ = false;
    tec_ = 0;
    rec_ = 0;
    state_ = State::idle;
    client_.on_counters();
  }
}

void CanNode::count_error(unsigned points) {
  constexpr unsigned largest_rec = 255;
  if (mode_.is_listen_only) {
    return;
  }
  if (is_transmitter_) {
    tec_ += points;
  } else {
    rec_ = rec_ + points > largest_rec ? largest_rec : rec_ + points;
  }
  check_bus_off();
  client_.on_counters();
}

void CanNode::check_bus_off() {
  if (tec_ >= bus_off_limit && !is_bus_off_) {
    is_bus_off_ = true;
    state_ = State::bus_off;
    is_transmitter_ = false;
  }
}

}  // namespace test
