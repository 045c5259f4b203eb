// SPDX-License-Identifier: Apache-2.0
// SDO client: 1280h written over the network. [301:7.5.2.34]
#include "support/restricted_ids.hpp"
#include "support/sdo_client_fixture.hpp"

#if USE_CSDO

namespace {

using namespace test;

ClientEntries off() {
  ClientEntries entries;
  entries.entry[0] = {0x80000000, 0x80000000, 5};
  return entries;
}

Setup small() { return Setup().only_small(); }

TEST_CASE("SDO client: 1280h made valid over the network is used from then on [D26]") {
  SdoClient node(small(), off());
  CHECK(COCSdoFind(&node.node, 0) == nullptr);
  node.ask("601#2380120105060000", "581#6080120100000000");
  CHECK(COCSdoFind(&node.node, 0) == nullptr);
  CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_SDO_OFF);
  node.ask("601#2380120285050000", "581#6080120200000000");
  REQUIRE(COCSdoFind(&node.node, 0) == node.csdo());
  CHECK(node.csdo()->State == CO_CSDO_STATE_IDLE);
  check_asks(node, "605", "585");
}

TEST_CASE("SDO client: 1280h switched off over the network disables the client [D26]") {
  SdoClient node;
  for (const char* entry : {"801201", "801202"}) {
    CAPTURE(std::string(entry));
    const std::string multiplexer = entry;
    const std::string id = multiplexer[5] == '1' ? "05060000" : "85050000";
    node.ask("601#23" + multiplexer + "00000080", "581#60" + multiplexer + "00000000");
    CHECK(COCSdoFind(&node.node, 0) == nullptr);
    CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_SDO_OFF);
    node.ask("601#23" + multiplexer + id, "581#60" + multiplexer + "00000000");
    check_asks(node, "605", "585");
  }
}

TEST_CASE("SDO client: the CAN-IDs of 1280h can be changed only from and to invalid [301:7.5.2.34]") {
  SdoClient node;
  node.ask("601#2380120106060000", "581#8080120130000906");
  node.ask("601#2380120286050000", "581#8080120230000906");
  node.ask("601#2380120105060000", "581#6080120100000000");
  check_asks(node, "605", "585");
  node.ask("601#2380120106060080", "581#6080120100000000");
  node.ask("601#2380120106060000", "581#6080120100000000");
  check_asks(node, "606", "585");
}

TEST_CASE("SDO client: the node-ID of the server, written over the network, is added to COB-IDs 600h and 580h") {
  ClientEntries entries;
  entries.entry[0] = {0x600, 0x580, 5};
  SdoClient node(small(), entries);
  check_asks(node, "605", "585");
  node.ask("601#2F80120309000000", "581#6080120300000000");
  check_asks(node, "609", "589");
  CHECK(node.csdo()->NodeId == 9);
}

// CiA 301 reserves 581h…5FFh and 601h…67Fh for the default SDO servers, which are those that a client uses.
// [301:7.3.5] [D26]
TEST_CASE("SDO client: 1280h accepts the CAN-IDs of servers and no other restricted ones [D26]") {
  const auto of_servers = [](unsigned sub, unsigned id) {
    return sub == 1 ? id >= 0x601 && id <= 0x67F : id >= 0x581 && id <= 0x5FF;
  };
  SdoClient node(small(), off());
  for (const unsigned sub : {1U, 2U}) {
    for (unsigned id = 0; id < 0x800; id += stride(31)) {
      CAPTURE(sub);
      CAPTURE(id);
      CO_IF_FRM write = frame(sub == 1 ? "601#2380120100000000" : "601#2380120200000000");
      CO_SET_LONG(&write, id, 4);
      node.rx(write);
      const std::vector<std::string> sent = node.frames();
      REQUIRE(sent.size() == 1);
      const std::string object = sub == 1 ? "801201" : "801202";
      const bool refused = is_forbidden(id) && !of_servers(sub, id);
      CHECK(sent[0] == "581#" + (refused ? "80" + object + "30000906" : "60" + object + "00000000"));
      CO_SET_BYTE(&write, 0x80, 7);
      node.rx(write);
      node.frames();
    }
  }
}

TEST_CASE("SDO client: a CAN-ID of 1280h above 7FFh needs bit 29") {
  SdoClient node(small(), off());
  node.ask("601#2380120105160000", "581#8080120130000906");
  node.ask("601#2380120105160020", "581#6080120100000000");
  node.ask("601#2380120285150020", "581#6080120200000000");
  check_asks(node, "00001605", "00001585");
}

// A write to 1280h during a transfer, and its response.
struct Change {
  const char* what;
  const char* request;
  const char* answer;
};

constexpr Change changes[] = {
    {"sub 1 invalid", "601#2380120100000080", "581#6080120100000000"},
    {"sub 2 invalid", "601#2380120200000080", "581#6080120200000000"},
};

TEST_CASE("SDO client: switching its COB-IDs off ends a transfer with 0800 0022h after the answer [Q3]") {
  for (const Change& change : changes) {
    CAPTURE(std::string(change.what));
    SdoClient node;
    node.start_upload(0x2000, 5, 28);
    node.tx("605#4000200500000000");
    node.rx("585#410020050E000000");
    node.tx("605#6000000000000000");
    node.rx(change.request);
    node.tx({change.answer, "605#8000200522000008"});
    node.ended(CO_SDO_ERR_TOS_STATE);
    CHECK(node.csdo()->State == CO_CSDO_STATE_INVALID);
    node.rx("585#0001020304050607");
    node.after(2000ms);
    node.silent();
  }
}

TEST_CASE("SDO client: NMT stop withdraws a queued abort of COB-IDs that were switched off [N8]") {
  for (const Change& change : changes) {
    CAPTURE(std::string(change.what));
    SdoClient node;
    node.start_upload(0x2000, 5, 28);
    node.tx("605#4000200500000000");
    node.can.refuse_all();
    node.rx(change.request);
    node.ended(CO_SDO_ERR_TOS_STATE);
    CHECK(node->TxQueue.Num == 2);
    node.rx("000#0201");
    CHECK(node->TxQueue.Num == 0);
    node.can.accept_all();
    node.loop();
    node.silent();
  }
}

TEST_CASE("SDO client: a node-ID of the server written during a transfer applies to the next request") {
  ClientEntries entries;
  entries.entry[0] = {0x600, 0x580, 5};
  SdoClient node(small(), entries);
  node.start_download(0x2000, 5, counted(5));
  node.tx("605#2100200505000000");
  node.ask("601#2F80120309000000", "581#6080120300000000");
  node.rx("585#6000200500000000");
  node.tx("605#0501020304050000");
  node.rx("585#2000000000000000");
  node.has_written();
  check_asks(node, "609", "589");
}

TEST_CASE("SDO client: writing the COB-IDs that 1280h already has does not end a transfer") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4);
  node.tx("605#4000200500000000");
  node.ask("601#2380120105060000", "581#6080120100000000");
  node.ask("601#2380120285050000", "581#6080120200000000");
  node.goes_on();
  node.rx("585#4F00200511000000");
  node.has_read({0x11});
}

#if CO_CSDO_N >= 2

TEST_CASE("SDO client: a change of 1280h does not end the transfer of 1281h") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4, 1000, 1);
  node.tx("606#4000200500000000");
  node.ask("601#2380120100000080", "581#6080120100000000");
  CHECK(COCSdoFind(&node.node, 0) == nullptr);
  CHECK(COCSdoFind(&node.node, 1) == node.csdo(1));
  node.goes_on(1);
  node.rx("586#4F00200511000000");
  node.has_read({0x11}, 1);
}

#endif

#if CO_SSDO_N >= 2

TEST_CASE("SDO client: a change of 1280h does not end a transfer of a server, nor one of 1201h that of a client") {
  SdoClient node;
  for (const unsigned index : {0x1280U, 0x1201U}) {
    for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}})
      node.may_change(static_cast<std::uint16_t>(index), sub);
  }
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.call([&] { CODictWrLong(&node->Dict, CO_DEV(0x1280, 1), 0x80000000); });
  node.ask("601#6000000000000000", "581#004C65786963616E");
  node.call([&] { CODictWrLong(&node->Dict, CO_DEV(0x1280, 1), 0x605); });
  node.start_upload(0x2000, 5, 4);
  node.tx("605#4000200500000000");
  node.call([&] { CODictWrLong(&node->Dict, CO_DEV(0x1201, 1), 0x690); });
  node.call([&] { CODictWrLong(&node->Dict, CO_DEV(0x1201, 2), 0x6A0); });
  node.goes_on();
  node.rx("585#4F00200511000000");
  node.has_read({0x11});
  node.ask("690#4000100000000000", "6A0#4300100091010F00");
}

#endif

}  // namespace

#endif
