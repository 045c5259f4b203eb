// SPDX-License-Identifier: Apache-2.0
#include "network/traffic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

#include "model/srdo.hpp"
#include "network/check.hpp"
#include "network/rules.hpp"

namespace lexican::codict::network {

namespace {

constexpr Nanoseconds us = 1000;
constexpr Nanoseconds ms = 1000 * us;

Nanoseconds microseconds(std::uint64_t time) { return static_cast<Nanoseconds>(time) * us; }
Nanoseconds milliseconds(std::uint64_t time) { return static_cast<Nanoseconds>(time) * ms; }

class Collector {
 public:
  Collector(const Network& network, const Links& links, NetworkFindings& findings)
      : network_(network), links_(links), findings_(findings) {}

  std::vector<Message> collect();

 private:
  Message& add(std::string service, std::size_t node, const Frame& frame, Nanoseconds shortest, Nanoseconds usual) {
    Message message;
    message.service = std::move(service);
    message.node = node;
    message.frame = frame;
    message.longest = longest_bits(frame);
    message.mean = mean_bits(frame);
    message.shortest_period = shortest;
    message.usual_period = usual;
    message.deadline = shortest;
    return messages_.emplace_back(std::move(message));
  }
  // Adds frames whose data is known, or that have no data.
  void add_exact(std::string service, std::size_t node, const Frame& frame, std::string_view data, Nanoseconds period) {
    Message& message = add(std::move(service), node, frame, period, period);
    message.longest = exact_bits(frame, data);
    message.mean = message.longest;
  }
  void add_sync();
  void add_pdo(const ActivePdo& pdo);
  void add_event_driven(const ActivePdo& pdo, const Frame& frame);
  void add_error_control(std::size_t at);
  void add_safety(std::size_t at, const CobId& cob_id, Frame frame);
  void add_others(std::size_t at);

  const Network& network_;
  const Links& links_;
  NetworkFindings& findings_;
  std::vector<Message> messages_;
  Nanoseconds sync_period_ = 0;
  Nanoseconds sync_window_ = 0;
};

void Collector::add_sync() {
  const int found = sync_producer(network_);
  if (found < 0) {
    return;
  }
  const auto producer = static_cast<std::size_t>(found);
  const Node& node = network_.nodes[producer];
  const std::uint64_t cob_id = node.number_or(0x1005, 0, 0x80);
  const bool is_extended = (cob_id & cob_id_extended) != 0;
  const bool has_counter = node.number_or(0x1019, 0, 0) != 0;
  sync_period_ = microseconds(node.number_or(0x1006, 0, 0));
  sync_window_ = microseconds(node.number_or(0x1007, 0, 0));
  const Frame frame{static_cast<std::uint32_t>(cob_id & (is_extended ? 0x1FFFFFFFU : 0x7FFU)), is_extended, false,
                    has_counter ? std::uint8_t{1} : std::uint8_t{0}};
  if (has_counter) {
    add("SYNC", producer, frame, sync_period_, sync_period_);
  } else {
    add_exact("SYNC", producer, frame, "", sync_period_);
  }
}

void Collector::add_event_driven(const ActivePdo& pdo, const Frame& frame) {
  const Node& node = network_.nodes[pdo.node];
  const std::uint16_t index = pdo.pdo.communication->index;
  const Nanoseconds inhibit = static_cast<Nanoseconds>(node.number_or(index, 3, 0)) * 100 * us;
  const Nanoseconds event = milliseconds(node.number_or(index, 5, 0));
  const Nanoseconds assumed = milliseconds(network_.event_interval_ms);
  if (inhibit != 0 || assumed != 0) {
    add(pdo.title(), pdo.node, frame, inhibit != 0 ? inhibit : assumed, event);
    return;
  }
  add(pdo.title(), pdo.node, frame, event, event);
  findings_.add(rules::event_unbounded, pdo.node, pdo.pdo.parameter(3),
                fmt::format("{} of {} ({}) has no inhibit time: {}", pdo.title(), node.title(),
                            cob_id_text(pdo.identifier, pdo.is_extended),
                            event != 0 ? "the worst case counts its event timer only" : "it is not in the worst case"),
                "set an inhibit time (sub-index 3), or event_interval in the options of the plan");
}

void Collector::add_pdo(const ActivePdo& pdo) {
  const Node& node = network_.nodes[pdo.node];
  const Frame frame{pdo.identifier, pdo.is_extended, false, pdo.bytes()};
  const std::uint64_t type = node.number_or(pdo.pdo.communication->index, 2, transmission_type::event_profile);
  if (type >= transmission_type::event_manufacturer) {
    add_event_driven(pdo, frame);
  } else if (type <= transmission_type::last_synchronous) {
    const Nanoseconds period = sync_period_ * static_cast<Nanoseconds>(std::max<std::uint64_t>(type, 1));
    Message& message = add(pdo.title(), pdo.node, frame, period, type == 0 ? 0 : period);
    message.deadline = sync_window_ != 0 ? sync_window_ : sync_period_;
  } else {
    add(pdo.title(), pdo.node, frame, 0, 0);  // on remote requests only
  }
}

void Collector::add_error_control(std::size_t at) {
  const Node& node = network_.nodes[at];
  const std::uint32_t identifier = 0x700U + node.node_id;
  constexpr std::string_view operational("\x05", 1);
  const std::uint64_t heartbeat = node.number_or(0x1017, 0, 0);
  if (heartbeat != 0) {
    add_exact("heartbeat", at, {identifier, false, false, 1}, operational, milliseconds(heartbeat));
    return;
  }
  for (std::size_t n = 0; n < network_.nodes.size(); ++n) {
    const Node& master = network_.nodes[n];
    const std::uint64_t guard_time = master.is_master ? master.number_or(0x1F81, node.node_id, 0) >> 16 : 0;
    if (guard_time != 0) {
      add_exact("guarding request", n, {identifier, false, true, 1}, "", milliseconds(guard_time));
      add("guarding response", at, {identifier, false, false, 1}, milliseconds(guard_time), milliseconds(guard_time));
      return;
    }
  }
}

// Adds a frame of a transmitted SRDO with its refresh time, or the GFC, which is transmitted rarely.
void Collector::add_safety(std::size_t at, const CobId& cob_id, Frame frame) {
  if (cob_id.index == srdo_index::global_fail_safe) {
    add(cob_id.service, at, {frame.identifier, false, false, 0}, 0, 0);
    return;
  }
  for (const Srdo& srdo : srdos_of(network_.nodes[at].device)) {
    if (srdo.communication->index == cob_id.index && srdo.is_transmit()) {
      const auto refresh = static_cast<unsigned>(network_.nodes[at].number_or(cob_id.index, 2, 0));
      frame.bytes = srdo.bytes();
      add(cob_id.service, at, frame, milliseconds(refresh), milliseconds(refresh));
    }
  }
}

// Adds EMCY with its inhibit time, and SDO, NMT and TIME, which are transmitted rarely.
void Collector::add_others(std::size_t at) {
  const Node& node = network_.nodes[at];
  for (const CobId& cob_id : node.cob_ids()) {
    const Frame frame{cob_id.identifier(), cob_id.is_extended(), false, 8};
    if (!cob_id.is_valid()) {
      continue;
    }
    if (cob_id.service == "EMCY") {
      add("EMCY", at, frame, static_cast<Nanoseconds>(node.number_or(0x1015, 0, 0)) * 100 * us, 0);
    } else if (cob_id.is_safety) {
      add_safety(at, cob_id, frame);
    } else if (cob_id.service.substr(0, 10) == "SDO server") {
      add(cob_id.service, at, frame, 0, 0);
    } else if (cob_id.service == "TIME" && (cob_id.value & 0x40000000U) != 0) {
      add("TIME", at, {frame.identifier, frame.is_extended, false, 6}, 0, 0);
    }
  }
  if (node.is_master) {
    add("NMT", at, {0, false, false, 2}, static_cast<Nanoseconds>(node.number_or(0x102A, 0, 0)) * 100 * us, 0);
  }
}

// Returns the arbitration order: the base identifier, then 11-bit before 29-bit frames, then data before remote frames.
std::tuple<std::uint32_t, bool, std::uint32_t, bool> priority_of(const Message& message) {
  const Frame& frame = message.frame;
  return {frame.is_extended ? frame.identifier >> 18 : frame.identifier, frame.is_extended,
          frame.is_extended ? frame.identifier & 0x3FFFFU : 0U, frame.is_remote};
}

std::vector<Message> Collector::collect() {
  add_sync();
  for (const ActivePdo& pdo : links_.pdos) {
    if (pdo.pdo.is_transmit) {
      add_pdo(pdo);
    }
  }
  for (std::size_t n = 0; n < network_.nodes.size(); ++n) {
    if (network_.nodes[n].node_id != 0) {
      add_error_control(n);
      add_others(n);
    }
  }
  std::stable_sort(messages_.begin(), messages_.end(),
                   [](const Message& a, const Message& b) { return priority_of(a) < priority_of(b); });
  return std::move(messages_);
}

double load_of(double bits, Nanoseconds period, std::uint32_t bit_rate) {
  // kbit/s equals bits per ms
  return period == 0 ? 0 : 100.0 * bits * static_cast<double>(ms) / (static_cast<double>(period) * bit_rate);
}

void add_responses(Traffic& traffic) {
  const Nanoseconds bit_time = (ms + traffic.bit_rate - 1) / traffic.bit_rate;
  std::vector<Stream> streams;
  streams.reserve(traffic.messages.size());
  for (const Message& message : traffic.messages) {
    const Nanoseconds transmission =
        (static_cast<Nanoseconds>(message.longest) * ms + traffic.bit_rate - 1) / traffic.bit_rate;
    streams.push_back({transmission, message.shortest_period, 0});
  }
  const std::vector<std::optional<Nanoseconds>> times = response_times(streams, bit_time);
  for (std::size_t n = 0; n < times.size(); ++n) {
    traffic.messages[n].response = times[n];
  }
}

std::string in_ms(Nanoseconds time) {
  return fmt::format("{:.3f} ms", static_cast<double>(time) / static_cast<double>(ms));
}

constexpr const char* response_remedy = "give it a lower COB-ID, others longer periods, or use a higher bit rate";

void check_traffic(const Network& network, const Traffic& traffic, NetworkFindings& findings) {
  for (const Message& message : traffic.messages) {
    const std::string title = fmt::format("{} of {} ({})", message.service, network.nodes[message.node].title(),
                                          cob_id_text(message.frame.identifier, message.frame.is_extended));
    if (message.shortest_period != 0 && !message.response) {
      findings.add(rules::response, message.node, nullptr,
                   title + " may wait without bound: frames of its priority and higher ones fill the bus",
                   response_remedy);
    } else if (message.response && *message.response > message.deadline) {
      findings.add(rules::response, message.node, nullptr,
                   fmt::format("{} takes up to {}, its deadline is {}", title, in_ms(*message.response),
                               in_ms(message.deadline)),
                   response_remedy);
    }
  }
  if (traffic.worst_load > network.load_limit) {
    findings.add(
        rules::load, 0, nullptr,
        fmt::format("worst-case bus load {:.1f} %, the limit is {:.1f} %", traffic.worst_load, network.load_limit),
        "use a higher bit rate, longer periods or inhibit times, or another load_limit");
  }
}

}  // namespace

double Message::worst_load(std::uint32_t bit_rate) const { return load_of(longest, shortest_period, bit_rate); }
double Message::average_load(std::uint32_t bit_rate) const { return load_of(mean, usual_period, bit_rate); }

Traffic traffic_of(const Network& network, const Links& links, NetworkFindings& findings) {
  Traffic traffic;
  traffic.bit_rate = network.bit_rate;
  traffic.messages = Collector(network, links, findings).collect();
  if (network.bit_rate == 0) {
    return traffic;
  }
  for (const Message& message : traffic.messages) {
    traffic.worst_load += message.worst_load(network.bit_rate);
    traffic.average_load += message.average_load(network.bit_rate);
  }
  add_responses(traffic);
  check_traffic(network, traffic, findings);
  return traffic;
}

}  // namespace lexican::codict::network
