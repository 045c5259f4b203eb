// SPDX-License-Identifier: Apache-2.0
// SDO client: consecutive and simultaneous transfers.
#include "support/sdo_client_peer.hpp"
#include "support/sdo_client_states.hpp"

#if USE_CSDO

namespace {

using namespace test;

TEST_CASE("SDO client: a thousand uploads may each be started in the callback of the previous one") {
  SdoClient node;
  unsigned ended = 0;
  node.on_end = [&](const ClientEnd& end) {
    CHECK(end.code == 0);
    CHECK(end.data == Bytes{static_cast<std::uint8_t>(ended)});
    if (++ended < 1000) CHECK(node.try_upload(0x2000, 5, 4) == CO_ERR_NONE);
  };
  node.start_upload(0x2000, 5, 4);
  for (unsigned n = 0; n < 1000; ++n) {
    node.tx("605#4000200500000000");
    CO_IF_FRM answer = frame("585#4F00200500000000");
    answer.Data[4] = static_cast<std::uint8_t>(n);
    node.rx(answer);
  }
  node.silent();
  CHECK(ended == 1000);
  CHECK(node.ends.size() == 1000);
  node.ends.clear();
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("SDO client: a thousand time-outs of transfers that were each started in the callback of the previous one") {
  SdoClient node;
  unsigned ended = 0;
  node.on_end = [&](const ClientEnd& end) {
    CHECK(end.code == CO_SDO_ERR_TIMEOUT);
    if (++ended < 1000) CHECK(node.try_download(0x2000, 5, {1}, 10) == CO_ERR_NONE);
  };
  node.start_download(0x2000, 5, {1}, 10);
  for (unsigned n = 0; n < 999; ++n) {
    node.tx("605#2F00200501000000");
    node.after(10ms);
    REQUIRE(node.can.sent.size() == 2);
    CHECK(notation(node.can.sent.front().frm) == "605#8000200500000405");
    node.can.sent.pop_front();
  }
  node.tx("605#2F00200501000000");
  node.after(10ms);
  node.tx("605#8000200500000405");
  CHECK(ended == 1000);
  node.ends.clear();
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("SDO client: a callback may start a transfer of another kind, object and buffer") {
  SdoClient node;
  node.on_end = [&](const ClientEnd& end) {
    if (end.index == 0x2000) CHECK(node.try_download(0x2001, 0, counted(8)) == CO_ERR_NONE);
  };
  node.start_upload(0x2000, 5, 28);
  node.tx("605#4000200500000000");
  node.rx("585#4100200507000000");
  node.tx("605#6000000000000000");
  node.rx("585#01090A0B0C0D0E0F");
  node.tx("605#2101200008000000");
  const ClientEnd end = node.ended(0);
  CHECK(end.data == counted(7, 9));
  node.rx("585#6001200000000000");
  node.tx("605#0001020304050607");
  node.rx("585#2000000000000000");
  node.tx("605#1D08000000000000");
  node.rx("585#3000000000000000");
  CHECK(node.has_written().index == 0x2001);
}

TEST_CASE("SDO client: a transfer started in a callback has its own time-out") {
  SdoClient node;
  node.on_end = [&](const ClientEnd&) {
    node.on_end = nullptr;
    CHECK(node.try_upload(0x2000, 5, 4, 300) == CO_ERR_NONE);
  };
  node.start_upload(0x2000, 5, 4, 100);
  node.tx("605#4000200500000000");
  node.after(90ms);
  node.rx("585#4F00200511000000");
  node.has_read({0x11});
  node.tx("605#4000200500000000");
  node.after(299ms);
  node.goes_on();
  node.after(1ms);
  node.tx("605#8000200500000405");
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: ten thousand transfers of every kind and end leave no timer allocated") {
  Setup setup = Setup().only_small().timers(3);
  SdoClient node(setup);
  const std::vector<ClientState>& states = client_states();
  for (unsigned n = 0; n < 10000 / stride(50); ++n) {
    const ClientState& state = states[n % states.size()];
    enter(node, state, 100);
    if (n % 3 == 0) {
      node.rx("585#8000200520000008");
    } else if (n % 3 == 1) {
      node.cancel();
    } else {
      node.after(130ms);  // within a block the time-out may be a quarter longer
    }
    node.frames();
    node.ends.clear();
    REQUIRE(node.armed_timers() == 0);
  }
  node.call([&] {
    for (int n = 0; n < 3; ++n)
      CHECK(COTmrCreate(
                &node->Tmr, 0, 50, [](void*) {}, nullptr) >= 0);
  });
  node.start_upload(0x2000, 5, 4, 100);
  node.frames();
  CHECK(node.armed_timers() == 4);
  CHECK(node.counters().TimerExhausted == 0);
  node.rx("585#4F00200511000000");
  node.has_read({0x11});
  CHECK(node.armed_timers() == 3);
}

TEST_CASE("SDO client: it needs no timer of the application's pool") {
  SdoClient node(Setup().only_small().timers(0));
  node.start_upload(0x2000, 5, 4, 100);
  node.tx("605#4000200500000000");
  node.after(100ms);
  node.tx("605#8000200500000405");
  node.ended(CO_SDO_ERR_TIMEOUT);
}

TEST_CASE("SDO client: its transfers and those of the node's own server are independent") {
  SdoClient node;
  node.start_upload(0x2000, 5, 28);
  node.tx("605#4000200500000000");
  node.ask("601#2108200008000000", "581#6008200000000000");
  node.rx("585#4100200508000000");
  node.tx("605#6000000000000000");
  node.ask("601#0001020304050607", "581#2000000000000000");
  node.rx("585#0001020304050607");
  node.tx("605#7000000000000000");
  node.ask("601#1D08000000000000", "581#3000000000000000");
  node.rx("585#1D08000000000000");
  node.has_read(counted(8));
  CHECK(node.objects.u64 == 0x0807060504030201);
}

#if CO_CSDO_N >= 3

TEST_CASE("SDO client: three clients at once accept answers in any order") {
  constexpr const char* asked[] = {"605#4000200500000000", "606#4000200500000000", "607#4000200500000000"};
  constexpr const char* answers[] = {"585#4F00200511000000", "586#4F00200522000000", "587#4F00200533000000"};
  unsigned order[] = {0, 1, 2};
  do {
    SdoClient node;
    for (unsigned n = 0; n < 3; ++n) {
      node.start_upload(0x2000, 5, 4, 1000, n);
      node.tx(asked[n]);
    }
    for (const unsigned n : order) {
      node.rx(answers[n]);
      node.has_read({static_cast<std::uint8_t>(0x11 * (n + 1))}, n);
    }
  } while (std::next_permutation(std::begin(order), std::end(order)));
}

TEST_CASE("SDO client: three clients at once each have their own time-out, kind and end") {
  SdoClient node;
  node.start_upload(0x2000, 5, 28, 100, 0);
  node.start_download(0x2000, 5, counted(14), 200, 1);
  node.start_upload(0x2000, 5, 4, 300, 2);
  node.tx({"605#4000200500000000", "606#210020050E000000", "607#4000200500000000"});
  node.after(100ms);
  node.tx("605#8000200500000405");
  node.ended(CO_SDO_ERR_TIMEOUT, 0);
  node.rx("586#6000200500000000");
  node.tx("606#0001020304050607");
  node.after(199ms);
  CHECK(node.is_busy(1));
  CHECK(node.is_busy(2));
  node.after(1ms);
  node.frames();
  node.ended(CO_SDO_ERR_TIMEOUT, 1);
  node.ended(CO_SDO_ERR_TIMEOUT, 2);
}

TEST_CASE("SDO client: a callback may start or cancel a transfer of another client") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4, 1000, 0);
  node.start_upload(0x2000, 5, 4, 1000, 1);
  node.tx({"605#4000200500000000", "606#4000200500000000"});
  node.on_end = [&](const ClientEnd& end) {
    if (end.client != 0) return;
    CHECK(node.cancel(1) == CO_ERR_NONE);
    CHECK(node.try_upload(0x2000, 5, 4, 1000, 2) == CO_ERR_NONE);
  };
  node.rx("585#4F00200511000000");
  node.tx({"606#8000200521000008", "607#4000200500000000"});
  node.has_read({0x11}, 0);
  node.ended(CO_SDO_ERR_TOS_LOCAL, 1);
  node.rx("587#4F00200533000000");
  node.has_read({0x33}, 2);
}

TEST_CASE("SDO client: NMT stop ends the transfers of all clients and calls each callback once") {
  SdoClient node;
  for (unsigned n = 0; n < 3; ++n) node.start_upload(0x2000, 5, 4, 1000, n);
  node.frames();
  node.rx("000#0201");
  node.silent();
  for (unsigned n = 0; n < 3; ++n) node.ended(CO_SDO_ERR_TOS_STATE, n);
}

TEST_CASE("SDO client: a callback of an NMT stop may cancel the other clients; each callback is called once") {
  SdoClient node;
  for (unsigned n = 0; n < 3; ++n) node.start_upload(0x2000, 5, 4, 1000, n);
  node.frames();
  node.on_end = [&](const ClientEnd&) {
    for (unsigned n = 0; n < 3; ++n) node.cancel(n);
  };
  node.rx("000#0201");
  node.silent();
  CHECK(node.ends.size() == 3);
  for (unsigned n = 0; n < 3; ++n) CHECK_FALSE(node.is_busy(n));
  node.ends.clear();
}

#endif

}  // namespace

#endif
