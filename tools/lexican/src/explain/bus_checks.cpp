// SPDX-License-Identifier: Apache-2.0
// Causes on the wire: error frames, bus-off, and the bus load.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "explain/check.hpp"
#include "frame_bits.hpp"

namespace lexican::explain {
namespace {

constexpr Micros window = one_second / 2;
constexpr unsigned windows_needed = 2;
constexpr unsigned errors_needed = 5;

// Classes of error frames. [linux/can/error.h]
constexpr std::uint32_t bus_off_class = 0x040;
constexpr std::uint32_t no_acknowledge_class = 0x020;
constexpr std::uint32_t bus_error_classes = 0x088;
constexpr std::uint32_t controller_class = 0x004;
constexpr std::uint8_t passive = 0x30;

class BusCheck : public Check {
 public:
  using Check::Check;

  void frame(const Entry& entry) override {
    if ((entry.frame.Identifier & CO_IF_FRM_ERROR) != 0) {
      error(entry);
      return;
    }
    ++frames_;
    if (frames_ % 1000 == 0 && are_errors_few()) {
      findings_.remove(CauseId::bus_errors, 0, 0);
    }
    const unsigned bits = co::frame_bits(entry.frame) + co::intermission_bits;
    if (begin_ == 0 || entry.time - begin_ >= window) {
      end_window();
      begin_ = entry.time;
    }
    const std::optional<std::uint16_t> identifier = plain_identifier(entry.frame);
    const bool is_sdo = identifier && (*identifier >> 7 == 11 || *identifier >> 7 == 12);
    bits_ += is_sdo ? 0 : bits;  // the lowest priority: it takes what the others leave
  }

 private:
  void end_window() {
    const std::uint64_t bits = std::exchange(bits_, 0);
    const auto load = [&](std::uint32_t rate) { return static_cast<double>(bits) * 2e2 / rate; };
    for (std::size_t n = 0; n < std::size(bit_rates); ++n) {
      const bool is_wire = facts_.is_rate_given() || load(bit_rates[n]) < 105;  // a simulated bus may have no rate
      in_row_[n] = load(bit_rates[n]) > 80 && is_wire ? in_row_[n] + 1 : 0;
      is_overloaded_[n] = is_overloaded_[n] || in_row_[n] >= windows_needed;
      if (in_row_[n] > 0) {
        loaded_[n].add(begin_, fmt::format("half a second with a load of {:.0f} %", load(bit_rates[n])));
      }
    }
    const std::uint32_t own = facts_.rate();
    for (std::size_t n = 0; n < std::size(bit_rates); ++n) {
      if (bit_rates[n] == own && is_overloaded_[n]) {
        report_load(own, loaded_[n]);
      } else {
        findings_.remove(CauseId::bus_load, 0, bit_rates[n]);
      }
    }
  }

  void report_load(std::uint32_t rate, const Evidence& evidence) {
    const auto& counts = facts_.monitor().statistics().by_identifier;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> most;
    for (const auto& [identifier, count] : counts) {
      most.emplace_back(count, identifier);
    }
    std::sort(most.rbegin(), most.rend());
    std::string names;
    for (std::size_t n = 0; n < std::min<std::size_t>(most.size(), 3); ++n) {
      names += fmt::format("{}{:03X}h ({})", n == 0 ? "" : ", ", most[n].second & CO_IF_FRM_ID, most[n].first);
    }
    Finding finding{CauseId::bus_load, 0, rate, {}, {}, {}, {}, evidence};
    finding.title = "the bus load is above 80 %";
    finding.text =
        fmt::format("{} half seconds had more than 80 % of {} kbit/s{}, without SDO transfers. Most frames: {}.",
                    evidence.count(), rate / 1000, !facts_.is_rate_given() ? " (estimated)" : "", names);
    finding.check = "lexican mon --rate RATE shows the load and the number of frames by identifier";
    finding.fix = "inhibit times and longer event timers of these PDOs, a longer SYNC cycle, or a higher bit rate";
    findings_.put(std::move(finding));
  }

  bool are_errors_few() const { return std::uint64_t{errors_.count()} * 200 < frames_; }

  void error(const Entry& entry) {
    const std::uint32_t classes = entry.frame.Identifier & 0x1FFU;
    if ((classes & bus_off_class) != 0) {
      bus_off_.add(entry, "bus-off");
      Finding finding{CauseId::bus_off, 0, 0, {}, {}, {}, {}, bus_off_};
      finding.title = "a controller was bus-off";
      finding.text = fmt::format(
          "The adapter reports bus-off, after {} error frames: the frames that it sends are "
          "destroyed.",
          errors_.count());
      finding.check = "bit rate of all devices; 60 ohm between CAN_H and CAN_L; a short circuit of the cable";
      finding.fix = "the cable or the bit rate, then set the interface up again: ip link set can0 type can restart";
      findings_.put(std::move(finding));
      return;
    }
    const bool is_passive = (classes & controller_class) != 0 && (entry.frame.Data[1] & passive) != 0;
    if ((classes & (bus_error_classes | no_acknowledge_class)) == 0 && !is_passive) {
      return;
    }
    unacknowledged_ += (classes & no_acknowledge_class) != 0 ? 1U : 0U;
    errors_.add(entry, is_passive                              ? "error passive"
                       : (classes & no_acknowledge_class) != 0 ? "not acknowledged"
                                                               : "bus error");
    if (errors_.count() < errors_needed || are_errors_few() || !errors_.is_news()) {
      return;
    }
    const bool is_unacknowledged = unacknowledged_ * 2 > errors_.count();
    Finding finding{CauseId::bus_errors, 0, 0, {}, {}, {}, {}, errors_};
    finding.title = is_unacknowledged ? "frames are not acknowledged" : "frames are destroyed on the bus";
    finding.text = fmt::format("{} error frames beside {} frames.", errors_.count(), frames_) +
                   (is_unacknowledged ? " No device acknowledges: none is there, or all have another bit rate." : "");
    finding.check = is_unacknowledged ? "power of the devices, and their bit rate: lexican scan without --rate finds it"
                                      : "60 ohm between CAN_H and CAN_L, stubs, ground, bit rate and sample point";
    findings_.put(std::move(finding));
  }

  std::uint64_t frames_ = 0;
  Micros begin_ = 0;  ///< of the window
  std::uint64_t bits_ = 0;
  std::array<Evidence, std::size(bit_rates)> loaded_{};
  std::array<unsigned, std::size(bit_rates)> in_row_{};
  std::array<bool, std::size(bit_rates)> is_overloaded_{};
  Evidence bus_off_;
  Evidence errors_;
  unsigned unacknowledged_ = 0;
};

}  // namespace

std::unique_ptr<Check> make_bus_check(const Facts& facts, Findings& findings) {
  return std::make_unique<BusCheck>(facts, findings);
}

}  // namespace lexican::explain
