// SPDX-License-Identifier: Apache-2.0
/// \file sdo_pair_faults.hpp
/// What a bus can do to the frames of a transfer, and a transfer to which it happens.
#pragma once

#include "sdo_pair.hpp"

#if USE_CSDO

namespace test {

struct FrameFault {
  co::VirtualBus::Fault kind;
  Milliseconds delay{0};
};

/// In a block download the server tells after 500, 1000 and 1500 ms of silence what has arrived; after 2000 ms it gives
/// up.
inline constexpr FrameFault frame_faults[] = {
    {co::VirtualBus::Fault::drop},
    {co::VirtualBus::Fault::duplicate},
    {co::VirtualBus::Fault::reorder},
    {co::VirtualBus::Fault::delay, Milliseconds{700}},
    {co::VirtualBus::Fault::delay, Milliseconds{1500}},  // later than the time-out of a client
    {co::VirtualBus::Fault::delay, Milliseconds{3000}},  // and of the server
};

/// A fault, and the frame on the bus that suffers from it, from 1 on.
struct Strike {
  FrameFault what;
  std::uint32_t position;
};
using Strikes = std::vector<Strike>;

struct FaultyTransfer {
  std::uint32_t code;    ///< of the transfer
  std::uint32_t frames;  ///< on the bus
  bool all_struck;
};

/// Runs a transfer of the object with these faults. It ends, with the right data or an abort code, within a time-out
/// for each fault; then the next transfers are done, now and again when both sides have come to rest.
FaultyTransfer disturb(SdoPair& pair, Direction direction, const Strikes& strikes,
                       Milliseconds time_out = Milliseconds{1000});

/// The exhaustive variants, for the lane sdo_faults: LEXICAN_SDO_FAULTS (environment) is "all".
bool all_faults();

}  // namespace test

#endif
