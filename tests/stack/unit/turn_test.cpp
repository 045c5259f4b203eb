// SPDX-License-Identifier: Apache-2.0
// CO_NODE_EXT.Enter and Leave, the node lock: functions that take it, and work that it encloses. (The fixture checks
// that calls of Enter are not nested, and that each is followed by Leave.)
#include <algorithm>

#include "support/failing_nvm.hpp"
#include "support/real_time_fixture.hpp"
#include "support/timers.hpp"

#if USE_REAL_TIME

namespace {

using namespace test;

using Entries = std::vector<std::string>;

// Log of events, and of the calls of Enter and Leave.
class Diary {
 public:
  Diary() {
    log().clear();
    callbacks().enter = [] { log().push_back("enter"); };
    callbacks().leave = [] { log().push_back("leave"); };
    callbacks().pdo_receive = [](CO_IF_FRM*) { return log().push_back("receive"), std::int16_t{0}; };
    callbacks().pdo_update = [](CO_RPDO*) { log().push_back("update"); };
    callbacks().pdo_transmit = [](CO_IF_FRM*) { log().push_back("transmit"); };
    callbacks().can_receive = [](CO_IF_FRM*) { log().push_back("can"); };
    callbacks().mode_change = [](CO_NMT*, CO_MODE) { log().push_back("mode"); };
    callbacks().can_change = [](CO_NODE*, CO_CAN_EVENT) { log().push_back("event"); };
  }
  ~Diary() { callbacks() = Callbacks{}; }
  Diary(const Diary&) = delete;
  Diary& operator=(const Diary&) = delete;

  static Entries take() { return std::exchange(log(), {}); }
  static Entries& log() {
    static Entries all;
    return all;
  }
};

void write_in_diary(void*) {
  const OutsideStack outside;
  Diary::log().push_back("timer");
}

TEST_CASE("node lock: CONodeProcess takes it with and without a frame; callbacks run with it") {
  Fixture node(Setup().turns());
  const Diary diary;
  node.loop();
  CHECK(Diary::take() == Entries{"enter", "leave"});
  node.rx("123#");
  CHECK(Diary::take() == Entries{"enter", "can", "leave"});
  node.rx("000#0101");
  CHECK(Diary::take() == Entries{"enter", "mode", "leave"});
}

TEST_CASE("node lock: COTmrProcess takes it for each action") {
  Fixture node(Setup().turns());
  const Diary diary;
  node.call([&] { COTmrProcess(&node.node.Tmr); });
  CHECK(Diary::take() == Entries{"enter", "leave"});
  node.call([&] {
    for (int n = 0; n < 3; ++n) CHECK(COTmrCreate(&node.node.Tmr, 5, 0, write_in_diary, nullptr) >= 0);
  });
  node.elapse_only(5ms);
  CHECK(Diary::take().empty());
  node.call([&] { COTmrProcess(&node.node.Tmr); });
  CHECK(Diary::take() == Entries{"enter", "leave", "enter", "timer", "leave", "enter", "timer", "leave", "enter",
                                 "timer", "leave", "enter", "leave"});
}

// Threads of the node: one without node lock, one with it, or a real-time thread and a mainline.
enum class Threads { one, turns, real_time };

Runs run_late(Threads threads, std::uint32_t start, std::uint32_t far, std::uint32_t cycle) {
  CO_IF_FRM memory[4];
  CO_RING ring;
  REQUIRE(CORingInit(&ring, memory, 4));
  Setup setup;
  setup.clock(start);
  if (threads != Threads::one) setup.turns();
  if (threads == Threads::real_time) setup.mainline(ring);
  Timers node(setup);
  const auto ms = [](std::uint64_t ticks) { return std::chrono::milliseconds{ticks}; };
  CHECK(node.create(1, 0, 1) >= 0);
  CHECK(node.create(far, cycle, 2) >= 0);
  node.elapse_only(ms(1));
  node.elapse_only(ms(far / 2));
  node.elapse_only(ms(far - far / 2 - 1));
  node.call([&] { COTmrProcess(&node->Tmr); });
  Runs all = runs();
  if (cycle != 0) {
    node.elapse_only(ms(cycle / 2), 0);
    node.elapse_only(ms(cycle - cycle / 2));
    node.call([&] { COTmrProcess(&node->Tmr); });
    CHECK(runs().size() == all.size() + 1);
  }
  return all;
}

TEST_CASE("node lock: timers run in their order for any times and any start of the clock") {
  constexpr std::uint32_t half = 0x80000000U;
  constexpr std::uint32_t starts[] = {0, half - 1, half, 0xFFFFFFFE, 0xFFFFFFFF};
  constexpr std::uint32_t distances[] = {2, half - 1, half, half + 1, half + 2, 0xFFFFFFFE, 0xFFFFFFFF};
  constexpr std::uint32_t cycles[] = {0, half - 1, half, half + 1, 0xFFFFFFFF};
  for (const std::uint32_t start : starts) {
    for (const std::uint32_t far : distances) {
      for (const std::uint32_t cycle : cycles) {
        for (const Threads threads : {Threads::one, Threads::turns, Threads::real_time}) {
          CAPTURE(start);
          CAPTURE(far);
          CAPTURE(cycle);
          CAPTURE(threads);
          CHECK(run_late(threads, start, far, cycle) == Runs{1, 2});
        }
      }
    }
  }
}

TEST_CASE("node lock: CONodeNextDeadline and CONodeRealTime take it") {
  RealTimeNode node({}, [](Setup& setup) { setup.foreign(); });
  const Diary diary;
  node.call([&] { (void)CONodeNextDeadline(&node.node); });
  CHECK(Diary::take() == Entries{"enter", "leave"});
  for (const char* text : {"123#", "124#"}) node.arrive(text);
  node.real_time();
  CHECK(Diary::take() == Entries{"enter", "leave"});
  node.mainline();
  CHECK(Diary::take() == Entries{"enter", "can", "leave", "enter", "can", "leave", "enter", "leave", "enter", "leave"});
}

TEST_CASE("node lock: no other function takes it") {
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {0x22010108});
  PdoNode node(table, [](Setup& setup) { setup.turns(); });
  node.start();
  const Diary diary;
  node.call([&] {
    std::uint8_t value = 0;
    CO_IF_FRM frm = frame("123#01");
    CHECK(CODictRdByte(&node->Dict, CO_DEV(0x2201, 1), &value) == CO_ERR_NONE);
    CHECK(CODictWrByte(&node->Dict, CO_DEV(0x2201, 1), 7) == CO_ERR_NONE);
    CHECK(COTPdoRequest(&node.node, 0) == CO_ERR_NONE);
    COIfCanSend(&node->If, &frm);
    COTmrService(&node->Tmr);
    COTmrDelete(&node->Tmr, COTmrCreate(&node->Tmr, 5, 0, write_in_diary, nullptr));
    CONodeCanEvent(&node.node, CO_CAN_PASSIVE);
    CONmtReset(&node->Nmt, CO_RESET_NODE);
    CONodeGetErr(&node.node);
    (void)CONodeGetCounters(&node.node);
  });
  CHECK(Diary::take() == Entries{"transmit", "event", "mode", "mode"});
  node.frames();
}

TEST_CASE("node lock: a node without Enter and one that was never initialised do not take it") {
  Fixture node;
  const Diary diary;
  node.loop();
  node.call([&] { COTmrProcess(&node.node.Tmr); });
  static CO_NODE never;
  CONodeProcess(&never);
  CONodeRealTime(&never);
  CHECK(Diary::take().empty());
  CONodeRealTime(nullptr);
  CHECK(callbacks().fatal_errors == 1);
  callbacks().fatal_errors = 0;
}

#if USE_OD

TEST_CASE("node lock: CO_LOCK_OD, CO_LOCK_CAN_SEND and CO_LOCK_EMCY take it and do not call OdLock") {
  Fixture node(Setup().turns());
  const Diary diary;
  callbacks().od_lock = [] { Diary::log().push_back("od"); };
  node.call([&] {
    CO_LOCK_OD(&node.node);
    CHECK(node.in_turn());
    CO_UNLOCK_OD(&node.node);
    CO_LOCK_CAN_SEND(&node.node);
    CO_UNLOCK_CAN_SEND(&node.node);
    CO_LOCK_EMCY(&node.node);
    CO_UNLOCK_EMCY(&node.node);
  });
  CHECK(Diary::take() == Entries{"enter", "leave", "enter", "leave", "enter", "leave"});
}

#endif

TEST_CASE("node lock: an action that initialises the node again releases the lock that it holds") {
  static Fixture* again;
  Fixture node(Setup().turns());
  again = &node;
  node.call([&] {
    CHECK(COTmrCreate(
              &node.node.Tmr, 5, 0, [](void*) { again->init_again(); }, nullptr) >= 0);
  });
  node.elapse_only(5ms);
  const Diary diary;
  callbacks().mode_change = nullptr;
  COTmrProcess(&node.node.Tmr);
  CHECK(Diary::take() == Entries{"enter", "leave", "enter", "leave", "enter", "leave"});
  CHECK_FALSE(node.in_turn());
}

#if USE_PARA

// A non-volatile memory that logs its accesses in the diary.
struct NotedNvm {
  explicit NotedNvm(bool tells_shape) : table(FailingNvm::driver) {
    table.Read = [](void* ctx, std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
      return note("read"), FailingNvm::driver.Read(ctx, start, buffer, size);
    };
    table.Write = [](void* ctx, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
      return note("write"), FailingNvm::driver.Write(ctx, start, buffer, size);
    };
    table.Erase = [](void* ctx, std::uint32_t start, std::uint32_t size) {
      return note("erase"), FailingNvm::driver.Erase(ctx, start, size);
    };
    table.Shape = tells_shape ? table.Shape : nullptr;
  }

  static void note(const char* what) {
    const OutsideStack outside;
    if (Diary::log().empty() || Diary::log().back() != what) {
      Diary::log().push_back(what);
    }
    if (meanwhile()) {
      meanwhile()();
    }
  }
  // Returns the action of another thread while the memory is being accessed.
  static std::function<void()>& meanwhile() {
    static std::function<void()> function;
    return function;
  }

  FailingNvm memory{{512, 4, 64}};
  CO_IF_NVM_DRV_EX table;
  std::uint32_t values[2] = {};
  CO_PARA group = {0, sizeof values, values, nullptr, CO_RESET_NODE, nullptr, CO_PARA___E};

  Setup setup() {
    const auto data = [](const void* address) { return reinterpret_cast<std::uintptr_t>(address); };
    return Setup()
        .only_small()
        .turns()
        .nvm(table, &memory)
        .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, data(&group)})
        .with({CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, data(&group)})
        .with({CO_KEY(0x2300, 1, CO_OBJ_____RW), CO_TUNSIGNED32, data(&values[0])});
  }
};

constexpr const char* save = "601#2310100173617665";
constexpr const char* saved = "581#6010100100000000";

// Returns the log without the events during which the node lock is held, and without repetitions.
Entries outside_of_turns(const Entries& all) {
  Entries outside;
  bool in_turn = false;
  for (const std::string& entry : all) {
    in_turn = entry == "enter" || (in_turn && entry != "leave");
    if (!in_turn && entry != "leave" && (outside.empty() || outside.back() != entry)) outside.push_back(entry);
  }
  return outside;
}

TEST_CASE("node lock: released while a memory with geometry is read, erased and written") {
  NotedNvm nvm(true);
  Fixture node(nvm.setup());
  const Diary diary;
  node.ask(save, saved);
  const Entries all = Diary::take();
  CHECK(outside_of_turns(all) == Entries{"read", "erase", "write", "read"});
  CHECK(std::count(all.begin(), all.end(), "enter") == std::count(all.begin(), all.end(), "leave"));
}

TEST_CASE("node lock: held while a classic memory accesses the bytes of the application") {
  NotedNvm nvm(false);
  Fixture node(nvm.setup());
  const Diary diary;
  node.ask(save, saved);
  CHECK(Diary::take() == Entries{"enter", "read", "write", "leave"});
}

TEST_CASE("node lock: released while a group is read, whose bytes are then copied to the application") {
  NotedNvm nvm(true);
  Fixture node(nvm.setup());
  node.ask(save, saved);
  const Diary diary;
  node.rx("000#8101");
  node.tx("701#00");
  const Entries all = Diary::take();
  const auto in = [&](std::size_t n) { return n + 1 < all.size() && all[n] == "enter" && all[n + 1] == "read"; };
  unsigned kept = 0;
  for (std::size_t n = 0; n < all.size(); ++n) kept += in(n) ? 1U : 0U;
  CHECK(kept == 0);
  CHECK(std::count(all.begin(), all.end(), "read") > 2);
}

TEST_CASE("node lock: CONodeInit and an application without Enter and Leave access the memory without it") {
  NotedNvm nvm(true);
  const Diary diary;
  Fixture node(nvm.setup());
  node.call([&] { CHECK(COParaStore(&nvm.group, &node.node) == CO_ERR_NONE); });
  const Entries all = Diary::take();
  CHECK(std::count(all.begin(), all.end(), "enter") == 0);
  CHECK(std::count(all.begin(), all.end(), "leave") == 0);
}

TEST_CASE("node lock: a reset that another thread requests during a memory access is carried out after it") {
  NotedNvm nvm(true);
  Fixture node(nvm.setup());
  node.frames_per_call(2);
  bool asked = false;
  NotedNvm::meanwhile() = [&] {
    if (!std::exchange(asked, true)) {
      CONmtReset(&node->Nmt, CO_RESET_COM);
      CHECK(node.mode() == CO_PREOP);
    }
  };
  node.rx(save);
  NotedNvm::meanwhile() = nullptr;
  node.tx({saved, "701#00"});
  CHECK(asked);
}

TEST_CASE("node lock: functions that access the memory carry out a requested reset when they return") {
  NotedNvm nvm(true);
  Fixture node(nvm.setup());
  const auto with_reset = [&](const std::function<CO_ERR()>& function) {
    nvm.values[0] += 1;
    bool asked = false;
    NotedNvm::meanwhile() = [&] {
      if (!std::exchange(asked, true)) {
        CONmtReset(&node->Nmt, CO_RESET_COM);
        CHECK(node->Pending != 0);
      }
    };
    node.call([&] { CHECK(function() == CO_ERR_NONE); });
    NotedNvm::meanwhile() = nullptr;
    CHECK(asked);
    node.tx("701#00");
  };
  with_reset([&] { return COParaStore(&nvm.group, &node.node); });
  with_reset([&] { return COParaRestore(&nvm.group, &node.node); });
  with_reset([&] { return CONodeParaLoad(&node.node, CO_RESET_NODE); });
#if USE_LSS
  std::uint32_t baud = 0;
  std::uint8_t id = 0;
  with_reset([&] { return COLssNvmStore(&node.node, 256, 250000, 5); });
  with_reset([&] { return COLssNvmLoad(&node.node, 256, &baud, &id); });
  CHECK(id == 5);
#endif
}

#endif

TEST_CASE("node lock: it is never nested in NMT or SDO transfers or EMCY or heartbeat or guarding") {
  Fixture node(Setup().turns().heartbeat(100).emergencies({{CO_EMCY_REG_GENERAL, 0x1234}}));
  std::size_t turns = 0;
  callbacks().enter = [&] { ++turns; };
  for (const std::size_t size : {4U, 15U, 889U}) {
    CHECK(node.download(0x2101, 0, Bytes(size, 0x5A)) == 0);
  }
  CHECK(node.upload(0x2101, 0).size() == 889);
#if USE_SDO_BLOCK
  CHECK(node.block_upload(0x2101, 0).data.size() == 889);
#endif
  for (const char* text : {"000#0101", "000#0201", "000#8001", "000#8101", "000#8201", "701#R", "601#40", "7E5#"}) {
    node.rx(text);
    node.after(150ms);
    node.frames();
  }
  CHECK(turns > 300);
}

}  // namespace

#endif
