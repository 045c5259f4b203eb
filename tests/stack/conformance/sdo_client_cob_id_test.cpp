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

// SDO client: 1280h, and COCSdoFind(). [301:7.5.2.34]

ClientEntries first(std::uint32_t tx, std::uint32_t rx, std::uint8_t node_id) {
  ClientEntries entries;
  entries.entry[0] = {tx, rx, node_id};
  return entries;
}

void check_not_configured(SdoClient& node) {
  CHECK(COCSdoFind(&node.node, 0) == nullptr);
  CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_SDO_OFF);
  CHECK(node.try_download(0x2000, 5, {1}) == CO_ERR_SDO_OFF);
  node.silent();
  CHECK(node.ends.empty());
}

void check_off(SdoClient& node) {
  CHECK(node.csdo()->State == CO_CSDO_STATE_INVALID);
  CHECK(node.can.filter == std::vector<std::uint32_t>{0x000, 0x601, 0x701});
  check_not_configured(node);
}

TEST_CASE("SDO client: COCSdoFind returns the clients that 1280h and following configure") {
  SdoClient node;
  for (unsigned n = 0; n < CO_CSDO_N && n < 3; ++n) {
    CAPTURE(n);
    CO_CSDO* const csdo = COCSdoFind(&node.node, static_cast<std::uint8_t>(n));
    REQUIRE(csdo == &node->CSdo[n]);
    CHECK(csdo->State == CO_CSDO_STATE_IDLE);
    CHECK(csdo->NodeId == 5 + n);
    CHECK(COCSdoGetNum(csdo) == 0);
    CHECK(COCSdoGetTotal(csdo) == 0);
  }
  const auto* const memory = reinterpret_cast<const std::uint8_t*>(&node.node);
  const Bytes before(memory, memory + sizeof node.node);
  CHECK(COCSdoFind(&node.node, CO_CSDO_N) == nullptr);
  CHECK(COCSdoFind(&node.node, 255) == nullptr);
  CHECK(Bytes(memory, memory + sizeof node.node) == before);
  CHECK(COCSdoFind(nullptr, 0) == nullptr);
}

TEST_CASE("SDO client: COCSdoFind returns a busy client") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4);
  node.tx("605#4000200500000000");
  REQUIRE(COCSdoFind(&node.node, 0) == node.csdo());
  CHECK(node.csdo()->State == CO_CSDO_STATE_BUSY);
  node.rx("585#4F00200511000000");
  node.has_read({0x11});
  CHECK(node.csdo()->State == CO_CSDO_STATE_IDLE);
}

TEST_CASE("SDO client: without 1280h there is no client") {
  Fixture node(small());
  for (unsigned n = 0; n < CO_CSDO_N; ++n) {
    CHECK(COCSdoFind(&node.node, static_cast<std::uint8_t>(n)) == nullptr);
    CHECK(node->CSdo[n].State == CO_CSDO_STATE_INVALID);
  }
  std::uint8_t buffer[4];
  const auto ignore = [](CO_CSDO*, std::uint16_t, std::uint8_t, std::uint32_t) {};
  CHECK(COCSdoRequestUpload(&node->CSdo[0], CO_DEV(0x2000, 5), buffer, 4, ignore, 0) == CO_ERR_SDO_OFF);
  CHECK(COCSdoRequestDownload(&node->CSdo[0], CO_DEV(0x2000, 5), buffer, 4, ignore, 0) == CO_ERR_SDO_OFF);
  CHECK(COCSdoCancel(&node->CSdo[0]) == CO_ERR_SDO_OFF);
}

TEST_CASE("SDO client: null pointers and a size of 0 are refused with CO_ERR_BAD_ARG, and nothing is sent") {
  SdoClient node;
  CO_CSDO* const csdo = node.csdo();
  std::uint8_t buffer[4] = {};
  const auto ignore = [](CO_CSDO*, std::uint16_t, std::uint8_t, std::uint32_t) {};
  for (const auto request : {COCSdoRequestUpload, COCSdoRequestDownload}) {
    node.call([&] {
      CHECK(request(nullptr, CO_DEV(0x2000, 5), buffer, 4, ignore, 100) == CO_ERR_BAD_ARG);
      CHECK(request(csdo, CO_DEV(0x2000, 5), nullptr, 4, ignore, 100) == CO_ERR_BAD_ARG);
      CHECK(request(csdo, CO_DEV(0x2000, 5), buffer, 4, nullptr, 100) == CO_ERR_BAD_ARG);
      if (request == COCSdoRequestUpload) {
        CHECK(request(csdo, CO_DEV(0x2000, 5), buffer, 0, ignore, 100) == CO_ERR_BAD_ARG);
      }
    });
  }
  CHECK(COCSdoCancel(nullptr) == CO_ERR_BAD_ARG);
  CHECK(COCSdoGetNum(nullptr) == 0);
  CHECK(COCSdoGetTotal(nullptr) == 0);
  CHECK(csdo->State == CO_CSDO_STATE_IDLE);
  CHECK(node.armed_timers() == 0);
  node.silent();
}

TEST_CASE("SDO client: a request to a busy client is refused with CO_ERR_SDO_BUSY and does not disturb it") {
  SdoClient node;
  node.start_upload(0x2000, 5, 8);
  node.tx("605#4000200500000000");
  CHECK(node.try_upload(0x2001, 0, 4) == CO_ERR_SDO_BUSY);
  CHECK(node.try_download(0x2001, 0, {1, 2, 3, 4, 5, 6}) == CO_ERR_SDO_BUSY);
  node.silent();
  node.rx("585#4300200501020304");
  node.has_read({1, 2, 3, 4});
}

TEST_CASE("SDO client: requests are refused with CO_ERR_SDO_OFF in NMT states that forbid SDO [N3]") {
  SdoClient node(small().stay_in_init());
  CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_SDO_OFF);
  node.silent();
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  check_asks(node, "605", "585");
  node.rx("000#0101");
  check_asks(node, "605", "585");
  node.rx("000#0201");
  CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_SDO_OFF);
  CHECK(node.try_download(0x2000, 5, {1}) == CO_ERR_SDO_OFF);
  node.silent();
  node.rx("000#8001");
  check_asks(node, "605", "585");
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_SDO_OFF);
  node.silent();
}

TEST_CASE("SDO client: 1280h contains complete CAN-IDs for every node-ID in sub 3 [301:7.5.2.34]") {
  struct Case {
    std::uint32_t tx;
    std::uint32_t rx;
    std::uint8_t node_id;
    std::string request;
    std::string answer;
  };
  const Case cases[] = {{0x605, 0x585, 5, "605", "585"},           {0x67F, 0x5FF, 127, "67F", "5FF"},
                        {0x690, 0x6A0, 5, "690", "6A0"},           {0x603, 0x583, 5, "603", "583"},
                        {0x40000605, 0x40000585, 5, "605", "585"}, {0x6DF, 0x181, 127, "6DF", "181"},
                        {0x605, 0x20000585, 5, "605", "00000585"}};
  for (const Case& one : cases) {
    CAPTURE(one.request);
    CAPTURE(one.answer);
    SdoClient node(small().node_id(3), first(one.tx, one.rx, one.node_id));
    check_asks(node, one.request, one.answer);
    CHECK(node.csdo()->NodeId == one.node_id);
  }
}

TEST_CASE("SDO client: 1280h with bit 29 uses 29-bit CAN-IDs [301:7.5.2.34]") {
  SdoClient node(small(), first(0x20000605, 0x3FFFFFFF, 5));
  node.start_upload(0x2000, 5, 4);
  node.tx("00000605#4000200500000000");
  node.rx("585#4F00200511000000");
  node.rx("7FF#4F00200511000000");
  node.goes_on();
  node.rx("1FFFFFFF#4F00200511000000");
  node.has_read({0x11});
}

TEST_CASE("SDO client: 600h and 580h of a CANopen-Stack table get the node-ID of sub 3 added") {
  for (const unsigned id : {1U, 5U, 127U}) {
    CAPTURE(id);
    SdoClient node(small().node_id(3), first(0x600, 0x580, static_cast<std::uint8_t>(id)));
    CHECK(node.csdo()->NodeId == id);
    node.start_upload(0x2000, 5, 4);
    CO_IF_FRM request = frame("600#4000200500000000");
    request.Identifier += id;
    node.tx(notation(request));
    CO_IF_FRM answer = frame("580#4F00200511000000");
    node.rx(answer);
    node.goes_on();
    answer.Identifier += id;
    node.rx(answer);
    node.has_read({0x11});
  }
}

TEST_CASE("SDO client: 600h or 580h alone is a complete CAN-ID; the node-ID is added only to both") {
  SdoClient one(small(), first(0x600, 0x585, 7));
  check_asks(one, "600", "585");
  SdoClient two(small(), first(0x605, 0x580, 7));
  check_asks(two, "605", "580");
}

TEST_CASE("SDO client: COB-IDs relative to the own node-ID are complete CAN-IDs") {
  std::uint32_t tx = 0x602;
  std::uint32_t rx = 0x582;
  Fixture node(small()
                   .node_id(3)
                   .with({CO_KEY(0x1280, 1, CO_OBJ__N__RW), CO_TSDO_ID, &tx})
                   .with({CO_KEY(0x1280, 2, CO_OBJ__N__RW), CO_TSDO_ID, &rx})
                   .with({CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, 5}));
  std::uint8_t buffer[4] = {};
  const auto ignore = [](CO_CSDO*, std::uint16_t, std::uint8_t, std::uint32_t) {};
  node.call([&] { COCSdoRequestUpload(&node->CSdo[0], CO_DEV(0x2000, 5), buffer, 4, ignore, 0); });
  node.tx("605#4000200500000000");
  node.rx("585#4F00200511000000");
  CHECK(buffer[0] == 0x11);
}

TEST_CASE("SDO client: bit 31 of either COB-ID disables the client [301:7.5.2.34] [D26]") {
  for (const ClientEntries& entries : {first(0x80000605, 0x585, 5), first(0x605, 0x80000585, 5),
                                       first(0x80000605, 0x80000585, 5), first(0x80000600, 0x580, 5)}) {
    SdoClient node(small(), entries);
    for (unsigned n = 1; n < 3; ++n) node.entry[n].tx = 0x80000000;
    node.rx("000#8201");
    node.tx("701#00");
    check_off(node);
  }
}

#if !USE_CSDO_OWN
TEST_CASE("SDO client: without USE_CSDO_OWN a client whose server is the same node is not configured") {
  SdoClient node(small(), local_entries());
  check_not_configured(node);
  CHECK(node.csdo()->State == CO_CSDO_STATE_INVALID);
  node.after(2000ms);
  node.silent();
  node.entry[0] = {0x605, 0x585, 5};
  check_asks(node, "605", "585");
  node.entry[0].node_id = 1;
  check_not_configured(node);
}
#endif

TEST_CASE("SDO client: invalid CAN-IDs switch the client off, and nothing is sent at 000h") {
  struct Case {
    std::uint32_t tx;
    std::uint32_t rx;
    std::uint8_t node_id;
  };
  const Case cases[] = {{0, 0x585, 5},          {0x605, 0, 5},       {0x20000000, 0x585, 5},
                        {0x605, 0x40000000, 5}, {0x1605, 0x585, 5},  {0x605, 0x1585, 5},
                        {0x600, 0x580, 0},      {0x600, 0x580, 128}, {0x600, 0x580, 255}};
  for (const Case& one : cases) {
    CAPTURE(one.tx);
    CAPTURE(one.rx);
    CAPTURE(one.node_id);
    SdoClient node(small(), first(one.tx, one.rx, one.node_id));
    for (unsigned n = 1; n < 3; ++n) node.entry[n].tx = 0x80000000;
    node.rx("000#8201");
    node.tx("701#00");
    check_off(node);
  }
}

TEST_CASE("SDO client: a missing entry of 1280h leaves the client unconfigured [301:7.5.2.34]") {
  for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
    CAPTURE(sub);
    SdoClient node(small().without(0x1280, sub));
    check_not_configured(node);
    CHECK(node.csdo()->State == CO_CSDO_STATE_INVALID);
  }
  SdoClient bare(small().without(0x1280, 3), first(0x600, 0x580, 5));
  check_not_configured(bare);
}

TEST_CASE("SDO client: sub 0 of 1280h is not needed") {
  SdoClient node(small().without(0x1280, 0));
  check_asks(node, "605", "585");
}

TEST_CASE("SDO client: the entries are read at every request") {
  SdoClient node;
  check_asks(node, "605", "585");
  node.entry[0] = {0x600, 0x580, 9};
  check_asks(node, "609", "589");
  CHECK(node.csdo()->NodeId == 9);
  node.entry[0].node_id = 10;
  check_asks(node, "60A", "58A");
  CHECK(node.csdo()->NodeId == 10);
  node.entry[0].rx = 0x80000580;
  CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_SDO_OFF);
  node.silent();
  node.entry[0] = {0x606, 0x585, 10};
  check_asks(node, "606", "585");
}

TEST_CASE("SDO client: entries of 1280h written by the application apply to the next request") {
  SdoClient node(small(), first(0x600, 0x580, 5));
  node.start_upload(0x2000, 5, 4);
  node.tx("605#4000200500000000");
  node.entry[0].node_id = 9;
  node.rx("585#4F00200511000000");
  node.has_read({0x11});
  check_asks(node, "609", "589");
}

TEST_CASE("SDO client: the receive filter contains the response CAN-IDs of all clients") {
  SdoClient node;
  std::vector<std::uint32_t> expected = {0x000};
  for (unsigned n = 0; n < CO_CSDO_N && n < 3; ++n) expected.push_back(0x585 + n);
  expected.push_back(0x601);
  expected.push_back(0x701);
  CHECK(node.can.filter == expected);
}

TEST_CASE("SDO client: a reset configures 1280h and following again, with idle clients [N6]") {
  for (const char* command : {"000#8101", "000#8201"}) {
    SdoClient node;
    node.rx(command);
    node.tx("701#00");
    CHECK(node.csdo()->State == CO_CSDO_STATE_IDLE);
    check_asks(node, "605", "585");
  }
}

TEST_CASE("SDO client: frames for an idle client are not answered [C1]") {
  SdoClient node;
  for (unsigned command = 0; command < 256; ++command) {
    CO_IF_FRM frm = frame("585#0000200500000000");
    frm.Data[0] = static_cast<std::uint8_t>(command);
    node.rx(frm);
    node.silent();
  }
  CHECK(node.ends.empty());
  check_asks(node, "605", "585");
}

}  // namespace

#endif
