// SPDX-License-Identifier: Apache-2.0
// SDO client: selection of the transfer type, and fallback if a server does not support block transfer.
#include "support/sdo_client_fixture.hpp"

#if USE_CSDO

namespace {

using namespace test;

TEST_CASE("SDO client: downloads of up to 4 bytes are expedited, up to 28 segmented, longer ones block transfers") {
  struct Case {
    std::uint32_t length;
    const char* request;
  };
  const Case cases[] = {
    {1, "605#2F00200501000000"},
    {4, "605#2300200501020304"},
    {5, "605#2100200505000000"},
    {28, "605#210020051C000000"},
#if CO_CSDO_BLOCK > 0
    {29, "605#C60020051D000000"},
    {256, "605#C600200500010000"}
#else
    {29, "605#210020051D000000"},
    {256, "605#2100200500010000"}
#endif
  };
  for (const Case& one : cases) {
    CAPTURE(one.length);
    SdoClient node;
    node.start_download(0x2000, 5, counted(one.length));
    node.tx(one.request);
    node.cancel();
    node.tx("605#8000200521000008");
    node.ended(CO_SDO_ERR_TOS_LOCAL);
  }
}

TEST_CASE("SDO client: uploads into buffers of up to 28 bytes are normal, into larger ones block transfers") {
  for (const std::uint32_t size : {1U, 4U, 5U, 28U, 29U, 1000U}) {
    CAPTURE(size);
    SdoClient node;
    node.start_upload(0x2000, 5, size);
    node.tx(size < 29 || CO_CSDO_BLOCK == 0 ? "605#4000200500000000" : "605#A40020057F1C0000");
    node.cancel();
    node.tx("605#8000200521000008");
    node.ended(CO_SDO_ERR_TOS_LOCAL);
  }
}

TEST_CASE("SDO client: an abort of an initiate counts with the multiplexer 0 or the code 0504 0001h, too") {
  struct Case {
    const char* abort;
    std::uint32_t code;  // 0: the client waits
  };
  for (const Case& one : {Case{"585#8000000000000206", 0x06020000}, Case{"585#8000100001000405", 0x05040001},
                          Case{"585#8000100000000206", 0}, Case{"585#8001200500000206", 0}}) {
    CAPTURE(std::string(one.abort));
    for (const bool is_upload : {false, true}) {
      SdoClient node;
      is_upload ? node.start_upload(0x2000, 5, 4) : node.start_download(0x2000, 5, {1, 2, 3, 4});
      node.frames();
      node.rx(one.abort);
      node.silent();
      one.code != 0 ? static_cast<void>(node.ended(one.code)) : node.goes_on();
      if (one.code == 0) {
        node.cancel();
        node.frames();
        node.ended(CO_SDO_ERR_TOS_LOCAL);
      }
    }
  }
}

TEST_CASE("SDO client: after the first answer an abort ends the transfer, whatever its multiplexer") {
  SdoClient node;
  node.start_upload(0x2000, 5, 20);
  node.frames();
  node.rx("585#4100200514000000");
  node.tx("605#6000000000000000");
  node.rx("585#8000000000000206");
  node.silent();
  node.ended(0x06020000);
}

TEST_CASE("SDO client: a download of 0 bytes is sent in a segment") {
  SdoClient node;
  node.start_download(0x2000, 5, {});
  node.tx("605#2100200500000000");
  node.rx("585#6000200500000000");
  node.tx("605#0F00000000000000");
  node.rx("585#2000000000000000");
  node.silent();
  node.ended(0);
}

#if CO_CSDO_BLOCK > 0

TEST_CASE("SDO client: a server without block transfer refuses with a stale multiplexer: segments follow at once") {
  SdoClient node;
  node.start_upload(0x1009, 0, 100);
  node.tx("605#A40910007F1C0000");
  node.rx("585#8000100001000405");
  node.goes_on();
  node.tx("605#4009100000000000");
  node.rx("585#4309100031323334");
  node.has_read({0x31, 0x32, 0x33, 0x34});
}

constexpr const char* no_block[] = {"585#8000200501000405", "585#8000200500000008"};

TEST_CASE("SDO client: a block upload that the server refuses is repeated as an expedited one") {
  for (const char* abort : no_block) {
    SdoClient node;
    node.start_upload(0x2000, 5, 100);
    node.tx("605#A40020057F1C0000");
    node.rx(abort);
    node.goes_on();
    node.tx("605#4000200500000000");
    node.rx("585#4300200511223344");
    node.silent();
    node.has_read({0x11, 0x22, 0x33, 0x44});
  }
}

TEST_CASE("SDO client: a block upload that the server refuses is repeated as a segmented one") {
  for (const char* abort : no_block) {
    SdoClient node;
    node.start_upload(0x2000, 5, 100);
    node.tx("605#A40020057F1C0000");
    node.rx(abort);
    node.tx("605#4000200500000000");
    node.rx("585#4100200508000000");
    node.tx("605#6000000000000000");
    node.rx("585#0001020304050607");
    node.tx("605#7000000000000000");
    node.rx("585#1D08000000000000");
    CHECK(node.has_read(counted(8)).total == 8);
  }
}

TEST_CASE("SDO client: a block download that the server refuses is repeated in segments") {
  for (const char* abort : no_block) {
    SdoClient node;
    node.start_download(0x2000, 5, counted(29));
    node.tx("605#C60020051D000000");
    node.rx(abort);
    node.goes_on();
    node.tx("605#210020051D000000");
    node.rx("585#6000200500000000");
    node.tx("605#0001020304050607");
    node.rx("585#2000000000000000");
    node.tx("605#1008090A0B0C0D0E");
    node.rx("585#3000000000000000");
    node.tx("605#000F101112131415");
    node.rx("585#2000000000000000");
    node.tx("605#10161718191A1B1C");
    node.rx("585#3000000000000000");
    node.tx("605#0D1D000000000000");
    node.rx("585#2000000000000000");
    node.silent();
    CHECK(node.has_written().num == 29);
  }
}

// Starts a transfer of 29 bytes, and leads it to the second initiate, after the server has refused block transfer.
void fall_back(SdoClient& node, bool upload) {
  if (upload) {
    node.start_upload(0x2000, 5, 29);
  } else {
    node.start_download(0x2000, 5, counted(29));
  }
  node.tx(upload ? "605#A40020057F1C0000" : "605#C60020051D000000");
  node.rx(no_block[0]);
  node.tx(upload ? "605#4000200500000000" : "605#210020051D000000");
}

TEST_CASE("SDO client: it repeats once: an abort of the normal initiate ends the transfer for any code") {
  for (const bool upload : {true, false}) {
    for (const char* abort : no_block) {
      CAPTURE(upload);
      SdoClient node;
      fall_back(node, upload);
      node.rx(abort);
      node.silent();
      node.ended(std::string(abort) == no_block[0] ? CO_SDO_ERR_CMD : CO_SDO_ERR_GENERAL);
    }
  }
}

TEST_CASE("SDO client: after the normal initiate answers of a block transfer are unexpected") {
  for (const bool upload : {true, false}) {
    CAPTURE(upload);
    SdoClient node;
    fall_back(node, upload);
    node.rx(upload ? "585#C60020051D000000" : "585#A40020057F000000");
    node.tx("605#8000200501000405");
    node.ended(CO_SDO_ERR_CMD);
  }
}

TEST_CASE("SDO client: the normal initiate has the complete time-out") {
  for (const bool upload : {true, false}) {
    CAPTURE(upload);
    SdoClient node;
    if (upload) {
      node.start_upload(0x2000, 5, 29, 100);
    } else {
      node.start_download(0x2000, 5, counted(29), 100);
    }
    node.frames();
    node.after(99ms);
    node.rx(no_block[0]);
    node.frames();
    node.after(99ms);
    node.goes_on();
    node.silent();
    node.after(1ms);
    node.tx("605#8000200500000405");
    node.ended(CO_SDO_ERR_TIMEOUT);
  }
}

TEST_CASE("SDO client: any other abort of a block initiate is final") {
  for (const char* abort : {"585#8000200500000206", "585#8000200505000405", "585#8000200500000106",
                            "585#8000200520000008", "585#8000200502000405"}) {
    for (const bool upload : {true, false}) {
      SdoClient node;
      if (upload) {
        node.start_upload(0x2000, 5, 29);
      } else {
        node.start_download(0x2000, 5, counted(29));
      }
      node.frames();
      node.rx(abort);
      node.silent();
      const CO_IF_FRM frm = frame(abort);
      node.ended(CO_GET_LONG(&frm, 4));
    }
  }
}

TEST_CASE("SDO client: the aborts that cause a repetition are final later in a block transfer") {
  for (const char* abort : no_block) {
    const std::uint32_t code = std::string(abort) == no_block[0] ? CO_SDO_ERR_CMD : CO_SDO_ERR_GENERAL;
    SdoClient reads;
    reads.start_upload(0x2000, 5, 29);
    reads.tx("605#A40020057F1C0000");
    reads.rx("585#C60020051D000000");
    reads.tx("605#A300000000000000");
    reads.rx(abort);
    reads.silent();
    reads.ended(code);
    SdoClient writes;
    writes.start_download(0x2000, 5, counted(29));
    writes.tx("605#C60020051D000000");
    writes.rx("585#A400200501000000");
    writes.tx("605#0101020304050607");
    writes.rx(abort);
    writes.silent();
    writes.ended(code);
  }
}

TEST_CASE("SDO client: normal transfers are not repeated") {
  for (const char* abort : no_block) {
    SdoClient node;
    node.start_upload(0x2000, 5, 28);
    node.tx("605#4000200500000000");
    node.rx(abort);
    node.silent();
    node.ended(std::string(abort) == no_block[0] ? CO_SDO_ERR_CMD : CO_SDO_ERR_GENERAL);
  }
}

#endif

}  // namespace

#endif
