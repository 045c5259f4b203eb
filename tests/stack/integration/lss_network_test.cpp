// SPDX-License-Identifier: Apache-2.0
// Tests an LSS master and slaves on one bus: 127 nodes without node-ID are assigned theirs. [305]
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "support/network.hpp"
#include "support/notation.hpp"

#if USE_LSS && USE_LSS_MASTER

namespace {

using test::Device;
using test::Line;
using test::World;
using namespace std::chrono_literals;

using Address = std::array<std::uint32_t, 4>;

constexpr std::uint8_t no_node_id = 255;
constexpr std::uint8_t master_id =
    127;  // also assigned to the last of 127 slaves: the master sends no frames that would collide with its frames

/// Returns a dictionary with little more than an LSS address.
std::vector<CO_OBJ> dictionary(const Address& address) {
  std::vector<CO_OBJ> table = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
                               {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 0},
                               {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 4}};
  for (std::uint8_t part = 0; part < 4; ++part) {
    table.push_back({CO_KEY(0x1018, part + 1, CO_OBJ_D___R_), CO_TUNSIGNED32, address[part]});
  }
  table.push_back(CO_OBJ_DICT_ENDMARK);
  return table;
}

/// Application of the LSS master: finds a slave without node-ID, assigns the next node-ID to it and switches it to the
/// state waiting, until no slave is left. Scans again after lost frames.
class Commissioning {
 public:
  /// Ends after \a enough consecutive scans without a result, or after 200 scans. \a known: parts of \a address that
  /// all slaves share.
  Commissioning(unsigned enough, std::uint8_t known, const Address& address)
      : enough_(enough), known_(known), address_(address) {}

  void start(CO_LSSM& lssm) {
    none_ = 0;
    scans_ = 0;
    done = false;
    scan(lssm);
  }

  std::vector<Address> found;
  unsigned losses = 0;
  bool done = true;

 private:
  static Commissioning& of(CO_LSSM* lssm) { return *static_cast<Commissioning*>(CONodeGetUser(lssm->Node)); }

  void scan(CO_LSSM& lssm) { REQUIRE(COLssmFastscan(&lssm, address_.data(), known_, on_scan) == CO_ERR_NONE); }

  static void on_scan(CO_LSSM* lssm, CO_LSSM_RESULT result) {
    Commissioning& self = of(lssm);
    self.none_ = result == CO_LSSM_NOT_FOUND ? self.none_ + 1 : 0;
    if (self.none_ == self.enough_ || ++self.scans_ == 200) {
      self.done = true;
    } else if (result == CO_LSSM_OK) {
      self.found.push_back({lssm->Address[0], lssm->Address[1], lssm->Address[2], lssm->Address[3]});
      const auto id = static_cast<std::uint8_t>((self.found.size() - 1) % 127 + 1);
      REQUIRE(COLssmConfigureNodeId(lssm, id, on_configured) == CO_ERR_NONE);
    } else {
      self.losses += result == CO_LSSM_TIMEOUT ? 1 : 0;
      REQUIRE(COLssmSwitchGlobal(lssm, CO_LSSM_WAITING, on_waiting) == CO_ERR_NONE);
    }
  }
  static void on_configured(CO_LSSM* lssm, CO_LSSM_RESULT result) {
    of(lssm).losses += result == CO_LSSM_TIMEOUT ? 1 : 0;
    REQUIRE(COLssmSwitchGlobal(lssm, CO_LSSM_WAITING, on_waiting) == CO_ERR_NONE);
  }
  static void on_waiting(CO_LSSM* lssm, CO_LSSM_RESULT) { of(lssm).scan(*lssm); }

  unsigned enough_;
  std::uint8_t known_;
  Address address_;
  unsigned none_ = 0;   // consecutive scans without a result
  unsigned scans_ = 0;  // completed scans
};

/// A bus with a master and slaves without node-ID.
class Network {
 public:
  Network(const std::vector<Address>& addresses, Commissioning& commissioning) {
    line.bus.set_trace([this](const co::VirtualBus::Traffic& traffic) {
      const CO_IF_FRM& frame = traffic.frame;
      if (frame.Identifier > 0x700 && frame.Identifier <= 0x77F && frame.Data[0] == 0) {
        boot_ups.push_back(frame.Identifier - 0x700);
      }
    });
    tables_.reserve(addresses.size() + 1);
    tables_.push_back(dictionary({1, 2, 3, 4}));
    master = &add(master_id, &commissioning);
    for (const Address& address : addresses) {
      tables_.push_back(dictionary(address));
      slaves.push_back(&add(no_node_id, nullptr));
    }
    world.settle();
    boot_ups.clear();
    REQUIRE(COLssmSetTimes(&master->node.Lssm, 5, 2) == CO_ERR_NONE);
  }

  /// Runs the network until the commissioning is done, at most for \a time.
  void run(Commissioning& commissioning, std::chrono::milliseconds time) {
    commissioning.start(master->node.Lssm);
    master->wake();
    for (auto passed = 0ms; !commissioning.done && passed < time; passed += 1ms) {
      settle();
      world.clock.advance(1);
    }
  }

  World world;
  Line& line = world.add_line("bus");
  Device* master = nullptr;
  std::vector<Device*> slaves;
  std::vector<std::uint32_t> boot_ups;  // node-IDs whose boot-up messages were sent

 private:
  /// Like World::settle(), but all nodes run before frames are transferred: with many nodes this is much faster.
  void settle() {
    for (bool any = true; any;) {
      line.bus.hold();
      any = master->process();
      for (Device* const slave : slaves) {
        any = slave->process() || any;
      }
      line.bus.release();
    }
  }
  Device& add(std::uint8_t node_id, void* user) {
    test::DeviceOptions options{node_id};
    options.domain_bytes = 0;
    options.table = tables_.back().data();
    options.user = user;
    return world.add_device(line, options);
  }

  std::vector<std::vector<CO_OBJ>> tables_;
};

/// Returns corner values, addresses that differ in one bit, and random ones, without duplicates. The first \a same
/// parts are equal in all.
std::vector<Address> addresses(std::size_t number, std::size_t same) {
  constexpr Address usual = {0x00000319, 0x12345678, 0x00010002, 0x80000001};
  std::set<Address> all = {usual};
  const auto add = [&](Address address) {
    std::copy_n(usual.begin(), same, address.begin());
    all.insert(address);
  };
  add({0, 0, 0, 0});
  add({UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX});
  add({0, UINT32_MAX, 0, UINT32_MAX});
  add({UINT32_MAX, 0, UINT32_MAX, 0});
  for (unsigned bit = 0; bit < 128; bit += 4 - static_cast<unsigned>(same)) {
    Address neighbour = usual;
    neighbour[bit / 32] ^= 1U << bit % 32;
    add(neighbour);
  }
  std::mt19937 random(305);
  const auto next = [&] { return static_cast<std::uint32_t>(random()); };
  while (all.size() < number) {
    Address address{};
    std::generate(address.begin(), address.end(), next);
    add(address);
  }
  std::vector<Address> shuffled(all.begin(), all.end());
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  return shuffled;
}

std::vector<Address> sorted(std::vector<Address> all) {
  std::sort(all.begin(), all.end());
  return all;
}

bool works(const Device* slave) { return slave->node.Nmt.Mode == CO_PREOP; }

void check_all_found(const Network& network, const Commissioning& commissioning, const std::vector<Address>& all) {
  CHECK(commissioning.losses == 0);
  CHECK((commissioning.found == sorted(all)));
  for (std::size_t n = 0; n < all.size(); ++n) {
    const auto place = std::find(commissioning.found.begin(), commissioning.found.end(), all[n]);
    const auto id = static_cast<std::uint32_t>(place - commissioning.found.begin() + 1);
    CHECK(network.slaves[n]->node.NodeId == id);
    CHECK(works(network.slaves[n]));
    CHECK(std::count(network.boot_ups.begin(), network.boot_ups.end(), id) == 1);
  }
  CHECK(network.boot_ups.size() == all.size());
}

}  // namespace

TEST_CASE("LSS network: each of 127 unconfigured nodes is found once and boots with its node-ID") {
  const std::vector<Address> all = addresses(127, 3);
  REQUIRE(all.size() == 127);
  Commissioning commissioning(1, 3, all.front());
  Network network(all, commissioning);
  network.run(commissioning, 100s);
  REQUIRE(commissioning.done);
  check_all_found(network, commissioning, all);
}

TEST_CASE("LSS network: nodes are found by their complete address when no part is known") {
  const std::vector<Address> all = addresses(44, 0);
  REQUIRE(all.size() == 44);
  Commissioning commissioning(1, 0, {});
  Network network(all, commissioning);
  network.run(commissioning, 100s);
  REQUIRE(commissioning.done);
  check_all_found(network, commissioning, all);
}

TEST_CASE("LSS network: lost frames do not block the master; missed nodes are found later") {
  const std::vector<Address> all = {{9, 0, 0, 0}, {9, 0, 0, 1},          {9, 0, 1, 0},
                                    {9, 1, 0, 0}, {9, 1, 1, UINT32_MAX}, {9, UINT32_MAX, 1, 7}};
  for (const unsigned nth : {2U, 11U, 97U}) {
    CAPTURE(nth);
    Commissioning commissioning(5, 1, all.front());
    Network network(all, commissioning);
    std::mt19937 random(nth);
    const auto is_lost = [&](const co::VirtualBus::Traffic& traffic) {
      return traffic.frame.Identifier >= 0x7E4 && random() % nth == 0;
    };
    const auto lost = network.line.bus.add_rule({co::VirtualBus::Fault::drop, is_lost, 1, co::VirtualBus::always});
    network.run(commissioning, 60s);
    CHECK(commissioning.done);
    CHECK(network.line.bus.struck(lost) > 0);
    network.line.bus.clear_rules();
    network.line.say("7E5#0400000000000000");  // slaves whose selection the master did not notice
    network.world.settle();
    network.run(commissioning, 60s);
    CHECK(commissioning.done);
    CHECK(std::all_of(network.slaves.begin(), network.slaves.end(), works));
  }
}

TEST_CASE("LSS network: a slave is selected by its address, gets node-ID and bit rate, and returns them") {
  struct Steps {
    unsigned done = 0;
    std::vector<std::uint32_t> values;
    CO_LSSM_RESULT last = CO_LSSM_OK;
    static void note(CO_LSSM* lssm, CO_LSSM_RESULT result) {
      auto& steps = *static_cast<Steps*>(CONodeGetUser(lssm->Node));
      ++steps.done;
      steps.last = result;
      steps.values.push_back(lssm->Value);
    }
  };
  Steps steps;
  World world;
  Line& line = world.add_line("bus");
  const std::vector<CO_OBJ> own = dictionary({1, 2, 3, 4});
  const std::vector<CO_OBJ> one = dictionary({5, 6, 7, 8});
  const std::vector<CO_OBJ> other = dictionary({5, 6, 7, 9});
  const auto add = [&](std::uint8_t id, const std::vector<CO_OBJ>& table) -> Device& {
    test::DeviceOptions options{id};
    options.table = table.data();
    options.user = &steps;
    return world.add_device(line, options);
  };
  CO_LSSM& lssm = add(1, own).node.Lssm;
  Device& first = add(2, one);
  Device& second = add(3, other);
  const auto wait = [&](CO_ERR err) {
    REQUIRE(err == CO_ERR_NONE);
    const unsigned before = steps.done;
    world.pass(1100ms);
    CHECK(steps.done == before + 1);
    CHECK(steps.last == CO_LSSM_OK);
  };
  const std::uint32_t address[] = {5, 6, 7, 9};
  const std::uint32_t range[] = {5, 6, 7, 7, 0, 100};
  wait(COLssmIdentify(&lssm, range, Steps::note));
  wait(COLssmSwitchSelective(&lssm, address, Steps::note));
  wait(COLssmInquireNodeId(&lssm, Steps::note));
  CHECK(steps.values.back() == 3);
  wait(COLssmInquire(&lssm, CO_LSSM_SERIAL, Steps::note));
  CHECK(steps.values.back() == 9);
  wait(COLssmConfigureNodeId(&lssm, 33, Steps::note));
  wait(COLssmStore(&lssm, Steps::note));
  wait(COLssmSwitchGlobal(&lssm, CO_LSSM_WAITING, Steps::note));
  line.say("000#8203");
  world.settle();
  CHECK(second.node.NodeId == 33);
  CHECK(first.node.NodeId == 2);

  wait(COLssmSwitchGlobal(&lssm, CO_LSSM_CONFIGURATION, Steps::note));
  wait(COLssmConfigureBitTiming(&lssm, 500000, Steps::note));
  wait(COLssmActivateBitTiming(&lssm, 100, 500000, Steps::note));
  CHECK(lssm.Node->Baudrate == 500000);
  CHECK(first.node.Baudrate == 500000);
  CHECK(second.port.baud() == 500000);
  wait(COLssmSwitchGlobal(&lssm, CO_LSSM_WAITING, Steps::note));
  wait(COLssmSwitchSelective(&lssm, address, Steps::note));
  wait(COLssmInquireNodeId(&lssm, Steps::note));
  CHECK(steps.values.back() == 33);
}

#endif
