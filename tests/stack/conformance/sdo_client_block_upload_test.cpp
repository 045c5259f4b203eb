// SPDX-License-Identifier: Apache-2.0
// SDO client: block upload. [301:7.2.4.3.13-15]
#include "support/sdo_client_fixture.hpp"
#include "support/sdo_client_peer.hpp"

#if USE_CSDO && CO_CSDO_BLOCK > 0

namespace {

using namespace test;

// Starts a block upload; \a answer is the server's response to the initiate.
void start(SdoClient& node, std::uint32_t size, std::string_view answer) {
  node.start_upload(0x2000, 5, size);
  node.tx("605#A40020057F1C0000");
  node.rx(answer);
  node.tx("605#A300000000000000");
}

// Sends segments 1…number with the bytes 1, 2, 3, …, and checks that the client does not answer.
void send_segments(SdoClient& node, unsigned number) {
  for (unsigned n = 1; n <= number; ++n) {
    CO_IF_FRM frm = frame("585#0000000000000000");
    const Bytes data = counted(7, 7 * (n - 1) + 1);
    frm.Data[0] = static_cast<std::uint8_t>(n);
    std::copy(data.begin(), data.end(), frm.Data + 1);
    node.rx(frm);
    node.silent();
  }
}

TEST_CASE("SDO client: block upload of 40 bytes with CRC and size [301:7.2.4.3.13-15] [D12] [D14]") {
  SdoClient node;
  node.start_upload(0x2000, 5, 40);
  node.tx("605#A40020057F1C0000");
  CHECK(node.total() == 0);
  node.rx("585#C600200528000000");
  CHECK(node.total() == 40);
  node.tx("605#A300000000000000");
  node.rx("585#0101020304050607");
  node.rx("585#0208090A0B0C0D0E");
  node.rx("585#030F101112131415");
  node.rx("585#04161718191A1B1C");
  node.rx("585#051D1E1F20212223");
  node.silent();
  CHECK(node.num() == 0);
  node.rx("585#8624252627280000");
  node.tx("605#A2067F0000000000");
  node.goes_on();
  node.rx("585#C9C38B0000000000");
  node.tx("605#A100000000000000");
  CHECK(node.has_read(counted(40)).total == 40);
  CHECK(node.num() == 40);
}

TEST_CASE("SDO client: the CRC of \"123456789\" is 31C3h, low byte first [D14]") {
  SdoClient node;
  start(node, 29, "585#C600200509000000");
  node.rx("585#0131323334353637");
  node.rx("585#8238390000000000");
  node.tx("605#A2027F0000000000");
  node.rx("585#D5C3310000000000");
  node.tx("605#A100000000000000");
  const std::string digits = "123456789";
  node.has_read(Bytes(digits.begin(), digits.end()));
}

TEST_CASE(
    "SDO client: a server need not support CRC nor indicate the size and its CRC field is then ignored [D12] [D14]") {
  struct Case {
    const char* answer;
    const char* end_request;
    std::uint32_t total;
  };
  const Case cases[] = {
      {"585#C600200515000000", "585#C1F0CD0000000000", 21}, {"585#C400200500000000", "585#C1F0CD0000000000", 0},
      {"585#C200200515000000", "585#C100000000000000", 21}, {"585#C200200515000000", "585#C1FFFF0000000000", 21},
      {"585#C000200500000000", "585#C100000000000000", 0},  {"585#C0002005FFFFFFFF", "585#C112340000000000", 0}};
  for (const Case& one : cases) {
    CAPTURE(std::string(one.answer));
    SdoClient node;
    start(node, 100, one.answer);
    CHECK(node.total() == one.total);
    send_segments(node, 2);
    node.rx("585#830F101112131415");
    node.tx("605#A2037F0000000000");
    node.rx(one.end_request);
    node.tx("605#A100000000000000");
    node.has_read(counted(21));
  }
}

TEST_CASE("SDO client: block uploads with 0 to 6 unused bytes fit buffers of exactly their size [301:7.2.4.3.15]") {
  struct Case {
    std::uint32_t length;
    const char* answer_with_size;
    const char* last_segment;
    const char* end_request;
  };
  const Case cases[] = {{29, "585#C60020051D000000", "585#851DAAAAAAAAAAAA", "585#D9111F0000000000"},
                        {30, "585#C60020051E000000", "585#851D1EAAAAAAAAAA", "585#D521010000000000"},
                        {31, "585#C60020051F000000", "585#851D1E1FAAAAAAAA", "585#D1FFD20000000000"},
                        {32, "585#C600200520000000", "585#851D1E1F20AAAAAA", "585#CD5D300000000000"},
                        {33, "585#C600200521000000", "585#851D1E1F2021AAAA", "585#C9105F0000000000"},
                        {34, "585#C600200522000000", "585#851D1E1F202122AA", "585#C53ABF0000000000"},
                        {35, "585#C600200523000000", "585#851D1E1F20212223", "585#C135780000000000"}};
  for (const Case& one : cases) {
    for (const bool announced : {true, false}) {
      CAPTURE(one.length);
      CAPTURE(announced);
      SdoClient node;
      start(node, one.length, announced ? one.answer_with_size : "585#C400200500000000");
      send_segments(node, 4);
      node.rx(one.last_segment);
      node.tx("605#A2057F0000000000");
      node.rx(one.end_request);
      node.tx("605#A100000000000000");
      CHECK(node.has_read(counted(one.length)).num == one.length);
    }
  }
}

TEST_CASE("SDO client: a last segment with 7 unused bytes contains no data") {
  SdoClient node;
  start(node, 35, "585#C600200523000000");
  send_segments(node, 5);
  node.rx("585#86AAAAAAAAAAAAAA");
  node.tx("605#A2067F0000000000");
  node.rx("585#DD35780000000000");
  node.tx("605#A100000000000000");
  node.has_read(counted(35));
}

TEST_CASE("SDO client: block upload of an empty object has one segment without data") {
  for (const char* answer : {"585#C600200500000000", "585#C400200500000000", "585#C000200500000000"}) {
    SdoClient node;
    start(node, 29, answer);
    node.rx("585#8100000000000000");
    node.tx("605#A2017F0000000000");
    node.rx("585#DD00000000000000");
    node.tx("605#A100000000000000");
    CHECK(node.has_read({}).num == 0);
  }
}

TEST_CASE("SDO client: 889 bytes are uploaded in one full sub-block whose segment 127 has bit 7 set [301:7.2.4.3.14]") {
  SdoClient node;
  start(node, 889, "585#C600200579030000");
  send_segments(node, 126);
  node.rx("585#FF73747576777879");
  node.tx("605#A27F7F0000000000");
  node.rx("585#C1FCFD0000000000");
  node.tx("605#A100000000000000");
  node.has_read(counted(889));
}

TEST_CASE("SDO client: of 890 bytes a full sub-block is acknowledged and the next one begins with segment 1") {
  SdoClient node;
  start(node, 890, "585#C60020057A030000");
  send_segments(node, 126);
  CHECK(node.num() == 0);
  node.rx("585#7F73747576777879");
  node.tx("605#A27F7F0000000000");
  CHECK(node.num() == 889);
  node.rx("585#817A000000000000");
  node.tx("605#A2017F0000000000");
  node.rx("585#D96F1D0000000000");
  node.tx("605#A100000000000000");
  CHECK(node.has_read(counted(890)).num == 890);
}

TEST_CASE("SDO client: a wrong CRC is refused with 0504 0004h [D14]") {
  for (const char* end_request : {"585#C1F0CC0000000000", "585#C1CDF00000000000", "585#C100000000000000"}) {
    SdoClient node;
    start(node, 100, "585#C600200515000000");
    send_segments(node, 2);
    node.rx("585#830F101112131415");
    node.tx("605#A2037F0000000000");
    node.rx(end_request);
    node.tx("605#8000200504000405");
    node.ended(CO_SDO_ERR_CRC);
  }
}

TEST_CASE("SDO client: a changed bit in any byte of the data is detected by the CRC") {
  for (unsigned position = 0; position < 20; ++position) {
    CAPTURE(position);
    SdoClient node;
    start(node, 100, "585#C600200514000000");
    for (unsigned n = 0; n < 3; ++n) {
      CO_IF_FRM frm = frame(n == 2 ? "585#8300000000000000" : "585#0000000000000000");
      frm.Data[0] = static_cast<std::uint8_t>(frm.Data[0] | (n + 1));
      for (unsigned i = 0; i < 7 && 7 * n + i < 20; ++i) {
        const unsigned flip = 7 * n + i == position ? 0x40U : 0U;
        frm.Data[1 + i] = static_cast<std::uint8_t>((7 * n + i + 1) ^ flip);
      }
      node.rx(frm);
    }
    node.tx("605#A2037F0000000000");
    node.rx("585#C5D3EA0000000000");
    node.tx("605#8000200504000405");
    node.ended(CO_SDO_ERR_CRC);
  }
}

TEST_CASE(
    "SDO client: a block upload with fewer bytes than announced is refused with 0607 0013h before the CRC check [D5]") {
  for (const char* end_request : {"585#C1F0CD0000000000", "585#C100000000000000"}) {
    SdoClient node;
    start(node, 100, "585#C600200516000000");
    send_segments(node, 2);
    node.rx("585#830F101112131415");
    node.tx("605#A2037F0000000000");
    node.rx(end_request);
    node.tx("605#8000200513000706");
    node.ended(CO_SDO_ERR_LEN_SMALL);
  }
}

TEST_CASE("SDO client: a block upload with more bytes than announced is refused with 0607 0012h at its end [D5]") {
  SdoClient node;
  start(node, 100, "585#C600200514000000");
  send_segments(node, 2);
  node.rx("585#830F101112131415");
  node.tx("605#A2037F0000000000");
  node.rx("585#C1F0CD0000000000");
  node.tx("605#8000200512000706");
  node.ended(CO_SDO_ERR_LEN_HIGH);
}

// Sends segments \a first to \a last until the client aborts; \a last ends the sub-block. Checks the abort, and that
// further segments are ignored. [D21]
void check_aborts_in_sub_block(SdoClient& node, unsigned first, unsigned last, const char* abort, std::uint32_t code) {
  for (unsigned n = first; n <= last && node.ends.empty(); ++n) {
    CO_IF_FRM frm = frame("585#0055555555555555");
    frm.Data[0] = static_cast<std::uint8_t>(n == last ? n | 0x80U : n);
    node.rx(frm);
    if (node.ends.empty()) node.silent();
  }
  node.tx(abort);
  node.ended(code);
  node.rx("585#7F55555555555555");
  node.silent();
}

TEST_CASE("SDO client: complete segments beyond the announced size are refused with 0607 0012h [D5] [D21]") {
  SdoClient node;
  start(node, 100, "585#C600200515000000");
  send_segments(node, 3);
  check_aborts_in_sub_block(node, 4, 9, "605#8000200512000706", CO_SDO_ERR_LEN_HIGH);
}

TEST_CASE("SDO client: an announced size above the buffer is refused with 0504 0005h and no block is requested") {
  for (const char* answer : {"585#C60020051E000000", "585#C20020051E000000", "585#C6002005FFFFFFFF",
                             "585#C600200500000080", "585#C60020051D000001"}) {
    SdoClient node;
    node.start_upload(0x2000, 5, 29);
    node.tx("605#A40020057F1C0000");
    node.rx(answer);
    node.tx("605#8000200505000405");
    CHECK(node.ended(CO_SDO_ERR_MEM).num == 0);
  }
}

TEST_CASE("SDO client: segments beyond the buffer are refused with 0504 0005h if no size was announced [D21]") {
  SdoClient node;
  start(node, 29, "585#C400200500000000");
  send_segments(node, 4);
  check_aborts_in_sub_block(node, 5, 9, "605#8000200505000405", CO_SDO_ERR_MEM);
}

TEST_CASE("SDO client: an end request that leaves more bytes than the buffer has is refused with 0504 0005h") {
  for (const char* end_request : {"585#C100000000000000", "585#D500000000000000"}) {
    SdoClient node;
    start(node, 29, "585#C000200500000000");
    send_segments(node, 4);
    node.rx("585#851D1E1F20212223");
    node.tx("605#A2057F0000000000");
    node.rx(end_request);
    node.tx("605#8000200505000405");
    node.ended(CO_SDO_ERR_MEM);
  }
}

TEST_CASE("SDO client: a frame that begins with 80h within a sub-block is an abort and not answered [D23] [C1]") {
  for (const unsigned received : {0U, 1U, 126U}) {
    CAPTURE(received);
    SdoClient node;
    start(node, 1000, "585#C400200500000000");
    send_segments(node, received);
    node.rx("585#8000200500000606");
    node.silent();
    CHECK(node.ended(CO_SDO_ERR_HW_ACCESS).num == 0);
  }
}

TEST_CASE("SDO client: a repeated last segment is ignored although its first byte is that of an end request [D27]") {
  SdoClient node;
  start(node, 455, "585#C6002005C7010000");
  send_segments(node, 64);
  const char* const last = "585#C1C1C2C3C4C5C6C7";
  node.rx(last);
  node.tx("605#A2417F0000000000");
  node.rx(last);
  node.rx(last);
  node.silent();
  node.goes_on();
  node.rx("585#C124D70000000000");
  node.tx("605#A100000000000000");
  node.has_read(counted(455));
}

// Without a CRC only the length distinguishes the end request from the repeated last segment.
TEST_CASE("SDO client: a repeated last segment that would end with a wrong length is ignored without a CRC [D27]") {
  struct Case {
    const char* answer;
    unsigned segments;
    std::uint32_t size;
    const char* acknowledge;
    const char* end_request;
  };
  const Case cases[] = {{"585#C2002005E3010000", 69, 483, "605#A2457F0000000000", "585#C100000000000000"},
                        {"585#C000200500000000", 65, 450, "605#A2417F0000000000", "585#D500000000000000"}};
  for (const Case& one : cases) {
    CAPTURE(one.size);
    SdoClient node;
    start(node, one.size, one.answer);
    send_segments(node, one.segments - 1);
    CO_IF_FRM last = frame("585#0000000000000000");
    const Bytes data = counted(7, 7 * (one.segments - 1) + 1);
    last.Data[0] = static_cast<std::uint8_t>(0x80 + one.segments);
    std::copy(data.begin(), data.end(), last.Data + 1);
    node.rx(last);
    node.tx(one.acknowledge);
    node.rx(last);
    node.silent();
    node.goes_on();
    node.rx(one.end_request);
    node.tx("605#A100000000000000");
    node.has_read(counted(one.size));
  }
}

TEST_CASE(
    "SDO client: a server may answer a block request with an expedited upload because of pst [301:7.2.4.3.13] [D13]") {
  struct Case {
    const char* answer;
    Bytes data;
  };
  const Case cases[] = {{"585#4F00200511000000", {0x11}},
                        {"585#4B00200511220000", {0x11, 0x22}},
                        {"585#4300200511223344", {0x11, 0x22, 0x33, 0x44}},
                        {"585#4200200511223344", {0x11, 0x22, 0x33, 0x44}}};
  for (const Case& one : cases) {
    SdoClient node;
    node.start_upload(0x2000, 5, 29);
    node.tx("605#A40020057F1C0000");
    node.rx(one.answer);
    node.silent();
    node.has_read(one.data);
  }
}

TEST_CASE(
    "SDO client: a server may answer a block request with a segmented upload because of pst [301:7.2.4.3.13] [D13]") {
  for (const char* answer : {"585#4100200508000000", "585#4000200500000000"}) {
    SdoClient node;
    node.start_upload(0x2000, 5, 29);
    node.tx("605#A40020057F1C0000");
    node.rx(answer);
    node.tx("605#6000000000000000");
    node.rx("585#0001020304050607");
    node.tx("605#7000000000000000");
    node.rx("585#1D08000000000000");
    node.silent();
    node.has_read(counted(8));
  }
}

TEST_CASE("SDO client: a segmented answer that announces more than the buffer has is refused with 0504 0005h") {
  SdoClient node;
  node.start_upload(0x2000, 5, 29);
  node.tx("605#A40020057F1C0000");
  node.rx("585#410020051E000000");
  node.tx("605#8000200505000405");
  node.ended(CO_SDO_ERR_MEM);
}

TEST_CASE("SDO client: block uploads of sizes around the limits and of long objects are complete") {
  for (const bool crc : {true, false}) {
    for (const std::size_t length : {1U, 7U, 8U, 28U, 29U, 888U, 889U, 890U, 891U, 1778U, 1779U, 70000U}) {
      CAPTURE(crc);
      CAPTURE(length);
      SdoClient node;
      PeerOptions options;
      options.crc = crc;
      options.announces = length % 2 == 0;
      SdoPeer peer(counted(length, 3), options);
      node.start_upload(0x2000, 5, static_cast<std::uint32_t>(std::max<std::size_t>(length, 29)));
      CHECK(serve(node, peer));
      CHECK(peer.fault == "");
      CHECK(peer.is_done);
      node.has_read(counted(length, 3));
    }
  }
}

TEST_CASE("SDO client: block upload of 1 MiB is complete") {
  SdoClient node;
  constexpr std::uint32_t size = mebibyte / stride(16);
  SdoPeer peer(counted(size, 9));
  node.start_upload(0x2000, 5, size);
  CHECK(serve(node, peer));
  CHECK(peer.fault == "");
  CHECK(peer.is_done);
  CHECK(node.has_read(counted(size, 9)).total == size);
}

}  // namespace

#endif
