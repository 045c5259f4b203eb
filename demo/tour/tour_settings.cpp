// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "clock/dictionary.hpp"
#include "tour/tour_steps.hpp"
#include "trace/text.hpp"

namespace lexican::demo {

Bytes bytes_of(const char* text) { return Bytes(text, text + std::strlen(text)); }

#if USE_LSS_MASTER

namespace {

constexpr std::uint8_t waiting = CO_LSSM_WAITING;

}  // namespace

Finding find_unconfigured(Tour& tour) {
  LssMaster& lss = tour.master.lss();
  if (!tour.device.start()) {
    Node* const node = tour.device.node_in_loop();
    return {false, "the node does not start" + (node != nullptr ? ": " + node->error_text() : "")};
  }
  if (!lss.run(COLssmSwitchGlobal, waiting) || !lss.run(COLssmFastscan, nullptr, std::uint8_t{0})) {
    return {false, "fastscan: " + lss.fault()};
  }
  const LssAddress found = lss.address();
  return {found[1] == clock_product_code && found[3] == clock_serial_number,
          text("found: vendor-ID %08Xh, product code %08Xh, revision %08Xh, serial number %08Xh", found[0], found[1],
               found[2], found[3])};
}

Finding configure_node_id(Tour& tour) {
  LssMaster& lss = tour.master.lss();
  const std::uint8_t node_id = tour.master.node_id();
  if (!lss.run(COLssmConfigureNodeId, node_id) || !lss.run(COLssmStore) || !lss.run(COLssmSwitchGlobal, waiting)) {
    return {false, "LSS: " + lss.fault()};
  }
  const bool booted = tour.master.await_state(State::boot_up, scaled_timeout(tour, second));
  return {booted, text(booted ? "node %u has booted" : "no boot-up message of node %u", node_id)};
}

#endif

namespace {

constexpr std::int16_t time_zone = 60;  // min
const Bytes time_zone_bytes = {60, 0};

}  // namespace

Finding save_settings(Tour& tour) {
  if (const Transfer zone = tour.sdo.download(0x2101, 0, time_zone_bytes); !zone.done()) {
    return failure("the time zone", zone);
  }
  const Transfer saved = tour.sdo.download(0x1010, 1, bytes_of("save"));
  return saved.done() ? Finding{true, "stored"} : failure("save", saved);
}

Finding lose_power(Tour& tour) {
  tour.device.lose_power();
  tour.master.discard_received();
  if (!tour.device.start() || !tour.master.await_state(State::boot_up, scaled_timeout(tour, second))) {
    return {false, text("no boot-up message of node %u", tour.master.node_id())};
  }
  const Transfer name = tour.sdo.upload(0x2201, 0);
  const Transfer zone = tour.sdo.upload(0x2101, 0);
  if (!name.done() || !zone.done()) {
    return failure("reading what was stored", name.done() ? zone : name);
  }
  const bool good = name.data == bytes_of(station_name) && zone.data == time_zone_bytes;
  return {good, good ? text("node-ID %u, ", tour.master.node_id()) + quoted(name.data.data(), name.data.size()) +
                           text(", time zone %d min: all as stored", time_zone)
                     : "not what was stored"};
}

Finding reset_settings(Tour& tour) {
  if (const Transfer changed = tour.sdo.download(0x2101, 0, {0, 0}); !changed.done()) {
    return failure("the time zone", changed);
  }
  if (!tour.master.command(Nmt::reset_node) || !tour.master.await_state(State::boot_up, scaled_timeout(tour, second))) {
    return {false, text("no boot-up message of node %u", tour.master.node_id())};
  }
  const Transfer zone = tour.sdo.upload(0x2101, 0);
  if (!zone.done()) {
    return failure("reading what was stored", zone);
  }
  const bool good = zone.data == time_zone_bytes;
  return {good, text(good ? "time zone %d min, as stored" : "not the time zone of %d min that was stored", time_zone)};
}

}  // namespace lexican::demo
