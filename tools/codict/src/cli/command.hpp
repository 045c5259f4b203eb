// SPDX-License-Identifier: Apache-2.0
/// \file command.hpp
/// What the commands share: a file each, and a row in main.cpp.
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
#include "eds/document.hpp"
#include "json/document.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"
#include "text/source.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::cli {

/// What the program's exit status says.
enum Status : int {
  clean = 0,
  found = 1,       ///< findings, or differences
  unusable = 2,    ///< wrong use, or input that cannot be read
  unexpected = 3,  ///< a fault of the program
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

/// A description that has been read, with what its reader found.
struct Input {
  std::unique_ptr<const eds::Document> eds;  ///< one of them is not null
  std::unique_ptr<const xdd::Document> xdd;
  std::unique_ptr<const json::Document> json;
  Findings findings;
  Description description;

  const Source& source() const;
  Encoding encoding() const;
  const Device& device() const { return description.devices.front(); }
};

/// Why not is said on the standard error output.
std::optional<Input> load(const std::string& path);
/// The same for commands that do not show what the reader has found: they say at least where it could read no further.
std::optional<Input> open(const std::string& path);
/// The same for what is in memory already; without a result, why is one line.
std::optional<Input> read(Source source, std::string& why);

/// Adds what the checks find to what the reader has found, by place; without what comments suppress.
void check_all(Input& input);

/// Leaves out what comments of the description suppress; findings end up sorted.
void suppress(const Input& input, catalogue::Origin origin, Findings& findings);

/// That there is no such thing, and which ones may be meant, or what names them all.
std::string not_there(std::string_view what, std::string_view word, const std::vector<std::string_view>& words,
                      std::string_view catalogue);
/// The same of a rule.
std::string unknown_rule(const std::string& id);

/// "codict: text", on the standard error output; control characters are question marks.
void complain(std::string_view text);
/// Whether the standard output is one.
bool is_terminal();
/// To the standard output.
void print(std::string_view text);
std::string to_text(const Json& json);
void print_json(const Json& json);

/// "0x2000:1", "2000:1", "2000sub1", or without a sub-index; false if it is none of them.
struct Reference {
  std::uint16_t index = 0;
  std::optional<std::uint8_t> sub_index;
};
bool parse_reference(std::string_view text, Reference& reference);
/// "2000:01", "2000".
std::string to_string(const Reference& reference);

/// Null if there is none; an object without a sub-index is itself.
const Entry* find(const Device& device, const Reference& reference);

/// What the commands that read a description say of it in their help.
constexpr const char* file_help = "EDS, DCF, XDD, XDC, XPD or JSON, - for the standard input";

/// --node-id: 0 until the user says one.
void add_node_id(Arguments& command, std::uint8_t& node_id);
/// What the user says, else what the device is configured to, else 1.
std::uint8_t node_id_of(const Device& device, std::uint8_t asked);

/// What a data type is called: by CiA 301, or by its number.
std::string type_name(const Entry& entry);

}  // namespace lexican::codict::cli
