// SPDX-License-Identifier: Apache-2.0
/// \file recorder_fixture.hpp
/// A node with a recorder: configuration 2301h, enable 2400h, data 2401h, and the recorded variable 2E00h of 8, 16 or
/// 32 bits, which the test writes directly:
///
///     RecorderNode node(Recorded().size(4).period(1));
///     node.record({5, 7});                                 // one value each millisecond
///     CHECK(node.plot() == "1;5\n2;7\n");
#pragma once

#include "fixture.hpp"

#if USE_RECORDER

namespace test {

/// Configuration of the recorder before CONodeInit().
class Recorded {
 public:
  Recorded& size(std::uint32_t points) { return config_.Size = points, *this; }
  Recorded& map(std::uint32_t link) { return config_.Map = link, *this; }
  Recorded& period(std::uint16_t ms) { return config_.Period = ms, *this; }
  Recorded& format(unsigned format) { return config_.Format = static_cast<std::uint8_t>(format), *this; }
  Recorded& trigger(unsigned edge, std::int32_t threshold, std::uint32_t before = 0) {
    config_.Trigger = static_cast<std::uint8_t>(edge);
    config_.Threshold = threshold;
    config_.PreTrigger = before;
    return *this;
  }
  Recorded& memory(std::size_t points) { return memory_ = points, *this; }
  Recorded& name(const char* text) { return name_ = text, *this; }
  Recorded& colour(std::uint32_t colour) { return config_.Colour = colour, *this; }
  Recorded& in(Setup setup) { return setup_ = std::move(setup), *this; }

 private:
  friend struct RecorderObjects;
  friend class RecorderNode;
  CO_RECORDER_CONFIG config_{16, 0, CO_LINK(0x2E00, 0, 32), 0, 0, 1, 0, 0, 0};
  std::size_t memory_ = 16;
  std::string name_;
  Setup setup_;
};

struct RecorderObjects {
  explicit RecorderObjects(const Recorded& recorded)
      : points(recorded.memory_ + 1, guard), name(recorded.name_.begin(), recorded.name_.end()) {
    recorder.Points = points.data();
    recorder.Num = static_cast<std::uint32_t>(recorded.memory_);
    recorder.Config = recorded.config_;
    name.resize(32);
    recorder.Name = {0, static_cast<std::uint32_t>(recorded.name_.size()), 32, name.data()};
  }
  static constexpr CO_RECORDER_POINT guard{0xEEEEEEEE, 0x5EEEEEEE};
  CO_RECORDER recorder{};
  std::vector<CO_RECORDER_POINT> points;
  std::vector<std::uint8_t> name;
  std::uint8_t enable = 1;
  std::uint8_t value8 = 0;
  std::uint16_t value16 = 0;
  std::uint32_t value24 = 0;
  std::uint32_t value32 = 0;
};

class RecorderNode : public RecorderObjects, public Fixture {
 public:
  explicit RecorderNode(const Recorded& recorded = Recorded())
      : RecorderObjects(recorded), Fixture(complete(recorded.setup_, *this)) {}
  ~RecorderNode() { CHECK(points.back().Time == guard.Time); }
  RecorderNode(const RecorderNode&) = delete;
  RecorderNode& operator=(const RecorderNode&) = delete;

  /// For each value, sets all variables and advances the time by one millisecond.
  void record(std::initializer_list<std::int64_t> values, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    for (const std::int64_t value : values) {
      set(value);
      after(1ms, at);
    }
  }
  void set(std::int64_t value) {
    value8 = static_cast<std::uint8_t>(value);
    value16 = static_cast<std::uint16_t>(value);
    value24 = static_cast<std::uint32_t>(value);
    value32 = static_cast<std::uint32_t>(value);
  }

  /// Returns the plot that a client reads in segments.
  std::string plot(Where at = {__builtin_FILE(), __builtin_LINE()}) {
    const Bytes bytes = upload(0x2401, 5, at);
    trace();
    return {bytes.begin(), bytes.end()};
  }
  std::uint32_t number(std::uint16_t index, std::uint8_t sub, Where at = {__builtin_FILE(), __builtin_LINE()}) {
    const Bytes bytes = upload(index, sub, at);
    trace();
    std::uint32_t value = 0;
    for (std::size_t n = bytes.size(); n != 0; --n) value = value << 8 | bytes[n - 1];
    return value;
  }
  std::uint32_t held() { return number(0x2401, 1); }
  /// Writes a sub-index of the configuration. Returns the abort code; 0: success.
  std::uint32_t configure(std::uint8_t sub, std::uint32_t value, std::size_t bytes = 4,
                          Where at = {__builtin_FILE(), __builtin_LINE()}) {
    Bytes data;
    for (std::size_t n = 0; n < bytes; ++n, value >>= 8) data.push_back(static_cast<std::uint8_t>(value));
    const std::uint32_t abort = download(0x2301, sub, data, true, at);
    trace();
    return abort;
  }
  CO_ERR sample() {
    CO_ERR err = CO_ERR_NONE;
    call([&] { err = CORecorderSample(&recorder); });
    return err;
  }

 private:
  static Setup complete(Setup setup, RecorderObjects& objects) {
    setup.only_small();
    for (const unsigned sub : {1U, 2U, 4U, 5U, 6U, 7U, 8U, 9U, 10U}) {
      setup.with({CO_KEY(0x2301, sub, CO_OBJ_____RW), CO_TREC_CONFIG, &objects.recorder});
    }
    setup.with({CO_KEY(0x2301, 3, CO_OBJ_____RW), CO_TVISIBLE_STRING, &objects.recorder.Name})
        .with({CO_KEY(0x2400, 0, CO_OBJ_____RW), CO_TREC_ENABLE, &objects.enable})
        .with({CO_KEY(0x2401, 1, CO_OBJ_____RW), CO_TREC_DATA, &objects.recorder});
    for (const unsigned sub : {2U, 3U, 4U, 6U}) {
      setup.with({CO_KEY(0x2401, sub, CO_OBJ_____RW), CO_TREC_DATA, &objects.recorder});
    }
    setup.with({CO_KEY(0x2401, 5, CO_OBJ_____R_), CO_TREC_PLOT, &objects.recorder});
    return setup.with({CO_KEY(0x2E00, 0, CO_OBJ____PRW), CO_TSIGNED32, &objects.value32})
        .with({CO_KEY(0x2E01, 0, CO_OBJ____PRW), CO_TSIGNED8, &objects.value8})
        .with({CO_KEY(0x2E02, 0, CO_OBJ____PRW), CO_TSIGNED16, &objects.value16})
        .with({CO_KEY(0x2E03, 0, CO_OBJ____PRW), CO_TSIGNED24, &objects.value24});
  }
};

}  // namespace test

#endif
