// SPDX-License-Identifier: Apache-2.0
// The driver check for ports (tests/drivers/driver_check) on the drivers for bxCAN, M_CAN and FlexCAN.
#include "bench.hpp"
#include "co_driver_check.h"

namespace {

using namespace test;

struct Setting {
  Bench bench;
  std::vector<std::string> failures;
  CO_NODE_EXT own{};
  CO_NODE_EXT peer{};
  CO_DRIVER_CHECK check{};
};

// Bit times for each iteration of a wait.
constexpr unsigned bits = 4;

CO_NODE_EXT extension(Controller& can) {
  CO_NODE_EXT ext{};
  ext.Size = sizeof ext;
  ext.Can = can.driver;
  ext.CanCtx = can.context();
  return ext;
}

void run_check(Setting& setting, CO_CHECK_BUS bus) {
  setting.check.Ext = &setting.own;
  setting.check.Peer = bus == CO_CHECK_PEER ? &setting.peer : nullptr;
  setting.check.Print = [](void* user, const char* line) {
    const std::string text = line;
    if (text.rfind("not ok", 0) == 0) {
      static_cast<Setting*>(user)->failures.push_back(text);
    }
  };
  setting.check.Idle = [](void* user) { static_cast<Setting*>(user)->bench.run(bits); };
  setting.check.User = &setting;
  setting.check.Bus = bus;
  setting.check.Baudrate = Bench::baud;
  setting.check.Frames = CO_CHECK_29_BIT | CO_CHECK_REMOTE;
  setting.check.Patience = 5000;
  setting.check.Quiet = 100;
  setting.bench.peer.node().stop();  // it would acknowledge frames for a controller that is not on the bus yet
  CODriverCheckCan(&setting.check);
  CHECK(setting.failures == std::vector<std::string>{});
  CHECK(setting.check.Failed == 0);
}

TEST_CASE("driver check: two controllers on one bus") {
  for (const Kind kind : all_kinds) {
    CAPTURE(name_of(kind));
    Setting setting;
    ControllerOptions options;
    options.starts = false;
    options.bxcan = {28, 0, 14, 0, false};
    setting.own = extension(setting.bench.add(kind, options));
    options.number = 1;
    options.bxcan.first = 14;
    setting.peer = extension(setting.bench.add(kind, options));
    run_check(setting, CO_CHECK_PEER);
    CHECK(setting.check.Passed >= 15);
    CHECK(setting.check.Skipped == 0);
  }
}

TEST_CASE("driver check: loopback") {
  for (const Kind kind : all_kinds) {
    CAPTURE(name_of(kind));
    Setting setting;
    ControllerOptions options;
    options.starts = false;
    options.loopback = true;
    setting.own = extension(setting.bench.add(kind, options));
    run_check(setting, CO_CHECK_LOOPBACK);
    CHECK(setting.check.Passed >= 14);
    CHECK(setting.check.Skipped <= 1);
  }
}

}  // namespace
