// SPDX-License-Identifier: Apache-2.0
// The dictionary as the network sees it: for SDO servers, and for clients that access the own node.
#pragma once

#include "co_core.h"
#include "core/abort_code.hpp"
#include "core/obj.hpp"

namespace co::access {

// The object for a transfer, which its rights and its type allow, takes the place of what was served. Returns an abort
// code.
[[nodiscard]] uint32_t open(CO_NODE& node, uint32_t key, CO_OBJ_TRANSFER transfer);

// The length of an object that open() has found: its type can tell it.
[[nodiscard]] inline uint32_t size(CO_OBJ& obj, CO_NODE& node, uint32_t width) {
  return obj.Type->Size(&obj, &node, width);
}

// COObjTypeUserSDOAbort() acts for this object, or none.
inline void serve(CO_NODE& node, CO_OBJ* obj) {
  node.Served = obj;
  node.UserAbort = no_abort;
}

// Sets node.Served to another object, or to none, and restores it at the end of the scope. For an access that begins in
// a type function of the object that is being served.
class Nested {
 public:
  Nested(CO_NODE& node, CO_OBJ* obj) : node_(node), served_(node.Served), abort_(node.UserAbort) { serve(node, obj); }
  ~Nested() {
    node_.Served = served_;
    node_.UserAbort = abort_;
  }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;

 private:
  CO_NODE& node_;
  CO_OBJ* served_;
  uint32_t abort_;
};

// Transfers of SDO servers whose entries are no longer where they were lose them.
void lose_moved(CO_NODE& node);

// Does an SDO server channel other than this one have the object open?
[[nodiscard]] bool is_taken(const CO_NODE& node, const CO_OBJ& obj, const CO_SDO* by);

#if USE_OD
// Bytes of the download to the object that a server channel has open, once its last piece comes; 0: there is none.
[[nodiscard]] uint32_t total_of(const CO_NODE& node, const CO_OBJ& obj);
#endif

// length against the nearest one that is possible: an abort code.
[[nodiscard]] constexpr uint32_t compare_length(uint32_t length, uint32_t need) {
  if (length == need) {
    return no_abort;
  }
  return length > need ? CO_SDO_ERR_LEN_HIGH : CO_SDO_ERR_LEN_SMALL;
}

// Can the object be written with this length? Returns an abort code.
[[nodiscard]] uint32_t check_length(CO_NODE& node, CO_OBJ& obj, uint32_t length);

// The abort code for what a type function has returned.
[[nodiscard]] uint32_t abort_for(const CO_NODE& node, CO_ERR err);
// The abort code for what a Read, Write or End function has returned. Only a hardware error (0606 0000h) becomes the
// node's error: any other is a refused request of the client.
[[nodiscard]] uint32_t failed(CO_NODE& node, CO_OBJ_TRANSFER transfer, CO_ERR err);

}  // namespace co::access
