// SPDX-License-Identifier: Apache-2.0
// Causes in PDOs and SYNC, and identifiers that two devices use. [301:7.2.2, 7.2.5]
#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "explain/check.hpp"

namespace lexican::explain {
namespace {

using describe::KnownPdo;
using PdoKey = std::tuple<std::uint8_t, bool, std::uint16_t>;  // node, is_transmit, number

PdoKey key_of(const KnownPdo& pdo) { return {pdo.node, pdo.is_transmit, pdo.number}; }
std::uint32_t detail_of(const KnownPdo& pdo) { return pdo.number | (pdo.is_transmit ? 0x1000U : 0U); }
std::string name_of(const KnownPdo& pdo) { return fmt::format("{}PDO{}", pdo.is_transmit ? 'T' : 'R', pdo.number); }
std::string cob_id_of(const CO_IF_FRM& frame) { return fmt::format("{:03X}h", frame.Identifier & CO_IF_FRM_ID); }
unsigned bytes_of(unsigned bits) { return (bits + 7) / 8; }
unsigned communication_of(const KnownPdo& pdo) { return (pdo.is_transmit ? 0x1800U : 0x1400U) + pdo.number - 1U; }
unsigned mapping_of(const KnownPdo& pdo) { return communication_of(pdo) + 0x200U; }

Finding finding_of(CauseId cause, const KnownPdo& pdo, const Evidence& evidence) {
  return {cause, pdo.node, detail_of(pdo), {}, {}, {}, {}, evidence};
}

void report_collision(Findings& findings, const KnownPdo& pdo, const Evidence& evidence, const CO_IF_FRM& frame,
                      const std::string& text) {
  Finding finding = finding_of(CauseId::cob_id_collision, pdo, evidence);
  finding.title = fmt::format("two devices send with the COB-ID {}, {} of node {} and another one", cob_id_of(frame),
                              name_of(pdo), pdo.node);
  finding.text = text;
  finding.check = fmt::format("switch off node {}: frames {} that remain are of the other one; lexican pdo show ID",
                              pdo.node, cob_id_of(frame));
  finding.fix = fmt::format("another COB-ID for one of them: lexican pdo map {} {}pdo{} OBJECTS --cob-id COB-ID",
                            pdo.node, pdo.is_transmit ? 't' : 'r', pdo.number);
  findings.put(std::move(finding));
}

// PDOs ----------------------------------------------------------------------------------------------------------------

constexpr unsigned frames_needed = 3;
constexpr unsigned turns_needed = 6;       // changes between two lengths that are of two senders
constexpr unsigned inhibited_needed = 20;  // frames in a row, and for this time
constexpr Micros inhibited_time = 3 * one_second;
constexpr Micros operational_needed = 3 * one_second;
constexpr std::size_t most_identifiers = 2048;
constexpr std::uint32_t reported_by_device = 0x2000;  // detail of a finding

class PdoCheck : public Check {
 public:
  using Check::Check;

  void frame(const Entry& entry) override {
    const std::optional<std::uint16_t> identifier = plain_identifier(entry.frame);
    if ((entry.frame.Identifier & (CO_IF_FRM_RTR | CO_IF_FRM_ERROR)) != 0) {
      return;
    }
    const KnownPdo* sender = nullptr;
    bool is_known = false;
    facts_.monitor().for_each_pdo(entry.frame, [&](const KnownPdo& pdo) {
      is_known = true;
      pdo.is_transmit ? transmitted(pdo, sender, entry) : received(pdo, entry);
      sender = pdo.is_transmit && sender == nullptr ? &pdo : sender;
    });
    if (identifier && !is_known) {
      unknown(*identifier, entry);
    }
  }

  void transfer(std::uint8_t node, const describe::SdoTransfer& transfer) override {
    const bool is_done = transfer.end == describe::SdoTransfer::End::done;
    if (is_done && transfer.is_download && transfer.index >= 0x2000) {
      nodes_[node].written = transfer.time;
    }
    if (is_done && transfer.is_download && transfer.index >= 0x1400 && transfer.index < 0x1C00) {
      for (auto& [key, seen] : seen_) {
        if (std::get<0>(key) == node) {
          seen = {};
        }
      }
    }
  }

  void advance(Micros now) override {
    if (now - advanced_ < one_second / 2) {
      return;
    }
    advanced_ = now;
    std::map<std::uint8_t, std::vector<const KnownPdo*>> receivers;
    facts_.monitor().for_each_pdo([&](const KnownPdo& pdo) {
      if (!pdo.is_transmit && pdo.cob_id != KnownPdo::not_valid) {
        receivers[pdo.node].push_back(&pdo);
      }
    });
    for (const auto& [node, pdos] : receivers) {
      const NodeFacts& facts = facts_.node(node);
      if (facts.is_server && facts.state == nmt::operational && now - facts.state_since >= operational_needed) {
        look_for_missing(node, pdos, now);
      }
    }
  }

 private:
  /// Frames of a PDO.
  struct Seen {
    Micros last = 0;
    unsigned right = 0;
    unsigned turns = 0;  ///< changes between the right length and another one
    bool was_wrong = false;
    Evidence wrong;
    Evidence foreign;  ///< while its node does not send PDOs
    Evidence shared;   ///< of another node, too
    unsigned inhibited = 0;
    Evidence inhibit;
    Micros reported = 0;  ///< as missing
  };
  struct NodePdos {
    Micros written = 0;  ///< an object by SDO
    Evidence length_errors;
    bool has_length_finding = false;  ///< of an RPDO
    Evidence time_outs;
  };
  /// Frames with an identifier that no known PDO has.
  struct Unknown {
    std::uint8_t length = 0;
    unsigned turns = 0;
    std::uint8_t other = 0;
    Evidence evidence;
  };

  void transmitted(const KnownPdo& pdo, const KnownPdo* before, const Entry& entry) {
    Seen& seen = seen_[key_of(pdo)];
    const NodeFacts& facts = facts_.node(pdo.node);
    check_length(pdo, seen, entry);
    const bool is_state_sure = facts.state && facts.state_heard >= facts.state_since &&
                               entry.time - facts.state_heard < 2 * one_second &&
                               entry.time - facts.state_since > 300 * one_ms;
    if (is_state_sure && facts.state != nmt::operational) {
      seen.foreign.add(entry,
                       [&] { return fmt::format("{} of node {}, which is not Operational", name_of(pdo), pdo.node); });
      if (seen.foreign.count() >= frames_needed && seen.foreign.is_news()) {
        report_collision(findings_, pdo, seen.foreign, entry.frame,
                         fmt::format("{} frames came while node {} was not Operational and sends no PDOs: another "
                                     "device has sent them.",
                                     seen.foreign.count(), pdo.node));
      }
    }
    if (before != nullptr && before->node != pdo.node && facts.is_heard && facts_.node(before->node).is_heard) {
      seen.shared.add(entry, [&] {
        return fmt::format("{} of node {}, and {} of node {}", name_of(*before), before->node, name_of(pdo), pdo.node);
      });
      if (seen.shared.count() >= 2 && seen.shared.is_news()) {
        report_collision(findings_, pdo, seen.shared, entry.frame,
                         fmt::format("{} of node {} and {} of node {} have the COB-ID {}; only one may send with it.",
                                     name_of(*before), before->node, name_of(pdo), pdo.node, cob_id_of(entry.frame)));
      }
    }
    check_inhibit_time(pdo, seen, entry);
    seen.last = entry.time;
  }

  void check_length(const KnownPdo& pdo, Seen& seen, const Entry& entry) {
    unsigned bits = 0;
    if (!pdo.is_mapping_known(bits) || bits > 64) {
      return;
    }
    const bool is_wrong = pdo.is_transmit ? entry.frame.DLC != bytes_of(bits) : entry.frame.DLC < bytes_of(bits);
    seen.turns += is_wrong != seen.was_wrong ? 1U : 0U;
    seen.was_wrong = is_wrong;
    if (!is_wrong) {
      ++seen.right;
      return;
    }
    seen.wrong.add(entry, [&] {
      return fmt::format("{} of node {} with {} bytes instead of {}", name_of(pdo), pdo.node, entry.frame.DLC,
                         bytes_of(bits));
    });
    if (seen.wrong.count() < frames_needed || !seen.wrong.is_news() ||
        !findings_.accepts(CauseId::pdo_length, pdo.node, detail_of(pdo))) {
      return;
    }
    if (pdo.is_transmit && seen.turns >= turns_needed) {
      findings_.remove(CauseId::pdo_length, pdo.node, detail_of(pdo));
      report_collision(findings_, pdo, seen.wrong, entry.frame,
                       fmt::format("Its frames have {} bytes and {} bytes in turn: {} are of its mapping, {} are not.",
                                   bytes_of(bits), entry.frame.DLC, seen.right, seen.wrong.count()));
    } else {
      report_length(pdo, seen.wrong,
                    fmt::format("{} frames {} have {} bytes; its mapping ({:04X}h) has {}{}.", seen.wrong.count(),
                                cob_id_of(entry.frame), entry.frame.DLC, mapping_of(pdo), bytes_of(bits),
                                pdo.is_observed ? "" : " by the description"));
    }
  }

  void report_length(const KnownPdo& pdo, const Evidence& evidence, const std::string& text) {
    if (!pdo.is_transmit) {
      nodes_[pdo.node].has_length_finding = true;
      findings_.remove(CauseId::pdo_length, pdo.node, 0);
    }
    Finding finding = finding_of(CauseId::pdo_length, pdo, evidence);
    finding.title = fmt::format("{} of node {} has another length than its mapping", name_of(pdo), pdo.node);
    finding.text = text;
    finding.check = fmt::format("lexican pdo show {}; lexican read {} {:04X}:0", pdo.node, pdo.node, mapping_of(pdo));
    finding.fix = "the same mapping on both sides: lexican pdo map, or the description of what the device has";
    findings_.put(std::move(finding));
  }

  void check_inhibit_time(const KnownPdo& pdo, Seen& seen, const Entry& entry) {
    const bool is_event_driven = !pdo.is_synchronous() && pdo.inhibit_time != 0 && pdo.event_time != pdo.inhibit_time;
    if (!is_event_driven || seen.last == 0) {
      return;
    }
    const Micros interval = entry.time - seen.last;
    const bool is_inhibited =
        interval + one_ms >= pdo.inhibit_time && interval <= pdo.inhibit_time + pdo.inhibit_time / 10 + one_ms;
    seen.inhibited = is_inhibited ? seen.inhibited + 1 : 0;
    if (!is_inhibited) {
      seen.inhibit.clear();
      return;
    }
    seen.inhibit.add(entry, [&] { return fmt::format("{} after {}", name_of(pdo), time_text(interval)); });
    if (seen.inhibited >= inhibited_needed && seen.inhibit.is_news() &&
        entry.time - seen.inhibit.since() >= inhibited_time) {
      Finding finding = finding_of(CauseId::inhibit_time, pdo, seen.inhibit);
      finding.title = fmt::format("the inhibit time of {} of node {} is never over", name_of(pdo), pdo.node);
      finding.text = fmt::format(
          "{} frames in a row came just after the inhibit time of {} ({:04X}h:03): its values "
          "change faster, so that each frame is late and changes between are not seen.",
          seen.inhibited, time_text(pdo.inhibit_time), communication_of(pdo));
      finding.check =
          fmt::format("lexican pdo watch {}; lexican read {} {:04X}:3", pdo.node, pdo.node, communication_of(pdo));
      finding.fix = fmt::format(
          "a shorter time, or less noise of the value (6426h of I/O modules): lexican write {} "
          "{:04X}:3 VALUE (100 us), while the PDO is disabled",
          pdo.node, communication_of(pdo));
      findings_.put(std::move(finding));
    }
  }

  void received(const KnownPdo& pdo, const Entry& entry) {
    Seen& seen = seen_[key_of(pdo)];
    seen.last = entry.time;
    findings_.remove(CauseId::rpdo_missing, pdo.node, 0);
    findings_.remove(CauseId::rpdo_missing, pdo.node, detail_of(pdo));
    check_length(pdo, seen, entry);
  }

  void look_for_missing(std::uint8_t node, const std::vector<const KnownPdo*>& pdos, Micros now) {
    const NodeFacts& facts = facts_.node(node);
    if (findings_.has(CauseId::heartbeat_missing, node)) {
      findings_.remove(CauseId::rpdo_missing, node, 0);
      return;  // it is not there
    }
    bool has_none = true;
    for (const KnownPdo* const pdo : pdos) {
      const Seen& seen = seen_[key_of(*pdo)];
      has_none = has_none && seen.last == 0;
      if (seen.last == 0 && (pdo->is_configured || pdo->event_time != 0)) {
        report_missing(*pdo, now, detail_of(*pdo));
      }
    }
    if (has_none && nodes_[node].written < facts.state_since && !findings_.has(CauseId::rpdo_missing, node)) {
      report_missing(*pdos.front(), now, 0);
    }
  }

  void report_missing(const KnownPdo& pdo, Micros now, std::uint32_t detail) {
    const NodeFacts& facts = facts_.node(pdo.node);
    Micros& reported = seen_[key_of(pdo)].reported;
    const bool is_recent = reported != 0 && now - reported < 5 * one_second;
    if (is_recent || !findings_.accepts(CauseId::rpdo_missing, pdo.node, detail)) {
      return;
    }
    reported = now;
    Evidence evidence;
    evidence.add(facts.state_since, fmt::format("node {} is Operational", pdo.node));
    evidence.add(now, detail == 0 ? "none of its RPDOs was received"
                                  : fmt::format("no frame {:03X}h was received", pdo.cob_id & CO_IF_FRM_ID));
    for (const ShownFrame& frame : nodes_[pdo.node].time_outs.frames()) {
      evidence.add(frame.time, frame.text);
    }
    Finding finding{CauseId::rpdo_missing, pdo.node, detail, {}, {}, {}, {}, evidence};
    finding.title = detail == 0 ? fmt::format("node {} is Operational and never receives an RPDO", pdo.node)
                                : fmt::format("{} of node {} is never received", name_of(pdo), pdo.node);
    finding.text = fmt::format("Operational for {}; no frame with {:03X}h, the COB-ID of {}, was received.",
                               time_text(now - facts.state_since), pdo.cob_id & CO_IF_FRM_ID, name_of(pdo));
    std::string others;
    for (const auto& [identifier, unknown] : unknown_) {
      if (identifier >= 0x180 && identifier < 0x580 && others.size() < 30) {
        others += fmt::format("{}{:03X}h", others.empty() ? "" : ", ", identifier);
      }
    }
    finding.text += others.empty() ? "" : " Frames that no known PDO has: " + others + ".";
    finding.check = fmt::format("lexican pdo show {}; the PDO configuration of the master", pdo.node);
    finding.fix = fmt::format(
        "let the master send {:03X}h, or give the RPDO the COB-ID of what it sends: lexican pdo "
        "map {} rpdo{} OBJECTS --cob-id COB-ID",
        pdo.cob_id & CO_IF_FRM_ID, pdo.node, pdo.number);
    findings_.put(std::move(finding));
  }

  /// Frames of no known PDO: other services, and devices without description.
  void unknown(std::uint16_t identifier, const Entry& entry) {
    const unsigned function = identifier >> 7;
    const auto node = static_cast<std::uint8_t>(identifier & 0x7FU);
    if (function == 1 && node != 0 && entry.frame.DLC == 8) {
      emergency(node, entry);
    }
    if (unknown_.size() >= most_identifiers && unknown_.find(identifier) == unknown_.end()) {
      return;
    }
    const std::uint8_t length = entry.frame.DLC;
    const bool is_sync = facts_.is_sync(identifier);
    const bool is_emergency_or_sdo = facts_.node(node).is_heard && (function == 1 || function == 11 || function == 12);
    const bool is_error_control = facts_.node(node).is_heard && function == 14;
    if ((is_emergency_or_sdo && length != 8 && !is_sync) || (is_error_control && length != 1)) {
      Unknown& other = unknown_[identifier];
      other.evidence.add(entry, [&] { return fmt::format("{} bytes", length); });
      if (other.evidence.count() >= frames_needed && other.evidence.is_news()) {
        report_foreign(identifier, node, other.evidence,
                       fmt::format("It is the identifier of {} of node {}, whose messages have {}; {} frames have "
                                   "another length.",
                                   function == 1      ? "EMCY"
                                   : is_error_control ? "error control"
                                                      : "SDO",
                                   node, is_error_control ? "1 byte" : "8 bytes", other.evidence.count()));
      }
      return;
    }
    if (function < 3 || function > 10) {
      return;
    }
    Unknown& other = unknown_[identifier];
    const bool is_turn = other.evidence.count() > 0 && length != other.length;
    const bool is_third = other.turns > 0 && is_turn && length != other.other;
    other.turns = is_third ? 0 : other.turns + (is_turn ? 1U : 0U);
    other.other = is_turn ? other.length : other.other;
    other.length = length;
    other.evidence.add(entry, [&] { return fmt::format("{} bytes", length); });
    if (other.turns >= turns_needed && other.evidence.is_news()) {
      report_foreign(
          identifier, 0, other.evidence,
          fmt::format("Its frames have {} bytes and {} bytes in turn, and a PDO has one length. It can also be "
                      "another protocol than CANopen.",
                      other.other, length));
    }
  }

  void report_foreign(std::uint16_t identifier, std::uint8_t node, const Evidence& evidence, const std::string& text) {
    Finding finding{CauseId::cob_id_collision, node, identifier, {}, {}, {}, {}, evidence};
    finding.title = fmt::format("two devices send with the identifier {:03X}h", identifier);
    finding.text = text;
    finding.check = "lexican pdo show ID of each device; switch off one device after the other";
    finding.fix = "another COB-ID for one of them: lexican pdo map NODE tpdo1 OBJECTS --cob-id COB-ID";
    findings_.put(std::move(finding));
  }

  /// A device reports what is wrong with its RPDOs.
  void emergency(std::uint8_t node, const Entry& entry) {
    const unsigned code = entry.frame.Data[0] | static_cast<unsigned>(entry.frame.Data[1]) << 8;
    constexpr unsigned too_short = 0x8210;
    constexpr unsigned too_long = 0x8220;
    constexpr unsigned timed_out = 0x8250;
    NodePdos& own = nodes_[node];
    if (code == too_short || code == too_long) {
      own.length_errors.add(entry, [&] { return fmt::format("EMCY {:04X}h", code); });
      if (own.has_length_finding || own.length_errors.count() < 2 || !own.length_errors.is_news()) {
        return;  // one, such as at the start of a master, is no fault
      }
      Finding finding{CauseId::pdo_length, node, 0, {}, {}, {}, {}, own.length_errors};
      finding.title = fmt::format("node {} receives a PDO with another length than its mapping", node);
      finding.text = fmt::format("It sends EMCY {:04X}h: an RPDO was {} for what it maps.", code,
                                 code == too_short ? "too short" : "too long");
      finding.check = fmt::format("lexican pdo show {}", node);
      finding.fix = "the same mapping on both sides: lexican pdo map";
      findings_.put(std::move(finding));
    } else if (code == timed_out) {
      own.time_outs.add(entry, "EMCY 8250h RPDO time-out");
      Finding finding{CauseId::rpdo_missing, node, reported_by_device, {}, {}, {}, {}, own.time_outs};
      finding.title = fmt::format("node {} does not receive an RPDO in time", node);
      finding.text = "It sends EMCY 8250h: the event timer of an RPDO has elapsed without a frame.";
      finding.check = fmt::format("lexican pdo show {}; lexican read {} 1400:5", node, node);
      finding.fix = "let the master send it more often, or a longer event timer (1400h:05)";
      findings_.put(std::move(finding));
    }
  }

  std::map<PdoKey, Seen> seen_;
  std::array<NodePdos, 128> nodes_{};
  std::map<std::uint16_t, Unknown> unknown_;
  Micros advanced_ = 0;
};

// SYNC ----------------------------------------------------------------------------------------------------------------

constexpr unsigned cycles_needed = 20;
constexpr std::size_t periods_kept = 16;

class SyncCheck : public Check {
 public:
  using Check::Check;

  void frame(const Entry& entry) override {
    const std::optional<std::uint16_t> identifier = plain_identifier(entry.frame);
    if ((entry.frame.Identifier & CO_IF_FRM_RTR) != 0) {
      return;
    }
    if (identifier && facts_.is_sync(*identifier) && entry.frame.DLC <= 1) {
      identifier_ = *identifier;
      synchronise(entry);
      return;
    }
    if (identifier && *identifier > 0x180 && *identifier < 0x580) {
      PdoFrames& frames = frames_[*identifier];
      ++frames.count;
      frames.last = entry.time;
    }
    if (followers_.empty()) {
      return;
    }
    facts_.monitor().for_each_pdo(entry.frame, [&](const KnownPdo& pdo) {
      const auto found = pdo.is_transmit ? followers_.find(key_of(pdo)) : followers_.end();
      if (found != followers_.end()) {
        Follower& follower = found->second;
        follower.in_turn += count_ == follower.count + follower.type ? 1U : 0U;
        follower.count = count_;
        ++follower.frames;
        follower.last = entry;
      }
    });
  }

  void transfer(std::uint8_t /*node*/, const describe::SdoTransfer& transfer) override {
    if (transfer.index >= 0x1800 && transfer.index < 0x1A00 && transfer.is_download) {
      followers_.clear();  // another transmission type
    }
  }

  void advance(Micros now) override {
    if (now - advanced_ < one_second / 2) {
      return;
    }
    advanced_ = now;
    find_followers();
    if (count_ >= periods_kept && now - last_.time > std::max(10 * period(), one_second)) {
      look_for_stopped(now);
    }
    for (std::uint8_t node = 1; node <= 127 && count_ == 0; ++node) {
      const NodeFacts& facts = facts_.node(node);
      if (needy_[node] == Need::sure && facts.is_server && facts.state == nmt::operational &&
          now - facts.state_since >= operational_needed) {
        report_missing(node, now, "There was no SYNC at all.");
      }
    }
  }

 private:
  enum class Need : std::uint8_t { none, possible, sure };
  /// Frames with an identifier.
  struct PdoFrames {
    std::uint64_t count = 0;
    Micros last = 0;
  };
  /// A TPDO that is sent after SYNCs.
  struct Follower {
    std::uint8_t type = 1;
    unsigned cycles = 0;
    unsigned frames = 0;
    unsigned in_turn = 0;     ///< frames that came in the cycle after that of the frame before
    std::uint64_t count = 0;  ///< of the SYNCs at the last frame
    Micros begin = 0;         ///< of the cycles
    Entry last;
  };

  /// PDOs whose frames have ended with the last SYNC, of a node that is still Operational.
  void look_for_stopped(Micros now) {
    for (const auto& [identifier, frames] : frames_) {
      const auto node = static_cast<std::uint8_t>(identifier & 0x7FU);
      const bool has_ended = frames.last + 2 * period() > last_.time && frames.last < last_.time + period();
      const bool is_sending = facts_.is_operational(node) && facts_.node(node).state_since < last_.time;
      if (frames.count >= periods_kept && has_ended && is_sending) {
        report_missing(node, now,
                       fmt::format("SYNC came every {}, and stopped {} ago; with it {:03X}h.", time_text(period()),
                                   time_text(now - last_.time), identifier));
        return;
      }
    }
  }

  Micros period() const {
    std::deque<Micros> sorted = periods_;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0 : sorted[sorted.size() / 2];
  }

  void find_followers() {
    std::map<PdoKey, Follower> found;
    std::array<unsigned, 128> events{};
    std::array<bool, 128> is_configured{};
    needy_.fill(Need::none);
    facts_.monitor().for_each_pdo([&](const KnownPdo& pdo) {
      if (pdo.cob_id == KnownPdo::not_valid) {
        return;
      }
      if (!pdo.is_synchronous()) {
        events[pdo.node] += pdo.is_transmit ? 1U : 0U;
        return;
      }
      needy_[pdo.node] = Need::possible;
      is_configured[pdo.node] = is_configured[pdo.node] || pdo.is_configured;
      if (pdo.is_transmit && pdo.type != 0) {
        const auto known = followers_.find(key_of(pdo));
        Follower& follower = found[key_of(pdo)];
        follower = known != followers_.end() && known->second.type == pdo.type ? known->second : Follower{};
        follower.type = pdo.type;
      }
    });
    for (std::size_t node = 1; node < needy_.size(); ++node) {
      if (needy_[node] == Need::possible && (events[node] == 0 || is_configured[node])) {
        needy_[node] = Need::sure;
      }
    }
    followers_ = std::move(found);
  }

  void synchronise(const Entry& entry) {
    if (count_ > 0) {
      periods_.push_back(entry.time - last_.time);
      if (periods_.size() > periods_kept) {
        periods_.pop_front();
      }
    }
    ++count_;
    last_ = entry;
    for (auto& [key, follower] : followers_) {
      const NodeFacts& facts = facts_.node(std::get<0>(key));
      const bool is_sending = facts.state == nmt::operational && entry.time - facts.state_since > 200 * one_ms;
      if (!is_sending) {
        follower.cycles = follower.frames = follower.in_turn = 0;
        follower.begin = entry.time;
        continue;
      }
      if (++follower.cycles >= cycles_needed * follower.type) {
        judge(key, follower);
        follower.cycles = follower.frames = follower.in_turn = 0;
        follower.begin = entry.time;
      }
    }
    if (count_ % cycles_needed == 0) {
      check_cycle_period();
    }
  }

  /// Compares the number of frames with that of the SYNCs.
  void judge(const PdoKey& key, const Follower& follower) {
    const unsigned expected = follower.cycles / follower.type;
    const auto [node, is_transmit, number] = key;
    const std::optional<KnownValue> listens = facts_.observed(node, 0x1005, 0);
    if (follower.frames == 0 && listens && (listens->value & 0x7FFU) != identifier_) {
      report_missing(node, last_.time,
                     fmt::format("Node {} listens for SYNC on {:03X}h (1005h), and it comes on {:03X}h.", node,
                                 listens->value & 0x7FFU, identifier_));
      return;
    }
    const bool is_full = findings_.has(CauseId::bus_load, 0);
    if (follower.frames == 0 && !is_full) {
      return;  // the device may have another configuration than its description, or is off
    }
    Evidence evidence;
    evidence.add(last_, fmt::format("SYNC, each {}", time_text(period())));
    if (follower.last.time != 0) {
      evidence.add(follower.last, fmt::format("TPDO{} of node {}", number, node));
    }
    // A device that cannot follow misses SYNCs regularly; one that has stopped, or whose frames are lost, does not.
    const bool is_regular =
        last_.time - follower.last.time < 5 * follower.type * period() && follower.in_turn * 5 < follower.frames;
    const bool is_sending = is_full || is_regular;
    if (follower.frames * 5 < expected * 4 && is_sending) {
      report_too_fast(node, 0x1000U + number, evidence,
                      fmt::format("TPDO{} of node {} came {} times in {} SYNCs, and has the transmission type {}.",
                                  number, node, follower.frames, follower.cycles, follower.type));
    } else if (follower.frames * 2 > expected * 3) {
      KnownPdo pdo;
      pdo.node = node;
      pdo.is_transmit = is_transmit;
      pdo.number = number;
      report_collision(findings_, pdo, evidence, follower.last.frame,
                       fmt::format("TPDO{} of node {} came {} times in {} SYNCs, and one device sends {}.", number,
                                   node, follower.frames, follower.cycles, expected));
    }
  }

  void check_cycle_period() {
    for (std::uint8_t node = 1; node <= 127; ++node) {
      const Micros expected = facts_.is_operational(node) ? facts_.value(node, 0x1006, 0).value_or(0) : 0;
      if (expected != 0 && period() * 5 < expected * 4) {
        Evidence evidence;
        evidence.add(last_, fmt::format("SYNC, each {}", time_text(period())));
        report_too_fast(node, 0, evidence,
                        fmt::format("Node {} expects one each {} (1006h).", node, time_text(expected)));
      }
    }
  }

  void report_too_fast(std::uint8_t node, std::uint32_t detail, const Evidence& evidence, const std::string& text) {
    Finding finding{CauseId::sync_too_fast, node, detail, {}, {}, {}, {}, evidence};
    finding.title = "SYNC comes faster than the PDOs can follow";
    finding.text = fmt::format("SYNC comes every {}. ", time_text(period())) + text;
    finding.check = fmt::format("bus load (lexican mon --rate RATE); lexican read {} 1006", node);
    finding.fix =
        "a longer communication cycle (1006h of the SYNC producer), fewer synchronous PDOs, a higher bit rate, "
        "or a transmission type above 1";
    findings_.put(std::move(finding));
  }

  void report_missing(std::uint8_t node, Micros now, const std::string& text) {
    Evidence evidence;
    count_ > 0 ? evidence.add(last_, "the last SYNC")
               : evidence.add(facts_.node(node).state_since, fmt::format("node {} is Operational", node));
    evidence.add(now, "no SYNC since then");
    Finding finding{CauseId::sync_missing, node, 0, {}, {}, {}, {}, evidence};
    finding.title = fmt::format("node {} waits for SYNC", node);
    finding.text = text + " Its synchronous PDOs are not sent, or their values do not take effect.";
    finding.check = fmt::format("lexican pdo show {}; 1005h and 1006h of the SYNC producer", node);
    finding.fix =
        "start the SYNC producer, such as: lexican write ID 1006 10000; lexican write ID 1005 0x40000080. "
        "Or event-driven PDOs: transmission type 255 (1800h:02)";
    findings_.put(std::move(finding));
  }

  std::uint64_t count_ = 0;
  std::uint16_t identifier_ = 0x080;
  Entry last_;
  std::deque<Micros> periods_;
  std::map<PdoKey, Follower> followers_;
  std::map<std::uint16_t, PdoFrames> frames_;
  std::array<Need, 128> needy_{};
  Micros advanced_ = 0;
};

}  // namespace

std::unique_ptr<Check> make_pdo_check(const Facts& facts, Findings& findings) {
  return std::make_unique<PdoCheck>(facts, findings);
}

std::unique_ptr<Check> make_sync_check(const Facts& facts, Findings& findings) {
  return std::make_unique<SyncCheck>(facts, findings);
}

}  // namespace lexican::explain
