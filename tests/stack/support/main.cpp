// SPDX-License-Identifier: Apache-2.0
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

namespace {

// Writes the number of finished test cases to the file that LEXICAN_PROGRESS names; tests/run shows it.
struct Progress : doctest::IReporter {
  explicit Progress(const doctest::ContextOptions&) {}

  void test_case_end(const doctest::CurrentTestCaseStats&) override {
    ++finished_;
    if (path_ == nullptr || finished_ % 10 != 0) {
      return;
    }
    if (std::FILE* const file = std::fopen(path_, "w")) {
      std::fprintf(file, "%u\n", finished_);
      std::fclose(file);
    }
  }

  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats&) override {}
  void test_case_start(const doctest::TestCaseData&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

 private:
  const char* path_ = std::getenv("LEXICAN_PROGRESS");
  unsigned finished_ = 0;
};

DOCTEST_REGISTER_LISTENER("progress", 1, Progress);

}  // namespace
