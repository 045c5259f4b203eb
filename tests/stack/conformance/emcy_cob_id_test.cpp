// SPDX-License-Identifier: Apache-2.0
// 1014h, COB-ID EMCY. [301:7.5.2.17, 7.3.5]
#include "support/emcy_fixture.hpp"
#include "support/restricted_ids.hpp"

#if USE_EMCY

namespace {

using namespace test;

std::string write(std::uint32_t value) {
  std::string text = "601#23141000";
  for (int n = 0; n < 4; ++n, value >>= 8) {
    text += "0123456789ABCDEF"[(value >> 4) & 0xF];
    text += "0123456789ABCDEF"[value & 0xF];
  }
  return text;
}

constexpr const char* done = "581#6014100000000000";
constexpr const char* refused = "581#8014100030000906";

TEST_CASE("1014h: 80h + node-ID by default [E5] [EMCY 01]") {
  EmcyNode node;
  node.ask("601#4014100000000000", "581#4314100081000000");
}

TEST_CASE("1014h: while it is valid its other bits cannot be changed [E5]") {
  EmcyNode node;
  node.ask(write(0x00000081), done);
  for (const std::uint32_t value : {0x00000082U, 0x00000090U, 0x20000081U, 0x20012345U, 0x40000081U}) {
    CAPTURE(value);
    node.ask(write(value), refused);
  }
  node.ask("601#4014100000000000", "581#4314100081000000");
  node.set(general);
  node.tx("081#0010010000000000");
}

TEST_CASE("1014h: a new CAN-ID that is written with and then without bit 31 takes effect at once [E5]") {
  EmcyNode node;
  node.ask(write(0x80000081), done);
  node.ask("601#4014100000000000", "581#4314100081000080");
  node.ask(write(0x000000F5), done);
  node.set(general);
  node.tx("0F5#0010010000000000");
  node.ask(write(0x800000F6), done);
  node.ask(write(0x20012345), done);
  node.clr(general);
  node.tx("00012345#0000000000000000");
}

TEST_CASE("1014h: with bit 31 nothing is sent; 1001h and 1003h are still updated [D45]") {
  EmcyNode node;
  node.ask(write(0x80000081), done);
  node.set(current);
  node.silent();
  CHECK(node.error_register() == 0x03);
  CHECK(node.errors() == std::vector<std::uint32_t>{0x2000});
  node.ask(write(0x00000081), done);
  node.after(1s);
  node.silent();
  CHECK(node.counters().Dropped == 0);
  node.clr(current);
  node.tx("081#0000000000000000");
}

TEST_CASE("1014h: restricted CAN-IDs are refused, with bit 31 and without [E5] [P5] [Other 10]") {
  for (const std::uint32_t valid : {0x80000000U, 0x00000000U}) {
    EmcyNode node;
    node.ask(write(0x80000081), done);
    unsigned wrong = 0;
    for (std::uint32_t id = 0; id <= 0x7FF; id += stride(31)) {
      node.rx(write(valid | id));
      const std::vector<std::string> answer = node.frames();
      wrong += answer != std::vector<std::string>{is_forbidden(id) ? refused : done} ? 1U : 0U;
      if (!is_forbidden(id) && valid == 0) {
        node.rx(write(0x80000000U | id));
        node.frames();
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("1014h: CAN-IDs that do not fit the frame format and the reserved bit 30 are refused") {
  EmcyNode node;
  node.ask(write(0x80000081), done);
  for (const std::uint32_t value : {0x00000800U, 0x80001081U, 0x1FFFFFFFU, 0x40000085U, 0xC0000085U, 0x60012345U}) {
    CAPTURE(value);
    node.ask(write(value), refused);
  }
  node.ask("601#4014100000000000", "581#4314100081000080");
}

TEST_CASE("1014h: stored relative to the node-ID without its flags; another node-ID gives another CAN-ID [D56]") {
  EmcyNode node(Setup().emergencies(errors_of_device()).node_id(0x10));
  node.ask("610#2314100090000080", "590#6014100000000000");
  CHECK(std::uintptr_t{node.find(0x1014, 0)->Data} == 0x80000080);
  node.ask("610#2314100085000000", "590#6014100000000000");
  node.ask("610#4014100000000000", "590#4314100085000000");
  node.set(general);
  node.tx("085#0010010000000000");
}

#if CO_EMCY_QUEUE_N > 0

TEST_CASE("1014h: messages queued for the inhibit time are dropped when it is switched off [E5]") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 1000);
  node.set(current);
  node.tx("081#0020030000000000");
  node.set(hot);
  node.set(very_hot);
  node.ask(write(0x80000081), done);
  CHECK(node.counters().Dropped == 2);
  node.ask(write(0x000000F5), done);
  node.after(1s);
  node.silent();
}

TEST_CASE(
    "1014h: messages queued for the controller under the old CAN-ID are dropped when it is switched off [E5] [D45]") {
  EmcyNode node;
  node.can.refuse_all();
  node.may_change(0x1014, 0);
  node.set(current);
  node.call([&] { CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1014, 0), 0x80000081) == CO_ERR_NONE); });
  node.can.accept_all();
  node.loop();
  node.silent();
  CHECK(node.counters().Dropped == 1);
}

TEST_CASE("1014h: an entry of a basic type that is switched off drops queued messages [D45]") {
  std::uint32_t cob_id = 0x81;
  Fixture node(Setup()
                   .emergencies(errors_of_device())
                   .with({CO_KEY(0x1014, 0, CO_OBJ_____RW), CO_TUNSIGNED32, &cob_id})
                   .with({CO_KEY(0x1015, 0, CO_OBJ_D___R_), CO_TUNSIGNED16, 100}));
  node.call([&] {
    COEmcySet(&node->Emcy, current, nullptr);
    COEmcySet(&node->Emcy, hot, nullptr);
  });
  node.tx("081#0020030000000000");
  node.ask(write(0x80000081), done);
  node.after(1s);
  node.silent();
  CHECK(node.counters().Dropped == 1);
}

#endif

TEST_CASE("1014h: a wrong length is refused") {
  EmcyNode node;
  node.ask("601#2B14100081000000", "581#8014100013000706");
}

}  // namespace

#endif
