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
const Rule limit_order{"od-limit-order", Severity::warning, "The low limit is not above the high limit."};
const Rule limit{"od-limit", Severity::error, "A value lies within its limits."};
const Rule pdo_count{"od-pdo-count", Severity::warning, "The device has as many PDOs as it says."};
const Rule identity{"od-identity", Severity::warning, "The device says the same of its identity as its object 1018h."};

}  // namespace rules

void check_all(const Device& device, Findings& findings) {
  check_objects(device, findings);
  check_device(device, findings);
  check_pdo_parameters(device, findings);
  check_cob_ids(device, findings);
  check_services(device, findings);
}

const std::vector<const Rule*>& all_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {
      &sub_number, &sub_zero_missing, &sub_zero_value, &sub_zero_small, &limit_order, &limit, &pdo_count, &identity};
  return all;
}

}  // namespace lexican::codict::check
