// SPDX-License-Identifier: Apache-2.0
// Mapping of adjacent variables, which are copied together: PDOs contain the bytes of each object in every order,
// alignment and combination of widths.
#include <cstring>
#include <memory>
#include <numeric>

#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 0 && CO_RPDO_N > 0

namespace {

using namespace test;

constexpr std::size_t memory_size = 40;
constexpr std::size_t guard = 12;

// A variable of 1, 2 or 4 bytes at an offset of the memory.
struct Variable {
  std::size_t offset;
  unsigned bytes;
};

const CO_OBJ_TYPE* type_of(unsigned bytes) {
  return bytes == 1 ? CO_TUNSIGNED8 : bytes == 2 ? CO_TUNSIGNED16 : CO_TUNSIGNED32;
}

// A node with the variables at 2300h:1, 2300h:2, …, which the first RPDO and TPDO map in the given order.
class MergeNode {
 public:
  MergeNode(const std::vector<Variable>& variables, const std::vector<std::size_t>& order) {
    for (std::size_t n = 0; n < memory_size; ++n) memory[n] = filler(n);
    PdoTable table;
    PdoEntries& rpdo = table.rpdo[0].on(0x201, 255, {});
    PdoEntries& tpdo = table.tpdo[0].on(0x40000181, 255, {});
    for (const std::size_t n : order) {
      const std::uint32_t word = 0x23000000U | static_cast<std::uint32_t>(n + 1) << 8 | variables[n].bytes * 8;
      rpdo.map[rpdo.number++] = word;
      tpdo.map[tpdo.number++] = word;
      length += variables[n].bytes;
    }
    node = std::make_unique<PdoNode>(table, [&](Setup& setup) {
      for (std::size_t n = 0; n < variables.size(); ++n) {
        setup.with(
            {CO_KEY(0x2300, n + 1, CO_OBJ____PRW), type_of(variables[n].bytes), CO_DATA(memory + variables[n].offset)});
      }
    });
    for (std::size_t n = 0; n < variables.size(); ++n) node->may_change(0x2300, static_cast<std::uint8_t>(n + 1));
    node->start();
    check(variables, order);
  }

 private:
  // Returns the offset of a byte of the variable in memory. Byte 0 is the least significant one, as on the bus.
  static std::size_t offset_of(const Variable& variable, unsigned byte) {
    constexpr bool little_endian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
    return variable.offset + (little_endian ? byte : variable.bytes - 1 - byte);
  }

  static std::uint8_t filler(std::size_t n) { return static_cast<std::uint8_t>(0xA0 + n); }

  void check(const std::vector<Variable>& variables, const std::vector<std::size_t>& order) {
    CO_IF_FRM out{0x181, {}, static_cast<std::uint8_t>(length)};
    CO_IF_FRM in{0x201, {}, static_cast<std::uint8_t>(length)};
    std::uint8_t after[memory_size];
    std::memcpy(after, memory, memory_size);
    unsigned position = 0;
    for (const std::size_t n : order) {
      for (unsigned byte = 0; byte < variables[n].bytes; ++byte, ++position) {
        const std::size_t offset = offset_of(variables[n], byte);
        out.Data[position] = memory[offset];
        in.Data[position] = static_cast<std::uint8_t>(0x51 + position);
        after[offset] = in.Data[position];
      }
    }
    node->trigger(0);
    node->tx(notation(out));
    node->rx(in);
    CHECK(std::memcmp(memory, after, memory_size) == 0);
    std::memcpy(out.Data, in.Data, sizeof out.Data);
    node->trigger(0);
    node->tx(notation(out));
  }

 public:
  alignas(8) std::uint8_t memory[memory_size];
  unsigned length = 0;
  std::unique_ptr<PdoNode> node;
};

std::vector<std::size_t> as_they_are(std::size_t number) {
  std::vector<std::size_t> order(number);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

// Returns adjacent variables of the given widths, from an offset on.
std::vector<Variable> row(const std::vector<unsigned>& widths, std::size_t offset) {
  std::vector<Variable> all;
  for (const unsigned bytes : widths) {
    all.push_back({offset, bytes});
    offset += bytes;
  }
  return all;
}

TEST_CASE("PDO merge: 8 u8, 4 u16 or 2 u32 are copied at every alignment") {
  for (std::size_t offset = guard; offset < guard + 8; ++offset) {
    CAPTURE(offset);
    MergeNode(row(std::vector<unsigned>(8, 1), offset), as_they_are(8));
    MergeNode(row(std::vector<unsigned>(4, 2), offset), as_they_are(4));
    MergeNode(row(std::vector<unsigned>(2, 4), offset), as_they_are(2));
  }
}

TEST_CASE("PDO merge: every mixture of widths that fits into a PDO is copied at every alignment") {
  const auto extend = [](const auto& self, std::vector<unsigned>& widths, unsigned used) -> void {
    if (!widths.empty()) {
      for (std::size_t offset = guard + widths.size() % stride(4); offset < guard + 4; offset += stride(4)) {
        CAPTURE(widths.size());
        MergeNode(row(widths, offset), as_they_are(widths.size()));
      }
    }
    for (const unsigned bytes : {1U, 2U, 4U}) {
      if (used + bytes <= (widths.size() < 3 ? 8U : 6U) && widths.size() < 5) {
        widths.push_back(bytes);
        self(self, widths, used + bytes);
        widths.pop_back();
      }
    }
  };
  std::vector<unsigned> widths;
  extend(extend, widths, 0);
}

TEST_CASE("PDO merge: adjacent variables are copied in every order") {
  for (const std::vector<unsigned>& widths :
       {std::vector<unsigned>{1, 1, 1, 1, 1}, std::vector<unsigned>{2, 2, 2, 2}, std::vector<unsigned>{4, 4},
        std::vector<unsigned>{1, 1, 2, 4}, std::vector<unsigned>{2, 1, 1, 2}}) {
    std::vector<std::size_t> order = as_they_are(widths.size());
    unsigned round = 0;
    do {
      for (std::size_t offset = guard; offset <= guard + 2; ++offset) {
        if (round++ % stride(10) == 0) MergeNode(row(widths, offset), order);
      }
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST_CASE("PDO merge: adjacent variables with one omitted or mapped elsewhere in the PDO are copied") {
  const std::vector<Variable> variables = row({1, 1, 1, 1, 1, 1}, guard);
  for (const std::vector<std::size_t>& order :
       {std::vector<std::size_t>{0, 1, 3, 4}, std::vector<std::size_t>{0, 2, 4},
        std::vector<std::size_t>{3, 4, 5, 0, 1, 2}, std::vector<std::size_t>{0, 1, 5, 2, 3},
        std::vector<std::size_t>{5, 0, 1, 2, 3, 4}}) {
    MergeNode(variables, order);
  }
}

TEST_CASE("PDO merge: gaps between variables are not written") {
  for (std::size_t gap = 0; gap < 5; ++gap) {
    const std::size_t at[] = {guard, guard + 1 + gap, guard + 4 + 2 * gap};
    MergeNode({{at[0], 1}, {at[1], 2}, {at[2], 4}}, {0, 1, 2});
  }
}

TEST_CASE("PDO merge: members of a structure with mixed widths are copied") {
  struct Record {
    std::uint16_t a, b;
    std::uint8_t c, d;
    std::uint16_t e;
  } record = {0x1211, 0x1413, 0x15, 0x16, 0x1817};
  PdoTable table;
  const std::initializer_list<std::uint32_t> words = {0x23000110, 0x23000210, 0x23000308, 0x23000408, 0x23000510};
  table.rpdo[0].on(0x201, 255, words);
  table.tpdo[0].on(0x40000181, 255, words);
  PdoNode node(table, [&](Setup& setup) {
    setup.with({CO_KEY(0x2300, 1, CO_OBJ____PRW), CO_TUNSIGNED16, CO_DATA(&record.a)});
    setup.with({CO_KEY(0x2300, 2, CO_OBJ____PRW), CO_TUNSIGNED16, CO_DATA(&record.b)});
    setup.with({CO_KEY(0x2300, 3, CO_OBJ____PRW), CO_TUNSIGNED8, CO_DATA(&record.c)});
    setup.with({CO_KEY(0x2300, 4, CO_OBJ____PRW), CO_TUNSIGNED8, CO_DATA(&record.d)});
    setup.with({CO_KEY(0x2300, 5, CO_OBJ____PRW), CO_TUNSIGNED16, CO_DATA(&record.e)});
  });
  for (std::uint8_t sub = 1; sub <= 5; ++sub) node.may_change(0x2300, sub);
  node.start();
  node.trigger(0);
  node.tx("181#1112131415161718");
  node.rx("201#2122232425262728");
  CHECK(record.a == 0x2221);
  CHECK(record.b == 0x2423);
  CHECK(record.c == 0x25);
  CHECK(record.d == 0x26);
  CHECK(record.e == 0x2827);
}

TEST_CASE("PDO merge: an application-defined type, a dummy or flag D in between ends a merged copy [M8]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, 0x22010208, 0x00050008, 0x22010308, 0x22030118, 0x22010408});
  table.tpdo[0].on(0x40000181, 255, {0x22010108, 0x22010208, 0x22030118, 0x22010308, 0x22010408});
  PdoNode node(table);
  node.start();
  node.rx("201#010203040506FF08");
  CHECK(node.u8[0] == 1);
  CHECK(node.u8[1] == 2);
  CHECK(node.u8[2] == 4);
  CHECK(node.u24[0] == 0xFF0605);
  CHECK(node.u8[3] == 8);
  node.trigger(0);
  node.tx("181#01020506FF0408");
}

TEST_CASE("PDO merge: one variable in several entries and overlapping runs are copied") {
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {0x22010108, 0x22010208, 0x22010108, 0x22010208, 0x22010308});
  table.rpdo[0].on(0x201, 255, {0x22010108, 0x22010208, 0x22010108, 0x22010208, 0x22010308});
  PdoNode node(table);
  node.start();
  node.trigger(0);
  node.tx("181#1121112131");
  node.rx("201#0102030405");
  CHECK(node.u8[0] == 3);
  CHECK(node.u8[1] == 4);
  CHECK(node.u8[2] == 5);
}

TEST_CASE("PDO merge: a variable that must not be written is not merged with adjacent ones") {
  PdoTable table;
  table.rpdo[0].on(0x80000201, 255, {0x22010108, 0x22010208, 0x22010308});
  const std::uint8_t* closed = nullptr;
  PdoNode node(table, [&](Setup& setup) {
    setup.writable([&](const void* address, std::uint32_t size) {
      const auto* first = static_cast<const std::uint8_t*>(address);
      return closed == nullptr || closed < first || closed >= first + size;
    });
  });
  closed = &node.u8[1];
  REQUIRE(node.remap_rpdo(0, {0x22010108, 0x22010208, 0x22010308}, 0x201) == 0);
  node.start();
  node.rx("201#A1A2A3");
  CHECK(node.u8[0] == 0xA1);
  CHECK(node.u8[1] == 0x21);
  CHECK(node.u8[2] == 0xA3);
}

// Flag A --------------------------------------------------------------------------------------------------------------

TEST_CASE("PDO merge: an RPDO that changes several objects with flag A sends one TPDO with all new values") {
  PdoTable table;
  const std::initializer_list<std::uint32_t> words = {0x22110108, 0x22110208, 0x22120110, 0x22140120};
  table.rpdo[0].on(0x201, 255, words);
  table.tpdo[0].on(0x40000181, 255, words);
  PdoNode node(table);
  node.start();
  node.rx("201#0102030405060708");
  node.tx("181#0102030405060708");
  node.rx("201#0102030405060708");
  node.silent();  // no object has changed
  node.rx("201#01020304050607FF");
  node.tx("181#01020304050607FF");
}

#if USE_SYNC
TEST_CASE("PDO merge: RPDOs of a SYNC that change objects with flag A send each TPDO once, after all writes") {
  if (fixture_rpdos < 2 || fixture_tpdos < 2) {
    return;
  }
  SyncTable table;
  table.rpdo[0].on(0x201, 1, {0x22110108, 0x22110208});
  table.rpdo[1].on(0x301, 1, {0x22110308, 0x22110408});
  table.tpdo[0].on(0x40000181, 255, {0x22110108, 0x22110208, 0x22110308, 0x22110408});
  table.tpdo[1].on(0x40000281, 255, {0x22110408});
  SyncNode node(table);
  node.start();
  node.rx("201#0102");
  node.rx("301#0304");
  node.silent();
  node.rx("080#");
  node.tx({"181#01020304", "281#04"});
}

TEST_CASE("PDO merge: a TPDO of type 0 whose objects are changed by RPDOs of a SYNC is sent with the next SYNC [X3]") {
  SyncTable table;
  table.rpdo[0].on(0x201, 1, {0x22110108});
  table.tpdo[0].on(0x40000181, 0, {0x22110108});
  SyncNode node(table);
  node.start();
  node.rx("080#");
  node.tx("181#11");
  node.rx("201#42");
  node.rx("080#");
  node.silent();
  node.rx("080#");
  node.tx("181#42");
  node.rx("080#");
  node.silent();
}
#endif

// A type whose Read function changes 2211h:1, which has flag A.
const CO_OBJ_TYPE* meddling_type() {
  static const CO_OBJ_TYPE type = {[](CO_OBJ*, CO_NODE*, std::uint32_t) -> std::uint32_t { return 1; }, nullptr,
                                   [](CO_OBJ*, CO_NODE* node, void* buffer, std::uint32_t) {
                                     *static_cast<std::uint8_t*>(buffer) = 0x5A;
                                     std::uint8_t value = 0;
                                     (void)CODictRdByte(&node->Dict, CO_DEV(0x2211, 1), &value);
                                     ++value;
                                     return CODictWrByte(&node->Dict, CO_DEV(0x2211, 1), value);
                                   },
                                   nullptr, nullptr};
  return &type;
}

void add_meddling(Setup& setup) { setup.with({CO_KEY(0x22FF, 0, CO_OBJ____PR_), meddling_type(), 0}); }

TEST_CASE("PDO merge: an object (flag A) that a Read function changes while a TPDO is filled triggers other TPDOs") {
  if (fixture_tpdos < 2) {
    return;
  }
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {0x22FF0008, 0x22110108});
  table.tpdo[1].on(0x40000281, 255, {0x22110108});
  PdoNode node(table, add_meddling);
  node.start();
  for (const char* value : {"12", "13"}) {
    node.trigger(0);
    std::vector<std::string> sent = node.frames();
    std::sort(sent.begin(), sent.end());
    CHECK(sent == std::vector<std::string>{std::string("181#5A") + value, std::string("281#") + value});
  }
  node.after(1000ms);
  node.silent();
}

#if USE_SYNC && USE_PDO_RTR
TEST_CASE("PDO merge: an object (flag A) that a Read function changes during sampling (RTR) triggers other TPDOs") {
  SyncTable table;
  table.tpdo[0].on(0x181, 252, {0x22FF0008});
  table.tpdo[1].on(0x40000281, 255, {0x22110108});
  SyncNode node(table, add_meddling);
  node.start();
  node.rx("080#");
  node.tx("281#12");
}
#endif

#if USE_SYNC
TEST_CASE("PDO merge: an object (flag A) that a Read function changes is sent with the TPDO that is being filled") {
  SyncTable table;
  table.tpdo[0].on(0x40000181, 0, {0x22FF0008, 0x22110108});
  SyncNode node(table, add_meddling);
  node.start();
  node.rx("080#");
  node.tx("181#5A12");
  node.rx("080#");
  node.silent();
}
#endif

}  // namespace

#endif
