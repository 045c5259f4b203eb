// SPDX-License-Identifier: Apache-2.0
/// \file access.hpp
/// Access hooks that record their calls and return the results that a test sets.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "fixture.hpp"

#if USE_ACCESS_HOOK

namespace test {

struct SeenSdo {
  CO_OBJ_TRANSFER direction;
  std::uint16_t index;
  std::uint8_t sub;
  std::uint8_t channel;
  std::uint32_t size;
  Bytes data;
  bool operator==(const SeenSdo& other) const {
    return direction == other.direction && index == other.index && sub == other.sub && channel == other.channel &&
           size == other.size && data == other.data;
  }
};

/// Record of the calls of the access hooks. Must outlive the fixture; only one may exist at a time.
class AccessLog {
 public:
  AccessLog() { self_ = this; }
  AccessLog(const AccessLog&) = delete;
  AccessLog& operator=(const AccessLog&) = delete;

  static Setup setup(Setup with = {}) { return with.callbacks(table()); }

  std::vector<SeenSdo> sdo;
  std::vector<std::pair<std::uint8_t, std::uint8_t>> nmt;  ///< command specifier, node-ID
  std::vector<CO_ACCESS_LSS> lss;                          ///< before the hook changes them
  std::function<std::uint32_t(CO_NODE&, const CO_ACCESS_SDO&)> on_sdo;
  std::function<std::uint8_t(CO_NODE&, const CO_ACCESS_NMT&)> on_nmt;
  std::function<std::uint8_t(CO_NODE&, CO_ACCESS_LSS&)> on_lss;

  std::uint8_t text_memory[16] = {'t', 'e', 'x', 't', 0};
  CO_OBJ_STR_RW text{0, 4, 16, text_memory};

 private:
  static const CO_CALLBACKS& table() {
    static const CO_CALLBACKS callbacks = [] {
      CO_CALLBACKS all{};
      all.AccessSdo = note_sdo;
      all.AccessNmt = note_nmt;
      all.AccessLss = note_lss;
      return all;
    }();
    return callbacks;
  }

  static std::uint32_t note_sdo(CO_NODE* node, void* user, const CO_ACCESS_SDO* access) {
    const OutsideStack outside;
    CHECK(user == CONodeGetUser(node));
    const std::uint32_t n = access->Size != 0 ? access->Size : 4;
    const Bytes data = access->Data == nullptr ? Bytes{} : Bytes(access->Data, access->Data + n);
    self_->sdo.push_back({access->Direction, access->Index, access->Sub, access->Channel, access->Size, data});
    return self_->on_sdo ? self_->on_sdo(*node, *access) : 0;
  }
  static std::uint8_t note_nmt(CO_NODE* node, void* user, const CO_ACCESS_NMT* access) {
    const OutsideStack outside;
    CHECK(user == CONodeGetUser(node));
    self_->nmt.emplace_back(access->Command, access->NodeId);
    return self_->on_nmt ? self_->on_nmt(*node, *access) : std::uint8_t{0};
  }
  static std::uint8_t note_lss(CO_NODE* node, void* user, CO_ACCESS_LSS* access) {
    const OutsideStack outside;
    CHECK(user == CONodeGetUser(node));
    self_->lss.push_back(*access);
    return self_->on_lss ? self_->on_lss(*node, *access) : std::uint8_t{0};
  }

  inline static AccessLog* self_ = nullptr;
};

}  // namespace test

#endif
