// SPDX-License-Identifier: Apache-2.0
// Node guarding: responses to remote frames, and detection of other nodes that use the node's error control identifier.
// [301:7.2.8.2.2.1]
#include "support/fixture.hpp"

namespace {

using namespace test;

TEST_CASE("own identifier: a data frame of another node is malformed and reported with EMCY 8150h [H5] [E7]") {
  for (const std::string data : {"7F", "00", "", "0102030405060708"}) {
    CAPTURE(data);
    Fixture node;
    node.rx("701#" + data);
#if USE_EMCY
    node.tx("081#5081110000010000");
#else
    node.silent();
#endif
    CHECK(node.counters().Malformed == 1);
    CHECK(node.mode() == CO_PREOP);
    node.after(5000ms);
    node.trace();
  }
}

#if USE_GUARDING

TEST_CASE(
    "guarding: a remote frame is answered with the state, the toggle bit begins with 0 [G1] [Guarding 02] [Guarding "
    "03]") {
  Fixture node;
  node.ask("701#R1", "701#7F");
  node.ask("701#R1", "701#FF");
  node.ask("701#R1", "701#7F");
  node.rx("000#0101");
  node.ask("701#R1", "701#85");
  node.ask("701#R1", "701#05");
  node.rx("000#0201");
  node.ask("701#R1", "701#84");
  node.ask("701#R1", "701#04");
  node.rx("000#8001");
  node.ask("701#R1", "701#FF");
}

TEST_CASE("guarding: a remote frame of any length is answered") {
  Fixture node;
  bool toggle = false;
  for (const char dlc : std::string("012345678")) {
    node.ask(std::string("701#R") + dlc, toggle ? "701#FF" : "701#7F");
    toggle = !toggle;
  }
  node.ask("701#R", "701#FF");
  CHECK(node.counters().Malformed == 0);
}

TEST_CASE("guarding: only the own identifier is answered [Guarding 04]") {
  Fixture node(Setup().node_id(0x22).only_small());
  for (unsigned id = 0; id < 0x800; ++id) {
    node.rx(CO_IF_FRM{id | CO_IF_FRM_RTR, {}, 1});
    const std::vector<std::string> sent = node.frames();
    CHECK(sent == (id == 0x722 ? std::vector<std::string>{"722#7F"} : std::vector<std::string>{}));
  }
  node.rx("00000722#R1");
  node.silent();
}

TEST_CASE("guarding: only a reset sets the toggle bit to 0 [G2] [Guarding 03]") {
  for (const std::string reset : {"000#8101", "000#8201"}) {
    CAPTURE(reset);
    Fixture node;
    node.ask("701#R1", "701#7F");
    node.rx(reset);
    node.tx("701#00");
    node.ask("701#R1", "701#7F");
    node.ask("701#R1", "701#FF");
    node.rx(reset);
    node.tx("701#00");
    node.ask("701#R1", "701#7F");
  }
  Fixture node;
  node.ask("701#R1", "701#7F");
  node.after(100000ms);
  node.rx("000#0101");
  node.rx("000#0201");
  node.rx("000#8001");
  node.ask("701#R1", "701#FF");
}

TEST_CASE("guarding: no answer in Initialisation and after a stop of the node [N3]") {
  Fixture node(Setup().stay_in_init());
  node.rx("701#R1");
  node.silent();
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  node.ask("701#R1", "701#7F");
  node.call([&] { CONodeStop(&node.node); });
  node.rx("701#R1");
  node.silent();
}

TEST_CASE("guarding: requests are answered without the objects, with guard time 0 or life time factor 0 [G2]") {
  for (const unsigned which : {0U, 1U, 2U, 3U}) {
    std::uint16_t time = which == 1 ? 0 : 100;
    std::uint8_t factor = which == 2 ? 0 : 3;
    CAPTURE(which);
    Setup setup;
    if (which != 0) setup.with({CO_KEY(0x100C, 0, CO_OBJ_____RW), CO_TUNSIGNED16, &time});
    if (which != 3) setup.with({CO_KEY(0x100D, 0, CO_OBJ_____RW), CO_TUNSIGNED8, &factor});
    Fixture node(setup);
    unsigned told = 0;
    callbacks().life_guard = [&](CO_NMT*, bool) { ++told; };
    node.ask("701#R1", "701#7F");
    node.after(100000ms);
    node.silent();
    CHECK(told == 0);
    CHECK(node.armed_timers() == 0);
  }
}

TEST_CASE("guarding: the boot-up message is sent before an answer [N4]") {
  Fixture node(Setup().stay_in_init());
  node.can.refuse_all();
  node.call([&] { CONodeStart(&node.node); });
  node.rx("701#R1");
  node.rx("000#0101");
  node.rx("701#R1");
  node.can.accept_all();
  node.loop();
  node.tx({"701#00", "701#05"});
  node.ask("701#R1", "701#85");
}

TEST_CASE("guarding: while an answer is queued further requests are answered with the latest state [T12]") {
  Fixture node;
  node.ask("701#R1", "701#7F");
  node.can.refuse_all();
  node.rx("701#R1");
  node.rx("701#R1");
  node.rx("000#0101");
  node.rx("701#R1");
  node.can.accept_all();
  node.loop();
  node.tx("701#85");
  node.ask("701#R1", "701#05");
  node.ask("701#R1", "701#85");
}

TEST_CASE("guarding: continuous requests do not fill the transmit queue for other answers [T12] [Q4]") {
  Fixture node;
  node.can.refuse_all();
  for (int n = 0; n < 1000; ++n) node.rx("701#R1");
  node.rx("601#4000100000000000");
  node.can.accept_all();
  node.loop();
  node.tx({"581#4300100091010F00", "701#7F"});
  CHECK(node.counters().Dropped == 0);
}

TEST_CASE("guarding: a request while the queue is full is not answered and keeps the toggle bit [T12]") {
  Fixture node(Setup().tx_queue(1));
  node.can.refuse_all();
  node.rx("601#4000100000000000");
  node.rx("701#R1");
  node.can.accept_all();
  node.loop();
  node.tx("581#4300100091010F00");
  node.ask("701#R1", "701#7F");
}

TEST_CASE("guarding: the toggle bit alternates on the bus, whichever frame the driver refuses [T12]") {
  for (unsigned failing = 1; failing <= 6; ++failing) {
    for (const bool error : {false, true}) {
      CAPTURE(failing);
      CAPTURE(error);
      Fixture node;
      node.can.refuse_nth(failing, static_cast<std::int16_t>(error ? -1 : 0));
      std::string on_bus;
      for (int request = 0; request < 8; ++request) {
        node.rx("701#R1");
        node.after(10ms);
        for (const std::string& frm : node.frames()) on_bus += frm == "701#FF" ? '1' : '0';
      }
      CHECK(on_bus == "01010101");
      node.error();
    }
  }
}

#else

TEST_CASE("guarding: a node without guarding ignores and counts remote frames") {
  Fixture node;
  node.rx("701#R1");
  node.silent();
  CHECK(node.counters().Malformed == 1);
}

#endif

}  // namespace
