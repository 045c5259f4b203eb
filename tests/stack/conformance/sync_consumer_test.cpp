// SPDX-License-Identifier: Apache-2.0
// SYNC consumer: 1005h, 1007h, 1019h. [301:7.2.5, 7.5.2.5-7, 7.5.2.22]
#include "support/sync_fixture.hpp"

#if USE_SYNC && CO_TPDO_N > 1

namespace {

using namespace test;

SyncTable with_counter(std::uint8_t counter = 0) {
  SyncTable table;
  table.tpdo[0].on(0x40000181, 1, {0x22010108});
  table.tpdo[1].on(0x40000281, 1, {0x22010208}).start = 1;
  table.counter = counter;
  return table;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST_CASE("SYNC consumer: 1005h is read as 80h [SYNC 01]") {
  SyncNode node;
  node.ask("601#4005100000000000", "581#4305100080000000");
}

TEST_CASE(
    "SYNC consumer: SYNC is counted as claimed in Operational and Pre-operational, as unclaimed in Stopped [N3]") {
  SyncNode node(with_counter());
  node.rx("080#");
  CHECK(node.counters().Unclaimed == 0);
  node.start();
  node.rx("080#");
  node.tx({"181#11", "281#21"});
  CHECK(node.counters().Unclaimed == 0);
  CHECK(node.counters().Malformed == 0);
  node.rx("000#0201");
  node.rx("080#");
  node.silent();
  CHECK(node.counters().Unclaimed == 1);
}

TEST_CASE("SYNC consumer: a new CAN-ID takes effect at once, and the old one is no longer SYNC [Y1]") {
  SyncNode node(with_counter());
  node.start();
  CHECK(node.set(0x1005, 0, 4, 0x90) == 0);
  node.rx("080#");
  node.silent();
  node.rx("090#");
  node.tx({"181#11", "281#21"});
  CHECK(node.set(0x1005, 0, 4, 0x20000080) == 0);
  node.rx("080#");
  node.rx("090#");
  node.silent();
  node.rx("00000080#");
  node.tx({"181#11", "281#21"});
}

TEST_CASE("SYNC consumer: without 1005h no SYNC is received") {
  SyncNode node(with_counter(), [](Setup& setup) {
    for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x1005, 0x1006, 0x1007, 0x1019})
      setup.without(index, 0);
  });
  node.start();
  node.rx("080#");
  node.silent();
  CHECK(node.counters().Unclaimed == 1);
}

TEST_CASE("SYNC consumer: 1006h, 1007h and 1019h are not needed") {
  SyncNode node(with_counter(), [](Setup& setup) {
    for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x1006, 0x1007, 0x1019})
      setup.without(index, 0);
  });
  node.start();
  node.rx("080#");
  node.tx({"181#11", "281#21"});
}

TEST_CASE("SYNC consumer: a length that differs from 1019h is reported with 8240h; PDOs run without a counter [Y7]") {
  for (std::uint8_t dlc = 1; dlc <= 8; ++dlc) {
    CAPTURE(unsigned{dlc});
    SyncNode node(with_counter());
    node.start();
    node.rx(CO_IF_FRM{0x80, {5}, dlc});
    CHECK(node.frames() == joined({"181#11", "281#21"}, reports({emcy(0x8240)})));
    CHECK(node.counters().Malformed == 1);
  }
}

TEST_CASE("SYNC consumer: with a counter a SYNC of another length sends only PDOs without start value [Y7]") {
  for (std::uint8_t dlc = 0; dlc <= 8; ++dlc) {
    CAPTURE(unsigned{dlc});
    SyncNode node(with_counter(10));
    node.start();
    node.rx(CO_IF_FRM{0x80, {1}, dlc});
    const std::vector<std::string> sent = node.frames();
    if (dlc == 1) {
      CHECK(sent == std::vector<std::string>{"181#11", "281#21"});
    } else {
      CHECK(sent == joined({"181#11"}, reports({emcy(0x8240)})));
    }
  }
}

TEST_CASE("SYNC consumer: 8240h is reported once and resolved by a SYNC of the right length [Y7] [N2]") {
  SyncNode node(with_counter());
  for (int round = 0; round < 3; ++round) {
    node.rx("080#01");
    CHECK(node.frames() == reports({emcy(0x8240)}));
    node.rx("080#02");
    node.silent();
    CHECK(node.objects.error_register == (USE_EMCY != 0 ? 0x11 : 0));
    node.rx("080#");
    CHECK(node.frames() == reports({emcy(0)}));
    CHECK(node.objects.error_register == 0);
    node.rx("080#");
    node.silent();
  }
}

TEST_CASE("SYNC consumer: a reset clears a wrong length") {
  SyncNode node(with_counter());
  node.rx("080#01");
  node.frames();
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(node.objects.error_register == 0);
  node.rx("080#01");
  CHECK(node.frames() == reports({emcy(0x8240)}));
}

TEST_CASE("SYNC consumer: remote frames are not SYNC") {
  SyncNode node(with_counter());
  node.start();
  node.rx("080#R");
  node.silent();
  CHECK(node.counters().Malformed == 1);
}

TEST_CASE("SYNC consumer: 1019h accepts 0 and 2 to 240; others are refused with 0609 0030h [Y5] [SYNC 05]") {
  SyncNode node;
  for (unsigned value = 0; value <= 255; ++value) {
    CAPTURE(value);
    const bool legal = value == 0 || (value >= 2 && value <= 240);
    CHECK(node.set(0x1019, 0, 1, value) == (legal ? 0U : 0x06090030U));
    CHECK(node.get(0x1019, 0) == (legal ? value : value == 1 ? 0 : 240));
  }
}

TEST_CASE("SYNC consumer: 1019h cannot be changed while 1006h is not 0: 0800 0022h [Y5] [SYNC 09]") {
  SyncTable table;
  table.cycle = 100000;
  table.counter = 10;
  SyncNode node(table);
  CHECK(node.set(0x1019, 0, 1, 20) == 0x08000022);
  CHECK(node.set(0x1019, 0, 1, 0) == 0x08000022);
  CHECK(node.set(0x1019, 0, 1, 10) == 0);
  CHECK(node.set(0x1019, 0, 1, 1) == 0x06090030);
  CHECK(node.set(0x1006, 0, 4, 0) == 0);
  CHECK(node.set(0x1019, 0, 1, 20) == 0);
}

TEST_CASE("SYNC consumer: wrong lengths of the objects are refused [D5]") {
  SyncNode node;
  CHECK(node.set(0x1005, 0, 2, 0x80) == 0x06070013);
  CHECK(node.set(0x1006, 0, 2, 100) == 0x06070013);
  CHECK(node.set(0x1007, 0, 1, 100) == 0x06070013);
  CHECK(node.set(0x1019, 0, 2, 10) == 0x06070012);
  CHECK(node.upload(0x1006, 0).size() == 4);
  CHECK(node.upload(0x1007, 0).size() == 4);
  CHECK(node.upload(0x1019, 0).size() == 1);
}

TEST_CASE("SYNC consumer: a change of 1019h takes effect at once [Y5] [Y7]") {
  SyncNode node(with_counter());
  node.start();
  CHECK(node.set(0x1019, 0, 1, 5) == 0);
  node.rx("080#01");
  node.tx({"181#11", "281#21"});
  CHECK(node.set(0x1019, 0, 1, 0) == 0);
  node.rx("080#");
  node.tx({"181#11", "281#21"});
}

TEST_CASE("SYNC consumer: a new window applies from the next SYNC; one beyond the range of the timer is refused [X4]") {
  SyncNode node(with_counter(), [](Setup& setup) { setup.rate(1000000000); });
  CHECK(node.set(0x1007, 0, 4, 5000000) == 0x06090030);
  CHECK(node.set(0x1006, 0, 4, 5000000) == 0x06090030);
  CHECK(node.set(0x1007, 0, 4, 4000000) == 0);
  CHECK(node.get(0x1007, 0) == 4000000);
  SyncNode other(with_counter());
  other.start();
  CHECK(other.set(0x1007, 0, 4, 10000) == 0);
  other.can.refuse_all();
  other.rx("080#");
  other.after(10ms);
  other.can.accept_all();
  other.loop();
  other.silent();
}

TEST_CASE("SYNC consumer: each SYNC restarts the window [X4]") {
  SyncTable table = with_counter();
  table.window = 10000;
  SyncNode node(table);
  node.start();
  node.rx("080#");
  node.frames();
  node.after(9ms);
  node.can.refuse_all();
  node.rx("080#");
  node.after(9ms);
  node.can.accept_all();
  node.loop();
  node.tx({"181#11", "281#21"});
}

TEST_CASE("SYNC consumer: an RPDO with the CAN-ID of SYNC receives the frame, too") {
  if (CO_RPDO_N == 0) {
    return;
  }
  SyncTable table = with_counter(10);
  table.rpdo[0].on(0x80, 255, {0x22010308});
  SyncNode node(table);
  node.start();
  node.rx("080#07");
  CHECK(node.u8[2] == 7);
  node.tx("181#11");
}

}  // namespace

#endif
