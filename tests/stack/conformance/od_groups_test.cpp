// SPDX-License-Identifier: Apache-2.0
// co_od.h: parameter groups that are stored and restored by name, atomically, like by 1010h and 1011h. [301:7.5.2.13]
#include <cstring>

#include "support/failing_nvm.hpp"
#include "support/od.hpp"

#if USE_OD && USE_PARA

namespace {

using namespace test;

struct Communication {
  std::uint32_t number;
  std::uint16_t heartbeat;
};

struct Application {
  std::uint32_t limit;
  std::uint8_t text[8];
  std::uint8_t bytes[8];
};

// A device with the groups "PERSIST_COMM" (sub-index 2), "PERSIST_APP" (3), one without a name (4), one that is stored
// autonomously (5), and an object in no group.
struct Device {
  CO_DATA data(const void* address) { return reinterpret_cast<std::uintptr_t>(address); }

  Setup basic() {
    return Setup()
        .only_small()
        .nvm(FailingNvm::driver, &nvm)
        .may_change(0x2300, 1)
        .may_change(0x2300, 2)
        .may_change(0x2300, 3)
        .may_change(0x2301, 1)
        .may_change(0x2301, 2)
        .with({CO_KEY(0x2300, 1, CO_OBJ_____RW), CO_TUNSIGNED32, data(&communication.number)})
        .with({CO_KEY(0x2300, 2, CO_OBJ_____RW), CO_TUNSIGNED16, data(&communication.heartbeat)})
        .with({CO_KEY(0x2300, 3, CO_OBJ_____RW), CO_TUNSIGNED32, data(&application.limit)})
        .with({CO_KEY(0x2300, 4, CO_OBJ_____RW), CO_TUNSIGNED32, data(&stray)})
        .with({CO_KEY(0x2300, 5, CO_OBJ_D___RW), CO_TUNSIGNED32, 5})
        .with({CO_KEY(0x2301, 1, CO_OBJ_____RW), CO_TVISIBLE_STRING, data(&text)})
        .with({CO_KEY(0x2301, 2, CO_OBJ_____RW), CO_TDOMAIN, data(&domain)});
  }
  Setup setup() {
    Setup all = basic();
    const CO_PARA* groups[] = {&everything, &first, &second, &nameless, &autonomous};
    for (std::uint8_t sub = 0; sub <= 5; ++sub) {
      const CO_DATA named = sub == 0 ? CO_DATA(5) : data(groups[sub - 1]);
      all.with({CO_KEY(0x1010, sub, sub == 0 ? CO_OBJ_D___R_ : CO_OBJ_____RW), CO_TPARA_STORE, named});
      all.with({CO_KEY(0x1011, sub, sub == 0 ? CO_OBJ_D___R_ : CO_OBJ_____RW), CO_TPARA_RESTORE, named});
    }
    return all;
  }
  Setup single() {
    return basic()
        .with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, data(&first)})
        .with({CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, data(&first)});
  }

  FailingNvm nvm{{2048, 1, 0}};
  Communication communication{};
  Application application{};
  Communication communication_defaults = {10, 100};
  Application application_defaults = {20, "default", {1, 2, 3, 4, 5, 6, 7, 8}};
  std::uint32_t stray = 0;
  std::uint32_t others[2] = {};
  std::uint32_t zero = 0;
  CO_OBJ_STR_RW text{0, 7, 8, application.text};
  CO_OBJ_DOM domain{0, 5, application.bytes};
  CO_PARA everything = {0, 0, nullptr, nullptr, CO_RESET_NODE, nullptr, CO_PARA___E};
  CO_PARA first = OD_GROUP("PERSIST_COMM", communication, communication_defaults, 0, CO_RESET_COM, CO_PARA___E);
  CO_PARA second = OD_GROUP("PERSIST_APP", application, application_defaults, 200, CO_RESET_NODE, CO_PARA___E);
  CO_PARA nameless = OD_GROUP(nullptr, others[0], zero, 400, CO_RESET_NODE, CO_PARA___E);
  CO_PARA autonomous = OD_GROUP("AUTO", others[1], zero, 600, CO_RESET_NODE, CO_PARA__A_);
};

ODR_t store(Fixture& node, unsigned group) {
  ODR_t result = ODR_GENERAL;
  node.call([&] { result = OD_storeGroup(&node.od, static_cast<std::uint8_t>(group)); });
  return result;
}
ODR_t restore(Fixture& node, unsigned group) {
  ODR_t result = ODR_GENERAL;
  node.call([&] { result = OD_restoreGroup(&node.od, static_cast<std::uint8_t>(group)); });
  return result;
}

TEST_CASE("OD groups: a name is found at its sub-index of 1010h and returned for it") {
  Device device;
  Fixture node(device.setup());
  CHECK(OD_findStorageGroup(&node.od, "PERSIST_COMM") == 2);
  CHECK(OD_findStorageGroup(&node.od, "PERSIST_APP") == 3);
  for (const char* name : {"PERSIST", "PERSIST_COMMON", "persist_comm", "", "RAM"}) {
    CAPTURE(name);
    CHECK(OD_findStorageGroup(&node.od, name) == 0);
  }
  CHECK(std::strcmp(OD_getStorageName(&node.od, 3), "PERSIST_APP") == 0);
  for (const unsigned group : {0U, 1U, 4U, 6U, 127U, 128U, 255U}) {
    CAPTURE(group);
    CHECK(OD_getStorageName(&node.od, static_cast<std::uint8_t>(group)) == nullptr);
  }
}

TEST_CASE("OD groups: a group whose Ident is null has no name and does not hide the others") {
  Device device;
  for (CO_PARA* const group : {&device.everything, &device.first, &device.nameless}) group->Ident = nullptr;
  Fixture node(device.setup());
  for (const char* name : {"", "PERSIST_COMM", "(null)"}) {
    CAPTURE(name);
    CHECK(OD_findStorageGroup(&node.od, name) == 0);
  }
  CHECK(OD_findStorageGroup(&node.od, "PERSIST_APP") == 3);
  CHECK(OD_findStorageGroup(&node.od, "AUTO") == 5);
  CHECK(OD_findStorageGroup(&node.od, nullptr) == 0);
  CHECK(OD_getStorageName(&node.od, 2) == nullptr);
}

TEST_CASE("OD groups: an object belongs to the group that contains its memory; other objects are not stored") {
  Device device;
  Fixture node(device.setup());
  const auto group_of = [&](std::uint16_t index, std::uint8_t sub) {
    return unsigned{OD_getStorageGroup(OD_find(&node.od, index), sub)};
  };
  CHECK(group_of(0x2300, 1) == 2);
  CHECK(group_of(0x2300, 2) == 2);
  CHECK(group_of(0x2300, 3) == 3);
  CHECK(group_of(0x2301, 1) == 3);
  CHECK(group_of(0x2301, 2) == 3);
  CHECK(group_of(0x2300, 4) == 0);
  CHECK(group_of(0x2300, 5) == 0);
  CHECK(group_of(0x2300, 9) == 0);
  CHECK(group_of(0x3000, 0) == 0);
}

TEST_CASE("OD groups: sub-index 1 alone is a group; with other sub-indices no object belongs to it") {
  Device device;
  {
    Fixture node(device.single());
    CHECK(OD_findStorageGroup(&node.od, "PERSIST_COMM") == 1);
    CHECK(OD_getStorageGroup(OD_find(&node.od, 0x2300), 1) == 1);
    CHECK(OD_getStorageGroup(OD_find(&node.od, 0x2300), 3) == 0);
    CHECK(store(node, 1) == ODR_OK);
  }
  device.everything = device.second;
  Fixture node(device.setup());
  CHECK(OD_getStorageGroup(OD_find(&node.od, 0x2300), 3) == 3);
}

TEST_CASE("OD groups: OD_storeGroup stores like \"save\"; values of other groups are not stored") {
  Device device;
  {
    Fixture node(device.setup());
    CHECK(device.communication.number == 10);
    device.communication.number = 11;
    device.application.limit = 21;
    CHECK(store(node, OD_findStorageGroup(&node.od, "PERSIST_COMM")) == ODR_OK);
  }
  device.communication = {};
  device.application = {};
  Fixture node(device.setup());
  CHECK(device.communication.number == 11);
  CHECK(device.communication.heartbeat == 100);
  CHECK(device.application.limit == 20);
}

TEST_CASE("OD groups: group 1 stores and restores all, like the SDO commands") {
  Device device;
  {
    Fixture node(device.setup());
    device.communication.number = 11;
    device.application.limit = 21;
    CHECK(store(node, 1) == ODR_OK);
  }
  device.communication = {};
  device.application = {};
  Fixture node(device.setup());
  CHECK(device.communication.number == 11);
  CHECK(device.application.limit == 21);
  CHECK(restore(node, 1) == ODR_OK);
  CHECK(device.application.limit == 21);
  node.rx("000#8101");
  node.tx("701#00");
  CHECK(device.communication.number == 10);
  CHECK(device.application.limit == 20);
}

TEST_CASE("OD groups: OD_restoreGroup works like \"load\": the defaults apply after the reset of the group's type") {
  Device device;
  Fixture node(device.setup());
  device.communication.number = 11;
  device.application.limit = 21;
  CHECK(store(node, 1) == ODR_OK);
  CHECK(restore(node, 3) == ODR_OK);
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(device.communication.number == 11);
  CHECK(device.application.limit == 21);
  node.rx("000#8101");
  node.tx("701#00");
  CHECK(device.communication.number == 11);
  CHECK(device.application.limit == 20);
}

TEST_CASE("OD groups: failures have a result: no such group, not stored on command, memory failure") {
  Device device;
  Fixture node(device.setup());
  for (const unsigned group : {0U, 6U, 255U}) {
    CHECK(store(node, group) == ODR_SUB_NOT_EXIST);
    CHECK(restore(node, group) == ODR_SUB_NOT_EXIST);
  }
  CHECK(store(node, 5) == ODR_DATA_TRANSF);
  CHECK(restore(node, 5) == ODR_DATA_TRANSF);
  device.nvm.ignore_from = 1;
  device.nvm.ignore_to = 100000;
  device.communication.number = 11;
  CHECK(store(node, 2) == ODR_HW);
  device.nvm.ignore_to = 0;
}

TEST_CASE("OD groups: without an index, a name or an entry of the dictionary there is no group") {
  OD_t none{};
  CHECK(OD_findStorageGroup(nullptr, "PERSIST_COMM") == 0);
  CHECK(OD_findStorageGroup(&none, "PERSIST_COMM") == 0);
  CHECK(OD_getStorageName(nullptr, 1) == nullptr);
  CHECK(OD_getStorageName(&none, 1) == nullptr);
  CHECK(OD_storeGroup(nullptr, 1) == ODR_SUB_NOT_EXIST);
  CHECK(OD_storeGroup(&none, 1) == ODR_SUB_NOT_EXIST);
  CHECK(OD_restoreGroup(nullptr, 1) == ODR_SUB_NOT_EXIST);
  Device device;
  Fixture node(device.setup());
  CHECK(OD_findStorageGroup(&node.od, nullptr) == 0);
  CHECK(OD_getStorageGroup(nullptr, 0) == 0);
  OD_obj_var_t variable{};
  variable.dataOrig = &device.communication;
  variable.dataLength = 4;
  OD_entry_t memory{};
  memory.odObjectType = ODT_VAR;
  memory.odObject = &variable;
  CHECK(OD_getStorageGroup(&memory, 0) == 0);
}

TEST_CASE("OD groups: a dictionary that the node does not use is not stored") {
  Device device;
  Fixture node(device.setup());
  static OD_entry_t list[8];
  OD_t other{};
  CO_OBJ table[] = {{CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, device.data(&device.first)},
                    {CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, device.data(&device.first)},
                    CO_OBJ_DICT_ENDMARK};
  REQUIRE(OD_init(&other, list, 8, &node.node, table, 2) == ODR_OK);
  CHECK(OD_findStorageGroup(&other, "PERSIST_COMM") == 1);
  CHECK(OD_storeGroup(&other, 1) == ODR_OD_MISSING);
  CHECK(device.nvm.steps == 0);
}

// Checks the values that a device finds at its next start after a power failure at each step of storing.
TEST_CASE("OD groups: power off at every byte of OD_storeGroup and OD_restoreGroup gives old or new values") {
  std::uint64_t cuts = 0;
  for (const bool restores : {false, true}) {
    for (const FailingNvm::PartialWrite partial_write :
         {FailingNvm::PartialWrite::untouched, FailingNvm::PartialWrite::half, FailingNvm::PartialWrite::garbage,
          FailingNvm::PartialWrite::done}) {
      bool done = false;
      for (std::uint64_t step = 1; !done; ++step) {
        Device device;
        {
          Fixture node(device.setup());
          device.application = {21, "stored", {9, 9, 9, 9, 9}};
          REQUIRE(store(node, 3) == ODR_OK);
          device.application = {22, "newer", {7, 7, 7, 7, 7}};
          device.nvm.steps = 0;
          device.nvm.cut_at = step;
          device.nvm.partial_write = partial_write;
          const ODR_t result = restores ? restore(node, 3) : store(node, 3);
          done = !device.nvm.is_off;
          REQUIRE((!done || result == ODR_OK));
        }
        device.nvm.power_up();
        device.application = {};
        const Fixture node(device.setup());
        const Application after = restores ? device.application_defaults : Application{22, "newer", {7, 7, 7, 7, 7}};
        const Application before = {21, "stored", {9, 9, 9, 9, 9}};
        const bool is_new = std::memcmp(&device.application, &after, sizeof after) == 0;
        REQUIRE((is_new || std::memcmp(&device.application, &before, sizeof before) == 0));
        REQUIRE((!done || is_new));
        ++cuts;
      }
    }
  }
  CHECK(cuts > 100);
}

}  // namespace

#endif
