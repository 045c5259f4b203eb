// SPDX-License-Identifier: Apache-2.0
// Tests the driver of the CAN controllers. QEMU's model has no arbitration, errors or bit rates: bus-off, error
// passive, and a frame that overtakes one that has lost the arbitration are tested in tests/drivers/unit.
#include "bus.hpp"
#include "cases.hpp"
#include "machine.hpp"
#include "nodes.hpp"
#include "notation.hpp"

namespace zynqmp {
namespace {

constexpr std::uint16_t short_queue = 32;
constexpr unsigned fifo_frames = 64;

constexpr std::uint32_t mode_register = 0x04;
constexpr std::uint32_t prescaler_register = 0x08;
constexpr std::uint32_t timing_register = 0x0C;
constexpr std::uint32_t status_register = 0x18;
constexpr std::uint32_t filters_register = 0x60;

void send_many(unsigned number) {
  for (unsigned n = 0; n < number; ++n) {
    CO_IF_FRM frm = frame("205#00000000");
    frm.Data[0] = static_cast<std::uint8_t>(n + 1);
    CHECK(ZynqmpCanDriver.Send(&peer_can, &frm) > 0);
  }
}

// Checks that an overrun is reported first, then the frames, oldest first.
void overrun_of_fifo() {
  device_can.FrameNum = short_queue;
  start_operational();
  {
    const Quiet quiet;
    send_many(fifo_frames + 6);
  }
  CHECK_EQUAL(CORingCount(&device_can.Received), short_queue);
  RX("085#1081110000000000");
  run_ms(1);
  CHECK_EQUAL(record_of(device).can_events[CO_CAN_OVERRUN], 1);
  CHECK_EQUAL(record_of(device).pdos, short_queue);
  CHECK_EQUAL(objects.received[0], short_queue);
  CHECK_EQUAL(COCanZynqmpLost(&device_can), 1 + fifo_frames - short_queue);
  RX("085#0000000000000000", 1100);
  send_many(1);
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 1);
  CHECK_EQUAL(record_of(device).can_events[CO_CAN_OVERRUN], 1);
}

void overrun_of_queue() {
  device_can.FrameNum = short_queue;
  start_operational();
  send_many(short_queue);
  CHECK_EQUAL(COCanZynqmpLost(&device_can), 0);
  send_many(5);
  CHECK_EQUAL(COCanZynqmpLost(&device_can), 5);
  RX("085#1081110000000000");
  run_ms(1);
  CHECK_EQUAL(record_of(device).can_events[CO_CAN_OVERRUN], 1);
  CHECK_EQUAL(objects.received[0], short_queue);
  RX("085#0000000000000000", 1100);
}

void no_loss_in_bursts() {
  device_can.FrameNum = short_queue;
  start_operational();
  for (unsigned n = 0; n < 100; ++n) {
    send_many(short_queue);
    run(500);
    CHECK_EQUAL(objects.received[0], short_queue);
  }
  CHECK_EQUAL(record_of(device).pdos, 100 * short_queue);
  CHECK_EQUAL(COCanZynqmpLost(&device_can), 0);
}

// Sends a frame with each 11-bit identifier except 000h. Returns how many of them passed the device's filters.
unsigned receive_all_identifiers() {
  const std::uint32_t before = CONodeGetCounters(&device).Received;
  for (std::uint32_t id = 1; id < 0x800; ++id) {
    const CO_IF_FRM frm = {id, {}, 0};
    CHECK(ZynqmpCanDriver.Send(&peer_can, &frm) > 0);
    run(5);
  }
  run_ms(1);
  return CONodeGetCounters(&device).Received - before;
}

void filters() {
  start_operational();
  ASK("605#2300180185010080", "585#6000180100000000");  // no TPDOs: remote requests would be received
  ASK("605#2301180185020080", "585#6001180100000000");
  const std::uint32_t foreign = CONodeGetCounters(&device).Unclaimed;
  const unsigned passed = receive_all_identifiers();
  CHECK_EQUAL(control_register(device_can, filters_register), 0xF);
  CHECK(passed >= 6 && passed <= 24);  // of 2047 identifiers
  CHECK(CONodeGetCounters(&device).Unclaimed - foreign < passed);
  send("205#01000000");
  count_frames(1200, 0);  // receives EMCY messages
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 1);
}

void filters_follow() {
  start_operational();
  send("33A#01000000");
  run_ms(1);
  const std::uint32_t before = CONodeGetCounters(&device).Received;
  ASK("605#2300140105020080", "585#6000140100000000");
  ASK("605#230014013A030000", "585#6000140100000000");
  send("33A#07000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 7);
  CHECK_EQUAL(CONodeGetCounters(&device).Received - before, 3);
}

void exact_filters() {
  const std::uint32_t ids[] = {0x123, 0x123, 0x456, 0x80012345, 0x80012346};
  start_device();
  ZynqmpCanDriver.Filter(&device_can, ids, 5);
  const std::uint32_t before = CONodeGetCounters(&device).Received;
  CHECK_EQUAL(receive_all_identifiers(), 2);
  for (const char* text : {"00012344#", "00012345#", "00012346#", "00012347#", "00000123#", "123#R", "00012345#R"}) {
    send(text);
    run_ms(1);
  }
  CHECK_EQUAL(CONodeGetCounters(&device).Received - before, 2 + 4);
}

CO_IF_FRM with_number(const char* text, std::uint8_t number) {
  CO_IF_FRM frm = frame(text);
  frm.Data[0] = number;
  return frm;
}

void send_from_device(const char* text) {
  CO_IF_FRM frm = frame(text);
  CHECK(COIfCanSend(&device.If, &frm) > 0);
}

void priority() {
  start_operational();
  hold(device_can);
  for (const char* text : {"6AA#", "5AA#", "3AA#01", "0AA#", "3AA#02", "00000001#", "1AA#"}) {
    send_from_device(text);
  }
  SILENT(2);
  release(device_can);
  RX("6AA#");  // already in the controller when the others were queued
  RX("00000001#");
  RX("0AA#");
  RX("1AA#");
  RX("3AA#01");
  RX("3AA#02");
  RX("5AA#");
}

void order_of_one_identifier() {
  start_operational();
  hold(device_can);
  for (std::uint8_t n = 1; n <= 20; ++n) {
    CO_IF_FRM frm = with_number("6AA#00", n);
    CHECK(COIfCanSend(&device.If, &frm) > 0);
  }
  release(device_can);
  for (std::uint8_t n = 1; n <= 20; ++n) {
    const CO_IF_FRM frm = with_number("6AA#00", n);
    RX(notation(frm).characters);
  }
}

void boot_up_first() {
  start_device([] { hold(device_can); });
  send_from_device("0AA#");
  SILENT(2);
  release(device_can);
  RX("705#00");
  RX("0AA#");
}

void sends_at_once() {
  start_operational();
  hold(device_can);
  for (std::uint8_t n = 1; n <= 10; ++n) {
    CO_IF_FRM frm = with_number("6AA#00", n);
    CHECK(COIfCanSend(&device.If, &frm) > 0);
  }
  run_ms(1);
  const std::uint64_t begin = micros();
  release(device_can);
  std::uint64_t end = 0;
  for (std::uint8_t n = 1; n <= 10; ++n) {
    const CO_IF_FRM frm = with_number("6AA#00", n);
    end = RX(notation(frm).characters);
  }
  CHECK(end - begin < 500);  // sent from the interrupt, not by the node's retry each ms
}

void reset_drops_frames() {
  start_operational();
  send_many(3);
  CHECK_EQUAL(CORingCount(&device_can.Received), 3);
  {
    const Quiet quiet;
    send_many(3);
    ZynqmpCanDriver.Reset(&device_can);
  }
  CHECK_EQUAL(CORingCount(&device_can.Received), 0);
  SILENT(20);
  CHECK_EQUAL(record_of(device).pdos, 0);
  send("205#07000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 7);
  send_from_device("6AB#");
  RX("6AB#");
}

void close() {
  start_operational();
  ZynqmpCanDriver.Close(&device_can);
  const CO_IF_FRM frm = frame("6AA#");
  CHECK(ZynqmpCanDriver.Send(&device_can, &frm) < 0);
  send("205#07000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 0);
  ZynqmpCanDriver.Reset(&device_can);
  send("205#08000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 0);
  ZynqmpCanDriver.Enable(&device_can, 500000);
  send("205#09000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 9);
}

void sleep() {
  start_operational();
  COCanZynqmpSleep(&device_can);
  CHECK_EQUAL(control_register(device_can, status_register) & 4U, 4U);
  send("205#07000000");
  run_ms(1);
  CHECK_EQUAL(objects.received[0], 7);
  CHECK_EQUAL(control_register(device_can, status_register) & 4U, 0U);
  COCanZynqmpSleep(&device_can);
  send_from_device("6AA#");
  RX("6AA#");
  CHECK_EQUAL(control_register(device_can, status_register) & 4U, 0U);
}

void loopback() {
  start_device();
  device_can.Loopback = true;
  ZynqmpCanDriver.Filter(&device_can, nullptr, 0);
  ZynqmpCanDriver.Enable(&device_can, 500000);
  CHECK_EQUAL(control_register(device_can, mode_register), 2);
  const std::uint32_t before = CONodeGetCounters(&device).Received;
  send_from_device("6AA#0102");
  SILENT(20);
  CHECK_EQUAL(CONodeGetCounters(&device).Received - before, 1);
  device_can.Loopback = false;
  ZynqmpCanDriver.Enable(&device_can, 500000);
  send_from_device("6AB#");
  RX("6AB#");
}

void bit_rates() {
  struct Row {
    std::uint32_t baud;
    std::uint32_t prescaler;  // prescaler of the 24 MHz clock
    std::uint32_t timing;
  };
  constexpr Row rows[] = {
      {10000, 149, 0x9C}, {20000, 74, 0x9C}, {50000, 29, 0x9C}, {125000, 11, 0x9C},
      {250000, 5, 0x9C},  {500000, 2, 0x9C}, {800000, 1, 0x9B}, {1000000, 2, 0x05},
  };
  start_device();
  for (const Row& row : rows) {
    ZynqmpCanDriver.Init(&device_can);
    ZynqmpCanDriver.Enable(&device_can, row.baud);
    CHECK_EQUAL(control_register(device_can, prescaler_register), row.prescaler);
    CHECK_EQUAL(control_register(device_can, timing_register), row.timing);
    ASK("605#4000100000000000", "585#4300100092010200");
  }
  ZynqmpCanDriver.Enable(&device_can, 100000);
  send("605#4000100000000000");
  SILENT(20);
}

void lss_bit_rate() {
  start_device();
  send("7E5#0401000000000000");
  ASK("7E5#1300040000000000", "7E4#1300000000000000");  // 125 kbit/s
  send("7E5#1514000000000000");                         // switch after 20 ms
  SILENT(60);
  CHECK_EQUAL(control_register(device_can, prescaler_register), 11);
  send("7E5#0400000000000000");
  ASK("605#4000100000000000", "585#4300100092010200");
}

void remote_frames() {
  start_operational();
  send("205#R");
  run_ms(1);
  CHECK_EQUAL(record_of(device).pdos, 0);
  ASK("705#R", "705#05");
}

void all_lengths() {
  start_device();
  const char* const texts[] = {
      "6AA#",           "6AA#01",           "6AA#0102",           "6AA#010203",          "6AA#01020304",
      "6AA#0102030405", "6AA#010203040506", "6AA#01020304050607", "6AA#0102030405060708"};
  for (const char* text : texts) {
    send_from_device(text);
    RX(text);
  }
  send_from_device("1FFFFFFF#0102030405060708");
  RX("1FFFFFFF#0102030405060708");
  send_from_device("00000000#");
  RX("00000000#");
  send_from_device("1ABCDEF0#R");
  RX("1ABCDEF0#R");
}

constexpr Case cases[] = {
    {"driver: the receive FIFO overruns; the oldest frames stay, the loss is counted and reported once",
     overrun_of_fifo},
    {"driver: the queue to the loop overruns; likewise", overrun_of_queue},
    {"driver: bursts as long as the queue, none lost", no_loss_in_bursts},
    {"driver: the filters keep foreign identifiers away", filters},
    {"driver: the filters follow a new COB-ID", filters_follow},
    {"driver: up to four identifiers are filtered exactly, remote frames pass", exact_filters},
    {"driver: priority decides, behind the one frame that the controller has", priority},
    {"driver: frames of one identifier keep their order", order_of_one_identifier},
    {"driver: nothing comes before the boot-up message", boot_up_first},
    {"driver: the next frame goes out by the interrupt", sends_at_once},
    {"driver: a reset amid traffic drops what was received, and goes on", reset_drops_frames},
    {"driver: off the bus nothing is sent or received, until it is enabled again", close},
    {"driver: asleep, it is woken by a frame of either side", sleep},
    {"driver: loopback, nothing is seen on the bus", loopback},
    {"driver: bit timing of all bit rates of CiA 301; off the bus with any other", bit_rates},
    {"driver: a bit rate switched by LSS", lss_bit_rate},
    {"driver: remote frames are no data frames", remote_frames},
    {"driver: frames of 0 to 8 bytes, 11 and 29 bits, at both ends of their range", all_lengths},
};

}  // namespace

Cases driver_cases() { return all_of(cases); }

}  // namespace zynqmp
