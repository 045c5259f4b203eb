// SPDX-License-Identifier: Apache-2.0
// The program lexican from outside, on a hub with simulated devices (device.cpp): standard output, standard error
// output and exit status.
#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <list>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "program_bench.hpp"

using namespace test;

namespace {

const std::string heartbeat = "1017h:00 producer heartbeat time = 50 (u16)\n";

}  // namespace

TEST_CASE("lexican: without arguments all verbs are listed") {
  check(run({}), 0,
        "Finds, watches, reads and writes CANopen devices on any CAN bus.\n"
        "\n"
        "  scan       Find the devices of a bus: state, profile, identity and name\n"
        "  mon        Show in words what happens on a bus, or in a log\n"
        "  top        Show nodes, values and events of a bus on a live screen\n"
        "  why        Name the causes of faults on a bus, or in a log\n"
        "  read       Read an object of a device\n"
        "  write      Write an object of a device\n"
        "  pdo        Show, change, watch and send PDOs\n"
        "  dump       Read the configuration of a device into a DCF\n"
        "  apply      Write the configuration of a DCF into a device\n"
        "  nmt        Change the NMT state of a device, or of all\n"
        "  lss        Give devices a node-ID or a bit rate by LSS\n"
        "  sim        Simulate the device of a description\n"
        "  share      Hand one adapter to many programs\n"
        "  completion Print what a shell needs to complete verbs and options\n"
        "  man        Print the manual page, for man -l or man1\n"
        "  help       Show all verbs, or the options and examples of a verb\n"
        "\n"
        "lexican VERB --help shows options and examples. Begin with: lexican scan -i BUS\n",
        "");
  check(run({"--version"}), 0, "lexican " LEXICAN_VERSION "\n", "");
  CHECK(has(run({"--help"}).out, "Exit status: 0 all is well"));
}

TEST_CASE("lexican: the help of each verb has its options and examples") {
  for (const char* verb : {"scan", "mon", "top", "why", "read", "write", "nmt"}) {
    CAPTURE(verb);
    const Ran ran = run({verb, "--help"});
    CHECK(ran.status == 0);
    CHECK(ran.err.empty());
    CHECK(has(ran.out, "-i,--bus"));
    CHECK(std::regex_search(ran.out, std::regex("\n +slcan:/dev/ttyACM0@500k: a serial or USB adapter\n")));
    CHECK(std::regex_search(ran.out, std::regex("\n +can0: a CAN interface of Linux\n")));
    CHECK(has(ran.out, "--json"));
    CHECK(has(ran.out, std::string("Examples:\n  lexican ") + verb));
  }
}

TEST_CASE("lexican: help shows all verbs, or the help of a verb") {
  CHECK(run({"help"}).out == run({}).out);
  for (const char* verb : {"scan", "sc", "help"}) {
    CAPTURE(verb);
    check(run({"help", verb}), 0, run({verb, "--help"}).out, "");
  }
  check(run({"help", "scna"}), 2, "", "lexican: unknown verb scna; did you mean scan?\n");
  CHECK(run({"help", "scan", "more"}).status == 2);
}

TEST_CASE("lexican: completion has the first line of an option's help") {
  CHECK(has(run({"completion", "zsh"}).out, "[Bus; default\\: $LEXICAN_BUS]"));
  CHECK(has(run({"completion", "fish"}).out, "'Bus; default: $LEXICAN_BUS'"));
  CHECK(has(run({"man"}).out, "\n  replay:FILE: a log"));
}

namespace {

/// Returns the words that bash offers as completion.
std::string completed(const std::string& words) {
  const Bench bench;
  return bench
      .run_shell("\"$0\" completion | bash -c 'source /dev/stdin; COMP_WORDS=(" + words +
                 "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _lexican; echo \"${COMPREPLY[*]}\"'")
      .out;
}

}  // namespace

TEST_CASE("lexican: completion offers the words of arguments and options") {
  CHECK(completed("lexican nmt \"\"") == "start stop preop reset reset-comm\n");
  CHECK(completed("lexican lss s") == "scan\n");
  CHECK(completed("lexican pdo wa") == "watch\n");
  CHECK(completed("lexican completion z") == "zsh\n");
  CHECK(completed("lexican mon --service em") == "emcy\n");
  CHECK(completed("lexican read --type u1") == "u16\n");
  CHECK(completed("lexican read -i sl") == "slcan: slcan-tcp: slcan-pty\n");
  CHECK(completed("lexican scan --bus hu") == "hub:\n");
  CHECK(completed("lexican nmt --ti") == "--timeout\n");
  CHECK(completed("lexican nmt start 5") == "\n");  // bash completes files itself
  CHECK(has(run({"completion", "zsh"}).out, "'1:command:(start stop preop reset reset-comm)'"));
  CHECK(has(run({"completion", "zsh"}).out, "]:TEXT:(hub\\: "));
  CHECK(has(run({"completion", "fish"}).out, " -x -a 'hub: "));
  CHECK(has(run({"completion", "fish"}).out,
            "complete -c lexican -n '__fish_seen_subcommand_from nmt; and not __fish_seen_subcommand_from start stop "
            "preop reset reset-comm' -f -a 'start stop preop reset reset-comm'\n"));
}

TEST_CASE("lexican: an unknown verb is refused with the nearest one") {
  check(run({"scna"}), 2, "", "lexican: unknown verb scna; did you mean scan?\n");
  check(run({"frobnicate"}), 2, "", "lexican: unknown verb frobnicate; lexican --help lists all\n");
  CHECK(has(run({"--nonsense"}).err, "lexican: "));
  CHECK(run({"--nonsense"}).status == 2);
  check(run({"scan", "--nonsense"}), 2, "",
        "lexican: The following argument was not expected: --nonsense; lexican scan --help shows the options\n");
  check(
      run({"scan", "--eds", "servo.eds", "5"}), 2, "",
      "lexican: The following arguments were not expected: --eds servo.eds 5; lexican scan --help shows the options\n");
  check(run({"scan", "--timeout", "0"}), 2, "",
        "lexican: --timeout: Value 0 not in range 1 to 3600000; lexican scan --help shows the options\n");
  CHECK(run({"read", "5"}).status == 2);
  CHECK(run({"nmt", "jump", "5"}).status == 2);
}

TEST_CASE("lexican: a verb may be shortened") {
  CHECK(run({"rea", "--help"}).out == run({"read", "--help"}).out);
  CHECK(run({"sc", "--help"}).out == run({"scan", "--help"}).out);
  check(run({"s"}), 2, "", "lexican: s is the beginning of several verbs: scan, sim, share\n");
  CHECK(run({"", "--help"}).out == run({"--help"}).out);
  check(run({"reads", "5", "1000"}), 2, "", "lexican: unknown verb reads; did you mean read?\n");
}

TEST_CASE("lexican: the bus comes from -i, else from LEXICAN_BUS") {
  check(run({"scan"}), 2, "",
        "lexican: which bus? Give -i BUS, for example -i can0 or -i hub:bench, or set LEXICAN_BUS\n");
  Bench bench{5};
  CHECK(bench.run("read", {"5", "1017"}).status == 0);
  bench.set("LEXICAN_BUS", "");
  CHECK(bench.run("read", {"5", "1017"}).status == 2);
  CHECK(bench.run("read", {"5", "1017", "-i", bench.hub()}).status == 0);
  bench.set("LEXICAN_BUS", "hub:another");
  CHECK(bench.run("read", {"5", "1017", "-i", bench.hub()}).status == 0);
}

TEST_CASE("lexican: a bus that cannot be opened is a bus fault, a wrong rate is wrong use") {
  const Ran ran = run({"scan", "-i", "slcan:/nonexistent"});
  CHECK(ran.status == 4);
  CHECK(has(ran.err, "/nonexistent"));
  CHECK(run({"read", "5", "1000", "-i", "nosuchcan7"}).status == 4);
  check(run({"scan", "-i", "foo:bar"}), 2, "",
        "lexican: 'foo:bar' is no bus, which is one of:\n"
        "  hub:bench\n"
        "  replay:FILE\n"
        "  socketcand:HOST:29536/can0\n"
        "  slcan:/dev/ttyACM0@500k\n"
        "  slcan-tcp:192.168.0.7:29537\n"
        "  slcan-pty\n"
        "  can0\n");
  for (const char* name : {"slcan:/dev/null@77k", "slcan:/dev/null@fast", "slcan-tcp:127.0.0.1:1@77k"}) {
    CAPTURE(name);
    CHECK(run({"scan", "-i", name}).status == 2);
    CHECK(run({"mon", "-i", name}).status == 2);
  }
  CHECK(run({"scan", "-i", "slcan:/dev/null", "--rate", "77k"}).status == 2);
  check(run({"mon", "-i", "replay:/nonexistent.log"}), 2, "", "lexican: /nonexistent.log: No such file or directory\n");
  const std::string hub = "lexican: the name of a hub has 1 to 40 letters, digits, - and _\n";
  const std::string socketcand = "lexican: socketcand needs HOST:PORT/BUS, such as 127.0.0.1:29536/can0\n";
  const std::string slcan = "lexican: slcan needs a device, such as /dev/ttyACM0\n";
  for (const auto& [name, message] : std::vector<std::pair<std::string, std::string>>{
           {"hub:", hub},
           {"hub:a b", hub},
           {"hub:../x", hub},
           {"hub:@500k", hub},
           {"hub:x@5", "lexican: the bit rate of a hub is 10k to 1M\n"},
           {"socketcand:nowhere", socketcand},
           {"socketcand:nowhere:29536", socketcand},
           {"socketcand:nowhere/can0", socketcand},
           {"slcan:", slcan},
           {"slcan:@500k", slcan},
           {"slcan-tcp:nowhere@500k", "lexican: 'nowhere' is not HOST:PORT, such as 127.0.0.1:29537 or [::1]:29537\n"},
           {"slcan-pty7", "lexican: slcan-pty has no further name: '7'\n"}}) {
    check(run({"nmt", "start", "5", "-i", name}), 2, "", message);
    check(run({"mon", "-i", name}), 2, "", message);
  }
  for (const char* rate : {"fast", "0", "2M", "500kk", "-5"}) {
    CAPTURE(rate);
    check(run({"scan", "-i", "hub:x", "--rate", rate}), 2, "",
          std::string("lexican: '") + rate + "' is no bit rate; write 500k, 1M or 500000\n");
  }
}

TEST_CASE("lexican: a bit rate that --rate cannot set, or that contradicts the name, is wrong use") {
  const Bench bench{5};
  for (const std::string name : {"slcan:/dev/null@250k", "slcan-tcp:127.0.0.1:1@250k", "hub:x@250k"}) {
    CAPTURE(name);
    const std::string message = "lexican: " + name + " and --rate 500k are different bit rates; give one of them\n";
    check(bench.run("scan", {"-i", name, "--rate", "500k"}), 2, "", message);
    check(bench.run("mon", {"-i", name, "--rate", "500k"}), 2, "", message);
  }
  check(bench.run("read", {"5", "1008", "--rate", "500k"}), 2, "",
        "lexican: " + bench.hub() +
            " has no bit rate that --rate could set: hub:NAME@500k starts a hub with the timing of a wire\n");
  check(bench.run("read", {"5", "1008", "--rate", "500k", "-i", "socketcand:127.0.0.1:1/can0"}), 2, "",
        "lexican: socketcand:127.0.0.1:1/can0 has no bit rate that --rate could set: it is set where the server runs, "
        "ip link set can0 up type can bitrate 500000\n");
  CHECK(run({"scan", "-i", "slcan:/nonexistent@500k", "--rate", "500000"}).status == 4);
  const Bench paced;
  CHECK(paced.run("nmt", {"start", "all", "-i", paced.hub() + "@500k", "--rate", "500k"}).status == 0);
}

TEST_CASE("lexican read: a wrong node is wrong use, a silent one is no answer") {
  const Bench bench;
  for (const char* node : {"0", "128", "five", "5x", "300"}) {
    CAPTURE(node);
    check(bench.run("read", {node, "1000"}), 2, "",
          std::string("lexican: '") + node + "' is no node-ID, which is 1 to 127\n");
  }
  check(bench.run("read", {"9", "1000", "--timeout", "50"}), 3, "",
        "lexican: node 9 does not answer; is it on this bus, with power, and at this bit rate? lexican scan shows who "
        "answers\n");
  CHECK(bench.run("write", {"9", "1017", "5", "--type", "u16", "--timeout", "50"}).status == 3);
  CHECK(bench.run("read", {"5", "1000", "--timeout", "0"}).status == 2);
}

TEST_CASE("lexican read: an object by index, without and with a description") {
  const Bench bench{5};
  check(bench.run("read", {"5", "1000"}), 0, "1000h:00 device type = 00020192h (u32)\n", "");
  check(bench.run("read", {"5", "0x1018:4"}), 0, "1018h:04 serial number = 000001A2h (u32)\n", "");
  check(bench.run("read", {"5", "1018h:04", "--type", "u32"}), 0, "1018h:04 serial number = 418 (u32)\n", "");
  check(bench.run("read", {"5", "1008"}), 0, "1008h:00 manufacturer device name = \"SD-400\" (string)\n", "");
  check(bench.run("read", {"5", "2001", "--eds", eds}), 0, "2001h Temperature = -40 (i16)\n", "");
  check(bench.run("read", {"5", "2001", "--eds", "5=" + eds}), 0, "2001h Temperature = -40 (i16)\n", "");
  check(bench.run("read", {"5", "2001", "--eds", "6=" + eds}), 0, "2001h:00 = FFD8h\n", "");
  check(bench.run("read", {"5", "1018:4", "--eds", eds}), 0,
        "1018h:04 Identity object, Serial number = 000001A2h (u32)\n", "");
  check(bench.run("read", {"5", "2003", "--eds", eds}), 0, "2003h Temperature offset = 0.5 (r32)\n", "");
  check(bench.run("read", {"5", "2004", "--eds", eds}), 0, "2004h Enabled = 1 (bool)\n", "");
  check(bench.run("read", {"5", "2005", "--eds", eds}), 0, "2005h Label = \"axis\" (string)\n", "");
}

TEST_CASE("lexican read: an object by its name, or a part of it") {
  const Bench bench{5};
  check(bench.run("read", {"5", "cycle count", "--eds", eds}), 0, "2006h Cycle count = 7 (u32)\n", "");
  check(bench.run("read", {"5", "cycle", "--eds", eds}), 0, "2006h Cycle count = 7 (u32)\n", "");
  check(bench.run("read", {"5", "serial number", "--eds", eds}), 0,
        "1018h:04 Identity object, Serial number = 000001A2h (u32)\n", "");
  check(bench.run("read", {"5", "position", "--eds", eds}), 0, "2002h Position = 1000 (u32)\n", "");
  check(bench.run("read", {"5", "device name"}), 0, "1008h:00 manufacturer device name = \"SD-400\" (string)\n", "");
  check(bench.run("read", {"5", "temp", "--eds", eds}), 2, "",
        "lexican: 'temp' is the name of several objects; give more of it, or the index:\n"
        "  2001h Temperature\n"
        "  2003h Temperature offset\n");
  check(bench.run("read", {"5", "temperture", "--eds", eds}), 2, "",
        "lexican: no object is called 'temperture'; did you mean Temperature?\n");
  check(bench.run("read", {"5", "zzz", "--eds", eds}), 2, "",
        "lexican: no object is called 'zzz'; an index is hexadecimal: 6081, 1018:4\n");
  check(bench.run("read", {"5", "zzz"}), 2, "",
        "lexican: no object is called 'zzz'; names need a description: --eds FILE. An index is hexadecimal: 6081, "
        "1018:4\n");
  const Ran ambiguous = bench.run("read", {"5", "o", "--eds", eds});
  CHECK(ambiguous.status == 2);
  CHECK(lines_of(ambiguous.err).size() == 10);
  CHECK(has(lines_of(ambiguous.err).back(), " more"));
}

TEST_CASE("lexican: -n is the node, like the argument") {
  const Bench bench{5};
  const std::string serial = "1018h:04 serial number = 000001A2h (u32)\n";
  check(bench.run("read", {"-n", "5", "1018:4"}), 0, serial, "");
  check(bench.run("read", {"1018:4", "-n", "5"}), 0, serial, "");
  check(bench.run("read", {"-n", "5", "5", "1018:4"}), 0, serial, "");
  const std::string different = "lexican: '5' and -n 6 are different nodes; give one of them\n";
  check(bench.run("read", {"-n", "6", "5", "1018:4"}), 2, "", different);
  check(bench.run("read", {"-n", "5"}), 2, "", "lexican: give the node and the object, such as 5 1018:4\n");
  check(bench.run("read", {"5"}), 2, "", "lexican: give the node and the object, such as 5 1018:4\n");
  check(bench.run("write", {"-n", "5", "1017", "500"}), 0, "1017h:00 producer heartbeat time = 500 (u16)\n", "");
  check(bench.run("write", {"-n", "5", "5", "1017", "0"}), 0, "1017h:00 producer heartbeat time = 0 (u16)\n", "");
  check(bench.run("write", {"-n", "5", "2005", "", "--type", "string"}), 0, "2005h:00 =  (string)\n", "");
  check(bench.run_with_input("write", {"-n", "5", "2005", "--file", "-"}, "/dev/null"), 0, "2005h:00, 0 bytes\n", "");
  check(bench.run("write", {"-n", "6", "5", "1017", "500"}), 2, "", different);
  check(bench.run("write", {"-n", "5", "1017"}), 2, "", "lexican: give a value, or --file, and not both\n");
  check(bench.run("nmt", {"reset", "-n", "5", "--timeout", "30000"}), 0, "node 5 has booted\n", "");
  check(bench.run("nmt", {"start", "-n", "all"}), 0, "start was sent to all nodes\n", "");
  check(bench.run("nmt", {"start", "5", "-n", "6"}), 2, "", different);
  check(bench.run("nmt", {"start"}), 2, "", "lexican: which node? Give its node-ID, 1 to 127, or all\n");
}

TEST_CASE("lexican read: an index or sub-index that is wrong") {
  Bench bench{5};
  for (const char* word : {"1018sub4", "1018Sub04", "0x1018:0x4", "1018h:4h", "1018h:04", "1018:04h"}) {
    CAPTURE(word);
    check(bench.run("read", {"5", word}), 0, "1018h:04 serial number = 000001A2h (u32)\n", "");
  }
  const std::string index = " is no index, which is 0 to FFFF (hexadecimal): 1018, 1018:4, 1018h:04, 1018sub4\n";
  const std::string sub = " is no sub-index, which is 0 to FF (hexadecimal): 1018, 1018:4, 1018h:04, 1018sub4\n";
  for (const auto& [word, message] : std::vector<std::pair<std::string, std::string>>{{"1018:999", "'999'" + sub},
                                                                                      {"1018:", "''" + sub},
                                                                                      {"1018:x", "'x'" + sub},
                                                                                      {"1018sub100", "'100'" + sub},
                                                                                      {"1018:4:5", "'4:5'" + sub},
                                                                                      {"12345", "'12345'" + index},
                                                                                      {"0x12345", "'0x12345'" + index},
                                                                                      {"12345h:1", "'12345h'" + index},
                                                                                      {"10g8:1", "'10g8'" + index},
                                                                                      {":4", "''" + index}}) {
    check(bench.run("read", {"5", word}), 2, "", "lexican: " + message);
    check(bench.run("read", {"5", word, "--eds", eds}), 2, "", "lexican: " + message);
    check(bench.run("read", {"9", word, "--yes"}), 2, "", "lexican: " + message);  // the device is not asked
  }
}

TEST_CASE("lexican read: an abort is shown with object, code, meaning and remedy") {
  const Bench bench{5};
  check(bench.run("read", {"5", "2007", "--eds", eds}), 1, "",
        "lexican: node 5, 2007h Password: aborted with 0601 0001h object is write-only; the object can only be "
        "written\n");
  check(bench.run("read", {"5", "3000"}), 1, "",
        "lexican: node 5, 3000h:00: aborted with 0602 0000h object does not exist; the manual or the EDS of the device "
        "lists its objects\n");
  check(bench.run("read", {"5", "1018:9"}), 1, "",
        "lexican: node 5, 1018h:09 identity object: aborted with 0609 0011h sub-index does not exist; the manual "
        "or the EDS of the device lists its objects\n");
  check(bench.run("read", {"5", "3000", "--eds", eds}), 1, "",
        "lexican: node 5, 3000h:00: aborted with 0602 0000h object does not exist; the description may belong to "
        "another version of the device; compare 1018h\n");
  check(
      bench.run("write", {"5", "2006", "1", "--eds", eds}), 1, "",
      "lexican: node 5, 2006h Cycle count: aborted with 0601 0002h object is read-only; the object can only be read\n");
  check(bench.run("write", {"5", "2008", "1", "--eds", eds}), 1, "",
        "lexican: node 5, 2008h Mode: aborted with 0800 0022h data cannot be stored: device state; another state may "
        "accept "
        "it: lexican nmt preop NODE, or switch the device off first\n");
}

TEST_CASE("lexican: a description that cannot be read is wrong use") {
  const Bench bench;
  const Ran ran = bench.run("read", {"5", "1000", "--eds", bench.directory / "none.eds"});
  CHECK(ran.status == 2);
  CHECK(has(ran.err, "none.eds"));
  CHECK(bench.run("read", {"5", "1000", "--eds", "200=" + eds}).status == 2);
  CHECK(bench.run("read", {"5", "1000", "--eds", bench.directory.path()}).status == 2);
}

/// Returns the description with another text of a key.
std::string with_key(const std::string& key, const std::string& value) {
  return std::regex_replace(bytes_of(eds), std::regex(key + "=[^\n]*"), value);
}

TEST_CASE("lexican: a description of the user's directory is found by the identity of the device") {
  const Bench bench{5};
  const std::string library = bench.directory / "lexican/eds";
  std::filesystem::create_directories(library);
  write_bytes(library + "/1.eds", with_key("ProductNumber", "ProductNumber=0x403"));
  write_bytes(library + "/2.eds", "no description");
  write_bytes(library + "/3.eds", with_key("ProductNumber", ""));
  const std::string unknown =
      "lexican: no object is called 'position'; names need a description: --eds FILE. An index is hexadecimal: 6081, "
      "1018:4\n";
  check(bench.run("read", {"5", "2002"}), 0, "2002h:00 = 000003E8h\n", "");
  check(bench.run("read", {"5", "position"}), 2, "", unknown);
  write_bytes(library + "/4.eds", bytes_of(eds));
  check(bench.run("read", {"5", "position"}), 0, "2002h Position = 1000 (u32)\n", "");
  check(bench.run("write", {"5", "2001", "300"}), 2, "",
        "lexican: 2001h Temperature: 300 is beyond the limits of the description, -40 to 125; --force writes it\n");
  CHECK(bench.run("write", {"5", "2001", "100"}).status == 0);
  const std::string renamed =
      std::regex_replace(with_key("RevisionNumber", "RevisionNumber=9"), std::regex("=Position"), "=Place");
  write_bytes(library + "/0.eds", renamed);
  check(bench.run("read", {"5", "2002"}), 0, "2002h Position = 1000 (u32)\n", "");  // the revision decides
  const Ran scan = bench.run("scan", {});
  CHECK(has(scan.out, "name    description\n"));
  CHECK(has(scan.out, "SD-400  " + library + "/4.eds\n"));
  const Ran json = bench.run("scan", {"--json"});
  CHECK(fault_of(json.out, "scan") == "");
  CHECK(Json::parse(lines_of(json.out)[0])["description"] == library + "/4.eds");
  const std::string log = bench.directory / "a.log";
  const std::string upload = "(0.000000) can0 605#4002200000000000\n(0.000000) can0 585#43022000E8030000\n";
  write_bytes(log, "(0.000000) can0 605#4018100100000000\n(0.000000) can0 585#4318100100010000\n" + upload +
                       "(0.000000) can0 605#4018100200000000\n(0.000000) can0 585#4318100202040000\n" + upload +
                       "(0.000000) can0 605#4018100300000000\n(0.000000) can0 585#4318100300000100\n" + upload);
  const Ran mon = bench.run("mon", {log});
  CHECK(mon.err == "lexican: node 5 is described by " + library + "/0.eds\nlexican: node 5 is described by " + library +
                       "/4.eds\n");
  CHECK(has(mon.out, "5  read 2002h:00 = 000003E8h\n"));
  CHECK(has(mon.out, "5  read 2002h Place = 1000\n"));
  CHECK(has(mon.out, "5  read 2002h Position = 1000\n"));
  CHECK(bench.run("mon", {log, "--eds", library + "/0.eds"}).err == "");  // it is given
  std::filesystem::remove(library + "/4.eds");
  check(bench.run("read", {"5", "2002"}), 0, "2002h Place = 1000 (u32)\n", "");
  check(bench.run("read", {"7", "place", "--timeout", "50"}), 3, "",
        "lexican: node 7 does not answer; is it on this bus, with power, and at this bit rate? lexican scan shows who "
        "answers\n");
}

TEST_CASE("lexican: a device without revision number is identified by vendor-ID and product code") {
  Bench bench;
  bench.add(5, "no-revision");
  const std::string library = bench.directory / "lexican/eds";
  std::filesystem::create_directories(library);
  write_bytes(library + "/drive.eds", bytes_of(eds));
  check(bench.run("read", {"5", "position"}), 0, "2002h Position = 1000 (u32)\n", "");
}

TEST_CASE("lexican mon: --node also shows NMT commands to all nodes") {
  const Directory directory;
  const std::string log = directory / "a.log";
  write_bytes(log, "(0.000000) can0 000#0200\n(0.001000) can0 705#7F\n(0.002000) can0 706#7F\n");
  const Ran ran = run({"mon", log, "--node", "5"});
  CHECK(has(ran.out, "NMT stop, all nodes"));
  CHECK(has(ran.out, "  5  heartbeat"));
  CHECK(!has(ran.out, "  6  heartbeat"));
}

TEST_CASE("lexican: the description that a device stores is uploaded with --yes") {
  Bench bench{6};
  bench.add(5, "eds=" + eds);
  const std::string file = bench.directory / "lexican/eds/00000100-00000402-00010000.eds";
  CHECK(bench.run("read", {"5", "position"}).status == 2);
  CHECK(bench.run("read", {"6", "position", "--yes"}).status == 2);
  CHECK(!std::filesystem::exists(file));
  check(bench.run("read", {"5", "position", "--yes"}), 0, "2002h Position = 1000 (u32)\n", "");
  CHECK(bytes_of(file) == bytes_of(eds));
  check(bench.run("read", {"6", "position"}), 0, "2002h Position = 1000 (u32)\n", "");  // the same product
  std::filesystem::remove(file);
  const Ran scan = bench.run("scan", {"--yes"});
  CHECK(has(scan.out, "SD-400  " + file + " (uploaded from 1021h)\n"));
  CHECK(has(scan.out, "SD-400  " + file + "\n"));
  CHECK(scan.err == "");
}

TEST_CASE("lexican: a stored description of another device is not used") {
  Bench bench;
  const std::string other = bench.directory / "other.eds";
  write_bytes(other, with_key("ProductNumber", "ProductNumber=1"));
  bench.add(5, "eds=" + other);
  const Ran ran = bench.run("read", {"5", "position", "--yes"});
  CHECK(has(ran.err,
            "lexican: the description of node 5 (1021h) is not used: it has another vendor-ID or product code "
            "than the device\n"));
  CHECK(ran.status == 2);
  CHECK(!std::filesystem::exists(bench.directory / "lexican/eds"));
}

TEST_CASE("lexican write: values of each type, and what reads back") {
  const Bench bench{5};
  struct Value {
    const char* object;
    const char* written;
    const char* read;
  };
  for (const Value& value :
       {Value{"2000", "255", "2000h Output = 255 (u8)\n"}, Value{"2001", "-5", "2001h Temperature = -5 (i16)\n"},
        Value{"2001", "-0x10", "2001h Temperature = -16 (i16)\n"}, Value{"2002", "0x10", "2002h Position = 16 (u32)\n"},
        Value{"2003", "-1.5", "2003h Temperature offset = -1.5 (r32)\n"},
        Value{"2004", "false", "2004h Enabled = 0 (bool)\n"},
        Value{"2005", "spindle 2", "2005h Label = \"spindle 2\" (string)\n"}}) {
    CAPTURE(value.object);
    check(bench.run("write", {"5", value.object, value.written, "--eds", eds, "--verify"}), 0, value.read, "");
    check(bench.run("read", {"5", value.object, "--eds", eds}), 0, value.read, "");
  }
  check(bench.run("write", {"5", "2001", "--eds", eds, "--", "-7"}), 0, "2001h Temperature = -7 (i16)\n", "");
  check(bench.run("read", {"5", "2001", "--type", "i16"}), 0, "2001h:00 = -7 (i16)\n", "");
  check(bench.run("write", {"5", "2001", "FFFF", "--type", "bytes"}), 0, "2001h:00 = FF FF (bytes)\n", "");
  check(bench.run("read", {"5", "2001", "--type", "u32"}), 1, "",
        "lexican: 2001h:00: the object has 2 bytes, a value of this type has 4: 0xFFFF\n");
  CHECK(bench.run("read", {"5", "2001", "--type", "u32", "--json"}).status == 1);
}

TEST_CASE("lexican write: an empty text empties a string or domain, and is no value of another type") {
  const Bench bench{5};
  check(bench.run("write", {"5", "2005", "", "--eds", eds, "--verify"}), 0, "2005h Label = \"\" (string)\n", "");
  check(bench.run("read", {"5", "2005", "--eds", eds}), 0, "2005h Label = \"\" (string)\n", "");
  check(bench.run("write", {"5", "2009", "", "--type", "bytes"}), 0, "2009h:00 =  (bytes)\n", "");
  check(bench.run("write", {"5", "2000", "", "--eds", eds}), 2, "", "lexican: 2000h Output: '' is no integer\n");
  CHECK(bench.run("write", {"5", "2002", ""}).status == 2);
  check(bench.run("write", {"5", "2005", "", "--file", eds}), 2, "",
        "lexican: give a value, or --file, and not both\n");
}

TEST_CASE("lexican write: a value that does not fit is refused before anything is sent") {
  const Bench bench;
  check(bench.run("write", {"5", "2000", "256", "--eds", eds}), 2, "",
        "lexican: 2000h Output: 256 is out of range, 0...255\n");
  check(bench.run("write", {"5", "2000", "five", "--eds", eds}), 2, "",
        "lexican: 2000h Output: 'five' is no integer\n");
  check(bench.run("write", {"5", "2001", "126", "--eds", eds}), 2, "",
        "lexican: 2001h Temperature: 126 is beyond the limits of the description, -40 to 125; --force writes it\n");
  check(bench.run("write", {"5", "2001", "-41", "--eds", eds}), 2, "",
        "lexican: 2001h Temperature: -41 is beyond the limits of the description, -40 to 125; --force writes it\n");
  check(bench.run("write", {"5", "2002", "5"}), 2, "",
        "lexican: the type of 2002h:00 is unknown; give --type (u8, u16, u24 ... u64, i8, i16, i24 ... i64, r32, r64, "
        "bool, string, bytes (or domain)) or --eds\n");
  check(
      bench.run("write", {"5", "2002", "5", "--type", "u33"}), 2, "",
      "lexican: 'u33' is no type; types are u8, u16, u24 ... u64, i8, i16, i24 ... i64, r32, r64, bool, string, bytes "
      "(or domain)\n");
  check(bench.run("write", {"5", "2002"}), 2, "", "lexican: give a value, or --file, and not both\n");
  check(bench.run("write", {"5", "2002", "5", "--file", eds}), 2, "",
        "lexican: give a value, or --file, and not both\n");
  CHECK(bench.run("write", {"5", "2002", "--file", bench.directory / "none"}).status == 2);
}

TEST_CASE("lexican write: the objects of CiA 301 need no type, and their signatures are words") {
  const Bench bench{5};
  check(bench.run("write", {"5", "1017", "500", "--verify"}), 0, "1017h:00 producer heartbeat time = 500 (u16)\n", "");
  check(bench.run("read", {"5", "1017"}), 0, "1017h:00 producer heartbeat time = 500 (u16)\n", "");
  check(bench.run("read", {"5", "1009"}), 0, "1009h:00 manufacturer hardware version = \"V1\" (string)\n", "");
  for (const Words& more : {Words{}, Words{"--eds", eds}}) {
    Words words = {"5", "1010:1", "save"};
    words.insert(words.end(), more.begin(), more.end());
    check(bench.run("write", words), 0, "1010h:01 store parameters = 65766173h (save) (u32)\n", "");
  }
  check(bench.run("write", {"5", "1010:1", "load"}), 2, "",
        "lexican: 1010h:01 store parameters: 'load' is no integer\n");
  check(bench.run("write", {"5", "1011:1", "load"}), 0,
        "1011h:01 restore default parameters = 64616F6Ch (load) (u32)\n", "");
}

TEST_CASE("lexican write: --force writes beyond the limits of the description") {
  const Bench bench{5};
  check(bench.run("write", {"5", "2001", "126", "--eds", eds, "--force", "--verify"}), 0,
        "2001h Temperature = 126 (i16)\n", "");
  check(bench.run("read", {"5", "2001", "--eds", eds}), 0, "2001h Temperature = 126 (i16)\n", "");
}

TEST_CASE("lexican write: --verify names a value that reads back differently") {
  const Bench bench{5};
  check(bench.run("write", {"5", "200A", "7", "--eds", eds, "--verify"}), 1, "",
        "lexican: 200Ah Position limit was written, but reads back as 5\n");
  check(bench.run("write", {"5", "2007", "7", "--eds", eds, "--verify"}), 1, "",
        "lexican: node 5, 2007h Password: aborted with 0601 0001h object is write-only; the object can only be "
        "written\n");
}

TEST_CASE("lexican write: save and load need a sub-index, and do not read back") {
  const Bench bench{5};
  check(bench.run("write", {"5", "1010", "save"}), 2, "",
        "lexican: 1010h:00 cannot be written; 'save' is for 1010:1, all parameters\n");
  check(bench.run("write", {"5", "1011", "load"}), 2, "",
        "lexican: 1011h:00 cannot be written; 'load' is for 1011:1, all parameters\n");
  const Ran ran = bench.run("write", {"5", "1010:1", "save", "--verify"});
  CHECK(has(ran.err, "does not read back what is written; leave out --verify\n"));
  CHECK(ran.status == 2);
}

TEST_CASE("lexican write: --verify of an object that reads back with more bytes") {
  const Bench bench{5};
  const std::string file = bench.directory / "short.bin";
  write_bytes(file, "abc");
  check(bench.run("write", {"5", "2009", "--file", file, "--verify"}), 1, "",
        "lexican: 2009h:00 was written, but reads back with more bytes\n");
}

TEST_CASE("lexican read, write: a domain of 100 KB has the same bytes in both directions") {
  const Bench bench{5};
  std::string program(100'000, '\0');
  for (std::size_t n = 0; n < program.size(); ++n) {
    program[n] = static_cast<char>(n * 7 + n / 256);
  }
  const std::string up = bench.directory / "up.bin";
  const std::string down = bench.directory / "down.bin";
  check(bench.run("read", {"5", "2009", "-o", up}), 0, "", "");
  CHECK((bytes_of(up) == program));
  const Ran piped = bench.run("read", {"5", "program", "--eds", eds, "-o", "-"});
  CHECK((piped.out == program));
  CHECK(piped.err.empty());
  std::reverse(program.begin(), program.end());
  write_bytes(down, program);
  check(bench.run("write", {"5", "2009", "--file", down, "--verify"}), 0, "2009h:00, 100000 bytes\n", "");
  CHECK((bench.run("read", {"5", "2009", "-o", "-"}).out == program));
  check(bench.run("read", {"5", "2009", "--most", "99999"}), 1, "",
        "lexican: 2009h:00 has more than 99999 bytes; allow more by --most\n");
  CHECK(bench.run("read", {"5", "2009", "-o", bench.directory / "none/file"}).status == 2);
  check(bench.run_with_input("write", {"5", "2005", "--file", "-"}, "/dev/null"), 0, "2005h:00, 0 bytes\n", "");
  check(bench.run("read", {"5", "2005", "--eds", eds}), 0, "2005h Label = \"\" (string)\n", "");
}

TEST_CASE("lexican write: the default time-out is long enough for a block on a slow bus") {
  const Bench bench;
  const std::string slow = bench.hub() + "-slow@10k";
  Process device({LEXICAN_TEST_DEVICE, slow, "5"}, bench.environment());
  device.wait_for("ready");
  const std::string file = bench.directory / "program";
  write_bytes(file, std::string(1000, 'x'));
  const Words words = {LEXICAN_PROGRAM, "write", "5", "2009", "--file", file, "-i", slow};
  check(Process(words, bench.environment()).finish(), 0, "2009h:00, 1000 bytes\n", "");
  Words hurried = words;
  hurried.insert(hurried.end(), {"--timeout", "500"});
  CHECK(Process(hurried, bench.environment()).finish().status == 3);
}

TEST_CASE("lexican read: control characters of a device do not reach the terminal") {
  const Bench bench{5};
  check(bench.run("write", {"5", "2005", "61 1B 5B 33 31 6D 7F", "--type", "bytes"}), 0,
        "2005h:00 = 61 1B 5B 33 31 6D 7F (bytes)\n", "");
  check(bench.run("read", {"5", "2005", "--type", "string"}), 0, "2005h:00 = a?[31m? (string)\n", "");
}

TEST_CASE("lexican read, write: an interruption aborts the transfer") {
  Bench bench;
  Process& device = bench.add(5, "slow");
  SUBCASE("upload") {
    Process upload(bench.line("read", {"5", "2009", "-o", "-"}), bench.environment());
    device.wait_for("request");
    upload.send(SIGINT);
    check(upload.finish(), 130, "", "lexican: interrupted; the transfer was aborted\n");
  }
  SUBCASE("download") {
    const std::string file = bench.directory / "file";
    write_bytes(file, std::string(100'000, 'x'));
    Process download(bench.line("write", {"5", "2009", "--file", file}), bench.environment());
    device.wait_for("request");
    download.send(SIGTERM);
    check(download.finish(), 130, "", "lexican: interrupted; the transfer was aborted\n");
  }
  device.wait_for("abort 08000021");
}

TEST_CASE("lexican read, write: --json") {
  const Bench bench{5};
  const Ran read = bench.run("read", {"5", "2001", "--eds", eds, "--json"});
  check(
      read, 0,
      R"({"data":"D8FF","index":8193,"node":5,"object":"2001h Temperature","sub":0,"text":"-40","type":"i16","value":-40})"
      "\n",
      "");
  CHECK(fault_of(read.out, "read") == "");
  CHECK(fault_of(bench.run("read", {"5", "2009", "--json"}).out, "read") == "");
  struct Value {
    Words words;
    Json value;
    std::string text;
  };
  for (const Value& each : {Value{{"1018:4"}, 418, "000001A2h"}, Value{{"2003", "--eds", eds}, 0.5, "0.5"},
                            Value{{"2004", "--eds", eds}, true, "1"}, Value{{"1008"}, "SD-400", "\"SD-400\""},
                            Value{{"2002"}, Json(), "000003E8h"}, Value{{"2002", "--type", "u32"}, 1000, "1000"}}) {
    CAPTURE(each.text);
    Words words = {"5", "--json"};
    words.insert(words.end(), each.words.begin(), each.words.end());
    const Ran ran = bench.run("read", words);
    CHECK(fault_of(ran.out, "read") == "");
    const Json json = Json::parse(ran.out);
    CHECK(json["value"] == each.value);
    CHECK(json["text"] == each.text);
  }
  const Ran write = bench.run("write", {"5", "2001", "5", "--eds", eds, "--json", "--verify"});
  check(write, 0,
        R"({"bytes":2,"index":8193,"node":5,"object":"2001h Temperature","sub":0,"verified":true})"
        "\n",
        "");
  CHECK(fault_of(write.out, "write") == "");
  const std::string fault =
      "node 5, 3000h:00: aborted with 0602 0000h object does not exist; the manual or the EDS of the device lists its "
      "objects";
  check(bench.run("read", {"5", "3000", "--json"}), 1, R"({"error":")" + fault + "\",\"status\":1}\n",
        "lexican: " + fault + '\n');
}

TEST_CASE("lexican: with --json, a command that fails prints an error") {
  const Bench bench{5};
  const std::string empty = bench.directory / "empty.log";
  write_bytes(empty, "");
  struct Failing {
    const char* verb;
    Words words;
    int status;
  };
  for (const Failing& failing :
       {Failing{"read", {"five", "1000"}, 2}, Failing{"read", {"9", "1000", "--timeout", "50"}, 3},
        Failing{"write", {"5", "1000", "1"}, 1}, Failing{"write", {"5", "2000", "256", "--eds", eds}, 2},
        Failing{"scan", {"-i", "slcan:/nonexistent@500k"}, 4}, Failing{"nmt", {"start", "200"}, 2},
        Failing{"mon", {"/nonexistent.log"}, 2}, Failing{"share", {"--name", "a b"}, 2},
        Failing{"scan", {"-i", bench.hub() + "x", "--timeout", "10"}, 3}}) {
    CAPTURE(failing.verb);
    CAPTURE(failing.status);
    Words words = failing.words;
    words.emplace_back("--json");
    const Ran ran = bench.run(failing.verb, words);
    CHECK(ran.status == failing.status);
    REQUIRE(fault_of(ran.out, "error") == "");
    const Json json = Json::parse(ran.out);
    CHECK(json["status"] == failing.status);
    CHECK(ran.err == "lexican: " + json["error"].get<std::string>() + '\n');
  }
  const Ran nmt = bench.run("nmt", {"start", "9", "--timeout", "50", "--json"});
  REQUIRE(lines_of(nmt.out).size() == 2);
  CHECK(lines_of(nmt.out)[0] == R"({"command":"start","done":false,"node":9})");
  CHECK(Json::parse(lines_of(nmt.out)[1])["status"] == 3);
  CHECK(run({"scan", "--json", "--nonsense"}).out == "");
}

TEST_CASE("lexican: the check of a JSON schema finds faults") {
  const test::Schema schema(Json::parse(bytes_of(LEXICAN_TOOL_DIR "/docs/schema.json")));
  CHECK(schema.fault_of(Json::parse(R"({"node": 5, "serial": 1})"), "scan") == "");
  for (const char* wrong : {R"({})", R"({"node": 0})", R"({"node": 128})", R"({"node": "5"})", R"({"node": 5.5})",
                            R"({"node": 5, "more": 1})", R"([5])"}) {
    CAPTURE(wrong);
    CHECK(schema.fault_of(Json::parse(wrong), "scan") != "");
  }
  CHECK(schema.fault_of(Json::parse(R"({"command": "jump", "node": "5", "done": true})"), "nmt") != "");
  CHECK(schema.fault_of(Json::parse(R"({"command": "stop", "node": "", "done": true})"), "nmt") != "");
  CHECK(schema.fault_of(Json::parse(R"({"frames": 1})"), "mon") != "");
  CHECK(schema.fault_of(Json::parse(R"({"error": "", "status": 1})"), "error") != "");
  CHECK(schema.fault_of(Json::parse(R"({"error": "x", "status": 0})"), "error") != "");
}

TEST_CASE("lexican: a log, or a path, as the bus of a verb that sends") {
  const Directory directory;
  const std::string log = directory / "a.log";
  write_bytes(log, "(0.000000) can0 705#7F\n");
  check(run({"read", "5", "1008", "-i", "replay:" + log}), 2, "",
        "lexican: replay:" + log + " is a log, which only lexican mon, why, pdo watch and top can use\n");
  const Ran ran = run({"scan", "-i", "/dev/pts/0"});
  CHECK(has(ran.err, "lexican: '/dev/pts/0' is no bus, which is one of:\n"));
  CHECK(has(ran.err, "slcan:/dev/ttyACM0@500k"));
  CHECK(ran.status == 2);
}

TEST_CASE("lexican nmt: a command waits for the state that it causes") {
  const Bench bench{5};
  check(bench.run("write", {"5", "1017", "50"}), 0, heartbeat, "");
  check(bench.run("nmt", {"start", "5", "--timeout", "30000"}), 0, "node 5 is operational\n", "");
  check(bench.run("nmt", {"stop", "5", "--timeout", "30000"}), 0, "node 5 is stopped\n", "");
  check(bench.run("read", {"5", "1000", "--timeout", "1000"}), 3, "",
        "lexican: node 5 is stopped and answers no SDO: lexican nmt preop 5\n");
  check(bench.run("nmt", {"preop", "5", "--timeout", "30000"}), 0, "node 5 is pre-operational\n", "");
  check(bench.run("read", {"5", "1000"}), 0, "1000h:00 device type = 00020192h (u32)\n", "");
  const Ran json = bench.run("nmt", {"start", "5", "--timeout", "30000", "--json"});
  check(json, 0, "{\"command\":\"start\",\"done\":true,\"node\":5}\n", "");
  CHECK(fault_of(json.out, "nmt") == "");
  check(bench.run("nmt", {"reset", "5", "--timeout", "30000"}), 0, "node 5 has booted\n", "");
  check(bench.run("nmt", {"reset-comm", "5", "--timeout", "30000"}), 0, "node 5 has booted\n", "");
}

TEST_CASE("lexican nmt: the state of a device without heartbeat is unknown") {
  const Bench bench{5};
  check(bench.run("nmt", {"start", "5", "--timeout", "500"}), 0, "",
        "lexican: sent; node 5 has sent no heartbeat, so its state is unknown; lexican write 5 1017 1000 switches it "
        "on\n");
  check(bench.run("nmt", {"stop", "5", "--timeout", "500"}), 0, "",
        "lexican: sent; node 5 has sent no heartbeat, so its state is unknown\n");
  for (const char* unseen : {"5", "9"}) {  // node 5 is stopped now
    CAPTURE(unseen);
    check(bench.run("nmt", {"stop", unseen, "--timeout", "50"}), 3, "",
          std::string("lexican: sent; node ") + unseen +
              " has sent no heartbeat, and did not answer before: it is not there, or was stopped already\n");
  }
  check(bench.run("nmt", {"preop", "9", "--timeout", "50"}), 3, "",
        "lexican: sent; node 9 has sent no heartbeat, and does not answer; lexican scan shows who answers\n");
  check(bench.run("nmt", {"reset", "9", "--timeout", "50"}), 3, "",
        "lexican: sent; node 9 has sent no boot-up message within 50 ms\n");
  check(bench.run("nmt", {"start", "200"}), 2, "", "lexican: '200' is no node-ID, which is 1 to 127, or all\n");
}

TEST_CASE("lexican nmt: the state of a device without heartbeat is unknown after its boot-up message") {
  Bench bench{5};
  CHECK(bench.run("write", {"5", "1017", "50"}).status == 0);
  Process mon(bench.line("mon", {}), bench.environment());
  mon.wait_for("heartbeat");
  Process nmt(bench.line("nmt", {"start", "12", "--timeout", "3000"}), bench.environment());
  mon.wait_for("NMT start");
  bench.add(12);
  check(nmt.finish(), 0, "",
        "lexican: sent; node 12 has sent no heartbeat, so its state is unknown; lexican write 12 1017 1000 switches it "
        "on\n");
}

TEST_CASE("lexican nmt: a heartbeat that is slower than --timeout is waited for") {
  const Bench bench{5};
  CHECK(bench.run("write", {"5", "1017", "4000"}).status == 0);
  check(bench.run("nmt", {"start", "5", "--timeout", "1000"}), 0, "node 5 is operational\n",
        "lexican: waiting for the heartbeat of node 5, which it sends every 4000 ms\n");
  check(bench.run("nmt", {"stop", "5", "--timeout", "1000"}), 0, "node 5 is stopped\n",
        "lexican: waiting for the heartbeat of node 5, which it sends every 4000 ms\n");
}

TEST_CASE("lexican nmt: a device with a heartbeat and without SDO server can be stopped") {
  Bench bench;
  bench.add(12, "silent");
  check(bench.run("read", {"12", "1000", "--timeout", "500"}), 3, "",
        "lexican: node 12 sends heartbeats, but does not answer SDO requests; lexican why looks for the cause, "
        "and lexican nmt reset 12 restarts it\n");
  check(bench.run("nmt", {"stop", "12", "--timeout", "1000"}), 0, "node 12 is stopped\n", "");
}

TEST_CASE("lexican nmt: all nodes, without a question on a simulated bus") {
  Bench bench{5, 6};
  check(bench.run("write", {"5", "1017", "50"}), 0, heartbeat, "");
  check(bench.run("write", {"6", "1017", "50"}), 0, heartbeat, "");
  check(bench.run("nmt", {"start", "all"}), 0, "start was sent to all nodes\n", "");
  const Ran scan = bench.run("scan", {"--timeout", "200"});
  CHECK(has(scan.out, "   5  operational"));
  CHECK(has(scan.out, "   6  operational"));
}

TEST_CASE("lexican nmt: a reset, and a command to all, on a physical bus need --yes without a terminal") {
  const Bench bench;
  const std::string refusal = "lexican: this command changes a physical bus: confirm it by --yes\n";
  for (const Words& words : {Words{"start", "all"}, Words{"reset", "5"}, Words{"reset-comm", "5"}}) {
    CAPTURE(words[0]);
    const Ran ran = bench.run("nmt", {words[0], words[1], "-i", "slcan-pty"});
    CHECK(ran.status == 2);
    CHECK(ran.out == "");
    REQUIRE(lines_of(ran.err).size() >= 1);
    CHECK(lines_of(ran.err).back() + '\n' == refusal);
  }
  CHECK(bench.run("nmt", {"reset", "all", "--yes", "-i", "slcan-pty", "--timeout", "50"}).status != 2);
  CHECK(bench.run("nmt", {"start", "5", "-i", "slcan-pty", "--timeout", "50"}).status != 2);
}

namespace {

/// A pseudo-terminal as the standard input and standard error output of a program.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    REQUIRE(master_ >= 0);
    REQUIRE(grantpt(master_) == 0);
    REQUIRE(unlockpt(master_) == 0);
    slave_ = open(ptsname(master_), O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(slave_ >= 0);
  }
  ~Terminal() {
    close(master_);
    close(slave_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  int slave() const { return slave_; }
  /// Returns what it shows up to a text, for which it waits at most a minute.
  std::string wait_for(const std::string& text) {
    std::string shown;
    while (!has(shown, text)) {
      char c = 0;
      pollfd wanted{master_, POLLIN, 0};
      constexpr int minute = 60'000;
      REQUIRE_MESSAGE((poll(&wanted, 1, minute) == 1 && read(master_, &c, 1) == 1), shown);
      shown += c;
    }
    return shown;
  }

 private:
  int master_;
  int slave_ = -1;
};

}  // namespace

TEST_CASE("lexican: Ctrl-C at a question ends with 130, and nothing is sent") {
  Bench bench;
  bench.add(5, "eds=" + eds);
  struct Asked {
    const char* verb;
    Words words;
    const char* message;
  };
  for (const Asked& asked :
       {Asked{"read", {"5", "position"}, "\nlexican: interrupted\r\n"},
        Asked{"scan", {"--timeout", "200"}, "\nlexican: interrupted\r\n"},
        Asked{"nmt", {"reset", "5", "-i", "slcan-pty"}, "\nlexican: interrupted; nothing was sent\r\n"}}) {
    CAPTURE(asked.verb);
    Terminal terminal;
    Process process(bench.line(asked.verb, asked.words), bench.environment(), terminal.slave(), terminal.slave());
    terminal.wait_for("[y/N] ");
    process.send(SIGINT);
    terminal.wait_for(asked.message);
    const Ran ran = process.finish();
    CHECK(ran.status == 130);
    CHECK(ran.out == "");
  }
  CHECK(!std::filesystem::exists(bench.directory / "lexican/eds"));
}

TEST_CASE("lexican scan: devices with state, profile, identity and name") {
  Bench bench{5, 127};
  bench.add(12, "silent");
  const Ran ran = bench.run("scan", {"--timeout", "200"});
  CHECK(without_times(ran.out) ==
        "node  state            profile         vendor:product     serial    name\n"
        "   5  not seen         402 drive       00000100:00000402  000001A2  SD-400\n"
        "  12  pre-operational  -               -:-                -\n"
        " 127  not seen         402 drive       00000100:00000402  000001A2  SD-400\n"
        "3 nodes in T s\n");
  const std::string note =
      "lexican: node 12 sends heartbeats, but does not answer SDO requests; lexican why looks for the cause, "
      "and lexican nmt reset 12 restarts it\n";
  CHECK(ran.err == note);
  CHECK(ran.status == 0);
  const Ran json = bench.run("scan", {"--json", "--timeout", "200"});
  check(json, 0,
        R"({"device_type":131474,"name":"SD-400","node":5,"product":1026,"revision":65536,"serial":418,"vendor":256})"
        "\n"
        R"({"node":12,"state":"pre-operational"})"
        "\n"
        R"({"device_type":131474,"name":"SD-400","node":127,"product":1026,"revision":65536,"serial":418,"vendor":256})"
        "\n",
        note);
  CHECK(fault_of(json.out, "scan") == "");
}

TEST_CASE("lexican scan: the bus load is shown if the bit rate is known") {
  Bench bench;
  Process device({LEXICAN_TEST_DEVICE, bench.hub() + "@500k", "5", "usual"}, bench.environment());
  device.wait_for("ready");
  const Ran ran = bench.run("scan", {"--timeout", "100"});
  std::smatch found;
  REQUIRE(std::regex_search(ran.out, found, std::regex("\n1 node in [0-9.]+ s, bus load ([0-9]+\\.[0-9]) %\n")));
  CHECK(std::stod(found[1]) > 0);
  CHECK(std::stod(found[1]) < 10);
}

TEST_CASE("lexican scan: a device without node-ID has a line") {
  const Bench bench{255};
  const Ran ran = bench.run("scan", {"--timeout", "160"});
  CHECK(has(ran.out,
            "   ?  no node-ID       LSS             00000100:00000402  000001A2  lexican lss assign "
            "000001A2=NODE\n0 nodes and 1 without node-ID in"));
  CHECK(ran.err == "");
  CHECK(ran.status == 0);
  const Ran json = bench.run("scan", {"--json", "--timeout", "160"});
  REQUIRE(fault_of(json.out, "scan") == "");
  CHECK(Json::parse(lines_of(json.out).back()) ==
        Json{{"state", "no node-ID"}, {"vendor", 0x100}, {"product", 0x402}, {"revision", 0x10000}, {"serial", 0x1A2}});
}

TEST_CASE("lexican scan: no device answers") {
  const Bench bench;
  check(bench.run("scan", {"--timeout", "10"}), 3, "",
        "lexican: no node answered, and no frame was received; no device runs on this simulated bus\n");
}

namespace {

/// A log with a boot-up, transfers, PDOs, an EMCY and an error frame.
const char* const log_text =
    "(1000.000000) can0 705#00\n"
    "(1000.010000) can0 605#2B17100064000000\n"
    "(1000.010600) can0 585#6017100000000000\n"
    "(1000.020000) can0 000#0105\n"
    "(1000.030000) can0 705#05\n"
    "(1000.040000) can0 185#D8FFE8030000\n"
    "(1000.050000) can0 205#07\n"
    "(1000.060000) can0 605#2F08200001000000\n"
    "(1000.061200) can0 585#8008200022000008\n"
    "(1000.070000) can0 085#1043090000000000\n"
    "(1000.080000) can0 20000004#0004000000006000\n"
    "(1000.090000) can0 705#05\n"
    "(1000.100000) can0 606#4000100000000000\n"
    "(1000.101000) can0 586#4300100000000000\n";

const char* const event_text =
    "    0.000   5  boot-up\n"
    "    0.011   5  write 1017h Producer heartbeat time = 100  0.6 ms\n"
    "    0.020   5  NMT start, node 5\n"
    "    0.030   5  heartbeat: operational\n"
    "    0.040   5  TPDO1 Temperature = -40, Position = 1000\n"
    "    0.050   5  RPDO1 Output = 7\n"
    "    0.061   5  write 2008h Mode refused: 0800 0022h data cannot be stored: device state  1.2 ms\n"
    "    0.070   5  EMCY 4310h temperature, error register 09h\n"
    "    0.080   -  bus: error warning level reached (TEC 96, REC 0)\n"
    "    0.101   6  read 1000h:00 device type = 00000000h  1.0 ms\n";

const char* const number_text =
    "       705h         3      29.7/s\n"
    "       585h         2      19.8/s\n"
    "       605h         2      19.8/s\n"
    "       000h         1       9.9/s\n"
    "       085h         1       9.9/s\n"
    "       185h         1       9.9/s\n"
    "       205h         1       9.9/s\n"
    "       586h         1       9.9/s\n"
    "       606h         1       9.9/s\n";

/// Returns the lines in front of the statistics.
std::string events_of(const std::string& output) { return output.substr(0, output.find("\n\n") + 1); }

/// A bench with the log as a file.
struct LogBench : Bench {
  LogBench() { write_bytes(log, log_text); }
  /// Runs mon with the log, described by the EDS.
  Ran mon(Words words) const {
    words.insert(words.begin(), {log, "--eds", "5=" + eds});
    return run("mon", words);
  }
  std::string events(const Words& words) const { return events_of(mon(words).out); }

  std::string log = directory / "fault.log";
};

}  // namespace

TEST_CASE("lexican mon: a log in words, with statistics") {
  const LogBench bench;
  const std::string about = "\n13 frames in 0.101 s";
  check(bench.mon({"--rate", "500k"}), 0,
        event_text + about + ", bus load 2.5 % of 500 kbit/s, 1 error frame, 0 lost\n" + number_text, "");
  check(bench.mon({}), 0, event_text + about + ", 1 error frame, 0 lost\n" + number_text, "");
  check(bench.run_with_input("mon", {"-", "--eds", "5=" + eds}, bench.log), 0, bench.mon({}).out, "");
  CHECK(has(bench.run("mon", {bench.log}).out, "    0.040   5  TPDO1 D8 FF E8 03 00 00\n"));
}

TEST_CASE("lexican mon: filters by node, service and object; --all") {
  const LogBench bench;
  CHECK(bench.events({"--node", "6"}) == "    0.101   6  read 1000h:00 device type = 00000000h  1.0 ms\n");
  CHECK(bench.events({"-n", "6", "-n", "5"}) == std::regex_replace(event_text, std::regex("[^\n]* -  [^\n]*\n"), ""));
  CHECK(bench.events({"--service", "emcy", "--service", "error"}) ==
        "    0.070   5  EMCY 4310h temperature, error register 09h\n"
        "    0.080   -  bus: error warning level reached (TEC 96, REC 0)\n");
  CHECK(bench.events({"--service", "emcy,error"}) == bench.events({"--service", "emcy", "--service", "error"}));
  CHECK(bench.mon({"--service", "emcy,none"}).status == 2);
  const std::string refused =
      "    0.061   5  write 2008h Mode refused: 0800 0022h data cannot be stored: device state  1.2 ms\n";
  CHECK(bench.events({"--object", "2008"}) == refused);
  CHECK(bench.events({"--object", "Mode", "--service", "sdo", "--node", "5"}) == refused);
  CHECK(bench.events({"--object", "mODE", "--service", "sdo"}) == refused);
  CHECK(bench.events({"--object", "nothing"}) == "");
  const std::string all = bench.events({"--all"});
  CHECK(has(all, "    0.090   5  heartbeat: operational\n"));
  CHECK(lines_of(all).size() == 11);
  CHECK(lines_of(bench.events({"--service", "state"})).size() == 3);
}

TEST_CASE("lexican mon: --json") {
  const LogBench bench;
  const Ran ran = bench.mon({"--json", "--rate", "500k"});
  CHECK(ran.status == 0);
  CHECK(fault_of(ran.out, "mon") == "");
  const std::vector<std::string> lines = lines_of(ran.out);
  REQUIRE(lines.size() == 11);
  CHECK(
      lines[6] ==
      R"({"fault":true,"node":5,"sdo":{"abort":134217762,"bytes":1,"data":"01","duration":0.0012,"index":8200,"sub":0,)"
      R"("write":true},"service":"sdo","text":"write 2008h Mode refused: 0800 0022h data cannot be stored: device )"
      R"(state","time":0.0612})");
  const Json numbers = Json::parse(lines.back());
  CHECK(numbers["frames"] == 13);
  CHECK(numbers["errors"] == 1);
  CHECK(numbers["identifiers"]["705h"] == 3);
  CHECK(numbers["load"] > 2.4);
  CHECK(fault_of(bench.mon({"--json"}).out, "mon") == "");
  CHECK(!Json::parse(lines_of(bench.mon({"--json"}).out).back()).contains("load"));
}

TEST_CASE("lexican mon: a record has the same events as the log") {
  const LogBench bench;
  for (const char* name : {"copy.log", "copy.pcapng"}) {
    CAPTURE(name);
    const std::string copy = bench.directory / name;
    check(bench.mon({"--log", copy}), 0, bench.mon({}).out, "");
    check(bench.run("mon", {copy, "--eds", "5=" + eds}), 0, bench.mon({}).out, "");
  }
}

namespace {

/// Returns the data of a page of --html.
Json data_of_page(const std::string& path) {
  const std::string page = bytes_of(path);
  const std::string begin = "<script id=\"data\" type=\"application/json\">";
  const std::size_t from = page.find(begin) + begin.size();
  return Json::parse(page.substr(from, page.find('<', from) - from), nullptr, false);
}

}  // namespace

TEST_CASE("lexican mon: --html writes a page with the lines that are shown") {
  const LogBench bench;
  const std::string page = bench.directory / "fault.html";
  check(bench.mon({"--html", page}), 0, bench.mon({}).out, "");
  const Json all = data_of_page(page);
  CHECK(all["source"] == "fault.log");
  CHECK(all["frames"] == 13);
  CHECK(all["errors"] == 1);
  CHECK(all["duration"] == 101'000);
  CHECK(all["lines"]["time"].size() == 10);
  CHECK(all["lines"]["fault"] == Json{0, 0, 0, 0, 0, 0, 1, 1, 1, 0});
  CHECK(all["texts"][6] == "write 2008h Mode refused: 0800 0022h data cannot be stored: device state  1.2 ms");
  CHECK(all["series"].size() == 3);
  CHECK(all["series"][0]["name"] == "Temperature");
  CHECK(all["series"][0]["value"] == Json{-40});
  CHECK(all["causes"] == Json::array());

  const std::string record = bench.directory / "record.log";
  CHECK(bench
            .mon({"--html", page, "--json", "--rate", "500k", "--log", record, "-n", "5", "--service", "pdo,sdo",
                  "--object", "temperature"})
            .status == 0);
  const Json one = data_of_page(page);
  CHECK(one["texts"] == Json{"TPDO1 Temperature = -40, Position = 1000"});
  CHECK(one["rate"] == 500'000);
  CHECK(one["series"].size() == 2);
  CHECK(bytes_of(record).size() > 100);
}

TEST_CASE("lexican mon: --html says how many lines its page leaves out") {
  const LogBench bench;
  std::string lines;
  for (unsigned n = 0; n < 100'007; ++n) {
    lines += "(1000.000000) can0 185#01\n";
  }
  write_bytes(bench.log, lines);
  const std::string page = bench.directory / "long.html";
  const Ran ran = bench.run("mon", {bench.log, "--html", page});
  CHECK(ran.status == 0);
  CHECK(ran.err ==
        "lexican: " + page + " leaves out 7 lines behind the first 100000; -n, --service and --object show fewer\n");
}

TEST_CASE("lexican mon: a page that cannot be written ends it at the start") {
  const LogBench bench;
  check(bench.mon({"--html", "/nonexistent/a.html"}), 2, "",
        "lexican: /nonexistent/a.html cannot be written: No such file or directory\n");
  check(bench.mon({"--html", bench.directory.path()}), 2, "", "lexican: --html needs the name of a file\n");
  check(bench.mon({"--html", bench.log}), 2, "", "lexican: " + bench.log + " is read and cannot be the page, too\n");
  CHECK(bytes_of(bench.log) == log_text);
  const std::string page = bench.directory / "a.html";
  check(bench.run("mon", {bench.directory / "none", "--html", page}), 2, "",
        "lexican: " + bench.directory.path() + "/none: No such file or directory\n");
  CHECK(!std::filesystem::exists(page));
}

TEST_CASE("lexican mon: --html draws the CSV of a recorder") {
  const Bench bench;
  const std::string csv = bench.directory / "speed.csv";
  const std::string page = bench.directory / "speed.html";
  write_bytes(csv, "# name: speed\n# object: 2110h:00\n# trigger: 5\n0;10\n5;30\n12;20\n");
  check(bench.run("mon", {csv}), 2, "",
        "lexican: " + csv + " begins like the CSV of a recorder, which --html FILE draws\n");
  check(bench.run("mon", {csv, "--html", page}), 0, "", "");
  const Json data = data_of_page(page);
  CHECK(data["recorder"] == true);
  CHECK(data["marks"] == Json::parse(R"([{"time":5000,"name":"trigger"}])"));
  CHECK(data["series"] == Json::parse(R"([{"name":"speed","about":"2110h:00","unit":"","colour":"","node":0,
                                           "time":[0,5000,12000],"value":[10,30,20]}])"));
  std::filesystem::remove(page);
  check(bench.run_with_input("mon", {"-", "--html", page}, csv), 0, "", "");
  CHECK(data_of_page(page) == data);
  check(bench.run("mon", {csv, "--html", page, "--log", bench.directory / "a.log"}), 2, "",
        "lexican: " + csv + " is the CSV of a recorder, which has no frames for --log\n");
  write_bytes(csv, "1;1\nabc\n");
  check(bench.run("mon", {csv, "--html", page}), 2, "",
        "lexican: " + csv +
            ":2: no ';' in 'abc'; a line is 'time;value': read the plot in format 0 (CSV), not 1 (binary)\n");
  CHECK(data_of_page(page) == data);
}

TEST_CASE("lexican mon: wrong use, and files that cannot be used") {
  const LogBench bench;
  const std::string asc = bench.directory / "old.asc";
  write_bytes(asc, "old");
  check(bench.mon({"--log", asc}), 2, "", "lexican: " + asc + ": a log is written with the ending .log or .pcapng\n");
  CHECK(bytes_of(asc) == "old");
  check(bench.mon({"--log", bench.log}), 2, "", "lexican: " + bench.log + " is read and cannot be the record, too\n");
  CHECK(bytes_of(bench.log) == log_text);
  check(bench.mon({"--log", "/nonexistent/a.log"}), 2, "", "lexican: /nonexistent/a.log cannot be written\n");
  check(bench.mon({"-i", bench.hub()}), 2, "", "lexican: give a log, or -i, and not both\n");
  check(bench.mon({"-n", "0"}), 2, "", "lexican: '0' is no node-ID, which is 1 to 127\n");
  CHECK(bench.mon({"--service", "all"}).status == 2);
  check(bench.run("mon", {bench.directory / "none"}), 2, "",
        "lexican: " + bench.directory.path() + "/none: No such file or directory\n");
  const std::string rubbish = bench.directory / "rubbish";
  write_bytes(rubbish, "rubbish\n");
  const Ran ran = bench.run("mon", {rubbish});
  CHECK(ran.status == 2);
  CHECK(has(ran.err, "unknown format"));
  const Ran full = bench.run_shell("\"$0\" mon '" + bench.log + "' >/dev/full");
  check(full, 2, "", "lexican: standard output: No space left on device\n");
}

TEST_CASE("lexican mon: a closed pipe ends it without a message") {
  const LogBench bench;
  std::string lines;
  for (unsigned n = 0; n < 20'000; ++n) {
    lines += "(1000.000000) can0 185#0102030405060708\n";
  }
  write_bytes(bench.log, lines);
  check(bench.run_shell("\"$0\" mon '" + bench.log + "' | head -n 1"), 0,
        "    0.000   5  TPDO1 01 02 03 04 05 06 07 08\n", "");
}

TEST_CASE("lexican mon: a bus, until it is interrupted, and its record") {
  Bench bench{5};
  bench.add(12, "silent");
  const std::string record = bench.directory / "record.pcapng";
  const std::string page = bench.directory / "record.html";
  Process mon(bench.line("mon", {"--log", record, "--html", page}), bench.environment());
  mon.wait_for(" 12  heartbeat: pre-operational");
  check(bench.run("read", {"5", "1000"}), 0, "1000h:00 device type = 00020192h (u32)\n", "");
  mon.wait_for("  5  read 1000h:00 device type = 00020192h");
  mon.send(SIGINT);
  const Ran ran = mon.finish();
  CHECK(ran.status == 0);
  CHECK(ran.err == "");
  CHECK(has(ran.out, ", 0 error frames, 0 lost\n"));
  CHECK(bench.run("mon", {record}).out == ran.out);
  const Json data = data_of_page(page);
  CHECK(data["source"] == bench.hub());
  CHECK(data["lines"]["time"].size() == lines_of(events_of(ran.out)).size());
}

TEST_CASE("lexican scan: an interruption ends it") {
  Bench bench;
  Process& device = bench.add(5);
  Process scan(bench.line("scan", {"--timeout", "60000"}), bench.environment());
  device.wait_for("request");
  scan.send(SIGINT);
  check(scan.finish(), 130, "", "lexican: interrupted\n");
}

/// Returns a TCP port that was free.
std::uint16_t free_port() {
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  socklen_t size = sizeof address;
  REQUIRE(bind(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0);
  REQUIRE(getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  close(fd);
  return ntohs(address.sin_port);
}

TEST_CASE("lexican share: a bus as another hub, and as an slcan adapter") {
  Bench bench{5};
  bench.add(12, "silent");
  const std::string port = std::to_string(free_port());
  Process share(bench.line("share", {"--name", "shared", "--port", "0", "--slcan-port", port, "--pty", "--json"}),
                bench.environment());
  share.wait_for("}\n");
  CHECK(fault_of(share.out(), "share") == "");
  const Json ways = Json::parse(share.out());
  CHECK(ways["hub"] == "shared");
  const std::string name = "1008h:00 manufacturer device name = \"SD-400\" (string)\n";
  check(bench.run("read", {"5", "1008", "-i", "hub:shared"}), 0, name, "");
  check(bench.run("read", {"5", "1008", "-i", "slcan:" + ways["slcan"].get<std::string>() + "@500k"}), 0, name, "");
  const std::string tcp = "slcan-tcp:127.0.0.1:" + port + "@500k";
  CHECK(ways["slcan_tcp"] == "127.0.0.1:" + port);
  for (unsigned n = 0; n < 20; ++n) {  // more than it serves at once: ended ones make room
    check(bench.run("read", {"5", "1008", "-i", tcp}), 0, name, "");
  }
  Process mon(bench.line("mon", {"--all", "-i", tcp}), bench.environment());
  mon.wait_for(" 12  heartbeat: pre-operational");
  check(bench.run("read", {"5", "1008", "-i", tcp}), 0, name, "");
  mon.wait_for("  5  read 1008h:00");
  mon.send(SIGINT);
  CHECK(mon.finish().status == 0);
  check(bench.run("share", {"--name", "other", "--port", "0", "--slcan-port", port}), 2, "",
        "lexican: the server cannot use port " + port + " of 127.0.0.1: Address already in use\n");
  check(bench.run("share", {"--name", "shared"}), 2, "",
        "lexican: hub:shared is in use; choose another name by --name\n");
  check(bench.run("share", {"--name", "a b"}), 2, "",
        "lexican: the name of a hub has 1 to 40 letters, digits, - and _\n");
  share.send(SIGINT);
  CHECK(share.finish().status == 0);
}

namespace {

/// Returns place and length of the value of an entry in a DCF, such as that of "1801sub1".
std::pair<std::size_t, std::size_t> place_of(const std::string& dcf, const std::string& section) {
  const std::string key = "ParameterValue=";
  const std::size_t begin = dcf.find('[' + section + ']');
  const std::size_t value = dcf.find(key, begin);
  REQUIRE(value < dcf.find("\n[", begin));
  return {value + key.size(), dcf.find('\r', value) - value - key.size()};
}

/// A device, and the DCF that was read from it.
struct Configured : Bench {
  Configured() : Bench{5} {
    const Ran ran = run("dump", {"5", "-o", dcf, "--eds", eds});
    CHECK(ran.err == "");
    CHECK(ran.status == 0);
    summary = std::regex_replace(ran.out, std::regex("in [0-9.]+ s"), "in 0.0 s");
  }
  Ran apply(Words words) const {
    words.insert(words.begin(), dcf);
    return run("apply", words);
  }
  void set(const std::string& section, const std::string& value) {
    std::string text = bytes_of(dcf);
    const auto [place, length] = place_of(text, section);
    write_bytes(dcf, text.replace(place, length, value));
  }

  const std::string dcf = directory / "5.dcf";
  std::string summary;
};

}  // namespace

TEST_CASE("lexican dump: the configuration of a device as a DCF") {
  Configured bench;
  CHECK(bench.summary ==
        "10 values in 0.0 s; left out: read-only 22, mapped in PDOs 3, write-only 1, domains 1\n"
        "1 refused with 0800 0022h data cannot be stored: device state: 2008h\n");
  const std::string dcf = bytes_of(bench.dcf);
  CHECK(has(dcf, "FileName=5.dcf\r\n"));
  CHECK(has(dcf, "NodeID=5\r\n"));
  const std::pair<const char*, const char*> values[] = {
      {"1017", "0"},       {"1801sub1", "$NODEID+0xC0000280"},
      {"1801sub2", "255"}, {"1A01sub1", "0x00000000"},
      {"2003", "0.5"},     {"2004", "1"},
      {"2005", "axis"},    {"200A", "5"},
  };
  for (const auto& [section, value] : values) {
    const auto [place, length] = place_of(dcf, section);
    CHECK(dcf.substr(place, length) == value);
  }
  CHECK(bench.run("dump", {"5", "-o", bench.dcf, "--eds", bench.dcf}).status == 0);
  CHECK(bytes_of(bench.dcf) == std::regex_replace(dcf, std::regex("LastEDS=device.eds"), "LastEDS=5.dcf"));
  const Ran text = bench.run("dump", {"5", "--eds", eds});
  CHECK(text.out == std::regex_replace(dcf, std::regex("FileName=5"), "FileName=node5"));
  CHECK(has(text.err, "10 values in"));
  const Ran all = bench.run("dump", {"5", "--eds", eds, "--all"});
  const auto [place, length] = place_of(all.out, "2006");
  CHECK(all.out.substr(place, length) == "7");
  const Ran json = bench.run("dump", {"5", "--eds", eds, "-o", bench.dcf, "--json"});
  CHECK(fault_of(json.out, "dump") == "");
  CHECK(Json::parse(json.out)["refused"] == Json::parse(R"([{"index": 8200, "sub": 0, "abort": 134217762}])"));
  CHECK(bench.run("dump", {"5", "--eds", eds, "--json"}).status == 2);
  check(bench.run("dump", {"5"}), 2, "",
        "lexican: a dump needs the description of the device: --eds FILE (EDS, DCF, XDD or XDC)\n");
  CHECK(bench.run("dump", {"7", "--eds", eds, "--timeout", "50"}).status == 3);
  CHECK(bench.run("dump", {"5", "--eds", eds, "-o", "/nonexistent/5.dcf"}).status == 2);
}

TEST_CASE("lexican: a device that refuses an object with 0504 0000h has answered") {
  Bench bench;
  bench.add(5, "time-out");
  const std::string refusal =
      "lexican: node 5, 2008h Mode: aborted with 0504 0000h protocol timed out; the device itself has waited too long; "
      "repeat the command\n";
  check(bench.run("read", {"5", "2008", "--eds", eds}), 1, "", refusal);
  check(bench.run("write", {"5", "2008", "1", "--eds", eds}), 1, "", refusal);
  const std::string dcf = bench.directory / "5.dcf";
  const Ran dump = bench.run("dump", {"5", "-o", dcf, "--eds", eds});
  CHECK(dump.err == "");
  CHECK(dump.status == 0);
  CHECK(has(dump.out, "\n1 refused with 0504 0000h protocol timed out: 2008h\n"));
  std::string text = bytes_of(dcf);
  text.insert(text.find("ParameterName", text.find("[2008]")), "ParameterValue=1\r\n");
  write_bytes(dcf, text);
  const Ran apply = bench.run("apply", {dcf});
  CHECK(apply.status == 1);
  CHECK(apply.err == "lexican: 2008h Mode refused: 0504 0000h protocol timed out\n");
}

TEST_CASE("lexican apply: what differs is shown, and then written") {
  Configured bench;
  check(bench.apply({"--diff"}), 0, "0 of 10 values differ\n", "");
  bench.set("1017", "250");
  bench.set("2003", "-1.5");
  bench.set("2005", "second axis");
  const std::string differences =
      "3 of 10 values differ\n"
      "  1017h Producer heartbeat time  0 -> 250\n"
      "  2003h Temperature offset       0.5 -> -1.5\n"
      "  2005h Label                    \"axis\" -> \"second axis\"\n";
  check(bench.apply({"--diff"}), 1, differences, "");
  check(bench.apply({"--diff"}), 1, differences, "");
  check(bench.apply({}), 0,
        differences + "all 10 values are as in the file; node 5 is pre-operational: lexican nmt start 5\n", "");
  check(bench.apply({}), 0, "0 of 10 values differ\n", "");
  check(bench.run("read", {"5", "2005"}), 0, "2005h:00 = \"second axis\"\n", "");
  bench.set("2005", "third");
  const Ran json = bench.apply({"--json"});
  CHECK(fault_of(json.out, "apply") == "");
  CHECK(Json::parse(json.out)["differ"] == Json::parse(R"([{"index": 8197, "sub": 0}])"));
  CHECK(Json::parse(json.out)["written"] == 1);
}

TEST_CASE("lexican apply: a PDO is switched off while its parameters change, and the node-ID is added") {
  Configured bench;
  bench.add(6);
  bench.set("1801sub1", "$NODEID+0x40000280");
  bench.set("1801sub2", "1");
  bench.set("1A01sub0", "2");
  bench.set("1A01sub1", "0x20020020");
  bench.set("1A01sub2", "0x20010010");
  const Ran ran = bench.apply({"-n", "6"});
  CHECK(ran.err == "");
  CHECK(ran.status == 0);
  CHECK(has(ran.out, "5 of 10 values differ\n"));
  check(bench.run("read", {"6", "1801:1"}), 0, "1801h:01 TPDO communication parameter = 40000286h (u32)\n", "");
  check(bench.run("read", {"6", "1A01:2"}), 0, "1A01h:02 TPDO mapping parameter = 20010010h (u32)\n", "");
  check(bench.apply({"-n", "6", "--diff"}), 0, "0 of 10 values differ\n", "");
  bench.set("1A01sub1", "0x20020010");  // of 16 bits, but the object has 32
  const Ran wrong = bench.apply({"-n", "6"});
  CHECK(wrong.status == 1);
  CHECK(has(wrong.err, "1A01h:01 Second TPDO mapping parameter, First object refused: 0"));
  CHECK(has(wrong.err, "lexican: 1801h: the rest of this PDO was not written, and it is not switched on\n"));
  check(bench.run("read", {"6", "1801:1"}), 0, "1801h:01 TPDO communication parameter = C0000286h (u32)\n", "");
}

TEST_CASE("lexican apply: values that the device refuses, or does not keep") {
  Configured bench;
  bench.set("200A", "9");
  check(bench.apply({"--store"}), 1,
        "1 of 10 values differ\n"
        "  200Ah Position limit  5 -> 9\n"
        "after writing, 1 of 10 values differ; nothing was stored:\n"
        "  200Ah Position limit  5 -> 9\n",
        "");
  CHECK(has(bench.apply({"--json"}).err, "lexican: after writing, 1 of 10 values differ\n"));
}

TEST_CASE("lexican apply: nothing is written if a value of the file does not fit its type") {
  Configured bench;
  const std::string dcf = bytes_of(bench.dcf);
  bench.set("2003", "0.25");
  const std::string good = bytes_of(bench.dcf);
  for (const auto& [section, value] :
       std::initializer_list<std::pair<const char*, const char*>>{{"1017", "70000"},
                                                                  {"1017", "abc"},
                                                                  {"2004", "$NODEID+0xFFFFFFFF"},
                                                                  {"1801sub1", "$NODEID+0xFFFFFFFF"},
                                                                  {"1A01sub0", "300"},
                                                                  {"1801sub2", "1x"}}) {
    write_bytes(bench.dcf, good);
    bench.set(section, value);
    const Ran ran = bench.apply({"--store"});
    CHECK(ran.status == 2);
    CHECK(ran.out == "");
    CHECK(has(ran.err, std::string(" = '") + value + "' is no value of its type\n"));
    CHECK(has(ran.err, "lexican: nothing was written; --force leaves such values out\n"));
  }
  write_bytes(bench.dcf, dcf);
  check(bench.apply({"--diff"}), 0, "0 of 10 values differ\n", "");
  bench.set("1017", "70000");
  check(
      bench.apply({"--diff", "--force"}), 0, "0 of 9 values differ\n",
      "lexican: " + bench.dcf + ": 1017h Producer heartbeat time = '70000' is no value of its type; it is left out\n");
}

TEST_CASE("lexican apply: nothing is written if a value of the file is beyond its limits") {
  Configured bench;
  std::string dcf = bytes_of(bench.dcf);
  dcf.insert(dcf.find("ParameterName", dcf.find("[1017]")), "HighLimit=1000\r\n");
  dcf.insert(dcf.find("ParameterName", dcf.find("[1801sub1]")),
             "LowLimit=$NODEID+0xC0000280\r\nHighLimit=$NODEID+0xC0000280\r\n");
  write_bytes(bench.dcf, dcf);
  bench.set("1017", "1000");
  check(bench.apply({"--diff"}), 1, "1 of 10 values differ\n  1017h Producer heartbeat time  0 -> 1000\n", "");
  bench.set("1017", "1001");
  bench.set("1801sub1", "0xC0000284");
  const std::string faults =
      "lexican: " + bench.dcf + ": 1017h Producer heartbeat time = 1001 is beyond its limits, - to 1000\n" +  //
      "lexican: " + bench.dcf +
      ": 1801h:01 Second TPDO communication parameter, COB-ID = 0xC0000284 is beyond its limits, $NODEID+0xC0000280 to "
      "$NODEID+0xC0000280\n";
  check(bench.apply({}), 2, "", faults + "lexican: nothing was written; --force writes values beyond their limits\n");
  check(bench.run("read", {"5", "1017"}), 0, "1017h:00 producer heartbeat time = 0 (u16)\n", "");
  const Ran forced = bench.apply({"--force"});
  CHECK(forced.status == 0);
  CHECK(forced.err == faults);
  check(bench.run("read", {"5", "1017"}), 0, "1017h:00 producer heartbeat time = 1001 (u16)\n", "");
}

TEST_CASE("lexican apply: a value that must not be read is always written") {
  Configured bench;
  bench.set("1017", "250");
  std::string dcf = bytes_of(bench.dcf);
  dcf.insert(dcf.find("ParameterName", dcf.find("[1017]")), "ObjFlags=0x2\r\n");
  write_bytes(bench.dcf, dcf);
  check(bench.apply({"--diff"}), 0, "0 of 9 values differ\n", "");
  CHECK(bench.apply({}).status == 0);
  check(bench.run("read", {"5", "1017"}), 0, "1017h:00 producer heartbeat time = 250 (u16)\n", "");
}

TEST_CASE("lexican apply: the COB-ID of a PDO that the file does not have is that of the device") {
  Configured bench;
  check(bench.run("write", {"5", "1801:1", "0xC0000333"}), 0,
        "1801h:01 TPDO communication parameter = C0000333h (u32)\n", "");
  std::string dcf = bytes_of(bench.dcf);
  dcf.erase(dcf.find("ParameterValue=$NODEID+0xC0000280"), std::strlen("ParameterValue=$NODEID+0xC0000280\r\n"));
  write_bytes(bench.dcf, dcf);
  bench.set("1A01sub0", "1");
  bench.set("1A01sub1", "0x20020020");
  CHECK(bench.apply({}).status == 0);
  check(bench.run("read", {"5", "1801:1"}), 0, "1801h:01 TPDO communication parameter = C0000333h (u32)\n", "");
  check(bench.run("read", {"5", "1A01:0"}), 0, "1A01h:00 TPDO mapping parameter = 1 (u8)\n", "");
}

TEST_CASE("lexican dump, apply: commands, set-points and process values are not written from a file") {
  Configured bench;
  std::string dcf = bytes_of(bench.dcf);
  const std::size_t output = dcf.find("[2000]");
  dcf.insert(dcf.find("\r\nPDOMapping", output) + 2, "ParameterValue=7\r\n");
  write_bytes(bench.dcf, dcf);
  for (const char* index : {"6040", "6042", "6071", "607A", "60B1", "60C1", "60FE", "60FF", "68FF", "987A"}) {
    dcf += std::string("[") + index +
           "]\r\nParameterName=Target\r\nObjectType=0x7\r\nDataType=0x0006\r\nAccessType=rw\r\nParameterValue=15\r\n";
  }
  dcf = std::regex_replace(dcf, std::regex("DefaultValue=0x00020192\r\n"), "");  // the profile is that of the device
  write_bytes(bench.dcf, dcf);
  check(bench.apply({}), 0, "0 of 10 values differ\n",
        "lexican: not written from a file, as commands, set-points, process values or read-only: 2000h, 6040h, 6042h, "
        "6071h, 607Ah, 60B1h, 60C1h, 60FEh and 3 more\n");
  write_bytes(bench.dcf, std::regex_replace(dcf, std::regex("ProductNumber=[^\r]*"), "ProductNumber=0x403"));
  check(bench.run("dump", {"5", "--eds", bench.dcf}), 1, "",
        "lexican: the file is for 00000100:00000403, the device is 00000100:00000402; --force uses it all the same\n");
  check(bench.run("dump", {"5", "--eds", "6=" + bench.dcf}), 2, "",
        "lexican: no file of --eds is for node 5: --eds 5=FILE\n");
}

TEST_CASE("lexican: control characters of a device do not reach the terminal") {
  const Bench bench{5};
  CHECK(bench.run("write", {"5", "2005", "9B 33 0A C2 9B E2 80 AE C3 BC", "--type", "bytes"}).status == 0);
  const Ran ran = bench.run("read", {"5", "2005", "--type", "string"});
  CHECK(ran.out.find('\x9B') == std::string::npos);
  CHECK(has(ran.out, "?3"));
  CHECK(has(ran.out, "\xC3\xBC"));
  CHECK(lines_of(ran.out).size() == 1);
  const Ran json = bench.run("read", {"5", "2005", "--type", "string", "--json"});
  CHECK(Json::parse(json.out)["value"].is_null());
  CHECK(fault_of(json.out, "read") == "");
}

TEST_CASE("lexican scan: two devices with one node-ID") {
  Bench bench{5};
  bench.add(5);
  CHECK(has(bench.run("scan", {}).err,
            "lexican: node 5 has answered one request 2 times: several devices may have this node-ID\n"));
}

TEST_CASE("lexican apply: another device, and files without values") {
  Configured bench;
  const std::string dcf = bytes_of(bench.dcf);
  write_bytes(bench.dcf, std::regex_replace(dcf, std::regex("ProductNumber=[^\r]*"), "ProductNumber=0x403"));
  check(
      bench.apply({}), 1, "",
      "lexican: the file is for 00000100:00000403, the device is 00000100:00000402; --force applies it all the same\n");
  check(bench.apply({"--force"}), 0, "0 of 10 values differ\n", "");
  bench.add(6, "no-product");
  check(bench.apply({"-n", "6"}), 1, "",
        "lexican: the device does not have the vendor-ID and product code (1018h) of the file; --force applies it all "
        "the same\n");
  write_bytes(bench.dcf, bytes_of(eds));
  check(bench.apply({}), 2, "", "lexican: " + bench.dcf + " has no node-ID; give it by -n NODE\n");
  CHECK(bench.apply({"-n", "5"}).status == 2);
  write_bytes(bench.dcf, "no description");
  CHECK(bench.apply({"-n", "5"}).status == 2);
  write_bytes(bench.dcf, dcf);
  CHECK(bench.apply({"-n", "128"}).status == 2);
  CHECK(bench.apply({"-n", "7", "--timeout", "50"}).status == 3);
}

TEST_CASE("lexican lss: devices without node-ID are found, and receive one") {
  Bench bench{5};
  bench.add(255, "serial=A7");
  const std::string first = "00000100:00000402:00010000:000000A7  lexican lss assign 000000A7=NODE\n";
  check(bench.run("lss", {"scan"}), 0, first + "1 device without node-ID\n", "");
  CHECK(has(bench.run("scan", {}).out, "000000A7  lexican lss assign 000000A7=NODE\n"));
  const std::string info =
      "vendor-ID        00000100h\nproduct code     00000402h\nrevision number  00010000h\n"
      "serial number    000000A7h\nnode-ID          none\n";
  check(bench.run("lss", {"info"}), 0, info, "");
  check(bench.run("lss", {"info", "a7"}), 0, info, "");
  check(bench.run("lss", {"info", "100:402:10000:A7"}), 0, info, "");
  const Ran json = bench.run("lss", {"info", "--json"});
  CHECK(fault_of(json.out, "lss") == "");
  CHECK(Json::parse(json.out)["node"].is_null());
  check(bench.run("lss", {"assign", "100:402:10000:A7=5"}), 1, "",
        "lexican: node-ID 5 is that of another device; choose one that is free\n");
  for (const char* const period : {"0", "200"}) {  // without it, by node guarding
    CAPTURE(period);
    bench.run("nmt", {"start", "5"});
    CHECK(bench.run("write", {"5", "1017", period, "--type", "u16"}).status == 0);
    bench.run("nmt", {"stop", "5"});  // it does not answer SDO requests
    check(bench.run("lss", {"assign", "100:402:10000:A7=5"}), 1, "",
          "lexican: node-ID 5 is that of another device; choose one that is free\n");
  }
  check(bench.run("lss", {"assign", "A7=7", "A7=8"}), 2, "", "lexican: the device 000000A7 is given twice\n");
  check(bench.run("lss", {"assign", "A7=7", "100:402:10000:A7=8"}), 2, "",
        "lexican: the device 00000100:00000402:00010000:000000A7 is given twice\n");
  check(bench.run("lss", {"assign", "A8=6"}), 3, "",
        "lexican: no device without node-ID has the serial number 000000A8; lexican lss scan shows all\n");
  check(bench.run("lss", {"assign", "A7=6"}), 0, "000000A7 is node 6\n", "");
  CHECK(has(bench.run("lss", {"info", "-n", "6"}).out, "node-ID          6\n"));
  check(bench.run("lss", {"scan"}), 3, "0 devices without node-ID\n", "");
  check(bench.run("lss", {"info", "100:402:10000:A9", "--timeout", "100"}), 1, "",
        "lexican: LSS: 0x00000100 0x00000402 0x00010000 0x000000A9 was found, but does not answer to its address\n");
}

TEST_CASE("lexican lss: a plan, and two devices with the same address") {
  Bench bench;
  const std::string plan = bench.directory / "plan.csv";
  bench.add(255, "serial=A7");
  bench.add(255, "serial=A8");
  write_bytes(plan, "serial,node,place\n000000a7, 6, left\n\n# later\n0xA8,7\n");
  const Ran ran = bench.run("lss", {"assign", plan, "--json"});
  CHECK(fault_of(ran.out, "lss") == "");
  CHECK(ran.status == 0);
  CHECK(Json::parse(lines_of(ran.out)[1])["node"] == 7);
  check(bench.run("read", {"7", "1018:4"}), 0, "1018h:04 serial number = 000000A8h (u32)\n", "");
  bench.add(255, "serial=B1");
  bench.add(255, "serial=B1");
  const Ran twice = bench.run("lss", {"assign", "B1=8"});
  CHECK(twice.status == 1);
  CHECK(has(twice.err, "LSS: "));
  CHECK(bench.run("read", {"8", "1000", "--timeout", "50"}).status == 3);
  for (const char* const line : {"A7,128", "A7", "A7;5", "0xA7 5", "1:2:3:4,200", ",5", "123456789,5"}) {
    write_bytes(plan, std::string(line) + "\nA8,9\n");
    check(bench.run("lss", {"assign", plan}), 2, "",
          "lexican: " + plan + ", line 1: '" + line + "' is not SERIAL,NODE, such as 000001A2,6\n");
  }
  write_bytes(plan,
              "\xEF\xBB\xBF"
              "A7,6\nA8,6\n");
  check(bench.run("lss", {"assign", plan}), 2, "", "lexican: node-ID 6 is given twice\n");
  for (const char* const line : {"1,A7", "A7,0", "A7,128", "A7", "123456789,5", "1:2:3,5", "1:2:3:4:5,5"}) {
    write_bytes(plan, std::string("serial,node\n") + line + "\n");
    check(bench.run("lss", {"assign", plan}), 2, "",
          "lexican: " + plan + ", line 2: '" + line + "' is not SERIAL,NODE, such as 000001A2,6\n");
  }
  write_bytes(plan, "A7,6\nA8,6\n");
  check(bench.run("lss", {"assign", plan}), 2, "", "lexican: node-ID 6 is given twice\n");
  CHECK(bench.run("lss", {"assign"}).status == 2);
  CHECK(bench.run("lss", {"assign", bench.directory / "none.csv"}).status == 2);
  CHECK(bench.run("lss", {"info", "x"}).status == 2);
}

TEST_CASE("lexican lss: the bit rate of all devices") {
  Bench bench{5};
  bench.add(255, "serial=A7");
  check(bench.run("lss", {"rate", "250k", "--delay", "10"}), 0,
        "2 devices have 250 kbit/s until their reset; the next command needs this rate\n", "");
  for (const char* const rate : {"250", "333k", "fast", "100k"}) {
    check(bench.run("lss", {"rate", rate}), 2, "",
          std::string("lexican: '") + rate +
              "' is no bit rate of LSS: give 10k, 20k, 50k, 125k, 250k, 500k, 800k or 1M\n");
  }
  check(bench.run("lss", {"rate"}), 2, "", "lexican: give one bit rate, such as 250k\n");
}

TEST_CASE("lexican lss: a device that refuses the bit rate") {
  const std::string name = "00000100:00000402:00010000:000000A";
  for (const std::string rate : {"", "500k"}) {
    CAPTURE(rate);
    Bench bench;
    if (!rate.empty()) {
      bench.pace(rate);
    }
    Process& first = bench.add(5, "serial=A7");
    bench.add_kinds(6, {"serial=A8", "refuses-rate"});
    check(
        bench.run("lss", {"rate", "250k", "--store"}), 1, "",
        "lexican: " + name + "8 does not accept the bit rate; none was switched\nlexican: LSS: refused with error 1\n" +
            (rate.empty()
                 ? "lexican: " + name + "7 has 250 kbit/s for the next activation; lexican lss rate gives it another\n"
                 : ""));
    first.send(SIGTERM);
    CHECK(first.finish().out ==
          (rate.empty() ? "ready\nrequest\nrate 250000\n" : "ready\nrequest\nrate 250000\nrate 500000\n"));
  }
}

TEST_CASE("lexican lss: a device that refuses to store") {
  const std::string name = "00000100:00000402:00010000:000000A";
  for (const std::string rate : {"", "500k"}) {
    CAPTURE(rate);
    Bench bench;
    if (!rate.empty()) {
      bench.pace(rate);
    }
    Process& first = bench.add(5, "serial=A7");
    bench.add_kinds(6, {"serial=A8", "refuses-store"});
    check(bench.run("lss", {"rate", "250k", "--store"}), 1, "",
          "lexican: " + name +
              "8 does not store the bit rate; none was switched\nlexican: LSS: refused with error 1\n" +
              (rate.empty() ? "lexican: " + name + "7 has stored 250 kbit/s, and has it after its next reset\n" +
                                  "lexican: " + name +
                                  "8 has 250 kbit/s for the next activation; lexican lss rate gives it another\n"
                            : ""));
    first.send(SIGTERM);
    CHECK(first.finish().out == (rate.empty()
                                     ? "ready\nrequest\nrate 250000\nstored 250000\n"
                                     : "ready\nrequest\nrate 250000\nstored 250000\nrate 500000\nstored 500000\n"));
  }
  Bench bench;
  bench.add_kinds(255, {"serial=A9", "refuses-store"});
  check(bench.run("lss", {"assign", name + "9=7", "--store"}), 1, "",
        "lexican: " + name +
            "9 has node-ID 7 until its next reset; it did not store it\n"
            "lexican: LSS: refused with error 1\n");
  CHECK(has(bench.run("lss", {"info", "-n", "7"}).out, "node-ID          7\n"));
}

TEST_CASE("lexican lss: a node that answers each request, and options of another command") {
  Bench bench;
  bench.add(0, "answers-lss");
  check(bench.run("lss", {"scan"}), 1, "",
        "lexican: LSS: fastscan has found the address 0 0 0 0, which no node has: a node answers every request of a "
        "fastscan; disconnect it, or name the node to configure by VENDOR:PRODUCT:REVISION:SERIAL\n");
  const std::string only = "lexican: --delay is for rate, --store for assign and rate, -n for info\n";
  check(bench.run("lss", {"assign", "A7=6", "--delay", "3"}), 2, "", only);
  check(bench.run("lss", {"assign", "A7=6", "-n", "7"}), 2, "", only);
  check(bench.run("lss", {"scan", "--store"}), 2, "", only);
  check(bench.run("lss", {"info", "A1", "-n", "20"}), 2, "", "lexican: give SERIAL or -n NODE, not both\n");
}
