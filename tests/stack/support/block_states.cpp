// SPDX-License-Identifier: Apache-2.0
#include "block_states.hpp"

namespace test {
namespace {

void accept_download(Fixture& node) { node.ask("601#C60421007A030000", "581#A40421007F000000"); }

void receive_some(Fixture& node) {
  accept_download(node);
  send_segments(node, counting(890, 7), 0, 2);
}

void receive_block(Fixture& node) {
  accept_download(node);
  send_segments(node, counting(890, 7), 0, 127);
  node.tx("581#A27F7F0000000000");
}

void receive_with_gap(Fixture& node) {
  accept_download(node);
  send_segments(node, counting(890, 7), 0, 2);
  send_segments(node, counting(890, 7), 3, 124, 4);
  node.tx("581#A2027D0000000000");
}

void receive_all(Fixture& node) {
  receive_block(node);
  send_segments(node, counting(890, 7), 127, 1);
  expect_last_ack(node, 1);
}

void receive_value(Fixture& node) {
  node.ask("601#C608200008000000", "581#A40820007F000000");
  node.rx("601#0101020304050607");
  node.rx("601#8208000000000000");
  expect_last_ack(node, 2);
}

void offer_upload(Fixture& node) { node.ask("601#A40421000A000000", "581#C60421007A030000"); }

void send_block(Fixture& node) {
  offer_upload(node);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 10);
}

void send_part_again(Fixture& node) {
  send_block(node);
  node.rx("601#A204140000000000");
  expect_segments(node, counting(890), 4, 20);
}

void send_all(Fixture& node) {
  send_block(node);
  node.rx("601#A20A7F0000000000");
  expect_segments(node, counting(890), 10, 118);
}

void pause(Fixture& node) {
  offer_upload(node);
  node.can.accept_next(3);
  node.rx("601#A300000000000000");
  expect_segments(node, counting(890), 0, 3);
}

void offer_value(Fixture& node) { node.ask("601#A40820007F000000", "581#C608200008000000"); }

void end_upload(Fixture& node) {
  node.ask("601#A400210F7F000000", "581#C600210F0F000000");
  node.rx("601#A300000000000000");
  node.tx({"581#0101020304050607", "581#0208090A0B0C0D0E", "581#830F000000000000"});
  node.ask("601#A2037F0000000000", "581#D93D510000000000");
}

}  // namespace

const std::vector<BlockState>& block_states() {
  static const std::vector<BlockState> states = {
      {"download accepted", "042100", true, "581#A40421007F000000", accept_download},
      {"within a sub-block", "042100", true, "581#A2027D0000000000", receive_some},
      {"between sub-blocks", "042100", true, "581#A27F7F0000000000", receive_block},
      {"after a gap", "042100", true, "581#A2027D0000000000", receive_with_gap},
      {"all received", "042100", false, "581#A201", receive_all},
      {"value received", "082000", false, "581#A202", receive_value},
      {"upload offered", "042100", false, "", offer_upload},
      {"value offered", "082000", false, "", offer_value},
      {"block sent", "042100", false, "", send_block},
      {"block sent again in part", "042100", false, "", send_part_again},
      {"all sent", "042100", false, "", send_all},
      {"sending paused", "042100", false, "", pause},
      {"upload ended", "00210F", false, "", end_upload},
  };
  return states;
}

void let_go_on(Fixture& node) {
  node.can.accept_all();
  node.loop();
}

void check_all_transfers(Fixture& node, Where at) {
  node.ask("601#A3DEADBE00000000", "581#80DEADBE01000405", at);
  node.ask("601#01DEADBE00000000", "581#80DEADBE01000405", at);
  node.ask("601#4000100000000000", "581#4300100091010F00", at);
  CHECK(node.upload(0x1008, 0, at).size() == 17);
  const BlockResult upload = node.block_upload(0x2103, 0, {}, at);
  CHECK(upload.abort == 0);
  CHECK(upload.data == counting(888));
  const Bytes data = counting(890, 99);
  CHECK(node.block_download(0x2104, 0, data, {}, at).abort == 0);
  CHECK(node.objects.memory[890] == data);
}

}  // namespace test
