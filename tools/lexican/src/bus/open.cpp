// SPDX-License-Identifier: Apache-2.0
#include "bus/open.hpp"

#include "bus/hub.hpp"

namespace lexican::host_bus {
namespace {

/// A bus that sends nothing.
class ListeningBus : public Bus {
 public:
  explicit ListeningBus(std::unique_ptr<Bus> bus) : bus_(std::move(bus)) {}
  pollfd wanted() override { return bus_->wanted(); }
  std::optional<Entry> receive() override { return bus_->receive(); }
  bool send(const CO_IF_FRM& /*frame*/) override { return false; }
  bool restore() override { return bus_->restore(); }
  const std::string& fault() const override { return bus_->fault(); }
  std::uint64_t lost() const override { return bus_->lost(); }
  bool is_physical() const override { return bus_->is_physical(); }
  std::uint32_t bit_rate() const override { return bus_->bit_rate(); }
  const LogReader* log() const override { return bus_->log(); }
  std::string note() const override { return bus_->note(); }

 private:
  std::unique_ptr<Bus> bus_;
};

}  // namespace

const std::vector<BusKind> bus_kinds = {
    {"hub:", "hub:bench", "a simulated bus between programs on this machine; it needs nothing else",
     [](const std::string& name, const BusOptions& /*options*/, std::string& why) { return open_hub(name, why); }},
    {"replay:", "replay:FILE", "a log of candump, pcapng, pcap or ASC; - for standard input", open_replay},
    {"socketcand:", "socketcand:HOST:29536/can0", "a CAN interface of another machine that runs socketcand",
     connect_to_socketcand},
    {"slcan:", "slcan:/dev/ttyACM0@500k", "a serial or USB adapter", open_slcan},
    {"slcan-tcp:", "slcan-tcp:192.168.0.7:29537", "an slcan adapter behind TCP", open_slcan_tcp},
    {"slcan-pty", "slcan-pty", "a pseudo-terminal that another program opens as its slcan adapter", open_slcan_pty},
    {"", "can0", "a CAN interface of Linux", open_socketcan},
};

std::unique_ptr<Bus> open_bus(const std::string& name, const BusOptions& options, std::string& why) {
  for (const BusKind& kind : bus_kinds) {
    const std::string_view prefix = kind.prefix;
    if (name.compare(0, prefix.size(), prefix) == 0) {
      std::unique_ptr<Bus> bus = kind.open(name.substr(prefix.size()), options, why);
      return bus != nullptr && options.listens_only ? std::make_unique<ListeningBus>(std::move(bus)) : std::move(bus);
    }
  }
  return nullptr;
}

}  // namespace lexican::host_bus
