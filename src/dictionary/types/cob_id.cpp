// SPDX-License-Identifier: Apache-2.0
#include "dictionary/types/cob_id.hpp"

#include "dictionary/types/integer.hpp"
#include "wire/cob_id.hpp"

namespace co::cob_id {
namespace {

// Adds by to the CAN-ID of a COB-ID; its flags stay unchanged.
uint32_t shift_id(uint32_t cob_id, uint32_t by) {
  const uint32_t ids = (cob_id & wire::cob_frame) != 0 ? wire::extended_ids : wire::base_ids;
  return (cob_id & ~ids) | ((cob_id + by) & ids);
}

uint32_t node_id_of(const CO_OBJ& obj, const CO_NODE& node) { return CO_IS_NODEID(obj.Key) != 0 ? node.NodeId : 0U; }

bool is_valid(uint32_t cob_id) { return (cob_id & wire::cob_invalid) == 0; }

}  // namespace

// CO_TUNSIGNED32 stores the value. With flag N that type adds the node-ID to the 32 bits as a whole when it reads, and
// subtracts it when it writes, which could change the flags above the CAN-ID. The functions below undo that, and add or
// subtract the node-ID in the CAN-ID alone.

CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  uint32_t shown = 0;
  const CO_ERR err = integer::Number<4>::read(obj, node, &shown, size);
  if (err != CO_ERR_NONE) {
    return err;
  }
  const uint32_t node_id = node_id_of(*obj, *node);
  integer::put_u32(buffer, shift_id(shown - node_id, node_id));
  return CO_ERR_NONE;
}

CO_ERR write(CO_OBJ& obj, CO_NODE& node, const void* buffer, uint32_t size, Permission may) {
  uint32_t before = 0;
  const CO_ERR err = read(&obj, &node, &before, size);
  if (err != CO_ERR_NONE) {
    return err;
  }
  const uint32_t value = integer::get_u32(buffer);
  if (!may(obj, before, value)) {
    return CO_ERR_OBJ_RANGE;
  }
  const uint32_t node_id = node_id_of(obj, node);
  uint32_t shown = shift_id(value, 0U - node_id) + node_id;
  return integer::Number<4>::write(&obj, &node, &shown, size);
}

bool is_free(uint32_t cob_id) {
  const uint32_t id = cob_id & wire::extended_ids;
  const bool restricted = CO_RESTRICTED_IDS == 0 && wire::is_restricted(id);
  return id != 0 && wire::fits_format(cob_id) && !restricted;
}

bool may_replace(uint32_t before, uint32_t value) {
  return !is_valid(value) || value == before || (!is_valid(before) && is_free(value));
}

}  // namespace co::cob_id
