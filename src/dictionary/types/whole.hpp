// SPDX-License-Identifier: Apache-2.0
// Access to an object as a whole, by a PDO.
#pragma once

#include "co_obj.h"

namespace co::obj {

// Calls a Read or Write function of the object's type; a stream is accessed from its beginning.
[[nodiscard]] CO_ERR access_whole(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes);

// Like access_whole(), for a stream: an access of the application with COObjRdBufCont() or COObjWrBufCont(), to this
// stream or to another extended stream, keeps its position. Value of CO_NODE.PassStream, which the Init functions of
// the library's streams set, so that only programs with such streams link it.
CO_ERR pass_stream(CO_OBJ* source, CO_NODE_T* owner, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes);

}  // namespace co::obj
