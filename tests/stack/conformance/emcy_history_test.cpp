// SPDX-License-Identifier: Apache-2.0
// 1003h, pre-defined error field. [301:7.5.2.4]
#include <type_traits>

#include "lexican/object.hpp"
#include "support/emcy_fixture.hpp"

namespace {

using namespace test;

#if USE_EMCY

using Errors = std::vector<std::uint32_t>;

TEST_CASE("1003h: empty at first; an entry that is not in use has no data [E4] [D46] [EMCY 03]") {
  EmcyNode node;
  node.ask("601#4003100000000000", "581#4F03100000000000");
  node.ask("601#4003100100000000", "581#8003100124000008");
  node.ask("601#4003100400000000", "581#8003100424000008");
  node.ask("601#4003100500000000", "581#8003100511000906");
}

TEST_CASE("1003h: COObjRd functions return CO_ERR_TYPE_RD for an entry that is not in use") {
  EmcyNode node;
  std::uint32_t entry = 0x12345678;
  node.call([&] {
    CHECK(CODictRdLong(&node->Dict, CO_DEV(0x1003, 1), &entry) == CO_ERR_TYPE_RD);
    CHECK(COObjRdValue(node.find(0x1003, 4), &node.node, &entry, 4) == CO_ERR_TYPE_RD);
  });
  CHECK(entry == 0x12345678);
}

TEST_CASE("1003h: the newest error is at sub-index 1; the oldest one is dropped from a full history [E4]") {
  EmcyNode node;
  node.set(general);
  CHECK(node.errors() == Errors{0x1000});
  node.set(current);
  node.set(hot);
  CHECK(node.errors() == Errors{0x4000, 0x2000, 0x1000});
  CHECK(node.trace().size() == 3);
  node.ask("601#4003100400000000", "581#8003100424000008");
}

TEST_CASE("1003h: the order is kept when a full history is overwritten many times [E4]") {
  EmcyNode node;
  Errors expected;
  for (unsigned n = 0; n < 50; ++n) {
    const CO_EMCY_USR usr{static_cast<std::uint16_t>(n), {}};
    const auto err = static_cast<std::uint8_t>(n % 5);
    node.set(err, &usr);
    node.clr(err);
    expected.insert(expected.begin(), (n << 16) | errors_of_device()[err].Code);
    expected.resize(std::min<std::size_t>(expected.size(), 4));
    CHECK(node.errors() == expected);
  }
  node.trace();
  node.ask("601#4003100000000000", "581#4F03100004000000");
  node.ask("601#4003100400000000", "581#4303100400202E00");
}

TEST_CASE("1003h: the error code is in the low word, the information of the user in the high word [EMCY 06]") {
  EmcyNode node;
  const CO_EMCY_USR usr{0xA2A1, {0xA1, 0xA2, 0xA3, 0xA4, 0xA5}};
  node.set(current, &usr);
  node.tx("081#002003A1A2A3A4A5");
  node.ask("601#4003100100000000", "581#430310010020A1A2");
}

TEST_CASE("1003h: errors of the stack have 0 in the high word and in bytes 1 and 2 of the manufacturer data [E11]") {
  EmcyNode node;
  node.raise_fault(co::event::Fault::pdo_short, 3);
  node.tx("081#1082110000030000");
  node.ask("601#4003100100000000", "581#4303100110820000");
}

TEST_CASE("1003h: resolved errors are not entered [E8] [N8]") {
  EmcyNode node;
  node.set(current);
  node.clr(current);
  node.raise_fault(co::event::Fault::heartbeat, 4);
  node.resolve_fault(co::event::Fault::heartbeat, 4);
  CHECK(node.trace().size() == 4);
  CHECK(node.errors() == Errors{0x8130, 0x2000});
}

#if CO_EMCY_QUEUE_N > 0

TEST_CASE("1003h: errors are entered in their order, independent of the inhibit time [E8]") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 1000);
  node.set(current);
  node.set(hot);
  node.set(very_hot);
  node.tx("081#0020030000000000");
  CHECK(node.errors() == Errors{0x4200, 0x4000, 0x2000});
  node.after(1s);
  CHECK(node.trace().size() == 2);
}

#endif

TEST_CASE("1003h: writing 0 to sub-index 0 empties it; any other value is refused [E4] [SDO 10]") {
  EmcyNode node;
  node.set(current);
  node.set(hot);
  node.trace();
  for (const char* value : {"01", "02", "80", "FF"}) {
    CAPTURE(value);
    node.ask("601#2F031000" + std::string(value) + "000000", "581#8003100030000906");
  }
  CHECK(node.errors() == Errors{0x4000, 0x2000});
  node.ask("601#2F03100000000000", "581#6003100000000000");
  CHECK(node.errors().empty());
  node.ask("601#4003100100000000", "581#8003100124000008");
  CHECK(node.error_register() == 0x0B);
  node.set(very_hot);
  node.tx("081#00420B0000000000");
  CHECK(node.errors() == Errors{0x4200});
}

TEST_CASE("1003h: COEmcyHistReset and a write by the application empty it") {
  EmcyNode node;
  node.set(current);
  node.call([&] { COEmcyHistReset(&node->Emcy); });
  CHECK(node.errors().empty());
  node.set(hot);
  node.call([&] { CHECK(CODictWrByte(&node->Dict, CO_DEV(0x1003, 0), 1) == CO_ERR_OBJ_RANGE); });
  CHECK(node.errors() == Errors{0x4000});
  node.call([&] { CHECK(CODictWrByte(&node->Dict, CO_DEV(0x1003, 0), 0) == CO_ERR_NONE); });
  CHECK(node.errors().empty());
  node.trace();
}

TEST_CASE("1003h: entries cannot be written, even with write access in the table [E4]") {
  std::uint32_t entry = 0;
  EmcyNode node(
      Setup().emergencies(errors_of_device()).with({CO_KEY(0x1003, 5, CO_OBJ_____RW), CO_TEMCY_HIST, &entry}));
  node.ask("601#2303100100000000", "581#8003100102000106");
  node.ask("601#2303100500000000", "581#8003100502000106");
  node.call([&] { CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1003, 5), 0) == CO_ERR_TYPE_WR); });
}

TEST_CASE("1003h: a wrong length is refused") {
  EmcyNode node;
  node.ask("601#2B03100000000000", "581#8003100012000706");
  std::uint16_t word = 0;
  CHECK(CODictRdWord(&node->Dict, CO_DEV(0x1003, 0), &word) == CO_ERR_OBJ_SIZE);
  CHECK(CODictRdWord(&node->Dict, CO_DEV(0x1003, 1), &word) == CO_ERR_OBJ_SIZE);
  CHECK(COObjRdValue(node.find(0x1003, 0), &node.node, &word, 2) == CO_ERR_BAD_ARG);
  CHECK(COObjRdValue(node.find(0x1003, 1), &node.node, &word, 2) == CO_ERR_BAD_ARG);
  CHECK(COObjWrValue(node.find(0x1003, 0), &node.node, &word, 2) == CO_ERR_BAD_ARG);
}

TEST_CASE("1003h: a history of 254 entries works") {
  std::vector<std::uint32_t> memory(254);
  Setup setup = Setup().only_small().emergencies(errors_of_device());
  for (unsigned sub = 5; sub <= 254; ++sub) {
    setup.with({CO_KEY(0x1003, sub, CO_OBJ_____R_), CO_TEMCY_HIST, &memory[sub - 1]});
  }
  EmcyNode node(setup);
  Errors expected;
  for (unsigned n = 0; n < 600; ++n) {
    const CO_EMCY_USR usr{static_cast<std::uint16_t>(n), {}};
    node.set(hot, &usr);
    node.clr(hot);
    expected.insert(expected.begin(), (n << 16) | 0x4000);
  }
  node.trace();
  expected.resize(254);
  CHECK(node.errors() == expected);
}

TEST_CASE("1003h: entries behind a gap are not used") {
  std::uint32_t beyond = 0x55555555;
  EmcyNode node(
      Setup().emergencies(errors_of_device()).with({CO_KEY(0x1003, 6, CO_OBJ_____R_), CO_TEMCY_HIST, &beyond}));
  for (std::uint8_t err = 0; err <= last_error; ++err) node.set(err);
  node.trace();
  CHECK(node.errors().size() == 4);
  CHECK(beyond == 0x55555555);
  node.ask("601#4003100600000000", "581#8003100624000008");
}

TEST_CASE("1003h: a node without it works without an error") {
  Fixture node(Setup().emergencies(errors_of_device()));
  CHECK(node.error() == CO_ERR_NONE);
  node.call([&] { COEmcySet(&node->Emcy, current, nullptr); });
  node.tx("081#0020030000000000");
  node.call([&] { COEmcyHistReset(&node->Emcy); });
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("1003h: without entries Init of the type fails, and the node runs") {
  EmcyNode node(Setup()
                    .emergencies(errors_of_device())
                    .without(0x1003, 1)
                    .without(0x1003, 2)
                    .without(0x1003, 3)
                    .without(0x1003, 4));
  CHECK(node.error() == CO_ERR_OBJ_INIT);
  CHECK(node.mode() == CO_PREOP);
  node.set(current);
  node.tx("081#0020030000000000");
  CHECK(node.errors().empty());
}

TEST_CASE("1003h: memory that cannot be written sets the node error") {
  EmcyNode node(
      Setup().emergencies(errors_of_device()).writable([&](const void*, std::uint32_t size) { return size != 4; }));
  node.set(current);
  node.tx("081#0020030000000000");
  CHECK(node.error() == CO_ERR_OBJ_ACC);
}

TEST_CASE("1003h: sub-index 0 may have flag D") {
  Setup direct = Setup().emergencies(errors_of_device());
  std::uint32_t entries[2] = {};
  direct.with({CO_KEY(0x1003, 0, CO_OBJ_D___RW), CO_TEMCY_HIST, 0});
  direct.with({CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, &entries[0]});
  direct.with({CO_KEY(0x1003, 2, CO_OBJ_____R_), CO_TEMCY_HIST, &entries[1]});
  Fixture small(direct);
  small.call([&] { COEmcySet(&small->Emcy, current, nullptr); });
  small.tx("081#0020030000000000");
  small.ask("601#4003100000000000", "581#4F03100001000000");
  small.ask("601#2F03100000000000", "581#6003100000000000");
  small.ask("601#4003100000000000", "581#4F03100000000000");
}

#if USE_DICT_CHECK

TEST_CASE("1003h and 1014h: an entry with their types or flags at a wrong index is reported by CODictGetFault()") {
  static std::uint32_t variable;
  const struct {
    CO_OBJ entry;
    CO_DICT_FAULT fault;
  } cases[] = {
      {{CO_KEY(0x1004, 0, CO_OBJ_____RW), CO_TEMCY_HIST, &variable}, CO_DICT_WRONG_PLACE},
      {{CO_KEY(0x1004, 1, CO_OBJ_____R_), CO_TEMCY_HIST, &variable}, CO_DICT_WRONG_PLACE},
      {{CO_KEY(0x1003, 255, CO_OBJ_____R_), CO_TEMCY_HIST, &variable}, CO_DICT_WRONG_PLACE},
      {{CO_KEY(0x1003, 1, CO_OBJ_D___R_), CO_TEMCY_HIST, 0}, CO_DICT_DIRECT_TYPE},
      {{CO_KEY(0x1003, 1, CO_OBJ__N__R_), CO_TEMCY_HIST, &variable}, CO_DICT_NODEID_TYPE},
      {{CO_KEY(0x1003, 0, CO_OBJ__N__RW), CO_TEMCY_HIST, &variable}, CO_DICT_NODEID_TYPE},
      {{CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, 0}, CO_DICT_NO_DATA},
      {{CO_KEY(0x1014, 1, CO_OBJ_____RW), CO_TEMCY_ID, &variable}, CO_DICT_WRONG_PLACE},
      {{CO_KEY(0x1015, 0, CO_OBJ_____RW), CO_TEMCY_ID, &variable}, CO_DICT_WRONG_PLACE},
      {{CO_KEY(0x1014, 0, CO_OBJ_____RW), CO_TEMCY_ID, 0}, CO_DICT_NO_DATA},
  };
  for (const auto& one : cases) {
    CAPTURE(one.entry.Key);
    Fixture node(Setup().with(one.entry).stay_in_init());
    const bool runs = one.fault == CO_DICT_NO_DATA || one.fault == CO_DICT_NODEID_TYPE;
    CHECK(node.mode() == (runs ? CO_INIT : CO_INVALID));
    CHECK(node.error() == (runs ? CO_ERR_OBJ_INIT : CO_ERR_DICT_INIT));
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node->Dict, &key) == one.fault);
    CHECK(key == one.entry.Key);
  }
}

#endif

// Dictionary that is checked at compile time.
std::uint8_t number_of_errors;
std::uint32_t newest_error;
constexpr CO_OBJ od[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
                         {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
                         {CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, CO_DATA(&number_of_errors)},
                         {CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, CO_DATA(&newest_error)},
                         {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, 0x80},
                         {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
                         {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
                         CO_OBJ_DICT_ENDMARK};
CO_OD_CHECK(od);
static_assert(std::is_same_v<co::dictionary::Natural<od, 0x1003, 0>, std::uint8_t>);
static_assert(std::is_same_v<co::dictionary::Natural<od, 0x1003, 1>, std::uint32_t>);
static_assert(std::is_same_v<co::dictionary::Natural<od, 0x1014, 0>, std::uint32_t>);

#endif

// EMCY messages without their queue (CO_EMCY_QUEUE_N 0): no inhibit time, no attempt to send again.

#if USE_EMCY && CO_EMCY_QUEUE_N == 0

TEST_CASE("EMCY without queue: messages are sent at once whatever inhibit time 1015h has") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 100);
  node.set(general);
  node.set(hot);
  node.clr(hot);
  node.tx({"081#0010010000000000", "081#0040090000000000", "081#0000010000000000"});
}

TEST_CASE("EMCY without queue: a message while 1014h is not valid is not sent later") {
  EmcyNode node(Setup().emergencies(errors_of_device()));
  node.ask("601#2314100081000080", "581#6014100000000000");
  node.set(general);
  node.ask("601#2314100081000000", "581#6014100000000000");
  node.after(1s);
  node.silent();
  CHECK(node.error_register() == 1);
}

TEST_CASE("EMCY without queue: a message that finds the transmit queue full is lost and counted") {
  EmcyNode node(Setup().emergencies(errors_of_device()));
  node.can.refuse_all();
  for (unsigned n = 0; n <= CO_TX_QUEUE_N; ++n) {
    n % 2 == 0 ? node.set(general) : node.clr(general);
  }
  CHECK(node.counters().Dropped == 1);
}

#endif

}  // namespace
