// SPDX-License-Identifier: Apache-2.0
// expect: the controller has no bit timing for this bit rate at this clock
// expect: BitTimingOf<100000000, 10000
// A prescaler of 256 and 25 quanta make 15.6 kbit/s of 100 MHz at least.
#include "../../../drivers/can/bit_timing.hpp"

inline constexpr co::BitTimingLimits limits = {256, 16, 8, 4};

constexpr co::BitTiming timing = co::bit_timing<100000000, 10000, limits>;
