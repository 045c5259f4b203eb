// SPDX-License-Identifier: Apache-2.0
// The bus inside a program of the demo, with simulated time.
#include "co_cfg.h"

#if USE_CSDO && defined(__linux__)  // the demo requires USE_CSDO, its host Linux
#include <doctest/doctest.h>
#include <unistd.h>

#include "host/virtual_bus_host.hpp"

TEST_CASE("virtual bus host: the time of the built-in bus advances only while the program waits") {
  const lexican::Interruption interruption;
  lexican::demo::VirtualBusHost host(interruption);
  const lexican::Timer timer = host.device_timer();
  timer.driver->Init(timer.context, 1000000);
  CHECK(host.now() == 0);
  ::usleep(20000);
  CHECK(host.now() == 0);
  host.wait(250 * lexican::millisecond);
  CHECK(host.now() == 250 * lexican::millisecond);
  host.wait(lexican::for_ever);  // no event can end it earlier
  CHECK(host.now() == 250 * lexican::millisecond + lexican::second);
}
#endif
