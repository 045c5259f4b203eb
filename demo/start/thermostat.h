// SPDX-License-Identifier: Apache-2.0
/// \file thermostat.h
/// The device of the tutorial (docs/start): a CANopen node with PDOs and storage, node-ID 5, on a virtual bus.
#ifndef LEXICAN_DEMO_START_THERMOSTAT_H_
#define LEXICAN_DEMO_START_THERMOSTAT_H_

#include "co_can_virtual.h"
#include "co_virtual_clock.h"

/// Switches the device on: the first time on \a bus, then again with what its memory has kept.
void ThermostatPowerOn(CO_VIRTUAL_BUS* bus, CO_VIRTUAL_CLOCK* clock);

/// One pass of the main loop.
void ThermostatRun(void);

/// A new measurement, in 0.1 degrees Celsius.
void ThermostatMeasure(int16_t temperature);

/// Setpoint in 0.1 degrees Celsius.
int16_t ThermostatSetpoint(void);

#endif
