// SPDX-License-Identifier: Apache-2.0
/// \file co_nvm_eeprom_spi.h
/// Memory driver for EEPROM 25xx (25LC, AT25, M95) and FRAM behind SPI (docs/drivers/eeprom_spi.md). C and C++, bare
/// metal or in a task of an RTOS. Tested on a model, not on silicon.
///
///     static const CO_EEPROM_SPI_BUS bus = {Select, Transfer, Wait};
///     static const CO_EEPROM_SPI eeprom = {                                          // 25LC256
///         .Bus = &bus, .Capacity = 32768, .PageSize = 64, .AddressBytes = 2, .WriteTime = 5};
///     ext.Nvm = &EepromSpiNvmDriver;  ext.NvmCtx = (void*)&eeprom;                   // CO_NODE_EXT
///
/// Writes are divided at the ends of pages. Before each, the driver sets the write enable latch and checks it; after
/// each, it reads the status until the write cycle has ended, for at most WriteTime and the duration of the transfers,
/// and reads the bytes back. It also waits before each access, because the CPU may have been reset during a write
/// cycle.
///
/// Device loss. SPI has no acknowledgement: all bytes of a missing device read FFh or 00h. Each access therefore ends
/// with a test: the status must show that the write enable latch follows the instructions that set and clear it.
/// Otherwise the access fails: Read and Write return 0.
///
/// Geometry. A loss of power in a write cycle can damage the whole page, so the slots of a record do not share pages:
/// use CO_EEPROM_SPACE() for the addresses of parameter groups.
///
/// Context: the thread that stores and loads, with or without the node lock (docs/porting.md). If other devices on the
/// bus are used in other threads or interrupts, Select must reserve the bus. Owner: the caller; the context and what it
/// refers to must outlive the node. They may be constant.
#ifndef CO_NVM_EEPROM_SPI_H_
#define CO_NVM_EEPROM_SPI_H_

#include "../co_eeprom_space.h"
#include "co_if_nvm.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Functions of the SPI bus: mode 0,0 or 1,1, most significant bit first.
typedef struct CO_EEPROM_SPI_BUS_T {
  /// Sets chip select low (\a selected true) or high. Waits until the last bit has been transferred before it sets
  /// chip select high, then keeps it high for the time that the data sheet requires (250 ns at most).
  void (*Select)(void* ctx, bool selected);
  /// Transfers \a num bytes in both directions and returns when they have been transferred. \a out: null to transmit
  /// any bytes; \a in: null to discard the received bytes.
  void (*Transfer)(void* ctx, const uint8_t* out, uint8_t* in, uint32_t num);
  /// Waits for at least \a microseconds; a task of an RTOS may sleep for a tick.
  void (*Wait)(void* ctx, uint32_t microseconds);
} CO_EEPROM_SPI_BUS;

/// A memory: the context of EepromSpiNvmDriver. With impossible values its capacity is 0, and the node stores nothing
/// (CO_ERR_PARA_STORE).
typedef struct CO_EEPROM_SPI_T {
  const CO_EEPROM_SPI_BUS* Bus;  ///< functions
  void* BusCtx;                  ///< first argument of the functions
  uint32_t Capacity;             ///< bytes
  uint32_t PageSize;             ///< bytes of a page, as in the data sheet; 0: no pages (FRAM)
  uint8_t AddressBytes;  ///< bytes of an address, 1…3. With 1, the instruction contains address bit 8 (25LC040)
  uint8_t WriteTime;     ///< longest write cycle, milliseconds, as in the data sheet; 0: FRAM
} CO_EEPROM_SPI;

/// The driver; its context is a CO_EEPROM_SPI.
extern const CO_IF_NVM_DRV_EX EepromSpiNvmDriver;

#ifdef __cplusplus
}
#endif

#endif
