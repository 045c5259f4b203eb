// SPDX-License-Identifier: Apache-2.0
#include "trace/decode.hpp"

#include <algorithm>

#include "trace/layer_setting.hpp"
#include "trace/network_services.hpp"
#include "trace/text.hpp"

namespace lexican::trace {
namespace {

constexpr std::uint32_t flags = CO_IF_FRM_EXT | CO_IF_FRM_RTR | CO_IF_FRM_ERROR;

// Bits of the first byte of an SDO frame. [301:7.2.4.3]
constexpr unsigned expedited = 0x02;
constexpr unsigned size_given = 0x01;
constexpr unsigned last_segment = 0x01;
constexpr unsigned toggle = 0x10;
constexpr unsigned block_crc = 0x04;
constexpr unsigned block_size_given = 0x02;

bool is_sdo(const CO_IF_FRM& frame, unsigned code) {
  return function_code(frame) == code && node_id(frame) != 0 && frame.DLC == 8;
}
bool is_request(const CO_IF_FRM& frame) { return is_sdo(frame, 0x600 >> 7); }
bool is_response(const CO_IF_FRM& frame) { return is_sdo(frame, 0x580 >> 7); }

std::string candump(const CO_IF_FRM& frame) {
  const bool wide = (frame.Identifier & (CO_IF_FRM_EXT | CO_IF_FRM_ERROR)) != 0;
  const auto id = static_cast<unsigned>(frame.Identifier & (CO_IF_FRM_ID | CO_IF_FRM_ERROR));
  std::string result = text(wide ? "%08X#" : "%03X#", id);
  if ((frame.Identifier & CO_IF_FRM_RTR) != 0) {
    return result + 'R' + (frame.DLC == 0 ? "" : text("%u", frame.DLC));
  }
  for (unsigned i = 0; i < std::min<unsigned>(frame.DLC, 8); ++i) {
    result += text("%02X", frame.Data[i]);
  }
  return result;
}

/// Returns the name of a SocketCAN error class (CAN_ERR_… in linux/can/error.h).
const char* error_class(const CO_IF_FRM& frame) {
  if ((frame.Identifier & 0x040u) != 0) {
    return "bus-off ";
  }
  if ((frame.Identifier & 0x100u) != 0) {
    return "controller restarted ";
  }
  return (frame.Identifier & 0x004u) != 0 ? "controller problem " : "";
}

std::string flagged(const CO_IF_FRM& frame) {
  if ((frame.Identifier & CO_IF_FRM_ERROR) != 0) {
    return std::string("CAN error frame: ") + error_class(frame) + candump(frame);
  }
  return ((frame.Identifier & CO_IF_FRM_RTR) != 0 ? "remote frame " : "unknown ") + candump(frame);
}

// --- NMT [301:7.2.8.3.1.1] and error control [301:7.2.8.3.2]

const char* nmt_command(unsigned specifier) {
  switch (specifier) {
    case 1: return "start";
    case 2: return "stop";
    case 128: return "enter pre-operational";
    case 129: return "reset node";
    case 130: return "reset communication";
    default: return nullptr;
  }
}

std::string nmt(const CO_IF_FRM& frame) {
  const char* const name = nmt_command(frame.Data[0]);
  const std::string what = (name != nullptr) ? name : text("unknown command %02Xh", frame.Data[0]);
  return "NMT " + what + (frame.Data[1] == 0 ? ", all nodes" : text(", node %u", frame.Data[1]));
}

std::string error_control(const CO_IF_FRM& frame) {
  switch (frame.Data[0]) {
    case 0x00: return "boot-up";
    case 0x04: return "heartbeat: stopped";
    case 0x05: return "heartbeat: operational";
    case 0x7F: return "heartbeat: pre-operational";
    default: return text("heartbeat: unknown state %02Xh", frame.Data[0]);
  }
}

// --- SDO [301:7.2.4.3]

const ObjectName* find(const CO_IF_FRM& frame, const Names& names) {
  const std::uint16_t index = CO_GET_WORD(&frame, 1);
  const auto found = std::find_if(names.begin(), names.end(), [&](const ObjectName& object) {
    return object.index == index && object.sub == frame.Data[3];
  });
  return (found != names.end()) ? &*found : nullptr;
}

std::string object(const CO_IF_FRM& frame, const Names& names) {
  const ObjectName* const known = find(frame, names);
  const std::string key = text("%04Xh:%02X", CO_GET_WORD(&frame, 1), frame.Data[3]);
  return (known != nullptr) ? key + ' ' + known->name : key;
}

std::string value(const CO_IF_FRM& frame, const Names& names) {
  const unsigned unused = ((frame.Data[0] & size_given) != 0) ? (frame.Data[0] >> 2) & 3u : 0;
  const unsigned size = 4 - unused;
  const ObjectName* const known = find(frame, names);
  const Form form = (known != nullptr) ? known->form : Form::hex;
  if (form == Form::characters && is_readable(frame.Data + 4, size)) {
    return quoted(frame.Data + 4, size);
  }
  const std::uint32_t number = CO_GET_LONG(&frame, 4) & (0xFFFFFFFFu >> (8 * unused));
  return (form == Form::decimal) ? text("%u", number) : text("%0*Xh", static_cast<int>(2 * size), number);
}

/// Returns the content of bytes 4…7 of an initiate frame: the value, or the announced size.
std::string content(const CO_IF_FRM& frame, const Names& names) {
  if ((frame.Data[0] & expedited) != 0) {
    return " = " + value(frame, names);
  }
  if ((frame.Data[0] & size_given) != 0) {
    return text(", %u bytes in segments", CO_GET_LONG(&frame, 4));
  }
  return ", segments of unknown size";
}

/// Returns the bytes of a segment if they are readable, else their number.
std::string carried(const std::uint8_t* bytes, unsigned size) {
  const bool readable = size > 0 && is_readable(bytes, size);
  return readable ? ": " + quoted(bytes, size) : text(", %u byte%s", size, size == 1 ? "" : "s");
}

std::string segment(const CO_IF_FRM& frame) {
  const unsigned size = 7u - ((frame.Data[0] >> 1) & 7u);
  return ((frame.Data[0] & last_segment) != 0 ? "last segment" : "segment") + carried(frame.Data + 1, size);
}

std::string abort(const CO_IF_FRM& frame, const Names& names) {
  const std::uint32_t code = CO_GET_LONG(&frame, 4);
  return "SDO ABORT " + object(frame, names) + ": " + abort_code(code) + ' ' + abort_meaning(code);
}

std::string toggle_of(const CO_IF_FRM& frame) { return (frame.Data[0] & toggle) != 0 ? ", toggle 1" : ", toggle 0"; }

// --- SDO block transfer [301:7.2.4.3.8…7.2.4.3.16]

std::string crc(const CO_IF_FRM& frame) { return (frame.Data[0] & block_crc) != 0 ? ", CRC" : ", no CRC"; }

std::string block_size(unsigned segments) { return text(", blksize %u", segments); }

std::string block_total(const CO_IF_FRM& frame) {
  return (frame.Data[0] & block_size_given) != 0 ? text(", %u bytes", CO_GET_LONG(&frame, 4)) : ", unknown size";
}

/// The number of valid bytes in the last segment is transmitted only at the end of the transfer.
std::string block_segment(const CO_IF_FRM& frame) {
  const unsigned number = frame.Data[0] & ~last_block_segment;
  const bool last = (frame.Data[0] & last_block_segment) != 0;
  return text(last ? "last block segment %u" : "block segment %u", number) +
         (last ? ", up to 7 bytes" : carried(frame.Data + 1, 7));
}

std::string block_acknowledge(const CO_IF_FRM& frame) {
  return text("block segments confirmed up to %u", frame.Data[1]) + block_size(frame.Data[2]);
}

std::string block_end(const CO_IF_FRM& frame) {
  const unsigned size = 7u - ((frame.Data[0] >> 2) & 7u);
  return text("end, %u byte%s in the last segment, CRC %04Xh", size, size == 1 ? "" : "s", CO_GET_WORD(&frame, 1));
}

std::string block_upload_request(const CO_IF_FRM& frame, const Names& names) {
  switch (frame.Data[0] & 3u) {
    case 0:
      return "SDO block upload " + object(frame, names) + block_size(frame.Data[4]) + text(", pst %u", frame.Data[5]) +
             crc(frame);
    case 1: return "SDO block upload done";
    case 2: return "SDO " + block_acknowledge(frame);
    default: return "SDO block upload start";
  }
}

std::string block_download_request(const CO_IF_FRM& frame, const Names& names) {
  if ((frame.Data[0] & 1u) != 0) {
    return "SDO block download " + block_end(frame);
  }
  return "SDO block download " + object(frame, names) + block_total(frame) + crc(frame);
}

std::string block_download_response(const CO_IF_FRM& frame, const Names& names) {
  switch (frame.Data[0] & 3u) {
    case 0: return "SDO answer: " + object(frame, names) + " block download" + block_size(frame.Data[4]) + crc(frame);
    case 1: return "SDO answer: block download done";
    case 2: return "SDO answer: " + block_acknowledge(frame);
    default: return "SDO answer: unknown command " + candump(frame);
  }
}

std::string block_upload_response(const CO_IF_FRM& frame, const Names& names) {
  if ((frame.Data[0] & 1u) != 0) {
    return "SDO answer: block upload " + block_end(frame);
  }
  return "SDO answer: " + object(frame, names) + " block upload" + block_total(frame) + crc(frame);
}

// --- SDO, all transfers

std::string request(const CO_IF_FRM& frame, const Names& names) {
  switch (command_specifier(frame)) {
    case 0: return "SDO download " + segment(frame);
    case 1: return "SDO download " + object(frame, names) + content(frame, names);
    case 2: return "SDO upload " + object(frame, names);
    case 3: return "SDO upload next segment" + toggle_of(frame);
    case 4: return abort(frame, names);
    case 5: return block_upload_request(frame, names);
    case 6: return block_download_request(frame, names);
    default: return "SDO unknown command " + candump(frame);
  }
}

std::string response(const CO_IF_FRM& frame, const Names& names) {
  switch (command_specifier(frame)) {
    case 0: return "SDO answer: " + segment(frame);
    case 1: return "SDO answer: segment confirmed" + toggle_of(frame);
    case 2: return "SDO answer: " + object(frame, names) + content(frame, names);
    case 3: return "SDO answer: " + object(frame, names) + " download accepted";
    case 4: return abort(frame, names);
    case 5: return block_download_response(frame, names);
    case 6: return block_upload_response(frame, names);
    default: return "SDO answer: unknown command " + candump(frame);
  }
}

/// Returns true if a frame of a segmented transfer is in its middle: a segment except the last one, a request for one,
/// or its confirmation.
bool is_in_segments(Sender from, const CO_IF_FRM& frame) {
  if (command_specifier(frame) == 0) {
    return (frame.Data[0] & last_segment) == 0;
  }
  return command_specifier(frame) == (from == Sender::client ? 3u : 1u);
}

}  // namespace

Meaning Decoder::decode(const CO_IF_FRM& frame) {
  if ((frame.Identifier & flags) != 0) {
    return {flagged(frame), Place::outside};
  }
  if (frame.Identifier == 0 && frame.DLC == 2) {
    return {nmt(frame), Place::outside};
  }
  if (function_code(frame) == 0x700 >> 7 && node_id(frame) != 0 && frame.DLC == 1) {
    return {error_control(frame), Place::outside};
  }
  if (is_request(frame)) {
    return sdo(Sender::client, frame);
  }
  if (is_response(frame)) {
    return sdo(Sender::server, frame);
  }
  if (const std::optional<Meaning> setting = decode_layer_setting(frame)) {
    return *setting;
  }
  const std::optional<std::string> service = decode_network_service(frame, names_, mappings_);
  return {service.value_or("unknown " + candump(frame)), Place::outside};
}

Meaning Decoder::sdo(Sender from, const CO_IF_FRM& frame) {
  const Role role = transfers_[node_id(frame)].follow(from, frame);
  if (role == Role::segment || role == Role::last_segment) {
    return {(from == Sender::client ? "SDO download " : "SDO answer: ") + block_segment(frame),
            role == Role::segment ? Place::middle : Place::edge};
  }
  const bool middle = role == Role::acknowledge || is_in_segments(from, frame);
  return {from == Sender::client ? request(frame, names_) : response(frame, names_),
          middle ? Place::middle : Place::edge};
}

}  // namespace lexican::trace
