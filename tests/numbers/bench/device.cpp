// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"

#include <algorithm>

#include "drivers.hpp"
#include "machine.hpp"

namespace bench {
namespace {

constexpr std::size_t most_entries = 24576;
constexpr std::size_t pdo_bytes = 32;
constexpr std::size_t most_timers = 80;

CO_OBJ entries[most_entries];
std::size_t number_of_entries = 0;

CO_TMR_MEM timers[most_timers];
std::uint8_t sdo_buffer[CO_SSDO_N * CO_SDO_BUF_BYTE];
std::uint8_t error_register = 0;
std::uint32_t history[8];
CO_HBCONS heard[sizeof heard_nodes];
const CO_EMCY_TBL errors[CO_EMCY_N] = {{CO_EMCY_REG_VOLTAGE, CO_EMCY_CODE_VOL_INPUT_ERR},
                                       {CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_DEVICE_ERR}};

alignas(4) std::uint8_t rpdo_bytes[CO_RPDO_N][pdo_bytes];
alignas(4) std::uint8_t tpdo_bytes[CO_TPDO_N][pdo_bytes];

const CO_OBJ_TYPE* type_of(std::uint8_t width) {
  return width == 1 ? CO_TUNSIGNED8 : width == 2 ? CO_TUNSIGNED16 : CO_TUNSIGNED32;
}

void add_value(std::uint16_t index, std::uint8_t sub, const CO_OBJ_TYPE* type, std::uint32_t value) {
  add(index, sub, CO_OBJ_D___R_, type, (CO_DATA)(value));
}

void add_objects(std::uint16_t index, std::uint32_t flags, const Layout& layout, std::uint8_t* memory) {
  add_value(index, 0, CO_TUNSIGNED8, layout.number);
  for (unsigned n = 0; n < layout.number; ++n) {
    add(index, static_cast<std::uint8_t>(n + 1), flags, type_of(layout.width), (CO_DATA)(memory + n * layout.stride));
  }
}

void add_mapping(std::uint16_t index, std::uint16_t objects, const Layout& layout) {
  add_value(index, 0, CO_TPDO_NUM, layout.number);
  for (unsigned n = 1; n <= layout.number; ++n) {
    add_value(index, static_cast<std::uint8_t>(n), CO_TPDO_MAP, CO_LINK(objects, n, layout.width * 8u));
  }
}

void add_communication(std::uint16_t index, std::uint32_t cob_id, std::uint8_t type) {
  add_value(index, 0, CO_TUNSIGNED8, 2);
  add_value(index, 1, CO_TPDO_ID, cob_id);
  add_value(index, 2, CO_TPDO_TYPE, type);
}

void add_heartbeat_consumers() {
  constexpr std::uint8_t number = sizeof heard_nodes;
  add_value(0x1016, 0, CO_THB_CONS, number);
  for (std::uint8_t n = 0; n < number; ++n) {
    heard[n] = {};
    heard[n].NodeId = heard_nodes[n];
    heard[n].Time = heard_period;
    add(0x1016, static_cast<std::uint8_t>(n + 1), CO_OBJ_____RW, CO_THB_CONS, (CO_DATA)(&heard[n]));
  }
}

void add_history() {
  constexpr std::uint8_t number = sizeof history / sizeof history[0];
  add(0x1003, 0, CO_OBJ_D___RW, CO_TEMCY_HIST, (CO_DATA)(0));
  for (std::uint8_t n = 0; n < number; ++n) {
    add(0x1003, static_cast<std::uint8_t>(n + 1), CO_OBJ_____R_, CO_TEMCY_HIST, (CO_DATA)(&history[n]));
  }
}

}  // namespace

CO_NODE node;

void clear_dictionary() { number_of_entries = 0; }

void add(std::uint16_t index, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
  if (number_of_entries == most_entries) {
    fail("dictionary", "too many entries");
  }
  entries[number_of_entries++] = {CO_KEY(index, sub, flags), type, data};
}

void add_usual_objects() {
  add_value(0x1000, 0, CO_TUNSIGNED32, 0);
  add(0x1001, 0, CO_OBJ_____R_, CO_TUNSIGNED8, (CO_DATA)(&error_register));
  add_history();
  add_value(0x1005, 0, CO_TSYNC_ID, 0x80);
  add(0x1014, 0, CO_OBJ_DN__R_, CO_TEMCY_ID, (CO_DATA)(0x80));
  add_heartbeat_consumers();
  add_value(0x1018, 0, CO_TUNSIGNED8, 4);
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    add_value(0x1018, sub, CO_TUNSIGNED32, sub);
  }
  add_value(0x1200, 0, CO_TUNSIGNED8, 2);
  add(0x1200, 1, CO_OBJ_DN__R_, CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_REQUEST()));
  add(0x1200, 2, CO_OBJ_DN__R_, CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_RESPONSE()));
}

std::uint16_t rpdo_objects(std::uint16_t number) { return static_cast<std::uint16_t>(0x3000 + number); }
std::uint16_t tpdo_objects(std::uint16_t number) { return static_cast<std::uint16_t>(0x4000 + number); }
std::uint8_t* rpdo_memory(std::uint16_t number) { return rpdo_bytes[number]; }
std::uint8_t* tpdo_memory(std::uint16_t number) { return tpdo_bytes[number]; }

// Returns the CAN-ID of an RPDO. Up to four PDOs use the pre-defined connection set; more of them use unused
// identifiers from 181h, alternately for RPDOs and TPDOs.
std::uint32_t rpdo_id(std::uint16_t number) {
  return CO_RPDO_N <= 4 ? CO_COBID_RPDO_DEFAULT(number) + node_id : 0x181u + 2u * number;
}
std::uint32_t tpdo_id(std::uint16_t number) {
  return CO_TPDO_N <= 4 ? (CO_COBID_TPDO_DEFAULT(number) & CO_IF_FRM_ID) + node_id : 0x182u + 2u * number;
}

void add_rpdo(std::uint16_t number, std::uint8_t type, const Layout& layout) {
  add_communication(static_cast<std::uint16_t>(0x1400 + number), rpdo_id(number), type);
  add_mapping(static_cast<std::uint16_t>(0x1600 + number), rpdo_objects(number), layout);
  add_objects(rpdo_objects(number), CO_OBJ____PRW, layout, rpdo_memory(number));
}

void add_tpdo(std::uint16_t number, std::uint8_t type, const Layout& layout, bool remote) {
  const std::uint32_t cob_id = tpdo_id(number) | (remote ? 0u : CO_TPDO_COBID_REMOTE);
  add_communication(static_cast<std::uint16_t>(0x1800 + number), cob_id, type);
  add_mapping(static_cast<std::uint16_t>(0x1A00 + number), tpdo_objects(number), layout);
  add_objects(tpdo_objects(number), CO_OBJ___APRW, layout, tpdo_memory(number));
}

bool holds(const CO_IF_FRM& frame, const Layout& layout, const std::uint8_t* memory) {
  bool same = frame.DLC == layout.length();
  for (unsigned n = 0; n < layout.number; ++n) {
    same = same && std::equal(memory + n * layout.stride, memory + n * layout.stride + layout.width,
                              frame.Data + n * layout.width);
  }
  return same;
}

void start(CO_MODE mode) {
  std::sort(entries, entries + number_of_entries, [](const CO_OBJ& a, const CO_OBJ& b) { return a.Key < b.Key; });
  CO_NODE_SPEC spec{};
  spec.NodeId = node_id;
  spec.Baudrate = 1000000;
  spec.Dict = entries;
  spec.DictLen = static_cast<std::uint16_t>(number_of_entries);
  spec.EmcyCode = const_cast<CO_EMCY_TBL*>(errors);
  spec.TmrMem = timers;
  spec.TmrNum = most_timers;
  spec.TmrFreq = ticks_per_second;
  spec.SdoBuf = sdo_buffer;
  init_node(spec);
  CONodeStart(&node);
  CONmtSetMode(&node.Nmt, mode);
  if (CONodeGetErr(&node) != CO_ERR_NONE || CONmtGetMode(&node.Nmt) != mode) {
    fail("node", "it does not start");
  }
  forget_sent();
}

}  // namespace bench
