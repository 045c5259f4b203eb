// SPDX-License-Identifier: Apache-2.0
/// \file srdo_fixture.hpp
/// A node with two SRDOs, variables for their parameters, and objects to map:
///
///     SrdoTable table;                              // no SRDO exists, 13FEh = A5h
///     table.srdo[0].receive(0x109, pair_of_3);      // SCT 50 ms, SRVT 20 ms, three bytes
///     SrdoNode node(table);                         // signatures are right; node-ID 1, Pre-operational
///     node.rx("000#0101");                          // Operational
///     node.rx("109#112233");  node.rx("10A#EEDDCC");
///     CHECK(node.u8[0] == 0x11);  CHECK(node.state() == CO_SRDO_ESTABLISHED);
///
/// Objects, sub-index 1…8 for element 0…7; the inverse object has the next index:
///   2300h, 2301h  P RW  UNSIGNED8 (u8, inverse8), 2302h, 2303h UNSIGNED16, 2304h, 2305h UNSIGNED32
///   2306h:1, 2307h:1  P RW  UNSIGNED64
///   2308h:1 P R, 2309h:1 P W, 230Ah:1 RW, each UNSIGNED8
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "fixture.hpp"

#if CO_SRDO_N > 1

namespace test {

/// Three bytes: UNSIGNED8 and UNSIGNED16, and their inverse objects.
inline const std::vector<std::uint32_t> pair_of_3 = {0x23000108, 0x23010108, 0x23020110, 0x23030110};

/// Parameters of one SRDO.
struct SrdoEntries {
  std::uint8_t direction = 0;
  std::uint16_t cycle = 50;
  std::uint8_t validation = 20;
  std::uint8_t type = 254;
  std::uint32_t plain_id = 0x101;
  std::uint32_t inverse_id = 0x102;
  std::uint8_t number = 0;
  std::array<std::uint32_t, 16> map{};
  std::uint16_t signature = 0;

  SrdoEntries& set(std::uint8_t way, std::uint32_t cob_id, const std::vector<std::uint32_t>& words) {
    direction = way;
    plain_id = cob_id;
    inverse_id = cob_id + 1;
    number = static_cast<std::uint8_t>(words.size());
    std::copy(words.begin(), words.end(), map.begin());
    return *this;
  }
  SrdoEntries& receive(std::uint32_t cob_id, const std::vector<std::uint32_t>& words) { return set(2, cob_id, words); }
  SrdoEntries& send(std::uint32_t cob_id, const std::vector<std::uint32_t>& words) { return set(1, cob_id, words); }
};

/// Returns the signature, computed bit by bit from the definition in the standard.
inline std::uint16_t signature_of(const SrdoEntries& srdo) {
  Bytes bytes;
  const auto add = [&](std::uint32_t value, unsigned length) {
    for (; length != 0; --length, value >>= 8) bytes.push_back(static_cast<std::uint8_t>(value));
  };
  add(srdo.direction, 1);
  add(srdo.cycle, 2);
  add(srdo.validation, 1);
  add(srdo.plain_id, 4);
  add(srdo.inverse_id, 4);
  add(srdo.number, 1);
  for (unsigned n = 0; n < srdo.number && n < 16; ++n) {
    add(n + 1, 1);
    add(srdo.map[n], 4);
  }
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    for (unsigned bit = 0x80; bit != 0; bit >>= 1) {
      const bool feedback = ((crc & 0x8000) != 0) != ((byte & bit) != 0);
      crc = ((crc << 1) ^ (feedback ? 0x1021U : 0U)) & 0xFFFF;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

/// Initial values of the dictionary.
struct SrdoTable {
  SrdoTable() {
    srdo[1].plain_id = 0x103;
    srdo[1].inverse_id = 0x104;
  }
  std::array<SrdoEntries, 2> srdo;
  std::uint8_t valid = 0xA5;
  bool is_signed = true;  ///< the fixture computes the signatures
};

/// Variables of the mappable objects.
struct SrdoVariables {
  std::uint8_t u8[8] = {}, inverse8[8];
  std::uint16_t u16[8] = {}, inverse16[8];
  std::uint32_t u32[8] = {}, inverse32[8];
  std::uint64_t u64 = 0, inverse64 = ~0ULL;
  std::uint8_t r8 = 0, w8 = 0, n8 = 0;
  SrdoVariables() {
    std::fill(std::begin(inverse8), std::end(inverse8), std::uint8_t{0xFF});
    std::fill(std::begin(inverse16), std::end(inverse16), std::uint16_t{0xFFFF});
    std::fill(std::begin(inverse32), std::end(inverse32), 0xFFFFFFFF);
  }
};

class SrdoNode : public SrdoTable, public SrdoVariables, public Fixture {
 public:
  using Change = std::pair<unsigned, CO_SRDO_STATE>;

  explicit SrdoNode(const SrdoTable& table = {}, const std::function<void(Setup&)>& change = {})
      : SrdoTable(sign(table)), Fixture(setup(change)) {
    frames_per_call(6);
    callbacks().srdo_change = [this](CO_NODE* of, std::uint8_t number, CO_SRDO_STATE to) {
      CHECK(of == &node);
      CHECK(COSrdoGetState(of, number) == to);
      changes.emplace_back(number, to);
    };
  }

  CO_SRDO_STATE state(std::uint8_t number = 0) const { return COSrdoGetState(&node, number); }
  std::vector<Change> take_changes() { return std::exchange(changes, {}); }
  CO_ERR request(std::uint8_t number = 0) {
    CO_ERR result = CO_ERR_NONE;
    call([&] { result = COSrdoRequest(&node, number); });
    return result;
  }
  /// Writes 1…4 bytes by SDO. Returns the abort code, 0: success.
  std::uint32_t set(std::uint16_t index, std::uint8_t sub, unsigned bytes, std::uint32_t value) {
    Bytes data;
    for (unsigned n = 0; n < bytes; ++n) data.push_back(static_cast<std::uint8_t>(value >> (8 * n)));
    return download(index, sub, data);
  }
  /// Enters Operational; \a expected: EMCY messages.
  void start(std::initializer_list<std::string_view> expected = {}) {
    rx("000#0101");
    tx(expected);
  }

  std::vector<Change> changes;

 private:
  static SrdoTable sign(SrdoTable table) {
    for (SrdoEntries& srdo : table.srdo) {
      srdo.signature = table.is_signed ? signature_of(srdo) : srdo.signature;
    }
    return table;
  }

  template <class T>
  static void add(Setup& setup, std::uint16_t index, const CO_OBJ_TYPE* type, T& variables) {
    std::uint8_t sub = 0;
    for (auto& variable : variables) {
      setup.with({CO_KEY(index, ++sub, CO_OBJ____PRW), type, &variable}).may_change(index, sub);
    }
  }

  Setup setup(const std::function<void(Setup&)>& change) {
    Setup setup;
    setup.only_small();
    for (std::uint16_t n = 0; n < srdo.size(); ++n) {
      SrdoEntries& of = srdo[n];
      const auto com = static_cast<std::uint16_t>(0x1301 + n);
      const auto map = static_cast<std::uint16_t>(0x1381 + n);
      setup.with({CO_KEY(com, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 6})
          .with({CO_KEY(com, 1, CO_OBJ_____RW), CO_TSRDO_COM, &of.direction})
          .with({CO_KEY(com, 2, CO_OBJ_____RW), CO_TSRDO_COM, &of.cycle})
          .with({CO_KEY(com, 3, CO_OBJ_____RW), CO_TSRDO_COM, &of.validation})
          .with({CO_KEY(com, 4, CO_OBJ_____RW), CO_TSRDO_COM, &of.type})
          .with({CO_KEY(com, 5, CO_OBJ_____RW), CO_TSRDO_COM, &of.plain_id})
          .with({CO_KEY(com, 6, CO_OBJ_____RW), CO_TSRDO_COM, &of.inverse_id})
          .with({CO_KEY(map, 0, CO_OBJ_____RW), CO_TSRDO_MAP, &of.number});
      for (std::uint8_t sub = 1; sub <= 16; ++sub) {
        setup.with({CO_KEY(map, sub, CO_OBJ_____RW), CO_TSRDO_MAP, &of.map[sub - 1U]});
      }
      setup.with({CO_KEY(0x13FF, n + 1, CO_OBJ_____RW), CO_TSRDO_SIGNATURE, &of.signature});
    }
    setup.with({CO_KEY(0x13FE, 0, CO_OBJ_____RW), CO_TSRDO_VALID, &valid})
        .with({CO_KEY(0x13FF, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 2});
    add(setup, 0x2300, CO_TUNSIGNED8, u8);
    add(setup, 0x2301, CO_TUNSIGNED8, inverse8);
    add(setup, 0x2302, CO_TUNSIGNED16, u16);
    add(setup, 0x2303, CO_TUNSIGNED16, inverse16);
    add(setup, 0x2304, CO_TUNSIGNED32, u32);
    add(setup, 0x2305, CO_TUNSIGNED32, inverse32);
    setup.with({CO_KEY(0x2306, 1, CO_OBJ____PRW), CO_TUNSIGNED64, &u64})
        .may_change(0x2306, 1)
        .with({CO_KEY(0x2307, 1, CO_OBJ____PRW), CO_TUNSIGNED64, &inverse64})
        .may_change(0x2307, 1)
        .with({CO_KEY(0x2308, 1, CO_OBJ____PR_), CO_TUNSIGNED8, &r8})
        .with({CO_KEY(0x2309, 1, CO_OBJ____P_W), CO_TUNSIGNED8, &w8})
        .with({CO_KEY(0x230A, 1, CO_OBJ_____RW), CO_TUNSIGNED8, &n8});
    if (change) change(setup);
    return setup;
  }
};

}  // namespace test

#endif
