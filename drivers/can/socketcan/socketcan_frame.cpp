// SPDX-License-Identifier: Apache-2.0
#include "socketcan_frame.hpp"

#include <linux/can/raw.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

// Older kernel headers do not export this limit.
#ifndef CAN_RAW_FILTER_MAX
#define CAN_RAW_FILTER_MAX 512
#endif

namespace co {

static_assert(CO_IF_FRM_EXT == CAN_EFF_FLAG && CO_IF_FRM_RTR == CAN_RTR_FLAG && CO_IF_FRM_ERROR == CAN_ERR_FLAG &&
                  CO_IF_FRM_ID == CAN_EFF_MASK,
              "a frame carries the flags of SocketCAN");

namespace {

constexpr std::uint8_t highest_dlc = 15;  // of a classic frame; 9 to 15 mean 8 bytes

std::uint8_t bytes_in_use(std::uint8_t length) { return std::min<std::uint8_t>(length, CAN_MAX_DLEN); }

// Returns false for remote frames: they have a length, but no data.
bool has_data(std::uint32_t identifier) { return (identifier & CAN_RTR_FLAG) == 0; }

bool is_11_bit(std::uint32_t identifier) { return (identifier & (CAN_EFF_FLAG | CAN_ERR_FLAG)) == 0; }

// Returns the filter that passes data and remote frames of one identifier.
can_filter exactly(std::uint32_t identifier) {
  const canid_t mask = is_11_bit(identifier) ? CAN_SFF_MASK : CAN_EFF_MASK;
  return {identifier, CAN_EFF_FLAG | mask};
}

constexpr can_filter everything = {0, 0};

bool no_permission(int error) { return error == EPERM || error == EACCES; }

bool no_protocol(int error) { return error == EAFNOSUPPORT || error == EPROTONOSUPPORT || error == ESOCKTNOSUPPORT; }

std::string reason(SocketCanStep step, int error) {
  if (step == SocketCanStep::name) {
    return "an interface name has 1 to 15 characters";
  }
  if (step == SocketCanStep::socket && no_protocol(error)) {
    return "this kernel has no CAN sockets (try: modprobe can-raw; a container has none: use slcan)";
  }
  if (step == SocketCanStep::interface && error == ENODEV) {
    return "no such interface (a virtual one: ip link add dev NAME type vcan)";
  }
  if (step == SocketCanStep::bind && error == ENODEV) {
    return "not a CAN interface";
  }
  if (no_permission(error)) {
    return "no permission to use CAN sockets";
  }
  return std::generic_category().message(error);
}

}  // namespace

can_frame to_socketcan(const CO_IF_FRM& frame) {
  can_frame raw{};
  raw.can_id = frame.Identifier;
  if (is_11_bit(frame.Identifier) && (frame.Identifier & CO_IF_FRM_ID) > CAN_SFF_MASK) {
    raw.can_id |= CAN_EFF_FLAG;
  }
  raw.can_dlc = bytes_in_use(frame.DLC);
  if (has_data(raw.can_id)) {
    std::copy_n(frame.Data, raw.can_dlc, raw.data);
  }
  return raw;
}

CO_IF_FRM from_socketcan(const can_frame& frame) {
  CO_IF_FRM frm{};
  frm.Identifier = frame.can_id;
  const bool is_classic = frame.can_dlc <= highest_dlc;
  frm.DLC = is_classic ? bytes_in_use(frame.can_dlc) : frame.can_dlc;
  if (is_classic && has_data(frame.can_id)) {
    std::copy_n(frame.data, frm.DLC, frm.Data);
  }
  return frm;
}

std::vector<can_filter> socketcan_filters(const std::uint32_t* ids, std::uint16_t num) {
  std::vector<std::uint32_t> unique(ids, ids + num);
  std::sort(unique.begin(), unique.end());
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
  if (unique.size() > CAN_RAW_FILTER_MAX) {
    return {everything};
  }
  std::vector<can_filter> filters;
  filters.reserve(unique.size());
  for (const std::uint32_t id : unique) {
    filters.push_back(exactly(id));
  }
  return filters;
}

std::string socketcan_error(SocketCanStep step, int error, const std::string& interface) {
  return "CAN interface '" + interface + "': " + reason(step, error);
}

}  // namespace co
