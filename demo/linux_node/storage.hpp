// SPDX-License-Identifier: Apache-2.0
/// \file storage.hpp
/// Memory for the settings of the clock: RAM, until a file is opened.
#pragma once

#include <array>
#include <string>

#include "co_nvm_ram.h"
#include "file_nvm.hpp"
#include "host/host.hpp"
#include "linux_node/clock.hpp"

namespace lexican::demo {

class Storage {
 public:
  Storage();
  ~Storage();
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;

  /// Opens a file. Returns its fault as text; empty: none.
  std::string open(const std::string& path);
  /// Like open(), with a new temporary file, which the destructor removes.
  std::string open_temporary();

  Memory memory();

 private:
  std::array<std::uint8_t, clock_memory_size> bytes_{};
  CO_NVM_RAM ram_{bytes_.data(), clock_memory_size};
  co::FileNvm file_;
  std::string temporary_;  // path, empty: none
};

}  // namespace lexican::demo
