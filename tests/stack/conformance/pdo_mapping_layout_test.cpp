// SPDX-License-Identifier: Apache-2.0
// Positions of mapped objects in the frame: numbers of the fixture in many orders.
// [301:7.2.2, 7.1.4]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

struct Layout {
  std::vector<std::uint32_t> words;
  const char* sampled;  ///< data of a TPDO with the initial values of the fixture
};

const Layout layouts[] = {
    {{0x22010108}, "11"},
    {{0x22010808}, "81"},
    {{0x22010108, 0x22010208, 0x22010308, 0x22010408, 0x22010508, 0x22010608, 0x22010708, 0x22010808},
     "1121314151617181"},
    {{0x22010808, 0x22010708, 0x22010608, 0x22010508, 0x22010408, 0x22010308, 0x22010208, 0x22010108},
     "8171615141312111"},
    {{0x22010208, 0x22010308, 0x22010408, 0x22010508}, "21314151"},
    {{0x22010108, 0x22010208, 0x22010408, 0x22010508, 0x22010108}, "1121415111"},
    {{0x22010108, 0x22010208, 0x22010208, 0x22010308}, "11212131"},
    {{0x22010108, 0x22010108, 0x22010208}, "111121"},
    {{0x22020110, 0x22020210, 0x22020210}, "111221222122"},
    {{0x22020210, 0x22020310}, "21223132"},
    {{0x22020110}, "1112"},
    {{0x22020110, 0x22020210, 0x22020310, 0x22020410}, "1112212231324142"},
    {{0x22020410, 0x22020310, 0x22020210, 0x22020110}, "4142313221221112"},
    {{0x22020110, 0x22020310, 0x22020510, 0x22020710}, "1112313251527172"},
    {{0x22030118}, "111213"},
    {{0x22030118, 0x22030218}, "111213212223"},
    {{0x22040120}, "11121314"},
    {{0x22040120, 0x22040220}, "1112131421222324"},
    {{0x22040220, 0x22040120}, "2122232411121314"},
    {{0x22050128}, "1112131415"},
    {{0x22060130}, "111213141516"},
    {{0x22070138}, "11121314151617"},
    {{0x22080140}, "1112131415161718"},
    {{0x22010108, 0x22020110, 0x22040120, 0x22010208}, "1111121112131421"},
    {{0x22010108, 0x22040120, 0x22020110, 0x22010208}, "1111121314111221"},
    {{0x22010108, 0x22030118, 0x22040120}, "1111121311121314"},
    {{0x22030118, 0x22050128}, "1112131112131415"},
    {{0x22060130, 0x22010108, 0x22010208}, "1112131415161121"},
    {{0x22010108, 0x22070138}, "1111121314151617"},
    {{0x22020110, 0x22020210, 0x22010108, 0x22010208, 0x22020310}, "1112212211213132"},
    {{0x22010108, 0x22010208, 0x22020110, 0x22020210}, "112111122122"},
    {{0x22110108, 0x22120110, 0x22140120}, "11111211121314"},
    {{0x22540120, 0x22540220}, "0000803F0000803F"},
    {{0x22580140}, "000000000000F03F"},
};

TEST_CASE("PDO layout: a TPDO contains its objects in the order of the mapping, each little-endian [M10]") {
  PdoNode node;
  node.start();
  for (const Layout& one : layouts) {
    CAPTURE(one.sampled);
    REQUIRE(node.remap_tpdo(0, one.words, 0x40000181) == 0);
    node.trigger(0);
    node.tx("181#" + std::string(one.sampled));
    node.trigger(0);
    node.tx("181#" + std::string(one.sampled));
  }
}

TEST_CASE("PDO layout: an RPDO writes its objects in the order of the mapping, each little-endian [M10]") {
  const char* const pattern = "A1B2C3D4E5F60718";
  const Bytes bytes{0xA1, 0xB2, 0xC3, 0xD4, 0xE5, 0xF6, 0x07, 0x18};
  for (const Layout& one : layouts) {
    CAPTURE(one.sampled);
    PdoNode node;
    node.start();
    REQUIRE(node.remap_rpdo(0, one.words, 0x201) == 0);
    node.rx("201#" + std::string(pattern, std::string(one.sampled).size()));
    std::map<std::uint32_t, Bytes> last;  // of an object that is mapped twice, the last value counts
    std::size_t at = 0;
    for (const std::uint32_t word : one.words) {
      const std::size_t size = (word & 0xFFU) / 8U;
      last[word] = Bytes(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                         bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
      at += size;
    }
    for (const auto& [word, expected] : last) {
      CHECK(node.upload(CO_GET_IDX(word), CO_GET_SUB(word)) == expected);
    }
  }
}

TEST_CASE("PDO layout: an RPDO writes only its objects") {
  const PdoVariables before;
  for (const Layout& one : layouts) {
    CAPTURE(one.sampled);
    PdoNode node;
    node.start();
    REQUIRE(node.remap_rpdo(0, one.words, 0x201) == 0);
    const std::string untouched(std::string(one.sampled).size(), 'F');
    node.rx("201#" + untouched);
    for (const std::uint16_t index :
         {std::uint16_t{0x2201}, std::uint16_t{0x2202}, std::uint16_t{0x2203}, std::uint16_t{0x2204},
          std::uint16_t{0x2205}, std::uint16_t{0x2206}, std::uint16_t{0x2207}, std::uint16_t{0x2208}}) {
      const unsigned width = index & 0xFU;
      for (std::uint8_t sub = 1; sub <= 8; ++sub) {
        const std::uint32_t word = CO_LINK(index, sub, 8U * width);
        const bool mapped = std::find(one.words.begin(), one.words.end(), word) != one.words.end();
        Bytes expected;
        for (unsigned k = 0; k < width; ++k) {
          expected.push_back(static_cast<std::uint8_t>(mapped ? 0xFFU : 16U * sub + k + 1U));
        }
        CHECK(node.upload(index, sub) == expected);
      }
    }
  }
}

TEST_CASE("PDO layout: aligned and unaligned variables are transferred") {
  for (unsigned offset = 0; offset < 8; ++offset) {
    CAPTURE(offset);
    alignas(8) std::uint8_t memory[24] = {};
    std::uint8_t* const first = memory + offset;
    PdoNode node({}, [&](Setup& setup) {
      setup.with({CO_KEY(0x2300, 1, CO_OBJ____PRW), CO_TUNSIGNED16, first});
      setup.with({CO_KEY(0x2300, 2, CO_OBJ____PRW), CO_TUNSIGNED16, first + 2});
      setup.with({CO_KEY(0x2300, 3, CO_OBJ____PRW), CO_TUNSIGNED32, first + 4});
      setup.with({CO_KEY(0x2300, 4, CO_OBJ____PRW), CO_TUNSIGNED64, first + 8});
    });
    for (std::uint8_t sub = 1; sub <= 4; ++sub) {
      node.may_change(0x2300, sub);
    }
    node.start();
    REQUIRE(node.remap_rpdo(0, {0x23000110, 0x23000210, 0x23000320}, 0x201) == 0);
    REQUIRE(node.remap_tpdo(0, {0x23000320, 0x23000210, 0x23000110}, 0x40000181) == 0);
    node.rx("201#0102030405060708");
    CHECK(node.get(0x2300, 1) == 0x0201);
    CHECK(node.get(0x2300, 2) == 0x0403);
    CHECK(node.get(0x2300, 3) == 0x08070605);
    node.trigger(0);
    node.tx("181#0506070803040102");
    REQUIRE(node.remap_rpdo(0, {0x23000440}, 0x201) == 0);
    node.rx("201#A1A2A3A4A5A6A7A8");
    CHECK(node.get(0x2300, 4) == 0xA8A7A6A5A4A3A2A1);
    CHECK(node.get(0x2300, 3) == 0x08070605);
    CHECK(std::count(memory, memory + offset, 0) == static_cast<std::ptrdiff_t>(offset));
    CHECK(std::count(first + 16, memory + 24, 0) == static_cast<std::ptrdiff_t>(8 - offset));
  }
}

}  // namespace
