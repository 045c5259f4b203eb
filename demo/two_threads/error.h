// SPDX-License-Identifier: Apache-2.0
#ifndef DEMO_TWO_THREADS_ERROR_H_
#define DEMO_TWO_THREADS_ERROR_H_

#include "co_core.h"

// Returns the last error of a node and clears it; prints its name, object and text.
CO_ERR PrintError(CO_NODE* node, const char* name_of_node);

#endif
