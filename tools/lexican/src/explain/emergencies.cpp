// SPDX-License-Identifier: Apache-2.0
// Causes by EMCY messages, and devices without node-ID. [301:7.2.7, 305]
#include <fmt/format.h>

#include <deque>

#include "explain/check.hpp"
#include "trace/network_services.hpp"

namespace lexican::explain {
namespace {

constexpr std::size_t many = 10;  // EMCY messages within `soon`, or 3 times as many in a minute
constexpr Micros soon = 5 * one_second;
constexpr Micros active_time = 3 * one_second;
constexpr std::uint16_t recovered_from_bus_off = 0x8140;

class EmcyCheck : public Check {
 public:
  using Check::Check;

  void frame(const Entry& entry) override {
    const std::optional<std::uint16_t> identifier = plain_identifier(entry.frame);
    if (identifier && *identifier > 0x700 && entry.frame.DLC == 1 && entry.frame.Data[0] == nmt::boot_up) {
      forget_error(static_cast<std::uint8_t>(*identifier & 0x7FU));
    }
    if (!identifier || *identifier <= 0x080 || *identifier > 0x0FF || entry.frame.DLC != 8) {
      return;
    }
    const auto node = static_cast<std::uint8_t>(*identifier & 0x7FU);
    const auto code = static_cast<std::uint16_t>(entry.frame.Data[0] | entry.frame.Data[1] << 8);
    if (code == 0) {
      forget_error(node);
      return;
    }
    const std::string words = trace::decode_network_service(entry.frame, {}, {}).value_or("EMCY");
    const bool is_communication = code >= 0x8100 && code < 0x8300;  // the other causes name their reasons
    if (!is_communication) {
      nodes_[node].active.add(entry, words);
      nodes_[node].words = words;
    }
    if (code == recovered_from_bus_off) {
      report_bus_off(node, entry, words);
    }
    Node& own = nodes_[node];
    own.times.push_back(entry.time);
    while (entry.time - own.times.front() > 60 * one_second || own.times.size() > 3 * many) {
      own.times.pop_front();
    }
    const std::size_t count = own.times.size();
    own.evidence.add(entry, words);
    const bool is_storm = (count >= many && entry.time - own.times[count - many] <= soon) || count >= 3 * many;
    own.is_storm = own.is_storm || is_storm;
    if (own.is_storm && own.evidence.is_news()) {
      report_storm(node, code);
    }
  }

  void advance(Micros now) override {
    for (std::uint8_t node = 1; node <= 127; ++node) {
      const Node& own = nodes_[node];
      if (own.active.count() != 0 && now - own.active.until() > active_time) {
        Finding finding{CauseId::error_active, node, 0, {}, {}, {}, {}, own.active};
        finding.title = fmt::format("node {} reports an error that has not gone", node);
        finding.text = fmt::format("{}. No EMCY with the code 0000h came since then.", own.words);
        finding.check = fmt::format("the manual of the device; lexican read {0} 1001; lexican read {0} 1003:1", node);
        finding.fix = fmt::format(
            "the reason that the code names; then the reset of the device, for a drive: lexican "
            "write {} 6040 0x80",
            node);
        findings_.put(std::move(finding));
      }
    }
  }

 private:
  struct Node {
    std::deque<Micros> times;  ///< of the last minute
    Evidence evidence;
    Evidence bus_off;
    Evidence active;    ///< errors that have not gone
    std::string words;  ///< of the last one
    bool is_storm = false;
  };

  void forget_error(std::uint8_t node) {
    nodes_[node].active.clear();
    findings_.remove(CauseId::error_active, node, 0);
  }

  void report_bus_off(std::uint8_t node, const Entry& entry, const std::string& words) {
    nodes_[node].bus_off.add(entry, words + " recovered from bus-off");
    Finding finding{CauseId::bus_off, node, 0, {}, {}, {}, {}, nodes_[node].bus_off};
    finding.title = fmt::format("node {} was bus-off", node);
    finding.text =
        "It reports by EMCY 8140h that it has recovered: so many of its frames were destroyed before that "
        "its controller left the bus.";
    finding.check = "cable, 60 ohm between CAN_H and CAN_L, bit rate and sample point of this device";
    findings_.put(std::move(finding));
  }

  void report_storm(std::uint8_t node, std::uint16_t code) {
    const Node& own = nodes_[node];
    Finding finding{CauseId::emcy_storm, node, 0, {}, {}, {}, {}, own.evidence};
    finding.title = fmt::format("node {} sends EMCY messages all the time", node);
    finding.text =
        fmt::format("It sent {} messages, the last one with the error code {:04X}h: an error comes and goes.",
                    own.evidence.count(), code);
    finding.check = fmt::format("lexican read {0} 1003:1; lexican read {0} 1001", node);
    finding.fix =
        fmt::format("the cause of the error; fewer messages: lexican write {} 1015 100 (10 ms between two)", node);
    findings_.put(std::move(finding));
  }

  std::array<Node, 128> nodes_{};
};

// LSS command specifiers. [305]
constexpr std::uint8_t configure_node_id = 0x11;
constexpr std::uint8_t identify_unconfigured = 0x4C;
constexpr std::uint8_t identified_slave = 0x4F;  // a slave, also in a fastscan
constexpr std::uint8_t identified_unconfigured = 0x50;
constexpr std::uint8_t fastscan = 0x51;
constexpr std::uint8_t inquire_node_id = 0x5E;
constexpr std::uint8_t inquire_serial = 0x5D;
constexpr std::uint8_t no_node_id = 0xFF;

class LssCheck : public Check {
 public:
  using Check::Check;

  void frame(const Entry& entry) override {
    const std::optional<std::uint16_t> identifier = plain_identifier(entry.frame);
    if (!identifier || (*identifier != 0x7E4 && *identifier != 0x7E5) || entry.frame.DLC != 8) {
      return;
    }
    const std::uint8_t command = entry.frame.Data[0];
    if (*identifier == 0x7E5) {
      request_ = command;
      requested_id_ = command == configure_node_id ? entry.frame.Data[1] : requested_id_;
      return;
    }
    const bool is_fastscan = command == identified_slave && request_ == fastscan;
    const bool has_none = command == inquire_node_id && entry.frame.Data[1] == no_node_id;
    if (is_fastscan || command == identified_unconfigured || has_none) {
      waiting_.add(entry, is_fastscan ? "answer to the LSS fastscan" : "LSS: a device without node-ID");
      last_ = entry.time;
    } else if (command == configure_node_id && entry.frame.Data[1] == 0 && requested_id_ <= 127) {
      waiting_.clear();
      serial_.reset();
      findings_.remove(CauseId::lss_unconfigured, 0, 0);
    } else if (command == inquire_serial) {
      serial_ = CO_GET_LONG(&entry.frame, 1);
    }
  }

  void advance(Micros now) override {
    const bool is_new = now - last_ < 2 * one_second && now - waiting_.since() < 10 * one_second;
    if (waiting_.count() == 0 || is_new) {
      return;  // a master may be about to configure it
    }
    Finding finding{CauseId::lss_unconfigured, 0, 0, {}, {}, {}, {}, waiting_};
    finding.title = "a device has no node-ID and waits for LSS";
    finding.text = "It answers LSS requests for devices without node-ID, and got none" +
                   (serial_ ? fmt::format("; its serial number is {:08X}h.", *serial_) : std::string("."));
    finding.check = "lexican lss scan";
    finding.fix = serial_ ? fmt::format("lexican lss assign {:08X}=ID --store", *serial_)
                          : std::string("lexican lss assign SERIAL=ID --store");
    findings_.put(std::move(finding));
  }

 private:
  std::uint8_t request_ = 0;
  std::uint8_t requested_id_ = no_node_id;
  std::optional<std::uint32_t> serial_;
  Evidence waiting_;
  Micros last_ = 0;
};

}  // namespace

std::unique_ptr<Check> make_emcy_check(const Facts& facts, Findings& findings) {
  return std::make_unique<EmcyCheck>(facts, findings);
}

std::unique_ptr<Check> make_lss_check(const Facts& facts, Findings& findings) {
  return std::make_unique<LssCheck>(facts, findings);
}

}  // namespace lexican::explain
