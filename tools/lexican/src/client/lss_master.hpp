// SPDX-License-Identifier: Apache-2.0
/// \file lss_master.hpp
/// Synchronous access to the stack's LSS master: each call returns when the service has ended. [305]
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "co_core.h"
#include "host/loop.hpp"
#include "host/node.hpp"

namespace lexican {

/// Vendor-ID, product code, revision and serial number.
using LssAddress = std::array<std::uint32_t, 4>;

#if USE_LSS_MASTER

class LssMaster {
 public:
  struct Times {
    std::uint32_t timeout;  // ms, for the answer of a node
    std::uint32_t listen;   // ms, to collect the answers of several nodes to a request that searches for nodes
  };

  /// \a node must be one of \a loop. Both must outlive this object.
  LssMaster(Node& node, Loop& loop, Times times);
  LssMaster(const LssMaster&) = delete;
  LssMaster& operator=(const LssMaster&) = delete;

  /// Runs a service: one of the functions COLssm…(), to whose arguments it adds the callback. An interruption of the
  /// program cancels the service. Returns false if it fails; fault() returns the reason.
  template <class... Argument, class... Value>
  bool run(CO_ERR (*service)(CO_LSSM*, Argument...), Value... values) {
    begin();
    return wait_for_end(service(&lssm_, values..., note_end));
  }

  /// Runs an inquiry, like run(). Repeats it once if there is no answer, because an adapter may have lost a frame.
  template <class... Argument, class... Value>
  bool inquire(CO_ERR (*service)(CO_LSSM*, Argument...), Value... values) {
    return run(service, values...) || (timed_out() && run(service, values...));
  }

  /// Runs a service that exactly one node must answer, like run(). Waits for further answers and returns false if there
  /// are any.
  template <class... Argument, class... Value>
  bool run_alone(CO_ERR (*service)(CO_LSSM*, Argument...), Value... values) {
    return run(service, values...) && is_alone();
  }
  /// Waits for further answers, for the listening time. Returns false if several nodes have answered the last request.
  bool is_alone();
  /// Stores a fault found by the program, for fault(). Always returns false.
  bool fail(std::string fault);

  /// Number of answers to the last request, and its results.
  unsigned answers() const { return lssm_.Heard; }
  std::uint32_t value() const { return lssm_.Value; }
  LssAddress address() const { return {lssm_.Address[0], lssm_.Address[1], lssm_.Address[2], lssm_.Address[3]}; }
  bool no_node_found() const { return fault_.empty() && error_ == CO_ERR_NONE && result_ == CO_LSSM_NOT_FOUND; }
  bool timed_out() const { return fault_.empty() && error_ == CO_ERR_NONE && result_ == CO_LSSM_TIMEOUT; }
  bool cancelled() const { return fault_.empty() && error_ == CO_ERR_NONE && result_ == CO_LSSM_CANCELLED; }
  std::string fault() const;

 private:
  static void note_end(CO_LSSM* lssm, CO_LSSM_RESULT result);
  void begin();
  bool wait_for_end(CO_ERR start_result);

  Node& node_;
  CO_LSSM& lssm_;
  Loop& loop_;
  std::uint32_t listen_;  // ms
  std::string fault_;     // fault found by the program; empty: none
  bool ended_ = false;
  CO_ERR error_ = CO_ERR_NONE;  // result of starting the last service
  CO_LSSM_RESULT result_ = CO_LSSM_OK;
};

#endif

}  // namespace lexican
