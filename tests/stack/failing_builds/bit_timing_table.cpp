// SPDX-License-Identifier: Apache-2.0
// expect: the controller has no bit timing for this bit rate at this clock
// expect: BitTimingOf<100000000, 800000
// A bit at 800 kbit/s has 125 clock periods, which 25 quanta divide; segment 1 would have 21 of them, 16 are possible.
#include "../../../drivers/can/zynqmp/zynqmp_rates.hpp"

constexpr auto rates = co::zynqmp_rates<100000000, 125000, 250000, 500000, 800000, 1000000>;
