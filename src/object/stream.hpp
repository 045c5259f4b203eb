// SPDX-License-Identifier: Apache-2.0
// What domains and strings share: memory with a position.
#pragma once

#include "co_obj.h"
#include "object/place.hpp"

namespace co::stream {

// The bytes of an access of n at position that lie within size.
constexpr uint32_t clip(uint32_t n, uint32_t position, uint32_t size) {
  const uint32_t left = position < size ? size - position : 0;
  return n < left ? n : left;
}

// Init function: position 0.
CO_ERR init(CO_OBJ* obj, CO_NODE_T* node);

// Sets the position. Every structure of a stream begins with it.
[[nodiscard]] inline CO_ERR seek(const CO_OBJ& obj, uint32_t position) {
  auto* const offset = data_of<uint32_t>(obj);
  if (offset == nullptr) {
    return CO_ERR_TYPE_RESET;
  }
  *offset = position;
  return CO_ERR_NONE;
}

// Reset function of the stream types: calls seek().
CO_ERR reset(CO_OBJ* obj, CO_NODE_T* node, uint32_t position);

// The type that an entry has without its extension (co_od.h); null: none.
[[nodiscard]] const CO_OBJ_TYPE* original_type(const CO_OBJ& obj);

// Like access::open(), and refuses one of our own streams whose Data is null.
[[nodiscard]] uint32_t open(CO_NODE_T& node, uint32_t key, CO_OBJ_TRANSFER transfer);

// Somebody passes a piece: whoever goes on with COObj…Cont() finds the position where it was.
class KeptPosition {
 public:
  explicit KeptPosition(const CO_OBJ& obj)
      : offset_(data_of<uint32_t>(obj)), before_(offset_ == nullptr ? 0 : *offset_) {}
  KeptPosition(const KeptPosition&) = delete;
  KeptPosition& operator=(const KeptPosition&) = delete;
  ~KeptPosition() {
    if (offset_ != nullptr) {
      *offset_ = before_;
    }
  }

 private:
  uint32_t* offset_;
  uint32_t before_;
};

}  // namespace co::stream
