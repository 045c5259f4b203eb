// SPDX-License-Identifier: Apache-2.0
// Where the accesses to streams that can be extended stand. Each has its place (OD_TRANSFER): an SDO transfer from
// Begin to End, the application's own access from Reset(0) to the next.
#pragma once

#include "co_core.h"
#include "co_od.h"

namespace co::od {

// OD_TRANSFER.State
enum Flag : uint8_t {
  exhausted = 0x01,  // the function has passed all
  inside = 0x02,     // a function of the application runs: what that accesses is none of the transfer
  by_server = 0x04,  // it ends as soon as no channel has the object open
  holds = 0x08,      // Held is the next byte
  lost = 0x10,       // the object has got another extension: whatever comes next is refused
  returns = 0x20,    // it reads again what has passed, to come to a position
};

[[nodiscard]] inline bool has(const OD_TRANSFER& transfer, Flag flag) { return (transfer.State & flag) != 0; }
inline void set(OD_TRANSFER& transfer, Flag flag) { transfer.State = static_cast<uint8_t>(transfer.State | flag); }
inline void clear(OD_TRANSFER& transfer, Flag flag) { transfer.State = static_cast<uint8_t>(transfer.State & ~flag); }

// Has everything been given to whoever reads?
[[nodiscard]] inline bool is_ended(const OD_TRANSFER& transfer) {
  return has(transfer, exhausted) && !has(transfer, holds);
}

// At the beginning, of a stream with this length.
void restart(OD_TRANSFER& transfer, OD_size_t length);

// Does the SDO transfer that is being served access its object, and not a function of the application within?
[[nodiscard]] bool is_served(const OD_t& od, const CO_NODE& node, const CO_OBJ& obj);

// The SDO transfer of the object from its begin to its end; null: none is open, or it was lost.
[[nodiscard]] OD_TRANSFER* find_transfer(OD_t& od, const CO_NODE& node, const CO_OBJ& obj);

// The access that goes on with the object: of whoever calls. Null: nobody has begun one.
[[nodiscard]] OD_TRANSFER* find_access(OD_t& od, const CO_NODE& node, const CO_OBJ& obj);

// The same, if its channel has closed it already.
[[nodiscard]] OD_TRANSFER* first_transfer(OD_t& od, const CO_OBJ& obj);

// The SDO transfer passes data: it lasts as long as its channel, if it has one. A client to the own node has none.
void bind(OD_TRANSFER& transfer, const CO_NODE& node);

// Places for an SDO transfer (null: there is none left) and for the application, whose access before that is over.
[[nodiscard]] OD_TRANSFER* begin_transfer(OD_t& od, const CO_NODE& node, const CO_OBJ& obj, uint32_t total);
void end_transfer(OD_TRANSFER& transfer);
[[nodiscard]] OD_TRANSFER& begin_access(OD_t& od, const CO_OBJ& obj);

// The object has got another extension: all that goes on with it ends. SDO transfers are aborted (0800 0022h), at their
// next frame, or as soon as the function of the application is over that runs for one. The node need not be
// initialised.
void end_accesses(OD_t& od, uint16_t index);

// Has that happened to the SDO transfer that is being served?
[[nodiscard]] bool is_lost(const CO_NODE& node, const CO_OBJ& obj);

[[nodiscard]] inline bool is_of_application(const OD_t& od, const OD_TRANSFER& transfer) {
  return &transfer == &od.Transfer[OD_TRANSFER_N - 1];
}

}  // namespace co::od
