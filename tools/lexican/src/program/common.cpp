// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>

#include "bus/clock.hpp"
#include "program/rate.hpp"
#include "program/verb.hpp"

namespace lexican::program {

using host_bus::Micros;

namespace {

Console* console = nullptr;  // null: the standard streams are used

}  // namespace

Console::Console() { console = this; }
Console::~Console() { console = nullptr; }

void add_bus_options(Arguments& arguments, Common& common) {
  std::string kinds;
  std::vector<std::string> prefixes;
  for (const host_bus::BusKind& kind : host_bus::bus_kinds) {
    if (kind.prefix[0] != '\0') {
      prefixes.emplace_back(kind.prefix);
    }
    kinds += fmt::format("\n  {}: {}", kind.example, kind.about);
  }
  arguments.add_option("-i,--bus", common.bus, "Bus; default: $LEXICAN_BUS" + kinds).suggest(std::move(prefixes));
  arguments.add_option("--rate", common.rate, "Bit rate of an adapter, such as 500k; default: found by listening");
  arguments.add_flag("--yes", common.is_sure, "Do not ask before a command that can disturb a physical bus");
  arguments.add_flag("--json", common.is_json, "Print one JSON object in each line");
}

void add_eds_option(Arguments& arguments, Common& common) {
  arguments
      .add_option("--eds", common.eds,
                  "Description (EDS, DCF, XDD, XDC) as FILE, NODE=FILE or a directory; several are allowed")
      .single_values();
}

void add_node_option(Arguments& arguments, Common& common) {
  arguments.add_option("-n", common.node, "Node-ID, instead of the argument");
}

bool place_node(const Common& common, const std::vector<std::optional<std::string>*>& words) {
  if (!common.node.empty() && !words.back()->has_value()) {
    for (std::size_t n = words.size() - 1; n > 0; --n) {
      *words[n] = *words[n - 1];
    }
    *words.front() = common.node;
  } else if (!common.node.empty() && *words.front() != common.node) {
    print_message(
        fmt::format("'{}' and -n {} are different nodes; give one of them", words.front()->value_or(""), common.node));
    return false;
  }
  return true;
}

void add_timeout_option(Arguments& arguments, Common& common, std::uint32_t time) {
  common.timeout = time;
  arguments.add_option("--timeout", common.timeout, fmt::format("Time for each answer in ms; default: {}", time))
      .in_hidden_range(1, 3'600'000)
      .check([&common](const std::string&) {
        common.has_timeout = true;
        return std::string();
      });
}

void extend_timeout(Common& common, const host_bus::Bus& bus) {
  constexpr std::uint32_t slow = 50'000;              // bit/s
  constexpr std::uint32_t bits_of_block = 127 * 135;  // with as many stuff bits as possible
  const std::uint32_t rate = bus.bit_rate();
  if (!common.has_timeout && rate != 0 && rate < slow) {
    common.timeout += 2 * bits_of_block * 1000 / rate;  // other frames may take half of the bus
  }
}

namespace {

constexpr Micros time_at_rate = 150'000;  // of the first round of listening
constexpr unsigned listening_rounds = 3;  // 18 s

/// Finds the bit rate of an adapter that is opened to listen only, and sets rate and mode.
/// \retval status of the program
int find_rate(host_bus::Bus& bus, const Common& common, bool listens_only) {
  const Interruption interruption;
  if (isatty(STDERR_FILENO) != 0) {
    print_note("listening at each bit rate; --rate 500k gives it");
  }
  const auto listen = [&](bool acknowledges) {
    return listen_for_rate(bus, {0, true, acknowledges}, time_at_rate, listening_rounds, interruption);
  };
  HeardRate heard = listen(false);
  if (heard.is_refused && !common.is_sure) {
    print_message(
        bus.refusal() +
        ": it cannot listen only. Give its bit rate by --rate; or try each rate by --yes, which disturbs a bus "
        "with another rate");
    return usage;
  }
  if (heard.is_refused || (heard.bit_rate == 0 && common.acknowledges)) {
    heard = listen(true);
  }
  if (Interruption::happened()) {
    print_message("interrupted");
    return interrupted;
  }
  if (!bus.fault().empty()) {
    print_message(bus.fault());
    return bus_fault;
  }
  if (heard.bit_rate == 0) {
    print_message("no frame at any bit rate: give the rate, for example --rate 500k");
    print_message(
        "a bus without traffic cannot be heard, and frames of a device that is alone are not acknowledged: lexican mon "
        "--ack acknowledges them");
    return no_answer;
  }
  print_note(fmt::format("bit rate: {} kbit/s ({} valid {} in {:.1f} s)", heard.bit_rate / 1000, heard.frames,
                         heard.frames == 1 ? "frame" : "frames", static_cast<double>(heard.time) / 1e6));
  bus.configure({heard.bit_rate, listens_only, common.acknowledges});
  return ok;
}

}  // namespace

std::unique_ptr<host_bus::Bus> open_bus(const Common& common, bool listens_only, int& status) {
  const char* const usual = std::getenv("LEXICAN_BUS");
  const std::string name = !common.bus.empty() ? common.bus : usual != nullptr ? usual : "";
  host_bus::BusOptions options;
  options.listens_only = listens_only;
  options.acknowledges = common.acknowledges;
  options.bit_rate = bit_rate_of(common.rate);
  status = usage;
  if (name.empty()) {
    print_message("which bus? Give -i BUS, for example -i can0 or -i hub:bench, or set LEXICAN_BUS");
    return nullptr;
  }
  if (!common.rate.empty() && options.bit_rate == 0) {
    print_message("'" + common.rate + "' is no bit rate; write 500k, 1M or 500000");
    return nullptr;
  }
  const std::string fault = host_bus::rate_fault(name, options);
  if (!fault.empty()) {
    print_message(fault);
    return nullptr;
  }
  const bool is_unknown = host_bus::needs_rate(name, options);
  if (is_unknown) {
    options = {0, true, false};
  }
  std::string why;
  std::unique_ptr<host_bus::Bus> bus = host_bus::open_bus(name, options, why);
  status = host_bus::is_wrong_name(name, options) ? usage : bus_fault;
  if (bus == nullptr) {
    print_message(why);
    return nullptr;
  }
  if (!bus->note().empty()) {
    print_note(bus->note());
  }
  if (bus->log() != nullptr && !listens_only) {
    print_message(name + " is a log, which only lexican mon, why, pdo watch and top can use");
    status = usage;
    return nullptr;
  }
  if (!is_unknown && !bus->refusal().empty()) {
    const bool is_listening = listens_only && !common.acknowledges;
    print_message(bus->refusal() + (is_listening ? ": it cannot listen only; --ack acknowledges frames" : ""));
    return nullptr;
  }
  status = is_unknown ? find_rate(*bus, common, listens_only) : ok;
  return status == ok ? std::move(bus) : nullptr;
}

void LostBus::reopen(host_bus::Bus& bus) {
  if (!is_lost_) {
    print_note(bus.fault() + "; waiting for it");
    is_lost_ = true;
  }
  const Micros now = host_bus::clock_now(CLOCK_MONOTONIC);
  if (now - last_ < reopen_interval) {
    return;
  }
  last_ = now;
  if (bus.restore()) {
    print_note("the bus is back");
    is_lost_ = false;
  }
}

bool read_descriptions(const Common& common, describe::Network& network) {
  for (const std::string& file : common.eds) {
    std::string why;
    if (!network.add(file, why)) {
      print_message(why);
      return false;
    }
  }
  return true;
}

std::uint32_t bit_rate_of(std::string_view text) {
  std::uint32_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, number);
  const std::string_view unit(next, static_cast<std::size_t>(end - next));
  const std::uint32_t factor = unit.empty() ? 1 : unit == "k" || unit == "K" ? 1000 : unit == "M" ? 1'000'000 : 0;
  const bool is_rate = error == std::errc() && factor != 0 && number <= 1'000'000 / factor;
  return is_rate ? number * factor : 0;
}

std::uint8_t node_of(std::string_view text) {
  std::uint8_t node = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, node);
  return error == std::errc() && next == end && node <= 127 ? node : std::uint8_t{0};
}

bool are_nodes(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    if (node_of(text) == 0) {
      print_message("'" + text + "' is no node-ID, which is 1 to 127");
      return false;
    }
  }
  return true;
}

bool is_confirmed(const std::string& question) {
  if (console != nullptr) {
    return console->confirm(question);
  }
  fmt::print(stderr, "{} [y/N] ", question);
  sigset_t while_waiting;
  sigprocmask(SIG_BLOCK, nullptr, &while_waiting);
  sigdelset(&while_waiting, SIGINT);
  sigdelset(&while_waiting, SIGTERM);
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (ppoll(&input, 1, nullptr, &while_waiting) < 0 && !Interruption::happened()) {
  }
  if (Interruption::happened()) {
    fmt::print(stderr, "\n");
    return false;
  }
  char answer[16] = "";
  return std::fgets(answer, sizeof answer, stdin) != nullptr && (answer[0] == 'y' || answer[0] == 'Y');
}

int agree(const host_bus::Bus& bus, const Common& common, const std::string& command) {
  if (!bus.is_physical() || common.is_sure) {
    return ok;
  }
  if (isatty(STDIN_FILENO) == 0) {
    print_message("this command changes a physical bus: confirm it by --yes");
    return usage;
  }
  if (is_confirmed(command + " on a physical bus?")) {
    return ok;
  }
  print_message(Interruption::happened() ? "interrupted; nothing was sent" : "nothing was sent");
  return Interruption::happened() ? interrupted : usage;
}

namespace {

/// Messages of the verb, with line ends between them.
std::string& fault_messages() {
  static std::string text;
  return text;
}

const char* status_text(int status) {
  switch (status) {
    case refused: return "refused";
    case usage: return "wrong use";
    case no_answer: return "no frame was received";
    case bus_fault: return "bus fault";
    default: return "interrupted";
  }
}

}  // namespace

void print_message(std::string_view text) {
  print_note(text);
  if (console != nullptr) {
    return;
  }
  fault_messages() += (fault_messages().empty() ? "" : "\n") + std::string(text);
}

void print_note(std::string_view text) {
  if (console != nullptr) {
    console->show(printable(text) + '\n');
    return;
  }
  std::fflush(stdout);  // in one stream, the lines keep their order
  fmt::print(stderr, "lexican: {}\n", printable(text));
}

int finish(const Common& common, int status) {
  if (common.is_json && status != ok) {
    const std::string& text = fault_messages();
    const nlohmann::json json = {{"error", text.empty() ? status_text(status) : text}, {"status", status}};
    print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
  }
  return status;
}

void print(std::string_view text) {
  const std::string shown = printable(text);
  if (console != nullptr) {
    console->show(shown);
    return;
  }
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

void print_red(std::string_view line) { fmt::print("\033[31m{}\033[0m\n", printable(line)); }

bool shows_progress() { return console == nullptr && isatty(STDERR_FILENO) != 0; }

bool has_colour() { return isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr; }

}  // namespace lexican::program
