// SPDX-License-Identifier: Apache-2.0
// What types of extensible entries share.
#pragma once

#include "od/kind.hpp"
#include "od/list.hpp"
#include "od/result.hpp"

namespace co::od {

// The result of a function of the application becomes the answer of the type, and the abort code of the transfer that
// is being served.
[[nodiscard]] CO_ERR answer(CO_OBJ& obj, CO_NODE& node, ODR_t result, CO_OBJ_TRANSFER transfer);

// The original type, which serves an entry that is not extended; null: the access is refused.
[[nodiscard]] inline const CO_OBJ_TYPE* type_without(const OD_TYPE& type) {
  return type.Without == OD_DISABLED ? nullptr : type.Original;
}
[[nodiscard]] CO_ERR refuse(CO_OBJ& obj, CO_NODE& node, CO_OBJ_TRANSFER transfer);

// OD_writeOriginal() in an extension: what waits is settled by whoever has called the type.
ODR_t write_original(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* countWritten);
[[nodiscard]] inline OD_write_t without_settling(OD_write_t function) {
  return function == OD_writeOriginal ? write_original : function;
}

// An extension has written it: only that knows whether it has changed (flag A). OD_writeOriginal() has told already.
void tell_change(CO_NODE& node, const CO_OBJ& obj, OD_write_t by);

}  // namespace co::od
