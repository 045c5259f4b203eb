// SPDX-License-Identifier: Apache-2.0
// SDO abort codes. [301:7.2.4.3.17]
#pragma once

#include <stdint.h>

#include "co_sdo.h"

namespace co {

// Abort codes that the stack uses. Others come from the network and from the application.
enum class Abort : uint32_t {
  none = 0,  // no error
  toggle_bit = CO_SDO_ERR_TBIT,
  time_out = CO_SDO_ERR_TIMEOUT,
  command = CO_SDO_ERR_CMD,
  block_size = CO_SDO_ERR_BLK_SIZE,
  sequence_number = CO_SDO_ERR_SEQ_NUM,
  crc = CO_SDO_ERR_CRC,
  memory = CO_SDO_ERR_MEM,
  unsupported_access = CO_SDO_ERR_UNSUP,
  write_only = CO_SDO_ERR_RD,
  read_only = CO_SDO_ERR_WR,
  no_object = CO_SDO_ERR_OBJ,
  no_sub_index = CO_SDO_ERR_SUB,
  internal = CO_SDO_ERR_INTERNAL,
  hardware = CO_SDO_ERR_HW_ACCESS,
  length = CO_SDO_ERR_LEN,
  too_long = CO_SDO_ERR_LEN_HIGH,
  too_short = CO_SDO_ERR_LEN_SMALL,
  general = CO_SDO_ERR_GENERAL,
  not_stored = CO_SDO_ERR_TOS,
  local_control = CO_SDO_ERR_TOS_LOCAL,
  device_state = CO_SDO_ERR_TOS_STATE,
};

}  // namespace co
