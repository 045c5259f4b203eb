// SPDX-License-Identifier: Apache-2.0
#include "sdo_client_peer.hpp"

#if USE_CSDO

#include <algorithm>
#include <utility>

namespace test {
namespace {

constexpr std::uint32_t answer_id = 0x585;
constexpr std::size_t segment_bytes = 7;

CO_IF_FRM answer(std::uint8_t command) { return {answer_id, {command}, 8}; }

CO_IF_FRM answer_for_object(std::uint8_t command, std::uint32_t last_bytes) {
  CO_IF_FRM frm = {answer_id, {command, 0x00, 0x20, 0x05}, 8};
  CO_SET_LONG(&frm, last_bytes, 4);
  return frm;
}

bool zero_from(const CO_IF_FRM& frm, unsigned first) {
  return std::all_of(frm.Data + first, frm.Data + 8, [](std::uint8_t byte) { return byte == 0; });
}

}  // namespace

std::uint16_t crc_of(const Bytes& data) {
  std::uint32_t crc = 0;
  for (const std::uint8_t byte : data) {
    for (unsigned bit = 0x80; bit != 0; bit >>= 1U) {
      const bool feedback = ((crc & 0x8000U) != 0) != ((byte & bit) != 0);
      crc = ((crc << 1U) ^ (feedback ? 0x1021U : 0U)) & 0xFFFFU;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

SdoPeer::SdoPeer(Bytes data, PeerOptions options) : object(std::move(data)), options_(std::move(options)) {}

void SdoPeer::expect(bool right, const char* what) {
  if (!right && fault.empty()) {
    fault = what;
  }
}

Frames SdoPeer::answers_to(const CO_IF_FRM& request) {
  expect(request.Identifier == 0x605 && request.DLC == 8, "identifier or length of a request");
  const std::uint8_t command = request.Data[0];
  if (command == 0x80) {
    abort = CO_GET_LONG(&request, 4);
    state_ = State::idle;
    return {};
  }
  switch (state_) {
    case State::idle: return initiate(request);
    case State::upload: expect(command == 0xA3 && zero_from(request, 1), "start of an upload"); return next_sub_block();
    case State::sub_block: return acknowledged(request);
    case State::upload_end:
      expect(command == 0xA1 && zero_from(request, 1), "end of an upload");
      is_done = true;
      state_ = State::idle;
      return {};
    case State::download: return segment_received(request);
    case State::download_end: return end_received(request);
  }
  return {};
}

Frames SdoPeer::initiate(const CO_IF_FRM& request) {
  switch (request.Data[0]) {
    case 0xA0:
    case 0xA4: return initiate_upload(request);
    case 0xC0:
    case 0xC2:
    case 0xC4:
    case 0xC6: return initiate_download(request);
    default: expect(false, "initiate"); return {answer_for_object(0x80, CO_SDO_ERR_CMD)};
  }
}

Frames SdoPeer::initiate_upload(const CO_IF_FRM& request) {
  expect(notation(request) == "605#A40020057F1C0000", "initiate of a block upload");
  const auto command = static_cast<std::uint8_t>(0xC0U | (options_.crc ? 4U : 0U) | (options_.announces ? 2U : 0U));
  state_ = State::upload;
  position_ = 0;
  block_size_ = request.Data[4];
  return {answer_for_object(command, options_.announces ? static_cast<std::uint32_t>(object.size()) : 0)};
}

Frames SdoPeer::next_sub_block() {
  state_ = State::sub_block;
  Frames all;
  std::size_t from = position_;
  do {
    const std::size_t length = std::min(segment_bytes, object.size() - from);
    CO_IF_FRM frm = answer(static_cast<std::uint8_t>(all.size() + 1));
    std::copy_n(object.begin() + static_cast<std::ptrdiff_t>(from), length, frm.Data + 1);
    from += length;
    if (from == object.size()) {
      frm.Data[0] |= 0x80U;
    }
    all.push_back(frm);
  } while (from < object.size() && all.size() < block_size_);
  sent_ = static_cast<unsigned>(all.size());
  return all;
}

Frames SdoPeer::acknowledged(const CO_IF_FRM& request) {
  const unsigned sequence = request.Data[1];
  expect(request.Data[0] == 0xA2 && zero_from(request, 3), "form of an acknowledge");
  expect(sequence <= sent_ && request.Data[2] == 127, "numbers of an acknowledge");
  if (sequence > sent_) {
    return {};
  }
  position_ = std::min(object.size(), position_ + segment_bytes * sequence);
  block_size_ = request.Data[2];
  const bool all_taken = position_ == object.size() && (sequence > 0 || sent_ == 0);
  if (!all_taken) {
    return next_sub_block();
  }
  const std::size_t length = object.empty() ? 0 : (object.size() - 1) % segment_bytes + 1;
  CO_IF_FRM frm = answer(static_cast<std::uint8_t>(0xC1U | ((segment_bytes - length) << 2U)));
  const std::uint16_t crc = options_.crc ? crc_of(object) : std::uint16_t{0};
  CO_SET_WORD(&frm, crc, 1);
  state_ = State::upload_end;
  return {frm};
}

Frames SdoPeer::initiate_download(const CO_IF_FRM& request) {
  expect(request.Data[0] == 0xC6 && (CO_GET_LONG(&request, 0) >> 8U) == 0x052000U, "initiate of a block download");
  announced_ = CO_GET_LONG(&request, 4);
  object.clear();
  received_ = 0;
  last_ = false;
  block_size_ = options_.block_sizes[0];
  blocks_ = 1;
  state_ = State::download;
  repeat_ = {answer_for_object(options_.crc ? 0xA4 : 0xA0, block_size_)};
  return repeat_;
}

CO_IF_FRM SdoPeer::acknowledge() {
  CO_IF_FRM frm = answer(0xA2);
  frm.Data[1] = static_cast<std::uint8_t>(received_);
  block_size_ = options_.block_sizes[blocks_++ % options_.block_sizes.size()];
  frm.Data[2] = block_size_;
  received_ = 0;
  repeat_ = {frm};
  return frm;
}

Frames SdoPeer::segment_received(const CO_IF_FRM& request) {
  const unsigned sequence = request.Data[0] & 0x7FU;
  const bool last = (request.Data[0] & 0x80U) != 0;
  expect(sequence >= 1 && sequence <= block_size_, "sequence number of a segment");
  const bool ends = last || sequence == block_size_;
  if (sequence == received_ + 1) {
    ++received_;
    object.insert(object.end(), request.Data + 1, request.Data + 8);
    last_ = last;
  }
  if (last_) {
    state_ = State::download_end;
  }
  return ends ? Frames{acknowledge()} : Frames{};
}

Frames SdoPeer::end_received(const CO_IF_FRM& request) {
  const std::size_t unused = (request.Data[0] >> 2U) & 7U;
  expect((request.Data[0] & 0xE3U) == 0xC1 && zero_from(request, 3), "form of the end");
  const auto padding = static_cast<std::ptrdiff_t>(std::min(unused, object.size()));
  const bool blank = std::all_of(object.end() - padding, object.end(), [](std::uint8_t byte) { return byte == 0; });
  expect(blank, "padding of the last segment");
  object.resize(object.size() - static_cast<std::size_t>(padding));
  const std::uint16_t crc = options_.crc ? crc_of(object) : std::uint16_t{0};
  state_ = State::idle;
  if (object.size() != announced_) {
    return {answer_for_object(0x80, CO_SDO_ERR_LEN)};
  }
  if (CO_GET_WORD(&request, 1) != crc) {
    return {answer_for_object(0x80, CO_SDO_ERR_CRC)};
  }
  is_done = true;
  return {answer(0xA1)};
}

Frames SdoPeer::after_silence() {
  if (state_ != State::download) {
    return {};
  }
  return received_ == 0 ? repeat_ : Frames{acknowledge()};
}

namespace {

// Transmits the frames of one direction, with the fault if it is in this direction.
class Way {
 public:
  Way(const Disturbance& disturbance, bool to_node) : kind_(disturbance.kind), at_(disturbance.at) {
    if (disturbance.to_node != to_node) {
      kind_ = Disturbance::Kind::none;
    }
  }
  Frames pass(const Frames& frames) {
    Frames all;
    for (const CO_IF_FRM& frm : frames) {
      const bool here = number_++ == at_ && kind_ != Disturbance::Kind::none;
      put(all, frm, here);
    }
    return all;
  }

 private:
  void put(Frames& all, CO_IF_FRM frm, bool here) {
    using Kind = Disturbance::Kind;
    if (here && kind_ == Kind::swap_with_next) {
      held_ = {frm};
      return;
    }
    if (here && kind_ == Kind::change_bit) {
      frm.Data[4] ^= 0x10U;
    }
    if (!here || kind_ != Kind::lose) {
      all.push_back(frm);
    }
    if (here && kind_ == Kind::repeat) {
      all.push_back(frm);
    }
    all.insert(all.end(), held_.begin(), held_.end());
    held_.clear();
  }
  Disturbance::Kind kind_;
  std::size_t at_;
  std::size_t number_ = 0;
  Frames held_;
};

Frames take_sent(SdoClient& node) {
  Frames all;
  for (const Sent& sent : node.can.sent) {
    all.push_back(sent.frm);
  }
  node.can.sent.clear();
  return all;
}

void deliver(SdoClient& node, const Frames& frames) {
  node.can.to_node.insert(node.can.to_node.end(), frames.begin(), frames.end());
  while (!node.can.to_node.empty()) {
    node.loop();
  }
}

}  // namespace

bool serve(SdoClient& node, SdoPeer& peer, const Disturbance& disturbance) {
  Way to_peer(disturbance, false);
  Way to_node(disturbance, true);
  unsigned silences = 0;
  while (silences < 12) {
    const Frames requests = to_peer.pass(take_sent(node));
    Frames answers;
    for (const CO_IF_FRM& request : requests) {
      const Frames some = peer.answers_to(request);
      answers.insert(answers.end(), some.begin(), some.end());
    }
    if (!node.ends.empty() && requests.empty()) {
      return true;
    }
    if (requests.empty()) {
      ++silences;
      node.after(250ms);
      answers = node.can.sent.empty() ? peer.after_silence() : Frames{};
    }
    deliver(node, to_node.pass(answers));
  }
  return !node.ends.empty();
}

}  // namespace test

#endif
