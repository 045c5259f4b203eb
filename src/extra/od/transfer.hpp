// SPDX-License-Identifier: Apache-2.0
// Accesses to extensible streams. The state of each is an OD_TRANSFER: for an SDO transfer from Begin to End, for the
// application's own access from Reset(0) to the next Reset(0).
#pragma once

#include "co_core.h"
#include "co_od.h"

namespace co::od {

// Bits of OD_TRANSFER.State.
enum Flag : uint8_t {
  all_passed = 0x01,         // the extension's function has read or written all bytes
  in_application = 0x02,     // a function of the application is running: its accesses are not part of the transfer
  by_server = 0x04,          // belongs to an SDO server channel: it ends once no channel has the object open
  has_kept_byte = 0x08,      // KeptByte contains the next byte
  extension_changed = 0x10,  // the object has got another extension: further accesses are refused
  rereads = 0x20,            // bytes are read again from the beginning, up to a position
};

[[nodiscard]] inline bool has(const OD_TRANSFER& transfer, Flag flag) { return (transfer.State & flag) != 0; }
inline void set(OD_TRANSFER& transfer, Flag flag) { transfer.State = static_cast<uint8_t>(transfer.State | flag); }
inline void clear(OD_TRANSFER& transfer, Flag flag) { transfer.State = static_cast<uint8_t>(transfer.State & ~flag); }

// Returns whether the reader has got all bytes.
[[nodiscard]] inline bool is_read_completely(const OD_TRANSFER& transfer) {
  return has(transfer, all_passed) && !has(transfer, has_kept_byte);
}

// Sets an access to the beginning of a stream of this length in bytes.
void restart(OD_TRANSFER& transfer, OD_size_t length);

// Returns whether the running access to the object belongs to the SDO transfer that is being processed. Returns false
// for an access by a function of the application, also one that this transfer has called.
[[nodiscard]] bool is_called_by_transfer(const OD_t& od, const CO_NODE& node, const CO_OBJ& obj);

// Returns the open SDO transfer of the object; null: none is open, or its channel no longer has the object open.
[[nodiscard]] OD_TRANSFER* find_transfer(OD_t& od, const CO_NODE& node, const CO_OBJ& obj);

// Returns the caller's access to the object: the SDO transfer that is being processed, or the access of the
// application. Null: it has not begun one.
[[nodiscard]] OD_TRANSFER* find_access(OD_t& od, const CO_NODE& node, const CO_OBJ& obj);

// Returns the SDO transfer of the object like find_transfer(), even if its channel no longer has the object open.
[[nodiscard]] OD_TRANSFER* first_transfer(OD_t& od, const CO_OBJ& obj);

// Marks an SDO transfer that accesses data as belonging to an SDO server channel, if a channel has the object open. An
// SDO client that accesses its own node has no channel.
void mark_if_of_server(OD_TRANSFER& transfer, const CO_NODE& node);

// Begins an SDO transfer of total bytes (CO_OBJ_SIZE_UNKNOWN: not indicated). Null: no OD_TRANSFER is free.
[[nodiscard]] OD_TRANSFER* begin_transfer(OD_t& od, const CO_NODE& node, const CO_OBJ& obj, uint32_t total);
void end_transfer(OD_TRANSFER& transfer);
// Begins an access of the application, which replaces its previous access.
[[nodiscard]] OD_TRANSFER& begin_access(OD_t& od, const CO_OBJ& obj);

// Ends all accesses to an object that has got another extension. SDO transfers are aborted (0800 0022h) at their next
// frame, or as soon as the function of the application that runs for one of them returns. The node need not be
// initialised.
void end_accesses(OD_t& od, uint16_t index);

// Returns whether the object of the SDO transfer that is being processed has got another extension since the transfer
// began.
[[nodiscard]] bool is_extension_changed(const CO_NODE& node, const CO_OBJ& obj);

[[nodiscard]] inline bool is_of_application(const OD_t& od, const OD_TRANSFER& transfer) {
  return &transfer == &od.Transfer[OD_TRANSFER_N - 1];
}

// Calls obj::pass_stream(), and then restores the application's own access. Value of CO_NODE.PassStream, which the Init
// function of extensible types sets.
CO_ERR pass_stream(CO_OBJ* source, CO_NODE* node, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes);

}  // namespace co::od
