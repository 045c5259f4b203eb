// SPDX-License-Identifier: Apache-2.0
#include "clock/dictionary.hpp"

#include "co_ver.h"

namespace lexican::demo {
namespace {

static_assert(CLOCK_PARA_BASE >= lss_memory_size && CLOCK_PARA_END <= clock_memory_size,
              "what LSS stores, and behind it the settings");

CO_EMCY_TBL errors[] = {
    {CO_EMCY_REG_MANUFACTURER, CO_EMCY_CODE_SW_DATASET_ERR},  // hour
    {CO_EMCY_REG_MANUFACTURER, CO_EMCY_CODE_SW_DATASET_ERR},  // minute
    {CO_EMCY_REG_MANUFACTURER, CO_EMCY_CODE_SW_DATASET_ERR},  // second
};
constexpr std::uint16_t number_of_errors = sizeof errors / sizeof errors[0];

// --- An application-specific type: a figure of the time of day. Stored like UNSIGNED8, with an upper limit.

// A figure is an hour, a minute or a second: 2100h sub-index 1, 2 or 3.
std::uint32_t figure_size(CO_OBJ* obj, CO_NODE* node, std::uint32_t width) {
  return CO_TUNSIGNED8->Size(obj, node, width);
}

CO_ERR figure_read(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  return CO_TUNSIGNED8->Read(obj, node, buffer, size);
}

// Refuses a figure above its limit with an abort code, and raises an error. The EMCY message and the error history
// contain the sub-index and the refused figure.
CO_ERR figure_write(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
  const std::uint8_t sub = CO_GET_SUB(obj->Key);
  const std::uint8_t figure = *static_cast<const std::uint8_t*>(buffer);
  const auto error = static_cast<std::uint8_t>(sub - 1);
  if (figure > (sub == 1 ? 23 : 59)) {
    const CO_EMCY_USR about = {static_cast<std::uint16_t>(sub | figure << 8), {sub, figure}};
    COEmcySet(&node->Emcy, error, &about);
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_RANGE_HIGH);
    return CO_ERR_OBJ_RANGE;
  }
  COEmcyClr(&node->Emcy, error);
  return CO_TUNSIGNED8->Write(obj, node, buffer, size);
}

constexpr CO_OBJ_TYPE figure_type = {figure_size, nullptr, figure_read, figure_write, nullptr};

const std::uint8_t software_version[] = {'0' + CO_VER_MAJOR, '.', '0' + CO_VER_MINOR, '.', '0' + CO_VER_BUILD, 0};
static_assert(CO_VER_MAJOR < 10 && CO_VER_MINOR < 10 && CO_VER_BUILD < 10, "one digit each");

}  // namespace

Table clock_dictionary() { return {const_cast<CO_OBJ*>(clock_od), CLOCK_OD_NUM}; }

Errors clock_errors() { return {errors, number_of_errors}; }

}  // namespace lexican::demo

const CO_OBJ_TYPE clock_2100_1_type = lexican::demo::figure_type;
const CO_OBJ_TYPE clock_2100_2_type = lexican::demo::figure_type;
const CO_OBJ_TYPE clock_2100_3_type = lexican::demo::figure_type;

CO_OBJ_STR clock_100A_0 = {0, lexican::demo::software_version};
