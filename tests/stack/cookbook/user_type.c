// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: types of the application.
#include <string.h>

#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint32_t SetpointSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  return CO_TSIGNED16->Size(obj, node, width);
}

static CO_ERR SetpointRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return CO_TSIGNED16->Read(obj, node, buffer, size);
}

// Checks a number, which is in the byte order of the CPU.
static CO_ERR SetpointWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  int16_t value;
  if (size != sizeof(value)) {
    return CO_ERR_BAD_ARG;
  }
  memcpy(&value, buffer, sizeof(value));
  if (value > 1000) {
    COObjTypeUserSDOAbort(obj, node, CO_SDO_ERR_RANGE_HIGH);
    return CO_ERR_OBJ_RANGE;
  }
  return CO_TSIGNED16->Write(obj, node, buffer, size);
}

static const CO_OBJ_TYPE SetpointType = {SetpointSize, NULL, SetpointRead, SetpointWrite, NULL};

// A value that is computed when it is read. It has no Write, so it cannot be written.
static uint32_t PowerSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  (void)obj;
  (void)node;
  (void)width;
  return sizeof(uint32_t);
}

static CO_ERR PowerRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const uint32_t power = 230u * 4u;  // measured by your hardware
  (void)obj;
  (void)node;
  if (size != sizeof(power)) {
    return CO_ERR_BAD_ARG;
  }
  memcpy(buffer, &power, size);
  return CO_ERR_NONE;
}

static const CO_OBJ_TYPE PowerType = {PowerSize, NULL, PowerRead, NULL, NULL};

static int16_t Setpoint;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2200, 0, CO_OBJ____PRW), &SetpointType, (CO_DATA)(&Setpoint)},
    {CO_KEY(0x2400, 0, CO_OBJ____PR_), &PowerType, 0},
};

void a_user_type_refuses_a_value(void) {
  Setpoint = 7;
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 60 00 22 00 00 00 00 00", BenchSend("605: 2B 00 22 00 E8 03 00 00"));
  TEST_ASSERT_EQUAL_INT16(1000, Setpoint);
  // 0609 0031h: value too high
  TEST_ASSERT_EQUAL_STRING("585: 80 00 22 00 31 00 09 06", BenchSend("605: 2B 00 22 00 E9 03 00 00"));
  TEST_ASSERT_EQUAL_INT16(1000, Setpoint);
  TEST_ASSERT_EQUAL_STRING("585: 4B 00 22 00 E8 03 00 00", BenchSend("605: 40 00 22 00 00 00 00 00"));
}

void a_user_type_computes_its_value(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 43 00 24 00 98 03 00 00", BenchSend("605: 40 00 24 00 00 00 00 00"));
}
