// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/field.hpp"
#include "cli/output.hpp"
#include "cli/review.hpp"
#include "convert/merge.hpp"
#include "text/edit.hpp"
#include "text/number.hpp"
#include "xdd/set_type.hpp"

namespace lexican::codict::cli {

namespace {

struct SetOptions {
  std::string file;
  std::vector<std::string> words;  // of changes: TARGET FIELD=VALUE… TARGET FIELD=VALUE…
  std::string output;
  bool is_forced = false;
  bool is_json = false;
};

struct Change {
  std::string target;
  std::vector<std::string> assignments;
};

// Reason why nothing is changed, and the exit status for it.
struct Refusal {
  std::string why;
  Status status = unusable;
};

// Returns the text of a flag in the words of the format: 1 and 0 in an EDS, true and false in XML.
std::string_view flag_text(const Assignment& assignment, bool is_xml) {
  const std::string_view property = property_of(assignment.field);
  const std::string_view text = assignment.text;
  const bool is_flag = property == "CO_flagsPDO" || property == "CO_extensionIO" || property == "CO_disabled";
  if (is_flag && (text == "1" || equal_ignoring_case(text, "true"))) {
    return is_xml ? "true" : "1";
  }
  if (is_flag && (text == "0" || equal_ignoring_case(text, "false"))) {
    return is_xml ? "false" : "0";
  }
  return text;
}

// Adds the edits that set a key of an EDS section. On failure, refusal may have a more precise reason than the
// caller's.
bool assign(const eds::Document& document, const eds::Section& section, const Assignment& assignment, Edits& edits,
            Refusal& refusal) {
  const std::string_view name = key_of(assignment.field);
  if (name.empty()) {
    refusal.why = fmt::format("an EDS or DCF cannot express {}: convert it to XDD", assignment.field);
    return false;
  }
  const std::optional<eds::Key> key = find_key(document, section, name);
  const std::string_view text = flag_text(assignment, false);
  return key ? document.set_value(*key, text, edits) : add_key(document, section, name, text, edits);
}

// Returns the XML attribute of a field, empty if it has none. [311: CANopenObject]
std::string_view attribute_of(std::string_view field) {
  struct Pair {
    std::string_view field;
    std::string_view attribute;
  };
  constexpr std::array<Pair, 8> pairs = {{{"type", "dataType"},
                                          {"access", "accessType"},
                                          {"default", "defaultValue"},
                                          {"value", "actualValue"},
                                          {"low", "lowLimit"},
                                          {"high", "highLimit"},
                                          {"pdo", "PDOmapping"},
                                          {"flags", "objFlags"}}};
  const auto* const pair =
      std::find_if(pairs.begin(), pairs.end(), [field](const Pair& p) { return p.field == field; });
  return pair != pairs.end() ? pair->attribute : field == "denotation" ? field : std::string_view();
}

// Adds the edits that set a field of an XDD object. On failure, refusal may have a more precise reason than the
// caller's.
bool assign(const xdd::Document& document, const Entry& entry, const Assignment& assignment, Edits& edits,
            Refusal& refusal) {
  const Text* const text = find_text(entry, assignment.field);
  if (equal_ignoring_case(key_of(assignment.field), "DataType") && xdd::has_parameter_type(entry)) {
    refusal.status = found;
    return xdd::set_type(document, entry, assignment.text, edits, refusal.why);
  }
  if (text != nullptr && text->is_given) {
    return document.set_text(text->span, flag_text(assignment, true), edits);
  }
  if (const std::string_view property = property_of(assignment.field); !property.empty()) {
    if (entry.parameter_extent.is_empty()) {
      refusal.why =
          fmt::format("no parameter (uniqueIDRef) for {}; set it at a sub-object, or add a parameter", property);
      return false;
    }
    return document.add_element(entry.parameter_extent, "property",
                                {{"name", property}, {"value", flag_text(assignment, true)}}, edits);
  }
  const std::string_view attribute = attribute_of(assignment.field);
  return !attribute.empty() && document.add_attribute(entry.span.begin, attribute, assignment.text, edits);
}

// Sets a field in a list of compact storage. On failure, why is the reason.
bool assign_to_list(const Input& input, const Reference& reference, const Assignment& assignment, std::string& bytes,
                    std::string& why) {
  std::string lines;
  if (!add_to_lists(reference, assignment, lines, why)) {
    return false;
  }
  Findings findings;
  std::vector<convert::ReplacedValue> replaced;
  if (!convert::merge(*input.eds, eds::Document(Source("set", lines), findings), bytes, replaced)) {
    why = "the file cannot hold these texts";
    return false;
  }
  return true;
}

// Applies an assignment; bytes are those of the changed file. On failure, refusal has the reason.
bool assign_to(const Input& input, const std::string& target, const std::string& text, std::string& bytes,
               Refusal& refusal) {
  Assignment assignment;
  if (!parse_assignment(text, assignment, refusal.why)) {
    return false;
  }
  if (input.json != nullptr) {
    refusal.why = "values of JSON are changed by programs for JSON";
    return false;
  }
  Reference reference;
  if (input.eds != nullptr && parse_reference(target, reference) && is_implied(input, reference)) {
    return assign_to_list(input, reference, assignment, bytes, refusal.why);
  }
  const eds::Section* const section = input.eds != nullptr ? find_section(input, target, refusal.why) : nullptr;
  const Entry* const entry = input.xdd != nullptr ? find_entry(input, target, refusal.why) : nullptr;
  if (section == nullptr && entry == nullptr) {
    return false;
  }
  refusal.why =
      (section != nullptr ? "the file cannot hold this text: " : "the file has no place for this text: ") + text;
  Edits edits;
  const bool is_done = section != nullptr ? assign(*input.eds, *section, assignment, edits, refusal)
                                          : assign(*input.xdd, *entry, assignment, edits, refusal);
  bytes = edits.applied_to(input.source().bytes());
  return is_done;
}

// Returns false, with the reason, if a field is given twice.
bool has_fields_once(const Change& change, std::string& why) {
  std::vector<std::string_view> fields;
  for (const std::string& each : change.assignments) {
    Assignment assignment;
    if (!parse_assignment(each, assignment, why)) {
      return false;
    }
    const std::string_view property = property_of(assignment.field);
    const std::string_view field = property.empty() ? key_of(assignment.field) : property;
    const auto is_same = [field](std::string_view other) { return equal_ignoring_case(field, other); };
    if (std::any_of(fields.begin(), fields.end(), is_same)) {
      why = "two values for one field: " + each;
      return false;
    }
    fields.push_back(field);
  }
  return true;
}

// Returns false, with the reason, if a target is given twice: its fields belong together.
bool has_targets_once(const std::vector<Change>& changes, std::string& why) {
  for (auto change = changes.begin(); change != changes.end(); ++change) {
    const auto is_same = [change](const Change& other) { return equal_ignoring_case(other.target, change->target); };
    if (std::any_of(changes.begin(), change, is_same)) {
      why = "target given twice: " + change->target + "; write its fields behind the first";
      return false;
    }
  }
  return true;
}

// Parses the changes. A word without "=" is a target. On failure, why is the reason.
bool parse_changes(const std::vector<std::string>& words, std::vector<Change>& changes, std::string& why) {
  for (const std::string& word : words) {
    const bool is_target = word.find('=') == std::string::npos;
    if (is_target && (changes.empty() || !changes.back().assignments.empty())) {
      changes.push_back({word, {}});
    } else if (changes.empty()) {
      why = "no object or section before " + word;
      return false;
    } else {
      changes.back().assignments.push_back(word);
    }
  }
  why = "no field=value for " + changes.back().target;
  return !changes.back().assignments.empty() && has_targets_once(changes, why) &&
         std::all_of(changes.begin(), changes.end(), [&why](const Change& each) { return has_fields_once(each, why); });
}

// Applies the changes one after another; bytes are those of the changed file. On failure, refusal has the reason.
bool apply(const Input& input, const std::vector<std::string>& words, std::string& bytes, Refusal& refusal) {
  std::vector<Change> changes;
  if (!parse_changes(words, changes, refusal.why)) {
    return false;
  }
  std::optional<Input> changed;
  for (const Change& change : changes) {
    for (const std::string& assignment : change.assignments) {
      if (!bytes.empty()) {
        changed = read(Source(input.source().name(), bytes), refusal.why);
      }
      if ((!bytes.empty() && !changed) ||
          !assign_to(changed ? *changed : input, change.target, assignment, bytes, refusal)) {
        return false;
      }
    }
  }
  return true;
}

int write(const SetOptions& options, const Input& input, const std::string& bytes) {
  const std::string path = options.output.empty() ? options.file : options.output;
  const Status status = write_output(path, bytes);
  if (status == clean && options.is_json && path != "-") {
    print_json(Json{{"schema", "codict-set-1"}, {"file", path}, {"changed", bytes != input.source().bytes()}});
  }
  return status;
}

// Returns true if the extension of the output contradicts the format of the input, which set does not convert.
bool is_of_another_format(const Input& input, const std::string& path) {
  const std::string ending = ending_of(path);
  const bool is_sections = ending == "eds" || ending == "dcf";
  const bool is_xml = ending == "xdd" || ending == "xdc" || ending == "xpd" || ending == "xml";
  return (is_sections && input.eds == nullptr) || (is_xml && input.xdd == nullptr) ||
         (ending == "json" && input.json == nullptr);
}

int run_set(const SetOptions& options) {
  std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  if (is_of_another_format(*input, options.output)) {
    print_message(fmt::format("{}: {} has another format; use convert to change the format", options.output,
                              input->source().name()));
    return unusable;
  }
  Refusal refusal;
  std::string bytes;
  if (!apply(*input, options.words, bytes, refusal)) {
    print_message(input->source().name() + ": " + refusal.why);
    return refusal.status;
  }
  std::string why;
  std::optional<Input> changed = read(Source(input->source().name(), bytes), why);
  const std::string& path = options.output.empty() ? options.file : options.output;
  if (!options.is_forced && !(changed && review(*input, *changed, path))) {
    print_message("new errors, no file was written; --force writes it nevertheless");
    return found;
  }
  return write(options, *input, bytes);
}

}  // namespace

Command add_set(CommandLine& line) {
  const auto options = std::make_shared<SetOptions>();
  Arguments command =
      line.add_command("set", "Change values of an object or section; all other bytes stay as they are");
  command.add_option("file", options->file, file_help).required();
  command
      .add_option("changes", options->words,
                  "Object (0x2000, 0x2000:1) or section (FileInfo), then its fields as for get; a field that the "
                  "description does not have is added; further objects may follow")
      .required();
  command.add_option("-o,--output", options->output, "Output file, - for the standard output; default: the input file");
  command.add_flag("--force", options->is_forced, "Write the file although the values cause new errors");
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  return {command, [options] { return run_set(*options); }};
}

}  // namespace lexican::codict::cli
