// SPDX-License-Identifier: Apache-2.0
// Driver of the ZynqMP CAN controllers, for behaviour that QEMU (tests/drivers/zynqmp) does not model: arbitration,
// error states.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "acceptance.hpp"
#include "co_can_zynqmp.h"
#include "co_core.h"
#include "support/notation.hpp"
#include "support/zynqmp_model.hpp"
#include "virtual_clock.hpp"
#include "zynqmp_rates.hpp"

namespace {

using co::zynqmp::Register;
using test::frame;
using test::notation;
using test::ZynqmpModel;
using Ids = std::vector<std::uint32_t>;

constexpr std::uint16_t queue_frames = 4;
constexpr auto& rates = co::zynqmp_rates<24000000, 125000, 500000>;

// A controller model and its driver, on the bus.
class Controller {
 public:
  Controller() {
    can.Registers = model.address();
    can.Rates = rates.data();
    can.RateNum = rates.size();
    can.Frames = frames_;
    can.FrameNum = queue_frames;
    ZynqmpCanDriver.Init(&can);
    ZynqmpCanDriver.Enable(&can, 500000);
  }

  std::int16_t send(const char* text) {
    const CO_IF_FRM frm = frame(text);
    return ZynqmpCanDriver.Send(&can, &frm);
  }
  bool accepts(const char* text) { return send(text) == sizeof(CO_IF_FRM); }

  /// Returns the next received frame, else the result of Read.
  std::string read() {
    CO_IF_FRM frm{};
    const std::int16_t result = ZynqmpCanDriver.Read(&can, &frm);
    return result == sizeof frm ? notation(frm) : std::to_string(result);
  }

  /// Calls the interrupt function if the controller requests an interrupt.
  void interrupt() {
    if (model.interrupt()) {
      COCanZynqmpInterrupt(&can);
    }
  }

  /// Transmits all waiting frames.
  void drain() {
    for (unsigned n = 0; n < 100; ++n) {
      model.begin();
      model.win();
    }
    interrupt();
  }

  ZynqmpModel model;
  CO_CAN_ZYNQMP can{};

 private:
  CO_IF_FRM frames_[queue_frames]{};
};

// Transmitting --------------------------------------------------------------------------------------------------------

TEST_CASE("ZynqMP CAN: a frame of higher priority can precede because the controller gets one frame at a time") {
  for (const bool level : {false, true}) {
    Controller node;
    node.model.level = level;
    CHECK(node.accepts("300#"));
    CHECK(node.send("200#") == 0);
    node.model.begin();
    CHECK(node.send("080#") == 0);  // 300h is being transmitted and cannot be overtaken
    node.model.win();
    node.interrupt();
    CHECK(node.accepts("080#"));
    node.drain();
    CHECK(node.accepts("200#"));
    node.drain();
    CHECK(node.model.sent == Ids{0x300, 0x080, 0x200});
  }
}

TEST_CASE("ZynqMP CAN: a frame that has lost the arbitration is overtaken by every frame of higher priority") {
  Controller node;
  CHECK(node.accepts("300#"));
  node.model.begin();
  node.model.lose();
  CHECK(node.send("300#01") == 0);  // frames of one identifier keep their order
  CHECK(node.send("301#") == 0);
  CHECK(node.accepts("100#"));
  CHECK(node.model.waiting() == 2);
  CHECK(node.send("080#") == 0);  // 100h is the next frame
  node.model.begin();
  node.model.lose();
  CHECK(node.send("080#") == 0);  // the high priority buffer is full
  node.model.begin();
  node.model.win();
  CHECK(node.model.sent == Ids{0x100});
  node.model.begin();
  node.model.lose();
  CHECK(node.accepts("080#"));
  node.model.begin();
  node.model.win();
  CHECK(node.model.sent == Ids{0x100, 0x080});
  node.drain();
  CHECK(node.accepts("300#01"));
  node.drain();
  CHECK(node.model.sent == Ids{0x100, 0x080, 0x300, 0x300});
}

TEST_CASE("ZynqMP CAN: a frame on the wire is not overtaken after an earlier frame has lost the arbitration") {
  Controller node;
  CHECK(node.accepts("300#"));
  node.model.begin();
  node.model.lose();
  node.drain();
  CHECK(node.accepts("301#"));
  node.model.begin();
  CHECK(node.send("080#") == 0);
  node.model.lose();
  CHECK(node.accepts("080#"));
  node.model.begin();
  node.model.win();
  node.model.begin();
  CHECK(node.send("081#") == 0);
}

TEST_CASE("ZynqMP CAN: 11-bit identifiers overtake 29-bit ones of the same base and data frames remote frames") {
  Controller node;
  CHECK(node.accepts("0C000000#"));  // base identifier 300h
  node.model.begin();
  node.model.lose();
  CHECK(node.send("0C000001#") == 0);
  CHECK(node.accepts("300#"));
  node.drain();
  CHECK(node.accepts("300#R"));
  node.model.begin();
  node.model.lose();
  CHECK(node.accepts("300#"));
}

TEST_CASE("ZynqMP CAN: the boot-up message is not overtaken but a heartbeat is [301:7.3.2.2.1]") {
  Controller node;
  CHECK(node.accepts("705#00"));
  node.model.begin();
  node.model.lose();
  CHECK(node.send("080#") == 0);
  node.drain();
  CHECK(node.accepts("705#7F"));
  node.model.begin();
  node.model.lose();
  CHECK(node.accepts("080#"));
  node.drain();
  CHECK(node.model.sent == Ids{0x705, 0x080, 0x705});
}

TEST_CASE("ZynqMP CAN: a frame that is transmitted at once does not block the next one") {
  for (const bool level : {false, true}) {
    Controller node;
    node.model.level = level;
    node.model.instant = true;
    for (unsigned n = 0; n < 10; ++n) {
      CHECK(node.accepts("300#"));
    }
    CHECK(node.model.sent.size() == 10);
  }
}

// In each register access in turn, the transmission ends, without or with the interrupt.
TEST_CASE("ZynqMP CAN: a transmission that ends at any register access blocks no frame") {
  for (const bool level : {false, true}) {
    for (unsigned moment = 0; moment < 16; ++moment) {
      for (const bool with_interrupt : {false, true}) {
        Controller node;
        node.model.level = level;
        unsigned access = 0;
        node.model.between = [&] {
          if (access++ == moment) {
            node.model.begin();
            node.model.win();
            if (with_interrupt) {
              COCanZynqmpInterrupt(&node.can);
            }
          }
        };
        CAPTURE(level);
        CAPTURE(moment);
        CAPTURE(with_interrupt);
        CHECK(node.accepts("300#"));
        node.model.between = nullptr;
        node.drain();
        CHECK(node.accepts("301#"));
        node.drain();
        CHECK(node.model.sent == Ids{0x300, 0x301});
      }
    }
  }
}

TEST_CASE("ZynqMP CAN: the end of a transmission interrupts once and an empty FIFO does not interrupt") {
  Controller node;
  CHECK_FALSE(node.model.interrupt());
  CHECK(node.accepts("300#"));
  CHECK_FALSE(node.model.interrupt());
  node.model.begin();
  node.model.win();
  CHECK(node.model.interrupt());
  COCanZynqmpInterrupt(&node.can);
  CHECK_FALSE(node.model.interrupt());
}

TEST_CASE("ZynqMP CAN: an identifier above 7FFh is sent with 29 bits and a DLC above 8 as 8") {
  Controller node;
  CO_IF_FRM frm = {0x800, {1, 2, 3, 4, 5, 6, 7, 8}, 15};
  CHECK(ZynqmpCanDriver.Send(&node.can, &frm) > 0);
  node.drain();
  REQUIRE(node.model.sent_words.size() == 1);
  const ZynqmpModel::Words& words = node.model.sent_words[0];
  CHECK(words[0] == ((1U << 20) | (1U << 19) | (0x800U << 1)));  // base identifier 0, SRR, IDE, identifier extension
  CHECK(words[1] == 8U << 28);
  CHECK(words[2] == 0x01020304);
  CHECK(words[3] == 0x05060708);
}

// Receiving -----------------------------------------------------------------------------------------------------------

TEST_CASE("ZynqMP CAN: data and remote frames of both formats are received and a DLC above 8 means 8 [ISO 11898-1]") {
  Controller node;
  node.model.receive({0x123U << 21, 15U << 28, 0x01020304, 0x05060708});
  node.model.receive({(0x123U << 21) | (1U << 20), 0, 0, 0});
  node.model.receive({(0x7FFU << 21) | (1U << 20) | (1U << 19) | (0x3FFFFU << 1), 2U << 28, 0xAABB0000, 0});
  node.model.receive({(0x001U << 21) | (1U << 20) | (1U << 19) | (1U << 1) | 1U, 0, 0, 0});
  node.interrupt();
  CHECK(node.read() == "123#0102030405060708");
  CHECK(node.read() == "123#R");
  CHECK(node.read() == "1FFFFFFF#AABB");
  CHECK(node.read() == "00040001#R");
  CHECK(node.read() == "0");
}

TEST_CASE("ZynqMP CAN: frames lost by a full queue or FIFO are reported once before the remaining frames") {
  Controller node;
  for (unsigned n = 0; n < queue_frames + 3; ++n) {
    node.model.receive(0x100 + n);
  }
  node.interrupt();
  CHECK(COCanZynqmpLost(&node.can) == 3);
  CHECK(node.read() == "20000204#0001000000000000");
  CHECK(node.read() == "100#");
  for (unsigned n = 0; n < 66; ++n) {
    node.model.receive(0x200 + n);
  }
  node.interrupt();
  CHECK(COCanZynqmpLost(&node.can) == 3 + 63 + 1);
  CHECK(node.read() == "20000204#0001000000000000");
  CHECK(node.read() == "101#");
  CHECK(node.read() == "102#");
  CHECK(node.read() == "103#");
  CHECK(node.read() == "200#");
  CHECK(node.read() == "0");
  CHECK_FALSE(node.model.interrupt());
  ZynqmpCanDriver.Reset(&node.can);
  CHECK(COCanZynqmpLost(&node.can) == 0);
  CHECK(node.read() == "0");
}

// Error states --------------------------------------------------------------------------------------------------------

TEST_CASE("ZynqMP CAN: error passive and its end are reported once each") {
  Controller node;
  CHECK(node.read() == "0");
  node.model.set_state(co::zynqmp::error_passive);
  CHECK(node.read() == "20000204#0030000000000000");
  CHECK(node.read() == "0");
  node.model.set_state(co::zynqmp::error_active);
  CHECK(node.read() == "20000204#0040000000000000");
  CHECK(node.read() == "0");
}

TEST_CASE("ZynqMP CAN: after bus-off the controller is off the bus until a reset and recovers when error active") {
  Controller node;
  CHECK(node.accepts("300#"));
  node.model.go_bus_off();
  CHECK(node.model.interrupt());
  node.interrupt();
  CHECK_FALSE(node.model.interrupt());
  CHECK_FALSE(node.model.on_bus());
  CHECK(node.send("080#") == -1);
  CHECK(node.read() == "20000240#0000000000000000");
  CHECK(node.read() == "0");
  ZynqmpCanDriver.Reset(&node.can);
  CHECK(node.model.on_bus());
  CHECK(node.model.waiting() == 0);
  node.model.set_state(0);  // waiting for the bus
  CHECK(node.read() == "0");
  node.model.set_state(co::zynqmp::error_active);
  CHECK(node.read() == "20000300#0000000000000000");
  CHECK(node.read() == "0");
  CHECK(node.accepts("080#"));
  node.drain();
  CHECK(node.model.sent == Ids{0x080});
}

TEST_CASE("ZynqMP CAN: a recovery from bus-off to error passive reports both and Enable clears the error states") {
  Controller node;
  node.model.go_bus_off();
  node.interrupt();
  CHECK(node.read() == "20000240#0000000000000000");
  ZynqmpCanDriver.Reset(&node.can);
  node.model.set_state(co::zynqmp::error_passive);
  CHECK(node.read() == "20000304#0030000000000000");
  node.model.go_bus_off();
  node.interrupt();
  ZynqmpCanDriver.Enable(&node.can, 125000);
  CHECK(node.model.on_bus());
  CHECK(node.read() == "0");
}

TEST_CASE("ZynqMP CAN: frames received before bus-off are read and an overrun is reported with bus-off") {
  Controller node;
  for (unsigned n = 0; n < queue_frames + 1; ++n) {
    node.model.receive(0x100 + n);
  }
  node.model.go_bus_off();
  node.interrupt();
  CHECK(node.read() == "20000244#0001000000000000");
  CHECK(node.read() == "100#");
}

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
};

TEST_CASE("ZynqMP CAN: the node counts bus-off and sends EMCY 8140h after the recovery by COIfCanReset [301:7.2.7.1]") {
  Controller controller;
  CO_NODE node;
  co::VirtualClock clock;
  co::VirtualTimer timer(clock, [&] { COTmrService(&node.Tmr); });
  CO_NODE_EXT ext{};
  ext.Size = sizeof ext;
  ext.Can = &ZynqmpCanDriver;
  ext.CanCtx = &controller.can;
  ext.Timer = &co::VirtualTimerDriver;
  ext.TimerCtx = &timer;
  CO_NODE_SPEC spec{};
  spec.NodeId = 1;
  spec.Baudrate = 500000;
  spec.Dict = const_cast<CO_OBJ*>(od);
  spec.DictLen = sizeof od / sizeof od[0];
  spec.TmrFreq = 1000;
  CONodeInitEx(&node, &spec, &ext);
  const auto run = [&] {
    for (unsigned n = 0; n < 5; ++n) {
      CONodeProcess(&node);
      controller.drain();
    }
  };
  CONodeStart(&node);
  run();
  controller.model.go_bus_off();
  controller.interrupt();
  run();
  CHECK(CONodeGetCounters(&node).CanEvents[CO_CAN_BUS_OFF] == 1);
  CHECK(controller.model.sent == Ids{0x701});
  COIfCanReset(&node.If);
  run();
  CHECK(CONodeGetCounters(&node).CanEvents[CO_CAN_RECOVERED] == 1);
  REQUIRE(controller.model.sent == Ids{0x701, 0x081, 0x081});
  CHECK(controller.model.sent_words[1][2] == 0x40811100);
  CHECK(controller.model.sent_words[2][2] == 0x00000000);
  CONodeStop(&node);
  CHECK_FALSE(controller.model.on_bus());
}

// On and off the bus --------------------------------------------------------------------------------------------------

TEST_CASE("ZynqMP CAN: a reset discards received frames and the frame in the controller is still sent [T14]") {
  Controller node;
  CHECK(node.accepts("585#01"));
  node.model.begin();
  for (unsigned n = 0; n < 100; ++n) {
    node.model.receive(0x100);
  }
  node.interrupt();
  for (unsigned n = 0; n < 100; ++n) {
    node.model.receive(0x101);
  }
  ZynqmpCanDriver.Reset(&node.can);
  CHECK(node.read() == "0");
  CHECK(node.send("705#00") == 0);
  CHECK_FALSE(node.model.interrupt());
  node.model.win();
  CHECK(node.model.interrupt());
  node.interrupt();
  CHECK(node.accepts("705#00"));
  node.drain();
  CHECK(node.model.sent == Ids{0x585, 0x705});
  CHECK(node.read() == "0");
  CHECK(COCanZynqmpLost(&node.can) == 0);
}

TEST_CASE("ZynqMP CAN: a reset in bus-off discards all frames and keeps filters and bit rate") {
  Controller node;
  const std::uint32_t id = 0x123;
  ZynqmpCanDriver.Filter(&node.can, &id, 1);
  CHECK(node.accepts("300#"));
  node.model.receive(0x123);
  node.interrupt();
  node.model.receive(0x123);
  node.model.go_bus_off();
  node.interrupt();
  CHECK(node.read() == "20000240#0000000000000000");
  ZynqmpCanDriver.Reset(&node.can);
  CHECK_FALSE(node.model.interrupt());
  CHECK(node.model.waiting() == 0);
  CHECK(node.read() == "20000300#0000000000000000");
  CHECK(node.read() == "0");
  CHECK(node.model.value(Register::prescaler) == 2);
  CHECK(node.model.value(Register::bit_timing) == 0x9C);
  node.model.receive(0x124);
  node.model.receive(0x123);
  node.interrupt();
  CHECK(node.read() == "123#");
  CHECK(node.read() == "0");
  CHECK(node.accepts("300#"));
}

TEST_CASE("ZynqMP CAN: the driver waits for a limited time until a reset or a change of filters is complete") {
  const Ids ids = {0x123, 0x456};
  for (const unsigned latency : {3U, 100000U}) {
    Controller node;
    node.model.latency = latency;
    ZynqmpCanDriver.Init(&node.can);
    ZynqmpCanDriver.Filter(&node.can, ids.data(), 2);
    ZynqmpCanDriver.Enable(&node.can, 125000);
    ZynqmpCanDriver.Filter(&node.can, ids.data(), 1);
    if (latency < 100) {
      CHECK(node.model.on_bus());
      CHECK(node.model.value(Register::prescaler) == 11);
      CHECK(node.model.value(Register::filters_used) == 1);
      node.model.receive(0x456);
      node.model.receive(0x123);
      node.interrupt();
      CHECK(node.read() == "123#");
      CHECK(node.read() == "0");
    }
  }
}

TEST_CASE("ZynqMP CAN: after Close or with an unknown bit rate it is off the bus and interrupts have no effect") {
  Controller node;
  for (const bool by_close : {true, false}) {
    if (by_close) {
      ZynqmpCanDriver.Close(&node.can);
    } else {
      ZynqmpCanDriver.Enable(&node.can, 100000);
    }
    CHECK_FALSE(node.model.on_bus());
    CHECK(node.send("300#") == -1);
    CHECK(node.read() == "0");
    COCanZynqmpInterrupt(&node.can);
    CHECK(node.model.enabled() == 0);
    ZynqmpCanDriver.Reset(&node.can);
    CHECK_FALSE(node.model.on_bus());
    ZynqmpCanDriver.Enable(&node.can, 125000);
    CHECK(node.model.on_bus());
    CHECK(node.model.value(Register::prescaler) == 11);
  }
}

TEST_CASE("ZynqMP CAN: the controller sleeps unless a frame is being sent or the driver is closed") {
  Controller node;
  CHECK(node.accepts("300#"));
  COCanZynqmpSleep(&node.can);
  CHECK(node.model.value(Register::mode_select) == 0);
  node.drain();
  COCanZynqmpSleep(&node.can);
  CHECK(node.model.value(Register::mode_select) == co::zynqmp::sleep_mode);
  ZynqmpCanDriver.Close(&node.can);
  COCanZynqmpSleep(&node.can);
  CHECK(node.model.value(Register::mode_select) == 0);
}

TEST_CASE("ZynqMP CAN: null pointers are accepted") {
  COCanZynqmpInterrupt(nullptr);
  COCanZynqmpSleep(nullptr);
  CHECK(COCanZynqmpLost(nullptr) == 0);
}

// Filters -------------------------------------------------------------------------------------------------------------

bool passes(const co::zynqmp::Acceptance& all, std::uint32_t word) {
  bool pass = all.number == 0;
  for (unsigned n = 0; n < all.number; ++n) {
    pass = pass || ((all.filter[n].word ^ word) & all.filter[n].mask) == 0;
  }
  return pass;
}

unsigned standard_ids_that_pass(const co::zynqmp::Acceptance& all) {
  unsigned number = 0;
  for (std::uint32_t id = 0; id < 0x800; ++id) {
    number += passes(all, id << 21) ? 1U : 0U;
  }
  return number;
}

TEST_CASE("ZynqMP CAN filters: up to four different identifiers match exactly and an empty list passes all frames") {
  const Ids ids = {0x000, 0x123, 0x123, 0x605, 0x7E5};
  const auto all = co::zynqmp::acceptance_of(ids.data(), 5);
  CHECK(all.number == 4);
  CHECK(standard_ids_that_pass(all) == 4);
  CHECK_FALSE(passes(all, co::zynqmp::identifier_word(0x80000123)));
  CHECK(co::zynqmp::acceptance_of(nullptr, 0).number == 0);
}

TEST_CASE("ZynqMP CAN filters: a usual slave receives its nine identifiers and no others") {
  const Ids ids = {0x000, 0x080, 0x205, 0x305, 0x405, 0x505, 0x605, 0x705, 0x7E5};
  const auto all = co::zynqmp::acceptance_of(ids.data(), 9);
  CHECK(standard_ids_that_pass(all) == 9);
}

TEST_CASE("ZynqMP CAN filters: of five identifiers those two share a filter that then passes the fewest others") {
  std::mt19937 random(2);
  for (unsigned round = 0; round < 200; ++round) {
    Ids ids(5);
    for (std::uint32_t& id : ids) {
      id = random() & 0x7FF;
    }
    unsigned fewest = 0x800;
    for (unsigned a = 0; a < 5; ++a) {
      for (unsigned b = a + 1; b < 5; ++b) {
        unsigned others = 1;
        for (std::uint32_t different = ids[a] ^ ids[b]; different != 0; different &= different - 1) {
          others *= 2;
        }
        fewest = std::min(fewest, others);
      }
    }
    const auto all = co::zynqmp::acceptance_of(ids.data(), 5);
    CHECK(all.number == 4);
    unsigned widths = 0;
    for (unsigned n = 0; n < 4; ++n) {
      widths += standard_ids_that_pass({{all.filter[n]}, 1});
    }
    CHECK(widths == fewest + 3);
  }
}

TEST_CASE("ZynqMP CAN filters: wide filters are merged instead of narrow ones if that passes fewer frames") {
  const Ids ids = {0, 1, 2, 3, 4, 5, 6, 7, 0x100, 0x20F, 0x43C};
  const auto all = co::zynqmp::acceptance_of(ids.data(), static_cast<std::uint16_t>(ids.size()));
  CHECK(standard_ids_that_pass(all) == 11);
}

TEST_CASE("ZynqMP CAN filters: data and remote frames of all requested identifiers pass for any number of them") {
  std::mt19937 random(1);
  for (unsigned round = 0; round < 300; ++round) {
    Ids ids(random() % 40 + 1);
    for (std::uint32_t& id : ids) {
      id = random() % 4 == 0 ? (random() & CO_IF_FRM_ID) | CO_IF_FRM_EXT : random() & 0x7FF;
    }
    const auto all = co::zynqmp::acceptance_of(ids.data(), static_cast<std::uint16_t>(ids.size()));
    CHECK(all.number <= 4);
    for (const std::uint32_t id : ids) {
      const std::uint32_t word = co::zynqmp::identifier_word(id);
      const bool is_extended = (id & CO_IF_FRM_EXT) != 0;
      CHECK(passes(all, word | (is_extended ? 1U << 20 : 0U)));
      CHECK(passes(all, word | (1U << 20) | (is_extended ? 1U : 0U)));
    }
  }
}

}  // namespace
