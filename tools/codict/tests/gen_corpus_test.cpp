// SPDX-License-Identifier: Apache-2.0
// Dictionaries generated from the descriptions in the directory LEXICAN_CORPUS.
#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "directory.hpp"
#include "eds/document.hpp"
#include "eds/read.hpp"
#include "eds/recognise.hpp"
#include "files.hpp"
#include "gen/gen.hpp"
#include "text/file.hpp"
#include "xdd/document.hpp"
#include "xdd/read.hpp"
#include "xdd/recognise.hpp"

using namespace lexican::codict;

namespace {

// Configuration with everything that a description can require.
const std::string options =
    " -Wall -Wextra -Wpedantic -Wconversion -Werror -fsyntax-only -DCO_RPDO_N=512 -DCO_TPDO_N=512 -DCO_HBCONS_N=127"
    " -DCO_SSDO_N=128 -DCO_CSDO_N=100 -DCO_EMCY_CONS_N=127 -DUSE_TIME=1 -DCO_MPDO_N=16 -DUSE_PDO_BITS=1"
    " -I" LEXICAN_SOURCE_DIR "/include -I" LEXICAN_SOURCE_DIR "/config ";

// Returns the first device of a file, nothing if it describes none.
std::optional<Device> device_of(Source source) {
  Findings ignored;
  Description description;
  if (eds::refusal(source).empty() && source.bytes().find('<') > 100) {
    const eds::Document document(std::move(source), ignored);
    description = eds::refusal(document).empty() ? eds::read(document, ignored) : Description();
  } else {
    xdd::Document document(std::move(source), ignored);
    description = xdd::refusal(document).empty() ? xdd::read(document, ignored) : Description();
  }
  return description.devices.empty() ? std::nullopt : std::optional(std::move(description.devices.front()));
}

struct Named {
  std::string name;
  Device device;
};

std::vector<Named> devices() {
  std::vector<Named> all;
  for (const std::string& path : test::files_in(test::corpus(), test::all_endings())) {
    std::string why;
    std::optional<Source> source = read_file(path, why);
    std::optional<Device> device = source ? device_of(std::move(*source)) : std::nullopt;
    if (device) {
      all.push_back({path, std::move(*device)});
    }
  }
  return all;
}

// Compiles a file. Returns the first line of the messages, empty if there are no errors.
std::string compile(const std::string& directory, const gen::File& source) {
  const std::string path = directory + "/" + source.name;
  const std::string log = path + ".log";
  const bool is_c = source.name.back() == 'c';
  const std::string compiler = is_c ? LEXICAN_CC " -std=c11" : LEXICAN_CXX " -std=c++17";
  if (std::system((compiler + options + path + " 2>" + log).c_str()) == 0) {
    return {};
  }
  std::ifstream file(log);
  std::string line;
  std::getline(file, line);
  return source.name + ": " + line;
}

// Calls job(n) for n in 0…number-1, two at a time.
template <typename Job>
void in_two_threads(std::size_t number, Job job) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t n = next++; n < number; n = next++) {
      job(n);
    }
  };
  std::thread other(work);
  work();
  other.join();
}

}  // namespace

TEST_CASE("gen: each description in the corpus gives a dictionary that compiles" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  const test::Directory directory;
  const std::vector<Named> all = devices();
  std::vector<std::string> faults(2 * all.size());
  std::vector<char> has_reason(all.size(), 0);
  const auto make = [&](std::size_t n, gen::Language language) {
    Findings findings;
    gen::Options settings;
    settings.name = "device" + std::to_string(n);
    settings.language = language;
    const gen::Output output = gen::generate(all[n].device, settings, findings);
    for (const gen::File& file : output.files) {
      std::ofstream(directory / file.name.c_str(), std::ios::binary) << file.bytes;
    }
    has_reason[n] = static_cast<char>(findings.count(Severity::error) != 0);
    return output.files.empty() ? std::string("no files") : compile(directory / "", output.files.at(1));
  };
  in_two_threads(all.size(), [&](std::size_t n) {
    faults[2 * n] = make(n, gen::Language::c);
    faults[2 * n + 1] = make(n, gen::Language::cpp);
  });
  std::size_t refused = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    CAPTURE(all[n].name);
    const std::string expected = has_reason[n] != 0 ? "no files" : "";
    refused += has_reason[n] != 0 ? 1U : 0U;
    CHECK(faults[2 * n] == expected);
    CHECK(faults[2 * n + 1] == expected);
  }
  MESSAGE(refused << " of " << all.size() << " descriptions have no dictionary");
  CHECK(refused * 20 < all.size());
}
