// SPDX-License-Identifier: Apache-2.0
// Devices of the profiles CiA 402 and CiA 401, which behave without a script. Values typed from CiA 402-2 and 401-1.
#include <doctest/doctest.h>

#include "simulated_devices.hpp"

namespace {

using namespace lexican;

const std::string servo_eds = LEXICAN_TOOL_DIR "/tests/fixtures/servo.eds";

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

}  // namespace
