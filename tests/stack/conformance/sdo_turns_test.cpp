// SPDX-License-Identifier: Apache-2.0
// SDO: several block transfers with a slow controller, and ambiguous frames.
#include <string>

#include "support/block_frames.hpp"
#include "support/logged_stream.hpp"
#include "support/sdo_client_fixture.hpp"

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

namespace {

using namespace test;

#if CO_SSDO_N > 1
// Returns the CAN-IDs of the frames sent by a controller that accepts one frame at a time.
std::vector<std::uint32_t> senders(Fixture& node, unsigned frames) {
  std::vector<std::uint32_t> ids;
  while (ids.size() < frames) {
    node.can.accept_next(1);
    node.loop();
    for (const std::string& text : node.frames()) {
      ids.push_back(frame(text).Identifier);
    }
  }
  return ids;
}

TEST_CASE("SDO block upload: channels send in rotation, however few frames the controller accepts [D20]") {
  Fixture node(Setup().before_init([](Objects& objects) {
    objects.sdo2_rx = 0x640;
    objects.sdo2_tx = 0x5C0;
  }));
  node.ask("601#A00421007F000000", "581#C60421007A030000");
  node.ask("640#A00321007F000000", "5C0#C603210078030000");
  node.can.refuse_all();
  node.rx("601#A300000000000000");
  node.rx("640#A300000000000000");
  const std::vector<std::uint32_t> ids = senders(node, 40);
  for (std::size_t n = 1; n < ids.size(); ++n) {
    CAPTURE(n);
    CHECK(ids[n] != ids[n - 1]);
  }
  node.can.refuse_all();
  node.rx("601#8000000000000008");
  node.rx("640#8000000000000008");
  node.can.accept_all();
}
#endif

// 617 bytes are 88 segments and one byte: the last segment and the end request are equal, D9h and seven bytes 0.
TEST_CASE("SDO block download: a frame equal to the last segment is the end if length and CRC are right [D27]") {
  for (const char* initiate : {"601#C202210069020000", "601#C602210069020000"}) {
    CAPTURE(initiate);
    Fixture node(Setup().with_70000());
    node.may_change(0x2102, 0);  // the fixture treats this end request as a repeated segment
    const Bytes zeros(617);
    node.ask(initiate, "581#A40221007F000000");
    for (unsigned n = 0; n < 89; ++n) {
      node.rx(block_segment(zeros, n, n + 1));
    }
    node.tx("581#A259260000000000");
    node.ask("601#D900000000000000", "581#A100000000000000");
    CHECK(node.objects.memory[70000][616] == 0);
  }
}

TEST_CASE("SDO stream types: a long object without Reset is refused for block uploads, which may be repeated") {
  LoggedStream stream;
  stream.data = counting(2000);
  CO_OBJ entry = stream.extended(0x2300);
  CO_OBJ_TYPE_EX type = *reinterpret_cast<const CO_OBJ_TYPE_EX*>(entry.Type);
  type.Reset = nullptr;
  entry.Type = &type.Type;
  Fixture node(Setup().with(entry));
  node.ask("601#A40023007F000000", "581#8000230001000405");
  stream.data = counting(889);
  node.ask("601#A40023007F000000", "581#C600230079030000");
  node.rx("601#8000230000000008");
}

TEST_CASE("SDO block upload: its time-out runs although its type changes the NMT state meanwhile [D18]") {
  LoggedStream stream;
  stream.data = counting(1900);
  unsigned reads = 0;
  stream.on_piece = [&](CO_OBJ*, CO_NODE* node) {
    if (++reads == 2) {
      CONmtSetMode(&node->Nmt, CO_STOP);
      CONmtSetMode(&node->Nmt, CO_PREOP);
    }
    return CO_ERR_NONE;
  };
  Fixture node(Setup().with(stream.extended(0x2300)));
  node.ask("601#A00023007F000000", "581#C60023006C070000");
  node.rx("601#A300000000000000");
  node.frames();
  node.can.accept_next(20);
  node.rx("601#A23C7F0000000000");
  node.can.accept_all();
  node.loop();
  node.frames();
  node.after(node.sdo_time_out());
  for (const std::string& text : node.frames()) {
    CHECK(text == "581#8000230000000405");
  }
  CHECK(stream.log.back().substr(0, 3) == "end");
}

}  // namespace

#endif

#if USE_CSDO && USE_CSDO_OWN

namespace {

using namespace test;

TEST_CASE("SDO client, own node: after a cancel in a type function the buffer stays valid until the callback") {
  LoggedStream stream;
  SdoClient node(Setup().only_small().with(stream.extended(0x2300)), local_entries());
  stream.on_open = [&](CO_OBJ*, CO_NODE* of) {
    CHECK(COCSdoCancel(&of->CSdo[0]) == CO_ERR_NONE);
    CHECK(of->CSdo[0].State ==
          CO_CSDO_STATE_BUSY);  // The buffer remains valid until the callback, which is called later.
    return CO_ERR_NONE;
  };
  node.start_download(0x2300, 0, counted(40));
  node.after(10ms);
  REQUIRE(node.ends.size() == 1);
  CHECK(node.ends.front().code == 0x08000021);
  node.ends.clear();
  CHECK(stream.data == counted(40));
}

}  // namespace

#endif
