// SPDX-License-Identifier: Apache-2.0
#include "tour/tour.hpp"

#include <algorithm>
#include <iterator>

#include "client/progress.hpp"
#include "client/sdo_client.hpp"
#include "clock/dictionary.hpp"
#include "tour/tour_steps.hpp"
#include "trace/decode.hpp"
#include "trace/text.hpp"

namespace lexican::demo {
namespace {

constexpr Micros heartbeat_timeout = 3 * second;
constexpr std::uint32_t largest_picture = 192 * 128 * 3;  // bytes
constexpr TimeOfDay set_time = {12, 34, 57};              // the minute changes during the tour

/// Returns a picture whose colours change from pixel to pixel.
Bytes test_picture(const DeviceTraits& traits) {
  Bytes picture;
  picture.reserve(traits.picture_size());
  for (std::uint32_t y = 0; y < traits.picture_height; ++y) {
    for (std::uint32_t x = 0; x < traits.picture_width; ++x) {
      picture.push_back(static_cast<std::uint8_t>(x));
      picture.push_back(static_cast<std::uint8_t>(y));
      picture.push_back(static_cast<std::uint8_t>(0x80 | ((x ^ y) >> 1)));
    }
  }
  return picture;
}

std::uint32_t number(const Bytes& data) {
  std::uint32_t result = 0;
  for (std::size_t i = 0; i < data.size() && i < 4; ++i) {
    result |= static_cast<std::uint32_t>(data[i]) << (8 * i);
  }
  return result;
}

/// Checks that the transfer has ended with this abort code.
Finding expect_abort(const char* what, const Transfer& transfer, std::uint32_t code) {
  return {transfer.code == code, std::string(what) + ": " + transfer.outcome()};
}

Finding expect_text(const char* what, const Transfer& transfer, const char* expected) {
  if (!transfer.done()) {
    return failure(what, transfer);
  }
  return {transfer.data == bytes_of(expected),
          std::string(what) + " is " + quoted(transfer.data.data(), transfer.data.size())};
}

// --- The steps

bool has_booted(Tour& tour) { return tour.master.await_state(State::boot_up, scaled_timeout(tour, second)); }

/// Waits for the boot-up message. A device outside this program may have booted earlier; then it is reset.
Finding boot(Tour& tour) {
  const bool is_remote = tour.device.node_in_loop() == nullptr;
  const bool booted = tour.device.start() &&
                      (has_booted(tour) || (is_remote && tour.master.command(Nmt::reset_node) && has_booted(tour)));
  return {booted, text(booted ? "node %u has booted" : "no boot-up message of node %u", tour.master.node_id())};
}

Finding identify(Tour& tour) {
  std::uint32_t value[5] = {};
  if (const Transfer type = tour.sdo.upload(0x1000, 0); !type.done()) {
    return failure("device type", type);
  }
  for (std::uint8_t sub = 0; sub <= 4; ++sub) {
    const Transfer transfer = tour.sdo.upload(0x1018, sub);
    if (!transfer.done()) {
      return failure("identity", transfer);
    }
    value[sub] = number(transfer.data);
  }
  const bool good = value[0] == 4 && value[2] == clock_product_code;
  return {good, text("product %04Xh, revision %u.%u, serial number %u", value[2], value[3] >> 16, value[3] & 0xFFFFu,
                     value[4])};
}

Finding read_name(Tour& tour) { return expect_text("the device name", tour.sdo.upload(0x1008, 0), clock_name); }

Finding set_clock(Tour& tour) {
  const std::uint8_t figures[] = {set_time.hour, set_time.minute, set_time.second};
  const Micros begin = tour.master.loop().now();
  for (std::uint8_t sub = 1; sub <= 3; ++sub) {
    const Transfer transfer = tour.sdo.download(0x2100, sub, {figures[sub - 1]});
    if (!transfer.done()) {
      return failure("setting the clock", transfer);
    }
  }
  tour.set_to = set_time;
  tour.set_at = begin;
  return {true, text("the clock is set to %02u:%02u:%02u", set_time.hour, set_time.minute, set_time.second)};
}

Finding set_impossible_hour(Tour& tour) {
  return expect_abort("hour 24", tour.sdo.download(0x2100, 1, {24}), CO_SDO_ERR_RANGE_HIGH);
}

Finding read_missing_object(Tour& tour) {
  return expect_abort("object 2FFFh", tour.sdo.upload(0x2FFF, 0), CO_SDO_ERR_OBJ);
}

Finding write_constant(Tour& tour) {
  return expect_abort("a new device type", tour.sdo.download(0x1000, 0, {1, 0, 0, 0}), CO_SDO_ERR_WR);
}

Finding name_station(Tour& tour) {
  if (const Transfer written = tour.sdo.download(0x2201, 0, bytes_of(station_name)); !written.done()) {
    return failure("the station name", written);
  }
  return expect_text("the station name", tour.sdo.upload(0x2201, 0), station_name);
}

/// Returns options for a transfer of the picture: its size, and a progress display.
SdoClient::Options picture_options(const Tour& tour) {
  View& view = tour.view;
  Progress progress(view.progress_form(), [&view](const std::string& text) { view.progress(text); });
  return {largest_picture, tour.sdo.usual().timeout,
          [progress](const Amount& amount) mutable { progress.update(amount); }};
}

Finding send_picture(Tour& tour) {
  const Transfer written = tour.sdo.download(0x2200, 0, test_picture(tour.traits), picture_options(tour));
  return written.done() ? Finding{true, text("%u bytes written", tour.traits.picture_size())}
                        : failure("writing the picture", written);
}

Finding fetch_picture(Tour& tour) {
  const Transfer read = tour.sdo.upload(0x2200, 0, picture_options(tour));
  if (!read.done()) {
    return failure("reading the picture", read);
  }
  // A picture that is larger than this one has other content at its end.
  const Bytes expected = test_picture(tour.traits);
  const bool same =
      read.data.size() >= expected.size() && std::equal(expected.begin(), expected.end(), read.data.begin());
  return {same, text("%zu bytes read, %s", read.data.size(), same ? "all as written" : "NOT as written")};
}

Finding start(Tour& tour) {
  if (!tour.master.command(Nmt::start)) {
    return {false, "the CAN driver accepts no frames"};
  }
  const bool good = tour.master.await_state(State::operational, scaled_timeout(tour, heartbeat_timeout)) &&
                    tour.master.await_state(State::operational, scaled_timeout(tour, heartbeat_timeout));
  return {good, good ? "operational, two heartbeats" : "no heartbeat with the state operational"};
}

Finding stop(Tour& tour) {
  if (!tour.master.command(Nmt::stop) ||
      !tour.master.await_state(State::stopped, scaled_timeout(tour, heartbeat_timeout))) {
    return {false, "no heartbeat with the state stopped"};
  }
  SdoClient::Options options;
  options.timeout = 200;
  const bool silent = tour.sdo.upload(0x1000, 0, options).code == CO_SDO_ERR_TIMEOUT;
  return {silent, silent ? "stopped: a heartbeat, but no answer to SDO" : "stopped, but SDO is answered"};
}

Finding enter_pre_operational(Tour& tour) {
  const bool good = tour.master.command(Nmt::enter_pre_operational) &&
                    tour.master.await_state(State::pre_operational, scaled_timeout(tour, heartbeat_timeout));
  return {good, good ? "pre-operational again" : "no heartbeat with the state pre-operational"};
}

Finding read_clock(Tour& tour) {
  if (tour.set_at == 0) {
    return {false, "the clock could not be set before"};
  }
  std::uint32_t figure[3] = {};
  for (std::uint8_t sub = 1; sub <= 3; ++sub) {
    const Transfer transfer = tour.sdo.upload(0x2100, sub);
    if (!transfer.done()) {
      return failure("reading the clock", transfer);
    }
    figure[sub - 1] = number(transfer.data);
  }
  const auto passed = static_cast<std::uint32_t>((tour.master.loop().now() - tour.set_at) / second);
  const std::uint32_t set = seconds_of(tour.set_to);
  const std::uint32_t shown = (figure[0] * 60u + figure[1]) * 60u + figure[2];
  // The clock was set within one of its seconds; a clock elsewhere is set some time after the beginning.
  const std::uint32_t seconds = (shown + seconds_per_day - set) % seconds_per_day;
  const bool right = seconds <= passed + 1 && seconds + tour.traits.timeout_factor >= passed;
  return {right, text("%02u:%02u:%02u, %u s after it was set", figure[0], figure[1], figure[2], passed)};
}

Finding reset(Tour& tour) {
  const bool good = tour.master.command(Nmt::reset_node) && has_booted(tour) &&
                    tour.master.await_state(State::pre_operational, scaled_timeout(tour, heartbeat_timeout));
  return {good,
          good ? "booted again, pre-operational, heartbeat on" : "no boot-up message and heartbeat after the reset"};
}

struct Step {
  const char* title;
  const char* shown;  // text in the summary
  Finding (*run)(Tour& tour);
  State begin = State::pre_operational;  // state of the node before the step; boot_up: unknown
};

constexpr Step configured[] = {
    {"The node boots", "boot-up", boot, State::boot_up},
};

#if USE_LSS_MASTER
constexpr Step unconfigured[] = {
    {"LSS fastscan finds the address of a node without node-ID", "LSS fastscan", find_unconfigured, State::boot_up},
    {"LSS configures and stores its node-ID; the node boots", "LSS configuration", configure_node_id, State::boot_up},
};
#endif

constexpr Step introduction[] = {
    {"Read device type and identity: expedited upload", "identity", identify},
    {"Read the device name, more than 4 bytes: segmented upload", "segmented upload", read_name},
    {"Write the station name: segmented download", "segmented download", name_station},
};

#if USE_PARA
constexpr Step storing[] = {
    {"Write the time zone; save time zone and station name", "parameters stored", save_settings},
};
constexpr Step losing_power[] = {
    {"Power failure: the node restarts with its stored values", "power failure", lose_power},
};
constexpr Step resetting[] = {
    {"Write another time zone without saving it; an NMT reset restores the stored one", "parameters loaded",
     reset_settings},
};
#endif

constexpr Step further_steps[] = {
    {"Set the clock", "expedited download", set_clock},
    {"Write hour 24: the application refuses it with an abort code", "abort of the application", set_impossible_hour},
    {"Read an object that does not exist", "abort: no object", read_missing_object},
    {"Write an object that is read-only", "abort: read-only", write_constant},
    {"Write a picture: block download", "block download", send_picture},
    {"Read the picture and compare every byte: block upload", "block upload", fetch_picture},
    {"NMT start; wait for the heartbeat", "NMT start, heartbeat", start},
    {"TPDO1 transmits the time each second", "event-driven TPDO", receive_time, State::operational},
    {"Set the clock by RPDO1; TPDO1 follows when its inhibit time has elapsed", "RPDO", set_clock_by_pdo,
     State::operational},
    {"Set an invalid time by RPDO1: EMCY, and error reset after a valid time", "EMCY", set_invalid_time_by_pdo,
     State::operational},
    {"The node produces SYNC and transmits TPDO1 after each", "SYNC, synchronous TPDO", produce_sync,
     State::operational},
    {"NMT stop: the node does not answer SDO requests", "NMT stop", stop, State::operational},
    {"NMT enter pre-operational", "NMT enter pre-operational", enter_pre_operational, State::stopped},
    {"Read the clock: its timer has advanced the time", "a cyclic timer", read_clock},
    {"NMT reset node", "NMT reset node", reset},
};

Nmt command_to(State state) {
  switch (state) {
    case State::operational: return Nmt::start;
    case State::stopped: return Nmt::stop;
    default: return Nmt::enter_pre_operational;
  }
}

/// Runs a step. After a failed step the node may be in another state than the step requires: switches the state first.
Finding run_step(const Step& step, bool after_failure, Tour& tour) {
  const bool is_ready =
      !after_failure || step.begin == State::boot_up ||
      (tour.master.command(command_to(step.begin)) && tour.master.await_state(step.begin, heartbeat_timeout));
  return is_ready ? step.run(tour) : Finding{false, "the node does not enter the NMT state in which this step begins"};
}

template <std::size_t Number>
void append(std::vector<Step>& all, const Step (&some)[Number]) {
  all.insert(all.end(), std::begin(some), std::end(some));
}

std::vector<Step> steps_with([[maybe_unused]] const Device& device) {
  std::vector<Step> all;
#if USE_LSS_MASTER
  const bool is_configured = device.node_id() != no_node_id;
  is_configured ? append(all, configured) : append(all, unconfigured);
#else
  append(all, configured);
#endif
  append(all, introduction);
#if USE_PARA
  append(all, storing);
  device.traits().can_lose_power ? append(all, losing_power) : append(all, resetting);
#endif
  append(all, further_steps);
  return all;
}

/// Prints several items per line.
void print_list(const std::vector<std::string>& items, View& view) {
  constexpr std::size_t per_line = 5;
  for (std::size_t first = 0; first < items.size(); first += per_line) {
    const std::size_t end = std::min(first + per_line, items.size());
    std::string line = items[first];
    for (std::size_t i = first + 1; i < end; ++i) {
      line += ", " + items[i];
    }
    view.note(first == 0 ? "shown" : "", line + (end == items.size() ? "" : ","));
  }
}

}  // namespace

TourResult run_tour(Device& device, Master& master, View& view) {
  Tour tour{device, master, view};
  const std::vector<Step> all = steps_with(device);
  TourResult result;
  result.total = all.size();
  const Micros begin = master.loop().now();
  bool has_failed = false;  // result of the previous step
  for (const Step& step : all) {
    view.heading(result.steps + 1, step.title);
    const Finding finding = run_step(step, has_failed, tour);
    master.loop().run_for(millisecond);  // the last frames still belong to this step
    if (master.loop().interrupted()) {
      result.interrupted = true;
      break;
    }
    view.finding(finding.good, finding.text);
    has_failed = !finding.good;
    ++result.steps;
    if (finding.good) {
      result.shown.emplace_back(step.shown);
    } else {
      result.failed.emplace_back(step.title);
    }
  }
  result.duration = master.loop().now() - begin;
  return result;
}

void print_summary(const TourResult& result, const CO_NODE_COUNTERS& counters, View& view, const char* label) {
  const double seconds = static_cast<double>(result.duration) / static_cast<double>(second);
  const std::string duration = text("%u of %zu steps in %.1f s", result.steps, result.total, seconds);
  view.line("\nSummary");
  print_list(result.shown, view);
  print_counters(counters, view, label);
  for (const std::string& title : result.failed) {
    view.finding(false, title);
  }
  if (result.interrupted) {
    view.note("end", "interrupted: " + duration);
  } else if (result.failed.empty()) {
    view.finding(true, duration + ", all as expected");
  } else {
    view.finding(false, duration + text(", %zu not as expected", result.failed.size()));
  }
}

void print_counters(const CO_NODE_COUNTERS& counters, View& view, const char* label) {
  view.note(label,
            text("%u frames received (%u without a consumer, %u malformed), %u sent, %u discarded before they were "
                 "sent; %u SDO aborts",
                 counters.Received, counters.Unclaimed, counters.Malformed, counters.Sent, counters.Dropped,
                 counters.SdoAborts));
}

}  // namespace lexican::demo
