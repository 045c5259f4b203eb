// SPDX-License-Identifier: Apache-2.0
// Types of extensible entries: common functions, and values.
#include "extra/od/types.hpp"

#include "base/events.hpp"
#include "dictionary/abort_code.hpp"
#include "dictionary/access.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/stream.hpp"
#include "extra/od/transfer.hpp"
#include "service/pdo/pdo.hpp"

#if USE_OD

namespace co::od {
namespace {

CO_ERR error_of(ODR_t result, CO_OBJ_TRANSFER transfer) {
  switch (result) {
    case ODR_UNSUPP_ACCESS:
    case ODR_WRITEONLY:
    case ODR_READONLY: return CO_ERR_OBJ_ACC;
    case ODR_INVALID_VALUE:
    case ODR_VALUE_HIGH:
    case ODR_VALUE_LOW: return CO_ERR_OBJ_RANGE;
    case ODR_DATA_DEV_STATE: return CO_ERR_OBJ_STATE;
    case ODR_NO_DATA: return CO_ERR_OBJ_NO_DATA;
    default: return transfer == CO_OBJ_UPLOAD ? CO_ERR_TYPE_RD : CO_ERR_TYPE_WR;
  }
}

// Checks the result of a function that must read or write a number completely in one call. Returns if_partial in place
// of ODR_PARTIAL, ODR_DEV_INCOMPAT if the function has passed another number of bytes than size, else the result.
ODR_t check_complete(ODR_t result, OD_size_t passed, OD_size_t size, ODR_t if_partial) {
  if (result == ODR_PARTIAL) {
    return if_partial;
  }
  return result == ODR_OK && passed != size ? ODR_DEV_INCOMPAT : result;
}

CO_ERR read_number(CO_OBJ& obj, CO_NODE& node, const OD_extension_t& extension, void* buffer, uint32_t size) {
  OD_stream_t stream = stream_of(obj, node);
  OD_size_t passed = 0;
  stream.object = extension.object;
  const ODR_t result = extension.read == nullptr ? ODR_UNSUPP_ACCESS : extension.read(&stream, buffer, size, &passed);
  return set_abort_code(obj, node, check_complete(result, passed, size, ODR_DEV_INCOMPAT), CO_OBJ_UPLOAD);
}

CO_ERR write_number(CO_OBJ& obj, CO_NODE& node, const OD_extension_t& extension, const void* buffer, uint32_t size) {
  OD_stream_t stream = stream_of(obj, node);
  OD_size_t passed = 0;
  stream.object = extension.object;
  if (extension.write == nullptr) {
    return set_abort_code(obj, node, ODR_UNSUPP_ACCESS, CO_OBJ_DOWNLOAD);
  }
  const Writing writing(node, obj);
  ODR_t result = extension.write(&stream, buffer, size, &passed);
  result = check_complete(result, passed, size, ODR_DATA_SHORT);
  report_change(node, obj, result == ODR_OK, writing.by_original());
  return set_abort_code(obj, node, result, CO_OBJ_DOWNLOAD);
}

}  // namespace

// Does not replace an abort code that an original type has set during the call, if it corresponds to the same result.
CO_ERR set_abort_code(CO_OBJ& obj, CO_NODE& node, ODR_t result, CO_OBJ_TRANSFER transfer) {
  if (result == ODR_OK || result == ODR_PARTIAL) {
    COObjTypeUserSDOAbort(&obj, &node, 0);
    return CO_ERR_NONE;
  }
  const Abort abort = access::user_abort(node);
  if (abort == Abort::none || result_of(abort) != result) {
    COObjTypeUserSDOAbort(&obj, &node, OD_getSDOabCode(result));
  }
  return error_of(result, transfer);
}

CO_ERR refuse_access(CO_OBJ& obj, CO_NODE& node, CO_OBJ_TRANSFER transfer) {
  return set_abort_code(obj, node, transfer == CO_OBJ_UPLOAD ? ODR_WRITEONLY : ODR_READONLY, transfer);
}

void report_change(CO_NODE& node, const CO_OBJ& obj, bool complete, bool by_original) {
  if (complete && !by_original && CO_IS_ASYNC(obj.Key) != 0) {
    event::change_object(node, obj);
  }
}

}  // namespace co::od

extern "C" {

CO_ERR ODTypeInit(CO_OBJ_T* obj, CO_NODE_T* node) {
  node->PassStream = co::od::pass_stream;
  const CO_OBJ_TYPE* const type = co::od::original_type(*obj);
  if (type == nullptr || type->Init == nullptr) {
    return CO_ERR_NONE;
  }
  return co::od::is_extensible(*type) ? co::dict::set_fault(*obj, *node, CO_DICT_NO_TYPE) : type->Init(obj, node);
}

uint32_t ODValueSize(CO_OBJ_T* obj, CO_NODE_T* node, uint32_t width) {
  const CO_OBJ_TYPE* const type = co::od::original_type(*obj);
  if (type == nullptr) {
    return static_cast<uint32_t>(uintptr_t{obj->Data});
  }
  return type->Size == nullptr ? 0 : type->Size(obj, node, width);
}

CO_ERR ODValueRead(CO_OBJ_T* obj, CO_NODE_T* node, void* buffer, uint32_t size) {
  const OD_extension_t* const extension = co::od::extension_of(*node, *obj);
  if (extension != nullptr) {
    return size == ODValueSize(obj, node, size) ? co::od::read_number(*obj, *node, *extension, buffer, size)
                                                : CO_ERR_BAD_ARG;
  }
  const CO_OBJ_TYPE* const type = co::od::type_if_not_extended(*co::od::extensible(*obj));
  return type == nullptr || type->Read == nullptr ? co::od::refuse_access(*obj, *node, CO_OBJ_UPLOAD)
                                                  : type->Read(obj, node, buffer, size);
}

CO_ERR ODValueWrite(CO_OBJ_T* obj, CO_NODE_T* node, void* buffer, uint32_t size) {
  const OD_extension_t* const extension = co::od::extension_of(*node, *obj);
  if (extension != nullptr) {
    return size == ODValueSize(obj, node, size) ? co::od::write_number(*obj, *node, *extension, buffer, size)
                                                : CO_ERR_BAD_ARG;
  }
  const CO_OBJ_TYPE* const type = co::od::type_if_not_extended(*co::od::extensible(*obj));
  return type == nullptr || type->Write == nullptr ? co::od::refuse_access(*obj, *node, CO_OBJ_DOWNLOAD)
                                                   : type->Write(obj, node, buffer, size);
}

}  // extern "C"

namespace co::od {
namespace {

// Returns an abort code as 16 bits: half of its hexadecimal digits are always 0. [301:7.2.4.3.17]
constexpr uint16_t short_of(uint32_t code) {
  return static_cast<uint16_t>(((code >> 12) & 0xF000U) | ((code >> 8) & 0x0F00U) | (code & 0xFFU));
}
constexpr uint32_t code_of(uint32_t code) {
  return ((code & 0xF000U) << 12) | ((code & 0x0F00U) << 8) | (code & 0xFFU);
}

// Abort codes of results, indexed by ODR_t.
constexpr uint16_t codes[] = {
    0,
    short_of(CO_SDO_ERR_MEM),
    short_of(CO_SDO_ERR_UNSUP),
    short_of(CO_SDO_ERR_RD),
    short_of(CO_SDO_ERR_WR),
    short_of(CO_SDO_ERR_OBJ),
    short_of(CO_SDO_ERR_OBJ_MAP),
    short_of(CO_SDO_ERR_OBJ_MAP_N),
    short_of(CO_SDO_ERR_PARA_INCOMP),
    short_of(CO_SDO_ERR_INTERNAL),
    short_of(CO_SDO_ERR_HW_ACCESS),
    short_of(CO_SDO_ERR_LEN),
    short_of(CO_SDO_ERR_LEN_HIGH),
    short_of(CO_SDO_ERR_LEN_SMALL),
    short_of(CO_SDO_ERR_SUB),
    short_of(CO_SDO_ERR_RANGE),
    short_of(CO_SDO_ERR_RANGE_HIGH),
    short_of(CO_SDO_ERR_RANGE_LOW),
    short_of(CO_SDO_ERR_RANGE_LIMITS),
    short_of(CO_SDO_ERR_NO_CONNECT),
    short_of(CO_SDO_ERR_GENERAL),
    short_of(CO_SDO_ERR_TOS),
    short_of(CO_SDO_ERR_TOS_LOCAL),
    short_of(CO_SDO_ERR_TOS_STATE),
    short_of(CO_SDO_ERR_NO_OD),
    short_of(CO_SDO_ERR_NO_DATA),
};
static_assert(sizeof codes / sizeof *codes == ODR_COUNT);
static_assert(code_of(codes[ODR_NO_RESOURCE]) == 0x060A0023 && code_of(codes[ODR_NO_DATA]) == 0x08000024);

}  // namespace

ODR_t result_of(Abort abort) {
  int result = 1;
  while (result < ODR_COUNT && Abort{code_of(codes[result])} != abort) {
    ++result;
  }
  return result < ODR_COUNT ? static_cast<ODR_t>(result) : ODR_GENERAL;
}

ODR_t result_of(const CO_NODE& node, const CO_OBJ& obj, CO_ERR err) {
  if (err == CO_ERR_NONE) {
    return ODR_OK;
  }
  return result_of(access::requested_object(node) == &obj ? access::abort_for(node, err) : abort_code(err));
}

}  // namespace co::od

extern "C" uint32_t OD_getSDOabCode(ODR_t returnCode) {
  const int number = returnCode;
  return co::od::code_of(co::od::codes[number < 0 || number >= ODR_COUNT ? ODR_DEV_INCOMPAT : number]);
}

#endif
