// SPDX-License-Identifier: Apache-2.0
// Configuration of PDOs from the dictionary.
#pragma once

#include "service/pdo/mapping.hpp"

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

// Returns the SYNC start value of a TPDO; 0: none.
[[nodiscard]] uint8_t start_value(CO_NODE& node, unsigned number);

// Converts a time to ticks; 0: the time is 0, or beyond the timer's range.
[[nodiscard]] uint32_t ticks(const CO_NODE& node, uint32_t time, uint32_t unit);

// Returns the number of the PDO whose communication parameter has this index.
constexpr unsigned number_of(unsigned index) { return index & 0x01FFU; }

// The key of a TPDO for messages: its communication parameter; 0: no TPDO can have this number.
constexpr uint32_t key_of_tpdo(unsigned number) {
  constexpr unsigned most = 512;
  return number < most ? CO_DEV(first_tpdo + number, 0) : 0;
}

// Stops the PDO with the communication parameter at index, reads parameters and mapping from the dictionary, and starts
// the PDO with them. A PDO that they do not allow does not exist; the node's error and its key name the parameter or
// the mapping entry.
void configure(CO_NODE& node, unsigned index);
// Requests configure(): deferred, so that no PDO changes while it is being processed.
void request_configuration(CO_NODE& node, unsigned index);

// Resolves the mapping of the PDO, which must have at least one entry.
[[nodiscard]] Resolved resolve(CO_NODE& node, unsigned index, CO_PDO_MAP& map);

// Remote requests of a TPDO: bit 30 of its COB-ID.
enum class Remote : uint8_t { ignored, answered };

// Stop the present operation of a PDO, and start the configured one. identifier: wire::no_frame if the PDO does not
// exist; event: ticks
void end_rpdo(CO_NODE& node, CO_PDO& pdo);
void end_tpdo(CO_NODE& node, CO_PDO& pdo);
void begin_rpdo(CO_PDO& pdo, uint32_t identifier, uint32_t event);
void begin_tpdo(CO_PDO& pdo, uint32_t identifier, Remote requests);

// Apply a change of sub-index 5 while the PDO exists: the deadline of an RPDO, the event timer of a TPDO.
void change_deadline(CO_NODE& node, unsigned number, uint32_t ticks);
void change_event_time(CO_NODE& node, unsigned number, uint32_t ticks);

}  // namespace co::pdo
