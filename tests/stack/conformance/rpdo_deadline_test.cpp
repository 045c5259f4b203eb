// SPDX-License-Identifier: Apache-2.0
// RPDO deadline: event timer of an RPDO, EMCY 8250h. [301:7.5.2.35, 7.2.7.1 table 26]
#include "support/sync_fixture.hpp"

#if CO_RPDO_N > 0 && USE_EMCY

namespace {

using namespace test;

PdoTable watched(std::uint16_t ms, std::uint8_t type = 255) {
  PdoTable table;
  table.rpdo[0].on(0x201, type, {0x22010108}).event = ms;
  return table;
}

TEST_CASE("RPDO deadline: it does not start before the first frame [P11]") {
  PdoNode node(watched(100));
  node.start();
  node.after(70000ms);
  node.silent();
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("RPDO deadline: 8250h is sent once when the time since the last frame has elapsed [P11] [N11]") {
  for (const Wake wake : {Wake::alarm, Wake::deadline, Wake::every_tick}) {
    PdoNode node(watched(100), [=](Setup& setup) { setup.wake(wake); });
    node.start();
    node.rx("201#01");
    node.after(5000ms);
    node.tx_at(100ms, emcy(0x8250, 1));
    node.silent();
    CHECK(node.objects.error_register == 0x11);
  }
}

TEST_CASE("RPDO deadline: each frame restarts it, also at the last moment [P11]") {
  PdoNode node(watched(100));
  node.start();
  for (int i = 0; i < 20; ++i) {
    node.rx("201#01");
    node.after(99ms);
    node.silent();
  }
  node.after(1ms);
  node.tx(emcy(0x8250, 1));
}

TEST_CASE("RPDO deadline: the next frame resolves and restarts it [P11] [E2]") {
  PdoNode node(watched(100));
  node.start();
  for (int i = 0; i < 3; ++i) {
    node.rx("201#01");
    node.after(100ms);
    node.tx(emcy(0x8250, 1));
    node.rx("201#02");
    node.tx(emcy(0, 1));
    CHECK(node.u8[0] == 2);
    node.after(99ms);
    node.silent();
  }
}

TEST_CASE("RPDO deadline: a frame that is too short does not restart it; one that is too long does [X5]") {
  PdoNode node(watched(100));
  node.frames_per_call(3);
  node.start();
  node.rx("201#01");
  node.after(60ms);
  node.rx("201#");
  node.tx(emcy(0x8210, 1));
  node.after(40ms);
  node.tx(emcy(0x8250, 1));
  node.rx("201#0102");
  CHECK(node.frames().size() == 3);  // EMCY: both faults are resolved, and the PDO is too long
  node.after(99ms);
  node.silent();
  node.after(1ms);
  node.tx(emcy(0x8250, 1));
}

TEST_CASE("RPDO deadline: a synchronous RPDO restarts it when it is received, independent of SYNC") {
  if (USE_SYNC == 0) {
    return;
  }
  SyncTable table;
  table.rpdo[0].on(0x201, 10, {0x22010108}).event = 100;
  SyncNode node(table);
  node.start();
  node.rx("080#");
  node.rx("201#01");
  node.after(50ms);
  node.rx("080#");
  node.after(50ms);
  node.tx(emcy(0x8250, 1));
}

TEST_CASE("RPDO deadline: a new time restarts it; 0 ends it and resolves a reported error [P11]") {
  PdoNode node(watched(100));
  node.start();
  node.rx("201#01");
  node.after(50ms);
  CHECK(node.set(0x1400, 5, 2, 200) == 0);
  node.after(1000ms);
  node.tx_at(200ms, emcy(0x8250, 1));
  CHECK(node.set(0x1400, 5, 2, 0) == 0);
  node.tx(emcy(0, 1));
  node.rx("201#01");
  node.after(1000ms);
  node.silent();
  CHECK(node.set(0x1400, 5, 2, 10) == 0);
  node.after(1000ms);
  node.silent();  // the deadline starts with the next frame
  node.rx("201#01");
  node.after(10ms);
  node.tx(emcy(0x8250, 1));
}

TEST_CASE("RPDO deadline: leaving Operational ends it until the next frame [E10] [X9]") {
  for (const std::string command : {"000#8001", "000#0201"}) {
    CAPTURE(command);
    PdoNode node(watched(100));
    node.start();
    node.rx("201#01");
    node.rx(command);
    CHECK(node.armed_timers() == 0);
    node.after(1000ms);
    node.silent();
    node.rx("000#0101");
    node.after(1000ms);
    node.silent();
    node.rx("201#01");
    node.after(100ms);
    node.tx(emcy(0x8250, 1));
    node.rx(command);
    CHECK(node.objects.error_register == 0);
    node.frames();
  }
}

TEST_CASE("RPDO deadline: an RPDO that is switched off is not reported") {
  PdoNode node(watched(100));
  node.start();
  node.rx("201#01");
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  node.after(1000ms);
  node.silent();
  CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
  node.after(1000ms);
  node.silent();
}

#if USE_LED

// The callback is COLedChange(): the error LED is switched off when the RPDO is received again.
TEST_CASE("RPDO deadline: a callback at the next frame may end the PDO, after that frame") {
  const std::function<void(PdoNode&)> ends[] = {
      [](PdoNode& node) { (void)CODictWrLong(&node->Dict, CO_DEV(0x1400, 1), 0x80000201); },
      [](PdoNode& node) { CONmtSetMode(&node->Nmt, CO_PREOP); },
      [](PdoNode& node) { CONodeStop(&node.node); },
  };
  for (const auto& end : ends) {
    for (const std::uint8_t type : {std::uint8_t{255}, std::uint8_t{1}}) {
      if (type == 1 && USE_SYNC == 0) {
        continue;
      }
      SyncTable table;
      table.rpdo[0].on(0x201, type, {0x22010108}).event = 100;
      SyncNode node(table);
      node.may_change(0x1400, 1);
      node.start();
      std::uint8_t lit = 0;
      callbacks().led_change = [&](CO_NODE*, std::uint8_t leds) { lit = leds; };
      node.call([&] { COLedStart(&node.node); });
      node.rx("201#01");
      node.rx("080#");
      node.after(100ms);
      node.tx(emcy(0x8250, 1));
      for (unsigned ms = 0; ms < 2000 && (lit & CO_LED_ERR) == 0; ++ms) {
        node.after(1ms);
      }
      unsigned ended = 0;
      unsigned received = 0;
      callbacks().led_change = [&](CO_NODE*, std::uint8_t) {
        if (ended++ == 0) {
          end(node);
        }
      };
      callbacks().pdo_receive = [&](CO_IF_FRM*) { return ++received, std::int16_t{0}; };
      callbacks().pdo_update = [&](CO_RPDO*) { ++received; };
      node.rx("201#02");
      CHECK(ended > 0);
      node.frames();
      node.rx("080#");
      callbacks() = Callbacks{};
      CHECK(received == (type == 1 ? 1 : 2));
      CHECK(node.u8[0] == (type == 1 ? 1 : 2));
      node.after(1000ms);
      node.silent();
    }
  }
}

#endif

TEST_CASE("RPDO deadline: the longest and the shortest time are kept") {
  for (const std::uint16_t ms : {std::uint16_t{1}, std::uint16_t{65535}}) {
    PdoNode node(watched(ms));
    node.start();
    node.rx("201#01");
    node.after(std::chrono::milliseconds{ms - 1});
    node.silent();
    node.after(1ms);
    node.tx(emcy(0x8250, 1));
  }
}

TEST_CASE("RPDO deadline: a late main loop reports it once [Q8]") {
  PdoNode node(watched(10));
  node.start();
  node.rx("201#01");
  node.jump(10000ms);
  node.tx(emcy(0x8250, 1));
  node.after(1000ms);
  node.silent();
}

TEST_CASE("RPDO deadline: all PDOs at once are reported with their numbers") {
  PdoTable table;
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    table.rpdo[n].on(0x201 + n * 0x100, 255, {0x22010108}).event = 100;
  }
  PdoNode node(table);
  node.start();
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    node.rx(CO_IF_FRM{0x201 + n * 0x100, {1}, 1});
  }
  node.after(100ms);
  std::vector<std::string> expected;
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    expected.push_back(emcy(0x8250, static_cast<std::uint8_t>(n + 1)));
  }
  CHECK(node.frames() == expected);
}

}  // namespace

#endif
