// SPDX-License-Identifier: Apache-2.0
/// \file access.hpp
/// Access types and PDO mapping of objects, object codes.
#pragma once

#include <cstdint>
#include <string_view>

namespace lexican::codict {

enum class Access : unsigned char {
  unknown,
  none,  ///< noAccess of CiA 311: in the dictionary, but neither readable nor writable
  ro,
  wo,
  rw,
  rwr,       ///< rw, process input: mappable in a TPDO
  rww,       ///< rw, process output: mappable in an RPDO
  constant,  ///< ro, with a value that never changes
};

/// Returns the word of CiA 306; "no" for `none`, which CiA 306 lacks; "unknown" for `unknown`.
std::string_view name_of(Access access);
/// Returns the access type of a word of CiA 306, in upper or lower case; unknown for all others.
Access access_named(std::string_view word);
/// Returns the access type that a wrong word probably means ("R", "read-only", "R/W"), for the remedy of a message.
Access access_meant_by(std::string_view word);

constexpr bool is_readable(Access access) {
  return access == Access::ro || access == Access::rw || access == Access::rwr || access == Access::rww ||
         access == Access::constant;
}
constexpr bool is_writable(Access access) {
  return access == Access::wo || access == Access::rw || access == Access::rwr || access == Access::rww;
}

/// Values of PDOMapping (CiA 306: no or optional) and of PDOmapping (CiA 311: a direction as well).
enum class PdoMapping : unsigned char { no, optional, standard, tpdo, rpdo };

/// Returns the word of CiA 311: no, optional, default, TPDO, RPDO.
std::string_view name_of(PdoMapping mapping);

/// Object code. [301: 7.4.3]
enum class ObjectCode : unsigned char {
  null = 0,
  domain = 2,
  deftype = 5,
  defstruct = 6,
  variable = 7,
  array = 8,
  record = 9,
};

/// Returns the name of an object code, such as DOMAIN or VAR; empty for undefined codes.
std::string_view name_of(ObjectCode code);
constexpr bool has_sub_objects(ObjectCode code) {
  return code == ObjectCode::array || code == ObjectCode::record || code == ObjectCode::defstruct;
}

}  // namespace lexican::codict
