// SPDX-License-Identifier: Apache-2.0
// Access of a PDO to an object as a whole (dictionary/types/stream.hpp).

#include "co_core.h"
#include "dictionary/obj.hpp"
#include "dictionary/types/stream.hpp"
#include "hal/port.hpp"
#if USE_OD
#include "co_od.h"
#endif

namespace co::obj {
namespace {

#if USE_OD

// Scope of an access to an extended stream; its end restores the application's own access. All extended streams share
// one OD_TRANSFER for the application. It is not restored if an object has got another extension meanwhile, because
// that may have ended the application's access (OD_extension_init()).
class KeptAccess {
 public:
  explicit KeptAccess(const CO_NODE& node) : od_(port::od_of(node)) {
    if (od_ != nullptr) {
      changes_ = od_->Changes;
      before_ = od_->Transfer[OD_TRANSFER_N - 1];
    }
  }
  KeptAccess(const KeptAccess&) = delete;
  KeptAccess& operator=(const KeptAccess&) = delete;
  ~KeptAccess() {
    if (od_ != nullptr && od_->Changes == changes_) {
      od_->Transfer[OD_TRANSFER_N - 1] = before_;
    }
  }

 private:
  OD_t* od_;
  uint16_t changes_ = 0;
  OD_TRANSFER before_ = {};
};

#else

class KeptAccess {
 public:
  explicit KeptAccess(const CO_NODE&) {}
};

#endif

CO_ERR pass_at_beginning(CO_OBJ& obj, CO_NODE& node, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes) {
  const CO_ERR err = seek(obj, node, 0);
  return err != CO_ERR_NONE ? err : function(&obj, &node, data, bytes);
}

}  // namespace

CO_ERR pass_stream(CO_OBJ* source, CO_NODE* owner, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes) {
  CO_OBJ& obj = *source;
  CO_NODE& node = *owner;
  const CO_OBJ_TYPE* const type = stream::original_type(obj);
  const KeptAccess access(node);
  if (type == nullptr || type->Reset != stream::reset) {
    return pass_at_beginning(obj, node, function, data, bytes);
  }
  const stream::KeptPosition position(obj);
  return pass_at_beginning(obj, node, function, data, bytes);
}

CO_ERR access_whole(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes) {
  if (!is_stream(obj)) {
    return function(&obj, &node, data, bytes);
  }
  return node.PassStream != nullptr ? node.PassStream(&obj, &node, function, data, bytes)
                                    : pass_at_beginning(obj, node, function, data, bytes);
}

}  // namespace co::obj
