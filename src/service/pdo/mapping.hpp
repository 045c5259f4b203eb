// SPDX-License-Identifier: Apache-2.0
// Resolved PDO mappings: the mapping entries of a PDO, the copies that they require, and the copying itself.
#pragma once

#include "base/callbacks.hpp"
#include "base/events.hpp"
#include "co_core.h"
#include "dictionary/dict.hpp"
#include "dictionary/lock.hpp"
#include "dictionary/obj.hpp"
#include "wire/bytes.hpp"

namespace co::pdo {

using dict::Lock;
using dict::read_number;

enum class Direction : uint8_t { receive, transmit };

// Origin of a mapping: the table (designer) or a write by the network. The value is the flag of CO_OBJ.Key that a
// mapped object needs besides R or W: flag P if the network maps it, none if the designer does.
enum class MappedBy : uint8_t { designer = 0, network = CO_OBJ____P__ };

// Bits of CO_PDO_MAP.Flags; TpdoFlag has those of a TPDO.
constexpr uint8_t transferred = 0x40;  // sent or received since the application has read it
constexpr uint8_t changed = 0x80;      // configure_changed() configures the PDO

[[nodiscard]] inline bool has(const CO_PDO_MAP& map, unsigned flags) { return (map.Flags & flags) != 0; }
inline void set(CO_PDO_MAP& map, unsigned flags) { map.Flags = static_cast<uint8_t>(map.Flags | flags); }
inline void clear(CO_PDO_MAP& map, unsigned flags) { map.Flags = static_cast<uint8_t>(map.Flags & ~flags); }

[[nodiscard]] inline bool exists(const CO_PDO_MAP& map) { return map.Length != 0; }

// Returns the length of the frame in bytes.
[[nodiscard]] inline uint8_t length_of(const CO_PDO_MAP& map) {
  return USE_PDO_BITS != 0 ? static_cast<uint8_t>((map.Length + 7U) / 8U) : map.Length;
}

// A PDO is named by the index of its communication or mapping parameters: 1400h…, 1600h… and 1800h…, 1A00h….
constexpr Direction direction_of(unsigned index) {
  constexpr unsigned of_tpdo = 0x0800;
  return (index & of_tpdo) != 0 ? Direction::transmit : Direction::receive;
}

// Returns whether a mapping value is allowed. [301:7.4.7, 7.5.2.36]
[[nodiscard]] CO_ERR check(CO_NODE& node, Direction direction, uint32_t mapping, MappedBy author);

// Outcome of resolving a mapping.
struct Resolved {
  CO_ERR err;
  uint8_t sub;  // sub-index of the entry with the error; 0: their number is wrong, or there is no error
};

// Resolves num entries of the mapping at index (1600h…, 1A00h…). Sets map.Length only on success.
[[nodiscard]] Resolved resolve(CO_NODE& node, unsigned index, unsigned num, CO_PDO_MAP& map, MappedBy author);

// Copying ------------------------------------------------------------------------------------------------------------

constexpr bool maps_bits = USE_PDO_BITS != 0;
constexpr uint8_t one_byte = maps_bits ? 8 : 1;  // unit of CO_PDO_MAP.Length and Step
// A Step is the length of one copy. Adjacent numbers may be joined to one copy of 4 or 8 bytes; the steps of the others
// are then 0.
constexpr uint8_t by_type = 0x80;                // bit of Step[0]: objects are copied by their types
constexpr uint8_t shifted = maps_bits ? 1 : 16;  // bit of Step: the number is not aligned in the frame

typedef volatile uint32_t Word __attribute__((may_alias));
typedef volatile uint16_t Half __attribute__((may_alias));

// Copies the 8 bytes of a frame to or from a buffer; both are aligned.
inline void copy_data(uint8_t* to, const uint8_t* from) {
  wire::put_aligned(to, wire::get_aligned(from));
  wire::put_aligned(to + sizeof(Word), wire::get_aligned(from + sizeof(Word)));
}

// Copies the data of a frame into the objects of a PDO, or the objects into a frame, with OdLock held. RPDO: objects
// that cannot be written become the node's error, the others are written. TPDO: returns the error of an object that
// cannot be read.
[[nodiscard]] CO_ERR copy_objects(CO_NODE& node, const CO_PDO_MAP& map, CO_IF_FRM& frame, Direction direction);

[[nodiscard]] inline uint16_t number_of(const CO_NODE& node, const CO_OBJ& obj) {
  return static_cast<uint16_t>(&obj - node.Dict.Root);
}

// Returns the slot of an entry in the mapping, or CO_PDO_MAP_N.
[[nodiscard]] unsigned find(const CO_PDO_MAP& map, uint16_t entry);

// Returns whether the PDO maps an entry. Span is a cheap pre-filter: it rejects most PDOs without reading their
// mapping.
[[nodiscard, gnu::always_inline]] inline bool maps(const CO_PDO_MAP& map, uint16_t entry) {
  const auto behind = static_cast<uint16_t>(entry - map.Entry[0]);
  return behind >> map.Span == 0 && find(map, entry) != CO_PDO_MAP_N;
}

// Marks the PDO and all its objects as sent or received. take_transferred() returns and clears the mark.
inline void mark_transferred(CO_PDO_MAP& map) {
  __builtin_memset(map.Transferred, 0xFF, sizeof map.Transferred);
  set(map, transferred);
}
[[nodiscard]] bool take_transferred(CO_PDO_MAP& map);
[[nodiscard]] bool take_transferred(CO_PDO_MAP& map, uint16_t entry);

// Reception of RPDOs, as far as multiplex PDOs share it
// ----------------------------------------------------------------

// Bits of CO_RPDO.Faults.
enum RpdoFault : uint8_t {
  too_short = 0x01,  // pdo_short is raised
  too_long = 0x02,   // pdo_long is raised
  late = 0x04,       // pdo_timeout is raised
  unknown = 0x08,    // multiplex PDO: pdo_unknown is raised, because the frame names no object
};

// Returns whether the bit rate is being switched: RPDOs are ignored then.
[[nodiscard]] inline bool is_switching([[maybe_unused]] const CO_NODE& node) {
  return (USE_LSS != 0 || USE_LSS_MASTER != 0) && node.Transmit.Off != 0;
}

// Returns the number of the PDO from 1 as detail of its faults (255 for all numbers above).
[[nodiscard]] uint8_t detail_of(const CO_RPDO& pdo);

// Raises or resolves the given faults, from too_short to late, so that those in is are raised and the others are not.
// Each change is reported once.
void report(CO_RPDO& pdo, unsigned faults, unsigned is);

// Restarts the deadline and resolves the fault of a missed one: a frame was received, or the deadline has changed.
void restart_deadline(CO_RPDO& pdo);

// Transmission of TPDOs, as far as multiplex PDOs share it
// --------------------------------------------------------------

// Bits of CO_PDO_MAP.Flags of a TPDO.
enum TpdoFlag : uint8_t {
  pending = 0x01,    // an event is deferred until the inhibit time has elapsed, or until the SYNC
  inhibited = 0x02,  // event-driven: the inhibit time is running
  sampled = 0x04,    // synchronous: Data holds the sample of the last SYNC
  waiting = 0x08,    // Count holds the SYNC start value, which was not reached yet; else Count is the number of SYNCs
  remote = 0x10,     // remote requests are allowed
  marked = 0x20,     // send_marked() triggers the PDO
};

// Cause of a transmission: the event time after it starts now, or at the expiry of the timer, so that it does not
// drift.
enum class Cause : uint8_t { event, timer };

[[nodiscard]] inline bool is_operational(const CO_NODE& node) { return event::is_allowed(node, CO_PDO_ALLOWED); }

// Sends an event-driven PDO. On an error nothing is sent later, but the event timer is restarted. Events for this PDO
// from its own callbacks are ignored while it is being sent.
CO_ERR send_event(CO_TPDO& pdo, Cause cause);

// Restarts the inhibit or event time of a PDO that was sent by an event.
void restart(CO_TPDO& pdo);

}  // namespace co::pdo
