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
  std::string target;
  std::vector<std::string> assignments;
  std::string output;
  bool is_forced = false;
  bool is_json = false;
};

// Reason why nothing is changed, and the exit status for it.
struct Refusal {
  std::string why;
  Status status = unusable;
};

// Adds the edits that set a key of an EDS section. Returns false if the file cannot contain the text.
bool assign(const eds::Document& document, const eds::Section& section, const Assignment& assignment, Edits& edits) {
  const std::string_view name = key_of(assignment.field);
  const eds::Key* const key = document.find(section, name);
  return key != nullptr ? document.set_value(*key, assignment.text, edits)
                        : document.add_key(section, name, assignment.text, edits);
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
    return document.set_text(text->span, assignment.text, edits);
  }
  const std::string_view attribute = attribute_of(assignment.field);
  return !attribute.empty() && document.add_attribute(entry.span.begin, attribute, assignment.text, edits);
}

// Sets fields in lists of compact storage. On failure, why is the reason.
bool assign_to_lists(const Input& input, const Reference& reference, const SetOptions& options, std::string& bytes,
                     std::string& why) {
  std::string lines;
  for (const std::string& each : options.assignments) {
    Assignment assignment;
    if (!parse_assignment(each, assignment, why) || !add_to_lists(reference, assignment, lines, why)) {
      return false;
    }
  }
  Findings findings;
  std::vector<convert::ReplacedValue> replaced;
  if (!convert::merge(*input.eds, eds::Document(Source("set", lines), findings), bytes, replaced)) {
    why = "the file cannot hold these texts";
    return false;
  }
  return true;
}

// Adds the edits for all assignments. On failure, refusal has the reason.
bool assign_all(const Input& input, const SetOptions& options, Edits& edits, Refusal& refusal) {
  if (input.json != nullptr) {
    refusal.why = "values of JSON are changed by programs for JSON";
    return false;
  }
  const eds::Section* const section = input.eds != nullptr ? find_section(input, options.target, refusal.why) : nullptr;
  const Entry* const entry = input.xdd != nullptr ? find_entry(input, options.target, refusal.why) : nullptr;
  if (section == nullptr && entry == nullptr) {
    return false;
  }
  return std::all_of(options.assignments.begin(), options.assignments.end(), [&](const std::string& each) {
    Assignment assignment;
    if (!parse_assignment(each, assignment, refusal.why)) {
      return false;
    }
    refusal.why =
        (section != nullptr ? "the file cannot hold this text: " : "the file has no place for this text: ") + each;
    return section != nullptr ? assign(*input.eds, *section, assignment, edits)
                              : assign(*input.xdd, *entry, assignment, edits, refusal);
  });
}

// Returns false, with the reason, if a field is given twice.
bool has_fields_once(const SetOptions& options, std::string& why) {
  std::vector<std::string_view> fields;
  for (const std::string& each : options.assignments) {
    Assignment assignment;
    if (!parse_assignment(each, assignment, why)) {
      return false;
    }
    const auto is_same = [field = key_of(assignment.field)](std::string_view other) {
      return equal_ignoring_case(field, other);
    };
    if (std::any_of(fields.begin(), fields.end(), is_same)) {
      why = "two values for one field: " + each;
      return false;
    }
    fields.push_back(key_of(assignment.field));
  }
  return true;
}

// Applies the assignments; bytes are those of the changed file. On failure, refusal has the reason.
bool change(const Input& input, const SetOptions& options, std::string& bytes, Refusal& refusal) {
  if (!has_fields_once(options, refusal.why)) {
    return false;
  }
  Reference reference;
  if (input.eds != nullptr && parse_reference(options.target, reference) && is_implied(input, reference)) {
    return assign_to_lists(input, reference, options, bytes, refusal.why);
  }
  Edits edits;
  const bool is_done = assign_all(input, options, edits, refusal);
  bytes = edits.applied_to(input.source().bytes());
  return is_done;
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
  if (!change(*input, options, bytes, refusal)) {
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
  command.add_option("target", options->target, "Object (0x2000, 0x2000:1) or section (FileInfo)").required();
  command
      .add_option("assignment", options->assignments,
                  "field=value, fields as for get; a field that the description does not have is added")
      .required();
  command.add_option("-o,--output", options->output, "Output file, - for the standard output; default: the input file");
  command.add_flag("--force", options->is_forced, "Write the file although the values cause new errors");
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  return {command, [options] { return run_set(*options); }};
}

}  // namespace lexican::codict::cli
