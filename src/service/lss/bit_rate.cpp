// SPDX-License-Identifier: Apache-2.0
#include "service/lss/bit_rate.hpp"

#if USE_LSS || USE_LSS_MASTER

#include "base/routes.hpp"
#include "hal/port.hpp"

namespace co::lss {

void take_bit_rate(CO_NODE& node, uint32_t rate) {
  node.Baudrate = rate;
  port::can_close(node);
  port::can_init(node);
  routes::publish(node);
  port::can_enable(node, rate);
}

}  // namespace co::lss

#endif
