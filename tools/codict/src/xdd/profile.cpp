// SPDX-License-Identifier: Apache-2.0
// Reads the parts of a profile about the file and the whole device. [311: ProfileHeader, ProfileBody, DeviceIdentity]
#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "model/parse.hpp"
#include "xdd/parts.hpp"

namespace lexican::codict::xdd {

namespace {

constexpr std::array<Slot<ProfileHeader>, 6> header_slots = {{
    {"ProfileIdentification", [](ProfileHeader& h) -> Text& { return h.identification; }},
    {"ProfileRevision", [](ProfileHeader& h) -> Text& { return h.revision; }},
    {"ProfileName", [](ProfileHeader& h) -> Text& { return h.name; }},
    {"ProfileSource", [](ProfileHeader& h) -> Text& { return h.source; }},
    {"ProfileClassID", [](ProfileHeader& h) -> Text& { return h.class_id; }},
    {"ProfileDate", [](ProfileHeader& h) -> Text& { return h.date; }},
}};

constexpr std::array<Slot<FileInfo>, 10> file_slots = {{
    {"fileName", [](FileInfo& f) -> Text& { return f.file_name; }},
    {"fileCreator", [](FileInfo& f) -> Text& { return f.created_by; }},
    {"fileCreationDate", [](FileInfo& f) -> Text& { return f.creation_date; }},
    {"fileCreationTime", [](FileInfo& f) -> Text& { return f.creation_time; }},
    {"fileModifiedBy", [](FileInfo& f) -> Text& { return f.modified_by; }},
    {"fileModificationDate", [](FileInfo& f) -> Text& { return f.modification_date; }},
    {"fileModificationTime", [](FileInfo& f) -> Text& { return f.modification_time; }},
    {"fileVersion", [](FileInfo& f) -> Text& { return f.version; }},
    {"supportedLanguages", [](FileInfo& f) -> Text& { return f.supported_languages; }},
    {"deviceClass", [](FileInfo& f) -> Text& { return f.device_class; }},
}};

constexpr std::array<Slot<Identity>, 8> identity_slots = {{
    {"vendorName", [](Identity& i) -> Text& { return i.vendor_name; }},
    {"vendorID", [](Identity& i) -> Text& { return i.vendor_number; }},
    {"productFamily", [](Identity& i) -> Text& { return i.product_family; }},
    {"productName", [](Identity& i) -> Text& { return i.product_name; }},
    {"productID", [](Identity& i) -> Text& { return i.product_number; }},
    {"buildDate", [](Identity& i) -> Text& { return i.build_date; }},
    {"specificationRevision", [](Identity& i) -> Text& { return i.specification_revision; }},
    {"instanceName", [](Identity& i) -> Text& { return i.instance_name; }},
}};

struct LabelGroupSlot {
  std::string_view name;
  LabelGroup& (*texts)(Identity&);
  Text& (*text)(Identity&);
};

constexpr std::array<LabelGroupSlot, 3> identity_texts = {{
    {"vendorText", [](Identity& i) -> LabelGroup& { return i.vendor_texts; },
     [](Identity& i) -> Text& { return i.vendor_text; }},
    {"deviceFamily", [](Identity& i) -> LabelGroup& { return i.family_texts; },
     [](Identity& i) -> Text& { return i.device_family; }},
    {"productText", [](Identity& i) -> LabelGroup& { return i.product_texts; },
     [](Identity& i) -> Text& { return i.product_text; }},
}};

// Keys of an EDS that CiA 311 lacks. CANeds and other tools write them into a description of the product, in this
// spelling.
constexpr std::array<Slot<Device>, 4> eds_slots = {{
    {"FileDescription", [](Device& d) -> Text& { return d.file.description; }},
    {"EdsVersion", [](Device& d) -> Text& { return d.file.eds_version; }},
    {"FileRevison", [](Device& d) -> Text& { return d.file.revision; }},
    {"RevisionNum", [](Device& d) -> Text& { return d.identity.revision_number; }},
}};

// Reads "FileDescription=x|EdsVersion=4.0|". Returns false, and changes nothing, for other texts.
bool read_eds_keys(const Text& description, const Reader& reader) {
  if (description.text.substr(0, 16) != "FileDescription=") {
    return false;
  }
  Device found;
  std::string_view remaining = description.text;
  while (!remaining.empty()) {
    const std::string_view part = remaining.substr(0, remaining.find('|'));
    remaining.remove_prefix(std::min(part.size() + 1, remaining.size()));
    const std::size_t sign = part.find('=');
    const Text text{std::string(part.substr(std::min(sign, part.size() - 1) + 1)), description.span, true};
    if (sign == std::string_view::npos ||
        !read_into(found, part.substr(0, sign), text, description.span, eds_slots, reader)) {
      return false;
    }
  }
  reader.device.file.description = found.file.description;
  reader.device.file.eds_version = found.file.eds_version;
  reader.device.file.revision = found.file.revision;
  reader.device.identity.revision_number = found.identity.revision_number;
  interpret_number(reader.device.file.revision, std::numeric_limits<std::uint8_t>::max(), reader.findings);
  interpret_number(reader.device.identity.revision_number, std::numeric_limits<std::uint32_t>::max(), reader.findings);
  return true;
}

bool read_identity_texts(pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader) {
  const std::string_view name = local_name(child);
  for (const LabelGroupSlot& slot : identity_texts) {
    Identity& identity = reader.device.identity;
    if (!is_named(name, slot.name, reader.document.tag(child), reader) || slot.text(identity).is_given) {
      continue;
    }
    LabelGroup& texts = slot.texts(identity);
    std::vector<OpaquePart> opaque;
    read_children(child, opaque, reader,
                  [&](pugi::xml_node word) { return read_label_element(texts, word, opaque, reader); });
    store_remainder(child, std::move(opaque), others, reader);
    if (texts.descriptions.size() == 1 && read_eds_keys(texts.descriptions.front().text, reader)) {
      texts.descriptions.clear();
    }
    slot.text(identity) = first_of(texts);
    slot.text(identity).is_given = true;
    return true;
  }
  return false;
}

bool read_identity_text(pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader) {
  const std::string_view name = local_name(child);
  const Span place = reader.document.tag(child);
  Identity& identity = reader.device.identity;
  if (is_named(name, "orderNumber", place, reader)) {
    identity.order_codes.push_back(text_of(child, {}, others, reader));
    return true;
  }
  const auto is_slot = [&](const Slot<Identity>& slot) { return equal_ignoring_case(name, slot.name); };
  const auto* const slot = std::find_if(identity_slots.begin(), identity_slots.end(), is_slot);
  if (slot == identity_slots.end() || slot->member(identity).is_given) {
    return false;
  }
  return read_into(identity, name, text_of(child, {}, others, reader), place, identity_slots, reader);
}

void read_version(pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader) {
  Version& version = reader.device.identity.versions.emplace_back();
  version.type = attribute_text(child, "versionType", reader);
  version.text = text_of(child, {}, others, reader);
  // Removes the attribute, which has been read, from the opaque parts.
  if (version.type.is_given && !others.empty() && others.back().name == "version") {
    auto& opaque = others.back().children;
    opaque.erase(
        std::remove_if(opaque.begin(), opaque.end(), [](const OpaquePart& k) { return k.name == "@versionType"; }),
        opaque.end());
    if (opaque.empty()) {
      others.pop_back();
    }
  }
}

}  // namespace

void read_header(pugi::xml_node element, ProfileHeader& header, const Reader& reader) {
  read_element(header, element, header_slots, header.others, reader, [](pugi::xml_node) { return false; });
}

// Reads the attributes of a body. Both bodies of a file usually have the same; different ones of the second are stored
// as opaque.
void read_file_info(pugi::xml_node body, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  FileInfo& file = reader.device.file;
  FileInfo said;
  for (const pugi::xml_attribute attribute : body.attributes()) {
    const std::string_view name = local_name(attribute);
    const bool is_format = (name == "formatName" && std::string_view(attribute.value()) == "CANopen") ||
                           (name == "formatVersion" && std::string_view(attribute.value()) == "1.0");
    if (!is_syntax(attribute) && !is_format &&
        !read_into(said, name, reader.document.text(attribute), reader.document.span(attribute), file_slots, reader)) {
      store_opaque(attribute, opaque, reader);
    }
  }
  for (const Slot<FileInfo>& slot : file_slots) {
    const Text& text = slot.member(said);
    Text& first = slot.member(file);
    if (text.is_given && first.is_empty()) {
      first = text;
    } else if (!text.is_empty() && first.text != text.text) {
      opaque.push_back({"@" + std::string(slot.name), text, {}, text.span});
    }
  }
  const ParsedInteger version = parse_integer(file.version.text);  // any text is allowed
  if (version.is_meant() && !version.value.is_negative && version.value.magnitude <= 0xFFFFFFFF) {
    file.version.value = static_cast<std::uint32_t>(version.value.magnitude);
  }
  store_remainder(body, std::move(opaque), reader.device.others, reader);
}

void read_identity(pugi::xml_node element, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  read_children(element, opaque, reader, [&](pugi::xml_node child) {
    if (is_named(local_name(child), "version", reader.document.tag(child), reader)) {
      read_version(child, opaque, reader);
      return true;
    }
    return read_identity_texts(child, opaque, reader) || read_identity_text(child, opaque, reader);
  });
  store_remainder(element, std::move(opaque), reader.device.others, reader);
  Identity& identity = reader.device.identity;
  interpret_number(identity.vendor_number, std::numeric_limits<std::uint32_t>::max(), reader.findings);
  interpret_number(identity.product_number, std::numeric_limits<std::uint32_t>::max(), reader.findings);
}

}  // namespace lexican::codict::xdd
