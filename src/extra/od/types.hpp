// SPDX-License-Identifier: Apache-2.0
// Common functions of the types of extensible entries.
#pragma once

#include "co_core.h"
#include "co_od.h"
#include "extra/od/index.hpp"
#include "extra/od/properties.hpp"
#include "wire/abort.hpp"

#if USE_OD

// Running call of an extension's write function. It determines which code reports the change of an object with flag A:
// if the function calls OD_writeOriginal() for a number, the original type, which compares old and new value
// (by_original); otherwise report_change() after the call. The types of strings and domains do not compare.
struct OD_WRITING_T {
  const CO_OBJ& obj;
  bool by_original;  // the original type reports the change
};

namespace co::od {

// Sets the abort code of the transfer that is being processed, for the result of an extension's function. Returns the
// error code that the type function has to return; CO_ERR_NONE for ODR_OK and ODR_PARTIAL, which clear the abort code.
[[nodiscard]] CO_ERR set_abort_code(CO_OBJ& obj, CO_NODE& node, ODR_t result, CO_OBJ_TRANSFER transfer);

// Returns the type that is used while an entry is not extended, its original type; null: accesses are refused
// (OD_DISABLED).
[[nodiscard]] inline const CO_OBJ_TYPE* type_if_not_extended(const OD_TYPE& type) {
  return type.Without == OD_DISABLED ? nullptr : type.Original;
}
// Refuses an access to an object without original type or function: an upload as write-only, a download as read-only.
[[nodiscard]] CO_ERR refuse_access(CO_OBJ& obj, CO_NODE& node, CO_OBJ_TRANSFER transfer);

// Scope of a call of an extension's write function. OD_writeOriginal() does not run deferred work within it, because a
// TPDO would read the object through the extension.
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

// Reports a change after a call of an extension's write function: marks the TPDOs that map the object, which
// run_deferred() sends. complete: the object has its new value. by_original: the original type has reported the change
// already.
void report_change(CO_NODE& node, const CO_OBJ& obj, bool complete, bool by_original);

}  // namespace co::od

#endif

// Conversion of SDO abort codes and error codes to ODR_t, the result type of the OD access interface (co_od.h).

namespace co::od {

// Returns the result for an SDO abort code; ODR_GENERAL if no result corresponds to it.
[[nodiscard]] ODR_t result_of(Abort abort);

// Returns the result for the error code of a type function of the object. An abort code that the function has set by
// COObjTypeUserSDOAbort() has priority over the error code.
[[nodiscard]] ODR_t result_of(const CO_NODE& node, const CO_OBJ& obj, CO_ERR err);

}  // namespace co::od
