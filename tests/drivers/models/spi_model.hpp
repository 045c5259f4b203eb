// SPDX-License-Identifier: Apache-2.0
/// \file spi_model.hpp
/// A model of a controller behind SPI: chip select, bytes, the log of transactions and the log of faults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "can_wire.hpp"

namespace test {

/// Bytes between two edges of the chip select line.
struct SpiTransaction {
  std::vector<std::uint8_t> sent;      ///< by the host
  std::vector<std::uint8_t> received;  ///< by the host; a byte that the controller does not drive is A5h
};

/// SPI in modes 0,0 and 1,1.
class SpiModel {
 public:
  virtual ~SpiModel() = default;
  SpiModel(const SpiModel&) = delete;
  SpiModel& operator=(const SpiModel&) = delete;

  void select();                            ///< CS low
  std::uint8_t transfer(std::uint8_t out);  ///< eight clocks
  void deselect();                          ///< CS high
  bool is_selected() const { return is_selected_; }
  /// Returns true while the INT pin is low.
  virtual bool interrupt() const = 0;

  /// Complete transactions since the beginning or clear_transactions(), the last one at the end.
  const std::vector<SpiTransaction>& transactions() const { return transactions_; }
  std::size_t bytes() const;  ///< of these transactions
  void clear_transactions() { transactions_.clear(); }

  /// Accesses that the data sheet forbids, and uses of functions that are not modelled, as texts of one line.
  const std::vector<std::string>& faults() const { return faults_; }
  std::string fault_text() const;
  void clear_faults() { faults_.clear(); }

  /// Called before each byte, e.g. to run the interrupt function of the driver within a transaction.
  std::function<void()> on_transfer;

 protected:
  static constexpr std::uint8_t not_driven = 0xA5;

  explicit SpiModel(CanWire& wire) : wire_(wire) {}

  /// Performs a byte of the instruction; sent() has the bytes before it. Returns the byte of the controller.
  virtual std::uint8_t shift(std::uint8_t out) = 0;
  /// Ends the instruction with the rising edge of CS; sent() is not empty.
  virtual void end_instruction() = 0;
  const std::vector<std::uint8_t>& sent() const { return transaction_.sent; }
  void fault(const std::string& reason) { faults_.push_back(reason); }

  CanWire& wire_;

 private:
  bool is_selected_ = false;
  SpiTransaction transaction_;
  std::vector<SpiTransaction> transactions_;
  std::vector<std::string> faults_;
};

}  // namespace test
