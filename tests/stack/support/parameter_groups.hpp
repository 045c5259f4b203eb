// SPDX-License-Identifier: Apache-2.0
/// \file parameter_groups.hpp
/// A device with two parameter groups of equal size, 1010h:2 (with 2300h:1) and 1010h:3 (with 2300h:2), and its
/// non-volatile memory, which outlives each of its nodes.
#pragma once

#include <string>

#include "failing_nvm.hpp"
#include "fixture.hpp"

#if USE_PARA
namespace test {

struct GroupDevice {
  struct Values {
    std::uint32_t number;
    std::uint32_t other;
  };

  GroupDevice() = default;
  explicit GroupDevice(CO_NVM_SHAPE shape) : nvm(shape) {}

  static CO_DATA data(const void* address) { return reinterpret_cast<std::uintptr_t>(address); }

  Setup setup() {
    const CO_PARA* const groups[] = {&all, &first, &second};
    Setup setup = Setup().only_small().may_change(0x2300, 1).may_change(0x2300, 2).nvm(FailingNvm::driver, &nvm);
    setup.with({CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TPARA_STORE, 3});
    setup.with({CO_KEY(0x1011, 0, CO_OBJ_D___R_), CO_TPARA_RESTORE, 3});
    for (std::uint8_t sub = 1; sub <= 3; ++sub) {
      setup.with({CO_KEY(0x1010, sub, CO_OBJ_____RW), CO_TPARA_STORE, data(groups[sub - 1])});
      setup.with({CO_KEY(0x1011, sub, CO_OBJ_____RW), CO_TPARA_RESTORE, data(groups[sub - 1])});
    }
    setup.with({CO_KEY(0x2300, 1, CO_OBJ_____RW), CO_TUNSIGNED32, data(&ram[0].number)});
    setup.with({CO_KEY(0x2300, 2, CO_OBJ_____RW), CO_TUNSIGNED32, data(&ram[1].number)});
    return setup;
  }

  FailingNvm nvm{{1024, 1, 0}};
  Values ram[2] = {};
  Values defaults[2] = {{10, 1}, {20, 2}};
  CO_PARA all = {0, 0, nullptr, nullptr, CO_RESET_NODE, nullptr, CO_PARA___E};
  CO_PARA first = {0, sizeof(Values), &ram[0], &defaults[0], CO_RESET_COM, nullptr, CO_PARA___E};
  CO_PARA second = {100, sizeof(Values), &ram[1], &defaults[1], CO_RESET_NODE, nullptr, CO_PARA___E};
};

}  // namespace test
#endif
