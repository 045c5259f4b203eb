// SPDX-License-Identifier: Apache-2.0
// expect: the controller has no bit timing for this bit rate at this clock
// expect: BitTimingOf<100000000, 800000
// 125 clock periods a bit: 25 quanta would need a segment 1 of 21.
#include "../../drivers/can/zynqmp/zynqmp_rates.hpp"

constexpr auto rates = co::zynqmp_rates<100000000, 125000, 250000, 500000, 800000, 1000000>;
