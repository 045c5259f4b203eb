// SPDX-License-Identifier: Apache-2.0
#include "co_cfg.h"

#if USE_CSDO  // required by the demo's master
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "client/progress.hpp"

namespace {

using lexican::Amount;
using lexican::millisecond;
using lexican::Progress;
using lexican::second;

/// Records the progress texts of a transfer.
struct Watcher {
  explicit Watcher(Progress::Form form) : progress(form, [this](const std::string& text) { shown.push_back(text); }) {}
  void sees(const Amount& amount) { progress.update(amount); }

  std::vector<std::string> shown;
  Progress progress;
};

}  // namespace

TEST_CASE("demo progress: bytes, percent and rate are in one line") {
  CHECK(lexican::progress_text({5000, 10000, 2 * second}) ==
        "[###############...............]  50 %  5000 of 10000 bytes, 2.5 kB/s");
  CHECK(lexican::progress_text({10000, 10000, second}) ==
        "[##############################] 100 %  10000 of 10000 bytes, 10.0 kB/s");
  CHECK(lexican::progress_text({0, 10000, 0}) == "[..............................]   0 %  0 of 10000 bytes");
  CHECK(lexican::progress_text({4294967295, 4294967295, second}) ==
        "[##############################] 100 %  4294967295 of 4294967295 bytes, 4294967.3 kB/s");
}

TEST_CASE("demo progress: without a total no percent is shown") {
  CHECK(lexican::progress_text({5000, 0, 2 * second}) == "5000 bytes, 2.5 kB/s");
  CHECK(lexican::progress_text({0, 0, 0}) == "0 bytes");
}

TEST_CASE("demo progress: a line is printed for each quarter") {
  Watcher watcher(Progress::Form::lines);
  for (std::uint32_t done = 0; done <= 1000; ++done) {
    watcher.sees({done, 1000, done * millisecond});
    watcher.sees({done, 1000, done * millisecond});
  }
  REQUIRE(watcher.shown.size() == 4);
  CHECK(watcher.shown[0].find(" 250 of 1000 bytes") != std::string::npos);
  CHECK(watcher.shown[1].find(" 500 of 1000 bytes") != std::string::npos);
  CHECK(watcher.shown[2].find(" 750 of 1000 bytes") != std::string::npos);
  CHECK(watcher.shown[3].find(" 1000 of 1000 bytes") != std::string::npos);
}

TEST_CASE("demo progress: a line is printed once a second if the total is unknown") {
  Watcher watcher(Progress::Form::lines);
  for (std::uint32_t i = 0; i < 25; ++i) {
    watcher.sees({i * 7, 0, i * 100 * millisecond});
  }
  CHECK(watcher.shown == std::vector<std::string>{"70 bytes, 0.1 kB/s", "140 bytes, 0.1 kB/s"});
}

TEST_CASE("demo progress: a bar is updated ten times a second and not shown for a short transfer") {
  Watcher watcher(Progress::Form::bar);
  watcher.sees({1000, 1000, 99 * millisecond});
  CHECK(watcher.shown.empty());
  for (std::uint32_t i = 0; i <= 1000; ++i) {
    watcher.sees({i, 1000, i * millisecond});
  }
  CHECK(watcher.shown.size() == 10);
}

TEST_CASE("demo progress: no bar is shown before the first answer of the node") {
  Watcher watcher(Progress::Form::bar);
  watcher.sees({0, 1000, 5 * second});
  CHECK(watcher.shown.empty());
  watcher.sees({1, 1000, 6 * second});
  CHECK(watcher.shown.size() == 1);
}

TEST_CASE("demo progress: nothing is shown without a request") {
  Watcher watcher(Progress::Form::none);
  watcher.sees({1000, 1000, second});
  CHECK(watcher.shown.empty());
}
#endif
