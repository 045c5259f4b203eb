// SPDX-License-Identifier: Apache-2.0
#include "describe/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "frame_bits.hpp"
#include "model/pdo.hpp"
#include "trace/text.hpp"

namespace lexican::describe {
namespace {

constexpr std::uint32_t not_valid = 0x80000000;  // bit of a COB-ID
constexpr std::size_t most_pdos = 16384;
constexpr std::uint16_t no_state = 0;
constexpr std::uint16_t known_state = 0x100;

const trace::Names no_names;

std::uint32_t key(std::uint8_t node, bool is_transmit, std::uint16_t number) {
  return static_cast<std::uint32_t>(node) << 16 | (is_transmit ? 0x8000U : 0U) | number;
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

Service service_of(const CO_IF_FRM& frame) {
  const std::uint32_t id = frame.Identifier;
  const unsigned function = id >> 7;
  if ((id & CO_IF_FRM_EXT) != 0) {
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
    {0x040, "bus-off"},           {0x100, "restarted"},        {0x020, "nobody acknowledges"},
    {0x001, "transmit time-out"}, {0x002, "lost arbitration"}, {0x010, "transceiver fault"},
    {0x088, "bus error"},
};
constexpr ErrorBit controller_states[] = {
    {0x01, "receive queue of the controller overflowed"},
    {0x02, "transmit queue of the controller overflowed"},
    {0x30, "error passive"},
    {0x0C, "error warning level reached"},
    {0x40, "error active again"},
};

std::string error_text(const CO_IF_FRM& frame) {
  std::string text;
  const auto add = [&](const char* what) { text += (text.empty() ? "" : ", ") + std::string(what); };
  for (const ErrorBit& row : error_classes) {
    if ((frame.Identifier & row.mask) != 0) {
      add(row.text);
    }
  }
  for (const ErrorBit& row : controller_states) {
    if ((frame.Identifier & 0x004) != 0 && (frame.Data[1] & row.mask) != 0) {
      add(row.text);
    }
  }
  return text.empty() ? "unknown error" : text;
}

bool is_known(const CO_IF_FRM& frame, Service service) {
  switch (service) {
    case Service::nmt: return frame.DLC == 2;
    case Service::sdo:
    case Service::emcy: return frame.DLC == 8;
    case Service::state: return frame.DLC == 1;
    default: return true;
  }
}

}  // namespace

double Statistics::load(std::uint32_t bit_rate) const {
  const Micros duration = last - first;
  return bit_rate == 0 || duration == 0 ? 0.0
                                        : 100.0 * static_cast<double>(bits) * 1e6 /
                                              (static_cast<double>(duration) * static_cast<double>(bit_rate));
}

Monitor::Monitor(const Network& network, Show show) : network_(network), show_(std::move(show)), decoder_(no_names) {
  for (std::uint8_t node = 1; node <= 127; ++node) {
    describe_pdos(node);
  }
}

void Monitor::describe_pdos(std::uint8_t node) {
  const codict::Device* const device = network_.of(node).device();
  for (const codict::Pdo& described : device != nullptr ? codict::pdos_of(*device) : std::vector<codict::Pdo>()) {
    const PdoKey at = key(node, described.is_transmit, described.number);
    Pdo& pdo = pdos_[at];
    pdo.node = node;
    pdo.is_transmit = described.is_transmit;
    pdo.number = described.number;
    for (const codict::MappedObject& mapped : described.mapped) {
      pdo.entries.push_back(static_cast<std::uint32_t>(mapped.index) << 16 |
                            static_cast<std::uint32_t>(mapped.sub_index) << 8 | mapped.bits);
    }
    pdo.count = static_cast<std::uint8_t>(pdo.entries.size());
    set_cob_id(at, pdo, value_of(described.parameter(1), node, not_valid));
  }
}

void Monitor::set_cob_id(PdoKey at, Pdo& pdo, std::uint32_t cob_id) {
  const auto old = by_cob_id_.find(pdo.cob_id);
  if (old != by_cob_id_.end() && old->second == at) {
    by_cob_id_.erase(old);
  }
  pdo.cob_id = (cob_id & not_valid) != 0 ? not_valid : cob_id & (CO_IF_FRM_ID | 0x20000000U);
  if (pdo.cob_id != not_valid) {
    by_cob_id_[pdo.cob_id] = at;
  }
}

void Monitor::process(const host_bus::Entry& entry) {
  count(entry);
  if (open_servers_ > 0) {
    expire(entry.time);
  }
  Event event;
  event.time = entry.time;
  if ((entry.frame.Identifier & CO_IF_FRM_ERROR) != 0) {
    error(event, entry.frame);
    show_(event);
  } else {
    classic(entry);
  }
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
  }
}

void Monitor::classic(const host_bus::Entry& entry) {
  const CO_IF_FRM& frame = entry.frame;
  Event event;
  event.time = entry.time;
  const std::uint32_t wide = (frame.Identifier & CO_IF_FRM_EXT) != 0 ? 0x20000000U : 0U;
  const auto found = by_cob_id_.find((frame.Identifier & CO_IF_FRM_ID) | wide);
  const auto pdo = found != by_cob_id_.end() ? pdos_.find(found->second) : pdos_.end();
  if (pdo != pdos_.end()) {
    event.service = Service::pdo;
    event.node = pdo->second.node;
    event.text = show_pdo(pdo->second, frame);
    show_(event);
    return;
  }
  event.service = service_of(frame);
  const bool has_node = event.service == Service::emcy || event.service == Service::sdo ||
                        event.service == Service::state || event.service == Service::pdo;
  event.node = static_cast<std::uint8_t>(has_node ? frame.Identifier & 0x7FU : 0U);
  const bool is_remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
  if (event.service == Service::sdo && !is_remote && sdo(entry)) {
    return;
  }
  if (event.service == Service::state) {
    state(event, frame);
  } else {
    event.text = decoder_.decode(frame).text;
    if (event.service == Service::pdo && !is_remote && frame.DLC > 0) {
      event.text += ' ' + hex_bytes(frame.Data, std::min<std::size_t>(frame.DLC, 8));
    }
  }
  event.is_repeated = event.is_repeated || (event.service == Service::sync && std::exchange(is_synchronised_, true));
  event.is_fault = event.service == Service::emcy && (frame.Data[0] != 0 || frame.Data[1] != 0);
  event.service = is_known(frame, event.service) || is_remote ? event.service : Service::other;
  show_(event);
}

void Monitor::state(Event& event, const CO_IF_FRM& frame) {
  if ((frame.Identifier & CO_IF_FRM_RTR) != 0) {
    event.text = "guarding request";
    event.is_repeated = states_[event.node] != no_state;
    return;
  }
  CO_IF_FRM plain = frame;
  const bool is_toggled = (frame.Data[0] & 0x80U) != 0;  // node guarding
  plain.Data[0] = static_cast<std::uint8_t>(frame.Data[0] & 0x7FU);
  event.text = is_toggled && frame.DLC == 1 ? decoder_.decode(plain).text + " (guarding)" : decoder_.decode(frame).text;
  const auto state = static_cast<std::uint16_t>(known_state | plain.Data[0]);
  event.is_repeated = frame.DLC == 1 && states_[event.node] == state && plain.Data[0] != 0;
  states_[event.node] = frame.DLC == 1 ? state : states_[event.node];
}

void Monitor::error(Event& event, const CO_IF_FRM& frame) {
  event.service = Service::error;
  event.is_fault = true;
  event.text = "bus: " + error_text(frame);
  event.is_repeated = event.text == last_error_;
  last_error_ = event.text;
  if ((frame.Identifier & 0x200U) != 0 || (frame.Identifier & 0x004U) != 0) {
    event.text += fmt::format(" (TEC {}, REC {})", frame.Data[6], frame.Data[7]);
  }
}

/// \retval false  the frame is not of an SDO transfer
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
  open_servers_ += server.is_active() ? (was_active ? 0U : 1U) : (was_active ? ~0U : 0U);
  if (transfer) {
    report(node, *transfer);
  }
  return transfer.has_value() || server.is_active() || was_active;
}

void Monitor::expire(Micros now) {
  for (std::uint8_t node = 1; node < 128 && open_servers_ > 0; ++node) {
    if (const std::optional<SdoTransfer> transfer = servers_[node].expire(now)) {
      --open_servers_;
      report(node, *transfer);
    }
  }
}

void Monitor::finish() {
  for (std::uint8_t node = 1; node < 128; ++node) {
    if (const std::optional<SdoTransfer> transfer = servers_[node].close()) {
      report(node, *transfer);
    }
  }
  open_servers_ = 0;
}

void Monitor::report(std::uint8_t node, const SdoTransfer& transfer) {
  const Description& description = network_.of(node);
  std::string text =
      (transfer.is_download ? "write " : "read ") + description.object(transfer.index, transfer.sub_index);
  switch (transfer.end) {
    case SdoTransfer::End::done:
      text += " = ";
      text += transfer.data.size() == transfer.size
                  ? description.show(transfer.index, transfer.sub_index, transfer.data)
                  : fmt::format("{} bytes", transfer.size);
      if (transfer.size > 64 && transfer.data.size() == transfer.size) {
        text += fmt::format(" ({} bytes)", transfer.size);
      }
      break;
    case SdoTransfer::End::refused:
      text += " refused: " + trace::abort_code(transfer.abort_code) + ' ' + trace::abort_meaning(transfer.abort_code);
      break;
    case SdoTransfer::End::cancelled:
      text += " cancelled by the client: " + trace::abort_code(transfer.abort_code) + ' ' +
              trace::abort_meaning(transfer.abort_code);
      break;
    case SdoTransfer::End::unanswered: text += transfer.size == 0 ? ": no answer" : ": not completed"; break;
  }
  Event event;
  event.time = transfer.time;
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

/// Follows changes of PDO parameters.
void Monitor::learn(std::uint8_t node, const SdoTransfer& transfer) {
  const std::uint16_t index = transfer.index;
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
  Pdo& pdo = pdos_[at];
  pdo.node = node;
  pdo.is_transmit = is_transmit;
  pdo.number = number;
  const auto value =
      static_cast<std::uint32_t>(number_in(transfer.data.data(), 0, static_cast<unsigned>(8 * transfer.data.size())));
  if (!is_mapping && transfer.sub_index == 1) {
    set_cob_id(at, pdo, value);
  } else if (is_mapping && transfer.sub_index == 0) {
    pdo.count = static_cast<std::uint8_t>(value);
  } else if (is_mapping && transfer.sub_index <= 64) {
    pdo.entries.resize(std::max<std::size_t>(pdo.entries.size(), transfer.sub_index));
    pdo.entries[transfer.sub_index - 1U] = value;
  }
}

std::string Monitor::show_pdo(const Pdo& pdo, const CO_IF_FRM& frame) const {
  std::string text = fmt::format("{}{}", pdo.is_transmit ? "TPDO" : "RPDO", pdo.number);
  if ((frame.Identifier & CO_IF_FRM_RTR) != 0) {
    return text + " requested";
  }
  const unsigned bits = 8U * std::min<unsigned>(frame.DLC, 8);
  const Description& description = network_.of(pdo.node);
  unsigned position = 0;
  const std::size_t count = std::min<std::size_t>(pdo.count, pdo.entries.size());
  for (std::size_t n = 0; n < count; ++n) {
    const auto index = static_cast<std::uint16_t>(pdo.entries[n] >> 16);
    const auto sub_index = static_cast<std::uint8_t>(pdo.entries[n] >> 8);
    const unsigned length = pdo.entries[n] & 0xFFU;
    if (length == 0 || position + length > bits) {
      text += fmt::format(", too short for {}", description.object(index, sub_index));
      break;
    }
    const bool is_dummy = index < 0x20;
    if (!is_dummy) {
      const std::string name = description.name_of(index, sub_index);
      text += (position == 0 ? " " : ", ") + (name.empty() ? description.object(index, sub_index) : name) + " = " +
              description.show(index, sub_index, bytes_of(number_in(frame.Data, position, length), length));
    }
    position += length;
  }
  if (position == 0 && bits > 0) {
    text += ' ' + hex_bytes(frame.Data, bits / 8);
  }
  return text;
}

}  // namespace lexican::describe
