// SPDX-License-Identifier: Apache-2.0
// LSS slave. [305] [L1-L7]
#include "support/failing_nvm.hpp"
#include "support/fixture.hpp"

#if USE_LSS

namespace {

using namespace test;

CO_OBJ identity(std::uint8_t sub, std::uint32_t number) {
  return {CO_KEY(0x1018, sub, CO_OBJ_D___R_), CO_TUNSIGNED32, number};
}

Setup slave(std::uint8_t node_id = 1, std::uint32_t serial = 0x00000044) {
  return Setup()
      .node_id(node_id)
      .with({CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 4})
      .with(identity(1, 0x00000319))
      .with(identity(2, 0x12345678))
      .with(identity(3, 0x00010002))
      .with(identity(4, serial));
}

constexpr std::uint8_t no_node_id = 255;
constexpr const char* to_configuration = "7E5#0401000000000000";
constexpr const char* to_waiting = "7E5#0400000000000000";

// A node in LSS state configuration.
struct Configured {
  explicit Configured(std::uint8_t node_id = 1) : node(slave(node_id)) { node.rx(to_configuration); }
  Fixture node;
};

void select(Fixture& node) {
  node.rx("7E5#4019030000000000");
  node.rx("7E5#4178563412000000");
  node.rx("7E5#4202000100000000");
  node.rx("7E5#4344000000000000");
}

TEST_CASE("LSS: in the state waiting, configuration services are ignored [L1]") {
  Fixture node(slave());
  for (const char* request : {"7E5#1105000000000000", "7E5#1300020000000000", "7E5#1500000000000000",
                              "7E5#1700000000000000", "7E5#5A00000000000000", "7E5#5E00000000000000"}) {
    CAPTURE(request);
    node.rx(request);
    node.silent();
  }
  CHECK(node.can.init_calls == 1);
}

TEST_CASE("LSS: switch state global is not answered and switches to configuration and back [L2]") {
  Fixture node(slave());
  node.rx(to_configuration);
  node.silent();
  node.ask("7E5#5E00000000000000", "7E4#5E01000000000000");
  node.rx("7E5#0402000000000000");
  node.ask("7E5#5E00000000000000", "7E4#5E01000000000000");
  node.rx(to_waiting);
  node.rx("7E5#5E00000000000000");
  node.silent();
}

TEST_CASE("LSS: switch state selective is answered after the whole address [L2]") {
  Fixture node(slave());
  select(node);
  node.tx("7E4#4400000000000000");
  node.ask("7E5#5E00000000000000", "7E4#5E01000000000000");
}

TEST_CASE("LSS: switch state selective: each part must match, in the order of the address [L2]") {
  const char* parts[] = {"7E5#4019030000000000", "7E5#4178563412000000", "7E5#4202000100000000",
                         "7E5#4344000000000000"};
  for (unsigned wrong = 0; wrong < 4; ++wrong) {
    for (const bool missing : {false, true}) {
      Fixture node(slave());
      for (unsigned n = 0; n < 4; ++n) {
        if (n != wrong) {
          node.rx(parts[n]);
        } else if (!missing) {
          node.rx(std::string(parts[n]).replace(6, 2, "7F"));
        }
      }
      node.silent();
      node.rx("7E5#5E00000000000000");
      node.silent();
      select(node);
      node.tx("7E4#4400000000000000");
    }
  }
}

TEST_CASE("LSS: in the state configuration, switch state selective is ignored") {
  Configured device;
  select(device.node);
  device.node.silent();
}

TEST_CASE("LSS: configure node-ID: 1…127 and 255 are accepted, any other value is refused with 1 [L3]") {
  for (unsigned id = 0; id <= 255; ++id) {
    CAPTURE(id);
    Configured device;
    CO_IF_FRM request = frame("7E5#1100000000000000");
    request.Data[1] = static_cast<std::uint8_t>(id);
    device.node.rx(request);
    const bool possible = (id >= 1 && id <= 127) || id == 255;
    device.node.tx(possible ? "7E4#1100000000000000" : "7E4#1101000000000000");
    CHECK(device.node->Lss.CfgNodeId == (possible ? id : 1));
    CHECK(device.node->NodeId == 1);
  }
}

TEST_CASE("LSS: a new node-ID becomes active with NMT reset communication, not before [L7]") {
  Configured device;
  Fixture& node = device.node;
  node.ask("7E5#1105000000000000", "7E4#1100000000000000");
  node.rx(to_waiting);
  node.ask("601#4000100000000000", "581#4300100091010F00");
  node.ask("000#8201", "705#00");
  node.ask("605#4000100000000000", "585#4300100091010F00");
  node.rx("601#4000100000000000");
  node.silent();
}

TEST_CASE("LSS: a node-ID that was not stored is lost with NMT reset node [L7]") {
  Configured device;
  Fixture& node = device.node;
  node.ask("7E5#1105000000000000", "7E4#1100000000000000");
  node.ask("000#8101", "701#00");
  node.ask("000#8201", "701#00");
  SUBCASE("active before") {
    node.rx(to_configuration);
    node.ask("7E5#1105000000000000", "7E4#1100000000000000");
    node.ask("000#8201", "705#00");
    node.ask("000#8105", "701#00");
  }
  SUBCASE("a node without an active node-ID becomes unconfigured again") {
    Configured nameless(no_node_id);
    nameless.node.ask("7E5#1105000000000000", "7E4#1100000000000000");
    nameless.node.ask(to_waiting, "705#00");
    nameless.node.rx("000#8105");
    nameless.node.silent();
    nameless.node.ask("7E5#4C00000000000000", "7E4#5000000000000000");
  }
}

TEST_CASE("LSS: a node-ID that was stored or set by the application is kept by NMT reset node [L7]") {
  SUBCASE("stored") {
    std::uint8_t stored = 1;
    callbacks().lss_store = [&](std::uint32_t, std::uint8_t id) { return stored = id, CO_ERR_NONE; };
    callbacks().lss_load = [&](std::uint32_t*, std::uint8_t* id) { return *id = stored, CO_ERR_NONE; };
    Configured device;
    device.node.ask("7E5#1105000000000000", "7E4#1100000000000000");
    device.node.ask("7E5#1700000000000000", "7E4#1700000000000000");
    device.node.ask("000#8101", "705#00");
    callbacks().lss_store = nullptr;
    callbacks().lss_load = nullptr;
  }
  SUBCASE("set by the application") {
    Fixture node(slave().stay_in_init());
    node.call([&] {
      CONmtSetNodeId(&node->Nmt, 7);
      CONmtReset(&node->Nmt, CO_RESET_NODE);
      CONodeStart(&node.node);
    });
    node.tx("707#00");
    node.ask("000#8107", "707#00");
  }
}

TEST_CASE("LSS: configure bit timing: table 0 and index 0…8 without 5 are accepted, others are refused with 1 [L4]") {
  const std::map<unsigned, std::uint32_t> rates = {{0, 1000000}, {1, 800000}, {2, 500000}, {3, 250000},
                                                   {4, 125000},  {6, 50000},  {7, 20000},  {8, 10000}};
  for (const unsigned table : {0U, 1U, 128U, 255U}) {
    for (unsigned index = 0; index <= 255; index += index < 10 ? 1 : stride(35)) {
      Configured device;
      CO_IF_FRM request = frame("7E5#1300000000000000");
      request.Data[1] = static_cast<std::uint8_t>(table);
      request.Data[2] = static_cast<std::uint8_t>(index);
      device.node.rx(request);
      const auto rate = table == 0 ? rates.find(index) : rates.end();
      device.node.tx(rate != rates.end() ? "7E4#1300000000000000" : "7E4#1301000000000000");
      CHECK(device.node->Lss.CfgBaudrate == (rate != rates.end() ? rate->second : 250000));
      CHECK(device.node.can.baud == 250000);
    }
  }
}

TEST_CASE("LSS: activate bit timing: nothing is sent for the delay, the switch and a second delay [L4]") {
  Fixture node(slave().heartbeat(30));
  node.rx(to_configuration);
  node.ask("7E5#1300020000000000", "7E4#1300000000000000");
  node.rx("7E5#1564000000000000");
  node.after(99ms);
  node.silent();
  CHECK(node.can.baud == 250000);
  node.after(1ms);
  CHECK(node.can.baud == 500000);
  CHECK(node.can.init_calls == 2);
  node.after(99ms);
  node.silent();
  node.after(1ms);
  node.tx("701#7F");
  node.after(10ms);
  node.tx("701#7F");
  CHECK(node->Baudrate == 500000);
}

TEST_CASE("LSS: activate bit timing with delay 0 switches at once [L4] [D50]") {
  Configured device;
  device.node.ask("7E5#1300000000000000", "7E4#1300000000000000");
  device.node.rx("7E5#1500000000000000");
  CHECK(device.node.can.baud == 1000000);
  CHECK(device.node.can.on_bus);
  device.node.ask("601#4000100000000000", "581#4300100091010F00");
}

TEST_CASE("LSS: activate bit timing is completed if the node is stopped or reset meanwhile") {
  Configured device;
  Fixture& node = device.node;
  node.ask("7E5#1300020000000000", "7E4#1300000000000000");
  node.rx("7E5#150A000000000000");
  node.rx("000#8201");
  node.silent();
  node.after(20ms);
  node.tx("701#00");
  CHECK(node.can.baud == 500000);
}

TEST_CASE("LSS: frames of other than 8 bytes are malformed: counted and without effect [L1]") {
  Fixture node(slave());
  for (const char* request : {"7E5#04010000000000", "7E5#0401", "7E5#"}) {
    const std::uint32_t before = node.counters().Malformed;
    node.rx(request);
    CHECK(node.counters().Malformed == before + 1);
  }
  node.rx("7E5#5E00000000000000");
  node.silent();
}

TEST_CASE("LSS: requests during the switch of the bit rate are ignored and not answered afterwards [L4]") {
  Configured device;
  device.node.rx("7E5#1564000000000000");
  device.node.rx("7E5#5E00000000000000");
  device.node.after(100ms);
  device.node.rx("7E5#1105000000000000");
  device.node.after(100ms);
  device.node.silent();
  CHECK(device.node->Lss.CfgNodeId == 1);
  device.node.ask("7E5#5E00000000000000", "7E4#5E01000000000000");
}

TEST_CASE("LSS: a node that is stopped during the switch of the bit rate does not change its controller") {
  for (const Time elapsed : {Time{50ms}, Time{150ms}}) {
    Configured device;
    device.node.rx("7E5#1564000000000000");
    device.node.after(elapsed);
    const unsigned before = device.node.can.init_calls;
    device.node.call([&] { CONodeStop(&device.node.node); });
    CHECK(device.node.armed_timers() == 0);
    CHECK(device.node->Transmit.Off == 0);
    device.node.after(1s);
    CHECK(device.node.can.init_calls == before);
  }
}

TEST_CASE("LSS: store passes the pending values to the application, whose result is sent [L5]") {
  Configured device;
  Fixture& node = device.node;
  std::uint32_t baud = 0;
  std::uint8_t id = 0;
  callbacks().lss_store = [&](std::uint32_t stored_baud, std::uint8_t stored_id) {
    baud = stored_baud;
    id = stored_id;
    return CO_ERR_NONE;
  };
  node.ask("7E5#1300020000000000", "7E4#1300000000000000");
  node.ask("7E5#1105000000000000", "7E4#1100000000000000");
  node.ask("7E5#1700000000000000", "7E4#1700000000000000");
  CHECK(baud == 500000);
  CHECK(id == 5);
  callbacks().lss_store = [](std::uint32_t, std::uint8_t) { return CO_ERR_BAD_ARG; };
  node.ask("7E5#1700000000000000", "7E4#1702000000000000");
  CHECK(node.error() == CO_ERR_LSS_STORE);
}

TEST_CASE("LSS: stored node-ID and bit rate are loaded at power-on") {
  callbacks().lss_load = [](std::uint32_t* baud, std::uint8_t* id) {
    CHECK(*baud == 250000);
    CHECK(*id == 1);
    *baud = 125000;
    *id = 9;
    return CO_ERR_NONE;
  };
  Fixture node(slave().stay_in_init());
  CHECK(node.can.baud == 125000);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("709#00");
}

TEST_CASE("LSS: store is answered with not supported by a node without storage [L5]") {
  CO_NODE* device = nullptr;
  callbacks().lss_store = [&](std::uint32_t baud, std::uint8_t id) { return COLssNvmStore(device, 0, baud, id); };
  Configured slave;
  device = &slave.node.node;
  slave.node.ask("7E5#1700000000000000", "7E4#1701000000000000");
  CHECK(slave.node.error() == CO_ERR_LSS_STORE);
  callbacks().lss_store = nullptr;
}

TEST_CASE("LSS: node-ID and bit rate are kept over power off in the memory of the node") {
  FailingNvm nvm({64, 1, 0});
  CO_NODE* device = nullptr;
  callbacks().lss_store = [&](std::uint32_t baud, std::uint8_t id) { return COLssNvmStore(device, 0, baud, id); };
  {
    Fixture node(slave(no_node_id).nvm(FailingNvm::driver, &nvm));
    device = &node.node;
    node.rx(to_configuration);
    node.ask("7E5#1300040000000000", "7E4#1300000000000000");
    node.ask("7E5#1121000000000000", "7E4#1100000000000000");
    node.ask("7E5#1700000000000000", "7E4#1700000000000000");
    nvm.cut_at = nvm.steps + 5;
    node.ask("7E5#1122000000000000", "7E4#1100000000000000");
    node.ask("7E5#1700000000000000", "7E4#1702000000000000");
    CHECK(node.error() == CO_ERR_LSS_STORE);
  }
  nvm.power_up();
  std::uint32_t baud = 250000;
  std::uint8_t id = no_node_id;
  Fixture node(slave().nvm(FailingNvm::driver, &nvm));
  CHECK(COLssNvmLoad(&node.node, 0, &baud, &id) == CO_ERR_NONE);
  CHECK(baud == 125000);
  CHECK(id == 0x21);
  nvm.bytes.assign(nvm.bytes.size(), 0x55);
  CHECK(COLssNvmLoad(&node.node, 0, &baud, &id) == CO_ERR_IF_NVM_READ);
  CHECK(COLssNvmStore(&node.node, 60, baud, id) == CO_ERR_PARA_STORE);
  CHECK(COLssNvmLoad(&node.node, 60, &baud, &id) == CO_ERR_PARA_STORE);
  CHECK(COLssNvmLoad(nullptr, 0, &baud, &id) == CO_ERR_BAD_ARG);
  CHECK(COLssNvmLoad(&node.node, 0, nullptr, &id) == CO_ERR_BAD_ARG);
  CHECK(COLssNvmLoad(&node.node, 0, &baud, nullptr) == CO_ERR_BAD_ARG);
  CHECK(COLssNvmStore(nullptr, 0, baud, id) == CO_ERR_BAD_ARG);
}

TEST_CASE("LSS: a failed load is reported; node-ID and bit rate are kept") {
  SUBCASE("error") {
    callbacks().lss_load = [](std::uint32_t* baud, std::uint8_t*) {
      *baud = 5;
      return CO_ERR_BAD_ARG;
    };
  }
  SUBCASE("node-ID 0") {
    callbacks().lss_load = [](std::uint32_t*, std::uint8_t* id) { return *id = 0, CO_ERR_NONE; };
  }
  SUBCASE("node-ID 128") {
    callbacks().lss_load = [](std::uint32_t*, std::uint8_t* id) { return *id = 128, CO_ERR_NONE; };
  }
  Fixture node(slave());
  CHECK(node.error() == CO_ERR_LSS_LOAD);
  CHECK(node.can.baud == 250000);
  CHECK(node->NodeId == 1);
  callbacks().lss_load = nullptr;
}

TEST_CASE("LSS: inquire returns the four parts of the address and the node-ID [L6]") {
  Configured device(0x7F);
  Fixture& node = device.node;
  node.ask("7E5#5A00000000000000", "7E4#5A19030000000000");
  node.ask("7E5#5B00000000000000", "7E4#5B78563412000000");
  node.ask("7E5#5C00000000000000", "7E4#5C02000100000000");
  node.ask("7E5#5D00000000000000", "7E4#5D44000000000000");
  node.ask("7E5#5E00000000000000", "7E4#5E7F000000000000");
}

TEST_CASE("LSS: identify remote slave: equal vendor-ID and product code, revision and serial number in range [L6]") {
  const std::vector<std::string> right = {"7E5#4619030000000000", "7E5#4778563412000000", "7E5#4802000100000000",
                                          "7E5#4902000100000000", "7E5#4A44000000000000", "7E5#4B44000000000000"};
  const auto identify = [](Fixture& node, const std::vector<std::string>& requests) {
    for (const std::string& request : requests) {
      node.rx(request);
    }
  };
  for (const char* state : {to_waiting, to_configuration}) {
    Fixture node(slave());
    node.rx(state);
    identify(node, right);
    node.tx("7E4#4F00000000000000");
    const char* wrong[] = {"7E5#461A030000000000", "7E5#4779563412000000", "7E5#4803000100000000",
                           "7E5#4901000100000000", "7E5#4A45000000000000", "7E5#4B43000000000000"};
    for (unsigned n = 0; n < 6; ++n) {
      std::vector<std::string> requests = right;
      requests[n] = wrong[n];
      identify(node, requests);
      node.silent();
      requests.erase(requests.begin() + static_cast<std::ptrdiff_t>(n));
      identify(node, requests);
      node.silent();
    }
    identify(node, right);
    node.tx("7E4#4F00000000000000");
  }
}

TEST_CASE("LSS: identify non-configured is answered only by nodes without node-ID [L6] [D50]") {
  Fixture with(slave());
  with.rx("7E5#4C00000000000000");
  with.silent();
  Fixture without(slave(no_node_id));
  without.ask("7E5#4C00000000000000", "7E4#5000000000000000");
}

TEST_CASE("LSS: a node without node-ID sends no boot-up and no heartbeat, and processes only LSS [L7] [D50]") {
  Fixture node(slave(no_node_id).heartbeat(10));
  node.after(1000ms);
  node.silent();
  for (const char* foreign : {"000#0100", "000#8100", "601#4000100000000000", "6FF#4000100000000000", "000#81FF"}) {
    node.rx(foreign);
    node.silent();
  }
  CHECK(node.mode() == CO_INIT);
  node.call([&] { CONmtSetMode(&node->Nmt, CO_OPERATIONAL); });
  CHECK(node.mode() == CO_INIT);
  CHECK(node.error() == CO_ERR_NMT_MODE);
  node.silent();
}

TEST_CASE("LSS: an unconfigured node boots when it is switched to waiting with a pending node-ID [L7]") {
  Fixture node(slave(no_node_id));
  node.rx(to_configuration);
  node.ask("7E5#5E00000000000000", "7E4#5EFF000000000000");
  node.ask("7E5#1120000000000000", "7E4#1100000000000000");
  node.after(100ms);
  node.silent();
  node.ask(to_waiting, "720#00");
  CHECK(node.mode() == CO_PREOP);
  node.ask("620#4000100000000000", "5A0#4300100091010F00");
}

TEST_CASE("LSS: node-ID 255 makes a node unconfigured at the next reset communication") {
  Configured device;
  Fixture& node = device.node;
  node.ask("7E5#11FF000000000000", "7E4#1100000000000000");
  node.rx("000#8201");
  node.silent();
  CHECK(node.mode() == CO_INIT);
  node.ask("7E5#4C00000000000000", "7E4#5000000000000000");
  node.rx(to_configuration);
  node.ask("7E5#1103000000000000", "7E4#1100000000000000");
  node.ask(to_waiting, "703#00");
}

TEST_CASE("LSS: frames of the application are queued until the boot-up message of an unconfigured node") {
  Fixture node(slave(no_node_id));
  const auto send = [&] {
    CO_IF_FRM frm = frame("123#AA");
    COIfCanSend(&node->If, &frm);
  };
  node.call(send);
  node.silent();
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  node.silent();
  node.rx(to_configuration);
  node.ask("7E5#1105000000000000", "7E4#1100000000000000");
  node.rx(to_waiting);
  node.tx({"705#00", "123#AA"});
}

TEST_CASE("LSS: a node that its application stops in COLssLoad() or COLssStore() sends no more frames") {
  Fixture node(slave().heartbeat(10));
  callbacks().lss_load = [&](std::uint32_t*, std::uint8_t*) { return CONodeStop(&node.node), CO_ERR_NONE; };
  node.rx("000#8101");
  callbacks().lss_load = nullptr;
  CHECK(node.mode() == CO_INVALID);
  node.after(100ms);
  node.silent();
  Configured other;
  callbacks().lss_store = [&](std::uint32_t, std::uint8_t) { return CONodeStop(&other.node.node), CO_ERR_NONE; };
  other.node.rx("7E5#1700000000000000");
  other.node.silent();
  CHECK(other.node.mode() == CO_INVALID);
}

TEST_CASE("LSS: the bit rate pending at the time of activation is used, whatever a reset loads meanwhile") {
  callbacks().lss_load = [](std::uint32_t* baud, std::uint8_t*) { return *baud = 500000, CO_ERR_NONE; };
  Fixture node(slave());
  callbacks().lss_load = nullptr;
  node.rx(to_configuration);
  node.ask("7E5#1303000000000000", "7E4#1301000000000000");
  node.ask("7E5#1300030000000000", "7E4#1300000000000000");
  node.rx("7E5#1564000000000000");
  callbacks().lss_load = [](std::uint32_t* baud, std::uint8_t*) { return *baud = 500000, CO_ERR_NONE; };
  node.rx("000#8101");
  callbacks().lss_load = nullptr;
  node.after(300ms);
  node.tx("701#00");
  CHECK(node.can.baud == 250000);
}

TEST_CASE("LSS: the longest switch delay works with a fast timer that cannot count it at once") {
  Fixture node(slave().rate(72000000));
  node.rx(to_configuration);
  node.ask("7E5#1300030000000000", "7E4#1300000000000000");
  node.rx("7E5#15FFFF0000000000");
  CHECK(node.can.init_calls == 1);
  node.after(10ms);
  CHECK(node.can.init_calls == 1);
}

TEST_CASE("LSS: a node-ID that the application sets starts an unconfigured node, and LSS continues") {
  Fixture node(slave(no_node_id));
  node.rx(to_configuration);
  node.call([&] { CONmtSetNodeId(&node->Nmt, 5); });
  node.ask("7E5#5E00000000000000", "7E4#5E05000000000000");
  node.ask(to_waiting, "705#00");
  node.ask("605#4000100000000000", "585#4300100091010F00");
}

TEST_CASE("LSS: before CONodeStart() a node does not answer") {
  for (const std::uint8_t id : {std::uint8_t{1}, no_node_id}) {
    Fixture node(slave(id).stay_in_init());
    node.rx("7E5#4C00000000000000");
    select(node);
    node.rx("7E5#5180000000800000");
    node.silent();
  }
}

TEST_CASE("LSS: without the complete address in 1018h no LSS request is answered") {
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    Fixture node(slave().without(0x1018, sub));
    node.rx(to_configuration);
    node.rx("7E5#5E00000000000000");
    node.silent();
  }
}

TEST_CASE("LSS: frames of a wrong length, remote frames and unknown commands are ignored [L1]") {
  Configured device;
  for (const char* request : {"7E5#", "7E5#5E", "7E5#5E000000000000", "7E5#R", "80007E5#5E00000000000000"}) {
    CAPTURE(request);
    device.node.rx(request);
    device.node.silent();
  }
}

// Sends every command byte in each LSS state, with and without node-ID.
TEST_CASE("LSS: only command specifiers of CiA 305 are answered [L1]") {
  for (const std::uint8_t id : {std::uint8_t{1}, no_node_id}) {
    for (const bool configuration : {false, true}) {
      for (unsigned command = 0; command <= 255; ++command) {
        CAPTURE(command);
        Fixture node(slave(id).only_small());
        node.rx(configuration ? to_configuration : to_waiting);
        CO_IF_FRM request = frame("7E5#0000000000000000");
        request.Data[0] = static_cast<std::uint8_t>(command);
        node.rx(request);
        const bool configures =
            command == 0x11 || command == 0x13 || command == 0x17 || (command >= 0x5A && command <= 0x5E);
        const bool finds = id == no_node_id && (command == 0x4C);
        const auto sent = node.frames();
        CHECK(sent.size() == (((configuration && configures) || finds) ? 1 : 0));
      }
    }
  }
}

TEST_CASE("LSS: services are processed in every NMT state; in Operational if CO_LSS_IN_OPERATIONAL") {
  for (const char* state : {"000#8001", "000#0101", "000#0201"}) {
    Fixture node(slave());
    node.rx(state);
    if (node.mode() == CO_OPERATIONAL && CO_LSS_IN_OPERATIONAL == 0) {
      continue;
    }
    select(node);
    node.tx("7E4#4400000000000000");
    node.ask("7E5#5E00000000000000", "7E4#5E01000000000000");
  }
}

}  // namespace

#endif
