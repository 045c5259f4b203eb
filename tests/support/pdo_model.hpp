// SPDX-License-Identifier: Apache-2.0
/// \file pdo_model.hpp
/// What a write to 1400h…1BFFh is answered with, and what a PDO holds then, by the rules of CiA 301 and nothing else.
/// [301:7.5.2.35-38]
#pragma once

#include <map>
#include <optional>
#include <set>

#include "pdo_fixture.hpp"
#include "restricted_ids.hpp"

namespace test {

/// The objects of a dictionary that is made of basic types.
class ModelObjects {
 public:
  explicit ModelObjects(const CO_DICT& dict);
  /// Abort code of a mapping entry that is not empty, 0: right.
  std::uint32_t check(bool transmit, std::uint32_t word) const;
  /// Words that an RPDO or a TPDO may have, without dummies and objects whose change is an event (flag A).
  std::vector<std::uint32_t> mappable(bool transmit) const;
  const std::set<std::uint16_t>& indices() const { return indices_; }

 private:
  struct Object {
    std::uint32_t flags;
    unsigned bits;  ///< 0: of a type that no PDO can hold
    bool is_bit;    ///< may be mapped as one bit, too
  };
  std::map<std::uint32_t, Object> objects_;  ///< by CO_DEV()
  std::set<std::uint16_t> indices_;
};

class PdoModel {
 public:
  PdoModel(const ModelObjects& objects, bool transmit, const PdoEntries& entries)
      : objects_(objects), transmit_(transmit), pdo_(entries) {}

  /// Abort code, 0: done.
  std::uint32_t write_communication(std::uint8_t sub, std::uint32_t value);
  std::uint32_t write_number(std::uint32_t value);
  std::uint32_t write_word(std::uint8_t sub, std::uint32_t value);
  std::uint32_t read_communication(std::uint8_t sub) const;

  bool exists() const { return (pdo_.cob_id & 0x80000000U) == 0; }
  bool is_transmit() const { return transmit_; }
  /// Event-driven, types 254 and 255.
  bool is_event_driven() const { return pdo_.type >= 254; }
  const PdoEntries& entries() const { return pdo_; }
  std::vector<std::uint32_t> words() const;
  /// In the notation of frames, without '#'.
  std::string identifier() const;

 private:
  std::uint32_t check_cob_id(std::uint32_t value) const;
  bool is_type(std::uint32_t value) const;

  const ModelObjects& objects_;
  bool transmit_;
  PdoEntries pdo_;
};

}  // namespace test
