// SPDX-License-Identifier: Apache-2.0
// CONodeGetErr(): errors of calls of the application, of the platform and of the configuration. A refused request of an
// SDO client does not set an error.
#include "support/emcy_fixture.hpp"
#include "support/logged_stream.hpp"
#include "support/restricted_ids.hpp"
#include "support/sdo_client_fixture.hpp"

namespace {

using namespace test;

// Checks that the request is aborted and does not change the error of the node.
void check_refused(Fixture& node, const char* request) {
  for (const CO_ERR before : {CO_ERR_NONE, CO_ERR_NMT_MODE}) {
    CAPTURE(std::string(request));
    node->Error = before;
    node.rx(request);
    const std::vector<std::string> sent = node.frames();
    REQUIRE_FALSE(sent.empty());
    CHECK(sent.back().substr(0, 6) == "581#80");
    CHECK(node.error() == before);
  }
}

#if USE_EMCY
TEST_CASE("node error: refused requests to 1003h and 1014h do not set it") {
  EmcyNode node;
  for (const char* request : {"601#2F03100001000000",     // number of errors: only 0 may be written
                              "601#2303100101000000",     // an entry, which is read-only
                              "601#4003100100000000",     // an entry that is empty
                              "601#4003100900000000",     // an entry that does not exist
                              "601#2314100000000000",     // CAN-ID 000h
                              "601#2314100082000000"}) {  // another CAN-ID while it exists
    check_refused(node, request);
  }
  if (is_forbidden(0x601)) {
    check_refused(node, "601#2314100001060080");
  }
}
#endif

TEST_CASE("node error: requests refused by the SDO server do not set it") {
  Fixture node(Setup().only_small());
  for (const char* request : {"601#40DEADBE00000000", "601#4030200000000000", "601#2331200001000000",
                              "601#4032200000000000", "601#4001200900000000", "601#2B01200001000000",
                              "601#2F20200002000000", "601#6000000000000000", "601#E000000000000000"}) {
    check_refused(node, request);
  }
}

CO_ERR refuse(CO_OBJ*, CO_NODE*) { return CO_ERR_OBJ_RANGE; }
CO_ERR refuse_generally(CO_OBJ*, CO_NODE*) { return CO_ERR_OBJ_WRITE; }
CO_ERR refuse_with_code(CO_OBJ* obj, CO_NODE* node) {
  COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_RANGE_HIGH);
  return CO_ERR_TYPE_WR;
}

TEST_CASE("node error: an application-defined type that refuses a value or a segment does not set it") {
  for (CO_ERR (*const answer)(CO_OBJ*, CO_NODE*) : {refuse, refuse_generally, refuse_with_code}) {
    LoggedStream value;
    LoggedStream stream;
    value.data = {1, 2, 3, 4};
    stream.data = {1, 2, 3, 4};
    value.on_piece = answer;
    stream.on_piece = answer;
    Fixture node(Setup().only_small().with(value.value(0x3000)).with(stream.plain(0x3001)));
    for (const char* request :
         {"601#4000300000000000", "601#2300300001020304", "601#4001300000000000", "601#2301300001020304"}) {
      check_refused(node, request);
    }
    node.ask("601#2101300008000000", "581#6001300000000000");
    check_refused(node, "601#0001020304050607");
  }
}

#if USE_CSDO && USE_CSDO_OWN
TEST_CASE("node error: a refused request of an SDO client to its own node is reported only to its callback") {
  LoggedStream value;
  value.data = {1, 2, 3, 4};
  value.on_piece = refuse;
  SdoClient node(Setup().only_small().with(value.value(0x3000)), local_entries());
  node.start_upload(0x3000, 0, 4);
  node.after(10ms);
  node.ended(CO_SDO_ERR_RANGE);
  CHECK(node.error() == CO_ERR_NONE);
  node.start_download(0x3000, 0, counted(4));
  node.after(10ms);
  node.ended(CO_SDO_ERR_RANGE);
  CHECK(node.error() == CO_ERR_NONE);
}
#endif

TEST_CASE("node error: a transfer that failed with 0606 0000h sets it") {
  LoggedStream value;
  value.data = {1, 2, 3, 4};
  value.on_piece = [](CO_OBJ*, CO_NODE*) { return CO_ERR_IF_NVM_READ; };
  Fixture node(Setup().only_small().with(value.value(0x3000)));
  node.ask("601#4000300000000000", "581#8000300000000606");
  CHECK(node.error() == CO_ERR_SDO_READ);
  value.on_piece = [](CO_OBJ*, CO_NODE*) { return CO_ERR_IF_NVM_WRITE; };
  node.ask("601#2300300001020304", "581#8000300000000606");
  CHECK(node.error() == CO_ERR_SDO_WRITE);
  value.on_piece = [](CO_OBJ* obj, CO_NODE* of) {
    COObjTypeUserSDOAbort(obj, of, CO_SDO_ERR_HW_ACCESS);
    return CO_ERR_TYPE_WR;
  };
  node.ask("601#2300300001020304", "581#8000300000000606");
  CHECK(node.error() == CO_ERR_SDO_WRITE);
}

}  // namespace
