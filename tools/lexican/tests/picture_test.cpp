// SPDX-License-Identifier: Apache-2.0
#include "describe/picture.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "describe/recorder_csv.hpp"

namespace {

using namespace lexican;
using namespace lexican::describe;
using Json = nlohmann::json;

/// Returns the data of a page. The text of the script element has no "<": it would end at the first "</script".
Json data_of(const std::string& page) {
  const std::string begin = "<script id=\"data\" type=\"application/json\">";
  const std::size_t from = page.find(begin);
  REQUIRE(from != std::string::npos);
  const std::string text = page.substr(from + begin.size(), page.find('<', from + begin.size()) - from - begin.size());
  return Json::parse(text);
}

Event event_of(Service service, std::uint8_t node, bool is_fault = false) {
  Event event;
  event.service = service;
  event.node = node;
  event.is_fault = is_fault;
  return event;
}

CO_IF_FRM frame_of(std::uint32_t identifier) {
  CO_IF_FRM frame{};
  frame.Identifier = identifier;
  frame.DLC = 8;
  return frame;
}

TEST_CASE("picture: lines, values and causes are in the data of the page") {
  Picture picture;
  picture.add_line(2'000'000, event_of(Service::sdo, 5, true), "write 2101h refused");
  picture.add_line(1'000'000, event_of(Service::pdo, 6), "TPDO1 Speed = 1 rpm");
  picture.add_values(1'000'000,
                     {6, true, 1, {{0x2001, 0, "Speed", "1 rpm", 1.0, "rpm"}, {0x2002, 0, "Name", "x", {}, ""}}});
  picture.add_values(3'000'000,
                     {6, true, 1, {{0x2001, 0, "Speed", "", std::numeric_limits<double>::infinity(), "rpm"}}});
  Cause cause;
  cause.title = "Too high";
  cause.text = "The value is out of range.";
  cause.check = "the range";
  cause.fix = "write 60";
  cause.node = 5;
  cause.since = 1.5;
  cause.until = 2;
  cause.times = {1.5, 2};
  Cause other;
  other.title = "Cable";
  PictureHead head;
  head.source = "fault.log";
  head.duration = 3'000'000;
  head.frames = 4;
  const Json data = data_of(picture.page(head, {cause, other}));
  CHECK(data["source"] == "fault.log");
  CHECK(data["frames"] == 4);
  CHECK(data["lines"] ==
        Json::parse(R"({"time":[1000000,2000000],"node":[6,5],"service":[5,6],"fault":[0,1],"text":[1,0]})"));
  CHECK(data["texts"] == Json{"write 2101h refused", "TPDO1 Speed = 1 rpm"});
  CHECK(data["series"] == Json::parse(R"([{"name":"Speed","about":"TPDO1, 2001h:00","unit":"rpm","colour":"","node":6,
                                           "time":[1000000,3000000],"value":[1.0,null]}])"));
  CHECK(data["causes"] == Json::parse(R"([{"title":"Too high","text":"The value is out of range.","check":"the range",
                                           "fix":"write 60","node":5,"since":1.5,"until":2,"times":[1.5,2]},
                                          {"title":"Cable","text":"","check":"","fix":"","node":0,"since":0,"until":0,
                                           "times":[]}])"));
}

TEST_CASE("picture: a text of the bus cannot end the data, and only scripts with the number of the page may run") {
  Picture picture;
  const std::string evil = "</script><img src=x onerror=alert(1)>\xFF %DATA% %NONCE%";
  picture.add_line(0, event_of(Service::sdo, 5), evil);
  const std::string page = picture.page({}, {});
  CHECK(page.find("<img") == std::string::npos);
  CHECK(data_of(page)["texts"][0] == "</script><img src=x onerror=alert(1)>\uFFFD %DATA% %NONCE%");
  CHECK(page.find("script-src 'nonce-%") == std::string::npos);
  CHECK(page != picture.page({}, {}));
}

TEST_CASE("picture: the numbers of lines, values, curves and steps of the load are bounded") {
  Picture picture;
  for (std::size_t n = 0; n < Picture::most_lines + 3; ++n) {
    picture.add_line(n, event_of(Service::sync, 0), "SYNC");
  }
  CHECK(picture.lines() == Picture::most_lines);
  CHECK(picture.omitted_lines() == 3);
  PictureSeries series;
  series.times.assign(Picture::most_values + 2, 1);
  series.values.assign(Picture::most_values + 2, 1);
  picture.add_series(series);
  picture.add_values(0, {6, true, 1, {{0x2001, 0, "Speed", "", 1.0, ""}}});
  CHECK(picture.values() == Picture::most_values);
  CHECK(picture.omitted_values() == 3);
  for (const Micros time : {Micros{0}, Micros{999}, Micros{2'047'999}, Micros{2'048'000}, Micros{400'000'000'000}}) {
    picture.count(time, frame_of(0x185));
  }
  picture.count(1, frame_of(CO_IF_FRM_ERROR | 4));
  const Json data = data_of(picture.page({}, {}));
  CHECK(data["omitted"] == Json{{"lines", 3}, {"values", 3}});
  const Json& load = data["load"];
  CHECK(load["frames"].size() <= Picture::most_bins);
  CHECK(load["frames"][0] == 4);
  CHECK(load["errors"][0] == 1);
  CHECK(load["frames"].back() == 1);
  CHECK(400'000'000'000 / load["step"].get<Micros>() == load["frames"].size() - 1);
  CHECK(load["bits"][0] > 4 * 100);

  Picture curves;
  for (std::size_t n = 0; n < Picture::most_series + 1; ++n) {
    curves.add_values(0, {6, true, 1, {{static_cast<std::uint16_t>(n), 0, "Speed", "", 1.0, ""}}});
  }
  CHECK(curves.omitted_values() == 1);
}

/// Returns why a CSV is refused; empty: it is read.
std::string fault_of_csv(const std::string& text, RecorderCurve& curve) {
  std::istringstream input(text);
  std::string why;
  const bool is_read = read_recorder_csv(input, curve, why);
  CHECK(is_read == why.empty());
  return why;
}

std::string fault_of_csv(const std::string& text) {
  RecorderCurve curve;
  return fault_of_csv(text, curve);
}

bool begins(const std::string& text, const std::string& part) { return text.compare(0, part.size(), part) == 0; }

TEST_CASE("recorder's CSV: points and what describes them") {
  RecorderCurve curve;
  CHECK(fault_of_csv("# name: a<b & c\n# object: 2110h:00\n# colour: C00000\n# trigger: 5\n# any\n0;1\r\n10;-2\r\n",
                     curve) == "");
  CHECK(curve.name == "a<b & c");
  CHECK(curve.object == "2110h:00");
  CHECK(curve.colour == "C00000");
  CHECK(curve.has_trigger);
  CHECK(curve.trigger == 5);
  REQUIRE(curve.points.size() == 2);
  CHECK(curve.points[1].time == 10);
  CHECK(curve.points[1].value == -2);

  RecorderCurve wrapped;
  CHECK(fault_of_csv("# trigger: 4294967291\n4294967290;1\n5;4294967295", wrapped) == "");
  CHECK(wrapped.name == "value");
  CHECK(wrapped.trigger == 4294967291);
  CHECK(wrapped.points[1].time == 4294967301);
  CHECK(wrapped.points[1].value == 4294967295);

  RecorderCurve early;
  CHECK(fault_of_csv("# trigger: 3\n5;1\n", early) == "");
  CHECK(!early.has_trigger);
}

TEST_CASE("recorder's CSV: malformed lines are refused with their number") {
  CHECK(begins(fault_of_csv("1;1\nabc\n"), "2: no ';' in 'abc'; a line is 'time;value': "));
  CHECK(begins(fault_of_csv("1;1\n\n2;2\n"), "2: no ';' in ''; "));
  CHECK(begins(fault_of_csv("-1;1\n"), "1: wrong time '-1'; write milliseconds, "));
  CHECK(begins(fault_of_csv("1;4294967296\n"), "1: wrong value '4294967296'; write a number, "));
  CHECK(begins(fault_of_csv("1;2;3\n"), "1: wrong value '2;3'; "));
  CHECK(begins(fault_of_csv("5;1\n4;2\n"), "2: time 4 is before that of the previous point, 5; "));
  CHECK(begins(fault_of_csv("# colour: red\n1;1\n"), "1: wrong colour 'red'; write six "));
  CHECK(begins(fault_of_csv("# trigger: x\n1;1\n"), "1: wrong time of the trigger 'x'; "));
  CHECK(begins(fault_of_csv("# name: speed\n"), " no points; read the plot "));
}

}  // namespace
