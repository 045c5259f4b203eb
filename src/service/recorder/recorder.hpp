// SPDX-License-Identifier: Apache-2.0
// Recorder of numbers of the dictionary.
#pragma once

#include "co_core.h"

#if USE_RECORDER

namespace co::recorder {

// Values of CO_RECORDER.State.
enum State : uint8_t {
  idle,       // never started, or the configuration is wrong
  waiting,    // for the trigger; the points before it are recorded
  recording,  // without trigger: new points overwrite old ones
  triggered,  // until the memory is full
  full
};

// Adds a recorder to those of the node, and starts it anew. The recorder is idle after an error.
CO_ERR start(CO_NODE& node, CO_RECORDER& recorder);

// Checks a configuration and replaces that of the recorder.
[[nodiscard]] CO_ERR configure(CO_RECORDER& recorder, const CO_RECORDER_CONFIG& config);

// Empties a recorder and starts it anew.
[[nodiscard]] CO_ERR clear(CO_RECORDER& recorder);

// Returns the point that was recorded last (age 1), or an earlier one: age is at most the points in use.
[[nodiscard]] const CO_RECORDER_POINT& point_at(const CO_RECORDER& recorder, uint32_t age);

// Returns a value of the recorded object as an unsigned number of the same order. The conversion is its own inverse.
[[nodiscard]] inline uint32_t ordered(const CO_RECORDER& recorder, uint32_t value) {
  constexpr uint32_t sign = 0x80000000;
  return (recorder.Config.Format & CO_RECORDER_UNSIGNED) != 0 ? value : value ^ sign;
}

// Removes the points of a plot that was read completely.
void remove_read(CO_RECORDER& recorder);

// Stops the timers when the node is stopped.
void on_mode(CO_NODE& node);

// Ends the plots whose entry CODictInit() has moved: the SDO server does not call their End function.
void on_remap(CO_NODE& node);

}  // namespace co::recorder

#endif
