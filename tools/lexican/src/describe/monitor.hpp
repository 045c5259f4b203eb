// SPDX-License-Identifier: Apache-2.0
/// \file monitor.hpp
/// Puts the frames of a bus into words: an event for each message, and one for each SDO transfer. The uploads of 1000h
/// without an answer by which a program looks for devices are one event. The memory in use does not depend on the
/// number of frames.
#pragma once

#include <array>
#include <bitset>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "describe/library.hpp"
#include "describe/sdo_transfer.hpp"
#include "model/pdo.hpp"
#include "trace/decode.hpp"

namespace lexican::describe {

enum class Service : std::uint8_t { nmt, state, emcy, sync, time, pdo, sdo, lss, safety, error, other };

/// Names of the services, in the order of Service.
inline constexpr const char* service_names[] = {"nmt", "state", "emcy",   "sync",  "time", "pdo",
                                                "sdo", "lss",   "safety", "error", "other"};

struct Event {
  Micros time = 0;  ///< of the frame that is shown, or with which a transfer ended
  Service service = Service::other;
  std::uint8_t node = 0;  ///< node-ID, of NMT that of the addressed node; 0: none, or all
  std::string text;
  bool is_fault = false;     ///< EMCY, an SDO transfer that failed, a bus error
  bool is_repeated = false;  ///< a heartbeat without a change, a further SYNC, the same bus error within a second
  const SdoTransfer* sdo = nullptr;
};

/// An object in a PDO.
struct PdoValue {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::string name;  ///< index and sub-index if it has none
  std::string text;  ///< with unit and name of the value
  std::optional<double> number;
  std::string unit;  ///< of the number; empty: it has none
};

/// The values of a PDO that a frame transfers; without those of objects that a frame is too short for, and of dummies.
struct PdoContent {
  std::uint8_t node = 0;
  bool is_transmit = false;
  std::uint16_t number = 0;
  std::vector<PdoValue> values;
};

/// A PDO by its parameters: those that were seen on the bus, else those of the description.
struct KnownPdo {
  static constexpr std::uint32_t not_valid = 0x80000000;

  /// Returns true if all mapped objects are known; \a bits is their length.
  bool is_mapping_known(unsigned& bits) const;
  bool is_synchronous() const { return type <= 240; }

  std::uint8_t node = 0;
  bool is_transmit = false;
  std::uint16_t number = 0;
  std::uint32_t cob_id = not_valid;    ///< with bit 29 for 29-bit identifiers
  std::uint8_t type = 255;             ///< transmission type
  std::uint32_t inhibit_time = 0;      ///< µs
  std::uint32_t event_time = 0;        ///< µs
  std::vector<std::uint32_t> entries;  ///< of the mapping parameter, sub-indices 1 …
  std::uint8_t count = 0;              ///< sub-index 0
  bool is_observed = false;            ///< a parameter was seen on the bus
  bool is_configured = false;          ///< a parameter was written
};

/// Numbers of the frames so far.
struct Statistics {
  static constexpr std::size_t most_identifiers = 4096;  ///< frames with further ones are counted in `others`

  Micros first = 0;  ///< time of the first frame
  Micros last = 0;
  std::uint64_t frames = 0;  ///< without error frames
  std::uint64_t bits = 0;    ///< of the frames on the wire, with stuff bits and intermissions
  std::uint64_t errors = 0;  ///< error frames
  std::map<std::uint32_t, std::uint64_t> by_identifier;  ///< with CO_IF_FRM_EXT and CO_IF_FRM_RTR
  std::uint64_t others = 0;                              ///< frames with an identifier that is not among them

  /// Returns the load of the bus in per cent; 0 without bit rate or duration.
  double load(std::uint32_t bit_rate) const;
};

/// Context: one thread.
class Monitor {
 public:
  using Show = std::function<void(const Event&)>;

  /// Called when a master has read who a device is (1018h), at most four times for a node.
  /// \retval true  the network has a new description of the node
  using Identified = std::function<bool(std::uint8_t node, const Identity& identity)>;

  /// \a network must outlive the monitor. \a show is called for each event.
  Monitor(const Network& network, Show show, Identified identified = {});

  /// Processes the next frame of the bus.
  void process(const host_bus::Entry& entry);
  /// Reports transfers without an answer. \a now: time of the bus.
  void expire(Micros now);
  /// Reports open transfers at the end of the log.
  void finish();

  const Statistics& statistics() const { return statistics_; }
  /// Returns the values of a frame. \a node: whose PDO it has to be; 0: the TPDO with this COB-ID, else the first RPDO.
  /// \retval nothing  no mapping of such a PDO is known, or the frame is a remote one
  std::optional<PdoContent> values_of(const CO_IF_FRM& frame, std::uint8_t node = 0) const;
  /// Calls a function for each PDO whose COB-ID is the identifier of \a frame, TPDOs first.
  void for_each_pdo(const CO_IF_FRM& frame, const std::function<void(const KnownPdo&)>& call) const;
  void for_each_pdo(const std::function<void(const KnownPdo&)>& call) const;

 private:
  /// Entries of the identity object of a node, as they were read.
  struct Seen {
    std::array<std::optional<std::uint32_t>, 3> parts{};  ///< vendor-ID, product code, revision number
    unsigned reports = 0;
  };

  /// A mapped object in the data of a frame.
  struct Mapped {
    std::uint16_t index = 0;
    std::uint8_t sub_index = 0;
    Bytes bytes;

    bool is_dummy() const { return index < 0x20; }
  };
  /// The data of a frame by the mapping of its PDO.
  struct Content {
    std::vector<Mapped> objects;
    std::optional<Mapped> missing;  ///< the first object that does not fit the frame
    bool is_mapping_known = false;
    unsigned bits = 0;  ///< of the objects
  };

  using Pdo = KnownPdo;
  using PdoKey = std::uint32_t;  ///< of TPDOs lower than of RPDOs

  /// Last messages of error control of a node.
  struct ErrorControl {
    std::uint16_t state = 0;           ///< known_state with the state; 0: unknown
    bool is_guarding_request = false;  ///< the last message was a remote frame
  };

  /// Uploads of 1000h from different nodes, each within SdoFollower::answer_time after the one before.
  struct Scan {
    std::bitset<128> nodes;
    unsigned answered = 0;
    Micros last = 0;  ///< request
  };

  void count(const host_bus::Entry& entry);
  void message(Event& event, const CO_IF_FRM& frame);
  const Pdo* pdo_of(const CO_IF_FRM& frame, std::uint8_t node = 0) const;
  static Content content_of(const Pdo& pdo, const CO_IF_FRM& frame);
  bool sdo(const host_bus::Entry& entry);
  void report(std::uint8_t node, const SdoTransfer& transfer, Micros time);
  void note_scan(std::uint8_t node, Micros time);
  void finish_scan(Micros time);
  bool is_scanned(std::uint8_t node, const SdoTransfer& transfer);
  static Bytes value_in(const Description& description, const SdoTransfer& transfer);
  void learn(std::uint8_t node, const SdoTransfer& transfer);
  void learn_identity(std::uint8_t node, const SdoTransfer& transfer);
  void describe_pdos(std::uint8_t node, const std::vector<codict::Pdo>& all);
  void set_cob_id(PdoKey key, Pdo& pdo, std::uint32_t cob_id);
  std::string show_pdo(const Pdo& pdo, const CO_IF_FRM& frame) const;
  void state(Event& event, const CO_IF_FRM& frame);
  void error(Event& event, const CO_IF_FRM& frame);

  const Network& network_;
  Show show_;
  Identified identified_;
  std::array<Seen, 128> seen_{};
  Statistics statistics_;
  trace::Decoder decoder_;
  std::array<SdoFollower, 128> servers_{};
  unsigned open_servers_ = 0;  ///< with a transfer that has not ended
  Scan scan_;
  std::bitset<128> scanned_;  ///< nodes whose last upload of 1000h was one of many
  std::array<ErrorControl, 128> error_control_{};
  std::map<PdoKey, Pdo> pdos_;
  std::set<std::pair<std::uint32_t, PdoKey>> by_cob_id_;  ///< valid COB-IDs, which several PDOs can share
  bool is_synchronised_ = false;                          ///< a SYNC was seen
  std::string last_error_;                                ///< without the counters
  Micros last_error_time_ = 0;
};

}  // namespace lexican::describe
