// SPDX-License-Identifier: Apache-2.0
/// \file memory_parts.hpp
/// Ranges of addresses, for the drivers of non-volatile memory that transfer pages. Not for applications.
#ifndef CO_DRIVERS_MEMORY_PARTS_HPP_
#define CO_DRIVERS_MEMORY_PARTS_HPP_

#include <stdint.h>

#include "co_if_nvm.h"

/// Internals of the drivers of non-volatile memory.
namespace co::nvm {

/// Returns the number of bytes of an access that are within a memory of \a capacity bytes.
constexpr uint32_t bytes_inside(uint32_t capacity, uint32_t start, uint32_t size) {
  const uint32_t left = start < capacity ? capacity - start : 0;
  return size < left ? size : left;
}

/// Returns whether a range of whole units is within a memory of \a capacity bytes.
constexpr bool has_units(uint32_t capacity, uint32_t start, uint32_t size, uint32_t unit) {
  return bytes_inside(capacity, start, size) == size && start % unit == 0 && size % unit == 0;
}

/// Calls \a transfer(address, offset, bytes) for each part of a range, until it returns false. No part crosses a
/// multiple of \a boundary, which is not 0. Returns the number of bytes of the calls that returned true.
template <class Function>
uint32_t for_parts(uint32_t start, uint32_t size, uint32_t boundary, Function transfer) {
  uint32_t done = 0;
  while (done < size) {
    const uint32_t address = start + done;
    const uint32_t left = size - done;
    const uint32_t in_part = boundary - address % boundary;
    const uint32_t bytes = in_part < left ? in_part : left;
    if (!transfer(address, done, bytes)) {
      break;
    }
    done += bytes;
  }
  return done;
}

/// Geometry of an EEPROM or FRAM. A loss of power in a write cycle can damage the whole page, so that the slots of a
/// record must not share a page: a page that is larger than a unit of programming is erased first, like that of a flash
/// memory. \a page: bytes, 0: FRAM; \a program: bytes of a unit of programming, CO_EEPROM_PROGRAM(page).
constexpr CO_NVM_SHAPE shape_of_pages(uint32_t capacity, uint32_t page, uint32_t program) {
  const uint32_t whole = page == 0 ? capacity : capacity - capacity % page;
  return {whole, program, program < page ? page : 0};
}

}  // namespace co::nvm

#endif
