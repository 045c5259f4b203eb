// SPDX-License-Identifier: Apache-2.0
// SDO client functions of a fixture.
#include <algorithm>

#include "fixture.hpp"

namespace test {
namespace {

CO_IF_FRM request(std::uint8_t command, std::uint16_t index, std::uint8_t sub, std::uint32_t last_bytes) {
  CO_IF_FRM frm{};
  CO_SET_ID(&frm, 0x601);
  CO_SET_DLC(&frm, 8);
  CO_SET_BYTE(&frm, command, 0);
  CO_SET_WORD(&frm, index, 1);
  CO_SET_BYTE(&frm, sub, 3);
  CO_SET_LONG(&frm, last_bytes, 4);
  return frm;
}

}  // namespace

Bytes Fixture::upload(std::uint16_t index, std::uint8_t sub, Where at) {
  const auto answer_to = [&](const CO_IF_FRM& frm) {
    rx(frm, at);
    const CO_IF_FRM answer = can.sent.size() == 1 ? can.sent.front().frm : CO_IF_FRM{0, {0x80}, 8};
    can.sent.clear();
    return answer;
  };
  CO_IF_FRM answer = answer_to(request(0x40, index, sub, 0));
  if ((answer.Data[0] & 0xE3U) == 0x43U) {
    return Bytes(answer.Data + 4, answer.Data + 8 - ((answer.Data[0] >> 2) & 3U));
  }
  const bool is_announced = answer.Data[0] == 0x41;
  if (!is_announced && answer.Data[0] != 0x40) {
    return {};
  }
  const std::uint32_t announced = CO_GET_LONG(&answer, 4);
  Bytes data;
  std::uint8_t toggle = 0;
  do {
    answer = answer_to(request(static_cast<std::uint8_t>(0x60U | toggle), 0, 0, 0));
    if ((answer.Data[0] & 0xF0U) != toggle) {
      return {};
    }
    data.insert(data.end(), answer.Data + 1, answer.Data + 8 - ((answer.Data[0] >> 1) & 7U));
    toggle ^= 0x10U;
  } while ((answer.Data[0] & 1U) == 0);
  return !is_announced || data.size() == announced ? data : Bytes{};
}

std::uint32_t Fixture::download(std::uint16_t index, std::uint8_t sub, const Bytes& data, bool announced, Where at) {
  const auto abort_of = [&](const CO_IF_FRM& frm, std::uint8_t accepted) -> std::uint32_t {
    rx(frm, at);
    const CO_IF_FRM answer = can.sent.size() == 1 ? can.sent.front().frm : CO_IF_FRM{};
    can.sent.clear();
    return answer.Data[0] == accepted ? 0 : CO_GET_LONG(&answer, 4) + (answer.Data[0] == 0x80 ? 0U : 1U);
  };
  const auto size = static_cast<std::uint32_t>(data.size());
  std::uint32_t abort = abort_of(request(announced ? 0x21 : 0x20, index, sub, announced ? size : 0), 0x60);
  std::uint8_t toggle = 0;
  std::size_t done = 0;
  bool last = false;
  while (abort == 0 && !last) {
    const std::size_t length = std::min<std::size_t>(7, data.size() - done);
    last = done + length == data.size();
    CO_IF_FRM frm = request(static_cast<std::uint8_t>(toggle | ((7 - length) << 1) | (last ? 1U : 0U)), 0, 0, 0);
    std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(done), length, frm.Data + 1);
    abort = abort_of(frm, static_cast<std::uint8_t>(0x20U | toggle));
    done += length;
    toggle ^= 0x10U;
  }
  return abort;
}

BlockResult Fixture::block_upload(std::uint16_t index, std::uint8_t sub, const BlockOptions& options, Where at) {
  return BlockClient(*this, options, at).upload(index, sub);
}

BlockResult Fixture::block_download(std::uint16_t index, std::uint8_t sub, const Bytes& data,
                                    const BlockOptions& options, Where at) {
  return BlockClient(*this, options, at).download(index, sub, data);
}

}  // namespace test
