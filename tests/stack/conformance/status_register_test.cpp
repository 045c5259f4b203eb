// SPDX-License-Identifier: Apache-2.0
// 1002h, manufacturer status register, set by the application. [301:7.5.2.3]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

struct Status {
  explicit Status(std::uint32_t flags = CO_OBJ____PR_)
      : node(Setup().with({CO_KEY(0x1002, 0, flags), CO_TUNSIGNED32, &value}).may_change(0x1002, 0)) {}
  CO_ERR set(std::uint32_t status) {
    CO_ERR err = CO_ERR_NONE;
    node.call([&] { err = CONodeSetStatus(&node.node, status); });
    return err;
  }
  std::uint32_t value = 0;
  Fixture node;
};

TEST_CASE("1002h: CONodeSetStatus sets the value that an SDO upload and CONodeGetStatus return [O1]") {
  Status device;
  CHECK(CONodeGetStatus(&device.node.node) == 0);
  CHECK(device.set(0x04030201) == CO_ERR_NONE);
  CHECK(device.value == 0x04030201);
  CHECK(CONodeGetStatus(&device.node.node) == 0x04030201);
  device.node.ask("601#4002100000000000", "581#4302100001020304");
}

TEST_CASE("1002h: the network cannot write the status [O1]") {
  Status device;
  device.node.ask("601#2302100001020304", "581#8002100002000106");
  CHECK(device.value == 0);
}

TEST_CASE("1002h: wrong arguments and a missing object are reported [O1]") {
  CHECK(CONodeSetStatus(nullptr, 1) == CO_ERR_BAD_ARG);
  CHECK(CONodeGetStatus(nullptr) == 0);
  CO_NODE fresh{};
  CHECK(CONodeSetStatus(&fresh, 1) == CO_ERR_BAD_ARG);
  CHECK(CONodeGetStatus(&fresh) == 0);
  Fixture without;
  CHECK(CONodeSetStatus(&without.node, 1) == CO_ERR_OBJ_NOT_FOUND);
  CHECK(CONodeGetStatus(&without.node) == 0);
}

TEST_CASE("1002h: an object with another width or with flag D is not written [O1]") {
  std::uint16_t narrow = 7;
  Fixture word(Setup().with({CO_KEY(0x1002, 0, CO_OBJ_____R_), CO_TUNSIGNED16, &narrow}));
  CHECK(CONodeSetStatus(&word.node, 1) == CO_ERR_OBJ_SIZE);
  CHECK(narrow == 7);
  Fixture direct(Setup().with({CO_KEY(0x1002, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 5}));
  CHECK(CONodeSetStatus(&direct.node, 1) == CO_ERR_OBJ_ACC);
  CHECK(CONodeGetStatus(&direct.node) == 5);
}

TEST_CASE("1002h: an object in read-only memory is not written [O1]") {
  std::uint32_t value = 9;
  Fixture node(Setup()
                   .with({CO_KEY(0x1002, 0, CO_OBJ_____R_), CO_TUNSIGNED32, &value})
                   .writable([&](const void* address, std::uint32_t) { return address != &value; }));
  CHECK(CONodeSetStatus(&node.node, 1) == CO_ERR_OBJ_ACC);
  CHECK(value == 9);
}

#if CO_TPDO_N > 0

struct MappedStatus {
  explicit MappedStatus(std::uint8_t type, std::uint32_t flags = CO_OBJ____PR_)
      : node(table(type), [&](Setup& setup) {
          setup.with({CO_KEY(0x1002, 0, flags), CO_TUNSIGNED32, &value}).may_change(0x1002, 0);
        }) {
    node.start();
  }
  static PdoTable table(std::uint8_t type) {
    PdoTable table;
    table.tpdo[0].on(0x40000181, type, {0x10020020});
    return table;
  }
  void set(std::uint32_t status) {
    node.call([&] { CHECK(CONodeSetStatus(&node.node, status) == CO_ERR_NONE); });
  }
  std::uint32_t value = 0;
  PdoNode node;
};

TEST_CASE("1002h: a change sends the event-driven TPDO that maps it and the same value does not [O1]") {
  for (const std::uint8_t type : {std::uint8_t{254}, std::uint8_t{255}}) {
    MappedStatus device(type);
    device.set(0x12345678);
    device.node.tx("181#78563412");
    device.set(0x12345678);
    device.node.silent();
    device.set(0);
    device.node.tx("181#00000000");
  }
}

TEST_CASE("1002h: with flag A a change sends the TPDO once [O1]") {
  MappedStatus device(255, CO_OBJ___APR_);
  device.set(1);
  device.node.tx("181#01000000");
}

TEST_CASE("1002h: a change sends no TPDO outside of Operational and the value is in the next one [O1]") {
  MappedStatus device(255);
  device.node.rx("000#8001");
  device.set(2);
  device.node.silent();
  device.node.start();
  device.set(3);
  device.node.tx("181#03000000");
}

#endif

}  // namespace
