// SPDX-License-Identifier: Apache-2.0
#include "mutants.hpp"

namespace check {
namespace {

// Functions that a mutant replaces. Global, as classic drivers have no context argument.
CO_IF_TIMER_DRV spoilt = {};
Board* the_board = nullptr;
std::uint32_t last_reload = 0;
bool was_reloaded = false;

std::function<void(Setting&)> with(const std::function<void(CO_IF_TIMER_DRV&)>& spoil) {
  return [spoil](Setting& s) {
    spoilt = PlainTimerDriver;
    the_board = &s.board;
    last_reload = 0;
    was_reloaded = false;
    spoil(spoilt);
    s.plain.Timer = &spoilt;
  };
}

void reload_by(std::uint32_t ticks) {
  last_reload = ticks;
  PlainTimerDriver.Reload(ticks);
}

std::vector<Mutant> plain_mutants() {
  return {
      {"elapses after Init", "timer.init", with([](auto& t) {
         t.Init = [](std::uint32_t freq) {
           PlainTimerDriver.Init(freq);
           PlainTimerDriver.Reload(10);
         };
       })},
      {"Delay is not 0 after Init", "timer.init", with([](auto& t) { t.Delay = [] { return std::uint32_t{5}; }; })},
      {"a tick early", "timer.elapse", with([](auto& t) {
         t.Reload = [](std::uint32_t n) {
           the_board->latency = 0;
           PlainTimerDriver.Reload(n - 1);
         };
       })},
      {"late", "timer.elapse",
       with([](auto& t) { t.Reload = [](std::uint32_t n) { PlainTimerDriver.Reload(n + 5); }; })},
      {"never", "timer.elapse", with([](auto& t) { t.Update = []() -> std::uint8_t { return 0; }; })},
      {"a compare register of 8 bits", "timer.elapse",
       with([](auto& t) { t.Reload = [](std::uint32_t n) { PlainTimerDriver.Reload(n & 0xFF); }; })},
      {"a compare register of 16 bits", "timer.long",
       with([](auto& t) { t.Reload = [](std::uint32_t n) { PlainTimerDriver.Reload(n & 0xFFFF); }; })},
      {"elapses again and again", "timer.once", with([](auto& t) {
         t.Reload = reload_by;
         t.Stop = [] { PlainTimerDriver.Reload(last_reload == 0 ? 10 : last_reload); };
       })},
      {"Stop does nothing", "timer.stop", with([](auto& t) { t.Stop = [] {}; })},
      {"Delay is left after Stop", "timer.stop", with([](auto& t) {
         t.Reload = reload_by;
         t.Delay = []() -> std::uint32_t { return last_reload == 30 ? 7 : PlainTimerDriver.Delay(); };
       })},
      {"Reload while it runs does nothing", "timer.replace", with([](auto& t) {
         t.Reload = [](std::uint32_t n) {
           if (!the_board->compare.armed) {
             PlainTimerDriver.Reload(n);
           }
         };
       })},
      {"Reload while it runs counts from the last one", "timer.replace", with([](auto& t) {
         t.Reload = [](std::uint32_t n) {
           const bool running = the_board->compare.armed;
           const std::uint64_t from = the_board->compare.at - last_reload;
           reload_by(n);
           the_board->compare.at = running ? from + n : the_board->compare.at;
         };
       })},
      {"Reload in the interrupt does nothing", "timer.reload", with([](auto& t) {
         t.Reload = [](std::uint32_t n) {
           if (!was_reloaded) {
             PlainTimerDriver.Reload(n);
           }
         };
         t.Update = []() -> std::uint8_t {
           was_reloaded = PlainTimerDriver.Update() != 0;
           return was_reloaded ? 1 : 0;
         };
         t.Stop = [] {
           was_reloaded = false;
           PlainTimerDriver.Stop();
         };
       })},
      {"Reload in the interrupt counts from now", "timer.drift", with([](auto& t) {
         t.Reload = [](std::uint32_t n) {
           PlainTimerDriver.Stop();
           PlainTimerDriver.Reload(n);
         };
       })},
      {"Delay tells what has passed", "timer.delay", with([](auto& t) {
         t.Reload = reload_by;
         t.Delay = []() -> std::uint32_t {
           return the_board->compare.armed ? last_reload - PlainTimerDriver.Delay() : 0;
         };
       })},
      {"Delay stays where it was loaded", "timer.delay", with([](auto& t) {
         t.Reload = reload_by;
         t.Delay = []() -> std::uint32_t { return the_board->compare.armed ? last_reload : 0; };
       })},
      {"Reload leaves a pending expiry", "timer.pending", with([](auto& t) {
         t.Reload = [](std::uint32_t n) {
           const bool matched = the_board->compare.matched;
           const std::uint64_t at = the_board->compare.at;
           PlainTimerDriver.Reload(n);
           if (matched) {
             the_board->compare = {at, true, true};
           }
         };
       })},
      {"Stop leaves a pending expiry", "timer.pending",
       with([](auto& t) { t.Stop = [] { the_board->compare.armed = false; }; })},
  };
}

// A driver with a clock, whose now() and alarm() a mutant may replace.
CO_IF_TIMER_DRV_EX spoilt_clock = {};

std::function<void(Setting&)> with_clock(const std::function<void(CO_IF_TIMER_DRV_EX&)>& spoil) {
  return [spoil](Setting& s) {
    spoilt_clock = ClockDriver;
    spoil(spoilt_clock);
    was_reloaded = false;
    s.ext.Timer = &spoilt_clock;
    s.ext.TimerCtx = &s.board;
  };
}

std::uint32_t true_now(void* ctx) { return ClockDriver.Now(ctx); }

std::vector<Mutant> clock_mutants() {
  return {
      {"the clock does not advance", "timer.clock",
       with_clock([](auto& t) { t.Now = [](void*) { return std::uint32_t{7}; }; })},
      {"the high half of the clock comes too late", "timer.clock", with_clock([](auto& t) {
         t.Now = [](void* ctx) {
           const std::uint32_t now = true_now(ctx);
           return (now & 0xFF) == 0 ? now - 0x100 : now;
         };
       })},
      {"the clock is twice as fast", "timer.rate",
       with_clock([](auto& t) { t.Now = [](void* ctx) { return 2 * true_now(ctx); }; })},
      {"the clock has 31 bits", "timer.wrap",
       with_clock([](auto& t) { t.Now = [](void* ctx) { return true_now(ctx) | 0x80000000; }; })},
      {"an alarm beyond the wrap is thought to be over", "timer.wrap", with_clock([](auto& t) {
         t.Alarm = [](void* ctx, std::uint32_t ticks) {
           const std::uint32_t now = true_now(ctx);
           ClockDriver.Alarm(ctx, ticks != 0 && now + ticks < now ? 1 : ticks);
         };
       })},
      {"an alarm a tick early", "timer.elapse", with_clock([](auto& t) {
         t.Alarm = [](void* ctx, std::uint32_t ticks) {
           static_cast<Board*>(ctx)->latency = 0;
           ClockDriver.Alarm(ctx, ticks > 1 ? ticks - 1 : ticks);
         };
       })},
      {"an alarm cannot be taken back", "timer.stop", with_clock([](auto& t) {
         t.Alarm = [](void* ctx, std::uint32_t ticks) {
           Compare& compare = static_cast<Board*>(ctx)->compare;
           if (ticks != 0) {
             ClockDriver.Alarm(ctx, ticks);
           } else {
             compare.armed = compare.armed && !compare.matched;
             compare.matched = false;
           }
         };
       })},
      {"no alarm can be set in the interrupt", "timer.reload", with_clock([](auto& t) {
         t.Alarm = [](void* ctx, std::uint32_t ticks) {
           const bool in_interrupt = static_cast<Board*>(ctx)->compare.matched;
           ClockDriver.Alarm(ctx, in_interrupt ? 0 : ticks);
         };
       })},
  };
}

}  // namespace

std::vector<Mutant> timer_mutants() {
  std::vector<Mutant> all = plain_mutants();
  const std::vector<Mutant> more = clock_mutants();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace check
