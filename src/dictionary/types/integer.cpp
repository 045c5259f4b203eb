// SPDX-License-Identifier: Apache-2.0
// INTEGERn and UNSIGNEDn of 8, 16 and 32 bits, REAL32 and BOOLEAN: values in a variable of 1, 2 or 4 bytes, or in the
// entry.
#include "dictionary/types/integer.hpp"

#include "co_core.h"
#include "co_number.h"
#include "dictionary/dict.hpp"
#include "dictionary/parameter.hpp"
#include "dictionary/types/number.hpp"
#include "wire/cob_id.hpp"

namespace co::integer {
namespace {

// Adds the node-ID, or its negative, to a number, modulo its width; in a COB-ID to the CAN-ID, the flags are kept.
[[gnu::noinline]] uint32_t add_node_id(uint32_t number, uint32_t node_id, unsigned format) {
  uint32_t changed = UINT32_MAX >> (32U - 8U * bytes_of(format));
  if (format == cob_id) {
    changed = (number & wire::cob_frame) != 0 ? wire::extended_ids : wire::base_ids;
  }
  return (number & ~changed) | ((number + node_id) & changed);
}

// Returns the number at the address of an entry's value, as the network sees it: with flag N the node-ID is added.
inline uint32_t value_at(const void* address, unsigned bytes, const CO_OBJ& obj, const CO_NODE& node, unsigned format) {
  const uint32_t stored = load<uint32_t>(address, bytes);
  return CO_IS_NODEID(obj.Key) != 0 ? add_node_id(stored, node.NodeId, format) : stored;
}

[[gnu::noinline]] CO_ERR read_number(CO_OBJ& obj, const CO_NODE& node, void* buffer, unsigned format) {
  const unsigned bytes = bytes_of(format);
  const void* const address = address_of_value(obj, bytes);
  if (address == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  store(buffer, value_at(address, bytes, obj, node, format), bytes);
  return CO_ERR_NONE;
}

}  // namespace

template <uint8_t format>
uint32_t Number<format>::size(CO_OBJ* obj, CO_NODE*, uint32_t) {
  return address_of_value(*obj, bytes_of(format)) == nullptr ? 0 : bytes_of(format);
}
template <uint8_t format>
CO_ERR Number<format>::read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return size == bytes_of(format) ? read_number(*obj, *node, buffer, format) : CO_ERR_BAD_ARG;
}
template <uint8_t format>
CO_ERR Number<format>::write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return integer::write(obj, node, buffer, size, format, nullptr);
}
template struct Number<1>;
template struct Number<2>;
template struct Number<4>;
template struct Number<cob_id>;

CO_ERR write(CO_OBJ* obj, CO_NODE* node, const void* buffer, uint32_t size, unsigned format,
             const Parameter* parameter) {
  if (size != bytes_of(format)) {
    return CO_ERR_BAD_ARG;
  }
  void* const address = address_of_value(*obj, size);
  if (address == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  uint32_t before = 0;
  const uint32_t value = load<uint32_t>(buffer, size);
  CO_ERR err = CO_ERR_NONE;
  if (parameter != nullptr) {
    before = value_at(address, size, *obj, *node, format);
    err = parameter->may(*node, *obj, value, before);
  }
  if (err == CO_ERR_NONE) {
    const uint32_t stored = CO_IS_NODEID(obj->Key) != 0 ? add_node_id(value, 0U - node->NodeId, format) : value;
    err = set_value<uint32_t>(*obj, *node, address, stored, size);
  }
  if (err == CO_ERR_NONE && parameter != nullptr && parameter->apply != nullptr) {
    parameter->apply(*node, *obj, value, before);
  }
  return err;
}

namespace {

template <uint8_t bytes>
inline constexpr rules::Rule rule = rules::integer(bytes);

template <uint8_t bytes>
constexpr CO_OBJ_TYPE table = {Number<bytes>::size, dict::checked_by<rule<bytes>>, Number<bytes>::read,
                               Number<bytes>::write, nullptr};

using Real32 = Number<4>;

}  // namespace

uint32_t get_u32(const void* from) { return load<uint32_t>(from, sizeof(uint32_t)); }
void put_u32(void* to, uint32_t value) { store(to, value, sizeof value); }

}  // namespace co::integer

extern "C" {

const CO_OBJ_TYPE COTInt8 = co::integer::table<1>;
const CO_OBJ_TYPE COTInt16 = co::integer::table<2>;
const CO_OBJ_TYPE COTInt32 = co::integer::table<4>;
// The rules of these types refuse flag N, which has no meaning for them.
const CO_OBJ_TYPE COTReal32 = {co::integer::Real32::size, co::dict::checked_by<co::rules::variable>,
                               co::integer::Real32::read, co::integer::Real32::write, nullptr};
const CO_OBJ_TYPE COTBoolean = co::parameter<1, co::rules::boolean, co::at_most<1>>;

}  // extern "C"

namespace co::cob_id {

uint32_t identifier(uint32_t cob_id) { return wire::is_usable(cob_id) ? wire::frame_id(cob_id) : wire::no_frame; }

bool is_free(uint32_t cob_id) {
  const uint32_t id = cob_id & wire::extended_ids;
  const bool restricted = CO_RESTRICTED_IDS == 0 && wire::is_restricted(id);
  return id != 0 && wire::fits_format(cob_id) && !restricted;
}

bool may_replace(uint32_t before, uint32_t value) {
  return !wire::is_valid(value) || value == before || (!wire::is_valid(before) && is_free(value));
}

}  // namespace co::cob_id
