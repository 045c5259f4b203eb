// SPDX-License-Identifier: Apache-2.0
// Functions of producer.cpp for configurations without TPDOs.
#include "service/mpdo/mpdo.hpp"

#if USE_MPDO && CO_TPDO_N == 0

namespace co::mpdo {

CO_ERR send_to(CO_NODE&, uint16_t, uint8_t, uint32_t, uint32_t) { return CO_ERR_TPDO_NUM_TRIGGER; }

}  // namespace co::mpdo

#endif
