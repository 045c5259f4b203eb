// SPDX-License-Identifier: Apache-2.0
/// \file rules.hpp
/// Rules of the generator: faults that prevent generation, and remarks on the generated dictionary.
#pragma once

#include <vector>

#include "text/finding.hpp"

namespace lexican::codict::gen::rules {

extern const Rule type;
extern const Rule access;
extern const Rule value;
extern const Rule value_none;
extern const Rule node_id;
extern const Rule no_subs;
extern const Rule place;
extern const Rule name;
extern const Rule name_shared;
extern const Rule count;
extern const Rule store;
extern const Rule store_joined;
extern const Rule restore;
extern const Rule store_unused;
extern const Rule pdo_bits;
extern const Rule pdo_object;
extern const Rule pdo_off;
extern const Rule pdo_mappable;
extern const Rule pdo_direction;
extern const Rule pdo_trigger;
extern const Rule limits;
extern const Rule limits_default;
extern const Rule sub_zero;
extern const Rule cob_id;
extern const Rule srdo_signature;
extern const Rule left_out;
extern const Rule external;
extern const Rule capacity;

}  // namespace lexican::codict::gen::rules

namespace lexican::codict::gen {

/// Returns all rules of this module.
const std::vector<const Rule*>& all_rules();

}  // namespace lexican::codict::gen
