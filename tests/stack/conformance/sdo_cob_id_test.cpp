// SPDX-License-Identifier: Apache-2.0
// Invalid COB-IDs of SDO servers, in the dictionary or written by the network. [301:7.5.2.33, 7.3.5]
#include "support/fixture.hpp"

namespace {

using namespace test;

TEST_CASE("SDO COB-ID: 1200h with the CAN-ID 000h switches the default server off, and nothing is sent at 000h") {
  for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
    CAPTURE(sub);
    Fixture node(Setup().with({CO_KEY(0x1200, sub, CO_OBJ_D___R_), CO_TSDO_ID, 0}));
    node.rx("601#4000100000000000");
    node.rx("000#4000100000000000");
    node.silent();
    CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x701});
    node.rx("000#0101");
    CHECK(node.mode() == CO_OPERATIONAL);
  }
}

TEST_CASE("SDO COB-ID: 1200h that is 000h with the node-ID added switches the default server off") {
  Fixture node(Setup().with({CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, 0x7FF}));
  node.rx("601#4000100000000000");
  node.silent();
}

#if CO_SSDO_N >= 2

void check_default_serves(Fixture& node) { node.ask("601#4000100000000000", "581#4300100091010F00"); }

Setup second_server(std::uint32_t rx, std::uint32_t tx) {
  return Setup().before_init([=](Objects& o) {
    o.sdo2_rx = rx;
    o.sdo2_tx = tx;
  });
}

void check_second_off(Fixture& node) {
  node.rx("690#4000100000000000");
  node.rx("000#4000100000000000");
  node.rx("00000000#4000100000000000");
  node.silent();
  CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x601, 0x701});
  check_default_serves(node);
}

TEST_CASE("SDO COB-ID: 1201h with the CAN-ID 000h in the table is off, and nothing is sent at 000h") {
  struct Case {
    std::uint32_t rx;
    std::uint32_t tx;
  };
  const Case cases[] = {{0x690, 0},          {0, 0x6A0},          {0, 0},         {0x690, 0x20000000},
                        {0x20000000, 0x6A0}, {0x690, 0x40000000}, {0x40000000, 0}};
  for (const Case& one : cases) {
    CAPTURE(one.rx);
    CAPTURE(one.tx);
    Fixture node(second_server(one.rx, one.tx));
    check_second_off(node);
    node.rx("000#8201");
    node.tx("701#00");
    check_second_off(node);
  }
}

TEST_CASE("SDO COB-ID: 1201h stays off while one CAN-ID is 000h, for any value of the other") {
  Fixture node(second_server(0x80000000, 0));
  node.ask("601#2301120190060000", "581#6001120100000000");
  check_second_off(node);
  node.ask("601#2301120200000000", "581#6001120200000000");
  check_second_off(node);
  node.ask("601#2301120200000080", "581#6001120200000000");
  node.ask("601#2301120200000000", "581#8001120230000906");
  check_second_off(node);
  node.ask("601#23011202A0060000", "581#6001120200000000");
  node.ask("690#4000100000000000", "6A0#4300100091010F00");
}

TEST_CASE("SDO COB-ID: the application cannot set 1201h to 000h either") {
  Fixture node(second_server(0x690, 0x80000000));
  node.call([&] { CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1201, 2), 0) == CO_ERR_OBJ_RANGE); });
  check_second_off(node);
  CHECK(node.objects.sdo2_tx == 0x80000000);
}

#endif

#if CO_SSDO_N >= 3

TEST_CASE("SDO COB-ID: a CAN-ID above 7FFh without bit 29 in the table disables its own channel only") {
  struct Case {
    std::uint32_t rx;
    std::uint32_t tx;
  };
  const Case cases[] = {{0x1690, 0x16A0}, {0x1690, 0x6A0},          {0x690, 0x16A0},
                        {0x0800, 0x0800}, {0x1FFFFFFF, 0x1FFFFFFF}, {0x1600, 0x1580}};
  for (const Case& one : cases) {
    CAPTURE(one.rx);
    CAPTURE(one.tx);
    Fixture node(Setup().before_init([=](Objects& o) {
      o.sdo2_rx = one.rx;
      o.sdo2_tx = one.tx;
      o.sdo3_rx = 0x691;
      o.sdo3_tx = 0x6A1;
    }));
    for (const char* request : {"690#4000100000000000", "00001690#4000100000000000", "00000800#4000100000000000",
                                "1FFFFFFF#4000100000000000", "00001600#4000100000000000", "600#4000100000000000"}) {
      node.rx(request);
    }
    node.silent();
    CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x601, 0x691, 0x701});
    check_default_serves(node);
    node.ask("691#4000100000000000", "6A1#4300100091010F00");
    node.rx("000#0101");
    CHECK(node.mode() == CO_OPERATIONAL);
  }
}

#endif

}  // namespace
