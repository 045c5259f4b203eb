// SPDX-License-Identifier: Apache-2.0
// Tests lexican-demo-master with the demo clock at the other end of a virtual bus.
#include "co_cfg.h"

#if USE_CSDO  // the demo's master needs it
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "client/arguments.hpp"
#include "client/nmt.hpp"
#include "client/request.hpp"
#include "demo_simulation.hpp"
#include "linux_node/clock.hpp"
#include "support/notation.hpp"

namespace {

using co::VirtualBus;
using lexican::Arguments;
using lexican::Bytes;
using lexican::Progress;
using lexican::second;

struct Desk {
  Desk() {
    REQUIRE(clock.start());
    host.others = [this] { return clock.node().process(); };
    host.bus.set_trace([this](const VirtualBus::Traffic& traffic) { frames.push_back(test::notation(traffic.frame)); });
  }

  /// Runs the program and returns its exit code.
  int run(const Arguments& arguments) {
    out.str("");
    err.str("");
    frames.clear();
    const lexican::Prepared prepared = lexican::prepare(arguments);
    REQUIRE(prepared.fault == "");
    const lexican::Outcome outcome = lexican::carry_out(prepared.request, host, form, err);
    return lexican::report(prepared.request, outcome, out, err);
  }

  bool was_sent(const char* frame) const { return std::find(frames.begin(), frames.end(), frame) != frames.end(); }

  test::SimulatedHost host;
  Progress::Form form = Progress::Form::none;
  std::ostringstream out;
  std::ostringstream err;
  std::vector<std::string> frames;  // frames on the bus in the last run
  lexican::demo::Clock clock{5, host.device_can(), host.device_timer(), {}};
};

Arguments to_read(const char* index, const char* sub, const char* type) {
  Arguments arguments;
  arguments.node = "5";
  arguments.index = index;
  arguments.sub = sub;
  arguments.type = type;
  return arguments;
}

Arguments to_write(const char* index, const char* sub, const char* type, const char* value) {
  Arguments arguments = to_read(index, sub, type);
  arguments.write = true;
  arguments.value = value;
  return arguments;
}

/// A file that is removed at the end of the test case.
class File {
 public:
  ~File() { std::remove(name.c_str()); }
  void put(const std::string& content) const { std::ofstream(name, std::ios::binary) << content; }
  std::string content() const {
    std::ifstream in(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const std::string name = (std::filesystem::temp_directory_path() / "lexican_demo_master_test").string();
};

std::string picture(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = static_cast<char>(i * 7 + i / 256);
  }
  return bytes;
}

}  // namespace

TEST_CASE("demo master: standard output contains only the value that was read") {
  Desk desk;
  CHECK(desk.run(to_read("0x1018", "2", "u32")) == 0);
  CHECK(desk.out.str() == "49420\n");
  CHECK(desk.err.str() == "");
  CHECK(desk.run(to_read("0x1018", "2", "")) == 0);
  CHECK(desk.out.str() == "0x0000C10C\n");
  CHECK(desk.run(to_read("0x1008", "0", "string")) == 0);
  CHECK(desk.out.str() == "Lexican demo clock\n");
}

TEST_CASE("demo master: name and versions of the device are shown as text, untyped objects as bytes") {
  Desk desk;
  CHECK(desk.run(to_read("1008", "0", "")) == 0);
  CHECK(desk.out.str() == "Lexican demo clock\n");
  CHECK(desk.run(to_read("1009", "0", "")) == 0);  // four bytes that are not a number
  CHECK(desk.out.str() == "host\n");
  CHECK(desk.run(to_read("1008", "0", "bytes")) == 0);
  CHECK(desk.out.str() == "4C 65 78 69 63 61 6E 20 64 65 6D 6F 20 63 6C 6F 63 6B\n");
  CHECK(desk.run(to_write("2201", "0", "string", "Halt 7 and more")) == 0);
  CHECK(desk.run(to_read("2201", "0", "")) == 0);
  CHECK(desk.out.str() == "00000000  48 61 6C 74 20 37 20 61 6E 64 20 6D 6F 72 65     |Halt 7 and more|\n");
}

TEST_CASE("demo master: it boots with its own node-ID and uses the default SDO of the node [301:7.3.3]") {
  Desk desk;
  CHECK(desk.run(to_read("0x2100", "1", "u8")) == 0);
  CHECK(desk.frames == std::vector<std::string>{"77F#00", "605#4000210100000000", "585#4F00210100000000"});
  Arguments arguments = to_read("0x2100", "1", "u8");
  arguments.own_id = "3";
  CHECK(desk.run(arguments) == 0);
  CHECK(desk.frames[0] == "703#00");
}

TEST_CASE("demo master: a written value is read back") {
  Desk desk;
  CHECK(desk.run(to_write("0x2100", "1", "u8", "23")) == 0);
  CHECK(desk.out.str() == "");
  CHECK(desk.err.str() == "");
  CHECK(lexican::demo::Clock::time().hour == 23);
  CHECK(desk.run(to_write("0x2201", "0", "string", "Halt 7")) == 0);
  CHECK(desk.run(to_read("0x2201", "0", "bytes")) == 0);
  CHECK(desk.out.str() == "48 61 6C 74 20 37\n");
}

TEST_CASE("demo master: an abort is printed as text, with status 1") {
  Desk desk;
  CHECK(desk.run(to_write("0x2100", "1", "u8", "24")) == 1);
  CHECK(desk.err.str() == "node 5, 2100h:01: aborted with 0609 0031h value too high\n");
  CHECK(desk.run(to_read("0x2FFF", "0", "")) == 1);
  CHECK(desk.out.str() == "");
  CHECK(desk.err.str() == "node 5, 2FFFh:00: aborted with 0602 0000h object does not exist\n");
}

TEST_CASE("demo master: a value whose length differs from its type is not shown, with status 1") {
  Desk desk;
  CHECK(desk.run(to_read("0x1018", "2", "u16")) == 1);
  CHECK(desk.out.str() == "");
  CHECK(desk.err.str() == "node 5, 1018h:02: the object has 4 bytes, a value of this type has 2\n");
  CHECK(desk.run(to_read("0x2200", "0", "u16")) == 1);
  CHECK(desk.err.str() ==
        "node 5, 2200h:00: aborted with 0504 0005h out of memory; the object has more than 28 bytes\n");
}

TEST_CASE("demo master: a missing node causes a time-out with status 1") {
  Desk desk;
  Arguments arguments = to_read("0x1000", "0", "");
  arguments.node = "6";
  arguments.timeout = "250";
  const lexican::Micros begin = desk.host.now();
  CHECK(desk.run(arguments) == 1);
  CHECK(desk.host.now() - begin >= 250 * lexican::millisecond);
  CHECK(desk.host.now() - begin < second);
  CHECK(desk.err.str() == "node 6, 1000h:00: no answer; is node 6 on this bus, with power, and at this bit rate?\n");
  CHECK(desk.was_sent("606#8000100000000405"));
}

TEST_CASE("demo master: a bus error is printed") {
  Desk desk;
  desk.host.fault = "CAN interface 'can0' is down";
  desk.host.bus.add_rule({VirtualBus::Fault::error, {}, 1, VirtualBus::always});
  CHECK(desk.run(to_read("0x1000", "0", "")) == 1);
  CHECK(desk.err.str() == "node 5, 1000h:00: no answer\nCAN interface 'can0' is down\n");
}

TEST_CASE("demo master: a file is written and read back unchanged, by block transfer if supported") {
  Desk desk;
  const File file;
  const std::string content = picture(lexican::demo::picture_size);
  file.put(content);
  Arguments write = to_read("0x2200", "0", "domain");
  write.write = true;
  write.file = file.name;
  CHECK(desk.run(write) == 0);
  CHECK(desk.was_sent(CO_CSDO_BLOCK != 0 ? "605#C600220000200100" : "605#2100220000200100"));
  file.put("something else");
  Arguments read = to_read("0x2200", "0", "");
  read.file = file.name;
  CHECK(desk.run(read) == 0);
  CHECK(desk.was_sent(CO_CSDO_BLOCK != 0 ? "605#A40022007F1C0000" : "605#4000220000000000"));
  CHECK(desk.out.str() == "");
  CHECK(desk.err.str() == "");
  CHECK((file.content() == content));
  read.file = "-";
  CHECK(desk.run(read) == 0);
  CHECK((desk.out.str() == content));
}

TEST_CASE("demo master: an object above the size limit is not read") {
  Desk desk;
  Arguments arguments = to_read("0x2200", "0", "bytes");
  arguments.max = "1000";
  CHECK(desk.run(arguments) == 1);
  CHECK(desk.err.str() ==
        "node 5, 2200h:00: aborted with 0504 0005h out of memory; the object has more than 1000 bytes\n");
}

TEST_CASE("demo master: a file that cannot be written is an error with status 2; a failed read does not change it") {
  Desk desk;
  Arguments arguments = to_read("0x1008", "0", "string");
  arguments.file = (std::filesystem::temp_directory_path() / "lexican_no_such_directory" / "file").string();
  CHECK(desk.run(arguments) == 2);
  CHECK(desk.err.str() == "cannot write '" + arguments.file + "': No such file or directory\n");
  const File file;
  file.put("kept");
  arguments = to_read("0x2FFF", "0", "");
  arguments.file = file.name;
  CHECK(desk.run(arguments) == 1);
  CHECK(file.content() == "kept");
}

#if USE_NMT_MASTER
TEST_CASE("demo master: an NMT command is one message after the boot-up message of the master [301:7.2.8.3.1]") {
  Desk desk;
  const auto run = [&desk](const char* command, const char* node) {
    const lexican::NmtPrepared prepared = lexican::prepare(lexican::NmtArguments{command, node, ""});
    REQUIRE(prepared.fault == "");
    desk.err.str("");
    desk.frames.clear();
    return lexican::carry_out(prepared.request, desk.host, desk.err);
  };
  CHECK(run("start", "5") == 0);
  CHECK(desk.frames == std::vector<std::string>{"77F#00", "000#0105"});
  CHECK(desk.err.str() == "");
  desk.clock.node().process();
  CHECK(CONmtGetMode(&desk.clock.node().stack().Nmt) == CO_OPERATIONAL);
  CHECK(run("stop", "6") == 0);
  CHECK(desk.was_sent("000#0206"));
  CHECK(run("preop", "all") == 0);
  CHECK(desk.was_sent("000#8000"));
  desk.clock.node().process();
  CHECK(CONmtGetMode(&desk.clock.node().stack().Nmt) == CO_PREOP);
  CHECK(run("reset-node", "127") == 0);
  CHECK(desk.frames == std::vector<std::string>{"77E#00", "000#817F"});
  CHECK(run("reset-comm", "5") == 0);
  CHECK(desk.was_sent("000#8205"));
  desk.clock.node().process();
  CHECK(desk.was_sent("705#00"));
}

TEST_CASE("demo master: an NMT command that the bus refuses is a failure") {
  Desk desk;
  desk.host.fault = "CAN interface 'can0' is down";
  desk.host.bus.add_rule({VirtualBus::Fault::error, {}, 1, VirtualBus::always});
  const lexican::NmtPrepared prepared = lexican::prepare(lexican::NmtArguments{"start", "5", ""});
  CHECK(lexican::carry_out(prepared.request, desk.host, desk.err) == 1);
  CHECK(desk.err.str() == "NMT: CAN interface 'can0' is down\n");
}

TEST_CASE("demo master: an error of the stack is reported by its name and meaning") {
  Desk desk;
  CHECK(lexican::carry_out(lexican::NmtRequest{lexican::NmtCommand::start, 128, 127}, desk.host, desk.err) == 1);
  CHECK(desk.err.str() == std::string("NMT: CO_ERR_BAD_ARG: ") + COErrText(CO_ERR_BAD_ARG) + "\n");
}
#endif

TEST_CASE("demo master: an interrupt aborts the transfer with status 130 [301:7.2.4.3.17]") {
  Desk desk;
  Arguments arguments = to_read("0x1000", "0", "");
  arguments.node = "6";
  desk.host.interrupted_at = desk.host.now() + 100 * lexican::millisecond;
  desk.host.others = [&] {
    desk.host.pass(lexican::millisecond);
    return true;
  };
  CHECK(desk.run(arguments) == 130);
  CHECK(desk.out.str() == "");
  CHECK(desk.err.str() == "node 6, 1000h:00: cancelled\n");
  CHECK(desk.was_sent("606#8000100021000008"));
}

TEST_CASE("demo master: the abort of a cancelled transfer is sent on a busy bus") {
  Desk desk;
  Arguments arguments = to_read("0x1000", "0", "u32");
  arguments.node = "6";
  desk.host.bus.add_rule({VirtualBus::Fault::refuse, {}, 1, 20});  // boot-up, request and abort are queued
  desk.host.interrupted_at = desk.host.now() + 2 * lexican::millisecond;
  CHECK(desk.run(arguments) == 130);
  CHECK(desk.frames == std::vector<std::string>{"77F#00", "606#4000100000000000", "606#8000100021000008"});
}

TEST_CASE("demo master: progress is written to standard error, in lines or as a bar that ends with its last state") {
  Desk desk;
  const File file;
  Arguments arguments = to_read("0x2200", "0", "");
  arguments.file = file.name;
  desk.form = Progress::Form::lines;
  CHECK(desk.run(arguments) == 0);
#if CO_CSDO_BLOCK > 0  // progress counts whole sub-blocks
  CHECK(desk.err.str().find("]  25 %  18669 of 73728 bytes\n") != std::string::npos);
#endif
  CHECK(desk.err.str().find("] 100 %  73728 of 73728 bytes\n") != std::string::npos);
  desk.form = Progress::Form::bar;
  desk.host.others = [&] {  // each sub-block takes 10 ms
    desk.clock.node().process();
    desk.host.pass(10 * lexican::millisecond);
    return true;
  };
  CHECK(desk.run(arguments) == 0);
  CHECK(desk.err.str().find("\r[") == 0);
  const std::string last = "\r[##############################] 100 %  73728 of 73728 bytes, ";
  CHECK(desk.err.str().rfind('\r') == desk.err.str().rfind(last));
  CHECK(desk.err.str().back() == '\n');
}
#endif
