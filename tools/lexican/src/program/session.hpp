// SPDX-License-Identifier: Apache-2.0
/// \file session.hpp
/// An open bus with a node of the stack as SDO client of one device.
#pragma once

#include <unistd.h>

#include <cstdio>

#include "bus/clock.hpp"
#include "client/sdo_client.hpp"
#include "describe/configuration.hpp"
#include "host/bus_host.hpp"
#include "program/verb.hpp"

namespace lexican::program {

class Session {
 public:
  /// \a bus: as open_bus() has returned it. \a observer: called for each frame during the transfers.
  Session(std::unique_ptr<host_bus::Bus> bus, std::uint8_t server, Node::Observer observer = {})
      : own_(std::make_unique<Own>(std::move(bus))),
        bus_(*own_->bus),
        host_(own_->host),
        client_(host_, server, [this, server, observer](bool is_received, const CO_IF_FRM& frame) {
          follow(is_received, frame, server);
          if (observer) {
            observer(is_received, frame);
          }
        }) {}
  /// Uses an open bus. \a host: that of \a bus; both must outlive the session.
  Session(host_bus::Bus& bus, BusHost& host, std::uint8_t server)
      : bus_(bus), host_(host), client_(host_, server, [this, server](bool is_received, const CO_IF_FRM& frame) {
          follow(is_received, frame, server);
        }) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  SdoClient& sdo() { return client_.sdo(); }
  host_bus::Bus& bus() { return bus_; }
  BusHost& host() { return host_; }
  /// Returns the NMT state of the last heartbeat of the server during the transfers; nothing: none was received.
  std::optional<std::uint8_t> state() const { return state_; }
  /// Returns the name of what the server has sent during the transfers, by the predefined identifiers; null: nothing.
  const char* messages() const { return state_ ? "heartbeats" : messages_; }
  /// Returns true if the user has interrupted the program, or has cancelled the command.
  bool is_interrupted() const { return Interruption::happened() || host_.is_cancelled(); }

 private:
  struct Own {
    explicit Own(std::unique_ptr<host_bus::Bus> opened) : bus(std::move(opened)) {}
    Interruption interruption;
    std::unique_ptr<host_bus::Bus> bus;
    BusHost host{*bus, interruption};
  };

  void follow(bool is_received, const CO_IF_FRM& frame, std::uint8_t server) {
    if (!is_received || (frame.Identifier & 0x7FU) != server) {
      return;
    }
    switch (frame.Identifier - server) {
      case 0x700:
        if (frame.DLC == 1) {
          state_ = frame.Data[0] & 0x7FU;
        }
        break;
      case 0x080: messages_ = "EMCY messages"; break;
      case 0x180:
      case 0x280:
      case 0x380:
      case 0x480: messages_ = "PDOs"; break;
      default: break;
    }
  }

  std::unique_ptr<Own> own_;  ///< null: the bus is that of the caller
  host_bus::Bus& bus_;
  BusHost& host_;
  std::optional<std::uint8_t> state_;
  const char* messages_ = nullptr;
  DeviceClient client_;
};

/// Shows on a terminal how many of many entries are done, ten times a second if they take longer than half a second.
/// The line is removed at the end.
class EntryCount {
 public:
  explicit EntryCount(std::size_t total) : total_(total), is_terminal_(isatty(STDERR_FILENO) != 0) {}
  ~EntryCount() {
    if (is_shown_) {
      std::fputs("\r\033[K", stderr);
    }
  }
  EntryCount(const EntryCount&) = delete;
  EntryCount& operator=(const EntryCount&) = delete;

  void next() {
    ++done_;
    const Micros now = host_bus::clock_now(CLOCK_MONOTONIC);
    if (is_terminal_ && now >= due_) {
      std::fprintf(stderr, "\r%zu of %zu entries\033[K", done_, total_);
      due_ = now + 100 * millisecond;
      is_shown_ = true;
    }
  }

 private:
  std::size_t total_;
  std::size_t done_ = 0;
  bool is_terminal_;
  bool is_shown_ = false;
  Micros due_ = host_bus::clock_now(CLOCK_MONOTONIC) + 500 * millisecond;
};

/// An object of a device.
struct ObjectReference {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
};

/// Finds an object by index and sub-index (6081, 0x6081, 1018:4, 1018h:04, 1018sub4), by its name, or by a part of its
/// name. \retval false  \a why says why, with similar names
bool find_object(const std::string& word, const describe::Description& description, ObjectReference& found,
                 std::string& why);

/// Returns the limits that a description has, "0 to 100", if an integer is beyond them; empty: it is not.
std::string exceeded_limits(const codict::Entry& entry, std::uint8_t node, const codict::Integer& value);

/// Returns whether an integer is beyond the limits that a description has: the message; empty: it is not.
std::string beyond_limits(const describe::Description& description, std::uint8_t node, const describe::EntryKey& key,
                          const std::string& value);

/// Adds the positional arguments "node" and "object", and the options of a transfer.
struct TransferOptions {
  Common common;
  std::optional<std::string> node;
  std::optional<std::string> object;
  std::string type;
};
void add_transfer_options(Arguments& arguments, TransferOptions& options);

/// A transfer that can begin.
struct Target {
  std::uint8_t node = 0;
  ObjectReference object;
  std::optional<ValueType> type;  ///< of --type, else of the description or of CiA 301
  bool is_type_given = false;     ///< by --type
  describe::Network network;
  std::string name;       ///< "606Ch:00 velocity actual value"
  bool is_found = false;  ///< false: the object is looked up when the device has been identified, see find_in_device()
};

/// Returns the name of a type: "u16".
std::string type_text(const ValueType& type);
/// Returns the value as text; empty if it has another length than --type.
std::string shown(const Target& target, const Bytes& data);
/// Returns "606Ch:00 velocity actual value = 1204 (i32)" and a line end.
std::string line_of(const Target& target, const Bytes& data);

/// Returns the message for a device that is there, although it does not answer SDO requests. \a messages: what it sends
std::string hung_server_text(std::uint8_t node, const char* messages);
/// Prints why a transfer has failed, and what to try.
/// \retval status of the program
int report_failure(Session& session, const Target& target, const Transfer& transfer);

/// Checks the arguments, and reads the descriptions. Prints the reason if that fails.
bool prepare(const TransferOptions& options, Target& target);
/// Identifies the device if prepare() has not found the object, and looks it up in the description of the user's
/// library, or in the one that the device stores. Prints the reason if that fails.
/// \retval status of the program
int find_in_device(Session& session, const TransferOptions& options, Target& target);

}  // namespace lexican::program
