// SPDX-License-Identifier: Apache-2.0
/// \file command.hpp
/// NMT commands, and their effect.
#pragma once

#include "program/session.hpp"

namespace lexican::program {

/// Sends an NMT command to a node, 0: all, as soon as the bus accepts it.
/// \retval false  the bus has accepted nothing for \a timeout
bool send_command(host_bus::Bus& bus, BusHost& host, CO_NMT_COMMAND command, std::uint8_t node, Micros timeout);

/// Prints why send_command() has failed.
/// \retval status of the program
int report_unsent(Session& session);

constexpr std::uint8_t no_state = 0xFF;

/// Waits until the error control of the device shows the state; 0: a boot-up message.
/// \retval last state  no_state: none was received
std::uint8_t wait_for_state(Session& session, std::uint8_t node, std::uint8_t state, Micros timeout);

}  // namespace lexican::program
