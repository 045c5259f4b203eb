// SPDX-License-Identifier: Apache-2.0
#include "program/search.hpp"

#include <algorithm>

#include "client/lss.hpp"
#include "client/sdo_client.hpp"

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
constexpr std::uint32_t lss_request_id = 0x7E5;
constexpr std::uint32_t lss_response_id = 0x7E4;
constexpr std::uint8_t identify_unconfigured = 0x4C;  // [305:6.8.4]
constexpr std::uint8_t unconfigured_response = 0x50;
constexpr std::uint8_t unconfigured = 0;    // in place of a node-ID
constexpr std::uint32_t lss_timeout = 500;  // ms

struct Request {
  std::uint8_t node;
  Micros sent;
};

CO_IF_FRM request_to(std::uint8_t node) {
  return node == unconfigured ? CO_IF_FRM{lss_request_id, {identify_unconfigured}, 8}
                              : CO_IF_FRM{request_id + node, {0x40, 0x00, 0x10, 0x00}, 8};
}

class Search {
 public:
  Search(Line& line, Micros answer_time) : line_(line), answer_time_(answer_time) {}

  Answers run() {
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
    for (const std::optional<Found>& device : devices_) {
      if (device) {
        answers_.devices.push_back(*device);
      }
    }
    return answers_;
  }

 private:
  void send() {
    while (next_ <= last_node && open_.size() < most_in_flight && line_.send(request_to(next_))) {
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
    if (frame.Identifier == lss_response_id && frame.DLC == 8 && frame.Data[0] == unconfigured_response) {
      answers_.has_unconfigured = true;
      end_request(unconfigured);
      return;
    }
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
      ++found.answers;
      found.has_type = (frame.Data[0] & 0xE2U) == 0x42U;
      found.device_type = found.has_type ? CO_GET_LONG(&frame, 4) : 0;
      end_request(node);
    }
  }

  void end_request(std::uint8_t node) {
    open_.erase(
        std::remove_if(open_.begin(), open_.end(), [=](const Request& request) { return request.node == node; }),
        open_.end());
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
  std::uint8_t next_ = unconfigured;
  Micros accepted_ = 0;  ///< last time with a request that the line had accepted and that has not ended
  std::vector<Request> open_;
  std::array<std::optional<Found>, 128> devices_{};
  Answers answers_;
};

std::optional<std::uint32_t> read_number(SdoClient& sdo, std::uint16_t index, std::uint8_t sub, std::uint32_t timeout) {
  const Transfer transfer = sdo.upload(index, sub, {SdoClient::small, timeout, {}});
  const bool is_number = transfer.done() && transfer.data.size() == 4;
  return is_number ? std::optional(static_cast<std::uint32_t>(number_of(transfer.data))) : std::nullopt;
}

/// Reads identity and name of a device.
Device identify(const Found& found, Host& host, std::uint32_t timeout) {
  DeviceClient client(host, found.node);
  SdoClient& sdo = client.sdo();
  Device device;
  device.found = found;
  device.vendor = read_number(sdo, 0x1018, 1, timeout);
  device.product = read_number(sdo, 0x1018, 2, timeout);
  device.revision = read_number(sdo, 0x1018, 3, timeout);
  device.serial = read_number(sdo, 0x1018, 4, timeout);
  const Transfer name = sdo.upload(0x1008, 0, {256, timeout, {}});
  device.name = name.done() ? visible_text(name.data) : std::string();
  return device;
}

}  // namespace

HostLine::HostLine(Host& host) : host_(host), can_(host.master_can()) {
  can_.driver->Init(can_.context);
  can_.driver->Enable(can_.context, 0);
}

bool HostLine::send(const CO_IF_FRM& frame) { return can_.driver->Send(can_.context, &frame) > 0; }

std::optional<CO_IF_FRM> HostLine::receive() {
  CO_IF_FRM frame{};
  if (can_.driver->Read(can_.context, &frame) <= 0) {
    return std::nullopt;
  }
  if ((frame.Identifier & CO_IF_FRM_ERROR) != 0) {
    error_ = frame;
  } else {
    ++received_;
  }
  return frame;
}

Answers request_answers(Line& line, Micros answer_time) { return Search(line, answer_time).run(); }

Devices find_devices(Host& host, Line& line, std::uint32_t timeout) {
  const Answers answers = request_answers(line, timeout * millisecond);
  Devices result;
  for (const Found& found : answers.devices) {
    if (!line.is_ended()) {
      result.devices.push_back(identify(found, host, 4 * timeout));
    }
  }
  if (answers.has_unconfigured && !line.is_ended()) {
    LssSession lss(host, {lss_timeout, std::max(timeout / 4, 1U)});
    const bool is_complete =
        lss.find_unconfigured([&](const LssAddress& address) { result.unconfigured.push_back(address); });
    result.lss_fault = is_complete ? std::string() : lss.fault();
  }
  return result;
}

}  // namespace lexican::program
