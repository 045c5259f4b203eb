// SPDX-License-Identifier: Apache-2.0
// A soak test of one minute, or of LEXICAN_SOAK_MINUTES (environment), on a saturated bus of 1 Mbit/s, with unrelated,
// own, malformed and hostile frames in a fixed pseudo-random order.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <random>
#include <vector>

#include "soak.hpp"
#include "support/callbacks.hpp"
#include "support/network.hpp"
#include "support/notation.hpp"
#include "support/sdo_server_model.hpp"

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using test::Device;
using test::DeviceOptions;
using test::Line;
using test::SdoBytes;
using test::SdoObject;
using test::SdoServerModel;
using test::time_on_bus;
using test::World;
using Micros = std::chrono::microseconds;

enum class State { pre_operational, operational, stopped };

// Returns the objects of a device that the requests name.
std::vector<SdoObject> objects() {
  using Kind = SdoObject::Kind;
  return {
      {0x2000, 0, true, true, Kind::number, 2, {0, 0}},
      {0x2001, 0, true, true, Kind::number, 8, {0, 0, 0, 0, 0, 0, 0, 0}},
      {0x2002, 0, true, false, Kind::number, 4, {0x44, 0x33, 0x22, 0x11}},
      {0x2010, 0, true, true, Kind::domain, 16, test::Bytes(16)},
  };
}

// Expected counters of a node and answers of its SDO server, computed from the frames on its bus.
class Ledger {
 public:
  explicit Ledger(std::uint8_t node_id, bool filter) : request_(0x600u + node_id), node_id_(node_id), filter_(filter) {}

  void hear(const CO_IF_FRM& frame) {
    const bool error = (frame.Identifier & CO_IF_FRM_ERROR) != 0;
    const std::uint32_t id = frame.Identifier & ~CO_IF_FRM_RTR;
    if (!error && filter_ && id != 0 && id != request_ && id != error_control_) {
      return;
    }
    ++received;
    if (error) {
      ++events;
    } else if (id == 0) {
      hear_nmt(frame);
    } else if (id == request_ && state != State::stopped) {
      hear_sdo(frame);
    } else if (id == error_control_) {
      hear_error_control(frame);
    } else {
      ++unclaimed;
    }
  }

  State state = State::pre_operational;
  std::uint32_t received = 0;
  std::uint32_t claimed = 0;
  std::uint32_t unclaimed = 0;
  std::uint32_t malformed = 0;
  std::uint32_t events = 0;
  std::deque<SdoBytes> answers;  // answers not yet on the bus

 private:
  void hear_nmt(const CO_IF_FRM& frame) {
    if (frame.Identifier != 0 || frame.DLC != 2) {
      ++malformed;
      return;
    }
    ++claimed;
    if (frame.Data[1] != 0 && frame.Data[1] != node_id_) {
      return;
    }
    switch (frame.Data[0]) {
      case 1: state = State::operational; break;
      case 2: stop(); break;
      case 128: state = State::pre_operational; break;
      default: break;
    }
  }

  // Processes an SDO request. DLC codes 9…15 mean eight bytes. [ISO 11898-1]
  void hear_sdo(const CO_IF_FRM& frame) {
    if (frame.Identifier != request_ || frame.DLC < 8) {
      ++malformed;
      return;
    }
    ++claimed;
    SdoBytes request{};
    std::copy(std::begin(frame.Data), std::end(frame.Data), request.begin());
    const std::vector<SdoBytes> more = server_.answers(request);
    answers.insert(answers.end(), more.begin(), more.end());
  }

  // Counts a frame with the error control identifier: a node with a heartbeat ignores guard requests, and no other node
  // may use the identifier. [H5]
  void hear_error_control(const CO_IF_FRM& frame) {
    const bool guards = USE_GUARDING != 0 && frame.Identifier != error_control_;
    ++(guards ? claimed : malformed);
  }

  // Aborts transfers without a frame, like the node in Stopped. [N8]
  void stop() {
    state = State::stopped;
    server_.close();
  }

  std::uint32_t request_;
  std::uint32_t error_control_ = request_ + 0x100;
  std::uint8_t node_id_;
  bool filter_;
  SdoServerModel server_{objects(), USE_SDO_BLOCK != 0 ? CO_SDO_BUF_SEG : 0};
};

// A device, and the counters of received and sent frames.
struct Member {
  Member(World& world, Line& line, std::uint8_t node_id, std::uint16_t heartbeat_ms, bool filter)
      : device(world.add_device(line, options(node_id, heartbeat_ms, filter))),
        ledger(node_id, filter),
        period(std::chrono::milliseconds(heartbeat_ms)) {}

  static DeviceOptions options(std::uint8_t node_id, std::uint16_t heartbeat_ms, bool filter) {
    DeviceOptions options{node_id, heartbeat_ms};
    options.filter = filter;
    return options;
  }

  void say(const VirtualBus::Traffic& traffic) {
    const std::uint32_t id = traffic.frame.Identifier;
    if (id == 0x700u + device.node.NodeId) {
      ++heartbeats;
      latest = std::max(latest, traffic.time - period * heartbeats);
      earliest = std::min(earliest, traffic.time - period * heartbeats);
    } else if (id == 0x580u + device.node.NodeId) {
      ++answers;
      aborts += (traffic.frame.Data[0] == 0x80) ? 1 : 0;
      check_answer(traffic.frame);
    }
  }

  void check_answer(const CO_IF_FRM& frame) {
    const bool is_due = !ledger.answers.empty();
    if (!is_due || !std::equal(ledger.answers.front().begin(), ledger.answers.front().end(), frame.Data)) {
      FAIL("not the answer that is due: ", test::notation(frame));
    }
    ledger.answers.pop_front();
  }

  void check(Micros time) const {
    const CO_NODE_COUNTERS counters = device.counters();
    CHECK(counters.Received == ledger.received);
    CHECK(counters.Unclaimed == ledger.unclaimed);
    CHECK(counters.Malformed == ledger.malformed);
    CHECK(counters.Received == ledger.claimed + counters.Unclaimed + counters.Malformed + ledger.events);
    CHECK(counters.CanEvents[CO_CAN_PASSIVE] + counters.CanEvents[CO_CAN_RECOVERED] == ledger.events);
    CHECK(counters.CanEvents[CO_CAN_OVERRUN] == 0);
    CHECK(counters.Dropped == 0);
    CHECK(ledger.answers.empty());
    CHECK(counters.SdoAborts == aborts);
    CHECK(counters.Sent == 1 + heartbeats + answers);  // 1: the boot-up message
    CHECK(heartbeats == time / period);
    CHECK(earliest == Micros(0));
    CHECK(device.port.lost() == 0);
  }

  Device& device;
  Ledger ledger;
  Micros period;
  std::uint32_t heartbeats = 0;
  std::uint32_t answers = 0;
  std::uint32_t aborts = 0;
  Micros latest{0};
  Micros earliest{0};
};

class Soak {
 public:
  explicit Soak(std::uint32_t seed) : random_(seed) {
    line_.bus.set_trace([this](const VirtualBus::Traffic& traffic) { on_bus(traffic); });
    test::callbacks().can_receive = [this](CO_IF_FRM*) { ++not_claimed_; };
    open_.ledger.hear(test::frame("706#00"));  // the first node has received the boot-up message of the second one
  }
  ~Soak() { test::callbacks() = {}; }
  Soak(const Soak&) = delete;
  Soak& operator=(const Soak&) = delete;

  // Runs for \a time. \a frames_per_wake: frames between two calls of the nodes.
  void run(Micros time, unsigned frames_per_wake) {
    while (world_.clock.time() < time) {
      for (unsigned n = 0; n < frames_per_wake; ++n) {
        const CO_IF_FRM frame = any_frame();
        line_.bus.inject(frame);
        (frame.Identifier & CO_IF_FRM_ERROR) != 0 ? hear(frame) : world_.clock.advance(ticks(frame));
        longest_ = std::max(longest_, open_.device.port.waiting());
      }
      world_.settle();
      if (open_.device.port.waiting() + filtered_.device.port.waiting() != 0) {
        FAIL("frames wait that nobody fetches");
      }
      if (world_.clock.time() >= next_question_) {
        ask();
      }
    }
  }

  void check() {
    open_.check(world_.clock.time());
    filtered_.check(world_.clock.time());
    CHECK(not_claimed_ == open_.ledger.unclaimed + filtered_.ledger.unclaimed);
    const std::uint32_t some = open_.ledger.received / 20;  // minimum for each kind of frame
    CHECK(open_.ledger.claimed > some);
    CHECK(open_.ledger.malformed > some);
    CHECK(open_.ledger.unclaimed > some);
    CHECK(open_.ledger.events > 0);
    CHECK(questions_ == world_.clock.time() / 1s);
  }

  std::size_t longest_queue() const { return longest_; }
  Micros latest_heartbeat() const { return std::max(open_.latest, filtered_.latest); }

 private:
  std::uint64_t ticks(const CO_IF_FRM& frame) const { return world_.clock.ticks(time_on_bus(frame)); }

  void hear(const CO_IF_FRM& frame) {
    open_.ledger.hear(frame);
    filtered_.ledger.hear(frame);
  }

  void on_bus(const VirtualBus::Traffic& traffic) {
    for (Member* member : {&open_, &filtered_}) {
      if (traffic.sender == &member->device.port) {
        member->say(traffic);
      } else {
        member->ledger.hear(traffic.frame);
      }
    }
  }

  // Checks that a node that leaves Stopped answers an upload request at once, whatever its state was before. Within a
  // sub-block of a download the request would be a segment, so the client ends that transfer first.
  void ask() {
    line_.say("000#8000");
    for (Member* member : {&open_, &filtered_}) {
      const std::uint32_t before = member->answers;
      const std::uint32_t aborts = member->aborts;
      for (const char* const request : {"600#8000000000000000", "600#4002200000000000"}) {
        CO_IF_FRM frame = test::frame(request);
        frame.Identifier += member->device.node.NodeId;
        line_.say(frame);
      }
      world_.settle();
      REQUIRE(member->answers == before + 1);
      REQUIRE(member->aborts == aborts);
    }
    ++questions_;
    next_question_ += 1s;
  }

  std::uint32_t any(std::size_t below) { return static_cast<std::uint32_t>(random_() % below); }
  std::uint8_t byte() { return static_cast<std::uint8_t>(random_()); }

  void fill(std::uint8_t (&data)[8]) {
    const auto low = random_();
    const auto high = random_();
    for (unsigned n = 0; n < 4; ++n) {
      data[n] = static_cast<std::uint8_t>(low >> (8 * n));
      data[n + 4] = static_cast<std::uint8_t>(high >> (8 * n));
    }
  }

  CO_IF_FRM any_frame() {
    CO_IF_FRM frame{any(0x800), {}, static_cast<std::uint8_t>(any(9))};
    fill(frame.Data);
    switch (any(8)) {
      case 0: frame.Identifier = 0x605; break;
      case 1: return sdo(0x605);
      case 2: return sdo(0x606);
      case 3: return nmt();
      case 4: frame.Identifier |= flags(); break;
      case 5: frame.Identifier = (any(2) != 0 ? 0x605u : 0x000u) | flags(); break;
      default: break;
    }
    const bool legal_length = frame.DLC == 8 && (frame.Identifier & ~0x0Fu) == 0x600;
    frame.DLC = legal_length ? 7 : frame.DLC;  // prevents a random request from writing 1017h
    return (frame.Identifier == 0) ? nmt() : frame;
  }

  std::uint32_t flags() {
    constexpr std::uint32_t all[] = {CO_IF_FRM_EXT, CO_IF_FRM_RTR, CO_IF_FRM_EXT | CO_IF_FRM_RTR};
    return all[any(3)];
  }

  // Returns a request with any command byte, for existing and missing objects.
  CO_IF_FRM sdo(std::uint32_t id) {
    constexpr std::uint8_t usual[] = {0x00, 0x10, 0x0D, 0x1D, 0x20, 0x21, 0x23, 0x2B, 0x40, 0x60, 0x70, 0x80, 0x80,
                                      0x01, 0x02, 0x83, 0xC0, 0xC6, 0xC1, 0xD5, 0xA0, 0xA4, 0xA3, 0xA2, 0xA1};
    constexpr std::uint8_t objects[] = {0x00, 0x01, 0x02, 0x03, 0x10};
    const std::uint8_t command = (any(4) == 0) ? byte() : usual[any(std::size(usual))];
    const std::uint8_t object = objects[any(std::size(objects))];
    const std::uint8_t sub = (any(8) == 0) ? 1 : 0;
    const std::uint8_t size = static_cast<std::uint8_t>(any(17));
    const std::uint8_t dlc = (any(8) == 0) ? static_cast<std::uint8_t>(8 + any(8)) : 8;
    return {id, {command, object, 0x20, sub, size, 0, 0, 0}, dlc};
  }

  // Returns an NMT command, sometimes an invalid one or an error frame; no reset, which would restart the node's
  // counters.
  CO_IF_FRM nmt() {
    constexpr std::uint8_t specifiers[] = {1, 1, 128, 128, 2, 0, 3, 127, 131, 255};
    if (any(64) == 0) {
      return VirtualBus::error_frame(0x004, any(2) != 0 ? 0x20 : 0x40);  // error passive, error active
    }
    const std::uint8_t dlc = (any(4) == 0) ? static_cast<std::uint8_t>(any(9)) : 2;
    const std::uint8_t node_id = static_cast<std::uint8_t>(any(8));
    return {0, {specifiers[any(std::size(specifiers))], node_id}, dlc};
  }

  std::mt19937 random_;
  World world_{1000000, 0xFFF00000};  // ticks are microseconds; the clock wraps after a second
  Line& line_ = world_.add_line("full");
  Member open_{world_, line_, 5, 10, false};
  Member filtered_{world_, line_, 6, 7, true};
  std::uint32_t not_claimed_ = 0;
  std::uint32_t questions_ = 0;
  std::size_t longest_ = 0;
  Micros next_question_ = 1s;
};

}  // namespace

TEST_CASE("soak: a minute at full bus load: every frame counted, heartbeats on time, no queue grows [T16]") {
  Soak soak(20160);
  soak.run(test::soak_time(), 1);
  soak.check();
  CHECK(soak.longest_queue() <= 2);
  CHECK(soak.latest_heartbeat() <= 131us);  // duration of the longest frame: the nodes run between two frames
}

TEST_CASE("soak: nodes that are called only after 50 frames lose no frame and no phase [T16]") {
  Soak soak(31168);
  soak.run(10s, 50);
  soak.check();
  CHECK(soak.longest_queue() <= 52);
  CHECK(soak.latest_heartbeat() <= 50 * 131us);
}
