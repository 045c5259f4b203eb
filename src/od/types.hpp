// SPDX-License-Identifier: Apache-2.0
// Common functions of the types of extensible entries.
#pragma once

#include "od/kind.hpp"
#include "od/list.hpp"
#include "od/result.hpp"

#if USE_OD

// Running call of an extension's write function. A change of the object (flag A) is reported by its original type, if
// the function calls it (by_original): that type compares the values. Streams in memory do not compare: their changes
// are reported after the call.
struct OD_WRITING_T {
  const CO_OBJ& obj;
  bool by_original;
};

namespace co::od {

// Returns the error code of a type function for the result of a function of the application, and sets the abort code of
// the transfer that is being served.
[[nodiscard]] CO_ERR answer(CO_OBJ& obj, CO_NODE& node, ODR_t result, CO_OBJ_TRANSFER transfer);

// Returns the type that is used while an entry is not extended, its original type; null: accesses are refused
// (OD_DISABLED).
[[nodiscard]] inline const CO_OBJ_TYPE* type_without(const OD_TYPE& type) {
  return type.Without == OD_DISABLED ? nullptr : type.Original;
}
// Refuses an access: an upload as write-only, a download as read-only.
[[nodiscard]] CO_ERR refuse(CO_OBJ& obj, CO_NODE& node, CO_OBJ_TRANSFER transfer);

// Scope of a call of an extension's write function. OD_writeOriginal() does not run deferred work meanwhile: a TPDO
// would read the object through the extension.
class Writing {
 public:
  Writing(CO_NODE& node, const CO_OBJ& obj) : od_(*node.Ext->Od), before_(od_.Writing), now_{obj, false} {
    od_.Writing = &now_;
  }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
  ~Writing() { od_.Writing = before_; }

  [[nodiscard]] bool by_original() const { return now_.by_original; }

 private:
  OD_t& od_;
  OD_WRITING_T* before_;
  OD_WRITING_T now_;
};

// Reports a change after a call of an extension's write function, and sends the TPDOs that were deferred meanwhile.
// complete: the object has its new value.
void report_change(CO_NODE& node, const CO_OBJ& obj, bool complete, bool by_original);

}  // namespace co::od

#endif
