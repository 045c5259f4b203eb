// SPDX-License-Identifier: Apache-2.0
/// \file decode.hpp
/// Decodes CAN frames in terms of CiA 301, for the pre-defined connection set [301:7.3.3], and of CiA 305.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "co_if_can.h"
#include "trace/block_transfer.hpp"

namespace lexican::trace {

/// Format of an object's value.
enum class Form { decimal, hex, characters };

struct ObjectName {
  std::uint16_t index;
  std::uint8_t sub;
  const char* name;
  Form form;
};

/// Names of the node's objects, in any order.
using Names = std::vector<ObjectName>;

/// An object in a PDO.
struct Mapped {
  std::uint16_t index;
  std::uint8_t sub;
  std::uint8_t bytes;  // 1…4
};

/// Objects in PDOs, by their CAN-ID minus the node-ID: 180h, 200h, …
using Mappings = std::map<std::uint16_t, std::vector<Mapped>>;

/// Place of a frame in an SDO transfer, or in a fastscan.
enum class Place {
  outside,  // in neither
  edge,     // beginning, end and abort; each frame of an expedited transfer, or of another LSS service
  middle,   // segments except the last one, their requests and confirmations: a long transfer has many of them
};

struct Meaning {
  std::string text;
  Place place;
};

class Decoder {
 public:
  /// \a names must outlive the decoder.
  explicit Decoder(const Names& names, Mappings mappings = {}) : names_(names), mappings_(std::move(mappings)) {}

  /// Returns the meaning of \a frame. A frame of an unknown service is shown in the notation of candump:
  /// "123#DEADBEEF". Frames must be passed in the order of the bus, because segments of block transfers are detected by
  /// the frames before.
  Meaning decode(const CO_IF_FRM& frame);

 private:
  Meaning sdo(Sender from, const CO_IF_FRM& frame);

  const Names& names_;
  Mappings mappings_;
  std::array<BlockTransfer, 128> transfers_{};  // by the node-ID of the server
};

/// Returns the meaning of an SDO abort code; "unknown abort code" if it is not in CiA 301. [301:7.2.4.3.17]
const char* abort_meaning(std::uint32_t code);

/// Returns an abort code in the notation of the standard: 0609 0030h.
std::string abort_code(std::uint32_t code);

}  // namespace lexican::trace
