// SPDX-License-Identifier: Apache-2.0
// expect to compile
// The number of instances of each service is that of its setting: the last one is accepted, the next one is refused.
#define CO_SSDO_N 2
#define CO_CSDO_N 3
#define CO_RPDO_N 4
#define CO_TPDO_N 5
#define CO_SRDO_N 6
#define CO_HBCONS_N 7
#define CO_EMCY_CONS_N 8
#include "lexican/dictionary.hpp"

std::uint64_t variable;

#define TYPED(type, index, sub) \
  { CO_KEY(index, sub, CO_OBJ_____RW), type, (CO_DATA)(&variable) }

constexpr CO_OBJ last[] = {
    TYPED(CO_THB_CONS, 0x1016, 7),        TYPED(CO_TEMCY_CONS, 0x1028, 8), TYPED(CO_TSDO_ID, 0x1201, 1),
    TYPED(CO_TSDO_ID, 0x1282, 1),         TYPED(CO_TUNSIGNED8, 0x1282, 3), TYPED(CO_TSRDO_COM, 0x1306, 1),
    TYPED(CO_TSRDO_MAP, 0x1386, 1),       TYPED(CO_TPDO_ID, 0x1403, 1),    TYPED(CO_TPDO_NUM, 0x1603, 0),
    TYPED(CO_TSRDO_SIGNATURE, 0x13FF, 6), TYPED(CO_TPDO_EVENT, 0x1804, 5), TYPED(CO_TPDO_MAP, 0x1A04, 1),
};
constexpr CO_OBJ next[] = {
    TYPED(CO_THB_CONS, 0x1016, 8),        TYPED(CO_TEMCY_CONS, 0x1028, 9),  TYPED(CO_TSDO_ID, 0x1202, 1),
    TYPED(CO_TSDO_ID, 0x1283, 1),         TYPED(CO_TUNSIGNED8, 0x1283, 3),  TYPED(CO_TUNSIGNED8, 0x12FF, 3),
    TYPED(CO_TSRDO_COM, 0x1307, 1),       TYPED(CO_TSRDO_MAP, 0x1387, 1),   TYPED(CO_TPDO_ID, 0x1404, 1),
    TYPED(CO_TSRDO_SIGNATURE, 0x13FF, 7), TYPED(CO_TPDO_NUM, 0x1604, 0),    TYPED(CO_TPDO_EVENT, 0x1805, 5),
    TYPED(CO_TPDO_MAP, 0x1A05, 1),        TYPED(CO_TUNSIGNED32, 0x1BFF, 1), TYPED(CO_TUNSIGNED32, 0x1283, 1),
};

/// Returns the number of entries in front of the first one without this fault.
template <const auto& Od>
constexpr std::size_t entries_with(CO_DICT_FAULT fault) {
  std::size_t i = 0;
  while (i < co::dictionary::length(Od) && co::dictionary::check<Od, true>(0, i) == fault) {
    ++i;
  }
  return i;
}

static_assert(entries_with<last>(CO_DICT_OK) == sizeof last / sizeof last[0]);
static_assert(entries_with<next>(CO_DICT_NOT_CONFIGURED) == sizeof next / sizeof next[0]);
