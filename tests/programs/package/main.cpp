// SPDX-License-Identifier: Apache-2.0
#include "co_core.h"
#include "lexican/dictionary.hpp"

static CO_NODE node;
static CO_NODE_SPEC empty;
constexpr CO_OBJ od[] = {{CO_KEY(0x2000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)}};
CO_OD_CHECK_PART(od);

int main() {
  CONodeInit(&node, &empty);
  return CONodeGetErr(&node) != CO_ERR_NONE ? 0 : 1;
}
