// SPDX-License-Identifier: Apache-2.0
#include "cli/costs.hpp"

#include <fmt/format.h>

namespace lexican::codict::cli {

std::string costs_text(const std::vector<gen::Cost>& costs) {
  std::string text = fmt::format("{:<20} {:>8} {:>8} {:>8}\n", "part", "entries", "RAM", "flash");
  gen::Cost sum;
  for (const gen::Cost& cost : costs) {
    text += fmt::format("{:<20} {:>8} {:>8} {:>8}\n", cost.part, cost.items, cost.ram, cost.flash);
    sum.ram += cost.ram;
    sum.flash += cost.flash;
  }
  return text + fmt::format("{:<20} {:>8} {:>8} {:>8}\n", "all", "", sum.ram, sum.flash);
}

Json costs_json(const std::vector<gen::Cost>& costs) {
  Json json = Json::array();
  for (const gen::Cost& cost : costs) {
    json.push_back({{"part", cost.part}, {"entries", cost.items}, {"ram", cost.ram}, {"flash", cost.flash}});
  }
  return json;
}

}  // namespace lexican::codict::cli
