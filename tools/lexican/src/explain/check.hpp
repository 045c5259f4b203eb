// SPDX-License-Identifier: Apache-2.0
/// \file check.hpp
/// A check looks for some causes in the frames of a bus.
#pragma once

#include <memory>

#include "explain/facts.hpp"

namespace lexican::explain {

class Check {
 public:
  /// Both must outlive the check. \a facts: those before the frame that is processed.
  Check(const Facts& facts, Findings& findings) : facts_(facts), findings_(findings) {}
  virtual ~Check() = default;
  Check(const Check&) = delete;
  Check& operator=(const Check&) = delete;

  /// The next frame of the bus.
  virtual void frame(const Entry& /*entry*/) {}
  /// An SDO transfer has ended.
  virtual void transfer(std::uint8_t /*node*/, const describe::SdoTransfer& /*transfer*/) {}
  /// Some time has passed. Called with each frame, at most every 10 ms of the bus, and at the end.
  virtual void advance(Micros /*now*/) {}

 protected:
  const Facts& facts_;
  Findings& findings_;
};

std::unique_ptr<Check> make_error_control_check(const Facts& facts, Findings& findings);
std::unique_ptr<Check> make_emcy_check(const Facts& facts, Findings& findings);
std::unique_ptr<Check> make_lss_check(const Facts& facts, Findings& findings);
std::unique_ptr<Check> make_pdo_check(const Facts& facts, Findings& findings);
std::unique_ptr<Check> make_sync_check(const Facts& facts, Findings& findings);
std::unique_ptr<Check> make_sdo_check(const Facts& facts, Findings& findings);
std::unique_ptr<Check> make_bus_check(const Facts& facts, Findings& findings);

}  // namespace lexican::explain
