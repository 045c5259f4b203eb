// SPDX-License-Identifier: Apache-2.0
/// \file access.hpp
/// Who may read and write an object, over SDO and in PDOs.
#pragma once

#include <cstdint>
#include <string_view>

namespace lexican::codict {

enum class Access : unsigned char {
  unknown,
  none,  ///< noAccess of CiA 311: in the dictionary, and out of reach
  ro,
  wo,
  rw,
  rwr,       ///< rw, and process input: goes out in a TPDO
  rww,       ///< rw, and process output: comes in an RPDO
  constant,  ///< ro, and never changes
};

/// The word of CiA 306, or its meaning there for `none` ("no"); "unknown".
std::string_view name_of(Access access);
/// The words of CiA 306, in capitals or not; unknown for all others.
Access access_named(std::string_view word);

constexpr bool is_readable(Access access) {
  return access == Access::ro || access == Access::rw || access == Access::rwr || access == Access::rww ||
         access == Access::constant;
}
constexpr bool is_writable(Access access) {
  return access == Access::wo || access == Access::rw || access == Access::rwr || access == Access::rww;
}

/// PDOMapping of CiA 306 says no or optional, PDOmapping of CiA 311 also a direction.
enum class PdoMapping : unsigned char { no, optional, standard, tpdo, rpdo };

/// The words of CiA 311: no, optional, default, TPDO, RPDO.
std::string_view name_of(PdoMapping mapping);

/// What an object is. [301: 7.4.3]
enum class ObjectCode : unsigned char {
  null = 0,
  domain = 2,
  deftype = 5,
  defstruct = 6,
  variable = 7,
  array = 8,
  record = 9,
};

/// DOMAIN, VAR and so on; empty for numbers that are none.
std::string_view name_of(ObjectCode code);
constexpr bool has_sub_objects(ObjectCode code) {
  return code == ObjectCode::array || code == ObjectCode::record || code == ObjectCode::defstruct;
}

}  // namespace lexican::codict
