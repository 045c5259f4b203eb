// SPDX-License-Identifier: Apache-2.0
// Search of an entry in little flash. search.cpp has the fast one.
#include "dictionary/dict.hpp"

#if !USE_FAST_PATHS

namespace co::dict {

CO_OBJ* find(CO_DICT& dict, uint32_t key) {
  const uint32_t place = first_from(dict.Root, dict.Num, CO_GET_DEV(key));
  CO_OBJ* const found = &dict.Root[place];
  return place < dict.Num && CO_GET_DEV(found->Key) == CO_GET_DEV(key) ? found : nullptr;
}

}  // namespace co::dict

extern "C" CO_OBJ* CODictFind(CO_DICT* cod, uint32_t key) {
  return cod == nullptr ? nullptr : co::dict::find(*cod, key);
}

#endif
