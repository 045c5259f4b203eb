// SPDX-License-Identifier: Apache-2.0
// Cost of the main loop, unrelated frames, heartbeats and emergencies.
#include <iterator>

#include "device.hpp"
#include "measure.hpp"
#include "node_operations.hpp"
#include "operations.hpp"

namespace bench {
namespace {

void set_up_usual_node(std::uint16_t heartbeat_ms) {
  clear_dictionary();
  add_usual_objects();
  add(0x1017, 0, CO_OBJ_D___R_, CO_THB_PROD, (CO_DATA)(heartbeat_ms));
  for (std::uint16_t number = 0; number < CO_RPDO_N; ++number) {
    add_rpdo(number, 255, bytes);
  }
  for (std::uint16_t number = 0; number < CO_TPDO_N; ++number) {
    add_tpdo(number, 255, bytes);
  }
  start(CO_OPERATIONAL);
}

class NothingToDo : public Operation {
 public:
  void set_up() { set_up_usual_node(1000); }
  void run() {
    CONodeProcess(&node);
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
  }
  bool is_done(unsigned) { return sent() == 0 && CONodeGetCounters(&node).Received == 0; }
};

class HeartbeatProduced : public Operation {
 public:
  void set_up() { set_up_usual_node(1000); }
  void arrange(unsigned) {
    forget_sent();
    elapse();
  }
  void run() {
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
  }
  bool is_done(unsigned) { return has_sent(frame(0x700 + node_id, {0x05})); }
};

// A heartbeat of a monitored node, each after nine tenths of the consumer's time.
class HeartbeatConsumed : public Operation {
 public:
  void set_up() { set_up_usual_node(0); }
  void arrange(unsigned n) {
    producer_ = heard_nodes[n % std::size(heard_nodes)];
    advance(heard_period * ticks_per_second / 1000 * 9 / 10 / std::size(heard_nodes));
    receive(frame(0x700u + producer_, {0x05}));
  }
  void run() { CONodeProcess(&node); }
  bool is_done(unsigned) {
    return CONmtLastHbState(&node.Nmt, producer_) == CO_OPERATIONAL && CONmtGetHbEvents(&node.Nmt, producer_) == 0;
  }
  // Checks that the consumers were active: without heartbeats they report an event.
  void end() {
    advance(heard_period * ticks_per_second / 1000);
    if (CONmtGetHbEvents(&node.Nmt, producer_) != 1) {
      fail("heartbeat consumed", "the node was not monitored");
    }
  }

 private:
  std::uint8_t producer_ = 0;
};

class Emergency : public Operation {
 public:
  void set_up() { set_up_usual_node(0); }
  void arrange(unsigned n) {
    forget_sent();
    error_ = static_cast<std::uint8_t>(n % 2);
  }
  void run() {
    COEmcySet(&node.Emcy, error_, &information_);
    COEmcyClr(&node.Emcy, error_);
  }
  bool is_done(unsigned) {
    const CO_IF_FRM come = error_ == 0 ? frame(0x80 + node_id, {0x00, 0x31, 0x05, 1, 2, 3, 4, 5})
                                       : frame(0x80 + node_id, {0x00, 0x42, 0x09, 1, 2, 3, 4, 5});
    const CO_IF_FRM gone = frame(0x80 + node_id, {0, 0, 0, 0, 0, 0, 0, 0});
    return sent() == 2 && is_same(sent(0), come) && is_same(sent(1), gone);
  }

 private:
  std::uint8_t error_ = 0;
  const CO_EMCY_USR information_ = {0x0201, {1, 2, 3, 4, 5}};
};

}  // namespace

void measure_network() {
  measure("nothing to do, loop and timers", NothingToDo());
  measure("foreign frame", ForeignFrame([] { set_up_usual_node(1000); }));
  measure("heartbeat produced", HeartbeatProduced());
  measure("heartbeat consumed", HeartbeatConsumed());
  measure("EMCY, error set and cleared", Emergency());
}

}  // namespace bench
