// SPDX-License-Identifier: Apache-2.0
// Remote requests for TPDOs of all types, including 252 and 253. [301:7.2.2.5.3, 7.5.2.37] [X11] [X13]
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 0 && USE_PDO_RTR && USE_SYNC

namespace {

using namespace test;

SyncTable with(std::uint8_t type, std::uint32_t cob_id = 0x181) {
  SyncTable table;
  table.tpdo[0].on(cob_id, type, {0x22010108, 0x22020110});
  return table;
}

TEST_CASE("remote TPDO: types 253, 254 and 255 sample and send [X13] [PDO 03] [State 02]") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{253, 254, 255}) {
    CAPTURE(unsigned{type});
    SyncNode node(with(type));
    node.start();
    node.rx("181#R");
    node.tx("181#111112");
    node.u8[0] = 0x77;
    node.rx("181#R");
    node.tx("181#771112");
    node.rx("080#");
    node.silent();
    CHECK(node.counters().Malformed == 0);
  }
}

TEST_CASE("remote TPDO: types 0 to 240 and 252 send the values sampled at the last SYNC [X13]") {
  for (unsigned type = 0; type <= 252; type += type < 240 ? stride(16) : 1) {
    if (type > 240 && type < 252) {
      continue;
    }
    CAPTURE(type);
    SyncNode node(with(static_cast<std::uint8_t>(type)));
    node.start();
    node.rx("181#R");
    node.silent();  // before the first SYNC
    node.rx("080#");
    node.frames();
    node.u8[0] = 0x77;
    node.rx("181#R");
    node.tx("181#111112");
    node.rx("181#R");
    node.tx("181#111112");
    node.rx("080#");
    node.frames();
    node.rx("181#R");
    node.tx("181#771112");
  }
}

TEST_CASE("remote TPDO: type 252 is sampled at each SYNC and not sent with it [X1]") {
  SyncNode node(with(252));
  node.start();
  for (int i = 0; i < 10; ++i) {
    node.rx("080#");
    node.silent();
  }
}

TEST_CASE("remote TPDO: a request does not change the count of SYNCs") {
  SyncNode node(with(3));
  node.start();
  node.rx("080#");
  node.rx("080#");
  node.rx("181#R");
  node.tx("181#111112");
  node.rx("080#");
  node.tx("181#111112");
}

TEST_CASE("remote TPDO: with bit 30 requests are ignored for every type [X11]") {
  for (unsigned type = 0; type <= 255; type += type < 240 ? stride(16) : 1) {
    if (type > 240 && type < 252) {
      continue;
    }
    SyncNode node(with(static_cast<std::uint8_t>(type), 0x40000181));
    node.start();
    node.rx("080#");
    node.frames();
    node.rx("181#R");
    node.silent();
    CHECK(node.counters().Unclaimed == 1);
  }
}

TEST_CASE("remote TPDO: the DLC of a request is ignored [X13]") {
  SyncNode node(with(253));
  node.start();
  for (std::uint8_t dlc = 0; dlc <= 15; ++dlc) {
    node.rx(CO_IF_FRM{0x181 | CO_IF_FRM_RTR, {}, dlc});
    node.tx("181#111112");
  }
}

TEST_CASE("remote TPDO: requests are answered only in Operational; leaving it discards sampled values [X13] [N11]") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{1, 252, 253, 255}) {
    for (const char* command : {"000#8001", "000#0201"}) {
      CAPTURE(unsigned{type});
      SyncNode node(with(type));
      node.rx("181#R");
      node.silent();
      node.start();
      node.rx("080#");
      node.frames();
      node.rx(command);
      node.rx("181#R");
      node.rx("080#");
      node.rx("181#R");
      node.silent();
      node.rx("000#0101");
      node.rx("181#R");
      CHECK(node.frames().size() == (type >= 253 ? 1 : 0));
    }
  }
}

TEST_CASE("remote TPDO: a data frame with its CAN-ID is no request and counted [Q1]") {
  SyncNode node(with(253));
  node.start();
  node.rx("181#111112");
  node.silent();
  CHECK(node.counters().Malformed == 1);
}

TEST_CASE("remote TPDO: a TPDO answers when switched on and not when switched off") {
  SyncNode node(with(253));
  node.start();
  CHECK(node.set(0x1800, 1, 4, 0x80000181) == 0);
  node.rx("181#R");
  node.silent();
  CHECK(node.set(0x1800, 1, 4, 0x191) == 0);
  node.rx("181#R");
  node.silent();
  node.rx("191#R");
  node.tx("191#111112");
  CHECK(node.set(0x1800, 1, 4, 0x80000191) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000191) == 0);
  node.rx("191#R");
  node.silent();
}

TEST_CASE("remote TPDO: 29-bit requests are answered") {
  SyncNode node(with(253, 0x20000000U | 0x12345678U));
  node.start();
  node.rx("12345678#R");
  node.tx("12345678#111112");
}

TEST_CASE("remote TPDO: if an object cannot be read at the SYNC no frame is sent, nor older values [X12]") {
  static CO_ERR answer;
  static const CO_OBJ_TYPE type = {[](CO_OBJ*, CO_NODE*, std::uint32_t) -> std::uint32_t { return 1; }, nullptr,
                                   [](CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t) {
                                     *static_cast<std::uint8_t*>(buffer) = 0x5A;
                                     return answer;
                                   },
                                   nullptr, nullptr};
  for (const std::uint8_t transmission : std::initializer_list<std::uint8_t>{1, 252}) {
    CAPTURE(unsigned{transmission});
    SyncTable table;
    table.tpdo[0].on(0x181, transmission, {0x22010108, 0x22FF0008});
    SyncNode node(table, [](Setup& setup) { setup.with({CO_KEY(0x22FF, 0, CO_OBJ____PR_), &type, 0}); });
    answer = CO_ERR_NONE;
    node.start();
    node.rx("080#");
    CHECK(node.frames().size() == (transmission == 1 ? 1 : 0));
    answer = CO_ERR_OBJ_READ;
    node.u8[0] = 0x22;
    node.rx("080#");
    node.silent();
    node.rx("181#R");
    node.silent();
    CHECK(CONodeGetErr(&node.node) == CO_ERR_OBJ_READ);
    answer = CO_ERR_NONE;
    node.rx("080#");
    node.frames();
    node.rx("181#R");
    node.tx("181#225A");
  }
}

TEST_CASE("remote TPDO: requests restart the event timer of an event-driven PDO [X7]") {
  SyncTable table = with(255);
  table.tpdo[0].event = 100;
  SyncNode node(table);
  node.start();
  node.after(60ms);
  node.rx("181#R");
  node.tx("181#111112");
  node.after(100ms);
  node.tx_at(100ms, "181#111112");
}

}  // namespace

#endif
