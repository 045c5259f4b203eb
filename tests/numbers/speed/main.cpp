// SPDX-License-Identifier: Apache-2.0
// Measures the speed of SDO transfers between a Lexican client and server, in the time of a simulated bus.
#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "report.hpp"
#include "row.hpp"

namespace {

std::string read(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  if (!file) {
    throw std::runtime_error("cannot write " + path);
  }
}

// Measures all rows, updates or checks the page, and returns the exit status: 0 if the results are as expected.
int report(const std::string& to_update, const std::string& to_check) {
  const std::vector<speed::Row> rows = speed::measure_rows();
  if (!to_update.empty()) {
    write(to_update, speed::with_table(read(to_update), speed::table_of(rows)));
  }
  if (!to_check.empty()) {
    return speed::print_verdicts(std::cout, rows, read(to_check)) ? 0 : 1;
  }
  std::cout << speed::table_of(rows);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string to_update;
  std::string to_check;
  CLI::App app("Measures SDO transfers on a simulated bus. Without options: prints the table.", "lexican_speed");
  app.add_option("--update", to_update, "Write the table into this page")->type_name("PAGE");
  app.add_option("--check", to_check, "Instead of the table, say what keeps its budget, and if the page is up to date")
      ->type_name("PAGE");
  CLI11_PARSE(app, argc, argv);
  try {
    return report(to_update, to_check);
  } catch (const std::exception& error) {
    std::cerr << "lexican_speed: " << error.what() << "\n";
    return 1;
  }
}
