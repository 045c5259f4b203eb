// SPDX-License-Identifier: Apache-2.0
// SRDO consumer: valid pairs, and the edges of SCT and SRVT. [EN 50325-5]
#include "support/srdo_fixture.hpp"

#if CO_SRDO_N > 1

namespace {

using namespace test;

SrdoTable receiver(std::uint16_t cycle = 50, std::uint8_t validation = 20) {
  SrdoTable table;
  table.srdo[0].receive(0x109, pair_of_3);
  table.srdo[0].cycle = cycle;
  table.srdo[0].validation = validation;
  return table;
}

// Sends a valid pair whose first byte is \a value.
void send_pair(SrdoNode& node, std::uint8_t value) {
  CO_IF_FRM plain = frame("109#002233");
  CO_IF_FRM inverse = frame("10A#00DDCC");
  plain.Data[0] = value;
  inverse.Data[0] = static_cast<std::uint8_t>(~value);
  node.rx(plain);
  node.rx(inverse);
}

TEST_CASE("SRDO consumer: a valid pair is written plain and inverse and establishes the SRDO [SR8]") {
  SrdoNode node(receiver());
  node.start();
  CHECK(node.take_changes() == std::vector<SrdoNode::Change>{{0, CO_SRDO_INITIALISING}});
  callbacks().srdo_change = [&](CO_NODE*, std::uint8_t, CO_SRDO_STATE to) {
    CHECK(to == CO_SRDO_ESTABLISHED);
    CHECK(node.u8[0] == 0x11);  // written before the callback
  };
  node.rx("109#112233");
  CHECK(node.u8[0] == 0);
  CHECK(node.state() == CO_SRDO_INITIALISING);
  node.rx("10A#EEDDCC");
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
  CHECK(COSrdoIsEstablished(&node.node));
  CHECK(node.u8[0] == 0x11);
  CHECK(node.inverse8[0] == 0xEE);
  CHECK(node.u16[0] == 0x3322);
  CHECK(node.inverse16[0] == 0xCCDD);
  CHECK(node.counters().Malformed == 0);
  node.silent();
}

TEST_CASE("SRDO consumer: pairs in time keep the SRDO established and call the callback once [SR8]") {
  SrdoNode node(receiver());
  node.start();
  node.take_changes();
  for (unsigned n = 0; n < 100; ++n) {
    send_pair(node, static_cast<std::uint8_t>(n));
    CHECK(node.u8[0] == n);
    CHECK(node.inverse8[0] == 255 - n);
    node.after(std::chrono::milliseconds(n % 51));
  }
  CHECK(node.take_changes() == std::vector<SrdoNode::Change>{{0, CO_SRDO_ESTABLISHED}});
  node.silent();
}

TEST_CASE("SRDO consumer: eight bytes in eight pairs of objects [SR8]") {
  SrdoTable table;
  std::vector<std::uint32_t> words;
  for (std::uint32_t sub = 1; sub <= 8; ++sub) {
    words.push_back(0x23000008 | sub << 8);
    words.push_back(0x23010008 | sub << 8);
  }
  table.srdo[0].receive(0x17F, words);
  SrdoNode node(table);
  node.start();
  node.rx("17F#0123456789ABCDEF");
  node.rx("180#FEDCBA9876543210");
  const std::uint8_t expected[] = {0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF};
  for (unsigned n = 0; n < 8; ++n) {
    CHECK(node.u8[n] == expected[n]);
    CHECK(node.inverse8[n] == (expected[n] ^ 0xFF));
  }
}

TEST_CASE("SRDO consumer: objects of 1 and 2 and 4 and 8 bytes [SR8]") {
  SrdoTable table;
  table.srdo[0].receive(0x101, {0x23040120, 0x23050120, 0x23020110, 0x23030110, 0x23000108, 0x23010108});
  table.srdo[1].receive(0x103, {0x23060140, 0x23070140});
  SrdoNode node(table);
  node.start();
  node.rx("101#44332211665577");
  node.rx("102#BBCCDDEE99AA88");
  CHECK(node.u32[0] == 0x11223344);
  CHECK(node.inverse32[0] == 0xEEDDCCBB);
  CHECK(node.u16[0] == 0x5566);
  CHECK(node.inverse16[0] == 0xAA99);
  CHECK(node.u8[0] == 0x77);
  CHECK(node.inverse8[0] == 0x88);
  CHECK(!COSrdoIsEstablished(&node.node));
  node.rx("103#0102030405060708");
  node.rx("104#FEFDFCFBFAF9F8F7");
  CHECK(node.u64 == 0x0807060504030201);
  CHECK(node.inverse64 == 0xF7F8F9FAFBFCFDFE);
  CHECK(COSrdoIsEstablished(&node.node));
}

TEST_CASE("SRDO consumer: placeholders are skipped but compared [SR8]") {
  SrdoTable table;
  table.srdo[0].receive(0x109, {0x00060010, 0x00060010, 0x23000108, 0x00050008, 0x00020008, 0x23010108});
  for (const bool inverse : {true, false}) {
    SrdoNode node(table);
    node.start();
    node.rx("109#AABB1122");
    node.rx(inverse ? "10A#5544EEDD" : "10A#5545EEDD");
    CHECK(node.state() == (inverse ? CO_SRDO_ESTABLISHED : CO_SRDO_ERR_RX_NOT_INVERSE));
    CHECK(node.u8[0] == (inverse ? 0x11 : 0));
    CHECK(node.inverse8[0] == (inverse ? 0xDD : 0xFF));
    node.trace();
  }
}

TEST_CASE("SRDO consumer: longer frames are valid if the mapped bytes are inverse [SR9]") {
  SrdoNode node(receiver());
  node.start();
  node.rx("109#11223300FF");
  node.rx("10A#EEDDCC00FF0102");
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
  node.rx("109#112233FFFFFFFFFF");
  node.rx("10A#EEDDCC");
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
  node.silent();
}

TEST_CASE("SRDO consumer: objects are written together with the lock of mapped objects held [SR8]") {
  SrdoNode node(receiver());
  node.start();
  unsigned locks = 0;
  callbacks().od_lock = [&] {
    ++locks;
    CHECK(node.u8[0] == 0);
    CHECK(node.inverse16[0] == 0xFFFF);
  };
  callbacks().od_unlock = [&] {
    CHECK(node.u8[0] == 0x11);
    CHECK(node.inverse8[0] == 0xEE);
    CHECK(node.u16[0] == 0x3322);
    CHECK(node.inverse16[0] == 0xCCDD);
  };
  node.rx("109#112233");
  CHECK(locks == 0);
  node.rx("10A#EEDDCC");
  CHECK(locks == 1);
}

TEST_CASE("SRDO consumer: no frame is processed outside of Operational [SR10]") {
  for (const char* command : {"000#8001", "000#0201"}) {
    SrdoNode node(receiver());
    node.rx("000#0101");
    node.rx(command);
    node.take_changes();
    send_pair(node, 1);
    node.after(200ms);
    CHECK(node.u8[0] == 0);
    CHECK(node.counters().Unclaimed == 2);
    CHECK(node.state() == CO_SRDO_NOT_OPERATIONAL);
    CHECK(node.take_changes().empty());
    node.silent();
  }
}

TEST_CASE("SRDO consumer: before the first pair no time is monitored [SR10]") {
  SrdoNode node(receiver(1, 1));
  node.start();
  node.after(10s);
  CHECK(node.state() == CO_SRDO_INITIALISING);
  CHECK(node.armed_timers() == 0);
  node.silent();
}

TEST_CASE("SRDO consumer: an inverse frame before the first plain frame belongs to an earlier pair [SR10]") {
  for (const char* inverse : {"10A#EEDDCC", "10A#00", "10A#"}) {
    SrdoNode node(receiver());
    node.start();
    node.rx(inverse);
    CHECK(node.state() == CO_SRDO_INITIALISING);
    send_pair(node, 0x42);
    CHECK(node.state() == CO_SRDO_ESTABLISHED);
    CHECK(node.u8[0] == 0x42);
    node.silent();
  }
}

TEST_CASE("SRDO consumer: remote frames and 29-bit identifiers are no frames of the SRDO [SR10]") {
  SrdoNode node(receiver());
  node.start();
  for (const char* wrong : {"109#R", "10A#R", "00000109#112233", "0000010A#EEDDCC", "10B#112233", "108#112233"}) {
    node.rx(wrong);
    CHECK(node.state() == CO_SRDO_INITIALISING);
  }
  CHECK(node.counters().Malformed == 2);
  node.rx("109#112233");
  node.rx("10A#R");
  node.rx("10A#EEDDCC");
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
}

// Runs a function for each clock frequency and start of the clock.
void for_each_clock(const SrdoTable& table, const std::function<void(SrdoNode&)>& run) {
  for (const std::uint32_t rate : clock_rates) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      SrdoNode node(table, [&](Setup& setup) { setup.rate(rate).clock(start); });
      node.start();
      run(node);
    }
  }
}

// Returns the time of a number of ticks.
Time of_ticks(std::uint64_t ticks, std::uint32_t rate) { return Time(ticks * 1000000 / rate); }

TEST_CASE("SRDO consumer: the next pair at the SCT is in time and one tick later it is late [SR11]") {
  for (const std::uint16_t cycle :
       {std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{50}, std::uint16_t{1000}, std::uint16_t{65535}}) {
    for (const std::uint32_t rate : {1000U, 300U, 32768U}) {
      for (const bool late : {false, true}) {
        CAPTURE(cycle);
        CAPTURE(rate);
        SrdoNode node(receiver(cycle), [&](Setup& setup) { setup.rate(rate); });
        node.start();
        send_pair(node, 1);
        const std::uint64_t limit = (std::uint64_t{cycle} * rate + 999) / 1000;
        node.after(of_ticks(limit + (late ? 1 : 0), rate));
        CHECK(node.state() == (late ? CO_SRDO_ERR_SCT : CO_SRDO_ESTABLISHED));
        CHECK(node.trace().size() == (late ? 1 : 0));
        send_pair(node, 2);
        CHECK(node.state() == (late ? CO_SRDO_ERR_SCT : CO_SRDO_ESTABLISHED));
        CHECK(node.u8[0] == (late ? 1 : 2));
        node.trace();
      }
    }
  }
}

TEST_CASE("SRDO consumer: the inverse frame at the SRVT is in time and one tick later it is late [SR12]") {
  for (const std::uint8_t validation : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{20}, std::uint8_t{255}}) {
    for (const std::uint32_t rate : {1000U, 300U, 32768U}) {
      for (const bool late : {false, true}) {
        for (const bool first : {false, true}) {
          CAPTURE(validation);
          CAPTURE(rate);
          SrdoNode node(receiver(1000, validation), [&](Setup& setup) { setup.rate(rate); });
          node.start();
          if (!first) send_pair(node, 1);
          node.rx("109#022233");
          const std::uint64_t limit = (std::uint64_t{validation} * rate + 999) / 1000;
          node.after(of_ticks(limit + (late ? 1 : 0), rate));
          CHECK(node.trace().size() == (late ? 1 : 0));
          node.rx("10A#FDDDCC");
          CHECK(node.state() == (late ? CO_SRDO_ERR_SRVT : CO_SRDO_ESTABLISHED));
          CHECK(node.u8[0] == (late ? (first ? 0 : 1) : 2));
          node.trace();
        }
      }
    }
  }
}

TEST_CASE("SRDO consumer: the SCT begins with the plain frame and not with the inverse frame [SR11]") {
  SrdoNode node(receiver(50, 20));
  node.start();
  node.rx("109#012233");
  node.after(20ms);
  node.rx("10A#FEDDCC");
  node.after(30ms);
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
  node.after(1ms);
  CHECK(node.state() == CO_SRDO_ERR_SCT);
  node.trace();
}

TEST_CASE("SRDO consumer: an SRVT above the SCT does not extend the SCT [SR11]") {
  SrdoNode node(receiver(5, 20));
  node.start();
  node.rx("109#012233");
  node.after(15ms);
  node.rx("10A#FEDDCC");
  CHECK(node.u8[0] == 1);
  node.after(1ms);
  CHECK(node.state() == CO_SRDO_ERR_SCT);
  node.trace();
}

TEST_CASE("SRDO consumer: a late frame is refused before the timer was processed too [SR11] [SR12]") {
  for (const bool inverse : {false, true}) {
    SrdoNode node(receiver());
    node.start();
    send_pair(node, 1);
    if (inverse) node.rx("109#022233");
    node.jump(inverse ? 21ms : 51ms);  // time passes without the loop
    node.can.to_node.push_back(frame(inverse ? "10A#FDDDCC" : "109#022233"));
    node.call([&] { CONodeProcess(&node.node); });
    CHECK(node.state() == (inverse ? CO_SRDO_ERR_SRVT : CO_SRDO_ERR_SCT));
    CHECK(node.u8[0] == 1);
    node.trace();
  }
}

TEST_CASE("SRDO consumer: works with every clock and its overflow [SR11] [SR12]") {
  for_each_clock(receiver(), [](SrdoNode& node) {
    for (std::uint8_t n = 1; n <= 40; ++n) {
      send_pair(node, n);
      node.after(45ms);
      CHECK(node.u8[0] == n);
    }
    CHECK(node.state() == CO_SRDO_ESTABLISHED);
    node.after(10ms);
    CHECK(node.state() == CO_SRDO_ERR_SCT);
    node.trace();
  });
}

TEST_CASE("SRDO consumer: an object with flag A triggers its TPDO after the pair was written [SR8]") {
  static std::uint8_t value;
  static std::uint8_t inverse;
  static std::uint32_t cob_id = 0x40000181;
  value = 0;
  inverse = 0xFF;
  SrdoTable table;
  table.srdo[0].receive(0x109, {0x23100108, 0x23100208});
  SrdoNode node(table, [](Setup& setup) {
    setup.with({CO_KEY(0x2310, 1, CO_OBJ___APRW), CO_TUNSIGNED8, &value}).may_change(0x2310, 1);
    setup.with({CO_KEY(0x2310, 2, CO_OBJ____PRW), CO_TUNSIGNED8, &inverse}).may_change(0x2310, 2);
    setup.with({CO_KEY(0x1800, 1, CO_OBJ_____RW), CO_TPDO_ID, &cob_id});
    setup.with({CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, 2});
    setup.with({CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, 0x23100108});
    setup.with({CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, 0x23100208});
  });
  node.start();
  node.rx("109#42");
  node.rx("10A#BD");
  node.tx("181#42BD");
}

#if USE_CALLBACKS
TEST_CASE("SRDO consumer: the function of the callback table replaces the C function [Q9] [SR7]") {
  static std::vector<SrdoNode::Change> calls;
  calls.clear();
  CO_CALLBACKS table{};
  table.SrdoChange = [](CO_NODE_T* of, void* user, std::uint8_t number, CO_SRDO_STATE state) {
    const OutsideStack outside;
    CHECK(user == CONodeGetUser(of));
    calls.emplace_back(number, state);
  };
  SrdoNode node(receiver(), [&](Setup& setup) { setup.callbacks(table); });
  node.start();
  send_pair(node, 1);
  CHECK(calls == std::vector<SrdoNode::Change>{{0, CO_SRDO_INITIALISING}, {0, CO_SRDO_ESTABLISHED}});
  CHECK(node.changes.empty());
}
#endif

}  // namespace

#endif
