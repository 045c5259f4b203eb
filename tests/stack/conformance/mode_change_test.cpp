// SPDX-License-Identifier: Apache-2.0
// CONodeProcess() within CONmtModeChange(): the node is between two NMT states and processes no frame.
#include "support/fixture.hpp"

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

}  // namespace
