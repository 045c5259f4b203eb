// SPDX-License-Identifier: Apache-2.0
#include "fixture.hpp"

#include <algorithm>
#include <cstring>
#include <exception>
#include <iterator>

namespace test {
namespace {}  // namespace

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

void FakeCan::accept_next(std::uint64_t number) {
  refuse_nth(number + 1);
  refuse_to = std::numeric_limits<std::uint64_t>::max();
}

// Drivers and callbacks of the fixture, which the stack calls.
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
    if (can.on_read) {
      can.on_read();
    }
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
    if (self.od_locked_) {
      note(self, *frm, "sent while objects are locked");
    }
    ++can.attempts;
    if (can.attempts >= can.refuse_from && can.attempts < can.refuse_to) {
      can.has_refused = true;
      return can.refusal;
    }
    note_violations(self, *frm);
    can.sent.push_back({*frm, self.now_});
    return sizeof(CO_IF_FRM);
  }
  static void can_reset(void* ctx) { ++of(ctx).can.resets; }
  static void can_close(void* ctx) {
    of(ctx).can.on_bus = false;
    ++of(ctx).can.closes;
  }
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

  static void od_lock(void* ctx) {
    const OutsideStack outside;
    Fixture& self = of(ctx);
    if (self.od_locked_) {
      self.violations_.emplace_back("OdLock is nested");
    }
    self.od_locked_ = true;
    if (callbacks().od_lock) {
      callbacks().od_lock();
    }
  }
  static void od_unlock(void* ctx) {
    const OutsideStack outside;
    Fixture& self = of(ctx);
    if (!self.od_locked_) {
      self.violations_.emplace_back("OdUnlock without OdLock");
    }
    self.od_locked_ = false;
    if (callbacks().od_unlock) {
      callbacks().od_unlock();
    }
  }

  static void enter(void* ctx) {
    const OutsideStack outside;
    Fixture& self = of(ctx);
    if (self.in_turn_) {
      self.violations_.emplace_back("Enter is nested");
    }
    self.in_turn_ = true;
    if (callbacks().enter) {
      callbacks().enter();
    }
  }
  static void leave(void* ctx) {
    const OutsideStack outside;
    Fixture& self = of(ctx);
    if (!self.in_turn_) {
      self.violations_.emplace_back("Leave without Enter");
    }
    self.in_turn_ = false;
    if (callbacks().leave) {
      callbacks().leave();
    }
  }

  static bool is_sdo(const Fixture& self, const CO_IF_FRM& frm) {
    const bool by_default = frm.Identifier > 0x580 && frm.Identifier <= 0x5FF;
    return by_default || std::any_of(std::begin(self.node.Sdo), std::end(self.node.Sdo),
                                     [&](const CO_SDO& server) { return server.TxId == frm.Identifier; });
  }

  static void note_violations(Fixture& self, const CO_IF_FRM& frm) {
    SdoObserver* const channel = self.channel(&CO_SDO::TxId, frm.Identifier);
    const bool sending = channel != nullptr && channel->is_sending();
    note(self, frm, fault_of_frame(self, frm, sending));
    note(self, frm, channel == nullptr ? "" : channel->taken(frm));
    self.segments_ += sending ? 1 : 0;
  }

  // Clears the toggle bit of a node guarding response. Heartbeats have none.
  static CO_IF_FRM without_toggle(const Fixture& self, CO_IF_FRM frm) {
    if (self.guarded_ && self.objects.heartbeat == 0 && frm.Identifier == 0x700U + self.node.NodeId) {
      frm.Data[0] &= 0x7F;
    }
    return frm;
  }

  // Error control frames that were queued may contain a previous NMT state and are not checked.
  static std::string fault_of_frame(const Fixture& self, const CO_IF_FRM& frm, bool sending) {
    if (!self.can.on_bus) {
      return "sent while off the bus";
    }
    const bool waited = self.can.has_refused && frm.Identifier >= 0x700;
    const bool command = self.setup_.nmt_master_ && frm.Identifier == 0 && frm.DLC == 2;
    return waited || command
               ? ""
               : fault_of(without_toggle(self, frm), self.node.NodeId, self.node.Nmt.Mode, is_sdo(self, frm), sending);
  }

  static void note(Fixture& self, const CO_IF_FRM& frm, const std::string& fault) {
    if (!fault.empty()) {
      self.violations_.push_back(notation(frm) + ": " + fault);
    }
  }

  static constexpr CO_IF_CAN_DRV_EX can_table{can_init,  can_enable, can_read,   can_send,
                                              can_reset, can_close,  can_filter, CONodeCanReport};
  static constexpr CO_IF_TIMER_DRV_EX timer_with_alarm{timer_init, timer_now, timer_alarm};
  static constexpr CO_IF_TIMER_DRV_EX timer_without_alarm{timer_init, timer_now, nullptr};
};

Fixture::Fixture(Setup setup)
    : setup_(std::move(setup)),
      dictionary_(setup_.dictionary(objects)),
      timers_(setup_.timers_),
      tx_queue_(setup_.tx_queue_),
      sdo_buffer_(CO_SSDO_N * CO_SDO_BUF_BYTE) {
  std::memset(static_cast<void*>(&node), 0xA5, sizeof node);  // The stack must not rely on zeroed memory.
  if (!timers_.empty()) {
    std::memset(static_cast<void*>(timers_.data()), 0x5A, timers_.size() * sizeof timers_[0]);
  }
  if (setup_.before_init_) {
    setup_.before_init_(objects);
  }
  for (CO_OBJ& obj : dictionary_) {
    memory_.add(obj);
  }
  for (const auto& [index, sub] : setup_.may_change_) {
    may_change(index, sub);
  }
  index();
  (void)callbacks();  // Its first call may allocate memory, which must not be counted as a request of the stack.
  call([this] { init(); });
  if (setup_.start_) {
    call([this] { CONodeStart(&node); });
    trace();
  }
}

// Creates the index of the OD access interface (co_od.h).
void Fixture::index() {
#if USE_OD
  od_list_.resize(OD_LIST_N(dictionary_.size()));
  const auto length = static_cast<std::uint16_t>(dictionary_.size());
  const auto list_length = static_cast<std::uint16_t>(od_list_.size());
  REQUIRE(OD_init(&od, od_list_.data(), list_length, &node, dictionary_.data(), length) == ODR_OK);
  ext_.Od = &od;
#endif
}

void Fixture::init() {
  ext_.Size = sizeof ext_;
  ext_.Can = &Drivers::can_table;
  ext_.Timer = setup_.wake_ == Wake::alarm ? &Drivers::timer_with_alarm : &Drivers::timer_without_alarm;
  ext_.CanCtx = ext_.TimerCtx = ext_.User = this;
  ext_.TxQueue = tx_queue_.empty() ? nullptr : tx_queue_.data();
  ext_.TxQueueLen = setup_.tx_queue_;
  ext_.Writable = setup_.may_write_ ? Drivers::writable : nullptr;
  ext_.Nvm = setup_.nvm_;
  ext_.NvmCtx = setup_.nvm_context_;
  ext_.Callbacks = setup_.callbacks_;
  ext_.OdLock = Drivers::od_lock;
  ext_.OdUnlock = Drivers::od_unlock;
#if USE_REAL_TIME
  ext_.Enter = setup_.turns_ ? Drivers::enter : nullptr;
  ext_.Leave = setup_.turns_ ? Drivers::leave : nullptr;
  ext_.Mainline = setup_.mainline_;
  ext_.Foreign = setup_.foreign_;
#endif
  ext_.EmcyNum = static_cast<std::uint16_t>(setup_.emergencies_.size());
  CO_NODE_SPEC spec;
  spec.NodeId = setup_.node_id_;
  spec.Baudrate = 250000;
  spec.Dict = dictionary_.data();
  spec.DictLen = static_cast<std::uint16_t>(dictionary_.size());
  spec.EmcyCode = setup_.emergencies_.empty() ? nullptr : setup_.emergencies_.data();
  spec.TmrMem = timers_.empty() ? nullptr : timers_.data();
  spec.TmrNum = setup_.timers_;
  spec.TmrFreq = setup_.rate_;
  spec.Drv = nullptr;
  spec.SdoBuf = setup_.sdo_buffer_ ? sdo_buffer_.data() : nullptr;
  CONodeInitEx(&node, &spec, &ext_);
}

Fixture::~Fixture() {
  callbacks() = Callbacks{};  // They may refer to variables of the test that are already destroyed.
  if (std::uncaught_exceptions() == 0) {
    check_back_to_idle();
    const std::vector<std::string> left = frames();
    CHECK_MESSAGE(left.empty(), "left unread: ", left.size(), " frames, the first is ", left.empty() ? "" : left[0]);
    CONodeStop(&node);
    CHECK(node.Nmt.Mode == CO_INVALID);
    CHECK_FALSE(can.on_bus);
  }
}

void Fixture::rx(std::string_view text, Where at) { rx(frame(text), at); }

void Fixture::rx(const CO_IF_FRM& frm, Where at) {
  if (!can.sent.empty()) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "not looked at before rx(): " << notation(can.sent.front().frm));
    trace();
  }
  if (SdoObserver* const asked = channel(&CO_SDO::RxId, frm.Identifier); asked != nullptr) {
    asked->request(frm);
  }
  guarded_ |= (frm.Identifier & CO_IF_FRM_RTR) != 0;
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
  channels_ = {};
  call([this] { init(); }, at);
}

void Fixture::loop(Where at) {
  call([this] { process_frames(); }, at);
}

// Calls CONodeProcess() for each received frame, and as long as it sends queued frames or has paused work that is due.
void Fixture::process_frames() {
  for (unsigned calls = 0; calls < calls_; ++calls) {
    const std::size_t sent = can.sent.size();
    const std::size_t segments = segments_;
    const std::size_t waiting = node.TxQueue.Num;
    CONodeProcess(&node);
    const OutsideStack outside;
    const std::size_t paced = std::min<std::size_t>(segments_ - segments, CO_SDO_BLOCK_PACE);
    if (can.sent.size() - sent > waiting + frames_per_call_ + paced) {
      violations_.push_back(std::to_string(can.sent.size() - sent) + " frames in one call");
    }
    const bool is_due = node.Transmit.Paused != 0 && CONodeNextDeadline(&node) == 0;
    if (can.to_node.empty() && !is_due && (node.TxQueue.Num == 0 || can.sent.size() == sent)) {
      return;
    }
  }
}

void Fixture::call(const std::function<void()>& api, Where at) {
  memory_.remember();
  heap_before_ = heap_requests();
  const bool in_turn = in_turn_;
  {
    const InsideStack inside;
    api();
  }
  if (in_turn_ != in_turn) {
    violations_.emplace_back("a turn has no end");
  }
  check_properties(at);
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

void Fixture::may_change(std::uint16_t index, std::uint8_t sub) { memory_.release(CO_DEV(index, sub)); }

void Fixture::watch(std::uint16_t index, std::uint8_t sub, const void* memory, std::size_t size, bool stream) {
  memory_.add(CO_KEY(index, sub, CO_OBJ_____RW), memory, size, stream);
}

CO_OBJ* Fixture::find(std::uint16_t index, std::uint8_t sub) { return CODictFind(&node.Dict, CO_DEV(index, sub)); }

}  // namespace test
