// SPDX-License-Identifier: Apache-2.0
/// \file rules.hpp
/// Rules of codict network. Their ids begin with net-.
#pragma once

#include <vector>

#include "text/finding.hpp"

namespace lexican::codict::network {

namespace rules {
extern const Rule yaml;
extern const Rule key;
extern const Rule key_ros;
extern const Rule defaults;
extern const Rule value;
extern const Rule missing;
extern const Rule node_id;
extern const Rule object;
extern const Rule mapping;
extern const Rule bit_rate;
extern const Rule cob_id;
extern const Rule pdo_no_consumer;
extern const Rule pdo_no_producer;
extern const Rule pdo_short;
extern const Rule pdo_long;
extern const Rule pdo_deadline;
extern const Rule heartbeat_producer;
extern const Rule heartbeat_time;
extern const Rule heartbeat_twice;
extern const Rule unmonitored;
extern const Rule guarding;
extern const Rule sync_missing;
extern const Rule sync_period;
extern const Rule sync_producers;
extern const Rule sync_cob_id;
extern const Rule sync_counter;
extern const Rule event_unbounded;
extern const Rule load;
extern const Rule response;
extern const Rule concise;
}  // namespace rules

const std::vector<const Rule*>& all_rules();

}  // namespace lexican::codict::network
