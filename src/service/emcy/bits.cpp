// SPDX-License-Identifier: Apache-2.0
// Error status bits: an octet string with a bit for each error. Linked where a dictionary has an object of its type.
#include "service/emcy/emcy.hpp"

#if USE_EMCY

#include "base/events.hpp"
#include "dictionary/types/stream.hpp"

namespace co::emcy {
namespace {

constexpr uint32_t stack_bytes = 2;

// Returns the bytes with errors of the application.
uint32_t application_bytes(const CO_EMCY_BITS& bits, const CO_NODE& node) {
  return bits.Size != 0 ? bits.Size : (table_length(node.Emcy) + 7U) / 8U;
}

uint8_t stack_byte(const CO_EMCY& emcy, uint32_t byte) {
  uint32_t set = 0;
  for (uint32_t fault = 0; fault < CO_EMCY_FAULT_N; ++fault) {
    set |= emcy.Fault[fault] != 0 ? 1U << fault : 0U;
  }
  return static_cast<uint8_t>(set >> (8 * byte));
}

uint8_t byte_at(const CO_EMCY& emcy, uint32_t application, uint32_t byte) {
  if (byte >= application) {
    return stack_byte(emcy, byte - application);
  }
  return byte < sizeof emcy.Err ? emcy.Err[byte] : uint8_t{0};
}

uint32_t size_of_bits(CO_OBJ* obj, CO_NODE* node, uint32_t) {
  const auto* const bits = data_of<const CO_EMCY_BITS>(*obj);
  if (bits == nullptr) {
    return 0;
  }
  return application_bytes(*bits, *node) + (bits->Stack != 0 ? stack_bytes : 0);
}

CO_ERR read_bits(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t length) {
  auto* const bits = data_of<CO_EMCY_BITS>(*obj);
  if (bits == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const uint32_t application = application_bytes(*bits, *node);
  auto* to = static_cast<uint8_t*>(buffer);
  for (uint32_t n = stream::clip(length, bits->Offset, size_of_bits(obj, node, 0)); n != 0; --n) {
    *to++ = byte_at(node->Emcy, application, bits->Offset++);
  }
  return CO_ERR_NONE;
}

// Triggers the TPDOs of all objects of the type.
void trigger(CO_NODE* node) {
  for (uint16_t entry = 0; entry < node->Dict.Num; ++entry) {
    const CO_OBJ& obj = node->Dict.Root[entry];
    if (obj.Type == &COTEmcyBits) {
      event::change_object(*node, obj);
    }
  }
}

CO_ERR init_bits(CO_OBJ* obj, CO_NODE* node) {
  node->Emcy.ShowBits = trigger;
  return stream::init(obj, node);
}

}  // namespace

}  // namespace co::emcy

extern "C" const CO_OBJ_TYPE COTEmcyBits = {co::emcy::size_of_bits, co::emcy::init_bits, co::emcy::read_bits, nullptr,
                                            co::stream::reset};

#endif
