// SPDX-License-Identifier: Apache-2.0
// EMCY producer: errors of the application, and the error register. [301:7.2.7, 7.5.2.2]
#include <set>

#include "support/emcy_fixture.hpp"

#if USE_EMCY

namespace {

using namespace test;

TEST_CASE("EMCY: an error is sent with its code, the error register and the five bytes [E1] [301:7.2.7.3.1]") {
  EmcyNode node;
  const CO_EMCY_USR usr{0x1234, {0xA1, 0xA2, 0xA3, 0xA4, 0xA5}};
  node.set(current, &usr);
  node.tx("081#002003A1A2A3A4A5");
  CHECK(node.error_register() == 0x03);
  node.ask("601#4001100000000000", "581#4F01100003000000");
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("EMCY: without information of the user the five bytes are 0 [E1]") {
  EmcyNode node;
  node.set(no_disk);
  node.tx("081#00FF810000000000");
}

TEST_CASE("EMCY: an error that stays is sent once [E1]") {
  EmcyNode node;
  node.set(current);
  node.tx("081#0020030000000000");
  node.set(current);
  node.silent();
  node.after(60s);
  node.silent();
  node.clr(current);
  node.tx("081#0000000000000000");
  node.clr(current);
  node.silent();
  node.set(current);
  node.tx("081#0020030000000000");
}

TEST_CASE("EMCY: each of several errors is resolved with the register of the remaining ones [E2] [E3]") {
  EmcyNode node;
  node.set(current);
  node.set(hot);
  node.set(very_hot);
  node.tx({"081#0020030000000000", "081#00400B0000000000", "081#00420B0000000000"});
  node.clr(hot);
  node.tx("081#00000B0000000000");
  node.clr(current);
  node.tx("081#0000090000000000");
  node.clr(very_hot);
  node.tx("081#0000000000000000");
  CHECK(node.error_register() == 0x00);
}

TEST_CASE("EMCY: each class sets its bit and the generic one; bit 6 and unknown classes set none [E3] [301:7.5.2.2]") {
  const unsigned bits[] = {0x01, 0x03, 0x05, 0x09, 0x11, 0x21, 0x01, 0x81};
  for (unsigned reg = 0; reg <= 0xFF; ++reg) {
    CAPTURE(reg);
    EmcyNode node(Setup().only_small().emergencies({{static_cast<std::uint8_t>(reg), 0x1000}}));
    node.set(0);
    CHECK(node.error_register() == (reg < 8 ? bits[reg] : 0x01U));
    CHECK(node.trace().size() == 1);
    node.clr(0);
    CHECK(node.error_register() == 0);
    CHECK(node.trace().size() == 1);
  }
}

TEST_CASE("EMCY: the identifier follows the node-ID [E5] [EMCY 01]") {
  EmcyNode node(Setup().emergencies(errors_of_device()).node_id(0x7F));
  node.set(general);
  node.tx("0FF#0010010000000000");
}

TEST_CASE("EMCY: messages are sent in Pre-operational and Operational [N3]") {
  EmcyNode node;
  node.set(general);
  node.tx("081#0010010000000000");
  node.rx("000#0101");
  node.clr(general);
  node.tx("081#0000000000000000");
}

TEST_CASE("EMCY: errors set in Stopped are entered in 1001h and 1003h and never sent [E9] [N9] [301:7.3.2.2.4]") {
  EmcyNode node;
  node.rx("000#0201");
  node.set(current);
  node.set(hot);
  node.clr(hot);
  node.silent();
  CHECK(node.error_register() == 0x03);
  CHECK(node.errors() == std::vector<std::uint32_t>{0x4000, 0x2000});
  node.rx("000#0101");
  node.after(10s);
  node.silent();
  node.clr(current);
  node.tx("081#0000000000000000");
  CHECK(node.counters().Dropped == 0);
}

TEST_CASE("EMCY: errors set before the boot-up are entered in 1001h and 1003h and not sent [N4]") {
  EmcyNode node(Setup().emergencies(errors_of_device()).stay_in_init());
  node.set(current);
  node.silent();
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  CHECK(node.error_register() == 0x03);
  CHECK(node.errors() == std::vector<std::uint32_t>{0x2000});
  node.ask("601#4001100000000000", "581#4F01100003000000");
}

TEST_CASE("EMCY: identifiers beyond the table are refused and read no memory behind it [D16]") {
  EmcyNode node;
  for (const unsigned err : {last_error + 1U, 31U, 32U, 254U, 255U}) {
    CAPTURE(err);
    const auto number = static_cast<std::uint8_t>(err);
    node.set(number);
    CHECK(node.error() == CO_ERR_BAD_ARG);
    node.clr(number);
    CHECK(node.error() == CO_ERR_BAD_ARG);
    CHECK(COEmcyGet(&node->Emcy, number) == -1);
  }
  node.silent();
  CHECK(node.error_register() == 0);
  CHECK(COEmcyCnt(&node->Emcy) == 0);
  CHECK(node.errors().empty());
}

TEST_CASE("EMCY: a table longer than CO_EMCY_N is used up to CO_EMCY_N entries [D16]") {
  EmcyNode node(Setup().emergencies(std::vector<CO_EMCY_TBL>(CO_EMCY_N + 1, {CO_EMCY_REG_CURRENT, 0x2000})));
  node.set(CO_EMCY_N - 1);
  node.tx("081#0020030000000000");
  CHECK(COEmcyGet(&node->Emcy, CO_EMCY_N - 1) == 1);
#if CO_EMCY_N < 256
  node.set(CO_EMCY_N);
  CHECK(node.error() == CO_ERR_BAD_ARG);
  CHECK(COEmcyGet(&node->Emcy, CO_EMCY_N) == -1);
#endif
}

TEST_CASE("EMCY: without a table no error can be set") {
  EmcyNode node{Setup()};
  node.set(0);
  CHECK(node.error() == CO_ERR_EMCY_BAD_ROOT);
  node.clr(0);
  CHECK(node.error() == CO_ERR_EMCY_BAD_ROOT);
  CHECK(COEmcyGet(&node->Emcy, 0) == 0);
  node.silent();
}

TEST_CASE("EMCY: COEmcyGet, COEmcyCnt and COEmcyReset work with and without messages [D17]") {
  EmcyNode node;
  for (std::uint8_t err = 0; err <= last_error; ++err) {
    CHECK(COEmcyGet(&node->Emcy, err) == 0);
    node.set(err);
    CHECK(COEmcyGet(&node->Emcy, err) == 1);
    CHECK(COEmcyCnt(&node->Emcy) == err + 1);
  }
  CHECK(node.trace().size() == 5);
  node.call([&] { COEmcyReset(&node->Emcy, 0); });
  node.tx({"081#00008B0000000000", "081#0000890000000000", "081#0000890000000000", "081#0000810000000000",
           "081#0000000000000000"});
  CHECK(COEmcyCnt(&node->Emcy) == 0);
  node.set(hot);
  node.tx("081#0040090000000000");
  node.call([&] { COEmcyReset(&node->Emcy, 1); });
  node.silent();
  CHECK(node.error_register() == 0);
  CHECK(COEmcyGet(&node->Emcy, hot) == 0);
}

TEST_CASE("EMCY: COEmcyReset does not resolve the errors of the stack") {
  EmcyNode node;
  node.set(hot);
  node.raise_fault(co::event::Fault::heartbeat, 3);
  CHECK(node.trace().size() == 2);
  node.call([&] { COEmcyReset(&node->Emcy, 1); });
  CHECK(node.error_register() == 0x11);
  node.resolve_fault(co::event::Fault::heartbeat, 3);
  node.tx("081#0000000000030000");
}

TEST_CASE("EMCY: null pointers call CONodeFatalError(); COEmcyGet and COEmcyCnt return -1") {
  EmcyNode node;
  COEmcySet(nullptr, 0, nullptr);
  COEmcyClr(nullptr, 0);
  COEmcyReset(nullptr, 0);
  COEmcyHistReset(nullptr);
  CHECK(callbacks().fatal_errors == 4);
  CO_EMCY of_nobody{};
  COEmcySet(&of_nobody, 0, nullptr);
  COEmcyClr(&of_nobody, 0);
  COEmcyReset(&of_nobody, 0);
  COEmcyHistReset(&of_nobody);
  CHECK(callbacks().fatal_errors == 8);
  CHECK(COEmcyGet(nullptr, 0) == -1);
  CHECK(COEmcyGet(&of_nobody, 0) == -1);
  CHECK(COEmcyCnt(nullptr) == -1);
  CHECK(callbacks().fatal_errors == 8);
}

// Missing objects, and objects of another type ------------------------------------------------------------------------

TEST_CASE("EMCY: without 1001h the messages are correct and the node reports the missing object") {
  EmcyNode node(Setup().emergencies(errors_of_device()).without(0x1001, 0));
  CHECK(node.error() == (USE_DICT_CHECK != 0 ? CO_ERR_CFG_1001_0 : CO_ERR_NONE));
  node.set(current);
  node.set(hot);
  node.clr(current);
  node.tx({"081#0020030000000000", "081#00400B0000000000", "081#0000090000000000"});
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("EMCY: 1001h with its value in the entry (flag D) is not written, because it may be in read-only memory") {
  EmcyNode node(Setup().emergencies(errors_of_device()).with({CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 0x00}));
  node.set(current);
  node.tx("081#0020030000000000");
  CHECK(std::uintptr_t{node.find(0x1001, 0)->Data} == 0);
  node.clr(current);
  node.tx("081#0000000000000000");
}

TEST_CASE("EMCY: 1001h that cannot be written sets the node error; the message is correct") {
  const std::uint8_t* protected_byte = nullptr;
  EmcyNode node(Setup().emergencies(errors_of_device()).writable([&](const void* address, std::uint32_t) {
    return address != protected_byte;
  }));
  protected_byte = &node.objects.error_register;
  node.set(current);
  node.tx("081#0020030000000000");
  CHECK(node.error() == CO_ERR_OBJ_ACC);
  CHECK(node.error_register() == 0);
  protected_byte = nullptr;
  node.clr(current);
  node.tx("081#0000000000000000");
}

TEST_CASE("EMCY: 1001h is written only when it changes") {
  unsigned written = 0;
  EmcyNode node(Setup().emergencies(errors_of_device()).writable([&](const void*, std::uint32_t size) {
    written += size == 1 ? 1 : 0;
    return true;
  }));
  CHECK(written == 0);
  node.set(hot);
  CHECK(written == 1);
  node.set(very_hot);
  CHECK(written == 1);
  node.clr(hot);
  CHECK(written == 1);
  node.clr(very_hot);
  CHECK(written == 2);
  CHECK(node.trace().size() == 4);
}

TEST_CASE("EMCY: without 1014h nothing is sent; a node with an error table reports the missing object") {
  Fixture node(Setup().emergencies(errors_of_device()).without(0x1014, 0));
  CHECK(node.error() == (USE_DICT_CHECK != 0 ? CO_ERR_CFG_1014_0 : CO_ERR_NONE));
  node.call([&] { COEmcySet(&node->Emcy, current, nullptr); });
  node.silent();
  CHECK(node.objects.error_register == 0x03);
  Fixture plain(Setup().without(0x1014, 0));
  CHECK(plain.error() == CO_ERR_NONE);
}

TEST_CASE("EMCY: 1014h of type UNSIGNED32 sets CAN-ID, frame format and bit 31 [E5] [D45]") {
  const struct {
    std::uint32_t value;
    const char* sent;
  } cases[] = {{0x00000085, "085#0010010000000000"},
               {0x20012345, "00012345#0010010000000000"},
               {0x80000081, nullptr},
               {0xA0000081, nullptr},
               {0x00000000, nullptr},
               {0x20000000, nullptr},
               {0x00000800, nullptr}};
  for (const auto& one : cases) {
    CAPTURE(one.value);
    Fixture node(
        Setup().emergencies(errors_of_device()).with({CO_KEY(0x1014, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, one.value}));
    node.call([&] { COEmcySet(&node->Emcy, general, nullptr); });
    if (one.sent != nullptr) {
      node.tx(one.sent);
    }
    node.silent();
    CHECK(node.objects.error_register == 0x01);
  }
}

TEST_CASE("EMCY: after CODictInit() 1001h and 1014h of the new table are used, also on a stopped node") {
  EmcyNode node;
  std::uint8_t moved = 0;
  std::vector<CO_OBJ> table = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
                               {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&moved)},
                               {CO_KEY(0x1014, 0, CO_OBJ_D___R_), CO_TEMCY_ID, 0x85}};
  node.call([&] { CHECK(CODictInit(&node->Dict, &node.node, table.data(), 3) == 3); });
  node.set(current);
  node.tx("085#0020030000000000");
  CHECK(moved == 0x03);
  node.call([&] { CONodeStop(&node.node); });
  std::uint8_t last = 0xEE;
  table[1].Data = (CO_DATA)(&last);
  std::vector<CO_OBJ> other = table;
  table.assign(3, {0xFFFFFFFF, nullptr, 0});
  node.call([&] { CHECK(CODictInit(&node->Dict, &node.node, other.data(), 3) == 3); });
  node.clr(current);
  node.silent();
  CHECK(last == 0);
}

TEST_CASE("EMCY: all CO_EMCY_N errors of the application can be set in any order [E3]") {
  std::vector<CO_EMCY_TBL> table;
  for (unsigned n = 0; n < CO_EMCY_N; ++n) {
    table.push_back({static_cast<std::uint8_t>(n % 6), static_cast<std::uint16_t>(0x1000 + n)});
  }
  EmcyNode node(Setup().only_small().emergencies(table));
  std::multiset<unsigned> classes;
  const auto expected = [&] {
    unsigned bits = classes.empty() ? 0U : 1U;
    for (const unsigned one : classes) bits |= 1U << one;
    return bits;
  };
  for (unsigned step = 0; step < 2 * CO_EMCY_N; ++step) {
    const auto err = static_cast<std::uint8_t>(step * 7 % CO_EMCY_N);  // 7 and CO_EMCY_N have no common divisor
    CAPTURE(step);
    if (step < CO_EMCY_N) {
      node.set(err);
      classes.insert(err % 6U);
    } else {
      node.clr(err);
      classes.erase(classes.find(err % 6U));
    }
    CHECK(node.error_register() == expected());
    CHECK(node.trace().size() == 1);
  }
  CHECK(classes.empty());
}

}  // namespace

#endif
