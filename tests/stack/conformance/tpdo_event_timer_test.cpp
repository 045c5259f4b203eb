// SPDX-License-Identifier: Apache-2.0
// Event timer of TPDOs: 1800h…, sub 5. [301:7.5.2.37]
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 0

namespace {

using namespace test;

PdoTable timed(std::uint16_t ms, std::uint8_t type = 255) {
  PdoTable table;
  table.tpdo[0].on(0x40000181, type, {0x22110108}).event = ms;
  return table;
}

TEST_CASE("TPDO event timer: the first PDO is sent one period after entering Operational [N11] [PDO 05]") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{254, 255}) {
    PdoNode node(timed(100, type));
    node.after(1000ms);
    node.silent();
    node.start();
    node.after(350ms);
    node.tx_at(100ms, "181#11");
    node.tx_at(200ms, "181#11");
    node.tx_at(300ms, "181#11");
    node.silent();
  }
}

TEST_CASE("TPDO event timer: each transmission restarts it [X7]") {
  PdoNode node(timed(100));
  node.start();
  for (int i = 0; i < 10; ++i) {
    node.after(99ms);
    node.silent();
    node.trigger(0);
    node.tx("181#11");
  }
  node.after(100ms);
  node.tx_at(100ms, "181#11");
}

TEST_CASE("TPDO event timer: no drift and no lost period in 10^5 periods [Q8] [T15]") {
  PdoNode node(timed(10), [=](Setup& setup) { setup.rate(300).clock(0xFFFFFF00U); });
  node.start();
  const std::uint64_t begin = node.now();
  for (unsigned second = 1; second <= 1000 / stride(50); ++second) {
    node.after(1000ms);
    REQUIRE(node.can.sent.size() == 100);
    CHECK(node.can.sent.back().tick == begin + 300U * second);
    node.frames();
  }
}

TEST_CASE("TPDO event timer: an occasionally late main loop keeps the phase [Q8]") {
  PdoNode node(timed(10));
  node.start();
  const std::uint64_t begin = node.now();
  unsigned sent = 0;
  for (unsigned i = 0; i < 10000 / stride(10); ++i) {
    node.jump(std::chrono::milliseconds{1 + i * 11 % 10});
    sent += static_cast<unsigned>(node.frames().size());
  }
  const std::uint64_t passed = node.now() - begin;
  CHECK(sent + 0U == passed / 10);  // delays are shorter than the period: no TPDO is skipped
  node.after(std::chrono::milliseconds{10 - passed % 10});
  CHECK(node.frames().size() == 1);
}

TEST_CASE("TPDO event timer: a main loop that is many periods late sends one PDO and keeps the phase [Q8]") {
  PdoNode node(timed(10));
  node.start();
  node.jump(1003ms);
  node.tx("181#11");
  node.after(8ms);
  node.tx_at(7ms, "181#11");
}

TEST_CASE("TPDO event timer: only event-driven PDOs use it [X7]") {
  for (unsigned type = 0; type < 254; type += type < 240 ? stride(16) : 1) {
    const bool allowed = (type <= 240 && USE_SYNC != 0) || (type >= 252 && USE_PDO_RTR != 0);
    if (!allowed) {
      continue;
    }
    PdoNode node(timed(10, static_cast<std::uint8_t>(type)));
    node.start();
    CHECK(node.armed_timers() == 0);
    node.after(100ms);
    node.silent();
    CHECK(node.set(0x1800, 5, 2, 20) == 0);
    node.after(100ms);
    node.silent();
  }
}

TEST_CASE("TPDO event timer: after Pre-operational and back one timer runs with the same period [D38] [PDO 15]") {
  PdoNode node(timed(100));
  node.start();
  for (int i = 0; i < 50; ++i) {
    node.after(30ms);
    node.rx("000#8001");
    CHECK(node.armed_timers() == 0);
    node.after(200ms);
    node.silent();
    node.rx("000#0101");
    CHECK(node.armed_timers() == 1);
  }
  node.after(1000ms);
  CHECK(node.frames().size() == 10);
}

TEST_CASE("TPDO event timer: start in Operational does not change it [N7]") {
  PdoNode node(timed(100));
  node.start();
  node.after(60ms);
  node.rx("000#0101");
  node.silent();
  node.after(100ms);
  node.tx_at(40ms, "181#11");
  node.silent();
}

TEST_CASE("TPDO event timer: switching a PDO on in Operational starts a period [P11]") {
  PdoNode node(timed(100));
  node.start();
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  node.after(1000ms);
  node.silent();
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  node.after(250ms);
  node.tx_at(100ms, "181#11");
  node.tx_at(200ms, "181#11");
}

TEST_CASE("TPDO event timer: a new time starts with its write; 0 ends it; other TPDOs are not affected [P11] [D39]") {
  PdoNode node(timed(100), [](Setup& setup) { setup.heartbeat(1000); });
  node.start();
  node.after(90ms);
  CHECK(node.set(0x1800, 5, 2, 300) == 0);
  node.after(610ms);
  node.tx_at(300ms, "181#11");
  node.tx_at(600ms, "181#11");
  CHECK(node.set(0x1800, 5, 2, 0) == 0);
  CHECK(node.armed_timers() == 1);
  node.after(2000ms);
  node.tx_at(300ms, "701#05");
  node.tx_at(1300ms, "701#05");
  node.silent();
}

TEST_CASE("TPDO event timer: a PDO that cannot be sent is not sent later; the timer continues") {
  PdoNode node(timed(100), [](Setup& setup) { setup.tx_queue(1); });
  node.start();
  node.can.refuse_all();
  CO_IF_FRM other = frame("123#01");
  node.call([&] { COIfCanSend(&node->If, &other); });
  node.after(150ms);
  node.can.accept_all();
  node.loop();
  node.tx("123#01");
  node.after(100ms);
  node.tx_at(50ms, "181#11");
}

TEST_CASE("TPDO event timer: the longest time and 1 ms are kept") {
  PdoNode node(timed(65535));
  node.start();
  node.after(65534ms);
  node.silent();
  node.after(1ms);
  node.tx("181#11");
  CHECK(node.set(0x1800, 5, 2, 1) == 0);
  node.after(5ms);
  CHECK(node.frames().size() == 5);
}

TEST_CASE("TPDO event timer: all PDOs may have one period") {
  PdoTable table;
  for (unsigned n = 0; n < fixture_tpdos; ++n) {
    table.tpdo[n].on(0x40000181 + n * 0x100, 255, {0x22010108}).event = 50;
  }
  PdoNode node(table);
  node.start();
  for (int i = 0; i < 20; ++i) {
    node.after(50ms);
    const std::vector<std::string> sent = node.frames();
    REQUIRE(sent.size() == fixture_tpdos);
    CHECK(sent.back() == notation(CO_IF_FRM{0x181 + (fixture_tpdos - 1) * 0x100, {0x11}, 1}));
  }
}

}  // namespace

#endif
