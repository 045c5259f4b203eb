// SPDX-License-Identifier: Apache-2.0
/// \file node_objects.hpp
/// The dictionary of the node under test: an object of each kind, and application types that refuse access, return any
/// length, and call the stack.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "co_core.h"
#include "fuzz/node_network.hpp"

namespace fuzz {

/// \name Actions of the application within its type functions, defined by the fuzz target
/// \{
void meddle();                              ///< may call the stack
CO_ERR mood();                              ///< may call the stack, and returns an error in some calls
std::uint32_t chance(std::uint32_t limit);  ///< returns a random number below \a limit
/// \}

inline constexpr std::uint32_t large_domain = 2000;  ///< bytes; larger than the buffer of an SDO server
inline constexpr std::uint32_t long_value = 20;      ///< bytes; longest value of the application types

/// Memory block of exactly the object's size: the address sanitizer detects an access to the byte behind it.
using Memory = std::unique_ptr<std::uint8_t[]>;

struct Objects {
  NetworkObjects network;
  std::uint8_t error_register = 0;
  std::uint16_t heartbeat = 0;
  std::uint32_t cob_id[4] = {0x600, 0x580, 0x685, 0x586};
  std::uint32_t client_tx[2] = {0x606, 0x607};
  std::uint32_t client_rx[2] = {0x587, 0x588};
  std::uint8_t server_node_id[2] = {6, 7};
  std::uint8_t u8 = 1;
  std::uint16_t u16 = 2;
  std::uint32_t u24 = 3;
  std::uint32_t u32 = 4;
  std::uint64_t u40 = 5;
  std::uint64_t u56 = 6;
  std::uint64_t u64 = 7;
  std::uint64_t direct = 7;  // value of an entry that holds it directly where pointers have 64 bits
  std::int32_t s24 = -1;
  float real32 = 1.0F;
  double real64 = 1.0;
  CO_TIME_OF_DAY time_of_day{};
  std::uint8_t boolean = 0;
  std::uint8_t no_access = 0;
  Memory domain_memory = std::make_unique<std::uint8_t[]>(30);
  Memory small_memory = std::make_unique<std::uint8_t[]>(3);
  Memory large_memory = std::make_unique<std::uint8_t[]>(large_domain);
  Memory text_memory = std::make_unique<std::uint8_t[]>(12);
  Memory octets_memory = std::make_unique<std::uint8_t[]>(9);
  Memory unicode_memory = std::make_unique<std::uint8_t[]>(16);
  CO_OBJ_DOM domain{0, 30, domain_memory.get()};
  CO_OBJ_DOM small_domain{0, 3, small_memory.get()};
  CO_OBJ_DOM large{0, large_domain, large_memory.get()};
  CO_OBJ_STR_RW text{0, 0, 12, text_memory.get()};
  CO_OBJ_STR_RW octets{0, 9, 9, octets_memory.get()};
  CO_OBJ_STR_RW unicode{0, 16, 16, unicode_memory.get()};
  CO_OBJ_STR_RW nothing{0, 0, 0, nullptr};
#if USE_OD
  Memory extended_memory = std::make_unique<std::uint8_t[]>(10);
  CO_OBJ_STR_RW extended_text{0, 0, 10, extended_memory.get()};
#endif
  CO_OBJ_STR name{0, reinterpret_cast<const std::uint8_t*>("hello device")};
};

/// A stream type with Begin and End; its length is unknown until its end has been read.
struct Source {
  static constexpr std::uint32_t bytes = 50;
  std::uint32_t position = 0;
  bool is_read = false;
  unsigned open = 0;       ///< number of open transfers
  bool has_moved = false;  ///< the entry has moved: an open transfer may have lost it, without a call of End
};
extern Source source;

#if USE_OD
/// Extension of the stream 2000h:14 and the text 2000h:15: it obeys or violates the contract of extensions at random.
extern OD_extension_t extension;
#endif

std::vector<CO_OBJ> dictionary(Objects& o);

}  // namespace fuzz
