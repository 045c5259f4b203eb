// SPDX-License-Identifier: Apache-2.0
// A memory as slow as flash, for the parameters of the device. It is volatile: its content is lost when the program
// ends.
#ifndef DEMO_TWO_THREADS_MEMORY_H_
#define DEMO_TWO_THREADS_MEMORY_H_

#include "co_if_nvm.h"

extern const CO_IF_NVM_DRV_EX SlowMemoryDriver;  // needs no context

#endif
