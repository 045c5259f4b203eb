// SPDX-License-Identifier: Apache-2.0
// Defines doctest's functions: unity.cpp queries whether a doctest case is running, which is never true in these
// programs.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
