// SPDX-License-Identifier: Apache-2.0
// lexican share: hands one adapter to many programs.
#include <fmt/format.h>
#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bus/clock.hpp"
#include "bus/hub.hpp"
#include "bus/socketcand.hpp"
#include "program/verb.hpp"

namespace lexican::program {
namespace {

using host_bus::Bus;
using host_bus::clock_now;
using host_bus::Entry;
using host_bus::Micros;

constexpr unsigned frames_in_turn = 64;

struct ShareOptions {
  Common common;
  std::string name;
  std::string address = "127.0.0.1";
  std::uint16_t port = 29536;
  std::uint16_t slcan_port = 29537;
  bool has_pty = false;
};

/// Returns the name of the hub for a bus: ttyACM0 of slcan:/dev/ttyACM0@500k.
std::string hub_name_of(const std::string& bus) {
  std::string name = bus.substr(0, bus.find('@'));
  name = name.substr(name.find_last_of(":/") + 1);
  name.erase(std::remove_if(name.begin(), name.end(),
                            [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_'; }),
             name.end());
  return name;
}

/// The adapter, and the ways to it. A frame of one of them goes to all others.
class Share {
 public:
  explicit Share(std::unique_ptr<Bus> adapter)
      : adapter_(std::move(adapter)),
        hub_(adapter_->is_physical() ? fmt::format("physical {}", adapter_->bit_rate()) : "simulated") {}
  ~Share() {
    if (!hub_.path().empty()) {
      unlink(hub_.path().c_str());
    }
  }
  Share(const Share&) = delete;
  Share& operator=(const Share&) = delete;

  /// \retval false  \a why says why
  bool open(const ShareOptions& options, const std::string& name, std::string& why) {
    const std::string path = host_bus::hub_path(name, why);
    if (path.empty()) {
      return false;
    }
    std::string none;
    if (host_bus::connect_to_hub(path, none) != nullptr) {
      why = "hub:" + name + " is in use; choose another name by --name";
      return false;
    }
    unlink(path.c_str());
    if (!hub_.open(path, why)) {
      return false;
    }
    buses_.push_back(host_bus::connect_to_hub(path, why));
    if (options.has_pty) {
      buses_.push_back(host_bus::open_bus("slcan-pty", {}, why));
    }
    own_ = buses_.size();
    return std::all_of(buses_.begin(), buses_.end(), [](const auto& bus) { return bus != nullptr; }) &&
           (options.port == 0 || socketcand_.open(options.address, options.port, why)) &&
           (options.slcan_port == 0 || slcan_.open(options.address, options.slcan_port, why));
  }

  void print_ways(const ShareOptions& options, const std::string& name) const {
    const std::string server = options.port == 0 ? "" : fmt::format("{}:{}/can0", options.address, socketcand_.port());
    const std::string slcan = options.slcan_port == 0 ? "" : fmt::format("{}:{}", options.address, slcan_.port());
    const std::string pty = options.has_pty ? buses_.back()->note() : "";
    if (options.common.is_json) {
      nlohmann::json json = {{"hub", name}};
      json.update(server.empty() ? nlohmann::json::object() : nlohmann::json{{"socketcand", server}});
      json.update(slcan.empty() ? nlohmann::json::object() : nlohmann::json{{"slcan_tcp", slcan}});
      json.update(pty.empty() ? nlohmann::json::object() : nlohmann::json{{"slcan", pty.substr(pty.rfind(' ') + 1)}});
      print(json.dump() + '\n');
    } else {
      print("hub:" + name + (server.empty() ? "" : ", socketcand " + server + " (python-can, SavvyCAN)") +
            (slcan.empty() ? "" : ", slcan-tcp:" + slcan) + (pty.empty() ? "" : ", " + pty) + "; Ctrl-C ends it\n");
    }
    std::fflush(stdout);
  }

  void run(const Interruption& interruption) {
    while (!Interruption::happened()) {
      wait(interruption);
      hub_.process(clock_now(CLOCK_REALTIME));
      socketcand_.process(clock_now(CLOCK_REALTIME));
      exchange_slcan_clients();
      reopen();
      forward();
    }
  }

  std::uint64_t lost() const { return lost_ + adapter_->lost(); }

 private:
  void wait(const Interruption& interruption) {
    std::vector<pollfd> wanted = hub_.wanted();
    const std::vector<pollfd> clients = socketcand_.wanted();
    wanted.insert(wanted.end(), clients.begin(), clients.end());
    wanted.push_back(slcan_.wanted(buses_.size() - own_));
    wanted.push_back(adapter_->wanted());
    for (const auto& bus : buses_) {
      pollfd program = bus->wanted();
      if (waiting_) {  // the programs are not read meanwhile
        program.events = static_cast<short>(program.events & ~POLLIN);
      }
      wanted.push_back(program);
    }
    const timespec timeout{0, is_busy_ ? 1'000'000L : 200'000'000L};
    ppoll(wanted.data(), wanted.size(), &timeout, &interruption.while_waiting());
  }

  /// Removes slcan clients that have ended, and accepts new ones.
  void exchange_slcan_clients() {
    const auto first = buses_.begin() + static_cast<std::ptrdiff_t>(own_);
    const auto ended = std::stable_partition(first, buses_.end(), [](const auto& bus) { return bus->fault().empty(); });
    buses_.erase(ended, buses_.end());
    for (int fd = 0; (fd = slcan_.accept(buses_.size() - own_)) >= 0;) {
      buses_.push_back(host_bus::serve_slcan(fd, adapter_->bit_rate()));
    }
  }

  void reopen() {
    if (adapter_->wanted().fd >= 0) {
      return;
    }
    if (!is_lost_) {
      print_note(adapter_->fault() + "; waiting for it");
      is_lost_ = true;
    }
    const Micros now = clock_now(CLOCK_MONOTONIC);
    if (now - reopened_ >= reopen_interval) {
      reopened_ = now;
      if (adapter_->restore()) {
        print_note("the adapter is back");
        is_lost_ = false;
      }
    }
  }

  /// Frames for an adapter that takes no more wait here; meanwhile the programs are not read, so that they wait, too.
  void forward() {
    bool has_frames = false;
    for (unsigned n = 0; n < frames_in_turn; ++n) {
      const std::optional<Entry> entry = adapter_->receive();
      if (!entry) {
        break;
      }
      has_frames = true;
      to_programs(entry->frame, nullptr);
      if ((entry->frame.Identifier & CO_IF_FRM_ERROR) == 0) {
        socketcand_.send(*entry);
      }
    }
    for (const auto& bus : buses_) {
      for (unsigned n = 0; n < frames_in_turn && flush(); ++n) {
        const std::optional<Entry> entry = bus->receive();
        if (!entry) {
          break;
        }
        has_frames = true;
        waiting_ = entry->frame;
        to_programs(entry->frame, bus.get());
        socketcand_.send(*entry);
      }
    }
    for (unsigned n = 0; n < frames_in_turn && flush(); ++n) {
      waiting_ = socketcand_.receive();
      if (!waiting_) {
        break;
      }
      has_frames = true;
      to_programs(*waiting_, nullptr);
    }
    is_busy_ = !flush() || has_frames;  // poll() does not report frames that are already in the memory of a bus
  }

  /// \retval true  no frame waits for the adapter
  bool flush() {
    if (waiting_ && adapter_->wanted().fd < 0) {
      ++lost_;
      waiting_.reset();
    }
    if (waiting_ && adapter_->send(*waiting_)) {
      waiting_.reset();
    }
    return !waiting_;
  }

  void to_programs(const CO_IF_FRM& frame, const Bus* from) {
    for (const auto& bus : buses_) {
      if (bus.get() == from || bus->send(frame)) {
        continue;
      }
      hub_.process(clock_now(CLOCK_REALTIME));  // makes room in the connection to it
      lost_ += bus->send(frame) ? 0U : 1U;
    }
  }

  std::unique_ptr<Bus> adapter_;
  host_bus::HubServer hub_;
  host_bus::SocketcandServer socketcand_{"can0"};
  host_bus::Listener slcan_;
  std::vector<std::unique_ptr<Bus>> buses_;  ///< the hub, the pseudo-terminal, and then the slcan clients
  std::size_t own_ = 0;                      ///< of buses_: the first ones, which are no clients
  std::optional<CO_IF_FRM> waiting_;         ///< frame that the adapter has refused
  bool is_busy_ = false;
  bool is_lost_ = false;
  Micros reopened_ = 0;
  std::uint64_t lost_ = 0;
};

int run_share(const ShareOptions& options) {
  int status = ok;
  std::unique_ptr<Bus> adapter = open_bus(options.common, false, status);
  if (adapter == nullptr) {
    return status;
  }
  const Interruption interruption;
  const char* const usual = std::getenv("LEXICAN_BUS");
  const std::string bus = !options.common.bus.empty() ? options.common.bus : usual != nullptr ? usual : "";
  const std::string name = options.name.empty() ? hub_name_of(bus) : options.name;
  Share share(std::move(adapter));
  std::string why;
  if (!share.open(options, name, why)) {
    print_message(why);
    return usage;
  }
  share.print_ways(options, name);
  share.run(interruption);
  if (share.lost() != 0) {
    print_message(fmt::format("{} frames were lost", share.lost()));
  }
  return ok;
}

}  // namespace

Verb add_share(CommandLine& line) {
  const auto options = std::make_shared<ShareOptions>();
  Arguments arguments = line.add_command("share", "Hand one adapter to many programs");
  add_bus_options(arguments, options->common);
  arguments.add_option("--name", options->name, "Name of the hub; default: that of the adapter");
  arguments.add_option("--port", options->port, "TCP port of the socketcand server, 0: none; default: 29536");
  arguments.add_option("--slcan-port", options->slcan_port, "TCP port of the slcan server, 0: none; default: 29537");
  arguments.add_option("--address", options->address, "Address of both servers; default: 127.0.0.1");
  arguments.add_flag("--pty", options->has_pty, "Also a pseudo-terminal, as an slcan adapter for one program");
  arguments.end_help(
      "Examples:\n"
      "  lexican share -i slcan:/dev/ttyACM0@500k\n"
      "  lexican share -i can0 --name bench --port 0 --slcan-port 0 --pty");
  return {arguments, [options] { return finish(options->common, run_share(*options)); }};
}

}  // namespace lexican::program
