// SPDX-License-Identifier: Apache-2.0
// The order in which drivers with three transmit mailboxes send frames (drivers/can/transmit.hpp).
#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "support/notation.hpp"
#include "transmit.hpp"

namespace {

using test::frame;
using Ids = std::vector<std::uint32_t>;

// Three mailboxes, of which the one with the lowest identifier is sent first.
class Controller {
 public:
  co::transmit::Completed take_completed(unsigned /*used*/) {
    const co::transmit::Completed completed = completed_;
    completed_ = {};
    return completed;
  }
  unsigned free_mailbox(unsigned used, const CO_IF_FRM& /*frame*/) const {
    unsigned n = 0;
    while (n < CO_CAN_MAILBOXES && (box_[n] || (used & (1U << n)) != 0)) {
      ++n;
    }
    return n;
  }
  void request(unsigned mailbox, const CO_IF_FRM& frm) {
    CHECK(!box_[mailbox]);
    box_[mailbox] = frm;
  }
  void abort(unsigned mailboxes) {
    for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
      if ((mailboxes & (1U << n)) != 0 && box_[n] && on_wire != n) {
        box_[n].reset();
        completed_.done |= 1U << n;
      }
    }
    aborting_ |= mailboxes;
  }
  bool is_delayed(unsigned mailbox) const { return is_delayed_ && on_wire != mailbox; }

  void begin() {
    if (on_wire) {
      return;
    }
    for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
      if (box_[n] && (!on_wire || order(n) < order(*on_wire))) {
        on_wire = n;
      }
    }
  }
  void win() {
    if (on_wire) {
      sent.push_back(box_[*on_wire]->Identifier);
      completed_.sent |= 1U << *on_wire;
      end();
    }
  }
  void fail() {
    if (on_wire && (aborting_ & (1U << *on_wire)) != 0) {
      end();
    }
    on_wire.reset();
  }
  void set_delayed(bool is) { is_delayed_ = is; }

  std::optional<unsigned> on_wire;
  Ids sent;

 private:
  std::uint32_t order(unsigned n) const { return co::transmit::rank(box_[n]->Identifier); }
  void end() {
    completed_.done |= 1U << *on_wire;
    box_[*on_wire].reset();
    on_wire.reset();
  }

  std::optional<CO_IF_FRM> box_[CO_CAN_MAILBOXES];
  co::transmit::Completed completed_ = {};
  unsigned aborting_ = 0;
  bool is_delayed_ = false;
};

class Node {
 public:
  bool takes(const char* text) {
    const CO_IF_FRM frm = frame(text);
    return co::transmit::accept(box, controller, frm);
  }
  bool takes(std::uint32_t id) {
    const CO_IF_FRM frm = {id, {}, 8};
    return co::transmit::accept(box, controller, frm);
  }
  void send_one() {
    controller.begin();
    controller.win();
    co::transmit::finish(box, controller);
  }
  void drain() {
    for (unsigned n = 0; n < 20; ++n) {
      send_one();
    }
  }

  Controller controller;
  CO_CAN_TRANSMIT box = {};
};

TEST_CASE("transmit mailboxes: a bus without other traffic has one frame at a time, in the order of acceptance") {
  Node node;
  CHECK(node.takes("300#"));
  CHECK(!node.takes("200#"));
  CHECK(!node.takes("400#"));
  node.send_one();
  CHECK(node.takes("200#"));
  node.drain();
  CHECK(node.controller.sent == Ids{0x300, 0x200});
}

TEST_CASE("transmit mailboxes: frames of higher priority overtake a frame that another node delays") {
  Node node;
  node.controller.set_delayed(true);
  CHECK(node.takes("300#"));
  CHECK(!node.takes("400#"));
  CHECK(node.takes("200#"));
  CHECK(node.takes("100#"));
  node.drain();
  CHECK(node.controller.sent == Ids{0x100, 0x200, 0x300});
}

TEST_CASE("transmit mailboxes: the frame on the wire is not overtaken") {
  Node node;
  node.controller.set_delayed(true);
  CHECK(node.takes("300#"));
  node.controller.begin();
  CHECK(!node.takes("200#"));
  node.controller.win();
  CHECK(node.takes("200#"));
  node.drain();
  CHECK(node.controller.sent == Ids{0x300, 0x200});
}

TEST_CASE("transmit mailboxes: with all mailboxes full, the frame of lowest priority is displaced and sent later") {
  Node node;
  node.controller.set_delayed(true);
  for (const std::uint32_t id : {0x700U, 0x600U, 0x500U, 0x400U, 0x300U, 0x200U, 0x100U}) {
    CHECK(node.takes(id));
  }
  CHECK(!node.takes(0x080));  // no place for another displaced frame
  node.send_one();
  CHECK(node.takes(0x080));
  node.drain();
  CHECK(node.controller.sent == Ids{0x100, 0x080, 0x200, 0x300, 0x400, 0x500, 0x600, 0x700});
}

TEST_CASE("transmit mailboxes: frames of middle priority leave two places for those of highest priority") {
  Node node;
  node.controller.set_delayed(true);
  for (const std::uint32_t id : {0x700U, 0x100U, 0x600U, 0x500U, 0x400U}) {
    CHECK(node.takes(id));
  }
  CHECK(!node.takes(0x300));
  CHECK(node.takes(0x090));
  CHECK(node.takes(0x080));
  CHECK(!node.takes(0x070));
  node.drain();
  CHECK(node.controller.sent == Ids{0x080, 0x090, 0x100, 0x400, 0x500, 0x600, 0x700});
}

TEST_CASE("transmit mailboxes: a displaced frame that was on the wire is sent once") {
  for (const bool fails : {false, true}) {
    CAPTURE(fails);
    Node node;
    node.controller.set_delayed(true);
    CHECK(node.takes(0x700));
    CHECK(node.takes(0x600));
    CHECK(node.takes(0x500));
    node.controller.on_wire = 0;  // 700h, so 600h is displaced
    CHECK(node.takes(0x100));
    fails ? node.controller.fail() : node.controller.win();
    node.drain();
    CHECK(node.controller.sent == (fails ? Ids{0x100, 0x500, 0x600, 0x700} : Ids{0x700, 0x100, 0x500, 0x600}));
  }
}

TEST_CASE("transmit mailboxes: no frame is lost if the abort of a frame on the wire ends later") {
  for (const bool fails : {false, true}) {
    CAPTURE(fails);
    Node node;
    node.controller.set_delayed(true);
    for (const std::uint32_t id : {0x700U, 0x600U, 0x500U}) {
      CHECK(node.takes(id));
    }
    node.controller.on_wire = 0;  // 700h
    for (const std::uint32_t id : {0x400U, 0x300U, 0x200U}) {
      CHECK(node.takes(id));
    }
    CHECK(!node.takes(0x100));  // 700h may need the last place
    fails ? node.controller.fail() : node.controller.win();
    co::transmit::finish(node.box, node.controller);
    node.drain();
    CHECK(node.controller.sent ==
          (fails ? Ids{0x200, 0x300, 0x400, 0x500, 0x600, 0x700} : Ids{0x700, 0x200, 0x300, 0x400, 0x500, 0x600}));
  }
}

TEST_CASE("transmit mailboxes: frames of one identifier keep their order") {
  Node node;
  node.controller.set_delayed(true);
  CHECK(node.takes("300#01"));
  CHECK(!node.takes("300#02"));
  CHECK(!node.takes("300#R"));
  CHECK(node.takes("200#"));
  CHECK(!node.takes("300#02"));
  node.send_one();
  CHECK(!node.takes("300#02"));
  node.send_one();
  CHECK(node.takes("300#02"));
}

TEST_CASE("transmit mailboxes: no frame overtakes the boot-up message") {
  Node node;
  node.controller.set_delayed(true);
  CHECK(node.takes("705#00"));
  CHECK(!node.takes("085#"));
  node.send_one();
  CHECK(node.takes("085#"));
}

TEST_CASE("transmit mailboxes: dropped frames are not sent, except the one on the wire") {
  for (const bool fails : {false, true}) {
    CAPTURE(fails);
    Node node;
    node.controller.set_delayed(true);
    for (const std::uint32_t id : {0x700U, 0x600U, 0x500U, 0x400U}) {
      CHECK(node.takes(id));
    }
    node.controller.begin();
    co::transmit::drop(node.box, node.controller);
    CHECK(node.takes("705#00"));
    fails ? node.controller.fail() : node.controller.win();
    node.drain();
    CHECK(node.controller.sent == (fails ? Ids{0x705} : Ids{0x400, 0x705}));
  }
}

TEST_CASE("transmit mailboxes: priority is that of the arbitration on the wire") {
  const std::uint32_t ascending[] = {0x000,
                                     CO_IF_FRM_EXT | 0x0003FFFF,
                                     0x123,
                                     0x123 | CO_IF_FRM_RTR,
                                     CO_IF_FRM_EXT | (0x123U << 18),
                                     CO_IF_FRM_EXT | (0x123U << 18) | CO_IF_FRM_RTR,
                                     CO_IF_FRM_EXT | (0x123U << 18) | 1,
                                     0x124,
                                     0x7FF,
                                     CO_IF_FRM_EXT | 0x1FFFFFFF};
  for (std::size_t n = 1; n < sizeof ascending / sizeof ascending[0]; ++n) {
    CAPTURE(n);
    CHECK(co::transmit::rank(ascending[n - 1]) < co::transmit::rank(ascending[n]));
  }
}

}  // namespace
