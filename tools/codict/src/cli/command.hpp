// SPDX-License-Identifier: Apache-2.0
/// \file command.hpp
/// Declarations that all commands share. Each command is a file and an entry of the table in main.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalogue/suppress.hpp"
#include "cli/arguments.hpp"
#include "cli/json.hpp"
#include "json/input.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"
#include "text/source.hpp"

namespace lexican::codict::cli {

/// Exit status of the program.
enum Status : int {
  clean = 0,
  found = 1,       ///< findings or differences were found
  unusable = 2,    ///< wrong use, or input that cannot be read
  unexpected = 3,  ///< internal error of the program
};

struct Command {
  Arguments arguments;
  std::function<int()> run;
};

Command add_check(CommandLine& line);
Command add_completion(CommandLine& line);
Command add_convert(CommandLine& line);
Command add_diff(CommandLine& line);
Command add_doc(CommandLine& line);
Command add_explain(CommandLine& line);
Command add_gen(CommandLine& line);
Command add_get(CommandLine& line);
Command add_info(CommandLine& line);
Command add_list(CommandLine& line);
Command add_man(CommandLine& line);
Command add_merge(CommandLine& line);
Command add_network(CommandLine& line);
Command add_new(CommandLine& line);
Command add_fmt(CommandLine& line);
Command add_pdo(CommandLine& line);
Command add_set(CommandLine& line);
Command add_size(CommandLine& line);

/// Reads a description. Prints the reason on the standard error output if that fails.
std::optional<Input> load(const std::string& path);
/// Like load(), for commands that do not show the findings of the reader: prints only where it stopped reading.
std::optional<Input> open(const std::string& path);
/// Adds the findings of the checks, sorted by place, without those that comments in the description suppress.
void check_all(Input& input);

/// Removes the findings that comments in the description suppress, and sorts the others.
void suppress(const Input& input, catalogue::Origin origin, Findings& findings);

/// Returns the message for an unknown word, with similar words of the list, else with the command that lists all words.
std::string unknown_word_message(std::string_view what, std::string_view word,
                                 const std::vector<std::string_view>& words, std::string_view catalogue);
/// Returns the message for an unknown rule.
std::string unknown_rule(const std::string& id);

/// Prints "codict: text" on the standard error output, control characters as question marks.
void print_message(std::string_view text);
/// Returns true if the standard output is a terminal.
bool is_terminal();
/// Prints on the standard output.
void print(std::string_view text);
std::string to_text(const Json& json);
void print_json(const Json& json);

/// Object or sub-object in an argument: "0x2000:1", "2000:1", "2000sub1", "0x2000".
struct Reference {
  std::uint16_t index = 0;
  std::optional<std::uint8_t> sub_index;
};
bool parse_reference(std::string_view text, Reference& reference);
/// Returns "2000:01" or "2000".
std::string to_string(const Reference& reference);

/// Returns the entry of a sub-object, or of the object if there is no sub-index; null if it is missing.
const Entry* find(const Device& device, const Reference& reference);

/// Help text for the argument FILE of all commands that read a description.
constexpr const char* file_help = "EDS, DCF, XDD, XDC, XPD or JSON, - for the standard input";

/// Adds the option --node-id; node_id is 0 if it is not given.
void add_node_id(Arguments& command, std::uint8_t& node_id);
/// Returns the node-ID of the option, else that of the commissioning, else 1.
std::uint8_t node_id_of(const Device& device, std::uint8_t asked);

/// Returns the name of a data type in CiA 301, else its number.
std::string type_name(const Entry& entry);

}  // namespace lexican::codict::cli
