// SPDX-License-Identifier: Apache-2.0
// Records in a memory whose driver has no Shape function: bytes without header, as in CANopen-Stack.
#include "hal/port.hpp"
#include "storage/budget.hpp"
#include "storage/store.hpp"

#if USE_PARA

namespace co::store {
namespace {

constexpr uint8_t erased = 0xFF;

// Calls function(offset, bytes) for each piece of a record, until it returns false. Returns whether no call has
// returned false.
template <class Function>
bool for_pieces(uint32_t size, Function function) {
  for (uint32_t done = 0; done < size;) {
    const uint32_t rest = size - done;
    const uint32_t piece = rest < CO_STORE_BUFFER ? rest : CO_STORE_BUFFER;
    if (!function(done, piece)) {
      return false;
    }
    done += piece;
  }
  return true;
}

bool is_erased(const uint8_t* bytes, uint32_t num) {
  uint32_t n = 0;
  while (n < num && bytes[n] == erased) {
    ++n;
  }
  return n == num;
}

// Returns what the memory holds for a record without header. FFh throughout means that nothing was stored.
Found look_at_bytes(const CO_NODE& node, const Record& record) {
  uint8_t buffer[CO_STORE_BUFFER];
  Found found = Found::blank;
  for_pieces(record.size, [&](uint32_t from, uint32_t num) {
    const bool readable = port::nvm_read(node, record.start + from, buffer, num) == num;
    found = !readable ? Found::lost : (is_erased(buffer, num) ? found : Found::data);
    return found == Found::blank;
  });
  return found;
}

// Fills a record with FFh, unless it contains FFh throughout already.
CO_ERR erase_bytes(CO_NODE& node, const Record& record) {
  if (look_at_bytes(node, record) == Found::blank) {
    return CO_ERR_NONE;
  }
  if (!budget::take_store(node)) {
    return CO_ERR_OBJ_STATE;
  }
  uint8_t buffer[CO_STORE_BUFFER];
  __builtin_memset(buffer, erased, sizeof buffer);
  const bool done = for_pieces(record.size, [&](uint32_t from, uint32_t num) {
    return port::nvm_write(node, record.start + from, buffer, num) == num;
  });
  return done ? CO_ERR_NONE : CO_ERR_IF_NVM_WRITE;
}

bool are_stored(const CO_NODE& node, const Record& record, const uint8_t* data) {
  uint8_t buffer[CO_STORE_BUFFER];
  return for_pieces(record.size, [&](uint32_t from, uint32_t num) {
    return port::nvm_read(node, record.start + from, buffer, num) == num && slots::is_same(buffer, data + from, num);
  });
}

CO_ERR save_bytes(CO_NODE& node, const Record& record, const uint8_t* data, Cause) {
  if (!port::nvm_exists(node)) {
    return CO_ERR_IF_NVM_WRITE;
  }
  if (data == nullptr) {
    return erase_bytes(node, record);
  }
  if (are_stored(node, record, data)) {
    return CO_ERR_NONE;
  }
  if (!budget::take_store(node)) {
    return CO_ERR_OBJ_STATE;
  }
  const bool done = port::nvm_write(node, record.start, const_cast<uint8_t*>(data), record.size) == record.size;
  return done ? CO_ERR_NONE : CO_ERR_IF_NVM_WRITE;
}

Found load_bytes(CO_NODE& node, const Record& record, Target& target) {
  const Found found = port::nvm_exists(node) ? look_at_bytes(node, record) : Found::blank;
  const bool is_data = found == Found::data;
  const bool failed = is_data && port::nvm_read(node, record.start, target.to, target.size) != target.size;
  return failed ? Found::lost : found;
}

}  // namespace

const CO_STORE_T bytes = {load_bytes, save_bytes};

namespace {

Found load_nothing(CO_NODE&, const Record&, Target&) { return Found::blank; }

CO_ERR refuse(CO_NODE&, const Record&, const uint8_t*, Cause) { return CO_ERR_IF_NVM_WRITE; }

constexpr CO_STORE_T none = {load_nothing, refuse};  // the node has no memory that can store groups

}  // namespace

const CO_STORE_T& of(const CO_NODE& node) {
  if (port::nvm_has_geometry(node)) {
    return slots::store;
  }
  return node.If.Raw != nullptr ? *node.If.Raw : none;
}

uint32_t space(CO_NODE& node, const Record& record) {
  if (port::nvm_has_geometry(node)) {
    return slots::space(node, record);
  }
  return node.If.Raw != nullptr && port::nvm_exists(node) ? record.size : 0;
}

}  // namespace co::store

#endif
