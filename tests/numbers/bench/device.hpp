// SPDX-License-Identifier: Apache-2.0
/// \file device.hpp
/// The node whose operations are counted: its dictionary, and drivers that store frames and times in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "co_core.h"

namespace bench {

constexpr std::uint8_t node_id = 5;
constexpr std::uint32_t ticks_per_second = 1000;

extern CO_NODE node;

/// \name The dictionary, entries in any order
/// \{
void clear_dictionary();
void add(std::uint16_t index, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data);
/// Adds the objects of a typical device: device information, SYNC consumer, EMCY producer with history, heartbeat
/// consumers for the nodes of heard_nodes, one SDO server.
void add_usual_objects();
constexpr std::uint8_t heard_nodes[] = {10, 20, 30};
constexpr std::uint16_t heard_period = 1000;  ///< ms
/// \}

/// \name PDOs and their objects: numbers, at separate addresses of the PDO's memory
/// \{
struct Layout {
  std::uint8_t width;   ///< bytes of a number
  std::uint8_t number;  ///< count of numbers
  std::uint8_t stride;  ///< bytes from one number to the next
  constexpr std::uint8_t length() const { return static_cast<std::uint8_t>(width * number); }
};
constexpr Layout bytes{1, 8, 1};
constexpr Layout scattered_bytes{1, 8, 3};
constexpr Layout halves{2, 4, 2};
constexpr Layout scattered_halves{2, 4, 6};
constexpr Layout words{4, 2, 4};
constexpr Layout scattered_words{4, 2, 12};

void add_rpdo(std::uint16_t number, std::uint8_t type, const Layout& layout);
void add_tpdo(std::uint16_t number, std::uint8_t type, const Layout& layout, bool remote = false);
/// Return the index of the objects of a PDO, which have the sub-indices from 1 on, and their memory.
std::uint16_t rpdo_objects(std::uint16_t number);
std::uint16_t tpdo_objects(std::uint16_t number);
std::uint8_t* rpdo_memory(std::uint16_t number);
std::uint8_t* tpdo_memory(std::uint16_t number);
std::uint32_t rpdo_id(std::uint16_t number);
std::uint32_t tpdo_id(std::uint16_t number);
/// Returns true if the frame has the bytes of the objects.
bool holds(const CO_IF_FRM& frame, const Layout& layout, const std::uint8_t* memory);
/// \}

/// Initialises the node with the dictionary, starts it, and removes its boot-up message from the sent frames.
void start(CO_MODE mode);

/// \name The bus
/// \{
CO_IF_FRM frame(std::uint32_t identifier, std::initializer_list<std::uint8_t> data);
void receive(const CO_IF_FRM& frame);  ///< the driver's Read returns the frame
std::size_t sent();                    ///< number of frames since forget_sent()
const CO_IF_FRM& sent(std::size_t place);
void forget_sent();
bool is_same(const CO_IF_FRM& a, const CO_IF_FRM& b);
/// Returns true if exactly that frame was sent.
bool has_sent(const CO_IF_FRM& frame);
/// \}

/// \name The timer
/// \{
void elapse();                      ///< advances the time to the next expiry; call COTmrService() afterwards
void advance(std::uint32_t ticks);  ///< advances the time, and calls COTmrService() and COTmrProcess()
/// \}

}  // namespace bench
