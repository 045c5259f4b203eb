// SPDX-License-Identifier: Apache-2.0
#include "block_frames.hpp"

#include <algorithm>

namespace test {

Bytes counting(std::size_t size, unsigned first) {
  Bytes data(size);
  std::generate(data.begin(), data.end(), [&] { return static_cast<std::uint8_t>(first++); });
  return data;
}

Place domain_of(std::uint32_t size) {
  switch (size) {
    case 889: return {0x2101, 0};
    case 70000: return {0x2102, 0};
    case 888: return {0x2103, 0};
    case 890: return {0x2104, 0};
    case mebibyte: return {0x2105, 0};
    default: return {0x2100, static_cast<std::uint8_t>(size)};
  }
}

CO_IF_FRM block_segment(const Bytes& data, std::size_t place, unsigned seqno) {
  CO_IF_FRM frm{0x601, {}, 8};
  const std::size_t length = std::min<std::size_t>(7, data.size() - 7 * place);
  const bool last = 7 * place + length == data.size();
  frm.Data[0] = static_cast<std::uint8_t>(seqno | (last ? 0x80U : 0U));
  std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(7 * place), length, frm.Data + 1);
  return frm;
}

void send_segments(Fixture& node, const Bytes& data, std::size_t place, std::size_t number, unsigned seqno, Where at) {
  for (std::size_t n = 0; n < number; ++n) {
    node.rx(block_segment(data, place + n, seqno++), at);
  }
}

void expect_segments(Fixture& node, const Bytes& data, std::size_t place, std::size_t number, Where at) {
  std::vector<std::string> expected;
  for (unsigned n = 0; n < number; ++n) {
    CO_IF_FRM frm = block_segment(data, place + n, n + 1);
    frm.Identifier = 0x581;
    expected.push_back(notation(frm));
  }
  const std::vector<std::string> sent = node.frames();
  if (sent != expected) {
    ADD_FAIL_CHECK_AT(at.file, at.line,
                      "segments expected: " << doctest::toString(expected) << ", sent: " << doctest::toString(sent));
  }
}

void expect_last_ack(Fixture& node, unsigned ackseq, Where at) {
  CO_IF_FRM frm{0x581, {0xA2, static_cast<std::uint8_t>(ackseq)}, 8};
  if (!node.can.sent.empty()) {
    frm.Data[2] = node.can.sent.front().frm.Data[2];
  }
  node.tx(notation(frm), at);
}

CO_IF_FRM block_end(std::uint32_t identifier, const Bytes& data) {
  const std::size_t unused = data.empty() ? 7 : (7 - data.size() % 7) % 7;
  CO_IF_FRM frm{identifier, {static_cast<std::uint8_t>(0xC1U | (unused << 2))}, 8};
  CO_SET_WORD(&frm, crc_16(data), 1);
  return frm;
}

}  // namespace test
