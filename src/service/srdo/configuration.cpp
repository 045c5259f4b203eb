// SPDX-License-Identifier: Apache-2.0
#include "service/srdo/configuration.hpp"

#include "base/events.hpp"
#include "base/timer.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "dictionary/lock.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/stream.hpp"
#include "lexican/srdo.hpp"
#include "wire/bytes.hpp"
#include "wire/cob_id.hpp"
#include "wire/srdo.hpp"

#if CO_SRDO_N > 0

namespace co::srdo {
namespace {

constexpr uint16_t no_entry = 0xFFFF;
constexpr unsigned all_bytes = 8;  // of a frame

// Lengths of the static data types INTEGER8, 16, 32 and UNSIGNED8, 16, 32, from index 0002h on. [301:7.4.1 table 44]
constexpr uint8_t placeholder_bits[] = {8, 16, 32, 8, 16, 32};

bool is_placeholder(uint32_t mapping) {
  constexpr unsigned first = 0x0002;
  const unsigned number = CO_GET_IDX(mapping) - first;
  return number < sizeof placeholder_bits && mapping == CO_LINK(first + number, 0, placeholder_bits[number]);
}

constexpr unsigned index_of(unsigned first, unsigned number) { return first + number; }

uint32_t communication(CO_NODE& node, unsigned number, uint8_t sub, uint32_t width) {
  return dict::read_number(node, CO_DEV(index_of(first_communication, number), sub), width, 0);
}

struct Communication {
  Parameter parameter;
  uint8_t type;
};

Communication read_communication(CO_NODE& node, unsigned number) {
  Communication read{};
  read.parameter.direction = direction_of(node, number);
  read.parameter.cycle = static_cast<uint16_t>(communication(node, number, 2, sizeof(uint16_t)));
  read.parameter.validation = static_cast<uint8_t>(communication(node, number, 3, sizeof(uint8_t)));
  read.type = static_cast<uint8_t>(communication(node, number, 4, sizeof(uint8_t)));
  read.parameter.plain_id = communication(node, number, 5, sizeof(uint32_t));
  read.parameter.inverse_id = communication(node, number, 6, sizeof(uint32_t));
  return read;
}

uint8_t number_of_mapped(CO_NODE& node, unsigned number) {
  return static_cast<uint8_t>(dict::read_number(node, CO_DEV(index_of(first_mapping, number), 0), sizeof(uint8_t), 0));
}

uint32_t read_mapping(CO_NODE& node, unsigned number, uint8_t sub) {
  return dict::read_number(node, CO_DEV(index_of(first_mapping, number), sub), sizeof(uint32_t), 0);
}

// Returns whether a time is in the range of the timer, with the tick that is added to it.
bool is_time(uint32_t ticks) { return ticks != 0 && ticks < UINT32_MAX; }

// Returns whether the producer can send its pair, with the gap, within the refresh time.
bool has_gap(const CO_NODE& node, const CO_SRDO& srdo) {
  return srdo.Direction != CO_SRDO_TX || CO_SRDO_GAP == 0 || tmr::ticks(node, CO_SRDO_GAP, unit_us) < srdo.Cycle;
}

// Returns whether another SRDO that has been checked uses the identifiers.
bool is_used(const CO_NODE& node, unsigned number) {
  for (unsigned other = 0; other < number; ++other) {
    if (node.Srdo[other].Identifier[0] == node.Srdo[number].Identifier[0]) {
      return true;
    }
  }
  return false;
}

// Checks the communication parameter and applies it. Returns the sub-index with the fault; 0: none.
uint8_t apply_communication(CO_NODE& node, unsigned number, const Communication& read) {
  CO_SRDO& srdo = node.Srdo[number];
  const Parameter& parameter = read.parameter;
  const uint32_t values[] = {parameter.direction, parameter.cycle,    parameter.validation,
                             read.type,           parameter.plain_id, parameter.inverse_id};
  uint8_t sub = 0;
  for (const uint32_t value : values) {
    if (!is_parameter(++sub, value)) {
      return sub;
    }
  }
  if (parameter.inverse_id != parameter.plain_id + 1) {
    return 6;
  }
  srdo.Direction = parameter.direction;
  srdo.Cycle = tmr::ticks(node, parameter.cycle, CO_TMR_UNIT_1MS);
  srdo.Validation = tmr::ticks(node, parameter.validation, CO_TMR_UNIT_1MS);
  if (!is_time(srdo.Cycle) || !has_gap(node, srdo)) {
    return 2;
  }
  if (!is_time(srdo.Validation)) {
    return 3;
  }
  srdo.Identifier[0] = parameter.plain_id;
  srdo.Identifier[1] = parameter.inverse_id;
  return is_used(node, number) ? 5 : 0;
}

uint32_t rights_of(uint8_t direction) {
  return CO_OBJ____P__ | (direction == CO_SRDO_TX ? CO_OBJ_____R_ : CO_OBJ______W);
}

// Returns whether the type of an object has the functions for these rights.
bool has_functions(const CO_OBJ& obj, uint32_t rights) {
  return (CO_IS_READ(rights) == 0 || obj.Type->Read != nullptr) &&
         (CO_IS_WRITE(rights) == 0 || obj.Type->Write != nullptr);
}

// Resolves a mapping entry, which is the next one of the SRDO. Returns whether it is allowed.
bool add_mapped(CO_NODE& node, CO_SRDO& srdo, uint32_t mapping) {
  if (check_mapping(node, mapping, rights_of(srdo.Direction)) != CO_ERR_NONE) {
    return false;
  }
  const uint8_t slot = srdo.Num++;
  const CO_OBJ* const obj = is_placeholder(mapping) ? nullptr : dict::find(node, mapping);
  srdo.Entry[slot] = obj == nullptr ? no_entry : static_cast<uint16_t>(obj - node.Dict.Root);
  srdo.Bytes[slot] = static_cast<uint8_t>((mapping & 0xFFU) / 8);
  if (slot % 2 == 0) {
    srdo.Length = static_cast<uint8_t>(srdo.Length + srdo.Bytes[slot]);
    return srdo.Length <= all_bytes;
  }
  return srdo.Bytes[slot] == srdo.Bytes[slot - 1];
}

// Resolves the mapping. Returns the key of the object with the fault; 0: none.
uint32_t resolve(CO_NODE& node, unsigned number) {
  CO_SRDO& srdo = node.Srdo[number];
  const uint8_t mapped = number_of_mapped(node, number);
  srdo.Num = 0;
  srdo.Length = 0;
  if (mapped == 0 || mapped > CO_SRDO_MAP_N || mapped % 2 != 0) {
    return CO_DEV(index_of(first_mapping, number), 0);
  }
  for (uint8_t sub = 1; sub <= mapped; ++sub) {
    if (!add_mapped(node, srdo, read_mapping(node, number, sub))) {
      return CO_DEV(index_of(first_mapping, number), sub);
    }
  }
  return 0;
}

uint32_t key_of_signature(unsigned number) { return CO_DEV(signatures, number + 1); }

bool has_signature(CO_NODE& node, unsigned number) {
  constexpr uint32_t no_signature = UINT16_MAX + 1U;
  uint16_t expected = 0;
  return compute_signature(node, number, expected) == CO_ERR_NONE &&
         dict::read_number(node, key_of_signature(number), sizeof expected, no_signature) == expected;
}

// Reads or writes a mapped object. data: its bytes in the order of the bus
CO_ERR access(CO_NODE& node, CO_OBJ& obj, uint8_t direction, uint8_t* data, uint8_t bytes) {
  const uint32_t number = obj::is_stream(obj) ? 0 : bytes;
  if (direction == CO_SRDO_RX) {
    wire::swap_host(data, number);
    return obj::access_whole(obj, node, obj.Type->Write, data, bytes);
  }
  const CO_ERR err = obj::access_whole(obj, node, obj.Type->Read, data, bytes);
  wire::swap_host(data, number);
  return err;
}

// Reads or writes the mapped objects of the plain and of the inverse frame. Type functions may end the SRDO or replace
// the dictionary.
CO_ERR access_all(CO_NODE& node, const CO_SRDO& srdo, uint8_t* const (&data)[2]) {
  const dict::Lock lock(node);
  unsigned position[2] = {0, 0};
  for (unsigned slot = 0; slot < srdo.Num; ++slot) {
    if ((srdo.Flags & accessing) == 0) {
      return CO_ERR_OBJ_STATE;
    }
    const unsigned frame = slot % 2;
    uint8_t* const bytes = data[frame] + position[frame];
    position[frame] += srdo.Bytes[slot];
    CO_ASSERT(position[frame] <= all_bytes);
    if (srdo.Entry[slot] == no_entry) {
      __builtin_memset(bytes, frame == 0 ? 0 : UINT8_MAX, srdo.Bytes[slot]);
      continue;
    }
    CO_ASSERT(srdo.Entry[slot] < node.Dict.Num);
    const CO_ERR err = access(node, node.Dict.Root[srdo.Entry[slot]], srdo.Direction, bytes, srdo.Bytes[slot]);
    if (err != CO_ERR_NONE) {
      return err;
    }
  }
  return CO_ERR_NONE;
}

}  // namespace

uint8_t direction_of(CO_NODE& node, unsigned number) {
  return static_cast<uint8_t>(communication(node, number, 1, sizeof(uint8_t)));
}

bool is_parameter(uint8_t sub, uint32_t value) {
  switch (sub) {
    case 1: return value <= CO_SRDO_RX;
    case 2:
    case 3: return value != 0;
    case 4: return value == CO_SRDO_TYPE;
    case 5: return wire::is_srdo_plain_id(value);
    default: return wire::is_srdo_inverse_id(value);
  }
}

CO_ERR check_mapping(CO_NODE& node, uint32_t mapping, uint32_t rights) {
  const uint32_t bits = mapping & 0xFFU;
  if (is_placeholder(mapping)) {
    return CO_ERR_NONE;
  }
  if (bits == 0 || bits % 8 != 0 || bits > 8 * all_bytes) {
    return CO_ERR_OBJ_RANGE;
  }
  CO_OBJ* const obj = dict::find(node, mapping);
  if (obj == nullptr) {
    return CO_ERR_OBJ_NOT_FOUND;
  }
  const uint32_t bytes = bits / 8;
  const bool is_mappable = (obj->Key & rights) == rights && has_functions(*obj, rights);
  return is_mappable && obj::size(*obj, node, obj::is_stream(*obj) ? 0 : bytes) == bytes ? CO_ERR_NONE
                                                                                         : CO_ERR_OBJ_MAP_TYPE;
}

uint32_t configure(CO_NODE& node, unsigned number) {
  CO_ASSERT(number < CO_SRDO_N);
  const uint8_t sub = apply_communication(node, number, read_communication(node, number));
  if (sub != 0) {
    return CO_DEV(index_of(first_communication, number), sub);
  }
  return has_signature(node, number) ? resolve(node, number) : key_of_signature(number);
}

bool is_valid(CO_NODE& node) {
  return dict::read_number(node, key_valid, sizeof(uint8_t), 0) == CO_SRDO_CONFIGURATION_VALID;
}

// Writes 13FEh without the check of the NMT state. An entry that may be in read-only memory is not written.
void invalidate(CO_NODE& node) {
  uint8_t none = 0;
  CO_OBJ* const obj = dict::find(node, key_valid);
  if (obj == nullptr || (CO_IS_DIRECT(obj->Key) != 0 && CO_IS_WRITE(obj->Key) == 0)) {
    return;
  }
  (void)(obj->Type == CO_TSRDO_VALID ? COTInt8.Write(obj, &node, &none, sizeof none)
                                     : obj::write(*obj, node, &none, sizeof none));
}

CO_ERR compute_signature(CO_NODE& node, unsigned number, uint16_t& signature) {
  if (dict::find(node, CO_DEV(index_of(first_communication, number), 1)) == nullptr) {
    return CO_ERR_OBJ_NOT_FOUND;
  }
  const uint8_t mapped = number_of_mapped(node, number);
  if (mapped > CO_SRDO_MAP_N) {
    return CO_ERR_OBJ_MAP_LEN;
  }
  signature = begin_signature(read_communication(node, number).parameter, mapped);
  for (uint8_t sub = 1; sub <= mapped; ++sub) {
    signature = add_mapping(signature, sub, read_mapping(node, number, sub));
  }
  return CO_ERR_NONE;
}

CO_ERR read_objects(CO_NODE& node, const CO_SRDO& srdo, uint8_t* plain, uint8_t* inverse) {
  return access_all(node, srdo, {plain, inverse});
}

CO_ERR write_objects(CO_NODE& node, const CO_SRDO& srdo, uint8_t* plain, uint8_t* inverse) {
  return access_all(node, srdo, {plain, inverse});
}

}  // namespace co::srdo

#endif
