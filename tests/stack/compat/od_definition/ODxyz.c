// SPDX-License-Identifier: Apache-2.0
// "Example ODxyz.c file" of the page "Object Dictionary", unchanged except for white space.
// clang-format off
#define OD_DEFINITION
#include "301/CO_ODinterface.h"
#include "ODxyz.h"
// clang-format on

/* OD data initialization of all groups ***************************************/
ODxyz_PERSIST_COMM_t ODxyz_PERSIST_COMM = {
    .x1000_deviceType = 0,
    .x1018_identity = {.maxSubIndex = 4, .vendorID = 0, .productCode = 0, .revisionNumber = 0, .serialNumber = 0}};

ODxyz_RAM_t ODxyz_RAM = {.x1001_errorRegister = 0,
                         .x1003_preDefinedErrorField_sub0 = 0,
                         .x1003_preDefinedErrorField = {0, 0, 0, 0, 0, 0, 0, 0}};

/* All OD objects (constant) **************************************************/
typedef struct {
  OD_obj_var_t o_1000_deviceType;
  OD_obj_var_t o_1001_errorRegister;
  OD_obj_array_t o_1003_preDefinedErrorField;
  OD_obj_record_t o_1018_identity[5];
} ODxyzObjs_t;

static CO_PROGMEM ODxyzObjs_t ODxyzObjs = {
    .o_1000_deviceType = {.dataOrig = &ODxyz_PERSIST_COMM.x1000_deviceType,
                          .attribute = ODA_SDO_R | ODA_MB,
                          .dataLength = 4},
    .o_1001_errorRegister = {.dataOrig = &ODxyz_RAM.x1001_errorRegister, .attribute = ODA_SDO_R, .dataLength = 1},
    .o_1003_preDefinedErrorField = {.dataOrig0 = &ODxyz_RAM.x1003_preDefinedErrorField_sub0,
                                    .dataOrig = &ODxyz_RAM.x1003_preDefinedErrorField[0],
                                    .attribute0 = ODA_SDO_RW,
                                    .attribute = ODA_SDO_R | ODA_MB,
                                    .dataElementLength = 4,
                                    .dataElementSizeof = sizeof(uint32_t)},
    .o_1018_identity = {{.data = &ODxyz_PERSIST_COMM.x1018_identity.maxSubIndex,
                         .subIndex = 0,
                         .attribute = ODA_SDO_R,
                         .dataLength = 1},
                        {.data = &ODxyz_PERSIST_COMM.x1018_identity.vendorID,
                         .subIndex = 1,
                         .attribute = ODA_SDO_R | ODA_MB,
                         .dataLength = 4},
                        {.data = &ODxyz_PERSIST_COMM.x1018_identity.productCode,
                         .subIndex = 2,
                         .attribute = ODA_SDO_R | ODA_MB,
                         .dataLength = 4},
                        {.data = &ODxyz_PERSIST_COMM.x1018_identity.revisionNumber,
                         .subIndex = 3,
                         .attribute = ODA_SDO_R | ODA_MB,
                         .dataLength = 4},
                        {.data = &ODxyz_PERSIST_COMM.x1018_identity.serialNumber,
                         .subIndex = 4,
                         .attribute = ODA_SDO_R | ODA_MB,
                         .dataLength = 4}}};

/* Object dictionary **********************************************************/
static OD_entry_t ODxyzList[] = {{0x1000, 0x01, ODT_VAR, &ODxyzObjs.o_1000_deviceType, NULL},
                                 {0x1001, 0x01, ODT_VAR, &ODxyzObjs.o_1001_errorRegister, NULL},
                                 {0x1003, 0x09, ODT_VAR, &ODxyzObjs.o_1003_preDefinedErrorField, NULL},
                                 {0x1018, 0x05, ODT_REC, &ODxyzObjs.o_1018_identity, NULL},
                                 {0x0000, 0x00, 0, NULL, NULL}};

OD_t _ODxyz = {(sizeof(ODxyzList) / sizeof(ODxyzList[0])) - 1, &ODxyzList[0]};

OD_t* ODxyz = &_ODxyz;
