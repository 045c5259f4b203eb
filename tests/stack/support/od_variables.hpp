// SPDX-License-Identifier: Apache-2.0
/// \file od_variables.hpp
/// Variables of every kind that co_od.h supports, for tests that iterate over all of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "logged_stream.hpp"
#include "od.hpp"

#if USE_OD

namespace test {

/// A variable, and the bytes that its original read function returns.
struct Variable {
  std::string name;
  OD_IO_t io;
  Bytes value;
};

/// A node with variables of all kinds. Their bytes are not 0, except behind the end of a text.
class Variables {
 public:
  Variables();

  /// Returns the variables of known length that are readable in pieces.
  std::vector<Variable> all();
  /// Returns the variables that store pieces unchanged.
  std::vector<Variable> writable();

  LoggedStream plain;
  LoggedStream extended;
  LoggedStream extensible;
  std::uint32_t number = 0x14131211;  ///< of an application type
  std::uint32_t other_number = 0x24232221;
  std::uint32_t relative = 0x02030405;
  Bytes octets = {1, 2, 3, 4, 5, 6, 7, 8, 9};  ///< of a domain
  CO_OBJ_DOM domain{0, 9, octets.data()};
  Bytes letters = {'l', 'e', 't', 't', 'e', 'r', 's', 0, 0, 0};
  CO_OBJ_STR_RW text{0, 10, 10, letters.data()};
  Bytes memory = {0x21, 0x22, 0x23, 0x24, 0x25, 0x26, 0x27};
  Bytes byte = {0x31};
  std::uint8_t long_value[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};

 private:
  Variable at(const std::string& name, std::uint16_t index, std::uint8_t sub, const Bytes& value);
  Variable in_memory(const std::string& name, Bytes& bytes);

 public:
  Fixture node;
};

/// Returns the bytes of a number in the byte order of the CPU.
template <class T>
Bytes bytes_of(T number, std::size_t length = sizeof(T)) {
  Bytes all(sizeof number);
  __builtin_memcpy(all.data(), &number, sizeof number);
  const std::ptrdiff_t above =
      __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? static_cast<std::ptrdiff_t>(sizeof number - length) : 0;
  return {all.begin() + above, all.begin() + above + static_cast<std::ptrdiff_t>(length)};
}

}  // namespace test

#endif
