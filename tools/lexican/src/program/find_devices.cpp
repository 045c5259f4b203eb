// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "program/scan.hpp"

namespace lexican::program {
namespace {

constexpr std::size_t most_in_flight = 8;
constexpr std::uint8_t last_node = 127;
constexpr Micros longest_refusal = 500 * millisecond;
constexpr unsigned upload_response = 2;
constexpr unsigned abort = 4;
constexpr std::uint32_t request_id = 0x600;
constexpr std::uint32_t response_id = 0x580;
constexpr std::uint32_t state_id = 0x700;

struct Request {
  std::uint8_t node;
  Micros sent;
};

CO_IF_FRM upload_of_type(std::uint8_t node) { return {request_id + node, {0x40, 0x00, 0x10, 0x00}, 8}; }

class Search {
 public:
  Search(Line& line, Micros answer_time) : line_(line), answer_time_(answer_time) {}

  std::vector<Found> run() {
    accepted_ = line_.now();
    while ((next_ <= last_node || !open_.empty()) && !line_.is_ended()) {
      send();
      if (!open_.empty()) {
        accepted_ = line_.now();
      } else if (line_.now() - accepted_ >= longest_refusal) {
        break;
      }
      line_.wait(wait_time());
      while (const std::optional<CO_IF_FRM> frame = line_.receive()) {
        process(*frame);
      }
      const Micros now = line_.now();
      open_.erase(std::remove_if(open_.begin(), open_.end(),
                                 [&](const Request& request) { return now - request.sent >= answer_time_; }),
                  open_.end());
    }
    std::vector<Found> found;
    for (const std::optional<Found>& device : devices_) {
      if (device) {
        found.push_back(*device);
      }
    }
    return found;
  }

 private:
  void send() {
    while (next_ <= last_node && open_.size() < most_in_flight && line_.send(upload_of_type(next_))) {
      open_.push_back({next_++, line_.now()});
    }
  }

  Micros wait_time() {
    const bool is_refused = next_ <= last_node && open_.size() < most_in_flight;
    if (is_refused) {
      return millisecond;
    }
    const Micros due = open_.front().sent + answer_time_;
    const Micros now = line_.now();
    return due > now ? due - now : 0;
  }

  void process(const CO_IF_FRM& frame) {
    const std::uint32_t id = frame.Identifier & ~std::uint32_t{0x7F};
    const auto node = static_cast<std::uint8_t>(frame.Identifier & 0x7FU);
    if (node == 0 || (id != response_id && id != state_id)) {
      return;
    }
    if (id == state_id && frame.DLC == 1) {
      device(node).state = static_cast<std::uint8_t>(frame.Data[0] & 0x7FU);
    }
    const unsigned specifier = frame.Data[0] >> 5;
    const bool is_answer = (specifier == upload_response || specifier == abort) && frame.Data[1] == 0x00 &&
                           frame.Data[2] == 0x10 && frame.Data[3] == 0x00;
    if (id == response_id && frame.DLC == 8 && is_answer) {
      Found& found = device(node);
      found.has_type = (frame.Data[0] & 0xE2U) == 0x42U;
      found.device_type = found.has_type ? CO_GET_LONG(&frame, 4) : 0;
      open_.erase(
          std::remove_if(open_.begin(), open_.end(), [=](const Request& request) { return request.node == node; }),
          open_.end());
    }
  }

  Found& device(std::uint8_t node) {
    std::optional<Found>& found = devices_[node];
    if (!found) {
      found = Found{};
      found->node = node;
    }
    return *found;
  }

  Line& line_;
  Micros answer_time_;
  std::uint8_t next_ = 1;
  Micros accepted_ = 0;  ///< last time with a request that the line had accepted and that has not ended
  std::vector<Request> open_;
  std::array<std::optional<Found>, 128> devices_{};
};

}  // namespace

std::vector<Found> find_devices(Line& line, Micros answer_time) { return Search(line, answer_time).run(); }

}  // namespace lexican::program
