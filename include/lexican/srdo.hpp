// SPDX-License-Identifier: Apache-2.0
/// \file lexican/srdo.hpp
/// Signature of an SRDO (co_srdo.h), computed by the compiler from its values. [EN 50325-5]
///
///     constexpr std::uint32_t mapping[] = {CO_LINK(0x2000, 1, 8), CO_LINK(0x2000, 2, 8)};
///     uint16_t Signature = co::srdo::signature({CO_SRDO_TX, 25, 20, 0x101, 0x102}, mapping);
#pragma once

extern "C++" {  // co_core.h may be included inside extern "C" { }

#include <cstddef>
#include <cstdint>

/// Signatures of SRDOs.
namespace co::srdo {

/// Communication parameter of an SRDO, 1301h….
struct Parameter {
  std::uint8_t direction;    ///< sub 1
  std::uint16_t cycle;       ///< sub 2: refresh time or SCT, ms
  std::uint8_t validation;   ///< sub 3: SRVT, ms
  std::uint32_t plain_id;    ///< sub 5: COB-ID 1
  std::uint32_t inverse_id;  ///< sub 6: COB-ID 2
};

/// Returns the CRC-16 (polynomial 1021h) of \a crc and the \a bytes of a number, lowest first.
constexpr std::uint16_t add(std::uint16_t crc, std::uint32_t number, unsigned bytes) {
  constexpr unsigned polynomial = 0x1021;
  unsigned sum = crc;
  for (; bytes != 0; --bytes, number >>= 8) {
    sum ^= (number & 0xFFu) << 8;
    for (unsigned bit = 0; bit < 8; ++bit) {
      sum = ((sum << 1) ^ ((sum & 0x8000u) != 0 ? polynomial : 0u)) & 0xFFFFu;
    }
  }
  return static_cast<std::uint16_t>(sum);
}

/// Returns the CRC of a communication parameter and the number of mapped objects, with which a signature begins.
constexpr std::uint16_t begin_signature(const Parameter& parameter, std::uint8_t number) {
  std::uint16_t crc = add(0, parameter.direction, 1);
  crc = add(crc, parameter.cycle, 2);
  crc = add(crc, parameter.validation, 1);
  crc = add(crc, parameter.plain_id, 4);
  crc = add(crc, parameter.inverse_id, 4);
  return add(crc, number, 1);
}

/// Returns the CRC with the mapped object of sub-index \a sub.
constexpr std::uint16_t add_mapping(std::uint16_t crc, std::uint8_t sub, std::uint32_t mapping) {
  return add(add(crc, sub, 1), mapping, 4);
}

/// Returns the signature of an SRDO with these mapped objects.
template <std::size_t Number>
constexpr std::uint16_t signature(const Parameter& parameter, const std::uint32_t (&mapping)[Number]) {
  static_assert(Number <= 16 && Number % 2 == 0, "an SRDO maps 2, 4, ... 16 objects");
  std::uint16_t crc = begin_signature(parameter, static_cast<std::uint8_t>(Number));
  for (std::size_t slot = 0; slot < Number; ++slot) {
    crc = add_mapping(crc, static_cast<std::uint8_t>(slot + 1), mapping[slot]);
  }
  return crc;
}

}  // namespace co::srdo

}  // extern "C++"
