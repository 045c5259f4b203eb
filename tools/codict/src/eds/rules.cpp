// SPDX-License-Identifier: Apache-2.0
#include "eds/rules.hpp"

namespace lexican::codict::eds {

namespace rules {

const Rule syntax_section{"eds-syntax-section", Severity::error, "A section is [name] on a line of its own."};
const Rule syntax_section_tail{"eds-syntax-section-tail", Severity::warning,
                               "Nothing follows the bracket that closes a section's name."};
const Rule syntax_indent{"eds-syntax-indent", Severity::note, "Sections, keys and comments begin in the first column."};
const Rule syntax_comment{"eds-syntax-comment", Severity::warning,
                          "A comment begins with a semicolon in the first column."};
const Rule syntax_line{"eds-syntax-line", Severity::error,
                       "A line is a section, a key with a value, a comment, or empty."};
const Rule syntax_outside{"eds-syntax-outside", Severity::error, "Each key belongs to a section."};
const Rule syntax_length{"eds-syntax-length", Severity::note, "A line has at most 255 characters."};
const Rule syntax_line_end{"eds-syntax-line-end", Severity::note, "All lines end in the same way, with LF or CR LF."};
const Rule syntax_control{"eds-syntax-control", Severity::warning, "There are no control characters in a text."};
const Rule syntax_key{"eds-syntax-key", Severity::warning, "A key has letters and digits, and no blanks."};
const Rule duplicate_section{"eds-duplicate-section", Severity::error,
                             "A section is there once: the first one is used."};
const Rule duplicate_key{"eds-duplicate-key", Severity::error,
                         "A key is there once in its section: the first one is used."};
const Rule encoding_utf8{"eds-encoding-utf8", Severity::note,
                         "The characters are those of ASCII: others are read as UTF-8."};
const Rule encoding_guess{"eds-encoding-guess", Severity::warning,
                          "The characters are those of ASCII: what others mean is a guess."};
const Rule encoding_mark{"eds-encoding-mark", Severity::note, "There is no byte order mark."};
const Rule section_unknown{"eds-section-unknown", Severity::note,
                           "A section that CiA 306 does not know is kept, and not used."};
const Rule section_form{"eds-section-form", Severity::note,
                        "Objects are [1A00] and [1A00sub1]: capital digits, and sub in small letters."};
const Rule section_zeros{"eds-section-zeros", Severity::warning,
                         "An index has four digits, a sub-index no leading zeros."};
const Rule section_missing{"eds-section-missing", Severity::warning,
                           "FileInfo, DeviceInfo and MandatoryObjects are in every file."};
const Rule section_orphan{"eds-section-orphan", Severity::error,
                          "A section of a part is there with that of the whole: of a sub-object with its object."};
const Rule key_unknown{"eds-key-unknown", Severity::note, "A key that CiA 306 does not know is kept, and not used."};
const Rule key_missing{"eds-key-missing", Severity::error,
                       "A key that the standard demands is there, and has a value."};
const Rule key_misplaced{"eds-key-misplaced", Severity::warning,
                         "A key stands only where it means something; elsewhere it is kept, and not used."};
const Rule key_length{"eds-key-length", Severity::note, "Texts are not longer than CiA 306 allows."};
const Rule dialect{"eds-dialect", Severity::note,
                   "What a tool has added to the standard is read as that tool means it."};
const Rule hidden_key{"eds-hidden-key", Severity::note, "A key hidden in a comment is read as its tool means it."};
const Rule object_type{"eds-object-type", Severity::error,
                       "ObjectType is one of DOMAIN 2, DEFTYPE 5, DEFSTRUCT 6, VAR 7, ARRAY 8, RECORD 9."};
const Rule object_type_missing{"eds-object-type-missing", Severity::note,
                               "Without ObjectType, an object is a VAR, or with sub-objects a RECORD."};
const Rule access_unknown{"eds-access-unknown", Severity::error, "AccessType is one of ro, wo, rw, rwr, rww, const."};
const Rule access_case{"eds-access-case", Severity::note, "AccessType is written in small letters."};
const Rule type_own{"eds-type-own", Severity::note, "A data type of the device's own is looked up in its object."};
const Rule type_unknown{"eds-type-unknown", Severity::warning,
                        "A data type is one of CiA 301, or an object of the device."};
const Rule file_name{"eds-file-name", Severity::note, "FileName is the name of the file."};
const Rule file_date{"eds-file-date", Severity::note, "A date is month-day-year, 12-31-2020."};
const Rule file_time{"eds-file-time", Severity::note, "A time is hours and minutes with AM or PM, 09:30AM."};
const Rule file_version{"eds-file-version", Severity::note, "EDSVersion is a version of CiA 306: 4.0."};
const Rule commissioning_spelling{"eds-commissioning-spelling", Severity::warning,
                                  "The section is spelled DeviceComissioning, with one m."};
const Rule list_count{"eds-list-count", Severity::warning,
                      "The number of entries of a list is the number that it gives."};
const Rule list_numbers{"eds-list-numbers", Severity::warning,
                        "The entries of a list are numbered from 1 without gaps."};
const Rule list_entry{"eds-list-entry", Severity::error, "An entry of an object list is the index of an object."};
const Rule list_unlisted{"eds-list-unlisted", Severity::warning,
                         "Each object is in a list: one that is not is read, too."};
const Rule list_no_section{"eds-list-no-section", Severity::error, "Each object of a list has a section."};
const Rule list_twice{"eds-list-twice", Severity::warning, "An object is in a list once."};
const Rule list_wrong{"eds-list-wrong", Severity::warning,
                      "1000h, 1001h and 1018h are mandatory, 2000h to 5FFFh the manufacturer's, all others optional."};
const Rule compact_entry{"eds-compact-entry", Severity::warning,
                         "A name or value of compact storage belongs to a sub-object that is there."};
const Rule compact_limit{"eds-compact-limit", Severity::error, "Compact storage stands for 50000 sub-objects at most."};

}  // namespace rules

const std::vector<const Rule*>& all_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {&syntax_section,
                                               &syntax_section_tail,
                                               &syntax_indent,
                                               &syntax_comment,
                                               &syntax_line,
                                               &syntax_outside,
                                               &syntax_length,
                                               &syntax_line_end,
                                               &syntax_control,
                                               &syntax_key,
                                               &duplicate_section,
                                               &duplicate_key,
                                               &encoding_utf8,
                                               &encoding_guess,
                                               &encoding_mark,
                                               &section_unknown,
                                               &section_form,
                                               &section_zeros,
                                               &section_missing,
                                               &section_orphan,
                                               &key_unknown,
                                               &key_missing,
                                               &key_misplaced,
                                               &key_length,
                                               &dialect,
                                               &hidden_key,
                                               &object_type,
                                               &object_type_missing,
                                               &access_unknown,
                                               &access_case,
                                               &type_own,
                                               &type_unknown,
                                               &file_name,
                                               &file_date,
                                               &file_time,
                                               &file_version,
                                               &commissioning_spelling,
                                               &list_count,
                                               &list_numbers,
                                               &list_entry,
                                               &list_unlisted,
                                               &list_no_section,
                                               &list_twice,
                                               &list_wrong,
                                               &compact_entry,
                                               &compact_limit};
  return all;
}

}  // namespace lexican::codict::eds
