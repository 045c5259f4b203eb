// SPDX-License-Identifier: Apache-2.0
/// \file verb.hpp
/// Declarations that all verbs share. A verb is a file and a row of the table in main.cpp.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/open.hpp"
#include "cli/arguments.hpp"
#include "describe/description.hpp"
#include "host/interruption.hpp"
#include "program/printable.hpp"

namespace lexican::program {

using codict::cli::Arguments;
using codict::cli::CommandLine;

/// Exit status of the program.
enum Status : int {
  ok = 0,
  refused = 1,    ///< the device has refused a request, or differs
  usage = 2,      ///< wrong use, or a file cannot be used
  no_answer = 3,  ///< of the device, or nothing on the bus
  bus_fault = 4,  ///< the bus cannot be opened, or is lost
  interrupted = 130,
};

struct Verb {
  Arguments arguments;
  std::function<int()> run;
};

Verb add_apply(CommandLine& line);
Verb add_completion(CommandLine& line);
Verb add_dump(CommandLine& line);
Verb add_help(CommandLine& line);
Verb add_lss(CommandLine& line);
Verb add_man(CommandLine& line);
Verb add_mon(CommandLine& line);
Verb add_nmt(CommandLine& line);
Verb add_pdo(CommandLine& line);
Verb add_read(CommandLine& line);
Verb add_scan(CommandLine& line);
Verb add_share(CommandLine& line);
Verb add_sim(CommandLine& line);
Verb add_top(CommandLine& line);
Verb add_why(CommandLine& line);
Verb add_write(CommandLine& line);

/// Options that several verbs have. The texts are checked when they are used.
struct Common {
  std::string bus;               ///< -i, else $LEXICAN_BUS
  std::string rate;              ///< --rate: 500k, 1M or 500000
  std::vector<std::string> eds;  ///< --eds
  std::uint32_t timeout = 0;     ///< --timeout, ms
  bool has_timeout = false;      ///< --timeout is given
  bool is_json = false;          ///< --json
  bool is_sure = false;          ///< --yes
  std::string node;              ///< -n, instead of the first positional argument
  bool acknowledges = false;     ///< --ack, of a verb that listens only
};

/// Adds -i, --rate, --yes and --json.
void add_bus_options(Arguments& arguments, Common& common);
void add_eds_option(Arguments& arguments, Common& common);
/// Adds -n, for a verb whose positional argument is the node.
void add_node_option(Arguments& arguments, Common& common);
/// Moves the positional arguments one further if -n has the node, so that the first one is the node in each case.
/// Prints the reason if that fails. \a words: those that the verb needs, the node first.
/// \retval false  the node is given twice, and differs; or an argument is missing
bool place_node(const Common& common, const std::vector<std::optional<std::string>*>& words);
/// Adds --timeout. \a time: the default in ms.
void add_timeout_option(Arguments& arguments, Common& common, std::uint32_t time);
/// Extends the default of --timeout on a slow bus, where a block of 127 segments takes longer.
void extend_timeout(Common& common, const host_bus::Bus& bus);

/// Opens the bus of -i. The bit rate of an adapter without --rate and @RATE is found by listening. Prints the reason if
/// that fails, and sets \a status.
std::unique_ptr<host_bus::Bus> open_bus(const Common& common, bool listens_only, int& status);
/// Time after which restore() of a lost bus is tried again, µs.
constexpr host_bus::Micros reopen_interval = 500'000;
/// Opens a lost bus again, and prints when it is lost and when it is back.
class LostBus {
 public:
  /// Tries to open the bus, at most each reopen_interval.
  void reopen(host_bus::Bus& bus);
  bool is_lost() const { return is_lost_; }

 private:
  bool is_lost_ = false;
  host_bus::Micros last_ = 0;
};

/// Reads the descriptions of --eds. Prints the reason if that fails.
bool read_descriptions(const Common& common, describe::Network& network);

/// Converts 500k, 1M or 500000 to bit/s; 0: it is no bit rate.
std::uint32_t bit_rate_of(std::string_view text);

/// Converts a node-ID, 1 to 127; 0: it is none.
std::uint8_t node_of(std::string_view text);
/// Returns true if all texts are node-IDs; prints the first one that is none.
bool are_nodes(const std::vector<std::string>& texts);

/// Asks on the terminal, or on the Console. An Interruption must exist, and ends the question.
/// \retval true   the answer is yes
/// \retval false  it is another, or Interruption::happened()
bool is_confirmed(const std::string& question);

/// Asks whether a command may change a physical bus, unless --yes says so. An Interruption must exist. \a command: for
/// the question.
/// \retval status  ok: it may; else nothing was sent, and the reason is printed
int agree(const host_bus::Bus& bus, const Common& common, const std::string& command);

/// Shows output and questions of verbs on a screen during its lifetime, instead of on the standard streams. One
/// instance at a time.
class Console {
 public:
  Console();
  virtual ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// Shows printable text with its line ends.
  virtual void show(const std::string& text) = 0;
  /// Asks a question. \retval true  the answer is yes
  virtual bool confirm(const std::string& question) = 0;
};

/// Prints "lexican: text" on the standard error output, control characters as question marks: why the verb fails, or a
/// remedy.
void print_message(std::string_view text);
/// Like print_message(), for what is no fault of the verb.
void print_note(std::string_view text);
/// Ends a verb. With --json and a status that is not 0, prints {"error": TEXT, "status": STATUS}; the text is that of
/// the messages.
/// \retval status
int finish(const Common& common, int status);
/// Prints on the standard output, control characters but line ends as question marks.
void print(std::string_view text);
/// Prints a line in red.
void print_red(std::string_view line);
/// Returns true if the standard error output is a terminal on which progress is shown.
bool shows_progress();
/// Returns true if the standard output is a terminal on which colours are wanted.
bool has_colour();

}  // namespace lexican::program
