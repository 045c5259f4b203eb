// SPDX-License-Identifier: Apache-2.0
// SRDOs between two nodes on the virtual bus. [EN 50325-5]
#include "lexican/srdo.hpp"
#include "support/network.hpp"
#include "support/srdo_fixture.hpp"

#if CO_SRDO_N > 1 && CO_SRDO_GAP == 0

namespace {

using namespace test;

constexpr std::uint32_t mapping[] = {CO_LINK(0x2300, 1, 32), CO_LINK(0x2300, 2, 32)};
constexpr std::uint16_t producer_signature = co::srdo::signature({CO_SRDO_TX, 25, 20, 0x103, 0x104}, mapping);
constexpr std::uint16_t consumer_signature = co::srdo::signature({CO_SRDO_RX, 50, 20, 0x103, 0x104}, mapping);

// Variables of a node.
struct Memory {
  std::uint8_t error_register = 0;
  std::uint8_t valid = CO_SRDO_CONFIGURATION_VALID;
  std::uint32_t data = 0;
  std::uint32_t inverse = 0xFFFFFFFF;
};

std::vector<CO_OBJ> table_of(Memory& memory, std::uint8_t direction, std::uint16_t cycle, std::uint16_t signature) {
  return {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
          {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, &memory.error_register},
          {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, 0x80},
          {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
          {CO_KEY(0x1301, 1, CO_OBJ_D___R_), CO_TSRDO_COM, direction},
          {CO_KEY(0x1301, 2, CO_OBJ_D___R_), CO_TSRDO_COM, cycle},
          {CO_KEY(0x1301, 3, CO_OBJ_D___R_), CO_TSRDO_COM, 20},
          {CO_KEY(0x1301, 4, CO_OBJ_D___R_), CO_TSRDO_COM, CO_SRDO_TYPE},
          {CO_KEY(0x1301, 5, CO_OBJ_D___R_), CO_TSRDO_COM, CO_SRDO_COBID1(2)},
          {CO_KEY(0x1301, 6, CO_OBJ_D___R_), CO_TSRDO_COM, CO_SRDO_COBID2(2)},
          {CO_KEY(0x1381, 0, CO_OBJ_D___R_), CO_TSRDO_MAP, 2},
          {CO_KEY(0x1381, 1, CO_OBJ_D___R_), CO_TSRDO_MAP, mapping[0]},
          {CO_KEY(0x1381, 2, CO_OBJ_D___R_), CO_TSRDO_MAP, mapping[1]},
          {CO_KEY(0x13FE, 0, CO_OBJ_____RW), CO_TSRDO_VALID, &memory.valid},
          {CO_KEY(0x13FF, 1, CO_OBJ_D___R_), CO_TSRDO_SIGNATURE, signature},
          {CO_KEY(0x2300, 1, CO_OBJ____PRW), CO_TUNSIGNED32, &memory.data},
          {CO_KEY(0x2300, 2, CO_OBJ____PRW), CO_TUNSIGNED32, &memory.inverse},
          CO_OBJ_DICT_ENDMARK};
}

// A producer, node 2, and a consumer, node 3.
class Pair {
 public:
  Pair() {
    line.say("000#0100");
    world.settle();
    line.take();
  }
  ~Pair() { callbacks().srdo_change = nullptr; }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  void set(std::uint32_t value) {
    from.data = value;
    from.inverse = ~value;
  }
  CO_SRDO_STATE sent() const { return COSrdoGetState(&producer.node, 0); }
  CO_SRDO_STATE received() const { return COSrdoGetState(&consumer.node, 0); }

  Memory from;
  Memory to;
  std::vector<CO_OBJ> producer_table = table_of(from, CO_SRDO_TX, 25, producer_signature);
  std::vector<CO_OBJ> consumer_table = table_of(to, CO_SRDO_RX, 50, consumer_signature);
  World world;
  Line& line = world.add_line("bus");
  Device& producer = world.add_device(line, options(2, producer_table));
  Device& consumer = world.add_device(line, options(3, consumer_table));

 private:
  static DeviceOptions options(std::uint8_t id, const std::vector<CO_OBJ>& table) {
    DeviceOptions with{id};
    with.table = table.data();
    return with;
  }
};

TEST_CASE("SRDO network: the consumer follows the producer [SR8] [SR15]") {
  Pair pair;
  CHECK(pair.received() == CO_SRDO_INITIALISING);
  pair.set(0x44332211);
  pair.world.pass(1ms);
  CHECK(pair.line.take_texts() == Texts{"103#11223344", "104#EEDDCCBB"});
  CHECK(pair.received() == CO_SRDO_ESTABLISHED);
  CHECK(pair.to.data == 0x44332211);
  CHECK(pair.to.inverse == 0xBBCCDDEE);
  for (std::uint32_t n = 0; n < 1000; ++n) {
    pair.set(n * 0x01234567);
    pair.world.pass(25ms);
    CHECK(pair.to.data == n * 0x01234567);
    CHECK(pair.to.inverse == ~(n * 0x01234567));
  }
  CHECK(pair.received() == CO_SRDO_ESTABLISHED);
  CHECK(pair.sent() == CO_SRDO_ESTABLISHED);
}

TEST_CASE("SRDO network: a request reaches the consumer at once [SR16]") {
  Pair pair;
  pair.world.pass(5ms);
  pair.set(0x12345678);
  CHECK(COSrdoRequest(&pair.producer.node, 0) == CO_ERR_NONE);
  pair.world.settle();
  CHECK(pair.to.data == 0x12345678);
}

TEST_CASE("SRDO network: the producer that leaves Operational is missing after the SCT [SR11]") {
  Pair pair;
  pair.world.pass(5ms);
  pair.line.say("000#8002");
  pair.world.settle();
  pair.world.pass(46ms);
  CHECK(pair.received() == CO_SRDO_ESTABLISHED);
  pair.world.pass(1ms);
  CHECK(pair.received() == CO_SRDO_ERR_SCT);
  CHECK(pair.line.take_texts().back() == "083#0082110000011308");
}

TEST_CASE("SRDO network: a restart of the producer does not end the error of the consumer [SR13]") {
  Pair pair;
  pair.set(1);
  pair.world.pass(5ms);
  pair.line.say("000#8202");
  pair.world.pass(60ms);
  CHECK(pair.received() == CO_SRDO_ERR_SCT);
  pair.line.say("000#0102");
  pair.set(2);
  pair.world.pass(1s);
  CHECK(pair.sent() == CO_SRDO_ESTABLISHED);
  CHECK(pair.received() == CO_SRDO_ERR_SCT);
  CHECK(pair.to.data == 1);
  pair.line.say("000#8003");
  pair.world.settle();
  pair.line.say("000#0103");
  pair.world.pass(26ms);
  CHECK(pair.received() == CO_SRDO_ESTABLISHED);
  CHECK(pair.to.data == 2);
}

TEST_CASE("SRDO network: a restart of the consumer does not disturb the producer [SR13]") {
  Pair pair;
  pair.world.pass(5ms);
  pair.line.say("000#8103");
  pair.world.pass(100ms);
  CHECK(pair.sent() == CO_SRDO_ESTABLISHED);
  CHECK(pair.received() == CO_SRDO_NOT_OPERATIONAL);
  pair.line.say("000#0103");
  pair.world.pass(26ms);
  CHECK(pair.received() == CO_SRDO_ESTABLISHED);
}

TEST_CASE("SRDO network: a quick restart of the producer is a pair in time or an error and never wrong data [SR13]") {
  for (unsigned ms = 0; ms <= 80; ++ms) {
    Pair pair;
    pair.set(1);
    pair.world.pass(5ms);
    pair.line.say("000#8202");
    pair.world.pass(Milliseconds(ms));
    pair.set(2);
    pair.line.say("000#0102");
    pair.world.pass(1ms);
    const bool in_time = pair.received() == CO_SRDO_ESTABLISHED;
    CHECK(in_time == (ms <= 45));
    CHECK(pair.to.data == (in_time ? 2 : 1));
  }
}

TEST_CASE("SRDO network: frames that another node injects end the SRDO [SR13]") {
  for (const char* frame : {"103#11223344", "103#", "104#EEDDCCBB", "104#"}) {
    Pair pair;
    pair.set(1);
    pair.world.pass(5ms);
    pair.line.say(frame);
    pair.world.pass(25ms);
    CHECK(pair.received() >= CO_SRDO_ERR_CONFIGURATION);
    CHECK(pair.to.data == 1);
    CHECK(pair.sent() == CO_SRDO_ESTABLISHED);
  }
}

TEST_CASE("SRDO network: another configuration of the producer is found by its signature [SR6]") {
  Pair pair;
  pair.line.say("000#8000");
  pair.world.settle();
  pair.line.take();
  pair.producer_table[5].Data = 30;  // 1301h:2
  pair.from.valid = CO_SRDO_CONFIGURATION_VALID;
  CODictInit(&pair.producer.node.Dict, &pair.producer.node, pair.producer_table.data(),
             static_cast<std::uint16_t>(pair.producer_table.size()));
  pair.line.say("000#0100");
  pair.world.pass(100ms);
  CHECK(pair.sent() == CO_SRDO_ERR_CONFIGURATION);
  CHECK(pair.received() == CO_SRDO_INITIALISING);
  CHECK(pair.line.take_texts() == Texts{"082#0063110000FF1301"});
}

// Numbers of a linear congruential generator.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : state_(seed) {}
  std::uint32_t below(std::uint32_t limit) {
    state_ = state_ * 1664525U + 1013904223U;
    return (state_ >> 8) % limit;
  }

 private:
  std::uint32_t state_;
};

// Sends a frame of an SRDO: mostly the right one, otherwise with one wrong byte or a wrong length.
void send_any_frame(SrdoNode& node, Numbers& numbers, std::uint8_t value, bool inverse) {
  CO_IF_FRM frm = frame(inverse ? "10A#00DDCC" : "109#002233");
  frm.Data[0] = static_cast<std::uint8_t>(inverse ? ~value : value);
  const std::uint32_t kind = numbers.below(8);
  if (kind == 0) frm.Data[numbers.below(3)] = static_cast<std::uint8_t>(numbers.below(256));
  if (kind == 1) frm.DLC = static_cast<std::uint8_t>(numbers.below(3));
  std::fill(frm.Data + frm.DLC, std::end(frm.Data), std::uint8_t{0});
  node.rx(frm);
}

TEST_CASE("SRDO robustness: any frames and times and writes keep both objects inverse [SR8] [SR13]") {
  constexpr const char* commands[] = {"000#0101", "000#8001", "000#0101", "000#0201", "000#0101", "000#8201"};
  constexpr std::pair<std::uint16_t, std::uint8_t> objects[] = {{0x1301, 1}, {0x1301, 3}, {0x1381, 0},
                                                                {0x13FE, 0}, {0x1301, 4}, {0x13FE, 0}};
  for (std::uint32_t seed = 0; seed < 200; seed += stride(20)) {
    SrdoTable table;
    table.srdo[0].receive(0x109, pair_of_3);
    SrdoNode node(table);
    Numbers numbers(seed);
    node.start();
    for (unsigned step = 0; step < 300; ++step) {
      const auto value = static_cast<std::uint8_t>(numbers.below(256));
      const std::uint8_t before = node.u8[0];
      const std::uint32_t action = numbers.below(32);
      if (action == 0) node.rx(commands[numbers.below(6)]);
      if (action == 1) node.after(Milliseconds(numbers.below(60)));
      if (action == 2 && node.mode() != CO_STOP) {
        const auto& [index, sub] = objects[numbers.below(6)];
        (void)node.download(index, sub, {index == 0x13FE ? std::uint8_t{0xA5} : value});
      }
      if (action > 2) send_any_frame(node, numbers, value, false);
      node.trace();
      CHECK(node.u8[0] == before);
      if (action > 3) send_any_frame(node, numbers, value, true);
      node.trace();
      const bool changed = node.u8[0] != before;
      CHECK((node.u8[0] ^ node.inverse8[0]) == 0xFF);
      CHECK((node.u16[0] ^ node.inverse16[0]) == 0xFFFF);
      CHECK((!changed || node.state() == CO_SRDO_ESTABLISHED));
      CHECK((node.state() == CO_SRDO_NOT_OPERATIONAL || node.state() == CO_SRDO_DELETED ||
             node.mode() == CO_OPERATIONAL));
    }
  }
}

}  // namespace

#endif
