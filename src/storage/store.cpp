// SPDX-License-Identifier: Apache-2.0
#include "storage/store.hpp"

#include "hal/port.hpp"
#include "storage/budget.hpp"
#include "storage/slots.hpp"

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

CO_ERR save_bytes(CO_NODE& node, const Record& record, const uint8_t* data) {
  if (are_stored(node, record, data)) {
    return CO_ERR_NONE;
  }
  if (!budget::take_store(node)) {
    return CO_ERR_OBJ_STATE;
  }
  const bool done = port::nvm_write(node, record.start, const_cast<uint8_t*>(data), record.size) == record.size;
  return done ? CO_ERR_NONE : CO_ERR_IF_NVM_WRITE;
}

Loaded load_bytes(const CO_NODE& node, const Record& record, uint8_t* to, uint32_t size) {
  const Found found = find(node, record);
  const bool is_data = found == Found::data;
  const bool failed = is_data && port::nvm_read(node, record.start, to, size) != size;
  return {failed ? Found::lost : found, false};
}

}  // namespace

bool is_atomic(const CO_NODE& node) { return port::nvm_has_shape(node); }

uint32_t space(const CO_NODE& node, uint32_t size) {
  if (!port::nvm_exists(node)) {
    return 0;
  }
  return port::nvm_has_shape(node) ? slots::space(node, size) : size;
}

Found find(const CO_NODE& node, const Record& record) {
  if (!port::nvm_exists(node)) {
    return Found::blank;
  }
  if (!port::nvm_has_shape(node)) {
    return look_at_bytes(node, record);
  }
  return slots::fits(node, record) ? slots::find(node, record) : Found::no_place;
}

Loaded load(CO_NODE& node, const Record& record, uint8_t* to, uint32_t size) {
  if (!port::nvm_has_shape(node)) {
    return load_bytes(node, record, to, size);
  }
  return slots::fits(node, record) ? slots::load(node, record, to, size) : Loaded{Found::no_place, false};
}

CO_ERR save(CO_NODE& node, const Record& record, const uint8_t* data) {
  if (!port::nvm_exists(node)) {
    return CO_ERR_IF_NVM_WRITE;
  }
  if (!port::nvm_has_shape(node)) {
    return save_bytes(node, record, data);
  }
  return slots::fits(node, record) ? slots::save(node, record, data) : CO_ERR_PARA_STORE;
}

CO_ERR save_defaults(CO_NODE& node, const Record& record) {
  if (!port::nvm_exists(node)) {
    return CO_ERR_IF_NVM_WRITE;
  }
  if (!port::nvm_has_shape(node)) {
    return erase_bytes(node, record);
  }
  return slots::fits(node, record) ? slots::save(node, record, nullptr) : CO_ERR_PARA_STORE;
}

}  // namespace co::store

#endif
