// SPDX-License-Identifier: Apache-2.0
/// \file raw_sdo_client.hpp
/// An SDO client that checks every answer, and aborts after the first wrong one or after a time-out. Uploads are
/// expedited or segmented, as the server decides; downloads are always segmented. [301:7.2.4.3]
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
    cancelled,  ///< aborted by the client, because an answer was wrong
    timed_out,  ///< aborted by the client, because it received no answer
  };
  End end;
  std::uint32_t code = 0;  ///< abort code of the server
  std::vector<std::uint8_t> data = {};

  bool is_done() const { return end == End::done; }
};

class RawSdoClient {
 public:
  RawSdoClient(World& world, Line& line, std::uint8_t node_id);
  /// Uses other COB-IDs than those of the predefined connection set.
  RawSdoClient(World& world, Line& line, std::uint32_t request_id, std::uint32_t response_id);
  RawSdoClient(const RawSdoClient&) = delete;
  RawSdoClient& operator=(const RawSdoClient&) = delete;

  void set_time_out(Milliseconds time_out) { time_out_ = time_out; }

  SdoResult upload(std::uint16_t index, std::uint8_t sub);
  SdoResult download(std::uint16_t index, std::uint8_t sub, const std::vector<std::uint8_t>& data);

  /// Sends a frame of 8 bytes. Returns the answer if the server sends it at once, without time passing.
  std::optional<CO_IF_FRM> ask(const std::array<std::uint8_t, 8>& request);
  /// Discards the received frames that belong to no transfer and no ask(). Returns their number.
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
