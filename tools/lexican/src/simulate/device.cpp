// SPDX-License-Identifier: Apache-2.0
#include "simulate/device.hpp"

#include <algorithm>

namespace lexican::simulate {

const CO_CALLBACKS Device::callbacks = [] {
  CO_CALLBACKS functions{};
  functions.ModeChange = [](CO_NODE*, void* user, CO_MODE mode) {
    Events& events = static_cast<Device*>(user)->events_;
    events.was_reset = events.was_reset || mode == CO_INIT;
    events.is_separated = events.is_separated || mode == CO_STOP;
  };
  functions.HbConsEvent = [](CO_NODE*, void* user, std::uint8_t) {
    static_cast<Device*>(user)->events_.is_separated = true;
  };
  functions.LifeGuardEvent = [](CO_NODE*, void* user, bool occurred) {
    Events& events = static_cast<Device*>(user)->events_;
    events.is_separated = events.is_separated || occurred;
  };
  functions.PdoUpdate = [](CO_NODE*, void* user, CO_RPDO*) {
    const auto& device = *static_cast<Device*>(user);
    if (device.pdo_written_) {
      device.pdo_written_();
    }
  };
  return functions;
}();

Device::Device(const describe::Description& description, const std::string& file, const DeviceSetup& setup)
    : description_(description), dictionary_(*description.device(), file), setup_(setup) {
  if (setup_.serial != 0) {
    dictionary_.set_number(0x1018, 4, setup_.serial);
  }
}

std::string Device::start() {
  const std::uint32_t size = dictionary_.storage_size();
  if (!setup_.storage.empty() && !file_.open(setup_.storage, size)) {
    return file_.error();
  }
  if (setup_.storage.empty()) {
    memory_.resize(size);
    ram_ = {memory_.data(), size};
    CONvmRamClear(&ram_);
  }
  make_node();
  fault_ = node_->error_text();
  CONodeStart(&node_->stack());
  return CONmtGetMode(&node_->stack().Nmt) == CO_INVALID ? "the dictionary cannot be used: " + fault_ : std::string();
}

void Device::make_node() {
  const Memory memory = setup_.storage.empty() ? Memory{&RamNvmDriver, &ram_} : Memory{&co::FileNvmDriver, &file_};
  const bool has_emergency = description_.device()->find(0x1014, 0) != nullptr;
  node_ = std::make_unique<Node>(Node::Setup{setup_.node_id,
                                             setup_.can,
                                             setup_.timer,
                                             dictionary_.table(),
                                             {},
                                             false,
                                             has_emergency ? Errors{&emergency_, 1} : Errors{nullptr, 0},
                                             memory,
                                             &callbacks,
                                             this});
}

bool Device::put(std::uint16_t index, std::uint8_t sub_index, const Bytes& value, bool is_event) {
  CO_OBJ* const object = CODictFind(&node_->stack().Dict, CO_DEV(index, sub_index));
  if (object == nullptr || !dictionary_.write(*object, node_->stack(), value)) {
    return false;
  }
  if (is_event) {
    COTPdoTrigObj(node_->stack().TPdo, object);
  }
  return true;
}

std::optional<Bytes> Device::get(std::uint16_t index, std::uint8_t sub_index) {
  CO_OBJ* const object = CODictFind(&node_->stack().Dict, CO_DEV(index, sub_index));
  return object != nullptr ? dictionary_.read(*object, node_->stack()) : std::nullopt;
}

void Device::raise(std::uint16_t code) {
  struct Class {
    std::uint8_t code;  ///< the upper 4 bits of the error code
    std::uint8_t reg;
  };
  constexpr Class classes[] = {{2, CO_EMCY_REG_CURRENT},
                               {3, CO_EMCY_REG_VOLTAGE},
                               {4, CO_EMCY_REG_TEMP},
                               {8, CO_EMCY_REG_COM},
                               {15, CO_EMCY_REG_MANUFACTURER}};
  COEmcyClr(&node_->stack().Emcy, 0);
  const std::uint16_t axis_codes = 0x8600;  // of CiA 402: positioning controller
  if ((code & 0xFF00) == axis_codes) {
    emergency_ = {CO_EMCY_REG_PROFILE, code};
    COEmcySet(&node_->stack().Emcy, 0, nullptr);
    return;
  }
  const auto* const found =
      std::find_if(std::begin(classes), std::end(classes), [&](const Class& row) { return row.code == code >> 12; });
  emergency_ = {found != std::end(classes) ? found->reg : std::uint8_t{CO_EMCY_REG_GENERAL}, code};
  COEmcySet(&node_->stack().Emcy, 0, nullptr);
}

void Device::clear() { COEmcyClr(&node_->stack().Emcy, 0); }

void Device::power_cycle() {
  node_.reset();
  make_node();
  events_.was_reset = true;
  CONodeStart(&node_->stack());
}

}  // namespace lexican::simulate
