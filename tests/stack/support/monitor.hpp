// SPDX-License-Identifier: Apache-2.0
/// \file monitor.hpp
/// A heartbeat consumer with a record of its callbacks:
///
///     Monitor node({{5, 100}, {6, 250}});     // 1016h:1 node 5, 100 ms; 1016h:2 node 6, 250 ms
///     node.rx("705#7F");                      node.told("5 PREOP");
///     node.after(100ms);                      node.told("5 missing");  node.emergency("081#3081110000050000");
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "fixture.hpp"

namespace test {

struct Monitored {
  std::uint8_t node_id;
  std::uint16_t ms;
};

inline constexpr std::size_t monitor_entries = CO_HBCONS_N;

/// Data of 1016h. Only time and node-ID are set, as by an application.
struct MonitorEntries {
  MonitorEntries(std::initializer_list<Monitored> monitored);
  std::array<CO_HBCONS, monitor_entries> entry;
};

class Monitor : public MonitorEntries, public Fixture {
 public:
  /// Creates all CO_HBCONS_N entries; those beyond the list have time 0. 1001h and, unless \a setup replaces it, 1029h
  /// are those of Setup.
  explicit Monitor(std::initializer_list<Monitored> monitored, const Setup& setup = {});
  ~Monitor();

  /// Writes 1016h by SDO. Returns the abort code, 0: success.
  std::uint32_t configure(std::uint8_t sub, std::uint32_t value);
  /// Checks the calls of CONmtHbConsChange(), CONmtHbConsEvent() and CONmtModeChange() since the last check, joined by
  /// ", ": "5 PREOP", "5 missing", "mode STOP".
  void told(const std::string& all, Where at = {__builtin_FILE(), __builtin_LINE()});
  /// Calls tx() if the node has EMCY messages.
  void emergency(std::string_view frame, Where at = {__builtin_FILE(), __builtin_LINE()});

  std::vector<std::string> record;
};

/// Returns the name of a state as in Monitor::told().
std::string name_of(CO_MODE mode);

}  // namespace test
