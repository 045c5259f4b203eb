// SPDX-License-Identifier: Apache-2.0
#include "dictionary/dict.hpp"

#include "base/events.hpp"
#include "co_assert.h"
#include "co_core.h"
#include "dictionary/obj.hpp"
#include "dictionary/types/integer.hpp"
#include "wire/bytes.hpp"
#include "wire/cob_id.hpp"

namespace co::dict {

uint32_t first_from(const CO_OBJ* root, uint32_t num, uint32_t key) {
  uint32_t from = 0;
  uint32_t to = num;
  while (from < to) {
    const uint32_t middle = (from + to) / 2;
    if (root[middle].Key < key) {
      from = middle + 1;
    } else {
      to = middle;
    }
  }
  return from;
}

CO_OBJ* find(CO_NODE_T& node, uint32_t key) { return find(node.Dict, key); }

uint16_t count_entries(const CO_OBJ* root, uint16_t max) {
  uint16_t num = 0;
  while (num < max && !rules::is_end(root[num].Key)) {
    ++num;
  }
  return num;
}

namespace {

// Returns the end mark if it lists power-on values (CO_DEFAULTS), else null. In an end mark with key 0 the members
// besides Key may hold any values.
CO_OBJ* end_with_defaults(CO_OBJ* root, uint16_t num, uint16_t max) {
  const bool has_type = num < max && root[num].Key == CO_DEFAULTS_KEY && root[num].Type != nullptr;
  return has_type && root[num].Type->Reset != nullptr ? &root[num] : nullptr;
}

// Calls a function (obj::read, obj::write, …) for a value of width bytes; a stream is accessed from its beginning.
// Returns CO_ERR_OBJ_SIZE if the object has another length.
CO_ERR access_value(CO_DICT* dict, uint32_t key, void* value, uint32_t width,
                    CO_ERR (*function)(CO_OBJ&, CO_NODE_T&, void*, uint32_t)) {
  if (dict == nullptr || dict->Node == nullptr || value == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const event::Call call(*dict->Node);
  CO_OBJ* const found = find(*dict, key);
  if (found == nullptr) {
    return CO_ERR_OBJ_NOT_FOUND;
  }
  if (obj::size(*found, *dict->Node, width) != width) {
    return CO_ERR_OBJ_SIZE;
  }
  const CO_ERR err = obj::seek(*found, *dict->Node, 0);
  return err != CO_ERR_NONE ? err : function(*found, *dict->Node, value, width);
}

}  // namespace

CO_ERR set_table(CO_DICT& dict, CO_NODE& node, CO_OBJ* root, uint16_t max) {
  dict = {};
  dict.Node = &node;
  dict.Root = root;
  dict.Num = count_entries(root, max);
  dict.End = end_with_defaults(root, dict.Num, max);
  const CO_ERR err = check(dict);
  if (err != CO_ERR_NONE) {
    dict.Num = 0;
  }
  if (USE_FAST_PATHS != 0 && dict.Num != 0) {
    prepare_search(dict);
  }
  return err;
}

void set_power_on_values(CO_NODE& node, CO_NMT_RESET type) {
  CO_OBJ* const end = node.Dict.End;
  if (end != nullptr) {
    (void)end->Type->Reset(end, &node, type);
  }
}

Initialised init_objects(CO_DICT& dict, CO_NODE& node) {
  Initialised result = {CO_ERR_NONE, 0};
  for (uint16_t n = 0; n < dict.Num; ++n) {
    CO_OBJ& entry = dict.Root[n];
    const CO_ERR err = COObjInit(&entry, &node);
    if (err != CO_ERR_NONE) {
      result = {err, result.key != 0 ? result.key : entry.Key};
    }
  }
  return result;
}

uint32_t read_number(CO_NODE_T& node, uint32_t key, uint32_t width, uint32_t otherwise) {
  return read_number(node, find(node, key), width, otherwise);
}

uint32_t read_number(CO_NODE_T& node, CO_OBJ* obj, uint32_t width, uint32_t otherwise) {
  uint32_t number = 0;
  CO_ASSERT(width != 0 && width <= sizeof number);
  const uint32_t above = wire::host_is_little_endian ? 0 : sizeof number - width;
  const bool known =
      obj != nullptr && obj::read(*obj, node, reinterpret_cast<uint8_t*>(&number) + above, width) == CO_ERR_NONE;
  return known ? number : otherwise;
}

CO_ERR read_u32(CO_NODE_T& node, uint32_t key, uint32_t& value) {
  return access_value(&node.Dict, key, &value, sizeof value, obj::read);
}

uint32_t read_cob_id(CO_NODE& node, uint32_t key, uint32_t otherwise) {
  const uint32_t value = read_number(node, key, sizeof value, otherwise);
  return cob_id::identifier(value) != wire::no_frame ? value : wire::cob_invalid;
}

CO_ERR write_u32(CO_NODE_T& node, uint32_t key, uint32_t value) {
  return access_value(&node.Dict, key, &value, sizeof value, obj::write);
}

}  // namespace co::dict

extern "C" {

CO_ERR CODictObjInit(CO_DICT* cod, CO_NODE_T* node) {
  if (cod == nullptr || node == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  return co::dict::init_objects(*cod, *node).err;
}

CO_DICT_FAULT CODictGetFault(const CO_DICT* cod, uint32_t* key) {
  if (cod == nullptr) {
    return CO_DICT_OK;
  }
#if USE_DICT_CHECK
  const uint32_t key_of_fault = co::dict::fault_key_of(*cod);
  const CO_DICT_FAULT fault = co::dict::fault_of(*cod);
#else
  const uint32_t key_of_fault = co::dict::out_of_order(*cod);
  const CO_DICT_FAULT fault = key_of_fault != 0 ? CO_DICT_NOT_ASCENDING : CO_DICT_OK;
#endif
  if (key != nullptr) {
    *key = key_of_fault;
  }
  return fault;
}

CO_ERR CODictRdByte(CO_DICT* cod, uint32_t key, uint8_t* val) {
  return co::dict::access_value(cod, key, val, sizeof *val, co::obj::read);
}

CO_ERR CODictRdWord(CO_DICT* cod, uint32_t key, uint16_t* val) {
  return co::dict::access_value(cod, key, val, sizeof *val, co::obj::read);
}

CO_ERR CODictRdLong(CO_DICT* cod, uint32_t key, uint32_t* val) {
  return co::dict::access_value(cod, key, val, sizeof *val, co::obj::read);
}

CO_ERR CODictWrByte(CO_DICT* cod, uint32_t key, uint8_t val) {
  return co::dict::access_value(cod, key, &val, sizeof val, co::obj::write_for_application);
}

CO_ERR CODictWrWord(CO_DICT* cod, uint32_t key, uint16_t val) {
  return co::dict::access_value(cod, key, &val, sizeof val, co::obj::write_for_application);
}

CO_ERR CODictWrLong(CO_DICT* cod, uint32_t key, uint32_t val) {
  return co::dict::access_value(cod, key, &val, sizeof val, co::obj::write_for_application);
}

CO_ERR CODictRdBuffer(CO_DICT* cod, uint32_t key, uint8_t* buf, uint32_t len) {
  if (cod == nullptr || buf == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  CO_OBJ* const found = co::dict::find(*cod, key);
  return found == nullptr ? CO_ERR_OBJ_NOT_FOUND : COObjRdBufStart(found, cod->Node, buf, len);
}

CO_ERR CODictWrBuffer(CO_DICT* cod, uint32_t key, uint8_t* buf, uint32_t len) {
  if (cod == nullptr || buf == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  CO_OBJ* const found = co::dict::find(*cod, key);
  return found == nullptr ? CO_ERR_OBJ_NOT_FOUND : COObjWrBufStart(found, cod->Node, buf, len);
}

}  // extern "C"
