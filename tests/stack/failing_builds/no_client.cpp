// SPDX-License-Identifier: Apache-2.0
// expect: no member named 'CSdo'
// expect: needs USE_CSDO above 0 in co_cfg.h
// Without SDO clients a node has no memory for them and no functions; the message names the setting.
#define USE_CSDO 0
#include "co_core.h"

CO_NODE node;

const void* first() { return &node.CSdo[0]; }
const void* found() { return COCSdoFind(&node, 0); }
