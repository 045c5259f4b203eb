// SPDX-License-Identifier: Apache-2.0
#include "check/check.hpp"
#include "check/network.hpp"

namespace lexican::codict::check {

namespace rules {

const Rule sub_number{"od-sub-number", Severity::warning,
                      "SubNumber is the number of sub-objects, sub-index 0 with them: what is described decides."};
const Rule sub_zero_missing{"od-sub-zero-missing", Severity::warning, "An ARRAY or RECORD has a sub-index 0."};
const Rule sub_zero_value{"od-sub-zero-value", Severity::warning,
                          "Sub-index 0 has a default: without one, the highest sub-index is taken."};
const Rule sub_zero_small{"od-sub-zero-small", Severity::warning,
                          "Sub-index 0 is not smaller than the highest sub-index that is there."};
const Rule sub_zero_large{"od-sub-zero-large", Severity::warning,
                          "Sub-index 0 that cannot be written is not above the highest sub-index that is there."};
const Rule limit_order{"od-limit-order", Severity::warning, "The low limit is not above the high limit."};
const Rule limit{"od-limit", Severity::error, "A value lies within its limits."};
const Rule pdo_count{"od-pdo-count", Severity::warning, "The device has as many PDOs as it says."};
const Rule identity{"od-identity", Severity::warning, "The device says the same of its identity as its object 1018h."};
const Rule type_complex{"od-type-complex", Severity::warning, "A VAR or sub-object has the type of one value."};
const Rule unmappable{"od-unmappable", Severity::warning, "What can be mapped has a length: a DOMAIN has none."};
const Rule array_types{"od-array-types", Severity::warning, "The elements of an ARRAY have one type."};
const Rule string_capacity{"od-string-capacity", Severity::warning, "A string has room for its default value."};
const Rule link{"od-link", Severity::warning, "An object link names an object of the device."};
const Rule module_list{"od-module-list", Severity::warning,
                       "A device with modules has their list, which is object 1027h."};
const Rule module_object{"od-module-object", Severity::warning,
                         "An object that a module brings along is none of the coupler itself."};
const Rule module_number{"od-module-number", Severity::warning, "A connected module is one that is described."};
const Rule former{"od-former", Severity::note, "Objects 1004h, 100Bh, 100Eh and 100Fh are no longer used."};
const Rule store_pair{"od-store-pair", Severity::note, "What 1010h stores is what 1011h restores."};
const Rule granularity{"od-granularity", Severity::warning, "The granularity is 0 to 64 bits."};
const Rule standard_kind{"od-standard-kind", Severity::note,
                         "An object of the communication profile is a VAR, ARRAY or RECORD as in CiA 301."};
const Rule standard_type{"od-standard-type", Severity::warning,
                         "An object of the communication profile has the data type that CiA 301 gives it."};

}  // namespace rules

void check_all(const Device& device, Findings& findings) {
  check_objects(device, findings);
  check_device(device, findings);
  check_structure(device, findings);
  check_standard(device, findings);
  check_pdo_parameters(device, findings);
  check_multiplexed(device, findings);
  check_cob_ids(device, findings);
  check_services(device, findings);
}

const std::vector<const Rule*>& all_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {&sub_number,      &sub_zero_missing,
                                               &sub_zero_value,  &sub_zero_small,
                                               &sub_zero_large,  &limit_order,
                                               &limit,           &pdo_count,
                                               &identity,        &type_complex,
                                               &unmappable,      &array_types,
                                               &string_capacity, &link,
                                               &module_list,     &module_object,
                                               &module_number,   &former,
                                               &store_pair,      &granularity,
                                               &standard_kind,   &standard_type};
  return all;
}

}  // namespace lexican::codict::check
