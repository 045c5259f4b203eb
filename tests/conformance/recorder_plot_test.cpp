// SPDX-License-Identifier: Apache-2.0
// Recorder: the plot, generated while it is read.
#include <random>

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

TEST_CASE("plot: a picture has the curve as steps with its limits and its name [R4]") {
  RecorderNode node(Recorded().format(CO_RECORDER_SVG).name("a<b & \"c\x01\xE4").colour(0x00C0FF));
  node.record({-5, -5, 10, 3});
  CHECK(node.plot() ==
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 400\" font-family=\"sans-serif\" "
        "font-size=\"13\"><title>a&lt;b &amp; \"c__</title><text x=\"100\" y=\"20\">a&lt;b &amp; \"c__</text>"
        "<text x=\"94\" y=\"40\" text-anchor=\"end\">10</text><text x=\"94\" y=\"370\" text-anchor=\"end\">-5</text>"
        "<text x=\"100\" y=\"390\">1 ms</text><text x=\"790\" y=\"390\" text-anchor=\"end\">4 ms</text>"
        "<path fill=\"none\" stroke=\"#999\" d=\"M100,30V370H790\"/>"
        "<svg x=\"100\" y=\"30\" width=\"690\" height=\"340\" preserveAspectRatio=\"none\" overflow=\"visible\" "
        "viewBox=\"0 0 3 15\"><path fill=\"none\" stroke-width=\"2\" stroke-linecap=\"round\" "
        "vector-effect=\"non-scaling-stroke\" stroke=\"#00C0FF\" d=\"M0 15h0H2V0H3V7\"/></svg></svg>\n");
}

TEST_CASE("plot: a picture of one point or of none is complete [R4]") {
  RecorderNode node(Recorded().format(CO_RECORDER_SVG));
  const std::string none = node.plot();
  CHECK(none.find("viewBox=\"0 0 1 1\"") != std::string::npos);
  CHECK(none.find("d=\"\"/></svg></svg>\n") != std::string::npos);
  CHECK(none.find("<title></title>") != std::string::npos);
  node.record({7});
  const std::string one = node.plot();
  CHECK(one.find("d=\"M0 0h0\"/></svg></svg>\n") != std::string::npos);
  CHECK(one.find("\">7</text><text x=\"94\" y=\"370\" text-anchor=\"end\">7</text>") != std::string::npos);
}

TEST_CASE("plot: the greatest ranges fit into a picture [R4]") {
  RecorderNode node(Recorded().format(CO_RECORDER_SVG));
  node.record({INT32_MIN, INT32_MAX});
  const std::string all = node.plot();
  CHECK(all.find("viewBox=\"0 0 1 4294967295\"") != std::string::npos);
  CHECK(all.find("d=\"M0 4294967295h0H1V0\"") != std::string::npos);
  RecorderNode other(Recorded().format(CO_RECORDER_SVG | CO_RECORDER_UNSIGNED));
  other.record({0xFFFFFFFF, 0});
  CHECK(other.plot().find("\">4294967295</text><text x=\"94\" y=\"370\" text-anchor=\"end\">0</text>") !=
        std::string::npos);
}

TEST_CASE("plot: a name without end does not make the picture endless [R4]") {
  RecorderNode node(Recorded().format(CO_RECORDER_SVG));
  Bytes name(70000, 'x');
  node.recorder.Name = {0, 70000, 70000, name.data()};
  CHECK(node.plot().find("<title>" + std::string(80, 'x') + "</title>") != std::string::npos);
  node.recorder.Name.Start = nullptr;
  CHECK(node.plot().find("<title></title>") != std::string::npos);
}

// Points of an upload ------------------------------------------------------------------------------------------------

// Reads a picture in segments; the name is replaced after some of them. Returns the bytes of the picture.
std::size_t read_while_renamed(RecorderNode& node, unsigned after, std::uint32_t length, std::uint8_t character) {
  constexpr unsigned most_segments = 500;
  node.ask("601#4001240500000000", "581#4001240500000000");
  std::size_t bytes = 0;
  bool is_last = false;
  for (unsigned n = 0; n < most_segments && !is_last; ++n) {
    if (n == after) {
      node.recorder.Name.Size = length;
      std::fill(node.name.begin(), node.name.end(), character);
    }
    node.rx(n % 2 == 0 ? "601#6000000000000000" : "601#7000000000000000");
    const auto sent = node.frames();
    REQUIRE(sent.size() == 1);
    const CO_IF_FRM segment = frame(sent[0]);
    REQUIRE(segment.Data[0] < 0x20);  // not an abort
    bytes += 7U - ((segment.Data[0] >> 1) & 7U);
    is_last = (segment.Data[0] & 1) != 0;
  }
  CHECK(is_last);
  return bytes;
}

TEST_CASE("plot: a name that changes during the upload of a picture does not make the picture endless [R4]") {
  for (unsigned after = 10; after < 40; ++after) {
    CAPTURE(after);
    for (const std::uint32_t length : {0U, 1U, 20U}) {
      for (const char character : {'&', 'x'}) {
        RecorderNode node(Recorded().format(CO_RECORDER_SVG).name("&&&&&&&&"));
        record(node, 1, 5);
        CHECK(read_while_renamed(node, after, length, static_cast<std::uint8_t>(character)) < 1200);
      }
    }
  }
}

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

TEST_CASE("plot: a picture has a gap where points were left out [R4]") {
  RecorderNode node(Recorded().size(4).format(CO_RECORDER_SVG));
  record(node, 1, 4);
  node.ask("601#4001240500000000", "581#4001240500000000");
  record(node, 5, 6);
  std::string all;
  for (unsigned n = 0; n < 200 && all.find("</svg></svg>") == std::string::npos; ++n) {
    node.rx(n % 2 == 0 ? "601#6000000000000000" : "601#7000000000000000");
    const CO_IF_FRM answer = node.can.sent.back().frm;
    all.append(reinterpret_cast<const char*>(answer.Data) + 1, 7);
    node.frames();
  }
  CHECK(all.find("d=\"M2 1h0H3V0\"") != std::string::npos);
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
    CHECK(server[0].State == 0);
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
  for (const unsigned format : {CO_RECORDER_CSV, CO_RECORDER_BINARY, CO_RECORDER_SVG}) {
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
  for (const unsigned format : {CO_RECORDER_CSV, CO_RECORDER_BINARY, CO_RECORDER_SVG}) {
    const Recorded recorded = Recorded().format(format).memory(600).size(600).name("speed");
    RecorderNode node(recorded);
    record(node, 1, 600);
    const std::string expected = node.plot();
    for (unsigned seed = 0; seed < 400; seed += stride(2)) {
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
  for (const bool is_overwritten : {false, true}) {
    RecorderNode node(Recorded().size(600).memory(600));
    record(node, 1, 600);
    node.frames_per_call(127);
    node.ask("601#A401240564000000", "581#C401240500000000");
    node.rx("601#A300000000000000");
    CHECK(node.frames().size() == 100);
    node.rx("601#A264640000000000");  // the second block begins in the first piece, which is no longer in the buffer
    CHECK(node.frames().size() == 100);
    if (is_overwritten) {
      record(node, 601, 601);
    }
    node.rx("601#A205640000000000");
    if (is_overwritten) {
      node.tx("581#8001240522000008");
      CHECK(node.held() == 600);
    } else {
      CHECK(node.frames().size() == 100);
      node.rx("601#8001240500000008");
    }
  }
}
#endif

}  // namespace

#endif
