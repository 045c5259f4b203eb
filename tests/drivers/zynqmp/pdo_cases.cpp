// SPDX-License-Identifier: Apache-2.0
// PDO and SYNC. [301:7.2.2, 7.2.5]
#include "bus.hpp"
#include "cases.hpp"
#include "machine.hpp"
#include "nodes.hpp"

namespace zynqmp {
namespace {

void start() {
  send("000#0105");
  run_ms(1);
}

void rpdo_asynchronous() {
  start_operational();
  send("205#78563412");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 0x12345678);
  CHECK_EQUAL(record_of(device).pdos, 1);
}

void rpdo_synchronous() {
  start_operational();
  send("305#01000000");
  send("305#02000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[1], 0);
  ASK("080#", "285#00000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[1], 2);
}

void tpdo_on_event() {
  start_operational();
  objects.sent[0] = 0xA1B2C3D4;
  CHECK_EQUAL(COTPdoRequest(&device, 0), CO_ERR_NONE);
  RX("185#D4C3B2A1");
}

void tpdo_on_remote_request() {
  start_operational();
  objects.sent[0] = 0xA1B2C3D4;
  ASK("185#R", "185#D4C3B2A1");
}

void tpdo_inhibit_time() {
  start_device();
  ASK("605#2300180185010080", "585#6000180100000000");  // off
  ASK("605#2B001803E8030000", "585#6000180300000000");  // 100 ms
  ASK("605#2300180185010000", "585#6000180100000000");
  start();
  objects.sent[0] = 1;
  COTPdoRequest(&device, 0);
  const std::uint64_t first = RX("185#01000000");
  objects.sent[0] = 2;
  COTPdoRequest(&device, 0);
  objects.sent[0] = 3;
  const std::uint64_t second = RX("185#03000000", 110);
  CHECK(second - first >= 99900 && second - first < 100100);
}

void tpdo_event_timer() {
  start_device();
  ASK("605#2B00180564000000", "585#6000180500000000");  // 100 ms
  start();
  std::uint64_t last = RX("185#00000000", 110);
  for (unsigned n = 0; n < 5 && !has_failed(); ++n) {
    const std::uint64_t time = RX("185#00000000", 110);
    CHECK(time - last > 99900 && time - last < 100100);
    last = time;
  }
}

void tpdo_synchronous() {
  start_operational();
  for (unsigned n = 0; n < 3; ++n) {
    ASK("080#", "285#00000000");
  }
  ASK("605#2F01180202000000", "585#6001180200000000");  // type 2: every second one
  send("080#");
  SILENT(20);
  ASK("080#", "285#00000000");
}

void tpdo_acyclic() {
  start_operational();
  ASK("605#2F01180200000000", "585#6001180200000000");  // type 0
  ASK("080#", "285#00000000");
  send("080#");
  SILENT(20);
  objects.sent[1] = 7;
  CHECK_EQUAL(COTPdoRequest(&device, 1), CO_ERR_NONE);
  SILENT(20);
  ASK("080#", "285#07000000");
}

void extended_identifiers() {
  start_device();
  ASK("605#2300140105020080", "585#6000140100000000");  // off
  ASK("605#23001401F1DEBC2A", "585#6000140100000000");  // 0ABCDEF1h
  ASK("605#2300180185010080", "585#6000180100000000");
  ASK("605#23001801F2DEBC2A", "585#6000180100000000");  // 0ABCDEF2h
  start();
  send("0ABCDEF1#04030201");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 0x01020304);
  objects.sent[0] = 0x11223344;
  COTPdoRequest(&device, 0);
  RX("0ABCDEF2#44332211");
  ASK("0ABCDEF2#R", "0ABCDEF2#44332211");
}

void sync_producer() {
  start_device();
  ASK("605#2306100010270000", "585#6006100000000000");  // 10 ms
  ASK("605#2305100080000040", "585#6005100000000000");
  std::uint64_t last = RX("080#");
  for (unsigned n = 0; n < 20 && !has_failed(); ++n) {
    const std::uint64_t time = RX("080#");
    CHECK(time - last > 9900 && time - last < 10100);
    last = time;
  }
  ASK("605#2305100080000000", "585#6005100000000000");
}

constexpr Case cases[] = {
    {"RPDO: event-driven, written at once [301:7.2.2.5.1]", rpdo_asynchronous},
    {"RPDO: synchronous, the last one is written at the SYNC [301:7.2.2.5.1]", rpdo_synchronous},
    {"TPDO: sent on request of the application [301:7.2.2.5.2]", tpdo_on_event},
    {"TPDO: sent on a remote frame [301:7.2.2.5.3]", tpdo_on_remote_request},
    {"TPDO: not again before its inhibit time [301:7.2.2.6]", tpdo_inhibit_time},
    {"TPDO: sent by its event timer [301:7.5.2.37]", tpdo_event_timer},
    {"TPDO: synchronous, at every SYNC and at every second one [301:7.2.2.3]", tpdo_synchronous},
    {"TPDO: acyclic, at the first SYNC and at the one behind an event [301:7.2.2.3]", tpdo_acyclic},
    {"PDO: 29-bit identifiers in both directions, remote frame included [301:7.5.2.35]", extended_identifiers},
    {"SYNC producer: every 10 ms within 0.1 ms [301:7.2.5]", sync_producer},
};

}  // namespace

Cases pdo_cases() { return all_of(cases); }

}  // namespace zynqmp
