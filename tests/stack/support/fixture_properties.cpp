// SPDX-License-Identifier: Apache-2.0
// Checks that a fixture performs after every call and in its destructor.
#include <algorithm>
#include <cstring>
#include <iterator>

#include "fixture.hpp"

namespace test {

// Waits until the server ends an abandoned transfer by its time-out. [D18]
void Fixture::check_back_to_idle() {
  const auto busy = [this] {
    return std::any_of(std::begin(node.Sdo), std::end(node.Sdo), [](const CO_SDO& sdo) { return sdo.Obj != nullptr; });
  };
  if (node.Nmt.Mode != CO_INVALID && busy() && CO_SDO_TIMEOUT > 0) {
    const std::vector<std::string> left = frames();
    CHECK_MESSAGE(left.empty(), "left unread: ", left.empty() ? "" : left[0]);
    can.accept_all();
    after(sdo_time_out());
    CHECK_MESSAGE(!busy(), "an SDO server is still busy after its time-out");
    trace();
  }
}

void Fixture::check_properties(Where at) {
  if (heap_requests() != heap_before_) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "heap used " << heap_requests() - heap_before_ << " times");
  }
  for (const std::string& violation : violations_) {
    ADD_FAIL_CHECK_AT(at.file, at.line, violation);
  }
  violations_.clear();
  if (od_locked_) {
    ADD_FAIL_CHECK_AT(at.file, at.line, "objects are left locked");
  }
  observe_channels();
  check_memory(at);
  for (const std::string& fault : timer_faults()) {
    ADD_FAIL_CHECK_AT(at.file, at.line, fault);
  }
}

// Returns the observer of the server whose COB-ID \a id is \a identifier; null if there is none or the NMT state
// forbids SDO.
SdoObserver* Fixture::channel(std::uint32_t CO_SDO::*id, std::uint32_t identifier) {
  const bool served = node.Nmt.Mode == CO_PREOP || node.Nmt.Mode == CO_OPERATIONAL;
  const auto is_it = [&](const CO_SDO& one) { return one.*id == identifier; };
  const auto found = std::find_if(std::begin(node.Sdo), std::end(node.Sdo), is_it);
  return served && found != std::end(node.Sdo) ? &channels_[static_cast<std::size_t>(found - node.Sdo)] : nullptr;
}

void Fixture::observe_channels() {
  for (std::size_t n = 0; n < channels_.size(); ++n) {
    std::vector<CO_IF_FRM> waiting;
    std::copy_if(node.TxQueue.Frame, node.TxQueue.Frame + node.TxQueue.Num, std::back_inserter(waiting),
                 [&](const CO_IF_FRM& frm) { return frm.Identifier == node.Sdo[n].TxId; });
    channels_[n].waiting(waiting);
  }
}

void Fixture::check_memory(Where at) {
  ChangeableEntries may;
  for (std::size_t n = 0; n < channels_.size(); ++n) {
    channels_[n].take_changeable(may);
    if (node.Sdo[n].Flow.State == 0) {
      channels_[n].close();
    }
  }
  for (const std::uint32_t dev : memory_.changed()) {
    const bool streams = memory_.is_stream(dev) && may.streaming.count(dev) > 0;
    const bool right = may.completed.count(dev) > 0 || streams || memory_.shares(dev, may.completed);
    if (!right || (memory_.is_read_only(dev) && !memory_.shares(dev, may.completed))) {
      ADD_FAIL_CHECK_AT(at.file, at.line,
                        "object changed without a legal download: index " << CO_GET_IDX(dev) << " sub-index "
                                                                          << unsigned{CO_GET_SUB(dev)});
    }
  }
}

namespace {

// Returns the timers of a list, at most bound + 1. More than \a bound timers mean that the list is cyclic.
std::vector<const CO_TMR_MEM*> members(const CO_TMR_MEM* list, std::size_t bound) {
  std::vector<const CO_TMR_MEM*> all;
  for (; list != nullptr && all.size() <= bound; list = list->Next) {
    all.push_back(list);
  }
  return all;
}

// Returns the number of SDO clients whose timer is armed.
template <class Count>
std::ptrdiff_t armed_of_clients([[maybe_unused]] const CO_NODE& node, [[maybe_unused]] const Count& number_of) {
  std::ptrdiff_t armed = 0;
#if USE_CSDO
  for (const CO_CSDO& client : node.CSdo) {
    armed += std::min<std::ptrdiff_t>(number_of(client.Tmr), 1);
  }
#endif
  return armed;
}

bool is_open(const CO_NODE& node) {
  return std::any_of(std::begin(node.Sdo), std::end(node.Sdo), [](const CO_SDO& sdo) { return sdo.Flow.State != 0; });
}

}  // namespace

std::vector<const CO_TMR_MEM*> Fixture::armed() const {
  // The timers of the stack are members of the node.
  return members(node.Tmr.First, setup_.timers_ + sizeof node / sizeof(CO_TMR_MEM));
}

unsigned Fixture::armed_timers() const { return static_cast<unsigned>(armed().size()); }

// Returns the faults of the timers. Each timer of the application's pool is armed or free, none is armed twice, and a
// timer of the stack is armed only while its service needs it.
std::vector<std::string> Fixture::timer_faults() const {
  if (node.Dict.Node == nullptr) {
    return {};  // The initialisation has failed before the services were initialised.
  }
  std::vector<std::string> faults;
  const auto expect = [&](bool right, const char* fault) {
    if (!right) faults.emplace_back(fault);
  };
  const std::vector<const CO_TMR_MEM*> all = armed();
  const auto number_of = [&](const CO_TMR_MEM& one) { return std::count(all.begin(), all.end(), &one); };
  const auto heartbeat = number_of(node.HbProdTmr);
  const auto sdo = number_of(node.SdoTmr);
  const auto clients = armed_of_clients(node, number_of);
  const auto is_of_pool = [&](const CO_TMR_MEM* one) {
    return std::any_of(timers_.begin(), timers_.end(), [=](const CO_TMR_MEM& mem) { return &mem == one; });
  };
  const auto application = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_of_pool));
  const bool twice = std::any_of(all.begin(), all.end(), [&](const CO_TMR_MEM* one) { return number_of(*one) > 1; });
  const CO_MODE mode = node.Nmt.Mode;
  expect(!twice, "a timer is armed twice");
  const std::size_t unused = members(node.Tmr.Free, setup_.timers_).size() + setup_.timers_ - node.Tmr.Used;
  expect(application + unused == setup_.timers_, "a timer of the pool is lost");
  expect(heartbeat == 0 || (mode != CO_INVALID && mode != CO_INIT), "heartbeat timer armed without a heartbeat");
  expect(sdo + clients == 0 || mode == CO_PREOP || mode == CO_OPERATIONAL, "SDO timer armed while SDO is not allowed");
  expect(sdo == 1 || !is_open(node) || CO_SDO_TIMEOUT == 0, "a transfer is open and nothing watches it");
  return faults;
}

std::string Fixture::difference(const Fixture& other) const {
  const auto differs = [](const auto& a, const auto& b) { return std::memcmp(&a, &b, sizeof a) != 0; };
  if (node.Nmt.Mode != other.node.Nmt.Mode || node.NodeId != other.node.NodeId) {
    return "mode or node-ID";
  }
  for (unsigned n = 0; n < CO_SSDO_N; ++n) {
    const CO_SDO& a = node.Sdo[n];
    const CO_SDO& b = other.node.Sdo[n];
    if (a.Obj != b.Obj || a.RxId != b.RxId || a.TxId != b.TxId || a.Flow.State != b.Flow.State) {
      return "SDO server " + std::to_string(n);
    }
  }
  if (node.TxQueue.Num != other.node.TxQueue.Num || node.Pending != other.node.Pending) {
    return "waiting frames or pending work";
  }
#if CO_ROUTES_SORTED
  if (differs(node.Routes.Start, other.node.Routes.Start)) {
    return "routes";
  }
#else
  if (differs(node.Routes.Id, other.node.Routes.Id)) {
    return "routes";
  }
#endif
  return armed_timers() == other.armed_timers() ? "" : "timers";
}

}  // namespace test
