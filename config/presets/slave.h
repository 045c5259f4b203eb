// SPDX-License-Identifier: Apache-2.0
/// \file presets/slave.h
/// The usual node: the defaults of co_cfg.h.
#ifndef CO_PRESET_SLAVE_H_
#define CO_PRESET_SLAVE_H_

#endif
