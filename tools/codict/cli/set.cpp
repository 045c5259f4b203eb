// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/field.hpp"
#include "cli/review.hpp"
#include "text/edit.hpp"
#include "text/file.hpp"
#include "text/number.hpp"

namespace lexican::codict::cli {

namespace {

struct Options {
  std::string file;
  std::string target;
  std::vector<std::string> assignments;
  std::string output;
  bool is_forced = false;
  bool is_json = false;
};

struct Assignment {
  std::string_view field;
  std::string_view text;
};

// "field=text"; false if it is something else.
bool parse(std::string_view assignment, Assignment& result, std::string& why) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || trimmed(assignment.substr(0, equals)).empty()) {
    why = "not of the form field=value: " + std::string(assignment);
    return false;
  }
  result = {trimmed(assignment.substr(0, equals)), trimmed(assignment.substr(equals + 1))};
  return true;
}

bool assign(const eds::Document& document, const eds::Section& section, const Assignment& assignment, Edits& edits) {
  const std::string_view name = key_of(assignment.field);
  const eds::Key* const key = document.find(section, name);
  return key != nullptr ? document.set_value(*key, assignment.text, edits)
                        : document.add_key(section, name, assignment.text, edits);
}

// What an element's name says is not a value that can be replaced.
bool is_value(const xdd::Document& document, Span span) {
  return span.begin != 0 && document.source().bytes()[span.begin - 1] != '<';
}

bool assign(const xdd::Document& document, const Entry& entry, const Assignment& assignment, Edits& edits) {
  const Text* const text = find_text(entry, assignment.field);
  return text != nullptr && text->is_given && is_value(document, text->span) &&
         document.set_text(text->span, assignment.text, edits);
}

// False leaves why not.
bool assign_all(const Input& input, const Options& options, Edits& edits, std::string& why) {
  if (input.json != nullptr) {
    why = "values of JSON are changed by programs for JSON";
    return false;
  }
  const eds::Section* const section = input.eds != nullptr ? find_section(input, options.target, why) : nullptr;
  const Entry* const entry = input.xdd != nullptr ? find_entry(input, options.target, why) : nullptr;
  if (section == nullptr && entry == nullptr) {
    return false;
  }
  for (const std::string& each : options.assignments) {
    Assignment assignment;
    if (!parse(each, assignment, why)) {
      return false;
    }
    if (!(section != nullptr ? assign(*input.eds, *section, assignment, edits)
                             : assign(*input.xdd, *entry, assignment, edits))) {
      why = (section != nullptr ? "the file cannot hold this text: " : "the file has no place for this text: ") + each;
      return false;
    }
  }
  return true;
}

int write(const Options& options, const Input& input, const std::string& bytes) {
  const std::string path = options.output.empty() ? options.file : options.output;
  std::string why;
  const Written written = write_file(path, bytes, why);
  if (written == Written::no) {
    complain(why);
    return unusable;
  }
  if (options.is_json && path != "-") {
    print_json(Json{{"schema", "codict-set-1"}, {"file", path}, {"changed", bytes != input.source().bytes()}});
  }
  return clean;
}

int run(const Options& options) {
  std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  std::string why;
  Edits edits;
  if (!assign_all(*input, options, edits, why)) {
    complain(input->source().name() + ": " + why);
    return unusable;
  }
  const std::string bytes = edits.applied_to(input->source().bytes());
  std::optional<Input> changed = read(Source(input->source().name(), bytes), why);
  if (!options.is_forced && !(changed && review(*input, *changed))) {
    complain("nothing is written: --force writes it nevertheless");
    return found;
  }
  return write(options, *input, bytes);
}

}  // namespace

Command add_set(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* const command =
      app.add_subcommand("set", "Change values of an object or section; all other bytes stay as they are");
  command->add_option("file", options->file, file_help)->required();
  command->add_option("target", options->target, "Object (0x2000, 0x2000:1) or section (FileInfo)")->required();
  command
      ->add_option("assignment", options->assignments,
                   "field=value, the fields as those of get; a key that an EDS does not have is added")
      ->required();
  command->add_option("-o,--output", options->output, "Another file, - for the standard output");
  command->add_flag("--force", options->is_forced, "Write values even where they are errors");
  command->add_flag("--json", options->is_json, "For programs");
  return {command, [options] { return run(*options); }};
}

}  // namespace lexican::codict::cli
