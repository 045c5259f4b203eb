// SPDX-License-Identifier: Apache-2.0
// Frames of the application with a 29-bit identifier without the flag CO_IF_FRM_EXT.
#include "support/fixture.hpp"

namespace {

using namespace test;

// Sends a frame with this identifier, and checks that the caller's frame does not change.
void send(Fixture& node, std::uint32_t identifier) {
  CO_IF_FRM frm = {identifier, {1}, 1};
  node.call([&] { CHECK(COIfCanSend(&node->If, &frm) == sizeof(CO_IF_FRM)); });
  CHECK(frm.Identifier == identifier);
}

TEST_CASE("transmit identifier: above 7FFh without flag it is sent with 29 bits; up to 7FFh with 11") {
  Fixture node;
  send(node, 0x7FF);
  node.tx("7FF#01");
  send(node, 0x800);
  node.tx("00000800#01");
  send(node, 0x1FFFFFFF);
  node.tx("1FFFFFFF#01");
  send(node, 0x80000800);
  node.tx("00000800#01");
  send(node, 0x800007FF);
  node.tx("000007FF#01");
}

TEST_CASE("transmit identifier: above 7FFh without flag it is queued with the priority of a 29-bit frame [Q4]") {
  Fixture node(Setup().tx_queue(20));
  node.can.refuse_all();
  // 02440000h has the base identifier 091h: of equal base identifiers, the 11-bit frame wins.
  for (const std::uint32_t id : {0x7FFU, 0x092U, 0x02440000U, 0x091U, 0x02480000U, 0x0243FFFFU, 0x800U}) {
    send(node, id);
  }
  node.can.accept_all();
  node.loop();
  node.tx({"00000800#01", "0243FFFF#01", "091#01", "02440000#01", "092#01", "02480000#01", "7FF#01"});
}

}  // namespace
