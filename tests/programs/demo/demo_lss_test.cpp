// SPDX-License-Identifier: Apache-2.0
// Tests lexican-demo-master lss with a node without node-ID at the other end of a virtual bus.
#include "co_cfg.h"

#if USE_CSDO && USE_LSS && USE_LSS_MASTER
#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "client/lss.hpp"
#include "demo_simulation.hpp"
#include "host/node.hpp"
#include "support/callbacks.hpp"
#include "support/notation.hpp"

namespace {

using lexican::LssAction;
using lexican::LssArguments;

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

  /// Runs the program and returns its exit code.
  int run(LssAction action, const char* value = "", const std::vector<std::string>& address = {}, bool store = false) {
    LssArguments arguments;
    arguments.action = action;
    arguments.value = value;
    arguments.address = address;
    arguments.store = store;
    out.str("");
    err.str("");
    frames.clear();
    const lexican::LssPrepared prepared = lexican::prepare(arguments);
    REQUIRE(prepared.fault == "");
    const int code = lexican::carry_out(prepared.request, host, out, err);
    while (slave.process()) {
    }
    return code;
  }
  /// Returns the last LSS frame of the master.
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
  lexican::Node slave{{255, host.device_can(), host.device_timer(), {slave_dictionary, 7}}};
};

/// A slave at a separate port with planned behaviour; by default it conforms to CiA 305.
class OddSlave {
 public:
  explicit OddSlave(Desk& desk, lexican::LssAddress own) : own_(own), port_(desk.host.bus.attach({"odd"})) {
    port_.enable();
    auto others = desk.host.others;
    desk.host.others = [this, others] {
      const bool busy = others && others();
      return process() || busy;
    };
  }

  bool answers_every_scan = false;    ///< answers each request of a fastscan with 4Fh
  bool scanned_always = false;        ///< answers a fastscan in the state configuration, too
  bool ignores_selection = false;     ///< does not answer switch state selective
  bool always_configures = false;     ///< answers 11h in the state waiting, too
  unsigned lost_inquiries = 0;        ///< number of the next inquiries without an answer
  std::uint32_t inquired_serial = 0;  ///< number in the answer to 5Dh; 0: that of 1018h:4
  unsigned node_ids = 0;              ///< number of 11h requests in the state configuration
  std::uint8_t node_id = 255;         ///< the last one received; 255: none

 private:
  bool process() {
    bool busy = false;
    while (const auto request = port_.read()) {
      busy = true;
      if (request->Identifier == 0x7E5 && serve(*request)) {
        port_.send(answer_);
      }
    }
    return busy;
  }
  bool answer(std::uint8_t command, std::uint32_t data = 0) {
    answer_ = {0x7E4, {command}, 8};
    CO_SET_LONG(&answer_, data, 1);
    return true;
  }
  bool serve(const CO_IF_FRM& request) {
    const std::uint8_t command = request.Data[0];
    const std::uint32_t number = CO_GET_LONG(&request, 1);
    if (command == 0x04) {
      configuration_ = request.Data[1] == 1;
      return false;
    }
    if (command == 0x51) {
      return (answers_every_scan || ((!configuration_ || scanned_always) && matches(request))) && answer(0x4F);
    }
    if (command >= 0x40 && command <= 0x43) {
      selected_ = number == own_[command - 0x40U] && (command == 0x40 || selected_);
      const bool whole = command == 0x43 && selected_ && !ignores_selection && !configuration_;
      configuration_ = configuration_ || whole;
      return whole && answer(0x44);
    }
    if (command == 0x11 && (configuration_ || always_configures)) {
      ++node_ids;
      node_id = request.Data[1];
      return answer(0x11);
    }
    if (command >= 0x5A && command <= 0x5D && configuration_) {
      if (lost_inquiries > 0) {
        --lost_inquiries;
        return false;
      }
      const bool other = command == 0x5D && inquired_serial != 0;
      return answer(command, other ? inquired_serial : own_[command - 0x5AU]);
    }
    return false;
  }
  bool matches(const CO_IF_FRM& request) {
    const unsigned bit = request.Data[5];
    const unsigned part = request.Data[6];
    if (bit == 0x80) {
      part_ = 0;
      return node_id == 255;
    }
    if (part != part_ || ((CO_GET_LONG(&request, 1) ^ own_[part]) >> bit) != 0) {
      return false;
    }
    if (bit == 0) {
      part_ = request.Data[7];
      configuration_ = part_ < part;
    }
    return true;
  }

  lexican::LssAddress own_;
  co::VirtualBus::Port& port_;
  bool configuration_ = false;
  bool selected_ = false;
  unsigned part_ = 0;
  CO_IF_FRM answer_{};
};

const std::vector<std::string> address = {"0x319", "0xC10C", "0x10002", "0x80000001"};
#define LABELS "vendor-ID, product code, revision, serial number: "
constexpr const char* shown = LABELS "0x00000319 0x0000C10C 0x00010002 0x80000001\n";

}  // namespace

TEST_CASE("demo lss: scan prints the addresses of nodes without node-ID and does not change them") {
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

TEST_CASE("demo lss: set-id finds a node without node-ID and starts it with one") {
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

TEST_CASE("demo lss: a node is inquired and configured by its address") {
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

TEST_CASE("demo lss: a failure is printed with status 1 after all nodes are switched back to waiting") {
  Desk desk;
  CHECK(desk.run(LssAction::inquire, "", {"1", "2", "3", "4"}) == 1);
  CHECK(desk.err.str() == "LSS: no answer; is there such a node on this bus, with power, and at this bit rate?\n");
  CHECK(desk.out.str() == "");
  CHECK(desk.last_request() == "7E5#0400000000000000");
  test::callbacks().lss_store = [](std::uint32_t, std::uint8_t) { return CO_ERR_BAD_ARG; };
  CHECK(desk.run(LssAction::store, "", address) == 1);
  CHECK(desk.err.str() == "LSS: refused with error 2\n");
  CHECK(desk.last_request() == "7E5#0400000000000000");
}

TEST_CASE("demo lss: an interrupt ends it with status 130") {
  Desk desk;
  desk.host.interrupted_at = desk.host.now() + 200 * lexican::millisecond;
  CHECK(desk.run(LssAction::scan) == 130);
  CHECK(desk.err.str() == "LSS: cancelled\n");
  CHECK(desk.last_request() == "7E5#0400000000000000");
}

TEST_CASE("demo lss: scan finds each of several nodes once") {
  Desk desk;
  OddSlave second(desk, {0x319, 0xC10C, 0x10002, 0x80000002});
  OddSlave third(desk, {0x400, 1, 2, 3});
  CHECK(desk.run(LssAction::scan) == 0);
  CHECK(desk.out.str() == std::string(shown) + LABELS "0x00000319 0x0000C10C 0x00010002 0x80000002\n" +
                              LABELS "0x00000400 0x00000001 0x00000002 0x00000003\n");
  CHECK(desk.err.str() == "");
}

TEST_CASE("demo lss: scan ends with a node that answers every request of a fastscan") {
  Desk desk;
  OddSlave odd(desk, {1, 2, 3, 4});
  odd.answers_every_scan = true;
  odd.node_id = 9;
  CHECK(desk.run(LssAction::scan) == 1);
  CHECK(desk.err.str() ==
        "LSS: fastscan has found the address 0 0 0 0, which no node has: a node answers every request of a fastscan; "
        "disconnect it, or name the node to configure by --address\n");
  CHECK(desk.out.str() == "");
  CHECK(desk.last_request() == "7E5#0400000000000000");
  CHECK(desk.run(LssAction::set_id, "5") == 1);
  CHECK(desk.err.str().find("0 0 0 0") != std::string::npos);
  CHECK_FALSE(desk.was_sent("7E5#1105000000000000"));
}

TEST_CASE("demo lss: scan ends with a node that it has found before") {
  Desk desk;
  OddSlave odd(desk, {1, 2, 3, 4});
  odd.scanned_always = true;
  CHECK(desk.run(LssAction::scan) == 1);
  CHECK(desk.out.str() == LABELS "0x00000001 0x00000002 0x00000003 0x00000004\n");
  CHECK(desk.err.str() ==
        "LSS: fastscan has found 0x00000001 0x00000002 0x00000003 0x00000004 again: this node answers although it is "
        "selected or has a node-ID; disconnect it, or name the node to configure by --address\n");
}

TEST_CASE("demo lss: scan verifies that a found node answers to its address") {
  Desk desk;
  OddSlave odd(desk, {1, 2, 3, 4});
  odd.ignores_selection = true;
  CHECK(desk.run(LssAction::scan) == 1);
  CHECK(desk.out.str() == "");
  CHECK(desk.err.str() ==
        "LSS: 0x00000001 0x00000002 0x00000003 0x00000004 was found, but does not answer to its address\n");
}

TEST_CASE("demo lss: a node with another identity than the found one is not configured") {
  for (const LssAction action : {LssAction::scan, LssAction::set_id}) {
    Desk desk;
    OddSlave odd(desk, {1, 2, 3, 4});
    odd.inquired_serial = 5;
    CHECK(desk.run(action, "5") == 1);
    CHECK(desk.out.str() == "");
    CHECK(desk.err.str() ==
          "LSS: the node at 0x00000001 0x00000002 0x00000003 0x00000004 reports another number: 0x00000005\n");
    CHECK_FALSE(desk.was_sent("7E5#1105000000000000"));
  }
}

TEST_CASE("demo lss: an inquiry without answer is repeated once") {
  for (const auto& by : {std::vector<std::string>{}, {"1", "2", "3", "4"}}) {
    Desk desk;
    OddSlave odd(desk, {1, 2, 3, 4});
    odd.lost_inquiries = 1;
    CHECK(desk.run(LssAction::set_id, "5", by) == 0);
    CHECK(std::count(desk.frames.begin(), desk.frames.end(), "7E5#5A00000000000000") == 2);
    CHECK(odd.node_id == 5);
    odd.node_id = 255;
    odd.lost_inquiries = 2;
    CHECK(desk.run(LssAction::set_id, "6", by) == 1);
    CHECK(desk.err.str() == "LSS: no answer; is there such a node on this bus, with power, and at this bit rate?\n");
    CHECK(odd.node_id == 255);
  }
}

constexpr const char* several =
    "LSS: 2 nodes have answered where one was addressed; give each node its own serial number, or connect one at a "
    "time\n";

TEST_CASE("demo lss: two nodes with one address are not configured") {
  Desk desk;
  OddSlave twin(desk, {0x319, 0xC10C, 0x10002, 0x80000001});
  for (const auto& by : {std::vector<std::string>{}, address}) {
    CHECK(desk.run(LssAction::set_id, "5", by) == 1);
    CHECK(desk.err.str() == several);
    CHECK(desk.out.str() == "");
    CHECK_FALSE(desk.was_sent("7E5#1105000000000000"));
    CHECK_FALSE(desk.was_sent("705#00"));
    CHECK(desk.last_request() == "7E5#0400000000000000");
  }
  CHECK(desk.run(LssAction::scan) == 1);
  CHECK(desk.err.str() == several);
}

TEST_CASE("demo lss: a node-ID that two nodes have accepted is removed from both") {
  Desk desk;
  OddSlave odd(desk, {1, 2, 3, 4});
  odd.always_configures = true;
  CHECK(desk.run(LssAction::set_id, "5", address, true) == 1);
  CHECK(desk.err.str() == several);
  CHECK(desk.was_sent("7E5#1105000000000000"));
  CHECK(desk.was_sent("7E5#11FF000000000000"));
  CHECK_FALSE(desk.was_sent("7E5#1700000000000000"));
  CHECK_FALSE(desk.was_sent("705#00"));
  CHECK(odd.node_id == 255);
}
#endif
