// SPDX-License-Identifier: Apache-2.0
// Functions of co_if.h with drivers that have a context argument, and every function with null pointers.
#include <cstring>

#include "support/callbacks.hpp"
#include "support/fixture.hpp"

namespace {

using namespace test;

// Recorded calls of the CAN, timer and NVM drivers, and their results.
struct Recorder {
  unsigned inits = 0;
  unsigned resets = 0;
  unsigned closes = 0;
  std::uint32_t baud = 0;
  std::int16_t read_result = 0;
  CO_IF_FRM received = {};  // frame that Read returns, if read_result is positive
  unsigned reports = 0;
  std::uint8_t memory[8] = {0, 1, 2, 3, 4, 5, 6, 7};
};

Recorder& recorder(void* ctx) { return *static_cast<Recorder*>(ctx); }

const CO_IF_CAN_DRV_EX can_driver = {
    [](void* ctx) { ++recorder(ctx).inits; },
    [](void* ctx, std::uint32_t baud) { recorder(ctx).baud = baud; },
    [](void* ctx, CO_IF_FRM* frm) {
      if (recorder(ctx).read_result > 0) *frm = recorder(ctx).received;
      return recorder(ctx).read_result;
    },
    [](void*, const CO_IF_FRM*) { return static_cast<std::int16_t>(sizeof(CO_IF_FRM)); },
    [](void* ctx) { ++recorder(ctx).resets; },
    [](void* ctx) { ++recorder(ctx).closes; },
    nullptr,
    nullptr,
};

// Reports each error frame as one overrun, whatever it contains.
CO_IF_CAN_DRV_EX with_own_coding() {
  CO_IF_CAN_DRV_EX driver = can_driver;
  driver.Report = [](void* ctx, CO_NODE* node, const CO_IF_FRM* frm) {
    CHECK(frm->Identifier == recorder(ctx).received.Identifier);
    ++recorder(ctx).reports;
    CONodeCanEvent(node, CO_CAN_OVERRUN);
  };
  return driver;
}
const CO_IF_CAN_DRV_EX own_coding = with_own_coding();

const CO_IF_TIMER_DRV_EX timer_driver = {[](void*, std::uint32_t) {}, [](void*) { return std::uint32_t{0}; }, nullptr};

std::uint32_t within(std::uint32_t start, std::uint32_t size) {
  constexpr std::uint32_t capacity = sizeof(Recorder::memory);
  return start >= capacity ? 0 : (size < capacity - start ? size : capacity - start);
}

const CO_IF_NVM_DRV_EX nvm_driver = {
    [](void* ctx) { ++recorder(ctx).inits; },
    [](void* ctx, std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
      std::memcpy(buffer, recorder(ctx).memory + start, within(start, size));
      return within(start, size);
    },
    [](void* ctx, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
      std::memcpy(recorder(ctx).memory + start, buffer, within(start, size));
      return within(start, size);
    },
    nullptr,
    [](void*) {
      return CO_NVM_SHAPE{sizeof(Recorder::memory), 1, 0};
    },
};

struct Device {
  explicit Device(bool with_nvm = true, const CO_IF_CAN_DRV_EX& can_functions = can_driver) {
    ext.Size = sizeof ext;
    ext.Can = &can_functions;
    ext.CanCtx = &can;
    ext.Timer = &timer_driver;
    if (with_nvm) {
      ext.Nvm = &nvm_driver;
      ext.NvmCtx = &nvm;
    }
    CONodeInitEx(&node, &spec, &ext);
    REQUIRE(node.Nmt.Mode == CO_INIT);
  }

  std::uint8_t error_register = 0;
  std::uint32_t vendor = 1;
  CO_OBJ dictionary[3] = {{CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, &error_register},
                          {CO_KEY(0x1018, 1, CO_OBJ_____R_), CO_TUNSIGNED32, &vendor},
                          CO_OBJ_DICT_ENDMARK};
  CO_NODE_SPEC spec = {1, 125000, dictionary, 3, nullptr, nullptr, 0, 1000, nullptr, nullptr};
  CO_NODE_EXT ext = {};
  CO_NODE node;
  Recorder can;
  Recorder nvm;
};

}  // namespace

TEST_CASE("interface: each function calls its driver") {
  Device device;
  CO_IF& cif = device.node.If;
  CHECK(device.can.inits == 1);
  CHECK(device.nvm.inits == 1);
  CHECK(device.can.baud == 125000);

  COIfCanInit(&cif, &device.node);
  COIfCanEnable(&cif, 500000);
  CHECK(device.can.inits == 2);
  CHECK(device.can.baud == 500000);
  CHECK(device.node.Baudrate == 500000);
  COIfCanEnable(&cif, 0);
  CHECK(device.can.baud == 500000);
  COIfCanReset(&cif);
  COIfCanClose(&cif);
  CHECK(device.can.resets == 1);
  CHECK(device.can.closes == 1);

  COIfInit(&cif, &device.node, 100);
  CHECK(device.can.inits == 3);
  CHECK(device.nvm.inits == 2);
}

TEST_CASE("interface: reading distinguishes frames, no frame and errors") {
  Device device;
  CO_IF_FRM frm = {};
  CHECK(COIfCanRead(&device.node.If, &frm) == 0);
  CHECK(CONodeGetErr(&device.node) == CO_ERR_NONE);
  device.can.read_result = -1;
  CHECK(COIfCanRead(&device.node.If, &frm) == -1);
  CHECK(CONodeGetErr(&device.node) == CO_ERR_IF_CAN_READ);
  device.can.read_result = sizeof frm;
  CHECK(COIfCanRead(&device.node.If, &frm) == sizeof frm);
}

TEST_CASE("interface: error frames of a driver without Report are discarded and counted as unclaimed") {
  Device device;
  unsigned events = 0;
  unsigned passed_on = 0;
  callbacks().can_change = [&](CO_NODE*, CO_CAN_EVENT) { ++events; };
  callbacks().can_receive = [&](CO_IF_FRM*) { ++passed_on; };
  CONodeStart(&device.node);
  device.can.read_result = sizeof(CO_IF_FRM);
  for (const char* text : {"20000004#0011000000000000", "20000140#0000000000000000", "20000601#4000100000000000"}) {
    device.can.received = frame(text);
    CONodeProcess(&device.node);
  }
  CHECK(events == 0);
  CHECK(passed_on == 0);
  const CO_NODE_COUNTERS counters = CONodeGetCounters(&device.node);
  CHECK(counters.Received == 3);
  CHECK(counters.Unclaimed == 3);
  for (const std::uint32_t number : counters.CanEvents) CHECK(number == 0);
  callbacks() = {};
}

TEST_CASE("interface: Report of the driver decodes its error frames, with the driver's context") {
  Device device(true, own_coding);
  CONodeStart(&device.node);
  device.can.read_result = sizeof(CO_IF_FRM);
  for (const char* text : {"20000040#0000000000000000", "20000000#"}) {
    device.can.received = frame(text);
    CONodeProcess(&device.node);
  }
  device.can.received = frame("601#4000100000000000");  // no error frame
  CONodeProcess(&device.node);
  CHECK(device.can.reports == 2);
  const CO_NODE_COUNTERS counters = CONodeGetCounters(&device.node);
  CHECK(counters.CanEvents[CO_CAN_OVERRUN] == 2);
  CHECK(counters.CanEvents[CO_CAN_BUS_OFF] == 0);
  CHECK(counters.Unclaimed == 0);
}

TEST_CASE("interface: CONodeCanReport reports nothing for frames of the bus") {
  Device device;
  for (const char* text : {"040#0011000000000000", "00000104#0071000000000000", "144#R"}) {
    const CO_IF_FRM frm = frame(text);
    CONodeCanReport(nullptr, &device.node, &frm);
  }
  for (const std::uint32_t number : CONodeGetCounters(&device.node).CanEvents) CHECK(number == 0);
}

TEST_CASE("interface: reading and writing memory returns the count of the driver, 0 without a driver") {
  Device device;
  std::uint8_t buffer[4] = {};
  CHECK(COIfNvmRead(&device.node.If, 6, buffer, 4) == 2);
  CHECK(buffer[0] == 6);
  CHECK(COIfNvmWrite(&device.node.If, 0, buffer, 2) == 2);
  CHECK(device.nvm.memory[0] == 6);

  Device without(false);
  CHECK(COIfNvmRead(&without.node.If, 0, buffer, 4) == 0);
  CHECK(COIfNvmWrite(&without.node.If, 0, buffer, 4) == 0);
}

TEST_CASE("interface: null pointers return an error and change nothing") {
  Device device;
  CO_IF& cif = device.node.If;
  CO_IF unconnected = {};
  CO_IF_FRM frm = {};
  std::uint8_t buffer[1] = {};
  for (CO_IF* broken : {static_cast<CO_IF*>(nullptr), &unconnected}) {
    CHECK(COIfCanRead(broken, &frm) == -1);
    CHECK(COIfCanSend(broken, &frm) == -1);
    CHECK(COIfNvmRead(broken, 0, buffer, 1) == 0);
    CHECK(COIfNvmWrite(broken, 0, buffer, 1) == 0);
    callbacks().fatal_errors = 0;
    COIfCanEnable(broken, 0);
    COIfCanReset(broken);
    COIfCanClose(broken);
    CHECK(callbacks().fatal_errors == 3);
  }
  CHECK(COIfCanRead(&cif, nullptr) == -1);
  CHECK(COIfCanSend(&cif, nullptr) == -1);
  CHECK(COIfNvmRead(&cif, 0, nullptr, 1) == 0);
  CHECK(COIfNvmWrite(&cif, 0, nullptr, 1) == 0);

  callbacks().fatal_errors = 0;
  COIfInit(nullptr, &device.node, 1);
  COIfInit(&cif, nullptr, 1);
  COIfCanInit(nullptr, &device.node);
  COIfCanInit(&cif, nullptr);
  CHECK(callbacks().fatal_errors == 4);
  CHECK(device.can.inits == 1);
  CHECK(device.can.resets == 0);
  callbacks().fatal_errors = 0;
}

TEST_CASE("timers: null pointers return an error and change nothing") {
  Device device;
  CO_TMR unconnected = {};
  const CO_TMR_FUNC action = [](void*) {};
  CHECK(COTmrGetTicks(nullptr, 1, 1000) == 0);
  CHECK(COTmrGetMinTime(nullptr, 1000) == 0);
  CHECK(COTmrService(nullptr) == -1);
  CHECK(COTmrService(&unconnected) == -1);
  callbacks().fatal_errors = 0;
  for (CO_TMR* broken : {static_cast<CO_TMR*>(nullptr), &unconnected}) {
    CHECK(COTmrCreate(broken, 1, 0, action, nullptr) == -1);
    CHECK(COTmrDelete(broken, 0) == -1);
    COTmrProcess(broken);
  }
  CHECK(callbacks().fatal_errors == 6);
  COTmrInit(nullptr, &device.node, nullptr, 0, 1);
  COTmrInit(&unconnected, nullptr, nullptr, 0, 1);
  CHECK(callbacks().fatal_errors == 8);
  callbacks().fatal_errors = 0;
}

TEST_CASE("node and NMT: null pointers return an error and change nothing") {
  CO_NMT unconnected = {};
  callbacks().fatal_errors = 0;
  CONodeStart(nullptr);
  CONodeStop(nullptr);
  CONodeProcess(nullptr);
  CONodeCanEvent(nullptr, CO_CAN_BUS_OFF);
  CONodeCanReport(nullptr, nullptr, nullptr);
  CHECK(CONodeNextDeadline(nullptr) == UINT32_MAX);
  CHECK(callbacks().fatal_errors == 6);
  for (CO_NMT* broken : {static_cast<CO_NMT*>(nullptr), &unconnected}) {
    CONmtReset(broken, CO_RESET_NODE);
    CONmtSetMode(broken, CO_OPERATIONAL);
    CONmtSetNodeId(broken, 5);
    CHECK(CONmtGetNodeId(broken) == 0);
  }
  CHECK(CONmtGetMode(nullptr) == CO_INVALID);
  CHECK(callbacks().fatal_errors == 15);
  CHECK(CODictGetFault(nullptr, nullptr) == CO_DICT_OK);
  CHECK(CODictObjInit(nullptr, nullptr) == CO_ERR_BAD_ARG);
  CHECK(CODictWrBuffer(nullptr, CO_DEV(0x1000, 0), nullptr, 1) == CO_ERR_BAD_ARG);
  COObjTypeUserSDOAbort(nullptr, nullptr, 1);
  callbacks().fatal_errors = 0;
}

TEST_CASE("ring: null pointers return an error and change nothing") {
  CO_IF_FRM memory[2];
  CO_RING ring;
  REQUIRE(CORingInit(&ring, memory, 2));
  CO_IF_FRM frm = {};
  CHECK_FALSE(CORingPut(nullptr, &frm));
  CHECK_FALSE(CORingPut(&ring, nullptr));
  CHECK_FALSE(CORingGet(nullptr, &frm));
  REQUIRE(CORingPut(&ring, &frm));
  CHECK_FALSE(CORingGet(&ring, nullptr));
  CORingClear(nullptr);
  CHECK(CORingCount(nullptr) == 0);
  CHECK(CORingLost(nullptr) == 0);
  CHECK(CORingCount(&ring) == 1);
}
