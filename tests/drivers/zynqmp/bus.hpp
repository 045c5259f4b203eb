// SPDX-License-Identifier: Apache-2.0
/// \file bus.hpp
/// The two controllers, connected to each other. The first one is the device's; the second one is the master's, or
/// sends and expects frames for a test, in the notation of can-utils. All functions run the nodes while they wait.
#pragma once

#include <cstdint>

#include "check.hpp"
#include "co_can_zynqmp.h"

namespace zynqmp {

extern CO_CAN_ZYNQMP device_can;
extern CO_CAN_ZYNQMP peer_can;

/// Connects both controllers to their drivers and interrupts.
void serve_controllers();

/// Starts the device and receives its boot-up message: the device is in Pre-operational, the test at the second
/// controller.
void start_device();
/// Starts the device like start_device(), but calls \a prepare between initialisation and start, and does not receive
/// the boot-up message.
void start_device(void (*prepare)());
/// Starts the device and switches it to Operational.
void start_operational();
/// Starts the device and, at the second controller, the master: both are in Pre-operational.
void start_nodes();
/// Stops both nodes and the test's controller. A received frame that no test has expected is a failure.
void leave_bus();

void run(std::uint32_t microseconds);
inline void run_ms(std::uint32_t milliseconds) { run(1000 * milliseconds); }
/// Runs the nodes until \a condition is true, at most for \a milliseconds. Returns whether it is true.
bool run_until(bool (*condition)(), std::uint32_t milliseconds);

/// \name Frames that the test sends and receives at the second controller
/// \{
void send(const char* text);
/// Receives a frame that must be the given one. Returns its time of reception in µs.
std::uint64_t expect_frame(const char* file, int line, const char* text, std::uint32_t milliseconds = 20);
void expect_silence(const char* file, int line, std::uint32_t milliseconds = 20);
/// Receives and discards frames for \a milliseconds. Returns the number of those with \a identifier.
unsigned count_frames(std::uint32_t milliseconds, std::uint32_t identifier);
/// \}

/// \name Registers of the controllers, accessed without the driver
/// \{
/// Takes a controller off the bus, and puts it on the bus again; it keeps its frames meanwhile.
void hold(const CO_CAN_ZYNQMP& can);
void release(const CO_CAN_ZYNQMP& can);
std::uint32_t control_register(const CO_CAN_ZYNQMP& can, std::uint32_t offset);
/// \}

}  // namespace zynqmp

#define RX(...) zynqmp::expect_frame(__FILE__, __LINE__, __VA_ARGS__)
#define SILENT(...) zynqmp::expect_silence(__FILE__, __LINE__, __VA_ARGS__)
#define ASK(request, answer) (zynqmp::send(request), RX(answer))
