// SPDX-License-Identifier: Apache-2.0
/// \file real_time_fixture.hpp
/// The node of sync_fixture.hpp with a real-time thread and a mainline, which the test calls alternately.
///
///     RealTimeNode node(table);
///     node.start();                     // Operational
///     node.arrive("201#2A");            // puts a frame into the controller
///     node.real_time();                 // CONodeRealTime()
///     node.mainline();                  // CONodeProcess() for each frame in the ring and once more, COTmrProcess()
#pragma once

#include "sync_fixture.hpp"

#if USE_REAL_TIME

namespace test {

/// Setup with a ring of 8 frames between real-time thread and mainline.
struct MainlineRing {
  MainlineRing() { REQUIRE(CORingInit(&ring, memory, 8)); }
  CO_IF_FRM memory[8];
  CO_RING ring;
};

class RealTimeNode : public MainlineRing, public SyncNode {
 public:
  explicit RealTimeNode(const SyncTable& table = {}, const std::function<void(Setup&)>& change = {})
      : SyncNode(table, [&](Setup& setup) {
          setup.turns().mainline(ring);
          if (change) {
            change(setup);
          }
        }) {}

  void arrive(std::string_view text) { can.to_node.push_back(frame(text)); }
  void real_time(Where at = {__builtin_FILE(), __builtin_LINE()}) {
    call([this] { CONodeRealTime(&node); }, at);
  }
  void mainline(Where at = {__builtin_FILE(), __builtin_LINE()}) {
    call(
        [this] {
          for (unsigned calls = CORingCount(&ring) + 1U; calls != 0; --calls) {
            CONodeProcess(&node);
          }
          COTmrProcess(&node.Tmr);
        },
        at);
  }
  void start(Where at = {__builtin_FILE(), __builtin_LINE()}) {
    arrive("000#0101");
    real_time(at);
    mainline(at);
    CHECK(mode() == CO_OPERATIONAL);
  }
  /// Lets time pass with timer interrupts, but without running any thread.
  void pass(Time time, Where at = {__builtin_FILE(), __builtin_LINE()}) { elapse_only(time, 1, at); }
};

}  // namespace test

#endif
