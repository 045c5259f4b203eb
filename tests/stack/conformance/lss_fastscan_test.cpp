// SPDX-License-Identifier: Apache-2.0
// LSS fastscan. [305] [L6]
#include <cstdlib>

#include "support/fixture.hpp"

#if USE_LSS

namespace {

using namespace test;

using Identity = std::array<std::uint32_t, 4>;

Setup slave(const Identity& identity, std::uint8_t node_id = 255) {
  Setup setup;
  setup.node_id(node_id).only_small();
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    setup.with({CO_KEY(0x1018, sub, CO_OBJ_D___R_), CO_TUNSIGNED32, identity[sub - 1]});
  }
  return setup;
}

CO_IF_FRM scan(std::uint32_t number, unsigned bit, unsigned part, unsigned next) {
  CO_IF_FRM request = frame("7E5#5100000000000000");
  CO_SET_LONG(&request, number, 1);
  request.Data[5] = static_cast<std::uint8_t>(bit);
  request.Data[6] = static_cast<std::uint8_t>(part);
  request.Data[7] = static_cast<std::uint8_t>(next);
  return request;
}

bool answers(Fixture& node, const CO_IF_FRM& request) {
  node.rx(request);
  const auto sent = node.frames();
  CHECK((sent.empty() || sent == std::vector<std::string>{"7E4#4F00000000000000"}));
  return !sent.empty();
}

// Runs a fastscan. Returns the LSS address found, bit by bit.
Identity find(Fixture& node) {
  Identity found = {};
  REQUIRE(answers(node, scan(0, 0x80, 0, 0)));
  for (unsigned part = 0; part < 4; ++part) {
    for (unsigned bit = 32; bit-- > 0;) {
      if (!answers(node, scan(found[part], bit, part, part))) {
        found[part] |= 1U << bit;
      }
    }
    REQUIRE(answers(node, scan(found[part], 0, part, (part + 1) % 4)));
  }
  return found;
}

TEST_CASE("LSS fastscan: finds each identity and switches its node to the state configuration") {
  const Identity identities[] = {{0, 0, 0, 0},
                                 {0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF},
                                 {0x00000319, 0x12345678, 0x00010002, 0x80000001},
                                 {0x80000000, 0x00000001, 0x7FFFFFFF, 0xAAAAAAAA}};
  for (const Identity& identity : identities) {
    Fixture node(slave(identity));
    CHECK(find(node) == identity);
    node.ask("7E5#1107000000000000", "7E4#1100000000000000");
    node.ask("7E5#0400000000000000", "707#00");
  }
}

TEST_CASE("LSS fastscan: only nodes without node-ID answer") {
  Fixture node(slave({1, 2, 3, 4}, 5));
  CHECK_FALSE(answers(node, scan(0, 0x80, 0, 0)));
  CHECK_FALSE(answers(node, scan(1, 0, 0, 1)));
}

TEST_CASE("LSS fastscan: a node that has been given a node-ID no longer takes part") {
  Fixture node(slave({1, 2, 3, 4}));
  node.rx("7E5#0401000000000000");
  node.ask("7E5#1107000000000000", "7E4#1100000000000000");
  CHECK_FALSE(answers(node, scan(0, 0x80, 0, 0)));
}

TEST_CASE("LSS fastscan: parts in the wrong order and invalid requests are not answered") {
  Fixture node(slave({1, 2, 3, 4}));
  REQUIRE(answers(node, scan(0, 0x80, 0, 0)));
  CHECK_FALSE(answers(node, scan(2, 0, 1, 2)));
  CHECK_FALSE(answers(node, scan(1, 32, 0, 0)));
  CHECK_FALSE(answers(node, scan(1, 0x7F, 0, 0)));
  CHECK_FALSE(answers(node, scan(1, 0x81, 0, 0)));
  CHECK_FALSE(answers(node, scan(1, 0, 0, 4)));
  CHECK_FALSE(answers(node, scan(1, 0, 4, 0)));
  CHECK(answers(node, scan(1, 0, 0, 1)));
  CHECK_FALSE(answers(node, scan(1, 0, 0, 1)));
  CHECK(answers(node, scan(2, 0, 1, 2)));
}

TEST_CASE("LSS fastscan: each start request of the master restarts it") {
  Fixture node(slave({1, 2, 3, 4}));
  REQUIRE(answers(node, scan(0, 0x80, 0, 0)));
  REQUIRE(answers(node, scan(1, 0, 0, 1)));
  REQUIRE(answers(node, scan(0, 0x80, 0, 0)));
  CHECK_FALSE(answers(node, scan(2, 0, 1, 2)));
  CHECK(answers(node, scan(1, 0, 0, 1)));
}

TEST_CASE("LSS fastscan: only the matching one of identities that differ by one bit is selected") {
  for (unsigned bit = 0; bit < 128; ++bit) {
    Identity own = {0x00000319, 0x12345678, 0x00010002, 0x80000001};
    const Identity looked_for = own;
    own[bit / 32] ^= 1U << bit % 32;
    Fixture node(slave(own));
    REQUIRE(answers(node, scan(0, 0x80, 0, 0)));
    bool matches = true;
    for (unsigned part = 0; part < 4; ++part) {
      matches = answers(node, scan(looked_for[part], 0, part, (part + 1) % 4)) && matches;
    }
    CHECK_FALSE(matches);
    node.rx("7E5#5E00000000000000");
    node.silent();
  }
}

}  // namespace

#endif
