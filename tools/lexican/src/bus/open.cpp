// SPDX-License-Identifier: Apache-2.0
#include "bus/open.hpp"

#include <algorithm>
#include <cstring>

#include "bus/hub.hpp"
#include "bus/log_formats.hpp"

namespace lexican::host_bus {
namespace {

/// A bus that sends nothing while its options say so.
class ListeningBus : public Bus {
 public:
  explicit ListeningBus(std::unique_ptr<Bus> bus) : bus_(std::move(bus)) {}
  pollfd wanted() override { return bus_->wanted(); }
  std::optional<Entry> receive() override { return bus_->receive(); }
  bool send(const CO_IF_FRM& frame) override { return !listens_only_ && bus_->send(frame); }
  bool restore() override { return bus_->restore(); }
  bool configure(const BusOptions& options) override {
    listens_only_ = options.listens_only;
    return bus_->configure(options);
  }
  const std::string& fault() const override { return bus_->fault(); }
  std::uint64_t lost() const override { return bus_->lost(); }
  bool is_physical() const override { return bus_->is_physical(); }
  std::uint32_t bit_rate() const override { return bus_->bit_rate(); }
  void filter(const std::uint32_t* ids, std::uint16_t number) override { bus_->filter(ids, number); }
  const LogReader* log() const override { return bus_->log(); }
  std::string refusal() const override { return bus_->refusal(); }
  std::string note() const override { return bus_->note(); }

 private:
  std::unique_ptr<Bus> bus_;
  bool listens_only_ = true;
};

/// Parses a bit rate such as 500k, 1M or 500000.
/// \retval 0  it is none
std::uint32_t parse_rate(std::string_view text) {
  const char unit = text.empty() ? '0' : text.back();
  const std::uint32_t factor = unit == 'k' ? 1000 : unit == 'M' ? 1000000 : 1;
  text.remove_suffix(factor == 1 ? 0 : 1);
  std::uint32_t number = 0;
  return parse_number(text, number) && number <= UINT32_MAX / factor ? number * factor : 0;
}

}  // namespace

bool split_rate(std::string& name, BusOptions& options, std::string& why) {
  const std::size_t at = name.rfind('@');
  if (at == std::string::npos || name.find('/', at) != std::string::npos) {
    return true;
  }
  const std::string text = name.substr(at + 1);
  const std::uint32_t rate = parse_rate(text);
  if (rate == 0) {
    why = "'" + text + "' is not a bit rate, such as 500k, 1M or 500000";
    return false;
  }
  name.resize(at);
  options.bit_rate = options.bit_rate != 0 ? options.bit_rate : rate;
  return true;
}

const std::vector<BusKind> bus_kinds = {
    {"hub:", "hub:bench", "a simulated bus between programs on this machine; hub:bench@500k: with the timing of a wire",
     false,
     [](const std::string& name, const BusOptions& /*options*/, std::string& why) { return open_hub(name, why); },
     nullptr},
    {"replay:", "replay:FILE", "a log of candump, pcapng, pcap or ASC; - for standard input", false, open_replay,
     [](const std::string& /*name*/, const BusOptions& /*options*/) { return true; }},
    {"socketcand:", "socketcand:HOST:29536/can0", "a CAN interface of another machine that runs socketcand", false,
     connect_to_socketcand, nullptr},
    {"slcan:", "slcan:/dev/ttyACM0@500k", "a serial or USB adapter", true, open_slcan, has_wrong_slcan_rate},
    {"slcan-tcp:", "slcan-tcp:192.168.0.7:29537", "an slcan adapter behind TCP", true, open_slcan_tcp,
     has_wrong_slcan_rate},
    {"slcan-pty", "slcan-pty", "a pseudo-terminal that another program opens as its slcan adapter", false,
     open_slcan_pty, nullptr},
    {"", "can0", "a CAN interface of Linux", false, open_socketcan,
     [](const std::string& name, const BusOptions& /*options*/) {
       return name.find_first_of(":/") != std::string::npos;
     }},
};

namespace {

const BusKind& kind_of(const std::string& name) {
  const auto has_prefix = [&](const BusKind& kind) {
    return name.compare(0, std::strlen(kind.prefix), kind.prefix) == 0;
  };
  return *std::find_if(bus_kinds.begin(), bus_kinds.end(), has_prefix);
}

}  // namespace

std::unique_ptr<Bus> open_bus(const std::string& name, const BusOptions& options, std::string& why) {
  const BusKind& kind = kind_of(name);
  if (kind.prefix[0] == '\0' && kind.is_wrong(name, options)) {
    why = "'" + name + "' is no bus, which is one of:";
    for (const BusKind& each : bus_kinds) {
      why += std::string("\n  ") + each.example;
    }
    return nullptr;
  }
  std::unique_ptr<Bus> bus = kind.open(name.substr(std::strlen(kind.prefix)), options, why);
  return bus != nullptr && options.listens_only ? std::make_unique<ListeningBus>(std::move(bus)) : std::move(bus);
}

bool needs_rate(const std::string& name, const BusOptions& options) {
  return kind_of(name).has_rate && options.bit_rate == 0 && name.find('@') == std::string::npos;
}

bool is_wrong_name(const std::string& name, const BusOptions& options) {
  const BusKind& kind = kind_of(name);
  return kind.is_wrong != nullptr && kind.is_wrong(name.substr(std::strlen(kind.prefix)), options);
}

}  // namespace lexican::host_bus
