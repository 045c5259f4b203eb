// SPDX-License-Identifier: Apache-2.0
// 1010h, 1011h and 1020h: parameter groups. [301:7.5.2.13, 7.5.2.14, 7.5.2.23] [S1-S7]
#include <cstring>

#include "support/failing_nvm.hpp"
#include "support/fixture.hpp"

#if USE_PARA

namespace {

using namespace test;

// A device with three groups, and its non-volatile memory, which outlives each of its nodes.
struct Device {
  struct Memory {
    std::uint32_t number;
    std::uint8_t byte;
  };

  Device() = default;
  explicit Device(CO_NVM_SHAPE shape) : nvm(shape) {}

  static CO_DATA data(const void* address) { return reinterpret_cast<std::uintptr_t>(address); }

  Setup setup() {
    Setup all = without_groups();
    all.with({CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TPARA_STORE, 4});
    all.with({CO_KEY(0x1011, 0, CO_OBJ_D___R_), CO_TPARA_RESTORE, 4});
    const CO_PARA* groups[] = {&own, &own, &application, &autonomous};
    for (std::uint8_t sub = 1; sub <= 4; ++sub) {
      all.with({CO_KEY(0x1010, sub, CO_OBJ_____RW), CO_TPARA_STORE, data(groups[sub - 1])});
      all.with({CO_KEY(0x1011, sub, CO_OBJ_____RW), CO_TPARA_RESTORE, data(groups[sub - 1])});
    }
    return all;
  }

  Setup single() {
    return without_groups()
        .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, data(&application)})
        .with({CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, data(&application)});
  }

  Setup without_groups() {
    return Setup()
        .only_small()
        .may_change(0x2300, 1)
        .may_change(0x2300, 2)
        .may_change(0x2300, 3)
        .may_change(0x1020, 1)
        .may_change(0x1020, 2)
        .nvm(FailingNvm::driver, &nvm)
        .with({CO_KEY(0x1020, 1, CO_OBJ_____RW), CO_TVERIFY_CONFIG, data(&date)})
        .with({CO_KEY(0x1020, 2, CO_OBJ_____RW), CO_TVERIFY_CONFIG, data(&time)})
        .with({CO_KEY(0x2300, 1, CO_OBJ_____RW), CO_TUNSIGNED32, data(&ram[0].number)})
        .with({CO_KEY(0x2300, 2, CO_OBJ_____RW), CO_TUNSIGNED32, data(&ram[1].number)})
        .with({CO_KEY(0x2300, 3, CO_OBJ_____RW), CO_TUNSIGNED32, data(&ram[2].number)})
        .with({CO_KEY(0x2300, 4, CO_OBJ_____RW), CO_TUNSIGNED32, data(&stray)});
  }

  FailingNvm nvm{{1024, 1, 0}};
  Memory ram[3] = {};
  Memory defaults[3] = {{10, 1}, {20, 2}, {30, 3}};
  std::uint32_t stray = 0;
  std::uint32_t date = 0;
  std::uint32_t time = 0;
  CO_PARA own = {0, sizeof(Memory), &ram[0], &defaults[0], CO_RESET_COM, nullptr, CO_PARA___E};
  CO_PARA application = {100, sizeof(Memory), &ram[1], &defaults[1], CO_RESET_NODE, nullptr, CO_PARA___E};
  CO_PARA autonomous = {200, sizeof(Memory), &ram[2], &defaults[2], CO_RESET_NODE, nullptr, CO_PARA__A_};
};

constexpr const char* save_all = "601#2310100173617665";
constexpr const char* all_saved = "581#6010100100000000";

TEST_CASE("parameters: 1010h shows what is stored on command (bit 0) and autonomously (bit 1) [S1]") {
  Device device;
  Fixture node(device.setup());
  node.ask("601#4010100000000000", "581#4F10100004000000");
  node.ask("601#4010100100000000", "581#4310100103000000");
  node.ask("601#4010100200000000", "581#4310100201000000");
  node.ask("601#4010100400000000", "581#4310100402000000");
  node.ask("601#4010100500000000", "581#8010100511000906");
}

TEST_CASE("parameters: 1011h shows what can be restored (bit 0) [S1]") {
  Device device;
  Fixture node(device.setup());
  node.ask("601#4011100000000000", "581#4F11100004000000");
  node.ask("601#4011100100000000", "581#4311100101000000");
  node.ask("601#4011100400000000", "581#4311100400000000");
}

TEST_CASE("parameters: any word except \"save\" and \"load\" is refused with 0800 0020h and stores nothing [S2]") {
  Device device;
  Fixture node(device.setup());
  for (const char* request : {"601#231010016C6F6164", "601#2310100200000000", "601#2310100265766173",
                              "601#2311100173617665", "601#23111002FFFFFFFF", "601#2310100453415645"}) {
    CAPTURE(request);
    std::string answer = std::string("581#80") + std::string(request).substr(6, 6) + "20000008";
    node.ask(request, answer);
  }
  CHECK(device.nvm.steps == 0);
}

TEST_CASE("parameters: a group that is not stored on command refuses \"save\" and \"load\" with 0800 0020h") {
  Device device;
  Fixture node(device.setup());
  node.ask("601#2310100473617665", "581#8010100420000008");
  node.ask("601#231110046C6F6164", "581#8011100420000008");
  CHECK(device.nvm.steps == 0);
}

TEST_CASE("parameters: a wrong length is refused; 1010h:0 is read-only") {
  Device device;
  Fixture node(device.setup());
  node.ask("601#2F10100173000000", "581#8010100113000706");
  node.ask("601#2F10100001000000", "581#8010100002000106");
}

TEST_CASE("parameters: before the first store a group has its default values") {
  Device device;
  Fixture node(device.setup());
  CHECK(device.ram[0].number == 10);
  CHECK(device.ram[1].number == 20);
  CHECK(device.ram[2].byte == 3);
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("parameters: \"save\" to sub-index 1 stores all groups, which are kept over power off [S3] [S4]") {
  Device device;
  {
    Fixture node(device.setup());
    node.ask("601#2300230111000000", "581#6000230100000000");
    node.ask("601#2300230222000000", "581#6000230200000000");
    node.ask(save_all, all_saved);
  }
  device.ram[0] = device.ram[1] = {};
  Fixture node(device.setup());
  node.ask("601#4000230100000000", "581#4300230111000000");
  node.ask("601#4000230200000000", "581#4300230222000000");
}

TEST_CASE("parameters: \"save\" to one sub-index stores that group alone [S3]") {
  Device device;
  {
    Fixture node(device.setup());
    node.ask("601#2300230111000000", "581#6000230100000000");
    node.ask("601#2300230222000000", "581#6000230200000000");
    node.ask("601#2310100373617665", "581#6010100300000000");
  }
  Fixture node(device.setup());
  node.ask("601#4000230100000000", "581#430023010A000000");
  node.ask("601#4000230200000000", "581#4300230222000000");
}

TEST_CASE("parameters: a single group is stored by sub-index 1 [S3]") {
  Device device;
  {
    Fixture node(device.single());
    node.ask("601#4010100100000000", "581#4310100101000000");
    node.ask("601#2300230222000000", "581#6000230200000000");
    node.ask(save_all, all_saved);
  }
  Fixture node(device.single());
  node.ask("601#4000230200000000", "581#4300230222000000");
}

TEST_CASE("parameters: reset communication loads its stored groups, reset node all of them [N6]") {
  Device device;
  Fixture node(device.setup());
  node.ask("601#2300230111000000", "581#6000230100000000");
  node.ask(save_all, all_saved);
  for (const bool whole : {false, true}) {
    CAPTURE(whole);
    node.ask("601#2300230199000000", "581#6000230100000000");
    node.ask("601#2300230299000000", "581#6000230200000000");
    node.ask(whole ? "000#8101" : "000#8201", "701#00");
    node.ask("601#4000230100000000", "581#4300230111000000");
    node.ask("601#4000230200000000", whole ? "581#4300230214000000" : "581#4300230299000000");
  }
}

// A group that is loaded at reset node, and whose first bytes are an object of the communication profile.
struct MixedGroup {
  struct Memory {
    std::uint16_t heartbeat;
    std::uint8_t unused[2];
    std::uint32_t number;
  };

  explicit MixedGroup(const CO_NVM_SHAPE* shape) : nvm(shape == nullptr ? CO_NVM_SHAPE{1024, 1, 0} : *shape) {
    has_shape = shape != nullptr;
  }

  Setup setup() {
    static const CO_IF_NVM_DRV_EX without_shape = [] {
      CO_IF_NVM_DRV_EX driver = FailingNvm::driver;
      driver.Shape = nullptr;
      return driver;
    }();
    return Setup()
        .only_small()
        .may_change(0x1017, 0)
        .may_change(0x2300, 1)
        .nvm(has_shape ? FailingNvm::driver : without_shape, &nvm)
        .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, Device::data(&group)})
        .with({CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, Device::data(&group)})
        .with({CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, Device::data(&ram.heartbeat)})
        .with({CO_KEY(0x2300, 1, CO_OBJ_____RW), CO_TUNSIGNED32, Device::data(&ram.number)});
  }

  FailingNvm nvm;
  bool has_shape;
  Memory ram = {0, {}, 0};
  Memory defaults = {1000, {}, 10};
  CO_PARA group{0, sizeof(Memory), &ram, &defaults, CO_RESET_NODE, nullptr, CO_PARA___E};
};

TEST_CASE("parameters: reset communication loads 1000h to 1FFFh of a group of type reset node, and no other objects") {
  const CO_NVM_SHAPE bytes = {1024, 1, 0};
  const CO_NVM_SHAPE pages = {1024, 8, 128};
  for (const CO_NVM_SHAPE* shape : {&bytes, &pages, static_cast<const CO_NVM_SHAPE*>(nullptr)}) {
    CAPTURE(shape == nullptr);
    MixedGroup device(shape);
    device.group.ComSize = offsetof(MixedGroup::Memory, number);
    Fixture node(device.setup());
    // Without a stored record only 1017h gets its default value.
    node.ask("601#2B171000FA000000", "581#6017100000000000");
    node.ask("601#2300230101000000", "581#6000230100000000");
    node.rx("000#8201");
    node.tx("701#00");
    node.ask("601#4017100000000000", "581#4B171000E8030000");
    node.ask("601#4000230100000000", "581#4300230101000000");
    // The values 7 and 2 are stored; then other values are written.
    node.ask("601#2B17100007000000", "581#6017100000000000");
    node.ask("601#2300230102000000", "581#6000230100000000");
    node.ask("601#2310100173617665", "581#6010100100000000");
    node.ask("601#2B17100000000000", "581#6017100000000000");
    node.ask("601#2300230103000000", "581#6000230100000000");
    node.rx("000#8201");
    node.tx("701#00");
    node.ask("601#4017100000000000", "581#4B17100007000000");
    node.ask("601#4000230100000000", "581#4300230103000000");
    node.ask("601#2B17100000000000", "581#6017100000000000");
    node.rx("000#8101");
    node.tx("701#00");
    node.ask("601#4000230100000000", "581#4300230102000000");
    // After "load", too, only 1017h gets its default value.
    node.ask("601#231110016C6F6164", "581#6011100100000000");
    node.rx("000#8201");
    node.tx("701#00");
    node.ask("601#4017100000000000", "581#4B171000E8030000");
    node.ask("601#4000230100000000", "581#4300230102000000");
    CHECK(node.error() == CO_ERR_NONE);
  }
}

TEST_CASE("parameters: without a part for 1000h to 1FFFh, or with one larger than the group, nothing is loaded") {
  for (const std::uint32_t size : std::initializer_list<std::uint32_t>{0U, 9U, UINT32_MAX}) {
    const CO_NVM_SHAPE bytes = {1024, 1, 0};
    MixedGroup device(&bytes);
    device.group.ComSize = size;
    Fixture node(device.setup());
    node.ask("601#2B17100000000000", "581#6017100000000000");
    node.ask("601#2300230101000000", "581#6000230100000000");
    node.rx("000#8201");
    node.tx("701#00");
    node.ask("601#4017100000000000", "581#4B17100000000000");
    node.ask("601#4000230100000000", "581#4300230101000000");
  }
}

TEST_CASE(
    "parameters: a damaged part in the memory gets its default values, and COParaLost() is called with the group") {
  const CO_NVM_SHAPE bytes = {1024, 1, 0};
  MixedGroup device(&bytes);
  device.group.ComSize = offsetof(MixedGroup::Memory, number);
  Fixture node(device.setup());
  node.ask("601#2B17100000000000", "581#6017100000000000");
  node.ask("601#2310100173617665", "581#6010100100000000");
  node.ask("601#2300230102000000", "581#6000230100000000");
  device.nvm.bytes[20 + offsetof(MixedGroup::Memory, number)] ^= 1;  // a byte outside of ComSize
  node.rx("000#8201");
  node.tx("701#00");
  node.ask("601#4017100000000000", "581#4B171000E8030000");
  node.ask("601#4000230100000000", "581#4300230102000000");
  CHECK(node.error() == CO_ERR_PARA_LOAD);
}

TEST_CASE("parameters: \"load\" changes nothing before the reset of the group's type [S5]") {
  Device device;
  Fixture node(device.setup());
  node.ask("601#2300230111000000", "581#6000230100000000");
  node.ask("601#2300230222000000", "581#6000230200000000");
  node.ask(save_all, all_saved);
  node.ask("601#231110016C6F6164", "581#6011100100000000");
  node.ask("601#4000230100000000", "581#4300230111000000");
  node.ask("601#4000230200000000", "581#4300230222000000");
  node.ask("000#8201", "701#00");
  node.ask("601#4000230100000000", "581#430023010A000000");
  node.ask("601#4000230200000000", "581#4300230222000000");
  node.ask("000#8101", "701#00");
  node.ask("601#4000230200000000", "581#4300230214000000");
}

TEST_CASE("parameters: \"load\" survives power off before the reset; a later \"save\" replaces it [S5]") {
  Device device;
  {
    Fixture node(device.setup());
    node.ask("601#2300230222000000", "581#6000230200000000");
    node.ask(save_all, all_saved);
    node.ask("601#231110036C6F6164", "581#6011100300000000");
  }
  {
    Fixture node(device.setup());
    node.ask("601#4000230200000000", "581#4300230214000000");
    node.ask("601#231110036C6F6164", "581#6011100300000000");
    node.ask("601#2300230233000000", "581#6000230200000000");
    node.ask("601#2310100373617665", "581#6010100300000000");
  }
  Fixture node(device.setup());
  node.ask("601#4000230200000000", "581#4300230233000000");
}

TEST_CASE("parameters: COParaDefault() is called at the reset after \"load\", after Default was copied") {
  Device device;
  Fixture node(device.setup());
  unsigned asked = 0;
  callbacks().para_default = [&](CO_PARA* group) {
    ++asked;
    CHECK(group == &device.application);
    CHECK(device.ram[1].number == 20);
    device.ram[1].number = 0x2A;
    return std::int16_t{0};
  };
  node.ask("601#231110036C6F6164", "581#6011100300000000");
  CHECK(asked == 0);
  node.ask("000#8101", "701#00");
  CHECK(asked == 1);
  node.ask("601#4000230200000000", "581#430023022A000000");
  callbacks().para_default = [](CO_PARA*) { return std::int16_t{-1}; };
  node.ask("000#8101", "701#00");
  CHECK(node.error() == CO_ERR_PARA_RESTORE);
}

TEST_CASE("parameters: a memory that fails aborts \"save\" with 0606 0000h and keeps the stored values [S4]") {
  Device device;
  {
    Fixture node(device.setup());
    node.ask("601#2300230222000000", "581#6000230200000000");
    node.ask(save_all, all_saved);
    node.ask("601#2300230233000000", "581#6000230200000000");
    device.nvm.cut_at = device.nvm.steps + 3;
    node.ask(save_all, "581#8010100100000606");
  }
  device.nvm.power_up();
  Fixture node(device.setup());
  node.ask("601#4000230200000000", "581#4300230222000000");
}

TEST_CASE("parameters: \"save\" of all continues after a group that fails, and reports the failure [S3]") {
  Device device;
  device.own.Offset = 1000;  // the record exceeds the memory
  {
    Fixture node(device.setup());
    CHECK(node.error() == CO_ERR_PARA_STORE);
    node.ask("601#2300230222000000", "581#6000230200000000");
    node.ask(save_all, "581#8010100100000606");
  }
  Fixture node(device.setup());
  node.ask("601#4000230200000000", "581#4300230222000000");
}

TEST_CASE("parameters: damaged records are reported, and their groups have the default values") {
  Device device;
  {
    Fixture node(device.setup());
    node.ask("601#2300230222000000", "581#6000230200000000");
    node.ask(save_all, all_saved);
  }
  for (std::uint32_t place = 100; place < 200; ++place) {
    device.nvm.bytes[place] ^= 0x01;
  }
  const CO_PARA* lost = nullptr;
  callbacks().para_lost = [&](CO_NODE*, const CO_PARA* group) { lost = group; };
  Fixture node(device.setup());
  CHECK(node.error() == CO_ERR_PARA_LOAD);
  CHECK(lost == &device.application);
  node.ask("601#4000230200000000", "581#4300230214000000");
}

TEST_CASE("parameters: records of another layout version, size or offset are not loaded") {
  Device device;
  {
    Fixture node(device.setup());
    node.ask("601#2300230222000000", "581#6000230200000000");
    node.ask(save_all, all_saved);
  }
  SUBCASE("version") { device.application.Value |= CO_PARA_VERSION(1); }
  SUBCASE("size") { device.application.Size = 4; }
  SUBCASE("offset") { device.application.Offset = 104; }
  Fixture node(device.setup());
  CHECK(node.error() == CO_ERR_PARA_LOAD);
  CHECK(device.ram[1].number == 20);
}

TEST_CASE("parameters: values that are stored already are not written again") {
  Device device;
  Fixture node(device.setup());
  node.ask(save_all, all_saved);
  const auto before = device.nvm.steps;
  node.ask(save_all, all_saved);
  node.ask("601#231110016C6F6164", "581#6011100100000000");
  const auto after = device.nvm.steps;
  CHECK(after > before);
  node.ask("601#231110016C6F6164", "581#6011100100000000");
  CHECK(device.nvm.steps == after);
  CHECK(before < 3 * 40);
}

TEST_CASE("parameters: an autonomous group is stored after a change, at most once in its period [S1]") {
  Device device;
  {
    Fixture node(device.setup());
    node.after(std::chrono::milliseconds(CO_PARA_PERIOD - 1));
    CHECK(device.nvm.steps == 0);
    node.after(1ms);
    const auto at_first = device.nvm.steps;
    CHECK(at_first > 0);
    node.after(std::chrono::milliseconds(5 * CO_PARA_PERIOD));
    CHECK(device.nvm.steps == at_first);
    node.ask("601#2300230344000000", "581#6000230300000000");
    CHECK(device.nvm.steps == at_first);
    node.after(std::chrono::milliseconds(CO_PARA_PERIOD));
    CHECK(device.nvm.steps > at_first);
  }
  Fixture node(device.setup());
  node.ask("601#4000230300000000", "581#4300230344000000");
}

TEST_CASE("parameters: an NMT reset loses no change of an autonomous group") {
  Device device;
  Fixture node(device.setup());
  node.ask("601#2300230344000000", "581#6000230300000000");
  node.ask("000#8101", "701#00");
  node.ask("601#4000230300000000", "581#4300230344000000");
}

TEST_CASE("parameters: \"load\" of an autonomous group takes effect at the reset; changes after it are stored [S1]") {
  Device device;
  device.autonomous.Value = CO_PARA__AE;
  {
    Fixture node(device.setup());
    node.ask("601#2300230344000000", "581#6000230300000000");
    node.after(std::chrono::milliseconds(CO_PARA_PERIOD));
    node.ask("601#231110046C6F6164", "581#6011100400000000");
    node.ask("601#2300230345000000", "581#6000230300000000");
    node.after(std::chrono::milliseconds(2 * CO_PARA_PERIOD));
    node.ask("000#8101", "701#00");
    node.ask("601#4000230300000000", "581#430023031E000000");
    node.ask("601#2300230346000000", "581#6000230300000000");
    node.after(std::chrono::milliseconds(CO_PARA_PERIOD));
  }
  Fixture node(device.setup());
  node.ask("601#4000230300000000", "581#4300230346000000");
}

TEST_CASE("parameters: COB-IDs are loaded before a service uses them") {
  Device device;
  std::uint32_t cob_id = 0x80;
  CO_PARA group = {300, sizeof cob_id, &cob_id, nullptr, CO_RESET_COM, nullptr, CO_PARA___E};
  const auto setup = [&] {
    return device.single()
        .may_change(0x1005, 0)
        .with({CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, Device::data(&cob_id)})
        .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, Device::data(&group)});
  };
  {
    Fixture node(setup());
    node.ask("601#2305100091000000", "581#6005100000000000");
    node.ask(save_all, all_saved);
  }
  cob_id = 0x80;
  Fixture node(setup());
  const std::vector<std::uint32_t>& filter = node.can.filter;
  CHECK(std::find(filter.begin(), filter.end(), 0x91) != filter.end());
  CHECK(std::find(filter.begin(), filter.end(), 0x80) == filter.end());
}

TEST_CASE("parameters: without a memory a node runs with its default values and \"save\" fails") {
  Device device;
  Fixture node(device.setup().no_nvm());
  CHECK(node.error() == CO_ERR_NONE);
  node.ask("601#4000230200000000", "581#4300230214000000");
  node.ask(save_all, "581#8010100100000606");
}

// A classic driver, as in firmware for CANopen-Stack.
std::uint8_t raw_memory[256];
unsigned raw_writes;
const CO_IF_NVM_DRV_EX raw_driver = {[](void*) {},
                                     [](void*, std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
                                       std::copy_n(raw_memory + start, size, buffer);
                                       return size;
                                     },
                                     [](void*, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
                                       ++raw_writes;
                                       std::copy_n(buffer, size, raw_memory + start);
                                       return size;
                                     },
                                     nullptr, nullptr};

TEST_CASE("parameters: with a driver without geometry the bytes of a group are stored at Offset without a header") {
  std::fill(std::begin(raw_memory), std::end(raw_memory), std::uint8_t{0xFF});
  raw_writes = 0;
  Device device;
  device.own.Value = CO_PARA__AE;
  {
    Fixture node(device.setup().nvm(raw_driver, nullptr));
    CHECK(node.error() == CO_ERR_NONE);
    node.ask("601#4010100200000000", "581#4310100201000000");
    node.ask("601#4010100400000000", "581#4310100400000000");
    node.ask("601#4000230200000000", "581#4300230214000000");
    node.ask("601#2300230244332211", "581#6000230200000000");
    node.after(std::chrono::milliseconds(2 * CO_PARA_PERIOD));
    CHECK(raw_writes == 0);
    node.ask(save_all, all_saved);
    const std::uint32_t saved = 0x11223344;
    CHECK(std::memcmp(raw_memory + 100, &saved, sizeof saved) == 0);
  }
  {
    Fixture node(device.setup().nvm(raw_driver, nullptr));
    node.ask("601#4000230200000000", "581#4300230244332211");
    node.ask("601#231110036C6F6164", "581#6011100300000000");
    node.ask("601#4000230200000000", "581#4300230244332211");
  }
  Fixture node(device.setup().nvm(raw_driver, nullptr));
  node.ask("601#4000230200000000", "581#4300230214000000");
}

TEST_CASE("parameters: a group does not fit in a memory that is too small or whose units do not divide its Offset") {
  const CO_NVM_SHAPE shapes[] = {{0, 1, 0},
                                 {90, 1, 0},
                                 {0xFFFFFFFF, 1, 0x80000000},
                                 {1024, 1, 128},
                                 {1024, 1024, 0},
                                 {1024, 0, 0},
                                 {0xFFFFFFFF, 0x80000000, 0},
                                 {1024, 8, 0},
                                 {0xFFFFFFFF, 16, 0xFFFFFFFF},
                                 {4096, 1, 0x80000000},
                                 {1024, 16, 100}};
  for (const CO_NVM_SHAPE& shape : shapes) {
    Device device;
    device.nvm.shape = shape;
    device.application.Offset = shape.ProgramSize == 0 ? 1020 : 100;
    bool lost = false;
    callbacks().para_lost = [&](CO_NODE*, const CO_PARA*) { lost = true; };
    Fixture node(device.single());
    CHECK(node.error() == CO_ERR_PARA_STORE);
    CHECK_FALSE(lost);
    node.ask("601#2310100173617665", "581#8010100100000606");
    CHECK(device.nvm.steps == 0);
    CHECK_FALSE(device.nvm.misused);
  }
}

TEST_CASE("parameters: a group may fill the whole memory; one byte less is too small") {
  for (const std::uint32_t missing : {0U, 1U}) {
    Device device({CO_PARA_SPACE(sizeof(Device::Memory), 1, 1) - missing, 1, 0});
    device.application.Offset = 0;
    Fixture node(device.single());
    CHECK(node.error() == (missing == 0 ? CO_ERR_NONE : CO_ERR_PARA_STORE));
    node.ask("601#2310100173617665", missing == 0 ? "581#6010100100000000" : "581#8010100100000606");
    CHECK_FALSE(device.nvm.misused);
  }
}

TEST_CASE("parameters: a memory that cannot be erased aborts \"save\" with 0606 0000h; nothing is written") {
  static unsigned writes;
  writes = 0;
  CO_IF_NVM_DRV_EX driver = FailingNvm::driver;
  driver.Write = [](void* context, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
    ++writes;
    return FailingNvm::driver.Write(context, start, buffer, size);
  };
  SUBCASE("Erase fails") {
    driver.Erase = [](void*, std::uint32_t, std::uint32_t) { return false; };
  }
  SUBCASE("Erase is null") { driver.Erase = nullptr; }
  Device device({1024, 4, 64});
  device.application.Offset = 128;
  Fixture node(device.single().nvm(driver, &device.nvm));
  CHECK(node.error() == CO_ERR_NONE);
  node.ask("601#2310100173617665", "581#8010100100000606");
  node.ask("601#231110016C6F6164", "581#8011100100000606");
  CHECK(writes == 0);
}

#if USE_DICT_CHECK

TEST_CASE("parameters: an entry of 1010h without a group is a fault of the dictionary") {
  for (const CO_OBJ& wrong : {CO_OBJ{CO_KEY(0x1010, 1, CO_OBJ_D___RW), CO_TPARA_STORE, 5},
                              CO_OBJ{CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, 0}}) {
    Device device;
    Fixture node(device.single().with(wrong).stay_in_init());
    const bool has_data = wrong.Data != 0;  // null disables only this entry
    CHECK((node.mode() == CO_INVALID) == has_data);
    CHECK(node.error() == (has_data ? CO_ERR_DICT_INIT : CO_ERR_OBJ_INIT));
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node->Dict, &key) != CO_DICT_OK);
    CHECK(CO_GET_IDX(key) == 0x1010);
  }
}

#endif

// Memory of a classic driver that refuses accesses.
struct RefusingMemory {
  std::uint8_t bytes[256];
  unsigned reads = 0;
  unsigned writes = 0;
  unsigned refuse_read = 0;   // number of the read that fails, from 1; 0: none
  unsigned refuse_write = 0;  // number of the write that fails, from 1; 0: none
};
RefusingMemory refusing;
const CO_IF_NVM_DRV_EX refusing_driver = {
    [](void*) {},
    [](void*, std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
      std::copy_n(refusing.bytes + start, size, buffer);
      return ++refusing.reads == refusing.refuse_read ? size - 1 : size;
    },
    [](void*, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
      if (++refusing.writes == refusing.refuse_write) return size - 1;
      std::copy_n(buffer, size, refusing.bytes + start);
      return size;
    },
    nullptr, nullptr};

struct ClassicDevice : Device {
  ClassicDevice() {
    refusing = {};
    std::fill(std::begin(refusing.bytes), std::end(refusing.bytes), std::uint8_t{0xFF});
  }
  Setup setup() { return single().nvm(refusing_driver, nullptr); }
  void hold(std::uint32_t number) {
    std::memset(refusing.bytes + 100, 0, sizeof(Memory));
    std::memcpy(refusing.bytes + 100, &number, sizeof number);
  }
  static std::uint32_t held() {
    std::uint32_t number = 0;
    std::memcpy(&number, refusing.bytes + 100, sizeof number);
    return number;
  }
};

TEST_CASE("parameters: a classic driver that cannot read gives default values, CO_ERR_PARA_LOAD and COParaLost()") {
  for (const unsigned read : {1U, 2U}) {  // the first read checks whether a record is stored
    ClassicDevice device;
    device.hold(0x44);
    refusing.refuse_read = read;
    unsigned lost = 0;
    callbacks().para_lost = [&](CO_NODE*, const CO_PARA*) { ++lost; };
    Fixture node(device.setup());
    CHECK(node.error() == CO_ERR_PARA_LOAD);
    CHECK(lost == 1);
    node.ask("601#4000230200000000", "581#4300230214000000");
  }
}

TEST_CASE("parameters: a reset that COParaLost() requests is carried out after CONodeParaLoad()") {
  ClassicDevice device;
  device.hold(0x44);
  unsigned lost = 0;
  Fixture node(device.setup());
  refusing.refuse_read = refusing.reads + 1;
  callbacks().para_lost = [&](CO_NODE*, const CO_PARA*) {
    ++lost;
    CONmtReset(&node->Nmt, CO_RESET_COM);
    node.silent();
  };
  node.call([&] { CHECK(CONodeParaLoad(&node.node, CO_RESET_NODE) == CO_ERR_PARA_LOAD); });
  node.tx("701#00");
  CHECK(lost == 1);
}

TEST_CASE("parameters: a classic driver that cannot write aborts \"save\" and \"load\" with 0606 0000h") {
  ClassicDevice device;
  device.hold(0x44);
  Fixture node(device.setup());
  node.ask("601#2300230255000000", "581#6000230200000000");
  refusing.refuse_write = 1;
  node.ask("601#2310100173617665", "581#8010100100000606");
  refusing.refuse_write = refusing.writes + 1;
  node.ask("601#231110016C6F6164", "581#8011100100000606");
  CHECK(ClassicDevice::held() == 0x44);
}

TEST_CASE("parameters: with a classic driver a group whose stored bytes cannot be read is written") {
  ClassicDevice device;
  Fixture node(device.setup());
  refusing.refuse_read = refusing.reads + 1;
  node.ask("601#2310100173617665", "581#6010100100000000");
  CHECK(ClassicDevice::held() == 20);
  refusing.refuse_read = refusing.reads + 1;
  node.ask("601#231110016C6F6164", "581#6011100100000000");
  CHECK(ClassicDevice::held() == 0xFFFFFFFF);
}

TEST_CASE("parameters: with a classic driver a group of several pieces is stored and erased to its last byte") {
  constexpr std::uint32_t size = 2 * CO_STORE_BUFFER + 5;
  if (size > 120) {
    return;
  }
  static std::uint8_t values[size];
  CO_PARA group = {100, size, values, nullptr, CO_RESET_NODE, nullptr, CO_PARA___E};
  ClassicDevice device;
  Fixture node(device.without_groups()
                   .nvm(refusing_driver, nullptr)
                   .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, Device::data(&group)})
                   .with({CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, Device::data(&group)}));
  std::fill(std::begin(refusing.bytes), std::end(refusing.bytes), std::uint8_t{0x77});
  std::fill(std::begin(values), std::end(values), std::uint8_t{0x11});
  const auto check = [&](std::uint8_t expected) {
    for (std::uint32_t n = 0; n < 256; ++n) CHECK(refusing.bytes[n] == (n - 100 < size ? expected : 0x77));
  };
  node.ask("601#2310100173617665", "581#6010100100000000");
  check(0x11);
  const unsigned writes = refusing.writes;
  node.ask("601#2310100173617665", "581#6010100100000000");
  CHECK(refusing.writes == writes);
  values[size - 1] = 0x12;  // in the last piece
  node.ask("601#2310100173617665", "581#6010100100000000");
  CHECK(refusing.bytes[100 + size - 1] == 0x12);
  CHECK(refusing.writes == writes + 1);
  node.ask("601#231110016C6F6164", "581#6011100100000000");
  check(0xFF);
}

TEST_CASE("parameters: with a classic driver values that are stored already are not written again") {
  ClassicDevice device;
  Fixture node(device.setup());
  node.ask("601#2310100173617665", "581#6010100100000000");
  node.ask("601#2310100173617665", "581#6010100100000000");
  CHECK(refusing.writes == 1);
  node.ask("601#231110016C6F6164", "581#6011100100000000");
  const unsigned writes = refusing.writes;
  node.ask("601#231110016C6F6164", "581#6011100100000000");
  CHECK(refusing.writes == writes);
}

TEST_CASE("parameters: with a classic driver a group that is not stored on command is loaded and refuses \"save\"") {
  ClassicDevice device;
  device.hold(0x44);
  device.application.Value = CO_PARA____;
  Fixture node(device.setup());
  CHECK(node.error() == CO_ERR_NONE);
  node.ask("601#4000230200000000", "581#4300230244000000");
  node.ask("601#2310100173617665", "581#8010100120000008");
  CHECK(refusing.writes == 0);
}

TEST_CASE("parameters: with a classic driver groups overlap where their bytes overlap") {
  for (const std::uint32_t distance : {7U, 8U}) {
    ClassicDevice device;
    device.own.Offset = 100;
    device.application.Offset = 100 + distance;
    Fixture node(static_cast<Device&>(device).setup().nvm(refusing_driver, nullptr));
    CHECK(node.error() == (distance == 8 ? CO_ERR_NONE : CO_ERR_PARA_OVERLAP));
    node.ask("601#2310100373617665", distance == 8 ? "581#6010100300000000" : "581#8010100300000606");
    CHECK((refusing.writes == 0) == (distance == 7));
  }
}

TEST_CASE("parameters: a node that is stopped while it loads stores nothing afterwards") {
  Device device;
  device.nvm.bytes.assign(device.nvm.bytes.size(), 0x55);
  Fixture* running = nullptr;
  Fixture node(device.setup());
  running = &node;
  callbacks().para_lost = [&](CO_NODE*, const CO_PARA*) { CONodeStop(&running->node); };
  device.nvm.bytes.assign(device.nvm.bytes.size(), 0x55);
  node.rx("000#8101");
  CHECK(node.mode() == CO_INVALID);
  device.ram[2].number = 99;
  const auto steps = device.nvm.steps;
  node.after(std::chrono::milliseconds(2 * CO_PARA_PERIOD));
  CHECK(device.nvm.steps == steps);
}

TEST_CASE("1020h: a download to a string or a domain makes both values 0 [S7]") {
  Device device;
  device.date = 5;
  Fixture node(device.setup());
  node.ask("601#2310210041424344", "581#6010210000000000");
  node.ask("601#4020100100000000", "581#4320100100000000");
}

TEST_CASE("parameters: without default values a group keeps the values of its variables") {
  Device device;
  device.application.Default = nullptr;
  device.ram[1].number = 0x77;
  Fixture node(device.setup());
  node.ask("601#4000230200000000", "581#4300230277000000");
}

TEST_CASE("1020h: a write to an object of a group makes both values 0; other writes do not [S7]") {
  Device device;
  Fixture node(device.setup());
  const auto verify = [&] {
    node.ask("601#2320100134120000", "581#6020100100000000");
    node.ask("601#2320100278560000", "581#6020100200000000");
  };
  verify();
  node.ask("601#2300230401000000", "581#6000230400000000");
  node.ask("601#4020100100000000", "581#4320100134120000");
  node.ask("601#4020100200000000", "581#4320100278560000");
  node.ask("601#2300230101000000", "581#6000230100000000");
  node.ask("601#4020100100000000", "581#4320100100000000");
  node.ask("601#4020100200000000", "581#4320100200000000");
  verify();
  node.ask("601#4020100100000000", "581#4320100134120000");
}

TEST_CASE("1020h: a write to an object of a group clears values that were present at start [S7]") {
  Device device;
  device.date = 5;
  device.time = 6;
  Fixture node(device.setup());
  node.ask("601#2300230201000000", "581#6000230200000000");
  node.ask("601#4020100100000000", "581#4320100100000000");
  node.ask("601#4020100200000000", "581#4320100200000000");
}

CO_ERR stop_node(CO_OBJ*, CO_NODE* node, void*, std::uint32_t) {
  CONmtSetMode(&node->Nmt, CO_STOP);
  return CO_ERR_NONE;
}
std::uint32_t size_of_long(CO_OBJ*, CO_NODE*, std::uint32_t) { return 4; }

TEST_CASE("1020h: a type of the application at sub-index 2 may stop the node, after the answer [S7] [Q9]") {
  const CO_OBJ_TYPE stopping = {size_of_long, nullptr, nullptr, stop_node, nullptr};
  Device device;
  device.date = 5;
  Fixture node(device.setup().with({CO_KEY(0x1020, 2, CO_OBJ_____RW), &stopping, 0}));
  node.ask("601#2300230201000000", "581#6000230200000000");
  CHECK(node.mode() == CO_STOP);
  CHECK(device.date == 0);
  CHECK(device.ram[1].number == 1);
  node.rx("000#8001");
  node.ask("601#4000230200000000", "581#4300230201000000");
}

}  // namespace

#endif
