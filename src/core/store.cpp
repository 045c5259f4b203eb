// SPDX-License-Identifier: Apache-2.0
#include "core/store.hpp"

#include "core/port.hpp"
#include "core/slots.hpp"

#if USE_PARA

namespace co::store {
namespace {

constexpr uint8_t erased = 0xFF;

// Calls function(offset, bytes) for pieces of a record, until it says false.
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

// Without a shape: FFh everywhere is a memory in which nothing was stored.
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

CO_ERR erase_bytes(const CO_NODE& node, const Record& record) {
  uint8_t buffer[CO_STORE_BUFFER];
  __builtin_memset(buffer, erased, sizeof buffer);
  const bool done = for_pieces(record.size, [&](uint32_t from, uint32_t num) {
    return port::nvm_write(node, record.start + from, buffer, num) == num;
  });
  return done ? CO_ERR_NONE : CO_ERR_IF_NVM_WRITE;
}

CO_ERR save_bytes(const CO_NODE& node, const Record& record, const uint8_t* data) {
  const bool done = port::nvm_write(node, record.start, const_cast<uint8_t*>(data), record.size) == record.size;
  return done ? CO_ERR_NONE : CO_ERR_IF_NVM_WRITE;
}

}  // namespace

bool is_never_torn(const CO_NODE& node) { return port::nvm_has_shape(node); }

Found look(const CO_NODE& node, const Record& record) {
  if (!port::nvm_exists(node)) {
    return Found::blank;
  }
  if (!port::nvm_has_shape(node)) {
    return look_at_bytes(node, record);
  }
  return slots::fits(node, record) ? slots::look(node, record) : Found::no_place;
}

Found load(const CO_NODE& node, const Record& record, uint8_t* to, uint32_t size) {
  if (port::nvm_has_shape(node)) {
    return slots::fits(node, record) ? slots::load(node, record, to, size) : Found::no_place;
  }
  const Found found = look(node, record);
  const bool is_data = found == Found::data;
  return is_data && port::nvm_read(node, record.start, to, size) != size ? Found::lost : found;
}

CO_ERR save(const CO_NODE& node, const Record& record, const uint8_t* data) {
  if (!port::nvm_has_shape(node)) {
    return save_bytes(node, record, data);
  }
  return slots::fits(node, record) ? slots::save(node, record, data) : CO_ERR_PARA_STORE;
}

CO_ERR save_defaults(const CO_NODE& node, const Record& record) {
  if (!port::nvm_has_shape(node)) {
    return erase_bytes(node, record);
  }
  return slots::fits(node, record) ? slots::save(node, record, nullptr) : CO_ERR_PARA_STORE;
}

}  // namespace co::store

#endif
