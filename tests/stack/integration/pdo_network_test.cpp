// SPDX-License-Identifier: Apache-2.0
// Tests two and sixteen nodes on one virtual bus that exchange synchronous and event-driven PDOs in a ring.
#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <vector>

#include "support/callbacks.hpp"
#include "support/network.hpp"
#include "support/notation.hpp"

#if CO_RPDO_N > 1 && CO_TPDO_N > 1 && USE_SYNC

namespace {

using namespace std::chrono_literals;
using test::Device;
using test::DeviceOptions;
using test::Line;
using test::World;

// A node that receives the PDOs of node \a before: RPDO 1 event-driven, RPDO 2 synchronous. It sends TPDO 1
// event-driven (flag A) and TPDO 2 synchronous. Node 1 produces SYNC.
class Member {
 public:
  Member(World& world, Line& line, std::uint8_t id, std::uint8_t before)
      : event_in_id_(0x180U + before),
        sync_in_id_(0x280U + before),
        event_out_id_(0x40000180U + id),
        sync_out_id_(0x40000280U + id),
        sync_id_(id == 1 ? 0x40000080 : 0x80),
        cycle_(id == 1 ? 10000 : 0) {
    build_table();
    DeviceOptions options{id};
    options.table = table_.data();
    device = &world.add_device(line, options);
  }
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  void say(std::uint32_t value) {
    CHECK(CODictWrLong(&device->node.Dict, CO_DEV(0x2001, 0), value) == CO_ERR_NONE);
    device->wake();
  }

  Device* device = nullptr;
  std::uint32_t event_in = 0;
  std::uint32_t event_out = 0;
  std::uint16_t sync_in = 0;
  std::uint16_t sync_out = 0;
  unsigned updates = 0;

 private:
  void add(std::uint16_t index, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
    table_.push_back({CO_KEY(index, sub, flags), type, data});
  }

  void add_communication(std::uint16_t index, std::uint32_t& id, std::uint8_t type) {
    add(index, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2);
    add(index, 1, CO_OBJ_____RW, CO_TPDO_ID, CO_DATA(&id));
    add(index, 2, CO_OBJ_D___R_, CO_TPDO_TYPE, type);
  }

  void add_mapping(std::uint16_t index, std::uint32_t word) {
    add(index, 0, CO_OBJ_D___R_, CO_TPDO_NUM, 1);
    add(index, 1, CO_OBJ_D___R_, CO_TPDO_MAP, word);
  }

  void build_table() {
    add(0x1000, 0, CO_OBJ_D___R_, CO_TUNSIGNED32, 0);
    add(0x1001, 0, CO_OBJ_____R_, CO_TUNSIGNED8, CO_DATA(&error_register_));
    add(0x1005, 0, CO_OBJ_____RW, CO_TSYNC_ID, CO_DATA(&sync_id_));
    add(0x1006, 0, CO_OBJ_____RW, CO_TSYNC_CYCLE, CO_DATA(&cycle_));
    add(0x1018, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 1);
    add(0x1018, 1, CO_OBJ_D___R_, CO_TUNSIGNED32, 0);
    add(0x1019, 0, CO_OBJ_D___R_, CO_TSYNC_COUNT, 7);
    add(0x1200, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2);
    add(0x1200, 1, CO_OBJ_DN__R_, CO_TSDO_ID, 0x600);
    add(0x1200, 2, CO_OBJ_DN__R_, CO_TSDO_ID, 0x580);
    add_communication(0x1400, event_in_id_, 255);
    add_communication(0x1401, sync_in_id_, 1);
    add_mapping(0x1600, 0x20000020);
    add_mapping(0x1601, 0x20020010);
    add_communication(0x1800, event_out_id_, 255);
    add_communication(0x1801, sync_out_id_, 1);
    add_mapping(0x1A00, 0x20010020);
    add_mapping(0x1A01, 0x20030010);
    add(0x2000, 0, CO_OBJ____P_W, CO_TUNSIGNED32, CO_DATA(&event_in));
    add(0x2001, 0, CO_OBJ___APR_, CO_TUNSIGNED32, CO_DATA(&event_out));
    add(0x2002, 0, CO_OBJ____P_W, CO_TUNSIGNED16, CO_DATA(&sync_in));
    add(0x2003, 0, CO_OBJ____PR_, CO_TUNSIGNED16, CO_DATA(&sync_out));
    table_.push_back(CO_OBJ_DICT_ENDMARK);
  }

  std::uint32_t event_in_id_, sync_in_id_, event_out_id_, sync_out_id_, sync_id_, cycle_;
  std::uint8_t error_register_ = 0;
  std::vector<CO_OBJ> table_;
};

struct Ring {
  explicit Ring(std::uint8_t nodes, std::uint32_t start_tick = 0) : world(1000, start_tick) {
    for (std::uint8_t id = 1; id <= nodes; ++id) {
      const auto before = static_cast<std::uint8_t>(id == 1 ? nodes : id - 1);
      members.push_back(std::make_unique<Member>(world, line, id, before));
    }
    test::callbacks().pdo_update = [this](CO_RPDO* pdo) { update(pdo); };
    line.say("000#0100");
    world.settle();
    line.take();
  }
  ~Ring() { test::callbacks() = {}; }
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  // The application of each node: forwards a received value, incremented by one, until it reaches the first node again.
  void update(CO_RPDO* pdo) {
    for (const auto& member : members) {
      CO_NODE& node = member->device->node;
      if (pdo == &node.RPdo[0] && pass_on) {
        const bool is_back = member == members.front();
        CODictWrLong(&node.Dict, CO_DEV(0x2001, 0), is_back ? member->event_out : member->event_in + 1);
      } else if (pdo == &node.RPdo[1]) {
        ++member->updates;
        member->sync_out = member == members.front() ? member->sync_out : member->sync_in;
      }
    }
  }

  std::vector<std::unique_ptr<Member>> members;  // declared before the nodes, which use the members' tables
  World world;
  Line& line = world.add_line("ring");
  bool pass_on = true;
};

void check_event_goes_round(std::uint8_t nodes) {
  Ring ring(nodes);
  for (std::uint32_t round = 1; round <= 20; ++round) {
    ring.members[0]->say(round * 1000);
    ring.world.settle();
    CHECK(ring.members[0]->event_in == round * 1000 + nodes - 1U);
    const auto heard = ring.line.take();
    REQUIRE(heard.size() == nodes);
    for (unsigned n = 0; n < nodes; ++n) {
      CHECK(heard[n].frame.Identifier == 0x181 + n);
      CHECK(CO_GET_LONG(&heard[n].frame, 0) == round * 1000 + n);
    }
  }
}

// Checks that a value moves on by one node every two SYNCs: one SYNC applies the RPDO, the next one samples the TPDO.
void check_synchronous_shift(std::uint8_t nodes) {
  Ring ring(nodes, 0xFFFFFFFF - 100);
  for (unsigned cycle = 0; cycle < 6U * nodes; ++cycle) {
    ring.members[0]->sync_out = static_cast<std::uint16_t>(0x100 + cycle);
    ring.world.pass(10ms);
    const auto heard = ring.line.take();
    REQUIRE(heard.size() == 1U + nodes);
    CHECK(heard[0].frame.Identifier == 0x80);
    CHECK(heard[0].frame.Data[0] == cycle % 7 + 1);
    for (unsigned n = 0; n < nodes; ++n) {
      std::uint32_t seen = 0;
      for (unsigned place = 1; place <= nodes; ++place) {
        seen = heard[place].frame.Identifier == 0x281 + n ? CO_GET_WORD(&heard[place].frame, 0) : seen;
      }
      CHECK(seen == (cycle >= 2 * n ? 0x100 + cycle - 2 * n : 0));
    }
  }
  for (const auto& member : ring.members) CHECK(member->updates == 6U * nodes - 1);
}

void check_stopped_node_breaks_the_ring(std::uint8_t nodes) {
  Ring ring(nodes);
  ring.line.say(test::frame("000#0202"));
  ring.world.settle();
  ring.members[0]->say(77);
  ring.world.settle();
  CHECK(ring.line.take_texts() == test::Texts{"181#4D000000"});
  CHECK(ring.members[1]->event_in == 0);
  ring.line.say(test::frame("000#0102"));
  ring.world.settle();
  ring.line.take();
  ring.members[0]->say(78);
  ring.world.settle();
  CHECK(ring.members[0]->event_in == 78U + nodes - 1U);
}

}  // namespace

TEST_CASE("PDO network: two and sixteen nodes forward an event without delay and send each PDO once") {
  check_event_goes_round(2);
  check_event_goes_round(16);
}

TEST_CASE("PDO network: synchronous PDOs of two and sixteen nodes are sampled and applied together each cycle [X3]") {
  check_synchronous_shift(2);
  check_synchronous_shift(16);
}

TEST_CASE("PDO network: a stopped node neither receives nor sends PDOs until it is started again [N3]") {
  check_stopped_node_breaks_the_ring(2);
  check_stopped_node_breaks_the_ring(16);
}

TEST_CASE("PDO network: all nodes send at once: no frame is lost, and no node consumes unrelated frames") {
  Ring ring(16);
  ring.pass_on = false;
  for (std::uint32_t round = 1; round <= 50; ++round) {
    for (const auto& member : ring.members) {
      CODictWrLong(&member->device->node.Dict, CO_DEV(0x2001, 0), round * 100 + member->device->node.NodeId);
    }
    ring.world.pass(1ms);
    for (std::size_t n = 0; n < ring.members.size(); ++n) {
      const std::size_t before = n == 0 ? ring.members.size() : n;
      CHECK(ring.members[n]->event_in == round * 100 + before);
    }
  }
  for (const auto& member : ring.members) {
    CHECK(member->device->counters().Dropped == 0);
    CHECK(member->device->counters().Unclaimed == 0);
    CHECK(member->device->counters().Malformed == 0);
    CHECK(member->device->port.lost() == 0);
  }
}

#endif
