// SPDX-License-Identifier: Apache-2.0
#include "gen/gen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/costs.hpp"
#include "cli/output.hpp"
#include "cli/render.hpp"
#include "cli/stores.hpp"
#include "cli/verify.hpp"
#include "eds/write.hpp"
#include "gen/eds.hpp"
#include "gen/names.hpp"
#include "gen/write.hpp"
#include "text/file.hpp"
#include "text/memory.hpp"
#include "text/number.hpp"
#include "xdd/write.hpp"

namespace lexican::codict::cli {

namespace {

struct GenOptions {
  std::string file;
  std::string directory;
  std::string eds;
  std::string xdd;
  std::string stubs;
  std::string verify_source;
  std::vector<std::string> stores;
  std::vector<std::string> error_bits;
  VerifyOptions verify;
  gen::Options gen;
  bool is_check = false;
  bool is_report = false;
  bool is_json = false;
  bool shows_notes = false;
  bool is_forced = false;
};

struct Result {
  gen::Plan plan;
  std::vector<gen::StoredGroup> groups;
  std::vector<gen::External> externals;
  Device device;  // as generated; empty without --eds and --xdd
};

// Prints what --check finds: a missing file, or one that differs from the generated text.
Status compare(const std::string& path, const std::string& bytes) {
  if (!std::filesystem::exists(path)) {
    print_message(path + " is missing");
    return found;
  }
  std::string why;
  const std::optional<Source> present = read_file(path, why);
  if (!present) {
    print_message(why);
    return unusable;
  }
  if (present->bytes() != bytes) {
    print_message(path + " is out of date");
  }
  return present->bytes() == bytes ? clean : found;
}

// Returns "1010h sub 5 (Save PERSIST_APP)".
std::string sub_text(const char* object, std::uint8_t sub_index, const std::string& name) {
  return sub_index == 0 ? fmt::format("no sub-index of {}", object)
                        : fmt::format("{} sub {:X} ({})", object, sub_index, name);
}

std::string groups_text(const Result& result) {
  std::string text;
  for (const gen::StoredGroup& group : result.groups) {
    text += fmt::format("storage group {}: {} {}, {} bytes; stored by {}, restored by {}\n", group.name, group.entries,
                        group.entries == 1 ? "entry" : "entries", group.bytes,
                        sub_text("1010h", group.store_sub, group.store_name),
                        sub_text("1011h", group.restore_sub, group.restore_name));
  }
  return text;
}

std::string externals_text(const Result& result) {
  std::string text = result.externals.empty() ? "" : "to be defined by the application (--stubs FILE writes stubs):\n";
  for (const gen::External& external : result.externals) {
    text += fmt::format("{}  // {}\n", external.declaration, external.about);
  }
  return text;
}

std::string output_text(const GenOptions& options, const Result& result) {
  return (options.is_report ? costs_text(gen::costs_of(result.plan)) : "") + groups_text(result) +
         externals_text(result);
}

// A file that is written. Its text is generated then, because that of a large dictionary needs much memory.
struct Output {
  std::string path;
  std::function<std::string()> text;
};

Json report_json(const std::vector<Output>& outputs, const Result& result) {
  Json json{{"schema", "codict-gen-1"}, {"files", Json::array()}, {"parts", costs_json(gen::costs_of(result.plan))}};
  for (const Output& output : outputs) {
    json["files"].push_back(output.path);
  }
  json["groups"] = Json::array();
  for (const gen::StoredGroup& group : result.groups) {
    json["groups"].push_back({{"name", group.name},
                              {"store_sub", group.store_sub},
                              {"restore_sub", group.restore_sub},
                              {"entries", group.entries},
                              {"bytes", group.bytes}});
  }
  json["external"] = Json::array();
  for (const gen::External& external : result.externals) {
    json["external"].push_back(external.declaration);
  }
  return json;
}

// Sets the file name in the description of the generated device.
const Device& with_file_name(Device& device, const std::string& path) {
  device.file.file_name.text = std::filesystem::path(path).filename();
  device.file.file_name.is_given = true;
  return device;
}

// Returns all files: the sources, and the descriptions that match them. They refer to the parameters.
std::vector<Output> outputs_of(const GenOptions& options, Result& result) {
  const std::string directory = options.directory + "/";
  std::vector<Output> outputs;
  outputs.push_back(
      {directory + gen::header_name(options.gen), [&] { return gen::write_header(result.plan, options.gen); }});
  outputs.push_back(
      {directory + gen::source_name(options.gen), [&] { return gen::write_source(result.plan, options.gen); }});
  if (!options.verify_source.empty()) {
    outputs.push_back({options.verify_source, [&] { return gen::write_verify(result.plan, options.gen); }});
  }
  if (!options.eds.empty()) {
    outputs.push_back(
        {options.eds, [&] { return eds::write(with_file_name(result.device, options.eds), eds::WriteOptions()); }});
  }
  if (!options.xdd.empty()) {
    outputs.push_back(
        {options.xdd, [&] { return xdd::write(with_file_name(result.device, options.xdd), xdd::Edition::v11); }});
  }
  return outputs;
}

// Returns false after a message if a file would overwrite the description, or if two files have the same path.
bool have_places(const GenOptions& options, const std::vector<Output>& outputs) {
  for (std::size_t n = 0; n < outputs.size(); ++n) {
    const std::string& path = outputs[n].path;
    const bool is_twice = std::any_of(outputs.begin(), outputs.begin() + static_cast<std::ptrdiff_t>(n),
                                      [&path](const Output& other) { return is_same_file(path, other.path); });
    if (is_same_file(path, options.file) || is_twice) {
      print_message(path +
                    (is_twice ? ": two outputs have this name" : ": the output would overwrite the description"));
      return false;
    }
  }
  return true;
}

// Writes the stubs unless the file exists, which then belongs to the application; prints the symbols that it lacks.
Status write_stubs(const GenOptions& options, const Result& result) {
  if (options.stubs.empty() || options.is_check || result.externals.empty()) {
    return clean;
  }
  if (options.stubs == "-" || !std::filesystem::exists(options.stubs)) {
    return write_output(options.stubs, gen::write_stubs(result.plan, options.gen));
  }
  std::string why;
  const std::optional<Source> present = read_file(options.stubs, why);
  if (!present) {
    print_message(why);
    return unusable;
  }
  for (const gen::External& external : result.externals) {
    if (present->bytes().find(external.name) == std::string::npos) {
      print_message(fmt::format("{}: the file exists and is not changed; it does not define {} ({})", options.stubs,
                                external.name, external.about));
    }
  }
  return clean;
}

// Shows the generator's findings and the errors of the description. Returns true if the description has no errors.
bool show(const Input& input, const Findings& findings, bool shows_notes) {
  show_findings(input, input.findings, Severity::error);
  show_findings(input, findings, shows_notes ? Severity::note : Severity::warning);
  return input.findings.count(Severity::error) == 0;
}

// Parses an object of --error-bits: "0x2100", "2100", "0x2100:1". Returns false if it is malformed.
bool parse_key(std::string_view text, std::uint32_t& key) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  std::string_view index = text.substr(0, colon);
  const std::string_view sub_index = colon == text.size() ? std::string_view("0") : text.substr(colon + 1);
  if (index.substr(0, 2) == "0x") {
    index.remove_prefix(2);
  }
  std::uint64_t first = 0;
  std::uint64_t second = 0;
  if (!parse_hex(index, first) || !parse_hex(sub_index, second) || first > 0xFFFF || second > 0xFE) {
    return false;
  }
  key = static_cast<std::uint32_t>(first << 16 | second << 8);
  return true;
}

bool parse_error_bits(GenOptions& options) {
  for (const std::string& object : options.error_bits) {
    std::uint32_t key = 0;
    if (!parse_key(object, key)) {
      print_message(fmt::format("--error-bits {}: the form is INDEX or INDEX:SUB, hexadecimal", object));
      return false;
    }
    options.gen.error_bits.insert(key);
  }
  return true;
}

bool complete(GenOptions& options, const Input& input) {
  options.gen.source = std::filesystem::path(input.source().name()).filename();
  options.gen.node_id = node_id_of(input.device(), 0);
  if (options.gen.name.empty()) {
    options.gen.name = gen::default_name(options.file);
  } else if (gen::identifier(options.gen.name) != options.gen.name) {
    print_message("--name: use lower-case letters, digits and single underscores, and no keyword of C");
    return false;
  }
  return parse_stores(options.stores, options.gen) && parse_error_bits(options) && check_verify(options.verify);
}

// Returns false after a message if an object of --error-bits cannot show error status bits.
bool have_error_bits(const gen::Options& options, const gen::Plan& plan) {
  return std::all_of(options.error_bits.begin(), options.error_bits.end(), [&plan](std::uint32_t key) {
    const auto index = static_cast<std::uint16_t>(key >> 16);
    const auto sub_index = static_cast<std::uint8_t>(key >> 8);
    const gen::Item* const item = plan.find(index, sub_index);
    const bool is_right = item != nullptr && item->storage == gen::Storage::error_bits;
    if (!is_right) {
      print_message(fmt::format("--error-bits {:04X}h sub {:X}: no OCTET_STRING that the network can only read", index,
                                sub_index));
    }
    return is_right;
  });
}

// Returns the name of the EDS: that of --eds, else that of the generated files.
std::string eds_name(const GenOptions& options) {
  return options.eds.empty() ? options.gen.name + ".eds" : std::filesystem::path(options.eds).filename().string();
}

// Completes the result of a plan without errors, and frees the description, because the texts need much memory, too.
void complete_result(const GenOptions& options, Input input, Result& result) {
  if (options.gen.embedded_eds != gen::EmbeddedEds::none) {
    gen::embed_eds(input.description.devices.front(), eds_name(options), options.gen, result.plan);
  }
  if (!options.eds.empty() || !options.xdd.empty()) {
    result.device = gen::described(std::move(input.description.devices.front()), result.plan);
  }
  input = {};
  return_free_memory();
  result.groups = gen::stored_groups(result.plan);
  result.externals = gen::externals_of(result.plan, options.gen);
}

int write_all(const GenOptions& options, Result& result) {
  const std::vector<Output> outputs = outputs_of(options, result);
  if (!have_places(options, outputs) || (!options.is_check && !make_directory(options.directory))) {
    return unusable;
  }
  int status = clean;
  for (const Output& output : outputs) {
    const std::string text = output.text();
    status = std::max<int>(status, options.is_check ? compare(output.path, text) : write_output(output.path, text));
  }
  if (options.is_json) {
    print_json(report_json(outputs, result));
  } else if (options.is_report || !options.is_check) {
    print(output_text(options, result));
  }
  return std::max<int>(status, write_stubs(options, result));
}

int run_gen(GenOptions options) {
  std::optional<Input> input = load(options.file);
  if (!input || !complete(options, *input)) {
    return unusable;
  }
  if (options.gen.embedded_eds != gen::EmbeddedEds::none) {
    gen::add_eds_objects(input->description.devices.front());
  }
  check_all(*input);
  Findings findings;
  Result result;
  result.plan = gen::make_plan(input->device(), options.gen, findings);
  const bool is_planned = findings.count(Severity::error) == 0;
  suppress(*input, catalogue::Origin::generator, findings);
  const bool is_right = show(*input, findings, options.shows_notes);
  if (!is_planned || !have_error_bits(options.gen, result.plan)) {
    return found;
  }
  if (!is_right && !options.is_forced) {
    print_message("errors, no file was written; --force generates the dictionary nevertheless");
    return found;
  }
  complete_result(options, std::move(*input), result);
  const int status = write_all(options, result);
  return options.verify.is_wanted && status != unusable
             ? std::max<int>(status, verify(gen::generate(result.plan, options.gen), options.gen, options.verify))
             : status;
}

}  // namespace

// Checks the extension of a path: a file of another format under this name would be misread by other tools.
std::function<std::string(const std::string&)> ends_with(const char* ending) {
  return [ending](const std::string& path) {
    const std::string given = ending_of(path);
    return given.empty() || given == ending ? "" : fmt::format("{}: the ending is .{}", path, ending);
  };
}

Command add_gen(CommandLine& line) {
  const auto options = std::make_shared<GenOptions>();
  Arguments command = line.add_command("gen", "Make the dictionary of a device: C or C++ source");
  command.add_option("file", options->file, file_help).required();
  command.add_option("-o,--output", options->directory, "Directory of NAME_od.h and NAME_od.c or .cpp").required();
  command.add_option("--eds", options->eds, "Write an EDS of the generated dictionary").check(ends_with("eds"));
  command.add_option("--xdd", options->xdd, "Write an XDD of the generated dictionary").check(ends_with("xdd"));
  command.add_option("--stubs", options->stubs,
                     "Write stubs of the application's definitions to this C or C++ file, if it does not exist");
  const Choices<gen::EmbeddedEds> forms = {{"plain", gen::EmbeddedEds::plain}, {"zlib", gen::EmbeddedEds::zlib}};
  command.add_choice("--embed-eds", options->gen.embedded_eds, forms,
                     "Put an EDS of the generated dictionary into 1021h: plain, zlib; 1022h is set to the format");
  command
      .add_option("--error-bits", options->error_bits,
                  "INDEX or INDEX:SUB: an OCTET_STRING that shows error status bits (CO_TEMCY_BITS)")
      .single_values();
  add_stores(command, options->stores);
  command.add_option("--name", options->gen.name, "Prefix of all names; default: the name of the file");
  const Choices<gen::Language> languages = {{"c", gen::Language::c}, {"c++", gen::Language::cpp}};
  command
      .add_choice("--language", options->gen.language, languages,
                  "Language of the source: c, c++; the header is valid in both")
      .default_text("c");
  command.add_flag("--check", options->is_check, "Write no file; status 1 if a file would change");
  command.add_flag("--report", options->is_report, "Print the bytes of RAM and flash for a 32-bit CPU");
  command.add_flag("--json", options->is_json, "Print the report as JSON, for programs");
  command.add_flag("--notes", options->shows_notes, "Also show notes");
  command.add_flag("--force", options->is_forced, "Generate the dictionary although the description has errors");
  add_verify(command, options->verify);
  command.add_option("--verify-source", options->verify_source,
                     "Write the program that --verify compiles, in C or C++");
  command.add_flag("--unique-names", options->gen.unique_names, "Report entries with equal names as errors");
  command.add_flag("--trigger-tpdos", options->gen.trigger_tpdos,
                   "Set flag A for objects that can be mapped to TPDOs: a change triggers the TPDO");
  command
      .add_option("--string-capacity", options->gen.string_capacity,
                  "Bytes of a string whose length the description does not limit")
      .in_range(1, 65535)
      .default_text(std::to_string(options->gen.string_capacity));
  return {command, [options] { return run_gen(*options); }};
}

}  // namespace lexican::codict::cli
