// SPDX-License-Identifier: Apache-2.0
/// \file presets/sim.h
/// Preset for programs of a computer, such as the bus tool, which simulates nodes of any kind: that of presets/full.h,
/// with as many PDOs and heartbeat consumers as there can be. A node has RAM for all of them.
#ifndef CO_PRESET_SIM_H_
#define CO_PRESET_SIM_H_

/// \cond internal
#ifndef CO_RPDO_N
#define CO_RPDO_N 512
#endif
#ifndef CO_TPDO_N
#define CO_TPDO_N 512
#endif
#ifndef CO_HBCONS_N
#define CO_HBCONS_N 127
#endif
/// \endcond

#include "presets/full.h"

#endif
