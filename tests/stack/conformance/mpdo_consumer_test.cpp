// SPDX-License-Identifier: Apache-2.0
// Reception of multiplex PDOs. [301:7.2.3] Byte 0: node-ID, of the consumer if bit 7 is set, otherwise of the producer;
// bytes 1-2: index; byte 3: sub-index; bytes 4-7: data.
#include <cstring>

#include "support/mpdo_fixture.hpp"

#if CO_MPDO_N > 0 && CO_RPDO_N > 0

namespace {

using namespace test;

MpdoTable to_destination() {
  MpdoTable table;
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    table.rpdo[n].on(0x201 + n * 0x100, 255, {}).number = dam;
  }
  return table;
}

MpdoTable from_source(std::initializer_list<std::uint64_t> entries) {
  MpdoTable table;
  std::copy(entries.begin(), entries.end(), table.dispatch.begin());
  table.rpdo[0].on(0x201, 255, {}).number = sam;
  return table;
}

bool was_received(PdoNode& node, std::uint16_t num) {
  bool was = false;
  node.call([&] { was = CORPdoWasReceived(&node.node, num); });
  return was;
}
bool was_received(PdoNode& node, std::uint16_t index, std::uint8_t sub) {
  bool was = false;
  node.call([&] { was = CORPdoObjWasReceived(&node.node, node.find(index, sub)); });
  return was;
}

// Destination address mode --------------------------------------------------------------------------------------------

TEST_CASE("MPDO destination: an object of 1 to 4 bytes is written from the first bytes of the data [301:7.2.3]") {
  MpdoNode node(to_destination());
  node.start();
  node.rx("201#81012201A1A2A3A4");
  CHECK(node.u8[0] == 0xA1);
  CHECK(node.u8[1] == 0x21);
  node.rx("201#81022203B1B2B3B4");
  CHECK(node.u16[2] == 0xB2B1);
  CHECK(node.u16[3] == 0x4241);
  node.rx("201#81032208C1C2C3C4");
  CHECK(node.u24[7] == 0xC3C2C1);
  node.rx("201#81042201D1D2D3D4");
  CHECK(node.u32[0] == 0xD4D3D2D1);
  node.rx("201#8154220100004841");
  CHECK(node.real32[0] == 12.5F);
  node.rx("201#8150220301000000");
  CHECK(node.boolean[2] == 1);
  node.silent();
}

TEST_CASE("MPDO destination: node-ID 0 addresses every node [301:7.2.3]") {
  MpdoNode node(to_destination(), [](Setup& setup) { setup.node_id(5); });
  node.rx("000#0105");
  node.rx("201#80012201A1000000");
  CHECK(node.u8[0] == 0xA1);
  node.rx("201#85012201A2000000");
  CHECK(node.u8[0] == 0xA2);
  node.rx("201#81012201A3000000");
  CHECK(node.u8[0] == 0xA2);
  node.silent();
}

TEST_CASE("MPDO destination: a frame for another node is ignored [301:7.2.3]") {
  MpdoTable table = to_destination();
  table.rpdo[0].event = 100;
  MpdoNode node(table);
  node.start();
  unsigned calls = 0;
  callbacks().pdo_receive = [&](CO_IF_FRM*) { return ++calls, std::int16_t{0}; };
  callbacks().pdo_update = [&](CO_RPDO*) { ++calls; };
  node.rx("201#82012201A1000000");
  node.rx("201#FFFFFFFFFFFFFFFF");
  CHECK(node.u8[0] == 0x11);
  CHECK(calls == 0);
  CHECK_FALSE(was_received(node, 0));
  CHECK(node.counters().Malformed == 0);
  node.after(200ms);  // frames to other nodes do not start the deadline
  node.silent();
}

TEST_CASE("MPDO destination: a frame with source addressing is malformed [301:7.2.3]") {
  MpdoNode node(to_destination());
  node.start();
  node.rx("201#01012201A1000000");
  node.rx("201#00012201A1000000");
  node.silent();
  CHECK(node.u8[0] == 0x11);
  CHECK(node.counters().Malformed == 2);
  CHECK_FALSE(was_received(node, 0));
}

TEST_CASE("MPDO destination: a missing object is reported with EMCY 8230h [301:7.2.7.1]") {
  const char* const frames[] = {
      "201#81003001A1000000",  // no such index
      "201#80012209A1000000",  // no such sub-index
      "201#81412201A1000000",  // not mappable
      "201#81212201A1000000",  // not writable by the network
      "201#81052201A1000000",  // 5 bytes
      "201#81082201A1000000",  // 8 bytes
      "201#81100100A1000000",  // COB-ID: not mappable
      "201#81050000A1000000",  // a static data type
      "201#81000000A1000000",
  };
  for (const char* const frame : frames) {
    CAPTURE(std::string(frame));
    MpdoNode node(to_destination());
    node.start();
    node.rx(frame);
    CHECK(node.frames() == reports({emcy(0x8230, 1)}));
    CHECK_FALSE(was_received(node, 0));
    CHECK(node.n8 == 0x11);
    CHECK(node.r8 == 0x11);
    CHECK(node.u40[0] == 0x1514131211);
    CHECK(node.u64[0] == 0x1817161514131211);
    CHECK(node.counters().Malformed == 0);
  }
}

TEST_CASE("MPDO destination: 8230h is sent once and resolved when an object is written [E1] [E2]") {
  MpdoNode node(to_destination());
  node.start();
  node.rx("201#8100300100000000");
  CHECK(node.frames() == reports({emcy(0x8230, 1)}));
  node.rx("201#8100300200000000");
  node.rx("201#8200300200000000");
  node.silent();
  node.rx("201#81012201A1000000");
  CHECK(node.frames() == reports({emcy(0, 1)}));
  node.rx("201#8000300100000000");
  CHECK(node.frames() == reports({emcy(0x8230, 1)}));
  node.rx("000#8001");
  CHECK(node.frames() == reports({emcy(0, 1)}));
  CHECK(node.objects.error_register == 0);
}

TEST_CASE("MPDO destination: faults of several PDOs are reported and resolved independently") {
  if (fixture_rpdos < 2) {
    return;
  }
  MpdoNode node(to_destination());
  node.start();
  node.rx("301#8100300100000000");
  CHECK(node.frames() == reports({emcy(0x8230, 2)}));
  node.rx("201#81012201A1000000");
  node.silent();
  CHECK(node.u8[0] == 0xA1);
  node.rx("301#81012202A2000000");
  CHECK(node.frames() == reports({emcy(0, 2)}));
  CHECK(node.u8[1] == 0xA2);
}

TEST_CASE("MPDO destination: frames of less than 8 bytes are not processed: EMCY 8210h [X5]") {
  for (std::uint8_t dlc = 0; dlc < 8; ++dlc) {
    CAPTURE(unsigned{dlc});
    MpdoNode node(to_destination());
    node.start();
    node.rx(CO_IF_FRM{0x201, {0x81, 0x01, 0x22, 0x01, 0xA1, 0, 0, 0}, dlc});
    CHECK(node.frames() == reports({emcy(0x8210, 1)}));
    CHECK(node.u8[0] == 0x11);
    CHECK(node.counters().Malformed == 1);
    node.rx("201#81012201A1000000");
    CHECK(node.frames() == reports({emcy(0, 1)}));
    CHECK(node.u8[0] == 0xA1);
  }
}

TEST_CASE("MPDO destination: frames are processed only in Operational [X9]") {
  MpdoNode node(to_destination());
  node.rx("201#81012201A1000000");
  node.rx("201#8100300100000000");
  node.rx("000#0201");
  node.rx("201#81012201A1000000");
  node.silent();
  CHECK(node.u8[0] == 0x11);
}

TEST_CASE("MPDO destination: transmission type 254 and a 29-bit CAN-ID work") {
  MpdoTable table;
  table.rpdo[0].on(0x20012345, 254, {}).number = dam;
  MpdoNode node(table);
  node.start();
  node.rx("00012345#81012201A1000000");
  CHECK(node.u8[0] == 0xA1);
}

TEST_CASE("MPDO destination: mapping entries are ignored while sub 0 is FFh [301:7.5.2.36]") {
  MpdoTable table = to_destination();
  table.rpdo[0].map = {0x22010108, 0x30000108, 0xFFFFFFFF};
  MpdoNode node(table);
  node.start();
  node.rx("201#81022201A1A20000");
  CHECK(node.u8[0] == 0x11);
  CHECK(node.u16[0] == 0xA2A1);
  CHECK(node.get(0x1600, 0) == 0xFF);
}

TEST_CASE("MPDO destination: a write marks the PDO and the written object as received") {
  MpdoNode node(to_destination());
  node.start();
  CHECK_FALSE(was_received(node, 0));
  node.rx("201#81012201A1000000");
  CHECK_FALSE(was_received(node, 0x2201, 2));
  CHECK(was_received(node, 0x2201, 1));
  CHECK_FALSE(was_received(node, 0x2201, 1));
  CHECK(was_received(node, 0));
  CHECK_FALSE(was_received(node, 0));
  node.rx("201#81012201A1000000");
  node.rx("201#81012202A2000000");
  CHECK_FALSE(was_received(node, 0x2201, 1));
  CHECK(was_received(node, 0x2201, 2));
}

TEST_CASE("MPDO destination: the deadline starts with a frame for this node [P11]") {
  MpdoTable table = to_destination();
  table.rpdo[0].event = 100;
  MpdoNode node(table);
  node.start();
  node.rx("201#81012201A1000000");
  node.after(90ms);
  node.rx("201#80012201A1000000");
  node.after(90ms);
  node.rx("201#82012201A1000000");
  node.silent();
  node.after(15ms);
  CHECK(node.frames() == reports({emcy(0x8250, 1)}));
  node.rx("201#81012201A1000000");
  CHECK(node.frames() == reports({emcy(0, 1)}));
}

TEST_CASE("MPDO destination: a changed object with flag A sends the TPDO that maps it") {
  MpdoTable table = to_destination();
  table.tpdo[0].on(0x40000181, 255, {0x22110108});
  MpdoNode node(table);
  node.start();
  node.rx("201#81112201A1000000");
  node.tx("181#A1");
  node.rx("201#81112201A1000000");
  node.silent();
}

// Type functions of the application -----------------------------------------------------------------------------------

std::vector<std::string>& log() {
  static std::vector<std::string> all;
  return all;
}

template <CO_ERR result>
CO_ERR note_write(CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t size) {
  const OutsideStack outside;
  std::uint16_t value = 0;
  std::memcpy(&value, buffer, sizeof value);
  log().push_back("write " + std::to_string(size) + " " + std::to_string(value));
  return result;
}

std::uint32_t two_bytes(CO_OBJ*, CO_NODE*, std::uint32_t) { return 2; }

const CO_OBJ_TYPE noted = {two_bytes, nullptr, nullptr, note_write<CO_ERR_NONE>, nullptr};
const CO_OBJ_TYPE refusing = {two_bytes, nullptr, nullptr, note_write<CO_ERR_OBJ_RANGE>, nullptr};

TEST_CASE("MPDO destination: an application-defined type is called locked, with a value in CPU byte order [X10]") {
  MpdoNode node(to_destination(), [](Setup& setup) { setup.with({CO_KEY(0x22FF, 0, CO_OBJ____P_W), &noted, 0}); });
  node.start();
  log().clear();
  callbacks().od_lock = [] { log().emplace_back("lock"); };
  callbacks().od_unlock = [] { log().emplace_back("unlock"); };
  callbacks().pdo_receive = [](CO_IF_FRM*) { return log().emplace_back("receive"), std::int16_t{0}; };
  callbacks().pdo_update = [](CO_RPDO*) { log().emplace_back("update"); };
  callbacks().pdo_sync_update = [](CO_RPDO*) { log().emplace_back("sync update"); };
  node.rx("201#81FF220034120000");
  CHECK(log() == std::vector<std::string>{"receive", "lock", "write 2 4660", "unlock", "update"});
  log().clear();
  node.rx("201#8100300000000000");
  CHECK(log() == std::vector<std::string>{"receive"});
  node.frames();
  callbacks() = Callbacks{};
}

TEST_CASE("MPDO destination: an entry of a static data type in the dictionary is not writable [301:7.4.1]") {
  MpdoNode node(to_destination(), [](Setup& setup) {
    setup.with({CO_KEY(0x0003, 0, CO_OBJ____PRW), &noted, 0});
    setup.with({CO_KEY(0x0005, 0, CO_OBJ____PRW), CO_TUNSIGNED8, 0});
  });
  node.start();
  log().clear();
  node.rx("201#81030000A1000000");
  CHECK(node.frames() == reports({emcy(0x8230, 1)}));
  node.rx("201#81050000A1000000");
  CHECK(log().empty());
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("MPDO destination: a write that the type refuses sets the node error and sends no EMCY") {
  MpdoNode node(to_destination(), [](Setup& setup) { setup.with({CO_KEY(0x22FF, 0, CO_OBJ____P_W), &refusing, 0}); });
  node.start();
  node.rx("201#81FF220034120000");
  CHECK(node.error() == CO_ERR_OBJ_RANGE);
  node.silent();
}

TEST_CASE("MPDO destination: COPdoReceive may consume or change the frame") {
  MpdoNode node(to_destination());
  node.start();
  callbacks().pdo_receive = [](CO_IF_FRM*) { return std::int16_t{1}; };
  node.rx("201#81012201A1000000");
  CHECK(node.u8[0] == 0x11);
  callbacks().pdo_receive = [](CO_IF_FRM* frm) { return frm->Data[3] = 2, std::int16_t{0}; };
  node.rx("201#81012201A1000000");
  CHECK(node.u8[0] == 0x11);
  CHECK(node.u8[1] == 0xA1);
  callbacks() = Callbacks{};
}

enum class Deed { stop, reset, off, remap };
Deed deed;

CO_ERR write_and_act(CO_OBJ*, CO_NODE* node, void*, std::uint32_t) {
  switch (deed) {
    case Deed::stop: CONmtSetMode(&node->Nmt, CO_STOP); break;
    case Deed::reset: CONmtReset(&node->Nmt, CO_RESET_COM); break;
    case Deed::off: (void)CODictWrLong(&node->Dict, CO_DEV(0x1400, 1), 0x80000201); break;
    case Deed::remap:
      (void)CODictWrLong(&node->Dict, CO_DEV(0x1400, 1), 0x80000201);
      (void)CODictWrByte(&node->Dict, CO_DEV(0x1600, 0), 0);
      (void)CODictWrByte(&node->Dict, CO_DEV(0x1600, 0), 1);
      (void)CODictWrLong(&node->Dict, CO_DEV(0x1400, 1), 0x201);
      break;
  }
  return CO_ERR_NONE;
}

const CO_OBJ_TYPE acting = {two_bytes, nullptr, nullptr, write_and_act, nullptr};

TEST_CASE("MPDO destination: a type function may stop or reset the node and change the PDO that is being processed") {
  for (const Deed what : {Deed::stop, Deed::reset, Deed::off, Deed::remap}) {
    CAPTURE(static_cast<int>(what));
    deed = what;
    MpdoTable table = to_destination();
    table.rpdo[0].map[0] = 0x22010108;
    MpdoNode node(table, [](Setup& setup) { setup.with({CO_KEY(0x22FF, 0, CO_OBJ____P_W), &acting, 0}); });
    for (unsigned sub = 0; sub <= 1; ++sub) {
      node.may_change(0x1600, static_cast<std::uint8_t>(sub));
      node.may_change(0x1400, static_cast<std::uint8_t>(sub));
    }
    node.start();
    node.rx("201#81FF220000000000");
    node.frames();
    CHECK(was_received(node, 0) == (what == Deed::stop));
    CHECK(node.mode() == (what == Deed::stop ? CO_STOP : what == Deed::reset ? CO_PREOP : CO_OPERATIONAL));
    node.rx("000#0101");
    node.frames();
    node.rx(what == Deed::remap ? "201#A1" : "201#81012201A1000000");
    CHECK(node.u8[0] == (what == Deed::off ? 0x11 : 0xA1));
    node.silent();
  }
}

// Source address mode -------------------------------------------------------------------------------------------------

TEST_CASE("MPDO source: the dispatching list selects the object that is written [301:7.5.2.40]") {
  MpdoNode node(from_source({0x0122010160000105, 0x0122020160000206, 0x0022040860010005}));
  node.start();
  node.rx("201#05006001A1A2A3A4");
  CHECK(node.u8[0] == 0xA1);
  node.rx("201#06006002B1B2B3B4");
  CHECK(node.u16[0] == 0xB2B1);
  node.rx("201#05016000C1C2C3C4");
  CHECK(node.u32[7] == 0xC4C3C2C1);
  CHECK(was_received(node, 0x2204, 8));
  CHECK_FALSE(was_received(node, 0x2202, 1));
  CHECK(was_received(node, 0));
  node.silent();
}

TEST_CASE("MPDO source: a frame without entry in the list is ignored [301:7.2.3]") {
  MpdoNode node(from_source({0x0122010160000105}));
  node.start();
  unsigned updates = 0;
  callbacks().pdo_update = [&](CO_RPDO*) { ++updates; };
  const char* const frames[] = {"201#06006001A1000000", "201#05006002A1000000", "201#05006000A1000000",
                                "201#05016001A1000000", "201#05005F01A1000000", "201#01012201A1000000"};
  for (const char* const frame : frames) {
    node.rx(frame);
  }
  node.silent();
  CHECK(updates == 0);
  CHECK(node.u8[0] == 0x11);
  CHECK(node.counters().Malformed == 0);
  CHECK_FALSE(was_received(node, 0));
}

TEST_CASE("MPDO source: destination addressing and the reserved node-ID 0 are malformed [301:7.2.3]") {
  MpdoNode node(from_source({0x0122010160000105}));
  node.start();
  node.rx("201#81012201A1000000");
  node.rx("201#85006001A1000000");
  node.rx("201#00006001A1000000");
  node.silent();
  CHECK(node.u8[0] == 0x11);
  CHECK(node.counters().Malformed == 3);
}

TEST_CASE("MPDO source: a block maps consecutive sub-indices of both nodes [301:7.5.2.40]") {
  MpdoNode node(from_source({0x032201036000FD05}));
  node.start();
  for (const char* const frame : {"201#050060FCA1000000", "201#050060FDA2000000", "201#050060FEA3000000",
                                  "201#050060FFA4000000", "201#05016000A5000000"}) {
    node.rx(frame);
  }
  CHECK(node.u8[1] == 0x21);
  CHECK(node.u8[2] == 0xA2);
  CHECK(node.u8[3] == 0xA3);
  CHECK(node.u8[4] == 0xA4);
  CHECK(node.u8[5] == 0x61);
  node.silent();
}

TEST_CASE("MPDO source: the first matching entry is used; unused entries before it are skipped [301:7.5.2.40]") {
  MpdoNode node(from_source({0, 0x0122010160000105, 0, 0x0122010260000105, 0, 0x0122010360000205}));
  node.start();
  node.rx("201#05006001A1000000");
  CHECK(node.u8[0] == 0xA1);
  CHECK(node.u8[1] == 0x21);
  node.rx("201#05006002A2000000");
  CHECK(node.u8[2] == 0xA2);
}

TEST_CASE("MPDO source: a change of the list applies from the next frame [301:7.5.2.40]") {
  MpdoNode node(from_source({0x0122010160000105}));
  node.start();
  CHECK(node.set(0x1FD0, 1, 8, 0x0122010260000105) == 0);
  node.rx("201#05006001A1000000");
  CHECK(node.u8[0] == 0x11);
  CHECK(node.u8[1] == 0xA1);
  CHECK(node.set(0x1FD1, 2, 8, 0x0122010360000205) == 0);
  node.rx("201#05006002A2000000");
  CHECK(node.u8[2] == 0xA2);
  CHECK(node.set(0x1FD0, 1, 8, 0) == 0);
  node.rx("201#05006001A3000000");
  CHECK(node.u8[1] == 0xA1);
}

TEST_CASE("MPDO source: several RPDOs use the dispatching list and may share a CAN-ID with other RPDOs") {
  if (fixture_rpdos < 3) {
    return;
  }
  MpdoTable table = from_source({0x0122010160000105, 0x0122010260000106});
  table.rpdo[1].on(0x301, 255, {}).number = sam;
  table.rpdo[2].on(0x201, 255, {}).number = dam;
  MpdoNode node(table);
  node.start();
  node.rx("201#05006001A1000000");
  node.rx("301#06006001A2000000");
  node.rx("201#81012203A3000000");
  CHECK(node.u8[0] == 0xA1);
  CHECK(node.u8[1] == 0xA2);
  CHECK(node.u8[2] == 0xA3);
  CHECK(node.counters().Malformed == 0);
  node.silent();
}

TEST_CASE("MPDO source: shorter frames are not processed: EMCY 8210h [X5]") {
  MpdoNode node(from_source({0x0122010160000105}));
  node.start();
  node.rx("201#05006001A10000");
  CHECK(node.frames() == reports({emcy(0x8210, 1)}));
  CHECK(node.u8[0] == 0x11);
}

TEST_CASE("MPDO: both kinds work after reset communication and reset node") {
  MpdoTable table = from_source({0x0122010160000105});
  table.rpdo[1].on(0x301, 254, {}).number = dam;
  MpdoNode node(table);
  for (const char* const command : {"000#8201", "000#8101"}) {
    node.rx(command);
    node.tx("701#00");
    node.start();
    node.rx("201#05006001A1000000");
    node.rx("301#81012202A2000000");
    CHECK(node.u8[0] == 0xA1);
    CHECK(node.u8[1] == 0xA2);
    node.u8[0] = node.u8[1] = 0;
  }
}

TEST_CASE("MPDO: CODictInit() with another table may change the kind of a PDO") {
  for (const bool multiplexed : {true, false}) {
    CAPTURE(multiplexed);
    MpdoTable table;
    table.rpdo[0].on(0x201, 255, {0x22010108});
    table.tpdo[0].on(0x40000181, 255, {0x22010208});
    (multiplexed ? table.rpdo : table.tpdo)[0].number = dam;
    MpdoNode node(table);
    node.start();
    std::vector<CO_OBJ> other(node.node.Dict.Root, node.node.Dict.Root + node.node.Dict.Num);
    std::uint8_t rpdo = multiplexed ? 1 : dam;
    std::uint8_t tpdo = multiplexed ? dam : 1;
    for (CO_OBJ& obj : other) {
      obj.Data = CO_GET_DEV(obj.Key) == CO_DEV(0x1600, 0) ? CO_DATA(&rpdo) : obj.Data;
      obj.Data = CO_GET_DEV(obj.Key) == CO_DEV(0x1A00, 0) ? CO_DATA(&tpdo) : obj.Data;
    }
    node.call(
        [&] { (void)CODictInit(&node.node.Dict, &node.node, other.data(), static_cast<std::uint16_t>(other.size())); });
    node.rx(multiplexed ? "201#A1" : "201#81012201A1000000");
    CHECK(node.u8[0] == 0xA1);
    if (multiplexed) {
      CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 0x42) == CO_ERR_NONE);
      node.tx("181#8500620142000000");
    } else {
      CHECK(node.request(0) == CO_ERR_NONE);
      node.tx("181#21");
    }
  }
}

TEST_CASE("MPDO: CODictInit() with another table finds the objects again") {
  MpdoTable table = from_source({0x0222010160000105});
  table.rpdo[1].on(0x301, 254, {}).number = dam;
  table.tpdo[0].on(0x40000181, 255, {}).number = sam;
  table.scan[0] = 0x02220103;
  MpdoNode node(table);
  node.start();
  std::vector<CO_OBJ> other(node.node.Dict.Root, node.node.Dict.Root + node.node.Dict.Num);
  other.insert(std::find_if(other.begin(), other.end(), [](const CO_OBJ& obj) { return obj.Key > 0x20000000; }),
               {CO_KEY(0x2000, 0, CO_OBJ_____R_), CO_TUNSIGNED8, CO_DATA(&node.u8[7])});
  node.call(
      [&] { (void)CODictInit(&node.node.Dict, &node.node, other.data(), static_cast<std::uint16_t>(other.size())); });
  node.rx("201#05006002A1000000");
  CHECK(node.u8[1] == 0xA1);
  node.rx("301#81012208A2000000");
  CHECK(node.u8[7] == 0xA2);
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx({"181#0101220331000000", "181#0101220441000000"});
}

}  // namespace

#endif
