// SPDX-License-Identifier: Apache-2.0
#include "error.h"

#include <stdio.h>

CO_ERR PrintError(CO_NODE* node, const char* name_of_node) {
  const CO_ERR err = CONodeGetErr(node);
  const uint32_t key = CONodeGetErrKey(node);
  if (err != CO_ERR_NONE) {
    printf("%s: %s, object %04Xh:%02X: %s\n", name_of_node, COErrName(err), (unsigned)CO_GET_IDX(key),
           (unsigned)CO_GET_SUB(key), COErrText(err));
  }
  return err;
}
