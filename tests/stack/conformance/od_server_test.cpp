// SPDX-License-Identifier: Apache-2.0
// Effects of a write by co_od.h, which are complete when the function returns.
#include <algorithm>

#include "support/od.hpp"

#if USE_OD && CO_SSDO_N >= 2

namespace {

using namespace test;

TEST_CASE("OD_set: COB-IDs of an SDO server that the application writes take effect at once [301:7.5.2.33]") {
  Fixture node;
  node.may_change(0x1201, 1);
  node.may_change(0x1201, 2);
  node.call([&] {
    CHECK(OD_set_u32(OD_find(&node.od, 0x1201), 1, 0x6A1, false) == ODR_OK);
    CHECK(OD_set_u32(OD_find(&node.od, 0x1201), 2, 0x6A2, false) == ODR_OK);
  });
  const auto& heard = node.can.filter;
  CHECK(std::find(heard.begin(), heard.end(), 0x6A1U) != heard.end());
  node.ask("6A1#4000100000000000", "6A2#4300100091010F00");
}

}  // namespace

#endif
