// SPDX-License-Identifier: Apache-2.0
// Access hook: the application permits or refuses SDO transfers and NMT commands of the network (co_callbacks.h).
#include "support/access.hpp"

#if USE_ACCESS_HOOK

namespace {

using namespace test;

constexpr std::uint32_t local_control = 0x08000021;
constexpr const char* refused_u8 = "581#8001200021000008";

TEST_CASE("access hook, SDO: each initiate is reported with direction, object, channel, size and data") {
  struct Case {
    const char* request;
    SeenSdo seen;
  };
  const Case cases[] = {
      {"601#4001200000000000", {CO_OBJ_UPLOAD, 0x2001, 0, 0, 0, {}}},
      {"601#2F01200055000000", {CO_OBJ_DOWNLOAD, 0x2001, 0, 0, 1, {0x55}}},
      {"601#2B02200055660000", {CO_OBJ_DOWNLOAD, 0x2002, 0, 0, 2, {0x55, 0x66}}},
      {"601#2304200011223344", {CO_OBJ_DOWNLOAD, 0x2004, 0, 0, 4, {0x11, 0x22, 0x33, 0x44}}},
      {"601#2204200011223344", {CO_OBJ_DOWNLOAD, 0x2004, 0, 0, 0, {0x11, 0x22, 0x33, 0x44}}},
      {"601#2104200004000000", {CO_OBJ_DOWNLOAD, 0x2004, 0, 0, 4, {}}},
      {"601#2004200004000000", {CO_OBJ_DOWNLOAD, 0x2004, 0, 0, 0, {}}},
      {"601#2110210E78563412", {CO_OBJ_DOWNLOAD, 0x2110, 14, 0, 0x12345678, {}}},
      {"601#4033200100000000", {CO_OBJ_UPLOAD, 0x2033, 1, 0, 0, {}}},
  };
  for (const Case& one : cases) {
    CAPTURE(one.request);
    AccessLog log;
    Fixture node(log.setup().with(
        {CO_KEY(0x2110, 14, CO_OBJ_____RW), CO_TVISIBLE_STRING, reinterpret_cast<std::uintptr_t>(&log.text)}));
    node.rx(one.request);
    REQUIRE(log.sdo.size() == 1);
    CHECK(log.sdo[0] == one.seen);
    node.trace();
  }
}

#if USE_SDO_BLOCK
TEST_CASE("access hook, SDO: block transfers are reported like segmented ones, and refused") {
  struct Case {
    const char* request;
    SeenSdo seen;
    const char* refusal;
  };
  const Case cases[] = {
      {"601#C201210179000000", {CO_OBJ_DOWNLOAD, 0x2101, 1, 0, 0x79, {}}, "581#8001210121000008"},
      {"601#C401210179000000", {CO_OBJ_DOWNLOAD, 0x2101, 1, 0, 0, {}}, "581#8001210121000008"},
      {"601#A40121017F000000", {CO_OBJ_UPLOAD, 0x2101, 1, 0, 0, {}}, "581#8001210121000008"},
  };
  for (const Case& one : cases) {
    CAPTURE(one.request);
    AccessLog log;
    Fixture node(log.setup().with(
        {CO_KEY(0x2101, 1, CO_OBJ_____RW), CO_TVISIBLE_STRING, reinterpret_cast<std::uintptr_t>(&log.text)}));
    log.on_sdo = [](CO_NODE&, const CO_ACCESS_SDO&) { return local_control; };
    node.ask(one.request, one.refusal);
    REQUIRE(log.sdo.size() == 1);
    CHECK(log.sdo[0] == one.seen);
    node.after(3s);
    node.silent();  // no transfer is open
  }
}
#endif

TEST_CASE("access hook, SDO: its abort code is sent, and a refused download changes nothing") {
  AccessLog log;
  Fixture node(log.setup());
  log.on_sdo = [](CO_NODE&, const CO_ACCESS_SDO& access) {
    return access.Direction == CO_OBJ_DOWNLOAD ? local_control : 0U;
  };
  node.ask("601#2F01200055000000", refused_u8);
  CHECK(node.objects.u8 == 0x11);
  CHECK(node.error() == CO_ERR_NONE);
  node.ask("601#2101200001000000", refused_u8);
  node.ask("601#0001200000000000", "581#8001200001000405");  // segment without an open transfer
  node.ask("601#4001200000000000", "581#4F01200011000000");
  log.on_sdo = nullptr;
  node.ask("601#2F01200055000000", "581#6001200000000000");
  CHECK(node.objects.u8 == 0x55);
}

TEST_CASE("access hook, SDO: segments of a permitted transfer are not checked; each further initiate is") {
  AccessLog log;
  Fixture node(log.setup());
  node.ask("601#2104200004000000", "581#6004200000000000");
  log.on_sdo = [](CO_NODE&, const CO_ACCESS_SDO&) { return local_control; };
  node.ask("601#0711223344000000", "581#2000000000000000");
  CHECK(node.objects.u32 == 0x44332211);
  CHECK(log.sdo.size() == 1);
  node.ask("601#4008100000000000", "581#8008100021000008");
  CHECK(log.sdo.size() == 2);
}

TEST_CASE("access hook, SDO: a refused initiate ends the transfer that was open") {
  AccessLog log;
  Fixture node(log.setup());
  node.ask("601#4008100000000000", "581#4108100011000000");
  log.on_sdo = [](CO_NODE&, const CO_ACCESS_SDO&) { return local_control; };
  node.ask("601#2F01200055000000", refused_u8);
  node.ask("601#6000000000000000", "581#8000000001000405");
}

TEST_CASE(
    "access hook, SDO: called after the checks of index, sub-index and access right, before that of the length [D]") {
  AccessLog log;
  Fixture node(log.setup());
  log.on_sdo = [](CO_NODE&, const CO_ACCESS_SDO&) { return local_control; };
  node.ask("601#4000400000000000", "581#8000400000000206");
  node.ask("601#4000100500000000", "581#8000100511000906");
  node.ask("601#2331200000000000", "581#8031200002000106");
  node.ask("601#4030200000000000", "581#8030200001000106");
  node.ask("601#4032200000000000", "581#8032200000000106");
  CHECK(log.sdo.empty());
  node.ask("601#2301200011223344", refused_u8);  // 4 bytes to an UNSIGNED8
  node.ask("601#2101200009000000", refused_u8);
  CHECK(log.sdo.size() == 2);
}

TEST_CASE("access hook, SDO: requests to the second server are reported with channel 1") {
  if (CO_SSDO_N < 2) {
    return;
  }
  AccessLog log;
  Fixture node(log.setup());
  node.ask("601#2301120110030000", "581#6001120100000000");
  node.ask("601#2301120220030000", "581#6001120200000000");
  log.sdo.clear();
  log.on_sdo = [](CO_NODE&, const CO_ACCESS_SDO& access) { return access.Channel == 1 ? local_control : 0U; };
  node.ask("310#4001200000000000", "320#8001200021000008");
  node.ask("601#4001200000000000", "581#4F01200011000000");
  REQUIRE(log.sdo.size() == 2);
  CHECK(log.sdo[0].channel == 1);
  CHECK(log.sdo[1].channel == 0);
}

TEST_CASE("access hook, SDO: any abort code that it returns is sent unchanged, every time") {
  AccessLog log;
  Fixture node(log.setup());
  for (const std::uint32_t code : {1U, 0x06010000U, 0xFFFFFFFFU, 0x80000000U}) {
    log.on_sdo = [&](CO_NODE&, const CO_ACCESS_SDO&) { return code; };
    CO_IF_FRM abort = frame("581#8001200000000000");
    CO_SET_LONG(&abort, code, 4);
    node.rx("601#4001200000000000");
    node.tx(notation(abort));
  }
}

TEST_CASE("access hook, SDO: accesses of the application are not checked") {
  AccessLog log;
  Fixture node(log.setup().may_change(0x2001, 0));
  log.on_sdo = [](CO_NODE&, const CO_ACCESS_SDO&) { return local_control; };
  node.call([&] {
    std::uint8_t value = 0;
    CHECK(CODictRdByte(&node->Dict, CO_DEV(0x2001, 0), &value) == CO_ERR_NONE);
    CHECK(CODictWrByte(&node->Dict, CO_DEV(0x2001, 0), 0x77) == CO_ERR_NONE);
    CHECK(value == 0x11);
  });
  CHECK(node.objects.u8 == 0x77);
#if USE_OD
  node.call([&] {
    std::uint8_t value = 0;
    CHECK(OD_get_u8(OD_find(&node.od, 0x2001), 0, &value, false) == ODR_OK);
    CHECK(value == 0x77);
  });
#endif
  CHECK(log.sdo.empty());
}

#if USE_CSDO && USE_CSDO_OWN
std::uint32_t own_result;

TEST_CASE("access hook, SDO: accesses of an SDO client to its own node are not checked") {
  AccessLog log;
  Fixture node(log.setup()
                   .with({CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 3})
                   .with({CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x601})
                   .with({CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x581})
                   .with({CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, 1})
                   .may_change(0x2001, 0));
  log.on_sdo = [](CO_NODE&, const CO_ACCESS_SDO&) { return local_control; };
  own_result = 1;
  std::uint8_t value = 0x66;
  node.call([&] {
    const auto done = [](CO_CSDO*, std::uint16_t, std::uint8_t, std::uint32_t code) { own_result = code; };
    CHECK(COCSdoRequestDownload(COCSdoFind(&node.node, 0), CO_DEV(0x2001, 0), &value, 1, done, 1000) == CO_ERR_NONE);
  });
  node.after(10ms);
  CHECK(own_result == 0);
  CHECK(node.objects.u8 == 0x66);
  CHECK(log.sdo.empty());
}
#endif

TEST_CASE("access hook, SDO: a reset that it requests is carried out after the answer") {
  AccessLog log;
  Fixture node(log.setup());
  node.frames_per_call(2);
  for (const CO_NMT_RESET type : {CO_RESET_COM, CO_RESET_NODE}) {
    log.on_sdo = [&](CO_NODE& self, const CO_ACCESS_SDO&) {
      CONmtReset(&self.Nmt, type);
      return 0U;
    };
    node.rx("601#2F01200055000000");
    node.tx({"581#6001200000000000", "701#00"});
    log.on_sdo = [&](CO_NODE& self, const CO_ACCESS_SDO&) {
      CONmtReset(&self.Nmt, type);
      return local_control;
    };
    node.rx("601#2F01200056000000");
    node.tx({refused_u8, "701#00"});
    CHECK(node.objects.u8 == 0x55);
    CHECK(node.mode() == CO_PREOP);
  }
}

TEST_CASE("access hook, SDO: a node that it stops sends no answer") {
  for (const char* request : {"601#2F01200055000000", "601#2104200004000000", "601#4008100000000000"}) {
    CAPTURE(request);
    AccessLog log;
    Fixture node(log.setup().may_change(0x2001, 0));
    log.on_sdo = [](CO_NODE& self, const CO_ACCESS_SDO&) {
      CONodeStop(&self);
      return 0U;
    };
    node.rx(request);
    node.silent();
    CHECK(node.mode() == CO_INVALID);
    CHECK(node.armed_timers() == 0);
  }
}

TEST_CASE("access hook, SDO: if it sets the state Stopped the request is answered before") {
  AccessLog log;
  Fixture node(log.setup());
  log.on_sdo = [](CO_NODE& self, const CO_ACCESS_SDO&) {
    CONmtSetMode(&self.Nmt, CO_STOP);
    return 0U;
  };
  node.ask("601#2F01200055000000", "581#6001200000000000");
  CHECK(node.objects.u8 == 0x55);
  CHECK(node.mode() == CO_STOP);
  log.on_sdo = nullptr;
  node.rx("000#8001");
  node.ask("601#2F01200055000000", "581#6001200000000000");
}

TEST_CASE("access hook, SDO: it may write the object, but not replace the dictionary of the node") {
  AccessLog log;
  static std::uint8_t other = 0x33;
  static std::uint8_t error_register = 0;
  static CO_OBJ dictionary[] = {{CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, CO_DATA(&error_register)},
                                {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TUNSIGNED8, CO_DATA(&other)},
                                CO_OBJ_DICT_ENDMARK};
  Fixture node(log.setup().may_change(0x2001, 0));
  log.on_sdo = [&](CO_NODE& self, const CO_ACCESS_SDO&) {
    CHECK(CODictWrByte(&self.Dict, CO_DEV(0x2001, 0), 0x44) == CO_ERR_NONE);
    return 0U;
  };
  node.ask("601#4001200000000000", "581#4F01200044000000");
  log.on_sdo = [&](CO_NODE& self, const CO_ACCESS_SDO&) {
    CHECK(CODictInit(&self.Dict, &self, dictionary, 3) == -1);
    return 0U;
  };
  node.ask("601#4001200000000000", "581#4F01200044000000");
  CHECK(node.error() == CO_ERR_DICT_BUSY);
  log.on_sdo = nullptr;
  node.ask("601#4002200000000000", "581#4B02200011220000");
}

TEST_CASE("access hook, SDO: it is called for 1010h and 1011h like for any other object") {
  AccessLog log;
  static std::uint32_t stored = 1;
  static const CO_PARA group = {0,       4,          reinterpret_cast<std::uint8_t*>(&stored), nullptr, CO_RESET_NODE,
                                nullptr, CO_PARA___E};
  Fixture node(log.setup()
                   .with({CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 1})
                   .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, CO_DATA(&group)})
                   .with({CO_KEY(0x1011, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 1})
                   .with({CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, CO_DATA(&group)}));
  log.on_sdo = [](CO_NODE&, const CO_ACCESS_SDO&) { return local_control; };
  node.ask("601#2310100173617665", "581#8010100121000008");
  node.ask("601#231110016C6F6164", "581#8011100121000008");
  REQUIRE(log.sdo.size() == 2);
  CHECK(log.sdo[0] == SeenSdo{CO_OBJ_DOWNLOAD, 0x1010, 1, 0, 4, {0x73, 0x61, 0x76, 0x65}});
}

// NMT ----------------------------------------------------------------------------------------------------------------

TEST_CASE("access hook, NMT: a command that it refuses is ignored") {
  struct Case {
    const char* command;
    std::uint8_t specifier;
    std::uint8_t id;
  };
  for (const Case& one : {Case{"000#0101", 1, 1}, Case{"000#0201", 2, 1}, Case{"000#0100", 1, 0},
                          Case{"000#8001", 128, 1}, Case{"000#8101", 129, 1}, Case{"000#8201", 130, 1}}) {
    CAPTURE(one.command);
    AccessLog log;
    Fixture node(log.setup());
    log.on_nmt = [](CO_NODE&, const CO_ACCESS_NMT&) { return std::uint8_t{1}; };
    const CO_NODE_COUNTERS before = node.counters();
    node.rx(one.command);
    node.silent();
    CHECK(node.mode() == CO_PREOP);
    CHECK(node.counters().Malformed == before.Malformed);
    REQUIRE(log.nmt.size() == 1);
    CHECK(log.nmt[0] == std::pair<std::uint8_t, std::uint8_t>{one.specifier, one.id});
  }
}

TEST_CASE("access hook, NMT: a command that it permits is carried out") {
  AccessLog log;
  Fixture node(log.setup());
  node.rx("000#0101");
  CHECK(node.mode() == CO_OPERATIONAL);
  node.ask("000#8100", "701#00");
  CHECK(log.nmt.size() == 2);
}

TEST_CASE("access hook, NMT: not called for commands to other nodes, of wrong length or with an unknown specifier") {
  AccessLog log;
  Fixture node(log.setup());
  for (const char* command : {"000#0102", "000#01", "000#010100", "000#0001", "000#0301", "000#7F01", "000#8301"}) {
    node.rx(command);
  }
  CHECK(log.nmt.empty());
}

TEST_CASE("access hook, NMT: commands of the application are not checked") {
  AccessLog log;
  Fixture node(log.setup().nmt_master());
  log.on_nmt = [](CO_NODE&, const CO_ACCESS_NMT&) { return std::uint8_t{1}; };
  node.call([&] { CONmtSetMode(&node->Nmt, CO_OPERATIONAL); });
  CHECK(node.mode() == CO_OPERATIONAL);
#if USE_NMT_MASTER
  node.call([&] { CHECK(CONmtCommand(&node->Nmt, CO_NMT_COMMAND_STOP, 0) == CO_ERR_NONE); });
  node.tx("000#0200");
  CHECK(node.mode() == CO_STOP);
#endif
  CHECK(log.nmt.empty());
}

TEST_CASE("access hook, NMT: it may change the NMT state, reset and stop the node itself") {
  AccessLog log;
  Fixture node(log.setup());
  SUBCASE("reset in the hook, and the command is refused") {
    log.on_nmt = [](CO_NODE& self, const CO_ACCESS_NMT&) {
      CONmtReset(&self.Nmt, CO_RESET_COM);
      return std::uint8_t{1};
    };
    node.ask("000#0101", "701#00");
    CHECK(node.mode() == CO_PREOP);
  }
  SUBCASE("the command is carried out after the state that the hook sets") {
    log.on_nmt = [](CO_NODE& self, const CO_ACCESS_NMT&) {
      CONmtSetMode(&self.Nmt, CO_STOP);
      return std::uint8_t{0};
    };
    node.rx("000#0101");
    CHECK(node.mode() == CO_OPERATIONAL);
  }
  SUBCASE("a node that the hook stops stays stopped") {
    log.on_nmt = [](CO_NODE& self, const CO_ACCESS_NMT&) {
      CONodeStop(&self);
      return std::uint8_t{0};
    };
    for (const char* command : {"000#0101", "000#8101"}) {
      node.rx(command);
      node.silent();
      CHECK(node.mode() == CO_INVALID);
    }
  }
}

TEST_CASE("access hook: a table without the functions permits everything") {
  static const CO_CALLBACKS nothing{};
  Fixture node(Setup().callbacks(nothing));
  node.ask("601#2F01200055000000", "581#6001200000000000");
  node.rx("000#0101");
  CHECK(node.mode() == CO_OPERATIONAL);
}

}  // namespace

#endif
