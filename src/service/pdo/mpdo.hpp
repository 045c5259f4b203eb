// SPDX-License-Identifier: Apache-2.0
// Multiplex PDOs: each frame names its object. [301:7.2.3]
#pragma once

#include "service/pdo/plan.hpp"

namespace co::mpdo {

using pdo::Direction;

// The bits of CO_MPDO.Transferred, with the place of an object in them. place = num: the list does not contain it.
struct Transferred {
  uint8_t* bytes;
  unsigned place;
  unsigned num;
};

// Values of sub 0 of the mapping for multiplex PDOs. [301:7.5.2.36, 38]
inline constexpr uint8_t sam = 0xFE;  // source address mode
inline constexpr uint8_t dam = 0xFF;  // destination address mode

#if USE_MPDO

// Return whether the PDO is a multiplex PDO in source or destination address mode, or in any of them (is_mpdo()).
[[nodiscard]] inline bool is_sam(const CO_PDO_MAP& map) { return map.Mode == sam; }
[[nodiscard]] inline bool is_dam(const CO_PDO_MAP& map) { return map.Mode == dam; }
[[nodiscard]] inline bool is_mpdo(const CO_PDO_MAP& map) { return map.Mode != 0; }
inline void set_mode(CO_PDO_MAP& map, uint8_t mode) { map.Mode = mode; }

// Like pdo::resolve(), for a number of mapped objects above CO_PDO_MAP_N.
[[nodiscard]] CO_ERR resolve(CO_NODE& node, unsigned index, unsigned num, CO_PDO_MAP& map);

// Resolve the scanner and the dispatching list. Entries with an invalid object are omitted; the first error is
// returned.
[[nodiscard]] CO_ERR resolve_scan(CO_NODE& node);
[[nodiscard]] CO_ERR resolve_dispatch(CO_NODE& node);
// Returns why an object cannot be sent or received in a multiplex PDO. obj: null if the dictionary has none with the
// key
[[nodiscard]] CO_ERR check_object(CO_NODE& node, Direction direction, CO_OBJ* obj, uint32_t key);

// Consumer -----------------------------------------------------------------------------------------------------------

// Return whether the frame matches the addressing mode of the PDO, and addresses this node.
[[nodiscard]] bool is_kind(const CO_PDO_MAP& map, const CO_IF_FRM& frame);
[[nodiscard]] bool is_addressed(const CO_NODE& node, const CO_PDO_MAP& map, const CO_IF_FRM& frame);

// Returns the object that the frame writes; null: there is none.
[[nodiscard]] CO_OBJ* find(CO_NODE& node, const CO_PDO_MAP& map, const CO_IF_FRM& frame);
// Writes the data of the frame to that object, and marks the object and the PDO as received.
void write(CO_NODE& node, CO_PDO_MAP& map, CO_OBJ& obj, const CO_IF_FRM& frame);

// Producer in source address mode ------------------------------------------------------------------------------------
// entry: number of an entry of the dictionary; place: index of an object in the scanner list (CO_MPDO.Scan).

// Makes the TPDO the producer, which sends the objects of the scanner list, if its mode is source address mode; else
// clears the producer if it was this TPDO.
void set_producer(CO_NODE& node, unsigned number, const CO_PDO_MAP& map);
[[nodiscard]] CO_TPDO* producer(CO_NODE& node);

// Mark an object of the scanner list as pending (false: it is not in the list), or all objects if the TPDO is the
// producer.
bool mark(CO_NODE& node, uint16_t entry);
void mark_all(CO_TPDO& pdo);
void forget_marks(CO_NODE& node);
[[nodiscard]] bool is_waiting(const CO_NODE& node);

// Finds the next pending object in the order of the list, beginning behind the one sent last.
[[nodiscard]] bool next(CO_NODE& node, uint16_t& place);
// Fills a frame, whose identifier is set, with an object.
[[nodiscard]] CO_ERR read(CO_NODE& node, uint16_t place, CO_IF_FRM& frame);

// Clears the mark of an object that was sent, or could not be read, and advances the round-robin index behind it.
// entry: the object at place before callbacks were called
void finish_object(CO_NODE& node, uint16_t place, uint16_t entry, bool sent);
[[nodiscard]] bool was_sent(CO_NODE& node, uint16_t entry);
[[nodiscard]] Transferred transferred(CO_NODE& node, uint16_t entry);

#else

[[nodiscard]] inline bool is_sam(const CO_PDO_MAP&) { return false; }
[[nodiscard]] inline bool is_dam(const CO_PDO_MAP&) { return false; }
[[nodiscard]] inline bool is_mpdo(const CO_PDO_MAP&) { return false; }
inline void set_mode(CO_PDO_MAP&, uint8_t) {}
[[nodiscard]] inline CO_ERR resolve(CO_NODE&, unsigned, unsigned, CO_PDO_MAP&) { return CO_ERR_OBJ_MAP_LEN; }
[[nodiscard]] inline bool is_kind(const CO_PDO_MAP&, const CO_IF_FRM&) { return true; }
[[nodiscard]] inline bool is_addressed(const CO_NODE&, const CO_PDO_MAP&, const CO_IF_FRM&) { return true; }
inline void set_producer(CO_NODE&, unsigned, const CO_PDO_MAP&) {}
inline bool mark(CO_NODE&, uint16_t) { return false; }
inline void mark_all(CO_TPDO&) {}
inline void forget_marks(CO_NODE&) {}
[[nodiscard]] inline bool is_waiting(const CO_NODE&) { return false; }
[[nodiscard]] inline bool was_sent(CO_NODE&, uint16_t) { return false; }
[[nodiscard]] inline Transferred transferred(CO_NODE&, uint16_t) { return {nullptr, 0, 0}; }

#endif

}  // namespace co::mpdo
