// SPDX-License-Identifier: Apache-2.0
// SDO server, block download: segments that arrive after the time-out. Only the state of the server distinguishes
// segments from requests; as the server is idle, it treats them as requests. [301:7.2.4.3.10]
#include "support/fixture.hpp"

#if USE_SDO_BLOCK && CO_SDO_BUF_SEG == 127

namespace {

using namespace test;

// A block download of 15 bytes to 2100h:0F that has timed out after its first segment.
struct TimedOut : Fixture {
  TimedOut() : Fixture(Setup().only_small()) {
    ask("601#C600210F0F000000", "581#A400210F7F000000");
    rx("601#0101020304050607");
    after(sdo_time_out());
    const std::vector<std::string> sent = frames();
    REQUIRE_FALSE(sent.empty());
    CHECK(sent.back() == "581#8000210F00000405");
  }
};

void check_object_untouched(Fixture& node) {
  Bytes before(15);
  for (std::size_t n = 0; n < before.size(); ++n) before[n] = static_cast<std::uint8_t>(n + 1);
  CHECK(node.objects.memory[15] == before);
}

TEST_CASE("SDO block download: segments 1 to 31 after the time-out are unknown requests [D7] [D18]") {
  for (unsigned seqno = 1; seqno < 32; ++seqno) {
    CAPTURE(seqno);
    TimedOut node;
    CO_IF_FRM frm = frame("601#0008090A0B0C0D0E");
    frm.Data[0] = static_cast<std::uint8_t>(seqno);
    node.rx(frm);
    node.tx("581#8008090A01000405");
    check_object_untouched(node);
  }
}

TEST_CASE("SDO block download: segments 34 and 35 after the time-out write the object that their data contain") {
  for (const char* segment : {"601#22042000AABBCCDD", "601#23042000AABBCCDD"}) {
    TimedOut node;
    node.ask(segment, "581#6004200000000000");
    CHECK(node.objects.u32 == 0xDDCCBBAA);
    check_object_untouched(node);
  }
}

TEST_CASE("SDO block download: segment 47 after the time-out writes only an object of one byte [D5]") {
  TimedOut node;
  node.ask("601#2F042000AABBCCDD", "581#8004200013000706");
  CHECK(node.objects.u32 == 0x44332211);
  node.ask("601#2F012000AABBCCDD", "581#6001200000000000");
  CHECK(node.objects.u8 == 0xAA);
}

TEST_CASE("SDO block download: segment 64 after the time-out reads; with bit 7 it begins a download") {
  TimedOut node;
  node.ask("601#40042000AABBCCDD", "581#4304200011223344");
  node.ask("601#C0042000AABBCCDD", "581#A40420007F000000");
  node.rx("601#8000000000000000");
  node.silent();
}

TEST_CASE("SDO block download: after the time-out every frame is processed as without a previous transfer [D18]") {
  for (unsigned command = 0; command < 256; ++command) {
    CAPTURE(command);
    TimedOut late;
    Fixture fresh(Setup().only_small());
    CO_IF_FRM frm = frame("601#00042000AABBCCDD");
    frm.Data[0] = static_cast<std::uint8_t>(command);
    late.rx(frm);
    fresh.rx(frm);
    CHECK(late.frames() == fresh.frames());
    CHECK(late.objects.u32 == fresh.objects.u32);
    check_object_untouched(late);
  }
}

}  // namespace

#endif
