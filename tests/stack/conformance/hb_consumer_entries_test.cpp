// SPDX-License-Identifier: Apache-2.0
// 1016h, consumer heartbeat time: valid values, and effects of a change on a monitored node.
// [301:7.5.2.19]
#include "lexican/dictionary.hpp"
#include "support/monitor.hpp"

#if CO_HBCONS_N > 0

namespace {

using namespace test;

constexpr const char* five_missing = "081#3081110000050000";

TEST_CASE("1016h: entries are read and written by SDO and by the application [H2]") {
  Monitor node({{5, 100}});
  node.ask("601#4016100000000000", "581#4F161000" + std::string(CO_HBCONS_N == 16 ? "10" : "08") + "000000");
  node.ask("601#4016100100000000", "581#4316100164000500");
  node.ask("601#4016100200000000", "581#4316100200000000");
  node.ask("601#23161002E8037F00", "581#6016100200000000");
  node.ask("601#4016100200000000", "581#43161002E8037F00");
  std::uint32_t value = 0;
  node.call([&] {
    CHECK(CODictRdLong(&node->Dict, CO_DEV(0x1016, 2), &value) == CO_ERR_NONE);
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1016, 2), 0x00110022) == CO_ERR_NONE);
  });
  CHECK(value == 0x007F03E8);
  CHECK(node.entry[1].NodeId == 0x11);
  CHECK(node.entry[1].Time == 0x22);
}

TEST_CASE("1016h: a length other than four bytes is refused") {
  Monitor node({});
  node.ask("601#2B16100164000000", "581#8016100113000706");
  node.ask("601#2F16100164000000", "581#8016100113000706");
  node.ask("601#2316100000000000", "581#8016100002000106");
}

TEST_CASE("1016h: the application reads and writes an entry as four bytes and 1016h:0 as one byte") {
  Monitor node({{5, 100}});
  CO_OBJ* const entry = node.find(0x1016, 1);
  CO_OBJ* const number = node.find(0x1016, 0);
  for (std::uint8_t size = 0; size <= 8; ++size) {
    CAPTURE(unsigned{size});
    std::uint32_t read[2] = {};
    std::uint64_t value = 0x000600C8;
    node.call([&] {
      const CO_ERR expected = size == 4 ? CO_ERR_NONE : CO_ERR_BAD_ARG;
      CHECK(COObjRdValue(entry, &node.node, read, size) == expected);
      CHECK(read[0] == (size == 4 ? 0x00050064U : 0U));
      if (size != 4) CHECK(COObjWrValue(entry, &node.node, &value, size) == CO_ERR_BAD_ARG);
      CHECK((COObjRdValue(number, &node.node, read, size) == CO_ERR_NONE) == (size == 1));
    });
    CHECK(unsigned{node.entry[0].NodeId} == 5);
    CHECK(node.entry[0].Time == 100);
  }
}

TEST_CASE("1016h: an entry with node-ID 0, node-ID above 127 or time 0 is accepted and unused [H2] [H6] [N4]") {
  Monitor node({});
  for (const std::uint32_t value : {0x00000064U, 0x00800064U, 0x00C80064U, 0x00FF0064U, 0x00050000U, 0x007FU << 16}) {
    CHECK(node.configure(1, value) == 0);
  }
  for (const unsigned id : {0x05U, 0x48U, 0x00U, 0x7FU}) {  // C8h modulo 128 is 48h
    const std::uint32_t before = node.counters().Unclaimed;
    node.rx(CO_IF_FRM{0x700U + id, {0x05}, 1});
    CHECK(node.counters().Unclaimed == before + 1);
  }
}

TEST_CASE("1016h: every node-ID is accepted, whether monitored or not [H2] [N4]") {
  Monitor node({}, Setup().only_small());
  for (unsigned id = 0; id < 256; ++id) {
    CAPTURE(id);
    const bool used = id >= 1 && id <= 127;
    REQUIRE(node.configure(1, (id << 16) | 50) == 0);
    CHECK(CONmtGetHbEvents(&node->Nmt, static_cast<std::uint8_t>(id)) == (used ? 0 : -1));
    if (used && id != 1) {
      node.rx(CO_IF_FRM{0x700U + id, {0x05}, 1});
      node.told(std::to_string(id) + " OPERATIONAL");
    }
  }
  node.silent();
}

TEST_CASE("1016h: the reserved byte is not stored [N4]") {
  Monitor node({});
  CHECK(node.configure(1, 0xAB050064) == 0);
  node.ask("601#4016100100000000", "581#4316100164000500");
}

TEST_CASE("1016h: a node that another entry monitors is refused in every entry [H2] [Heartbeat 04]") {
  Monitor node({{5, 100}, {6, 100}});
  CHECK(node.configure(2, 0x000500C8) == 0x06040043);
  CHECK(node.configure(3, 0x00050001) == 0x06040043);
  CHECK(node.configure(1, 0x00060064) == 0x06040043);
  node.ask("601#4016100100000000", "581#4316100164000500");
  node.ask("601#4016100200000000", "581#4316100264000600");
  node.ask("601#4016100300000000", "581#4316100300000000");
  CHECK(node.configure(3, 0x00050000) == 0);  // time 0: monitors no node
  CHECK(node.configure(1, 0x00050000) == 0);
  CHECK(node.configure(3, 0x00050064) == 0);  // node 5 is in no other entry now
  CHECK(node.configure(1, 0x00050064) == 0x06040043);
}

TEST_CASE("1016h: refused writes do not affect a monitored node [H2]") {
  Monitor node({{5, 100}, {6, 100}});
  node.rx("705#05");
  node.after(50ms);
  CHECK(node.configure(2, 0x000500C8) == 0x06040043);
  CHECK(node.configure(1, 0x000600C8) == 0x06040043);
  node.after(50ms);
  node.told("5 OPERATIONAL, 5 missing");
  node.emergency(five_missing);
}

TEST_CASE("1016h: writing the present value of an entry changes nothing [H2] [H6]") {
  Monitor node({{5, 100}});
  node.rx("705#05");
  node.after(60ms);
  CHECK(node.configure(1, 0x00050064) == 0);
  CHECK(CONmtLastHbState(&node->Nmt, 5) == CO_OPERATIONAL);
  node.after(40ms);
  node.told("5 OPERATIONAL, 5 missing");
  node.emergency(five_missing);
}

TEST_CASE("1016h: a new time for a monitored node stops monitoring until its next heartbeat [H6]") {
  Monitor node({{5, 100}});
  node.rx("705#05");
  node.told("5 OPERATIONAL");
  node.after(60ms);
  CHECK(node.configure(1, 0x0005000A) == 0);
  CHECK(CONmtLastHbState(&node->Nmt, 5) == CO_INVALID);
  CHECK(node.armed_timers() == 0);
  node.after(1000ms);
  node.told("");
  node.rx("705#05");
  node.after(10ms);
  node.told("5 OPERATIONAL, 5 missing");
  node.emergency(five_missing);
}

TEST_CASE("1016h: an active entry accepts another node while both nodes send heartbeats [D8]") {
  Monitor node({{5, 100}, {7, 100}});
  node.rx("705#05");
  node.rx("707#05");
  node.told("5 OPERATIONAL, 7 OPERATIONAL");
  CHECK(node.configure(1, 0x00060064) == 0);
  for (int beat = 0; beat < 5; ++beat) {
    node.rx("705#05");
    node.rx("706#05");
    node.rx("707#05");
    node.after(90ms);
  }
  node.told("6 OPERATIONAL");
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == -1);
  CHECK(CONmtGetHbEvents(&node->Nmt, 6) == 0);
  CHECK(CONmtGetHbEvents(&node->Nmt, 7) == 0);
}

TEST_CASE("1016h: time 0 for a node that another entry monitors affects no other entry [D9]") {
  Monitor node({{5, 100}, {6, 100}, {7, 100}});
  for (const char* beat : {"705#05", "706#05", "707#05"}) node.rx(beat);
  CHECK(node.configure(3, 0x00050000) == 0);
  node.record.clear();
  node.after(100ms);
  node.told("5 missing, 6 missing");
#if USE_EMCY
  node.tx({five_missing, "081#3081110000060000"});
#endif
}

TEST_CASE("1016h: changing an entry while its node is missing clears the error without a message [H6]") {
  for (const std::uint32_t value : {0x000500C8U, 0x00060064U, 0x00000000U}) {
    CAPTURE(value);
    Monitor node({{5, 100}});
    node.rx("705#05");
    node.after(100ms);
    node.emergency(five_missing);
    node.told("5 OPERATIONAL, 5 missing");
    CHECK(node.configure(1, value) == 0);
    node.ask("601#4001100000000000", "581#4F01100000000000");
    node.after(1000ms);
    node.silent();
    node.told("");
  }
}

TEST_CASE("1016h: an entry may be changed after its time has elapsed and before the timer runs [D11]") {
  Monitor node({{5, 100}});
  node.rx("705#05");
  node.told("5 OPERATIONAL");
  node.elapse_only(100ms);
  CHECK(node.configure(1, 0x000500C8) == 0);
  node.after(1000ms);
  node.told("");
  node.silent();
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("1016h: a time beyond the range of the timer is refused, and the old entry stays") {
  Monitor node({{5, 100}}, Setup().rate(1000000000));
  CHECK(node.configure(1, 0x0005FFFF) == 0x06090030);
  node.ask("601#4016100100000000", "581#4316100164000500");
  node.rx("705#05");
  node.after(100ms);
  node.told("5 OPERATIONAL, 5 missing");
  node.emergency(five_missing);
}

TEST_CASE("1016h: the first of two entries for one node is used; CONodeGetErr() reports the duplicate") {
  Monitor node({{5, 100}, {5, 10}, {6, 100}});
  CHECK(node.error() == CO_ERR_OBJ_INIT);
  node.rx("705#05");
  node.rx("706#05");
  node.after(100ms);
  node.told("5 OPERATIONAL, 6 OPERATIONAL, 5 missing, 6 missing");
#if USE_EMCY
  node.tx({five_missing, "081#3081110000060000"});
#endif
  CHECK(node.configure(2, 0x0005000A) == 0x06040043);
  CHECK(node.configure(1, 0) == 0);
  CHECK(node.configure(2, 0x0005000A) == 0);
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 0);
}

TEST_CASE("1016h: entries missing in the table, and 1016h:0 as a variable, are handled") {
  std::uint8_t number = 2;
  MonitorEntries memory({{5, 100}, {6, 100}});
  Fixture node(Setup()
                   .with({CO_KEY(0x1016, 0, CO_OBJ_____R_), CO_THB_CONS, &number})
                   .with({CO_KEY(0x1016, 2, CO_OBJ_____R_), CO_THB_CONS, &memory.entry[1]}));
  std::vector<unsigned> heard;
  callbacks().heartbeat_change = [&](CO_NMT*, std::uint8_t id, CO_MODE) { heard.push_back(id); };
  node.rx("705#05");
  node.rx("706#05");
  CHECK(heard == std::vector<unsigned>{6});
  node.ask("601#4016100000000000", "581#4F16100002000000");
  node.ask("601#4016100100000000", "581#8016100111000906");
}

#if USE_DICT_CHECK

TEST_CASE("1016h: entries at a wrong index or with flag D are refused at start; others are reported") {
  static CO_HBCONS entry{nullptr, nullptr, CO_INVALID, 0, 100, 5, 0};
  const auto fault = [](CO_OBJ obj) {
    Fixture node(Setup().with(obj).stay_in_init());
    const CO_DICT_FAULT found = CODictGetFault(&node->Dict, nullptr);
    CHECK(node.error() == (found == CO_DICT_NO_DATA ? CO_ERR_OBJ_INIT : CO_ERR_DICT_INIT));
    return found;
  };
  CHECK(fault({CO_KEY(0x1016, 1, CO_OBJ_D___RW), CO_THB_CONS, 0x00050064}) == CO_DICT_DIRECT_TYPE);
  CHECK(fault({CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, 0}) == CO_DICT_NO_DATA);
  CHECK(fault({CO_KEY(0x2016, 1, CO_OBJ_____RW), CO_THB_CONS, &entry}) == CO_DICT_WRONG_PLACE);
  CHECK(fault({CO_KEY(0x1016, CO_HBCONS_N + 1, CO_OBJ_____RW), CO_THB_CONS, &entry}) == CO_DICT_NOT_CONFIGURED);
}

#endif

// The dictionary contains C casts, as in firmware.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
CO_HBCONS proved[2];
std::uint8_t behaviour;
constexpr CO_OBJ table[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, (CO_DATA)(2)},
    {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&proved[0])},
    {CO_KEY(0x1016, 2, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&proved[1])},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1029, 0, CO_OBJ_D___R_), CO_TERROR_BEHAVIOUR, (CO_DATA)(1)},
    {CO_KEY(0x1029, 1, CO_OBJ_____RW), CO_TERROR_BEHAVIOUR, (CO_DATA)(&behaviour)},
    {CO_KEY(0x1F80, 0, CO_OBJ_D___R_), CO_TNMT_STARTUP, (CO_DATA)(4)},
    CO_OBJ_DICT_ENDMARK,
};
constexpr CO_OBJ value_in_entry[] = {{CO_KEY(0x1016, 1, CO_OBJ_D___R_), CO_THB_CONS, (CO_DATA)(0x00050064)}};
constexpr CO_OBJ too_many[] = {{CO_KEY(0x1016, CO_HBCONS_N + 1, 0), CO_THB_CONS, (CO_DATA)(&proved[0])}};
constexpr CO_OBJ elsewhere[] = {{CO_KEY(0x102A, 1, CO_OBJ_____RW), CO_TERROR_BEHAVIOUR, (CO_DATA)(&behaviour)}};
#pragma GCC diagnostic pop

// Checks of 1016h, 1029h and 1F80h at compile time.
CO_OD_CHECK(table);
static_assert(co::dictionary::check<value_in_entry>().fault == CO_DICT_DIRECT_TYPE);
static_assert(co::dictionary::check<too_many>().fault == CO_DICT_NOT_CONFIGURED);
static_assert(co::dictionary::check<elsewhere>().fault == CO_DICT_WRONG_PLACE);

TEST_CASE("1016h: the application sets an entry by its position and activates it") {
  Monitor node({});
  node.entry[1] = {&node.node, nullptr, (CO_MODE)0, 0, 0, 0, 0};
  CO_HBCONS* const second = &node.entry[1];
  node.call([&] { CHECK(CONmtHbConsActivate(second, 100, 5) == CO_ERR_NONE); });
  node.rx("705#05");
  node.after(100ms);
  node.told("5 OPERATIONAL, 5 missing");
  node.emergency(five_missing);
  node.call([&] {
    CHECK(CONmtHbConsActivate(&node.entry[0], 100, 5) == CO_ERR_OBJ_INCOMPATIBLE);
    CHECK(CONmtHbConsActivate(second, 0, 5) == CO_ERR_NONE);
    CHECK(CONmtHbConsActivate(&node.entry[0], 100, 5) == CO_ERR_NONE);
  });
  CHECK(CONmtHbConsActivate(nullptr, 100, 5) == CO_ERR_BAD_ARG);
  CO_HBCONS stranger = {&node.node, nullptr, CO_INVALID, 0, 100, 9, 0};
  CHECK(CONmtHbConsActivate(&stranger, 100, 9) == CO_ERR_BAD_ARG);
  stranger.Node = nullptr;
  CHECK(CONmtHbConsActivate(&stranger, 100, 9) == CO_ERR_BAD_ARG);
}

TEST_CASE("heartbeat consumer: missed heartbeats are counted up to 255") {
  Monitor node({{5, 1}});
  node.rx("705#05");
  node.after(254ms);
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 254);
  node.after(300ms);
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 255);
  CHECK(CONmtGetHbEvents(&node->Nmt, 5) == 0);
  node.emergency(five_missing);
  node.record.clear();
}

TEST_CASE("heartbeat consumer: unmonitored nodes, null and an NMT object without node are handled") {
  Monitor node({{5, 0}});
  for (const unsigned id : {0U, 5U, 6U, 127U, 128U, 255U}) {
    CHECK(CONmtGetHbEvents(&node->Nmt, static_cast<std::uint8_t>(id)) == -1);
    CHECK(CONmtLastHbState(&node->Nmt, static_cast<std::uint8_t>(id)) == CO_INVALID);
  }
  CO_NMT without_node = {};
  for (CO_NMT* const nmt : {static_cast<CO_NMT*>(nullptr), &without_node}) {
    CHECK(CONmtGetHbEvents(nmt, 5) == -1);
    CHECK(CONmtLastHbState(nmt, 5) == CO_INVALID);
  }
  CHECK(callbacks().fatal_errors == 4);
}

TEST_CASE("heartbeat consumer: a callback may change the entry of the heartbeat that is being processed [Q9]") {
  Monitor node({{5, 100}});
  callbacks().heartbeat_change = [&](CO_NMT*, std::uint8_t, CO_MODE) {
    node.record.push_back("changed");
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1016, 1), 0x00060064) == CO_ERR_NONE);
  };
  node.rx("705#05");
  node.told("changed");
  CHECK(CONmtLastHbState(&node->Nmt, 6) == CO_INVALID);
  CHECK(node.armed_timers() == 0);
  callbacks().heartbeat_change = nullptr;
  node.rx("706#05");
  CHECK(CONmtLastHbState(&node->Nmt, 6) == CO_OPERATIONAL);
}

TEST_CASE("heartbeat consumer: a callback may end the monitoring of all nodes [Q9]") {
  Monitor node({{5, 100}, {6, 100}});
  callbacks().heartbeat_event = [&](CO_NMT*, std::uint8_t id) {
    node.record.push_back(std::to_string(id) + " missing");
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1016, 1), 0) == CO_ERR_NONE);
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1016, 2), 0) == CO_ERR_NONE);
  };
  node.rx("705#05");
  node.rx("706#05");
  node.after(100ms);
  node.told("5 OPERATIONAL, 6 OPERATIONAL, 5 missing");
  node.emergency(five_missing);
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("heartbeat consumer: a callback may reset or stop the node [Q9] [T14]") {
  for (const bool stop : {false, true}) {
    CAPTURE(stop);
    Monitor node({{5, 100}, {6, 100}});
    callbacks().heartbeat_event = [&](CO_NMT* nmt, std::uint8_t) {
      stop ? CONodeStop(nmt->Node) : CONmtReset(nmt, CO_RESET_COM);
    };
    node.rx("705#05");
    node.rx("706#05");
    node.after(100ms);
    node.told(std::string("5 OPERATIONAL, 6 OPERATIONAL, mode ") + (stop ? "INVALID" : "INIT, mode PREOP"));
#if USE_EMCY
    stop ? node.silent() : node.tx({five_missing, "081#3081110000060000", "701#00"});
#else
    stop ? node.silent() : node.tx("701#00");
#endif
    CHECK(node.armed_timers() == 0);
    node.after(1000ms);
    node.silent();
  }
}

}  // namespace

#endif
