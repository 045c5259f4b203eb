// SPDX-License-Identifier: Apache-2.0
// NMT slave and error control. [301:7.3.2, 7.2.8]
#include "bus.hpp"
#include "cases.hpp"
#include "nodes.hpp"

namespace zynqmp {
namespace {

CO_MODE mode() { return CONmtGetMode(&device.Nmt); }

void set_heartbeat_time_100_ms() { ASK("605#2B17100064000000", "585#6017100000000000"); }

void boot_up() {
  start_device();
  CHECK(mode() == CO_PREOP);
  SILENT(50);
}

void commands() {
  start_device();
  set_heartbeat_time_100_ms();
  RX("705#7F", 110);
  send("000#0105");
  RX("705#05", 110);
  send("000#0205");
  RX("705#04", 110);
  send("000#8005");
  RX("705#7F", 110);
  send("000#0100");
  RX("705#05", 110);
}

void not_for_this_node() {
  start_device();
  send("000#0106");    // another node
  send("000#0305");    // invalid command specifier
  send("000#01");      // too short
  send("000#010500");  // too long
  run_ms(1);
  CHECK(mode() == CO_PREOP);
}

void reset(const char* command, CO_NMT_RESET type) {
  start_operational();
  set_heartbeat_time_100_ms();
  send(command);
  RX("705#00");
  CHECK(mode() == CO_PREOP);
  CHECK_EQUAL(record_of(device).resets[type], 1);
  ASK("605#4000100000000000", "585#4300100092010200");
}
void reset_node() { reset("000#8105", CO_RESET_NODE); }
void reset_communication() { reset("000#8205", CO_RESET_COM); }

void services_by_state() {
  start_device();
  send("205#01000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 0);
  send("000#0205");
  send("605#4000100000000000");
  SILENT(20);
  CHECK(mode() == CO_STOP);
  send("000#0105");
  send("205#02000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 2);
}

void heartbeat_producer() {
  start_device();
  set_heartbeat_time_100_ms();
  std::uint64_t last = RX("705#7F", 110);
  for (unsigned n = 0; n < 10 && !has_failed(); ++n) {
    const std::uint64_t time = RX("705#7F", 110);
    const std::uint64_t period = time - last;
    CHECK(period > 99900 && period < 100100);
    last = time;
  }
  ASK("605#2B17100000000000", "585#6017100000000000");
  SILENT(300);
}

void heartbeat_consumer() {
  start_device();
  ASK("605#2316100164000100", "585#6016100100000000");  // node 1, 100 ms
  send("701#05");
  SILENT(90);
  RX("085#3081110000010000", 20);  // 8130h, node 1
  CHECK_EQUAL(record_of(device).heartbeat_events, 1);
  CHECK_EQUAL(CONmtGetHbEvents(&device.Nmt, 1), 1);
  ASK("701#05", "085#0000000000010000");
}

void node_guarding() {
  start_device();
  ASK("705#R", "705#7F");
  ASK("705#R", "705#FF");
  send("000#0105");
  ASK("705#R", "705#05");
}

constexpr Case cases[] = {
    {"boot-up: one message, then Pre-operational [301:7.3.2.2.1]", boot_up},
    {"NMT: start, stop, enter pre-operational, to one node and to all; the heartbeat tells the state [N2, N5]",
     commands},
    {"NMT: other nodes, unknown commands and wrong lengths are ignored [N1, N2]", not_for_this_node},
    {"NMT: reset node ends in boot-up and Pre-operational [N4, N6]", reset_node},
    {"NMT: reset communication ends in boot-up and Pre-operational [N4, N6]", reset_communication},
    {"NMT: PDO in Operational only, no SDO in Stopped [N3]", services_by_state},
    {"heartbeat producer: every 100 ms within 0.1 ms, none with 0 [301:7.2.8.2.2.1]", heartbeat_producer},
    {"heartbeat consumer: missing after its time, 8130h; back, 0000h [301:7.2.8.3.2.2]", heartbeat_consumer},
    {"node guarding: remote frames are answered, the toggle bit alternates [301:7.2.8.2.2.1]", node_guarding},
};

}  // namespace

Cases nmt_cases() { return all_of(cases); }

}  // namespace zynqmp
