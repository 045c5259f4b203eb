// SPDX-License-Identifier: Apache-2.0
// Faults of SRDOs: each ends in a named error state that only leaving Operational ends. [EN 50325-5]
#include "support/srdo_fixture.hpp"

#if CO_SRDO_N > 1

namespace {

using namespace test;

SrdoTable receiver(const std::vector<std::uint32_t>& words = pair_of_3) {
  SrdoTable table;
  table.srdo[0].receive(0x109, words);
  return table;
}

// A consumer that has received one pair.
class Established : public SrdoNode {
 public:
  Established() : SrdoNode(receiver()) {
    start();
    rx("109#112233");
    rx("10A#EEDDCC");
    CHECK(state() == CO_SRDO_ESTABLISHED);
    take_changes();
  }

  // Checks the error state, its EMCY, that the objects keep the values of the first pair, and how the state ends. late:
  // a frame that is received in the error state
  void expect(CO_SRDO_STATE error, const char* late = nullptr, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    if (state() != error) ADD_FAIL_CHECK_AT(at.file, at.line, "state " << state() << ", expected " << error);
    const std::string number = std::string("0") + "0123456789AB"[error];
    tx("081#00821100000113" + number, at);
    CHECK(take_changes() == std::vector<Change>{{0, error}});
    CHECK(!COSrdoIsEstablished(&node));
    CHECK(objects.error_register == 0x11);
    if (late != nullptr) rx(late);
    for (unsigned n = 0; n < 3; ++n) {  // valid pairs do not end the error
      rx("109#445566");
      rx("10A#BBAA99");
      after(25ms);
    }
    CHECK(u8[0] == 0x11);
    CHECK(inverse8[0] == 0xEE);
    CHECK(u16[0] == 0x3322);
    CHECK(inverse16[0] == 0xCCDD);
    CHECK(armed_timers() == 0);
    rx("000#0101");  // a command to the present state
    CHECK(state() == error);
    silent(at);
    rx("000#8001");
    tx("081#00000000000113" + number, at);
    CHECK(objects.error_register == 0);
    start();
    rx("109#445566");
    rx("10A#BBAA99");
    CHECK(state() == CO_SRDO_ESTABLISHED);
    CHECK(u8[0] == 0x44);
    CHECK(take_changes() ==
          std::vector<Change>{{0, CO_SRDO_NOT_OPERATIONAL}, {0, CO_SRDO_INITIALISING}, {0, CO_SRDO_ESTABLISHED}});
  }
};

TEST_CASE("SRDO faults: lost inverse frame by the SRVT [SR12] [SR13]") {
  Established node;
  node.rx("109#223344");
  node.after(20ms);
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
  node.after(1ms);
  node.expect(CO_SRDO_ERR_SRVT);
}

TEST_CASE("SRDO faults: lost inverse frame by the next plain frame [SR13]") {
  Established node;
  node.rx("109#223344");
  node.after(20ms);
  node.rx("109#223344");
  node.expect(CO_SRDO_ERR_RX_NOT_INVERSE);
}

TEST_CASE("SRDO faults: lost plain frame [SR13]") {
  Established node;
  node.after(25ms);
  node.rx("10A#DDCCBB");
  node.expect(CO_SRDO_ERR_RX_NOT_INVERSE);
}

TEST_CASE("SRDO faults: lost pair [SR11] [SR13]") {
  Established node;
  node.after(51ms);
  node.expect(CO_SRDO_ERR_SCT);
}

TEST_CASE("SRDO faults: swapped frames [SR13]") {
  Established node;
  node.after(25ms);
  node.rx("10A#DDCCBB");
  node.expect(CO_SRDO_ERR_RX_NOT_INVERSE, "109#223344");
}

TEST_CASE("SRDO faults: doubled plain frame [SR13]") {
  Established node;
  node.rx("109#223344");
  node.rx("109#223344");
  node.expect(CO_SRDO_ERR_RX_NOT_INVERSE);
}

TEST_CASE("SRDO faults: doubled inverse frame [SR13]") {
  Established node;
  node.rx("10A#EEDDCC");
  node.expect(CO_SRDO_ERR_RX_NOT_INVERSE);
}

TEST_CASE("SRDO faults: doubled pair is a valid pair [SR8]") {
  Established node;
  node.rx("109#112233");
  node.rx("10A#EEDDCC");
  CHECK(node.state() == CO_SRDO_ESTABLISHED);
}

TEST_CASE("SRDO faults: plain frame late by one tick [SR11] [SR13]") {
  Established node;
  node.after(51ms);
  node.expect(CO_SRDO_ERR_SCT, "109#223344");
}

TEST_CASE("SRDO faults: inverse frame late by one tick [SR12] [SR13]") {
  Established node;
  node.rx("109#223344");
  node.after(21ms);
  node.expect(CO_SRDO_ERR_SRVT, "10A#DDCCBB");
}

TEST_CASE("SRDO faults: short plain frame [SR9] [SR13]") {
  for (const char* frame : {"109#2233", "109#22", "109#"}) {
    Established node;
    node.rx(frame);
    node.expect(CO_SRDO_ERR_SHORT);
  }
}

TEST_CASE("SRDO faults: short inverse frame [SR9] [SR13]") {
  for (const char* frame : {"10A#DDCC", "10A#DD", "10A#"}) {
    Established node;
    node.rx("109#223344");
    node.rx(frame);
    node.expect(CO_SRDO_ERR_SHORT);
  }
}

TEST_CASE("SRDO faults: one wrong bit in the plain or the inverse frame [SR13]") {
  Established plain;
  plain.rx("109#223344");
  plain.rx("10A#DDCCBA");
  plain.expect(CO_SRDO_ERR_RX_NOT_INVERSE);
  Established inverse;
  inverse.rx("109#223345");
  inverse.rx("10A#DDCCBB");
  inverse.expect(CO_SRDO_ERR_RX_NOT_INVERSE);
}

TEST_CASE("SRDO faults: the inverse frame of another pair [SR13]") {
  Established node;
  node.rx("109#223344");
  node.rx("10A#EEDDCC");
  node.expect(CO_SRDO_ERR_RX_NOT_INVERSE);
}

TEST_CASE("SRDO faults: frames that are equal instead of inverse [SR13]") {
  Established node;
  node.rx("109#223344");
  node.rx("10A#223344");
  node.expect(CO_SRDO_ERR_RX_NOT_INVERSE);
}

TEST_CASE("SRDO faults: every single-bit error of a pair of eight bytes is found [SR13]") {
  SrdoTable table;
  table.srdo[0].receive(0x109, {0x23060140, 0x23070140});
  unsigned wrong = 0;
  for (unsigned bit = 0; bit < 128; ++bit) {
    SrdoNode node(table);
    node.start();
    CO_IF_FRM frames[] = {frame("109#0123456789ABCDEF"), frame("10A#FEDCBA9876543210")};
    auto& byte = frames[bit / 64].Data[bit % 64 / 8];
    byte = static_cast<std::uint8_t>(byte ^ 1U << bit % 8);
    node.rx(frames[0]);
    node.rx(frames[1]);
    const bool found = node.state() == CO_SRDO_ERR_RX_NOT_INVERSE && node.u64 == 0 && node.inverse64 == ~0ULL;
    wrong += found ? 0U : 1U;
    node.trace();
  }
  CHECK(wrong == 0);
}

TEST_CASE("SRDO faults: every length of both frames [SR9]") {
  for (unsigned plain = 0; plain <= 8; ++plain) {
    for (unsigned inverse = 0; inverse <= 8; ++inverse) {
      CAPTURE(plain);
      CAPTURE(inverse);
      SrdoNode node(receiver());
      node.start();
      CO_IF_FRM frames[] = {frame("109#1122330000000000"), frame("10A#EEDDCCFFFFFFFFFF")};
      frames[0].DLC = static_cast<std::uint8_t>(plain);
      frames[1].DLC = static_cast<std::uint8_t>(inverse);
      node.rx(frames[0]);
      CHECK(node.trace().size() == (plain >= 3 ? 0 : 1));
      node.rx(frames[1]);
      const bool valid = plain >= 3 && inverse >= 3;
      CHECK(node.state() == (valid ? CO_SRDO_ESTABLISHED : CO_SRDO_ERR_SHORT));
      CHECK(node.u8[0] == (valid ? 0x11 : 0));
      node.trace();
    }
  }
}

TEST_CASE("SRDO faults: in the first pair too [SR13]") {
  const std::pair<std::vector<const char*>, CO_SRDO_STATE> cases[] = {
      {{"109#112233", "109#112233"}, CO_SRDO_ERR_RX_NOT_INVERSE},
      {{"109#112233", "10A#EEDDCD"}, CO_SRDO_ERR_RX_NOT_INVERSE},
      {{"109#1122"}, CO_SRDO_ERR_SHORT},
      {{"109#112233", "10A#EEDD"}, CO_SRDO_ERR_SHORT}};
  for (const auto& [frames, expected] : cases) {
    SrdoNode node(receiver());
    node.start();
    for (const char* one : frames) node.rx(one);
    CHECK(node.state() == expected);
    CHECK(node.u8[0] == 0);
    node.trace();
  }
}

TEST_CASE("SRDO faults: an object that cannot be written ends the SRDO [SR14]") {
  SrdoNode node(receiver(), [](Setup& setup) { setup.writable([](const void*, std::uint32_t) { return false; }); });
  node.start();
  node.rx("109#112233");
  node.rx("10A#EEDDCC");
  CHECK(node.state() == CO_SRDO_ERR_INTERNAL);
  node.tx("081#008211000001130B");
}

TEST_CASE("SRDO faults: a dictionary that is replaced in Operational ends the SRDO [SR14]") {
  Established node;
  const auto length = static_cast<std::uint16_t>(node.node.Dict.Num + 1U);
  node.call([&] { CODictInit(&node.node.Dict, &node.node, node.node.Dict.Root, length); });
  CHECK(node.state() == CO_SRDO_ERR_INTERNAL);
  node.trace();
}

// A node that sends two SRDOs, which are established.
struct TwoProducers : SrdoNode {
  TwoProducers() : SrdoNode(table()) {
    start();
    after(60ms);
    trace();
    REQUIRE(COSrdoIsEstablished(&node));
  }
  static SrdoTable table() {
    SrdoTable table;
    table.srdo[0].send(0x109, pair_of_3);
    table.srdo[1].send(0x10B, pair_of_3);
    return table;
  }
};

TEST_CASE("SRDO faults: all SRDOs have ended before a callback reports that the dictionary was replaced [SR14]") {
  TwoProducers node;
  std::vector<std::pair<unsigned, CO_ERR>> results;
  callbacks().srdo_change = [&](CO_NODE* of, std::uint8_t number, CO_SRDO_STATE to) {
    CHECK(to == CO_SRDO_ERR_INTERNAL);
    for (std::uint8_t each = 0; each < 2; ++each) {
      CHECK(COSrdoGetState(of, each) == CO_SRDO_ERR_INTERNAL);
      results.emplace_back(number, COSrdoRequest(of, each));
    }
  };
  const auto length = static_cast<std::uint16_t>(node.node.Dict.Num - 60U);  // without the mapped objects
  node.call([&] { CODictInit(&node.node.Dict, &node.node, node.node.Dict.Root, length); });
  const std::vector<std::pair<unsigned, CO_ERR>> expected = {
      {0, CO_ERR_OBJ_STATE}, {0, CO_ERR_OBJ_STATE}, {1, CO_ERR_OBJ_STATE}, {1, CO_ERR_OBJ_STATE}};
  CHECK(results == expected);
  node.tx({"081#008211000001130B", "081#008211000002130B"});
}

TEST_CASE("SRDO faults: at the end of Operational a callback may delete an SRDO, all of which have ended [SR14]") {
  for (const char* const end : {"000#8001", "000#0201", "000#8201"}) {
    TwoProducers node;
    std::vector<SrdoNode::Change> changes;
    callbacks().srdo_change = [&](CO_NODE* of, std::uint8_t number, CO_SRDO_STATE to) {
      changes.emplace_back(number, to);
      CHECK(COSrdoGetState(of, 0) == CO_SRDO_NOT_OPERATIONAL);
      if (number == 0) CHECK(CODictWrByte(&of->Dict, CO_DEV(0x1302, 1), 0) == CO_ERR_NONE);
    };
    node.rx(end);
    node.trace();
    const std::vector<SrdoNode::Change> expected = {{0, CO_SRDO_NOT_OPERATIONAL}, {1, CO_SRDO_DELETED}};
    CHECK(changes == expected);
    CHECK(node.state(1) == CO_SRDO_DELETED);
  }
}

TEST_CASE("SRDO faults: the callback may leave Operational, after the EMCY [SR14]") {
  Established node;
  callbacks().srdo_change = [&](CO_NODE* of, std::uint8_t, CO_SRDO_STATE to) {
    if (to == CO_SRDO_ERR_SHORT) CONmtSetMode(&of->Nmt, CO_PREOP);
  };
  node.rx("109#");
  CHECK(node.mode() == CO_PREOP);
  CHECK(node.state() == CO_SRDO_NOT_OPERATIONAL);
  CHECK(node.objects.error_register == 0);
  node.tx({"081#0082110000011309", "081#0000000000011309"});
}

#if USE_EMCY && CO_EMCY_QUEUE_N > 0
TEST_CASE("SRDO faults: COEmcySet() in the callback for the change to Stopped sends no EMCY of Operational [SR14]") {
  SrdoTable table;
  table.srdo[0].receive(0x109, pair_of_3);
  SrdoNode node(table, [](Setup& setup) { setup.emergencies({{CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_ERR}}); });
  node.start();
  callbacks().mode_change = [](CO_NMT* nmt, CO_MODE) { CONodeCanEvent(nmt->Node, CO_CAN_PASSIVE); };
  callbacks().srdo_change = [](CO_NODE* of, std::uint8_t, CO_SRDO_STATE) { COEmcySet(&of->Emcy, 0, nullptr); };
  node.rx("000#0201");
  CHECK(node.mode() == CO_STOP);
  CHECK(COEmcyGet(&node->Emcy, 0) == 1);
  CHECK(node.objects.error_register == 0x19);
  node.silent();
}
#endif

TEST_CASE("SRDO faults: after a reset the node receives neither frame of a pair until Operational [SR14]") {
  for (const char* const reset : {"000#8101", "000#8201"}) {
    Established node;
    const auto receives = [&](std::uint32_t id) {
      return std::count(node.can.filter.begin(), node.can.filter.end(), id) != 0;
    };
    CHECK((receives(0x109) && receives(0x10A)));
    node.rx(reset);
    node.trace();
    CHECK_FALSE((receives(0x109) || receives(0x10A)));
    const std::uint32_t before = node.counters().Unclaimed;
    node.rx("109#112233");
    node.rx("10A#EEDDCC");
    CHECK(node.counters().Unclaimed == before + 2);
  }
}

#if USE_DICT_CHECK
TEST_CASE("SRDO faults: the types of an SRDO are accepted in their places only [SR1]") {
  std::uint32_t variable = 0;
  for (const CO_OBJ& entry : {CO_OBJ{CO_KEY(0x2400, 5, CO_OBJ_____RW), CO_TSRDO_COM, &variable},
                              CO_OBJ{CO_KEY(0x2400, 1, CO_OBJ_____RW), CO_TSRDO_MAP, &variable}}) {
    Fixture node(Setup().with(entry).stay_in_init());
    CHECK(CODictGetFault(&node->Dict, nullptr) == CO_DICT_WRONG_PLACE);
  }
}
#endif

TEST_CASE("SRDO faults: the callback may stop the node [SR14]") {
  Established node;
  callbacks().srdo_change = [&](CO_NODE* of, std::uint8_t, CO_SRDO_STATE) { CONodeStop(of); };
  node.after(51ms);
  CHECK(node.mode() == CO_INVALID);
  node.silent();
}

TEST_CASE("SRDO faults: each reset ends the error and its bits in 1001h [SR13]") {
  for (const char* reset : {"000#8201", "000#8101"}) {
    Established node;
    node.rx("109#");
    node.trace();
    node.rx(reset);
    CHECK(node.trace().size() == 1);  // boot-up
    CHECK(node.objects.error_register == 0);
    CHECK(node.state() == CO_SRDO_NOT_OPERATIONAL);
  }
}

TEST_CASE("SRDO faults: in Stopped the error ends without a message [SR13]") {
  Established node;
  node.rx("109#");
  node.trace();
  node.rx("000#0201");
  node.silent();
  CHECK(node.state() == CO_SRDO_NOT_OPERATIONAL);
  CHECK(node.objects.error_register == 0);
}

TEST_CASE("SRDO faults: one SRDO does not disturb another one [SR13]") {
  SrdoTable table = receiver();
  table.srdo[1].receive(0x10B, {0x23040120, 0x23050120});
  SrdoNode node(table);
  node.start();
  for (const char* one : {"109#112233", "10B#01020304", "10A#EEDDCC", "10C#FEFDFCFB"}) node.rx(one);
  CHECK(COSrdoIsEstablished(&node.node));
  node.rx("109#");
  CHECK(node.state(0) == CO_SRDO_ERR_SHORT);
  CHECK(!COSrdoIsEstablished(&node.node));
  node.tx("081#0082110000011309");
  node.rx("10B#11020304");
  node.rx("10C#EEFDFCFB");
  CHECK(node.state(1) == CO_SRDO_ESTABLISHED);
  CHECK(node.u32[0] == 0x04030211);
  node.trace();
}

// --- All pairs of state and event, compared with a model written from the standard

enum class Event { plain, inverse, wrong, short_plain, short_inverse, srvt, sct, preop, stop, start, count };

struct Model {
  CO_SRDO_STATE state = CO_SRDO_NOT_OPERATIONAL;
  bool half = false;

  bool runs() const { return state == CO_SRDO_INITIALISING || state == CO_SRDO_ESTABLISHED; }
  void end(CO_SRDO_STATE in) { state = in, half = false; }
  void on(Event event) {
    const bool leaves = event == Event::preop || event == Event::stop;
    if (leaves) return end(CO_SRDO_NOT_OPERATIONAL);
    if (event == Event::start) return state == CO_SRDO_NOT_OPERATIONAL ? end(CO_SRDO_INITIALISING) : void();
    if (!runs()) return;
    const bool ignored = state == CO_SRDO_INITIALISING && !half;
    switch (event) {
      case Event::plain: half ? end(CO_SRDO_ERR_RX_NOT_INVERSE) : void(half = true); break;
      case Event::short_plain: end(half ? CO_SRDO_ERR_RX_NOT_INVERSE : CO_SRDO_ERR_SHORT); break;
      case Event::inverse: ignored ? void() : end(half ? CO_SRDO_ESTABLISHED : CO_SRDO_ERR_RX_NOT_INVERSE); break;
      case Event::wrong: ignored ? void() : end(CO_SRDO_ERR_RX_NOT_INVERSE); break;
      case Event::short_inverse: ignored ? void() : end(half ? CO_SRDO_ERR_SHORT : CO_SRDO_ERR_RX_NOT_INVERSE); break;
      case Event::srvt: half ? end(CO_SRDO_ERR_SRVT) : void(); break;
      default: half ? end(CO_SRDO_ERR_SRVT) : state == CO_SRDO_ESTABLISHED ? end(CO_SRDO_ERR_SCT) : void();
    }
  }
};

void apply(SrdoNode& node, Event event) {
  switch (event) {
    case Event::plain: node.rx("109#112233"); break;
    case Event::inverse: node.rx("10A#EEDDCC"); break;
    case Event::wrong: node.rx("10A#EEDDCD"); break;
    case Event::short_plain: node.rx("109#1122"); break;
    case Event::short_inverse: node.rx("10A#EEDD"); break;
    case Event::srvt: node.after(21ms); break;
    case Event::sct: node.after(51ms); break;
    case Event::preop: node.rx("000#8001"); break;
    case Event::stop: node.rx("000#0201"); break;
    default: node.rx("000#0101");
  }
  node.trace();
}

TEST_CASE("SRDO faults: all sequences of five events have the states of the model [SR8] [SR10] [SR13]") {
  constexpr unsigned events = static_cast<unsigned>(Event::count);
  constexpr unsigned all = events * events * events * events * events;
  unsigned wrong = 0;
  SrdoTable table = receiver();
  SrdoNode node(table);
  Model model;
  for (unsigned sequence = 0; sequence < all; sequence += stride(97)) {
    for (const Event event : {Event::preop, Event::start}) {
      apply(node, event);
      model.on(event);
    }
    std::uint32_t since = 0;  // ms since the last plain frame of a valid pair
    for (unsigned rest = sequence, n = 0; n < 5; ++n, rest /= events) {
      const auto event = static_cast<Event>(rest % events);
      const bool second_time = event == Event::srvt && since != 0;
      since = event == Event::srvt ? since + 21 : event == Event::plain ? 0 : since;
      const bool is_over = second_time && since > 50;
      apply(node, event);
      model.on(is_over && !model.half ? Event::sct : event);
      wrong += node.state() != model.state ? 1U : 0U;
    }
  }
  CHECK(wrong == 0);
}

}  // namespace

#endif
