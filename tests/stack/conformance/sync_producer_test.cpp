// SPDX-License-Identifier: Apache-2.0
// SYNC producer: 1005h bit 30, 1006h, 1019h. [301:7.2.5, 7.5.2.5-6, 7.5.2.22]
#include "support/sync_fixture.hpp"

#if USE_SYNC

namespace {

using namespace test;

SyncTable producer(std::uint32_t cycle_us, std::uint8_t counter = 0) {
  SyncTable table;
  table.sync_id = 0x40000080;
  table.cycle = cycle_us;
  table.counter = counter;
  return table;
}

// Returns the SYNC messages of so many periods of 10 ms, with their counter values.
std::vector<std::string> numbers(SyncNode& node, unsigned syncs) {
  std::vector<std::string> all;
  for (unsigned n = 0; n < syncs; ++n) {
    node.after(10ms);
    for (const std::string& text : node.frames()) all.push_back(text);
  }
  return all;
}

using Texts = std::vector<std::string>;

TEST_CASE("SYNC producer: SYNC is sent each period from the boot-up, except in Stopped [Y4] [Y8] [SYNC 02]") {
  SyncNode node(producer(100000));
  node.after(350ms);
  node.tx_at(100ms, "080#");
  node.tx_at(200ms, "080#");
  node.tx_at(300ms, "080#");
  node.silent();
  node.rx("000#0101");
  node.after(100ms);
  node.tx_at(50ms, "080#");
  node.rx("000#8001");
  node.after(100ms);
  node.tx_at(50ms, "080#");
}

TEST_CASE("SYNC producer: none is sent in Stopped; the first one follows a whole period later [Y8] [State 04]") {
  SyncNode node(producer(10000));
  node.after(25ms);
  CHECK(node.frames().size() == 2);
  node.rx("000#0201");
  CHECK(node.armed_timers() == 0);
  node.after(1000ms);
  node.silent();
  node.rx("000#8001");
  node.after(25ms);
  node.tx_at(10ms, "080#");
  node.tx_at(20ms, "080#");
  node.silent();
}

TEST_CASE("SYNC producer: a queued SYNC is withdrawn by a stop [Y8]") {
  SyncNode node(producer(10000));
  node.can.refuse_all();
  node.after(10ms);
  node.rx("000#0201");
  node.can.accept_all();
  node.loop();
  node.silent();
}

TEST_CASE("SYNC producer: 1006h = 0 or bit 30 = 0 disables it [Y4] [SYNC 04]") {
  SyncNode without_period(producer(0));
  without_period.after(10000ms);
  without_period.silent();
  SyncTable table = producer(10000);
  table.sync_id = 0x80;
  SyncNode consumer(table);
  consumer.after(10000ms);
  consumer.silent();
  CHECK(consumer.armed_timers() == 0);
}

TEST_CASE("SYNC producer: writing 1006h starts, changes and stops it at once [Y4] [D49]") {
  SyncNode node(producer(0));
  CHECK(node.set(0x1006, 0, 4, 50000) == 0);
  node.after(120ms);
  node.tx_at(50ms, "080#");
  node.tx_at(100ms, "080#");
  CHECK(node.set(0x1006, 0, 4, 20000) == 0);
  node.after(50ms);
  node.tx_at(20ms, "080#");
  node.tx_at(40ms, "080#");
  CHECK(node.set(0x1006, 0, 4, 0) == 0);
  node.after(10000ms);
  node.silent();
  CHECK(node.set(0x1006, 0, 4, 0) == 0);
  CHECK(node.set(0x1006, 0, 4, 30000) == 0);
  node.after(30ms);
  node.tx("080#");
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("SYNC producer: bit 30 starts and stops it at once [Y1] [D21]") {
  SyncTable table = producer(10000);
  table.sync_id = 0x80;
  SyncNode node(table);
  CHECK(node.set(0x1005, 0, 4, 0x40000080) == 0);
  node.after(20ms);
  node.tx({"080#", "080#"});
  CHECK(node.get(0x1005, 0) == 0x40000080);
  CHECK(node.set(0x1005, 0, 4, 0x80) == 0);
  node.after(1000ms);
  node.silent();
}

TEST_CASE("SYNC producer: writing the present value to 1005h does not change the period") {
  SyncNode node(producer(10000));
  node.after(7ms);
  CHECK(node.set(0x1005, 0, 4, 0x40000080) == 0);
  node.after(3ms);
  node.tx("080#");
}

TEST_CASE("SYNC producer: it continues after both resets [D21] [SYNC 08]") {
  for (const char* command : {"000#8101", "000#8201"}) {
    SyncNode node(producer(10000, 5));
    CHECK(numbers(node, 3) == Texts{"080#01", "080#02", "080#03"});
    node.rx(command);
    node.tx("701#00");
    CHECK(numbers(node, 7) == Texts{"080#01", "080#02", "080#03", "080#04", "080#05", "080#01", "080#02"});
  }
}

TEST_CASE("SYNC producer: 1019h = n counts from 1 to n; 0 means a SYNC without data [Y5] [SYNC 06] [SYNC 07]") {
  SyncNode node(producer(0));
  CHECK(node.set(0x1019, 0, 1, 5) == 0);
  CHECK(node.set(0x1006, 0, 4, 10000) == 0);
  CHECK(numbers(node, 7) == Texts{"080#01", "080#02", "080#03", "080#04", "080#05", "080#01", "080#02"});
  CHECK(node.set(0x1006, 0, 4, 0) == 0);
  CHECK(node.set(0x1019, 0, 1, 0) == 0);
  CHECK(node.set(0x1006, 0, 4, 10000) == 0);
  CHECK(numbers(node, 2) == Texts{"080#", "080#"});
}

TEST_CASE("SYNC producer: after a write to 1019h the counter starts at 1 [Y5] [N6]") {
  SyncNode node(producer(10000, 10));
  CHECK(numbers(node, 3) == Texts{"080#01", "080#02", "080#03"});
  CHECK(node.set(0x1006, 0, 4, 0) == 0);
  CHECK(node.set(0x1019, 0, 1, 20) == 0);
  CHECK(node.set(0x1006, 0, 4, 10000) == 0);
  CHECK(numbers(node, 2) == Texts{"080#01", "080#02"});
}

TEST_CASE("SYNC producer: the lowest and the highest overflow value are 2 and 240 [Y5]") {
  for (const std::uint8_t overflow : std::initializer_list<std::uint8_t>{2, 240}) {
    SyncNode node(producer(10000, overflow));
    const Texts all = numbers(node, 2U * overflow);
    REQUIRE(all.size() == 2U * overflow);
    for (unsigned n = 0; n < all.size(); ++n) {
      CHECK(all[n] == notation(CO_IF_FRM{0x80, {static_cast<std::uint8_t>(n % overflow + 1)}, 1}));
    }
  }
}

TEST_CASE("SYNC producer: the counter restarts at 1 after Stopped and continues through Pre-operational [Y6]") {
  SyncNode node(producer(10000, 10));
  CHECK(numbers(node, 2) == Texts{"080#01", "080#02"});
  node.rx("000#0101");
  CHECK(numbers(node, 1) == Texts{"080#03"});
  node.rx("000#8001");
  CHECK(numbers(node, 1) == Texts{"080#04"});
  for (const char* command : {"000#8001", "000#0101"}) {
    node.rx("000#0201");
    node.rx(command);
    CHECK(numbers(node, 2) == Texts{"080#01", "080#02"});
  }
}

TEST_CASE("SYNC producer: periods from the shortest to the longest work; the timer rounds up [Y4]") {
  SyncNode node(producer(0));
  CHECK(node.set(0x1006, 0, 4, CO_SYNC_PERIOD_MIN) == 0);
  node.after(3ms);
  CHECK(node.frames().size() == 3);
  CHECK(node.set(0x1006, 0, 4, 0xFFFFFFFF) == 0);
  node.after(4294967ms);
  node.silent();
  node.after(1ms);
  node.tx("080#");
}

TEST_CASE("SYNC producer: a period below CO_SYNC_PERIOD_MIN is refused: 0609 0032h; 0 stops it [Y4]") {
  static_assert(CO_SYNC_PERIOD_MIN == 500);
  SyncNode node(producer(10000));
  for (const std::uint32_t us : {1U, 2U, 100U, 499U}) {
    CAPTURE(us);
    CHECK(node.set(0x1006, 0, 4, us) == 0x06090032);
    CHECK(node.get(0x1006, 0) == 10000);
    node.call([&] { CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1006, 0), us) == CO_ERR_OBJ_RANGE_LOW); });
  }
  node.after(20ms);
  CHECK(node.frames() == Texts{"080#", "080#"});
  node.ask("601#2306100000000000", "581#6006100000000000");
  node.after(100ms);
  node.silent();
  node.ask("601#23061000F4010000", "581#6006100000000000");
  node.after(2ms);
  CHECK(node.frames().size() == 2);
  CHECK(node.set(0x1007, 0, 4, 1) == 0);  // the synchronous window does not depend on the period
}

TEST_CASE("SYNC producer: a table or stored value below CO_SYNC_PERIOD_MIN produces no SYNC [Y4]") {
  SyncNode node(producer(499));
  CHECK(node.error() == CO_ERR_OBJ_RANGE_LOW);
  CHECK(node.mode() == CO_PREOP);
  node.rx("000#0101");
  node.after(100ms);
  node.silent();
  CHECK(node.get(0x1006, 0) == 499);
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(node.error() == CO_ERR_OBJ_RANGE_LOW);
  CHECK(node.set(0x1006, 0, 4, 500) == 0);
  node.after(2ms);
  CHECK(node.frames().size() == 2);
}

TEST_CASE("SYNC producer: a consumer accepts any period in 1006h") {
  SyncTable table = producer(1);
  table.sync_id = 0x80;
  SyncNode node(table);
  CHECK(node.error() == CO_ERR_NONE);
  CHECK(node.set(0x1005, 0, 4, 0x40000080) == 0);
  node.after(100ms);
  node.silent();
}

TEST_CASE("SYNC producer: no drift in 10^5 periods [T15] [Q8]") {
  SyncNode node(producer(10000), [](Setup& setup) { setup.clock(0xFFFFFF00U); });
  const std::uint64_t begin = node.now();
  for (unsigned second = 1; second <= 1000 / stride(50); ++second) {
    node.after(1000ms);
    REQUIRE(node.can.sent.size() == 100);
    CHECK(node.can.sent.back().tick == begin + 1000U * second);
    node.frames();
  }
}

TEST_CASE("SYNC producer: a late main loop sends one SYNC and keeps the phase [Q8]") {
  SyncNode node(producer(10000));
  node.jump(1003ms);
  node.tx("080#");
  node.after(10ms);
  node.tx_at(7ms, "080#");
}

TEST_CASE("SYNC producer: bits 0 to 29 cannot be changed while bit 30 is set: 0609 0030h [Y1]") {
  SyncNode node(producer(0));
  for (unsigned bit = 0; bit < 30; ++bit) {
    CAPTURE(bit);
    CHECK(node.set(0x1005, 0, 4, 0x40000080U ^ 1U << bit) == 0x06090030);
    CHECK(node.set(0x1005, 0, 4, 0x80U ^ 1U << bit) == 0x06090030);
  }
  CHECK(node.get(0x1005, 0) == 0x40000080);
  CHECK(node.set(0x1005, 0, 4, 0x40000080) == 0);
  CHECK(node.set(0x1005, 0, 4, 0x80) == 0);
  CHECK(node.set(0x1005, 0, 4, 0x40000090) == 0);
}

#if CO_TPDO_N > 0 && CO_RPDO_N > 0

TEST_CASE("SYNC producer: it processes its own SYNC, which is sent before its PDOs [Y9]") {
  SyncTable table = producer(100000);
  table.tpdo[0].on(0x40000181, 1, {0x22010108});
  table.rpdo[0].on(0x201, 1, {0x22010108});
  SyncNode node(table);
  node.start();
  node.rx("201#42");
  node.after(100ms);
  node.tx({"080#", "181#11"});
  CHECK(node.u8[0] == 0x42);
  node.after(100ms);
  node.tx({"080#", "181#42"});
}

TEST_CASE("SYNC producer: its own PDOs use the counter of its SYNC [Y9] [X14]") {
  SyncTable table = producer(10000, 4);
  table.tpdo[0].on(0x40000181, 2, {0x22010108}).start = 3;
  SyncNode node(table);
  node.start();
  CHECK(numbers(node, 8) == Texts{"080#01", "080#02", "080#03", "080#04", "181#11", "080#01", "080#02", "181#11",
                                  "080#03", "080#04", "181#11"});
}

TEST_CASE("SYNC producer: a SYNC of another producer is ignored and counted as malformed without a report [Y10]") {
  SyncTable table = producer(100000);
  table.tpdo[0].on(0x40000181, 1, {0x22010108});
  table.rpdo[0].on(0x201, 1, {0x22010108});
  SyncNode node(table);
  node.start();
  node.rx("201#42");
  node.rx("080#");
  node.rx("080#01");
  node.silent();
  CHECK(node.u8[0] == 0x11);
  CHECK(node.counters().Malformed == 2);
  CHECK(node.counters().Unclaimed == 0);
  CHECK(node.objects.error_register == 0);
}

TEST_CASE("SYNC producer: the window starts with the produced SYNC [X4] [Y9]") {
  SyncTable table = producer(100000);
  table.window = 10000;
  table.rpdo[0].on(0x201, 1, {0x22010108});
  SyncNode node(table);
  node.start();
  node.after(105ms);
  node.tx("080#");
  node.rx("201#42");
  node.after(10ms);
  node.rx("201#43");
  node.after(100ms);
  node.tx("080#");
  CHECK(node.u8[0] == 0x42);
}

#endif

TEST_CASE("SYNC producer: a 29-bit CAN-ID works") {
  SyncTable table = producer(10000);
  table.sync_id = 0x60000000U | 0x12345678U;
  SyncNode node(table);
  node.after(10ms);
  node.tx("12345678#");
}

TEST_CASE("SYNC producer: 1006h of a basic type takes effect with the next reset") {
  std::uint32_t period = 0;
  SyncNode node(producer(0), [&](Setup& setup) {
    setup.with({CO_KEY(0x1006, 0, CO_OBJ_____RW), CO_TUNSIGNED32, CO_DATA(&period)});
  });
  CHECK(node.set(0x1006, 0, 4, 10000) == 0);
  node.after(100ms);
  node.silent();
  node.rx("000#8201");
  node.tx("701#00");
  node.after(10ms);
  node.tx("080#");
}

}  // namespace

#endif
