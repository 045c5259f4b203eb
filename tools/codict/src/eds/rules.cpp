// SPDX-License-Identifier: Apache-2.0
#include "eds/rules.hpp"

namespace lexican::codict::eds {

namespace rules {

const Rule syntax_section{"eds-syntax-section", Severity::error, "section header without closing bracket or name"};
const Rule syntax_section_tail{"eds-syntax-section-tail", Severity::warning,
                               "text after the closing bracket of a section header"};
const Rule syntax_indent{"eds-syntax-indent", Severity::note, "leading blanks in front of a section, key or comment"};
const Rule syntax_comment{"eds-syntax-comment", Severity::warning, "comment that does not begin with a semicolon"};
const Rule syntax_line{"eds-syntax-line", Severity::error,
                       "line that is neither a section, a key with a value, a comment nor empty"};
const Rule syntax_outside{"eds-syntax-outside", Severity::error, "key before the first section"};
const Rule syntax_length{"eds-syntax-length", Severity::note, "line longer than 255 characters"};
const Rule syntax_line_end{"eds-syntax-line-end", Severity::note, "mixed line ends (LF and CR LF)"};
const Rule syntax_control{"eds-syntax-control", Severity::warning, "control character in the text"};
const Rule syntax_key{"eds-syntax-key", Severity::warning, "blank in the name of a key"};
const Rule duplicate_section{"eds-duplicate-section", Severity::error, "section defined more than once"};
const Rule duplicate_key{"eds-duplicate-key", Severity::error, "key defined more than once in its section"};
const Rule encoding_utf8{"eds-encoding-utf8", Severity::note, "characters outside ASCII, read as UTF-8"};
const Rule encoding_guess{"eds-encoding-guess", Severity::warning, "characters in an unknown code page"};
const Rule encoding_mark{"eds-encoding-mark", Severity::note, "byte order mark at the beginning of the file"};
const Rule section_unknown{"eds-section-unknown", Severity::note, "section unknown to CiA 306"};
const Rule section_form{"eds-section-form", Severity::note, "section name with unusual capitals"};
const Rule section_mark{"eds-section-mark", Severity::warning, "section name with 0x or h"};
const Rule section_zeros{"eds-section-zeros", Severity::warning, "section name with missing or extra leading zeros"};
const Rule section_missing{"eds-section-missing", Severity::warning,
                           "mandatory section FileInfo, DeviceInfo or MandatoryObjects is missing"};
const Rule section_orphan{"eds-section-orphan", Severity::error,
                          "sub-object or list without the section of its object"};
const Rule sub_index{"eds-sub-index", Severity::error, "sub-index beyond FFh in a section name"};
const Rule key_unknown{"eds-key-unknown", Severity::note, "key unknown to CiA 306"};
const Rule key_missing{"eds-key-missing", Severity::error, "mandatory key is missing or empty"};
const Rule key_misplaced{"eds-key-misplaced", Severity::warning, "key in a section where it has no effect"};
const Rule key_length{"eds-key-length", Severity::note, "text longer than CiA 306 allows"};
const Rule dialect{"eds-dialect", Severity::note, "key of a tool that CiA 306 does not define"};
const Rule hidden_key{"eds-hidden-key", Severity::note, "key of a tool inside a comment"};
const Rule object_type{"eds-object-type", Severity::error,
                       "unknown ObjectType, or one that contradicts the sub-objects"};
const Rule object_type_missing{"eds-object-type-missing", Severity::note, "ObjectType is missing"};
const Rule access_unknown{"eds-access-unknown", Severity::error, "unknown AccessType"};
const Rule access_case{"eds-access-case", Severity::note, "AccessType in capital letters"};
const Rule type_own{"eds-type-own", Severity::note, "data type defined by an object of the device"};
const Rule type_unknown{"eds-type-unknown", Severity::warning, "unknown data type"};
const Rule file_name{"eds-file-name", Severity::note, "FileName differs from the name of the file"};
const Rule file_date{"eds-file-date", Severity::note, "malformed date"};
const Rule file_time{"eds-file-time", Severity::note, "malformed time"};
const Rule file_version{"eds-file-version", Severity::note, "unknown EDSVersion"};
const Rule commissioning_spelling{"eds-commissioning-spelling", Severity::warning,
                                  "section spelled DeviceCommissioning"};
const Rule list_count{"eds-list-count", Severity::warning, "number of entries differs from the count of the list"};
const Rule list_numbers{"eds-list-numbers", Severity::warning, "gap in the numbers of a list"};
const Rule list_entry{"eds-list-entry", Severity::error, "list entry without a value"};
const Rule list_unlisted{"eds-list-unlisted", Severity::warning, "object missing in the object lists"};
const Rule list_no_section{"eds-list-no-section", Severity::error, "listed object without a section"};
const Rule list_twice{"eds-list-twice", Severity::warning, "object listed more than once"};
const Rule list_wrong{"eds-list-wrong", Severity::warning, "object in the wrong object list"};
const Rule compact_entry{"eds-compact-entry", Severity::warning,
                         "name or value for a sub-index without compact storage"};
const Rule compact_limit{"eds-compact-limit", Severity::error, "more than 50000 sub-objects of compact storage"};
const Rule compact_pdo{"eds-compact-pdo", Severity::note, "PDOs without sections, implied by CompactPDO"};

}  // namespace rules

const std::vector<const Rule*>& all_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {&syntax_section,  &syntax_section_tail, &syntax_indent,
                                               &syntax_comment,  &syntax_line,         &syntax_outside,
                                               &syntax_length,   &syntax_line_end,     &syntax_control,
                                               &syntax_key,      &duplicate_section,   &duplicate_key,
                                               &encoding_utf8,   &encoding_guess,      &encoding_mark,
                                               &section_unknown, &section_form,        &section_zeros,
                                               &section_mark,    &section_missing,     &section_orphan,
                                               &sub_index,       &key_unknown,         &key_missing,
                                               &key_misplaced,   &key_length,          &dialect,
                                               &hidden_key,      &object_type,         &object_type_missing,
                                               &access_unknown,  &access_case,         &type_own,
                                               &type_unknown,    &file_name,           &file_date,
                                               &file_time,       &file_version,        &commissioning_spelling,
                                               &list_count,      &list_numbers,        &list_entry,
                                               &list_unlisted,   &list_no_section,     &list_twice,
                                               &list_wrong,      &compact_entry,       &compact_limit,
                                               &compact_pdo};
  return all;
}

}  // namespace lexican::codict::eds
