// SPDX-License-Identifier: Apache-2.0
#include "service/para/para.hpp"

#if USE_PARA

#include "core/dict.hpp"
#include "core/obj.hpp"
#include "core/port.hpp"
#include "core/store.hpp"
#include "core/timer.hpp"
#include "object/place.hpp"
#include "service/para/groups.hpp"

namespace co::para {
namespace {

using store::Found;

uint8_t* bytes(const CO_PARA& group) { return group.Start; }

// CO_PARA.Value holds the version of the layout above its flags.
store::Record record_of(const CO_PARA& group) { return {group.Offset, group.Size, group.Value >> version_bit}; }

CO_ERR use_defaults(const CO_PARA& group, uint32_t size, Found found) {
  if (static_cast<const uint8_t*>(group.Default) != nullptr) {
    __builtin_memcpy(bytes(group), static_cast<const uint8_t*>(group.Default), size);
  }
  // The callback of the application sets the whole group.
  const bool asked = found == Found::defaults && size == group.Size;
  return asked && COParaDefault(const_cast<CO_PARA*>(&group)) != 0 ? CO_ERR_PARA_RESTORE : CO_ERR_NONE;
}

// Loads the first size bytes of a group.
CO_ERR load(CO_NODE& node, const CO_PARA& group, uint32_t size) {
  const Found found = store::load(node, record_of(group), bytes(group), size);
  if (found == Found::data) {
    return CO_ERR_NONE;
  }
  const CO_ERR err = use_defaults(group, size, found);
  if (found == Found::lost) {
    COParaLost(&node, &group);
    return CO_ERR_PARA_LOAD;
  }
  return found == Found::no_place ? CO_ERR_PARA_STORE : err;
}

void save_change(CO_NODE& node, const CO_PARA& group) {
  // Defaults that wait for their reset stay.
  if (is_saved_autonomously(group) && store::is_never_torn(node) &&
      store::look(node, record_of(group)) != Found::defaults) {
    const CO_ERR err = save(node, group);
    node.Error = err == CO_ERR_NONE ? node.Error : err;
  }
}

bool has_autonomous_group(CO_NODE& node) {
  Groups groups(node, store_index);
  const CO_PARA* group = groups.next();
  while (group != nullptr && !is_saved_autonomously(*group)) {
    group = groups.next();
  }
  return group != nullptr;
}

void on_time(void* node) { save_changes(*static_cast<CO_NODE*>(node)); }

bool holds(const CO_PARA& group, const CO_OBJ& obj) {
  const auto place = static_cast<uintptr_t>(obj.Data);
  const auto start = reinterpret_cast<uintptr_t>(bytes(group));
  return CO_IS_DIRECT(obj.Key) == 0 && place - start < group.Size;
}

// Where strings and domains have their bytes is the affair of their types.
bool is_stored(CO_NODE& node, const CO_OBJ& obj) {
  if (obj::is_stream(obj)) {
    return true;
  }
  Groups groups(node, store_index);
  const CO_PARA* group = groups.next();
  while (group != nullptr && !holds(*group, obj)) {
    group = groups.next();
  }
  return group != nullptr;
}

}  // namespace

Groups::Groups(CO_NODE& node, uint16_t index) : node_(node), index_(index), sub_(1), last_(0) {
  constexpr uint8_t highest = 127;
  if (CODictRdByte(&node.Dict, CO_DEV(index, 0), &last_) != CO_ERR_NONE) {
    last_ = 1;
  }
  last_ = last_ < highest ? last_ : highest;
  sub_ = last_ > 1 ? 2 : 1;
}

const CO_PARA* Groups::next() {
  while (sub_ <= last_) {
    const CO_OBJ* const obj = dict::find(node_.Dict, CO_DEV(index_, sub_++));
    // Groups are loaded before the Init functions check their entries.
    if (obj != nullptr && (obj->Type == CO_TPARA_STORE || obj->Type == CO_TPARA_RESTORE) &&
        CO_IS_DIRECT(obj->Key) == 0 && data_of<const CO_PARA>(*obj) != nullptr) {
      return data_of<const CO_PARA>(*obj);
    }
  }
  return nullptr;
}

CO_ERR save(CO_NODE& node, const CO_PARA& group) { return store::save(node, record_of(group), bytes(group)); }

CO_ERR restore(CO_NODE& node, const CO_PARA& group) { return store::save_defaults(node, record_of(group)); }

namespace {

// Loads the first bytes of the groups of a reset, as many as a member says: all of them, or a part.
CO_ERR load(CO_NODE& node, CO_NMT_RESET type, uint32_t CO_PARA::*member) {
  const bool is_part = member != &CO_PARA::Size;
  CO_ERR last = CO_ERR_NONE;
  Groups groups(node, store_index);
  for (const CO_PARA* group = groups.next(); group != nullptr; group = groups.next()) {
    const uint32_t size = group->*member;
    const bool is_loaded = group->Type == type && size <= group->Size && !(is_part && size == 0);
    const CO_ERR err = is_loaded ? load(node, *group, size) : CO_ERR_NONE;
    last = err == CO_ERR_NONE ? last : err;
  }
  node.Error = last == CO_ERR_NONE ? node.Error : last;
  return last;
}

}  // namespace

CO_ERR load(CO_NODE& node, CO_NMT_RESET type) { return load(node, type, &CO_PARA::Size); }

void load_communication(CO_NODE& node) { (void)load(node, CO_RESET_NODE, &CO_PARA::ComSize); }

void save_changes(CO_NODE& node) {
  Groups groups(node, store_index);
  for (const CO_PARA* group = groups.next(); group != nullptr; group = groups.next()) {
    save_change(node, *group);
  }
}

void init(CO_NODE& node) {
  const uint32_t period = tmr::ticks(node.Tmr, CO_PARA_PERIOD, CO_TMR_UNIT_1MS);
  if (node.Nmt.Mode == CO_INIT && period != 0 && has_autonomous_group(node)) {
    tmr::start(node.Tmr, node.ParaTmr, 0, period, on_time, &node);
  } else {
    tmr::stop(node.Tmr, node.ParaTmr);
  }
}

void on_write(CO_NODE& node, const CO_OBJ& obj) {
  if (CO_GET_IDX(obj.Key) == verify_index || !is_stored(node, obj)) {
    return;
  }
  node.Verified = 0;
  dict::write_u32(node.Dict, CO_DEV(verify_index, 1), 0);
  dict::write_u32(node.Dict, CO_DEV(verify_index, 2), 0);
}

void on_mode(CO_NODE& node) {
  if (node.Nmt.Mode == CO_INVALID) {
    tmr::stop(node.Tmr, node.ParaTmr);
  }
}

}  // namespace co::para

#endif
