// SPDX-License-Identifier: Apache-2.0
#include "trace/network_services.hpp"

#include <algorithm>

#include "trace/text.hpp"

namespace lexican::trace {
namespace {

// --- EMCY [301:7.2.7]

struct ErrorCode {
  std::uint16_t code;
  std::uint16_t mask;  // of the code
  const char* meaning;
};

/// The first row that matches is used. Classes of CiA 301 [301:7.2.7.1 table 26], and codes of drives [402-1] that no
/// other profile uses.
constexpr ErrorCode error_codes[] = {
    {0x8110, 0xFFFF, "CAN overrun, a message is lost"},
    {0x8120, 0xFFFF, "CAN error passive"},
    {0x8130, 0xFFFF, "heartbeat or life guarding missing"},
    {0x8140, 0xFFFF, "recovered from bus-off"},
    {0x8150, 0xFFFF, "CAN-ID collision"},
    {0x8210, 0xFFFF, "PDO too short, not processed"},
    {0x8220, 0xFFFF, "PDO too long"},
    {0x8240, 0xFFFF, "unexpected length of SYNC"},
    {0x8250, 0xFFFF, "RPDO missing"},
    {0x0000, 0xFF00, "error reset"},
    {0x1000, 0xFF00, "generic error"},
    {0x2100, 0xFF00, "current on the input side"},
    {0x2200, 0xFF00, "current inside the device"},
    {0x2300, 0xFF00, "current on the output side"},
    {0x2000, 0xF000, "current"},
    {0x3100, 0xFF00, "mains voltage"},
    {0x3200, 0xFF00, "voltage inside the device"},
    {0x3300, 0xFF00, "output voltage"},
    {0x3000, 0xF000, "voltage"},
    {0x4100, 0xFF00, "ambient temperature"},
    {0x4200, 0xFF00, "device temperature"},
    {0x4000, 0xF000, "temperature"},
    {0x5100, 0xFF00, "supply"},
    {0x5200, 0xFF00, "control hardware"},
    {0x5300, 0xFF00, "operating unit"},
    {0x5400, 0xFF00, "power section"},
    {0x5500, 0xFF00, "data storage"},
    {0x5000, 0xF000, "hardware"},
    {0x6100, 0xFF00, "internal software"},
    {0x6200, 0xFF00, "user software"},
    {0x6300, 0xFF00, "data set"},
    {0x6000, 0xF000, "software"},
    {0x7110, 0xFFF0, "brake chopper"},
    {0x7121, 0xFFFF, "motor blocked"},
    {0x7120, 0xFFF0, "motor"},
    {0x7100, 0xFF00, "power module"},
    {0x7200, 0xFF00, "measurement circuit"},
    {0x7303, 0xFFFF, "resolver 1"},
    {0x7304, 0xFFFF, "resolver 2"},
    {0x7305, 0xFFFF, "incremental sensor 1"},
    {0x7306, 0xFFFF, "incremental sensor 2"},
    {0x7307, 0xFFFF, "incremental sensor 3"},
    {0x7310, 0xFFFF, "speed"},
    {0x7320, 0xFFFF, "position"},
    {0x7300, 0xFF00, "sensor"},
    {0x7400, 0xFF00, "computation circuit"},
    {0x7500, 0xFF00, "communication module"},
    {0x7600, 0xFF00, "data storage module"},
    {0x7000, 0xF000, "additional modules"},
    {0x8100, 0xFF00, "communication"},
    {0x8200, 0xFF00, "protocol"},
    {0x8300, 0xFF00, "torque control"},
    {0x8400, 0xFF00, "velocity controller"},
    {0x8500, 0xFF00, "position controller"},
    {0x8611, 0xFFFF, "following error"},
    {0x8612, 0xFFFF, "reference limit"},
    {0x8600, 0xFF00, "positioning controller"},
    {0x8700, 0xFF00, "sync controller"},
    {0x8800, 0xFF00, "winding controller"},
    {0x8900, 0xFF00, "process data monitoring"},
    {0x8000, 0xF000, "monitoring"},
    {0x9000, 0xFF00, "external error"},
    {0xF000, 0xFF00, "additional functions"},
    {0xFF00, 0xFF00, "device specific"},
    {0x0000, 0x0000, "unknown error code"},
};

std::string emcy(const CO_IF_FRM& frame) {
  const unsigned code = CO_GET_WORD(&frame, 0);
  const auto* const row = std::find_if(std::begin(error_codes), std::end(error_codes), [=](const ErrorCode& candidate) {
    return (code & candidate.mask) == candidate.code;
  });
  return text("EMCY %04Xh %s, error register %02Xh", code, row->meaning, frame.Data[2]);
}

// --- SYNC [301:7.2.5] and TIME [301:7.2.6]

std::string sync(const CO_IF_FRM& frame) { return frame.DLC == 0 ? "SYNC" : text("SYNC, counter %u", frame.Data[0]); }

std::string time(const CO_IF_FRM& frame) {
  const std::uint32_t ms = CO_GET_LONG(&frame, 0) & 0x0FFFFFFFu;
  const std::uint32_t seconds = ms / 1000;
  return text("TIME %02u:%02u:%02u.%03u, day %u", seconds / 3600, seconds / 60 % 60, seconds % 60, ms % 1000,
              CO_GET_WORD(&frame, 4));
}

// --- PDO [301:7.2.2]

/// Returns the name of a PDO; TPDO1, RPDO1, TPDO2, … have the function codes 3, 4, 5, …
std::string pdo_name(unsigned function_code) {
  return text("%s%u", function_code % 2 != 0 ? "TPDO" : "RPDO", (function_code - 1) / 2);
}

std::string object(const Mapped& mapped, std::uint32_t value, const Names& names) {
  const auto name = std::find_if(names.begin(), names.end(), [&](const ObjectName& known) {
    return known.index == mapped.index && known.sub == mapped.sub;
  });
  const bool decimal = name != names.end() && name->form == Form::decimal;
  const std::string key = name != names.end() ? name->name : text("%04Xh:%02X", mapped.index, mapped.sub);
  return key + " = " + (decimal ? text("%u", value) : text("%0*Xh", 2 * mapped.bytes, value));
}

std::string pdo(const CO_IF_FRM& frame, const Names& names, const Mappings& mappings) {
  std::string result = pdo_name(function_code(frame));
  const auto mapping = mappings.find(static_cast<std::uint16_t>(function_code(frame) << 7));
  if (mapping == mappings.end()) {
    return result;
  }
  unsigned position = 0;
  for (const Mapped& mapped : mapping->second) {
    std::uint32_t value = 0;
    for (unsigned byte = 0; byte < mapped.bytes && position < frame.DLC; ++byte) {
      value |= std::uint32_t{frame.Data[position++]} << (8 * byte);
    }
    result += (&mapped == &mapping->second.front() ? " " : ", ") + object(mapped, value, names);
  }
  return result;
}

// --- GFC and SRDO [EN 50325-5]

/// Returns the name of an SRDO frame: COB-ID 1 is odd, COB-ID 2 is the next number. Default COB-IDs have a node-ID.
std::string srdo(const CO_IF_FRM& frame) {
  const bool plain = frame.Identifier % 2 != 0;
  return text("SRDO %03Xh %s", frame.Identifier - (plain ? 0u : 1u), plain ? "plain" : "inverse");
}

bool is_pdo(const CO_IF_FRM& frame) {
  return function_code(frame) >= 0x180 >> 7 && function_code(frame) <= 0x500 >> 7 && node_id(frame) != 0;
}

}  // namespace

std::optional<std::string> decode_network_service(const CO_IF_FRM& frame, const Names& names,
                                                  const Mappings& mappings) {
  if (frame.Identifier == 0x001 && frame.DLC == 0) {
    return "GFC, global fail-safe command";
  }
  if (frame.Identifier >= 0x101 && frame.Identifier <= 0x180) {
    return srdo(frame);
  }
  if (frame.Identifier == 0x080 && frame.DLC <= 1) {
    return sync(frame);
  }
  if (frame.Identifier == 0x100 && frame.DLC == 6) {
    return time(frame);
  }
  if (function_code(frame) == 0x080 >> 7 && node_id(frame) != 0 && frame.DLC == 8) {
    return emcy(frame);
  }
  return is_pdo(frame) ? std::optional(pdo(frame, names, mappings)) : std::nullopt;
}

}  // namespace lexican::trace
