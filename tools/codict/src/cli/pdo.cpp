// SPDX-License-Identifier: Apache-2.0
#include "model/pdo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.hpp"
#include "cli/letters.hpp"
#include "doc/contents.hpp"
#include "model/cob_id.hpp"

namespace lexican::codict::cli {

namespace {

struct PdoOptions {
  std::string file;
  doc::Options doc{"en", 0};
  bool is_json = false;
};

// PDO of the output.
struct Row {
  const Pdo& pdo;
  const doc::PdoItem& item;  // its title and mapped objects
  const CobId* cob_id;       // null: it has no COB-ID
};

// Sub-indexes of the communication parameters. [301: 7.5.2.37]
constexpr std::uint8_t inhibit_time = 3;
constexpr std::uint8_t event_time = 5;
constexpr std::uint8_t sync_start = 6;

// Returns the value of a communication parameter; null if it is missing or no number.
const Value* value_of(const Pdo& pdo, std::uint8_t sub_index) {
  const Entry* const entry = pdo.parameter(sub_index);
  const bool is_number = entry != nullptr && value_in_force(*entry).is_integer();
  return is_number ? &value_in_force(*entry) : nullptr;
}

// Characters for the mapped objects in a picture: a PDO maps up to 64 objects.
constexpr std::string_view signs = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+*";

// Returns a picture with a line for each byte, bit 7 on the left, and the character of the mapped object for each bit.
std::string picture_of(const doc::PdoItem& item) {
  std::string bits(std::size_t{8} * ((std::min(item.bits, 64U) + 7) / 8), '.');
  for (std::size_t n = 0; n < std::min(item.parts.size(), signs.size()); ++n) {
    const doc::PdoPart& part = item.parts[n];
    for (std::size_t bit = part.first_bit; bit < std::min<std::size_t>(part.first_bit + part.bits, bits.size());
         ++bit) {
      bits[bit] = signs[n];
    }
  }
  std::string text = bits.empty() ? "" : "  byte  7 6 5 4 3 2 1 0\n";
  for (std::size_t byte = 0; byte < bits.size() / 8; ++byte) {
    text += fmt::format("  {:>4} ", byte);
    for (std::size_t bit = 8; bit-- != 0;) {
      text += fmt::format(" {}", bits[8 * byte + bit]);
    }
    text += '\n';
  }
  return text;
}

std::string cob_id_text(const CobId* cob_id) {
  if (cob_id == nullptr || !cob_id->is_known) {
    return "?";
  }
  return cob_id->is_valid() ? fmt::format("{:03X}h", cob_id->identifier()) : "off";
}

std::string heading_of(const Row& row) {
  std::string text = fmt::format("{}: COB-ID {}", row.item.title, cob_id_text(row.cob_id));
  if (!row.item.transmission.empty()) {
    text += "; " + row.item.transmission;
  }
  const auto add = [&](std::uint8_t sub_index, const auto& text_of_time) {
    const Value* const value = value_of(row.pdo, sub_index);
    if (value != nullptr && value->integer.magnitude != 0) {
      text += "; " + text_of_time(value->integer.magnitude);
    }
  };
  add(inhibit_time, [](std::uint64_t time) { return fmt::format("inhibit time {}.{} ms", time / 10, time % 10); });
  add(event_time, [](std::uint64_t time) { return fmt::format("event time {} ms", time); });
  add(sync_start, [](std::uint64_t count) { return fmt::format("from SYNC {} on", count); });
  return text + (row.pdo.is_multiplexed ? "; multiplexed\n" : fmt::format("; {} bits\n", row.item.bits));
}

std::string text_of(const Row& row) {
  std::string text = heading_of(row) + picture_of(row.item);
  for (std::size_t n = 0; n < row.item.parts.size(); ++n) {
    const doc::PdoPart& part = row.item.parts[n];
    text += fmt::format("  {}  {:<9} {} bits from {}  {}\n", n < signs.size() ? signs[n] : ' ', part.number, part.bits,
                        part.first_bit, visible(part.name));
  }
  return text;
}

Json row_json(const Row& row) {
  Json json{{"name", row.item.title}, {"transmit", row.pdo.is_transmit}, {"number", row.pdo.number}};
  const bool is_known = row.cob_id != nullptr && row.cob_id->is_known;
  if (is_known) {
    json["cob_id"] = row.cob_id->identifier();
  }
  json["valid"] = is_known && row.cob_id->is_valid();
  const auto add = [&](const char* name, std::uint8_t sub_index) {
    if (const Value* const value = value_of(row.pdo, sub_index); value != nullptr) {
      json[name] = value->integer.bits();
    }
  };
  add("transmission_type", 2);
  add("inhibit_time_100us", inhibit_time);
  add("event_time_ms", event_time);
  add("sync_start", sync_start);
  json["bits"] = row.item.bits;
  json["mapped"] = Json::array();
  for (std::size_t n = 0; n < row.item.parts.size(); ++n) {
    const doc::PdoPart& part = row.item.parts[n];
    json["mapped"].push_back({{"index", row.pdo.mapped[n].index},
                              {"sub_index", row.pdo.mapped[n].sub_index},
                              {"name", part.name},
                              {"first_bit", part.first_bit},
                              {"bits", part.bits}});
  }
  return json;
}

const CobId* find(const std::vector<CobId>& cob_ids, const Pdo& pdo) {
  const auto place = std::find_if(cob_ids.begin(), cob_ids.end(), [&pdo](const CobId& cob_id) {
    return pdo.communication != nullptr && cob_id.index == pdo.communication->index;
  });
  return place != cob_ids.end() ? &*place : nullptr;
}

int run_pdo(PdoOptions options) {
  const std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  options.doc.node_id = node_id_of(input->device(), options.doc.node_id);
  const doc::Contents contents = doc::contents_of(input->device(), options.doc);
  const std::vector<CobId> cob_ids = cob_ids_of(input->device(), options.doc.node_id);
  const std::vector<Pdo> pdos = pdos_of(input->device());
  Json json{{"schema", "codict-pdo-1"}, {"node_id", options.doc.node_id}, {"pdos", Json::array()}};
  std::string text;
  for (std::size_t n = 0; n < pdos.size(); ++n) {
    const Row row{pdos[n], contents.pdos[n], find(cob_ids, pdos[n])};
    json["pdos"].push_back(row_json(row));
    text += (n == 0 ? "" : "\n") + text_of(row);
  }
  if (options.is_json) {
    print_json(json);
  } else {
    print(text);
  }
  return clean;
}

}  // namespace

Command add_pdo(CommandLine& line) {
  const auto options = std::make_shared<PdoOptions>();
  Arguments command = line.add_command("pdo", "Show the PDOs of a device: COB-IDs, times, and what is in them");
  command.add_option("file", options->file, file_help).required();
  add_node_id(command, options->doc.node_id);
  command.add_option("--language", options->doc.language, "Language of labels").default_text(options->doc.language);
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  return {command, [options] { return run_pdo(*options); }};
}

}  // namespace lexican::codict::cli
