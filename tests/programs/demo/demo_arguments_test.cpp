// SPDX-License-Identifier: Apache-2.0
#include "co_cfg.h"

#if USE_CSDO  // required by the demo's master
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "client/arguments.hpp"
#include "co_core.h"

namespace {

using lexican::Arguments;
using lexican::Bytes;
using lexican::Prepared;

Arguments to_read() {
  Arguments arguments;
  arguments.node = "5";
  arguments.index = "0x2100";
  return arguments;
}

Arguments to_write(const char* type, const char* value) {
  Arguments arguments = to_read();
  arguments.write = true;
  arguments.type = type;
  arguments.value = value;
  return arguments;
}

std::string fault_of(const Arguments& arguments) { return lexican::prepare(arguments).fault; }

/// A file that is removed at the end of the test case.
class File {
 public:
  explicit File(const std::string& content) { std::ofstream(name, std::ios::binary) << content; }
  ~File() { std::remove(name.c_str()); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const std::string name = (std::filesystem::temp_directory_path() / "lexican_demo_arguments_test").string();
};

}  // namespace

TEST_CASE("demo arguments: node and index are enough to read") {
  const Prepared prepared = lexican::prepare(to_read());
  CHECK(prepared.fault == "");
  CHECK_FALSE(prepared.request.write);
  CHECK(prepared.request.node == 5);
  CHECK(prepared.request.own_id == 127);
  CHECK(prepared.request.index == 0x2100);
  CHECK(prepared.request.sub == 0);
  CHECK_FALSE(prepared.request.type.has_value());
  CHECK(prepared.request.timeout == 1000);
  CHECK(prepared.request.capacity == 16777216);
}

TEST_CASE("demo arguments: index and sub-index are hexadecimal, with or without 0x, and decimal after 0d") {
  const auto device = [](const char* index, const char* sub) {
    Arguments arguments = to_read();
    arguments.index = index;
    arguments.sub = sub;
    const Prepared prepared = lexican::prepare(arguments);
    CHECK(prepared.fault == "");
    return CO_DEV(prepared.request.index, prepared.request.sub);
  };
  CHECK(device("1008", "0") == CO_DEV(0x1008, 0));
  CHECK(device("0x1008", "0x10") == CO_DEV(0x1008, 0x10));
  CHECK(device("0X1a00", "1F") == CO_DEV(0x1A00, 0x1F));
  CHECK(device("0d4096", "0D10") == CO_DEV(0x1000, 10));
  CHECK(device("ffff", "ff") == CO_DEV(0xFFFF, 0xFF));
}

TEST_CASE("demo arguments: other numbers are decimal or hexadecimal, and within their limits") {
  Arguments arguments = to_read();
  arguments.node = "0x7F";
  arguments.own_id = "1";
  arguments.index = "0d65535";
  arguments.sub = "0d255";
  arguments.timeout = "0";
  arguments.max = "4294967295";
  const Prepared prepared = lexican::prepare(arguments);
  CHECK(prepared.fault == "");
  CHECK(prepared.request.node == 127);
  CHECK(prepared.request.own_id == 1);
  CHECK(prepared.request.index == 0xFFFF);
  CHECK(prepared.request.sub == 0xFF);
  CHECK(prepared.request.timeout == 0);
  CHECK(prepared.request.capacity == 4294967295);
}

TEST_CASE("demo arguments: numbers outside of their limits are refused") {
  const auto with = [](std::string Arguments::*member, const char* text) {
    Arguments arguments = to_read();
    arguments.*member = text;
    return fault_of(arguments);
  };
  CHECK(with(&Arguments::node, "0") == "--node: '0' is no number in 1...127");
  CHECK(with(&Arguments::node, "128") == "--node: '128' is no number in 1...127");
  CHECK(with(&Arguments::node, "5x") == "--node: '5x' is no number in 1...127");
  CHECK(with(&Arguments::own_id, "128") == "--own-id: '128' is no number in 1...127");
  for (const char* text :
       {"0x10000", "10000", "0d65536", "0d10FF", "2100h", "0x", "0d", "", "-1", "0x-1", "100000000"}) {
    CAPTURE(text);
    CHECK(with(&Arguments::index, text) ==
          "--index: '" + std::string(text) + "' is no hexadecimal number in 0...FFFF (0d before decimal digits)");
  }
  CHECK(with(&Arguments::sub, "100") == "--sub: '100' is no hexadecimal number in 0...FF (0d before decimal digits)");
  CHECK(with(&Arguments::sub, "0d256") ==
        "--sub: '0d256' is no hexadecimal number in 0...FF (0d before decimal digits)");
  CHECK(with(&Arguments::timeout, "4294967296") == "--timeout: '4294967296' is no number in 0...4294967295");
  CHECK(with(&Arguments::max, "0") == "--max: '0' is no number in 1...4294967295");
}

TEST_CASE("demo arguments: the master uses a node-ID that differs from the node") {
  Arguments arguments = to_read();
  arguments.node = "127";
  CHECK(lexican::prepare(arguments).request.own_id == 126);
  arguments.own_id = "127";
  CHECK(fault_of(arguments) == "--own-id: the remote node has this node-ID");
}

TEST_CASE("demo arguments: a value is converted according to its type") {
  CHECK(lexican::prepare(to_write("u16", "1000")).request.data == Bytes{0xE8, 0x03});
  CHECK(lexican::prepare(to_write("string", "abc")).request.data == Bytes{'a', 'b', 'c'});
  CHECK(fault_of(to_write("u8", "300")) == "300 is out of range, 0...255");
  CHECK(fault_of(to_write("u12", "1")).find("--type: 'u12' is none of u8, ") == 0);
}

TEST_CASE("demo arguments: write needs exactly one value, its type, and at least one byte") {
  CHECK(fault_of(to_write("", "1")) == "write needs the --type of the value");
  CHECK(fault_of(to_write("string", "")) == "nothing to write: an SDO transfer carries at least one byte");
  Arguments arguments = to_write("string", "abc");
  arguments.file = "name";
  CHECK(fault_of(arguments) == "write needs a value, or a --file, and not both");
  arguments.file.clear();
  arguments.value.reset();
  CHECK(fault_of(arguments) == "write needs a value, or a --file, and not both");
}

TEST_CASE("demo arguments: a file is written unchanged") {
  const std::string content("\0\r\n\xFF\x1A", 5);
  const File file(content);
  Arguments arguments = to_read();
  arguments.write = true;
  arguments.file = file.name;
  const Prepared prepared = lexican::prepare(arguments);
  CHECK(prepared.fault == "");
  CHECK(prepared.request.data == Bytes(content.begin(), content.end()));
}

TEST_CASE("demo arguments: a file that is unreadable, empty or has a numeric type is refused") {
  const File file("");
  Arguments arguments = to_read();
  arguments.write = true;
  arguments.file = file.name;
  CHECK(fault_of(arguments) == "nothing to write: an SDO transfer carries at least one byte");
  arguments.file += ".missing";
  CHECK(fault_of(arguments) == "cannot read '" + arguments.file + "': No such file or directory");
  arguments.type = "u8";
  CHECK(fault_of(arguments) == "--type: a file holds bytes, no u8");
}

TEST_CASE("demo arguments: a number has a buffer too small for block transfer, other types one of the allowed size") {
  Arguments arguments = to_read();
  arguments.max = "1000";
  CHECK(lexican::prepare(arguments).request.capacity == 1000);
  arguments.type = "string";
  CHECK(lexican::prepare(arguments).request.capacity == 1000);
  arguments.type = "u64";
  CHECK(lexican::prepare(arguments).request.capacity == 28);  // no block transfer for a number
}

// --- nmt

TEST_CASE("demo arguments: nmt: the five commands of CiA 301 for one node or all [301:7.2.8.2.1]") {
  const auto specifier = [](const char* name) {
    const lexican::NmtPrepared prepared = lexican::prepare(lexican::NmtArguments{name, "5", ""});
    CHECK(prepared.fault == "");
    CHECK(prepared.request.node == 5);
    CHECK(prepared.request.own_id == 127);
    return static_cast<int>(prepared.request.command);
  };
  CHECK(specifier("start") == 1);
  CHECK(specifier("stop") == 2);
  CHECK(specifier("preop") == 128);
  CHECK(specifier("reset-node") == 129);
  CHECK(specifier("reset-comm") == 130);
  CHECK(lexican::prepare(lexican::NmtArguments{"stop", "all", "3"}).request.node == 0);
  CHECK(lexican::prepare(lexican::NmtArguments{"stop", "all", "3"}).request.own_id == 3);
  CHECK(lexican::prepare(lexican::NmtArguments{"stop", "127", ""}).request.own_id == 126);
}

TEST_CASE("demo arguments: nmt: an unknown command and a missing or wrong node are refused") {
  const auto fault = [](const char* command, const char* node, const char* own_id) {
    return lexican::prepare(lexican::NmtArguments{command, node, own_id}).fault;
  };
  CHECK(fault("begin", "5", "") == "nmt: 'begin' is none of start, stop, preop, reset-node, reset-comm");
  CHECK(fault("1", "5", "") == "nmt: '1' is none of start, stop, preop, reset-node, reset-comm");
  CHECK(fault("start", "", "") == "nmt needs the node to command: --node 1...127, or --node all");
  CHECK(fault("start", "0", "") == "--node: '0' is no number in 1...127");
  CHECK(fault("start", "128", "") == "--node: '128' is no number in 1...127");
  CHECK(fault("start", "5", "5") == "--own-id: the remote node has this node-ID");
}

// --- lss

namespace {

using lexican::LssAction;
using lexican::LssAddress;
using lexican::LssArguments;
using lexican::LssPrepared;

LssArguments lss(LssAction action, const char* value = "") {
  LssArguments arguments;
  arguments.action = action;
  arguments.value = value;
  return arguments;
}

std::string fault_of(const LssArguments& arguments) { return lexican::prepare(arguments).fault; }

}  // namespace

TEST_CASE("demo arguments: lss: without an address nodes without node-ID are used") {
  for (const LssAction action : {LssAction::scan, LssAction::store, LssAction::inquire}) {
    const LssPrepared prepared = lexican::prepare(lss(action));
    CHECK(prepared.fault == "");
    CHECK(prepared.request.action == action);
    CHECK_FALSE(prepared.request.address.has_value());
    CHECK(prepared.request.store == (action == LssAction::store));
    CHECK(prepared.request.own_id == 127);
    CHECK(prepared.request.timeout == 1000);
    CHECK(prepared.request.listen == 50);
  }
}

TEST_CASE("demo arguments: lss: an address has four numbers") {
  LssArguments arguments = lss(LssAction::inquire);
  arguments.address = {"0x319", "4294967295", "0", "0xFFFFFFFF"};
  const LssPrepared prepared = lexican::prepare(arguments);
  CHECK(prepared.fault == "");
  REQUIRE(prepared.request.address.has_value());
  CHECK((*prepared.request.address == LssAddress{0x319, 0xFFFFFFFF, 0, 0xFFFFFFFF}));
  arguments.address[2] = "4294967296";
  CHECK(fault_of(arguments) == "--address: '4294967296' is no number in 0...4294967295");
  arguments.address = {"1", "2", "3"};
  CHECK(fault_of(arguments) == "--address: an LSS address has four numbers");
  arguments = lss(LssAction::scan);
  arguments.address = {"1", "2", "3", "4"};
  CHECK(fault_of(arguments) == "--address: scan looks for all nodes without node-ID");
}

TEST_CASE("demo arguments: lss: only node-IDs and bit rates of CiA 305 are accepted") {
  CHECK(lexican::prepare(lss(LssAction::set_id, "1")).request.value == 1);
  CHECK(lexican::prepare(lss(LssAction::set_id, "0x7F")).request.value == 127);
  CHECK(fault_of(lss(LssAction::set_id, "0")) == "set-id: '0' is no number in 1...127");
  CHECK(fault_of(lss(LssAction::set_id, "128")) == "set-id: '128' is no number in 1...127");
  for (const char* rate : {"1000000", "800000", "500000", "250000", "125000", "50000", "20000", "10000"}) {
    const LssPrepared prepared = lexican::prepare(lss(LssAction::set_bit_rate, rate));
    CHECK(prepared.fault == "");
    CHECK(std::to_string(prepared.request.value) == rate);
  }
  for (const char* rate : {"0", "100000", "500"}) {
    CHECK(fault_of(lss(LssAction::set_bit_rate, rate)) ==
          "set-bitrate: '" + std::string(rate) +
              "' is none of 1000000, 800000, 500000, 250000, 125000, 50000, 20000, 10000");
  }
  CHECK(fault_of(lss(LssAction::set_bit_rate, "fast")) == "set-bitrate: 'fast' is no number in 0...4294967295");
}

TEST_CASE("demo arguments: lss: --store without a change is refused") {
  for (const LssAction action : {LssAction::scan, LssAction::inquire}) {
    LssArguments arguments = lss(action);
    arguments.store = true;
    CHECK(fault_of(arguments) == "--store: scan and inquire change nothing that could be stored");
  }
}

TEST_CASE("demo arguments: lss: times, own node-ID and --store are parsed") {
  LssArguments arguments = lss(LssAction::set_id, "5");
  arguments.store = true;
  arguments.own_id = "3";
  arguments.timeout = "1";
  arguments.listen = "4294967295";
  const LssPrepared prepared = lexican::prepare(arguments);
  CHECK(prepared.fault == "");
  CHECK(prepared.request.store);
  CHECK(prepared.request.own_id == 3);
  CHECK(prepared.request.timeout == 1);
  CHECK(prepared.request.listen == 4294967295);
  arguments.timeout = "0";
  CHECK(fault_of(arguments) == "--timeout: '0' is no number in 1...4294967295");
  arguments.timeout = "1";
  arguments.listen = "0";
  CHECK(fault_of(arguments) == "--listen: '0' is no number in 1...4294967295");
  arguments.listen = "1";
  arguments.own_id = "128";
  CHECK(fault_of(arguments) == "--own-id: '128' is no number in 1...127");
}
#endif
