// SPDX-License-Identifier: Apache-2.0
/// \file bench.hpp
/// The drivers for CAN controllers on the models of their controllers (tests/drivers/models), on one simulated bus:
///
///     Bench bench;                                  // 500 kbit/s
///     Controller& can = bench.add(Kind::bxcan);     // Init, Enable
///     can.send("123#0102");
///     bench.run(200);                               // bit times; interrupts are processed after each of them
///     CHECK(bench.peer.received.size() == 1);
///
/// An access that the reference manual forbids, an interrupt that stays active, and an access outside of the models
/// fail the test case.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "can_wire.hpp"
#include "co_can_controller.h"
#include "co_can_spi.h"
#include "co_if_can.h"
#include "register_model.hpp"

namespace test {

class Bench;

/// Controllers: bxCAN, M_CAN with fixed message memory (FDCAN), M_CAN with configurable message memory, FlexCAN2 with
/// the receive FIFO, FlexCAN3 with message buffers that receive, and others.
enum class Kind : std::uint8_t { bxcan, fdcan, mcan, flexcan2, flexcan3, sja1000, esp32, esp32c3, mcp2515, mcp251xfd };
inline constexpr Kind all_kinds[] = {Kind::bxcan,   Kind::fdcan, Kind::mcan,    Kind::flexcan2, Kind::flexcan3,
                                     Kind::sja1000, Kind::esp32, Kind::esp32c3, Kind::mcp2515,  Kind::mcp251xfd};
/// Controllers with filters for single identifiers that can change on the bus, and with a loopback that is disconnected
/// from the bus.
inline constexpr Kind mailbox_kinds[] = {Kind::bxcan,    Kind::fdcan,    Kind::mcan,
                                         Kind::flexcan2, Kind::flexcan3, Kind::mcp251xfd};
/// Controllers with a loopback that is disconnected from the bus.
inline constexpr Kind isolated_kinds[] = {Kind::bxcan,    Kind::fdcan,   Kind::mcan,     Kind::flexcan2,
                                          Kind::flexcan3, Kind::mcp2515, Kind::mcp251xfd};
/// SJA1000 and TWAI of ESP32 and ESP32-C3.
inline constexpr Kind sja1000_kinds[] = {Kind::sja1000, Kind::esp32, Kind::esp32c3};
/// Controllers behind SPI.
inline bool is_spi(Kind kind) { return kind == Kind::mcp2515 || kind == Kind::mcp251xfd; }
inline bool is_flexcan(Kind kind) { return kind == Kind::flexcan2 || kind == Kind::flexcan3; }
inline bool is_twai(Kind kind) { return kind == Kind::esp32 || kind == Kind::esp32c3; }
inline bool is_sja1000(Kind kind) { return kind == Kind::sja1000 || is_twai(kind); }
std::string name_of(Kind kind);

struct BxcanOptions {
  unsigned banks = 14;            ///< filter banks of the device: 14, or 28 for CAN1 with CAN2
  unsigned first = 0;             ///< first bank of the controller
  unsigned number = 14;           ///< number of its banks
  unsigned release_accesses = 0;  ///< BxCan::release_accesses
  bool late_abort_clears_flags = false;
};

struct ControllerOptions {
  unsigned number = 0;  ///< 0: CAN1, 1: CAN2, which shares the filter banks or the message memory of CAN1
  CO_CAN_RECOVERY recovery = CO_CAN_RECOVERY_BY_APPLICATION;
  bool loopback = false;
  bool wait_for_idle = false;              ///< CO_CAN_FDCAN.WaitForIdle
  std::uint16_t frames = 64;               ///< places in the queue
  std::uint8_t fifo = 4;                   ///< places in the receive FIFO of Kind::mcan
  std::uint32_t clock = 48'000'000;        ///< Hz
  bool starts = true;                      ///< Init, Enable; false: neither
  CO_CAN_SPI_BUS* spi_bus = nullptr;       ///< of a controller behind SPI
  bool has_interrupt_pin = true;           ///< behind SPI: the driver can read the pin INT
  bool is_error_flag_sticky = false;       ///< Mcp2515::Options
  bool keeps_messages_in_bus_off = false;  ///< Mcp251xfd::Options
  bool flags_begin_of_bus_off = false;     ///< Mcp251xfd::Options
  BxcanOptions bxcan;
};

/// A driver and the model of its controller.
class Controller {
 public:
  virtual ~Controller() = default;

  void init() { driver->Init(context()); }
  void enable(std::uint32_t baud) { driver->Enable(context(), baud); }
  void reset() { driver->Reset(context()); }
  void close() { driver->Close(context()); }
  void filter(const std::vector<std::uint32_t>& ids);
  std::int16_t send(const CO_IF_FRM& frame) { return driver->Send(context(), &frame); }
  std::int16_t send(const char* text);
  bool takes(const char* text) { return send(text) == sizeof(CO_IF_FRM); }
  bool takes(const CO_IF_FRM& frame) { return send(frame) == sizeof(CO_IF_FRM); }
  /// Returns the next frame in can-utils notation, the result of Read if there is none.
  std::string read();
  std::vector<std::string> read_all();

  virtual void* context() = 0;
  virtual bool has_interrupt() const = 0;
  virtual void call_interrupt() = 0;
  virtual bool has_frames() const = 0;
  virtual std::uint32_t lost() const = 0;
  virtual CO_CAN_ERROR_COUNTERS errors() const = 0;

  virtual CanNode& node() = 0;
  /// Returns the model. That of a controller behind SPI has none: the functions below work for all.
  virtual RegisterModel& registers() = 0;
  virtual bool has_faults() { return !registers().faults().empty(); }
  virtual std::string fault_text() { return registers().fault_text(); }
  /// Sets a function that is called before each access of the driver; behind SPI before each byte.
  virtual void on_access(std::function<void()> function) { registers().on_access = std::move(function); }
  /// Returns whether the controller is in bus-off, or off the bus.
  bool is_off_bus() { return node().is_bus_off() || node().state() == CanNode::State::off; }
  virtual std::uint32_t bit_rate() const = 0;
  virtual unsigned sample_point() const = 0;  ///< permille
  /// Replaces the bit timing of the table.
  virtual void set_timing(std::uint32_t baud, std::uint32_t timing) = 0;
  /// Returns the frames in the receive FIFO that were not read yet.
  virtual unsigned fifo_places() const = 0;

  const CO_IF_CAN_DRV_EX* driver = nullptr;
};

class Mcp2515;
class Mcp251xfd;
class SpiModel;
/// Returns the model of a controller of Kind::mcp2515.
Mcp2515& mcp2515_of(Controller& controller);
/// Returns the model of a controller of Kind::mcp251xfd.
Mcp251xfd& mcp251xfd_of(Controller& controller);
/// Returns the model of a controller behind SPI.
SpiModel& spi_of(Controller& controller);

class Bench {
 public:
  static constexpr std::uint32_t baud = 500'000;

  Bench();
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  Controller& add(Kind kind, const ControllerOptions& options = {});

  /// Advances the bus and processes interrupts after each bit.
  void run(std::uint64_t bits);
  /// Returns false if the condition is not true after the number of bits.
  bool run_until(const std::function<bool()>& condition, std::uint64_t bits = 20'000);
  /// Calls the interrupt functions until no interrupt is active.
  void process_interrupts();
  /// Lets the interrupt functions run before any access of the loop, at which an interrupt is active.
  void interrupt_everywhere();
  /// Sends a frame from the peer and waits until it has been sent.
  void receive(const CanFrame& frame);
  /// Returns the frames that a controller has sent, in can-utils notation.
  std::vector<std::string> sent_by(Controller& controller) const;

  CanWire wire;
  CanPeer peer{wire};
  bool are_interrupts_enabled = true;
  bool checks_faults = true;

 private:
  void process(Controller& controller);
  std::uintptr_t ram();

  std::vector<std::unique_ptr<RegisterModel>> memory_;
  std::vector<std::unique_ptr<Controller>> controllers_;
  bool is_in_interrupt_ = false;
};

CO_IF_FRM to_driver(const CanFrame& frame);
CanFrame to_wire(const CO_IF_FRM& frame);

/// Returns the texts of frames whose error flag is set, or not set.
std::vector<std::string> error_frames(const std::vector<std::string>& all);
std::vector<std::string> data_frames(const std::vector<std::string>& all);

}  // namespace test

template <class Item>
struct doctest::StringMaker<std::vector<Item>> {
  static String convert(const std::vector<Item>& items) {
    String all = "[";
    for (const Item& item : items) {
      all += (all.size() == 1 ? "" : ", ") + toString(item);
    }
    return all + "]";
  }
};
