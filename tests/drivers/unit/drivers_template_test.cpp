// SPDX-License-Identifier: Apache-2.0
// Driver templates: unchanged, their functions have no effect and defined results.
#include <doctest/doctest.h>

#include "co_can_template.h"
#include "co_nvm_template.h"
#include "co_timer_template.h"

TEST_CASE("template of a CAN driver: receives nothing and refuses frames") {
  const CO_IF_CAN_DRV& driver = TemplateCanDriver;
  CO_IF_FRM frame{};
  driver.Init();
  driver.Enable(250000);
  TemplateCanInterrupt();
  CHECK(driver.Read(&frame) == 0);
  CHECK(driver.Send(&frame) == 0);
  driver.Reset();
  driver.Close();
  CHECK(driver.Read(&frame) == 0);
}

TEST_CASE("template of a timer driver: the time does not advance") {
  const CO_IF_TIMER_DRV& driver = TemplateTimerDriver;
  driver.Init(1000000);
  driver.Reload(100);
  driver.Start();
  TemplateTimerInterrupt();
  CHECK(driver.Update() == 0);
  CHECK(driver.Delay() == 0);
  driver.Stop();
  CHECK(driver.Update() == 0);
}

TEST_CASE("template of a memory driver: stores and reads nothing") {
  const CO_IF_NVM_DRV& driver = TemplateNvmDriver;
  uint8_t byte = 5;
  driver.Init();
  CHECK(driver.Read(0, &byte, 1) == 0);
  CHECK(driver.Write(0, &byte, 1) == 0);
  CHECK(byte == 5);
}
