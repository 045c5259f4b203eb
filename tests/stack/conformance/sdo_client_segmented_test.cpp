// SPDX-License-Identifier: Apache-2.0
// SDO client: segmented transfers. [301:7.2.4.3.4, 7.2.4.3.6]
#include "support/sdo_client_fixture.hpp"

#if USE_CSDO

namespace {

using namespace test;

struct Upload {
  std::uint32_t length;
  const char* announced;  // response to the initiate with the size
  std::vector<const char*> segments;
};

// Uploads with the segments of the server: 000t nnnc.
const Upload uploads[] = {
    {5, "585#4100200505000000", {"585#0501020304050000"}},
    {7, "585#4100200507000000", {"585#0101020304050607"}},
    {8, "585#4100200508000000", {"585#0001020304050607", "585#1D08000000000000"}},
    {14, "585#410020050E000000", {"585#0001020304050607", "585#1108090A0B0C0D0E"}},
    {28,
     "585#410020051C000000",
     {"585#0001020304050607", "585#1008090A0B0C0D0E", "585#000F101112131415", "585#11161718191A1B1C"}},
};

constexpr const char* asks[] = {"605#6000000000000000", "605#7000000000000000"};

// Checks that the client requests each segment, with the toggle bit alternating from 0.
void take_segments(SdoClient& node, const std::vector<const char*>& segments) {
  std::size_t n = 0;
  for (const char* segment : segments) {
    node.tx(asks[n % 2]);
    node.goes_on();
    CHECK(node.num() == 7 * n);
    node.rx(segment);
    ++n;
  }
  node.silent();
}

TEST_CASE("SDO client: segmented upload with announced size into buffers of that size and more [301:7.2.4.3.6]") {
  for (const Upload& one : uploads) {
    for (std::uint32_t size = one.length; size <= 28; ++size) {
      CAPTURE(one.length);
      CAPTURE(size);
      SdoClient node;
      node.start_upload(0x2000, 5, size);
      node.tx("605#4000200500000000");
      node.rx(one.announced);
      CHECK(node.total() == one.length);
      take_segments(node, one.segments);
      CHECK(node.has_read(counted(one.length)).total == one.length);
    }
  }
}

TEST_CASE("SDO client: segmented upload without announced size [301:7.2.4.3.5]") {
  for (const Upload& one : uploads) {
    for (const std::uint32_t size : std::initializer_list<std::uint32_t>{one.length, 28}) {
      CAPTURE(one.length);
      CAPTURE(size);
      SdoClient node;
      node.start_upload(0x2000, 5, size);
      node.tx("605#4000200500000000");
      node.rx("585#4000200500000000");
      CHECK(node.total() == 0);
      take_segments(node, one.segments);
      node.has_read(counted(one.length));
    }
  }
}

TEST_CASE("SDO client: unused bytes of the last segment are ignored") {
  SdoClient node;
  node.start_upload(0x2000, 5, 5);
  node.tx("605#4000200500000000");
  node.rx("585#4100200505000000");
  node.tx("605#6000000000000000");
  node.rx("585#050102030405FFFF");
  node.has_read(counted(5));
}

TEST_CASE("SDO client: segmented upload of 1 to 4 bytes from servers without expedited transfer") {
  const char* const last[] = {"585#0D01000000000000", "585#0B01020000000000", "585#0901020300000000",
                              "585#0701020304000000"};
  for (std::uint32_t length = 1; length <= 4; ++length) {
    CAPTURE(length);
    SdoClient node;
    node.start_upload(0x2000, 5, 4);
    node.tx("605#4000200500000000");
    CO_IF_FRM answer = frame("585#4100200500000000");
    CO_SET_LONG(&answer, length, 4);
    node.rx(answer);
    node.tx("605#6000000000000000");
    node.rx(last[length - 1]);
    node.has_read(counted(length));
  }
}

TEST_CASE("SDO client: upload of an empty object succeeds with no bytes [D19]") {
  for (const char* answer : {"585#4100200500000000", "585#4000200500000000"}) {
    SdoClient node;
    node.start_upload(0x2000, 5, 8);
    node.tx("605#4000200500000000");
    node.rx(answer);
    node.tx("605#6000000000000000");
    node.rx("585#0F00000000000000");
    node.silent();
    CHECK(node.has_read({}).total == 0);
  }
}

TEST_CASE("SDO client: upload into an exactly filled buffer with an empty last segment succeeds") {
  SdoClient node;
  node.start_upload(0x2000, 5, 7);
  node.tx("605#4000200500000000");
  node.rx("585#4000200500000000");
  node.tx("605#6000000000000000");
  node.rx("585#0001020304050607");
  node.tx("605#7000000000000000");
  node.rx("585#1F00000000000000");
  node.has_read(counted(7));
}

TEST_CASE("SDO client: an announced size above the buffer is refused with 0504 0005h at once") {
  for (const char* answer : {"585#4100200509000000", "585#410020051C000000", "585#41002005FFFFFFFF",
                             "585#4100200500000080", "585#4100200508000100"}) {
    SdoClient node;
    node.start_upload(0x2000, 5, 8);
    node.tx("605#4000200500000000");
    node.rx(answer);
    node.tx("605#8000200505000405");
    CHECK(node.ended(CO_SDO_ERR_MEM).num == 0);
  }
}

TEST_CASE("SDO client: without an announced size a segment beyond the buffer is refused with 0504 0005h") {
  for (std::uint32_t size = 8; size < 14; ++size) {
    CAPTURE(size);
    SdoClient node;
    node.start_upload(0x2000, 5, size);
    node.tx("605#4000200500000000");
    node.rx("585#4000200500000000");
    node.tx("605#6000000000000000");
    node.rx("585#0001020304050607");
    node.tx("605#7000000000000000");
    node.rx("585#1108090A0B0C0D0E");
    node.tx("605#8000200505000405");
    CHECK(node.ended(CO_SDO_ERR_MEM).num == 7);
  }
}

TEST_CASE("SDO client: more bytes than announced are refused with 0607 0012h, even if they fit into the buffer [D5]") {
  SdoClient node;
  node.start_upload(0x2000, 5, 28);
  node.tx("605#4000200500000000");
  node.rx("585#410020050D000000");
  node.tx("605#6000000000000000");
  node.rx("585#0001020304050607");
  node.tx("605#7000000000000000");
  node.rx("585#1008090A0B0C0D0E");
  node.tx("605#8000200512000706");
  node.ended(CO_SDO_ERR_LEN_HIGH);
}

TEST_CASE("SDO client: n = 0 in the last segment means no size: it contains the rest of the announced size [D4] [D5]") {
  for (const std::uint32_t buffer : {10U, 16U}) {
    SdoClient node;
    node.start_upload(0x2000, 5, buffer);
    node.tx("605#4000200500000000");
    node.rx("585#410020050A000000");
    node.tx("605#6000000000000000");
    node.rx("585#0001020304050607");
    node.tx("605#7000000000000000");
    node.rx("585#1108090AFFFFFFFF");
    node.has_read(counted(10));
  }
}

TEST_CASE(
    "SDO client: n = 0 means 7 bytes if no rest, a longer rest or no size is announced, and in other segments [D5]") {
  SdoClient node;
  node.start_upload(0x2000, 5, 20);
  node.tx("605#4000200500000000");
  node.rx("585#4100200500000000");
  node.tx("605#6000000000000000");
  node.rx("585#0101020304050607");
  node.tx("605#8000200512000706");
  node.ended(CO_SDO_ERR_LEN_HIGH);
  node.start_upload(0x2000, 5, 20);
  node.tx("605#4000200500000000");
  node.rx("585#4100200508000000");
  node.tx("605#6000000000000000");
  node.rx("585#0101020304050607");
  node.tx("605#8000200513000706");
  node.ended(CO_SDO_ERR_LEN_SMALL);
  node.start_upload(0x2000, 5, 20);
  node.tx("605#4000200500000000");
  node.rx("585#4100200505000000");
  node.tx("605#6000000000000000");
  node.rx("585#0001020304050607");
  node.tx("605#8000200512000706");
  node.ended(CO_SDO_ERR_LEN_HIGH);
  node.start_upload(0x2000, 5, 20);
  node.tx("605#4000200500000000");
  node.rx("585#4000200500000000");
  node.tx("605#6000000000000000");
  node.rx("585#0101020304050607");
  node.has_read(counted(7));
}

TEST_CASE("SDO client: fewer bytes than announced are refused with 0607 0013h [D5]") {
  SdoClient node;
  node.start_upload(0x2000, 5, 28);
  node.tx("605#4000200500000000");
  node.rx("585#410020050F000000");
  node.tx("605#6000000000000000");
  node.rx("585#0001020304050607");
  node.tx("605#7000000000000000");
  node.rx("585#1108090A0B0C0D0E");
  node.tx("605#8000200513000706");
  node.ended(CO_SDO_ERR_LEN_SMALL);
}

TEST_CASE("SDO client: a segment with a repeated toggle bit is refused with 0503 0000h [C1]") {
  SdoClient node;
  node.start_upload(0x2000, 5, 28);
  node.tx("605#4000200500000000");
  node.rx("585#410020051C000000");
  node.tx("605#6000000000000000");
  node.rx("585#0001020304050607");
  node.tx("605#7000000000000000");
  node.rx("585#0008090A0B0C0D0E");
  node.tx("605#8000200500000305");
  node.ended(CO_SDO_ERR_TBIT);
}

struct Download {
  std::uint32_t length;
  const char* initiate;
  std::vector<const char*> segments;
};

const Download downloads[] = {
    {5, "605#2100200505000000", {"605#0501020304050000"}},
    {6, "605#2100200506000000", {"605#0301020304050600"}},
    {7, "605#2100200507000000", {"605#0101020304050607"}},
    {8, "605#2100200508000000", {"605#0001020304050607", "605#1D08000000000000"}},
    {14, "605#210020050E000000", {"605#0001020304050607", "605#1108090A0B0C0D0E"}},
    {15, "605#210020050F000000", {"605#0001020304050607", "605#1008090A0B0C0D0E", "605#0D0F000000000000"}},
    {28,
     "605#210020051C000000",
     {"605#0001020304050607", "605#1008090A0B0C0D0E", "605#000F101112131415", "605#11161718191A1B1C"}},
};

TEST_CASE("SDO client: segmented download announces the size; unused bytes of the last segment are 0 [301:7.2.4.3.4]") {
  constexpr const char* taken[] = {"585#2000000000000000", "585#3000000000000000"};
  for (const Download& one : downloads) {
    CAPTURE(one.length);
    SdoClient node;
    node.start_download(0x2000, 5, counted(one.length));
    CHECK(node.total() == one.length);
    node.tx(one.initiate);
    node.rx("585#6000200500000000");
    std::size_t n = 0;
    for (const char* segment : one.segments) {
      node.tx(segment);
      node.goes_on();
      CHECK(node.num() == 7 * n);
      node.rx(taken[n % 2]);
      ++n;
    }
    node.silent();
    const ClientEnd end = node.has_written();
    CHECK(end.num == one.length);
  }
}

TEST_CASE("SDO client: an acknowledge with the wrong toggle bit is refused with 0503 0000h [C1]") {
  SdoClient node;
  node.start_download(0x2000, 5, counted(28));
  node.tx("605#210020051C000000");
  node.rx("585#6000200500000000");
  node.tx("605#0001020304050607");
  node.rx("585#2000000000000000");
  node.tx("605#1008090A0B0C0D0E");
  node.rx("585#2000000000000000");
  node.tx("605#8000200500000305");
  CHECK(node.ended(CO_SDO_ERR_TBIT).num == 7);
}

TEST_CASE("SDO client: an abort of the server within a segmented transfer is reported for any multiplexer [C1]") {
  for (const char* abort : {"585#8000200531000906", "585#8000000031000906", "585#8011223331000906"}) {
    SdoClient node;
    node.start_download(0x2000, 5, counted(14));
    node.tx("605#210020050E000000");
    node.rx("585#6000200500000000");
    node.tx("605#0001020304050607");
    node.rx(abort);
    node.silent();
    CHECK(node.ended(CO_SDO_ERR_RANGE_HIGH).num == 0);
  }
}

TEST_CASE("SDO client: an abort by the client has the multiplexer of the object, also within a transfer [D25]") {
  SdoClient node;
  node.start_upload(0x1018, 0x04, 28);
  node.tx("605#4018100400000000");
  node.rx("585#4018100400000000");
  node.tx("605#6000000000000000");
  node.rx("585#4018100400000000");
  node.tx("605#8018100401000405");
  node.ended(CO_SDO_ERR_CMD);
}

TEST_CASE("SDO client: for a text shorter than the buffer COCSdoGetNum returns its length") {
  SdoClient node;
  node.start_upload(0x1008, 0, 28);
  node.tx("605#4008100000000000");
  node.rx("585#4108100011000000");
  node.tx("605#6000000000000000");
  node.rx("585#004C65786963616E");
  node.tx("605#7000000000000000");
  node.rx("585#102074657374206E");
  node.tx("605#6000000000000000");
  node.rx("585#096F646500000000");
  const std::string text = "Lexican test node";
  node.has_read(Bytes(text.begin(), text.end()));
  CHECK(node.num() == 17);
}

// SDO client: expedited transfers. [301:7.2.4.3.3, 7.2.4.3.5]

TEST_CASE("SDO client: expedited upload of 1 to 4 bytes [301:7.2.4.3.5]") {
  struct Case {
    const char* answer;
    Bytes data;
  };
  const Case cases[] = {{"585#4F00200511000000", {0x11}},
                        {"585#4B00200511220000", {0x11, 0x22}},
                        {"585#4700200511223300", {0x11, 0x22, 0x33}},
                        {"585#4300200511223344", {0x11, 0x22, 0x33, 0x44}}};
  for (const Case& one : cases) {
    const auto length = static_cast<std::uint32_t>(one.data.size());
    for (std::uint32_t size = length; size <= 28; ++size) {
      CAPTURE(length);
      CAPTURE(size);
      SdoClient node;
      node.start_upload(0x2000, 5, size);
      CHECK(node.num() == 0);
      CHECK(node.total() == 0);
      node.tx("605#4000200500000000");
      node.rx(one.answer);
      node.silent();
      const ClientEnd end = node.has_read(one.data);
      CHECK(end.index == 0x2000);
      CHECK(end.sub == 5);
      CHECK(end.total == length);
      CHECK(node.num() == length);
      CHECK(node.total() == length);
    }
  }
}

TEST_CASE("SDO client: unused bytes of an expedited answer are ignored") {
  SdoClient node;
  node.start_upload(0x2000, 5, 1);
  node.tx("605#4000200500000000");
  node.rx("585#4F00200511FFFFFF");
  node.has_read({0x11});
}

TEST_CASE("SDO client: an expedited answer without a size has up to 4 bytes, limited by the buffer [301:7.2.4.3.5]") {
  for (std::uint32_t size = 1; size <= 28; ++size) {
    CAPTURE(size);
    SdoClient node;
    node.start_upload(0x2000, 5, size);
    node.tx("605#4000200500000000");
    node.rx("585#4200200511223344");
    node.silent();
    Bytes expected = {0x11, 0x22, 0x33, 0x44};
    expected.resize(std::min<std::size_t>(size, 4));
    node.has_read(expected);
  }
}

TEST_CASE("SDO client: an expedited answer that is larger than the buffer is refused with 0504 0005h") {
  struct Case {
    const char* answer;
    std::uint32_t length;
  };
  const Case cases[] = {{"585#4B00200511220000", 2}, {"585#4700200511223300", 3}, {"585#4300200511223344", 4}};
  for (const Case& one : cases) {
    for (std::uint32_t size = 1; size < one.length; ++size) {
      CAPTURE(one.length);
      CAPTURE(size);
      SdoClient node;
      node.start_upload(0x2000, 5, size);
      node.tx("605#4000200500000000");
      node.rx(one.answer);
      node.tx("605#8000200505000405");
      CHECK(node.ended(CO_SDO_ERR_MEM).num == 0);
    }
  }
}

TEST_CASE("SDO client: expedited download of 1 to 4 bytes [301:7.2.4.3.3]") {
  struct Case {
    Bytes data;
    const char* request;
  };
  const Case cases[] = {{{0x11}, "605#2F00200511000000"},
                        {{0x11, 0x22}, "605#2B00200511220000"},
                        {{0x11, 0x22, 0x33}, "605#2700200511223300"},
                        {{0x11, 0x22, 0x33, 0x44}, "605#2300200511223344"}};
  for (const Case& one : cases) {
    SdoClient node;
    node.start_download(0x2000, 5, one.data);
    CHECK(node.num() == 0);
    CHECK(node.total() == one.data.size());
    node.tx(one.request);
    node.rx("585#6000200500000000");
    node.silent();
    const ClientEnd end = node.has_written();
    CHECK(end.num == one.data.size());
    CHECK(end.index == 0x2000);
    CHECK(end.sub == 5);
  }
}

TEST_CASE("SDO client: index and sub-index are sent low byte first for any flags of the key") {
  SdoClient node;
  std::uint8_t buffer[4] = {};
  const auto ignore = [](CO_CSDO*, std::uint16_t index, std::uint8_t sub, std::uint32_t) {
    CHECK(index == 0x1A02);
    CHECK(sub == 0xFE);
  };
  node.call([&] { COCSdoRequestUpload(node.csdo(), CO_KEY(0x1A02, 0xFE, CO_OBJ_D___RW), buffer, 4, ignore, 100); });
  node.tx("605#40021AFE00000000");
  node.rx("585#4F021AFE11000000");
  CHECK(buffer[0] == 0x11);
}

TEST_CASE("SDO client: an abort of the server is reported and not answered [C1]") {
  for (const bool upload : {true, false}) {
    CAPTURE(upload);
    SdoClient node;
    if (upload) {
      node.start_upload(0x2000, 5, 4);
      node.tx("605#4000200500000000");
    } else {
      node.start_download(0x2000, 5, {1});
      node.tx("605#2F00200501000000");
    }
    node.rx("585#8000200511000906");
    node.silent();
    CHECK(node.ended(CO_SDO_ERR_SUB).num == 0);
  }
}

TEST_CASE("SDO client: an abort with the code 0 is reported as a failure") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4);
  node.tx("605#4000200500000000");
  node.rx("585#8000200500000000");
  node.silent();
  REQUIRE(node.ends.size() == 1);
  CHECK(node.ends.front().code != 0);
  node.ends.clear();
}

TEST_CASE("SDO client: an abort code that is not in CiA 301 is reported unchanged") {
  SdoClient node;
  node.start_download(0x2000, 5, {1});
  node.tx("605#2F00200501000000");
  node.rx("585#80002005785634F2");
  node.ended(0xF2345678);
}

TEST_CASE("SDO client: after a failure the next request starts without its remains") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4);
  node.tx("605#4000200500000000");
  node.rx("585#8000200511000906");
  node.ended(CO_SDO_ERR_SUB);
  node.start_upload(0x2001, 0, 4);
  CHECK(node.num() == 0);
  CHECK(node.total() == 0);
  node.tx("605#4001200000000000");
  node.rx("585#4301200001020304");
  node.has_read({1, 2, 3, 4});
}

}  // namespace

#endif
