// SPDX-License-Identifier: Apache-2.0
#include "co_sdo.h"
#include "trace/decode.hpp"
#include "trace/text.hpp"

namespace lexican::trace {
namespace {

struct AbortCode {
  std::uint32_t code;
  const char* meaning;
};

constexpr AbortCode abort_codes[] = {
    // [301:7.2.4.3.17]
    {CO_SDO_ERR_TBIT, "toggle bit not alternated"},
    {CO_SDO_ERR_TIMEOUT, "protocol timed out"},
    {CO_SDO_ERR_CMD, "command not valid or unknown"},
    {CO_SDO_ERR_BLK_SIZE, "invalid block size"},
    {CO_SDO_ERR_SEQ_NUM, "invalid sequence number"},
    {CO_SDO_ERR_CRC, "CRC error"},
    {CO_SDO_ERR_MEM, "out of memory"},
    {CO_SDO_ERR_UNSUP, "unsupported access"},
    {CO_SDO_ERR_RD, "object is write-only"},
    {CO_SDO_ERR_WR, "object is read-only"},
    {CO_SDO_ERR_OBJ, "object does not exist"},
    {CO_SDO_ERR_OBJ_MAP, "object cannot be mapped to a PDO"},
    {CO_SDO_ERR_OBJ_MAP_N, "mapped objects exceed the PDO"},
    {CO_SDO_ERR_PARA_INCOMP, "parameters are incompatible"},
    {CO_SDO_ERR_INTERNAL, "internal incompatibility"},
    {CO_SDO_ERR_HW_ACCESS, "hardware error"},
    {CO_SDO_ERR_LEN, "length does not match"},
    {CO_SDO_ERR_LEN_HIGH, "length too high"},
    {CO_SDO_ERR_LEN_SMALL, "length too low"},
    {CO_SDO_ERR_SUB, "sub-index does not exist"},
    {CO_SDO_ERR_RANGE, "invalid value"},
    {CO_SDO_ERR_RANGE_HIGH, "value too high"},
    {CO_SDO_ERR_RANGE_LOW, "value too low"},
    {CO_SDO_ERR_RANGE_LIMITS, "maximum is less than minimum"},
    {CO_SDO_ERR_NO_CONNECT, "no SDO connection available"},
    {CO_SDO_ERR_GENERAL, "general error"},
    {CO_SDO_ERR_TOS, "data cannot be transferred or stored"},
    {CO_SDO_ERR_TOS_LOCAL, "data cannot be stored: local control"},
    {CO_SDO_ERR_TOS_STATE, "data cannot be stored: device state"},
    {CO_SDO_ERR_NO_OD, "no object dictionary"},
    {CO_SDO_ERR_NO_DATA, "no data available"},
};

}  // namespace

const char* abort_meaning(std::uint32_t code) {
  for (const AbortCode& row : abort_codes) {
    if (row.code == code) {
      return row.meaning;
    }
  }
  return "unknown abort code";
}

std::string abort_code(std::uint32_t code) {
  return text("%04X %04Xh", static_cast<unsigned>(code >> 16), static_cast<unsigned>(code & 0xFFFFu));
}

}  // namespace lexican::trace
