// SPDX-License-Identifier: Apache-2.0
#include "co_ver.h"

extern "C" {

uint8_t COVerMajor(void) { return CO_VER_MAJOR; }

uint8_t COVerMinor(void) { return CO_VER_MINOR; }

uint8_t COVerBuild(void) { return CO_VER_BUILD; }

uint32_t COVersion(void) { return CO_VER_MAJOR * 10000U + CO_VER_MINOR * 100U + CO_VER_BUILD; }

void CO_VerInit(void) {}

}  // extern "C"
