// SPDX-License-Identifier: Apache-2.0
// Logs as other programs write them, byte by byte; damaged logs; logs that are written and read again.
#include "bus/log.hpp"

#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace lexican::host_bus;

/// Result of reading a log completely.
struct Log {
  std::vector<std::string> frames;  // "time channel frame direction"
  std::string fault;
  std::uint64_t lost = 0;
  std::uint64_t other_frames = 0;
  std::uint64_t malformed = 0;
};

Log read(const std::string& bytes) {
  Log log;
  std::istringstream stream(bytes);
  const std::unique_ptr<LogReader> reader = read_log(stream, log.fault);
  if (reader == nullptr) {
    return log;
  }
  while (const std::optional<Entry> entry = reader->next()) {
    const char* const direction = entry->direction == Direction::received ? " R"
                                  : entry->direction == Direction::sent   ? " T"
                                                                          : "";
    log.frames.push_back(std::to_string(entry->time) + ' ' + reader->channels().at(entry->channel) + ' ' +
                         to_text(entry->frame) + direction);
  }
  CHECK_FALSE(reader->next().has_value());
  log.fault = reader->fault();
  log.lost = reader->lost();
  log.other_frames = reader->other_frames();
  log.malformed = reader->malformed();
  return log;
}

using Texts = std::vector<std::string>;

/// Returns the bytes of pairs of hex digits; other characters are ignored.
std::string bytes_of(const std::string& digits) {
  std::string bytes;
  std::string pair;
  for (const char c : digits) {
    if ((c >= '0' && c <= '9') || (c >= 'A' && c <= 'F')) {
      pair += c;
    }
    if (pair.size() == 2) {
      bytes += static_cast<char>(std::stoi(pair, nullptr, 16));
      pair.clear();
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("log: candump, data, remote and error frames of several interfaces") {
  const Log log = read(
      "(1436509052.249713) vcan0 044#2A366C2BBA\n"
      "(1436509052.450000) can1 7FF#\n"
      "(1436509053.000001) vcan0 12345678#11.22.33\r\n"
      "(1436509053.5) vcan0 123#R\n"
      "(1436509053.600000000) vcan0 00000123#R8 T\n"
      "(1436509054.000000) vcan0 20000040#0000000000000000 R\n"
      "(1436509055.000000) vcan0 001#1122334455667788_F\n");
  CHECK(log.frames == Texts{"1436509052249713 vcan0 044#2A366C2BBA", "1436509052450000 can1 7FF#",
                            "1436509053000001 vcan0 12345678#112233", "1436509053500000 vcan0 123#R",
                            "1436509053600000 vcan0 00000123#R8 T",
                            "1436509054000000 vcan0 20000040#0000000000000000 R",
                            "1436509055000000 vcan0 001#1122334455667788"});
  CHECK(log.malformed == 0);
  CHECK(log.fault.empty());
}

TEST_CASE("log: candump, lost frames, and frames of CAN FD") {
  const Log log = read(
      "DROPCOUNT: dropped 1 CAN frame on 'can0' socket (total drops 1)\n"
      "(1.000000) can0 123##1AABB\n"
      "(1.500000) can0 45123#81:00:12345678#11223344.556677\n"
      "(2.000000) can0 123#\n"
      "DROPCOUNT: dropped 41 CAN frames on 'can0' socket (total drops 42)\n");
  CHECK(log.frames == Texts{"2000000 can0 123#"});
  CHECK(log.lost == 42);
  CHECK(log.other_frames == 2);
  CHECK(log.malformed == 0);
}

TEST_CASE("log: candump, lines that are not frames are counted, the others are read") {
  const char* const lines[] = {
      "(1.000000) can0 800#",       // beyond 11 bits
      "(1.000000) can0 40000000#",  // beyond 29 bits
      "(1.000000) can0 1234#",      // neither 3 nor 8 digits
      "(1.000000) can0 12G#",       // not hex
      "(1.000000) can0 -12#",       // a sign
      "(1.000000) can0 123#1",      // half a byte
      "(1.000000) can0 123#112233445566778899",
      "(1.000000) can0 123#R9",
      "(1.000000) can0 123#11_Z",
      "(1.000000) can0 123#11_9",
      "(1.000000) can0 123#R_F",
      "(1.000000) can0 123",
      "(1.000000) can0 123# X",
      "(1.000000) can0 123# R R",
      "(1.0000000001) can0 123#",  // ten decimals
      "(-1.000000) can0 123#",
      "(99999999999999999999.0) can0 123#",
      "(1.000000 can0 123#",
      "()",
      "DROPCOUNT: dropped many",
      "can0 123#",
  };
  for (const char* const line : lines) {
    CAPTURE(line);
    const Log log = read("(0.000000) can0 001#\n" + std::string(line) + "\n\n(2.000000) can0 002#\n");
    CHECK(log.frames == Texts{"0 can0 001#", "2000000 can0 002#"});
    CHECK(log.malformed == 1);
  }
}

TEST_CASE("log: candump, the memory of a line and the number of channels are limited") {
  const Log log = read("(0.000000) can0 001#" + std::string(1000000, ' ') + "\n(1.000000) can0 002#\n");
  CHECK(log.frames == Texts{"1000000 can0 002#"});
  CHECK(log.malformed == 1);
  std::string many;
  for (unsigned n = 0; n < 100; ++n) {
    many += "(1.000000) can" + std::to_string(n) + " 001#\n";
  }
  const Log channels = read(many);
  REQUIRE(channels.frames.size() == 100);
  CHECK(channels.frames[62] == "1000000 can62 001#");
  CHECK(channels.frames[99] == "1000000 can63 001#");
}

TEST_CASE("log: ASC, absolute times and hexadecimal numbers") {
  const Log log = read(
      "date Mon Nov 2 09:00:00.000 am 2026\n"
      "base hex  timestamps absolute\n"
      "internal events logged\n"
      "// version 9.0.0\n"
      "Begin Triggerblock Mon Nov 2 09:00:00.000 am 2026\n"
      "   0.000000 Start of measurement\n"
      "   0.012345 1  123             Rx   d 8 01 02 03 04 05 06 07 08  Length = 0 BitCount = 64 ID = 291\n"
      "   0.020000 2  18FF1234x       Tx   r 8\n"
      "   0.020500 1  7F              Rx   r\n"
      "   0.021000 1  124             TxRq d 0\n"
      "   0.030000 1  ErrorFrame\n"
      "   0.040000 CANFD   1 Rx  123 1 0 8 8 01 02 03 04 05 06 07 08\n"
      "   0.050000 1  Statistic: D 0 R 0 XD 0 XR 0 E 0 O 0 B 0.00%\n"
      "   0.060000 CAN 1 Status:chip status error active\n"
      "   0.070000 1  125             Rx   d 9 01 02 03 04 05 06 07 08\n"
      "End TriggerBlock\n");
  CHECK(log.frames == Texts{"12345 1 123#0102030405060708 R", "20000 2 18FF1234#R8 T", "20500 1 07F#R R",
                            "30000 1 20000088#0000000000000000", "70000 1 125#0102030405060708 R"});
  CHECK(log.other_frames == 1);
  CHECK(log.malformed == 0);
}

TEST_CASE("log: ASC, relative times and decimal numbers") {
  const Log log = read(
      "base dec  timestamps relative\n"
      "   0.500000 1  291 Rx d 2 255 10\n"
      "   0.250000 Start of measurement\n"
      "   0.250000 1  536870911x Rx d 0\n");
  CHECK(log.frames == Texts{"500000 1 123#FF0A R", "1000000 1 1FFFFFFF# R"});
}

TEST_CASE("log: ASC, damaged frames are counted") {
  const char* const lines[] = {
      "1.0 1 800 Rx d 0",     "1.0 1 20000000x Rx d 0", "1.0 1 123 Rx d 3 01 02", "1.0 1 123 Rx d",
      "1.0 1 123 Rx d 1 100", "1.0 1 123 Rx d 10 1",    "1.0 1 x Rx d 0",         "1.0 1 123 Rx q 0",
  };
  for (const char* const line : lines) {
    CAPTURE(line);
    const Log log = read("base hex timestamps absolute\n" + std::string(line) + "\n2.0 1 001 Rx d 0\n");
    CHECK(log.frames == Texts{"2000000 1 001# R"});
    CHECK(log.malformed == 1);
  }
}

TEST_CASE("log: pcapng, both byte orders, resolution, direction and lost frames") {
  CHECK(read(bytes_of("0A0D0D0A 1C000000 4D3C2B1A 0100 0000 FFFFFFFFFFFFFFFF 1C000000"
                      "01000000 20000000 E300 0000 00000400 0200 0400 76636E31 0000 0000 20000000"
                      "06000000 30000000 00000000 01000000 02000000 0B000000 0B000000"
                      "0000012303000000 AABBCC 00 0000 0000 30000000"))
            .frames == Texts{"4294967298 vcn1 123#AABBCC"});
  const Log log =
      read(bytes_of("0A0D0D0A 0000001C 1A2B3C4D 0001 0000 FFFFFFFFFFFFFFFF 0000001C"
                    "00000001 0000001C 00E3 0000 00000000 0009 0001 09000000 0000001C"  // nanoseconds
                    "00000006 00000040 00000000 00000000 3B9ACA00 00000008 00000008"    // 1 s
                    "9234567800000000 0002 0004 00000002 0004 0008 0000000000000005 0000 0000 00000040"
                    "00000005 00000028 00000000 00000000 00000000 0005 0008 0000000000000007 0000 0000 00000028"
                    "00000099 0000000C 0000000C"                               // a block of another type
                    "00000003 00000018 00000008 4000010008000000 00000018"));  // a simple packet, a remote frame
  CHECK(log.frames == Texts{"1000000 can0 12345678# T", "1000000 can0 100#R8"});
  CHECK(log.lost == 7);
  CHECK(log.malformed == 0);
  CHECK(log.fault.empty());
}

TEST_CASE("log: pcapng, other frames, other interfaces and damaged packets are counted") {
  const std::string begin =
      "0A0D0D0A 1C000000 4D3C2B1A 0100 0000 FFFFFFFFFFFFFFFF 1C000000"
      "01000000 14000000 E300 0000 00000000 14000000"
      "01000000 14000000 0100 0000 00000000 14000000";  // Ethernet
  const auto packet = [&](const std::string& interface, const std::string& frame) {
    return read(bytes_of(begin + "06000000 28000000 " + interface + " 00000000 00000000 08000000 08000000 " + frame +
                         " 28000000"));
  };
  CHECK(packet("00000000", "0000012300000000").frames == Texts{"0 can0 123#"});
  CHECK(packet("00000000", "0000012300040000").other_frames == 1);  // FD
  CHECK(packet("00000000", "0000012380000000").other_frames == 1);  // XL
  CHECK(packet("00000000", "0000012309000000").other_frames == 1);
  CHECK(packet("00000000", "0000012301000000").malformed == 1);  // no data
  CHECK(packet("00000000", "0000080000000000").malformed == 1);  // beyond 11 bits
  CHECK(packet("01000000", "0000012300000000").malformed == 0);  // Ethernet
  CHECK(packet("01000000", "0000012300000000").fault == "the packets are not CAN frames (link type 227, SocketCAN)");
  CHECK(packet("02000000", "0000012300000000").malformed == 1);
}

TEST_CASE("log: pcapng, a damaged file ends with its fault") {
  const std::string section = "0A0D0D0A 1C000000 4D3C2B1A 0100 0000 FFFFFFFFFFFFFFFF 1C000000";
  CHECK(read(bytes_of(section + "06000000 0000")).fault == "the file ends within a packet");
  CHECK(read(bytes_of(section + "06000000 20000000 00")).fault == "the file ends within a packet");
  CHECK(read(bytes_of(section + "06000000 08000000")).fault == "a block has an impossible length: the file is damaged");
  CHECK(read(bytes_of(section + "06000000 21000000")).fault == "a block has an impossible length: the file is damaged");
  CHECK(read(bytes_of(section + "06000000 FCFFFFFF")).fault ==
        "a packet is longer than a megabyte: the file is damaged");
  CHECK(read(bytes_of("0A0D0D0A 1C000000 4D3C2B1B 0100 0000 FFFFFFFFFFFFFFFF 1C000000")).fault ==
        "a section has no byte-order magic: the file is damaged");
}

TEST_CASE("log: pcap, both byte orders, microseconds and nanoseconds") {
  CHECK(read(bytes_of("D4C3B2A1 0200 0400 00000000 00000000 00000400 E3000000"
                      "01000000 40E20100 0A000000 0A000000 00000123 02000000 AABB"))
            .frames == Texts{"1123456 can 123#AABB"});
  CHECK(read(bytes_of("A1B23C4D 0002 0004 00000000 00000000 00040000 000000E3"
                      "00000001 00000BB8 00000008 00000008 80000123 00000000"))
            .frames == Texts{"1000003 can 00000123#"});
  CHECK(read(bytes_of("D4C3B2A1 0200 0400 00000000 00000000 00000400 01000000")).fault ==
        "the packets are not CAN frames (link type 227, SocketCAN)");
  CHECK(read(bytes_of("D4C3B2A1 0200 0400")).fault == "the file ends within a packet");
  CHECK(read(bytes_of("D4C3B2A1 0200 0400 00000000 00000000 00000400 E3000000 01000000 00000000 FFFFFFFF 00000000"))
            .fault == "a packet is longer than a megabyte: the file is damaged");
}

TEST_CASE("log: pcap, frames of CAN FD without the flag FDF are recognised by their size") {
  const std::string padding(124, '0');
  const std::string begin =
      "D4C3B2A1 0200 0400 00000000 00000000 00000400 E3000000 01000000 00000000 48000000 48000000 ";
  CHECK(read(bytes_of(begin + "00000123 02000000 AABB" + padding)).other_frames == 1);
  CHECK(read(bytes_of("D4C3B2A1 0200 0400 00000000 00000000 00000400 E3000000 01000000 00000000 10000000 10000000"
                      "00000123 02000000 AABB000000000000"))
            .frames == Texts{"1000000 can 123#AABB"});
}

TEST_CASE("log: ASC, lines of CAN FD with frames of classic CAN, symbolic identifiers, other events") {
  const Log log = read(
      "base hex  timestamps absolute\n"
      "0.1 CANFD   1 Rx         44                                   0 0 5  5 2A 36 6C 2B BA   130000  130        0 0 "
      "0 0 0 0\n"
      "0.2 CANFD   1 Tx   12345678x  Name                            0 0 0  0   130000  130        10 0 0 0 0 0\n"
      "0.3 CANFD   1 Rx        123                                   1 0 2  2 01 02   130000  130   303000 0 0 0 0 0\n"
      "0.4 CANFD   1 Rx ErrorFrame  Flags = 0xe\n"
      "0.5 1  Heartbeat5      Rx   d 1 05  Length = 150000 BitCount = 78 ID = 1797\n"
      "0.6 1  J1939TP FEE3p 6 0 0 - Rx d 23 A0\n"
      "0.7 1  errorframe\n"
      "0.8 1  Unknown         Rx   d 1 05\n");
  CHECK(log.frames == Texts{"100000 1 044#2A366C2BBA R", "200000 1 12345678#R T", "400000 1 20000088#0000000000000000",
                            "500000 1 705#05 R", "700000 1 20000088#0000000000000000"});
  CHECK(log.other_frames == 1);
  CHECK(log.malformed == 1);
}

TEST_CASE("log: times that a file cannot mean are read as the latest time") {
  const Log log = read(
      "base hex timestamps relative\n"
      "18446744073708.0 1 123 Rx d 0\n"
      "1.2 1 124 Rx d 0\n"
      "1.0 1 125 Rx d 0\n");
  CHECK(log.frames ==
        Texts{"18446744073708000000 1 123# R", "18446744073708000000 1 124# R", "18446744073708000000 1 125# R"});
}

TEST_CASE("log: names of interfaces are printable, without spaces") {
  CHECK(read("(1.0) can\x1B[2J\xFF#0 123#\n").frames == Texts{"1000000 can_[2J_#0 123#"});
  std::ostringstream written;
  Entry entry;
  entry.frame.Identifier = 0x123 | CO_IF_FRM_RTR;
  entry.frame.DLC = 15;
  write_log(written, "a.log", "")->write(entry);
  write_log(written, "a.log", "my can\n")->write(entry);
  CHECK(written.str() == "(0000000000.000000) can 123#R8\n(0000000000.000000) my_can_ 123#R8\n");
  std::ostringstream packets;
  write_log(packets, "a.PcapNG", "my can")->write(entry);
  CHECK(read(packets.str()).frames == Texts{"0 my_can 123#R8"});
  for (const char* const name : {"a.pcap", "a.ASC", "a.blf", "a.trc", "a.log.gz"}) {
    CHECK(write_log(written, name, "can0") == nullptr);
  }
}

TEST_CASE("log: a file that cannot be read is no empty file") {
  struct Broken : std::streambuf {
    int_type underflow() override {
      if (++reads > 1) throw std::ios_base::failure("removed");
      setg(bytes, bytes, bytes + sizeof bytes - 1);
      return bytes[0];
    }
    char bytes[19] = "(1.0) can0 123#01\n";
    int reads = 0;
  } broken;
  std::istream stream(&broken);
  std::string why;
  const std::unique_ptr<LogReader> reader = read_log(stream, why);
  REQUIRE(reader != nullptr);
  CHECK(reader->next().has_value());
  CHECK_FALSE(reader->next().has_value());
  CHECK(reader->fault() == "the file cannot be read to its end");
  std::istream none(nullptr);
  CHECK(read_log(none, why) == nullptr);
  CHECK(why == "the file cannot be opened");
}

TEST_CASE("log: an unknown format is refused, with advice") {
  CHECK(read("LOGG\x90").fault == "a BLF file of Vector; convert it to ASC, or with can_logconvert of python-can");
  CHECK(read("\x1F\x8B\x08").fault == "a compressed file; decompress it with gunzip");
  CHECK(read(";$FILEVERSION=2.1").fault == "a trace file of PEAK (TRC); convert it with can_logconvert of python-can");
  CHECK(read("  (1436509052.249713)  vcan0  123   [4]  DE AD BE EF\n").fault ==
        "the output of candump for the screen; candump -l or -L writes a log");
  CHECK(read("\xEF\xBB\xBF\r\n\r\nbase hex timestamps absolute\n1.0 1 123 Rx d 0\n").frames ==
        Texts{"1000000 1 123# R"});
  CHECK(read("").fault == "the file is empty");
  const std::string unknown = "unknown format; candump logs (candump -l), pcapng, pcap and ASC files can be read";
  CHECK(read("PK\x03\x04").fault == unknown);
  CHECK(read("hello").fault == unknown);
  CHECK(read(std::string(10000, ' ')).fault == "the file is empty");
}

TEST_CASE("log: the writers write the bytes that candump and the draft of pcapng define") {
  Entry entry;
  entry.time = 1436509052249713;
  REQUIRE(parse_frame("123#AABBCC", entry.frame) == Parsed::frame);
  entry.direction = Direction::received;
  std::ostringstream candump;
  const std::unique_ptr<LogWriter> text = write_log(candump, "fault.log", "can0");
  text->write(entry);
  text->write_lost(0, 1);
  text->write_lost(0, 6);
  CHECK(candump.str() ==
        "(1436509052.249713) can0 123#AABBCC R\n"
        "DROPCOUNT: dropped 1 CAN frame on 'can0' socket (total drops 1)\n"
        "DROPCOUNT: dropped 6 CAN frames on 'can0' socket (total drops 7)\n");
  std::ostringstream pcapng;
  write_log(pcapng, "fault.pcapng", "can0")->write(entry);
  CHECK(pcapng.str() == bytes_of("0A0D0D0A 1C000000 4D3C2B1A 0100 0000 FFFFFFFFFFFFFFFF 1C000000"
                                 "01000000 20000000 E300 0000 00000000 0200 0400 63616E30 0000 0000 20000000"
                                 "06000000 38000000 00000000 7F1A0500 71A6C653 0B000000 0B000000"
                                 "0000012303000000 AABBCC00 0200 0400 01000000 0000 0000 38000000"));
}

TEST_CASE("log: frames that are written are read again") {
  const std::string lines =
      "(0000000000.000000) can0 000#\n"
      "(0000000001.000001) can0 7FF#1122334455667788 R\n"
      "(1436509052.249713) can0 1FFFFFFF#R8 T\n"
      "(1436509052.249713) can0 00000000#00\n"
      "(1436509053.000000) can0 20000004#000C000000000000\n";
  for (const char* const name : {"a.log", "a.pcapng"}) {
    CAPTURE(name);
    std::istringstream stream(lines);
    std::ostringstream written;
    const std::unique_ptr<LogWriter> writer = write_log(written, name, "can0");
    std::string why;
    const std::unique_ptr<LogReader> reader = read_log(stream, why);
    while (const std::optional<Entry> entry = reader->next()) {
      writer->write(*entry);
    }
    writer->write_lost(1436509053000000, 9);
    CHECK(read(written.str()).frames == read(lines).frames);
    CHECK(read(written.str()).lost == 9);
    CHECK(read(written.str()).malformed == 0);
  }
}
