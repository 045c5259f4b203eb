// SPDX-License-Identifier: Apache-2.0
#include "virtual_clock.hpp"

#include <algorithm>
#include <utility>

namespace co {
namespace {

constexpr std::uint64_t micros_per_second = 1000000;

}  // namespace

std::chrono::microseconds VirtualClock::time() const {
  if (frequency_ == 0) {
    return std::chrono::microseconds{0};
  }
  // Converts whole seconds separately, so that the product fits into 64 bits for centuries.
  const std::uint64_t rest = (elapsed_ % frequency_) * micros_per_second / frequency_;
  return std::chrono::microseconds{static_cast<std::int64_t>(elapsed_ / frequency_ * micros_per_second + rest)};
}

std::uint64_t VirtualClock::ticks(std::chrono::microseconds time) const {
  if (time.count() <= 0) {
    return 0;
  }
  const auto micros = static_cast<std::uint64_t>(time.count());
  const std::uint64_t rest = (micros % micros_per_second) * frequency_ + micros_per_second - 1;
  return micros / micros_per_second * frequency_ + rest / micros_per_second;
}

void VirtualClock::advance(std::uint64_t ticks) {
  const std::uint64_t target = elapsed_ + ticks;
  for (VirtualTimer* timer = earliest(); timer != nullptr && timer->deadline_ <= target; timer = earliest()) {
    elapsed_ = std::max(elapsed_, timer->deadline_);
    timer->expire();
  }
  elapsed_ = std::max(elapsed_, target);  // an alarm function may have advanced the clock further
}

bool VirtualClock::advance_to_alarm() {
  const std::uint32_t ticks = next_alarm();
  if (ticks == never) {
    return false;
  }
  advance(ticks);
  return true;
}

std::uint32_t VirtualClock::next_alarm() const {
  const VirtualTimer* const timer = earliest();
  return (timer == nullptr) ? never : static_cast<std::uint32_t>(timer->deadline_ - elapsed_);
}

VirtualTimer* VirtualClock::earliest() const {
  VirtualTimer* first = nullptr;
  for (VirtualTimer* timer : timers_) {
    if (timer->armed_ && (first == nullptr || timer->deadline_ < first->deadline_)) {
      first = timer;
    }
  }
  return first;
}

VirtualTimer::VirtualTimer(VirtualClock& clock, std::function<void()> on_alarm)
    : clock_(clock), on_alarm_(std::move(on_alarm)) {
  clock_.timers_.push_back(this);
}

VirtualTimer::~VirtualTimer() {
  auto& timers = clock_.timers_;
  timers.erase(std::remove(timers.begin(), timers.end(), this), timers.end());
}

void VirtualTimer::set_alarm(std::uint32_t ticks) {
  armed_ = (ticks != 0);
  deadline_ = clock_.elapsed() + ticks;
}

void VirtualTimer::expire() {
  armed_ = false;
  ++alarms_;
  // Called last: the function may destroy this timer.
  if (const auto on_alarm = on_alarm_) {
    on_alarm();
  }
}

namespace {

VirtualTimer& timer(void* ctx) { return *static_cast<VirtualTimer*>(ctx); }

void init(void* ctx, std::uint32_t freq) {
  timer(ctx).clock().set_frequency(freq);
  timer(ctx).set_alarm(0);
}

std::uint32_t now(void* ctx) { return timer(ctx).clock().now(); }
void alarm(void* ctx, std::uint32_t ticks) { timer(ctx).set_alarm(ticks); }

}  // namespace

}  // namespace co

const CO_IF_TIMER_DRV_EX COVirtualTimerDriver = {co::init, co::now, co::alarm};
