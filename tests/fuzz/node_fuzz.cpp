// SPDX-License-Identifier: Apache-2.0
// Fuzzes a whole node: random frames, time and calls, a controller that refuses frames, callbacks and type functions
// that call the stack, SDO clients with random answers, and an object dictionary that changes. The properties of
// invariants.hpp and of check() hold after each step, and the node answers after a reset.
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
#include "fuzz/fuzz.hpp"
#include "fuzz/node_network.hpp"
#include "fuzz/node_objects.hpp"
#include "support/invariants.hpp"

namespace {

using fuzz::Memory;
using fuzz::Objects;
using fuzz::require;

constexpr std::uint8_t first_node_id = 5;
constexpr std::uint16_t own_timers = 6;
constexpr std::uint32_t frequency = 1000;                                // ticks per second
constexpr std::uint32_t patience = 20 + 8 * ((CO_SDO_TIMEOUT + 7) / 8);  // ticks, longer than the time-out
constexpr unsigned max_depth = 3;                                        // nested calls of the stack

enum class TimerDriver { clock, clock_without_alarm, cyclic, delta };

class Bench;
Bench* bench = nullptr;  // current instance, for the callbacks

// Drivers -------------------------------------------------------------

// State of the timer under each kind of driver. The bench advances the time and calls the interrupt.
struct Clock {
  static constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

  std::uint64_t now = 0;
  std::uint64_t alarm = never;   // clock driver: the alarm; delta driver: the compare match
  std::uint32_t count_down = 0;  // cyclic driver
};

struct Bus {
  std::deque<CO_IF_FRM> to_node;
  bool is_on = false;
  unsigned refusals = 0;  // number of calls for which Send returns 0 ("not now") or -1 ("error")
  std::uint64_t sent = 0;
  CO_IF_FRM last{};
};

// A request of an SDO client. Its buffer is released in the callback, as the stack may not use it afterwards.
struct Request {
  bool is_open = false;
  std::uint32_t key = 0;
  Memory buffer;
};

class Bench {
 public:
  explicit Bench(fuzz::Input input) : input_(input) {
    bench = this;
    choose_configuration(input_.byte());
    table_ = fuzz::dictionary(objects_);
    end_of_table_ = table_.size();
    std::memset(static_cast<void*>(&node_), 0xA5, sizeof node_);  // the stack must not rely on zeroed memory
    init();
  }
  ~Bench() {
    CONodeStop(&node_);
    bench = nullptr;
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void run() {
    if (input_.flag()) {
      act(start_action);
    }
    network_.sign();
    while (!input_.is_empty()) {
      step();
      check();
    }
    recover();
  }

  // Called from callbacks and type functions: may execute an action on the node.
  void meddle() {
    const fuzz::Aside aside(input_);
    const std::uint8_t byte = input_.byte();
    if ((byte & 0x80U) != 0 && depth_ < max_depth) {
      act(byte);
    }
  }
  CO_ERR mood() {
    const fuzz::Aside aside(input_);
    meddle();
    return input_.below(8) == 7 ? CO_ERR_TYPE_WR : CO_ERR_NONE;
  }
  std::uint32_t chance(std::uint32_t limit) {
    const fuzz::Aside aside(input_);
    return input_.below(limit);
  }

  void lock() { require(!std::exchange(locked_, true), "locks do not nest"); }
  void unlock() { require(std::exchange(locked_, false), "a lock is given back once"); }
  void lock_objects() { require(!std::exchange(objects_locked_, true), "locks of the objects do not nest"); }
  void unlock_objects() { require(std::exchange(objects_locked_, false), "a lock of the objects is given back once"); }

 private:
  using Action = void (Bench::*)();
  static constexpr std::uint8_t start_action = 3;  // index of start() in act()

  // Set-up ---------------------------------------------------------------

  void choose_configuration(std::uint8_t bits) {
    timer_driver_ = static_cast<TimerDriver>(bits & 3U);
    objects_.cob_id[2] = (bits & 4U) != 0 ? 0x605 : 0x685;  // with 605h both servers have the same request COB-ID
    ext_.Size = sizeof ext_;
    ext_.TxQueue = (bits & 8U) != 0 ? queue_ : nullptr;
    ext_.TxQueueLen = (bits & 8U) != 0 ? 3 : 0;
    ext_.Writable = (bits & 16U) != 0 ? may_write : nullptr;
    has_context_ = (bits & 32U) != 0;
    ext_.Can = has_context_ ? &can_with_context : nullptr;
    if (timer_driver_ == TimerDriver::clock || timer_driver_ == TimerDriver::clock_without_alarm) {
      ext_.Timer = timer_driver_ == TimerDriver::clock ? &clock_with_alarm : &clock_alone;
    }
    drivers_.Timer = timer_driver_ == TimerDriver::delta ? &delta : &cyclic;
    if ((bits & 128U) != 0) {
      ext_.OdLock = [](void*) { bench->lock_objects(); };
      ext_.OdUnlock = [](void*) { bench->unlock_objects(); };
    }
    ext_.EmcyNum = fuzz::network_errors;
    sdo_buffer_ = (bits & 64U) != 0 ? std::make_unique<std::uint8_t[]>(CO_SSDO_N * CO_SDO_BUF_BYTE) : nullptr;
  }

  void init() {
    const auto length = static_cast<std::uint16_t>(table_.size());
    const CO_NODE_SPEC spec{first_node_id, 250000,     table_.data(), length,    fuzz::errors(),
                            timers_,       own_timers, frequency,     &drivers_, sdo_buffer_.get()};
    forget_requests();
    make_index();
    ++depth_;  // type functions may call the stack
    CONodeInitEx(&node_, &spec, &ext_);
    --depth_;
    for (std::int16_t& id : timer_ids_) {
      id = -1;
    }
    watch();
  }

  void make_index() {
#if USE_OD
    const auto length = static_cast<std::uint16_t>(table_.size());
    index_list_.resize(OD_LIST_N(table_.size()));
    const auto list_length = static_cast<std::uint16_t>(index_list_.size());
    require(OD_init(&index_, index_list_.data(), list_length, &node_, table_.data(), length) == ODR_OK,
            "the table has an index");
    if (ext_.Od == nullptr) {
      ext_.Od = &index_;
      require(OD_extension_init(OD_find(&index_, 0x2000), &fuzz::extension) == ODR_OK, "an object is extended");
    }
#endif
  }

  // Forgets open requests: an initialisation drops them without a callback.
  void forget_requests() {
    fuzz::source = {};
    for (Request& request : requests_) {
      request = {};
    }
  }

  void watch() {
    memory_ = {};
    for (std::size_t n = 0; n < end_of_table_; ++n) {
      memory_.add(table_[n]);
    }
  }

  // Actions ----------------------------------------------------------------

  void step() {
    const std::uint8_t kind = input_.byte();
    if (kind >= 0xA0) {
      act(kind);
    } else {
      receive(any_frame(kind));
    }
  }

  CO_IF_FRM any_frame(std::uint8_t kind) {
    constexpr std::uint32_t rtr = CO_IF_FRM_RTR;
    constexpr std::uint32_t identifiers[] = {
        0x605, 0x685, 0x000, 0x587, 0x705, 0x588,       0x605,       0x605,  //
        0x080, 0x080, 0x205, 0x305, 0x405, 0x505,       0x709,       0x100,  //
        0x70A, 0x089, 0x205, 0x305, 0x405, 0x705 | rtr, 0x185 | rtr, 0x385 | rtr,
    };
    CO_IF_FRM frame{};
    frame.Identifier = (kind & 0x18U) == 0x18U ? input_.number() : identifiers[kind & 0x1FU];
    if ((kind & 0x1FU) == 0x1FU) {
      return srdo_frame(frame.Identifier);
    }
    frame.DLC = (kind & 0x60U) == 0x60U ? input_.byte() : network_.usual_length(frame.Identifier);
    for (std::uint8_t& byte : frame.Data) {
      byte = input_.byte();
    }
    if ((kind & 0xE0U) == 0x40U) {
      name_object(frame);
    } else if ((kind & 0xE0U) == 0x60U) {
      fuzz::Network::name_object(frame);
    }
    return frame;
  }

  // Returns a frame for the SRDO that is received, the inverse one usually with the inverted data of the last plain
  // one, or a GFC.
  CO_IF_FRM srdo_frame(std::uint32_t bits) {
    constexpr std::uint32_t identifiers[] = {0x109, 0x10A, 0x109, 0x10A, 0x10B, 0x10C, 0x109, 0x001};
    CO_IF_FRM frame{identifiers[bits & 7U], {}, 0};
    frame.DLC =
        (bits & 0x70U) == 0x70U ? static_cast<std::uint8_t>(bits >> 8) : network_.usual_length(frame.Identifier);
    for (std::uint8_t& byte : frame.Data) {
      byte = input_.byte();
    }
    if (frame.Identifier == 0x10A && (bits & 8U) == 0) {
      std::transform(std::begin(plain_), std::end(plain_), std::begin(frame.Data),
                     [](std::uint8_t byte) { return static_cast<std::uint8_t>(~byte); });
    }
    std::copy(std::begin(frame.Data), std::end(frame.Data), plain_);
    return frame;
  }

  // Lets a request name an existing object; random indices would rarely do so.
  static void name_object(CO_IF_FRM& frame) {
    constexpr std::uint16_t indices[] = {0x2000, 0x2100, 0x2200, 0x1008, 0x1017, 0x1200,
                                         0x1201, 0x1202, 0x1280, 0x1281, 0x2100};
    CO_SET_WORD(&frame, indices[frame.Data[1] % std::size(indices)], 1);
    frame.Data[3] &= 15U;
  }

  // Receives a frame and checks which objects change: only those that it names, those of open downloads, and those of
  // PDOs.
  void receive(const CO_IF_FRM& frame) {
    bus_.to_node.assign(1, frame);
    memory_.remember();
    meddled_ = false;
    std::vector<std::uint32_t> may_change = open_transfers();
    may_change.push_back(CO_DEV(CO_GET_WORD(&frame, 1), frame.Data[3]));
    const bool may_be_pdo = network_.may_be_pdo(frame);
    const std::vector<std::uint32_t> mapped = may_be_pdo ? network_.written_by_pdos() : std::vector<std::uint32_t>{};
    const std::uint64_t sent = bus_.sent;
    const std::size_t waiting = node_.TxQueue.Num;
    fuzz::given = {frame.Identifier, frame.DLC, frame.Data, true};
    ++depth_;
    CONodeProcess(&node_);
    --depth_;
    if (meddled_) {
      return;
    }
    constexpr unsigned channels = CO_SSDO_N + CO_CSDO_N;
    constexpr unsigned answers = channels + CO_SDO_BLOCK_PACE + CO_TPDO_N + CO_EMCY_QUEUE_N + 2U;
    require(bus_.sent - sent <= waiting + answers, "a frame has a bounded number of answers");
    for (const std::uint32_t dev : memory_.changed()) {
      if (dev == CO_DEV(0x1001, 0)) {  // the stack itself writes it
        continue;
      }
      require(!memory_.is_read_only(dev), "what is read-only does not change");
      if (std::find(mapped.begin(), mapped.end(), dev) != mapped.end()) {
        continue;
      }
      const bool may = std::find(may_change.begin(), may_change.end(), dev) != may_change.end();
      require(may && frame.DLC >= 8, "an object changes by its download only");
    }
  }

  std::vector<std::uint32_t> open_transfers() const {
    std::vector<std::uint32_t> devs;
    for (const CO_SDO& server : node_.Sdo) {
      if (node_.Nmt.Mode != CO_INVALID && server.Flow.State != 0) {
        devs.push_back(server.Key);
      }
    }
    return devs;
  }

  // Replaces the extension of 2000h; open transfers of its sub-indices may lose their object.
  void change_extension() {
#if USE_OD
    OD_extension_t* const extension = input_.flag() ? &fuzz::extension : nullptr;
    OD_extension_init(OD_find(&index_, 0x2000), extension);
    fuzz::source.has_moved = true;
#endif
  }

  void act(std::uint8_t kind) {
    constexpr std::uint8_t rarely = 0xC0;
    constexpr Action actions[] = {
        &Bench::reset_node,     &Bench::set_mode,     &Bench::stop,         &Bench::start,
        &Bench::short_time,     &Bench::run_timers,   &Bench::process,      &Bench::create_timer,
        &Bench::delete_timer,   &Bench::delete_any,   &Bench::set_cob_id,   &Bench::set_heartbeat,
        &Bench::send,           &Bench::refuse,       &Bench::ask_deadline, &Bench::write_buffer,
        &Bench::read_buffer,    &Bench::report_event, &Bench::move_stream,  &Bench::use_value,
        &Bench::abort_transfer, &Bench::long_time,    &Bench::change_table, &Bench::change_length,
        &Bench::set_node_id,    &Bench::take_error,   &Bench::init_again,   &Bench::time_out,
        &Bench::request,        &Bench::cancel,       &Bench::set_client,   &Bench::send_segments,
    };
    ++depth_;
    meddled_ = true;
    fuzz::given.alone = false;
    if (kind >= 0xE0) {
      network_.act(kind);
    } else if (kind == rarely) {
      change_extension();
    } else {
      (this->*actions[(kind & 31U) % std::size(actions)])();
    }
    --depth_;
  }

  bool is_outermost() const { return depth_ == 1; }

  void reset_node() { CONmtReset(&node_.Nmt, input_.flag() ? CO_RESET_NODE : CO_RESET_COM); }
  void set_mode() { CONmtSetMode(&node_.Nmt, static_cast<CO_MODE>(input_.below(CO_MODE_NUM + 1))); }
  void stop() { CONodeStop(&node_); }
  void start() { CONodeStart(&node_); }
  void short_time() { pass(input_.byte()); }
  void long_time() { pass(input_.word() % 3000U); }
  void time_out() { pass(patience); }
  void run_timers() { COTmrProcess(&node_.Tmr); }
  void process() { CONodeProcess(&node_); }
  void create_timer() {
    const std::uint32_t start = input_.byte();
    const std::uint32_t cycle = input_.byte();
    const auto run = [](void* ctx) { static_cast<Bench*>(ctx)->meddle(); };
    timer_ids_[input_.below(std::size(timer_ids_))] = COTmrCreate(&node_.Tmr, start, cycle, run, this);
  }
  void delete_timer() { COTmrDelete(&node_.Tmr, timer_ids_[input_.below(std::size(timer_ids_))]); }
  void delete_any() { COTmrDelete(&node_.Tmr, static_cast<std::int16_t>(input_.word())); }
  void set_cob_id() {
    const std::uint32_t index = 0x1200 + input_.below(3);
    const std::uint32_t sub = 1 + input_.below(2);
    const std::uint32_t flags = (input_.flag() ? CO_SDO_ID_OFF : 0U) | (input_.flag() ? 0x20000000U : 0U);
    CODictWrLong(&node_.Dict, CO_DEV(index, sub), flags | 0x600U | input_.byte());
  }
  void set_heartbeat() { CODictWrWord(&node_.Dict, CO_DEV(0x1017, 0), input_.byte()); }
  // Sends an application frame with an identifier that no SDO server can have.
  void send() {
    CO_IF_FRM frame{0x101U + input_.below(64), {}, 8};
    COIfCanSend(&node_.If, &frame);
  }
  void refuse() { bus_.refusals = input_.byte() & 127U; }
  void ask_deadline() { CONodeNextDeadline(&node_); }
  void write_buffer() {
    const std::uint32_t sub = input_.below(6);
    std::vector<std::uint8_t> bytes(1 + input_.below(40), 0x41);
    CODictWrBuffer(&node_.Dict, CO_DEV(0x2100, sub), bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  }
  void read_buffer() {
    const std::uint32_t sub = input_.below(6);
    std::vector<std::uint8_t> bytes(1 + input_.below(64));
    CODictRdBuffer(&node_.Dict, CO_DEV(0x2100, sub), bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  }
  void report_event() { CONodeCanEvent(&node_, static_cast<CO_CAN_EVENT>(input_.below(CO_CAN_EVENT_NUM))); }
  void move_stream() {
    CO_OBJ* const obj = CODictFind(&node_.Dict, CO_DEV(0x2100, input_.below(6)));
    COObjReset(obj, &node_, input_.number());
  }
  void use_value() {
    std::uint32_t value = 0;
    CODictRdLong(&node_.Dict, CO_DEV(0x2200, input_.below(6)), &value);
    CODictWrLong(&node_.Dict, CO_DEV(0x2200, input_.below(6)), value);
  }
  void abort_transfer() {
    COObjTypeUserSDOAbort(CODictFind(&node_.Dict, CO_DEV(0x2200, input_.below(6))), &node_, input_.number());
  }
  void change_length() { objects_.text.Size = input_.below(20); }
  void set_node_id() { CONmtSetNodeId(&node_.Nmt, input_.byte()); }
  void take_error() { CONodeGetErr(&node_); }

  // SDO clients ------------------------------------------------------------

  void request() {
    constexpr std::uint16_t indices[] = {0x2000, 0x2100, 0x2200, 0x1008};
    const std::uint32_t number = input_.below(std::size(requests_));
    const std::uint32_t key = CO_DEV(indices[input_.below(std::size(indices))], input_.below(16));
    const std::uint32_t timeout = input_.byte();
    const std::uint8_t kind = input_.byte();
    const std::uint32_t size = (kind & 0x7FU) * ((kind & 3U) == 3U ? 16U : 1U);
    Memory buffer = std::make_unique<std::uint8_t[]>(size);
    const auto start = (kind & 0x80U) != 0 ? COCSdoRequestUpload : COCSdoRequestDownload;
    const CO_ERR err =
        start(COCSdoFind(&node_, static_cast<std::uint8_t>(number)), key, buffer.get(), size, on_end, timeout);
    if (err == CO_ERR_NONE) {
      require(!requests_[number].is_open, "a client has one transfer at a time");
      requests_[number] = {true, key, std::move(buffer)};
    }
  }

  void cancel() { cancel_client(input_.below(std::size(requests_))); }

  void cancel_client(std::uint32_t number) {
    if (node_.Nmt.Mode == CO_INVALID && node_.CSdo[number].Node == nullptr) {
      return;  // never initialised
    }
    const bool was_open = requests_[number].is_open;
    const unsigned before = ends_;
    const CO_ERR err = COCSdoCancel(&node_.CSdo[number]);
    require((err == CO_ERR_NONE) == was_open, "what is open can be cancelled");
    require(!was_open || ends_ > before, "the callback comes before COCSdoCancel() returns");
  }

  // Changes a COB-ID of a client, or the node-ID of its server, which may be this node.
  void set_client() {
    const std::uint32_t index = 0x1280 + input_.below(2);
    const std::uint32_t sub = 1 + input_.below(3);
    if (sub == 3) {
      CODictWrByte(&node_.Dict, CO_DEV(index, sub), static_cast<std::uint8_t>(4 + input_.below(5)));
    } else {
      const std::uint32_t flags = input_.flag() ? CO_SDO_ID_OFF : 0U;
      CODictWrLong(&node_.Dict, CO_DEV(index, sub), flags | ((sub == 1 ? 0x604U : 0x586U) + input_.below(4)));
    }
  }

  static void on_end(CO_CSDO* csdo, std::uint16_t index, std::uint8_t sub, std::uint32_t) {
    ++bench->ends_;
    Request& request = bench->requests_[csdo - bench->node_.CSdo];
    require(std::exchange(request.is_open, false), "a request has one callback");
    require(CO_DEV(index, sub) == request.key, "a callback names the object");
    request.buffer.reset();
    bench->meddle();
  }

  // Sends consecutive segments of a block; random frames would rarely fill a sub-block.
  void send_segments() {
    if (!is_outermost()) {
      return;
    }
    const std::uint8_t first = input_.byte();
    const std::uint8_t last = input_.byte() & 0x7FU;
    for (unsigned n = first & 0x7FU; n <= last; ++n) {
      bus_.to_node.assign(
          1, CO_IF_FRM{0x605, {static_cast<std::uint8_t>(n | (n == last ? first & 0x80U : 0U)), first}, 8});
      CONodeProcess(&node_);
    }
  }

  // Removes an entry of the table, or restores the table. Type functions must not do that.
  void change_table() {
    if (!is_outermost()) {
      return;
    }
    const bool takes = input_.flag() && end_of_table_ > 1;
    const std::size_t place = input_.byte() % end_of_table_;
    takes ? take_entry(place) : restore_table();
    const auto length = static_cast<std::uint16_t>(table_.size());
    require(CODictInit(&node_.Dict, &node_, table_.data(), length) >= 0, "the changed table is taken");
    fuzz::source.has_moved = true;
    if (input_.flag()) {
      make_index();
    }
    watch();
  }
  void take_entry(std::size_t place) {
    std::move(table_.begin() + static_cast<std::ptrdiff_t>(place) + 1, table_.end(),
              table_.begin() + static_cast<std::ptrdiff_t>(place));
    table_.back() = CO_OBJ CO_OBJ_DICT_ENDMARK;
    --end_of_table_;
  }
  void restore_table() {
    const std::vector<CO_OBJ> all = fuzz::dictionary(objects_);
    std::copy(all.begin(), all.end(), table_.begin());  // the address of the table does not change
    end_of_table_ = all.size();
  }

  void init_again() {
    if (is_outermost()) {
      init();
    }
  }

  // Time -------------------------------------------------------------------

  void pass(std::uint32_t ticks) {
    const std::uint64_t end = clock_.now + ticks;
    const unsigned turns = input_.byte();  // bit n % 8: the loop runs after interrupt n
    for (unsigned n = 0; clock_.now < end; ++n) {
      to_next_interrupt(end);
      if (is_outermost() && (turns >> n % 8U & 1U) != 0) {
        COTmrProcess(&node_.Tmr);
        CONodeProcess(&node_);
      }
    }
  }

  void to_next_interrupt(std::uint64_t end) {
    clock_.now = std::min(end, std::max(next_interrupt(), clock_.now + 1));
    interrupt();
  }

  std::uint64_t next_interrupt() {
    switch (timer_driver_) {
      case TimerDriver::cyclic: return clock_.now + 1;
      case TimerDriver::clock_without_alarm: return clock_.now + std::min(CONodeNextDeadline(&node_), frequency);
      default: return clock_.alarm;
    }
  }

  void interrupt() {
    const bool has_match = timer_driver_ == TimerDriver::clock || timer_driver_ == TimerDriver::delta;
    if (has_match && clock_.now < clock_.alarm) {
      return;
    }
    if (timer_driver_ == TimerDriver::clock) {
      clock_.alarm = Clock::never;
    }
    if (node_.Nmt.Mode != CO_INVALID) {
      COTmrService(&node_.Tmr);
    }
    if (timer_driver_ == TimerDriver::delta && clock_.alarm <= clock_.now) {
      clock_.alarm = Clock::never;
    }
  }

  // Properties to check ------------------------------------------------------

  void check() const {
    require(!locked_ && !objects_locked_, "no lock is left");
    require((node_.State & ~1) == 0 && node_.Pending == 0, "nothing is left to be done");
    require(node_.TxQueue.Num <= node_.TxQueue.Len, "the transmit queue fits its memory");
    require(node_.TxQueue.Fixed <= node_.TxQueue.Num, "no more frames are fixed than wait");
    require(node_.Routes.Start[CO_ROUTE_CLASS_N] <= CO_ROUTE_N, "the routes fit their memory");
    require(timers_in_list() <= most_timers, "no timer is in two lists");
    for (const CO_SDO& server : node_.Sdo) {
      require(server.Flow.State == 0 || server.Obj != nullptr || fuzz::source.has_moved,
              "an open transfer has an object, unless that has moved");
    }
    for (std::size_t n = 0; n < std::size(requests_) && node_.Nmt.Mode != CO_INVALID; ++n) {
      const bool is_busy = node_.CSdo[n].State == CO_CSDO_STATE_BUSY;
      require(is_busy == requests_[n].is_open, "a client is busy from the request to the callback");
    }
    const CO_NODE_COUNTERS counters = CONodeGetCounters(&node_);
    require(counters.Unclaimed <= counters.Received, "only what was received was unclaimed");
    require(counters.Malformed <= counters.Received, "a malformed frame is counted once");
  }

  static constexpr unsigned most_timers =
      own_timers + 3U + CO_CSDO_N + CO_RPDO_N + CO_TPDO_N + CO_SRDO_N +
      12U;  // heartbeat, servers, guarding, clients, PDOs, SRDOs; EMCY, SYNC, TIME, LED

  unsigned timers_in_list() const {
    unsigned number = 0;
    for (const CO_TMR_MEM* timer = node_.Tmr.First; timer != nullptr && number <= most_timers; timer = timer->Next) {
      ++number;
    }
    return number;
  }

  // Checks that the node recovers. The input is used up, so that callbacks do not act any more.
  void recover() {
    bus_.refusals = 0;
    for (std::uint32_t n = 0; n < std::size(requests_); ++n) {
      cancel_client(n);
    }
    forget_transfers();
    restore_table();
    network_.forget();
    objects_.cob_id[0] = 0x600;
    objects_.cob_id[1] = 0x580;
    objects_.cob_id[2] = objects_.cob_id[3] = CO_SDO_ID_OFF;
    if (node_.Nmt.Mode == CO_INVALID) {
      init();
    } else {
      CODictInit(&node_.Dict, &node_, table_.data(), static_cast<std::uint16_t>(table_.size()));
      CONmtReset(&node_.Nmt, CO_RESET_NODE);
    }
    CONodeStart(&node_);
    require(bus_.last.Identifier == 0x700U + node_.NodeId && bus_.last.DLC == 1, "a reset ends with the boot-up");
    ask();
    check();
  }

  void forget_transfers() {
    bus_.to_node.clear();
    fuzz::process(node_);      // sends frames that wait for the controller
    COTmrProcess(&node_.Tmr);  // processes timers that elapsed before the next interrupt
    const std::uint64_t end = clock_.now + patience;
    while (clock_.now < end) {
      to_next_interrupt(end);
      COTmrProcess(&node_.Tmr);
      CONodeProcess(&node_);
    }
    require(open_transfers().empty(), "a transfer ends by itself when its client is silent");
    require(node_.TxQueue.Num == 0 || node_.Nmt.Mode == CO_INIT, "frames do not wait without a reason");
  }

  void ask() {
    bus_.to_node.assign(1, CO_IF_FRM{0x600U + node_.NodeId, {0x40, 0x18, 0x10, 0x01}, 8});
    CONodeProcess(&node_);
    constexpr std::uint8_t answer[8] = {0x43, 0x18, 0x10, 0x01, 0x05, 0x00, 0x00, 0x00};
    require(bus_.last.Identifier == 0x580U + node_.NodeId, "a node that was reset answers");
    require(std::equal(std::begin(answer), std::end(answer), bus_.last.Data), "… and answers right");
  }

  // Returns the NMT state to check a frame against: a queued frame may belong to a previous state.
  CO_MODE mode_of(const CO_IF_FRM& frame) const {
    if (node_.TxQueue.Num == 0) {
      return node_.Nmt.Mode;
    }
    const bool is_stopped = frame.Identifier == 0x700U + node_.NodeId && frame.Data[0] == 0x04;
    const bool is_operational = frame.Identifier == 0x700U + node_.NodeId && frame.Data[0] == 0x05;
    return is_stopped ? CO_STOP : is_operational ? CO_OPERATIONAL : CO_PREOP;
  }

  bool is_answer(const CO_IF_FRM& frame) const {
    return (frame.Identifier >= 0x580 && frame.Identifier <= 0x5FF) ||
           std::any_of(std::begin(node_.Sdo), std::end(node_.Sdo),
                       [&](const CO_SDO& server) { return server.TxId == frame.Identifier; });
  }

  // Returns the frame without the toggle bit of an answer to node guarding. [301:7.2.8.3.2.1]
  CO_IF_FRM without_toggle(const CO_IF_FRM& frame) const {
    CO_IF_FRM plain = frame;
    if (frame.Identifier == 0x700U + node_.NodeId) {
      plain.Data[0] &= 0x7FU;
    }
    return plain;
  }

  // Returns the rule that a sent frame violates, or "". Segments of a block upload may have any content.
  std::string fault_of(const CO_IF_FRM& frame) {
    network_.look();
    if (network_.is_ours(frame)) {
      return network_.fault_of(frame);
    }
    const CO_MODE mode = mode_of(frame);
    const bool may_be_segment = std::any_of(std::begin(node_.Sdo), std::end(node_.Sdo), [&](const CO_SDO& server) {
      return server.TxId == frame.Identifier && server.Flow.State != 0;
    });
    const std::string fault = test::fault_of(frame, node_.NodeId, mode, is_answer(frame));
    return fault.empty() || !may_be_segment ? fault : test::fault_of(frame, node_.NodeId, mode, true, true);
  }

  std::int16_t take(const CO_IF_FRM& frame) {
    if (bus_.refusals > 0) {
      --bus_.refusals;
      const fuzz::Aside aside(input_);
      return input_.flag() ? std::int16_t{-1} : std::int16_t{0};
    }
    const std::string fault = fault_of(without_toggle(frame));
    require(fault.empty(), fault);
    require(bus_.is_on, "nothing is sent while off the bus");
    ++bus_.sent;
    bus_.last = frame;
    return sizeof frame;
  }

  std::int16_t give(CO_IF_FRM& frame) {
    if (bus_.to_node.empty()) {
      return 0;
    }
    frame = bus_.to_node.front();
    bus_.to_node.pop_front();
    return sizeof frame;
  }

  static bool may_write(void*, const void*, std::uint32_t) { return bench->chance(8) != 7; }

  static void can_off() { bench->bus_.is_on = false; }
  static void can_on(std::uint32_t) { bench->bus_.is_on = true; }
  static void can_reset() {}
  static std::int16_t can_read(CO_IF_FRM* frame) { return bench->give(*frame); }
  static std::int16_t can_send(CO_IF_FRM* frame) {
    const std::int16_t result = bench->take(*frame);
    std::memset(static_cast<void*>(frame), 0xFF, sizeof *frame);  // the driver may change the frame
    return result;
  }
  static std::int16_t can_take(void*, const CO_IF_FRM* frame) { return bench->take(*frame); }
  static constexpr CO_IF_CAN_DRV can = {can_off, can_on, can_read, can_send, can_reset, can_off};
  static constexpr CO_IF_CAN_DRV_EX can_with_context = {[](void*) { can_off(); },
                                                        [](void*, std::uint32_t baud) { can_on(baud); },
                                                        [](void*, CO_IF_FRM* frame) { return can_read(frame); },
                                                        can_take,
                                                        [](void*) { can_reset(); },
                                                        [](void*) { can_off(); },
                                                        [](void*, const std::uint32_t* ids, std::uint16_t number) {
                                                          require(std::is_sorted(ids, ids + number),
                                                                  "the filter is sorted");
                                                        },
                                                        CONodeCanReport};

  static void timer_init(std::uint32_t) {}
  static void timer_start() {}

  static void reload_count(std::uint32_t ticks) {
    require(ticks > 0, "a timer is never told to wait for nothing");
    bench->clock_.count_down = ticks;
  }
  static void stop_count() { bench->clock_.count_down = 0; }
  static std::uint32_t count_left() { return bench->clock_.count_down; }
  static std::uint8_t count() {
    std::uint32_t& left = bench->clock_.count_down;
    return left != 0 && --left == 0 ? 1 : 0;
  }
  static constexpr CO_IF_TIMER_DRV cyclic = {timer_init, reload_count, count_left, stop_count, timer_start, count};

  static void reload_match(std::uint32_t ticks) {
    require(ticks > 0, "a timer is never told to wait for nothing");
    bench->clock_.alarm = bench->clock_.now + ticks;
  }
  static void stop_match() { bench->clock_.alarm = Clock::never; }
  static std::uint32_t match_left() {
    const Clock& clock = bench->clock_;
    return clock.alarm == Clock::never || clock.alarm <= clock.now
               ? 0U
               : static_cast<std::uint32_t>(clock.alarm - clock.now);
  }
  static std::uint8_t matched() { return 1; }
  static constexpr CO_IF_TIMER_DRV delta = {timer_init, reload_match, match_left, stop_match, timer_start, matched};

  static std::uint32_t time_now(void*) { return static_cast<std::uint32_t>(bench->clock_.now + 0xFFFFFF00U); }
  static void set_alarm(void*, std::uint32_t ticks) {
    bench->clock_.alarm = ticks == 0 ? Clock::never : bench->clock_.now + ticks;
  }
  static constexpr CO_IF_TIMER_DRV_EX clock_with_alarm = {[](void*, std::uint32_t) {}, time_now, set_alarm};
  static constexpr CO_IF_TIMER_DRV_EX clock_alone = {[](void*, std::uint32_t) {}, time_now, nullptr};

  fuzz::Input input_;
  TimerDriver timer_driver_ = TimerDriver::clock;
  bool has_context_ = false;
  bool locked_ = false;
  bool objects_locked_ = false;
  bool meddled_ = false;  // an action has changed the node since the last frame
  unsigned depth_ = 0;
  Clock clock_;
  Bus bus_;
  Objects objects_;
  std::vector<CO_OBJ> table_;
  std::size_t end_of_table_ = 0;
#if USE_OD
  OD_t index_{};
  std::vector<OD_entry_t> index_list_;
#endif
  test::MemoryWatch memory_;
  Request requests_[2];
  unsigned ends_ = 0;  // callbacks of SDO clients so far
  Memory sdo_buffer_;
  std::uint8_t plain_[8] = {};  // data of the last frame of an SRDO
  std::int16_t timer_ids_[8] = {};
  CO_TMR_MEM timers_[own_timers] = {};
  CO_IF_FRM queue_[3] = {};
  CO_IF_DRV drivers_{&can, nullptr, nullptr};
  CO_NODE_EXT ext_{};
  CO_NODE node_;
  fuzz::Network network_{node_, objects_.network, input_};
};

}  // namespace

void fuzz::meddle() { bench->meddle(); }
CO_ERR fuzz::mood() { return bench->mood(); }
std::uint32_t fuzz::chance(std::uint32_t limit) { return bench->chance(limit); }

extern "C" {

void CONmtModeChange(CO_NMT*, CO_MODE) { bench->meddle(); }
void CONmtResetRequest(CO_NMT*, CO_NMT_RESET) { bench->meddle(); }
void COIfCanReceive(CO_IF_FRM* frame) {
  require(frame->DLC <= 8, "a frame of the bus has up to eight bytes");
  bench->meddle();
}
void CONodeCanChange(CO_NODE*, CO_CAN_EVENT) { bench->meddle(); }
void CONmtHbConsEvent(CO_NMT*, std::uint8_t) { bench->meddle(); }
void CONmtHbConsChange(CO_NMT*, std::uint8_t, CO_MODE) { bench->meddle(); }
void CONmtLifeGuardEvent(CO_NMT*, bool) { bench->meddle(); }
void COGfcReceived(CO_NODE*) { bench->meddle(); }
void COSrdoChange(CO_NODE* node, std::uint8_t number, CO_SRDO_STATE state) {
  require(COSrdoGetState(node, number) == state, "COSrdoChange() reports the present state");
  bench->meddle();
}
void COPdoTransmit(CO_IF_FRM*) { bench->meddle(); }
std::int16_t COPdoReceive(CO_IF_FRM*) { return bench->mood() == CO_ERR_NONE ? 0 : 1; }
void COPdoSyncUpdate(CO_RPDO*) { bench->meddle(); }
void COPdoUpdate(CO_RPDO*) { bench->meddle(); }
void COTimeUpdate(CO_NODE*, const CO_TIME_OF_DAY*) { bench->meddle(); }
void COLedChange(CO_NODE*, std::uint8_t) { bench->meddle(); }
void COEmcyReceived(CO_NODE*, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*) { bench->meddle(); }
void COTmrLock(void) { bench->lock(); }
void COTmrUnlock(void) { bench->unlock(); }
void CONodeFatalError(void) { require(false, "no fatal error"); }

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bench(fuzz::Input(data, size)).run();
  return 0;
}

}  // extern "C"
