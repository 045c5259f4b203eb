// SPDX-License-Identifier: Apache-2.0
#include "convert/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/field.hpp"
#include "cli/output.hpp"
#include "cli/review.hpp"
#include "convert/product.hpp"
#include "eds/write.hpp"
#include "text/number.hpp"

namespace lexican::codict::cli {

namespace {

using convert::ReplacedValue;

struct MergeOptions {
  std::string base;
  std::vector<std::string> overlays;
  std::vector<std::string> values;
  std::string output;
  bool is_forced = false;
  bool is_json = false;
};

// A word of --set that a build supplies, and the field that it sets.
struct IdentityWord {
  std::string_view name;
  std::string_view target;
  std::string_view field;
};

constexpr std::array<IdentityWord, 7> identity_words = {{{"vendor", "1018:1", "default"},
                                                         {"vendor", "DeviceInfo", "VendorNumber"},
                                                         {"product", "1018:2", "default"},
                                                         {"product", "DeviceInfo", "ProductNumber"},
                                                         {"revision", "1018:3", "default"},
                                                         {"revision", "DeviceInfo", "RevisionNumber"},
                                                         {"serial", "1018:4", "default"}}};
constexpr std::string_view software_version = "100A:0";

struct MergeResult {
  Input input;
  std::map<std::pair<std::string, std::string>, std::string> sources;  // by section and key: last overlay
  std::vector<std::pair<ReplacedValue, std::string>> replaced;         // with the overlay that replaced it
};

void report_replacements(MergeResult& merged, const std::string& base, const std::string& overlay,
                         std::vector<ReplacedValue> replaced) {
  for (ReplacedValue& one : replaced) {
    std::string& source = merged.sources[{one.section, one.key}];
    if (one.is_definition() || !source.empty()) {
      print_message(fmt::format("{}: [{}] {}={} contradicts {} of {}", overlay, one.section, one.key, one.after,
                                one.before, source.empty() ? base : source));
    }
    source = overlay;
    merged.replaced.emplace_back(std::move(one), overlay);
  }
}

// Merges an overlay. Returns false after a message if that fails.
bool add(MergeResult& merged, const eds::Document& overlay, const std::string& base) {
  std::vector<ReplacedValue> replaced;
  std::string bytes;
  const std::string& name = overlay.source().name();
  if (!convert::merge(*merged.input.eds, overlay, bytes, replaced)) {
    print_message(fmt::format("{}: a character is not contained in the encoding of {}", name, base));
    return false;
  }
  report_replacements(merged, base, name, std::move(replaced));
  std::string why;
  std::optional<Input> input = read(Source(merged.input.source().name(), std::move(bytes)), why);
  if (!input) {
    print_message(fmt::format("{}: {}", name, why));
    return false;
  }
  merged.input = std::move(*input);
  return true;
}

// Returns a device of another format as lines of a DCF, without its file information and without empty values, which
// would replace values of the base.
std::string lines_of(Device device) {
  device.file = {};
  eds::WriteOptions options;
  options.as_dcf = true;
  options.line_end = "\n";
  const std::string text = eds::write(device, options);
  std::string lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    const bool has_no_value = line.size() > 1 && line[line.size() - 2] == '=';
    lines += has_no_value ? std::string_view() : line;
    begin = end;
  }
  return lines;
}

Status add_file(MergeResult& merged, const std::string& path, const Device& base, const MergeOptions& options) {
  const std::optional<Input> input = open(path);
  if (!input) {
    return unusable;
  }
  const std::string other = convert::other_product(base, input->device());
  if (!other.empty() && !options.is_forced) {
    print_message(fmt::format("{}: another product than {}: {}; no file was written, use --force to merge nevertheless",
                              path, options.base, other));
    return found;
  }
  Findings findings;
  const bool is_added =
      input->eds != nullptr
          ? add(merged, *input->eds, options.base)
          : add(merged, eds::Document(Source(path, lines_of(input->device())), findings), options.base);
  return is_added ? clean : unusable;
}

// Returns the section of a target with one key; empty if there is no such target. why is then the reason in one line.
std::string lines_for(const Input& input, const std::string& target, std::string_view field, std::string_view value,
                      std::string& why) {
  Reference reference;
  if (parse_reference(target, reference) && is_implied(input, reference)) {
    std::string lines;
    add_to_lists(reference, {field, value}, lines, why);
    return lines;
  }
  const eds::Section* const section = has_one_line(value, why) ? find_section(input, target, why) : nullptr;
  return section == nullptr ? std::string()
                            : fmt::format("[{}]\n{}={}\n", input.eds->text(section->name), key_of(field), value);
}

// Returns the EDS lines for "serial=5" or "1018:4.default=5".
std::string lines_for(const Input& input, std::string_view assignment, std::string& why) {
  Assignment parsed;
  if (!parse_assignment(assignment, parsed, why)) {
    return {};
  }
  const auto [place, value] = parsed;
  const std::size_t point = place.find_last_of('.');
  why = "neither a word (vendor, product, revision, serial, version) nor TARGET.FIELD, with =VALUE";
  if (point != std::string_view::npos) {
    return lines_for(input, std::string(place.substr(0, point)), place.substr(point + 1), value, why);
  }
  if (place == "version") {
    return lines_for(input, std::string(software_version), "default", value, why);
  }
  std::string lines;
  for (const IdentityWord& word : identity_words) {
    const bool is_object = word.target != "DeviceInfo";
    if (word.name != place || (!is_object && input.eds->find("DeviceInfo") == nullptr)) {
      continue;
    }
    const std::string more = lines_for(input, std::string(word.target), word.field, value, why);
    if (more.empty()) {
      return {};
    }
    lines += more;
  }
  return lines;
}

bool add_values(MergeResult& merged, const MergeOptions& options) {
  for (const std::string& value : options.values) {
    std::string why;
    const std::string lines = lines_for(merged.input, value, why);
    if (lines.empty()) {
      print_message(fmt::format("--set {}: {}", value, why));
      return false;
    }
    Findings findings;
    if (!add(merged, eds::Document(Source("--set", lines), findings), options.base)) {
      return false;
    }
  }
  return true;
}

Json merged_json(const MergeOptions& options, const MergeResult& merged) {
  Json json{{"schema", "codict-merge-1"}, {"file", options.output}, {"replaced", Json::array()}};
  for (const auto& [one, overlay] : merged.replaced) {
    json["replaced"].push_back(
        {{"section", one.section}, {"key", one.key}, {"before", one.before}, {"after", one.after}, {"by", overlay}});
  }
  return json;
}

int run_merge(const MergeOptions& options) {
  std::optional<Input> base = open(options.base);
  std::string why;
  if (!base) {
    return unusable;
  }
  if (base->eds == nullptr) {
    print_message(options.base +
                  ": the base must be an EDS or DCF; use convert first, or set to change values of an XDD");
    return unusable;
  }
  for (const std::string& overlay : options.overlays) {
    if (is_same_file(options.output, overlay) && !is_same_file(options.output, options.base)) {
      print_message(options.output + ": the output would overwrite an overlay");
      return unusable;
    }
  }
  MergeResult merged{std::move(*read(base->source(), why)), {}, {}};
  for (const std::string& overlay : options.overlays) {
    if (const Status status = add_file(merged, overlay, base->device(), options); status != clean) {
      return status;
    }
  }
  if (!add_values(merged, options)) {
    return unusable;
  }
  if (!options.is_forced && !review(*base, merged.input, options.output)) {
    print_message("new errors, no file was written; --force writes it nevertheless");
    return found;
  }
  const Status status = write_output(options.output, merged.input.source().bytes());
  if (status == clean && options.is_json && options.output != "-") {
    print_json(merged_json(options, merged));
  }
  return status;
}

}  // namespace

Command add_merge(CommandLine& line) {
  const auto options = std::make_shared<MergeOptions>();
  Arguments command =
      line.add_command("merge", "Put overlays and values over a description, whose other bytes stay as they are");
  command.add_option("base", options->base, "EDS or DCF").required();
  command.add_option(
      "overlay", options->overlays,
      "Descriptions or parts of them, in any format: their contents replace those of the base, or are added");
  command
      .add_option("--set", options->values,
                  "vendor, product, revision, serial or version =VALUE, or TARGET.FIELD=VALUE as for set; may be given "
                  "several times")
      .single_values();
  command.add_option("-o,--output", options->output, "Output file, - for the standard output").required();
  command.add_flag("--force", options->is_forced,
                   "Write the output although it has new errors, or an overlay describes another product");
  command.add_flag("--json", options->is_json, "Print the replaced values as JSON, for programs");
  return {command, [options] { return run_merge(*options); }};
}

}  // namespace lexican::codict::cli
