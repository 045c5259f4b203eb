// SPDX-License-Identifier: Apache-2.0
/// \file pdo_fixture.hpp
/// A node with four RPDOs and four TPDOs (or as many as are configured), variables for their parameters, and objects to
/// map:
///
///     PdoTable table;                                        // all PDOs off, nothing mapped
///     table.rpdo[0].on(0x201, 255, {0x22010108});            // 1400h:1, 1400h:2, 1600h
///     table.tpdo[0].on(0x40000181, 255, {0x22020110, 0x22010208});
///     PdoNode node(table);                                   // node-ID 1, Pre-operational
///     node.start();                                          // Operational
///     node.rx("201#2A");          CHECK(node.u8[0] == 0x2A);
///     node.trigger(0);            node.tx("181#121121");
///     CHECK(node.set(0x1800, 3, 2, 100) == 0x06090030);      // SDO download of 2 bytes: abort code, 0: done
///
/// Objects, sub-index 1…8 for element 0…7 of the variable. Byte k of sub-index s holds 16 s + k + 1:
///   220wh        P RW  numbers of w bytes, w = 1…8 (u8 … u64)
///   2211h, 2212h, 2214h  A P RW  numbers of 1, 2, 4 bytes (a8, a16, a32)
///   222wh:1      P R   w = 1, 2, 4, 8 (r8, r16, r32, r64)
///   223wh:1      P W   w = 1, 2, 4, 8 (w8, w16, w32, w64)
///   224wh:1      RW    not mappable, w = 1, 2, 4, 8 (n8, n16, n32, n64)
///   2250h        P RW  BOOLEAN (boolean), 0
///   2254h, 2258h P RW  REAL32, REAL64 (real32, real64), 1.0
/// The dictionary of Setup is included.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "fixture.hpp"

namespace test {

/// The parameters of one PDO: 1400h + n and 1600h + n, or 1800h + n and 1A00h + n.
struct PdoEntries {
  std::uint32_t cob_id = 0x80000000;
  std::uint8_t type = 254;
  std::uint16_t inhibit = 0;  ///< x 100 µs
  std::uint16_t event = 0;    ///< ms
  std::uint8_t start = 0;     ///< TPDOs only
  std::uint8_t number = 0;
  std::array<std::uint32_t, CO_PDO_MAP_N> map{};

  PdoEntries& on(std::uint32_t cob_id_value, std::uint8_t type_value, std::initializer_list<std::uint32_t> words);
};

/// Initial values of the dictionary.
struct PdoTable {
  PdoTable();
  std::array<PdoEntries, 4> rpdo;  ///< 80000201h, 80000301h, …
  std::array<PdoEntries, 4> tpdo;  ///< C0000181h, C0000281h, …
};

/// PDOs of the fixture that the configuration has.
inline constexpr unsigned fixture_rpdos = CO_RPDO_N < 4 ? CO_RPDO_N : 4;
inline constexpr unsigned fixture_tpdos = CO_TPDO_N < 4 ? CO_TPDO_N : 4;

/// Variables of the mappable objects.
struct PdoVariables {
  PdoVariables();
  std::uint8_t u8[8], a8[8], r8, w8, n8, boolean[8] = {};
  std::uint16_t u16[8], a16[8], r16, w16, n16;
  std::uint32_t u24[8];
  std::uint32_t u32[8], a32[8], r32, w32, n32;
  std::uint64_t u40[8], u48[8], u56[8];
  std::uint64_t u64[8], r64, w64, n64;
  float real32[8];
  double real64[8];
};

class PdoNode : public PdoTable, public PdoVariables, public Fixture {
 public:
  /// \a change: settings of the fixture; entries that it adds replace those of this one.
  explicit PdoNode(const PdoTable& table = {}, const std::function<void(Setup&)>& change = {});

  /// Enters Operational and checks that no frame is sent.
  void start(Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Writes 1…8 bytes by SDO. Returns the abort code, 0: success.
  std::uint32_t set(std::uint16_t index, std::uint8_t sub, unsigned bytes, std::uint64_t value,
                    Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Reads 1…8 bytes by SDO. Must succeed.
  std::uint64_t get(std::uint16_t index, std::uint8_t sub, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Call COTPdoTrigPdo() and COTPdoRequest().
  void trigger(std::uint16_t number, Where at = {__builtin_FILE(), __builtin_LINE()});
  CO_ERR request(std::uint16_t number, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Runs the remapping procedure [301:7.5.2.36]: off, number 0, words, number, COB-ID. Returns the first abort code,
  /// 0: success.
  std::uint32_t remap_rpdo(unsigned n, const std::vector<std::uint32_t>& words, std::uint32_t cob_id,
                           Where at = {__builtin_FILE(), __builtin_LINE()});
  std::uint32_t remap_tpdo(unsigned n, const std::vector<std::uint32_t>& words, std::uint32_t cob_id,
                           Where at = {__builtin_FILE(), __builtin_LINE()});

 private:
  Setup setup(const std::function<void(Setup&)>& change);
  void watch_parameters();
  std::uint32_t remap(std::uint16_t communication, std::uint16_t mapping, const std::vector<std::uint32_t>& words,
                      std::uint32_t cob_id, Where at);
};

}  // namespace test
