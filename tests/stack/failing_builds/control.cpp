// SPDX-License-Identifier: Apache-2.0
// expect to compile
// The same constructs as in the other sources of this directory, without a mistake.
#include "lexican/object.hpp"

void function();
std::uint8_t byte;
std::uint16_t heartbeat_time;
std::uint32_t number;
float ratio;
CO_OBJ_DOM domain;
const CO_OBJ_TYPE type = {};
constexpr CO_OBJ_TYPE_EX extended_type = {{nullptr, nullptr, nullptr, nullptr, COObjTypeExReset}, {}, {}, {}};

constexpr CO_OBJ od[] = {
    {CO_KEY(0x0007, 0, CO_OBJ____P_W), CO_TUNSIGNED32, 0},
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1003, 0, CO_OBJ_D___R_), CO_TEMCY_HIST, (CO_DATA)(0)},
    {CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&number)},
    {CO_KEY(0x1003, 254, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&number)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&heartbeat_time)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(0x600)},
    {CO_KEY(0x1200, 2, CO_OBJ__N__R_), CO_TSDO_ID, (CO_DATA)(&number)},
    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x605)},
    {CO_KEY(0x1280, 2, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&number)},
    {CO_KEY(0x1280, 3, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&byte)},
    {CO_KEY(0x1403, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_RPDO_DEFAULT(3))},
    {CO_KEY(0x1403, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1403, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&heartbeat_time)},
    {CO_KEY(0x1603, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1603, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x0007, 0, 32))},
    {CO_KEY(0x1603, 64, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&number)},
    {CO_KEY(0x1803, 1, CO_OBJ__N__RW), CO_TPDO_ID, (CO_DATA)(&number)},
    {CO_KEY(0x1803, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&byte)},
    {CO_KEY(0x1803, 3, CO_OBJ_D___R_), CO_TPDO_INHIBIT, (CO_DATA)(100)},
    {CO_KEY(0x1803, 5, CO_OBJ_D___R_), CO_TPDO_EVENT, (CO_DATA)(100)},
    {CO_KEY(0x1803, 6, CO_OBJ_D___R_), CO_TPDO_START, (CO_DATA)(240)},
    {CO_KEY(0x1A03, 0, CO_OBJ_____RW), CO_TPDO_NUM, (CO_DATA)(&byte)},
    {CO_KEY(0x1A03, 8, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&number)},
    {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&domain)},
    {CO_KEY(0x2000, 1, CO_OBJ_____RW), CO_TBOOLEAN, (CO_DATA)(&byte)},
    {CO_KEY(0x2000, 2, CO_OBJ_____RW), CO_TREAL32, (CO_DATA)(&ratio)},
    {CO_KEY(0x2100, 1, CO_OBJ__N__RW), CO_TUNSIGNED32, (CO_DATA)(&number)},
    {CO_KEY(0x2100, 2, CO_OBJ_D___RW), &type, (CO_DATA)(&function)},
    {CO_KEY(0x2100, 3, CO_OBJ_____RW), &extended_type.Type, (CO_DATA)(&byte)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

void scope() {
  static constexpr CO_OBJ inner[] = {{CO_KEY(0x2001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&byte)}};
  CO_OD_CHECK_PART(inner);
  static_cast<void>(inner);
}

bool has_client(CO_NODE& node) { return COCSdoFind(&node, 0) == &node.CSdo[0]; }

CO_OBJ* find() { return co::entry<od, 0x2100, 1>(); }

CO_ERR access(CO_NODE& node) {
  const auto sum = co::object<od, 0x2100, 1, std::int32_t>(node).get().value();
  const bool on = co::object<od, 0x2000, 1>(node).get().value();
  const float real = co::object<od, 0x2000, 2>(node).get().value();
  const auto own = co::object<od, 0x2100, 2, std::uint16_t>(node).get().value();
  return co::object<od, 0x2100, 1>(node).set(static_cast<std::uint32_t>(sum) + on + own + (real > 0));
}
