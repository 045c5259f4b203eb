// SPDX-License-Identifier: Apache-2.0
// Calls to a node whose initialisation has failed.
#include <cstring>

#include "support/fixture.hpp"

namespace {

using namespace test;

// Calls of the drivers after the failed initialisation.
unsigned sent;
unsigned read;
unsigned enabled;

void nothing() {}
void no_rate(std::uint32_t) {}
void can_enable(std::uint32_t) { ++enabled; }
std::int16_t can_read(CO_IF_FRM* frm) {
  ++read;
  *frm = frame("000#0101");
  return sizeof(CO_IF_FRM);
}
std::int16_t can_send(CO_IF_FRM*) {
  ++sent;
  return sizeof(CO_IF_FRM);
}
std::uint32_t no_ticks() { return 0; }
std::uint8_t elapsed() { return 1; }

const CO_IF_CAN_DRV can = {nothing, can_enable, can_read, can_send, nothing, nothing};
const CO_IF_TIMER_DRV timer = {no_rate, no_rate, no_ticks, nothing, nothing, elapsed};

struct Device {
  std::uint8_t error_register = 0;
  CO_OBJ dictionary[4] = {{CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, &error_register},
                          {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 1},
                          {CO_KEY(0x2000, 0, CO_OBJ_D___RW), CO_TUNSIGNED32, 1},
                          CO_OBJ_DICT_ENDMARK};
  CO_TMR_MEM timers[2];
  CO_IF_DRV drivers{&can, &timer, nullptr};
  CO_NODE_EXT ext{};
  CO_NODE node;
  CO_NODE_SPEC spec = {1, 250000, dictionary, 4, nullptr, timers, 2, 1000, &drivers, nullptr};

  Device() {
    ext.Size = sizeof ext;
    sent = read = enabled = 0;
    std::memset(static_cast<void*>(&node), 0xA5, sizeof node);
    std::memset(static_cast<void*>(timers), 0x5A, sizeof timers);
  }
  ~Device() { callbacks() = Callbacks{}; }
  CO_ERR init() {
    CONodeInitEx(&node, &spec, &ext);
    return CONodeGetErr(&node);
  }
};

std::uint8_t sdo_buffer[CO_SSDO_N * CO_SDO_BUF_BYTE];

#if USE_SDO_BLOCK
void short_sdo_buffer(Device& device) {
  device.spec.SdoBuf = sdo_buffer;
  device.ext.SdoBufLen = sizeof sdo_buffer - 1;
}
#endif

struct Failure {
  std::string name;
  CO_ERR error;
  bool has_drivers;
  void (*cause)(Device&);
};

const std::vector<Failure>& failures() {
  static const std::vector<Failure> all = {
    {"node-ID 0", CO_ERR_NODE_ID, true, [](Device& d) { d.spec.NodeId = 0; }},
    {"node-ID 128", CO_ERR_NODE_ID, true, [](Device& d) { d.spec.NodeId = 128; }},
    {"no drivers", CO_ERR_NODE_CAN, false, [](Device& d) { d.spec.Drv = nullptr; }},
    {"no CAN driver", CO_ERR_NODE_CAN, false, [](Device& d) { d.drivers.Can = nullptr; }},
    {"no timer driver", CO_ERR_NODE_TIMER, false, [](Device& d) { d.drivers.Timer = nullptr; }},
    {"timer frequency 0", CO_ERR_NODE_TMR_FREQ, false, [](Device& d) { d.spec.TmrFreq = 0; }},
    {"extension without size", CO_ERR_NODE_EXT, false, [](Device& d) { d.ext.Size = 0; }},
    {"no dictionary", CO_ERR_NODE_DICT, true, [](Device& d) { d.spec.Dict = nullptr; }},
    {"a dictionary of length 0", CO_ERR_NODE_DICT, true, [](Device& d) { d.spec.DictLen = 0; }},
#if USE_SDO_BLOCK
    {"a short SDO buffer", CO_ERR_NODE_SDO_BUF, true, short_sdo_buffer},
#endif
#if USE_DICT_CHECK
    {"doubled entry", CO_ERR_DICT_INIT, true, [](Device& d) { d.dictionary[1].Key = d.dictionary[0].Key; }},
    {"entry without type", CO_ERR_DICT_INIT, true, [](Device& d) { d.dictionary[1].Type = nullptr; }},
    {"type at a wrong index", CO_ERR_DICT_INIT, true, [](Device& d) { d.dictionary[2].Type = CO_THB_PROD; }},
#endif
  };
  return all;
}

template <class Function>
void with_each_failure(const Function& function) {
  for (const Failure& failure : failures()) {
    CAPTURE(failure.name);
    Device device;
    failure.cause(device);
    CHECK(device.init() == failure.error);
    CHECK(device.node.Nmt.Mode == CO_INVALID);
    function(device.node);
    CHECK(device.node.Nmt.Mode == CO_INVALID);
    CHECK(sent == 0);
    CHECK((failure.has_drivers || read == 0));
    CHECK(enabled == 0);
  }
}

TEST_CASE("CO_NODE_EXT.SdoBufLen: 0, the length of all buffers and any length without a buffer are accepted") {
  for (const std::uint32_t length : {std::uint32_t{0}, std::uint32_t{sizeof sdo_buffer}}) {
    Device device;
    device.spec.SdoBuf = sdo_buffer;
    device.ext.SdoBufLen = length;
    CHECK(device.init() == CO_ERR_NONE);
  }
  Device device;
  device.ext.SdoBufLen = 1;
  CHECK(device.init() == CO_ERR_NONE);
}

TEST_CASE("CONodeInitCtx: does not use classic drivers") {
  Device device;
  CONodeInitCtx(&device.node, &device.spec, &device.ext);
  CHECK(CONodeGetErr(&device.node) == CO_ERR_NODE_CAN);
  CHECK(CONmtGetMode(&device.node.Nmt) == CO_INVALID);
  CONodeInitCtx(&device.node, &device.spec, nullptr);
  CHECK(CONodeGetErr(&device.node) == CO_ERR_NODE_CAN);
  CONodeProcess(&device.node);
  CHECK(read == 0);
}

TEST_CASE("failed initialisation: the node does not start, stops and processes nothing") {
  with_each_failure([](CO_NODE& node) {
    CONodeStart(&node);
    CONodeProcess(&node);
    CONodeStop(&node);
    CONodeProcess(&node);
  });
}

TEST_CASE("failed initialisation: each CONodeProcess() drops and counts a frame if there is a driver") {
  for (const Failure& failure : failures()) {
    CAPTURE(failure.name);
    Device device;
    failure.cause(device);
    CHECK(device.init() == failure.error);
    const unsigned expected = failure.has_drivers ? 3 : 0;
    for (int i = 0; i < 3; ++i) {
      CONodeProcess(&device.node);
    }
    CHECK(read == expected);
    CHECK(CONodeGetCounters(&device.node).Received == expected);
    CHECK(CONodeGetCounters(&device.node).Unclaimed == expected);
    CHECK(CONodeGetErr(&device.node) == CO_ERR_NONE);
    CHECK(device.node.Nmt.Mode == CO_INVALID);
    CHECK(sent == 0);
  }
}

TEST_CASE("failed initialisation: timers can be created, serviced, processed and deleted") {
  with_each_failure([](CO_NODE& node) {
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
    const std::int16_t id = COTmrCreate(
        &node.Tmr, 5, 10, [](void*) {}, nullptr);
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
    CONodeNextDeadline(&node);
    CHECK((id < 0 || COTmrDelete(&node.Tmr, id) == 0));
    COTmrProcess(&node.Tmr);
  });
}

TEST_CASE("failed initialisation: the dictionary can be read") {
  with_each_failure([](CO_NODE& node) {
    std::uint32_t value = 0;
    CODictFind(&node.Dict, CO_DEV(0x2000, 0));
    CODictRdLong(&node.Dict, CO_DEV(0x2000, 0), &value);
    CHECK(CODictFind(&node.Dict, CO_DEV(0x2FFF, 0)) == nullptr);
    CHECK(CODictRdLong(&node.Dict, CO_DEV(0x2FFF, 0), &value) != CO_ERR_NONE);
    CHECK(CODictWrLong(&node.Dict, CO_DEV(0x2FFF, 0), 1) != CO_ERR_NONE);
  });
}

TEST_CASE("failed initialisation: a table that CODictInit() sets can be read, not written") {
  for (const Failure& failure : failures()) {
    if (failure.has_drivers) continue;
    CAPTURE(failure.name);
    Device device;
    failure.cause(device);
    CHECK(device.init() == failure.error);
    static std::uint8_t error_register = 0;
    static std::uint32_t value = 5;
    static CO_OBJ table[] = {{CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, CO_DATA(&error_register)},
                             {CO_KEY(0x3000, 0, CO_OBJ_____RW), CO_TUNSIGNED32, CO_DATA(&value)}};
    CHECK(CODictInit(&device.node.Dict, &device.node, table, 2) == 2);
    std::uint32_t copy = 0;
    CHECK(CODictRdLong(&device.node.Dict, CO_DEV(0x3000, 0), &copy) == CO_ERR_NONE);
    CHECK(CODictWrLong(&device.node.Dict, CO_DEV(0x3000, 0), 1) == CO_ERR_BAD_ARG);
#if CO_HBCONS_N > 0
    static CO_HBCONS consumer = {};
    consumer.Node = &device.node;
    CHECK(CONmtHbConsActivate(&consumer, 100, 5) == CO_ERR_BAD_ARG);
#endif
#if USE_EMCY
    COEmcySet(&device.node.Emcy, 0, nullptr);
#endif
  }
}

TEST_CASE("failed initialisation: resets and changes of the mode are refused") {
  with_each_failure([](CO_NODE& node) {
    unsigned changes = 0;
    callbacks().mode_change = [&](CO_NMT*, CO_MODE) { ++changes; };
    CONmtReset(&node.Nmt, CO_RESET_NODE);
    CONmtReset(&node.Nmt, CO_RESET_COM);
    CONmtSetMode(&node.Nmt, CO_OPERATIONAL);
    CHECK(CONodeGetErr(&node) == CO_ERR_NMT_MODE);
    CONmtSetNodeId(&node.Nmt, 5);
    CHECK(CONodeGetErr(&node) == CO_ERR_NMT_MODE);
    CHECK(changes == 0);
  });
}

TEST_CASE("failed initialisation: sending a frame of the application is refused") {
  with_each_failure([](CO_NODE& node) {
    CO_IF_FRM frm = frame("181#0102");
    CHECK(COIfCanSend(&node.If, &frm) == -1);
    CHECK(node.TxQueue.Num == 0);
    CONodeProcess(&node);
    CHECK(CONodeNextDeadline(&node) == 0xFFFFFFFF);
  });
}

TEST_CASE("failed initialisation: a second, successful one gives a working node until it is stopped") {
  for (const Failure& failure : failures()) {
    CAPTURE(failure.name);
    Device device;
    CO_NODE_SPEC good = device.spec;
    Device wrong;
    failure.cause(wrong);
    CONodeInitEx(&device.node, &wrong.spec, &wrong.ext);
    CHECK(CONodeGetErr(&device.node) == failure.error);
    CONodeInitEx(&device.node, &good, &device.ext);
    CHECK(CONodeGetErr(&device.node) == CO_ERR_NONE);
    CHECK(enabled == 1);
    CONodeStart(&device.node);
    CHECK(sent == 1);
    CONodeStop(&device.node);
    CO_IF_FRM frm = frame("181#0102");
    CHECK(COIfCanSend(&device.node.If, &frm) == -1);
    CHECK(sent == 1);
  }
}

}  // namespace
