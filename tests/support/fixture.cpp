// SPDX-License-Identifier: Apache-2.0
#include "fixture.hpp"

#include <algorithm>
#include <cstring>
#include <exception>
#include <iterator>

namespace test {
namespace {

constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();
constexpr unsigned patience = 200;  // calls of CONodeProcess() without progress: more is a hang

CO_OBJ entry(std::uint16_t index, std::uint8_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, CO_DATA data) {
  return CO_OBJ{CO_KEY(index, sub, flags), type, data};
}

std::uint64_t divided_up(std::uint64_t dividend, std::uint64_t divisor) { return (dividend + divisor - 1) / divisor; }

}  // namespace

Setup& Setup::node_id(std::uint8_t id) { return node_id_ = id, *this; }
Setup& Setup::rate(std::uint32_t ticks_per_second) { return rate_ = ticks_per_second, *this; }
Setup& Setup::clock(std::uint32_t start_tick) { return clock_ = start_tick, *this; }
Setup& Setup::heartbeat(std::uint16_t ms) { return heartbeat_ = ms, *this; }
Setup& Setup::wake(Wake how) { return wake_ = how, *this; }
Setup& Setup::timers(std::uint16_t number) { return timers_ = number, *this; }
Setup& Setup::tx_queue(std::uint16_t frames) { return tx_queue_ = frames, *this; }
Setup& Setup::stay_in_init() { return start_ = false, *this; }
Setup& Setup::with(CO_OBJ entry) { return with_[CO_GET_DEV(entry.Key)] = entry, *this; }
Setup& Setup::without(std::uint16_t index, std::uint8_t sub) { return without_.push_back(CO_DEV(index, sub)), *this; }
Setup& Setup::only_small() { return large_domains_ = false, *this; }
Setup& Setup::writable(std::function<bool(const void*, std::uint32_t)> may_write) {
  return may_write_ = std::move(may_write), *this;
}
Setup& Setup::before_init(std::function<void(Objects&)> change) { return before_init_ = std::move(change), *this; }

namespace {

using Table = std::vector<CO_OBJ>;

void add_communication(Table& table, Objects& o) {
  const Table part = {
      entry(0x1000, 0, CO_OBJ_D___R_, CO_TUNSIGNED32, 0x000F0191),
      entry(0x1001, 0, CO_OBJ____PR_, CO_TUNSIGNED8, &o.error_register),
      entry(0x1008, 0, CO_OBJ_____R_, CO_TSTRING, &o.device_name),
      entry(0x100A, 0, CO_OBJ_____R_, CO_TSTRING, &o.version),
      entry(0x1014, 0, CO_OBJ_DN__R_, CO_TUNSIGNED32, 0x80),
      entry(0x1017, 0, CO_OBJ_____RW, CO_THB_PROD, &o.heartbeat),
      entry(0x1018, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 4),
      entry(0x1018, 1, CO_OBJ_D___R_, CO_TUNSIGNED32, 0x11111111),
      entry(0x1018, 2, CO_OBJ_D___R_, CO_TUNSIGNED32, 0x22222222),
      entry(0x1018, 3, CO_OBJ_D___R_, CO_TUNSIGNED32, 0x33333333),
      entry(0x1018, 4, CO_OBJ_D___R_, CO_TUNSIGNED32, 0x44444444),
      entry(0x1200, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2),
      entry(0x1200, 1, CO_OBJ_DN__R_, CO_TSDO_ID, CO_COBID_SDO_REQUEST()),
      entry(0x1200, 2, CO_OBJ_DN__R_, CO_TSDO_ID, CO_COBID_SDO_RESPONSE()),
  };
  table.insert(table.end(), part.begin(), part.end());
}

void add_servers([[maybe_unused]] Table& table, [[maybe_unused]] Objects& o) {
#if CO_SSDO_N >= 2
  table.push_back(entry(0x1201, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2));
  table.push_back(entry(0x1201, 1, CO_OBJ_____RW, CO_TSDO_ID, &o.sdo2_rx));
  table.push_back(entry(0x1201, 2, CO_OBJ_____RW, CO_TSDO_ID, &o.sdo2_tx));
#endif
#if CO_SSDO_N >= 3
  table.push_back(entry(0x1202, 0, CO_OBJ_D___R_, CO_TUNSIGNED8, 2));
  table.push_back(entry(0x1202, 1, CO_OBJ_____RW, CO_TSDO_ID, &o.sdo3_rx));
  table.push_back(entry(0x1202, 2, CO_OBJ_____RW, CO_TSDO_ID, &o.sdo3_tx));
#endif
}

void add_numbers(Table& table, Objects& o) {
  const Table part = {
      entry(0x2001, 0, CO_OBJ____PRW, CO_TUNSIGNED8, &o.u8),
      entry(0x2002, 0, CO_OBJ____PRW, CO_TUNSIGNED16, &o.u16),
      entry(0x2003, 0, CO_OBJ_____RW, CO_TUNSIGNED24, &o.u24),
      entry(0x2004, 0, CO_OBJ____PRW, CO_TUNSIGNED32, &o.u32),
      entry(0x2005, 0, CO_OBJ_____RW, CO_TUNSIGNED40, &o.u40),
      entry(0x2006, 0, CO_OBJ_____RW, CO_TUNSIGNED48, &o.u48),
      entry(0x2007, 0, CO_OBJ_____RW, CO_TUNSIGNED56, &o.u56),
      entry(0x2008, 0, CO_OBJ_____RW, CO_TUNSIGNED64, &o.u64),
      entry(0x2020, 0, CO_OBJ_____RW, CO_TBOOLEAN, &o.boolean),
      entry(0x2024, 0, CO_OBJ_____RW, CO_TREAL32, &o.real32),
      entry(0x2026, 0, CO_OBJ_____RW, CO_TTIME_OF_DAY, &o.time_of_day),
      entry(0x2028, 0, CO_OBJ_____RW, CO_TREAL64, &o.real64),
      entry(0x2030, 0, CO_OBJ______W, CO_TUNSIGNED32, &o.write_only),
      entry(0x2031, 0, CO_OBJ_____R_, CO_TUNSIGNED32, &o.read_only),
      entry(0x2032, 0, CO_OBJ_______, CO_TUNSIGNED32, &o.no_access),
      entry(0x2033, 1, CO_OBJ_____RW, CO_TUNSIGNED32, &o.record),
      entry(0x2034, 0, CO_OBJ_DN__RW, CO_TUNSIGNED32, 0x180),
  };
  table.insert(table.end(), part.begin(), part.end());
}

CO_OBJ_DOM* make_domain(Objects& o, std::uint32_t size) {
  Bytes& memory = o.memory[size];
  memory.resize(size > 0 ? size : 1);
  for (std::size_t i = 0; i < memory.size(); ++i) {
    memory[i] = static_cast<std::uint8_t>(i + 1);
  }
  o.domain[size] = CO_OBJ_DOM{0, size, memory.data()};
  return &o.domain[size];
}

void add_streams(Table& table, Objects& o, bool large) {
  static constexpr std::uint8_t sizes[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 14, 15};
  for (const std::uint8_t size : sizes) {
    table.push_back(entry(0x2100, size, CO_OBJ_____RW, CO_TDOMAIN, make_domain(o, size)));
  }
  if (large) {
    table.push_back(entry(0x2101, 0, CO_OBJ_____RW, CO_TDOMAIN, make_domain(o, 889)));
    table.push_back(entry(0x2102, 0, CO_OBJ_____RW, CO_TDOMAIN, make_domain(o, 70000)));
  }
  table.push_back(entry(0x2110, 0, CO_OBJ_____RW, CO_TVISIBLE_STRING, &o.text));
  table.push_back(entry(0x2111, 0, CO_OBJ_____RW, CO_TOCTET_STRING, &o.octets));
  table.push_back(entry(0x2112, 0, CO_OBJ_____RW, CO_TUNICODE_STRING, &o.unicode));
}

}  // namespace

std::vector<CO_OBJ> Setup::dictionary(Objects& objects) const {
  objects.heartbeat = heartbeat_;
  Table table;
  add_communication(table, objects);
  add_servers(table, objects);
  add_numbers(table, objects);
  add_streams(table, objects, large_domains_);
  std::map<std::uint32_t, CO_OBJ> sorted;
  for (const CO_OBJ& obj : table) {
    sorted[CO_GET_DEV(obj.Key)] = obj;
  }
  for (const auto& [dev, obj] : with_) {
    sorted[dev] = obj;
  }
  for (const std::uint32_t dev : without_) {
    sorted.erase(dev);
  }
  table.clear();
  std::transform(sorted.begin(), sorted.end(), std::back_inserter(table), [](const auto& pair) { return pair.second; });
  table.push_back(CO_OBJ CO_OBJ_DICT_ENDMARK);
  return table;
}

void FakeCan::refuse_next(std::uint64_t number, std::int16_t with) {
  refuse_from = attempts + 1;
  refuse_to = refuse_from + number;
  refusal = with;
}

void FakeCan::refuse_nth(std::uint64_t number, std::int16_t with) {
  refuse_from = attempts + number;
  refuse_to = refuse_from + 1;
  refusal = with;
}

// The stack's side of the fixture: what it calls.
struct Fixture::Drivers {
  static Fixture& of(void* ctx) { return *static_cast<Fixture*>(ctx); }

  static void can_init(void* ctx) { ++of(ctx).can.init_calls; }
  static void can_enable(void* ctx, std::uint32_t baud) {
    of(ctx).can.baud = baud;
    of(ctx).can.on_bus = true;
  }
  static std::int16_t can_read(void* ctx, CO_IF_FRM* frm) {
    const OutsideStack outside;
    FakeCan& can = of(ctx).can;
    if (can.to_node.empty()) {
      return can.read_result;
    }
    *frm = can.to_node.front();
    can.to_node.pop_front();
    return sizeof(CO_IF_FRM);
  }
  static std::int16_t can_send(void* ctx, const CO_IF_FRM* frm) {
    const OutsideStack outside;
    Fixture& self = of(ctx);
    FakeCan& can = self.can;
    ++can.attempts;
    if (can.attempts >= can.refuse_from && can.attempts < can.refuse_to) {
      can.has_refused = true;
      self.downloads_.answer(*frm);
      return can.refusal;
    }
    note_violation(self, *frm);
    self.downloads_.answer(*frm);
    can.sent.push_back({*frm, self.now_});
    return sizeof(CO_IF_FRM);
  }
  static void can_reset(void* ctx) { ++of(ctx).can.resets; }
  static void can_close(void* ctx) { of(ctx).can.on_bus = false; }
  static void can_filter(void* ctx, const std::uint32_t* ids, std::uint16_t num) {
    const OutsideStack outside;
    of(ctx).can.filter_off_bus |= !of(ctx).can.on_bus;
    of(ctx).can.filter.assign(ids, ids + num);
  }

  static void timer_init(void*, std::uint32_t) {}
  static std::uint32_t timer_now(void* ctx) { return static_cast<std::uint32_t>(of(ctx).setup_.clock_ + of(ctx).now_); }
  static void timer_alarm(void* ctx, std::uint32_t ticks) {
    Fixture& self = of(ctx);
    self.alarm_ = ticks == 0 ? never : self.now_ + ticks;
  }

  static bool writable(void* ctx, const void* address, std::uint32_t size) {
    const OutsideStack outside;
    const auto& may_write = of(ctx).setup_.may_write_;
    return !may_write || may_write(address, size);
  }

  static bool is_sdo(const Fixture& self, const CO_IF_FRM& frm) {
    const bool by_default = frm.Identifier >= 0x580 && frm.Identifier <= 0x5FF;
    return by_default || std::any_of(std::begin(self.node.Sdo), std::end(self.node.Sdo), [&](const CO_SDO& server) {
             return (server.TxId & CO_IF_FRM_ID) == (frm.Identifier & CO_IF_FRM_ID) &&
                    (server.RxId & CO_SDO_ID_OFF) == 0;
           });
  }

  // Heartbeats that had to wait may tell a state that is no more.
  static void note_violation(Fixture& self, const CO_IF_FRM& frm) {
    const bool waited = self.can.has_refused && frm.Identifier >= 0x700;
    std::string fault = waited ? "" : fault_of(frm, self.node.NodeId, self.node.Nmt.Mode, is_sdo(self, frm));
    if (!self.can.on_bus) {
      fault = "sent while off the bus";
    }
    if (!fault.empty()) {
      self.violations_.push_back(notation(frm) + ": " + fault);
    }
  }

  static constexpr CO_IF_CAN_DRV_EX can_table{can_init,  can_enable, can_read,  can_send,
                                              can_reset, can_close,  can_filter};
  static constexpr CO_IF_TIMER_DRV_EX timer_with_alarm{timer_init, timer_now, timer_alarm};
  static constexpr CO_IF_TIMER_DRV_EX timer_without_alarm{timer_init, timer_now, nullptr};
};

Fixture::Fixture(Setup setup)
    : setup_(std::move(setup)),
      dictionary_(setup_.dictionary(objects)),
      timers_(setup_.timers_),
      tx_queue_(setup_.tx_queue_),
      sdo_buffer_(CO_SSDO_N * CO_SDO_BUF_BYTE) {
  std::memset(static_cast<void*>(&node), 0xA5, sizeof node);  // nothing may rely on memory being zero
  if (!timers_.empty()) {
    std::memset(static_cast<void*>(timers_.data()), 0x5A, timers_.size() * sizeof timers_[0]);
  }
  if (setup_.before_init_) {
    setup_.before_init_(objects);
  }
  for (CO_OBJ& obj : dictionary_) {
    memory_.add(obj);
  }
  call([this] { init(); });
  if (setup_.start_) {
    call([this] { CONodeStart(&node); });
    trace();
    checked_ = 0;
  }
}

void Fixture::init() {
  ext_.Size = sizeof ext_;
  ext_.Can = &Drivers::can_table;
  ext_.Timer = setup_.wake_ == Wake::alarm ? &Drivers::timer_with_alarm : &Drivers::timer_without_alarm;
  ext_.CanCtx = ext_.TimerCtx = ext_.User = this;
  ext_.TxQueue = tx_queue_.empty() ? nullptr : tx_queue_.data();
  ext_.TxQueueLen = setup_.tx_queue_;
  ext_.Writable = setup_.may_write_ ? Drivers::writable : nullptr;
  CO_NODE_SPEC spec;
  spec.NodeId = setup_.node_id_;
  spec.Baudrate = 250000;
  spec.Dict = dictionary_.data();
  spec.DictLen = static_cast<std::uint16_t>(dictionary_.size());
  spec.EmcyCode = nullptr;
  spec.TmrMem = timers_.empty() ? nullptr : timers_.data();
  spec.TmrNum = setup_.timers_;
  spec.TmrFreq = setup_.rate_;
  spec.Drv = nullptr;
  spec.SdoBuf = sdo_buffer_.data();
  CONodeInitEx(&node, &spec, &ext_);
}

Fixture::~Fixture() {
  callbacks() = Callbacks{};  // what they refer to is younger than the fixture, and gone
  if (std::uncaught_exceptions() == 0) {
    check_back_to_idle();
    const std::vector<std::string> left = frames();
    CHECK_MESSAGE(left.empty(), "left unread: ", left.size(), " frames, the first is ", left.empty() ? "" : left[0]);
    CONodeStop(&node);
    CHECK(node.Nmt.Mode == CO_INVALID);
    CHECK_FALSE(can.on_bus);
  }
}

// The server ends an abandoned transfer by itself. [D18]
void Fixture::check_back_to_idle() {
  const auto busy = [this] {
    return std::any_of(std::begin(node.Sdo), std::end(node.Sdo), [](const CO_SDO& sdo) { return sdo.Obj != nullptr; });
  };
  if (node.Nmt.Mode != CO_INVALID && busy() && CO_SDO_TIMEOUT > 0) {
    const std::vector<std::string> left = frames();
    CHECK_MESSAGE(left.empty(), "left unread: ", left.empty() ? "" : left[0]);
    can.accept_all();
    after(sdo_time_out());
    CHECK_MESSAGE(!busy(), "an SDO server is still busy after its time-out");
    trace();
  }
}

void Fixture::rx(std::string_view text, Where at) { rx(frame(text), at); }

void Fixture::rx(const CO_IF_FRM& frm, Where at) {
  if (!can.sent.empty()) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "not looked at before rx(): " << notation(can.sent.front().frm));
    trace();
  }
  downloads_.request(frm);
  call(
      [&] {
        {
          const OutsideStack outside;
          can.to_node.push_back(frm);
        }
        process_frames();
      },
      at);
}

void Fixture::init_again(Where at) {
  downloads_.reset();
  call([this] { init(); }, at);
}

void Fixture::loop(Where at) {
  call([this] { process_frames(); }, at);
}

// One call for each received frame, and more while frames wait for the driver.
void Fixture::process_frames() {
  for (unsigned calls = 0; calls < patience; ++calls) {
    const std::size_t sent = can.sent.size();
    const std::size_t waiting = node.TxQueue.Num;
    CONodeProcess(&node);
    const OutsideStack outside;
    if (can.sent.size() - sent > waiting + frames_per_call_) {
      violations_.push_back(std::to_string(can.sent.size() - sent) + " frames in one call");
    }
    if (can.to_node.empty() && (node.TxQueue.Num == 0 || can.sent.size() == sent)) {
      return;
    }
  }
}

void Fixture::call(const std::function<void()>& api, Where at) {
  memory_.remember();
  heap_before_ = heap_requests();
  {
    const InsideStack inside;
    api();
  }
  check_properties(at);
}

void Fixture::check_properties(Where at) {
  if (heap_requests() != heap_before_) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "heap used " << heap_requests() - heap_before_ << " times");
  }
  for (const std::string& violation : violations_) {
    ADD_FAIL_CHECK_AT(at.file, at.line, violation);
  }
  violations_.clear();
  const std::set<std::uint32_t> streaming = downloads_.streaming();
  std::set<std::uint32_t> allowed = downloads_.take_completed();
  for (const std::uint32_t dev : memory_.changed()) {
    const bool right =
        allowed.count(dev) > 0 || (memory_.is_stream(dev) && streaming.count(dev) > 0) || memory_.shares(dev, allowed);
    if (!right || (memory_.is_read_only(dev) && !memory_.shares(dev, allowed))) {
      ADD_FAIL_CHECK_AT(at.file, at.line,
                        "object changed without a legal download: index " << CO_GET_IDX(dev) << " sub-index "
                                                                          << unsigned{CO_GET_SUB(dev)});
    }
  }
  if (node.Nmt.Mode != CO_INVALID && armed_timers() > setup_.timers_ + 2U) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "timers armed: " << armed_timers());
  }
}

unsigned Fixture::armed_timers() const {
  unsigned number = 0;
  for (const CO_TMR_MEM* list : {node.Tmr.Use, node.Tmr.Due, node.Tmr.Run}) {
    for (; list != nullptr && number <= setup_.timers_ + 2U; list = list->Next) {
      ++number;
    }
  }
  return number;
}

std::string Fixture::pop() {
  const std::string text = notation(can.sent.front().frm);
  can.sent.pop_front();
  return text;
}

void Fixture::tx(std::string_view text, Where at) { tx({text}, at); }

void Fixture::tx(std::initializer_list<std::string_view> all, Where at) {
  for (const std::string_view expected : all) {
    const std::string sent = can.sent.empty() ? "nothing" : pop();
    if (sent != notation(frame(expected))) {
      ADD_FAIL_CHECK_AT(at.file, at.line, "expected " << std::string(expected) << ", sent " << sent);
    }
  }
  silent(at);
}

void Fixture::silent(Where at) {
  while (!can.sent.empty()) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "unexpected " << pop());
  }
}

void Fixture::ask(std::string_view request, std::string_view answer, Where at) {
  rx(request, at);
  tx(answer, at);
}

void Fixture::tx_at(Time time, std::string_view text, Where at) {
  if (can.sent.empty()) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "expected " << std::string(text) << ", sent nothing");
    return;
  }
  const std::uint64_t tick = can.sent.front().tick - began_;
  const std::string sent = pop();
  if (sent != notation(frame(text)) || tick != ticks(time)) {
    ADD_FAIL_CHECK_AT(
        at.file, at.line,
        "expected " << std::string(text) << " at tick " << ticks(time) << ", sent " << sent << " at tick " << tick);
  }
}

std::vector<std::string> Fixture::trace() {
  std::vector<std::string> lines;
  while (!can.sent.empty()) {
    const std::uint64_t ms = (can.sent.front().tick - began_) * 1000 / setup_.rate_;
    lines.push_back(std::to_string(ms) + " " + pop());
  }
  return lines;
}

std::vector<std::string> Fixture::frames() {
  std::vector<std::string> lines;
  while (!can.sent.empty()) {
    lines.push_back(pop());
  }
  return lines;
}

std::uint64_t Fixture::ticks(Time time) const {
  return divided_up(static_cast<std::uint64_t>(time.count()) * setup_.rate_, 1000000);
}

std::uint64_t Fixture::next_wake() const {
  if (setup_.wake_ == Wake::every_tick) {
    return now_ + 1;
  }
  if (setup_.wake_ == Wake::alarm) {
    return alarm_;
  }
  const std::uint32_t deadline = CONodeNextDeadline(const_cast<CO_NODE*>(&node));
  return deadline == std::numeric_limits<std::uint32_t>::max() ? never : now_ + deadline;
}

void Fixture::wake_up(Where at) {
  alarm_ = never;
  call(
      [this] {
        COTmrService(&node.Tmr);
        COTmrProcess(&node.Tmr);
        process_frames();
      },
      at);
}

void Fixture::run_until(std::uint64_t end, Where at) {
  unsigned calls_at_this_tick = 0;
  for (std::uint64_t wake = next_wake(); wake <= end; wake = next_wake()) {
    calls_at_this_tick = wake > now_ ? 0 : calls_at_this_tick + 1;
    if (calls_at_this_tick > patience) {
      ADD_FAIL_CHECK_AT(at.file, at.line, "the timer never finds rest");
      break;
    }
    now_ = std::max(now_, wake);
    wake_up(at);
  }
  now_ = end;
}

void Fixture::after(Time time, Where at) {
  began_ = now_;
  run_until(now_ + ticks(time), at);
}

void Fixture::jump(Time time, Where at) {
  began_ = now_;
  now_ += ticks(time);
  wake_up(at);
}

void Fixture::elapse_only(Time time, std::int16_t elapsed, Where at) {
  began_ = now_;
  now_ += ticks(time);
  call(
      [&] {
        const std::int16_t result = COTmrService(&node.Tmr);
        const OutsideStack outside;
        CHECK(result == elapsed);
      },
      at);
}

void Fixture::may_change(std::uint16_t index, std::uint8_t sub) { memory_.release(CO_DEV(index, sub)); }

void Fixture::watch(std::uint16_t index, std::uint8_t sub, const void* memory, std::size_t size) {
  memory_.add(CO_KEY(index, sub, CO_OBJ_____RW), memory, size, false);
}

CO_OBJ* Fixture::find(std::uint16_t index, std::uint8_t sub) { return CODictFind(&node.Dict, CO_DEV(index, sub)); }

std::string Fixture::difference(const Fixture& other) const {
  const auto differs = [](const auto& a, const auto& b) { return std::memcmp(&a, &b, sizeof a) != 0; };
  if (node.Nmt.Mode != other.node.Nmt.Mode || node.NodeId != other.node.NodeId) {
    return "mode or node-ID";
  }
  for (unsigned n = 0; n < CO_SSDO_N; ++n) {
    const CO_SDO& a = node.Sdo[n];
    const CO_SDO& b = other.node.Sdo[n];
    if (a.Obj != b.Obj || a.RxId != b.RxId || a.TxId != b.TxId || a.State != b.State) {
      return "SDO server " + std::to_string(n);
    }
  }
  if (node.TxQueue.Num != other.node.TxQueue.Num || node.Pending != other.node.Pending) {
    return "waiting frames or pending work";
  }
  if (differs(node.Routes.Start, other.node.Routes.Start)) {
    return "routes";
  }
  return armed_timers() == other.armed_timers() ? "" : "timers";
}

namespace {

CO_IF_FRM request(std::uint8_t command, std::uint16_t index, std::uint8_t sub, std::uint32_t last_bytes) {
  CO_IF_FRM frm{};
  CO_SET_ID(&frm, 0x601);
  CO_SET_DLC(&frm, 8);
  CO_SET_BYTE(&frm, command, 0);
  CO_SET_WORD(&frm, index, 1);
  CO_SET_BYTE(&frm, sub, 3);
  CO_SET_LONG(&frm, last_bytes, 4);
  return frm;
}

}  // namespace

Bytes Fixture::upload(std::uint16_t index, std::uint8_t sub, Where at) {
  const auto answer_to = [&](const CO_IF_FRM& frm) {
    rx(frm, at);
    const CO_IF_FRM answer = can.sent.size() == 1 ? can.sent.front().frm : CO_IF_FRM{0, {0x80}, 8};
    can.sent.clear();
    return answer;
  };
  CO_IF_FRM answer = answer_to(request(0x40, index, sub, 0));
  if ((answer.Data[0] & 0xE3U) == 0x43U) {
    return Bytes(answer.Data + 4, answer.Data + 8 - ((answer.Data[0] >> 2) & 3U));
  }
  if (answer.Data[0] != 0x41) {
    return {};
  }
  const std::uint32_t announced = CO_GET_LONG(&answer, 4);
  Bytes data;
  std::uint8_t toggle = 0;
  do {
    answer = answer_to(request(static_cast<std::uint8_t>(0x60U | toggle), 0, 0, 0));
    if ((answer.Data[0] & 0xF0U) != toggle) {
      return {};
    }
    data.insert(data.end(), answer.Data + 1, answer.Data + 8 - ((answer.Data[0] >> 1) & 7U));
    toggle ^= 0x10U;
  } while ((answer.Data[0] & 1U) == 0);
  return data.size() == announced ? data : Bytes{};
}

std::uint32_t Fixture::download(std::uint16_t index, std::uint8_t sub, const Bytes& data, bool announced, Where at) {
  const auto abort_of = [&](const CO_IF_FRM& frm, std::uint8_t accepted) -> std::uint32_t {
    rx(frm, at);
    const CO_IF_FRM answer = can.sent.size() == 1 ? can.sent.front().frm : CO_IF_FRM{};
    can.sent.clear();
    return answer.Data[0] == accepted ? 0 : CO_GET_LONG(&answer, 4) + (answer.Data[0] == 0x80 ? 0U : 1U);
  };
  const auto size = static_cast<std::uint32_t>(data.size());
  std::uint32_t abort = abort_of(request(announced ? 0x21 : 0x20, index, sub, announced ? size : 0), 0x60);
  std::uint8_t toggle = 0;
  std::size_t done = 0;
  bool last = false;
  while (abort == 0 && !last) {
    const std::size_t length = std::min<std::size_t>(7, data.size() - done);
    last = done + length == data.size();
    CO_IF_FRM frm = request(static_cast<std::uint8_t>(toggle | ((7 - length) << 1) | (last ? 1U : 0U)), 0, 0, 0);
    std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(done), length, frm.Data + 1);
    abort = abort_of(frm, static_cast<std::uint8_t>(0x20U | toggle));
    done += length;
    toggle ^= 0x10U;
  }
  return abort;
}

}  // namespace test
