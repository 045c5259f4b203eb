// SPDX-License-Identifier: Apache-2.0
// What the dictionary says of PDOs.
#pragma once

#include "service/pdo/plan.hpp"

namespace co::pdo {

constexpr uint16_t first_rpdo = 0x1400;
constexpr uint16_t first_tpdo = 0x1800;
constexpr uint16_t from_communication_to_mapping = 0x0200;

// Transmission types. [301:7.5.2.37 table 71]
constexpr uint8_t type_acyclic = 0;
constexpr uint8_t last_synchronous_type = 240;
constexpr uint8_t type_rtr_synchronous = 252;
constexpr uint8_t type_rtr = 253;
constexpr uint8_t type_event = 254;
constexpr uint8_t default_type = 255;

constexpr bool is_synchronous(uint8_t type) {
  return USE_SYNC != 0 && (type <= last_synchronous_type || type == type_rtr_synchronous);
}
constexpr bool is_acyclic(uint8_t type) { return USE_SYNC != 0 && type == type_acyclic; }
constexpr bool is_event_driven(uint8_t type) { return type >= type_event; }
[[nodiscard]] bool is_type(Direction direction, uint8_t type);

// Communication parameters of a PDO, whose index they have. [301:7.5.2.35, 37]
struct Parameters {
  uint32_t cob_id;   // wire::cob_invalid: the PDO does not exist
  uint32_t inhibit;  // ticks
  uint32_t event;    // ticks
  uint8_t type;
};

// SYNC start value of a TPDO; 0: none.
[[nodiscard]] uint8_t start_value(CO_NODE& node, uint16_t number);

// Ticks of a number of units; the longest time that there is where they do not fit.
[[nodiscard]] uint32_t ticks(const CO_NODE& node, uint16_t time, uint32_t unit);

// Takes parameters and mapping. A PDO that they do not allow does not exist; the node's error says so.
void configure(CO_NODE& node, Direction direction, uint16_t index, Parameters& parameters, CO_PDO_MAP& map);

// Resolves the mapping of the PDO that exists.
[[nodiscard]] CO_ERR resolve(CO_NODE& node, Direction direction, uint16_t index, CO_PDO_MAP& map);

// A single PDO, from the dictionary.
void configure_rpdo(CO_NODE& node, uint16_t number);
void configure_tpdo(CO_NODE& node, uint16_t number);

// The event timer has changed.
void change_deadline(CO_NODE& node, uint16_t number, uint32_t ticks);
void change_event_time(CO_NODE& node, uint16_t number, uint32_t ticks);

}  // namespace co::pdo
