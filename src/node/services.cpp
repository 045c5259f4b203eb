// SPDX-License-Identifier: Apache-2.0
#include "node/services.hpp"

#include "core/count.hpp"
#include "core/events.hpp"
#include "core/port.hpp"
#include "core/routes.hpp"
#include "core/transmit.hpp"
#include "service/heartbeat/heartbeat.hpp"
#include "service/nmt/nmt.hpp"
#include "service/sdo_client/sdo_client.hpp"
#include "service/sdo_server/sdo_server.hpp"
#include "wire/cob_id.hpp"

namespace co {
namespace {

constexpr Service table[] = {
    {CO_NMT_ALLOWED, 0, nmt::init, nmt::on_frame, nullptr, nullptr, nullptr},
    {CO_SDO_ALLOWED, CO_SSDO_N, sdo_server::init, sdo_server::on_frame, sdo_server::on_mode, sdo_server::on_free,
     sdo_server::configure},
    {CO_NMT_ALLOWED, 0, nullptr, nullptr, heartbeat::on_mode, nullptr, nullptr},
#if USE_CSDO
    {CO_SDO_ALLOWED, CO_CSDO_N, sdo_client::init, sdo_client::on_frame, sdo_client::on_mode, sdo_client::on_free,
     sdo_client::configure},
#endif
};

static_assert(table[nmt::service].init == nmt::init && table[sdo_server::service].init == sdo_server::init);
#if USE_CSDO
static_assert(table[sdo_client::service].init == sdo_client::init);
#endif

void run(CO_NODE& node, void (*Service::*column)(CO_NODE& node)) {
  for (const Service& service : table) {
    if (service.*column != nullptr) {
      (service.*column)(node);
    }
  }
}

constexpr uint16_t count_streams() {
  uint16_t all = 0;
  for (const Service& service : table) {
    all = static_cast<uint16_t>(all + service.streams);
  }
  return all;
}
constexpr uint16_t streams = count_streams();

bool go_on(CO_NODE& node, uint16_t stream) {
  for (const Service& service : table) {
    if (stream < service.streams) {
      return service.on_free(node, stream);
    }
    stream = static_cast<uint16_t>(stream - service.streams);
  }
  return false;
}

// No service of the node is asked by a remote frame. False: malformed.
bool serve(CO_NODE& node, const CO_IF_FRM& frame, uint16_t owner) {
  const bool is_data = (frame.Identifier & CO_IF_FRM_RTR) == 0;
  return is_data && table[routes::service_of(owner)].on_frame(node, frame, routes::number_of(owner));
}

}  // namespace

namespace services {

void init(CO_NODE& node) { run(node, &Service::init); }

void configure(CO_NODE& node) { run(node, &Service::configure); }

// In turns, a frame each. Whom the controller refuses is the first the next time.
void on_free(CO_NODE& node) {
  uint16_t idle = 0;
  node.Paused = 0;
  while (idle < streams) {
    const bool sent = go_on(node, node.Turn);
    if (node.Paused != 0) {
      return;
    }
    idle = sent ? 0 : static_cast<uint16_t>(idle + 1);
    node.Turn = static_cast<uint16_t>(node.Turn + 1 < streams ? node.Turn + 1 : 0);
  }
}

bool dispatch(CO_NODE& node, const CO_IF_FRM& frame) {
  bool claimed = false;
  bool served = false;
  const uint32_t id = frame.Identifier & ~CO_IF_FRM_RTR;
  const routes::Range range = routes::candidates(node, id);
  for (uint16_t n = range.first; n < range.last && n < node.Routes.Start[17]; ++n) {
    const uint16_t owner = node.Routes.Owner[n];
    if (node.Routes.Id[n] != id || !event::is_allowed(node, table[routes::service_of(owner)].allowed)) {
      continue;
    }
    claimed = true;
    served |= serve(node, frame, owner);
    if (node.Routes.Owner[n] != owner) {  // the callback of a client has configured it anew
      break;
    }
  }
  if (claimed && !served) {
    count(node.Count.Malformed);
  }
  return claimed;
}

}  // namespace services

namespace {

void enter(CO_NODE& node, CO_MODE mode) {
  node.Nmt.Mode = mode;
  node.Nmt.Allowed = nmt::allowed_in(mode);
  run(node, &Service::on_mode);
  if (mode == CO_INVALID) {
    transmit::clear(node);
    node.Paused = 0;
    port::can_close(node);
  }
}

}  // namespace

// The callback may ask for another mode, which comes back here: the outermost call enters what was asked for last.
// Nothing takes back a CONodeStop(), and only CONodeInit() ends CO_INVALID.
void event::change_mode(CO_NODE& node, CO_MODE mode) {
  CO_NMT& nmt = node.Nmt;
  if (nmt.Mode == CO_INVALID && mode > CO_INIT) {
    return;
  }
  if (nmt.Changing != 0) {
    nmt.Next = nmt.Next == CO_INVALID ? CO_INVALID : mode;
    return;
  }
  nmt.Next = mode;
  nmt.Changing = 1;
  while (nmt.Mode != nmt.Next) {
    const CO_MODE next = nmt.Next;
    CONmtModeChange(&nmt, next);
    if (nmt.Next == next) {
      enter(node, next);
    }
  }
  nmt.Changing = 0;
  event::settle(node);
}

}  // namespace co
