// SPDX-License-Identifier: Apache-2.0
/// \file arguments.hpp
/// Commands, options and positional arguments of the program. arguments.cpp implements them with CLI11, which takes
/// ten seconds to compile; no other file includes it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lexican::codict::cli {

struct Grammar;  // defined in arguments.cpp, contains the objects of CLI11

/// Handle of an option ("-o,--output") or positional argument ("file"). Copies refer to the same option.
class Option {
 public:
  Option(Grammar& grammar, CLI::Option& option) : grammar_(&grammar), option_(&option) {}

  Option required();
  /// Rejects values that are not in the list.
  Option one_of(std::vector<std::string> words);
  /// Sets the words that completion offers; a word that ends with a colon is the beginning of a value. Other values are
  /// allowed.
  Option suggest(std::vector<std::string> words);
  /// Rejects numbers outside the range and shows the range in the help.
  Option in_range(std::uint32_t least, std::uint32_t most);
  /// Rejects numbers outside the range; the help does not show it.
  Option in_hidden_range(std::uint32_t least, std::uint32_t most);
  /// Rejects a value if the function returns a message.
  Option check(std::function<std::string(const std::string&)> fault_of);
  Option excludes(Option other);
  /// Sets the default value in the help.
  Option default_text(const std::string& text);
  /// Limits an option with a list of values to one value per occurrence of its name.
  Option single_values();

 private:
  Grammar* grammar_;
  CLI::Option* option_;
};

/// Words of an option and the values that they set.
template <typename T>
using Choices = std::vector<std::pair<std::string, T>>;

/// Handle of a command. Options write the variables that they are given, which have to outlive the parsing.
class Arguments {
 public:
  Arguments(Grammar& grammar, CLI::App& app) : grammar_(&grammar), app_(&app) {}

  /// Name of the command.
  const std::string& name() const;
  Option add_option(const std::string& names, std::string& value, const std::string& help);
  /// \a value: nothing unless the option is given; its text may be empty.
  Option add_option(const std::string& names, std::optional<std::string>& value, const std::string& help);
  Option add_option(const std::string& names, std::vector<std::string>& values, const std::string& help);
  Option add_option(const std::string& names, std::uint8_t& value, const std::string& help);
  Option add_option(const std::string& names, std::uint16_t& value, const std::string& help);
  Option add_option(const std::string& names, std::uint32_t& value, const std::string& help);
  Option add_option(const std::string& names, std::uint64_t& value, const std::string& help);
  Option add_flag(const std::string& names, bool& value, const std::string& help);
  /// Sets the text at the end of the help.
  void end_help(const std::string& text);

  /// Option with one of a few words.
  template <typename T>
  Option add_choice(const std::string& names, T& value, const Choices<T>& choices, const std::string& help) {
    return add_choice(names, words_of(choices), help, [&value, choices](const std::vector<std::size_t>& chosen) {
      value = choices[chosen.back()].second;
    });
  }
  /// Option with some of a few words: it may be given several times, and the words may be separated by commas.
  template <typename T>
  Option add_choices(const std::string& names, std::vector<T>& values, const Choices<T>& choices,
                     const std::string& help) {
    return add_choices(names, words_of(choices), help, [&values, choices](const std::vector<std::size_t>& chosen) {
      for (const std::size_t number : chosen) {
        values.push_back(choices[number].second);
      }
    });
  }

 private:
  /// Receives the positions of the given words in the list.
  using Choose = std::function<void(const std::vector<std::size_t>&)>;

  template <typename T>
  static std::vector<std::string> words_of(const Choices<T>& choices) {
    std::vector<std::string> words;
    for (const auto& choice : choices) {
      words.push_back(choice.first);
    }
    return words;
  }
  Option add_choice(const std::string& names, std::vector<std::string> words, const std::string& help,
                    const Choose& choose);
  Option add_choices(const std::string& names, std::vector<std::string> words, const std::string& help,
                     const Choose& choose);

  Grammar* grammar_;
  CLI::App* app_;
};

/// Description of an option for completion and manual page.
struct OptionText {
  std::vector<std::string> short_names;  ///< "o"
  std::vector<std::string> long_names;   ///< "output"
  std::string name;                      ///< name of a positional argument, else empty
  std::string type;                      ///< "TEXT", empty if it is a flag
  std::string help;
  std::vector<std::string> words;  ///< values, or beginnings of values, for completion; empty if there is no list
  bool is_required = false;
};

/// Description of a command, or of the program itself.
struct CommandText {
  std::string name;
  std::string help;
  std::string footer;
  std::vector<OptionText> options;
};

/// Command line of the program.
class CommandLine {
 public:
  CommandLine(const std::string& name, const std::string& help, const std::string& version, const std::string& footer);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Arguments add_command(const std::string& name, const std::string& help);

  struct Parsed {
    std::string command;          ///< name of the command to run, else empty
    std::string unknown_command;  ///< first word if it is no command, else empty
    bool is_refused = false;      ///< the arguments have a fault, which has been printed
  };
  /// Parses the arguments. Prints help, version or the fault if the result has neither a command nor an unknown one.
  Parsed parse(int number, char** arguments);

  /// Describes the options of the program itself.
  CommandText describe() const;
  std::vector<CommandText> describe_commands() const;

 private:
  std::unique_ptr<Grammar> grammar_;
};

}  // namespace lexican::codict::cli
