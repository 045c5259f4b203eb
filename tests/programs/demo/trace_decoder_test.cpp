// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "support/notation.hpp"
#include "trace/decode.hpp"

namespace {

using lexican::trace::Form;

const lexican::trace::Names names = {
    {0x1000, 0, "device type", Form::hex},
    {0x1008, 0, "device name", Form::characters},
    {0x1017, 0, "heartbeat time", Form::decimal},
    {0x2100, 1, "hour", Form::decimal},
    {0x2200, 0, "picture", Form::hex},
};

using lexican::trace::Place;

std::string meaning(const char* frame) { return lexican::trace::Decoder(names).decode(test::frame(frame)).text; }
Place place(const char* frame) { return lexican::trace::Decoder(names).decode(test::frame(frame)).place; }

/// A decoder for frames that follow one another.
struct Listener {
  std::string hears(const char* frame) { return decoder.decode(test::frame(frame)).text; }
  Place place(const char* frame) { return decoder.decode(test::frame(frame)).place; }

  lexican::trace::Decoder decoder{names};
};

}  // namespace

TEST_CASE("trace: boot-up and heartbeat show the state [301 error control]") {
  CHECK(meaning("701#00") == "boot-up");
  CHECK(meaning("77F#04") == "heartbeat: stopped");
  CHECK(meaning("705#05") == "heartbeat: operational");
  CHECK(meaning("705#7F") == "heartbeat: pre-operational");
  CHECK(meaning("705#12") == "heartbeat: unknown state 12h");
}

TEST_CASE("trace: NMT commands show the command and the node [301 NMT node control]") {
  CHECK(meaning("000#0105") == "NMT start, node 5");
  CHECK(meaning("000#0205") == "NMT stop, node 5");
  CHECK(meaning("000#8000") == "NMT enter pre-operational, all nodes");
  CHECK(meaning("000#817F") == "NMT reset node, node 127");
  CHECK(meaning("000#8200") == "NMT reset communication, all nodes");
  CHECK(meaning("000#0301") == "NMT unknown command 03h, node 1");
}

TEST_CASE("trace: an expedited download shows the object and its value [301 SDO download]") {
  CHECK(meaning("601#2F0021010C000000") == "SDO download 2100h:01 hour = 12");
  CHECK(meaning("601#2B171000E8030000") == "SDO download 1017h:00 heartbeat time = 1000");
  CHECK(meaning("601#2300100091010F00") == "SDO download 1000h:00 device type = 000F0191h");
  CHECK(meaning("601#2734120556341200") == "SDO download 1234h:05 = 123456h");
  CHECK(meaning("601#22171000E8030000") == "SDO download 1017h:00 heartbeat time = 1000");  // size not given
  CHECK(meaning("581#6000210100000000") == "SDO answer: 2100h:01 hour download accepted");
}

TEST_CASE("trace: an expedited upload shows the object and its value [301 SDO upload]") {
  CHECK(meaning("601#4017100000000000") == "SDO upload 1017h:00 heartbeat time");
  CHECK(meaning("581#4B171000E8030000") == "SDO answer: 1017h:00 heartbeat time = 1000");
  CHECK(meaning("581#4F00210117000000") == "SDO answer: 2100h:01 hour = 23");
  CHECK(meaning("581#4308100041424344") == "SDO answer: 1008h:00 device name = \"ABCD\"");
  CHECK(meaning("581#4B08100041070000") == "SDO answer: 1008h:00 device name = 0741h");  // not printable
}

TEST_CASE("trace: a segmented transfer shows size, toggle bit and data [301 SDO segments]") {
  CHECK(meaning("601#2100220010270000") == "SDO download 2200h:00 picture, 10000 bytes in segments");
  CHECK(meaning("601#2000220000000000") == "SDO download 2200h:00 picture, segments of unknown size");
  CHECK(meaning("601#0041424344454647") == "SDO download segment: \"ABCDEFG\"");
  CHECK(meaning("601#1000010203040506") == "SDO download segment, 7 bytes");
  CHECK(meaning("601#0D41000000000000") == "SDO download last segment: \"A\"");
  CHECK(meaning("601#0D01000000000000") == "SDO download last segment, 1 byte");
  CHECK(meaning("601#0F00000000000000") == "SDO download last segment, 0 bytes");
  CHECK(meaning("581#2000000000000000") == "SDO answer: segment confirmed, toggle 0");
  CHECK(meaning("581#3000000000000000") == "SDO answer: segment confirmed, toggle 1");
  CHECK(meaning("581#410810000B000000") == "SDO answer: 1008h:00 device name, 11 bytes in segments");
  CHECK(meaning("601#6000000000000000") == "SDO upload next segment, toggle 0");
  CHECK(meaning("601#7000000000000000") == "SDO upload next segment, toggle 1");
  CHECK(meaning("581#0041424344454647") == "SDO answer: segment: \"ABCDEFG\"");
  CHECK(meaning("581#1748494A4B000000") == "SDO answer: last segment: \"HIJK\"");
}

TEST_CASE("trace: an abort shows object, code and reason, from either side [301 SDO abort]") {
  CHECK(meaning("581#8000210130000906") == "SDO ABORT 2100h:01 hour: 0609 0030h invalid value");
  CHECK(meaning("581#80FF2F0000000206") == "SDO ABORT 2FFFh:00: 0602 0000h object does not exist");
  CHECK(meaning("601#8008100000000405") == "SDO ABORT 1008h:00 device name: 0504 0000h protocol timed out");
  CHECK(meaning("581#8000210178563412") == "SDO ABORT 2100h:01 hour: 1234 5678h unknown abort code");
}

TEST_CASE("trace: every abort code of CiA 301 has a unique meaning [301 SDO abort codes]") {
  const std::uint32_t codes[] = {
      0x05030000, 0x05040000, 0x05040001, 0x05040002, 0x05040003, 0x05040004, 0x05040005, 0x06010000,
      0x06010001, 0x06010002, 0x06020000, 0x06040041, 0x06040042, 0x06040043, 0x06040047, 0x06060000,
      0x06070010, 0x06070012, 0x06070013, 0x06090011, 0x06090030, 0x06090031, 0x06090032, 0x06090036,
      0x060A0023, 0x08000000, 0x08000020, 0x08000021, 0x08000022, 0x08000023, 0x08000024,
  };
  for (const std::uint32_t code : codes) {
    CAPTURE(code);
    CHECK(lexican::trace::abort_meaning(code) != std::string("unknown abort code"));
  }
}

TEST_CASE("trace: PDOs are named by their CAN-ID [301:7.3.3]") {
  CHECK(meaning("181#1122") == "TPDO1");
  CHECK(meaning("201#") == "RPDO1");
  CHECK(meaning("2FF#11") == "TPDO2");
  CHECK(meaning("305#11") == "RPDO2");
  CHECK(meaning("385#11") == "TPDO3");
  CHECK(meaning("405#11") == "RPDO3");
  CHECK(meaning("485#11") == "TPDO4");
  CHECK(meaning("57F#11") == "RPDO4");
}

TEST_CASE("trace: a PDO whose mapping is known shows its objects [301:7.2.2]") {
  const lexican::trace::Mappings mappings = {{0x180, {{0x2100, 1, 1}, {0x1017, 0, 2}, {0x1234, 5, 4}}}};
  lexican::trace::Decoder decoder(names, mappings);
  const auto hears = [&](const char* frame) { return decoder.decode(test::frame(frame)).text; };
  CHECK(hears("185#0CE80378563412") == "TPDO1 hour = 12, heartbeat time = 1000, 1234h:05 = 12345678h");
  CHECK(hears("185#0C") == "TPDO1 hour = 12, heartbeat time = 0, 1234h:05 = 00000000h");
  CHECK(hears("205#0C") == "RPDO1");
}

TEST_CASE("trace decoder: GFC and SRDOs") {
  CHECK(meaning("001#") == "GFC, global fail-safe command");
  CHECK(meaning("101#112233") == "SRDO 101h plain");
  CHECK(meaning("102#EEDDCC") == "SRDO 101h inverse");
  CHECK(meaning("17F#11") == "SRDO 17Fh plain");
  CHECK(meaning("180#EE") == "SRDO 17Fh inverse");
}

TEST_CASE("trace: SYNC, TIME and EMCY messages are shown [301:7.2.5, 7.2.6, 7.2.7]") {
  CHECK(meaning("080#") == "SYNC");
  CHECK(meaning("080#F0") == "SYNC, counter 240");
  CHECK(meaning("100#952CB3F2313D") == "TIME 12:34:56.789, day 15665");
  CHECK(meaning("081#0063810118000000") == "EMCY 6300h data set, error register 81h");
  CHECK(meaning("0FF#3081110000050000") == "EMCY 8130h heartbeat or life guarding missing, error register 11h");
  CHECK(meaning("081#0000000000000000") == "EMCY 0000h error reset, error register 00h");
  CHECK(meaning("081#2331050000000000") == "EMCY 3123h mains voltage, error register 05h");
  CHECK(meaning("081#00A0010000000000") == "EMCY A000h unknown error code, error register 01h");
}

TEST_CASE("trace: LSS: switch state, configure and store are shown [305]") {
  CHECK(meaning("7E5#0400000000000000") == "LSS switch all to waiting");
  CHECK(meaning("7E5#0401000000000000") == "LSS switch all to configuration");
  CHECK(meaning("7E5#4019030000000000") == "LSS switch to configuration: vendor-ID 00000319h");
  CHECK(meaning("7E5#4301000080000000") == "LSS switch to configuration: serial number 80000001h");
  CHECK(meaning("7E4#4400000000000000") == "LSS answer: switched to configuration");
  CHECK(meaning("7E5#1105000000000000") == "LSS configure node-ID 5");
  CHECK(meaning("7E5#11FF000000000000") == "LSS configure no node-ID");
  CHECK(meaning("7E4#1100000000000000") == "LSS answer: configure node-ID done");
  CHECK(meaning("7E4#1101000000000000") == "LSS answer: configure node-ID refused, error 1");
  CHECK(meaning("7E5#1300020000000000") == "LSS configure bit timing: 500 kbit/s");
  CHECK(meaning("7E5#1300050000000000") == "LSS configure bit timing: table 0, index 5");
  CHECK(meaning("7E5#1380020000000000") == "LSS configure bit timing: table 128, index 2");
  CHECK(meaning("7E4#1301000000000000") == "LSS answer: configure bit timing refused, error 1");
  CHECK(meaning("7E5#15E8030000000000") == "LSS activate bit timing, delay 1000 ms");
  CHECK(meaning("7E5#1700000000000000") == "LSS store");
  CHECK(meaning("7E4#1702000000000000") == "LSS answer: store refused, error 2");
}

TEST_CASE("trace: LSS: inquire and identify are shown [305]") {
  CHECK(meaning("7E5#5A00000000000000") == "LSS inquire vendor-ID");
  CHECK(meaning("7E5#5D00000000000000") == "LSS inquire serial number");
  CHECK(meaning("7E4#5B0CC10000000000") == "LSS answer: product code 0000C10Ch");
  CHECK(meaning("7E5#5E00000000000000") == "LSS inquire node-ID");
  CHECK(meaning("7E4#5E05000000000000") == "LSS answer: node-ID 5");
  CHECK(meaning("7E4#5EFF000000000000") == "LSS answer: no node-ID");
  CHECK(meaning("7E5#4619030000000000") == "LSS identify: vendor-ID 00000319h");
  CHECK(meaning("7E5#4801000000000000") == "LSS identify: revision number from 00000001h");
  CHECK(meaning("7E5#4B09000000000000") == "LSS identify: serial number to 00000009h");
  CHECK(meaning("7E5#4C00000000000000") == "LSS identify nodes without node-ID");
  CHECK(meaning("7E4#5000000000000000") == "LSS answer: node without node-ID");
  CHECK(meaning("7E5#7700000000000000") == "LSS unknown command 77h");
  CHECK(meaning("7E4#7700000000000000") == "LSS answer: unknown command 77h");
  CHECK(meaning("7E5#04000000000000") == "unknown 7E5#04000000000000");
}

TEST_CASE("trace: LSS: the bits of a fastscan can be folded [305]") {
  CHECK(meaning("7E5#5100000000800000") == "LSS fastscan start: all nodes without node-ID");
  CHECK(meaning("7E5#51000000801F0303") == "LSS fastscan serial number 80000000h, bits 31...31");
  CHECK(meaning("7E5#510CC10000000102") == "LSS fastscan product code 0000C10Ch, bits 31...0");
  CHECK(meaning("7E4#4F00000000000000") == "LSS answer: identified");
  CHECK(place("7E5#5100000000800000") == Place::edge);
  CHECK(place("7E5#51000000801F0303") == Place::middle);
  CHECK(place("7E4#4F00000000000000") == Place::middle);
  CHECK(place("7E5#1105000000000000") == Place::edge);
}

TEST_CASE("trace: frames of no known service are shown as bytes") {
  CHECK(meaning("780#1122334455667788") == "unknown 780#1122334455667788");
  CHECK(meaning("200#11") == "unknown 200#11");  // a PDO of node 0
  CHECK(meaning("500#11") == "unknown 500#11");
  CHECK(meaning("080#0102") == "unknown 080#0102");                      // SYNC has at most one byte
  CHECK(meaning("081#00000000000000") == "unknown 081#00000000000000");  // EMCY has eight bytes
  CHECK(meaning("100#0000000000") == "unknown 100#0000000000");          // TIME has six bytes
  CHECK(meaning("000#01") == "unknown 000#01");                          // NMT has two bytes
  CHECK(meaning("000#010500") == "unknown 000#010500");
  CHECK(meaning("701#0000") == "unknown 701#0000");  // a heartbeat has one byte
  CHECK(meaning("700#05") == "unknown 700#05");      // node-ID 0
  CHECK(meaning("600#4000100000000000") == "unknown 600#4000100000000000");
  CHECK(meaning("601#40001000") == "unknown 601#40001000");  // SDO frames have eight bytes
  CHECK(meaning("601#E000100000000000") == "SDO unknown command 601#E000100000000000");
  CHECK(meaning("581#E000100000000000") == "SDO answer: unknown command 581#E000100000000000");
  CHECK(meaning("581#A300000000000000") == "SDO answer: unknown command 581#A300000000000000");
}

TEST_CASE("trace: 29-bit identifiers, remote frames and error frames are not decoded as services") {
  CHECK(meaning("00000701#00") == "unknown 00000701#00");
  CHECK(meaning("701#R") == "remote frame 701#R");
  CHECK(meaning("181#R8") == "remote frame 181#R8");
  CHECK(meaning("20000040#0000000000000000") == "CAN error frame: bus-off 20000040#0000000000000000");
  CHECK(meaning("20000004#000C000000000000") == "CAN error frame: controller problem 20000004#000C000000000000");
  CHECK(meaning("20000100#0000000000000000") == "CAN error frame: controller restarted 20000100#0000000000000000");
}

TEST_CASE("trace: only the middle of a segmented transfer can be folded") {
  CHECK(place("601#6000000000000000") == Place::middle);
  CHECK(place("601#0041424344454647") == Place::middle);
  CHECK(place("581#0041424344454647") == Place::middle);
  CHECK(place("581#3000000000000000") == Place::middle);
  CHECK(place("601#0148494A4B000000") == Place::edge);  // last segment
  CHECK(place("581#1748494A4B000000") == Place::edge);
  CHECK(place("601#4008100000000000") == Place::edge);  // initiate
  CHECK(place("581#6000220000000000") == Place::edge);
  CHECK(place("581#8008100000000405") == Place::edge);
  CHECK(place("705#05") == Place::outside);
  CHECK(place("000#0105") == Place::outside);
  CHECK(place("181#0041424344454647") == Place::outside);
  CHECK(place("00000601#0041424344454647") == Place::outside);
}

TEST_CASE("trace: a block download is shown from its begin to its end [301:7.2.4.3.8, 7.2.4.3.9, 7.2.4.3.10]") {
  Listener bus;
  CHECK(bus.hears("601#C600220010000000") == "SDO block download 2200h:00 picture, 16 bytes, CRC");
  CHECK(bus.hears("581#A400220002000000") == "SDO answer: 2200h:00 picture block download, blksize 2, CRC");
  CHECK(bus.hears("601#0141424344454647") == "SDO download block segment 1: \"ABCDEFG\"");
  CHECK(bus.hears("601#0201020304050607") == "SDO download block segment 2, 7 bytes");
  CHECK(bus.hears("581#A2027F0000000000") == "SDO answer: block segments confirmed up to 2, blksize 127");
  CHECK(bus.hears("601#8148490000000000") == "SDO download last block segment 1, up to 7 bytes");
  CHECK(bus.hears("581#A2017F0000000000") == "SDO answer: block segments confirmed up to 1, blksize 127");
  CHECK(bus.hears("601#D5C3310000000000") == "SDO block download end, 2 bytes in the last segment, CRC 31C3h");
  CHECK(bus.hears("581#A100000000000000") == "SDO answer: block download done");
}

TEST_CASE("trace: a block upload is shown from its begin to its end [301:7.2.4.3.13, 7.2.4.3.14, 7.2.4.3.15]") {
  Listener bus;
  CHECK(bus.hears("601#A4081000027F0000") == "SDO block upload 1008h:00 device name, blksize 2, pst 127, CRC");
  CHECK(bus.hears("581#C60810000F000000") == "SDO answer: 1008h:00 device name block upload, 15 bytes, CRC");
  CHECK(bus.hears("601#A300000000000000") == "SDO block upload start");
  CHECK(bus.hears("581#0141424344454647") == "SDO answer: block segment 1: \"ABCDEFG\"");
  CHECK(bus.hears("581#0248494A4B4C4D4E") == "SDO answer: block segment 2: \"HIJKLMN\"");
  CHECK(bus.hears("601#A2020A0000000000") == "SDO block segments confirmed up to 2, blksize 10");
  CHECK(bus.hears("581#8141000000000000") == "SDO answer: last block segment 1, up to 7 bytes");
  CHECK(bus.hears("601#A2010A0000000000") == "SDO block segments confirmed up to 1, blksize 10");
  CHECK(bus.hears("581#D934120000000000") == "SDO answer: block upload end, 1 byte in the last segment, CRC 1234h");
  CHECK(bus.hears("601#A100000000000000") == "SDO block upload done");
}

TEST_CASE("trace: block transfers without CRC and of unknown size are shown as such [301:7.2.4.3.9, 7.2.4.3.13]") {
  CHECK(meaning("601#C234120500000000") == "SDO block download 1234h:05, 0 bytes, no CRC");
  CHECK(meaning("601#C434120500000000") == "SDO block download 1234h:05, unknown size, CRC");
  CHECK(meaning("601#C034120500000000") == "SDO block download 1234h:05, unknown size, no CRC");
  CHECK(meaning("581#A03412057F000000") == "SDO answer: 1234h:05 block download, blksize 127, no CRC");
  CHECK(meaning("601#A03412057F000000") == "SDO block upload 1234h:05, blksize 127, pst 0, no CRC");
  CHECK(meaning("581#C234120500100000") == "SDO answer: 1234h:05 block upload, 4096 bytes, no CRC");
  CHECK(meaning("581#C034120500000000") == "SDO answer: 1234h:05 block upload, unknown size, no CRC");
  CHECK(meaning("601#DD00000000000000") == "SDO block download end, 0 bytes in the last segment, CRC 0000h");
  CHECK(meaning("581#C1FFFF0000000000") == "SDO answer: block upload end, 7 bytes in the last segment, CRC FFFFh");
}

TEST_CASE("trace: within a sub-block the first byte is a sequence number, not a command [D21]") {
  Listener bus;
  bus.hears("601#C200220010270000");
  bus.hears("581#A00022007F000000");
  CHECK(bus.hears("601#2300100000000000") == "SDO download block segment 35, 7 bytes");
  CHECK(bus.hears("601#4008100000000000") == "SDO download block segment 64, 7 bytes");
  CHECK(bus.hears("601#6000000000000000") == "SDO download block segment 96, 7 bytes");
  CHECK(bus.hears("581#A260030000000000") == "SDO answer: block segments confirmed up to 96, blksize 3");
  CHECK(bus.hears("601#C108100000000000") == "SDO download last block segment 65, up to 7 bytes");
  CHECK(bus.hears("581#A241030000000000") == "SDO answer: block segments confirmed up to 65, blksize 3");
  CHECK(bus.hears("601#C108100000000000") == "SDO block download end, 7 bytes in the last segment, CRC 1008h");
}

TEST_CASE("trace: within a sub-block only the byte 80h is an abort, which ends the transfer [D23]") {
  Listener bus;
  bus.hears("601#C200220010270000");
  bus.hears("581#A00022007F000000");
  CHECK(bus.hears("601#8102030405060708") == "SDO download last block segment 1, up to 7 bytes");
  bus.hears("581#A2007F0000000000");
  CHECK(bus.hears("601#8000220021000008") ==
        "SDO ABORT 2200h:00 picture: 0800 0021h data cannot be stored: local control");
  CHECK(bus.hears("601#4008100000000000") == "SDO upload 1008h:00 device name");
}

TEST_CASE("trace: after lost segments a sub-block continues behind its acknowledge [D22]") {
  Listener bus;
  bus.hears("601#A00022007F000000");
  bus.hears("581#C200220010000000");
  bus.hears("601#A300000000000000");
  bus.hears("581#0101020304050607");
  bus.hears("581#8301020000000000");  // segment 2 was lost
  CHECK(bus.hears("601#A2017F0000000000") == "SDO block segments confirmed up to 1, blksize 127");
  CHECK(bus.hears("581#0101020304050607") == "SDO answer: block segment 1, 7 bytes");
  CHECK(bus.hears("581#8201020000000000") == "SDO answer: last block segment 2, up to 7 bytes");
  CHECK(bus.hears("601#A2027F0000000000") == "SDO block segments confirmed up to 2, blksize 127");
  CHECK(bus.hears("581#D500000000000000") == "SDO answer: block upload end, 2 bytes in the last segment, CRC 0000h");
}

TEST_CASE("trace: after the last segment of a sub-block frames are commands until the acknowledge") {
  Listener bus;
  bus.hears("601#C200220010270000");
  bus.hears("581#A000220001000000");
  CHECK(bus.hears("601#0101020304050607") == "SDO download block segment 1, 7 bytes");
  CHECK(bus.hears("601#4008100000000000") == "SDO upload 1008h:00 device name");  // the client starts another transfer
  CHECK(bus.hears("581#4308100041424344") == "SDO answer: 1008h:00 device name = \"ABCD\"");
}

TEST_CASE("trace: after a refused block or a normal answer no segments follow [301:7.2.4.3.13]") {
  Listener bus;
  bus.hears("601#A4171000017F0000");
  CHECK(bus.hears("581#4B171000E8030000") == "SDO answer: 1017h:00 heartbeat time = 1000");
  bus.hears("601#A300000000000000");  // no block upload is open
  CHECK(bus.hears("581#4B171000E8030000") == "SDO answer: 1017h:00 heartbeat time = 1000");
  bus.hears("601#C200220010270000");
  CHECK(bus.hears("581#8000220001000405") == "SDO ABORT 2200h:00 picture: 0504 0001h command not valid or unknown");
  CHECK(bus.hears("601#2100220010270000") == "SDO download 2200h:00 picture, 10000 bytes in segments");
}

TEST_CASE("trace: a command of the other direction does not begin a sub-block") {
  Listener bus;
  bus.hears("601#C200220010270000");
  CHECK(bus.hears("601#A300000000000000") == "SDO block upload start");
  CHECK(bus.hears("601#4008100000000000") == "SDO upload 1008h:00 device name");
  bus.hears("601#A00022007F000000");
  CHECK(bus.hears("581#A00022007F000000") == "SDO answer: 2200h:00 picture block download, blksize 127, no CRC");
  CHECK(bus.hears("581#4308100041424344") == "SDO answer: 1008h:00 device name = \"ABCD\"");
}

TEST_CASE("trace: block transfers of several servers are independent") {
  Listener bus;
  bus.hears("601#C200220010270000");
  bus.hears("581#A00022007F000000");
  CHECK(bus.hears("602#4008100000000000") == "SDO upload 1008h:00 device name");
  CHECK(bus.hears("582#4308100041424344") == "SDO answer: 1008h:00 device name = \"ABCD\"");
  CHECK(bus.hears("601#4008100000000000") == "SDO download block segment 64, 7 bytes");
}

TEST_CASE("trace: segments and acknowledges of a block transfer can be folded except for the last ones") {
  Listener bus;
  CHECK(bus.place("601#C600220010000000") == Place::edge);
  CHECK(bus.place("581#A400220001000000") == Place::edge);
  CHECK(bus.place("601#0141424344454647") == Place::middle);
  CHECK(bus.place("581#A2017F0000000000") == Place::middle);
  CHECK(bus.place("601#0141424344454647") == Place::middle);
  CHECK(bus.place("601#8248490000000000") == Place::edge);
  CHECK(bus.place("581#A2027F0000000000") == Place::edge);
  CHECK(bus.place("601#D5C3310000000000") == Place::edge);
  CHECK(bus.place("581#A100000000000000") == Place::edge);
  CHECK(bus.place("601#A00022007F000000") == Place::edge);
  CHECK(bus.place("581#C200220010000000") == Place::edge);
  CHECK(bus.place("601#A300000000000000") == Place::edge);
  CHECK(bus.place("581#0141424344454647") == Place::middle);
}
