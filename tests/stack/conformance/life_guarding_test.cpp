// SPDX-License-Identifier: Apache-2.0
// Life guarding: a life guarding event occurs without guarding by the NMT master for 100Ch x 100Dh.
// [301:7.2.8.2.2.1, 7.5.2.11-12]
#include "support/fixture.hpp"

#if USE_GUARDING

namespace {

using namespace test;

constexpr const char* master_missing = "081#3081110000000000";
constexpr const char* master_back = "081#0000000000000000";

// The variables of 100Ch, 100Dh and 1029h:1.
struct GuardObjects {
  std::uint16_t time;
  std::uint8_t factor;
  std::uint8_t behaviour = 0;
};

Setup with_objects(Setup setup, GuardObjects& objects) {
  setup.with({CO_KEY(0x100C, 0, CO_OBJ_____RW), CO_TUNSIGNED16, &objects.time});
  setup.with({CO_KEY(0x100D, 0, CO_OBJ_____RW), CO_TUNSIGNED8, &objects.factor});
  return setup.with({CO_KEY(0x1029, 1, CO_OBJ_____RW), CO_TERROR_BEHAVIOUR, &objects.behaviour});
}

class Guarded : public GuardObjects, public Fixture {
 public:
  Guarded(std::uint16_t guard_time, std::uint8_t life_time_factor, const Setup& setup = {})
      : GuardObjects{guard_time, life_time_factor}, Fixture(with_objects(setup, *this)) {
    frames_per_call(2);  // guarding response and EMCY 0000h
    callbacks().life_guard = [this](CO_NMT* nmt, bool occurred) {
      CHECK(nmt == &node.Nmt);
      told += occurred ? "lost " : "found ";
    };
  }
  ~Guarded() { CHECK(told.empty()); }

  void guard() {
    rx("701#R1");
    std::vector<std::string> sent = frames();
    CHECK(sent.size() == 1);
    CHECK((sent.empty() ? 0 : sent[0].rfind("701#", 0)) == 0);
  }
  void expect(const std::string& all, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    if (told != all) ADD_FAIL_CHECK_AT(at.file, at.line, "expected \"" << all << "\", told \"" << told << "\"");
    told.clear();
  }
  void emergency(std::string_view frame, Where at = {__builtin_FILE(), __builtin_LINE()}) {
#if USE_EMCY
    tx(frame, at);
#else
    static_cast<void>(frame);
    silent(at);
#endif
  }
  void find_master(Where at = {__builtin_FILE(), __builtin_LINE()}) {
    rx("701#R1", at);
    const std::vector<std::string> sent = frames();
#if USE_EMCY
    CHECK(sent.size() == 2);
    CHECK(sent.back() == master_back);
#else
    CHECK(sent.size() == 1);
#endif
    expect("found ", at);
  }

  std::string told;
};

TEST_CASE("life guarding: it starts with the first remote frame [G1] [Guarding 06]") {
  Guarded node(100, 3);
  node.after(100000ms);
  node.silent();
  node.expect("");
  node.guard();
  node.after(299ms);
  node.silent();
  node.expect("");
  node.after(1ms);
  node.emergency(master_missing);
  node.expect("lost ");
}

TEST_CASE("life guarding: every remote frame restarts the time [G1]") {
  Guarded node(100, 3);
  for (int request = 0; request < 100; ++request) {
    node.guard();
    node.after(299ms);
  }
  node.expect("");
  node.after(1ms);
  node.emergency(master_missing);
  node.expect("lost ");
}

TEST_CASE("life guarding: the loss is reported once, and the next remote frame resolves it [G2] [B2]") {
  Guarded node(50, 2);
  node.rx("000#0101");
  for (int loss = 0; loss < 5; ++loss) {
    node.guard();
    node.after(100ms);
    node.emergency(master_missing);
    node.expect("lost ");
    CHECK(node.mode() == CO_PREOP);
    node.rx("000#0101");
    node.after(10000ms);
    node.silent();
    CHECK(node.mode() == CO_OPERATIONAL);
    node.find_master();
  }
  node.after(100ms);
  node.emergency(master_missing);
  node.expect("lost ");
}

TEST_CASE("life guarding: the reaction is that of 1029h:1 [B1] [State 03]") {
  constexpr CO_MODE after_loss[] = {CO_PREOP, CO_OPERATIONAL, CO_STOP};
  for (std::uint8_t behaviour = 0; behaviour < 3; ++behaviour) {
    CAPTURE(behaviour);
    Guarded node(100, 1, Setup());
    node.behaviour = behaviour;
    node.may_change(0x1029, 1);
    node.rx("000#0101");
    node.guard();
    node.after(100ms);
    node.emergency(master_missing);
    node.expect("lost ");
    CHECK(node.mode() == after_loss[behaviour]);
  }
}

TEST_CASE("life guarding: it continues in Stopped, where no EMCY is sent [N3] [N9]") {
  Guarded node(100, 1);
  node.rx("000#0201");
  node.guard();
  node.after(100ms);
  node.silent();
  node.expect("lost ");
  node.guard();
  node.expect("found ");
}

TEST_CASE("life guarding: 100Ch and 100Dh are read when the remote frame is received [Guarding 01] [Guarding 05]") {
  Guarded node(100, 3);
  node.guard();
  node.ask("601#2B0C10000A000000", "581#600C100000000000");
  node.after(290ms);
  node.guard();
  node.after(29ms);
  node.silent();
  node.after(1ms);
  node.emergency(master_missing);
  node.expect("lost ");
  node.find_master();
  node.ask("601#2F0D100000000000", "581#600D100000000000");
  node.after(29ms);
  node.guard();
  node.after(100000ms);
  node.silent();
}

TEST_CASE("life guarding: a loss before guard time 0 is resolved by the next remote frame [G2]") {
  Guarded node(10, 1);
  node.guard();
  node.after(10ms);
  node.emergency(master_missing);
  node.expect("lost ");
  node.ask("601#2B0C100000000000", "581#600C100000000000");
  node.find_master();
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("life guarding: a reset ends it until the next remote frame [G2] [T14]") {
  for (const std::string reset : {"000#8101", "000#8201"}) {
    for (const bool lost : {false, true}) {
      CAPTURE(reset);
      CAPTURE(lost);
      const Guarded fresh(100, 2);
      Guarded node(100, 2);
      node.guard();
      node.after(lost ? 200ms : 100ms);
      if (lost) {
        node.emergency(master_missing);
        node.expect("lost ");
      }
      node.rx(reset);
      node.tx("701#00");
      CHECK(node.difference(fresh) == "");
      CHECK(node.armed_timers() == 0);
      node.ask("601#4001100000000000", "581#4F01100000000000");
      node.after(1000ms);
      node.silent();
      node.guard();
      node.expect("");
      node.after(200ms);
      node.emergency(master_missing);
      node.expect("lost ");
    }
  }
}

TEST_CASE("life guarding: CONodeStop ends it") {
  Guarded node(100, 1);
  node.guard();
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.armed_timers() == 0);
  node.after(1000ms);
  node.silent();
}

TEST_CASE("life guarding: the application may reset or stop the node in the callback [Q9]") {
  for (const bool stop : {false, true}) {
    CAPTURE(stop);
    Guarded node(100, 1);
    callbacks().life_guard = [&](CO_NMT* nmt, bool) { stop ? CONodeStop(nmt->Node) : CONmtReset(nmt, CO_RESET_NODE); };
    node.guard();
    node.after(100ms);
    const std::vector<std::string> sent = node.frames();
    CHECK((!sent.empty() && sent.back() == "701#00") == !stop);
    CHECK(node.armed_timers() == 0);
    node.after(1000ms);
    node.silent();
  }
}

TEST_CASE("life guarding: the longest life time, and one beyond the range of the timer, are handled") {
  Guarded node(65535, 255);
  node.guard();
  node.after(std::chrono::milliseconds{65535 * 255 - 1});
  node.silent();
  node.after(1ms);
  node.emergency(master_missing);
  node.expect("lost ");
  Guarded fast(65535, 255, Setup().rate(1000000));
  fast.guard();
  CHECK(fast.armed_timers() == 0);
}

TEST_CASE("life guarding: the loss does not depend on start and rate of the clock [T15]") {
  for (const std::uint32_t rate : clock_rates) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      Guarded node(500, 2, Setup().rate(rate).clock(start));
      for (int request = 0; request < 4; ++request) {
        node.guard();
        node.after(900ms);
        node.expect("");
      }
      node.after(100ms - 5ms);
      node.expect("");
      node.after(10ms);
      node.emergency(master_missing);
      node.expect("lost ");
    }
  }
}

TEST_CASE("life guarding: a late main loop reports the loss once, unless it reads a request first [Q8]") {
  Guarded node(100, 1);
  node.guard();
  node.jump(1000ms);
  node.emergency(master_missing);
  node.expect("lost ");
  node.find_master();
  node.elapse_only(100ms);
  node.guard();
  node.expect("");
  node.after(99ms);
  node.expect("");
  node.after(1ms);
  node.emergency(master_missing);
  node.expect("lost ");
}

}  // namespace

#endif
