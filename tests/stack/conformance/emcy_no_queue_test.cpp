// SPDX-License-Identifier: Apache-2.0
// EMCY messages without their queue (CO_EMCY_QUEUE_N 0): no inhibit time, no attempt to send again.
#include "support/emcy_fixture.hpp"

#if USE_EMCY && CO_EMCY_QUEUE_N == 0

namespace {

using namespace test;

TEST_CASE("EMCY without queue: messages are sent at once whatever inhibit time 1015h has") {
  EmcyNode node(Setup().emergencies(errors_of_device()), 100);
  node.set(general);
  node.set(hot);
  node.clr(hot);
  node.tx({"081#0010010000000000", "081#0040090000000000", "081#0000010000000000"});
}

TEST_CASE("EMCY without queue: a message while 1014h is not valid is not sent later") {
  EmcyNode node(Setup().emergencies(errors_of_device()));
  node.ask("601#2314100081000080", "581#6014100000000000");
  node.set(general);
  node.ask("601#2314100081000000", "581#6014100000000000");
  node.after(1s);
  node.silent();
  CHECK(node.error_register() == 1);
}

TEST_CASE("EMCY without queue: a message that finds the transmit queue full is lost and counted") {
  EmcyNode node(Setup().emergencies(errors_of_device()));
  node.can.refuse_all();
  for (unsigned n = 0; n <= CO_TX_QUEUE_N; ++n) {
    n % 2 == 0 ? node.set(general) : node.clr(general);
  }
  CHECK(node.counters().Dropped == 1);
}

}  // namespace

#endif
