// SPDX-License-Identifier: Apache-2.0
// Reception and transmission of frames: types of frames, lengths, counters, error frames, transmission order.
#include <limits>

#include "support/fixture.hpp"

namespace {

using namespace test;

TEST_CASE(
    "frames: a remote frame on an identifier of the node is malformed; on other identifiers it is unclaimed [Q1]") {
  Fixture node;
  std::vector<std::string> passed_on;
  callbacks().can_receive = [&](CO_IF_FRM* frm) { passed_on.push_back(notation(*frm)); };
  const CO_NODE_COUNTERS before = node.counters();
  node.rx("601#R8");
  node.rx("000#R2");
  CHECK(node.counters().Malformed == before.Malformed + 2);
  CHECK(passed_on.empty());
  node.rx("123#R");
  node.rx("702#R1");
  CHECK(node.counters().Unclaimed == before.Unclaimed + 2);
  CHECK(passed_on == std::vector<std::string>{"123#R", "702#R"});
  node.silent();
}

TEST_CASE("frames: a 29-bit identifier does not match the 11-bit identifier of the same value [Q1]") {
  Fixture node;
  std::vector<std::string> passed_on;
  callbacks().can_receive = [&](CO_IF_FRM* frm) { passed_on.push_back(notation(*frm)); };
  const CO_NODE_COUNTERS before = node.counters();
  node.rx("00000601#4000100000000000");
  node.rx("00000000#0101");
  node.rx("1FFFFFFF#00");
  node.silent();
  CHECK(node.counters().Unclaimed == before.Unclaimed + 3);
  CHECK(passed_on == std::vector<std::string>{"00000601#4000100000000000", "00000000#0101", "1FFFFFFF#00"});
}

TEST_CASE("frames: a DLC of 9 to 15 means 8 bytes [Q1]") {
  Fixture node;
  node.ask("601#4000100000000000_9", "581#4300100091010F00");
  node.ask("601#4000100000000000_F", "581#4300100091010F00");
  unsigned dlc = 0;
  callbacks().can_receive = [&](CO_IF_FRM* frm) { dlc = frm->DLC; };
  node.rx("123#1122334455667788_F");
  CHECK(dlc == 8);
}

CO_IF_FRM with_dlc(std::string_view text, unsigned dlc) {
  CO_IF_FRM frm = frame(text);
  frm.DLC = static_cast<std::uint8_t>(dlc);
  return frm;
}

TEST_CASE("frames: a DLC above 15 is malformed: counted, neither processed nor passed on [ISO 11898-1]") {
  Fixture node;
  unsigned passed_on = 0;
  unsigned events = 0;
  callbacks().can_receive = [&](CO_IF_FRM*) { ++passed_on; };
  callbacks().can_change = [&](CO_NODE*, CO_CAN_EVENT) { ++events; };
  std::uint32_t malformed = node.counters().Malformed;
  for (const unsigned dlc : {16U, 17U, 64U, 255U}) {
    CAPTURE(dlc);
    for (const char* const text :
         {"601#4000100000000000", "000#0101", "123#1122334455667788", "00012345#0102", "20000040#0000000000000000"}) {
      node.rx(with_dlc(text, dlc));
      CHECK(node.counters().Malformed == ++malformed);
    }
  }
  CHECK(passed_on == 0);
  CHECK(events == 0);
  CHECK(node.mode() == CO_PREOP);
  CHECK(node.counters().Unclaimed == 0);
  node.silent();
  node.ask("601#4000100000000000", "581#4300100091010F00");
}

TEST_CASE("frames: the application sends 8 bytes for a DLC of 9 to 15; a DLC above 15 is refused and counted") {
  Fixture node;
  const std::uint32_t malformed = node.counters().Malformed;
  for (unsigned dlc = 9; dlc <= 15; ++dlc) {
    CO_IF_FRM frm = with_dlc("123#1122334455667788", dlc);
    node.call([&] { CHECK(COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM)); });
    node.tx("123#1122334455667788");
  }
  for (const unsigned dlc : {16U, 64U, 255U}) {
    CO_IF_FRM frm = with_dlc("123#1122334455667788", dlc);
    node.call([&] { CHECK(COIfCanSend(&node->If, &frm) == -1); });
    node.silent();
  }
  CHECK(node.counters().Malformed == malformed + 3);
}

TEST_CASE("frames: COIfCanRead() returns at most 8 bytes, and skips and counts frames with a DLC above 15") {
  Fixture node;
  const std::uint32_t malformed = node.counters().Malformed;
  node.can.to_node.push_back(with_dlc("123#01", 16));
  node.can.to_node.push_back(with_dlc("123#02", 255));
  node.can.to_node.push_back(with_dlc("123#1122334455667788", 12));
  CO_IF_FRM frm{};
  node.call([&] { CHECK(COIfCanRead(&node->If, &frm) == sizeof(CO_IF_FRM)); });
  CHECK(notation(frm) == "123#1122334455667788");
  node.call([&] { CHECK(COIfCanRead(&node->If, &frm) == 0); });
  CHECK(node.counters().Malformed == malformed + 2);
}

TEST_CASE("frames: an unclaimed frame is passed to the application unchanged, and is counted") {
  Fixture node;
  std::vector<std::string> passed_on;
  callbacks().can_receive = [&](CO_IF_FRM* frm) { passed_on.push_back(notation(*frm)); };
  const CO_NODE_COUNTERS before = node.counters();
  node.rx("602#4000100000000000");
  node.rx("581#4300100091010F00");
  node.rx("7FF#112233445566");
  node.rx("080#");
  CHECK(passed_on ==
        std::vector<std::string>{"602#4000100000000000", "581#4300100091010F00", "7FF#112233445566", "080#"});
  CHECK(node.counters().Unclaimed == before.Unclaimed + 4);
  CHECK(node.counters().Received == before.Received + 4);
  CHECK(node.counters().Malformed == before.Malformed);
  node.silent();
}

TEST_CASE("frames: a processed frame is not passed to the application") {
  Fixture node;
  unsigned passed_on = 0;
  callbacks().can_receive = [&](CO_IF_FRM*) { ++passed_on; };
  node.ask("601#4000100000000000", "581#4300100091010F00");
  node.rx("000#0101");
  node.rx("000#0155");
  node.rx("601#40");
  CHECK(passed_on == 0);
}

TEST_CASE("frames: of all identifiers only those of the node are answered") {
  Fixture node(Setup().only_small().node_id(0x35).without(0x1014, 0));  // no EMCY at 735h
  unsigned answered = 0;
  for (unsigned id = 0x001; id < 0x800; ++id) {
    CO_IF_FRM frm = frame("001#4000100000000000");
    frm.Identifier = id;
    node.rx(frm);
    if (!node.frames().empty()) {
      ++answered;
      CHECK(id == 0x635);
    }
  }
  CHECK(answered == 1);
}

TEST_CASE("frames: SocketCAN error frames become events of the controller") {
  Fixture node(Setup().without(0x1014, 0));  // no EMCY
  std::vector<CO_CAN_EVENT> events;
  unsigned passed_on = 0;
  callbacks().can_change = [&](CO_NODE* of, CO_CAN_EVENT event) {
    CHECK(of == &node.node);
    events.push_back(event);
  };
  callbacks().can_receive = [&](CO_IF_FRM*) { ++passed_on; };
  node.rx("20000004#0001000000000000");  // controller: receive buffer overflow
  node.rx("20000004#0010000000000000");  // controller: error passive, receiving
  node.rx("20000004#0020000000000000");  // controller: error passive, sending
  node.rx("20000040#0000000000000000");  // bus-off
  node.rx("20000100#0000000000000000");  // restarted
  CHECK(events ==
        std::vector<CO_CAN_EVENT>{CO_CAN_OVERRUN, CO_CAN_PASSIVE, CO_CAN_PASSIVE, CO_CAN_BUS_OFF, CO_CAN_RECOVERED});
  CHECK(passed_on == 0);
  const CO_NODE_COUNTERS counters = node.counters();
  CHECK(counters.CanEvents[CO_CAN_OVERRUN] == 1);
  CHECK(counters.CanEvents[CO_CAN_PASSIVE] == 2);
  CHECK(counters.CanEvents[CO_CAN_BUS_OFF] == 1);
  CHECK(counters.CanEvents[CO_CAN_RECOVERED] == 1);
  node.silent();
}

TEST_CASE("frames: an error frame is never processed as a command") {
  Fixture node;
  node.rx("20000000#0101000000000000");
  node.rx("20000601#4000100000000000");
  CHECK(node.mode() == CO_PREOP);
  node.silent();
}

TEST_CASE("frames: drivers report events of the controller; unknown events have no effect") {
  Fixture node;
  unsigned events = 0;
  callbacks().can_change = [&](CO_NODE*, CO_CAN_EVENT) { ++events; };
  node.call([&] {
    CONodeCanEvent(&node.node, CO_CAN_BUS_OFF);
    CONodeCanEvent(&node.node, CO_CAN_EVENT_NUM);
  });
  CHECK(events == 1);
  CHECK(node.counters().CanEvents[CO_CAN_BUS_OFF] == 1);
}

TEST_CASE("frames: all counters saturate [Q10]") {
  Fixture node;
  constexpr std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  node->Count.Received = node->Count.Unclaimed = node->Count.Malformed = most;
  node->Count.Sent = node->Count.SdoAborts = node->Count.Dropped = node->Count.TimerExhausted = most;
  node->Count.CanEvents[CO_CAN_PASSIVE] = most;
  node.rx("123#");
  node.rx("601#40");
  node.ask("601#4004100000000000", "581#8004100000000206");
  node.call([&] { CONodeCanEvent(&node.node, CO_CAN_PASSIVE); });
  node.tx("081#2081110000000000");
  node.call([&] {
    for (int i = 0; i < 20; ++i)
      COTmrCreate(
          &node->Tmr, 1000000, 0, [](void*) {}, nullptr);
  });
  node.can.refuse_all();
  CO_IF_FRM frm = frame("7E0#00");
  node.call([&] {
    for (int i = 0; i < 2 * CO_TX_QUEUE_N; ++i) COIfCanSend(&node->If, &frm);
  });
  const CO_NODE_COUNTERS counters = node.counters();
  CHECK(counters.Received == most);
  CHECK(counters.Unclaimed == most);
  CHECK(counters.Malformed == most);
  CHECK(counters.Sent == most);
  CHECK(counters.SdoAborts == most);
  CHECK(counters.Dropped == most);
  CHECK(counters.TimerExhausted == most);
  CHECK(counters.CanEvents[CO_CAN_PASSIVE] == most);
}

TEST_CASE("frames: a driver that fails to read is reported and read again") {
  Fixture node;
  node.can.read_result = -1;
  node.loop();
  CHECK(node.error() == CO_ERR_IF_CAN_READ);
  CHECK(node.error() == CO_ERR_NONE);
  node.ask("601#4000100000000000", "581#4300100091010F00");
}

TEST_CASE("frames: each call processes one frame") {
  Fixture node;
  for (int i = 0; i < 3; ++i) node.can.to_node.push_back(frame("601#4000100000000000"));
  node.call([&] { CONodeProcess(&node.node); });
  node.tx("581#4300100091010F00");
  node.call([&] { CONodeProcess(&node.node); });
  node.tx("581#4300100091010F00");
  node.loop();
  node.tx("581#4300100091010F00");
}

}  // namespace
