// SPDX-License-Identifier: Apache-2.0
// Status LEDs. [CiA 303-3] Patterns are samples of 50 ms: '#' is on, '.' is off.
#include "base/events.hpp"
#include "support/fixture.hpp"

#if USE_LED

namespace {

using namespace test;

constexpr std::size_t five_seconds = 100;  // samples

// Returns the samples of 5 s of a pattern with this period.
std::string over_five_seconds(const std::string& period) {
  std::string all;
  while (all.size() < five_seconds) all += period;
  return all.substr(0, five_seconds);
}

struct Shown {
  std::string run;
  std::string err;
  bool operator==(const Shown& other) const { return run == other.run && err == other.err; }
};

std::ostream& operator<<(std::ostream& out, const Shown& shown) {
  return out << "RUN " << shown.run << " ERR " << shown.err;
}

void add(Shown& shown, std::uint8_t leds) {
  shown.run += (leds & 0x01U) != 0 ? '#' : '.';
  shown.err += (leds & 0x02U) != 0 ? '#' : '.';
}

Shown patterns(const CO_LED_STATE& state, std::uint32_t from = 0) {
  Shown shown;
  for (std::uint32_t n = 0; n < five_seconds; ++n) add(shown, COLedPattern(&state, from + n * 50));
  return shown;
}

const std::string off = over_five_seconds(".");
const std::string on = over_five_seconds("#");
const std::string blinking = over_five_seconds("####....");
const std::string flickering = over_five_seconds("#.");
const std::string single_flash = over_five_seconds("####....................");
const std::string double_flash = over_five_seconds("####....####....................");
const std::string triple_flash = over_five_seconds("####....####....####....................");
// Patterns of the red LED, which starts one phase after the green one.
const std::string red_blinking = over_five_seconds("....####");
const std::string red_flickering = over_five_seconds(".#");
const std::string red_single = over_five_seconds("....####................");
const std::string red_double = over_five_seconds("....####....####................");
const std::string red_triple = over_five_seconds("....####....####....####................");
const std::string red_quadruple = over_five_seconds("....####....####....####....####................");

TEST_CASE("LED: RUN shows the NMT state [LED1] [LED2]") {
  CHECK(patterns({CO_INVALID, 0}) == Shown{off, off});
  CHECK(patterns({CO_INIT, 0}) == Shown{off, off});
  CHECK(patterns({CO_PREOP, 0}) == Shown{blinking, off});
  CHECK(patterns({CO_OPERATIONAL, 0}) == Shown{on, off});
  CHECK(patterns({CO_STOP, 0}) == Shown{single_flash, off});
}

TEST_CASE("LED: RUN shows a program download in every state, and LSS before it [LED1] [LED2]") {
  for (const CO_MODE mode : {CO_INIT, CO_PREOP, CO_OPERATIONAL, CO_STOP}) {
    CHECK(patterns({mode, CO_LED_DOWNLOAD}) == Shown{triple_flash, off});
    CHECK(patterns({mode, CO_LED_LSS}) == Shown{flickering, red_flickering});
    CHECK(patterns({mode, CO_LED_LSS | CO_LED_DOWNLOAD}) == Shown{flickering, red_flickering});
  }
}

TEST_CASE("LED: ERR has a pattern for each error [LED1] [LED3]") {
  CHECK(patterns({CO_OPERATIONAL, CO_LED_BUS_OFF}) == Shown{on, on});
  CHECK(patterns({CO_OPERATIONAL, CO_LED_PDO}) == Shown{on, red_quadruple});
  CHECK(patterns({CO_OPERATIONAL, CO_LED_SYNC}) == Shown{on, red_triple});
  CHECK(patterns({CO_OPERATIONAL, CO_LED_CONTROL}) == Shown{on, red_double});
  CHECK(patterns({CO_OPERATIONAL, CO_LED_WARNING}) == Shown{on, red_single});
  CHECK(patterns({CO_OPERATIONAL, CO_LED_CONFIG}) == Shown{on, red_blinking});
}

TEST_CASE("LED: the most serious of several errors is shown in every combination [LED3]") {
  const std::pair<unsigned, std::string> by_priority[] = {
      {CO_LED_BUS_OFF, on},          {CO_LED_LSS, red_flickering}, {CO_LED_PDO, red_quadruple},
      {CO_LED_SYNC, red_triple},     {CO_LED_CONTROL, red_double}, {CO_LED_WARNING, red_single},
      {CO_LED_CONFIG, red_blinking},
  };
  for (unsigned what = 0; what <= 0xFF; ++what) {
    std::string expected = off;
    for (const auto& [bit, pattern] : by_priority) {
      if ((what & bit) != 0) {
        expected = pattern;
        break;
      }
    }
    CAPTURE(what);
    CHECK(patterns({CO_OPERATIONAL, static_cast<std::uint8_t>(what)}).err == expected);
  }
}

TEST_CASE("LED: red and green are never on together, except where one of them is steady [LED1]") {
  for (const CO_MODE mode : {CO_INIT, CO_PREOP, CO_OPERATIONAL, CO_STOP}) {
    for (unsigned what = 0; what <= 0xFF; what += stride(13)) {
      const CO_LED_STATE state{mode, static_cast<std::uint8_t>(what)};
      bool together = false;
      for (std::uint32_t ms = 0; ms < 30000; ms += 10) together |= COLedPattern(&state, ms) == 0x03;
      const bool green_is_steady = mode == CO_OPERATIONAL && (what & (CO_LED_LSS | CO_LED_DOWNLOAD)) == 0;
      const bool red_is_dark = (what & 0x7F) == 0;
      const bool red_is_steady = (what & CO_LED_BUS_OFF) != 0;
      const bool green_is_dark = mode == CO_INIT && (what & (CO_LED_LSS | CO_LED_DOWNLOAD)) == 0;
      CAPTURE(what);
      CHECK(together == ((green_is_steady && !red_is_dark) || (red_is_steady && !green_is_dark)));
    }
  }
}

TEST_CASE("LED: each pattern is defined at any time and has only the states on and off [LED1]") {
  CHECK(patterns({CO_PREOP, CO_LED_CONTROL}, 24000) == Shown{blinking, red_double});
  CHECK(patterns({CO_STOP, CO_LED_PDO}, 4294944000) == Shown{single_flash, red_quadruple});
  const CO_LED_STATE state{CO_PREOP, 0};
  CHECK(COLedPattern(&state, 199) == 1);
  CHECK(COLedPattern(&state, 200) == 0);
  CHECK(COLedPattern(&state, 399) == 0);
  CHECK(COLedPattern(&state, 400) == 1);
  CHECK(COLedPattern(nullptr, 0) == 0);
  const CO_LED_STATE wrong{CO_MODE_NUM, 0};
  CHECK(COLedPattern(&wrong, 0) == 0);
}

// --- In the node

struct LedNode : Fixture {
  std::uint8_t leds = 0;
  unsigned changes = 0;
  std::uint64_t started = 0;
  explicit LedNode(const Setup& setup = Setup()) : Fixture(Setup(setup).only_small()) {
    callbacks().led_change = [this](CO_NODE* of, std::uint8_t now) {
      CHECK(of == &node);
      leds = now;
      ++changes;
    };
  }
  void start() {
    started = now();
    call([&] { COLedStart(&node); });
  }
  void set(std::uint8_t what, bool is) {
    call([&] { COLedSet(&node, what, is); });
  }
  void report(CO_CAN_EVENT what) {
    call([&] { CONodeCanEvent(&node, what); });
    trace();
  }
  void raise_fault(co::event::Fault fault) {
    call([&] { co::event::raise(node, fault, 0); });
    trace();
  }
  void resolve_fault(co::event::Fault fault) {
    call([&] { co::event::resolve(node, fault, 0); });
    trace();
  }
  Shown watch() {
    Shown shown;
    for (std::size_t n = 0; n < five_seconds; ++n) {
      after(10ms);
      add(shown, leds);
      after(40ms);
    }
    trace();
    return shown;
  }
  /// Returns the pattern of the ERR LED from the beginning of a period.
  std::string err() {
    after(24s - std::chrono::milliseconds{(now() - started) % 24000});
    return watch().err;
  }
};

TEST_CASE("LED: each state of the node is shown from the moment when it is entered") {
  LedNode node;
  node.start();
  CHECK(node.changes == 1);
  CHECK(node.watch() == Shown{blinking, off});
  node.rx("000#0101");
  CHECK(node.watch() == Shown{on, off});
  CHECK(node.armed_timers() == 0);
  node.after(70ms);
  node.rx("000#0201");
  CHECK(node.watch() == Shown{single_flash, off});
  node.rx("000#0101");
  CHECK(node.leds == 0x01);
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.leds == 0);
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("LED: the callback is called for changes only") {
  LedNode node;
  node.rx("000#0101");
  node.start();
  CHECK(node.changes == 1);
  CHECK(node.leds == 0x01);
  node.start();
  node.after(10s);
  node.set(CO_LED_DOWNLOAD, false);
  CHECK(node.changes == 1);
  node.rx("000#8001");
  CHECK(node.changes == 1);
  node.after(999ms);
  CHECK(node.changes == 5);  // at 200, 400, 600 and 800 ms
}

TEST_CASE("LED: nothing is shown and no timer runs before COLedStart() and after CONodeStop()") {
  LedNode node;
  CHECK(node.armed_timers() == 0);
  node.report(CO_CAN_BUS_OFF);
  node.set(CO_LED_LSS, true);
  node.after(5s);
  CHECK(node.changes == 0);
  node.start();
  CHECK(node.changes == 1);
  node.call([&] { CONodeStop(&node.node); });
  const unsigned changes = node.changes;
  node.start();
  node.set(CO_LED_CONFIG, true);
  CHECK(node.changes == changes);
  CHECK(node.armed_timers() == 0);
  const unsigned fatal = callbacks().fatal_errors;
  COLedStart(nullptr);
  COLedSet(nullptr, CO_LED_LSS, true);
  CHECK(callbacks().fatal_errors == fatal + 2);
}

#if USE_LSS
TEST_CASE("LED: both flicker in the LSS state configuration and while an unconfigured node has no node-ID") {
  const auto slave = [] {
    Setup setup;
    setup.with({CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 4});
    for (std::uint8_t sub = 1; sub <= 4; ++sub) setup.with({CO_KEY(0x1018, sub, CO_OBJ_D___R_), CO_TUNSIGNED32, sub});
    return setup;
  };
  LedNode node(slave());
  node.start();
  node.rx("7E5#0401000000000000");
  CHECK(node.watch() == Shown{flickering, red_flickering});
  node.rx("7E5#0400000000000000");
  CHECK(node.watch().err == off);
  node.rx("7E5#0401000000000000");
  node.rx("000#8201");
  CHECK(node.watch().err == off);

  LedNode nameless(slave().node_id(255));
  nameless.start();
  CHECK(nameless.watch() == Shown{flickering, red_flickering});
  nameless.rx("7E5#0401000000000000");
  nameless.ask("7E5#1105000000000000", "7E4#1100000000000000");
  nameless.ask("7E5#0400000000000000", "705#00");
  CHECK(nameless.watch().err == off);
}
#endif

TEST_CASE("LED: started in Initialisation, both are off until the boot-up") {
  LedNode node(Setup().stay_in_init());
  node.start();
  CHECK(node.changes == 1);
  CHECK(node.leds == 0);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  CHECK(node.leds == 0x01);
}

TEST_CASE("LED: error passive, bus-off and recovery of the CAN controller are shown [LED3]") {
  LedNode node;
  node.start();
  node.report(CO_CAN_OVERRUN);
  CHECK(node.err() == off);
  node.report(CO_CAN_PASSIVE);
  CHECK(node.err() == red_single);
  node.report(CO_CAN_BUS_OFF);
  CHECK(node.err() == on);
  node.report(CO_CAN_PASSIVE);
  CHECK(node.err() == on);
  node.report(CO_CAN_RECOVERED);
  CHECK(node.err() == off);
}

TEST_CASE("LED: error control, SYNC and late RPDO errors are each shown until the last one is resolved [LED3]") {
  using co::event::Fault;
  LedNode node;
  node.start();
  node.raise_fault(Fault::heartbeat);
  CHECK(node.err() == red_double);
  node.raise_fault(Fault::heartbeat);
  node.resolve_fault(Fault::heartbeat);
  CHECK(node.err() == red_double);
  node.raise_fault(Fault::sync_length);
  CHECK(node.err() == red_triple);
  node.raise_fault(Fault::pdo_timeout);
  CHECK(node.err() == red_quadruple);
  node.resolve_fault(Fault::pdo_timeout);
  node.resolve_fault(Fault::sync_length);
  CHECK(node.err() == red_double);
  node.resolve_fault(Fault::heartbeat);
  CHECK(node.err() == off);
  node.raise_fault(Fault::life_guard);
  CHECK(node.err() == red_double);
  node.call([&] { co::event::forget(node.node, Fault::life_guard); });
  node.trace();
  CHECK(node.err() == off);
}

#if CO_RPDO_N > 0 && USE_SYNC
CO_OBJ entry(std::uint16_t index, std::uint8_t sub, const CO_OBJ_TYPE* type, std::uint32_t value) {
  return {CO_KEY(index, sub, CO_OBJ_D___R_), type, value};
}

TEST_CASE("LED: a late RPDO is shown until the next one is received [LED3]") {
  LedNode node(Setup()
                   .with(entry(0x1400, 0, CO_TUNSIGNED8, 5))
                   .with(entry(0x1400, 1, CO_TPDO_ID, 0x201))
                   .with(entry(0x1400, 2, CO_TPDO_TYPE, 255))
                   .with(entry(0x1400, 5, CO_TPDO_EVENT, 1000))
                   .with(entry(0x1600, 0, CO_TPDO_NUM, 1))
                   .with(entry(0x1600, 1, CO_TPDO_MAP, CO_LINK(0x2001, 0, 8))));
  node.may_change(0x2001, 0);
  node.rx("000#0101");
  node.start();
  node.rx("201#55");
  node.after(999ms);
  CHECK(node.changes == 1);
  node.after(1ms);
  node.trace();
  CHECK(node.watch() == Shown{on, red_quadruple});
  node.rx("201#55");
  node.trace();
  const unsigned changes = node.changes;
  CHECK(node.leds == 0x01);
  node.after(999ms);
  CHECK(node.changes == changes);
}

TEST_CASE("LED: a SYNC of a wrong length is shown until one of the right length is received [LED3]") {
  LedNode node(Setup().with(entry(0x1005, 0, CO_TSYNC_ID, 0x80)));
  node.rx("000#0101");
  node.start();
  node.rx("080#01");
  node.trace();
  CHECK(node.watch() == Shown{on, red_triple});
  node.rx("080#");
  node.trace();
  CHECK(node.watch() == Shown{on, off});
}
#endif

TEST_CASE("LED: an error in Operational is shown, and its pattern is kept for a minute [LED3]") {
  LedNode node;
  node.rx("000#0101");
  node.start();
  node.raise_fault(co::event::Fault::heartbeat);
  std::string all;
  std::string expected;
  for (int i = 0; i < 16; ++i) {  // 80 s are 50 periods
    const Shown shown = node.watch();
    CHECK(shown.run == on);
    all += shown.err;
  }
  while (expected.size() < all.size()) expected += "....####....####................";
  CHECK(all == expected);
}

TEST_CASE("LED: faults without a pattern and faults that were never raised change nothing") {
  using co::event::Fault;
  LedNode node;
  node.start();
  for (const Fault fault : {Fault::recovered, Fault::collision, Fault::pdo_short, Fault::pdo_long}) {
    node.raise_fault(fault);
    CHECK(node.err() == off);
    node.resolve_fault(fault);
  }
  node.resolve_fault(Fault::heartbeat);
  node.raise_fault(Fault::heartbeat);
  CHECK(node.err() == red_double);
}

TEST_CASE("LED: states set by the application survive resets; states detected by the node end with them") {
  LedNode node;
  node.start();
  node.set(CO_LED_CONFIG, true);
  node.report(CO_CAN_BUS_OFF);
  node.raise_fault(co::event::Fault::heartbeat);
  CHECK(node.err() == on);
  node.rx("000#8201");
  node.started = node.now();
  node.trace();
  CHECK(node.err() == red_blinking);
  node.set(CO_LED_CONFIG, false);
  CHECK(node.err() == off);
}

TEST_CASE("LED: LSS and a program download, set by the application [LED2]") {
  LedNode node;
  node.rx("000#0101");
  node.start();
  node.set(CO_LED_DOWNLOAD, true);
  CHECK(node.watch() == Shown{triple_flash, off});
  node.set(CO_LED_LSS, true);
  CHECK(node.watch() == Shown{flickering, red_flickering});
  node.set(CO_LED_LSS | CO_LED_DOWNLOAD, false);
  CHECK(node.watch() == Shown{on, off});
}

TEST_CASE("LED: the patterns do not depend on frequency and start of the clock [T15]") {
  for (const std::uint32_t rate : {1000U, 300U, 1000000U}) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      LedNode node(Setup().rate(rate).clock(start));
      node.start();
      CHECK(node.watch() == Shown{blinking, off});
    }
  }
}

TEST_CASE("LED: after a late main loop the pattern continues in phase") {
  LedNode node;
  node.start();
  node.jump(10s);
  CHECK(node.changes == 1);
  node.after(150ms);
  CHECK(node.leds == 0);
}

TEST_CASE("LED: the callback may change the shown states and stop the node") {
  LedNode node;
  callbacks().led_change = [&](CO_NODE* of, std::uint8_t leds) {
    ++node.changes;
    if (leds == 0x01) {
      COLedSet(of, CO_LED_BUS_OFF, true);
    } else if (leds == 0x03) {
      CONodeStop(of);
    }
  };
  node.start();
  CHECK(node.changes == 3);
  CHECK(node.mode() == CO_INVALID);
  CHECK(node.armed_timers() == 0);
}

}  // namespace

#endif
