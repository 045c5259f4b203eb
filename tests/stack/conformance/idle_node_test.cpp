// SPDX-License-Identifier: Apache-2.0
// Every function of the headers, called for a node that does not run: of zeros, while it is being initialised, after an
// initialisation that has failed, and stopped. No function reads or calls through a pointer that is not set; what
// cannot work returns its error or does nothing.
#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "support/fixture.hpp"

#if CO_TPDO_N > 0 && CO_RPDO_N > 0

namespace {

using namespace test;

// --- The node, with a driver that counts the frames sent

std::int16_t send(void* sent, const CO_IF_FRM*) { return ++*static_cast<unsigned*>(sent), sizeof(CO_IF_FRM); }

const CO_IF_CAN_DRV_EX can = {[](void*) {},
                              [](void*, std::uint32_t) {},
                              [](void*, CO_IF_FRM*) -> std::int16_t { return 0; },
                              send,
                              [](void*) {},
                              [](void*) {},
                              nullptr,
                              nullptr};
const CO_IF_TIMER_DRV_EX timer = {[](void*, std::uint32_t) {}, [](void*) -> std::uint32_t { return 0; }, nullptr};

struct Variables {
  std::uint8_t error_register = 0, type = 254, number = 1, a8 = 1, direction = 1, one = 8, valid = 0xA5;
  std::uint16_t heartbeat = 100, inhibit = 0, cycle = 50;
  std::uint32_t tpdo = 0x40000181, rpdo = 0x201, map = 0x20000008, emcy = 0x81, history = 0;
  CO_HBCONS consumer = {};
  std::uint8_t memory[8] = {};
  CO_OBJ_DOM domain = {0, 8, memory};
  CO_OBJ_STR_RW text = {0, 4, 8, memory};
};

struct Node {
  CO_NODE node = {};
  unsigned sent = 0;  // frames
  Variables v;
  std::array<CO_TMR_MEM, 4> timers = {};
  std::array<CO_EMCY_TBL, 2> errors = {{{CO_EMCY_REG_TEMP, 0x4200}, {CO_EMCY_REG_VOLTAGE, 0x3100}}};
  std::array<std::uint8_t, CO_SSDO_N* CO_SDO_BUF_BYTE> buffer = {};
  std::vector<CO_OBJ> table = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
                               {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, &v.error_register},
#if USE_EMCY
                               {CO_KEY(0x1014, 0, CO_OBJ_____RW), CO_TEMCY_ID, &v.emcy},
#endif
                               {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, &v.heartbeat},
                               {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 1},
                               {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 1},
                               {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 2},
                               {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, CO_COBID_SDO_REQUEST()},
                               {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, CO_COBID_SDO_RESPONSE()},
                               {CO_KEY(0x1400, 1, CO_OBJ_____RW), CO_TPDO_ID, &v.rpdo},
                               {CO_KEY(0x1400, 2, CO_OBJ_____RW), CO_TPDO_TYPE, &v.type},
                               {CO_KEY(0x1600, 0, CO_OBJ_____RW), CO_TPDO_NUM, &v.number},
                               {CO_KEY(0x1600, 1, CO_OBJ_____RW), CO_TPDO_MAP, &v.map},
                               {CO_KEY(0x1800, 1, CO_OBJ_____RW), CO_TPDO_ID, &v.tpdo},
                               {CO_KEY(0x1800, 2, CO_OBJ_____RW), CO_TPDO_TYPE, &v.type},
                               {CO_KEY(0x1A00, 0, CO_OBJ_____RW), CO_TPDO_NUM, &v.number},
                               {CO_KEY(0x1A00, 1, CO_OBJ_____RW), CO_TPDO_MAP, &v.map},
                               {CO_KEY(0x2000, 0, CO_OBJ___APRW), CO_TUNSIGNED8, &v.a8},
#if USE_OD
                               {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TDOMAIN, &v.domain},
                               {CO_KEY(0x2002, 0, CO_OBJ_____RW), CO_TVISIBLE_STRING, &v.text},
                               {CO_KEY(0x2003, 0, CO_OBJ_____RW), OD_TUNSIGNED32, &v.history},
                               {CO_KEY(0x2004, 0, CO_OBJ_____RW), OD_TDOMAIN, &v.domain},
                               {CO_KEY(0x2005, 0, CO_OBJ_____RW), OD_TVISIBLE_STRING, &v.text},
#endif
                               CO_OBJ_DICT_ENDMARK};
  CO_NODE_EXT ext = {};
  CO_NODE_SPEC spec = {};

  Node() {
    ext.Size = sizeof ext;
    ext.Can = &can;
    ext.CanCtx = &sent;
    ext.Timer = &timer;
    spec.NodeId = 1;
    spec.Dict = table.data();
    spec.DictLen = static_cast<std::uint16_t>(table.size());
    spec.EmcyCode = errors.data();
    spec.TmrMem = timers.data();
    spec.TmrNum = static_cast<std::uint16_t>(timers.size());
    spec.TmrFreq = 1000;
    spec.SdoBuf = buffer.data();
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  void init() { CONodeInitCtx(&node, &spec, &ext); }
};

// --- All functions that have a node as an argument, or a part of one

using Function = std::function<void(Node& of)>;

template <class... T>
void ignore(const T&...) {}

CO_OBJ* entry(Node& of) {
  return &*std::find_if(of.table.begin(), of.table.end(),
                        [](const CO_OBJ& obj) { return CO_GET_IDX(obj.Key) == 0x2000; });
}
std::uint8_t bytes[16];
std::uint32_t number;
CO_IF_FRM frame = {0x123, {}, 8};
[[maybe_unused]] CO_TIME_OF_DAY time_of_day = {1, 2};
void action(void*) {}

// A function that calls another one for each entry of the table.
Function for_entries(const std::function<void(CO_OBJ* obj, CO_NODE* node)>& call) {
  return [call](Node& of) {
    for (CO_OBJ& obj : of.table) {
      call(&obj, &of.node);
    }
  };
}
constexpr std::uint32_t key = CO_DEV(0x2000, 0);

const Function functions[] = {
    // co_core.h
    [](Node& of) { CONodeStart(&of.node); },
    [](Node& of) { CONodeStop(&of.node); },
    [](Node& of) { CONodeProcess(&of.node); },
    [](Node& of) { ignore(CONodeGetErr(&of.node)); },
    [](Node& of) { ignore(CONodeGetErrKey(&of.node)); },
    [](Node& of) { ignore(CONodeNextDeadline(&of.node)); },
    [](Node& of) { CONodeCanEvent(&of.node, CO_CAN_BUS_OFF); },
    [](Node& of) { CONodeCanEvent(&of.node, CO_CAN_OVERRUN); },
    [](Node& of) { ignore(CONodeGetCounters(&of.node)); },
    [](Node& of) { ignore(CONodeSetStatus(&of.node, 1)); },
    [](Node& of) { ignore(CONodeGetStatus(&of.node)); },
    [](Node& of) { ignore(CONodeGetUser(&of.node)); },
#if USE_REAL_TIME
    [](Node& of) { CONodeRealTime(&of.node); },
#endif
    // co_dict.h, co_obj.h
    [](Node& of) { ignore(CODictFind(&of.node.Dict, key)); },
    [](Node& of) { ignore(CODictRdByte(&of.node.Dict, key, bytes)); },
    [](Node& of) { ignore(CODictRdLong(&of.node.Dict, key, &number)); },
    [](Node& of) { ignore(CODictWrByte(&of.node.Dict, key, 2)); },
    [](Node& of) { ignore(CODictWrLong(&of.node.Dict, key, 2)); },
    [](Node& of) { ignore(CODictRdBuffer(&of.node.Dict, key, bytes, 1)); },
    [](Node& of) { ignore(CODictWrBuffer(&of.node.Dict, key, bytes, 1)); },
    [](Node& of) { ignore(CODictInit(&of.node.Dict, &of.node, of.table.data(), of.spec.DictLen)); },
    [](Node& of) { ignore(CODictObjInit(&of.node.Dict, &of.node)); },
    [](Node& of) { ignore(CODictGetFault(&of.node.Dict, &number)); },
    for_entries([](CO_OBJ* obj, CO_NODE* node) { ignore(COObjGetSize(obj, node, 1)); }),
    for_entries([](CO_OBJ* obj, CO_NODE* node) { ignore(COObjInit(obj, node)); }),
    for_entries([](CO_OBJ* obj, CO_NODE* node) { ignore(COObjReset(obj, node, 0)); }),
    for_entries([](CO_OBJ* obj, CO_NODE* node) { ignore(COObjRdValue(obj, node, bytes, 1)); }),
    for_entries([](CO_OBJ* obj, CO_NODE* node) { ignore(COObjWrValue(obj, node, bytes, 1)); }),
    for_entries([](CO_OBJ* obj, CO_NODE* node) { ignore(COObjRdBufStart(obj, node, bytes, 1)); }),
    for_entries([](CO_OBJ* obj, CO_NODE* node) { ignore(COObjRdBufCont(obj, node, bytes, 4)); }),
    for_entries([](CO_OBJ* obj, CO_NODE* node) { ignore(COObjWrBufStart(obj, node, bytes, 1)); }),
    for_entries([](CO_OBJ* obj, CO_NODE* node) { ignore(COObjWrBufCont(obj, node, bytes, 4)); }),
    [](Node& of) { COObjTypeUserSDOAbort(entry(of), &of.node, 1); },
    // co_if.h
    [](Node& of) { COIfInit(&of.node.If, &of.node, 1000); },
    [](Node& of) { COIfCanInit(&of.node.If, &of.node); },
    [](Node& of) { COIfCanEnable(&of.node.If, 0); },
    [](Node& of) { ignore(COIfCanRead(&of.node.If, &frame)); },
    [](Node& of) { ignore(COIfCanSend(&of.node.If, &frame)); },
    [](Node& of) { COIfCanReset(&of.node.If); },
    [](Node& of) { COIfCanClose(&of.node.If); },
    [](Node& of) { ignore(COIfNvmRead(&of.node.If, 0, bytes, 1)); },
    [](Node& of) { ignore(COIfNvmWrite(&of.node.If, 0, bytes, 1)); },
    [](Node& of) { CONodeCanReport(nullptr, &of.node, &frame); },
    // co_nmt.h, co_heartbeat.h
    [](Node& of) { CONmtReset(&of.node.Nmt, CO_RESET_NODE); },
    [](Node& of) { CONmtReset(&of.node.Nmt, CO_RESET_COM); },
    [](Node& of) { CONmtSetMode(&of.node.Nmt, CO_OPERATIONAL); },
    [](Node& of) { CONmtSetMode(&of.node.Nmt, CO_PREOP); },
    [](Node& of) { ignore(CONmtGetMode(&of.node.Nmt)); },
    [](Node& of) { CONmtSetNodeId(&of.node.Nmt, 5); },
    [](Node& of) { ignore(CONmtGetNodeId(&of.node.Nmt)); },
    [](Node& of) { ignore(COErrorBehaviour(&of.node, 1)); },
#if CO_HBCONS_N > 0
    [](Node& of) { ignore(CONmtGetHbEvents(&of.node.Nmt, 2)); },
    [](Node& of) { ignore(CONmtLastHbState(&of.node.Nmt, 2)); },
    [](Node& of) { ignore(CONmtHbConsActivate(&of.v.consumer, 100, 2)); },
#endif
#if USE_NMT_MASTER
    [](Node& of) { ignore(CONmtCommand(&of.node.Nmt, CO_NMT_COMMAND_START, 2)); },
#endif
    // co_pdo.h
    [](Node& of) { COTPdoTrigPdo(of.node.TPdo, 0); },
    [](Node& of) { COTPdoTrigObj(of.node.TPdo, entry(of)); },
    [](Node& of) { ignore(COTPdoRequest(&of.node, 0)); },
    [](Node& of) { ignore(CORPdoWasReceived(&of.node, 0)); },
    [](Node& of) { ignore(COTPdoWasSent(&of.node, 0)); },
    [](Node& of) { ignore(CORPdoObjWasReceived(&of.node, entry(of))); },
    [](Node& of) { ignore(COTPdoObjWasSent(&of.node, entry(of))); },
#if CO_MPDO_N > 0
    [](Node& of) { ignore(COTPdoSendTo(&of.node, 0, 2, key, 1)); },
#endif
    // co_tmr.h
    [](Node& of) { ignore(COTmrGetTicks(&of.node.Tmr, 1, CO_TMR_UNIT_1MS)); },
    [](Node& of) { ignore(COTmrGetMinTime(&of.node.Tmr, CO_TMR_UNIT_1MS)); },
    [](Node& of) { ignore(COTmrCreate(&of.node.Tmr, 1, 0, action, nullptr)); },
    [](Node& of) { ignore(COTmrDelete(&of.node.Tmr, 0)); },
    [](Node& of) { ignore(COTmrService(&of.node.Tmr)); },
    [](Node& of) { COTmrProcess(&of.node.Tmr); },
#if USE_EMCY
    [](Node& of) { COEmcySet(&of.node.Emcy, 0, nullptr); },
    [](Node& of) { COEmcyClr(&of.node.Emcy, 0); },
    [](Node& of) { ignore(COEmcyGet(&of.node.Emcy, 0)); },
    [](Node& of) { ignore(COEmcyCnt(&of.node.Emcy)); },
    [](Node& of) { COEmcyReset(&of.node.Emcy, 0); },
    [](Node& of) { COEmcyHistReset(&of.node.Emcy); },
#endif
#if USE_TIME
    [](Node& of) { ignore(COTimeSet(&of.node, &time_of_day)); },
    [](Node& of) { ignore(COTimeGet(&of.node, &time_of_day)); },
    [](Node& of) { ignore(COTimeSend(&of.node)); },
    [](Node& of) { ignore(COTimeProduce(&of.node, 100)); },
#endif
#if USE_GFC
    [](Node& of) { ignore(COGfcSend(&of.node)); },
#endif
#if USE_LED
    [](Node& of) { COLedStart(&of.node); },
    [](Node& of) { COLedSet(&of.node, 1, true); },
#endif
#if CO_SRDO_N > 0
    [](Node& of) { ignore(COSrdoGetState(&of.node, 0)); },
    [](Node& of) { ignore(COSrdoIsEstablished(&of.node)); },
    [](Node& of) { ignore(COSrdoRequest(&of.node, 0)); },
    [](Node& of) {
      std::uint16_t signature = 0;
      ignore(COSrdoSignature(&of.node, 0, &signature));
    },
#endif
#if USE_CSDO
    [](Node& of) { ignore(COCSdoFind(&of.node, 0)); },
    [](Node& of) { ignore(COCSdoRequestUpload(of.node.CSdo, key, bytes, 1, nullptr, 100)); },
    [](Node& of) { ignore(COCSdoRequestDownload(of.node.CSdo, key, bytes, 1, nullptr, 100)); },
    [](Node& of) { ignore(COCSdoCancel(of.node.CSdo)); },
    [](Node& of) { ignore(COCSdoGetNum(of.node.CSdo)); },
    [](Node& of) { ignore(COCSdoGetTotal(of.node.CSdo)); },
#endif
#if USE_LSS_MASTER
    [](Node& of) { ignore(COLssmSwitchGlobal(&of.node.Lssm, 1, nullptr)); },
    [](Node& of) { ignore(COLssmFastscan(&of.node.Lssm, nullptr, 0, nullptr)); },
    [](Node& of) { ignore(COLssmSetTimes(&of.node.Lssm, 100, 10)); },
    [](Node& of) { ignore(COLssmStore(&of.node.Lssm, nullptr)); },
    [](Node& of) { ignore(COLssmCancel(&of.node.Lssm)); },
#endif
#if USE_PARA
    [](Node& of) { ignore(CONodeParaLoad(&of.node, CO_RESET_NODE)); },
    [](Node& of) {
      static std::uint8_t value = 0;
      static const CO_PARA group = {0, 1, &value, nullptr, CO_RESET_NODE, nullptr, CO_PARA___E};
      ignore(COParaStore(&group, &of.node), COParaRestore(&group, &of.node));
    },
#endif
#if USE_RECORDER
    [](Node& of) {
      static CO_RECORDER recorder;
      ignore(CORecorderStart(&of.node, &recorder), CORecorderSample(&recorder), CORecorderCount(&recorder));
    },
#endif
#if USE_OD
    [](Node& of) { OD_lock(&of.node), OD_unlock(&of.node); },
    [](Node& of) {
      static OD_t od;
      static OD_entry_t list[32];
      static std::uint8_t value = 0;
      ignore(OD_init(&od, list, 32, &of.node, of.table.data(), of.spec.DictLen));
      for (std::uint16_t index = 0x2000; index < 0x2006; ++index) {
        OD_entry_t* const at = OD_find(&od, index);
        ignore(OD_get_value(at, 0, &value, 1, false), OD_set_value(at, 0, &value, 1, false));
        OD_IO_t io = {};
        OD_size_t done = 0;
        if (OD_getSub(at, 0, &io, false) == ODR_OK) {
          ignore(io.read(&io.stream, bytes, 4, &done));
          OD_rwRestart(&io.stream);
          ignore(io.write(&io.stream, bytes, 4, &done));
        }
        OD_requestTPDO(at, 0);
        ignore(OD_TPDOtransmitted(at, 0));
      }
    },
#endif
};

// Calls a function of a node that is in CO_INVALID, which sends nothing.
void call_in_invalid(Node& of, unsigned function) {
  of.sent = 0;
  functions[function](of);
  CHECK(CONmtGetMode(&of.node.Nmt) == CO_INVALID);
  CONodeProcess(&of.node);
  COTmrProcess(&of.node.Tmr);
  CHECK(of.sent == 0);
}

TEST_CASE("idle node: every function of a node of zeros returns") {
  for (unsigned n = 0; n < std::size(functions); ++n) {
    CAPTURE(n);
    Node of;
    call_in_invalid(of, n);
    of.init();
    CHECK(CONodeGetErr(&of.node) == CO_ERR_NONE);
  }
}

TEST_CASE("idle node: every function returns in CONmtModeChange() while the node is initialised") {
  for (unsigned n = 0; n < std::size(functions); ++n) {
    CAPTURE(n);
    Node of;
    bool is_first = true;
    callbacks().mode_change = [&](CO_NMT*, CO_MODE to) {
      if (std::exchange(is_first, false)) {
        CHECK(to == CO_INIT);
        functions[n](of);
      }
    };
    of.init();
    CONodeStart(&of.node);
    CHECK_FALSE(is_first);
    callbacks().mode_change = nullptr;
    CONodeStop(&of.node);
  }
}

const Function failures[] = {
    [](Node& of) { of.ext.Size = 1; },
    [](Node& of) { of.ext.Can = nullptr; },
    [](Node& of) { of.ext.Timer = nullptr; },
    [](Node& of) { of.spec.TmrFreq = 0; },
    [](Node& of) { of.spec.NodeId = 0; },
    [](Node& of) { of.spec.Dict = nullptr; },
    [](Node& of) { of.spec.DictLen = 0; },
#if USE_DICT_CHECK
    [](Node& of) { std::swap(of.table[0], of.table[1]); },
#endif
};

TEST_CASE("idle node: every function returns after each failed initialisation") {
  for (const Function& fail : failures) {
    CAPTURE(&fail - failures);
    for (unsigned n = 0; n < std::size(functions); ++n) {
      CAPTURE(n);
      Node of;
      std::memset(static_cast<void*>(&of.node), 0xA5, sizeof of.node);
      fail(of);
      of.init();
      CHECK(CONodeGetErr(&of.node) != CO_ERR_NONE);
      call_in_invalid(of, n);
    }
  }
}

TEST_CASE("idle node: every function of a stopped node returns") {
  for (unsigned n = 0; n < std::size(functions); ++n) {
    CAPTURE(n);
    Node of;
    of.init();
    CONodeStart(&of.node);
    CONodeStop(&of.node);
    call_in_invalid(of, n);
  }
}

}  // namespace

#endif
