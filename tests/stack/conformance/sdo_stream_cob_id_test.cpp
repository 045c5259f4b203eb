// SPDX-License-Identifier: Apache-2.0
// Types whose End function changes the COB-IDs of the SDO server of the transfer: the response uses the old COB-ID, the
// new ones become effective after it. [301:7.5.2.33]
#include <algorithm>

#include "support/logged_stream.hpp"

#if CO_SSDO_N >= 2 && USE_OBJ_EX

namespace {

using namespace test;

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

}  // namespace

#endif
