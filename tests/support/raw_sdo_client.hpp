// SPDX-License-Identifier: Apache-2.0
/// \file raw_sdo_client.hpp
/// An SDO client that believes nothing: it checks every bit of every answer, aborts at the first that is wrong, and
/// gives up after a time-out. Expedited uploads as the server likes, downloads always segmented. [301:7.2.4.3]
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "network.hpp"

namespace test {

struct SdoResult {
  enum class End {
    done,
    aborted,    ///< by the server
    cancelled,  ///< by the client, because an answer was wrong
    timed_out,  ///< the client has got no answer and aborted
  };
  End end;
  std::uint32_t code = 0;  ///< abort code of the server
  std::vector<std::uint8_t> data = {};

  bool is_done() const { return end == End::done; }
};

class RawSdoClient {
 public:
  RawSdoClient(World& world, Line& line, std::uint8_t node_id);
  /// At other COB-IDs.
  RawSdoClient(World& world, Line& line, std::uint32_t request_id, std::uint32_t response_id);
  RawSdoClient(const RawSdoClient&) = delete;
  RawSdoClient& operator=(const RawSdoClient&) = delete;

  void set_time_out(Milliseconds time_out) { time_out_ = time_out; }

  SdoResult upload(std::uint16_t index, std::uint8_t sub);
  SdoResult download(std::uint16_t index, std::uint8_t sub, const std::vector<std::uint8_t>& data);

  /// Sends a frame of 8 bytes; returns the answer, if one comes without time going by.
  std::optional<CO_IF_FRM> ask(const std::array<std::uint8_t, 8>& request);
  /// Frames that have come unasked since the last transfer or ask() began; forgets them.
  unsigned drain();

  co::VirtualBus::Port& port;

 private:
  using Request = std::array<std::uint8_t, 8>;
  std::optional<CO_IF_FRM> wait();
  std::optional<SdoResult> exchange(const Request& request, CO_IF_FRM& answer);
  SdoResult cancel(const Request& request, std::uint32_t code, SdoResult::End end);
  SdoResult upload_segments(const Request& initiate, std::uint32_t size);
  void send(const Request& request);

  World& world_;
  std::uint32_t request_id_;
  Milliseconds time_out_{1000};
};

}  // namespace test
