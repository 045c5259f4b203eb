// SPDX-License-Identifier: Apache-2.0
// Memory with a position: the common part of domains and strings.
#pragma once

#include "co_obj.h"
#include "dictionary/obj.hpp"
#include "wire/abort.hpp"

namespace co::stream {

// Returns how many of n bytes at position are within size.
constexpr uint32_t clip(uint32_t n, uint32_t position, uint32_t size) {
  const uint32_t left = position < size ? size - position : 0;
  return n < left ? n : left;
}

// Init function of the stream types: checks the entry and sets the position to 0.
CO_ERR init(CO_OBJ* obj, CO_NODE_T* node);

// Sets the position, which is the first member of the structure of every stream.
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

// Returns the type of an entry or, if the entry can be extended (src/extra/od), its original type; null: it has none.
[[nodiscard]] const CO_OBJ_TYPE* original_type(const CO_OBJ& obj);

// Checks an object like access::check(); also refuses a stream of this library whose Data is null.
[[nodiscard]] Abort check(const CO_NODE_T& node, uint32_t key, const CO_OBJ* obj, CO_OBJ_TRANSFER transfer);

// Scope of an access that changes the position of a stream; its end restores the position, so that the application can
// continue its access with COObjRdBufCont() or COObjWrBufCont().
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

// Access to an object as a whole, by a PDO.
namespace co::obj {

// Calls a Read or Write function of the object's type; a stream is accessed from its beginning.
[[nodiscard]] CO_ERR access_whole(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes);

// Like access_whole(), for a stream: an access of the application with COObjRdBufCont() or COObjWrBufCont() keeps its
// position. Value of CO_NODE.PassStream, which the Init functions of
// the library's streams set, so that only programs with such streams link it.
CO_ERR pass_stream(CO_OBJ* source, CO_NODE_T* owner, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes);

}  // namespace co::obj
