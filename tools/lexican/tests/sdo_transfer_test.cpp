// SPDX-License-Identifier: Apache-2.0
// SDO transfers, with the frames byte by byte from CiA 301, 7.2.4.
#include "describe/sdo_transfer.hpp"

#include <doctest/doctest.h>

#include <array>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace lexican::describe;
using Texts = std::vector<std::string>;
using End = SdoTransfer::End;

std::string hex(unsigned number, int digits) {
  char text[16];
  std::snprintf(text, sizeof text, "%0*X", digits, number);
  return text;
}

/// Returns a transfer as "write 2000:01 done 2 bytes 34 12".
std::string text_of(const SdoTransfer& transfer) {
  constexpr std::array<const char*, 4> ends = {"done", "refused", "cancelled", "unanswered"};
  std::string text = transfer.is_aborted_only ? "?" : transfer.is_download ? "write" : "read";
  text += ' ' + hex(transfer.index, 4) + ':' + hex(transfer.sub_index, 2) + ' ' +
          ends.at(static_cast<unsigned>(transfer.end));
  if (transfer.abort_code != 0) {
    text += ' ' + hex(transfer.abort_code, 8);
  }
  if (transfer.size != 0 || transfer.end == End::done) {
    text += ' ' + std::to_string(transfer.size) + " bytes";
    for (const std::uint8_t byte : transfer.data) {
      text += ' ' + hex(byte, 2);
    }
  }
  return text + (transfer.has_size ? "" : ", no size");
}

/// A client (C) and a server (S) on a bus, with a frame each millisecond.
struct Bus {
  SdoFollower follower;
  Texts ended;
  std::vector<SdoTransfer> transfers;
  Micros now = 1'000'000;

  void add(const std::optional<SdoTransfer>& transfer) {
    if (transfer) {
      ended.push_back(text_of(*transfer));
      transfers.push_back(*transfer);
    }
  }
  /// Frames as "C 40 18 10 01 00 00 00 00", one a line; missing bytes are 0.
  void frames(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string from;
      words >> from >> std::hex;
      if (from.empty()) {
        continue;
      }
      std::array<std::uint8_t, 8> data{};
      unsigned byte = 0;
      for (std::size_t n = 0; n < data.size() && words >> byte; ++n) {
        data.at(n) = static_cast<std::uint8_t>(byte);
      }
      now += 1000;
      add(follower.follow(from == "C", data.data(), now));
    }
  }
  /// Segments of a sub-block, whose bytes are the sequence number.
  void segments(const char* from, unsigned first, unsigned last, bool ends) {
    for (unsigned n = first; n <= last; ++n) {
      std::string line = std::string(from) + ' ' + hex(n | (ends && n == last ? 0x80U : 0U), 2);
      for (unsigned byte = 0; byte < 7; ++byte) {
        line += ' ' + hex(n, 2);
      }
      frames(line);
    }
  }
};

/// Returns the transfers that end with these frames.
Texts follow(const std::string& frames) {
  Bus bus;
  bus.frames(frames);
  return bus.ended;
}

TEST_CASE("SDO transfer: toggle bits that do not alternate") {
  Bus bus;
  bus.frames("C 40 08 10 00\nS 41 08 10 00 0E\nC 60\nS 00 11 22\nC 70\nS 11 33");
  bus.frames("C 40 08 10 00\nS 41 08 10 00 0E\nC 60\nS 10 11 22\nC 60\nS 01 33");  // of the server, of the client
  bus.frames("C 20 08 10 00\nS 60 08 10 00\nC 10 11\nS 20\nC 01 22\nS 20");        // begins with 1, and a wrong answer
  REQUIRE(bus.transfers.size() == 3);
  CHECK(bus.transfers[0].wrong_toggles == 0);
  CHECK(bus.transfers[1].wrong_toggles == 2);
  CHECK(bus.transfers[2].wrong_toggles == 2);
}

TEST_CASE("SDO transfer: segments of a block that were not confirmed, and a transfer that another one ends") {
  Bus bus;
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 04");
  bus.segments("C", 1, 4, false);
  bus.frames("S A2 02 04");  // 3 and 4 are lost
  bus.segments("C", 1, 2, true);
  bus.frames("S A2 02 04\nC D9\nS A1");
  bus.frames("C 40 08 10 00\nS 41 08 10 00 0E\nC 60\nC 40 00 10 00");
  REQUIRE(bus.transfers.size() == 2);
  CHECK(bus.transfers[0].lost_segments == 2);
  CHECK(!bus.transfers[0].is_displaced);
  CHECK(bus.transfers[1].is_displaced);
  CHECK(bus.transfers[1].lost_segments == 0);
}

}  // namespace

TEST_CASE("SDO transfer: expedited, with each size") {
  CHECK(follow("C 2F 00 20 01 11\nS 60 00 20 01") == Texts{"write 2000:01 done 1 bytes 11"});
  CHECK(follow("C 2B 00 20 01 11 22\nS 60 00 20 01") == Texts{"write 2000:01 done 2 bytes 11 22"});
  CHECK(follow("C 27 00 20 01 11 22 33\nS 60 00 20 01") == Texts{"write 2000:01 done 3 bytes 11 22 33"});
  CHECK(follow("C 23 00 20 01 11 22 33 44\nS 60 00 20 01") == Texts{"write 2000:01 done 4 bytes 11 22 33 44"});
  CHECK(follow("C 22 00 20 01 11 22\nS 60 00 20 01") == Texts{"write 2000:01 done 4 bytes 11 22 00 00, no size"});
  CHECK(follow("C 40 18 10 04\nS 4F 18 10 04 11") == Texts{"read 1018:04 done 1 bytes 11"});
  CHECK(follow("C 40 18 10 04\nS 4B 18 10 04 11 22") == Texts{"read 1018:04 done 2 bytes 11 22"});
  CHECK(follow("C 40 18 10 04\nS 47 18 10 04 11 22 33") == Texts{"read 1018:04 done 3 bytes 11 22 33"});
  CHECK(follow("C 40 18 10 04\nS 43 18 10 04 11 22 33 44") == Texts{"read 1018:04 done 4 bytes 11 22 33 44"});
  CHECK(follow("C 40 18 10 04\nS 42 18 10 04 11") == Texts{"read 1018:04 done 4 bytes 11 00 00 00, no size"});
}

TEST_CASE("SDO transfer: times of the request and of the answer") {
  Bus bus;
  bus.frames("C 40 18 10 04\nS 4F 18 10 04 11");
  REQUIRE(bus.transfers.size() == 1);
  CHECK(bus.transfers[0].begin == 1'001'000);
  CHECK(bus.transfers[0].time == 1'002'000);
  CHECK_FALSE(bus.follower.is_active());
}

TEST_CASE("SDO transfer: segmented") {
  CHECK(follow("C 21 08 10 00 09\nS 60 08 10 00\nC 00 41 42 43 44 45 46 47\nS 20\nC 1B 48 49\nS 30") ==
        Texts{"write 1008:00 done 9 bytes 41 42 43 44 45 46 47 48 49"});
  CHECK(follow("C 40 08 10 00\nS 41 08 10 00 09\nC 60\nS 00 41 42 43 44 45 46 47\nC 70\nS 1B 48 49") ==
        Texts{"read 1008:00 done 9 bytes 41 42 43 44 45 46 47 48 49"});
  CHECK(follow("C 20 08 10 00\nS 60 08 10 00\nC 00 41 42 43 44 45 46 47\nS 20\nC 1F\nS 30") ==
        Texts{"write 1008:00 done 7 bytes 41 42 43 44 45 46 47"});
  CHECK(follow("C 40 08 10 00\nS 40 08 10 00\nC 60\nS 0F") == Texts{"read 1008:00 done 0 bytes"});
}

TEST_CASE("SDO transfer: block download of two sub-blocks, the second with another blksize") {
  Bus bus;
  bus.frames("C C6 50 1F 01 1F\nS A4 50 1F 01 02");
  bus.segments("C", 1, 2, false);
  bus.frames("S A2 02 04");
  bus.segments("C", 1, 3, true);
  bus.frames("S A2 03 04\nC D1 34 12\nS A1");  // D1h: 4 unused bytes
  CHECK(bus.ended == Texts{"write 1F50:01 done 31 bytes 01 01 01 01 01 01 01 02 02 02 02 02 02 02 01 01 01 01 01 01 01 "
                           "02 02 02 02 02 02 02 03 03 03"});
  CHECK(bus.transfers[0].time == bus.now);
}

TEST_CASE("SDO transfer: segments of a block that look like commands") {
  Bus bus;
  bus.frames("C C2 50 1F 01\nS A0 50 1F 01 7F");
  bus.segments("C", 1, 127, false);  // 20h, 40h, 60h: other requests outside of a block
  bus.frames("S A2 7F 7F\nC 81 AA\nS A2 01 7F\nC D9\nS A1");
  REQUIRE(bus.transfers.size() == 1);
  CHECK(bus.transfers[0].end == End::done);
  CHECK(bus.transfers[0].size == 127 * 7 + 1);
  CHECK(bus.transfers[0].data.back() == 0xAA);
}

TEST_CASE("SDO transfer: block upload, with a lost segment that is repeated") {
  Bus bus;
  bus.frames("C A0 08 10 00 04\nS C6 08 10 00 1C\nC A3");
  bus.segments("S", 1, 4, true);
  bus.frames("C A2 02 04");  // the client has lost segment 3
  bus.frames("S 01 33 33 33 33 33 33 33\nS 82 44 44 44 44 44 44 44");
  bus.frames("C A2 02 04\nS C1\nC A1");
  CHECK(bus.ended == Texts{"read 1008:00 done 28 bytes 01 01 01 01 01 01 01 02 02 02 02 02 02 02 33 33 33 33 33 33 33 "
                           "44 44 44 44 44 44 44"});
}

TEST_CASE("SDO transfer: the receiver acknowledges nothing of a sub-block") {
  Bus bus;
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 02");
  bus.segments("C", 2, 2, true);  // segment 1 is lost
  bus.frames("S A2 00 02");
  bus.segments("C", 1, 2, true);
  bus.frames("S A2 02 02\nC C1\nS A1");
  CHECK(bus.ended == Texts{"write 1F50:01 done 14 bytes 01 01 01 01 01 01 01 02 02 02 02 02 02 02"});
}

TEST_CASE("SDO transfer: a segment that was not recorded is counted, and ends the data") {
  Bus bus;
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 04");
  bus.segments("C", 1, 1, false);
  bus.segments("C", 3, 4, false);
  bus.frames("S A2 04 04");
  bus.segments("C", 1, 1, true);
  bus.frames("S A2 01 04\nC C9\nS A1");
  CHECK(bus.ended == Texts{"write 1F50:01 done 33 bytes 01 01 01 01 01 01 01"});
}

TEST_CASE("SDO transfer: a block upload whose last segments and end were not recorded ends, too") {
  Bus bus;
  bus.frames("C A0 08 10 00 04\nS C0 08 10 00\nC A3\nS 01 41\nC A2 04 04\nS C1\nC A1");
  CHECK(bus.ended == Texts{"read 1008:00 done 28 bytes 41 00 00 00 00 00 00"});
}

TEST_CASE("SDO transfer: the server answers a block upload with an upload") {
  CHECK(follow("C A0 18 10 01 7F 14\nS 43 18 10 01 11 22 33 44") == Texts{"read 1018:01 done 4 bytes 11 22 33 44"});
  CHECK(follow("C A0 18 10 01 7F 14\nS 41 18 10 01 02\nC 60\nS 0B 41 42") == Texts{"read 1018:01 done 2 bytes 41 42"});
}

TEST_CASE("SDO transfer: aborts") {
  CHECK(follow("C 2F 00 20 01 11\nS 80 00 20 01 02 00 01 06") == Texts{"write 2000:01 refused 06010002 1 bytes 11"});
  CHECK(follow("C 40 00 20 01\nC 80 00 20 01 00 00 04 05") == Texts{"read 2000:01 cancelled 05040000"});
  CHECK(follow("C 40 00 20 01\nS 80 00 00 00 00 00 00 08") == Texts{"read 2000:01 refused 08000000"});
  CHECK(follow("S 80 00 20 01 02 00 01 06") == Texts{"? 2000:01 refused 06010002"});
  CHECK(follow("C 80 00 20 01 00 00 04 05") == Texts{"? 2000:01 cancelled 05040000"});
  Bus bus;
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 7F");
  bus.segments("C", 1, 1, false);
  bus.frames("C 80 50 1F 01 00 00 04 05");  // in place of segment 2
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 7F");
  bus.segments("C", 1, 1, false);
  bus.frames("S 80 50 1F 01 04 00 04 05");
  CHECK(bus.ended == Texts{"write 1F50:01 cancelled 05040000", "write 1F50:01 refused 05040004"});
}

TEST_CASE("SDO transfer: a late abort belongs to the earlier request") {
  CHECK(follow("C 40 00 20 01\nC 40 18 10 01\nS 80 00 20 01 00 00 04 05\nS 4F 18 10 01 11") ==
        Texts{"read 2000:01 unanswered", "? 2000:01 refused 05040000", "read 1018:01 done 1 bytes 11"});
}

TEST_CASE("SDO transfer: a request without answer, then another") {
  CHECK(follow("C 40 00 20 01\nC 40 18 10 01\nS 4F 18 10 01 11") ==
        Texts{"read 2000:01 unanswered", "read 1018:01 done 1 bytes 11"});
  // The late answer to the first request is not one to the second.
  CHECK(follow("C 40 00 20 01\nC 40 18 10 01\nS 4F 00 20 01 99\nS 4F 18 10 01 11") ==
        Texts{"read 2000:01 unanswered", "read 1018:01 done 1 bytes 11"});
  CHECK(follow("C 2F 00 20 01 11\nC 2F 00 20 02 22\nS 60 00 20 01\nS 60 00 20 02") ==
        Texts{"write 2000:01 unanswered 1 bytes 11", "write 2000:02 done 1 bytes 22"});
}

TEST_CASE("SDO transfer: a sub-block without an acknowledge, then another request") {
  Bus bus;
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 02");
  bus.segments("C", 1, 2, false);
  bus.frames("C 40 18 10 01\nS 4F 18 10 01 11");
  CHECK(bus.ended == Texts{"write 1F50:01 unanswered", "read 1018:01 done 1 bytes 11"});
}

TEST_CASE("SDO transfer: time-out") {
  Bus bus;
  bus.frames("C 40 00 20 01");
  bus.add(bus.follower.expire(bus.now + SdoFollower::answer_time));
  bus.add(bus.follower.expire(0));  // time goes back
  CHECK(bus.ended.empty());
  bus.add(bus.follower.expire(bus.now + SdoFollower::answer_time + 1));
  bus.add(bus.follower.expire(bus.now + 2 * SdoFollower::answer_time));
  CHECK(bus.ended == Texts{"read 2000:01 unanswered"});
  CHECK(bus.transfers[0].time == bus.now);
  CHECK_FALSE(bus.transfers[0].is_answered);
  bus.frames("C 40 08 10 00\nS 41 08 10 00 09");
  bus.add(bus.follower.close());
  bus.add(bus.follower.close());
  CHECK(bus.ended.size() == 2);
  CHECK(bus.transfers[1].is_answered);
}

TEST_CASE("SDO transfer: the time-out does not begin again with frames that are ignored") {
  Bus bus;
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 7F\nC 40 18 10 01\nC 40 18 10 01");  // the client begins anew within a block
  bus.add(bus.follower.expire(bus.now + SdoFollower::answer_time));
  CHECK(bus.ended == Texts{"write 1F50:01 unanswered"});
}

TEST_CASE("SDO transfer: more than 4096 bytes are counted, the first are stored") {
  Bus bus;
  bus.frames("C 40 03 10 00\nS 41 03 10 00");
  for (unsigned n = 0; n < 1000; ++n) {
    bus.frames("C 60\nS 00 01 02 03 04 05 06 07\nC 70\nS 10 01 02 03 04 05 06 07");
  }
  bus.frames("C 60\nS 01 01 02 03 04 05 06 07");
  REQUIRE(bus.transfers.size() == 1);
  CHECK(bus.transfers[0].size == 2001 * 7);
  CHECK(bus.transfers[0].data.size() == SdoFollower::most_data);
  CHECK(bus.transfers[0].data.capacity() <= 2 * SdoFollower::most_data);
}

TEST_CASE("SDO transfer: unused bytes at the limit of the stored data") {
  Bus bus;
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 7F");
  for (unsigned sub_block = 0; sub_block < 5; ++sub_block) {  // 586 segments, 4102 bytes
    const unsigned number = sub_block < 4 ? 127 : 78;
    bus.segments("C", 1, number, sub_block == 4);
    bus.frames("S A2 " + hex(number, 2) + " 7F");
  }
  bus.frames("C D9\nS A1");  // 6 unused bytes
  REQUIRE(bus.transfers.size() == 1);
  CHECK(bus.transfers[0].size == 4096);
  CHECK(bus.transfers[0].data.size() == 4096);
}

TEST_CASE("SDO transfer: frames that belong to no transfer are ignored") {
  Bus bus;
  for (const std::string frame : {"S 4F 18 10 01 11", "S 60 00 20 01", "S 20", "S 00 01", "S A0 00 20 01 7F", "S A1",
                                  "S A2 01 7F", "S C0 00 20 01", "S C1", "S E0", "C 60", "C 00 01", "C A1",
                                  "C A2 01 7F", "C A3", "C C1", "C E0", "C 00", "S 00"}) {
    bus.frames(frame);
    CHECK_MESSAGE(!bus.follower.was_followed(), frame);
    CHECK_MESSAGE(!bus.follower.is_active(), frame);
  }
  CHECK(bus.ended.empty());
}

TEST_CASE("SDO transfer: frames of other services within a transfer are ignored") {
  Bus bus;
  bus.frames("C 40 08 10 00\nS 41 08 10 00 02");
  for (const std::string frame :
       {"C 00 99", "S 20", "S 60 08 10 00", "S A0 08 10 00 7F", "S A1", "S E0", "C A1", "C C1", "C A2 01 7F", "C E0"}) {
    bus.frames(frame);
    CHECK_MESSAGE(!bus.follower.was_followed(), frame);
  }
  bus.frames("C 60\nS 0B 41 42");
  CHECK(bus.ended == Texts{"read 1008:00 done 2 bytes 41 42"});
  bus.frames("C 2F 00 20 01 11");
  for (const std::string frame : {"C 01 99", "S 20", "S 00 99", "S 4F 00 20 01 99", "C 60", "C A3", "C A1", "S C1"}) {
    bus.frames(frame);
    CHECK_MESSAGE(!bus.follower.was_followed(), frame);
  }
  bus.frames("S 60 00 20 01");
  CHECK(bus.ended.back() == "write 2000:01 done 1 bytes 11");
}

TEST_CASE("SDO transfer: sequence number 0, acknowledge beyond the sub-block, end twice") {
  Bus bus;
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 03\nC 00 99\nC 01 11\nC 01 22\nS A2 FF 02");
  bus.frames("C 81 33\nS A2 01 02\nC C9\nC C9\nS A1");
  CHECK(bus.ended == Texts{"write 1F50:01 done 26 bytes 11 00 00 00 00 00 00"});
}

TEST_CASE("SDO transfer: endless transfers have bounded data") {
  Bus bus;
  bus.frames("C C0 50 1F 01\nS A0 50 1F 01 00");
  for (unsigned n = 0; n < 20; ++n) {
    bus.segments("C", 1, 127, false);
    bus.frames("S A2 7F FF");
  }
  for (unsigned n = 0; n < 1000; ++n) {
    bus.frames("S A2 7F 7F\nS A2 7F 7F");  // no segments
  }
  bus.frames("S 80 50 1F 01");
  REQUIRE(bus.transfers.size() == 1);
  CHECK(bus.transfers[0].size == 2020 * 127 * 7);
  CHECK(bus.transfers[0].data.size() <= SdoFollower::most_data);
}
