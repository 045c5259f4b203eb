// SPDX-License-Identifier: Apache-2.0
#include "service/pdo/configuration.hpp"

#include "base/error.hpp"
#include "base/events.hpp"
#include "base/timer.hpp"
#include "co_assert.h"
#include "dictionary/types/integer.hpp"
#include "service/pdo/multiplex.hpp"
#include "service/pdo/pdo.hpp"
#include "wire/cob_id.hpp"

namespace co::pdo {

bool is_type(Direction direction, uint8_t type) {
  const bool by_request = type == type_rtr || type == type_rtr_synchronous;
  if (by_request && (direction == Direction::receive || USE_PDO_RTR == 0)) {
    return false;
  }
  return is_synchronous(type) || type >= type_rtr;
}

uint8_t start_value(CO_NODE& node, unsigned number) {
  return static_cast<uint8_t>(read_number(node, CO_DEV(first_tpdo + number, 6), sizeof(uint8_t), 0));
}

uint32_t ticks(const CO_NODE& node, uint32_t time, uint32_t unit) { return tmr::ticks(node, time, unit); }

// Resolves the mapping without a check of flag P: a write by the network checked it, a static mapping needs none.
Resolved resolve(CO_NODE& node, unsigned index, CO_PDO_MAP& map) {
  const unsigned mapping = index + from_communication_to_mapping;
  const unsigned num = read_number(node, CO_DEV(mapping, 0), sizeof(uint8_t), 0);
  return num == 0 ? Resolved{CO_ERR_OBJ_MAP_LEN, 0} : resolve(node, mapping, num, map, MappedBy::designer);
}

namespace {

[[gnu::noinline]] CO_PDO& pdo_at(CO_NODE& node, unsigned index) {
  const bool receives = CO_TPDO_N == 0 || (CO_RPDO_N != 0 && direction_of(index) == Direction::receive);
  const Pdos pdos = receives ? rpdos(node) : tpdos(node);
  CO_ASSERT(number_of(index) < pdos.num &&
            direction_of(index) == (receives ? Direction::receive : Direction::transmit));
  return pdos.first[number_of(index)];
}

void for_each(CO_NODE& node, void (*run)(CO_NODE& node, unsigned index)) {
  for (unsigned number = 0; number != CO_RPDO_N; ++number) {
    run(node, first_rpdo + number);
  }
  for (unsigned number = 0; number != CO_TPDO_N; ++number) {
    run(node, first_tpdo + number);
  }
}

uint32_t read_time(CO_NODE& node, uint32_t key, uint32_t unit) {
  return ticks(node, read_number(node, key, sizeof(uint16_t), 0), unit);
}

void init_one(CO_NODE& node, unsigned index) {
  CO_PDO& pdo = pdo_at(node, index);
  pdo.Node = &node;
  pdo.Number = static_cast<uint16_t>(number_of(index));
  pdo.Map.Flags = 0;
  configure(node, index);
}

// Resolves the mapping of a PDO again. Configures the PDO if it can no longer exist, and if it is or was a multiplex
// PDO, which uses lists of entries, too.
void remap_one(CO_NODE& node, unsigned index) {
  CO_PDO_MAP& map = pdo_at(node, index).Map;
  const bool was_multiplexed = mpdo::is_mpdo(map);
  if (exists(map) && (resolve(node, index, map).err != CO_ERR_NONE || was_multiplexed || mpdo::is_mpdo(map))) {
    configure(node, index);
  }
}

// Returns the sub-index of the communication parameter that prevents the PDO from existing; 0: none.
uint8_t wrong_parameter(Direction direction, uint32_t cob_id, uint8_t type) {
  if (!cob_id::is_free(cob_id)) {
    return 1;
  }
  return is_type(direction, type) ? 0 : 2;
}

// Returns whether the dictionary allows the PDO, and resolves its mapping. Otherwise reports the reason as the node's
// error.
bool may_exist(CO_NODE& node, CO_PDO& pdo, unsigned index, uint32_t cob_id) {
  const Direction direction = direction_of(index);
  const bool receives = direction == Direction::receive;
  const uint8_t parameter = wrong_parameter(direction, cob_id, pdo.Type);
  if (parameter != 0) {
    error::report(node, receives ? CO_ERR_RPDO_COM_OBJ : CO_ERR_TPDO_COM_OBJ, CO_DEV(index, parameter));
    return false;
  }
  const Resolved resolved = resolve(node, index, pdo.Map);
  if (resolved.err == CO_ERR_NONE) {
    return true;
  }
  error::report(node, receives ? CO_ERR_RPDO_MAP_OBJ : CO_ERR_TPDO_MAP_OBJ,
                CO_DEV(index + from_communication_to_mapping, resolved.sub));
  return false;
}

// Reads the communication parameter and the mapping, and starts the PDO if they allow it. Not inlined, because it needs
// much of the CPU's stack, like the functions that end a PDO.
[[gnu::noinline]] void begin(CO_NODE& node, CO_PDO& pdo, unsigned index) {
  const bool receives = direction_of(index) == Direction::receive;
  const uint32_t cob_id = read_number(node, CO_DEV(index, 1), sizeof cob_id, wire::cob_invalid);
  const uint32_t event = read_time(node, CO_DEV(index, 5), CO_TMR_UNIT_1MS);
  uint32_t identifier = wire::no_frame;
  pdo.Type = static_cast<uint8_t>(read_number(node, CO_DEV(index, 2), sizeof pdo.Type, default_type));
  pdo.Map.Length = 0;
  mpdo::clear_mode(pdo.Map);
  __builtin_memset(pdo.Map.Transferred, 0, sizeof pdo.Map.Transferred);
  if ((cob_id & wire::cob_invalid) == 0 && may_exist(node, pdo, index, cob_id)) {
    identifier = wire::frame_id(cob_id);
  }
  if (receives) {
    begin_rpdo(pdo, identifier, event);
    return;
  }
  pdo.Own.Time = {read_time(node, CO_DEV(index, 3), CO_TMR_UNIT_100US), event};
  begin_tpdo(pdo, identifier, (cob_id & CO_TPDO_COBID_REMOTE) == 0 ? Remote::answered : Remote::ignored);
}

}  // namespace

void configure(CO_NODE& node, unsigned index) {
  CO_PDO& pdo = pdo_at(node, index);
  direction_of(index) == Direction::receive ? end_rpdo(node, pdo) : end_tpdo(node, pdo);
  begin(node, pdo, index);
}

void request_configuration(CO_NODE& node, unsigned index) {
  set(pdo_at(node, index).Map, changed);
  event::defer(node, event::configure);
}

namespace {

void configure_if_changed(CO_NODE& node, unsigned index) {
  CO_PDO_MAP& map = pdo_at(node, index).Map;
  if (has(map, changed)) {
    clear(map, changed);
    configure(node, index);
  }
}

}  // namespace

void configure_changed(CO_NODE& node) { for_each(node, configure_if_changed); }

void init(CO_NODE& node) { for_each(node, init_one); }

void take_over(CO_NODE& node, const CO_NODE_SPEC&) {
  const auto own = [&](CO_PDO& pdo) {
    pdo.Node = &node;
    tmr::assign_to_real_time(pdo.Tmr);
  };
  for (CO_PDO& pdo : rpdos(node)) {
    own(pdo);
  }
  for (CO_PDO& pdo : tpdos(node)) {
    own(pdo);
  }
}

void remap(CO_NODE& node) { for_each(node, remap_one); }

}  // namespace co::pdo
