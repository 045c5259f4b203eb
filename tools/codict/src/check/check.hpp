// SPDX-License-Identifier: Apache-2.0
/// \file check.hpp
/// Checks of a device model, independent of the format of its description.
#pragma once

#include <vector>

#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::check {

/// Runs all checks of this module.
void check_all(const Device& device, Findings& findings);

/// Checks objects, sub-objects and their values. [301: 7.4]
void check_objects(const Device& device, Findings& findings);

/// Checks the device-wide entries of the description, also against the objects.
void check_device(const Device& device, Findings& findings);

/// Checks relations between objects: types, links, modules, pairs.
void check_structure(const Device& device, Findings& findings);

/// Checks the objects of the communication profile against CiA 301.
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
extern const Rule node_id;
extern const Rule bit_rate;
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
