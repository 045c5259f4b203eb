// SPDX-License-Identifier: Apache-2.0
// A node with a real-time thread and a mainline thread: random frames, and random calls of the functions that either
// thread may call. Lane "threads" runs this file with the thread sanitizer.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "co_core.h"
#include "co_od.h"
#include "co_para.h"
#include "support/stride.hpp"

#if USE_REAL_TIME && USE_OD && USE_SYNC && USE_EMCY && USE_PARA && USE_CSDO && USE_TIME && USE_NMT_MASTER && \
    USE_CALLBACKS && CO_RPDO_N >= 3 && CO_TPDO_N >= 3 && CO_HBCONS_N > 0 && CO_EMCY_CONS_N >= 2

namespace {

constexpr std::uint8_t node_id = 1;
constexpr std::uint32_t memory_size = 1024;
constexpr std::uint32_t no_remote = 0x40000000;  // COB-ID of a TPDO: no remote requests

class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed * 2654435761U + 1) {}
  std::uint32_t number() {
    state_ ^= state_ << 13U;
    state_ ^= state_ >> 17U;
    state_ ^= state_ << 5U;
    return state_;
  }
  std::uint32_t below(std::uint32_t limit) { return (number() >> 8U) % limit; }
  bool one_of(std::uint32_t limit) { return below(limit) == 0; }
  template <class T, std::size_t N>
  T any(const T (&all)[N]) {
    return all[below(N)];
  }

 private:
  std::uint32_t state_;
};

struct Group {
  std::uint32_t limit;
  std::uint8_t bytes[60];
};

/// A node with its drivers, variables and both threads. Each pair of variables holds a value and its complement.
class ThreadedNode {
 public:
  explicit ThreadedNode(std::uint32_t seed)
      : frames_(seed), mainline_random_(seed + 1000), real_time_random_(seed + 2000) {
    REQUIRE(CORingInit(&ring_, ring_memory_.get(), ring_size));
    init();
    REQUIRE(CONodeGetErr(&node_) == CO_ERR_NONE);
    CONodeStart(&node_);
  }
  ~ThreadedNode() { CONodeStop(&node_); }
  ThreadedNode(const ThreadedNode&) = delete;
  ThreadedNode& operator=(const ThreadedNode&) = delete;

  /// Runs both threads until each has done its cycles, then stops the node while both go on. Neither is more than
  /// \a lead cycles ahead of the other.
  void run(unsigned cycles, unsigned lead) {
    std::atomic<unsigned> real_time_cycles = 0;
    std::atomic<unsigned> mainline_cycles = 0;
    are_threads_running_ = true;
    std::thread mainline([&] {
      mainline_ = std::this_thread::get_id();
      run_cycles(mainline_cycles, real_time_cycles, cycles, lead, [this] { run_mainline(); });
      CO_LOCK_OD(&node_);
      CONodeStop(&node_);
      CO_UNLOCK_OD(&node_);
      run_cycles(mainline_cycles, real_time_cycles, stopped_cycles, lead, [this] { run_mainline(); });
    });
    std::thread real_time([&] {
      run_cycles(real_time_cycles, mainline_cycles, cycles + stopped_cycles, lead, [this] { run_real_time(); });
    });
    real_time.join();
    mainline.join();
    are_threads_running_ = false;
  }

  /// Checks the node after run(), and that it is still alive.
  void check() {
    CHECK(broken_ == std::string());
    CHECK_FALSE(holds_lock());
    const CO_NODE_COUNTERS counters = CONodeGetCounters(&node_);
    CHECK(counters.Received == read_);
    CHECK(counters.Unclaimed <= counters.Received);
    CHECK(CORingCount(&ring_) <= ring_size);
    CHECK(input_[1] == ~input_[0]);
    is_silent_ = true;
    init();
    CONodeStart(&node_);
    CHECK(sent_.Identifier == 0x700U + node_id);
    ask_ = true;
    CONodeRealTime(&node_);
    CONodeProcess(&node_);
    CHECK(sent_.Identifier == 0x580U + node_id);
    CHECK(sent_.Data[4] == 0x92);
  }

 private:
  static constexpr std::uint16_t ring_size = 32;
  static constexpr unsigned stopped_cycles = 20;  // after CONodeStop()

  static bool& holds_lock() {
    thread_local bool holds = false;
    return holds;
  }
  void require(bool holds, const char* rule) {
    if (!holds) {
      const std::lock_guard<std::mutex> guard(broken_mutex_);
      broken_ = rule;
    }
  }

  // Without order between the threads: another one than that of the node lock would hide races from the sanitizer.
  template <class Function>
  static void run_cycles(std::atomic<unsigned>& own, const std::atomic<unsigned>& other, unsigned cycles, unsigned lead,
                         Function function) {
    const unsigned first = own.load(std::memory_order_relaxed);
    for (unsigned n = first; n < first + cycles; ++n) {
      while (n > other.load(std::memory_order_relaxed) + lead) {
        std::this_thread::yield();
      }
      function();
      own.store(n + 1, std::memory_order_relaxed);
    }
  }

  // Node lock -----------------------------------------------------------------------

  void enter() {
    require(!holds_lock(), "the node lock is not nested");
    lock_.lock();
    holds_lock() = true;
  }
  void leave() {
    require(holds_lock(), "the node lock is released once");
    holds_lock() = false;
    lock_.unlock();
  }

  // Drivers -------------------------------------------------------------------------

  static ThreadedNode& of(void* ctx) { return *static_cast<ThreadedNode*>(ctx); }
  void check_driver_context() { require(!are_threads_running_ || holds_lock(), "drivers are called with the lock"); }

  std::int16_t read(CO_IF_FRM& frame) {
    check_driver_context();
    if (is_silent_) {
      frame = CO_IF_FRM{0x600U + node_id, {0x40, 0x00, 0x10, 0x00}, 8};
      return std::exchange(ask_, false) ? std::int16_t{sizeof frame} : std::int16_t{0};
    }
    ticks_ += frames_.below(3);
    if (frames_.one_of(5)) {
      return frames_.one_of(10) ? std::int16_t{-1} : std::int16_t{0};
    }
    frame = any_frame();
    ++read_;
    return sizeof frame;
  }

  std::int16_t send(const CO_IF_FRM& frame) {
    check_driver_context();
    if (!is_silent_ && frames_.one_of(8)) {
      return frames_.one_of(8) ? std::int16_t{-1} : std::int16_t{0};
    }
    require(frame.DLC <= 8, "a frame has 8 bytes at most");
    sent_ = frame;
    return sizeof frame;
  }

  // A memory that has a Shape function: used by the mainline, and written without the node lock.
  void check_memory_context() {
    if (are_threads_running_) {
      require(std::this_thread::get_id() == mainline_, "the memory is used by the mainline only");
    }
  }
  std::uint32_t load(std::uint32_t at, std::uint8_t* to, std::uint32_t size) {
    check_memory_context();
    std::memcpy(to, memory_.get() + at, size);
    return size;
  }
  std::uint32_t store(std::uint32_t at, const std::uint8_t* from, std::uint32_t size) {
    check_memory_context();
    require(!are_threads_running_ || !holds_lock(), "the memory is written without the lock");
    std::memcpy(memory_.get() + at, from, size);
    std::this_thread::yield();
    return size;
  }

  // Frames --------------------------------------------------------------------------

  void name_object(CO_IF_FRM& frame) {
    constexpr std::uint32_t objects[] = {0x100000, 0x100800, 0x101001, 0x101101, 0x101700, 0x140102,
                                         0x180102, 0x200200, 0x200300, 0x200400, 0x200500, 0x300000};
    const std::uint32_t object = frames_.any(objects);
    CO_SET_WORD(&frame, static_cast<std::uint16_t>(object >> 8U), 1);
    frame.Data[3] = static_cast<std::uint8_t>(object);
    if (object == 0x101001 && frames_.one_of(2)) {
      std::memcpy(&frame.Data[4], "save", 4);
    }
  }

  CO_IF_FRM any_frame() {
    constexpr std::uint32_t rtr = CO_IF_FRM_RTR;
    constexpr std::uint32_t identifiers[] = {
        0x201, 0x201, 0x301, 0x401, 0x080, 0x080, 0x080, 0x601, 0x601, 0x601,       0x601,       0x601,       0x582,
        0x582, 0x000, 0x7E5, 0x082, 0x702, 0x100, 0x123, 0x1,   0x7E4, 0x181 | rtr, 0x701 | rtr, 0x381 | rtr,
    };
    constexpr std::uint8_t commands[] = {0x40, 0x40, 0x2F, 0x2B, 0x23, 0x21, 0x22, 0x60, 0x70, 0x00, 0x10,
                                         0x01, 0x1D, 0x80, 0xC0, 0xC2, 0xC6, 0xC1, 0xD5, 0xA0, 0xA4, 0xA3,
                                         0xA2, 0xA1, 0x43, 0x4F, 0x41, 0x20, 0x30, 0x02, 0x03, 0x81, 0x82};
    CO_IF_FRM frame{frames_.any(identifiers), {}, 8};
    for (std::uint8_t& byte : frame.Data) {
      byte = static_cast<std::uint8_t>(frames_.number());
    }
    switch (frame.Identifier) {
      case 0x201: set_pair(frame); break;
      case 0x000: set_nmt(frame); break;
      case 0x080: frame.DLC = 0; break;
      case 0x702: frame.DLC = 1; break;
      case 0x100: frame.DLC = 6; break;
      case 0x601:
      case 0x582:
        frame.Data[0] = frames_.any(commands);
        name_object(frame);
        break;
      case 0x7E5: set_lss(frame); break;
      case 0x1: set_unusual(frame); break;
      default: break;
    }
    if (frames_.one_of(4)) {
      frame.DLC = static_cast<std::uint8_t>(frames_.below(16));
    }
    return frame;
  }
  void set_pair(CO_IF_FRM& frame) {
    const std::uint32_t value = frames_.number();
    CO_SET_LONG(&frame, value, 0);
    CO_SET_LONG(&frame, ~value, 4);
  }
  void set_nmt(CO_IF_FRM& frame) {
    constexpr std::uint8_t commands[] = {1, 1, 1, 1, 1, 1, 2, 128, 129, 130, 7};
    frame.Data[0] = frames_.any(commands);
    frame.Data[1] = static_cast<std::uint8_t>(frames_.below(3));
    frame.DLC = 2;
  }
  void set_lss(CO_IF_FRM& frame) {
    constexpr std::uint8_t services[] = {0x04, 0x04, 0x13, 0x15, 0x17, 0x40, 0x41,
                                         0x42, 0x43, 0x46, 0x4C, 0x51, 0x5E, 0x5A};
    frame.Data[0] = frames_.any(services);
    frame.Data[1] &= 1U;
    frame.Data[2] &= 7U;
  }
  // Error frames, 29-bit identifiers and identifiers with unused bits.
  void set_unusual(CO_IF_FRM& frame) {
    frame.Identifier = frames_.number();
    if (frames_.one_of(2)) {
      frame.Identifier = CO_IF_FRM_ERROR | (frames_.number() & 0x1FFU);
    }
  }

  // Threads -------------------------------------------------------------------------

  void run_real_time() {
    Random& random = real_time_random_;
    CONodeRealTime(&node_);
    (void)CORingCount(&ring_);
    (void)CORingLost(&ring_);
    if (random.one_of(4)) {
      (void)CONodeNextDeadline(&node_);
    }
    CO_LOCK_OD(&node_);
    require(input_[1] == ~input_[0], "a pair is written as a whole");
    output_[0] = input_[0];
    output_[1] = ~input_[0];
    call_from_any_thread(random);
    CO_UNLOCK_OD(&node_);
  }

  void run_mainline() {
    Random& random = mainline_random_;
    if (random.one_of(2)) {
      for (unsigned calls = CORingCount(&ring_) + 1U; calls != 0; --calls) {
        CONodeProcess(&node_);
      }
    }
    if (random.one_of(3)) {
      COTmrProcess(&node_.Tmr);
    }
    if (random.one_of(4)) {
      (void)CONodeNextDeadline(&node_);
    }
    CO_LOCK_OD(&node_);
    require(input_[1] == ~input_[0], "a pair is written as a whole");
    random.one_of(2) ? call_from_any_thread(random) : call_from_mainline(random);
    CO_UNLOCK_OD(&node_);
  }

  // Functions that any thread may call with the node lock held.
  void call_from_any_thread(Random& random) {
    std::uint32_t value = 0;
    switch (random.below(18)) {
      case 0: COEmcySet(&node_.Emcy, static_cast<std::uint8_t>(random.below(3)), nullptr); break;
      case 1: COEmcyClr(&node_.Emcy, static_cast<std::uint8_t>(random.below(3))); break;
      case 2: (void)COEmcyGet(&node_.Emcy, 0); break;
      case 3: (void)COEmcyCnt(&node_.Emcy); break;
      case 4: COTPdoTrigPdo(node_.TPdo, static_cast<std::uint16_t>(random.below(4))); break;
      case 5: COTPdoTrigObj(node_.TPdo, CODictFind(&node_.Dict, CO_DEV(0x2002, 0))); break;
      case 6: (void)COTPdoRequest(&node_, static_cast<std::uint16_t>(random.below(3))); break;
      case 7: (void)CODictRdLong(&node_.Dict, CO_DEV(0x2001, 1), &value); break;
      case 8: (void)CODictWrByte(&node_.Dict, CO_DEV(0x2002, 0), static_cast<std::uint8_t>(random.number())); break;
      case 9: (void)CODictWrLong(&node_.Dict, CO_DEV(0x2003, 0), random.number()); break;
      case 10: (void)CORPdoWasReceived(&node_, 0); break;
      case 11: (void)COTPdoWasSent(&node_, 1); break;
      case 12: (void)CONmtGetMode(&node_.Nmt); break;
      case 13: (void)CONodeGetCounters(&node_); break;
      case 14: {
        CO_IF_FRM frame{0x123, {1}, static_cast<std::uint8_t>(random.below(9))};
        (void)COIfCanSend(&node_.If, &frame);
        break;
      }
      case 15:
        if (random.one_of(20)) {
          CONmtReset(&node_.Nmt, random.one_of(2) ? CO_RESET_COM : CO_RESET_NODE);
        }
        break;
      case 16: (void)CONodeGetErr(&node_); break;
      default: (void)CONmtLastHbState(&node_.Nmt, 2); break;
    }
  }

  void call_from_mainline(Random& random) {
    constexpr CO_MODE modes[] = {CO_OPERATIONAL, CO_OPERATIONAL, CO_OPERATIONAL, CO_PREOP, CO_STOP};
    CO_TIME_OF_DAY time{};
    switch (random.below(18)) {
      case 0: CONmtSetMode(&node_.Nmt, random.any(modes)); break;
      case 1: COEmcyReset(&node_.Emcy, static_cast<std::uint8_t>(random.below(2))); break;
      case 2: COEmcyHistReset(&node_.Emcy); break;
      case 3: (void)CODictWrWord(&node_.Dict, CO_DEV(0x1017, 0), static_cast<std::uint16_t>(random.below(20))); break;
      case 4: set_pdo(random, 0x1801); break;
      case 5: set_pdo(random, 0x1401); break;
      case 6: CONodeCanEvent(&node_, static_cast<CO_CAN_EVENT>(random.below(CO_CAN_EVENT_NUM))); break;
      case 7: (void)COParaStore(&group_, &node_); break;
      case 8:
        (void)COCSdoRequestUpload(COCSdoFind(&node_, 0), CO_DEV(0x2004, 0), client_, sizeof client_, nothing, 20);
        break;
      case 9:
        (void)COCSdoRequestDownload(COCSdoFind(&node_, 0), CO_DEV(0x2004, 0), client_, sizeof client_, nothing, 20);
        break;
      case 10: (void)COCSdoCancel(COCSdoFind(&node_, 0)); break;
      case 11:
        (void)COTmrDelete(&node_.Tmr, timer_);
        timer_ = COTmrCreate(&node_.Tmr, random.below(10), random.below(10), count_timer, this);
        break;
      case 12: (void)COTimeSet(&node_, &time); break;
      case 13: (void)COTimeGet(&node_, &time); break;
      case 14: (void)COTimeSend(&node_); break;
      case 15: (void)CONmtCommand(&node_.Nmt, CO_NMT_COMMAND_START, 0); break;
      case 16: set_sync(random); break;
      default: (void)CODictWrBuffer(&node_.Dict, CO_DEV(0x2004, 0), client_, sizeof client_); break;
    }
  }
  void set_pdo(Random& random, std::uint32_t index) {
    std::uint32_t id = 0;
    (void)CODictRdLong(&node_.Dict, CO_DEV(index, 1), &id);
    (void)CODictWrLong(&node_.Dict, CO_DEV(index, 1), id | 0x80000000U);
    constexpr std::uint8_t types[] = {0, 1, 2, 254, 255};
    (void)CODictWrByte(&node_.Dict, CO_DEV(index, 2), random.any(types));
    (void)CODictWrWord(&node_.Dict, CO_DEV(index, 5), static_cast<std::uint16_t>(random.below(9)));
    (void)CODictWrLong(&node_.Dict, CO_DEV(index, 1), id & 0x7FFFFFFFU);
  }
  void set_sync(Random& random) {
    (void)CODictWrLong(&node_.Dict, CO_DEV(0x1005, 0), 0x80);
    (void)CODictWrLong(&node_.Dict, CO_DEV(0x1006, 0), random.below(4) * 1000);
    (void)CODictWrLong(&node_.Dict, CO_DEV(0x1007, 0), random.below(4) * 1000);
    (void)CODictWrLong(&node_.Dict, CO_DEV(0x1005, 0), random.one_of(2) ? 0x80 : 0x40000080);
  }

  static void nothing(CO_CSDO*, std::uint16_t, std::uint8_t, std::uint32_t) {}
  static void count_timer(void* ctx) { of(ctx).note_callback(); }

  // Called by every callback. Counts without synchronisation: the node lock is held.
  void note_callback() {
    require(!are_threads_running_ || holds_lock(), "callbacks are called with the lock");
    ++callbacks_;
  }
  void note_mainline_callback() {
    note_callback();
    require(!are_threads_running_ || std::this_thread::get_id() == mainline_, "a callback of the mainline");
  }
  void note_pdo() {
    note_callback();
    if (callbacks_ % 512 == 0) {
      CONmtReset(&node_.Nmt, CO_RESET_COM);
    }
  }

  // Set-up --------------------------------------------------------------------------

  void init() {
    static const CO_IF_CAN_DRV_EX can = {
        [](void*) {},
        [](void*, std::uint32_t) {},
        [](void* ctx, CO_IF_FRM* frame) { return of(ctx).read(*frame); },
        [](void* ctx, const CO_IF_FRM* frame) { return of(ctx).send(*frame); },
        [](void*) {},
        [](void*) {},
        [](void* ctx, const std::uint32_t*, std::uint16_t) { of(ctx).check_driver_context(); },
        CONodeCanReport};
    static const CO_IF_TIMER_DRV_EX timer = {[](void*, std::uint32_t) {},
                                             [](void* ctx) {
                                               of(ctx).check_driver_context();
                                               return of(ctx).ticks_;
                                             },
                                             nullptr};
    static const CO_IF_NVM_DRV_EX nvm = {
        [](void*) {},
        [](void* ctx, std::uint32_t at, std::uint8_t* to, std::uint32_t size) { return of(ctx).load(at, to, size); },
        [](void* ctx, std::uint32_t at, const std::uint8_t* from, std::uint32_t size) {
          return of(ctx).store(at, from, size);
        },
        nullptr,
        [](void*) {
          return CO_NVM_SHAPE{memory_size, 1, 0};
        }};
    static const CO_CALLBACKS callbacks = [] {
      CO_CALLBACKS all{};
      all.PdoUpdate = [](CO_NODE*, void* user, CO_RPDO*) { of(user).note_pdo(); };
      all.PdoSyncUpdate = [](CO_NODE*, void* user, CO_RPDO*) { of(user).note_pdo(); };
      all.PdoTransmit = [](CO_NODE*, void* user, CO_IF_FRM*) { of(user).note_callback(); };
      all.PdoReceive = [](CO_NODE*, void* user, CO_IF_FRM*) { return of(user).note_callback(), std::int16_t{0}; };
      all.CanReceive = [](CO_NODE*, void* user, CO_IF_FRM*) { of(user).note_mainline_callback(); };
      all.CanChange = [](CO_NODE*, void* user, CO_CAN_EVENT) { of(user).note_mainline_callback(); };
      all.TimeUpdate = [](CO_NODE*, void* user, const CO_TIME_OF_DAY*) { of(user).note_mainline_callback(); };
      all.EmcyReceived = [](CO_NODE*, void* user, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*) {
        of(user).note_mainline_callback();
      };
      all.LssLoad = [](CO_NODE*, void*, std::uint32_t*, std::uint8_t*) { return CO_ERR_NONE; };
      all.LssStore = [](CO_NODE*, void* user, std::uint32_t, std::uint8_t) {
        of(user).note_mainline_callback();
        return CO_ERR_NONE;
      };
      return all;
    }();
    static CO_EMCY_TBL errors[] = {{CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_ERR},
                                   {CO_EMCY_REG_CURRENT, CO_EMCY_CODE_CUR_ERR},
                                   {CO_EMCY_REG_VOLTAGE, CO_EMCY_CODE_VOL_ERR}};
    fill_table();
    ext_ = {};
    ext_.Size = sizeof ext_;
    ext_.Can = &can;
    ext_.CanCtx = this;
    ext_.Timer = &timer;
    ext_.TimerCtx = this;
    ext_.Nvm = &nvm;
    ext_.NvmCtx = this;
    ext_.User = this;
    ext_.EmcyNum = 3;
    ext_.Enter = [](void* user) { of(user).enter(); };
    ext_.Leave = [](void* user) { of(user).leave(); };
    ext_.Lock = [](void*) {};
    ext_.Unlock = [](void*) {};
    ext_.Mainline = &ring_;
    ext_.Foreign = true;
    ext_.Callbacks = &callbacks;
    const CO_NODE_SPEC spec{node_id,
                            250000,
                            table_.data(),
                            static_cast<std::uint16_t>(table_.size() - 1),
                            errors,
                            timers_,
                            static_cast<std::uint16_t>(std::size(timers_)),
                            1000,
                            nullptr,
                            sdo_buffer_.get()};
    CONodeInitEx(&node_, &spec, &ext_);
  }

  template <class T>
  static CO_OBJ row(std::uint32_t index, std::uint32_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, T* data) {
    return {CO_KEY(index, sub, flags), type, CO_DATA(data)};
  }
  static CO_OBJ value(std::uint32_t index, std::uint32_t sub, const CO_OBJ_TYPE* type, std::uint32_t data) {
    return {CO_KEY(index, sub, CO_OBJ_D___R_), type, CO_DATA(data)};
  }

  void add_pdo(std::uint32_t index, std::uint32_t n, std::uint32_t id, std::uint32_t type,
               const std::vector<std::uint32_t>& mapped) {
    const std::uint32_t number = (index == 0x1800 ? 3 : 0) + n;
    pdo_ids_[number] = id | (index == 0x1800 && USE_PDO_RTR == 0 ? no_remote : 0);
    pdo_types_[number] = static_cast<std::uint8_t>(type);
    pdo_events_[number] = 5;
    table_.push_back(row(index + n, 1, CO_OBJ_____RW, CO_TPDO_ID, &pdo_ids_[number]));
    table_.push_back(row(index + n, 2, CO_OBJ_____RW, CO_TPDO_TYPE, &pdo_types_[number]));
    table_.push_back(row(index + n, 5, CO_OBJ_____RW, CO_TPDO_EVENT, &pdo_events_[number]));
    table_.push_back(value(index + 0x200 + n, 0, CO_TPDO_NUM, static_cast<std::uint32_t>(mapped.size())));
    for (std::uint32_t sub = 1; sub <= mapped.size(); ++sub) {
      table_.push_back(value(index + 0x200 + n, sub, CO_TPDO_MAP, mapped[sub - 1]));
    }
  }

  void fill_table() {
    table_ = {
        value(0x1000, 0, CO_TUNSIGNED32, 0x192),
        row(0x1001, 0, CO_OBJ_____R_, CO_TUNSIGNED8, &error_register_),
        row(0x1003, 0, CO_OBJ_____RW, CO_TEMCY_HIST, &history_number_),
        row(0x1003, 1, CO_OBJ_____R_, CO_TEMCY_HIST, &history_[0]),
        row(0x1003, 2, CO_OBJ_____R_, CO_TEMCY_HIST, &history_[1]),
        row(0x1005, 0, CO_OBJ_____RW, CO_TSYNC_ID, &sync_id_),
        row(0x1006, 0, CO_OBJ_____RW, CO_TSYNC_CYCLE, &sync_cycle_),
        row(0x1007, 0, CO_OBJ_____RW, CO_TSYNC_WINDOW, &sync_window_),
        row(0x1008, 0, CO_OBJ_____R_, CO_TSTRING, &name_),
        value(0x1010, 0, CO_TUNSIGNED8, 1),
        row(0x1010, 1, CO_OBJ_____RW, CO_TPARA_STORE, &group_),
        value(0x1011, 0, CO_TUNSIGNED8, 1),
        row(0x1011, 1, CO_OBJ_____RW, CO_TPARA_RESTORE, &group_),
        row(0x1012, 0, CO_OBJ_____RW, CO_TTIME_ID, &time_id_),
        {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
        row(0x1016, 1, CO_OBJ_____RW, CO_THB_CONS, &consumer_),
        row(0x1017, 0, CO_OBJ_____RW, CO_THB_PROD, &heartbeat_),
        value(0x1018, 0, CO_TUNSIGNED8, 4),
        value(0x1018, 1, CO_TUNSIGNED32, 1),
        value(0x1018, 2, CO_TUNSIGNED32, 2),
        value(0x1018, 3, CO_TUNSIGNED32, 3),
        value(0x1018, 4, CO_TUNSIGNED32, 4),
        value(0x1028, 0, CO_TUNSIGNED8, 2),
        value(0x1028, 2, CO_TEMCY_CONS, 0x82),
        value(0x1280, 1, CO_TUNSIGNED32, 0x602),
        value(0x1280, 2, CO_TUNSIGNED32, 0x582),
        value(0x1280, 3, CO_TUNSIGNED8, 2),
        row(0x2000, 1, CO_OBJ____PRW, CO_TUNSIGNED32, &input_[0]),
        row(0x2000, 2, CO_OBJ____PRW, CO_TUNSIGNED32, &input_[1]),
        row(0x2001, 1, CO_OBJ____PR_, CO_TUNSIGNED32, &output_[0]),
        row(0x2001, 2, CO_OBJ____PR_, CO_TUNSIGNED32, &output_[1]),
        row(0x2002, 0, CO_OBJ___APRW, CO_TUNSIGNED8, &flagged_),
        row(0x2003, 0, CO_OBJ____PRW, CO_TUNSIGNED32, &values_.limit),
        row(0x2004, 0, CO_OBJ_____RW, CO_TDOMAIN, &domain_),
        row(0x2005, 0, CO_OBJ_____RW, CO_TUNSIGNED32, &plain_),
    };
    add_pdo(0x1400, 0, 0x201, 1, {0x20000120, 0x20000220});
    add_pdo(0x1400, 1, 0x301, 255, {0x20020008});
    add_pdo(0x1400, 2, 0x401, 255, {0x20030020});
    add_pdo(0x1800, 0, 0x181, 1, {0x20010120, 0x20010220});
    add_pdo(0x1800, 1, 0x281, 255, {0x20020008});
    add_pdo(0x1800, 2, 0x381, USE_PDO_RTR != 0 ? 253 : 254, {0x20030020});
    std::sort(table_.begin(), table_.end(),
              [](const CO_OBJ& left, const CO_OBJ& right) { return CO_GET_DEV(left.Key) < CO_GET_DEV(right.Key); });
    table_.push_back(CO_OBJ CO_OBJ_DICT_ENDMARK);
  }

  std::mutex lock_;
  std::mutex broken_mutex_;
  std::string broken_;  // rule that was violated
  std::atomic<bool> are_threads_running_ = false;
  std::thread::id mainline_;

  // Used with the node lock held
  Random frames_;
  std::uint32_t ticks_ = 0xFFFFFF00;
  std::uint32_t read_ = 0;  // frames
  std::uint64_t callbacks_ = 0;
  bool is_silent_ = false;
  bool ask_ = false;
  CO_IF_FRM sent_{};
  std::int16_t timer_ = -1;
  // Used by one thread only
  Random mainline_random_;
  Random real_time_random_;
  std::unique_ptr<std::uint8_t[]> memory_ = std::make_unique<std::uint8_t[]>(memory_size);

  std::uint8_t error_register_ = 0;
  std::uint8_t history_number_ = 0;
  std::uint32_t history_[2] = {};
  std::uint32_t sync_id_ = 0x40000080;
  std::uint32_t sync_cycle_ = 4000;
  std::uint32_t sync_window_ = 2000;
  std::uint32_t time_id_ = 0xC0000100;
  std::uint16_t heartbeat_ = 7;
  CO_HBCONS consumer_ = [] {
    CO_HBCONS consumer{};
    consumer.Time = 9;
    consumer.NodeId = 2;
    return consumer;
  }();
  std::uint32_t input_[2] = {0, ~0U};
  std::uint32_t output_[2] = {0, ~0U};
  std::uint8_t flagged_ = 0;
  std::uint32_t plain_ = 0;
  std::uint8_t domain_bytes_[300] = {};
  CO_OBJ_DOM domain_{0, sizeof domain_bytes_, domain_bytes_};
  CO_OBJ_STR name_{0, reinterpret_cast<const std::uint8_t*>("a device with two threads")};
  Group values_{};
  Group defaults_{};
  CO_PARA group_{0, sizeof(Group), &values_, &defaults_, CO_RESET_NODE, nullptr, CO_PARA___E, 0, 0};
  std::uint32_t pdo_ids_[6] = {};
  std::uint8_t pdo_types_[6] = {};
  std::uint16_t pdo_events_[6] = {};
  std::uint8_t client_[300] = {};

  std::vector<CO_OBJ> table_;
  std::unique_ptr<CO_IF_FRM[]> ring_memory_ = std::make_unique<CO_IF_FRM[]>(ring_size);
  std::unique_ptr<std::uint8_t[]> sdo_buffer_ = std::make_unique<std::uint8_t[]>(CO_SSDO_N * CO_SDO_BUF_BYTE);
  CO_TMR_MEM timers_[4] = {};
  CO_RING ring_{};
  CO_NODE_EXT ext_{};
  CO_NODE node_{};
};

TEST_CASE(
    "real time: with two threads, random frames and calls, the node lock is held and no frame is lost from the count") {
  for (std::uint32_t seed = 1; seed <= 8; seed += test::stride(2)) {
    CAPTURE(seed);
    ThreadedNode node(seed);
    node.run(1000, seed % 4);
    node.check();
  }
}

}  // namespace

#endif
