// SPDX-License-Identifier: Apache-2.0
/// \file check.hpp
/// What is off in a device, whatever the format of its description: it is the model that is looked at.
#pragma once

#include <vector>

#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::check {

/// All checks of this room.
void check_all(const Device& device, Findings& findings);

/// Objects, sub-objects, and their values. [301: 7.4]
void check_objects(const Device& device, Findings& findings);

/// What the description says of the whole device, against its objects.
void check_device(const Device& device, Findings& findings);

/// How objects hang together: types, links, modules, pairs.
void check_structure(const Device& device, Findings& findings);

/// Objects of the communication profile against CiA 301.
void check_standard(const Device& device, Findings& findings);

namespace rules {
extern const Rule sub_number;
extern const Rule sub_zero_missing;
extern const Rule sub_zero_value;
extern const Rule sub_zero_small;
extern const Rule sub_zero_large;
extern const Rule limit_order;
extern const Rule limit;
extern const Rule pdo_count;
extern const Rule identity;
extern const Rule type_complex;
extern const Rule unmappable;
extern const Rule array_types;
extern const Rule string_capacity;
extern const Rule link;
extern const Rule module_list;
extern const Rule module_object;
extern const Rule module_number;
extern const Rule former;
extern const Rule store_pair;
extern const Rule granularity;
extern const Rule standard_kind;
extern const Rule standard_type;
}  // namespace rules

const std::vector<const Rule*>& all_rules();

}  // namespace lexican::codict::check
