// SPDX-License-Identifier: Apache-2.0
#include "doc/contents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "doc/items.hpp"

namespace lexican::codict::doc {

namespace {

// Identity and features --------------------------------------------------------------------------------------------

void add(std::string_view name, std::string value, std::vector<Fact>& facts) {
  if (!value.empty()) {
    facts.push_back({name, std::move(value)});
  }
}

std::string joined(const std::vector<Text>& texts) {
  std::vector<std::string_view> parts;
  parts.reserve(texts.size());
  for (const Text& text : texts) {
    parts.emplace_back(text.text);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<Fact> identity_of(const Device& device) {
  const Identity& identity = device.identity;
  std::vector<Fact> facts;
  add("Vendor", identity.vendor_name.text, facts);
  add("Vendor number", identity.vendor_number.text, facts);
  add("About the vendor", identity.vendor_text.text, facts);
  add("Product", identity.product_name.text, facts);
  add("Product number", identity.product_number.text, facts);
  add("Product family", identity.product_family.text, facts);
  add("About the product", identity.product_text.text, facts);
  add("Revision number", identity.revision_number.text, facts);
  add("Order codes", joined(identity.order_codes), facts);
  for (const Version& version : identity.versions) {
    add("Version", version.type.text + " " + version.text.text, facts);
  }
  add("Description", device.file.description.text, facts);
  add("File", device.file.file_name.text, facts);
  add("Author", device.file.created_by.text, facts);
  add("Changed", device.file.modification_date.text, facts);
  return facts;
}

std::string bit_rates_of(const Features& features) {
  std::vector<std::string> rates;
  for (const BitRate& rate : features.bit_rates) {
    if (rate.supported.value) {
      rates.push_back(rate.kbit == 0 ? "automatic" : fmt::format("{} kbit/s", rate.kbit));
    }
  }
  return fmt::format("{}", fmt::join(rates, ", "));
}

void add_flag(std::string_view name, const Field<bool>& flag, std::vector<Fact>& facts) {
  if (flag.is_given) {
    add(name, flag.value ? "yes" : "no", facts);
  }
}

std::vector<Fact> features_of(const Features& features) {
  std::vector<Fact> facts;
  add("Bit rates", bit_rates_of(features), facts);
  add("RPDOs", features.rx_pdos.text, facts);
  add("TPDOs", features.tx_pdos.text, facts);
  add("Granularity of PDO mapping", features.granularity.text, facts);
  add_flag("LSS slave", features.lss_slave, facts);
  add_flag("LSS master", features.lss_master, facts);
  add_flag("Boot-up master", features.boot_up_master, facts);
  add_flag("Boot-up slave", features.boot_up_slave, facts);
  add_flag("Group messaging", features.group_messaging, facts);
  add_flag("Self-starting", features.self_starting, facts);
  return facts;
}

// COB-IDs and PDOs -------------------------------------------------------------------------------------------------

std::string identifier_text(const CobId& cob_id) {
  if (!cob_id.is_known) {
    return "?";
  }
  return cob_id.is_valid() ? fmt::format("{:03X}h", cob_id.identifier()) : "off";
}

std::vector<CobIdRow> cob_id_rows(const Device& device, const Options& options) {
  std::vector<CobIdRow> rows;
  for (const CobId& cob_id : cob_ids_of(device, options.node_id)) {
    const bool has_object = cob_id.index != 0;
    const bool is_variable = has_object && device.find(cob_id.index)->subs.empty();
    rows.push_back({cob_id.service, identifier_text(cob_id),
                    !has_object   ? "CiA 301"
                    : is_variable ? number_of(cob_id.index)
                                  : number_of(cob_id.index, cob_id.sub_index)});
  }
  return rows;
}

std::string transmission_text(const Entry& entry) {
  const Value& value = value_in_force(entry);
  if (!value.is_integer()) {
    return "";
  }
  const std::uint64_t type = value.integer.bits();
  if (type == 0) {
    return "synchronous, when it has changed";
  }
  if (type <= transmission_type::last_synchronous) {
    return type == 1 ? "with each SYNC" : fmt::format("once every {} SYNCs", type);
  }
  switch (type) {
    case transmission_type::remote_synchronous: return "on request, sampled at SYNC";
    case transmission_type::remote: return "on request";
    case transmission_type::event_manufacturer: return "by events of the manufacturer";
    case transmission_type::event_profile: return "by events of the device profile";
    default: return fmt::format("reserved ({})", type);
  }
}

PdoPart part_of(const Device& device, const MappedObject& mapped, unsigned first_bit, const Options& options) {
  PdoPart part;
  part.number = number_of(mapped.index, mapped.sub_index);
  part.first_bit = first_bit;
  part.bits = mapped.bits;
  if (mapped.is_dummy()) {
    part.name = "not used";
  } else if (mapped.entry == nullptr) {
    part.name = "not described";
  } else {
    const Object* const object = device.find(mapped.index);
    const bool is_variable = object->subs.empty();
    part.name = name_in(*mapped.entry, options);
    part.number = is_variable ? number_of(mapped.index) : part.number;
    part.anchor = is_variable ? anchor_of(mapped.index) : anchor_of(mapped.index, mapped.sub_index);
  }
  return part;
}

PdoItem item_of(const Device& device, const Pdo& pdo, const Options& options) {
  PdoItem item;
  item.title = fmt::format("{}PDO {}", pdo.is_transmit ? "T" : "R", pdo.number);
  item.anchor = fmt::format("{}pdo-{}", pdo.is_transmit ? "t" : "r", pdo.number);
  if (const Entry* const cob_id = pdo.parameter(1); cob_id != nullptr) {
    item.cob_id = value_in_force(*cob_id).text;
  }
  if (const Entry* const type = pdo.parameter(2); type != nullptr) {
    item.transmission = transmission_text(*type);
  }
  for (const MappedObject& mapped : pdo.mapped) {
    item.parts.push_back(part_of(device, mapped, item.bits, options));
    item.bits += mapped.bits;
  }
  return item;
}

// Chapters ---------------------------------------------------------------------------------------------------------

struct Area {
  std::string_view title;
  std::string_view anchor;
  std::uint16_t last;
};

// Areas of the object dictionary. [301: 7.4.1]
constexpr std::array<Area, 5> areas = {{{"Data types", "data-types", 0x0FFF},
                                        {"Communication profile", "communication", 0x1FFF},
                                        {"Manufacturer-specific objects", "manufacturer", 0x5FFF},
                                        {"Device profile", "device-profile", 0x9FFF},
                                        {"Other objects", "other", 0xFFFF}}};

const Area& area_of(std::uint16_t index) {
  return *std::find_if(areas.begin(), areas.end(), [index](const Area& area) { return index <= area.last; });
}

class Chapters {
 public:
  Chapters(const Device& device, const Options& options) : device_(device), options_(options) {}

  // Adds a chapter for each group of the description, with the objects whose own parameters the group refers to.
  void add_groups(const std::vector<Group>& groups, unsigned level) {
    for (const Group& group : groups) {
      chapters_.push_back(chapter_of(group, level));
      add_groups(group.groups, level + 1);
    }
  }

  // Adds all other objects, in a chapter for each area of the dictionary.
  void add_areas() {
    const Area* current = nullptr;
    for (const Object& object : device_.objects) {
      if (placed_.count(object.index) != 0) {
        continue;
      }
      const Area& area = area_of(object.index);
      if (current != &area) {
        current = &area;
        Chapter& chapter = chapters_.emplace_back();
        chapter.title = area.title;
        chapter.anchor = area.anchor;
      }
      chapters_.back().objects.push_back(doc::item_of(device_, object, options_));
    }
  }

  std::vector<Chapter> take_chapters() { return std::move(chapters_); }

 private:
  Chapter chapter_of(const Group& group, unsigned level) {
    Chapter chapter;
    chapter.title = text_in(group.texts.labels, options_.language);
    chapter.title = chapter.title.empty() ? group.id.text : chapter.title;
    chapter.anchor = "g-" + std::to_string(++groups_);
    chapter.words = text_in(group.texts.descriptions, options_.language);
    chapter.level = level;
    const std::set<std::string_view> wanted = ids_of(group);
    for (const Object& object : device_.objects) {
      if (has_one_of(object, wanted) && placed_.insert(object.index).second) {
        chapter.objects.push_back(doc::item_of(device_, object, options_));
      }
    }
    return chapter;
  }

  static std::set<std::string_view> ids_of(const Group& group) {
    std::set<std::string_view> ids;
    for (const Text& id : group.parameters) {
      ids.insert(id.text);
    }
    ids.erase("");
    return ids;
  }

  static bool has_one_of(const Object& object, const std::set<std::string_view>& wanted) {
    const auto is_wanted = [&wanted](const Entry& entry) { return wanted.count(entry.parameter_id->text) != 0; };
    return is_wanted(object) || std::any_of(object.subs.begin(), object.subs.end(), is_wanted);
  }

  const Device& device_;
  const Options& options_;
  std::vector<Chapter> chapters_;
  std::set<std::uint16_t> placed_;
  unsigned groups_ = 0;
};

std::string title_of(const Device& device) {
  for (const Text* const title : {&device.identity.product_name, &device.file.description, &device.file.file_name}) {
    if (!title->is_empty()) {
      return title->text;
    }
  }
  return "CANopen device";
}

}  // namespace

Contents contents_of(const Device& device, const Options& options) {
  Contents contents;
  contents.title = title_of(device);
  contents.identity = identity_of(device);
  contents.features = features_of(device.features);
  contents.cob_ids = cob_id_rows(device, options);
  for (const Pdo& pdo : pdos_of(device)) {
    contents.pdos.push_back(item_of(device, pdo, options));
  }
  Chapters chapters(device, options);
  chapters.add_groups(device.groups, 0);
  chapters.add_areas();
  contents.chapters = chapters.take_chapters();
  return contents;
}

}  // namespace lexican::codict::doc
