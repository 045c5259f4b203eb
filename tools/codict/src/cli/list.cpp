// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <utility>

#include "cli/command.hpp"
#include "cli/letters.hpp"

namespace lexican::codict::cli {

namespace {

struct ListOptions {
  std::string file;
  bool is_json = false;
  bool has_objects_only = false;
};

std::string visible_or_dash(const std::string& text) { return text.empty() ? "-" : visible(text); }

// Returns the line of an object or sub-object.
std::string line_of(const Reference& reference, const Entry& entry) {
  const std::string place = to_string(reference);
  if (has_sub_objects(entry.object_code.value)) {
    return fmt::format("{:<8} {:<15} {:<5} {:<4} {:<18} {}\n", place, name_of(entry.object_code.value), "", "", "",
                       visible(entry.name.text));
  }
  const bool is_mapped = entry.pdo_mapping.value != PdoMapping::no;
  return fmt::format("{:<8} {:<15} {:<5} {:<4} {:<18} {}\n", place, type_name(entry), name_of(entry.access.value),
                     is_mapped ? "PDO" : "", visible_or_dash(value_in_force(entry).text), visible(entry.name.text));
}

void add_values(Json& json, const Entry& entry) {
  for (const auto& [name, value] :
       {std::make_pair("default", &entry.default_value), std::make_pair("value", &*entry.actual_value),
        std::make_pair("low_limit", &*entry.low_limit), std::make_pair("high_limit", &*entry.high_limit)}) {
    if (value->is_given) {
      json[name] = value->text;
    }
  }
}

Json entry_json(const Reference& reference, const Entry& entry) {
  Json json;
  json["index"] = reference.index;
  if (reference.sub_index) {
    json["sub_index"] = *reference.sub_index;
  }
  json["name"] = entry.name.text;
  json["object"] = name_of(entry.object_code.value);
  if (!has_sub_objects(entry.object_code.value)) {
    json["type"] = type_name(entry);
    json["access"] = name_of(entry.access.value);
    json["pdo_mapping"] = name_of(entry.pdo_mapping.value);
    add_values(json, entry);
  }
  return json;
}

int run_list(const ListOptions& options) {
  const std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  std::string lines;
  Json all = Json::array();
  const auto show = [&](const Reference& reference, const Entry& entry) {
    if (options.is_json) {
      all.push_back(entry_json(reference, entry));
    } else {
      lines += line_of(reference, entry);
    }
  };
  for (const Object& object : input->device().objects) {
    show({object.index, std::nullopt}, object);
    if (options.has_objects_only) {
      continue;
    }
    for (const Sub& sub : object.subs) {
      show({object.index, sub.sub_index}, sub);
    }
  }
  print(lines);
  if (options.is_json) {
    print_json(Json{{"schema", "codict-list-1"}, {"file", input->source().name()}, {"objects", std::move(all)}});
  }
  return clean;
}

}  // namespace

Command add_list(CommandLine& line) {
  const auto options = std::make_shared<ListOptions>();
  Arguments command = line.add_command("list", "List the objects of a device");
  command.add_option("file", options->file, file_help).required();
  command.add_flag("--objects", options->has_objects_only, "Omit sub-objects");
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  return {command, [options] { return run_list(*options); }};
}

}  // namespace lexican::codict::cli
