// SPDX-License-Identifier: Apache-2.0
// CONodeProcess() within CONmtModeChange(): the node is between two NMT states and processes no frame.
#include "support/emcy_fixture.hpp"
#include "support/fixture.hpp"
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

// Calls CONodeProcess() in every mode change, and checks that it reads no frame from the driver.
struct Nested {
  explicit Nested(Fixture& fixture) {
    callbacks().mode_change = [this, &fixture](CO_NMT* nmt, CO_MODE) {
      ++changes;
      const std::size_t waiting = fixture.can.to_node.size();
      CONodeProcess(nmt->Node);
      CONodeProcess(nmt->Node);
      CHECK(fixture.can.to_node.size() == waiting);
    };
  }
  unsigned changes = 0;
};

void receive(Fixture& node, const char* text) { node.can.to_node.push_back(frame(text)); }

constexpr const char* request = "601#4000100000000000";
constexpr const char* answer = "581#4300100091010F00";

TEST_CASE("mode change: CONodeProcess within CONmtModeChange reads no frame; the next call processes it") {
  for (const CO_MODE mode : {CO_OPERATIONAL, CO_PREOP}) {
    CAPTURE(mode);
    Fixture node;
    if (mode == CO_PREOP) node.rx("000#0101");
    const Nested nested(node);
    receive(node, request);
    node.call([&] { CONmtSetMode(&node->Nmt, mode); });
    CHECK(nested.changes == 1);
    CHECK(node.mode() == mode);
    node.silent();
    node.loop();
    node.tx(answer);
  }
}

TEST_CASE("mode change: a frame read by CONodeProcess before Stopped is passed to the application after the change") {
  Fixture node;
  const Nested nested(node);
  unsigned received = 0;
  callbacks().can_receive = [&](CO_IF_FRM*) { ++received; };
  receive(node, request);
  node.call([&] { CONmtSetMode(&node->Nmt, CO_STOP); });
  CHECK(nested.changes == 1);
  node.loop();
  node.silent();
  CHECK(received == 1);
}

TEST_CASE("mode change: an NMT command that CONodeProcess reads within the change is carried out after it") {
  Fixture node;
  const Nested nested(node);
  receive(node, "000#0201");
  node.call([&] { CONmtSetMode(&node->Nmt, CO_OPERATIONAL); });
  CHECK(node.mode() == CO_OPERATIONAL);
  node.loop();
  CHECK(node.mode() == CO_STOP);
  CHECK(nested.changes == 2);
}

TEST_CASE("mode change: CONodeProcess within the change to Pre-operational and in every reset loses no frame") {
  const std::vector<std::function<void(CO_NODE*)>> actions = {[](CO_NODE* n) { CONmtReset(&n->Nmt, CO_RESET_NODE); },
                                                              [](CO_NODE* n) { CONmtReset(&n->Nmt, CO_RESET_COM); }};
  for (const auto& action : actions) {
    Fixture node;
    const Nested nested(node);
    receive(node, request);
    node.call([&] { action(&node.node); });
    CHECK(nested.changes == 2);
    node.tx("701#00");
    node.loop();
    node.tx(answer);
  }
  Fixture node(Setup().stay_in_init());
  const Nested nested(node);
  receive(node, request);
  node.call([&] { CONodeStart(&node.node); });
  CHECK(nested.changes == 1);
  node.tx("701#00");
  node.loop();
  node.tx(answer);
}

TEST_CASE("mode change: CONodeProcess within a change that an NMT command has caused does nothing") {
  Fixture node;
  const Nested nested(node);
  receive(node, "000#0101");
  receive(node, request);
  node.call([&] { CONodeProcess(&node.node); });
  CHECK(nested.changes == 1);
  CHECK(node.mode() == CO_OPERATIONAL);
  node.silent();
  node.loop();
  node.tx(answer);
}

TEST_CASE("mode change: CONodeProcess within CONodeStop processes no frame during the call or later") {
  Fixture node;
  const Nested nested(node);
  receive(node, request);
  node.call([&] { CONodeStop(&node.node); });
  CHECK(nested.changes == 1);
  node.loop();
  node.silent();
  CHECK(node.mode() == CO_INVALID);
}

TEST_CASE("mode change: queued frames are sent after CONmtModeChange, not within it") {
  Fixture node;
  node.can.refuse_all();
  node.rx(request);
  node.can.accept_all();
  const std::uint64_t attempts = node.can.attempts;
  std::uint64_t attempts_within = 0;
  callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE) {
    CONodeProcess(nmt->Node);
    attempts_within = node.can.attempts;
  };
  node.call([&] { CONmtSetMode(&node->Nmt, CO_OPERATIONAL); });
  CHECK(attempts_within == attempts);
  node.loop();
  node.tx(answer);
}

// Order of the frames that one call causes: response, EMCY messages, event-driven TPDOs. [301:7.2.2.5, 7.2.7]

#if USE_EMCY && CO_TPDO_N > 1 && CO_RPDO_N > 1

// A node whose error register is mapped to TPDO 0 and sent when it changes.
struct ReportingNode {
  std::uint8_t error_register = 0;
  PdoNode node;

  ReportingNode()
      : node(table(), [this](Setup& setup) {
          setup.emergencies(errors_of_device()).may_change(0x1001, 0).may_change(0x1400, 1);
          setup.with({CO_KEY(0x1001, 0, CO_OBJ___APR_), CO_TUNSIGNED8, &error_register});
          setup.with({CO_KEY(0x1014, 0, CO_OBJ_DN__RW), CO_TEMCY_ID, 0x80});
        }) {
    node.frames_per_call(4);
  }

  static PdoTable table() {
    PdoTable table;
    table.rpdo[0].on(0x201, 255, {0x22020110});
    table.tpdo[0].on(0x40000181, 255, {0x10010008});
    table.tpdo[1].on(0x40000281, 255, {0x22010108});
    return table;
  }
};

TEST_CASE("Deferred work: a fault sends its EMCY message before the TPDO that maps the error register") {
  ReportingNode reporting;
  PdoNode& node = reporting.node;
  node.start();
  node.rx("201#");
  node.tx({"081#1082110000010000", "181#11"});
}

TEST_CASE("Deferred work: a download that ends a fault is answered before the EMCY message and the TPDO are sent") {
  ReportingNode reporting;
  PdoNode& node = reporting.node;
  node.start();
  node.rx("201#");
  node.tx({"081#1082110000010000", "181#11"});
  node.rx("601#2300140101020080");
  node.tx({"581#6000140100000000", "081#0000000000010000", "181#00"});
}

TEST_CASE("Deferred work: an EMCY message of a callback is sent before a TPDO that the callback requests") {
  ReportingNode reporting;
  PdoNode& node = reporting.node;
  node.start();
  callbacks().pdo_receive = [&](CO_IF_FRM*) {
    COEmcySet(&node->Emcy, hot, nullptr);
    COTPdoTrigPdo(node->TPdo, 1);
    return std::int16_t{1};
  };
  node.rx("201#4243");
  node.tx({"081#0040090000000000", "281#11", "181#09"});
}

TEST_CASE("Deferred work: what a callback has caused is sent before the NMT state that the callback requests") {
  ReportingNode reporting;
  PdoNode& node = reporting.node;
  node.start();
  callbacks().pdo_receive = [&](CO_IF_FRM*) {
    COEmcySet(&node->Emcy, hot, nullptr);
    CONmtSetMode(&node->Nmt, CO_STOP);
    return std::int16_t{1};
  };
  node.rx("201#4243");
  node.tx({"081#0040090000000000", "181#09"});
}

#if CO_EMCY_QUEUE_N > 0

TEST_CASE("Deferred work: more errors than the queue of EMCY messages has places are all sent in one call") {
  const unsigned errors = 3 * CO_EMCY_QUEUE_N < CO_EMCY_N ? 3 * CO_EMCY_QUEUE_N : CO_EMCY_N;
  EmcyNode node(Setup().emergencies(std::vector<CO_EMCY_TBL>(CO_EMCY_N, {CO_EMCY_REG_TEMP, 0x4200})));
  node.frames_per_call(errors);
  for (unsigned err = 0; err < errors; ++err) {
    node.set(static_cast<std::uint8_t>(err));
  }
  CHECK(node.frames().size() == errors);
  node.call([&] { COEmcyReset(&node->Emcy, 0); });
  CHECK(node.frames().size() == errors);
  CHECK(node.counters().Dropped == 0);
}

#endif

// A table in which an RPDO writes four objects with flag A, each of which another TPDO maps, in the reverse order.
PdoTable reversed() {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22110108, 0x22110208, 0x22110308, 0x22110408});
  for (unsigned n = 0; n < fixture_tpdos; ++n) {
    table.tpdo[n].on(0x40000181 + n * 0x100, 255, {0x22110008 | (fixture_tpdos - n) << 8});
  }
  return table;
}

TEST_CASE("Deferred work: the TPDOs of all objects that a frame has changed are sent in the order of their numbers") {
  PdoNode node(reversed());
  node.frames_per_call(4);
  node.start();
  node.rx("201#41424344");
  std::vector<std::string> expected;
  const char* const frames[] = {"#41", "#42", "#43", "#44"};
  for (unsigned n = 0; n < fixture_tpdos; ++n) {
    expected.push_back(std::to_string(n + 1) + "81" + frames[fixture_tpdos - n - 1]);
  }
  CHECK(node.frames() == expected);
}

TEST_CASE("Deferred work: a TPDO is sent once however often its objects change in a call") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22110108, 0x22110208});
  table.tpdo[0].on(0x40000181, 255, {0x22110108, 0x22110208});
  PdoNode node(table);
  node.start();
  callbacks().pdo_update = [&](CO_RPDO*) {
    for (std::uint8_t value = 1; value < 10; ++value) {
      CODictWrByte(&node->Dict, CO_DEV(0x2211, 1), value);
    }
  };
  node.rx("201#4142");
  node.tx("181#0942");
}

TEST_CASE("Deferred work: a TPDO that COPdoTransmit causes is sent after the frame of that callback") {
  PdoNode node(reversed());
  node.frames_per_call(3);
  node.start();
  unsigned depth = 0;
  callbacks().pdo_transmit = [&](CO_IF_FRM*) {
    CHECK(++depth == 1);
    CODictWrByte(&node->Dict, CO_DEV(0x2211, fixture_tpdos), 0x99);
    --depth;
  };
  node.call([&] { CODictWrByte(&node->Dict, CO_DEV(0x2211, 1), 0x77); });
  CHECK(node.frames() == std::vector<std::string>{std::to_string(fixture_tpdos) + "81#77", "181#99"});
}

#endif

}  // namespace
