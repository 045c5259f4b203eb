// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "co_ver.h"
#include "support/fixture.hpp"

namespace {

using namespace test;

// Classic drivers -------------------------------------------------------------------------------------------------

struct OldBus {
  unsigned inits;
  unsigned resets;
  unsigned closes;
  unsigned timer_inits;
  unsigned nvm_inits;
  std::uint32_t baud;
  std::uint32_t freq;
  std::deque<CO_IF_FRM> to_node;
  std::deque<CO_IF_FRM> sent;
  std::uint8_t memory[16];
} bus;

void can_init() { ++bus.inits; }
void can_enable(std::uint32_t baud) { bus.baud = baud; }
std::int16_t can_read(CO_IF_FRM* frm) {
  if (bus.to_node.empty()) return 0;
  *frm = bus.to_node.front();
  bus.to_node.pop_front();
  return sizeof(CO_IF_FRM);
}
std::int16_t can_send(CO_IF_FRM* frm) {
  bus.sent.push_back(*frm);
  return sizeof(CO_IF_FRM);
}
void can_reset() { ++bus.resets; }
void can_close() { ++bus.closes; }
void timer_init(std::uint32_t freq) {
  ++bus.timer_inits;
  bus.freq = freq;
}
void timer_reload(std::uint32_t) {}
std::uint32_t timer_delay() { return 0; }
void timer_stop() {}
void timer_start() {}
std::uint8_t timer_update() { return 0; }
void nvm_init() { ++bus.nvm_inits; }
std::uint32_t nvm_read(std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
  std::memcpy(buffer, bus.memory + start, size);
  return size;
}
std::uint32_t nvm_write(std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
  std::memcpy(bus.memory + start, buffer, size);
  return size;
}

const CO_IF_CAN_DRV old_can = {can_init, can_enable, can_read, can_send, can_reset, can_close};
const CO_IF_TIMER_DRV old_timer = {timer_init, timer_reload, timer_delay, timer_stop, timer_start, timer_update};
const CO_IF_NVM_DRV old_nvm = {nvm_init, nvm_read, nvm_write};

struct OldNode {
  std::uint8_t error_register = 0;
  CO_OBJ dictionary[4] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x12345678},
                          {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, &error_register},
                          {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 1},
                          CO_OBJ_DICT_ENDMARK};
  CO_IF_DRV drivers{&old_can, &old_timer, &old_nvm};
  CO_NODE node;
  CO_NODE_SPEC spec = {1, 125000, dictionary, 4, nullptr, nullptr, 0, 100, &drivers, nullptr};

  OldNode() {
    bus = OldBus{};
    std::memset(static_cast<void*>(&node), 0xA5, sizeof node);
  }
  ~OldNode() { callbacks() = Callbacks{}; }
  CO_ERR init() {
    CONodeInit(&node, &spec);
    return CONodeGetErr(&node);
  }
};

TEST_CASE("node: classic drivers are initialised once and the controller is enabled") {
  OldNode n;
  CHECK(n.init() == CO_ERR_NONE);
  CHECK(n.node.Nmt.Mode == CO_INIT);
  CHECK(bus.inits == 1);
  CHECK(bus.timer_inits == 1);
  CHECK(bus.nvm_inits == 1);
  CHECK(bus.baud == 125000);
  CHECK(bus.freq == 100);
  CHECK(bus.sent.empty());
  CONodeStart(&n.node);
  REQUIRE(bus.sent.size() == 1);
  CHECK(notation(bus.sent[0]) == "701#00");
  bus.to_node.push_back(frame("601#4000100000000000"));
  CONodeProcess(&n.node);
  REQUIRE(bus.sent.size() == 2);
  CHECK(notation(bus.sent[1]) == "581#4300100078563412");
  CONodeStop(&n.node);
  CHECK(bus.closes == 1);
}

TEST_CASE("node: no driver for memory is needed") {
  OldNode n;
  n.drivers.Nvm = nullptr;
  CHECK(n.init() == CO_ERR_NONE);
  std::uint8_t byte = 7;
  CHECK(COIfNvmRead(&n.node.If, 0, &byte, 1) == 0);
  CHECK(COIfNvmWrite(&n.node.If, 0, &byte, 1) == 0);
}

TEST_CASE("node: memory is accessed through its driver") {
  OldNode n;
  CHECK(n.init() == CO_ERR_NONE);
  std::uint8_t in[3] = {1, 2, 3};
  std::uint8_t out[3] = {};
  CHECK(COIfNvmWrite(&n.node.If, 5, in, 3) == 3);
  CHECK(COIfNvmRead(&n.node.If, 5, out, 3) == 3);
  CHECK(std::memcmp(in, out, 3) == 0);
}

TEST_CASE("node: the controller is accessed through its driver") {
  OldNode n;
  CHECK(n.init() == CO_ERR_NONE);
  COIfCanReset(&n.node.If);
  CHECK(bus.resets == 1);
  COIfCanClose(&n.node.If);
  CHECK(bus.closes == 1);
  COIfCanEnable(&n.node.If, 500000);
  CHECK(bus.baud == 500000);
  COIfCanEnable(&n.node.If, 0);
  CHECK(bus.baud == n.node.Baudrate);
  CO_IF_FRM frm;
  bus.to_node.push_back(frame("123#11"));
  CHECK(COIfCanRead(&n.node.If, &frm) == sizeof(CO_IF_FRM));
  CHECK(notation(frm) == "123#11");
  CHECK(COIfCanRead(&n.node.If, &frm) == 0);
}

TEST_CASE("node: a wrong node-ID, a missing driver and a timer frequency of 0 are refused") {
  struct Case {
    std::string name;
    CO_ERR error;
    void (*break_it)(OldNode&);
  };
  const Case cases[] = {
      {"node-ID 0", CO_ERR_NODE_ID, [](OldNode& n) { n.spec.NodeId = 0; }},
      {"node-ID 128", CO_ERR_NODE_ID, [](OldNode& n) { n.spec.NodeId = 128; }},
      {"no drivers", CO_ERR_NODE_CAN, [](OldNode& n) { n.spec.Drv = nullptr; }},
      {"no CAN driver", CO_ERR_NODE_CAN, [](OldNode& n) { n.drivers.Can = nullptr; }},
      {"no timer driver", CO_ERR_NODE_TIMER, [](OldNode& n) { n.drivers.Timer = nullptr; }},
      {"timer frequency 0", CO_ERR_NODE_TMR_FREQ, [](OldNode& n) { n.spec.TmrFreq = 0; }},
  };
  for (const Case& one : cases) {
    CAPTURE(one.name);
    OldNode n;
    one.break_it(n);
    CHECK(n.init() == one.error);
    CHECK(n.node.Nmt.Mode == CO_INVALID);
    CONodeStart(&n.node);
    CONodeProcess(&n.node);
    CHECK(bus.sent.empty());
    CONodeStop(&n.node);
  }
}

#if USE_DICT_CHECK

TEST_CASE("node: missing mandatory objects are reported, and the node runs [Q7]") {
  OldNode n;
  n.dictionary[1] = CO_OBJ{CO_KEY(0x1017, 0, CO_OBJ_D___R_), CO_THB_PROD, 0};
  CHECK(n.init() == CO_ERR_CFG_1001_0);
  CONodeStart(&n.node);
  CHECK(bus.sent.size() == 1);
  OldNode m;
  m.dictionary[2] = CO_OBJ CO_OBJ_DICT_ENDMARK;
  CHECK(m.init() == CO_ERR_CFG_1018);
  CONodeStart(&m.node);
  CHECK(bus.sent.size() == 1);
}

#endif

TEST_CASE("node: an object whose Init function fails is reported, and the node runs [Q7]") {
  const auto fails = [](CO_OBJ*, CO_NODE*) -> CO_ERR { return CO_ERR_TYPE_INIT; };
  const CO_OBJ_TYPE type = {nullptr, fails, nullptr, nullptr, nullptr};
  Fixture node(Setup().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &type, 0}).stay_in_init());
  CHECK(node.error() == CO_ERR_OBJ_INIT);
  CHECK(node.mode() == CO_INIT);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
}

TEST_CASE("node: without a dictionary it stays in CO_INVALID with CO_ERR_NODE_DICT and does not start") {
  for (const bool null : {true, false}) {
    CAPTURE(null);
    OldNode n;
    n.spec.Dict = null ? nullptr : n.dictionary;
    n.spec.DictLen = null ? 4 : 0;
    CHECK(n.init() == CO_ERR_NODE_DICT);
    CHECK(n.node.Nmt.Mode == CO_INVALID);
    CONodeStart(&n.node);
    CONodeProcess(&n.node);
    CHECK(n.node.Nmt.Mode == CO_INVALID);
    CHECK(bus.sent.empty());
    CHECK(bus.baud == 0);
    CHECK(CODictFind(&n.node.Dict, CO_DEV(0x1000, 0)) == nullptr);
    CONodeStop(&n.node);
  }
}

TEST_CASE("node: the specification is used only during the initialisation") {
  OldNode n;
  CHECK(n.init() == CO_ERR_NONE);
  std::memset(static_cast<void*>(&n.spec), 0xFF, sizeof n.spec);
  CONodeStart(&n.node);
  bus.to_node.push_back(frame("601#4000100000000000"));
  CONodeProcess(&n.node);
  CHECK(bus.sent.size() == 2);
}

TEST_CASE("node: null arguments are handled") {
  OldNode n;
  CONodeInit(nullptr, &n.spec);
  CONodeInit(&n.node, nullptr);
  CHECK(callbacks().fatal_errors == 2);
  CHECK(CONodeGetErr(nullptr) == CO_ERR_BAD_ARG);
  CHECK(CONodeGetUser(nullptr) == nullptr);
  const CO_NODE_COUNTERS counters = CONodeGetCounters(nullptr);
  CHECK(counters.Received == 0);
  CHECK(counters.CanEvents[CO_CAN_RECOVERED] == 0);
}

TEST_CASE("node: CONodeGetErr returns the last error and clears it") {
  Fixture node;
  node.call([&] { CONmtSetNodeId(&node->Nmt, 3); });
  node.call([&] { COTmrCreate(&node->Tmr, 1, 0, nullptr, nullptr); });
  CHECK(CONodeGetErr(&node.node) == CO_ERR_BAD_ARG);
  CHECK(CONodeGetErr(&node.node) == CO_ERR_NONE);
}

TEST_CASE("node: only reading clears the error") {
  Fixture node(Setup().heartbeat(10));
  node.call([&] { CONmtSetNodeId(&node->Nmt, 3); });
  node.ask("601#4000100000000000", "581#4300100091010F00");
  node.rx("000#0101");
  node.after(10ms);
  node.tx("701#05");
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(node.error() == CO_ERR_NMT_MODE);
}

TEST_CASE("node: the user pointer is returned") {
  Fixture node;
  CHECK(CONodeGetUser(&node.node) == static_cast<void*>(&node));
  OldNode n;
  CHECK(n.init() == CO_ERR_NONE);
  CHECK(CONodeGetUser(&n.node) == nullptr);
}

TEST_CASE("node: lock functions of the extension replace COTmrLock and COTmrUnlock") {
  static int depth;
  static int calls;
  depth = calls = 0;
  OldNode n;
  unsigned global = 0;
  callbacks().lock = [&] { ++global; };
  CO_NODE_EXT ext = {};
  ext.Size = sizeof ext;
  ext.Lock = [](void*) {
    ++depth;
    ++calls;
  };
  ext.Unlock = [](void*) { --depth; };
  CO_TMR_MEM memory[2];
  n.spec.TmrMem = memory;
  n.spec.TmrNum = 2;
  CONodeInitEx(&n.node, &n.spec, &ext);
  CONodeStart(&n.node);
  COTmrDelete(&n.node.Tmr, COTmrCreate(
                               &n.node.Tmr, 5, 0, [](void*) {}, nullptr));
  CHECK(calls > 0);
  CHECK(depth == 0);
  CHECK(global == 0);
}

TEST_CASE("node: several nodes in one program are independent") {
  Fixture one(Setup().node_id(1).heartbeat(10));
  Fixture two(Setup().node_id(2).heartbeat(20));
  one.ask("601#4008100000000000", "581#4108100011000000");
  two.ask("602#2108200008000000", "582#6008200000000000");
  one.rx("000#0100");
  CHECK(one.mode() == CO_OPERATIONAL);
  CHECK(two.mode() == CO_PREOP);
  one.ask("601#6000000000000000", "581#004C65786963616E");
  two.ask("602#0001020304050607", "582#2000000000000000");
  two.rx("602#8008200000000405");
  one.rx("601#8008100000000405");
  one.after(10ms);
  one.tx("701#05");
  two.after(20ms);
  two.tx("702#7F");
}

TEST_CASE("node: reset node and reset communication keep the controller on the bus") {
  Fixture node;
  node.rx("000#8101");
  node.tx("701#00");
  CHECK(node.can.on_bus);
  CHECK(node.can.baud == 250000);
}

TEST_CASE("node: the version functions return the version macros") {
  CHECK(COVerMajor() == CO_VER_MAJOR);
  CHECK(COVerMinor() == CO_VER_MINOR);
  CHECK(COVerBuild() == CO_VER_BUILD);
  CHECK(COVersion() == CO_VER_MAJOR * 10000 + CO_VER_MINOR * 100 + CO_VER_BUILD);
  CO_VerInit();
}

}  // namespace
