// SPDX-License-Identifier: Apache-2.0
#include "fuzz/node_network.hpp"

#include <algorithm>
#include <iterator>

namespace fuzz {
namespace {

template <class T>
CO_OBJ row(std::uint32_t index, std::uint32_t sub, std::uint32_t flags, const CO_OBJ_TYPE* type, T* data) {
  return {CO_KEY(index, sub, flags), type, CO_DATA(data)};
}

void add_pdo(std::vector<CO_OBJ>& table, std::uint32_t n, std::uint32_t communication, PdoObjects& pdo, bool is_tpdo) {
  const std::uint32_t at = communication + n;
  const std::uint32_t mapping = at + 0x200;
  const std::uint32_t id_flags = n == 3 ? CO_OBJ__N__RW : CO_OBJ_____RW;
  table.push_back(row(at, 1, id_flags, CO_TPDO_ID, &pdo.cob_id));
  table.push_back(row(at, 2, CO_OBJ_____RW, CO_TPDO_TYPE, &pdo.type));
  table.push_back(row(at, 3, CO_OBJ_____RW, CO_TPDO_INHIBIT, &pdo.inhibit));
  table.push_back(row(at, 5, CO_OBJ_____RW, CO_TPDO_EVENT, &pdo.event));
  if (is_tpdo) {
    table.push_back(row(at, 6, CO_OBJ_____RW, CO_TPDO_START, &pdo.start));
  }
  table.push_back(row(mapping, 0, CO_OBJ_____RW, CO_TPDO_NUM, &pdo.number));
  for (std::uint32_t sub = 1; sub <= 8; ++sub) {
    table.push_back(row(mapping, sub, CO_OBJ_____RW, CO_TPDO_MAP, &pdo.map[sub - 1]));
  }
}

void add_srdo(std::vector<CO_OBJ>& table, std::uint32_t n, SrdoObjects& srdo) {
  const auto add = [&](std::uint32_t sub, const void* data) {
    table.push_back(row(0x1301 + n, sub, CO_OBJ_____RW, CO_TSRDO_COM, data));
  };
  add(1, &srdo.direction);
  add(2, &srdo.cycle);
  add(3, &srdo.validation);
  add(4, &srdo.type);
  add(5, &srdo.id[0]);
  add(6, &srdo.id[1]);
  table.push_back(row(0x1381 + n, 0, CO_OBJ_____RW, CO_TSRDO_MAP, &srdo.number));
  for (std::uint32_t sub = 1; sub <= 4; ++sub) {
    table.push_back(row(0x1381 + n, sub, CO_OBJ_____RW, CO_TSRDO_MAP, &srdo.map[sub - 1]));
  }
  table.push_back(row(0x13FF, n + 1, CO_OBJ_____RW, CO_TSRDO_SIGNATURE, &srdo.signature));
}

CO_EMCY_TBL all_errors[network_errors] = {
    {CO_EMCY_REG_GENERAL, CO_EMCY_CODE_GEN_ERR},
    {CO_EMCY_REG_CURRENT, CO_EMCY_CODE_CUR_ERR},
    {CO_EMCY_REG_CURRENT, CO_EMCY_CODE_CUR_OUTPUT_ERR},
    {CO_EMCY_REG_VOLTAGE, CO_EMCY_CODE_VOL_ERR},
    {CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_ERR},
    {CO_EMCY_REG_COM, CO_EMCY_CODE_MON_ERR},
    {CO_EMCY_REG_COM, CO_EMCY_CODE_MON_COM_HEARTBEAT_ERR},
    {CO_EMCY_REG_PROFILE, CO_EMCY_CODE_DEV_ERR},
    {CO_EMCY_REG_MANUFACTURER, CO_EMCY_CODE_SW_ERR},
    {CO_EMCY_REG_NUM, CO_EMCY_CODE_HW_ERR},
    {0xFF, CO_EMCY_CODE_EXT_ERR},
};

struct Entry {
  std::uint16_t index;
  std::uint8_t sub;
  std::uint8_t size;
};

constexpr Entry settings[] = {
    {0x1003, 0, 1}, {0x1005, 0, 4}, {0x1006, 0, 4}, {0x1007, 0, 4}, {0x100C, 0, 2},
    {0x100D, 0, 1}, {0x1012, 0, 4}, {0x1014, 0, 4}, {0x1015, 0, 2}, {0x1017, 0, 2},
    {0x1019, 0, 1}, {0x1028, 1, 4}, {0x1028, 8, 4}, {0x1029, 1, 1}, {0x1F80, 0, 4},
};

constexpr Entry pdo_settings[] = {{0, 1, 4}, {0, 2, 1}, {0, 3, 2}, {0, 5, 2}, {0, 6, 1}};

constexpr std::uint32_t mappings[] = {
    0x20000008, 0x20000110, 0x20000218, 0x20000320, 0x20000428, 0x20000538, 0x20000640, 0x20000718,
    0x20000820, 0x20000940, 0x20000A30, 0x20000B08, 0x20000D20, 0x21000040, 0x22000020, 0x22000308,
    0x22000640, 0x23000030, 0x00010001, 0x00050008, 0x00060010, 0x00070020, 0x20000C08, 0x10130020,
};

}  // namespace

CO_EMCY_TBL* errors() { return all_errors; }

void add_network(std::vector<CO_OBJ>& table, NetworkObjects& o) {
  table.insert(table.end(), {
                                row(0x1003, 0, CO_OBJ_____RW, CO_TEMCY_HIST, &o.history_number),
                                row(0x1003, 1, CO_OBJ_____R_, CO_TEMCY_HIST, &o.history[0]),
                                row(0x1003, 2, CO_OBJ_____R_, CO_TEMCY_HIST, &o.history[1]),
                                row(0x1003, 3, CO_OBJ_____R_, CO_TEMCY_HIST, &o.history[2]),
                                row(0x1005, 0, CO_OBJ_____RW, CO_TSYNC_ID, &o.sync_id),
                                row(0x1006, 0, CO_OBJ_____RW, CO_TSYNC_CYCLE, &o.sync_cycle),
                                row(0x1007, 0, CO_OBJ_____RW, CO_TSYNC_WINDOW, &o.sync_window),
                                row(0x100C, 0, CO_OBJ_____RW, CO_TUNSIGNED16, &o.guard_time),
                                row(0x100D, 0, CO_OBJ_____RW, CO_TUNSIGNED8, &o.life_time_factor),
                                row(0x1012, 0, CO_OBJ_____RW, CO_TTIME_ID, &o.time_id),
                                row(0x1013, 0, CO_OBJ____PRW, CO_TTIME_HIGH_RES, &o.time_stamp),
                                row(0x1014, 0, CO_OBJ__N__RW, CO_TEMCY_ID, &o.emcy_id),
                                row(0x1015, 0, CO_OBJ_____RW, CO_TUNSIGNED16, &o.emcy_inhibit),
                                row(0x1016, 1, CO_OBJ_____RW, CO_THB_CONS, &o.heartbeat_consumers[0]),
                                row(0x1016, 2, CO_OBJ_____RW, CO_THB_CONS, &o.heartbeat_consumers[1]),
                                row(0x1019, 0, CO_OBJ_____RW, CO_TSYNC_COUNT, &o.sync_counter),
                                row(0x1028, 1, CO_OBJ_____RW, CO_TEMCY_CONS, &o.emcy_consumers[0]),
                                row(0x1028, 8, CO_OBJ_____RW, CO_TEMCY_CONS, &o.emcy_consumers[1]),
                                row(0x1029, 1, CO_OBJ_____RW, CO_TERROR_BEHAVIOUR, &o.error_behaviour),
                                row(0x1F80, 0, CO_OBJ_____RW, CO_TNMT_STARTUP, &o.startup),
                                row(0x1300, 0, CO_OBJ_____RW, CO_TGFC, &o.gfc),
                                row(0x13FE, 0, CO_OBJ_____RW, CO_TSRDO_VALID, &o.srdo_valid),
                                {CO_KEY(0x2300, 0, CO_OBJ____PRW), CO_TTIME_CLOCK, 0},
                            });
  o.heartbeat_consumers[0].NodeId = 9;
  o.heartbeat_consumers[0].Time = 50;
  for (std::uint32_t n = 0; n < std::size(o.srdo); ++n) {
    add_srdo(table, n, o.srdo[n]);
    table.push_back(row(0x2310, n + 1, CO_OBJ____PRW, CO_TUNSIGNED8, &o.plain[n]));
    table.push_back(row(0x2311, n + 1, CO_OBJ____PRW, CO_TUNSIGNED8, &o.inverse[n]));
  }
  for (unsigned n = 0; n < network_pdos; ++n) {
    add_pdo(table, n, 0x1400, o.rpdo[n], false);
    add_pdo(table, n, 0x1800, o.tpdo[n], true);
  }
}

void Network::act(std::uint8_t kind) {
  using Action = void (Network::*)();
  constexpr Action actions[] = {
      &Network::configure,     &Network::map_pdo,        &Network::configure_pdo,      &Network::request_pdo,
      &Network::trigger_pdo,   &Network::trigger_object, &Network::write_object,       &Network::ask_pdos,
      &Network::set_error,     &Network::clear_error,    &Network::ask_errors,         &Network::reset_errors,
      &Network::reset_history, &Network::command,        &Network::ask_heartbeats,     &Network::activate_heartbeat,
      &Network::set_time,      &Network::send_time,      &Network::use_leds,           &Network::configure,
      &Network::map_pdo,       &Network::configure_pdo,  &Network::activate_heartbeat, &Network::write_object,
      &Network::use_srdo,      &Network::send_gfc,       &Network::configure_pdo,      &Network::request_pdo,
      &Network::trigger_pdo,   &Network::trigger_object, &Network::write_object,       &Network::ask_pdos,
  };
  (this->*actions[kind & 31U])();
  look();
}

// Frames -----------------------------------------------------------------

void Network::name_object(CO_IF_FRM& frame) {
  constexpr std::uint16_t indices[] = {0x1003, 0x1005, 0x1006, 0x1007, 0x100C, 0x100D, 0x1012, 0x1014,
                                       0x1015, 0x1016, 0x1019, 0x1028, 0x1029, 0x1400, 0x1401, 0x1402,
                                       0x1403, 0x1600, 0x1601, 0x1602, 0x1603, 0x1800, 0x1801, 0x1802,
                                       0x1803, 0x1A00, 0x1A01, 0x1A02, 0x1A03, 0x1F80, 0x2300};
  constexpr std::uint16_t srdo_indices[] = {0x1300, 0x1301, 0x1302, 0x1381, 0x1382, 0x13FE, 0x13FF, 0x2310};
  constexpr unsigned first_srdo = 256 - std::size(srdo_indices);
  const std::uint8_t what = frame.Data[1];
  CO_SET_WORD(&frame, what < first_srdo ? indices[what % std::size(indices)] : srdo_indices[what - first_srdo], 1);
  frame.Data[3] &= 15U;
}

bool Network::is_srdo(std::uint32_t identifier) { return identifier > 0x100 && identifier <= 0x180; }

std::uint8_t Network::usual_length(std::uint32_t identifier) const {
  if (identifier == 0 || is_srdo(identifier)) {
    return 2;
  }
  if (identifier == 0x001) {  // GFC
    return 0;
  }
  if (identifier == 0x80) {
    return objects_.sync_counter == 0 ? 0 : 1;
  }
  const bool is_error_control = (identifier & CO_IF_FRM_ID) > 0x700;
  return is_error_control ? 1 : identifier == 0x100 ? 6 : 8;
}

std::vector<std::uint32_t> Network::written_by_pdos() const {
  std::vector<std::uint32_t> devs;
  for (const PdoObjects& pdo : objects_.rpdo) {
    for (const std::uint32_t word : pdo.map) {
      devs.push_back(word & 0xFFFFFF00U);
    }
  }
  for (const SrdoObjects& srdo : objects_.srdo) {
    for (const std::uint32_t word : srdo.map) {
      devs.push_back(word & 0xFFFFFF00U);
    }
  }
  return devs;
}

bool Network::may_be_pdo(const CO_IF_FRM& frame) const {
  const auto is_request = [&](const CO_SDO& server) { return server.RxId == frame.Identifier; };
  const auto is_rpdo = [&](const PdoObjects& pdo) {
    return ((pdo.cob_id ^ frame.Identifier) & 0x7FFU) == 0 || &pdo == &objects_.rpdo[3];
  };
  return std::none_of(std::begin(node_.Sdo), std::end(node_.Sdo), is_request) ||
         std::any_of(std::begin(objects_.rpdo), std::end(objects_.rpdo), is_rpdo) ||
         node_.Sync.Identifier == frame.Identifier || is_srdo(frame.Identifier);
}

void Network::look() {
  if (node_.Nmt.Mode == CO_INVALID) {
    return;
  }
  for (const CO_TPDO& pdo : node_.TPdo) {
    identifiers_.insert(pdo.Identifier);
  }
  identifiers_.insert({node_.Sync.Identifier, node_.Time.Identifier});
  if (emcy_identifier() != 0x80U + node_.NodeId) {
    identifiers_.insert(emcy_identifier());
  }
}

// Returns the COB-ID of the EMCY producer: the object's value plus the node-ID (flag N).
std::uint32_t Network::emcy_identifier() const {
  const bool is_extended = (objects_.emcy_id & CO_EMCY_COBID_EXT) != 0;
  const std::uint32_t id = objects_.emcy_id + node_.NodeId;
  return is_extended ? CO_IF_FRM_EXT | (id & CO_EMCY_COBID_MASK) : id & 0x7FFU;
}

// Returns true if only a TPDO can send a frame with this identifier now.
bool Network::is_tpdo(std::uint32_t identifier) const {
  const bool is_shared = identifier == emcy_identifier() || identifier == node_.Sync.Identifier ||
                         identifier == node_.Time.Identifier || (identifier & 0x780U) == 0x080U ||
                         (identifier & 0x780U) == 0x580U || (identifier & 0x780U) == 0x680U;
  for (unsigned n = 0; n < network_pdos && !is_shared; ++n) {
    const bool exists = (objects_.tpdo[n].cob_id & CO_TPDO_COBID_OFF) == 0;
    if (exists && node_.TPdo[n].Identifier == identifier && node_.TxQueue.Num == 0) {
      return true;
    }
  }
  return false;
}

// Returns the rule that a sent frame violates, or "". Services may share an identifier, so the length is not checked.
std::string Network::fault_of(const CO_IF_FRM& frame) const {
  if (node_.Nmt.Mode != CO_OPERATIONAL && is_tpdo(frame.Identifier)) {
    return "a PDO outside of Operational";
  }
  const bool is_command = frame.DLC == 2 && (frame.Data[0] == 1 || frame.Data[0] == 2 || (frame.Data[0] & 0x7CU) == 0);
  if (frame.Identifier == 0 && !is_command) {
    return "not an NMT command";
  }
  const bool is_clean = frame.DLC <= 8 && std::all_of(frame.Data + frame.DLC, std::end(frame.Data),
                                                      [](std::uint8_t byte) { return byte == 0; });
  return is_clean ? "" : "bytes beyond the DLC not 0";
}

// Values -----------------------------------------------------------------

std::uint32_t Network::any_cob_id() {
  constexpr std::uint32_t ids[] = {0x80,  0x100, 0x085, 0x185, 0x205, 0x285, 0x305, 0x385,
                                   0x405, 0x505, 0x685, 0x089, 0x0C0, 0x7FF, 0x601, 0x12345};
  constexpr std::uint32_t flags[] = {0, 0x80000000, 0x40000000, 0xC0000000, 0x20000000, 0xA0000000, 0x60000000, 0};
  const std::uint32_t id = ids[input_.below(std::size(ids))];
  return id | flags[input_.below(std::size(flags))];
}

std::uint32_t Network::any_value(unsigned size) {
  switch (input_.below(4)) {
    case 0: return size == 4 ? any_cob_id() : input_.byte();
    case 1: return input_.byte() % 20U * (size == 4 ? 1000U : 1U);
    case 2: return input_.byte();
    default: return input_.number();
  }
}

std::uint32_t Network::any_mapping() { return mappings[input_.below(std::size(mappings))]; }

CO_OBJ* Network::any_object() {
  constexpr std::uint16_t indices[] = {0x2000, 0x2000, 0x2000, 0x2200};
  return CODictFind(&node_.Dict, CO_DEV(indices[input_.below(std::size(indices))], input_.below(12)));
}

void Network::write(std::uint16_t index, std::uint8_t sub, unsigned size, std::uint32_t value) {
  const std::uint32_t dev = CO_DEV(index, sub);
  switch (size) {
    case 1: CODictWrByte(&node_.Dict, dev, static_cast<std::uint8_t>(value)); break;
    case 2: CODictWrWord(&node_.Dict, dev, static_cast<std::uint16_t>(value)); break;
    default: CODictWrLong(&node_.Dict, dev, value); break;
  }
}

// Actions of the application -----------------------------------------------

void Network::configure() {
  const Entry& entry = settings[input_.below(std::size(settings))];
  write(entry.index, entry.sub, entry.size, any_value(entry.size));
}

void Network::configure_pdo() {
  const std::uint8_t which = input_.byte();
  const auto index = static_cast<std::uint16_t>(((which & 4U) != 0 ? 0x1800U : 0x1400U) + (which & 3U));
  const Entry& entry = pdo_settings[input_.below(std::size(pdo_settings))];
  write(index, entry.sub, entry.size, any_value(entry.size));
}

// Maps a PDO in the order that the standard requires; the stack may refuse some steps. [301:7.5.2.36]
void Network::map_pdo() {
  const std::uint8_t which = input_.byte();
  const bool is_tpdo = (which & 4U) != 0;
  const auto communication = static_cast<std::uint16_t>((is_tpdo ? 0x1800U : 0x1400U) + (which & 3U));
  const auto mapping = static_cast<std::uint16_t>(communication + 0x200U);
  const std::uint32_t id = (is_tpdo ? 0x185U : 0x205U) + (which & 3U) * 0x100U;
  const auto number = static_cast<std::uint8_t>(input_.below(10));
  write(communication, 1, 4, id | 0x80000000U);
  write(mapping, 0, 1, 0);
  for (std::uint8_t sub = 1; sub <= number; ++sub) {
    write(mapping, sub, 4, any_mapping());
  }
  write(mapping, 0, 1, number);
  write(communication, 2, 1, (which & 8U) != 0 ? 1U + (which >> 4) : 255U);
  write(communication, 1, 4, id);
}

void Network::request_pdo() { COTPdoRequest(&node_, static_cast<std::uint16_t>(input_.below(CO_TPDO_N + 1))); }

void Network::trigger_pdo() { COTPdoTrigPdo(node_.TPdo, static_cast<std::uint16_t>(input_.below(CO_TPDO_N + 1))); }

void Network::trigger_object() { COTPdoTrigObj(node_.TPdo, any_object()); }

void Network::write_object() {
  constexpr Entry objects[] = {{0x2000, 0, 1}, {0x2000, 1, 2}, {0x2000, 3, 4}, {0x2200, 0, 4}, {0x2000, 11, 1}};
  const Entry& entry = objects[input_.below(std::size(objects))];
  write(entry.index, entry.sub, entry.size, input_.byte());
}

void Network::ask_pdos() {
  const auto num = static_cast<std::uint16_t>(input_.below(CO_TPDO_N + 2));
  CORPdoWasReceived(&node_, num);
  COTPdoWasSent(&node_, num);
  const CO_OBJ* const obj = any_object();
  CORPdoObjWasReceived(&node_, obj);
  COTPdoObjWasSent(&node_, obj);
}

void Network::set_error() {
  const std::uint8_t what = input_.byte();
  const CO_EMCY_USR about = {what, {what, 2, 3, 4, 5}};
  COEmcySet(&node_.Emcy, what % (network_errors + 2U), (what & 0x80U) != 0 ? &about : nullptr);
}

void Network::clear_error() { COEmcyClr(&node_.Emcy, static_cast<std::uint8_t>(input_.below(network_errors + 2))); }

void Network::ask_errors() {
  COEmcyGet(&node_.Emcy, static_cast<std::uint8_t>(input_.below(network_errors + 2)));
  require(COEmcyCnt(&node_.Emcy) <= network_errors, "no more errors than the application has");
}

void Network::reset_errors() { COEmcyReset(&node_.Emcy, input_.flag() ? 1 : 0); }

void Network::reset_history() { COEmcyHistReset(&node_.Emcy); }

void Network::command() {
  constexpr CO_NMT_COMMAND commands[] = {CO_NMT_COMMAND_START, CO_NMT_COMMAND_STOP, CO_NMT_COMMAND_PREOP,
                                         CO_NMT_COMMAND_RESET_NODE, CO_NMT_COMMAND_RESET_COM};
  const CO_NMT_COMMAND command = commands[input_.below(std::size(commands))];
  CONmtCommand(&node_.Nmt, command, static_cast<std::uint8_t>(input_.below(10)));
}

void Network::ask_heartbeats() {
  const auto node_id = static_cast<std::uint8_t>(8 + input_.below(4));
  CONmtGetHbEvents(&node_.Nmt, node_id);
  CONmtLastHbState(&node_.Nmt, node_id);
}

// Changes a heartbeat consumer by CONmtHbConsActivate() or by its entry of 1016h.
void Network::activate_heartbeat() {
  const std::uint32_t which = input_.below(2);
  const std::uint16_t time = input_.byte();
  const auto node_id = static_cast<std::uint8_t>(8 + input_.below(4));
  if (input_.flag()) {
    CONmtHbConsActivate(&objects_.heartbeat_consumers[which], time, node_id);
  } else {
    write(0x1016, static_cast<std::uint8_t>(1 + which), 4, time | (std::uint32_t{node_id} << 16));
  }
}

void Network::set_time() {
  const CO_TIME_OF_DAY time = {input_.number() % (24U * 60 * 60 * 1000 + 5), input_.word()};
  CO_TIME_OF_DAY now{};
  if (COTimeSet(&node_, &time) == CO_ERR_NONE) {
    require(COTimeGet(&node_, &now) == CO_ERR_NONE, "a clock that was set tells the time");
  }
  std::uint32_t us = 0;
  if (input_.flag() && COTimeHighResSet(&node_, time.Ms) == CO_ERR_NONE) {
    require(COTimeHighResGet(&node_, &us) == CO_ERR_NONE, "a clock that was set returns its value");
  }
  require(COTimeGet(&node_, &now) != CO_ERR_NONE || now.Ms < 24U * 60 * 60 * 1000, "a day has 24 hours");
}

void Network::send_time() { input_.flag() ? COTimeSend(&node_) : COTimeProduce(&node_, input_.byte()); }

void Network::sign() {
  for (std::uint8_t n = 0; n < std::size(objects_.srdo); ++n) {
    COSrdoSignature(&node_, n, &objects_.srdo[n].signature);
  }
  objects_.srdo_valid = CO_SRDO_CONFIGURATION_VALID;
}

void Network::use_srdo() {
  const std::uint8_t what = input_.byte();
  what < 0x40 ? sign() : void(COSrdoRequest(&node_, std::uint8_t(what & 3U)));
  COSrdoIsEstablished(&node_);
}

void Network::send_gfc() { COGfcSend(&node_); }

void Network::use_leds() { input_.flag() ? COLedStart(&node_) : COLedSet(&node_, input_.byte(), input_.flag()); }

}  // namespace fuzz
