// SPDX-License-Identifier: Apache-2.0
/// \file sdo_observer.hpp
/// Observes a channel of an SDO server on the bus. It derives which objects the client may have changed, and the order
/// of the segments of a block upload.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "co_core.h"

namespace test {

/// Entries, as CO_DEV(), that may have changed.
struct ChangeableEntries {
  std::set<std::uint32_t> completed;  ///< their download was confirmed
  std::set<std::uint32_t> streaming;  ///< may be partially written: their download is open or was aborted
};

class SdoObserver {
 public:
  void request(const CO_IF_FRM& frm);  ///< processes a frame sent by the client
  /// Processes a frame that the controller has accepted from the server. Returns its fault; empty if it may be sent
  /// now.
  std::string taken(const CO_IF_FRM& frm);
  void waiting(const std::vector<CO_IF_FRM>& frames);  ///< frames of the server in the transmit queue
  /// Returns true if the next frame of the server may be a segment of a block upload.
  bool is_sending() const { return phase_ == Phase::sending && !ending_; }
  /// Adds the entries that may have changed since the last call.
  void take_changeable(ChangeableEntries& all);
  void close();  ///< the server is idle

 private:
  enum class Phase {
    closed,
    downloading,  // segmented download
    receiving,    // block download: within a sub-block
    received,     // block download: all sub-blocks received, but not the end
    offered,      // block upload: initiated
    sending,      // block upload: started, until its end is sent
  };
  struct Request {
    std::uint8_t command;
    std::uint32_t dev;
    std::uint8_t blksize;
  };
  bool forget_waiting(const CO_IF_FRM& frm);
  void answer(const CO_IF_FRM& frm);
  void answer_to(const Request& request, std::uint8_t answer);
  void open(Phase phase, std::uint32_t dev);
  void receive(const CO_IF_FRM& frm);
  bool may_have_written() const;
  void acknowledge(std::uint8_t ackseq, std::uint8_t blksize);
  std::string fault_of_segment(const CO_IF_FRM& frm);
  std::string fault_of_end(const CO_IF_FRM& frm);

  Phase phase_ = Phase::closed;
  std::optional<Request> request_;
  std::vector<CO_IF_FRM> waiting_;  // expected answers that are not sent yet
  std::uint32_t dev_ = 0;           // object of the open transfer
  std::uint32_t segments_ = 0;      // segments of a block download received in order
  unsigned next_ = 1;               // next sequence number
  bool last_ = false;               // the last segment has been received or sent
  bool ending_ = false;             // the client has acknowledged all segments of a block upload
  std::uint8_t blksize_ = 0;
  std::array<std::uint8_t, 8> last_segment_{};
  ChangeableEntries changeable_;
};

}  // namespace test
