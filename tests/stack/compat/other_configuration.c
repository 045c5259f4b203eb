// SPDX-License-Identifier: Apache-2.0
// A program that configuration.sh compiles with and without the library's configuration.
#include "co_core.h"

static CO_NODE Nodes[2];
static CO_NODE_SPEC Spec;

int main(void) {
#ifdef ONLY_EX
  CONodeInitEx(&Nodes[0], &Spec, NULL);
  CONodeInitEx(&Nodes[1], &Spec, NULL);
#else
  CONodeInit(&Nodes[0], &Spec);
  CONodeInit(&Nodes[1], &Spec);
#endif
  return CONodeGetErr(&Nodes[0]) == CO_ERR_NONE;
}
