// SPDX-License-Identifier: Apache-2.0
/// \file search.hpp
/// Finds the devices of a bus: by an SDO request to each node-ID, and by LSS those without one. At most eight requests
/// are in flight.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "client/lss_master.hpp"
#include "host/host.hpp"

namespace lexican::program {

/// Frames that the search sends and receives; time of the bus.
struct Line {
  virtual ~Line() = default;
  virtual bool send(const CO_IF_FRM& frame) = 0;
  virtual std::optional<CO_IF_FRM> receive() = 0;
  virtual Micros now() = 0;
  virtual void wait(Micros time) = 0;
  virtual bool is_ended() = 0;  ///< interrupted, or the bus is lost
};

/// The line of a host, with counters.
class HostLine : public Line {
 public:
  /// \a host must outlive the line.
  explicit HostLine(Host& host);
  bool send(const CO_IF_FRM& frame) override;
  std::optional<CO_IF_FRM> receive() override;
  Micros now() override { return host_.now(); }
  void wait(Micros time) override { host_.wait(time); }
  bool is_ended() override { return host_.interrupted(); }

  /// Returns the number of frames received, without error frames.
  std::uint64_t received() const { return received_; }
  /// Returns the last error frame.
  const std::optional<CO_IF_FRM>& error() const { return error_; }

 private:
  Host& host_;
  Can can_;
  std::uint64_t received_ = 0;
  std::optional<CO_IF_FRM> error_;
};

/// A device that has answered.
struct Found {
  std::uint8_t node = 0;
  std::uint32_t device_type = 0;      ///< 1000h
  bool has_type = false;              ///< it has answered the upload of 1000h with a value, not with an abort
  std::optional<std::uint8_t> state;  ///< of its error control, if it was seen
  unsigned answers = 0;               ///< to the request
};

struct Answers {
  std::vector<Found> devices;     ///< by node-ID
  bool has_unconfigured = false;  ///< a device without node-ID has answered
};

/// Requests 1000h of each node-ID from 1 to 127, and an answer of devices without node-ID. \a answer_time: µs for each
/// answer. Ends early if the line accepts no frame for half a second: no node acknowledges the frames that are queued.
Answers request_answers(Line& line, Micros answer_time);

struct Device {
  Found found;
  std::optional<std::uint32_t> vendor;    ///< 1018h:01
  std::optional<std::uint32_t> product;   ///< 1018h:02
  std::optional<std::uint32_t> revision;  ///< 1018h:03
  std::optional<std::uint32_t> serial;    ///< 1018h:04
  std::string name;                       ///< 1008h
};

struct Devices {
  std::vector<Device> devices;           ///< by node-ID
  std::vector<LssAddress> unconfigured;  ///< devices without node-ID
  std::string lss_fault;                 ///< why not all of these were found; empty: they were
};

/// Finds the devices, and reads identity and name of each. Devices without node-ID are found by fastscan, which leaves
/// all LSS slaves in the state waiting. \a line: that of \a host. \a timeout: ms for the answer of each node-ID;
/// identity and name have four times as much, each answer to a fastscan a quarter.
Devices find_devices(Host& host, Line& line, std::uint32_t timeout);

}  // namespace lexican::program
