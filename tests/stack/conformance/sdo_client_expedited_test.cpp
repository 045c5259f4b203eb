// SPDX-License-Identifier: Apache-2.0
// SDO client: expedited transfers. [301:7.2.4.3.3, 7.2.4.3.5]
#include "support/sdo_client_fixture.hpp"

#if USE_CSDO

namespace {

using namespace test;

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
