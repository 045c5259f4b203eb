// SPDX-License-Identifier: Apache-2.0
#include "xdd/rules.hpp"

namespace lexican::codict::xdd {

namespace rules {

const Rule syntax{"xdd-syntax", Severity::error, "The text is well-formed XML: what stands before the fault is read."};
const Rule doctype{"xdd-doctype", Severity::warning,
                   "There is no document type: its entities are not used, and nothing outside the file is read."};
const Rule encoding{"xdd-encoding", Severity::warning,
                    "The encoding is the one that the XML declaration says, UTF-8 without one."};
const Rule xml_namespace{"xdd-namespace", Severity::warning,
                         "The namespace is that of CiA 311, 1.0 or 1.1: names are read without it."};
const Rule dialect{"xdd-dialect", Severity::note,
                   "A private form of the description is read as the one who made it up means it."};
const Rule unknown{"xdd-unknown", Severity::note, "What CiA 311 does not know is kept, and not used."};
const Rule name_case{"xdd-name-case", Severity::warning,
                     "Names are written with the capitals that CiA 311 gives them: readers of others miss them else."};
const Rule duplicate{"xdd-duplicate", Severity::error, "What can be said once is said once: the first is used."};
const Rule order{"xdd-order", Severity::note, "The elements of a parameter have the order that the schema gives them."};
const Rule duplicate_id{"xdd-duplicate-id", Severity::error, "A uniqueID is there once: the first is used."};
const Rule reference{"xdd-reference", Severity::error, "What is referred to is there."};
const Rule copies{"xdd-copies", Severity::error, "What is referred to many times is small: else it is not read again."};
const Rule parameter_differs{"xdd-parameter-differs", Severity::warning,
                             "An object says nothing else than its parameter: the parameter is used."};
const Rule parameter_unused{"xdd-parameter-unused", Severity::note, "Each parameter describes an object."};
const Rule index{"xdd-index", Severity::error, "index and subIndex are hexadecimal numbers of four and two digits."};
const Rule hex_digits{"xdd-hex-digits", Severity::note,
                      "Hexadecimal attributes have two digits for each byte, and no 0x."};
const Rule duplicate_object{"xdd-duplicate-object", Severity::error,
                            "An object or sub-object is there once: the first is used."};
const Rule object_type{"xdd-object-type", Severity::error,
                       "objectType is 2, 5, 6, 7, 8 or 9, and only 6, 8 and 9 have sub-objects."};
const Rule object_type_missing{"xdd-object-type-missing", Severity::note,
                               "Each object has an objectType: without one, it follows from its sub-objects."};
const Rule type_missing{"xdd-type-missing", Severity::warning, "Each value has a data type."};
const Rule type_unknown{"xdd-type-unknown", Severity::error, "A data type is one of CiA 301, or of the device's own."};
const Rule access_unknown{"xdd-access-unknown", Severity::error,
                          "accessType is ro, wo, rw or const; access is a word of CiA 311."};
const Rule access_missing{"xdd-access-missing", Severity::warning, "Each value has an access."};
const Rule access_case{"xdd-access-case", Severity::note, "Words of access have the capitals that CiA 311 gives them."};
const Rule pdo_mapping{"xdd-pdo-mapping", Severity::warning, "PDOmapping is no, optional, default, TPDO or RPDO."};
const Rule property{"xdd-property", Severity::warning,
                    "A property of CANopenNode has a name and a value that it knows."};
const Rule list_count{"xdd-list-count", Severity::warning, "Counts of objects are right."};
const Rule boolean{"xdd-boolean", Severity::note, "Booleans are true or false, or 1 or 0."};
const Rule bit_rate{"xdd-bit-rate", Severity::warning, "Bit rates are \"125 Kbps\", or \"auto-baudRate\"."};
const Rule dummy{"xdd-dummy", Severity::warning, "A dummy is \"Dummy0001=0\": a type, and 0 or 1."};
const Rule file_name{"xdd-file-name", Severity::note, "fileName is the name of the file."};

}  // namespace rules

const std::vector<const Rule*>& all_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {&syntax,
                                               &doctype,
                                               &encoding,
                                               &xml_namespace,
                                               &dialect,
                                               &unknown,
                                               &name_case,
                                               &duplicate,
                                               &order,
                                               &duplicate_id,
                                               &reference,
                                               &copies,
                                               &parameter_differs,
                                               &parameter_unused,
                                               &index,
                                               &hex_digits,
                                               &duplicate_object,
                                               &object_type,
                                               &object_type_missing,
                                               &type_missing,
                                               &type_unknown,
                                               &access_unknown,
                                               &access_missing,
                                               &access_case,
                                               &pdo_mapping,
                                               &property,
                                               &list_count,
                                               &boolean,
                                               &bit_rate,
                                               &dummy,
                                               &file_name};
  return all;
}

}  // namespace lexican::codict::xdd
