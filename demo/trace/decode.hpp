// SPDX-License-Identifier: Apache-2.0
/// \file decode.hpp
/// CAN frames in the words of CiA 301, of the pre-defined connection set [301:7.3.3], and of CiA 305.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "co_if_can.h"
#include "trace/block_transfer.hpp"

namespace demo::trace {

/// How the value of an object is best read.
enum class Form { decimal, hex, characters };

struct ObjectName {
  std::uint16_t index;
  std::uint8_t sub;
  const char* name;
  Form form;
};

/// What the objects of the node are called; any order.
using Names = std::vector<ObjectName>;

/// An object in a PDO.
struct Mapped {
  std::uint16_t index;
  std::uint8_t sub;
  std::uint8_t bytes;  // 1…4
};

/// What PDOs hold, by their CAN-ID less the node-ID: 180h, 200h, …
using Mappings = std::map<std::uint16_t, std::vector<Mapped>>;

/// The place of a frame in an SDO transfer, or in a fastscan.
enum class Place {
  outside,  // of any
  edge,     // begin, end and abort; all there is of an expedited transfer, or of another LSS service
  middle,   // segments but the last, and what asks for or confirms these: a long transfer has many of them
};

struct Meaning {
  std::string text;
  Place place;
};

class Decoder {
 public:
  /// \a names must outlive the decoder.
  explicit Decoder(const Names& names, Mappings mappings = {}) : names_(names), mappings_(std::move(mappings)) {}

  /// What \a frame means. A frame of no known service is shown in the notation of candump: "123#DEADBEEF".
  /// Frames have to come in the order of the bus: what a segment of a block transfer is, the frames before it tell.
  Meaning decode(const CO_IF_FRM& frame);

 private:
  Meaning sdo(Sender from, const CO_IF_FRM& frame);

  const Names& names_;
  Mappings mappings_;
  std::array<BlockTransfer, 128> transfers_{};  // with the server of that node-ID
};

/// Meaning of an SDO abort code; "unknown abort code" if it is none of CiA 301. [301:7.2.4.3.17]
const char* abort_meaning(std::uint32_t code);

/// An abort code as the standard writes it: 0609 0030h.
std::string abort_code(std::uint32_t code);

}  // namespace demo::trace
