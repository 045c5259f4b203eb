// SPDX-License-Identifier: Apache-2.0
// Boot-up. [301:7.2.8.2.2, 7.3.2.2.1]
#include "support/fixture.hpp"

namespace {

using namespace test;

TEST_CASE("boot-up: one frame of one byte 00h is sent when the node starts, none before [N4] [State 01]") {
  Fixture node(Setup().node_id(0x7F).stay_in_init());
  node.after(1000ms);
  node.loop();
  node.silent();
  node.call([&] { CONodeStart(&node.node); });
  node.tx("77F#00");
  CHECK(node.mode() == CO_PREOP);
  node.call([&] { CONodeStart(&node.node); });
  node.after(1000ms);
  node.silent();
}

TEST_CASE("boot-up: all other frames are held until it has been sent [N4]") {
  Fixture node(Setup().stay_in_init().heartbeat(10));
  node.can.refuse_all();
  node.call([&] { CONodeStart(&node.node); });
  node.rx("601#4000100000000000");
  node.after(10ms);
  node.silent();
  node.can.accept_all();
  node.loop();
  node.tx({"701#00", "581#4300100091010F00", "701#7F"});
}

TEST_CASE("boot-up: a frame of the application with a higher priority does not overtake it [N4]") {
  Fixture node(Setup().stay_in_init());
  node.can.refuse_all();
  CO_IF_FRM frm = frame("091#00");
  node.call([&] {
    CONodeStart(&node.node);
    CHECK(COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM));
  });
  node.can.accept_all();
  node.loop();
  node.tx({"701#00", "091#00"});
}

TEST_CASE("boot-up: a frame that the application sends in Initialisation is held until it has been sent [N4]") {
  for (const bool busy : {false, true}) {
    CAPTURE(busy);
    Fixture node(Setup().stay_in_init());
    CO_IF_FRM low = frame("7FF#01");
    CO_IF_FRM high = frame("091#02");
    node.call([&] {
      CHECK(COIfCanSend(&node->If, &low) == sizeof(CO_IF_FRM));
      CHECK(COIfCanSend(&node->If, &high) == sizeof(CO_IF_FRM));
    });
    node.loop();
    node.after(1000ms);
    node.silent();
    if (busy) node.can.refuse_next(2);
    node.call([&] { CONodeStart(&node.node); });
    for (int i = 0; i < 3; ++i) node.loop();
    node.tx({"701#00", "091#02", "7FF#01"});
  }
}

CO_ERR send_in_init(CO_OBJ*, CO_NODE* node) {
  CO_IF_FRM frm = {0x091, {0x03}, 1};
  COIfCanSend(&node->If, &frm);
  return CO_ERR_NONE;
}

TEST_CASE("boot-up: a frame that an object type sends during its initialisation by a reset is also held [N4]") {
  const CO_OBJ_TYPE type = {nullptr, send_in_init, nullptr, nullptr, nullptr};
  for (const std::string reset : {"000#8101", "000#8201"}) {
    CAPTURE(reset);
    Fixture node(Setup().stay_in_init().with({CO_KEY(0x3000, 0, CO_OBJ_____R_), &type, 0}));
    node.silent();
    node.call([&] { CONodeStart(&node.node); });
    node.loop();
    node.tx({"701#00", "091#03"});
    node.frames_per_call(2);
    node.rx(reset);
    node.loop();
    node.tx({"701#00", "091#03"});
  }
}

TEST_CASE("boot-up: it stays queued when the NMT master sends commands [N4]") {
  Fixture node(Setup().stay_in_init());
  node.can.refuse_all();
  node.call([&] { CONodeStart(&node.node); });
  node.rx("000#0101");
  node.silent();
  node.can.accept_all();
  node.loop();
  node.tx("701#00");
  CHECK(node.mode() == CO_OPERATIONAL);
}

TEST_CASE("boot-up: frames that were queued before a reset are not sent after it [N4]") {
  for (const std::string reset : {"000#8101", "000#8201"}) {
    CAPTURE(reset);
    Fixture node;
    node.can.refuse_all();
    node.rx("601#4000100000000000");
    const std::uint32_t dropped = node.counters().Dropped;
    node.rx(reset);
    node.silent();
    node.can.accept_all();
    node.loop();
    node.tx("701#00");
    CHECK(node.counters().Dropped == dropped + 1);
  }
}

TEST_CASE("boot-up: two resets while the controller refuses frames give one boot-up message") {
  Fixture node;
  node.can.refuse_all();
  node.rx("000#8101");
  node.rx("000#8101");
  node.can.accept_all();
  node.loop();
  node.tx("701#00");
  node.loop();
  node.silent();
}

TEST_CASE("boot-up: errors of the controller delay it but do not cancel it [N4] [T12]") {
  Fixture node(Setup().stay_in_init());
  node.can.refuse_next(3, -1);
  node.call([&] { CONodeStart(&node.node); });
  for (int i = 0; i < 4; ++i) node.loop();
  node.tx("701#00");
  CHECK(node.error() == CO_ERR_IF_CAN_SEND);
}

TEST_CASE("boot-up: the node is initialised and started again after a stop") {
  Fixture first;
  first.call([&] { CONodeStop(&first.node); });
  CHECK(first.mode() == CO_INVALID);
  CHECK_FALSE(first.can.on_bus);
  first.rx("601#4000100000000000");
  first.rx("000#0101");
  first.call([&] { CONodeStart(&first.node); });
  first.silent();
  CHECK(first.mode() == CO_INVALID);
}

}  // namespace
