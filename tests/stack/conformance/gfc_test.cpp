// SPDX-License-Identifier: Apache-2.0
// Global fail-safe command. [EN 50325-5]
#include "support/fixture.hpp"
#include "support/network.hpp"

#if USE_GFC

namespace {

using namespace test;

struct Used {
  std::uint8_t used;
};

// A node with 1300h; counts the calls of COGfcReceived().
class GfcNode : public Used, public Fixture {
 public:
  explicit GfcNode(std::uint8_t value = 1, Setup setup = Setup())
      : Used{value}, Fixture(setup.only_small().with({CO_KEY(0x1300, 0, CO_OBJ_____RW), CO_TGFC, &used})) {
    callbacks().gfc_received = [this](CO_NODE* of) {
      CHECK(of == &node);
      ++received;
    };
  }
  CO_ERR send() {
    CO_ERR result = CO_ERR_NONE;
    call([&] { result = COGfcSend(&node); });
    return result;
  }
  unsigned received = 0;
};

constexpr const char* states[] = {"000#8001", "000#0201", "000#0101"};  // Pre-operational, Stopped, Operational
bool is_operational(const char* command) { return std::string_view(command) == "000#0101"; }

TEST_CASE("GFC: a command calls COGfcReceived() in Operational only [GF1]") {
  for (const char* command : states) {
    GfcNode node;
    node.rx(command);
    node.rx("001#");
    CHECK(node.received == (is_operational(command) ? 1 : 0));
    CHECK(node.counters().Unclaimed == (is_operational(command) ? 0 : 1));
    CHECK(node.counters().Malformed == 0);
    node.silent();
  }
}

TEST_CASE("GFC: each command is reported, also many in a row [GF1]") {
  GfcNode node;
  node.rx("000#0101");
  for (unsigned n = 1; n <= 20; ++n) {
    node.rx("001#");
    CHECK(node.received == n);
  }
}

TEST_CASE("GFC: frames with data, remote frames and 29-bit identifiers are no command [GF1]") {
  GfcNode node;
  node.rx("000#0101");
  unsigned malformed = 0;
  for (const char* frame : {"001#00", "001#0000", "001#000000", "001#00000000", "001#0000000000", "001#000000000000",
                            "001#00000000000000", "001#FFFFFFFFFFFFFFFF", "001#R"}) {
    node.rx(frame);
    CHECK(node.counters().Malformed == ++malformed);
  }
  node.rx("00000001#");
  CHECK(node.counters().Malformed == malformed);
  CHECK(node.received == 0);
}

TEST_CASE("GFC: without 1300h or with 0 or another value in the table no command is sent or received [GF1]") {
  for (const std::uint8_t value : {std::uint8_t{0}, std::uint8_t{2}, std::uint8_t{255}}) {
    GfcNode node(value);
    node.rx("000#0101");
    node.rx("001#");
    CHECK(node.received == 0);
    CHECK(node.counters().Unclaimed == 1);
    CHECK(node.send() == CO_ERR_OBJ_STATE);
    node.silent();
  }
  Fixture none(Setup().only_small());
  none.rx("000#0101");
  none.rx("001#");
  CHECK(none.counters().Unclaimed == 1);
  none.call([&] { CHECK(COGfcSend(&none.node) == CO_ERR_OBJ_STATE); });
  none.silent();
}

TEST_CASE("GFC: COGfcSend() sends the frame in Operational only [GF1]") {
  for (const char* command : states) {
    GfcNode node;
    node.rx(command);
    if (is_operational(command)) {
      CHECK(node.send() == CO_ERR_NONE);
      node.tx("001#");
      CHECK(node.received == 0);
    } else {
      CHECK(node.send() == CO_ERR_NMT_MODE);
      node.silent();
    }
  }
  CHECK(COGfcSend(nullptr) == CO_ERR_BAD_ARG);
}

TEST_CASE("GFC: a busy controller sends one command later and first of all frames [GF1]") {
  GfcNode node(1, Setup().heartbeat(100));
  node.frames_per_call(3);
  node.rx("000#0101");
  node.after(50ms);
  node.trace();
  node.can.refuse_all();
  node.after(100ms);
  CHECK(node.send() == CO_ERR_NONE);
  CHECK(node.send() == CO_ERR_NONE);
  node.silent();
  node.can.accept_all();
  node.loop();
  node.tx({"001#", "701#05"});
}

TEST_CASE("GFC: a queued command is sent after Operational has ended, too [GF1]") {
  GfcNode node;
  node.rx("000#0101");
  node.can.refuse_all();
  CHECK(node.send() == CO_ERR_NONE);
  node.rx("000#8001");
  node.can.accept_all();
  node.loop();
  node.tx("001#");
}

TEST_CASE("GFC: a full transmit queue is reported [GF1]") {
  GfcNode node(1, Setup().tx_queue(1).heartbeat(100));
  node.rx("000#0101");
  node.can.refuse_all();
  node.after(100ms);
  CHECK(node.send() == CO_ERR_IF_CAN_SEND);
  node.can.accept_all();
  node.loop();
  node.tx("701#05");
}

TEST_CASE("1300h: 0 and 1 are accepted and take effect at once; other values are refused [GF2]") {
  GfcNode node(0);
  for (unsigned value = 0; value < 256; ++value) {
    const std::uint32_t expected = value > 1 ? 0x06090030 : 0;
    CHECK(node.download(0x1300, 0, {static_cast<std::uint8_t>(value)}) == expected);
    CHECK(node.used == (value == 0 ? 0 : 1));
  }
  node.trace();
  node.rx("000#0101");
  node.rx("001#");
  CHECK(node.received == 1);
  node.rx("000#8001");
  CHECK(node.download(0x1300, 0, {0}) == 0);
  node.rx("000#0101");
  node.rx("001#");
  CHECK(node.received == 1);
  CHECK(node.send() == CO_ERR_OBJ_STATE);
  node.trace();
}

TEST_CASE("1300h: in Operational a write is refused and a read answered [GF2]") {
  GfcNode node;
  node.rx("000#0101");
  for (std::uint8_t value = 0; value < 3; ++value) CHECK(node.download(0x1300, 0, {value}) == 0x08000022);
  CHECK(node.upload(0x1300, 0) == Bytes{1});
  CHECK(node.used == 1);
  node.trace();
}

TEST_CASE("1300h: other lengths are refused [GF2]") {
  GfcNode node;
  for (std::size_t length = 2; length <= 8; ++length) {
    CHECK(node.download(0x1300, 0, Bytes(length, 0)) == 0x06070012);
    CHECK(node.used == 1);
  }
  node.trace();
}

TEST_CASE("GFC: the command works after a reset of communication and of the node [GF1]") {
  for (const char* reset : {"000#8201", "000#8101"}) {
    GfcNode node;
    node.ask(reset, "701#00");
    node.rx("000#0101");
    node.rx("001#");
    CHECK(node.received == 1);
    CHECK(node.send() == CO_ERR_NONE);
    node.tx("001#");
  }
}

TEST_CASE("GFC: the callback may leave Operational or stop the node [GF1]") {
  GfcNode node;
  node.rx("000#0101");
  callbacks().gfc_received = [](CO_NODE* of) { CONmtSetMode(&of->Nmt, CO_PREOP); };
  node.rx("001#");
  CHECK(node.mode() == CO_PREOP);
  node.rx("000#0101");
  callbacks().gfc_received = [](CO_NODE* of) { CONodeStop(of); };
  node.rx("001#");
  CHECK(node.mode() == CO_INVALID);
}

#if USE_CALLBACKS
TEST_CASE("GFC: the function of the callback table replaces the C function [Q9]") {
  static unsigned calls;
  calls = 0;
  CO_CALLBACKS table{};
  table.GfcReceived = [](CO_NODE_T* of, void* user) {
    CHECK(user == CONodeGetUser(of));
    ++calls;
  };
  GfcNode node(1, Setup().callbacks(table));
  node.rx("000#0101");
  node.rx("001#");
  CHECK(calls == 1);
  CHECK(node.received == 0);
}
#endif

TEST_CASE("GFC: the command of one node reaches all others on the bus [GF1]") {
  static std::uint8_t used = 1;
  static std::uint8_t error_register;
  static const CO_OBJ od[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
                              {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, &error_register},
                              {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
                              {CO_KEY(0x1300, 0, CO_OBJ_____RW), CO_TGFC, &used},
                              CO_OBJ_DICT_ENDMARK};
  World world;
  Line& line = world.add_line("bus");
  std::vector<std::uint8_t> reached;
  callbacks().gfc_received = [&](CO_NODE* of) { reached.push_back(of->NodeId); };
  Device* devices[3];
  for (std::uint8_t id = 1; id <= 3; ++id) {
    DeviceOptions options{id};
    options.table = od;
    devices[id - 1] = &world.add_device(line, options);
  }
  line.say("000#0100");
  world.settle();
  line.take();
  CHECK(COGfcSend(&devices[1]->node) == CO_ERR_NONE);
  world.settle();
  CHECK(line.take_texts() == Texts{"001#"});
  CHECK(reached == std::vector<std::uint8_t>{1, 3});
  callbacks().gfc_received = nullptr;
}

}  // namespace

#endif
