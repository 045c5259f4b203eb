// SPDX-License-Identifier: Apache-2.0
/// \file large_xdd.hpp
/// Generates large XDDs, for measurements of time and memory.
#pragma once

#include <cstddef>
#include <string>

namespace test {

enum class Large : unsigned char {
  objects,                ///< objects with a parameter each, which has words, a range and a property
  sub_objects,            ///< records of 250 sub-objects, which have attributes only
  described_sub_objects,  ///< records of 250 sub-objects with a parameter each
};

/// Returns an XDD of CiA 311 1.1 of about so many bytes, with the mandatory objects of CiA 301.
std::string large_xdd(Large kind, std::size_t bytes);

}  // namespace test
