// SPDX-License-Identifier: Apache-2.0
// Domains and strings: start position of accesses, capacity, and memory that must not be written.
#include <cstring>

#include "support/fixture.hpp"

namespace {

using namespace test;

// Values from a domain ------------------------------------------------------------------------------------------------

TEST_CASE("stream access: CODictRdLong and the like access the beginning of a domain even during its upload") {
  Fixture node;
  CO_DICT* const dict = &node->Dict;
  node.ask("601#4000210F00000000", "581#4100210F0F000000");
  node.ask("601#6000000000000000", "581#0001020304050607");
  std::uint8_t byte = 0;
  std::uint16_t word = 0;
  std::uint32_t value = 0;
  for (int twice = 0; twice < 2; ++twice) {
    CHECK(CODictRdByte(dict, CO_DEV(0x2100, 15), &byte) == CO_ERR_NONE);
    CHECK(byte == 0x01);
    CHECK(CODictRdWord(dict, CO_DEV(0x2100, 15), &word) == CO_ERR_NONE);
    CHECK(CODictRdLong(dict, CO_DEV(0x2100, 15), &value) == CO_ERR_NONE);
  }
  const std::uint8_t first[] = {1, 2, 3, 4};
  CHECK(std::memcmp(&word, first, 2) == 0);
  CHECK(std::memcmp(&value, first, 4) == 0);
  node.ask("601#7000000000000000", "581#1008090A0B0C0D0E");
  CHECK(CODictWrLong(dict, CO_DEV(0x2100, 15), 0x55555555) == CO_ERR_NONE);
  CHECK(CODictWrWord(dict, CO_DEV(0x2100, 15), 0x6666) == CO_ERR_NONE);
  CHECK(CODictWrByte(dict, CO_DEV(0x2100, 15), 0x77) == CO_ERR_NONE);
  node.ask("601#6000000000000000", "581#0D0F000000000000");
  CHECK(node.objects.memory[15] == Bytes{0x77, 0x66, 0x55, 0x55, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
}

TEST_CASE("stream access: CODictWrLong starts at the beginning of a domain, also during its download") {
  Fixture node;
  node.ask("601#2100210F0F000000", "581#6000210F00000000");
  node.ask("601#0011121314151617", "581#2000000000000000");
  CHECK(CODictWrLong(&node->Dict, CO_DEV(0x2100, 15), 0x55555555) == CO_ERR_NONE);
  node.ask("601#101A1B1C1D1E1F20", "581#3000000000000000");
  node.ask("601#0D21000000000000", "581#2000000000000000");
  CHECK(node.objects.memory[15] ==
        Bytes{0x55, 0x55, 0x55, 0x55, 0x15, 0x16, 0x17, 0x1A, 0x1B, 0x1C, 0x1D, 0x1E, 0x1F, 0x20, 0x21});
}

// Capacity ------------------------------------------------------------------------------------------------------------

TEST_CASE("stream access: one byte to a UNICODE_STRING is refused with 0607 0012h [D5]") {
  Fixture node;
  node.ask("601#2F12210041000000", "581#8012210012000706");
  node.ask("601#2112210001000000", "581#8012210012000706");
  node.ask("601#2012210000000000", "581#6012210000000000");
  node.ask("601#0D41000000000000", "581#8012210012000706");
}

TEST_CASE("stream access: any write to a stream without capacity is refused with 0607 0012h [D5]") {
  for (const std::string object : {"102100", "112100", "122100", "002100"}) {
    CAPTURE(object);
    Fixture node(Setup().before_init([](Objects& o) {
      o.text = {0, 0, 0, o.text_memory};
      o.octets = {0, 0, 0, o.octets_memory};
      o.unicode = {0, 0, 0, reinterpret_cast<std::uint8_t*>(o.unicode_memory)};
    }));
    const std::string refused = "581#80" + object + "12000706";
    for (const char* command : {"601#2F", "601#2B", "601#27", "601#23"}) {
      node.ask(command + object + "41424344", refused);
    }
    for (const char* size : {"01000000", "02000000", "05000000", "FFFFFFFF"}) {
      node.ask("601#21" + object + size, refused);
    }
    node.ask("601#20" + object + "00000000", "581#60" + object + "00000000");
    node.ask("601#0B41420000000000", refused);
    node.ask("601#21" + object + "00000000", "581#60" + object + "00000000");
    node.ask("601#0F00000000000000", "581#2000000000000000");
  }
}

TEST_CASE("stream access: a string written beyond its capacity keeps its memory and at most that size") {
  Fixture node;
  struct Case {
    std::uint16_t index;
    const CO_OBJ_STR_RW* string;
  };
  const Case cases[] = {{0x2110, &node.objects.text}, {0x2111, &node.objects.octets}, {0x2112, &node.objects.unicode}};
  for (const Case& one : cases) {
    const CO_OBJ_STR_RW& string = *one.string;
    for (const std::uint32_t beyond : std::initializer_list<std::uint32_t>{1, 1000, 0xFFFFFFFF - string.Capacity}) {
      CAPTURE(one.index);
      CAPTURE(beyond);
      CO_OBJ* const obj = node.find(one.index, 0);
      const Bytes before(string.Start, string.Start + string.Capacity);
      std::uint8_t in[2] = {'x', 'y'};
      CHECK(COObjReset(obj, &node.node, string.Capacity + beyond) == CO_ERR_NONE);
      CHECK(COObjWrBufCont(obj, &node.node, in, 2) == CO_ERR_NONE);
      CHECK(string.Size == string.Capacity);
      CHECK(Bytes(string.Start, string.Start + string.Capacity) == before);
    }
  }
}

// Memory that must not be written -------------------------------------------------------------------------------------

struct Asked {
  const void* address;
  std::uint32_t size;
};

// A node whose Writable hook refuses all memory and records its arguments.
class ReadOnly : public Fixture {
 public:
  ReadOnly()
      : Fixture(Setup().writable([this](const void* address, std::uint32_t size) {
          asked.push_back({address, size});
          return false;
        })) {}

  // Checks that the hook was called, and only with these arguments.
  void check_asked(const void* address, std::uint32_t size) {
    CHECK_FALSE(asked.empty());
    for (const Asked& one : asked) {
      CHECK(one.address == address);
      CHECK(one.size == size);
    }
    asked.clear();
  }

  std::vector<Asked> asked;
};

TEST_CASE("stream access: the Writable hook is called for all of the memory and can refuse every download") {
  struct Case {
    std::string object;
    const void* memory;
    std::uint32_t size;
  };
  ReadOnly node;
  const Case cases[] = {{"00210F", node.objects.memory[15].data(), 15},
                        {"102100", node.objects.text_memory, 16},
                        {"112100", node.objects.octets_memory, 10},
                        {"122100", node.objects.unicode_memory, 8}};
  for (const Case& one : cases) {
    CAPTURE(one.object);
    const auto* const first = static_cast<const std::uint8_t*>(one.memory);
    const Bytes before(first, first + one.size);
    const std::string refused = "581#80" + one.object + "00000106";
    // Expedited with 2 and 4 bytes; segmented without and with size.
    for (const char* request : {"601#2B", "601#23", "601#20", "601#21"}) {
      CAPTURE(std::string(request));
      node.ask(request + one.object + "04000000", refused);
      node.check_asked(one.memory, one.size);
      node.ask("601#0011223300000000", "581#8011223301000405");
    }
    node.ask("601#21" + one.object + "00000000", refused);  // size 0
    node.check_asked(one.memory, one.size);
    CHECK(Bytes(first, first + one.size) == before);
  }
  CHECK(node.objects.text.Size == 4);
  CHECK(node.objects.octets.Size == 6);
  CHECK(node.objects.unicode.Size == 6);
}

TEST_CASE("stream access: a protected end of the memory refuses a short download") {
  Fixture* self = nullptr;
  Fixture node(Setup().writable([&](const void* address, std::uint32_t size) {
    const auto* const byte = static_cast<const std::uint8_t*>(address);
    const std::uint8_t* const last = self->objects.octets_memory + 9;
    return byte > last || byte + size <= last;
  }));
  self = &node;
  node.ask("601#2F11210041000000", "581#8011210000000106");
  node.ask("601#2111210003000000", "581#8011210000000106");
  node.ask("601#2F10210041000000", "581#6010210000000000");
  CHECK(node.objects.octets_memory[0] == 1);
}

TEST_CASE("stream access: memory that becomes protected during a download is not written from then on") {
  bool allow = true;
  Fixture node(Setup().writable([&](const void*, std::uint32_t) { return allow; }));
  node.ask("601#2100210F0F000000", "581#6000210F00000000");
  node.ask("601#0011121314151617", "581#2000000000000000");
  allow = false;
  node.ask("601#1021222324252627", "581#8000210F00000106");
  CHECK(node.objects.memory[15] == Bytes{0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x17, 8, 9, 10, 11, 12, 13, 14, 15});
}

}  // namespace
