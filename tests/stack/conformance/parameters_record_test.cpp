// SPDX-License-Identifier: Apache-2.0
// Assignment of stored records to parameter groups: exchanged and overlapping groups, damaged
// records. (docs/storage.md)
#include <algorithm>
#include <utility>

#include "support/emcy_fixture.hpp"
#include "support/parameter_groups.hpp"

#if USE_PARA

namespace {

using namespace test;

constexpr const char* save_all = "601#2310100173617665";
constexpr const char* all_saved = "581#6010100100000000";
constexpr const char* save_second = "601#2310100373617665";
constexpr const char* second_saved = "581#6010100300000000";

void store_one_and_two(GroupDevice& device) {
  Fixture node(device.setup());
  node.ask("601#2300230101000000", "581#6000230100000000");
  node.ask("601#2300230202000000", "581#6000230200000000");
  node.ask(save_all, all_saved);
}

TEST_CASE("parameters: two groups of equal size whose offsets are exchanged do not load each other's values") {
  GroupDevice device;
  store_one_and_two(device);
  std::swap(device.first.Offset, device.second.Offset);
  std::vector<const CO_PARA*> lost;
  callbacks().para_lost = [&](CO_NODE*, const CO_PARA* group) { lost.push_back(group); };
  Fixture node(device.setup());
  CHECK(node.error() == CO_ERR_PARA_LOAD);
  CHECK(lost == std::vector<const CO_PARA*>{&device.second, &device.first});
  node.ask("601#4000230100000000", "581#430023010A000000");
  node.ask("601#4000230200000000", "581#4300230214000000");
}

TEST_CASE("parameters: a type of the application that calls the functions of 1011h restores defaults") {
  static const CO_OBJ_TYPE wrapped = {COTParaRestore.Size, COTParaRestore.Init, COTParaRestore.Read,
                                      [](CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
                                        return COTParaRestore.Write(obj, node, buffer, size);
                                      },
                                      COTParaRestore.Reset};
  GroupDevice device;
  store_one_and_two(device);
  Fixture node(device.setup().with({CO_KEY(0x1011, 3, CO_OBJ_____RW), &wrapped, GroupDevice::data(&device.second)}));
  node.ask("601#2311100373617665", "581#8011100320000008");  // "save"
  node.ask("601#231110036C6F6164", "581#6011100300000000");
  node.rx("000#8101");
  node.tx("701#00");
  node.ask("601#4000230200000000", "581#4300230214000000");
}

TEST_CASE("parameters: a group does not load the record of another sub-index or another offset") {
  GroupDevice device;
  store_one_and_two(device);
  SUBCASE("another sub-index") {
    device.first.Value = CO_PARA____;
    device.second.Offset = 0;
  }
  SUBCASE("another offset: the whole memory was moved") {
    device.nvm.bytes.insert(device.nvm.bytes.begin(), 4, 0xFF);
    device.nvm.bytes.resize(1024);
    device.second.Offset = 104;
  }
  Fixture node(device.setup());
  CHECK(node.error() == CO_ERR_PARA_LOAD);
  node.ask("601#4000230200000000", "581#4300230214000000");
}

TEST_CASE("parameters: the version of a layout is CO_PARA.Version, or CO_PARA_VERSION() where that is 0") {
  GroupDevice device;
  device.second.Value |= CO_PARA_VERSION(5);
  store_one_and_two(device);
  bool is_loaded = false;
  SUBCASE("same version, as a member") {
    device.second.Value = CO_PARA___E;
    device.second.Version = 5;
    is_loaded = true;
  }
  SUBCASE("both: the member is used") {
    device.second.Version = 5;
    device.second.Value = CO_PARA___E | CO_PARA_VERSION(6);
    is_loaded = true;
  }
  SUBCASE("another member") { device.second.Version = 6; }
  SUBCASE("a member of 32 bits") { device.second.Version = 0xFF000005; }
  SUBCASE("none") { device.second.Value = CO_PARA___E; }
  Fixture node(device.setup());
  CHECK(node.error() == (is_loaded ? CO_ERR_NONE : CO_ERR_PARA_LOAD));
  node.ask("601#4000230200000000", is_loaded ? "581#4300230202000000" : "581#4300230214000000");
}

TEST_CASE("parameters: a group that is not stored loads no record, whatever its Offset contains") {
  GroupDevice device;
  store_one_and_two(device);
  device.second.Value = CO_PARA____;
  device.second.Offset = 0;
  Fixture node(device.setup());
  CHECK(node.error() == CO_ERR_NONE);
  node.ask("601#4000230100000000", "581#4300230101000000");
  node.ask("601#4000230200000000", "581#4300230214000000");
}

// Returns index and sub-index of the entry that CODictGetFault() reports; 0: none. Without USE_DICT_CHECK it reports
// none.
unsigned refused_entry(const Fixture& node, bool expected) {
  std::uint32_t key = 0;
  const CO_DICT_FAULT fault = CODictGetFault(&node.node.Dict, &key);
  CHECK(fault == (expected && USE_DICT_CHECK != 0 ? CO_DICT_PARA_OVERLAP : CO_DICT_OK));
  return uint32_t{CO_GET_IDX(key)} << 8U | CO_GET_SUB(key);
}

// Overlapping groups -----------------------------------------------------------------------------------------------

TEST_CASE("parameters: a group that overlaps the memory of an earlier one is refused; the earlier one works") {
  constexpr std::uint32_t space = CO_PARA_SPACE(8, 1, 1);
  for (const std::uint32_t distance : std::initializer_list<std::uint32_t>{0U, 1U, space - 1, space}) {
    CAPTURE(distance);
    for (const bool reversed : {false, true}) {
      CAPTURE(reversed);
      GroupDevice device;
      device.first.Offset = reversed ? 200 + distance : 200;
      device.second.Offset = reversed ? 200 : 200 + distance;
      const bool is_free = distance == space;
      Fixture node(device.setup());
      CHECK(node.error() == (is_free ? CO_ERR_NONE : CO_ERR_PARA_OVERLAP));
      CHECK(refused_entry(node, !is_free) == (is_free || USE_DICT_CHECK == 0 ? 0 : 0x101003));
      node.ask("601#2300230101000000", "581#6000230100000000");
      node.ask("601#2310100273617665", "581#6010100200000000");
      const Bytes before = device.nvm.bytes;
      node.ask(save_second, is_free ? second_saved : "581#8010100300000606");
      node.ask("601#231110036C6F6164", is_free ? "581#6011100300000000" : "581#8011100300000606");
      CHECK((device.nvm.bytes == before) == !is_free);
      node.call(
          [&] { CHECK(COParaStore(&device.second, &node.node) == (is_free ? CO_ERR_NONE : CO_ERR_PARA_OVERLAP)); });
      node.rx("000#8101");
      node.tx("701#00");
      CHECK(node.error() == (is_free ? CO_ERR_NONE : CO_ERR_PARA_OVERLAP));
      node.ask("601#4000230100000000", "581#4300230101000000");
    }
  }
}

TEST_CASE("parameters: groups of the same bytes and Offset overlap if their reset or version differs") {
  for (const bool has_version : {false, true}) {
    GroupDevice device;
    device.second = device.first;
    device.first.Type = CO_RESET_NODE;
    device.second.Type = has_version ? CO_RESET_NODE : CO_RESET_COM;
    device.second.Version = has_version ? 1 : 0;
    Fixture node(device.setup());
    CHECK(node.error() == CO_ERR_PARA_OVERLAP);
    CHECK(refused_entry(node, true) == (USE_DICT_CHECK == 0 ? 0 : 0x101003));
    node.ask("601#2310100273617665", "581#6010100200000000");
    node.ask(save_second, "581#8010100300000606");
  }
}

#if USE_DICT_CHECK

TEST_CASE("parameters: groups that overlap do not hide a fault that prevents the start of the node") {
  GroupDevice device;
  device.second.Offset = 0;
  Fixture node(device.setup().with({CO_KEY(0x1017, 0, CO_OBJ_D___RW), CO_TSYNC_ID, 0x80}).stay_in_init());
  CHECK(node.mode() == CO_INVALID);
  CHECK(node.error() == CO_ERR_DICT_INIT);
  CHECK(CODictGetFault(&node->Dict, nullptr) == CO_DICT_WRONG_PLACE);
}

#endif

TEST_CASE("parameters: a group that overlaps another one is not loaded even if its own record is valid") {
  GroupDevice device;
  store_one_and_two(device);
  device.first.Offset = 99;
  Fixture node(device.setup());
  node.ask("601#4000230200000000", "581#4300230214000000");
}

TEST_CASE("parameters: without a memory groups at the same Offset do not overlap") {
  GroupDevice device;
  device.second.Offset = 0;
  Fixture node(device.setup().no_nvm());
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("parameters: groups whose variables overlap are accepted, each with its own record") {
  GroupDevice device;
  device.second.Start = device.first.Start;
  Fixture node(device.setup());
  CHECK(node.error() == CO_ERR_NONE);
  node.ask(save_all, all_saved);
}

#if USE_LSS
TEST_CASE("parameters: a group that 1010h does not list is stored after the record of LSS") {
  GroupDevice device;
  CO_PARA unlisted = {200, sizeof device.ram[0], &device.ram[0], nullptr, CO_RESET_NODE, nullptr, CO_PARA___E};
  Fixture node(device.setup());
  node.call([&] { CHECK(COLssNvmStore(&node.node, 300, 250000, 5) == CO_ERR_NONE); });
  std::uint32_t baud = 0;
  std::uint8_t id = 0;
  node.call([&] { CHECK(COLssNvmLoad(&node.node, 300, &baud, &id) == CO_ERR_NONE); });
  CHECK(baud == 250000);
  CHECK(id == 5);
  node.call([&] { CHECK(COParaStore(&unlisted, &node.node) == CO_ERR_NONE); });
}
#endif

// Damaged records -------------------------------------------------------------------------------------------------

struct Recovered {
  std::vector<const CO_PARA*> groups;
  static void note(CO_NODE* node, void*, const CO_PARA* group) {
    const OutsideStack outside;
    all().groups.push_back(group);
    CHECK(node->Nmt.Mode == CO_INIT);
  }
  static Recovered& all() {
    static Recovered recovered;
    return recovered;
  }
  static std::vector<const CO_PARA*> take() { return std::exchange(all().groups, {}); }
};
const CO_CALLBACKS recovered_callbacks = [] {
  CO_CALLBACKS table{};
  table.ParaRecovered = Recovered::note;
  return table;
}();

GroupDevice stored_twice(std::uint32_t older = 1, std::uint32_t newer = 2) {
  GroupDevice device;
  Fixture node(device.setup());
  for (const std::uint32_t number : {older, newer}) {
    device.ram[1].number = number;
    node.call([&] { CHECK(COParaStore(&device.second, &node.node) == CO_ERR_NONE); });
  }
  return device;
}

// A device whose memory has to be erased, with 1010h:3 at 512 in slots of 256 bytes.
GroupDevice with_flash() {
  GroupDevice device({1024, 8, 256});
  device.first.Value = CO_PARA____;
  device.second.Offset = 512;
  return device;
}

std::uint32_t save(Fixture& node, GroupDevice& device, std::uint32_t number) {
  device.ram[1].number = number;
  node.rx("601#2310100373617665");
  const std::vector<std::string> answer = node.frames();
  REQUIRE(answer.size() == 1);
  return answer[0] == "581#6010100300000000" ? 0 : answer[0] == "581#8010100300000606" ? 0x06060000 : 1;
}

TEST_CASE("parameters: while the newest record cannot be read \"save\" is refused and nothing is erased [S4]") {
  enum class Hidden : std::uint8_t { all, newest, header };
  for (const Hidden what : {Hidden::all, Hidden::newest, Hidden::header}) {
    for (const bool is_loaded : {false, true}) {
      CAPTURE(is_loaded);
      GroupDevice device = with_flash();
      const auto check_refused = [&](Fixture& node) {
        const Bytes before = device.nvm.bytes;
        device.nvm.is_deaf = what == Hidden::all;
        device.nvm.torn_from = what == Hidden::newest ? 768 + 24 : 768;
        device.nvm.torn_to = what == Hidden::all ? 0 : 768 + 32;
        CHECK(save(node, device, 4) == 0x06060000);
        CHECK(device.nvm.bytes == before);
      };
      {
        Fixture node(device.setup());
        CHECK(save(node, device, 2) == 0);
        CHECK(save(node, device, 3) == 0);
        if (!is_loaded) check_refused(node);
      }
      if (is_loaded) {
        Fixture node(device.setup());
        CHECK(device.ram[1].number == 3);
        check_refused(node);
        device.nvm.is_deaf = false;
        device.nvm.torn_to = 0;
        CHECK(save(node, device, 5) == 0);
      }
      device.nvm.is_deaf = false;
      device.nvm.torn_to = 0;
      Fixture next(device.setup());
      CHECK(device.ram[1].number == (is_loaded ? 5 : 3));
      CHECK_FALSE(device.nvm.misused);
    }
  }
}

TEST_CASE("parameters: a slot that cannot be read at the start is erased by the next \"save\" [S4]") {
  for (const std::uint32_t torn : {512U, 536U, 768U, 792U}) {
    CAPTURE(torn);
    GroupDevice device = with_flash();
    {
      Fixture node(device.setup());
      CHECK(save(node, device, 2) == 0);
      CHECK(save(node, device, 3) == 0);
    }
    device.nvm.torn_from = torn;  // a power failure has left a word whose ECC is wrong for ever
    device.nvm.torn_to = torn + 8;
    std::uint32_t expected = torn < 768 ? 3 : 2;
    for (std::uint32_t number = 4; number < 7; ++number) {
      Fixture node(device.setup());
      CHECK(device.ram[1].number == expected);
      CHECK(save(node, device, number) == 0);
      expected = number;
    }
    CHECK(device.nvm.torn_to == 0);
    Fixture node(device.setup());
    CHECK(device.ram[1].number == 6);
    CHECK_FALSE(device.nvm.misused);
  }
}

TEST_CASE("parameters: a read that fails once during a \"save\" loses no value [S4]") {
  for (const CO_NVM_SHAPE shape : {CO_NVM_SHAPE{1024, 8, 256}, CO_NVM_SHAPE{1024, 1, 0}}) {
    for (std::uint64_t read = 1;; ++read) {
      CAPTURE(read);
      GroupDevice device = with_flash();
      device.nvm.shape = shape;
      std::uint32_t newest = 3;
      {
        Fixture node(device.setup());
        CHECK(save(node, device, 2) == 0);
        CHECK(save(node, device, 3) == 0);
        device.nvm.refuse_read = device.nvm.reads + read;
        for (const std::uint32_t number : {4U, 5U}) {
          newest = save(node, device, number) == 0 ? number : newest;
        }
      }
      const bool is_over = device.nvm.reads < device.nvm.refuse_read;
      device.nvm.refuse_read = 0;
      Fixture node(device.setup());
      CHECK(device.ram[1].number >= newest);
      CHECK(device.ram[1].number <= 5);
      CHECK(save(node, device, 6) == 0);
      if (is_over) break;
    }
  }
}

TEST_CASE("parameters: if the newest record is damaged the previous one is loaded and ParaRecovered() is called") {
  const Bytes image = stored_twice().nvm.bytes;
  constexpr std::uint32_t size = CO_PARA_SPACE(8, 1, 1) / 2;
  for (std::uint32_t bit = 0; bit < 8 * size; ++bit) {
    CAPTURE(bit);
    GroupDevice device;
    device.nvm.bytes = image;
    device.nvm.bytes[100 + size + bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    Fixture node(device.setup().callbacks(recovered_callbacks));
    CHECK(node.error() == CO_ERR_NONE);
    CHECK(device.ram[1].number == 1);
    CHECK(Recovered::take() == std::vector<const CO_PARA*>{&device.second});
  }
}

TEST_CASE("parameters: ParaRecovered() is not called for a damaged older record or without damage") {
  const Bytes image = stored_twice().nvm.bytes;
  GroupDevice device;
  device.nvm.bytes = image;
  SUBCASE("nothing damaged") {}
  SUBCASE("data of the older record") { device.nvm.bytes[100 + 20] ^= 1; }
  SUBCASE("checksum of the older record") { device.nvm.bytes[100 + 16] ^= 1; }
  SUBCASE("older record erased") { std::fill_n(device.nvm.bytes.begin() + 100, 28, std::uint8_t{0xFF}); }
  Fixture node(device.setup().callbacks(recovered_callbacks));
  CHECK(node.error() == CO_ERR_NONE);
  CHECK(device.ram[1].number == 2);
  CHECK(Recovered::take().empty());
}

TEST_CASE("parameters: ParaRecovered() is not called after a firmware update that changes the layout") {
  GroupDevice device;
  device.nvm.bytes = stored_twice().nvm.bytes;
  device.second.Value |= CO_PARA_VERSION(7);
  {
    Fixture node(device.setup().callbacks(recovered_callbacks));
    CHECK(node.error() == CO_ERR_PARA_LOAD);
    node.ask(save_second, second_saved);
    node.ask("601#2300230205000000", "581#6000230200000000");
  }
  Fixture node(device.setup().callbacks(recovered_callbacks));
  CHECK(node.error() == CO_ERR_NONE);
  node.ask("601#4000230200000000", "581#4300230214000000");
  CHECK(Recovered::take().empty());
}

TEST_CASE("parameters: ParaRecovered() is called for defaults that were requested before the damaged record") {
  GroupDevice device;
  {
    Fixture node(device.setup());
    node.ask("601#231110036C6F6164", "581#6011100300000000");
    node.ask("601#2300230205000000", "581#6000230200000000");
    node.ask(save_second, second_saved);
  }
  device.nvm.bytes[100 + 28 + 20] ^= 1;
  Fixture node(device.setup().callbacks(recovered_callbacks));
  node.ask("601#4000230200000000", "581#4300230214000000");
  CHECK(Recovered::take() == std::vector<const CO_PARA*>{&device.second});
}

TEST_CASE("parameters: without callback a damaged record is handled: the table or its entry may be null") {
  const Bytes image = stored_twice().nvm.bytes;
  const CO_CALLBACKS none{};
  for (const bool table : {false, true}) {
    GroupDevice device;
    device.nvm.bytes = image;
    device.nvm.bytes[100 + 28] ^= 1;
    Fixture node(table ? device.setup().callbacks(none) : device.setup());
    CHECK(node.error() == CO_ERR_NONE);
    node.ask("601#4000230200000000", "581#4300230201000000");
  }
}

#if USE_EMCY

TEST_CASE("parameters: the application reports a recovered group to the network by EMCY 6300h") {
  GroupDevice device;
  device.nvm.bytes = stored_twice().nvm.bytes;
  device.nvm.bytes[100 + 28] ^= 1;
  EmcyNode node(device.setup().callbacks(recovered_callbacks).emergencies({{CO_EMCY_REG_GENERAL, 0x6300}}));
  // Simulates the application's loop after CONodeStart(), as in docs/storage.md.
  if (!Recovered::take().empty()) {
    node.set(0);
  }
  node.tx("081#0063010000000000");
}

#endif

}  // namespace

#endif
