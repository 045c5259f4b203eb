// SPDX-License-Identifier: Apache-2.0
// Transmission of TPDOs, as far as multiplex PDOs share it.
#pragma once

#include "base/events.hpp"
#include "service/pdo/mapping.hpp"

namespace co::pdo {

// Bits of CO_PDO_MAP.Flags of a TPDO, in addition to those of plan.hpp.
enum TpdoFlag : uint8_t {
  pending = 0x01,    // an event is deferred until the inhibit time has elapsed, or until the SYNC
  inhibited = 0x02,  // event-driven: the inhibit time is running
  sampled = 0x04,    // synchronous: Data holds the sample of the last SYNC
  waiting = 0x08,    // Count holds the SYNC start value, which was not reached yet; else Count is the number of SYNCs
  remote = 0x10,     // remote requests are allowed
  marked = 0x20,     // send_marked() triggers the PDO
};

// Cause of a transmission: the event time after it starts now, or at the expiry of the timer, so that it does not
// drift.
enum class Cause : uint8_t { event, timer };

[[nodiscard]] inline bool is_operational(const CO_NODE& node) { return event::is_allowed(node, CO_PDO_ALLOWED); }

// Sends an event-driven PDO. On an error nothing is sent later, but the event timer is restarted. Events for this PDO
// from its own callbacks are ignored while it is being sent.
CO_ERR send_event(CO_TPDO& pdo, Cause cause);

// Restarts the inhibit or event time of a PDO that was sent by an event.
void restart(CO_TPDO& pdo);

}  // namespace co::pdo
