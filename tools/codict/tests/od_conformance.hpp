// SPDX-License-Identifier: Apache-2.0
/// \file od_conformance.hpp
/// Comparison of a description with its device over the bus: the cases OD 01 to OD 09 of CiA's conformance test. Each
/// check returns a line for each contradiction, "2101h:00 default: 00 00, not 3C 00".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gen_node.hpp"
#include "model/device.hpp"

namespace test {

using Contradictions = std::vector<std::string>;

/// Range of the objects that a case checks.
struct Area {
  std::uint16_t first;
  std::uint16_t last;
};

constexpr Area communication = {0x1000, 0x1FFF};
constexpr Area beyond = {0x2000, 0xFFFF};  ///< manufacturer-specific objects and those of profiles

class OdConformance {
 public:
  OdConformance(const lexican::codict::Device& described, GeneratedNode& node, Area area)
      : described_(described), node_(node), area_(area) {}

  Contradictions access();      ///< readable values have the length of their type; writable objects accept a value
  Contradictions defaults();    ///< default values, including constants and sub-index 0
  Contradictions read_only();   ///< writes to read-only objects are aborted with 0601 0002h
  Contradictions write_only();  ///< reads of write-only objects are aborted with 0601 0001h
  Contradictions structure();   ///< sub-index FFh, if supported, and sub-index 0
  Contradictions limits();      ///< limits of integers: 0609 0031h, 0609 0032h
  Contradictions absence();     ///< objects without description are missing: 0602 0000h, 0609 0011h
  Contradictions mapping();     ///< objects that can be mapped in a PDO with variable mapping, by access right
  Contradictions flags();       ///< mappable objects, compared with flag P in the dictionary
  Contradictions identity();    ///< 1018h equals the identity in DeviceInfo

 private:
  using Entry = lexican::codict::Entry;
  template <typename Check>
  Contradictions for_each(Check check);
  bool is_in_area(std::uint16_t index) const { return index >= area_.first && index <= area_.last; }
  std::string content_of(std::uint16_t index, std::uint8_t sub_index, const Entry& entry);
  std::string default_of(const Entry& entry) const;
  void map_to(std::uint16_t mapping, std::uint16_t index, std::uint8_t sub_index, const Entry& entry,
              Contradictions& found);

  const lexican::codict::Device& described_;
  GeneratedNode& node_;
  Area area_;
};

}  // namespace test
