// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "support/fixture.hpp"

namespace {

using namespace test;

void send(Fixture& node, const char* text) {
  CO_IF_FRM frm = frame(text);
  node.call([&] { COIfCanSend(&node->If, &frm); });
}

std::vector<std::string> released(Fixture& node) {
  node.can.accept_all();
  node.loop();
  return node.frames();
}

using Frames = std::vector<std::string>;

TEST_CASE("transmit queue: a frame is passed directly to a driver that accepts it") {
  Fixture node;
  send(node, "181#0102");
  node.tx("181#0102");
  CHECK(node->TxQueue.Num == 0);
  CHECK(node.counters().Sent == 2);  // including the boot-up message
}

TEST_CASE("transmit queue: the priority is that of the bus, 11-bit before 29-bit identifiers [Q4]") {
  Fixture node(Setup().tx_queue(20));
  node.can.refuse_all();
  for (const char* text : {"7FF#01", "091#02", "1FFFFFFF#03", "02440000#04", "0243FFFF#05", "080#06", "00000001#07"}) {
    send(node, text);
  }
  // 02440000h has the base identifier 091h: of equal base identifiers, the 11-bit frame wins.
  CHECK(released(node) ==
        Frames{"00000001#07", "080#06", "0243FFFF#05", "091#02", "02440000#04", "7FF#01", "1FFFFFFF#03"});
}

TEST_CASE("transmit queue: frames of one identifier keep their order [Q4]") {
  Fixture node(Setup().tx_queue(20));
  node.can.refuse_all();
  for (const char* text : {"181#01", "180#11", "181#02", "180#12", "181#03"}) send(node, text);
  CHECK(released(node) == Frames{"180#11", "180#12", "181#01", "181#02", "181#03"});
}

// Returns the number of elements that frames of the application may use. The others, at most half of the queue, are
// reserved for a frame of each SDO server and client, an EMCY message and a heartbeat.
unsigned limit_for_application(unsigned length) {
  const unsigned clients = USE_CSDO != 0 ? CO_CSDO_N : 0U;
  const unsigned kept = std::min(length / 2, 2U + CO_SSDO_N + clients);
  return length - kept;
}

TEST_CASE("transmit queue: the application can fill all slots except those of the node's own frames [Q4]") {
  for (const unsigned length : {1U, 2U, 3U, 7U, 8U, 20U}) {
    CAPTURE(length);
    Fixture node(Setup().tx_queue(static_cast<std::uint16_t>(length)));
    node.can.refuse_all();
    for (unsigned i = 0; i < length + 5; ++i) send(node, "181#01");
    CHECK(node.counters().Dropped == length + 5 - limit_for_application(length));
    CHECK(released(node).size() == limit_for_application(length));
  }
}

TEST_CASE("transmit queue: without memory of the application it has CO_TX_QUEUE_N slots") {
  Fixture node;
  node.can.refuse_all();
  for (int i = 0; i < CO_TX_QUEUE_N; ++i) send(node, "181#01");
  CHECK(released(node).size() == limit_for_application(CO_TX_QUEUE_N));
}

TEST_CASE("transmit queue: if it is full of the node's own frames a further one is dropped and counted") {
  Fixture node(Setup().tx_queue(2));
  node.can.refuse_all();
  for (int i = 0; i < 4; ++i) node.rx("601#4000100000000000");
  CHECK(node.counters().Dropped == 2);
  CHECK(released(node) == Frames{"581#4300100091010F00", "581#4300100091010F00"});
}

TEST_CASE("transmit queue: if it is full of responses from before a reset the boot-up message replaces the last one") {
  Fixture node(Setup().tx_queue(2));
  node.can.refuse_all();
  for (int i = 0; i < 2; ++i) node.rx("601#4000100000000000");
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
  CHECK(node.counters().Dropped == 1);
  CHECK(released(node) == Frames{"581#4300100091010F00", "701#00"});
}

TEST_CASE("transmit queue: frames that a driver refuses are sent later") {
  Fixture node(Setup().tx_queue(20));
  node.can.refuse_all();
  for (const char* text : {"181#01", "182#02", "183#03"}) send(node, text);
  node.can.accept_all();
  node.can.refuse_nth(2);
  node.call([&] { CONodeProcess(&node.node); });
  node.tx("181#01");
  node.call([&] { CONodeProcess(&node.node); });
  node.tx({"182#02", "183#03"});
}

TEST_CASE("transmit queue: an error of the driver is reported and the frame is kept") {
  Fixture node;
  node.can.refuse_next(1, -1);
  send(node, "181#01");
  CHECK(node.error() == CO_ERR_IF_CAN_SEND);
  CHECK(released(node) == Frames{"181#01"});
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("transmit queue: random frames are sent in the order of a model") {
  std::mt19937 random(7);
  for (unsigned round = 0; round < 100 / stride(10); ++round) {
    Fixture node(Setup().tx_queue(30).only_small());
    std::vector<CO_IF_FRM> waiting;
    for (int step = 0; step < 60; ++step) {
      const bool refuse = random() % 3 != 0;
      refuse ? node.can.refuse_all() : node.can.accept_all();
      CO_IF_FRM frm = frame("180#0000");
      frm.Identifier += static_cast<std::uint32_t>(random() % 4);
      frm.Data[0] = static_cast<std::uint8_t>(step);
      const bool fits = waiting.size() < limit_for_application(30) || !refuse;
      if (fits) {
        const auto behind = [](const CO_IF_FRM& a, const CO_IF_FRM& b) { return a.Identifier < b.Identifier; };
        if (!refuse) {
          Frames expected;
          for (const CO_IF_FRM& f : waiting) expected.push_back(notation(f));
          waiting.clear();
          expected.push_back(notation(frm));
          node.call([&] { COIfCanSend(&node->If, &frm); });
          CHECK(node.frames() == expected);
          continue;
        }
        waiting.insert(std::upper_bound(waiting.begin(), waiting.end(), frm, behind), frm);
      }
      node.call([&] { COIfCanSend(&node->If, &frm); });
      node.silent();
    }
    Frames rest;
    for (const CO_IF_FRM& f : waiting) rest.push_back(notation(f));
    CHECK(released(node) == rest);
  }
}

}  // namespace
