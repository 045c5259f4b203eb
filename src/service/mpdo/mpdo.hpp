// SPDX-License-Identifier: Apache-2.0
// Multiplex PDOs: each frame contains the multiplexer of its object. [301:7.2.3]
#pragma once

#include "base/part.hpp"
#include "service/pdo/mapping.hpp"

namespace co::mpdo {

// Clears CO_MPDO.Producer. To be called before the PDOs are configured from the dictionary.
void init(CO_NODE& node);

// Sends pending objects of the scanner list when the controller can accept frames. Always returns false: one call sends
// as many as possible, so that another call would send nothing.
[[nodiscard]] bool on_free(CO_NODE& node, uint16_t number);

// Implements COTPdoSendTo() (co_pdo.h).
[[nodiscard]] CO_ERR send_to(CO_NODE& node, uint16_t number, uint8_t node_id, uint32_t key, uint32_t value);

inline constexpr Part part = Part().init(init).free(on_free);

// Object scanner list and object dispatching list, resolved into CO_MPDO. [301:7.5.2.39-40]

using pdo::Direction;

inline constexpr uint16_t no_producer = 0;  // CO_MPDO.Producer holds numbers of TPDOs from 1

// Resolve the scanner and the dispatching list. Omit entries with an invalid object, and return the first error.
[[nodiscard]] CO_ERR resolve_scan(CO_NODE& node);
[[nodiscard]] CO_ERR resolve_dispatch(CO_NODE& node);

// Returns the reason why an object cannot be sent or received in a multiplex PDO; CO_ERR_NONE: it can. It must have up
// to 4 bytes; static data types have no data. obj: null if the dictionary has no object with the key
[[nodiscard]] CO_ERR check_object(CO_NODE& node, Direction direction, CO_OBJ* obj, uint32_t key);

// Maps an object to the bytes after the multiplexer of the frame, for pdo::copy_objects(). Returns CO_ERR_OBJ_SIZE if
// the object has more than 4 bytes. CORPdoObjWasReceived() finds it in the mapping until another object is mapped.
[[nodiscard]] CO_ERR map_object(CO_NODE& node, CO_PDO_MAP& map, CO_OBJ& obj);

// Returns the object of an entry number; null if CODictInit() has renumbered the entries, until remap() has run.
[[nodiscard]] CO_OBJ* object_at(CO_NODE& node, uint16_t entry);

// Scanner list -------------------------------------------------------------------------------------------------------
// position: index of an object in the list (CO_MPDO.Scan)

// Returns whether objects are pending; clear_marks() removes all marks.
[[nodiscard]] bool is_waiting(const CO_NODE& node);
void clear_marks(CO_NODE& node);

// Finds the next pending object in the order of the list, beginning after the object that was sent last.
[[nodiscard]] bool next(CO_NODE& node, uint16_t& position);

// Clears the mark of an object that was sent or could not be read, and sets the round-robin index to the next object.
// entry: the object at position before callbacks were called
void finish_object(CO_NODE& node, uint16_t position, uint16_t entry, bool sent);

}  // namespace co::mpdo
