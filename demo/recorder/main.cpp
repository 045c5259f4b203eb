// SPDX-License-Identifier: Apache-2.0
// A drive that records its speed, and a master that configures the recorder and reads its plot by SDO block transfer,
// on a simulated bus inside the program.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "recorder/device.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

using namespace std::chrono_literals;

namespace {

constexpr std::uint8_t drive_id = 1;
constexpr std::uint8_t master_id = 2;
constexpr std::uint32_t in_progress = UINT32_MAX;

constexpr const char* help =
    "Records the speed of a simulated drive around a step of its setpoint, and writes the points as CSV, which\n"
    "lexican mon --html draws. A master configures the recorder of the drive and reads its plot by SDO, on a bus\n"
    "inside the program with simulated time. The entries of the recorder are in demo/recorder/device.cpp.\n"
    "Usage: lexican-demo-recorder [OPTIONS]\n"
    "\n"
    "Options:\n"
    "  -h,--help               Print this help message and exit\n"
    "  -o,--output FILE        File of the points; recorder.csv by default\n"
    "\n"
    "Exit codes:\n"
    "    0  the points were written\n"
    "    1  the drive could not be configured or read, or the file could not be written\n"
    "    2  wrong arguments\n";

constexpr CO_OBJ master_od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x600 + drive_id)},
    {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x580 + drive_id)},
    {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(drive_id)},
};

std::uint32_t transfer_result;  // abort code of the last transfer, or in_progress

void end_transfer(CO_CSDO*, std::uint16_t, std::uint8_t, std::uint32_t abort_code) { transfer_result = abort_code; }

// Drive and master on one bus.
class Bench {
 public:
  Bench() {
    drive_drivers_.CanCtx = &bus_.attach({"drive"});
    lexican::demo::make_drive(drive_, drive_drivers_, drive_id);
    CONodeStart(&drive_);
    master_drivers_.CanCtx = &bus_.attach({"master"});
    CO_NODE_SPEC spec = {};
    spec.NodeId = master_id;
    spec.Baudrate = 500000;
    spec.Dict = const_cast<CO_OBJ*>(master_od);
    spec.DictLen = sizeof master_od / sizeof *master_od;
    spec.TmrFreq = 1000000;
    CONodeInitEx(&master_, &spec, &master_drivers_);
    CONodeStart(&master_);
  }
  ~Bench() {
    CONodeStop(&master_);
    CONodeStop(&drive_);
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void run(int milliseconds) {
    for (int n = 0; n < milliseconds; ++n) {
      lexican::demo::run_motor();
      for (CO_NODE* const node : {&drive_, &master_}) {
        CONodeProcess(node);
        COTmrProcess(&node->Tmr);
      }
      clock_.advance(clock_.ticks(1ms));
    }
  }

  /// Writes a number of the drive. Returns false, with a message, if the drive has refused it.
  bool write(std::uint16_t index, std::uint8_t sub, std::uint32_t value, std::uint32_t bytes) {
    std::uint8_t data[4];
    for (std::uint8_t& byte : data) {
      byte = static_cast<std::uint8_t>(value);
      value >>= 8U;
    }
    const CO_ERR err =
        COCSdoRequestDownload(COCSdoFind(&master_, 0), CO_DEV(index, sub), data, bytes, end_transfer, 1000);
    return await(err, index, sub);
  }

  /// Reads an object of the drive. Returns false, with a message, if the drive has refused it.
  bool read(std::uint16_t index, std::uint8_t sub, std::string& text) {
    CO_CSDO* const client = COCSdoFind(&master_, 0);
    std::vector<std::uint8_t> data(1U << 20U);
    const CO_ERR err = COCSdoRequestUpload(client, CO_DEV(index, sub), data.data(),
                                           static_cast<std::uint32_t>(data.size()), end_transfer, 1000);
    const bool done = await(err, index, sub);
    text.assign(reinterpret_cast<const char*>(data.data()), COCSdoGetNum(client));
    return done;
  }

 private:
  bool await(CO_ERR err, std::uint16_t index, std::uint8_t sub) {
    transfer_result = in_progress;
    while (err == CO_ERR_NONE && transfer_result == in_progress) {
      run(1);
    }
    if (err != CO_ERR_NONE || transfer_result != 0) {
      std::fprintf(stderr, "object %04Xh:%02X: abort code %08Xh\n", index, sub, transfer_result);
      return false;
    }
    return true;
  }

  co::VirtualClock clock_;
  co::VirtualBus bus_;
  co::VirtualTimer drive_timer_{clock_, [this] { COTmrService(&drive_.Tmr); }};
  co::VirtualTimer master_timer_{clock_, [this] { COTmrService(&master_.Tmr); }};
  CO_NODE drive_{};
  CO_NODE master_{};
  CO_NODE_EXT drive_drivers_ = drivers(drive_timer_);
  CO_NODE_EXT master_drivers_ = drivers(master_timer_);

  static CO_NODE_EXT drivers(co::VirtualTimer& timer) {
    CO_NODE_EXT all = {};
    all.Size = sizeof all;
    all.Can = &co::VirtualBusDriver;
    all.Timer = &co::VirtualTimerDriver;
    all.TimerCtx = &timer;
    return all;
  }
};

bool configure(Bench& bench) {
  return bench.write(0x2301, 5, CO_LINK(0x2110, 0, 16), 4) &&  // recorded object: the speed
         bench.write(0x2301, 6, CO_RECORDER_CSV, 1) &&         // format
         bench.write(0x2301, 7, CO_RECORDER_RISING, 1) &&      // trigger: the speed reaches ...
         bench.write(0x2301, 8, 1000, 4) &&                    // ... 1000 revolutions per minute
         bench.write(0x2301, 9, 150, 4) &&                     // points from before
         bench.write(0x2301, 10, 1, 2);                        // ms between two samples
}

bool write_file(const char* name, const std::string& text) {
  std::FILE* const file = std::fopen(name, "wb");
  const bool written = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = file != nullptr && std::fclose(file) == 0;
  if (!written || !closed) {
    std::fprintf(stderr, "cannot write %s: %s\n", name, std::strerror(errno));
  }
  return written && closed;
}

int record(const char* output) {
  Bench bench;
  std::string trigger;
  std::string points;
  bench.run(10);
  const bool done = configure(bench) && bench.write(0x2100, 0, 2000, 2) && (bench.run(1000), true) &&
                    bench.read(0x2401, 6, trigger) && bench.read(0x2401, 5, points);
  if (!done) {
    return 1;
  }
  const auto time =
      static_cast<unsigned>(static_cast<std::uint8_t>(trigger[0]) + 256 * static_cast<std::uint8_t>(trigger[1]));
  const std::string description = "# name: speed\n# object: 2110h:00\n# trigger: " + std::to_string(time) + "\n";
  if (!write_file(output, description + points)) {
    return 1;
  }
  const auto count = std::count(points.begin(), points.end(), '\n');
  std::printf("%d points around the trigger at %u ms: %s\n", static_cast<int>(count), time, output);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const char* output = "recorder.csv";
  for (int n = 1; n < argc; ++n) {
    const std::string_view argument = argv[n];
    if (argument == "--help" || argument == "-h") {
      std::fputs(help, stdout);
      return 0;
    }
    if ((argument != "--output" && argument != "-o") || n + 1 == argc) {
      std::fprintf(stderr, "unknown argument '%s'; see --help\n", argv[n]);
      return 2;
    }
    output = argv[++n];
  }
  return record(output);
}
