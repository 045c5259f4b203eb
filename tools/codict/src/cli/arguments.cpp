// SPDX-License-Identifier: Apache-2.0
#include "cli/arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

namespace lexican::codict::cli {

struct Grammar {
  Grammar(const std::string& help, const std::string& name) : app(help, name) {}

  CLI::App app;
  std::map<const CLI::Option*, std::vector<std::string>> words;
};

namespace {

// Returns the positions of the given words in the list; one_of() has checked that it contains them.
std::vector<std::size_t> positions(const std::vector<std::string>& words, const std::vector<std::string>& given) {
  std::vector<std::size_t> result;
  result.reserve(given.size());
  for (const std::string& word : given) {
    result.push_back(static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin()));
  }
  return result;
}

// Returns the first word if it is neither a command nor an option, else nothing.
std::string unknown_command(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining();
  const bool has_none = app.get_subcommands().empty() && !words.empty();
  return has_none && words.front().substr(0, 1) != "-" ? words.front() : "";
}

// Returns the message for arguments that do not belong there, in their order: that of CLI11 has them in the reverse
// one.
std::string extras_text(const std::vector<std::string>& words) {
  std::string text =
      words.size() > 1 ? "The following arguments were not expected:" : "The following argument was not expected:";
  for (const std::string& word : words) {
    text += ' ' + word;
  }
  return text;
}

// Returns the message of a fault in the arguments, of which CLI11 writes some as sentences and some with a line end.
std::string usage_fault_text(const CLI::App* app, const CLI::Error& error) {
  const bool has_extras = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  std::string text = has_extras ? extras_text(app->remaining(true)) : error.what();
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) {
    text.pop_back();
  }
  const std::vector<CLI::App*> commands = app->get_subcommands();
  const std::string command = commands.empty() ? "" : ' ' + commands.front()->get_name();
  return app->get_name() + ": " + text + "; " + app->get_name() + command + " --help shows the options\n";
}

OptionText text_of(const Grammar& grammar, const CLI::Option& option) {
  OptionText text;
  text.short_names = option.get_snames();
  text.long_names = option.get_lnames();
  text.name = option.get_positional() ? option.get_name(true) : "";
  const std::string type = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
  text.type = type.substr(0, type.find(':'));
  text.help = option.get_description();
  const auto words = grammar.words.find(&option);
  text.words = words != grammar.words.end() ? words->second : std::vector<std::string>();
  text.is_required = option.get_required();
  return text;
}

CommandText text_of(const Grammar& grammar, const CLI::App& app) {
  CommandText text;
  text.name = app.get_name();
  text.help = app.get_description();
  text.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    text.options.push_back(text_of(grammar, *option));
  }
  return text;
}

}  // namespace

Option Option::required() {
  option_->required();
  return *this;
}

Option Option::one_of(std::vector<std::string> words) {
  grammar_->words[option_] = words;
  option_->check(CLI::IsMember(std::move(words)).description(""));
  return *this;
}

Option Option::suggest(std::vector<std::string> words) {
  grammar_->words[option_] = std::move(words);
  return *this;
}

Option Option::in_range(std::uint32_t least, std::uint32_t most) {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option Option::in_hidden_range(std::uint32_t least, std::uint32_t most) {
  option_->check(CLI::Range(least, most).description(""));
  return *this;
}

Option Option::check(std::function<std::string(const std::string&)> fault_of) {
  option_->check(std::move(fault_of));
  return *this;
}

Option Option::excludes(Option other) {
  option_->excludes(other.option_);
  return *this;
}

Option Option::default_text(const std::string& text) {
  option_->default_str(text);
  return *this;
}

Option Option::single_values() {
  option_->allow_extra_args(false);
  return *this;
}

const std::string& Arguments::name() const { return app_->get_name(); }

Option Arguments::add_option(const std::string& names, std::string& value, const std::string& help) {
  return {*grammar_, *app_->add_option(names, value, help)};
}

Option Arguments::add_option(const std::string& names, std::optional<std::string>& value, const std::string& help) {
  const auto set = [&value](const std::string& text) { value = text; };
  return {*grammar_, *app_->add_option_function<std::string>(names, set, help)};
}

Option Arguments::add_option(const std::string& names, std::vector<std::string>& values, const std::string& help) {
  return {*grammar_, *app_->add_option(names, values, help)};
}

Option Arguments::add_option(const std::string& names, std::uint8_t& value, const std::string& help) {
  return {*grammar_, *app_->add_option(names, value, help)};
}

Option Arguments::add_option(const std::string& names, std::uint16_t& value, const std::string& help) {
  return {*grammar_, *app_->add_option(names, value, help)};
}

Option Arguments::add_option(const std::string& names, std::uint32_t& value, const std::string& help) {
  return {*grammar_, *app_->add_option(names, value, help)};
}

Option Arguments::add_option(const std::string& names, std::uint64_t& value, const std::string& help) {
  return {*grammar_, *app_->add_option(names, value, help)};
}

Option Arguments::add_flag(const std::string& names, bool& value, const std::string& help) {
  return {*grammar_, *app_->add_flag(names, value, help)};
}

void Arguments::end_help(const std::string& text) { app_->footer(text); }

Option Arguments::add_choice(const std::string& names, std::vector<std::string> words, const std::string& help,
                             const Choose& choose) {
  const auto set = [words, choose](const std::string& word) { choose(positions(words, {word})); };
  Option option{*grammar_, *app_->add_option_function<std::string>(names, set, help)->type_name("ENUM")};
  return option.one_of(std::move(words));
}

Option Arguments::add_choices(const std::string& names, std::vector<std::string> words, const std::string& help,
                              const Choose& choose) {
  const auto set = [words, choose](const std::vector<std::string>& given) { choose(positions(words, given)); };
  Option option{
      *grammar_,
      *app_->add_option_function<std::vector<std::string>>(names, set, help)->type_name("ENUM")->delimiter(',')};
  return option.one_of(std::move(words)).single_values();
}

CommandLine::CommandLine(const std::string& name, const std::string& help, const std::string& version,
                         const std::string& footer)
    : grammar_(std::make_unique<Grammar>(help, name)) {
  grammar_->app.set_version_flag("--version", version);
  grammar_->app.require_subcommand(1);
  grammar_->app.footer(footer);
  grammar_->app.failure_message(usage_fault_text);
}

CommandLine::~CommandLine() = default;

Arguments CommandLine::add_command(const std::string& name, const std::string& help) {
  return {*grammar_, *grammar_->app.add_subcommand(name, help)};
}

CommandLine::Parsed CommandLine::parse(int number, char** arguments) {
  CLI::App& app = grammar_->app;
  Parsed parsed;
  try {
    app.parse(number, arguments);
    parsed.command = app.get_subcommands().front()->get_name();
  } catch (const CLI::ParseError& error) {
    parsed.unknown_command = unknown_command(app);
    parsed.is_refused = !parsed.unknown_command.empty() || app.exit(error) != 0;
  }
  return parsed;
}

CommandText CommandLine::describe() const { return text_of(*grammar_, grammar_->app); }

std::vector<CommandText> CommandLine::describe_commands() const {
  std::vector<CommandText> texts;
  for (const CLI::App* command : grammar_->app.get_subcommands([](const CLI::App*) { return true; })) {
    texts.push_back(text_of(*grammar_, *command));
  }
  return texts;
}

}  // namespace lexican::codict::cli
