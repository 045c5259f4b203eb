// SPDX-License-Identifier: Apache-2.0
// slcan texts that are received and sent, and malformed ones.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "co_slcan.h"
#include "support/notation.hpp"

namespace {

constexpr std::int16_t taken = sizeof(CO_IF_FRM);

/// A controller, and the test side of its serial line.
struct Line {
  explicit Line(std::uint16_t capacity = 8) : frames(capacity) {
    const auto note = [](void* line) { ++static_cast<Line*>(line)->starts; };
    REQUIRE(COSlcanInit(&can, frames.data(), capacity, note, this));
    SlcanDriver.Init(&can);
  }

  void open() {
    SlcanDriver.Enable(&can, 0);
    take();
    starts = 0;
  }
  void receive(std::string_view text) {
    for (const char character : text) {
      COSlcanReceive(&can, static_cast<std::uint8_t>(character));
    }
  }
  /// Returns the frame that the node reads, in candump notation; empty: none.
  std::string read() {
    CO_IF_FRM frame{};
    const std::int16_t result = SlcanDriver.Read(&can, &frame);
    return result == 0 ? std::string() : test::notation(frame);
  }
  std::int16_t send(std::string_view text) {
    const CO_IF_FRM frame = test::frame(text);
    return SlcanDriver.Send(&can, &frame);
  }
  /// Returns the next characters that the controller sends, at most \a most.
  std::string take(std::uint32_t most = 1000) {
    std::string text;
    const std::uint8_t* bytes = nullptr;
    for (std::uint32_t num = COSlcanPending(&can, &bytes); num != 0 && most != 0; num = COSlcanPending(&can, &bytes)) {
      num = std::min(num, most);
      text.append(reinterpret_cast<const char*>(bytes), num);
      COSlcanSent(&can, num);
      most -= num;
    }
    return text;
  }
  unsigned malformed() const { return COSlcanMalformed(&can); }

  std::vector<CO_IF_FRM> frames;
  CO_SLCAN can{};
  unsigned starts = 0;
};

}  // namespace

TEST_CASE("slcan: frames are sent as lines: t, T, r and R with capital digits") {
  Line line;
  line.open();
  CHECK(line.send("601#2B1710006400ABCD") == taken);
  CHECK(line.take() == "t60182B1710006400ABCD\r");
  CHECK(line.send("1ABCDEF0#0102") == taken);
  CHECK(line.take() == "T1ABCDEF020102\r");
  CHECK(line.send("080#") == taken);
  CHECK(line.take() == "t0800\r");
  CHECK(line.send("701#R") == taken);
  CHECK(line.take() == "r7010\r");
  CO_IF_FRM remote = {CO_IF_FRM_EXT | CO_IF_FRM_RTR | 0x12u, {}, 5};
  CHECK(SlcanDriver.Send(&line.can, &remote) == taken);
  CHECK(line.take() == "R000000125\r");
  CHECK(line.starts == 5);
}

TEST_CASE("slcan: an identifier above 7FFh is sent with 29 bits, a length above 8 as 8") {
  Line line;
  line.open();
  const CO_IF_FRM frame = {0x800, {1, 2, 3, 4, 5, 6, 7, 8}, 15};
  CHECK(SlcanDriver.Send(&line.can, &frame) == taken);
  CHECK(line.take() == "T0000080080102030405060708\r");
}

TEST_CASE("slcan: received lines are frames, including small letters and a time stamp") {
  Line line;
  line.open();
  line.receive("t60182B1710006400abcd\rT1ABCDEF020102\rr7010\rR000000125\rt0800\r");
  CHECK(line.read() == "601#2B1710006400ABCD");
  CHECK(line.read() == "1ABCDEF0#0102");
  CHECK(line.read() == "701#R");
  CHECK(line.read().substr(0, 10) == "00000012#R");
  CHECK(line.read() == "080#");
  CHECK(line.read().empty());
  line.receive("t70117F1A2B\rT000000011FFEA5F\rr70104321\r");
  CHECK(line.read() == "701#7F");
  CHECK(line.read() == "00000001#FF");
  CHECK(line.read() == "701#R");
  CHECK(line.malformed() == 0);
}

TEST_CASE("slcan: answers, commands of a peer, empty lines and line feeds are ignored") {
  Line line;
  line.open();
  line.receive("\r\rz\rZ\rC\rS6\rO\r\r\nt70117F\r\nt701105\r\n\n");
  CHECK(line.read() == "701#7F");
  CHECK(line.read() == "701#05");
  CHECK(line.read().empty());
  CHECK(line.malformed() == 0);
}

TEST_CASE("slcan: an invalid line is dropped and counted, and the next one is received") {
  const char* const lines[] = {
      "t",                                // only the letter
      "t70",                              // incomplete identifier
      "t701",                             // no length
      "t8000",                            // more than 11 bits
      "T200000000",                       // more than 29 bits
      "t7019112233445566778899",          // 9 bytes
      "t701A00",                          // length is not a decimal digit
      "t7012AA",                          // incomplete data
      "t7012AAB",                         // likewise
      "t7011AA0",                         // neither data nor a time stamp
      "t7011AA01",                        // likewise
      "t7011AA012",                       // likewise
      "t7011AA01234",                     // likewise
      "t7011AA012G",                      // time stamp is not a number
      "t7011A/",                          // not a hexadecimal digit: below '0'
      "t7011A:",                          // above '9'
      "t7011A@",                          // below 'A'
      "t7011AG",                          // above 'F'
      "t7011Ag",                          // likewise
      "t7G11AA",                          // in the identifier
      "t 7011AA",                         // space
      "t70105",                           // half a byte after length 0
      "t701\n1AA",                        // line feed within the frame
      "r70111",                           // a remote frame has no data
      "T7011AA",                          // 11-bit identifier after the letter for 29 bits
      "x7011AA",                          // unknown letter
      "7011AA",                           // no letter
      "V1013",                            // answer without a request
      "zt7011AA",                         // two commands in one line
      "Ct7011AA",                         // likewise
      "S",                                // missing bit rate
      "S66",                              // likewise
      "t7011t7011AA",                     // lost end of line
      "T1ABCDEF08112233445566778812345",  // one digit more than the longest
      "t7018112233445566778812345678901234567890123456789012345678901234567890",
  };
  for (const char* text : lines) {
    CAPTURE(text);
    Line line;
    line.open();
    line.receive(std::string(text) + '\r');
    CHECK(line.read().empty());
    CHECK(line.malformed() == 1);
    line.receive("t7011AA\r");
    CHECK(line.read() == "701#AA");
    CHECK(line.malformed() == 1);
  }
}

TEST_CASE("slcan: the longest line is received") {
  Line line;
  line.open();
  line.receive("T1ABCDEF081122334455667788ABCD\r");
  CHECK(line.read() == "1ABCDEF0#1122334455667788");
  CHECK(line.malformed() == 0);
}

TEST_CASE("slcan: after any byte anywhere in a line the next line is received") {
  const std::string good = "t60182B17100064000000";
  for (std::size_t place = 0; place <= good.size(); ++place) {
    for (unsigned byte = 0; byte < 256; ++byte) {
      Line line;
      line.open();
      std::string text = good;
      text.insert(place, 1, static_cast<char>(byte));
      line.receive(text + "\rt0800\r");
      std::string last;
      unsigned read = 0;
      for (std::string frame = line.read(); !frame.empty(); frame = line.read()) {
        last = frame;
        ++read;
      }
      CAPTURE(place);
      CAPTURE(byte);
      CHECK(last == "080#");
      CHECK(read <= 2);
    }
  }
}

TEST_CASE("slcan: a truncated line is never received as another frame") {
  const std::string good = "t60182B17100064000000";
  for (std::size_t place = 1; place < good.size(); ++place) {
    Line line;
    line.open();
    line.receive(good.substr(0, place) + "\rt0800\r");
    CAPTURE(place);
    CHECK(line.read() == "080#");
    CHECK(line.malformed() == 1);
  }
}

TEST_CASE("slcan: a line with lost bytes is dropped") {
  Line line;
  line.open();
  line.receive("t7011");
  COSlcanBroken(&line.can);
  line.receive("AA\rt7011BB\r");
  CHECK(line.read() == "701#BB");
  CHECK(line.malformed() == 1);
}

TEST_CASE("slcan: BELL is counted as a refusal and ends the line before it") {
  Line line;
  line.open();
  line.receive("\at70\at7011AA\r");
  CHECK(COSlcanRefused(&line.can) == 2);
  CHECK(line.read() == "701#AA");
  CHECK(line.malformed() == 0);
}

TEST_CASE("slcan: Enable sends close, the bit rate and open") {
  struct {
    std::uint32_t rate;
    const char* text;
  } const rates[] = {
      {10000, "C\rS0\rO\r"},   {20000, "C\rS1\rO\r"},  {50000, "C\rS2\rO\r"},  {100000, "C\rS3\rO\r"},
      {125000, "C\rS4\rO\r"},  {250000, "C\rS5\rO\r"}, {500000, "C\rS6\rO\r"}, {800000, "C\rS7\rO\r"},
      {1000000, "C\rS8\rO\r"}, {83333, "C\rO\r"},      {0, "C\rO\r"},
  };
  for (const auto& each : rates) {
    CAPTURE(each.rate);
    Line line;
    SlcanDriver.Enable(&line.can, each.rate);
    CHECK(line.take() == each.text);
    CHECK(line.starts == 1);
    SlcanDriver.Close(&line.can);
    CHECK(line.take() == "C\r");
  }
  Line line;
  line.can.Baud = 250000;
  SlcanDriver.Enable(&line.can, 0);
  CHECK(line.take() == "C\rS5\rO\r");
}

TEST_CASE("slcan: nothing is received before Enable and after Close; Enable and Reset drop received bytes") {
  Line line;
  line.receive("t0800\r");
  line.open();
  CHECK(line.read().empty());
  line.receive("t0800\r");
  SlcanDriver.Reset(&line.can);
  CHECK(line.read().empty());
  line.receive("t0800\rt7011AA\r");
  line.open();
  CHECK(line.read().empty());
  line.receive("t0800\r");
  SlcanDriver.Init(&line.can);
  CHECK(line.read().empty());
  line.open();
  SlcanDriver.Close(&line.can);
  line.receive("t0800\r");
  CHECK(line.read().empty());
  CHECK(line.malformed() == 0);
}

TEST_CASE("slcan: nothing is sent before Enable and after Close") {
  Line line;
  CHECK(line.send("601#") < 0);
  line.open();
  CHECK(line.send("601#") == taken);
  SlcanDriver.Close(&line.can);
  CHECK(line.send("601#") < 0);
  CHECK(line.take() == "t6010\rC\r");
}

TEST_CASE("slcan: Send accepts a complete frame or nothing, and never blocks") {
  Line line;
  line.open();
  CHECK(line.send("601#0102030405060708") == taken);
  CHECK(line.send("602#0102030405060708") == taken);
  CHECK(line.send("603#0102030405060708") == 0);
  CHECK(line.send("080#") == 0);
  CHECK(line.starts == 2);
  CHECK(line.take(8) == "t6018010");
  CHECK(line.send("603#0102030405060708") == 0);
  CHECK(line.take(14) == "2030405060708\r");
  CHECK(line.send("603#0102030405060708") == taken);
  CHECK(line.take() == "t60280102030405060708\rt60380102030405060708\r");
}

TEST_CASE("slcan: frames leave space for commands in the buffer") {
  Line line;
  line.open();
  CHECK(line.send("601#0102030405060708") == taken);
  CHECK(line.send("602#0102030405060708") == taken);
  SlcanDriver.Close(&line.can);
  SlcanDriver.Enable(&line.can, 500000);
  CHECK(line.take() == "t60180102030405060708\rt60280102030405060708\rC\rC\rS6\rO\r");
}

TEST_CASE("slcan: unread text blocks neither commands nor frames") {
  Line line;
  for (unsigned n = 0; n < 100; ++n) {
    SlcanDriver.Close(&line.can);
    SlcanDriver.Enable(&line.can, 500000);
    line.send("601#0102030405060708");
  }
  CHECK(line.send("080#") == 0);
  CHECK(line.take().size() <= CO_SLCAN_TX_BYTES);
  CHECK(line.send("080#") == taken);
  CHECK(line.take() == "t0800\r");
}

TEST_CASE("slcan: a full ring drops new frames, and Read reports it once as an error frame") {
  Line line(2);
  line.open();
  line.receive("t0010\rt0020\rt0030\rt0040\r");
  CHECK(line.read() == "20000004#0001000000000000");
  CHECK(line.read() == "001#");
  CHECK(line.read() == "002#");
  CHECK(line.read().empty());
  line.receive("t0050\r");
  CHECK(line.read() == "005#");
  CHECK(line.read().empty());
}

TEST_CASE("slcan: the CPU may sleep if nothing is received and no refused frame can be sent") {
  Line line(2);
  line.open();
  CHECK_FALSE(COSlcanIsDue(&line.can));
  line.receive("t001");
  CHECK_FALSE(COSlcanIsDue(&line.can));
  line.receive("0\r");
  CHECK(COSlcanIsDue(&line.can));
  line.read();
  CHECK_FALSE(COSlcanIsDue(&line.can));
  line.receive("t0010\rt0020\rt0030\r");
  while (!line.read().empty()) {
  }
  CHECK_FALSE(COSlcanIsDue(&line.can));

  line.send("601#0102030405060708");
  line.send("602#0102030405060708");
  CHECK_FALSE(COSlcanIsDue(&line.can));
  CHECK(line.send("1ABCDEF0#0102030405060708") == 0);
  CHECK_FALSE(COSlcanIsDue(&line.can));
  line.take();
  CHECK(COSlcanIsDue(&line.can));
  CHECK(line.send("1ABCDEF0#0102030405060708") == taken);
  CHECK_FALSE(COSlcanIsDue(&line.can));
}

TEST_CASE("slcan: after a refused frame COSlcanIsDue is true once all text is sent") {
  for (std::uint32_t before = 0; before < 44; ++before) {
    Line line;
    line.open();
    line.send("601#0102030405060708");
    line.send("602#0102030405060708");
    line.take(before);
    if (line.send("1ABCDEF0#0102030405060708") == 0) {
      line.take();
      CHECK(COSlcanIsDue(&line.can));
      CHECK(line.send("1ABCDEF0#0102030405060708") == taken);
    }
  }
}

TEST_CASE("slcan: two controllers communicate without an adapter") {
  Line one(64);
  Line other(64);
  SlcanDriver.Enable(&one.can, 500000);
  SlcanDriver.Enable(&other.can, 500000);
  one.receive(other.take());
  other.receive(one.take());
  for (unsigned n = 0; n < 50; ++n) {
    CHECK(one.send("601#4000100000000000") == taken);
    CHECK(other.send("581#4300100000000000") == taken);
    other.receive(one.take());
    one.receive(other.take());
    CHECK(other.read() == "601#4000100000000000");
    CHECK(one.read() == "581#4300100000000000");
  }
  CHECK(one.malformed() + other.malformed() == 0);
}

TEST_CASE("slcan: a missing ring, buffer or start function is refused") {
  CO_SLCAN can;
  CO_IF_FRM frames[2];
  const auto nothing = [](void*) {};
  CHECK_FALSE(COSlcanInit(nullptr, frames, 2, nothing, nullptr));
  CHECK_FALSE(COSlcanInit(&can, nullptr, 2, nothing, nullptr));
  CHECK_FALSE(COSlcanInit(&can, frames, 0, nothing, nullptr));
  CHECK_FALSE(COSlcanInit(&can, frames, 2, nullptr, nullptr));
  CHECK(COSlcanInit(&can, frames, 2, nothing, nullptr));
}
