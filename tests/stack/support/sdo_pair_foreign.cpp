// SPDX-License-Identifier: Apache-2.0
#include "sdo_pair_foreign.hpp"

#include <algorithm>

namespace test {
namespace {

constexpr std::size_t segment = 7;
constexpr std::uint32_t timed_out = 0x05040000;
constexpr std::uint32_t unknown_command = 0x05040001;
constexpr std::uint32_t wrong_sequence = 0x05040003;
constexpr std::uint32_t wrong_crc = 0x05040004;
constexpr std::uint32_t wrong_length = 0x06070010;
constexpr Milliseconds short_silence{250};
constexpr Milliseconds patience{1000};
constexpr unsigned reminders_at_most = 8;

std::size_t segments_of(const Bytes& data) { return std::max<std::size_t>(1, (data.size() + segment - 1) / segment); }

unsigned unused_in(const Bytes& data) { return static_cast<unsigned>(segment * segments_of(data) - data.size()); }

CO_IF_FRM segment_of(const Bytes& data, std::size_t position, unsigned number, std::uint32_t identifier) {
  CO_IF_FRM frm{identifier, {static_cast<std::uint8_t>(number)}, 8};
  const std::size_t n = std::min(segment, data.size() - position);
  std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(position), n, frm.Data + 1);
  if (position + n == data.size()) {
    frm.Data[0] = static_cast<std::uint8_t>(frm.Data[0] | 0x80U);
  }
  return frm;
}

CO_IF_FRM end_of(const Bytes& data, std::uint32_t identifier) {
  CO_IF_FRM frm{identifier, {static_cast<std::uint8_t>(0xC1U | (unused_in(data) << 2U))}, 8};
  const std::uint16_t crc = crc_16(data);
  CO_SET_WORD(&frm, crc, 1);
  return frm;
}

}  // namespace

// Server -------------------------------------------------------------------------------------------------------------

ForeignServer::ForeignServer(Line& line, std::uint8_t node_id, std::uint8_t blksize)
    : port_(line.bus.attach({"foreign server"})), answer_id_(0x580u + node_id), blksize_(blksize) {
  const std::uint32_t request_id = 0x600u + node_id;
  port_.filter(&request_id, 1);
  port_.enable();
}

bool ForeignServer::work() {
  bool any = false;
  while (const auto frame = port_.read()) {
    any = true;
    silence_ = Milliseconds{0};
    reminders_ = 0;
    serve(*frame);
  }
  return any;
}

void ForeignServer::pass(Milliseconds time) {
  silence_ += time;
  if (state_ == State::idle || silence_ < short_silence) {
    return;
  }
  silence_ = Milliseconds{0};
  if (++reminders_ == reminders_at_most) {
    abort({}, timed_out);
  } else if (state_ == State::receiving) {
    acknowledge();
  }
}

void ForeignServer::serve(const CO_IF_FRM& request) {
  const std::uint8_t command = request.Data[0];
  if (command == 0x80) {
    state_ = State::idle;
  } else if (state_ == State::receiving) {
    take_segment(request);
  } else if (state_ == State::received && command == last_) {
    return;  // duplicate of the last segment
  } else if ((command & 0xF9U) == 0xC0) {
    start_download(request);
  } else if ((command & 0xFBU) == 0xA0) {
    start_upload(request);
  } else {
    serve_command(request);
  }
}

void ForeignServer::serve_command(const CO_IF_FRM& request) {
  const std::uint8_t command = request.Data[0];
  if (state_ == State::received && (command & 0xE3U) == 0xC1) {
    end_download(request);
  } else if (state_ == State::ready && command == 0xA3) {
    send_block();
  } else if (state_ == State::sending && command == 0xA2) {
    go_on(request);
  } else if (state_ == State::sent && command == 0xA1) {
    state_ = State::idle;
  } else {
    abort(request, unknown_command);
  }
}

// Sends a response with the multiplexer of the request.
void ForeignServer::answer(std::uint8_t command, const CO_IF_FRM& initiate, std::uint32_t value) {
  CO_IF_FRM frm = initiate;
  frm.Identifier = answer_id_;
  frm.Data[0] = command;
  CO_SET_LONG(&frm, value, 4);
  port_.send(frm);
}

void ForeignServer::abort(const CO_IF_FRM& request, std::uint32_t code) {
  state_ = State::idle;
  answer(0x80, request, code);
}

void ForeignServer::start_download(const CO_IF_FRM& request) {
  state_ = State::receiving;
  data_.clear();
  good_ = 0;
  size_ = CO_GET_LONG(&request, 4);
  answer(0xA4, request, blksize_);
}

void ForeignServer::take_segment(const CO_IF_FRM& request) {
  const unsigned number = request.Data[0] & 0x7FU;
  const bool last = (request.Data[0] & 0x80U) != 0;
  const bool in_order = number == good_ + 1U;
  if (in_order) {
    ++good_;
    data_.insert(data_.end(), request.Data + 1, request.Data + 8);
  }
  if (in_order && last) {
    last_ = request.Data[0];
    state_ = State::received;
  }
  if (last || number == blksize_) {
    acknowledge();
  }
}

void ForeignServer::acknowledge() {
  CO_IF_FRM frm{answer_id_, {0xA2, good_, blksize_}, 8};
  port_.send(frm);
  good_ = 0;
}

void ForeignServer::end_download(const CO_IF_FRM& request) {
  const std::size_t unused = (request.Data[0] >> 2U) & 7U;
  data_.resize(data_.size() - unused);
  if (data_.size() != size_) {
    abort(request, wrong_length);
  } else if (CO_GET_WORD(&request, 1) != crc_16(data_)) {
    abort(request, wrong_crc);
  } else {
    object = data_;
    state_ = State::idle;
    port_.send({answer_id_, {0xA1}, 8});
  }
}

void ForeignServer::start_upload(const CO_IF_FRM& request) {
  state_ = State::ready;
  position_ = 0;
  asked_for_ = request.Data[4];
  answer(0xC6, request, static_cast<std::uint32_t>(object.size()));
}

void ForeignServer::send_block() {
  state_ = State::sending;
  sent_ = 0;
  for (std::size_t from = position_; from < object.size() && sent_ < asked_for_; from += segment) {
    port_.send(segment_of(object, from, ++sent_, answer_id_));
  }
}

void ForeignServer::go_on(const CO_IF_FRM& request) {
  if (request.Data[1] > sent_) {
    abort(request, wrong_sequence);
    return;
  }
  position_ += segment * request.Data[1];
  asked_for_ = request.Data[2];
  if (position_ < object.size()) {
    send_block();
    return;
  }
  state_ = State::sent;
  port_.send(end_of(object, answer_id_));
}

// Client -------------------------------------------------------------------------------------------------------------

ForeignClient::ForeignClient(World& world, Line& line, std::uint8_t node_id, std::uint8_t blksize)
    : world_(world), port_(line.bus.attach({"foreign client"})), request_id_(0x600u + node_id), blksize_(blksize) {
  const std::uint32_t answer_id = 0x580u + node_id;
  port_.filter(&answer_id, 1);
  port_.enable();
}

void ForeignClient::send(std::uint8_t command, std::uint32_t first, std::uint32_t second) {
  CO_IF_FRM frm{request_id_, {}, 8};
  CO_SET_LONG(&frm, (first << 8) | command, 0);
  CO_SET_LONG(&frm, second, 4);
  port_.send(frm);
}

bool ForeignClient::wait(Milliseconds time) {
  const Milliseconds step{10};
  world_.settle();
  for (Milliseconds waited{0}; port_.waiting() == 0 && waited < time; waited += step) {
    world_.pass(step);
  }
  const auto frame = port_.read();
  if (frame) {
    answer_ = *frame;
  }
  return frame.has_value();
}

std::uint32_t ForeignClient::give_up(std::uint32_t code) {
  send(0x80, multiplexer_, code);
  world_.settle();
  return code;
}

// Uploads an object, after discarding the frames of previous transfers.
std::uint32_t ForeignClient::upload(std::uint16_t index) {
  while (port_.read()) {
  }
  multiplexer_ = index;
  data.clear();
  send(0xA4, multiplexer_, blksize_);
  if (!wait(patience)) {
    return give_up(timed_out);
  }
  if (is(0x80)) {
    return abort_code();
  }
  if (!is(0xC6) || !is_for_us()) {
    return give_up(unknown_command);
  }
  const std::uint32_t size = abort_code();
  send(0xA3);
  for (bool last = false; !last;) {
    if (const auto code = receive_block(last)) {
      return *code;
    }
  }
  return end_upload(size);
}

// Receives a block, which ends with its last segment or after a time without frames, and acknowledges it. Returns the
// abort code if the transfer has ended.
std::optional<std::uint32_t> ForeignClient::receive_block(bool& last) {
  std::uint8_t good = 0;
  for (bool ended = false; !ended;) {
    if (!wait(good == 0 ? patience : short_silence)) {
      if (good == 0) {
        return give_up(timed_out);
      }
      break;
    }
    if (is(0x80)) {
      return abort_code();
    }
    const unsigned number = answer_.Data[0] & 0x7FU;
    if (number == good + 1U) {
      ++good;
      last = (answer_.Data[0] & 0x80U) != 0;
      data.insert(data.end(), answer_.Data + 1, answer_.Data + 8);
    }
    ended = (answer_.Data[0] & 0x80U) != 0 || number == blksize_;
  }
  send(0xA2, static_cast<std::uint32_t>(good | (blksize_ << 8)));
  return std::nullopt;
}

std::uint32_t ForeignClient::end_upload(std::uint32_t size) {
  if (!wait(patience)) {
    return give_up(timed_out);
  }
  if (is(0x80)) {
    return abort_code();
  }
  if ((answer_.Data[0] & 0xE3U) != 0xC1) {
    return give_up(unknown_command);
  }
  data.resize(data.size() - ((answer_.Data[0] >> 2U) & 7U));
  if (data.size() != size) {
    return give_up(wrong_length);
  }
  if (CO_GET_WORD(&answer_, 1) != crc_16(data)) {
    return give_up(wrong_crc);
  }
  send(0xA1);
  world_.settle();
  return 0;
}

std::uint32_t ForeignClient::download(std::uint16_t index, const Bytes& all) {
  while (port_.read()) {
  }
  multiplexer_ = index;
  send(0xC6, multiplexer_, static_cast<std::uint32_t>(all.size()));
  unsigned blksize = 0;
  unsigned sent = 0;
  for (std::size_t position = 0; position < segments_of(all);) {
    if (!wait(patience)) {
      return give_up(timed_out);
    }
    if (is(0x80)) {
      return abort_code();
    }
    const bool begins = blksize == 0 && is(0xA4) && is_for_us();
    if (!begins && (!is(0xA2) || answer_.Data[1] > sent)) {
      return give_up(unknown_command);
    }
    position += begins ? 0 : answer_.Data[1];
    blksize = begins ? answer_.Data[4] : answer_.Data[2];
    sent = static_cast<unsigned>(std::min<std::size_t>(blksize, segments_of(all) - position));
    send_block(all, position, sent);
  }
  return end_download(all);
}

void ForeignClient::send_block(const Bytes& all, std::size_t position, unsigned segments) {
  for (unsigned n = 0; n < segments; ++n) {
    port_.send(segment_of(all, segment * (position + n), n + 1, request_id_));
  }
}

std::uint32_t ForeignClient::end_download(const Bytes& all) {
  port_.send(end_of(all, request_id_));
  if (!wait(patience)) {
    return give_up(timed_out);
  }
  if (is(0x80)) {
    return abort_code();
  }
  return is(0xA1) ? 0 : give_up(unknown_command);
}

}  // namespace test
