// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/output.hpp"
#include "convert/commission.hpp"
#include "convert/losses.hpp"
#include "convert/write.hpp"
#include "json/texts.hpp"
#include "json/write.hpp"
#include "xdd/suppressions.hpp"

namespace lexican::codict::cli {

namespace {

using convert::Loss;
using convert::Target;

struct ConvertOptions {
  std::string file;
  std::string output;
  std::string format;
  std::uint8_t node_id = 0;  // 0 or an empty text: not given
  std::string bit_rate;
  std::string node_name;
  bool is_strict = false;
  bool is_all = false;
};

// Format of the output.
struct Product {
  std::string_view name;  // value of --to, or file extension
  Target target;
  xdd::Edition edition;        // used for XDD and XDC only
  std::array<Format, 2> same;  // input formats that need no conversion
};

constexpr std::array<Product, 9> products = {{
    {"eds", Target::eds, xdd::Edition::v11, {Format::eds, Format::eds}},
    {"dcf", Target::dcf, xdd::Edition::v11, {Format::dcf, Format::dcf}},
    {"xdd", Target::xdd, xdd::Edition::v11, {Format::xdd10, Format::xdd11}},
    {"xdc", Target::xdc, xdd::Edition::v11, {Format::xdc10, Format::xdc11}},
    {"xdd10", Target::xdd, xdd::Edition::v10, {Format::xdd10, Format::xdd10}},
    {"xdc10", Target::xdc, xdd::Edition::v10, {Format::xdc10, Format::xdc10}},
    {"xdd11", Target::xdd, xdd::Edition::v11, {Format::xdd11, Format::xdd11}},
    {"xdc11", Target::xdc, xdd::Edition::v11, {Format::xdc11, Format::xdc11}},
    {"json", Target::json, xdd::Edition::v11, {}},
}};

const Product* find_product(std::string_view name) {
  const auto* const place =
      std::find_if(products.begin(), products.end(), [name](const Product& product) { return product.name == name; });
  return place != products.end() ? place : nullptr;
}

// Returns true if the input already has the format of the output.
bool is_same(const Input& input, const Product& product) {
  if (product.target == Target::json || input.json != nullptr) {
    return product.target == Target::json && input.json != nullptr;
  }
  return std::find(product.same.begin(), product.same.end(), input.device().format) != product.same.end();
}

// Returns the XML edition of the output: that of the input, unless --to names another one.
xdd::Edition edition_of(const Device& device, const Product& product) {
  const bool is_older = device.format == Format::xdd10 || device.format == Format::xdc10;
  return is_older && product.same.front() != product.same.back() ? xdd::Edition::v10 : product.edition;
}

// Returns the bytes of the output. Frees the parsed source first, because a large description needs much memory.
std::string convert_description(Input input, const Product& product, const ConvertOptions& options) {
  const bool is_same_format = is_same(input, product);
  input.eds.reset();
  input.xdd.reset();
  input.json.reset();
  if (product.target == Target::json) {
    return json::write(input.description);
  }
  Device& device = input.description.devices.front();
  const std::string name = options.output == "-" ? "" : std::filesystem::path(options.output).filename().string();
  const xdd::Edition edition = is_same_format ? edition_of(device, product) : product.edition;
  return convert::write(std::move(device), product.target, edition, name);
}

convert::NodeSettings settings_of(const ConvertOptions& options) {
  convert::NodeSettings settings;
  if (options.node_id != 0) {
    settings.node_id = options.node_id;
  }
  if (!options.bit_rate.empty()) {
    settings.bit_rate = static_cast<std::uint32_t>(std::stoul(options.bit_rate));
  }
  if (!options.node_name.empty()) {
    settings.node_name = options.node_name;
  }
  return settings;
}

// Returns true if the format can contain the settings of a node: DCF, XDC and JSON describe a single node. Otherwise
// prints the reason.
bool has_place(const convert::NodeSettings& settings, Target target) {
  const std::string fault = convert::fault_of(settings);
  if (!fault.empty()) {
    print_message(fault);
  } else if (settings.is_any() && (target == Target::eds || target == Target::xdd)) {
    print_message("--node-id, --bit-rate and --node-name configure one node; the output must be a DCF, XDC or JSON");
  } else {
    return true;
  }
  return false;
}

// Returns the number of characters that the output format cannot represent; the writers replace them.
std::size_t impossible_characters(const Device& device, Target target) {
  std::size_t number = 0;
  json::for_each_text(device, [&](const std::string& text) {
    number += static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [target](char c) {
      const bool is_of_lines = c == '\t' || c == '\n' || c == '\r';
      const bool is_of_xml = target == Target::xdd || target == Target::xdc;
      return c == '\0' || (is_of_xml && static_cast<unsigned char>(c) < ' ' && !is_of_lines);
    }));
  });
  return number;
}

// Returns the contents of the input that the output format cannot express.
std::vector<Loss> losses_of(const Input& input, Target target) {
  std::vector<Loss> losses = convert::losses(input.description, target);
  const std::size_t characters = target == Target::json ? 0 : impossible_characters(input.device(), target);
  if (characters != 0) {
    losses.push_back({"characters that it cannot have", std::vector<std::string>(characters)});
  }
  const std::size_t comments = input.xdd != nullptr && target != Target::json ? xdd::number_of_comments(*input.xdd) : 0;
  if (comments != 0) {
    losses.push_back({"comments", std::vector<std::string>(comments)});
  }
  return losses;
}

// Returns the first places, each once: " (2000h en, 2000h de, 2001h, …)"; empty if there are none.
std::string places_of(const Loss& loss, bool is_all) {
  constexpr std::size_t most = 3;
  std::vector<std::string> places;
  std::copy_if(loss.places.begin(), loss.places.end(), std::back_inserter(places),
               [](const std::string& place) { return !place.empty(); });
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (!is_all && places.size() > most) {
    places.resize(most);
    places.emplace_back("…");
  }
  return places.empty() ? "" : fmt::format(" ({})", fmt::join(places, ", "));
}

// Prints "codict: drive.xdd: not in the output: 3 units (2000h, 2001h, 2002h), 40 descriptions (2000h en, 2000h de,
// …)".
void report(const Input& input, const std::vector<Loss>& losses, bool is_all) {
  std::vector<std::string> parts;
  parts.reserve(losses.size());
  for (const Loss& loss : losses) {
    parts.push_back(fmt::format("{} {}{}", loss.places.size(), loss.what, places_of(loss, is_all)));
  }
  print_message(fmt::format("{}: not in the output: {}", input.source().name(), fmt::join(parts, ", ")));
}

// Copies a file without change of format: only the settings of the node change, all other bytes are equal.
int copy(const Input& input, const convert::NodeSettings& settings, const ConvertOptions& options) {
  std::string bytes(input.source().bytes());
  if (settings.is_any() && !convert::commission(settings, *input.eds, bytes)) {
    print_message(input.source().name() +
                  ": the node name has a character that the encoding of the file does not contain");
    return unusable;
  }
  return write_output(options.output, bytes);
}

int run_convert(const ConvertOptions& options) {
  const Product* const product = find_product(options.format.empty() ? ending_of(options.output) : options.format);
  if (product == nullptr) {
    print_message("unknown format of the output; use the suffix .eds, .dcf, .xdd, .xdc or .json, or the option --to");
    return unusable;
  }
  const convert::NodeSettings settings = settings_of(options);
  std::optional<Input> input = has_place(settings, product->target) ? open(options.file) : std::nullopt;
  if (!input) {
    return unusable;
  }
  if (is_same(*input, *product) && (!settings.is_any() || input->eds != nullptr)) {
    return copy(*input, settings, options);
  }
  if (is_same_file(options.output, options.file)) {
    print_message(options.output + ": the output would overwrite the description");
    return unusable;
  }
  const std::vector<Loss> losses = losses_of(*input, product->target);
  if (!losses.empty()) {
    report(*input, losses, options.is_all);
    const bool is_strict_loss =
        std::any_of(losses.begin(), losses.end(), [](const Loss& loss) { return !loss.is_minor; });
    if (options.is_strict && is_strict_loss) {
      return found;
    }
  }
  convert::commission(settings, input->description.devices.front());
  return write_output(options.output, convert_description(std::move(*input), *product, options));
}

void add_node_options(Arguments& command, ConvertOptions& options) {
  command.add_option("--node-id", options.node_id, "Node-ID of the DCF or XDC").in_range(1, 127);
  command.add_option("--bit-rate", options.bit_rate, "Bit rate of the DCF or XDC in kbit/s; 0: the device detects it")
      .one_of({"0", "10", "20", "50", "100", "125", "250", "500", "800", "1000"});
  command.add_option("--node-name", options.node_name, "Name of the node in the DCF or XDC");
}

}  // namespace

Command add_convert(CommandLine& line) {
  std::vector<std::string> names;
  names.reserve(products.size());
  for (const Product& product : products) {
    names.emplace_back(product.name);
  }
  const auto options = std::make_shared<ConvertOptions>();
  Arguments command = line.add_command("convert", "Write a description in another format");
  command.add_option("file", options->file, file_help).required();
  command
      .add_option("-o,--output", options->output,
                  "File that ends with .eds, .dcf, .xdd, .xdc or .json, - for the standard output")
      .required();
  command
      .add_option("--to", options->format,
                  "eds, dcf, xdd, xdc, json; xdd10, xdd11, xdc10, xdc11: edition 1.0 or 1.1 of CiA 311")
      .one_of(std::move(names));
  add_node_options(command, *options);
  command.add_flag("--all", options->is_all,
                   "List all places of contents that the format cannot express, not only the first ones");
  command.add_flag("--strict-loss", options->is_strict, "Write no file if the format cannot express all contents");
  return {command, [options] { return run_convert(*options); }};
}

}  // namespace lexican::codict::cli
