// SPDX-License-Identifier: Apache-2.0
/// \file logged_stream.hpp
/// Objects of application types whose type functions log their calls: "begin down 9", "reset 0", "write 0", "write 7",
/// "end down 0", "end up 05040000". Calls of Size are not logged, because their number is not specified.
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
  Bytes data;                  ///< value of the object
  bool knows_size = true;      ///< false: the size is known only after a read has reached the end
  std::uint32_t position = 0;  ///< of the next access
  bool at_end = false;         ///< a read has reached the end

  /// Return the results of the type functions; empty: CO_ERR_NONE. They may call COObjTypeUserSDOAbort() and the like.
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_begin;
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_end;
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_reset;
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_open;   ///< Read or Write of length 0
  std::function<CO_ERR(CO_OBJ*, CO_NODE*)> on_piece;  ///< Read or Write of more

  /// Return an entry for this stream. The types differ only in the functions for the transfer that they have.
  CO_OBJ extended(std::uint16_t index);  ///< CO_OBJ_TYPE_EX
  CO_OBJ plain(std::uint16_t index);     ///< CO_OBJ_TYPE with Reset
  CO_OBJ value(std::uint16_t index);     ///< CO_OBJ_TYPE without Reset

  Log take_log();  ///< returns the log and clears it
};

}  // namespace test
