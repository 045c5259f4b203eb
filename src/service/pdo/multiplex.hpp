// SPDX-License-Identifier: Apache-2.0
// Functions of the service mpdo that the service pdo calls where multiplex PDOs differ from other PDOs. With CO_MPDO_N
// 0 no PDO is a multiplex PDO.
#pragma once

#include "co_core.h"

namespace co::mpdo {

// Values of sub 0 of the mapping for multiplex PDOs. [301:7.5.2.36, 38]
inline constexpr uint8_t sam = 0xFE;  // source address mode
inline constexpr uint8_t dam = 0xFF;  // destination address mode

// Bits of CO_MPDO.Transferred, and the index of an object in them. position = num: the scanner list does not contain
// it.
struct Transferred {
  uint8_t* bytes;
  unsigned position;
  unsigned num;
};

#if CO_MPDO_N > 0

// Return whether the PDO is a multiplex PDO in source or destination address mode, or in any of them (is_mpdo()).
[[nodiscard]] inline bool is_sam(const CO_PDO_MAP& map) { return map.Mode == sam; }
[[nodiscard]] inline bool is_dam(const CO_PDO_MAP& map) { return map.Mode == dam; }
[[nodiscard]] inline bool is_mpdo(const CO_PDO_MAP& map) { return map.Mode != 0; }
inline void clear_mode(CO_PDO_MAP& map) { map.Mode = 0; }

// Returns whether sub 0 of the mapping of the PDO, whose communication parameter has this index, selects a multiplex
// PDO. Such a PDO is event-driven. [301:7.2.3.2]
[[nodiscard]] bool is_selected(CO_NODE& node, unsigned index);

// Like pdo::resolve(), for a number of mapped objects above CO_PDO_MAP_N.
[[nodiscard]] CO_ERR resolve(CO_NODE& node, unsigned index, unsigned num, CO_PDO_MAP& map);

// Processes a frame for an RPDO that is a multiplex PDO. Returns false if it is malformed.
[[nodiscard]] bool receive(CO_PDO& pdo, const CO_IF_FRM& frame);
// Resolves the faults of an RPDO that stops.
void end_rpdo(CO_PDO& pdo);

// Makes the TPDO the producer, which sends the objects of the scanner list, if its mode is source address mode; else
// clears the producer if it was this TPDO. A TPDO in destination address mode gets no event time.
void begin_tpdo(CO_PDO& pdo, unsigned number);

// Sends the pending objects of the scanner list, each at most once; with an inhibit time only one of them. Continues
// only while the transmit queue is empty.
[[nodiscard]] CO_ERR send_pending(CO_PDO& pdo);

// Mark an object of the scanner list as pending (false: it is not in the list), or all objects if the TPDO is in source
// address mode. entry: number of an entry of the dictionary
bool mark(CO_NODE& node, uint16_t entry);
void mark_all(CO_PDO& pdo);
// Returns whether the TPDO is in source address mode and objects are pending. clear_marks() removes their marks.
[[nodiscard]] bool is_pending(const CO_PDO& pdo);
void clear_marks(CO_PDO& pdo);

// Returns whether an object of the scanner list was sent, and clears this mark. transferred() returns the mark's bit.
[[nodiscard]] bool was_sent(CO_NODE& node, uint16_t entry);
[[nodiscard]] Transferred transferred(CO_NODE& node, uint16_t entry);

#else

[[nodiscard]] inline bool is_sam(const CO_PDO_MAP&) { return false; }
[[nodiscard]] inline bool is_dam(const CO_PDO_MAP&) { return false; }
[[nodiscard]] inline bool is_mpdo(const CO_PDO_MAP&) { return false; }
inline void clear_mode(CO_PDO_MAP&) {}
[[nodiscard]] inline bool is_selected(CO_NODE&, unsigned) { return false; }
[[nodiscard]] inline CO_ERR resolve(CO_NODE&, unsigned, unsigned, CO_PDO_MAP&) { return CO_ERR_OBJ_MAP_LEN; }
[[nodiscard]] inline bool receive(CO_PDO&, const CO_IF_FRM&) { return false; }
inline void end_rpdo(CO_PDO&) {}
inline void begin_tpdo(CO_PDO&, unsigned) {}
[[nodiscard]] inline CO_ERR send_pending(CO_PDO&) { return CO_ERR_NONE; }
inline bool mark(CO_NODE&, uint16_t) { return false; }
inline void mark_all(CO_PDO&) {}
[[nodiscard]] inline bool is_pending(const CO_PDO&) { return false; }
inline void clear_marks(CO_PDO&) {}
[[nodiscard]] inline bool was_sent(CO_NODE&, uint16_t) { return false; }
[[nodiscard]] inline Transferred transferred(CO_NODE&, uint16_t) { return {nullptr, 0, 0}; }

#endif

}  // namespace co::mpdo
