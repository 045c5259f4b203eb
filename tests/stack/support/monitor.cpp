// SPDX-License-Identifier: Apache-2.0
#include "monitor.hpp"

#include <cstring>

namespace test {

std::string name_of(CO_MODE mode) {
  switch (mode) {
    case CO_INVALID: return "INVALID";
    case CO_INIT: return "INIT";
    case CO_PREOP: return "PREOP";
    case CO_OPERATIONAL: return "OPERATIONAL";
    case CO_STOP: return "STOP";
    default: return "no mode";
  }
}

#if CO_HBCONS_N > 0

namespace {

Setup with_entries(Setup setup, MonitorEntries& entries) {
  setup.with({CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, monitor_entries});
  for (std::size_t n = 0; n < monitor_entries; ++n) {
    setup.with({CO_KEY(0x1016, n + 1, CO_OBJ_____RW), CO_THB_CONS, &entries.entry[n]});
  }
  return setup;
}

}  // namespace

MonitorEntries::MonitorEntries(std::initializer_list<Monitored> monitored) {
  std::memset(static_cast<void*>(entry.data()), 0xA5, sizeof entry);
  for (CO_HBCONS& one : entry) {
    one.Time = 0;
    one.NodeId = 0;
  }
  CO_HBCONS* next = entry.data();
  for (const Monitored& one : monitored) {
    next->NodeId = one.node_id;
    next->Time = one.ms;
    ++next;
  }
}

Monitor::Monitor(std::initializer_list<Monitored> monitored, const Setup& setup)
    : MonitorEntries(monitored), Fixture(with_entries(setup, *this)) {
  callbacks().heartbeat_change = [this](CO_NMT* nmt, std::uint8_t id, CO_MODE mode) {
    CHECK(nmt == &node.Nmt);
    record.push_back(std::to_string(id) + " " + name_of(mode));
  };
  callbacks().heartbeat_event = [this](CO_NMT* nmt, std::uint8_t id) {
    CHECK(nmt == &node.Nmt);
    record.push_back(std::to_string(id) + " missing");
  };
  callbacks().mode_change = [this](CO_NMT*, CO_MODE mode) { record.push_back("mode " + name_of(mode)); };
}

Monitor::~Monitor() {
  callbacks().mode_change = nullptr;
  told("");
}

std::uint32_t Monitor::configure(std::uint8_t sub, std::uint32_t value) {
  CO_IF_FRM request = frame("601#2316100000000000");
  request.Data[3] = sub;
  CO_SET_LONG(&request, value, 4);
  rx(request);
  const CO_IF_FRM answer = can.sent.empty() ? CO_IF_FRM{} : can.sent.front().frm;
  trace();
  return answer.Data[0] == 0x60 ? 0 : CO_GET_LONG(&answer, 4);
}

void Monitor::told(const std::string& all, Where at) {
  std::string joined;
  for (const std::string& one : record) {
    joined += (joined.empty() ? "" : ", ") + one;
  }
  if (joined != all) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "expected \"" << all << "\", told \"" << joined << "\"");
  }
  record.clear();
}

void Monitor::emergency(std::string_view frame, Where at) {
#if USE_EMCY
  tx(frame, at);
#else
  static_cast<void>(frame);
  silent(at);
#endif
}

#endif

}  // namespace test
