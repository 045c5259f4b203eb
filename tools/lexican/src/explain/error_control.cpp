// SPDX-License-Identifier: Apache-2.0
// Causes in error control: heartbeat, node guarding and boot-up. [301:7.2.8]
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "explain/check.hpp"

namespace lexican::explain {
namespace {

constexpr std::size_t intervals_kept = 8;
constexpr std::size_t intervals_needed = 3;   // for a period
constexpr std::size_t alternating = 6;        // intervals that show two producers
constexpr Micros shortest_gap = 50 * one_ms;  // without heartbeat, that counts
constexpr Micros longest_start = 10 * one_second;
constexpr unsigned guarding_needed = 3;
constexpr std::uint16_t communication_error = 0x8130;  // EMCY: life guarding or heartbeat error

/// Boot-ups within a time that are a loop.
struct Loop {
  std::size_t boot_ups;
  Micros within;
};
constexpr Loop loops[] = {{3, 30 * one_second}, {4, 120 * one_second}, {5, 600 * one_second}};

/// The heartbeat of a node.
struct Producer {
  Micros last = 0;  ///< time of the last heartbeat; 0: none since the start of the node
  Entry last_entry;
  Micros full_time = 0;  ///< of the bus, at that time
  Micros silence = 0;    ///< time since `last` in which the whole bus was silent
  std::deque<Micros> intervals;
  std::uint8_t state = nmt::boot_up;
  unsigned alternations = 0;  ///< changes of the state without a command
  unsigned heartbeats = 0;    ///< since the first of them
  Micros alternated = 0;
  Evidence alternate;
  bool is_heard = false;
  bool is_missing = false;
  Evidence missing;
  Evidence restarts;  ///< boot-ups of a device in Operational without a command

  std::deque<Micros> boot_ups;  ///< without a command
  Evidence boots;
  Micros excused = 0;  ///< time of the NMT command whose boot-up has come

  bool is_requested = false;  ///< a guarding request is open
  Entry request;
  bool has_answered = false;
  unsigned unanswered = 0;
  Evidence guarding;

  Micros left_operational = 0;  ///< without a command
  Evidence emergencies;         ///< EMCY 8130h

  Micros period() const {
    std::deque<Micros> sorted = intervals;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0 : sorted[sorted.size() / 2];
  }
};

/// An entry of 1016h.
struct Consumer {
  std::uint8_t node = 0;
  std::uint8_t sub_index = 0;
  std::uint8_t producer = 0;
  Micros time = 0;
  Micros since = 0;  ///< the value was seen; of a description the first frame
  unsigned intervals = 0;
  unsigned violations = 0;
  Evidence evidence;
};

class ErrorControlCheck : public Check {
 public:
  using Check::Check;

  void frame(const Entry& entry) override {
    prepare();
    note_silence(entry.time);
    const std::uint32_t identifier = entry.frame.Identifier;
    const auto node = static_cast<std::uint8_t>(identifier & 0x7FU);
    if (identifier == (0x700U | node | CO_IF_FRM_RTR) && node != 0) {
      guard(node, entry);
      return;
    }
    const std::optional<std::uint16_t> plain = plain_identifier(entry.frame);
    if (plain && *plain >> 7 == 14 && node != 0 && entry.frame.DLC == 1) {
      state(node, entry);
    } else if (plain && *plain >> 7 == 1 && node != 0 && entry.frame.DLC == 8 &&
               (entry.frame.Data[0] | entry.frame.Data[1] << 8) == communication_error) {
      emergency(node, entry);
    }
  }

  void transfer(std::uint8_t node, const describe::SdoTransfer& transfer) override {
    if (transfer.index == 0x1016 && transfer.sub_index >= 1 && transfer.sub_index <= 127 && is_prepared_ &&
        transfer.end == describe::SdoTransfer::End::done) {
      read_consumer(node, transfer.sub_index);
    }
    if (transfer.index == 0x1017 && transfer.is_download && transfer.end == describe::SdoTransfer::End::done) {
      producers_[node].last = 0;  // another period, or none
      producers_[node].intervals.clear();
    }
  }

  void advance(Micros now) override {
    for (std::uint8_t node = 1; node <= 127; ++node) {
      Producer& producer = producers_[node];
      if (producer.is_requested && now - producer.request.time > 2 * one_second) {
        producer.is_requested = false;
        miss_guarding(node);
      }
      if (producer.last == 0 || producer.intervals.size() < intervals_needed || now <= producer.last + shortest_gap) {
        continue;
      }
      const Micros period = producer.period();
      // Heartbeats have a low priority: while the bus is full, they wait.
      const Micros unusual = producer.silence + facts_.full_time() - producer.full_time;
      const Micros elapsed = now - producer.last - std::min(unusual, now - producer.last);
      const bool is_resetting =
          is_reset_since(node, producer.last) && now - facts_.node(node).commanded < longest_start;
      const Micros longest = *std::max_element(producer.intervals.begin(), producer.intervals.end());
      const bool is_stopped = facts_.node(node).command == nmt::stop;  // it may be switched off on purpose
      if (!is_stopped && elapsed > std::max(3 * period, 2 * longest) + shortest_gap && !is_resetting) {
        report_missing(node, now);
      }
    }
  }

 private:
  void prepare() {
    if (std::exchange(is_prepared_, true)) {
      return;
    }
    for (std::uint8_t node = 1; node <= 127; ++node) {
      if (facts_.is_described(node)) {
        read_consumers(node);
      }
    }
  }

  void read_consumers(std::uint8_t node) {
    const std::uint32_t count = std::min(facts_.value(node, 0x1016, 0).value_or(0), 127U);
    for (std::uint8_t sub_index = 1; sub_index <= count; ++sub_index) {
      read_consumer(node, sub_index);
    }
  }

  void read_consumer(std::uint8_t node, std::uint8_t sub_index) {
    const std::uint32_t value = facts_.value(node, 0x1016, sub_index).value_or(0);
    const auto producer = static_cast<std::uint8_t>(value >> 16 & 0xFFU);
    const Micros time = (value & 0xFFFFU) * one_ms;
    const bool is_used = producer >= 1 && producer <= 127 && time != 0;
    std::uint8_t& former = producer_of_[{node, sub_index}];
    const std::pair<std::uint8_t, std::uint8_t> entry{node, sub_index};
    const auto known = consumers_[former].find(entry);
    if (known != consumers_[former].end() && is_used && former == producer && known->second.time == time) {
      return;
    }
    consumers_[former].erase(entry);
    former = is_used ? producer : std::uint8_t{0};
    if (is_used) {
      consumers_[producer][entry] = {node, sub_index, producer, time, facts_.now(), 0, 0, {}};
    }
  }

  /// A pause of the recording, or of the whole bus, is the fault of no device.
  void note_silence(Micros time) {
    const Micros before = facts_.now();
    const Micros gap = before != 0 && time > before ? time - before : 0;
    if (gap < 2 * one_second) {
      return;
    }
    Micros longest = 0;
    for (const Producer& producer : producers_) {
      longest = std::max(longest, producer.last != 0 ? producer.period() : 0);
    }
    for (Producer& producer : producers_) {
      producer.silence += gap > 2 * longest ? gap : 0;
    }
  }

  bool is_reset_since(std::uint8_t node, Micros time) const {
    const NodeFacts& facts = facts_.node(node);
    return (facts.command == nmt::reset_node || facts.command == nmt::reset_communication) && facts.commanded >= time;
  }

  void guard(std::uint8_t node, const Entry& entry) {
    Producer& producer = producers_[node];
    if (producer.is_requested) {
      miss_guarding(node);
    }
    producer.is_requested = true;
    producer.request = entry;
  }

  void miss_guarding(std::uint8_t node) {
    Producer& producer = producers_[node];
    ++producer.unanswered;
    producer.guarding.add(producer.request, "guarding request without answer");
    if (producer.unanswered >= guarding_needed && producer.guarding.is_news()) {
      report_guarding(node);
    }
  }

  void report_guarding(std::uint8_t node) {
    const Producer& producer = producers_[node];
    Finding finding{CauseId::guarding_unanswered, node, 0, {}, {}, {}, {}, producer.guarding};
    finding.title = fmt::format("node {} does not answer node guarding", node);
    finding.text =
        fmt::format("{} requests (remote frames {:03X}h) had no answer. ", producer.guarding.count(), 0x700U + node) +
        (producer.has_answered        ? "It answered before: power, cable, or a device that hangs."
         : facts_.node(node).is_heard ? "It sends other messages: it may not support node guarding."
                                      : "It sends nothing at all: it may be off, or have another node-ID.");
    finding.check = fmt::format("lexican scan; lexican read {0} 100C; lexican read {0} 100D", node);
    finding.fix = fmt::format("a device with heartbeat needs no guarding: lexican write {} 1017 1000", node);
    findings_.put(std::move(finding));
  }

  void state(std::uint8_t node, const Entry& entry) {
    Producer& producer = producers_[node];
    const auto state = static_cast<std::uint8_t>(entry.frame.Data[0] & 0x7FU);
    if (std::exchange(producer.is_requested, false)) {
      producer.has_answered = true;
      producer.unanswered = 0;
      producer.guarding.clear();
      producer.state = state;
      return;
    }
    if (state == nmt::boot_up) {
      boot_up(node, entry);
      return;
    }
    follow_state(node, state, entry);
    if (producer.last != 0) {
      interval(node, entry.time - producer.last, entry);
    }
    producer.is_heard = true;
    producer.last = entry.time;
    producer.last_entry = entry;
    producer.silence = 0;
    producer.full_time = facts_.full_time();
  }

  void boot_up(std::uint8_t node, const Entry& entry) {
    Producer& producer = producers_[node];
    const NodeFacts& facts = facts_.node(node);
    const bool is_reset = facts.command == nmt::reset_node || facts.command == nmt::reset_communication;
    const bool is_excused = is_reset && facts.commanded != producer.excused;
    const Micros last = std::exchange(producer.last, 0);
    producer.state = nmt::boot_up;
    if (is_excused) {
      producer.excused = facts.commanded;
      return;
    }
    if (facts.state == nmt::operational && facts.heard > facts.state_since) {
      report_restart(node, last, entry);
    }
    const bool is_common = last_boot_ != 0 && last_boot_node_ != node && entry.time - last_boot_ < one_second;
    Producer& other = producers_[last_boot_node_];
    if (is_common && !other.boot_ups.empty() && other.boot_ups.back() == last_boot_) {
      other.boot_ups.pop_back();
    }
    last_boot_ = entry.time;
    last_boot_node_ = node;
    if (is_common) {
      return;  // the supply of several devices was switched on
    }
    producer.boots.add(entry, "boot-up without a command");
    producer.boot_ups.push_back(entry.time);
    constexpr std::size_t most_boot_ups = 100;
    while (entry.time - producer.boot_ups.front() > loops[2].within || producer.boot_ups.size() > most_boot_ups) {
      producer.boot_ups.pop_front();
    }
    const std::size_t count = producer.boot_ups.size();
    const bool is_loop = std::any_of(std::begin(loops), std::end(loops), [&](const Loop& loop) {
      return count >= loop.boot_ups && entry.time - producer.boot_ups[count - loop.boot_ups] <= loop.within;
    });
    if (is_loop) {
      Finding finding{CauseId::boot_loop, node, 0, {}, {}, {}, {}, producer.boots};
      const Micros total = producer.boot_ups.back() - producer.boot_ups.front();
      finding.title = fmt::format("node {} starts again and again", node);
      finding.text =
          fmt::format("It sent {} boot-up messages within {}, without a reset by NMT.", count, time_text(total));
      finding.check = fmt::format("supply voltage under load; watchdog of the device; lexican read {} 1003:1", node);
      finding.fix = "the power supply, or the firmware: see what it did just before each boot-up (lexican mon)";
      findings_.put(std::move(finding));
    }
  }

  /// \a last: time of the last heartbeat; 0: none
  void report_restart(std::uint8_t node, Micros last, const Entry& entry) {
    Producer& producer = producers_[node];
    if (std::exchange(producer.is_missing, false)) {
      findings_.remove(CauseId::heartbeat_missing, node, 0);
      producer.missing.clear();
      producer.intervals.clear();
    }
    producer.restarts.add(entry, "boot-up without a command");
    Finding finding{CauseId::restarted, node, 0, {}, {}, {}, {}, producer.restarts};
    finding.title = fmt::format("node {} has started anew while it was Operational", node);
    finding.text = fmt::format(
        "{} boot-up without a reset by NMT{}. It is pre-operational now, and has the values that "
        "it stores: what the master had set before is lost.",
        producer.restarts.count() == 1 ? "A" : fmt::format("{} times a", producer.restarts.count()),
        last != 0 ? fmt::format(", {} after its last heartbeat", time_text(entry.time - last)) : "");
    finding.check =
        fmt::format("supply voltage and connector of node {}; its watchdog; lexican mon, just before", node);
    finding.fix = fmt::format(
        "the supply or the firmware; then configure it again: lexican apply FILE -n {0}; lexican "
        "nmt start {0}",
        node);
    findings_.put(std::move(finding));
  }

  void follow_state(std::uint8_t node, std::uint8_t state, const Entry& entry) {
    Producer& producer = producers_[node];
    const std::uint8_t before = std::exchange(producer.state, state);
    ++producer.heartbeats;
    if (before == state || before == nmt::boot_up) {
      return;
    }
    const std::uint8_t command = facts_.node(node).command;
    if (before == nmt::operational && (command == 0 || command == nmt::start)) {
      producer.left_operational = entry.time;
    }
    if (facts_.was_commanded(node, entry.time, one_second)) {
      producer.alternations = 0;
      return;
    }
    const bool is_soon = entry.time - producer.alternated < 5 * one_second;
    producer.alternations = is_soon ? producer.alternations + 1 : 1;
    producer.heartbeats = is_soon ? producer.heartbeats : 1;
    producer.alternated = entry.time;
    producer.alternate.add(entry, "heartbeat with another state");
    constexpr unsigned needed = 4;
    if (producer.alternations >= needed && producer.alternations * 3 >= producer.heartbeats) {
      report_same_id(node, producer.alternate,
                     fmt::format("Its heartbeats alternate between two states, {} times without an NMT command: "
                                 "two devices send them.",
                                 producer.alternate.count()));
    }
  }

  void report_same_id(std::uint8_t node, const Evidence& evidence, const std::string& text) {
    Finding finding{CauseId::same_node_id, node, 0, {}, {}, {}, {}, evidence};
    finding.title = fmt::format("two devices have the node-ID {}", node);
    finding.text = text;
    finding.check = fmt::format("switch off one of them: lexican scan has to lose node {}", node);
    finding.fix = "give one of them another node-ID: its switches, or lexican lss assign SERIAL=ID --store";
    findings_.put(std::move(finding));
  }

  void interval(std::uint8_t node, Micros interval, const Entry& entry) {
    Producer& producer = producers_[node];
    if (producer.is_missing) {
      producer.is_missing = false;
      producer.intervals.clear();
      return;
    }
    producer.intervals.push_back(interval);
    if (producer.intervals.size() > intervals_kept) {
      producer.intervals.pop_front();
    }
    for (auto& item : consumers_[node]) {
      consume(item.second, interval, entry);
    }
    if (is_alternating(producer)) {
      Evidence evidence;
      evidence.add(producer.last_entry, "heartbeat");
      evidence.add(entry, [&] { return fmt::format("heartbeat after {}", time_text(interval)); });
      report_same_id(node, evidence,
                     fmt::format("Its heartbeats come after {} and {} in turn: two devices send them, each with its "
                                 "period.",
                                 time_text(interval), time_text(producer.intervals[producer.intervals.size() - 2])));
    }
  }

  /// Two producers with one period, and an offset between them.
  static bool is_alternating(const Producer& producer) {
    const std::deque<Micros>& all = producer.intervals;
    if (all.size() < alternating) {
      return false;
    }
    const std::size_t begin = all.size() - alternating;
    const auto near = [](Micros a, Micros b) { return (a > b ? a - b : b - a) <= std::max(a, b) / 20 + one_ms; };
    for (std::size_t n = begin + 2; n < all.size(); ++n) {
      if (!near(all[n], all[n - 2])) {
        return false;
      }
    }
    const Micros a = std::min(all[begin], all[begin + 1]);
    const Micros b = std::max(all[begin], all[begin + 1]);
    const bool is_loss = a > 0 && near((b + a / 2) / a * a, b);  // a multiple: each second heartbeat is lost
    return !is_loss && (a > b ? a - b : b - a) > std::max(a, b) / 4 + 2 * one_ms;
  }

  void consume(Consumer& consumer, Micros interval, const Entry& entry) {
    if (consumer.since + interval > entry.time) {
      return;  // the interval began before
    }
    ++consumer.intervals;
    if (interval < consumer.time) {
      return;
    }
    ++consumer.violations;
    consumer.evidence.add(
        entry, fmt::format("heartbeat of node {}, {} after the one before", consumer.producer, time_text(interval)));
    if (consumer.violations >= 2 && consumer.violations * 2 > consumer.intervals && consumer.evidence.is_news()) {
      report_consumer(consumer);
    }
  }

  void report_consumer(const Consumer& consumer) {
    const Producer& own = producers_[consumer.node];
    const Micros period = producers_[consumer.producer].period();
    if (period == 0 || !findings_.accepts(CauseId::heartbeat_time, consumer.node, consumer.sub_index)) {
      return;
    }
    findings_.remove(CauseId::heartbeat_time, consumer.node, 0);  // found before without the entry
    const std::string key = fmt::format("1016h:{:02X}", consumer.sub_index);
    Finding finding{CauseId::heartbeat_time, consumer.node, consumer.sub_index, {}, {}, {}, {}, consumer.evidence};
    finding.evidence.show_also(own.emergencies);
    const bool has_left = own.left_operational != 0;
    finding.title = has_left ? fmt::format("node {} refuses to stay Operational", consumer.node)
                             : fmt::format("node {} waits too short a time for the heartbeats of node {}",
                                           consumer.node, consumer.producer);
    finding.text = fmt::format("It expects a heartbeat of node {0} every {1} ({2}){3}; node {0} sends one every {4}.",
                               consumer.producer, time_text(consumer.time), key,
                               own.emergencies.count() != 0 ? " and sends EMCY 8130h" : "", time_text(period));
    finding.check = fmt::format("lexican read {} 1016:{:X}; lexican read {} 1017", consumer.node, consumer.sub_index,
                                consumer.producer);
    const Micros enough = std::min<Micros>(period * 3 / 2 / one_ms, 0xFFFF);
    finding.fix = fmt::format("lexican write {} 1016:{:X} 0x{:08X}", consumer.node, consumer.sub_index,
                              static_cast<std::uint32_t>(consumer.producer) << 16 | enough);
    findings_.put(std::move(finding));
  }

  /// A device reports that a heartbeat, or the guarding by the master, does not come.
  void emergency(std::uint8_t node, const Entry& entry) {
    Producer& own = producers_[node];
    own.emergencies.add(entry, [&] { return fmt::format("EMCY 8130h of node {}", node); });
    bool is_explained = producers_[node].guarding.count() != 0 || own.has_answered || own.is_requested;
    for (auto item = producer_of_.lower_bound({node, 0}); item != producer_of_.end() && item->first.first == node;
         ++item) {
      const auto found = consumers_[item->second].find(item->first);
      if (found == consumers_[item->second].end()) {
        continue;
      }
      const Consumer& consumer = found->second;
      if (consumer.violations >= 2 && consumer.violations * 2 > consumer.intervals) {
        is_explained = true;
        report_consumer(consumer);
      }
      const Producer& producer = producers_[consumer.producer];
      if (!producer.is_heard && !is_reset_since(consumer.producer, 0)) {
        is_explained = true;
        report_absent(consumer, entry);
      }
    }
    const bool is_missing = std::any_of(producers_.begin(), producers_.end(),
                                        [](const Producer& producer) { return producer.missing.count() != 0; });
    if (!is_explained && !is_missing && own.emergencies.count() >= 2) {
      Finding finding{CauseId::heartbeat_time, node, 0, {}, {}, {}, {}, own.emergencies};
      finding.title = fmt::format("node {} waits too short a time for a heartbeat", node);
      finding.text = fmt::format("It sent EMCY 8130h {} times, and no heartbeat is missing. Its 1016h is not known.",
                                 own.emergencies.count());
      finding.check = fmt::format("lexican read {} 1016:1, and 1017 of the node that it names", node);
      finding.fix = fmt::format("1.5 periods of the producer as its time: lexican write {} 1016:1 VALUE", node);
      findings_.put(std::move(finding));
    }
  }

  void report_absent(const Consumer& consumer, const Entry& entry) {
    Evidence evidence;
    evidence.add(entry, [&] { return fmt::format("EMCY 8130h of node {}", consumer.node); });
    Finding finding{CauseId::heartbeat_missing, consumer.producer, 0, {}, {}, {}, {}, evidence};
    finding.title =
        fmt::format("node {} sends no heartbeat, and node {} waits for it", consumer.producer, consumer.node);
    finding.text = fmt::format("Node {} expects a heartbeat of node {} every {} (1016h:{:02X}); none was seen.",
                               consumer.node, consumer.producer, time_text(consumer.time), consumer.sub_index);
    finding.check = fmt::format("lexican read {} 1017", consumer.producer);
    finding.fix = fmt::format("lexican write {} 1017 {}", consumer.producer, consumer.time / 3 / one_ms);
    findings_.put(std::move(finding));
  }

  void report_missing(std::uint8_t node, Micros now) {
    Producer& producer = producers_[node];
    const NodeFacts& facts = facts_.node(node);
    if (!std::exchange(producer.is_missing, true)) {
      producer.missing.add(producer.last_entry, "the last heartbeat");
    }
    const bool is_alive = facts.heard > producer.last + producer.period();
    Finding finding{CauseId::heartbeat_missing, node, 0, {}, {}, {}, {}, producer.missing};
    finding.evidence.add(now, "no heartbeat since then");
    finding.title = fmt::format("node {} does not send its heartbeat any more", node);
    finding.text = fmt::format("It came every {}, then not for {}. ", time_text(producer.period()),
                               time_text(now - producer.last)) +
                   (is_reset_since(node, producer.last) ? "It was reset by NMT, and did not start again."
                    : is_alive ? "The device still sends other messages: the heartbeat producer is off, or it hangs."
                               : "It sends nothing else either: power, cable, bus-off, or a device that hangs.");
    finding.check = is_alive ? fmt::format("lexican read {} 1017", node)
                             : fmt::format("power and connector of node {}; lexican scan", node);
    finding.fix = is_alive ? fmt::format("lexican write {} 1017 {}", node, producer.period() / one_ms)
                           : fmt::format("when it is back: lexican read {} 1003:1 tells its last error", node);
    for (const Producer& consumer : producers_) {
      if (consumer.emergencies.since() > producer.last) {
        finding.evidence.show_also(consumer.emergencies);
      }
    }
    findings_.put(std::move(finding));
  }

  std::array<Producer, 128> producers_{};
  using ConsumerKey = std::pair<std::uint8_t, std::uint8_t>;      ///< node, sub-index
  std::array<std::map<ConsumerKey, Consumer>, 128> consumers_{};  ///< by the producer; 0: none
  std::map<ConsumerKey, std::uint8_t> producer_of_;
  Micros last_boot_ = 0;  ///< boot-up without a command, of any node
  std::uint8_t last_boot_node_ = 0;
  bool is_prepared_ = false;
};

}  // namespace

std::unique_ptr<Check> make_error_control_check(const Facts& facts, Findings& findings) {
  return std::make_unique<ErrorControlCheck>(facts, findings);
}

}  // namespace lexican::explain
