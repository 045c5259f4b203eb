// SPDX-License-Identifier: Apache-2.0
// Functions shared by the checks of the three drivers.
#ifndef DRIVER_CHECK_H_
#define DRIVER_CHECK_H_

#include "co_driver_check.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum CHECK_VERDICT_T { CHECK_OK = 0, CHECK_FAILED, CHECK_SKIPPED } CHECK_VERDICT;

// Prints the verdict of the check name, with the reason. The first # or $ in reason stands for first, the others for
// second: # in decimal, $ in hexadecimal.
void CheckSay(CO_DRIVER_CHECK* c, CHECK_VERDICT verdict, const char* name, const char* reason, uint32_t first,
              uint32_t second);

static inline void CheckPass(CO_DRIVER_CHECK* c, const char* name, const char* reason) {
  CheckSay(c, CHECK_OK, name, reason, 0, 0);
}

static inline void CheckFail(CO_DRIVER_CHECK* c, const char* name, const char* reason) {
  CheckSay(c, CHECK_FAILED, name, reason, 0, 0);
}

static inline void CheckSkip(CO_DRIVER_CHECK* c, const char* name, const char* reason) {
  CheckSay(c, CHECK_SKIPPED, name, reason, 0, 0);
}

// Calls CO_DRIVER_CHECK.Idle; must be called in each iteration of a wait.
void CheckIdle(const CO_DRIVER_CHECK* c);

uint32_t CheckPatience(const CO_DRIVER_CHECK* c);
uint32_t CheckQuiet(const CO_DRIVER_CHECK* c);

#ifdef __cplusplus
}
#endif

#endif
