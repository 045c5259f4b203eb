// SPDX-License-Identifier: Apache-2.0
#include "clock/dictionary.hpp"

#include "co/dictionary.hpp"
#include "co_ver.h"

namespace demo {
namespace {

template <typename Entry, std::size_t Number>
constexpr std::uint16_t length(const Entry (&)[Number]) {
  static_assert(Number <= UINT16_MAX);
  return Number;
}

// --- A type of our own: a figure of the time of day. It stores and reads as UNSIGNED8 does, but knows its limit.

CO_EMCY_TBL errors[] = {
    {CO_EMCY_REG_MANUFACTURER, CO_EMCY_CODE_SW_DATASET_ERR},  // hour
    {CO_EMCY_REG_MANUFACTURER, CO_EMCY_CODE_SW_DATASET_ERR},  // minute
    {CO_EMCY_REG_MANUFACTURER, CO_EMCY_CODE_SW_DATASET_ERR},  // second
};

std::uint32_t figure_size(CO_OBJ* obj, CO_NODE* node, std::uint32_t width) {
  return CO_TUNSIGNED8->Size(obj, node, width);
}

CO_ERR figure_read(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  return CO_TUNSIGNED8->Read(obj, node, buffer, size);
}

CO_ERR figure_write(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  const std::uint8_t sub = CO_GET_SUB(obj->Key);
  const std::uint8_t figure = *static_cast<const std::uint8_t*>(buffer);
  const auto error = static_cast<std::uint8_t>(sub - 1);
  if (figure > (sub == 1 ? 23 : 59)) {
    const CO_EMCY_USR about = {static_cast<std::uint16_t>(sub | figure << 8), {sub, figure}};
    COEmcySet(&node->Emcy, error, &about);
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_RANGE);
    return CO_ERR_TYPE_WR;
  }
  COEmcyClr(&node->Emcy, error);
  return CO_TUNSIGNED8->Write(obj, node, buffer, size);
}

constexpr CO_OBJ_TYPE figure_type = {figure_size, nullptr, figure_read, figure_write, nullptr};
constexpr const CO_OBJ_TYPE* CO_TFIGURE = &figure_type;

// --- A type of our own: a text that lies in a parameter group. Its length is not stored: it ends at a NUL, or with its
// memory, also after it was loaded.

std::uint32_t stored_text_size(CO_OBJ* obj, CO_NODE* node, std::uint32_t width) {
  return CO_TVISIBLE_STRING->Size(obj, node, width);
}

CO_ERR stored_text_init(CO_OBJ* obj, CO_NODE* node) { return CO_TVISIBLE_STRING->Init(obj, node); }

CO_ERR stored_text_read(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  return CO_TVISIBLE_STRING->Read(obj, node, buffer, size);
}

CO_ERR stored_text_write(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size);

CO_ERR stored_text_reset(CO_OBJ* obj, CO_NODE* node, std::uint32_t position) {
  return CO_TVISIBLE_STRING->Reset(obj, node, position);
}

constexpr CO_OBJ_TYPE stored_text_type = {stored_text_size, stored_text_init, stored_text_read, stored_text_write,
                                          stored_text_reset};
constexpr const CO_OBJ_TYPE* CO_TSTORED_TEXT = &stored_text_type;

// --- The variables behind the entries

/// What 1010h stores.
struct Settings {
  std::uint32_t configured[2];  // date and time of the configuration, 0: unknown
  std::int16_t time_zone;       // min, east of UTC
  std::uint8_t station[32];
};

struct Variables {
  std::uint8_t error_register = 0;
  std::uint16_t heartbeat_time = 1000;  // ms
  std::uint16_t guard_time = 0;         // ms; the node may be guarded while it has no heartbeat time
  std::uint8_t life_time_factor = 0;
  std::uint8_t history_number = 0;
  std::uint32_t history[4] = {};
  std::uint32_t sync_id = CO_COBID_SYNC_STD(0, 0x80);
  std::uint32_t sync_cycle = 0;            // µs
  std::uint8_t rpdo_type = 255;            // event-driven
  std::uint8_t tpdo_type = 255;            // event-driven: the time has changed
  std::uint16_t tpdo_inhibit_time = 1000;  // x 100 µs
  std::uint16_t tpdo_event_time = 0;       // ms
  Settings settings = {};
};

Variables variables;

const std::uint8_t software_version_text[] = {'0' + CO_VER_MAJOR, '.', '0' + CO_VER_MINOR, '.', '0' + CO_VER_BUILD, 0};
static_assert(CO_VER_MAJOR < 10 && CO_VER_MINOR < 10 && CO_VER_BUILD < 10, "one digit each");

CO_OBJ_STR device_name = {0, reinterpret_cast<const std::uint8_t*>(clock_name)};
CO_OBJ_STR hardware_version = {0, clock_hardware};
CO_OBJ_STR software_version = {0, software_version_text};

CO_OBJ_STR_RW station = {0, sizeof variables.settings.station, sizeof variables.settings.station,
                         variables.settings.station};

// The stack sees the text change, but not that it is part of a group.
CO_ERR stored_text_write(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  const CO_ERR error = CO_TVISIBLE_STRING->Write(obj, node, buffer, size);
  station.Size = station.Capacity;
  variables.settings.configured[0] = 0;
  variables.settings.configured[1] = 0;
  return error;
}

#if USE_PARA
constexpr Settings default_settings = {};
constexpr std::uint32_t layout = CO_PARA_VERSION(1);
CO_PARA settings_group = {lss_memory_size, sizeof(Settings), &variables.settings, &default_settings,
                          CO_RESET_NODE,   nullptr,          CO_PARA___E | layout};
static_assert(lss_memory_size + CO_PARA_SPACE(sizeof(Settings), 1U, 1U) <= clock_memory_size);
#endif

// --- The dictionary

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // no device profile
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&variables.error_register)},
    {CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, (CO_DATA)(&variables.history_number)},
    {CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&variables.history[0])},
    {CO_KEY(0x1003, 2, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&variables.history[1])},
    {CO_KEY(0x1003, 3, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&variables.history[2])},
    {CO_KEY(0x1003, 4, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&variables.history[3])},
    {CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, (CO_DATA)(&variables.sync_id)},
    {CO_KEY(0x1006, 0, CO_OBJ_____RW), CO_TSYNC_CYCLE, (CO_DATA)(&variables.sync_cycle)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&device_name)},
    {CO_KEY(0x1009, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&hardware_version)},
    {CO_KEY(0x100A, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&software_version)},
    {CO_KEY(0x100C, 0, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&variables.guard_time)},
    {CO_KEY(0x100D, 0, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&variables.life_time_factor)},
#if USE_PARA
    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TPARA_STORE, (CO_DATA)(1)},
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&settings_group)},
    {CO_KEY(0x1011, 0, CO_OBJ_D___R_), CO_TPARA_RESTORE, (CO_DATA)(1)},
    {CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)(&settings_group)},
#endif
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&variables.heartbeat_time)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(4)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // no vendor-ID of CiA
    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(clock_product_code)},
    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)((CO_VER_MAJOR << 16) | CO_VER_MINOR)},
    {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(clock_serial_number)},
#if USE_PARA
    {CO_KEY(0x1020, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1020, 1, CO_OBJ_____RW), CO_TVERIFY_CONFIG, (CO_DATA)(&variables.settings.configured[0])},
    {CO_KEY(0x1020, 2, CO_OBJ_____RW), CO_TVERIFY_CONFIG, (CO_DATA)(&variables.settings.configured[1])},
#endif
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_RPDO_DEFAULT(0))},
    {CO_KEY(0x1400, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&variables.rpdo_type)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(3)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 1, 8))},
    {CO_KEY(0x1600, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 2, 8))},
    {CO_KEY(0x1600, 3, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 3, 8))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&variables.tpdo_type)},
    {CO_KEY(0x1800, 3, CO_OBJ_____RW), CO_TPDO_INHIBIT, (CO_DATA)(&variables.tpdo_inhibit_time)},
    {CO_KEY(0x1800, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&variables.tpdo_event_time)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(3)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 1, 8))},
    {CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 2, 8))},
    {CO_KEY(0x1A00, 3, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 3, 8))},
    {CO_KEY(0x2100, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x2100, 1, CO_OBJ___APRW), CO_TFIGURE, (CO_DATA)(&clock_time.hour)},
    {CO_KEY(0x2100, 2, CO_OBJ___APRW), CO_TFIGURE, (CO_DATA)(&clock_time.minute)},
    {CO_KEY(0x2100, 3, CO_OBJ___APRW), CO_TFIGURE, (CO_DATA)(&clock_time.second)},
    {CO_KEY(0x2101, 0, CO_OBJ_____RW), CO_TSIGNED16, (CO_DATA)(&variables.settings.time_zone)},
    {CO_KEY(0x2200, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&clock_picture)},
    {CO_KEY(0x2201, 0, CO_OBJ_____RW), CO_TSTORED_TEXT, (CO_DATA)(&station)},
};
CO_OD_CHECK(od);

}  // namespace

Table clock_dictionary() { return {const_cast<CO_OBJ*>(od), length(od)}; }

void forget_variables() {
  variables = Variables{};
  clock_time = {};
  for (std::uint32_t n = 0; n < clock_picture.Size; ++n) {
    clock_picture.Start[n] = 0;
  }
}

std::uint16_t clock_heartbeat_time() { return variables.heartbeat_time; }

Errors clock_errors() { return {errors, length(errors)}; }

}  // namespace demo
