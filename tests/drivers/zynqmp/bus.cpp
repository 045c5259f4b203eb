// SPDX-License-Identifier: Apache-2.0
#include "bus.hpp"

#include "machine.hpp"
#include "nodes.hpp"
#include "notation.hpp"
#include "registers.hpp"
#include "zynqmp_rates.hpp"

namespace zynqmp {
namespace {

constexpr auto& rates = co::zynqmp_rates<24000000, 10000, 20000, 50000, 125000, 250000, 500000, 800000, 1000000>;

// Holds a whole block: the simulated bus has no bit rate that would slow its segments down.
constexpr std::uint16_t queue_frames = 256;
CO_IF_FRM device_frames[queue_frames];
CO_IF_FRM peer_frames[queue_frames];

bool device_runs = false;
bool master_runs = false;
bool test_listens = false;

// Frame that the test's controller has received and no test has expected yet.
CO_IF_FRM pending;
bool is_pending = false;
std::uint64_t pending_time = 0;

void nothing(void* /*ctx*/) {}
GenericTimer patience = {nothing, nullptr, 0, nullptr};

void interrupt(void* can) { COCanZynqmpInterrupt(static_cast<CO_CAN_ZYNQMP*>(can)); }

void work(CO_NODE& node) {
  CONodeProcess(&node);
  COTmrProcess(&node.Tmr);
}

void listen() {
  if (test_listens && !is_pending && ZynqmpCanDriver.Read(&peer_can, &pending) > 0) {
    is_pending = true;
    pending_time = micros();
  }
}

void work_all() {
  if (device_runs) {
    work(device);
  }
  if (master_runs) {
    work(master);
  }
  listen();
}

bool can_sleep(const CO_CAN_ZYNQMP& can, CO_NODE& node, bool runs, std::uint64_t& until) {
  if (!runs) {
    return true;
  }
  const std::uint32_t left = CONodeNextDeadline(&node);
  const std::uint64_t deadline = left == UINT32_MAX ? UINT64_MAX : micros() + left;
  until = deadline < until ? deadline : until;
  return left != 0 && CORingCount(&can.Received) == 0;
}

void sleep(std::uint64_t until) {
  const Quiet quiet;
  bool nothing_to_do = can_sleep(device_can, device, device_runs, until);
  nothing_to_do = can_sleep(peer_can, master, master_runs, until) && nothing_to_do;
  const bool last_mode = test_listens && (is_pending || CORingCount(&peer_can.Received) != 0);
  const std::uint64_t now = micros();
  if (nothing_to_do && !last_mode && until > now) {
    GenericTimerDriver.Alarm(&patience, static_cast<std::uint32_t>(until - now));
    wait_for_interrupt();
  }
}

template <typename Condition>
bool run_while(Condition condition, std::uint64_t until) {
  while (condition()) {
    if (micros() >= until || has_failed()) {
      return false;
    }
    work_all();
    sleep(until);
  }
  return true;
}

bool next_frame(std::uint32_t milliseconds) {
  return run_while([] { return !is_pending; }, micros() + 1000 * milliseconds);
}

void go_on_bus() {
  ZynqmpCanDriver.Init(&peer_can);
  ZynqmpCanDriver.Filter(&peer_can, nullptr, 0);
  ZynqmpCanDriver.Enable(&peer_can, 500000);
  test_listens = true;
  is_pending = false;
}

CO_CAN_ZYNQMP made(std::uintptr_t registers, CO_IF_FRM* frames, std::uint16_t number) {
  CO_CAN_ZYNQMP can = {};
  can.Registers = reinterpret_cast<volatile std::uint32_t*>(registers);
  can.Rates = rates.data();
  can.RateNum = static_cast<std::uint8_t>(rates.size());
  can.Frames = frames;
  can.FrameNum = number;
  return can;
}

volatile std::uint32_t& register_of(const CO_CAN_ZYNQMP& can, std::uint32_t offset) {
  return can.Registers[offset / 4];
}

}  // namespace

CO_CAN_ZYNQMP device_can;
CO_CAN_ZYNQMP peer_can;

void serve_controllers() {
  device_can = made(0xFF060000, device_frames, queue_frames);
  peer_can = made(0xFF070000, peer_frames, queue_frames);
  add(patience);
  serve(can0_interrupt, interrupt, &device_can);
  serve(can1_interrupt, interrupt, &peer_can);
}

void start_device(void (*prepare)()) {
  go_on_bus();
  init_device();
  CHECK_EQUAL(CONodeGetErr(&device), CO_ERR_NONE);
  device_runs = true;
  prepare();
  CONodeStart(&device);
}

void start_device() {
  start_device([] {});
  RX("705#00");
}

void start_operational() {
  start_device();
  send("000#0105");
  run_ms(1);
  CHECK_EQUAL(CONmtGetMode(&device.Nmt), CO_OPERATIONAL);
}

void start_nodes() {
  init_device();
  init_master();
  CHECK_EQUAL(CONodeGetErr(&master), CO_ERR_NONE);
  device_runs = true;
  master_runs = true;
  CONodeStart(&master);
  CONodeStart(&device);
  run_ms(1);
}

void leave_bus() {
  if (test_listens && !has_failed()) {
    SILENT(5);
  }
  if (device_runs) {
    CONodeStop(&device);
  }
  if (master_runs) {
    CONodeStop(&master);
  }
  ZynqmpCanDriver.Close(&device_can);
  ZynqmpCanDriver.Close(&peer_can);
  device_runs = false;
  master_runs = false;
  test_listens = false;
  device_can.FrameNum = queue_frames;
}

void run(std::uint32_t microseconds) {
  run_while([] { return true; }, micros() + microseconds);
}

bool run_until(bool (*condition)(), std::uint32_t milliseconds) {
  return run_while([condition] { return !condition(); }, micros() + 1000 * milliseconds);
}

void send(const char* text) {
  const CO_IF_FRM sent = frame(text);
  for (unsigned attempt = 0; ZynqmpCanDriver.Send(&peer_can, &sent) <= 0; ++attempt) {
    if (has_failed() || attempt == 100) {
      fail("bus", 0, "cannot send ", text);
      return;
    }
    run(100);
  }
}

std::uint64_t expect_frame(const char* file, int line, const char* text, std::uint32_t milliseconds) {
  if (has_failed()) {
    return 0;
  }
  if (!next_frame(milliseconds)) {
    fail(file, line, "nothing in place of ", text);
    return 0;
  }
  is_pending = false;
  if (!is_same(pending, frame(text))) {
    fail(file, line, notation(pending).characters, " in place of ", text);
  }
  return pending_time;
}

void expect_silence(const char* file, int line, std::uint32_t milliseconds) {
  if (!has_failed() && next_frame(milliseconds)) {
    is_pending = false;
    fail(file, line, notation(pending).characters, " in place of nothing");
  }
}

unsigned count_frames(std::uint32_t milliseconds, std::uint32_t identifier) {
  const std::uint64_t until = micros() + 1000 * milliseconds;
  unsigned number = 0;
  while (run_while([] { return !is_pending; }, until)) {
    is_pending = false;
    number += pending.Identifier == identifier ? 1 : 0;
  }
  return number;
}

void hold(const CO_CAN_ZYNQMP& can) { register_of(can, 0) = 0; }
void release(const CO_CAN_ZYNQMP& can) { register_of(can, 0) = co::zynqmp::can_enable; }
std::uint32_t control_register(const CO_CAN_ZYNQMP& can, std::uint32_t offset) { return register_of(can, offset); }

}  // namespace zynqmp
