// SPDX-License-Identifier: Apache-2.0
// EMCY consumer, 1028h. [301:7.5.2.30]
#include <algorithm>
#include <cstdio>
#include <utility>

#include "support/fixture.hpp"

#if CO_EMCY_CONS_N >= 3

namespace {

using namespace test;

// A node with three entries of 1028h. heard(): "node-ID code register data" for each call of the callback.
class Consumer : public Fixture {
 public:
  explicit Consumer(std::uint32_t second = 0x82, Setup setup = Setup())
      : Fixture(setup.with({CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 3})
                    .with({CO_KEY(0x1028, 1, CO_OBJ_D___RW), CO_TEMCY_CONS, 0x80000000})
                    .with({CO_KEY(0x1028, 2, CO_OBJ_D___RW), CO_TEMCY_CONS, second})
                    .with({CO_KEY(0x1028, 3, CO_OBJ_D___RW), CO_TEMCY_CONS, 0x20012345})) {
    callbacks().emcy_received = [this](CO_NODE* from, std::uint8_t id, std::uint16_t code, std::uint8_t reg,
                                       const std::uint8_t* msef) {
      CHECK(from == &node);
      char text[40];
      std::snprintf(text, sizeof text, "%u %04X %02X %02X%02X%02X%02X%02X", id, code, reg, msef[0], msef[1], msef[2],
                    msef[3], msef[4]);
      heard_.emplace_back(text);
    };
  }

  std::vector<std::string> heard() { return std::exchange(heard_, {}); }

 private:
  std::vector<std::string> heard_;
};

using Heard = std::vector<std::string>;

TEST_CASE("EMCY consumer: a message of a node that 1028h lists is reported with its node-ID [301:7.5.2.30]") {
  Consumer node;
  node.rx("082#1081110102030405");
  CHECK(node.heard() == Heard{"2 8110 11 0102030405"});
  node.rx("082#0000000000000000");
  CHECK(node.heard() == Heard{"2 0000 00 0000000000"});
  node.rx("00012345#00FF8100000000FF");
  CHECK(node.heard() == Heard{"3 FF00 81 00000000FF"});
  CHECK(node.counters().Unclaimed == 0);
  CHECK(node.counters().Malformed == 0);
  node.silent();
}

TEST_CASE("EMCY consumer: messages of nodes without a valid entry in 1028h are ignored") {
  Consumer node;
  for (const char* frame :
       {"081#1081110102030405", "083#1081110102030405", "00000082#1081110102030405", "345#1081110102030405"}) {
    CAPTURE(frame);
    node.rx(frame);
  }
  CHECK(node.heard() == Heard{});
  CHECK(node.counters().Unclaimed == 4);
}

TEST_CASE("EMCY consumer: frames of another length and remote frames are malformed and not passed to the application") {
  Consumer node;
  std::uint32_t malformed = 0;
  for (const char* frame : {"082#", "082#10", "082#10811101020304", "082#R"}) {
    CAPTURE(frame);
    node.rx(frame);
    CHECK(node.counters().Malformed == ++malformed);
  }
  CHECK(node.heard() == Heard{});
  node.rx("082#1081110102030405_F");
  CHECK(node.heard() == Heard{"2 8110 11 0102030405"});
  node.silent();
}

TEST_CASE("EMCY consumer: messages are received in Pre-operational and Operational, not in Stopped [N3]") {
  Consumer node;
  node.rx("000#0101");
  node.rx("082#1081110102030405");
  CHECK(node.heard().size() == 1);
  node.rx("000#0201");
  node.rx("082#1081110102030405");
  CHECK(node.heard() == Heard{});
  node.rx("000#8001");
  node.rx("082#1081110102030405");
  CHECK(node.heard().size() == 1);
}

TEST_CASE("EMCY consumer: a new COB-ID takes effect at once, also in the filter of the driver [E9] [N7]") {
  Consumer node;
  CHECK(std::count(node.can.filter.begin(), node.can.filter.end(), 0x82U) == 1);
  node.ask("601#2328100282000080", "581#6028100200000000");
  CHECK(std::count(node.can.filter.begin(), node.can.filter.end(), 0x82U) == 0);
  node.rx("082#1081110102030405");
  CHECK(node.heard() == Heard{});
  node.ask("601#23281002F0000000", "581#6028100200000000");
  CHECK(std::count(node.can.filter.begin(), node.can.filter.end(), 0xF0U) == 1);
  node.rx("0F0#1081110102030405");
  CHECK(node.heard() == Heard{"2 8110 11 0102030405"});
  node.ask("601#2328100182000000", "581#6028100100000000");
  node.rx("082#1081110102030405");
  CHECK(node.heard() == Heard{"1 8110 11 0102030405"});
}

TEST_CASE("EMCY consumer: bits 0 to 30 of a valid entry cannot be changed; restricted CAN-IDs are refused [E9]") {
  Consumer node;
  node.ask("601#2328100282000000", "581#6028100200000000");
  for (const char* value : {"83000000", "82000020", "F0000000"}) {
    CAPTURE(value);
    node.ask("601#23281002" + std::string(value), "581#8028100230000906");
  }
  for (const char* value : {"00000000", "00080000"}) {
    CAPTURE(value);
    node.ask("601#23281001" + std::string(value), "581#8028100130000906");
  }
  for (const char* value : {"7F000000", "01010000", "01060000", "01070000"}) {
    if (CO_RESTRICTED_IDS != 0) break;
    CAPTURE(value);
    node.ask("601#23281001" + std::string(value), "581#8028100130000906");
  }
  node.ask("601#4028100200000000", "581#4328100282000000");
  node.rx("082#1081110102030405");
  CHECK(node.heard().size() == 1);
}

TEST_CASE("EMCY consumer: a message on a COB-ID of two entries is reported for both") {
  Consumer node(0x20012345);
  node.rx("00012345#1081110102030405");
  CHECK(node.heard() == Heard{"2 8110 11 0102030405", "3 8110 11 0102030405"});
}

TEST_CASE("EMCY consumer: after both resets it receives messages and has one route for each entry [T14]") {
  Consumer node;
  for (const char* reset : {"000#8101", "000#8201", "000#8201"}) {
    node.rx(reset);
    node.tx("701#00");
    node.rx("082#1081110102030405");
    CHECK(node.heard() == Heard{"2 8110 11 0102030405"});
    CHECK(std::count(node.can.filter.begin(), node.can.filter.end(), 0x82U) == 1);
  }
}

TEST_CASE("EMCY consumer: entries may be written before the start and after the stop of the node [T14]") {
  Consumer node(0x82, Setup().stay_in_init());
  const auto write = [&](std::uint32_t value) {
    node.call([&] { CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1028, 1), value) == CO_ERR_NONE); });
  };
  node.may_change(0x1028, 1);
  write(0x91);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  node.rx("091#1081110102030405");
  CHECK(node.heard() == Heard{"1 8110 11 0102030405"});
  node.call([&] { CONodeStop(&node.node); });
  const std::vector<std::uint32_t> filter = node.can.filter;
  write(0x80000091);
  CHECK(node.can.filter == filter);
}

TEST_CASE("EMCY consumer: the callback may write 1028h, read objects, and reset the node [Q9]") {
  Consumer node;
  unsigned heard = 0;
  node.may_change(0x1028, 2);
  callbacks().emcy_received = [&](CO_NODE* n, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*) {
    ++heard;
    CHECK(CODictWrLong(&n->Dict, CO_DEV(0x1028, 2), 0x80000082) == CO_ERR_NONE);
    CONmtReset(&n->Nmt, CO_RESET_COM);
  };
  node.rx("082#1081110102030405");
  node.tx("701#00");
  node.rx("082#1081110102030405");
  CHECK(heard == 1);
}

TEST_CASE("EMCY consumer: in a flood of messages each one is reported, and the node answers requests [T16]") {
  Consumer node;
  unsigned heard = 0;
  callbacks().emcy_received = [&](CO_NODE*, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*) {
    ++heard;
  };
  for (unsigned n = 0; n < 10000 / stride(20); ++n) node.rx("082#1081110102030405");
  CHECK(heard == 10000 / stride(20));
  node.ask("601#4000100000000000", "581#4300100091010F00");
}

TEST_CASE("EMCY consumer: without 1028h no message is reported") {
  Fixture node;
  unsigned heard = 0;
  callbacks().emcy_received = [&](CO_NODE*, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*) {
    ++heard;
  };
  for (unsigned id = 0x80; id <= 0xFF; ++id) {
    CO_IF_FRM frm{id, {0x10, 0x81, 0x11}, 8};
    node.rx(frm);
  }
  CHECK(heard == 0);
}

#if USE_DICT_CHECK

TEST_CASE("EMCY consumer: 1028h at a wrong index or beyond CO_EMCY_CONS_N is reported by CODictGetFault()") {
  const struct {
    CO_OBJ entry;
    CO_DICT_FAULT fault;
  } cases[] = {{{CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TEMCY_CONS, 3}, CO_DICT_WRONG_PLACE},
               {{CO_KEY(0x1029, 1, CO_OBJ_D___R_), CO_TEMCY_CONS, 3}, CO_DICT_WRONG_PLACE},
               {{CO_KEY(0x1028, 1, CO_OBJ_DN__R_), CO_TEMCY_CONS, 3}, CO_DICT_NODEID_TYPE},
               {{CO_KEY(0x1028, CO_EMCY_CONS_N + 1, CO_OBJ_D___R_), CO_TEMCY_CONS, 3}, CO_DICT_NOT_CONFIGURED}};
  for (const auto& one : cases) {
    CAPTURE(one.entry.Key);
    Fixture node(Setup().with(one.entry).stay_in_init());
    CHECK(node.error() == (one.fault == CO_DICT_NODEID_TYPE ? CO_ERR_OBJ_INIT : CO_ERR_DICT_INIT));
    CHECK(CODictGetFault(&node->Dict, nullptr) == one.fault);
  }
}

#endif

}  // namespace

#endif
