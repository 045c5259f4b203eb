// SPDX-License-Identifier: Apache-2.0
/// \file logged_stream.hpp
/// Objects of a test's own whose type functions write down how they are called: "begin down 9", "reset 0", "write 0",
/// "write 7", "end down 0", "end up 05040000". Size is called as often as the stack likes and is not written down.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fixture.hpp"

namespace test {

using Log = std::vector<std::string>;

struct LoggedStream {
  static constexpr std::uint32_t capacity = 2000;

  Log log;
  Bytes data;                  ///< what is there, and what has been written
  bool knows_size = true;      ///< else only when a read has come to the end
  std::uint32_t position = 0;  ///< of the next access
  bool at_end = false;

  /// Each is called instead of success: the answer of the type function. Within, COObjTypeUserSDOAbort() and the like.
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_begin;
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_end;
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_reset;
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_open;   ///< Read or Write of length 0
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_piece;  ///< Read or Write of more

  /// Entries with this behind them. Their types are the same but for what they know of the transfer.
  CO_OBJ extended(std::uint16_t index);  ///< CO_OBJ_TYPE_EX
  CO_OBJ plain(std::uint16_t index);     ///< CO_OBJ_TYPE with Reset
  CO_OBJ value(std::uint16_t index);     ///< CO_OBJ_TYPE without Reset

  Log take_log();  ///< and forgets it
};

}  // namespace test
