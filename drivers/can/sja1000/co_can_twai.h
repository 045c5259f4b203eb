// SPDX-License-Identifier: Apache-2.0
/// \file co_can_twai.h
/// Driver for TWAI, the CAN controller of ESP32, ESP32-C3, S2, S3, C6 and H2, without ESP-IDF
/// (docs/drivers/sja1000.md). It resembles SJA1000: co_can_sja1000.h describes receiving, filters, sending, bus-off and
/// contexts, which are the same. C and C++. Tested on a register model, not on silicon.
///
///     static const CO_CAN_SJA1000_RATE rates[] = {CO_CAN_TWAI_RATE_OF(80000000, 500000, 16)};
///     static CO_IF_FRM frames[32];
///     static CO_CAN_TWAI can = {.Registers = CO_CAN_TWAI_ESP32C3, .Rates = rates, .RateNum = 1, .Frames = frames,
///                               .FrameNum = 32};
///     ext.Can = &TwaiCanDriver;  ext.CanCtx = &can;                     // CO_NODE_EXT
///     void TwaiHandler(void) { COCanTwaiInterrupt(&can); }
///
/// The board must enable the clock of the controller, end its reset, connect its signals to pins and route its
/// interrupt before CONodeInit().
///
/// ESP32 (not C3, S2 and later ones) has errata that the driver works around if CO_CAN_TWAI.IsEsp32 is set: a frame
/// that was received after a faulty one may have wrong data, and the receive FIFO fails when it contains 64 frames.
/// Both need CO_CAN_TWAI.ResetPeripheral.
#ifndef CO_CAN_TWAI_H_
#define CO_CAN_TWAI_H_

#include "co_can_sja1000.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Addresses of controllers, for CO_CAN_TWAI.Registers
/// \{
#define CO_CAN_TWAI_ESP32 ((volatile uint32_t*)0x3FF6B000u)    ///< [ESP32 TRM, 21.6]
#define CO_CAN_TWAI_ESP32C3 ((volatile uint32_t*)0x6002B000u)  ///< [reg_base.h of ESP32-C3]
/// \}

/// \name Bit timing in C: \a clock of the controller in Hz (80 MHz, C6 and H2: that of the crystal), \a baud in bit/s,
/// and the number of quanta in a bit, 8…10 or 14…19. For ESP32: CO_CAN_TWAI_ESP32_RATE_OF().
/// \{

/// Initialises a CO_CAN_SJA1000_RATE; the sample point is as near to 87.5 % as these quanta allow.
/// Does not compile if the macro …_FITS() for the same values is false, or no constant.
#define CO_CAN_TWAI_RATE_OF(clock, baud, quanta)                           \
  {                                                                        \
    (baud) * CO_REQUIRED(CO_CAN_TWAI_RATE_FITS(clock, baud, quanta)),      \
        CO_CAN_SJA1000_TIMING(clock, baud, quanta, CO_TWAI_BTR0_SJW_SHIFT) \
  }
/// True if this timing is exact, its sample point is allowed by CiA 301, and the controller supports it.
#define CO_CAN_TWAI_RATE_FITS(clock, baud, quanta) CO_CAN_SJA1000_FITS(clock, baud, quanta, 8192)
/// Likewise for ESP32, whose prescaler allows 50 kbit/s at least.
#define CO_CAN_TWAI_ESP32_RATE_OF(clock, baud, quanta)                        \
  {                                                                           \
    (baud) * CO_REQUIRED(CO_CAN_TWAI_ESP32_RATE_FITS(clock, baud, quanta)),   \
        CO_CAN_SJA1000_TIMING(clock, baud, quanta, CO_SJA1000_BTR0_SJW_SHIFT) \
  }
/// Likewise for ESP32.
#define CO_CAN_TWAI_ESP32_RATE_FITS(clock, baud, quanta) CO_CAN_SJA1000_FITS(clock, baud, quanta, 64)
/// \}

/// A controller. Initialise it with zero, then set the members up to Loopback; the driver owns the others.
typedef struct CO_CAN_TWAI_T {
  volatile uint32_t* Registers;  ///< CO_CAN_TWAI_ESP32C3 and others
  bool IsEsp32;                  ///< the controller is that of ESP32 itself
  /// ESP32: pulses the reset of the peripheral (DPORT_PERIP_RST_EN_REG); called in the interrupt and in the loop. Null:
  /// reset mode is used instead, which does not suffice according to the errata.
  void (*ResetPeripheral)(void);
  const CO_CAN_SJA1000_RATE* Rates;  ///< must live as long as the node
  uint8_t RateNum;                   ///< length of that array
  CO_IF_FRM* Frames;  ///< queue between interrupt and loop: enough for the frames that arrive while the loop is busy
  uint16_t FrameNum;  ///< length of that array, 1…32767
  CO_CAN_RECOVERY Recovery;  ///< reaction to bus-off
  /// Self-test: the controller receives its own frames, which need no acknowledgement. It stays connected to the bus
  /// and needs the transceiver, or a connection from its output to its input.
  bool Loopback;

  /// \cond internal
  CO_RING Received;
  const CO_CAN_SJA1000_RATE* Rate;  // null: off the bus
  CO_SJA1000_TRANSMIT Transmit;
  CO_CAN_REPORT Report;
  CO_SJA1000_STATE State;
  /// \endcond
} CO_CAN_TWAI;

/// The driver; its context is a CO_CAN_TWAI.
extern const CO_IF_CAN_DRV_EX TwaiCanDriver;

/// Moves received frames into the queue, stores events and refills the transmit buffer. Call it in the interrupt of the
/// controller (level).
void COCanTwaiInterrupt(CO_CAN_TWAI* can);

/// Returns true if received frames wait until they are read; a loop checks it before it sleeps.
bool COCanTwaiHasFrames(const CO_CAN_TWAI* can);

/// Returns the number of received frames lost since Enable or a reset: because the queue was full, or because the
/// receive FIFO was full.
uint32_t COCanTwaiLost(const CO_CAN_TWAI* can);

/// Returns the error counters of the controller.
CO_CAN_ERROR_COUNTERS COCanTwaiErrors(const CO_CAN_TWAI* can);

#ifdef __cplusplus
}
#endif

#endif
