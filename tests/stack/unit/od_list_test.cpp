// SPDX-License-Identifier: Apache-2.0
// Index of the OD access interface (co_od.h): OD_init(), OD_find(), OD_getIndex(). The node is not initialised.

// The dictionary contains C casts, as in firmware.
#pragma GCC diagnostic ignored "-Wold-style-cast"

#include <cstring>
#include <vector>

#include "support/od.hpp"

#if USE_OD

namespace {

std::uint8_t u8;
std::uint32_t u32;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&u8)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(7)},
    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(8)},
    {CO_KEY(0x2000, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x2000, 1, CO_OBJ____PRW), OD_TUNSIGNED32, (CO_DATA)(&u32)},
    {CO_KEY(0x2000, 2, CO_OBJ____PRW), OD_TUNSIGNED8, (CO_DATA)(&u8)},
    {CO_KEY(0x2001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x2001, 3, CO_OBJ_____RW), OD_TUNSIGNED8, (CO_DATA)(&u8)},
    {CO_KEY(0x2002, 1, CO_OBJ_____RW), OD_TUNSIGNED8, (CO_DATA)(&u8)},
    {CO_KEY(0xFFFF, 0, CO_OBJ_____RW), OD_TUNSIGNED8, (CO_DATA)(&u8)},
    CO_OBJ_DICT_ENDMARK,
};
constexpr std::uint16_t entries = sizeof od / sizeof *od;

struct Expected {
  std::uint16_t index;
  unsigned subs;
  unsigned kind;
};
constexpr Expected expected[] = {{0x1000, 1, ODT_VAR}, {0x1001, 1, ODT_VAR}, {0x1018, 3, ODT_ARR}, {0x2000, 3, ODT_REC},
                                 {0x2001, 2, ODT_REC}, {0x2002, 1, ODT_REC}, {0xFFFF, 1, ODT_VAR}};
constexpr std::uint16_t objects = sizeof expected / sizeof *expected;

// An index whose memory is not zeroed.
struct Index {
  OD_entry_t list[40];
  OD_t od{};
  CO_NODE node;

  explicit Index() {
    std::memset(list, 0xA5, sizeof list);
    std::memset(static_cast<void*>(&node), 0xA5, sizeof node);
  }
  ODR_t init(const CO_OBJ* table, std::uint16_t length, std::uint16_t room = 40) {
    return OD_init(&od, list, room, &node, const_cast<CO_OBJ*>(table), length);
  }
};

bool is_zero(const OD_entry_t& entry) {
  return entry.index == 0 && entry.subEntriesCount == 0 && entry.odObjectType == 0 && entry.odObject == nullptr &&
         entry.extension == nullptr;
}

OD_extension_t extension{};

}  // namespace

TEST_CASE("OD_init: the list is sorted by index, has each object once and ends with an entry of zeros") {
  Index index;
  REQUIRE(index.init(od, entries) == ODR_OK);
  REQUIRE(index.od.size == objects);
  CHECK(index.od.list == index.list);
  for (unsigned n = 0; n < objects; ++n) {
    CAPTURE(n);
    const OD_entry_t& entry = index.list[n];
    CHECK(entry.index == expected[n].index);
    CHECK(unsigned{entry.subEntriesCount} == expected[n].subs);
    CHECK((unsigned{entry.odObjectType} & ODT_TYPE_MASK) == expected[n].kind);
    CHECK(entry.odObject != nullptr);
    CHECK(entry.extension == nullptr);
  }
  CHECK(is_zero(index.list[objects]));
}

TEST_CASE("OD_init: the table ends with the end mark or its length") {
  Index index;
  REQUIRE(index.init(od, 1) == ODR_OK);
  CHECK(index.od.size == 1);
  CHECK(is_zero(index.list[1]));
  std::vector<CO_OBJ> behind(od, od + entries);
  behind.push_back(od[0]);
  REQUIRE(index.init(behind.data(), static_cast<std::uint16_t>(behind.size())) == ODR_OK);
  CHECK(index.od.size == objects);
  CHECK(is_zero(index.list[objects]));
}

TEST_CASE("OD_init: an empty table has no objects") {
  Index index;
  CHECK(index.init(&od[entries - 1], 1) == ODR_OK);
  CHECK(index.od.size == 0);
  CHECK(is_zero(index.list[0]));
  CHECK(OD_find(&index.od, 0x1000) == nullptr);
  CHECK(OD_find(&index.od, 0) == nullptr);
  CHECK(index.init(od, 0, 1) == ODR_OK);
  CHECK(index.od.size == 0);
}

TEST_CASE("OD_init: a list that is too short is refused with its required length and finds nothing") {
  Index index;
  CHECK(index.init(od, entries, objects) == ODR_OUT_OF_MEM);
  CHECK(index.od.size == objects);
  CHECK(OD_find(&index.od, 0x1000) == nullptr);
  CHECK(index.init(od, entries, 0) == ODR_OUT_OF_MEM);
  CHECK(index.list[0].index == 0xA5A5);
  CHECK(index.init(od, entries, OD_LIST_N(objects)) == ODR_OK);
  CHECK(OD_find(&index.od, 0x1000) != nullptr);
}

TEST_CASE("OD_init: a null argument is ODR_DEV_INCOMPAT") {
  Index index;
  auto* const table = const_cast<CO_OBJ*>(od);
  CHECK(OD_init(nullptr, index.list, 40, &index.node, table, entries) == ODR_DEV_INCOMPAT);
  CHECK(OD_init(&index.od, nullptr, 40, &index.node, table, entries) == ODR_DEV_INCOMPAT);
  CHECK(OD_init(&index.od, index.list, 40, nullptr, table, entries) == ODR_DEV_INCOMPAT);
  CHECK(OD_init(&index.od, index.list, 40, &index.node, nullptr, entries) == ODR_DEV_INCOMPAT);
}

TEST_CASE("OD_init: a table that is not ascending is ODR_DEV_INCOMPAT") {
  Index index;
  const CO_OBJ descending[] = {od[1], od[0]};
  const CO_OBJ twice[] = {od[0], od[0]};
  const CO_OBJ twice_with_other_flags[] = {od[0], {CO_KEY(0x1000, 0, CO_OBJ_DN__R_), CO_TUNSIGNED8, (CO_DATA)(&u8)}};
  CHECK(index.init(descending, 2) == ODR_DEV_INCOMPAT);
  CHECK(index.init(twice, 2) == ODR_DEV_INCOMPAT);
  CHECK(index.init(twice_with_other_flags, 2) == ODR_DEV_INCOMPAT);
}

TEST_CASE("OD_init: an object with 256 sub-indices is found up to its last one") {
  std::vector<CO_OBJ> table;
  for (unsigned sub = 0; sub < 256; ++sub) {
    table.push_back({CO_KEY(0x2000, sub, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&u8)});
  }
  Index index;
  REQUIRE(index.init(table.data(), 256) == ODR_OK);
  CHECK(unsigned{index.list[0].subEntriesCount} == 255);
  OD_IO_t io;
  CHECK(OD_getSub(OD_find(&index.od, 0x2000), 255, &io, false) == ODR_OK);
  CHECK(unsigned{io.stream.subIndex} == 255);
}

TEST_CASE("OD_init: extensions are kept for their objects when the table changes") {
  Index index;
  REQUIRE(index.init(od, entries) == ODR_OK);
  OD_extension_t other{};
  REQUIRE(OD_extension_init(OD_find(&index.od, 0x2000), &extension) == ODR_OK);
  REQUIRE(OD_extension_init(OD_find(&index.od, 0xFFFF), &other) == ODR_OK);

  SUBCASE("objects are removed") {
    const CO_OBJ fewer[] = {od[6], od[11]};
    REQUIRE(index.init(fewer, 2) == ODR_OK);
    CHECK(index.od.size == 2);
    CHECK(index.list[0].extension == &extension);
    CHECK(index.list[1].extension == &other);
    CHECK(is_zero(index.list[2]));
  }
  SUBCASE("an extended object is removed, objects before it stay") {
    REQUIRE(index.init(od, 8) == ODR_OK);
    CHECK(OD_find(&index.od, 0x2000)->extension == &extension);
    CHECK(is_zero(index.list[index.od.size]));
  }
  SUBCASE("objects are added") {
    std::vector<CO_OBJ> more(od, od + 1);
    for (std::uint16_t n = 0x1F00; n < 0x1F10; ++n) {
      more.push_back({CO_KEY(n, 0, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&u8)});
    }
    more.insert(more.end(), od + 5, od + entries);
    REQUIRE(index.init(more.data(), static_cast<std::uint16_t>(more.size())) == ODR_OK);
    for (unsigned n = 0; n < index.od.size; ++n) {
      const OD_entry_t& entry = index.list[n];
      CAPTURE(entry.index);
      const OD_extension_t* const has = entry.index == 0x2000 ? &extension : entry.index == 0xFFFF ? &other : nullptr;
      CHECK(entry.extension == has);
    }
    CHECK(index.od.size == 1 + 16 + 4);
  }
  SUBCASE("the extended object is removed, and added without extension") {
    REQUIRE(index.init(od, 3) == ODR_OK);
    CHECK(OD_find(&index.od, 0x2000) == nullptr);
    REQUIRE(index.init(od, entries) == ODR_OK);
    CHECK(OD_find(&index.od, 0x2000)->extension == nullptr);
  }
  SUBCASE("another list gets the extensions") {
    OD_entry_t list[OD_LIST_N(objects)];
    REQUIRE(OD_init(&index.od, list, OD_LIST_N(objects), &index.node, const_cast<CO_OBJ*>(od), entries) == ODR_OK);
    CHECK(OD_find(&index.od, 0x2000) == &list[3]);
    CHECK(list[3].extension == &extension);
    CHECK(list[6].extension == &other);
    CHECK(list[0].extension == nullptr);
  }
  SUBCASE("a list that is too short keeps them") {
    OD_entry_t another[OD_LIST_N(objects)];
    for (OD_entry_t* const list : {index.list, another}) {
      REQUIRE(index.init(od, entries, objects) == ODR_OUT_OF_MEM);
      CHECK(OD_find(&index.od, 0x2000) == nullptr);
      REQUIRE(OD_init(&index.od, list, OD_LIST_N(objects), &index.node, const_cast<CO_OBJ*>(od), entries) == ODR_OK);
      CHECK(OD_find(&index.od, 0x2000)->extension == &extension);
      CHECK(OD_find(&index.od, 0xFFFF)->extension == &other);
    }
  }
  SUBCASE("another node starts without extensions") {
    CO_NODE node;
    REQUIRE(OD_init(&index.od, index.list, 40, &node, const_cast<CO_OBJ*>(od), entries) == ODR_OK);
    CHECK(OD_find(&index.od, 0x2000)->extension == nullptr);
  }
}

TEST_CASE("OD_init: two dictionaries share only a constant table") {
  Index one;
  Index other;
  REQUIRE(one.init(od, entries) == ODR_OK);
  REQUIRE(other.init(od, entries) == ODR_OK);
  REQUIRE(OD_extension_init(OD_find(&one.od, 0x2000), &extension) == ODR_OK);
  CHECK(OD_find(&other.od, 0x2000)->extension == nullptr);
}

TEST_CASE("OD_find: each object is found and no other one") {
  Index index;
  REQUIRE(index.init(od, entries) == ODR_OK);
  unsigned found = 0;
  for (std::uint32_t number = 0; number <= 0xFFFF; ++number) {
    const OD_entry_t* const entry = OD_find(&index.od, static_cast<std::uint16_t>(number));
    if (entry != nullptr) {
      REQUIRE(entry->index == number);
      ++found;
    }
  }
  CHECK(found == objects);
}

TEST_CASE("OD_find: a null, an empty and an uninitialised dictionary have no objects") {
  OD_t empty{};
  CHECK(OD_find(nullptr, 0x1000) == nullptr);
  CHECK(OD_find(&empty, 0x1000) == nullptr);
}

TEST_CASE("OD_find: a list made by the application is searched") {
  OD_entry_t list[] = {{0x1000, 1, ODT_VAR, nullptr, nullptr}, {0x2000, 1, ODT_VAR, nullptr, nullptr}, {}};
  OD_t own{};
  own.size = 2;
  own.list = list;
  CHECK(OD_find(&own, 0x1000) == &list[0]);
  CHECK(OD_find(&own, 0x2000) == &list[1]);
  CHECK(OD_find(&own, 0x1001) == nullptr);
  CHECK(OD_find(&own, 0) == nullptr);
}

TEST_CASE("OD_getIndex: returns the index of an entry, 0 for null") {
  Index index;
  REQUIRE(index.init(od, entries) == ODR_OK);
  CHECK(OD_getIndex(OD_find(&index.od, 0x2001)) == 0x2001);
  CHECK(OD_getIndex(nullptr) == 0);
}

#endif
