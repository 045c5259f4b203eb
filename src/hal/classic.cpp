// SPDX-License-Identifier: Apache-2.0
#include "hal/port.hpp"

#include "co_assert.h"

namespace co::classic {
namespace {

// CAN driver. The context argument of the adapters for CAN and memory is the table of classic drivers. The application
// may replace drivers in the table.
const CO_IF_DRV& drivers_of(const void* ctx) { return *static_cast<const CO_IF_DRV*>(ctx); }
const CO_IF_CAN_DRV& can_of(const void* ctx) { return *drivers_of(ctx).Can; }
void can_init(void* ctx) { can_of(ctx).Init(); }
void can_enable(void* ctx, uint32_t baud) { can_of(ctx).Enable(baud); }
int16_t can_read(void* ctx, CO_IF_FRM* frame) { return can_of(ctx).Read(frame); }
int16_t can_send(void* ctx, const CO_IF_FRM* frame) {
  CO_IF_FRM copy = *frame;  // classic drivers may change the frame
  return can_of(ctx).Send(&copy);
}
void can_reset(void* ctx) { can_of(ctx).Reset(); }
void can_close(void* ctx) { can_of(ctx).Close(); }

constexpr CO_IF_CAN_DRV_EX can_adapter = {can_init,  can_enable, can_read, can_send,
                                          can_reset, can_close,  nullptr,  nullptr};

// Memory driver.
const CO_IF_NVM_DRV& nvm_of(const void* ctx) { return *drivers_of(ctx).Nvm; }
void nvm_init(void* ctx) { nvm_of(ctx).Init(); }
uint32_t nvm_read(void* ctx, uint32_t start, uint8_t* buffer, uint32_t size) {
  return nvm_of(ctx).Read(start, buffer, size);
}
uint32_t nvm_write(void* ctx, uint32_t start, const uint8_t* buffer, uint32_t size) {
  return nvm_of(ctx).Write(start, const_cast<uint8_t*>(buffer), size);
}

constexpr CO_IF_NVM_DRV_EX nvm_adapter = {nvm_init, nvm_read, nvm_write, nullptr, nullptr};

// Timer driver. The context argument of the adapter is the node's CO_IF. A classic driver counts down and has no clock:
// the adapter subtracts the ticks that are left from the time of the expiry. The clock stops when the driver stops.
CO_IF& interface_of(void* ctx) { return *static_cast<CO_IF*>(ctx); }
const CO_IF_TIMER_DRV& timer_of(const CO_IF& cif) { return *cif.Drv->Timer; }

void timer_init(void* ctx, uint32_t freq) { timer_of(interface_of(ctx)).Init(freq); }

uint32_t timer_now(void* ctx) {
  const CO_IF& cif = interface_of(ctx);
  if (cif.Programmed == 0 || cif.IsElapsed) {
    return cif.Expiry;
  }
  const uint32_t left = timer_of(cif).Delay();
  return cif.Expiry - (left < cif.Programmed ? left : cif.Programmed);
}

// Returns the ticks for which the driver counts while no timer is armed; 0: the driver stops. The driver must count
// while the loop has not processed an elapsed cyclic timer yet, so that this timer keeps its phase: until its next
// expiry or, if that is missed, as long as possible, so that a blocked loop causes only one more interrupt.
uint32_t wait_for_loop(const CO_TMR& timers, uint32_t now) {
  const CO_TMR_MEM* timer = timers.First;
  while (timer != nullptr && timer->Cycle == 0) {
    timer = timer->Next;
  }
  if (timer == nullptr) {
    return 0;
  }
  const uint32_t late = now - timer->At;
  return late < timer->Cycle ? timer->Cycle - late : UINT32_MAX;
}

// Lets the driver count until some ticks after now. 0 ticks: stops the driver.
void count_down(CO_IF& cif, uint32_t now, uint32_t ticks) {
  const bool is_stopped = cif.Programmed == 0;
  cif.IsElapsed = false;
  cif.Expiry = now + ticks;
  cif.Programmed = ticks;
  if (ticks == 0) {
    timer_of(cif).Stop();
    return;
  }
  timer_of(cif).Reload(ticks);
  if (is_stopped) {
    timer_of(cif).Start();
  }
}

// Sets the alarm. Has no effect if the driver already counts until that moment, or if it has elapsed and
// COTmrService(), which programs it again, has not been called yet.
void timer_alarm(void* ctx, uint32_t ticks) {
  CO_IF& cif = interface_of(ctx);
  const uint32_t now = timer_now(ctx);
  const uint32_t wait = ticks != 0 ? ticks : wait_for_loop(cif.Node->Tmr, now);
  const bool is_counting = cif.Programmed != 0 && !cif.IsElapsed;
  if (!is_counting || (now != cif.Expiry && now + wait != cif.Expiry)) {
    count_down(cif, now, wait);
  }
}

bool has_elapsed(CO_IF* cif) {
  cif->IsElapsed = timer_of(*cif).Update() != 0;
  return cif->IsElapsed;
}

constexpr CO_IF_TIMER_DRV_EX timer_adapter = {timer_init, timer_now, timer_alarm};

}  // namespace

void add_drivers(CO_IF& cif, CO_IF_DRV& drivers) {
  cif.Drv = &drivers;
  if (cif.Can == nullptr && drivers.Can != nullptr) {
    cif.Can = &can_adapter;
    cif.CanCtx = &drivers;
  }
  if (cif.Nvm == nullptr && drivers.Nvm != nullptr) {
    cif.Nvm = &nvm_adapter;
    cif.NvmCtx = &drivers;
  }
  if (cif.Timer == nullptr && drivers.Timer != nullptr) {
    cif.Timer = &timer_adapter;
    cif.TimerCtx = &cif;
    cif.HasElapsed = has_elapsed;
  }
}

}  // namespace co::classic
