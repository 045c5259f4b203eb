// SPDX-License-Identifier: Apache-2.0
#include "thermometer/thermometer.hpp"

#include "lexican/dictionary.hpp"
#include "lexican/object.hpp"

namespace lexican::demo {
namespace {

std::uint8_t error_register = 0;
std::uint16_t heartbeat_time = 500;  // ms
std::int16_t temperature = 0;        // 0.1 °C
std::int16_t limit = 1000;           // 0.1 °C

// The object dictionary. CO_KEY: index, sub-index, flags. Flags: R and W: readable and writable by SDO; P: mappable to
// PDOs; A: a change triggers the TPDO; D: the entry contains the value; N: the node-ID is added. The second column is
// the type, the last one the value or its address.
constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&error_register)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&heartbeat_time)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // your vendor-ID
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(255)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2000, 0, 16))},
    {CO_KEY(0x2000, 0, CO_OBJ___APR_), CO_TSIGNED16, (CO_DATA)(&temperature)},
    {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TSIGNED16, (CO_DATA)(&limit)},
};
CO_OD_CHECK(od);  // an invalid table does not compile

constexpr std::uint16_t entries = sizeof od / sizeof od[0];

enum Error : std::uint8_t { too_hot, number_of_errors };

CO_EMCY_TBL errors[number_of_errors] = {{CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_ERR}};

std::uint8_t sdo_buffer[CO_SSDO_N * CO_SDO_BUF_BYTE];

}  // namespace

void make_thermometer(CO_NODE& node, CO_NODE_EXT& drivers, std::uint8_t node_id) {
  drivers.Size = sizeof drivers;
  drivers.EmcyNum = number_of_errors;
  CO_NODE_SPEC spec = {};
  spec.NodeId = node_id;
  spec.Baudrate = 500000;
  spec.Dict = const_cast<CO_OBJ*>(od);
  spec.DictLen = entries;
  spec.EmcyCode = errors;
  spec.TmrFreq = 1000000;
  spec.SdoBuf = sdo_buffer;
  CONodeInitEx(&node, &spec, &drivers);
}

void set_temperature(CO_NODE& node, std::int16_t tenths) {
  co::object<std::int16_t>(node, 0x2000, 0).set(tenths);
  if (tenths > limit) {
    COEmcySet(&node.Emcy, too_hot, nullptr);
  } else {
    COEmcyClr(&node.Emcy, too_hot);
  }
}

}  // namespace lexican::demo
