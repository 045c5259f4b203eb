// SPDX-License-Identifier: Apache-2.0
// lexican mon: shows in words what happens on a bus, or in a log.
#include <fmt/format.h>
#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <tuple>

#include "bus/clock.hpp"
#include "describe/monitor.hpp"
#include "describe/picture.hpp"
#include "describe/recorder_csv.hpp"
#include "explain/explainer.hpp"
#include "program/identity.hpp"
#include "program/verb.hpp"
#include "text/file.hpp"

namespace lexican::program {
namespace {

using describe::Event;
using describe::Service;
using host_bus::Entry;
using host_bus::Micros;

constexpr std::size_t most_identifiers = 20;  // in the statistics

struct MonOptions {
  Common common;
  std::string log;  ///< positional: a log instead of a bus
  std::vector<std::string> nodes;
  std::vector<Service> services;
  std::vector<std::string> objects;
  std::string record;  ///< --log
  std::string page;    ///< --html
  bool shows_all = false;
};

/// Returns the text of an event, with the duration of a transfer.
std::string text_of(const Event& event) {
  const bool has_duration = event.sdo != nullptr && event.sdo->time > event.sdo->begin;
  return event.text + (has_duration
                           ? fmt::format("  {:.1f} ms", static_cast<double>(event.sdo->time - event.sdo->begin) / 1000)
                           : "");
}

/// Prints events, as text or as JSON.
class Printer {
 public:
  explicit Printer(const MonOptions& options) : options_(options), has_colour_(program::has_colour()) {
    for (const std::string& node : options.nodes) {
      nodes_.insert(node_of(node));
    }
    services_.insert(options.services.begin(), options.services.end());
  }

  /// \retval false  the event is not wanted
  bool show(const Event& event) {
    if (first_ == 0) {
      first_ = event.time;
    }
    const bool wanted = is_wanted(event);
    if (wanted) {
      options_.common.is_json ? print_json(event) : print_text(event);
    }
    return wanted;
  }
  void begin_at(Micros time) { first_ = first_ == 0 ? time : first_; }
  /// Returns a time since the first frame in seconds.
  double seconds(Micros time) const { return static_cast<double>(since_first(time)) / 1e6; }
  Micros since_first(Micros time) const { return time < first_ ? 0 : time - first_; }

 private:
  bool is_wanted(const Event& event) const {
    return (options_.shows_all || !event.is_repeated || services_.count(event.service) != 0) &&
           (nodes_.empty() || nodes_.count(event.node) != 0 || is_to_all(event)) &&
           (services_.empty() || services_.count(event.service) != 0) && has_object(event);
  }

  static bool is_to_all(const Event& event) { return event.service == Service::nmt && event.node == 0; }

  bool has_object(const Event& event) const {
    return options_.objects.empty() ||
           std::any_of(options_.objects.begin(), options_.objects.end(),
                       [&](const std::string& word) { return contains_ignoring_case(event.text, word); });
  }

  void print_text(const Event& event) const {
    const std::string node = event.node == 0 ? "-" : std::to_string(event.node);
    const std::string line = fmt::format("{:9.3f} {:>3}  {}", seconds(event.time), node, text_of(event));
    if (has_colour_ && event.is_fault) {
      print_red(line);
    } else {
      print(line + '\n');
    }
  }

  void print_json(const Event& event) const {
    nlohmann::json json = {{"time", seconds(event.time)},
                           {"service", describe::service_names[static_cast<std::size_t>(event.service)]},
                           {"text", event.text}};
    if (event.node != 0) {
      json["node"] = event.node;
    }
    if (event.is_fault) {
      json["fault"] = true;
    }
    if (event.sdo != nullptr) {
      const describe::SdoTransfer& transfer = *event.sdo;
      std::string data;
      for (const std::uint8_t byte : transfer.data) {
        data += fmt::format("{:02X}", byte);
      }
      json["sdo"] = {{"index", transfer.index},
                     {"sub", transfer.sub_index},
                     {"write", transfer.is_download},
                     {"bytes", transfer.size},
                     {"data", data},
                     {"duration", static_cast<double>(transfer.time - transfer.begin) / 1e6}};
      if (transfer.abort_code != 0) {
        json["sdo"]["abort"] = transfer.abort_code;
      }
    }
    print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
  }

  const MonOptions& options_;
  bool has_colour_;
  std::set<unsigned> nodes_;
  std::set<Service> services_;
  Micros first_ = 0;
};

/// A file that records all frames (--log).
class Recorder {
 public:
  /// \retval false  the file cannot be written; the reason is printed
  bool open(const std::string& path) {
    std::ostringstream trial;
    if (host_bus::write_log(trial, path, "can0") == nullptr) {
      print_message(path + ": a log is written with the ending .log or .pcapng");
      return false;
    }
    file_.open(path, std::ios::binary);
    if (!file_) {
      print_message(path + " cannot be written");
      return false;
    }
    log_ = host_bus::write_log(file_, path, "can0");
    return true;
  }

  void write(const Entry& entry, std::uint64_t lost) {
    if (log_ == nullptr) {
      return;
    }
    if (lost > lost_) {
      log_->write_lost(entry.time, static_cast<std::uint32_t>(lost - lost_));
      lost_ = lost;
    }
    log_->write(entry);
  }

  /// \retval false  the file is not complete
  bool close() {
    file_.flush();
    return log_ == nullptr || file_.good();
  }

 private:
  std::ofstream file_;
  std::unique_ptr<host_bus::LogWriter> log_;
  std::uint64_t lost_ = 0;
};

/// Returns why a page cannot be written; empty: it can be.
std::string fault_of_page(const std::string& path) {
  const std::filesystem::path file(path);
  std::error_code unused;
  if (path == "-" || std::filesystem::is_directory(file, unused)) {
    return "--html needs the name of a file";
  }
  // A new file replaces an old one when it is complete.
  const std::string directory = file.has_parent_path() ? file.parent_path().string() : ".";
  const bool is_writable = access(directory.c_str(), W_OK | X_OK) == 0 &&
                           (access(path.c_str(), W_OK) == 0 || !std::filesystem::exists(file, unused));
  return is_writable ? "" : fmt::format("{} cannot be written: {}", path, std::strerror(errno));
}

/// Writes a page, and says what it leaves out.
int write_page(const std::string& path, const describe::Picture& picture, const describe::PictureHead& head,
               const std::vector<describe::Cause>& causes) {
  std::string why;
  if (codict::write_file(path, picture.page(head, causes), why) == codict::Written::no) {
    print_message(why);
    return usage;
  }
  for (const auto& [number, words, most] : {std::tuple{picture.omitted_lines(), "lines", picture.lines()},
                                            std::tuple{picture.omitted_values(), "values", picture.values()}}) {
    if (number != 0) {
      print_note(fmt::format("{} leaves out {} {} behind the first {}; -n, --service and --object show fewer", path,
                             number, words, most));
    }
  }
  return ok;
}

std::string identifier_text(std::uint32_t identifier) {
  const std::uint32_t number = identifier & CO_IF_FRM_ID;
  return fmt::format((identifier & CO_IF_FRM_EXT) != 0 ? "{:08X}h" : "{:03X}h", number) +
         ((identifier & CO_IF_FRM_RTR) != 0 ? " remote" : "");
}

class Mon {
 public:
  Mon(const MonOptions& options, describe::Network& network)
      : options_(options),
        network_(network),
        described_(network),
        printer_(options),
        monitor_(
            network, [this](const Event& event) { show(event); },
            [this](std::uint8_t node, const describe::Identity& identity) {
              return described_.describe(node, identity);
            }) {}

  int run(host_bus::Bus& bus) {
    const Interruption interruption;
    if (!options_.page.empty()) {
      explainer_.emplace(network_, rate_of(bus), [this](std::uint8_t node, const describe::Identity&) {
        return network_.of(node).device() != nullptr;  // described_ has described it
      });
    }
    while (!Interruption::happened()) {
      receive(bus);
      if (bus.wanted().fd < 0 && bus.log() != nullptr) {
        break;
      }
      if (bus.wanted().fd < 0) {
        lost_.reopen(bus);
      }
      std::fflush(stdout);
      wait(bus, interruption);
    }
    monitor_.finish();
    return finish(bus);
  }

  Recorder& recorder() { return recorder_; }

 private:
  void show(const Event& event) {
    if (!printer_.show(event) || options_.page.empty()) {
      return;
    }
    const Micros time = printer_.since_first(event.time);
    picture_.add_line(time, event, text_of(event));
    if (event.service == Service::pdo) {
      if (const std::optional<describe::PdoContent> content = monitor_.values_of(frame_)) {
        picture_.add_values(time, *content);
      }
    }
  }

  void receive(host_bus::Bus& bus) {
    while (const std::optional<Entry> entry = bus.receive()) {
      printer_.begin_at(entry->time);
      recorder_.write(*entry, bus.lost());
      if (!options_.page.empty()) {
        picture_.count(printer_.since_first(entry->time), entry->frame);
      }
      frame_ = entry->frame;
      monitor_.process(*entry);
      if (explainer_) {
        explainer_->process(*entry);
      }
      if (Interruption::happened()) {
        return;
      }
    }
    if (bus.log() == nullptr) {
      monitor_.expire(host_bus::clock_now(CLOCK_REALTIME));
    }
  }

  static void wait(host_bus::Bus& bus, const Interruption& interruption) {
    pollfd wanted = bus.wanted();
    constexpr timespec timeout{0, 200'000'000};
    ppoll(&wanted, 1, &timeout, &interruption.while_waiting());
  }

  std::uint32_t rate_of(const host_bus::Bus& bus) const {
    return options_.common.rate.empty() ? bus.bit_rate() : bit_rate_of(options_.common.rate);
  }

  int finish(const host_bus::Bus& bus) {
    const describe::Statistics& numbers = monitor_.statistics();
    const std::uint32_t rate = rate_of(bus);
    options_.common.is_json ? print_json_numbers(numbers, rate, bus) : print_numbers(numbers, rate, bus);
    const int page = options_.page.empty() ? ok : finish_page(numbers, rate, bus);
    if (page != ok) {
      return page;
    }
    if (!recorder_.close()) {
      print_message("the log is not complete: the file cannot be written");
      return usage;
    }
    if (bus.log() != nullptr && !bus.log()->fault().empty()) {
      print_message(bus.log()->fault());
      return usage;
    }
    return bus.log() != nullptr ? ok : numbers.frames + numbers.errors == 0 ? no_answer : ok;
  }

  std::vector<describe::Cause> causes() const {
    std::vector<describe::Cause> causes;
    const auto seconds = [&](Micros time) { return static_cast<double>(printer_.since_first(time)) / 1e6; };
    for (const explain::Finding& finding : explainer_->findings()) {
      const explain::Evidence& evidence = finding.evidence;
      describe::Cause cause{finding.title,
                            finding.text,
                            finding.check,
                            finding.fix,
                            finding.node,
                            seconds(evidence.since()),
                            seconds(evidence.until()),
                            {}};
      for (const Micros time : evidence.times()) {
        cause.times.push_back(seconds(time));
      }
      std::sort(cause.times.begin(), cause.times.end());
      causes.push_back(std::move(cause));
    }
    return causes;
  }

  int finish_page(const describe::Statistics& numbers, std::uint32_t rate, const host_bus::Bus& bus) {
    const char* const variable = std::getenv("LEXICAN_BUS");
    describe::PictureHead head;
    head.source = options_.log == "-"            ? "standard input"
                  : !options_.log.empty()        ? std::filesystem::path(options_.log).filename().string()
                  : !options_.common.bus.empty() ? options_.common.bus
                  : variable != nullptr          ? variable
                                                 : "";
    head.begin = numbers.first;
    head.duration = numbers.last - numbers.first;
    head.frames = numbers.frames;
    head.errors = numbers.errors;
    head.lost = bus.lost();
    head.bit_rate = rate;
    explainer_->finish();
    return write_page(options_.page, picture_, head, causes());
  }

  void print_numbers(const describe::Statistics& numbers, std::uint32_t rate, const host_bus::Bus& bus) const {
    const double duration = static_cast<double>(numbers.last - numbers.first) / 1e6;
    print(fmt::format("\n{} {} in {:.3f} s", numbers.frames, numbers.frames == 1 ? "frame" : "frames", duration));
    if (rate != 0 && duration > 0) {
      print(fmt::format(", bus load {:.1f} % of {} kbit/s", numbers.load(rate), rate / 1000));
    }
    print(fmt::format(", {} error frame{}, {} lost\n", numbers.errors, numbers.errors == 1 ? "" : "s", bus.lost()));
    if (bus.log() != nullptr && bus.log()->malformed() + bus.log()->other_frames() != 0) {
      print(fmt::format("{} lines are malformed, {} frames are CAN FD or XL\n", bus.log()->malformed(),
                        bus.log()->other_frames()));
    }
    std::vector<std::pair<std::uint64_t, std::uint32_t>> most;
    for (const auto& [identifier, count] : numbers.by_identifier) {
      most.emplace_back(count, identifier);
    }
    std::stable_sort(most.begin(), most.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t n = 0; n < std::min(most.size(), most_identifiers); ++n) {
      print(fmt::format("{:>11} {:>9}", identifier_text(most[n].second), most[n].first) +
            (duration > 0 ? fmt::format(" {:>9.1f}/s\n", static_cast<double>(most[n].first) / duration)
                          : std::string("\n")));
    }
    if (most.size() > most_identifiers) {
      print(fmt::format("{:>11}\n", fmt::format("and {} more", most.size() - most_identifiers)));
    }
    if (numbers.others != 0) {
      print(fmt::format("{:>11} {:>9} frames with other identifiers than these {}\n", "others", numbers.others,
                        most.size()));
    }
  }

  static void print_json_numbers(const describe::Statistics& numbers, std::uint32_t rate, const host_bus::Bus& bus) {
    nlohmann::json identifiers = nlohmann::json::object();
    for (const auto& [identifier, count] : numbers.by_identifier) {
      identifiers[identifier_text(identifier)] = count;
    }
    nlohmann::json json = {{"frames", numbers.frames},
                           {"duration", static_cast<double>(numbers.last - numbers.first) / 1e6},
                           {"errors", numbers.errors},
                           {"lost", bus.lost()},
                           {"identifiers", identifiers}};
    if (numbers.others != 0) {
      json["others"] = numbers.others;
    }
    if (rate != 0) {
      json["load"] = numbers.load(rate);
    }
    print(json.dump() + '\n');
  }

  const MonOptions& options_;
  const describe::Network& network_;
  LibraryFiles described_;
  Printer printer_;
  describe::Monitor monitor_;
  std::optional<explain::Explainer> explainer_;  ///< for the page
  Recorder recorder_;
  LostBus lost_;
  describe::Picture picture_;
  CO_IF_FRM frame_{};  ///< which the monitor processes
};

/// Draws the curve of a recorder, whose CSV is in place of a log.
int draw_curve(const MonOptions& options, std::istream& input) {
  const std::string name = options.log == "-" ? "standard input" : options.log;
  if (options.page.empty()) {
    print_message(name + " begins like the CSV of a recorder, which --html FILE draws");
    return usage;
  }
  if (!options.record.empty()) {
    print_message(name + " is the CSV of a recorder, which has no frames for --log");
    return usage;
  }
  describe::RecorderCurve curve;
  std::string why;
  if (!describe::read_recorder_csv(input, curve, why)) {
    print_message(name + ':' + why);
    return usage;
  }
  describe::PictureHead head;
  head.source = curve.name;
  head.is_recorder = true;
  describe::PictureSeries series;
  series.name = curve.name;
  series.about = curve.object;
  series.colour = curve.colour;
  for (const describe::RecorderPoint& point : curve.points) {
    series.times.push_back(point.time * 1000);
    series.values.push_back(static_cast<double>(point.value));
  }
  head.duration = series.times.back() - series.times.front();
  describe::Picture picture;
  picture.add_series(std::move(series));
  if (curve.has_trigger) {
    picture.add_mark(curve.trigger * 1000, "trigger");
  }
  return write_page(options.page, picture, head, {});
}

/// Draws the log if it is the CSV of a recorder.
/// \retval nothing  it is none
std::optional<int> draw_if_curve(const MonOptions& options) {
  std::error_code unused;
  if (options.log != "-" && !std::filesystem::is_regular_file(options.log, unused)) {
    return std::nullopt;  // a pipe can be read only once
  }
  std::ifstream file;
  if (options.log != "-") {
    file.open(options.log, std::ios::binary);
  }
  std::istream& input = options.log == "-" ? std::cin : file;
  const int first = input ? input.peek() : std::char_traits<char>::eof();
  const bool is_curve =
      first != std::char_traits<char>::eof() && describe::begins_recorder_csv(static_cast<char>(first));
  return is_curve ? std::optional(draw_curve(options, input)) : std::nullopt;
}

int run_mon(MonOptions& options) {
  std::error_code unused;
  if (!options.record.empty() && std::filesystem::equivalent(options.log, options.record, unused)) {
    print_message(options.record + " is read and cannot be the record, too");
    return usage;
  }
  if (!options.log.empty() && !options.common.bus.empty()) {
    print_message("give a log, or -i, and not both");
    return usage;
  }
  if (!options.page.empty()) {
    const std::string fault = std::filesystem::equivalent(options.log, options.page, unused)
                                  ? options.page + " is read and cannot be the page, too"
                                  : fault_of_page(options.page);
    if (!fault.empty()) {
      print_message(fault);
      return usage;
    }
  }
  if (const std::optional<int> status = options.log.empty() ? std::nullopt : draw_if_curve(options)) {
    return *status;
  }
  if (!options.log.empty()) {
    options.common.bus = "replay:" + options.log;
  }
  describe::Network network;
  if (!read_descriptions(options.common, network)) {
    return usage;
  }
  if (!are_nodes(options.nodes)) {
    return usage;
  }
  int status = ok;
  const std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, true, status);
  if (bus == nullptr) {
    return status;
  }
  Mon mon(options, network);
  return options.record.empty() || mon.recorder().open(options.record) ? mon.run(*bus) : usage;
}

}  // namespace

Verb add_mon(CommandLine& line) {
  const auto options = std::make_shared<MonOptions>();
  Arguments arguments = line.add_command("mon", "Show in words what happens on a bus, or in a log");
  arguments.add_option("file", options->log,
                       "Log of candump, pcapng, pcap or ASC instead of a bus, - for standard input");
  add_bus_options(arguments, options->common);
  add_eds_option(arguments, options->common);
  arguments.add_option("-n,--node", options->nodes, "Only these nodes").single_values();
  codict::cli::Choices<Service> services;
  for (std::size_t n = 0; n < std::size(describe::service_names); ++n) {
    services.emplace_back(describe::service_names[n], static_cast<Service>(n));
  }
  arguments.add_choices("--service", options->services, services,
                        fmt::format("Only these services: {}", fmt::join(describe::service_names, ", ")));
  arguments.add_option("--object", options->objects, "Only lines with this index or name, in capitals or not")
      .single_values();
  arguments.add_option("--log", options->record, "Record all frames: FILE.pcapng, else in the format of candump");
  arguments.add_option("--html", options->page,
                       "Also write a page with time axis, curves and lines, also of a recorder's CSV");
  arguments.add_flag("--ack", options->common.acknowledges,
                     "Acknowledge frames, for a device that is alone on the bus");
  arguments.add_flag("--all", options->shows_all, "Also heartbeats without a change, and each SYNC");
  arguments.end_help(
      "Examples:\n"
      "  lexican mon -i can0 --eds 5=drive.eds\n"
      "  lexican mon -i can0 --service sdo,emcy --node 5\n"
      "  lexican mon -i can0 --log fault.pcapng\n"
      "  lexican mon fault.log --html fault.html\n"
      "  lexican mon fault.log --eds descriptions");
  return {arguments, [options] { return program::finish(options->common, run_mon(*options)); }};
}

}  // namespace lexican::program
