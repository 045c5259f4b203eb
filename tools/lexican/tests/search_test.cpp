// SPDX-License-Identifier: Apache-2.0
// The search of lexican scan, on a simulated bus with a virtual clock.
#include "program/search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "frame_bits.hpp"
#include "virtual_network.hpp"

namespace {

using namespace lexican;
using program::Answers;
using program::Found;
using program::request_answers;

constexpr Micros answer_time = 80 * millisecond;

CO_IF_FRM answer_of(std::uint8_t node, std::uint32_t type = 0x00020192) {
  CO_IF_FRM frame{0x580U + node, {0x43, 0x00, 0x10, 0x00}, 8};
  CO_SET_LONG(&frame, type, 4);
  return frame;
}

CO_IF_FRM state_of(std::uint8_t node, std::uint8_t state) { return {0x700U + node, {state}, 1}; }

std::vector<int> to_vector(const CO_IF_FRM& frame) { return {frame.Data, frame.Data + frame.DLC}; }

/// A wire on which each frame takes its time at 500 kbit/s, with devices that answer after a processing time.
class Wire : public program::Line {
 public:
  bool send(const CO_IF_FRM& frame) override {
    ++attempts;
    if (refuses && refuses(*this)) {
      return false;
    }
    CHECK(frame.DLC == 8);
    const bool is_lss = frame.Identifier == 0x7E5;
    const auto node = is_lss ? std::uint8_t{0} : static_cast<std::uint8_t>(frame.Identifier - 0x600);
    if (is_lss) {
      CHECK(to_vector(frame) == std::vector<int>{0x4C, 0, 0, 0, 0, 0, 0, 0});
      if (has_unconfigured) {
        put({0x7E4, {0x50}, 8}, now_ + processing);
      }
      return true;
    }
    CHECK(node >= 1);
    CHECK(node <= 127);
    CHECK(requests.insert(node).second);
    end_requests_until_now();
    in_flight_.emplace(node, now_ + answer_time);
    most_in_flight = std::max(most_in_flight, in_flight_.size());
    const Micros end = occupy(frame, now_);
    if (devices.count(node) != 0) {
      for (const CO_IF_FRM& answer : answers(node)) {
        put(answer, end + processing);
      }
    }
    return true;
  }
  std::optional<CO_IF_FRM> receive() override {
    if (arriving_.empty() || arriving_.begin()->first > now_) {
      return std::nullopt;
    }
    const CO_IF_FRM frame = arriving_.begin()->second;
    arriving_.erase(arriving_.begin());
    in_flight_.erase(static_cast<std::uint8_t>(frame.Identifier & 0x7FU));
    return frame;
  }
  Micros now() override { return now_; }
  void wait(Micros time) override {
    const Micros end = now_ + time;
    now_ = !arriving_.empty() && arriving_.begin()->first < end ? std::max(now_, arriving_.begin()->first) : end;
  }
  bool is_ended() override { return now_ >= ended_at; }

  /// A frame of another node, at a time.
  void put(const CO_IF_FRM& frame, Micros time) { arriving_.emplace(occupy(frame, time), frame); }

  std::set<unsigned> devices;
  bool has_unconfigured = false;
  std::function<std::vector<CO_IF_FRM>(std::uint8_t)> answers = [](std::uint8_t node) {
    return std::vector<CO_IF_FRM>{answer_of(node)};
  };
  std::function<bool(Wire&)> refuses;
  Micros processing = 500;
  Micros ended_at = for_ever;
  unsigned attempts = 0;
  std::size_t most_in_flight = 0;
  std::set<unsigned> requests;

 private:
  void end_requests_until_now() {
    for (auto at = in_flight_.begin(); at != in_flight_.end();) {
      at = at->second <= now_ ? in_flight_.erase(at) : std::next(at);
    }
  }
  Micros occupy(const CO_IF_FRM& frame, Micros from) {
    const Micros bits = co::frame_bits(frame) + co::intermission_bits;
    free_ = std::max(free_, from) + bits * second / VirtualNetwork::bit_rate;
    return free_;
  }

  Micros now_ = second;
  Micros free_ = 0;
  std::multimap<Micros, CO_IF_FRM> arriving_;
  std::map<std::uint8_t, Micros> in_flight_;  // node-ID and end of the time for its answer
};

std::vector<unsigned> nodes(const std::vector<Found>& found) {
  std::vector<unsigned> result;
  std::transform(found.begin(), found.end(), std::back_inserter(result), [](const Found& each) { return each.node; });
  return result;
}

using Nodes = std::vector<unsigned>;

}  // namespace

TEST_CASE("scan: the search finds 127, 2 or no devices within 1.4 s, with at most eight requests in flight") {
  std::set<unsigned> all;
  for (unsigned node = 1; node <= 127; ++node) {
    all.insert(node);
  }
  for (const std::set<unsigned>& devices : {all, std::set<unsigned>{5, 127}, std::set<unsigned>{}}) {
    CAPTURE(devices.size());
    Wire wire;
    wire.devices = devices;
    const Micros begin = wire.now();
    const std::vector<Found> found = request_answers(wire, answer_time).devices;
    CHECK(nodes(found) == Nodes(devices.begin(), devices.end()));
    CHECK(wire.now() - begin <= 1'400 * millisecond);
    CHECK(wire.most_in_flight == 8);
    CHECK(wire.requests.size() == 127);
    for (const Found& device : found) {
      CHECK(device.has_type);
      CHECK(device.device_type == 0x00020192);
      CHECK(!device.state);
    }
  }
}

TEST_CASE("scan: devices that answer in the last moment are found") {
  Wire wire;
  wire.devices = {1, 8, 9, 127};
  wire.processing = answer_time - 5 * millisecond;
  CHECK(nodes(request_answers(wire, answer_time).devices) == Nodes{1, 8, 9, 127});
  CHECK(wire.most_in_flight == 8);
}

TEST_CASE("scan: error control shows the state, also of a device without SDO server") {
  Wire wire;
  wire.devices = {5};
  wire.put(state_of(5, 0x05), wire.now());
  wire.put(state_of(9, 0x7F), wire.now());
  wire.put(state_of(10, 0x84), wire.now());  // with the toggle bit of guarding
  const std::vector<Found> found = request_answers(wire, answer_time).devices;
  REQUIRE(nodes(found) == Nodes{5, 9, 10});
  CHECK(found[0].has_type);
  CHECK(found[0].state == std::uint8_t{0x05});
  CHECK(!found[1].has_type);
  CHECK(found[1].state == std::uint8_t{0x7F});
  CHECK(found[2].state == std::uint8_t{0x04});
}

TEST_CASE("scan: a device that refuses 1000h is found without a type") {
  Wire wire;
  wire.devices = {5};
  wire.answers = [](std::uint8_t node) {
    return std::vector<CO_IF_FRM>{{0x580U + node, {0x80, 0x00, 0x10, 0x00, 0x00, 0x00, 0x02, 0x06}, 8}};
  };
  const std::vector<Found> found = request_answers(wire, answer_time).devices;
  REQUIRE(nodes(found) == Nodes{5});
  CHECK(!found[0].has_type);
  CHECK(found[0].device_type == 0);
}

TEST_CASE("scan: malformed and unrelated frames are no answers") {
  Wire wire;
  wire.devices = {5};
  wire.answers = [](std::uint8_t node) {
    const std::uint32_t id = 0x580U + node;
    CO_IF_FRM shorter = answer_of(node);
    shorter.DLC = 7;
    return std::vector<CO_IF_FRM>{
        shorter,
        {id, {0x43, 0x01, 0x10, 0x00}, 8},                    // another object
        {id, {0x43, 0x00, 0x10, 0x01}, 8},                    // another sub-index
        {id, {0x60, 0x00, 0x10, 0x00}, 8},                    // of a download
        {id, {0x00, 0x00, 0x10, 0x00}, 8},                    // a segment
        {id | CO_IF_FRM_EXT, {0x43, 0x00, 0x10, 0x00}, 8},    // 29 bits
        {id | CO_IF_FRM_RTR, {0x43, 0x00, 0x10, 0x00}, 8},    // remote
        {id | CO_IF_FRM_ERROR, {0x43, 0x00, 0x10, 0x00}, 8},  // error frame
        {0x580, {0x43, 0x00, 0x10, 0x00}, 8},                 // node-ID 0
        {0x700, {0x05}, 1},                                   // node-ID 0
        {0x700U + node, {0x05, 0x00}, 2},                     // no error control message
        {0x600U + node, {0x43, 0x00, 0x10, 0x00}, 8},         // of a client
        {0x180U + node, {0x43, 0x00, 0x10, 0x00}, 8},         // a PDO
    };
  };
  CHECK(request_answers(wire, answer_time).devices.empty());
  CHECK(wire.requests.size() == 127);
}

TEST_CASE("scan: an answer to another client counts, and the request of this one is sent nevertheless") {
  Wire wire;
  wire.put(answer_of(100, 401), wire.now());
  const std::vector<Found> found = request_answers(wire, answer_time).devices;
  REQUIRE(nodes(found) == Nodes{100});
  CHECK(found[0].device_type == 401);
  CHECK(wire.requests.count(100) == 1);
}

TEST_CASE("scan: requests that the full queue refuses are sent later") {
  Wire wire;
  wire.devices = {1, 64, 127};
  wire.refuses = [](const Wire& at) { return at.attempts % 3 != 0; };
  CHECK(nodes(request_answers(wire, answer_time).devices) == Nodes{1, 64, 127});
  CHECK(wire.requests.size() == 127);
}

TEST_CASE("scan: the search ends half a second after the queue has become full for ever") {
  for (const unsigned accepted : {0U, 5U, 10U}) {
    CAPTURE(accepted);
    Wire wire;
    wire.refuses = [=](const Wire& at) { return at.requests.size() >= accepted; };
    const Micros begin = wire.now();
    CHECK(request_answers(wire, answer_time).devices.empty());
    CHECK(wire.requests.size() == accepted);
    CHECK(wire.now() - begin >= 500 * millisecond);
    CHECK(wire.now() - begin <= 700 * millisecond);
  }
}

TEST_CASE("scan: an interruption ends the search") {
  Wire wire;
  wire.devices = {1, 127};
  wire.ended_at = wire.now() + 200 * millisecond;
  CHECK(nodes(request_answers(wire, answer_time).devices) == Nodes{1});
  CHECK(wire.now() <= wire.ended_at + answer_time);
}

TEST_CASE("scan: a device without node-ID is noticed by its answer") {
  Wire wire;
  wire.devices = {5};
  CHECK(!request_answers(wire, answer_time).has_unconfigured);
  Wire other;
  other.has_unconfigured = true;
  const Answers answers = request_answers(other, answer_time);
  CHECK(answers.has_unconfigured);
  CHECK(answers.devices.empty());
}

TEST_CASE("scan: 127 devices, and 2 among 127 node-IDs, are identified within 1.5 s at 500 kbit/s") {
  for (const unsigned step : {1U, 126U}) {
    CAPTURE(step);  // 126: devices 1 and 127
    VirtualNetwork network;
    for (unsigned node = 1; node <= 127; node += step) {
      network.add(static_cast<std::uint8_t>(node), 0x1A0 + node);
    }
    program::HostLine line(network);
    const Micros begin = network.now();
    const program::Devices found = program::find_devices(network, line, 80);
    MESSAGE(found.devices.size() << " devices: " << (network.now() - begin) / millisecond << " ms");
    CHECK(network.now() - begin <= 1'500 * millisecond);
    REQUIRE(found.devices.size() == (127 + step - 1) / step);
    for (const program::Device& device : found.devices) {
      CHECK(device.found.device_type == 0x00020192);
      CHECK(device.vendor == std::uint32_t{0xB7});
      CHECK(device.product == std::uint32_t{0x2001});
      CHECK(device.serial == 0x1A0 + device.found.node);
      CHECK(device.name == "SD-400 servo drive");
    }
    CHECK(found.unconfigured.empty());
    CHECK(found.lss_fault.empty());
  }
}

TEST_CASE("scan: devices without node-ID are listed by their LSS address, and remain unconfigured") {
  VirtualNetwork network;
  network.add(5, 0x1A2);
  network.add(CO_LSS_NO_NODE_ID, 0x1A9);
  network.add(CO_LSS_NO_NODE_ID, 0x1A7);
  for (unsigned n = 0; n < 2; ++n) {
    program::HostLine line(network);
    const program::Devices found = program::find_devices(network, line, 80);
    CAPTURE(n);
    CHECK(found.devices.size() == 1);
    CHECK(found.unconfigured == std::vector<LssAddress>{{0xB7, 0x2001, 3, 0x1A7}, {0xB7, 0x2001, 3, 0x1A9}});
    CHECK(found.lss_fault == "");
  }
}
