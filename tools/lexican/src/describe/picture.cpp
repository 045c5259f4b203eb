// SPDX-License-Identifier: Apache-2.0
#include "describe/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "frame_bits.hpp"

namespace lexican::describe {

extern const std::string_view picture_page;  // picture.html, by CMakeLists.txt

namespace {

/// Returns a text for JSON within HTML: all characters beyond ASCII and '<' are escaped, so that no text ends the
/// script element. Bytes that are not UTF-8 are replaced.
std::string json_text(const std::string& text) {
  const std::string json = nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string safe;
  for (const char c : json) {
    safe += c == '<' ? "\\u003c" : std::string(1, c);
  }
  return safe;
}

std::string json_number(double number) { return std::isfinite(number) ? fmt::format("{}", number) : "null"; }

/// Appends the elements of an array. \a element: returns the text of the element at a position.
template <typename Element>
void write_array(std::string& json, std::size_t count, Element element) {
  json += '[';
  for (std::size_t n = 0; n < count; ++n) {
    json += n == 0 ? "" : ",";
    json += element(n);
  }
  json += ']';
}

/// Returns the positions of elements in the order of their times: a log can go back in time.
template <typename Time>
std::vector<std::size_t> order_of(std::size_t count, Time time) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return time(a) < time(b); });
  return order;
}

void write_causes(std::string& json, const std::vector<Cause>& causes) {
  write_array(json, causes.size(), [&](std::size_t n) {
    const Cause& cause = causes[n];
    std::string text =
        fmt::format(R"({{"title":{},"text":{},"check":{},"fix":{},"node":{},"since":{},"until":{},"times":)",
                    json_text(cause.title), json_text(cause.text), json_text(cause.check), json_text(cause.fix),
                    cause.node, json_number(cause.since), json_number(cause.until));
    write_array(text, cause.times.size(), [&](std::size_t m) { return json_number(cause.times[m]); });
    return text + '}';
  });
}

/// Returns a number that a text of the bus cannot know: only scripts and styles of the page itself are permitted.
std::string nonce() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

}  // namespace

void Picture::count(Micros time, const CO_IF_FRM& frame) {
  while (time / bin_ >= most_bins) {
    for (std::size_t n = 0; n < bins_.size(); ++n) {
      const Bin bin = std::exchange(bins_[n], {});
      bins_[n / 2].bits += bin.bits;
      bins_[n / 2].frames += bin.frames;
      bins_[n / 2].errors += bin.errors;
    }
    bins_.resize((bins_.size() + 1) / 2);
    bin_ *= 2;
  }
  const auto position = static_cast<std::size_t>(time / bin_);
  bins_.resize(std::max(bins_.size(), position + 1));
  if ((frame.Identifier & CO_IF_FRM_ERROR) != 0) {
    ++bins_[position].errors;
    return;
  }
  CO_IF_FRM classic = frame;
  classic.DLC = std::min<std::uint8_t>(classic.DLC, 8);
  ++bins_[position].frames;
  bins_[position].bits += co::frame_bits(classic) + co::intermission_bits;
}

void Picture::add_line(Micros time, const Event& event, const std::string& text) {
  if (lines_.size() >= most_lines) {
    ++omitted_lines_;
    return;
  }
  const std::uint32_t position = texts_.try_emplace(text, static_cast<std::uint32_t>(texts_.size())).first->second;
  lines_.push_back({time, position, event.service, event.node, event.is_fault});
}

void Picture::add_values(Micros time, const PdoContent& content) {
  for (const PdoValue& value : content.values) {
    if (!value.number) {
      continue;
    }
    const SeriesKey at{content.node, !content.is_transmit, content.number, value.index, value.sub_index};
    const auto known = series_of_.find(at);
    const bool is_full = values_ >= most_values || (known == series_of_.end() && series_.size() >= most_series);
    if (is_full) {
      ++omitted_values_;
      continue;
    }
    if (known == series_of_.end()) {
      series_of_.emplace(at, series_.size());
      PictureSeries series;
      series.name = value.name;
      series.about = fmt::format("{}{}, {:04X}h:{:02X}", content.is_transmit ? "TPDO" : "RPDO", content.number,
                                 value.index, value.sub_index);
      series.unit = value.unit;
      series.node = content.node;
      series_.push_back(std::move(series));
    }
    PictureSeries& series = known == series_of_.end() ? series_.back() : series_[known->second];
    series.times.push_back(time);
    series.values.push_back(*value.number);
    ++values_;
  }
}

void Picture::add_series(PictureSeries series) {
  const std::size_t count = std::min(series.times.size(), most_values - values_);
  omitted_values_ += series.times.size() - count;
  values_ += count;
  series.times.resize(count);
  series.values.resize(count);
  series_.push_back(std::move(series));
}

void Picture::write_lines(std::string& json) const {
  const std::vector<std::size_t> order = order_of(lines_.size(), [&](std::size_t n) { return lines_[n].time; });
  const auto write = [&](const char* name, auto member) {
    json += name;
    write_array(json, order.size(), [&](std::size_t n) { return fmt::format("{}", member(lines_[order[n]])); });
  };
  write(R"("lines":{"time":)", [](const Line& line) { return line.time; });
  write(R"(,"node":)", [](const Line& line) { return unsigned{line.node}; });
  write(R"(,"service":)", [](const Line& line) { return static_cast<unsigned>(line.service); });
  write(R"(,"fault":)", [](const Line& line) { return line.is_fault ? 1 : 0; });
  write(R"(,"text":)", [](const Line& line) { return line.text; });
  std::vector<const std::string*> texts(texts_.size());
  for (const auto& [text, position] : texts_) {
    texts[position] = &text;
  }
  json += "},\"texts\":";
  write_array(json, texts.size(), [&](std::size_t n) { return json_text(*texts[n]); });
}

void Picture::write_series(std::string& json) const {
  json += ",\"series\":";
  write_array(json, series_.size(), [&](std::size_t n) {
    const PictureSeries& series = series_[n];
    const auto order = order_of(series.times.size(), [&](std::size_t m) { return series.times[m]; });
    std::string text =
        fmt::format(R"({{"name":{},"about":{},"unit":{},"colour":{},"node":{},"time":)", json_text(series.name),
                    json_text(series.about), json_text(series.unit), json_text(series.colour), series.node);
    write_array(text, order.size(), [&](std::size_t m) { return fmt::format("{}", series.times[order[m]]); });
    text += ",\"value\":";
    write_array(text, order.size(), [&](std::size_t m) { return json_number(series.values[order[m]]); });
    return text + '}';
  });
}

void Picture::write_load(std::string& json) const {
  json += fmt::format(R"(,"load":{{"step":{},"bits":)", bin_);
  write_array(json, bins_.size(), [&](std::size_t n) { return fmt::format("{}", bins_[n].bits); });
  json += ",\"frames\":";
  write_array(json, bins_.size(), [&](std::size_t n) { return fmt::format("{}", bins_[n].frames); });
  json += ",\"errors\":";
  write_array(json, bins_.size(), [&](std::size_t n) { return fmt::format("{}", bins_[n].errors); });
  json += '}';
}

std::string Picture::data(const PictureHead& head, const std::vector<Cause>& causes) const {
  std::string json =
      fmt::format(R"({{"source":{},"begin":{},"duration":{},"frames":{},"errors":{},"lost":{},"rate":{},"recorder":{},)"
                  R"("omitted":{{"lines":{},"values":{}}},"services":)",
                  json_text(head.source), head.begin, head.duration, head.frames, head.errors, head.lost, head.bit_rate,
                  head.is_recorder, omitted_lines_, omitted_values_);
  write_array(json, std::size(service_names), [](std::size_t n) { return json_text(service_names[n]); });
  json += ",\"marks\":";
  write_array(json, marks_.size(), [&](std::size_t n) {
    return fmt::format(R"({{"time":{},"name":{}}})", marks_[n].first, json_text(marks_[n].second));
  });
  json += ",\"causes\":";
  write_causes(json, causes);
  json += ',';
  write_lines(json);
  write_series(json);
  write_load(json);
  return json + '}';
}

std::string Picture::page(const PictureHead& head, const std::vector<Cause>& causes) const {
  const std::string once = nonce();
  std::string page;
  std::string_view rest = picture_page;
  for (std::size_t at = rest.find('%'); at != std::string_view::npos; at = rest.find('%')) {
    page += rest.substr(0, at);
    rest.remove_prefix(at);
    if (rest.substr(0, 7) == "%NONCE%") {
      page += once;
      rest.remove_prefix(7);
    } else if (rest.substr(0, 6) == "%DATA%") {
      page += data(head, causes);
      rest.remove_prefix(6);
    } else {
      page += '%';
      rest.remove_prefix(1);
    }
  }
  return page.append(rest);
}

}  // namespace lexican::describe
