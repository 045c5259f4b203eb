// SPDX-License-Identifier: Apache-2.0
// Example of docs/porting.md: the simplest loop.
#include "co_core.h"

void RunForEver(CO_NODE* node);

void RunForEver(CO_NODE* node) {
  for (;;) {
    CONodeProcess(node);
    COTmrProcess(&node->Tmr);
  }
}
