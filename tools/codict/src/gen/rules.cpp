// SPDX-License-Identifier: Apache-2.0
#include "gen/rules.hpp"

namespace lexican::codict::gen::rules {

const Rule type{"gen-type", Severity::warning, "entry without a known data type"};
const Rule access{"gen-access", Severity::error, "entry without an access type"};
const Rule value{"gen-value", Severity::error, "default value does not fit its data type"};
const Rule value_none{"gen-value-none", Severity::warning, "default value that is not octets, ignored"};
const Rule node_id{"gen-node-id", Severity::error, "$NODEID in an entry that cannot depend on the node-ID"};
const Rule no_subs{"gen-no-subs", Severity::warning, "ARRAY or RECORD without sub-objects"};
const Rule place{"gen-place", Severity::warning, "communication object with another data type than in CiA 301"};
const Rule name{"gen-name", Severity::error, "two entries or storage groups with one name in C"};
const Rule name_shared{"gen-name-shared", Severity::note, "entries with equal names"};
const Rule count{"gen-count", Severity::error, "dictionary without entries, or with more than 65534"};
const Rule store{"gen-store", Severity::error, "storage group without a sub-index of 1010h, or with several that fit"};
const Rule restore{"gen-restore", Severity::warning, "storage group that no sub-index of 1011h restores"};
const Rule store_joined{"gen-store-joined", Severity::warning,
                        "storage groups joined, as 1010h has one sub-index only"};
const Rule store_unused{"gen-store-unused", Severity::warning,
                        "sub-index of 1010h without a storage group, or storage groups without 1010h"};
const Rule pdo_bits{"gen-pdo-bits", Severity::error, "PDO longer than 64 bits"};
const Rule pdo_object{"gen-pdo-object", Severity::warning,
                      "PDO maps an object that does not exist, has the wrong access or another length"};
const Rule pdo_off{"gen-pdo-off", Severity::warning, "PDO switched off, as the stack does not create it"};
const Rule pdo_mappable{"gen-pdo-mappable", Severity::warning, "PDO maps an object with PDOMapping=0"};
const Rule pdo_direction{"gen-pdo-direction", Severity::warning, "PDO maps an object of the other direction"};
const Rule pdo_trigger{"gen-pdo-trigger", Severity::note, "event-driven TPDO without event timer and flag A"};
const Rule limits{"gen-limits", Severity::warning, "limits that cannot be checked at run time"};
const Rule limits_default{"gen-limits-default", Severity::warning, "default value outside LowLimit and HighLimit"};
const Rule sub_zero{"gen-sub-0", Severity::warning, "ARRAY or RECORD without sub-index 0"};
const Rule cob_id{"gen-cob-id", Severity::warning, "missing or wrong COB-ID, corrected"};
const Rule srdo_signature{"gen-srdo-signature", Severity::note, "signature of an SRDO, filled in"};
const Rule left_out{"gen-left-out", Severity::note, "disabled object or type definition without an entry"};
const Rule external{"gen-external", Severity::note, "entry with memory or type of the application"};
const Rule capacity{"gen-capacity", Severity::note, "string without a maximum length"};

}  // namespace lexican::codict::gen::rules

namespace lexican::codict::gen {

const std::vector<const Rule*>& all_rules() {
  static const std::vector<const Rule*> all = {
      &rules::type,           &rules::access,         &rules::value,        &rules::value_none,    &rules::node_id,
      &rules::no_subs,        &rules::place,          &rules::name,         &rules::name_shared,   &rules::count,
      &rules::store,          &rules::restore,        &rules::store_joined, &rules::store_unused,  &rules::pdo_bits,
      &rules::pdo_object,     &rules::pdo_off,        &rules::pdo_mappable, &rules::pdo_direction, &rules::limits,
      &rules::limits_default, &rules::sub_zero,       &rules::cob_id,       &rules::left_out,      &rules::external,
      &rules::capacity,       &rules::srdo_signature, &rules::pdo_trigger};
  return all;
}

}  // namespace lexican::codict::gen
