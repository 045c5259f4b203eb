// SPDX-License-Identifier: Apache-2.0
#include "storage/para.hpp"

#if USE_PARA

#include "base/callbacks.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "hal/port.hpp"
#include "storage/budget.hpp"
#include "storage/store.hpp"

namespace co::para {
namespace {

using store::Found;

// Returns whether the group is stored in the memory: on command ("save"), or autonomously.
bool has_record(const CO_PARA& group) { return (group.Value & CO_PARA__AE) != 0; }

// Returns whether the records of two groups use the same addresses. The differences are unsigned: the one of the lower
// address is large.
bool overlap(CO_NODE& node, const store::Record& a, const store::Record& b) {
  return a.start - b.start < store::space(node, b) || b.start - a.start < store::space(node, a);
}

// The record of a group; its sub-index of 1010h is part of the record's identity.
struct Located {
  store::Record record;
  CO_ERR err;  // CO_ERR_PARA_OVERLAP: the group overlaps one with a lower sub-index
};

// Returns the record of a group, without its sub-index. CO_PARA.Value may hold the version of the layout above its
// flags.
[[gnu::noinline]] store::Record record_of(const CO_PARA& group) {
  return {group.Offset, group.Size, group.Version != 0 ? group.Version : group.Value >> version_bit, 0};
}

// Returns the record of a group, and whether the group must not be loaded or stored.
Located locate(CO_NODE& node, const CO_PARA& group) {
  Located located = {record_of(group), CO_ERR_NONE};
  Groups groups(node, store_index);
  for (const CO_PARA* other = groups.next(); other != nullptr; other = groups.next()) {
    const store::Record record = record_of(*other);
    if (memory_of(*other) == memory_of(group) && other->Type == group.Type &&
        slots::is_same(reinterpret_cast<const uint8_t*>(&record), reinterpret_cast<const uint8_t*>(&located.record),
                       sizeof record)) {
      located.record.group = CO_GET_SUB(groups.entry().Key);
      break;
    }
    if (has_record(*other) && has_record(group) && overlap(node, record, located.record)) {
      located.err = CO_ERR_PARA_OVERLAP;
    }
  }
  return located;
}

// Stores a group if it is autonomous, has changed, and the memory does not hold the request of a "load" to use the
// defaults, which a store would replace.
CO_ERR save_change(CO_NODE& node, const CO_PARA& group) {
  return is_saved_autonomously(group) && port::nvm_has_geometry(node)
             ? save(node, group, memory_of(group), store::Cause::change)
             : CO_ERR_NONE;
}

// Returns the error of an autonomous store. If the budget is used up (CO_ERR_OBJ_STATE), that is no error: the group is
// stored at the next period (CO_PARA_PERIOD).
CO_ERR without_delay(CO_ERR err) { return CO_PARA_BUDGET > 0 && err == CO_ERR_OBJ_STATE ? CO_ERR_NONE : err; }

// Sets the first size bytes of a group to the default values of the table, if it has any. If the memory holds the
// request to use the defaults, after a "load", also calls COParaDefault(), which sets all bytes of the group. For an
// autonomous group it then ends the request by storing the defaults, so that later changes are stored; if the budget is
// used up, the next reset ends the request.
[[gnu::noinline]] CO_ERR use_defaults(CO_NODE& node, const CO_PARA& group, uint32_t size, Found found) {
  CO_ASSERT(size <= group.Size);
  if (static_cast<const uint8_t*>(group.Default) != nullptr) {
    __builtin_memcpy(memory_of(group), static_cast<const uint8_t*>(group.Default), size);
  }
  if (found != Found::defaults || size != group.Size) {
    return CO_ERR_NONE;
  }
  if (callback::set_para_defaults(node, const_cast<CO_PARA&>(group)) != 0) {
    return CO_ERR_PARA_RESTORE;
  }
  return is_saved_autonomously(group) ? without_delay(save(node, group, memory_of(group))) : CO_ERR_NONE;
}

// Loads the first size bytes of a group: from its record, or the default values. The record of a group that is never
// stored is not read, because CO_PARA.Offset may have any value; with a classic driver it is read, as in CANopen-Stack.
[[gnu::noinline]] CO_ERR load_group(CO_NODE& node, const CO_PARA& group, uint32_t size) {
  const Located located = locate(node, group);
  const bool is_read = located.err == CO_ERR_NONE && (has_record(group) || !port::nvm_has_geometry(node));
  store::Target target = {memory_of(group), size, false};
  const Found found = is_read ? store::of(node).load(node, located.record, target) : Found::blank;
  CO_ERR err = found == Found::data ? CO_ERR_NONE : use_defaults(node, group, size, found);
  if (target.is_older) {
    callback::recover_para(node, group);
  }
  if (found == Found::lost) {
    callback::lose_para(node, group);
    err = CO_ERR_PARA_LOAD;
  }
  if (found == Found::no_room) {
    err = CO_ERR_PARA_STORE;
  }
  return located.err != CO_ERR_NONE ? located.err : err;
}

// Returns whether the variables of the group are newer than its record, because the budget is used up. A reset must not
// load the group then. Without budget nothing is written.
bool has_unsaved_change(CO_NODE& node, const CO_PARA& group) {
  if (!budget::is_empty(node)) {
    return false;
  }
  const budget::Command command(node);
  return save_change(node, group) != CO_ERR_NONE;
}

// Starts the timer that stores the autonomous groups, or stops it if there are none. flags: those of all groups
void start_or_stop(CO_NODE& node, uint32_t flags) {
  const uint32_t period = tmr::ticks(node, CO_PARA_PERIOD, CO_TMR_UNIT_1MS);
  if (period != 0 && (flags & CO_PARA__A_) != 0) {
    tmr::start(node, node.Storage.Tmr, 0, period, save_changes, &node);
  } else {
    tmr::stop(node, node.Storage.Tmr);
  }
}

// Returns whether the variable of an entry is located in the memory of a group.
bool contains(const CO_PARA& group, const CO_OBJ& obj) {
  const auto address = static_cast<uintptr_t>(obj.Data);
  const auto start = reinterpret_cast<uintptr_t>(memory_of(group));
  return CO_IS_DIRECT(obj.Key) == 0 && address - start < group.Size;
}

// Returns whether an object may be part of a group. Returns true for every stream (string, domain), because only its
// type has the address of its bytes.
bool may_be_in_group(CO_NODE& node, const CO_OBJ& obj) {
  if (obj::is_stream(obj)) {
    return true;
  }
  Groups groups(node, store_index);
  const CO_PARA* group = groups.next();
  while (group != nullptr && !contains(*group, obj)) {
    group = groups.next();
  }
  return group != nullptr;
}

}  // namespace

Groups::Groups(CO_NODE& node, uint16_t index) : node_(node), entry_(nullptr), index_(index), sub_(1), last_(0) {
  constexpr uint8_t highest = 127;
  const uint32_t last = dict::read_number(node, CO_DEV(index, 0), sizeof last_, 1);
  last_ = static_cast<uint8_t>(last < highest ? last : highest);
  sub_ = last_ > 1 ? 2 : 1;
}

const CO_PARA* Groups::next() {
  while (sub_ <= last_) {
    const CO_OBJ* const obj = dict::find(node_, CO_DEV(index_, sub_++));
    // The Init functions have not checked the entries yet: groups are loaded before.
    if (obj != nullptr && (obj->Type == CO_TPARA_STORE || obj->Type == CO_TPARA_RESTORE) &&
        CO_IS_DIRECT(obj->Key) == 0 && data_of<const CO_PARA>(*obj) != nullptr) {
      entry_ = obj;
      return data_of<const CO_PARA>(*obj);
    }
  }
  return nullptr;
}

CO_ERR save(CO_NODE& node, const CO_PARA& group, const uint8_t* data, store::Cause cause) {
  const Located located = locate(node, group);
  return located.err != CO_ERR_NONE ? located.err : store::of(node).save(node, located.record, data, cause);
}

CO_ERR load(CO_NODE& node, CO_NMT_RESET type, uint32_t CO_PARA::*member) {
  const bool is_partial = member != &CO_PARA::Size;
  CO_ERR last = CO_ERR_NONE;
  uint32_t flags = 0;
  Groups groups(node, store_index);
  for (const CO_PARA* group = groups.next(); group != nullptr; group = groups.next()) {
    flags |= group->Value;
    const uint32_t size = group->*member;
    const bool is_loaded = group->Type == type && size <= group->Size && !(is_partial && size == 0);
    const CO_ERR err = is_loaded && !has_unsaved_change(node, *group) ? load_group(node, *group, size) : CO_ERR_NONE;
    if (err == CO_ERR_NONE) {
      continue;
    }
    last = err;
    error::report(node, err, groups.entry().Key);
    if (err == CO_ERR_PARA_OVERLAP) {
      (void)dict::set_fault(groups.entry(), node, CO_DICT_PARA_OVERLAP);
    }
  }
  if (node.Nmt.Mode == CO_INIT) {
    start_or_stop(node, flags);
  }
  return last;
}

void load_groups(CO_NODE& node, CO_NMT_RESET type) {
  (void)load(node, CO_RESET_NODE, type == CO_RESET_NODE ? &CO_PARA::Size : &CO_PARA::ComSize);
  (void)load(node, CO_RESET_COM, &CO_PARA::Size);
}

void save_changes(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  const budget::Command command(node);
  Groups groups(node, store_index);
  for (const CO_PARA* group = groups.next(); group != nullptr; group = groups.next()) {
    error::report(node, without_delay(save_change(node, *group)), groups.entry().Key);
  }
}

void on_write(CO_NODE* node, const CO_OBJ* obj) {
  if (CO_GET_IDX(obj->Key) == verify_index || !may_be_in_group(*node, *obj)) {
    return;
  }
  node->Storage.OnWrite = nullptr;
  dict::write_u32(*node, CO_DEV(verify_index, 1), 0);
  dict::write_u32(*node, CO_DEV(verify_index, 2), 0);
}

void on_mode(CO_NODE& node) {
  if (node.Nmt.Mode == CO_INVALID) {
    tmr::stop(node, node.Storage.Tmr);
    budget::stop(node);
  }
}

}  // namespace co::para

#endif
