// SPDX-License-Identifier: Apache-2.0
// Transmission of multiplex PDOs. [301:7.2.3] Byte 0: node-ID, of the consumer if bit 7 is set, otherwise of the
// producer; bytes 1-2: index; byte 3: sub-index; bytes 4-7: data.
#include <cstring>

#include "support/mpdo_fixture.hpp"

#if CO_MPDO_N > 0 && CO_TPDO_N > 0

namespace {

using namespace test;

MpdoTable to_destination(std::uint16_t inhibit = 0) {
  MpdoTable table;
  table.tpdo[0].on(0x40000181, 255, {}).number = dam;
  table.tpdo[0].inhibit = inhibit;
  return table;
}

/// Returns a table with an object scanner list of 2211h:1, 2212h:1, 2214h:1, 2201h:1 and 2201h:2.
MpdoTable from_source(std::uint16_t inhibit = 0) {
  MpdoTable table;
  table.tpdo[0].on(0x40000181, 255, {}).number = sam;
  table.tpdo[0].inhibit = inhibit;
  table.scan = {0x01221101, 0, 0x01221201, 0x00221401, 0x02220101};
  return table;
}

const std::vector<std::string> all_objects = {"181#0111220111000000", "181#0112220111120000", "181#0114220111121314",
                                              "181#0101220111000000", "181#0101220221000000"};

bool was_sent(PdoNode& node, std::uint16_t num) {
  bool was = false;
  node.call([&] { was = COTPdoWasSent(&node.node, num); });
  return was;
}
bool was_sent(PdoNode& node, std::uint16_t index, std::uint8_t sub) {
  bool was = false;
  node.call([&] { was = COTPdoObjWasSent(&node.node, node.find(index, sub)); });
  return was;
}

void write(PdoNode& node, std::uint16_t index, std::uint8_t value) {
  node.may_change(index, 1);
  node.call([&] { (void)COObjWrValue(node.find(index, 1), &node.node, &value, 1); });
}

// Destination address mode --------------------------------------------------------------------------------------------

TEST_CASE("MPDO to a destination: address, multiplexer and data in eight bytes [301:7.2.3]") {
  MpdoNode node(to_destination());
  node.start();
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 0x01), 0x44332211) == CO_ERR_NONE);
  node.tx("181#8500620111223344");
  CHECK(node.send_to(0, 127, CO_DEV(0x1234, 0xFF), 0x80) == CO_ERR_NONE);
  node.tx("181#FF3412FF80000000");
  CHECK(node.send_to(0, 0, CO_DEV(0xFFFF, 0), 0) == CO_ERR_NONE);
  node.tx("181#80FFFF0000000000");
  CHECK(was_sent(node, 0));
  CHECK_FALSE(was_sent(node, 0));
}

TEST_CASE("MPDO to a destination: the result is the reason if nothing is sent") {
  MpdoTable table = to_destination();
  table.tpdo[1].on(0x40000281, 255, {0x22010108});
  MpdoNode node(table);
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 0) == CO_ERR_NMT_MODE);
  node.start();
  CHECK(node.send_to(0, 128, CO_DEV(0x6200, 1), 0) == CO_ERR_BAD_ARG);
  CHECK(node.send_to(0, 255, CO_DEV(0x6200, 1), 0) == CO_ERR_BAD_ARG);
  CHECK(node.send_to(CO_TPDO_N, 5, CO_DEV(0x6200, 1), 0) == CO_ERR_TPDO_NUM_TRIGGER);
  CHECK(node.send_to(1, 5, CO_DEV(0x6200, 1), 0) == CO_ERR_TPDO_MAP_OBJ);
  CHECK(node.send_to(2, 5, CO_DEV(0x6200, 1), 0) == CO_ERR_TPDO_COM_OBJ);
  CHECK(COTPdoSendTo(nullptr, 0, 5, CO_DEV(0x6200, 1), 0) == CO_ERR_BAD_ARG);
  node.rx("000#0201");
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 0) == CO_ERR_NMT_MODE);
  node.silent();
}

TEST_CASE("MPDO to a destination: a request within the inhibit time is refused and not sent later [X6]") {
  MpdoNode node(to_destination(100));  // 10 ms
  node.start();
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 1) == CO_ERR_NONE);
  CHECK(node.send_to(0, 6, CO_DEV(0x6200, 1), 2) == CO_ERR_TPDO_INHIBIT);
  node.after(9ms);
  CHECK(node.send_to(0, 6, CO_DEV(0x6200, 1), 3) == CO_ERR_TPDO_INHIBIT);
  node.tx("181#8500620101000000");
  node.after(2ms);
  node.silent();
  CHECK(node.send_to(0, 6, CO_DEV(0x6200, 1), 4) == CO_ERR_NONE);
  node.tx("181#8600620104000000");
}

TEST_CASE("MPDO to a destination: a queued frame is not replaced by one to another node") {
  MpdoNode node(to_destination());
  node.start();
  node.can.refuse_all();
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 1) == CO_ERR_NONE);
  CHECK(node.send_to(0, 6, CO_DEV(0x6200, 1), 2) == CO_ERR_NONE);
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 3) == CO_ERR_NONE);
  node.frames_per_call(4);
  node.can.accept_all();
  node.loop();
  node.tx({"181#8500620101000000", "181#8600620102000000", "181#8500620103000000"});
}

TEST_CASE("MPDO to a destination: a full transmit queue is reported and nothing is sent later") {
  MpdoNode node(to_destination(), [](Setup& setup) { setup.tx_queue(4); });
  node.start();
  node.can.refuse_all();
  unsigned taken = 0;
  while (taken < 10 && node.send_to(0, 5, CO_DEV(0x6200, 1), taken) == CO_ERR_NONE) {
    ++taken;
  }
  CHECK(taken == 2);  // half of the queue is reserved for the stack
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 9) == CO_ERR_IF_CAN_SEND);
  node.can.accept_all();
  node.frames_per_call(4);
  node.loop();
  node.tx({"181#8500620100000000", "181#8500620101000000"});
}

TEST_CASE("MPDO to a destination: it has no events, event timer, start value or remote requests") {
  MpdoTable table = to_destination();
  table.tpdo[0].cob_id = 0x181;
  table.tpdo[0].event = 10;
  MpdoNode node(table);
  node.start();
  node.after(100ms);
  CHECK(node.request(0) == CO_ERR_TPDO_EVENT);
  CHECK(node.set(0x1800, 5, 2, 20) == 0);
  node.after(100ms);
  node.rx("181#R");
  node.silent();
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 1) == CO_ERR_NONE);
  node.tx("181#8500620101000000");
  node.after(100ms);
  node.silent();
}

TEST_CASE("MPDO to a destination: COPdoTransmit may change the frame and leave Operational after it") {
  MpdoNode node(to_destination());
  node.start();
  callbacks().pdo_transmit = [](CO_IF_FRM* frm) { frm->Data[7] = 0xEE; };
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 1) == CO_ERR_NONE);
  node.tx("181#85006201010000EE");
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { CHECK(COTPdoSendTo(&node.node, 0, 6, 0, 0) == CO_ERR_TPDO_INHIBIT); };
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 1) == CO_ERR_NONE);
  node.tx("181#8500620101000000");
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { CONmtSetMode(&node.node.Nmt, CO_PREOP); };
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 1) == CO_ERR_NONE);
  node.tx("181#8500620101000000");
  CHECK(node.mode() == CO_PREOP);
  callbacks() = Callbacks{};
}

TEST_CASE("MPDO to a destination: several TPDOs each have their inhibit time") {
  if (fixture_tpdos < 2) {
    return;
  }
  MpdoTable table = to_destination(100);
  table.tpdo[1].on(0x40000281, 254, {}).number = dam;
  MpdoNode node(table);
  node.start();
  CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 1) == CO_ERR_NONE);
  CHECK(node.send_to(1, 5, CO_DEV(0x6200, 1), 2) == CO_ERR_NONE);
  CHECK(node.send_to(1, 5, CO_DEV(0x6200, 1), 3) == CO_ERR_NONE);
  node.tx({"181#8500620101000000", "281#8500620102000000", "281#8500620103000000"});
}

// Source address mode -------------------------------------------------------------------------------------------------

TEST_CASE("MPDO from a source: a request sends all objects of the scanner list in its order [301:7.5.2.39]") {
  MpdoNode node(from_source());
  node.frames_per_call(5);
  node.start();
  CHECK(node.request(0) == CO_ERR_NONE);
  CHECK(node.frames() == all_objects);
  node.trigger(0);
  CHECK(node.frames() == all_objects);
}

TEST_CASE("MPDO from a source: objects of 1 to 4 bytes are padded with 0 [301:7.2.3]") {
  MpdoTable table = from_source();
  table.scan = {0x01220101, 0x01220201, 0x01220301, 0x01220401, 0x01225401, 0x01225001};
  MpdoNode node(table, [](Setup& setup) { setup.node_id(0x7F); });
  node.frames_per_call(6);
  node.rx("000#017F");
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx({"181#7F01220111000000", "181#7F02220111120000", "181#7F03220111121300", "181#7F04220111121314",
           "181#7F5422010000803F", "181#7F50220100000000"});
}

TEST_CASE("MPDO from a source: a changed object with flag A is sent alone [301:7.2.3]") {
  MpdoNode node(from_source());
  node.start();
  write(node, 0x2211, 0x42);
  node.tx("181#0111220142000000");
  write(node, 0x2211, 0x42);
  node.silent();
  CHECK(node.set(0x2212, 1, 2, 0x4544) == 0);
  node.tx("181#0112220144450000");
  CHECK(node.set(0x2212, 2, 2, 0x4544) == 0);  // not in the object scanner list
  CHECK(node.set(0x2201, 1, 1, 0x77) == 0);    // without flag A
  node.silent();
}

TEST_CASE("MPDO from a source: an object that was removed from the list is not sent any more") {
  MpdoTable table = from_source();
  table.scan = {0x02221101};  // 2211h:1 and 2
  MpdoNode node(table);
  node.frames_per_call(5);
  node.start();
  CHECK(node.set(0x1FA0, 1, 4, 0x01221101) == 0);
  CHECK(node.set(0x2211, 2, 1, 0x42) == 0);
  node.silent();
  node.trigger_object(0x2211, 2);
  node.silent();
  CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#0111220111000000");
}

TEST_CASE("MPDO from a source: COTPdoTrigObj() sends the object") {
  MpdoNode node(from_source());
  node.start();
  node.trigger_object(0x2201, 2);
  node.tx("181#0101220221000000");
  CHECK(node.error() == CO_ERR_NONE);
  node.trigger_object(0x2201, 3);
  node.silent();
  CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
}

TEST_CASE("MPDO from a source: an object may also be mapped into other TPDOs") {
  MpdoTable table = from_source();
  table.tpdo[1].on(0x40000281, 255, {0x22110108, 0x22110208});
  MpdoNode node(table);
  node.start();
  write(node, 0x2211, 0x42);
  node.tx({"181#0111220142000000", "281#4221"});
}

TEST_CASE("MPDO from a source: a sent frame marks the PDO and its object as sent") {
  MpdoNode node(from_source());
  node.start();
  CHECK_FALSE(was_sent(node, 0));
  CHECK_FALSE(was_sent(node, 0x2211, 1));
  write(node, 0x2211, 0x42);
  CHECK(was_sent(node, 0));
  CHECK_FALSE(was_sent(node, 0));
  CHECK_FALSE(was_sent(node, 0x2212, 1));
  CHECK(was_sent(node, 0x2211, 1));
  CHECK_FALSE(was_sent(node, 0x2211, 1));
  node.frames();
}

TEST_CASE("MPDO from a source: frames keep the inhibit time; queued objects are sent with their current values [X6]") {
  MpdoNode node(from_source(100));  // 10 ms
  node.start();
  write(node, 0x2211, 0x42);
  node.tx("181#0111220142000000");
  write(node, 0x2211, 0x43);
  CHECK(node.set(0x2212, 1, 2, 0x4544) == 0);
  write(node, 0x2211, 0x44);
  node.silent();
  node.after(9ms);
  node.silent();
  node.after(50ms);
  CHECK(node.frames() == std::vector<std::string>{"181#0112220144450000", "181#0111220144000000"});
}

TEST_CASE("MPDO from a source: all objects are sent at intervals of the inhibit time [X6]") {
  MpdoNode node(from_source(100));
  node.start();
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx(all_objects[0]);
  node.after(100ms);
  for (unsigned n = 1; n < 5; ++n) {
    node.tx_at(std::chrono::milliseconds{10 * n}, all_objects[n]);
  }
  node.silent();
}

#if USE_SDO_BLOCK

TEST_CASE("MPDO from a source: a running block upload does not shorten the inhibit time [X6]") {
  MpdoNode node(from_source(100));
  node.start();
  node.ask("601#A008100014000000", "581#C608100011000000");
  write(node, 0x2211, 0x42);
  node.tx("181#0111220142000000");
  write(node, 0x2211, 0x43);
  node.can.refuse_all();
  node.rx("601#A300000000000000");
  node.silent();
  node.can.accept_all();
  node.frames_per_call(4);
  node.loop();
  node.tx({"581#014C65786963616E", "581#022074657374206E", "581#836F646500000000"});
  node.after(9ms);
  node.silent();
  node.after(1ms);
  node.tx("181#0111220143000000");
  node.ask("601#A203140000000000", "581#D100000000000000");
  node.rx("601#A100000000000000");
  node.silent();
}

#endif

TEST_CASE("MPDO from a source: the event timer sends all objects [X7]") {
  MpdoTable table = from_source();
  table.tpdo[0].event = 50;
  MpdoNode node(table);
  node.frames_per_call(5);
  node.start();
  node.after(50ms);
  if (CO_TPDO_ON_START == 0) {
    CHECK(node.frames() == all_objects);
  }
  node.frames();
  node.after(49ms);
  node.silent();
  node.after(1ms);
  CHECK(node.frames() == all_objects);
  CHECK(node.set(0x1800, 5, 2, 0) == 0);
  node.after(200ms);
  node.silent();
}

TEST_CASE("MPDO from a source: with event and inhibit time all objects are sent in rotation [X7]") {
  for (const std::uint16_t event : {std::uint16_t{5}, std::uint16_t{10}, std::uint16_t{25}}) {
    CAPTURE(event);
    MpdoTable table = from_source(100);
    table.tpdo[0].event = event;
    MpdoNode node(table);
    node.start();
    node.after(1000ms);
    const std::vector<std::string> sent = node.frames();
    for (const std::string& one : all_objects) {
      CHECK(std::count(sent.begin(), sent.end(), one) >= 15);
    }
    CHECK(sent.size() <= 101);
  }
}

TEST_CASE("MPDO from a source: objects are sent only in Operational; leaving it drops queued ones [X8]") {
  MpdoNode node(from_source(100));
  CHECK(node.request(0) == CO_ERR_NMT_MODE);
  write(node, 0x2211, 0x42);
  node.trigger_object(0x2212, 1);
  CHECK(node.error() == CO_ERR_NMT_MODE);
  node.start();
  node.after(100ms);
  node.silent();
  node.trigger_object(0x2214, 1);
  node.tx("181#0114220111121314");
  node.after(100ms);
  node.silent();
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#0101220111000000");
  node.rx("000#8001");
  node.after(100ms);
  node.start();
  node.after(100ms);
  node.silent();
}

TEST_CASE("MPDO from a source: changes outside Operational are not queued while the controller is busy") {
  if (USE_SDO_BLOCK == 0) {
    return;
  }
  MpdoNode node(from_source());
  unsigned calls = 0;
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { ++calls; };
  node.frames_per_call(8);
  write(node, 0x2211, 0x42);
  node.can.accept_next(2);
  node.rx("601#A000210F04000000");  // block upload of 15 bytes
  node.frames();
  node.rx("601#A300000000000000");
  node.can.accept_all();
  node.loop();
  node.loop();
  CHECK(calls == 0);
  node.frames();
  node.start();
  node.after(100ms);
  CHECK(calls == 0);
  node.frames();
  callbacks() = Callbacks{};
}

// Returns the action of the Size function of 22FFh.
std::function<void(CO_NODE*)>& size_action() {
  static std::function<void(CO_NODE*)> action;
  return action;
}

const CO_OBJ_TYPE* acting_type() {
  static const CO_OBJ_TYPE type = {[](CO_OBJ*, CO_NODE* node, std::uint32_t) -> std::uint32_t {
                                     if (size_action()) size_action()(node);
                                     return 1;
                                   },
                                   nullptr, [](CO_OBJ*, CO_NODE*, void*, std::uint32_t) { return CO_ERR_NONE; },
                                   nullptr, nullptr};
  return &type;
}

TEST_CASE("MPDO from a source: a Size function may leave Operational after the transmission") {
  for (const CO_MODE mode : {CO_PREOP, CO_STOP, CO_INVALID}) {
    CAPTURE(mode);
    MpdoTable table = from_source();
    table.scan = {0x0122FF01, 0x01220101};
    size_action() = nullptr;
    MpdoNode node(table, [](Setup& setup) { setup.with({CO_KEY(0x22FF, 1, CO_OBJ____PR_), acting_type(), 0}); });
    node.start();
    size_action() = [&](CO_NODE* it) { mode == CO_INVALID ? CONodeStop(it) : CONmtSetMode(&it->Nmt, mode); };
    CHECK(node.request(0) == CO_ERR_NONE);
    size_action() = nullptr;
    CHECK(node.mode() == mode);
    CHECK(node.error() == CO_ERR_NONE);
    mode == CO_INVALID ? node.silent() : node.tx({"181#01FF220100000000", "181#0101220111000000"});
  }
}

TEST_CASE("MPDO from a source: switching the PDO off or changing its list drops queued objects [X8]") {
  MpdoNode node(from_source(100));
  node.start();
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx(all_objects[0]);
  CHECK(node.set(0x1FA0, 1, 4, 0x01220108) == 0);
  node.after(100ms);
  node.silent();
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#0101220881000000");
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  node.after(100ms);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  node.after(100ms);
  node.silent();
  node.trigger_object(0x2201, 8);
  node.tx("181#0101220881000000");
}

TEST_CASE("MPDO from a source: an empty list sends nothing and is reported") {
  MpdoTable table = from_source();
  table.scan = {};
  MpdoNode node(table);
  node.start();
  CHECK(node.request(0) == CO_ERR_TPDO_OBJ_TRIGGER);
  node.silent();
}

TEST_CASE("MPDO from a source: remote requests are not answered") {
  MpdoTable table = from_source();
  table.tpdo[0].cob_id = 0x181;
  MpdoNode node(table);
  node.start();
  node.rx("181#R");
  node.silent();
}

TEST_CASE("MPDO from a source: refused frames are sent later with their current values") {
  MpdoNode node(from_source());
  node.frames_per_call(6);
  node.start();
  node.can.accept_next(2);
  CHECK(node.request(0) == CO_ERR_NONE);
  CHECK(node.frames() == std::vector<std::string>{all_objects[0], all_objects[1]});
  node.u8[1] = 0x99;
  node.loop();
  node.silent();
  node.can.accept_all();
  node.loop();
  CHECK(node.frames() == std::vector<std::string>{all_objects[2], all_objects[3], "181#0101220299000000"});
  CHECK(node.counters().Dropped == 0);
  node.loop();
  node.silent();
}

TEST_CASE("MPDO from a source: other frames are sent between its frames and none is lost, for any queue size") {
  MpdoTable table = from_source();
  table.tpdo[1].on(0x40000081, 255, {0x22010808});
  table.tpdo[1].cob_id = 0x40000182;
  for (std::uint64_t taken = 0; taken < 8; ++taken) {
    CAPTURE(taken);
    MpdoNode node(table, [](Setup& setup) { setup.tx_queue(4); });
    node.frames_per_call(8);
    node.start();
    node.can.accept_next(taken);
    CHECK(node.request(0) == CO_ERR_NONE);
    CHECK(node.request(1) == CO_ERR_NONE);
    node.can.accept_all();
    node.loop();
    node.loop();
    std::vector<std::string> sent = node.frames();
    CHECK(sent.size() == 6);
    CHECK(std::count(sent.begin(), sent.end(), "182#81") == 1);
    sent.erase(std::remove(sent.begin(), sent.end(), "182#81"), sent.end());
    CHECK(sent == all_objects);
    CHECK(node.counters().Dropped == 0);
  }
}

// Type functions and callbacks of the application ---------------------------------------------------------------------

std::uint32_t two_bytes(CO_OBJ*, CO_NODE*, std::uint32_t) { return 2; }

template <CO_ERR result>
CO_ERR give(CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t size) {
  const std::uint16_t value = 0x1234;
  std::memcpy(buffer, &value, size);
  return result;
}

const CO_OBJ_TYPE giving = {two_bytes, nullptr, give<CO_ERR_NONE>, nullptr, nullptr};
const CO_OBJ_TYPE failing = {two_bytes, nullptr, give<CO_ERR_TYPE_RD>, nullptr, nullptr};

TEST_CASE("MPDO from a source: an application-defined type is called locked, with a value in CPU byte order [X10]") {
  MpdoTable table = from_source();
  table.scan = {0x01226001};
  MpdoNode node(table, [](Setup& setup) { setup.with({CO_KEY(0x2260, 1, CO_OBJ____PR_), &giving, 0}); });
  node.start();
  std::string log;
  callbacks().od_lock = [&] { log += "lock "; };
  callbacks().od_unlock = [&] { log += "unlock "; };
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { log += "transmit "; };
  CHECK(node.request(0) == CO_ERR_NONE);
  CHECK(log == "lock unlock transmit ");
  node.tx("181#0160220134120000");
  callbacks() = Callbacks{};
}

TEST_CASE("MPDO from a source: an object that cannot be read is not sent; the others are [X12]") {
  MpdoTable table = from_source();
  table.scan = {0x01220101, 0x01226001, 0x01220102};
  MpdoNode node(table, [](Setup& setup) { setup.with({CO_KEY(0x2260, 1, CO_OBJ____PR_), &failing, 0}); });
  node.frames_per_call(2);
  node.start();
  CHECK(node.request(0) == CO_ERR_TYPE_RD);
  CHECK(node.error() == CO_ERR_TYPE_RD);
  node.tx({"181#0101220111000000", "181#0101220221000000"});
  node.loop();
  node.after(10ms);
  node.silent();
}

TEST_CASE("MPDO from a source: an object that cannot be read starts no inhibit time") {
  MpdoTable table = from_source(100);
  table.scan = {0x01226001, 0x01220102};
  MpdoNode node(table, [](Setup& setup) { setup.with({CO_KEY(0x2260, 1, CO_OBJ____PR_), &failing, 0}); });
  node.start();
  CHECK(node.request(0) == CO_ERR_TYPE_RD);
  node.tx("181#0101220221000000");
  node.after(100ms);
  node.silent();
}

unsigned reads = 0;

CO_ERR switch_off(CO_OBJ*, CO_NODE* node, void*, std::uint32_t) {
  ++reads;
  return CODictWrLong(&node->Dict, CO_DEV(0x1800, 1), 0xC0000181);
}

const CO_OBJ_TYPE ending = {two_bytes, nullptr, switch_off, nullptr, nullptr};

TEST_CASE("MPDO from a source: a Read function may switch the PDO off after the transmission") {
  MpdoTable table = from_source();
  table.scan = {0x02226001, 0x01220102};
  MpdoNode node(table, [](Setup& setup) {
    setup.with({CO_KEY(0x2260, 1, CO_OBJ____PR_), &ending, 0});
    setup.with({CO_KEY(0x2260, 2, CO_OBJ____PR_), &ending, 0});
  });
  node.may_change(0x1800, 1);
  node.start();
  unsigned calls = 0;
  reads = 0;
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { ++calls; };
  CHECK(node.request(0) == CO_ERR_NONE);
  CHECK(calls == 3);
  CHECK(reads == 2);
  node.tx({"181#0160220100000000", "181#0160220200000000", "181#0101220221000000"});
  CHECK(node.request(0) == CO_ERR_TPDO_COM_OBJ);
  callbacks() = Callbacks{};
}

TEST_CASE("MPDO from a source: an object whose frame is refused by a full queue is sent later") {
  MpdoNode node(from_source(), [](Setup& setup) { setup.tx_queue(4); });
  node.frames_per_call(8);
  node.start();
  callbacks().pdo_transmit = [&](CO_IF_FRM*) {
    node.can.refuse_all();
    for (std::uint32_t id = 0x700; id < 0x704; ++id) {
      CO_IF_FRM frm{id, {}, 0};
      (void)COIfCanSend(&node.node.If, &frm);
    }
  };
  node.trigger_object(0x2201, 2);
  CHECK(node.error() == CO_ERR_IF_CAN_SEND);
  callbacks() = Callbacks{};
  node.can.accept_all();
  node.loop();
  node.loop();
  const std::vector<std::string> sent = node.frames();
  CHECK(std::count(sent.begin(), sent.end(), "181#0101220221000000") == 1);
}

TEST_CASE("MPDO from a source: COPdoTransmit is called once for each frame, however often the controller refuses it") {
  MpdoNode node(from_source());
  node.frames_per_call(5);
  node.start();
  unsigned calls = 0;
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { ++calls; };
  node.can.refuse_all();
  CHECK(node.request(0) == CO_ERR_NONE);
  for (unsigned n = 0; n < 5; ++n) {
    node.loop();
  }
  node.can.accept_all();
  node.loop();
  CHECK(node.frames() == all_objects);
  CHECK(calls == 5);
  callbacks() = Callbacks{};
}

TEST_CASE("MPDO from a source: a callback that triggers more objects does not block other services") {
  MpdoNode node(from_source());
  node.frames_per_call(6);
  node.start();
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { (void)COTPdoRequest(&node.node, 0); };
  CHECK(node.request(0) == CO_ERR_NONE);
  CHECK(node.frames() == all_objects);
  for (unsigned n = 0; n < 3; ++n) {
    node.rx("601#4000100000000000");
    const std::vector<std::string> sent = node.frames();
    CHECK(std::count(sent.begin(), sent.end(), "581#4300100091010F00") == 1);
    CHECK(sent.size() <= 6);
  }
  callbacks() = Callbacks{};
  node.loop();
  node.frames();
  node.loop();
  node.silent();
}

TEST_CASE("MPDO from a source: a callback may switch the PDO off, change its list and stop the node") {
  for (unsigned what = 0; what < 4; ++what) {
    CAPTURE(what);
    MpdoNode node(from_source());
    node.may_change(0x1800, 1);
    node.may_change(0x1FA0, 1);
    node.may_change(0x1FA0, 3);
    node.frames_per_call(5);
    node.start();
    callbacks().pdo_transmit = [&](CO_IF_FRM*) {
      CO_DICT& dict = node.node.Dict;
      switch (what) {
        case 0: (void)CODictWrLong(&dict, CO_DEV(0x1800, 1), 0xC0000181); break;
        case 1: (void)CODictWrLong(&dict, CO_DEV(0x1FA0, 1), 0); break;
        case 2: CONmtSetMode(&node.node.Nmt, CO_STOP); break;
        default: CONodeStop(&node.node); break;
      }
    };
    (void)node.request(0);
    const std::vector<std::string> sent = node.frames();
    CHECK(sent.size() == (what == 1 ? 1 : what == 3 ? 0 : all_objects.size()));
    callbacks() = Callbacks{};
    if (what == 1) {
      CHECK(node.request(0) == CO_ERR_NONE);
      CHECK(node.frames() == std::vector<std::string>(all_objects.begin() + 1, all_objects.end()));
    }
  }
}

}  // namespace

#endif
