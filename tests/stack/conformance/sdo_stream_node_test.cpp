// SPDX-License-Identifier: Apache-2.0
// Types with Begin and End (CO_OBJ_TYPE_EX) whose functions call functions of the node. [Q9]
#include <algorithm>
#include <iterator>

#include "support/block_frames.hpp"
#include "support/fixture.hpp"
#include "support/logged_stream.hpp"

namespace {

using namespace test;

#if USE_OBJ_EX

struct Stream : LoggedStream, Fixture {
  explicit Stream(Setup setup = {}) : Fixture(setup.only_small().with(extended(0x3000))) { data = counting(9); }
};

long count_ends(const Log& log) {
  return std::count_if(log.begin(), log.end(), [](const std::string& call) { return call[0] == 'e'; });
}

// Enters Stopped, which permits no SDO.
const auto stop_sdo = [](CO_OBJ*, CO_NODE* node) {
  CONmtSetMode(&node->Nmt, CO_STOP);
  return CO_ERR_NONE;
};
const auto stop_node = [](CO_OBJ*, CO_NODE* node) {
  CONodeStop(node);
  return CO_ERR_NONE;
};
const auto reset_node = [](CO_OBJ*, CO_NODE* node) {
  CONmtReset(&node->Nmt, CO_RESET_NODE);
  return CO_ERR_NONE;
};

TEST_CASE("SDO stream types: if Begin enters Stopped then End is called once, after the answer [Q9] [N8]") {
  for (const char* request : {"601#2100300014000000", "601#4000300000000000", "601#2B00300011220000"}) {
    CAPTURE(std::string(request));
    Stream node;
    node.on_begin = stop_sdo;
    node.rx(request);
    CHECK(node.frames().size() == 1);
    CHECK(node.mode() == CO_STOP);
    CHECK(count_ends(node.log) == 1);
    CHECK(node.log.back().substr(0, 3) == "end");
    node.rx("000#8001");
    node.on_begin = nullptr;
    node.data = counting(9);
    node.ask("601#4000300000000000", "581#4100300009000000");
  }
}

TEST_CASE("SDO stream types: if Begin calls CONodeStop then End is called once and no answer is sent [Q9]") {
  Stream node;
  node.on_begin = stop_node;
  node.rx("601#2100300014000000");
  node.silent();
  CHECK(count_ends(node.log) == 1);
  CHECK(node.mode() == CO_INVALID);
}

TEST_CASE("SDO stream types: if End requests a reset the download is answered before the reset [Q3] [Q9]") {
  Stream node;
  node.frames_per_call(2);
  node.on_end = reset_node;
  node.rx("601#2B00300011220000");
  node.tx({"581#6000300000000000", "701#00"});
  CHECK(count_ends(node.log) == 1);
}

TEST_CASE(
    "SDO stream types: if End enters Stopped it is called once before the answer, and CONodeStop prevents it [Q9] "
    "[N8]") {
  for (const bool stops_node : {false, true}) {
    Stream node;
    node.on_end = stops_node ? std::function<CO_ERR(CO_OBJ*, CO_NODE*)>(stop_node) : stop_sdo;
    node.ask("601#2100300002000000", "581#6000300000000000");
    node.rx("601#0B01020000000000");
    stops_node ? node.silent() : node.tx("581#2000000000000000");
    CHECK(count_ends(node.log) == 1);
  }
}

TEST_CASE("SDO stream types: Begin and End may access the dictionary including their own object [Q9]") {
  Stream node;
  node.may_change(0x2001, 0);
  const auto access_dictionary = [](CO_OBJ*, CO_NODE* stack) {
    std::uint32_t word = 0;
    CHECK(CODictRdLong(&stack->Dict, CO_DEV(0x1000, 0), &word) == CO_ERR_NONE);
    CHECK(CODictWrByte(&stack->Dict, CO_DEV(0x2001, 0), 0x77) == CO_ERR_NONE);
    CHECK(CODictRdLong(&stack->Dict, CO_DEV(0x3000, 0), &word) == CO_ERR_NONE);
    return CO_ERR_NONE;
  };
  node.on_begin = access_dictionary;
  node.on_end = access_dictionary;
  CHECK(node.download(0x3000, 0, counting(20)) == 0);
  CHECK(node.data == counting(20));
  CHECK(count_ends(node.log) == 1);
}

#if CO_SSDO_N >= 2

// Returns a node with a second SDO server at 690h/6A0h.
Setup two_channels() {
  return Setup().before_init([](Objects& o) {
    o.sdo2_rx = 0x690;
    o.sdo2_tx = 0x6A0;
  });
}

TEST_CASE("SDO stream types: a transfer on a second channel is refused with 0800 0022h and Begin is not called") {
  Stream node(two_channels());
  node.ask("601#4000300000000000", "581#4100300009000000");
  node.take_log();
  for (const char* request : {"690#4000300000000000", "690#2100300014000000", "690#2B00300011220000",
                              "690#A40030007F000000", "690#C600300014000000"}) {
    if (!USE_SDO_BLOCK && (request[4] == 'A' || request[4] == 'C')) continue;
    CAPTURE(std::string(request));
    node.ask(request, "6A0#8000300022000008");
  }
  CHECK(node.log.empty());
  node.ask("601#6000000000000000", "581#0001020304050607");
  node.ask("601#7000000000000000", "581#1B08090000000000");
  CHECK(node.take_log() == Log{"read 7", "read 2", "end up 0"});
  node.ask("690#2B00300011220000", "6A0#6000300000000000");
}

TEST_CASE("SDO stream types: End is called when the COB-IDs of the channel change [D16]") {
  Stream node(two_channels());
  node.ask("690#2100300014000000", "6A0#6000300000000000");
  node.take_log();
  node.ask("601#2301120190060080", "581#6001120100000000");
  CHECK(node.take_log() == Log{"end down 08000022"});
}

TEST_CASE("SDO stream types: End is called when its own channel is aborted and not when another one is") {
  Stream node(two_channels());
  node.ask("690#2100300014000000", "6A0#6000300000000000");
  node.take_log();
  node.ask("601#4000100000000000", "581#4300100091010F00");
  node.rx("601#8000300000000008");
  CHECK(node.log.empty());
  node.rx("690#8000300000000008");
  CHECK(node.take_log() == Log{"end down 08000000"});
}

#endif

#endif

// Types whose End function changes the COB-IDs of the SDO server of the transfer: the response uses the old COB-ID,
// the new ones become effective after it. [301:7.5.2.33]

#if CO_SSDO_N >= 2 && USE_OBJ_EX

// A node whose object 3000h has an End function that moves server 1201h from 690h/6A0h to 691h/6A1h.
struct Moving : LoggedStream, Fixture {
  CO_ERR result = CO_ERR_NONE;

  Moving()
      : Fixture(Setup().only_small().with(extended(0x3000)).before_init([](Objects& o) {
          o.sdo2_rx = 0x690;
          o.sdo2_tx = 0x6A0;
        })) {
    may_change(0x1201, 1);
    may_change(0x1201, 2);
    data = {1, 2, 3, 4, 5, 6, 7, 8};
    on_end = [this](CO_OBJ*, CO_NODE* moved) {
      write(*moved, 1, 0x691);
      write(*moved, 2, 0x6A1);
      return result;
    };
  }
  static void write(CO_NODE& to, std::uint8_t sub, std::uint32_t cob_id) {
    CHECK(CODictWrLong(&to.Dict, CO_DEV(0x1201, sub), 0x80000000) == CO_ERR_NONE);
    CHECK(CODictWrLong(&to.Dict, CO_DEV(0x1201, sub), cob_id) == CO_ERR_NONE);
  }
};

void check_has_moved(Moving& node, const std::string& end) {
  const Log log = node.take_log();
  CHECK(log.back() == end);
  CHECK(std::count_if(log.begin(), log.end(), [](const std::string& line) { return line.substr(0, 3) == "end"; }) == 1);
  node.rx("690#4000100000000000");
  node.silent();
  node.ask("691#4000100000000000", "6A1#4300100091010F00");
  node.ask("601#4000100000000000", "581#4300100091010F00");
}

struct Transfer {
  const char* name;
  std::vector<std::string> requests;  // all requests except the last one
  std::string last;
  std::string answer;  // response to the last request
};

const std::vector<Transfer>& downloads() {
  static const std::vector<Transfer> all = {
    {"expedited", {}, "690#2F00300011000000", "6A0#6000300000000000"},
    {"segmented", {"690#2100300008000000", "690#0001020304050607"}, "690#1D08000000000000", "6A0#3000000000000000"},
#if USE_SDO_BLOCK && CO_SDO_BUF_SEG >= 2
    {"block",
     {"690#C200300008000000", "690#0101020304050607", "690#8208000000000000"},
     "690#D900000000000000",
     "6A0#A100000000000000"},
#endif
  };
  return all;
}

void send_all_but_last(Fixture& node, const Transfer& transfer) {
  for (const std::string& request : transfer.requests) {
    node.rx(request);
    node.frames();
  }
}

TEST_CASE("SDO stream types: End writes the server's COB-IDs: the download is answered once with the old ones [Q3]") {
  for (const Transfer& transfer : downloads()) {
    CAPTURE(std::string(transfer.name));
    Moving node;
    send_all_but_last(node, transfer);
    node.ask(transfer.last, transfer.answer);
    check_has_moved(node, "end down 0");
  }
}

TEST_CASE("SDO stream types: End writes the server's COB-IDs and fails: one abort with the old ones [Q3]") {
  for (const Transfer& transfer : downloads()) {
    CAPTURE(std::string(transfer.name));
    Moving node;
    node.result = CO_ERR_OBJ_RANGE;
    send_all_but_last(node, transfer);
    node.ask(transfer.last, "6A0#8000300030000906");
    check_has_moved(node, "end down 0");
  }
}

TEST_CASE("SDO stream types: End writes the server's COB-IDs: the last segment of an upload has the old ones") {
  Moving node;
  node.ask("690#4000300000000000", "6A0#4100300008000000");
  node.ask("690#6000000000000000", "6A0#0001020304050607");
  node.ask("690#7000000000000000", "6A0#1D08000000000000");
  check_has_moved(node, "end up 0");
}

TEST_CASE("SDO stream types: End writes the server's COB-IDs after a time-out: the abort has the old ones [D18]") {
  Moving node;
  node.ask("690#2100300008000000", "6A0#6000300000000000");
  node.after(node.sdo_time_out());
  node.tx("6A0#8000300000000405");
  check_has_moved(node, "end down 05040000");
}

TEST_CASE(
    "SDO stream types: End writes the server's COB-IDs after an abort of the client, which is not answered [D6]") {
  Moving node;
  node.ask("690#2100300008000000", "6A0#6000300000000000");
  node.rx("690#8000300000000405");
  node.silent();
  check_has_moved(node, "end down 05040000");
}

TEST_CASE("SDO stream types: End writes the server's COB-IDs at a new initiate, which is answered first [D8]") {
  Moving node;
  node.ask("690#2100300008000000", "6A0#6000300000000000");
  node.ask("690#4000100000000000", "6A0#4300100091010F00");
  check_has_moved(node, "end down 08000022");
}

TEST_CASE("SDO stream types: End writes the server's COB-IDs: the transfer of the new initiate ends with them") {
  Moving node;
  node.ask("690#2100300008000000", "6A0#6000300000000000");
  node.ask("690#4008100000000000", "6A0#4108100011000000");
  node.ask("691#6000000000000000", "6A1#8000000001000405");
  check_has_moved(node, "end down 08000022");
}

TEST_CASE("SDO stream types: End is called by a write of the COB-IDs and writes others: the last ones are used [D16]") {
  Moving node;
  node.ask("690#2100300008000000", "6A0#6000300000000000");
  node.ask("601#2301120190060080", "581#6001120100000000");
  check_has_moved(node, "end down 08000022");
  CHECK(node.objects.sdo2_rx == 0x691);
  CHECK(node.objects.sdo2_tx == 0x6A1);
}

TEST_CASE("SDO stream types: End changes the COB-IDs: queued answers keep their old CAN-ID") {
  Moving node;
  node.can.refuse_all();
  node.rx("690#2F00300011000000");
  node.silent();
  node.can.accept_all();
  node.loop();
  node.tx("6A0#6000300000000000");
  check_has_moved(node, "end down 0");
}

TEST_CASE("SDO stream types: End changes the COB-IDs: a reset by the application sends queued answers first [N8]") {
  Moving node;
  node.can.refuse_all();
  node.rx("690#2F00300011000000");
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  node.can.accept_all();
  node.loop();
  node.tx({"6A0#6000300000000000", "701#00"});
}

TEST_CASE("SDO stream types: End changes the COB-IDs: NMT stop withdraws answers queued with the old CAN-ID [N8]") {
  Moving node;
  node.can.refuse_all();
  node.rx("690#2F00300011000000");
  CHECK(node->TxQueue.Num == 1);
  node.rx("000#0201");
  CHECK(node->TxQueue.Num == 0);
  node.can.accept_all();
  node.loop();
  node.silent();
}

#endif

// SDO downloads to read-only memory: the flags of the entries permit them, but the entries (flag D), their
// variables, strings and domains are constants. The application's Writable function refuses the writes, so that the
// server aborts with 0601 0000h. A write to this memory would crash the program.

const std::uint32_t constant = 0x44332211;
const std::uint8_t text_memory[8] = "rom";
CO_OBJ_STR_RW text{0, 3, 8, const_cast<std::uint8_t*>(text_memory)};
CO_OBJ_DOM domain{0, 8, const_cast<std::uint8_t*>(text_memory)};

const CO_OBJ table[] = {
    {CO_KEY(0x1017, 0, CO_OBJ_D___RW), CO_THB_PROD, 0},
    {CO_KEY(0x2000, 1, CO_OBJ_D___RW), CO_TUNSIGNED8, 0x11},
    {CO_KEY(0x2000, 2, CO_OBJ_D___RW), CO_TUNSIGNED16, 0x2211},
    {CO_KEY(0x2000, 3, CO_OBJ_DN__RW), CO_TUNSIGNED32, 0x180},
    {CO_KEY(0x2000, 4, CO_OBJ_D___RW), CO_TBOOLEAN, 0},
    {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TUNSIGNED32, &constant},
    {CO_KEY(0x2002, 0, CO_OBJ_____RW), CO_TVISIBLE_STRING, &text},
    {CO_KEY(0x2003, 0, CO_OBJ_____RW), CO_TDOMAIN, &domain},
    CO_OBJ_DICT_ENDMARK,
};

bool is_in(const void* address, const void* memory, std::size_t size) {
  const auto* byte = static_cast<const std::uint8_t*>(address);
  const auto* first = static_cast<const std::uint8_t*>(memory);
  return byte >= first && byte < first + size;
}

bool may_write(const void* address, std::uint32_t) {
  return !is_in(address, table, sizeof table) && !is_in(address, &constant, sizeof constant) &&
         !is_in(address, text_memory, sizeof text_memory);
}

class Device : public Fixture {
 public:
  Device() : Fixture(Setup().only_small().writable(may_write)) {
    call([this] { CHECK(CODictInit(&node.Dict, &node, const_cast<CO_OBJ*>(table), std::size(table)) >= 0); });
  }
};

TEST_CASE("SDO: a download to a value in a read-only dictionary (flags D and W) is refused and changes nothing [D16]") {
  Device node;
  node.ask("601#2F00200101000000", "581#8000200100000106");
  node.ask("601#2B00200201000000", "581#8000200200000106");
  node.ask("601#2300200381010000", "581#8000200300000106");
  node.ask("601#2F00200401000000", "581#8000200400000106");
  node.ask("601#2100200304000000", "581#6000200300000000");
  node.ask("601#0781010000000000", "581#8000200300000106");
  node.ask("601#4000200100000000", "581#4F00200111000000");
  node.ask("601#4000200200000000", "581#4B00200211220000");
  node.ask("601#4000200300000000", "581#4300200381010000");
  node.ask("601#4000200400000000", "581#4F00200400000000");
}

TEST_CASE("SDO: a download to 1017h in read-only memory is refused and starts no heartbeat [H1]") {
  Device node;
  node.ask("601#2B1710000A000000", "581#8017100000000106");
  node.after(100ms);
  node.silent();
  node.ask("601#4017100000000000", "581#4B17100000000000");
}

TEST_CASE("SDO: a download to a variable or string or domain in read-only memory is refused and changes nothing") {
  Device node;
  node.ask("601#2301200001020304", "581#8001200000000106");
  node.ask("601#2F02200041000000", "581#8002200000000106");
  node.ask("601#2F03200041000000", "581#8003200000000106");
  node.rx("601#2103200008000000");
  // The domain may be refused at the initiate or at the segment.
  if (!node.can.sent.empty() && node.can.sent.front().frm.Data[0] == 0x60) {
    node.tx("581#6003200000000000");
    node.rx("601#0041424344454647");
  }
  node.tx("581#8003200000000106");
  node.ask("601#4001200000000000", "581#4301200011223344");
  node.ask("601#4002200000000000", "581#47022000726F6D00");
}

}  // namespace
