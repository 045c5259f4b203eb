// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target once for each line of a file: an input in hex (tests/fuzz/inputs).
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "fuzz/fuzz.hpp"

int main(int number, char** arguments) {
  std::ifstream file(number == 2 ? arguments[1] : "");
  unsigned inputs = 0;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::uint8_t> bytes;
    if (line.size() % 2 != 0) {
      std::printf("line %u is not hex\n", inputs + 1);
      return 1;
    }
    for (std::size_t at = 0; at < line.size(); at += 2) {
      bytes.push_back(static_cast<std::uint8_t>(std::stoul(line.substr(at, 2), nullptr, 16)));
    }
    std::printf("line %u\n", ++inputs);
    std::fflush(stdout);  // the last line names the input during which the program ended
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%u inputs\n", inputs);
  return inputs == 0 ? 1 : 0;
}
