// SPDX-License-Identifier: Apache-2.0
#include "xdd/rules.hpp"

namespace lexican::codict::xdd {

namespace rules {

const Rule syntax{"xdd-syntax", Severity::error, "text is not well-formed XML"};
const Rule doctype{"xdd-doctype", Severity::warning, "document type declaration"};
const Rule encoding{"xdd-encoding", Severity::warning, "bytes contradict the encoding of the XML declaration"};
const Rule xml_namespace{"xdd-namespace", Severity::warning, "missing or unknown XML namespace"};
const Rule dialect{"xdd-dialect", Severity::note, "private XML dialect"};
const Rule unknown{"xdd-unknown", Severity::note, "element or attribute unknown to CiA 311"};
const Rule name_case{"xdd-name-case", Severity::warning, "element or attribute with wrong capitals"};
const Rule duplicate{"xdd-duplicate", Severity::error, "element or attribute given more than once"};
const Rule order{"xdd-order", Severity::note, "elements in another order than in the schema"};
const Rule duplicate_id{"xdd-duplicate-id", Severity::error, "uniqueID used more than once"};
const Rule reference{"xdd-reference", Severity::error, "reference to an id that does not exist"};
const Rule copies{"xdd-copies", Severity::error, "too many references to a large template"};
const Rule parameter_differs{"xdd-parameter-differs", Severity::warning, "object contradicts its parameter"};
const Rule parameter_unused{"xdd-parameter-unused", Severity::note, "parameter without an object"};
const Rule index{"xdd-index", Severity::error, "malformed index or subIndex"};
const Rule hex_digits{"xdd-hex-digits", Severity::note, "hexadecimal attribute with a wrong number of digits"};
const Rule duplicate_object{"xdd-duplicate-object", Severity::error, "object or sub-object defined more than once"};
const Rule object_type{"xdd-object-type", Severity::error,
                       "unknown objectType, or one that contradicts the sub-objects"};
const Rule object_type_missing{"xdd-object-type-missing", Severity::note, "objectType is missing"};
const Rule type_missing{"xdd-type-missing", Severity::warning, "value without a data type"};
const Rule type_unknown{"xdd-type-unknown", Severity::error, "unknown data type"};
const Rule access_unknown{"xdd-access-unknown", Severity::error, "unknown access"};
const Rule access_missing{"xdd-access-missing", Severity::warning, "value without an access"};
const Rule access_case{"xdd-access-case", Severity::note, "access with wrong capitals"};
const Rule pdo_mapping{"xdd-pdo-mapping", Severity::warning, "unknown PDOmapping"};
const Rule property{"xdd-property", Severity::warning, "unknown property of CANopenNode, or unknown value"};
const Rule list_count{"xdd-list-count", Severity::warning, "number of objects or sub-objects differs from its count"};
const Rule boolean{"xdd-boolean", Severity::note, "malformed boolean"};
const Rule bit_rate{"xdd-bit-rate", Severity::warning, "malformed bit rate"};
const Rule dummy{"xdd-dummy", Severity::warning, "malformed dummy entry"};
const Rule file_name{"xdd-file-name", Severity::note, "fileName differs from the name of the file"};

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
