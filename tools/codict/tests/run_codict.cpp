// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"
#include "reading.hpp"

namespace test {

Ran run_codict(const std::string& directory, const std::string& arguments) {
  return run_shell("cd '" + directory + "' && '" LEXICAN_CODICT_PROGRAM "' " + arguments);
}

Ran run(const std::string& arguments) { return run_codict(fixture(""), arguments); }

}  // namespace test
