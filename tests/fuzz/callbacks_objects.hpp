// SPDX-License-Identifier: Apache-2.0
/// \file callbacks_objects.hpp
/// Objects of the services that node_objects.hpp lacks: multiplex PDOs, recorder, parameter groups, LSS and
/// commands; and all callbacks, which call fuzz::call_api().
#pragma once

#include <cstdint>
#include <vector>

#include "co_core.h"
#include "fuzz/node_objects.hpp"

namespace fuzz {

void call_api();  ///< calls API functions; defined by the fuzz target

struct ServiceObjects {
  ServiceObjects();

  std::uint32_t scan[2] = {CO_MPDO_SCAN(3, 0x2000, 0), CO_MPDO_SCAN(1, 0x2200, 0)};
  std::uint64_t dispatch[2] = {CO_MPDO_DISPATCH(2, 0x2000, 0, 0x2000, 0, 9),
                               CO_MPDO_DISPATCH(1, 0x2200, 0, 0x3000, 0, 9)};
  CO_RECORDER_POINT points[2][4] = {};
  CO_RECORDER recorder[2] = {};  // the second one has no entries
  std::uint8_t recorder_enable = 1;
  std::uint32_t stored[2] = {1, 2};
  std::uint32_t defaults[2] = {3, 4};
  std::uint32_t verify[2] = {5, 6};
  CO_PARA all_groups = {0, 0, nullptr, nullptr, CO_RESET_NODE, nullptr, CO_PARA___E};
  CO_PARA group[2] = {
      {0, sizeof stored[0], &stored[0], &defaults[0], CO_RESET_COM, nullptr, CO_PARA___E},
      {128, sizeof stored[1], &stored[1], &defaults[1], CO_RESET_NODE, nullptr, CO_PARA__AE},
  };
  std::uint8_t command_memory[32] = {};
  std::uint8_t reply_memory[16] = {};
  CO_OS_COMMAND command{};
  std::uint8_t out_memory[8] = {};
  std::uint8_t err_memory[8] = {};
  CO_OS_PROMPT prompt{};
};

extern const CO_CALLBACKS callbacks;  ///< for CO_NODE_EXT.Callbacks; the C functions do the same

/// Returns the dictionary of node_objects.hpp, with enabled PDOs, and the objects of these services.
std::vector<CO_OBJ> callbacks_dictionary(Objects& objects, ServiceObjects& services);

}  // namespace fuzz
