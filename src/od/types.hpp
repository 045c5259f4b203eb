// SPDX-License-Identifier: Apache-2.0
// What types of extensible entries share.
#pragma once

#include "od/kind.hpp"
#include "od/list.hpp"
#include "od/result.hpp"

#if USE_OD

// The write function of an extension runs, for this object. Who tells of a change (flag A)? The original, if the
// function has called it: it knows whether there is one. Streams in memory do not look.
struct OD_WRITING_T {
  const CO_OBJ& obj;
  bool by_original;
};

namespace co::od {

// The result of a function of the application becomes the answer of the type, and the abort code of the transfer that
// is being served.
[[nodiscard]] CO_ERR answer(CO_OBJ& obj, CO_NODE& node, ODR_t result, CO_OBJ_TRANSFER transfer);

// The original type, which serves an entry that is not extended; null: the access is refused.
[[nodiscard]] inline const CO_OBJ_TYPE* type_without(const OD_TYPE& type) {
  return type.Without == OD_DISABLED ? nullptr : type.Original;
}
[[nodiscard]] CO_ERR refuse(CO_OBJ& obj, CO_NODE& node, CO_OBJ_TRANSFER transfer);

// What is told while the function runs waits until it is over: a TPDO reads the object by the extension.
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

// It is over; complete: the object has its new value.
void tell_change(CO_NODE& node, const CO_OBJ& obj, bool complete, bool by_original);

}  // namespace co::od

#endif
