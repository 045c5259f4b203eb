// SPDX-License-Identifier: Apache-2.0
// lexican-plot: draws the CSV of a recorder (docs/recorder.md) as SVG.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr const char* help =
    "Draws the CSV of a recorder (lines 'time;value', the time in ms) as a picture (SVG), which a browser shows.\n"
    "Usage: lexican-plot [OPTIONS] [FILE]\n"
    "\n"
    "Reads standard input if there is no FILE. Lines that begin with '#' are comments; these describe the curve:\n"
    "  # name: speed           Title, and name in the legend\n"
    "  # object: 2110h:00      Recorded object, shown in the legend\n"
    "  # colour: 0060C0        Colour of the curve, RRGGBB in hexadecimal\n"
    "  # trigger: 158          Time of the trigger in ms, shown as a line\n"
    "\n"
    "Options:\n"
    "  -h,--help               Print this help message and exit\n"
    "  -o,--output FILE        File of the picture; standard output by default\n"
    "\n"
    "Exit codes:\n"
    "    0  the picture was written\n"
    "    1  the CSV is malformed or has no points, or a file could not be read or written\n"
    "    2  wrong arguments\n"
    "\n"
    "Example:\n"
    "  printf '# name: speed\\n0;10\\n5;30\\n12;20\\n' | lexican-plot --output speed.svg\n";

struct Point {
  std::uint64_t time;  // ms; does not wrap
  std::int64_t value;
};

struct Curve {
  std::string name = "value";
  std::string object;
  std::string colour = "0060C0";
  bool has_trigger = false;
  std::uint32_t trigger = 0;  // ms, modulo 2^32
  std::vector<Point> points;
};

// Input ---------------------------------------------------------------------------------------------------------------

// Converts a complete text to a number. Returns false if it is none, or not from low to high.
bool to_number(std::string_view text, int base, std::int64_t low, std::int64_t high, std::int64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc{} && end == text.data() + text.size() && number >= low && number <= high;
}

// Returns a text of the input for a message: shortened, without characters that a terminal does not show.
std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + shown + (text.size() > longest ? "...'" : "'");
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Reads a comment; "# key: value" describes the curve.
void read_comment(std::string_view line, Curve& curve) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) {
    return;
  }
  const std::string_view key = trimmed(line.substr(1, colon - 1));
  const std::string_view value = trimmed(line.substr(colon + 1));
  std::int64_t number = 0;
  if (key == "name") {
    curve.name = value;
  } else if (key == "object") {
    curve.object = value;
  } else if (key == "colour") {
    if (value.size() != 6 || !to_number(value, 16, 0, 0xFFFFFF, number)) {
      throw std::runtime_error("wrong colour " + quoted(value) + "; write six hexadecimal digits, RRGGBB");
    }
    curve.colour = value;
  } else if (key == "trigger") {
    if (!to_number(value, 10, 0, UINT32_MAX, number)) {
      throw std::runtime_error("wrong time of the trigger " + quoted(value) + "; write milliseconds, 0 to 4294967295");
    }
    curve.has_trigger = true;
    curve.trigger = static_cast<std::uint32_t>(number);
  }
}

void read_point(std::string_view line, Curve& curve) {
  const std::size_t separator = line.find(';');
  if (separator == std::string_view::npos) {
    throw std::runtime_error("no ';' in " + quoted(line) +
                             "; a line is 'time;value': read the plot in format 0 (CSV), not 1 (binary)");
  }
  std::int64_t time = 0;
  std::int64_t value = 0;
  if (!to_number(line.substr(0, separator), 10, 0, UINT32_MAX, time)) {
    throw std::runtime_error("wrong time " + quoted(line.substr(0, separator)) +
                             "; write milliseconds, 0 to 4294967295, before the ';'");
  }
  if (!to_number(line.substr(separator + 1), 10, INT32_MIN, UINT32_MAX, value)) {
    throw std::runtime_error("wrong value " + quoted(line.substr(separator + 1)) +
                             "; write a number, -2147483648 to 4294967295, behind the ';'");
  }
  auto since_before = static_cast<std::uint32_t>(time);
  std::uint64_t before = 0;
  if (!curve.points.empty()) {
    before = curve.points.back().time;
    since_before -= static_cast<std::uint32_t>(before);  // the time of the recorder wraps
  }
  if (!curve.points.empty() && since_before > INT32_MAX) {
    throw std::runtime_error("time " + std::to_string(time) + " is before that of the previous point, " +
                             std::to_string(static_cast<std::uint32_t>(before)) +
                             "; sort the lines, and draw each upload separately");
  }
  curve.points.push_back({before + since_before, value});
}

// Reads a curve. Throws std::runtime_error with file and line.
Curve read_curve(std::istream& input, const std::string& file) {
  Curve curve;
  std::string text;
  for (unsigned line = 1; std::getline(input, text); ++line) {
    if (!text.empty() && text.back() == '\r') {
      text.pop_back();
    }
    try {
      text[0] == '#' ? read_comment(text, curve) : read_point(text, curve);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(file + ":" + std::to_string(line) + ": " + error.what());
    }
  }
  if (input.bad()) {
    throw std::runtime_error(file + ": cannot be read");
  }
  if (curve.points.empty()) {
    throw std::runtime_error(file + ": no points; read the plot while the recorder holds points (2401h:1)");
  }
  return curve;
}

// Picture -------------------------------------------------------------------------------------------------------------

constexpr double left = 90;
constexpr double right = 780;
constexpr double top = 40;
constexpr double bottom = 345;

// Returns 1, 2 or 5 times a power of ten: the smallest step that divides a range into at most 8 parts. At least least.
double step_of(double range, double least) {
  constexpr double most_parts = 8;
  double power = least;
  while (power * 10 * most_parts < range) {
    power *= 10;
  }
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (power * factor * most_parts >= range) {
      return power * factor;
    }
  }
  return power * 10;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// Returns a coordinate with two decimal places.
std::string coordinate(double value) { return number(std::round(value * 100) / 100); }

std::string escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    switch (c) {
      case '&': xml += "&amp;"; break;
      case '<': xml += "&lt;"; break;
      case '>': xml += "&gt;"; break;
      default: xml += static_cast<unsigned char>(c) < ' ' ? '_' : c; break;
    }
  }
  return xml;
}

struct Unit {
  const char* name;
  double ms;
  double least_step;  // in this unit
};

Unit unit_of(double range_ms) {
  constexpr double ms_per_s = 1000;
  constexpr double ms_per_h = 3600 * ms_per_s;
  if (range_ms < 10 * ms_per_s) {
    return {"ms", 1, 1};
  }
  return range_ms < 3 * ms_per_h ? Unit{"s", ms_per_s, 1} : Unit{"h", ms_per_h, 0.1};
}

class Picture {
 public:
  explicit Picture(const Curve& curve) : curve_(curve) {
    const auto [least, most] = std::minmax_element(curve.points.begin(), curve.points.end(),
                                                   [](const Point& a, const Point& b) { return a.value < b.value; });
    const auto low = static_cast<double>(least->value);
    const auto high = static_cast<double>(most->value);
    step_ = step_of(high - low, 1);
    low_ = std::floor(low / step_) * step_;
    high_ = std::max(std::ceil(high / step_) * step_, low_ + step_);
    begin_ = static_cast<double>(curve.points.front().time);
    end_ = std::max(static_cast<double>(curve.points.back().time), begin_ + 1);
  }

  std::string svg() {
    const std::string name = escaped(curve_.name);
    svg_ =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 400\" font-family=\"sans-serif\" "
        "font-size=\"13\">\n"
        "<title>" +
        name + "</title>\n<rect width=\"800\" height=\"400\" fill=\"#fff\"/>\n";
    draw_value_axis();
    draw_time_axis();
    svg_ += "<path id=\"axes\" fill=\"none\" stroke=\"#333\" d=\"M90,40V345H780\"/>\n";
    draw_trigger();
    draw_curve();
    draw_legend(name);
    return svg_ + "</svg>\n";
  }

 private:
  double x(double time) const { return left + (time - begin_) / (end_ - begin_) * (right - left); }
  double y(double value) const { return bottom - (value - low_) / (high_ - low_) * (bottom - top); }

  void text(double at_x, double at_y, const char* anchor, const std::string& content) {
    svg_ += "<text x=\"" + coordinate(at_x) + "\" y=\"" + coordinate(at_y) + "\" text-anchor=\"" + anchor + "\">" +
            content + "</text>\n";
  }
  void draw_value_axis() {
    for (double value = low_; value <= high_ + step_ / 2; value += step_) {
      svg_ += "<path stroke=\"#ddd\" d=\"M90," + coordinate(y(value)) + "H780\"/>\n";
      text(left - 8, y(value) + 4, "end", number(value));
    }
  }
  void draw_time_axis() {
    const Unit unit = unit_of(end_ - begin_);
    const double step = step_of((end_ - begin_) / unit.ms, unit.least_step);
    for (double n = std::ceil(begin_ / unit.ms / step); n * step * unit.ms <= end_; ++n) {
      const double at = x(n * step * unit.ms);
      svg_ += "<path stroke=\"#ddd\" d=\"M" + coordinate(at) + ",40V350\"/>\n";
      text(at, bottom + 20, "middle", number(n * step));
    }
    text((left + right) / 2, bottom + 42, "middle", std::string("time in ") + unit.name);
  }
  void draw_trigger() {
    const std::uint64_t first = curve_.points.front().time;
    const std::uint32_t since_first = curve_.trigger - static_cast<std::uint32_t>(first);
    const auto time = static_cast<double>(first + since_first);
    if (curve_.has_trigger && time <= end_) {
      const std::string at = coordinate(x(time));
      svg_ += "<path id=\"trigger\" stroke=\"#c00\" stroke-dasharray=\"5 4\" d=\"M" + at + ",40V345\"/>\n";
      const bool is_left = x(time) < (left + right) / 2;
      text(x(time) + (is_left ? 5 : -5), top + 14, is_left ? "start" : "end", "trigger");
    }
  }
  // The value of a recorder is constant until the next point.
  void draw_curve() {
    svg_ += "<path id=\"curve\" fill=\"none\" stroke-width=\"2\" stroke-linecap=\"round\" stroke=\"#" + curve_.colour +
            "\" d=\"";
    bool is_first = true;
    for (const Point& point : curve_.points) {
      const std::string at_x = coordinate(x(static_cast<double>(point.time)));
      const std::string at_y = coordinate(y(static_cast<double>(point.value)));
      svg_ += is_first ? "M" + at_x + "," + at_y + "h0" : "H" + at_x + "V" + at_y;
      is_first = false;
    }
    svg_ += "\"/>\n";
  }
  void draw_legend(const std::string& name) {
    svg_ += "<path stroke-width=\"3\" stroke=\"#" + curve_.colour + "\" d=\"M90,22H114\"/>\n";
    text(left + 32, 26, "start", curve_.object.empty() ? name : name + " (" + escaped(curve_.object) + ")");
  }

  const Curve& curve_;
  double low_ = 0;  // of the axis of values
  double high_ = 0;
  double step_ = 1;
  double begin_ = 0;  // of the axis of time, ms
  double end_ = 0;
  std::string svg_;
};

Curve read_file(const std::string& file) {
  if (file.empty()) {
    return read_curve(std::cin, "standard input");
  }
  std::ifstream input(file, std::ios::binary);
  if (!input) {
    throw std::runtime_error(file + ": cannot be opened; check its name and permissions");
  }
  return read_curve(input, file);
}

void write_file(const std::string& file, const std::string& svg) {
  std::ofstream output;
  if (!file.empty()) {
    output.open(file, std::ios::binary);
  }
  std::ostream& to = file.empty() ? std::cout : output;
  to << svg << std::flush;
  if (!to) {
    throw std::runtime_error((file.empty() ? "standard output" : file) +
                             ": cannot be written; check its directory, permissions and free space");
  }
}

int refuse(const std::string& fault) {
  std::cerr << "lexican-plot: " << fault << "; see --help\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::string input;
  std::string output;
  for (int n = 1; n < argc; ++n) {
    const std::string argument = argv[n];
    if (argument == "--help" || argument == "-h") {
      std::cout << help;
      return 0;
    }
    if (argument == "--output" || argument == "-o") {
      if (n + 1 == argc) {
        return refuse("option '" + argument + "' needs a file");
      }
      output = argv[++n];
    } else if (argument.size() > 1 && argument[0] == '-') {
      return refuse("unknown option '" + argument + "'");
    } else if (!input.empty()) {
      return refuse("second file '" + argument + "'");
    } else {
      input = argument;
    }
  }
  try {
    const Curve curve = read_file(input);
    write_file(output, Picture(curve).svg());
  } catch (const std::runtime_error& error) {
    std::cerr << "lexican-plot: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
