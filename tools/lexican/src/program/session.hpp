// SPDX-License-Identifier: Apache-2.0
/// \file session.hpp
/// An open bus with a node of the stack as SDO client of one device.
#pragma once

#include "client/sdo_client.hpp"
#include "host/bus_host.hpp"
#include "program/verb.hpp"

namespace lexican::program {

class Session {
 public:
  /// \a bus: as open_bus() has returned it.
  Session(std::unique_ptr<host_bus::Bus> bus, std::uint8_t server)
      : bus_(std::move(bus)),
        dictionary_(server),
        node_({server == 127 ? std::uint8_t{126} : std::uint8_t{127}, host_.master_can(), host_.master_timer(),
               dictionary_.table(),
               [this, server](bool is_received, const CO_IF_FRM& frame) {
                 const bool is_state = is_received && frame.Identifier == 0x700U + server && frame.DLC == 1;
                 is_stopped_ = is_state ? (frame.Data[0] & 0x7FU) == 0x04 : is_stopped_;
               },
               true}) {
    CONodeStart(&node_.stack());
  }
  /// Sends what is queued, such as an abort, for at most 100 ms.
  ~Session() { loop_.flush(100 * millisecond); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  SdoClient& sdo() { return sdo_; }
  Node& node() { return node_; }
  Loop& loop() { return loop_; }
  host_bus::Bus& bus() { return *bus_; }
  BusHost& host() { return host_; }
  /// Returns true if the last heartbeat of the server during the transfers has the state Stopped.
  bool is_stopped() const { return is_stopped_; }
  bool is_interrupted() const { return Interruption::happened(); }

 private:
  Interruption interruption_;
  std::unique_ptr<host_bus::Bus> bus_;
  BusHost host_{*bus_, interruption_};
  ClientDictionary dictionary_;
  bool is_stopped_ = false;
  Node node_;
  Loop loop_{host_, {&node_}};
  SdoClient sdo_{node_, loop_};
};

/// An object of a device.
struct ObjectReference {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
};

/// Finds an object by index and sub-index (6081, 0x6081, 1018:4, 1018h:04), by its name, or by a part of its name.
/// \retval false  \a why says why, with similar names
bool find_object(const std::string& word, const describe::Description& description, ObjectReference& found,
                 std::string& why);

/// Adds the positional arguments "node" and "object", and the options of a transfer.
struct TransferOptions {
  Common common;
  std::string node;
  std::string object;
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
  std::string name;  ///< "606Ch:00 velocity actual value"
};

/// Returns the name of a type: "u16".
std::string type_text(const ValueType& type);
/// Returns the value as text; empty if it has another length than --type.
std::string shown(const Target& target, const Bytes& data);
/// Returns "606Ch:00 velocity actual value = 1204 (i32)" and a line end.
std::string line_of(const Target& target, const Bytes& data);

/// Prints why a transfer has failed, and what to try.
/// \retval status of the program
int report_failure(Session& session, const Target& target, const Transfer& transfer);

/// Checks the arguments, and reads the descriptions. Prints the reason if that fails.
bool prepare(const TransferOptions& options, Target& target);

}  // namespace lexican::program
