// SPDX-License-Identifier: Apache-2.0
// Functions of rpdo.cpp for configurations without RPDOs.
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
