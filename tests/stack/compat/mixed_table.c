// SPDX-License-Identifier: Apache-2.0
// Tables in one language that mixed_use.c uses in the other one, see lto.sh.
#include "mixed.h"

uint32_t MixedLong = 0xCAFEF00D;
uint8_t MixedBytes[4] = {1, 2, 3, 4};

static uint32_t SumSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  (void)obj;
  (void)node;
  (void)width;
  return 1;
}

static CO_ERR SumRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const uint8_t* bytes = (const uint8_t*)obj->Data;
  (void)node;
  (void)size;
  *(uint8_t*)buffer = (uint8_t)(bytes[0] + bytes[1] + bytes[2] + bytes[3]);
  return CO_ERR_NONE;
}

static const CO_OBJ_TYPE SumType = {SumSize, 0, SumRead, 0, 0};

const CO_OBJ MixedTable[MIXED_ENTRIES] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x191)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&MixedLong)},
    {CO_KEY(0x2001, 0, CO_OBJ_____R_), &SumType, (CO_DATA)(&MixedBytes[0])},
    CO_OBJ_DICT_ENDMARK,
    CO_OBJ_DICT_ENDMARK,
};

CO_OBJ MixedDynamic[MIXED_DYNAMIC] = {
    {CO_KEY(0x3000, 0, CO_OBJ_D___RW), CO_TUNSIGNED32, (CO_DATA)(1)},
    {CO_KEY(0x3000, 1, CO_OBJ_D___RW), CO_TUNSIGNED32, (CO_DATA)(2)},
    CO_OBJ_DICT_ENDMARK,
};

const CO_PARA MixedGroup = {0, sizeof(MixedBytes), MixedBytes, 0, CO_RESET_NODE, (void*)&MixedLong, CO_PARA___E};

void MixedSet(CO_OBJ* obj, uint32_t value) {
  obj->Data = (CO_DATA)(value);
  obj->Key |= CO_OBJ_T1;
}

uint32_t MixedGet(const CO_OBJ* obj) { return (uint32_t)obj->Data; }
