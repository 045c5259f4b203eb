// SPDX-License-Identifier: Apache-2.0
#include "settings.hpp"

#include <array>
#include <deque>
#include <memory>

#include "co_timer_mtime.h"
#include "co_timer_software.h"
#include "example.hpp"
#include "example_board.h"
#include "file_nvm.hpp"
#include "linux_timer.hpp"
#include "virtual_clock.hpp"

namespace check {
namespace {

using std::chrono::microseconds;
constexpr std::uint16_t feed_request = 0x7F0;
constexpr std::int16_t done = sizeof(CO_IF_FRM);

// Constructs an object that exists until the program ends.
template <class T, class... Arguments>
T& keep(Arguments&&... arguments) {
  static std::deque<T> kept;
  return kept.emplace_back(std::forward<Arguments>(arguments)...);
}

// A controller in loopback mode, with three mailboxes and a duration for each frame.
struct Loopback {
  std::deque<CO_IF_FRM> boxes;
  std::deque<CO_IF_FRM> received;
  std::uint32_t turn = 0;
  bool on = false;

  void step() {
    if (++turn % 10 == 0 && !boxes.empty()) {
      received.push_back(boxes.front());
      boxes.pop_front();
    }
  }
  void reset() {
    boxes.clear();
    received.clear();
  }
};

Loopback& loopback(void* ctx) { return *static_cast<Loopback*>(ctx); }

const CO_IF_CAN_DRV_EX loopback_driver = {
    [](void* ctx) { loopback(ctx).reset(); },
    [](void* ctx, std::uint32_t) { loopback(ctx).on = true; },
    [](void* ctx, CO_IF_FRM* frm) {
      Loopback& can = loopback(ctx);
      if (can.received.empty()) {
        return std::int16_t{0};
      }
      *frm = can.received.front();
      can.received.pop_front();
      return done;
    },
    [](void* ctx, const CO_IF_FRM* frm) {
      Loopback& can = loopback(ctx);
      if (!can.on || can.boxes.size() == 3) {
        return std::int16_t{0};
      }
      can.boxes.push_back(*frm);
      return done;
    },
    [](void* ctx) { loopback(ctx).reset(); },
    [](void* ctx) { loopback(ctx).on = false; },
    nullptr,
    nullptr,
};

void in_loopback(Setting& s) {
  Loopback& can = keep<Loopback>();
  s.ext.Can = &loopback_driver;
  s.ext.CanCtx = &can;
  s.check.Bus = CO_CHECK_LOOPBACK;
  s.board.each_turn = [&can] { can.step(); };
}

// Configures the setting for a PC that runs the script feed.
void be_fed(Setting& s) {
  s.ext.Can = &co::VirtualBusDriver;
  s.ext.CanCtx = &s.board.port;
  s.check.Bus = CO_CHECK_FEED;
  co::VirtualBus::Port& pc = s.board.bus.attach({"PC", 64, 64});
  pc.enable();
  s.board.each_turn = [&pc] {
    while (const auto heard = pc.read()) {
      CO_IF_FRM frame = *heard;
      const bool burst = frame.Identifier == feed_request;
      const unsigned num = burst ? frame.Data[0] : 1;
      frame.Identifier |= 1;
      frame.DLC = burst ? 8 : frame.DLC;
      for (unsigned n = 0; n < num; ++n) {
        frame.Data[0] = burst ? static_cast<std::uint8_t>(n) : frame.Data[0];
        pc.send(frame);
      }
    }
  };
}

// Configures the setting for the timer of Linux: a clock in ns, and a loop that waits for its alarm.
Board* polled_board = nullptr;
std::uint64_t board_ns() { return polled_board->time * (1000000000 / frequency); }

void on_linux(Setting& s) {
  polled_board = &s.board;
  co::LinuxTimer& timer = keep<co::LinuxTimer>(board_ns);
  s.ext.Timer = &co::LinuxTimerDriver;
  s.ext.TimerCtx = &timer;
  s.board.each_turn = [&s, &timer] {
    if (timer.until_alarm() == 0) {
      CODriverCheckService(&s.check);
    }
  };
}

void on_virtual_clock(Setting& s) {
  co::VirtualClock& clock = keep<co::VirtualClock>(0xFFFF0000);
  s.ext.Timer = &co::VirtualTimerDriver;
  s.ext.TimerCtx = &keep<co::VirtualTimer>(clock, [&s] { CODriverCheckService(&s.check); });
  s.board.each_turn = [&clock] { clock.advance(1); };
}

void on_example(Setting& s) {
  s.plain = {&ExampleCanDriver, &ExampleTimerDriver, &ExampleNvmDriver};
  s.check.NvmSize = EXAMPLE_EEPROM_SIZE;
  s.check.Burst = 32;
  connect_example(s.board, ExampleCanInterrupt, [&s] {
    ExampleTimerInterrupt();
    CODriverCheckService(&s.check);
  });
}

void on_example_clock(Setting& s) {
  static EXAMPLE_COUNTER counter;
  counter = {};
  counter.Counter = 0xFFFF0000;
  s.ext.Timer = &ExampleClockDriver;
  s.ext.TimerCtx = &counter;
  s.board.each_turn = [&s] {
    ++counter.Counter;
    counter.Match = counter.Counter == counter.Compare ? 1 : counter.Match;
    if (counter.Enable != 0 && counter.Match != 0 && !s.board.locked) {
      ExampleClockInterrupt(&counter);
      CODriverCheckService(&s.check);
    }
  };
}

// Configures the setting for the machine timer of RISC-V, which counts at 100 times the frequency of the board.
void on_mtime(Setting& s) {
  static std::array<volatile std::uint32_t, 2> time;
  static std::array<volatile std::uint32_t, 2> compare;
  CO_MTIME& timer = keep<CO_MTIME>();
  timer.Time = time.data();
  timer.Compare = compare.data();
  timer.Hz = 100 * frequency;
  s.ext.Timer = &MtimeDriver;
  s.ext.TimerCtx = &timer;
  s.board.each_turn = [&s] {
    const std::uint64_t now = (std::uint64_t{time[1]} << 32U | time[0]) + 100;
    time[0] = static_cast<std::uint32_t>(now);
    time[1] = static_cast<std::uint32_t>(now >> 32U);
    if (now >= (std::uint64_t{compare[1]} << 32U | compare[0]) && !s.board.locked) {
      CODriverCheckService(&s.check);
    }
  };
}

}  // namespace

std::vector<Case> can_cases() {
  return {
      {"virtual bus",
       [](Setting& s) {
         s.ext.Can = &co::VirtualBusDriver;
         s.ext.CanCtx = &s.board.port;
       },
       0},
      {"CAN without context", [](Setting& s) { s.plain.Can = &PlainCanDriver; }, 1},
      {"CAN of the example", on_example, 1},
      {"CAN in loopback mode", in_loopback, 1},
      {"CAN with a PC", be_fed, 0},
      {"CAN without 29 bits and remote frames",
       [](Setting& s) {
         s.plain.Can = &PlainCanDriver;
         s.check.Frames = 0;
       },
       3},
      {"CAN alone",
       [](Setting& s) {
         s.plain.Can = &PlainCanDriver;
         s.check.Bus = CO_CHECK_NO_BUS;
       },
       10},
      {"no CAN", [](Setting&) {}, 1},
  };
}

std::vector<Case> timer_cases() {
  return {
      {"delta timer", [](Setting& s) { s.plain.Timer = &PlainTimerDriver; }, 0},
      {"timer of the example", on_example, 0},
      {"clock of the example", on_example_clock, 0},
      {"software timer",
       [](Setting& s) {
         s.plain.Timer = &SoftwareTimerDriver;
         s.board.cyclic = true;
         s.check.Clock = nullptr;
         s.check.Late = 0;
       },
       1},
      {"clock with compare match",
       [](Setting& s) {
         s.ext.Timer = &ClockDriver;
         s.ext.TimerCtx = &s.board;
       },
       0},
      {"clock without alarm",
       [](Setting& s) {
         static const CO_IF_TIMER_DRV_EX driver = {ClockDriver.Init, ClockDriver.Now, nullptr};
         s.ext.Timer = &driver;
         s.ext.TimerCtx = &s.board;
       },
       1},
      {"clock alone, far from its wrap",
       [](Setting& s) {
         s.board.time = 0;
         s.check.Clock = nullptr;
         s.ext.Timer = &ClockDriver;
         s.ext.TimerCtx = &s.board;
       },
       2},
      {"machine timer of RISC-V", on_mtime, 1},
      {"virtual clock", on_virtual_clock, 0},
      {"Linux timer", on_linux, 1},
      {"no timer", [](Setting&) {}, 1},
  };
}

std::vector<Case> nvm_cases(const std::string& directory) {
  return {
      {"memory without context", [](Setting& s) { s.plain.Nvm = &PlainNvmDriver; }, 0},
      {"EEPROM of the example", on_example, 0},
      {"RAM",
       [](Setting& s) {
         static std::uint8_t bytes[777];
         static CO_NVM_RAM ram = {bytes, sizeof bytes};
         s.ext.Nvm = &RamNvmDriver;
         s.ext.NvmCtx = &ram;
       },
       0},
      {"file",
       [directory](Setting& s) {
         co::FileNvm& file = keep<co::FileNvm>();
         file.open(directory + "/nvm", 600);
         s.ext.Nvm = &co::FileNvmDriver;
         s.ext.NvmCtx = &file;
       },
       0},
      {"flash",
       [](Setting& s) {
         s.ext.Nvm = &FlashDriver;
         s.ext.NvmCtx = &keep<Flash>();
       },
       0},
      {"no memory", [](Setting&) {}, 1},
      {"memory of unknown size",
       [](Setting& s) {
         s.plain.Nvm = &PlainNvmDriver;
         s.check.NvmSize = 0;
       },
       1},
  };
}

}  // namespace check
