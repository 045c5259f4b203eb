// SPDX-License-Identifier: Apache-2.0
#include "cli/verify.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>

#include "cli/output.hpp"
#include "text/file.hpp"

namespace lexican::codict::cli {

namespace {

// Build directory: that of the user, or a temporary one, which the destructor removes.
class BuildDirectory {
 public:
  explicit BuildDirectory(const std::string& given) : path_(given), is_temporary_(given.empty()) {
    std::error_code error;
    if (is_temporary_) {
      std::string name = std::filesystem::temp_directory_path(error) / "codict-verify-XXXXXX";
      path_ = ::mkdtemp(name.data()) == nullptr ? "" : name;
    } else {
      std::filesystem::create_directories(path_, error);
      path_ = std::filesystem::absolute(path_, error);
    }
  }
  ~BuildDirectory() {
    std::error_code ignored;
    if (is_temporary_ && !path_.empty()) {
      std::filesystem::remove_all(path_, ignored);
    }
  }
  BuildDirectory(const BuildDirectory&) = delete;
  BuildDirectory& operator=(const BuildDirectory&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  bool is_temporary_ = false;
};

// Quotes a text as one word of a shell.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) {
    text += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return text + "'";
}

// Returns a bracket argument of CMake, in which no character is special.
std::string bracketed(const std::string& text) { return "[==[" + text + "]==]"; }

std::string project_text(const gen::Output& output, const gen::Options& gen, const VerifyOptions& options) {
  const char* const ending = gen.language == gen::Language::cpp ? "cpp" : "c";
  std::string text =
      "# Written by codict gen --verify.\n"
      "cmake_minimum_required(VERSION 3.25)\n"
      "project(codict_verify LANGUAGES C CXX)\n"
      "set(CMAKE_CXX_STANDARD 17)\nset(CMAKE_C_STANDARD 11)\n"
      "add_compile_options(-O0)\n";
  for (const std::string& definition : options.definitions) {
    text += fmt::format("add_compile_definitions({})\n", bracketed(definition));
  }
  text += fmt::format("set(LEXICAN_PRESET {} CACHE STRING \"\" FORCE)\n", bracketed(options.preset));
  text += fmt::format("add_subdirectory({} lexican EXCLUDE_FROM_ALL)\n",
                      bracketed(std::filesystem::absolute(options.stack)));
  // Compiles the program before the stack, so that too small a configuration is reported early.
  text += fmt::format("add_library(requirements OBJECT EXCLUDE_FROM_ALL verify.{})\n", ending);
  text += "target_link_libraries(requirements PRIVATE lexican)\n";
  text += fmt::format("add_executable(verify $<TARGET_OBJECTS:requirements> {})\n", output.files.at(1).name);
  text += "target_link_libraries(verify PRIVATE lexican)\n";
  return text;
}

bool write_project(const BuildDirectory& directory, const gen::Output& output, const gen::Options& gen,
                   const VerifyOptions& options) {
  const char* const ending = gen.language == gen::Language::cpp ? "cpp" : "c";
  return write_output(directory / "CMakeLists.txt", project_text(output, gen, options)) == clean &&
         write_output(directory / output.files.at(0).name, output.files.at(0).bytes) == clean &&
         write_output(directory / output.files.at(1).name, output.files.at(1).bytes) == clean &&
         write_output(directory / fmt::format("verify.{}", ending), output.verify) == clean;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Calls a function with each line of a text.
template <typename Function>
void for_lines(const std::string& text, Function function) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    function(text.substr(at, end - at));
    at = end + 1;
  }
}

// Prints the settings that the #pragma messages of the compiler report; else its errors; else the complete log.
void complain_of_build(const std::string& log) {
  constexpr const char* mark = "verify: the description has ";
  std::vector<std::string> refusals;
  std::vector<std::string> errors;
  for_lines(log, [&](const std::string& line) {
    const std::size_t at = line.find(mark);
    if (at != std::string::npos && line.find("pragma message: ") != std::string::npos) {
      const std::string refusal = line.substr(at, line.find_last_not_of("'\"\xE2\x80\x99") + 1 - at);
      if (std::find(refusals.begin(), refusals.end(), refusal) == refusals.end()) {
        refusals.push_back(refusal);
      }
    }
    if (line.find("error") != std::string::npos || line.find("Error") != std::string::npos ||
        line.find("undefined reference") != std::string::npos) {
      errors.push_back(line);
    }
  });
  for (const std::string& refusal : refusals) {
    print_message(refusal + " (-D with --verify, co_cfg.h)");
  }
  if (!refusals.empty()) {
    return;
  }
  print_message("verify: the dictionary, or the stack, does not compile:");
  constexpr std::size_t most = 20;
  for (std::size_t n = 0; n < std::min(errors.size(), most); ++n) {
    print_message(errors[n]);
  }
  if (errors.empty()) {
    for_lines(log, [](const std::string& line) { print_message(line); });
  }
}

// Runs a command of the shell and writes its output to a log file.
bool run_logged(const std::string& command, const std::string& log) {
  return std::system(fmt::format("{} >{} 2>&1", command, quoted(log)).c_str()) == 0;
}

bool build(const BuildDirectory& directory) {
  const std::string log = directory / "log";
  const std::string where = quoted(directory / "build");
  const unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  const std::string steps[] = {
      fmt::format("cmake -S {} -B {}", quoted(directory.path()), where),
      fmt::format("cmake --build {} --target requirements", where),
      fmt::format("cmake --build {} --target verify --parallel {}", where, jobs),
  };
  for (const std::string& step : steps) {
    if (!run_logged(step, log)) {
      complain_of_build(text_of(log));
      return false;
    }
  }
  return true;
}

bool is_definition(const std::string& definition) {
  const std::size_t end = std::min(definition.find('='), definition.size());
  return end != 0 &&
         definition.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_") >= end;
}

}  // namespace

void add_verify(Arguments& command, VerifyOptions& options) {
  command.add_flag("--verify", options.is_wanted,
                   "Compile the dictionary with the stack and start a node; status 1 if the stack reports an error");
  command.add_option("--stack", options.stack, "With --verify: directory with the sources of Lexican");
  command.add_option("--preset", options.preset, "With --verify: configuration of the stack: minimal, slave, full")
      .default_text(options.preset);
  command.add_option("-D,--define", options.definitions, "With --verify: setting of the stack: CO_RPDO_N=8")
      .single_values();
  command.add_option("--build-dir", options.build_directory,
                     "With --verify: directory for the compiled stack; default: it is compiled each time");
}

bool check_verify(const VerifyOptions& options) {
  if (!options.is_wanted) {
    return true;
  }
  if (options.stack.empty()) {
    print_message("--verify needs the sources of the stack; give their directory, --stack DIR");
    return false;
  }
  const std::string preset = options.stack + "/config/presets/" + options.preset + ".h";
  if (!std::filesystem::exists(options.stack + "/include/co_core.h")) {
    print_message(options.stack + ": no sources of Lexican (include/co_core.h is missing)");
    return false;
  }
  if (options.preset.find('/') != std::string::npos || !std::filesystem::exists(preset)) {
    print_message(fmt::format("--preset {}: no such file: {}", options.preset, preset));
    return false;
  }
  const auto wrong = std::find_if_not(options.definitions.begin(), options.definitions.end(), is_definition);
  if (wrong != options.definitions.end()) {
    print_message(fmt::format("-D {}: not of the form NAME=VALUE", *wrong));
    return false;
  }
  return true;
}

Status verify(const gen::Output& output, const gen::Options& gen, const VerifyOptions& options) {
  const BuildDirectory directory(options.build_directory);
  if (directory.path().empty() || !write_project(directory, output, gen, options)) {
    print_message("verify: the build directory cannot be written");
    return unusable;
  }
  if (!build(directory)) {
    return found;
  }
  const std::string log = directory / "log";
  const bool is_right = run_logged(quoted(directory / "build/verify"), log);
  for_lines(text_of(log), [](const std::string& line) { print_message(line); });
  return is_right ? clean : found;
}

}  // namespace lexican::codict::cli
