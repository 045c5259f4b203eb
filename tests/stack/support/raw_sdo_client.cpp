// SPDX-License-Identifier: Apache-2.0
#include "raw_sdo_client.hpp"

#include <algorithm>

namespace test {
namespace {

using End = SdoResult::End;

constexpr std::uint32_t wrong_toggle = 0x05030000;
constexpr std::uint32_t timed_out = 0x05040000;
constexpr std::uint32_t unknown_command = 0x05040001;

std::array<std::uint8_t, 8> initiate(std::uint8_t command, std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
  return {command,
          static_cast<std::uint8_t>(index),
          static_cast<std::uint8_t>(index >> 8),
          sub,
          static_cast<std::uint8_t>(value),
          static_cast<std::uint8_t>(value >> 8),
          static_cast<std::uint8_t>(value >> 16),
          static_cast<std::uint8_t>(value >> 24)};
}

std::uint32_t value_of(const CO_IF_FRM& frame) {
  return frame.Data[4] | (std::uint32_t{frame.Data[5]} << 8) | (std::uint32_t{frame.Data[6]} << 16) |
         (std::uint32_t{frame.Data[7]} << 24);
}

bool names_the_same(const std::array<std::uint8_t, 8>& request, const CO_IF_FRM& answer) {
  return std::equal(&request[1], &request[1] + 3, &answer.Data[1]);
}

}  // namespace

RawSdoClient::RawSdoClient(World& world, Line& line, std::uint8_t node_id)
    : RawSdoClient(world, line, 0x600u + node_id, 0x580u + node_id) {}

RawSdoClient::RawSdoClient(World& world, Line& line, std::uint32_t request_id, std::uint32_t response_id)
    : port(line.bus.attach({"client"})), world_(world), request_id_(request_id) {
  port.filter(&response_id, 1);
  port.enable();
}

unsigned RawSdoClient::drain() {
  unsigned frames = 0;
  while (port.read()) {
    ++frames;
  }
  return frames;
}

void RawSdoClient::send(const Request& request) {
  CO_IF_FRM frame{request_id_, {}, 8};
  std::copy(request.begin(), request.end(), frame.Data);
  port.send(frame);
  world_.settle();
}

std::optional<CO_IF_FRM> RawSdoClient::ask(const Request& request) {
  drain();
  send(request);
  return port.read();
}

std::optional<CO_IF_FRM> RawSdoClient::wait() {
  const Milliseconds step{100};
  for (Milliseconds waited{0}; waited < time_out_ && port.waiting() == 0; waited += step) {
    world_.pass(step);
  }
  return port.read();
}

// Sends a request and receives the answer. Returns the result of the transfer if it has ended; otherwise the transfer
// continues with \a answer.
std::optional<SdoResult> RawSdoClient::exchange(const Request& request, CO_IF_FRM& answer) {
  send(request);
  const std::optional<CO_IF_FRM> frame = (port.waiting() != 0) ? port.read() : wait();
  if (!frame) {
    return cancel(request, timed_out, End::timed_out);
  }
  answer = *frame;
  if (answer.DLC == 8 && answer.Data[0] == 0x80) {
    return SdoResult{End::aborted, value_of(answer)};
  }
  return std::nullopt;
}

SdoResult RawSdoClient::cancel(const Request& request, std::uint32_t code, End end) {
  const std::uint16_t index = static_cast<std::uint16_t>(request[1] | (request[2] << 8));
  send(initiate(0x80, index, request[3], code));
  return {end};
}

SdoResult RawSdoClient::upload(std::uint16_t index, std::uint8_t sub) {
  drain();
  const Request request = initiate(0x40, index, sub, 0);
  CO_IF_FRM answer{};
  if (const auto end = exchange(request, answer)) {
    return *end;
  }
  const std::uint8_t command = answer.Data[0];
  const bool expedited = (command & 0xF3) == 0x43;
  if (answer.DLC != 8 || !names_the_same(request, answer) || (!expedited && command != 0x41)) {
    return cancel(request, unknown_command, End::cancelled);
  }
  if (expedited) {
    return {End::done, 0, {&answer.Data[4], &answer.Data[8 - ((command >> 2) & 3)]}};
  }
  return upload_segments(request, value_of(answer));
}

SdoResult RawSdoClient::upload_segments(const Request& initiate, std::uint32_t size) {
  SdoResult result{End::done};
  for (std::uint8_t toggle = 0;; toggle ^= 0x10) {
    CO_IF_FRM answer{};
    if (const auto end = exchange({static_cast<std::uint8_t>(0x60 | toggle)}, answer)) {
      return *end;
    }
    const std::uint8_t command = answer.Data[0];
    if (answer.DLC != 8 || (command & 0xF0) != toggle) {
      return cancel(initiate, wrong_toggle, End::cancelled);
    }
    result.data.insert(result.data.end(), &answer.Data[1], &answer.Data[8 - ((command >> 1) & 7)]);
    const bool last = (command & 1) != 0;
    if (result.data.size() > size || (last && result.data.size() != size)) {
      return cancel(initiate, unknown_command, End::cancelled);
    }
    if (last) {
      return result;
    }
  }
}

SdoResult RawSdoClient::download(std::uint16_t index, std::uint8_t sub, const std::vector<std::uint8_t>& data) {
  drain();
  const Request request = initiate(0x21, index, sub, static_cast<std::uint32_t>(data.size()));
  CO_IF_FRM answer{};
  if (const auto end = exchange(request, answer)) {
    return *end;
  }
  if (answer.DLC != 8 || answer.Data[0] != 0x60 || !names_the_same(request, answer)) {
    return cancel(request, unknown_command, End::cancelled);
  }
  std::size_t sent = 0;
  std::uint8_t toggle = 0;
  do {
    const std::size_t n = std::min<std::size_t>(7, data.size() - sent);
    const bool last = sent + n == data.size();
    Request segment{static_cast<std::uint8_t>(toggle | ((7 - n) << 1) | (last ? 1 : 0))};
    std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(sent), n, segment.begin() + 1);
    if (const auto end = exchange(segment, answer)) {
      return *end;
    }
    if (answer.DLC != 8 || answer.Data[0] != (0x20 | toggle)) {
      return cancel(request, wrong_toggle, End::cancelled);
    }
    sent += n;
    toggle ^= 0x10;
  } while (sent < data.size());
  return {End::done};
}

}  // namespace test
