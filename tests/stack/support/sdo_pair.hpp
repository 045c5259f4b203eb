// SPDX-License-Identifier: Apache-2.0
/// \file sdo_pair.hpp
/// SDO transfers between Lexican nodes on a virtual bus: devices with SDO clients, and a pair of a client and a server
/// that checks the invariants of every transfer, also with faults on the bus.
///
///     test::SdoPair pair({2000});
///     pair.line.bus.add_rule({co::VirtualBus::Fault::drop, {}, 7});
///     pair.run(test::Direction::upload, pair.object, 1000ms, 3000ms);  // correct data, or an abort code, within 3 s
///
/// Context: one thread.
#pragma once

#include "network.hpp"

#if USE_CSDO

#include <array>
#include <cstdint>
#include <functional>
#include <string>

namespace test {

using Bytes = std::vector<std::uint8_t>;

enum class Direction { upload, download };
inline constexpr Direction both_directions[] = {Direction::upload, Direction::download};

/// Returns pseudo-random bytes: neither constant nor periodic in 7, and different for each seed.
Bytes noise(std::uint32_t size, std::uint32_t seed);

class SdoDevice;

/// An SDO client of a device, with the buffer of its current or last request between guard bytes.
class DeviceClient {
 public:
  DeviceClient(SdoDevice& device, unsigned number) : device_(device), number_(number) {}

  CO_ERR upload(std::uint32_t key, std::uint32_t size, Milliseconds time_out);
  CO_ERR download(std::uint32_t key, const Bytes& data, Milliseconds time_out);
  bool is_over() const { return callbacks == 1; }
  Bytes data() const;  ///< returns COCSdoGetNum() bytes

  unsigned callbacks = 1;        ///< calls since the request
  std::uint32_t code = 0;        ///< argument of the callback
  std::uint32_t num = 0;         ///< COCSdoGetNum() in the callback
  std::uint64_t tick = 0;        ///< clock value in the callback
  std::function<void()> on_end;  ///< called in the callback

 private:
  static void note(CO_CSDO* csdo, std::uint16_t index, std::uint8_t sub, std::uint32_t code);
  void end(std::uint32_t key, std::uint32_t abort_code);
  CO_CSDO* open(std::uint32_t key, const Bytes& data);

  SdoDevice& device_;
  unsigned number_;
  std::uint32_t key_ = 0;
  Bytes memory_;  // guard, buffer, guard
  Bytes sent_;    // data of a download: must not change
};

struct SdoDeviceOptions {
  std::uint8_t node_id;
  std::array<std::uint32_t, 3> bytes = {16, 16, 16};  ///< of 2010h, 2011h, 2012h
  bool block = true;                                  ///< CO_NODE_SPEC.SdoBuf is not null
  std::uint16_t heartbeat_ms = 0;
  std::uint16_t tx_queue = 0;  ///< frames of the transmit queue in separate memory; 0: the queue in the node
};

/// A node with 1000h, 1001h, 1017h, 1018h, 1200h, 1201h and 1280h, 1281h, 1282h (rw, not valid; if configured), 2001h
/// UNSIGNED64 and 2010h, 2011h, 2012h DOMAIN (all rw). It is started.
class SdoDevice {
 public:
  SdoDevice(World& world, Line& line, const SdoDeviceOptions& options);
  ~SdoDevice();
  SdoDevice(const SdoDevice&) = delete;
  SdoDevice& operator=(const SdoDevice&) = delete;

  /// Connects a client to the first (0) or second (1) channel of node \a server.
  void connect(unsigned client, std::uint8_t server, unsigned channel = 0);
  /// Enable and disable the second channel, 1201h.
  void open_second_channel();
  void close_second_channel();
  /// Initialises and starts the node after CONodeStop().
  void power_up();

  Bytes read(std::uint32_t key) const;  ///< reads 2001h, 2010h, … as the application
  void fill(std::uint32_t key, const Bytes& data);
  void resize(std::uint32_t key, std::uint32_t bytes);

  CO_NODE* operator->() { return &device_.node; }
  CO_NODE* node() { return &device_.node; }
  World& world() { return world_; }
  /// Returns true if no timer is armed and no frame is queued.
  bool is_at_rest() const { return device_.due_at() == UINT64_MAX; }
  co::VirtualBus::Port& port() { return device_.port; }
  CO_NODE_COUNTERS counters() const { return device_.counters(); }

  std::vector<DeviceClient> device_clients;  ///< of the clients

 private:
  struct Connection {
    std::uint32_t request = 0x80000000;
    std::uint32_t response = 0x80000000;
    std::uint8_t server = 0;
  };
  Device& make_device(Line& line);
  void add_communication();
  void add_application();

  World& world_;
  SdoDeviceOptions options_;
  std::uint8_t error_register_ = 0;
  std::uint16_t heartbeat_;
  std::uint64_t value_ = 0;
  Connection second_server_;
  std::array<Connection, CO_CSDO_N> connections_;
  std::array<Bytes, 3> memory_;
  std::array<CO_OBJ_DOM, 3> domains_{};
  std::vector<CO_OBJ> table_;
  std::vector<CO_IF_FRM> queue_;
  CO_NODE_EXT ext_{};
  Device& device_;
};

/// Transfers of one client, and the objects of its server.
class Exchange {
 public:
  Exchange(SdoDevice& client, unsigned device_client, SdoDevice& server)
      : client_(client), number_(device_client), server_(server) {}

  /// Starts a transfer with other data than the previous one. \a time_out: of the client, for each answer.
  void start(Direction direction, std::uint32_t key, Milliseconds time_out);
  /// Returns the fault of a finished transfer; empty: both sides have the correct data, or an abort code.
  std::string wrong() const;
  DeviceClient& device_client() const { return client_.device_clients[number_]; }

 private:
  SdoDevice& client_;
  unsigned number_;
  SdoDevice& server_;
  std::uint32_t seed_ = 0;
  std::uint32_t key_ = 0;
  Bytes data_;
};

struct SdoPairOptions {
  std::uint32_t bytes = 16;        ///< size of the object
  bool block = true;               ///< the server has a buffer for block transfers
  std::uint16_t heartbeat_ms = 0;  ///< of both nodes
  std::uint16_t tx_queue = 0;      ///< of both nodes; 0: as configured
  std::uint32_t ticks_per_second = 1000;
  bool second_channel = false;  ///< uses 1201h instead of 1200h
};

/// A client, node 1, and a server, node 5. Client 0 runs the transfers.
class SdoPair {
 public:
  static constexpr std::uint8_t client_id = 1;
  static constexpr std::uint8_t server_id = 5;
  static constexpr std::uint32_t object = CO_DEV(0x2010, 0);        ///< of SdoPairOptions::bytes
  static constexpr std::uint32_t short_object = CO_DEV(0x2011, 0);  ///< 36 bytes: block transfer
  static constexpr std::uint32_t value = CO_DEV(0x2001, 0);         ///< 8 bytes: segmented transfer

  explicit SdoPair(const SdoPairOptions& options);

  void start(Direction direction, std::uint32_t key = object, Milliseconds time_out = Milliseconds{1000});
  /// Lets time pass until the transfer has ended, checks the state after it, and returns its code. A transfer longer
  /// than \a limit ends the test case; 0: no time may pass.
  std::uint32_t finish(Milliseconds limit);
  /// Calls start() and finish().
  std::uint32_t run(Direction direction, std::uint32_t key = object, Milliseconds time_out = Milliseconds{1000},
                    Milliseconds limit = Milliseconds{0});
  std::string wrong() const { return exchange_.wrong(); }
  /// Checks that the next transfers, in both directions, succeed.
  void check_next(Milliseconds limit = Milliseconds{0});
  /// Returns true if both nodes become idle within \a within.
  bool becomes_idle(Milliseconds within);
  /// Returns the number of frames of an undisturbed transfer.
  std::uint32_t count_frames(Direction direction, std::uint32_t key = object);

  DeviceClient& device_client() const { return exchange_.device_client(); }

  World world;
  Line& line;
  SdoDevice server;
  SdoDevice client;

 private:
  Exchange exchange_{client, 0, server};
  std::uint64_t began_ = 0;
};

}  // namespace test

#endif
