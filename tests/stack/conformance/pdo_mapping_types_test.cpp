// SPDX-License-Identifier: Apache-2.0
// Objects of every type and length in a PDO, compared with their values by SDO.
// [301:7.2.2, 7.1.4]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

std::string hex_bytes(const Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    constexpr char digits[] = "0123456789ABCDEF";
    text += {digits[byte >> 4], digits[byte & 0xF]};
  }
  return text;
}

Bytes joined(const Bytes& a, const Bytes& b, const Bytes& c) {
  Bytes all(a);
  all.insert(all.end(), b.begin(), b.end());
  all.insert(all.end(), c.begin(), c.end());
  return all;
}

/// A type of the application: a value of 1 to 8 bytes, whose functions log their calls.
struct UserType {
  CO_OBJ_TYPE type{size, nullptr, read, write, nullptr};
  std::uint8_t width = 0;
  Bytes value;
  std::vector<std::uint32_t> reads{};
  std::vector<std::uint32_t> writes{};

  static UserType& of(CO_OBJ* obj) { return *static_cast<UserType*>(obj->Data); }
  static std::uint32_t size(CO_OBJ* obj, CO_NODE*, std::uint32_t) { return of(obj).width; }
  static CO_ERR read(CO_OBJ* obj, CO_NODE*, void* buffer, std::uint32_t size) {
    const OutsideStack outside;
    of(obj).reads.push_back(size);
    std::copy_n(of(obj).value.begin(), size, static_cast<std::uint8_t*>(buffer));
    return CO_ERR_NONE;
  }
  static CO_ERR write(CO_OBJ* obj, CO_NODE*, void* buffer, std::uint32_t size) {
    const OutsideStack outside;
    of(obj).writes.push_back(size);
    std::copy_n(static_cast<const std::uint8_t*>(buffer), size, of(obj).value.begin());
    return CO_ERR_NONE;
  }
};

struct Values {
  Bytes first;
  Bytes second;
};

/// An entry 2300h:0, and values that may be downloaded to it.
struct Case {
  std::string name;
  std::uint8_t width;
  std::uint32_t flags;
  const CO_OBJ_TYPE* type;
  CO_DATA data;
  Values values;
};

/// Entries of all mappable types. Owns their memory.
class Types {
 public:
  Types() {
    add("BOOLEAN", 1, CO_TBOOLEAN, {{1}, {0}});
    add("INTEGER8", 1, CO_TSIGNED8, {{0x80}, {0x7F}});
    add("UNSIGNED16", 2, CO_TUNSIGNED16, {{0x01, 0x80}, {0xFF, 0x7F}});
    add("INTEGER24", 3, CO_TSIGNED24, {{0x01, 0x02, 0x83}, {0xFF, 0xFF, 0x7F}});
    add("UNSIGNED24", 3, CO_TUNSIGNED24, {{0x01, 0x02, 0x83}, {0xFF, 0xFF, 0x7F}});
    add("INTEGER32", 4, CO_TSIGNED32, {{0x01, 0x02, 0x03, 0x84}, {0xFF, 0xFE, 0xFD, 0x7C}});
    add("INTEGER40", 5, CO_TSIGNED40, {{1, 2, 3, 4, 0x85}, {0xFF, 0xFF, 0xFF, 0xFF, 0x7F}});
    add("INTEGER48", 6, CO_TSIGNED48, {{1, 2, 3, 4, 5, 0x86}, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F}});
    add("INTEGER56", 7, CO_TSIGNED56, {{1, 2, 3, 4, 5, 6, 0x87}, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F}});
    add("INTEGER64", 8, CO_TSIGNED64, {{1, 2, 3, 4, 5, 6, 7, 0x88}, {8, 7, 6, 5, 4, 3, 2, 1}});
    add("UNSIGNED56", 7, CO_TUNSIGNED56, {{1, 2, 3, 4, 5, 6, 0x87}, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F}});
    add("REAL32", 4, CO_TREAL32, {{0x00, 0x00, 0x80, 0xBF}, {0xDB, 0x0F, 0x49, 0x40}});
    add("REAL64", 8, CO_TREAL64, {{0, 0, 0, 0, 0, 0, 0xF0, 0xBF}, {0x18, 0x2D, 0x44, 0x54, 0xFB, 0x21, 0x09, 0x40}});
    add("TIME_OF_DAY", 6, CO_TTIME_OF_DAY,
        {{0x01, 0x02, 0x03, 0x04, 0x05, 0x06}, {0xFF, 0xFF, 0xFF, 0x0F, 0xFF, 0xFF}});
    add_relative();
    add_direct();
    add_streams();
    add_user_types();
  }
  const std::vector<Case>& all() const { return cases_; }
  const std::deque<UserType>& users() const { return users_; }

 private:
  void add(const std::string& name, std::uint8_t width, const CO_OBJ_TYPE* type, const Values& values,
           std::uint32_t flags = CO_OBJ____PRW) {
    numbers_.emplace_back();
    add_at(name, width, type, &numbers_.back(), values, flags);
  }
  void add_at(const std::string& name, std::uint8_t width, const CO_OBJ_TYPE* type, CO_DATA data, const Values& values,
              std::uint32_t flags = CO_OBJ____PRW) {
    cases_.push_back({name, width, flags, type, data, values});
  }
  static Values counted(unsigned width) {
    Values values{Bytes(width), Bytes(width)};
    for (unsigned k = 0; k < width; ++k) {
      values.first[k] = static_cast<std::uint8_t>(0x41 + k);
      values.second[k] = static_cast<std::uint8_t>(0xF9 - k);
    }
    return values;
  }
  void add_relative() {
    add("UNSIGNED8 relative", 1, CO_TUNSIGNED8, {{0x00}, {0xFF}}, CO_OBJ__N_PRW);
    add("UNSIGNED16 relative", 2, CO_TUNSIGNED16, {{0x00, 0x00}, {0x34, 0x12}}, CO_OBJ__N_PRW);
    add("UNSIGNED32 relative", 4, CO_TUNSIGNED32, {{0, 0, 0, 0}, {0x78, 0x56, 0x34, 0x12}}, CO_OBJ__N_PRW);
    add("UNSIGNED48 relative", 6, CO_TUNSIGNED48, {{0, 0, 0, 0, 0, 0}, {1, 2, 3, 4, 5, 6}}, CO_OBJ__N_PRW);
    add("UNSIGNED64 relative", 8, CO_TUNSIGNED64, {{0, 0, 0, 0, 0, 0, 0, 0}, {1, 2, 3, 4, 5, 6, 7, 8}}, CO_OBJ__N_PRW);
  }
  void add_direct() {
    constexpr std::uint32_t flags = CO_OBJ_D_____ | CO_OBJ____PRW;
    add_at("UNSIGNED8 direct", 1, CO_TUNSIGNED8, 5, counted(1), flags);
    add_at("UNSIGNED16 direct", 2, CO_TUNSIGNED16, 5, counted(2), flags);
    add_at("UNSIGNED24 direct", 3, CO_TUNSIGNED24, 5, counted(3), flags);
    add_at("UNSIGNED32 direct", 4, CO_TUNSIGNED32, 5, counted(4), flags);
    add_at("UNSIGNED32 direct, relative", 4, CO_TUNSIGNED32, 5, counted(4), flags | CO_OBJ__N____);
    if (sizeof(CO_DATA) == 8) {
      add_at("UNSIGNED64 direct", 8, CO_TUNSIGNED64, 5, counted(8), flags);
    }
  }
  void add_streams() {
    for (std::uint8_t width = 1; width <= 8; ++width) {
      memory_.emplace_back(width);
      domains_.push_back({3, width, memory_.back().data()});
      add_at("DOMAIN of " + std::to_string(width), width, CO_TDOMAIN, &domains_.back(), counted(width));
      memory_.emplace_back(width);
      strings_.push_back({0, width, width, memory_.back().data()});
      add_at("OCTET_STRING of " + std::to_string(width), width, CO_TOCTET_STRING, &strings_.back(), counted(width));
      memory_.emplace_back(width, std::uint8_t{'x'});
      strings_.push_back({0, width, width, memory_.back().data()});
      add_at("VISIBLE_STRING of " + std::to_string(width), width, CO_TVISIBLE_STRING, &strings_.back(), counted(width));
    }
  }
  void add_user_types() {
    for (std::uint8_t width = 1; width <= 8; ++width) {
      users_.emplace_back();
      users_.back().width = width;
      users_.back().value.resize(width);
      add_at("user type of " + std::to_string(width), width, &users_.back().type, &users_.back(), counted(width));
    }
  }

  std::vector<Case> cases_;
  std::deque<std::uint64_t> numbers_;
  std::deque<Bytes> memory_;
  std::deque<CO_OBJ_DOM> domains_;
  std::deque<CO_OBJ_STR_RW> strings_;
  std::deque<UserType> users_;
};

/// A mapping of the object alone, or between two other bytes.
struct Around {
  Around(const Case& one, bool alone) {
    constexpr bool bits = USE_PDO_BITS != 0;
    const std::uint32_t length = one.type == CO_TBOOLEAN && bits ? 1 : 8U * one.width;
    words = {0x23000000U | length};
    if (!alone) {
      words.insert(words.begin(), 0x22010108);
      words.push_back(0x22010208);
      before = {0x11};
      after = {0x21};
    }
  }
  std::vector<std::uint32_t> words;
  Bytes before;
  Bytes after;
};

template <class Function>
void for_each_type(const Function& function) {
  Types types;
  for (const Case& one : types.all()) {
    if (one.type == CO_TBOOLEAN && USE_PDO_BITS != 0) {
      continue;
    }
    CAPTURE(one.name);
    for (const bool alone : {true, false}) {
      if (!alone && one.width > 6) {
        continue;
      }
      CAPTURE(alone);
      PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(0x2300, 0, one.flags), one.type, one.data}); });
      node.may_change(0x2300, 0);
      node.start();
      function(node, one, Around(one, alone));
    }
  }
}

TEST_CASE("PDO layout: an RPDO writes the bytes that an SDO upload reads, for every type of 1 to 8 bytes") {
  for_each_type([](PdoNode& node, const Case& one, const Around& around) {
    REQUIRE(node.remap_rpdo(0, around.words, 0x201) == 0);
    for (const Bytes& value : {one.values.first, one.values.second, one.values.first}) {
      node.rx("201#" + hex_bytes(joined(around.before, value, around.after)));
      CHECK(node.upload(0x2300, 0) == value);
    }
    CHECK(node.u8[0] == 0x11);
    CHECK(node.u8[1] == 0x21);
  });
}

TEST_CASE("PDO layout: a TPDO contains the bytes of an SDO download, for every type of 1 to 8 bytes") {
  for_each_type([](PdoNode& node, const Case& one, const Around& around) {
    REQUIRE(node.remap_tpdo(0, around.words, 0x40000181) == 0);
    for (const Bytes& value : {one.values.first, one.values.second, one.values.first}) {
      CHECK(node.download(0x2300, 0, value) == 0);
      node.trigger(0);
      node.tx("181#" + hex_bytes(joined(around.before, value, around.after)));
    }
  });
}

TEST_CASE("PDO layout: a segmented SDO upload and a PDO of one stream are independent [D25]") {
  std::uint8_t memory[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  CO_OBJ_DOM domain{0, 8, memory};
  PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(0x2300, 0, CO_OBJ____PRW), CO_TDOMAIN, &domain}); });
  node.may_change(0x2300, 0);
  node.start();
  REQUIRE(node.remap_tpdo(0, {0x23000040}, 0x40000181) == 0);
  REQUIRE(node.remap_rpdo(0, {0x23000040}, 0x201) == 0);
  for (int times = 0; times < 3; ++times) {
    node.trigger(0);
    node.tx("181#0102030405060708");
    CHECK(node.upload(0x2300, 0) == Bytes{1, 2, 3, 4, 5, 6, 7, 8});
    node.rx("201#0102030405060708");
  }
}

TEST_CASE("PDO layout: a stream must have the mapped length [M5]") {
  std::uint8_t memory[9] = {};
  for (std::uint8_t size = 1; size <= 9; ++size) {
    CO_OBJ_DOM domain{0, size, memory};
    CO_OBJ_STR_RW octets{0, size, size, memory};
    PdoNode node({}, [&](Setup& setup) {
      setup.with({CO_KEY(0x2300, 1, CO_OBJ____PRW), CO_TDOMAIN, &domain});
      setup.with({CO_KEY(0x2300, 2, CO_OBJ____PRW), CO_TOCTET_STRING, &octets});
    });
    for (std::uint32_t bytes = 1; bytes <= 9; ++bytes) {
      CAPTURE(unsigned{size});
      CAPTURE(bytes);
      const std::uint32_t expected = bytes == size && bytes <= 8 ? 0 : 0x06040041;
      CHECK(node.set(0x1A00, 1, 4, 0x23000100U | bytes * 8U) == expected);
      CHECK(node.set(0x1A00, 2, 4, 0x23000200U | bytes * 8U) == expected);
      CHECK(node.set(0x1600, 1, 4, 0x23000100U | bytes * 8U) == expected);
    }
  }
}

TEST_CASE("PDO layout: signed numbers of 3, 5, 6 and 7 bytes are sign-extended to their variable") {
  struct Signed {
    std::uint8_t width;
    const CO_OBJ_TYPE* type;
  };
  for (const Signed& one :
       {Signed{3, CO_TSIGNED24}, Signed{5, CO_TSIGNED40}, Signed{6, CO_TSIGNED48}, Signed{7, CO_TSIGNED56}}) {
    CAPTURE(unsigned{one.width});
    std::int64_t wide = 0;
    std::int32_t narrow = 0;
    const CO_DATA variable = one.width == 3 ? CO_DATA(&narrow) : CO_DATA(&wide);
    PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(0x2300, 0, CO_OBJ____PRW), one.type, variable}); });
    node.may_change(0x2300, 0);
    node.start();
    REQUIRE(node.remap_rpdo(0, {0x23000000U | 8U * one.width}, 0x201) == 0);
    node.rx("201#" + hex_bytes(Bytes(one.width, 0xFF)));
    CHECK(narrow + wide == -1);
    node.rx("201#01" + std::string(2U * (one.width - 1U), '0'));
    CHECK(narrow + wide == 1);
  }
}

TEST_CASE("PDO layout: an application-defined type gets one Read or Write of its length for each frame") {
  for (std::uint8_t width = 1; width <= 8; ++width) {
    CAPTURE(unsigned{width});
    UserType user;
    user.width = width;
    user.value = Bytes(width, 0x55);
    PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(0x2300, 0, CO_OBJ____PRW), &user.type, &user}); });
    node.start();
    REQUIRE(node.remap_rpdo(0, {0x23000000U | 8U * width}, 0x201) == 0);
    REQUIRE(node.remap_tpdo(0, {0x23000000U | 8U * width}, 0x40000181) == 0);
    CHECK(user.reads.empty());
    CHECK(user.writes.empty());
    node.rx("201#" + hex_bytes(Bytes(width, 0x66)));
    CHECK(user.writes == std::vector<std::uint32_t>{width});
    CHECK(user.value == Bytes(width, 0x66));
    node.trigger(0);
    node.tx("181#" + hex_bytes(Bytes(width, 0x66)));
    CHECK(user.reads == std::vector<std::uint32_t>{width});
  }
}

// Attempts of a Size function to configure a PDO.
std::vector<CO_ERR> attempts;
bool attempts_are_on = false;

std::uint32_t size_that_maps(CO_OBJ*, CO_NODE* node, std::uint32_t) {
  const OutsideStack outside;
  for (const std::uint16_t index : {std::uint16_t{0x1400}, std::uint16_t{0x1800}}) {
    if (!attempts_are_on) break;
    attempts.push_back(CODictWrByte(&node->Dict, CO_DEV(index, 2), 254));
    attempts.push_back(CODictWrLong(&node->Dict, CO_DEV(index, 1), 0x80000281));
  }
  return 1;
}

CO_ERR read_one(CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t) {
  *static_cast<std::uint8_t*>(buffer) = 0x55;
  return CO_ERR_NONE;
}

TEST_CASE("PDO layout: a Size function may configure a PDO, also while its mapping is resolved") {
  const CO_OBJ_TYPE type = {size_that_maps, nullptr, read_one, nullptr, nullptr};
  PdoTable table;
  table.tpdo[0].on(0x40000181, 255, {0x22010108, 0x23000008, 0x22020110});
  PdoNode node(table, [&](Setup& setup) { setup.with({CO_KEY(0x2300, 0, CO_OBJ____PR_), &type, 0}); });
  node.start();
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(node.set(0x1A00, 0, 1, 0) == 0);
  CHECK(node.set(0x1A00, 1, 4, 0x22010208) == 0);
  CHECK(node.set(0x1A00, 3, 4, 0x22020210) == 0);
  node.may_change(0x1400, 1);
  node.may_change(0x1400, 2);
  node.may_change(0x1800, 1);
  node.may_change(0x1800, 2);
  attempts_are_on = true;
  CHECK(node.set(0x1A00, 0, 1, 3) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  attempts_are_on = false;
  CHECK(attempts.size() >= 8);
  for (const CO_ERR err : attempts) CHECK(err == CO_ERR_NONE);
  CHECK(node.request(0) == CO_ERR_TPDO_COM_OBJ);  // switched off by the last write
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  node.trigger(0);
  node.tx("181#21552122");
}

TEST_CASE("PDO layout: a BOOLEAN accepts only 0 and 1 from an RPDO") {
  PdoNode node;
  node.start();
  const std::uint32_t word = USE_PDO_BITS != 0 ? 0x22500101 : 0x22500108;
  REQUIRE(node.remap_rpdo(0, {word}, 0x201) == 0);
  node.rx("201#01");
  CHECK(node.boolean[0] == 1);
  if (USE_PDO_BITS == 0) {
    for (const char* frame : {"201#02", "201#80", "201#FF"}) {
      node.rx(frame);
      CHECK(node.boolean[0] == 1);
    }
  }
  node.rx("201#00");
  CHECK(node.boolean[0] == 0);
}

}  // namespace
