// SPDX-License-Identifier: Apache-2.0
// Access hook of the LSS slave: the application permits or refuses services that change the node. [305]
#include "support/access.hpp"
#include "support/lss_slave.hpp"
#include "support/sync_fixture.hpp"

#if USE_ACCESS_HOOK && USE_LSS && CO_LSS_IN_OPERATIONAL

namespace {

using namespace test;

constexpr std::uint8_t no_node_id = 255;

struct Slave {
  explicit Slave(std::uint8_t node_id = 1) : node(setup(node_id)) {}
  // Makes the access hook refuse a service with an error code.
  void refuse(std::uint8_t service, std::uint8_t error = 1, std::uint8_t specific = 0) {
    log.on_lss = [=](CO_NODE&, CO_ACCESS_LSS& access) {
      access.Specific = specific;
      return access.Service == service ? error : std::uint8_t{0};
    };
  }
  void permit() { log.on_lss = nullptr; }
  void is_in_configuration(bool expected = true) {
    const std::uint8_t id = node->NodeId;
    node.rx(lss_inquire_node_id);
    CHECK(node.frames().size() == (expected ? 1U : 0U));
    CHECK(node->NodeId == id);
  }
  const CO_ACCESS_LSS& last() {
    REQUIRE(!log.lss.empty());
    return log.lss.back();
  }

  AccessLog log;
  Fixture node;

 private:
  static Setup setup(std::uint8_t node_id) {
    Setup setup = AccessLog::setup();
    return with_lss_address(setup.node_id(node_id));
  }
};

TEST_CASE("access hook, LSS: called for switch state global in both directions") {
  Slave slave;
  slave.refuse(CO_LSS_SERVICE_SWITCH_GLOBAL);
  slave.node.rx(lss_to_configuration);
  slave.is_in_configuration(false);
  CHECK(slave.last().Service == 0x04);
  CHECK(slave.last().State == CO_LSS_CONF);
  slave.permit();
  slave.node.rx(lss_to_configuration);
  slave.is_in_configuration();
  slave.refuse(CO_LSS_SERVICE_SWITCH_GLOBAL);
  slave.node.rx(lss_to_waiting);
  CHECK(slave.last().State == CO_LSS_WAIT);
  slave.is_in_configuration();
  slave.node.rx("7E5#0402000000000000");  // no such state
  CHECK(slave.log.lss.size() == 3);
}

TEST_CASE("access hook, LSS: called for switch state selective once the address matches; a refusal is not answered") {
  Slave slave;
  slave.refuse(CO_LSS_SERVICE_SWITCH_SELECTIVE);
  slave.node.rx("7E5#4019030000000000");
  slave.node.rx("7E5#4178563412000000");
  slave.node.rx("7E5#4202000100000000");
  slave.node.rx("7E5#4345000000000000");
  CHECK(slave.log.lss.empty());
  select_lss_slave(slave.node);
  slave.node.silent();
  slave.is_in_configuration(false);
  REQUIRE(slave.log.lss.size() == 1);
  CHECK(slave.last().Service == CO_LSS_SERVICE_SWITCH_SELECTIVE);
  CHECK(slave.last().State == CO_LSS_CONF);
  slave.node.rx("7E5#4344000000000000");  // only the last of the four frames
  slave.node.silent();
  slave.permit();
  select_lss_slave(slave.node);
  slave.node.tx("7E4#4400000000000000");
}

void scan_to_the_end(Fixture& node) {
  node.ask("7E5#5100000000800000", "7E4#4F00000000000000");
  node.ask("7E5#5119030000000001", "7E4#4F00000000000000");
  node.ask("7E5#5178563412000102", "7E4#4F00000000000000");
  node.ask("7E5#5102000100000203", "7E4#4F00000000000000");
  node.rx("7E5#5144000000000300");
}

TEST_CASE("access hook, LSS: called at the end of a fastscan, which would switch the node to configuration") {
  Slave slave(no_node_id);
  slave.refuse(CO_LSS_SERVICE_FASTSCAN);
  scan_to_the_end(slave.node);
  slave.node.silent();
  CHECK(slave.log.lss.size() == 1);
  CHECK(slave.last().Service == CO_LSS_SERVICE_FASTSCAN);
  CHECK(slave.last().State == CO_LSS_CONF);
  slave.is_in_configuration(false);
  slave.permit();
  scan_to_the_end(slave.node);
  slave.node.tx("7E4#4F00000000000000");
  slave.is_in_configuration();
}

TEST_CASE("access hook, LSS: configure node-ID that is refused is answered with the error code and changes nothing") {
  Slave slave;
  slave.node.rx(lss_to_configuration);
  slave.refuse(CO_LSS_SERVICE_NODE_ID, 1);
  slave.node.ask("7E5#1105000000000000", "7E4#1101000000000000");
  CHECK(slave.last().NodeId == 5);
  slave.refuse(CO_LSS_SERVICE_NODE_ID, 255, 0x42);
  slave.node.ask("7E5#1105000000000000", "7E4#11FF420000000000");
  slave.refuse(CO_LSS_SERVICE_NODE_ID, 7, 0x42);
  slave.node.ask("7E5#1105000000000000", "7E4#1107000000000000");
  CHECK(slave.node->Lss.CfgNodeId == 1);
  const std::size_t asked = slave.log.lss.size();
  slave.node.ask("7E5#1100000000000000", "7E4#1101000000000000");  // invalid node-ID: the hook is not called
  CHECK(slave.log.lss.size() == asked);
  slave.permit();
  slave.node.ask("7E5#1105000000000000", "7E4#1100000000000000");
  slave.node.ask("000#8201", "705#00");
}

TEST_CASE(
    "access hook, LSS: configure bit timing that is refused is answered with the error code and changes nothing") {
  Slave slave;
  slave.node.rx(lss_to_configuration);
  slave.refuse(CO_LSS_SERVICE_BIT_TIMING, 255, 9);
  slave.node.ask("7E5#1300080000000000", "7E4#13FF090000000000");
  CHECK(slave.last().Baudrate == 10000);
  CHECK(slave.node->Lss.CfgBaudrate == 250000);
  const std::size_t asked = slave.log.lss.size();
  slave.node.ask("7E5#1300050000000000", "7E4#1301000000000000");
  slave.node.ask("7E5#1301020000000000", "7E4#1301000000000000");
  CHECK(slave.log.lss.size() == asked);
}

TEST_CASE(
    "access hook, LSS: activate bit timing that is refused changes neither bit rate nor NMT state, without answer") {
  Slave slave;
  slave.node.rx("000#0101");
  slave.node.rx(lss_to_configuration);
  slave.node.ask("7E5#1300020000000000", "7E4#1300000000000000");
  slave.refuse(CO_LSS_SERVICE_ACTIVATE);
  slave.node.rx("7E5#1534120000000000");
  CHECK(slave.last().Delay == 0x1234);
  CHECK(slave.last().Baudrate == 500000);
  CHECK(slave.last().Mode == CO_PREOP);
  CHECK(slave.node.mode() == CO_OPERATIONAL);
  slave.is_in_configuration();  // no frame is delayed
  slave.node.after(12s);
  slave.node.silent();
  CHECK(slave.node.can.init_calls == 1);
}

TEST_CASE("access hook, LSS: store that is refused is answered with the error code and stores nothing") {
  Slave slave;
  unsigned stores = 0;
  callbacks().lss_store = [&](std::uint32_t, std::uint8_t) { return ++stores, CO_ERR_NONE; };
  slave.node.rx(lss_to_configuration);
  slave.refuse(CO_LSS_SERVICE_STORE, 2);
  slave.node.ask("7E5#1700000000000000", "7E4#1702000000000000");
  CHECK(slave.last().NodeId == 1);
  CHECK(slave.last().Baudrate == 250000);
  CHECK(stores == 0);
  CHECK(slave.node.error() == CO_ERR_NONE);
  slave.permit();
  slave.node.ask("7E5#1700000000000000", "7E4#1700000000000000");
  CHECK(stores == 1);
}

TEST_CASE("access hook, LSS: not called for services that change nothing") {
  Slave slave;
  slave.node.rx("7E5#4619030000000000");
  slave.node.rx("7E5#4778563412000000");
  slave.node.rx("7E5#4802000100000000");
  slave.node.rx("7E5#4902000100000000");
  slave.node.rx("7E5#4A44000000000000");
  slave.node.ask("7E5#4B44000000000000", "7E4#4F00000000000000");
  slave.node.rx("7E5#4C00000000000000");
  slave.node.rx("7E5#7700000000000000");
  CHECK(slave.log.lss.empty());
  slave.node.rx(lss_to_configuration);
  slave.node.ask("7E5#5A00000000000000", "7E4#5A19030000000000");
  CHECK(slave.log.lss.size() == 1);
}

TEST_CASE("access hook, LSS: the bit rate is switched in the NMT state that the hook sets in CO_ACCESS_LSS.Mode") {
  struct Case {
    const char* before;
    CO_MODE offered;
    CO_MODE chosen;
    CO_MODE after;
  };
  for (const Case& one :
       {Case{"000#0101", CO_PREOP, CO_STOP, CO_STOP}, Case{"000#0101", CO_PREOP, CO_PREOP, CO_PREOP},
        Case{"000#0101", CO_PREOP, CO_OPERATIONAL, CO_OPERATIONAL}, Case{"000#0101", CO_PREOP, CO_INIT, CO_OPERATIONAL},
        Case{"000#0101", CO_PREOP, CO_INVALID, CO_OPERATIONAL},
        Case{"000#0101", CO_PREOP, static_cast<CO_MODE>(CO_MODE_NUM), CO_OPERATIONAL},
        Case{"000#8001", CO_PREOP, CO_STOP, CO_STOP}, Case{"000#0201", CO_STOP, CO_STOP, CO_STOP}}) {
    CAPTURE(one.before);
    CAPTURE(unsigned{one.chosen});
    Slave slave;
    slave.node.rx(one.before);
    slave.node.rx(lss_to_configuration);
    slave.log.on_lss = [&](CO_NODE&, CO_ACCESS_LSS& access) {
      CHECK(access.Mode == one.offered);
      access.Mode = one.chosen;
      return std::uint8_t{0};
    };
    slave.node.rx("7E5#150A000000000000");
    CHECK(slave.node.mode() == one.after);
    slave.node.after(20ms);
    CHECK(slave.node.can.init_calls == 2);
  }
}

TEST_CASE("access hook, LSS: a node without node-ID stays in Initialisation for any NMT state that it sets") {
  Slave slave(no_node_id);
  slave.node.rx(lss_to_configuration);
  slave.log.on_lss = [](CO_NODE&, CO_ACCESS_LSS& access) {
    CHECK(access.Mode == CO_INIT);
    access.Mode = CO_OPERATIONAL;
    return std::uint8_t{0};
  };
  slave.node.rx("7E5#150A000000000000");
  CHECK(slave.node.mode() == CO_INIT);
  slave.node.after(20ms);
  slave.node.silent();
  slave.is_in_configuration();
}

TEST_CASE("access hook, LSS: if it stops the node there is no answer, no timer and no queued frame") {
  for (const char* request : {lss_to_waiting, "7E5#1105000000000000", "7E5#1300020000000000", "7E5#1500000000000000",
                              "7E5#1564000000000000", "7E5#1700000000000000"}) {
    CAPTURE(request);
    Slave slave;
    callbacks().lss_store = [&](std::uint32_t, std::uint8_t) { return CO_ERR_NONE; };
    slave.node.rx(lss_to_configuration);
    slave.log.on_lss = [](CO_NODE& self, CO_ACCESS_LSS&) {
      CONodeStop(&self);
      return std::uint8_t{0};
    };
    slave.node.rx(request);
    slave.node.silent();
    CHECK(slave.node.mode() == CO_INVALID);
    CHECK(slave.node.armed_timers() == 0);
    CHECK(slave.node->Transmit.Off == 0);
    callbacks().lss_store = nullptr;
  }
}

TEST_CASE("access hook, LSS: a reset that it requests is carried out after the answer") {
  Slave slave;
  slave.node.rx(lss_to_configuration);
  slave.node.frames_per_call(2);
  slave.log.on_lss = [](CO_NODE& self, CO_ACCESS_LSS&) {
    CONmtReset(&self.Nmt, CO_RESET_COM);
    return std::uint8_t{0};
  };
  slave.node.rx("7E5#1105000000000000");
  slave.node.tx({"7E4#1100000000000000", "705#00"});
}

}  // namespace

#endif
