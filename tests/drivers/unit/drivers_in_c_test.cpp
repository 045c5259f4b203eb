// SPDX-License-Identifier: Apache-2.0
// C interface of the host drivers. The lane library and demo/first_node compile it as C11.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "co_can_socketcan.h"
#include "co_can_virtual.h"
#include "co_nvm_file.h"
#include "co_timer_linux.h"
#include "co_virtual_clock.h"

TEST_CASE("drivers in C: a port of the virtual bus sends to and receives from the other ports") {
  CO_VIRTUAL_BUS* const bus = COVirtualBusNew();
  CO_VIRTUAL_PORT* const one = COVirtualBusAttach(bus, "one");
  CO_VIRTUAL_PORT* const other = COVirtualBusAttach(bus, "other");
  std::vector<std::string> seen;
  COVirtualBusTrace(
      bus,
      [](void* user, const CO_IF_FRM* frame, const char* sender) {
        static_cast<std::vector<std::string>*>(user)->push_back(sender + std::to_string(frame->Identifier));
      },
      &seen);
  const CO_IF_FRM sent = {0x123, {1, 2}, 2};
  CO_IF_FRM read = {};
  CHECK(COVirtualPortSend(one, &sent) == -1);  // off the bus
  COVirtualPortEnable(one, 250000);
  COVirtualPortEnable(other, 250000);
  CHECK(COVirtualPortRead(other, &read) == 0);
  CHECK(COVirtualPortSend(one, &sent) == static_cast<int16_t>(sizeof sent));
  CHECK(COVirtualPortRead(one, &read) == 0);
  REQUIRE(COVirtualPortRead(other, &read) == static_cast<int16_t>(sizeof read));
  CHECK(read.Identifier == 0x123);
  CHECK(read.DLC == 2);
  CHECK(read.Data[1] == 2);
  COVirtualBusTrace(bus, nullptr, nullptr);
  CHECK(COVirtualPortSend(other, &sent) == static_cast<int16_t>(sizeof sent));
  CHECK(seen == std::vector<std::string>{"one291"});
  COVirtualBusFree(bus);
}

TEST_CASE("drivers in C: a virtual clock advances by ticks and to the next alarm") {
  CO_VIRTUAL_CLOCK* const clock = COVirtualClockNew();
  CO_VIRTUAL_TIMER* const timer = COVirtualTimerNew(clock);
  COVirtualTimerDriver.Init(timer, 1000);
  COVirtualClockAdvance(clock, 7);
  CHECK(COVirtualClockNow(clock) == 7);
  CHECK(COVirtualTimerDriver.Now(timer) == 7);
  CHECK_FALSE(COVirtualClockAdvanceToAlarm(clock));
  COVirtualTimerDriver.Alarm(timer, 5);
  CHECK(COVirtualClockAdvanceToAlarm(clock));
  CHECK(COVirtualClockNow(clock) == 12);
  COVirtualTimerFree(timer);
  COVirtualClockFree(clock);
}

TEST_CASE("drivers in C: a missing interface is refused with a text") {
  CO_SOCKETCAN* const can = COSocketCanNew();
  CHECK(std::strlen(COSocketCanError(can)) == 0);
  CHECK_FALSE(COSocketCanOpen(can, "no-such-can"));
  CHECK(std::string(COSocketCanError(can)).size() > 10);
  CHECK(COSocketCanFd(can) == -1);
  CHECK(COSocketCanLost(can) == 0);
  COSocketCanFree(can);
}

TEST_CASE("drivers in C: the Linux timer waits until the deadline of the node") {
  CO_LINUX_TIMER* const timer = COLinuxTimerNew();
  COLinuxTimerDriver.Init(timer, 1000);
  CHECK(COLinuxTimerPollTimeout(timer, UINT32_MAX) == -1);
  CHECK(COLinuxTimerPollTimeout(timer, 0) == 0);
  constexpr int hour = 3600 * 1000;
  const int wait = COLinuxTimerPollTimeout(timer, hour);
  CHECK(wait > 0);
  CHECK(wait <= hour);
  CHECK(COLinuxTimerFd(timer) >= 0);
  COLinuxTimerFree(timer);
}

TEST_CASE("drivers in C: a file stores written bytes") {
  const std::string path = "drivers_in_c_test.nvm";
  std::remove(path.c_str());
  CO_FILE_NVM* memory = COFileNvmNew();
  REQUIRE(COFileNvmOpen(memory, path.c_str(), 16));
  uint8_t bytes[4] = {1, 2, 3, 4};
  CHECK(COFileNvmDriver.Write(memory, 4, bytes, 4) == 4);
  COFileNvmFree(memory);
  memory = COFileNvmNew();
  REQUIRE(COFileNvmOpen(memory, path.c_str(), 16));
  uint8_t read[8] = {};
  CHECK(COFileNvmDriver.Read(memory, 2, read, 8) == 8);
  const uint8_t expected[8] = {0xFF, 0xFF, 1, 2, 3, 4, 0xFF, 0xFF};
  CHECK(std::memcmp(read, expected, 8) == 0);
  CHECK_FALSE(COFileNvmOpen(memory, "/no/such/directory/file", 16));
  CHECK(std::string(COFileNvmError(memory)).find("/no/such/directory/file") != std::string::npos);
  COFileNvmFree(memory);
  std::remove(path.c_str());
}
