// SPDX-License-Identifier: Apache-2.0
/// \file network.hpp
/// Checks of the communication of a device: PDOs, COB-IDs, and objects that configure services.
#pragma once

#include <vector>

#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::check {

/// Checks mapping and communication parameters of PDOs. [301: 7.5.2.35 ff.]
void check_pdo_parameters(const Device& device, Findings& findings);

/// Checks multiplex PDOs. [301: 7.2.2.6]
void check_multiplexed(const Device& device, Findings& findings);

/// Checks that COB-IDs are unique and not restricted by CiA 301. [301: 7.3.5]
void check_cob_ids(const Device& device, Findings& findings);

/// Checks that mandatory objects exist, and the fields of objects that configure services.
void check_services(const Device& device, Findings& findings);

/// Checks SRDOs, their signatures, and PDOs that map their objects. [EN 50325-5]
void check_srdos(const Device& device, Findings& findings);

namespace rules {
extern const Rule pdo_pair;
extern const Rule pdo_object;
extern const Rule pdo_access;
extern const Rule pdo_bits;
extern const Rule pdo_part;
extern const Rule pdo_length;
extern const Rule pdo_gap;
extern const Rule pdo_empty;
extern const Rule pdo_mapped_count;
extern const Rule pdo_dummy;
extern const Rule pdo_granularity;
extern const Rule pdo_type;
extern const Rule pdo_time;
extern const Rule pdo_sync;
extern const Rule multiplexed;
extern const Rule multiplexed_list;
extern const Rule multiplexed_type;
extern const Rule cob_id_restricted;
extern const Rule cob_id_twice;
extern const Rule cob_id_form;
extern const Rule mandatory;
extern const Rule error_control;
extern const Rule sdo_default;
extern const Rule consumer_entry;
extern const Rule consumer_twice;
extern const Rule sync_window;
extern const Rule srdo_missing;
extern const Rule srdo_parameter;
extern const Rule srdo_mapping;
extern const Rule srdo_object;
extern const Rule srdo_signature;
extern const Rule srdo_signature_zero;
extern const Rule srdo_pdo;
}  // namespace rules

const std::vector<const Rule*>& network_rules();

}  // namespace lexican::codict::check
