// SPDX-License-Identifier: Apache-2.0
// "Example ODxyz.h file" of the page "Object Dictionary", unchanged except for white space and the include guard.
#ifndef COMPAT_ODXYZ_H_
#define COMPAT_ODXYZ_H_

/* OD data declaration of all groups ******************************************/
typedef struct {
  uint32_t x1000_deviceType;
  struct {
    uint8_t maxSubIndex;
    uint32_t vendorID;
    uint32_t productCode;
    uint32_t revisionNumber;
    uint32_t serialNumber;
  } x1018_identity;
} ODxyz_PERSIST_COMM_t;

typedef struct {
  uint8_t x1001_errorRegister;
  uint8_t x1003_preDefinedErrorField_sub0;
  uint32_t x1003_preDefinedErrorField[8];
} ODxyz_RAM_t;

extern ODxyz_PERSIST_COMM_t ODxyz_PERSIST_COMM;
extern ODxyz_RAM_t ODxyz_RAM;
extern OD_t* ODxyz;

/* Object dictionary entries - shortcuts **************************************/
#define ODxyz_ENTRY_H1000 &ODxyz->list[0]
#define ODxyz_ENTRY_H1001 &ODxyz->list[1]
#define ODxyz_ENTRY_H1003 &ODxyz->list[2]
#define ODxyz_ENTRY_H1018 &ODxyz->list[3]

#define ODxyz_ENTRY_H1000_deviceType &ODxyz->list[0]
#define ODxyz_ENTRY_H1001_errorRegister &ODxyz->list[1]
#define ODxyz_ENTRY_H1003_preDefinedErrorField &ODxyz->list[2]
#define ODxyz_ENTRY_H1018_identity &ODxyz->list[3]

#endif
