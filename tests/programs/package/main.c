// SPDX-License-Identifier: Apache-2.0
#include "co_core.h"

static CO_NODE node;
static CO_NODE_SPEC empty;

int main(void) {
  CONodeInit(&node, &empty);
  return CONodeGetErr(&node) != CO_ERR_NONE ? 0 : 1;
}
