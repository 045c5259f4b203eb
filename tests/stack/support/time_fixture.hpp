// SPDX-License-Identifier: Apache-2.0
/// \file time_fixture.hpp
/// A node with the TIME service: 1012h, writable, and the clock of the node.
#pragma once

#include "fixture.hpp"

#if USE_TIME

namespace test {

struct TimeId {
  std::uint32_t cob_id;
};

class TimeNode : public TimeId, public Fixture {
 public:
  explicit TimeNode(std::uint32_t id, Setup setup = Setup()) : TimeId{id}, Fixture(with_id(std::move(setup), cob_id)) {}

  CO_TIME_OF_DAY time() {
    CO_TIME_OF_DAY now{};
    call([&] { COTimeGet(&node, &now); });
    return now;
  }
  void set(std::uint32_t ms, std::uint16_t days) {
    const CO_TIME_OF_DAY now{ms, days};
    call([&] { CHECK(COTimeSet(&node, &now) == CO_ERR_NONE); });
  }
  CO_ERR send() {
    CO_ERR result = CO_ERR_NONE;
    call([&] { result = COTimeSend(&node); });
    return result;
  }
  CO_ERR produce(std::uint32_t ms) {
    CO_ERR result = CO_ERR_NONE;
    call([&] { result = COTimeProduce(&node, ms); });
    return result;
  }

 private:
  static Setup with_id(Setup setup, std::uint32_t& cob_id) {
    return setup.only_small().with({CO_KEY(0x1012, 0, CO_OBJ_____RW), CO_TTIME_ID, &cob_id});
  }
};

/// Checks the clock of the node: \a ms after midnight, \a days since 1984-01-01.
inline void check_time(TimeNode& node, std::uint32_t ms, std::uint16_t days,
                       Where at = {__builtin_FILE(), __builtin_LINE()}) {
  const CO_TIME_OF_DAY now = node.time();
  if (now.Ms != ms || now.Days != days) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "the clock tells " << now.Ms << " ms of day " << now.Days);
  }
}

inline constexpr std::uint32_t time_consumer = 0x80000100;
inline constexpr std::uint32_t time_producer = 0x40000100;

}  // namespace test

#endif
