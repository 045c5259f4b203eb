// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>

#include "program/verb.hpp"

namespace lexican::program {
namespace {

std::string printable(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    const bool is_control = (static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7F;
    c = is_control ? '?' : c;
  }
  return result;
}

}  // namespace

void add_bus_options(Arguments& arguments, Common& common) {
  std::string kinds;
  for (const host_bus::BusKind& kind : host_bus::bus_kinds) {
    kinds += (kinds.empty() ? "" : ", ") + std::string(kind.example);
  }
  arguments.add_option("-i,--bus", common.bus, "Bus: " + kinds + "; default: $LEXICAN_BUS");
  arguments.add_option("--rate", common.rate, "Bit rate of an adapter, such as 500k");
  arguments.add_flag("--json", common.is_json, "Print one JSON object in each line");
}

void add_eds_option(Arguments& arguments, Common& common) {
  arguments
      .add_option("--eds", common.eds,
                  "Description (EDS, DCF, XDD, XDC) as FILE, NODE=FILE or a directory; several are allowed")
      .single_values();
}

void add_timeout_option(Arguments& arguments, Common& common, std::uint32_t time) {
  common.timeout = time;
  arguments.add_option("--timeout", common.timeout, fmt::format("Time for each answer in ms; default: {}", time))
      .in_hidden_range(1, 3'600'000);
}

std::unique_ptr<host_bus::Bus> open_bus(const Common& common, bool listens_only, int& status) {
  const char* const usual = std::getenv("LEXICAN_BUS");
  const std::string name = !common.bus.empty() ? common.bus : usual != nullptr ? usual : "";
  host_bus::BusOptions options;
  options.listens_only = listens_only;
  options.bit_rate = bit_rate_of(common.rate);
  status = usage;
  if (name.empty()) {
    print_message("which bus? Give -i BUS, for example -i can0 or -i hub:bench, or set LEXICAN_BUS");
    return nullptr;
  }
  if (!common.rate.empty() && options.bit_rate == 0) {
    print_message("'" + common.rate + "' is no bit rate; write 500k, 1M or 500000");
    return nullptr;
  }
  std::string why;
  std::unique_ptr<host_bus::Bus> bus = host_bus::open_bus(name, options, why);
  status = bus_fault;
  if (bus == nullptr) {
    print_message(why);
  } else if (!bus->note().empty()) {
    print_message(bus->note());
  }
  return bus;
}

bool read_descriptions(const Common& common, describe::Network& network) {
  for (const std::string& file : common.eds) {
    std::string why;
    if (!network.add(file, why)) {
      print_message(why);
      return false;
    }
  }
  return true;
}

std::uint32_t bit_rate_of(std::string_view text) {
  std::uint32_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, number);
  const std::string_view unit(next, static_cast<std::size_t>(end - next));
  const std::uint32_t factor = unit.empty() ? 1 : unit == "k" || unit == "K" ? 1000 : unit == "M" ? 1'000'000 : 0;
  const bool is_rate = error == std::errc() && factor != 0 && number <= 1'000'000 / factor;
  return is_rate ? number * factor : 0;
}

std::uint8_t node_of(std::string_view text) {
  std::uint8_t node = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, node);
  return error == std::errc() && next == end && node <= 127 ? node : std::uint8_t{0};
}

void print_message(std::string_view text) { fmt::print(stderr, "lexican: {}\n", printable(text)); }

void print(std::string_view text) {
  const std::string shown = printable(text);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

void print_red(std::string_view line) { fmt::print("\033[31m{}\033[0m\n", printable(line)); }

bool has_colour() { return isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr; }

}  // namespace lexican::program
