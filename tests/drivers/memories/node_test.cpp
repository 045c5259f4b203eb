// SPDX-License-Identifier: Apache-2.0
// The node of demo/memory/node.c with each memory of the examples: "save" and "load" by SDO, power off and on.
#include <doctest/doctest.h>

#include <cstring>

#include "demo/memory/memory.h"
#include "demo/memory/node.h"
#include "pins.hpp"
#include "stm32_flash.hpp"

#if USE_PARA

namespace {

using namespace test;

// The bus: frames to the node, and the last frame that it has sent.
struct Bus {
  std::vector<CO_IF_FRM> to_node;
  CO_IF_FRM sent{};
};

const CO_IF_CAN_DRV_EX bus_driver = {[](void*) {},
                                     [](void*, std::uint32_t) {},
                                     [](void* ctx, CO_IF_FRM* frame) {
                                       Bus& bus = *static_cast<Bus*>(ctx);
                                       if (bus.to_node.empty()) {
                                         return std::int16_t{0};
                                       }
                                       *frame = bus.to_node.back();
                                       bus.to_node.pop_back();
                                       return static_cast<std::int16_t>(sizeof *frame);
                                     },
                                     [](void* ctx, const CO_IF_FRM* frame) {
                                       static_cast<Bus*>(ctx)->sent = *frame;
                                       return static_cast<std::int16_t>(sizeof *frame);
                                     },
                                     [](void*) {},
                                     [](void*) {},
                                     nullptr,
                                     nullptr};
const CO_IF_TIMER_DRV_EX no_timer = {[](void*, std::uint32_t) {}, [](void*) { return std::uint32_t{0}; }, nullptr};

class Device {
 public:
  Device(const CO_IF_NVM_DRV_EX& memory, const void* context) : memory_(memory), context_(context) { start(); }

  // Power on.
  void start() {
    drivers_ = {};
    drivers_.Can = &bus_driver;
    drivers_.CanCtx = &bus_;
    drivers_.Timer = &no_timer;
    node_ = StartNode(&drivers_, &memory_, context_);
  }

  // Sends an SDO request. Returns the bytes of the response as a number, the first one in the lowest bits.
  std::uint64_t ask(std::uint8_t command, std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
    CO_IF_FRM frame{};
    frame.Identifier = 0x605;
    frame.DLC = 8;
    const std::uint8_t head[] = {command, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8U),
                                 sub};
    std::memcpy(frame.Data, head, 4);
    std::memcpy(frame.Data + 4, &value, 4);
    bus_.to_node.push_back(frame);
    CONodeProcess(node_);
    std::uint64_t answer = 0;
    std::memcpy(&answer, bus_.sent.Data, 8);
    return answer;
  }

 private:
  const CO_IF_NVM_DRV_EX& memory_;
  const void* context_;
  Bus bus_;
  CO_NODE_EXT drivers_{};
  CO_NODE* node_ = nullptr;
};

void save_and_load(const CO_IF_NVM_DRV_EX& memory, const void* context) {
  Device device(memory, context);
  CHECK(device.ask(0x40, 0x2200, 0, 0) == 0x000000C800220043);  // 200
  CHECK(device.ask(0x23, 0x2200, 0, 300) == 0x0000000000220060);
  CHECK(device.ask(0x23, 0x1010, 1, 0x65766173) == 0x0000000001101060);
  device.start();
  CHECK(device.ask(0x40, 0x2200, 0, 0) == 0x0000012C00220043);  // 300
  CHECK(device.ask(0x23, 0x1011, 1, 0x64616F6C) == 0x0000000001101160);
  device.start();
  CHECK(device.ask(0x40, 0x2200, 0, 0) == 0x000000C800220043);
}

TEST_CASE("examples of memories: a node saves and loads its parameters by SDO in each memory") {
  const std::pair<Family, const CO_FLASH_PAGES*> families[] = {
      {Family::f4, &FlashStm32f4}, {Family::g4, &FlashStm32g4}, {Family::h7, &FlashStm32h7}};
  for (const auto& [family, flash] : families) {
    Stm32Flash model(family, *flash);
    save_and_load(FlashPagesNvmDriver, model.context());
    CHECK(model.is_used_well());
  }
  I2cLines i2c_lines;
  i2c = &i2c_lines;
  save_and_load(EepromI2cNvmDriver, &EepromI2c);
  CHECK(i2c_lines.memory.is_used_well());
  i2c = nullptr;
  SpiLines spi_lines;
  spi = &spi_lines;
  save_and_load(EepromSpiNvmDriver, &EepromSpi);
  CHECK(spi_lines.memory.is_used_well());
  spi = nullptr;
}

}  // namespace

#endif
