// SPDX-License-Identifier: Apache-2.0
// A device and its master on two controllers of one bus: SDO, PDO, EMCY, bus-off and recovery through the drivers for
// bxCAN, M_CAN and FlexCAN.
#include <array>
#include <iterator>

#include "bench.hpp"
#include "co_core.h"
#include "lexican/dictionary.hpp"
#include "support/notation.hpp"
#include "virtual_clock.hpp"

namespace {

using namespace test;
using Texts = std::vector<std::string>;
using Codes = std::vector<std::uint16_t>;

constexpr std::uint8_t device_id = 5;
constexpr std::uint8_t master_id = 1;
constexpr std::uint32_t bits_per_ms = Bench::baud / 1000;

// Number of callbacks of a node, and their last arguments.
struct Events {
  std::array<unsigned, CO_CAN_EVENT_NUM> can{};
  std::vector<std::uint16_t> emergencies;  // error codes
};

struct Objects {
  std::uint8_t error_register = 0;
  std::uint32_t received = 0;
  std::uint32_t sent = 0;
  std::uint8_t memory[600] = {};
};
Objects device_objects;
Objects master_objects;
CO_OBJ_DOM domain = {0, sizeof device_objects.memory, device_objects.memory};

constexpr CO_OBJ device_od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x00020192)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&device_objects.error_register)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(0x200)},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(255)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 1, 32))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(0x180)},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(255)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2200, 1, 32))},
    {CO_KEY(0x2010, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&domain)},
    {CO_KEY(0x2100, 1, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&device_objects.received)},
    {CO_KEY(0x2200, 1, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&device_objects.sent)},
};
CO_OD_CHECK(device_od);

constexpr CO_OBJ master_od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&master_objects.error_register)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(device_id)},
    {CO_KEY(0x1028, device_id, CO_OBJ_D___R_), CO_TEMCY_CONS, (CO_DATA)(0x80 + device_id)},
    {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x600 + device_id)},
    {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x580 + device_id)},
    {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(device_id)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x180 + device_id)},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(255)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 1, 32))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x40000200 + device_id)},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(255)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2200, 1, 32))},
    {CO_KEY(0x2100, 1, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&master_objects.received)},
    {CO_KEY(0x2200, 1, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&master_objects.sent)},
};
CO_OD_CHECK(master_od);

CO_EMCY_TBL errors[CO_EMCY_N] = {{CO_EMCY_REG_VOLTAGE, CO_EMCY_CODE_VOL_INPUT_ERR}};

class Node {
 public:
  Node(Controller& can, co::VirtualClock& clock, std::uint8_t id) : timer_(clock, [this] { COTmrService(&node.Tmr); }) {
    ext_.Size = sizeof ext_;
    ext_.Can = can.driver;
    ext_.CanCtx = can.context();
    ext_.Timer = &co::VirtualTimerDriver;
    ext_.TimerCtx = &timer_;
    ext_.User = &events;
    CO_NODE_SPEC spec{};
    spec.NodeId = id;
    spec.Baudrate = Bench::baud;
    spec.Dict = const_cast<CO_OBJ*>(id == device_id ? device_od : master_od);
    spec.DictLen = static_cast<std::uint16_t>(id == device_id ? std::size(device_od) : std::size(master_od));
    spec.EmcyCode = id == device_id ? errors : nullptr;
    spec.TmrFreq = 1000;
    spec.SdoBuf = sdo_memory_.data();
    CONodeInitEx(&node, &spec, &ext_);
    REQUIRE(CONodeGetErr(&node) == CO_ERR_NONE);
    CONodeStart(&node);
  }
  ~Node() { CONodeStop(&node); }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  void process() {
    CONodeProcess(&node);
    COTmrProcess(&node.Tmr);
  }
  CO_MODE mode() { return CONmtGetMode(&node.Nmt); }

  CO_NODE node{};
  Events events;

 private:
  co::VirtualTimer timer_;
  CO_NODE_EXT ext_{};
  std::array<std::uint8_t, CO_SSDO_N * CO_SDO_BUF_BYTE> sdo_memory_{};
};

// Controllers of the device and the master.
struct Pair {
  Kind device;
  Kind master;
};
constexpr Pair pairs[] = {
    {Kind::bxcan, Kind::bxcan},       {Kind::fdcan, Kind::fdcan},     {Kind::mcan, Kind::mcan},
    {Kind::bxcan, Kind::fdcan},       {Kind::mcan, Kind::bxcan},      {Kind::flexcan2, Kind::flexcan2},
    {Kind::flexcan3, Kind::flexcan2}, {Kind::sja1000, Kind::sja1000}, {Kind::esp32c3, Kind::sja1000},
    {Kind::esp32, Kind::fdcan},       {Kind::mcp2515, Kind::mcp2515}, {Kind::bxcan, Kind::mcp2515},
    {Kind::mcp251xfd, Kind::mcp2515}};

ControllerOptions options_of(unsigned number, CO_CAN_RECOVERY recovery) {
  ControllerOptions options;
  options.starts = false;
  options.number = number;
  options.recovery = recovery;
  options.bxcan = {28, 14 * number, 14, 0, false};
  return options;
}

// Both nodes on one bus. The loop of each runs every 10 bit times, that is every 20 us.
struct Network {
  explicit Network(const Pair& pair, CO_CAN_RECOVERY recovery = CO_CAN_RECOVERY_BY_APPLICATION)
      : can(bench.add(pair.device, options_of(0, recovery))),
        master_can(bench.add(pair.master, options_of(pair.device == pair.master ? 1 : 0, recovery))),
        cleared((device_objects = {}, master_objects = {}, 0)),
        device(can, clock, device_id),
        master(master_can, clock, master_id) {
    run_ms(2);
  }

  void run_ms(unsigned milliseconds) {
    for (; milliseconds != 0; --milliseconds) {
      for (unsigned bits = 0; bits < bits_per_ms; bits += 10) {
        bench.run(10);
        device.process();
        master.process();
      }
      clock.advance(1);
    }
  }
  template <class Condition>
  bool run_until(Condition condition, unsigned milliseconds) {
    for (; !condition(); --milliseconds) {
      if (milliseconds == 0) {
        return false;
      }
      run_ms(1);
    }
    return true;
  }
  void start_all() {
    CHECK(CONmtCommand(&master.node.Nmt, CO_NMT_COMMAND_START, 0) == CO_ERR_NONE);
    run_ms(2);
    CHECK(device.mode() == CO_OPERATIONAL);
    CHECK(master.mode() == CO_OPERATIONAL);
  }

  Bench bench;
  co::VirtualClock clock;
  Controller& can;
  Controller& master_can;
  int cleared;
  Node device;
  Node master;
};

// SDO -----------------------------------------------------------------------------------------------------------------

struct Transfer {
  bool has_ended = false;
  std::uint32_t code = 0;
};
Transfer transfer;

void end_of_transfer(CO_CSDO* /*csdo*/, std::uint16_t /*index*/, std::uint8_t /*sub*/, std::uint32_t code) {
  transfer = {true, code};
}

void upload(Network& net, std::uint32_t key, std::vector<std::uint8_t>& bytes) {
  transfer = {};
  CO_CSDO* const client = COCSdoFind(&net.master.node, 0);
  const auto size = static_cast<std::uint32_t>(bytes.size());
  CHECK(COCSdoRequestUpload(client, key, bytes.data(), size, end_of_transfer, 500) == CO_ERR_NONE);
  CHECK(net.run_until([] { return transfer.has_ended; }, 1000));
  CHECK(transfer.code == 0);
}

void download(Network& net, std::uint32_t key, std::vector<std::uint8_t>& bytes) {
  transfer = {};
  CO_CSDO* const client = COCSdoFind(&net.master.node, 0);
  const auto size = static_cast<std::uint32_t>(bytes.size());
  CHECK(COCSdoRequestDownload(client, key, bytes.data(), size, end_of_transfer, 500) == CO_ERR_NONE);
  CHECK(net.run_until([] { return transfer.has_ended; }, 1000));
  CHECK(transfer.code == 0);
}

std::string name_of(const Pair& pair) { return name_of(pair.device) + ", " + name_of(pair.master); }

TEST_CASE("nodes on controllers: expedited and block transfers by SDO") {
  for (const Pair& pair : pairs) {
    CAPTURE(name_of(pair));
    Network net(pair);
    std::vector<std::uint8_t> type(4);
    upload(net, CO_DEV(0x1000, 0), type);
    CHECK(type == std::vector<std::uint8_t>{0x92, 0x01, 0x02, 0x00});
    std::vector<std::uint8_t> bytes(sizeof device_objects.memory);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      bytes[n] = static_cast<std::uint8_t>(n * 7 + n / 256);
    }
    const std::vector<std::uint8_t> written = bytes;
    download(net, CO_DEV(0x2010, 0), bytes);
    std::vector<std::uint8_t> read(bytes.size());
    upload(net, CO_DEV(0x2010, 0), read);
    CHECK(read == written);
    CHECK(std::equal(written.begin(), written.end(), device_objects.memory));
    CHECK(net.can.lost() == 0);
    CHECK(net.master_can.lost() == 0);
  }
}

// PDO, EMCY -----------------------------------------------------------------------------------------------------------

TEST_CASE("nodes on controllers: PDOs in both directions at the same time, EMCY") {
  for (const Pair& pair : pairs) {
    CAPTURE(name_of(pair));
    Network net(pair);
    net.start_all();
    for (std::uint32_t n = 1; n <= 50; ++n) {
      device_objects.sent = n;
      master_objects.sent = ~n;
      CHECK(COTPdoRequest(&net.device.node, 0) == CO_ERR_NONE);
      CHECK(COTPdoRequest(&net.master.node, 0) == CO_ERR_NONE);
      net.run_ms(1);
      CHECK(master_objects.received == n);
      CHECK(device_objects.received == ~n);
    }
    COEmcySet(&net.device.node.Emcy, 0, nullptr);
    net.run_ms(2);
    COEmcyClr(&net.device.node.Emcy, 0);
    net.run_ms(2);
    CHECK(net.master.events.emergencies == Codes{CO_EMCY_CODE_VOL_INPUT_ERR, 0});
  }
}

TEST_CASE("nodes on controllers: only the identifiers of the dictionary reach the node") {
  for (const Pair& pair : pairs) {
    if (is_sja1000(pair.device) || pair.device == Kind::mcp2515) {
      continue;  // few filters pass further identifiers
    }
    CAPTURE(name_of(pair));
    Network net(pair);
    for (std::uint32_t id = 0; id < 0x800; id += 3) {  // the device receives 000h, 705h (guarding) of these
      const std::uint32_t other = id == 0 || id == 0x705 ? 1 : id;
      net.bench.receive(standard_frame(other, {0xFF}));
    }
    CHECK(net.can.read_all() == Texts{});
    net.bench.receive(standard_frame(0x000, {0x01, device_id}));
    CHECK(net.can.has_frames());
    net.run_ms(1);
    CHECK(net.device.mode() == CO_OPERATIONAL);
  }
}

// Errors --------------------------------------------------------------------------------------------------------------

TEST_CASE("nodes on controllers: an overrun is reported to the application and by EMCY 8110h") {
  for (const Pair& pair : pairs) {
    CAPTURE(name_of(pair));
    Network net(pair);
    net.start_all();
    net.bench.are_interrupts_enabled = false;
    for (unsigned n = 0; n < net.can.fifo_places() + 1; ++n) {
      net.bench.receive(standard_frame(0x205, {1, 2, 3, 4}));
    }
    net.bench.are_interrupts_enabled = true;
    net.run_ms(3);
    CHECK(net.device.events.can[CO_CAN_OVERRUN] == 1);
    CHECK(net.master.events.emergencies == Codes{0x8110});
    CHECK(device_objects.received == 0x04030201);
  }
}

TEST_CASE("nodes on controllers: error passive and the return from it are reported") {
  for (const Pair& pair : pairs) {
    CAPTURE(name_of(pair));
    Network net(pair);
    net.start_all();
    net.can.node().set_counters(130, 0);
    net.run_ms(2);
    CHECK(net.device.events.can[CO_CAN_PASSIVE] == 1);
    CHECK(net.master.events.emergencies == Codes{0x8120});
    for (unsigned n = 0; n < 10; ++n) {
      static_cast<void>(COTPdoRequest(&net.device.node, 0));
      net.run_ms(1);
    }
    CHECK(net.device.events.can[CO_CAN_RECOVERED] == 1);
    CHECK(net.can.errors().Transmit < 128);
  }
}

// Destroys frames of the device until it is in bus-off.
void drive_to_bus_off(Network& net) {
  net.can.node().set_counters(250, 0);
  net.bench.wire.disturb_frames(1, 20, CanDisturbance::Kind::set_dominant, 12);
  static_cast<void>(COTPdoRequest(&net.device.node, 0));
  CHECK(net.run_until([&] { return net.can.is_off_bus(); }, 10));
  net.run_ms(1);
  CHECK(net.device.events.can[CO_CAN_BUS_OFF] == 1);
}

TEST_CASE("nodes on controllers: bus-off ends by the driver itself, or by the application after a delay") {
  for (const Pair& pair : pairs) {
    for (const CO_CAN_RECOVERY recovery : {CO_CAN_RECOVERY_AUTOMATIC, CO_CAN_RECOVERY_BY_APPLICATION}) {
      CAPTURE(name_of(pair));
      CAPTURE(int(recovery));
      Network net(pair, recovery);
      net.start_all();
      drive_to_bus_off(net);
      if (recovery == CO_CAN_RECOVERY_BY_APPLICATION) {
        net.run_ms(100);
        CHECK(net.can.is_off_bus());
        CHECK(net.device.events.can[CO_CAN_RECOVERED] == 0);
        COIfCanReset(&net.device.node.If);
      }
      CHECK(net.run_until([&] { return net.device.events.can[CO_CAN_RECOVERED] == 1; }, 20));
      net.run_ms(3);
      CHECK(net.master.events.emergencies == Codes{0x8120, 0x8140, 0});
      net.start_all();  // 1029h: the device is Pre-operational since the bus-off
      device_objects.sent = 0x12345678;
      CHECK(COTPdoRequest(&net.device.node, 0) == CO_ERR_NONE);
      net.run_ms(2);
      CHECK(master_objects.received == 0x12345678);
      std::vector<std::uint8_t> type(4);
      upload(net, CO_DEV(0x1000, 0), type);
      CHECK(type[0] == 0x92);
    }
  }
}

TEST_CASE("nodes on controllers: NMT reset communication ends bus-off and discards the frame in the controller") {
  for (const Pair& pair : pairs) {
    CAPTURE(name_of(pair));
    Network net(pair);
    net.start_all();
    drive_to_bus_off(net);
    CONmtReset(&net.device.node.Nmt, CO_RESET_COM);
    net.bench.wire.clear_records();
    CHECK(net.run_until([&] { return !net.bench.sent_by(net.can).empty(); }, 20));
    net.run_ms(5);
    CHECK(net.bench.sent_by(net.can) == Texts{"705#00"});  // 185h was in the controller, an EMCY message was queued
  }
}

}  // namespace

extern "C" {

void CONodeCanChange(CO_NODE* node, CO_CAN_EVENT event) {
  ++static_cast<Events*>(CONodeGetUser(node))->can[static_cast<std::size_t>(event)];
}
void COEmcyReceived(CO_NODE* node, std::uint8_t /*sender*/, std::uint16_t code, std::uint8_t /*reg*/,
                    const std::uint8_t* /*bytes*/) {
  Events& events = *static_cast<Events*>(CONodeGetUser(node));
  events.emergencies.push_back(code);
}
}
