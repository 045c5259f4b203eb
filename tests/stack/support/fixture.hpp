// SPDX-License-Identifier: Apache-2.0
/// \file fixture.hpp
/// A node on a virtual bus with a virtual clock, driven by frames in candump notation:
///
///     Fixture node;                                      // node-ID 1, Pre-operational, boot-up already received
///     node.rx("601#4000100000000000");                   // sends a frame to the node
///     node.tx("581#4300100091010F00");                   // expects exactly these frames since the last check
///     node.after(1000ms);  node.silent();
///
/// Every call checks the invariants (invariants.hpp).
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "block_client.hpp"
#include "callbacks.hpp"
#include "co_core.h"
#include "heap_watch.hpp"
#include "invariants.hpp"
#include "notation.hpp"
#include "sdo_observer.hpp"
#include "stride.hpp"

template <>
struct doctest::StringMaker<std::vector<std::string>> {
  static String convert(const std::vector<std::string>& lines) {
    std::string all;
    for (const std::string& line : lines) {
      all += (all.empty() ? "" : ", ") + line;
    }
    return ("[" + all + "]").c_str();
  }
};

namespace test {

using namespace std::chrono_literals;
using Time = std::chrono::microseconds;

/// Way in which the application's loop waits.
enum class Wake {
  alarm,       ///< until the alarm that the node has set
  deadline,    ///< until CONodeNextDeadline(); the driver has no alarm
  every_tick,  ///< polls at each tick of the clock
};

inline constexpr std::uint32_t mebibyte = 1U << 20;

/// Variables of a fixture's dictionary. Setup::dictionary() lists indexes and values.
struct Objects {
  std::uint8_t error_register = 0;
  std::uint16_t heartbeat = 0;
  CO_OBJ_STR device_name{0, reinterpret_cast<const std::uint8_t*>("Lexican test node")};
  CO_OBJ_STR version{0, reinterpret_cast<const std::uint8_t*>("1.0")};
  std::uint32_t sdo2_rx = 0x80000000;
  std::uint32_t sdo2_tx = 0x80000000;
  std::uint32_t sdo3_rx = 0x80000000;
  std::uint32_t sdo3_tx = 0x80000000;
  std::uint8_t u8 = 0x11;
  std::uint16_t u16 = 0x2211;
  std::uint32_t u24 = 0x332211;
  std::uint32_t u32 = 0x44332211;
  std::uint64_t u40 = 0x5544332211;
  std::uint64_t u48 = 0x665544332211;
  std::uint64_t u56 = 0x77665544332211;
  std::uint64_t u64 = 0x8877665544332211;
  std::uint8_t boolean = 0;
  float real32 = 1.0F;
  double real64 = 1.0;
  CO_TIME_OF_DAY time_of_day{0x01020304, 0x0506};
  std::uint32_t write_only = 0;
  std::uint32_t read_only = 0xCAFEBABE;
  std::uint32_t no_access = 0;
  std::uint32_t record = 0x01010101;
  std::map<std::uint32_t, Bytes> memory;       ///< memory of the domains, by size
  std::map<std::uint32_t, CO_OBJ_DOM> domain;  ///< by size
  std::uint8_t text_memory[16] = {'t', 'e', 'x', 't', 0};
  CO_OBJ_STR_RW text{0, 4, 16, text_memory};
  std::uint8_t octets_memory[10] = {1, 2, 3, 4, 5, 6};
  CO_OBJ_STR_RW octets{0, 6, 10, octets_memory};
  std::uint16_t unicode_memory[4] = {0x0041, 0x00E4, 0x20AC, 0};
  CO_OBJ_STR_RW unicode{0, 6, 8, reinterpret_cast<std::uint8_t*>(unicode_memory)};
};

/// Settings of a fixture. All have the defaults that most tests need.
class Setup {
 public:
  Setup& node_id(std::uint8_t id);
  Setup& rate(std::uint32_t ticks_per_second);
  Setup& clock(std::uint32_t start_tick);
  Setup& heartbeat(std::uint16_t ms);
  Setup& wake(Wake how);
  Setup& timers(std::uint16_t number);
  Setup& tx_queue(std::uint16_t frames);  ///< frames in separate memory, instead of CO_TX_QUEUE_N frames in the node
  Setup& stay_in_init();                  ///< the test calls CONodeStart()
  Setup& nmt_master();                    ///< the node may send NMT commands
  /// CO_NODE_SPEC.EmcyCode, and its length as CO_NODE_EXT.EmcyNum.
  Setup& emergencies(std::vector<CO_EMCY_TBL> table);
  Setup& with(CO_OBJ entry);  ///< adds an entry to the dictionary, or replaces it
  Setup& without(std::uint16_t index, std::uint8_t sub);
  Setup& ends_with(CO_OBJ end_mark);
  Setup& only_small();          ///< without the domains of more than 15 bytes: fast, for sweeps
  Setup& with_70000();          ///< a domain of that size: checking it after each frame takes time
  Setup& with_mebibyte();       ///< a domain of that size, which is not checked
  Setup& without_sdo_buffer();  ///< CO_NODE_SPEC.SdoBuf is null
  Setup& writable(std::function<bool(const void*, std::uint32_t)> may_write);
  Setup& nvm(const CO_IF_NVM_DRV_EX& driver, void* context);  ///< must outlive the fixture
  Setup& no_nvm();
  Setup& callbacks(const CO_CALLBACKS& table);  ///< CO_NODE_EXT.Callbacks; must outlive the fixture
#if USE_REAL_TIME
  Setup& turns();                ///< CO_NODE_EXT.Enter and Leave
  Setup& mainline(CO_RING& of);  ///< CO_NODE_EXT.Mainline; must outlive the fixture
  Setup& foreign();              ///< CO_NODE_EXT.Foreign
#endif
  Setup& may_change(std::uint16_t index, std::uint8_t sub);  ///< allows the node to write this object
  Setup& before_init(std::function<void(Objects&)> change);

 private:
  friend class Fixture;
  /// Returns the dictionary. Entries are read-only unless marked.
  /// 1000h 000F0191h, 1001h, 1008h device name, 100Ah "1.0", 1014h 80h + node-ID, 1017h (rw), 1018h,
  /// 1200h, 1201h and 1202h (rw, invalid) where the configuration has that many servers;
  /// 200wh (rw) a number of w bytes, 2020h BOOLEAN, 2024h REAL32, 2028h REAL64, 2026h TIME_OF_DAY;
  /// 2030h write-only, 2031h read-only, 2032h without any right, 2033h only sub 1, 2034h relative to the node-ID;
  /// 2100h:n domain of n bytes (0…9, 14, 15), 2101h of 889, 2103h of 888, 2104h of 890 bytes; 2102h with_70000(), 2105h
  /// with_mebibyte(); byte i holds i + 1 modulo 256;
  /// 2110h VISIBLE_STRING of 16, 2111h OCTET_STRING of 10, 2112h UNICODE_STRING of 8 bytes.
  std::vector<CO_OBJ> dictionary(Objects& objects) const;

  std::uint8_t node_id_ = 1;
  std::uint32_t rate_ = 1000;
  std::uint32_t clock_ = 0;
  std::uint16_t heartbeat_ = 0;
  Wake wake_ = Wake::alarm;
  std::uint16_t timers_ = 8;
  std::uint16_t tx_queue_ = 0;
  std::vector<CO_EMCY_TBL> emergencies_;
  bool start_ = true;
  bool nmt_master_ = false;
  bool large_domains_ = true;
  bool long_ = false;
  bool mebibyte_ = false;
  bool sdo_buffer_ = true;
  std::map<std::uint32_t, CO_OBJ> with_;
  std::vector<std::uint32_t> without_;
  CO_OBJ end_mark_ = CO_OBJ_DICT_ENDMARK;
  std::function<bool(const void*, std::uint32_t)> may_write_;
  std::function<void(Objects&)> before_init_;
  const CO_IF_NVM_DRV_EX* nvm_ = nullptr;
  void* nvm_context_ = nullptr;
  const CO_CALLBACKS* callbacks_ = nullptr;
  bool turns_ = false;
  CO_RING* mainline_ = nullptr;
  bool foreign_ = false;
  std::vector<std::pair<std::uint16_t, std::uint8_t>> may_change_ = {{0x1001, 0}};
};

/// A frame accepted by the driver, and its time.
struct Sent {
  CO_IF_FRM frm;
  std::uint64_t tick;  ///< since the construction of the fixture
};

/// Test side of the CAN driver, with fault injection.
struct FakeCan {
  std::deque<CO_IF_FRM> to_node;
  std::deque<Sent> sent;
  std::vector<std::uint32_t> filter;
  bool filter_off_bus = false;    ///< the first filter came before Enable
  std::uint64_t attempts = 0;     ///< calls of Send, from 1
  std::uint64_t refuse_from = 0;  ///< Send returns \a refusal for the attempts refuse_from … refuse_to-1
  std::uint64_t refuse_to = 0;
  std::int16_t refusal = 0;  ///< 0: busy, -1: error
  bool has_refused = false;
  std::int16_t read_result = 0;   ///< result of Read without a frame
  std::function<void()> on_read;  ///< called by Read
  unsigned init_calls = 0;
  unsigned resets = 0;
  unsigned closes = 0;
  std::uint32_t baud = 0;
  bool on_bus = false;

  void refuse_next(std::uint64_t number, std::int16_t with = 0);
  void refuse_nth(std::uint64_t number, std::int16_t with = 0);  ///< relative to now, 1 = the next attempt
  void refuse_all() { accept_next(0); }
  void accept_next(std::uint64_t number);  ///< later attempts are refused
  void accept_all() { refuse_to = 0; }
};

class Fixture {
 public:
  explicit Fixture(Setup setup = {});
  ~Fixture();
  Fixture(const Fixture&) = delete;
  Fixture& operator=(const Fixture&) = delete;

  /// Sends a frame to the node and runs the loop until the node is idle.
  void rx(std::string_view text, Where at = {__builtin_FILE(), __builtin_LINE()});
  void rx(const CO_IF_FRM& frm, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Checks that the node has sent exactly these frames, in this order, since the last check.
  void tx(std::string_view text, Where at = {__builtin_FILE(), __builtin_LINE()});
  void tx(std::initializer_list<std::string_view> all, Where at = {__builtin_FILE(), __builtin_LINE()});
  void silent(Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Calls rx() and tx().
  void ask(std::string_view request, std::string_view answer, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Checks that the next frame was sent at \a time after the begin of the last after() (rounded up to ticks).
  void tx_at(Time time, std::string_view text, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Returns the recorded frames and clears the record: "time in ms since the last after() began, frame".
  std::vector<std::string> trace();
  std::vector<std::string> frames();  ///< like trace(), without times

  void after(Time time, Where at = {__builtin_FILE(), __builtin_LINE()});  ///< lets time pass
  void jump(Time time, Where at = {__builtin_FILE(), __builtin_LINE()});   ///< lets time pass without running the loop
  /// Lets time pass with the timer interrupt, without the loop. \a elapsed: expected result of COTmrService().
  void elapse_only(Time time, std::int16_t elapsed = 1, Where at = {__builtin_FILE(), __builtin_LINE()});
  void idle(Time time);                       ///< lets time pass without loop and timer interrupt
  std::uint64_t ticks(Time time) const;       ///< rounded up
  std::uint64_t now() const { return now_; }  ///< ticks since the construction of the fixture

  /// Calls an API function on the node, with the checks.
  void call(const std::function<void()>& api, Where at = {__builtin_FILE(), __builtin_LINE()});
  void init_again(Where at = {__builtin_FILE(), __builtin_LINE()});  ///< repeats the first CONodeInitEx()
  void loop(Where at = {__builtin_FILE(), __builtin_LINE()});        ///< calls CONodeProcess() until the node is idle

  /// Reads an object as a client on server channel 1. Empty: aborted, or not conforming to the standard.
  Bytes upload(std::uint16_t index, std::uint8_t sub, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Writes an object likewise. Returns the abort code, 0: success.
  std::uint32_t download(std::uint16_t index, std::uint8_t sub, const Bytes& data, bool announced = true,
                         Where at = {__builtin_FILE(), __builtin_LINE()});

  /// Reads an object by block transfer (block_client.hpp).
  BlockResult block_upload(std::uint16_t index, std::uint8_t sub, const BlockOptions& options = {},
                           Where at = {__builtin_FILE(), __builtin_LINE()});
  BlockResult block_download(std::uint16_t index, std::uint8_t sub, const Bytes& data, const BlockOptions& options = {},
                             Where at = {__builtin_FILE(), __builtin_LINE()});

  /// Returns the longest time-out of the server. It counts in eighths, each rounded up to ticks.
  Time sdo_time_out() const { return std::chrono::milliseconds{CO_SDO_TIMEOUT} + 8 * Time{1000000 / setup_.rate_ + 1}; }

  void may_change(std::uint16_t index, std::uint8_t sub);  ///< outside of a download, until the end of the case
  /// Limits the frames sent per call; segments of block uploads are not counted.
  void frames_per_call(unsigned limit) { frames_per_call_ = limit; }
  /// Limits the calls of CONodeProcess() in rx() and loop(), while there is work.
  void calls(unsigned limit) { calls_ = limit; }
  static constexpr unsigned enough_calls = 200;  ///< without progress; more calls mean an endless loop
  /// Adds the memory of an entry whose type belongs to the test to the invariants.
  void watch(std::uint16_t index, std::uint8_t sub, const void* memory, std::size_t size, bool stream = false);

  CO_NODE_COUNTERS counters() const { return CONodeGetCounters(&node); }
  CO_ERR error() { return CONodeGetErr(&node); }
  CO_OBJ* find(std::uint16_t index, std::uint8_t sub);
  CO_MODE mode() const { return node.Nmt.Mode; }
  bool in_turn() const { return in_turn_; }  ///< between CO_NODE_EXT.Enter and Leave
  CO_NODE* operator->() { return &node; }

  /// Compares the protocol state with \a other: mode, servers, routes, queue, timers. Returns the difference, empty:
  /// none.
  std::string difference(const Fixture& other) const;
  unsigned armed_timers() const;

  Objects objects;
  FakeCan can;
  CO_NODE node;
#if USE_OD
  OD_t od{};  ///< index of the dictionary
#endif

 private:
  struct Drivers;
  friend struct Drivers;

  void init();
  void index();
  void process_frames();
  void wake_up(Where at);
  void run_until(std::uint64_t end, Where at);
  std::uint64_t next_wake() const;
  void check_properties(Where at);
  SdoObserver* channel(std::uint32_t CO_SDO::*id, std::uint32_t identifier);
  void observe_channels();
  void check_memory(Where at);
  std::vector<const CO_TMR_MEM*> armed() const;
  std::vector<std::string> timer_faults() const;
  void check_back_to_idle();
  std::string pop();

  Setup setup_;
  std::vector<CO_OBJ> dictionary_;
#if USE_OD
  std::vector<OD_entry_t> od_list_;
#endif
  std::vector<CO_TMR_MEM> timers_;
  std::vector<CO_IF_FRM> tx_queue_;
  Bytes sdo_buffer_;
  CO_NODE_EXT ext_{};
  MemoryWatch memory_;
  std::array<SdoObserver, CO_SSDO_N> channels_;
  std::uint64_t now_ = 0;
  std::uint64_t began_ = 0;
  static constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t alarm_ = never;
  std::uint64_t heap_before_ = 0;
  unsigned frames_per_call_ = 1;
  unsigned calls_ = enough_calls;  // in rx() and loop()
  bool od_locked_ = false;         // CO_NODE_EXT.OdLock has been called
  bool in_turn_ = false;           // CO_NODE_EXT.Enter has been called
  bool guarded_ = false;           // by a remote frame: answers have a toggle bit
  std::size_t segments_ = 0;       // sent segments of block uploads
  std::vector<std::string> violations_;
};

/// Start ticks at which 32-bit counters wrap or change sign soon.
inline constexpr std::uint32_t clock_starts[] = {0, 0x80000000U - 1000U, 0xFFFFFFFFU - 999U};
/// Ticks per second.
inline constexpr std::uint32_t clock_rates[] = {1000, 1000000, 300, 1024, 32768};

}  // namespace test
