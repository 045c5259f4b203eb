// SPDX-License-Identifier: Apache-2.0
// lexican pdo watch: shows the values of PDOs as they come: as lines, curves, CSV and SVG.
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "describe/monitor.hpp"
#include "describe/plot.hpp"
#include "model/pdo.hpp"
#include "program/identity.hpp"
#include "program/pdo.hpp"
#include "program/printable.hpp"
#include "text/file.hpp"

namespace lexican::program {
namespace {

using describe::EntryKey;
using describe::PdoContent;
using describe::PdoValue;
using describe::Point;

constexpr std::size_t most_points = 100'000;  // of a curve
constexpr double plot_seconds = 30;           // of a curve on the terminal
constexpr Micros redraw_interval = 100 * millisecond;
constexpr unsigned usual_columns = 80;
constexpr unsigned usual_lines = 24;
constexpr unsigned most_plot_lines = 6;
constexpr unsigned fewest_plot_lines = 2;

/// An object, and its values so far.
struct WatchedObject {
  EntryKey key;
  std::string name;
  std::string text{};
  std::vector<Point> points{};
  double low = 0;
  double high = 0;
  unsigned stride = 1;  ///< one of so many values is a point
  std::uint64_t values = 0;

  void add(double time, const PdoValue& value) {
    text = value.text;
    if (!value.number || !std::isfinite(*value.number)) {
      return;
    }
    low = values == 0 ? *value.number : std::min(low, *value.number);
    high = values == 0 ? *value.number : std::max(high, *value.number);
    if (values++ % stride == 0) {
      points.push_back({time, *value.number});
    }
    if (points.size() >= most_points) {  // every second one remains
      for (std::size_t n = 0; 2 * n < points.size(); ++n) {
        points[n] = points[2 * n];
      }
      points.resize((points.size() + 1) / 2);
      stride *= 2;
    }
  }
};

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + '"';
}

/// Draws curves in place on a terminal.
class PlotScreen {
 public:
  void draw(const std::vector<WatchedObject>& objects, double now) {
    std::size_t plotted = 0;
    for (const WatchedObject& object : objects) {
      plotted += object.points.empty() ? 0U : 1U;
    }
    const auto [columns, lines] = size();
    const std::size_t fits = std::max<std::size_t>(1, (lines - 1) / (1 + fewest_plot_lines));
    const std::size_t shown = std::min(plotted, fits);
    const auto height = static_cast<unsigned>(
        shown == 0 ? 0 : std::clamp<std::size_t>((lines - 1) / shown - 1, fewest_plot_lines, most_plot_lines));
    if (last_lines_ != 0) {
      std::fputs(fmt::format("\033[{}A", last_lines_).c_str(), stdout);
    }
    last_lines_ = 0;
    std::size_t count = 0;
    for (const WatchedObject& object : objects) {
      if (!object.points.empty() && count++ < shown) {
        draw_object(object, now, columns, height);
      }
    }
    if (shown < plotted) {
      line(fmt::format("and {} more; give the objects to watch", plotted - shown), columns);
    }
    if (is_terminal_) {
      std::fputs("\033[J", stdout);
    }
    std::fflush(stdout);
  }
  bool is_terminal() const { return is_terminal_; }

 private:
  struct Size {
    unsigned columns;
    unsigned lines;
  };

  Size size() const {
    winsize window{};
    const bool is_known =
        is_terminal_ && ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 10 && window.ws_row > 3;
    return is_known ? Size{window.ws_col, window.ws_row} : Size{usual_columns, usual_lines};
  }

  void draw_object(const WatchedObject& object, double now, unsigned columns, unsigned height) {
    line(fmt::format("{} = {}  ({:g} to {:g})", object.name, object.text, object.low, object.high), columns);
    describe::Range range = describe::range_of(object.points);
    range.to = now;
    range.from = std::max(object.points.front().time, is_terminal_ ? now - plot_seconds : 0.0);
    std::vector<Point> points = object.points;
    points.push_back({now, points.back().value});
    for (const std::string& text : describe::braille(points, range, columns - 1, height)) {
      line(text, 3 * columns);
    }
  }

  /// Prints a line; the terminal must not break it.
  void line(const std::string& text, std::size_t columns) {
    std::string shown = text.substr(0, columns - 1);
    while (!shown.empty() && shown.size() < text.size() &&
           (static_cast<unsigned char>(text[shown.size()]) & 0xC0U) == 0x80) {
      shown.pop_back();  // a part of a character
    }
    print(shown);
    std::fputs(is_terminal_ ? "\033[K\n" : "\n", stdout);
    last_lines_ += is_terminal_ ? 1 : 0;
  }

  bool is_terminal_ = isatty(STDOUT_FILENO) != 0;
  unsigned last_lines_ = 0;
};

class Watch {
 public:
  Watch(const PdoOptions& options, std::uint8_t node, describe::Network& network)
      : options_(options), node_(node), network_(network), monitor_(network, [](const describe::Event&) {}) {}

  /// Opens the files that are written.
  /// \retval false  the reason is printed
  bool open_files() {
    const std::string directory = std::filesystem::path(options_.svg).parent_path().string();
    if (!options_.svg.empty() && access(directory.empty() ? "." : directory.c_str(), W_OK) != 0) {
      print_message(options_.svg + " cannot be written");
      return false;
    }
    if (options_.csv.empty() || options_.csv == "-") {
      return true;
    }
    csv_.open(options_.csv, std::ios::binary);
    if (!csv_) {
      print_message(options_.csv + " cannot be written");
    }
    return csv_.good();
  }
  /// Returns true if the rest cannot be written.
  bool has_failed() const { return !csv_.good(); }

  /// Chooses PDOs and objects. \a words: those of the command line.
  /// \retval false  the reason is printed
  bool select(const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      ObjectReference object;
      std::string why;
      if (const std::optional<PdoName> pdo = pdo_of(word)) {
        pdos_.push_back(*pdo);
      } else if (find_object(word, network_.of(node_), object, why)) {
        keys_.emplace_back(object.index, object.sub_index);
      } else {
        print_message(why);
        return false;
      }
    }
    return true;
  }

  /// Sets the objects that the valid ones of some PDOs map.
  /// \retval false  a selected PDO or object is not among them; the reason is printed
  bool expect(const std::vector<DevicePdo>& pdos) {
    for (const DevicePdo& pdo : pdos) {
      for (const MappedEntry& entry : pdo.mapped) {
        if (pdo.is_valid() && !entry.is_dummy() && is_wanted(pdo.name, entry.key)) {
          object_of(entry.key);
        }
      }
    }
    for (const PdoName& name : pdos_) {
      if (std::none_of(pdos.begin(), pdos.end(),
                       [&](const DevicePdo& pdo) { return pdo.name == name && pdo.is_valid(); })) {
        print_message(fmt::format("node {0} has no {1} that is on; lexican pdo show {0} has all", node_, name.text()));
        return false;
      }
    }
    for (const EntryKey& key : keys_) {
      if (find(key) == objects_.end()) {
        print_message(fmt::format("{} is in no PDO of node {} that is on; lexican pdo show {} has all",
                                  network_.of(node_).object(key.first, key.second), node_, node_));
        return false;
      }
    }
    if (objects_.empty()) {
      print_message(fmt::format("node {0} has no PDO that is on; lexican pdo show {0} has all", node_));
      return false;
    }
    return true;
  }

  /// Sets the objects of the PDOs of a description, which may be changed on the bus.
  void expect_described() {
    for (const EntryKey& key : keys_) {
      object_of(key);
    }
    const codict::Device* const device = network_.of(node_).device();
    for (const codict::Pdo& pdo : device != nullptr ? codict::pdos_of(*device) : std::vector<codict::Pdo>()) {
      for (const codict::MappedObject& mapped : pdo.mapped) {
        const EntryKey key{mapped.index, mapped.sub_index};
        if (!mapped.is_dummy() && is_wanted({pdo.is_transmit, pdo.number}, key)) {
          object_of(key);
        }
      }
    }
  }

  void process(const host_bus::Entry& entry) {
    follow(entry);
    show_values(entry);
  }

  /// Processes a frame while the PDOs are read: its values are shown by show_early().
  void process_early(const host_bus::Entry& entry) {
    follow(entry);
    early_.push_back(entry);
  }

  /// Shows the values of the early frames, by the PDOs that were read since then.
  void show_early() {
    for (const host_bus::Entry& entry : std::exchange(early_, {})) {
      show_values(entry);
    }
  }

  /// Draws the curves, which move on with the time. \a now: as the times of the frames.
  void redraw(Micros now) {
    last_ = std::max(last_, now);
    csv_.flush();
    if (options_.has_plot && screen_.is_terminal() && received_ != 0 && now - drawn_ >= redraw_interval) {
      screen_.draw(objects_, seconds(last_));
      drawn_ = now;
    }
  }

  /// Writes what is written at the end.
  /// \retval status of the program
  int finish() {
    if (received_ == 0) {
      const bool is_ready = !state_ || *state_ == 0x05;
      print_message(is_ready ? fmt::format("no PDO of node {} with these values was sent", node_)
                             : fmt::format("node {0} is {1} and sends no PDOs: lexican nmt start {0}", node_,
                                           state_text(*state_)));
      return no_answer;
    }
    if (options_.has_plot) {
      screen_.draw(objects_, seconds(last_));
    } else if (!options_.common.is_json && options_.csv != "-") {
      print_summary();
    }
    std::string why;
    if (!options_.svg.empty() &&
        codict::write_file(options_.svg, describe::to_svg(fmt::format("node {}", node_), curves()), why) ==
            codict::Written::no) {
      print_message(why);
      return usage;
    }
    csv_.flush();
    if (!csv_.good()) {
      print_message(options_.csv + " is not complete: the file cannot be written");
      return usage;
    }
    return ok;
  }

 private:
  void follow(const host_bus::Entry& entry) {
    begin_ = begin_ == 0 ? entry.time : begin_;
    last_ = std::max(last_, entry.time);
    monitor_.process(entry);
    if (entry.frame.Identifier == 0x700U + node_ && entry.frame.DLC == 1) {
      note_state(entry.frame.Data[0] & 0x7FU);
    }
  }

  void show_values(const host_bus::Entry& entry) {
    const std::optional<PdoContent> content = monitor_.values_of(entry.frame, node_);
    if (content) {
      show(*content, seconds(entry.time));
    }
  }

  /// Says when a device that has sent PDOs stops doing so.
  void note_state(std::uint8_t state) {
    const bool has_left = received_ != 0 && state != 0x05 && state_ != state;
    state_ = state;
    if (has_left) {
      print_note(fmt::format("node {0} {1} and sends no PDOs: lexican nmt start {0}", node_,
                             state == 0 ? "has booted" : "is " + state_text(state)));
    }
  }

  double seconds(Micros time) const { return time < begin_ ? 0.0 : static_cast<double>(time - begin_) / 1e6; }

  bool is_wanted(const PdoName& pdo, const EntryKey& key) const {
    const bool is_all = pdos_.empty() && keys_.empty();
    return is_all || std::find(pdos_.begin(), pdos_.end(), pdo) != pdos_.end() ||
           std::find(keys_.begin(), keys_.end(), key) != keys_.end();
  }

  std::vector<WatchedObject>::iterator find(const EntryKey& key) {
    return std::find_if(objects_.begin(), objects_.end(),
                        [&](const WatchedObject& object) { return object.key == key; });
  }

  WatchedObject& object_of(const EntryKey& key) {
    const auto found = find(key);
    if (found != objects_.end()) {
      return *found;
    }
    const std::string name = network_.of(node_).name_of(key.first, key.second);
    objects_.push_back({key, name.empty() ? network_.of(node_).object(key.first, key.second) : name});
    return objects_.back();
  }

  void show(const PdoContent& content, double time) {
    const PdoName name{content.is_transmit, content.number};
    std::vector<const PdoValue*> wanted;
    bool is_changed = false;
    for (const PdoValue& value : content.values) {
      const EntryKey key{value.index, value.sub_index};
      if (is_wanted(name, key)) {
        WatchedObject& object = object_of(key);
        is_changed = is_changed || object.text != value.text;
        object.add(time, value);
        wanted.push_back(&value);
      }
    }
    if (wanted.empty()) {
      return;
    }
    ++received_;
    if (!options_.csv.empty()) {
      write_row(time, wanted);
    }
    if (options_.common.is_json) {
      print_json_line(name, time, wanted);
    } else if (is_changed && options_.csv != "-" && !options_.has_plot) {
      print_line(name, time, wanted);
    }
  }

  static void print_line(const PdoName& name, double time, const std::vector<const PdoValue*>& values) {
    std::string text = fmt::format("{:9.3f}  {}", time, name.text());
    const char* separator = "  ";
    for (const PdoValue* const value : values) {
      text += separator + value->name + " = " + value->text;
      separator = ", ";
    }
    print(text + '\n');
  }

  void print_json_line(const PdoName& name, double time, const std::vector<const PdoValue*>& values) const {
    nlohmann::json list = nlohmann::json::array();
    for (const PdoValue* const value : values) {
      list.push_back({{"index", value->index},
                      {"sub", value->sub_index},
                      {"object", network_.of(node_).object(value->index, value->sub_index)},
                      {"text", value->text}});
      if (value->number) {
        list.back()["value"] = *value->number;
      }
    }
    const nlohmann::json json = {{"time", time}, {"node", node_}, {"pdo", name.text()}, {"values", list}};
    print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
  }

  /// Writes a row of the CSV, and its first line before the first one. Columns are those of the objects that are known
  /// then.
  void write_row(double time, const std::vector<const PdoValue*>& values) {
    std::string text;
    if (csv_columns_ == 0) {
      csv_columns_ = objects_.size();
      text = "time";
      for (const WatchedObject& object : objects_) {
        text += ',' + csv_field(printable(object.name));
      }
      text += '\n';
    }
    text += fmt::format("{:.6f}", time);
    for (std::size_t n = 0; n < csv_columns_; ++n) {
      const auto found = std::find_if(values.begin(), values.end(), [&](const PdoValue* value) {
        return EntryKey{value->index, value->sub_index} == objects_[n].key;
      });
      text += ',';
      if (found != values.end()) {
        text += (*found)->number ? fmt::format("{:.12g}", *(*found)->number) : csv_field(printable((*found)->text));
      }
    }
    text += '\n';
    if (options_.csv == "-") {
      print(text);
    } else {
      csv_ << text;
    }
  }

  void print_summary() const {
    std::size_t width = 0;
    for (const WatchedObject& object : objects_) {
      width = std::max(width, object.name.size());
    }
    print(fmt::format("\n{} PDO{} in {:.3f} s\n", received_, received_ == 1 ? "" : "s", seconds(last_)));
    for (const WatchedObject& object : objects_) {
      print(fmt::format("  {:<{}}  {}", object.name, width, object.text.empty() ? "no value" : object.text) +
            (object.values != 0 ? fmt::format(", {:g} to {:g}\n", object.low, object.high) : "\n"));
    }
  }

  std::vector<describe::Curve> curves() const {
    std::vector<describe::Curve> curves;
    for (const WatchedObject& object : objects_) {
      if (!object.points.empty()) {
        curves.push_back({object.name, object.points});
        curves.back().points.push_back({seconds(last_), object.points.back().value});
      }
    }
    return curves;
  }

  const PdoOptions& options_;
  std::uint8_t node_;
  describe::Network& network_;
  describe::Monitor monitor_;
  std::vector<PdoName> pdos_;
  std::vector<EntryKey> keys_;
  std::vector<WatchedObject> objects_;
  std::vector<host_bus::Entry> early_;  ///< before the PDOs are read
  PlotScreen screen_;
  std::ofstream csv_;
  std::size_t csv_columns_ = 0;  ///< 0: the first line is not written
  std::optional<std::uint8_t> state_;
  Micros begin_ = 0;
  Micros last_ = 0;
  Micros drawn_ = 0;
  std::uint64_t received_ = 0;
};

int watch_log(Watch& watch, const Common& common, const std::vector<std::string>& words) {
  int status = ok;
  const std::unique_ptr<host_bus::Bus> bus = open_bus(common, true, status);
  if (bus == nullptr || !watch.select(words) || !watch.open_files()) {
    return bus == nullptr ? status : usage;
  }
  const Interruption interruption;
  watch.expect_described();
  while (!Interruption::happened()) {
    const std::optional<host_bus::Entry> entry = bus->receive();
    if (!entry) {
      break;
    }
    watch.process(*entry);
  }
  if (bus->log() != nullptr && !bus->log()->fault().empty()) {
    print_message(bus->log()->fault());
    return usage;
  }
  return watch.finish();
}

int watch_bus(Watch& watch, const PdoOptions& options, std::uint8_t node, describe::Network& network,
              const std::vector<std::string>& words) {
  int status = ok;
  std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  Session session(std::move(bus), node, [&](bool, const CO_IF_FRM& frame) {
    watch.process_early({host_bus::clock_now(CLOCK_REALTIME), frame});
  });
  PdoReader reader(session, node, network, options.common.timeout);
  Transfer transfer;
  const auto identity = identify_device(session.sdo(), node, options.common, network, transfer);
  if (!identity && (transfer.is_unanswered() || session.is_interrupted())) {
    return reader.report({0x1018, 1}, transfer);
  }
  std::vector<DevicePdo> pdos;
  if (!watch.select(words)) {
    return usage;
  }
  status = reader.read_all(pdos);
  if (status != ok || !watch.expect(pdos)) {
    return status != ok ? status : refused;
  }
  if (!watch.open_files()) {
    return usage;
  }
  watch.show_early();
  const Micros begin = session.host().now();
  const Micros duration = options.duration * second;
  while (!session.host().interrupted() && !watch.has_failed() &&
         (duration == 0 || session.host().now() - begin < duration)) {
    while (const std::optional<host_bus::Entry> entry = session.bus().receive()) {
      watch.process(*entry);
    }
    watch.redraw(host_bus::clock_now(CLOCK_REALTIME));
    std::fflush(stdout);
    session.host().wait(50 * millisecond);
  }
  status = watch.finish();
  if (session.bus().lost() != 0) {
    print_note(fmt::format("{} frames were lost: this program did not read them in time", session.bus().lost()));
  }
  if (!session.bus().fault().empty()) {
    print_message(session.bus().fault());
    return bus_fault;
  }
  return status;
}

}  // namespace

int run_watch(const PdoOptions& options, std::uint8_t node, describe::Network& network,
              const std::vector<std::string>& words) {
  const bool has_output = options.common.is_json || options.has_plot;
  if ((options.common.is_json && options.has_plot) || (has_output && options.csv == "-")) {
    print_message("--json, --plot and --csv - have the standard output; give one of them");
    return usage;
  }
  Watch watch(options, node, network);
  const char* const usual = std::getenv("LEXICAN_BUS");
  const std::string name = !options.common.bus.empty() ? options.common.bus : usual != nullptr ? usual : "";
  return name.compare(0, 7, "replay:") == 0 ? watch_log(watch, options.common, words)
                                            : watch_bus(watch, options, node, network, words);
}

}  // namespace lexican::program
