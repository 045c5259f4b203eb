// SPDX-License-Identifier: Apache-2.0
// Functions of rpdo.cpp and tpdo.cpp for configurations without RPDOs or without TPDOs.
#include "service/pdo/configuration.hpp"
#include "service/pdo/pdo.hpp"

#if CO_RPDO_N == 0

namespace co::pdo {

void end_rpdo(CO_NODE&, CO_PDO&) {}
void begin_rpdo(CO_PDO&, uint32_t, uint32_t) {}
void change_deadline(CO_NODE&, unsigned, uint32_t) {}
bool was_received(CO_NODE&, uint16_t) { return false; }
bool was_received(CO_NODE&, const CO_OBJ&) { return false; }

}  // namespace co::pdo

#endif

#if CO_TPDO_N == 0

namespace co::pdo {

void end_tpdo(CO_NODE&, CO_PDO&) {}
void begin_tpdo(CO_PDO&, uint32_t, Remote) {}
void change_event_time(CO_NODE&, unsigned, uint32_t) {}
CO_ERR request(CO_NODE&, uint16_t) { return CO_ERR_TPDO_NUM_TRIGGER; }
CO_ERR request_object(CO_NODE&, const CO_OBJ&) { return CO_ERR_TPDO_OBJ_TRIGGER; }
bool was_sent(CO_NODE&, uint16_t) { return false; }
bool was_sent(CO_NODE&, const CO_OBJ&) { return false; }

}  // namespace co::pdo

#endif
