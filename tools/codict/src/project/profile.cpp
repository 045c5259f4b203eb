// SPDX-License-Identifier: Apache-2.0
#include "project/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace lexican::codict::project {

namespace {

constexpr int var = 7;
constexpr int array = 8;
constexpr int record = 9;

constexpr std::uint16_t i8 = 0x02;
constexpr std::uint16_t i32 = 0x04;
constexpr std::uint16_t u8 = 0x05;
constexpr std::uint16_t u16 = 0x06;
constexpr std::uint16_t u32 = 0x07;
constexpr std::uint16_t visible_string = 0x09;

struct Value {
  const char* name;
  std::uint16_t type;
  const char* access;
  const char* default_value;
  bool is_mappable = false;
  bool triggers_tpdo = false;
};

// Object. The first value of an array or record is sub-index 0.
struct Row {
  std::uint16_t index;
  int code;
  const char* name;
  std::vector<Value> values;
};

using Rows = std::vector<Row>;

constexpr const char* count_name = "Highest sub-index supported";

Row pdo_parameter(std::uint16_t index, const char* cob_id) {
  Row row{index,
          record,
          index < 0x1800 ? "RPDO 1 communication parameter" : "TPDO 1 communication parameter",
          {{count_name, u8, "const", index < 0x1800 ? "2" : "5"},
           {"COB-ID used by PDO", u32, "rw", cob_id},
           {"Transmission type", u8, "rw", "0xFF"}}};
  if (index >= 0x1800) {
    row.values.push_back({"Inhibit time", u16, "rw", "0"});
    row.values.push_back({"Compatibility entry", u8, "rw", "0"});
    row.values.push_back({"Event timer", u16, "rw", "500"});
  }
  return row;
}

Row pdo_mapping(std::uint16_t index, std::initializer_list<const char*> mapped) {
  Row row{index,
          record,
          index < 0x1800 ? "RPDO 1 mapping parameter" : "TPDO 1 mapping parameter",
          {{count_name, u8, "rw", mapped.size() == 1 ? "1" : "2"}}};
  for (const char* const object : mapped) {
    row.values.push_back({row.values.size() == 1 ? "Application object 1" : "Application object 2", u32, "rw", object});
  }
  return row;
}

// Returns the objects that every device has. [301: 7.5.2]
Rows communication_rows(const char* device_type, const char* name) {
  return {
      {0x1000, var, "Device type", {{"", u32, "ro", device_type}}},
      {0x1001, var, "Error register", {{"", u8, "ro", "0", true}}},
      {0x1018,
       record,
       "Identity object",
       {{count_name, u8, "const", "4"},
        {"Vendor-ID", u32, "ro", "0"},
        {"Product code", u32, "ro", "1"},
        {"Revision number", u32, "ro", "0x00010000"},
        {"Serial number", u32, "ro", "0"}}},
      {0x1003,
       array,
       "Pre-defined error field",
       {{"Number of errors", u8, "rw", "0"},
        {"Standard error field 1", u32, "ro", "0"},
        {"Standard error field 2", u32, "ro", "0"},
        {"Standard error field 3", u32, "ro", "0"},
        {"Standard error field 4", u32, "ro", "0"}}},
      {0x1005, var, "COB-ID SYNC message", {{"", u32, "rw", "0x80"}}},
      {0x1008, var, "Manufacturer device name", {{"", visible_string, "const", name}}},
      {0x1009, var, "Manufacturer hardware version", {{"", visible_string, "const", "1.0"}}},
      {0x100A, var, "Manufacturer software version", {{"", visible_string, "const", "0.1"}}},
      {0x1014, var, "COB-ID EMCY", {{"", u32, "rw", "$NODEID+0x80"}}},
      {0x1015, var, "Inhibit time EMCY", {{"", u16, "rw", "0"}}},
      {0x1016,
       array,
       "Consumer heartbeat time",
       {{count_name, u8, "const", "1"}, {"Consumer heartbeat time 1", u32, "rw", "0"}}},
      {0x1017, var, "Producer heartbeat time", {{"", u16, "rw", "1000"}}},
      {0x1200,
       record,
       "SDO server parameter",
       {{count_name, u8, "const", "2"},
        {"COB-ID client to server", u32, "const", "$NODEID+0x600"},
        {"COB-ID server to client", u32, "const", "$NODEID+0x580"}}},
      pdo_parameter(0x1400, "$NODEID+0x200"),
      pdo_parameter(0x1800, "$NODEID+0x180"),
  };
}

Rows plain_rows() {
  return {pdo_mapping(0x1600, {"0x20010010"}),
          pdo_mapping(0x1A00, {"0x20000010"}),
          {0x2000, var, "Measured value", {{"", u16, "ro", "0", true}}},
          {0x2001, var, "Setpoint", {{"", u16, "rww", "0", true}}}};
}

// Returns the objects of a device with 8 digital inputs and 8 digital outputs. [401]
Rows io_rows() {
  return {pdo_mapping(0x1600, {"0x62000108"}),
          pdo_mapping(0x1A00, {"0x60000108"}),
          {0x6000,
           array,
           "Read input 8-bit",
           {{count_name, u8, "const", "1"}, {"Digital inputs 1 to 8", u8, "ro", "0", true, true}}},
          {0x6200,
           array,
           "Write output 8-bit",
           {{count_name, u8, "const", "1"}, {"Digital outputs 1 to 8", u8, "rww", "0", true}}}};
}

// Returns the objects of a drive with profile velocity mode. [402]
Rows drive_rows() {
  return {pdo_mapping(0x1600, {"0x60400010", "0x60FF0020"}),
          pdo_mapping(0x1A00, {"0x60410010", "0x606C0020"}),
          {0x603F, var, "Error code", {{"", u16, "ro", "0", true}}},
          {0x6040, var, "Controlword", {{"", u16, "rww", "0", true}}},
          {0x6041, var, "Statusword", {{"", u16, "ro", "0x0040", true}}},
          {0x605A, var, "Quick stop option code", {{"", 0x03, "rw", "2"}}},
          {0x6060, var, "Modes of operation", {{"", i8, "rww", "3", true}}},
          {0x6061, var, "Modes of operation display", {{"", i8, "ro", "3", true}}},
          {0x606B, var, "Velocity demand value", {{"", i32, "ro", "0", true}}},
          {0x606C, var, "Velocity actual value", {{"", i32, "ro", "0", true}}},
          {0x6083, var, "Profile acceleration", {{"", u32, "rw", "1000"}}},
          {0x6084, var, "Profile deceleration", {{"", u32, "rw", "1000"}}},
          {0x60FF, var, "Target velocity", {{"", i32, "rww", "0", true}}},
          {0x6502, var, "Supported drive modes", {{"", u32, "ro", "0x00000004"}}}};
}

constexpr const char* trigger_note = "; codict: ignore eds-hidden-key -- CiA 306 has no key for the trigger of TPDOs\n";

std::string lines_of(const Value& value, std::string_view name) {
  return fmt::format(
      "ParameterName={}\nObjectType=0x7\nDataType=0x{:04X}\nAccessType={}\nDefaultValue={}\nPDOMapping={}\n{}", name,
      value.type, value.access, value.default_value, value.is_mappable ? 1 : 0,
      value.triggers_tpdo ? ";TPDODetectCos=1\n" : "");
}

std::string section_of(const Row& row) {
  if (row.code == var) {
    return fmt::format("\n[{:04X}]\n{}", row.index, lines_of(row.values.front(), row.name));
  }
  std::string sections = fmt::format("\n[{:04X}]\nParameterName={}\nObjectType=0x{}\nSubNumber={}\n", row.index,
                                     row.name, row.code, row.values.size());
  for (std::size_t sub = 0; sub < row.values.size(); ++sub) {
    const Value& value = row.values[sub];
    sections += fmt::format("\n{}[{:04X}sub{:X}]\n{}", value.triggers_tpdo ? trigger_note : "", row.index, sub,
                            lines_of(value, value.name));
  }
  return sections;
}

template <typename Belongs>
std::string list_of(std::string_view name, const Rows& rows, Belongs belongs) {
  std::string lines;
  std::size_t count = 0;
  for (const Row& row : rows) {
    if (belongs(row.index)) {
      lines += fmt::format("{}=0x{:04X}\n", ++count, row.index);
    }
  }
  std::string text_of_list = fmt::format("\n[{}]\nSupportedObjects={}\n{}", name, count, lines);
  for (const Row& row : rows) {
    text_of_list += belongs(row.index) ? section_of(row) : "";
  }
  return text_of_list;
}

constexpr const char* head = R"([FileInfo]
FileName={1}
FileVersion=1
FileRevision=0
EDSVersion=4.0
Description={2}
CreationTime=12:00AM
CreationDate=01-01-2026
CreatedBy=codict new
ModificationTime=12:00AM
ModificationDate=01-01-2026
ModifiedBy=codict new

[DeviceInfo]
VendorName=Example
VendorNumber=0x00000000
ProductName={0}
ProductNumber=0x00000001
RevisionNumber=0x00010000
OrderCode=
BaudRate_10=0
BaudRate_20=1
BaudRate_50=1
BaudRate_125=1
BaudRate_250=1
BaudRate_500=1
BaudRate_800=1
BaudRate_1000=1
SimpleBootUpMaster=0
SimpleBootUpSlave=1
Granularity=8
DynamicChannelsSupported=0
GroupMessaging=0
NrOfRXPDO=1
NrOfTXPDO=1
LSS_Supported=0

[DummyUsage]
Dummy0001=0
Dummy0002=1
Dummy0003=1
Dummy0004=1
Dummy0005=1
Dummy0006=1
Dummy0007=1
)";

struct Profile {
  const char* device_type;
  const char* about;
  Rows rows;
};

Profile profile_of(std::uint16_t number) {
  if (number == 401) {
    return {"0x00030191", "I/O module with 8 digital inputs and 8 digital outputs (CiA 401)", io_rows()};
  }
  if (number == 402) {
    return {"0x00020192", "Servo drive with profile velocity mode (CiA 402)", drive_rows()};
  }
  return {"0x00000000", "Device without a device profile (CiA 301)", plain_rows()};
}

}  // namespace

std::string profile_eds(std::uint16_t profile, std::string_view name, std::string_view file_name) {
  const Profile parts = profile_of(profile);
  const std::string device_name(name);
  Rows rows = communication_rows(parts.device_type, device_name.c_str());
  rows.insert(rows.end(), parts.rows.begin(), parts.rows.end());
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.index < b.index; });
  const auto is_mandatory = [](std::uint16_t index) { return index == 0x1000 || index == 0x1001 || index == 0x1018; };
  const auto is_manufacturer = [](std::uint16_t index) { return index >= 0x2000 && index < 0x6000; };
  return fmt::format(head, name, file_name, parts.about) + list_of("MandatoryObjects", rows, is_mandatory) +
         list_of("OptionalObjects", rows,
                 [&](std::uint16_t index) { return !is_mandatory(index) && !is_manufacturer(index); }) +
         list_of("ManufacturerObjects", rows, is_manufacturer);
}

}  // namespace lexican::codict::project
