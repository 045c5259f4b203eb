// SPDX-License-Identifier: Apache-2.0
#include "node/services.hpp"

#include <stddef.h>

#include "base/callbacks.hpp"
#include "base/count.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "dictionary/lock.hpp"
#include "hal/port.hpp"
#include "service/emcy/emcy.hpp"
#include "service/gfc/gfc.hpp"
#include "service/guarding/guarding.hpp"
#include "service/heartbeat/heartbeat.hpp"
#include "service/led/led.hpp"
#include "service/lss/lss.hpp"
#include "service/lss/master.hpp"
#include "service/mpdo/mpdo.hpp"
#include "service/nmt/nmt.hpp"
#include "service/pdo/pdo.hpp"
#include "service/recorder/recorder.hpp"
#include "service/sdo_client/sdo_client.hpp"
#include "service/sdo_server/sdo_server.hpp"
#include "service/srdo/srdo.hpp"
#include "service/sync/sync.hpp"
#include "service/time/time.hpp"
#include "storage/para.hpp"
#include "wire/cob_id.hpp"

namespace co {
namespace {

bool no_frames(CO_NODE&, const CO_IF_FRM&, uint16_t) { return false; }

#if CO_TPDO_N > 0
// RPDOs and TPDOs are initialised and configured together, by the RPDOs if there are any.
constexpr auto init_tpdos = CO_RPDO_N > 0 ? nullptr : pdo::init;
constexpr auto configure_tpdos = CO_RPDO_N > 0 ? nullptr : pdo::configure_changed;
#endif
#if USE_MPDO
constexpr auto receive_mpdo = CO_RPDO_N > 0 ? mpdo::on_frame : no_frames;
#endif

using Id = routes::Service;

// Returns the row of a service that receives no frames.
constexpr Service without_frames(uint8_t allowed, void (*init)(CO_NODE& node), void (*on_mode)(CO_NODE& node)) {
  return {Id::count, allowed, 0, init, nullptr, nullptr, on_mode, nullptr, nullptr};
}

// Services that receive frames come first, in the order of routes::Service.
constexpr Service table[] = {
    {Id::nmt, CO_NMT_ALLOWED, 0, nmt::init, nmt::on_frame, no_frames, nmt::on_mode, nullptr, nullptr},
    {Id::sdo_server, CO_SDO_ALLOWED, CO_SSDO_N, sdo_server::init, sdo_server::on_frame, no_frames, sdo_server::on_mode,
     sdo_server::on_free, sdo_server::configure},
#if USE_CSDO
    {Id::sdo_client, CO_SDO_ALLOWED, CO_CSDO_N, sdo_client::init, sdo_client::on_frame, no_frames, sdo_client::on_mode,
     sdo_client::on_free, sdo_client::configure},
#endif
    {Id::error_control, CO_NMT_ALLOWED, 0, guarding::init, guarding::on_frame, guarding::on_remote, guarding::on_mode,
     nullptr, nullptr},
#if CO_HBCONS_N > 0
    {Id::heartbeat_consumer, CO_NMT_ALLOWED, 0, nullptr, heartbeat::on_frame, no_frames, heartbeat::on_mode_consumer,
     nullptr, nullptr},
#endif
#if USE_SYNC
    {Id::sync, CO_SYNC_ALLOWED, 0, sync::init, sync::on_frame, no_frames, sync::on_mode, nullptr, nullptr},
#endif
#if USE_TIME
    {Id::time, CO_TIME_ALLOWED, 0, time::init, time::on_frame, no_frames, time::on_mode, nullptr, nullptr},
#endif
#if USE_MPDO
    {Id::mpdo, CO_PDO_ALLOWED, 1, mpdo::init, receive_mpdo, no_frames, nullptr, mpdo::on_free, nullptr},
#endif
#if CO_RPDO_N > 0
    {Id::rpdo, CO_PDO_ALLOWED, 0, pdo::init, pdo::on_frame, no_frames, pdo::on_mode_rpdos, nullptr,
     pdo::configure_changed},
#endif
#if CO_TPDO_N > 0
    {Id::tpdo, CO_PDO_ALLOWED, 0, init_tpdos, no_frames, pdo::on_remote, pdo::on_mode_tpdos, nullptr, configure_tpdos},
#endif
#if USE_GFC
    {Id::gfc, CO_PDO_ALLOWED, 0, gfc::init, gfc::on_frame, no_frames, nullptr, nullptr, nullptr},
#endif
#if CO_SRDO_N > 0
    {Id::srdo, CO_PDO_ALLOWED, 0, srdo::init, srdo::on_frame, no_frames, srdo::on_mode, nullptr, nullptr},
#endif
#if CO_EMCY_CONS_N > 0
    {Id::emcy_consumer, CO_EMCY_ALLOWED, 0, emcy::init_consumer, emcy::on_frame, no_frames, nullptr, nullptr, nullptr},
#endif
#if USE_LSS
    {Id::lss, CO_LSS_ALLOWED, 0, lss::init, lss::on_frame, no_frames, lss::on_mode, nullptr, nullptr},
#endif
#if USE_LSS_MASTER
    {Id::lss_master, CO_LSS_ALLOWED, 0, lss_master::init, lss_master::on_frame, no_frames, lss_master::on_mode, nullptr,
     nullptr},
#endif

    without_frames(CO_NMT_ALLOWED, nullptr, heartbeat::on_mode),
#if USE_PARA
    without_frames(CO_NMT_ALLOWED, nullptr, para::on_mode),
#endif
#if USE_EMCY
    without_frames(CO_EMCY_ALLOWED, emcy::init, emcy::on_mode),
#endif
#if USE_LED
    without_frames(CO_NMT_ALLOWED, led::init, led::on_mode),
#endif
#if USE_RECORDER
    without_frames(CO_NMT_ALLOWED, nullptr, recorder::on_mode),
#endif
};

// Returns whether the rows are in the order of routes::Service, and each service that receives frames has one: routes
// contain the number of a row. All other services come after them.
constexpr bool is_ordered() {
  unsigned expected = 0;
  for (const Service& service : table) {
    if (static_cast<unsigned>(service.id) != expected) {
      return false;
    }
    expected += service.id != Id::count ? 1U : 0U;
  }
  return expected == static_cast<unsigned>(Id::count);
}
static_assert(is_ordered());

constexpr size_t rows = sizeof table / sizeof table[0];

// True if a service has the function. With its sanitizers gcc does not accept "function != nullptr" as a constant
// expression.
template <void (*function)(CO_NODE& node)>
constexpr bool exists = true;
template <>
constexpr bool exists<nullptr> = false;

// Calls a function of all services that have it.
template <auto column, size_t row = 0>
[[gnu::always_inline]] inline void run(CO_NODE& node) {
  constexpr auto function = table[row].*column;
  if constexpr (exists<function>) {
    function(node);
  }
  if constexpr (row + 1 < rows) {
    run<column, row + 1>(node);
  }
}

// Functions of the services that receive frames, indexed by routes::Service.
struct Receiver {
  uint8_t allowed;
  uint16_t places;
  bool (*on_frame)(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);
  bool (*on_remote)(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);
};
struct Receivers {
  Receiver row[static_cast<size_t>(Id::count)];
};
constexpr Receivers receivers_of_table() {
  Receivers receivers = {};
  for (size_t n = 0; n < static_cast<size_t>(Id::count); ++n) {
    receivers.row[n] = {table[n].allowed, routes::places_of(table[n].id), table[n].on_frame, table[n].on_remote};
  }
  return receivers;
}
constexpr Receivers receivers = receivers_of_table();

// Returns the number of senders of all services (Service.streams).
constexpr uint16_t count_streams() {
  uint16_t all = 0;
  for (const Service& service : table) {
    all = static_cast<uint16_t>(all + service.streams);
  }
  return all;
}
constexpr uint16_t streams = count_streams();
static_assert(streams <= UINT8_MAX, "CO_NODE.NextSender");

// Calls on_free of the service that owns the sender with this number. Returns whether it has sent frames.
template <size_t row = 0>
bool continue_sender(CO_NODE& node, uint16_t stream) {
  constexpr uint16_t own = table[row].streams;
  if constexpr (own != 0) {
    if (stream < own) {
      return table[row].on_free(node, stream);
    }
  }
  if constexpr (row + 1 < rows) {
    return continue_sender<row + 1>(node, static_cast<uint16_t>(stream - own));
  }
  return false;
}

}  // namespace

namespace services {

void init(CO_NODE& node) { run<&Service::init>(node); }

#if USE_LSS
void load_node_id(CO_NODE& node) { lss::load(node); }
void take_node_id(CO_NODE& node) { lss::take_node_id(node); }
void begin_lss(CO_NODE& node) { lss::begin(node); }
bool awaits_node_id(CO_NODE& node) { return lss::awaits_node_id(node); }
bool is_started(const CO_NODE& node) { return node.Lss.Started != 0; }
#endif

#if USE_PARA
void load(CO_NODE& node, CO_NMT_RESET type) {
  (void)para::load(node, CO_RESET_NODE, type == CO_RESET_NODE ? &CO_PARA::Size : &CO_PARA::ComSize);
  (void)para::load(node, CO_RESET_COM, &CO_PARA::Size);
}
void save_changes(CO_NODE& node) { para::save_changes(&node); }
#endif

#if USE_EMCY
void forget_application(CO_NODE& node) { emcy::forget_application(node); }
void send_emcy(CO_NODE& node) { emcy::send_queued(node); }
#endif

void configure(CO_NODE& node) { run<&Service::configure>(node); }

// While the objects of PDOs are found again, TPDOs that a type function requests are marked, as their objects may not
// have been found yet.
void remap(CO_NODE& node) {
#if CO_SRDO_N > 0
  srdo::halt(node);
#endif
#if USE_RECORDER
  recorder::on_remap(node);
#endif
  {
    const dict::Lock lock(node);
    pdo::remap(node);
  }
#if CO_SRDO_N > 0
  srdo::report_halted(node);
#endif
  event::defer(node, event::configure);
}

// Continues the senders in round-robin order (index: CO_NODE.NextSender), each with as many frames as the controller
// accepts. The sender that is refused first continues first the next time.
void on_free(CO_NODE& node) {
  unsigned idle = 0;
  CO_ASSERT(streams == 0 || node.NextSender < streams);
  node.Paused = 0;
  while (idle < streams && node.Paused == 0) {
    const bool sent = continue_sender(node, node.NextSender);
    if (sent || node.Paused == 0) {
      node.NextSender = static_cast<uint8_t>(node.NextSender + 1U < streams ? node.NextSender + 1U : 0);
    }
    idle = sent ? 0 : idle + 1;
  }
}

#if USE_REAL_TIME
bool is_real_time(const CO_NODE& node, unsigned place) {
  constexpr unsigned own = CO_SYNC_ALLOWED | CO_PDO_ALLOWED;
  const uint32_t id = node.Routes.Id[place];
  while (routes::is_at(node, place, id) &&
         (receivers.row[routes::service_of(node.Routes.Owner[place])].allowed & own) != 0) {
    ++place;
  }
  return !routes::is_at(node, place, id);
}
#endif

#if CO_ROUTES_SORTED
namespace {

// Calls the services in the order of the routes, which each service may change.
[[gnu::noinline]] bool dispatch_shared(CO_NODE& node, const CO_IF_FRM& frame, unsigned place) {
  bool claimed = false;
  bool served = false;
  const uint32_t id = node.Routes.Id[place];
  do {
    const uint16_t owner = node.Routes.Owner[place];
    const bool alone = !routes::is_at(node, place + 1, id);
    CO_ASSERT(routes::service_of(owner) < static_cast<unsigned>(Id::count));
    const Receiver& service = receivers.row[routes::service_of(owner)];
    if (event::is_allowed(node, service.allowed)) {
      const auto serve = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? service.on_remote : service.on_frame;
      claimed = true;
      served |= serve(node, frame, routes::number_of(owner));
    }
    place = alone ? routes::nowhere : routes::next(node, place, id, owner);
  } while (place != routes::nowhere);
  if (claimed && !served) {
    count(node.Count.Malformed);
  }
  return claimed;
}

}  // namespace

// Calls the only owner of the identifier without a loop: nearly all identifiers have one owner.
bool dispatch(CO_NODE& node, const CO_IF_FRM& frame, unsigned place) {
  CO_ASSERT(place < node.Routes.Start[CO_ROUTE_CLASS_N]);
  if (USE_FAST_PATHS == 0 || routes::is_at(node, place + 1, node.Routes.Id[place])) {
    return dispatch_shared(node, frame, place);
  }
  const uint16_t owner = node.Routes.Owner[place];
  CO_ASSERT(routes::service_of(owner) < static_cast<unsigned>(Id::count));
  const Receiver& service = receivers.row[routes::service_of(owner)];
  if (!event::is_allowed(node, service.allowed)) {
    return false;
  }
  const auto serve = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? service.on_remote : service.on_frame;
  if (!serve(node, frame, routes::number_of(owner))) {
    count(node.Count.Malformed);
  }
  return true;
}
#else
// Calls each service that consumes the identifier. A position is found in the row of its service by counting instances.
bool dispatch(CO_NODE& node, const CO_IF_FRM& frame) {
  const uint32_t id = frame.Identifier & ~CO_IF_FRM_RTR;
  bool claimed = false;
  bool served = false;
  for (unsigned place = 0; (place = routes::find(node, id, place)) != CO_ROUTE_PLACES; ++place) {
    const Receiver* service = receivers.row;
    unsigned number = place;
    for (; number >= service->places; ++service) {
      number -= service->places;
    }
    if (event::is_allowed(node, service->allowed)) {
      const auto serve = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? service->on_remote : service->on_frame;
      claimed = true;
      served |= serve(node, frame, static_cast<uint16_t>(number));
    }
  }
  if (claimed && !served) {
    count(node.Count.Malformed);
  }
  return claimed;
}
#endif

}  // namespace services

void event::raise([[maybe_unused]] CO_NODE& node, [[maybe_unused]] Fault fault, [[maybe_unused]] uint32_t detail) {
#if USE_EMCY
  emcy::raise(node, fault, detail);
#endif
#if USE_LED
  led::raise(node, fault);
#endif
}

void event::resolve([[maybe_unused]] CO_NODE& node, [[maybe_unused]] Fault fault, [[maybe_unused]] uint32_t detail) {
#if USE_EMCY
  emcy::resolve(node, fault, detail);
#endif
#if USE_LED
  led::resolve(node, fault);
#endif
}

void event::forget([[maybe_unused]] CO_NODE& node, [[maybe_unused]] Fault fault) {
#if USE_EMCY
  emcy::forget(node, fault);
#endif
#if USE_LED
  led::resolve(node, fault);
#endif
}

void event::lose_communication(CO_NODE& node) { nmt::lose_communication(node); }

CO_MODE event::mode_for_switch(CO_NODE& node) { return nmt::mode_for_switch(node); }

// Withdraws synchronous PDOs and the TIME message at bus-off: they would be sent too late, after the recovery.
void event::report_can(CO_NODE& node, CO_CAN_EVENT what) {
  if (what == CO_CAN_BUS_OFF) {
    pdo::flush(node);
#if USE_TIME
    time::flush(node);
#endif
    lose_communication(node);
  }
#if USE_EMCY
  emcy::report_can(node, what);
#endif
#if USE_LED
  led::report_can(node, what);
#endif
}

// Samples the TPDOs before it applies the RPDOs: TPDOs hold the values from before the RPDOs of the same SYNC.
// [301:7.2.2.3]
void event::sync(CO_NODE& node, uint8_t counter) {
  pdo::sample(node, counter);
  pdo::apply(node);
}

void event::end_sync_window(CO_NODE& node) { pdo::end_window(node); }

void event::change_node_id(CO_NODE& node, uint8_t id) {
  node.NodeId = id;
#if USE_LSS
  node.Lss.OwnNodeId = id;
  node.Lss.CfgNodeId = id;
#endif
}

void event::change_lss([[maybe_unused]] CO_NODE& node) {
#if USE_LED
  led::update(node);
#endif
}

void event::change_object(CO_NODE& node, const CO_OBJ& obj) { pdo::change_object(node, obj); }

event::Outlet event::find_outlet(CO_NODE& node, const CO_OBJ& obj) { return pdo::find_outlet(node, obj); }

namespace {

// Enters an NMT state: sets the permissions, then calls on_mode of every service.
void enter(CO_NODE& node, CO_MODE mode) {
  CO_ASSERT(mode < CO_MODE_NUM);
  node.Nmt.Mode = mode;
  node.State = static_cast<uint8_t>(mode == CO_INVALID ? node.State & ~event::running : node.State | event::running);
  node.Nmt.Allowed = nmt::allowed_in(mode);
  run<&Service::on_mode>(node);
  if (mode == CO_INVALID) {
    transmit::clear(node);
    node.Paused = 0;
    node.Pending = 0;
    node.TransmitOff = 0;
    port::can_close(node);
  }
}

// Calls CONmtModeChange() and enters the state, unless the callback has requested another one.
void announce_and_enter(CO_NODE& node, CO_MODE next) {
  callback::change_mode(node, next);
  if (next == node.Nmt.Next) {
    enter(node, next);
  }
}

}  // namespace

// Enters the requested NMT state, if it is another one. A state that CONmtModeChange() or a service requests replaces
// the one to be entered, or follows the one just entered. Messages that were deferred before are sent before, because
// the next state may not permit them. Resets that are requested while the node is started are dropped.
void event::enter_requested_mode(CO_NODE& node) {
  CO_NMT& nmt = node.Nmt;
  const bool starts = nmt.Mode == CO_INIT;
  while ((node.Pending & event::mode) != 0) {
    event::send_deferred(node);
    event::remove(node, event::mode);
    if (nmt.Next != nmt.Mode) {
      announce_and_enter(node, nmt.Next);
    }
  }
  if (starts) {
    event::forget_resets(node);
  }
}

void event::request_mode(CO_NODE& node, CO_MODE requested) {
  if (node.Nmt.Next != requested && node.Nmt.Next != CO_INVALID) {
    node.Nmt.Next = requested;
    node.TransmitOff = requested == CO_INVALID ? uint8_t{stopping} : node.TransmitOff;
    defer(node, mode);
  }
}

}  // namespace co
