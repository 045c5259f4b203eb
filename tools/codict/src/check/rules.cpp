// SPDX-License-Identifier: Apache-2.0
#include "check/check.hpp"
#include "check/network.hpp"

namespace lexican::codict::check {

namespace rules {

const Rule sub_number{"od-sub-number", Severity::warning, "SubNumber differs from the number of sub-objects"};
const Rule sub_zero_missing{"od-sub-zero-missing", Severity::warning, "ARRAY or RECORD without sub-index 0"};
const Rule sub_zero_value{"od-sub-zero-value", Severity::warning, "sub-index 0 without a default value"};
const Rule sub_zero_small{"od-sub-zero-small", Severity::warning, "sub-index 0 smaller than the highest sub-index"};
const Rule sub_zero_large{"od-sub-zero-large", Severity::warning, "sub-index 0 larger than the highest sub-index"};
const Rule limit_order{"od-limit-order", Severity::warning, "LowLimit above HighLimit"};
const Rule limit{"od-limit", Severity::error, "default or configured value outside LowLimit and HighLimit"};
const Rule pdo_count{"od-pdo-count", Severity::warning,
                     "NrOfRXPDO or NrOfTXPDO differs from the PDOs that are described"};
const Rule identity{"od-identity", Severity::warning, "identity in DeviceInfo differs from object 1018h"};
const Rule node_id{"od-node-id", Severity::error, "node-ID that is neither 1 to 127 nor FFh (unconfigured)"};
const Rule bit_rate{"od-bit-rate", Severity::warning, "bit rate that CiA 301 does not define"};
const Rule type_complex{"od-type-complex", Severity::warning, "VAR or sub-object whose data type is a structure"};
const Rule unmappable{"od-unmappable", Severity::warning, "DOMAIN with PDO mapping"};
const Rule array_types{"od-array-types", Severity::warning, "ARRAY with elements of different data types"};
const Rule string_capacity{"od-string-capacity", Severity::warning, "default value longer than CO_byteLength"};
const Rule link{"od-link", Severity::warning, "object link to an object that does not exist"};
const Rule module_list{"od-module-list", Severity::warning, "modules without object 1027h"};
const Rule module_object{"od-module-object", Severity::warning, "object of a module that the bus coupler has, too"};
const Rule module_number{"od-module-number", Severity::warning, "connected module that is not described"};
const Rule former{"od-former", Severity::note, "object that CiA 301 no longer defines"};
const Rule store_pair{"od-store-pair", Severity::note, "1010h and 1011h with different sub-indexes"};
const Rule granularity{"od-granularity", Severity::warning, "granularity above 64 bits"};
const Rule standard_kind{"od-standard-kind", Severity::note,
                         "communication object with another object type than in CiA 301"};
const Rule standard_type{"od-standard-type", Severity::warning,
                         "communication object with another data type than in CiA 301"};

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
  check_srdos(device, findings);
}

const std::vector<const Rule*>& all_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {
      &sub_number,    &sub_zero_missing, &sub_zero_value,  &sub_zero_small, &sub_zero_large, &limit_order,
      &limit,         &pdo_count,        &identity,        &node_id,        &bit_rate,       &type_complex,
      &unmappable,    &array_types,      &string_capacity, &link,           &module_list,    &module_object,
      &module_number, &former,           &store_pair,      &granularity,    &standard_kind,  &standard_type};
  return all;
}

}  // namespace lexican::codict::check
