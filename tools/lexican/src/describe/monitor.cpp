// SPDX-License-Identifier: Apache-2.0
#include "describe/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "frame_bits.hpp"
#include "trace/text.hpp"

namespace lexican::describe {
namespace {

constexpr std::uint32_t not_valid = KnownPdo::not_valid;
constexpr std::size_t most_pdos = 16384;
constexpr std::uint32_t extended = 0x20000000;  // bit of a COB-ID
constexpr std::uint16_t known_state = 0x100;
constexpr unsigned most_mapped = 64;  // values above are those of multiplexed PDOs
constexpr Micros error_repetition = 1'000'000;
constexpr std::size_t fewest_scanned = 16;  // fewer uploads of 1000h are those of a master from its devices

const trace::Names no_names;

std::uint32_t key(std::uint8_t node, bool is_transmit, std::uint16_t number) {
  return (is_transmit ? 0U : 1U << 24) | static_cast<std::uint32_t>(node) << 16 | number;
}

/// Returns whether CiA 301 excludes an identifier for PDOs. [301:7.3.5]
bool is_restricted(std::uint32_t cob_id) {
  const std::uint32_t id = cob_id & ~extended;
  return (cob_id & extended) == 0 && (id < 0x080 || (id > 0x100 && id <= 0x180) || (id > 0x580 && id <= 0x5FF) ||
                                      (id > 0x600 && id <= 0x67F) || id >= 0x6E0);
}

std::uint64_t number_in(const std::uint8_t* data, unsigned begin, unsigned bits) {
  std::uint64_t number = 0;
  for (unsigned n = 0; n < bits; ++n) {
    const unsigned bit = begin + n;
    number |= static_cast<std::uint64_t>((data[bit / 8] >> (bit % 8)) & 1U) << n;
  }
  return number;
}

Bytes bytes_of(std::uint64_t number, unsigned bits) {
  Bytes bytes((bits + 7U) / 8U);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    bytes[n] = static_cast<std::uint8_t>(number >> (8 * n));
  }
  return bytes;
}

/// Returns the value of a sub-object of a PDO's parameters that a description gives.
std::uint32_t value_of(const codict::Entry* entry, std::uint8_t node, std::uint32_t otherwise) {
  if (entry == nullptr) {
    return otherwise;
  }
  const codict::Value& value = codict::value_in_force(*entry);
  return value.is_integer() ? static_cast<std::uint32_t>(value.integer_for(node).bits()) : otherwise;
}

constexpr std::uint8_t type_sub_index = 2;
constexpr std::uint8_t inhibit_sub_index = 3;
constexpr std::uint8_t event_sub_index = 5;

/// Sets a communication parameter other than the COB-ID. [301:7.5.2.35, 7.5.2.37]
void set_parameter(KnownPdo& pdo, std::uint8_t sub_index, std::uint32_t value) {
  switch (sub_index) {
    case type_sub_index: pdo.type = static_cast<std::uint8_t>(value); break;
    case inhibit_sub_index: pdo.inhibit_time = pdo.is_transmit ? (value & 0xFFFFU) * 100U : 0U; break;
    case event_sub_index: pdo.event_time = (value & 0xFFFFU) * 1000U; break;
    default: break;
  }
}

Service service_of(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  const unsigned function = id >> 7;
  if ((identifier & CO_IF_FRM_EXT) != 0) {
    return Service::other;
  }
  if (id == 0) {
    return Service::nmt;
  }
  if (id == 0x080) {
    return Service::sync;
  }
  if (id == 0x001 || (id > 0x100 && id <= 0x180)) {
    return Service::safety;
  }
  if (id == 0x100) {
    return Service::time;
  }
  if (id == 0x7E4 || id == 0x7E5) {
    return Service::lss;
  }
  if ((id & 0x7FU) == 0) {
    return Service::other;
  }
  switch (function) {
    case 1: return Service::emcy;
    case 11:
    case 12: return Service::sdo;
    case 14: return Service::state;
    default: return function >= 3 && function <= 10 ? Service::pdo : Service::other;
  }
}

struct ErrorBit {
  std::uint32_t mask;
  const char* text;
};

/// Classes of the identifier, and details in data byte 1, of an error frame. [linux/can/error.h]
constexpr ErrorBit error_classes[] = {
    {0x040, "bus-off"},           {0x100, "controller restarted"}, {0x020, "nobody acknowledges"},
    {0x001, "transmit time-out"}, {0x002, "lost arbitration"},     {0x010, "transceiver fault"},
    {0x088, "bus error"},
};
constexpr std::uint32_t controller_problem = 0x004;
constexpr ErrorBit controller_states[] = {
    {0x01, "receive queue of the controller overflowed"},
    {0x02, "transmit queue of the controller overflowed"},
    {0x30, "error passive"},
    {0x0C, "error warning level reached"},
    {0x40, "error active again"},
};

std::string error_text(const CO_IF_FRM& frame) {
  std::string text;
  const auto add = [&](const char* words) { text += (text.empty() ? "" : ", ") + std::string(words); };
  for (const ErrorBit& row : error_classes) {
    if ((frame.Identifier & row.mask) != 0) {
      add(row.text);
    }
  }
  const bool is_state = (frame.Identifier & controller_problem) != 0;
  for (const ErrorBit& row : controller_states) {
    if (is_state && (frame.Data[1] & row.mask) != 0) {
      add(row.text);
    }
  }
  return !text.empty() ? text : is_state ? "controller problem, unspecified" : "unknown error";
}

/// Returns whether an error frame reports only that an error has ended.
bool is_recovery(const CO_IF_FRM& frame) {
  const std::uint32_t classes = frame.Identifier & 0x1FFU;
  return classes == 0x100 || (classes == controller_problem && frame.Data[1] == 0x40);
}

/// Length of a message.
struct Length {
  Service service;
  const char* name;
  unsigned bytes;
  const char* shown;
};

constexpr Length lengths[] = {
    {Service::nmt, "NMT", 2, "2"},   {Service::state, "heartbeat", 1, "1"}, {Service::time, "TIME", 6, "6"},
    {Service::emcy, "EMCY", 8, "8"}, {Service::sdo, "SDO", 8, "8"},         {Service::lss, "LSS", 8, "8"},
};
constexpr Length sync_length = {Service::sync, "SYNC", 1, "0 or 1"};

/// Returns what is wrong with the length of a message; empty if it is right.
std::string wrong_length(Service service, const CO_IF_FRM& frame) {
  const auto* const found = std::find_if(std::begin(lengths), std::end(lengths),
                                         [=](const Length& length) { return length.service == service; });
  const Length* const row = service == Service::sync ? &sync_length : found != std::end(lengths) ? found : nullptr;
  const bool is_right = row == nullptr || frame.DLC == row->bytes || (service == Service::sync && frame.DLC == 0);
  return is_right ? std::string()
                  : fmt::format("{} with {} byte{} instead of {}: {}", row->name, frame.DLC, frame.DLC == 1 ? "" : "s",
                                row->shown, host_bus::to_text(frame));
}

}  // namespace

bool KnownPdo::is_mapping_known(unsigned& bits) const {
  bits = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const unsigned length = n < entries.size() ? entries[n] & 0xFFU : 0U;
    bits += length;
    if (length == 0) {
      return false;
    }
  }
  return count > 0;
}

double Statistics::load(std::uint32_t bit_rate) const {
  const Micros duration = last - first;
  return bit_rate == 0 || duration == 0 ? 0.0
                                        : 100.0 * static_cast<double>(bits) * 1e6 /
                                              (static_cast<double>(duration) * static_cast<double>(bit_rate));
}

Monitor::Monitor(const Network& network, Show show, Identified identified)
    : network_(network), show_(std::move(show)), identified_(std::move(identified)), decoder_(no_names) {
  std::map<const codict::Device*, std::vector<codict::Pdo>> described;  // a device can describe many nodes
  for (std::uint8_t node = 1; node <= 127; ++node) {
    const codict::Device* const device = network_.of(node).device();
    if (device != nullptr) {
      const auto [pdos, is_new] = described.try_emplace(device);
      if (is_new) {
        pdos->second = codict::pdos_of(*device);
      }
      describe_pdos(node, pdos->second);
    }
  }
}

void Monitor::describe_pdos(std::uint8_t node, const std::vector<codict::Pdo>& all) {
  for (const codict::Pdo& described : all) {
    const PdoKey at = key(node, described.is_transmit, described.number);
    const auto known = pdos_.find(at);
    if (known != pdos_.end() ? known->second.is_observed : pdos_.size() >= most_pdos) {
      continue;
    }
    Pdo& pdo = pdos_[at];
    pdo.entries.clear();
    pdo.node = node;
    pdo.is_transmit = described.is_transmit;
    pdo.number = described.number;
    for (const codict::MappedObject& mapped : described.mapped) {
      pdo.entries.push_back(static_cast<std::uint32_t>(mapped.index) << 16 |
                            static_cast<std::uint32_t>(mapped.sub_index) << 8 | mapped.bits);
    }
    pdo.count = static_cast<std::uint8_t>(pdo.entries.size());
    set_cob_id(at, pdo, value_of(described.parameter(1), node, not_valid));
    for (const std::uint8_t sub_index : {type_sub_index, inhibit_sub_index, event_sub_index}) {
      set_parameter(pdo, sub_index,
                    value_of(described.parameter(sub_index), node, sub_index == type_sub_index ? 255 : 0));
    }
  }
}

void Monitor::set_cob_id(PdoKey at, Pdo& pdo, std::uint32_t cob_id) {
  by_cob_id_.erase({pdo.cob_id, at});
  pdo.cob_id = cob_id & (extended | ((cob_id & extended) != 0 ? CO_IF_FRM_ID : 0x7FFU));
  if ((cob_id & not_valid) != 0 || is_restricted(pdo.cob_id)) {
    pdo.cob_id = not_valid;
  } else {
    by_cob_id_.emplace(pdo.cob_id, at);
  }
}

/// Returns the PDO of a frame: the TPDO, because it names the sender, else the first RPDO. \a node: whose; 0: any.
/// \retval nullptr  no known PDO
const Monitor::Pdo* Monitor::pdo_of(const CO_IF_FRM& frame, std::uint8_t node) const {
  const std::uint32_t cob_id =
      (frame.Identifier & CO_IF_FRM_ID) | ((frame.Identifier & CO_IF_FRM_EXT) != 0 ? extended : 0U);
  auto found = by_cob_id_.lower_bound({cob_id, 0});
  for (; found != by_cob_id_.end() && found->first == cob_id; ++found) {
    const Pdo& pdo = pdos_.at(found->second);
    if (node == 0 || pdo.node == node) {
      return &pdo;
    }
  }
  return nullptr;
}

void Monitor::for_each_pdo(const CO_IF_FRM& frame, const std::function<void(const KnownPdo&)>& call) const {
  const std::uint32_t cob_id =
      (frame.Identifier & CO_IF_FRM_ID) | ((frame.Identifier & CO_IF_FRM_EXT) != 0 ? extended : 0U);
  auto found = by_cob_id_.lower_bound({cob_id, 0});
  for (; found != by_cob_id_.end() && found->first == cob_id; ++found) {
    call(pdos_.at(found->second));
  }
}

void Monitor::for_each_pdo(const std::function<void(const KnownPdo&)>& call) const {
  for (const auto& known : pdos_) {
    call(known.second);
  }
}

void Monitor::process(const host_bus::Entry& received) {
  host_bus::Entry entry = received;
  entry.frame.DLC = std::min<std::uint8_t>(entry.frame.DLC, 8);  // 9 to 15 stand for 8 bytes
  count(entry);
  if (open_servers_ > 0 || scan_.nodes.any()) {
    expire(entry.time);
  }
  Event event;
  event.time = entry.time;
  const std::uint32_t id = entry.frame.Identifier;
  if ((id & CO_IF_FRM_ERROR) != 0) {
    error(event, entry.frame);
  } else if (const Pdo* const pdo = pdo_of(entry.frame)) {
    event.service = Service::pdo;
    event.node = pdo->node;
    event.text = show_pdo(*pdo, entry.frame);
  } else {
    const bool is_sdo = (id & (CO_IF_FRM_EXT | CO_IF_FRM_RTR)) == 0 && service_of(id) == Service::sdo;
    if (is_sdo && sdo(entry)) {
      return;
    }
    message(event, entry.frame);
  }
  show_(event);
}

void Monitor::count(const host_bus::Entry& entry) {
  if (statistics_.frames + statistics_.errors == 0) {
    statistics_.first = entry.time;
  }
  statistics_.last = std::max(statistics_.last, entry.time);
  if ((entry.frame.Identifier & CO_IF_FRM_ERROR) != 0) {
    ++statistics_.errors;
    return;
  }
  ++statistics_.frames;
  statistics_.bits += co::frame_bits(entry.frame) + co::intermission_bits;
  const auto found = statistics_.by_identifier.find(entry.frame.Identifier);
  if (found != statistics_.by_identifier.end()) {
    ++found->second;
  } else if (statistics_.by_identifier.size() < Statistics::most_identifiers) {
    statistics_.by_identifier.emplace(entry.frame.Identifier, 1);
  } else {
    ++statistics_.others;
  }
}

/// Describes a message of the pre-defined connection set.
void Monitor::message(Event& event, const CO_IF_FRM& frame) {
  const bool is_remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
  event.service = service_of(frame.Identifier);
  const Service service = event.service;
  const bool has_node =
      service == Service::emcy || service == Service::sdo || service == Service::state || service == Service::pdo;
  event.node = static_cast<std::uint8_t>(has_node ? frame.Identifier & 0x7FU : 0U);
  if (!is_remote) {
    event.text = wrong_length(service, frame);
    if (!event.text.empty()) {
      return;
    }
  }
  if (service == Service::state) {
    state(event, frame);
    return;
  }
  event.text = decoder_.decode(frame).text;
  if (is_remote) {
    return;
  }
  if ((service == Service::pdo || service == Service::safety) && frame.DLC > 0) {
    event.text += ' ' + hex_bytes(frame.Data, frame.DLC);
  }
  if (service == Service::nmt) {
    event.node = static_cast<std::uint8_t>(frame.Data[1] <= 127 ? frame.Data[1] : 0U);
  }
  if (service == Service::emcy) {
    event.is_fault = frame.Data[0] != 0 || frame.Data[1] != 0;
    const bool has_more = std::any_of(frame.Data + 3, frame.Data + 8, [](std::uint8_t byte) { return byte != 0; });
    event.text += has_more ? ", manufacturer-specific " + hex_bytes(frame.Data + 3, 5) : "";
  }
  event.is_repeated = service == Service::sync && std::exchange(is_synchronised_, true);
}

/// Describes boot-up, heartbeat and node guarding. A node answers a remote frame with its state and a toggle bit.
void Monitor::state(Event& event, const CO_IF_FRM& frame) {
  ErrorControl& last = error_control_[event.node];
  if ((frame.Identifier & CO_IF_FRM_RTR) != 0) {
    event.text = "node guarding request";
    event.is_repeated = last.state != 0 && !last.is_guarding_request;
    last.is_guarding_request = true;
    return;
  }
  CO_IF_FRM plain = frame;
  plain.Data[0] = static_cast<std::uint8_t>(frame.Data[0] & 0x7FU);
  const bool is_toggled = frame.Data[0] != plain.Data[0];
  const bool is_guarding = is_toggled || std::exchange(last.is_guarding_request, false);
  const std::string text = decoder_.decode(plain).text;
  constexpr std::string_view heartbeat = "heartbeat";
  const bool is_boot_up = text.substr(0, heartbeat.size()) != heartbeat;
  event.text = is_guarding && !is_boot_up ? "node guarding" + text.substr(heartbeat.size()) : text;
  event.text += is_guarding && !(is_boot_up && !is_toggled) ? fmt::format(", toggle {}", is_toggled ? 1 : 0) : "";
  const auto state = static_cast<std::uint16_t>(known_state | plain.Data[0]);
  event.is_repeated = last.state == state && !is_boot_up;
  last = {state, false};
}

void Monitor::error(Event& event, const CO_IF_FRM& frame) {
  event.service = Service::error;
  event.is_fault = !is_recovery(frame);
  event.text = "bus: " + error_text(frame);
  const bool is_soon = event.time < last_error_time_ || event.time - last_error_time_ < error_repetition;
  event.is_repeated = is_soon && event.text == last_error_;
  last_error_ = event.text;
  last_error_time_ = event.time;
  if ((frame.Identifier & (0x200U | controller_problem)) != 0) {
    event.text += fmt::format(" (TEC {}, REC {})", frame.Data[6], frame.Data[7]);
  }
}

/// \retval false  the frame does not belong to a transfer
bool Monitor::sdo(const host_bus::Entry& entry) {
  const CO_IF_FRM& frame = entry.frame;
  if (frame.DLC != 8) {
    return false;
  }
  const auto node = static_cast<std::uint8_t>(frame.Identifier & 0x7FU);
  SdoFollower& server = servers_[node];
  const bool was_active = server.is_active();
  const std::optional<SdoTransfer> transfer =
      server.follow((frame.Identifier & 0x780U) == 0x600, frame.Data, entry.time);
  const bool was_followed = server.was_followed();
  open_servers_ += (server.is_active() ? 1U : 0U) - (was_active ? 1U : 0U);
  if (transfer) {
    report(node, *transfer, entry.time);
  }
  constexpr std::uint32_t upload_of_type = 0x00100040;
  if ((frame.Identifier & 0x780U) == 0x600 && CO_GET_LONG(&frame, 0) == upload_of_type) {
    note_scan(node, entry.time);
  }
  return was_followed;
}

void Monitor::expire(Micros now) {
  unsigned open = open_servers_;
  for (std::uint8_t node = 1; node < 128 && open > 0; ++node) {
    open -= servers_[node].is_active() ? 1U : 0U;
    if (const std::optional<SdoTransfer> transfer = servers_[node].expire(now)) {
      --open_servers_;
      report(node, *transfer, now);
    }
  }
  if (now > scan_.last && now - scan_.last > SdoFollower::answer_time) {
    finish_scan(now);
  }
}

void Monitor::note_scan(std::uint8_t node, Micros time) {
  const bool is_late = time < scan_.last || time - scan_.last > SdoFollower::answer_time;
  if (is_late || scan_.nodes.test(node)) {
    finish_scan(time);
  }
  scan_.nodes.set(node);
  scan_.last = time;
  scanned_.reset(node);
  if (scan_.nodes.count() >= fewest_scanned) {
    scanned_ |= scan_.nodes;
  }
}

void Monitor::finish_scan(Micros time) {
  const Scan scan = std::exchange(scan_, {});
  const std::size_t requested = scan.nodes.count();
  if (requested < fewest_scanned || scan.answered == requested) {
    return;
  }
  Event event;
  event.time = time;
  event.service = Service::sdo;
  event.text = fmt::format("scan: 1000h requested at {} node-IDs, {} answered", requested, scan.answered);
  show_(event);
}

/// Counts the answers to a scan.
/// \retval true  the transfer is a request of a scan without an answer
bool Monitor::is_scanned(std::uint8_t node, const SdoTransfer& transfer) {
  const bool is_of_type = transfer.index == 0x1000 && transfer.sub_index == 0 && !transfer.is_download;
  const bool is_answered = transfer.is_answered || transfer.end == SdoTransfer::End::refused;
  scan_.answered += is_of_type && is_answered && scan_.nodes.test(node) ? 1U : 0U;
  return is_of_type && !is_answered && scanned_.test(node);
}

void Monitor::finish() {
  for (std::uint8_t node = 1; node < 128; ++node) {
    if (std::optional<SdoTransfer> transfer = servers_[node].close()) {
      transfer->is_cut = true;
      report(node, *transfer, statistics_.last);
    }
  }
  open_servers_ = 0;
  finish_scan(statistics_.last);
}

/// Returns the bytes of a transfer without those that, for the type of the object, an expedited transfer without size
/// does not use.
Bytes Monitor::value_in(const Description& description, const SdoTransfer& transfer) {
  const std::optional<ValueType> type = description.type_of(transfer.index, transfer.sub_index);
  const bool is_shorter = !transfer.has_size && type && type->size != 0 && type->size < transfer.data.size();
  return {transfer.data.begin(),
          is_shorter ? transfer.data.begin() + static_cast<std::ptrdiff_t>(type->size) : transfer.data.end()};
}

void Monitor::report(std::uint8_t node, const SdoTransfer& transfer, Micros time) {
  if (is_scanned(node, transfer)) {
    return;
  }
  const Description& description = network_.of(node);
  const std::string reason =
      ": " + trace::abort_code(transfer.abort_code) + ' ' + trace::abort_meaning(transfer.abort_code);
  std::string text = (transfer.is_aborted_only ? "SDO transfer of "
                      : transfer.is_download   ? "write "
                                               : "read ") +
                     description.object(transfer.index, transfer.sub_index);
  switch (transfer.end) {
    case SdoTransfer::End::done:
      if (transfer.data.size() != transfer.size) {
        text += fmt::format(", {} bytes", transfer.size);
        break;
      }
      text += " = " + description.show(transfer.index, transfer.sub_index, value_in(description, transfer));
      text += transfer.size > 64 ? fmt::format(" ({} bytes)", transfer.size) : "";
      break;
    case SdoTransfer::End::refused:
      text += (transfer.is_aborted_only ? " aborted by the server" : " refused") + reason;
      break;
    case SdoTransfer::End::cancelled: text += " aborted by the client" + reason; break;
    case SdoTransfer::End::unanswered: text += transfer.is_answered ? ": not completed" : ": no answer"; break;
  }
  Event event;
  event.time = time;
  event.service = Service::sdo;
  event.node = node;
  event.text = std::move(text);
  event.is_fault = transfer.end != SdoTransfer::End::done;
  event.sdo = &transfer;
  show_(event);
  if (transfer.end == SdoTransfer::End::done) {
    learn(node, transfer);
  }
}

/// Reports the identity of a device as soon as vendor-ID and product code are known, and each change.
void Monitor::learn_identity(std::uint8_t node, const SdoTransfer& transfer) {
  constexpr unsigned most_reports = 4;  // a report may read files
  Seen& seen = seen_[node];
  const bool is_part = transfer.sub_index >= 1 && transfer.sub_index <= seen.parts.size();
  if (!is_part || transfer.is_download || transfer.data.size() != 4 || !identified_ || seen.reports >= most_reports) {
    return;
  }
  const auto value = static_cast<std::uint32_t>(number_in(transfer.data.data(), 0, 32));
  std::optional<std::uint32_t>& part = seen.parts[transfer.sub_index - 1U];
  if (part == value) {
    return;
  }
  part = value;
  const auto& [vendor, product, revision] = seen.parts;
  if (!vendor || !product) {
    return;
  }
  ++seen.reports;
  if (identified_(node, {*vendor, *product, revision.value_or(0)})) {
    const codict::Device* const device = network_.of(node).device();
    describe_pdos(node, device != nullptr ? codict::pdos_of(*device) : std::vector<codict::Pdo>());
  }
}

/// Follows changes of PDO parameters, and the identity of devices.
void Monitor::learn(std::uint8_t node, const SdoTransfer& transfer) {
  const std::uint16_t index = transfer.index;
  if (index == 0x1018) {
    learn_identity(node, transfer);
    return;
  }
  const bool is_transmit = index >= 0x1800;
  const bool is_mapping = (index & 0x0200U) != 0;
  if (index < 0x1400 || index > 0x1BFF || transfer.size == 0 || transfer.size > 4) {
    return;
  }
  const auto number = static_cast<std::uint16_t>((index & 0x01FFU) + 1);
  const PdoKey at = key(node, is_transmit, number);
  if (pdos_.find(at) == pdos_.end() && pdos_.size() >= most_pdos) {
    return;
  }
  const bool is_new = pdos_.find(at) == pdos_.end();
  Pdo& pdo = pdos_[at];
  pdo.node = node;
  pdo.is_transmit = is_transmit;
  pdo.number = number;
  pdo.is_observed = true;
  if (is_new && number <= 4) {
    const unsigned function = 1U + 2U * number + (is_transmit ? 0U : 1U);
    set_cob_id(at, pdo, function << 7 | node);  // until it is seen: the pre-defined connection set [301:7.3.3]
  }
  const auto value =
      static_cast<std::uint32_t>(number_in(transfer.data.data(), 0, static_cast<unsigned>(8 * transfer.data.size())));
  pdo.is_configured = pdo.is_configured || transfer.is_download;
  if (!is_mapping && transfer.sub_index == 1) {
    set_cob_id(at, pdo, value);
  } else if (!is_mapping) {
    set_parameter(pdo, transfer.sub_index, value);
  } else if (is_mapping && transfer.sub_index == 0) {
    pdo.count = static_cast<std::uint8_t>(value <= most_mapped ? value : 0U);
  } else if (is_mapping && transfer.sub_index <= most_mapped) {
    pdo.entries.resize(std::max<std::size_t>(pdo.entries.size(), transfer.sub_index));
    pdo.entries[transfer.sub_index - 1U] = value;
  }
}

Monitor::Content Monitor::content_of(const Pdo& pdo, const CO_IF_FRM& frame) {
  Content content;
  content.is_mapping_known = pdo.count > 0;
  for (std::size_t n = 0; n < pdo.count && content.is_mapping_known; ++n) {
    const std::uint32_t entry = n < pdo.entries.size() ? pdo.entries[n] : 0U;
    const unsigned length = entry & 0xFFU;
    Mapped mapped{static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8), {}};
    content.is_mapping_known = length != 0;
    if (content.bits + length > 8U * frame.DLC) {
      content.missing = std::move(mapped);
      break;
    }
    mapped.bytes = bytes_of(number_in(frame.Data, content.bits, length), length);
    content.objects.push_back(std::move(mapped));
    content.bits += length;
  }
  return content;
}

std::optional<PdoContent> Monitor::values_of(const CO_IF_FRM& frame, std::uint8_t node) const {
  const bool is_data = (frame.Identifier & (CO_IF_FRM_RTR | CO_IF_FRM_ERROR)) == 0 && frame.DLC <= 8;
  const Pdo* const pdo = is_data ? pdo_of(frame, node) : nullptr;
  if (pdo == nullptr || pdo->count == 0) {
    return std::nullopt;
  }
  const Description& description = network_.of(pdo->node);
  PdoContent content{pdo->node, pdo->is_transmit, pdo->number, {}};
  const Content data = content_of(*pdo, frame);
  for (const Mapped& mapped : data.objects) {
    const auto& [index, sub_index, bytes] = mapped;
    if (mapped.is_dummy()) {
      continue;
    }
    const std::string name = description.name_of(index, sub_index);
    content.values.push_back({index, sub_index, name.empty() ? description.object(index, sub_index) : name,
                              description.show(index, sub_index, bytes), description.number(index, sub_index, bytes),
                              description.unit_of(index, sub_index)});
  }
  return content;
}

std::string Monitor::show_pdo(const Pdo& pdo, const CO_IF_FRM& frame) const {
  std::string text = fmt::format("{}{}", pdo.is_transmit ? "TPDO" : "RPDO", pdo.number);
  if ((frame.Identifier & CO_IF_FRM_RTR) != 0) {
    return text + " requested";
  }
  const Description& description = network_.of(pdo.node);
  const Content content = content_of(pdo, frame);
  const char* separator = " ";
  for (const Mapped& mapped : content.objects) {
    if (!mapped.is_dummy()) {
      const std::string name = description.name_of(mapped.index, mapped.sub_index);
      text += separator + (name.empty() ? description.object(mapped.index, mapped.sub_index) : name) + " = " +
              description.show(mapped.index, mapped.sub_index, mapped.bytes);
      separator = ", ";
    }
  }
  if (content.missing) {
    return text + fmt::format("{}too short for {}, {}", separator,
                              description.object(content.missing->index, content.missing->sub_index),
                              frame.DLC == 0 ? "no data" : "whole data: " + hex_bytes(frame.Data, frame.DLC));
  }
  const std::size_t shown = (content.bits + 7) / 8;
  if (shown < frame.DLC) {
    text += separator + std::string(content.is_mapping_known ? "not mapped: " : "") +
            hex_bytes(frame.Data + shown, frame.DLC - shown);
  }
  return text;
}

}  // namespace lexican::describe
