// SPDX-License-Identifier: Apache-2.0
// LSS fastscan. [305] [L6]
#include <cstdlib>

#include "support/fixture.hpp"
#include "support/lss_master_fixture.hpp"

namespace {

using namespace test;

#if USE_LSS

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

#endif

// LSS master: fastscan. [305]

#if USE_LSS_MASTER

constexpr const char* identified = "7E4#4F00000000000000";

std::string scan_text(std::uint32_t number, unsigned bit, unsigned part, unsigned to) {
  CO_IF_FRM request = frame("7E5#5100000000000000");
  CO_SET_LONG(&request, number, 1);
  request.Data[5] = static_cast<std::uint8_t>(bit);
  request.Data[6] = static_cast<std::uint8_t>(part);
  request.Data[7] = static_cast<std::uint8_t>(to);
  return notation(request);
}

/// Simulated LSS slaves with these addresses, which respond to fastscan as in CiA 305.
class Slaves {
 public:
  explicit Slaves(std::vector<LssNumbers> addresses) : addresses_(std::move(addresses)), part_(addresses_.size(), 0) {}

  /// Responds for the slaves until the fastscan has ended; the last slave responds at the end of the time-out.
  void serve(LssMaster& node) {
    while (lss_ends.empty()) {
      for (const std::string& request : node.frames()) {
        ++requests;
        answers_ = answers_to(frame(request));
      }
      if (answers_ > 0) {
        node.rx(identified);
      }
      node.after(49ms);
      for (; answers_ > 1; --answers_) {
        node.rx(identified);
      }
      answers_ = 0;
      node.goes_on();
      node.after(1ms);
    }
  }

  std::vector<std::size_t> selected;
  unsigned requests = 0;

 private:
  unsigned answers_to(const CO_IF_FRM& request) {
    REQUIRE(request.Identifier == 0x7E5);
    REQUIRE(request.Data[0] == 0x51);
    unsigned answers = 0;
    for (std::size_t n = 0; n < addresses_.size(); ++n) {
      answers += answers_to(request, n) ? 1U : 0U;
    }
    return answers;
  }
  bool answers_to(const CO_IF_FRM& request, std::size_t slave) {
    const unsigned bit = request.Data[5];
    const unsigned part = request.Data[6];
    if (bit == 0x80) {
      part_[slave] = 0;
      return true;
    }
    const std::uint32_t mask = UINT32_MAX << bit;
    if (part != part_[slave] || ((CO_GET_LONG(&request, 1) ^ addresses_[slave][part]) & mask) != 0) {
      return false;
    }
    if (bit == 0 && request.Data[7] < part) {
      selected.push_back(slave);
    }
    part_[slave] = bit == 0 ? request.Data[7] : part_[slave];
    return true;
  }

  std::vector<LssNumbers> addresses_;
  std::vector<unsigned> part_;
  unsigned answers_ = 0;
};

TEST_CASE("LSS master fastscan: without an answer there is no unconfigured slave") {
  LssMaster node;
  node.run("7E5#5100000000800000", COLssmFastscan, nullptr, std::uint8_t{0});
  node.after(49ms);
  node.goes_on();
  node.after(1ms);
  node.end(CO_LSSM_NOT_FOUND);
  node.silent();
}

TEST_CASE("LSS master fastscan: tests each part from the highest bit, then its complete number, then the next part") {
  LssMaster node;
  node.run("7E5#5100000000800000", COLssmFastscan, nullptr, std::uint8_t{0});
  node.rx(identified);
  node.after(50ms);
  node.tx("7E5#51000000001F0000");
  node.after(50ms);  // bit 31 is 1
  node.tx("7E5#51000000801E0000");
  node.rx(identified);
  node.after(50ms);  // bit 30 is 0
  node.tx("7E5#51000000801D0000");
  for (unsigned bit = 28; bit > 0; --bit) {
    node.rx(identified);
    node.after(50ms);
    node.tx(scan_text(0x80000000, bit, 0, 0));
  }
  node.rx(identified);
  node.after(50ms);
  node.tx("7E5#5100000080000000");
  node.after(50ms);  // bit 0 is 1
  node.tx("7E5#5101000080000001");
  node.rx(identified);
  node.after(50ms);
  node.tx("7E5#51000000001F0101");
}

TEST_CASE("LSS master fastscan: finds each address in 133 requests, from the first part to the last") {
  const LssNumbers addresses[] = {{0, 0, 0, 0},
                                  {0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF},
                                  {0x00000319, 0x12345678, 0x00010002, 0x80000001},
                                  {0x80000000, 0x00000001, 0x7FFFFFFF, 0xAAAAAAAA}};
  for (const LssNumbers& one : addresses) {
    LssMaster node;
    Slaves slaves({one});
    CHECK(node.start(COLssmFastscan, nullptr, std::uint8_t{0}) == CO_ERR_NONE);
    slaves.serve(node);
    CHECK(node.end(CO_LSSM_OK).address == one);
    CHECK(slaves.selected == std::vector<std::size_t>{0});
    CHECK(slaves.requests == 133);
    node.silent();
  }
}

TEST_CASE("LSS master fastscan: the lowest address of several slaves is found; repeated answers count once") {
  LssMaster node;
  Slaves slaves(
      {{5, 7, 8, 0xFFFFFFFF}, {5, 7, 8, 0xFFFFFFFE}, {5, 6, 9, 1}, {5, 6, 9, 0x80000001}, {0x80000005, 0, 0, 0}});
  CHECK(node.start(COLssmFastscan, nullptr, std::uint8_t{0}) == CO_ERR_NONE);
  slaves.serve(node);
  CHECK(node.end(CO_LSSM_OK).address == LssNumbers{5, 6, 9, 1});
  CHECK(slaves.selected == std::vector<std::size_t>{2});
}

TEST_CASE("LSS master fastscan: known parts are requested once") {
  const LssNumbers one = {0x00000319, 0x12345678, 0x00010002, 0x80000001};
  for (unsigned num = 0; num <= 4; ++num) {
    LssMaster node;
    Slaves slaves({{0x00000319, 0x12345679, 0, 0}, one, {0x0000031A, 0, 0, 0}});
    CHECK(node.start(COLssmFastscan, one.data(), static_cast<std::uint8_t>(num)) == CO_ERR_NONE);
    slaves.serve(node);
    CHECK(node.end(CO_LSSM_OK).address == one);
    CHECK(slaves.selected == std::vector<std::size_t>{1});
    CHECK(slaves.requests == 1 + 4 + 32 * (4 - num));
  }
}

TEST_CASE("LSS master fastscan: no slave has the known parts: the result is not found") {
  for (unsigned num = 1; num <= 4; ++num) {
    LssMaster node;
    Slaves slaves({{1, 2, 3, 4}, {5, 6, 7, 8}});
    LssNumbers known = {1, 2, 3, 4};
    known[num - 1] ^= 0x80000000;
    CHECK(node.start(COLssmFastscan, known.data(), static_cast<std::uint8_t>(num)) == CO_ERR_NONE);
    slaves.serve(node);
    node.end(CO_LSSM_NOT_FOUND);
    CHECK(slaves.selected.empty());
    CHECK(slaves.requests == 1 + num);
  }
}

TEST_CASE("LSS master fastscan: the known part of an address is sent unchanged") {
  LssMaster node;
  node.run("7E5#5100000000800000", COLssmFastscan, lss_address, std::uint8_t{1});
  node.rx(identified);
  node.after(50ms);
  node.tx("7E5#5119030000000001");
  SUBCASE("no slave has it") {
    node.after(50ms);
    node.end(CO_LSSM_NOT_FOUND);
    node.silent();
  }
  SUBCASE("a slave has it") {
    node.rx(identified);
    node.after(50ms);
    node.tx("7E5#51000000001F0101");
  }
}

TEST_CASE("LSS master fastscan: a slave that does not answer to its complete number is lost") {
  for (unsigned part = 0; part < 4; ++part) {
    LssMaster node;
    CHECK(node.start(COLssmFastscan, nullptr, std::uint8_t{0}) == CO_ERR_NONE);
    for (unsigned request = 0; request < 33 * (part + 1); ++request) {
      node.frames();
      node.rx(identified);
      node.after(50ms);
    }
    node.goes_on();
    CHECK(node.frames().back() == scan_text(0, 0, part, (part + 1) % 4));
    node.after(50ms);
    node.end(CO_LSSM_TIMEOUT);
    node.silent();
  }
}

TEST_CASE("LSS master fastscan: it can be cancelled at each request") {
  for (unsigned requests = 0; requests < 133; requests += stride(12)) {
    LssMaster node;
    CHECK(node.start(COLssmFastscan, nullptr, std::uint8_t{0}) == CO_ERR_NONE);
    for (unsigned n = 0; n < requests; ++n) {
      CHECK(node.frames().size() == 1);
      node.rx(identified);
      node.after(50ms);
    }
    CHECK(node.frames().size() == 1);
    node.cancel();
    node.end(CO_LSSM_CANCELLED);
    node.rx(identified);
    node.after(100ms);
    node.silent();
    node.goes_on();
  }
}

#endif

}  // namespace
