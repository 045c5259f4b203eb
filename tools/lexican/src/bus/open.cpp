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

namespace {

bool is_no_interface(const std::string& name) { return name.find_first_of(":/") != std::string::npos; }

bool is_without_device(const std::string& name) { return name.empty() || name.front() == '@'; }

/// Returns true if an interface can be opened, but not with this bit rate.
bool has_another_rate(const std::string& name, const BusOptions& options) {
  std::string why;
  return options.bit_rate != 0 && open_socketcan(name, {}, why) != nullptr;
}

/// Returns true if the end of HOST:PORT[@RATE] is no port.
bool has_wrong_port(const std::string& name) {
  const std::string address = name.substr(0, name.rfind('@'));
  const std::size_t colon = address.rfind(':');
  std::uint16_t port = 0;
  return colon == std::string::npos || colon == 0 || !parse_number(std::string_view(address).substr(colon + 1), port) ||
         port == 0;
}

}  // namespace

const std::vector<BusKind> bus_kinds = {
    {"hub:", "hub:bench", "a simulated bus between programs on this machine; hub:bench@500k: with the timing of a wire",
     false,
     [](const std::string& name, const BusOptions& /*options*/, std::string& why) { return open_hub(name, why); },
     [](const std::string& name, const BusOptions& /*options*/) {
       std::string hub = name;
       BusOptions options;
       return !hub_name_fault(hub, options).empty();
     },
     "hub:NAME@500k starts a hub with the timing of a wire"},
    {"replay:", "replay:FILE", "a log of candump, pcapng, pcap or ASC; - for standard input", false, open_replay,
     [](const std::string& /*name*/, const BusOptions& /*options*/) { return true; }},
    {"socketcand:", "socketcand:HOST:29536/can0", "a CAN interface of another machine that runs socketcand", false,
     connect_to_socketcand, has_wrong_socketcand_name,
     "it is set where the server runs, ip link set can0 up type can bitrate 500000"},
    {"slcan:", "slcan:/dev/ttyACM0@500k", "a serial or USB adapter", true,
     [](const std::string& name, const BusOptions& options, std::string& why) -> std::unique_ptr<Bus> {
       if (is_without_device(name)) {
         why = "slcan needs a device, such as /dev/ttyACM0";
         return nullptr;
       }
       return open_slcan(name, options, why);
     },
     [](const std::string& name, const BusOptions& options) {
       return is_without_device(name) || has_wrong_slcan_rate(name, options);
     }},
    {"slcan-tcp:", "slcan-tcp:192.168.0.7:29537", "an slcan adapter behind TCP", true, open_slcan_tcp,
     [](const std::string& name, const BusOptions& options) {
       return has_wrong_port(name) || has_wrong_slcan_rate(name, options);
     }},
    {"slcan-pty", "slcan-pty", "a pseudo-terminal that another program opens as its slcan adapter", false,
     open_slcan_pty, [](const std::string& name, const BusOptions& /*options*/) { return !name.empty(); }},
    {"", "can0", "a CAN interface of Linux", false, open_socketcan,
     [](const std::string& name, const BusOptions& options) {
       return is_no_interface(name) || has_another_rate(name, options);
     },
     "ip link set can0 up type can bitrate 500000"},
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
  if (kind.prefix[0] == '\0' && is_no_interface(name)) {
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

std::string rate_fault(const std::string& name, const BusOptions& options) {
  const BusKind& kind = kind_of(name);
  std::string address = name;
  BusOptions of_name;
  std::string why;
  const bool has_own =
      (kind.has_rate || kind.rate_setting != nullptr) && split_rate(address, of_name, why) && of_name.bit_rate != 0;
  if (options.bit_rate == 0 || (has_own && of_name.bit_rate == options.bit_rate)) {
    return {};
  }
  if (has_own) {
    const bool is_round = options.bit_rate % 1000 == 0;
    return name + " and --rate " + std::to_string(options.bit_rate / (is_round ? 1000 : 1)) + (is_round ? "k" : "") +
           " are different bit rates; give one of them";
  }
  const bool is_interface = kind.prefix[0] == '\0';  // it is compared with the rate of the interface
  return kind.rate_setting == nullptr || is_interface || options.listens_only
             ? std::string()
             : name + " has no bit rate that --rate could set: " + kind.rate_setting;
}

bool is_wrong_name(const std::string& name, const BusOptions& options) {
  const BusKind& kind = kind_of(name);
  return kind.is_wrong != nullptr && kind.is_wrong(name.substr(std::strlen(kind.prefix)), options);
}

}  // namespace lexican::host_bus
