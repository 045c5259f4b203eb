// SPDX-License-Identifier: Apache-2.0
#include "network/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "network/rules.hpp"

namespace lexican::codict::network {

namespace {

std::uint64_t transmission_of(const Network& network, const ActivePdo& pdo) {
  return network.nodes[pdo.node].number_or(pdo.pdo.communication->index, 2, transmission_type::event_profile);
}

std::uint64_t parameter_of(const Network& network, const ActivePdo& pdo, std::uint8_t sub_index) {
  return network.nodes[pdo.node].number_or(pdo.pdo.communication->index, sub_index, 0);
}

bool is_synchronous(const Network& network, const ActivePdo& pdo) {
  const std::uint64_t type = transmission_of(network, pdo);
  return type <= transmission_type::last_synchronous ||
         (type == transmission_type::remote_synchronous && pdo.pdo.is_transmit);
}

// Returns "TPDO 1 of drive (node 2)".
std::string title_of(const Network& network, const ActivePdo& pdo) {
  return fmt::format("{} of {}", pdo.title(), network.nodes[pdo.node].title());
}

std::string cob_id_of(const ActivePdo& pdo) { return cob_id_text(pdo.identifier, pdo.is_extended); }

// Returns true if a COB-ID may be used by one service only. The request of an SDO server is included although the
// client transmits it: two servers with the same request COB-ID would both respond.
bool is_owned(const CobId& cob_id) {
  const std::string_view service = cob_id.service;
  const auto begins = [service](std::string_view word) { return service.substr(0, word.size()) == word; };
  const bool is_received = cob_id.is_safety && service.find(" received,") != std::string_view::npos;
  const bool is_shared = begins("SYNC") || begins("TIME") || begins("NMT") || begins("GFC") || is_received;
  return !is_shared && !begins("RPDO") && !begins("SDO client");
}

}  // namespace

void check_all(const Network& network, const Links& links, NetworkFindings& findings) {
  check_nodes(network, findings);
  check_cob_ids(network, findings);
  check_links(network, links, findings);
  check_error_control(network, findings);
  check_sync(network, links, findings);
}

// COB-IDs ----------------------------------------------------------------------------------------------------------

namespace {

// Service that uses a COB-ID, and its node (index in Network::nodes).
struct Owner {
  std::size_t node = 0;
  std::string service;
};
using Owners = std::map<std::uint64_t, Owner>;  // by identifier; bit 32 is set for 29 bits

std::uint64_t key_of(const CobId& cob_id) { return cob_id.identifier() | (cob_id.is_extended() ? 1ULL << 32 : 0); }

// Returns the first node that has a node-ID.
std::optional<std::size_t> node_of(const Network& network, std::uint64_t node_id) {
  const auto place = std::find_if(network.nodes.begin(), network.nodes.end(),
                                  [node_id](const Node& node) { return node.node_id == node_id; });
  return place != network.nodes.end() ? std::optional(static_cast<std::size_t>(place - network.nodes.begin()))
                                      : std::nullopt;
}

void check_cob_id(const Network& network, std::size_t at, const CobId& cob_id, Owners& owners,
                  NetworkFindings& findings) {
  const Node& node = network.nodes[at];
  const auto [place, is_new] = owners.emplace(key_of(cob_id), Owner{at, cob_id.service});
  if (!is_new && place->second.node != at) {
    findings.add(rules::cob_id, at, node.device.find(cob_id.index, cob_id.sub_index),
                 fmt::format("COB-ID {} of {}, {}, is also that of {}, {}",
                             cob_id_text(cob_id.identifier(), cob_id.is_extended()), node.title(), cob_id.service,
                             network.nodes[place->second.node].title(), place->second.service),
                 "give one of them another COB-ID, or set bit 31");
  }
}

}  // namespace

void check_cob_ids(const Network& network, NetworkFindings& findings) {
  Owners owners;
  const int producer = sync_producer(network);
  if (producer >= 0) {
    const auto at = static_cast<std::size_t>(producer);
    CobId sync;
    sync.value = static_cast<std::uint32_t>(network.nodes[at].number_or(0x1005, 0, 0x80));
    owners[key_of(sync)] = {at, "SYNC"};
  }
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    const std::uint8_t node_id = network.nodes[n].node_id;
    if (node_id == 0 || node_of(network, node_id) != n) {  // reported by check_nodes()
      continue;
    }
    for (const CobId& cob_id : network.nodes[n].cob_ids()) {
      if (cob_id.is_valid() && is_owned(cob_id)) {
        check_cob_id(network, n, cob_id, owners, findings);
      }
    }
  }
}

// PDO links --------------------------------------------------------------------------------------------------------

namespace {

const Entry* cob_id_entry(const ActivePdo& pdo) { return pdo.pdo.parameter(1); }

void check_unconnected(const Network& network, const Links& links, std::size_t at, NetworkFindings& findings) {
  const ActivePdo& pdo = links.pdos[at];
  if (links.are_connected[at]) {
    return;
  }
  const bool is_transmit = pdo.pdo.is_transmit;
  findings.add(is_transmit ? rules::pdo_no_consumer : rules::pdo_no_producer, pdo.node, cob_id_entry(pdo),
               fmt::format("{} ({}) has no {}: no node has {} with this COB-ID", title_of(network, pdo), cob_id_of(pdo),
                           is_transmit ? "consumer" : "producer", is_transmit ? "an RPDO" : "a TPDO"),
               fmt::format("configure the other side, or disable the PDO ({}pdo: {{{}: {{enabled: false}}}})",
                           is_transmit ? 't' : 'r', pdo.pdo.number));
}

// Returns the longest period of a TPDO in ms, 0 if it is unknown: types 0, 252 and 253 have none, and the event timer
// applies to types 254 and 255 only. [301:7.5.2.37]
std::uint64_t longest_period_ms(const Network& network, const ActivePdo& pdo) {
  const std::uint64_t type = transmission_of(network, pdo);
  if (type == 0 || type > transmission_type::last_synchronous) {
    return type >= transmission_type::event_manufacturer ? parameter_of(network, pdo, 5) : 0;
  }
  const int producer = sync_producer(network);
  return producer < 0 ? 0 : type * network.nodes[static_cast<std::size_t>(producer)].number_or(0x1006, 0, 0) / 1000;
}

void check_length(const Network& network, const ActivePdo& from, const ActivePdo& to, NetworkFindings& findings) {
  if (from.pdo.is_multiplexed || to.pdo.is_multiplexed || from.bytes() == to.bytes()) {
    return;
  }
  const bool is_short = from.bytes() < to.bytes();
  findings.add(is_short ? rules::pdo_short : rules::pdo_long, to.node, cob_id_entry(to),
               fmt::format("{} maps {} bytes, {} has {} ({}): {}", title_of(network, to), to.bytes(),
                           title_of(network, from), from.bytes(), cob_id_of(from),
                           is_short ? "it is dropped, with EMCY 8210h" : "the last ones are not used"),
               "map the same objects on both sides");
}

void check_deadline(const Network& network, const ActivePdo& from, const ActivePdo& to, NetworkFindings& findings) {
  const std::uint64_t deadline = parameter_of(network, to, 5);
  const std::uint64_t period = longest_period_ms(network, from);
  if (deadline != 0 && period != 0 && deadline <= period && !is_synchronous(network, to)) {
    findings.add(rules::pdo_deadline, to.node, to.pdo.parameter(5),
                 fmt::format("{} has a deadline of {} ms; {} comes every {} ms ({})", title_of(network, to), deadline,
                             title_of(network, from), period, cob_id_of(from)),
                 fmt::format("set the event timer of the RPDO above {} ms", period));
  }
}

}  // namespace

void check_links(const Network& network, const Links& links, NetworkFindings& findings) {
  for (std::size_t n = 0; n < links.pdos.size(); ++n) {
    check_unconnected(network, links, n, findings);
  }
  for (const Link& link : links.links) {
    check_length(network, links.pdos[link.producer], links.pdos[link.consumer], findings);
    check_deadline(network, links.pdos[link.producer], links.pdos[link.consumer], findings);
  }
}

// Heartbeat and guarding -------------------------------------------------------------------------------------------

namespace {

void check_consumer(const Network& network, std::size_t at, const codict::Sub& sub, std::vector<bool>& is_monitored,
                    NetworkFindings& findings) {
  const Node& node = network.nodes[at];
  const std::uint64_t value = node.number_or(0x1016, sub.sub_index, 0);
  const std::uint64_t time = value & 0xFFFFU;
  const std::uint64_t producer_id = value >> 16;
  if (time == 0 || producer_id == 0 || producer_id > 127) {
    return;
  }
  const std::optional<std::size_t> producer = node_of(network, producer_id);
  const std::uint64_t period = producer ? network.nodes[*producer].number_or(0x1017, 0, 0) : 0;
  if (!producer || period == 0) {
    findings.add(
        rules::heartbeat_producer, at, &sub,
        producer ? fmt::format("{} expects the heartbeat of {}, which produces none (1017h is 0)", node.title(),
                               network.nodes[*producer].title())
                 : fmt::format("{} expects the heartbeat of node {}, which is not in the network", node.title(),
                               producer_id),
        producer ? "set heartbeat_producer of that node, or remove the entry of 1016h" : "remove the entry of 1016h");
    return;
  }
  is_monitored[*producer] = true;
  if (time <= period) {
    findings.add(rules::heartbeat_time, at, &sub,
                 fmt::format("{} expects the heartbeat of {} within {} ms, and it comes every {} ms", node.title(),
                             network.nodes[*producer].title(), time, period),
                 fmt::format("use a consumer time above {} ms, e.g. {}", period, 3 * period));
  }
}

void check_consumers(const Network& network, std::size_t at, std::vector<bool>& is_monitored,
                     NetworkFindings& findings) {
  const Object* const consumers = network.nodes[at].device.find(0x1016);
  if (consumers == nullptr) {
    return;
  }
  for (const codict::Sub& sub : consumers->subs) {
    if (sub.sub_index != 0) {
      check_consumer(network, at, sub, is_monitored, findings);
    }
  }
}

// Returns the guard time in ms, 0 if the master does not guard the node.
std::uint64_t guard_time(const Network& network, const Node& slave) {
  for (const Node& node : network.nodes) {
    const std::uint64_t assignment = node.is_master ? node.number_or(0x1F81, slave.node_id, 0) : 0;
    if (assignment >> 16 != 0) {
      return assignment >> 16;
    }
  }
  return 0;
}

void check_guarding(const Network& network, std::size_t at, NetworkFindings& findings) {
  const Node& node = network.nodes[at];
  const std::uint64_t life_time = node.number_or(0x100C, 0, 0) * node.number_or(0x100D, 0, 0);
  const std::uint64_t requested = guard_time(network, node);
  if (node.number_or(0x1017, 0, 0) != 0 && (life_time != 0 || requested != 0)) {
    findings.add(rules::heartbeat_twice, at, node.device.find(0x1017, 0),
                 fmt::format("{} has heartbeat (1017h) and guarding: the heartbeat is used", node.title()),
                 "set the guard time to 0");
    return;
  }
  if (life_time != 0 && requested == 0) {
    findings.add(rules::guarding, at, node.device.find(0x100C, 0),
                 fmt::format("{} has life guarding ({} ms), and no master guards it (1F81h)", node.title(), life_time),
                 "set guard_time in the plan, or 100Ch to 0");
  } else if (life_time != 0 && requested >= life_time) {
    findings.add(
        rules::guarding, at, node.device.find(0x100C, 0),
        fmt::format("{} is guarded every {} ms, its life time ends after {} ms", node.title(), requested, life_time),
        "use a larger life time factor");
  }
}

}  // namespace

void check_error_control(const Network& network, NetworkFindings& findings) {
  std::vector<bool> is_monitored(network.nodes.size(), false);
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    check_consumers(network, n, is_monitored, findings);
    check_guarding(network, n, findings);
  }
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    const Node& node = network.nodes[n];
    if (!is_monitored[n] && !node.is_master && guard_time(network, node) == 0) {
      findings.add(rules::unmonitored, n, node.device.find(0x1017, 0),
                   fmt::format("no node monitors {}: its failure is not detected", node.title()),
                   "set heartbeat_producer of the node");
    }
  }
}

// SYNC -------------------------------------------------------------------------------------------------------------

int sync_producer(const Network& network) {
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    if ((network.nodes[n].number_or(0x1005, 0, 0) & 0x40000000U) != 0) {
      return static_cast<int>(n);
    }
  }
  return -1;
}

namespace {

bool uses_sync(const Network& network, const Links& links, std::size_t node) {
  return std::any_of(links.pdos.begin(), links.pdos.end(),
                     [&](const ActivePdo& pdo) { return pdo.node == node && is_synchronous(network, pdo); });
}

void check_sync_producer(const Network& network, std::size_t producer, NetworkFindings& findings) {
  const Node& node = network.nodes[producer];
  if (node.number_or(0x1006, 0, 0) == 0) {
    findings.add(rules::sync_period, producer, node.device.find(0x1006, 0),
                 fmt::format("{} produces SYNC with a period (1006h) of 0: it transmits none", node.title()),
                 "set sync_period of the master");
  }
  for (std::size_t n = producer + 1; n < network.nodes.size(); ++n) {
    if ((network.nodes[n].number_or(0x1005, 0, 0) & 0x40000000U) != 0) {
      findings.add(rules::sync_producers, n, network.nodes[n].device.find(0x1005, 0),
                   fmt::format("{} and {} produce SYNC (bit 30 of 1005h)", node.title(), network.nodes[n].title()),
                   "clear bit 30 of 1005h in one of them");
    }
  }
}

void check_sync_consumer(const Network& network, std::size_t producer, std::size_t at, NetworkFindings& findings) {
  const Node& from = network.nodes[producer];
  const Node& node = network.nodes[at];
  const std::uint64_t cob_id = node.number_or(0x1005, 0, 0x80) & 0x3FFFFFFFU;
  const std::uint64_t wanted = from.number_or(0x1005, 0, 0x80) & 0x3FFFFFFFU;
  if (cob_id != wanted) {
    findings.add(rules::sync_cob_id, at, node.device.find(0x1005, 0),
                 fmt::format("{} expects SYNC with {:03X}h, {} transmits it with {:03X}h", node.title(), cob_id,
                             from.title(), wanted),
                 "use one COB-ID in 1005h of both");
  }
  const std::uint64_t counter = node.number_or(0x1019, 0, 0);
  const std::uint64_t produced = from.number_or(0x1019, 0, 0);
  if (counter != produced && node.device.find(0x1019, 0) != nullptr) {
    findings.add(rules::sync_counter, at, node.device.find(0x1019, 0),
                 fmt::format("{} has the SYNC counter overflow value {} (1019h), {} has {}: SYNC has another length",
                             node.title(), counter, from.title(), produced),
                 fmt::format("set 1019h to {}", produced));
  }
  const std::uint64_t period = node.number_or(0x1006, 0, 0);
  const std::uint64_t transmitted = from.number_or(0x1006, 0, 0);
  if (period != 0 && transmitted != 0 && period != transmitted) {
    findings.add(rules::sync_period, at, node.device.find(0x1006, 0),
                 fmt::format("{} expects SYNC every {} us (1006h), {} transmits it every {} us", node.title(), period,
                             from.title(), transmitted),
                 "use one period in 1006h of both");
  }
}

void check_start_value(const Network& network, const ActivePdo& pdo, std::uint64_t overflow,
                       NetworkFindings& findings) {
  const std::uint64_t start = pdo.pdo.is_transmit ? parameter_of(network, pdo, 6) : 0;
  if (start > overflow && is_synchronous(network, pdo)) {
    findings.add(
        rules::sync_counter, pdo.node, pdo.pdo.parameter(6),
        fmt::format("{} starts at SYNC counter {}, the counter ends at {}", title_of(network, pdo), start, overflow),
        "set sync_overflow of the master, or sync_start to 0");
  }
}

}  // namespace

void check_sync(const Network& network, const Links& links, NetworkFindings& findings) {
  const int found = sync_producer(network);
  if (found < 0) {
    const auto pdo = std::find_if(links.pdos.begin(), links.pdos.end(),
                                  [&network](const ActivePdo& each) { return is_synchronous(network, each); });
    if (pdo != links.pdos.end()) {  // one finding for all synchronous PDOs
      findings.add(rules::sync_missing, pdo->node, pdo->pdo.parameter(2),
                   fmt::format("{} is synchronous (transmission type {}), and no node produces SYNC",
                               title_of(network, *pdo), transmission_of(network, *pdo)),
                   "set sync_period of the master");
    }
    return;
  }
  const auto producer = static_cast<std::size_t>(found);
  check_sync_producer(network, producer, findings);
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    if (n != producer && uses_sync(network, links, n)) {
      check_sync_consumer(network, producer, n, findings);
    }
  }
  const std::uint64_t overflow = network.nodes[producer].number_or(0x1019, 0, 0);
  for (const ActivePdo& pdo : links.pdos) {
    check_start_value(network, pdo, overflow, findings);
  }
}

}  // namespace lexican::codict::network
