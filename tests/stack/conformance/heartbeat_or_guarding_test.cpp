// SPDX-License-Identifier: Apache-2.0
// Heartbeat and guarding exclude each other; the heartbeat has precedence. [301:7.2.8.2.2.1, 7.5.2.20]
// [Heartbeat-versus-guarding]
#include "support/fixture.hpp"

#if USE_GUARDING

namespace {

using namespace test;

constexpr const char* off = "601#2B17100000000000";
constexpr const char* on = "601#2B171000C8000000";  // 200 ms
constexpr const char* written = "581#6017100000000000";

struct Both {
  std::uint16_t time = 100;
  std::uint8_t factor = 1;
  unsigned lost = 0;
  unsigned found = 0;
  Fixture node;

  explicit Both(std::uint16_t heartbeat)
      : node(Setup()
                 .heartbeat(heartbeat)
                 .with({CO_KEY(0x100C, 0, CO_OBJ_____RW), CO_TUNSIGNED16, &time})
                 .with({CO_KEY(0x100D, 0, CO_OBJ_____RW), CO_TUNSIGNED8, &factor})) {
    node.frames_per_call(2);
    callbacks().life_guard = [this](CO_NMT*, bool occurred) { ++(occurred ? lost : found); };
  }
};

TEST_CASE("heartbeat or guarding: if both are configured the heartbeat is used [H1] [G1]") {
  Both both(200);
  Fixture& node = both.node;
  node.rx("701#R1");
  node.silent();
  node.after(100ms);
  node.rx("701#R1");
  node.silent();
  node.after(500ms);
  node.tx_at(100ms, "701#7F");
  node.tx_at(300ms, "701#7F");
  node.tx_at(500ms, "701#7F");
  node.silent();
  CHECK(both.lost == 0);
}

TEST_CASE("heartbeat or guarding: without a heartbeat time guarding is used") {
  Both both(0);
  Fixture& node = both.node;
  node.ask("701#R1", "701#7F");
  node.after(99ms);
  node.silent();
  node.ask("701#R1", "701#FF");
  node.after(99ms);
  node.ask("701#R1", "701#7F");
  CHECK(both.lost == 0);
}

TEST_CASE("heartbeat or guarding: writing 1017h ends guarding at once, and life guarding without an event [H1]") {
  Both both(0);
  Fixture& node = both.node;
  node.ask("701#R1", "701#7F");
  node.ask(on, written);
  node.after(150ms);
  node.rx("701#R1");
  node.silent();
  node.after(1000ms);
  CHECK(node.trace() == std::vector<std::string>{"50 701#7F", "250 701#7F", "450 701#7F", "650 701#7F", "850 701#7F"});
  CHECK(both.lost == 0);
}

TEST_CASE("heartbeat or guarding: 1017h = 0 enables guarding again; the toggle bit continues [G2]") {
  Both both(200);
  Fixture& node = both.node;
  node.ask(off, written);
  node.ask("701#R1", "701#7F");
  node.ask(on, written);
  node.rx("701#R1");
  node.silent();
  node.ask(off, written);
  node.ask("701#R1", "701#FF");
  node.after(99ms);
  CHECK(both.lost == 0);
  node.after(1ms);
  CHECK(both.lost == 1);
  node.trace();
}

TEST_CASE("heartbeat or guarding: a remote frame that is not answered does not start life guarding [G1]") {
  Both both(200);
  Fixture& node = both.node;
  node.rx("701#R1");
  node.ask(off, written);
  node.after(1000ms);
  node.silent();
  CHECK(both.lost == 0);
}

TEST_CASE("heartbeat or guarding: a remote frame resolves a lost master for any value of 1017h [G2]") {
  Both both(0);
  Fixture& node = both.node;
  node.ask("701#R1", "701#7F");
  node.after(100ms);
  node.trace();
  CHECK(both.lost == 1);
  node.ask(on, written);
  node.rx("701#R1");
#if USE_EMCY
  node.tx("081#0000000000000000");
#else
  node.silent();
#endif
  CHECK(both.found == 1);
  node.after(1000ms);
  CHECK(node.trace().size() == 5);
  CHECK(both.lost == 1);
}

TEST_CASE("heartbeat or guarding: guarding is used without 1017h and before the reset that applies a plain 1017h") {
  Fixture without(Setup().without(0x1017, 0));
  without.ask("701#R1", "701#7F");
  Fixture plain(Setup().with({CO_KEY(0x1017, 0, CO_OBJ_D___RW), CO_TUNSIGNED16, 0}));
  plain.ask(on, written);
  plain.ask("701#R1", "701#7F");
  plain.rx("000#8201");
  plain.tx("701#00");
  plain.rx("701#R1");
  plain.silent();
}

TEST_CASE("heartbeat or guarding: random settings, requests and times never activate both [H1] [G1]") {
  std::uint32_t random = 12345;
  const auto below = [&](std::uint32_t end) { return (random = random * 1664525 + 1013904223) / 65536 % end; };
  Both both(0);
  Fixture& node = both.node;
  bool heartbeat = false;
  bool toggle = false;
  for (unsigned step = 0; step < 5000 / stride(10); ++step) {
    CAPTURE(step);
    switch (below(4)) {
      case 0:
        heartbeat = below(2) == 0;
        node.ask(heartbeat ? on : off, written);
        break;
      case 1:
        node.after(std::chrono::milliseconds{below(90)});
        node.trace();
        break;
      default:
        node.rx("701#R1");
        if (heartbeat) {
          for (const std::string& frm : node.frames()) CHECK(frm.rfind("081#0000", 0) == 0);
        } else {
          const std::vector<std::string> sent = node.frames();
          REQUIRE(!sent.empty());
          CHECK(sent[0] == (toggle ? "701#FF" : "701#7F"));
          toggle = !toggle;
        }
    }
  }
}

}  // namespace

#endif
