// SPDX-License-Identifier: Apache-2.0
// The parameter groups of the page "Using Object Dictionary", unchanged except for white space and the position of the
// type name CO_PARA. The program is only compiled: it has no memory to store the groups in.
#include <string.h>

#include "co_core.h"

extern CO_NODE demo;
void StoreDemoParameters(void);
void FirmwareUsesTheGroup(CO_PARA* pg);

struct DEMO_PARA_T {
  uint32_t ParaLong; /* storable 32bit parameter value */
  uint16_t ParaWord; /* storable 16bit parameter value */
  uint8_t ParaByte;  /* storable 8bit parameter value */
} DemoParaMem;

struct DEMO_PARA_T DemoParaDef = {1, 2, 3}; /* omitted by the page */

const CO_PARA DemoParaObj = {
    0L,                         /* start address in non-volatile memory */
    sizeof(struct DEMO_PARA_T), /* size of parameter memory */
    &DemoParaMem,               /* start address of parameter memory */
    &DemoParaDef,               /* start address of default parameters */
    CO_RESET_NODE,              /* reset type for reload parameter */
    (void*)"DemoParaId",        /* user parameter identification */
    CO_PARA___E                 /* enable parameter storage on cmd */
};

const CO_OBJ DemoOD[] = {
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&DemoParaObj)},
    {CO_KEY(0x2345, 0x56, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&(DemoParaMem.ParaLong))},
    {CO_KEY(0x2345, 0x57, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&(DemoParaMem.ParaWord))},
    {CO_KEY(0x2345, 0x58, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&(DemoParaMem.ParaByte))},
};

void StoreDemoParameters(void) { COParaStore(&DemoParaObj, &demo); /* store parameter group */ }

/* Uses of the members by firmware; not part of the page. */
static uint8_t Bytes[8];
static CO_PARA ByteGroup = {0, sizeof(Bytes), Bytes, 0, CO_RESET_COM, (void*)"bytes", CO_PARA__AE};
static CO_PARA CastGroup = {0,    sizeof(DemoParaMem), (uint8_t*)&DemoParaMem, (uint8_t*)&DemoParaDef, CO_RESET_NODE,
                            NULL, CO_PARA____};

void FirmwareUsesTheGroup(CO_PARA* pg) {
  uint8_t* start = pg->Start;
  uint8_t i = 1;
  if (pg->Default == 0) {
    pg->Start = Bytes;
    memset(pg->Start, 0, pg->Size);
    return;
  }
  if (pg->Start == (uint8_t*)&DemoParaMem || pg->Start == Bytes || !pg->Start) {
    ((struct DEMO_PARA_T*)(void*)pg->Start)->ParaByte = 5;
  }
  memcpy(pg->Start, pg->Default, pg->Size);
  pg->Start[i] = pg->Default[0];
  *(pg->Start + 2) = start[i];
  *pg = pg == &ByteGroup ? CastGroup : ByteGroup;
}
