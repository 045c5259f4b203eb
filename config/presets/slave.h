// SPDX-License-Identifier: Apache-2.0
/// \file presets/slave.h
/// Preset for the usual slave: the defaults of co_cfg.h.
#ifndef CO_PRESET_SLAVE_H_
#define CO_PRESET_SLAVE_H_

#endif
