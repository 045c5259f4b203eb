// SPDX-License-Identifier: Apache-2.0
// Timers with a late timer interrupt, or a late loop.
#include <algorithm>
#include <cstring>
#include <random>

#include "support/fixture.hpp"

namespace {

using namespace test;

// A simulated hardware counter with a compare match. The test advances it and calls the interrupt function.
struct Hardware {
  std::uint64_t now;
  std::uint64_t match;
  std::uint64_t last_match;
  bool armed;
  bool from_match;  // the next Reload counts from the last match
  bool stopped;
  unsigned starts;
  unsigned reloads;
  std::uint32_t shortest;  // minimum number of ticks until a match
  std::string misuse;
} hardware;

bool has_elapsed() { return hardware.armed && hardware.match <= hardware.now; }

void init(std::uint32_t) {}
void reload(std::uint32_t ticks) {
  ++hardware.reloads;
  if (ticks == 0) hardware.misuse = "Reload of 0 ticks";
  const std::uint64_t from = hardware.from_match ? hardware.last_match : hardware.now;
  hardware.match = from + (ticks < hardware.shortest ? hardware.shortest : ticks);
  hardware.armed = true;
  hardware.from_match = false;
}
std::uint32_t delay() { return has_elapsed() ? 0 : static_cast<std::uint32_t>(hardware.match - hardware.now); }
void stop() {
  hardware.armed = hardware.from_match = false;
  hardware.stopped = true;
}
void start() {
  ++hardware.starts;
  if (!hardware.stopped) hardware.misuse = "Start without Stop";
  if (!hardware.armed) hardware.misuse = "Start without Reload";
  hardware.stopped = false;
}
std::uint8_t update() {
  if (!has_elapsed()) {
    return 0;
  }
  hardware.last_match = hardware.match;
  hardware.from_match = true;
  hardware.armed = false;
  return 1;
}

const CO_IF_TIMER_DRV counter_driver = {init, reload, delay, stop, start, update};

// Clock driver without alarm: a free-running clock; the loop uses CONodeNextDeadline().
std::uint32_t clock_now(void*) { return static_cast<std::uint32_t>(hardware.now); }
const CO_IF_TIMER_DRV_EX clock_driver = {[](void*, std::uint32_t) {}, clock_now, nullptr};

void nothing() {}
void nothing_with_baud(std::uint32_t) {}
std::int16_t no_frame(CO_IF_FRM*) { return 0; }
std::int16_t taken(CO_IF_FRM*) { return sizeof(CO_IF_FRM); }
const CO_IF_CAN_DRV can = {nothing, nothing_with_baud, no_frame, taken, nothing, nothing};

struct Run {
  std::uintptr_t number;
  std::uint64_t at;
  bool operator==(const Run& other) const { return number == other.number && at == other.at; }
};
using Runs = std::vector<Run>;
Runs runs;

void note(void* para) { runs.push_back({reinterpret_cast<std::uintptr_t>(para), hardware.now}); }

enum class Driver { counter, clock };

class Device {
 public:
  explicit Device(Driver driver) {
    runs.clear();
    hardware = Hardware{};
    hardware.stopped = true;
    ext_.Size = sizeof ext_;
    ext_.Timer = driver == Driver::clock ? &clock_driver : nullptr;
    std::memset(static_cast<void*>(&node), 0xA5, sizeof node);
    const CO_NODE_SPEC spec = {1, 250000, dictionary_, 1, nullptr, memory_, 8, 1000, &drivers_, nullptr};
    CONodeInitEx(&node, &spec, &ext_);
  }
  ~Device() { CHECK(hardware.misuse == ""); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  std::int16_t create(std::uint32_t start, std::uint32_t cycle, std::uintptr_t number) {
    return COTmrCreate(&node.Tmr, start, cycle, note, reinterpret_cast<void*>(number));
  }
  int remove(std::int16_t id) { return COTmrDelete(&node.Tmr, id); }
  void interrupt() {
    if (has_elapsed()) COTmrService(&node.Tmr);
  }
  void process() { COTmrProcess(&node.Tmr); }
  // Advances to \a tick, with interrupt and loop at each tick.
  void until(std::uint64_t tick) {
    interrupt();
    process();
    while (hardware.now < tick) {
      ++hardware.now;
      interrupt();
      process();
    }
  }

  CO_NODE node;

 private:
  CO_OBJ dictionary_[1] = {CO_OBJ_DICT_ENDMARK};
  CO_TMR_MEM memory_[8];
  CO_IF_DRV drivers_{&can, &counter_driver, nullptr};
  CO_NODE_EXT ext_{};
};

TEST_CASE("timer lateness: deleting the first timer while its expiry is pending does not shift a cyclic one") {
  Device device(Driver::counter);
  device.create(0, 10, 1);
  const std::int16_t first = device.create(5, 0, 2);
  hardware.now = 5;  // without the interrupt
  CHECK(device.remove(first) == 0);
  device.until(35);
  CHECK(runs == Runs{{1, 10}, {1, 20}, {1, 30}});
}

TEST_CASE("timer lateness: no drift if timers are often deleted while their expiry is pending") {
  Device device(Driver::counter);
  device.create(0, 10, 1);
  for (std::uint64_t tick = 0; tick < 1000; tick += 10) {
    const std::int16_t first = device.create(5, 0, 2);
    hardware.now = tick + 5;
    CHECK(device.remove(first) == 0);
    device.until(tick + 10);
  }
  CHECK(runs.size() == 100);
  for (std::size_t n = 0; n < runs.size(); ++n) {
    CHECK(runs[n] == Run{1, 10 * (n + 1)});
  }
}

TEST_CASE("timer lateness: a timer created while an expiry is pending runs after its time, and none is lost") {
  Device device(Driver::counter);
  device.create(0, 10, 1);
  device.create(5, 0, 2);
  hardware.now = 5;
  device.create(3, 0, 3);
  device.create(1, 0, 4);
  device.until(20);
  CHECK(runs == Runs{{2, 5}, {4, 6}, {3, 8}, {1, 10}, {1, 20}});
}

TEST_CASE("timer lateness: COTmrService reports expired timers, whichever function has detected them") {
  const auto service = [](Device& device) { return COTmrService(&device.node.Tmr); };
  const std::function<void(Device&)> notices[] = {
      [](Device& d) { d.create(100, 0, 2); },
      [](Device& d) { d.remove(d.create(100, 0, 2)); },
      [](Device& d) { CHECK(CONodeNextDeadline(&d.node) == 0); },
  };
  for (const std::function<void(Device&)>& notice : notices) {
    Device device(Driver::clock);
    device.create(5, 0, 1);
    hardware.now = 4;
    CHECK(service(device) == 0);
    hardware.now = 6;
    notice(device);
    CHECK(service(device) == 1);
    device.process();
    CHECK(runs == Runs{{1, 6}});
    CHECK(service(device) == 0);
  }
}

TEST_CASE("timer lateness: a driver without a clock is started after a stop, not at each Reload") {
  Device device(Driver::counter);
  CHECK(hardware.starts == 0);
  const std::int16_t cyclic = device.create(0, 10, 1);
  CHECK(hardware.starts == 1);
  const std::int16_t sooner = device.create(5, 0, 2);
  device.create(3, 0, 3);
  CHECK(device.remove(sooner) == 0);
  device.until(100);
  CHECK(hardware.reloads >= 11);
  CHECK(hardware.starts == 1);
  CHECK_FALSE(hardware.stopped);
  CHECK(device.remove(cyclic) == 0);
  CHECK(hardware.stopped);
  device.create(5, 0, 4);
  CHECK(hardware.starts == 2);
  device.until(110);
  CHECK(hardware.stopped);
  device.create(0, 5, 5);
  device.until(200);
  CHECK(hardware.starts == 3);
}

TEST_CASE("timer lateness: a cyclic timer keeps its phase if the main loop is a cycle late or before the interrupt") {
  Device device(Driver::counter);
  device.create(0, 10, 1);
  hardware.now = 10;
  device.interrupt();
  hardware.now = 20;
  device.process();
  device.until(45);
  CHECK(runs == Runs{{1, 20}, {1, 30}, {1, 40}});
}

constexpr std::uint64_t longest = 0xFFFFFFFF;

// Lets the clock jump from one expiry to the next.
void jump(Device& device, std::uint64_t tick) {
  hardware.now = tick;
  COTmrService(&device.node.Tmr);
  device.process();
}

TEST_CASE("timer lateness: a cycle of 2^32 - 1 ticks works with both kinds of drivers") {
  for (const Driver driver : {Driver::counter, Driver::clock}) {
    CAPTURE(driver == Driver::clock);
    Device device(driver);
    device.create(0, 0xFFFFFFFF, 1);
    Runs expected;
    for (std::uint64_t cycle = 1; cycle <= 4; ++cycle) {
      jump(device, cycle * longest - 1);
      CHECK(runs == expected);
      jump(device, cycle * longest);
      expected.push_back({1, cycle * longest});
      CHECK(runs == expected);
    }
  }
}

TEST_CASE("timer lateness: a timer of 2^32 - 1 ticks that is created while an expiry is pending does not run at once") {
  for (const std::uint32_t cycle : {0U, 0xFFFFFFFFU}) {
    CAPTURE(cycle);
    Device device(Driver::counter);
    device.create(5, 0, 1);
    hardware.now = 5;
    device.create(0xFFFFFFFF, cycle, 2);
    device.until(1000);
    CHECK(runs == Runs{{1, 5}});
  }
}

TEST_CASE("timer lateness: a cycle of 2^32 - 1 ticks whose next expiry is pending when it is run does not run twice") {
  Device device(Driver::counter);
  device.create(0, 0xFFFFFFFF, 1);
  hardware.now = longest;
  device.interrupt();
  hardware.now = 2 * longest;  // the loop runs a whole cycle late, and before the interrupt
  device.process();
  CHECK(runs == Runs{{1, 2 * longest}});
  device.until(2 * longest + 1000);
  CHECK(runs.size() == 1);
}

TEST_CASE("timer lateness: the only cyclic timer keeps its phase on a driver without a clock") {
  Device device(Driver::counter);
  device.create(0, 10, 1);
  CHECK(hardware.reloads == 1);
  device.until(50);
  CHECK(runs == Runs{{1, 10}, {1, 20}, {1, 30}, {1, 40}, {1, 50}});
  CHECK(hardware.reloads == 6);  // once at the start, and in each interrupt: always counted from the last expiry
}

TEST_CASE("timer lateness: elapsed cyclic timers of any cycles do not block the main loop and keep their phase") {
  for (const std::uint32_t cycle : {1U, 2U, 7U, 1000U}) {
    CAPTURE(cycle);
    Device device(Driver::counter);
    device.create(0, cycle, 1);
    device.create(0, cycle, 2);
    const unsigned reloads = hardware.reloads;
    const unsigned starts = hardware.starts;
    unsigned interrupts = 0;
    const std::uint64_t late = 100 * cycle + 3 * cycle / 5;
    while (hardware.now < late) {  // the loop does not run
      ++hardware.now;
      interrupts += has_elapsed() ? 1U : 0U;
      device.interrupt();
    }
    CHECK(interrupts == 2);  // at the first missed expiry, too, and no more until the loop has run the timers
    CHECK(hardware.reloads == reloads + 2);
    CHECK(hardware.starts == starts);
    CHECK(runs.empty());
    device.process();
    CHECK(runs == Runs{{1, late}, {2, late}});
    device.until(102 * cycle);
    const std::uint64_t next = 101 * cycle;
    CHECK(runs == Runs{{1, late}, {2, late}, {1, next}, {2, next}, {1, next + cycle}, {2, next + cycle}});
  }
}

TEST_CASE("timer lateness: a timer armed while an elapsed cyclic one is pending elapses on time") {
  Device device(Driver::counter);
  device.create(0, 1, 1);
  device.create(500, 0, 2);
  unsigned interrupts = 0;
  while (hardware.now < 600) {
    ++hardware.now;
    interrupts += has_elapsed() ? 1U : 0U;
    device.interrupt();
  }
  CHECK(interrupts == 2);  // one of each timer
  device.process();
  CHECK(runs == Runs{{1, 600}, {2, 600}});
  device.create(10, 0, 3);
  while (hardware.now < 605) {
    ++hardware.now;
    device.interrupt();
  }
  device.create(2, 0, 4);
  device.until(610);
  CHECK(std::count(runs.begin(), runs.end(), Run{4, 607}) == 1);
  CHECK(std::count(runs.begin(), runs.end(), Run{3, 610}) == 1);
}

TEST_CASE("timer lateness: the driver is programmed once for each expiry if another timer elapses first") {
  Device device(Driver::counter);
  device.create(3, 10, 1);
  device.create(7, 10, 2);
  device.until(10);
  const unsigned reloads = hardware.reloads;
  device.until(50);
  CHECK(hardware.reloads == reloads + 8);
  CHECK(runs.size() == 10);
  for (std::size_t n = 0; n < runs.size(); ++n) {
    CHECK(runs[n] == Run{1 + n % 2, n / 2 * 10 + (n % 2 == 0 ? 3U : 7U)});
  }
}

TEST_CASE("timer lateness: a cyclic timer that elapses behind a one-shot timer keeps its phase") {
  for (const std::uint64_t late : {10U, 15U, 20U, 25U}) {
    CAPTURE(late);
    Device device(Driver::counter);
    device.create(10, 0, 1);
    device.create(10, 10, 2);
    while (hardware.now < late) {
      ++hardware.now;
      device.interrupt();
    }
    device.process();
    device.until(40);
    Runs expected = {{1, late}, {2, late}};
    for (std::uint64_t at = late / 10 * 10 + 10; at <= 40; at += 10) expected.push_back({2, at});
    CHECK(runs == expected);
  }
}

// Model of timers that elapse at each interrupt and are run by each call of the loop.
class Model {
 public:
  void create(std::int16_t id, std::uint32_t start, std::uint32_t cycle, std::uintptr_t number) {
    timers_.push_back({id, hardware.now + start, cycle, number, order_++, false});
  }
  std::size_t size() const { return timers_.size(); }
  std::int16_t remove(std::size_t victim) {
    const std::int16_t id = timers_[victim].id;
    timers_.erase(timers_.begin() + static_cast<std::ptrdiff_t>(victim));
    return id;
  }
  void interrupt() {
    for (Timer& timer : timers_) timer.due = timer.due || timer.at <= hardware.now;
  }
  void process() {
    std::sort(timers_.begin(), timers_.end(),
              [](const Timer& a, const Timer& b) { return a.at != b.at ? a.at < b.at : a.order < b.order; });
    for (Timer& timer : timers_) {
      if (!timer.due) continue;
      runs.push_back({timer.number, hardware.now});
      if (timer.cycle == 0) continue;
      timer.at += ((hardware.now - timer.at) / timer.cycle + 1) * timer.cycle;
      timer.order = order_++;
      timer.due = false;
    }
    timers_.erase(std::remove_if(timers_.begin(), timers_.end(), [](const Timer& timer) { return timer.due; }),
                  timers_.end());
  }

  Runs runs;

 private:
  struct Timer {
    std::int16_t id;
    std::uint64_t at;
    std::uint32_t cycle;
    std::uintptr_t number;
    std::uint64_t order;
    bool due;
  };
  std::vector<Timer> timers_;
  std::uint64_t order_ = 0;
};

void create_or_delete(Device& device, Model& model, std::mt19937& random, std::uintptr_t number) {
  const auto choice = static_cast<unsigned>(random() % 16);
  if (choice < 2 && model.size() < 8) {
    const std::uint32_t start = 1 + static_cast<std::uint32_t>(random() % 30);
    const std::uint32_t cycle = random() % 4 == 0 ? 0 : 1 + static_cast<std::uint32_t>(random() % 30);
    model.create(device.create(start, cycle, number), start, cycle, number);
  } else if (choice == 2 && model.size() != 0) {
    CHECK(device.remove(model.remove(random() % model.size())) == 0);
  }
}

TEST_CASE("timer lateness: a loop that is late, or before the interrupt, has the results of a model") {
  std::mt19937 random(1975);
  for (int round = 0; round < 100; ++round) {
    CAPTURE(round);
    Device device(Driver::counter);
    Model model;
    const auto lateness = static_cast<unsigned>(1 + random() % 40);
    for (std::uintptr_t step = 0; step < 2000; step += 2) {
      ++hardware.now;
      if (random() % lateness == 0) {
        device.process();
        model.process();
      }
      create_or_delete(device, model, random, step);
      device.interrupt();
      model.interrupt();
      create_or_delete(device, model, random, step + 1);
      if (random() % lateness == 0) {
        device.process();
        model.process();
      }
    }
    CHECK(runs == model.runs);
  }
}

TEST_CASE("timer lateness: time does not go back when a driver without a clock waits longer than requested") {
  Device device(Driver::counter);
  hardware.shortest = 3;
  device.create(0, 10, 1);
  device.create(11, 0, 2);
  device.until(12);
  CHECK(runs == Runs{{1, 10}});
  device.until(13);
  CHECK(runs == Runs{{1, 10}, {2, 13}});
  device.until(32);  // two ticks were lost
  CHECK(runs == Runs{{1, 10}, {2, 13}, {1, 22}, {1, 32}});
}

// Advances tick by tick, for either kind of driver.
void walk(Device& device, std::uint64_t tick) {
  while (hardware.now < tick) jump(device, hardware.now + 1);
}

TEST_CASE("timer lateness: the order is kept across the wrap of the clock at 2^32 with both kinds of drivers") {
  constexpr std::uint64_t before_wrap = 0xFFFFFFF0;
  for (const Driver driver : {Driver::counter, Driver::clock}) {
    CAPTURE(driver == Driver::clock);
    Device device(driver);
    device.create(static_cast<std::uint32_t>(before_wrap), 0, 1);
    jump(device, before_wrap);
    device.create(30, 0, 2);
    device.create(10, 20, 3);
    device.create(20, 0, 4);
    const std::int16_t last = device.create(40, 0, 5);
    CHECK(device.remove(last) == 0);
    device.create(35, 0, 6);
    device.create(30, 0, 7);
    walk(device, before_wrap + 50);
    const auto at = [=](std::uint64_t ticks) { return before_wrap + ticks; };
    CHECK(runs ==
          Runs{{1, at(0)}, {3, at(10)}, {4, at(20)}, {2, at(30)}, {7, at(30)}, {3, at(30)}, {6, at(35)}, {3, at(50)}});
  }
}

// Parameters of actions during which timer interrupts occur.
Device* acting;
std::int16_t victim;

void take_long(void* para) {
  note(para);
  for (int tick = 0; tick < 3; ++tick) {
    ++hardware.now;
    if (COTmrService(&acting->node.Tmr) < 0) hardware.misuse = "COTmrService has refused";
  }
}

void take_long_and_delete(void* para) {
  take_long(para);
  CHECK(acting->remove(victim) == 0);
}

void process_again(void* para) {
  note(para);
  acting->process();
}

std::int16_t create(Device& device, std::uint32_t start, std::uint32_t cycle, CO_TMR_FUNC action, std::uintptr_t n) {
  acting = &device;
  return COTmrCreate(&device.node.Tmr, start, cycle, action, reinterpret_cast<void*>(n));
}

TEST_CASE("timer lateness: timers that elapse while actions run are run by the next COTmrProcess()") {
  Device device(Driver::clock);
  create(device, 1, 1, take_long, 1);
  device.create(3, 0, 2);
  jump(device, 1);
  CHECK(runs == Runs{{1, 1}});
  device.process();
  CHECK(runs == Runs{{1, 1}, {1, 4}, {2, 7}});
}

TEST_CASE("timer lateness: one call runs all elapsed timers, however long they have been pending") {
  constexpr std::uint64_t late = 3'000'000'000;  // more than 2^31
  for (const Driver driver : {Driver::counter, Driver::clock}) {
    CAPTURE(driver == Driver::clock);
    Device device(driver);
    device.create(1, 0, 1);
    device.create(2, 0, 2);
    device.create(static_cast<std::uint32_t>(late), 0, 3);
    for (const std::uint64_t now : {std::uint64_t{1}, std::uint64_t{2}, late}) {
      hardware.now = now;
      COTmrService(&device.node.Tmr);
    }
    device.process();
    CHECK(runs == Runs{{1, late}, {2, late}, {3, late}});
  }
}

TEST_CASE("timer lateness: an action may delete the last elapsed timer while later ones elapse") {
  for (const bool alone : {true, false}) {
    CAPTURE(alone);
    Device device(Driver::clock);
    create(device, 1, 0, take_long_and_delete, 1);
    if (!alone) device.create(1, 0, 2);
    victim = device.create(1, 0, 3);
    device.create(2, 0, 4);
    jump(device, 1);
    CHECK(runs == (alone ? Runs{{1, 1}} : Runs{{1, 1}, {2, 4}}));
    device.process();
    CHECK(runs.size() == (alone ? 2 : 3));
    CHECK(runs.back() == Run{4, 4});
  }
}

TEST_CASE("timer lateness: an action that calls COTmrProcess() runs each of the other timers once") {
  for (const Driver driver : {Driver::counter, Driver::clock}) {
    CAPTURE(driver == Driver::clock);
    Device device(driver);
    create(device, 5, 5, process_again, 1);
    device.create(5, 5, 2);
    create(device, 5, 0, process_again, 3);
    walk(device, 10);
    CHECK(runs == Runs{{1, 5}, {2, 5}, {3, 5}, {1, 10}, {2, 10}});
  }
}

}  // namespace
