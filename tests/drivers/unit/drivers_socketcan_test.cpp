// SPDX-License-Identifier: Apache-2.0
// SocketCAN without a CAN interface: frames, filters, errors, and a driver whose interface does not exist. Tests with
// an interface run in a kernel with CAN (tests/drivers/vcan).
#include <doctest/doctest.h>

#ifdef __linux__

#include <linux/can.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "socketcan.hpp"
#include "support/notation.hpp"

namespace {

using co::SocketCan;
using co::SocketCanDriver;
using co::SocketCanStep;

std::string bytes_of(const can_frame& raw) {
  std::string text;
  for (const auto byte : raw.data) {
    text += "0123456789ABCDEF"[byte >> 4];
    text += "0123456789ABCDEF"[byte & 15];
  }
  return text;
}

can_frame raw_frame(canid_t id, std::uint8_t length) {
  can_frame raw{};
  raw.can_id = id;
  raw.can_dlc = length;
  const std::uint8_t data[8] = {0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88};
  std::memcpy(raw.data, data, sizeof data);
  return raw;
}

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

// Name of an interface that does not exist: it has the maximum length and no real interface uses it.
const char* const missing = "no-such-can-bus";

}  // namespace

TEST_CASE("socketcan: a sent frame has identifier, flags, length and data") {
  can_frame raw = co::to_socketcan(test::frame("601#2B17100064000000"));
  CHECK(raw.can_id == 0x601);
  CHECK(raw.can_dlc == 8);
  CHECK(bytes_of(raw) == "2B17100064000000");
  raw = co::to_socketcan(test::frame("1ABCDEF0#0102"));
  CHECK(raw.can_id == 0x9ABCDEF0);  // CAN_EFF_FLAG
  CHECK(raw.can_dlc == 2);
  raw = co::to_socketcan(test::frame("20000040#0000000000000000"));
  CHECK(raw.can_id == 0x20000040);  // CAN_ERR_FLAG
}

TEST_CASE("socketcan: a remote frame has a length and no data") {
  CO_IF_FRM frame{};
  frame.Identifier = CO_IF_FRM_RTR | 0x701u;
  frame.DLC = 1;
  frame.Data[0] = 0xAA;
  const can_frame raw = co::to_socketcan(frame);
  CHECK(raw.can_id == 0x40000701);
  CHECK(raw.can_dlc == 1);
  CHECK(bytes_of(raw) == "0000000000000000");
  const CO_IF_FRM back = co::from_socketcan(raw_frame(0x40000701, 1));
  CHECK(back.Identifier == 0x40000701);
  CHECK(back.DLC == 1);
  CHECK(back.Data[0] == 0);
}

TEST_CASE("socketcan: unused bytes are sent as 0") {
  CO_IF_FRM frame = test::frame("181#1122334455667788");
  frame.DLC = 3;
  CHECK(bytes_of(co::to_socketcan(frame)) == "1122330000000000");
  frame.DLC = 0;
  CHECK(bytes_of(co::to_socketcan(frame)) == "0000000000000000");
}

TEST_CASE("socketcan: DLC 9 to 15 mean 8 bytes") {
  CO_IF_FRM frame = test::frame("181#1122334455667788");
  for (const int dlc : {9, 15, 255}) {
    frame.DLC = static_cast<std::uint8_t>(dlc);
    CHECK(co::to_socketcan(frame).can_dlc == 8);
  }
  CHECK(co::from_socketcan(raw_frame(0x181, 15)).DLC == 8);
}

TEST_CASE("socketcan: a DLC above 15 is passed to the node without data, which counts it as malformed") {
  const CO_IF_FRM frame = co::from_socketcan(raw_frame(0x181, 64));
  CHECK(frame.DLC == 64);
  CHECK(frame.Data[0] == 0);
  CHECK(frame.Data[7] == 0);
}

TEST_CASE("socketcan: an identifier above 7FFh without flag is sent with 29 bits") {
  CO_IF_FRM frame = test::frame("181#11");
  frame.Identifier = 0x800;  // truncated to 11 bits it would be NMT
  CHECK(co::to_socketcan(frame).can_id == 0x80000800);
  frame.Identifier = 0x7FF;
  CHECK(co::to_socketcan(frame).can_id == 0x7FF);
  frame.Identifier = CO_IF_FRM_RTR | 0x1000u;
  CHECK(co::to_socketcan(frame).can_id == 0xC0001000);
}

TEST_CASE("socketcan: a received frame keeps every flag and its length") {
  CHECK(test::notation(co::from_socketcan(raw_frame(0x701, 1))) == "701#11");
  CHECK(test::notation(co::from_socketcan(raw_frame(0x9ABCDEF0, 8))) == "1ABCDEF0#1122334455667788");
  CHECK(test::notation(co::from_socketcan(raw_frame(0x40000701, 0))) == "701#R");
  CHECK(test::notation(co::from_socketcan(raw_frame(0x20000004, 8))) == "20000004#1122334455667788");
  const CO_IF_FRM frame = co::from_socketcan(raw_frame(0x701, 2));
  CHECK(frame.Data[1] == 0x22);
  CHECK(frame.Data[2] == 0);
  CHECK(frame.Data[7] == 0);
}

TEST_CASE("socketcan: filters match only their identifier in its format, in data and remote frames") {
  const std::uint32_t ids[] = {0x000, 0x601, CO_IF_FRM_EXT | 0x1ABCDEF0u};
  const std::vector<can_filter> filters = co::socketcan_filters(ids, 3);
  REQUIRE(filters.size() == 3);
  CHECK(filters[0].can_id == 0x000);
  CHECK(filters[0].can_mask == 0x800007FF);
  CHECK(filters[1].can_id == 0x601);
  CHECK(filters[1].can_mask == 0x800007FF);
  CHECK(filters[2].can_id == 0x9ABCDEF0);
  CHECK(filters[2].can_mask == 0x9FFFFFFF);
}

TEST_CASE("socketcan: a repeated identifier makes one filter; without identifiers there is none") {
  const std::uint32_t ids[] = {0x080, 0x080, 0x601, 0x080};
  CHECK(co::socketcan_filters(ids, 4).size() == 2);
  CHECK(co::socketcan_filters(nullptr, 0).empty());
}

TEST_CASE("socketcan: more identifiers than the kernel accepts disable the filter") {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < 513; ++id) {
    ids.push_back(id);
  }
  CHECK(co::socketcan_filters(ids.data(), 512).size() == 512);
  const std::vector<can_filter> open = co::socketcan_filters(ids.data(), 513);
  REQUIRE(open.size() == 1);
  CHECK(open[0].can_id == 0);
  CHECK(open[0].can_mask == 0);
  ids[512] = 0;  // 512 different identifiers
  CHECK(co::socketcan_filters(ids.data(), 513).size() == 512);
}

TEST_CASE("socketcan: a failure to open is reported as text with the interface") {
  CHECK(contains(co::socketcan_error(SocketCanStep::name, EINVAL, ""), "1 to 15 characters"));
  CHECK(
      co::socketcan_error(SocketCanStep::socket, EAFNOSUPPORT, "can0") ==
      "CAN interface 'can0': this kernel has no CAN sockets (try: modprobe can-raw; a container has none: use slcan)");
  CHECK(contains(co::socketcan_error(SocketCanStep::socket, EPROTONOSUPPORT, "can0"), "no CAN sockets"));
  CHECK(contains(co::socketcan_error(SocketCanStep::socket, EPERM, "can0"), "no permission"));
  CHECK(contains(co::socketcan_error(SocketCanStep::bind, EACCES, "can0"), "no permission"));
  CHECK(contains(co::socketcan_error(SocketCanStep::interface, ENODEV, "can7"), "'can7': no such interface"));
  CHECK(contains(co::socketcan_error(SocketCanStep::bind, ENODEV, "lo"), "'lo': not a CAN interface"));
  CHECK(contains(co::socketcan_error(SocketCanStep::socket, EMFILE, "can0"), "Too many open files"));
  CHECK(contains(co::socketcan_error(SocketCanStep::option, ENOPROTOOPT, "can0"), "Protocol not available"));
}

TEST_CASE("socketcan: an invalid interface name is refused before the kernel is called") {
  SocketCan can;
  CHECK_FALSE(can.open(""));
  CHECK(can.code() == EINVAL);
  CHECK_FALSE(can.open("sixteen-letters."));
  CHECK(contains(can.error(), "'sixteen-letters.': an interface name has 1 to 15 characters"));
  CHECK(can.fd() == -1);
}

TEST_CASE("socketcan: without the interface or CAN in the kernel opening fails with the reason") {
  SocketCan can;
  CHECK_FALSE(can.open(missing));
  const bool no_can = contains(can.error(), "no CAN sockets");
  const bool no_interface = contains(can.error(), "no such interface");
  const bool told = no_can || no_interface;
  CHECK_MESSAGE(told, can.error());
  CHECK(can.code() != 0);
  CHECK(can.fd() == -1);
  CHECK_FALSE(can.up());
}

TEST_CASE("socketcan: an interface that is not CAN is refused") {
  SocketCan can;
  CHECK_FALSE(can.open("lo"));
  CHECK(can.fd() == -1);
  CHECK(can.code() != 0);
}

TEST_CASE("socketcan: without its interface a driver neither receives nor sends, and does not block") {
  SocketCan can;
  can.open(missing);
  SocketCanDriver.Init(&can);
  SocketCanDriver.Enable(&can, 250000);
  const std::uint32_t ids[] = {0x601};
  SocketCanDriver.Filter(&can, ids, 1);
  CO_IF_FRM frame = test::frame("701#00");
  CHECK(SocketCanDriver.Send(&can, &frame) == -1);
  CHECK(SocketCanDriver.Read(&can, &frame) == 0);
  SocketCanDriver.Reset(&can);
  CHECK(SocketCanDriver.Read(&can, &frame) == 0);
  CHECK_FALSE(can.error().empty());
  SocketCanDriver.Close(&can);
  CHECK(SocketCanDriver.Read(&can, &frame) == 0);
  CHECK(SocketCanDriver.Send(&can, &frame) == -1);
  CHECK(can.lost() == 0);
}

#endif
