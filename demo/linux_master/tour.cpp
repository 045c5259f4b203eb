// SPDX-License-Identifier: Apache-2.0
#include "linux_master/tour.hpp"

#include "clock/names.hpp"
#include "host/exit.hpp"
#include "tour/device.hpp"
#include "tour/master.hpp"
#include "tour/tour.hpp"
#include "trace/text.hpp"

namespace lexican::demo {
namespace {

// Traits of a small device that may run in a slow emulator.
constexpr DeviceTraits traits_elsewhere = {48, 32, false, 20};

class ClockElsewhere : public Device {
 public:
  explicit ClockElsewhere(std::uint8_t node_id) : node_id_(node_id) {}

  const DeviceTraits& traits() const override { return traits_elsewhere; }
  bool start() override { return true; }
  void lose_power() override {}
  std::uint8_t node_id() const override { return node_id_; }
  Node* node_in_loop() override { return nullptr; }

 private:
  std::uint8_t node_id_;
};

}  // namespace

int run_clock_tour(std::uint8_t node, Host& host, View::Style style, std::ostream& out) {
  View view(out, clock_object_names(), style, clock_mappings());
  ClockElsewhere clock(node);
  const Micros begin = host.now();
  view.columns();
  Master master(host, clock, node,
                [&](bool received, const CO_IF_FRM& frame) { view.frame(host.now() - begin, !received, frame); });
  const TourResult result = run_tour(clock, master, view);
  print_summary(result, master.counters(), view, "master");
  const std::string fault = host.bus_fault();
  if (!fault.empty()) {
    view.finding(false, fault);
  }
  if (result.interrupted) {
    return host.bus_lost() ? exit_failed : exit_interrupted;
  }
  return result.failed.empty() ? exit_ok : exit_failed;
}

}  // namespace lexican::demo
