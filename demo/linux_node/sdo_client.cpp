// SPDX-License-Identifier: Apache-2.0
#include "linux_node/sdo_client.hpp"

#include <algorithm>

#include "trace/decode.hpp"
#include "trace/text.hpp"

namespace demo {
namespace {

// First bytes of requests and answers. [301:7.2.4.3]
constexpr std::uint8_t download_expedited = 0x23;    // size given; bits 2 and 3: bytes without data
constexpr std::uint8_t download_in_segments = 0x21;  // size given
constexpr std::uint8_t download_accepted = 0x60;
constexpr std::uint8_t upload_request = 0x40;
constexpr std::uint8_t segment_request = 0x60;
constexpr std::uint8_t segment_accepted = 0x20;
constexpr std::uint8_t abort_transfer = 0x80;
constexpr std::uint8_t expedited = 0x02;
constexpr std::uint8_t size_given = 0x01;
constexpr std::uint8_t last_segment = 0x01;
constexpr std::uint8_t toggle_bit = 0x10;
constexpr std::uint8_t command_bits = 0xE0;
constexpr std::size_t segment_size = 7;

}  // namespace

std::string Transfer::outcome() const {
  if (abort_code != 0) {
    return "aborted with " + trace::abort_code(abort_code) + ' ' + trace::abort_meaning(abort_code);
  }
  return fault.empty() ? "done" : fault;
}

void SdoClient::abort(std::uint32_t code, const char* fault, Transfer& transfer) {
  CO_IF_FRM frame{0x600u + master_.node_id(), {abort_transfer}, 8};
  CO_SET_WORD(&frame, object_.index, 1);
  CO_SET_BYTE(&frame, object_.sub, 3);
  CO_SET_LONG(&frame, code, 4);
  transfer.fault = master_.send(frame) ? fault : "the bus takes no frames";
}

/// Sends a request and waits for the answer. Returns false if there is none or it is an abort.
bool SdoClient::ask(const Payload& request, CO_IF_FRM& response, Transfer& transfer) {
  CO_IF_FRM frame{0x600u + master_.node_id(), {}, 8};
  std::copy(std::begin(request), std::end(request), frame.Data);
  if (!master_.send(frame)) {
    transfer.fault = "the bus takes no frames";
    return false;
  }
  const auto is_answer = [&](const CO_IF_FRM& received) {
    return received.Identifier == 0x580u + master_.node_id() && received.DLC == 8;
  };
  const auto answer = master_.await(is_answer, timeout_);
  if (!answer) {
    abort(CO_SDO_ERR_TIMEOUT, "no answer", transfer);
    return false;
  }
  response = *answer;
  if (response.Data[0] == abort_transfer) {
    transfer.abort_code = CO_GET_LONG(&response, 4);
    return false;
  }
  return true;
}

/// Sends an initiate request; the answer has to name the same object.
bool SdoClient::begin(std::uint8_t command, Object object, const std::uint8_t* data, std::size_t size,
                      CO_IF_FRM& response, Transfer& transfer) {
  object_ = object;
  const auto low = static_cast<std::uint8_t>(object.index & 0xFFu);
  const auto high = static_cast<std::uint8_t>(object.index >> 8);
  Payload request = {command, low, high, object.sub};
  std::copy(data, data + size, request + 4);
  if (!ask(request, response, transfer)) {
    return false;
  }
  if (!std::equal(request + 1, request + 4, response.Data + 1)) {
    abort(CO_SDO_ERR_GENERAL, "the answer is for another object", transfer);
    return false;
  }
  return true;
}

Transfer SdoClient::upload(std::uint16_t index, std::uint8_t sub) {
  Transfer transfer;
  CO_IF_FRM response{};
  if (!begin(upload_request, {index, sub}, nullptr, 0, response, transfer)) {
    return transfer;
  }
  const std::uint8_t command = response.Data[0];
  if ((command & command_bits) != 0x40) {
    abort(CO_SDO_ERR_CMD, "the answer is none to an upload", transfer);
    return transfer;
  }
  if ((command & expedited) != 0) {
    const unsigned unused = (command & size_given) != 0 ? (command >> 2) & 3u : 0;
    transfer.data.assign(response.Data + 4, response.Data + 8 - unused);
    return transfer;
  }
  upload_segments(transfer);
  if (transfer.done() && (command & size_given) != 0 && transfer.data.size() != CO_GET_LONG(&response, 4)) {
    transfer.fault = "another size than announced";
  }
  return transfer;
}

void SdoClient::upload_segments(Transfer& transfer) {
  std::uint8_t toggle = 0;
  CO_IF_FRM response{};
  do {
    if (!ask({static_cast<std::uint8_t>(segment_request | toggle)}, response, transfer)) {
      return;
    }
    if ((response.Data[0] & (command_bits | toggle_bit)) != toggle) {
      abort(CO_SDO_ERR_TBIT, "not the segment that was requested", transfer);
      return;
    }
    const std::size_t unused = (response.Data[0] >> 1) & 7u;
    transfer.data.insert(transfer.data.end(), response.Data + 1, response.Data + 8 - unused);
    toggle ^= toggle_bit;
  } while ((response.Data[0] & last_segment) == 0);
}

Transfer SdoClient::download(std::uint16_t index, std::uint8_t sub, const Bytes& data) {
  Transfer transfer;
  CO_IF_FRM response{};
  const bool short_enough = data.size() <= 4;
  bool accepted = false;
  if (short_enough) {
    const auto command = static_cast<std::uint8_t>(download_expedited | ((4 - data.size()) << 2));
    accepted = begin(command, {index, sub}, data.data(), data.size(), response, transfer);
  } else {
    CO_IF_FRM size{};
    CO_SET_LONG(&size, data.size(), 0);
    accepted = begin(download_in_segments, {index, sub}, size.Data, 4, response, transfer);
  }
  if (accepted && response.Data[0] != download_accepted) {
    abort(CO_SDO_ERR_CMD, "the answer is none to a download", transfer);
  } else if (accepted && !short_enough) {
    download_segments(data, transfer);
  }
  return transfer;
}

void SdoClient::download_segments(const Bytes& data, Transfer& transfer) {
  std::uint8_t toggle = 0;
  for (std::size_t position = 0; position < data.size(); position += segment_size) {
    const std::size_t size = std::min(segment_size, data.size() - position);
    const bool last = position + size == data.size();
    Payload request = {static_cast<std::uint8_t>(toggle | ((segment_size - size) << 1) | (last ? last_segment : 0u))};
    std::copy_n(data.data() + position, size, request + 1);
    CO_IF_FRM response{};
    if (!ask(request, response, transfer)) {
      return;
    }
    if (response.Data[0] != (segment_accepted | toggle)) {
      abort(CO_SDO_ERR_TBIT, "the segment was not confirmed", transfer);
      return;
    }
    toggle ^= toggle_bit;
  }
}

}  // namespace demo
