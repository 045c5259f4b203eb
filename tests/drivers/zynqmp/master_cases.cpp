// SPDX-License-Identifier: Apache-2.0
// Tests the device with a Lexican master; each has its own controller and interrupt.
#include "bus.hpp"
#include "cases.hpp"
#include "nodes.hpp"

namespace zynqmp {
namespace {

constexpr std::uint32_t time_out = 500;  // ms

std::uint8_t buffer[sizeof objects.memory];

bool transfer_ended = false;
std::uint32_t transfer_code = 0;

void end_of_transfer(CO_CSDO* /*csdo*/, std::uint16_t /*index*/, std::uint8_t /*sub*/, std::uint32_t code) {
  transfer_ended = true;
  transfer_code = code;
}

bool has_ended() { return transfer_ended; }

void begin(CO_ERR err) { CHECK_EQUAL(err, CO_ERR_NONE); }

void begin_upload(std::uint32_t key, std::uint32_t size) {
  transfer_ended = false;
  begin(COCSdoRequestUpload(COCSdoFind(&master, 0), key, buffer, size, end_of_transfer, time_out));
}

void begin_download(std::uint32_t key, std::uint32_t size) {
  transfer_ended = false;
  begin(COCSdoRequestDownload(COCSdoFind(&master, 0), key, buffer, size, end_of_transfer, time_out));
}

void end_transfer(std::uint32_t expected_code = 0) {
  CHECK(run_until(has_ended, 1000));
  CHECK_EQUAL(transfer_code, expected_code);
}

void fill_buffer(std::uint32_t size) {
  for (std::uint32_t n = 0; n < size; ++n) {
    buffer[n] = static_cast<std::uint8_t>(n * 7 + (n >> 8));
  }
}

bool memory_is_buffer(std::uint32_t size) {
  for (std::uint32_t n = 0; n < size; ++n) {
    if (objects.memory[n] != buffer[n]) {
      return false;
    }
  }
  return true;
}

void round_trip(std::uint32_t size) {
  fill_buffer(size);
  begin_download(CO_DEV(0x2010, 0), size);
  end_transfer();
  CHECK(memory_is_buffer(size));
  for (std::uint8_t& byte : buffer) {
    byte = 0;
  }
  begin_upload(CO_DEV(0x2010, 0), sizeof buffer);
  end_transfer();
  CHECK_EQUAL(COCSdoGetNum(COCSdoFind(&master, 0)), sizeof buffer);
  CHECK(memory_is_buffer(sizeof buffer));
}

void expedited() {
  start_nodes();
  const std::uint8_t value[4] = {0x78, 0x56, 0x34, 0x12};
  for (unsigned n = 0; n < 4; ++n) {
    buffer[n] = value[n];
  }
  begin_download(CO_DEV(0x2000, 3), 4);
  end_transfer();
  CHECK_EQUAL(objects.number, 0x12345678);
  begin_upload(CO_DEV(0x1000, 0), 4);
  end_transfer();
  CHECK_EQUAL(buffer[0], 0x92);
  begin_upload(CO_DEV(0x2FFF, 0), 4);
  end_transfer(CO_SDO_ERR_OBJ);
}

void segmented() {
  start_nodes();
  round_trip(20);
}

void block() {
  start_nodes();
  round_trip(sizeof buffer);
}

void start_all() {
  CHECK_EQUAL(CONmtCommand(&master.Nmt, CO_NMT_COMMAND_START, 0), CO_ERR_NONE);
  run_ms(1);
  CHECK_EQUAL(CONmtGetMode(&master.Nmt), CO_OPERATIONAL);
  CHECK_EQUAL(CONmtGetMode(&device.Nmt), CO_OPERATIONAL);
}

void exchange_pdos(std::uint32_t milliseconds) {
  CHECK_EQUAL(CODictWrLong(&master.Dict, CO_DEV(0x1006, 0), 1000), CO_ERR_NONE);
  for (std::uint32_t n = 1; n <= milliseconds; ++n) {
    master_objects.sent = n;
    objects.sent[1] = ~n;
    run_ms(1);
  }
  CHECK_EQUAL(CODictWrLong(&master.Dict, CO_DEV(0x1006, 0), 0), CO_ERR_NONE);
  run_ms(1);
}

// Requires the PDOs of 1000 cycles, except up to four at the beginning and the end.
void expect_all(unsigned pdos) {
  if (pdos < 996) {
    CHECK_EQUAL(pdos, 1000);
  }
}

void process_data() {
  start_nodes();
  start_all();
  exchange_pdos(1000);
  expect_all(record_of(device).pdos);
  expect_all(record_of(master).pdos);
  CHECK(objects.received[1] > 995);
  CHECK(~master_objects.received > 995);
  CHECK_EQUAL(COCanZynqmpLost(&device_can) + COCanZynqmpLost(&peer_can), 0);
  CHECK_EQUAL(CONodeGetCounters(&device).Dropped, 0);
}

void block_among_process_data() {
  start_nodes();
  start_all();
  fill_buffer(sizeof buffer);
  begin_download(CO_DEV(0x2010, 0), sizeof buffer);
  exchange_pdos(1000);
  end_transfer();
  CHECK(memory_is_buffer(sizeof buffer));
  expect_all(record_of(device).pdos);
  expect_all(record_of(master).pdos);
}

void heartbeat() {
  start_nodes();
  CHECK_EQUAL(CODictWrLong(&master.Dict, CO_DEV(0x1016, 1), (device_id << 16) | 150U), CO_ERR_NONE);
  buffer[0] = 50;
  buffer[1] = 0;
  begin_download(CO_DEV(0x1017, 0), 2);
  end_transfer();
  run_ms(60);
  CHECK_EQUAL(record_of(master).last_mode, CO_PREOP);
  start_all();
  run_ms(60);
  CHECK_EQUAL(record_of(master).last_mode, CO_OPERATIONAL);
  CHECK_EQUAL(CONmtCommand(&master.Nmt, CO_NMT_COMMAND_STOP, device_id), CO_ERR_NONE);
  run_ms(60);
  CHECK_EQUAL(record_of(master).last_mode, CO_STOP);
  CHECK_EQUAL(record_of(master).heartbeat_events, 0);
  hold(device_can);
  run_ms(160);
  CHECK_EQUAL(record_of(master).heartbeat_events, 1);
  release(device_can);
  run_ms(60);
  CHECK_EQUAL(CONmtGetHbEvents(&master.Nmt, device_id), 1);
  CHECK_EQUAL(record_of(master).last_mode, CO_STOP);
}

void last_emergency() {
  start_nodes();
  COEmcySet(&device.Emcy, 0, nullptr);
  run_ms(1);
  CHECK_EQUAL(record_of(master).last_emergency, CO_EMCY_CODE_VOL_INPUT_ERR);
  COEmcyClr(&device.Emcy, 0);
  run_ms(1);
  CHECK_EQUAL(record_of(master).last_emergency, CO_EMCY_CODE_NO_ERR);
  CHECK_EQUAL(record_of(master).emergencies, 2);
}

void reset_amid_transfer() {
  start_nodes();
  fill_buffer(sizeof buffer);
  begin_download(CO_DEV(0x2010, 0), sizeof buffer);
  run(200);
  CHECK(!transfer_ended);
  CHECK_EQUAL(CONmtCommand(&master.Nmt, CO_NMT_COMMAND_RESET_COM, device_id), CO_ERR_NONE);
  CHECK(run_until(has_ended, 3000));
  CHECK(transfer_code != 0);
  CHECK_EQUAL(record_of(device).resets[CO_RESET_COM], 1);
  CHECK_EQUAL(CONmtGetMode(&device.Nmt), CO_PREOP);
  round_trip(sizeof buffer);
}

constexpr Case cases[] = {
    {"master: SDO client, expedited, and the abort code of the server", expedited},
    {"master: SDO client, segmented, 20 bytes there and 3000 back", segmented},
    {"master: SDO client, blocks, 3000 bytes there and back", block},
    {"master: PDOs both ways in 1000 SYNC cycles of 1 ms, none lost", process_data},
    {"master: a block download among these", block_among_process_data},
    {"master: NMT commands, and the states that the heartbeat tells; missing while the controller is off", heartbeat},
    {"master: EMCY consumer", last_emergency},
    {"master: reset communication amid a block transfer, which is then repeated", reset_amid_transfer},
};

}  // namespace

Cases master_cases() { return all_of(cases); }

}  // namespace zynqmp
