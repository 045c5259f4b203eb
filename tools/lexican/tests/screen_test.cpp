// SPDX-License-Identifier: Apache-2.0
// The screen of `lexican top` as text, by frames byte by byte.
#include "program/screen.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace lexican;
using namespace lexican::program;
using host_bus::Micros;

constexpr Micros begin_time = 1'000'000'000;
constexpr Micros screen_second = 1'000'000;

/// A bus whose screen is drawn.
struct Watched {
  describe::Network network;
  View view;
  BusState state;
  Micros now = begin_time;

  explicit Watched(const std::string& description = {})
      : network(described(description)), state(network, [](std::uint8_t, const describe::Identity&) { return false; }) {
    view.bus = "hub:bench";
    state.advance(now);
  }

  static describe::Network described(const std::string& text) {
    describe::Network network;
    if (!text.empty()) {
      char path[] = "/tmp/lexican-screen-XXXXXX";
      close(mkstemp(path));
      std::ofstream(path) << text;
      std::string why;
      REQUIRE_MESSAGE(network.add(path, why), why);
      std::filesystem::remove(path);
    }
    return network;
  }

  void frame(std::uint32_t id, const std::vector<std::uint8_t>& bytes) {
    host_bus::Entry entry;
    entry.time = now;
    entry.frame.Identifier = id;
    entry.frame.DLC = static_cast<std::uint8_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), entry.frame.Data);
    state.process(entry);
  }
  void pass(Micros time) {
    now += time;
    state.advance(now);
  }

  /// Returns the lines without spaces at their ends. No line is longer than the screen, and there are as many.
  std::vector<std::string> lines(unsigned columns = 80, unsigned rows = 24) const {
    const Screen screen = draw(state, view, columns, rows);
    CHECK(screen.lines.size() == rows);
    std::vector<std::string> result;
    for (const ScreenLine& line : screen.lines) {
      std::string text;
      for (const Piece& piece : line) {
        text += piece.text;
      }
      CHECK_MESSAGE(width_of(text) <= columns, text);
      text.erase(text.find_last_not_of(' ') + 1);
      result.push_back(text);
    }
    return result;
  }
  std::string text(unsigned columns = 80, unsigned rows = 24) const {
    std::string result;
    for (const std::string& line : lines(columns, rows)) {
      result += line + '\n';
    }
    return result;
  }
  /// Returns the texts in a colour.
  std::string in_colour(Colour colour) const {
    std::string result;
    for (const ScreenLine& line : draw(state, view, 80, 24).lines) {
      for (const Piece& piece : line) {
        result +=
            piece.colour == colour && piece.text.find_first_not_of(' ') != std::string::npos ? piece.text + '|' : "";
      }
    }
    return result;
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// TPDO1 of node 5 transmits 6041h (u16) and 606Ch (i32).
constexpr const char* drive = R"([DeviceInfo]
ProductName=SD-400
[DeviceCommissioning]
NodeID=5
[MandatoryObjects]
SupportedObjects=1
1=0x1000
[1000]
ParameterName=Device type
DataType=7
AccessType=ro
[OptionalObjects]
SupportedObjects=4
1=0x1800
2=0x1A00
3=0x6041
4=0x606C
[1800]
ParameterName=TPDO1
ObjectType=9
SubNumber=3
[1800sub0]
ParameterName=count
DataType=5
AccessType=ro
DefaultValue=2
[1800sub1]
ParameterName=COB-ID
DataType=7
AccessType=rw
DefaultValue=$NODEID+0x180
[1800sub2]
ParameterName=type
DataType=5
AccessType=rw
DefaultValue=255
[1A00]
ParameterName=Mapping
ObjectType=9
SubNumber=3
[1A00sub0]
ParameterName=count
DataType=5
AccessType=rw
DefaultValue=2
[1A00sub1]
ParameterName=1
DataType=7
AccessType=rw
DefaultValue=0x60410010
[1A00sub2]
ParameterName=2
DataType=7
AccessType=rw
DefaultValue=0x606C0020
[6041]
ParameterName=Statusword
DataType=6
AccessType=ro
PDOMapping=1
[606C]
ParameterName=Velocity actual value
DataType=4
AccessType=ro
PDOMapping=1
)";

TEST_CASE("screen: a bus without frames, and the keys") {
  Watched bus;
  const std::vector<std::string> lines = bus.lines();
  CHECK(lines.front() == " hub:bench  load -  0 frames/s  0 lost  no frame yet");
  CHECK(has(bus.text(), "no node was heard; s scans"));
  CHECK(lines.back() == "r read  w write  n NMT  s scan  / filter  ? help  q quit");
  bus.view.has_help = true;
  CHECK(has(bus.text(), "NMT: start, stop, preop, reset, reset-comm"));
}

TEST_CASE("screen: title with load, rate and lost frames") {
  Watched bus;
  bus.view.bit_rate = 500'000;
  bus.view.lost = 7;
  for (int n = 0; n < 1000; ++n) {
    bus.frame(0x185, {1, 2, 3, 4, 5, 6, 7, 8});
    bus.pass(1000);
  }
  bus.pass(1);
  const std::string title = bus.lines().front();
  CHECK(has(title, " hub:bench 500 kbit/s  load 2"));  // 1000 frames of about 120 bits
  CHECK(has(title, " 1000 frames/s  7 lost  ok"));
  bus.view.condition = "the adapter is gone";
  CHECK(has(bus.lines().front(), "7 lost  the adapter is gone"));
  CHECK(has(bus.in_colour(Colour::red), "the adapter is gone"));
}

TEST_CASE("screen: state of a node, heartbeat overdue, EMCY") {
  Watched bus;
  bus.frame(0x705, {0x00});
  CHECK(has(bus.text(), "   5 boot-up             <1 s   -"));
  for (int n = 0; n < 3; ++n) {
    bus.pass(screen_second);
    bus.frame(0x705, {0x05});
  }
  CHECK(has(bus.in_colour(Colour::green), "operational"));
  bus.pass(3 * screen_second);
  CHECK(has(bus.text(), "   5 operational          3 s   -"));
  CHECK(bus.in_colour(Colour::red).empty());
  bus.pass(screen_second);
  CHECK(has(bus.text(), "   5 operational          4 s!  -"));
  CHECK(has(bus.in_colour(Colour::red), "operational"));
  bus.frame(0x705, {0x7F});
  CHECK(bus.in_colour(Colour::red).empty());
  bus.frame(0x085, {0x10, 0x43, 0x09, 0, 0, 0, 0, 0});
  bus.pass(2 * screen_second);
  CHECK(has(bus.in_colour(Colour::red), "2 s: 4310h"));
  bus.frame(0x085, {0, 0, 0, 0, 0, 0, 0, 0});
  CHECK(has(bus.text(), "<1 s: 0000h"));
}

TEST_CASE("screen: values of PDOs with a plot") {
  Watched bus(drive);
  bus.state.set_name(5, "SD-400");
  bus.frame(0x705, {0x05});
  CHECK(has(bus.text(), "PDO values of node 5\nnone was received"));
  for (std::uint8_t n = 0; n < 100; ++n) {
    bus.pass(screen_second / 10);
    bus.frame(0x185, {0x37, 0x02, n, 0, 0, 0});
  }
  const std::string text = bus.text();
  CHECK(has(text, "TPDO1 Statusword"));
  CHECK(has(text, "567"));
  CHECK(has(text, "TPDO1 Velocity actual value     99 "));
  CHECK(has(text, "⠋"));
  CHECK(has(text, "SD-400"));
  CHECK_FALSE(has(text, "TPDO1 Statusword ="));  // PDOs are no events
  bus.view.has_unicode = false;
  for (const char c : bus.text()) {
    CHECK(static_cast<unsigned char>(c) < 0x80);
  }
  CHECK_FALSE(has(bus.text(40, 10), "TPDO1"));
  CHECK(has(bus.text(40, 10), "Statusword"));
}

TEST_CASE("screen: a node without description says what is missing") {
  Watched bus;
  bus.frame(0x185, {1, 2});
  CHECK(has(bus.text(), "   5 not seen               -   -"));
  CHECK(has(bus.text(), "they need a description: --eds FILE"));
}

TEST_CASE("screen: events, and their filter") {
  Watched bus;
  bus.frame(0x000, {0x01, 0x05});
  bus.pass(screen_second);
  bus.frame(0x085, {0x10, 0x43, 0x09, 0, 0, 0, 0, 0});
  bus.frame(0x705, {0x05});
  bus.frame(0x705, {0x05});
  CHECK(has(bus.text(), "    0.000   5  NMT start, node 5\n    1.000   5  EMCY 4310h"));
  CHECK(has(bus.in_colour(Colour::red), "    1.000   5  EMCY 4310h"));
  bus.view.filter = "nmt";
  CHECK(has(bus.text(), "events with 'nmt'\n    0.000   5  NMT start, node 5\n\n"));
  for (int n = 0; n < 2000; ++n) {
    bus.frame(0x000, {0x01, 0x05});
  }
  CHECK(bus.state.events().size() == BusState::most_events);
}

TEST_CASE("screen: no control characters of devices, files and the user") {
  Watched bus;
  const std::string bad =
      "a\x1b[2Jb\x07\xC2\x9B"
      "c\nd\xFF\xE2\x80\xAE";
  bus.state.note(bad, false);
  bus.frame(0x705, {0x05});
  CHECK(has(bus.text(), "a?[2Jb??c?d??"));
  // A device name that an SDO client reads, as an event.
  bus.frame(0x605, {0x40, 0x08, 0x10, 0x00, 0, 0, 0, 0});
  bus.frame(0x585, {0x43, 0x08, 0x10, 0x00, 'x', 0x1B, 0x9B, 'y'});
  const std::string text = bus.text();
  CHECK(has(text, "1008h"));
  for (const char c : text) {
    CHECK((c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F)));
  }
  CHECK_FALSE(has(text, "\xC2\x9B"));
}

TEST_CASE("screen: no control characters in names and texts of values") {
  std::string description = drive;
  description.replace(description.find("Statusword"), 10, "St\x1b[2J\x07\xC2\x9B!");
  description.replace(description.find("DataType=6\n"), 11, "DataType=9\n");  // a string
  description.replace(description.find("0x60410010"), 10, "0x60410020");
  Watched bus(description);
  bus.state.set_name(5, "a\nb\x1b");
  bus.frame(0x185, {'x', 0x1B, '\n', 0x9B, 1, 0, 0, 0});
  for (const unsigned columns : {80U, 40U}) {
    const std::string text = bus.text(columns);
    CHECK(has(text, "St?[2J?"));
    CHECK(has(text, "Velocity"));
    for (const char c : text) {
      CHECK((c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F)));
    }
    CHECK_FALSE(has(text, "\xC2\x9B"));
    CHECK(std::count(text.begin(), text.end(), '\n') == 24);
  }
  CHECK(has(bus.text(), "a?b?"));
}

TEST_CASE("screen: a small one has the number of nodes, all keys, and the whole help") {
  Watched bus;
  CHECK(bus.lines(40, 10).back() == "r w n s /  ? help  q quit");
  for (std::uint32_t node = 1; node <= 127; ++node) {
    bus.frame(0x700 + node, {0x05});
  }
  CHECK(bus.lines(40, 10)[1] == "node (1 of 127)         heard  EMCY");
  CHECK(bus.lines(40, 12)[1] == "node (1-2 of 127)       heard  EMCY");
  bus.view.selected = 127;
  CHECK(bus.lines(40, 12)[1] == "node (126-127 of 127)   heard  EMCY");
  bus.view.has_help = true;
  CHECK(bus.lines(40, 10)[1] == "Up, Down, PgUp, PgDn  select a node");
  CHECK(bus.lines(40, 10).back() == "Up, Down scroll; other keys end the help");
  bus.view.help_line = 1;
  CHECK(bus.lines(40, 10)[1] == "Left, Right           values that do");
  bus.view.help_line = 1000;
  CHECK(bus.lines(40, 10)[8] == "--type u16 behind an object: its type");
  CHECK(draw(bus.state, bus.view, 40, 10).help_line < 10);
  CHECK(bus.lines()[1] == "Up, Down, PgUp, PgDn  select a node");
  CHECK(bus.lines().back() == "each key ends the help");
}

TEST_CASE("screen: wide and combining characters do not shift columns") {
  Watched bus;
  bus.frame(0x705, {0x05});
  bus.state.set_name(5, "名前名前名前名前名前名前名前名前名前名前");
  CHECK(has(bus.text(), "名前"));
  CHECK(has(bus.text(), "…"));
  bus.state.set_name(5, "e\u0301 x");
  CHECK(has(bus.text(), "e? x"));
}

TEST_CASE("screen: 127 nodes, and frames of all identifiers") {
  Watched bus;
  for (std::uint32_t id = 0; id < 0x800; ++id) {
    bus.frame(id, {0x05, 0x05, 0x05, 0x05, 0x05, 0x05, 0x05, 0x05});
    bus.frame(id, {0x05});
    bus.frame(id | CO_IF_FRM_EXT, {});
    bus.frame(id | CO_IF_FRM_RTR, {});
    bus.frame(id | CO_IF_FRM_ERROR, {0, 0, 0, 0, 0, 0, 0, 0});
  }
  CHECK(bus.state.heard().size() == 127);
  bus.view.selected = 100;
  const std::string text = bus.text();
  CHECK(has(text, " of 127)"));
  CHECK(has(text, "\n 100 operational"));
  bus.view.selected = 127;
  CHECK(has(bus.text(), "\n 127 operational"));
  bus.view.selected = 1;
  CHECK(has(bus.text(), "\n   1 operational"));
  CHECK(has(bus.lines().front(), "error frames"));
}

TEST_CASE("screen: each size") {
  Watched bus(drive);
  bus.view.result = "a result that is longer than a line of a small screen\nand a second line";
  bus.view.command = "lexican read 5 606C -i hub:bench";
  for (std::uint8_t node = 1; node < 20; ++node) {
    bus.frame(0x700U + node, {0x05});
    bus.frame(0x185, {0x37, 0x02, node, 0, 0, 0});
  }
  for (unsigned columns = 1; columns < 200; columns += columns < 90 ? 1 : 10) {
    for (unsigned rows = 1; rows < 60; ++rows) {
      bus.lines(columns, rows);
    }
  }
  const std::vector<std::string> lines = bus.lines(40, 10);
  CHECK(has(bus.text(40, 10), "\n   1 operational"));
  CHECK(has(bus.text(40, 10), "events"));
  CHECK(lines[8] == "and a second line");
  CHECK(lines[9] == "lexican read 5 606C -i hub:bench");
}

TEST_CASE("screen: a prompt shows the end of what is typed") {
  Watched bus;
  bus.view.prompt = "read from node 5, object:";
  bus.view.input = "velocity";
  Screen screen = draw(bus.state, bus.view, 80, 24);
  CHECK(bus.lines().back() == "read from node 5, object: velocity");
  CHECK(screen.cursor == 34);
  screen = draw(bus.state, bus.view, 10, 24);
  CHECK(bus.lines(10).back() == " velocity");
  CHECK(screen.cursor == 9);
}

}  // namespace
