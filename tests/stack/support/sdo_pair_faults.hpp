// SPDX-License-Identifier: Apache-2.0
/// \file sdo_pair_faults.hpp
/// Faults of a bus for the frames of an SDO transfer, and a transfer with such faults.
#pragma once

#include "sdo_pair.hpp"

#if USE_CSDO

namespace test {

struct FrameFault {
  co::VirtualBus::Fault kind;
  Milliseconds delay{0};
};

/// Faults that are tested. The delays match the time-outs: in a block download the server repeats its acknowledge after
/// 500, 1000 and 1500 ms without a frame, and aborts after 2000 ms.
inline constexpr FrameFault frame_faults[] = {
    {co::VirtualBus::Fault::drop},
    {co::VirtualBus::Fault::duplicate},
    {co::VirtualBus::Fault::reorder},
    {co::VirtualBus::Fault::delay, Milliseconds{700}},
    {co::VirtualBus::Fault::delay, Milliseconds{1500}},  // longer than the time-out of a client
    {co::VirtualBus::Fault::delay, Milliseconds{3000}},  // longer than the time-out of the server
};

/// A fault, and the number of the frame on the bus that it applies to, from 1.
struct FaultAtFrame {
  FrameFault what;
  std::uint32_t position;
};
using FaultsAtFrames = std::vector<FaultAtFrame>;

struct FaultyTransfer {
  std::uint32_t code;    ///< abort code of the transfer; 0: success
  std::uint32_t frames;  ///< number of frames on the bus
  bool all_applied;      ///< every fault was applied
};

/// Runs a transfer of the object with these faults. Checks that it ends with the correct data or an abort code within a
/// time-out for each fault, and that later transfers succeed: at once, and again when both sides are idle.
FaultyTransfer disturb(SdoPair& pair, Direction direction, const FaultsAtFrames& faults,
                       Milliseconds time_out = Milliseconds{1000});

/// Returns true if the environment variable LEXICAN_SDO_FAULTS is "all": many more faults, for the lane sdo.
bool all_faults();

}  // namespace test

#endif
