// SPDX-License-Identifier: Apache-2.0
// Tests that a parameter group has exactly its old or exactly its new values after a power failure at any step. [T13]
#include <algorithm>
#include <cstring>

#include "support/failing_nvm.hpp"
#include "support/fixture.hpp"

#if USE_PARA

namespace {

using namespace test;
using PartialWrite = FailingNvm::PartialWrite;

struct Values {
  std::uint32_t number;
  std::uint8_t rest[8];
  bool operator==(const Values& other) const { return std::memcmp(this, &other, sizeof *this) == 0; }
};

constexpr Values defaults = {1, {1, 1, 1, 1, 1, 1, 1, 1}};
constexpr Values first = {0xA5A5A5A5, {2, 3, 4, 5, 6, 7, 8, 9}};
constexpr Values second = {0xFFFFFFFF, {0, 0xFF, 0, 0xFF, 0, 0xFF, 0, 0xFF}};
constexpr Values third = {0, {9, 9, 9, 9, 9, 9, 9, 9}};
constexpr Values stray = {0xDEADBEEF, {0xEE, 0xEE, 0xEE, 0xEE, 0xEE, 0xEE, 0xEE, 0xEE}};  // RAM after power-on

const CO_NVM_SHAPE shapes[] = {
    {256, 1, 0},   // EEPROM, FRAM
    {512, 8, 0},   // programmed in words
    {512, 4, 64},  // flash with small pages
    {1024, 16, 128},
};

const CO_NVM_SHAPE& eeprom = shapes[0];
const CO_NVM_SHAPE& small_flash = shapes[2];

std::int16_t no_frame(void*, CO_IF_FRM*) { return 0; }
std::int16_t refuse_frame(void*, const CO_IF_FRM*) { return 0; }
std::uint32_t no_time(void*) { return 0; }
const CO_IF_CAN_DRV_EX no_bus = {
    [](void*) {}, [](void*, std::uint32_t) {}, no_frame, refuse_frame, [](void*) {}, [](void*) {}, nullptr, nullptr};
const CO_IF_TIMER_DRV_EX no_timer = {[](void*, std::uint32_t) {}, no_time, nullptr};

// Variables of the node under test. Only Device::nvm is copied with a Device: boot() sets the others.
Values ram;
std::uint8_t error_register;
CO_PARA group = {0, sizeof(Values), &ram, &defaults, CO_RESET_NODE, nullptr, CO_PARA___E};
CO_OBJ dictionary[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
                       {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register)},
                       {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&group)},
                       {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(1)},
                       CO_OBJ_DICT_ENDMARK};
CO_NODE_EXT ext;
CO_NODE node;

// The node under test with its non-volatile memory, which survives power failures.
struct Device {
  explicit Device(CO_NVM_SHAPE shape) : nvm(shape) {}

  // Restores power and starts the node. Returns the values of the group.
  Values boot(std::uint64_t cut_at = 0, PartialWrite partial_write = PartialWrite::untouched) {
    nvm.power_up();
    nvm.cut_at = cut_at;
    nvm.partial_write = partial_write;
    ram = stray;
    ext = {};
    ext.Size = sizeof ext;
    ext.Can = &no_bus;
    ext.Timer = &no_timer;
    ext.Nvm = &FailingNvm::driver;
    ext.NvmCtx = &nvm;
    CO_NODE_SPEC spec{};
    spec.NodeId = 1;
    spec.Dict = dictionary;
    spec.DictLen = 4;
    spec.TmrFreq = 1000;
    CONodeInitEx(&node, &spec, &ext);
    error = CONodeGetErr(&node);
    return ram;
  }

  CO_ERR save(const Values& values) {
    node.If.NvmCtx = &nvm;
    ram = values;
    return COParaStore(&group, &node);
  }

  CO_ERR restore() {
    node.If.NvmCtx = &nvm;
    return COParaRestore(&group, &node);
  }

  FailingNvm nvm;
  CO_ERR error = CO_ERR_NONE;  // error of the last boot()
};

// A command during which the power fails, and the values of the group after it.
struct Change {
  CO_ERR run(Device& device) const { return values == nullptr ? device.restore() : device.save(*values); }
  [[nodiscard]] const Values& after() const { return values == nullptr ? defaults : *values; }
  const Values* values;  // values to store; null: "load" (restore defaults)
};

const Change store_first{&first};
const Change store_second{&second};
const Change store_third{&third};
const Change load_defaults{nullptr};

constexpr PartialWrite all_partial_writes[] = {PartialWrite::untouched, PartialWrite::half, PartialWrite::garbage,
                                               PartialWrite::done};

// Runs a change with a power failure at each of its steps. Checks that the group then has its old values or those of
// the change, and calls then(device, values found). Returns the number of steps. A step is one byte that is programmed
// or erased.
template <class Function>
std::uint64_t cut_at_each_step(const Device& before, const Values& old, const Change& change,
                               PartialWrite partial_write, Function then) {
  std::uint64_t cuts = 0;
  for (std::uint64_t step = 1;; ++step) {
    Device device = before;
    device.boot();  // the node knows which slot of this memory is the newest
    device.nvm.steps = 0;
    device.nvm.cut_at = step;
    device.nvm.partial_write = partial_write;
    const bool done = change.run(device) == CO_ERR_NONE;
    if (done && !device.nvm.is_off) {
      return cuts;
    }
    ++cuts;
    REQUIRE(device.nvm.is_off);
    REQUIRE_FALSE(device.nvm.misused);
    const Values found = device.boot();
    REQUIRE((found == old || found == change.after()));
    REQUIRE((!done || found == change.after()));
    then(device, found);
  }
}

struct Start {
  const char* name;
  std::vector<Change> changes;
};

const Start starts[] = {
    {"blank", {}},
    {"stored once", {store_first}},
    {"stored twice", {store_first, store_second}},
    {"restored", {store_first, load_defaults}},
};

const Start& stored_once = starts[1];
const Start& stored_twice = starts[2];

const Values& last_of(const Start& start) { return start.changes.empty() ? defaults : start.changes.back().after(); }

// Returns a device on which the changes of \a start are complete.
Device device_after(const CO_NVM_SHAPE& shape, const Start& start) {
  Device device(shape);
  device.boot();
  for (const Change& change : start.changes) {
    REQUIRE(change.run(device) == CO_ERR_NONE);
  }
  REQUIRE(device.boot() == last_of(start));
  return device;
}

TEST_CASE("parameters: after a power failure at any byte of a store a group has its old or its new values [T13]") {
  std::uint64_t cuts = 0;
  for (const CO_NVM_SHAPE& shape : shapes) {
    for (const Start& start : starts) {
      const Device before = device_after(shape, start);
      for (const Change& change : {store_first, store_second, load_defaults}) {
        for (const PartialWrite partial_write : all_partial_writes) {
          CAPTURE(start.name);
          cuts += cut_at_each_step(before, last_of(start), change, partial_write, [](Device&, const Values&) {});
        }
      }
    }
  }
  MESSAGE("cut points: ", cuts);
  CHECK(cuts > 5000);
}

TEST_CASE("parameters: after power failures in two consecutive stores a group has its old or its new values [T13]") {
  std::uint64_t pairs = 0;
  for (const CO_NVM_SHAPE& shape : {eeprom, small_flash}) {
    for (const Start& start : starts) {
      const Device before = device_after(shape, start);
      for (const PartialWrite partial_write : all_partial_writes) {
        cut_at_each_step(before, last_of(start), store_third, partial_write, [&](Device& device, const Values& found) {
          pairs += cut_at_each_step(device, found, store_second, partial_write, [](Device&, const Values&) {});
        });
      }
    }
  }
  MESSAGE("pairs of cut points: ", pairs);
  CHECK(pairs > 50000);
}

TEST_CASE("parameters: after a power failure at any byte of a store the two next stores succeed [T13]") {
  for (const CO_NVM_SHAPE& shape : shapes) {
    const Device before = device_after(shape, stored_twice);
    for (const PartialWrite partial_write : all_partial_writes) {
      cut_at_each_step(before, second, store_third, partial_write, [](Device& device, const Values&) {
        REQUIRE(store_first.run(device) == CO_ERR_NONE);
        REQUIRE(device.boot() == first);
        REQUIRE(store_second.run(device) == CO_ERR_NONE);
        REQUIRE(device.boot() == second);
      });
    }
  }
}

TEST_CASE("parameters: if the memory reports writes that it has not done the store fails and old values remain [T13]") {
  for (const CO_NVM_SHAPE& shape : shapes) {
    const Device before = device_after(shape, stored_twice);
    for (std::uint64_t step = 1; step < 400; ++step) {
      for (const std::uint64_t number : {1U, 3U, 1000U}) {
        Device device = before;
        device.nvm.steps = 0;
        device.nvm.ignore_from = step;
        device.nvm.ignore_to = step + number;
        const CO_ERR err = store_third.run(device);
        const Values found = device.boot();
        REQUIRE(found == (err == CO_ERR_NONE ? third : second));
      }
    }
  }
}

TEST_CASE("parameters: after a flipped bit in a record its values or the previous ones or the defaults are loaded") {
  for (const CO_NVM_SHAPE& shape : shapes) {
    for (const Start& start : {stored_once, stored_twice}) {
      const Device before = device_after(shape, start);
      for (std::size_t bit = 0; bit < before.nvm.bytes.size() * 8; ++bit) {
        Device device = before;
        device.nvm.bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
        const Values found = device.boot();
        const Values& older = start.changes.size() > 1 ? first : defaults;
        REQUIRE((found == last_of(start) || found == older));
        REQUIRE((found == last_of(start) || start.changes.size() > 1 || device.error == CO_ERR_PARA_LOAD));
      }
    }
  }
}

TEST_CASE("parameters: after a failing or corrupted read at power-on a group has stored values or defaults") {
  const Device before = device_after(eeprom, stored_twice);
  for (std::uint64_t read = 1; read < 40; ++read) {
    for (const bool is_corrupted : {false, true}) {
      Device device = before;
      device.nvm.reads = 0;
      (is_corrupted ? device.nvm.corrupt_read : device.nvm.refuse_read) = read;
      const Values found = device.boot();
      REQUIRE((found == second || found == first || found == defaults));
    }
  }
}

}  // namespace

#endif
