// SPDX-License-Identifier: Apache-2.0
#include "error.h"

#include <stdio.h>

CO_ERR PrintError(CO_NODE* node, const char* name_of_node) {
  char text[CO_NODE_ERR_TEXT];
  const CO_ERR err = CONodeGetErrText(node, text, sizeof(text));
  if (err != CO_ERR_NONE) {
    printf("%s: %s\n", name_of_node, text);
  }
  return err;
}
