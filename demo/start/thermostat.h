// SPDX-License-Identifier: Apache-2.0
/// \file thermostat.h
/// The device of the tutorial (docs/start): a CANopen node with PDOs and storage, node-ID 5, on a virtual bus.
#ifndef LEXICAN_DEMO_START_THERMOSTAT_H_
#define LEXICAN_DEMO_START_THERMOSTAT_H_

#include "co_can_virtual.h"
#include "co_virtual_clock.h"

/// Starts the device: on \a bus at the first call, later as after a power cycle, with its stored values.
void ThermostatPowerOn(CO_VIRTUAL_BUS* bus, CO_VIRTUAL_CLOCK* clock);

/// Runs one pass of the main loop.
void ThermostatRun(void);

/// Sets a new measurement, in 0.1 degrees Celsius.
void ThermostatMeasure(int16_t temperature);

/// Returns the setpoint, in 0.1 degrees Celsius.
int16_t ThermostatSetpoint(void);

#endif
