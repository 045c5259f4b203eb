// SPDX-License-Identifier: Apache-2.0
// INTEGERn and UNSIGNEDn of 8, 16 and 32 bits, REAL32 and BOOLEAN: values in a variable of 1, 2 or 4 bytes, or in the
// entry.
#include "dictionary/types/integer.hpp"

#include "co_number.h"
#include "dictionary/dict.hpp"
#include "dictionary/types/number.hpp"

namespace co::integer {
namespace {

// Reads a number of 1, 2 or 4 bytes from a variable of the same size; with flag N the node-ID is added.
[[gnu::noinline]] CO_ERR read_number(CO_OBJ& obj, const CO_NODE& node, void* buffer, unsigned bytes) {
  const void* const address = address_of_value(obj, bytes);
  if (address == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  store(buffer, load<uint32_t>(address, bytes) + node_id_of(obj, node), bytes);
  return CO_ERR_NONE;
}

// Writes a number of 1, 2 or 4 bytes; with flag N the node-ID is subtracted.
[[gnu::noinline]] CO_ERR write_number(CO_OBJ& obj, CO_NODE& node, const void* buffer, unsigned bytes) {
  const uint32_t value = load<uint32_t>(buffer, bytes) - node_id_of(obj, node);
  return set_value<uint32_t>(obj, node, value & (UINT32_MAX >> (32U - 8U * bytes)), bytes);
}

}  // namespace

template <uint8_t bytes>
uint32_t Number<bytes>::size(CO_OBJ* obj, CO_NODE*, uint32_t) {
  return address_of_value(*obj, bytes) == nullptr ? 0 : bytes;
}
template <uint8_t bytes>
CO_ERR Number<bytes>::read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return size == bytes ? read_number(*obj, *node, buffer, size) : CO_ERR_BAD_ARG;
}
template <uint8_t bytes>
CO_ERR Number<bytes>::write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return size == bytes ? write_number(*obj, *node, buffer, size) : CO_ERR_BAD_ARG;
}
template struct Number<1>;
template struct Number<2>;
template struct Number<4>;

namespace {

template <uint8_t bytes>
inline constexpr rules::Rule rule = rules::integer(bytes);

template <uint8_t bytes>
constexpr CO_OBJ_TYPE table = {Number<bytes>::size, dict::checked_by<rule<bytes>>, Number<bytes>::read,
                               Number<bytes>::write, nullptr};

using Byte = Number<1>;
using Real32 = Number<4>;

CO_ERR write_boolean(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (size == 1 && *static_cast<const uint8_t*>(buffer) > 1) {
    return CO_ERR_OBJ_RANGE;
  }
  return Byte::write(obj, node, buffer, size);
}

}  // namespace

uint16_t get_u16(const void* from) { return static_cast<uint16_t>(load<uint32_t>(from, sizeof(uint16_t))); }
uint32_t get_u32(const void* from) { return load<uint32_t>(from, sizeof(uint32_t)); }
void put_u32(void* to, uint32_t value) { store(to, value, sizeof value); }

}  // namespace co::integer

using namespace co;
using namespace co::integer;

extern "C" {

const CO_OBJ_TYPE COTInt8 = table<1>;
const CO_OBJ_TYPE COTInt16 = table<2>;
const CO_OBJ_TYPE COTInt32 = table<4>;
// The rules of these types refuse flag N, which has no meaning for them.
const CO_OBJ_TYPE COTReal32 = {Real32::size, dict::checked_by<rules::variable>, Real32::read, Real32::write, nullptr};
const CO_OBJ_TYPE COTBoolean = {Byte::size, dict::checked_by<rules::boolean>, Byte::read, write_boolean, nullptr};

}  // extern "C"
