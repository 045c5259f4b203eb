// SPDX-License-Identifier: Apache-2.0
/// \file heater.h
/// A heater whose object dictionary is generated from heater.eds. Its temperature approaches the setpoint.
#ifndef LEXICAN_DEMO_HEATER_H_
#define LEXICAN_DEMO_HEATER_H_

#include "co_core.h"

#define HEATER_TICKS 1000u  ///< ticks of the timer per second

/// Starts the device as after power-on: with stored values, else with default values. Prints an error of the node.
/// \a drivers: CAN, timer and memory; must outlive the node.
/// \retval true   the node has started
/// \retval false  the node has reported an error
bool HeaterStart(CO_NODE_EXT* drivers, uint8_t nodeId);

/// Stops the node, as a loss of power does.
void HeaterStop(void);

/// Runs one pass of the main loop. Returns the ticks until the next one is due if no frame is received.
uint32_t HeaterRun(void);

/// Sets whether the sensor of the temperature is broken.
void HeaterBreakSensor(bool broken);

#endif
