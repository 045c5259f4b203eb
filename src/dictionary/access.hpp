// SPDX-License-Identifier: Apache-2.0
// Access of the network to the dictionary: for SDO servers, and for SDO clients that access their own node.
#pragma once

#include "co_assert.h"
#include "co_core.h"
#include "dictionary/abort_code.hpp"
#include "dictionary/obj.hpp"

namespace co::access {

// Checks that the access rights and the type of an object allow the transfer. obj: entry of the key, null if the
// dictionary has none. Returns an abort code.
[[nodiscard]] Abort check(const CO_NODE& node, uint32_t key, const CO_OBJ* obj, CO_OBJ_TRANSFER transfer);

// Returns the length in bytes of an object; its type has a Size function, as check() has found.
// width: bytes of a download, 0 for an upload.
[[nodiscard]] inline uint32_t size(CO_OBJ& obj, CO_NODE& node, uint32_t width) {
  CO_ASSERT(obj.Type != nullptr && obj.Type->Size != nullptr);
  return obj.Type->Size(&obj, &node, width);
}

// Scope of a request to access an object: COObjTypeUserSDOAbort() is accepted for this object only (null: for none). A
// request may begin in a type function of the object of another request, which continues at the end of the scope.
class Request {
 public:
  Request(CO_NODE& node, CO_OBJ* obj) : node_(node), outer_(node.Request), request_{obj, 0} {
    node.Request = &request_;
  }
  ~Request() { node_.Request = outer_; }
  Request(const Request&) = delete;
  Request& operator=(const Request&) = delete;

 private:
  CO_NODE& node_;
  CO_REQUEST* outer_;
  CO_REQUEST request_;
};

// Returns the object of the request that is being processed, or null.
[[nodiscard]] inline CO_OBJ* requested_object(const CO_NODE& node) {
  return node.Request != nullptr ? node.Request->Obj : nullptr;
}

// Returns the abort code that COObjTypeUserSDOAbort() has set for the request, or none.
[[nodiscard]] inline Abort user_abort(const CO_NODE& node) {
  return node.Request != nullptr ? Abort{node.Request->Abort} : Abort::none;
}

// Open transfers ------------------------------------------------------------------------------------------------------
// An SDO server channel (CO_SDO) whose Obj is not null has a transfer of this object open. Services and the OD access
// interface find, compare and end open transfers by these functions only.

// Bits of CO_SDO.Flow.Flags that describe the open transfer; the others belong to the SDO server.
enum TransferFlag : uint8_t {
  download = 0x08,  // direction
  begun = 0x40,     // Begin was called: see is_begun()
};

[[nodiscard]] inline CO_OBJ_TRANSFER direction_of(const CO_SDO& channel) {
  return (channel.Flow.Flags & download) != 0 ? CO_OBJ_DOWNLOAD : CO_OBJ_UPLOAD;
}

// Returns whether the type's Begin function was called, so that its End function has to be called.
[[nodiscard]] inline bool is_begun(const CO_SDO& channel) {
  return USE_OBJ_EX != 0 && (channel.Flow.Flags & begun) != 0;
}

// Ends the transfer of a channel: calls the End function of the type now. The server aborts the transfer (0800 0022h)
// at the next frame of the client.
void end_transfer(CO_NODE& node, CO_SDO& channel);

// Calls end_transfer() for each transfer whose object fulfils a condition, which gets its address: of a node that was
// not initialised yet, the address may be invalid.
template <class Condition>
void end_transfers(CO_NODE& node, Condition is_ended) {
  for (CO_SDO& channel : node.Sdo) {
    if (channel.Obj != nullptr && is_ended(channel.Obj)) {
      end_transfer(node, channel);
    }
  }
}

// Clears the object of each SDO server channel whose entry is no longer at the same address, because CODictInit() was
// called with another table. The server then aborts the transfer (0800 0022h).
void close_moved(CO_NODE& node);

// Returns whether an SDO server channel has the object open.
[[nodiscard]] bool is_open(const CO_NODE& node, const CO_OBJ& obj);

#if USE_OD
// Returns the size in bytes of the download to the object that an SDO server channel has open; it is known once the
// last piece arrives. 0: no channel has the object open.
[[nodiscard]] uint32_t total_of(const CO_NODE& node, const CO_OBJ& obj);
#endif

// Checks and abort codes ----------------------------------------------------------------------------------------------

// Compares the length of a transfer with need, the nearest length that the object allows. Returns an abort code.
[[nodiscard]] constexpr Abort compare_length(uint32_t length, uint32_t need) {
  if (length == need) {
    return Abort::none;
  }
  return length > need ? Abort::too_long : Abort::too_short;
}

// Checks whether the object can be written with this length in bytes. Returns an abort code.
[[nodiscard]] Abort check_length(CO_NODE& node, CO_OBJ& obj, uint32_t length);

// Returns the abort code for the result of a type function: the code that was set by COObjTypeUserSDOAbort(), else the
// code of err.
[[nodiscard]] Abort abort_for(const CO_NODE& node, CO_ERR err);
// Returns the abort code for an error of a Read, Write or End function, like abort_for(). Reports a hardware error
// (0606 0000h) as the node's error, too; any other error only refuses the request of the client.
[[nodiscard]] Abort report_failure(CO_NODE& node, CO_OBJ_TRANSFER transfer, CO_ERR err);

}  // namespace co::access
