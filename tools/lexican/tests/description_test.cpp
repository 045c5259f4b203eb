// SPDX-License-Identifier: Apache-2.0
// Names, types and values by descriptions, and the option --eds.
#include "describe/description.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "model/device.hpp"

namespace {

using namespace lexican;
using namespace lexican::describe;

/// Folder that exists during a test.
class Folder {
 public:
  Folder() {
    char path[] = "/tmp/lexican-description-XXXXXX";
    REQUIRE(mkdtemp(path) != nullptr);
    path_ = path;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  /// Returns the path of a file with this text.
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path_ + '/' + name, std::ios::binary) << text;
    return path_ + '/' + name;
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Returns the section of a variable; \a more: further keys.
std::string variable(const std::string& section, const std::string& name, const std::string& type,
                     const std::string& more = {}) {
  return '[' + section + "]\nParameterName=" + name + "\nObjectType=0x7\nDataType=" + type + "\nAccessType=rw\n" +
         more + '\n';
}

std::string eds(const std::string& sections) {
  return "[FileInfo]\nFileName=a.eds\nEDSVersion=4.0\n[DeviceInfo]\nVendorName=Example\n" + sections;
}

std::string dcf(const std::string& node) {
  return eds("[DeviceComissioning]\nNodeID=" + node + "\n" + variable("2000", "Of node " + node, "0x0005"));
}

Description read(const std::string& text, const std::string& name = "a.eds") {
  const Folder folder;
  std::string why;
  const std::optional<Description> description = read_description(folder.file(name, text), why);
  REQUIRE_MESSAGE(description.has_value(), why);
  CHECK(why.empty());
  return *description;
}

Description fixture(const std::string& name) {
  std::string why;
  const std::optional<Description> description = read_description(LEXICAN_FIXTURES "/" + name, why);
  REQUIRE_MESSAGE(description.has_value(), why);
  return *description;
}

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// Returns the shown value of an object with this type.
std::string shown(const std::string& type, const Bytes& bytes, const std::string& more = {}) {
  return read(eds(variable("2000", "Value", type, more))).show(0x2000, 0, bytes);
}

}  // namespace

TEST_CASE("description: standard names") {
  CHECK(standard_name(0x1000, 0) == "device type");
  CHECK(standard_name(0x1018, 0) == "identity object");
  CHECK(standard_name(0x1018, 1) == "vendor-ID");
  CHECK(standard_name(0x1018, 4) == "serial number");
  CHECK(standard_name(0x1018, 5) == "identity object");
  CHECK(standard_name(0x1400, 1) == "RPDO communication parameter");
  CHECK(standard_name(0x1BFF, 1) == "TPDO mapping parameter");
  CHECK(standard_name(0x1C00, 0).empty());
  CHECK(standard_name(0x2000, 0).empty());
  CHECK(key_of(0x6060, 0, false) == "6060h");
  CHECK(key_of(0x1018, 0x10, true) == "1018h:10");
}

TEST_CASE("description: objects without a description") {
  const Description none;
  CHECK(none.device() == nullptr);
  CHECK(none.object(0x1017, 0) == "1017h:00 producer heartbeat time");
  CHECK(none.object(0x1018, 4) == "1018h:04 serial number");
  CHECK(none.object(0x2000, 1) == "2000h:01");
  CHECK(none.name_of(0x2000, 1).empty());
  CHECK(none.type_of(0x1017, 0) == ValueType{ValueType::Kind::unsigned_integer, 2});
  CHECK_FALSE(none.type_of(0x2000, 1));
  CHECK(none.show(0x1017, 0, {0xE8, 0x03}) == "1000");
  CHECK(none.show(0x2000, 1, {0x7F}) == "7Fh");
  CHECK(none.show(0x2000, 1, {1, 2, 3}) == "01 02 03");
  CHECK(none.show(0x2000, 1, {1, 2, 3, 4}) == "04030201h");
  CHECK(none.show(0x2000, 1, {1, 2, 3, 4, 5, 6, 7, 8}) == "0807060504030201h");
  CHECK(none.show(0x1008, 0, bytes_of("SD-400")) == "\"SD-400\"");
  CHECK(none.show(0x2000, 1, {}) == "no data");
}

TEST_CASE("description: the objects of CiA 301 have their types without a description") {
  const Description none;
  const auto name_of = [&](std::uint16_t index, std::uint8_t sub_index) {
    const std::optional<ValueType> type = none.type_of(index, sub_index);
    return !type                                    ? std::string("-")
           : type->kind == ValueType::Kind::text    ? std::string("string")
           : type->kind == ValueType::Kind::bytes   ? std::string("bytes")
           : type->kind == ValueType::Kind::boolean ? std::string("bool")
                                                    : 'u' + std::to_string(8 * type->size);
  };
  struct Typed {
    std::uint16_t index;
    std::vector<const char*> types;  // of sub-index 0, 1, …
  };
  const Typed all[] = {{0x1000, {"u32"}},
                       {0x1001, {"u8"}},
                       {0x1003, {"u8", "u32", "u32"}},
                       {0x1008, {"string"}},
                       {0x1009, {"string"}},
                       {0x100A, {"string"}},
                       {0x100C, {"u16"}},
                       {0x1016, {"u8", "u32", "u32"}},
                       {0x1017, {"u16"}},
                       {0x1018, {"u8", "u32", "u32", "u32", "u32"}},
                       {0x1021, {"bytes"}},
                       {0x1200, {"u8", "u32", "u32", "u8"}},
                       {0x1301, {"u8", "u8", "u16", "u8", "u8", "u32", "u32"}},
                       {0x15FF, {"u8", "u32", "u8", "u16", "u8", "u16", "u8"}},
                       {0x1801, {"u8", "u32", "u8", "u16", "u8", "u16", "u8"}},
                       {0x1A03, {"u8", "u32", "u32"}},
                       {0x1C00, {"-", "-"}},
                       {0x6041, {"-"}}};
  for (const Typed& object : all) {
    for (std::size_t sub = 0; sub < object.types.size(); ++sub) {
      CAPTURE(object.index);
      CAPTURE(sub);
      CHECK(name_of(object.index, static_cast<std::uint8_t>(sub)) == object.types[sub]);
    }
  }
  CHECK(none.show(0x1009, 0, bytes_of("V1")) == "\"V1\"");
  CHECK(none.show(0x100A, 0, bytes_of("a")) == "\"a\"");
  CHECK(none.show(0x1001, 0, {0x09}) == "09h");
  CHECK(none.show(0x1003, 0, {2}) == "2");
  CHECK(none.show(0x1003, 1, {0x10, 0x43, 0, 0}) == "00004310h");
  CHECK(none.show(0x1016, 1, {0xF4, 0x01, 0x7F, 0}) == "007F01F4h");
  CHECK(none.show(0x1800, 1, {0x81, 0x01, 0, 0}) == "00000181h");
  CHECK(none.show(0x1800, 5, {100, 0}) == "100");
  CHECK(none.show(0x1017, 0, {1}) == "01h (1 byte instead of 2)");
  CHECK(read(eds({})).show(0x1017, 0, {0xE8, 0x03}) == "1000");
}

TEST_CASE("description: the signatures of 1010h and 1011h") {
  const Description none;
  CHECK(signature_of(0x1010, 1) == "save");
  CHECK(signature_of(0x1011, 127) == "load");
  CHECK(signature_of(0x1010, 0).empty());
  CHECK(signature_of(0x1012, 1).empty());
  CHECK(none.show(0x1010, 1, bytes_of("save")) == "65766173h (save)");
  CHECK(none.show(0x1011, 2, bytes_of("load")) == "64616F6Ch (load)");
  CHECK(none.show(0x1010, 1, bytes_of("load")) == "64616F6Ch");
  CHECK(none.show(0x1010, 1, {1, 0, 0, 0}) == "00000001h");
}

TEST_CASE("description: names of variables and sub-objects") {
  const Description device = read(eds(
      variable("6060", "Modes of operation", "0x0002") + "[2001]\nParameterName=Motor\nObjectType=0x9\nSubNumber=3\n" +
      variable("2001sub0", "Highest sub-index", "0x0005") + variable("2001sub1", "Current", "0x0006") +
      variable("2001sub2", "Motor", "0x0006") + "[2002]\nParameterName=\nObjectType=0x9\nSubNumber=2\n" +
      variable("2002sub0", "", "0x0005") + variable("2002sub1", "Alone", "0x0005") + variable("1017", "", "0x0006")));
  CHECK(device.object(0x6060, 0) == "6060h Modes of operation");
  CHECK(device.object(0x6060, 1) == "6060h:01 Modes of operation");  // it has no sub-object 1
  CHECK(device.object(0x2001, 1) == "2001h:01 Motor, Current");
  CHECK(device.object(0x2001, 0) == "2001h:00 Motor, Highest sub-index");
  CHECK(device.object(0x2001, 2) == "2001h:02 Motor");
  CHECK(device.object(0x2001, 9) == "2001h:09 Motor");
  CHECK(device.object(0x2002, 0) == "2002h:00");
  CHECK(device.object(0x2002, 1) == "2002h:01 Alone");
  CHECK(device.object(0x1017, 0) == "1017h producer heartbeat time");
  CHECK(device.object(0x1018, 1) == "1018h:01 vendor-ID");
  CHECK(device.object(0x2003, 0) == "2003h:00");
}

TEST_CASE("description: values of each type") {
  CHECK(shown("0x0001", {0}) == "0");
  CHECK(shown("0x0001", {1}) == "1");
  CHECK(shown("0x0002", {0xFE}) == "-2");
  CHECK(shown("0x0003", {0x00, 0x80}) == "-32768");
  CHECK(shown("0x0010", {0xFF, 0xFF, 0xFF}) == "-1");
  CHECK(shown("0x0004", {0xFF, 0xFF, 0xFF, 0x7F}) == "2147483647");
  CHECK(shown("0x0015", {0, 0, 0, 0, 0, 0, 0, 0x80}) == "-9223372036854775808");
  CHECK(shown("0x0005", {0xFE}) == "254");
  CHECK(shown("0x0006", {0xB4, 0x04}) == "1204");
  CHECK(shown("0x0016", {1, 0, 1}) == "65537");
  CHECK(shown("0x0007", {0xFF, 0xFF, 0xFF, 0xFF}) == "4294967295");
  CHECK(shown("0x001B", {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}) == "18446744073709551615");
  CHECK(shown("0x0008", {0, 0, 0xC0, 0x3F}) == "1.5");
  CHECK(shown("0x0011", {0, 0, 0, 0, 0, 0, 0xF8, 0x3F}) == "1.5");
  CHECK(shown("0x0008", {0, 0, 0xC0, 0x7F}) == "nan");
}

TEST_CASE("description: texts and bytes") {
  CHECK(shown("0x0009", bytes_of("SD")) == "\"SD\"");
  CHECK(shown("0x0009", bytes_of("drive")) == "\"drive\"");
  CHECK(shown("0x0009", {'S', 'D', 0, 0}) == "\"SD\"");
  CHECK(shown("0x0009", {}) == "\"\"");
  CHECK(shown("0x0009", {0, 0, 0, 0}) == "\"\"");
  CHECK(shown("0x0009", {'a', 0, 'b'}) == "61 00 62");
  CHECK(shown("0x0009", {0xFC, 0x62, 0x65, 0x72}) == "FC 62 65 72");
  CHECK(shown("0x0009", bytes_of(std::string(64, 'a'))) == '"' + std::string(64, 'a') + '"');
  CHECK(shown("0x0009", bytes_of(std::string(65, 'a'))) == '"' + std::string(64, 'a') + "\" ...");
  CHECK(shown("0x000A", {1, 2, 3, 4}) == "01 02 03 04");
  CHECK(shown("0x000A", bytes_of("drive")) == "64 72 69 76 65");
  CHECK(shown("0x000F", {1}) == "01");
  CHECK(shown("0x000F", {}) == "no data");
  CHECK(shown("0x000F", Bytes(65, 0xAA)).size() == 64 * 3 - 1 + 4);
}

TEST_CASE("description: a length that is not that of the type") {
  CHECK(shown("0x0006", {0x34}) == "34h (1 byte instead of 2)");
  CHECK(shown("0x0005", {0x34, 0x12}) == "1234h (2 bytes instead of 1)");
  CHECK(shown("0x0008", {1, 2, 3}) == "01 02 03 (3 bytes instead of 4)");
  CHECK(shown("0x0006", {}) == "no data");
  CHECK(shown("0x0099", {0x34, 0x12}) == "1234h");                    // unknown type
  CHECK(shown("0x000C", {1, 2, 3, 4, 5, 6}) == "01 02 03 04 05 06");  // TIME_OF_DAY
}

TEST_CASE("description: COB-IDs and other codes of CiA 301 in hexadecimal digits") {
  const Description device =
      read(eds(variable("1000", "Device type", "0x0007") + variable("1014", "COB-ID EMCY", "0x0007") +
               variable("1017", "Producer heartbeat time", "0x0006") +
               "[1800]\nParameterName=TPDO 1\nObjectType=0x9\nSubNumber=3\n" +
               variable("1800sub0", "Highest sub-index", "0x0005") + variable("1800sub1", "COB-ID", "0x0007") +
               variable("1800sub2", "Transmission type", "0x0005") +
               "[1A00]\nParameterName=TPDO 1 mapping\nObjectType=0x9\nSubNumber=2\n" +
               variable("1A00sub0", "Number", "0x0005") + variable("1A00sub1", "Object", "0x0007")));
  CHECK(device.show(0x1000, 0, {0x92, 0x01, 0x02, 0x00}) == "00020192h");
  CHECK(device.show(0x1014, 0, {0x85, 0, 0, 0}) == "00000085h");
  CHECK(device.show(0x1017, 0, {0xE8, 0x03}) == "1000");
  CHECK(device.show(0x1800, 0, {2}) == "2");
  CHECK(device.show(0x1800, 1, {0x85, 0x01, 0, 0x80}) == "80000185h");
  CHECK(device.show(0x1800, 2, {254}) == "254");
  CHECK(device.show(0x1A00, 0, {1}) == "1");
  CHECK(device.show(0x1A00, 1, {0x10, 0, 0x41, 0x60}) == "60410010h");
}

TEST_CASE("description: Unit and Factor of an EDS") {
  CHECK(fixture("python_canopen.eds").show(0x2000, 0, {0x0F, 0x00}) == "1.5 mV");
  CHECK(fixture("python_canopen.eds").show(0x2000, 0, {0x03, 0x00}) == "0.3 mV");
  CHECK(shown("0x0006", {10, 0}, "Unit=rpm\n") == "10 rpm");
  CHECK(shown("0x0006", {10, 0}, "Factor=0.5\n") == "5");
  CHECK(shown("0x0003", {0xF6, 0xFF}, "factor=2\nUNIT=V\n") == "-20 V");
  CHECK(shown("0x0006", {10, 0}, "Factor=1\nUnit=V\n") == "10 V");
  CHECK(shown("0x0008", {0, 0, 0xC0, 0x3F}, "Factor=10\nUnit=V\n") == "15 V");
  CHECK(shown("0x001B", {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}, "Unit=V\n") == "18446744073709551615 V");
  // The unit is that of the scaled value.
  CHECK(shown("0x0006", {10, 0}, "Factor=a tenth\nUnit=V\n") == "10");
  CHECK(shown("0x0006", {10, 0}, "Factor=0\nUnit=V\n") == "10");
  CHECK(shown("0x0006", {10, 0}, "Factor=inf\nUnit=V\n") == "10");
  CHECK(shown("0x0006", {10, 0}, "Factor=1e400\nUnit=V\n") == "10");
  CHECK(shown("0x0009", bytes_of("ab"), "Unit=V\nFactor=2\n") == "\"ab\"");
}

TEST_CASE("description: units and names of values of an XDD") {
  const Description mode = fixture("xdd/enumeration.xdd");
  CHECK(mode.object(0x2000, 0) == "2000h Mode");
  CHECK(mode.show(0x2000, 0, {1}) == "1 (on)");
  CHECK(mode.show(0x2000, 0, {2}) == "2");
  const Description motor = fixture("xdd/indexed.xdd");
  CHECK(motor.show(0x3001, 1, {3}) == "3 (On)");
  CHECK(motor.show(0x3001, 1, {1}) == "1");
  CHECK(motor.show(0x3001, 2, {0xE8, 0x03}) == "1000 mA");
}

TEST_CASE("network: the options FILE and NODE=FILE") {
  const Folder folder;
  const std::string all = folder.file("all.eds", eds(variable("2000", "Of all", "0x0005")));
  const std::string nine = folder.file("nine.dcf", dcf("9"));
  Network network;
  std::string why;
  CHECK(network.of(5).object(0x2000, 0) == "2000h:00");
  CHECK(network.add(all, why));
  CHECK(network.add(nine, why));
  CHECK(network.add("5=" + nine, why));
  CHECK(network.add("127=" + nine, why));
  CHECK(why.empty());
  CHECK(network.of(1).object(0x2000, 0) == "2000h Of all");
  CHECK(network.of(5).object(0x2000, 0) == "2000h Of node 9");
  CHECK(network.of(9).object(0x2000, 0) == "2000h Of node 9");
  CHECK(network.of(127).object(0x2000, 0) == "2000h Of node 9");
  CHECK(network.add("9=" + all, why));  // the last one of a node counts
  CHECK(network.of(9).object(0x2000, 0) == "2000h Of all");
  CHECK_FALSE(network.add(all, why));
  CHECK(why == all + ": a second description without node-ID; name the node with NODE=FILE");
}

TEST_CASE("network: a node-ID that is none, and files that are none") {
  const Folder folder;
  const std::string good = folder.file("good.eds", eds({}));
  Network network;
  std::string why;
  for (const std::string node : {"0", "128", "300", "99999999999"}) {
    CHECK_FALSE(network.add(node + '=' + good, why));
    CHECK(why == node + '=' + good + ": node-IDs are 1 to 127");
  }
  CHECK_FALSE(network.add("5=/tmp/no-such.eds", why));
  CHECK(why == "/tmp/no-such.eds: No such file or directory");
  CHECK_FALSE(network.add("x=y.eds", why));
  CHECK(why == "x=y.eds: No such file or directory");
  CHECK_FALSE(network.add("", why));
  CHECK_FALSE(network.add("=", why));
  CHECK_FALSE(network.add("5=", why));
  const std::string bad = folder.file("bad.eds", "a letter to my aunt\n");
  CHECK_FALSE(network.add(bad, why));
  CHECK_MESSAGE(why.find(bad + ": ") == 0, why);
  CHECK_FALSE(network.add(folder.file("empty.eds", ""), why));
  CHECK_FALSE(network.add(folder.file("none.json", R"({"schema":"codict-device-1","devices":[]})"), why));
  CHECK(network.of(5).device() == nullptr);
}

TEST_CASE("network: a directory") {
  const Folder folder;
  Network network;
  std::string why;
  CHECK_FALSE(network.add(folder.path(), why));
  CHECK(why == folder.path() + " has no EDS, DCF, XDD or XDC file");
  folder.file("readme.txt", "text");
  folder.file("five.DCF", dcf("5"));
  folder.file("six.dcf", dcf("6"));
  folder.file("all.eds", eds(variable("2000", "Of all", "0x0005")));
  why.clear();
  CHECK(network.add(folder.path(), why));
  CHECK(why.empty());
  CHECK(network.of(5).name_of(0x2000, 0) == "Of node 5");
  CHECK(network.of(6).name_of(0x2000, 0) == "Of node 6");
  CHECK(network.of(7).name_of(0x2000, 0) == "Of all");
  CHECK_FALSE(network.add("5=" + folder.path(), why));
  CHECK(why == "5=" + folder.path() + ": a directory describes several nodes; name one file, or leave out the node-ID");
  const std::string other = folder.file("other.eds", eds({}));
  Network ambiguous;
  CHECK_FALSE(ambiguous.add(folder.path(), why));
  CHECK(why == other + ": a second description without node-ID; name the node with NODE=FILE");
}
