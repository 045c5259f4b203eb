// SPDX-License-Identifier: Apache-2.0
// Commands of an NMT master: CONmtCommand(). [301:7.2.8.2.1]
#include "support/fixture.hpp"

#if USE_NMT_MASTER

namespace {

using namespace test;

constexpr CO_NMT_COMMAND commands[] = {CO_NMT_COMMAND_START, CO_NMT_COMMAND_STOP, CO_NMT_COMMAND_PREOP,
                                       CO_NMT_COMMAND_RESET_NODE, CO_NMT_COMMAND_RESET_COM};

class Master : public Fixture {
 public:
  explicit Master(Setup setup = {}) : Fixture(setup.nmt_master()) { frames_per_call(2); }
  CO_ERR command(CO_NMT_COMMAND what, unsigned node_id) {
    CO_ERR err = CO_ERR_NONE;
    call([&] { err = CONmtCommand(&node.Nmt, what, static_cast<std::uint8_t>(node_id)); });
    return err;
  }
};

TEST_CASE("NMT master: a command to another node is sent and not carried out here [N1] [N2]") {
  const std::string bytes[] = {"01", "02", "80", "81", "82"};
  for (std::size_t n = 0; n < 5; ++n) {
    Master node;
    CHECK(node.command(commands[n], 5) == CO_ERR_NONE);
    node.tx("000#" + bytes[n] + "05");
    CHECK(node.command(commands[n], 127) == CO_ERR_NONE);
    node.tx("000#" + bytes[n] + "7F");
    CHECK(node.mode() == CO_PREOP);
    node.after(1000ms);
    node.silent();
  }
}

TEST_CASE("NMT master: a command to the own node is carried out and not sent") {
  constexpr CO_MODE after[] = {CO_OPERATIONAL, CO_STOP, CO_PREOP, CO_PREOP, CO_PREOP};
  for (std::size_t n = 0; n < 5; ++n) {
    for (const char* state : {"000#8022", "000#0122", "000#0222"}) {
      CAPTURE(n);
      CAPTURE(state);
      Master node(Setup().node_id(0x22));
      node.rx(state);
      CHECK(node.command(commands[n], 0x22) == CO_ERR_NONE);
      n < 3 ? node.silent() : node.tx("722#00");
      CHECK(node.mode() == after[n]);
    }
  }
}

TEST_CASE("NMT master: a command to all nodes is sent and then carried out here [N1]") {
  Master node;
  CHECK(node.command(CO_NMT_COMMAND_START, 0) == CO_ERR_NONE);
  node.tx("000#0100");
  CHECK(node.mode() == CO_OPERATIONAL);
  CHECK(node.command(CO_NMT_COMMAND_STOP, 0) == CO_ERR_NONE);
  node.tx("000#0200");
  CHECK(node.mode() == CO_STOP);
  CHECK(node.command(CO_NMT_COMMAND_PREOP, 0) == CO_ERR_NONE);
  node.tx("000#8000");
  CHECK(node.mode() == CO_PREOP);
  CHECK(node.command(CO_NMT_COMMAND_RESET_NODE, 0) == CO_ERR_NONE);
  node.tx({"000#8100", "701#00"});
  CHECK(node.command(CO_NMT_COMMAND_RESET_COM, 0) == CO_ERR_NONE);
  node.tx({"000#8200", "701#00"});
  CHECK(node.mode() == CO_PREOP);
}

TEST_CASE("NMT master: a queued reset of all nodes is sent before the own boot-up message") {
  Master node;
  node.can.refuse_all();
  CHECK(node.command(CO_NMT_COMMAND_RESET_COM, 0) == CO_ERR_NONE);
  node.can.accept_all();
  node.loop();
  node.tx({"000#8200", "701#00"});
  CHECK(node.counters().Dropped == 0);
}

TEST_CASE("NMT master: queued commands keep their order") {
  Master node;
  node.can.refuse_all();
  CHECK(node.command(CO_NMT_COMMAND_RESET_NODE, 9) == CO_ERR_NONE);
  CHECK(node.command(CO_NMT_COMMAND_START, 9) == CO_ERR_NONE);
  node.can.accept_all();
  node.frames_per_call(3);
  node.loop();
  node.tx({"000#8109", "000#0109"});
}

TEST_CASE("NMT master: unknown commands and node-IDs above 127 are refused") {
  Master node;
  for (unsigned command = 0; command < 256; ++command) {
    const bool known = command == 1 || command == 2 || (command >= 128 && command <= 130);
    CAPTURE(command);
    CHECK(node.command(static_cast<CO_NMT_COMMAND>(command), 5) == (known ? CO_ERR_NONE : CO_ERR_BAD_ARG));
    CHECK(node.frames().size() == (known ? 1 : 0));
  }
  for (unsigned id = 128; id < 256; ++id) CHECK(node.command(CO_NMT_COMMAND_START, id) == CO_ERR_BAD_ARG);
  node.silent();
}

TEST_CASE("NMT master: null and an NMT object without a node are refused") {
  CO_NMT without_node = {};
  for (CO_NMT* const nmt : {static_cast<CO_NMT*>(nullptr), &without_node}) {
    for (const CO_NMT_COMMAND command : commands) {
      CHECK(CONmtCommand(nmt, command, 0) == CO_ERR_BAD_ARG);
      CHECK(CONmtCommand(nmt, command, 5) == CO_ERR_BAD_ARG);
    }
  }
  CHECK(callbacks().fatal_errors == 0);
}

TEST_CASE("NMT master: commands are refused in Initialisation and after a stop of the node") {
  Master node(Setup().stay_in_init());
  CHECK(node.command(CO_NMT_COMMAND_START, 5) == CO_ERR_NMT_MODE);
  CHECK(node.command(CO_NMT_COMMAND_START, 1) == CO_ERR_NMT_MODE);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.command(CO_NMT_COMMAND_START, 0) == CO_ERR_NMT_MODE);
  node.silent();
}

TEST_CASE("NMT master: commands are sent in Stopped [N3]") {
  Master node;
  node.rx("000#0201");
  CHECK(node.command(CO_NMT_COMMAND_START, 5) == CO_ERR_NONE);
  node.tx("000#0105");
  CHECK(node.mode() == CO_STOP);
}

TEST_CASE("NMT master: with a full transmit queue a command is neither sent nor carried out") {
  Master node(Setup().tx_queue(1));
  node.can.refuse_all();
  node.rx("601#4000100000000000");
  CHECK(node.command(CO_NMT_COMMAND_START, 0) == CO_ERR_IF_CAN_SEND);
  CHECK(node.mode() == CO_PREOP);
  node.can.accept_all();
  node.loop();
  node.tx("581#4300100091010F00");
}

TEST_CASE("NMT master: callbacks may send commands [Q9]") {
  Master node;
  callbacks().can_receive = [&](CO_IF_FRM*) {
    CHECK(CONmtCommand(&node->Nmt, CO_NMT_COMMAND_RESET_NODE, 0) == CO_ERR_NONE);
  };
  node.rx("123#00");
  node.tx({"000#8100", "701#00"});
  bool once = true;
  callbacks().mode_change = [&](CO_NMT* nmt, CO_MODE mode) {
    if (mode == CO_OPERATIONAL && once) {
      once = false;
      CHECK(CONmtCommand(nmt, CO_NMT_COMMAND_STOP, 0) == CO_ERR_NONE);
    }
  };
  node.rx("000#0101");
  node.tx("000#0200");
  CHECK(node.mode() == CO_STOP);
}

TEST_CASE("NMT master: a heartbeat consumer receives the state after the command") {
  Master master(Setup().node_id(1));
  Fixture slave(Setup().node_id(2).heartbeat(100));
  CHECK(master.command(CO_NMT_COMMAND_START, 2) == CO_ERR_NONE);
  for (const std::string& frm : master.frames()) slave.rx(frm);
  slave.after(100ms);
  slave.tx("702#05");
}

}  // namespace

#endif
