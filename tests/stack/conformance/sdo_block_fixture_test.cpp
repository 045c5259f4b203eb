// SPDX-License-Identifier: Apache-2.0
// Faults of block transfers that the fixture has to detect, and checks of its client.
#include "support/block_states.hpp"

#if USE_SDO_BLOCK

namespace {

using namespace test;

TEST_CASE("fixture: the CRC is computed bit by bit [D14]") {
  CHECK(crc_16({'1', '2', '3', '4', '5', '6', '7', '8', '9'}) == 0x31C3);
  CHECK(crc_16({}) == 0);
  CHECK(crc_16({0, 0, 0, 0}) == 0);
  CHECK(crc_16({1}) == 0x1021);
}

TEST_CASE("fixture: frames of block transfers that a server may send") {
  for (const char* text : {"581#A41234567F000000", "581#A412345601000000", "581#A2007F0000000000",
                           "581#A27F010000000000", "581#A100000000000000", "581#C612345611223344",
                           "581#C412345600000000", "581#C1AABB0000000000", "581#DDAABB0000000000"}) {
    CAPTURE(std::string(text));
    CHECK(fault_of(frame(text), 1, CO_PREOP, true) == "");
    CHECK(fault_of(frame(text), 1, CO_STOP, true) != "");
  }
  for (const char* text : {"581#0111223344556677", "581#7F11223344556677", "581#8111223344556677",
                           "581#FF00000000000000", "581#8012345601000405"}) {
    CHECK(fault_of(frame(text), 1, CO_PREOP, true, true) == "");
  }
}

TEST_CASE("fixture: frames of block transfers that a server must not send") {
  for (const char* text :
       {"581#A01234567F000000", "581#A412345600000000", "581#A412345680000000", "581#A41234567F010000",
        "581#A200000000000000", "581#A27F800000000000", "581#A2807F0000000000", "581#A27F7F0100000000",
        "581#A101000000000000", "581#C012345600000000", "581#C212345611223344", "581#C412345601000000",
        "581#C1AABB0100000000", "581#C312345600000000", "581#DFAABB0000000000", "581#A300000000000000"}) {
    CAPTURE(std::string(text));
    CHECK(fault_of(frame(text), 1, CO_PREOP, true) != "");
  }
  CHECK(fault_of(frame("581#0011223344556677"), 1, CO_PREOP, true, true) != "");
  CHECK(fault_of(frame("581#01112233445566"), 1, CO_PREOP, true, true) != "");
}

// Observer -----------------------------------------------------------------------------------------------------------

// Returns an observer within a started block upload with blksize 4.
SdoObserver uploading() {
  SdoObserver channel;
  channel.request(frame("601#A412345604000000"));
  CHECK(channel.taken(frame("581#C612345611223344")) == "");
  CHECK_FALSE(channel.is_sending());
  channel.request(frame("601#A300000000000000"));
  CHECK(channel.is_sending());
  return channel;
}

TEST_CASE("fixture: the order of the segments of a block upload is checked") {
  SdoObserver channel = uploading();
  CHECK(channel.taken(frame("581#0100000000000000")) == "");
  CHECK(channel.taken(frame("581#0200000000000000")) == "");
  CHECK(channel.taken(frame("581#0200000000000000")) != "");
  CHECK(channel.taken(frame("581#0400000000000000")) != "");
  CHECK(channel.taken(frame("581#0300000000000000")) == "");
  CHECK(channel.taken(frame("581#0400000000000000")) == "");
  CHECK(channel.taken(frame("581#0500000000000000")) != "");
}

TEST_CASE("fixture: sequence numbers restart at 1 after an acknowledge; none follows the last segment") {
  SdoObserver channel = uploading();
  CHECK(channel.taken(frame("581#0100000000000000")) == "");
  channel.request(frame("601#A201020000000000"));
  CHECK(channel.taken(frame("581#0200000000000000")) != "");
  CHECK(channel.taken(frame("581#8155000000000000")) == "");
  CHECK(channel.taken(frame("581#0200000000000000")) != "");
  channel.request(frame("601#A201020000000000"));
  CHECK_FALSE(channel.is_sending());
  CHECK(channel.taken(frame("581#D900000000000000")) == "");
}

TEST_CASE("fixture: bytes of the last segment that the end declares unused must be 0") {
  SdoObserver channel = uploading();
  CHECK(channel.taken(frame("581#8155550000000000")) == "");
  channel.request(frame("601#A201020000000000"));
  CHECK(channel.taken(frame("581#D900000000000000")) != "");
}

ChangeableEntries may_change(SdoObserver& channel) {
  ChangeableEntries may;
  channel.take_changeable(may);
  return may;
}

constexpr std::uint32_t dev = CO_DEV(0x3412, 0x56);

// Returns an observer of an initiated block download.
SdoObserver downloading() {
  SdoObserver channel;
  channel.request(frame("601#C612345611223344"));
  CHECK(channel.taken(frame("581#A41234567F000000")) == "");
  return channel;
}

TEST_CASE("fixture: a block download may change its object when its end is confirmed") {
  SdoObserver channel = downloading();
  channel.request(frame("601#8111223344000000"));
  channel.taken(frame("581#A2017E0000000000"));
  channel.request(frame("601#CD00000000000000"));
  CHECK(may_change(channel).completed.empty());
  channel.taken(frame("581#A100000000000000"));
  CHECK(may_change(channel).completed == std::set<std::uint32_t>{dev});
  CHECK(may_change(channel).completed.empty());
}

TEST_CASE("fixture: a block download that is aborted at its end may change nothing") {
  SdoObserver channel = downloading();
  channel.request(frame("601#8111223344000000"));
  channel.taken(frame("581#A2017E0000000000"));
  channel.request(frame("601#CD00000000000000"));
  channel.taken(frame("581#8012345604000405"));
  const ChangeableEntries may = may_change(channel);
  CHECK(may.completed.empty());
  CHECK(may.streaming.empty());
}

TEST_CASE("fixture: a block download streams when the buffer is full and more is to come") {
  SdoObserver channel = downloading();
  for (unsigned n = 1; n <= CO_SDO_BUF_SEG; ++n) {
    CHECK(may_change(channel).streaming.empty());
    channel.request(CO_IF_FRM{0x601, {static_cast<std::uint8_t>(n)}, 8});
  }
  CHECK(may_change(channel).streaming == std::set<std::uint32_t>{dev});
  SdoObserver exact = downloading();
  for (unsigned n = 1; n <= CO_SDO_BUF_SEG; ++n) {
    exact.request(CO_IF_FRM{0x601, {static_cast<std::uint8_t>(n | (n == CO_SDO_BUF_SEG ? 0x80U : 0U))}, 8});
  }
  CHECK(may_change(exact).streaming.empty());
}

TEST_CASE("fixture: segments out of order and queued segments are counted separately") {
  SdoObserver channel = downloading();
  for (unsigned n = 2; n <= 127; ++n) {
    channel.request(CO_IF_FRM{0x601, {static_cast<std::uint8_t>(n)}, 8});
  }
  CHECK(may_change(channel).streaming.empty());
  channel.waiting({frame("581#A2007F0000000000")});
  channel.request(frame("601#8111223344000000"));
  CHECK(channel.taken(frame("581#A2007F0000000000")) == "");
  channel.waiting({frame("581#A2017E0000000000")});
  channel.request(frame("601#CD00000000000000"));
  channel.waiting({frame("581#A2017E0000000000"), frame("581#A100000000000000")});
  CHECK(may_change(channel).completed == std::set<std::uint32_t>{dev});
  CHECK(channel.taken(frame("581#A2017E0000000000")) == "");
  CHECK(channel.taken(frame("581#A100000000000000")) == "");
  CHECK(may_change(channel).completed.empty());
}

// Client -------------------------------------------------------------------------------------------------------------

TEST_CASE("fixture: an object that changes in a block download before its end fails" * doctest::should_fail()) {
  Fixture node;
  node.rx("601#C604200004000000");
  node.frames();
  node.call([&] { node.objects.u32 = 1; });
}

TEST_CASE("fixture: the block client reports a server that aborts, and one that is silent") {
  Fixture node;
  CHECK(node.block_upload(0x1004, 0).abort == 0x06020000);
  CHECK(node.block_download(0x1000, 0, {1, 2, 3, 4}).abort == 0x06010002);
  node.rx("000#0201");
  const BlockResult upload = node.block_upload(0x2104, 0);
  CHECK(upload.abort == 0x05040000);
  CHECK(upload.by_client);
  CHECK(node.block_download(0x2104, 0, counting(890)).abort == 0x05040000);
}

TEST_CASE("fixture: the block client counts frames and drops the configured ones") {
  constexpr unsigned segments = 3;
  constexpr unsigned in_block = CO_SDO_BUF_SEG < segments ? CO_SDO_BUF_SEG : segments;
  Fixture node;
  const BlockResult result = node.block_download(0x2100, 15, counting(15));
  CHECK(result.requests == 1 + segments + 1);
  CHECK(result.answers == 1 + (segments + in_block - 1) / in_block + 1);
  BlockOptions options;
  for (unsigned n = 1; n <= in_block; ++n) {
    options.lost_requests.insert(n);
  }
  const BlockResult again = node.block_download(0x2100, 15, counting(15, 9), options);
  CHECK(again.abort == 0);
  CHECK(again.requests == 1 + in_block + segments + 1);
  CHECK(node.objects.memory[15] == counting(15, 9));
}

#if CO_SDO_BUF_SEG == 127
TEST_CASE("fixture: every state of a block transfer belongs to an open transfer") {
  for (const BlockState& state : block_states()) {
    CAPTURE(state.name);
    Fixture node;
    state.enter(node);
    CHECK(node->Sdo[0].Obj != nullptr);
    let_go_on(node);
    node.frames();
  }
}
#endif

}  // namespace

#endif
