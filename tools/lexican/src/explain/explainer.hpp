// SPDX-License-Identifier: Apache-2.0
/// \file explainer.hpp
/// Finds the causes of faults in the frames of a bus. The memory in use does not depend on the number of frames.
#pragma once

#include "explain/check.hpp"

namespace lexican::explain {

/// Context: one thread.
class Explainer {
 public:
  /// \a network must outlive it. \a bit_rate: bit/s; 0: unknown. \a identified: see describe::Monitor
  explicit Explainer(const describe::Network& network, std::uint32_t bit_rate,
                     describe::Monitor::Identified identified = {});

  void process(const Entry& entry);
  /// Ends transfers without an answer. \a now: time of the bus
  void advance(Micros now);
  /// Ends what is open at the end of a log.
  void finish();

  /// Returns the causes so far, without those that are consequences of others: by cause, then by node.
  std::vector<Finding> findings() const;
  /// Returns true if there are more causes than findings() returns.
  bool is_cut() const { return findings_.is_cut(); }
  const describe::Statistics& statistics() const { return monitor_.statistics(); }
  /// Returns the number of EMCY messages, failed SDO transfers and error frames, explained or not.
  unsigned faults() const { return faults_; }

 private:
  Micros continuous(Micros time);

  Findings findings_;
  describe::Monitor monitor_;
  Facts facts_;
  std::vector<std::unique_ptr<Check>> checks_;
  Micros advanced_ = 0;
  Micros shift_ = 0;  ///< of the times, modulo 2^64
  unsigned faults_ = 0;
};

}  // namespace lexican::explain
