// SPDX-License-Identifier: Apache-2.0
// 1010h, 1011h and 1020h. [301:7.5.2.13, 7.5.2.14, 7.5.2.23]
#include "base/events.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/types/place.hpp"
#include "storage/budget.hpp"
#include "storage/groups.hpp"
#include "storage/para.hpp"
#include "storage/store.hpp"

#if USE_PARA

namespace co::para {
namespace {

constexpr uint32_t save_signature = 0x65766173;  // "save" and "load" in the order of the bus
constexpr uint32_t load_signature = 0x64616F6C;

// Returns whether the entry is sub-index 0: the number of groups, an UNSIGNED8.
bool is_number_of_groups(const CO_OBJ& obj) { return CO_GET_SUB(obj.Key) == 0; }

// Returns whether the entry stands for all groups: sub-index 1, if there are others.
bool is_all(CO_NODE& node, const CO_OBJ& obj) {
  return CO_GET_SUB(obj.Key) == 1 && dict::read_number(node, CO_DEV(CO_GET_IDX(obj.Key), 0), sizeof(uint8_t), 0) > 1;
}

// Calls a function for each group that an entry stands for.
template <class Function>
void for_groups(CO_NODE& node, const CO_OBJ& obj, Function function) {
  if (!is_all(node, obj)) {
    if (data_of<const CO_PARA>(obj) != nullptr) {
      function(*data_of<const CO_PARA>(obj));
    }
    return;
  }
  Groups groups(node, static_cast<uint16_t>(CO_GET_IDX(obj.Key)));
  for (const CO_PARA* group = groups.next(); group != nullptr; group = groups.next()) {
    function(*group);
  }
}

template <const rules::Rule& number, const rules::Rule& entry>
CO_ERR init_entry(CO_OBJ* obj, CO_NODE* node) {
  return dict::check_type(*obj, *node, is_number_of_groups(*obj) ? number : entry);
}

uint32_t size(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  const CO_OBJ_TYPE* const type = is_number_of_groups(*obj) ? CO_TUNSIGNED8 : CO_TUNSIGNED32;
  return type->Size(obj, node, width);
}

// Returns the operations that the network can execute on the groups of an entry. A group is stored autonomously only in
// an atomic memory: power may fail at any of these stores. [301:7.5.2.13 figure 60]
template <uint32_t bits>
uint32_t abilities(CO_NODE& node, const CO_OBJ& obj) {
  uint32_t all = 0;
  for_groups(node, obj, [&](const CO_PARA& group) { all |= group.Value & bits; });
  return store::is_atomic(node) ? all : all & CO_PARA___E;
}

template <uint32_t bits>
CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (is_number_of_groups(*obj)) {
    return CO_TUNSIGNED8->Read(obj, node, buffer, size);
  }
  const uint32_t value = abilities<bits>(*node, *obj);
  if (size != sizeof value || uintptr_t{obj->Data} == 0) {
    return CO_ERR_OBJ_SIZE;
  }
  __builtin_memcpy(buffer, &value, sizeof value);
  return CO_ERR_NONE;
}

// Writes a signature to 1010h or 1011h: executes "save" or "load" for each group. Returns the first error.
template <uint32_t signature, CO_ERR (*command)(CO_NODE& node, const CO_PARA& group)>
CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  uint32_t value = 0;
  if (is_number_of_groups(*obj) || size != sizeof value) {
    return is_number_of_groups(*obj) ? CO_ERR_OBJ_ACC : CO_ERR_OBJ_SIZE;
  }
  __builtin_memcpy(&value, buffer, sizeof value);
  if (uintptr_t{obj->Data} == 0 || value != signature || abilities<CO_PARA___E>(*node, *obj) == 0) {
    return CO_ERR_TYPE_WR;
  }
  const budget::Command counted(*node);
  CO_ERR first = CO_ERR_NONE;
  for_groups(*node, *obj, [&](const CO_PARA& group) {
    const CO_ERR err = is_saved_on_command(group) ? command(*node, group) : CO_ERR_NONE;
    first = first == CO_ERR_NONE ? err : first;
  });
  return first;
}

// Records that date or time in 1020h is not 0: the configuration is verified until an object of a group is written.
// value: that of either sub-index; 0 changes nothing, because the other may still be set
void note_verification(CO_NODE& node, uint32_t value) { node.Verified = value != 0 ? 1 : node.Verified; }

CO_ERR init_verify(CO_OBJ* obj, CO_NODE* node) {
  uint32_t value = 0;
  const CO_ERR err = dict::check_type(*obj, *node, rules::verify_configuration);
  if (err == CO_ERR_NONE && CO_TUNSIGNED32->Read(obj, node, &value, sizeof value) == CO_ERR_NONE) {
    note_verification(*node, value);
  }
  return err;
}

uint32_t size_verify(CO_OBJ* obj, CO_NODE* node, uint32_t width) { return CO_TUNSIGNED32->Size(obj, node, width); }

CO_ERR read_verify(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return CO_TUNSIGNED32->Read(obj, node, buffer, size);
}

CO_ERR write_verify(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const CO_ERR err = CO_TUNSIGNED32->Write(obj, node, buffer, size);
  uint32_t value = 0;
  if (err == CO_ERR_NONE && CO_TUNSIGNED32->Read(obj, node, &value, sizeof value) == CO_ERR_NONE) {
    note_verification(*node, value);
  }
  return err;
}

// Implements an API function. A reset that is requested during the memory access is executed afterwards.
template <CO_ERR (*command)(CO_NODE& node, const CO_PARA& group)>
CO_ERR run(CO_NODE& node, const CO_PARA& group) {
  if (!is_saved_on_command(group)) {
    return CO_ERR_NONE;
  }
  CO_ERR err = CO_ERR_NONE;
  {
    const event::Serving serving(node);
    err = command(node, group);
  }
  event::run_deferred(node);
  return err;
}

}  // namespace
}  // namespace co::para

using namespace co;

extern "C" {

// Default callbacks.
WEAK int16_t COParaDefault(CO_PARA*) { return 0; }

WEAK void COParaLost(CO_NODE*, const CO_PARA*) {}

const CO_OBJ_TYPE COTParaStore = {para::size, para::init_entry<rules::parameter_group_number, rules::parameter_group>,
                                  para::read<CO_PARA__AE>, para::write<para::save_signature, para::save>, nullptr};
const CO_OBJ_TYPE COTParaRestore = {para::size, para::init_entry<rules::parameter_group_number, rules::parameter_group>,
                                    para::read<CO_PARA___E>, para::write<para::load_signature, para::restore>, nullptr};
const CO_OBJ_TYPE COTVerifyConfig = {para::size_verify, para::init_verify, para::read_verify, para::write_verify,
                                     nullptr};

CO_ERR COParaStore(const CO_PARA* pg, CO_NODE* node) {
  ASSERT_PTR_ERR(pg, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  return para::run<para::save>(*node, *pg);
}

CO_ERR COParaRestore(const CO_PARA* pg, CO_NODE* node) {
  ASSERT_PTR_ERR(pg, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  return para::run<para::restore>(*node, *pg);
}

CO_ERR CONodeParaLoad(CO_NODE* node, CO_NMT_RESET type) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  CO_ERR err = CO_ERR_NONE;
  {
    const event::Serving serving(*node);
    err = para::load(*node, type);
  }
  event::run_deferred(*node);
  return err;
}

}  // extern "C"

#endif
