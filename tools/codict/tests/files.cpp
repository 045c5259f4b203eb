// SPDX-License-Identifier: Apache-2.0
#include "files.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace test {

const char* corpus() { return std::getenv("LEXICAN_CORPUS"); }

doctest::skip skipped_without_corpus() { return doctest::skip(corpus() == nullptr); }

const Endings& eds_endings() {
  static const Endings endings = {".eds", ".dcf"};
  return endings;
}

const Endings& xml_endings() {
  static const Endings endings = {".xdd", ".xdc", ".xpd", ".xml", ".nxdd", ".nxdc"};
  return endings;
}

const Endings& all_endings() {
  static const Endings endings = [] {
    Endings both = eds_endings();
    both.insert(both.end(), xml_endings().begin(), xml_endings().end());
    return both;
  }();
  return endings;
}

std::vector<std::string> files_in(const std::string& directory, const Endings& endings, bool are_foreign) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    const bool is_foreign = entry.path().string().find("/_not-canopen/") != std::string::npos;
    if (entry.is_regular_file() && is_foreign == are_foreign &&
        std::find(endings.begin(), endings.end(), entry.path().extension()) != endings.end()) {
      found.push_back(entry.path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace test
