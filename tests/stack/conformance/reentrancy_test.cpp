// SPDX-License-Identifier: Apache-2.0
// Type functions and callbacks that call functions of the node.
#include <algorithm>

#include "support/fixture.hpp"

namespace {

using namespace test;

// Actions of the type functions of 3000h (a stream of 20 bytes) and 3001h (a value of 8 bytes).
struct Script {
  std::function<void(CO_NODE*)> on_init;
  std::function<void(CO_NODE*)> on_read;
  std::function<void(CO_NODE*)> on_write;
  unsigned inits = 0;
} script;

void run(const std::function<void(CO_NODE*)>& function, CO_NODE* node) {
  if (function) {
    function(node);
  }
}

CO_ERR scripted_init(CO_OBJ*, CO_NODE* node) {
  ++script.inits;
  run(script.on_init, node);
  return CO_ERR_NONE;
}

CO_ERR scripted_read(CO_OBJ*, CO_NODE* node, void* buffer, uint32_t size) {
  auto* const bytes = static_cast<std::uint8_t*>(buffer);
  std::fill(bytes, bytes + size, std::uint8_t{0x55});
  if (size != 0) {
    run(script.on_read, node);
  }
  return CO_ERR_NONE;
}

CO_ERR scripted_write(CO_OBJ*, CO_NODE* node, void*, uint32_t size) {
  if (size != 0) {
    run(script.on_write, node);
  }
  return CO_ERR_NONE;
}

uint32_t stream_size(CO_OBJ*, CO_NODE*, uint32_t width) { return width != 0 && width < 20 ? width : 20; }
uint32_t value_size(CO_OBJ*, CO_NODE*, uint32_t) { return 8; }
CO_ERR scripted_reset(CO_OBJ*, CO_NODE*, uint32_t) { return CO_ERR_NONE; }

const CO_OBJ_TYPE stream_type = {stream_size, scripted_init, scripted_read, scripted_write, scripted_reset};
const CO_OBJ_TYPE value_type = {value_size, nullptr, scripted_read, scripted_write, nullptr};

Setup scripted() {
  script = Script{};
  return Setup()
      .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &stream_type, 0})
      .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), &value_type, 0});
}

void check_serves(Fixture& node) { node.ask("601#4000100000000000", "581#4300100091010F00"); }

void check_stopped(Fixture& node) {
  CHECK(node.mode() == CO_INVALID);
  CHECK_FALSE(node.can.on_bus);
  CHECK(node.armed_timers() == 0);
  node.after(1000ms);
  node.rx("601#4000100000000000");
  node.rx("000#8100");
  node.silent();
  CHECK(node.mode() == CO_INVALID);
}

constexpr unsigned plenty = 20;  // limits a recursion, so that it fails the test instead of crashing the program

// Resets that are requested during a reset ----------------------------------------------------------------------------

TEST_CASE("re-entrancy: a reset requested by CONmtModeChange within a reset is part of it: one boot-up") {
  for (const char* command : {"000#8101", "000#8201"}) {
    for (const CO_NMT_RESET asked_for : {CO_RESET_NODE, CO_RESET_COM}) {
      for (const CO_MODE at : {CO_INIT, CO_PREOP}) {
        CAPTURE(std::string(command));
        CAPTURE(at);
        Fixture node(scripted());
        unsigned asked = 0;
        unsigned told = 0;
        callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) {
          if (mode == at && ++asked < plenty) CONmtReset(nmt, asked_for);
        };
        callbacks().reset_request = [&](CO_NMT*, CO_NMT_RESET) { ++told; };
        script.inits = 0;
        node.rx(command);
        node.tx("701#00");
        CHECK(asked == 1);
        CHECK(told == 1);
        CHECK(script.inits == 1);
        CHECK(node.can.resets == 1);
        CHECK(node.mode() == CO_PREOP);
        check_serves(node);
      }
    }
  }
}

TEST_CASE("re-entrancy: a reset requested by Init of a type within a reset is part of it: one boot-up") {
  for (const char* command : {"000#8101", "000#8201"}) {
    for (const CO_NMT_RESET asked_for : {CO_RESET_NODE, CO_RESET_COM}) {
      CAPTURE(std::string(command));
      Fixture node(scripted());
      script.on_init = [=](CO_NODE* n) {
        if (script.inits < plenty) CONmtReset(&n->Nmt, asked_for);
      };
      script.inits = 0;
      node.rx(command);
      node.tx("701#00");
      CHECK(script.inits == 1);
      CHECK(node.mode() == CO_PREOP);
      CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x601, 0x701});
      check_serves(node);
    }
  }
}

TEST_CASE("re-entrancy: a reset requested by Init of a type within a reset by the application is part of it") {
  Fixture node(scripted());
  script.on_init = [](CO_NODE* n) {
    if (script.inits < plenty) CONmtReset(&n->Nmt, CO_RESET_COM);
  };
  script.inits = 0;
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NODE); });
  node.tx("701#00");
  CHECK(script.inits == 1);
  check_serves(node);
}

TEST_CASE("re-entrancy: a reset requested while the node is initialised or started sends no second boot-up") {
  Setup setup = scripted().stay_in_init();
  script.on_init = [](CO_NODE* n) {
    if (script.inits < plenty) CONmtReset(&n->Nmt, CO_RESET_NODE);
  };
  Fixture node(setup);
  node.silent();
  CHECK(script.inits == 1);
  CHECK(node.mode() == CO_INIT);
  unsigned asked = 0;
  callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE) {
    if (++asked < plenty) CONmtReset(nmt, CO_RESET_NODE);
  };
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  CHECK(asked == 1);
  CHECK(node.mode() == CO_PREOP);
  check_serves(node);
}

TEST_CASE("re-entrancy: a reset requested while an NMT command changes the state follows the change") {
  Fixture node;
  std::vector<CO_MODE> modes;
  callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) {
    modes.push_back(mode);
    if (mode == CO_OPERATIONAL) CONmtReset(nmt, CO_RESET_COM);
  };
  node.rx("000#0101");
  node.tx("701#00");
  CHECK(modes == std::vector<CO_MODE>{CO_OPERATIONAL, CO_INIT, CO_PREOP});
  CHECK(node.mode() == CO_PREOP);
}

// Frames that are queued at a reset -----------------------------------------------------------------------------------

void send(Fixture& node, const char* text) {
  CO_IF_FRM frm = frame(text);
  node.call([&] { COIfCanSend(&node->If, &frm); });
}

TEST_CASE(
    "re-entrancy: a write that resets the node while the controller is busy: answer, boot-up, other frames [Q3]") {
  for (const CO_NMT_RESET reset : {CO_RESET_NODE, CO_RESET_COM}) {
    Fixture node(scripted().heartbeat(100).tx_queue(20));
    node.frames_per_call(4);
    script.on_write = [=](CO_NODE* n) { CONmtReset(&n->Nmt, reset); };
    node.can.refuse_all();
    node.rx("601#2301300001000000");
    node.rx("601#2101300008000000");
    node.rx("601#0001020304050607");
    node.rx("601#1D08000000000000");
    send(node, "091#01");
    node.after(100ms);
    node.rx("601#4000100000000000");
    node.silent();
    node.can.accept_all();
    node.loop();
    node.tx({"581#8001300013000706", "581#6001300000000000", "581#2000000000000000", "581#3000000000000000", "701#00",
             "091#01", "581#4300100091010F00", "701#7F"});
  }
}

TEST_CASE("re-entrancy: a reset by the master drops frames that a reset by the application has kept [N4]") {
  Fixture node(Setup().tx_queue(20));
  node.can.refuse_all();
  node.rx("601#4000100000000000");
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  const std::uint32_t dropped = node.counters().Dropped;
  node.rx("000#8201");
  node.silent();
  CHECK(node.counters().Dropped == dropped + 2);
  node.can.accept_all();
  node.loop();
  node.tx("701#00");
}

#if USE_NMT_MASTER

TEST_CASE("re-entrancy: two resets by the application keep frames in the order in which they were queued [N4]") {
  Fixture node(Setup().tx_queue(20).nmt_master());
  node.can.refuse_all();
  node.rx("601#4000100000000000");
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  node.call([&] { CHECK(CONmtCommand(&node->Nmt, CO_NMT_COMMAND_START, 9) == CO_ERR_NONE); });
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  node.silent();
  node.can.accept_all();
  node.loop();
  node.tx({"581#4300100091010F00", "000#0109", "701#00"});
}

#endif

// Slow type functions -------------------------------------------------------------------------------------------------

// Lets time pass, and runs the timers, like a type function that waits for a slow memory.
void wait(Fixture& node, Time time) {
  const OutsideStack outside;
  node.idle(time);
}

struct Step {
  const char* request;
  const char* answer;
};

// Returns transfers whose last step calls the slow type function.
const std::vector<std::vector<Step>>& slow_transfers() {
  static const std::vector<std::vector<Step>> all = {
      {{"601#2000300000000000", "581#6000300000000000"}, {"601#0001020304050607", "581#2000000000000000"}},
      {{"601#2000300000000000", "581#6000300000000000"}, {"601#0101020304050607", "581#2000000000000000"}},
      {{"601#2100300007000000", "581#6000300000000000"}, {"601#0101020304050607", "581#2000000000000000"}},
      {{"601#2101300008000000", "581#6001300000000000"},
       {"601#0001020304050607", "581#2000000000000000"},
       {"601#1D08000000000000", "581#3000000000000000"}},
      {{"601#4000300000000000", "581#4100300014000000"}, {"601#6000000000000000", "581#0055555555555555"}},
  };
  return all;
}

TEST_CASE("re-entrancy: a transfer continues although its type function runs longer than the time-out [D18]") {
  for (const std::vector<Step>& steps : slow_transfers()) {
    CAPTURE(std::string(steps.back().request));
    Fixture node(scripted());
    script.on_write = script.on_read = [&](CO_NODE*) { wait(node, 2 * node.sdo_time_out()); };
    for (const Step& step : steps) {
      node.ask(step.request, step.answer);
    }
    CHECK(node.counters().SdoAborts == 0);
  }
}

TEST_CASE("re-entrancy: after a slow type function the client has its complete time-out again [D18]") {
  Fixture node(scripted());
  script.on_write = [&](CO_NODE*) { wait(node, 2 * node.sdo_time_out()); };
  node.ask("601#2000300000000000", "581#6000300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.after(std::chrono::milliseconds{CO_SDO_TIMEOUT} * 3 / 4);
  node.silent();
  script.on_write = nullptr;
  node.ask("601#1101020304050607", "581#3000000000000000");
}

TEST_CASE("re-entrancy: a type function that stops and starts SDO leaves a transfer with a running time-out [D18]") {
  for (const std::vector<Step>& steps : {slow_transfers().front(), slow_transfers().back()}) {
    CAPTURE(std::string(steps.back().request));
    Fixture node(scripted());
    script.on_write = script.on_read = [](CO_NODE* n) {
      CONmtSetMode(&n->Nmt, CO_STOP);
      CONmtSetMode(&n->Nmt, CO_PREOP);
    };
    for (const Step& step : steps) {
      node.ask(step.request, step.answer);
    }
    node.after(node.sdo_time_out());
    node.tx("581#8000300000000405");
    node.ask("601#6011223300000000", "581#8011223301000405");
  }
}

// Stops and changes of state within callbacks -------------------------------------------------------------------------

TEST_CASE("re-entrancy: CONodeStop within CONmtModeChange: the node stays in CO_INVALID and sends no frame") {
  struct Case {
    const char* command;
    CO_MODE at;
  };
  const Case cases[] = {{"000#0101", CO_OPERATIONAL},
                        {"000#0201", CO_STOP},
                        {"000#8101", CO_INIT},
                        {"000#8201", CO_INIT},
                        {"000#8001", CO_PREOP}};
  for (const Case& one : cases) {
    CAPTURE(std::string(one.command));
    Fixture node(Setup().heartbeat(100));
    if (one.at == CO_PREOP) node.rx("000#0101");
    callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) {
      if (mode == one.at) CONodeStop(nmt->Node);
    };
    node.rx(one.command);
    check_stopped(node);
  }
}

TEST_CASE("re-entrancy: CONodeStop within CONmtModeChange after the boot-up: the boot-up is the last frame") {
  Fixture node(Setup().heartbeat(100));
  callbacks().mode_change = [](CO_NMT* nmt, CO_MODE mode) {
    if (mode == CO_PREOP) CONodeStop(nmt->Node);
  };
  node.rx("000#8101");
  node.tx("701#00");
  check_stopped(node);
}

TEST_CASE("re-entrancy: CONodeStop within Init of a type in a reset: no boot-up, the node stays in CO_INVALID") {
  for (const char* command : {"000#8101", "000#8201"}) {
    CAPTURE(std::string(command));
    Fixture node(scripted().heartbeat(100));
    script.on_init = [](CO_NODE* n) { CONodeStop(n); };
    node.rx(command);
    check_stopped(node);
  }
}

TEST_CASE("re-entrancy: CONodeStop within Init of a type in CONodeInit: the controller stays off the bus") {
  Setup setup = scripted().heartbeat(100).stay_in_init();
  script.on_init = [](CO_NODE* n) { CONodeStop(n); };
  Fixture node(setup);
  node.call([&] { CONodeStart(&node.node); });
  check_stopped(node);
}

TEST_CASE("re-entrancy: CONodeStop within a write: no answer, the node stays in CO_INVALID [Q9]") {
  Fixture node(scripted().heartbeat(100));
  script.on_write = [](CO_NODE* n) { CONodeStop(n); };
  node.rx("601#2F00300001000000");
  check_stopped(node);
}

TEST_CASE("re-entrancy: CONmtSetMode within CONmtModeChange determines the final state") {
  Fixture node(Setup().heartbeat(100));
  std::vector<CO_MODE> told;
  callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) {
    told.push_back(mode);
    if (mode == CO_OPERATIONAL) CONmtSetMode(nmt, CO_STOP);
  };
  node.rx("000#0101");
  CHECK(node.mode() == CO_STOP);
  CHECK(told == std::vector<CO_MODE>{CO_OPERATIONAL, CO_STOP});
  node.rx("601#4000100000000000");
  node.silent();
  node.after(100ms);
  node.tx("701#04");
}

TEST_CASE("re-entrancy: CONmtSetMode within Init of a type is refused with CO_ERR_NMT_MODE") {
  for (const CO_MODE mode : {CO_PREOP, CO_OPERATIONAL, CO_STOP}) {
    CAPTURE(mode);
    Setup setup = scripted().stay_in_init();
    script.on_init = [=](CO_NODE* n) { CONmtSetMode(&n->Nmt, mode); };
    Fixture node(setup);
    node.silent();
    CHECK(node.error() == CO_ERR_NMT_MODE);
    CHECK(node.mode() == CO_INIT);
    node.call([&] { CONodeStart(&node.node); });
    node.tx("701#00");
    node.rx("000#8201");
    node.tx("701#00");
    CHECK(node.error() == CO_ERR_NMT_MODE);
    CHECK(node.mode() == CO_PREOP);
  }
}

TEST_CASE("re-entrancy: CONodeStart within Init of a type does nothing") {
  Setup setup = scripted().stay_in_init();
  script.on_init = [](CO_NODE* n) { CONodeStart(n); };
  Fixture node(setup);
  node.silent();
  CHECK(node.mode() == CO_INIT);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  node.rx("000#8101");
  node.tx("701#00");
  CHECK(node.mode() == CO_PREOP);
}

// Replacement of the dictionary during a transfer ---------------------------------------------------------------------

// A node with an open transfer whose dictionary was replaced by a copy, so that the transfer refers to the old table.
class Moved : public Fixture {
 public:
  Moved() {
    ask("601#2108200008000000", "581#6008200000000000");
    table_.assign(node.Dict.Root, node.Dict.Root + node.Dict.Num);
    call([this] { CHECK(CODictInit(&node.Dict, &node, table_.data(), node.Dict.Num) == node.Dict.Num); });
  }
  ~Moved() { CONodeStop(&node); }  // the node must not use the table after its destruction
  Moved(const Moved&) = delete;
  Moved& operator=(const Moved&) = delete;

 private:
  std::vector<CO_OBJ> table_;
};

TEST_CASE("re-entrancy: a table that is moved during a transfer: a segment is aborted with 0800 0022h") {
  Moved node;
  node.ask("601#0001020304050607", "581#8008200022000008");
  node.ask("601#0011223300000000", "581#8011223301000405");
}

TEST_CASE("re-entrancy: a table that is moved during a transfer: the abort of the client is not answered [D6]") {
  Moved node;
  node.rx("601#8008200000000405");
  node.silent();
  node.ask("601#0011223300000000", "581#8011223301000405");
}

TEST_CASE("re-entrancy: a table that is moved during a transfer: a new initiate is processed [D8]") {
  Moved one;
  check_serves(one);
  Moved two;
  two.ask("601#2108200008000000", "581#6008200000000000");
  two.ask("601#0001020304050607", "581#2000000000000000");
  two.ask("601#1D08000000000000", "581#3000000000000000");
  CHECK(two.objects.u64 == 0x0807060504030201);
}

// Requests a reset from CONmtModeChange() when the node enters \a mode for the first time.
struct Resetting {
  explicit Resetting(CO_MODE mode) {
    callbacks().mode_change = [this, mode](CO_NMT* nmt, CO_MODE next) {
      resets += next == CO_INIT ? 1U : 0U;
      if (next == mode && resets == 0) CONmtReset(nmt, CO_RESET_COM);
    };
  }
  unsigned resets = 0;
};

TEST_CASE("re-entrancy: a reset requested while a function changes the mode is carried out after that function") {
  Fixture node;
  Resetting application(CO_OPERATIONAL);
  node.call([&] {
    CONmtSetMode(&node->Nmt, CO_OPERATIONAL);
    CHECK(application.resets == 1);
  });
  node.tx("701#00");
  CHECK(node.mode() == CO_PREOP);
}

TEST_CASE("re-entrancy: a reset requested at a bus-off is carried out after the callback") {
  Fixture node;
  node.rx("000#0101");
  Resetting application(CO_PREOP);
  node.call([&] {
    CONodeCanEvent(&node.node, CO_CAN_BUS_OFF);
    CHECK(application.resets == 1);
  });
  node.tx("701#00");
}

#if CO_HBCONS_N > 0

TEST_CASE("re-entrancy: a reset requested in the action of a timer is carried out after the action") {
  CO_HBCONS entry{nullptr, nullptr, CO_INVALID, 0, 100, 5, 0};
  Fixture node(Setup().with({CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, &entry}));
  node.rx("705#05");
  node.rx("000#0101");
  Resetting application(CO_PREOP);
  node.elapse_only(101ms);
  node.call([&] {
    COTmrProcess(&node->Tmr);
    CHECK(application.resets == 1);
  });
  CHECK(node.mode() == CO_PREOP);
  CHECK(node.frames().back() == "701#00");
}

#endif

#if CO_TPDO_N > 0

TEST_CASE("re-entrancy: after CODictInit() PDOs use the objects of the new table") {
  std::uint8_t value = 0x12;
  std::vector<CO_OBJ> table = {{CO_KEY(0x1800, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x40000181},
                               {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 1},
                               {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, CO_LINK(0x2000, 0, 8)},
                               {CO_KEY(0x2000, 0, CO_OBJ____PR_), CO_TUNSIGNED8, &value}};
  Fixture node;
  node.call([&] { CODictInit(&node->Dict, &node.node, table.data(), static_cast<std::uint16_t>(table.size())); });
  node.ask("000#8201", "701#00");
  node.rx("000#0101");
  table.insert(table.begin(), {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0});
  node.call([&] {
    CODictInit(&node->Dict, &node.node, table.data(), static_cast<std::uint16_t>(table.size()));
    CHECK(COTPdoRequest(&node.node, 0) == CO_ERR_NONE);
  });
  node.tx("181#12");
}

#endif

// Requests of callbacks at the begin and the end of a node ------------------------------------------------------------

TEST_CASE("re-entrancy: CONmtSetMode in CONmtModeChange of the boot-up sends one boot-up message [N1]") {
  Fixture node(scripted());
  callbacks().mode_change = [](CO_NMT* nmt, CO_MODE mode) {
    if (mode == CO_PREOP) CONmtSetMode(nmt, CO_OPERATIONAL);
  };
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(node.mode() == CO_OPERATIONAL);
}

TEST_CASE("re-entrancy: a reaction of 1029h in CONmtModeChange of a reset does not end the reset") {
  for (const bool by_bus_off : {false, true}) {
    CAPTURE(by_bus_off);
    Fixture node(scripted());
    node.rx("000#0101");
    callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) {
      if (mode != CO_INIT) return;
      by_bus_off ? CONodeCanEvent(nmt->Node, CO_CAN_BUS_OFF) : static_cast<void>(COErrorBehaviour(nmt->Node, 1));
    };
    script.inits = 0;
    node.rx("000#8101");
    CHECK(script.inits == 1);
    CHECK(node.frames().front() == "701#00");
  }
}

TEST_CASE("re-entrancy: a Read function that the application calls changes neither NMT state nor table at once") {
  Fixture node(scripted());
  CO_MODE inside = CO_INVALID;
  std::int16_t replaced = 0;
  script.on_read = [&](CO_NODE* of) {
    CONmtSetMode(&of->Nmt, CO_OPERATIONAL);
    inside = of->Nmt.Mode;
    replaced = CODictInit(&of->Dict, of, of->Dict.Root, of->Dict.Num);
  };
  node.call([&] {
    std::uint8_t bytes[8];
    CHECK(CODictRdBuffer(&node->Dict, CO_DEV(0x3001, 0), bytes, 8) == CO_ERR_NONE);
  });
  CHECK(inside == CO_PREOP);
  CHECK(replaced == -1);
  CHECK(node.mode() == CO_OPERATIONAL);
}

TEST_CASE("re-entrancy: a reset that CONodeCanChange requests runs after it") {
  Fixture node(scripted());
  unsigned inits = 99;
  script.inits = 0;
  callbacks().can_change = [&](CO_NODE* of, CO_CAN_EVENT) {
    CONmtReset(&of->Nmt, CO_RESET_NODE);
    inits = script.inits;
  };
  node.call([&] { CONodeCanEvent(&node.node, CO_CAN_PASSIVE); });
  CHECK(inits == 0);
  CHECK(script.inits == 1);
  node.frames();
}

}  // namespace
