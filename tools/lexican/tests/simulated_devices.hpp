// SPDX-License-Identifier: Apache-2.0
/// \file simulated_devices.hpp
/// Simulated devices on a virtual bus with our own client, for tests.
#pragma once

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "client/sdo_client.hpp"
#include "simulate/simulation.hpp"
#include "virtual_network.hpp"

namespace lexican {

inline std::string bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline describe::Description description_of(const std::string& path) {
  std::string why;
  const std::optional<describe::Description> description = describe::read_description(path, why);
  REQUIRE_MESSAGE(description.has_value(), why);
  return *description;
}

/// A virtual bus as that of a simulation.
class VirtualGround : public simulate::Ground {
 public:
  explicit VirtualGround(VirtualNetwork& network) : network_(network) {}
  Can add_can() override { return network_.attach(); }
  Timer add_timer() override { return network_.add_timer(); }
  Micros now() override { return network_.now(); }

 private:
  VirtualNetwork& network_;
};

/// Finds an object by its index in four hexadecimal digits, and a sub-index after a colon.
inline bool find_by_index(const std::string& word, const describe::Description&, std::uint16_t& index,
                          std::uint8_t& sub_index, std::string& why) {
  index = static_cast<std::uint16_t>(std::stoul(word, nullptr, 16));
  sub_index = word.size() > 5 ? static_cast<std::uint8_t>(std::stoul(word.substr(5), nullptr, 16)) : std::uint8_t{0};
  why = "";
  return true;
}

/// A simulated device as node 5, and a client.
struct SimulatedBus {
  explicit SimulatedBus(const std::string& path, const std::string& storage = {})
      : device(description_of(path), bytes_of_file(path), {5, 0, storage, network.attach(), network.add_timer()}) {
    fault = device.start();
    if (fault.empty()) {
      network.run([this] { return device.node().process() ? Micros{0} : device.node().due_in(); });
      client.emplace(network, 5);
    }
  }

  /// Returns the value of an object in words, or its abort code.
  std::string read(std::uint16_t index, std::uint8_t sub_index = 0) {
    const Transfer transfer = client->sdo().upload(index, sub_index, {65536, 1000, {}});
    return transfer.done() ? device.description().show(index, sub_index, transfer.data) : transfer.outcome();
  }
  std::string write(std::uint16_t index, std::uint8_t sub_index, const Bytes& bytes) {
    return client->sdo().download(index, sub_index, bytes).outcome();
  }

  VirtualNetwork network;
  simulate::Device device;
  std::string fault;
  std::optional<DeviceClient> client;
};

/// Some simulated devices, a client of the first one, and all frames of the bus.
struct SimulatedDevices {
  SimulatedDevices(const std::string& path, std::uint8_t node, unsigned count, std::uint64_t seed = 1)
      : simulation(ground, setup_of(path, node, count, seed), find_by_index) {
    REQUIRE(simulation.start() == "");
    network.run([this] { return simulation.process(); });
    if (node <= 127) {
      client.emplace(network, node, [this](bool is_received, const CO_IF_FRM& frame) {
        if (is_received) {
          frames.push_back(frame);
        }
      });
    }
  }
  static simulate::SimulationSetup setup_of(const std::string& path, std::uint8_t node, unsigned count,
                                            std::uint64_t seed) {
    simulate::SimulationSetup setup;
    setup.description = description_of(path);
    setup.file = bytes_of_file(path);
    setup.node_id = node;
    setup.count = count;
    setup.seed = seed;
    return setup;
  }
  /// Executes commands, which must have no fault.
  void run(const std::string& line) {
    bool is_fault = false;
    const std::string answer = simulation.execute(line, is_fault);
    CHECK_MESSAGE(!is_fault, line << ": " << answer);
  }
  std::string fault_of(const std::string& line) {
    bool is_fault = false;
    const std::string answer = simulation.execute(line, is_fault);
    CHECK(is_fault);
    return answer;
  }
  /// Lets time pass, with SDO transfers all the time.
  void pass(Micros time) {
    const Micros end = network.now() + time;
    while (network.now() < end) {
      client->sdo().upload(0x1001, 0, {SdoClient::small, 20, {}});
      network.wait(millisecond);
    }
  }
  std::string read(std::uint16_t index, std::uint8_t sub_index = 0) {
    const Transfer transfer = client->sdo().upload(index, sub_index, {SdoClient::small, 100, {}});
    return transfer.done() ? simulation.device(0).description().show(index, sub_index, transfer.data)
                           : transfer.outcome();
  }
  /// Returns the data of the frames with an identifier, "4310 09; 0000 00".
  std::vector<Bytes> received(std::uint32_t id) const {
    std::vector<Bytes> data;
    for (const CO_IF_FRM& frame : frames) {
      if (frame.Identifier == id) {
        data.emplace_back(frame.Data, frame.Data + frame.DLC);
      }
    }
    return data;
  }

  VirtualNetwork network;
  VirtualGround ground{network};
  simulate::Simulation simulation;
  std::vector<CO_IF_FRM> frames;
  std::optional<DeviceClient> client;
};

}  // namespace lexican
