// SPDX-License-Identifier: Apache-2.0
// SDO client: transfers that its node ends by COCSdoCancel() or by a change of the NMT state. [N8]
#include "support/sdo_client_peer.hpp"
#include "support/sdo_client_states.hpp"

#if USE_CSDO

namespace {

using namespace test;

constexpr const char* cancelled = "605#8000200521000008";

TEST_CASE("SDO client: COCSdoCancel in every state aborts the transfer and calls the callback before it returns") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state);
    const std::uint32_t num = node.num();
    CO_ERR err = CO_ERR_BAD_ARG;
    node.call([&] {
      err = COCSdoCancel(node.csdo());
      CHECK(node.ends.size() == 1);
    });
    CHECK(err == CO_ERR_NONE);
    node.tx(cancelled);
    CHECK(node.ended(CO_SDO_ERR_TOS_LOCAL).num == num);
    CHECK(node.cancel() == CO_ERR_SDO_OFF);
    node.after(5000ms);
    node.silent();
    check_asks(node);
  }
}

TEST_CASE("SDO client: COCSdoCancel without a transfer returns CO_ERR_SDO_OFF and sends nothing") {
  SdoClient node;
  CHECK(node.cancel() == CO_ERR_SDO_OFF);
  check_asks(node);
  CHECK(node.cancel() == CO_ERR_SDO_OFF);
  node.silent();
}

TEST_CASE("SDO client: COCSdoCancel after an elapsed time-out before its timer runs calls the callback once") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4, 100);
  node.frames();
  node.elapse_only(100ms);
  CHECK(node.cancel() == CO_ERR_NONE);
  node.tx(cancelled);
  node.ended(CO_SDO_ERR_TOS_LOCAL);
  node.after(1000ms);
  node.silent();
  check_asks(node);
}

TEST_CASE("SDO client: COCSdoCancel within the callback returns CO_ERR_SDO_OFF") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state);
    CO_ERR err = CO_ERR_NONE;
    node.on_end = [&](const ClientEnd&) { err = node.cancel(); };
    node.rx("585#8000200520000008");
    CHECK(err == CO_ERR_SDO_OFF);
    node.silent();
    node.ended(CO_SDO_ERR_TOS);
  }
}

TEST_CASE("SDO client: COCSdoCancel within the callback of COCSdoCancel does not recurse") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4);
  node.frames();
  CO_ERR err = CO_ERR_NONE;
  node.on_end = [&](const ClientEnd&) { err = node.cancel(); };
  CHECK(node.cancel() == CO_ERR_NONE);
  CHECK(err == CO_ERR_SDO_OFF);
  node.tx(cancelled);
  node.ended(CO_SDO_ERR_TOS_LOCAL);
}

TEST_CASE("SDO client: a request within the callback of COCSdoCancel is started") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4);
  node.frames();
  node.on_end = [&](const ClientEnd&) {
    node.on_end = nullptr;
    CHECK(node.try_upload(0x2001, 0, 4) == CO_ERR_NONE);
  };
  CHECK(node.cancel() == CO_ERR_NONE);
  node.tx({cancelled, "605#4001200000000000"});
  node.ended(CO_SDO_ERR_TOS_LOCAL);
  node.rx("585#4F01200011000000");
  node.has_read({0x11});
}

TEST_CASE("SDO client: NMT stop ends a transfer in every state with 0800 0022h and without a frame [N8]") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state);
    node.rx("000#0201");
    node.silent();
    node.ended(CO_SDO_ERR_TOS_STATE);
    CHECK(node.armed_timers() == 0);
    node.rx("585#0001020304050607");
    node.after(5000ms);
    node.silent();
    CHECK(node.try_upload(0x2001, 0, 4) == CO_ERR_SDO_OFF);
    node.rx("000#8001");
    check_asks(node);
  }
}

TEST_CASE("SDO client: NMT resets end a transfer in every state with 0800 0022h; only the boot-up is sent [N8] [T14]") {
  for (const char* command : {"000#8101", "000#8201"}) {
    for (const ClientState& state : client_states()) {
      CAPTURE(state.name);
      SdoClient node;
      enter(node, state);
      node.rx(command);
      node.tx("701#00");
      node.ended(CO_SDO_ERR_TOS_STATE);
      CHECK(node.armed_timers() == 0);
      node.rx("585#0001020304050607");
      node.after(5000ms);
      node.silent();
      check_asks(node);
    }
  }
}

TEST_CASE("SDO client: a reset by the application ends a transfer with 0800 0022h [T14]") {
  for (const CO_NMT_RESET type : {CO_RESET_NODE, CO_RESET_COM}) {
    SdoClient node;
    node.start_upload(0x2000, 5, 4);
    node.frames();
    node.call([&] { CONmtReset(&node->Nmt, type); });
    node.tx("701#00");
    node.ended(CO_SDO_ERR_TOS_STATE);
    check_asks(node);
  }
}

TEST_CASE("SDO client: CONodeStop ends a transfer in every state with 0800 0022h and without a frame [N8]") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state);
    node.call([&] { CONodeStop(&node.node); });
    node.silent();
    node.ended(CO_SDO_ERR_TOS_STATE);
    CHECK(node.armed_timers() == 0);
    CHECK(node.cancel() == CO_ERR_SDO_OFF);
    node.after(5000ms);
    node.silent();
  }
}

TEST_CASE("SDO client: changes between Operational and Pre-operational end no transfer [N3] [N7]") {
  for (const ClientState& state : client_states()) {
    CAPTURE(state.name);
    SdoClient node;
    enter(node, state);
    node.rx("000#0101");
    node.rx("000#8001");
    node.rx("000#0101");
    node.silent();
    node.goes_on();
    node.cancel();
    node.tx(cancelled);
    node.ended(CO_SDO_ERR_TOS_LOCAL);
  }
}

TEST_CASE("SDO client: a request within the callback of an NMT stop is refused and sends nothing") {
  SdoClient node;
  CO_ERR err = CO_ERR_NONE;
  node.on_end = [&](const ClientEnd&) { err = node.try_upload(0x2001, 0, 4); };
  node.start_upload(0x2000, 5, 4);
  node.frames();
  node.rx("000#0201");
  CHECK(err == CO_ERR_SDO_OFF);
  node.silent();
  node.ended(CO_SDO_ERR_TOS_STATE);
}

TEST_CASE(
    "SDO client: a request within the callback of a reset is refused: one boot-up, no timer, no second callback") {
  for (const char* command : {"000#8101", "000#8201"}) {
    SdoClient node;
    CO_ERR err = CO_ERR_NONE;
    node.on_end = [&](const ClientEnd&) { err = node.try_upload(0x2001, 0, 4); };
    node.start_upload(0x2000, 5, 4);
    node.frames();
    node.rx(command);
    CHECK(err == CO_ERR_SDO_OFF);
    node.tx("701#00");
    node.ended(CO_SDO_ERR_TOS_STATE);
    CHECK(node.armed_timers() == 0);
    node.on_end = nullptr;
    check_asks(node);
  }
}

TEST_CASE("SDO client: a callback of CONodeStop that runs the timers sends no heartbeat") {
  SdoClient node(Setup().only_small().heartbeat(100));
  node.start_upload(0x2000, 0, 4);
  node.frames();
  node.elapse_only(100ms);
  node.on_end = [&](const ClientEnd&) { COTmrProcess(&node->Tmr); };
  node.call([&] { CONodeStop(&node.node); });
  node.silent();
  node.ended(CO_SDO_ERR_TOS_STATE);
}

TEST_CASE("SDO client: a request within the callback of CONodeStop is refused") {
  SdoClient node;
  CO_ERR err = CO_ERR_NONE;
  node.on_end = [&](const ClientEnd&) { err = node.try_upload(0x2001, 0, 4); };
  node.start_upload(0x2000, 5, 4);
  node.frames();
  node.call([&] { CONodeStop(&node.node); });
  CHECK(err == CO_ERR_SDO_OFF);
  node.silent();
  node.ended(CO_SDO_ERR_TOS_STATE);
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("SDO client: the callback may change the NMT state and reset or stop the node [Q9]") {
  const std::vector<std::function<void(CO_NODE*)>> actions = {
      [](CO_NODE* n) { CONmtSetMode(&n->Nmt, CO_STOP); }, [](CO_NODE* n) { CONmtReset(&n->Nmt, CO_RESET_NODE); },
      [](CO_NODE* n) { CONmtReset(&n->Nmt, CO_RESET_COM); }, [](CO_NODE* n) { CONodeStop(n); }};
  for (const char* answer : {"585#4F00200511000000", "585#8000200520000008", "585#E000200500000000"}) {
    for (std::size_t n = 0; n < actions.size(); ++n) {
      CAPTURE(std::string(answer));
      CAPTURE(n);
      SdoClient node;
      node.start_upload(0x2000, 5, 4);
      node.frames();
      node.on_end = [&](const ClientEnd&) { actions[n](&node.node); };
      node.rx(answer);
      node.frames();
      CHECK(node.ends.size() == 1);
      node.ends.clear();
      const CO_MODE modes[] = {CO_STOP, CO_PREOP, CO_PREOP, CO_INVALID};
      CHECK(node.mode() == modes[n]);
    }
  }
}

TEST_CASE("SDO client: the callback of a time-out may stop or reset the node [Q9]") {
  SdoClient one;
  one.start_upload(0x2000, 5, 4, 100);
  one.frames();
  one.on_end = [&](const ClientEnd&) { CONodeStop(&one.node); };
  one.after(100ms);
  one.frames();
  one.ended(CO_SDO_ERR_TIMEOUT);
  CHECK(one.mode() == CO_INVALID);
  SdoClient two;
  two.start_upload(0x2000, 5, 4, 100);
  two.frames();
  two.on_end = [&](const ClientEnd&) { CONmtReset(&two->Nmt, CO_RESET_COM); };
  two.after(100ms);
  two.tx({"605#8000200500000405", "701#00"});
  two.ended(CO_SDO_ERR_TIMEOUT);
  two.on_end = nullptr;
  check_asks(two);
}

TEST_CASE("SDO client: CONodeInit discards a transfer without its callback") {
  SdoClient node;
  node.start_upload(0x2000, 5, 4, 100);
  node.frames();
  node.call([&] { CONodeStop(&node.node); });
  node.ended(CO_SDO_ERR_TOS_STATE);
  node.init_again();
  CHECK(node.csdo()->State == CO_CSDO_STATE_IDLE);
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  node.after(200ms);
  CHECK(node.ends.empty());
  check_asks(node);
}

// SDO client: consecutive and simultaneous transfers.

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
