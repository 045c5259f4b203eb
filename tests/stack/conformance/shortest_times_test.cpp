// SPDX-License-Identifier: Apache-2.0
// Shortest times: 1 ms in objects in milliseconds, and CO_SYNC_PERIOD_MIN in 1006h, written by SDO or loaded from a
// parameter group. [301:7.5.2.6, 7.5.2.11, 7.5.2.17, 7.5.2.19]
#include <algorithm>
#include <string>
#include <vector>

#include "support/failing_nvm.hpp"
#include "support/monitor.hpp"
#include "support/sync_fixture.hpp"

namespace {

using namespace test;

constexpr std::uint32_t rates[] = {1000, 1000000};  // ticks per second

[[maybe_unused]] CO_DATA data(const void* address) { return reinterpret_cast<std::uintptr_t>(address); }

TEST_CASE("shortest times: 1 ms in 1017h is a heartbeat each millisecond; 0 ends it") {
  for (const std::uint32_t rate : rates) {
    Fixture node(Setup().rate(rate));
    node.ask("601#2B17100001000000", "581#6017100000000000");
    node.after(3ms);
    node.tx({"701#7F", "701#7F", "701#7F"});
    node.ask("601#4017100000000000", "581#4B17100001000000");
    node.ask("601#2B17100000000000", "581#6017100000000000");
    node.after(100ms);
    node.silent();
    CHECK(node.error() == CO_ERR_NONE);
  }
}

#if CO_HBCONS_N > 0

TEST_CASE("shortest times: 1 ms in 1016h monitors a node; 0 ends it") {
  for (const std::uint32_t rate : rates) {
    Monitor node({}, Setup().rate(rate));
    CHECK(node.configure(1, 0x00050001) == 0);
    node.rx("705#05");
    node.told("5 OPERATIONAL");
    node.after(1ms);
    node.told("5 missing");
    node.emergency("081#3081110000050000");
    CHECK(node.configure(1, 0x00050000) == 0);
    node.after(100ms);
    node.told("");
    CHECK(node.armed_timers() == 0);
  }
}

#endif

#if USE_GUARDING

TEST_CASE("shortest times: 1 ms in 100Ch and factor 1 is a life time of 1 ms; guard time 0 ends it") {
  for (const std::uint32_t rate : rates) {
    std::uint16_t time = 0;
    std::uint8_t factor = 1;
    Fixture node(Setup()
                     .rate(rate)
                     .with({CO_KEY(0x100C, 0, CO_OBJ_____RW), CO_TUNSIGNED16, data(&time)})
                     .with({CO_KEY(0x100D, 0, CO_OBJ_____RW), CO_TUNSIGNED8, data(&factor)})
                     .may_change(0x100C, 0));
    unsigned lost = 0;
    callbacks().life_guard = [&](CO_NMT*, bool occurred) { lost += occurred ? 1 : 0; };
    node.ask("601#2B0C100001000000", "581#600C100000000000");
    node.rx("701#R1");
    node.tx("701#7F");
    CHECK(lost == 0);
    node.after(1ms);
    CHECK(lost == 1);
    CHECK(node.frames() == reports({"081#3081110000000000"}));
    node.ask("601#2B0C100000000000", "581#600C100000000000");
    node.frames_per_call(2);
    node.rx("701#R1");
    node.frames();
    node.after(100ms);
    CHECK(lost == 1);
  }
}

#endif

#if CO_TPDO_N > 0

TEST_CASE("shortest times: 1 ms in 1800h:5 is a TPDO each millisecond; 0 ends it") {
  for (const std::uint32_t rate : rates) {
    PdoTable table;
    table.tpdo[0].on(0x40000181, 254, {0x22010108});
    PdoNode node(table, [&](Setup& setup) { setup.rate(rate); });
    node.start();
    CHECK(node.set(0x1800, 5, 2, 1) == 0);
    node.after(3ms);
    node.tx({"181#11", "181#11", "181#11"});
    CHECK(node.set(0x1800, 5, 2, 0) == 0);
    node.after(100ms);
    node.silent();
  }
}

#endif

#if CO_RPDO_N > 0

TEST_CASE("shortest times: 1 ms in 1400h:5 is a deadline of 1 ms; 0 ends it") {
  for (const std::uint32_t rate : rates) {
    PdoTable table;
    table.rpdo[0].on(0x201, 255, {0x22010108});
    PdoNode node(table, [&](Setup& setup) { setup.rate(rate); });
    node.start();
    CHECK(node.set(0x1400, 5, 2, 1) == 0);
    node.rx("201#01");
    node.silent();
    node.after(1ms);
    CHECK(node.frames() == reports({emcy(0x8250, 1)}));
    CHECK(node.set(0x1400, 5, 2, 0) == 0);
    node.frames();
    node.rx("201#02");
    node.after(100ms);
    node.silent();
  }
}

#endif

#if USE_PARA && USE_SYNC

// A SYNC producer whose 1006h and 1017h are in a parameter group. The memory outlives each of its nodes.
struct Device {
  struct Values {
    std::uint32_t cycle;
    std::uint16_t heartbeat;
  };

  Setup setup(std::uint32_t cob_id = 0x40000080) {
    sync_id = cob_id;
    return Setup()
        .only_small()
        .rate(1000000)
        .nvm(FailingNvm::driver, &nvm)
        .may_change(0x1006, 0)
        .may_change(0x1017, 0)
        .with({CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, data(&sync_id)})
        .with({CO_KEY(0x1006, 0, CO_OBJ_____RW), CO_TSYNC_CYCLE, data(&values.cycle)})
        .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, data(&group)})
        .with({CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, data(&group)})
        .with({CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, data(&values.heartbeat)});
  }

  // Stores the values without checking them, like firmware without lower limits.
  void store(std::uint32_t cycle, std::uint16_t heartbeat) {
    Fixture node(setup(0x80));
    values = {cycle, heartbeat};
    node.ask("601#2310100173617665", "581#6010100100000000");
    values = {};
  }

  FailingNvm nvm{{1024, 1, 0}};
  std::uint32_t sync_id = 0;
  Values values = {};
  Values defaults = {};
  CO_PARA group = {0, sizeof(Values), &values, &defaults, CO_RESET_COM, nullptr, CO_PARA___E};
};

TEST_CASE("shortest times: a loaded 1006h below CO_SYNC_PERIOD_MIN is not produced and sets the node error") {
  for (const std::uint32_t us : {1U, 2U, 499U}) {
    CAPTURE(us);
    Device device;
    device.store(us, 0);
    Fixture node(device.setup());
    CHECK(node.error() == CO_ERR_OBJ_RANGE_LOW);
    CHECK(device.values.cycle == us);
    node.after(10ms);
    node.silent();
    CHECK(node.armed_timers() == 0);
    node.rx("000#0101");
    node.after(10ms);
    node.silent();
    for (const char* const reset : {"000#8201", "000#8101"}) {
      node.ask("601#2306100010270000", "581#6006100000000000");
      node.after(10ms);
      node.tx("080#");
      node.rx(reset);
      node.tx("701#00");
      CHECK(node.error() == CO_ERR_OBJ_RANGE_LOW);
      CHECK(device.values.cycle == us);
      node.after(100ms);
      node.silent();
    }
  }
}

TEST_CASE("shortest times: loaded values of 1006h and 1017h at their lower bounds are used") {
  static_assert(CO_SYNC_PERIOD_MIN == 500);
  Device device;
  device.store(500, 1);
  Fixture node(device.setup());
  CHECK(node.error() == CO_ERR_NONE);
  node.after(1ms);
  std::vector<std::string> sent = node.frames();
  std::sort(sent.begin(), sent.end());
  CHECK(sent == std::vector<std::string>{"080#", "080#", "701#7F"});
}

TEST_CASE("shortest times: a loaded 1006h of 0, or of a consumer, sets no error") {
  Device device;
  device.store(0, 0);
  Fixture producer(device.setup());
  CHECK(producer.error() == CO_ERR_NONE);
  producer.after(100ms);
  producer.silent();
  Device other;
  other.store(1, 0);
  Fixture consumer(other.setup(0x80));
  CHECK(consumer.error() == CO_ERR_NONE);
  CHECK(other.values.cycle == 1);
  consumer.after(100ms);
  consumer.silent();
}

#endif

}  // namespace
