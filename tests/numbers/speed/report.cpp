// SPDX-License-Identifier: Apache-2.0
#include "report.hpp"

#include <cstdio>
#include <ostream>
#include <stdexcept>

namespace speed {
namespace {

const std::string begin_mark = "<!-- speed table: begin -->\n";
const std::string end_mark = "<!-- speed table: end -->\n";

std::string number(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string percent(double part) { return number(100 * part, 1) + " %"; }

// Returns the transfers per second, or the milliseconds of a single transfer.
std::string speed_of(const Row& row, double micros) {
  if (row.number > 1) {
    return number(static_cast<double>(row.number) * 1e6 / micros, 0) + " /s";
  }
  return number(micros / 1000, 1) + " ms";
}

std::string line_of(const Row& row) {
  const std::string cells[] = {row.hardware,
                               row.transfer,
                               speed_of(row, row.micros),
                               speed_of(row, row.ideal_micros),
                               percent(row.of_limit()),
                               percent(row.load),
                               row.peers};
  std::string line = "|";
  for (const std::string& cell : cells) {
    line += cell.empty() ? " |" : " " + cell + " |";
  }
  return line + "\n";
}

// Returns true if the row reaches its budget. A transfer that is faster than the limit proves that the limit is wrong.
bool keeps_budget(const Row& row) {
  const bool known = row.known_micros > 0;
  return row.of_limit() >= row.budget && row.of_limit() <= 1 && (!known || row.of_known_limit() >= row.budget);
}

class Verdicts {
 public:
  explicit Verdicts(std::ostream& out) : out_(out) {}
  void add(bool good, const std::string& what) {
    out_ << (good ? "ok " : "not ok ") << what << "\n";
    ++number_;
    all_ = all_ && good;
  }
  bool end() {
    out_ << "1.." << number_ << "\n";
    return all_;
  }

 private:
  std::ostream& out_;
  unsigned number_ = 0;
  bool all_ = true;
};

}  // namespace

std::string table_of(const std::vector<Row>& rows) {
  std::string table =
      "| bus | transfer | here | limit | of the limit | bus load | others publish |\n"
      "|---|---|---:|---:|---:|---:|---:|\n";
  for (const Row& row : rows) {
    table += line_of(row);
  }
  return table;
}

std::string with_table(const std::string& page, const std::string& table) {
  const std::size_t begin = page.find(begin_mark);
  const std::size_t end = page.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw std::runtime_error("the page has no marks for the speed table");
  }
  return page.substr(0, begin + begin_mark.size()) + table + page.substr(end);
}

bool print_verdicts(std::ostream& out, const std::vector<Row>& rows, const std::string& page) {
  Verdicts verdicts(out);
  for (const Row& row : rows) {
    if (row.budget > 0) {
      verdicts.add(keeps_budget(row), row.hardware + ", " + row.transfer + ": " + speed_of(row, row.micros) +
                                          ", at least " + percent(row.budget) + " of " +
                                          speed_of(row, row.ideal_micros));
    }
  }
  verdicts.add(with_table(page, table_of(rows)) == page, "docs/speed.md has this table (tests/run --update-numbers)");
  return verdicts.end();
}

}  // namespace speed
