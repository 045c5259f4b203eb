// SPDX-License-Identifier: Apache-2.0
// LSS master: activate bit timing. [305]
#include "support/lss_master_fixture.hpp"

#if USE_LSS_MASTER

namespace {

using namespace test;

// The initialisation of a controller may clear its filters.
TEST_CASE("LSS master and slave: after the switch of the bit rate the driver's filters are set again") {
  Setup setup;
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    setup.with({CO_KEY(0x1018, sub, CO_OBJ_D___R_), CO_TUNSIGNED32, sub});
  }
  LssMaster node(setup);
  std::vector<std::uint32_t> filter;
  SUBCASE("master") {
    node.run("7E5#1500000000000000", COLssmActivateBitTiming, std::uint16_t{0}, 500000U);
    filter.swap(node.can.filter);
    node.after(2ms);
    node.end(CO_LSSM_OK);
  }
#if USE_LSS
  SUBCASE("slave") {
    node.rx("7E5#0401000000000000");
    filter.swap(node.can.filter);
    node.rx("7E5#1500000000000000");
  }
#endif
  CHECK_FALSE(filter.empty());
  CHECK((node.can.filter == filter));
}

TEST_CASE("LSS master: activate bit timing: this node is silent for the delay, switches, and is silent again") {
  LssMaster node(Setup().heartbeat(30));
  node.run("7E5#1564000000000000", COLssmActivateBitTiming, std::uint16_t{100}, 500000U);
  node.after(99ms);
  node.silent();
  CHECK(node.can.baud == 250000);
  node.after(1ms);
  CHECK(node.can.baud == 500000);
  CHECK(node.can.init_calls == 2);
  node.after(99ms);
  node.silent();
  node.goes_on();
  node.after(1ms);
  node.tx("701#7F");
  node.end(CO_LSSM_OK);
  CHECK(node->Baudrate == 500000);
}

TEST_CASE("LSS master: activate bit timing: delay 0 takes 1 ms each; a delay of 65535 ms is kept") {
  LssMaster node;
  node.run("7E5#1500000000000000", COLssmActivateBitTiming, std::uint16_t{0}, 1000000U);
  node.after(1ms);
  CHECK(node.can.baud == 1000000);
  node.goes_on();
  node.after(1ms);
  node.end(CO_LSSM_OK);
  node.run("7E5#15FFFF0000000000", COLssmActivateBitTiming, std::uint16_t{65535}, 20000U);
  node.after(65534ms);
  CHECK(node.can.baud == 1000000);
  node.after(1ms);
  CHECK(node.can.baud == 20000);
  node.after(65535ms);
  node.end(CO_LSSM_OK);
}

TEST_CASE(
    "LSS master: activate bit timing without bit rate of its own node: the controller is not changed, but silent") {
  LssMaster node(Setup().heartbeat(30));
  node.run("7E5#1514000000000000", COLssmActivateBitTiming, std::uint16_t{20}, 0U);
  node.after(39ms);
  node.silent();
  node.after(1ms);
  node.end(CO_LSSM_OK);
  node.tx("701#7F");
  CHECK(node.can.baud == 250000);
  CHECK(node.can.init_calls == 1);
}

TEST_CASE("LSS master: activate bit timing continues over a reset and ends with a stop") {
  LssMaster node;
  node.run("7E5#150A000000000000", COLssmActivateBitTiming, std::uint16_t{10}, 500000U);
  SUBCASE("reset") {
    node.rx("000#8201");
    node.silent();
    node.goes_on();
    node.after(20ms);
    node.tx("701#00");
    node.end(CO_LSSM_OK);
    CHECK(node.can.baud == 500000);
  }
  SUBCASE("stop before and after the switch") {
    node.after(10ms);
    node.call([&] { CONodeStop(&node.node); });
    node.end(CO_LSSM_STOPPED);
    node.init_again();
    node.call([&] { CONodeStart(&node.node); });
    node.tx("701#00");
  }
}

TEST_CASE("LSS master: activate bit timing that is cancelled: the node sends again at its present bit rate") {
  LssMaster node(Setup().heartbeat(5));
  node.run("7E5#150A000000000000", COLssmActivateBitTiming, std::uint16_t{10}, 500000U);
  node.after(6ms);
  node.silent();
  node.cancel();
  node.end(CO_LSSM_CANCELLED);
  node.loop();
  node.tx("701#7F");
  CHECK(node.can.baud == 250000);
}

TEST_CASE("LSS master: activate bit timing that is cancelled in a callback after CONodeStop(): nothing is sent") {
  Fixture node;
  CHECK(COLssmActivateBitTiming(&node->Lssm, 100, 250000, [](CO_LSSM*, CO_LSSM_RESULT) {}) == CO_ERR_NONE);
  node.frames();
  callbacks().can_receive = [&](CO_IF_FRM* frm) {
    CONodeStop(&node.node);
    CHECK(COLssmCancel(&node->Lssm) == CO_ERR_NONE);
    (void)COIfCanSend(&node->If, frm);
  };
  node.rx("222#00");
  node.silent();
  CHECK(node.mode() == CO_INVALID);
}

TEST_CASE("LSS master: activate bit timing does not start while frames are queued for the controller") {
  LssMaster node;
  node.can.refuse_all();
  CHECK(node.start(COLssmActivateBitTiming, std::uint16_t{10}, 500000U) == CO_ERR_IF_CAN_SEND);
  CHECK(node.start(COLssmSwitchGlobal, lss_configuration) == CO_ERR_NONE);
  node.after(1ms);
  node.end(CO_LSSM_OK);
  CHECK(node.start(COLssmActivateBitTiming, std::uint16_t{10}, 500000U) == CO_ERR_IF_CAN_SEND);
  node.goes_on();
  node.can.accept_all();
  node.loop();
  node.tx("7E5#0401000000000000");
  node.after(100ms);
  node.goes_on();
  CHECK(node.can.baud == 250000);
  node.run("7E5#150A000000000000", COLssmActivateBitTiming, std::uint16_t{10}, 500000U);
}

}  // namespace

#endif
