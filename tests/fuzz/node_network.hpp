// SPDX-License-Identifier: Apache-2.0
/// \file node_network.hpp
/// PDOs, SRDOs, GFC, SYNC, TIME, EMCY, error control and NMT of the node under test: their object dictionary entries,
/// and the actions of an application and an NMT master.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "co_core.h"
#include "fuzz/fuzz.hpp"

namespace fuzz {

inline constexpr unsigned network_pdos = 4;  ///< in each direction

struct PdoObjects {
  std::uint32_t cob_id;
  std::uint8_t type;
  std::uint16_t inhibit;
  std::uint16_t event;
  std::uint8_t start;
  std::uint8_t number;
  std::uint32_t map[8];
};

struct SrdoObjects {
  std::uint8_t direction;
  std::uint16_t cycle;
  std::uint8_t validation;
  std::uint8_t type;
  std::uint32_t id[2];
  std::uint8_t number;
  std::uint32_t map[4];
  std::uint16_t signature;
};

struct NetworkObjects {
  std::uint8_t history_number = 0;
  std::uint32_t history[3] = {};
  std::uint32_t sync_id = 0x80;
  std::uint32_t sync_cycle = 0;   // µs
  std::uint32_t sync_window = 0;  // µs
  std::uint8_t sync_counter = 0;
  std::uint16_t guard_time = 0;
  std::uint8_t life_time_factor = 0;
  std::uint32_t time_id = CO_TIME_COBID_CONSUME | 0x100;
  std::uint32_t time_stamp = 0;
  std::uint32_t emcy_id = 0x80;
  std::uint16_t emcy_inhibit = 0;
  std::uint32_t emcy_consumers[2] = {0x81, 0x89};
  CO_HBCONS heartbeat_consumers[2] = {};
  std::uint8_t error_behaviour = 0;
  std::uint32_t startup = CO_NMT_STARTUP_STAY;
  // All PDOs are disabled until a frame enables them.
  PdoObjects rpdo[network_pdos] = {
      {0x80000205, 255, 0, 0, 0, 2, {0x20000008, 0x20000110}},
      {0x80000305, 1, 0, 0, 0, 3, {0x20000320, 0x00050008, 0x20000B08}},
      {0x80000405, 255, 0, 20, 0, 1, {0x22000020}},
      {0x80000500, 255, 0, 0, 0, 0, {}},
  };
  PdoObjects tpdo[network_pdos] = {
      {0x80000185, 255, 0, 0, 0, 2, {0x20000008, 0x20000110}},
      {0x80000285, 1, 0, 0, 0, 2, {0x20000320, 0x20000820}},
      {0x80000385, 254, 100, 30, 0, 1, {0x22000020}},
      {0x80000480, 252, 0, 0, 0, 0, {}},
  };
  SrdoObjects srdo[2] = {
      {CO_SRDO_RX, 50, 20, 254, {0x109, 0x10A}, 4, {0x23100108, 0x23110108, 0x23100308, 0x23110308}, 0},
      {CO_SRDO_TX, 25, 20, 254, {0x10B, 0x10C}, 4, {0x23100208, 0x23110208, 0x23100308, 0x23110308}, 0},
  };
  std::uint8_t srdo_valid = CO_SRDO_CONFIGURATION_VALID;
  std::uint8_t plain[2] = {1, 2};
  std::uint8_t inverse[2] = {0xFE, 0xFD};
  std::uint8_t gfc = 1;
};

void add_network(std::vector<CO_OBJ>& table, NetworkObjects& objects);

/// Error table of the application.
inline constexpr std::uint16_t network_errors = 11;
CO_EMCY_TBL* errors();

class Network {
 public:
  Network(CO_NODE& node, NetworkObjects& objects, Input& input) : node_(node), objects_(objects), input_(input) {}

  /// Executes an action of the application, selected by bits 0…4 of \a kind.
  void act(std::uint8_t kind);

  /// Changes the multiplexer of an SDO request to one of these services' entries.
  static void name_object(CO_IF_FRM& frame);
  /// Returns the length that the service with this identifier requires, as random lengths would rarely match.
  std::uint8_t usual_length(std::uint32_t identifier) const;
  /// Returns the objects that a frame of an RPDO or SYNC may write.
  std::vector<std::uint32_t> written_by_pdos() const;
  bool may_be_pdo(const CO_IF_FRM& frame) const;

  /// Records the identifiers with which the services send now: a queued frame may have an earlier one.
  void look();
  /// Returns the rule that a sent frame violates, or "". Only for frames of these services: is_ours().
  std::string fault_of(const CO_IF_FRM& frame) const;
  bool is_ours(const CO_IF_FRM& frame) const { return frame.Identifier == 0 || identifiers_.count(frame.Identifier); }

  void use_srdo();
  void send_gfc();
  /// Makes the configuration of the SRDOs valid; it takes effect when the node enters Operational.
  void sign();

  void forget() { objects_.startup = CO_NMT_STARTUP_STAY; }

 private:
  void configure();
  void map_pdo();
  void configure_pdo();
  void request_pdo();
  void trigger_pdo();
  void trigger_object();
  void write_object();
  void ask_pdos();
  void set_error();
  void clear_error();
  void ask_errors();
  void reset_errors();
  void reset_history();
  void command();
  void ask_heartbeats();
  void activate_heartbeat();
  void set_time();
  void send_time();
  void use_leds();

  static bool is_srdo(std::uint32_t identifier);
  bool is_tpdo(std::uint32_t identifier) const;
  std::uint32_t emcy_identifier() const;
  std::uint32_t any_value(unsigned size);
  std::uint32_t any_cob_id();
  std::uint32_t any_mapping();
  CO_OBJ* any_object();
  void write(std::uint16_t index, std::uint8_t sub, unsigned size, std::uint32_t value);

  CO_NODE& node_;
  NetworkObjects& objects_;
  Input& input_;
  std::set<std::uint32_t> identifiers_;
};

}  // namespace fuzz
