// SPDX-License-Identifier: Apache-2.0
// SDO server: block upload. [301:7.2.4.3.12, 7.2.4.3.13, 7.2.4.3.14, 7.2.4.3.15]
#include "support/block_frames.hpp"

#if USE_SDO_BLOCK

namespace {

using namespace test;

TEST_CASE("SDO block upload: four bytes without CRC [D12] [SDO 19]") {
  Fixture node;
  node.ask("601#A000100014000000", "581#C600100004000000");
  node.ask("601#A300000000000000", "581#8191010F00000000");
  node.ask("601#A201140000000000", "581#CD00000000000000");
  node.rx("601#A100000000000000");
  node.silent();
}

TEST_CASE("SDO block upload: four bytes with CRC, low byte first [D12] [D14]") {
  Fixture node;
  node.ask("601#A40010007F000000", "581#C600100004000000");
  node.ask("601#A300000000000000", "581#8191010F00000000");
  node.ask("601#A2017F0000000000", "581#CD25970000000000");
  node.rx("601#A100000000000000");
  node.silent();
}

TEST_CASE("SDO block upload: a string without and with CRC [D12] [D14] [SDO 22] [SDO 23]") {
  Fixture node;
  for (const bool crc : {false, true}) {
    CAPTURE(crc);
    node.ask(crc ? "601#A408100014000000" : "601#A008100014000000", "581#C608100011000000");
    node.rx("601#A300000000000000");
    node.tx({"581#014C65786963616E", "581#022074657374206E", "581#836F646500000000"});
    node.ask("601#A203140000000000", crc ? "581#D1C9780000000000" : "581#D100000000000000");
    node.rx("601#A100000000000000");
    node.silent();
  }
}

TEST_CASE("SDO block upload: reserved bytes are ignored [D12]") {
  Fixture node;
  node.ask("601#A40010007F00FFFF", "581#C600100004000000");
  node.ask("601#A3FFFFFFFFFFFFFF", "581#8191010F00000000");
  node.ask("601#A2017FFFFFFFFFFF", "581#CD25970000000000");
  node.rx("601#A1FFFFFFFFFFFFFF");
  node.silent();
}

TEST_CASE("SDO block upload: the server is idle after the end [D12]") {
  Fixture node;
  node.ask("601#A40010007F000000", "581#C600100004000000");
  node.ask("601#A300000000000000", "581#8191010F00000000");
  node.ask("601#A2017F0000000000", "581#CD25970000000000");
  node.rx("601#A100000000000000");
  node.ask("601#A112345600000000", "581#8012345601000405");
  node.after(2 * node.sdo_time_out());
  node.silent();
}

// Blocks --------------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block upload: no block is longer than the client allows [D12]") {
  Fixture node;
  node.ask("601#A400210F02000000", "581#C600210F0F000000");
  node.rx("601#A300000000000000");
  node.tx({"581#0101020304050607", "581#0208090A0B0C0D0E"});
  node.ask("601#A202020000000000", "581#810F000000000000");
  node.ask("601#A201020000000000", "581#D93D510000000000");
  node.rx("601#A100000000000000");
  node.silent();
}

TEST_CASE("SDO block upload: each acknowledge may change the blksize [D12]") {
  Fixture node;
  const Bytes data = counting(890);
  node.ask("601#A404210001000000", "581#C60421007A030000");
  node.rx("601#A300000000000000");
  const Bytes blksizes{1, 3, 100, 2, 1, 20, 127};
  std::size_t place = 0;
  for (std::size_t n = 0; n + 1 < blksizes.size(); ++n) {
    expect_segments(node, data, place, blksizes[n]);
    node.rx(CO_IF_FRM{0x601, {0xA2, blksizes[n], blksizes[n + 1]}, 8});
    place += blksizes[n];
  }
  expect_segments(node, data, place, 1);
  node.rx("601#A2017F0000000000");
  node.tx(notation(block_end(0x581, data)));
  node.rx("601#A100000000000000");
  node.silent();
}

// A client that waits for the end message repeats its last acknowledge.
TEST_CASE("SDO block upload: an acknowledge after the end is ignored and does not restart the time-out [D11] [D18]") {
  Fixture node;
  node.ask("601#A400210F02000000", "581#C600210F0F000000");
  node.rx("601#A300000000000000");
  node.tx({"581#0101020304050607", "581#0208090A0B0C0D0E"});
  node.ask("601#A202020000000000", "581#810F000000000000");
  node.ask("601#A201020000000000", "581#D93D510000000000");
  node.after(node.sdo_time_out() / 2);
  node.rx("601#A201020000000000");
  node.silent();
  SUBCASE("the client confirms") {
    node.rx("601#A100000000000000");
    node.silent();
    node.rx("601#A100000000000000");
    node.tx("581#8000000001000405");
  }
  SUBCASE("the client is silent") {
    node.after(node.sdo_time_out() / 2);
    node.tx("581#8000210F00000405");
  }
}

TEST_CASE("SDO block upload: a blksize of 1 works [D12]") {
  Fixture node;
  node.ask("601#A400210F01000000", "581#C600210F0F000000");
  node.ask("601#A300000000000000", "581#0101020304050607");
  node.ask("601#A201010000000000", "581#0108090A0B0C0D0E");
  node.ask("601#A201010000000000", "581#810F000000000000");
  node.ask("601#A201010000000000", "581#D93D510000000000");
  node.rx("601#A100000000000000");
}

TEST_CASE("SDO block upload: a last block of blksize segments works [D12]") {
  Fixture node;
  const Bytes data = counting(889);
  node.ask("601#A40121007F000000", "581#C601210079030000");
  node.rx("601#A300000000000000");
  expect_segments(node, data, 0, 127);
  node.rx("601#A27F7F0000000000");
  node.tx(notation(block_end(0x581, data)));
  node.rx("601#A100000000000000");
  node.ask("601#A400210E02000000", "581#C600210E0E000000");
  node.rx("601#A300000000000000");
  node.tx({"581#0101020304050607", "581#8208090A0B0C0D0E"});
  node.ask("601#A202020000000000", "581#C1929B0000000000");
  node.rx("601#A100000000000000");
}

TEST_CASE("SDO block upload: an empty object is one segment without data [D19]") {
  Fixture node(Setup().before_init([](Objects& o) { o.text.Size = 0; }));
  for (const std::string object : {"002100", "102100"}) {
    node.ask("601#A4" + object + "7F000000", "581#C6" + object + "00000000");
    node.ask("601#A300000000000000", "581#8100000000000000");
    node.ask("601#A2017F0000000000", "581#DD00000000000000");
    node.rx("601#A100000000000000");
    node.silent();
  }
}

// Objects -------------------------------------------------------------------------------------------------------------

TEST_CASE("SDO block upload: numbers of one to eight bytes, lowest byte first") {
  Fixture node(Setup().only_small());
  const Bytes all{0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88};
  for (unsigned width = 1; width <= 8; ++width) {
    CAPTURE(width);
    const BlockResult result = node.block_upload(static_cast<std::uint16_t>(0x2000 + width), 0);
    CHECK(result.abort == 0);
    CHECK(result.data == Bytes(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(width)));
  }
}

TEST_CASE("SDO block upload: objects of every basic type are read and flag N adds the node-ID") {
  Fixture node(Setup().only_small().node_id(1));
  CHECK(node.block_upload(0x2024, 0).data == Bytes{0, 0, 0x80, 0x3F});
  CHECK(node.block_upload(0x2028, 0).data == Bytes{0, 0, 0, 0, 0, 0, 0xF0, 0x3F});
  CHECK(node.block_upload(0x2026, 0).data == Bytes{0x04, 0x03, 0x02, 0x01, 0x06, 0x05});
  CHECK(node.block_upload(0x2034, 0).data == Bytes{0x81, 0x01, 0, 0});
  CHECK(node.block_upload(0x100A, 0).data == Bytes{'1', '.', '0'});
  CHECK(node.block_upload(0x2110, 0).data == Bytes{'t', 'e', 'x', 't'});
  CHECK(node.block_upload(0x2111, 0).data == counting(6));
  CHECK(node.block_upload(0x2112, 0).data == Bytes{0x41, 0x00, 0xE4, 0x00, 0xAC, 0x20});
}

TEST_CASE("SDO block upload: the value at the initiate is sent") {
  Fixture node;
  node.may_change(0x2008, 0);
  node.ask("601#A40820007F000000", "581#C608200008000000");
  node.call([&] { node.objects.u64 = 0; });
  node.rx("601#A300000000000000");
  node.tx({"581#0111223344556677", "581#8288000000000000"});
  node.call([&] { node.objects.u64 = 1; });
  node.ask("601#A2017F0000000000", "581#8188000000000000");
  node.ask("601#A2017F0000000000", "581#D98B6C0000000000");
  node.rx("601#A100000000000000");
}

TEST_CASE("SDO block upload: data of every size are sent unchanged for every blksize [D12]") {
  Fixture node(Setup().with_70000());
  for (const std::uint32_t size : {0U, 1U, 4U, 7U, 8U, 14U, 15U, 888U, 889U, 890U, 70000U}) {
    for (const std::vector<std::uint8_t>& blksizes : {Bytes{127}, Bytes{1}, Bytes{2, 126}, Bytes{64, 1, 127}}) {
      for (const bool crc : {false, true}) {
        if (size > 1000 && stride(2) > 1 && !(crc && blksizes.size() == 3)) continue;
        CAPTURE(size);
        CAPTURE(blksizes.size());
        BlockOptions options;
        options.blksizes = blksizes;
        options.crc = crc;
        const BlockResult result = node.block_upload(domain_of(size).index, domain_of(size).sub, options);
        CHECK(result.abort == 0);
        CHECK(result.data == counting(size));
      }
    }
  }
}

TEST_CASE("SDO block upload: one mebibyte is sent [D12]") {
  Fixture node(Setup().only_small().with_mebibyte());
  node.objects.domain[mebibyte].Size = mebibyte / stride(16);
  const BlockResult result = node.block_upload(0x2105, 0);
  CHECK(result.abort == 0);
  CHECK(result.data == counting(mebibyte / stride(16)));
}

TEST_CASE("SDO block upload: every length of the last segment works after every number of segments [D12]") {
  Fixture node;
  for (std::uint32_t size = 1; size <= 890; size += stride(37)) {
    CAPTURE(size);
    node.objects.domain[890].Size = size;
    const BlockResult result = node.block_upload(0x2104, 0);
    CHECK(result.abort == 0);
    CHECK(result.data == counting(size));
  }
}

TEST_CASE("SDO block upload: an access of the application does not move the position") {
  Fixture node;
  const Bytes data = counting(890);
  const auto read = [&] {
    std::uint32_t first = 0;
    CHECK(CODictRdLong(&node->Dict, CO_DEV(0x2104, 0), &first) == CO_ERR_NONE);
  };
  node.ask("601#A40421007F000000", "581#C60421007A030000");
  node.call(read);
  node.rx("601#A300000000000000");
  expect_segments(node, data, 0, 127);
  node.call(read);
  node.rx("601#A27F7F0000000000");
  expect_segments(node, data, 127, 1);
  node.call(read);
  node.rx("601#A2017F0000000000");
  node.tx(notation(block_end(0x581, data)));
  node.rx("601#A100000000000000");
}

// Protocol switch -----------------------------------------------------------------------------------------------------

TEST_CASE("SDO block upload: up to the pst of the client the answer is a normal upload [D13]") {
  Fixture node;
  node.ask("601#A400100014040000", "581#4300100091010F00");
  node.ask("601#A0022000140F0000", "581#4B02200011220000");
  node.ask("601#A4012000141C0000", "581#4F01200011000000");
  node.ask("601#A408200014080000", "581#4108200008000000");
  node.ask("601#6000000000000000", "581#0011223344556677");
  node.ask("601#7000000000000000", "581#1D88000000000000");
  node.ask("601#A400210F14FF0000", "581#4100210F0F000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  node.ask("601#6000000000000000", "581#0D0F000000000000");
}

TEST_CASE("SDO block upload: above the pst of the client it stays a block upload [D13]") {
  Fixture node;
  node.ask("601#A400100014030000", "581#C600100004000000");
  node.ask("601#A408200014070000", "581#C608200008000000");
  node.ask("601#A400210F140E0000", "581#C600210F0F000000");
  node.ask("601#A401210014FF0000", "581#C601210079030000");
}

TEST_CASE("SDO block upload: without a pst even one byte is sent in a block [D13]") {
  Fixture node;
  node.ask("601#A401200014000000", "581#C601200001000000");
  node.ask("601#A300000000000000", "581#8111000000000000");
  node.ask("601#A201140000000000", "581#D910020000000000");
  node.rx("601#A100000000000000");
}

TEST_CASE("SDO block upload: pst and sizes are compared in every combination [D13]") {
  Fixture node;
  for (const std::uint32_t size : {0U, 1U, 4U, 5U, 7U, 8U, 14U, 15U, 888U}) {
    for (const unsigned pst : {0U, 1U, 4U, 5U, 7U, 8U, 13U, 14U, 15U, 255U}) {
      CAPTURE(size);
      CAPTURE(pst);
      BlockOptions options;
      options.pst = static_cast<std::uint8_t>(pst);
      const BlockResult result = node.block_upload(domain_of(size).index, domain_of(size).sub, options);
      CHECK(result.abort == 0);
      CHECK(result.data == counting(size));
    }
  }
}

TEST_CASE("SDO block upload: the checks of the initiate have their order and abort codes [SDO 04] [SDO 05] [SDO 06]") {
  Fixture node;
  for (const std::string command : {"A0", "A4"}) {
    for (const std::string sizes : {"7F000000", "7FFF0000"}) {
      node.ask("601#" + command + "041000" + sizes, "581#8004100000000206");
      node.ask("601#" + command + "001001" + sizes, "581#8000100111000906");
      node.ask("601#" + command + "0110FF" + sizes, "581#800110FF11000906");
      node.ask("601#" + command + "302000" + sizes, "581#8030200001000106");
      node.ask("601#" + command + "322000" + sizes, "581#8032200000000106");
      node.ask("601#A3DEADBE00000000", "581#80DEADBE01000405");
    }
  }
}

}  // namespace

#endif
