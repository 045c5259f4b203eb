// SPDX-License-Identifier: Apache-2.0
// SDO client: callbacks that write the COB-IDs of their client and start a request with them. [301:7.5.2.34]
#include <algorithm>

#include "support/sdo_client_fixture.hpp"

namespace {

using namespace test;

#if USE_CSDO

// A node whose client 0 waits for a response at 585h.
class Waiting : public SdoClient {
 public:
  Waiting() {
    frames_per_call(4);  // answer of the server, aborts of the client, and the request of its callback
    may_change(0x1280, 1);
    may_change(0x1280, 2);
    start_upload(0x2000, 5, 28);
    tx("605#4000200500000000");
  }
  void switch_off(std::uint8_t sub) { CHECK(CODictWrLong(&node.Dict, CO_DEV(0x1280, sub), 0x80000000) == CO_ERR_NONE); }
  void write(std::uint8_t sub, std::uint32_t cob_id) {
    switch_off(sub);  // a valid CAN-ID must not be changed
    CHECK(CODictWrLong(&node.Dict, CO_DEV(0x1280, sub), cob_id) == CO_ERR_NONE);
  }
  void move_to(std::uint32_t tx_id, std::uint32_t rx_id) {
    write(1, tx_id);
    write(2, rx_id);
  }
};

// Checks that the open transfer accepts a response at 586h, and not at 585h.
void check_is_answered_at_586(SdoClient& node) {
  node.goes_on();
  node.rx("585#4F00200511000000");
  node.goes_on();
  node.rx("586#4F00200522000000");
  node.has_read({0x22});
  node.silent();
}

// Action that ends the transfer, and the frames sent for it.
struct End {
  const char* what;
  void (*happens)(Waiting& node);
  std::vector<std::string> sent;
  std::uint32_t code;
};

const std::vector<End>& all_ends() {
  static const std::vector<End> all = {
      {"written over the network",
       [](Waiting& node) { node.rx("601#2380120100000080"); },
       {"581#6080120100000000", "605#8000200522000008"},
       CO_SDO_ERR_TOS_STATE},
      {"written by the application",
       [](Waiting& node) { node.call([&] { node.switch_off(2); }); },
       {"605#8000200522000008"},
       CO_SDO_ERR_TOS_STATE},
      {"time-out", [](Waiting& node) { node.after(1000ms); }, {"605#8000200500000405"}, CO_SDO_ERR_TIMEOUT},
      {"abort of the server", [](Waiting& node) { node.rx("585#8000200520000008"); }, {}, CO_SDO_ERR_TOS},
      {"cancelled", [](Waiting& node) { node.cancel(); }, {"605#8000200521000008"}, CO_SDO_ERR_TOS_LOCAL},
  };
  return all;
}

TEST_CASE("SDO client: a callback that writes the client's COB-IDs after any result: the last written ones are used") {
  for (const End& end : all_ends()) {
    CAPTURE(std::string(end.what));
    Waiting node;
    node.on_end = [&](const ClientEnd&) { node.move_to(0x606, 0x586); };
    end.happens(node);
    CHECK(node.frames() == end.sent);
    node.ended(end.code);
    node.on_end = nullptr;
    CHECK(node.csdo()->State == CO_CSDO_STATE_IDLE);
    CHECK(std::count(node.can.filter.begin(), node.can.filter.end(), 0x586U) == (CO_CSDO_N >= 2 ? 2 : 1));
    node.start_upload(0x2000, 5, 4);
    node.tx("606#4000200500000000");
    check_is_answered_at_586(node);
  }
}

TEST_CASE("SDO client: a request started after the callback writes the client's COB-IDs uses the new ones") {
  for (const End& end : all_ends()) {
    CAPTURE(std::string(end.what));
    Waiting node;
    node.on_end = [&](const ClientEnd&) {
      node.on_end = nullptr;
      node.move_to(0x606, 0x586);
      CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_NONE);
    };
    end.happens(node);
    std::vector<std::string> sent = end.sent;
    sent.emplace_back("606#4000200500000000");
    CHECK(node.frames() == sent);
    node.ended(end.code);
    CHECK(node.is_watched());
    check_is_answered_at_586(node);
  }
}

TEST_CASE("SDO client: a request that the callback starts under new COB-IDs has its time-out") {
  Waiting node;
  node.on_end = [&](const ClientEnd&) {
    node.on_end = nullptr;
    node.move_to(0x606, 0x586);
    CHECK(node.try_download(0x2001, 0, counted(5), 100) == CO_ERR_NONE);
  };
  node.rx("601#2380120100000080");
  node.tx({"581#6080120100000000", "605#8000200522000008", "606#2101200005000000"});
  node.ended(CO_SDO_ERR_TOS_STATE);
  node.after(100ms);
  node.tx("606#8001200000000405");
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: a transfer that the callback starts before it writes the COB-IDs is reported") {
  Waiting node;
  node.on_end = [&](const ClientEnd&) {
    node.on_end = [&](const ClientEnd&) { node.on_end = nullptr; };
    node.write(1, 0x605);
    CHECK(node.try_upload(0x2001, 0, 4) == CO_ERR_NONE);
    node.move_to(0x606, 0x586);
  };
  node.rx("601#2380120100000080");
  node.tx({"581#6080120100000000", "605#8000200522000008", "605#4001200000000000", "605#8001200022000008"});
  REQUIRE(node.ends.size() == 2);
  for (const std::uint16_t index : {std::uint16_t{0x2000}, std::uint16_t{0x2001}}) {
    CHECK(node.ends.front().index == index);
    CHECK(node.ends.front().code == CO_SDO_ERR_TOS_STATE);
    node.ends.pop_front();
  }
  node.start_upload(0x2000, 5, 4);
  node.tx("606#4000200500000000");
  check_is_answered_at_586(node);
}

TEST_CASE("SDO client: transfers that repeatedly end with their COB-IDs have one callback each, without recursion") {
  Waiting node;
  unsigned ended = 0;
  unsigned depth = 0;
  node.on_end = [&](const ClientEnd& end) {
    CHECK(end.code == CO_SDO_ERR_TOS_STATE);
    CHECK(++depth == 1);
    if (++ended < 50) {
      node.write(1, 0x605);
      CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_NONE);
      node.write(1, 0x606);
    }
    --depth;
  };
  node.frames_per_call(100);
  node.rx("601#2380120100000080");
  CHECK(ended == 50);
  CHECK(node.ends.size() == 50);
  node.ends.clear();
  const std::vector<std::string> sent = node.frames();
  CHECK(sent.size() == 1 + 50 + 49);
  for (std::size_t n = 1; n < sent.size(); ++n) {
    CHECK(sent[n] == (n % 2 == 1 ? "605#8000200522000008" : "605#4000200500000000"));
  }
  CHECK(node.csdo()->State == CO_CSDO_STATE_IDLE);
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("SDO client: the callback of a client that is switched off cannot start a request without new COB-IDs") {
  Waiting node;
  CO_ERR err = CO_ERR_NONE;
  node.on_end = [&](const ClientEnd&) { err = node.try_upload(0x2001, 0, 4); };
  node.rx("601#2380120100000080");
  CHECK(err == CO_ERR_SDO_OFF);
  node.tx({"581#6080120100000000", "605#8000200522000008"});
  node.ended(CO_SDO_ERR_TOS_STATE);
  CHECK(node.csdo()->State == CO_CSDO_STATE_INVALID);
}

#if CO_CSDO_N >= 2

TEST_CASE("SDO client: the callback of one client switches another off: each transfer is aborted and reported once") {
  Waiting node;
  node.may_change(0x1281, 1);
  node.start_upload(0x2001, 0, 4, 1000, 1);
  node.tx("606#4001200000000000");
  node.on_end = [&](const ClientEnd&) {
    node.on_end = nullptr;
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1281, 1), 0x80000606) == CO_ERR_NONE);
  };
  node.rx("601#2380120100000080");
  node.tx({"581#6080120100000000", "605#8000200522000008", "606#8001200022000008"});
  node.ended(CO_SDO_ERR_TOS_STATE, 0);
  node.ended(CO_SDO_ERR_TOS_STATE, 1);
  CHECK(node.armed_timers() == 0);
}

#endif

#endif

// SDO clients with the same response COB-ID, and callbacks that configure them while a frame is passed to each.

#if USE_CSDO && CO_CSDO_N >= 3

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

#endif

}  // namespace
