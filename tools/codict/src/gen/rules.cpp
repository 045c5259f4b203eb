// SPDX-License-Identifier: Apache-2.0
#include "gen/rules.hpp"

namespace lexican::codict::gen::rules {

const Rule type{"gen-type", Severity::warning,
                "An entry has a data type whose length is known: else its type is the application's."};
const Rule access{"gen-access", Severity::error, "It is said who may read and write an entry."};
const Rule value{"gen-value", Severity::error, "A default value is one of its data type."};
const Rule value_none{"gen-value-none", Severity::warning,
                      "Where octets are asked for, a 0, or a text in a DOMAIN, stands for no value."};
const Rule node_id{"gen-node-id", Severity::error, "Only integers depend on the node-ID."};
const Rule no_subs{"gen-no-subs", Severity::warning, "An ARRAY or RECORD without sub-objects gets no entry."};
const Rule place{"gen-place", Severity::warning,
                 "An object of the communication profile has the type of CiA 301, whatever a description says."};
const Rule name{"gen-name", Severity::error, "A name of the generated source names one thing (--unique-names)."};
const Rule name_shared{"gen-name-shared", Severity::note,
                       "Entries with one name get their index and sub-index behind it."};
const Rule count{"gen-count", Severity::error, "A dictionary has entries, and at most 65535."};
const Rule store{"gen-store", Severity::error, "1010h has a sub-index for each storage group."};
const Rule store_joined{"gen-store-joined", Severity::warning,
                        "Where 1010h has one sub-index, all storage groups are one."};
const Rule store_unused{"gen-store-unused", Severity::warning, "What 1010h can store has a storage group."};
const Rule pdo_bits{"gen-pdo-bits", Severity::error, "A PDO has at most 64 bits."};
const Rule pdo_object{
    "gen-pdo-object", Severity::warning,
    "A PDO maps objects that exist, may be read or written and have the mapped length; else it will not exist."};
const Rule pdo_mappable{"gen-pdo-mappable", Severity::warning, "A PDO maps objects with PDOMapping=1."};
const Rule pdo_direction{"gen-pdo-direction", Severity::warning,
                         "rwr and TPDO go out, rww and RPDO come in: a mapping in the other direction is a mistake."};
const Rule limits{"gen-limits", Severity::warning, "Limits that cannot be kept are left out."};
const Rule limits_default{"gen-limits-default", Severity::warning, "A default value lies within its limits."};
const Rule sub_zero{"gen-sub-0", Severity::warning, "An ARRAY or RECORD without sub-index 0 gets one."};
const Rule cob_id{"gen-cob-id", Severity::warning, "COB-IDs with which a node cannot work are put right."};
const Rule left_out{"gen-left-out", Severity::note, "Disabled objects and type definitions have no entry."};
const Rule external{"gen-external", Severity::note,
                    "What has no value has its memory, or its type, in the application."};
const Rule capacity{"gen-capacity", Severity::note,
                    "A string that can be written and says nothing of its length has --string-capacity bytes."};

}  // namespace lexican::codict::gen::rules

namespace lexican::codict::gen {

const std::vector<const Rule*>& all_rules() {
  static const std::vector<const Rule*> all = {
      &rules::type,         &rules::access,        &rules::value,        &rules::value_none,     &rules::node_id,
      &rules::no_subs,      &rules::place,         &rules::name,         &rules::name_shared,    &rules::count,
      &rules::store,        &rules::store_joined,  &rules::store_unused, &rules::pdo_bits,       &rules::pdo_object,
      &rules::pdo_mappable, &rules::pdo_direction, &rules::limits,       &rules::limits_default, &rules::sub_zero,
      &rules::cob_id,       &rules::left_out,      &rules::external,     &rules::capacity};
  return all;
}

}  // namespace lexican::codict::gen
