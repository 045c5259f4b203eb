// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <utility>

#include "cli/command.hpp"
#include "cli/field.hpp"
#include "cli/letters.hpp"

namespace lexican::codict::cli {

namespace {

struct GetOptions {
  std::string file;
  std::string target;
  std::string field;
  bool is_json = false;
};

// Returns the exact text; on a terminal, with question marks for control characters.
std::string printed(const std::string& text) { return is_terminal() ? visible(text) : text; }

Json value_json(const Input& input, const eds::Key& key) {
  const Position position = input.source().position(key.value.begin);
  return {{"key", input.eds->text(key.name)},
          {"text", input.eds->text(key.value)},
          {"line", position.line},
          {"column", position.column}};
}

int get_all(const Input& input, const eds::Section& section, bool is_json) {
  Json keys = Json::array();
  std::string lines;
  for (const eds::Key& key : section.keys) {
    keys.push_back(value_json(input, key));
    lines += fmt::format("{}={}\n", printed(input.eds->text(key.name)), printed(input.eds->text(key.value)));
  }
  if (is_json) {
    print_json(Json{{"schema", "codict-get-1"}, {"section", input.eds->text(section.name)}, {"keys", std::move(keys)}});
  } else {
    print(lines);
  }
  return clean;
}

int get_from_sections(const Input& input, const GetOptions& options) {
  std::string why;
  const eds::Section* const section = find_section(input, options.target, why);
  if (section == nullptr) {
    print_message(input.source().name() + ": " + why);
    return unusable;
  }
  if (options.field.empty()) {
    return get_all(input, *section, options.is_json);
  }
  const std::optional<eds::Key> key = find_key(*input.eds, *section, key_of(options.field));
  if (!key) {
    const std::string_view name = key_of(options.field);
    print_message(fmt::format("{}: [{}] has no {}", input.source().name(), input.eds->text(section->name),
                              name.empty() ? options.field : name));
    return unusable;
  }
  if (options.is_json) {
    Json json = {{"schema", "codict-get-1"}, {"section", input.eds->text(section->name)}};
    json["keys"] = Json::array({value_json(input, *key)});
    print_json(json);
  } else {
    print(printed(input.eds->text(key->value)) + "\n");
  }
  return clean;
}

Json value_json(const Input& input, std::string_view field, const Text& text) {
  const Position position = input.source().position(text.span.begin);
  return {{"key", field}, {"text", text.text}, {"line", position.line}, {"column", position.column}};
}

// Prints an object of an XML description, which has no sections: the fields that the reader found in its elements.
int get_from_elements(const Input& input, const GetOptions& options) {
  std::string why;
  const Entry* const entry = find_entry(input, options.target, why);
  if (entry == nullptr) {
    print_message(input.source().name() + ": " + why);
    return unusable;
  }
  Json keys = Json::array();
  std::string lines;
  const bool wants_all = options.field.empty();
  for_each_text(*entry, [&](std::string_view field, const Text& text) {
    if (wants_all || find_text(*entry, options.field) == &text) {
      keys.push_back(value_json(input, field, text));
      lines += wants_all ? fmt::format("{}={}\n", field, printed(text.text)) : printed(text.text) + "\n";
    }
  });
  if (keys.elements().empty()) {
    print_message(fmt::format("{}: {} has no {}", input.source().name(), options.target, options.field));
    return unusable;
  }
  if (options.is_json) {
    print_json(Json{{"schema", "codict-get-1"}, {"object", options.target}, {"keys", std::move(keys)}});
  } else {
    print(lines);
  }
  return clean;
}

int run_get(const GetOptions& options) {
  const std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  return input->eds != nullptr ? get_from_sections(*input, options) : get_from_elements(*input, options);
}

}  // namespace

Command add_get(CommandLine& line) {
  const auto options = std::make_shared<GetOptions>();
  Arguments command = line.add_command("get", "Show one value, or all of an object or section");
  command.add_option("file", options->file, file_help).required();
  command.add_option("target", options->target, "Object (0x2000, 0x2000:1) or section (FileInfo)").required();
  command.add_option(
      "field", options->field,
      "name, object, type, access, default, value, low, high, pdo, flags, denotation, or any key of an EDS");
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  return {command, [options] { return run_get(*options); }};
}

}  // namespace lexican::codict::cli
