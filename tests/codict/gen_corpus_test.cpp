// SPDX-License-Identifier: Apache-2.0
// Dictionaries of the descriptions in the directory that LEXICAN_CORPUS names.
#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "codict/directory.hpp"
#include "eds/document.hpp"
#include "eds/read.hpp"
#include "eds/recognise.hpp"
#include "gen/gen.hpp"
#include "text/file.hpp"

using namespace lexican::codict;

namespace {

const char* const corpus = std::getenv("LEXICAN_CORPUS");

// A configuration in which everything is there that a description can ask for.
const std::string options =
    " -Wall -Wextra -Wpedantic -Wconversion -Werror -fsyntax-only -DCO_RPDO_N=512 -DCO_TPDO_N=512 -DCO_HBCONS_N=127"
    " -DCO_SSDO_N=128 -DCO_CSDO_N=100 -DCO_EMCY_CONS_N=127 -DUSE_TIME=1 -DUSE_MPDO=1 -DUSE_PDO_BITS=1"
    " -I" LEXICAN_SOURCE_DIR "/include -I" LEXICAN_SOURCE_DIR "/config ";

// Those that are EDS or DCF, by their endings and by what they say.
std::vector<eds::Document> descriptions() {
  std::vector<eds::Document> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus)) {
    const std::string ending = entry.path().extension();
    std::string why;
    std::optional<Source> source =
        ending == ".eds" || ending == ".dcf" || ending == ".EDS" ? read_file(entry.path(), why) : std::nullopt;
    Findings findings;
    if (!source || !eds::refusal(*source).empty()) {
      continue;
    }
    eds::Document document(std::move(*source), findings);
    if (eds::refusal(document).empty()) {
      all.push_back(std::move(document));
    }
  }
  return all;
}

// "" if it compiles.
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

TEST_CASE("gen: of each description in the corpus comes a dictionary that compiles, or an error that says why" *
          doctest::skip(corpus == nullptr)) {
  const test::Directory directory;
  const std::vector<eds::Document> documents = descriptions();
  std::vector<std::string> faults(2 * documents.size());
  std::vector<char> has_reason(documents.size(), 0);
  const auto make = [&](std::size_t n, gen::Language language) {
    Findings reading;
    Findings findings;
    const Description description = eds::read(documents[n], reading);
    gen::Options settings;
    settings.name = "device" + std::to_string(n);
    settings.language = language;
    const gen::Output output = gen::generate(description.devices.front(), settings, findings);
    has_reason[n] = static_cast<char>(findings.count(Severity::error) != 0);
    for (const gen::File& file : output.files) {
      std::ofstream(directory / file.name.c_str(), std::ios::binary) << file.bytes;
    }
    return output.files.empty() ? std::string() : compile(directory / "", output.files.at(1));
  };
  in_two_threads(documents.size(), [&](std::size_t n) {
    faults[2 * n] = make(n, gen::Language::c);
    faults[2 * n + 1] = make(n, gen::Language::cpp);
  });
  std::size_t generated = 0;
  for (std::size_t n = 0; n < documents.size(); ++n) {
    CAPTURE(documents[n].source().name());
    CHECK(faults[2 * n] == "");
    CHECK(faults[2 * n + 1] == "");
    generated += has_reason[n] == 0 ? 1U : 0U;
  }
  MESSAGE(generated << " of " << documents.size() << " descriptions have a dictionary");
  CHECK(8 * generated > 6 * documents.size());
}
