// SPDX-License-Identifier: Apache-2.0
#include "check/network.hpp"

namespace lexican::codict::check {

namespace rules {

const Rule pdo_pair{"pdo-pair", Severity::error, "PDO without communication parameter or without mapping parameter"};
const Rule pdo_object{"pdo-object", Severity::error, "PDO maps an object that does not exist"};
const Rule pdo_access{"pdo-access", Severity::error, "PDO maps an object that its access or PDOMapping excludes"};
const Rule pdo_bits{"pdo-bits", Severity::error, "mapping longer than the mapped object"};
const Rule pdo_part{"pdo-part", Severity::note, "mapping shorter than the mapped object"};
const Rule pdo_length{"pdo-length", Severity::error, "PDO longer than 64 bits"};
const Rule pdo_gap{"pdo-gap", Severity::error, "mapping with unused sub-indexes"};
const Rule pdo_empty{"pdo-empty", Severity::warning, "valid COB-ID of a PDO that maps no object"};
const Rule pdo_mapped_count{"pdo-mapped-count", Severity::error, "invalid number of mapped objects"};
const Rule pdo_dummy{"pdo-dummy", Severity::error,
                     "dummy mapping in a TPDO, or of a type that the device does not support"};
const Rule pdo_granularity{"pdo-granularity", Severity::warning,
                           "mapping length that is not a multiple of the granularity"};
const Rule pdo_type{"pdo-type", Severity::error, "invalid transmission type"};
const Rule pdo_time{"pdo-time", Severity::note, "inhibit time or event timer without effect"};
const Rule pdo_sync{"pdo-sync-missing", Severity::warning, "synchronous PDO, but no object 1005h"};
const Rule multiplexed{"pdo-multiplexed", Severity::warning, "multiplexed PDO, but GroupMessaging=0"};
const Rule multiplexed_list{"pdo-multiplexed-list", Severity::warning,
                            "multiplexed PDO in source address mode without its list"};
const Rule multiplexed_type{"pdo-multiplexed-type", Severity::error,
                            "multiplexed PDO with a synchronous transmission type"};
const Rule cob_id_restricted{"cob-id-restricted", Severity::error, "COB-ID restricted by CiA 301"};
const Rule cob_id_twice{"cob-id-twice", Severity::warning, "COB-ID used by two services"};
const Rule cob_id_form{"cob-id-form", Severity::error, "COB-ID with more than 11 bits, but without bit 29"};
const Rule mandatory{"od-mandatory", Severity::error, "mandatory object is missing"};
const Rule error_control{"od-error-control", Severity::warning, "device without heartbeat and node guarding"};
const Rule sdo_default{"sdo-default", Severity::warning, "default SDO server with other COB-IDs"};
const Rule consumer_entry{"heartbeat-consumer", Severity::error, "malformed heartbeat consumer entry"};
const Rule consumer_twice{"heartbeat-consumer-twice", Severity::error, "two heartbeat consumer entries for one node"};
const Rule sync_window{"sync-window", Severity::warning, "SYNC window longer than the SYNC cycle"};
const Rule srdo_missing{"srdo-missing", Severity::error, "SRDO without a parameter, mapping, signature or 13FEh"};
const Rule srdo_parameter{"srdo-parameter", Severity::error, "invalid parameter of an SRDO"};
const Rule srdo_mapping{"srdo-mapping", Severity::error, "SRDO with an invalid number or length of mapped objects"};
const Rule srdo_object{"srdo-object", Severity::error,
                       "SRDO maps an object that is missing, not mappable or of another length"};
const Rule srdo_signature{"srdo-signature", Severity::error, "signature in 13FFh differs from that of the SRDO"};
const Rule srdo_signature_zero{"srdo-signature-zero", Severity::warning,
                               "SRDO without a signature, although 13FEh is A5h (valid)"};
const Rule srdo_pdo{"srdo-pdo", Severity::warning, "PDO maps an object that an SRDO maps, too"};

}  // namespace rules

const std::vector<const Rule*>& network_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {
      &pdo_pair,         &pdo_object,        &pdo_access,      &pdo_bits,
      &pdo_part,         &pdo_length,        &pdo_gap,         &pdo_empty,
      &pdo_mapped_count, &pdo_dummy,         &pdo_granularity, &pdo_type,
      &pdo_time,         &pdo_sync,          &multiplexed,     &multiplexed_list,
      &multiplexed_type, &cob_id_restricted, &cob_id_twice,    &cob_id_form,
      &mandatory,        &error_control,     &sdo_default,     &consumer_entry,
      &consumer_twice,   &sync_window,       &srdo_missing,    &srdo_parameter,
      &srdo_mapping,     &srdo_object,       &srdo_signature,  &srdo_signature_zero,
      &srdo_pdo};
  return all;
}

}  // namespace lexican::codict::check
