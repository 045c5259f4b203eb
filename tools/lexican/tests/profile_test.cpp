// SPDX-License-Identifier: Apache-2.0
// Devices of the profiles CiA 402 and CiA 401, which behave without a script. Values typed from CiA 402-2 and 401-1.
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <sstream>

#include "simulated_devices.hpp"

namespace {

using namespace lexican;

const std::string servo_eds = LEXICAN_TOOL_DIR "/tests/fixtures/servo.eds";
const std::string module_eds = LEXICAN_TOOL_DIR "/tests/fixtures/module.eds";

struct ProfileBus : SimulatedDevices {
  explicit ProfileBus(const std::string& path) : SimulatedDevices(path, 5, 1) {}

  void frame(std::uint32_t id, const Bytes& data) {
    CO_IF_FRM frame{};
    frame.Identifier = id;
    frame.DLC = static_cast<std::uint8_t>(data.size());
    std::copy(data.begin(), data.end(), frame.Data);
    network.bus().inject(frame);
    client->sdo().upload(0x1001, 0, {SdoClient::small, 20, {}});
  }
  void write(std::uint16_t index, std::int64_t value, unsigned size, std::uint8_t sub_index = 0) {
    Bytes bytes;
    for (unsigned n = 0; n < size; ++n) {
      bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> 8 * n));
    }
    const Transfer transfer = client->sdo().download(index, sub_index, bytes);
    CHECK_MESSAGE(transfer.done(), transfer.outcome());
  }
  void control(unsigned word) { write(0x6040, word, 2); }
  unsigned status() { return static_cast<unsigned>(number(0x6041)); }
  std::int64_t number(std::uint16_t index, std::uint8_t sub_index = 0) {
    const std::string text = read(index, sub_index);
    const bool is_hex = !text.empty() && text.back() == 'h';
    return std::stoll(text, nullptr, is_hex ? 16 : 10);
  }
  void enable(int mode) {
    write(0x6060, mode, 1);
    control(0x06);
    control(0x07);
    control(0x0F);
  }
  /// Returns the answer to the command get.
  std::string shown(const std::string& object) {
    bool is_fault = false;
    return simulation.execute("get " + object, is_fault);
  }
  void master_starts() {
    frame(0x000, {0x01, 5});
    frames.clear();
  }
};

TEST_CASE("drive: the states of CiA 402 by controlword and statusword") {
  ProfileBus bus(servo_eds);
  CHECK(bus.status() == 0x0250);  // switch on disabled
  bus.control(0x07);
  CHECK(bus.status() == 0x0250);
  bus.control(0x0F);
  CHECK(bus.status() == 0x0250);
  bus.control(0x06);
  CHECK(bus.status() == 0x0231);  // ready to switch on
  bus.control(0x07);
  CHECK(bus.status() == 0x0233);  // switched on
  bus.control(0x0F);
  CHECK((bus.status() & 0x6F) == 0x27);  // operation enabled
  bus.control(0x07);
  CHECK((bus.status() & 0x6F) == 0x23);
  bus.control(0x06);
  CHECK((bus.status() & 0x6F) == 0x21);
  bus.control(0x0F);  // switch on and enable operation
  CHECK((bus.status() & 0x6F) == 0x27);
  bus.control(0x06);
  CHECK((bus.status() & 0x6F) == 0x21);
  bus.control(0x00);
  CHECK((bus.status() & 0x4F) == 0x40);
  bus.control(0x06);
  bus.control(0x02);  // quick stop
  CHECK((bus.status() & 0x4F) == 0x40);
}

TEST_CASE("drive: statusword as event-driven TPDO, controlword as RPDO") {
  ProfileBus bus(servo_eds);
  bus.master_starts();
  bus.frame(0x205, {0x06, 0x00});
  bus.frame(0x205, {0x07, 0x00});
  CHECK(bus.received(0x185) == std::vector<Bytes>{{0x31, 0x02}, {0x33, 0x02}});
}

TEST_CASE("drive: a fault by command, and its reset by the rising edge of bit 7") {
  ProfileBus bus(servo_eds);
  bus.enable(3);
  bus.run("emcy 4310");
  bus.pass(20 * millisecond);
  CHECK(bus.status() == 0x0218);
  CHECK(bus.read(0x603F) == "17168");  // 4310h
  CHECK(bus.number(0x1001) == 0x09);
  bus.control(0x06);
  CHECK(bus.status() == 0x0218);
  bus.control(0x80);
  CHECK(bus.status() == 0x0250);
  CHECK(bus.number(0x1001) == 0);
  CHECK(bus.received(0x085) == std::vector<Bytes>{{0x10, 0x43, 0x09, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 0}});
  bus.run("emcy 4310");
  bus.control(0x80);  // no edge
  CHECK(bus.status() == 0x0218);
  bus.control(0x00);
  bus.control(0x80);
  CHECK(bus.status() == 0x0250);
}

TEST_CASE("drive: profile velocity with ramps, halt and quick stop") {
  ProfileBus bus(servo_eds);
  bus.enable(3);
  CHECK(bus.number(0x6061) == 3);
  CHECK(bus.status() == 0x1637);  // speed 0, target reached
  bus.write(0x60FF, 2000, 4);
  bus.pass(100 * millisecond);  // 10000 per s²
  const std::int64_t half = bus.number(0x606C);
  CHECK(half >= 900);
  CHECK(half <= 1200);
  CHECK(bus.status() == 0x0237);
  bus.pass(150 * millisecond);
  CHECK(bus.number(0x606C) == 2000);
  CHECK(bus.number(0x606B) == 2000);
  CHECK(bus.status() == 0x0637);
  const std::int64_t place = bus.number(0x6064);
  bus.pass(100 * millisecond);
  CHECK(bus.number(0x6064) - place >= 200);
  CHECK(bus.number(0x6064) - place <= 230);
  bus.control(0x10F);  // halt, 5000 per s²
  bus.pass(200 * millisecond);
  CHECK(bus.number(0x606C) > 800);
  CHECK(bus.number(0x606C) < 1100);
  bus.pass(250 * millisecond);
  CHECK(bus.status() == 0x1637);
  bus.control(0x0F);
  bus.pass(300 * millisecond);
  CHECK(bus.number(0x606C) == 2000);
  bus.control(0x02);  // quick stop, 20000 per s², option 2
  CHECK(bus.status() == 0x0217);
  bus.pass(50 * millisecond);
  CHECK(bus.number(0x606C) > 0);
  bus.pass(100 * millisecond);
  CHECK(bus.number(0x606C) == 0);
  CHECK(bus.status() == 0x0250);
  bus.write(0x605A, 6, 2);
  bus.write(0x60FF, 100000, 4);  // more than 6080h
  bus.control(0x06);
  bus.control(0x0F);
  bus.pass(1000 * millisecond);
  CHECK((bus.status() & 0x0C00) == 0x0800);  // internal limit active, target not reached
  bus.control(0x02);
  bus.pass(1000 * millisecond);
  CHECK(bus.status() == 0x0617);  // stays in quick stop active
  bus.control(0x0F);
  CHECK((bus.status() & 0x6F) == 0x27);
}

TEST_CASE("drive: at rest it does not wake up the program") {
  ProfileBus bus(servo_eds);
  bus.enable(3);
  bus.pass(20 * millisecond);
  CHECK(bus.simulation.process() > 100 * millisecond);
  bus.write(0x60FF, 100, 4);
  bus.simulation.process();
  CHECK(bus.simulation.process() <= millisecond);
  bus.write(0x60FF, 0, 4);
  bus.pass(100 * millisecond);
  CHECK(bus.simulation.process() > 100 * millisecond);
}

TEST_CASE("drive: modes that 6502h does not have are ignored, and resets reset the drive") {
  ProfileBus bus(servo_eds);
  bus.enable(3);
  bus.write(0x6060, 4, 1);  // profile torque
  CHECK(bus.number(0x6061) == 3);
  bus.frame(0x000, {0x81, 5});
  bus.pass(20 * millisecond);
  CHECK(bus.status() == 0x0250);
  CHECK(bus.number(0x6061) == 0);
  bus.enable(3);
  bus.run("reboot");
  bus.pass(20 * millisecond);
  CHECK(bus.status() == 0x0250);
  bus.enable(3);
  bus.frame(0x000, {0x02, 5});  // NMT stop: abort connection, option 1
  bus.frame(0x000, {0x80, 5});
  bus.pass(20 * millisecond);
  CHECK(bus.status() == 0x0218);
}

TEST_CASE("drive: profile position with set-points, acknowledge and target reached") {
  ProfileBus bus(servo_eds);
  bus.enable(1);
  CHECK(bus.status() == 0x0637);
  bus.write(0x607A, 500, 4);
  bus.control(0x1F);
  CHECK(bus.status() == 0x1237);  // acknowledged, on the way
  bus.control(0x0F);
  CHECK(bus.status() == 0x0237);
  bus.pass(250 * millisecond);
  CHECK(bus.number(0x606C) == 1000);  // profile velocity
  bus.pass(600 * millisecond);
  CHECK(bus.number(0x6064) == 500);
  CHECK(bus.number(0x606C) == 0);
  CHECK(bus.status() == 0x0637);
  bus.control(0x5F);  // relative
  bus.control(0x0F);
  bus.pass(50 * millisecond);
  bus.write(0x607A, 100, 4);
  bus.control(0x1F);  // waits
  bus.control(0x0F);
  CHECK(bus.status() == 0x1237);  // no place for another one
  bus.write(0x607A, 77, 4);
  bus.control(0x1F);
  bus.control(0x0F);
  bus.pass(700 * millisecond);
  CHECK(bus.number(0x6064) > 900);
  bus.pass(2000 * millisecond);
  CHECK(bus.number(0x6064) == 100);
  CHECK(bus.status() == 0x0637);
  bus.write(0x607A, 5000, 4);
  bus.control(0x3F);
  bus.control(0x2F);
  bus.pass(300 * millisecond);
  bus.write(0x607A, 0, 4);
  bus.control(0x3F);  // immediately
  bus.pass(1500 * millisecond);
  CHECK(bus.number(0x6064) == 0);
  CHECK(bus.status() == 0x1637);
  bus.control(0x0F);
  CHECK(bus.status() == 0x0637);
}

TEST_CASE("drive: a set-point whose target position is behind the controlword in the same RPDO") {
  ProfileBus bus(servo_eds);
  bus.master_starts();
  bus.enable(1);
  bus.frame(0x305, {0x1F, 0x00, 200, 0, 0, 0});
  bus.frame(0x080, {});
  bus.pass(600 * millisecond);
  CHECK(bus.number(0x6064) == 200);
  bus.frame(0x305, {0x0F, 0x00, 150, 0, 0, 0});
  bus.frame(0x080, {});
  bus.pass(100 * millisecond);
  CHECK(bus.number(0x6064) == 200);
}

TEST_CASE("drive: profile position with halt, software limits, and without motion at the target") {
  ProfileBus bus(servo_eds);
  bus.write(0x607D, -1000, 4, 1);
  bus.write(0x607D, 300, 4, 2);
  bus.enable(1);
  bus.write(0x607A, 2000, 4);
  bus.control(0x1F);
  CHECK(bus.status() == 0x1A37);  // internal limit active
  bus.pass(100 * millisecond);
  bus.control(0x11F);
  bus.pass(300 * millisecond);
  CHECK(bus.number(0x606C) == 0);
  CHECK((bus.status() & 0x0400) != 0);  // stopped by halt
  const std::int64_t place = bus.number(0x6064);
  CHECK(place < 300);
  bus.control(0x1F);
  bus.pass(600 * millisecond);
  CHECK(bus.number(0x6064) == 300);
  bus.control(0x0F);
  CHECK(bus.status() == 0x0E37);
  bus.write(0x607A, 300, 4);
  bus.control(0x1F);
  bus.pass(50 * millisecond);
  CHECK(bus.status() == 0x1637);
}

TEST_CASE("drive: homing") {
  ProfileBus bus(servo_eds);
  bus.run("set 6064 1234");
  bus.write(0x607C, -20, 4);
  bus.enable(6);
  CHECK(bus.status() == 0x0637);
  bus.control(0x1F);
  CHECK(bus.status() == 0x1637);  // attained, target reached
  CHECK(bus.number(0x6064) == -20);
  bus.control(0x0F);
  bus.write(0x6098, 17, 1);
  bus.control(0x1F);
  CHECK(bus.status() == 0x0237);  // in progress
  bus.pass(100 * millisecond);
  CHECK(bus.number(0x606C) == -500);
  bus.pass(300 * millisecond);
  CHECK(bus.status() == 0x1637);
  CHECK(bus.number(0x6064) == -20);
  bus.control(0x0F);
  bus.control(0x1F);
  bus.pass(50 * millisecond);
  bus.control(0x0F);  // interrupted
  bus.pass(100 * millisecond);
  CHECK(bus.status() == 0x0637);
  bus.write(0x6098, 0, 1);
  bus.control(0x1F);
  CHECK((bus.status() & 0x3000) == 0x2000);  // homing error
}

TEST_CASE("drive: cyclic synchronous position with SYNC, and velocity") {
  ProfileBus bus(servo_eds);
  bus.write(0x6060, 8, 1);
  bus.master_starts();
  for (const std::uint8_t word : {std::uint8_t{0x06}, std::uint8_t{0x07}, std::uint8_t{0x0F}}) {
    bus.frame(0x305, {word, 0, 0, 0, 0, 0});
    bus.frame(0x080, {});
  }
  bus.frame(0x080, {});
  CHECK((bus.status() & 0x106F) == 0x1027);  // follows the command value
  bus.frames.clear();
  for (std::uint8_t n = 1; n <= 5; ++n) {
    bus.frame(0x305, {0x0F, 0, static_cast<std::uint8_t>(10 * n), 0, 0, 0});
    bus.frame(0x080, {});
    bus.pass(5 * millisecond);
    CHECK(bus.number(0x6064) == 10 * n);
  }
  bus.frame(0x080, {});
  CHECK(bus.received(0x285).back() == Bytes{0x37, 0x12, 50, 0, 0, 0});
  bus.write(0x6060, 9, 1);
  bus.write(0x60FF, -3000, 4);
  bus.pass(5 * millisecond);
  CHECK(bus.number(0x606C) == -3000);
  bus.pass(100 * millisecond);
  CHECK(bus.number(0x6064) < -250);
}

TEST_CASE("drive: a following error beyond its window and time is a fault") {
  ProfileBus bus(servo_eds);
  bus.enable(1);
  bus.run("set 6064 -100");  // held
  bus.pass(50 * millisecond);
  CHECK(bus.number(0x60F4) == 100);
  CHECK((bus.status() & 0x204F) == 0x0007);
  bus.write(0x607A, 5000, 4);
  bus.control(0x1F);
  bus.pass(700 * millisecond);
  CHECK(bus.status() == 0x2218);
  CHECK(bus.number(0x603F) == 0x8611);
  CHECK(bus.received(0x085) == std::vector<Bytes>{{0x11, 0x86, 0x21, 0, 0, 0, 0, 0}});
  CHECK(bus.number(0x6064) == -100);
  bus.control(0x00);
  bus.control(0x80);
  CHECK(bus.status() == 0x0250);
  CHECK(bus.received(0x085).back() == Bytes{0, 0, 0, 0, 0, 0, 0, 0});
  bus.enable(1);
  bus.write(0x607A, 0, 4);
  bus.control(0x1F);
  bus.pass(500 * millisecond);
  CHECK(bus.number(0x6064) == 0);
}

TEST_CASE("drive: a cyclic target that it cannot follow is a following error") {
  ProfileBus bus(servo_eds);
  bus.enable(8);
  bus.write(0x607A, 400, 4);  // a step within the window
  bus.pass(50 * millisecond);
  CHECK(bus.number(0x6064) == 400);
  CHECK((bus.status() & 0x6F) == 0x27);
  bus.write(0x607A, 9000, 4);  // 50000 per s by 6080h: too far behind for longer than 10 ms
  bus.pass(300 * millisecond);
  CHECK(bus.status() == 0x2218);
  CHECK(bus.number(0x603F) == 0x8611);
  CHECK(bus.number(0x6064) < 9000);
}

TEST_CASE("drive: without heartbeat of the master it does what 6007h demands") {
  for (const int option : {0, 1, 2, 3}) {
    CAPTURE(option);
    ProfileBus bus(servo_eds);
    bus.write(0x6007, option, 2);
    bus.write(0x1016, 0x00090064, 4, 1);  // node 9, 100 ms
    bus.enable(3);
    bus.frame(0x709, {0x05});
    bus.pass(50 * millisecond);
    CHECK((bus.status() & 0x6F) == 0x27);
    bus.pass(150 * millisecond);
    const unsigned status = bus.status() & 0x6F;
    CHECK((option == 0 ? status == 0x27 : option == 1 ? status == 0x08 : (status & 0x4F) == 0x40));
  }
}

TEST_CASE("drive: values that a command sets stay until the axis changes them") {
  ProfileBus bus(servo_eds);
  bus.run("set 606C 77");
  bus.control(0x06);
  bus.pass(20 * millisecond);
  CHECK(bus.number(0x606C) == 77);
  bus.enable(3);
  bus.write(0x60FF, 10, 4);
  bus.pass(20 * millisecond);
  CHECK(bus.number(0x606C) == 10);
}

TEST_CASE("drive: an event-driven TPDO with the position is sent every 10 ms, and at the end of the motion") {
  ProfileBus bus(servo_eds);
  bus.write(0x1801, 255, 1, 2);
  bus.enable(1);
  bus.write(0x6084, 100, 4);  // the last ms do not change the position
  bus.write(0x607A, 50, 4);
  bus.master_starts();
  bus.control(0x1F);
  bus.pass(1500 * millisecond);
  const std::vector<Bytes> frames = bus.received(0x285);
  CHECK(frames.size() > 30);
  CHECK(frames.size() < 150);
  CHECK(frames.back() == Bytes{0x37, 0x16, 50, 0, 0, 0});
  CHECK(bus.number(0x6064) == 50);
}

TEST_CASE("drive: an event-driven TPDO with position and speed has both of the same step") {
  ProfileBus bus(servo_eds);
  bus.write(0x1801, 0xC0000285, 4, 1);
  bus.write(0x1801, 255, 1, 2);
  bus.write(0x1A01, 0, 1);
  bus.write(0x1A01, 0x60640020, 4, 1);
  bus.write(0x1A01, 0x606C0020, 4, 2);
  bus.write(0x1A01, 2, 1);
  bus.write(0x1801, 0x40000285, 4, 1);
  bus.write(0x6083, 10'000, 4);
  bus.enable(3);
  bus.master_starts();
  bus.write(0x60FF, 1'000, 4);
  bus.pass(90 * millisecond);  // the speed increases all the time
  const std::vector<Bytes> frames = bus.received(0x285);
  CHECK(frames.size() >= 7);
  CHECK(frames.size() <= 10);
  const auto is_part_old = [](const Bytes& one, const Bytes& next) {
    return std::equal(one.begin(), one.begin() + 4, next.begin()) ||
           std::equal(one.begin() + 4, one.end(), next.begin() + 4);
  };
  CHECK(std::adjacent_find(frames.begin(), frames.end(), is_part_old) == frames.end());
}

/// Writes the description of a drive with the objects of a second axis. Returns its path.
std::string two_axes() {
  std::istringstream lines(bytes_of_file(servo_eds));
  std::string objects;
  std::string text;
  unsigned number = 0;
  bool is_copied = false;
  for (std::string line; std::getline(lines, line);) {
    const bool is_section = !line.empty() && line[0] == '[';
    const bool is_of_profile = is_section && line[1] == '6';
    is_copied = is_section ? is_of_profile : is_copied;
    char index[8] = {};
    if (is_of_profile) {
      std::snprintf(index, sizeof index, "%04lX", std::stoul(line.substr(1, 4), nullptr, 16) + 0x800);
      number += line.size() == 6 ? 1U : 0U;
      text += line.size() == 6 ? std::to_string(number) + "=0x" + index + "\n" : "";
    }
    objects += !is_copied ? "" : is_section ? std::string("[") + index + line.substr(5) + "\n" : line + "\n";
  }
  const std::string list = "[ManufacturerObjects]\nSupportedObjects=";
  std::string all = bytes_of_file(servo_eds);
  all.replace(all.find(list), list.size() + 2, list + std::to_string(number) + "\n" + text);
  const std::string path = "/tmp/lexican-axes-" + std::to_string(getpid()) + ".eds";
  std::ofstream(path, std::ios::binary) << all << '\n' << objects;
  return path;
}

TEST_CASE("drive: each axis has its own state, and a fault by command is one of all axes") {
  const std::string path = two_axes();
  ProfileBus bus(path);
  std::filesystem::remove(path);
  bus.write(0x6860, 3, 1);
  bus.write(0x6840, 0x06, 2);
  bus.write(0x6840, 0x0F, 2);
  CHECK(bus.number(0x6841) == 0x1637);
  CHECK(bus.number(0x6861) == 3);
  CHECK(bus.status() == 0x0250);
  bus.write(0x68FF, 500, 4);
  bus.pass(100 * millisecond);
  CHECK(bus.number(0x686C) == 500);
  CHECK(bus.number(0x606C) == 0);
  bus.run("emcy 3210");
  bus.pass(100 * millisecond);
  CHECK(bus.number(0x6841) == 0x0218);
  CHECK(bus.status() == 0x0218);
}

TEST_CASE("I/O module: digital inputs with polarity and interrupt masks") {
  ProfileBus bus(module_eds);
  bus.master_starts();
  bus.run("set 6000:1 5");
  CHECK(bus.number(0x6000, 1) == 5);
  bus.write(0x6002, 0x0F, 1, 1);  // polarity
  CHECK(bus.number(0x6000, 1) == 0x0A);
  CHECK(bus.shown("6000:1") == "6000h:01 Read input 8-bit, Inputs 1 to 8 = 10, terminals 5");
  CHECK(bus.received(0x185) == std::vector<Bytes>{{0x05}, {0x0A}});
  bus.frames.clear();
  bus.write(0x6006, 0x80, 1, 1);  // any change: input 8 only
  bus.write(0x6007, 0x01, 1, 1);  // low to high: input 1
  bus.write(0x6008, 0x02, 1, 1);  // high to low: input 2
  bus.run("set 6000:1 4");        // input 1: 1
  CHECK(bus.number(0x6000, 1) == 0x0B);
  bus.run("set 6000:1 5");  // input 1: 0
  bus.run("set 6000:1 7");  // input 2: 0
  bus.run("set 6000:1 5");  // input 2: 1
  bus.run("set 6000:1 69");
  bus.run("set 6000:1 133");
  CHECK(bus.number(0x6000, 1) == 0x8A);
  CHECK(bus.received(0x185) == std::vector<Bytes>{{0x0B}, {0x08}, {0x8A}});
  bus.frames.clear();
  bus.write(0x6005, 0, 1);
  bus.run("set 6000:1 0");
  CHECK(bus.number(0x6000, 1) == 0x0F);
  CHECK(bus.received(0x185).empty());
}

TEST_CASE("I/O module: digital outputs with polarity, filter mask and error mode") {
  ProfileBus bus(module_eds);
  const std::string object = "6200h:01 Write output 8-bit, Outputs 1 to 8 = ";
  bus.master_starts();
  bus.frame(0x205, {0x35});
  CHECK(bus.number(0x6200, 1) == 0x35);
  CHECK(bus.shown("6200:1") == object + "53, terminals 53");
  bus.write(0x6202, 0x03, 1, 1);
  CHECK(bus.shown("6200:1") == object + "53, terminals 54");  // 36h
  bus.write(0x6208, 0xF0, 1, 1);
  bus.frame(0x205, {0xC0});
  CHECK(bus.shown("6200:1") == object + "192, terminals 198");  // C6h
  bus.write(0x6206, 0x0F, 1, 1);
  bus.write(0x6207, 0x09, 1, 1);
  bus.frame(0x000, {0x02, 5});
  bus.network.wait(millisecond);
  CHECK(bus.shown("6200:1") == object + "192, terminals 201");  // C9h
  bus.frame(0x000, {0x01, 5});
  bus.write(0x6208, 0xFF, 1, 1);
  bus.frame(0x205, {0x00});
  CHECK(bus.shown("6200:1") == object + "0, terminals 3");
}

TEST_CASE("I/O module: analogue inputs with delta and interrupt, and outputs with an error value") {
  ProfileBus bus(module_eds);
  bus.master_starts();
  bus.run("set 6401:1 1000");
  CHECK(bus.number(0x6401, 1) == 1000);
  CHECK(bus.received(0x285).empty());  // the interrupt is disabled by default
  bus.write(0x6423, 1, 1);
  bus.write(0x6426, 100, 4, 1);
  bus.run("set 6401:1 -200");
  bus.run("set 6401:1 -300");
  bus.run("set 6401:1 -301");
  CHECK(bus.number(0x6401, 1) == -301);
  CHECK(bus.received(0x285) == std::vector<Bytes>{{0x38, 0xFF}, {0xD3, 0xFE}});
  bus.frame(0x305, {0xE8, 0x03});
  CHECK(bus.number(0x6411, 1) == 1000);
  bus.write(0x6444, -5, 4, 1);
  bus.frame(0x000, {0x02, 5});
  bus.network.wait(millisecond);
  CHECK(bus.shown("6411:1") == "6411h:01 Write analogue output 16-bit, Output 1 = 1000, terminals -5");
  bus.frame(0x000, {0x01, 5});
  bus.frame(0x305, {0x01, 0x00});
  CHECK(bus.shown("6411:1") == "6411h:01 Write analogue output 16-bit, Output 1 = 1");
}

}  // namespace
