// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"
#include "measure.hpp"
#include "operations.hpp"

namespace bench {
namespace {

constexpr std::uint32_t spacing = 10;  // ticks

std::uint32_t calls = 0;
void count_call(void*) { ++calls; }

// Starts cyclic timers of one period, which elapse one after the other.
void set_up_timers(unsigned number) {
  clear_dictionary();
  add_usual_objects();
  start(CO_OPERATIONAL);
  for (unsigned n = 1; n <= number; ++n) {
    if (COTmrCreate(&node.Tmr, n * spacing, number * spacing, count_call, nullptr) < 0) {
      fail("timer", "there are too few");
    }
  }
}

// A timer that is inserted behind the first ones of sixteen.
class CreateAndDelete : public Operation {
 public:
  explicit CreateAndDelete(unsigned timers_before) : ticks_(timers_before * spacing + spacing / 2) {}
  void set_up() { set_up_timers(16); }
  void run() {
    id_ = COTmrCreate(&node.Tmr, ticks_, 0, count_call, nullptr);
    deleted_ = COTmrDelete(&node.Tmr, id_);
  }
  bool is_done(unsigned) { return id_ >= 0 && deleted_ == 0 && COTmrDelete(&node.Tmr, id_) < 0; }

 private:
  std::uint32_t ticks_;
  std::int16_t id_ = 0;
  std::int16_t deleted_ = 0;
};

// An expiry of a cyclic timer, which is then inserted behind all others, as all periods are the same.
class Expire : public Operation {
 public:
  explicit Expire(unsigned timers) : timers_(timers) {}
  void set_up() {
    set_up_timers(timers_);
    calls = 0;
  }
  void arrange(unsigned) { elapse(); }
  void run() {
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
  }
  bool is_done(unsigned n) { return calls == n + 1; }

 private:
  unsigned timers_;
};

}  // namespace

void measure_timers() {
  measure("timer created and deleted, in front of 16", CreateAndDelete(0));
  measure("timer created and deleted, in the middle of 16", CreateAndDelete(8));
  measure("timer created and deleted, behind 16", CreateAndDelete(16));
  measure("cyclic timer expires, the only one", Expire(1));
  measure("cyclic timer expires, 16 active", Expire(16));
  measure("cyclic timer expires, 64 active", Expire(64));
}

}  // namespace bench
