// SPDX-License-Identifier: Apache-2.0
// Fuzzes API functions in callbacks: the input selects the frames that a node of the preset full receives, the time
// that passes, and for each call of a callback or type function the API functions that it calls, with their arguments.
// The dictionary uses all services. node_fuzz.cpp has more drivers, and properties of objects that must not change.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deque>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "co_core.h"
#include "fuzz/callbacks_objects.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/node_network.hpp"
#include "fuzz/node_objects.hpp"
#include "support/failing_nvm.hpp"
#include "support/invariants.hpp"

namespace {

using fuzz::Memory;
using fuzz::require;

constexpr std::uint8_t first_node_id = 5;
constexpr std::uint16_t own_timers = 4;
constexpr std::uint32_t frequency = 1000;  // ticks per second
constexpr unsigned max_depth = 4;          // nested API calls
constexpr unsigned max_calls = 500;        // API calls in callbacks for each input
constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

struct Request {
  bool is_open = false;
  std::uint32_t key = 0;
  Memory buffer;  // released in the callback: the stack may not use it afterwards
};

class Bench;
Bench* bench = nullptr;  // current instance, for the callbacks

class Bench {
 public:
  explicit Bench(fuzz::Input input) : input_(input) {
    bench = this;
    const std::uint8_t bits = input_.byte();
    static constexpr CO_IF_CAN_DRV_EX can = {[](void*) { bench->is_on_ = false; },
                                             [](void*, std::uint32_t) { bench->is_on_ = true; },
                                             [](void*, CO_IF_FRM* frame) { return bench->give(*frame); },
                                             [](void*, const CO_IF_FRM* frame) { return bench->take(*frame); },
                                             [](void*) {},
                                             [](void*) { bench->is_on_ = false; },
                                             nullptr,
                                             CONodeCanReport};
    static constexpr CO_IF_TIMER_DRV_EX timer = {
        [](void*, std::uint32_t) {}, [](void*) { return static_cast<std::uint32_t>(bench->now_); },
        [](void*, std::uint32_t ticks) { bench->alarm_ = ticks == 0 ? never : bench->now_ + ticks; }};
    ext_.Size = sizeof ext_;
    ext_.Can = &can;
    ext_.Timer = &timer;
    ext_.Nvm = &test::FailingNvm::driver;
    ext_.NvmCtx = &nvm_;
    ext_.EmcyNum = fuzz::network_errors;
    ext_.TxQueue = (bits & 1U) != 0 ? queue_ : nullptr;
    ext_.TxQueueLen = (bits & 1U) != 0 ? 3 : 0;
    if ((bits & 2U) != 0) {
      ext_.OdLock = [](void*) { require(!std::exchange(bench->objects_locked_, true), "OdLock does not nest"); };
      ext_.OdUnlock = [](void*) { require(std::exchange(bench->objects_locked_, false), "OdUnlock follows OdLock"); };
    }
    if ((bits & 4U) != 0) {
      ext_.Enter = [](void*) { require(!std::exchange(bench->locked_, true), "Enter does not nest"); };
      ext_.Leave = [](void*) { require(std::exchange(bench->locked_, false), "Leave follows Enter"); };
    }
    ext_.Callbacks = (bits & 8U) != 0 ? &fuzz::callbacks : nullptr;
    ext_.Writable = (bits & 16U) != 0 ? [](void*, const void*, std::uint32_t) { return bench->chance(16) != 15; }
                                      : static_cast<bool (*)(void*, const void*, std::uint32_t)>(nullptr);
    CORingInit(&mainline_, mainline_frames_, static_cast<std::uint16_t>(std::size(mainline_frames_)));
    ext_.Mainline = (bits & 64U) != 0 ? &mainline_ : nullptr;
    ext_.Foreign = (bits & 128U) != 0;
    all_ = fuzz::callbacks_dictionary(objects_, services_);
    full_ = other_ = all_;
    std::memset(static_cast<void*>(&node_), 0xA5, sizeof node_);
    is_quiet_ = (bits & 32U) == 0;
    with_lock([this] { init(); });
    is_quiet_ = false;
  }
  ~Bench() {
    with_lock([this] { CONodeStop(&node_); });
    check();
    bench = nullptr;
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void run() {
    with_lock([this] {
      CONodeStart(&node_);
      network_.sign();
    });
    while (!input_.is_empty()) {
      const std::uint8_t kind = input_.byte();
      kind < 0x80 ? receive(kind) : kind < 0xA0 ? pass(kind) : act(kind);
      check();
    }
    recover();
  }

  // Called by each callback. The first byte selects whether and which API function is called.
  void meddle() {
    const fuzz::Aside aside(input_);
    const std::uint8_t kind = is_quiet_ ? std::uint8_t{0} : input_.byte();
    if (kind >= 0xC0 && depth_ < max_depth && calls_ < max_calls) {
      act(kind);
    }
  }
  // Called by each type function: it must not replace the dictionary.
  CO_ERR type_function() {
    ++types_;
    meddle();
    --types_;
    return chance(8) == 7 ? CO_ERR_TYPE_WR : CO_ERR_NONE;
  }
  std::uint32_t chance(std::uint32_t limit) {
    const fuzz::Aside aside(input_);
    return input_.below(limit);
  }

 private:
  using Action = void (Bench::*)();

  std::uint8_t below(std::size_t limit) { return static_cast<std::uint8_t>(input_.below(limit)); }

  bool has_lock() const { return ext_.Enter != nullptr; }

  // The application holds the node lock in its calls, callbacks have it already.
  template <class Function>
  void with_lock(Function function) {
    const bool is_outermost = depth_++ == 0;
    if (is_outermost && has_lock()) {
      ext_.Enter(nullptr);
    }
    function();
    if (is_outermost && has_lock()) {
      ext_.Leave(nullptr);
    }
    --depth_;
  }
  // Calls a function that locks the node itself: not in callbacks if there is a lock.
  template <class Function>
  void unlocked(Function function) {
    if (depth_ == 0 || !has_lock()) {
      ++depth_;
      function();
      --depth_;
    }
  }

  void init() {
    const CO_NODE_SPEC spec{first_node_id, 250000,     full_.data(), length(full_), fuzz::errors(),
                            timers_,       own_timers, frequency,    nullptr,       sdo_buffer_};
    for (Request& request : requests_) {
      request = {};
    }
    lss_is_busy_ = false;
    fuzz::source = {};
    make_index(full_, full_.size());
    ext_.Od = &index_;
    CONodeInitEx(&node_, &spec, &ext_);
    OD_extension_init(OD_find(&index_, 0x2000), &fuzz::extension);
    std::fill(std::begin(timer_ids_), std::end(timer_ids_), std::int16_t{-1});
  }
  static std::uint16_t length(const std::vector<CO_OBJ>& table) { return static_cast<std::uint16_t>(table.size()); }

  void make_index(std::vector<CO_OBJ>& table, std::size_t size) {
    const auto list_length = static_cast<std::uint16_t>(std::size(index_list_));
    const ODR_t result =
        OD_init(&index_, index_list_, list_length, &node_, table.data(), static_cast<std::uint16_t>(size));
    require(result == ODR_OK, "the table has an index");
  }

  // Steps -------------------------------------------------------------------

  void receive(std::uint8_t kind) {
    constexpr std::uint32_t rtr = CO_IF_FRM_RTR;
    constexpr std::uint32_t identifiers[] = {0x605, 0x605, 0x605, 0x685,       0x000,       0x080, 0x080, 0x205,
                                             0x305, 0x405, 0x505, 0x705 | rtr, 0x185 | rtr, 0x709, 0x100, 0x089,
                                             0x587, 0x588, 0x7E5, 0x7E4,       0x001,       0x109, 0x10A, 0x000};
    CO_IF_FRM frame{};
    frame.Identifier = kind < 0x60 ? identifiers[kind % std::size(identifiers)] : input_.number();
    const std::uint32_t id = frame.Identifier;
    frame.DLC = kind >= 0x60 ? below(9) : network_.usual_length(id);
    for (std::uint8_t& byte : frame.Data) {
      byte = id == 0x10A ? static_cast<std::uint8_t>(~last_[&byte - frame.Data]) : input_.byte();
    }
    std::copy(std::begin(frame.Data), std::end(frame.Data), last_);
    if (id == 0x605) {
      set_multiplexer(frame, key_of(CO_GET_WORD(&frame, 1)));
    } else if (id == 0x587 || id == 0x588) {
      set_multiplexer(frame, requests_[id - 0x587].key);
    } else if (id == 0x7E4 && (frame.Data[0] & 1U) != 0) {
      frame.Data[0] = node_.Lssm.Answer;
    } else if (id == 0 && kind < 0x60) {
      constexpr std::uint8_t commands[] = {1, 2, 128, 129, 130};
      frame.Data[0] = commands[frame.Data[0] % std::size(commands)];
      frame.Data[1] = 0;
    }
    to_node_.push_back(frame);
    if (kind / std::size(identifiers) != 3 || to_node_.size() > 3) {  // else CONodeProcess() in a callback may read it
      process();
    }
  }
  static void set_multiplexer(CO_IF_FRM& frame, std::uint32_t key) {
    CO_SET_WORD(&frame, CO_GET_IDX(key), 1);
    frame.Data[3] = static_cast<std::uint8_t>(CO_GET_SUB(key));
  }

  void pass(std::uint8_t kind) {
    const std::uint64_t end = now_ + ((kind & 1U) != 0 ? input_.byte() : input_.byte() % 8U);
    while (now_ < end) {
      now_ = std::min(end, std::max(alarm_, now_ + 1));
      interrupt();
      process();
      run_timers();
    }
  }
  void interrupt() {
    if (alarm_ <= now_) {
      alarm_ = never;
      if (CONmtGetMode(&node_.Nmt) != CO_INVALID) {
        COTmrService(&node_.Tmr);
      }
    }
  }

  // API functions -------------------------------------------------------------

  void act(std::uint8_t kind) {
    constexpr Action actions[] = {&Bench::reset,         &Bench::set_mode,        &Bench::stop,
                                  &Bench::start,         &Bench::react,           &Bench::create_timer,
                                  &Bench::delete_timer,  &Bench::set_node_id,     &Bench::report_event,
                                  &Bench::replace_table, &Bench::request,         &Bench::cancel,
                                  &Bench::use_srdo,      &Bench::send_gfc,        &Bench::use_lss_master,
                                  &Bench::record,        &Bench::use_groups,      &Bench::use_od,
                                  &Bench::write_any,     &Bench::read_any,        &Bench::use_object,
                                  &Bench::send_mpdo,     &Bench::use_commands,    &Bench::send,
                                  &Bench::ask,           &Bench::refuse,          &Bench::replace_table,
                                  &Bench::write_any,     &Bench::change_extension};
    ++calls_;
    const std::uint8_t number = kind & 0x3FU;
    switch (number) {
      case 0x3F: process(); return;
      case 0x3E: run_timers(); return;
      case 0x3D: unlocked([this] { CONodeNextDeadline(&node_); }); return;
      case 0x3C: ++now_, interrupt(); return;
    }
    with_lock([&] {
      if (number < std::size(actions)) {
        (this->*actions[number])();
      } else {
        number == 0x3B   ? use_pdo_flags()
        : number == 0x3A ? use_value()
                         : network_.act(static_cast<std::uint8_t>(number - std::size(actions)));
      }
    });
  }

  void process() {
    if (depth_ == 0) {  // callbacks must not call CONodeRealTime()
      unlocked([this] { CONodeRealTime(&node_); });
    }
    unlocked([this] { CONodeProcess(&node_); });
  }
  void run_timers() {
    unlocked([this] { COTmrProcess(&node_.Tmr); });
  }
  void reset() { CONmtReset(&node_.Nmt, input_.flag() ? CO_RESET_NODE : CO_RESET_COM); }
  void set_mode() { CONmtSetMode(&node_.Nmt, static_cast<CO_MODE>(below(CO_MODE_NUM + 1))); }
  void stop() { CONodeStop(&node_); }
  void start() { CONodeStart(&node_); }
  void react() { COErrorBehaviour(&node_, below(4)); }
  void create_timer() {
    const std::uint32_t first = below(16);
    const std::uint32_t cycle = below(16);
    const auto run = [](void* ctx) { static_cast<Bench*>(ctx)->meddle(); };
    timer_ids_[below(std::size(timer_ids_))] = COTmrCreate(&node_.Tmr, first, cycle, run, this);
  }
  void delete_timer() { COTmrDelete(&node_.Tmr, timer_ids_[below(std::size(timer_ids_))]); }
  void set_node_id() { CONmtSetNodeId(&node_.Nmt, input_.flag() ? first_node_id : input_.byte()); }
  void report_event() { CONodeCanEvent(&node_, static_cast<CO_CAN_EVENT>(below(CO_CAN_EVENT_NUM))); }
  void send() {
    CO_IF_FRM frame{0x111U + below(64), {}, 8};
    COIfCanSend(&node_.If, &frame);
  }
  void refuse() { refusals_ = input_.byte() & 31U; }
  void ask() {
    CONodeGetErr(&node_);
    CONodeGetErrKey(&node_);
    CONodeSetStatus(&node_, input_.byte());
    CONodeGetStatus(&node_);
    CONodeGetCounters(&node_);
    CODictGetFault(&node_.Dict, nullptr);
    COCSdoGetTotal(node_.CSdo);
    COCSdoGetNum(node_.CSdo);
  }
  void send_gfc() { network_.send_gfc(); }
  void use_srdo() { network_.use_srdo(); }
  void send_mpdo() {
    const std::uint8_t to = below(8);
    COTPdoSendTo(&node_, below(4), to, any_key(), input_.byte());
  }

  // Replaces the table, or changes it at its place.
  void replace_table() {
    if ((node_.State & 2) != 0) {  // the node works
      const auto all = static_cast<std::uint16_t>(full_.size());
      require(CODictInit(&node_.Dict, &node_, full_.data(), all) == -1, "no table is replaced while the node works");
      return;
    }
    const unsigned how = below(7);
    const std::size_t place = input_.word() % all_.size();
    if (types_ != 0) {
      return;
    }
    const std::uint32_t dev = CO_GET_DEV(all_[place].Key);
    std::size_t number = 0;
    other_ = all_;
    const auto is_dropped = [&](const CO_OBJ& entry) {
      switch (how) {
        case 1: return CO_GET_DEV(entry.Key) == dev;
        case 2: return CO_GET_IDX(entry.Key) == CO_GET_IDX(dev);
        case 3: return CO_GET_DEV(entry.Key) > dev;
        case 4: return number++ % 2 == place % 2;
        case 5: return CO_GET_IDX(entry.Key) >> 8 == CO_GET_IDX(dev) >> 8;
        default: return false;
      }
    };
    const auto end = std::remove_if(other_.begin(), other_.end(), is_dropped);
    const auto size = static_cast<std::size_t>(end - other_.begin());
    if (how == 6) {
      std::swap(other_.front(), other_.back());
    }
    std::vector<CO_OBJ>& table = how == 0 ? full_ : other_;
    fuzz::source.has_moved = true;
    const std::uint16_t replacement = ++replacements_;
    const int result = CODictInit(&node_.Dict, &node_, table.data(), static_cast<std::uint16_t>(size));
    require(how == 6 || size == 0 || result >= 0 || node_.Nmt.Mode == CO_INVALID, "a sorted table is accepted");
    if (how != 6 && size != 0 && below(8) != 7 && replacement == replacements_) {
      make_index(table, size);
    }
  }

  void change_extension() {
    fuzz::source.has_moved = true;
    OD_extension_init(OD_find(&index_, 0x2000), input_.flag() ? &fuzz::extension : nullptr);
  }

  std::uint32_t key_of(std::uint32_t number) const { return CO_GET_DEV(all_[number % all_.size()].Key); }
  // Returns a key for the API: not the one of the source, whose Begin and End expect one transfer at a time.
  std::uint32_t any_key() {
    const std::uint32_t dev = key_of(input_.word());
    return dev == CO_DEV(0x2200, 7) ? CO_DEV(0x2000, 0) : dev;
  }
  std::uint32_t any_value() {
    constexpr std::uint32_t values[] = {0,     1,     2,          255,        0x65766173, 0x64616F6C,
                                        0x205, 0x185, 0x80000205, 0x80000185, 0x20000008, 0x22000020};
    const std::uint8_t what = input_.byte();
    return what < 0x40 ? values[what % std::size(values)] : what < 0xC0 ? what & 0x1FU : input_.number();
  }
  void write_any() {
    const std::uint32_t dev = any_key();
    const std::uint32_t value = any_value();
    std::uint8_t bytes[fuzz::long_value] = {};
    switch (COObjGetSize(CODictFind(&node_.Dict, dev), &node_, 0)) {
      case 1: CODictWrByte(&node_.Dict, dev, static_cast<std::uint8_t>(value)); break;
      case 2: CODictWrWord(&node_.Dict, dev, static_cast<std::uint16_t>(value)); break;
      case 4: CODictWrLong(&node_.Dict, dev, value); break;
      default: CODictWrBuffer(&node_.Dict, dev, bytes, 1 + value % fuzz::long_value); break;
    }
  }
  void read_any() {
    const std::uint32_t dev = any_key();
    const std::uint32_t size = 1 + below(fuzz::long_value);
    const Memory bytes = std::make_unique<std::uint8_t[]>(size);
    CODictRdBuffer(&node_.Dict, dev, bytes.get(), size);
  }
  void use_object() {
    CO_OBJ* const obj = CODictFind(&node_.Dict, any_key());
    const std::uint32_t size = 1 + below(8);
    std::uint8_t bytes[8] = {};
    switch (below(8)) {
      case 0: COObjInit(obj, &node_); break;
      case 1: COObjReset(obj, &node_, input_.byte()); break;
      case 2: COObjRdBufStart(obj, &node_, bytes, size); break;
      case 3: COObjRdBufCont(obj, &node_, bytes, size); break;
      case 4: COObjWrBufStart(obj, &node_, bytes, size); break;
      case 5: COObjWrBufCont(obj, &node_, bytes, size); break;
      case 6: COObjTypeUserSDOAbort(obj, &node_, input_.number()); break;
      default: CODictObjInit(&node_.Dict, &node_); break;
    }
  }
  void use_od() {
    OD_entry_t* const entry = OD_find(&index_, CO_GET_IDX(any_key()));
    const std::uint8_t sub = below(16);
    const OD_size_t size = 1 + below(8);
    const bool is_original = input_.flag();
    std::uint8_t bytes[8] = {};
    OD_size_t number = 0;
    OD_IO_t io{};
    if (OD_getIndex(entry) == 0x2200) {
      return;  // see any_key()
    }
    switch (below(8)) {
      case 0: OD_get_value(entry, sub, bytes, size, is_original); break;
      case 1: OD_set_value(entry, sub, bytes, size, is_original); break;
      case 2: OD_requestTPDO(entry, sub); break;
      case 3: OD_TPDOtransmitted(entry, sub); break;
      case 4: OD_storeGroup(&index_, std::uint8_t(sub & 3U)); break;
      case 5: OD_restoreGroup(&index_, std::uint8_t(sub & 3U)); break;
      case 6: OD_getPtr(entry, sub, size, nullptr); break;
      default:
        if (OD_getSub(entry, sub, &io, is_original) == ODR_OK) {
          const std::uint16_t changes = replacements_;
          io.read(&io.stream, bytes, size, &number);
          if (changes == replacements_) {  // else the stream is invalid
            io.write(&io.stream, bytes, size, &number);
          }
        }
    }
  }

  void use_pdo_flags() {
    OD_entry_t* const entry = OD_find(&index_, CO_GET_IDX(any_key()));
    const std::uint8_t sub = below(16);
    OD_clearFlagsPDO(entry, sub, OD_getFlagsPDO(entry, sub) | input_.byte());
    OD_getStorageName(&index_, OD_getStorageGroup(entry, sub));
    OD_findStorageGroup(&index_, "group");
  }
  void use_value() {
    const std::uint32_t dev = any_key();
    CO_OBJ* const obj = CODictFind(&node_.Dict, dev);
    const auto size = static_cast<std::uint8_t>(std::min(COObjGetSize(obj, &node_, 8), std::uint32_t{8}));
    std::uint32_t number = below(256);
    std::uint16_t word = 0;
    CO_IF_FRM frame{};
    switch (below(8)) {
      case 0: COObjRdValue(obj, &node_, frame.Data, size); break;
      case 1: COObjWrValue(obj, &node_, &number, std::min(size, std::uint8_t{4})); break;
      case 2: CODictRdByte(&node_.Dict, dev, frame.Data); break;
      case 3: CODictRdWord(&node_.Dict, dev, &word); break;
      case 4: CODictRdLong(&node_.Dict, dev, &number); break;
      case 5: COLssNvmLoad(&node_, 384, &number, frame.Data); break;
      case 6: COIfNvmRead(&node_.If, number, frame.Data, size); break;
      default: COIfCanReset(&node_.If), COIfCanRead(&node_.If, &frame); break;
    }
  }

  // Services --------------------------------------------------------------------

  void request() {
    const std::uint32_t number = below(std::size(requests_));
    const std::uint32_t key = key_of(input_.word());
    const std::uint32_t size = 1 + input_.byte();
    const auto start = input_.flag() ? COCSdoRequestUpload : COCSdoRequestDownload;
    Memory buffer = std::make_unique<std::uint8_t[]>(size);
    CO_CSDO* const client = COCSdoFind(&node_, static_cast<std::uint8_t>(number));
    if (start(client, key, buffer.get(), size, on_end, input_.byte()) == CO_ERR_NONE) {
      require(!requests_[number].is_open, "a client has one transfer at a time");
      requests_[number] = {true, key, std::move(buffer)};
    }
  }
  static void on_end(CO_CSDO* client, std::uint16_t index, std::uint8_t sub, std::uint32_t) {
    Request& request = bench->requests_[client - bench->node_.CSdo];
    require(std::exchange(request.is_open, false), "a request has one callback");
    require(CO_DEV(index, sub) == request.key, "a callback names the object");
    request.buffer.reset();
    bench->meddle();
  }
  void cancel() { COCSdoCancel(COCSdoFind(&node_, below(std::size(requests_)))); }

  void use_lss_master() {
    CO_LSSM* const master = &node_.Lssm;
    const std::uint32_t numbers[6] = {0x191, 0, 0, 0, 0, 0};
    const std::uint32_t what = below(16);
    const auto call = [&] {
      switch (what) {
        case 0: return COLssmSwitchGlobal(master, below(2), on_lss);
        case 1: return COLssmSwitchSelective(master, numbers, on_lss);
        case 2: return COLssmConfigureNodeId(master, input_.byte(), on_lss);
        case 3: return COLssmConfigureBitTiming(master, 125000, on_lss);
        case 4: return COLssmActivateBitTiming(master, input_.byte(), input_.flag() ? 125000 : 0, on_lss);
        case 5: return COLssmStore(master, on_lss);
        case 6: return COLssmInquire(master, below(4), on_lss);
        case 7: return COLssmInquireNodeId(master, on_lss);
        case 8: return COLssmIdentify(master, numbers, on_lss);
        case 9: return COLssmIdentifyUnconfigured(master, on_lss);
        default: return COLssmFastscan(master, numbers, below(5), on_lss);
      }
    };
    if (what == 15) {
      COLssmSetTimes(master, input_.byte(), input_.byte());
    } else if (what >= 13) {
      COLssmCancel(master);
    } else if (call() == CO_ERR_NONE) {
      require(!std::exchange(lss_is_busy_, true), "the LSS master has one service at a time");
    }
  }
  static void on_lss(CO_LSSM*, CO_LSSM_RESULT) {
    require(std::exchange(bench->lss_is_busy_, false), "an LSS service has one callback");
    bench->meddle();
  }

  void record() {
    CO_RECORDER* const recorder = &services_.recorder[below(2)];
    CO_RECORDER_CONFIG config = recorder->Config;
    CO_RECORDER_POINT point{};
    switch (below(6)) {
      case 0: CORecorderStart(&node_, recorder); break;
      case 1:
        config.Map = input_.flag() ? CO_LINK(0x2200, 0, 32) : CO_LINK(0x2000, 0, 8);
        config.Trigger = below(4);
        CORecorderConfigure(recorder, &config);
        break;
      case 2: CORecorderSample(recorder); break;
      case 3: CORecorderClear(recorder); break;
      default: CORecorderGet(recorder, CORecorderCount(recorder) - 1, &point); break;
    }
  }
  void use_groups() {
    const CO_PARA* const group = &services_.group[below(2)];
    switch (below(6)) {
      case 2: COParaRestore(group, &node_); break;
      case 3: CONodeParaLoad(&node_, input_.flag() ? CO_RESET_NODE : CO_RESET_COM); break;
      case 4: COLssNvmStore(&node_, 384, 125000, input_.byte()); break;
      case 5: nvm_.is_off = input_.flag(); break;
      default: COParaStore(group, &node_); break;
    }
  }
  void use_commands() {
    const std::uint8_t text[] = "text";
    switch (below(3)) {
      case 0: COOsReply(&services_.command, text, sizeof text); break;
      case 1: COOsEnd(&node_, &services_.command, input_.flag()); break;
      default: COOsPrint(&node_, static_cast<std::uint8_t>(2 + below(2)), text, sizeof text); break;
    }
  }

  // Properties ------------------------------------------------------------------

  void check() const {
    require(!locked_ && !objects_locked_, "no lock is left");
    require(depth_ == 0 && types_ == 0, "all functions have returned");
    require((node_.State & ~1) == 0 && (node_.Pending == 0 || ext_.Mainline != nullptr), "no deferred work is left");
    require(node_.TxQueue.Num <= node_.TxQueue.Len, "the transmit queue fits its memory");
    require(node_.TxQueue.Fixed <= node_.TxQueue.Num, "no more frames are fixed than queued");
    require(node_.Routes.Start[CO_ROUTE_CLASS_N] <= CO_ROUTE_N, "the routes fit their memory");
    unsigned timers = 0;
    for (const CO_TMR_MEM* timer = node_.Tmr.First; timer != nullptr; timer = timer->Next) {
      require(++timers < 100, "the list of timers has an end");
    }
    for (std::size_t n = 0; n < std::size(requests_); ++n) {
      require((node_.CSdo[n].State == CO_CSDO_STATE_BUSY) == requests_[n].is_open, "a busy client has an open request");
    }
    require((node_.Lssm.State != 0) == lss_is_busy_, "a busy LSS master has an open service");
    require(!nvm_.misused, "accesses to the non-volatile memory fit its geometry");
  }

  // Initialises the node again: it boots and answers. The input is used up, so that callbacks do not call the API.
  void recover() {
    refusals_ = 0;
    to_node_.clear();
    nvm_.power_up();
    with_lock([this] {
      CONodeStop(&node_);
      init();
      CONodeStart(&node_);
    });
    require(node_.Nmt.Mode != CO_INIT && node_.NodeId == first_node_id, "the node boots");
    require(node_.Nmt.Mode != CO_OPERATIONAL || (objects_.network.startup & CO_NMT_STARTUP_STAY) == 0,
            "only a node with self-start enters Operational");
    check();
  }

  // Returns the rule that a frame violates, or "". A queued frame may belong to another state: its form is checked.
  std::string fault_of(CO_IF_FRM frame) {
    network_.look();
    if (network_.is_ours(frame)) {
      return network_.fault_of(frame);
    }
    const bool is_answer = std::any_of(std::begin(node_.Sdo), std::end(node_.Sdo),
                                       [&](const CO_SDO& server) { return server.TxId == frame.Identifier; });
    if (is_answer || node_.TxQueue.Num != 0) {
      const bool is_clean = frame.DLC <= 8 && std::all_of(frame.Data + frame.DLC, std::end(frame.Data),
                                                          [](std::uint8_t byte) { return byte == 0; });
      return is_clean && (!is_answer || frame.DLC == 8) ? "" : "length, or bytes beyond the DLC not 0";
    }
    if (frame.Identifier == 0x700U + CONmtGetNodeId(&node_.Nmt)) {
      frame.Data[0] &= 0x7FU;  // toggle bit of node guarding
    }
    return test::fault_of(frame, node_.NodeId, node_.Nmt.Mode, false);
  }

  // Drivers -----------------------------------------------------------------------

  std::int16_t take(const CO_IF_FRM& frame) {
    if (refusals_ > 0) {
      --refusals_;
      return (refusals_ & 1U) != 0 ? std::int16_t{-1} : std::int16_t{0};
    }
    const std::string fault = fault_of(frame);
    require(fault.empty(), fault);
    require(is_on_, "nothing is sent while off the bus");
    return sizeof frame;
  }
  std::int16_t give(CO_IF_FRM& frame) {
    if (to_node_.empty()) {
      return 0;
    }
    frame = to_node_.front();
    to_node_.pop_front();
    return sizeof frame;
  }
  fuzz::Input input_;
  bool locked_ = false;
  bool objects_locked_ = false;
  bool is_on_ = false;
  bool is_quiet_ = false;  // callbacks call no API functions
  bool lss_is_busy_ = false;
  unsigned depth_ = 0;  // nested API calls
  unsigned types_ = 0;  // nested type functions
  unsigned calls_ = 0;
  unsigned refusals_ = 0;  // calls of Send to be refused
  std::uint16_t replacements_ = 0;
  std::uint64_t now_ = 0;
  std::uint64_t alarm_ = never;
  std::uint8_t last_[8] = {};  // data of the last frame
  std::deque<CO_IF_FRM> to_node_;
  fuzz::Objects objects_;
  fuzz::ServiceObjects services_;
  test::FailingNvm nvm_{{512, 4, 16}};
  std::vector<CO_OBJ> all_;
  std::vector<CO_OBJ> full_;   // table with all entries
  std::vector<CO_OBJ> other_;  // table with fewer entries, changed at its place
  OD_t index_{};
  OD_entry_t index_list_[OD_LIST_N(256)] = {};
  Request requests_[2];
  std::int16_t timer_ids_[4] = {};
  CO_TMR_MEM timers_[own_timers] = {};
  CO_IF_FRM queue_[3] = {};
  CO_IF_FRM mainline_frames_[3] = {};
  CO_RING mainline_{};
  std::uint8_t sdo_buffer_[CO_SSDO_N * CO_SDO_BUF_BYTE] = {};
  CO_NODE_EXT ext_{};
  CO_NODE node_;
  fuzz::Network network_{node_, objects_.network, input_};
};

}  // namespace

void fuzz::call_api() { bench->meddle(); }
void fuzz::meddle() { bench->type_function(); }
CO_ERR fuzz::mood() { return bench->type_function(); }
std::uint32_t fuzz::chance(std::uint32_t limit) { return bench->chance(limit); }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bench(fuzz::Input(data, size)).run();
  return 0;
}
