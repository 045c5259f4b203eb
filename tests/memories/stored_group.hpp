// SPDX-License-Identifier: Apache-2.0
/// \file stored_group.hpp
/// A node with two parameter groups in a modelled memory, and tests that cut the power at each operation of the memory.
/// A model has power, context(), driver() and is_used_well(), and can be copied.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>

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

}  // namespace test

#endif
