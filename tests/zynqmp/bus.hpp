// SPDX-License-Identifier: Apache-2.0
/// \file bus.hpp
/// The two controllers, wired together: the first one is the device's, the second one the master's or the hand of a
/// test, which sends and expects frames in the notation of can-utils. All functions let the nodes run meanwhile.
#pragma once

#include <cstdint>

#include "check.hpp"
#include "co_can_zynqmp.h"

namespace zynqmp {

extern CO_CAN_ZYNQMP device_can;
extern CO_CAN_ZYNQMP peer_can;

/// Gives both controllers to the driver, with their interrupts.
void serve_controllers();

/// The device in Pre-operational, its boot-up message received, and the test at the second controller.
void start_device();
/// Like start_device(), with a function to be called between initialisation and start, and without the boot-up message.
void start_device(void (*prepare)());
/// Starts the device and switches it to Operational.
void start_operational();
/// The device and the master in Pre-operational: the second controller is the master's.
void start_nodes();
/// Stops both nodes and the test's controller; received frames that were not expected are a failure.
void leave_bus();

void run(std::uint32_t microseconds);
inline void run_ms(std::uint32_t milliseconds) { run(1000 * milliseconds); }
/// Lets the nodes run until it is true, but not longer than that many ms. Returns whether it is.
bool run_until(bool (*condition)(), std::uint32_t milliseconds);

/// \name The test's hand
/// \{
void send(const char* text);
/// When the frame came, in µs.
std::uint64_t expect_frame(const char* file, int line, const char* text, std::uint32_t milliseconds = 20);
void expect_silence(const char* file, int line, std::uint32_t milliseconds = 20);
/// Frames that have come until then, thrown away.
unsigned count_frames(std::uint32_t milliseconds, std::uint32_t identifier);
/// \}

/// \name The controllers, past the driver
/// \{
/// Keeps a controller off the bus, and lets it go on: what it has to send waits meanwhile.
void hold(const CO_CAN_ZYNQMP& can);
void release(const CO_CAN_ZYNQMP& can);
std::uint32_t control_register(const CO_CAN_ZYNQMP& can, std::uint32_t offset);
/// \}

}  // namespace zynqmp

#define RX(...) zynqmp::expect_frame(__FILE__, __LINE__, __VA_ARGS__)
#define SILENT(...) zynqmp::expect_silence(__FILE__, __LINE__, __VA_ARGS__)
#define ASK(request, answer) (zynqmp::send(request), RX(answer))
