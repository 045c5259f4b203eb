// SPDX-License-Identifier: Apache-2.0
/// \file sdo_transfer.hpp
/// Joins the frames between an SDO client and a server to transfers. [301:7.2.4]
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bus/log.hpp"

namespace lexican::describe {

using host_bus::Micros;

struct SdoTransfer {
  enum class End : std::uint8_t { done, refused, cancelled, unanswered };

  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  bool is_download = false;
  End end = End::done;           ///< refused: aborted by the server; cancelled: aborted by the client
  std::uint32_t abort_code = 0;  ///< of refused and cancelled
  Micros begin = 0;
  Micros time = 0;                 ///< of the last frame
  std::uint64_t size = 0;          ///< bytes transferred
  std::vector<std::uint8_t> data;  ///< the first of them, at most SdoFollower::most_data
};

/// Follows the transfers of one server: expedited, segmented and block transfers. Its memory is bounded. A frame that
/// fits no transfer is ignored.
class SdoFollower {
 public:
  static constexpr std::size_t most_data = 4096;    ///< bytes
  static constexpr Micros answer_time = 1'000'000;  ///< after which a transfer without frames is regarded as unanswered

  /// Processes the next frame between client and server, of 8 bytes.
  /// \retval nothing  no transfer has ended
  std::optional<SdoTransfer> follow(bool is_request, const std::uint8_t* data, Micros time);
  /// Ends a transfer that has had no frame for answer_time.
  std::optional<SdoTransfer> expire(Micros now);
  /// Ends a transfer at the end of a log.
  std::optional<SdoTransfer> close();
  bool is_active() const { return phase_ != Phase::idle; }

 private:
  enum class Phase : std::uint8_t {
    idle,
    open,             ///< initiated, or segments
    client_segments,  ///< of a block download
    server_segments,  ///< of a block upload
  };

  std::optional<SdoTransfer> request(const std::uint8_t* data);
  std::optional<SdoTransfer> response(const std::uint8_t* data);
  void begin(const std::uint8_t* data, bool is_download, Micros time);
  void append(const std::uint8_t* bytes, std::size_t size);
  void segment(const std::uint8_t* data);
  void acknowledge(std::uint8_t last);
  void end_block(const std::uint8_t* data);
  SdoTransfer end(SdoTransfer::End how, std::uint32_t code = 0);

  Phase phase_ = Phase::idle;
  SdoTransfer transfer_{};
  bool is_last_ = false;             ///< the last segment was seen
  std::uint8_t in_block_ = 0;        ///< segments of the sub-block
  std::vector<std::uint8_t> block_;  ///< their bytes, which the receiver has not acknowledged yet
};

}  // namespace lexican::describe
