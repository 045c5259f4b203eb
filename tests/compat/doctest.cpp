// SPDX-License-Identifier: Apache-2.0
// unity.cpp asks doctest whether one of its cases is running; in these programs none ever is.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
