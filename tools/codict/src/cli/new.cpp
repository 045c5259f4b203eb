// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/output.hpp"
#include "cli/render.hpp"
#include "gen/gen.hpp"
#include "gen/names.hpp"
#include "model/cob_id.hpp"
#include "model/pdo.hpp"
#include "project/profile.hpp"
#include "project/project.hpp"
#include "text/number.hpp"

namespace lexican::codict::cli {

namespace {

struct NewOptions {
  std::string directory;
  std::string from;
  std::string profile;
  gen::Language language = gen::Language::c;
  bool is_forced = false;
};

// Returns the name of the project, derived from that of its directory.
std::string project_name(const std::string& directory) {
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::weakly_canonical(directory, ignored);
  const std::string name =
      gen::identifier((path.has_filename() ? path.filename() : path.parent_path().filename()).string());
  return name.empty() ? "device" : name;
}

// Returns the file name of the description in the project.
std::string description_name(const NewOptions& options) {
  return options.profile.empty() ? std::filesystem::path(options.from).filename().string()
                                 : project_name(options.directory) + ".eds";
}

// Reads the description, or creates that of the profile.
std::optional<Input> description_of(const NewOptions& options) {
  if (options.profile.empty()) {
    return load(options.from);
  }
  const std::string file_name = description_name(options);
  std::string why;
  return read(Source(file_name, project::profile_eds(static_cast<std::uint16_t>(std::stoul(options.profile)),
                                                     project_name(options.directory), file_name)),
              why);
}

// Returns true if the program can trigger a TPDO: its mapping is complete, and it is event-driven or transmitted at
// least every 20 SYNCs.
bool can_be_sent(const Pdo& pdo) {
  constexpr std::uint64_t most_syncs = 20;
  const Entry* const type = pdo.parameter(2);
  const std::uint64_t number =
      type != nullptr && value_in_force(*type).is_integer() ? value_in_force(*type).integer.bits() : 0;
  return pdo.is_transmit && pdo.communication != nullptr && !pdo.is_multiplexed && !pdo.mapped.empty() &&
         (number <= most_syncs || number >= transmission_type::event_manufacturer) &&
         std::all_of(pdo.mapped.begin(), pdo.mapped.end(),
                     [](const MappedObject& mapped) { return mapped.entry != nullptr; });
}

// Chooses the TPDO that the program triggers: the first one that can be sent and has a valid COB-ID of 11 bits.
void choose_tpdo(const Device& device, project::Options& options) {
  const std::vector<CobId> cob_ids = cob_ids_of(device, options.node_id);
  for (const Pdo& pdo : pdos_of(device)) {
    const auto cob_id = std::find_if(cob_ids.begin(), cob_ids.end(), [&pdo](const CobId& each) {
      return pdo.communication != nullptr && each.index == pdo.communication->index;
    });
    if (can_be_sent(pdo) && cob_id != cob_ids.end() && cob_id->is_valid() && !cob_id->is_extended()) {
      options.tpdo = pdo.number;
      options.tpdo_cob_id = cob_id->identifier();
      return;
    }
  }
}

// Returns the settings of co_cfg.h whose value in the preset "full" is too small for the dictionary.
std::vector<std::pair<std::string, unsigned>> settings_of(const std::string& header, const std::string& prefix) {
  std::vector<std::pair<std::string, unsigned>> settings;
  for (const auto& [name, number] : {std::pair("RPDO_N", 8U), std::pair("TPDO_N", 8U), std::pair("SSDO_N", 4U),
                                     std::pair("CSDO_N", 3U), std::pair("SRDO_N", 4U)}) {
    const std::string definition = fmt::format("#define {}_OD_{} ", prefix, name);
    const std::size_t at = header.find(definition);
    const auto needed =
        at == std::string::npos ? 0U : static_cast<unsigned>(std::stoul(header.substr(at + definition.size(), 4)));
    if (needed > number) {
      settings.emplace_back(fmt::format("CO_{}", name), needed);
    }
  }
  return settings;
}

// Returns all files of the project: its build files and sources, the description, and the generated dictionary.
std::vector<project::File> files_of(const NewOptions& options, const Input& input, const gen::Output& output,
                                    const std::string& dictionary, bool is_forced) {
  const bool is_cpp = options.language == gen::Language::cpp;
  const std::string& header = output.files.front().bytes;
  project::Options project;
  project.name = project_name(options.directory);
  project.dictionary = dictionary;
  project.description = description_name(options);
  project.is_cpp = is_cpp;
  project.node_id = node_id_of(output.device, 0);
  project.has_storage = header.find(gen::upper(dictionary) + "_PARA_END") != std::string::npos;
  project.has_application = !output.stubs.empty();
  project.is_forced = is_forced;
  project.settings = settings_of(header, gen::upper(dictionary));
  choose_tpdo(output.device, project);

  std::vector<project::File> files = project::files(project);
  files.push_back({project.description, std::string(input.source().bytes())});
  for (const gen::File& file : output.files) {
    files.push_back({"generated/" + file.name, file.bytes});
  }
  if (project.has_application) {
    files.push_back({is_cpp ? "application.cpp" : "application.c", output.stubs});
  }
  return files;
}

// Writes all files, or no file if one of them exists.
int write_new(const std::string& directory, const std::vector<project::File>& files) {
  std::error_code error;
  for (const project::File& file : files) {
    const std::filesystem::path path = std::filesystem::path(directory) / file.name;
    if (std::filesystem::exists(std::filesystem::symlink_status(path, error))) {
      print_message(path.string() + " exists; no file was written, choose another directory");
      return unusable;
    }
  }
  std::filesystem::create_directories(std::filesystem::path(directory) / "generated", error);
  if (error) {
    print_message(directory + ": " + error.message());
    return unusable;
  }
  for (const project::File& file : files) {
    const std::string path = (std::filesystem::path(directory) / file.name).string();
    if (write_output(path, file.bytes) != clean) {
      return unusable;
    }
    print(path + "\n");
  }
  return clean;
}

// Shows the findings of the description and of the generator. Returns true if the description has no errors.
bool review_description(Input& input, Findings& findings) {
  suppress(input, catalogue::Origin::generator, findings);
  check_all(input);
  show_findings(input, input.findings, Severity::error);
  show_findings(input, findings, Severity::warning);
  const std::vector<Finding>& all = input.findings.all();
  return std::none_of(all.begin(), all.end(),
                      [](const Finding& finding) { return finding.rule->severity == Severity::error; });
}

int run_new(const NewOptions& options) {
  if (options.from.empty() == options.profile.empty()) {
    print_message("give either --from FILE or --profile 301, 401 or 402");
    return unusable;
  }
  if (options.from == "-") {
    print_message("--from: not the path of a file");
    return unusable;
  }
  std::optional<Input> input = description_of(options);
  if (!input) {
    return unusable;
  }
  gen::Options gen;
  gen.name = gen::default_name(description_name(options));
  gen.source = description_name(options);
  gen.language = options.language;
  Findings findings;
  const gen::Output output = gen::generate(input->device(), gen, findings);
  const bool is_right = review_description(*input, findings);
  if (output.files.empty()) {
    return found;
  }
  if (!is_right && !options.is_forced) {
    print_message("errors, no file was written; correct the description, or use --force");
    return found;
  }
  return write_new(options.directory, files_of(options, *input, output, gen.name, !is_right));
}

}  // namespace

Command add_new(CommandLine& line) {
  const auto options = std::make_shared<NewOptions>();
  Arguments command = line.add_command("new", "Create a project of a node that builds and runs on a simulated bus");
  command.add_option("directory", options->directory, "Directory of the project; existing files are never replaced")
      .required();
  const Option from = command.add_option("--from", options->from, "Description of the device; it is copied");
  command
      .add_option("--profile", options->profile,
                  "Create a description: 301 (no device profile), 401 (inputs and outputs), 402 (drive)")
      .one_of({"301", "401", "402"})
      .excludes(from);
  const Choices<gen::Language> languages = {{"c", gen::Language::c}, {"c++", gen::Language::cpp}};
  command.add_choice("--language", options->language, languages, "Language of the sources: c, c++").default_text("c");
  command.add_flag("--force", options->is_forced, "Create the project although the description has errors");
  return {command, [options] { return run_new(*options); }};
}

}  // namespace lexican::codict::cli
