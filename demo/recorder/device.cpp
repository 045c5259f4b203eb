// SPDX-License-Identifier: Apache-2.0
#include "recorder/device.hpp"

#include "lexican/dictionary.hpp"

namespace lexican::demo {
namespace {

std::uint8_t error_register = 0;
std::int16_t setpoint = 0;  // revolutions per minute
std::int16_t speed = 0;     // revolutions per minute

CO_RECORDER_POINT points[500];
std::uint8_t name[24] = "speed";
CO_RECORDER recorder = {};

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&error_register)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // your vendor-ID
    {CO_KEY(0x2100, 0, CO_OBJ____PRW), CO_TSIGNED16, (CO_DATA)(&setpoint)},
    {CO_KEY(0x2110, 0, CO_OBJ____PR_), CO_TSIGNED16, (CO_DATA)(&speed)},
    {CO_KEY(0x2301, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(10)},
    {CO_KEY(0x2301, 1, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 2, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 3, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&recorder.Name)},
    {CO_KEY(0x2301, 4, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 5, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 6, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 7, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 8, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 9, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 10, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(6)},
    {CO_KEY(0x2401, 1, CO_OBJ_____RW), CO_TREC_DATA, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 2, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 3, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 4, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 5, CO_OBJ_____R_), CO_TREC_PLOT, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 6, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
};
CO_OD_CHECK(od);

std::uint8_t sdo_buffer[CO_SSDO_N * CO_SDO_BUF_BYTE];

}  // namespace

void make_drive(CO_NODE& node, CO_NODE_EXT& drivers, std::uint8_t node_id) {
  recorder.Points = points;
  recorder.Num = sizeof points / sizeof *points;
  recorder.Name = {0, 5, sizeof name, name};
  recorder.Config.Size = recorder.Num;
  drivers.Size = sizeof drivers;
  CO_NODE_SPEC spec = {};
  spec.NodeId = node_id;
  spec.Baudrate = 500000;
  spec.Dict = const_cast<CO_OBJ*>(od);
  spec.DictLen = sizeof od / sizeof *od;
  spec.TmrFreq = 1000000;
  spec.SdoBuf = sdo_buffer;
  CONodeInitEx(&node, &spec, &drivers);
}

void run_motor() {
  static double now = 0;
  static double acceleration = 0;
  acceleration += ((setpoint - now) * 0.002 - acceleration * 0.03);
  now += acceleration;
  speed = static_cast<std::int16_t>(now);
}

}  // namespace lexican::demo
