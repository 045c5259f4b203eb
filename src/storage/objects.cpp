// SPDX-License-Identifier: Apache-2.0
// 1010h, 1011h and 1020h. [301:7.5.2.13, 7.5.2.14, 7.5.2.23]
#include "base/events.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/integer.hpp"
#include "hal/port.hpp"
#include "storage/budget.hpp"
#include "storage/para.hpp"

#if USE_PARA

namespace co::para {
namespace {

constexpr uint32_t save_signature = 0x65766173;  // "save" and "load" in the order of the bus
constexpr uint32_t load_signature = 0x64616F6C;

// Returns whether the entry is sub-index 0: the number of groups, an UNSIGNED8.
bool is_number_of_groups(const CO_OBJ& obj) { return CO_GET_SUB(obj.Key) == 0; }

// Returns whether the entry is one of 1011h; otherwise it is one of 1010h. A type of the application may call these
// functions.
bool is_restore(const CO_OBJ& obj) { return CO_GET_IDX(obj.Key) == restore_index; }

// Returns the flags of all groups that an entry selects. error: null, or CO_ERR_NONE: executes "save" or "load" for
// the groups, and error becomes the first error
uint32_t visit(CO_NODE& node, const CO_OBJ& obj, CO_ERR* error) {
  Groups groups(node, static_cast<uint16_t>(CO_GET_IDX(obj.Key)));
  const bool is_all = CO_GET_SUB(obj.Key) == 1 && groups.are_several();
  const CO_PARA* group = is_all ? groups.next() : data_of<const CO_PARA>(obj);
  uint32_t flags = 0;
  while (group != nullptr) {
    flags |= group->Value;
    if (error != nullptr && is_saved_on_command(*group)) {
      const CO_ERR err = save(node, *group, is_restore(obj) ? nullptr : memory_of(*group));
      *error = *error == CO_ERR_NONE ? err : *error;
    }
    group = is_all ? groups.next() : nullptr;
  }
  return flags;
}

CO_ERR check(CO_OBJ* obj, CO_NODE* node) {
  return dict::check_type(*obj, *node,
                          is_number_of_groups(*obj) ? rules::parameter_group_number : rules::parameter_group);
}

// Null where checks are switched off.
constexpr CO_OBJ_INIT_FUNC init = USE_DICT_CHECK != 0 ? check : nullptr;

uint32_t size(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  return is_number_of_groups(*obj) ? integer::Number<1>::size(obj, node, width)
                                   : integer::Number<4>::size(obj, node, width);
}

// Reads the operations that the network can execute on the groups of an entry. A group is stored autonomously only in
// an atomic memory: power may fail at any of these stores. [301:7.5.2.13 figure 60]
CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (is_number_of_groups(*obj)) {
    return integer::Number<1>::read(obj, node, buffer, size);
  }
  if (size != sizeof(uint32_t) || uintptr_t{obj->Data} == 0) {
    return CO_ERR_OBJ_SIZE;
  }
  const uint32_t possible = !is_restore(*obj) && port::nvm_has_geometry(*node) ? CO_PARA__AE : CO_PARA___E;
  integer::put_u32(buffer, visit(*node, *obj, nullptr) & possible);
  return CO_ERR_NONE;
}

// Writes a signature to 1010h or 1011h: executes "save" or "load" for each group. Returns the first error.
CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (is_number_of_groups(*obj) || size != sizeof(uint32_t)) {
    return is_number_of_groups(*obj) ? CO_ERR_OBJ_ACC : CO_ERR_OBJ_SIZE;
  }
  const uint32_t signature = is_restore(*obj) ? load_signature : save_signature;
  if (uintptr_t{obj->Data} == 0 || integer::get_u32(buffer) != signature) {
    return CO_ERR_TYPE_WR;
  }
  const budget::Command counted(*node);
  CO_ERR err = CO_ERR_NONE;
  const uint32_t flags = visit(*node, *obj, &err);
  return (flags & CO_PARA___E) != 0 ? err : CO_ERR_TYPE_WR;
}

// Records that date or time in 1020h is not 0: the configuration is verified until an object of a group is written.
// value: that of either sub-index; 0 changes nothing, because the other may still be set
void note_verification(CO_NODE& node, uint32_t value) {
  if (value != 0) {
    node.Storage.OnWrite = on_write;
  }
}

CO_ERR init_verify(CO_OBJ* obj, CO_NODE* node) {
  uint32_t value = 0;
  const CO_ERR err = dict::check_type(*obj, *node, rules::verify_configuration);
  if (err == CO_ERR_NONE && integer::Number<4>::read(obj, node, &value, sizeof value) == CO_ERR_NONE) {
    note_verification(*node, value);
  }
  return err;
}

CO_ERR write_verify(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const CO_ERR err = integer::Number<4>::write(obj, node, buffer, size);
  uint32_t value = 0;
  if (err == CO_ERR_NONE && integer::Number<4>::read(obj, node, &value, sizeof value) == CO_ERR_NONE) {
    note_verification(*node, value);
  }
  return err;
}

// Implements an API function. A reset that is requested during the memory access is executed afterwards.
CO_ERR run(CO_NODE& node, const CO_PARA& group, const uint8_t* data) {
  if (!is_saved_on_command(group)) {
    return CO_ERR_NONE;
  }
  CO_ERR err = CO_ERR_NONE;
  {
    const event::Working working(node);
    err = save(node, group, data);
  }
  event::run_deferred(node);
  return err;
}

}  // namespace
}  // namespace co::para

extern "C" {

// Default callbacks.
WEAK int16_t COParaDefault(CO_PARA*) { return 0; }

WEAK void COParaLost(CO_NODE*, const CO_PARA*) {}

const CO_OBJ_TYPE COTParaStore = {co::para::size, co::para::init, co::para::read, co::para::write, nullptr};
const CO_OBJ_TYPE COTParaRestore = {co::para::size, co::para::init, co::para::read, co::para::write, nullptr};
const CO_OBJ_TYPE COTVerifyConfig = {co::integer::Number<4>::size, co::para::init_verify, co::integer::Number<4>::read,
                                     co::para::write_verify, nullptr};

CO_ERR COParaStore(const CO_PARA* pg, CO_NODE* node) {
  ASSERT_PTR_ERR(pg, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  return co::para::run(*node, *pg, co::para::memory_of(*pg));
}

CO_ERR COParaRestore(const CO_PARA* pg, CO_NODE* node) {
  ASSERT_PTR_ERR(pg, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  return co::para::run(*node, *pg, nullptr);
}

CO_ERR CONodeParaLoad(CO_NODE* node, CO_NMT_RESET type) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  CO_ERR err = CO_ERR_NONE;
  {
    const co::event::Working working(*node);
    err = co::para::load(*node, type, &CO_PARA::Size);
  }
  co::event::run_deferred(*node);
  return err;
}

}  // extern "C"

#endif
