// SPDX-License-Identifier: Apache-2.0
#include "check/network.hpp"

namespace lexican::codict::check {

namespace rules {

const Rule pdo_pair{"pdo-pair", Severity::error, "A PDO has communication parameters and a mapping."};
const Rule pdo_object{"pdo-object", Severity::error, "What a PDO maps is described."};
const Rule pdo_access{"pdo-access", Severity::error, "What a PDO maps can be mapped in its direction."};
const Rule pdo_bits{"pdo-bits", Severity::error, "A PDO maps no more bits of an object than it has."};
const Rule pdo_part{"pdo-part", Severity::note, "A PDO maps all bits of an object."};
const Rule pdo_length{"pdo-length", Severity::error, "A PDO has 64 bits at most."};
const Rule pdo_gap{"pdo-gap", Severity::error, "A mapping has no gaps up to the number in its sub-index 0."};
const Rule pdo_mapped_count{"pdo-mapped-count", Severity::error, "Sub-index 0 of a mapping is 0 to 64, FEh or FFh."};
const Rule pdo_dummy{"pdo-dummy", Severity::error,
                     "Dummies stand in RPDOs only, and are of types that the device takes for them."};
const Rule pdo_granularity{"pdo-granularity", Severity::warning,
                           "Lengths in a mapping are multiples of the device's granularity."};
const Rule pdo_type{"pdo-type", Severity::error,
                    "A transmission type is 0 to 240, 254 or 255, and of TPDOs also 252 or 253."};
const Rule pdo_time{"pdo-time", Severity::note,
                    "Inhibit time and event time have an effect where PDOs are sent by events only."};
const Rule pdo_sync{"pdo-sync-missing", Severity::warning, "A device that has PDOs with SYNC has object 1005h."};
const Rule multiplexed{"pdo-multiplexed", Severity::warning,
                       "A device that has multiplexed PDOs says so, with GroupMessaging."};
const Rule multiplexed_list{
    "pdo-multiplexed-list", Severity::warning,
    "Source address mode has a list: 1FA0h to 1FCFh of a sender, 1FD0h to 1FFFh of a receiver."};
const Rule multiplexed_type{"pdo-multiplexed-type", Severity::error,
                            "A multiplexed PDO has transmission type 254 or 255."};
const Rule cob_id_restricted{"cob-id-restricted", Severity::error,
                             "No service has an identifier that CiA 301 keeps for another one."};
const Rule cob_id_twice{"cob-id-twice", Severity::warning, "An identifier has one service."};
const Rule cob_id_form{"cob-id-form", Severity::error,
                       "An identifier has 11 bits, or 29 with the flag that says so; bits with no meaning are 0."};
const Rule mandatory{"od-mandatory", Severity::error, "Objects 1000h, 1001h and 1018h are there."};
const Rule error_control{"od-error-control", Severity::warning,
                         "A device has a heartbeat (1017h) or node guarding (100Ch and 100Dh)."};
const Rule sdo_default{"sdo-default", Severity::warning,
                       "The first SDO server has the identifiers 600h and 580h with the node-ID added."};
const Rule consumer_entry{"heartbeat-consumer", Severity::error,
                          "An entry of 1016h has a node-ID of 1 to 127 and 0 in its upper byte, or is 0."};
const Rule consumer_twice{"heartbeat-consumer-twice", Severity::error, "A node's heartbeat has one consumer time."};
const Rule sync_window{"sync-window", Severity::warning, "The window of SYNC (1007h) is not longer than its cycle."};

}  // namespace rules

const std::vector<const Rule*>& network_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {
      &pdo_pair,         &pdo_object,        &pdo_access,       &pdo_bits,       &pdo_part,
      &pdo_length,       &pdo_gap,           &pdo_mapped_count, &pdo_dummy,      &pdo_granularity,
      &pdo_type,         &pdo_time,          &pdo_sync,         &multiplexed,    &multiplexed_list,
      &multiplexed_type, &cob_id_restricted, &cob_id_twice,     &cob_id_form,    &mandatory,
      &error_control,    &sdo_default,       &consumer_entry,   &consumer_twice, &sync_window};
  return all;
}

}  // namespace lexican::codict::check
