// SPDX-License-Identifier: Apache-2.0
/// \file stored_group.hpp
/// A node with two parameter groups in a modelled memory, and tests that cut the power at each operation of the memory.
/// A model has power, context(), driver() and is_used_well(), and can be copied.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>

#include "bus_fault.hpp"
#include "co_core.h"
#include "co_para.h"
#include "power.hpp"

#if USE_PARA

namespace test {

struct Values {
  std::uint32_t number;
  std::uint8_t rest[56];
  bool operator==(const Values& other) const { return std::memcmp(this, &other, sizeof *this) == 0; }
};

inline Values values_of(std::uint8_t seed) {
  Values values{};
  values.number = seed * 0x01010101U;
  for (std::size_t n = 0; n < sizeof values.rest; ++n) {
    values.rest[n] = static_cast<std::uint8_t>(seed + n);
  }
  return values;
}

/// The node. Its memory is a model of the test.
class StoredGroup {
 public:
  static Values defaults() { return values_of(1); }

  /// Starts the node: it loads both groups. Returns the values of the first one.
  template <class Model>
  Values boot(Model& model) {
    void* const ctx = model.context();
    start(model.driver(), ctx);
    return first_;
  }

  template <class Model>
  CO_ERR save(Model& model, const Values& values) {
    model.power.is_off = false;
    ext_.NvmCtx = model.context();
    first_ = values;
    return COParaStore(&groups_[0], &node_);
  }

  /// Stores the second group, whose slots are behind those of the first one.
  template <class Model>
  CO_ERR save_second(Model& model, const Values& values) {
    ext_.NvmCtx = model.context();
    second_ = values;
    return COParaStore(&groups_[1], &node_);
  }

  [[nodiscard]] const Values& second() const { return second_; }
  CO_ERR error = CO_ERR_NONE;  ///< error of boot()
  unsigned recovered = 0;      ///< groups of which boot() has loaded an older record than the damaged one

 private:
  void start(const CO_IF_NVM_DRV_EX& driver, void* ctx) {
    static const CO_IF_CAN_DRV_EX no_bus = {[](void*) {},
                                            [](void*, std::uint32_t) {},
                                            [](void*, CO_IF_FRM*) { return std::int16_t{0}; },
                                            [](void*, const CO_IF_FRM*) { return std::int16_t{0}; },
                                            [](void*) {},
                                            [](void*) {},
                                            nullptr,
                                            nullptr};
    static const CO_IF_TIMER_DRV_EX no_timer = {[](void*, std::uint32_t) {}, [](void*) { return std::uint32_t{0}; },
                                                nullptr};
    static const Values default_values = defaults();
    const CO_NVM_SHAPE shape = driver.Shape(ctx);
    const std::uint32_t unit = shape.EraseSize == 0 ? shape.ProgramSize : shape.EraseSize;
    const std::uint32_t space = CO_PARA_SPACE(sizeof(Values), unit, shape.ProgramSize);
    first_ = second_ = values_of(0xEE);
    groups_[0] = {0, sizeof(Values), &first_, &default_values, CO_RESET_NODE, nullptr, CO_PARA___E, 0, 0};
    groups_[1] = {space, sizeof(Values), &second_, &default_values, CO_RESET_NODE, nullptr, CO_PARA___E, 0, 0};
    const CO_OBJ entries[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
                              {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register_)},
                              {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
                              {CO_KEY(0x1010, 2, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&groups_[0])},
                              {CO_KEY(0x1010, 3, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&groups_[1])},
                              {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(1)},
                              CO_OBJ_DICT_ENDMARK};
    std::memcpy(static_cast<void*>(dictionary_), entries, sizeof entries);
    ext_ = {};
    ext_.Size = sizeof ext_;
    ext_.Can = &no_bus;
    ext_.Timer = &no_timer;
    ext_.Nvm = &driver;
    ext_.NvmCtx = ctx;
    static const CO_CALLBACKS callbacks = [] {
      CO_CALLBACKS table{};
      table.ParaRecovered = [](CO_NODE*, void* user, const CO_PARA*) { ++static_cast<StoredGroup*>(user)->recovered; };
      return table;
    }();
    ext_.Callbacks = &callbacks;
    ext_.User = this;
    recovered = 0;
    CO_NODE_SPEC spec{};
    spec.NodeId = 1;
    spec.Dict = dictionary_;
    spec.DictLen = 6;
    spec.TmrFreq = 1000;
    CONodeInitEx(&node_, &spec, &ext_);
    error = CONodeGetErr(&node_);
  }

  Values first_{};
  Values second_{};
  std::uint8_t error_register_ = 0;
  CO_PARA groups_[2]{};
  CO_OBJ dictionary_[7]{};
  CO_NODE_EXT ext_{};
  CO_NODE node_{};
};

/// Stores values with a loss of power at each operation of the memory, in each state in which an interrupted operation
/// can leave it. Requires that the group then has its old or its new values, that the second group is not changed, and
/// that the next store works. Returns the number of cuts.
template <class Model>
std::uint64_t cut_each_operation(const Model& before, const Values& old, const Values& changed, const Values& second) {
  static StoredGroup node;
  std::uint64_t cuts = 0;
  for (const Partial partial : all_partial) {
    for (std::uint64_t operation = 1;; ++operation) {
      Model model = before;
      node.boot(model);
      model.power.restore(operation, partial);
      const bool saved = node.save(model, changed) == CO_ERR_NONE;
      const bool was_cut = model.power.is_off;
      model.power.restore();
      const Values found = node.boot(model);
      const bool is_changed = found == changed;
      REQUIRE((is_changed || found == old));
      REQUIRE((is_changed || !saved));
      REQUIRE(node.second() == second);
      REQUIRE(model.is_used_well());
      if (!was_cut) {
        REQUIRE(saved);
        break;
      }
      ++cuts;
      REQUIRE(node.save(model, values_of(77)) == CO_ERR_NONE);
      REQUIRE(node.boot(model) == values_of(77));
      REQUIRE(node.second() == second);
      REQUIRE(model.is_used_well());
    }
  }
  return cuts;
}

/// Cuts the power in the first to the fourth store of a new memory. Returns the number of cuts.
template <class Model>
std::uint64_t cut_each_store(Model model) {
  static StoredGroup node;
  node.boot(model);
  REQUIRE(node.save_second(model, values_of(200)) == CO_ERR_NONE);
  Values old = StoredGroup::defaults();
  std::uint64_t cuts = 0;
  for (const std::uint8_t seed : std::initializer_list<std::uint8_t>{10, 0xFF, 30, 40}) {
    cuts += cut_each_operation(model, old, values_of(seed), values_of(200));
    node.boot(model);
    REQUIRE(node.save(model, values_of(seed)) == CO_ERR_NONE);
    old = values_of(seed);
  }
  REQUIRE(node.boot(model) == old);
  REQUIRE(node.error == CO_ERR_NONE);
  return cuts;
}

/// Stores values with a fault of the bus at each access, of each kind and duration, then starts the node again with the
/// bus restored. Requires what cut_each_operation() requires. Returns the number of faults.
template <class Model>
std::uint64_t disturb_each_access(const Model& before, const Values& old, const Values& changed, const Values& second) {
  static StoredGroup node;
  std::uint64_t faults = 0;
  for_bus_faults([&](BusFault kind, std::uint64_t duration) {
    CAPTURE(static_cast<int>(kind));
    CAPTURE(duration);
    for (std::uint64_t at = 1;; ++at) {
      CAPTURE(at);
      Model model = before;
      node.boot(model);
      model.bus_fault = {kind, at, duration};
      const bool saved = node.save(model, changed) == CO_ERR_NONE;
      const bool was_faulty = model.bus_fault.has_begun();
      model.bus_fault = {};
      const Values found = node.boot(model);
      const bool is_changed = found == changed;
      REQUIRE((is_changed || found == old));
      REQUIRE((is_changed || !saved));
      REQUIRE(node.second() == second);
      if (!was_faulty) {
        REQUIRE(saved);
        break;
      }
      ++faults;
      REQUIRE(node.save(model, values_of(77)) == CO_ERR_NONE);
      REQUIRE(node.boot(model) == values_of(77));
      REQUIRE(node.second() == second);
    }
  });
  return faults;
}

/// Disturbs the first to the third store of a new memory. Returns the number of faults.
template <class Model>
std::uint64_t disturb_each_store(Model model) {
  static StoredGroup node;
  node.boot(model);
  REQUIRE(node.save_second(model, values_of(200)) == CO_ERR_NONE);
  Values old = StoredGroup::defaults();
  std::uint64_t faults = 0;
  for (const std::uint8_t seed : std::initializer_list<std::uint8_t>{10, 0xFF, 30}) {
    faults += disturb_each_access(model, old, values_of(seed), values_of(200));
    node.boot(model);
    REQUIRE(node.save(model, values_of(seed)) == CO_ERR_NONE);
    old = values_of(seed);
  }
  return faults;
}

/// Starts the node with a fault of the bus at each access. Requires that the groups have values that were stored or
/// their defaults, that a fault that the bus shows is reported if the values are not the newest ones, and that the next
/// start has the newest values. A header that reads FFh or 00h throughout is that of an unused slot: not reported.
/// Returns the number of faults.
template <class Model>
std::uint64_t disturb_each_start(Model model) {
  static StoredGroup node;
  node.boot(model);
  REQUIRE(node.save_second(model, values_of(200)) == CO_ERR_NONE);
  std::uint64_t faults = 0;
  for (const std::uint8_t seed : std::initializer_list<std::uint8_t>{10, 20, 30, 40}) {
    const Values old = node.boot(model);
    REQUIRE(node.save(model, values_of(seed)) == CO_ERR_NONE);
    for_bus_faults([&](BusFault kind, std::uint64_t duration) {
      CAPTURE(static_cast<int>(seed));
      CAPTURE(static_cast<int>(kind));
      CAPTURE(duration);
      bool was_faulty = true;
      for (std::uint64_t at = 1; was_faulty; ++at) {
        CAPTURE(at);
        Model disturbed = model;
        disturbed.bus_fault = {kind, at, duration};
        const Values found = node.boot(disturbed);
        was_faulty = disturbed.bus_fault.has_begun();
        faults += was_faulty ? 1 : 0;
        const bool is_newest = found == values_of(seed) && node.second() == values_of(200);
        REQUIRE((found == values_of(seed) || found == old || found == StoredGroup::defaults()));
        REQUIRE((node.second() == values_of(200) || node.second() == StoredGroup::defaults()));
        const bool is_reported = node.error != CO_ERR_NONE || node.recovered != 0 || USE_CALLBACKS == 0;
        REQUIRE((is_newest || is_reported || !Model::shows(kind)));
        disturbed.bus_fault = {};
        REQUIRE(node.boot(disturbed) == values_of(seed));
        REQUIRE(node.second() == values_of(200));
        REQUIRE(node.error == CO_ERR_NONE);
      }
    });
  }
  return faults;
}

}  // namespace test

#endif
