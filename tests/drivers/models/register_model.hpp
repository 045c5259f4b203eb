// SPDX-License-Identifier: Apache-2.0
/// \file register_model.hpp
/// Dispatch of lexican_model_read() and lexican_model_write() to models, and the faults that the accesses cause.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lexican_model.h"

namespace test {

/// An access that the reference manual forbids, or a use of a function that the model does not have.
struct RegisterFault {
  std::uintptr_t address = 0;
  bool is_write = false;
  std::uint32_t value = 0;  ///< written value, or 0
  std::string reason;
};

/// Registers at a range of addresses. The ranges of the models that exist at one time do not overlap.
class RegisterModel {
 public:
  RegisterModel(std::uintptr_t address, std::size_t bytes);
  virtual ~RegisterModel();
  RegisterModel(const RegisterModel&) = delete;
  RegisterModel& operator=(const RegisterModel&) = delete;

  std::uintptr_t address() const { return address_; }
  bool holds(std::uintptr_t address) const { return address >= address_ && address - address_ < bytes_; }

  /// Performs an access of the driver: counts it, calls on_access, checks the alignment.
  std::uint32_t read(std::uintptr_t address);
  void write(std::uintptr_t address, std::uint32_t value);

  const std::vector<RegisterFault>& faults() const { return faults_; }
  void clear_faults() { faults_.clear(); }
  /// Returns the reasons of all faults, one on each line, for messages of tests.
  std::string fault_text() const;

  std::uint64_t reads() const { return reads_; }
  std::uint64_t writes() const { return writes_; }

  /// Called before each access of the driver, e.g. to run its interrupt function between two accesses.
  std::function<void()> on_access;

 protected:
  virtual std::uint32_t read_register(std::uint32_t offset) = 0;
  virtual void write_register(std::uint32_t offset, std::uint32_t value) = 0;
  /// Called before each access, before on_access.
  virtual void before_access() {}
  /// Records a fault of the access that is being performed.
  void fault(const std::string& reason);

 private:
  void begin_access(std::uintptr_t address, bool is_write, std::uint32_t value);

  std::uintptr_t address_;
  std::size_t bytes_;
  RegisterFault access_;  // the access that is being performed, without a reason
  std::vector<RegisterFault> faults_;
  std::uint64_t reads_ = 0;
  std::uint64_t writes_ = 0;
};

/// Accesses to addresses of no model. A test clears them.
std::vector<RegisterFault>& unmatched_accesses();

}  // namespace test
