// SPDX-License-Identifier: Apache-2.0
/// \file co_can_spi.h
/// Types that the drivers for CAN controllers behind SPI have in common: MCP2515 and MCP251xFD.
#ifndef CO_CAN_SPI_H_
#define CO_CAN_SPI_H_

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Functions of the board that access a controller.
typedef struct CO_CAN_SPI_T {
  void (*Select)(void* ctx, bool selected);  ///< true: CS low; false: CS high, after the last bit was transferred
  /// Transfers bytes in both directions, the highest bit first, and returns when the last one was transferred. \a bytes
  /// are sent and replaced by those received; \a num: 1…18.
  void (*Transfer)(void* ctx, uint8_t* bytes, uint8_t num);
  bool (*HasInterrupt)(void* ctx);  ///< returns true while INT is low; null: the pin cannot be read
} CO_CAN_SPI;

/// An SPI bus with several controllers, or with other devices. Initialise it with zero.
typedef struct CO_CAN_SPI_BUS_T {
  /// \cond internal
  struct CO_CAN_SPI_USER_T* First;  // controllers that were initialised
  uint8_t Holds;                    // users of the bus: those that were interrupted, too
  uint8_t HasNotes;                 // a controller has IsMissed
  /// \endcond
} CO_CAN_SPI_BUS;

/// \cond internal
// The use of a bus by a controller, a member of its context.
typedef struct CO_CAN_SPI_USER_T {
  struct CO_CAN_SPI_USER_T* Next;  // on the same SPI bus
  void (*Service)(void* can);      // does the work of the interrupt
  void* Can;
  CO_CAN_SPI_BUS OwnBus;  // without Bus
  uint8_t IsMissed;       // the interrupt has occurred, its work is not done
} CO_CAN_SPI_USER;
/// \endcond

#ifdef __cplusplus
}
#endif

#endif
