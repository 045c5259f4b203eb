// SPDX-License-Identifier: Apache-2.0
// Results of co_od.h and their abort codes, copied from the table of the interface.
#include "support/od.hpp"

#if USE_OD

namespace {

using namespace test;

struct Row {
  ODR_t result;
  int number;
  std::uint32_t abort;
};

constexpr Row rows[] = {
    {ODR_OK, 0, 0x00000000},
    {ODR_OUT_OF_MEM, 1, 0x05040005},
    {ODR_UNSUPP_ACCESS, 2, 0x06010000},
    {ODR_WRITEONLY, 3, 0x06010001},
    {ODR_READONLY, 4, 0x06010002},
    {ODR_IDX_NOT_EXIST, 5, 0x06020000},
    {ODR_NO_MAP, 6, 0x06040041},
    {ODR_MAP_LEN, 7, 0x06040042},
    {ODR_PAR_INCOMPAT, 8, 0x06040043},
    {ODR_DEV_INCOMPAT, 9, 0x06040047},
    {ODR_HW, 10, 0x06060000},
    {ODR_TYPE_MISMATCH, 11, 0x06070010},
    {ODR_DATA_LONG, 12, 0x06070012},
    {ODR_DATA_SHORT, 13, 0x06070013},
    {ODR_SUB_NOT_EXIST, 14, 0x06090011},
    {ODR_INVALID_VALUE, 15, 0x06090030},
    {ODR_VALUE_HIGH, 16, 0x06090031},
    {ODR_VALUE_LOW, 17, 0x06090032},
    {ODR_MAX_LESS_MIN, 18, 0x06090036},
    {ODR_NO_RESOURCE, 19, 0x060A0023},
    {ODR_GENERAL, 20, 0x08000000},
    {ODR_DATA_TRANSF, 21, 0x08000020},
    {ODR_DATA_LOC_CTRL, 22, 0x08000021},
    {ODR_DATA_DEV_STATE, 23, 0x08000022},
    {ODR_OD_MISSING, 24, 0x08000023},
    {ODR_NO_DATA, 25, 0x08000024},
};

}  // namespace

TEST_CASE("OD_getSDOabCode: each result has its number and abort code") {
  int next = 0;
  for (const Row& row : rows) {
    CAPTURE(row.number);
    CHECK(row.number == next++);
    CHECK(static_cast<int>(row.result) == row.number);
    CHECK(OD_getSDOabCode(row.result) == row.abort);
  }
  CHECK(next == 26);
  CHECK(static_cast<int>(ODR_COUNT) == 26);
}

TEST_CASE("OD_getSDOabCode: ODR_PARTIAL and undefined numbers are 0604 0047h") {
  CHECK(static_cast<int>(ODR_PARTIAL) == -1);
  CHECK(OD_getSDOabCode(ODR_PARTIAL) == 0x06040047);
  for (const int number : {-32, -2, 26, 27, 31}) {
    CHECK(OD_getSDOabCode(static_cast<ODR_t>(number)) == 0x06040047);
  }
}

#endif
