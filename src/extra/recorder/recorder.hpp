// SPDX-License-Identifier: Apache-2.0
// Recorder: records the values of objects of the dictionary.
#pragma once

#include "base/part.hpp"

namespace co::recorder {

// Values of CO_RECORDER.State.
enum State : uint8_t {
  idle,       // never started, or the configuration is wrong
  waiting,    // waiting for the trigger; only the points to be kept from before it are held
  recording,  // no trigger is configured: new points overwrite old ones
  triggered,  // recording after the trigger, until the memory is full
  full        // stopped, until a complete upload has removed the points
};

// Adds a recorder to the list of the node, empties it and starts it. The recorder is idle after an error.
CO_ERR start(CO_NODE& node, CO_RECORDER& recorder);

// Checks a configuration and replaces that of the recorder.
[[nodiscard]] CO_ERR configure(CO_RECORDER& recorder, const CO_RECORDER_CONFIG& config);

// Empties a recorder and starts it again.
[[nodiscard]] CO_ERR clear(CO_RECORDER& recorder);

// Returns the point that was recorded last (age 1), or an earlier one: age is at most the points in use.
[[nodiscard]] const CO_RECORDER_POINT& point_at(const CO_RECORDER& recorder, uint32_t age);

// Returns a value of the recorded object as an unsigned number of the same order. The conversion is its own inverse.
[[nodiscard]] inline uint32_t ordered(const CO_RECORDER& recorder, uint32_t value) {
  constexpr uint32_t sign = 0x80000000;
  return (recorder.Config.Format & CO_RECORDER_UNSIGNED) != 0 ? value : value ^ sign;
}

// Removes the points with which an upload of the plot began, after it has been completed.
void remove_read(CO_RECORDER& recorder);

// Stops the timers when the node is stopped.
void on_mode(CO_NODE& node);

// Finds the variable of CO_TREC_ENABLE in the new table. Ends uploads of plots whose entry CODictInit() has moved: the
// SDO server does not call the End function for them.
void on_remap(CO_NODE& node);

inline constexpr Part part = Part().mode(on_mode).remap(on_remap);

}  // namespace co::recorder
