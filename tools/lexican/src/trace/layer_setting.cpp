// SPDX-License-Identifier: Apache-2.0
#include "trace/layer_setting.hpp"

#include "trace/text.hpp"

namespace lexican::trace {
namespace {

constexpr std::uint32_t from_master = 0x7E5;
constexpr std::uint32_t from_slave = 0x7E4;

// Command specifiers. [305]
constexpr unsigned switch_selective = 0x40;  // …43h
constexpr unsigned identify = 0x46;          // …4Bh
constexpr unsigned identified = 0x4F;
constexpr unsigned fastscan = 0x51;
constexpr unsigned fastscan_begin = 0x80;  // a bit
constexpr unsigned inquire = 0x5A;         // …5Dh

const char* part(unsigned number) {
  constexpr const char* parts[] = {"vendor-ID", "product code", "revision number", "serial number"};
  return parts[number & 3u];
}

std::string number(const CO_IF_FRM& frame) { return text(" %08Xh", CO_GET_LONG(&frame, 1)); }

std::string node_id_text(const CO_IF_FRM& frame) {
  return frame.Data[1] == 255 ? "no node-ID" : text("node-ID %u", frame.Data[1]);
}

std::string bit_timing(const CO_IF_FRM& frame) {
  constexpr unsigned rates[] = {1000, 800, 500, 250, 125, 0, 50, 20, 10};  // kbit/s
  const unsigned index = frame.Data[2];
  const bool known = frame.Data[1] == 0 && index < sizeof rates / sizeof *rates && rates[index] != 0;
  return known ? text("%u kbit/s", rates[index]) : text("table %u, index %u", frame.Data[1], index);
}

std::string limits(const CO_IF_FRM& frame) {
  switch (frame.Data[0] - identify) {
    case 0: return std::string(part(0)) + number(frame);
    case 1: return std::string(part(1)) + number(frame);
    case 2: return std::string(part(2)) + " from" + number(frame);
    case 3: return std::string(part(2)) + " to" + number(frame);
    case 4: return std::string(part(3)) + " from" + number(frame);
    default: return std::string(part(3)) + " to" + number(frame);
  }
}

std::string scan(const CO_IF_FRM& frame) {
  const unsigned bit = frame.Data[5];
  if (bit == fastscan_begin) {
    return "LSS fastscan start: all nodes without node-ID";
  }
  return std::string("LSS fastscan ") + part(frame.Data[6]) + number(frame) + text(", bits 31...%u", bit);
}

std::string request(const CO_IF_FRM& frame) {
  const unsigned command = frame.Data[0];
  if (command >= switch_selective && command < switch_selective + 4) {
    return std::string("LSS switch to configuration: ") + part(command - switch_selective) + number(frame);
  }
  if (command >= identify && command < identify + 6) {
    return "LSS identify: " + limits(frame);
  }
  if (command >= inquire && command < inquire + 4) {
    return std::string("LSS inquire ") + part(command - inquire);
  }
  switch (command) {
    case 0x04: return std::string("LSS switch all to ") + (frame.Data[1] == 0 ? "waiting" : "configuration");
    case 0x11: return "LSS configure " + node_id_text(frame);
    case 0x13: return "LSS configure bit timing: " + bit_timing(frame);
    case 0x15: return text("LSS activate bit timing, delay %u ms", CO_GET_WORD(&frame, 1));
    case 0x17: return "LSS store";
    case 0x4C: return "LSS identify nodes without node-ID";
    case fastscan: return scan(frame);
    case 0x5E: return "LSS inquire node-ID";
    default: return text("LSS unknown command %02Xh", command);
  }
}

/// Returns the text for the result of a service that can fail.
std::string result(const char* service, const CO_IF_FRM& frame) {
  const std::string words = std::string("LSS answer: ") + service;
  return words + (frame.Data[1] == 0 ? " done" : text(" refused, error %u", frame.Data[1]));
}

std::string answer(const CO_IF_FRM& frame) {
  const unsigned command = frame.Data[0];
  if (command >= inquire && command < inquire + 4) {
    return std::string("LSS answer: ") + part(command - inquire) + number(frame);
  }
  switch (command) {
    case 0x11: return result("configure node-ID", frame);
    case 0x13: return result("configure bit timing", frame);
    case 0x17: return result("store", frame);
    case 0x44: return "LSS answer: switched to configuration";
    case identified: return "LSS answer: identified";
    case 0x50: return "LSS answer: node without node-ID";
    case 0x5E: return "LSS answer: " + node_id_text(frame);
    default: return text("LSS answer: unknown command %02Xh", command);
  }
}

bool is_in_scan(const CO_IF_FRM& frame) {
  if (frame.Identifier == from_slave) {
    return frame.Data[0] == identified;
  }
  return frame.Data[0] == fastscan && frame.Data[5] != fastscan_begin;
}

}  // namespace

std::optional<Meaning> decode_layer_setting(const CO_IF_FRM& frame) {
  const bool is_request = frame.Identifier == from_master;
  if (frame.DLC != 8 || (!is_request && frame.Identifier != from_slave)) {
    return std::nullopt;
  }
  return Meaning{is_request ? request(frame) : answer(frame), is_in_scan(frame) ? Place::middle : Place::edge};
}

}  // namespace lexican::trace
