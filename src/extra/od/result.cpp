// SPDX-License-Identifier: Apache-2.0
#include "extra/od/result.hpp"

#if USE_OD

#include "dictionary/access.hpp"

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

using namespace co::od;

extern "C" uint32_t OD_getSDOabCode(ODR_t returnCode) {
  const int number = returnCode;
  return code_of(codes[number < 0 || number >= ODR_COUNT ? ODR_DEV_INCOMPAT : number]);
}

#endif
