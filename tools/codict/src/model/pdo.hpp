// SPDX-License-Identifier: Apache-2.0
/// \file pdo.hpp
/// The PDOs of a device, as its description has them before anybody configures it, or as a DCF configures them.
/// [301: 7.5.2.35 ff.]
#pragma once

#include <cstdint>
#include <vector>

#include "model/device.hpp"

namespace lexican::codict {

/// In which PDOs an entry can be mapped.
struct Directions {
  bool send = false;     ///< TPDOs
  bool receive = false;  ///< RPDOs
};

Directions directions_of(const Entry& entry);

/// A part of a PDO.
struct MappedObject {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::uint8_t bits = 0;
  const Entry* entry = nullptr;    ///< null for what is not described: a dummy, or a mistake
  const Entry* mapping = nullptr;  ///< the sub-object that maps it

  bool is_dummy() const { return index != 0 && index < 8 && sub_index == 0; }
};

struct Pdo {
  bool is_transmit = false;
  std::uint16_t number = 1;  ///< 1…512
  const Object* communication = nullptr;
  const Object* mapping = nullptr;  ///< null if only one of both is described
  bool is_multiplexed = false;      ///< sub-index 0 of the mapping is FEh or FFh
  std::vector<MappedObject> mapped;

  unsigned bits() const;  ///< of all that is mapped; 64 fit
  /// A sub-object of the communication parameters; null if there is none.
  const Entry* parameter(std::uint8_t sub_index) const;
};

/// RPDOs, then TPDOs, by number.
std::vector<Pdo> pdos_of(const Device& device);

}  // namespace lexican::codict
