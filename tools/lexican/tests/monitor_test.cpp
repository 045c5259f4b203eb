// SPDX-License-Identifier: Apache-2.0
// The words of the monitor for each service, by frames byte by byte.
#include "describe/monitor.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace lexican;
using namespace lexican::describe;
using Texts = std::vector<std::string>;

constexpr std::uint32_t remote = CO_IF_FRM_RTR;
constexpr std::uint32_t extended = CO_IF_FRM_EXT;
constexpr std::uint32_t error = CO_IF_FRM_ERROR;

/// Returns an event as "pdo 5 TPDO1 …", with "!" before a fault and "~" before a repetition.
std::string text_of(const Event& event) {
  return std::string(event.is_fault ? "!" : "") + (event.is_repeated ? "~" : "") +
         service_names[static_cast<unsigned>(event.service)] + ' ' + std::to_string(event.node) + ' ' + event.text;
}

/// Network with a monitor, and a frame each millisecond.
struct Bus {
  Network network;
  Texts events;
  std::vector<Micros> times;
  std::vector<Micros> durations;  // of SDO transfers
  Micros now = 0;
  std::string known;  // description of each device whose identity is known
  Texts identities;
  Monitor monitor;

  explicit Bus(const std::string& description = {})
      : network(of(description)),
        monitor(
            network,
            [this](const Event& event) {
              events.push_back(text_of(event));
              times.push_back(event.time);
              if (event.sdo != nullptr) {
                durations.push_back(event.sdo->time - event.sdo->begin);
              }
            },
            [this](std::uint8_t node, const Identity& identity) {
              identities.push_back(std::to_string(node) + ": " + std::to_string(identity.vendor) + ' ' +
                                   std::to_string(identity.product) + ' ' + std::to_string(identity.revision));
              if (!known.empty()) {
                network.describe(node, of(known).of(node));
              }
              return !known.empty();
            }) {}

  static Network of(const std::string& description) {
    Network network;
    if (!description.empty()) {
      char path[] = "/tmp/lexican-monitor-XXXXXX";
      close(mkstemp(path));
      std::ofstream(path) << description;
      std::string why;
      REQUIRE_MESSAGE(network.add(path, why), why);
      std::filesystem::remove(path);
    }
    return network;
  }

  /// Processes a frame 1 ms after the last one.
  void at(Micros time, std::uint32_t id, const Bytes& bytes) {
    host_bus::Entry entry;
    entry.time = now = time;
    entry.frame.Identifier = id;
    entry.frame.DLC = static_cast<std::uint8_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), entry.frame.Data);
    monitor.process(entry);
  }
  /// Returns the last event; "-" if the frame has none.
  std::string frame(std::uint32_t id, const Bytes& bytes = {}) {
    const std::size_t before = events.size();
    at(now + 1000, id, bytes);
    return events.size() == before ? "-" : events.back();
  }
  /// Writes an object of 1 or 4 bytes and returns the event.
  std::string write(std::uint8_t node, std::uint16_t index, std::uint8_t sub_index, std::uint32_t value, bool is_byte) {
    const Bytes key{static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8), sub_index};
    Bytes request{static_cast<std::uint8_t>(is_byte ? 0x2F : 0x23), key[0], key[1], key[2]};
    for (unsigned n = 0; n < 4; ++n) {
      request.push_back(static_cast<std::uint8_t>(value >> (8 * n)));
    }
    CHECK(frame(0x600U + node, request) == "-");
    return frame(0x580U + node, {0x60, key[0], key[1], key[2], 0, 0, 0, 0});
  }
};

/// Lets a master upload a sub-object of 1018h.
void identify(Bus& bus, std::uint8_t node, std::uint8_t sub_index, std::uint8_t value) {
  bus.frame(0x600U + node, {0x40, 0x18, 0x10, sub_index, 0, 0, 0, 0});
  bus.frame(0x580U + node, {0x43, 0x18, 0x10, sub_index, value, 0, 0, 0});
}

std::string variable(const std::string& section, const std::string& name, const std::string& type,
                     const std::string& value = {}, const std::string& more = {}) {
  return '[' + section + "]\nParameterName=" + name + "\nObjectType=0x7\nDataType=" + type +
         "\nAccessType=rw\nPDOMapping=1\nDefaultValue=" + value + '\n' + more;
}

std::string record(const std::string& section, const std::string& name, const Texts& values) {
  std::string text = '[' + section + "]\nParameterName=" + name +
                     "\nObjectType=0x9\nSubNumber=" + std::to_string(values.size()) + '\n';
  for (std::size_t n = 0; n < values.size(); ++n) {
    char sub[24];
    std::snprintf(sub, sizeof sub, "sub%zX", n);
    text += variable(section + sub, "Sub " + std::to_string(n), n == 0 ? "0x0005" : "0x0007", values[n]);
  }
  return text;
}

/// A drive of any node-ID.
const std::string& drive() {
  static const std::string text =
      "[FileInfo]\nFileName=a.eds\nEDSVersion=4.0\n[DeviceInfo]\nVendorName=Example\n" +
      variable("1008", "Device name", "0x0009") + variable("1017", "Heartbeat time", "0x0006") +
      record("1400", "RPDO 1", {"1", "$NODEID+0x200"}) + record("1401", "RPDO 2", {"1", "0x182"}) +
      record("1600", "RPDO 1 mapping", {"2", "0x00050008", "0x60400010"}) +
      record("1601", "RPDO 2 mapping", {"1", "0x60400010"}) + record("1800", "TPDO 1", {"1", "$NODEID+0x180"}) +
      record("1801", "TPDO 2", {"1", "$NODEID+0x80000280"}) + record("1802", "TPDO 3", {"1", "$NODEID+0x20001200"}) +
      record("1803", "TPDO 4", {"1", "0x0"}) + record("1A00", "TPDO 1 mapping", {"2", "0x60410010", "0x60640020"}) +
      record("1A01", "TPDO 2 mapping", {"3", "0x20000001", "0x20010001", "0x20020006"}) +
      record("1A02", "TPDO 3 mapping", {"1", "0x20030040"}) + record("1A03", "TPDO 4 mapping", {"0"}) +
      variable("2000", "Ready", "0x0001") + variable("2001", "Fault", "0x0001") + variable("2002", "Level", "0x0005") +
      variable("2003", "Uptime", "0x001B", {}, "Unit=us\n") + variable("6040", "Controlword", "0x0006") +
      variable("6041", "Statusword", "0x0006") + variable("6064", "Position", "0x0004", {}, "Unit=deg\nFactor=0.1\n");
  return text;
}

}  // namespace

TEST_CASE("monitor: NMT") {
  Bus bus;
  CHECK(bus.frame(0, {0x01, 0x05}) == "nmt 5 NMT start, node 5");
  CHECK(bus.frame(0, {0x02, 0x00}) == "nmt 0 NMT stop, all nodes");
  CHECK(bus.frame(0, {0x80, 0x7F}) == "nmt 127 NMT enter pre-operational, node 127");
  CHECK(bus.frame(0, {0x81, 0x80}) == "nmt 0 NMT reset node, node 128");
  CHECK(bus.frame(0, {0x82, 0x01}) == "nmt 1 NMT reset communication, node 1");
  CHECK(bus.frame(0, {0x03, 0x01}) == "nmt 1 NMT unknown command 03h, node 1");
  CHECK(bus.frame(0, {0x01}) == "nmt 0 NMT with 1 byte instead of 2: 000#01");
}

TEST_CASE("monitor: boot-up and heartbeat") {
  Bus bus;
  CHECK(bus.frame(0x705, {0x00}) == "state 5 boot-up");
  CHECK(bus.frame(0x705, {0x7F}) == "state 5 heartbeat: pre-operational");
  CHECK(bus.frame(0x705, {0x7F}) == "~state 5 heartbeat: pre-operational");
  CHECK(bus.frame(0x706, {0x7F}) == "state 6 heartbeat: pre-operational");
  CHECK(bus.frame(0x705, {0x05}) == "state 5 heartbeat: operational");
  CHECK(bus.frame(0x705, {0x05}) == "~state 5 heartbeat: operational");
  CHECK(bus.frame(0x705, {0x04}) == "state 5 heartbeat: stopped");
  CHECK(bus.frame(0x705, {0x00}) == "state 5 boot-up");
  CHECK(bus.frame(0x705, {0x00}) == "state 5 boot-up");  // boots in a loop
  CHECK(bus.frame(0x705, {0x03}) == "state 5 heartbeat: unknown state 03h");
  CHECK(bus.frame(0x705, {0x05, 0x00}) == "state 5 heartbeat with 2 bytes instead of 1: 705#0500");
  CHECK(bus.frame(0x700, {0x05}) == "other 0 unknown 700#05");
}

TEST_CASE("monitor: node guarding") {
  Bus bus;
  CHECK(bus.frame(0x705 | remote) == "state 5 node guarding request");
  CHECK(bus.frame(0x705, {0x05}) == "state 5 node guarding: operational, toggle 0");
  CHECK(bus.frame(0x705 | remote) == "~state 5 node guarding request");
  CHECK(bus.frame(0x705, {0x85}) == "~state 5 node guarding: operational, toggle 1");
  CHECK(bus.frame(0x705 | remote) == "~state 5 node guarding request");
  CHECK(bus.frame(0x705 | remote) == "state 5 node guarding request");  // the last one has no answer
  CHECK(bus.frame(0x705, {0x04}) == "state 5 node guarding: stopped, toggle 0");
  CHECK(bus.frame(0x706, {0xFF}) == "state 6 node guarding: pre-operational, toggle 1");
  CHECK(bus.frame(0x705 | remote) == "~state 5 node guarding request");
  CHECK(bus.frame(0x705, {0x00}) == "state 5 boot-up");
}

TEST_CASE("monitor: SYNC and TIME") {
  Bus bus;
  CHECK(bus.frame(0x080) == "sync 0 SYNC");
  CHECK(bus.frame(0x080) == "~sync 0 SYNC");
  CHECK(bus.frame(0x080, {0x07}) == "~sync 0 SYNC, counter 7");
  CHECK(bus.frame(0x080, {1, 2}) == "sync 0 SYNC with 2 bytes instead of 0 or 1: 080#0102");
  CHECK(bus.frame(0x100, {0x80, 0xEE, 0x36, 0x00, 0x10, 0x27}) == "time 0 TIME 01:00:00.000, day 10000");
  CHECK(bus.frame(0x100, {1}) == "time 0 TIME with 1 byte instead of 6: 100#01");
}

TEST_CASE("monitor: EMCY") {
  Bus bus;
  CHECK(bus.frame(0x085, {0x10, 0x43, 0x09, 0, 0, 0, 0, 0}) == "!emcy 5 EMCY 4310h temperature, error register 09h");
  const std::pair<unsigned, const char*> codes[] = {
      {0x2310, "current on the output side"},
      {0x3210, "voltage inside the device"},
      {0x4210, "device temperature"},
      {0x5530, "data storage"},
      {0x6320, "data set"},
      {0x7121, "motor blocked"},
      {0x7305, "incremental sensor 1"},
      {0x8611, "following error"},
      {0x8612, "reference limit"},
      {0x8613, "positioning controller"},
      {0x8B00, "monitoring"},
  };
  for (const auto& [code, name] : codes) {
    char text[16];
    std::snprintf(text, sizeof text, "%04Xh", code);
    CHECK(bus.frame(0x085, {static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(code >> 8), 1, 0, 0, 0, 0, 0}) ==
          std::string("!emcy 5 EMCY ") + text + ' ' + name + ", error register 01h");
  }
  CHECK(bus.frame(0x085, {0x30, 0x81, 0x11, 0x7F, 0, 0, 0, 0}) ==
        "!emcy 5 EMCY 8130h heartbeat or life guarding missing, error register 11h, manufacturer-specific 7F 00 00 00 "
        "00");
  CHECK(bus.frame(0x085, {0, 0, 0, 0, 0, 0, 0, 0}) == "emcy 5 EMCY 0000h error reset, error register 00h");
  CHECK(bus.frame(0x085, {0x10, 0x43}) == "emcy 5 EMCY with 2 bytes instead of 8: 085#1043");
  CHECK(bus.frame(0x085 | remote, {1, 1, 0, 0, 0, 0, 0, 0}) == "emcy 5 remote frame 085#R8");
}

TEST_CASE("monitor: LSS, GFC and SRDO") {
  Bus bus;
  CHECK(bus.frame(0x7E5, {0x04, 0x01, 0, 0, 0, 0, 0, 0}) == "lss 0 LSS switch all to configuration");
  CHECK(bus.frame(0x7E5, {0x11, 0x06, 0, 0, 0, 0, 0, 0}) == "lss 0 LSS configure node-ID 6");
  CHECK(bus.frame(0x7E4, {0x11, 0x00, 0, 0, 0, 0, 0, 0}) == "lss 0 LSS answer: configure node-ID done");
  CHECK(bus.frame(0x7E5, {0x11}) == "lss 0 LSS with 1 byte instead of 8: 7E5#11");
  CHECK(bus.frame(0x001) == "safety 0 GFC, global fail-safe command");
  CHECK(bus.frame(0x101, {0x01, 0x02}) == "safety 0 SRDO 101h plain 01 02");
  CHECK(bus.frame(0x102, {0xFE, 0xFD}) == "safety 0 SRDO 101h inverse FE FD");
}

TEST_CASE("monitor: messages of no service") {
  Bus bus;
  CHECK(bus.frame(0x071, {0x11, 0x22}) == "other 0 unknown 071#1122");
  CHECK(bus.frame(0x580, {0x11}) == "other 0 unknown 580#11");
  CHECK(bus.frame(0x6FF, {0x11}) == "other 0 unknown 6FF#11");
  CHECK(bus.frame(0x00000085 | extended, {0, 0, 0, 0, 0, 0, 0, 0}) == "other 0 unknown 00000085#0000000000000000");
  CHECK(bus.frame(0x605, {0x40}) == "sdo 5 SDO with 1 byte instead of 8: 605#40");
  CHECK(bus.frame(0x605 | remote) == "sdo 5 remote frame 605#R");
}

TEST_CASE("monitor: a DLC of 9 to 15 stands for 8 bytes") {
  Bus bus;
  host_bus::Entry entry;
  entry.frame.Identifier = 0x085;
  entry.frame.DLC = 15;
  bus.monitor.process(entry);
  CHECK(bus.events == Texts{"emcy 5 EMCY 0000h error reset, error register 00h"});
}

TEST_CASE("monitor: PDOs without a description") {
  Bus bus;
  CHECK(bus.frame(0x185, {0x37, 0x02}) == "pdo 5 TPDO1 37 02");
  CHECK(bus.frame(0x505, {0x01}) == "pdo 5 RPDO4 01");
  CHECK(bus.frame(0x285) == "pdo 5 TPDO2");
  CHECK(bus.frame(0x185 | remote) == "pdo 5 remote frame 185#R");
}

TEST_CASE("monitor: PDOs by a description") {
  Bus bus(drive());
  CHECK(bus.frame(0x185, {0x37, 0x02, 0xB4, 0x04, 0, 0}) == "pdo 5 TPDO1 Statusword = 567, Position = 120.4 deg");
  CHECK(bus.frame(0x186, {0x37, 0x02, 0xFF, 0xFF, 0xFF, 0xFF}) == "pdo 6 TPDO1 Statusword = 567, Position = -0.1 deg");
  CHECK(bus.frame(0x185 | remote) == "pdo 5 TPDO1 requested");
  CHECK(bus.frame(0x205, {0x99, 0x0F, 0x00}) == "pdo 5 RPDO1 Controlword = 15");  // behind a dummy entry
  CHECK(bus.frame(0x185, {0x37, 0x02, 0xB4, 0x04, 0, 0, 0xAA, 0xBB}) ==
        "pdo 5 TPDO1 Statusword = 567, Position = 120.4 deg, not mapped: AA BB");
  CHECK(bus.frame(0x185, {0x37, 0x02, 0xB4}) ==
        "pdo 5 TPDO1 Statusword = 567, too short for 6064h Position, whole data: 37 02 B4");
  CHECK(bus.frame(0x185) == "pdo 5 TPDO1 too short for 6041h Statusword, no data");
  CHECK(bus.frame(0x1205 | extended, {1, 0, 0, 0, 0, 0, 0, 0x80}) == "pdo 5 TPDO3 Uptime = 9223372036854775809 us");
  CHECK(bus.frame(0x285, {0x00}) == "pdo 5 TPDO2 00");                 // not valid by the description
  CHECK(bus.frame(0x000, {0x01, 0x05}) == "nmt 5 NMT start, node 5");  // 0 is no COB-ID of a PDO
  // RPDO2 of all nodes consumes TPDO1 of node 2: the event is that of the sender.
  CHECK(bus.frame(0x182, {0x37, 0x02, 0, 0, 0, 0}) == "pdo 2 TPDO1 Statusword = 567, Position = 0 deg");
}

/// Returns the values of a frame as "TPDO1 of 5: 6064h Position 12.3".
std::string values_in(const Bus& bus, std::uint32_t id, const Bytes& bytes, std::uint8_t node = 0) {
  CO_IF_FRM frame{id, {}, static_cast<std::uint8_t>(bytes.size())};
  std::copy(bytes.begin(), bytes.end(), frame.Data);
  const std::optional<PdoContent> content = bus.monitor.values_of(frame, node);
  if (!content) {
    return "-";
  }
  std::string text = std::string(content->is_transmit ? "TPDO" : "RPDO") + std::to_string(content->number) + " of " +
                     std::to_string(content->node) + ':';
  for (const PdoValue& value : content->values) {
    text += ' ' + key_of(value.index, value.sub_index, false) + ' ' + value.name + " \"" + value.text + "\" " +
            (value.number ? std::to_string(*value.number) : "-") + ';';
  }
  return text;
}

TEST_CASE("monitor: the values of a PDO as numbers") {
  Bus bus(drive());
  CHECK(values_in(bus, 0x185, {0x37, 0x02, 0xB4, 0x04, 0, 0}) ==
        "TPDO1 of 5: 6041h Statusword \"567\" 567.000000; 6064h Position \"120.4 deg\" 120.400000;");
  CHECK(values_in(bus, 0x185, {0x37, 0x02, 0xB4}) == "TPDO1 of 5: 6041h Statusword \"567\" 567.000000;");
  CHECK(values_in(bus, 0x205, {0x99, 0x0F, 0x00}) == "RPDO1 of 5: 6040h Controlword \"15\" 15.000000;");  // no dummy
  CHECK(values_in(bus, 0x185 | remote, {}) == "-");
  CHECK(values_in(bus, 0x285, {0x01}) == "-");  // not valid
  CHECK(values_in(bus, 0x705, {0x05}) == "-");
  // TPDO1 of node 2 is RPDO2 of all nodes.
  CHECK(values_in(bus, 0x182, {0x37, 0x02, 0, 0, 0, 0}, 2).substr(0, 11) == "TPDO1 of 2:");
  CHECK(values_in(bus, 0x182, {0x37, 0x02, 0, 0, 0, 0}, 7) == "RPDO2 of 7: 6040h Controlword \"567\" 567.000000;");
  bus.write(9, 0x1A00, 1, 0x21000010, false);
  bus.write(9, 0x1A00, 0, 1, true);
  CHECK(values_in(bus, 0x189, {0x34, 0x12}) == "TPDO1 of 9: 2100h 2100h:00 \"1234h\" 4660.000000;");
}

TEST_CASE("monitor: entries of single bits") {
  Bus bus(drive());
  CHECK(bus.write(5, 0x1801, 1, 0x285, false) == "sdo 5 write 1801h:01 TPDO 2, Sub 1 = 00000285h");
  CHECK(bus.frame(0x285, {0xAE}) == "pdo 5 TPDO2 Ready = 0, Fault = 1, Level = 43");
  CHECK(bus.frame(0x285, {0x01, 0xAA}) == "pdo 5 TPDO2 Ready = 1, Fault = 0, Level = 0, not mapped: AA");
}

TEST_CASE("monitor: PDOs after changes of COB-ID and mapping") {
  Bus bus(drive());
  bus.write(5, 0x1800, 1, 0x80000185, false);
  CHECK(bus.frame(0x185, {1, 2}) == "pdo 5 TPDO1 01 02");
  CHECK(bus.write(5, 0x1A00, 0, 0, true) == "sdo 5 write 1A00h:00 TPDO 1 mapping, Sub 0 = 0");
  CHECK(bus.write(5, 0x1A00, 1, 0x60400010, false) == "sdo 5 write 1A00h:01 TPDO 1 mapping, Sub 1 = 60400010h");
  bus.write(5, 0x1A00, 0, 1, true);
  bus.write(5, 0x1800, 1, 0x3A5, false);
  CHECK(bus.frame(0x3A5, {1, 2}) == "pdo 5 TPDO1 Controlword = 513");
  CHECK(bus.frame(0x185, {1, 2}) == "pdo 5 TPDO1 01 02");
  // A read changes nothing on the device, but shows what it has.
  bus.frame(0x606, {0x40, 0x00, 0x18, 0x01, 0, 0, 0, 0});
  CHECK(bus.frame(0x586, {0x43, 0x00, 0x18, 0x01, 0xA6, 0x03, 0, 0}) ==
        "sdo 6 read 1800h:01 TPDO 1, Sub 1 = 000003A6h");
  CHECK(bus.frame(0x3A6, {1, 2, 3, 0, 0, 0}) == "pdo 6 TPDO1 Statusword = 513, Position = 0.3 deg");
  // A refused write changes nothing.
  bus.frame(0x606, {0x23, 0x00, 0x18, 0x01, 0xA7, 0x03, 0, 0});
  CHECK(bus.frame(0x586, {0x80, 0x00, 0x18, 0x01, 0x22, 0, 0, 0x08}).substr(0, 55) ==
        "!sdo 6 write 1800h:01 TPDO 1, Sub 1 refused: 0800 0022h");
  CHECK(bus.frame(0x3A6, {1, 2, 3, 0, 0, 0}) == "pdo 6 TPDO1 Statusword = 513, Position = 0.3 deg");
}

TEST_CASE("monitor: PDOs that only the bus describes") {
  Bus bus;
  bus.write(5, 0x1800, 1, 0x1A5, false);
  CHECK(bus.frame(0x1A5, {1, 2}) == "pdo 5 TPDO1 01 02");
  bus.write(5, 0x1A00, 2, 0x20010008, false);
  bus.write(5, 0x1A00, 0, 2, true);
  CHECK(bus.frame(0x1A5, {1, 2}) == "pdo 5 TPDO1 01 02");  // the first entry is not known
  bus.write(5, 0x1A00, 1, 0x20000008, false);
  CHECK(bus.frame(0x1A5, {1, 2}) == "pdo 5 TPDO1 2000h:00 = 01h, 2001h:00 = 02h");
  bus.write(5, 0x1A00, 0, 3, true);
  CHECK(bus.frame(0x1A5, {1, 2, 3}) == "pdo 5 TPDO1 2000h:00 = 01h, 2001h:00 = 02h, 03");
  bus.write(5, 0x1A00, 0, 0xFE, true);  // multiplexed
  CHECK(bus.frame(0x1A5, {1, 2, 3}) == "pdo 5 TPDO1 01 02 03");
  bus.write(6, 0x1400, 1, 0x085, false);
  CHECK(bus.frame(0x085, {1, 2, 3}) == "pdo 6 RPDO1 01 02 03");
  for (const std::uint32_t cob_id : {0x000U, 0x07FU, 0x101U, 0x180U, 0x585U, 0x605U, 0x705U, 0x7E5U}) {
    bus.write(6, 0x1400, 1, cob_id, false);  // restricted
    const std::string text = bus.frame(cob_id, {1, 2, 3});
    CHECK_MESSAGE(text.find("RPDO1") == std::string::npos, text);
  }
}

TEST_CASE("monitor: PDOs of a device whose identity was read") {
  Bus bus;
  bus.known = drive();
  bus.write(5, 0x1801, 1, 0x80000285, false);
  identify(bus, 5, 1, 0xB7);
  CHECK(bus.identities.empty());
  CHECK(bus.frame(0x185, {0x37, 0x02, 0xB4, 0x04, 0, 0}) == "pdo 5 TPDO1 37 02 B4 04 00 00");
  identify(bus, 5, 2, 0x21);
  CHECK(bus.identities == Texts{"5: 183 33 0"});
  CHECK(bus.frame(0x185, {0x37, 0x02, 0xB4, 0x04, 0, 0}) == "pdo 5 TPDO1 Statusword = 567, Position = 120.4 deg");
  CHECK(bus.frame(0x285, {0x01}) == "pdo 5 TPDO2 01");  // the bus has shown that it is not valid
  CHECK(bus.frame(0x186, {0x37, 0x02, 0xB4, 0x04, 0, 0}) == "pdo 6 TPDO1 37 02 B4 04 00 00");
  identify(bus, 5, 3, 4);
  CHECK(bus.identities == Texts{"5: 183 33 0", "5: 183 33 4"});
  CHECK(bus.frame(0x185, {0x37, 0x02, 0xB4, 0x04, 0, 0}) == "pdo 5 TPDO1 Statusword = 567, Position = 120.4 deg");
  // Other values than those of a device: a write, a wrong size, a fourth sub-object, and values that go on changing.
  bus.write(6, 0x1018, 1, 1, false);
  bus.write(6, 0x1018, 2, 1, false);
  bus.frame(0x607, {0x40, 0x18, 0x10, 1, 0, 0, 0, 0});
  bus.frame(0x587, {0x4F, 0x18, 0x10, 1, 1, 0, 0, 0});
  identify(bus, 7, 2, 1);
  identify(bus, 7, 4, 1);
  CHECK(bus.identities.size() == 2);
  for (std::uint8_t product = 1; product < 100; ++product) {
    identify(bus, 5, 2, product);
  }
  CHECK(bus.identities.size() == 4);
}

TEST_CASE("monitor: SDO transfers of two devices at the same time") {
  Bus bus(drive());
  CHECK(bus.frame(0x605, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0}) == "-");
  CHECK(bus.frame(0x606, {0x2B, 0x17, 0x10, 0, 0xE8, 0x03, 0, 0}) == "-");
  CHECK(bus.frame(0x585, {0x41, 0x08, 0x10, 0, 6, 0, 0, 0}) == "-");
  CHECK(bus.frame(0x605, {0x60, 0, 0, 0, 0, 0, 0, 0}) == "-");
  CHECK(bus.frame(0x586, {0x60, 0x17, 0x10, 0, 0, 0, 0, 0}) == "sdo 6 write 1017h Heartbeat time = 1000");
  CHECK(bus.frame(0x585, {0x03, 'S', 'D', '-', '4', '0', '0', 0}) == "sdo 5 read 1008h Device name = \"SD-400\"");
}

TEST_CASE("monitor: an SDO answer after 0.6 ms") {
  Bus bus;
  bus.at(10'000, 0x605, {0x40, 0x17, 0x10, 0, 0, 0, 0, 0});
  bus.at(10'600, 0x585, {0x4B, 0x17, 0x10, 0, 0xE8, 0x03, 0, 0});
  CHECK(bus.events == Texts{"sdo 5 read 1017h:00 producer heartbeat time = 1000"});
  CHECK(bus.times == std::vector<Micros>{10'600});
  CHECK(bus.durations == std::vector<Micros>{600});
}

TEST_CASE("monitor: SDO aborts") {
  Bus bus(drive());
  bus.frame(0x605, {0x2B, 0x40, 0x60, 0, 0x0F, 0, 0, 0});
  CHECK(bus.frame(0x585, {0x80, 0x40, 0x60, 0, 0x02, 0, 0x01, 0x06}) ==
        "!sdo 5 write 6040h Controlword refused: 0601 0002h object is read-only");
  bus.frame(0x605, {0x40, 0x40, 0x60, 0, 0, 0, 0, 0});
  CHECK(bus.frame(0x605, {0x80, 0x40, 0x60, 0, 0, 0, 0x04, 0x05}) ==
        "!sdo 5 read 6040h Controlword aborted by the client: 0504 0000h protocol timed out");
  CHECK(bus.frame(0x585, {0x80, 0x40, 0x60, 0, 0, 0, 0x04, 0x05}) ==
        "!sdo 5 SDO transfer of 6040h Controlword aborted by the server: 0504 0000h protocol timed out");
}

TEST_CASE("monitor: an expedited transfer without size has the size of the type") {
  Bus bus(drive());
  bus.frame(0x605, {0x40, 0x17, 0x10, 0, 0, 0, 0, 0});
  CHECK(bus.frame(0x585, {0x42, 0x17, 0x10, 0, 0xE8, 0x03, 0, 0}) == "sdo 5 read 1017h Heartbeat time = 1000");
  Bus other;
  other.frame(0x605, {0x40, 0x17, 0x10, 0, 0, 0, 0, 0});
  CHECK(other.frame(0x585, {0x42, 0x17, 0x10, 0, 0xE8, 0x03, 0, 0}) ==
        "sdo 5 read 1017h:00 producer heartbeat time = 1000");
  other.frame(0x605, {0x40, 0x00, 0x20, 0, 0, 0, 0, 0});
  CHECK(other.frame(0x585, {0x42, 0x00, 0x20, 0, 0xE8, 0x03, 0, 0}) == "sdo 5 read 2000h:00 = 000003E8h");
  CHECK(other.write(5, 0x1010, 1, 0x65766173, false) == "sdo 5 write 1010h:01 store parameters = 65766173h (save)");
}

TEST_CASE("monitor: frames of SDO without a transfer") {
  Bus bus;
  CHECK(bus.frame(0x585, {0x4B, 0x17, 0x10, 0, 0xE8, 0x03, 0, 0}) == "sdo 5 SDO answer: 1017h:00 = 03E8h");
  bus.frame(0x605, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
  CHECK(bus.frame(0x585, {0x4B, 0x17, 0x10, 0, 0xE8, 0x03, 0, 0}) == "sdo 5 SDO answer: 1017h:00 = 03E8h");  // late
  CHECK(bus.frame(0x585, {0x43, 0x00, 0x10, 0, 0x92, 0x01, 0, 0}) == "sdo 5 read 1000h:00 device type = 00000192h");
}

TEST_CASE("monitor: large and empty SDO transfers") {
  Bus bus;
  bus.frame(0x605, {0x40, 0x03, 0x20, 0, 0, 0, 0, 0});
  bus.frame(0x585, {0x41, 0x03, 0x20, 0, 0, 0, 0, 0});
  for (unsigned n = 0; n < 10; ++n) {
    CHECK(bus.frame(0x605, {static_cast<std::uint8_t>(n % 2 == 0 ? 0x60 : 0x70), 0, 0, 0, 0, 0, 0, 0}) == "-");
    const auto command = static_cast<std::uint8_t>((n % 2 == 0 ? 0x00 : 0x10) | (n == 9 ? 1 : 0));
    bus.frame(0x585, {command, 0xFF, 0, 0, 0, 0, 0, 0});
  }
  REQUIRE(bus.events.size() == 1);
  CHECK(bus.events[0].substr(0, 38) == "sdo 5 read 2003h:00 = FF 00 00 00 00 0");
  CHECK(bus.events[0].substr(bus.events[0].size() - 17) == "FF ... (70 bytes)");
  bus.frame(0x605, {0x20, 0x03, 0x20, 0, 0, 0, 0, 0});
  bus.frame(0x585, {0x60, 0x03, 0x20, 0, 0, 0, 0, 0});
  bus.frame(0x605, {0x0F, 0, 0, 0, 0, 0, 0, 0});
  CHECK(bus.frame(0x585, {0x20, 0, 0, 0, 0, 0, 0, 0}) == "sdo 5 write 2003h:00 = no data");
  bus.frame(0x605, {0xC0, 0x50, 0x1F, 1, 0, 0, 0, 0});
  bus.frame(0x585, {0xA0, 0x50, 0x1F, 1, 127, 0, 0, 0});
  for (unsigned block = 0; block < 6; ++block) {
    for (unsigned n = 1; n <= 127; ++n) {
      CHECK(bus.frame(0x605, {static_cast<std::uint8_t>(n | (block == 5 && n == 127 ? 0x80U : 0U)), 0, 0, 0, 0, 0, 0,
                              0}) == "-");
    }
    CHECK(bus.frame(0x585, {0xA2, 127, 127, 0, 0, 0, 0, 0}) == "-");
  }
  bus.frame(0x605, {0xC1, 0, 0, 0, 0, 0, 0, 0});
  CHECK(bus.frame(0x585, {0xA1, 0, 0, 0, 0, 0, 0, 0}) == "sdo 5 write 1F50h:01 program data, 5334 bytes");
}

TEST_CASE("monitor: SDO requests without an answer") {
  Bus bus;
  bus.at(1'000'000, 0x605, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
  bus.at(1'500'000, 0x606, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0});
  bus.at(1'501'000, 0x586, {0x41, 0x08, 0x10, 0, 9, 0, 0, 0});
  bus.at(2'000'000, 0x080, {});
  bus.at(2'000'001, 0x080, {});
  bus.monitor.expire(2'501'000);
  CHECK(bus.events == Texts{"sync 0 SYNC", "!sdo 5 read 1000h:00 device type: no answer", "~sync 0 SYNC"});
  bus.monitor.expire(2'501'001);
  CHECK(bus.events.back() == "!sdo 6 read 1008h:00 manufacturer device name: not completed");
  CHECK(bus.times == std::vector<Micros>{2'000'000, 2'000'001, 2'000'001, 2'501'001});
}

TEST_CASE("monitor: transfers that are open at the end") {
  Bus bus;
  bus.at(1'000'000, 0x605, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
  bus.at(1'000'500, 0x606, {0x40, 0x01, 0x10, 0, 0, 0, 0, 0});
  bus.monitor.finish();
  CHECK(bus.events ==
        Texts{"!sdo 5 read 1000h:00 device type: no answer", "!sdo 6 read 1001h:00 error register: no answer"});
  bus.monitor.finish();
  CHECK(bus.events.size() == 2);
}

TEST_CASE("monitor: an SDO request without an answer is one event, also if the client aborts it afterwards") {
  Bus bus;
  const Bytes abort = {0x80, 0x17, 0x10, 0, 0, 0, 0x04, 0x05};
  bus.at(1'000'000, 0x605, {0x40, 0x17, 0x10, 0, 0, 0, 0, 0});
  bus.at(2'000'001, 0x605, abort);
  CHECK(bus.events == Texts{"!sdo 5 read 1017h:00 producer heartbeat time: no answer"});
  CHECK(bus.frame(0x605, abort) ==
        "!sdo 5 SDO transfer of 1017h:00 producer heartbeat time aborted by the client: 0504 0000h protocol timed out");
  // An abort of another object, of the server, and within the time.
  bus.at(4'000'000, 0x605, {0x40, 0x17, 0x10, 0, 0, 0, 0, 0});
  bus.at(6'000'000, 0x605, {0x80, 0x18, 0x10, 1, 0, 0, 0x04, 0x05});
  CHECK(bus.events.back() ==
        "!sdo 5 SDO transfer of 1018h:01 vendor-ID aborted by the client: 0504 0000h protocol timed out");
  bus.at(7'000'000, 0x605, {0x40, 0x17, 0x10, 0, 0, 0, 0, 0});
  bus.at(8'000'001, 0x585, abort);
  CHECK(bus.events.back() ==
        "!sdo 5 SDO transfer of 1017h:00 producer heartbeat time aborted by the server: 0504 0000h protocol timed out");
  bus.at(9'000'000, 0x605, {0x40, 0x17, 0x10, 0, 0, 0, 0, 0});
  bus.at(10'000'000, 0x605, abort);
  CHECK(bus.events.back() ==
        "!sdo 5 read 1017h:00 producer heartbeat time aborted by the client: 0504 0000h protocol timed out");
  CHECK(bus.events.size() == 7);
}

namespace {

/// Requests 1000h of the node-IDs 1 to \a last, 10 ms apart. Nodes 5 and 7 answer, the latter with an abort.
void scan(Bus& bus, Micros begin, unsigned last = 127) {
  for (unsigned node = 1; node <= last; ++node) {
    bus.at(begin + node * 10'000, 0x600 + node, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
    if (node == 5) {
      bus.frame(0x585, {0x43, 0x00, 0x10, 0, 0x92, 0x01, 0, 0});
    } else if (node == 7) {
      bus.frame(0x587, {0x80, 0x00, 0x10, 0, 0, 0, 0x02, 0x06});
    }
  }
}

const Texts answers = {"sdo 5 read 1000h:00 device type = 00000192h",
                       "!sdo 7 read 1000h:00 device type refused: 0602 0000h object does not exist"};
const std::string scanned = "sdo 0 scan: 1000h requested at 127 node-IDs, 2 answered";

}  // namespace

TEST_CASE("monitor: the requests of a scan without an answer are one event") {
  const Texts expected = {answers[0], answers[1], scanned};
  Bus bus;
  scan(bus, 1'000'000);
  bus.monitor.expire(3'269'999);
  CHECK(bus.events == answers);
  SUBCASE("by the time") { bus.monitor.expire(3'270'001); }
  SUBCASE("by the next frame") {
    bus.at(3'270'001, 0x081, {0, 0, 0, 0, 0, 0, 0, 0});
    CHECK(bus.events.back() == "emcy 1 EMCY 0000h error reset, error register 00h");
    bus.events.pop_back();
  }
  SUBCASE("at the end of the log") { bus.monitor.finish(); }
  CHECK(bus.events == expected);
}

TEST_CASE("monitor: a second scan at once, and a request after a scan") {
  Bus bus;
  scan(bus, 1'000'000);
  scan(bus, 2'280'000);
  bus.monitor.expire(9'000'000);
  CHECK(bus.events == Texts{answers[0], answers[1], scanned, answers[0], answers[1], scanned});
  bus.at(10'000'000, 0x609, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
  bus.monitor.expire(12'000'000);
  CHECK(bus.events.back() == "!sdo 9 read 1000h:00 device type: no answer");
  CHECK(bus.events.size() == 7);
}

TEST_CASE("monitor: requests of 1000h from a few nodes, or with an answer of each, are no scan") {
  Bus bus;
  scan(bus, 1'000'000, 15);
  bus.monitor.expire(9'000'000);
  CHECK(bus.events.size() == 15);
  CHECK(bus.events[2] == "!sdo 1 read 1000h:00 device type: no answer");
  bus.events.clear();
  for (unsigned node = 1; node <= 127; ++node) {
    bus.frame(0x600 + node, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
    bus.frame(0x580 + node, {0x43, 0x00, 0x10, 0, 0x92, 0x01, 0, 0});
  }
  bus.monitor.finish();
  CHECK(bus.events.size() == 127);
  CHECK(bus.events.back() == "sdo 127 read 1000h:00 device type = 00000192h");
}

TEST_CASE("monitor: a scan whose client aborts each request") {
  Bus bus;
  for (unsigned node = 1; node <= 20; ++node) {
    bus.frame(0x600 + node, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
  }
  for (unsigned node = 1; node <= 20; ++node) {
    CHECK(bus.frame(0x600 + node, {0x80, 0x00, 0x10, 0, 0, 0, 0x04, 0x05}) == "-");
  }
  bus.monitor.finish();
  CHECK(bus.events == Texts{"sdo 0 scan: 1000h requested at 20 node-IDs, 0 answered"});
}

TEST_CASE("monitor: error frames of SocketCAN") {
  Bus bus;
  CHECK(bus.frame(0x020 | error, {0, 0, 0, 0, 0, 0, 0, 0}) == "!error 0 bus: nobody acknowledges");
  CHECK(bus.frame(0x020 | error, {0, 0, 0, 0, 0, 0, 0, 0}) == "!~error 0 bus: nobody acknowledges");
  CHECK(bus.frame(0x004 | error, {0, 0x20, 0, 0, 0, 0, 128, 0}) == "!error 0 bus: error passive (TEC 128, REC 0)");
  CHECK(bus.frame(0x004 | error, {0, 0x20, 0, 0, 0, 0, 136, 0}) == "!~error 0 bus: error passive (TEC 136, REC 0)");
  CHECK(bus.frame(0x004 | error, {0, 0x08, 0, 0, 0, 0, 96, 0}) ==
        "!error 0 bus: error warning level reached (TEC 96, REC 0)");
  CHECK(bus.frame(0x004 | error, {0, 0x40, 0, 0, 0, 0, 95, 0}) == "error 0 bus: error active again (TEC 95, REC 0)");
  CHECK(bus.frame(0x004 | error, {0, 0x01, 0, 0, 0, 0, 0, 0}) ==
        "!error 0 bus: receive queue of the controller overflowed (TEC 0, REC 0)");
  CHECK(bus.frame(0x004 | error, {0, 0, 0, 0, 0, 0, 0, 0}) ==
        "!error 0 bus: controller problem, unspecified (TEC 0, REC 0)");
  CHECK(bus.frame(0x040 | error, {}) == "!error 0 bus: bus-off");
  CHECK(bus.frame(0x100 | error, {}) == "error 0 bus: controller restarted");
  CHECK(bus.frame(0x288 | error, {0, 0, 0x04, 0, 0, 0, 8, 1}) == "!error 0 bus: bus error (TEC 8, REC 1)");
  CHECK(bus.frame(0x800 | error, {}) == "!error 0 bus: unknown error");
  bus.now += 1'000'000;
  CHECK(bus.frame(0x800 | error, {}) == "!error 0 bus: unknown error");  // news after a second
}

TEST_CASE("monitor: statistics") {
  Bus bus;
  CHECK(bus.monitor.statistics().load(500'000) == 0);
  // SOF, 11 bits of the identifier, RTR, IDE, r0, 4 of the DLC, 8 of data, CRC 111100010010111, 2 stuff bits,
  // 10 bits from the CRC delimiter to the end of frame, 3 of intermission.
  constexpr std::uint64_t bits = 1 + 11 + 3 + 4 + 8 + 15 + 2 + 10 + 3;
  bus.at(1'000'000, 0x555, {0x55});
  CHECK(bus.monitor.statistics().bits == bits);
  CHECK(bus.monitor.statistics().load(500'000) == 0);  // no duration
  bus.at(1'001'000, 0x555, {0x55});
  CHECK(bus.monitor.statistics().frames == 2);
  CHECK(bus.monitor.statistics().bits == 2 * bits);
  CHECK(bus.monitor.statistics().load(0) == 0);
  CHECK(std::lround(1000 * bus.monitor.statistics().load(500'000)) == 22'800);  // per cent: 2 * 57 bits of 500 in 1 ms
  bus.at(1'001'000, 0x004 | error, {0, 0, 0, 0, 0, 0, 0, 0});
  bus.at(500'000, 0x555 | remote, {});  // time goes back
  const Statistics& statistics = bus.monitor.statistics();
  CHECK(statistics.frames == 3);
  CHECK(statistics.errors == 1);
  CHECK(statistics.first == 1'000'000);
  CHECK(statistics.last == 1'001'000);
  CHECK(statistics.by_identifier.at(0x555) == 2);
  CHECK(statistics.by_identifier.at(0x555 | remote) == 1);
}

TEST_CASE("monitor: the number of identifiers and of PDOs is bounded") {
  Bus bus;
  for (std::uint32_t n = 0; n < Statistics::most_identifiers + 100; ++n) {
    bus.frame(n | extended);
  }
  CHECK(bus.monitor.statistics().by_identifier.size() == Statistics::most_identifiers);
  bus.frame(7 | extended);
  CHECK(bus.monitor.statistics().frames == Statistics::most_identifiers + 101);
  CHECK(bus.monitor.statistics().by_identifier.at(7 | extended) == 2);
  CHECK(bus.monitor.statistics().others == 100);
}
