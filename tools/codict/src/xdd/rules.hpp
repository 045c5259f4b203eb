// SPDX-License-Identifier: Apache-2.0
/// \file rules.hpp
/// Rules that the reader of XML descriptions reports.
#pragma once

#include <vector>

#include "text/finding.hpp"

namespace lexican::codict::xdd {

namespace rules {
// Text.
extern const Rule syntax;
extern const Rule doctype;
extern const Rule encoding;
// Names.
extern const Rule xml_namespace;
extern const Rule dialect;
extern const Rule unknown;
extern const Rule name_case;
extern const Rule duplicate;
extern const Rule order;
// References.
extern const Rule duplicate_id;
extern const Rule reference;
extern const Rule copies;
extern const Rule parameter_differs;
extern const Rule parameter_unused;
// Objects.
extern const Rule index;
extern const Rule hex_digits;
extern const Rule duplicate_object;
extern const Rule object_type;
extern const Rule object_type_missing;
extern const Rule type_missing;
extern const Rule type_unknown;
extern const Rule access_unknown;
extern const Rule access_missing;
extern const Rule access_case;
extern const Rule pdo_mapping;
extern const Rule property;
extern const Rule list_count;
// Features of the device and file.
extern const Rule boolean;
extern const Rule bit_rate;
extern const Rule dummy;
extern const Rule file_name;
}  // namespace rules

/// Returns the rules of this file.
const std::vector<const Rule*>& all_rules();

}  // namespace lexican::codict::xdd
