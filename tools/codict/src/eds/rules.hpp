// SPDX-License-Identifier: Apache-2.0
/// \file rules.hpp
/// Rules that the reader of EDS and DCF reports.
#pragma once

#include <vector>

#include "text/finding.hpp"

namespace lexican::codict::eds {

namespace rules {
// Lines.
extern const Rule syntax_section;
extern const Rule syntax_section_tail;
extern const Rule syntax_indent;
extern const Rule syntax_comment;
extern const Rule syntax_line;
extern const Rule syntax_outside;
extern const Rule syntax_length;
extern const Rule syntax_line_end;
extern const Rule syntax_control;
extern const Rule syntax_key;
extern const Rule duplicate_section;
extern const Rule duplicate_key;
extern const Rule encoding_utf8;
extern const Rule encoding_guess;
extern const Rule encoding_mark;
// Sections and keys.
extern const Rule section_unknown;
extern const Rule section_form;
extern const Rule section_zeros;
extern const Rule section_mark;
extern const Rule section_missing;
extern const Rule section_orphan;
extern const Rule sub_index;
extern const Rule key_unknown;
extern const Rule key_missing;
extern const Rule key_misplaced;
extern const Rule key_length;
extern const Rule dialect;
extern const Rule hidden_key;
// Values with a notation of their own.
extern const Rule object_type;
extern const Rule object_type_missing;
extern const Rule access_unknown;
extern const Rule access_case;
extern const Rule type_own;
extern const Rule type_unknown;
extern const Rule file_name;
extern const Rule file_date;
extern const Rule file_time;
extern const Rule file_version;
extern const Rule commissioning_spelling;
// Lists.
extern const Rule list_count;
extern const Rule list_numbers;
extern const Rule list_entry;
extern const Rule list_unlisted;
extern const Rule list_no_section;
extern const Rule list_twice;
extern const Rule list_wrong;
// Compact storage of sub-objects and PDOs.
extern const Rule compact_entry;
extern const Rule compact_limit;
extern const Rule compact_pdo;
}  // namespace rules

/// Returns the rules of this file.
const std::vector<const Rule*>& all_rules();

}  // namespace lexican::codict::eds
