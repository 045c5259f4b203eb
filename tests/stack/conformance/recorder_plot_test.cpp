// SPDX-License-Identifier: Apache-2.0
// Recorder: the plot, generated while it is read.
#include <random>
#include <sstream>

#include "support/recorder_fixture.hpp"

#if USE_RECORDER

namespace {

using namespace test;

constexpr std::uint32_t wrong_state = 0x08000022;

std::string text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// Returns a CSV line for each value from one to another; the value is also its time in milliseconds.
std::string lines(std::uint32_t first, std::uint32_t last) {
  std::string all;
  for (std::uint32_t value = first; value <= last; ++value) {
    all += std::to_string(value) + ";" + std::to_string(value) + "\n";
  }
  return all;
}

void record(RecorderNode& node, std::uint32_t first, std::uint32_t last) {
  for (std::uint32_t value = first; value <= last; ++value) node.record({value});
}

TEST_CASE("plot: binary points are pairs of time and value [R4]") {
  RecorderNode node(Recorded().format(CO_RECORDER_BINARY));
  node.record({0x11223344, -2});
  node.ask("601#4001240500000000", "581#4001240500000000");
  node.ask("601#6000000000000000", "581#0001000000443322");
  node.ask("601#7000000000000000", "581#101102000000FEFF");
  node.ask("601#6000000000000000", "581#0BFFFF0000000000");
}

TEST_CASE("plot: without points it is empty [R4]") {
  for (const unsigned format : {CO_RECORDER_CSV, CO_RECORDER_BINARY}) {
    RecorderNode node(Recorded().format(format));
    node.ask("601#4001240500000000", "581#4001240500000000");
    node.ask("601#6000000000000000", "581#0F00000000000000");
    node.ask("601#4001240500000000", "581#4001240500000000");
  }
}

TEST_CASE("plot: every decimal length is written [R4]") {
  RecorderNode node;
  node.record({1, 10, 99, 100, 1000000, 2147483647, -2147483648LL, -1, -10, 0});
  CHECK(node.plot() == "1;1\n2;10\n3;99\n4;100\n5;1000000\n6;2147483647\n7;-2147483648\n8;-1\n9;-10\n10;0\n");
}

// Points of an upload ------------------------------------------------------------------------------------------------

TEST_CASE("plot: a read sees the points of its begin and removes them [R4]") {
  RecorderNode node;
  record(node, 1, 3);
  node.ask("601#4001240500000000", "581#4001240500000000");
  record(node, 4, 6);
  node.ask("601#6000000000000000", "581#00313B310A323B32");
  CHECK(CORecorderCount(&node.recorder) == 6);
  node.ask("601#7000000000000000", "581#150A333B330A0000");
  CHECK(node.plot() == lines(4, 6));
  CHECK(node.held() == 0);
}

TEST_CASE("plot: points that are overwritten before they are sent are left out [R4]") {
  RecorderNode node(Recorded().size(4));
  record(node, 1, 4);
  node.ask("601#4001240500000000", "581#4001240500000000");
  node.ask("601#6000000000000000", "581#00313B310A323B32");
  record(node, 5, 6);  // overwrite 1 and 2; 2 is sent in part
  node.ask("601#7000000000000000", "581#100A333B330A343B");
  record(node, 7, 8);  // overwrite 3 and 4; 4 is sent in part
  node.ask("601#6000000000000000", "581#0B340A0000000000");
  CHECK(node.plot() == lines(5, 8));
}

TEST_CASE("plot: it ends early if all points are overwritten [R4]") {
  RecorderNode node(Recorded().size(4));
  record(node, 1, 4);
  node.ask("601#4001240500000000", "581#4001240500000000");
  record(node, 5, 14);
  node.ask("601#6000000000000000", "581#0F00000000000000");
  CHECK(node.plot() == lines(11, 14));
}

TEST_CASE("plot: an aborted read removes nothing [R4]") {
  RecorderNode node;
  record(node, 1, 3);
  node.ask("601#4001240500000000", "581#4001240500000000");
  node.ask("601#6000000000000000", "581#00313B310A323B32");
  node.rx("601#8001240500000008");
  CHECK(node.held() == 3);
  node.ask("601#4001240500000000", "581#4001240500000000");
  node.after(node.sdo_time_out());
  node.tx("581#8001240500000405");
  CHECK(node.configure(1, 8) == 0);
  CHECK(node.held() == 0);
}

TEST_CASE("plot: the configuration is not changed during a read [R4] [R5]") {
  RecorderNode node;
  record(node, 1, 3);
  node.call([&] {
    CO_SDO* const server = node->Sdo;
    CHECK(server[0].Flow.State == 0);
  });
  node.ask("601#4001240500000000", "581#4001240500000000");
  node.call([&] {
    CO_RECORDER_CONFIG config = node.recorder.Config;
    config.Size = 1;
    CHECK(CORecorderConfigure(&node.recorder, &config) == CO_ERR_OBJ_STATE);
    CHECK(CORecorderClear(&node.recorder) == CO_ERR_OBJ_STATE);
    CHECK(CORecorderStart(&node.node, &node.recorder) == CO_ERR_OBJ_STATE);
  });
  node.ask("601#6000000000000000", "581#00313B310A323B32");
  node.ask("601#7000000000000000", "581#150A333B330A0000");
  CHECK(node.configure(1, 1) == 0);
}

#if CO_SSDO_N > 1
TEST_CASE("plot: another client can neither read it nor change the configuration meanwhile [R4] [R5]") {
  RecorderNode node;
  CHECK(node.download(0x1201, 1, {0x90, 0x06, 0, 0}) == 0);
  CHECK(node.download(0x1201, 2, {0xA0, 0x06, 0, 0}) == 0);
  node.trace();
  record(node, 1, 3);
  node.ask("601#4001240500000000", "581#4001240500000000");
  node.ask("690#4001240500000000", "6A0#8001240522000008");
  for (const char* request :
       {"690#2301230108000000", "690#2F01230202000000", "690#2301230400000000", "690#230123050800012E",
        "690#2F01230601000000", "690#2F01230701000000", "690#2301230801000000", "690#2301230901000000",
        "690#2B01230A02000000", "690#2301240100000000"}) {
    const std::string_view multiplexer = std::string_view(request).substr(6, 6);
    node.ask(request, "6A0#80" + std::string(multiplexer) + "22000008");
  }
  node.ask("601#6000000000000000", "581#00313B310A323B32");
  node.ask("601#7000000000000000", "581#150A333B330A0000");
  node.ask("690#4001240500000000", "6A0#4001240500000000");
}
#endif

TEST_CASE("plot: the application cannot read it as an object [R4]") {
  RecorderNode node;
  record(node, 1, 3);
  std::uint8_t buffer[8] = {};
  node.call([&] {
    CHECK(COObjRdBufStart(node.find(0x2401, 5), &node.node, buffer, 8) == CO_ERR_OBJ_STATE);
    CHECK(COObjRdBufCont(node.find(0x2401, 5), &node.node, buffer, 8) == CO_ERR_OBJ_STATE);
  });
  CHECK(node.plot() == lines(1, 3));
}

TEST_CASE("plot: null Data is refused [R4]") {
  Fixture node(Setup().only_small().with({CO_KEY(0x2401, 5, CO_OBJ_____R_), CO_TREC_PLOT, 0}));
  node.ask("601#4001240500000000", "581#8001240520000008");
#if USE_SDO_BLOCK
  node.ask("601#A401240501000000", "581#8001240520000008");
#endif
}

TEST_CASE("plot: a reset ends the read [R4] [R6]") {
  RecorderNode node;
  record(node, 1, 3);
  node.ask("601#4001240500000000", "581#4001240500000000");
  node.ask("000#8201", "701#00");
  node.ask("601#6000000000000000", "581#8000000001000405");
  CHECK(node.configure(1, 8) == 0);
  node.ask("601#4001240500000000", "581#4001240500000000");
  node.init_again();
  node.call([&] { CONodeStart(&node.node); });
  node.trace();
  CHECK(node.configure(1, 7) == 0);
}

TEST_CASE("plot: an entry that CODictInit() moves ends the read [R4]") {
  RecorderNode node;
  record(node, 1, 3);
  node.ask("601#4001240500000000", "581#4001240500000000");
  std::vector<CO_OBJ> table(node->Dict.Root, node->Dict.Root + node->Dict.Num);
  table.insert(table.begin() + 1, CO_OBJ{CO_KEY(0x1000, 1, CO_OBJ_D___R_), CO_TUNSIGNED8, 0});
  CO_OBJ* const root = node->Dict.Root;
  const std::uint16_t num = node->Dict.Num;
  node.call([&] { CODictInit(&node->Dict, &node.node, table.data(), static_cast<std::uint16_t>(table.size())); });
  node.ask("601#6000000000000000", "581#8001240522000008");
  CHECK(CORecorderClear(&node.recorder) == CO_ERR_NONE);
  record(node, 4, 5);
  CHECK(node.plot() == lines(4, 5));
  node.call([&] { CODictInit(&node->Dict, &node.node, root, num); });
}

// Block transfer ------------------------------------------------------------------------------------------------------

#if USE_SDO_BLOCK
TEST_CASE("plot: a block upload has an unknown size and its end [R4]") {
  RecorderNode node;
  node.record({5, 6});
  node.ask("601#A401240501000000", "581#C401240500000000");
  node.ask("601#A300000000000000", "581#01313B350A323B36");
  node.ask("601#A201010000000000", "581#810A000000000000");
}

TEST_CASE("plot: it is the same by every kind of transfer [R4]") {
  for (const unsigned format : {CO_RECORDER_CSV, CO_RECORDER_BINARY}) {
    for (const unsigned blksize : {1U, 2U, 5U, 127U}) {
      CAPTURE(format);
      RecorderNode in_segments(Recorded().format(format).memory(300).size(300).name("speed"));
      RecorderNode in_blocks(Recorded().format(format).memory(300).size(300).name("speed"));
      record(in_segments, 1, 200);
      record(in_blocks, 1, 200);
      BlockOptions options;
      options.blksizes = {static_cast<std::uint8_t>(blksize)};
      const BlockResult result = in_blocks.block_upload(0x2401, 5, options);
      CHECK(result.abort == 0);
      CHECK(text(result.data) == in_segments.plot());
      CHECK(CORecorderCount(&in_blocks.recorder) == 0);
    }
  }
}

// A client that acknowledges any number of the segments of each block, with any size of the next block.
class LossyClient {
 public:
  LossyClient(RecorderNode& node, unsigned seed) : node_(node), random_(seed) {
    constexpr unsigned longest_block = 127;
    node_.frames_per_call(longest_block);
    node_.ask("601#A401240514000000", "581#C401240500000000");
    send(0xA3, 0, 0);
  }

  // Receives a block and acknowledges it. Returns false after the last block and after an abort.
  bool step() {
    const std::size_t sent = block_.size();
    if (sent == 0 || (block_[0].Data[0] & 0x7FU) != 1) {
      return false;
    }
    const std::size_t counts[] = {0, 1, random_() % (sent + 1), sent};
    const std::size_t received = counts[random_() % 4];
    for (std::size_t n = 0; n < received; ++n) {
      data.insert(data.end(), block_[n].Data + 1, block_[n].Data + 8);
    }
    const bool is_last = received == sent && (block_.back().Data[0] & 0x80U) != 0;
    send(0xA2, received, random_() % 2 == 0 ? 127 : random_() % 127 + 1);
    if (is_last) {
      end();
    }
    return !is_last;
  }

  Bytes data;
  bool is_complete = false;

 private:
  void send(unsigned command, std::size_t ackseq, std::size_t blksize) {
    CO_IF_FRM request = frame("601#0000000000000000");
    request.Data[0] = static_cast<std::uint8_t>(command);
    request.Data[1] = static_cast<std::uint8_t>(ackseq);
    request.Data[2] = static_cast<std::uint8_t>(blksize);
    node_.rx(request);
    block_.clear();
    for (const std::string& text : node_.frames()) block_.push_back(frame(text));
  }
  void end() {
    REQUIRE(block_.size() == 1);
    const CO_IF_FRM& answer = block_[0];
    REQUIRE((answer.Data[0] & 0xE3U) == 0xC1);
    data.resize(data.size() - (answer.Data[0] >> 2U & 7U));
    is_complete = crc_16(data) == CO_GET_WORD(&answer, 1);
    node_.rx("601#A100000000000000");
  }

  RecorderNode& node_;
  std::mt19937 random_;
  std::vector<CO_IF_FRM> block_;
};

TEST_CASE("plot: lost segments are generated again [R4]") {
  for (const unsigned format : {CO_RECORDER_CSV, CO_RECORDER_BINARY}) {
    const Recorded recorded = Recorded().format(format).memory(600).size(600).name("speed");
    RecorderNode node(recorded);
    record(node, 1, 600);
    const std::string expected = node.plot();
    for (unsigned seed = 0; seed < 40; ++seed) {
      CAPTURE(format);
      CAPTURE(seed);
      node.recorder.Held = 600;  // the points are still in the memory
      LossyClient client(node, seed);
      while (client.step()) {
      }
      CHECK(client.is_complete);
      CHECK(text(client.data) == expected);
    }
  }
}

TEST_CASE("plot: lost segments whose points are overwritten abort the read [R4]") {
  for (const std::uint32_t overwritten : {0U, 118U, 119U}) {
    CAPTURE(overwritten);
    RecorderNode node(Recorded().size(600).memory(600));
    record(node, 1, 600);
    node.frames_per_call(127);
    node.ask("601#A401240564000000", "581#C401240500000000");
    node.rx("601#A300000000000000");
    CHECK(node.frames().size() == 100);
    node.rx("601#A264640000000000");  // the second block begins in the first piece, which is no longer in the buffer
    CHECK(node.frames().size() == 100);
    record(node, 601, 600 + overwritten);
    node.rx("601#A205640000000000");  // all bytes but the last one of point 119
    if (overwritten == 119) {
      node.tx("581#8001240522000008");
      CHECK(node.held() == 600);
    } else {
      CHECK(node.frames().size() == 100);
      node.rx("601#8001240500000008");
    }
  }
}

TEST_CASE("plot: a point that is overwritten between two repetitions aborts the read [R4]") {
  RecorderNode node(Recorded().size(600).memory(600));
  record(node, 1, 600);
  node.frames_per_call(127);
  node.ask("601#A401240564000000", "581#C401240500000000");
  node.rx("601#A300000000000000");
  CHECK(node.frames().size() == 100);
  node.rx("601#A264640000000000");
  CHECK(node.frames().size() == 100);
  node.rx("601#A200010000000000");  // goes back to byte 700, and sends one segment
  CHECK(node.frames().size() == 1);
  record(node, 601, 900);
  node.rx("601#A2017F0000000000");  // behind the piece are points that were sent, but are overwritten
  CHECK(node.frames().back() == "581#8001240522000008");
}

// Returns the number of the point behind the last complete one of a plot.
std::uint32_t point_after(const std::string& plot) {
  const std::size_t end = plot.rfind('\n');
  const std::size_t begin = end == std::string::npos || end == 0 ? std::string::npos : plot.rfind('\n', end - 1);
  return end == std::string::npos ? 1 : 1 + static_cast<std::uint32_t>(std::stoul(plot.substr(begin + 1)));
}

TEST_CASE("plot: only points that are overwritten are left out or abort a lossy upload [R4]") {
  unsigned completed = 0;
  unsigned aborted = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    RecorderNode node(Recorded().memory(300).size(300));
    record(node, 1, 300);
    LossyClient client(node, seed);
    std::mt19937 random(seed);
    std::uint32_t last = 300;
    while (client.step()) {
      const std::uint32_t more = static_cast<std::uint32_t>(random()) % (1 + seed % 32);
      record(node, last + 1, last + more);
      last += more;
    }
    const std::string plot = text(client.data);
    if (client.is_complete) {
      std::istringstream all(plot);
      std::uint32_t expected = 1;
      for (std::string line; std::getline(all, line);) {
        const auto number = static_cast<std::uint32_t>(std::stoul(line));
        CHECK(line + '\n' == lines(number, number));
        CHECK((number == expected || (number > expected && number <= last - 300 + 1)));
        expected = number + 1;
      }
      ++completed;
    } else {
      CHECK(point_after(plot) <= last - 300);
      ++aborted;
    }
  }
  CHECK(completed != 0);
  CHECK(aborted != 0);
}
#endif

}  // namespace

#endif
