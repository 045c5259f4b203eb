// SPDX-License-Identifier: Apache-2.0
/// \file precompiled.hpp
/// Precompiled header with the headers that most tests include.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "fixture.hpp"
