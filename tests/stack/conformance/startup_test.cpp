// SPDX-License-Identifier: Apache-2.0
// 1F80h, NMT startup: self-start, the entry into Operational without an NMT command. [302-2] [U1]
#include "support/fixture.hpp"

namespace {

using namespace test;

struct Startup {
  explicit Startup(std::uint32_t startup, Setup setup = {})
      : value(startup), node(setup.with({CO_KEY(0x1F80, 0, CO_OBJ_____RW), CO_TNMT_STARTUP, &value})) {}
  std::uint32_t value;
  Fixture node;
};

TEST_CASE("self-start: bit 2 of 1F80h = 0 gives Operational after boot-up; 1 or no object Pre-operational [U1]") {
  CHECK(Startup(0).node.mode() == CO_OPERATIONAL);
  CHECK(Startup(4).node.mode() == CO_PREOP);
  CHECK(Fixture().mode() == CO_PREOP);
  CHECK(Startup(0xFFFFFFFB).node.mode() == CO_OPERATIONAL);
  CHECK(Startup(0xFFFFFFFF).node.mode() == CO_PREOP);
}

TEST_CASE("self-start: after the boot-up message the heartbeat contains Operational [U1] [N4]") {
  Startup device(0, Setup().stay_in_init().heartbeat(100));
  Fixture& node = device.node;
  std::vector<CO_MODE> modes;
  callbacks().mode_change = [&](CO_NMT*, CO_MODE mode) { modes.push_back(mode); };
  CHECK(node.mode() == CO_INIT);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  CHECK(modes == std::vector<CO_MODE>{CO_PREOP, CO_OPERATIONAL});
  node.after(200ms);
  node.tx({"701#05", "701#05"});
}

TEST_CASE("self-start: enter pre-operational and stop of the NMT master are carried out afterwards [U1]") {
  Startup device(0);
  Fixture& node = device.node;
  node.rx("000#8001");
  CHECK(node.mode() == CO_PREOP);
  node.rx("000#0201");
  node.rx("000#8001");
  CHECK(node.mode() == CO_PREOP);
  node.after(10000ms);
  CHECK(node.mode() == CO_PREOP);
}

TEST_CASE("self-start: after every reset the present value is used [U1]") {
  Startup device(0);
  Fixture& node = device.node;
  for (const char* reset : {"000#8101", "000#8201"}) {
    CAPTURE(reset);
    node.rx(reset);
    node.tx("701#00");
    CHECK(node.mode() == CO_OPERATIONAL);
    node.ask("601#23801F0004000000", "581#60801F0000000000");
    CHECK(node.mode() == CO_OPERATIONAL);
    node.rx(reset);
    node.tx("701#00");
    CHECK(node.mode() == CO_PREOP);
    node.ask("601#23801F0000000000", "581#60801F0000000000");
    CHECK(node.mode() == CO_PREOP);
  }
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NODE); });
  node.tx("701#00");
  CHECK(node.mode() == CO_OPERATIONAL);
}

TEST_CASE("self-start: the callback of a commanded reset is called in Operational") {
  Startup device(0);
  Fixture& node = device.node;
  CO_MODE told = CO_INVALID;
  callbacks().reset_request = [&](CO_NMT* nmt, CO_NMT_RESET) { told = CONmtGetMode(nmt); };
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(told == CO_OPERATIONAL);
}

TEST_CASE("self-start: not before CONodeStart, also after a reset in Initialisation") {
  Startup device(0, Setup().stay_in_init());
  Fixture& node = device.node;
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  node.after(1000ms);
  node.silent();
  CHECK(node.mode() == CO_INIT);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  CHECK(node.mode() == CO_OPERATIONAL);
}

TEST_CASE("self-start: an application that sets a mode after or instead of CONodeStart gets that mode") {
  for (const CO_MODE wanted : {CO_PREOP, CO_OPERATIONAL, CO_STOP}) {
    for (const bool start : {true, false}) {
      CAPTURE(wanted);
      CAPTURE(start);
      Startup device(0, Setup().stay_in_init());
      Fixture& node = device.node;
      node.call([&] {
        if (start) CONodeStart(&node.node);
        CONmtSetMode(&node->Nmt, wanted);
      });
      node.tx("701#00");
      CHECK(node.mode() == wanted);
      CHECK(node.error() == CO_ERR_NONE);
    }
  }
}

// Starts a node whose CONmtModeChange() requests the mode \a ask_for in mode \a when. Returns the mode after it.
CO_MODE started(CO_MODE when, CO_MODE ask_for) {
  Startup device(0, Setup().stay_in_init());
  Fixture& node = device.node;
  callbacks().mode_change = [=](CO_NMT* nmt, CO_MODE mode) {
    if (mode == when) ask_for == CO_INVALID ? CONodeStop(nmt->Node) : CONmtSetMode(nmt, ask_for);
  };
  node.call([&] { CONodeStart(&node.node); });
  node.trace();
  return node.mode();
}

TEST_CASE("self-start: a mode that the application requests in CONmtModeChange is the final one [Q9]") {
  CHECK(started(CO_PREOP, CO_STOP) == CO_STOP);
  CHECK(started(CO_PREOP, CO_OPERATIONAL) == CO_OPERATIONAL);
  CHECK(started(CO_OPERATIONAL, CO_PREOP) == CO_PREOP);
  CHECK(started(CO_OPERATIONAL, CO_STOP) == CO_STOP);
  CHECK(started(CO_PREOP, CO_INVALID) == CO_INVALID);
  CHECK(started(CO_OPERATIONAL, CO_INVALID) == CO_INVALID);
}

TEST_CASE("self-start: a stopped node starts again after CONodeInit and CONodeStart") {
  Startup device(0);
  Fixture& node = device.node;
  node.call([&] { CONodeStop(&node.node); });
  node.init_again();
  CHECK(node.mode() == CO_INIT);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  CHECK(node.mode() == CO_OPERATIONAL);
}

TEST_CASE("self-start: 1F80h may have type UNSIGNED32 and its value in the entry") {
  Fixture plain(Setup().with({CO_KEY(0x1F80, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0}));
  CHECK(plain.mode() == CO_OPERATIONAL);
  Fixture direct(Setup().with({CO_KEY(0x1F80, 0, CO_OBJ_D___RW), CO_TNMT_STARTUP, 0}));
  CHECK(direct.mode() == CO_OPERATIONAL);
  direct.ask("601#23801F0004000000", "581#60801F0000000000");
  direct.ask("601#40801F0000000000", "581#43801F0004000000");
  direct.rx("000#8201");
  direct.tx("701#00");
  CHECK(direct.mode() == CO_PREOP);
}

TEST_CASE("1F80h: bit 2 may be changed; a change of any other bit is refused [U1]") {
  for (const std::uint32_t before : {0x00000000U, 0x0000000BU, 0xFFFFFFFBU}) {
    Startup device(before);
    Fixture& node = device.node;
    for (unsigned bit = 0; bit < 32; ++bit) {
      CAPTURE(bit);
      const std::uint32_t value = device.value ^ (std::uint32_t{1} << bit);
      CO_IF_FRM request = frame("601#23801F0000000000");
      CO_SET_LONG(&request, value, 4);
      node.rx(request);
      node.tx(bit == 2 ? "581#60801F0000000000" : "581#80801F0030000906");
      CHECK(device.value == (before ^ (bit >= 2 ? 4U : 0U)));
    }
  }
}

TEST_CASE("1F80h: its type is accepted at 1F80h only, and with four bytes") {
  Startup device(4);
  device.node.ask("601#2F801F0000000000", "581#80801F0013000706");
#if USE_DICT_CHECK
  Fixture wrong(Setup().with({CO_KEY(0x1F81, 0, CO_OBJ_D___RW), CO_TNMT_STARTUP, 0}).stay_in_init());
  CHECK(wrong.error() == CO_ERR_DICT_INIT);
  CHECK(CODictGetFault(&wrong->Dict, nullptr) == CO_DICT_WRONG_PLACE);
#endif
}

// Boot-up. [301:7.2.8.2.2, 7.3.2.2.1]

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
