// SPDX-License-Identifier: Apache-2.0
// LSS in Operational: supported services, and leaving Operational before the bit rate is switched. [305]
#include "support/lss_slave.hpp"
#include "support/sync_fixture.hpp"

#if (USE_LSS || USE_LSS_MASTER) && CO_RPDO_N > 1 && USE_SYNC

namespace {

using namespace test;

constexpr const char* start = "000#0101";

// A node whose RPDO 1 writes u8[0] at once, and RPDO 2 writes u8[1] with the SYNC.
class Device {
 public:
  explicit Device(std::uint8_t behaviour = absent, const std::function<void(Setup&)>& change = {})
      : behaviour_(behaviour), node(table(), [&](Setup& setup) {
          with_lss_address(setup);
          if (behaviour != absent) {
            setup.with({CO_KEY(0x1029, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 1})
                .with({CO_KEY(0x1029, 1, CO_OBJ_____RW), CO_TERROR_BEHAVIOUR, CO_DATA(&behaviour_)});
          }
          if (change) {
            change(setup);
          }
        }) {}

  // Sends the three frames of an LSS master that activate 500 kbit/s with a delay of 100 ms.
  void take_over() {
    node.rx(lss_to_configuration);
    node.ask("7E5#1300020000000000", "7E4#1300000000000000");
    node.rx("7E5#1564000000000000");
  }
  // Checks that neither RPDO is processed.
  void applies_nothing() {
    const std::uint8_t before[] = {node.u8[0], node.u8[1]};
    node.rx("201#5A");
    node.rx("301#5B");
    node.rx("080#");
    CHECK(node.u8[0] == before[0]);
    CHECK(node.u8[1] == before[1]);
  }
  void applies_both() {
    node.rx("201#6A");
    node.rx("301#6B");
    node.rx("080#");
    CHECK(node.u8[0] == 0x6A);
    CHECK(node.u8[1] == 0x6B);
  }

  static constexpr std::uint8_t absent = 255;

 private:
  static SyncTable table() {
    SyncTable table;
    table.rpdo[0].on(0x201, 255, {0x22010108});
    table.rpdo[1].on(0x301, 1, {0x22010208});
    return table;
  }
  std::uint8_t behaviour_;

 public:
  SyncNode node;
};

#if USE_LSS && CO_LSS_IN_OPERATIONAL
TEST_CASE("LSS: a node that activates bit timing in Operational first enters the state of 1029h:1") {
  struct Case {
    std::uint8_t behaviour;
    CO_MODE mode;
  };
  for (const Case& one : {Case{Device::absent, CO_PREOP}, Case{0, CO_PREOP}, Case{1, CO_PREOP}, Case{2, CO_STOP}}) {
    CAPTURE(unsigned{one.behaviour});
    Device device(one.behaviour);
    SyncNode& node = device.node;
    node.rx(start);
    node.rx("301#77");  // applied at the next SYNC
    device.take_over();
    CHECK(node.mode() == one.mode);
    CHECK(node.can.init_calls == 1);
    device.applies_nothing();
    node.after(100ms);
    CHECK(node.can.baud == 500000);
    device.applies_nothing();
    node.after(100ms);
    device.applies_nothing();
    CHECK(node.mode() == one.mode);
    node.silent();
    node.rx(start);
    device.applies_both();
  }
}

TEST_CASE("LSS, activate bit timing with delay 0 in Operational: the node leaves Operational") {
  Device device;
  device.node.rx(start);
  device.node.rx(lss_to_configuration);
  device.node.rx("7E5#1500000000000000");
  CHECK(device.node.mode() == CO_PREOP);
  CHECK(device.node.can.init_calls == 2);
  device.applies_nothing();
}

TEST_CASE("LSS, activate bit timing: Pre-operational and Stopped are kept for any value of 1029h:1") {
  for (const std::uint8_t behaviour : {std::uint8_t{0}, std::uint8_t{2}}) {
    for (const char* command : {"000#8001", "000#0201"}) {
      Device device(behaviour);
      device.node.rx(command);
      const CO_MODE before = device.node.mode();
      device.take_over();
      device.node.after(200ms);
      CHECK(device.node.mode() == before);
      CHECK(device.node.can.baud == 500000);
    }
  }
}

TEST_CASE("LSS, activate bit timing: a node that is started during the switch applies no RPDO") {
  Device device;
  SyncNode& node = device.node;
  device.take_over();
  node.rx(start);
  CHECK(node.mode() == CO_OPERATIONAL);
  device.applies_nothing();
  node.after(100ms);
  device.applies_nothing();
  node.after(99ms);
  device.applies_nothing();
  node.after(1ms);
  node.rx("080#");
  CHECK(node.u8[1] == 0x21);  // initial value: frames received during the switch are discarded
  device.applies_both();
}

TEST_CASE("LSS, activate bit timing: if CONmtModeChange() stops the node the bit rate is not switched") {
  for (const char* request : {"7E5#1564000000000000", "7E5#1500000000000000"}) {
    Device device;
    SyncNode& node = device.node;
    node.rx(start);
    node.rx(lss_to_configuration);
    callbacks().mode_change = [](CO_NMT* nmt, CO_MODE mode) {
      if (mode == CO_PREOP) {
        CONodeStop(nmt->Node);
      }
    };
    node.rx(request);
    CHECK(node.mode() == CO_INVALID);
    CHECK(node.armed_timers() == 0);
    CHECK(node->Transmit.Off == 0);
    CHECK(node.can.init_calls == 1);
    callbacks().mode_change = nullptr;
  }
}
#endif

#if USE_LSS
TEST_CASE("LSS in Operational: served if CO_LSS_IN_OPERATIONAL; in the other states always") {
  const std::vector<std::string> node_id = {"7E4#5E01000000000000"};
  const std::vector<std::string> nothing;
  for (const char* command : {"000#8001", start, "000#0201"}) {
    CAPTURE(command);
    Device device;
    device.node.rx(command);
    const bool is_served = CO_LSS_IN_OPERATIONAL != 0 || device.node.mode() != CO_OPERATIONAL;
    device.node.rx(lss_to_configuration);
    device.node.rx(lss_inquire_node_id);
    CHECK(device.node.frames() == (is_served ? node_id : nothing));
    device.node.rx("000#8001");
    device.node.rx(lss_inquire_node_id);
    CHECK(device.node.frames() == (is_served ? node_id : nothing));
  }
}

TEST_CASE("LSS in Operational: a node that is started in the state configuration stays in that state") {
  Device device;
  device.node.rx(lss_to_configuration);
  device.node.rx(start);
  device.node.rx(lss_to_waiting);
  device.node.rx("000#8001");
  device.node.rx(lss_inquire_node_id);
  CHECK(device.node.frames().empty() == (CO_LSS_IN_OPERATIONAL != 0));
}

TEST_CASE("LSS: a node without node-ID processes LSS services") {
  Device device(Device::absent, [](Setup& setup) { setup.node_id(255); });
  select_lss_slave(device.node);
  device.node.tx("7E4#4400000000000000");
  device.node.ask("7E5#1105000000000000", "7E4#1100000000000000");
  device.node.ask(lss_to_waiting, "705#00");
}
#endif

#if USE_LSS_MASTER
TEST_CASE("LSS master in Operational: no RPDO is applied while it switches the bit rate") {
  Device device;
  SyncNode& node = device.node;
  node.rx(start);
  node.call(
      [&] { CHECK(COLssmActivateBitTiming(&node->Lssm, 10, 500000, [](CO_LSSM*, CO_LSSM_RESULT) {}) == CO_ERR_NONE); });
  node.tx("7E5#150A000000000000");
  device.applies_nothing();
  node.after(10ms);
  device.applies_nothing();
  node.after(10ms);
  device.applies_both();
}
#endif

}  // namespace

#endif
