// SPDX-License-Identifier: Apache-2.0
// Block transfers of several SDO servers at the same time. [301:7.5.2.33]
#include "support/block_frames.hpp"

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127 && CO_SSDO_N >= 2

namespace {

using namespace test;

// Returns the settings of a node whose second SDO server uses 690h/6A0h.
Setup two() {
  return Setup().before_init([](Objects& o) {
    o.sdo2_rx = 0x690;
    o.sdo2_tx = 0x6A0;
  });
}

CO_IF_FRM on_second(CO_IF_FRM frm) {
  frm.Identifier = 0x690;
  return frm;
}

TEST_CASE("SDO block channels: two downloads alternate segment by segment") {
  Fixture node(two());
  const Bytes one = counting(890, 3);
  const Bytes other = counting(889, 200);
  node.ask("601#C60421007A030000", "581#A40421007F000000");
  node.ask("690#C601210079030000", "6A0#A40121007F000000");
  for (unsigned n = 0; n < 126; ++n) {
    node.rx(block_segment(one, n, n + 1));
    node.rx(on_second(block_segment(other, n, n + 1)));
    node.silent();
  }
  node.rx(block_segment(one, 126, 127));
  node.tx("581#A27F7F0000000000");
  node.rx(on_second(block_segment(other, 126, 127)));
  CHECK(node.frames().size() == 1);
  node.rx(block_segment(one, 127, 1));
  expect_last_ack(node, 1);
  node.rx(block_end(0x690, other));
  node.tx("6A0#A100000000000000");
  node.rx(block_end(0x601, one));
  node.tx("581#A100000000000000");
  CHECK(node.objects.memory[890] == one);
  CHECK(node.objects.memory[889] == other);
}

TEST_CASE("SDO block channels: a download is possible during a paused upload [D20]") {
  Fixture node(two());
  const Bytes other = counting(889, 200);
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.can.accept_next(40);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 40);
  node.rx("690#C601210079030000");
  node.can.accept_all();
  node.loop();
  std::vector<std::string> sent = node.frames();
  REQUIRE(sent.size() == 88);
  CHECK(sent.front() == "6A0#A40121007F000000");
  CHECK(sent[1].substr(0, 6) == "581#29");
  CHECK(sent.back().substr(0, 6) == "581#7F");
  for (unsigned n = 0; n < 127; ++n) {
    node.silent();
    node.rx(on_second(block_segment(other, n, n + 1)));
  }
  CHECK(node.frames().size() == 1);
  node.rx(block_end(0x690, other));
  node.tx("6A0#A100000000000000");
  CHECK(node.objects.memory[889] == other);
  node.rx("601#A27F7F0000000000");
  expect_segments(node, counting(890), 127, 1);
  node.rx("601#A2017F0000000000");
  node.tx(notation(block_end(0x581, counting(890))));
  node.rx("601#A100000000000000");
}

TEST_CASE("SDO block channels: two paused uploads both resume [D20]") {
  Fixture node(two());
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.ask("690#A40121007F000000", "6A0#C601210079030000");
  node.can.refuse_all();
  node.rx("601#A300000000000000");
  node.rx("690#A300000000000000");
  std::vector<std::string> first;
  std::vector<std::string> second;
  for (unsigned calls = 0; calls < 300 && first.size() + second.size() < 254; ++calls) {
    node.can.accept_next(1);
    node.loop();
    for (const std::string& sent : node.frames()) {
      (sent[0] == '5' ? first : second).push_back(sent);
    }
  }
  CHECK(first.size() == 127);
  CHECK(second.size() == 127);
  node.can.accept_all();
  node.rx("601#A2007F0000000000");
  expect_segments(node, counting(890), 0, 127);
  node.rx("690#A27F7F0000000000");
  CO_IF_FRM end = block_end(0x6A0, counting(889));
  node.tx(notation(end));
}

TEST_CASE("SDO block channels: a stream open in one channel is refused to the second with 0800 0022h") {
  for (const char* first :
       {"601#C60421007A030000", "601#A40421007F000000", "601#210421007A030000", "601#4004210000000000"}) {
    CAPTURE(std::string(first));
    Fixture node(two());
    node.rx(first);
    CHECK(node.frames().size() == 1);
    for (const char* second : {"690#C60421007A030000", "690#A40421007F000000", "690#210421007A030000",
                               "690#4004210000000000", "690#2304210001020304"}) {
      node.ask(second, "6A0#8004210022000008");
    }
    node.rx("601#8004210000000008");
    node.ask("690#A40421007F000000", "6A0#C60421007A030000");
  }
}

TEST_CASE("SDO block channels: a value may be downloaded by both; the last end determines it") {
  Fixture node(two());
  node.ask("601#C604200004000000", "581#A40420007F000000");
  node.ask("690#C604200004000000", "6A0#A40420007F000000");
  node.rx("601#8101010101000000");
  expect_last_ack(node, 1);
  node.rx("690#8102020202000000");
  CHECK(node.frames().size() == 1);
  node.rx(block_end(0x690, Bytes{2, 2, 2, 2}));
  node.tx("6A0#A100000000000000");
  CHECK(node.objects.u32 == 0x02020202);
  node.rx(block_end(0x601, Bytes{1, 1, 1, 1}));
  node.tx("581#A100000000000000");
  CHECK(node.objects.u32 == 0x01010101);
}

TEST_CASE("SDO block channels: silence is monitored and answered separately on each channel [D11] [D18]") {
  Fixture node(two());
  node.ask("601#C60421007A030000", "581#A40421007F000000");
  node.ask("690#A40121007F000000", "6A0#C601210079030000");
  node.after(1000ms);
  CHECK(node.trace() == std::vector<std::string>{"500 581#A40421007F000000", "1000 581#A40421007F000000"});
  node.rx("601#0155555555555555");
  node.after(1000ms);
  CHECK(node.trace() ==
        std::vector<std::string>{"500 581#A2017E0000000000", "1000 581#A2017E0000000000", "1000 6A0#8001210000000405"});
}

TEST_CASE("SDO block channels: changing the COB-ID of a channel ends its transfer; the other one continues [D16]") {
  Fixture node(two());
  node.ask("690#C60421007A030000", "6A0#A40421007F000000");
  node.ask("601#A40121007F000000", "581#C601210079030000");
  node.ask("601#2301120190060080", "581#6001120100000000");
  node.rx("690#0155555555555555");
  node.silent();
  node.after(node.sdo_time_out());
  node.silent();
  CHECK(node.block_download(0x2104, 0, counting(890, 9)).abort == 0);
}

TEST_CASE("SDO block channels: each channel has its own part of the buffer") {
  Fixture node(two());
  const Bytes one(889, 0x11);
  const Bytes other(888, 0x22);
  node.ask("601#C601210079030000", "581#A40121007F000000");
  node.ask("690#C603210078030000", "6A0#A40321007F000000");
  send_segments(node, one, 0, 127);
  expect_last_ack(node, 127);
  for (unsigned n = 0; n < 127; ++n) {
    node.rx(on_second(block_segment(other, n, n + 1)));
  }
  CHECK(node.frames().size() == 1);
  node.rx(block_end(0x601, one));
  node.tx("581#A100000000000000");
  node.rx(block_end(0x690, other));
  node.tx("6A0#A100000000000000");
  CHECK(node.objects.memory[889] == one);
  CHECK(node.objects.memory[888] == other);
}

}  // namespace

#endif
