// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <vector>

#include "tour/tour_steps.hpp"
#include "trace/text.hpp"

namespace lexican::demo {
namespace {

constexpr TimeOfDay noon = {12, 0, 0};

TimeOfDay time_in(const CO_IF_FRM& pdo) { return {pdo.Data[0], pdo.Data[1], pdo.Data[2]}; }
std::string time_text(const TimeOfDay& time) { return text("%02u:%02u:%02u", time.hour, time.minute, time.second); }

bool send_time(Tour& tour, const TimeOfDay& time) {
  return tour.master.send({0x200u + tour.master.node_id(), {time.hour, time.minute, time.second}, 3});
}

std::optional<CO_IF_FRM> await_time(Tour& tour, Micros timeout) {
  return tour.master.await_frame(0x180u + tour.master.node_id(), scaled_timeout(tour, timeout));
}

/// Returns true if \a time is \a begin, or a second later.
bool is_at_or_just_after(const TimeOfDay& begin, const TimeOfDay& time) {
  return seconds_of(time) - seconds_of(begin) <= 1;
}

/// Returns the TPDO after a time was set. The one before it may have been queued earlier; it is skipped.
std::optional<CO_IF_FRM> await_time_after(Tour& tour, const TimeOfDay& begin) {
  auto answer = await_time(tour, 2 * second);
  if (answer && !is_at_or_just_after(begin, time_in(*answer))) {
    answer = await_time(tour, 2 * second);
  }
  return answer;
}

/// Returns the code of the next EMCY message; nothing after a time-out.
std::optional<std::uint16_t> await_emcy(Tour& tour) {
  const auto message = tour.master.await_frame(0x080u + tour.master.node_id(), scaled_timeout(tour, second));
  return message ? std::optional(CO_GET_WORD(&*message, 0)) : std::nullopt;
}

/// Returns a 32-bit number as bytes.
Bytes bytes_of(std::uint32_t number) {
  return {static_cast<std::uint8_t>(number), static_cast<std::uint8_t>(number >> 8),
          static_cast<std::uint8_t>(number >> 16), static_cast<std::uint8_t>(number >> 24)};
}

struct Setting {
  std::uint16_t index;
  std::uint8_t sub;
  Bytes value;
};

Transfer write_settings(Tour& tour, const std::vector<Setting>& settings) {
  Transfer last;
  for (const Setting& setting : settings) {
    last = tour.sdo.download(setting.index, setting.sub, setting.value);
    if (!last.done()) {
      break;
    }
  }
  return last;
}

/// Returns the number of SYNC messages that are followed by TPDO1.
unsigned count_synchronous(Tour& tour, unsigned messages) {
  unsigned right = 0;
  for (unsigned n = 0; n < messages; ++n) {
    const bool came = tour.master.await_frame(0x080, scaled_timeout(tour, second)).has_value() &&
                      await_time(tour, second / 10).has_value();
    right += came ? 1u : 0u;
  }
  return right;
}

}  // namespace

Finding receive_time(Tour& tour) {
  tour.master.discard_received();
  const auto first = await_time(tour, 2 * second);
  const auto next = await_time(tour, 2 * second);
  if (!first || !next) {
    return {false, "no TPDO1 received"};
  }
  const bool good = seconds_of(time_in(*next)) == (seconds_of(time_in(*first)) + 1) % seconds_per_day;
  return {good, time_text(time_in(*first)) + ", then " + time_text(time_in(*next))};
}

Finding set_clock_by_pdo(Tour& tour) {
  const Micros sent_at = tour.master.loop().now();
  if (!send_time(tour, noon)) {
    return {false, "the CAN driver accepts no frames"};
  }
  const auto answer = await_time_after(tour, noon);
  if (!answer) {
    return {false, "no TPDO1 received"};
  }
  const bool good = is_at_or_just_after(noon, time_in(*answer));
  if (good) {
    tour.set_to = noon;
    tour.set_at = sent_at;
  }
  return {good, "TPDO1: " + time_text(time_in(*answer))};
}

Finding set_invalid_time_by_pdo(Tour& tour) {
  const bool sent = send_time(tour, {24, 0, 0});
  const auto raised = sent ? await_emcy(tour) : std::nullopt;
  tour.set_to = noon;
  tour.set_at = tour.master.loop().now();
  const bool sent_again = send_time(tour, noon);
  const auto gone = sent_again ? await_emcy(tour) : std::nullopt;
  const bool good = raised == CO_EMCY_CODE_SW_DATASET_ERR && gone == CO_EMCY_CODE_NO_ERR;
  return {good, good ? "EMCY 6300h, and 0000h after a valid time" : "EMCY 6300h or 0000h not received"};
}

Finding produce_sync(Tour& tour) {
  constexpr unsigned messages = 3;
  const std::uint32_t id = CO_COBID_SYNC_STD(0, 0x80);
  const Transfer on = write_settings(tour, {{0x1800, 2, {1}},
                                            {0x1006, 0, bytes_of(std::uint32_t{second / 4})},
                                            {0x1005, 0, bytes_of(id | CO_SYNC_COBID_ON)}});
  tour.master.discard_received();
  const unsigned right = on.done() ? count_synchronous(tour, messages) : 0;
  const Transfer off = write_settings(tour, {{0x1005, 0, bytes_of(id)}, {0x1006, 0, bytes_of(0u)}, {0x1800, 2, {255}}});
  if (!on.done()) {
    return failure("switching SYNC on", on);
  }
  if (!off.done()) {
    return failure("switching SYNC off", off);
  }
  return {right == messages, text("%u of %u SYNC messages, each followed by TPDO1", right, messages)};
}

}  // namespace lexican::demo
