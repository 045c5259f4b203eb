// SPDX-License-Identifier: Apache-2.0
#include "cli/stores.hpp"

#include <fmt/format.h>

#include <charconv>

namespace lexican::codict::cli {

namespace {

// Parses a sub-index: hexadecimal with or without 0x, like all sub-indexes in arguments; "none" is 0.
bool parse_sub(std::string_view text, std::uint8_t& sub_index) {
  constexpr std::uint8_t most = 0x7F;
  sub_index = 0;
  if (text == "none") {
    return true;
  }
  if (text.substr(0, 2) == "0x") {
    text.remove_prefix(2);
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), sub_index, 16);
  return error == std::errc() && end == text.data() + text.size() && sub_index >= 1 && sub_index <= most;
}

}  // namespace

void add_stores(Arguments& command, std::vector<std::string>& stores) {
  command
      .add_option("--store", stores,
                  "GROUP=SUB: the sub-index of 1010h (and 1011h) that stores a storage group, hexadecimal; "
                  "GROUP=none keeps it in RAM")
      .single_values();
}

bool parse_stores(const std::vector<std::string>& stores, gen::Options& options) {
  for (const std::string& store : stores) {
    const std::size_t sign = store.rfind('=');
    std::uint8_t sub_index = 0;
    if (sign == std::string::npos || sign == 0 || !parse_sub(std::string_view(store).substr(sign + 1), sub_index)) {
      print_message(fmt::format(
          "--store {}: the form is GROUP=SUB, with a sub-index of 1 to 7F (hexadecimal), or GROUP=none", store));
      return false;
    }
    options.store[store.substr(0, sign)] = sub_index;
  }
  return true;
}

}  // namespace lexican::codict::cli
