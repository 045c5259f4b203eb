// SPDX-License-Identifier: Apache-2.0
// Limit of store requests from the network: CO_PARA_BUDGET without a pause, and one more each minute.
#include "support/parameter_groups.hpp"

#if USE_PARA && CO_PARA_BUDGET > 0

namespace {

using namespace test;

constexpr const char* save_all = "601#2310100173617665";
constexpr const char* all_saved = "581#6010100100000000";
constexpr const char* save_refused = "581#8010100122000008";
constexpr const char* save_second = "601#2310100373617665";
constexpr const char* second_saved = "581#6010100300000000";
constexpr const char* second_refused = "581#8010100322000008";
constexpr const char* load_second = "601#231110036C6F6164";
constexpr auto budget = CO_PARA_BUDGET;

// A device, and an SDO client that changes 2300h:2 before each "save".
struct BudgetDevice : GroupDevice {
  BudgetDevice() = default;
  explicit BudgetDevice(CO_NVM_SHAPE shape) : GroupDevice(shape) {}

  void change(Fixture& node) {
    node.call([this] { ram[1].number += 1; });
  }
  void save_new(Fixture& node, const char* answer = second_saved) {
    change(node);
    node.ask(save_second, answer);
  }
  void use_up(Fixture& node) {
    for (int n = 0; n < budget; ++n) save_new(node);
  }
};

TEST_CASE("budget: a \"save\" beyond it is aborted with 0800 0022h and writes nothing") {
  BudgetDevice device;
  Fixture node(device.setup());
  device.use_up(node);
  const Bytes before = device.nvm.bytes;
  const auto steps = device.nvm.steps;
  device.save_new(node, second_refused);
  node.ask(save_all, save_refused);
  CHECK(device.nvm.bytes == before);
  CHECK(device.nvm.steps == steps);
}

TEST_CASE("budget: each minute allows one more store, up to the whole budget") {
  BudgetDevice device;
  Fixture node(device.setup());
  device.use_up(node);
  node.after(59999ms);
  device.save_new(node, second_refused);
  node.after(1ms);
  device.save_new(node);
  device.save_new(node, second_refused);
  node.after(2min);
  device.save_new(node);
  device.save_new(node);
  device.save_new(node, second_refused);
  node.after(std::chrono::minutes{2 * budget});
  CHECK(node.armed_timers() == 0);
  device.use_up(node);
  device.save_new(node, second_refused);
}

TEST_CASE("budget: of 1000 \"save\" with new values in a row as many are stored as the budget allows") {
  BudgetDevice device({1024, 8, 128});
  device.first.Offset = 512;
  device.second.Offset = 0;
  static unsigned erases;
  erases = 0;
  CO_IF_NVM_DRV_EX driver = FailingNvm::driver;
  driver.Erase = [](void* context, std::uint32_t start, std::uint32_t size) {
    ++erases;
    return FailingNvm::driver.Erase(context, start, size);
  };
  Fixture node(device.setup().nvm(driver, &device.nvm));
  for (int n = 0; n < 1000; ++n) {
    device.save_new(node, n < budget ? second_saved : second_refused);
  }
  CHECK(erases == budget);
}

TEST_CASE("budget: a \"save\" that changes nothing is not counted, and succeeds with a used-up budget") {
  BudgetDevice device;
  Fixture node(device.setup());
  device.save_new(node);
  for (int n = 0; n < 100; ++n) node.ask(save_second, second_saved);
  for (int n = 1; n < budget; ++n) device.save_new(node);
  for (int n = 0; n < 100; ++n) node.ask(save_second, second_saved);
  device.save_new(node, second_refused);
}

TEST_CASE("budget: \"save\" of all groups counts as one store, however many have changed") {
  BudgetDevice device;
  Fixture node(device.setup());
  for (int n = 0; n < budget; ++n) {
    node.call([&] { ++device.ram[0].number, ++device.ram[1].number; });
    node.ask(save_all, all_saved);
  }
  node.call([&] { ++device.ram[0].number, ++device.ram[1].number; });
  const auto steps = device.nvm.steps;
  node.ask(save_all, save_refused);
  CHECK(device.nvm.steps == steps);
}

TEST_CASE("budget: \"load\" counts as a store; a repeated \"load\" is not counted") {
  BudgetDevice device;
  Fixture node(device.setup());
  for (int n = 0; n < budget; n += 2) {
    device.save_new(node);
    node.ask(load_second, "581#6011100300000000");
  }
  node.ask(load_second, "581#6011100300000000");
  device.save_new(node, second_refused);
  node.after(1min);
  device.save_new(node);
  node.ask(load_second, "581#8011100322000008");
}

TEST_CASE("budget: NMT resets do not refill it; a power-on does") {
  BudgetDevice device;
  {
    Fixture node(device.setup());
    device.use_up(node);
    for (const char* reset : {"000#8101", "000#8201"}) {
      node.ask(reset, "701#00");
      device.save_new(node, second_refused);
    }
    node.after(30s);
    node.ask("000#8101", "701#00");
    node.after(29999ms);
    device.save_new(node, second_refused);
    node.after(1ms);
    device.save_new(node);
  }
  Fixture node(device.setup());
  device.use_up(node);
}

TEST_CASE("budget: COParaStore() and COParaRestore() by the application are neither counted nor limited") {
  BudgetDevice device;
  Fixture node(device.setup());
  const auto store = [&] {
    device.change(node);
    node.call([&] { CHECK(COParaStore(&device.second, &node.node) == CO_ERR_NONE); });
    node.call([&] { CHECK(COParaRestore(&device.second, &node.node) == CO_ERR_NONE); });
  };
  for (int n = 0; n < 2 * budget; ++n) store();
  CHECK(node.armed_timers() == 0);
  device.use_up(node);
  store();
}

TEST_CASE("budget: a \"save\" that fails after a partial write is counted") {
  BudgetDevice device;
  Fixture node(device.setup());
  for (int n = 0; n < budget; ++n) {
    device.change(node);
    device.nvm.cut_at = device.nvm.steps + 3;
    node.ask(save_second, "581#8010100300000606");
    device.nvm.is_off = false;
  }
  device.save_new(node, second_refused);
}

TEST_CASE("budget: a \"save\" that fails before it writes is not counted") {
  BudgetDevice device;
  SUBCASE("no place") { device.second.Offset = 1020; }
  SUBCASE("overlap") { device.second.Offset = 1; }
  Fixture node(device.setup());
  for (int n = 0; n < 2 * budget; ++n) node.ask(save_second, "581#8010100300000606");
  node.ask("601#2310100373617664", "581#8010100320000008");
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("budget: without a memory nothing is counted") {
  BudgetDevice device;
  Fixture node(device.setup().no_nvm());
  for (int n = 0; n < 2 * budget; ++n) {
    node.ask(save_second, "581#8010100300000606");
    node.ask(load_second, "581#8011100300000606");
  }
}

TEST_CASE("budget: it applies to a driver without Shape function") {
  BudgetDevice device;
  CO_IF_NVM_DRV_EX driver = FailingNvm::driver;
  driver.Shape = nullptr;
  Fixture node(device.setup().nvm(driver, &device.nvm));
  for (int n = 0; n < budget; n += 2) {
    device.save_new(node);
    node.ask(save_second, second_saved);
    node.ask(load_second, "581#6011100300000000");
    node.ask(load_second, "581#6011100300000000");
  }
  device.save_new(node, second_refused);
  const Bytes before = device.nvm.bytes;
  node.after(1min);
  device.save_new(node);
  node.ask(load_second, "581#8011100322000008");
  CHECK(device.nvm.bytes != before);
}

// Autonomous groups ------------------------------------------------------------------------------------------------

constexpr std::chrono::milliseconds period{CO_PARA_PERIOD};

struct AutonomousDevice : BudgetDevice {
  AutonomousDevice() { second.Value = CO_PARA__AE; }
  // Uses up the rest of the budget by "save" of the other group.
  void use_up(Fixture& node) {
    node.call([this] { ++ram[0].number; });
    while (true) {
      node.call([this] { ++ram[0].number; });
      node.rx("601#2310100273617665");
      const std::string answer = node.frames().back();
      if (answer != "581#6010100200000000") {
        CHECK(answer == "581#8010100222000008");
        (void)node.error();
        return;
      }
    }
  }
};

TEST_CASE("budget: an autonomous group is stored later without an error when it is used up") {
  AutonomousDevice device;
  Fixture node(device.setup());
  node.after(period);
  device.use_up(node);
  const auto steps = device.nvm.steps;
  device.change(node);
  node.after(period);
  CHECK(device.nvm.steps == steps);
  CHECK(node.error() == CO_ERR_NONE);
  node.after(1min + period);
  CHECK(device.nvm.steps > steps);
  device.ram[1].number = 0;
  node.init_again();
  CHECK(device.ram[1].number == 21);
}

TEST_CASE("budget: a group that changes continuously is stored once a minute on average") {
  AutonomousDevice device;
  Fixture node(device.setup());
  Bytes before = device.nvm.bytes;
  const auto stores_in = [&](int rounds) {
    int stores = 0;
    for (int n = 0; n < rounds; ++n) {
      device.change(node);
      node.after(period);
      stores += device.nvm.bytes != before ? 1 : 0;
      before = device.nvm.bytes;
    }
    return stores;
  };
  constexpr int hour = 3600000 / CO_PARA_PERIOD;
  const int first_hour = stores_in(hour);
  CHECK(first_hour <= budget + 60);
  CHECK(stores_in(hour) <= 60);
  CHECK(stores_in(hour) >= std::min(59, hour - 1));
}

TEST_CASE("budget: an NMT reset keeps a change that the budget has delayed and writes nothing") {
  AutonomousDevice device;
  Fixture node(device.setup());
  node.after(period);
  device.use_up(node);
  const auto steps = device.nvm.steps;
  for (const char* reset : {"000#8101", "000#8201", "000#8101"}) {
    device.change(node);
    const std::uint32_t number = device.ram[1].number;
    node.ask(reset, "701#00");
    CHECK(device.ram[1].number == number);
    CHECK(node.error() == CO_ERR_NONE);
  }
  CHECK(device.nvm.steps == steps);
  CHECK(device.ram[0].number > 10);
  const std::uint32_t number = device.ram[1].number;
  node.after(1min + period);
  CHECK(device.nvm.steps > steps);
  device.ram[1].number = 0;
  node.init_again();
  CHECK(device.ram[1].number == number);
}

TEST_CASE("budget: NMT resets while an autonomous group changes cause as many stores as the budget allows") {
  AutonomousDevice device;
  Fixture node(device.setup());
  Bytes before = device.nvm.bytes;
  int stores = 0;
  for (int n = 0; n < 1000; ++n) {
    device.change(node);
    node.ask("000#8101", "701#00");
    stores += device.nvm.bytes != before ? 1 : 0;
    before = device.nvm.bytes;
  }
  CHECK(stores == budget);
}

TEST_CASE("budget: requested defaults are loaded by the reset even when it is used up") {
  AutonomousDevice device;
  Fixture node(device.setup());
  device.change(node);
  node.ask(load_second, "581#6011100300000000");
  device.use_up(node);
  node.ask("000#8101", "701#00");
  CHECK(device.ram[1].number == 20);
}

TEST_CASE("budget: a stopped node does not refill it") {
  BudgetDevice device;
  Fixture node(device.setup());
  device.save_new(node);
  CHECK(node.armed_timers() == 1);
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("budget: a timer that is too fast to count a minute refills it later") {
  BudgetDevice device;
  Fixture node(device.setup().rate(100000000));
  device.use_up(node);
  node.after(43s);  // 2^32 ticks are 42.9 s
  device.save_new(node);
  device.save_new(node, second_refused);
}

#if USE_LSS

TEST_CASE("budget: LSS store counts as a store; beyond the budget it is answered with 255 and 22h") {
  BudgetDevice device;
  CO_NODE* slave = nullptr;
  Setup setup = device.setup().with({CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 4});
  setup.with({CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x44});
  callbacks().lss_store = [&](std::uint32_t baud, std::uint8_t id) { return COLssNvmStore(slave, 400, baud, id); };
  Fixture node(setup);
  slave = &node.node;
  for (int n = 0; n < budget; ++n) {
    node.rx("7E5#0401000000000000");
    node.ask(n % 2 == 0 ? "7E5#1105000000000000" : "7E5#1106000000000000", "7E4#1100000000000000");
    for (int repeated = 0; repeated < 3; ++repeated) {
      node.ask("7E5#1700000000000000", "7E4#1700000000000000");
    }
  }
  CHECK(node.error() == CO_ERR_NONE);
  node.ask("7E5#1107000000000000", "7E4#1100000000000000");
  node.ask("7E5#1700000000000000", "7E4#17FF220000000000");
  CHECK(node.error() == CO_ERR_LSS_STORE);
  node.call([&] { CHECK(COLssNvmStore(slave, 400, 125000, 9) == CO_ERR_NONE); });
  device.save_new(node, second_refused);
}

#endif

}  // namespace

#endif
