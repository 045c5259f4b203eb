// SPDX-License-Identifier: Apache-2.0
// SDO clients with the same response COB-ID, and callbacks that configure them while a frame is passed to each.
#include <algorithm>

#include "support/sdo_client_fixture.hpp"

#if USE_CSDO && CO_CSDO_N >= 3

namespace {

using namespace test;

// Response COB-IDs: clients 0 and 1 at 585h, client 2 at 587h; or all at 585h.
ClientEntries two_at_585() { return {{{0x605, 0x585, 5}, {0x606, 0x585, 6}, {0x607, 0x587, 7}}}; }
ClientEntries three_at_585() { return {{{0x605, 0x585, 5}, {0x606, 0x585, 6}, {0x607, 0x585, 7}}}; }

// Returns the settings of a node whose SDO servers are all valid, so that each has a route.
Setup all_servers() {
  return Setup()
      .only_small()
      .with({CO_KEY(0x1203, 1, CO_OBJ_D___R_), CO_TSDO_ID, 0x692})
      .with({CO_KEY(0x1203, 2, CO_OBJ_D___R_), CO_TSDO_ID, 0x6A2})
      .before_init([](Objects& o) {
        o.sdo2_rx = 0x690;
        o.sdo2_tx = 0x6A0;
        o.sdo3_rx = 0x691;
        o.sdo3_tx = 0x6A1;
      });
}

// A node whose callbacks may write to 1280h, 1281h and 1282h.
struct Clients : SdoClient {
  explicit Clients(const ClientEntries& entries) : SdoClient(all_servers(), entries) {
    for (unsigned index = 0x1280; index < 0x1283; ++index) {
      for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) {
        may_change(static_cast<std::uint16_t>(index), sub);
      }
    }
  }
};

void start(SdoClient& node, unsigned client, std::uint16_t index) {
  node.start_upload(index, 0, 4, 1000, client);
  node.frames();
}

TEST_CASE(
    "SDO client: clients at one response COB-ID all receive a frame; each accepts the answer to its request once") {
  Clients node(two_at_585());
  start(node, 0, 0x2001);
  start(node, 1, 0x2001);
  node.rx("585#4F01200011000000");
  node.has_read({0x11}, 0);
  node.has_read({0x11}, 1);
  start(node, 0, 0x2001);
  start(node, 1, 0x2002);
  node.rx("585#4F02200022000000");
  node.has_read({0x22}, 1);
  node.goes_on(0);
  node.rx("585#4F01200011000000");
  node.has_read({0x11}, 0);
  node.silent();
}

TEST_CASE("SDO client: an abort at a shared response COB-ID ends only the transfer with its multiplexer") {
  Clients node(two_at_585());
  start(node, 0, 0x2001);
  start(node, 1, 0x2002);
  node.rx("585#8002200000000206");
  node.ended(CO_SDO_ERR_OBJ, 1);
  node.goes_on(0);
  node.silent();
}

// The client's route moves behind that of the other client, which receives the frame later.
TEST_CASE("SDO client: a callback that changes the request COB-ID and starts a request: one frame is one answer") {
  Clients node(two_at_585());
  start(node, 0, 0x2001);
  start(node, 1, 0x2002);
  node.on_end = [&](const ClientEnd&) {
    node.on_end = nullptr;
    node.entry[0].tx = 0x609;
    CHECK(node.try_upload(0x2001, 0, 4) == CO_ERR_NONE);
  };
  node.rx("585#4F01200011000000");
  node.tx("609#4001200000000000");
  node.has_read({0x11}, 0);
  node.goes_on(0);
  node.goes_on(1);
  node.rx("585#4F01200033000000");
  node.has_read({0x33}, 0);
}

// The route of client 1 moves forward in the table.
TEST_CASE(
    "SDO client: a callback that switches off the previous client and starts a request: one frame is one answer") {
  Clients node(three_at_585());
  start(node, 1, 0x2001);
  node.on_end = [&](const ClientEnd&) {
    node.on_end = nullptr;
    node.entry[0].tx = 0x80000000;
    CHECK(COCSdoFind(&node.node, 0) == nullptr);
    CHECK(node.try_upload(0x2001, 0, 4, 1000, 1) == CO_ERR_NONE);
  };
  node.rx("585#4F01200011000000");
  node.tx("606#4001200000000000");
  node.has_read({0x11}, 1);
  node.goes_on(1);
  node.rx("585#4F01200022000000");
  node.has_read({0x22}, 1);
}

TEST_CASE("SDO client: a callback that changes the COB-IDs of another client: it does not receive the frame") {
  Clients node(two_at_585());
  start(node, 0, 0x2001);
  node.on_end = [&](const ClientEnd&) {
    node.on_end = nullptr;
    node.entry[1].rx = 0x586;
    CHECK(node.try_upload(0x2001, 0, 4, 1000, 1) == CO_ERR_NONE);
  };
  node.rx("585#4F01200011000000");
  node.tx("606#4001200000000000");
  node.has_read({0x11}, 0);
  node.goes_on(1);
  node.rx("586#4F01200022000000");
  node.has_read({0x22}, 1);
}

// The routes are the last ones of a full table.
TEST_CASE("SDO client: a callback that changes its request COB-ID: the other clients receive the frame") {
  Clients node(two_at_585());
  start(node, 0, 0x2001);
  start(node, 1, 0x2001);
  node.on_end = [&](const ClientEnd& end) {
    if (end.client != 0) return;
    node.entry[0].tx = 0x609;
    CHECK(COCSdoFind(&node.node, 0) != nullptr);
  };
  node.rx("585#4F01200011000000");
  node.has_read({0x11}, 0);
  node.has_read({0x11}, 1);
}

TEST_CASE("SDO client: however callbacks reorder the clients, none receives a frame twice") {
  Clients node(two_at_585());
  start(node, 0, 0x2001);
  start(node, 1, 0x2001);
  node.on_end = [&](const ClientEnd& end) {
    if (end.client != 1) return;
    node.on_end = nullptr;
    node.entry[0].tx = 0x609;
    CHECK(node.try_upload(0x2001, 0, 4, 1000, 0) == CO_ERR_NONE);
    node.entry[2].rx = 0x584;
    CHECK(COCSdoFind(&node.node, 2) != nullptr);
  };
  node.rx("585#4F01200011000000");
  node.tx("609#4001200000000000");
  node.has_read({0x11}, 0);
  node.has_read({0x11}, 1);
  CHECK(node.is_busy(0));
}

ClientEntries at_the_end() { return {{{0x6B0, 0x6B5, 5}, {0x6B1, 0x6B5, 6}, {0x6B2, 0x6B5, 7}}}; }

TEST_CASE("SDO client: a callback that sets the other clients to the own node: they do not receive the frame") {
  Clients node(at_the_end());
  start(node, 0, 0x2001);
  node.on_end = [&](const ClientEnd&) {
    node.on_end = nullptr;
    for (const unsigned other : {1U, 2U}) {
      node.entry[other].node_id = 1;
      CHECK(node.try_upload(0x2001, 0, 4, 1000, other) == CO_ERR_NONE);
    }
  };
  node.rx("6B5#4F01200022000000");
  node.has_read({0x22}, 0);
  node.goes_on(1);
  node.goes_on(2);
  node.after(5ms);
  node.has_read({0x11}, 1);
  node.has_read({0x11}, 2);
  node.silent();
}

TEST_CASE("SDO client: a callback that switches all clients off: no client receives this frame or the next one") {
  for (const unsigned asking : {0U, 1U, 2U}) {
    CAPTURE(asking);
    Clients node(at_the_end());
    start(node, asking, 0x2001);
    node.on_end = [&](const ClientEnd&) {
      for (unsigned n = 0; n < 3; ++n) {
        node.entry[n].rx = 0x80000000;
        CHECK(COCSdoFind(&node.node, static_cast<std::uint8_t>(n)) == nullptr);
      }
    };
    node.rx("6B5#4F01200022000000");
    node.has_read({0x22}, asking);
    const std::uint32_t unclaimed = node.counters().Unclaimed;
    node.rx("6B5#4F01200022000000");
    CHECK(node.counters().Unclaimed == unclaimed + 1);
    CHECK(node.counters().Malformed == 0);
    CHECK(std::count(node.can.filter.begin(), node.can.filter.end(), 0x6B5U) == 0);
    node.silent();
  }
}

TEST_CASE("SDO client: callbacks that move their client in the table and start requests get one answer each") {
  for (unsigned changed = 0; changed < 27; ++changed) {
    CAPTURE(changed);
    Clients node(at_the_end());
    // Client that the callback of each client moves. The COB-ID of a busy one becomes effective with its next request.
    const unsigned targets[] = {changed % 3, changed / 3 % 3, changed / 9};
    for (unsigned n = 0; n < 3; ++n) start(node, n, 0x2001);
    unsigned calls[3] = {};
    node.on_end = [&](const ClientEnd& end) {
      const unsigned target = targets[end.client];
      if (++calls[end.client] > 1) return;
      node.entry[target].tx += 0x10;
      if (!node.is_busy(target)) CHECK(node.try_upload(0x2001, 0, 4, 1000, target) == CO_ERR_NONE);
    };
    node.rx("6B5#4F01200022000000");
    for (const unsigned number : calls) CHECK(number <= 1);
    node.ends.clear();
    node.frames();
  }
}

}  // namespace

#endif
