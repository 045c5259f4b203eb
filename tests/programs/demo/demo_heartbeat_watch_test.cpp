// SPDX-License-Identifier: Apache-2.0
#include "co_cfg.h"

#if USE_CSDO  // required by the demo's master
#include <doctest/doctest.h>

#include "linux_node/heartbeat_watch.hpp"
#include "support/notation.hpp"

using lexican::demo::HeartbeatWatch;
using test::frame;

TEST_CASE("demo heartbeats: each is due a multiple of the heartbeat time after the boot-up [301:7.2.8.2.2.1]") {
  HeartbeatWatch watch;
  watch.on_sent(frame("705#00"), 0xFFFFFF00, 1000);  // the clock wraps soon
  CHECK(watch.number() == 0);
  watch.on_sent(frame("705#7F"), 0xFFFFFF00u + 1000, 1000);
  CHECK(watch.greatest_lateness() == 0);
  watch.on_sent(frame("705#7F"), 0xFFFFFF00u + 2030, 1000);
  CHECK(watch.greatest_lateness() == 30);
  watch.on_sent(frame("705#05"), 0xFFFFFF00u + 3020, 1000);
  CHECK(watch.greatest_lateness() == 30);
  CHECK(watch.number() == 3);
}

TEST_CASE("demo heartbeats: a missing one makes the next one late") {
  HeartbeatWatch watch;
  watch.on_sent(frame("705#00"), 0, 1000);
  watch.on_sent(frame("705#7F"), 1000, 1000);
  watch.on_sent(frame("705#7F"), 3000, 1000);
  CHECK(watch.greatest_lateness() == 1000);
}

TEST_CASE("demo heartbeats: another heartbeat time and a reset restart the check") {
  HeartbeatWatch watch;
  watch.on_sent(frame("705#00"), 0, 1000);
  watch.on_sent(frame("705#7F"), 1000, 1000);
  watch.on_sent(frame("705#7F"), 5555, 500);
  watch.on_sent(frame("705#7F"), 6056, 500);
  watch.on_sent(frame("705#00"), 9999, 500);
  watch.on_sent(frame("705#7F"), 10501, 500);
  CHECK(watch.greatest_lateness() == 2);
  CHECK(watch.number() == 3);
}

TEST_CASE("demo heartbeats: the node may get its node-ID after its start") {
  HeartbeatWatch watch;
  watch.on_sent(frame("7E4#4F00000000000000"), 500, 1000);
  watch.on_sent(frame("77F#00"), 2000, 1000);
  watch.on_sent(frame("77F#7F"), 3010, 1000);
  CHECK(watch.greatest_lateness() == 10);
  CHECK(watch.number() == 1);
}

TEST_CASE("demo heartbeats: other frames and answers to node guarding are ignored") {
  HeartbeatWatch watch;
  watch.on_sent(frame("705#00"), 0, 0);
  watch.on_sent(frame("705#7F"), 1000, 0);
  watch.on_sent(frame("705#FF"), 5000, 0);
  watch.on_sent(frame("7E4#4F00000000000000"), 9000, 1000);
  watch.on_sent(frame("085#0081110000000000"), 9000, 1000);
  CHECK(watch.number() == 0);
  CHECK(watch.greatest_lateness() == 0);
}

#endif
