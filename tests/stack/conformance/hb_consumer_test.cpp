// SPDX-License-Identifier: Apache-2.0
// Heartbeat consumer: detection of missing nodes, callbacks and EMCY messages. [301:7.2.8.3.2.2, 7.5.2.19]
#include <algorithm>

#include "support/monitor.hpp"

#if CO_HBCONS_N > 0

namespace {

using namespace test;

constexpr const char* five_missing = "081#3081110000050000";
constexpr const char* five_back = "081#0000000000050000";

TEST_CASE("heartbeat consumer: nothing happens before the first heartbeat [H3] [Heartbeat 06]") {
  Monitor node({{5, 100}});
  node.rx("000#0101");
  node.told("mode OPERATIONAL");
  node.after(70000ms);
  node.silent();
  CHECK(node.mode() == CO_OPERATIONAL);
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("heartbeat consumer: the time starts with the first heartbeat or boot-up message [H3]") {
  for (const std::string first : {"00", "7F", "05", "04"}) {
    CAPTURE(first);
    Monitor node({{5, 100}});
    node.after(1234ms);
    node.rx("705#" + first);
    node.record.clear();
    node.after(99ms);
    node.told("");
    node.silent();
    node.after(1ms);
    node.told("5 missing");
    node.emergency(five_missing);
  }
}

TEST_CASE("heartbeat consumer: a node whose heartbeat is faster than its time is never missing [Heartbeat 05]") {
  Monitor node({{5, 100}});
  node.rx("000#0101");
  node.told("mode OPERATIONAL");
  for (int beat = 0; beat < 1000; ++beat) {
    node.rx("705#05");
    node.after(99ms);
  }
  node.told("5 OPERATIONAL");
  node.silent();
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 0);
}

TEST_CASE(
    "heartbeat consumer: a slower node causes EMCY 8130h for every miss and 0000h when it is back [Heartbeat 06]") {
  Monitor node({{5, 100}});
  node.rx("705#7F");
  node.told("5 PREOP");
  for (int beat = 0; beat < 100; ++beat) {
    CAPTURE(beat);
    node.after(150ms);
    node.told("5 missing");
    node.emergency(five_missing);
    node.rx("705#7F");
    node.told("5 PREOP");
    node.emergency(five_back);
  }
}

TEST_CASE("heartbeat consumer: a missing node is one error but a callback and an event in every period [H3] [B2]") {
  Monitor node({{5, 100}});
  node.rx("000#0101");
  node.rx("705#05");
  node.told("mode OPERATIONAL, 5 OPERATIONAL");
  node.after(100ms);
  node.told("5 missing, mode PREOP");
  node.emergency(five_missing);
  node.rx("000#0101");
  node.told("mode OPERATIONAL");
  for (int period = 0; period < 9; ++period) {
    node.after(99ms);
    node.told("");
    node.after(1ms);
    node.told("5 missing");
  }
  node.silent();
  CHECK(node.mode() == CO_OPERATIONAL);
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 10);
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 0);
  node.rx("705#05");
  node.told("5 OPERATIONAL");
  node.emergency(five_back);
  node.after(100ms);
  node.told("5 missing, mode PREOP");
  node.emergency(five_missing);
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 1);
}

TEST_CASE("heartbeat consumer: after a missing heartbeat the time starts with the next heartbeat [H3]") {
  Monitor node({{5, 100}});
  node.rx("705#7F");
  node.after(130ms);
  node.emergency(five_missing);
  node.rx("705#7F");
  node.emergency(five_back);
  node.told("5 PREOP, 5 missing, 5 PREOP");
  node.after(99ms);
  node.told("");
  node.after(1ms);
  node.told("5 missing");
  node.emergency(five_missing);
}

TEST_CASE("heartbeat consumer: it monitors in Pre-operational, Operational and, without EMCY, in Stopped [H4] [N9]") {
  for (const std::string command : {"000#8001", "000#0101", "000#0201"}) {
    CAPTURE(command);
    Monitor node({{5, 100}}, Setup().with({CO_KEY(0x1029, 1, CO_OBJ_D___R_), CO_TUNSIGNED8, 1}));
    const bool stopped = command == "000#0201";
    node.rx(command);
    node.record.clear();
    node.rx("705#05");
    node.told("5 OPERATIONAL");
    node.after(100ms);
    node.told("5 missing");
    stopped ? node.silent() : node.emergency(five_missing);
    node.rx("705#04");
    node.told("5 STOP");
    stopped ? node.silent() : node.emergency(five_back);
  }
}

TEST_CASE("heartbeat consumer: a change of the own NMT state does not affect the time [H4]") {
  Monitor node({{5, 100}}, Setup().with({CO_KEY(0x1029, 1, CO_OBJ_D___R_), CO_TUNSIGNED8, 1}));
  node.rx("705#05");
  node.after(30ms);
  node.rx("000#0101");
  node.after(30ms);
  node.rx("000#0201");
  node.after(30ms);
  node.rx("000#8001");
  node.told("5 OPERATIONAL, mode OPERATIONAL, mode STOP, mode PREOP");
  node.after(9ms);
  node.told("");
  node.after(1ms);
  node.told("5 missing");
  node.emergency(five_missing);
}

TEST_CASE("heartbeat consumer: each change of the state is reported, and every boot-up message [H3]") {
  Monitor node({{5, 100}});
  for (const std::string state : {"00", "00", "7F", "7F", "05", "05", "04", "00", "00"}) {
    node.rx("705#" + state);
  }
  node.told("5 INIT, 5 INIT, 5 PREOP, 5 OPERATIONAL, 5 STOP, 5 INIT, 5 INIT");
}

TEST_CASE("heartbeat consumer: a missing node that returns in the same state is reported [H3]") {
  Monitor node({{5, 100}});
  node.rx("705#05");
  node.after(100ms);
  node.emergency(five_missing);
  CHECK(CONmtLastHbState(&node->Nmt, 5) == CO_OPERATIONAL);
  node.told("5 OPERATIONAL, 5 missing");
  node.rx("705#05");
  node.told("5 OPERATIONAL");
  node.emergency(five_back);
}

TEST_CASE("heartbeat consumer: within the callback of a change CONmtLastHbState returns the previous state") {
  Monitor node({{5, 100}});
  std::vector<CO_MODE> before;
  callbacks().heartbeat_change = [&](CO_NMT* nmt, std::uint8_t id, CO_MODE) {
    before.push_back(CONmtLastHbState(nmt, id));
  };
  node.rx("705#7F");
  node.rx("705#05");
  node.rx("705#04");
  CHECK(before == std::vector<CO_MODE>{CO_INVALID, CO_PREOP, CO_OPERATIONAL});
  CHECK(CONmtLastHbState(&node->Nmt, 5) == CO_STOP);
}

TEST_CASE("heartbeat consumer: the toggle bit of a guarded node is ignored [H4]") {
  Monitor node({{5, 100}});
  node.rx("705#85");
  node.told("5 OPERATIONAL");
  node.rx("705#05");
  node.told("");
  node.rx("705#FF");
  node.told("5 PREOP");
  node.after(99ms);
  node.rx("705#7F");
  node.after(99ms);
  node.told("");
}

TEST_CASE("heartbeat consumer: a remote frame is malformed and no heartbeat") {
  Monitor node({{5, 100}});
  node.rx("705#7F");
  node.told("5 PREOP");
  node.after(50ms);
  const std::uint32_t before = node.counters().Malformed;
  node.rx("705#R1");
  CHECK(node.counters().Malformed == before + 1);
  node.after(50ms);
  node.told("5 missing");
  node.emergency(five_missing);
}

TEST_CASE("heartbeat consumer: heartbeats of other nodes and 29-bit frames are not processed") {
  Monitor node({{5, 100}});
  node.rx("705#7F");
  const std::uint32_t before = node.counters().Unclaimed;
  node.after(50ms);
  node.rx("706#7F");
  node.rx("704#7F");
  node.rx("00000705#05");
  CHECK(node.counters().Unclaimed == before + 3);
  node.after(50ms);
  node.told("5 PREOP, 5 missing");
  node.emergency(five_missing);
}

// Returns the effect of a heartbeat according to the standard.
std::string expected_of(unsigned byte, unsigned dlc, CO_MODE& state) {
  const unsigned told = byte & 0x7FU;
  const CO_MODE mode = told == 0     ? CO_INIT
                       : told == 4   ? CO_STOP
                       : told == 5   ? CO_OPERATIONAL
                       : told == 127 ? CO_PREOP
                                     : CO_INVALID;
  if (dlc != 1) {
    return "";
  }
  state = mode;
  return "5 " + name_of(mode);
}

TEST_CASE("heartbeat consumer: every state byte in frames of every length has the defined effect [H4] [N5]") {
  for (unsigned dlc = 0; dlc <= 8; ++dlc) {
    for (unsigned byte = 0; byte < 256; byte += dlc == 1 ? 1 : stride(31)) {
      CAPTURE(dlc);
      CAPTURE(byte);
      Monitor node({{5, 100}}, Setup().only_small());
      CO_MODE state = CO_INVALID;
      const std::string expected = expected_of(byte, dlc, state);
      CO_IF_FRM frm = frame("705#");
      frm.DLC = static_cast<std::uint8_t>(dlc);
      frm.Data[0] = static_cast<std::uint8_t>(byte);
      node.rx(frm);
      node.told(expected);
      CHECK(CONmtLastHbState(&node->Nmt, 5) == state);
      CHECK(node.counters().Malformed == (dlc == 1 ? 0 : 1));
      CHECK(node.armed_timers() == (dlc == 1 ? 1 : 0));
      node.silent();
    }
  }
}

TEST_CASE("heartbeat consumer: a heartbeat with a reserved state restarts the time [H3]") {
  Monitor node({{5, 100}});
  node.rx("705#11");
  node.told("5 INVALID");
  node.after(99ms);
  node.rx("705#11");
  node.after(99ms);
  node.told("");
  node.rx("705#12");  // another reserved state: not a new state
  node.told("");
  node.after(99ms);
  node.rx("705#05");
  node.told("5 OPERATIONAL");
}

TEST_CASE("heartbeat consumer: reset node and reset communication restart it [D21] [T14] [Heartbeat 07]") {
  for (const std::string reset : {"000#8101", "000#8201"}) {
    for (const int moment : {0, 1, 2}) {  // before the first heartbeat, after it, after a heartbeat event
      CAPTURE(reset);
      CAPTURE(moment);
      Monitor fresh({{5, 100}});
      Monitor node({{5, 100}});
      fresh.record.clear();
      if (moment > 0) node.rx("705#05");
      if (moment > 1) {
        node.after(100ms);
        node.emergency(five_missing);
      }
      node.rx(reset);
      node.tx("701#00");
      node.record.clear();
      CHECK(node.difference(fresh) == "");
      CHECK(node.armed_timers() == 0);
      CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 0);
      CHECK(CONmtLastHbState(&node->Nmt, 5) == CO_INVALID);
      node.ask("601#4001100000000000", "581#4F01100000000000");
      node.after(1000ms);
      node.silent();
      node.told("");
      node.rx("000#0101");
      node.rx("705#05");
      node.after(100ms);
      node.told("mode OPERATIONAL, 5 OPERATIONAL, 5 missing, mode PREOP");
      node.emergency(five_missing);
    }
  }
}

TEST_CASE("heartbeat consumer: it ends with CONodeStop and restarts with the node") {
  Monitor node({{5, 100}});
  node.rx("705#05");
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.armed_timers() == 0);
  node.after(1000ms);
  node.told("5 OPERATIONAL, mode INVALID");
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == -1);
  node.init_again();
  node.rx("705#05");  // in CO_INIT
  CHECK(node.armed_timers() == 0);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  node.record.clear();
  node.rx("705#05");
  node.after(100ms);
  node.told("5 OPERATIONAL, 5 missing");
  node.emergency(five_missing);
}

TEST_CASE("heartbeat consumer: the filter of the driver follows the monitored nodes") {
  Monitor node({{5, 100}});
  const auto passes = [&](std::uint32_t id) {
    return std::find(node.can.filter.begin(), node.can.filter.end(), id) != node.can.filter.end();
  };
  CHECK(passes(0x705));
  CHECK_FALSE(passes(0x706));
  CHECK(node.configure(1, 0x00060064) == 0);
  CHECK_FALSE(passes(0x705));
  CHECK(passes(0x706));
  CHECK(node.configure(1, 0x00060000) == 0);
  CHECK_FALSE(passes(0x706));
}

}  // namespace

#endif
