// SPDX-License-Identifier: Apache-2.0
// Recorder: points, trigger and configuration.
#include "support/recorder_fixture.hpp"

#if USE_RECORDER

namespace {

using namespace test;

constexpr std::uint32_t no_object = 0x06020000;
constexpr std::uint32_t not_recordable = 0x06040041;
constexpr std::uint32_t wrong_value = 0x06090030;
constexpr std::uint32_t wrong_state = 0x08000022;
constexpr std::uint32_t too_long = 0x06070012;
constexpr std::uint32_t too_short = 0x06070013;

TEST_CASE("recorder: a client configures it and reads the points in typed frames [R1] [R4]") {
  RecorderNode node(Recorded().size(0).map(0).period(0));
  node.ask("601#230123052000002E", "581#6001230500000000");
  node.ask("601#2301230104000000", "581#6001230100000000");
  node.ask("601#2B01230A01000000", "581#6001230A00000000");
  node.record({-5, -5, 7});
  node.ask("601#4001240100000000", "581#4301240102000000");
  node.ask("601#4001240200000000", "581#4301240207000000");
  node.ask("601#4001240300000000", "581#43012403FBFFFFFF");
  node.ask("601#4001240400000000", "581#4301240407000000");
  node.ask("601#4001240600000000", "581#4301240600000000");
  node.ask("601#4001240500000000", "581#4001240500000000");
  node.ask("601#6000000000000000", "581#00313B2D350A333B");  // "1;-5\n3;"
  node.ask("601#7000000000000000", "581#1B370A0000000000");  // "7\n"
  node.ask("601#4001240100000000", "581#4301240100000000");
}

TEST_CASE("recorder: a point is recorded at each change only [R1]") {
  RecorderNode node;
  node.record({1, 1, 1, 2, 2, 1, 1});
  CHECK(node.plot() == "1;1\n4;2\n6;1\n");
}

TEST_CASE("recorder: changes between two samples are not seen [R1]") {
  RecorderNode node(Recorded().period(10));
  node.record({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  CHECK(node.plot() == "10;10\n");
}

TEST_CASE("recorder: numbers of every length are recorded with their sign [R1]") {
  struct {
    std::uint32_t map;
    const char* signed_plot;
    const char* unsigned_plot;
  } const cases[] = {
      {CO_LINK(0x2E01, 0, 8), "1;-1\n2;-128\n3;127\n", "1;255\n2;128\n3;127\n"},
      {CO_LINK(0x2E02, 0, 16), "1;-1\n2;128\n3;127\n", "1;65535\n2;128\n3;127\n"},
      {CO_LINK(0x2E03, 0, 24), "1;-1\n2;128\n3;127\n", "1;16777215\n2;128\n3;127\n"},
      {CO_LINK(0x2E00, 0, 32), "1;-1\n2;128\n3;127\n", "1;4294967295\n2;128\n3;127\n"},
  };
  for (const auto& one : cases) {
    CAPTURE(one.map);
    RecorderNode node(Recorded().map(one.map));
    node.record({-1, 128, 127});
    CHECK(node.plot() == one.signed_plot);
    RecorderNode other(Recorded().map(one.map).format(CO_RECORDER_UNSIGNED));
    other.record({-1, 128, 127});
    CHECK(other.plot() == one.unsigned_plot);
  }
}

TEST_CASE("recorder: least and greatest value follow the sign [R1]") {
  RecorderNode node(Recorded().map(CO_LINK(0x2E01, 0, 8)));
  node.record({-1, -128, 127});
  CHECK(node.number(0x2401, 3) == 0xFFFFFF80);
  CHECK(node.number(0x2401, 4) == 127);
  RecorderNode other(Recorded().map(CO_LINK(0x2E00, 0, 32)).format(CO_RECORDER_UNSIGNED));
  other.record({5, 0xFFFFFFFF, 6});
  CHECK(other.number(0x2401, 3) == 5);
  CHECK(other.number(0x2401, 4) == 0xFFFFFFFF);
}

TEST_CASE("recorder: a BOOLEAN and the recorder's own objects can be recorded [R1]") {
  RecorderNode node(Recorded().map(CO_LINK(0x2400, 0, 8)));
  node.after(3ms);
  CHECK(node.plot() == "1;1\n");
  RecorderNode itself(Recorded().map(CO_LINK(0x2401, 1, 32)).size(3));
  itself.after(10ms);
  CHECK(itself.plot() == "2;1\n3;2\n4;3\n");
}

TEST_CASE("recorder: the last points are held [R2]") {
  for (std::uint32_t size = 0; size <= 4; ++size) {
    CAPTURE(size);
    RecorderNode node(Recorded().size(size).memory(4));
    std::string expected;
    for (std::uint32_t value = 1; value <= 10; ++value) {
      node.record({value});
      CHECK(node.held() == std::min(value, size));
    }
    for (std::uint32_t value = 11 - size; value <= 10; ++value) {
      expected += std::to_string(value) + ";" + std::to_string(value) + "\n";
    }
    CHECK(node.number(0x2401, 2) == 10);
    CHECK(node.plot() == expected);
  }
}

TEST_CASE("recorder: without memory nothing is recorded but the values [R2]") {
  RecorderNode node(Recorded().size(0).memory(0));
  node.record({3, 1, 2});
  CHECK(node.held() == 0);
  CHECK(node.number(0x2401, 2) == 2);
  CHECK(node.number(0x2401, 3) == 1);
  CHECK(node.number(0x2401, 4) == 3);
  CHECK(node.plot().empty());
  CHECK(node.configure(1, 1) == wrong_value);
}

TEST_CASE("recorder: null memory counts as none [R2] [R5]") {
  RecorderNode node(Recorded().size(0));
  node.recorder.Points = nullptr;
  CHECK(node.configure(1, 1) == wrong_value);
  node.record({1, 2});
  CHECK(node.plot().empty());
}

TEST_CASE("recorder: writing 0 to the number of points empties it and other values are refused [R2]") {
  RecorderNode node;
  node.record({1, 2});
  node.ask("601#2301240101000000", "581#8001240130000906");
  CHECK(node.held() == 2);
  node.ask("601#2301240100000000", "581#6001240100000000");
  CHECK(node.held() == 0);
  node.record({2, 3});
  CHECK(node.number(0x2401, 3) == 2);
  CHECK(node.plot() == "3;2\n4;3\n");
}

TEST_CASE("recorder: the other data cannot be written [R5]") {
  RecorderNode node;
  node.record({1, 2});
  for (const std::uint8_t sub : {std::uint8_t{2}, std::uint8_t{3}, std::uint8_t{4}, std::uint8_t{6}}) {
    CHECK(node.download(0x2401, sub, {0, 0, 0, 0}) == 0x06010000);
  }
  node.ask("601#2301240500000000", "581#8001240502000106");
  CHECK(node.held() == 2);
}

// Trigger -------------------------------------------------------------------------------------------------------------

TEST_CASE("recorder: each edge of the trigger starts the recording [R3]") {
  struct {
    unsigned edge;
    const char* plot;
  } const cases[] = {
      {CO_RECORDER_RISING, "4;10\n5;9\n6;12\n"},
      {CO_RECORDER_FALLING, "3;9\n4;10\n5;9\n"},
      {CO_RECORDER_BOTH, "3;9\n4;10\n5;9\n"},
  };
  for (const auto& one : cases) {
    CAPTURE(one.edge);
    RecorderNode node(Recorded().size(3).trigger(one.edge, 10));
    node.record({15, 10, 9, 10, 9, 12, 3, 20, 4});
    CHECK(node.number(0x2401, 6) == static_cast<std::uint32_t>(one.plot[0] - '0'));
    CHECK(node.plot() == one.plot);
  }
}

TEST_CASE("recorder: the first value is no edge [R3]") {
  for (const unsigned edge : {CO_RECORDER_RISING, CO_RECORDER_FALLING, CO_RECORDER_BOTH}) {
    RecorderNode node(Recorded().size(3).trigger(edge, 0));
    node.record({5, 6, 7, 5});
    CHECK(node.held() == 0);
    CHECK(node.number(0x2401, 6) == 0);
  }
}

TEST_CASE("recorder: points before the trigger are kept [R3]") {
  for (std::uint32_t before = 0; before < 4; ++before) {
    CAPTURE(before);
    RecorderNode node(Recorded().size(4).trigger(CO_RECORDER_RISING, 100, before));
    node.record({1, 2, 3, 4, 5});
    CHECK(node.held() == before);
    node.record({100, 7, 8, 9, 10, 11});
    std::string expected;
    const char* const lines[] = {"3;3\n", "4;4\n", "5;5\n", "6;100\n", "7;7\n", "8;8\n", "9;9\n"};
    for (std::uint32_t n = 3 - before; n < 7 - before; ++n) expected += lines[n];
    CHECK(node.plot() == expected);
  }
}

TEST_CASE("recorder: a trigger soon after the start keeps the points that there are [R3]") {
  RecorderNode node(Recorded().size(8).trigger(CO_RECORDER_RISING, 10, 5));
  node.record({1, 10, 2, 3, 4, 5});
  CHECK(node.plot() == "1;1\n2;10\n3;2\n4;3\n");
}

TEST_CASE("recorder: a full recorder waits for the trigger again when it was read completely [R3] [R4]") {
  RecorderNode node(Recorded().size(2).trigger(CO_RECORDER_RISING, 10));
  node.record({1, 10, 2, 11, 3, 12});
  CHECK(node.plot() == "2;10\n3;2\n");
  CHECK(node.held() == 0);
  CHECK(node.number(0x2401, 6) == 2);
  node.record({4, 13, 5, 14});
  CHECK(node.number(0x2401, 6) == 8);
  CHECK(node.plot() == "8;13\n9;5\n");
}

TEST_CASE("recorder: points that are read while the trigger is done are not missing at the end [R3] [R4]") {
  RecorderNode node(Recorded().size(4).trigger(CO_RECORDER_RISING, 10));
  node.record({1, 10, 2});
  CHECK(node.plot() == "2;10\n3;2\n");
  node.record({3, 4, 5, 6});
  CHECK(node.plot() == "4;3\n5;4\n");
}

TEST_CASE("recorder: the threshold of an unsigned object is unsigned [R3]") {
  RecorderNode node(Recorded().size(2).format(CO_RECORDER_UNSIGNED).trigger(CO_RECORDER_RISING, INT32_MIN));
  node.record({1, 0x7FFFFFFF, 0x80000000});
  CHECK(node.number(0x2401, 6) == 3);
  RecorderNode with_sign(Recorded().size(2).trigger(CO_RECORDER_RISING, -5));
  with_sign.record({5, -6, -5});
  CHECK(with_sign.number(0x2401, 6) == 3);
}

TEST_CASE("recorder: a trigger without points is harmless [R2] [R3]") {
  for (std::uint32_t size = 0; size < 2; ++size) {
    RecorderNode node(Recorded().size(size).trigger(CO_RECORDER_BOTH, 10));
    node.record({1, 10, 2, 11, 3, 12});
    CHECK(node.held() == size);
    CHECK(node.plot() == (size == 0 ? "" : "2;10\n"));
  }
}

// Time ----------------------------------------------------------------------------------------------------------------

TEST_CASE("recorder: the time is exact at every frequency and where the clock wraps [R1]") {
  for (const std::uint32_t rate : clock_rates) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      RecorderNode node(Recorded().period(1000).in(Setup().rate(rate).clock(start)));
      std::string expected;
      for (unsigned second = 1; second <= 5; ++second) {
        node.set(second);
        node.after(1000ms);
        expected += std::to_string(1000 * second) + ";" + std::to_string(second) + "\n";
      }
      CHECK(node.plot() == expected);
    }
  }
}

TEST_CASE("recorder: the time is counted while no sample is taken and the clock wraps [R1]") {
  RecorderNode node(Recorded().period(0).in(Setup().rate(1000000).clock(0xFFFFFF00)));
  node.after(std::chrono::hours{3});
  node.set(1);
  CHECK(node.sample() == CO_ERR_NONE);
  CHECK(node.plot() == "10800000;1\n");
}

TEST_CASE("recorder: a period that the timer cannot count is refused [R5]") {
  RecorderNode node(Recorded().in(Setup().rate(1000000000)));
  CHECK(node.configure(10, 1074, 2) == wrong_value);
  CHECK(node.configure(10, 1073, 2) == 0);
}

// Configuration -------------------------------------------------------------------------------------------------------

TEST_CASE("recorder: an object that does not exist or is no readable number is refused [R5]") {
  RecorderNode node;
  node.record({1});
  CHECK(node.configure(5, CO_LINK(0x2E0F, 0, 8)) == no_object);
  CHECK(node.configure(5, CO_LINK(0x2E00, 1, 32)) == no_object);
  CHECK(node.configure(5, CO_LINK(0, 0, 8)) == no_object);
  for (const std::uint32_t bits : {0U, 1U, 7U, 8U, 9U, 16U, 24U, 31U, 33U, 40U, 64U, 255U}) {
    CHECK(node.configure(5, CO_LINK(0x2E00, 0, bits)) == not_recordable);
  }
  CHECK(node.configure(5, CO_LINK(0x2030, 0, 32)) == not_recordable);  // write-only
  CHECK(node.configure(5, CO_LINK(0x2032, 0, 32)) == not_recordable);  // without any right
  CHECK(node.configure(5, CO_LINK(0x2110, 0, 32)) == not_recordable);  // a string
  CHECK(node.configure(5, CO_LINK(0x2008, 0, 32)) == not_recordable);  // 64 bits
  CHECK(node.configure(5, CO_LINK(0x2401, 5, 32)) == not_recordable);  // the plot
  CHECK(node.number(0x2301, 5) == CO_LINK(0x2E00, 0, 32));
  CHECK(node.plot() == "1;1\n");
}

TEST_CASE("recorder: values out of range are refused [R5]") {
  RecorderNode node(Recorded().size(8).trigger(CO_RECORDER_FREE, 0, 7));
  CHECK(node.configure(1, 17) == wrong_value);
  CHECK(node.configure(1, 0xFFFFFFFF) == wrong_value);
  CHECK(node.configure(1, 7) == wrong_value);  // with 7 points before the trigger
  CHECK(node.configure(4, 0x01000000) == wrong_value);
  CHECK(node.configure(9, 8) == wrong_value);
  CHECK(node.configure(9, 0xFFFFFFFF) == wrong_value);
  CHECK(node.number(0x2301, 1) == 8);
  CHECK(node.number(0x2301, 9) == 7);
  for (std::uint32_t value = 0; value < 256; ++value) {
    const bool is_format = (value & 0xEF) <= CO_RECORDER_BINARY;  // CO_RECORDER_SVG is gone
    CHECK(node.configure(6, value, 1) == (is_format ? 0 : wrong_value));
    CHECK(node.configure(7, value, 1) == (value <= 3 ? 0 : wrong_value));
    CHECK(node.configure(2, value, 1) == 0);
  }
}

TEST_CASE("recorder: other lengths are refused [R5]") {
  RecorderNode node;
  const std::size_t lengths[] = {0, 4, 1, 0, 4, 4, 1, 1, 4, 4, 2};
  for (std::uint8_t sub = 1; sub <= 10; ++sub) {
    for (std::size_t bytes = 1; sub != 3 && bytes <= 9; ++bytes) {
      CAPTURE(sub);
      const std::uint32_t expected = bytes < lengths[sub] ? too_short : too_long;
      CHECK(node.configure(sub, 0, bytes) == (bytes == lengths[sub] ? 0 : expected));
    }
  }
}

TEST_CASE("recorder: its configuration is read as it was written [R5]") {
  RecorderNode node;
  CHECK(node.configure(1, 9) == 0);
  CHECK(node.configure(2, 3, 1) == 0);
  CHECK(node.configure(4, 0x123456) == 0);
  CHECK(node.configure(5, CO_LINK(0x2E02, 0, 16)) == 0);
  CHECK(node.configure(6, 0x11, 1) == 0);
  CHECK(node.configure(7, 3, 1) == 0);
  CHECK(node.configure(8, 0x89ABCDEF) == 0);
  CHECK(node.configure(9, 8) == 0);
  CHECK(node.configure(10, 0xFFFF, 2) == 0);
  node.ask("601#4001230100000000", "581#4301230109000000");
  node.ask("601#4001230200000000", "581#4F01230203000000");
  node.ask("601#4001230400000000", "581#4301230456341200");
  node.ask("601#4001230500000000", "581#430123051000022E");
  node.ask("601#4001230600000000", "581#4F01230611000000");
  node.ask("601#4001230700000000", "581#4F01230703000000");
  node.ask("601#4001230800000000", "581#43012308EFCDAB89");
  node.ask("601#4001230900000000", "581#4301230908000000");
  node.ask("601#4001230A00000000", "581#4B01230AFFFF0000");
}

TEST_CASE("recorder: a change that concerns the points starts it anew and others do not [R5]") {
  struct {
    std::uint8_t sub;
    std::uint32_t value;
    std::size_t bytes;
    bool anew;
  } const cases[] = {{1, 15, 4, true},         {1, 16, 4, false},         {2, 1, 1, false}, {4, 1, 4, false},
                     {5, 0x2E010008, 4, true}, {5, 0x2E000020, 4, false}, {6, 1, 1, false}, {6, 0x10, 1, true},
                     {7, 1, 1, true},          {7, 0, 1, false},          {8, 1, 4, true},  {8, 0, 4, false},
                     {9, 1, 4, true},          {9, 0, 4, false},          {10, 7, 2, false}};
  for (const auto& one : cases) {
    CAPTURE(one.sub);
    CAPTURE(one.value);
    RecorderNode node;
    node.record({1, 2});
    CHECK(node.configure(one.sub, one.value, one.bytes) == 0);
    CHECK(node.held() == (one.anew ? 0 : 2));
  }
}

TEST_CASE("recorder: a new period takes effect at once [R5]") {
  RecorderNode node(Recorded().period(1000));
  node.set(1);
  CHECK(node.configure(10, 2, 2) == 0);
  node.record({1, 2, 3, 4});
  CHECK(node.plot() == "2;2\n4;4\n");
  CHECK(node.configure(10, 0, 2) == 0);
  node.record({5, 6});
  CHECK(node.held() == 0);
}

TEST_CASE(
    "recorder: a wrong configuration in the table is reported and the recorder is idle until it is corrected [R5]") {
  for (const std::uint32_t map : {CO_LINK(0x2E0F, 0, 8), CO_LINK(0x2E00, 0, 8)}) {
    RecorderNode node(Recorded().map(map));
    CHECK(node.error() == CO_ERR_OBJ_INIT);
    CHECK(CONodeGetErrKey(&node.node) == CO_DEV(0x2301, 1));
    node.record({1, 2});
    CHECK(node.sample() == CO_ERR_OBJ_STATE);
    CHECK(node.plot().empty());
    CHECK(node.download(0x2401, 1, {0, 0, 0, 0}) == 0);
    node.trace();
    CHECK(node.configure(5, CO_LINK(0x2E00, 0, 32)) == 0);
    node.record({3});
    CHECK(node.plot() == "3;3\n");
  }
  RecorderNode large(Recorded().size(17));
  CHECK(large.error() == CO_ERR_OBJ_INIT);
  large.record({1, 2});
  CHECK(large.held() == 0);
}

TEST_CASE("recorder: NMT resets start it anew with the time going on [R6]") {
  for (const char* reset : {"000#8201", "000#8101"}) {
    RecorderNode node;
    node.record({1, 2});
    node.ask(reset, "701#00");
    CHECK(node.held() == 0);
    node.record({3});
    CHECK(node.plot() == "3;3\n");
  }
}

TEST_CASE("recorder: it records in every NMT state [R6]") {
  RecorderNode node;
  node.record({1});
  node.rx("000#0101");
  node.record({2});
  node.rx("000#0201");
  node.record({3});
  node.rx("000#8001");
  CHECK(node.plot() == "1;1\n2;2\n3;3\n");
}

TEST_CASE("recorder: a stopped node does not record and a new initialisation does [R6]") {
  RecorderNode node;
  node.record({1});
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.armed_timers() == 0);
  CHECK(node.sample() == CO_ERR_OBJ_STATE);
  node.init_again();
  node.call([&] { CONodeStart(&node.node); });
  node.trace();
  CHECK(node.held() == 0);
  node.record({4});
  CHECK(node.plot() == "1;4\n");
}

TEST_CASE("2400h: after CODictInit() the object of the present table counts, or none [R6]") {
  RecorderNode node;
  std::vector<CO_OBJ> table(node.node.Dict.Root, node.node.Dict.Root + node.node.Dict.Num);
  table.push_back(CO_OBJ_DICT_ENDMARK);
  const auto at =
      std::find_if(table.begin(), table.end(), [](const CO_OBJ& obj) { return obj.Type == CO_TREC_ENABLE; });
  REQUIRE(at != table.end());
  const auto use = [&](std::vector<CO_OBJ>& next) {
    node.call([&] { CODictInit(&node.node.Dict, &node.node, next.data(), static_cast<std::uint16_t>(next.size())); });
    node.trace();
  };
  std::uint8_t other = 1;
  at->Data = &other;
  use(table);
  node.enable = 0;  // the variable of the old table
  node.record({1});
  CHECK(CORecorderCount(&node.recorder) == 1);
  other = 0;
  node.record({2});
  CHECK(CORecorderCount(&node.recorder) == 1);
  std::vector<CO_OBJ> without = table;
  without.erase(without.begin() + (at - table.begin()));
  use(without);
  node.record({3});
  CHECK(CORecorderCount(&node.recorder) == 2);
}

TEST_CASE("2400h: 0 stops all recorders and 1 continues them [R6]") {
  RecorderNode node;
  node.record({1});
  node.ask("601#2F00240000000000", "581#6000240000000000");
  node.record({2, 3});
  CHECK(node.sample() == CO_ERR_OBJ_STATE);
  CHECK(node.held() == 1);
  node.ask("601#2F00240001000000", "581#6000240000000000");
  node.record({3, 4});
  CHECK(node.plot() == "1;1\n4;3\n5;4\n");
  for (unsigned value = 2; value < 256; ++value) {
    CHECK(node.download(0x2400, 0, {static_cast<std::uint8_t>(value)}) == wrong_value);
  }
  CHECK(node.download(0x2400, 0, {0, 0}) == too_long);
  CHECK(node.number(0x2400, 0) == 1);
}

TEST_CASE("recorder: an object that CODictInit() removes is not recorded any more [R6]") {
  RecorderNode node;
  node.record({1});
  CO_OBJ* const value = node.find(0x2E00, 0);
  const CO_OBJ before = *value;
  value->Key = CO_KEY(0x2E00, 1, CO_OBJ_____R_);
  node.record({2});
  CHECK(node.sample() == CO_ERR_OBJ_NOT_FOUND);
  value->Key = CO_KEY(0x2E00, 0, CO_OBJ______W);
  node.record({3});
  CHECK(node.sample() == CO_ERR_OBJ_MAP_TYPE);
  *value = before;
  node.record({4});
  CHECK(node.plot() == "1;1\n4;4\n");
}

// API -----------------------------------------------------------------------------------------------------------------

TEST_CASE("recorder: the application starts and samples a recorder without entries [R7]") {
  CO_RECORDER_POINT points[2] = {};
  CO_RECORDER recorder{};
  std::uint32_t value = 0;
  recorder.Points = points;
  recorder.Num = 2;
  recorder.Config.Size = 2;
  recorder.Config.Map = CO_LINK(0x2E00, 0, 32);
  Fixture node(Setup().only_small().with({CO_KEY(0x2E00, 0, CO_OBJ_____R_), CO_TUNSIGNED32, &value}));
  node.call([&] {
    CHECK(CORecorderSample(&recorder) == CO_ERR_BAD_ARG);
    CHECK(CORecorderClear(&recorder) == CO_ERR_BAD_ARG);
    CHECK(CORecorderConfigure(&recorder, &recorder.Config) == CO_ERR_BAD_ARG);
    CHECK(CORecorderStart(&node.node, &recorder) == CO_ERR_NONE);
  });
  for (value = 10; value < 13; ++value) {
    node.after(5ms);
    node.call([&] { CHECK(CORecorderSample(&recorder) == CO_ERR_NONE); });
  }
  CO_RECORDER_POINT point{};
  CHECK(CORecorderCount(&recorder) == 2);
  CHECK(CORecorderGet(&recorder, 0, &point) == CO_ERR_NONE);
  CHECK(point.Time == 10);
  CHECK(point.Value == 11);
  CHECK(CORecorderGet(&recorder, 1, &point) == CO_ERR_NONE);
  CHECK(point.Value == 12);
  CHECK(CORecorderGet(&recorder, 2, &point) == CO_ERR_OBJ_NO_DATA);
  CO_RECORDER_CONFIG config = recorder.Config;
  config.Map = CO_LINK(0x2E09, 0, 32);
  node.call([&] { CHECK(CORecorderConfigure(&recorder, &config) == CO_ERR_OBJ_NOT_FOUND); });
  CHECK(CORecorderCount(&recorder) == 2);
  config.Map = 0;
  node.call([&] {
    CHECK(CORecorderConfigure(&recorder, &config) == CO_ERR_NONE);
    CHECK(CORecorderSample(&recorder) == CO_ERR_OBJ_STATE);
    CHECK(CORecorderClear(&recorder) == CO_ERR_NONE);
  });
  CHECK(CORecorderCount(&recorder) == 0);
  node.call([&] { CONodeStop(&node.node); });
}

TEST_CASE("recorder: null arguments are refused [R7]") {
  CO_RECORDER recorder{};
  CO_RECORDER_POINT point{};
  CO_NODE never{};
  CHECK(CORecorderStart(nullptr, &recorder) == CO_ERR_BAD_ARG);
  CHECK(CORecorderStart(&never, nullptr) == CO_ERR_BAD_ARG);
  CHECK(CORecorderStart(&never, &recorder) == CO_ERR_BAD_ARG);
  CHECK(CORecorderConfigure(nullptr, &recorder.Config) == CO_ERR_BAD_ARG);
  CHECK(CORecorderConfigure(&recorder, nullptr) == CO_ERR_BAD_ARG);
  CHECK(CORecorderSample(nullptr) == CO_ERR_BAD_ARG);
  CHECK(CORecorderClear(nullptr) == CO_ERR_BAD_ARG);
  CHECK(CORecorderCount(nullptr) == 0);
  CHECK(CORecorderGet(nullptr, 0, &point) == CO_ERR_BAD_ARG);
  CHECK(CORecorderGet(&recorder, 0, nullptr) == CO_ERR_BAD_ARG);
}

TEST_CASE("recorder: several recorders of a node share the time [R1]") {
  RecorderNode node(Recorded().period(2));
  CO_RECORDER_POINT points[4] = {};
  CO_RECORDER other{};
  other.Points = points;
  other.Num = 4;
  other.Config = node.recorder.Config;
  other.Config.Size = 4;
  other.Config.Period = 3;
  node.record({1});
  node.call([&] { CHECK(CORecorderStart(&node.node, &other) == CO_ERR_NONE); });
  node.record({2, 3, 4, 5, 6});
  CHECK(node.plot() == "2;2\n4;4\n6;6\n");
  CHECK(CORecorderCount(&other) == 1);
  CHECK(points[0].Time == 4);
  node.call([&] { CONodeStop(&node.node); });
}

}  // namespace

#endif
