// SPDX-License-Identifier: Apache-2.0
// SRDO producer. [EN 50325-5]
#include "support/srdo_fixture.hpp"

#if CO_SRDO_N > 1

namespace {

using namespace test;

SrdoTable sender(std::uint16_t cycle = 50) {
  SrdoTable table;
  table.srdo[0].send(0x109, pair_of_3);
  table.srdo[0].cycle = cycle;
  return table;
}

// Sets the data and its inverse.
void set_data(SrdoNode& node, std::uint8_t low, std::uint16_t high) {
  node.u8[0] = low;
  node.inverse8[0] = static_cast<std::uint8_t>(~low);
  node.u16[0] = high;
  node.inverse16[0] = static_cast<std::uint16_t>(~high);
}

#if CO_SRDO_GAP == 0

TEST_CASE("SRDO producer: the first pair is sent 0.5 ms times node-ID after the start [SR15]") {
  for (const std::uint8_t id :
       {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{5}, std::uint8_t{64}, std::uint8_t{127}}) {
    CAPTURE(id);
    SrdoNode node(sender(100), [&](Setup& setup) { setup.node_id(id).rate(10000); });
    set_data(node, 0x11, 0x3322);
    node.rx("000#0100");
    CHECK(node.state() == CO_SRDO_INITIALISING);
    node.silent();
    node.after(Time(500) * id);
    node.tx_at(Time(500) * id, "109#112233");
    node.tx_at(Time(500) * id, "10A#EEDDCC");
    CHECK(node.state() == CO_SRDO_ESTABLISHED);
    CHECK(node.take_changes() == std::vector<SrdoNode::Change>{{0, CO_SRDO_INITIALISING}, {0, CO_SRDO_ESTABLISHED}});
    node.silent();
  }
}

TEST_CASE("SRDO producer: pairs follow with the refresh time without drift [SR15]") {
  for (const std::uint32_t rate : clock_rates) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      SrdoNode node(sender(30), [&](Setup& setup) { setup.rate(rate).clock(start); });
      set_data(node, 1, 2);
      node.start();
      const std::uint64_t cycle = (std::uint64_t{30} * rate + 999) / 1000;
      node.after(Time(500) + Time(1000000 / rate + 1));
      CHECK(node.frames() == std::vector<std::string>{"109#010200", "10A#FEFDFF"});
      const std::uint64_t before = node.now();
      unsigned pairs = 0;
      for (unsigned n = 0; n < 1000; ++n) {
        node.after(Time(1000000 / rate + 1));
        pairs += static_cast<unsigned>(node.frames().size());
      }
      CHECK(pairs / 2 >= (node.now() - before) / cycle);
      CHECK(pairs / 2 <= (node.now() - before) / cycle + 1);
      CHECK(node.state() == CO_SRDO_ESTABLISHED);
    }
  }
}

TEST_CASE("SRDO producer: each pair has the values of its moment [SR15]") {
  SrdoNode node(sender());
  set_data(node, 0x11, 0x3322);
  node.start();
  node.after(1ms);
  node.tx({"109#112233", "10A#EEDDCC"});
  set_data(node, 0xFF, 0x0000);
  node.after(50ms);
  node.tx({"109#FF0000", "10A#00FFFF"});
  set_data(node, 0x00, 0xFFFF);
  node.after(50ms);
  node.tx({"109#00FFFF", "10A#FF0000"});
}

TEST_CASE("SRDO producer: eight bytes and placeholders [SR15]") {
  SrdoTable table;
  table.srdo[0].send(0x109, {0x23040120, 0x23050120, 0x00060010, 0x00030010, 0x23020110, 0x23030110});
  SrdoNode node(table);
  node.u32[0] = 0x44332211;
  node.inverse32[0] = 0xBBCCDDEE;
  node.u16[0] = 0x6655;
  node.inverse16[0] = 0x99AA;
  node.start();
  node.after(1ms);
  node.tx({"109#1122334400005566", "10A#EEDDCCBBFFFFAA99"});
}

TEST_CASE("SRDO producer: a request sends at once and the refresh time begins anew [SR16]") {
  SrdoNode node(sender());
  set_data(node, 1, 2);
  node.start();
  node.after(1ms);
  node.trace();
  node.after(30ms);
  CHECK(node.request() == CO_ERR_NONE);
  node.tx({"109#010200", "10A#FEFDFF"});
  node.after(49ms);
  node.silent();
  node.after(1ms);
  node.tx({"109#010200", "10A#FEFDFF"});
}

TEST_CASE("SRDO producer: a request before the first pair sends the first pair [SR16]") {
  SrdoNode node(sender(), [](Setup& setup) { setup.node_id(100); });
  set_data(node, 1, 2);
  node.rx("000#0100");
  CHECK(node.request() == CO_ERR_NONE);
  node.tx({"109#010200", "10A#FEFDFF"});
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
  node.after(49ms);
  node.silent();
}

TEST_CASE("SRDO producer: requests are refused for other states and directions [SR16]") {
  SrdoTable table = sender();
  table.srdo[1].receive(0x10B, {0x23000208, 0x23010208});
  SrdoNode node(table);
  CHECK(node.request() == CO_ERR_NMT_MODE);
  node.start();
  CHECK(node.request(1) == CO_ERR_OBJ_STATE);
  CHECK(node.request(2) == CO_ERR_OBJ_STATE);
  CHECK(node.request(CO_SRDO_N) == CO_ERR_BAD_ARG);
  CHECK(COSrdoRequest(nullptr, 0) == CO_ERR_BAD_ARG);
  node.u8[0] = 1;
  CHECK(node.request(0) == CO_ERR_OBJ_READ);
  CHECK(node.state() == CO_SRDO_ERR_TX_NOT_INVERSE);
  CHECK(node.request(0) == CO_ERR_OBJ_STATE);
  node.tx("081#0082110000011306");
}

TEST_CASE("SRDO producer: objects that are not inverse are not sent [SR17]") {
  unsigned wrong = 0;
  for (unsigned bit = 0; bit < 48; ++bit) {
    SrdoNode node(sender());
    node.start();
    node.after(1ms);
    node.trace();
    if (bit < 8)
      node.u8[0] = static_cast<std::uint8_t>(1U << bit);
    else if (bit < 24)
      node.u16[0] = static_cast<std::uint16_t>(1U << (bit - 8));
    else if (bit < 32)
      node.inverse8[0] = static_cast<std::uint8_t>(~(1U << (bit - 24)));
    else
      node.inverse16[0] = static_cast<std::uint16_t>(~(1U << (bit - 32)));
    node.after(50ms);
    const std::vector<std::string> sent = node.frames();
    wrong += sent == std::vector<std::string>{"081#0082110000011306"} ? 0U : 1U;
    wrong += node.state() == CO_SRDO_ERR_TX_NOT_INVERSE ? 0U : 1U;
    node.after(1s);
    wrong += node.frames().empty() ? 0U : 1U;
  }
  CHECK(wrong == 0);
}

TEST_CASE("SRDO producer: an error ends with Operational and the next start sends again [SR17]") {
  SrdoNode node(sender());
  node.u8[0] = 1;
  node.start();
  node.after(1ms);
  node.tx("081#0082110000011306");
  node.rx("000#8001");
  node.tx("081#0000000000011306");
  node.u8[0] = 0;
  node.start();
  node.after(1ms);
  node.tx({"109#000000", "10A#FFFFFF"});
}

TEST_CASE("SRDO producer: a queued frame is sent later but the next pair finds it and ends the SRDO [SR18]") {
  SrdoNode node(sender());
  node.start();
  node.can.refuse_all();
  node.after(1ms);
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
  node.after(49ms);
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
  node.after(1ms);
  CHECK(node.state() == CO_SRDO_ERR_SEND);
  node.can.accept_all();
  node.loop();
  node.tx("081#008211000001130A");  // the queued pair was withdrawn
}

TEST_CASE("SRDO producer: a short busy time delays the pair and keeps its order [SR18]") {
  SrdoNode node(sender());
  set_data(node, 1, 2);
  node.start();
  node.can.refuse_all();
  node.after(20ms);
  node.can.accept_all();
  node.loop();
  node.tx({"109#010200", "10A#FEFDFF"});
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
}

TEST_CASE("SRDO producer: a full transmit queue ends the SRDO [SR18]") {
  for (const std::uint16_t length : {std::uint16_t{1}, std::uint16_t{2}}) {
    SrdoNode node(sender(), [&](Setup& setup) { setup.tx_queue(length).heartbeat(1); });
    node.start();
    node.can.refuse_all();
    node.after(1ms);  // a heartbeat uses one element
    CHECK(node.state() == CO_SRDO_ERR_SEND);
    node.can.accept_all();
    node.after(1ms);
    for (const std::string& sent : node.frames()) {
      CHECK(sent.substr(0, 3) != "109");
      CHECK(sent.substr(0, 3) != "10A");
    }
  }
}

TEST_CASE("SRDO producer: leaving Operational ends transmission and withdraws queued frames [SR10]") {
  for (const char* command : {"000#8001", "000#0201"}) {
    SrdoNode node(sender());
    node.start();
    node.can.refuse_all();
    node.after(1ms);
    node.rx(command);
    node.can.accept_all();
    node.after(1s);
    node.silent();
    CHECK(node.state() == CO_SRDO_NOT_OPERATIONAL);
  }
}

TEST_CASE("SRDO producer: an object that cannot be read ends the SRDO [SR17]") {
  static const CO_OBJ_TYPE failing = {[](CO_OBJ*, CO_NODE*, std::uint32_t) { return std::uint32_t{1}; }, nullptr,
                                      [](CO_OBJ*, CO_NODE*, void*, std::uint32_t) { return CO_ERR_TYPE_RD; }, nullptr,
                                      nullptr};
  static std::uint8_t data = 0;
  SrdoTable table;
  table.srdo[0].send(0x109, {0x23110108, 0x23010108});
  SrdoNode node(table, [](Setup& setup) { setup.with({CO_KEY(0x2311, 1, CO_OBJ____PR_), &failing, &data}); });
  node.start();
  node.after(1ms);
  node.tx("081#008211000001130B");
  CHECK(node.state() == CO_SRDO_ERR_INTERNAL);
}

TEST_CASE("SRDO producer: a Read function may leave Operational, after the pair [SR17]") {
  static const CO_OBJ_TYPE leaving = {[](CO_OBJ*, CO_NODE*, std::uint32_t) { return std::uint32_t{1}; }, nullptr,
                                      [](CO_OBJ*, CO_NODE* of, void* buffer, std::uint32_t) {
                                        CONmtSetMode(&of->Nmt, CO_PREOP);
                                        *static_cast<std::uint8_t*>(buffer) = 0;
                                        return CO_ERR_NONE;
                                      },
                                      nullptr, nullptr};
  static std::uint8_t data = 0;
  SrdoTable table;
  table.srdo[0].send(0x109, {0x23110108, 0x23010108});
  SrdoNode node(table, [](Setup& setup) { setup.with({CO_KEY(0x2311, 1, CO_OBJ____PR_), &leaving, &data}); });
  node.start();
  node.after(100ms);
  node.tx({"109#00", "10A#FF"});
  CHECK(node.mode() == CO_PREOP);
  CHECK(node.state() == CO_SRDO_NOT_OPERATIONAL);
}

TEST_CASE("SRDO producer: two producers with different refresh times [SR15]") {
  SrdoTable table = sender(20);
  table.srdo[1].send(0x10B, {0x23000208, 0x23010208});
  table.srdo[1].cycle = 30;
  SrdoNode node(table);
  node.start();
  node.after(60ms);
  unsigned first = 0;
  unsigned second = 0;
  for (const std::string& sent : node.frames()) {
    first += sent == "109#000000" ? 1U : 0U;
    second += sent == "10B#00" ? 1U : 0U;
  }
  CHECK(first == 3);
  CHECK(second == 2);
}

TEST_CASE("SRDO producer: objects are read with the lock of mapped objects held [SR15]") {
  SrdoNode node(sender());
  node.start();
  unsigned locks = 0;
  callbacks().od_lock = [&] { ++locks; };
  node.after(1ms);
  CHECK(locks == 1);
  node.trace();
}

TEST_CASE("SRDO producer: a frame with the own COB-ID is not received [SR15]") {
  SrdoNode node(sender());
  node.start();
  node.rx("109#112233");
  node.rx("10A#EEDDCC");
  CHECK(node.counters().Unclaimed == 2);
  CHECK(node.u8[0] == 0);
}

#else

TEST_CASE("SRDO producer: the inverse frame follows after CO_SRDO_GAP [SR19]") {
  constexpr Time gap{CO_SRDO_GAP};
  SrdoNode node(sender(), [](Setup& setup) { setup.rate(1000000); });
  set_data(node, 1, 2);
  node.start();
  node.after(500us);
  node.tx("109#010200");
  CHECK(node.state() == CO_SRDO_INITIALISING);
  set_data(node, 3, 4);  // the inverse frame belongs to the plain one
  node.after(gap - Time(1));
  node.silent();
  node.after(Time(1));
  node.tx("10A#FEFDFF");
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
  node.after(50ms - gap - Time(1));
  node.silent();
  node.after(Time(1));
  node.tx("109#030400");
}

TEST_CASE("SRDO producer: a request in the gap sends another pair after the present one [SR16] [SR19]") {
  constexpr Time gap{CO_SRDO_GAP};
  SrdoNode node(sender(), [](Setup& setup) { setup.rate(1000000); });
  node.start();
  node.after(500us);
  node.tx("109#000000");
  CHECK(node.request() == CO_ERR_NONE);
  CHECK(node.request() == CO_ERR_NONE);
  node.silent();
  node.after(gap);
  node.tx("10A#FFFFFF");
  node.after(gap);
  node.tx("109#000000");
  node.after(gap);
  node.tx("10A#FFFFFF");
  node.after(50ms - gap);
  node.tx("109#000000");
}

TEST_CASE("SRDO producer: a refresh time within the gap is refused when Operational is entered [SR19]") {
  SrdoTable table = sender(1);
  SrdoNode node(table, [](Setup& setup) { setup.rate(1000); });
  node.start({"081#0063110000011302"});
}

TEST_CASE("SRDO producer: leaving Operational in the gap sends no inverse frame [SR19]") {
  SrdoNode node(sender(), [](Setup& setup) { setup.rate(1000000); });
  node.start();
  node.after(500us);
  node.tx("109#000000");
  node.rx("000#8001");
  node.after(1s);
  node.silent();
}

#endif

}  // namespace

#endif
