// SPDX-License-Identifier: Apache-2.0
// SDO client: block transfers over a bus that loses, repeats, reorders and changes frames. [T11] [D11] [D22] [D23]
#include "support/sdo_client_fixture.hpp"
#include "support/sdo_client_peer.hpp"

namespace {

using namespace test;

#if USE_CSDO && CO_CSDO_BLOCK > 0

// The 40 bytes 1, 2, 3, … as a sub-block of six segments.
constexpr const char* segments[] = {"585#0101020304050607", "585#0208090A0B0C0D0E", "585#030F101112131415",
                                    "585#04161718191A1B1C", "585#051D1E1F20212223", "585#8624252627280000"};

// Starts a block upload; \a answer is the server's response to the initiate.
void start(SdoClient& node, std::string_view answer = "585#C600200528000000") {
  node.start_upload(0x2000, 5, 1000);
  node.tx("605#A40020057F1C0000");
  node.rx(answer);
  node.tx("605#A300000000000000");
}

// Sends the segments with these numbers to the client, in this order. Checks that the client does not answer before the
// last one.
void send(SdoClient& node, const std::vector<unsigned>& order) {
  for (std::size_t n = 0; n < order.size(); ++n) {
    node.rx(segments[order[n] - 1]);
    if (n + 1 < order.size()) node.silent();
  }
}

// Ends the upload of the 40 bytes, and checks that the client has read them.
void finish(SdoClient& node) {
  node.rx("585#C9C38B0000000000");
  node.tx("605#A100000000000000");
  node.has_read(counted(40));
}

TEST_CASE(
    "SDO client: after a lost segment the rest of the sub-block is ignored and the last good one acknowledged [D22]") {
  SdoClient node;
  start(node);
  send(node, {1, 2, 4, 5, 6});
  node.tx("605#A2027F0000000000");
  CHECK(node.num() == 14);
  node.rx("585#010F101112131415");
  node.rx("585#02161718191A1B1C");
  node.rx("585#031D1E1F20212223");
  node.silent();
  node.rx("585#8424252627280000");
  node.tx("605#A2047F0000000000");
  finish(node);
}

TEST_CASE("SDO client: after a lost first segment none is acknowledged and the server repeats the block [D22]") {
  SdoClient node;
  start(node);
  send(node, {2, 3, 4, 5, 6});
  node.tx("605#A2007F0000000000");
  CHECK(node.num() == 0);
  send(node, {1, 2, 3, 4, 5, 6});
  node.tx("605#A2067F0000000000");
  finish(node);
}

TEST_CASE("SDO client: repeated segments are ignored") {
  SdoClient node;
  start(node);
  send(node, {1, 1, 2, 2, 2, 1, 3, 4, 3, 5, 5, 6});
  node.tx("605#A2067F0000000000");
  finish(node);
}

TEST_CASE("SDO client: a segment out of order is not acknowledged and accepted when the server repeats it [D22]") {
  SdoClient node;
  start(node);
  send(node, {1, 3, 2, 4, 5, 6});
  node.tx("605#A2027F0000000000");
  node.rx("585#010F101112131415");
  node.rx("585#02161718191A1B1C");
  node.rx("585#031D1E1F20212223");
  node.rx("585#8424252627280000");
  node.tx("605#A2047F0000000000");
  finish(node);
}

TEST_CASE("SDO client: a last segment without its predecessor ends the sub-block but not the transfer [D22]") {
  SdoClient node;
  start(node);
  send(node, {1, 2, 3, 4, 6});
  node.tx("605#A2047F0000000000");
  node.rx("585#011D1E1F20212223");
  node.rx("585#8224252627280000");
  node.tx("605#A2027F0000000000");
  finish(node);
}

TEST_CASE("SDO client: a segment with the number 0 is refused with 0504 0003h [5.2]") {
  for (const unsigned received : {0U, 1U, 5U}) {
    SdoClient node;
    start(node);
    for (unsigned n = 0; n < received; ++n) node.rx(segments[n]);
    node.rx("585#00FFFFFFFFFFFFFF");
    node.tx("605#8000200503000405");
    node.ended(CO_SDO_ERR_SEQ_NUM);
  }
}

TEST_CASE("SDO client: if the first of two segments is lost none is acknowledged and the server repeats both [D22]") {
  SdoClient node;
  start(node, "585#C60020050E000000");
  node.rx("585#8208090A0B0C0D0E");
  node.tx("605#A2007F0000000000");
  node.rx("585#0101020304050607");
  node.rx("585#8208090A0B0C0D0E");
  node.tx("605#A2027F0000000000");
  node.rx("585#C1929B0000000000");
  node.tx("605#A100000000000000");
  node.has_read(counted(14));
}

TEST_CASE("SDO client: a full sub-block with a lost segment is acknowledged at segment 127 [D22]") {
  SdoClient node;
  start(node, "585#C60020057A030000");
  for (unsigned n = 1; n <= 127; ++n) {
    CO_IF_FRM frm = frame("585#0000000000000000");
    const Bytes data = counted(7, 7 * (n - 1) + 1);
    frm.Data[0] = static_cast<std::uint8_t>(n);
    std::copy(data.begin(), data.end(), frm.Data + 1);
    if (n == 126) continue;
    node.silent();
    node.rx(frm);
  }
  node.tx("605#A27D7F0000000000");
  CHECK(node.num() == 875);
  node.rx("585#016C6D6E6F707172");
  node.rx("585#0273747576777879");
  node.rx("585#837A000000000000");
  node.tx("605#A2037F0000000000");
  node.rx("585#D96F1D0000000000");
  node.tx("605#A100000000000000");
  node.has_read(counted(890));
}

TEST_CASE("SDO client: a repeated last segment of a sub-block is ignored") {
  SdoClient node;
  start(node);
  send(node, {1, 2, 4, 5, 6});
  node.tx("605#A2027F0000000000");
  node.rx(segments[5]);
  node.silent();
  node.rx("585#010F101112131415");
  node.rx("585#02161718191A1B1C");
  node.rx("585#031D1E1F20212223");
  node.rx("585#8424252627280000");
  node.tx("605#A2047F0000000000");
  node.rx("585#8424252627280000");
  node.silent();
  finish(node);
}

// Runs an upload of \a length bytes with one fault of the bus. Checks that the client reports an end, and no success
// with wrong data. Returns true if it has reported success. \a crc: the server supports CRC.
bool upload_with(const Disturbance& disturbance, std::size_t length, bool crc) {
  SdoClient node;
  PeerOptions options;
  options.crc = crc;
  SdoPeer peer(counted(length, 3), options);
  node.start_upload(0x2000, 5, 2000);
  CHECK_MESSAGE(serve(node, peer, disturbance), "the transfer does not end");
  REQUIRE(node.ends.size() == 1);
  const ClientEnd end = node.ends.front();
  node.ends.clear();
  node.frames();
  CHECK_MESSAGE((end.code != 0 || end.data == counted(length, 3)), "success is reported with wrong data");
  return end.code == 0;
}

// Runs a download like upload_with(); the server requests sub-blocks of 5, 3 and 127 segments in turn.
bool download_with(const Disturbance& disturbance, std::size_t length) {
  SdoClient node;
  PeerOptions options;
  options.block_sizes = {5, 3, 127};
  SdoPeer peer({}, options);
  node.start_download(0x2000, 5, counted(length, 3));
  CHECK_MESSAGE(serve(node, peer, disturbance), "the transfer does not end");
  REQUIRE(node.ends.size() == 1);
  const ClientEnd end = node.ends.front();
  node.ends.clear();
  node.frames();
  const bool is_correct = peer.is_done && peer.object == counted(length, 3);
  CHECK_MESSAGE((end.code != 0 || is_correct), "success is reported with wrong data");
  return end.code == 0;
}

const Disturbance::Kind kinds[] = {Disturbance::Kind::lose, Disturbance::Kind::repeat,
                                   Disturbance::Kind::swap_with_next, Disturbance::Kind::change_bit};

TEST_CASE("SDO client: a block upload with a fault at any frame gives the right data or reports a failure [T11]") {
  for (const std::size_t length : {29U, 100U, 890U, 1778U}) {
    const std::size_t frames = length / 7 + 8;
    for (const Disturbance::Kind kind : kinds) {
      for (const bool to_node : {true, false}) {
        const std::size_t last = to_node ? frames : 8;
        const std::size_t step = frames > 40 && to_node ? 7 * stride(5) : 1;
        for (std::size_t at = 0; at < last; at += step) {
          CAPTURE(length);
          CAPTURE(static_cast<int>(kind));
          CAPTURE(to_node);
          CAPTURE(at);
          upload_with({kind, at, to_node}, length, true);
        }
      }
    }
  }
}

TEST_CASE("SDO client: a block download with a fault at any frame gives the right data or reports a failure [T11]") {
  for (const std::size_t length : {29U, 100U, 890U}) {
    const std::size_t frames = length / 7 + 8;
    for (const Disturbance::Kind kind : kinds) {
      for (const bool to_node : {true, false}) {
        const std::size_t last = to_node ? 10 : frames;
        const std::size_t step = last > 40 ? stride(37) : 1;
        for (std::size_t at = 0; at < last; at += step) {
          CAPTURE(length);
          CAPTURE(static_cast<int>(kind));
          CAPTURE(to_node);
          CAPTURE(at);
          download_with({kind, at, to_node}, length);
        }
      }
    }
  }
}

// Except the only segment of the last sub-block (of 128 segments, the last one) and a last segment that arrives after
// the end request: neither side can recover these. [T11]
TEST_CASE("SDO client: a block upload succeeds although a segment is lost or repeated or delayed [T11] [D11]") {
  for (const std::size_t length : {14U, 100U, 455U, 896U}) {
    const std::size_t count = (length + 6) / 7;
    for (const Disturbance::Kind kind :
         {Disturbance::Kind::lose, Disturbance::Kind::repeat, Disturbance::Kind::swap_with_next}) {
      for (std::size_t n = 1; n <= count; n += count > 40 ? stride(37) : 1) {
        const bool is_unrecoverable = n == count && (count == 128 || kind == Disturbance::Kind::swap_with_next);
        if (is_unrecoverable) continue;
        CAPTURE(length);
        CAPTURE(static_cast<int>(kind));
        CAPTURE(n);
        CHECK(upload_with({kind, n, true}, length, true));
      }
    }
  }
}

TEST_CASE("SDO client: a block download succeeds although a segment is lost or delayed [T11] [D11]") {
  for (const std::size_t length : {29U, 100U, 890U}) {
    const std::size_t count = (length + 6) / 7;
    for (const Disturbance::Kind kind : {Disturbance::Kind::lose, Disturbance::Kind::swap_with_next}) {
      for (std::size_t n = 1; n <= count; n += count > 40 ? stride(37) : 1) {
        if (n == count && kind == Disturbance::Kind::swap_with_next) continue;
        CAPTURE(length);
        CAPTURE(static_cast<int>(kind));
        CAPTURE(n);
        CHECK(download_with({kind, n, false}, length));
      }
    }
  }
}

#endif

// SDO client: selection of the transfer type, and fallback if a server does not support block transfer.

#if USE_CSDO

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

#endif

}  // namespace
