// SPDX-License-Identifier: Apache-2.0
/// \file emcy_fixture.hpp
/// A node with a table of application errors and the EMCY objects 1003h, 1014h and 1015h.
#pragma once

#include "base/events.hpp"
#include "fixture.hpp"

namespace test {

/// Identifiers of errors_of_device().
enum DeviceError : std::uint8_t { general, current, hot, very_hot, no_disk, last_error = no_disk };

inline std::vector<CO_EMCY_TBL> errors_of_device() {
  return {{CO_EMCY_REG_GENERAL, CO_EMCY_CODE_GEN_ERR},
          {CO_EMCY_REG_CURRENT, CO_EMCY_CODE_CUR_ERR},
          {CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_ERR},
          {CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_DEVICE_ERR},
          {CO_EMCY_REG_MANUFACTURER, CO_EMCY_CODE_DEV_ERR}};
}

struct EmcyObjects {
  std::uint8_t unused_number = 0xEE;
  std::uint32_t history[4] = {0xEEEEEEEE, 0xEEEEEEEE, 0xEEEEEEEE, 0xEEEEEEEE};
};

/// 1003h with 4 entries, 1014h of CO_TEMCY_ID (80h + node-ID) and 1015h = 0, both rw, in addition to a Fixture.
class EmcyNode : private EmcyObjects, public Fixture {
 public:
  explicit EmcyNode(const Setup& setup = Setup().emergencies(errors_of_device()), std::uint16_t inhibit = 0)
      : Fixture(complete(setup, inhibit, *this)) {
    frames_per_call(3);
  }

  void set(std::uint8_t err, const CO_EMCY_USR* usr = nullptr, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    call([&] { COEmcySet(&node.Emcy, err, usr); }, at);
  }
  void clr(std::uint8_t err, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    call([&] { COEmcyClr(&node.Emcy, err); }, at);
  }
  // Not named raise(), because CHECK() of doctest calls raise() on CPUs without a debugger instruction.
  void raise_fault(co::event::Fault fault, std::uint8_t detail = 0, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    complete([&] { co::event::raise(node, fault, detail); }, at);
  }
  void resolve_fault(co::event::Fault fault, std::uint8_t detail = 0, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    complete([&] { co::event::resolve(node, fault, detail); }, at);
  }
  void forget_fault(co::event::Fault fault, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    complete([&] { co::event::forget(node, fault); }, at);
  }
  void can_event(CO_CAN_EVENT event, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    call([&] { CONodeCanEvent(&node, event); }, at);
  }

  unsigned error_register() const { return objects.error_register; }

  /// Returns the entries of 1003h as the application reads them, newest first.
  std::vector<std::uint32_t> errors() {
    std::vector<std::uint32_t> all;
    std::uint32_t entry = 0;
    while (CODictRdLong(&node.Dict, CO_DEV(0x1003, all.size() + 1), &entry) == CO_ERR_NONE) {
      all.push_back(entry);
    }
    std::uint8_t number = 0xFF;
    CHECK(CODictRdByte(&node.Dict, CO_DEV(0x1003, 0), &number) == CO_ERR_NONE);
    CHECK(number == all.size());
    return all;
  }

 private:
  /// Calls a function of the stack, then runs the deferred work, like an API function.
  template <typename Function>
  void complete(const Function& function, Where at) {
    call([&] { function(), co::event::run_deferred(node); }, at);
  }

  static Setup complete(Setup setup, std::uint16_t inhibit, EmcyObjects& objects) {
    setup.with({CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, &objects.unused_number});
    for (std::uint8_t sub = 1; sub <= std::size(objects.history); ++sub) {
      setup.with({CO_KEY(0x1003, sub, CO_OBJ_____R_), CO_TEMCY_HIST, &objects.history[sub - 1]});
    }
    setup.with({CO_KEY(0x1014, 0, CO_OBJ_DN__RW), CO_TEMCY_ID, 0x80});
    return setup.with({CO_KEY(0x1015, 0, CO_OBJ_D___RW), CO_TUNSIGNED16, inhibit});
  }
};

}  // namespace test
