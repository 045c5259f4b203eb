// SPDX-License-Identifier: Apache-2.0
#include "network/rules.hpp"

namespace lexican::codict::network {

namespace rules {

const Rule yaml{"net-yaml", Severity::error, "the plan is not a YAML document that codict reads"};
const Rule key{"net-key", Severity::error, "unknown key in a plan"};
const Rule key_ros{"net-key-ros", Severity::warning, "key in a plan of ROS 2 that has no effect here"};
const Rule defaults{"net-defaults", Severity::note, "defaults of a plan, used for each node"};
const Rule value{"net-value", Severity::error, "value of a key of the plan is out of range or of the wrong kind"};
const Rule missing{"net-missing", Severity::error, "missing key in a plan"};
const Rule node_id{"net-node-id", Severity::error, "node-ID that is missing, invalid or used twice"};
const Rule object{"net-object", Severity::error, "configured object that the description lacks or that is read-only"};
const Rule mapping{"net-mapping", Severity::error, "PDO mapping that the device cannot have"};
const Rule bit_rate{"net-bit-rate", Severity::error,
                    "bit rate that a device does not support, or that differs between nodes"};
const Rule cob_id{"net-cob-id", Severity::error, "COB-ID that two services of the network transmit"};
const Rule pdo_no_consumer{"net-pdo-no-consumer", Severity::warning, "TPDO that no node receives"};
const Rule pdo_no_producer{"net-pdo-no-producer", Severity::warning, "RPDO that no node transmits"};
const Rule pdo_short{"net-pdo-short", Severity::error, "TPDO shorter than an RPDO that receives it"};
const Rule pdo_long{"net-pdo-long", Severity::warning, "TPDO longer than an RPDO that receives it"};
const Rule pdo_deadline{"net-pdo-deadline", Severity::warning, "RPDO deadline shorter than the TPDO's period"};
const Rule heartbeat_producer{"net-heartbeat-producer", Severity::error,
                              "heartbeat consumer of a node that does not produce a heartbeat"};
const Rule heartbeat_time{"net-heartbeat-time", Severity::error, "heartbeat consumer time not above the producer time"};
const Rule heartbeat_twice{"net-heartbeat-guarding", Severity::warning, "heartbeat and node guarding on one node"};
const Rule unmonitored{"net-unmonitored", Severity::note, "node that no other node monitors"};
const Rule guarding{"net-guarding", Severity::warning, "life guarding of a node that no master guards often enough"};
const Rule sync_missing{"net-sync-missing", Severity::error, "synchronous PDO in a network without SYNC producer"};
const Rule sync_period{"net-sync-period", Severity::warning, "SYNC period that is missing or differs between nodes"};
const Rule sync_producers{"net-sync-producers", Severity::error, "more than one SYNC producer"};
const Rule sync_cob_id{"net-sync-cob-id", Severity::error, "SYNC consumer with another COB-ID than the producer"};
const Rule sync_counter{"net-sync-counter", Severity::error,
                        "SYNC counter overflow or start value that does not match the producer's"};
const Rule event_unbounded{"net-event-unbounded", Severity::warning,
                           "event-driven TPDO without inhibit time: the bus load has no bound"};
const Rule load{"net-load", Severity::warning, "worst-case bus load above the limit"};
const Rule response{"net-response", Severity::warning, "worst-case response time above the deadline"};
const Rule concise{"net-concise", Severity::warning, "configured value that a concise DCF cannot have"};

}  // namespace rules

const std::vector<const Rule*>& all_rules() {
  static const std::vector<const Rule*> all = {&rules::yaml,
                                               &rules::key,
                                               &rules::key_ros,
                                               &rules::defaults,
                                               &rules::value,
                                               &rules::missing,
                                               &rules::node_id,
                                               &rules::object,
                                               &rules::mapping,
                                               &rules::bit_rate,
                                               &rules::cob_id,
                                               &rules::pdo_no_consumer,
                                               &rules::pdo_no_producer,
                                               &rules::pdo_short,
                                               &rules::pdo_long,
                                               &rules::pdo_deadline,
                                               &rules::heartbeat_producer,
                                               &rules::heartbeat_time,
                                               &rules::heartbeat_twice,
                                               &rules::unmonitored,
                                               &rules::guarding,
                                               &rules::sync_missing,
                                               &rules::sync_period,
                                               &rules::sync_producers,
                                               &rules::sync_cob_id,
                                               &rules::sync_counter,
                                               &rules::event_unbounded,
                                               &rules::load,
                                               &rules::response,
                                               &rules::concise};
  return all;
}

}  // namespace lexican::codict::network
