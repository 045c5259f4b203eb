// SPDX-License-Identifier: Apache-2.0
#include "gen_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

namespace test {

namespace {

constexpr std::uint32_t baud = 250000;
constexpr int enough = 300;  // calls of the node's functions until all work is done

std::vector<std::uint8_t> octets(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t n = 0; n + 1 < text.size(); n += 3) {
    std::uint8_t byte = 0;
    std::from_chars(&text[n], &text[n] + 2, byte, 16);
    bytes.push_back(byte);
  }
  return bytes;
}

std::string hex(std::uint64_t number, int digits) {
  std::string text;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) {
    text += "0123456789ABCDEF"[number >> shift & 0xF];
  }
  return text;
}

void add(std::string& text, const std::uint8_t* bytes, std::size_t number) {
  for (std::size_t n = 0; n < number; ++n) {
    text += (text.empty() ? "" : " ") + hex(bytes[n], 2);
  }
}

std::uint32_t word(const std::uint8_t* bytes) {
  return bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 | std::uint32_t{bytes[3]} << 24;
}

constexpr std::uint8_t aborted = 0x80;

std::string abort_text(const std::uint8_t* frame) { return "abort " + hex(word(frame + 4), 8); }

}  // namespace

GeneratedNode::GeneratedNode(const CO_OBJ* od, std::uint16_t length, Memory& memory)
    : GeneratedNode(od, length, memory, Errors()) {}

GeneratedNode::GeneratedNode(const CO_OBJ* od, std::uint16_t length, Memory& memory, Errors errors)
    : port_(bus_.attach({"node"})), client_(bus_.attach({"client"})), timer_(clock_) {
  clock_.set_frequency(1000);
  client_.enable(baud);
  ext_.Size = sizeof ext_;
  ext_.Can = &co::VirtualBusDriver;
  ext_.CanCtx = &port_;
  ext_.Timer = &co::VirtualTimerDriver;
  ext_.TimerCtx = &timer_;
  ext_.Nvm = &RamNvmDriver;
  ext_.NvmCtx = &memory.ram;
  ext_.EmcyNum = errors.number;
  CO_NODE_SPEC spec{};
  spec.NodeId = id;
  spec.Baudrate = baud;
  spec.Dict = const_cast<CO_OBJ*>(od);
  spec.DictLen = length;
  spec.TmrFreq = clock_.frequency();
  spec.EmcyCode = errors.first;
  spec.SdoBuf = sdo_memory_.data();
  CONodeInitEx(&node, &spec, &ext_);
  error = CONodeGetErr(&node);
  fault = CODictGetFault(&node.Dict, nullptr);
  CONodeStart(&node);
  settle();
}

GeneratedNode::~GeneratedNode() { CONodeStop(&node); }

void GeneratedNode::process() {
  CONodeProcess(&node);
  COTmrProcess(&node.Tmr);
}

void GeneratedNode::settle() {
  for (int n = 0; n < enough; ++n) {
    process();
  }
}

void GeneratedNode::say(std::uint32_t identifier, std::string_view hex_bytes) {
  const std::vector<std::uint8_t> bytes = octets(hex_bytes);
  CO_IF_FRM frame{identifier, {}, static_cast<std::uint8_t>(bytes.size())};
  std::copy(bytes.begin(), bytes.end(), frame.Data);
  client_.send(frame);
  settle();
}

void GeneratedNode::request(const Frame& request) {
  CO_IF_FRM frame{0x600U + id, {}, 8};
  std::copy(request.begin(), request.end(), frame.Data);
  client_.send(frame);
}

GeneratedNode::Frame GeneratedNode::next_answer() {
  for (int n = 0; n < enough; ++n) {
    while (const auto heard = client_.read()) {
      if (heard->Identifier == 0x580U + id) {
        Frame answer{};
        std::copy(heard->Data, heard->Data + 8, answer.begin());
        return answer;
      }
    }
    process();
  }
  return {};
}

GeneratedNode::Frame GeneratedNode::ask(const Frame& frame) {
  while (client_.read()) {
  }
  request(frame);
  return next_answer();
}

std::string GeneratedNode::sent_by(const std::function<void()>& call) {
  while (client_.read()) {
  }
  call();
  process();
  const auto heard = client_.read();
  if (!heard) {
    return "";
  }
  std::string text;
  add(text, heard->Data, heard->DLC);
  return fmt::format("{:X}: {}", heard->Identifier, text);
}

// Uploads expedited or segmented. [301:7.2.4.3.5, 7.2.4.3.6]
std::string GeneratedNode::read(std::uint16_t index, std::uint8_t sub_index) {
  Frame answer = ask({0x40, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8), sub_index});
  if (answer[0] == aborted) {
    return abort_text(answer.data());
  }
  if ((answer[0] & 0xE0U) != 0x40) {
    return "no answer";
  }
  std::string text;
  if ((answer[0] & 0x02U) != 0) {
    add(text, &answer[4], 4U - (answer[0] >> 2 & 3U));
    return text;
  }
  for (std::uint8_t toggle = 0;; toggle ^= 0x10U) {
    answer = ask({static_cast<std::uint8_t>(0x60U | toggle)});
    if (answer[0] == aborted) {
      return abort_text(answer.data());
    }
    if ((answer[0] & 0xE0U) != 0) {
      return "no segment";
    }
    add(text, &answer[1], 7U - (answer[0] >> 1 & 7U));
    if ((answer[0] & 1U) != 0) {
      return text;
    }
  }
}

namespace {

// CRC of a block transfer: polynomial 1021h, start 0000h. [301:7.2.4.3.16]
std::uint16_t crc_of(const std::string& bytes) {
  unsigned crc = 0;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned>(static_cast<unsigned char>(byte)) << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc = ((crc & 0x8000U) != 0 ? crc << 1 ^ 0x1021U : crc << 1) & 0xFFFFU;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace

// Uploads in blocks of 127 segments, with CRC. [301:7.2.4.3.12 to 7.2.4.3.15]
std::string GeneratedNode::read_block(std::uint16_t index, std::uint8_t sub_index) {
  constexpr std::uint8_t blksize = 127;
  Frame answer =
      ask({0xA4, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8), sub_index, blksize, 0});
  if (answer[0] != 0xC6) {
    return "";
  }
  const std::uint32_t size = word(&answer[4]);
  std::string bytes;
  request({0xA3});
  for (std::uint8_t seqno = 1;; ++seqno) {
    answer = next_answer();
    if ((answer[0] & 0x7FU) != seqno) {
      return "";
    }
    bytes.append(&answer[1], &answer[1] + 7);
    const bool is_last = (answer[0] & 0x80U) != 0;
    if (is_last || seqno == blksize) {
      request({0xA2, seqno, blksize});
      seqno = 0;
    }
    if (is_last) {
      break;
    }
  }
  answer = next_answer();
  bytes.resize(bytes.size() - (answer[0] >> 2 & 7U));
  request({0xA1});
  settle();
  const bool is_end = (answer[0] & 0xE3U) == 0xC1 && (answer[1] | answer[2] << 8) == crc_of(bytes);
  return is_end && bytes.size() == size ? bytes : "";
}

// Downloads expedited or segmented. [301:7.2.4.3.3, 7.2.4.3.4]
std::string GeneratedNode::write(std::uint16_t index, std::uint8_t sub_index, std::string_view hex_bytes) {
  const std::vector<std::uint8_t> bytes = octets(hex_bytes);
  Frame request{0x21, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8), sub_index,
                static_cast<std::uint8_t>(bytes.size())};
  if (bytes.size() <= 4) {
    request[0] = static_cast<std::uint8_t>(0x23U | (4U - bytes.size()) << 2);
    std::copy(bytes.begin(), bytes.end(), &request[4]);
  }
  Frame answer = ask(request);
  std::uint8_t toggle = 0;
  for (std::size_t sent = 0; bytes.size() > 4 && sent < bytes.size() && answer[0] != aborted; sent += 7) {
    const std::size_t number = std::min<std::size_t>(7, bytes.size() - sent);
    const bool is_last = sent + number == bytes.size();
    Frame segment{static_cast<std::uint8_t>(toggle | (7U - number) << 1 | (is_last ? 1U : 0U))};
    std::copy_n(&bytes[sent], number, &segment[1]);
    answer = ask(segment);
    toggle ^= 0x10U;
  }
  return answer[0] == aborted ? abort_text(answer.data()) : "ok";
}

}  // namespace test
