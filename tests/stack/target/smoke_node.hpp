// SPDX-License-Identifier: Apache-2.0
/// \file smoke_node.hpp
/// A node with its dictionary, and drivers that store frames and time in memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "co_core.h"

namespace smoke {

class Node {
 public:
  void start();  ///< initialises and starts the node with node-ID 1

  void receive(const CO_IF_FRM& frm);
  void pass(std::uint32_t ms);
  bool take(CO_IF_FRM& frm);  ///< returns the next frame that the node has sent; false: none
  void set_error(std::uint8_t error);
  void clear_error(std::uint8_t error);

 private:
  struct Drivers;
  friend struct Drivers;

  void process();

  static constexpr std::size_t places = 16;

  CO_NODE node_;
  CO_NODE_EXT ext_;
  std::uint8_t sdo_buffer_[CO_SSDO_N * CO_SDO_BUF_BYTE];
  CO_IF_FRM received_;
  bool has_received_;
  CO_IF_FRM sent_[places];
  std::size_t sent_num_;
  std::size_t taken_num_;
  std::uint32_t now_;
};

}  // namespace smoke
