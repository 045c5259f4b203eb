// SPDX-License-Identifier: Apache-2.0
// SDO client: block download. [301:7.2.4.3.9-11]
#include "support/sdo_client_fixture.hpp"
#include "support/sdo_client_peer.hpp"

#if USE_CSDO && CO_CSDO_BLOCK > 0

namespace {

using namespace test;

// Segments of 40 bytes in one sub-block.
constexpr const char* whole[] = {"605#0101020304050607", "605#0208090A0B0C0D0E", "605#030F101112131415",
                                 "605#04161718191A1B1C", "605#051D1E1F20212223", "605#8624252627280000"};

void send_all(SdoClient& node) { node.tx({whole[0], whole[1], whole[2], whole[3], whole[4], whole[5]}); }

// Starts a block download of 40 bytes; \a answer is the server's response to the initiate.
void start(SdoClient& node, std::string_view answer) {
  node.start_download(0x2000, 5, counted(40));
  node.tx("605#C600200528000000");
  node.rx(answer);
}

TEST_CASE("SDO client: block download of 40 bytes with CRC [301:7.2.4.3.9-11] [D11] [D14]") {
  SdoClient node;
  node.start_download(0x2000, 5, counted(40));
  CHECK(node.total() == 40);
  node.tx("605#C600200528000000");
  node.rx("585#A40020057F000000");
  send_all(node);
  CHECK(node.num() == 0);
  node.rx("585#A2067F0000000000");
  CHECK(node.num() == 40);
  node.tx("605#C9C38B0000000000");
  node.goes_on();
  node.rx("585#A100000000000000");
  node.silent();
  CHECK(node.has_written().num == 40);
}

TEST_CASE("SDO client: the CRC field is 0 for a server without CRC [D14]") {
  SdoClient node;
  start(node, "585#A00020057F000000");
  send_all(node);
  node.rx("585#A2067F0000000000");
  node.tx("605#C900000000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: block download with a blksize of 1") {
  constexpr const char* single[] = {"605#0101020304050607", "605#0108090A0B0C0D0E", "605#010F101112131415",
                                    "605#01161718191A1B1C", "605#011D1E1F20212223", "605#8124252627280000"};
  SdoClient node;
  start(node, "585#A400200501000000");
  unsigned n = 0;
  for (const char* segment : single) {
    node.tx(segment);
    CHECK(node.num() == 7 * n++);
    node.rx("585#A201010000000000");
  }
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: block download with a blksize of 2") {
  SdoClient node;
  start(node, "585#A400200502000000");
  node.tx({"605#0101020304050607", "605#0208090A0B0C0D0E"});
  node.rx("585#A202020000000000");
  CHECK(node.num() == 14);
  node.tx({"605#010F101112131415", "605#02161718191A1B1C"});
  node.rx("585#A202020000000000");
  node.tx({"605#011D1E1F20212223", "605#8224252627280000"});
  CHECK(node.num() == 28);
  node.rx("585#A202020000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: the blksize of each acknowledge applies to the next sub-block [301:7.2.4.3.10]") {
  SdoClient node;
  start(node, "585#A400200501000000");
  node.tx("605#0101020304050607");
  node.rx("585#A201030000000000");
  node.tx({"605#0108090A0B0C0D0E", "605#020F101112131415", "605#03161718191A1B1C"});
  node.rx("585#A203010000000000");
  node.tx("605#011D1E1F20212223");
  node.rx("585#A2017F0000000000");
  node.tx("605#8124252627280000");
  node.rx("585#A201010000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: unacknowledged segments are repeated with the new blksize [D11]") {
  SdoClient node;
  start(node, "585#A40020057F000000");
  send_all(node);
  node.rx("585#A202030000000000");
  CHECK(node.num() == 14);
  node.tx({"605#010F101112131415", "605#02161718191A1B1C", "605#031D1E1F20212223"});
  node.rx("585#A2017F0000000000");
  CHECK(node.num() == 21);
  node.tx({"605#01161718191A1B1C", "605#021D1E1F20212223", "605#8324252627280000"});
  node.rx("585#A2037F0000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: an acknowledge of no segment repeats the whole sub-block") {
  SdoClient node;
  start(node, "585#A400200504000000");
  node.tx({whole[0], whole[1], whole[2], whole[3]});
  node.rx("585#A2007F0000000000");
  CHECK(node.num() == 0);
  send_all(node);
  node.rx("585#A200010000000000");
  node.tx(whole[0]);
  node.rx("585#A2017F0000000000");
  CHECK(node.num() == 7);
  node.tx({"605#0108090A0B0C0D0E", "605#020F101112131415", "605#03161718191A1B1C", "605#041D1E1F20212223",
           "605#8524252627280000"});
  node.rx("585#A2057F0000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: an unacknowledged last segment alone is repeated") {
  SdoClient node;
  start(node, "585#A40020057F000000");
  send_all(node);
  node.rx("585#A2057F0000000000");
  CHECK(node.num() == 35);
  node.tx("605#8124252627280000");
  node.rx("585#A2017F0000000000");
  node.tx("605#C9C38B0000000000");
  node.rx("585#A100000000000000");
  node.has_written();
}

TEST_CASE("SDO client: an acknowledge of more segments than were sent is refused with 0504 0003h") {
  for (const char* acknowledge :
       {"585#A205040000000000", "585#A27F040000000000", "585#A280040000000000", "585#A2FF040000000000"}) {
    SdoClient node;
    start(node, "585#A400200504000000");
    node.tx({whole[0], whole[1], whole[2], whole[3]});
    node.rx(acknowledge);
    node.tx("605#8000200503000405");
    CHECK(node.ended(CO_SDO_ERR_SEQ_NUM).num == 0);
  }
}

TEST_CASE("SDO client: an acknowledge of more than the last sub-block had is refused with 0504 0003h") {
  SdoClient node;
  start(node, "585#A40020057F000000");
  send_all(node);
  node.rx("585#A2077F0000000000");
  node.tx("605#8000200503000405");
  node.ended(CO_SDO_ERR_SEQ_NUM);
}

TEST_CASE("SDO client: a blksize of 0 or above 127 is refused with 0504 0002h") {
  for (const char* answer :
       {"585#A400200500000000", "585#A400200580000000", "585#A4002005FF000000", "585#A000200500000000"}) {
    SdoClient node;
    start(node, answer);
    node.tx("605#8000200502000405");
    node.ended(CO_SDO_ERR_BLK_SIZE);
  }
  for (const char* acknowledge : {"585#A204000000000000", "585#A204800000000000", "585#A200FF0000000000"}) {
    SdoClient node;
    start(node, "585#A400200504000000");
    node.tx({whole[0], whole[1], whole[2], whole[3]});
    node.rx(acknowledge);
    node.tx("605#8000200502000405");
    node.ended(CO_SDO_ERR_BLK_SIZE);
  }
}

TEST_CASE(
    "SDO client: block downloads of 29 to 36 bytes: unused bytes of the last segment are announced [301:7.2.4.3.11]") {
  struct Case {
    std::uint32_t length;
    const char* initiate;
    const char* last;
    const char* end;
  };
  const Case cases[] = {{29, "605#C60020051D000000", "605#851D000000000000", "605#D9111F0000000000"},
                        {30, "605#C60020051E000000", "605#851D1E0000000000", "605#D521010000000000"},
                        {31, "605#C60020051F000000", "605#851D1E1F00000000", "605#D1FFD20000000000"},
                        {32, "605#C600200520000000", "605#851D1E1F20000000", "605#CD5D300000000000"},
                        {33, "605#C600200521000000", "605#851D1E1F20210000", "605#C9105F0000000000"},
                        {34, "605#C600200522000000", "605#851D1E1F20212200", "605#C53ABF0000000000"},
                        {35, "605#C600200523000000", "605#851D1E1F20212223", "605#C135780000000000"}};
  for (const Case& one : cases) {
    CAPTURE(one.length);
    SdoClient node;
    node.start_download(0x2000, 5, counted(one.length));
    node.tx(one.initiate);
    node.rx("585#A40020057F000000");
    node.tx({whole[0], whole[1], whole[2], whole[3], one.last});
    node.rx("585#A2057F0000000000");
    CHECK(node.num() == one.length);
    node.tx(one.end);
    node.rx("585#A100000000000000");
    CHECK(node.has_written().num == one.length);
  }
}

TEST_CASE("SDO client: 889 bytes fill a sub-block of 127 segments, 890 need another") {
  for (const std::uint32_t length : {889U, 890U}) {
    CAPTURE(length);
    SdoClient node;
    node.start_download(0x2000, 5, counted(length));
    node.tx(length == 889 ? "605#C600200579030000" : "605#C60020057A030000");
    node.rx("585#A40020057F000000");
    const std::vector<std::string> sent = node.frames();
    REQUIRE(sent.size() == 127);
    CHECK(sent.front() == "605#0101020304050607");
    CHECK(sent.back() == (length == 889 ? "605#FF73747576777879" : "605#7F73747576777879"));
    node.rx("585#A27F7F0000000000");
    CHECK(node.num() == 889);
    if (length == 890) {
      node.tx("605#817A000000000000");
      node.rx("585#A2017F0000000000");
    }
    node.tx(length == 889 ? "605#C1FCFD0000000000" : "605#D96F1D0000000000");
    node.rx("585#A100000000000000");
    node.has_written();
  }
}

TEST_CASE("SDO client: an abort of the server in a block download is reported and not answered [C1]") {
  SdoClient one;
  start(one, "585#A400200504000000");
  one.frames();
  one.rx("585#8000200512000706");
  one.silent();
  CHECK(one.ended(CO_SDO_ERR_LEN_HIGH).num == 0);
  SdoClient two;
  start(two, "585#A40020057F000000");
  two.frames();
  two.rx("585#A2067F0000000000");
  two.frames();
  two.rx("585#8000000004000405");
  two.silent();
  two.ended(CO_SDO_ERR_CRC);
}

// A server that waits for the end message repeats its last acknowledge.
TEST_CASE("SDO client: an acknowledge after the end is ignored and does not restart the time-out [D11] [D18]") {
  SdoClient node;
  start(node, "585#A40020057F000000");
  send_all(node);
  node.rx("585#A2067F0000000000");
  node.tx("605#C9C38B0000000000");
  node.after(999ms);
  node.rx("585#A2067F0000000000");
  node.silent();
  node.goes_on();
  SUBCASE("the server confirms") {
    node.rx("585#A100000000000000");
    node.silent();
    CHECK(node.has_written().num == 40);
  }
  SUBCASE("the server is silent") {
    node.after(1ms);
    node.tx("605#8000200500000405");
    node.ended(CO_SDO_ERR_TIMEOUT);
  }
}

TEST_CASE("SDO client: repeated responses to the initiate do not restart the time-out [D18]") {
  SdoClient node;
  start(node, "585#A40020057F000000");
  send_all(node);
  node.after(600ms);
  node.rx("585#A40020057F000000");
  node.after(399ms);
  node.silent();
  node.goes_on();
  node.after(1ms);
  node.tx("605#8000200500000405");
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: block downloads of sizes around the limits are complete for every blksize") {
  const std::vector<std::uint8_t> sizes[] = {{127}, {1}, {2}, {1, 2, 127}, {126, 127, 3}};
  for (const std::vector<std::uint8_t>& block_sizes : sizes) {
    for (const std::size_t length : {29U, 35U, 36U, 888U, 889U, 890U, 891U, 1778U, 1779U}) {
      CAPTURE(length);
      CAPTURE(unsigned{block_sizes[0]});
      SdoClient node;
      PeerOptions options;
      options.block_sizes = block_sizes;
      options.crc = length % 2 == 0;
      SdoPeer peer({}, options);
      node.start_download(0x2000, 5, counted(length, 3));
      CHECK(serve(node, peer));
      CHECK(peer.fault == "");
      CHECK(peer.is_done);
      CHECK(peer.object == counted(length, 3));
      node.has_written();
    }
  }
}

TEST_CASE("SDO client: block downloads of 70000 bytes and of 1 MiB are complete") {
  for (const std::size_t length : {std::size_t{70000}, std::size_t{mebibyte / stride(16)}}) {
    SdoClient node;
    SdoPeer peer({});
    node.start_download(0x2000, 5, counted(length, 9));
    CHECK(serve(node, peer));
    CHECK(peer.fault == "");
    CHECK(peer.is_done);
    CHECK((peer.object == counted(length, 9)));
    node.has_written();
  }
}

}  // namespace

#endif
