// SPDX-License-Identifier: Apache-2.0
// Parameter groups: lookup by name or by variable, store and restore (co_od.h).
#include "storage/para.hpp"

#include "base/events.hpp"
#include "dictionary/obj.hpp"
#include "extra/od/index.hpp"
#include "extra/od/types.hpp"

#if USE_OD && USE_PARA

namespace co::od {
namespace {

constexpr uint8_t last_group = 127;              // highest sub-index of 1010h [301:7.5.2.13]
constexpr uint32_t save_signature = 0x65766173;  // "save" and "load" in the order of the bus
constexpr uint32_t load_signature = 0x64616F6C;

// Returns the parameter group at a sub-index of 1010h, or null.
const CO_PARA* group_at(const OD_t& od, uint8_t sub) {
  const CO_OBJ* const obj = sub == 0 ? nullptr : find_in_table(od, CO_DEV(para::store_index, sub));
  const bool is_group = obj != nullptr && obj->Type == CO_TPARA_STORE && CO_IS_DIRECT(obj->Key) == 0;
  return is_group ? data_of<const CO_PARA>(*obj) : nullptr;
}

const char* name_of(const CO_PARA& group) { return static_cast<const char*>(group.Ident); }

bool is_named(const CO_PARA& group, const char* name) {
  const char* own = name_of(group);
  if (own == nullptr) {
    return false;
  }
  while (*own != 0 && *own == *name) {
    ++own;
    ++name;
  }
  return *own == *name;
}

// Returns whether an address is in the memory of a group.
bool holds(const CO_PARA& group, const void* memory) {
  const auto start = reinterpret_cast<uintptr_t>(static_cast<uint8_t*>(group.Start));
  return reinterpret_cast<uintptr_t>(memory) - start < group.Size;
}

// Writes a signature to a sub-index of 1010h or 1011h, as an SDO client does.
ODR_t command(const OD_t* od, uint8_t sub, uint16_t index, uint32_t signature) {
  CO_OBJ* const obj = od == nullptr || group_at(*od, sub) == nullptr ? nullptr : find_in_table(*od, CO_DEV(index, sub));
  if (obj == nullptr) {
    return ODR_SUB_NOT_EXIST;
  }
  CO_NODE& node = *od->Node;
  if (node.Dict.Root != od->Table) {
    return ODR_OD_MISSING;
  }
  const event::Call call(node);
  return result_of(node, *obj, obj::write(*obj, node, &signature, sizeof signature));
}

}  // namespace
}  // namespace co::od

extern "C" {

uint8_t OD_findStorageGroup(const OD_t* od, const char* name) {
  if (od == nullptr || name == nullptr) {
    return 0;
  }
  for (uint8_t sub = 1; sub <= co::od::last_group; ++sub) {
    const CO_PARA* const group = co::od::group_at(*od, sub);
    if (group != nullptr && co::od::is_named(*group, name)) {
      return sub;
    }
  }
  return 0;
}

// Returns sub-index 1 only if 1010h has no other group; otherwise sub-index 1 selects all groups.
uint8_t OD_getStorageGroup(const OD_entry_t* entry, uint8_t subIndex) {
  const void* const memory = OD_getPtr(entry, subIndex, 0, nullptr);
  if (memory == nullptr || !co::od::is_of_table(*entry)) {
    return 0;
  }
  const OD_t& od = co::od::owner_of(*entry);
  bool has_others = false;
  for (uint8_t sub = 2; sub <= co::od::last_group; ++sub) {
    const CO_PARA* const group = co::od::group_at(od, sub);
    has_others |= group != nullptr;
    if (group != nullptr && co::od::holds(*group, memory)) {
      return sub;
    }
  }
  const CO_PARA* const alone = has_others ? nullptr : co::od::group_at(od, 1);
  return alone != nullptr && co::od::holds(*alone, memory) ? 1 : 0;
}

const char* OD_getStorageName(const OD_t* od, uint8_t group) {
  const CO_PARA* const found = od == nullptr ? nullptr : co::od::group_at(*od, group);
  return found == nullptr ? nullptr : co::od::name_of(*found);
}

ODR_t OD_storeGroup(const OD_t* od, uint8_t group) {
  return co::od::command(od, group, co::para::store_index, co::od::save_signature);
}

ODR_t OD_restoreGroup(const OD_t* od, uint8_t group) {
  return co::od::command(od, group, co::para::restore_index, co::od::load_signature);
}

}  // extern "C"

#endif
