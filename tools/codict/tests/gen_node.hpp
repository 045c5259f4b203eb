// SPDX-License-Identifier: Apache-2.0
/// \file gen_node.hpp
/// Node with a generated dictionary on a virtual bus, and an SDO client that accesses it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "co_core.h"
#include "co_nvm_ram.h"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

namespace test {

/// Non-volatile memory, which outlives a node.
struct Memory {
  std::array<std::uint8_t, 1024> bytes{};
  CO_NVM_RAM ram{bytes.data(), static_cast<std::uint32_t>(bytes.size())};

  Memory() { CONvmRamClear(&ram); }
};

class GeneratedNode {
 public:
  static constexpr std::uint8_t id = 5;

  /// Emergency codes that the application of the dictionary may raise.
  struct Errors {
    CO_EMCY_TBL* first = nullptr;
    std::uint16_t number = 0;
  };

  GeneratedNode(const CO_OBJ* od, std::uint16_t length, Memory& memory);
  GeneratedNode(const CO_OBJ* od, std::uint16_t length, Memory& memory, Errors errors);
  ~GeneratedNode();
  GeneratedNode(const GeneratedNode&) = delete;
  GeneratedNode& operator=(const GeneratedNode&) = delete;

  /// Uploads an object. Returns its bytes in hexadecimal, "01 02", or "abort 06020000".
  std::string read(std::uint16_t index, std::uint8_t sub_index);
  /// Uploads an object by block transfer. Returns its bytes; empty after an abort, or if the CRC is wrong.
  std::string read_block(std::uint16_t index, std::uint8_t sub_index);
  /// Downloads to an object. Returns "ok" or "abort 06090031".
  std::string write(std::uint16_t index, std::uint8_t sub_index, std::string_view hex_bytes);
  /// Transmits a frame to the node.
  void say(std::uint32_t identifier, std::string_view hex_bytes);
  /// Returns the first frame that the node transmits because of a call, "185: 01 02"; empty if it transmits none.
  std::string sent_by(const std::function<void()>& call);
  /// Results of CODictGetFault() and CONodeGetErr() after the start.
  CO_DICT_FAULT fault = CO_DICT_OK;
  CO_ERR error = CO_ERR_NONE;

  CO_NODE node{};

 private:
  using Frame = std::array<std::uint8_t, 8>;
  Frame ask(const Frame& request);
  void request(const Frame& request);
  Frame next_answer();
  void process();
  void settle();

  co::VirtualClock clock_;
  co::VirtualBus bus_;
  co::VirtualBus::Port& port_;
  co::VirtualBus::Port& client_;
  co::VirtualTimer timer_;
  CO_NODE_EXT ext_{};
  std::array<std::uint8_t, CO_SSDO_N * CO_SDO_BUF_BYTE> sdo_memory_{};
};

}  // namespace test
