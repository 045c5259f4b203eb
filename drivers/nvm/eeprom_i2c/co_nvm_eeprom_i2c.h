// SPDX-License-Identifier: Apache-2.0
/// \file co_nvm_eeprom_i2c.h
/// Memory driver for EEPROM 24xx and FRAM behind I2C (docs/drivers/eeprom_i2c.md). C and C++, bare metal or in a task
/// of an RTOS. Tested on a model, not on silicon.
///
///     static const CO_EEPROM_I2C_BUS bus = {I2cWrite, I2cRead, Wait};
///     static const CO_EEPROM_I2C eeprom = {                                          // 24LC256
///         .Bus = &bus, .Capacity = 32768, .PageSize = 64, .Device = 0x50, .AddressBytes = 2, .WriteTime = 5};
///     ext.Nvm = &EepromI2cNvmDriver;  ext.NvmCtx = (void*)&eeprom;                   // CO_NODE_EXT
///
/// Writes are divided at the ends of pages. The driver waits for the end of each write cycle by acknowledge polling,
/// for at most WriteTime and the duration of the transfers. It also polls before each access, because the CPU may have
/// been reset during a write cycle.
///
/// Geometry. A loss of power in a write cycle can damage the whole page, so the slots of a record do not share pages:
/// use CO_EEPROM_SPACE() for the addresses of parameter groups.
///
/// If the device does not acknowledge, the driver reads or writes fewer bytes than requested, which is an error for the
/// node. It does not repeat transfers. A device that is lost while it is read returns FFh, so the driver addresses it
/// once more after each read.
///
/// Context: the thread that stores and loads, with or without the node lock (docs/porting.md). If other devices on the
/// bus are used in other threads, Write and Read must lock the bus. Owner: the caller; the context and what it refers
/// to must outlive the node. They may be constant.
#ifndef CO_NVM_EEPROM_I2C_H_
#define CO_NVM_EEPROM_I2C_H_

#include "../co_eeprom_space.h"
#include "co_if_nvm.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Functions of the I2C bus. Each returns within a limited time, also if a line of the bus is stuck.
typedef struct CO_EEPROM_I2C_BUS_T {
  /// Transmits a start condition, \a device with R/W = 0, \a headNum bytes of \a head, \a num bytes of \a bytes, and a
  /// stop condition. Without bytes it only tests whether the device acknowledges. \a device: 7 bits.
  /// \retval true   the device has acknowledged its address and each byte
  /// \retval false  it has not, or the bus has an error; the stop condition was transmitted nevertheless
  bool (*Write)(void* ctx, uint8_t device, const uint8_t* head, uint8_t headNum, const uint8_t* bytes, uint32_t num);
  /// Transmits a start condition, \a device with R/W = 0 and \a headNum bytes of \a head; then a repeated start
  /// condition and \a device with R/W = 1; receives \a num bytes, the last one without acknowledge; and transmits a
  /// stop condition.
  /// \retval true   \a to has the bytes
  /// \retval false  the device has not acknowledged, or the bus has an error
  bool (*Read)(void* ctx, uint8_t device, const uint8_t* head, uint8_t headNum, uint8_t* to, uint32_t num);
  /// Waits for at least \a microseconds; a task of an RTOS may sleep for a tick.
  void (*Wait)(void* ctx, uint32_t microseconds);
} CO_EEPROM_I2C_BUS;

/// A memory: the context of EepromI2cNvmDriver. With impossible values its capacity is 0, and the node stores nothing
/// (CO_ERR_PARA_STORE).
typedef struct CO_EEPROM_I2C_T {
  const CO_EEPROM_I2C_BUS* Bus;  ///< functions
  void* BusCtx;                  ///< first argument of the functions
  uint32_t Capacity;             ///< bytes
  uint32_t PageSize;             ///< bytes of a page, as in the data sheet; 0: no pages (FRAM)
  uint8_t Device;                ///< device address, 7 bits (50h…57h), its block bits 0
  uint8_t AddressBytes;          ///< bytes of an address in a transfer, 1…3
  uint8_t BlockShift;            ///< bit of Device that the first block bit is added to: 0; 24LC1025: 2
  uint8_t WriteTime;             ///< longest write cycle, milliseconds, as in the data sheet; 0: FRAM
} CO_EEPROM_I2C;

/// The driver; its context is a CO_EEPROM_I2C. Address bits beyond AddressBytes are the block bits of the device
/// address (24C04 to 24C16, 24C1024).
extern const CO_IF_NVM_DRV_EX EepromI2cNvmDriver;

#ifdef __cplusplus
}
#endif

#endif
