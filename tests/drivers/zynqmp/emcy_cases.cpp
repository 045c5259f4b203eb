// SPDX-License-Identifier: Apache-2.0
// EMCY producer, error register and history. [301:7.2.7]
#include "bus.hpp"
#include "cases.hpp"
#include "nodes.hpp"

namespace zynqmp {
namespace {

void application_error() {
  start_device();
  COEmcySet(&device.Emcy, 0, nullptr);
  RX("085#0031050000000000");
  COEmcySet(&device.Emcy, 1, nullptr);
  RX("085#00420D0000000000");
  ASK("605#4001100000000000", "585#4F0110000D000000");
  COEmcyClr(&device.Emcy, 0);
  RX("085#0000090000000000");
  COEmcyClr(&device.Emcy, 1);
  RX("085#0000000000000000");
}

void history() {
  start_device();
  COEmcySet(&device.Emcy, 0, nullptr);
  RX("085#0031050000000000");
  COEmcySet(&device.Emcy, 1, nullptr);
  RX("085#00420D0000000000");
  ASK("605#4003100000000000", "585#4F03100002000000");
  ASK("605#4003100100000000", "585#4303100100420000");
  ASK("605#4003100200000000", "585#4303100200310000");
  ASK("605#2F03100000000000", "585#6003100000000000");
  ASK("605#4003100000000000", "585#4F03100000000000");
}

void short_pdo() {
  start_operational();
  ASK("205#0102", "085#1082110000010000");
  CHECK_EQUAL(objects.received[0], 0);
  ASK("205#01020304", "085#0000000000010000");
}

void not_when_stopped() {
  start_operational();
  send("000#0205");
  run_ms(1);
  COEmcySet(&device.Emcy, 0, nullptr);
  SILENT(20);
  CHECK_EQUAL(objects.error_register, 0x05);
}

constexpr Case cases[] = {
    {"EMCY: errors come and go, with the error register [301:7.2.7.1]", application_error},
    {"EMCY: the history holds what has come, newest first; 0 empties it [301:7.5.2.4]", history},
    {"EMCY: a PDO that is too short is reported with 8210h [301:7.2.7.1]", short_pdo},
    {"EMCY: none in Stopped, but the error register tells [N9]", not_when_stopped},
};

}  // namespace

Cases emcy_cases() { return all_of(cases); }

}  // namespace zynqmp
