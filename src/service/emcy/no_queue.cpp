// SPDX-License-Identifier: Apache-2.0
// EMCY messages without queue and inhibit time: they are sent at once.
#include "service/emcy/emcy.hpp"

#if USE_EMCY && CO_EMCY_QUEUE_N == 0

#include "base/transmit.hpp"
#include "wire/cob_id.hpp"
#include "wire/emcy.hpp"

namespace co::emcy {

void send_message(CO_NODE& node, const CO_EMCY_MSG& msg) {
  const uint32_t id = identifier(node);
  if (id != wire::no_frame) {
    transmit::send(node, wire::emcy(id, msg));
  }
}

void send_waiting(CO_NODE&) {}

void stop_inhibit_time(CO_NODE&) {}

void withdraw(CO_NODE& node, uint32_t identifier) { transmit::withdraw(node, identifier); }

}  // namespace co::emcy

#endif
