// SPDX-License-Identifier: Apache-2.0
/// \file pdo_model.hpp
/// A model of the PDO parameters 1400h…1BFFh: the result of a write and the parameters after it, derived only from
/// CiA 301. [301:7.5.2.35-38]
#pragma once

#include <map>
#include <optional>
#include <set>

#include "pdo_fixture.hpp"
#include "restricted_ids.hpp"

namespace test {

/// The objects of a dictionary that contains only basic types.
class ModelObjects {
 public:
  explicit ModelObjects(const CO_DICT& dict);
  /// Returns the abort code of a mapping entry that is not empty; 0: valid.
  std::uint32_t check(bool transmit, std::uint32_t word) const;
  /// Returns the mapping entries that a TPDO (\a transmit) or an RPDO may have, without dummies and objects with flag
  /// A.
  std::vector<std::uint32_t> mappable(bool transmit) const;
  const std::set<std::uint16_t>& indices() const { return indices_; }

 private:
  struct Object {
    std::uint32_t flags;
    unsigned bits;  ///< 0: not mappable because of its type
    bool is_bit;    ///< may also be mapped as one bit
  };
  std::map<std::uint32_t, Object> objects_;  ///< by CO_DEV()
  std::set<std::uint16_t> indices_;
};

class PdoModel {
 public:
  PdoModel(const ModelObjects& objects, bool transmit, const PdoEntries& entries)
      : objects_(objects), transmit_(transmit), pdo_(entries) {}

  /// Write a parameter. Return the abort code; 0: success.
  std::uint32_t write_communication(std::uint8_t sub, std::uint32_t value);
  std::uint32_t write_number(std::uint32_t value);
  std::uint32_t write_word(std::uint8_t sub, std::uint32_t value);
  std::uint32_t read_communication(std::uint8_t sub) const;

  bool exists() const { return (pdo_.cob_id & 0x80000000U) == 0; }
  bool is_transmit() const { return transmit_; }
  /// Returns true for the transmission types 254 and 255.
  bool is_event_driven() const { return pdo_.type >= 254; }
  const PdoEntries& entries() const { return pdo_; }
  std::vector<std::uint32_t> words() const;
  /// Returns the CAN-ID in the notation of frames, without '#'.
  std::string identifier() const;

 private:
  std::uint32_t check_cob_id(std::uint32_t value) const;
  bool is_type(std::uint32_t value) const;

  const ModelObjects& objects_;
  bool transmit_;
  PdoEntries pdo_;
};

}  // namespace test
