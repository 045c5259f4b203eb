// SPDX-License-Identifier: Apache-2.0
// lexican top: a screen with the nodes of a bus, the values of their PDOs, and the events.
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "program/actions.hpp"
#include "program/command_words.hpp"
#include "program/identity.hpp"
#include "program/terminal.hpp"
#include "program/watched_bus.hpp"

namespace lexican::program {
namespace {

constexpr Micros shortest_between_screens = 100 * millisecond;
constexpr Micros longest_between_screens = second;  // ages change
constexpr Micros longest_receiving = 20 * millisecond;
constexpr std::size_t nodes_in_page = 5;
constexpr std::size_t help_lines_in_page = 5;
constexpr std::size_t most_input = 200;
constexpr std::uint32_t transfer_timeout = 1000;  // ms
constexpr std::uint32_t state_timeout = 2000;
constexpr std::uint32_t scan_timeout = 80;

/// Returns the bus of -i, else of LEXICAN_BUS.
std::string bus_name(const Common& common) {
  const char* const usual = std::getenv("LEXICAN_BUS");
  return !common.bus.empty() ? common.bus : usual != nullptr ? usual : "";
}

class Top;

/// Draws the screen and reads the keys while nodes wait.
class TopHost : public BusHost {
 public:
  TopHost(host_bus::Bus& bus, const Interruption& interruption, Top& top) : BusHost(bus, interruption), top_(top) {}
  void wait(Micros time) override;
  bool is_cancelled() const override;

 protected:
  int further_descriptor() const override { return STDIN_FILENO; }

 private:
  Top& top_;
};

class Top : public Console {
 public:
  Top(const Common& common, host_bus::Bus& bus, describe::Network& network, const Interruption& interruption,
      Terminal& terminal)
      : common_(common),
        network_(network),
        described_(network),
        terminal_(terminal),
        state_(network,
               [this](std::uint8_t node, const describe::Identity& identity) { return learn(node, identity); }),
        bus_(bus, [this](const host_bus::Entry& entry) { process(entry); }),
        host_(bus_, interruption, *this) {
    view_.bus = printable(bus_name(common));
    view_.has_unicode = terminal.has_unicode();
    for (std::uint8_t node = 1; node < 128; ++node) {
      set_name(node);
    }
    advance();
  }

  int run() {
    while (!Interruption::happened() && !is_ended_ && !is_closed_) {
      const bool has_more = receive();
      if (bus_.wanted().fd < 0 && bus_.log() == nullptr) {
        lost_.reopen(bus_);
      }
      update();
      run_command();
      host_.wait(has_more ? 0 : lost_.is_lost() ? std::min(time_to_screen(), reopen_interval) : time_to_screen());
    }
    return Interruption::happened() || is_closed_ ? interrupted : ok;
  }

  /// Messages outside of a command are events.
  void show(const std::string& text) override {
    is_changed_ = true;
    if (is_running_) {
      view_.result += text;
    } else {
      state_.note(text.substr(0, text.find_last_not_of('\n') + 1), false);
    }
  }

  bool confirm(const std::string& question) override {
    answer_.reset();
    is_asking_ = true;
    view_.prompt = printable(question) + " [y/N]";
    view_.input.clear();
    is_changed_ = true;
    while (!answer_ && !host_.interrupted()) {
      receive();
      host_.wait(time_to_screen());
    }
    is_asking_ = false;
    view_.prompt.clear();
    return answer_.value_or(false);
  }

  Micros time_to_screen() const {
    const Micros due = drawn_ + (is_changed_ ? shortest_between_screens : longest_between_screens);
    const Micros now = host_bus::clock_now(CLOCK_MONOTONIC);
    return due > now ? due - now : 0;
  }

  /// Processes keys, and draws the screen if it is time.
  void update() {
    while (const std::uint32_t key = terminal_.key()) {
      process_key(key);
      is_changed_ = true;
    }
    if (time_to_screen() == 0) {
      draw_screen();
    }
  }

  bool is_cancelled() const { return is_cancelled_; }
  /// Ends the program, because the terminal is closed.
  void end() {
    is_closed_ = true;
    is_cancelled_ = true;
  }

 private:
  bool learn(std::uint8_t node, const describe::Identity& identity) {
    const bool is_new = described_.describe(node, identity);
    if (is_new) {
      set_name(node);
    }
    return is_new;
  }

  /// Names a node by its description.
  void set_name(std::uint8_t node) {
    const codict::Device* const device = network_.of(node).device();
    if (device != nullptr) {
      state_.set_name(node, printable(device->identity.product_name.text));
    }
  }

  void process(const host_bus::Entry& entry) {
    state_.process(entry);
    is_changed_ = true;
    if (is_running_ && time_to_screen() == 0) {  // a transfer of many frames does not wait
      update();
    }
  }

  void advance() {
    if (bus_.log() == nullptr) {
      state_.advance(host_bus::clock_now(CLOCK_REALTIME));
    }
  }

  /// \retval true  there may be further frames
  bool receive() {
    const Micros begin = host_bus::clock_now(CLOCK_MONOTONIC);
    while (bus_.receive()) {
      if (Interruption::happened() || host_bus::clock_now(CLOCK_MONOTONIC) - begin >= longest_receiving) {
        return true;
      }
    }
    advance();
    return false;
  }

  void draw_screen() {
    advance();
    view_.bit_rate = common_.rate.empty() ? bus_.bit_rate() : bit_rate_of(common_.rate);
    view_.lost = bus_.lost();
    view_.condition = printable(!bus_.fault().empty() ? bus_.fault() : bus_.refusal());
    View view = view_;
    if (is_running_ && !is_asking_ && view.result.empty()) {
      view.result = is_cancelled_ ? "is cancelled" : "runs; Esc cancels it, q quits";
    }
    const Screen screen = draw(state_, view, terminal_.columns(), terminal_.rows());
    view_.help_line = screen.help_line;
    terminal_.show(screen);
    drawn_ = host_bus::clock_now(CLOCK_MONOTONIC);
    is_changed_ = false;
  }

  void process_key(std::uint32_t key) {
    if (key == resize_key) {
      return;
    }
    if (is_asking_) {
      answer_ = key == 'y' || key == 'Y';
    } else if (is_running_ || command_key_ != '\0') {
      is_ended_ = is_ended_ || key == 'q';
      is_cancelled_ = is_cancelled_ || is_ended_ || key == escape_key;
      select(key);
    } else if (!view_.prompt.empty()) {
      edit(key);
    } else if (view_.has_help) {
      view_.has_help = scroll_help(key);
    } else if (!select(key)) {
      begin_command(key);
    }
  }

  /// \retval true  the key scrolls the help; the next screen limits the line
  bool scroll_help(std::uint32_t key) {
    std::size_t& line = view_.help_line;
    switch (key) {
      case up_key: line -= std::min<std::size_t>(line, 1); return true;
      case down_key: ++line; return true;
      case page_up_key: line -= std::min(line, help_lines_in_page); return true;
      case page_down_key: line += help_lines_in_page; return true;
      default: return false;
    }
  }

  /// \retval true  the key selects a node, or values
  bool select(std::uint32_t key) {
    const std::vector<std::uint8_t> heard = state_.heard();
    const std::uint8_t selected = selected_node(heard, view_.selected);
    const auto at = static_cast<std::size_t>(std::find(heard.begin(), heard.end(), selected) - heard.begin());
    const auto go_to = [&](std::size_t position) {
      view_.selected = heard.empty() ? std::uint8_t{0} : heard[std::min(position, heard.size() - 1)];
      view_.first_value = 0;
    };
    const std::size_t most = selected == 0 ? 0 : state_.node(selected).values.size();
    switch (key) {
      case up_key: go_to(at > 0 ? at - 1 : 0); return true;
      case down_key: go_to(at + 1); return true;
      case page_up_key: go_to(at > nodes_in_page ? at - nodes_in_page : 0); return true;
      case page_down_key: go_to(at + nodes_in_page); return true;
      case left_key: view_.first_value -= std::min(view_.first_value, nodes_in_page); return true;
      case right_key: view_.first_value = std::min(view_.first_value + nodes_in_page, most); return true;
      default: return false;
    }
  }

  void begin_command(std::uint32_t key) {
    const std::uint8_t node = selected_node(state_.heard(), view_.selected);
    view_.selected = node;  // it remains selected when others are heard
    const bool has_node = node != 0;
    switch (key) {
      case 'q': is_ended_ = true; break;
      case '?':
        view_.has_help = true;
        view_.help_line = 0;
        break;
      case 's': request('s'); break;
      case '/': ask('/', "filter:", view_.filter); break;
      case 'n': ask('n', has_node ? fmt::format("NMT command for node {}:", node) : "NMT command and node:"); break;
      case 'r':
      case 'w':
        if (!has_node) {
          view_.result = "no node was heard; s scans";
        } else if (key == 'r') {
          ask('r', fmt::format("read from node {}, object:", node));
        } else {
          ask('w', fmt::format("write to node {}, object and value:", node));
        }
        break;
      default: break;
    }
  }

  /// Lets run_command() run the command of a key. Until its end, further keys only cancel it, quit, or select.
  void request(char key) {
    command_key_ = key;
    is_cancelled_ = false;
  }

  void ask(char key, const std::string& prompt, const std::string& input = {}) {
    prompt_key_ = key;
    view_.prompt = prompt;
    view_.input = input;
  }

  void edit(std::uint32_t key) {
    if (key == escape_key) {
      view_.prompt.clear();
    } else if (key == enter_key) {
      view_.prompt.clear();
      inputs_[prompt_key_] = view_.input;
      if (prompt_key_ == '/') {
        view_.filter = view_.input;
      } else if (!view_.input.empty()) {
        request(prompt_key_);
      }
    } else if (key == up_key) {
      view_.input = inputs_[prompt_key_];
    } else if (key == 0x15) {  // Ctrl-U
      view_.input.clear();
    } else if (key == backspace_key) {
      erase_last_character(view_.input);
    } else if (key >= 0x20 && key < first_special_key && view_.input.size() < most_input) {
      const std::string character = utf8_of(key);
      view_.input += printable(character) == character ? character : std::string();
    }
  }

  /// Runs the command of a key.
  void run_command() {
    const char key = std::exchange(command_key_, '\0');
    if (key == '\0' || is_ended_) {
      return;
    }
    is_running_ = true;
    view_.result.clear();
    view_.is_result_fault = false;
    CommandWords words = key == 's' ? CommandWords() : words_of(view_.input);
    words.common = common_;
    words.common.eds.clear();  // the network has them
    int status = usage;
    if (bus_.log() != nullptr) {
      print_message("this is a log; nothing can be sent");
    } else if (!words.fault.empty()) {
      print_message(words.fault);
    } else {
      status = key == 'r' ? read(words) : key == 'w' ? write(words) : key == 'n' ? change_state(words) : scan();
    }
    view_.is_result_fault = status != ok;
    update();  // keys that were typed meanwhile start no command
    is_running_ = false;
    is_cancelled_ = false;
    is_changed_ = true;
  }

  /// Shows the command line that has the same effect. \a words: of the verb; \a is_described: it uses descriptions.
  void show_command(std::vector<std::string> words, bool is_described) {
    words.insert(words.begin(), "lexican");
    const auto add = [&](const char* option, const std::string& value) {
      if (!value.empty()) {
        words.insert(words.end(), {option, value});
      }
    };
    add("-i", common_.bus);
    add("--rate", common_.rate);
    for (const std::string& file : is_described ? common_.eds : std::vector<std::string>()) {
      add("--eds", file);
    }
    view_.command = command_line(words);
  }

  int read(CommandWords& words) {
    ReadOptions options;
    fill(options, words);
    options.object = joined(words.words);
    std::vector<std::string> line = {"read", *options.node, *options.object};
    line.insert(line.end(), words.options.begin(), words.options.end());
    show_command(std::move(line), true);
    Target target;
    target.network = network_;
    if (!prepare(options, target)) {
      return usage;
    }
    Session session(bus_, host_, target.node);
    return read_object(session, options, target);
  }

  int write(CommandWords& words) {
    WriteOptions options;
    fill(options, words);
    if (words.words.size() < 2) {
      print_message("give object and value, such as 1017 500");
      return usage;
    }
    options.value = words.words.back();
    words.words.pop_back();
    options.object = joined(words.words);
    options.verifies = words.verifies;
    options.is_forced = words.is_forced;
    std::vector<std::string> line = {"write", *options.node, *options.object, *options.value};
    line.insert(line.end(), words.options.begin(), words.options.end());
    show_command(std::move(line), true);
    Target target;
    target.network = network_;
    if (!prepare(options, target)) {
      return usage;
    }
    Session session(bus_, host_, target.node);
    return write_object(session, options, target, std::nullopt);
  }

  void fill(TransferOptions& options, const CommandWords& words) const {
    options.common = words.common;
    options.common.timeout = transfer_timeout;
    options.node = std::to_string(view_.selected);
    options.type = words.type;
  }

  int change_state(const CommandWords& words) {
    if (words.words.size() > 2 || words.words.empty() || !words.options.empty()) {
      print_message("give a command and one node-ID, such as start 5");
      return usage;
    }
    NmtOptions options;
    options.common = words.common;
    options.common.timeout = state_timeout;
    options.command = words.words.front();
    const bool has_selected = view_.selected != 0;
    options.node = words.words.size() > 1 ? std::optional(words.words[1])
                   : has_selected         ? std::optional(std::to_string(view_.selected))
                                          : std::nullopt;
    show_command({"nmt", options.command, options.node.value_or("NODE")}, false);
    const std::optional<StateCommand> command = state_command(options);
    if (!command) {
      return usage;
    }
    const int agreed = agree(bus_, options, *command);
    if (agreed != ok) {
      return agreed;
    }
    Session session(bus_, host_, command->node == 0 ? std::uint8_t{127} : command->node);
    return program::change_state(session, options, *command);
  }

  int scan() {
    show_command({"scan"}, false);
    HostLine line(host_);
    const Micros begin = host_.now();
    const std::uint64_t bits = host_.bits();
    const Devices found = find_devices(host_, line, scan_timeout);
    if (host_.interrupted()) {
      print_message(bus_.fault().empty() ? "interrupted" : bus_.fault());
      return bus_.fault().empty() ? interrupted : bus_fault;
    }
    report_conflicts(found);
    if (found.devices.empty() && found.unconfigured.empty()) {
      return report_silence(bus_, line);
    }
    std::vector<std::string> nodes;
    for (const Device& device : found.devices) {
      nodes.push_back(std::to_string(device.found.node));
      if (!device.name.empty()) {
        state_.set_name(device.found.node, printable(device.name));
      }
    }
    print(summary_of(found, bus_, host_.bits() - bits, host_.now() - begin));
    print(nodes.empty() ? "" : fmt::format("node-IDs: {}\n", fmt::join(nodes, ", ")));
    return ok;
  }

  const Common& common_;
  describe::Network& network_;
  LibraryFiles described_;
  Terminal& terminal_;
  BusState state_;
  WatchedBus bus_;
  TopHost host_;
  LostBus lost_;
  View view_;
  std::map<char, std::string> inputs_;  ///< the last one of each key
  char prompt_key_ = '\0';
  char command_key_ = '\0';  ///< of the command that has to be run; 0: none
  bool is_running_ = false;
  bool is_asking_ = false;
  bool is_cancelled_ = false;
  bool is_ended_ = false;
  bool is_closed_ = false;  ///< the terminal
  std::optional<bool> answer_;
  bool is_changed_ = true;
  Micros drawn_ = 0;
};

void TopHost::wait(Micros time) {
  BusHost::wait(std::min(time, top_.time_to_screen()));
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (poll(&input, 1, 0) > 0 && (input.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) {
    top_.end();
  }
  top_.update();
}

bool TopHost::is_cancelled() const { return top_.is_cancelled(); }

int run_top(const Common& common) {
  std::string why = Terminal::fault();
  constexpr const char* remedy = "; lexican mon needs no screen";
  if (common.is_json) {
    why = "a screen is no JSON";
  }
  if (!why.empty()) {
    print_message(why + remedy);
    return usage;
  }
  describe::Network network;
  if (!read_descriptions(common, network)) {
    return usage;
  }
  int status = ok;
  const bool is_log = bus_name(common).rfind("replay:", 0) == 0;
  const std::unique_ptr<host_bus::Bus> bus = open_bus(common, is_log, status);
  if (bus == nullptr) {
    return status;
  }
  const Interruption interruption;
  const std::unique_ptr<Terminal> terminal = Terminal::open(why);
  if (terminal == nullptr) {
    print_message(why + remedy);
    return usage;
  }
  return Top(common, *bus, network, interruption, *terminal).run();
}

}  // namespace

Verb add_top(CommandLine& line) {
  const auto common = std::make_shared<Common>();
  Arguments arguments = line.add_command("top", "Show nodes, values and events of a bus on a live screen");
  add_bus_options(arguments, *common);
  add_eds_option(arguments, *common);
  arguments.end_help(
      "Examples:\n"
      "  lexican top -i can0\n"
      "  lexican top -i can0 --eds 5=drive.eds");
  return {arguments, [common] { return finish(*common, run_top(*common)); }};
}

}  // namespace lexican::program
