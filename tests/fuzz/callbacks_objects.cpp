// SPDX-License-Identifier: Apache-2.0
#include "fuzz/callbacks_objects.hpp"

#include <algorithm>

#include "fuzz/fuzz.hpp"

namespace fuzz {
namespace {

template <class T>
CO_OBJ row(std::uint32_t index, std::uint32_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, const T* data) {
  return {CO_KEY(index, sub, flags), type, reinterpret_cast<std::uintptr_t>(data)};
}

void add_services(std::vector<CO_OBJ>& table, ServiceObjects& o) {
  constexpr std::uint32_t rw = CO_OBJ_____RW;
  for (std::uint32_t n = 0; n < 2; ++n) {
    table.push_back(row(0x1020, n + 1, rw, CO_TVERIFY_CONFIG, &o.verify[n]));
    table.push_back(row(0x1FA0, n + 1, rw, CO_TPDO_SCAN, &o.scan[n]));
    table.push_back(row(0x1FD0, n + 1, rw, CO_TPDO_DISPATCH, &o.dispatch[n]));
    table.push_back(row(0x2320, n + 1, CO_OBJ___APRW, CO_TUNSIGNED32, &o.stored[n]));
    table.push_back(row(0x1010, n + 2, rw, CO_TPARA_STORE, &o.group[n]));
    table.push_back(row(0x1011, n + 2, rw, CO_TPARA_RESTORE, &o.group[n]));
    table.push_back(row(0x1026, n + 2, CO_OBJ____PR_, CO_TOS_STDOUT, &o.prompt));
    table.push_back({CO_KEY(0x1010 + n, 0, CO_OBJ_D___R_), n == 0 ? CO_TPARA_STORE : CO_TPARA_RESTORE, 3});
  }
  for (const std::uint32_t sub : {1U, 2U, 4U, 5U, 6U, 7U, 8U, 9U, 10U}) {
    table.push_back(row(0x2301, sub, rw, CO_TREC_CONFIG, &o.recorder[0]));
  }
  for (const std::uint32_t sub : {1U, 2U, 3U, 4U, 6U}) {
    table.push_back(row(0x2401, sub, rw, CO_TREC_DATA, &o.recorder[0]));
  }
  for (const std::uint32_t sub : {2U, 3U, 4U}) {
    table.push_back({CO_KEY(0x1018, sub, CO_OBJ_D___R_), CO_TUNSIGNED32, 0});
  }
  const CO_OBJ others[] = {
      row(0x2400, 0, rw, CO_TREC_ENABLE, &o.recorder_enable),
      row(0x2401, 5, CO_OBJ_____R_, CO_TREC_PLOT, &o.recorder[0]),
      row(0x1010, 1, rw, CO_TPARA_STORE, &o.all_groups),
      row(0x1011, 1, rw, CO_TPARA_RESTORE, &o.all_groups),
      row(0x1023, 1, rw, CO_TOS_COMMAND, &o.command),
      row(0x1023, 2, CO_OBJ_____R_, CO_TOS_STATUS, &o.command),
      row(0x1023, 3, CO_OBJ_____R_, CO_TOS_REPLY, &o.command),
      row(0x1024, 0, CO_OBJ______W, CO_TOS_MODE, &o.command),
      row(0x1026, 1, CO_OBJ____P_W, CO_TOS_STDIN, &o.prompt),
  };
  table.insert(table.end(), std::begin(others), std::end(others));
}

}  // namespace

ServiceObjects::ServiceObjects() {
  for (unsigned n = 0; n < 2; ++n) {
    recorder[n].Points = points[n];
    recorder[n].Num = 4;
    recorder[n].Config = {4, 0, n == 0 ? CO_LINK(0x2000, 0, 8) : CO_LINK(0x2200, 0, 32), 0, 0, 5, 0, 0, 0};
  }
  command = CO_OS_COMMAND_OF(
      command_memory, reply_memory,
      [](CO_NODE*, void*, CO_OS_COMMAND*, const std::uint8_t*, std::uint16_t) { call_api(); },
      [](CO_NODE*, void*, CO_OS_COMMAND*) { call_api(); });
  prompt = CO_OS_PROMPT_OF([](CO_NODE*, void*, std::uint8_t) { call_api(); }, out_memory, err_memory);
}

std::vector<CO_OBJ> callbacks_dictionary(Objects& objects, ServiceObjects& services) {
  NetworkObjects& network = objects.network;
  for (unsigned n = 0; n < network_pdos; ++n) {
    network.rpdo[n].cob_id &= 0x7FFFFFFFU;
    network.tpdo[n].cob_id &= 0x7FFFFFFFU;
  }
  // Multiplex PDOs with source (FEh) and destination addressing (FFh); the first PDOs map an application type, too.
  network.rpdo[2].number = network.tpdo[3].number = 0xFE;
  network.rpdo[3].number = network.tpdo[2].number = 0xFF;
  network.rpdo[3].type = network.tpdo[3].type = 254;
  network.rpdo[0].number = network.tpdo[0].number = 3;
  network.rpdo[0].map[2] = network.tpdo[0].map[2] = 0x22000020;
  std::vector<CO_OBJ> table = dictionary(objects);
  add_services(table, services);
  std::sort(table.begin(), table.end(),
            [](const CO_OBJ& left, const CO_OBJ& right) { return CO_GET_DEV(left.Key) < CO_GET_DEV(right.Key); });
  return table;
}

namespace {

std::int16_t answer() {
  call_api();
  return chance(8) == 7 ? std::int16_t{-1} : std::int16_t{0};
}
CO_ERR load(std::uint32_t*, std::uint8_t* node_id) {
  call_api();
  const std::uint32_t what = chance(16);
  if (what == 14) {
    *node_id = CO_LSS_NO_NODE_ID;
  }
  return what == 15 ? CO_ERR_LSS_LOAD : CO_ERR_NONE;
}
CO_ERR store() { return answer() == 0 ? CO_ERR_NONE : CO_ERR_LSS_STORE; }

}  // namespace

const CO_CALLBACKS callbacks = {
    [](CO_NODE*, void*, CO_MODE) { call_api(); },
    [](CO_NODE*, void*, CO_NMT_RESET) { call_api(); },
    [](CO_NODE*, void*, std::uint8_t) { call_api(); },
    [](CO_NODE*, void*, std::uint8_t, CO_MODE) { call_api(); },
    [](CO_NODE*, void*, bool) { call_api(); },
    [](CO_NODE*, void*, CO_IF_FRM*) { call_api(); },
    [](CO_NODE*, void*, CO_CAN_EVENT) { call_api(); },
    [](CO_NODE*, void*, CO_IF_FRM*) { call_api(); },
    [](CO_NODE*, void*, CO_IF_FRM*) { return answer(); },
    [](CO_NODE*, void*, CO_RPDO*) { call_api(); },
    [](CO_NODE*, void*, CO_RPDO*) { call_api(); },
    [](CO_NODE*, void*, CO_PARA*) { return answer(); },
    [](CO_NODE*, void*, const CO_PARA*) { call_api(); },
    [](CO_NODE*, void*, std::uint32_t* baud, std::uint8_t* node_id) { return load(baud, node_id); },
    [](CO_NODE*, void*, std::uint32_t, std::uint8_t) { return store(); },
    [](CO_NODE*, void*, const CO_TIME_OF_DAY*) { call_api(); },
    [](CO_NODE*, void*, std::uint8_t) { call_api(); },
    [](CO_NODE*, void*, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*) { call_api(); },
    [](CO_NODE*, void*, const CO_PARA*) { call_api(); },
    [](CO_NODE*, void*) { call_api(); },
    [](CO_NODE*, void*, std::uint8_t, CO_SRDO_STATE) { call_api(); },
    [](CO_NODE*, void*, const CO_ACCESS_SDO*) { return answer() == 0 ? 0U : CO_SDO_ERR_TOS_LOCAL; },
    [](CO_NODE*, void*, const CO_ACCESS_NMT*) { return static_cast<std::uint8_t>(answer() == 0 ? 0 : 1); },
    [](CO_NODE*, void*, CO_ACCESS_LSS*) { return static_cast<std::uint8_t>(answer() == 0 ? 0 : 1); },
};

}  // namespace fuzz

extern "C" {

void CONmtModeChange(CO_NMT*, CO_MODE) { fuzz::call_api(); }
void CONmtResetRequest(CO_NMT*, CO_NMT_RESET) { fuzz::call_api(); }
void CONmtHbConsEvent(CO_NMT*, std::uint8_t) { fuzz::call_api(); }
void CONmtHbConsChange(CO_NMT*, std::uint8_t, CO_MODE) { fuzz::call_api(); }
void CONmtLifeGuardEvent(CO_NMT*, bool) { fuzz::call_api(); }
void COIfCanReceive(CO_IF_FRM*) { fuzz::call_api(); }
void CONodeCanChange(CO_NODE*, CO_CAN_EVENT) { fuzz::call_api(); }
void COPdoTransmit(CO_IF_FRM*) { fuzz::call_api(); }
std::int16_t COPdoReceive(CO_IF_FRM*) { return fuzz::answer(); }
void COPdoSyncUpdate(CO_RPDO*) { fuzz::call_api(); }
void COPdoUpdate(CO_RPDO*) { fuzz::call_api(); }
std::int16_t COParaDefault(CO_PARA*) { return fuzz::answer(); }
void COParaLost(CO_NODE*, const CO_PARA*) { fuzz::call_api(); }
CO_ERR COLssLoad(std::uint32_t* baud, std::uint8_t* node_id) { return fuzz::load(baud, node_id); }
CO_ERR COLssStore(std::uint32_t, std::uint8_t) { return fuzz::store(); }
void COTimeUpdate(CO_NODE*, const CO_TIME_OF_DAY*) { fuzz::call_api(); }
void COGfcReceived(CO_NODE*) { fuzz::call_api(); }
void COSrdoChange(CO_NODE* node, std::uint8_t number, CO_SRDO_STATE state) {
  fuzz::require(COSrdoGetState(node, number) == state, "COSrdoChange() reports the present state");
  fuzz::call_api();
}
void COLedChange(CO_NODE*, std::uint8_t) { fuzz::call_api(); }
void COEmcyReceived(CO_NODE*, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*) { fuzz::call_api(); }
void CONodeFatalError(void) { fuzz::require(false, "no fatal error"); }

}  // extern "C"
