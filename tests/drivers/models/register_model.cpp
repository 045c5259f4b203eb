// SPDX-License-Identifier: Apache-2.0
#include "register_model.hpp"

#include <algorithm>
#include <stdexcept>

namespace test {
namespace {

std::vector<RegisterModel*>& models() {
  static std::vector<RegisterModel*> all;
  return all;
}

RegisterModel* model_at(std::uintptr_t address) {
  const auto found =
      std::find_if(models().begin(), models().end(), [&](const RegisterModel* m) { return m->holds(address); });
  return found == models().end() ? nullptr : *found;
}

}  // namespace

std::vector<RegisterFault>& unmatched_accesses() {
  static std::vector<RegisterFault> all;
  return all;
}

RegisterModel::RegisterModel(std::uintptr_t address, std::size_t bytes) : address_(address), bytes_(bytes) {
  if (model_at(address) != nullptr || model_at(address + bytes - 1) != nullptr) {
    throw std::logic_error("the address range of a register model is used by another model");
  }
  models().push_back(this);
}

RegisterModel::~RegisterModel() { models().erase(std::find(models().begin(), models().end(), this)); }

std::string RegisterModel::fault_text() const {
  std::string text;
  for (const RegisterFault& one : faults_) {
    text += one.reason + "\n";
  }
  return text;
}

void RegisterModel::fault(const std::string& reason) {
  faults_.push_back(access_);
  faults_.back().reason = reason;
}

void RegisterModel::begin_access(std::uintptr_t address, bool is_write, std::uint32_t value) {
  before_access();
  if (on_access) {
    on_access();
  }
  access_ = {address, is_write, value, {}};
}

std::uint32_t RegisterModel::read(std::uintptr_t address) {
  ++reads_;
  begin_access(address, false, 0);
  if (address % 4 != 0) {
    fault("unaligned access");
    return 0;
  }
  return read_register(static_cast<std::uint32_t>(address - address_));
}

void RegisterModel::write(std::uintptr_t address, std::uint32_t value) {
  ++writes_;
  begin_access(address, true, value);
  if (address % 4 != 0) {
    fault("unaligned access");
    return;
  }
  write_register(static_cast<std::uint32_t>(address - address_), value);
}

}  // namespace test

std::uint32_t lexican_model_read(std::uintptr_t address) {
  test::RegisterModel* const model = test::model_at(address);
  if (model == nullptr) {
    test::unmatched_accesses().push_back({address, false, 0, "read from an address of no model"});
    return 0;
  }
  return model->read(address);
}

void lexican_model_write(std::uintptr_t address, std::uint32_t value) {
  test::RegisterModel* const model = test::model_at(address);
  if (model == nullptr) {
    test::unmatched_accesses().push_back({address, true, value, "write to an address of no model"});
    return;
  }
  model->write(address, value);
}
