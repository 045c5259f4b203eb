// SPDX-License-Identifier: Apache-2.0
#include "nodes.hpp"

#include <iterator>

#include "bus.hpp"
#include "lexican/dictionary.hpp"
#include "machine.hpp"

namespace zynqmp {

CO_NODE device;
CO_NODE master;
DeviceObjects objects;
MasterObjects master_objects;

namespace {

constexpr std::uint32_t bit_rate = 500000;
constexpr std::size_t timer_num = 8;

// The device ----------------------------------------------------------------------------------------------------------

const std::uint8_t device_name[] = "123456789";
CO_OBJ_STR name = {0, device_name};
CO_OBJ_DOM memory = {0, sizeof objects.memory, objects.memory};
CO_HBCONS last_mode[2];

constexpr CO_OBJ device_od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x00020192)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&objects.error_register)},
    {CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, (CO_DATA)(&objects.history_number)},
    {CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&objects.history[0])},
    {CO_KEY(0x1003, 2, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&objects.history[1])},
    {CO_KEY(0x1003, 3, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&objects.history[2])},
    {CO_KEY(0x1003, 4, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&objects.history[3])},
    {CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, (CO_DATA)(&objects.sync_id)},
    {CO_KEY(0x1006, 0, CO_OBJ_____RW), CO_TSYNC_CYCLE, (CO_DATA)(&objects.sync_cycle)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&name)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, (CO_DATA)(2)},
    {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&last_mode[0])},
    {CO_KEY(0x1016, 2, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&last_mode[1])},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&objects.heartbeat_time)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(4)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(2)},
    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(3)},
    {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(4)},
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_____RW), CO_TPDO_ID, (CO_DATA)(&objects.rpdo_id[0])},
    {CO_KEY(0x1400, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&objects.rpdo_type[0])},
    {CO_KEY(0x1401, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1401, 1, CO_OBJ_____RW), CO_TPDO_ID, (CO_DATA)(&objects.rpdo_id[1])},
    {CO_KEY(0x1401, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&objects.rpdo_type[1])},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 1, 32))},
    {CO_KEY(0x1601, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1601, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 2, 32))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x1800, 1, CO_OBJ_____RW), CO_TPDO_ID, (CO_DATA)(&objects.tpdo_id[0])},
    {CO_KEY(0x1800, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&objects.tpdo_type[0])},
    {CO_KEY(0x1800, 3, CO_OBJ_____RW), CO_TPDO_INHIBIT, (CO_DATA)(&objects.tpdo_inhibit)},
    {CO_KEY(0x1800, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&objects.tpdo_event)},
    {CO_KEY(0x1801, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1801, 1, CO_OBJ_____RW), CO_TPDO_ID, (CO_DATA)(&objects.tpdo_id[1])},
    {CO_KEY(0x1801, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&objects.tpdo_type[1])},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2200, 1, 32))},
    {CO_KEY(0x1A01, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A01, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2200, 2, 32))},
    {CO_KEY(0x2000, 1, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&objects.byte)},
    {CO_KEY(0x2000, 2, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&objects.word)},
    {CO_KEY(0x2000, 3, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&objects.number)},
    {CO_KEY(0x2010, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&memory)},
    {CO_KEY(0x2100, 1, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&objects.received[0])},
    {CO_KEY(0x2100, 2, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&objects.received[1])},
    {CO_KEY(0x2200, 1, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&objects.sent[0])},
    {CO_KEY(0x2200, 2, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&objects.sent[1])},
};
CO_OD_CHECK(device_od);

CO_EMCY_TBL device_errors[CO_EMCY_N] = {{CO_EMCY_REG_VOLTAGE, CO_EMCY_CODE_VOL_INPUT_ERR},
                                        {CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_DEVICE_ERR}};

// The master ----------------------------------------------------------------------------------------------------------

CO_HBCONS heard_device[1];

constexpr CO_OBJ master_od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&master_objects.error_register)},
    {CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, (CO_DATA)(&master_objects.sync_id)},
    {CO_KEY(0x1006, 0, CO_OBJ_____RW), CO_TSYNC_CYCLE, (CO_DATA)(&master_objects.sync_cycle)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, (CO_DATA)(1)},
    {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&heard_device[0])},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(device_id)},
    {CO_KEY(0x1028, device_id, CO_OBJ_D___R_), CO_TEMCY_CONS, (CO_DATA)(0x80 + device_id)},
    {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x600 + device_id)},
    {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x580 + device_id)},
    {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(device_id)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x280 + device_id)},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(255)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 1, 32))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x40000300 + device_id)},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2200, 1, 32))},
    {CO_KEY(0x2100, 1, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&master_objects.received)},
    {CO_KEY(0x2200, 1, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&master_objects.sent)},
};
CO_OD_CHECK(master_od);

// Both ----------------------------------------------------------------------------------------------------------------

CallbackRecord records[2];

void serve_timers(void* node) { COTmrService(&static_cast<CO_NODE*>(node)->Tmr); }

GenericTimer alarms[2] = {{serve_timers, &device, 0, nullptr}, {serve_timers, &master, 0, nullptr}};
bool alarms_are_known = false;

CO_TMR_MEM timers[2][timer_num];
std::uint8_t sdo_buffers[2][CO_SSDO_N * CO_SDO_BUF_BYTE];
CO_NODE_EXT extensions[2];

void init(unsigned which, std::uint8_t id, const CO_OBJ* od, std::size_t entries) {
  if (!alarms_are_known) {
    alarms_are_known = true;
    add(alarms[0]);
    add(alarms[1]);
  }
  CO_NODE& node = which == 0 ? device : master;
  records[which] = {};
  extensions[which] = {};
  extensions[which].Size = sizeof(CO_NODE_EXT);
  extensions[which].Can = &ZynqmpCanDriver;
  extensions[which].CanCtx = which == 0 ? &device_can : &peer_can;
  extensions[which].Timer = &GenericTimerDriver;
  extensions[which].TimerCtx = &alarms[which];
  CO_NODE_SPEC spec = {};
  spec.NodeId = id;
  spec.Baudrate = bit_rate;
  spec.Dict = const_cast<CO_OBJ*>(od);
  spec.DictLen = static_cast<std::uint16_t>(entries);
  spec.EmcyCode = device_errors;
  spec.TmrMem = timers[which];
  spec.TmrNum = timer_num;
  spec.TmrFreq = ticks_per_second;
  spec.SdoBuf = sdo_buffers[which];
  CONodeInitEx(&node, &spec, &extensions[which]);
}

std::uint64_t locked_state = 0;

}  // namespace

CallbackRecord& record_of(const CO_NODE& node) { return records[&node == &device ? 0 : 1]; }

CO_OBJ* device_object(std::uint16_t index, std::uint8_t sub) { return CODictFind(&device.Dict, CO_DEV(index, sub)); }

void init_device() {
  objects = {};
  for (CO_HBCONS& entry : last_mode) {
    entry = {};
  }
  init(0, device_id, device_od, std::size(device_od));
}

void init_master() {
  master_objects = {};
  heard_device[0] = {};
  init(1, master_id, master_od, std::size(master_od));
}

}  // namespace zynqmp

// Callbacks and hooks of the stack ------------------------------------------------------------------------------------

extern "C" {

void COTmrLock(void) {
  std::uint64_t before = 0;
  asm volatile("mrs %0, daif\n msr daifset, #2" : "=r"(before) : : "memory");
  zynqmp::locked_state = before;
}
void COTmrUnlock(void) { asm volatile("msr daif, %0" : : "r"(zynqmp::locked_state) : "memory"); }

void CONodeCanChange(CO_NODE* node, CO_CAN_EVENT event) { ++zynqmp::record_of(*node).can_events[event]; }
void CONmtResetRequest(CO_NMT* nmt, CO_NMT_RESET reset) { ++zynqmp::record_of(*nmt->Node).resets[reset]; }
void CONmtHbConsEvent(CO_NMT* nmt, std::uint8_t) { ++zynqmp::record_of(*nmt->Node).heartbeat_events; }
void CONmtHbConsChange(CO_NMT* nmt, std::uint8_t, CO_MODE mode) { zynqmp::record_of(*nmt->Node).last_mode = mode; }
void COPdoUpdate(CO_RPDO* pdo) { ++zynqmp::record_of(*pdo->Node).pdos; }
void COEmcyReceived(CO_NODE* node, std::uint8_t, std::uint16_t code, std::uint8_t, const std::uint8_t*) {
  ++zynqmp::record_of(*node).emergencies;
  zynqmp::record_of(*node).last_emergency = code;
}
}
