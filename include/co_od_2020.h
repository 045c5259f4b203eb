// SPDX-License-Identifier: Apache-2.0
/// \file co_od_2020.h
/// The names of the draft of 2020 of the interface of co_od.h, for files that were written for it: inline functions
/// that call co_od.h. A file includes either this header or co_od.h. Remaining differences: the dictionary is an OD_t
/// of co_od.h; flags are read by OD_getFlagsPDO() and cleared by OD_clearFlagsPDO().
#ifndef CO_OD_2020_H_
#define CO_OD_2020_H_

#include "co_od.h"

#ifdef __cplusplus
extern "C" {
#endif

struct OD_IO2020_T;

/// A position in a variable, with its read and write functions.
typedef struct OD_stream2020_T {
  OD_IO_t Now;  ///< the variable, with the functions of co_od.h
} OD_stream2020_t;

/// Function that reads: returns the number of bytes transferred, and the result in \a returnCode.
typedef OD_size_t (*OD_read2020_t)(OD_stream2020_t* stream, uint8_t subIndex, void* buf, OD_size_t count,
                                   ODR_t* returnCode);
/// Function that writes, like OD_read2020_t.
typedef OD_size_t (*OD_write2020_t)(OD_stream2020_t* stream, uint8_t subIndex, const void* buf, OD_size_t count,
                                    ODR_t* returnCode);

/// A variable with its access functions.
typedef struct OD_IO2020_T {
  OD_stream2020_t stream;  ///< first argument of read and write
  OD_read2020_t read;      ///< OD_read2020()
  OD_write2020_t write;    ///< OD_write2020()
} OD_IO2020_t;

/// Properties of a variable that OD_getSub() returns.
typedef struct OD_subEntry_T {
  uint16_t index;        ///< index of the object
  uint8_t subIndex;      ///< sub-index of the variable
  uint8_t maxSubIndex;   ///< highest sub-index of the object, if there are no gaps
  uint8_t storageGroup;  ///< sub-index of 1010h, 0: not stored
  OD_attr_t attribute;   ///< ODA_…
  OD_read2020_t read;    ///< OD_read2020()
  OD_write2020_t write;  ///< OD_write2020()
} OD_subEntry_t;

/// Reads the next bytes; ODR_SUB_NOT_EXIST if \a subIndex is not that of \a stream.
static inline OD_size_t OD_read2020(OD_stream2020_t* stream, uint8_t subIndex, void* buf, OD_size_t count,
                                    ODR_t* returnCode) {
  OD_size_t passed = 0;
  const ODR_t result = stream->Now.stream.subIndex != subIndex
                           ? ODR_SUB_NOT_EXIST
                           : stream->Now.read(&stream->Now.stream, buf, count, &passed);
  *returnCode = result;
  return result == ODR_OK || result == ODR_PARTIAL ? passed : 0;
}

/// Writes the next bytes; ODR_SUB_NOT_EXIST if \a subIndex is not that of \a stream.
static inline OD_size_t OD_write2020(OD_stream2020_t* stream, uint8_t subIndex, const void* buf, OD_size_t count,
                                     ODR_t* returnCode) {
  OD_size_t passed = 0;
  const ODR_t result = stream->Now.stream.subIndex != subIndex
                           ? ODR_SUB_NOT_EXIST
                           : stream->Now.write(&stream->Now.stream, buf, count, &passed);
  *returnCode = result;
  return result == ODR_OK || result == ODR_PARTIAL ? passed : 0;
}

#if USE_OD
/// Fills \a subEntry and \a stream for access to a variable, like OD_getSub().
/// \retval ODR_OK             both are filled
/// \retval ODR_IDX_NOT_EXIST  \a entry is null or empty
/// \retval ODR_SUB_NOT_EXIST  there is no such sub-index
/// \retval ODR_DEV_INCOMPAT   \a subEntry or \a stream is null
static inline ODR_t OD_getSub2020(const OD_entry_t* entry, uint8_t subIndex, OD_subEntry_t* subEntry,
                                  OD_stream2020_t* stream, bool_t odOrig) {
  const OD_subEntry_t none = {0, 0, 0, 0, 0, OD_read2020, OD_write2020};
  ODR_t result = ODR_DEV_INCOMPAT;
  if (subEntry != 0) {
    *subEntry = none;
  }
  if (subEntry != 0 && stream != 0) {
    result = OD_getSub(entry, subIndex, &stream->Now, odOrig);
  } else if (entry == 0) {
    result = ODR_IDX_NOT_EXIST;
  }
  if (result == ODR_OK) {
    subEntry->index = entry->index;
    subEntry->subIndex = subIndex;
    subEntry->maxSubIndex = (uint8_t)(entry->subEntriesCount - 1u);
#if USE_PARA
    subEntry->storageGroup = OD_getStorageGroup(entry, subIndex);
#endif
    subEntry->attribute = stream->Now.stream.attribute;
  }
  return result;
}

/// Finds an object. In the draft the dictionary was constant.
static inline const OD_entry_t* OD_find2020(const OD_t* od, uint16_t index) { return OD_find((OD_t*)od, index); }

/// \name Typed addresses: on error null, with the reason as result
/// \{

/// Defines OD_getPtr_i8() and so on: stores the address in \a val and returns the result of OD_getPtr().
#define OD_GET_PTR(name, type)                                                                  \
  static inline ODR_t OD_getPtr_##name(const OD_entry_t* entry, uint8_t subIndex, type** val) { \
    ODR_t result = ODR_DEV_INCOMPAT;                                                            \
    if (val != 0) {                                                                             \
      *val = (type*)OD_getPtr(entry, subIndex, (OD_size_t)sizeof(type), &result);               \
    }                                                                                           \
    return result;                                                                              \
  }
OD_GET_PTR(i8, int8_t)
OD_GET_PTR(i16, int16_t)
OD_GET_PTR(i32, int32_t)
OD_GET_PTR(i64, int64_t)
OD_GET_PTR(u8, uint8_t)
OD_GET_PTR(u16, uint16_t)
OD_GET_PTR(u32, uint32_t)
OD_GET_PTR(u64, uint64_t)
OD_GET_PTR(r32, float32_t)
OD_GET_PTR(r64, float64_t)
#undef OD_GET_PTR
/// \}
#endif

#ifdef __cplusplus
}
#endif

#define OD_stream_t OD_stream2020_t  ///< name in the draft
#define OD_IO_t OD_IO2020_t          ///< name in the draft
#if USE_OD
#define OD_find OD_find2020      ///< name in the draft
#define OD_getSub OD_getSub2020  ///< name in the draft
#endif

#endif
