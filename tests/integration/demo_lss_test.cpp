// SPDX-License-Identifier: Apache-2.0
// What lexican-demo-master lss does, with a node without node-ID at the other end of a virtual bus.
#include "co_cfg.h"

#if USE_CSDO && USE_LSS && USE_LSS_MASTER
#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "demo_simulation.hpp"
#include "host/node.hpp"
#include "linux_master/lss.hpp"
#include "support/callbacks.hpp"
#include "support/notation.hpp"

namespace {

using demo::LssAction;
using demo::LssArguments;

CO_OBJ slave_dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 0},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 4},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x319},
    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, 0xC10C},
    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x10002},
    {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x80000001},
};

struct Desk {
  Desk() {
    CONodeStart(&slave.stack());
    host.others = [this] { return slave.process(); };
    host.bus.set_trace(
        [this](const co::VirtualBus::Traffic& traffic) { frames.push_back(test::notation(traffic.frame)); });
  }
  ~Desk() { test::callbacks().lss_store = nullptr; }
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  /// The exit code of the program.
  int run(LssAction action, const char* value = "", const std::vector<std::string>& address = {}, bool store = false) {
    LssArguments arguments;
    arguments.action = action;
    arguments.value = value;
    arguments.address = address;
    arguments.store = store;
    out.str("");
    err.str("");
    frames.clear();
    const demo::LssPrepared prepared = demo::prepare(arguments);
    REQUIRE(prepared.fault == "");
    const int code = demo::carry_out(prepared.request, host, out, err);
    while (slave.process()) {
    }
    return code;
  }
  /// By the master.
  std::string last_request() const {
    const auto is_request = [](const std::string& frame) { return frame.compare(0, 3, "7E5") == 0; };
    const auto last = std::find_if(frames.rbegin(), frames.rend(), is_request);
    return last == frames.rend() ? "" : *last;
  }
  bool was_sent(const char* frame) const { return std::count(frames.begin(), frames.end(), frame) > 0; }

  test::SimulatedHost host;
  std::ostringstream out;
  std::ostringstream err;
  std::vector<std::string> frames;
  demo::Node slave{{255, host.device_can(), host.device_timer(), {slave_dictionary, 7}}};
};

const std::vector<std::string> address = {"0x319", "0xC10C", "0x10002", "0x80000001"};
constexpr const char* shown = "0x00000319 0x0000C10C 0x00010002 0x80000001\n";

}  // namespace

TEST_CASE("demo lss: scan prints the addresses of nodes without node-ID, and leaves them as they are") {
  Desk desk;
  CHECK(desk.run(LssAction::scan) == 0);
  CHECK(desk.out.str() == shown);
  CHECK(desk.err.str() == "");
  CHECK(desk.frames[1] == "7E5#0400000000000000");
  CHECK(desk.frames[2] == "7E5#5100000000800000");
  CHECK(desk.last_request() == "7E5#0400000000000000");
  CHECK(desk.run(LssAction::scan) == 0);
  CHECK(desk.out.str() == shown);
}

TEST_CASE("demo lss: set-id finds a node without node-ID, and lets it boot with one") {
  Desk desk;
  std::uint8_t stored = 0;
  test::callbacks().lss_store = [&](std::uint32_t, std::uint8_t id) { return stored = id, CO_ERR_NONE; };
  CHECK(desk.run(LssAction::set_id, "5", {}, true) == 0);
  CHECK(desk.out.str() == shown);
  CHECK(desk.was_sent("7E5#1105000000000000"));
  CHECK(desk.was_sent("7E5#1700000000000000"));
  CHECK(desk.was_sent("705#00"));
  CHECK(stored == 5);
  CHECK(desk.run(LssAction::scan) == 0);
  CHECK(desk.out.str() == "");
  CHECK(desk.run(LssAction::set_id, "6") == 1);
  CHECK(desk.err.str() == "LSS: no node without node-ID\n");
}

TEST_CASE("demo lss: a node is asked and configured by its address") {
  Desk desk;
  const char* identity =
      "vendor-ID       0x00000319\nproduct code    0x0000C10C\nrevision number 0x00010002\n"
      "serial number   0x80000001\n";
  CHECK(desk.run(LssAction::inquire, "", address) == 0);
  CHECK(desk.out.str() == std::string(identity) + "node-ID         none\n");
  CHECK(desk.run(LssAction::set_id, "7", address) == 0);
  CHECK(desk.out.str() == "");
  CHECK(desk.was_sent("7E5#4301000080000000"));
  CHECK(desk.run(LssAction::inquire, "", address) == 0);
  CHECK(desk.out.str() == std::string(identity) + "node-ID         7\n");
  CHECK(desk.run(LssAction::set_bit_rate, "500000", address) == 0);
  CHECK(desk.was_sent("7E5#1300020000000000"));
  CHECK(desk.run(LssAction::store, "", address) == 0);
  CHECK(desk.was_sent("7E5#1700000000000000"));
}

TEST_CASE("demo lss: what goes wrong is told, with status 1, and all are switched back to waiting") {
  Desk desk;
  CHECK(desk.run(LssAction::inquire, "", {"1", "2", "3", "4"}) == 1);
  CHECK(desk.err.str() == "LSS: no answer\n");
  CHECK(desk.out.str() == "");
  CHECK(desk.last_request() == "7E5#0400000000000000");
  test::callbacks().lss_store = [](std::uint32_t, std::uint8_t) { return CO_ERR_BAD_ARG; };
  CHECK(desk.run(LssAction::store, "", address) == 1);
  CHECK(desk.err.str() == "LSS: refused with error 2\n");
  CHECK(desk.last_request() == "7E5#0400000000000000");
}

TEST_CASE("demo lss: an interruption ends it with status 130") {
  Desk desk;
  desk.host.interrupted_at = desk.host.now() + 200 * demo::millisecond;
  CHECK(desk.run(LssAction::scan) == 130);
  CHECK(desk.err.str() == "LSS: cancelled\n");
  CHECK(desk.last_request() == "7E5#0400000000000000");
}
#endif
