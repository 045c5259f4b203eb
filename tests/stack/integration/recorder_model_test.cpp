// SPDX-License-Identifier: Apache-2.0
// Recorder: random configurations, values and clients; every point of a plot is one that was recorded.
#include <random>
#include <sstream>

#include "support/recorder_fixture.hpp"

#if USE_RECORDER

namespace {

using namespace test;

// A client that reads the plot in segments, with other events between them. Stores the value of each millisecond.
class Client {
 public:
  explicit Client(unsigned seed) : random_(seed), node_(Recorded().memory(20).size(20)) {}

  void step() {
    switch (draw(6)) {
      case 0: configure(); break;
      case 1: begin(); break;
      case 2:
      case 3: segment(); break;
      default: change(); break;
    }
    const CO_RECORDER& recorder = node_.recorder;
    CHECK(recorder.Held <= recorder.Limit);
    CHECK(recorder.Limit <= recorder.Num);
    CHECK((recorder.Limit == 0 || recorder.Write < recorder.Limit));
  }
  unsigned complete() const { return complete_; }

 private:
  std::uint32_t draw(std::uint32_t below) { return static_cast<std::uint32_t>(random_() % below); }

  void change() {
    for (std::uint32_t n = draw(12); n != 0; --n) {
      const auto value = static_cast<std::int32_t>(draw(7)) - 3;
      ++now_;
      values_.push_back(value);
      node_.record({value});
    }
  }
  void configure() {
    is_open_ = false;  // another request ends the upload
    const std::uint32_t size = draw(21);
    node_.configure(1, size);
    node_.configure(7, draw(4), 1);
    node_.configure(8, draw(7) - 3);
    node_.configure(9, draw(20));
  }
  void begin() {
    node_.rx("601#4001240500000000");
    const std::vector<std::string> answer = node_.frames();
    CHECK(answer == std::vector<std::string>{"581#4001240500000000"});
    is_open_ = true;
    toggle_ = false;
    text_.clear();
  }
  void segment() {
    if (!is_open_) {
      return;
    }
    node_.rx(toggle_ ? "601#7000000000000000" : "601#6000000000000000");
    REQUIRE(node_.can.sent.size() == 1);
    const CO_IF_FRM answer = node_.can.sent.front().frm;
    node_.frames();
    REQUIRE((answer.Data[0] & 0xE0) == 0);
    text_.append(reinterpret_cast<const char*>(answer.Data) + 1, 7U - (answer.Data[0] >> 1 & 7U));
    toggle_ = !toggle_;
    if ((answer.Data[0] & 1) != 0) {
      is_open_ = false;
      check();
    }
  }
  // Checks that each line has the value of its time, and that the times ascend.
  void check() {
    ++complete_;
    std::istringstream lines(text_);
    std::uint32_t time = 0;
    std::uint32_t before = 0;
    std::int32_t value = 0;
    char separator = 0;
    while (lines >> time >> separator >> value) {
      REQUIRE(time <= now_);
      CHECK(separator == ';');
      CHECK(time > before);
      CHECK(value == values_[time - 1]);
      before = time;
    }
    CHECK((text_.empty() || text_.back() == '\n'));
  }

  std::mt19937 random_;
  RecorderNode node_;
  std::vector<std::int32_t> values_;
  std::uint32_t now_ = 0;
  std::string text_;
  bool is_open_ = false;
  bool toggle_ = false;
  unsigned complete_ = 0;
};

TEST_CASE(
    "recorder: a plot has only recorded points with any configuration and any changes meanwhile [R2] [R3] [R4] [R5]") {
  unsigned complete = 0;
  for (unsigned seed = 0; seed < 40; seed += stride(4)) {
    CAPTURE(seed);
    Client client(seed);
    for (unsigned n = 0; n < 500; ++n) client.step();
    complete += client.complete();
  }
  CHECK(complete > 20);
}

}  // namespace

#endif
