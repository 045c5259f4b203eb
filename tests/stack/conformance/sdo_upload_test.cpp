// SPDX-License-Identifier: Apache-2.0
// SDO server: upload, expedited and segmented. [301:7.2.4.3.5, 7.2.4.3.6]
#include "support/fixture.hpp"

namespace {

using namespace test;

TEST_CASE("SDO upload: one to four bytes are sent expedited with unused bytes 0 [D1] [D3] [SDO 01]") {
  Fixture node;
  node.ask("601#4000100000000000", "581#4300100091010F00");
  node.ask("601#4001200000000000", "581#4F01200011000000");
  node.ask("601#4002200000000000", "581#4B02200011220000");
  node.ask("601#4003200000000000", "581#4703200011223300");
  node.ask("601#4004200000000000", "581#4304200011223344");
}

TEST_CASE("SDO upload: reserved bytes of the request are ignored [D3]") {
  Fixture node;
  node.ask("601#40042000FFFFFFFF", "581#4304200011223344");
}

TEST_CASE("SDO upload: five to eight bytes are sent in segments with announced size [D3] [D4]") {
  Fixture node;
  node.ask("601#4005200000000000", "581#4105200005000000");
  node.ask("601#6000000000000000", "581#0511223344550000");
  node.ask("601#4006200000000000", "581#4106200006000000");
  node.ask("601#6000000000000000", "581#0311223344556600");
  node.ask("601#4007200000000000", "581#4107200007000000");
  node.ask("601#6000000000000000", "581#0111223344556677");
  node.ask("601#4008200000000000", "581#4108200008000000");
  node.ask("601#6000000000000000", "581#0011223344556677");
  node.ask("601#7000000000000000", "581#1D88000000000000");
}

TEST_CASE("SDO upload: a string in segments with alternating toggle [D4] [SDO 16] [SDO 18]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.ask("601#6000000000000000", "581#004C65786963616E");
  node.ask("601#7000000000000000", "581#102074657374206E");
  node.ask("601#6000000000000000", "581#096F646500000000");
}

TEST_CASE("SDO upload: a short string is sent expedited, repeatedly with the same bytes [D3]") {
  Fixture node;
  node.ask("601#400A100000000000", "581#470A1000312E3000");
  node.ask("601#400A100000000000", "581#470A1000312E3000");
}

TEST_CASE("SDO upload: a short domain is sent expedited, repeatedly with the same bytes [D3]") {
  Fixture node;
  for (int i = 0; i < 2; ++i) {
    node.ask("601#4000210100000000", "581#4F00210101000000");
    node.ask("601#4000210200000000", "581#4B00210201020000");
    node.ask("601#4000210300000000", "581#4700210301020300");
    node.ask("601#4000210400000000", "581#4300210401020304");
  }
}

TEST_CASE("SDO upload: data that end with a full segment are complete [D4]") {
  Fixture node;
  node.ask("601#4000210700000000", "581#4100210707000000");
  node.ask("601#6000000000000000", "581#0101020304050607");
  node.ask("601#4000210E00000000", "581#4100210E0E000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#7000000000000000", "581#1108090A0B0C0D0E");
  node.ask("601#4000210F00000000", "581#4100210F0F000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  node.ask("601#6000000000000000", "581#0D0F000000000000");
}

TEST_CASE("SDO upload: an empty domain has the size 0 and one segment without data [D19]") {
  Fixture node;
  node.ask("601#4000210000000000", "581#4100210000000000");
  node.ask("601#6000000000000000", "581#0F00000000000000");
  node.ask("601#6000000000000000", "581#8000000001000405");
}

TEST_CASE("SDO upload: an empty string has the size 0 and one segment without data [D19]") {
  Fixture node(Setup().before_init([](Objects& o) {
    o.device_name.Start = reinterpret_cast<const std::uint8_t*>("");
    o.octets.Size = 0;
    o.text.Size = 0;
    o.text_memory[0] = 0;
  }));
  node.ask("601#4008100000000000", "581#4108100000000000");
  node.ask("601#6000000000000000", "581#0F00000000000000");
  node.ask("601#4010210000000000", "581#4110210000000000");
  node.ask("601#6000000000000000", "581#0F00000000000000");
  node.ask("601#4011210000000000", "581#4111210000000000");
  node.ask("601#6000000000000000", "581#0F00000000000000");
}

TEST_CASE("SDO upload: writable strings are sent with their present length") {
  Fixture node;
  node.ask("601#4010210000000000", "581#4310210074657874");
  node.ask("601#4011210000000000", "581#4111210006000000");
  node.ask("601#6000000000000000", "581#0301020304050600");
  node.ask("601#4012210000000000", "581#4112210006000000");
  node.ask("601#6000000000000000", "581#034100E400AC2000");
}

TEST_CASE("SDO upload: data of every size are sent unchanged [D4]") {
  Fixture node(Setup().with_70000());
  for (const std::uint32_t size : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 14U, 15U}) {
    CAPTURE(size);
    CHECK(node.upload(0x2100, static_cast<std::uint8_t>(size)).size() == size);
  }
  CHECK(node.upload(0x2101, 0) == node.objects.memory[889]);
  CHECK(node.upload(0x2102, 0) == node.objects.memory[70000]);
}

TEST_CASE("SDO upload: the size of 70000 bytes is announced in 32 bits [D3]") {
  Fixture node(Setup().with_70000());
  node.ask("601#4002210000000000", "581#4102210070110100");
  node.rx("601#8002210000000000");
  node.silent();
}

TEST_CASE("SDO upload: a wrong toggle bit is aborted with 0503 0000h and ends the transfer [D4] [SDO 17]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.ask("601#7000000000000000", "581#8008100000000305");
  node.ask("601#6000000000000000", "581#8000000001000405");
}

TEST_CASE("SDO upload: a repeated toggle bit is aborted with 0503 0000h [D4]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.ask("601#6000000000000000", "581#004C65786963616E");
  node.ask("601#6000000000000000", "581#8008100000000305");
}

TEST_CASE("SDO upload: an abort of the client ends the transfer without an answer [D6]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.rx("601#8008100000000405");
  node.silent();
  node.ask("601#6000000000000000", "581#8000000001000405");
}

TEST_CASE("SDO upload: an abort with another multiplexer ends the transfer [D6]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.rx("601#8034120000000405");
  node.silent();
  node.ask("601#6000000000000000", "581#8000000001000405");
}

TEST_CASE("SDO upload: an abort without a transfer is not answered [D6]") {
  Fixture node;
  node.rx("601#8008100000000405");
  node.silent();
}

TEST_CASE("SDO upload: a new initiate during a transfer starts a new one [D8]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.ask("601#6000000000000000", "581#004C65786963616E");
  node.ask("601#4000210F00000000", "581#4100210F0F000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#4000100000000000", "581#4300100091010F00");
  node.ask("601#7000000000000000", "581#8000000001000405");
}

TEST_CASE("SDO upload: a download segment is aborted [D9] [D25]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.ask("601#00AABBCC00000000", "581#8008100001000405");
  node.ask("601#6000000000000000", "581#8000000001000405");
}

TEST_CASE("SDO upload: the value at the initiate is sent") {
  Fixture node;
  node.may_change(0x2008, 0);
  node.ask("601#4008200000000000", "581#4108200008000000");
  node.objects.u64 = 0;
  node.ask("601#6000000000000000", "581#0011223344556677");
  node.ask("601#7000000000000000", "581#1D88000000000000");
}

TEST_CASE("SDO upload: time of day has six bytes, milliseconds first") {
  Fixture node;
  node.ask("601#4026200000000000", "581#4126200006000000");
  node.ask("601#6000000000000000", "581#0304030201060500");
}

TEST_CASE("SDO upload: REAL32 and REAL64 are sent little-endian") {
  Fixture node;
  node.ask("601#4024200000000000", "581#432420000000803F");
  node.ask("601#4028200000000000", "581#4128200008000000");
  node.ask("601#6000000000000000", "581#00000000000000F0");
  node.ask("601#7000000000000000", "581#1D3F000000000000");
}

TEST_CASE("SDO upload: values relative to the node-ID are sent with it added") {
  Fixture node(Setup().node_id(0x30));
  node.ask("630#4014100000000000", "5B0#43141000B0000000");
  node.ask("630#4034200000000000", "5B0#43342000B0010000");
  node.ask("630#2334200090020000", "5B0#6034200000000000");
  node.ask("630#4034200000000000", "5B0#4334200090020000");
  CHECK(static_cast<std::uintptr_t>(node.find(0x2034, 0)->Data) == 0x260);
}

}  // namespace
