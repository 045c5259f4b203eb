// SPDX-License-Identifier: Apache-2.0
// SDO server: abort codes and their precedence. [301:7.2.4.3.17]
#include <cstring>

#include "support/block_frames.hpp"
#include "support/fixture.hpp"
#include "support/logged_stream.hpp"

namespace {

using namespace test;

// Results of the type functions of the test's objects.
struct Script {
  std::uint32_t size = 4;
  CO_ERR read = CO_ERR_NONE;
  CO_ERR write = CO_ERR_NONE;
  std::uint32_t read_abort = 0;
  std::uint32_t write_abort = 0;
  unsigned fail_at_call = 1;  // number of the call of Read or Write with a length that fails, from 1
  unsigned calls = 0;
  std::function<void(CO_NODE*)> on_write;
} script;

uint32_t scripted_size(CO_OBJ*, CO_NODE*, uint32_t) { return script.size; }

CO_ERR scripted(CO_OBJ* obj, CO_NODE* node, uint32_t size, CO_ERR error, uint32_t abort) {
  if (size == 0 || ++script.calls < script.fail_at_call) {
    return CO_ERR_NONE;
  }
  if (abort != 0) {
    COObjTypeUserSDOAbort(obj, node, abort);
  }
  return error;
}

CO_ERR scripted_read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  std::memset(buffer, 0x55, size);
  return scripted(obj, node, size, script.read, script.read_abort);
}

CO_ERR scripted_write(CO_OBJ* obj, CO_NODE* node, void*, uint32_t size) {
  if (script.on_write) {
    script.on_write(node);
  }
  return scripted(obj, node, size, script.write, script.write_abort);
}

CO_ERR scripted_reset(CO_OBJ*, CO_NODE*, uint32_t) { return CO_ERR_NONE; }

const CO_OBJ_TYPE value_type = {scripted_size, nullptr, scripted_read, scripted_write, nullptr};
const CO_OBJ_TYPE stream_type = {scripted_size, nullptr, scripted_read, scripted_write, scripted_reset};
const CO_OBJ_TYPE no_functions = {nullptr, nullptr, nullptr, nullptr, nullptr};
const CO_OBJ_TYPE no_size = {nullptr, nullptr, scripted_read, scripted_write, nullptr};
const CO_OBJ_TYPE no_read = {scripted_size, nullptr, nullptr, scripted_write, nullptr};
const CO_OBJ_TYPE no_write = {scripted_size, nullptr, scripted_read, nullptr, nullptr};

Setup scripted_setup() {
  script = Script{};
  return Setup()
      .with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &value_type, 0})
      .with({CO_KEY(0x3001, 0, CO_OBJ_____RW), &stream_type, 0})
      .with({CO_KEY(0x3002, 0, CO_OBJ_____RW), &no_functions, 0})
      .with({CO_KEY(0x3003, 0, CO_OBJ_____RW), &no_size, 0})
      .with({CO_KEY(0x3004, 0, CO_OBJ_____RW), &no_read, 0})
      .with({CO_KEY(0x3005, 0, CO_OBJ_____RW), &no_write, 0});
}

TEST_CASE("SDO abort 0601 0001h: read of a write-only object [SDO 04] [OD 04]") {
  Fixture node;
  node.ask("601#4030200000000000", "581#8030200001000106");
}

TEST_CASE("SDO abort 0601 0002h: write of a read-only object [SDO 03] [OD 03] [D16]") {
  Fixture node;
  node.ask("601#2300100000000000", "581#8000100002000106");
  node.ask("601#2331200000000000", "581#8031200002000106");
  node.ask("601#2131200004000000", "581#8031200002000106");
  node.ask("601#2031200000000000", "581#8031200002000106");
  node.ask("601#2300120151060000", "581#8000120102000106");
  node.ask("601#2300120251060000", "581#8000120202000106");
  node.ask("601#2F08100041000000", "581#8008100002000106");
  CHECK(node.objects.read_only == 0xCAFEBABE);
}

TEST_CASE("SDO abort 0601 0000h: object without any access") {
  Fixture node;
  node.ask("601#4032200000000000", "581#8032200000000106");
  node.ask("601#2332200000000000", "581#8032200000000106");
}

TEST_CASE("SDO abort 0602 0000h: no such index [SDO 06] [SDO 28-30]") {
  Fixture node(scripted_setup());
  node.ask("601#4004100000000000", "581#8004100000000206");
  node.ask("601#4004100500000000", "581#8004100500000206");
  node.ask("601#2304100000000000", "581#8004100000000206");
  node.ask("601#2104100004000000", "581#8004100000000206");
  node.ask("601#4000000000000000", "581#8000000000000206");
  node.ask("601#40FFFFFF00000000", "581#80FFFFFF00000206");
  node.ask("601#407F120100000000", "581#807F120100000206");
  node.ask("601#407F120000000000", "581#807F120000000206");
}

TEST_CASE("SDO abort 0609 0011h: the index exists, the sub-index does not [SDO 05]") {
  Fixture node;
  node.ask("601#4000100100000000", "581#8000100111000906");
  node.ask("601#4018100500000000", "581#8018100511000906");
  node.ask("601#2318100500000000", "581#8018100511000906");
  node.ask("601#401810FF00000000", "581#801810FF11000906");
}

TEST_CASE("SDO abort 0609 0011h: also if sub-index 0 is missing") {
  Fixture node;
  node.ask("601#4033200000000000", "581#8033200011000906");
  node.ask("601#4033200200000000", "581#8033200211000906");
  node.ask("601#4033200100000000", "581#4333200101010101");
}

TEST_CASE("SDO abort 0609 0030h: value not allowed") {
  Fixture node(scripted_setup());
  script.write = CO_ERR_OBJ_RANGE;
  node.ask("601#2300300000000000", "581#8000300030000906");
  node.ask("601#2F20200002000000", "581#8020200030000906");
}

TEST_CASE(
    "SDO abort 0504 0001h: an unknown command without transfer is aborted with its own bytes [D7] [D25] [SDO 07]") {
  Fixture node;
  node.ask("601#E0AABBCC11223344", "581#80AABBCC01000405");
  node.ask("601#FF010203FFFFFFFF", "581#8001020301000405");
}

TEST_CASE("SDO abort 0504 0001h: an unknown command within a transfer is aborted with its multiplexer [D7] [D25]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.ask("601#E0AABBCC11223344", "581#8008100001000405");
  node.ask("601#6011223300000000", "581#8011223301000405");
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.ask("601#E0AABBCC11223344", "581#8008200001000405");
  node.ask("601#0011223300000000", "581#8011223301000405");
}

TEST_CASE("SDO abort: each error code of a type function is sent as an abort code, for reading and writing") {
  struct Row {
    CO_ERR error;
    const char* code;
  };
  const Row rows[] = {
      {CO_ERR_OBJ_NOT_FOUND, "00000206"},    {CO_ERR_OBJ_SIZE, "10000706"},    {CO_ERR_OBJ_MAP_LEN, "42000406"},
      {CO_ERR_OBJ_MAP_TYPE, "41000406"},     {CO_ERR_OBJ_ACC, "00000106"},     {CO_ERR_OBJ_RANGE, "30000906"},
      {CO_ERR_OBJ_INCOMPATIBLE, "43000406"}, {CO_ERR_OBJ_STATE, "22000008"},   {CO_ERR_OBJ_NO_DATA, "24000008"},
      {CO_ERR_TYPE_RD, "20000008"},          {CO_ERR_TYPE_WR, "20000008"},     {CO_ERR_IF_NVM_READ, "00000606"},
      {CO_ERR_IF_NVM_WRITE, "00000606"},     {CO_ERR_IF_NVM_INIT, "00000606"}, {CO_ERR_PARA_STORE, "00000606"},
      {CO_ERR_PARA_RESTORE, "00000606"},     {CO_ERR_PARA_LOAD, "00000606"},   {CO_ERR_PARA_IDX, "00000606"},
      {CO_ERR_BAD_ARG, "47000406"},          {CO_ERR_NMT_MODE, "00000008"},    {CO_ERR_TPDO_EVENT, "00000008"},
  };
  for (const Row& row : rows) {
    CAPTURE(std::string(row.code));
    Fixture node(scripted_setup());
    script.read = script.write = row.error;
    const std::string expedited = std::string("581#80003000") + row.code;
    const std::string segmented = std::string("581#80013000") + row.code;
    node.ask("601#4000300000000000", expedited);
    node.ask("601#2300300000000000", expedited);
    script.size = 20;
    node.ask("601#2101300014000000", "581#6001300000000000");
    node.ask("601#0001020304050607", segmented);
    script.calls = 0;
    node.rx("601#4001300000000000");
    if (node.can.sent.size() == 1 && node.can.sent.front().frm.Data[0] == 0x41) {
      node.tx("581#4101300014000000");
      node.rx("601#6000000000000000");
    }
    node.tx(segmented);
  }
}

TEST_CASE("SDO abort: the application's own code is used expedited and only for that transfer") {
  Fixture node(scripted_setup());
  script.read = CO_ERR_TYPE_RD;
  script.write = CO_ERR_TYPE_WR;
  script.read_abort = script.write_abort = 0x12345678;
  node.ask("601#4000300000000000", "581#8000300078563412");
  node.ask("601#2300300000000000", "581#8000300078563412");
  script.read_abort = script.write_abort = 0;
  node.ask("601#4000300000000000", "581#8000300020000008");
  node.ask("601#2300300000000000", "581#8000300020000008");
}

TEST_CASE("SDO abort: a code of the application without an error has no effect at any time") {
  Fixture node(scripted_setup());
  script.write_abort = 0x12345678;
  node.ask("601#2300300000000000", "581#6000300000000000");
  node.ask("601#40FFFFFF00000000", "581#80FFFFFF00000206");
  script.write_abort = 0;
  script.write = CO_ERR_TYPE_WR;
  node.ask("601#2300300000000000", "581#8000300020000008");
}

TEST_CASE("SDO abort: the application's own code is used in segmented transfers of values") {
  Fixture node(scripted_setup());
  script.size = 8;
  script.read = CO_ERR_TYPE_RD;
  script.write = CO_ERR_TYPE_WR;
  script.read_abort = script.write_abort = 0x12345678;
  node.ask("601#2100300008000000", "581#6000300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1D08000000000000", "581#8000300078563412");
  node.ask("601#4000300000000000", "581#8000300078563412");
}

TEST_CASE("SDO abort: the application's own code is used in segmented transfers of streams at any segment") {
  for (unsigned segment = 1; segment <= 3; ++segment) {
    CAPTURE(segment);
    Fixture node(scripted_setup());
    script.size = 20;
    script.read = CO_ERR_TYPE_RD;
    script.write = CO_ERR_TYPE_WR;
    script.read_abort = script.write_abort = 0x12345678;
    script.fail_at_call = segment;
    const char* requests[] = {"601#0001020304050607", "601#1001020304050607", "601#0301020304050600"};
    const char* answers[] = {"581#2000000000000000", "581#3000000000000000", "581#2000000000000000"};
    node.ask("601#2101300014000000", "581#6001300000000000");
    for (unsigned i = 1; i < segment; ++i) {
      node.ask(requests[i - 1], answers[i - 1]);
    }
    node.ask(requests[segment - 1], "581#8001300078563412");
    node.ask("601#0011223300000000", "581#8011223301000405");
  }
}

TEST_CASE("SDO abort: the application's own code is used while a stream is read") {
  Fixture node(scripted_setup());
  script.size = 20;
  script.read = CO_ERR_TYPE_RD;
  script.read_abort = 0x12345678;
  script.fail_at_call = 2;
  node.ask("601#4001300000000000", "581#4101300014000000");
  node.ask("601#6000000000000000", "581#0055555555555555");
  node.ask("601#7000000000000000", "581#8001300078563412");
  node.ask("601#6011223300000000", "581#8011223301000405");
}

TEST_CASE("SDO abort: types without functions refuse the access") {
  Fixture node(scripted_setup());
  node.ask("601#4004300000000000", "581#8004300001000106");
  node.ask("601#2304300000000000", "581#6004300000000000");
  node.ask("601#2305300000000000", "581#8005300002000106");
  node.ask("601#4005300000000000", "581#4305300055555555");
  node.ask("601#4003300000000000", "581#8003300020000008");
  node.ask("601#2303300000000000", "581#8003300020000008");
}

CO_ERR refused_reset(CO_OBJ*, CO_NODE*, uint32_t) { return CO_ERR_OBJ_STATE; }

TEST_CASE("SDO abort: a stream that cannot be opened is refused at the initiate") {
  const CO_OBJ_TYPE type = {scripted_size, nullptr, scripted_read, scripted_write, refused_reset};
  Fixture node(scripted_setup().with({CO_KEY(0x3010, 0, CO_OBJ_____RW), &type, 0}));
  for (const std::uint32_t size : {3U, 20U}) {
    script.size = size;
    node.ask("601#4010300000000000", "581#8010300022000008");
    node.ask("601#2010300000000000", "581#8010300022000008");
    node.ask("601#E0AABBCC00000000", "581#80AABBCC01000405");
  }
  script.size = 4;
  node.ask("601#2310300000000000", "581#8010300022000008");
}

TEST_CASE("SDO abort 0800 0020h: a value whose length is 0") {
  Fixture node(scripted_setup());
  script.size = 0;
  node.ask("601#4000300000000000", "581#8000300020000008");
  node.ask("601#2300300000000000", "581#8000300020000008");
  node.ask("601#2100300004000000", "581#8000300020000008");
}

TEST_CASE("SDO abort: checks are ordered: index, access right, length, rule of the type") {
  Fixture node(scripted_setup());
  script.write = CO_ERR_OBJ_RANGE;
  node.ask("601#2F31200000000000", "581#8031200002000106");
  node.ask("601#2131200009000000", "581#8031200002000106");
  node.ask("601#2F00300000000000", "581#8000300013000706");
  node.ask("601#2100300005000000", "581#8000300012000706");
  node.ask("601#2F04100500000000", "581#8004100500000206");
  node.ask("601#2F31200100000000", "581#8031200111000906");
  CHECK(script.calls == 0);
}

TEST_CASE("SDO abort 0504 0000h: an abandoned transfer is aborted after the time-out, not before 7/8 of it [D18]") {
  for (const std::string initiate : {"601#4008200000000000", "601#2108200008000000", "601#4008100000000000"}) {
    CAPTURE(initiate);
    Fixture node;
    node.rx(initiate);
    node.frames();
    node.after(std::chrono::milliseconds{CO_SDO_TIMEOUT} * 7 / 8 - 1ms);
    node.silent();
    node.after(node.sdo_time_out() - std::chrono::milliseconds{CO_SDO_TIMEOUT} * 7 / 8 + 1ms);
    const std::string object = std::string(initiate).substr(6, 6);
    node.tx("581#80" + object + "00000405");
    node.ask("601#6001020300000000", "581#8001020301000405");
    node.after(2 * std::chrono::milliseconds{CO_SDO_TIMEOUT});
    node.silent();
  }
}

TEST_CASE("SDO abort 0504 0000h: each frame of the transfer restarts the time-out [D18]") {
  Fixture node;
  const auto nearly = std::chrono::milliseconds{CO_SDO_TIMEOUT} * 7 / 8 - 1ms;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.after(nearly);
  node.ask("601#6000000000000000", "581#004C65786963616E");
  node.after(nearly);
  node.ask("601#7000000000000000", "581#102074657374206E");
  node.after(nearly);
  node.ask("601#6000000000000000", "581#096F646500000000");
  node.after(2 * nearly);
  node.silent();
}

TEST_CASE("SDO abort 0504 0000h: unrelated frames do not restart the time-out [D18]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  std::vector<std::string> sent;
  for (int i = 0; i < 20; ++i) {
    node.after(node.sdo_time_out() / 20 + 1ms);
    for (const std::string& line : node.frames()) sent.push_back(line);
    node.rx("602#4008100000000000");
  }
  CHECK(sent == std::vector<std::string>{"581#8008100000000405"});
}

TEST_CASE("SDO abort: each one is counted") {
  Fixture node;
  const std::uint32_t before = node.counters().SdoAborts;
  node.ask("601#4004100000000000", "581#8004100000000206");
  node.ask("601#4030200000000000", "581#8030200001000106");
  node.rx("601#8008100000000405");
  CHECK(node.counters().SdoAborts == before + 2);
}

TEST_CASE("SDO: a write that resets the node is answered first [Q3]") {
  Fixture node(scripted_setup());
  node.frames_per_call(2);
  for (const CO_NMT_RESET reset : {CO_RESET_NODE, CO_RESET_COM}) {
    script.on_write = [reset](CO_NODE* n) { CONmtReset(&n->Nmt, reset); };
    node.rx("601#2300300000000000");
    node.tx({"581#6000300000000000", "701#00"});
    CHECK(node.mode() == CO_PREOP);
  }
}

TEST_CASE("SDO: a write that resets the node is answered first, even if the controller is busy [Q3]") {
  Fixture node(scripted_setup());
  node.frames_per_call(2);
  script.on_write = [](CO_NODE* n) { CONmtReset(&n->Nmt, CO_RESET_NODE); };
  node.can.refuse_next(3);
  node.rx("601#2300300000000000");
  node.loop();
  node.loop();
  node.loop();
  node.tx({"581#6000300000000000", "701#00"});
}

TEST_CASE("SDO: a write that stops the node leaves no frame and no open transfer [Q9]") {
  Fixture node(scripted_setup());
  script.on_write = [](CO_NODE* n) { CONmtSetMode(&n->Nmt, CO_STOP); };
  node.rx("601#2300300000000000");
  CHECK(node.mode() == CO_STOP);
  node.frames();
  node.rx("000#8001");
  node.ask("601#0011223300000000", "581#8011223301000405");
}

TEST_CASE("SDO: a write may access the dictionary [Q9]") {
  Fixture node(scripted_setup());
  node.may_change(0x2004, 0);
  script.on_write = [](CO_NODE* n) { CODictWrLong(&n->Dict, CO_DEV(0x2004, 0), 0x01020304); };
  node.ask("601#2300300000000000", "581#6000300000000000");
  node.ask("601#4004200000000000", "581#4304200004030201");
}

TEST_CASE("SDO: a write may change the heartbeat time [Q9]") {
  Fixture node(scripted_setup());
  node.may_change(0x1017, 0);
  script.on_write = [](CO_NODE* n) { CODictWrWord(&n->Dict, CO_DEV(0x1017, 0), 100); };
  node.ask("601#2300300000000000", "581#6000300000000000");
  node.after(100ms);
  node.tx("701#7F");
}

// Abort codes that an object type sets (COObjTypeUserSDOAbort()).

constexpr unsigned always = 1000;

struct UserAbort {
  std::uint32_t size = 4;
  std::uint32_t abort = 0;
  unsigned good_calls = 0;  // calls of Size that succeed before one fails
  unsigned calls = 0;
} user_abort;

CO_ERR refuse(CO_OBJ* obj, CO_NODE* node, CO_ERR error) {
  COObjTypeUserSDOAbort(obj, node, user_abort.abort);
  return error;
}

uint32_t refused_size(CO_OBJ* obj, CO_NODE* node, uint32_t) {
  if (user_abort.calls++ < user_abort.good_calls) {
    return user_abort.size;
  }
  refuse(obj, node, CO_ERR_NONE);
  return 0;
}

CO_ERR refused_read(CO_OBJ* obj, CO_NODE* node, void*, uint32_t) { return refuse(obj, node, CO_ERR_TYPE_RD); }
CO_ERR refused_write(CO_OBJ* obj, CO_NODE* node, void*, uint32_t) { return refuse(obj, node, CO_ERR_TYPE_WR); }

const CO_OBJ_TYPE type = {refused_size, nullptr, refused_read, refused_write, nullptr};

Setup with_abort(std::uint32_t size, std::uint32_t abort, unsigned good_calls) {
  user_abort = UserAbort{size, abort, good_calls, 0};
  return Setup().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &type, 0});
}

void check_idle(Fixture& node) { node.ask("601#0011223300000000", "581#8011223301000405"); }

TEST_CASE("SDO custom abort: FFFF FFFFh is sent like any other code") {
  for (const char* request : {"601#4000300000000000", "601#2300300001000000"}) {
    CAPTURE(std::string(request));
    Fixture node(with_abort(4, 0xFFFFFFFF, always));
    node.ask(request, "581#80003000FFFFFFFF");
    check_idle(node);
  }
  Fixture node(with_abort(8, 0xFFFFFFFF, always));
  node.ask("601#4000300000000000", "581#80003000FFFFFFFF");
  check_idle(node);
  node.ask("601#2100300008000000", "581#6000300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1D08000000000000", "581#80003000FFFFFFFF");
  check_idle(node);
}

TEST_CASE("SDO custom abort: set in the Size function at every kind of initiate") {
  for (const char* request : {"601#4000300000000000", "601#2300300001000000", "601#2200300001000000",
                              "601#2100300004000000", "601#2000300000000000"}) {
    CAPTURE(std::string(request));
    Fixture node(with_abort(4, 0x06060000, 0));
    node.ask(request, "581#8000300000000606");
    check_idle(node);
  }
}

TEST_CASE("SDO custom abort: set in the Size function at the last segment of a download of unknown length") {
  Fixture node(with_abort(8, 0x06060000, 1));
  node.ask("601#2000300000000000", "581#6000300000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.ask("601#1D08000000000000", "581#8000300000000606");
  check_idle(node);
}

#if USE_OBJ_EX && CO_SSDO_N > 1
TEST_CASE("SDO custom abort: every code but 0 is sent, in every kind of transfer") {
  for (const std::uint32_t code : {1U, 2U, 0x05040005U, 0x80000000U}) {
    CAPTURE(code);
    LoggedStream refusing;
    refusing.data = counting(20);
    refusing.on_piece = [&](CO_OBJ* obj, CO_NODE* node) {
      COObjTypeUserSDOAbort(obj, node, code);
      return CO_ERR_TYPE_WR;
    };
    CO_IF_FRM abort = frame("581#8000310000000000");
    CO_SET_LONG(&abort, code, 4);
    const std::string refused = notation(abort);
    Fixture node(Setup().only_small().with(refusing.extended(0x3100)));
    node.ask("601#4000310000000000", "581#4100310014000000");
    node.ask("601#6000000000000000", refused);
    node.ask("601#2100310014000000", "581#6000310000000000");
    node.ask("601#0001020304050607", refused);
    node.ask("601#230031000A0B0C0D", refused);
    check_idle(node);
#if USE_SDO_BLOCK
    refusing.data = counting(20);
    node.ask("601#A40031007F000000", "581#C600310014000000");
    node.ask("601#A300000000000000", refused);
    CO_IF_FRM accepted = frame("581#A400310000000000");
    CO_SET_BYTE(&accepted, CO_SDO_BUF_SEG, 4);
    node.ask("601#C200310007000000", notation(accepted));
    node.rx("601#8101020304050607");
    node.frames();
    node.ask("601#C100000000000000", refused);
    check_idle(node);
#endif
  }
}

// A node with an open transfer of its second SDO server, of an object whose type has an End function.
struct TwoTransfers : LoggedStream, Fixture {
  explicit TwoTransfers(CO_OBJ other)
      : Fixture(Setup().only_small().with(extended(0x3100)).with(other).before_init([](Objects& memory) {
          memory.sdo2_rx = 0x640;
          memory.sdo2_tx = 0x5C0;
        })) {
    data = counting(20);
    ask("640#4000310000000000", "5C0#4100310014000000");
  }
};

void end_other_transfers(CO_NODE* node) { CONmtSetMode(&node->Nmt, CO_STOP); }

TEST_CASE("SDO custom abort: set before or after the type function leaves the NMT state, it is the answer") {
  for (const bool before : {true, false}) {
    CAPTURE(before);
    LoggedStream refusing;
    refusing.data = {1, 2, 3, 4};
    refusing.on_piece = [&](CO_OBJ* obj, CO_NODE* node) {
      if (before) {
        COObjTypeUserSDOAbort(obj, node, 0x12345678);
      }
      end_other_transfers(node);
      if (!before) {
        COObjTypeUserSDOAbort(obj, node, 0x12345678);
      }
      return CO_ERR_TYPE_WR;
    };
    TwoTransfers node(refusing.value(0x3101));
    node.ask("601#2301310001020304", "581#8001310078563412");
    CHECK(node.log.back() == "end up 08000022");
    node.rx("000#8001");
    node.ask("601#4001310000000000", "581#8001310078563412");
  }
}

TEST_CASE(
    "SDO custom abort: set in End of a transfer that an initiate ends, it does not affect the answer to it [D8]") {
  LoggedStream refusing;
  refusing.data = {1, 2, 3, 4};
  refusing.on_piece = [](CO_OBJ*, CO_NODE*) { return CO_ERR_OBJ_RANGE; };
  TwoTransfers node(refusing.value(0x3101));
  node.on_end = [](CO_OBJ* obj, CO_NODE* of) {
    COObjTypeUserSDOAbort(obj, of, 0x12345678);
    return CO_ERR_TYPE_WR;
  };
  node.ask("640#2301310001020304", "5C0#8001310030000906");
  CHECK(node.log.back() == "end up 08000022");
}
#endif

#if USE_OD
TEST_CASE("SDO custom abort: set in an access of the application, it affects no SDO transfer") {
  LoggedStream refusing;
  refusing.data = {1, 2, 3, 4};
  Fixture node(Setup().only_small().with(refusing.value(0x3101)));
  const auto write = [&] {
    ODR_t result = ODR_OK;
    refusing.on_piece = [](CO_OBJ* obj, CO_NODE* of) {
      COObjTypeUserSDOAbort(obj, of, CO_SDO_ERR_RANGE_HIGH);
      return CO_ERR_OBJ_RANGE;
    };
    node.call([&] { result = OD_set_u32(OD_find(&node.od, 0x3101), 0, 5, false); });
    refusing.on_piece = nullptr;
    return result;
  };
  refusing.data = {1, 2, 3, 4};
  CHECK(write() == ODR_INVALID_VALUE);
  refusing.data = {1, 2, 3, 4};
  node.rx("601#4001310000000000");
  CHECK(node.frames().size() == 1);
  CHECK(write() == ODR_INVALID_VALUE);
}
#endif

}  // namespace
