// SPDX-License-Identifier: Apache-2.0
// expect to compile
// Each row of CO_OBJECTS() is accepted at its first and last place, and refused beside them, with a flag or a length
// that it does not have, and without data. CO_OD_CHECK() reports each of these faults like those of the other sources.
#define CO_CFG_PRESET "presets/full.h"
#define CO_SSDO_N 128
#define CO_CSDO_N 100
#define CO_RPDO_N 512
#define CO_TPDO_N 512
#define CO_SRDO_N 64
#define CO_HBCONS_N 127
#define CO_EMCY_CONS_N 127
#include "lexican/dictionary.hpp"

std::uint64_t variable;

/// Returns whether a row for a type contains a place.
constexpr bool is_listed(const CO_OBJ_TYPE* type, std::uint32_t key) {
  const unsigned index = co::rules::index_of(key);
  const unsigned sub = co::rules::sub_of(key);
#define LISTED(rule, macro, functions, first, last, first_sub, last_sub, bytes, flags, ...)        \
  if (type == &functions && first_sub + 0u <= sub && sub <= last_sub &&                            \
      ((first <= index && index <= last) ||                                                        \
       (co::rules::has_letter(#flags, 'T') && first + 0x400 <= index && index <= last + 0x400))) { \
    return true;                                                                                   \
  }
  CO_OBJECTS(LISTED)
  return false;
}

/// Returns the fault of an entry.
template <const auto& Od>
constexpr CO_DICT_FAULT fault(std::size_t position) {
  return co::dictionary::check<Od, true>(0, position);
}

/// Returns whether the check accepts exactly the listed places of the first \a number entries.
template <const auto& Od>
constexpr bool has_right_places(const CO_OBJ_TYPE* type, std::size_t number) {
  for (std::size_t i = 0; i < number; ++i) {
    const CO_DICT_FAULT of_entry = fault<Od>(i);
    const CO_DICT_FAULT expected = is_listed(type, Od[i].Key) ? CO_DICT_OK : CO_DICT_WRONG_PLACE;
    if (of_entry != (co::rules::is_configured(Od[i].Key) ? expected : CO_DICT_NOT_CONFIGURED)) {
      return false;
    }
  }
  return true;
}

#define PLACE(type, index, sub, flags, data) \
  { CO_KEY(index, (sub)&0xFF, flags), type, (CO_DATA)(data) }
#define PLAIN(bytes) \
  (bytes == 1 ? CO_TUNSIGNED8 : bytes == 2 ? CO_TUNSIGNED16 : bytes == 4 ? CO_TUNSIGNED32 : CO_TUNSIGNED64)
#define ROW(rule, type, functions, first, last, first_sub, last_sub, bytes, flags, ...)                      \
  namespace of_##rule {                                                                                      \
    constexpr CO_OBJ od[] = {                                                                                \
        PLACE(type, first, first_sub, CO_OBJ_____RW, &variable),                                             \
        PLACE(type, last, last_sub, CO_OBJ_____RW, &variable),                                               \
        PLACE(type, first - 1, first_sub, CO_OBJ_____RW, &variable),                                         \
        PLACE(type, last + 1, first_sub, CO_OBJ_____RW, &variable),                                          \
        PLACE(type, first, first_sub - 1, CO_OBJ_____RW, &variable),                                         \
        PLACE(type, last, last_sub + 1, CO_OBJ_____RW, &variable),                                           \
        PLACE(type, first - 0x400, first_sub, CO_OBJ_____RW, &variable),                                     \
        PLACE(type, first + 0x3FF, first_sub, CO_OBJ_____RW, &variable),                                     \
        PLACE(type, first + 0x400, first_sub, CO_OBJ_____RW, &variable),                                     \
        PLACE(type, last + 0x401, first_sub, CO_OBJ_____RW, &variable),                                      \
        PLACE(type, first, first_sub, CO_OBJ_D___R_, 1),                                                     \
        PLACE(type, first, first_sub, CO_OBJ__N__RW, &variable),                                             \
        PLACE(type, first, first_sub, CO_OBJ_____RW, 0),                                                     \
        PLACE(PLAIN(bytes), first, last_sub, CO_OBJ_____RW, &variable),                                      \
        PLACE(PLAIN(bytes * 2 % 15), first, last_sub, CO_OBJ_____RW, &variable),                             \
    };                                                                                                       \
    constexpr bool may_be_direct = co::rules::has_letter(#flags, 'D') && bytes <= sizeof(void*);             \
    constexpr bool has_length = bytes != 0 && first < 0x2000;                                                \
    static_assert(is_listed(&functions, od[0].Key) && is_listed(&functions, od[1].Key), #rule ": the list"); \
    static_assert(has_right_places<od>(&functions, 10), #rule ": a wrong place");                            \
    static_assert(fault<od>(10) == (may_be_direct ? CO_DICT_OK : CO_DICT_DIRECT_TYPE), #rule ": flag D");    \
    static_assert(fault<od>(11) == (co::rules::has_letter(#flags, 'N') ? CO_DICT_OK : CO_DICT_NODEID_TYPE),  \
                  #rule ": flag N");                                                                         \
    static_assert(fault<od>(12) == CO_DICT_NO_DATA, #rule ": no data");                                      \
    static_assert(fault<od>(13) == CO_DICT_OK, #rule ": a plain type");                                      \
    static_assert(fault<od>(14) == (has_length ? CO_DICT_WRONG_PLACE : CO_DICT_OK),                          \
                  #rule ": a plain type of a wrong length");                                                 \
  }
CO_OBJECTS(ROW)

// Places and flags that a wrong row could contain.
constexpr std::uint32_t flags_for_WRONG_PLACE = CO_OBJ_____RW;
constexpr std::uint32_t flags_for_NODEID_TYPE = CO_OBJ__N__RW;
constexpr std::uint32_t flags_for_DIRECT_TYPE = CO_OBJ_D___R_;
#define REFUSED(with, type, index, sub)                                                                        \
  constexpr CO_OBJ with##_##type##_##index##_##sub[] = {PLACE(type, index, sub, flags_for_##with, &variable)}; \
  static_assert(fault<with##_##type##_##index##_##sub>(0) == CO_DICT_##with, #type " at " #index ", sub " #sub);
REFUSED(WRONG_PLACE, CO_TEMCY_HIST, 0x1003, 255)  // 1003h has 254 entries
REFUSED(WRONG_PLACE, CO_TEMCY_HIST, 0x1004, 1)
REFUSED(WRONG_PLACE, CO_TEMCY_ID, 0x1015, 0)
REFUSED(WRONG_PLACE, CO_THB_CONS, 0x1017, 0)  // the producer
REFUSED(WRONG_PLACE, CO_THB_PROD, 0x1017, 1)
REFUSED(WRONG_PLACE, CO_TOS_COMMAND, 0x1023, 2)  // the status
REFUSED(WRONG_PLACE, CO_TOS_MODE, 0x1025, 0)     // the debugger interface has no mode
REFUSED(WRONG_PLACE, CO_TOS_STDOUT, 0x1026, 1)   // StdIn
REFUSED(WRONG_PLACE, CO_TMODULE_LIST, 0x1050, 0)
REFUSED(WRONG_PLACE, CO_TEMCY_CONS, 0x1028, 0)  // the number of consumers
REFUSED(WRONG_PLACE, CO_TSDO_ID, 0x1200, 3)     // a node-ID
REFUSED(WRONG_PLACE, CO_TSDO_ID, 0x1280, 0)
REFUSED(WRONG_PLACE, CO_TSDO_ID, 0x1280, 3)
REFUSED(WRONG_PLACE, CO_TGFC, 0x1350, 0)
REFUSED(WRONG_PLACE, CO_TSRDO_COM, 0x1301, 0)      // the highest sub-index
REFUSED(WRONG_PLACE, CO_TSRDO_MAP, 0x1381, 17)     // an SRDO maps 16 objects
REFUSED(WRONG_PLACE, CO_TSRDO_VALID, 0x13FF, 1)    // a signature
REFUSED(WRONG_PLACE, CO_TPDO_ID, 0x1400, 2)        // the transmission type
REFUSED(WRONG_PLACE, CO_TPDO_ID, 0x1600, 1)        // a mapped object
REFUSED(WRONG_PLACE, CO_TPDO_ID, 0x1C00, 1)        // behind the PDOs
REFUSED(WRONG_PLACE, CO_TPDO_TYPE, 0x1800, 3)      // the inhibit time
REFUSED(WRONG_PLACE, CO_TPDO_INHIBIT, 0x1801, 5)   // the event timer
REFUSED(WRONG_PLACE, CO_TPDO_EVENT, 0x1403, 4)     // reserved
REFUSED(WRONG_PLACE, CO_TPDO_START, 0x1400, 6)     // RPDOs have no SYNC start value
REFUSED(WRONG_PLACE, CO_TPDO_NUM, 0x1600, 1)       // a mapped object
REFUSED(WRONG_PLACE, CO_TPDO_MAP, 0x1A00, 0)       // the number of mapped objects
REFUSED(WRONG_PLACE, CO_TPDO_MAP, 0x1600, 65)      // a PDO maps 64 objects
REFUSED(WRONG_PLACE, CO_TPDO_SCAN, 0x1FD0, 1)      // the object dispatching list
REFUSED(WRONG_PLACE, CO_TPDO_DISPATCH, 0x1FD0, 0)  // the number of its entries
REFUSED(WRONG_PLACE, CO_TREC_CONFIG, 0x2301, 3)    // the name, a string
REFUSED(WRONG_PLACE, CO_TREC_DATA, 0x2401, 5)      // the plot
REFUSED(WRONG_PLACE, CO_TREC_PLOT, 0x6000, 5)      // behind the manufacturer-specific area
REFUSED(NODEID_TYPE, CO_TEMCY_HIST, 0x1003, 1)
REFUSED(NODEID_TYPE, CO_THB_PROD, 0x1017, 0)
REFUSED(NODEID_TYPE, CO_TMODULE_LIST, 0x1027, 1)
REFUSED(NODEID_TYPE, CO_TPDO_TYPE, 0x1400, 2)
REFUSED(DIRECT_TYPE, CO_TEMCY_HIST, 0x1003, 1)  // the stack writes it
REFUSED(DIRECT_TYPE, CO_THB_CONS, 0x1016, 1)    // a CO_HBCONS
