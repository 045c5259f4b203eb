// SPDX-License-Identifier: Apache-2.0
// The test fixture: faults of a node that it has to detect.
#include <cstdlib>

#include "support/fixture.hpp"

namespace {

using namespace test;

TEST_CASE("fixture: the notation of frames is parsed and printed") {
  for (const std::string text : {"123#", "601#2100", "7FF#1122334455667788", "00000601#11", "1FFFFFFF#", "123#R",
                                 "00000123#R", "20000040#0000000000000000", "123#1122334455667788_9"}) {
    CHECK(notation(frame(text)) == text);
  }
  CHECK(frame("00000123#").Identifier == 0x80000123);
  CHECK(frame("123#R").Identifier == 0x40000123);
  CHECK(frame("20000040#").Identifier == 0x20000040);
  CHECK(frame("123#R8").DLC == 8);
  CHECK(frame("123#1122334455667788_F").DLC == 15);
  CHECK(frame("601#40").DLC == 1);
}

TEST_CASE("fixture: frames that a node may send") {
  for (const char* text :
       {"581#4312345611223344", "581#4712345611223300", "581#4B12345611220000", "581#4F12345611000000",
        "581#4112345611223344", "581#4012345600000000", "581#0011223344556677", "581#0B11220000000000",
        "581#0F00000000000000", "581#2000000000000000", "581#3000000000000000", "581#6012345600000000",
        "581#8012345601000405"}) {
    CHECK(fault_of(frame(text), 1, CO_PREOP, true) == "");
    CHECK(fault_of(frame(text), 1, CO_STOP, true) != "");
    CHECK(fault_of(frame(text), 1, CO_INIT, true) != "");
  }
  CHECK(fault_of(frame("701#00"), 1, CO_PREOP, false) == "");
  CHECK(fault_of(frame("701#7F"), 1, CO_PREOP, false) == "");
  CHECK(fault_of(frame("701#05"), 1, CO_OPERATIONAL, false) == "");
  CHECK(fault_of(frame("701#04"), 1, CO_STOP, false) == "");
}

TEST_CASE("fixture: frames that a node must not send") {
  for (const char* text :
       {"581#43123456112233", "581#4712345611223344", "581#4B12345611223300", "581#4F12345611220000",
        "581#4012345600000001", "581#4212345600000000", "581#0B11223300000000", "581#0A11220000000000",
        "581#0F01000000000000", "581#2001000000000000", "581#2100000000000000", "581#6012345601000000",
        "581#6112345600000000", "581#8012345600000000", "581#8112345601000405", "581#A012345600000000",
        "581#C012345600000000", "581#E012345600000000"}) {
    CHECK(fault_of(frame(text), 1, CO_PREOP, true) != "");
  }
  CHECK(fault_of(frame("000#0101"), 1, CO_PREOP, false) != "");
  CHECK(fault_of(frame("701#0000"), 1, CO_PREOP, false) != "");
  CHECK(fault_of(frame("701#05"), 1, CO_PREOP, false) != "");
  CHECK(fault_of(frame("701#7F"), 1, CO_STOP, false) != "");
  CHECK(fault_of(frame("701#00"), 1, CO_STOP, false) != "");
  CO_IF_FRM stale = frame("701#7F");
  stale.Data[1] = 1;
  CHECK(fault_of(stale, 1, CO_PREOP, false) != "");
}

TEST_CASE("fixture: heap requests count inside the stack only") {
  const auto request = [] {
    void* volatile memory = std::malloc(100);
    std::free(memory);
  };
  const std::uint64_t before = heap_requests();
  request();
  CHECK(heap_requests() == before);
  {
    const InsideStack inside;
    request();
    const OutsideStack outside;
    request();
  }
  CHECK(heap_requests() == before + 1);
}

TEST_CASE("fixture: an unexpected frame fails" * doctest::should_fail()) {
  Fixture node;
  node.ask("601#4000100000000000", "581#4300100091010F01");
}

TEST_CASE("fixture: a further frame fails" * doctest::should_fail()) {
  Fixture node(Setup().heartbeat(10));
  node.after(20ms);
  node.tx("701#7F");
}

TEST_CASE("fixture: a missing frame fails" * doctest::should_fail()) {
  Fixture node;
  node.tx("701#7F");
}

TEST_CASE("fixture: the order of frames matters" * doctest::should_fail()) {
  Fixture node(Setup().heartbeat(10));
  node.after(10ms);
  node.can.to_node.push_back(frame("601#4000100000000000"));
  node.loop();
  node.tx({"581#4300100091010F00", "701#7F"});
}

TEST_CASE("fixture: a frame at another time fails" * doctest::should_fail()) {
  Fixture node(Setup().heartbeat(10));
  node.after(10ms);
  node.tx_at(9ms, "701#7F");
}

TEST_CASE("fixture: a frame that the test does not check fails" * doctest::should_fail()) {
  Fixture node;
  node.rx("601#4000100000000000");
}

TEST_CASE("fixture: a change of memory without a download fails" * doctest::should_fail()) {
  Fixture node;
  node.call([&] { node.objects.read_only = 1; });
}

TEST_CASE("fixture: a change of memory by a download of another object fails" * doctest::should_fail()) {
  const auto four = [](CO_OBJ*, CO_NODE*, std::uint32_t) -> std::uint32_t { return 4; };
  const auto write = [](CO_OBJ*, CO_NODE* node, void*, std::uint32_t) -> CO_ERR {
    return CODictWrByte(&node->Dict, CO_DEV(0x2001, 0), 0x77);
  };
  const CO_OBJ_TYPE type = {four, nullptr, nullptr, write, nullptr};
  Fixture node(Setup().with({CO_KEY(0x3000, 0, CO_OBJ_____RW), &type, 0}));
  node.ask("601#2300300000000000", "581#6000300000000000");
}

TEST_CASE("fixture: heap use while the stack runs fails" * doctest::should_fail()) {
  Fixture node;
  node.call([] {
    void* volatile memory = std::malloc(10);
    std::free(memory);
  });
}

TEST_CASE("fixture: a second frame processed in one call fails" * doctest::should_fail()) {
  Fixture node;
  callbacks().can_receive = [&](CO_IF_FRM*) {
    CO_IF_FRM frm = frame("181#01");
    COIfCanSend(&node->If, &frm);
    COIfCanSend(&node->If, &frm);
  };
  node.rx("123#");
  node.tx({"181#01", "181#01"});
}

TEST_CASE("fixture: an NMT command sent by the node fails" * doctest::should_fail()) {
  Fixture node;
  CO_IF_FRM frm = frame("000#0100");
  node.call([&] { COIfCanSend(&node->If, &frm); });
  node.tx("000#0100");
}

TEST_CASE("fixture: a toggle bit in a heartbeat fails" * doctest::should_fail()) {
  Fixture node;
  CO_IF_FRM frm = frame("701#FF");
  node.call([&] { COIfCanSend(&node->If, &frm); });
  node.tx("701#FF");
}

TEST_CASE("fixture: locking objects twice fails" * doctest::should_fail()) {
  Fixture node;
  node.call([&] {
    node->Ext->OdLock(node->Ext->User);
    node->Ext->OdLock(node->Ext->User);
    node->Ext->OdUnlock(node->Ext->User);
  });
}

TEST_CASE("fixture: unlocking objects that are not locked fails" * doctest::should_fail()) {
  Fixture node;
  node.call([&] { node->Ext->OdUnlock(node->Ext->User); });
}

TEST_CASE("fixture: leaving objects locked fails" * doctest::should_fail()) {
  Fixture node;
  node.call([&] { node->Ext->OdLock(node->Ext->User); });
}

TEST_CASE("fixture: sending while objects are locked fails" * doctest::should_fail()) {
  Fixture node;
  CO_IF_FRM frm = frame("7FF#");
  node.call([&] {
    node->Ext->OdLock(node->Ext->User);
    COIfCanSend(&node->If, &frm);
    node->Ext->OdUnlock(node->Ext->User);
  });
  node.tx("7FF#");
}

TEST_CASE("fixture: a timer that is neither armed nor free fails" * doctest::should_fail()) {
  Fixture node;
  node.call([&] { ++node->Tmr.Used; });
}

TEST_CASE("fixture: a stack timer that is armed although unused fails" * doctest::should_fail()) {
  Fixture node(Setup().heartbeat(100));
  node.call([&] { node->Nmt.Mode = CO_INIT; });
}

TEST_CASE("fixture: an open transfer without a running time-out fails" * doctest::should_fail()) {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.call([&] {
    node->Tmr.First = nullptr;
    node->Tmr.Armed = node->Tmr.End = &node->Tmr.First;
    node->SdoTmr.Running = 0;
  });
  node.rx("601#8008100000000000");
}

}  // namespace
