// SPDX-License-Identifier: Apache-2.0
// Maps the error codes (CO_ERR) of type functions and of the storage to SDO abort codes, for SDO servers and clients.
#pragma once

#include "co_err.h"
#include "co_sdo.h"
#include "wire/abort.hpp"

namespace co {

namespace abort_codes {
// Abort codes consist of error class, error code and additional code; half of their hexadecimal digits are always 0, so
// that two bytes hold one. [301:7.2.4.3.17]
struct Row {
  uint8_t err;      // CO_ERR minus CO_ERR_BASE
  uint8_t upper;    // error class and error code
  uint8_t details;  // additional code

  constexpr Row(CO_ERR of, uint32_t code)
      : err(static_cast<uint8_t>(of - CO_ERR_BASE)),
        upper(static_cast<uint8_t>((code >> 20) | (code >> 16))),
        details(static_cast<uint8_t>(code)) {}
  constexpr Abort code() const { return Abort{((upper & 0xF0U) << 20) | ((upper & 0x0FU) << 16) | details}; }
};
inline constexpr Row rows[] = {
    {CO_ERR_OBJ_NOT_FOUND, CO_SDO_ERR_OBJ},
    {CO_ERR_OBJ_SIZE, CO_SDO_ERR_LEN},
    {CO_ERR_OBJ_MAP_LEN, CO_SDO_ERR_OBJ_MAP_N},
    {CO_ERR_OBJ_MAP_TYPE, CO_SDO_ERR_OBJ_MAP},
    {CO_ERR_OBJ_ACC, CO_SDO_ERR_UNSUP},
    {CO_ERR_OBJ_RANGE, CO_SDO_ERR_RANGE},
    {CO_ERR_OBJ_RANGE_LOW, CO_SDO_ERR_RANGE_LOW},
    {CO_ERR_OBJ_INCOMPATIBLE, CO_SDO_ERR_PARA_INCOMP},
    {CO_ERR_OBJ_STATE, CO_SDO_ERR_TOS_STATE},
    {CO_ERR_OBJ_NO_DATA, CO_SDO_ERR_NO_DATA},
    {CO_ERR_TYPE_RD, CO_SDO_ERR_TOS},
    {CO_ERR_TYPE_WR, CO_SDO_ERR_TOS},
    {CO_ERR_BAD_ARG, CO_SDO_ERR_INTERNAL},
    {CO_ERR_PARA_IDX, CO_SDO_ERR_HW_ACCESS},
    {CO_ERR_PARA_STORE, CO_SDO_ERR_HW_ACCESS},
    {CO_ERR_PARA_RESTORE, CO_SDO_ERR_HW_ACCESS},
    {CO_ERR_PARA_LOAD, CO_SDO_ERR_HW_ACCESS},
    {CO_ERR_PARA_OVERLAP, CO_SDO_ERR_HW_ACCESS},
    {CO_ERR_IF_NVM_INIT, CO_SDO_ERR_HW_ACCESS},
    {CO_ERR_IF_NVM_READ, CO_SDO_ERR_HW_ACCESS},
    {CO_ERR_IF_NVM_WRITE, CO_SDO_ERR_HW_ACCESS},
};
}  // namespace abort_codes

// Returns the SDO abort code of an error; general for errors that the table does not contain.
[[nodiscard]] constexpr Abort abort_code(CO_ERR err) {
  for (const auto& row : abort_codes::rows) {
    if (row.err + CO_ERR_BASE == err) {
      return row.code();
    }
  }
  return Abort::general;
}

static_assert(abort_code(CO_ERR_OBJ_NOT_FOUND) == Abort{0x06020000} &&
              abort_code(CO_ERR_OBJ_SIZE) == Abort{0x06070010});
static_assert(abort_code(CO_ERR_OBJ_MAP_TYPE) == Abort{0x06040041} &&
              abort_code(CO_ERR_OBJ_RANGE) == Abort{0x06090030});
static_assert(abort_code(CO_ERR_TYPE_RD) == Abort{0x08000020} && abort_code(CO_ERR_TMR_CREATE) == Abort{0x08000000});

}  // namespace co
