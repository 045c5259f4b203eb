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
  bool is_aborted_only = false;  ///< only the abort was seen: is_download is not known
  bool is_answered = false;      ///< the server has sent a frame of the transfer
  bool is_displaced = false;     ///< unanswered: the next transfer began before it had ended
  bool is_cut = false;           ///< unanswered: the log has ended before
  unsigned wrong_toggles = 0;    ///< segments whose toggle bit does not alternate
  unsigned lost_segments = 0;    ///< segments of blocks that the receiver has not confirmed
  End end = End::done;           ///< refused: aborted by the server; cancelled: aborted by the client
  std::uint32_t abort_code = 0;  ///< of refused and cancelled
  Micros begin = 0;
  Micros time = 0;                 ///< of the last frame
  bool has_size = true;            ///< false: expedited without size, `data` has 4 bytes of which some may be unused
  std::uint64_t size = 0;          ///< bytes transferred
  std::vector<std::uint8_t> data;  ///< the first of them, at most SdoFollower::most_data; fewer, too, if
                                   ///< a segment was not recorded
};

/// Follows the transfers of one server: expedited, segmented and block transfers. Its memory is bounded. A frame that
/// does not belong to the open transfer is ignored, such as a late answer to an earlier request, or the abort by which
/// the client ends a transfer that expire() has ended before.
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
  /// Returns false if the last frame was ignored.
  bool was_followed() const { return was_followed_; }

 private:
  enum class Phase : std::uint8_t {
    idle,
    open,             ///< initiated, or segments
    client_segments,  ///< of a block download
    server_segments,  ///< of a block upload
  };

  std::optional<SdoTransfer> abort(bool is_request, const std::uint8_t* data, Micros time);
  std::optional<SdoTransfer> request(const std::uint8_t* data);
  std::optional<SdoTransfer> response(const std::uint8_t* data);
  std::optional<SdoTransfer> done_if(bool is_done);
  void begin(const std::uint8_t* data, bool is_download, Micros time);
  bool is_of_object(const std::uint8_t* data) const;
  bool follow_if(bool is_expected);
  void append(const std::uint8_t* bytes, std::size_t size);
  void append_expedited(const std::uint8_t* data);
  void check_toggle(bool is_request, const std::uint8_t* data);
  bool segment(const std::uint8_t* data);
  void begin_block(std::uint8_t blksize);
  void acknowledge(const std::uint8_t* data);
  void end_block(const std::uint8_t* data);
  SdoTransfer end(SdoTransfer::End how, std::uint32_t code = 0);

  Phase phase_ = Phase::idle;
  SdoTransfer transfer_{};
  std::optional<std::uint32_t> expired_;  ///< object of the last transfer, if expire() has ended it
  bool was_followed_ = false;
  bool is_expedited_ = false;        ///< a download
  bool is_last_ = false;             ///< the last segment was seen
  bool toggle_ = true;               ///< toggle bit of the last request of a segment
  bool is_ended_ = false;            ///< the end of a block transfer was seen
  bool is_block_sent_ = false;       ///< the last frame of the sub-block was seen
  std::uint8_t blksize_ = 0;         ///< segments of a sub-block
  std::uint8_t in_block_ = 0;        ///< segments of the sub-block without a gap
  std::uint8_t highest_ = 0;         ///< highest sequence number in the sub-block
  std::vector<std::uint8_t> block_;  ///< bytes of in_block_ segments, which the receiver has not acknowledged yet
};

}  // namespace lexican::describe
