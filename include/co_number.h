// SPDX-License-Identifier: Apache-2.0
/// \file co_number.h
/// Types of the numbers in a dictionary: BOOLEAN, integers of 8 to 64 bits, REAL32 and REAL64. [CiA 301, 7.1.4]
#ifndef CO_NUMBER_H_
#define CO_NUMBER_H_

#include "co_obj.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name BOOLEAN, INTEGER8 and UNSIGNED8
/// [CiA 301, 7.1.4] Data: a variable of one byte, or the value itself (flag D).
/// \{

extern const CO_OBJ_TYPE COTInt8;     ///< functions of CO_TUNSIGNED8 and CO_TSIGNED8
extern const CO_OBJ_TYPE COTBoolean;  ///< accepts 0 and 1 only (else CO_ERR_OBJ_RANGE)

#define CO_TUNSIGNED8 ((const CO_OBJ_TYPE*)&COTInt8)   ///< UNSIGNED8; Data: a uint8_t
#define CO_TSIGNED8 ((const CO_OBJ_TYPE*)&COTInt8)     ///< INTEGER8; Data: an int8_t
#define CO_TBOOLEAN ((const CO_OBJ_TYPE*)&COTBoolean)  ///< BOOLEAN; Data: a uint8_t, 0 or 1
/// \}

/// \name INTEGER16 and UNSIGNED16
/// [CiA 301, 7.1.4] Data: a variable of two bytes, or the value itself (flag D).
/// \{

extern const CO_OBJ_TYPE COTInt16;  ///< functions of both types

#define CO_TUNSIGNED16 ((const CO_OBJ_TYPE*)&COTInt16)  ///< UNSIGNED16; Data: a uint16_t
#define CO_TSIGNED16 ((const CO_OBJ_TYPE*)&COTInt16)    ///< INTEGER16; Data: an int16_t
/// \}

/// \name INTEGER24, UNSIGNED24, INTEGER32 and UNSIGNED32
/// [CiA 301, 7.1.4] Data: a variable of four bytes, or the value itself (flag D).
/// \{

extern const CO_OBJ_TYPE COTInt32;       ///< functions of CO_TUNSIGNED32 and CO_TSIGNED32
extern const CO_OBJ_TYPE COTUnsigned24;  ///< 3 bytes on the bus, in a uint32_t
extern const CO_OBJ_TYPE COTSigned24;    ///< 3 bytes on the bus, in an int32_t

#define CO_TUNSIGNED32 ((const CO_OBJ_TYPE*)&COTInt32)       ///< UNSIGNED32; Data: a uint32_t
#define CO_TSIGNED32 ((const CO_OBJ_TYPE*)&COTInt32)         ///< INTEGER32; Data: an int32_t
#define CO_TUNSIGNED24 ((const CO_OBJ_TYPE*)&COTUnsigned24)  ///< UNSIGNED24; Data: a uint32_t
#define CO_TSIGNED24 ((const CO_OBJ_TYPE*)&COTSigned24)      ///< INTEGER24; Data: an int32_t
/// \}

/// \name INTEGER40…64 and UNSIGNED40…64
/// [CiA 301, 7.1.4] Data: a variable of eight bytes, or the value itself (flag D, on CPUs with 64-bit addresses).
/// \{

extern const CO_OBJ_TYPE COTInt64;       ///< functions of CO_TUNSIGNED64 and CO_TSIGNED64
extern const CO_OBJ_TYPE COTUnsigned40;  ///< 5 bytes on the bus, in a uint64_t
extern const CO_OBJ_TYPE COTUnsigned48;  ///< 6 bytes on the bus, in a uint64_t
extern const CO_OBJ_TYPE COTUnsigned56;  ///< 7 bytes on the bus, in a uint64_t
extern const CO_OBJ_TYPE COTSigned40;    ///< 5 bytes on the bus, in an int64_t
extern const CO_OBJ_TYPE COTSigned48;    ///< 6 bytes on the bus, in an int64_t
extern const CO_OBJ_TYPE COTSigned56;    ///< 7 bytes on the bus, in an int64_t

#define CO_TUNSIGNED64 ((const CO_OBJ_TYPE*)&COTInt64)       ///< UNSIGNED64; Data: a uint64_t
#define CO_TSIGNED64 ((const CO_OBJ_TYPE*)&COTInt64)         ///< INTEGER64; Data: an int64_t
#define CO_TUNSIGNED40 ((const CO_OBJ_TYPE*)&COTUnsigned40)  ///< UNSIGNED40; Data: a uint64_t
#define CO_TUNSIGNED48 ((const CO_OBJ_TYPE*)&COTUnsigned48)  ///< UNSIGNED48; Data: a uint64_t
#define CO_TUNSIGNED56 ((const CO_OBJ_TYPE*)&COTUnsigned56)  ///< UNSIGNED56; Data: a uint64_t
#define CO_TSIGNED40 ((const CO_OBJ_TYPE*)&COTSigned40)      ///< INTEGER40; Data: an int64_t
#define CO_TSIGNED48 ((const CO_OBJ_TYPE*)&COTSigned48)      ///< INTEGER48; Data: an int64_t
#define CO_TSIGNED56 ((const CO_OBJ_TYPE*)&COTSigned56)      ///< INTEGER56; Data: an int64_t
/// \}

/// \name REAL32 and REAL64
/// IEEE 754. [CiA 301, 7.1.4] Data: a float, a double.
/// \{

extern const CO_OBJ_TYPE COTReal32;  ///< functions of CO_TREAL32
extern const CO_OBJ_TYPE COTReal64;  ///< functions of CO_TREAL64

#define CO_TREAL32 ((const CO_OBJ_TYPE*)&COTReal32)  ///< REAL32; Data: a float
#define CO_TREAL64 ((const CO_OBJ_TYPE*)&COTReal64)  ///< REAL64; Data: a double
/// \}

/// Type and Data of an entry for a variable whose size the compiler checks: "size of array is negative" if it is not
/// that of the type. If the variable is too small, the stack writes to the memory behind it.
///
///     {CO_KEY(0x2100, 0, CO_OBJ____PRW), CO_VAR(UNSIGNED16, Speed)},
///
/// \a type: BOOLEAN, SIGNED8…64, UNSIGNED8…64, REAL32 or REAL64. \a variable:
/// a variable with static storage, or an element of an array or structure. Only the size is checked, not whether the
/// variable is an integer, a real number or a pointer.
#define CO_VAR(type, variable) \
  CO_T##type, (CO_DATA)(&(variable) + 0 * sizeof(char[sizeof(variable) == CO_BYTES_##type ? 1 : -1]))

/// \cond internal
#define CO_BYTES_BOOLEAN 1u
#define CO_BYTES_UNSIGNED8 1u
#define CO_BYTES_UNSIGNED16 2u
#define CO_BYTES_UNSIGNED24 4u
#define CO_BYTES_UNSIGNED32 4u
#define CO_BYTES_UNSIGNED40 8u
#define CO_BYTES_UNSIGNED48 8u
#define CO_BYTES_UNSIGNED56 8u
#define CO_BYTES_UNSIGNED64 8u
#define CO_BYTES_SIGNED8 1u
#define CO_BYTES_SIGNED16 2u
#define CO_BYTES_SIGNED24 4u
#define CO_BYTES_SIGNED32 4u
#define CO_BYTES_SIGNED40 8u
#define CO_BYTES_SIGNED48 8u
#define CO_BYTES_SIGNED56 8u
#define CO_BYTES_SIGNED64 8u
#define CO_BYTES_REAL32 4u
#define CO_BYTES_REAL64 8u
/// \endcond

#ifdef __cplusplus
}
#endif

#endif
